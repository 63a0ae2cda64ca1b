//~ type mismatch resolving `<Vec2<f64> as Pack>::Scalar == S`
//~ expected type parameter `S`, found `f64`
use geograd::{Vec2, operation};

operation! {
    /// The distance from the origin.
    pub Reach = "reach": (point: Vec2<f64>) -> f64 { point.length() }
    invariances []
    jumps Never
    derivative Reverse
}
