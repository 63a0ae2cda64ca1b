//! The nearest of many, on columns of numbers.
use super::forms::Function;
use super::rows::Rows;
use crate::Real;
use crate::error::Error;
use crate::kernels::machine::least::{least_grouped, least_of, least_of_all, least_pulled};
use crate::kernels::machine::{Best, Column, Found, Groups, Least, LeastPairs};
use crate::kernels::row::limits::LowerBound;

/// The least results, and the derivatives of their sum by both lists.
type LeastBars<T> = (Vec<Option<Found<T>>>, Vec<T>, Vec<T>);

/// The nearest of many.
impl<T: Real> Function<T> {
    /// Returns this function with a lower bound of its result, as [`at_least`](crate::kernels::at_least).
    #[must_use]
    pub fn at_least(&self, lower: LowerBound) -> Self {
        Function {
            lower: Some(lower),
            ..self.clone()
        }
    }

    /// Returns the least result of every row of `a` and its row of `b`, as
    /// [`Cpu::row_min`](crate::kernels::Cpu::row_min).
    ///
    /// # Errors
    ///
    /// As [`row_max`](Function::row_max).
    ///
    /// ```
    /// use geograd::kernels::dynamic::{Rows, operation};
    /// let gap = operation("distance_points").and_then(|gap| gap.value::<f64>()).expect("is listed");
    /// let (a, b) = ([0.0, 0.0], [9.0, 0.0, 0.0, 4.0]);
    /// assert_eq!(gap.row_min(Rows::new(&a, 2), Rows::new(&b, 2))?[0].index, 1);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn row_min(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<Best<T>>, Error> {
        self.of_lists(&a, &b, |engine, call, lists| {
            least_of_all(engine, call, lists, true)
        })
    }

    /// Returns the least result of every row of `b` and its row of `a`, as
    /// [`Cpu::column_min`](crate::kernels::Cpu::column_min).
    ///
    /// # Errors
    ///
    /// As [`row_min`](Function::row_min).
    pub fn column_min(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<Best<T>>, Error> {
        self.of_lists(&a, &b, |engine, call, lists| {
            least_of_all(engine, call, lists, false)
        })
    }

    /// Searches for the least results of all pairs, or of those within groups, as
    /// [`Cpu::row_min_within`](crate::kernels::Cpu::row_min_within), [`Cpu::nearest`](crate::kernels::Cpu::nearest),
    /// [`Cpu::below`](crate::kernels::Cpu::below) and their kin.
    ///
    /// # Errors
    ///
    /// As [`row_min`](Function::row_min); [`Error::GroupsOf`] and [`Error::Length`] for offsets, and
    /// [`Error::Invalid`] for a cap that is NaN or a limit that is not finite.
    pub fn least(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        groups: Option<Groups<'_>>,
        wanted: Least<T>,
    ) -> Result<LeastPairs<T>, Error> {
        self.of_lists(&a, &b, |engine, call, lists| match groups {
            Some(groups) => least_grouped(engine, call, lists, groups, wanted),
            None => least_of(engine, call, lists, wanted),
        })
    }

    /// Searches as [`least`](Function::least) for the least of rows, columns or groups. Returns it, and the derivatives
    /// of the sum of the results by both lists, each result times its number of `upstream`, or one.
    ///
    /// # Errors
    ///
    /// As [`least`](Function::least), and for an upstream of another length or one that is not finite.
    pub fn least_grad(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        groups: Option<Groups<'_>>,
        wanted: Least<T>,
        upstream: Option<&[T]>,
    ) -> Result<LeastBars<T>, Error> {
        let (best, [a_bar, b_bar]) = self.of_lists(&a, &b, |engine, call, lists| {
            let zeros = |list: &Column<'_, T>| vec![T::default(); list.len() * list.fields];
            let mut bars = lists.each_ref().map(zeros);
            let [a, b] = &mut bars;
            let best = least_pulled(engine, call, lists, groups, wanted, upstream, [a, b])?;
            Ok((best, bars))
        })?;
        Ok((best, a_bar, b_bar))
    }
}
