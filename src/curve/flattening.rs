//! Chords that follow a piece to a tolerance.
use super::curve_nearest::unit_of;
use super::curve_piece::{CurvePiece, tolerable};
use crate::error::{Argument, Error};
use crate::{Scalar, Vec2};

/// The most chords of one piece.
const MOST: f64 = (1_u32 << 28) as f64;

impl<S: Scalar<Mask = bool>> CurvePiece<S> {
    /// Returns how many chords, at equal steps of the parameter, follow the piece to within a tolerance: at least one.
    ///
    /// A function whose second derivative is at most `M` is within `M h²/8` of its chord over a step `h` (the error of
    /// linear interpolation), so `√(M/(8 · tolerance))` chords suffice. `M` is the largest second derivative: of a Bézier
    /// curve the larger one of both ends, of an arc the same everywhere (Wang 1984). Every point of the chords is so near
    /// to the point of the same parameter, and the other way round.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a tolerance that is not positive and finite, and for a piece that is not finite;
    /// [`Error::TooLarge`] for more than 2²⁸ chords.
    ///
    /// ```
    /// use geograd::{Vec2, curve::{Arc2, CurvePiece}};
    /// let bow = CurvePiece::from(Arc2::new(Vec2::new(-1.0_f64, 0.0), Vec2::new(1.0, 0.0), 1.0));
    /// assert_eq!(bow.chords(0.01)?, 12);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn chords(self, tolerance: f64) -> Result<usize, Error> {
        tolerable(tolerance).map_err(|flaw| Error::Invalid {
            argument: Argument::Named("tolerance"),
            item: 0,
            flaw,
        })?;
        let wide = self.widened();
        crate::error::Validate::validate(&wide).map_err(|flaw| Error::Invalid {
            argument: Argument::Shape,
            item: 0,
            flaw,
        })?;
        let bends = [0.0, 1.0].map(|t| wide.second_derivative(t));
        let unit = unit_of(bends.map(|bend| bend.x.abs().max(bend.y.abs())));
        let most = bends
            .map(|bend| (bend * unit).length())
            .into_iter()
            .fold(0.0, f64::max);
        // A few roundings more, which the points have.
        let count = ((most * (1.0 + 1e-12)).sqrt() / (8.0 * unit).sqrt()) / tolerance.sqrt();
        match count.ceil().max(1.0) {
            count if count <= MOST => Ok(count as usize),
            _ => Err(Error::TooLarge),
        }
    }
    /// Adds the ends of so many chords of equal steps of the parameter, all but the start of the first one.
    pub(super) fn extend_by_chords(self, count: usize, to: &mut Vec<Vec2<S>>) {
        let all = count.max(1);
        to.extend((1..all).map(|k| self.point(S::lit(k as f64 / all as f64))));
        to.push(self.end());
    }
    /// Returns the vertices of so many chords of equal steps of the parameter, with any derivatives.
    #[must_use]
    pub fn flattened(self, count: usize) -> Vec<Vec2<S>> {
        let mut all = vec![self.start()];
        self.extend_by_chords(count, &mut all);
        all
    }
}
