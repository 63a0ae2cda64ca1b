//! Oriented (rotated) boxes in the plane.
use crate::error::{Flaw, Validate};
use crate::{Aabb2, Pose2, Rotation2, Scalar, Shape, Vec2};
use std::ops::Mul;

/// A rotated box in the plane: centre, size along its own axes, heading in radians
/// (counter-clockwise). Valid when finite and of non-negative size; zero size is valid.
///
/// A heading and that heading plus a half turn give one box.
///
/// ```
/// use geograd::Obb2;
/// let a = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let b = Obb2::new(0.0, 0.0, 4.0, 2.0, std::f64::consts::FRAC_PI_2);
/// assert!((a.iou(b) - 1.0 / 3.0).abs() < 1e-15);
/// assert_eq!(a.iou(a), 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Obb2<S> {
    /// The centre.
    #[shape(names("x", "y"))]
    pub center: Vec2<S>,
    /// Width and height, along the box's own x and y axes.
    #[shape(names("width", "height"), non_negative, length)]
    pub size: Vec2<S>,
    /// The angle of the box's own x axis in radians, counter-clockwise.
    #[shape(angle)]
    pub heading: S,
}

impl<S> Obb2<S> {
    /// Creates a box from centre, width, height and heading, unchecked.
    #[inline(always)]
    pub const fn new(x: S, y: S, width: S, height: S, heading: S) -> Self {
        Obb2 {
            center: Vec2::new(x, y),
            size: Vec2::new(width, height),
            heading,
        }
    }
}

impl<S: Scalar> Obb2<S> {
    /// Creates a box from centre, size and heading.
    ///
    /// # Errors
    ///
    /// When a field is not finite or a size is negative.
    pub fn try_new(center: Vec2<S>, size: Vec2<S>, heading: S) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        let made = Obb2 {
            center,
            size,
            heading,
        };
        made.validate().map(|()| made)
    }
    /// Returns the box nearest to a quadrilateral, given by its corners in order around it.
    ///
    /// The centre is the mean of the corners, the width runs along the first edge, and the axes are the mean of the
    /// directions of all four edges, weighted by length. Exact for rectangles. Corners may have either orientation; the
    /// heading is that of the first edge.
    ///
    /// Kinks: quadrilaterals of zero area, and those whose edges cancel (heading 0).
    ///
    /// ```
    /// use geograd::{Obb2, Vec2};
    /// let car = Obb2::new(1.0, 2.0, 4.0, 2.0, 0.5_f64);
    /// let again = Obb2::from_corners(car.corners());
    /// assert!((again.heading - 0.5).abs() < 1e-15 && (again.size.x - 4.0).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn from_corners(corners: [Vec2<S>; 4]) -> Self {
        let [a, b, c, d] = corners;
        let quarter = S::lit(0.25);
        // Relative to one corner, so that far from the origin no digits are lost.
        let center = a + ((b - a) + (c - a) + (d - a)) * quarter;
        let along = ((b - a) + (c - d)) * S::lit(0.5);
        let across = ((d - a) + (c - b)) * S::lit(0.5);
        let clockwise = along.perp_dot(across).below(S::zero());
        let side = S::select(clockwise, -S::one(), S::one());
        // The second axis turned back by a quarter counts for the direction of the first.
        let direction = along + Vec2::new(across.y, -across.x) * side;
        let heading = direction.angle();
        let axis = Rotation2::from_angle(heading);
        let local = |v: Vec2<S>| axis.inverse() * v;
        Obb2 {
            center,
            size: Vec2::new(local(along).x.magnitude(), local(across).y.magnitude()),
            heading,
        }
    }
    /// Returns the area; infinite beyond the largest number.
    #[must_use]
    #[inline(always)]
    pub fn area(self) -> S {
        self.size.x * self.size.y
    }
    /// Returns the motion from the box's own frame (centre at the origin, axes aligned) to the world.
    #[must_use]
    #[inline(always)]
    pub fn world_from_local(self) -> Pose2<S> {
        Pose2::new(self.center, self.heading)
    }
    /// Returns the corners, counter-clockwise; the first one is at minus half the size in the box's own
    /// frame, so the first edge runs along the heading.
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec2<S>; 4] {
        let pose = self.world_from_local();
        let (x, y) = (self.size.x.halved(), self.size.y.halved());
        [
            pose * Vec2::new(-x, -y),
            pose * Vec2::new(x, -y),
            pose * Vec2::new(x, y),
            pose * Vec2::new(-x, y),
        ]
    }
    /// Returns `true` where the point is in the box; the border belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec2<S>) -> S::Mask {
        let local = Rotation2::from_angle(self.heading).inverse() * (point - self.center);
        local.x.magnitude().at_most(self.size.x.halved())
            & local.y.magnitude().at_most(self.size.y.halved())
    }
    /// Returns the smallest axis-aligned box around it. Kinks at multiples of a quarter turn, where the
    /// derivative with respect to the heading is zero.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb2<S> {
        let axis = Rotation2::from_angle(self.heading);
        let (cos, sin) = (axis.cos.magnitude(), axis.sin.magnitude());
        let (x, y) = (self.size.x.halved(), self.size.y.halved());
        let reach = Vec2::new(x * cos + y * sin, x * sin + y * cos);
        Aabb2 {
            min: self.center - reach,
            max: self.center + reach,
        }
    }
}

impl<S: Scalar> From<Aabb2<S>> for Obb2<S> {
    /// Returns the box as one with heading zero.
    #[inline(always)]
    fn from(bounds: Aabb2<S>) -> Self {
        Obb2 {
            center: bounds.center(),
            size: bounds.size(),
            heading: S::zero(),
        }
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Obb2<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.center.fmt(f)?;
        f.write_str(" ")?;
        self.size.x.fmt(f)?;
        f.write_str(" × ")?;
        self.size.y.fmt(f)?;
        f.write_str(" at ")?;
        self.heading.fmt(f)?;
        f.write_str(" rad")
    }
}

impl<S: Scalar> Mul<Obb2<S>> for Pose2<S> {
    type Output = Obb2<S>;
    /// Returns the box carried along: `world_from_car * box_in_car` is the box in the world. Its heading
    /// grows by [`Pose2::angle`] and is not brought back into a range.
    ///
    /// ```
    /// use geograd::{Obb2, Pose2, Vec2};
    /// let world_from_car = Pose2::new(Vec2::new(10.0, 5.0), 0.5_f64);
    /// let seen = Obb2::new(8.0, 0.0, 4.0, 2.0, 0.1);
    /// let there = world_from_car * seen;
    /// assert_eq!(there.size, seen.size);
    /// assert!((there.heading - 0.6).abs() < 1e-15);
    /// assert!(there.corners()[0].distance(world_from_car * seen.corners()[0]) < 1e-14);
    /// ```
    #[inline(always)]
    fn mul(self, shape: Obb2<S>) -> Obb2<S> {
        Obb2 {
            center: self * shape.center,
            size: shape.size,
            heading: shape.heading + self.angle(),
        }
    }
}
