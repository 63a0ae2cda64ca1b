//~ the trait bound `Tree<S>: Pack` is not satisfied
use geograd::operation;
use geograd::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree<S> {
    foot: Vec2<S>,
}

operation! {
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S { car.distance(tree.foot) }
    invariances []
    jumps Never
    derivative Reverse
}
