//! A function of your own, without a row: recorded once, differentiated, run on all lanes and cores.
//! `cargo run --release -p geograd-examples --example own_function`
use geograd::kernels::function;
use geograd::prelude::*;

/// The smallest distance that two points at constant velocities will have.
fn miss<S: Scalar>(a: Vec2<S>, by_a: Vec2<S>, b: Vec2<S>, by_b: Vec2<S>) -> S {
    let (way, speed) = (b - a, by_b - by_a);
    let still = speed.length_squared().at_most(S::zero());
    let square = S::select(still, S::one(), speed.length_squared());
    let time = (-way.dot(speed)).over(square).most(S::zero());
    (way + speed * time).length()
}

fn main() -> Result<(), geograd::Error> {
    let from = [
        Vec2::new(0.0_f64, 0.0),
        Vec2::new(0.0, 1.0),
        Vec2::new(0.0, 2.0),
    ];
    let to = [
        Vec2::new(10.0_f64, -8.0),
        Vec2::new(10.0, 5.0),
        Vec2::new(20.0, 2.0),
    ];
    let columns = (
        &from,
        One(Vec2::new(1.0, 0.0)),
        &to,
        One(Vec2::new(-1.0, 1.0)),
    );
    let (nearest, (by_place, by_speed, _, _)) =
        Cpu::new().aligned(function(miss).value_grad(), columns)?;
    for i in 0..from.len() {
        println!(
            "{:.3} by place {:.3} by speed {:.3}",
            nearest[i], by_place[i], by_speed[i]
        );
    }
    Ok(())
}
