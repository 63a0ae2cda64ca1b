//~ does not run on these columns
//~ generic over their scalar: `fn f<S: Scalar>(a: A<S>) -> S`, not `fn f(a: A<f64>) -> f64`
use geograd::kernels::function;
use geograd::prelude::*;

fn reach(point: Vec2<f64>) -> f64 {
    point.length()
}

pub fn all(points: &[Vec2<f64>]) -> Result<Vec<f64>, geograd::Error> {
    Cpu::new().aligned(function(reach), points)
}
