//! A piece of a path: a straight line, a Bézier curve or a circular arc, with what all of them have.
use super::bezier::{Cubic2, Quadratic2};
use super::circle_arc::Arc2;
use crate::error::{Field, Flaw, Validate};
use crate::{Pack, Scalar, Segment2, Vec2};

/// One curve without corners inside: what a [path](super::CurvePath) consists of.
///
/// Parameters go from 0 at the start to 1 at the end.
///
/// ```
/// use geograd::{Segment2, Vec2, curve::{Arc2, CurvePiece}};
/// let (from, to) = (Vec2::new(-1.0_f64, 0.0), Vec2::new(1.0, 0.0));
/// let bow = CurvePiece::from(Arc2::new(from, to, 1.0));
/// assert!((bow.length() - std::f64::consts::PI).abs() < 1e-15);
/// let chord = CurvePiece::from(Segment2::new(from, to));
/// assert_eq!(chord.distance(Vec2::new(0.0, 2.0)), 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurvePiece<S> {
    /// A straight line.
    Line(Segment2<S>),
    /// A quadratic Bézier curve.
    Quadratic(Quadratic2<S>),
    /// A cubic Bézier curve.
    Cubic(Cubic2<S>),
    /// A circular arc.
    Arc(Arc2<S>),
}

macro_rules! from {
    ($($variant:ident $shape:ident)*) => { $(
        impl<S> From<$shape<S>> for CurvePiece<S> {
            fn from(shape: $shape<S>) -> Self {
                CurvePiece::$variant(shape)
            }
        }
    )* };
}
from! { Line Segment2 Quadratic Quadratic2 Cubic Cubic2 Arc Arc2 }

/// Calls one thing for the shape of a piece.
macro_rules! for_shape {
    ($piece:expr, $shape:ident => $call:expr) => {
        match $piece {
            CurvePiece::Line($shape) => $call,
            CurvePiece::Quadratic($shape) => $call,
            CurvePiece::Cubic($shape) => $call,
            CurvePiece::Arc($shape) => $call,
        }
    };
}

impl<S: Copy> CurvePiece<S> {
    /// Returns the start.
    #[must_use]
    pub fn start(&self) -> Vec2<S> {
        match self {
            CurvePiece::Line(line) => line.from,
            CurvePiece::Quadratic(curve) => curve.points[0],
            CurvePiece::Cubic(curve) => curve.points[0],
            CurvePiece::Arc(arc) => arc.from,
        }
    }
    /// Returns the end.
    #[must_use]
    pub fn end(&self) -> Vec2<S> {
        match self {
            CurvePiece::Line(line) => line.to,
            CurvePiece::Quadratic(curve) => curve.points[2],
            CurvePiece::Cubic(curve) => curve.points[3],
            CurvePiece::Arc(arc) => arc.to,
        }
    }
}

impl<S: Scalar<Mask = bool>> CurvePiece<S> {
    /// Returns the point at a parameter.
    #[must_use]
    pub fn point(self, t: S) -> Vec2<S> {
        match self {
            CurvePiece::Line(line) => line.from.lerp(line.to, t),
            CurvePiece::Quadratic(curve) => curve.point(t),
            CurvePiece::Cubic(curve) => curve.point(t),
            CurvePiece::Arc(arc) => arc.point(t),
        }
    }
    /// Returns the derivative of the point by the parameter.
    #[must_use]
    pub fn derivative(self, t: S) -> Vec2<S> {
        match self {
            CurvePiece::Line(line) => line.to - line.from,
            CurvePiece::Quadratic(curve) => curve.derivative(t),
            CurvePiece::Cubic(curve) => curve.derivative(t),
            CurvePiece::Arc(arc) => arc.derivative(t),
        }
    }
    /// Returns the second derivative of the point by the parameter.
    #[must_use]
    pub fn second_derivative(self, t: S) -> Vec2<S> {
        match self {
            CurvePiece::Line(_) => Vec2::zero(),
            CurvePiece::Quadratic(curve) => curve.second_derivative(),
            CurvePiece::Cubic(curve) => curve.second_derivative(t),
            CurvePiece::Arc(arc) => arc.second_derivative(t),
        }
    }
    /// Returns the direction at a parameter, a vector of length one, where the piece has one there.
    ///
    /// The derivative is zero at the end of a Bézier curve with a repeated control point: there it is the limit from
    /// inside of the piece. At a cusp it is the direction after it. A piece of one point has the zero vector.
    #[must_use]
    pub fn tangent(self, t: S) -> Vec2<S> {
        let is_end = t.at_least(S::one());
        let sign = if is_end { -S::one() } else { S::one() };
        let first = self.derivative(t);
        let second = self.second_derivative(t) * sign;
        let third = match self {
            CurvePiece::Cubic(curve) => {
                curve.second_derivative(S::one()) - curve.second_derivative(S::zero())
            }
            _ => Vec2::zero(),
        };
        let is_zero = |v: Vec2<S>| v.x.equals(S::zero()) && v.y.equals(S::zero());
        let found = [first, second, third].into_iter().find(|&v| !is_zero(v));
        found.unwrap_or(first).normalize_or_zero()
    }
    /// Returns the signed area between the piece and its chord: positive where it runs counter-clockwise.
    #[must_use]
    pub fn signed_area(self) -> S {
        match self {
            CurvePiece::Line(_) => S::zero(),
            CurvePiece::Quadratic(curve) => curve.signed_area(),
            CurvePiece::Cubic(curve) => curve.signed_area(),
            CurvePiece::Arc(arc) => arc.signed_area(),
        }
    }
    /// Returns the parts before and after a parameter between 0 and 1.
    #[must_use]
    pub fn split(self, t: S) -> [Self; 2] {
        match self {
            CurvePiece::Line(line) => {
                let middle = line.from.lerp(line.to, t);
                [
                    Segment2::new(line.from, middle),
                    Segment2::new(middle, line.to),
                ]
                .map(Self::Line)
            }
            CurvePiece::Quadratic(curve) => curve.split(t).map(Self::Quadratic),
            CurvePiece::Cubic(curve) => curve.split(t).map(Self::Cubic),
            CurvePiece::Arc(arc) => arc.split(t).map(Self::Arc),
        }
    }
    /// Returns both halves, of an arc without angles.
    pub(super) fn halves(self) -> [Self; 2] {
        match self {
            CurvePiece::Arc(arc) => arc.halves().map(Self::Arc),
            other => other.split(S::lit(0.5)),
        }
    }
    /// Returns the piece in the other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        for_shape!(self, shape => shape.reversed().into())
    }
    /// Returns the piece as numbers of the widest format, without derivatives; NaN for numbers that have none.
    pub(super) fn widened(self) -> CurvePiece<f64> {
        self.remake(&mut |x| x.widened().unwrap_or(f64::NAN))
    }
}

impl<S: Clone> Pack for CurvePiece<S> {
    type Scalar = S;
    type With<T: Clone> = CurvePiece<T>;
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&S) -> T) -> CurvePiece<T> {
        let mut at = |v: &Vec2<S>| Vec2::new(f(&v.x), f(&v.y));
        match self {
            CurvePiece::Line(line) => Segment2::new(at(&line.from), at(&line.to)).into(),
            CurvePiece::Quadratic(curve) => Quadratic2 {
                points: curve.points.each_ref().map(at),
            }
            .into(),
            CurvePiece::Cubic(curve) => Cubic2 {
                points: curve.points.each_ref().map(at),
            }
            .into(),
            CurvePiece::Arc(arc) => {
                let (from, to) = (at(&arc.from), at(&arc.to));
                Arc2::new(from, to, f(&arc.bulge)).into()
            }
        }
    }
    fn each(&mut self, f: &mut impl FnMut(&mut S)) {
        let mut at = |v: &mut Vec2<S>| {
            f(&mut v.x);
            f(&mut v.y);
        };
        match self {
            CurvePiece::Line(line) => [&mut line.from, &mut line.to].into_iter().for_each(at),
            CurvePiece::Quadratic(curve) => curve.points.iter_mut().for_each(at),
            CurvePiece::Cubic(curve) => curve.points.iter_mut().for_each(at),
            CurvePiece::Arc(arc) => {
                at(&mut arc.from);
                at(&mut arc.to);
                f(&mut arc.bulge);
            }
        }
    }
}

impl<S: Scalar<Mask = bool>> Validate for CurvePiece<S> {
    fn validate(&self) -> Result<(), Flaw> {
        for_shape!(self, shape => shape.validate())
    }
}

/// Returns the flaw of a tolerance that is not a positive finite number.
pub(super) fn tolerable(tolerance: f64) -> Result<(), Flaw> {
    match tolerance {
        _ if !tolerance.is_finite() => Err(Flaw::NotFinite(Field::VALUE)),
        _ if tolerance <= 0.0 => Err(Flaw::NotPositive(Field::VALUE)),
        _ => Ok(()),
    }
}
