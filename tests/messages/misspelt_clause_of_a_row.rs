//~ no rules expected `ranges`
//~ ranges NOT_NEGATIVE
use geograd::operation;
use geograd::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Tree<S> {
    foot: Vec2<S>,
}

operation! {
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S { car.distance(tree.foot) }
    invariances []
    ranges NOT_NEGATIVE
    jumps Never
    derivative Reverse
}
