//! One front for batches in `f32`: the same calls on the CPU and on a GPU.
use crate::Error;
#[cfg(feature = "gpu")]
use crate::GpuFault;
use crate::Pack;
use crate::kernels::gpu::Gpu;
use crate::kernels::item::Results;
use crate::kernels::op::Runs;
use crate::kernels::reduce::{Best, Found};
use crate::kernels::{Columns, Cpu, Fold, Single, Table, Targets};

/// The machine on which batches run. There is no silent fallback from one to the other.
///
/// The calls are those of [`Cpu`], for any operation and any program, in `f32`: they take slices and return vectors.
/// [`resident`](Backend::resident) has the same calls on handles, whose data stay on the machine between
/// calls; see the [module](crate::kernels::resident).
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{Backend, Iou};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// assert_eq!(Backend::Cpu.all_pairs(Iou, &a, &b)?.at(0, 0), 1.0 / 3.0);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Backend<'a> {
    /// The CPU: all lanes and cores.
    Cpu,
    /// A GPU.
    Gpu(&'a Gpu),
}

/// The choice of [`Backend::auto`], with its reason.
#[derive(Clone, Debug)]
pub enum Auto {
    /// The CPU, and the error that rules out a GPU.
    Cpu(Error),
    /// A GPU. A software driver is not chosen, because it is slower than the CPU.
    Gpu(Gpu),
}

impl Backend<'_> {
    /// Returns the best GPU, or the CPU and the reason why there is no GPU.
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
    /// The chosen backend.
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

/// Calls the method of this name and these arguments on the machine of a backend.
macro_rules! on_either {
    ($backend:expr, $name:ident($($arg:expr),*)) => {
        match $backend {
            Backend::Cpu => Cpu::new().$name($($arg),*),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => gpu.$name($($arg),*),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    };
}
pub(crate) use on_either;

/// Aligned batches.
impl Backend<'_> {
    /// Computes item i of every column, as [`Cpu::aligned`].
    ///
    /// ```
    /// use geograd::kernels::{Backend, Distance};
    /// use geograd::{Circle, Vec2};
    /// let circle = |x| Circle::new(Vec2::new(x, 0.0_f32), 1.0);
    /// let (a, b) = ([circle(0.0)], [circle(5.0)]);
    /// assert_eq!(Backend::Cpu.aligned(Distance, (&a, &b))?, [3.0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The errors of the CPU, and [`Error::Gpu`].
    pub fn aligned<C: Columns, R: Runs<C::Item>>(
        self,
        run: R,
        columns: C,
    ) -> Result<<R::Out as Results>::Many, Error>
    where
        C::Item: Pack<Scalar = f32>,
    {
        on_either!(self, aligned(run, columns))
    }

    /// Computes item i of every column into the caller's slices, as [`Cpu::aligned_into`].
    ///
    /// # Errors
    ///
    /// As [`aligned`](Backend::aligned), and [`Error::Length`] for a slice of another length.
    pub fn aligned_into<C: Columns, R: Runs<C::Item>>(
        self,
        run: R,
        columns: C,
        targets: impl Targets<R::Out>,
    ) -> Result<(), Error>
    where
        C::Item: Pack<Scalar = f32>,
    {
        on_either!(self, aligned_into(run, columns, targets))
    }
}

/// All pairs of two lists. A GPU refuses searches
/// ([`Unrecordable::Search`](crate::Unrecordable::Search)).
impl Backend<'_> {
    /// Computes every shape of `a` with every shape of `b`, as [`Cpu::all_pairs`].
    ///
    /// # Errors
    ///
    /// The errors of the CPU, and [`Error::Gpu`].
    pub fn all_pairs<A, B, R>(self, run: R, a: &[A], b: &[B]) -> Result<Table<R::Out>, Error>
    where
        A: Single<Scalar = f32>,
        B: Single<Scalar = f32>,
        R: Runs<(A, B)>,
    {
        on_either!(self, all_pairs(run, a, b))
    }
}

/// Calls of two lists for results of one number: the macro lists them.
macro_rules! of_pairs {
    ($($(#[$doc:meta])* $name:ident($($arg:ident: $type:ty)?) -> $out:ty;)*) => {
        impl Backend<'_> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// The errors of the CPU, and [`Error::Gpu`].
            pub fn $name<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
                self,
                run: R,
                a: &[A],
                b: &[B],
                $($arg: $type,)?
            ) -> Result<$out, Error>
            where
                R: Runs<(A, B), Out = f32>,
            {
                on_either!(self, $name(run, a, b $(, $arg)?))
            }
        )* }
    };
}

of_pairs! {
    /// The adjoint of [`all_pairs`](Backend::all_pairs): [`Cpu::all_pairs_vjp`].
    all_pairs_vjp(upstream: &[f32]) -> (Vec<A>, Vec<B>);
    /// The sum of all results and its gradient: [`Cpu::sum_grad`].
    sum_grad() -> (f64, Vec<A>, Vec<B>);
    /// The mean of all results and its gradient: [`Cpu::mean_grad`].
    mean_grad() -> (f64, Vec<A>, Vec<B>);
    /// The largest result of every row: [`Cpu::row_max`].
    row_max() -> Vec<Best>;
    /// The largest result of every column: [`Cpu::column_max`].
    column_max() -> Vec<Best>;
    /// Every pair whose result is above a threshold: [`Cpu::above`].
    above(threshold: f32) -> Vec<Found>;
    /// The number of pairs whose result is above a threshold: [`Cpu::count_above`].
    count_above(threshold: f32) -> u64;
    /// The sum of all results: [`Cpu::sum`].
    sum() -> f64;
    /// The mean of all results: [`Cpu::mean`].
    mean() -> f64;
}

/// Folds over paths, and measures of rings.
impl Backend<'_> {
    /// One result per path: [`Cpu::fold`].
    ///
    /// ```
    /// use geograd::kernels::{Backend, One, SignedDistance};
    /// use geograd::Vec2;
    /// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    /// let point = One(Vec2::new(1.0_f32, 0.5));
    /// let distances = Backend::Cpu.fold(SignedDistance.over_ring(), point, &square, &[0, 4])?;
    /// assert_eq!(distances, [-0.5]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The errors of the CPU, and [`Error::Gpu`].
    pub fn fold<F, C: Columns>(
        self,
        fold: F,
        context: C,
        vertices: &[F::Element<f32>],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<f32>>, Error>
    where
        F: Fold<Context<f32> = C::Item>,
        C::Item: Pack<Scalar = f32>,
    {
        on_either!(self, fold(fold, context, vertices, offsets))
    }

    /// The adjoint of [`fold`](Backend::fold), one cotangent per context and one per vertex: [`Cpu::fold_vjp`].
    ///
    /// # Errors
    ///
    /// As [`fold`](Backend::fold), and for cotangents of another number or not finite.
    pub fn fold_vjp<F, C: Columns>(
        self,
        fold: F,
        context: C,
        vertices: &[F::Element<f32>],
        offsets: &[usize],
        upstream: &[F::Out<f32>],
    ) -> Result<(Vec<F::Context<f32>>, Vec<F::Element<f32>>), Error>
    where
        F: Fold<Context<f32> = C::Item>,
        C::Item: Pack<Scalar = f32>,
    {
        on_either!(self, fold_vjp(fold, context, vertices, offsets, upstream))
    }

    /// One result per path of a fold that takes nothing else: [`Cpu::ragged`].
    ///
    /// # Errors
    ///
    /// The errors of the CPU, and [`Error::Gpu`].
    pub fn ragged<F>(
        self,
        fold: F,
        vertices: &[F::Element<f32>],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<f32>>, Error>
    where
        F: Fold<Context<f32> = [f32; 0]>,
    {
        on_either!(self, ragged(fold, vertices, offsets))
    }

    /// The adjoint of [`ragged`](Backend::ragged), one cotangent per vertex: [`Cpu::ragged_vjp`].
    ///
    /// # Errors
    ///
    /// As [`ragged`](Backend::ragged), and for cotangents of another number or not finite.
    pub fn ragged_vjp<F>(
        self,
        fold: F,
        vertices: &[F::Element<f32>],
        offsets: &[usize],
        upstream: &[F::Out<f32>],
    ) -> Result<Vec<F::Element<f32>>, Error>
    where
        F: Fold<Context<f32> = [f32; 0]>,
    {
        on_either!(self, ragged_vjp(fold, vertices, offsets, upstream))
    }
}
