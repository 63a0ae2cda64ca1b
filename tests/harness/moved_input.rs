//! A refused motion shows the input that it makes: a size that moves with the place is seen there.
use geograd::ad::check::verdict::Reason;
use geograd::check::{Check, Motion};
use geograd::{Shape, Vec2, operation};

/// An ellipse whose half axes are declared as a place.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Ellipse<S> {
    pub center: Vec2<S>,
    pub half: Vec2<S>,
}

operation! {
    /// The product of the half axes.
    pub Stretch = "stretch": (a: Ellipse<S>) -> S { a.half.x * a.half.y }
    invariances [TranslationX Stays]
    jumps Never
    derivative Reverse
}

#[test]
fn a_refused_motion_shows_the_moved_input() {
    let [report, _] = Check::of(Stretch).samples(8).run();
    let broken = Reason::MotionBroken(Motion::TranslationX);
    let mut failures = report.failures.iter();
    let failure = failures
        .find(|failure| failure.fault.reason == broken)
        .expect("refused");
    let (text, moved) = (format!("{report:#}"), &failure.moved);
    assert!(
        text.contains(&format!(
            "let input = {};\n    let moved = {moved};\n",
            failure.code
        )),
        "{text}"
    );
    // The half axis along x has moved, that along y has not.
    let [.., x, y] = failure.input[..] else {
        panic!("{report}")
    };
    let half = moved.split("half").nth(1).expect("half axes");
    assert!(
        half.contains(&format!("y: {y:?}")) && !half.contains(&format!("x: {x:?}")),
        "{moved}"
    );
    let others = report
        .failures
        .iter()
        .filter(|other| other.fault.reason != broken);
    assert!(
        others.clone().count() > 0 && others.clone().all(|other| other.moved.is_empty()),
        "{text}"
    );
}
