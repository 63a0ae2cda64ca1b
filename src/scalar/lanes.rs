//! SIMD as a scalar: a fixed bundle of numbers on which every operation acts lane by lane.
//!
//! Plain arrays and plain loops, no intrinsics: the compiler turns each operation into vector instructions of the width
//! for which the surrounding function was compiled. One source serves SSE2, AVX2, AVX-512, NEON and WASM, with equal
//! bits on all of them.
use crate::scalar::float::{sin_cos_single, sin_cos_wide, split_single};
use crate::{Mask, Real, Scalar};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// `N` numbers side by side.
///
/// ```
/// use geograd::{Lanes, Scalar};
/// let x = Lanes([1.0_f32, -2.0, 3.0, -4.0]);
/// assert_eq!(x.magnitude().0, [1.0, 2.0, 3.0, 4.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<T, const N: usize>(pub [T; N]);

/// One truth value per lane, as all ones or all zeros (bytes of `bool` cost 2.7 times as much
/// under AVX2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct LaneMask<T: Real, const N: usize>(pub [T::Bits; N]);

/// An array from an expression of the lane's index.
///
/// A plain loop over a local array: unlike `std::array::from_fn` it holds no call that the inliner
/// might leave standing in a long kernel, where a single one costs more than the kernel.
macro_rules! lanes_of {
    ($start:expr; |$i:ident| $lane:expr) => {{
        let mut lanes = [$start; N];
        let mut $i = 0;
        while $i < N {
            lanes[$i] = $lane;
            $i += 1;
        }
        lanes
    }};
}

impl<T: Real, const N: usize> Lanes<T, N> {
    /// Returns lanes with a number in each.
    #[inline(always)]
    pub fn splat(x: T) -> Self {
        Lanes([x; N])
    }
    /// Returns the first `N` numbers of a slice.
    ///
    /// # Panics
    ///
    /// When the slice is shorter than `N`.
    #[inline(always)]
    pub fn load(from: &[T]) -> Self {
        let from = &from[..N];
        Lanes(lanes_of!(from[0]; |i| from[i]))
    }
}

impl<T: Real, const N: usize> BitAnd for LaneMask<T, N> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        LaneMask(lanes_of!(T::NONE; |i| T::and(self.0[i], other.0[i])))
    }
}
impl<T: Real, const N: usize> BitOr for LaneMask<T, N> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        LaneMask(lanes_of!(T::NONE; |i| T::or(self.0[i], other.0[i])))
    }
}
impl<T: Real, const N: usize> Not for LaneMask<T, N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        LaneMask(lanes_of!(T::NONE; |i| T::not(self.0[i])))
    }
}

/// The arithmetic of one format.
macro_rules! lanes {
    ($f:ident, $bits:ident, $sin_cos:ident, $split:expr) => {
        impl<const N: usize> Add for Lanes<$f, N> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i] + other.0[i]))
            }
        }
        impl<const N: usize> Sub for Lanes<$f, N> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i] - other.0[i]))
            }
        }
        impl<const N: usize> Mul for Lanes<$f, N> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i] * other.0[i]))
            }
        }
        impl<const N: usize> Div for Lanes<$f, N> {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i] / other.0[i]))
            }
        }
        impl<const N: usize> Neg for Lanes<$f, N> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Lanes(lanes_of!(0.0; |i| -self.0[i]))
            }
        }
        impl<const N: usize> AddAssign for Lanes<$f, N> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl<const N: usize> SubAssign for Lanes<$f, N> {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl<const N: usize> MulAssign for Lanes<$f, N> {
            #[inline(always)]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
        impl<const N: usize> Mask for LaneMask<$f, N> {
            #[inline(always)]
            fn any(self) -> bool {
                let mut any = 0;
                let mut i = 0;
                while i < N {
                    any |= self.0[i];
                    i += 1;
                }
                any != 0
            }
            #[inline(always)]
            fn all(self) -> bool {
                let mut all = !0;
                let mut i = 0;
                while i < N {
                    all &= self.0[i];
                    i += 1;
                }
                all == !0
            }
        }

        impl<const N: usize> Scalar for Lanes<$f, N> {
            type Mask = LaneMask<$f, N>;
            type Primal = Self;
            #[inline(always)]
            fn format() -> crate::scalar::Format {
                <$f as Scalar>::format()
            }
            #[inline(always)]
            fn lit(x: f64) -> Self {
                Lanes([x as $f; N])
            }
            #[inline(always)]
            fn from_primal(x: Self) -> Self {
                x
            }
            #[inline(always)]
            fn primal(self) -> Self {
                self
            }
            #[inline(always)]
            fn below(self, other: Self) -> Self::Mask {
                LaneMask(lanes_of!(0; |i| <$f>::mask(self.0[i] < other.0[i])))
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> Self::Mask {
                LaneMask(lanes_of!(0; |i| <$f>::mask(self.0[i] <= other.0[i])))
            }
            #[inline(always)]
            fn equals(self, other: Self) -> Self::Mask {
                LaneMask(lanes_of!(0; |i| <$f>::mask(self.0[i] == other.0[i])))
            }
            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| <$f>::choose(mask.0[i], yes.0[i], no.0[i])))
            }
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }
            #[inline(always)]
            fn root(self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::root(self.0[i])))
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let wide = Lanes::<f64, N>(lanes_of!(0.0; |i| self.0[i].widen()));
                let (sin, cos) = $sin_cos(wide, far_sin_cos);
                (
                    Lanes(lanes_of!(0.0; |i| sin.0[i] as $f)),
                    Lanes(lanes_of!(0.0; |i| cos.0[i] as $f)),
                )
            }
            #[inline(always)]
            fn sin_cos_parts(self) -> [(Self, Self); 2] {
                let wide = Lanes::<f64, N>(lanes_of!(0.0; |i| self.0[i].widen()));
                let (sin, cos) = $sin_cos(wide, far_sin_cos);
                let sin_high = lanes_of!(0.0; |i| $split(sin.0[i]).0);
                let sin_low = lanes_of!(0.0; |i| $split(sin.0[i]).1);
                let cos_high = lanes_of!(0.0; |i| $split(cos.0[i]).0);
                let cos_low = lanes_of!(0.0; |i| $split(cos.0[i]).1);
                [
                    (Lanes(sin_high), Lanes(sin_low)),
                    (Lanes(cos_high), Lanes(cos_low)),
                ]
            }
            #[inline(always)]
            fn parts(self) -> (Self, Self) {
                let high = Lanes(lanes_of!(0.0; |i| self.0[i].high()));
                (high, self - high)
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::atan2(self.0[i], x.0[i])))
            }
            #[inline]
            fn exp(self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::exp(self.0[i])))
            }
            #[inline]
            fn ln(self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::ln(self.0[i])))
            }
            #[inline(always)]
            fn binade(self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::binade(self.0[i])))
            }
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::least(self.0[i], other.0[i])))
            }
            #[inline(always)]
            fn most(self, other: Self) -> Self {
                Lanes(lanes_of!(0.0; |i| Scalar::most(self.0[i], other.0[i])))
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i].abs()))
            }
            #[inline(always)]
            fn unsigned(self) -> Self {
                Lanes(lanes_of!(0.0; |i| self.0[i].abs()))
            }
            #[inline(always)]
            fn known(self, known: Self::Mask, nan: Self) -> Self {
                Self::select(known, self, nan)
            }
            #[inline(always)]
            fn damp(self, _share: Self) -> Self {
                self
            }
            #[inline(always)]
            fn with_primal(self, value: Self) -> Self {
                value
            }
        }
    };
}

/// Returns sine and cosine lane by lane, for angles that the polynomial does not serve.
#[inline(never)]
fn far_sin_cos<const N: usize>(angle: Lanes<f64, N>) -> (Lanes<f64, N>, Lanes<f64, N>) {
    (
        Lanes(lanes_of!(0.0; |i| libm::sin(angle.0[i]))),
        Lanes(lanes_of!(0.0; |i| libm::cos(angle.0[i]))),
    )
}

lanes!(f32, u32, sin_cos_single, split_single);
lanes!(f64, u64, sin_cos_wide, Scalar::parts);
