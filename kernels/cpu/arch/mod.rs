//! Explicit vectors as scalars: the one module with `unsafe` code.
//!
//! # Why
//!
//! Arrays of lanes (`Lanes`) leave it to the compiler to find vector instructions. For long kernels that takes a minute
//! each, and harmless edits halve the speed. Types made of processor vectors compile twenty times as fast and guarantee
//! the instructions. A [`Scalar`] has no argument that could check that the processor has them, since `S::lit(1.0)`
//! takes none.
//!
//! # Why it is sound
//!
//! The types are private to this module and reach the rest of the crate only as the parameter `V` of the kernels
//! listed in [`entry`]. Each entry instantiates its kernel inside a function compiled for the instruction set of `V`,
//! and calls it only if [`Simd`](crate::kernels::cpu::simd::Simd) says that the processor has it. So no vector
//! operation runs where it might not exist.
//!
//! # Same bits
//!
//! Every operation is the one IEEE operation that the plain number has: no fused multiply-add, no
//! approximate reciprocal; minimum and maximum take the second operand of a tie, as
//! `if a < b { a } else { b }` does.
mod entry;
pub(crate) mod memory;
#[cfg(all(target_arch = "x86_64", feature = "native", not(geograd_portable)))]
mod native;
#[cfg(not(all(target_arch = "x86_64", feature = "native", not(geograd_portable))))]
mod no_native;
#[cfg(all(target_arch = "x86_64", not(geograd_portable)))]
mod x86;

pub use entry::Kernels;
pub use entry::of_f32::KERNELS as F32;
pub use entry::of_f64::KERNELS as F64;
pub(crate) use memory::flat;
#[cfg(all(target_arch = "x86_64", feature = "native", not(geograd_portable)))]
pub(crate) use native::{BoundCode, Native};
#[cfg(not(all(target_arch = "x86_64", feature = "native", not(geograd_portable))))]
pub(crate) use no_native::{BoundCode, Native};

use crate::kernels::cpu::lane::{Lane, TILE};
use crate::mesh::EightLanes;
use crate::scalar::lanes::LaneMask;
use crate::{Lanes, Scalar};
use std::hint::black_box;

/// `true` if the largest kernels (boxes of any orientation, derivatives of quadrilaterals) are compiled. Compiling them
/// from plain code would take minutes, so plain targets interpret them, with equal bits.
pub(crate) const LARGE: bool = cfg!(all(target_arch = "x86_64", not(geograd_portable)));

/// A part of a [`Lane`] as a scalar.
pub(crate) trait Vector<T>: Scalar<Primal = Self> {
    /// The number of lanes of a vector: a power of two, at most [`TILE`].
    const WIDTH: usize;
    /// `true` if the number of parts of a lane must be hidden from the compiler. It would otherwise unroll the loop of
    /// plain code, and run out of registers.
    const HIDDEN: bool = false;
    /// Returns the index at which each part of a lane begins.
    #[inline(always)]
    fn starts() -> impl Iterator<Item = usize> {
        (0..TILE / Self::WIDTH).map(
            #[inline(always)]
            |part| match Self::HIDDEN {
                true => black_box(part) * Self::WIDTH,
                false => part * Self::WIDTH,
            },
        )
    }
    /// Returns the numbers of a lane from index `at` on, a multiple of the width below [`TILE`].
    fn read(lane: &Lane<T>, at: usize) -> Self;
    /// Writes the numbers into a lane from index `at` on.
    fn write(self, lane: &mut Lane<T>, at: usize);
    /// Returns a vector with `x` in every place.
    fn splat(x: T) -> Self;
    /// Returns one bit per number, the first number's lowest.
    fn bits(mask: Self::Mask) -> u32;
    /// Returns truths as numbers whose bits are all ones or all zeros.
    fn word(mask: Self::Mask) -> Self;
    /// Returns the truths that [`word`](Vector::word) encoded.
    fn truth(self) -> Self::Mask;
    /// Transposes items to vectors: returns one vector for each of the four fields of `WIDTH` items.
    fn from_items(item: impl Fn(usize) -> [T; 4]) -> [Self; 4];
    /// Transposes vectors to items: passes the four fields of every item to `put`.
    fn to_items(fields: [Self; 4], put: impl FnMut(usize, [T; 4]));
}

/// The vectors of single precision for searches in trees of eight, beside a vector of any format: eight numbers at most.
pub(crate) trait Eights {
    /// The vector.
    type Eight: EightLanes;
}

impl Eights for Lanes<f32, 4> {
    type Eight = Lanes<f32, 4>;
}
impl Eights for Lanes<f64, 2> {
    type Eight = Lanes<f32, 4>;
}

/// Implements [`Vector`] for plain arrays whose width every target has vectors of.
macro_rules! plain {
    ($t:ident, $n:literal) => {
        impl Vector<$t> for Lanes<$t, $n> {
            const WIDTH: usize = $n;
            const HIDDEN: bool = true;
            #[inline(always)]
            fn read(lane: &Lane<$t>, at: usize) -> Self {
                Lanes(lane.0.as_chunks().0[at / $n % (TILE / $n)])
            }
            #[inline(always)]
            fn write(self, lane: &mut Lane<$t>, at: usize) {
                lane.0.as_chunks_mut().0[at / $n % (TILE / $n)] = self.0;
            }
            #[inline(always)]
            fn splat(x: $t) -> Self {
                Lanes([x; $n])
            }
            #[inline(always)]
            fn bits(mask: Self::Mask) -> u32 {
                let mut bits = 0;
                let mut i = 0;
                while i < $n {
                    bits |= ((mask.0[i] & 1) as u32) << i;
                    i += 1;
                }
                bits
            }
            #[inline(always)]
            fn word(mask: Self::Mask) -> Self {
                let mut word = [0.0; $n];
                let mut i = 0;
                while i < $n {
                    word[i] = $t::from_bits(mask.0[i]);
                    i += 1;
                }
                Lanes(word)
            }
            #[inline(always)]
            fn truth(self) -> Self::Mask {
                let mut mask = LaneMask([0; $n]);
                let mut i = 0;
                while i < $n {
                    mask.0[i] = self.0[i].to_bits();
                    i += 1;
                }
                mask
            }
            #[inline(always)]
            fn from_items(item: impl Fn(usize) -> [$t; 4]) -> [Self; 4] {
                let mut fields = [Lanes([0.0; $n]); 4];
                let mut i = 0;
                while i < $n {
                    let [x, y, z, w] = item(i);
                    fields[0].0[i] = x;
                    fields[1].0[i] = y;
                    fields[2].0[i] = z;
                    fields[3].0[i] = w;
                    i += 1;
                }
                fields
            }
            #[inline(always)]
            fn to_items([x, y, z, w]: [Self; 4], mut put: impl FnMut(usize, [$t; 4])) {
                let mut i = 0;
                while i < $n {
                    put(i, [x.0[i], y.0[i], z.0[i], w.0[i]]);
                    i += 1;
                }
            }
        }
    };
}
plain!(f32, 4);
plain!(f64, 2);
