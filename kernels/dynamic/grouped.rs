//! Pairs within groups, and suppression, on columns of numbers.
use super::forms::Function;
use super::rows::Rows;
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::machine::Column;
use crate::kernels::machine::Groups;
use crate::kernels::machine::found::{Best, Found, check_threshold};
use crate::kernels::machine::suppress::checked;
use crate::kernels::machine::{GroupedReduction, Reduced};
use crate::suppression::{Rules, check_groups};

/// Pairs within groups.
impl<T: Real> Function<T> {
    /// Returns every pair within a group whose result is above the threshold, as
    /// [`Cpu::above_grouped`](crate::kernels::Cpu::above_grouped).
    ///
    /// # Errors
    ///
    /// As [`above`](Function::above), and [`Error::GroupsOf`] and [`Error::Length`] for offsets.
    ///
    /// ```
    /// use geograd::kernels::Groups;
    /// use geograd::kernels::dynamic::{Rows, operation};
    /// let iou = operation("iou_aabb2").and_then(|iou| iou.value::<f64>()).expect("is listed");
    /// let boxes = [0.0, 0.0, 2.0, 2.0].repeat(3);
    /// let boxes = Rows::new(&boxes, 4);
    /// let found = iou.above_grouped(boxes, boxes, Groups::new(&[0, 1, 3], &[0, 2, 3]), 0.5)?;
    /// assert_eq!(found.len(), 2 + 2);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn above_grouped(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        groups: Groups<'_>,
        threshold: T,
    ) -> Result<Vec<Found<T>>, Error> {
        check_threshold(threshold)?;
        self.one_number()?;
        let lists = self.lists(&a, &b)?;
        let spans = self.named(groups.spans(lists.each_ref().map(Column::len)))?;
        let above = GroupedReduction::Above(threshold);
        let found = self
            .engine()
            .reduce_grouped(&self.call()?, &lists, spans, above);
        self.named(found.and_then(|found| found.founds().taken()))
    }

    /// Returns the largest result of every row within its group, as
    /// [`Cpu::row_max_grouped`](crate::kernels::Cpu::row_max_grouped).
    ///
    /// # Errors
    ///
    /// As [`row_max`](Function::row_max), and [`Error::GroupsOf`] and [`Error::Length`] for offsets.
    pub fn row_max_grouped(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<T>>>, Error> {
        self.most_grouped(&a, &b, groups, true)
    }

    /// Returns the largest result of every column within its group, as
    /// [`Cpu::column_max_grouped`](crate::kernels::Cpu::column_max_grouped).
    ///
    /// # Errors
    ///
    /// As [`row_max_grouped`](Function::row_max_grouped).
    pub fn column_max_grouped(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<T>>>, Error> {
        self.most_grouped(&a, &b, groups, false)
    }

    /// Returns the largest result of every row, or of every column, within its group.
    fn most_grouped(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        groups: Groups<'_>,
        of_rows: bool,
    ) -> Result<Vec<Option<Best<T>>>, Error> {
        self.one_number()?;
        let lists = self.lists(a, b)?;
        let spans = self.named(groups.spans(lists.each_ref().map(Column::len)))?;
        let best = GroupedReduction::Best { of_rows };
        let found = self
            .engine()
            .reduce_grouped(&self.call()?, &lists, spans, best);
        self.named(found.map(Reduced::bests_grouped))
    }
}

/// Suppression.
impl<T: Real> Function<T> {
    /// Returns the rows that no better kept row of their group suppresses, as
    /// [`Cpu::suppress_grouped`](crate::kernels::Cpu::suppress_grouped). A list without groups has the offsets
    /// `[0, length]`.
    ///
    /// # Errors
    ///
    /// As [`Cpu::suppress_grouped`](crate::kernels::Cpu::suppress_grouped); [`Error::Arguments`] and
    /// [`Error::NotOneNumber`] unless the function takes two shapes of one kind and returns one number.
    pub fn suppress(
        &self,
        shapes: Rows<'_, T>,
        offsets: &[usize],
        scores: &[T],
        rules: Rules<'_, T>,
    ) -> Result<Vec<usize>, Error> {
        self.one_number()?;
        let [column, _] = self.lists(&shapes, &shapes)?;
        checked(column.len(), scores, &rules)?;
        check_groups(Argument::A, column.len(), offsets)?;
        let kept = self
            .engine()
            .suppress(&self.call()?, &column, Some(offsets), scores, rules);
        self.named(kept)
    }
}
