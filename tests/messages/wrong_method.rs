//~ the method `giou` exists for struct `geograd::Circle<f64>`, but its trait bounds were not satisfied
//~ `geograd::kernels::Giou: geograd::kernels::Binary<geograd::Circle<f64>, _>`
use geograd::prelude::*;

pub fn score(shape: Circle<f64>, other: Circle<f64>) -> f64 {
    shape.giou(other)
}
