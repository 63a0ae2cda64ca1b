//~ `Tree<f64>` lacks one of `Clone`, `Copy`, `Debug` and `PartialEq`, which a shape derives, too
//~ write `#[derive(Clone, Copy, Debug, PartialEq, Shape)]`
use geograd::prelude::*;

#[derive(Clone, Copy, PartialEq, geograd::Shape)]
pub struct Tree<S> {
    foot: Vec2<S>,
    #[shape(positive)]
    pub height: S,
}
