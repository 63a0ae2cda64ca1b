//! The smallest axis-aligned box around a piece.
use super::bezier::Cubic2;
use super::circle_arc::Arc2;
use super::curve_nearest::unit_of;
use super::curve_piece::CurvePiece;
use crate::{Aabb2, Scalar, Vec2};
use std::f64::consts::{FRAC_PI_2, PI};

impl<S: Scalar<Mask = bool>> CurvePiece<S> {
    /// Returns the smallest axis-aligned box around the piece: around its ends and the places where it turns back along an
    /// axis.
    ///
    /// Kinks: two places that share a bound, which share its derivative.
    ///
    /// ```
    /// use geograd::{Aabb2, Vec2, curve::{CurvePiece, Quadratic2}};
    /// let hill = Quadratic2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 2.0), Vec2::new(2.0, 0.0));
    /// assert_eq!(CurvePiece::from(hill).bounding(), Aabb2::new(0.0, 0.0, 2.0, 1.0));
    /// ```
    #[must_use]
    pub fn bounding(self) -> Aabb2<S> {
        let (from, to) = (self.start(), self.end());
        let (mut min, mut max) = (from.least(to), from.most(to));
        let wide = self.widened();
        for axis in [0, 1] {
            turns(wide, axis, &mut |t| {
                if t > 0.0 && t < 1.0 {
                    let found = self.turn(axis, t);
                    let (low, high) = match axis {
                        0 => (&mut min.x, &mut max.x),
                        _ => (&mut min.y, &mut max.y),
                    };
                    *low = low.least(found);
                    *high = high.most(found);
                }
            });
        }
        Aabb2 {
            min: min.canonical(),
            max: max.canonical(),
        }
    }
    /// Returns the coordinate at a turn, whose parameter follows the piece by a Newton step.
    fn turn(self, axis: usize, t: f64) -> S {
        let of = |v: Vec2<S>| if axis == 0 { v.x } else { v.y };
        let mut t = S::lit(t);
        let slope = of(self.derivative(t));
        let unit = S::from_primal(unit_of([slope, of(self.second_derivative(t))]));
        let bend = (of(self.second_derivative(t)) * unit).primal();
        // A flat turn stays: its coordinate has no second derivative.
        if bend.magnitude().above(S::Primal::lit(1e-10)) {
            let change = (slope - S::from_primal(slope.primal())) * unit;
            t -= change.over(S::from_primal(bend));
        }
        of(self.point(t))
    }
}

/// Calls something with the parameters at which a piece may turn back along an axis.
fn turns(piece: CurvePiece<f64>, axis: usize, found: &mut impl FnMut(f64)) {
    match piece {
        CurvePiece::Line(_) => {}
        CurvePiece::Quadratic(curve) => of_cubic(curve.elevated(), axis, found),
        CurvePiece::Cubic(curve) => of_cubic(curve, axis, found),
        CurvePiece::Arc(arc) => of_arc(arc, axis, found),
    }
}

fn of_cubic(curve: Cubic2<f64>, axis: usize, found: &mut impl FnMut(f64)) {
    let [a, b, c, d] = curve.points.map(|p| if axis == 0 { p.x } else { p.y });
    let unit = unit_of([b - a, c - b, d - c]);
    let slopes = [b - a, c - b, d - c].map(|x| x * unit);
    if slopes.iter().all(|x| x.is_finite() && *x >= 0.0) || slopes.iter().all(|x| *x <= 0.0) {
        return;
    }
    // The slope is `c + 2bt + at²`. One that is zero twice within a rounding has no turn.
    let [first, middle, last] = slopes;
    let (a, b, c) = ((last - middle) - (middle - first), middle - first, first);
    let square = b * b - a * c;
    if square >= 0.0 {
        let sum = -(b + square.sqrt().copysign(b));
        found(sum / a);
        found(c / sum);
    }
}

fn of_arc(arc: Arc2<f64>, axis: usize, found: &mut impl FnMut(f64)) {
    let along = arc.to - arc.from;
    let half = 2.0 * arc.quarter();
    if half == 0.0 || (along.x == 0.0 && along.y == 0.0) {
        return;
    }
    // The direction turns from `−half` to `half` of the chord's.
    let first = if axis == 0 { FRAC_PI_2 } else { 0.0 } - along.angle();
    for turn in [-2.0, -1.0, 0.0, 1.0, 2.0] {
        found(0.5 + 0.5 * ((first + turn * PI) / half));
    }
}
