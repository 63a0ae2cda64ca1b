//! Conversions between conventions of boxes as operations.
//!
//! Encodings in one frame follow motions; those of cameras and images have axes of their own. Encodings with a chosen
//! range of angles jump at its ends, and where width and height of a box become equal.
use crate::convention::{
    Detectron2Box, ImageBox, KittiBox, Le90, Le135, LidarBox, NuScenesBox, OpenCvBox, Xyxyr,
};
use crate::kernels::ops::noun::{Number, Quad};
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{Convert, Corners, FlipY};
use crate::{Obb2, Obb3, Pack, Scalar, YawBox3};

/// Returns a shape whose zeros have no sign, as all results require.
#[inline]
pub(super) fn unsigned<S: Scalar, P: Pack<Scalar = S>>(mut shape: P) -> P {
    shape.each(&mut |x| *x = x.canonical());
    shape
}

table! {
    /// mmrotate's [`Le90`] of an image's box.
    Convert<Le90<S>>: (shape) -> Le90<S> { unsigned(shape.into()) } [] (jumps Anywhere) derivative Forward {
        "le90_of_image_box": ImageBox;
    }
    /// mmrotate's [`Le135`] of an image's box.
    Convert<Le135<S>>: (shape) -> Le135<S> { unsigned(shape.into()) } [] (jumps Anywhere) derivative Forward {
        "le135_of_image_box": ImageBox;
    }
    /// OpenCV's box of an image's box.
    Convert<OpenCvBox<S>>: (shape) -> OpenCvBox<S> { unsigned(shape.into()) } [] (jumps Anywhere) derivative Forward {
        "open_cv_of_image_box": ImageBox;
    }
    /// detectron2's box of an image's box.
    Convert<Detectron2Box<S>>: (shape) -> Detectron2Box<S> { unsigned(shape.into()) }
    [] (jumps Never) derivative Forward {
        "detectron2_of_image_box": ImageBox;
    }
    /// The image's box of {}.
    Convert<ImageBox<S>>: (shape) -> ImageBox<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "image_box_of_detectron2": Detectron2Box;
        "image_box_of_le90": Le90;
        "image_box_of_le135": Le135;
        "image_box_of_open_cv": OpenCvBox;
    }
    /// The rotated box of bounds before turning, and the angle.
    Convert<Obb2<S>>: (shape) -> Obb2<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "obb2_of_xyxyr": Xyxyr;
    }
    /// The bounds before turning, and the angle, of a rotated box.
    Convert<Xyxyr<S>>: (shape) -> Xyxyr<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "xyxyr_of_obb2": Obb2;
    }
    /// The upright box of {}.
    Convert<YawBox3<S>>: (shape) -> YawBox3<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "yaw_of_kitti": KittiBox;
        "yaw_of_lidar": LidarBox [follows];
    }
    /// KITTI's box of an upright box.
    Convert<KittiBox<S>>: (shape) -> KittiBox<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "kitti_of_yaw": YawBox3;
    }
    /// OpenPCDet's box of an upright box.
    Convert<LidarBox<S>>: (shape) -> LidarBox<S> { unsigned(shape.into()) } [follows] (jumps Never) derivative Forward {
        "lidar_of_yaw": YawBox3;
    }
    /// nuScenes' box of a box of any orientation.
    Convert<NuScenesBox<S>>: (shape) -> NuScenesBox<S> { unsigned(shape.into()) } [follows] (jumps Never)
    derivative Forward {
        "nu_scenes_of_obb3": Obb3;
    }
    /// The box of any orientation of {}.
    Convert<Obb3<S>>: (shape) -> Obb3<S> { unsigned(shape.into()) } [] (jumps Never) derivative Forward {
        "obb3_of_nu_scenes": NuScenesBox [follows];
        "obb3_of_yaw": YawBox3 [follows];
    }
    /// An image's box where y points up, from the image's height.
    FlipY: (shape, image_height) -> Obb2<S> { unsigned(shape.upright(image_height)) }
    [] (jumps Never) derivative Forward {
        "obb2_of_image_box": ImageBox, Number;
    }
    /// An image's box of a box whose y points up, from the image's height.
    FlipY: (shape, image_height) -> ImageBox<S> { unsigned(ImageBox::from_upright(shape, image_height)) }
    [] (jumps Never) derivative Forward {
        "image_box_of_obb2": Obb2, Number;
    }
    /// The [corners](Obb2::corners) of {}.
    Corners: (shape) -> Quad<S> { unsigned(shape.corners()) } [follows] (jumps Never) derivative Forward {
        "corners_of_obb2": Obb2;
    }
}
