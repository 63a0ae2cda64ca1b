//~ `Tree<f64>` lacks one of `Clone`, `Copy`, `Debug` and `PartialEq`, which a shape derives, too
use geograd::operation;
use geograd::prelude::*;

#[derive(Clone, Debug, PartialEq, geograd::Shape)]
pub struct Tree<S> {
    foot: Vec2<S>,
}

operation! {
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S { car.distance(tree.foot) }
    invariances []
    jumps Never
    derivative Reverse
}
