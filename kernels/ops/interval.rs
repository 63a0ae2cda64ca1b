//! Intervals of the number line as operations.
use crate::Interval;
use crate::operation;

operation! {
    /// The [IoU](Interval::iou) of two intervals.
    pub IouIntervals = "iou_intervals": (a: Interval<S>, b: Interval<S>) -> S { a.iou(b) }
    promises [Scaling Stays, Exchange Stays]
    jumps FromZero
    slopes Reverse

    /// The [length](Interval::intersection_length) that two intervals share.
    pub IntersectionLengthIntervals = "intersection_length_intervals":
        (a: Interval<S>, b: Interval<S>) -> S { a.intersection_length(b) }
    promises [Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [distance](Interval::distance) of two intervals.
    pub DistanceIntervals = "distance_intervals":
        (a: Interval<S>, b: Interval<S>) -> S { a.distance(b) }
    promises [Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [signed distance](Interval::signed_distance) of two intervals.
    pub SignedDistanceIntervals = "signed_distance_intervals":
        (a: Interval<S>, b: Interval<S>) -> S { a.signed_distance(b) }
    promises [Scaling Power(1), Exchange Stays]
    jumps Never
    slopes Reverse

    /// The [distance](Interval::distance_to) of a number from an interval.
    pub DistanceNumberInterval = "distance_number_interval":
        (x: S, interval: Interval<S>) -> S { interval.distance_to(x) }
    promises [Scaling Power(1)]
    jumps Never
    slopes Reverse
}
