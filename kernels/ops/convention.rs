//! Conversions between conventions of boxes as operations.
//!
//! Encodings with a chosen range jump at its ends, and where a box that is longer one way becomes longer the
//! other way.
use crate::convention::{
    Detectron2Box, ImageBox, KittiBox, Le90, Le135, LidarBox, NuScenesBox, OpenCvBox, Xyxyr,
};
use crate::operation;
use crate::shape::{Obb3, YawBox3};
use crate::{Obb2, Pack, Scalar, Vec2};

/// The same shape, its zeros without sign, as all results have them.
#[inline]
fn unsigned<S: Scalar, P: Pack<Scalar = S>>(mut shape: P) -> P {
    shape.each(&mut |x| *x = x.canonical());
    shape
}

operation! {
    /// An image's box as mmrotate's [`Le90`].
    pub Le90OfImageBox = "le90_of_image_box":
        (shape: ImageBox<S>) -> Le90<S> { unsigned(shape.into()) }
    promises []
    jumps Anywhere
    slopes Forward

    /// An image's box as mmrotate's [`Le135`].
    pub Le135OfImageBox = "le135_of_image_box":
        (shape: ImageBox<S>) -> Le135<S> { unsigned(shape.into()) }
    promises []
    jumps Anywhere
    slopes Forward

    /// An image's box as OpenCV has it.
    pub OpenCvOfImageBox = "open_cv_of_image_box":
        (shape: ImageBox<S>) -> OpenCvBox<S> { unsigned(shape.into()) }
    promises []
    jumps Anywhere
    slopes Forward

    /// An image's box as detectron2 has it.
    pub Detectron2OfImageBox = "detectron2_of_image_box":
        (shape: ImageBox<S>) -> Detectron2Box<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// detectron2's box as an image's box.
    pub ImageBoxOfDetectron2 = "image_box_of_detectron2":
        (shape: Detectron2Box<S>) -> ImageBox<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// An image's box where y points up, from the image's height.
    pub Obb2OfImageBox = "obb2_of_image_box":
        (shape: ImageBox<S>, image_height: S) -> Obb2<S> { unsigned(shape.upright(image_height)) }
    promises []
    jumps Never
    slopes Forward

    /// Bounds before turning, and the angle, as a rotated box.
    pub Obb2OfXyxyr = "obb2_of_xyxyr":
        (shape: Xyxyr<S>) -> Obb2<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// A rotated box as bounds before turning, and the angle.
    pub XyxyrOfObb2 = "xyxyr_of_obb2":
        (shape: Obb2<S>) -> Xyxyr<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// The [corners](Obb2::corners) of a rotated box.
    pub CornersOfObb2 = "corners_of_obb2":
        (shape: Obb2<S>) -> [Vec2<S>; 4] { unsigned(shape.corners()) }
    promises [TranslationX Follows, TranslationY Follows, Rotation Follows, Scaling Follows]
    jumps Never
    slopes Forward

    /// KITTI's box as an upright one.
    pub YawOfKitti = "yaw_of_kitti":
        (shape: KittiBox<S>) -> YawBox3<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// An upright box as KITTI has it.
    pub KittiOfYaw = "kitti_of_yaw":
        (shape: YawBox3<S>) -> KittiBox<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// OpenPCDet's box as an upright one.
    pub YawOfLidar = "yaw_of_lidar":
        (shape: LidarBox<S>) -> YawBox3<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// nuScenes' box as a box of any orientation.
    pub Obb3OfNuScenes = "obb3_of_nu_scenes":
        (shape: NuScenesBox<S>) -> Obb3<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward

    /// An upright box as a box of any orientation.
    pub Obb3OfYaw = "obb3_of_yaw":
        (shape: YawBox3<S>) -> Obb3<S> { unsigned(shape.into()) }
    promises []
    jumps Never
    slopes Forward
}
