//~ takes a function of one to six shapes
//~ a tuple has two to six columns; arrays, tuples and derived shapes hold more arguments in one
use geograd::kernels::function;
use geograd::prelude::*;

fn sum<S: Scalar>(a: S, b: S, c: S, d: S, e: S, f: S, g: S) -> S {
    a + b + c + d + e + f + g
}

pub fn all(x: &[f64]) -> Result<Vec<f64>, geograd::Error> {
    Cpu::new().aligned(function(sum), (x, x, x, x, x, x, x))
}
