//! One front for batches of `f32`: the same calls on the CPU and on a GPU.
use crate::Error;
#[cfg(feature = "gpu")]
use crate::GpuFault;
use crate::kernels::gpu::{Gpu, GpuPair, GpuRing};
use crate::kernels::on_cpu::{self, AlignedGrads, Bars as Slopes, Loss, PairGrads, ShapeOf};
use crate::kernels::op::{RingOp, Runs};
use crate::kernels::reduce::{Best, Found};
use crate::kernels::row::Row;
use crate::kernels::{Columns, Cpu, Fold, Single, Table, Targets};
use crate::{Pack, Vec2};

/// Where batches run. Nothing ever falls back from one to the other by itself.
///
/// These calls take and give slices. [`resident`](Backend::resident) has the same calls over handles whose
/// data stay where they are computed with, between calls; see the [module](crate::kernels::resident).
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{Backend, IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// assert_eq!(Backend::Cpu.all_pairs(IouObb2, &a, &b)?, [1.0 / 3.0]);
/// # Ok::<(), geograd::Error>(())
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
    Cpu(Error),
    /// A GPU; never a driver in software, which only repeats what the processor does better.
    Gpu(Gpu),
}

impl Backend<'_> {
    /// Takes the best GPU, or the processor where there is none, and says which, and why.
    ///
    /// A driver in software counts as no GPU ([`OnlySoftware`](crate::GpuFault::OnlySoftware)) unless the environment
    /// variable `GEOGRAD_GPU` asks for one.
    #[must_use]
    pub fn auto() -> Auto {
        match Gpu::new() {
            #[cfg(feature = "gpu")]
            Ok(gpu) if !gpu.is_worth_it() => Auto::Cpu(Error::Gpu(GpuFault::OnlySoftware)),
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

/// Any operation, and any program.
impl Backend<'_> {
    /// Item i of every column: [`Cpu::aligned`](crate::kernels::Cpu::aligned).
    ///
    /// ```
    /// use geograd::kernels::{Backend, DistanceCircles};
    /// use geograd::{Circle, Vec2};
    /// let circle = |x| Circle::new(Vec2::new(x, 0.0_f32), 1.0);
    /// let (a, b) = ([circle(0.0)], [circle(5.0)]);
    /// assert_eq!(Backend::Cpu.run(DistanceCircles, (&a, &b))?, [3.0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As on the CPU; [`Error::Gpu`] are the GPU's.
    pub fn run<C: Columns, R: Runs<C::Row>>(
        self,
        run: R,
        columns: C,
    ) -> Result<<R::Out as Row>::Many, Error>
    where
        C::Row: Pack<Scalar = f32>,
    {
        match self {
            Backend::Cpu => Cpu::new().aligned(run, columns),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.programs().aligned(run, columns),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// The same into the caller's slices: [`Cpu::aligned_into`](crate::kernels::Cpu::aligned_into).
    ///
    /// # Errors
    ///
    /// As [`run`](Backend::run), and [`Error::Length`] for a slice of another length.
    pub fn run_into<C: Columns, R: Runs<C::Row>>(
        self,
        run: R,
        columns: C,
        targets: impl Targets<R::Out>,
    ) -> Result<(), Error>
    where
        C::Row: Pack<Scalar = f32>,
    {
        match self {
            Backend::Cpu => Cpu::new().aligned_into(run, columns, targets),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.programs().aligned_into(run, columns, targets),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// The numbers of every result, item by item.
    pub(crate) fn rows<C: Columns, R: Runs<C::Row>>(
        self,
        run: R,
        columns: C,
    ) -> Result<Vec<Vec<f32>>, Error>
    where
        C::Row: Pack<Scalar = f32>,
    {
        match self {
            Backend::Cpu => Cpu::new().rows(run, columns),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.programs().rows(run, columns),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// Every row of `a` with every row of `b`: [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs).
    ///
    /// # Errors
    ///
    /// As [`run`](Backend::run); a GPU does not serve all pairs of what searches
    /// ([`Unrecordable::Search`](crate::Unrecordable::Search)).
    pub fn run_pairs<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R: Runs<(A, B)>>(
        self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<Table<R::Out>, Error> {
        match self {
            Backend::Cpu => Cpu::new().all_pairs(run, a, b),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.programs().all_pairs(run, a, b),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }
}

/// Folds over paths.
impl Backend<'_> {
    /// One result per path: [`Cpu::fold`](crate::kernels::Cpu::fold).
    ///
    /// ```
    /// use geograd::kernels::{Backend, One, SignedDistancePointRing};
    /// use geograd::Vec2;
    /// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    /// let point = One(Vec2::new(1.0_f32, 0.5));
    /// let distances = Backend::Cpu.fold(SignedDistancePointRing, point, &square, &[0, 4])?;
    /// assert_eq!(distances, [-0.5]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As on the CPU; [`Error::Gpu`] are the GPU's.
    pub fn fold<F, C: Columns>(
        self,
        fold: F,
        context: C,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<f32>>, Error>
    where
        F: Fold<Context<f32> = C::Row>,
        C::Row: Pack<Scalar = f32>,
    {
        match self {
            Backend::Cpu => Cpu::new().fold(fold, context, vertices, offsets),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.programs().fold(fold, context, vertices, offsets),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// Its adjoint, one cotangent per context and one per vertex:
    /// [`Cpu::fold_vjp`](crate::kernels::Cpu::fold_vjp).
    ///
    /// # Errors
    ///
    /// As [`fold`](Backend::fold), and for cotangents of another number or not finite.
    pub fn fold_vjp<F, C: Columns>(
        self,
        fold: F,
        context: C,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
        upstream: &[F::Out<f32>],
    ) -> Result<(Vec<F::Context<f32>>, Vec<Vec2<f32>>), Error>
    where
        F: Fold<Context<f32> = C::Row>,
        C::Row: Pack<Scalar = f32>,
    {
        match self {
            Backend::Cpu => Cpu::new().fold_vjp(fold, context, vertices, offsets, upstream),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu
                .programs()
                .fold_vjp(fold, context, vertices, offsets, upstream),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
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
                /// As on the CPU; [`Error::Gpu`](crate::Error::Gpu) are the GPU's.
                pub fn $name<O: $bound>(self, op: O, $($arg: $type),*) -> Result<$out, Error> {
                    match self {
                        Backend::Cpu => Ok($cpu(op, $($arg),*)?),
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
    /// [`Cpu::aligned`](crate::kernels::Cpu::aligned).
    aligned<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<f32>
        = on_cpu::aligned::<O>, aligned_slices;
    /// [`Cpu::aligned_into`](crate::kernels::Cpu::aligned_into).
    aligned_into<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>], values: &mut [f32]) -> ()
        = on_cpu::aligned_into::<O>, aligned_into_slices;
    /// [`Cpu::aligned`](crate::kernels::Cpu::aligned) of [`value_grad`](crate::kernels::Op::value_grad).
    aligned_grad<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> AlignedGrads<O>
        = on_cpu::aligned_grad::<O>, aligned_grad_slices;
    /// [`Cpu::aligned_into`](crate::kernels::Cpu::aligned_into) of [`value_grad`](crate::kernels::Op::value_grad).
    aligned_grad_into<GpuPair>(
        a: &[ShapeOf<O>], b: &[ShapeOf<O>],
        values: &mut [f32], a_bar: &mut [ShapeOf<O>], b_bar: &mut [ShapeOf<O>]
    ) -> ()
        = on_cpu::aligned_grad_into::<O>, aligned_grad_into_slices;
    /// [`Cpu::aligned`](crate::kernels::Cpu::aligned) of [`vjp`](crate::kernels::Op::vjp).
    aligned_vjp<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32]) -> Slopes<O>
        = on_cpu::aligned_vjp::<O>, aligned_vjp_slices;
    /// [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs).
    all_pairs<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<f32>
        = on_cpu::all_pairs::<O>, all_pairs_slices;
    /// [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs) of [`value_grad`](crate::kernels::Op::value_grad).
    all_pairs_grad<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> PairGrads<O>
        = on_cpu::all_pairs_grad::<O>, all_pairs_grad_slices;
    /// [`Cpu::all_pairs_vjp`](crate::kernels::Cpu::all_pairs_vjp).
    all_pairs_vjp<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32]) -> Slopes<O>
        = on_cpu::all_pairs_vjp::<O>, all_pairs_vjp_slices;
    /// [`Cpu::sum_grad`](crate::kernels::Cpu::sum_grad).
    sum_grad<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Loss<O>
        = on_cpu::sum_grad::<O>, sum_grad_slices;
    /// [`Cpu::mean_grad`](crate::kernels::Cpu::mean_grad).
    mean_grad<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Loss<O>
        = on_cpu::mean_grad::<O>, mean_grad_slices;
    /// [`Cpu::row_max`](crate::kernels::Cpu::row_max).
    row_max<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<Best>
        = on_cpu::row_max::<O>, row_max_slices;
    /// [`Cpu::column_max`](crate::kernels::Cpu::column_max).
    column_max<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<Best>
        = on_cpu::column_max::<O>, column_max_slices;
    /// [`Cpu::above`](crate::kernels::Cpu::above).
    above<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>], threshold: f32) -> Vec<Found>
        = on_cpu::above::<O>, above_slices;
    /// [`Cpu::count_above`](crate::kernels::Cpu::count_above).
    count_above<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>], threshold: f32) -> u64
        = on_cpu::count_above::<O>, count_above_slices;
    /// [`Cpu::sum`](crate::kernels::Cpu::sum).
    sum<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> f64
        = on_cpu::sum::<O>, sum_slices;
    /// [`Cpu::mean`](crate::kernels::Cpu::mean).
    mean<GpuPair>(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> f64
        = on_cpu::mean::<O>, mean_slices;
    /// [`Cpu::ragged`](crate::kernels::Cpu::ragged).
    ragged<GpuRing>(vertices: &[Vec2<f32>], offsets: &[usize]) -> Vec<<O as RingOp>::Out<f32>>
        = on_cpu::ragged::<O>, ragged_slices;
    /// [`Cpu::ragged_vjp`](crate::kernels::Cpu::ragged_vjp).
    ragged_vjp<GpuRing>(
        vertices: &[Vec2<f32>], offsets: &[usize], upstream: &[<O as RingOp>::Out<f32>]
    ) -> Vec<Vec2<f32>>
        = on_cpu::ragged_vjp::<O>, ragged_vjp_slices;
}
