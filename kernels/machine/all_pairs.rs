//! All pairs of two lists, and their reductions.
use super::losses::{self, pull_into, pulled, reduced};
use super::{Column, Columns};
use super::{Machine, Number, On, Place, Reduction, Room, Seed};
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::Call;
use crate::kernels::machine::Matrix;
use crate::kernels::machine::suppress::checked;
use crate::kernels::row::item::Results;
use crate::kernels::row::item::counts::{entries, expect};
use crate::kernels::row::item::rows::fill_whole;
use crate::kernels::{Single, Table};
use crate::suppression::{Pair, Rules};

/// The place of the results of two lists.
type Both<A, B> = <<A as Columns>::Place as Place>::With<<B as Columns>::Place>;

/// The cotangents of all results: a row-major matrix, as a slice or on the machine.
impl<'a, T: Real> From<&'a [T]> for Seed<'a, T> {
    fn from(numbers: &'a [T]) -> Self {
        Seed::Numbers(numbers)
    }
}
impl<'a, T: Real> From<&'a Vec<T>> for Seed<'a, T> {
    fn from(numbers: &'a Vec<T>) -> Self {
        Seed::Numbers(numbers)
    }
}
impl<'a, T: Real, const N: usize> From<&'a [T; N]> for Seed<'a, T> {
    fn from(numbers: &'a [T; N]) -> Self {
        Seed::Numbers(numbers)
    }
}
impl<'a, T: Real> From<&'a Matrix<T>> for Seed<'a, T> {
    fn from(matrix: &'a Matrix<T>) -> Self {
        Seed::Matrix(matrix)
    }
}

/// The memory for all pairs: from a `&mut` [`Table`] of results `R`, or from a `&mut` [`Matrix`] on the machine.
#[derive(Debug)]
pub struct TableRoom<'a, R: Results> {
    /// The numbers of rows and columns, if the caller fixes them.
    size: Option<[usize; 2]>,
    /// The memory.
    room: Room<'a, R::Scalar>,
}
impl<'a, R: Results> From<&'a mut Table<R>> for TableRoom<'a, R> {
    fn from(table: &'a mut Table<R>) -> Self {
        TableRoom {
            size: Some([table.rows(), table.columns()]),
            room: Room::Planes(table.planes_mut()),
        }
    }
}
impl<'a, T: Real, R: Results<Scalar = T>> From<&'a mut Matrix<T>> for TableRoom<'a, R> {
    fn from(matrix: &'a mut Matrix<T>) -> Self {
        TableRoom {
            size: None,
            room: Room::Held(matrix),
        }
    }
}

/// A call of two lists: the function, and both lists as numbers.
pub(super) type ListCall<'a, T> = (Call<T>, [Column<'a, T>; 2]);

/// Returns the call of a function with every shape of two lists.
pub(super) fn list_call<'a, A, B, R>(
    run: &R,
    a: &'a A,
    b: &'a B,
) -> Result<ListCall<'a, Number<A>>, Error>
where
    A: Columns<Item: Single>,
    B: Columns<Item: Single<Scalar = Number<A>>>,
    R: Function<(A::Item, B::Item)>,
{
    Ok((run.call()?, [a.list_of_shapes(), b.list_of_shapes()]))
}

/// All pairs of two lists. A GPU refuses searches
/// ([`Unrecordable::Search`](crate::Unrecordable::Search)).
impl<E: ?Sized> Machine<E> {
    /// Computes every shape of `a` with every shape of `b`. Returns a [`Table`] with a row per shape of `a`. For lists
    /// on the machine and results of one number it is a [`Matrix`] there.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, [`Error::TooLarge`] when the table has more
    /// numbers than fit the address space, [`Error::NotOneNumber`] for other results of lists on the machine; of a GPU
    /// also [`Error::Gpu`] and [`Error::Program`].
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou, Op};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.all_pairs(Iou, &a, &b)?.values(), [0.0, 1.0 / 3.0]);
    ///
    /// let (_, (_, b_bar)) = cpu.all_pairs(Iou.value_grad(), &a, &b)?.at(0, 1);
    /// assert!((b_bar.center.x + 4.0_f64 / 9.0).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn all_pairs<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
    ) -> Result<<Both<A, B> as Place>::Table<R::Out>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item)>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        Both::<A, B>::all_pairs::<R::Out>(self.engine(), &call, &lists)
    }

    /// Writes the results of [`all_pairs`](Machine::all_pairs) to the caller's [`Table`], or to a [`Matrix`] on the
    /// machine, without new memory.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Length`] for a table of another size. The table
    /// is then as it was.
    pub fn all_pairs_into<'t, A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        table: impl Into<TableRoom<'t, R::Out>>,
    ) -> Result<(), Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item)>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let table = table.into();
        for (list, count) in lists.iter().zip(table.size.into_iter().flatten()) {
            expect(Argument::Values, list.len(), count)?;
        }
        self.engine().pairs(&call, &lists, table.room)
    }

    /// Writes the results of [`all_pairs`](Machine::all_pairs) to the caller's slice: one row-major matrix for every
    /// number of a result, one after another.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Length`] for a slice of another length, which does
    /// not change then.
    pub fn all_pairs_planes<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        planes: &mut [Number<A>],
    ) -> Result<(), Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item)>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let wanted = entries(
            lists[0].len(),
            lists[1].len(),
            R::Out::widths().iter().sum(),
        )?;
        expect(Argument::Values, wanted, planes.len())?;
        self.engine().pairs(&call, &lists, Room::Planes(planes))
    }

    /// Returns the adjoint of [`all_pairs`](Machine::all_pairs) for one number as result: derivatives of
    /// `Σ upstream[i, j] · result[i, j]` with respect to every shape of both lists. `upstream` is a row-major matrix: a
    /// slice, or a [`Matrix`] on the machine.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and for an upstream of another size or one that is not finite.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let (a_bar, b_bar) = Cpu::new().all_pairs_vjp(Iou, &a, &b, &[1.0, 3.0])?;
    /// assert!((a_bar[0].center.x - 3.0 * 4.0_f64 / 9.0).abs() < 1e-15);
    /// assert_eq!(b_bar[0].center.x, 0.0);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn all_pairs_vjp<'u, A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        upstream: impl Into<Seed<'u, Number<A>>>,
    ) -> Result<ListGradients<A, B>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        Ok(self.bars::<A, B>(&call, &lists, &upstream.into())?.1)
    }

    /// Writes the results of [`all_pairs_vjp`](Machine::all_pairs_vjp) to the caller's slices.
    ///
    /// Besides the results the CPU allocates one partial gradient of `b` per 16 or more rows of `a`, which is less than
    /// the upstream matrix.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Machine::all_pairs_vjp), and [`Error::Length`] for a slice of another length.
    /// The slices are then as they were.
    pub fn all_pairs_vjp_into<'u, A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        upstream: impl Into<Seed<'u, Number<A>>>,
        a_bar: &mut [A::Item],
        b_bar: &mut [B::Item],
    ) -> Result<(), Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        self.bars_into::<A, B>(&call, &lists, &upstream.into(), a_bar, b_bar)
            .map(drop)
    }

    /// Returns the largest result of every row and its column; the first of equal ones.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::NoLargest`] for rows without columns.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let best = Cpu::new().row_max(Iou, &a, &b)?;
    /// assert_eq!((best[0].value, best[0].index), (1.0 / 3.0, 1));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn row_max<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
    ) -> Result<<Both<A, B> as Place>::Bests<Number<A>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let best = Reduction::Best { of_rows: true };
        Both::<A, B>::bests(reduced(self.engine(), &call, &lists, best)?.bests())
    }

    /// Returns the largest result of every column and its row; the first of equal ones.
    ///
    /// # Errors
    ///
    /// As [`row_max`](Machine::row_max), for columns without rows.
    pub fn column_max<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
    ) -> Result<<Both<A, B> as Place>::Bests<Number<A>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let best = Reduction::Best { of_rows: false };
        Both::<A, B>::bests(reduced(self.engine(), &call, &lists, best)?.bests())
    }

    /// Returns every pair whose result is above the threshold, ordered by row and then by column.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Invalid`] for a threshold that is not finite.
    pub fn above<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        threshold: Number<A>,
    ) -> Result<<Both<A, B> as Place>::Founds<Number<A>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        Both::<A, B>::founds(
            reduced(self.engine(), &call, &lists, Reduction::Above(threshold))?.founds(),
        )
    }

    /// Returns the number of pairs whose result is above the threshold.
    ///
    /// # Errors
    ///
    /// As [`above`](Machine::above).
    pub fn count_above<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        threshold: Number<A>,
    ) -> Result<u64, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        Ok(reduced(self.engine(), &call, &lists, Reduction::Count(threshold))?.count())
    }

    /// Returns the sum of all results, added in `f64` in a fixed order; a GPU first adds up to 1024 of them in `f32`.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs).
    pub fn sum<A, B, R>(&self, run: R, a: A, b: B) -> Result<f64, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        Ok(reduced(self.engine(), &call, &lists, Reduction::Sum)?.sum())
    }

    /// Returns the mean of all results; 0 without pairs, as the loss of a step without matches.
    ///
    /// # Errors
    ///
    /// As [`sum`](Machine::sum).
    pub fn mean<A, B, R>(&self, run: R, a: A, b: B) -> Result<f64, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        losses::mean(self.engine(), &call, &lists)
    }

    /// Returns the sum of all results and its gradient with respect to every shape of both lists: a loss and its
    /// gradient without a matrix of results or cotangents.
    ///
    /// # Errors
    ///
    /// As [`sum`](Machine::sum).
    ///
    /// ```
    /// use geograd::Aabb2;
    /// use geograd::kernels::{Cpu, IntersectionArea};
    /// let a = [Aabb2::new(0.0, 0.0, 2.0, 2.0)];
    /// let b = [Aabb2::new(1.0, 0.0, 3.0, 2.0), Aabb2::new(-1.0, 1.0, 3.0, 3.0)];
    /// let (sum, a_bar, _) = Cpu::new().sum_grad(IntersectionArea, &a, &b)?;
    /// assert_eq!(sum, 4.0);
    /// assert_eq!(a_bar[0].max.x, 3.0); // 2 along the one, 1 along the other
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn sum_grad<A, B, R>(&self, run: R, a: A, b: B) -> Result<Loss<A, B>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let one = Seed::Factor(crate::Scalar::one());
        let (sum, (a_bar, b_bar)) = self.bars::<A, B>(&call, &lists, &one)?;
        Ok((sum, a_bar, b_bar))
    }

    /// Returns the mean of all results and its gradient, as [`sum_grad`](Machine::sum_grad); zeros without pairs.
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Machine::sum_grad).
    pub fn mean_grad<A, B, R>(&self, run: R, a: A, b: B) -> Result<Loss<A, B>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        let (mean, bars) = losses::mean_pulled(self.engine(), &call, &lists)?;
        let (a_bar, b_bar) = self.placed::<A, B>(&lists, bars)?;
        Ok((mean, a_bar, b_bar))
    }

    /// Returns the sum of all results, and writes the derivatives of the sum times `factor` to the caller's slices.
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Machine::sum_grad), and for a slice of another length or a factor that is not
    /// finite. The slices are then as they were.
    pub fn sum_grad_into<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        factor: Number<A>,
        a_bar: &mut [A::Item],
        b_bar: &mut [B::Item],
    ) -> Result<f64, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &a, &b)?;
        self.bars_into::<A, B>(&call, &lists, &Seed::Factor(factor), a_bar, b_bar)
    }

    /// Returns every two shapes of a list whose result is above the threshold, each two once: for
    /// [`suppression`](crate::suppression). The first argument is the earlier one in the list.
    ///
    /// # Errors
    ///
    /// As [`above`](Machine::above).
    pub fn overlaps<A, R>(
        &self,
        run: R,
        shapes: A,
        threshold: Number<A>,
    ) -> Result<Vec<Pair<Number<A>>>, Error>
    where
        A: Columns<Item: Single>,
        R: Function<(A::Item, A::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = list_call(&run, &shapes, &shapes)?;
        let found = reduced(self.engine(), &call, &lists, Reduction::Above(threshold))?;
        let found = found.founds().taken()?.into_iter();
        Ok(found
            .filter(|pair| pair.row < pair.column)
            .map(Pair::from)
            .collect())
    }

    /// Returns the shapes that no better kept shape overlaps by more than the threshold: their indices, best first.
    ///
    /// Only pairs with a kept shape are computed, with the better shape as the first argument. The result equals that
    /// of [`suppression::hard`](crate::suppression::hard) with all [`overlaps`](Machine::overlaps), except for pairs at
    /// the threshold: there the first argument is the earlier one in the list, and the IoU of rotated boxes may change
    /// by a rounding when arguments are exchanged.
    ///
    /// A GPU keeps the shapes that the CPU keeps: the CPU recomputes pairs whose result is within 1/256 of the
    /// threshold, if the decision depends on them. This holds for scores between zero and one, such as an IoU, whose
    /// error is smaller with every driver.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, a score that is not finite or a threshold outside
    /// `[0, 1]`; [`Error::Length`] for another number of scores or classes than of shapes; of a GPU also
    /// [`Error::Program`] for searches, [`Error::Gpu`] for errors of the device.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Iou};
    /// use geograd::suppression::Rules;
    /// use geograd::Obb2;
    ///
    /// let boxes = [0.0, 0.2, 3.0].map(|x| Obb2::new(x, 0.0, 2.0, 1.0, 0.0_f32));
    /// let scores = [0.6, 0.9, 0.5];
    /// let kept = Cpu::new().suppress(Iou, &boxes, &scores, Rules::above(0.5))?;
    /// assert_eq!(kept, [1, 2]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn suppress<A, R>(
        &self,
        run: R,
        shapes: A,
        scores: &[Number<A>],
        rules: Rules<'_, Number<A>>,
    ) -> Result<Vec<usize>, Error>
    where
        A: Columns<Item: Single>,
        R: Function<(A::Item, A::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let list = shapes.list_of_shapes();
        checked(list.len(), scores, &rules)?;
        self.engine()
            .suppress(&run.call()?, &list, None, scores, rules)
    }
}

/// The gradients of both lists, at the place of their results.
pub(crate) type ListGradients<A, B> = (
    <Both<A, B> as Place>::List<<A as Columns>::Item>,
    <Both<A, B> as Place>::List<<B as Columns>::Item>,
);

/// A loss, with its gradients of both lists.
pub(crate) type Loss<A, B> = (
    f64,
    <Both<A, B> as Place>::List<<A as Columns>::Item>,
    <Both<A, B> as Place>::List<<B as Columns>::Item>,
);

/// Helpers of the calls above.
impl<E: ?Sized> Machine<E> {
    /// Returns the sum of all results if one factor is the seed of all pairs, and the cotangents of both lists.
    fn bars<A, B>(
        &self,
        call: &Call<Number<A>>,
        lists: &[Column<'_, Number<A>>; 2],
        seed: &Seed<'_, Number<A>>,
    ) -> Result<(f64, ListGradients<A, B>), Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        Number<A>: On<E>,
    {
        let (sum, bars) = pulled(self.engine(), call, lists, seed)?;
        Ok((sum, self.placed::<A, B>(lists, bars)?))
    }

    /// Moves the cotangents of both lists to the place of their results.
    fn placed<A, B>(
        &self,
        lists: &[Column<'_, Number<A>>; 2],
        [a_bar, b_bar]: [Vec<Number<A>>; 2],
    ) -> Result<ListGradients<A, B>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        Number<A>: On<E>,
    {
        let engine = self.engine::<Number<A>>();
        Ok((
            Both::<A, B>::list::<A::Item>(engine, lists[0].len(), a_bar)?,
            Both::<A, B>::list::<B::Item>(engine, lists[1].len(), b_bar)?,
        ))
    }

    /// Writes the cotangents of both lists to the caller's slices. Returns the sum as [`bars`](Machine::bars) does.
    fn bars_into<A, B>(
        &self,
        call: &Call<Number<A>>,
        lists: &[Column<'_, Number<A>>; 2],
        seed: &Seed<'_, Number<A>>,
        a_bar: &mut [A::Item],
        b_bar: &mut [B::Item],
    ) -> Result<f64, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        Number<A>: On<E>,
    {
        expect(Argument::GradA, lists[0].len(), a_bar.len())?;
        expect(Argument::GradB, lists[1].len(), b_bar.len())?;
        fill_whole(a_bar, |a_bar| {
            fill_whole(b_bar, |b_bar| {
                pull_into(self.engine(), call, lists, seed, [a_bar, b_bar])
            })
        })
    }
}
