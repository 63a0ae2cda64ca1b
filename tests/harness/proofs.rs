//! Faults of a distance that its gradient shares, so that only proofs can see them: points that are so far apart, and
//! a plane between.
use geograd::ad::check::certificate::{Body, Proof, Proved};
use geograd::ad::check::{Report, Sampling};
use geograd::check::{Reason, Witness};
use geograd::distance3::{closest_points, distance};
use geograd::kernels::check::check_search_with;
use geograd::kernels::check::check_with;
use geograd::kernels::op::{Declared, Declares, Jumps, Op};
use geograd::kernels::search::Search;
use geograd::{Fixed, Hull3, Scalar, Segment3, Vec3, operation};
use geograd_tests::list;

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

/// Distances of hulls have a search: their certificate is asked for with the count of vertices, which is no number of
/// an input.
#[test]
fn distances_of_hulls_are_proved_in_both_formats() {
    if !geograd_tests::is_due("distances_of_hulls_are_proved_in_both_formats") {
        return;
    }
    let sampling = Sampling {
        hard: 101,
        ..Sampling::new(4, 5)
    };
    for name in ["signed_distance_hulls", "distance_sphere_hull"] {
        let row = list::row(name);
        for report in [
            row.check::<f32>(&sampling, None).unwrap(),
            row.check::<f64>(&sampling, None).unwrap(),
        ] {
            assert!(report.passed(), "{report}");
            assert!(report.worst[7].count > 4, "{report}");
            assert!(report.worst[8].count > 0, "{report}");
        }
    }
}

/// The distance of a point from the nearest vertex of a hull: faces and edges are left out.
#[derive(Clone, Copy, Debug, Default)]
struct NearestVertex;

impl Declares for NearestVertex {
    const DECLARED: Declared = Declared::new("nearest_vertex", &[], Jumps::Never);
}

impl Search for NearestVertex {
    type In<S: Scalar> = (Vec3<S>, Hull3<S, 4>);
    type Out<S: Scalar> = S;
    type Record = usize;
    fn decide<S: Scalar<Mask = bool>>((point, hull): Self::In<S>) -> usize {
        let length = |k: usize| (hull.vertices[k] - point).length();
        let nearer = |best: usize, k: usize| {
            if length(k).below(length(best)) {
                k
            } else {
                best
            }
        };
        (1..4).fold(0, nearer)
    }
    fn replay<S: Scalar>((point, hull): Self::In<S>, nearest: usize) -> S {
        (hull.vertices[nearest] - point).length()
    }
}

#[test]
fn a_search_that_leaves_faces_out_is_refused() {
    let proof = |x: &[f64]| {
        let (point, corners) = x.split_at(3);
        let corners: Vec<_> = corners.chunks(3).map(Vec3::load).collect();
        Some(Proof {
            measure: Proved::Distance,
            bodies: [
                Body::hull(&[Vec3::load(point)], 0.0),
                Body::hull(&corners, 0.0),
            ],
            points: None,
        })
    };
    let sampling = Sampling {
        proof: Some(&proof),
        hard: 0,
        ..Sampling::new(30, 3)
    };
    let report = check_search_with::<NearestVertex, f64>(&sampling);
    assert!(report.refused_for(BY_PLANES), "{report}");
    let others = |reason: Reason| reason != BY_PLANES;
    assert!(
        !report.failures.iter().any(|one| others(one.fault.reason)),
        "{report}"
    );
}
