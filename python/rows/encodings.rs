//! Encodings of axis-aligned boxes that data sets have.
use crate::unsigned;
use geograd::{Aabb2, Shape, Vec2, operation};

/// COCO's box: the corner of the smallest coordinates, and the size.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Xywh<S> {
    /// The corner of the smallest coordinates.
    pub min: Vec2<S>,
    /// Width and height.
    #[shape(non_negative, length)]
    pub size: Vec2<S>,
}

/// YOLO's box: the centre and the size.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Cxcywh<S> {
    /// The centre.
    pub center: Vec2<S>,
    /// Width and height.
    #[shape(non_negative, length)]
    pub size: Vec2<S>,
}

operation! {
    /// The axis-aligned box of COCO's box.
    pub OfXywh = "aabb2_of_xywh": (shape: Xywh<S>) -> Aabb2<S> {
        unsigned(Aabb2 { min: shape.min, max: shape.min + shape.size })
    }
    invariances [] jumps Never derivative Forward

    /// The axis-aligned box of YOLO's box.
    pub OfCxcywh = "aabb2_of_cxcywh": (shape: Cxcywh<S>) -> Aabb2<S> {
        let half = shape.size * S::lit(0.5);
        unsigned(Aabb2 { min: shape.center - half, max: shape.center + half })
    }
    invariances [] jumps Never derivative Forward

    /// COCO's box of an axis-aligned box.
    pub ToXywh = "xywh_of_aabb2": (shape: Aabb2<S>) -> Xywh<S> {
        unsigned(Xywh { min: shape.min, size: shape.size() })
    }
    invariances [] jumps Never derivative Forward

    /// YOLO's box of an axis-aligned box.
    pub ToCxcywh = "cxcywh_of_aabb2": (shape: Aabb2<S>) -> Cxcywh<S> {
        unsigned(Cxcywh { center: shape.center(), size: shape.size() })
    }
    invariances [] jumps Never derivative Forward
}
