//! Other people's conventions as types: a box in one of them must be converted before it can be used, so
//! a mistaken handedness, unit or order of numbers does not compile. All conversions are generic and have
//! derivatives.
//!
//! In this library angles are radians, counter-clockwise; in the plane x points to the right and y up, in
//! space z points up.
//!
//! | convention | type |
//! | --- | --- |
//! | degrees | [`Degrees`] |
//! | clockwise angles | [`Clockwise`] |
//! | headings that a half or a quarter turn leaves the same | [`Period`] |
//! | boxes in images, y down, angles from x towards y | [`ImageBox`] |
//! | mmrotate's `le90` and `le135`, OpenCV's `RotatedRect` | [`Le90`], [`Le135`], [`OpenCvBox`] |
//! | detectron2's `RotatedBoxes` | [`Detectron2Box`] |
//! | corners before turning, and an angle | [`Xyxyr`] |
//! | four corners | [`Obb2::corners`], [`Obb2::from_corners`] |
//! | KITTI's labels, in the camera's frame | [`KittiBox`] |
//! | OpenPCDet's boxes, in the lidar's frame | [`LidarBox`] |
//! | nuScenes' annotations | [`NuScenesBox`] |
//!
//! A clockwise angle is refused where a counter-clockwise one is meant:
//!
//! ```compile_fail
//! use geograd::{Obb2, convention::Clockwise};
//! let seen = Clockwise { radians: 0.3 };
//! let wrong = Obb2::new(0.0, 0.0, 4.0, 2.0, seen).area();
//! ```
//!
//! ```
//! use geograd::{Obb2, convention::{Clockwise, Counterclockwise}};
//! let seen = Clockwise { radians: 0.3_f64 };
//! let right = Obb2::new(0.0, 0.0, 4.0, 2.0, Counterclockwise::from(seen).radians);
//! assert_eq!(right.heading, -0.3);
//! ```
//!
//! [`Obb2::corners`]: crate::Obb2::corners
//! [`Obb2::from_corners`]: crate::Obb2::from_corners
mod angle;
mod plane;
mod space;

pub use angle::{Clockwise, Counterclockwise, Degrees, Period, Radians};
pub use plane::{Detectron2Box, ImageBox, Le90, Le135, OpenCvBox, Xyxyr};
pub use space::{KittiBox, LidarBox, NuScenesBox};
