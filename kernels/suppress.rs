//! Pairs of shapes of one list that overlap: what suppression starts from; and suppression that computes
//! no more of them than it needs.
use crate::Error;
use crate::error::Argument;
use crate::kernels::backend::{Backend, on_either};
use crate::kernels::cpu::all_pairs::pairs;
use crate::kernels::cpu::checked::check;
use crate::kernels::cpu::greedy::Greed;
use crate::kernels::cpu::{Cpu, Face, Single};
use crate::kernels::item::Column;
use crate::kernels::op::Runs;
use crate::kernels::real::Real;
use crate::kernels::reduce::{Found, check_threshold};
use crate::suppression::{Pair, Rules, check_rules, order};

impl<T> From<Found<T>> for Pair<T> {
    /// The same pair.
    fn from(found: Found<T>) -> Self {
        Pair {
            first: found.row,
            second: found.column,
            overlap: found.value,
        }
    }
}

impl Cpu {
    /// Every two shapes of a list whose result is above the threshold, each two once: for
    /// [`suppression`](crate::suppression). The one that comes first in the list is the first argument.
    ///
    /// # Errors
    ///
    /// As [`above`](Cpu::above).
    pub fn overlaps<A: Single, R>(
        &self,
        run: R,
        shapes: &[A],
        threshold: A::Scalar,
    ) -> Result<Vec<Pair<A::Scalar>>, Error>
    where
        R: Runs<(A, A), Out = A::Scalar>,
    {
        let found = self.above(run, shapes, shapes, threshold)?;
        let ascending = found.into_iter().filter(|pair| pair.row < pair.column);
        Ok(ascending.map(Pair::from).collect())
    }

    /// The shapes that no better one, kept itself, overlaps by more than the threshold: their places, the
    /// best first.
    ///
    /// The result is that of [`suppression::hard`](crate::suppression::hard) with all
    /// [`overlaps`](Cpu::overlaps). Only pairs with a kept shape are computed. The better one of two shapes is
    /// the first argument.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, a score that is not finite or a threshold outside
    /// `[0, 1]`; [`Error::Length`] for another number of scores or classes than of shapes.
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
    pub fn suppress<A: Single, R>(
        &self,
        run: R,
        shapes: &[A],
        scores: &[A::Scalar],
        rules: Rules<'_, A::Scalar>,
    ) -> Result<Vec<usize>, Error>
    where
        R: Runs<(A, A), Out = A::Scalar>,
        A::Scalar: crate::Scalar<Mask = bool>,
    {
        checked(shapes.len(), scores, &rules)?;
        let face = run.call()?.plan(true)?;
        let ranked = ranked(&face, shapes, scores, &rules)?;
        let pairs = pairs(self, &face, &ranked.shapes, &ranked.shapes)?;
        let kept = (A::Scalar::drivers().suppress)(&pairs, ranked.greed(&rules));
        Ok(kept.into_iter().map(|place| ranked.order[place]).collect())
    }
}

/// Checks the arguments of suppression, but for the shapes.
pub(crate) fn checked<S: Real>(
    count: usize,
    scores: &[S],
    rules: &Rules<'_, S>,
) -> Result<(), Error> {
    if scores.len() != count {
        return Err(Error::Length {
            argument: Argument::Named("scores"),
            expected: count,
            found: scores.len(),
        });
    }
    check_rules(count, rules)?;
    check_threshold(rules.overlap)
}

/// The shapes that count, the best first.
pub(crate) struct Ranked<A> {
    /// Their places in the caller's list.
    pub order: Vec<usize>,
    pub shapes: Vec<A>,
    /// Their classes, where there is more than one.
    pub classes: Option<Vec<u32>>,
}

impl<A: Single> Ranked<A> {
    /// Shapes in an order of their places.
    pub fn of(order: Vec<usize>, shapes: &[A], rules: &Rules<'_, A::Scalar>) -> Self {
        Ranked {
            shapes: order.iter().map(|&i| shapes[i]).collect(),
            classes: classes_of(&order, rules),
            order,
        }
    }
    /// The rules of suppression, with the classes of the ranked shapes.
    pub fn greed(&self, rules: &Rules<'_, A::Scalar>) -> Greed<'_, A::Scalar> {
        greed(rules, self.classes.as_deref())
    }
}

/// The classes of shapes in an order of their places, where there is more than one.
pub(crate) fn classes_of<T: Real>(order: &[usize], rules: &Rules<'_, T>) -> Option<Vec<u32>> {
    let classes = rules.classes?;
    Some(order.iter().map(|&i| classes[i]).collect())
}

/// The rules of suppression, with the classes of ranked shapes.
pub(crate) fn greed<'a, T: Real>(rules: &Rules<'_, T>, classes: Option<&'a [u32]>) -> Greed<'a, T> {
    Greed {
        threshold: rules.overlap,
        classes,
        most: rules.most,
    }
}

/// Checks shapes and sorts those that count.
pub(crate) fn ranked<A: Single>(
    face: &Face<A::Scalar>,
    shapes: &[A],
    scores: &[A::Scalar],
    rules: &Rules<'_, A::Scalar>,
) -> Result<Ranked<A>, Error> {
    // All shapes are checked, so that errors name the caller's rows.
    check(Argument::A, &face.arguments[0], &Column::of(shapes))?;
    Ok(Ranked::of(order(scores, rules.score)?, shapes, rules))
}

impl Backend<'_> {
    /// The shapes that no better one, kept itself, overlaps by more than the threshold, the best first:
    /// [`Cpu::suppress`], and the same places on a GPU.
    ///
    /// ```
    /// use geograd::kernels::{Backend, Iou};
    /// use geograd::suppression::Rules;
    /// use geograd::Obb2;
    ///
    /// let boxes = [0.0, 0.2, 3.0].map(|x| Obb2::new(x, 0.0, 2.0, 1.0, 0.0));
    /// let kept = Backend::Cpu.suppress(Iou, &boxes, &[0.6, 0.9, 0.5], Rules::above(0.5))?;
    /// assert_eq!(kept, [1, 2]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As on the CPU; [`Error::Gpu`] are the GPU's.
    pub fn suppress<A: Single<Scalar = f32>, R>(
        self,
        run: R,
        shapes: &[A],
        scores: &[f32],
        rules: Rules<'_, f32>,
    ) -> Result<Vec<usize>, Error>
    where
        R: Runs<(A, A), Out = f32>,
    {
        on_either!(self, suppress(run, shapes, scores, rules))
    }
}
