//! Units, handedness and periods of angles.
use crate::{Scalar, Shape};
use std::f64::consts::PI;

/// An angle in degrees.
///
/// ```
/// use geograd::convention::{Degrees, Radians};
/// let right = Radians::from(Degrees { value: 90.0_f64 });
/// assert_eq!(right.value, std::f64::consts::FRAC_PI_2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Degrees<S> {
    /// The number of degrees.
    #[shape(number)]
    pub value: S,
}

/// An angle in radians.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Radians<S> {
    /// The number of radians.
    #[shape(angle)]
    pub value: S,
}

impl<S: Scalar> From<Degrees<S>> for Radians<S> {
    #[inline(always)]
    fn from(angle: Degrees<S>) -> Self {
        Radians {
            value: angle.value * S::lit(PI / 180.0),
        }
    }
}
impl<S: Scalar> From<Radians<S>> for Degrees<S> {
    #[inline(always)]
    fn from(angle: Radians<S>) -> Self {
        Degrees {
            value: angle.value * S::lit(180.0 / PI),
        }
    }
}

/// An angle that grows clockwise as seen by the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Clockwise<S> {
    /// The number of radians.
    #[shape(angle)]
    pub radians: S,
}

/// An angle that grows counter-clockwise as seen by the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Counterclockwise<S> {
    /// The number of radians.
    #[shape(angle)]
    pub radians: S,
}

impl<S: Scalar> From<Clockwise<S>> for Counterclockwise<S> {
    #[inline(always)]
    fn from(angle: Clockwise<S>) -> Self {
        Counterclockwise {
            radians: -angle.radians,
        }
    }
}
impl<S: Scalar> From<Counterclockwise<S>> for Clockwise<S> {
    #[inline(always)]
    fn from(angle: Counterclockwise<S>) -> Self {
        Clockwise {
            radians: -angle.radians,
        }
    }
}

/// The rotation that maps a shape to itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Period {
    /// 2π: directions, vehicles with a front.
    Full,
    /// π: boxes without a front.
    Half,
    /// π/2: squares without a front.
    Quarter,
}

impl Period {
    /// Returns the number of periods in a full turn.
    #[inline(always)]
    fn count(self) -> f64 {
        match self {
            Period::Full => 1.0,
            Period::Half => 2.0,
            Period::Quarter => 4.0,
        }
    }
    /// Returns the equivalent angle, in radians, in `[−p/2, p/2]` for the period p; derivative one.
    #[must_use]
    #[inline]
    pub fn wrap<S: Scalar>(self, angle: S) -> S {
        let (sin, cos) = (angle * S::lit(self.count())).sin_cos();
        sin.atan2(cos) * S::lit(1.0 / self.count())
    }
    /// Returns the smallest turn from a to b, in radians, in `[−p/2, p/2]`. Kink: where both directions are equally
    /// long.
    ///
    /// ```
    /// use geograd::convention::Period;
    /// assert!((Period::Half.difference(0.1_f64, 3.1) - (3.0 - std::f64::consts::PI)).abs() < 1e-15);
    /// ```
    #[must_use]
    #[inline]
    pub fn difference<S: Scalar>(self, a: S, b: S) -> S {
        self.wrap(b - a)
    }
    /// Returns a loss for headings without kinks: `½ (1 − cos(k (b − a)))`, for k periods in a full turn, in `[0, 1]`;
    /// zero for equal headings.
    #[must_use]
    #[inline]
    pub fn loss<S: Scalar>(self, a: S, b: S) -> S {
        ((b - a) * S::lit(self.count() / 2.0)).sin().squared()
    }
}
