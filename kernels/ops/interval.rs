//! Intervals of the number line as operations.
use crate::Interval;
use crate::kernels::ops::noun::Number;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{Distance, IntersectionLength, Iou, SignedDistance};

table! {
    /// [Intersection over union](Interval::iou) of {}, 0 to 1.
    Iou: (a, b) -> S { a.iou(b) } [similar, symmetric] (jumps FromZero) derivative Reverse {
        "iou_intervals": Interval, Interval;
    }
    /// [Length](Interval::intersection_length) that {} share.
    IntersectionLength: (a, b) -> S { a.intersection_length(b) }
    [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "intersection_length_intervals": Interval, Interval;
    }
    /// The [distance](Interval::distance) of {}.
    Distance: (a, b) -> S { a.distance(b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "distance_intervals": Interval, Interval;
        "distance_number_interval": Number, Interval { b.distance_to(a) };
        // Next to it the compiler does not read a wrong shape as the number of the line above, and its error lists
        // pairs.
        "distance_numbers": Number, Number { (a - b).magnitude() };
    }
    /// The [signed distance](Interval::signed_distance) of {}.
    SignedDistance: (a, b) -> S { a.signed_distance(b) } [rigid(1), symmetric] (jumps Never) derivative Reverse {
        "signed_distance_intervals": Interval, Interval;
    }
}
