//~ `invariances […]` is missing after the formula: `invariances []` declares none
use geograd::operation;
use geograd::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Tree<S> {
    foot: Vec2<S>,
}

operation! {
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S { car.distance(tree.foot) }
    range NOT_NEGATIVE
    jumps Never
    derivative Reverse
}
