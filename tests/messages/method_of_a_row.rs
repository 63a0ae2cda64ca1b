//~ the methods of distances do not take `Tree<f64>`
//~ a row of `Distance` for shapes of your own is called by `Distance.of(a, b)` and by batches
use geograd::operation;
use geograd::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
pub struct Tree<S> {
    foot: Vec2<S>,
}

operation! {
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S { car.distance(tree.foot) }
    invariances []
    jumps Never
    derivative Reverse
}

pub fn apart(car: Obb2<f64>, tree: Tree<f64>) -> f64 {
    car.distance(tree)
}
