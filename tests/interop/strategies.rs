//! Strategies of proptest draw valid shapes and shrink them.
use geograd::ad::check::sample::strategy;
use geograd::ad::check::sample::{Family, Sample};
use geograd::{Circle, Obb2, Segment3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

proptest! {
    #[test]
    fn draws_are_valid(a in strategy::of::<Obb2<f64>>(Family::Any), b in strategy::of::<Segment3<f64>>(Family::Hard)) {
        prop_assert!(a.inside() && b.inside());
    }
}

#[test]
fn a_failure_is_made_simple() {
    let mut runner = TestRunner::deterministic();
    let mut tree = strategy::of::<Circle<f64>>(Family::Ordinary)
        .new_tree(&mut runner)
        .unwrap();
    let before = tree.current();
    while tree.simplify() {}
    let after = tree.current();
    let digits = |x: &Circle<f64>| format!("{x:?}").len();
    assert!(digits(&after) < digits(&before), "{before:?} {after:?}");
    assert!(after.inside());
}
