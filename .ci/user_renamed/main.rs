//! A program of a user whose manifest renames the library: own shape, own verb, five arguments, a plain function.
use gg::kernels::function;
use gg::prelude::*;
use gg::{operation, verb};

#[derive(Clone, Copy, Debug, PartialEq, gg::Shape)]
#[shape(crate = "gg")]
struct Tree<S> {
    foot: Vec2<S>,
    #[shape(positive)]
    crown: S,
}
verb! {
    /// The free width.
    Gap: (a, b)
}
operation! {
    /// Between a vehicle and a tree.
    Gap: (car: Obb2<S>, tree: Tree<S>) -> S { (car.signed_distance(tree.foot) - tree.crown).most(S::zero()) }
    invariances [TranslationX Stays, TranslationY Stays]
    jumps Never
    derivative Reverse

    /// A verb of the library.
    SignedDistance: (car: Obb2<S>, tree: Tree<S>) -> S { car.signed_distance(tree.foot) - tree.crown }
    invariances [TranslationX Stays, TranslationY Stays]
    jumps Never
    derivative Reverse
}
operation! {
    /// Five arguments.
    Far = "far": (a: S, b: S, c: S, d: S, e: S) -> S { a * b + c * d - e }
    invariances []
    jumps Never
    derivative Reverse
}
fn reach<S: Scalar>(point: Vec2<S>, car: Obb2<S>) -> S {
    point.distance(car)
}

fn main() -> Result<(), gg::Error> {
    let cpu = Cpu::new();
    let cars = [Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0)];
    let trees = [Tree {
        foot: Vec2::new(5.0, 0.0),
        crown: 1.0,
    }];
    let (gap, (_, by_tree)) = cpu.aligned(Gap.value_grad(), (&cars, &trees))?;
    assert_eq!((gap[0], by_tree[0].crown), (2.0, -1.0));
    assert_eq!(
        cpu.all_pairs(SignedDistance, &cars, &trees)?.values(),
        [2.0]
    );
    assert_eq!(
        cpu.aligned(Far, (&[2.0_f64], &[3.0], &[1.0], &[1.0], One(4.0)))?,
        [3.0]
    );
    assert_eq!(
        cpu.aligned(function(reach), (One(Vec2::new(5.0, 0.0)), &cars))?,
        [3.0]
    );
    println!("every form of a renamed library runs");
    Ok(())
}

#[test]
fn the_harness_accepts_the_row() {
    gg::check::Check::of(Gap.row::<(Obb2<f64>, Tree<f64>)>())
        .samples(20)
        .assert();
}
