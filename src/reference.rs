//! The local frame of polygons: an origin near them and a unit of length of their own. So neither the distance from the
//! origin nor the size costs digits, and no product over- or underflows.
use crate::scalar::power_of_largest;
use crate::{Aabb2, Scalar, Vec2};

/// An origin and a unit of length for vertices; all of it constant, without derivatives.
///
/// Measures that are sums over the edges of closed rings do not depend on it: their bodies, one per edge, take
/// [local](Reference::place) vertices, and their results are converted back by [`outer`](Reference::outer).
///
/// ```
/// use geograd::{Vec2, reference::Reference};
/// let ring = [Vec2::new(1e6, 0.0), Vec2::new(1e6 + 4.0, 0.0), Vec2::new(1e6, 3.0)];
/// let seen = Reference::of_ring(&ring);
/// let length = (seen.place(ring[1]) - seen.place(ring[0])).length();
/// assert_eq!(seen.outer(length), 4.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
pub struct Reference<S> {
    /// A corner of the shape's bounds, in the caller's coordinates.
    pub origin: Vec2<S>,
    /// The zero of local coordinates: a point relative to the origin, in local units.
    pub shift: Vec2<S>,
    /// The power of two that brings half a length to local units.
    pub scale: S,
}

impl<S: Scalar> Reference<S> {
    /// Creates the frame of one shape, given by its bounds: the origin is their lower left corner.
    #[must_use]
    #[inline(always)]
    pub fn of_bounds(bounds: Aabb2<S>) -> Self {
        let (low, high) = constants(bounds);
        let size = reach(halved(high) - halved(low));
        Reference {
            origin: low,
            shift: Vec2::zero(),
            scale: unit(size, size),
        }
    }
    /// Creates the frame of one ring or set of points; without points its origin is zero.
    #[must_use]
    #[inline]
    pub fn of_ring(ring: &[Vec2<S>]) -> Self {
        let zero = Aabb2 {
            min: Vec2::zero(),
            max: Vec2::zero(),
        };
        Self::of_bounds(bounds_of(ring).unwrap_or(zero))
    }
    /// Creates the frame of two shapes, given by their bounds: origin and unit are those of the smaller one (unless the
    /// other is very much larger). Returns also if `a` is the smaller one, and if the bounds are apart or merely touch:
    /// then the unit is that of both together.
    #[must_use]
    #[inline(always)]
    pub fn of_pair(a: Aabb2<S>, b: Aabb2<S>) -> (Self, S::Mask, S::Mask) {
        let ((low_a, high_a), (low_b, high_b)) = (constants(a), constants(b));
        let size_a = reach(halved(high_a) - halved(low_a));
        let size_b = reach(halved(high_b) - halved(low_b));
        let in_a = size_a.at_most(size_b);
        let apart = high_a.x.at_most(low_b.x)
            | high_b.x.at_most(low_a.x)
            | high_a.y.at_most(low_b.y)
            | high_b.y.at_most(low_a.y);
        let low = Vec2::new(lower(low_a.x, low_b.x), lower(low_a.y, low_b.y));
        let high = Vec2::new(-lower(-high_a.x, -high_b.x), -lower(-high_a.y, -high_b.y));
        let joint = reach(halved(high) - halved(low));
        let (smaller, larger) = (size_a.least(size_b), size_a.most(size_b));
        let smaller = S::select(apart, joint, smaller);
        let seen = Reference {
            origin: Vec2::select(in_a, low_a, low_b),
            shift: Vec2::zero(),
            scale: unit(smaller, larger.most(smaller)),
        };
        (seen, in_a, apart)
    }
    /// Returns the frame with a unit that allows fourth powers of length. A shape longer than 2³⁰ in single precision
    /// is 2²⁶ local units instead of one. Then the fourth power of the unit is finite. So is the factor of derivatives
    /// by local coordinates in the backward pass, before the unit itself divides them. A shape longer than 2³⁵ stays as
    /// it is: see [`too_long`](Reference::too_long).
    #[must_use]
    #[inline(always)]
    pub(crate) fn of_fourth_powers(mut self) -> Self {
        let (least, most) = (least_unit::<S>(), S::lit(0.25 * ratio::<S>()));
        let last = least * S::largest_to(0.21875 * 5.0 / 28.0).binade();
        let held = self.scale.below(least) & self.scale.at_least(last);
        self.scale = S::select(held, self.scale.over(most.binade()), self.scale);
        self
    }
    /// Creates the frame for moments of a shape, given by its bounds: the origin is their middle, the unit allows
    /// fourth powers of length.
    #[must_use]
    #[inline(always)]
    pub(crate) fn of_moments(bounds: Aabb2<S>) -> Self {
        let seen = Self::of_bounds(bounds).of_fourth_powers();
        let far = seen.place(bounds.max);
        seen.shifted(Vec2::new(far.x.halved(), far.y.halved()))
    }
    /// Returns `true` where the fourth power of the unit need not be finite.
    #[inline(always)]
    pub(crate) fn too_long(&self) -> S::Mask {
        self.scale.below(least_unit::<S>())
    }
    /// Returns the frame with its local origin moved by a vector in its present coordinates.
    #[must_use]
    #[inline(always)]
    pub fn shifted(mut self, by: Vec2<S>) -> Self {
        self.shift += by.constant();
        self
    }
    /// Returns a vertex in local coordinates. A vertex too far away to matter stays where it is just that far.
    #[must_use]
    #[inline(always)]
    pub fn place(&self, vertex: Vec2<S>) -> Vec2<S> {
        let far = S::lit(4.0 * ratio::<S>());
        let near = |x: S| {
            let beyond = S::select(x.below(S::zero()), -far, far);
            S::select(x.unsigned().at_most(far), x, beyond)
        };
        // Halved, since the whole difference may not be finite.
        let seen = (halved(vertex) - halved(self.origin)) * self.scale;
        Vec2::new(near(seen.x), near(seen.y)) - self.shift
    }
    /// Returns the area of a ring in local units, relative to its own first vertex.
    #[must_use]
    #[inline]
    pub(crate) fn own_area(&self, ring: &[Vec2<S>]) -> S {
        let Some((&first, rest)) = ring.split_first() else {
            return S::zero();
        };
        let from = halved(first);
        let ways = rest
            .iter()
            .map(|&vertex| (halved(vertex) - from) * self.scale);
        let twice = ways.clone().zip(ways.skip(1)).map(|(p, q)| p.perp_dot(q));
        twice.fold(S::zero(), |sum, twice| sum + twice).halved()
    }
    /// Returns a local length in the caller's unit. Areas go through it twice.
    #[must_use]
    #[inline(always)]
    pub fn outer(&self, length: S) -> S {
        (length + length).over(self.scale)
    }
    /// Returns a local position in the caller's coordinates.
    #[must_use]
    #[inline(always)]
    pub fn outer_place(&self, at: Vec2<S>) -> Vec2<S> {
        let at = at + self.shift;
        Vec2::new(
            (self.origin.x + self.outer(at.x)).saturated(),
            (self.origin.y + self.outer(at.y)).saturated(),
        )
    }
    /// Returns the caller's derivative by a vertex, from a derivative by its local coordinates of something whose unit
    /// is length to the power `power`.
    #[must_use]
    #[inline(always)]
    pub fn outer_derivative(&self, derivative: Vec2<S>, power: i32) -> Vec2<S> {
        let (mut x, mut y) = (derivative.x, derivative.y);
        for _ in 1..power {
            (x, y) = (self.outer(x), self.outer(y));
        }
        if power < 1 {
            (x, y) = ((x * self.scale).halved(), (y * self.scale).halved());
        }
        Vec2::new(x.saturated(), y.saturated()).canonical()
    }
}

/// Returns the smallest axis-aligned box around points, as constants; `None` for none.
#[must_use]
#[inline]
pub fn bounds_of<S: Scalar>(points: &[Vec2<S>]) -> Option<Aabb2<S>> {
    let (&first, rest) = points.split_first()?;
    let first = first.constant();
    let (mut min, mut max) = (first, first);
    for &point in rest {
        let point = point.constant();
        min = Vec2::new(lower(min.x, point.x), lower(min.y, point.y));
        max = Vec2::new(-lower(-max.x, -point.x), -lower(-max.y, -point.y));
    }
    Some(Aabb2 { min, max })
}

/// Returns the limit for the larger of two sizes in local units, 2²⁸ in single precision. It keeps products of four
/// lengths finite; a smaller size loses digits relative to it.
#[inline(always)]
fn ratio<S: Scalar>() -> f64 {
    power_of_largest::<S>(0.21875)
}

/// Returns the scale of the longest unit with a fourth power that is finite, the unit being two lengths.
#[inline(always)]
fn least_unit<S: Scalar>() -> S {
    S::lit(4.0 * ratio::<S>()).binade()
}

/// Returns the power of two that brings the smaller size near one, unless the other becomes too large.
#[inline(always)]
fn unit<S: Scalar>(smaller: S, larger: S) -> S {
    let bounded = smaller.most(larger * S::lit(1.0 / ratio::<S>()));
    let point = larger.at_most(S::zero());
    // A point in something large: that one's own unit.
    let size = S::select(smaller.at_most(S::zero()), larger, bounded);
    S::select(point, S::one(), S::select(point, S::one(), size).binade())
}

#[inline(always)]
fn lower<S: Scalar>(x: S, y: S) -> S {
    S::select(y.below(x), y, x)
}
#[inline(always)]
fn constants<S: Scalar>(bounds: Aabb2<S>) -> (Vec2<S>, Vec2<S>) {
    (bounds.min.constant(), bounds.max.constant())
}
#[inline(always)]
fn halved<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    Vec2::new(v.x.halved(), v.y.halved())
}
#[inline(always)]
fn reach<S: Scalar>(v: Vec2<S>) -> S {
    v.x.unsigned().most(v.y.unsigned())
}
