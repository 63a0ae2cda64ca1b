//! The nearest of many: calls for the least results of all pairs.
use super::all_pairs::list_call;
use super::least::{best_of, least_grouped, least_of, least_of_all, least_pulled, side};
use super::{Best, Column, Columns, Found, Groups, Least, Machine, Number, On};
use crate::error::Error;
use crate::kernels::call::modes::Function;
use crate::kernels::row::item::rows::fill_whole;
use crate::kernels::row::item::{Item, Single};

/// The least result of every row or column, up to a cap.
type Nearest<A> = Vec<Option<Best<Number<A>>>>;

/// Gradients of both lists.
type Bars<A, B> = (Vec<<A as Columns>::Item>, Vec<<B as Columns>::Item>);

/// Returns the results of a function that adds gradients to the numbers of both lists, and these gradients.
fn placed<A, B, R>(
    lists: &[Column<'_, Number<A>>; 2],
    run: impl FnOnce([&mut [Number<A>]; 2]) -> Result<R, Error>,
) -> Result<(R, Bars<A, B>), Error>
where
    A: Columns<Item: Single>,
    B: Columns<Item: Single<Scalar = Number<A>>>,
{
    let mut by_a = A::Item::many(lists[0].len());
    let mut by_b = B::Item::many(lists[1].len());
    let made = fill_whole(&mut by_a, |a| fill_whole(&mut by_b, |b| run([a, b])))?;
    Ok((made, (by_a, by_b)))
}

/// Defines calls with two lists: the name, further arguments, the result, and the body from machine, call and lists.
macro_rules! calls {
    ($(
        $(#[$doc:meta])*
        $name:ident($($arg:ident: $type:ty),*) -> $out:ty
        = |$machine:ident, $call:ident, $lists:ident| $body:expr;
    )*) => {
        /// The nearest of many. Columns are slices or arrays on the machine; results are in the memory of the program.
        ///
        /// A batch computes few of the pairs if it knows a lower bound of their results: a row of a distance has one
        /// ([`LowerBound`](crate::kernels::op::LowerBound)) from axis-aligned boxes around its shapes, a function of
        /// one's own if it [says so](crate::kernels::at_least). Without one it computes all pairs. Results have the
        /// bits of a search through all pairs, for any number of threads.
        ///
        /// Boxes around an array on the machine are kept with it: obstacles that many calls share belong there.
        ///
        /// Only finite results count. Of equal results the first counts, in the order of rows and then of columns;
        /// gradients share them: of `k` equal pairs each has one `k`-th. A cap of infinity is none. Pairs that a lower
        /// bound shows to be beyond the cap are not computed.
        ///
        /// A GPU computes all pairs; it refuses searches ([`Unrecordable::Search`](crate::Unrecordable::Search)), and
        /// gradients of arrays that stay on it. In its gradients the first of equal pairs has the whole derivative.
        impl<E: ?Sized> Machine<E> { $(
            $(#[$doc])*
            pub fn $name<A, B, R>(&self, run: R, a: A, b: B, $($arg: $type),*) -> Result<$out, Error>
            where
                A: Columns<Item: Single>,
                B: Columns<Item: Single<Scalar = Number<A>>>,
                R: Function<(A::Item, B::Item), Out = Number<A>>,
                Number<A>: On<E>,
            {
                let ($call, $lists) = list_call(&run, &a, &b)?;
                let $machine = self.engine();
                $body
            }
        )* }
    };
}

calls! {
    /// Returns the least result of every row and its column; infinity where no result is finite.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::NoLargest`] for rows without columns.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Distance};
    /// use geograd::{Circle, Vec2};
    /// let masts = [Circle::new(Vec2::new(9.0_f64, 0.0), 1.0), Circle::new(Vec2::new(0.0, 5.0), 1.0)];
    /// let best = Cpu::new().row_min(Distance, &[Vec2::new(0.0, 0.0)], &masts)?;
    /// assert_eq!((best[0].value, best[0].index), (4.0, 1));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    row_min() -> Vec<Best<Number<A>>> = |machine, call, lists| {
        least_of_all(machine, &call, &lists, true)
    };
    /// Returns the least result of every column and its row, as [`row_min`](Machine::row_min).
    ///
    /// # Errors
    ///
    /// As [`row_min`](Machine::row_min), for columns without rows.
    column_min() -> Vec<Best<Number<A>>> = |machine, call, lists| {
        least_of_all(machine, &call, &lists, false)
    };
    /// Returns the least result of every row and its column, if it is at most `cap`.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Invalid`] for a cap that is NaN.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Distance};
    /// use geograd::{Circle, Vec2};
    /// let masts = [Circle::new(Vec2::new(9.0_f64, 0.0), 1.0), Circle::new(Vec2::new(0.0, 5.0), 1.0)];
    /// let carts = [Vec2::new(0.0, 0.0), Vec2::new(0.0, -90.0)];
    /// let near = Cpu::new().row_min_within(Distance, &carts, &masts, 10.0)?;
    /// let near: Vec<_> = near.iter().map(|best| best.map(|best| best.index)).collect();
    /// assert_eq!(near, [Some(1), None]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    row_min_within(cap: Number<A>) -> Nearest<A> = |machine, call, lists| {
        let found = least_of(machine, &call, &lists, side(true, cap))?;
        Ok(found.best.into_iter().map(|best| best_of(best, true)).collect())
    };
    /// Returns the least result of every column and its row, if it is at most `cap`.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within).
    column_min_within(cap: Number<A>) -> Nearest<A> = |machine, call, lists| {
        let found = least_of(machine, &call, &lists, side(false, cap))?;
        Ok(found.best.into_iter().map(|best| best_of(best, false)).collect())
    };
    /// Returns the pair with the least result of all, if it is at most `cap`.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within).
    ///
    /// ```
    /// use geograd::kernels::{Cpu, SignedDistance};
    /// use geograd::{Capsule3, Sphere, Vec3};
    /// let at = |x, z| Vec3::new(x, 0.0, z);
    /// let links = [Capsule3::new(at(0.0, 0.0), at(0.0, 1.0), 0.1), Capsule3::new(at(0.0, 1.0), at(1.0, 1.0), 0.1)];
    /// let balls = [Sphere::new(at(3.0, 1.0), 0.5_f64), Sphere::new(at(-2.0, 0.0), 0.5)];
    /// let cpu = Cpu::new();
    /// let nearest = cpu.nearest(SignedDistance, &links, &balls, f64::INFINITY)?;
    /// assert_eq!(nearest.map(|pair| (pair.row, pair.column)), Some((0, 1)));
    /// assert_eq!(cpu.nearest(SignedDistance, &links, &balls, 1.0)?, None);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    nearest(cap: Number<A>) -> Option<Found<Number<A>>> = |machine, call, lists| {
        let found = least_of(machine, &call, &lists, Least::Groups(cap))?;
        Ok(found.best.into_iter().next().flatten())
    };
    /// Returns every pair whose result is below the limit, ordered by row and then by column.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Invalid`] for a limit that is not finite.
    below(limit: Number<A>) -> Vec<Found<Number<A>>> = |machine, call, lists| {
        Ok(least_of(machine, &call, &lists, Least::Below(limit))?.pairs)
    };
    /// Returns the number of pairs whose result is below the limit.
    ///
    /// # Errors
    ///
    /// As [`below`](Machine::below).
    count_below(limit: Number<A>) -> u64 = |machine, call, lists| {
        Ok(least_of(machine, &call, &lists, Least::Below(limit))?.pairs.len() as u64)
    };
    /// Returns the least result of every row within its group and its column in the whole list, if it is at most `cap`.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within); [`Error::GroupsOf`] for offsets that decrease or do not cover
    /// their list, and [`Error::Length`] for lists of different numbers of groups.
    row_min_grouped(groups: Groups<'_>, cap: Number<A>) -> Nearest<A> = |machine, call, lists| {
        let found = least_grouped(machine, &call, &lists, groups, side(true, cap))?;
        Ok(found.best.into_iter().map(|best| best_of(best, true)).collect())
    };
    /// Returns the least result of every column within its group and its row in the whole list, if it is at most `cap`.
    ///
    /// # Errors
    ///
    /// As [`row_min_grouped`](Machine::row_min_grouped).
    column_min_grouped(groups: Groups<'_>, cap: Number<A>) -> Nearest<A> = |machine, call, lists| {
        let found = least_grouped(machine, &call, &lists, groups, side(false, cap))?;
        Ok(found.best.into_iter().map(|best| best_of(best, false)).collect())
    };
    /// Returns the pair with the least result of every group, if it is at most `cap`, with indices in the whole lists.
    ///
    /// # Errors
    ///
    /// As [`row_min_grouped`](Machine::row_min_grouped).
    nearest_grouped(groups: Groups<'_>, cap: Number<A>) -> Vec<Option<Found<Number<A>>>> = |machine, call, lists| {
        Ok(least_grouped(machine, &call, &lists, groups, Least::Groups(cap))?.best)
    };
    /// Returns every pair within a group whose result is below the limit, ordered by row and then by column.
    ///
    /// # Errors
    ///
    /// As [`row_min_grouped`](Machine::row_min_grouped), and [`Error::Invalid`] for a limit that is not finite.
    below_grouped(groups: Groups<'_>, limit: Number<A>) -> Vec<Found<Number<A>>> = |machine, call, lists| {
        Ok(least_grouped(machine, &call, &lists, groups, Least::Below(limit))?.pairs)
    };
    /// Returns [`row_min_within`](Machine::row_min_within) and the gradient of the sum of the results: that of a row is
    /// the gradient of its own result, that of a column adds up the rows that are nearest to it.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within).
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Distance};
    /// use geograd::{Circle, Vec2};
    /// let masts = [Circle::new(Vec2::new(9.0_f64, 0.0), 1.0), Circle::new(Vec2::new(0.0, 5.0), 1.0)];
    /// let carts = [Vec2::new(0.0, 0.0)];
    /// let (near, by_carts, by_masts) = Cpu::new().row_min_grad(Distance, &carts, &masts, f64::INFINITY)?;
    /// assert_eq!((near[0].unwrap().value, by_carts[0]), (4.0, Vec2::new(0.0, -1.0)));
    /// assert_eq!((by_masts[0].radius, by_masts[1].radius), (0.0, -1.0));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    row_min_grad(cap: Number<A>) -> (Nearest<A>, Vec<A::Item>, Vec<B::Item>) = |machine, call, lists| {
        let wanted = side(true, cap);
        let (best, (a_bar, b_bar)) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, None, wanted, None, bars)
        })?;
        Ok((best.into_iter().map(|best| best_of(best, true)).collect(), a_bar, b_bar))
    };
    /// Returns [`column_min_within`](Machine::column_min_within) and the gradient of the sum of the results.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within).
    column_min_grad(cap: Number<A>) -> (Nearest<A>, Vec<A::Item>, Vec<B::Item>) = |machine, call, lists| {
        let wanted = side(false, cap);
        let (best, (a_bar, b_bar)) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, None, wanted, None, bars)
        })?;
        Ok((best.into_iter().map(|best| best_of(best, false)).collect(), a_bar, b_bar))
    };
    /// Returns [`nearest`](Machine::nearest) and the gradient of its result.
    ///
    /// # Errors
    ///
    /// As [`nearest`](Machine::nearest).
    nearest_grad(cap: Number<A>) -> (Option<Found<Number<A>>>, Vec<A::Item>, Vec<B::Item>) = |machine, call, lists| {
        let wanted = Least::Groups(cap);
        let (best, (a_bar, b_bar)) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, None, wanted, None, bars)
        })?;
        Ok((best.into_iter().next().flatten(), a_bar, b_bar))
    };
    /// Returns the adjoint of [`row_min_within`](Machine::row_min_within): derivatives of the sum of `upstream[i]` times
    /// the result of row `i`. Rows without a result or with an upstream of zero are not differentiated.
    ///
    /// # Errors
    ///
    /// As [`row_min_within`](Machine::row_min_within), and for an upstream of another length or one that is not finite.
    row_min_vjp(cap: Number<A>, upstream: &[Number<A>]) -> Bars<A, B> = |machine, call, lists| {
        let wanted = side(true, cap);
        let (_, bars) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, None, wanted, Some(upstream), bars)
        })?;
        Ok(bars)
    };
    /// Returns the adjoint of [`column_min_within`](Machine::column_min_within).
    ///
    /// # Errors
    ///
    /// As [`row_min_vjp`](Machine::row_min_vjp).
    column_min_vjp(cap: Number<A>, upstream: &[Number<A>]) -> Bars<A, B> = |machine, call, lists| {
        let wanted = side(false, cap);
        let (_, bars) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, None, wanted, Some(upstream), bars)
        })?;
        Ok(bars)
    };
    /// Returns the adjoint of [`nearest_grouped`](Machine::nearest_grouped): derivatives of the sum of `upstream[g]`
    /// times the result of group `g`.
    ///
    /// # Errors
    ///
    /// As [`nearest_grouped`](Machine::nearest_grouped), and as [`row_min_vjp`](Machine::row_min_vjp).
    nearest_grouped_vjp(groups: Groups<'_>, cap: Number<A>, upstream: &[Number<A>]) -> Bars<A, B> = |machine, call, lists| {
        let wanted = Least::Groups(cap);
        let (_, bars) = placed::<A, B, _>(&lists, |bars| {
            least_pulled(machine, &call, &lists, Some(groups), wanted, Some(upstream), bars)
        })?;
        Ok(bars)
    };
}
