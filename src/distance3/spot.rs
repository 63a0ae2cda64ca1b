//! Points of cores by numbers without derivatives: which features are nearest, and where on them.
use crate::arrays::Each;
use crate::distance::share::Carry;
use crate::{Scalar, Vec3};

/// A point of a core, or of the plane of one of its faces, as a core with derivatives can find it again.
#[derive(Clone, Copy, Debug)]
pub struct Spot<P> {
    /// For a hull of corners their shares; for a box one, then the coordinates relative to the centre along its axes.
    pub parts: [P; 4],
    /// 0 at a corner, else the number of the edge or face along which it is free, as [`Core3::free`](super::core::Core3::free) reads it.
    pub feature: P,
}

impl<P: Scalar> Spot<P> {
    /// Returns a corner of a hull.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn corner(k: usize) -> Self {
        let mut parts = [P::zero(); 4];
        parts[k] = P::one();
        Spot {
            parts,
            feature: P::zero(),
        }
    }
    /// Creates no point: all parts are zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn none() -> Self {
        let zero = P::zero();
        Spot {
            parts: [zero; 4],
            feature: zero,
        }
    }
    /// Adds the parts of another spot where a condition holds, and takes over its feature where another one does.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn add(&mut self, parts: P::Mask, other: Self, feature: P::Mask) {
        for (sum, part) in self.parts.iter_mut().zip(other.parts) {
            *sum += P::select(parts, part, P::zero());
        }
        self.feature = P::select(feature, other.feature, self.feature);
    }
    /// Puts the spot on a feature where a condition holds, else on a corner.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn on(self, free: P::Mask, feature: usize) -> Self {
        Spot {
            feature: P::select(free, P::lit(feature as f64), P::zero()),
            ..self
        }
    }
}

impl<P: Scalar> Carry<P> for Spot<P> {
    /// Sums have the feature of the first.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn join(self, other: Self, keep: P::Mask, tie: P::Mask) -> Self {
        Spot {
            parts: [0, 1, 2, 3].each_as(|k| self.parts[k].join(other.parts[k], keep, tie)),
            feature: P::select(keep | tie, self.feature, other.feature),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: P) -> Self {
        Spot {
            parts: self.parts.each_as(|part| part * factor),
            ..self
        }
    }
}

/// The mean of some spots, and how many they are.
#[derive(Clone, Copy, Debug)]
pub struct MeanSpot<P> {
    /// Their mean.
    pub spot: Spot<P>,
    /// The number of spots.
    pub count: P,
}

impl<P: Scalar> MeanSpot<P> {
    /// Returns the sum of one of the parts.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn part(&self, k: usize) -> P {
        self.spot.parts[k] * self.count
    }
}

/// The derivative of the height of a point of a core along a direction, by the numbers of the core.
#[derive(Clone, Copy, Debug)]
pub struct Pull<P> {
    /// By the corners of a hull; by the centre and the axes of a box.
    pub parts: [Vec3<P>; 4],
    /// By half the size of a box.
    pub half: [P; 3],
}

impl<P: Scalar> Pull<P> {
    /// Creates a derivative of zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn none() -> Self {
        Pull {
            parts: [Vec3::zero(); 4],
            half: [P::zero(); 3],
        }
    }
    /// Adds another one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn add(&mut self, other: Self) {
        for (sum, part) in self.parts.iter_mut().zip(other.parts) {
            *sum += part;
        }
        for (sum, half) in self.half.iter_mut().zip(other.half) {
            *sum += half;
        }
    }
    /// Returns a part of it.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn times(self, share: P) -> Self {
        Pull {
            parts: self.parts.each_as(|part| part * share),
            half: self.half.each_as(|half| half * share),
        }
    }
}

/// The features of two cores from which their relation is computed.
pub(super) struct CoreFeatures<P: Scalar> {
    /// The signed distance.
    pub gap: P,
    /// The square of the distance.
    pub square: P,
    /// The direction from a to b.
    pub normal: Vec3<P>,
    /// The point of a.
    pub on_a: Vec3<P>,
    /// The point of b.
    pub on_b: Vec3<P>,
    /// The point of a as its core finds it.
    pub at_a: Spot<P>,
    /// The point of b as its core finds it.
    pub at_b: Spot<P>,
    /// `true` if a plane gives the relation of the cores, which overlap or touch.
    pub inside: P::Mask,
    /// `true` if several planes or points do so equally.
    pub tied: P::Mask,
    /// The derivative of the height of a over all of them.
    pub pull_a: Pull<P>,
    /// The derivative by the numbers of b.
    pub pull_b: Pull<P>,
}

/// Returns a length's part of another one, from -1 to 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn part<P: Scalar>(x: P, whole: P) -> P {
    let (zero, one) = (P::zero(), P::one());
    let x = x.over(P::select(whole.equals(zero), one, whole));
    let x = P::select(one.below(x), one, x);
    P::select(x.below(-one), -one, x)
}

/// Returns a constant of a number with derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed<S: Scalar>(x: S::Primal) -> S {
    S::from_primal(x.primal())
}

/// Returns the vector of constants.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_vector<S: Scalar>(v: Vec3<S::Primal>) -> Vec3<S> {
    Vec3::new(fixed(v.x), fixed(v.y), fixed(v.z))
}

/// Returns the vector with other values and its own derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn valued<S: Scalar>(v: Vec3<S>, value: Vec3<S::Primal>) -> Vec3<S> {
    let one = |x: S, value: S::Primal| x.with_primal(value.primal());
    Vec3::new(one(v.x, value.x), one(v.y, value.y), one(v.z, value.z))
}

/// Returns a number that is zero within rounding as zero with its derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn vanish<S: Scalar>(x: S) -> S {
    x.with_primal(S::Primal::zero())
}

/// Returns a vector that is zero within rounding as zero with its derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn vanishing<S: Scalar>(v: Vec3<S>) -> Vec3<S> {
    Vec3::new(vanish(v.x), vanish(v.y), vanish(v.z))
}

/// Returns the vector without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn plain<S: Scalar>(v: Vec3<S>) -> Vec3<S::Primal> {
    Vec3::new(v.x.primal(), v.y.primal(), v.z.primal())
}
