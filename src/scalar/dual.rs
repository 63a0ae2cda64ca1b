//! Every dual number as a scalar: the chain rule once, `num-dual`'s types in a few lines each.
//!
//! A dual number is a value with derivative parts. [`Tangent`] says how a type propagates a
//! function of one variable; everything else a [`Scalar`] needs follows from it. This is also
//! where the traps of `num-dual` are mended: its square root has no derivative at zero, its `atan2`
//! none at a right angle, its quotient rounds differently from a plain one.
use crate::{Fixed, Scalar};
use num_dual::{Dual, Dual2, Dual3, DualNum, HyperDual, HyperHyperDual, Real};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number with derivative parts over an inner scalar.
///
/// Implementing it makes a type a [`Scalar`]. Dual numbers may be nested.
pub trait Tangent:
    Fixed<Scalar = Self>
    + Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The scalar of the value and of the derivatives.
    type Inner: Scalar;
    /// Returns the value.
    fn value(self) -> Self::Inner;
    /// Returns a constant.
    fn constant(value: Self::Inner) -> Self;
    /// Returns the chain rule: `f(self)` from `f` and its first three derivatives at `self.value()`.
    fn chain(self, f: [Self::Inner; 4]) -> Self;
    /// Selects `yes` or `no`, part by part.
    fn pick(mask: <Self::Inner as Scalar>::Mask, yes: Self, no: Self) -> Self;
    /// Runs one operation on such numbers. Large numbers do so out of line: a program of their operations in line takes
    /// minutes to compile and is no faster.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn operation<R>(run: impl FnOnce() -> R) -> R {
        run()
    }
    /// Returns half of every part. A product has the derivative `∞ · 0` where the value is infinite.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn half(self) -> Self {
        self * Self::constant(Self::Inner::lit(0.5))
    }
}

impl<D: Tangent> Scalar for D {
    type Mask = <D::Inner as Scalar>::Mask;
    type Primal = <D::Inner as Scalar>::Primal;
    const RECORDS: bool = <D::Inner as Scalar>::RECORDS;
    #[inline(always)]
    fn format() -> crate::scalar::Format {
        D::Inner::format()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lit(x: f64) -> Self {
        D::constant(D::Inner::lit(x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_primal(x: Self::Primal) -> Self {
        D::constant(D::Inner::from_primal(x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn primal(self) -> Self::Primal {
        self.value().primal()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn widened(self) -> Option<f64> {
        self.primal().widened()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn below(self, other: Self) -> Self::Mask {
        self.primal().below(other.primal())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_most(self, other: Self) -> Self::Mask {
        self.primal().at_most(other.primal())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn equals(self, other: Self) -> Self::Mask {
        self.primal().equals(other.primal())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        D::pick(mask, yes, no)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn over(self, divisor: Self) -> Self {
        D::operation(|| {
            // Scaling the divisor to about one keeps its square from over- or underflowing.
            let scale = Self::from_primal(Self::Primal::one().over(divisor.primal()));
            let quotient = (self * scale) / (divisor * scale);
            // Only the derivative parts are wanted from it: the value is that of plain numbers, also
            // where it overflows.
            let (zero, one) = (D::Inner::zero(), D::Inner::one());
            quotient.chain([self.value().over(divisor.value()), one, zero, zero])
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn root(self) -> Self {
        D::operation(|| {
            let x = self.value();
            let flat = self.at_most(Self::zero());
            let x = D::Inner::select(flat, D::Inner::one(), x);
            let root = x.root();
            let f1 = D::Inner::lit(0.5).over(root);
            let f2 = -f1.halved().over(x);
            let f3 = D::Inner::lit(-1.5) * f2.over(x);
            D::pick(flat, Self::zero(), self.chain([root, f1, f2, f3]))
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn halved(self) -> Self {
        self.half()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn may_be_nan(self) -> bool {
        self.value().may_be_nan()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        D::operation(|| {
            let (sin, cos) = self.value().sin_cos();
            (
                self.chain([sin, cos, -sin, -cos]),
                self.chain([cos, -sin, -cos, sin]),
            )
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        D::operation(|| {
            let [(sin_high, sin_low), (cos_high, cos_low)] = self.value().sin_cos_parts();
            let (sin, cos) = (sin_high + sin_low, cos_high + cos_low);
            [
                (
                    D::constant(sin_high),
                    self.chain([sin_low, cos, -sin, -cos]),
                ),
                (
                    D::constant(cos_high),
                    self.chain([cos_low, -sin, -cos, sin]),
                ),
            ]
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts(self) -> (Self, Self) {
        let (high, low) = self.value().parts();
        let (zero, one) = (D::Inner::zero(), D::Inner::one());
        (D::constant(high), self.chain([low, one, zero, zero]))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        D::operation(|| {
            let (y, zero, one) = (self, D::Inner::zero(), D::Inner::one());
            let large = x.primal().magnitude().most(y.primal().magnitude());
            let origin = large.at_most(Self::Primal::zero());
            let scale = Self::from_primal(
                Self::Primal::select(origin, Self::Primal::one(), large).binade(),
            );
            let (x, y) = (x * scale, y * scale);
            // In the frame turned by the angle itself, the angle is the arctangent of a number whose
            // value is zero: nothing to divide by but the length.
            let length = x.value().hypot(y.value());
            let length = D::Inner::select(origin, one, length);
            let (cos, sin) = (
                D::constant(x.value().over(length)),
                D::constant(y.value().over(length)),
            );
            let derivative = (y * cos - x * sin).over(x * cos + y * sin);
            let angle =
                derivative.chain([y.value().atan2(x.value()), one, zero, D::Inner::lit(-2.0)]);
            D::pick(origin, Self::zero(), angle)
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exp(self) -> Self {
        D::operation(|| self.chain([self.value().exp(); 4]))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln(self) -> Self {
        D::operation(|| {
            let x = self.value();
            let f1 = D::Inner::one().over(x);
            let f2 = -(f1 * f1);
            self.chain([x.ln(), f1, f2, D::Inner::lit(-2.0) * f2 * f1])
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn binade(self) -> Self {
        Self::from_primal(self.primal().binade())
    }
}

/// One of `num-dual`'s types: its parts, and the chain rule for each.
macro_rules! tangent {
    ($type:ident, [$($part:ident),*], |$x:ident, $f:ident| $chain:expr) => {
        impl<T: Scalar<Mask = bool> + DualNum> Tangent for $type<T> {
            type Inner = T;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn value(self) -> T {
                self.re
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn constant(value: T) -> Self {
                Self::from_re(value)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn chain(self, $f: [T; 4]) -> Self {
                let $x = self;
                $chain
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn pick(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn half(self) -> Self {
                $type::new($(self.$part.halved()),*)
            }
        }
    };
}

tangent!(Real, [re], |_x, f| Real { re: f[0] });
tangent!(Dual, [re, eps], |x, f| Dual {
    re: f[0],
    eps: x.eps * f[1]
});
tangent!(Dual2, [re, v1, v2], |x, f| Dual2::new(
    f[0],
    x.v1 * f[1],
    x.v2 * f[1] + x.v1 * x.v1 * f[2],
));
tangent!(Dual3, [re, v1, v2, v3], |x, f| Dual3::new(
    f[0],
    x.v1 * f[1],
    x.v2 * f[1] + x.v1 * x.v1 * f[2],
    x.v3 * f[1] + T::lit(3.0) * x.v1 * x.v2 * f[2] + x.v1 * x.v1 * x.v1 * f[3],
));
tangent!(
    HyperDual,
    [re, eps1, eps2, eps1eps2],
    |x, f| HyperDual::new(
        f[0],
        x.eps1 * f[1],
        x.eps2 * f[1],
        x.eps1eps2 * f[1] + x.eps1 * x.eps2 * f[2],
    )
);
tangent!(
    HyperHyperDual,
    [
        re,
        eps1,
        eps2,
        eps3,
        eps1eps2,
        eps1eps3,
        eps2eps3,
        eps1eps2eps3
    ],
    |x, f| HyperHyperDual::new(
        f[0],
        x.eps1 * f[1],
        x.eps2 * f[1],
        x.eps3 * f[1],
        x.eps1eps2 * f[1] + x.eps1 * x.eps2 * f[2],
        x.eps1eps3 * f[1] + x.eps1 * x.eps3 * f[2],
        x.eps2eps3 * f[1] + x.eps2 * x.eps3 * f[2],
        x.eps1eps2eps3 * f[1]
            + (x.eps1 * x.eps2eps3 + x.eps2 * x.eps1eps3 + x.eps3 * x.eps1eps2) * f[2]
            + x.eps1 * x.eps2 * x.eps3 * f[3],
    )
);
