//! All pairs within groups, such as the detections and the truths of every frame: one call for all groups.
use super::GroupSpans;
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::modes::Function;
use crate::kernels::machine::found::{Best, Found, check_threshold};
use crate::kernels::machine::suppress::checked;
use crate::kernels::machine::{Column, Columns};
use crate::kernels::machine::{GroupedReduction, Machine, Number, On};
use crate::kernels::row::item::Single;
use crate::kernels::row::item::counts::expect;
use crate::suppression::{Rules, better, check_groups, check_scores};

/// Groups of two lists: group g pairs the shapes `a[g]..a[g + 1]` of the first list with `b[g]..b[g + 1]` of the
/// second.
///
/// Offsets begin at zero, never decrease and end at the length of their list. A group may be empty on either side.
///
/// ```
/// use geograd::kernels::{Cpu, Groups, Iou};
/// use geograd::Aabb2;
///
/// let square = |x| Aabb2::new(x, 0.0, x + 2.0, 2.0);
/// // Two frames: two detections and a truth, then a detection and two truths, all in one place.
/// let detections = [square(0.0), square(1.0), square(0.0)];
/// let truths = [square(0.0), square(0.0), square(9.0)];
/// let frames = Groups::new(&[0, 2, 3], &[0, 1, 3]);
/// let found = Cpu::new().above_grouped(Iou, &detections, &truths, frames, 0.5)?;
/// let places: Vec<_> = found.iter().map(|pair| (pair.row, pair.column)).collect();
/// assert_eq!(places, [(0, 0), (2, 1)]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups<'a> {
    a: &'a [usize],
    b: &'a [usize],
}

impl<'a> Groups<'a> {
    /// Creates groups from the offsets of both lists; a call checks them.
    #[must_use]
    pub const fn new(a: &'a [usize], b: &'a [usize]) -> Self {
        Groups { a, b }
    }
    /// Returns the offsets of both lists.
    #[must_use]
    pub const fn offsets(&self) -> [&'a [usize]; 2] {
        [self.a, self.b]
    }
    /// Checks the offsets against the lengths of both lists.
    pub(crate) fn spans(self, counts: [usize; 2]) -> Result<GroupSpans<'a>, Error> {
        for (k, offsets) in self.offsets().into_iter().enumerate() {
            check_groups(Argument::input(k), counts[k], offsets)?;
        }
        expect(Argument::Groups, self.a.len() - 1, self.b.len() - 1)?;
        Ok(GroupSpans {
            a: self.a,
            b: self.b,
        })
    }
}

/// Returns the indices of all scores of each group that are at least `least`, best first, and the offsets of the groups
/// among them.
pub(crate) fn ranked_groups<T: Real>(
    scores: &[T],
    offsets: &[usize],
    least: T,
) -> Result<(Vec<usize>, Vec<usize>), Error> {
    check_scores(scores)?;
    let (mut order, mut ends) = (Vec::with_capacity(scores.len()), vec![0]);
    for group in offsets.windows(2) {
        let from = order.len();
        order.extend((group[0]..group[1]).filter(|&i| !scores[i].below(least)));
        order[from..].sort_unstable_by(|&i, &j| better(scores, i, j));
        ends.push(order.len());
    }
    Ok((order, ends))
}

/// Pairs within groups. A GPU computes all groups in one call; it refuses searches
/// ([`Unrecordable::Search`](crate::Unrecordable::Search)).
impl<E: ?Sized> Machine<E> {
    /// Returns every pair within a group whose result is above the threshold, ordered by row and then by column:
    /// [`above`](Machine::above) of every group, with indices in the whole lists.
    ///
    /// # Errors
    ///
    /// As [`above`](Machine::above); [`Error::GroupsOf`] for offsets that decrease or do not cover their list, and
    /// [`Error::Length`] for lists of different numbers of groups.
    pub fn above_grouped<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        groups: Groups<'_>,
        threshold: Number<A>,
    ) -> Result<Vec<Found<Number<A>>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        check_threshold(threshold)?;
        let (call, lists) = (run.call()?, [a.list_of_shapes(), b.list_of_shapes()]);
        let spans = groups.spans(lists.each_ref().map(Column::len))?;
        let above = GroupedReduction::Above(threshold);
        let found = self.engine().reduce_grouped(&call, &lists, spans, above)?;
        found.founds().taken()
    }

    /// Returns the largest result of every row within its group, and its column in the whole list; the first of equal
    /// ones. `None` for a row whose group has no columns.
    ///
    /// # Errors
    ///
    /// As [`above_grouped`](Machine::above_grouped), except those of a threshold.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Groups, Iou};
    /// use geograd::Aabb2;
    /// let square = |x| Aabb2::new(x, 0.0, x + 2.0, 2.0);
    /// let groups = Groups::new(&[0, 1, 2], &[0, 0, 2]);
    /// let best = Cpu::new().row_max_grouped(Iou, &[square(0.0); 2], &[square(5.0), square(0.0)], groups)?;
    /// assert_eq!(best[0], None);
    /// assert_eq!(best[1].map(|best| best.index), Some(1));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn row_max_grouped<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<Number<A>>>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        self.most_grouped(&run, &a, &b, groups, true)
    }

    /// Returns the largest result of every column within its group, and its row in the whole list; the first of equal
    /// ones. `None` for a column whose group has no rows.
    ///
    /// # Errors
    ///
    /// As [`row_max_grouped`](Machine::row_max_grouped).
    pub fn column_max_grouped<A, B, R>(
        &self,
        run: R,
        a: A,
        b: B,
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<Number<A>>>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        self.most_grouped(&run, &a, &b, groups, false)
    }

    /// Returns the largest result of every row, or of every column, within its group.
    fn most_grouped<A, B, R>(
        &self,
        run: &R,
        a: &A,
        b: &B,
        groups: Groups<'_>,
        of_rows: bool,
    ) -> Result<Vec<Option<Best<Number<A>>>>, Error>
    where
        A: Columns<Item: Single>,
        B: Columns<Item: Single<Scalar = Number<A>>>,
        R: Function<(A::Item, B::Item), Out = Number<A>>,
        Number<A>: On<E>,
    {
        let (call, lists) = (run.call()?, [a.list_of_shapes(), b.list_of_shapes()]);
        let spans = groups.spans(lists.each_ref().map(Column::len))?;
        let best = GroupedReduction::Best { of_rows };
        let found = self.engine().reduce_grouped(&call, &lists, spans, best)?;
        Ok(found.bests_grouped())
    }
}

/// Suppression within groups.
impl<E: ?Sized> Machine<E> {
    /// Returns the shapes that no better kept shape of their group overlaps by more than the threshold: their indices
    /// in the whole list, group by group, in a group best first. The rules limit the number of kept shapes of each
    /// group. A GPU computes group after group.
    ///
    /// # Errors
    ///
    /// As [`suppress`](Machine::suppress), and [`Error::GroupsOf`] for offsets that decrease or do not cover the list.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Iou};
    /// use geograd::suppression::Rules;
    /// use geograd::Aabb2;
    /// let boxes = [Aabb2::new(0.0, 0.0, 2.0, 2.0); 3];
    /// let kept = Cpu::new().suppress_grouped(Iou, &boxes, &[0, 2, 3], &[0.3, 0.9, 0.1], Rules::above(0.5))?;
    /// assert_eq!(kept, [1, 2]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn suppress_grouped<A: Single, R>(
        &self,
        run: R,
        shapes: &[A],
        offsets: &[usize],
        scores: &[A::Scalar],
        rules: Rules<'_, A::Scalar>,
    ) -> Result<Vec<usize>, Error>
    where
        R: Function<(A, A), Out = A::Scalar>,
        A::Scalar: On<E>,
    {
        checked(shapes.len(), scores, &rules)?;
        check_groups(Argument::A, shapes.len(), offsets)?;
        let list = Column::of(shapes);
        let groups = Some(offsets);
        self.engine()
            .suppress(&run.call()?, &list, groups, scores, rules)
    }
}
