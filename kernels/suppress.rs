//! Pairs of shapes of one list that overlap: what suppression starts from; and suppression that computes
//! no more of them than it needs.
use crate::Error;
use crate::error::Argument;
use crate::kernels::cpu::all_pairs::pairs;
use crate::kernels::cpu::checked::check;
use crate::kernels::cpu::greedy::Greed;
use crate::kernels::cpu::{Cpu, Single};
use crate::kernels::op::{Ask, Runs};
use crate::kernels::real::Real;
use crate::kernels::reduce::{Found, check_threshold};
use crate::kernels::row::Column;
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
    /// [`suppression`](crate::suppression). Of the two the one that comes first in the list is the first
    /// argument.
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
    /// What [`suppression::hard`](crate::suppression::hard) does with all [`overlaps`](Cpu::overlaps), but
    /// only pairs are computed of which one was kept. Of two shapes the better one is the first
    /// argument.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, a score that is not finite or a threshold outside
    /// `[0, 1]`; [`Error::Length`] for another number of scores or classes than of shapes.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, IouObb2};
    /// use geograd::suppression::Rules;
    /// use geograd::Obb2;
    ///
    /// let boxes = [0.0, 0.2, 3.0].map(|x| Obb2::new(x, 0.0, 2.0, 1.0, 0.0_f32));
    /// let scores = [0.6, 0.9, 0.5];
    /// let kept = Cpu::new().suppress(IouObb2, &boxes, &scores, Rules::above(0.5))?;
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
        if scores.len() != shapes.len() {
            return Err(Error::Length {
                argument: Argument::Named("scores"),
                expected: shapes.len(),
                found: scores.len(),
            });
        }
        check_rules(shapes.len(), &rules)?;
        check_threshold(rules.overlap)?;
        let face = run.face(Ask::PAIRS)?;
        // Of all of them, so that errors name the caller's rows.
        check(Argument::A, &face.arguments[0], &Column::of(shapes))?;
        let order = order(scores, rules.score)?;
        let sorted: Vec<A> = order.iter().map(|&i| shapes[i]).collect();
        let classes: Option<Vec<u32>> = rules
            .classes
            .map(|classes| order.iter().map(|&i| classes[i]).collect());
        let greed = Greed {
            threshold: rules.overlap,
            classes: classes.as_deref(),
            most: rules.most,
        };
        let pairs = pairs(self, &face, &sorted, &sorted)?;
        let kept = (A::Scalar::drivers().suppress)(&pairs, greed);
        Ok(kept.into_iter().map(|place| order[place]).collect())
    }
}
