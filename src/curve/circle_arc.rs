//! Circular arcs between two points, with a number for the curvature that is zero for a straight line.
use crate::{Scalar, Shape, Vec2};
use std::f64::consts::TAU;

/// A circular arc from one point to another. Valid when finite.
///
/// The bulge is the tangent of a quarter of the sweep, as in DXF files: 0 is straight, 1 half a circle
/// counter-clockwise, −1 half a circle clockwise. It is also the height of the arc over half of the chord. Ends that
/// coincide make an arc of length zero: a full circle has two arcs ([`CurvePath::circle`](super::CurvePath::circle)).
///
/// ```
/// use geograd::{Vec2, curve::Arc2};
/// let bow = Arc2::new(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), 1.0_f64);
/// assert_eq!((bow.center(), bow.radius()), (Vec2::new(0.0, 0.0), 1.0));
/// assert!(bow.point(0.5).distance(Vec2::new(0.0, -1.0)) < 1e-15);
/// assert!((bow.signed_area() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arc2<S> {
    /// Its start.
    pub from: Vec2<S>,
    /// Its end.
    pub to: Vec2<S>,
    /// The tangent of a quarter of the angle that it sweeps counter-clockwise.
    #[shape(number)]
    pub bulge: S,
}

/// Bulges and angles below this have sums in place of quotients that would cancel.
const FLAT: f64 = 0.25;

/// Returns the sum of a power series in `x`, from its coefficients of growing powers.
#[inline]
fn series<S: Scalar>(x: S, coefficients: impl DoubleEndedIterator<Item = f64>) -> S {
    let mut sum = S::zero();
    for coefficient in coefficients.rev() {
        sum = sum * x + S::lit(coefficient);
    }
    sum
}

/// Terms of the series: at a quarter the first one that is left out is below the last digit.
const TERMS: i32 = 14;

/// Returns `(−1)ᵏ`.
fn sign(k: i32) -> f64 {
    if k % 2 == 0 { 1.0 } else { -1.0 }
}

/// Returns `sin(x)/x`, 1 at zero.
#[inline]
fn sinc<S: Scalar>(x: S) -> S {
    let wide = x.magnitude().above(S::lit(FLAT));
    let divisor = S::select(wide, x, S::one());
    let small = S::select(wide, S::zero(), x);
    let mut factorial = 1.0;
    let coefficients: [f64; 9] = std::array::from_fn(|k| {
        if k > 0 {
            factorial *= -((2 * k) as f64) * ((2 * k + 1) as f64);
        }
        1.0 / factorial
    });
    let sum = series(small * small, coefficients.into_iter());
    S::select(wide, divisor.sin().over(divisor), sum)
}

impl<S> Arc2<S> {
    /// Creates an arc from its ends and its bulge, unchecked.
    #[inline(always)]
    pub const fn new(from: Vec2<S>, to: Vec2<S>, bulge: S) -> Self {
        Arc2 { from, to, bulge }
    }
}

impl<S: Scalar<Mask = bool>> Arc2<S> {
    /// Creates an arc about a centre, from an angle in radians on, by a sweep in radians: positive counter-clockwise and less
    /// than a full turn.
    ///
    /// [`CurvePath::arc`](super::CurvePath::arc) takes full turns, too.
    #[must_use]
    pub fn around(center: Vec2<S>, radius: S, start: S, sweep: S) -> Self {
        let at = |angle: S| {
            let (sin, cos) = angle.sin_cos();
            center + Vec2::new(cos, sin) * radius
        };
        let bulge = (sweep * S::lit(0.25)).tan();
        Arc2::new(at(start), at(start + sweep), bulge)
    }
    /// Creates an arc in SVG's end-point notation, for equal radii: from the current point, by a radius and both flags, to
    /// a point. The sweep flag is set for growing angles, from x towards y.
    ///
    /// As SVG demands, a radius counts without its sign, one that is too short for the chord grows to half of the chord,
    /// and radius zero is a straight line. Equal ends, which SVG leaves out, make an arc of length zero.
    ///
    /// ```
    /// use geograd::{Vec2, curve::Arc2};
    /// let (from, to) = (Vec2::new(0.0, 0.0), Vec2::new(6.0, 0.0));
    /// let large = Arc2::svg(from, 5.0_f64, true, true, to);
    /// assert_eq!((large.bulge, large.center()), (3.0, Vec2::new(3.0, -4.0)));
    /// assert_eq!(Arc2::svg(from, 5.0, false, false, to).bulge, -1.0 / 3.0);
    /// ```
    #[must_use]
    pub fn svg(
        from: Vec2<S>,
        radius: S,
        is_large: bool,
        is_counter_clockwise: bool,
        to: Vec2<S>,
    ) -> Self {
        let (half, radius) = ((to - from).length().halved(), radius.magnitude());
        let bulge = if radius.equals(S::zero()) || half.equals(S::zero()) {
            S::zero()
        } else if radius.at_most(half) {
            S::one()
        } else {
            // The height over half of the chord, without cancellation.
            let ratio = half.over(radius);
            let cosine = ((S::one() - ratio) * (S::one() + ratio)).root();
            let flat = ratio.over(S::one() + cosine);
            if is_large { S::one().over(flat) } else { flat }
        };
        Arc2::new(from, to, if is_counter_clockwise { bulge } else { -bulge })
    }
}

impl<S: Scalar> Arc2<S> {
    /// Returns the angle in radians that it sweeps, positive counter-clockwise.
    #[must_use]
    pub fn sweep(self) -> S {
        self.quarter() * S::lit(4.0)
    }
    /// Returns the centre; not finite for a straight arc.
    #[must_use]
    pub fn center(self) -> Vec2<S> {
        // (1 − b²)/(4b) of the chord, to its left.
        let along = self.to - self.from;
        let height = (S::one().over(self.bulge) - self.bulge) * S::lit(0.25);
        self.from.lerp(self.to, S::lit(0.5)) + along.perp() * height
    }
    /// Returns the radius; infinite for a straight arc.
    #[must_use]
    pub fn radius(self) -> S {
        let bulge = self.bulge.magnitude();
        (self.to - self.from).length() * ((S::one().over(bulge) + bulge) * S::lit(0.25))
    }
    /// Returns a quarter of the sweep.
    #[inline]
    pub(super) fn quarter(self) -> S {
        self.bulge.atan2(S::one())
    }
    /// Returns whether the bulge is small, the bulge or zero if it is not, and the bulge or one if it is.
    fn flatness(self) -> (S::Mask, S, S) {
        let flat = self.bulge.magnitude().at_most(S::lit(FLAT));
        let (small, wide) = (S::zero(), S::one());
        (
            flat,
            S::select(flat, self.bulge, small),
            S::select(flat, wide, self.bulge),
        )
    }
    /// Returns the length over that of the chord: `(1 + b²) atan(b)/b`.
    fn stretch(self) -> S {
        let (flat, small, wide) = self.flatness();
        let terms = (0..TERMS).map(|k| match k {
            0 => 1.0,
            k => -sign(k) * 2.0 / f64::from((2 * k + 1) * (2 * k - 1)),
        });
        let sum = series(small * small, terms);
        S::select(flat, sum, (wide + S::one().over(wide)) * self.quarter())
    }
    /// Returns the length.
    #[must_use]
    pub fn length(self) -> S {
        ((self.to - self.from).length() * self.stretch()).canonical()
    }
    /// Returns the signed area between the arc and its chord: positive where it runs counter-clockwise.
    #[must_use]
    pub fn signed_area(self) -> S {
        let ((flat, small, b), along) = (self.flatness(), self.to - self.from);
        // ((1 + b²)² atan(b) − b (1 − b²))/(8 b²) of the squared chord.
        let terms =
            (1..=TERMS).map(|k| sign(k) / f64::from((2 * k + 1) * (2 * k - 1) * (2 * k - 3)));
        let of_flat = small * series(small * small, terms);
        let inverse = S::one().over(b);
        let sum = b + inverse;
        let of_wide = (sum * (sum * self.quarter()) - (inverse - b)) * S::lit(0.125);
        let share = S::select(flat, of_flat, of_wide);
        let length = along.length();
        (length * (share * length)).canonical()
    }
    /// Returns the point at a parameter, from 0 at the start to 1 at the end, in proportion to the length.
    #[must_use]
    pub fn point(self, t: S) -> Vec2<S> {
        let half = self.quarter() + self.quarter();
        // The chord to the point has half of its sweep less than the tangent, and the length of the sine of it.
        let (flat, _, wide) = self.flatness();
        let ratio = S::select(
            flat,
            t * sinc(t * half).over(sinc(half)),
            (t * half).sin() * ((wide + S::one().over(wide)).halved()),
        );
        self.from + turned(self.to - self.from, (t - S::one()) * half) * ratio
    }
    /// Returns the derivative of the point by the parameter: a vector of the arc's length.
    #[must_use]
    pub fn derivative(self, t: S) -> Vec2<S> {
        let half = self.quarter() + self.quarter();
        turned(self.to - self.from, (t + t - S::one()) * half) * self.stretch()
    }
    /// Returns the second derivative of the point by the parameter.
    #[must_use]
    pub fn second_derivative(self, t: S) -> Vec2<S> {
        self.derivative(t).perp() * self.sweep()
    }
    /// Returns the parts before and after a parameter between 0 and 1.
    #[must_use]
    pub fn split(self, t: S) -> [Self; 2] {
        let (middle, quarter) = (self.point(t), self.quarter());
        [
            Arc2::new(self.from, middle, (quarter * t).tan()),
            Arc2::new(middle, self.to, (quarter * (S::one() - t)).tan()),
        ]
    }
    /// Returns both halves.
    pub(super) fn halves(self) -> [Self; 2] {
        let b = self.bulge;
        let bulge = b.over(S::one() + S::one().hypot(b));
        let middle = self.from.lerp(self.to, S::lit(0.5)) - self.height();
        [
            Arc2::new(self.from, middle, bulge),
            Arc2::new(middle, self.to, bulge),
        ]
    }
    /// Returns the way from the middle of the arc to that of its chord.
    pub(super) fn height(self) -> Vec2<S> {
        (self.to - self.from).perp() * self.bulge.halved()
    }
    /// Returns the arc in the other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        Arc2::new(self.to, self.from, -self.bulge)
    }
}

/// Returns a vector turned counter-clockwise by an angle.
#[inline]
fn turned<S: Scalar>(v: Vec2<S>, angle: S) -> Vec2<S> {
    let (sin, cos) = angle.sin_cos();
    v * cos + v.perp() * sin
}

/// Returns the bulges of arcs of at most half a turn that make up a sweep together, and how many there are. A sweep beyond
/// a full turn is a full turn.
pub(super) fn parts_of_sweep<S: Scalar<Mask = bool>>(sweep: S) -> (usize, S) {
    let full = S::lit(TAU);
    let sweep = if sweep.above(full) {
        full
    } else if sweep.below(-full) {
        -full
    } else {
        sweep
    };
    let count = if sweep.magnitude().above(full.halved()) {
        2
    } else {
        1
    };
    (count, sweep.over(S::lit(count as f64)))
}
