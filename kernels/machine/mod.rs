//! Machines and their calls.
//!
//! [`Machine`] has every call once: for the CPU, for a GPU, and for a [`Backend`](crate::kernels::Backend) that is
//! either. Columns are slices, [`One`], or [arrays that stay on the machine](crate::kernels::resident). Results of
//! slices are vectors; results stay on the machine if one of the columns does.
mod all_pairs;
mod column;
mod columns;
mod folds;
pub(crate) mod found;
mod grouped;
mod groups;
mod held;
mod indexed;
pub(crate) mod least;
mod location;
pub(crate) mod losses;
mod machine_column;
mod nearest;
mod paths;
mod pending;
mod primitives;
pub mod resident;
mod results;
mod squares;
mod stored;
pub(crate) mod suppress;
mod table;
mod targets;

pub use all_pairs::TableRoom;
pub use column::Column;
pub(crate) use column::count_of;
pub use columns::{Columns, One};
pub(crate) use columns::{Number, listed};
pub use found::{Best, Found, Least, LeastPairs};
pub use grouped::Groups;
pub(crate) use grouped::ranked_groups;
pub use groups::GroupSpans;
pub use held::Held;
pub(crate) use held::numbers_of;
pub(crate) use indexed::in_range;
pub use indexed::{IndexOf, Indexed};
pub use location::{Here, Place, There};
pub use machine_column::Numbers;
pub(crate) use machine_column::{FOREIGN, MachineColumn};
pub use paths::{Input, PathSpans, VertexBars};
#[cfg(feature = "gpu")]
pub(crate) use pending::DeviceDownload;
pub use pending::Pending;
pub(crate) use primitives::sealed::Sealed;
pub(crate) use primitives::try_then_check;
pub use primitives::{Engine, Items, On, Room, Seed};
pub use results::{
    Bests, Founds, GroupedReduction, Matrix, Reduced, Reduction, RingBars, RingValues,
};
pub(crate) use results::{Downloads, InMemory, Matrices};
pub use squares::{Robust, Squares};
pub use stored::{HeldNumbers, Stored};
pub use table::Table;
pub use targets::{Skip, Targets};

use crate::Pack;
use crate::error::{Argument, Error};
use crate::kernels::call::modes::Function;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{Item, Results, Single, Target};
use std::fmt;

/// A machine that runs batches: [`Cpu`](crate::kernels::Cpu), [`Gpu`](crate::kernels::gpu::Gpu), or either behind a
/// [`Backend`](crate::kernels::Backend).
///
/// Results of a GPU equal the CPU's to within rounding; its errors include [`Error::Gpu`], and [`Error::Program`] for
/// functions that cannot be recorded.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Machine<E: ?Sized> {
    pub(crate) engine: E,
}

impl<E: fmt::Debug + ?Sized> fmt::Debug for Machine<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.engine.fmt(f)
    }
}

/// Returns the targets as a list, after a check that each has room for `count` items.
pub(crate) fn fitting<R: Results>(
    targets: &mut impl Targets<R>,
    count: usize,
) -> Result<Vec<Option<Target<'_, R::Scalar>>>, Error> {
    let mut list = Vec::new();
    let mut fits = Ok(());
    targets.list(&mut |target| {
        if let (Some(target), Ok(())) = (&target, &fits) {
            fits = expect(Argument::Result(list.len()), count, target.count);
        }
        list.push(target);
    });
    fits.map(|()| list)
}

/// Aligned batches, and arrays on the machine.
impl<E: ?Sized> Machine<E> {
    /// Returns the engine in a number type.
    pub(crate) fn engine<T: On<E>>(&self) -> &dyn Engine<T> {
        T::engine(&self.engine)
    }

    /// Computes item i of every column. Returns one result per item; results of several shapes are one vector per
    /// shape.
    ///
    /// `run` is a verb ([`Iou`](crate::kernels::Iou)), its gradient
    /// ([`value_grad`](crate::kernels::Op::value_grad)) or Jacobian
    /// ([`jacobian`](crate::kernels::Op::jacobian)), its adjoint ([`vjp`](crate::kernels::Op::vjp)), or a program.
    ///
    /// On a GPU searches ([`Search`](crate::kernels::Search)) are decided on the CPU and replayed on the GPU, with
    /// their derivatives. Every record that occurs becomes a program once, which pays if many items share it.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] when columns differ in length, [`Error::Invalid`] for a shape that is not valid. A GPU also
    /// returns [`Error::Gpu`] and, for a function that cannot be recorded, [`Error::Program`]; a program that fits no
    /// buffer gives [`GpuFault::TooLarge`](crate::GpuFault::TooLarge). Arrays of another machine give
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer).
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou, Op};
    /// let a = [Obb2::new(0.0_f64, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
    /// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.aligned(Iou, (&a, &b))?, [1.0 / 3.0, 1.0]);
    ///
    /// let (iou, (a_bar, _)) = cpu.aligned(Iou.value_grad(), (&a, &b))?;
    /// assert_eq!(iou[0], 1.0 / 3.0);
    /// assert!((a_bar[0].center.x - 4.0 / 9.0).abs() < 1e-15); // nearer is better
    ///
    /// // The adjoint: derivatives times what some loss says about every result.
    /// let (twice, _) = cpu.aligned(Iou.vjp(), ((&a, &b), &[2.0, 0.0]))?;
    /// assert_eq!(twice[0].center.x, 2.0 * a_bar[0].center.x);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn aligned<C: Columns, R: Function<C::Item>>(
        &self,
        run: R,
        columns: C,
    ) -> Result<<C::Place as Place>::Many<R::Out>, Error>
    where
        Number<C>: On<E>,
    {
        C::Place::aligned::<R::Out>(self.engine(), &run.call()?, &listed(&columns))
    }

    /// Writes the results of [`aligned`](Machine::aligned) to the caller's memory: a slice for every shape of a result,
    /// in a tuple like the result's, with [`Skip`] for unwanted ones. The memory may also be an array on the machine,
    /// whose buffers are reused.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Machine::aligned), and [`Error::Length`] for memory of another length. Nothing is
    /// written then, unless a device fails in the middle.
    ///
    /// ```
    /// use geograd::Aabb2;
    /// use geograd::kernels::{Cpu, Iou, Op, Skip};
    /// let boxes = [Aabb2::new(0.0, 0.0, 2.0, 2.0)];
    /// let mut a_bar = boxes;
    /// let targets = (Skip, (&mut a_bar, Skip));
    /// Cpu::new().aligned_into(Iou.value_grad(), (&boxes, &boxes), targets)?;
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn aligned_into<C: Columns, R: Function<C::Item>>(
        &self,
        run: R,
        columns: C,
        mut targets: impl Targets<R::Out>,
    ) -> Result<(), Error>
    where
        Number<C>: On<E>,
    {
        let (call, columns) = (run.call()?, listed(&columns));
        let count = count_of(&call, &columns)?;
        if let Some(held) = targets.held() {
            expect(Argument::Values, count, held.len())?;
            return self
                .engine()
                .map(&call, &columns, Items::Held(held))
                .map(drop);
        }
        let targets = fitting::<R::Out>(&mut targets, count)?;
        self.engine()
            .map(&call, &columns, Items::Targets(targets, false))
            .map(drop)
    }

    /// Checks items and uploads them. Returns an array that stays on the machine and is a column of every call.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, and the errors of the device.
    pub fn upload<R: Item>(&self, items: &[R]) -> Result<Held<R>, Error>
    where
        <R as Pack>::Scalar: On<E>,
    {
        let engine = self.engine();
        let check = |_, leaf, rows: &[_]| engine.check(Argument::Shape, leaf, rows);
        let stored = engine.keep(items.len(), numbers_of(items, check)?)?;
        Ok(Held::of(stored))
    }

    /// Uploads a row-major matrix.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] unless there are rows times columns values, [`Error::Invalid`] for one that is not finite, and
    /// the errors of the device.
    pub fn upload_matrix<T: On<E>>(
        &self,
        rows: usize,
        columns: usize,
        values: &[T],
    ) -> Result<Matrix<T>, Error> {
        let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
        expect(Argument::Upstream, expected, values.len())?;
        let mut matrix = self.engine().room(rows, columns)?;
        matrix.update(values)?;
        Ok(matrix)
    }

    /// Returns the best shape of `list` for each row (or column): `pick(&b, &row_max)` has as many shapes as `a`, ready
    /// to be aligned with it.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for results about a list of another length,
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for arrays of other machines, and the errors of the
    /// device.
    pub fn pick<P: Single>(
        &self,
        list: &Held<P>,
        bests: &Bests<<P as Pack>::Scalar>,
    ) -> Result<Held<P>, Error>
    where
        <P as Pack>::Scalar: On<E>,
    {
        Ok(Held::of(self.engine().pick(list.stored(), bests)?))
    }
}
