//! What makes shapes of shapes, as operations.
use crate::operation;
use crate::shape::circumcircle;
use crate::{Circle, Pose2, Segment2, Triangle2, Vec2};

operation! {
    /// The circle through three points ([`circumcircle`]). It jumps where they are on one line.
    pub Circumcircle = "circumcircle": (a: Vec2<S>, b: Vec2<S>, c: Vec2<S>) -> Circle<S> {
        circumcircle(a, b, c)
    }
    promises []
    jumps Anywhere
    slopes Reverse

    /// The [inscribed circle](Triangle2::incircle) of a triangle.
    pub Incircle = "incircle": (shape: Triangle2<S>) -> Circle<S> { shape.incircle() }
    promises [TranslationX Follows, TranslationY Follows, Rotation Follows, Scaling Follows]
    jumps Never
    slopes Reverse

    /// A segment, moved.
    pub MoveSegment = "move_segment": (pose: Pose2<S>, segment: Segment2<S>) -> Segment2<S> {
        pose * segment
    }
    promises []
    jumps Never
    slopes Reverse
}
