//! One front for batches of `f32`: the same calls on the CPU and on a GPU.
use crate::Vec2;
use crate::kernels::GpuError;
use crate::kernels::cpu::{self, A, AlignedGrads, B, PairGrads};
use crate::kernels::gpu::{Gpu, GpuPair, GpuRing};
use crate::kernels::op::{Op, PairOp};
use crate::kernels::reduce::{self, Best, Found};

/// Slopes with respect to both lists of shapes.
pub type Slopes<O> = (Vec<<O as PairOp>::A<f32>>, Vec<<O as PairOp>::B<f32>>);
/// A sum or mean of scores and its slopes with respect to both lists.
pub type Loss<O> = (f64, Vec<<O as PairOp>::A<f32>>, Vec<<O as PairOp>::B<f32>>);

/// Where batches run. Nothing ever falls back from one to the other by itself.
///
/// These calls take and give slices. [`upload`](Backend::upload) makes handles whose data stay
/// where they are computed with, between calls; see [`resident`](crate::kernels::resident).
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{Backend, overlap::IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// assert_eq!(Backend::Cpu.all_pairs::<IouObb2>(&a, &b)?, [1.0 / 3.0]);
/// # Ok::<(), geograd::kernels::GpuError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Backend<'a> {
    /// On the processor, with all its lanes and cores.
    Cpu,
    /// On a GPU.
    Gpu(&'a Gpu),
}

/// What [`Backend::auto`] took.
#[derive(Clone, Debug)]
pub enum Auto {
    /// The processor, because of this.
    Cpu(GpuError),
    /// A GPU; never a driver in software, which only repeats what the processor does better.
    Gpu(Gpu),
}

impl Backend<'_> {
    /// Takes the best GPU, or the processor where there is none, and says which, and why.
    ///
    /// A driver in software counts as no GPU ([`GpuError::OnlySoftware`]) unless the environment
    /// variable `GEOGRAD_GPU` asks for one.
    #[must_use]
    pub fn auto() -> Auto {
        match Gpu::new() {
            #[cfg(feature = "gpu")]
            Ok(gpu) if !gpu.is_worth_it() => Auto::Cpu(GpuError::OnlySoftware),
            Ok(gpu) => Auto::Gpu(gpu),
            Err(error) => Auto::Cpu(error),
        }
    }
}

impl Auto {
    /// The backend that was taken.
    #[must_use]
    pub fn backend(&self) -> Backend<'_> {
        match self {
            Auto::Cpu(_) => Backend::Cpu,
            Auto::Gpu(gpu) => Backend::Gpu(gpu),
        }
    }
}

impl std::fmt::Display for Auto {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Auto::Cpu(reason) => write!(f, "the CPU ({reason})"),
            Auto::Gpu(gpu) => gpu.fmt(f),
        }
    }
}

/// The calls that both sides have under one name, with the CPU's types: the macro lists them.
macro_rules! calls {
    ($($(#[$doc:meta])* $name:ident<$bound:ident>($($arg:ident: $type:ty),*) -> $out:ty
        = $cpu:path, $gpu:ident;)*) => {
        impl Backend<'_> {
            $(
                $(#[$doc])*
                ///
                /// # Errors
                ///
                /// [`GpuError::Input`] as on the CPU; the other kinds are the GPU's.
                pub fn $name<O: $bound>(self, $($arg: $type),*) -> Result<$out, GpuError> {
                    match self {
                        Backend::Cpu => Ok($cpu($($arg),*)?),
                        #[cfg(feature = "gpu")]
                        Backend::Gpu(gpu) => gpu.$gpu::<O>($($arg),*),
                        #[cfg(not(feature = "gpu"))]
                        Backend::Gpu(gpu) => match *gpu {},
                    }
                }
            )*
        }
    };
}

calls! {
    /// [`cpu::aligned`].
    aligned<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Vec<f32>
        = cpu::aligned::<O, f32>, aligned_slices;
    /// [`cpu::aligned_into`].
    aligned_into<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>], values: &mut [f32]) -> ()
        = cpu::aligned_into::<O, f32>, aligned_into_slices;
    /// [`cpu::aligned_grad`].
    aligned_grad<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> AlignedGrads<O, f32>
        = cpu::aligned_grad::<O, f32>, aligned_grad_slices;
    /// [`cpu::aligned_grad_into`].
    aligned_grad_into<GpuPair>(
        a: &[A<O, f32>], b: &[B<O, f32>],
        values: &mut [f32], a_bar: &mut [A<O, f32>], b_bar: &mut [B<O, f32>]
    ) -> ()
        = cpu::aligned_grad_into::<O, f32>, aligned_grad_into_slices;
    /// [`cpu::aligned_vjp`].
    aligned_vjp<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>], upstream: &[f32]) -> Slopes<O>
        = cpu::aligned_vjp::<O, f32>, aligned_vjp_slices;
    /// [`cpu::all_pairs`].
    all_pairs<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Vec<f32>
        = cpu::all_pairs::<O, f32>, all_pairs_slices;
    /// [`cpu::all_pairs_grad`].
    all_pairs_grad<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> PairGrads<O, f32>
        = cpu::all_pairs_grad::<O, f32>, all_pairs_grad_slices;
    /// [`cpu::all_pairs_vjp`].
    all_pairs_vjp<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>], upstream: &[f32]) -> Slopes<O>
        = cpu::all_pairs_vjp::<O, f32>, all_pairs_vjp_slices;
    /// [`reduce::sum_grad`].
    sum_grad<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Loss<O>
        = reduce::sum_grad::<O, f32>, sum_grad_slices;
    /// [`reduce::mean_grad`].
    mean_grad<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Loss<O>
        = reduce::mean_grad::<O, f32>, mean_grad_slices;
    /// [`reduce::row_max`].
    row_max<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Vec<Best>
        = reduce::row_max::<O, f32>, row_max_slices;
    /// [`reduce::column_max`].
    column_max<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> Vec<Best>
        = reduce::column_max::<O, f32>, column_max_slices;
    /// [`reduce::above`].
    above<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>], threshold: f32) -> Vec<Found>
        = reduce::above::<O, f32>, above_slices;
    /// [`reduce::count_above`].
    count_above<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>], threshold: f32) -> u64
        = reduce::count_above::<O, f32>, count_above_slices;
    /// [`reduce::sum`].
    sum<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> f64
        = reduce::sum::<O, f32>, sum_slices;
    /// [`reduce::mean`].
    mean<GpuPair>(a: &[A<O, f32>], b: &[B<O, f32>]) -> f64
        = reduce::mean::<O, f32>, mean_slices;
    /// [`cpu::ragged`].
    ragged<GpuRing>(vertices: &[Vec2<f32>], offsets: &[usize]) -> Vec<<O as Op>::Out<f32>>
        = cpu::ragged::<O, f32>, ragged_slices;
    /// [`cpu::ragged_vjp`].
    ragged_vjp<GpuRing>(
        vertices: &[Vec2<f32>], offsets: &[usize], upstream: &[<O as Op>::Out<f32>]
    ) -> Vec<Vec2<f32>>
        = cpu::ragged_vjp::<O, f32>, ragged_vjp_slices;
}
