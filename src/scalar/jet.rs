//! A lean forward-mode dual number: a value and `N` derivatives, nothing else.
//!
//! The engine of the derivative drivers. It has the value of a plain computation to the bit, except for results below
//! the smallest normal number: exact ties add two halves there, and `atan2` in `f32` divides. It costs the same in
//! every build profile, nests, and runs over SIMD lanes.
use crate::Scalar;
use crate::scalar::dual::Tangent;
use std::array::from_fn;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value and its derivatives along `N` directions.
///
/// ```
/// use geograd::{Jet, Scalar};
/// let x = Jet::variable(3.0_f64, 0);
/// let y = Jet::variable(4.0, 1);
/// let squares: Jet<f64, 2> = x * x + y * y;
/// assert_eq!((squares.value, squares.derivative), (25.0, [6.0, 8.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T, const N: usize> {
    /// The value.
    pub value: T,
    /// The derivative along each direction.
    pub derivative: [T; N],
}

/// Runs an operation, out of line in release builds.
#[cfg_attr(not(debug_assertions), inline(never))]
fn out_of_line<R>(run: impl FnOnce() -> R) -> R {
    run()
}

impl<T: Scalar, const N: usize> Jet<T, N> {
    /// `true` if operations run out of line: those of nested numbers of 128 bytes and more, each a hundred
    /// instructions, and those of symbols, each a call per derivative of code that runs once.
    const LARGE: bool =
        T::RECORDS || size_of::<T>() > size_of::<T::Primal>() && size_of::<Self>() >= 128;

    /// Returns the independent variable of direction `i`; a constant when `i` is `N` or more.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn variable(value: T, i: usize) -> Self {
        let derivative = from_fn(|k| if k == i { T::one() } else { T::zero() });
        Jet { value, derivative }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts(self, value: T, f: impl Fn(T) -> T) -> Self {
        Jet {
            value,
            derivative: from_fn(|k| f(self.derivative[k])),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, value: T, f: impl Fn(T, T) -> T) -> Self {
        Jet {
            value,
            derivative: from_fn(|k| f(self.derivative[k], other.derivative[k])),
        }
    }
}

impl<T: Scalar, const N: usize> Add for Jet<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Self::operation(|| self.join(other, self.value + other.value, |a, b| a + b))
    }
}
impl<T: Scalar, const N: usize> Sub for Jet<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Self::operation(|| self.join(other, self.value - other.value, |a, b| a - b))
    }
}
impl<T: Scalar, const N: usize> Mul for Jet<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        let (x, y) = (self.value, other.value);
        Self::operation(|| self.join(other, x * y, |a, b| a * y + b * x))
    }
}
impl<T: Scalar, const N: usize> Div for Jet<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        Self::operation(|| {
            let quotient = self.value.over(other.value);
            let inverse = T::one().over(other.value);
            self.join(other, quotient, |a, b| (a - quotient * b) * inverse)
        })
    }
}
impl<T: Scalar, const N: usize> Neg for Jet<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self::operation(|| self.parts(-self.value, |a| -a))
    }
}
impl<T: Scalar, const N: usize> AddAssign for Jet<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<T: Scalar, const N: usize> SubAssign for Jet<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
impl<T: Scalar, const N: usize> MulAssign for Jet<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Scalar, const N: usize> Tangent for Jet<T, N> {
    type Inner = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn operation<R>(run: impl FnOnce() -> R) -> R {
        if const { Self::LARGE } {
            out_of_line(run)
        } else {
            run()
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value(self) -> T {
        self.value
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn constant(value: T) -> Self {
        Jet {
            value,
            derivative: [T::zero(); N],
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, f: [T; 4]) -> Self {
        Self::operation(|| self.parts(f[0], |a| a * f[1]))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pick(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self::operation(|| {
            yes.join(no, T::select(mask, yes.value, no.value), |a, b| {
                T::select(mask, a, b)
            })
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn half(self) -> Self {
        Self::operation(|| self.parts(self.value.halved(), T::halved))
    }
}
