//! Faults of a distance that its gradient shares, so that only proofs can see them: points that are so far apart, and
//! a plane between.
use geograd::ad::check::certificate::{Body, Proof, Proved};
use geograd::ad::check::{Report, Sampling};
use geograd::check::{Reason, Witness};
use geograd::distance3::{closest_points, distance};
use geograd::kernels::check::check_with;
use geograd::kernels::op::Op;
use geograd::{Fixed, Scalar, Segment3, Vec3, operation};

const BY_PLANES: Reason = Reason::ValuesDisagree(Witness::Planes);
const BY_POINTS: Reason = Reason::ValuesDisagree(Witness::Points);

type Pair = (Segment3<f64>, Segment3<f64>);

/// The nearest ends and feet of ends: crossings are left out.
fn without_crossings<S: Scalar>(a: Segment3<S>, b: Segment3<S>) -> S {
    let of_b = distance(a, b.start).least(distance(a, b.end));
    of_b.least(distance(b, a.start).least(distance(b, a.end)))
}

macro_rules! planted {
    ($($Name:ident = $name:literal: |$a:ident, $b:ident| $formula:expr;)*) => { $( operation! {
        /// A distance with a fault.
        $Name = $name: (a: Segment3<S>, b: Segment3<S>) -> S {
            let ($a, $b) = (a, b);
            $formula
        }
        invariances [TranslationX Stays, TranslationY Stays, TranslationZ Stays, Rotation Stays, Scaling Power(1)]
        jumps Never
        derivative Reverse
    } )* };
}
planted! {
    Right = "right": |a, b| distance(a, b);
    TooLong = "too_long": |a, b| distance(a, b) * S::lit(1.0 + 1e-6);
    NoCrossings = "no_crossings": |a, b| without_crossings(a, b);
    FromTheLine = "from_the_line": |a, b| distance(a.start, b);
}

/// What the library says are the nearest points; where they are to be wrong, the start of a in place of its own.
fn nearest((a, b): Pair, wrong: bool) -> [Vec3<f64>; 2] {
    let found = closest_points(a, b);
    [if wrong { a.start } else { found.on_a }, found.on_b]
}

fn judged<O>(_: O, wrong_points: bool) -> [Report; 2]
where
    O: Op<In<f64> = Pair, Out<f64> = f64>
        + Op<In<f32> = (Segment3<f32>, Segment3<f32>), Out<f32> = f32>,
{
    let proof = |x: &[f64]| {
        let (a, b) = Pair::load(x);
        let hull = |s: Segment3<f64>| Body::hull(&[s.start, s.end], 0.0);
        Some(Proof {
            measure: Proved::Distance,
            bodies: [hull(a), hull(b)],
            points: Some(nearest((a, b), wrong_points)),
        })
    };
    let sampling = Sampling {
        proof: Some(&proof),
        hard: 8,
        ..Sampling::new(30, 3)
    };
    [
        check_with::<O, f32>(&sampling),
        check_with::<O, f64>(&sampling),
    ]
}

#[test]
fn the_right_distance_is_proved() {
    for report in judged(Right, false) {
        assert!(report.passed(), "{report}");
        // Both bounds were asked, and the report says so.
        assert!(report.worst[7].count > 30 && report.worst[8].count > 30);
        let details = report.details();
        assert!(
            details.contains("planes between") && details.contains("nearest points"),
            "{details}"
        );
    }
}

#[test]
fn a_length_off_by_a_millionth_is_refused() {
    let [_, double] = judged(TooLong, false);
    assert!(
        double.refused_for(BY_PLANES) && double.refused_for(BY_POINTS),
        "{double}"
    );
    // Nothing else sees it.
    let others = |reason: Reason| reason != BY_PLANES && reason != BY_POINTS;
    assert!(
        !double.failures.iter().any(|one| others(one.fault.reason)),
        "{double}"
    );
}

#[test]
fn a_feature_left_out_is_refused() {
    for report in judged(NoCrossings, false) {
        assert!(report.refused_for(BY_PLANES), "{report}");
    }
    for report in judged(FromTheLine, false) {
        assert!(report.refused_for(BY_PLANES), "{report}");
    }
}

#[test]
fn points_that_are_not_the_nearest_are_refused() {
    for report in judged(Right, true) {
        assert!(report.refused_for(BY_POINTS), "{report}");
        assert!(!report.refused_for(BY_PLANES), "{report}");
    }
}
