//~ cannot multiply `{float}` by `S`
use geograd::Scalar;

// The trait is of the standard library: the documentation of `Scalar` has the hint.
pub fn twice<S: Scalar>(x: S) -> S {
    2.0 * x
}
