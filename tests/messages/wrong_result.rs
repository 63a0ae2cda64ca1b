//~ expected `Vec2<S>`, found type parameter `S`
use geograd::{Vec2, operation};

operation! {
    /// Half of a number.
    pub Half = "half": (x: S) -> Vec2<S> { x.halved() }
    invariances []
    jumps Never
    derivative Reverse
}
