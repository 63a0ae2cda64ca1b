//! Vectors in the plane and in space.
use crate::scalar::norm;
use crate::{Mask, Scalar, Shape};
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// The vector of one dimension: its fields and what acts field by field.
macro_rules! vector {
    ($(#[$about:meta])* $name:ident { $($field:ident),* }) => {
        #[derive(Clone, Copy, Debug, Default, PartialEq, Shape)]
        #[shape(bounding)]
        $(#[$about])*
        #[repr(C)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<S> {
            $(
                #[doc = concat!("The ", stringify!($field), " coordinate.")]
                pub $field: S,
            )*
        }

        impl<S> $name<S> {
            /// Creates a vector from coordinates.
            #[inline(always)]
            pub const fn new($($field: S),*) -> Self {
                Self { $($field),* }
            }
        }

        impl<S: Scalar> $name<S> {
            /// Returns the lower and the upper corner of the box that is the point.
            #[inline(always)]
            pub(crate) const fn bounding(self) -> [Self; 2] {
                [self, self]
            }
            /// Returns the zero vector.
            #[inline(always)]
            pub fn zero() -> Self {
                Self { $($field: S::zero()),* }
            }
            /// Returns the inner product.
            #[must_use]
            #[inline(always)]
            pub fn dot(self, other: Self) -> S {
                let mut sum = S::zero();
                $(sum += self.$field * other.$field;)*
                sum
            }
            /// Returns the squared length; smooth everywhere.
            #[must_use]
            #[inline(always)]
            pub fn length_squared(self) -> S {
                self.dot(self)
            }
            /// Returns the vector of length one in this direction, or the zero vector (with derivative zero) for the
            /// zero vector.
            #[must_use]
            #[inline(always)]
            pub fn normalize_or_zero(self) -> Self {
                let length = self.length();
                let zero = length.at_most(S::zero());
                let length = S::select(zero, S::one(), length);
                Self { $($field: S::select(zero, S::zero(), self.$field.over(length))),* }
            }
            /// Returns the vector of length one in this direction; `None` for the zero vector.
            #[must_use]
            #[inline]
            pub fn try_normalize(self) -> Option<Self>
            where
                S: Scalar<Mask = bool>,
            {
                self.length().above(S::zero()).then(|| self.normalize_or_zero())
            }
            /// Returns the point a fraction `t` of the way to another one.
            #[must_use]
            #[inline(always)]
            pub fn lerp(self, other: Self, t: S) -> Self {
                self + (other - self) * t
            }
            /// Returns the smaller coordinate of both, coordinate by coordinate; ties share the derivative.
            #[must_use]
            #[inline(always)]
            pub fn least(self, other: Self) -> Self {
                Self { $($field: self.$field.least(other.$field)),* }
            }
            /// Returns the larger coordinate of both, coordinate by coordinate; ties share the derivative.
            #[must_use]
            #[inline(always)]
            pub fn most(self, other: Self) -> Self {
                Self { $($field: self.$field.most(other.$field)),* }
            }
            /// Returns the vector with its zeros positive.
            #[must_use]
            #[inline(always)]
            pub fn canonical(self) -> Self {
                Self { $($field: self.$field.canonical()),* }
            }
            /// Returns the vector with coordinates clamped to the largest number.
            #[inline(always)]
            pub(crate) fn saturated(self) -> Self {
                Self { $($field: self.$field.saturated()),* }
            }
            /// Returns `true` if every coordinate is a finite number.
            #[must_use]
            #[inline]
            pub fn is_finite(self) -> bool {
                true $(&& self.$field.finite().all())*
            }
        }

        impl<S: Add<Output = S>> Add for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self { $($field: self.$field + other.$field),* }
            }
        }
        impl<S: Sub<Output = S>> Sub for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self { $($field: self.$field - other.$field),* }
            }
        }
        impl<S: Neg<Output = S>> Neg for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { $($field: -self.$field),* }
            }
        }
        impl<S: Copy + Mul<Output = S>> Mul<S> for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: S) -> Self {
                Self { $($field: self.$field * factor),* }
            }
        }
        impl<S: AddAssign> AddAssign for $name<S> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                $(self.$field += other.$field;)*
            }
        }
        impl<S: SubAssign> SubAssign for $name<S> {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                $(self.$field -= other.$field;)*
            }
        }
        impl<S: std::fmt::Display> std::fmt::Display for $name<S> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let mut separator = "(";
                $(
                    f.write_str(std::mem::replace(&mut separator, ", "))?;
                    self.$field.fmt(f)?;
                )*
                f.write_str(")")
            }
        }
    };
}

vector! {
    /// A point or a direction in the plane: x to the right, y up.
    ///
    /// ```
    /// use geograd::Vec2;
    /// let a = Vec2::new(3.0, 4.0);
    /// assert_eq!(a.length(), 5.0);
    /// assert_eq!(a.perp_dot(Vec2::new(0.0, 1.0)), 3.0);
    /// assert_eq!(a.to_string(), "(3, 4)");
    /// ```
    #[shape(except(Sample))]
    Vec2 { x, y }
}
vector! {
    /// A point or a direction in space, right-handed.
    #[shape(except(Sample))]
    Vec3 { x, y, z }
}

impl<S: Scalar> Vec2<S> {
    /// Returns `yes` where the mask is true, else `no`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        Vec2::new(S::select(mask, yes.x, no.x), S::select(mask, yes.y, no.y))
    }
    /// Returns the vector without derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn constant(self) -> Self {
        let part = |x: S| S::from_primal(x.primal());
        Vec2::new(part(self.x), part(self.y))
    }
    /// Returns the length; derivative zero at the zero vector.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> S {
        self.x.hypot(self.y)
    }
    /// Returns the cross product's third coordinate: positive when `other` is counter-clockwise of `self`.
    #[must_use]
    #[inline(always)]
    pub fn perp_dot(self, other: Self) -> S {
        self.x * other.y - self.y * other.x
    }
    /// Returns a quarter turn counter-clockwise.
    #[must_use]
    #[inline(always)]
    pub fn perp(self) -> Self {
        Vec2::new(-self.y, self.x)
    }
    /// Returns the direction's angle in radians, counter-clockwise from x, in `[−π, π]`; zero with derivative
    /// zero for the zero vector.
    #[must_use]
    #[inline(always)]
    pub fn angle(self) -> S {
        self.y.atan2(self.x)
    }
    /// Returns the angle in radians that turns `self` into the direction of `other`, in `[−π, π]`.
    #[must_use]
    #[inline(always)]
    pub fn angle_to(self, other: Self) -> S {
        self.perp_dot(other).atan2(self.dot(other))
    }
}

impl<S: Scalar> Vec3<S> {
    /// Returns `yes` where the mask is true, else `no`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        let pick = |yes: S, no: S| S::select(mask, yes, no);
        Vec3::new(pick(yes.x, no.x), pick(yes.y, no.y), pick(yes.z, no.z))
    }
    /// Returns the vector without derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn constant(self) -> Self {
        let part = |x: S| S::from_primal(x.primal());
        Vec3::new(part(self.x), part(self.y), part(self.z))
    }
    /// Returns the length; derivative zero at the zero vector.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> S {
        norm(self.x, self.y, self.z)
    }
    /// Returns the angle in radians between two vectors, in `[0, π]`; zero with derivative zero where one of them is
    /// zero.
    ///
    /// Kinks: parallel vectors, with derivative 0.
    ///
    /// ```
    /// use geograd::Vec3;
    /// let (x, y) = (Vec3::new(2.0_f64, 0.0, 0.0), Vec3::new(0.0, 0.5, 0.0));
    /// assert_eq!(x.angle_to(y), std::f64::consts::FRAC_PI_2);
    /// assert_eq!(x.angle_to(x), 0.0);
    /// ```
    #[must_use]
    #[inline]
    pub fn angle_to(self, other: Self) -> S {
        let (a, b) = (self.normalize_or_zero(), other.normalize_or_zero());
        a.cross(b).length().atan2(a.dot(b))
    }
    /// Returns the cross product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Vec3::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }
}
