//! Functions of columns of numbers, in every form of a batch.
use super::Mode;
#[cfg(feature = "check")]
use super::rows::named;
use super::rows::{Layout, Rows, renamed};
use crate::GpuFault;
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::recording::{Call, Recording};
use crate::kernels::gpu::Gpu;
use crate::kernels::machine::Column;
use crate::kernels::machine::found::{Best, Found};
use crate::kernels::machine::{Engine, Items, Reduced, Reduction, Room, Seed, count_of};
use crate::kernels::machine::{losses, try_then_check};
use crate::kernels::row::item::Target;
use crate::kernels::row::item::counts::{entries, expect};
use crate::kernels::row::limits::LowerBound;
use crate::kernels::{Backend, Cpu};
use crate::scalar::real::in_format;
use std::sync::Arc;

/// A function of rows of numbers: an operation in one format, its gradient or its adjoint, or a program.
///
/// Every call takes [`Rows`] and checks all of them before anything is written. Results are plain numbers in row-major
/// order.
#[derive(Clone)]
pub struct Function<T: Real> {
    pub(super) recording: Arc<Recording<T>>,
    pub(super) mode: Mode,
    pub(super) names: Vec<Argument>,
    /// The GPU that runs it; `None` for the CPU.
    pub(super) gpu: Option<Gpu>,
    /// The lower bound of its result, if it is not the recording's.
    pub(super) lower: Option<LowerBound>,
}

impl<T: Real> std::fmt::Debug for Function<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Function")
            .field("mode", &self.mode)
            .field("takes", &self.takes())
            .field("gives", &self.gives())
            .finish()
    }
}

impl<T: Real> Function<T> {
    /// Returns a mode of a straight line.
    #[cfg(feature = "check")]
    pub(crate) fn of_straight(recording: Arc<Recording<T>>, mode: Mode) -> Self {
        Function {
            mode,
            names: named(recording.arguments, recording.takes.len()),
            recording,
            gpu: None,
            lower: None,
        }
    }
    /// Returns this function on another machine. Without this call a function runs on the CPU.
    ///
    /// ```
    /// use geograd::kernels::Backend;
    /// use geograd::kernels::dynamic::{Rows, operation};
    /// let iou = operation("iou_aabb2").and_then(|iou| iou.value::<f32>()).expect("is listed");
    /// let boxes = Rows::new(&[0.0, 0.0, 2.0, 2.0], 4);
    /// assert_eq!(iou.on(Backend::Cpu)?.row_max(boxes, boxes)?[0].value, 1.0);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`GpuFault::OnlySingle`](crate::GpuFault::OnlySingle) for `f64` on a GPU.
    pub fn on(&self, backend: Backend<'_>) -> Result<Self, Error> {
        Ok(Function {
            gpu: gpu_of::<T>(backend)?,
            ..self.clone()
        })
    }
    /// Returns the engine that runs it.
    pub(super) fn engine(&self) -> &dyn Engine<T> {
        static CPU: Cpu = Cpu::new();
        let of_gpu = |gpu| engine_of::<T>(gpu);
        match self.gpu.as_ref().and_then(of_gpu) {
            Some(engine) => engine,
            // Not a coercion of the engine, which would compile it once more in the calling crate.
            None => CPU.engine(),
        }
    }
    /// Returns the call that machines run.
    pub(crate) fn call(&self) -> Result<Call<T>, Error> {
        let mut call = Call::of(Arc::clone(&self.recording));
        call.lower = self.lower.unwrap_or(call.lower);
        call.derived(self.mode)
    }
    /// Returns the name and the layout of every column that it takes; the last columns of an adjoint are cotangents.
    #[must_use]
    pub fn takes(&self) -> Vec<(Argument, Layout<T>)> {
        let own = self.recording.takes.iter().map(|&leaf| Layout { leaf });
        let mut all: Vec<_> = self.names.iter().copied().zip(own).collect();
        if self.mode == Mode::Vjp {
            let bars = self
                .recording
                .outputs
                .iter()
                .map(|&fields| Layout::numbers(fields));
            all.extend(bars.map(|layout| (Argument::Upstream, layout)));
        }
        all
    }
    /// Returns the number of fields of every column of its result.
    #[must_use]
    pub fn gives(&self) -> Vec<usize> {
        let takes: Vec<usize> = self
            .recording
            .takes
            .iter()
            .map(|leaf| leaf.fields)
            .collect();
        self.mode.gives(&takes, &self.recording.outputs)
    }

    /// Computes item i of every column, as [`Cpu::aligned`](crate::kernels::Cpu::aligned). Returns a list of numbers
    /// for every column of the result.
    ///
    /// # Errors
    ///
    /// [`Error::Arguments`] for another number of columns, [`Error::Fields`] for rows of another number of fields,
    /// [`Error::Length`] for columns of different lengths, [`Error::Invalid`] for a row that is not valid.
    pub fn aligned(&self, rows: &[Rows<'_, T>]) -> Result<Vec<Vec<T>>, Error> {
        let (call, columns) = (self.call()?, self.listed(rows)?);
        let count = self.named(count_of(&call, &columns))?;
        let mut lists = Vec::new();
        for fields in self.gives() {
            lists.push(vec![T::default(); entries(count, 1, fields)?]);
        }
        let mut results: Vec<Option<&mut [T]>> =
            lists.iter_mut().map(|list| Some(&mut list[..])).collect();
        self.fill(rows, &mut results, true)?;
        drop(results);
        Ok(lists)
    }

    /// Computes as [`aligned_into`](Function::aligned_into) into newly allocated slices. They may be written even on an
    /// error, so that numbers can be checked while they are in the cache.
    ///
    /// # Errors
    ///
    /// As [`aligned_into`](Function::aligned_into).
    pub fn aligned_into_new(
        &self,
        rows: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        match self.gpu.is_none() && rows.iter().any(Rows::is_apart) {
            true => self.by_stretches(rows, results),
            false => self.fill(rows, results, true),
        }
    }

    /// Writes the results of [`aligned`](Function::aligned) to the caller's slices: one for every column of the result,
    /// or `None` for an unwanted one.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Function::aligned), and [`Error::Length`] for a slice of another length, in numbers. Nothing is
    /// written then.
    pub fn aligned_into(
        &self,
        rows: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        self.fill(rows, results, false)
    }

    fn fill(
        &self,
        rows: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
        new: bool,
    ) -> Result<(), Error> {
        let (call, columns) = (self.call()?, self.listed(rows)?);
        let count = self.named(count_of(&call, &columns))?;
        let gives = self.gives();
        let mut attempt = |new| {
            let targets = targets(&gives, count, results)?;
            self.named(
                self.engine()
                    .map(&call, &columns, Items::Targets(targets, new)),
            )
        };
        match new {
            true => try_then_check(attempt),
            false => attempt(false).map(drop),
        }
    }

    /// Replaces places of arguments in an error by their names.
    pub(super) fn named<X>(&self, result: Result<X, Error>) -> Result<X, Error> {
        result.map_err(|error| renamed(error, &self.names))
    }

    /// Converts rows to columns, and checks their numbers of fields.
    pub(super) fn listed<'a>(&self, rows: &[Rows<'a, T>]) -> Result<Vec<Column<'a, T>>, Error> {
        let takes = self.takes();
        if takes.len() != rows.len() {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: rows.len(),
            });
        }
        let columns = rows.iter().zip(&takes);
        columns
            .map(|(rows, (name, layout))| rows.column(*name, layout.fields()))
            .collect()
    }

    /// Converts both lists to columns, and checks their numbers of fields.
    pub(super) fn lists<'a>(
        &self,
        a: &Rows<'a, T>,
        b: &Rows<'a, T>,
    ) -> Result<[Column<'a, T>; 2], Error> {
        let takes = self.takes();
        let (2, [first, second]) = (self.recording.takes.len(), &takes[..]) else {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: 2,
            });
        };
        let columns = [
            a.column(first.0, first.1.fields())?,
            b.column(second.0, second.1.fields())?,
        ];
        if columns
            .iter()
            .any(|column| column.len() >= u32::MAX as usize)
        {
            return Err(Error::TooLarge);
        }
        Ok(columns)
    }

    /// Computes every row of `a` with every row of `b`, as [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs). Returns
    /// one row-major matrix for every number of the result, one after another.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Function::aligned), and [`Error::TooLarge`] when there are more numbers than fit the
    /// address space.
    pub fn all_pairs(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<T>, Error> {
        let lists = self.lists(&a, &b)?;
        let mut planes = vec![T::default(); self.planes_of(&lists)?];
        self.named(
            self.engine()
                .pairs(&self.call()?, &lists, Room::Planes(&mut planes)),
        )?;
        Ok(planes)
    }
    /// Returns the number of scalars in the results of all pairs.
    fn planes_of(&self, lists: &[Column<'_, T>; 2]) -> Result<usize, Error> {
        entries(lists[0].len(), lists[1].len(), self.gives().iter().sum())
    }

    /// Writes the results of [`all_pairs`](Function::all_pairs) to `planes`.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Function::all_pairs), and [`Error::Length`] for a slice of another length. Nothing is written
    /// then.
    pub fn all_pairs_into(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        planes: &mut [T],
    ) -> Result<(), Error> {
        let lists = self.lists(&a, &b)?;
        expect(Argument::Values, self.planes_of(&lists)?, planes.len())?;
        self.named(
            self.engine()
                .pairs(&self.call()?, &lists, Room::Planes(planes)),
        )
    }

    /// Checks that the result is one number.
    pub(super) fn one_number(&self) -> Result<(), Error> {
        match self.gives().iter().sum() {
            1 => Ok(()),
            found => Err(Error::NotOneNumber { found }),
        }
    }

    /// Runs a form of two lists, for results of one number: a function of an engine, the call and both lists as
    /// columns.
    pub(super) fn of_lists<X>(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        form: impl FnOnce(&dyn Engine<T>, &Call<T>, &[Column<'_, T>; 2]) -> Result<X, Error>,
    ) -> Result<X, Error> {
        self.one_number()?;
        let lists = self.lists(a, b)?;
        self.named(form(self.engine(), &self.call()?, &lists))
    }

    /// Reduces all results.
    fn reduced(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        reduction: Reduction<T>,
    ) -> Result<Reduced<T>, Error> {
        self.of_lists(a, b, |engine, call, lists| {
            losses::reduced(engine, call, lists, reduction)
        })
    }

    /// Returns the sum of all results if one factor is the seed of all pairs, and the derivatives by both lists.
    fn pulled(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        seed: &Seed<'_, T>,
    ) -> Result<Loss<T>, Error> {
        let (sum, [a_bar, b_bar]) = self.of_lists(a, b, |engine, call, lists| {
            losses::pulled(engine, call, lists, seed)
        })?;
        Ok((sum, a_bar, b_bar))
    }
}

/// A loss, with its derivatives by both lists.
pub(super) type Loss<T> = (f64, Vec<T>, Vec<T>);

/// A cast of a GPU to an engine of a format; no GPU computes in `f64`.
type OfGpu<T> = fn(&Gpu) -> Option<&dyn Engine<T>>;
static SINGLE: OfGpu<f32> = |gpu| Some(&gpu.engine);
static DOUBLE: OfGpu<f64> = |_| None;

fn engine_of<T: Real>(gpu: &Gpu) -> Option<&dyn Engine<T>> {
    in_format::<OfGpu<T>>([&SINGLE, &DOUBLE])(gpu)
}

/// Returns the GPU of a backend, which must compute in the format; `None` for the CPU.
pub(super) fn gpu_of<T: Real>(backend: Backend<'_>) -> Result<Option<Gpu>, Error> {
    match backend {
        Backend::Cpu => Ok(None),
        Backend::Gpu(gpu) => {
            let own = engine_of::<T>(gpu).map(|_| gpu.clone());
            own.map(Some).ok_or(Error::Gpu(GpuFault::OnlySingle))
        }
    }
}

/// Defines reductions and losses of all pairs, each by its documentation, name, further arguments, and formula.
macro_rules! of_pairs {
    ($($(#[$doc:meta])* $name:ident($($more:ident: $type:ty)?) -> $out:ty
        = |$own:ident, $a:ident, $b:ident| $do:expr;)*) => {
        impl<T: Real> Function<T> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// As [`all_pairs`](Function::all_pairs), [`Error::NotOneNumber`] for other results, and errors of what
            /// else the call takes.
            pub fn $name(
                &self,
                $a: Rows<'_, T>,
                $b: Rows<'_, T>,
                $($more: $type,)?
            ) -> Result<$out, Error> {
                let $own = self;
                $do
            }
        )* }
    };
}

of_pairs! {
    /// Returns the largest result of every row of `a` and its row of `b`, as
    /// [`Cpu::row_max`](crate::kernels::Cpu::row_max).
    row_max() -> Vec<Best<T>>
        = |own, a, b| own.reduced(&a, &b, Reduction::Best { of_rows: true })?.bests().taken();
    /// Returns the largest result of every row of `b` and its row of `a`, as
    /// [`Cpu::column_max`](crate::kernels::Cpu::column_max).
    column_max() -> Vec<Best<T>>
        = |own, a, b| own.reduced(&a, &b, Reduction::Best { of_rows: false })?.bests().taken();
    /// Returns every pair whose result is above the threshold, row by row, as
    /// [`Cpu::above`](crate::kernels::Cpu::above).
    above(threshold: T) -> Vec<Found<T>>
        = |own, a, b| own.reduced(&a, &b, Reduction::Above(threshold))?.founds().taken();
    /// Returns the number of pairs whose result is above the threshold, as
    /// [`Cpu::count_above`](crate::kernels::Cpu::count_above).
    count_above(threshold: T) -> u64
        = |own, a, b| Ok(own.reduced(&a, &b, Reduction::Count(threshold))?.count());
    /// Returns the sum of all results, as [`Cpu::sum`](crate::kernels::Cpu::sum).
    sum() -> f64
        = |own, a, b| Ok(own.reduced(&a, &b, Reduction::Sum)?.sum());
    /// Returns the mean of all results, zero without pairs, as [`Cpu::mean`](crate::kernels::Cpu::mean).
    mean() -> f64
        = |own, a, b| own.of_lists(&a, &b, losses::mean);
    /// Returns the sum of all results and its derivatives by both lists, as
    /// [`Cpu::sum_grad`](crate::kernels::Cpu::sum_grad).
    sum_grad() -> Loss<T>
        = |own, a, b| own.pulled(&a, &b, &Seed::Factor(crate::Scalar::one()));
    /// Returns the mean of all results and its derivatives by both lists, zero without pairs, as
    /// [`Cpu::mean_grad`](crate::kernels::Cpu::mean_grad).
    mean_grad() -> Loss<T>
        = |own, a, b| {
            let (mean, [a_bar, b_bar]) = own.of_lists(&a, &b, losses::mean_pulled)?;
            Ok((mean, a_bar, b_bar))
        };
    /// Returns the derivatives of `Σ upstream[i, j] · result[i, j]` by both lists, as
    /// [`Cpu::all_pairs_vjp`](crate::kernels::Cpu::all_pairs_vjp). `upstream` is a row-major matrix.
    all_pairs_vjp(upstream: &[T]) -> (Vec<T>, Vec<T>)
        = |own, a, b| {
            let (_, a, b) = own.pulled(&a, &b, &Seed::Numbers(upstream))?;
            Ok((a, b))
        };
}

/// Converts the caller's slices to targets for `count` rows each.
pub(super) fn targets<'a, T: Real>(
    gives: &[usize],
    count: usize,
    results: &'a mut [Option<&mut [T]>],
) -> Result<Vec<Option<Target<'a, T>>>, Error> {
    if results.len() != gives.len() {
        return Err(Error::Arguments {
            expected: gives.len(),
            found: results.len(),
        });
    }
    for (k, (result, &fields)) in results.iter().zip(gives).enumerate() {
        if let Some(result) = result {
            expect(
                Argument::Result(k),
                entries(count, 1, fields)?,
                result.len(),
            )?;
        }
    }
    let targets = results.iter_mut().zip(gives);
    Ok(targets
        .map(|(result, &fields)| {
            let result = result.as_deref_mut()?;
            Some(Target::of_rows(result, fields))
        })
        .collect())
}
