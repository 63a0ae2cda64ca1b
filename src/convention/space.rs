//! Encodings of boxes in space.
use crate::shape::{Obb3, Rotation3, YawBox3};
use crate::{Scalar, Shape, Vec3};
use std::f64::consts::FRAC_PI_2;

/// A box of KITTI's labels, in the frame of a camera that looks ahead: x to the right, y down, z ahead.
///
/// As an upright box it is in the frame of a vehicle with the camera as origin, x ahead, y to the left, z up. (How a
/// real camera is mounted is a [`Pose3`](crate::shape::Pose3).)
///
/// ```
/// use geograd::{Vec3, YawBox3, convention::KittiBox};
/// let car = KittiBox {
///     height: 1.5, width: 1.6, length: 4.0,
///     location: Vec3::new(2.0, 1.7, 20.0),
///     rotation_y: -std::f64::consts::FRAC_PI_2, // drives ahead
/// };
/// let upright = YawBox3::from(car);
/// assert_eq!((upright.center.x, upright.center.y, upright.heading), (20.0, -2.0, 0.0));
/// assert!((upright.center.z + 0.95).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct KittiBox<S> {
    /// The size along the camera's y axis.
    #[shape(non_negative)]
    pub height: S,
    /// The size across the direction of travel.
    #[shape(non_negative)]
    pub width: S,
    /// The size along the direction of travel.
    #[shape(non_negative)]
    pub length: S,
    /// The middle of the bottom face.
    pub location: Vec3<S>,
    /// The turn about the camera's y axis in radians; zero for travel to the right.
    #[shape(kind = "AngleY")]
    pub rotation_y: S,
}

impl<S: Scalar> From<KittiBox<S>> for YawBox3<S> {
    #[inline]
    fn from(seen: KittiBox<S>) -> Self {
        let at = seen.location;
        YawBox3 {
            center: Vec3::new(at.z, -at.x, seen.height.halved() - at.y),
            size: Vec3::new(seen.length, seen.width, seen.height),
            heading: -(seen.rotation_y + S::lit(FRAC_PI_2)),
        }
    }
}
impl<S: Scalar> From<YawBox3<S>> for KittiBox<S> {
    #[inline]
    fn from(upright: YawBox3<S>) -> Self {
        let (c, size) = (upright.center, upright.size);
        KittiBox {
            height: size.z,
            width: size.y,
            length: size.x,
            location: Vec3::new(-c.y, size.z.halved() - c.z, c.x),
            rotation_y: -(upright.heading + S::lit(FRAC_PI_2)),
        }
    }
}

/// A box of OpenPCDet, in the lidar's frame (x ahead, y to the left, z up): the seven numbers
/// `x, y, z, dx, dy, dz, heading` with the centre of the box. Equal to [`YawBox3`].
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct LidarBox<S> {
    /// The centre of the box, not of its bottom.
    pub center: Vec3<S>,
    /// Length, width and height.
    #[shape(non_negative, length)]
    pub size: Vec3<S>,
    /// The turn about the z axis in radians, counter-clockwise; zero for travel along x.
    #[shape(angle)]
    pub heading: S,
}

impl<S> From<LidarBox<S>> for YawBox3<S> {
    #[inline(always)]
    fn from(seen: LidarBox<S>) -> Self {
        YawBox3::new(seen.center, seen.size, seen.heading)
    }
}
impl<S> From<YawBox3<S>> for LidarBox<S> {
    #[inline(always)]
    fn from(upright: YawBox3<S>) -> Self {
        LidarBox {
            center: upright.center,
            size: upright.size,
            heading: upright.heading,
        }
    }
}

/// A box of nuScenes' annotations: translation, size as width, length and height, rotation as a quaternion
/// `w, x, y, z`. The direction of travel is the box's own x axis.
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3, convention::NuScenesBox};
/// let seen = NuScenesBox {
///     translation: Vec3::new(1.0, 2.0, 3.0),
///     width: 1.8, length: 4.5, height: 1.5,
///     rotation: Rotation3::identity(),
/// };
/// assert_eq!(Obb3::from(seen).size, Vec3::new(4.5, 1.8, 1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct NuScenesBox<S> {
    /// The centre.
    pub translation: Vec3<S>,
    /// The size across the direction of travel.
    #[shape(non_negative)]
    pub width: S,
    /// The size along the direction of travel.
    #[shape(non_negative)]
    pub length: S,
    /// The size upwards.
    #[shape(non_negative)]
    pub height: S,
    /// The rotation of the box's own axes.
    pub rotation: Rotation3<S>,
}

impl<S> From<NuScenesBox<S>> for Obb3<S> {
    #[inline]
    fn from(seen: NuScenesBox<S>) -> Self {
        let size = Vec3::new(seen.length, seen.width, seen.height);
        Obb3::new(seen.translation, size, seen.rotation)
    }
}
impl<S> From<Obb3<S>> for NuScenesBox<S> {
    #[inline]
    fn from(shape: Obb3<S>) -> Self {
        NuScenesBox {
            translation: shape.center,
            width: shape.size.y,
            length: shape.size.x,
            height: shape.size.z,
            rotation: shape.rotation,
        }
    }
}
