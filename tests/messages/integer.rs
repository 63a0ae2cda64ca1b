//~ `{integer}` is not a number that shapes are made of
//~ write `2.0`, or `S::lit(2.0)` in a generic function
use geograd::Scalar;

fn half<S: Scalar>(x: S) -> S {
    x.halved()
}

pub fn one() {
    half(2);
}
