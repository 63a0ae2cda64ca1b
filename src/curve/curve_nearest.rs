//! The place of a curve that is nearest to a point, and the distance.
use super::bernstein;
use super::bezier::{Cubic2, Quadratic2};
use super::circle_arc::Arc2;
use super::curve_piece::CurvePiece;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::{Scalar, Vec2};

/// The place of a curve that a search found: a record, whose replay gives the point with derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePlace {
    /// The piece of the path, from zero; zero for a piece alone.
    pub piece: usize,
    /// The parameter on that piece, from 0 to 1: a hint to the replay.
    pub parameter: f64,
    /// `true` where the way to the point is perpendicular to the curve, so that the place moves along it; `false` for an end,
    /// which stays.
    pub is_inside: bool,
}

impl<S: Scalar<Mask = bool>> CurvePiece<S> {
    /// Returns the place that is nearest to a point, of all places of the piece; of equally near ones the first one.
    ///
    /// The zeros of the derivative of the squared distance, a polynomial of degree five for a cubic curve, are isolated by
    /// signs of coefficients, so that none is missed. A piece or a point that is not finite has the start.
    ///
    /// ```
    /// use geograd::{Vec2, curve::{Cubic2, CurvePiece}};
    /// let at = |x: f64, y| Vec2::new(x, y);
    /// let arch = CurvePiece::from(Cubic2::new(at(0.0, 0.0), at(0.0, 4.0), at(4.0, 4.0), at(4.0, 0.0)));
    /// let place = arch.closest(at(2.0, 5.0));
    /// assert!((place.parameter - 0.5).abs() < 1e-15 && place.is_inside);
    /// assert!(!arch.closest(at(9.0, -1.0)).is_inside);
    /// ```
    #[must_use]
    pub fn closest(self, point: Vec2<S>) -> CurvePlace {
        let wide = |x: S| x.widened().unwrap_or(f64::NAN);
        closest_of(self.widened(), Vec2::new(wide(point.x), wide(point.y))).0
    }
    /// Returns the point at a place that a [search](Self::closest) found, with the derivatives of the nearest point.
    ///
    /// One Newton step with plain slopes gives the parameter its first derivatives, a second one its second derivatives.
    /// The place jumps at the curve's centre of curvature; a replay there keeps it.
    #[must_use]
    pub fn closest_replay(self, point: Vec2<S>, place: CurvePlace) -> Vec2<S> {
        match (place.is_inside, place.parameter) {
            (false, 0.0) => self.start(),
            (false, 1.0) => self.end(),
            _ => self.point(self.parameter(point, place)),
        }
    }
    /// Returns the distance of a point from the place that a search found, with derivatives.
    #[must_use]
    pub fn distance_replay(self, point: Vec2<S>, place: CurvePlace) -> S {
        self.closest_replay(point, place).distance(point)
    }
    /// Returns the distance of a point, at least 0.
    ///
    /// Kinks: two places that are equally near, of which the first one counts, and distance zero, with derivative zero.
    #[must_use]
    pub fn distance(self, point: Vec2<S>) -> S {
        self.distance_replay(point, self.closest(point))
    }
    fn parameter(self, point: Vec2<S>, place: CurvePlace) -> S {
        let t = S::lit(place.parameter);
        if !place.is_inside {
            return t;
        }
        let at = |t: S| [self.point(t), self.derivative(t), self.second_derivative(t)];
        moving(at, point, t)
    }
}

/// Returns a parameter, at which the way from a point to a curve is perpendicular to it, with the derivatives of that
/// place, given the curve's point and both derivatives at a parameter.
fn moving<S: Scalar>(at: impl Fn(S) -> [Vec2<S>; 3], point: Vec2<S>, mut t: S) -> S {
    // Ratios of slopes below this are rounding.
    const LEVEL: f64 = 1e-10;
    for _ in 0..2 {
        let [on_curve, along, bend] = at(t);
        let unit: S = scale_of(largest([along.x, along.y]));
        let (away, along, bend) = ((on_curve - point) * unit, along * unit, bend * unit);
        let (square, turn) = (along.dot(along), away.dot(bend));
        let slope = (square + turn).primal();
        let size = square.primal() + turn.primal().magnitude();
        let clear = slope.above(size * S::Primal::lit(LEVEL));
        let slope = S::from_primal(S::Primal::select(clear, slope, S::Primal::one()));
        let change = away.dot(along).with_primal(S::Primal::zero()).over(slope);
        t -= S::select(clear, change, S::zero());
    }
    t
}

/// The record of a search for the nearest place of a curve: an end, or a place between both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CurveSpot {
    /// At the start, which stays.
    Start,
    /// At the end, which stays.
    End,
    /// Between both, where it moves.
    Inside,
}

/// A curve by a parameter, from 0 at its start to 1 at its end.
pub(crate) trait Parametric<S: Scalar>: Copy {
    /// Returns the curve's point and both derivatives at a parameter.
    fn at(self, t: S) -> [Vec2<S>; 3];
    /// Returns the first and the last point.
    fn ends(self) -> [Vec2<S>; 2];
}

impl<S: Scalar> Parametric<S> for Quadratic2<S> {
    fn at(self, t: S) -> [Vec2<S>; 3] {
        [self.point(t), self.derivative(t), self.second_derivative()]
    }
    fn ends(self) -> [Vec2<S>; 2] {
        [self.points[0], self.points[2]]
    }
}

impl<S: Scalar> Parametric<S> for Cubic2<S> {
    fn at(self, t: S) -> [Vec2<S>; 3] {
        [self.point(t), self.derivative(t), self.second_derivative(t)]
    }
    fn ends(self) -> [Vec2<S>; 2] {
        [self.points[0], self.points[3]]
    }
}

impl<S: Scalar> Parametric<S> for Arc2<S> {
    fn at(self, t: S) -> [Vec2<S>; 3] {
        [self.point(t), self.derivative(t), self.second_derivative(t)]
    }
    fn ends(self) -> [Vec2<S>; 2] {
        [self.from, self.to]
    }
}

/// Returns where on a curve the nearest place to a point is, and its parameter.
pub(crate) fn nearest_spot<S: Scalar<Mask = bool>>(
    curve: CurvePiece<S>,
    point: Vec2<S>,
) -> (CurveSpot, S) {
    let place = curve.closest(point);
    let spot = match (place.is_inside, place.parameter) {
        (true, _) => CurveSpot::Inside,
        (false, 0.0) => CurveSpot::Start,
        _ => CurveSpot::End,
    };
    (spot, S::lit(place.parameter))
}

/// Returns the point of a curve that [`nearest_spot`] found, with the derivatives of the nearest point.
pub(crate) fn spot_replayed<S: Scalar>(
    curve: impl Parametric<S>,
    point: Vec2<S>,
    (spot, parameter): (CurveSpot, S),
) -> Vec2<S> {
    let [start, end] = curve.ends();
    match spot {
        CurveSpot::Start => start,
        CurveSpot::End => end,
        CurveSpot::Inside => {
            let [on_curve, ..] = curve.at(moving(|t| curve.at(t), point, parameter));
            on_curve
        }
    }
}

/// Returns the power of two that brings the larger of some numbers to about one; one for zeros.
pub(super) fn unit_of<S: Scalar<Mask = bool>, const N: usize>(numbers: [S; N]) -> S::Primal {
    let zero = S::Primal::zero();
    let sizes = numbers.iter().map(|x| x.primal().magnitude());
    let largest = sizes.fold(zero, |most, x| most.most(x));
    if largest.above(zero) && largest.finite() {
        largest.binade()
    } else {
        S::Primal::one()
    }
}

/// Returns the nearest place of a piece, and the distance.
pub(super) fn closest_of(piece: CurvePiece<f64>, point: Vec2<f64>) -> (CurvePlace, f64) {
    let mut best = (
        CurvePlace {
            piece: 0,
            parameter: 0.0,
            is_inside: false,
        },
        piece.start().distance(point),
    );
    let mut consider = |parameter: f64, is_inside: bool, found: f64| {
        if found < best.1 {
            best.0.parameter = parameter;
            best.0.is_inside = is_inside;
            best.1 = found;
        }
    };
    let mut inside = |t: f64| {
        if t > 0.0 && t < 1.0 {
            consider(t, true, piece.point(t).distance(point));
        }
    };
    match piece {
        CurvePiece::Line(line) => inside(foot(line.to - line.from, point - line.from)),
        CurvePiece::Quadratic(curve) => inside_of(curve.elevated(), point, &mut inside),
        CurvePiece::Cubic(curve) => inside_of(curve, point, &mut inside),
        CurvePiece::Arc(arc) => inside(on_arc(arc, point)),
    }
    consider(1.0, false, piece.end().distance(point));
    best
}

/// Returns the parameter of the foot of a point on a line; zero for a line of one point.
fn foot(along: Vec2<f64>, to: Vec2<f64>) -> f64 {
    let unit = unit_of([along.x, along.y]);
    let along = along * unit;
    match along.dot(along) {
        0.0 => 0.0,
        square => (to * unit).dot(along) / square,
    }
}

/// Calls something with all parameters where the way from a point to a curve is perpendicular to it.
fn inside_of(curve: Cubic2<f64>, point: Vec2<f64>, found: &mut impl FnMut(f64)) {
    let away = curve.points.map(|p| p - point);
    let unit = unit_of(away.map(|p| p.x.abs().max(p.y.abs())));
    let away = away.map(|p| p * unit);
    let [a, b, c, d] = curve.points;
    let along = [b - a, c - b, d - c];
    let own = unit_of(along.map(|p| p.x.abs().max(p.y.abs())));
    let along = along.map(|p| p * own);
    // Half of the derivative of the squared distance, times a constant. In Bernstein's form a product of degrees three
    // and two has the quotients of binomials as weights.
    let mut product = [0.0; 6];
    for (i, (p, of_p)) in away.iter().zip([1.0, 3.0, 3.0, 1.0]).enumerate() {
        for (j, (q, of_q)) in along.iter().zip([1.0, 2.0, 1.0]).enumerate() {
            product[i + j] += (of_p * of_q) * p.dot(*q);
        }
    }
    for (sum, of) in product.iter_mut().zip([1.0, 5.0, 10.0, 10.0, 5.0, 1.0]) {
        *sum /= of;
    }
    if !product.iter().all(|x| x.is_finite()) {
        return;
    }
    let scaled = |p: Vec2<f64>| p * unit;
    let unit_curve = Cubic2 {
        points: curve.points.map(scaled),
    };
    let target = scaled(point);
    // Two vectors of a length of at most four.
    bernstein::zeros(product, 64.0 * f64::EPSILON, &mut |t| {
        found(polished(unit_curve, target, t));
    });
}

/// Returns a parameter after Newton steps towards the foot of a point, as long as they come nearer to it.
fn polished(curve: Cubic2<f64>, point: Vec2<f64>, start: f64) -> f64 {
    // At a point where a curve turns back each step takes off a third; others need two or three.
    const STEPS: usize = 50;
    let residual = |t: f64| (curve.point(t) - point).dot(curve.derivative(t));
    let (mut t, mut left) = (start, residual(start));
    for _ in 0..STEPS {
        let along = curve.derivative(t);
        let bend = (curve.point(t) - point).dot(curve.second_derivative(t));
        let next = t - left / (along.dot(along) + bend);
        let of_next = residual(next);
        let is_nearer = of_next.abs() < left.abs();
        if !is_nearer || !(0.0..=1.0).contains(&next) {
            break;
        }
        (t, left) = (next, of_next);
    }
    t
}

/// Returns the parameter of the nearest place of an arc's circle. A point at the centre has the middle.
fn on_arc(arc: Arc2<f64>, point: Vec2<f64>) -> f64 {
    let along = arc.to - arc.from;
    let unit = unit_of([along.x, along.y]);
    let away = point - arc.from;
    let (along, away) = (along * unit, away * unit);
    let b = arc.bulge;
    let square = along.dot(along);
    if square == 0.0 {
        return 0.0;
    }
    // From the middle of the chord, in chords: along it, and to its left. The centre is at (1 − b²)/(4b) to the left; all is
    // multiplied by 4b, which a straight arc has zero.
    let (x, y) = (
        away.dot(along) / square - 0.5,
        along.perp_dot(away) / square,
    );
    if b.abs() < f64::MIN_POSITIVE / f64::EPSILON {
        return x + 0.5;
    }
    let most = b.abs().max(1.0);
    let (b, one) = (b / most, 1.0 / most);
    let angle = Scalar::atan2(
        4.0 * (b * x) * one,
        (one - b) * (one + b) - 4.0 * (b * y) * one,
    );
    0.5 + 0.5 * (angle / (2.0 * arc.quarter()))
}
