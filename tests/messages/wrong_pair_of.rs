//~ `geograd::kernels::Distance` of `
//~ Ray2<f64>`
//~ does not take these two shapes
//~ `geograd::kernels::Distance` implements `geograd::kernels::Binary<
//~ exchange them, or run `function(f)` of any generic function
use geograd::prelude::*;

pub fn apart(ray: Ray2<f64>, curb: Segment2<f64>) -> f64 {
    Distance.of(ray, curb)
}
