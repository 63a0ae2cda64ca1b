// Arrays keep their own methods beside the traits of the prelude, by reference, too.
use geograd::prelude::*;

pub fn doubled(numbers: &[f64; 3], rows: &[[f64; 2]; 2]) -> ([f64; 3], [f64; 2]) {
    (numbers.map(|x| x + x), rows.map(|[a, b]| a + b))
}

pub fn single(numbers: &[f64; 3]) -> [f32; 3] {
    numbers.remake(&mut |&x| x as f32)
}
