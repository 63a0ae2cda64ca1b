//! Scores of boxes of space whose derivatives are those of no function.
use geograd::iou3::{Enclosing, ciou_fixed_weight};
use geograd::{Aabb3, Obb3, YawBox3, operation};

/// Declares the rows of the complete IoU with a constant weight, by the enclosing shape of the row without.
macro_rules! fixed {
    ($($Row:ident = $name:literal: $Box:ident, $kind:ident;)*) => {
        $(operation! {
            /// The complete IoU whose weight counts as a constant: the value is that of `ciou`, the derivatives leave the
            /// weight's out.
            pub $Row = $name: (a: $Box<S>, b: $Box<S>) -> S { ciou_fixed_weight(a, b, Enclosing::$kind) }
            invariances [] jumps Anywhere derivative Forward
        })*
    };
}
fixed! {
    OfAabb3 = "ciou_fixed_weight_aabb3": Aabb3, Aabb;
    OfYawBox3 = "ciou_fixed_weight_yaw": YawBox3, Hull;
    OfObb3 = "ciou_fixed_weight_obb3": Obb3, Rectangle;
}
