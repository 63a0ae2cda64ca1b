//~ type mismatch resolving `<S as Scalar>::Mask == bool`
use geograd::{Scalar, operation};

fn ramp<S: Scalar<Mask = bool>>(x: S) -> S {
    if x.below(S::zero()) { S::zero() } else { x }
}

operation! {
    /// A ramp that branches.
    pub Ramp = "ramp": (x: S) -> S { ramp(x) }
    invariances []
    jumps Never
    derivative Reverse
}
