//! Boxes that stand upright.
use crate::shape::{Aabb3, Rotation3};
use crate::{Obb2, Scalar, Shape, Vec2, Vec3};

/// An upright box in space: centre, size along its own axes, and the heading of its own x axis about the
/// z axis, which points up, in radians (counter-clockwise seen from above). The seven numbers of
/// detectors. Valid when finite and of non-negative size; zero size is valid.
///
/// ```
/// use geograd::{Vec3, YawBox3};
/// let car = YawBox3::new(Vec3::new(10.0, 2.0, 0.8), Vec3::new(4.0, 2.0, 1.6), 0.3_f64);
/// assert!(car.contains(Vec3::new(10.0, 2.0, 1.6)));
/// assert!((car.volume() - 12.8).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding, except(Sample))]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct YawBox3<S> {
    /// The centre.
    #[shape(names("x", "y", "z"))]
    pub center: Vec3<S>,
    /// The size along the box's own x, y and z axes: length, width and height of a vehicle.
    #[shape(names("dx", "dy", "dz"), non_negative, length)]
    pub size: Vec3<S>,
    /// The angle of the box's own x axis in radians, counter-clockwise seen from above.
    #[shape(angle)]
    pub heading: S,
}

impl<S> YawBox3<S> {
    /// Creates a box from centre, size and heading, unchecked.
    #[inline(always)]
    pub const fn new(center: Vec3<S>, size: Vec3<S>, heading: S) -> Self {
        YawBox3 {
            center,
            size,
            heading,
        }
    }
}

impl<S: Scalar> YawBox3<S> {
    /// Returns the volume.
    #[must_use]
    #[inline(always)]
    pub fn volume(self) -> S {
        self.size.x * self.size.y * self.size.z
    }
    /// Returns the area of all six faces.
    #[must_use]
    #[inline(always)]
    pub fn surface(self) -> S {
        let size = self.size;
        let half = size.x * size.y + size.y * size.z + size.z * size.x;
        half + half
    }
    /// Returns the box seen from above, without its height.
    #[must_use]
    #[inline(always)]
    pub fn birds_eye(self) -> Obb2<S> {
        Obb2 {
            center: Vec2::new(self.center.x, self.center.y),
            size: Vec2::new(self.size.x, self.size.y),
            heading: self.heading,
        }
    }
    /// Returns the corners, in the order of [`FACES`](crate::shape::FACES).
    #[must_use]
    #[inline(always)]
    pub fn corners(self) -> [Vec3<S>; 8] {
        let [a, b, c, d] = self.birds_eye().corners();
        let half = self.size.z.halved();
        let (low, high) = (self.center.z - half, self.center.z + half);
        let at = |p: Vec2<S>, z: S| Vec3::new(p.x, p.y, z);
        [
            at(a, low),
            at(b, low),
            at(d, low),
            at(c, low),
            at(a, high),
            at(b, high),
            at(d, high),
            at(c, high),
        ]
    }
    /// Returns `true` where the point is in the box; the border belongs to it.
    #[must_use]
    #[inline(always)]
    pub fn contains(self, point: Vec3<S>) -> S::Mask {
        let up = (point.z - self.center.z).magnitude();
        self.birds_eye().contains(Vec2::new(point.x, point.y)) & up.at_most(self.size.z.halved())
    }
    /// Returns the smallest axis-aligned box around it. Kinks at multiples of a quarter turn.
    #[must_use]
    #[inline(always)]
    pub fn bounding(self) -> Aabb3<S> {
        let flat = self.birds_eye().bounding();
        let half = self.size.z.halved();
        Aabb3::new(
            Vec3::new(flat.min.x, flat.min.y, self.center.z - half),
            Vec3::new(flat.max.x, flat.max.y, self.center.z + half),
        )
    }
    /// Returns the rotation of its own axes.
    #[must_use]
    #[inline(always)]
    pub fn rotation(self) -> Rotation3<S> {
        Rotation3::from_yaw(self.heading)
    }
}

impl<S: Scalar> From<Aabb3<S>> for YawBox3<S> {
    /// Returns the box as one with heading zero; a side longer than the largest number becomes that number.
    #[inline(always)]
    fn from(bounds: Aabb3<S>) -> Self {
        YawBox3::new(bounds.center(), bounds.size().saturated(), S::zero())
    }
}
