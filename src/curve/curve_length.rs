//! The length of a piece.
use super::bernstein;
use super::bezier::{Cubic2, Quadratic2};
use super::curve_nearest::unit_of;
use super::curve_piece::CurvePiece;
use crate::arrays::sort_few;
use crate::{Scalar, Vec2};

/// Places and weights of Gauss' rule of sixteen places, which are symmetric about zero.
const RULE: [[f64; 2]; 8] = [
    [0.09501250983763744, 0.1894506104550685],
    [0.2816035507792589, 0.18260341504492358],
    [0.45801677765722737, 0.16915651939500254],
    [0.6178762444026438, 0.14959598881657674],
    [0.755404408355003, 0.12462897125553388],
    [0.8656312023878318, 0.09515851168249279],
    [0.9445750230732326, 0.062253523938647894],
    [0.9894009349916499, 0.027152459411754096],
];

/// Halvings of an interval at most: a cusp is within so small a part then.
const DEEPEST: u32 = 40;

/// Parts at most: there are about sixty for the sharpest of cusps.
const MOST: usize = 1024;

impl<S: Scalar<Mask = bool>> CurvePiece<S> {
    /// Returns the length, at least 0, to within a few roundings.
    ///
    /// It is a closed form but for cubic curves and quadratic ones of nearly even speed. These have Gauss' rule on parts, which a
    /// search with plain numbers divides until the rule agrees with that of both halves. Derivatives are those of the rule on
    /// the same parts.
    ///
    /// Kinks: places where a curve stops and turns back, and curves of length zero, with derivative zero.
    ///
    /// ```
    /// use geograd::{Vec2, curve::{CurvePiece, Quadratic2}};
    /// let hill = Quadratic2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 2.0), Vec2::new(2.0_f64, 0.0));
    /// let root = 5.0_f64.sqrt();
    /// let expected = root + (2.0 + root).ln() / 2.0;
    /// assert!((CurvePiece::from(hill).length() - expected).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn length(self) -> S {
        match self {
            CurvePiece::Line(line) => (line.to - line.from).length(),
            CurvePiece::Arc(arc) => arc.length(),
            CurvePiece::Quadratic(curve) => of_quadratic(curve),
            CurvePiece::Cubic(curve) => of_cubic(curve),
        }
    }
}

/// Returns the integral of the length of `along` over an interval of the parameter.
fn by_rule<S: Scalar>([low, high]: [f64; 2], along: impl Fn(S) -> Vec2<S>) -> S {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let mut sum = S::zero();
    for [place, weight] in RULE {
        let at = |place: f64| {
            let v = along(S::lit(middle + half * place));
            v.dot(v).root()
        };
        sum += (at(place) + at(-place)) * S::lit(weight);
    }
    sum * S::lit(half)
}

/// Returns vectors in a unit near their size, and that unit's inverse.
fn in_unit<S: Scalar<Mask = bool>, const N: usize>(all: [Vec2<S>; N]) -> ([Vec2<S>; N], S) {
    let unit = unit_of(all.map(|v| v.x.magnitude().most(v.y.magnitude())));
    let back = S::from_primal(S::Primal::one().over(unit));
    (all.map(|v| v * S::from_primal(unit)), back)
}

fn of_quadratic<S: Scalar<Mask = bool>>(curve: Quadratic2<S>) -> S {
    let [a, b, c] = curve.points;
    let ([from, to], back) = in_unit([b - a, c - b]);
    let bend = to - from;
    let square = bend.dot(bend);
    let fastest = from.dot(from).primal().most(to.dot(to).primal());
    // The speed is zero at a complex parameter no nearer than the length of the interval: sixteen places err by less than
    // a rounding. Else the closed form does not cancel.
    let is_even = square.primal().below(fastest * S::Primal::lit(0.25));
    let length = if is_even || square.equals(S::zero()) {
        by_rule([0.0, 1.0], |t| from.lerp(to, t))
    } else {
        of_parabola([from, to], bend, square)
    };
    // Twice the differences are the speed.
    (length + length) * back
}

/// Returns the mean length of a vector that moves evenly from one to another.
///
/// Along its way `s` and at a distance `h` from zero it is the integral of `√(s² + h²)`.
fn of_parabola<S: Scalar<Mask = bool>>(ends: [Vec2<S>; 2], bend: Vec2<S>, square: S) -> S {
    let zero = S::zero();
    let length = square.root();
    let [s, e] = ends.map(|v| v.dot(bend).over(length));
    let [r, q] = ends.map(|v| v.dot(v).root());
    let across = ends[0].perp_dot(bend);
    let height = (across * across).over(square);
    let grown = |s: S, r: S| s.unsigned() + r;
    let turns = s.below(zero) != e.below(zero);
    let (u, v) = (grown(s, r), grown(e, q));
    let is_zero = |x: S| x.equals(zero);
    // Areas under a hyperbola; zero where it is its own asymptotes.
    let logarithm = if is_zero(u) || is_zero(v) || (turns && height.at_most(S::rounding(1.0, 4))) {
        zero
    } else if turns {
        u.ln() + v.ln() - height.ln()
    } else if s.below(zero) {
        u.ln() - v.ln()
    } else {
        v.ln() - u.ln()
    };
    (e * q - s * r + height * logarithm).over(length + length)
}

fn of_cubic<S: Scalar<Mask = bool>>(curve: Cubic2<S>) -> S {
    let [a, b, c, d] = curve.points;
    let (along, back) = in_unit([b - a, c - b, d - c]);
    let velocity = Quadratic2 { points: along };
    let numbers = Quadratic2 {
        points: along.map(|p| {
            let x = |x: S| x.widened().unwrap_or(f64::NAN);
            Vec2::new(x(p.x), x(p.y))
        }),
    };
    let mut sum = S::zero();
    for part in parts(numbers) {
        sum += by_rule(part, |t| velocity.point(t));
    }
    sum * S::lit(3.0) * back
}

/// Returns the parts of the parameter on each of which the rule is exact to a few roundings.
fn parts(velocity: Quadratic2<f64>) -> Vec<[f64; 2]> {
    let [a, b, c] = velocity.points;
    let bends = [b - a, c - b];
    // The slope of the squared speed, whose zeros are where a curve is slowest: near a cusp only one end of a part is.
    let slope = [
        a.dot(bends[0]),
        (2.0 * b.dot(bends[0]) + a.dot(bends[1])) / 3.0,
        (2.0 * b.dot(bends[1]) + c.dot(bends[0])) / 3.0,
        c.dot(bends[1]),
    ];
    let mut ends = vec![0.0, 1.0];
    let is_finite = slope.iter().all(|x| x.is_finite());
    if is_finite && slope.iter().any(|&x| x != 0.0) {
        bernstein::zeros(slope, 64.0 * f64::EPSILON, &mut |t| ends.push(t));
    }
    sort_few(&mut ends, |a, b| a.total_cmp(b).is_lt());
    ends.dedup();
    let of = |part| by_rule(part, |t| velocity.point(t));
    let first = || ends.windows(2).map(|pair| [pair[0], pair[1]]);
    let total: f64 = first().map(of).sum();
    let mut found = Vec::new();
    for part in first() {
        divide(part, of(part), total, DEEPEST, &of, &mut found);
    }
    found
}

/// Adds the parts of an interval, whose integral is known.
fn divide(
    [low, high]: [f64; 2],
    whole: f64,
    total: f64,
    depth: u32,
    of: &impl Fn([f64; 2]) -> f64,
    found: &mut Vec<[f64; 2]>,
) {
    const LEVEL: f64 = 16.0 * f64::EPSILON;
    let middle = 0.5 * (low + high);
    let halves = [[low, middle], [middle, high]];
    let both = halves.map(of);
    let size = whole.max(total * (high - low));
    let differs = (whole - (both[0] + both[1])).abs() > LEVEL * size;
    let is_least = depth == 0 || found.len() >= MOST || middle <= low || middle >= high;
    if !differs || is_least {
        return found.push([low, high]);
    }
    for (half, own) in halves.into_iter().zip(both) {
        divide(half, own, total, depth - 1, of, found);
    }
}
