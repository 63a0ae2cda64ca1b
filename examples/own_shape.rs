//! A shape of your own in a verb of the library: batches, gradients and the harness follow from one row.
//! `cargo run -p geograd-examples --features check --example own_shape`
use geograd::check::Check;
use geograd::operation;
use geograd::prelude::*;

/// A tree: the foot of its trunk, and the radius of its crown.
#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
struct Tree<S> {
    foot: Vec2<S>,
    #[shape(positive)]
    crown: S,
}

operation! {
    /// The distance of a vehicle and a crown; minus the depth where they overlap.
    SignedDistance: (car: Obb2<S>, tree: Tree<S>) -> S { car.signed_distance(tree.foot) - tree.crown }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    derivative Reverse
}

fn main() -> Result<(), geograd::Error> {
    let cars = [
        Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0),
        Obb2::new(9.0, 1.0, 4.0, 2.0, 0.4),
    ];
    let trees = [Tree {
        foot: Vec2::new(5.0, 0.0),
        crown: 1.0,
    }];
    let table = Cpu::new().all_pairs(SignedDistance.value_grad(), &cars, &trees)?;
    for row in 0..cars.len() {
        let (distance, (by_car, by_tree)) = table.at(row, 0);
        println!(
            "{distance:.3}, by heading {:.3}, by crown {:.3}",
            by_car.heading, by_tree.crown
        );
    }
    // Random and hard inputs, independent witnesses, every invariance: panics on a refusal.
    Check::of(SignedDistance.row::<(Obb2<f64>, Tree<f64>)>()).assert();
    Ok(())
}
