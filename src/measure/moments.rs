//! Second moments of area and principal axes, as a fold over edges.
use crate::overlap_polygon::bounds_of_rings;
use crate::reference::Reference;
use crate::shape::edges;
use crate::{Scalar, Vec2};

/// The second moments of an area about a point, in fourth powers of length: `xx = ∫ x² dA`,
/// `yy = ∫ y² dA`, `xy = ∫ x y dA`. (An engineer's `I_x` is `yy`, the polar moment `xx + yy`.)
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
pub struct AreaMoments<S> {
    /// `∫ x² dA`.
    #[shape(number)]
    pub xx: S,
    /// `∫ y² dA`.
    #[shape(number)]
    pub yy: S,
    /// `∫ x y dA`.
    #[shape(number)]
    pub xy: S,
}

/// The principal axes of second moments.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
pub struct PrincipalAxes<S> {
    /// The larger moment: of squared distances along the first axis.
    pub major: S,
    /// The smaller moment: along the second axis, a quarter turn from the first.
    pub minor: S,
    /// The angle of the first axis in radians, counter-clockwise from x, in `[−π/2, π/2]`.
    pub angle: S,
}

impl<S: Scalar> AreaMoments<S> {
    /// Returns the principal axes.
    ///
    /// Kink: equal moments in all directions (a square, a circle), where angle and derivative are zero.
    ///
    /// ```
    /// use geograd::{ConvexPolygon, Obb2};
    /// let axes = ConvexPolygon::from(Obb2::new(5.0_f64, 2.0, 4.0, 1.0, 0.3)).second_moments().principal_axes();
    /// assert!((axes.angle - 0.3).abs() < 1e-14);
    /// assert!((axes.major - 64.0 / 12.0).abs() < 1e-13 && (axes.minor - 4.0 / 12.0).abs() < 1e-13);
    /// ```
    #[must_use]
    #[inline]
    pub fn principal_axes(self) -> PrincipalAxes<S> {
        let (mean, half) = (
            self.xx.halved() + self.yy.halved(),
            self.xx.halved() - self.yy.halved(),
        );
        let radius = half.hypot(self.xy);
        PrincipalAxes {
            major: (mean + radius).saturated().canonical(),
            minor: (mean - radius).saturated().canonical(),
            angle: self.xy.atan2(half).halved().canonical(),
        }
    }
    /// Returns the moments about a point at a distance from the centroid, given the area: the parallel axis
    /// theorem. `self` is about the centroid.
    #[must_use]
    #[inline]
    pub fn displaced(self, area: S, by: Vec2<S>) -> Self {
        AreaMoments {
            xx: (self.xx + area * by.x * by.x).saturated(),
            yy: (self.yy + area * by.y * by.y).saturated(),
            xy: (self.xy + area * by.x * by.y).saturated(),
        }
    }
}

/// The sums that give the moments, over edges in local coordinates: contributions are added. In order: twice the area,
/// six times `∫x`, `∫y`, twelve times `∫x²`, `∫y²`, twenty-four times `∫xy`.
pub type Sums<S> = [S; 6];

/// Returns the body of the fold: the contribution of the edge from `start` to `end`, in [local
/// coordinates](Reference::place).
///
/// With `k = p × q`: `k`, `(p + q) k`, `(p² + p q + q²) k` by coordinate, and
/// `(2 p_x p_y + p_x q_y + q_x p_y + 2 q_x q_y) k` (Green's theorem).
#[must_use]
#[inline(always)]
pub fn of_edge<S: Scalar>(start: Vec2<S>, end: Vec2<S>) -> Sums<S> {
    let cross = start.perp_dot(end);
    let square = |p: S, q: S| (p * p + p * q + q * q) * cross;
    let two = S::lit(2.0);
    let mixed = two * (start.x * start.y + end.x * end.y) + (start.x * end.y + end.x * start.y);
    [
        cross,
        (start.x + end.x) * cross,
        (start.y + end.y) * cross,
        square(start.x, end.x),
        square(start.y, end.y),
        mixed * cross,
    ]
}

/// Returns the end of the fold: second moments about the centroid, in the caller's unit. If the area is zero, there is
/// no centroid: they are zero, with derivative zero. A ring longer than 2³⁵ in single precision (2²⁶⁶ in double) has no
/// derivative: its moments are beyond all numbers unless nearly nothing is enclosed.
#[must_use]
#[inline(always)]
pub fn finish<S: Scalar>(sums: Sums<S>, seen: &Reference<S>) -> AreaMoments<S> {
    let [twice, x, y, xx, yy, xy] = sums;
    let flat = twice.equals(S::zero());
    let thrice = S::lit(3.0) * S::select(flat, S::one(), twice);
    // The centroid before the moments that are taken away about it: no product has more than four lengths.
    let mean = |x: S| S::select(flat, S::zero(), x).over(thrice);
    let (x, y) = (mean(x), mean(y));
    let central =
        |square: S, by: f64, p: S, q: S| square.over(S::lit(by)) - p * (q * twice.halved());
    let outer = |x: S| {
        let x = S::select(flat, S::zero(), x);
        let x = S::select(seen.too_long(), S::from_primal(x.primal()), x);
        let area = seen.outer(seen.outer(x));
        seen.outer(seen.outer(area)).saturated().canonical()
    };
    AreaMoments {
        xx: outer(central(xx, 12.0, x, x)),
        yy: outer(central(yy, 12.0, y, y)),
        xy: outer(central(xy, 24.0, x, y)),
    }
}

/// Returns the second moments of the area of a polygon about its centroid. The polygon is any number of rings:
/// holes are rings of the other orientation, and clockwise regions count negative.
///
/// Zero where the area is zero. Smooth elsewhere. Seen from the middle of the bounds, so the distance
/// from the origin costs no digits.
///
/// ```
/// use geograd::{Aabb2, measure::moments::second_moments};
/// let plate = Aabb2::new(7.0, 1.0, 9.0, 2.0).corners();
/// let moments = second_moments(&[&plate]);
/// assert!((moments.xx - 8.0_f64 / 12.0).abs() < 1e-15 && (moments.yy - 2.0 / 12.0).abs() < 1e-15);
/// assert!(moments.xy.abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn second_moments<S: Scalar>(rings: &[&[Vec2<S>]]) -> AreaMoments<S> {
    let zero = AreaMoments {
        xx: S::zero(),
        yy: S::zero(),
        xy: S::zero(),
    };
    let Some(bounds) = bounds_of_rings(rings) else {
        return zero;
    };
    let seen = Reference::of_moments(bounds);
    let mut sums = [S::zero(); 6];
    for ring in rings {
        for [start, end] in edges(ring) {
            let edge = of_edge(seen.place(start), seen.place(end));
            for (sum, of_edge) in sums.iter_mut().zip(edge) {
                *sum += of_edge;
            }
        }
    }
    finish(sums, &seen)
}
