//! Strategies for proptest: every family draws what it says, and failing shapes shrink to minimal
//! ones that print as code.
use geograd::ad::check::sample::Sample;
use geograd::ad::check::strategy::{self, Shapes};
use geograd::{Aabb2, Obb2, Pack, Vec2};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestError, TestRunner};

type Boxes = (Obb2<f64>, Obb2<f64>);
type Ring = Vec<Vec2<f64>>;

/// All shapes of a family have a property.
#[track_caller]
fn all<X: Sample>(shapes: Shapes<X>, holds: impl Fn(&X) -> bool) {
    let mut runner = TestRunner::deterministic();
    let outcome = runner.run(&shapes, |x| {
        if x.inside() && holds(&x) {
            Ok(())
        } else {
            Err(TestCaseError::fail("not so"))
        }
    });
    assert!(outcome.is_ok(), "{shapes:?}: {outcome:?}");
}

#[test]
fn families_are_what_they_are_called() {
    let size = |b: &Obb2<f64>| b.size.x.max(b.size.y);
    all(strategy::any::<Boxes>(), |_| true);
    all(strategy::hard::<Boxes>(), |_| true);
    all(strategy::hard::<Ring>(), |_| true);
    all(strategy::ordinary(), |b| {
        size(b) < 4.0 && b.center.length() < 2.0
    });
    all(strategy::thin(), |b: &Obb2<f64>| {
        b.size.x / b.size.y >= 10.0
    });
    all(strategy::tiny(), |b| size(b) <= 50.0 * 1e-4);
    all(strategy::huge(), |b| size(b) >= 0.2 * 1e4);
    all(strategy::far(), |b: &Obb2<f64>| b.center.length() > 90.0);
    all(strategy::touching(), |(a, b): &Boxes| {
        a.iou(*b) < 1e-12 && a.heading == b.heading
    });
    all(strategy::touching(), |(a, b): &(Aabb2<f64>, Aabb2<f64>)| {
        let gap = |low: f64, high: f64| (low - high).abs() <= 1e-14 * high.abs().max(1.0);
        let meet = gap(a.min.x, b.max.x) || gap(b.min.x, a.max.x) || gap(a.min.y, b.max.y);
        meet || gap(b.min.y, a.max.y)
    });
    all(strategy::tiny(), |ring: &Ring| {
        ring.iter().all(|p| p.length() < 1.0)
    });
}

/// The input to which a failing property is shrunk.
fn minimal<X: Sample>(shapes: Shapes<X>, fails: impl Fn(&X) -> bool) -> X {
    let config = Config {
        failure_persistence: None,
        cases: 2000,
        ..Config::default()
    };
    let outcome = TestRunner::new(config).run(&shapes, |x| {
        if fails(&x) {
            Err(TestCaseError::fail("as planted"))
        } else {
            Ok(())
        }
    });
    match outcome {
        Err(TestError::Fail(_, x)) => x,
        other => panic!("{other:?}"),
    }
}

#[test]
fn failing_shapes_are_made_simple() {
    let shape = minimal(strategy::ordinary::<Obb2<f64>>(), |b| b.size.x > 1.0);
    assert_eq!(
        (shape.center, shape.heading),
        (Vec2::zero(), 0.0),
        "{shape:?}"
    );
    assert!(
        shape.size.y == 0.0 && (64.0 * shape.size.x).fract() == 0.0,
        "{shape:?}"
    );
    // Three points are left, of rings of up to six hundred.
    let ring = minimal(strategy::any::<Ring>(), |ring| ring.len() > 2);
    assert_eq!(ring.len(), 3);
    assert!(ring.scalars().iter().all(|x| *x == 0.0));
    let code = format!(
        "{:?}",
        minimal(strategy::hard::<Boxes>(), |(a, _)| a.size.x > 0.0).1
    );
    assert!(code.starts_with("Obb2 { center: Vec2 { x: 0.0,"), "{code}");
}

#[test]
fn the_same_seed_draws_the_same() {
    let draw = || {
        let mut runner = TestRunner::deterministic();
        let tree = strategy::any::<Boxes>().new_tree(&mut runner);
        proptest::strategy::ValueTree::current(&tree.unwrap())
    };
    assert_eq!(draw(), draw());
}
