//! Inputs too long for a whole Jacobian: duals and differences judge them along random directions,
//! and still say which number is wrong.
use geograd::ad::check::sample::Draw;
use geograd::ad::check::verdict::{Reason, Witness};
use geograd::ad::check::{Check, Report};
use geograd::{Scalar, Vec2, ad, ring};

const BY_DUALS: Reason = Reason::Disagree(Witness::Adjoint, Witness::Dual);
const BY_DIFFERENCES: Reason = Reason::Disagree(Witness::Adjoint, Witness::Difference);
/// Vertices of the long ring: twice as many numbers.
const LONG: usize = 600;
type Ring = Vec<Vec2<f64>>;

/// A ring like a star, of many vertices.
fn star(vertices: usize) -> Ring {
    let mut d = Draw::new(3);
    (0..vertices)
        .map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / vertices as f64).sin_cos();
            let reach = d.within(0.5, 1.5);
            Vec2::new(3.0 + reach * cos, -1.0 + reach * sin)
        })
        .collect()
}

fn area_derivatives(ring: Ring) -> Ring {
    let mut bar = vec![Vec2::zero(); ring.len()];
    ad::adjoint::ring::signed_area_vjp(&ring, 1.0, &mut bar);
    bar
}

fn area<S: Scalar>(ring: Vec<Vec2<S>>) -> S {
    ring::signed_area(&ring)
}

fn of_area(derivatives: impl Fn(Ring) -> Ring) -> Report {
    Check::at(star(LONG))
        .value(area)
        .dual(area)
        .gradient(derivatives)
        .run()
}

/// Refused by duals and by differences, at this number of the input (before it was shrunk, the
/// place is that of the first examination).
#[track_caller]
fn refused(report: &Report) {
    for reason in [BY_DUALS, BY_DIFFERENCES] {
        assert!(report.refused_for(reason), "{report}");
    }
    let by_duals = &report.failures[0].fault;
    assert_eq!(by_duals.reason, BY_DUALS, "{report}");
    assert_eq!(by_duals.suspect, Some(Witness::Adjoint), "{report}");
}

#[test]
fn long_rings_are_accepted() {
    if !geograd_tests::is_due("long_rings_are_accepted") {
        return;
    }
    let report = of_area(area_derivatives);
    assert!(report.passed(), "{report}");
    // Duals had their say, though there was no Jacobian.
    assert!(report.worst[0].count > 0 && report.worst[2].count > 0);
    let perimeter = Check::at(star(LONG))
        .value(|ring: Ring| ring::perimeter(&ring))
        .dual(|ring: Vec<Vec2<_>>| ring::perimeter(&ring))
        .gradient(|ring| {
            let mut bar = vec![Vec2::zero(); ring.len()];
            ad::adjoint::ring::perimeter_vjp(&ring, 1.0, &mut bar);
            bar
        })
        .run();
    assert!(perimeter.passed(), "{perimeter}");
    let centroid = Check::at(star(LONG))
        .value(|ring: Ring| ring::centroid(&ring))
        .dual(|ring: Vec<Vec2<_>>| ring::centroid(&ring))
        .adjoint(|ring, bar: &[f64]| {
            let mut derivatives = vec![Vec2::zero(); ring.len()];
            ad::adjoint::ring::centroid_vjp(&ring, Vec2::new(bar[0], bar[1]), &mut derivatives);
            derivatives
        })
        .run();
    assert!(centroid.passed(), "{centroid}");
}

#[test]
fn one_wrong_number_in_a_thousand() {
    if !geograd_tests::is_due("one_wrong_number_in_a_thousand") {
        return;
    }
    refused(&of_area(|ring| {
        let mut derivatives = area_derivatives(ring);
        let at = 137.min(derivatives.len() - 1);
        derivatives[at].x *= 1.0 + 1e-6;
        derivatives[at].x += 1e-6;
        derivatives
    }));
}

#[test]
fn one_wrong_sign_in_a_thousand() {
    if !geograd_tests::is_due("one_wrong_sign_in_a_thousand") {
        return;
    }
    refused(&of_area(|ring| {
        let mut derivatives = area_derivatives(ring);
        let last = derivatives.len() - 1;
        derivatives[last].y = -derivatives[last].y;
        derivatives
    }));
}

#[test]
fn the_ring_is_not_closed() {
    if !geograd_tests::is_due("the_ring_is_not_closed") {
        return;
    }
    // Without the edge from the last vertex to the first.
    refused(&of_area(|ring| {
        let mut derivatives = area_derivatives(ring.clone());
        let (first, last) = (ring[0], ring[ring.len() - 1]);
        derivatives[0] -= Vec2::new(-last.y, last.x) * 0.5;
        let end = derivatives.len() - 1;
        derivatives[end] -= Vec2::new(first.y, -first.x) * 0.5;
        derivatives
    }));
}

#[test]
fn the_wrong_number_is_named() {
    if !geograd_tests::is_due("the_wrong_number_is_named") {
        return;
    }
    let report = of_area(|ring| {
        let mut derivatives = area_derivatives(ring);
        if derivatives.len() == LONG {
            derivatives[411].y *= 1.01;
        }
        derivatives
    });
    refused(&report);
    for failure in &report.failures {
        assert_eq!(failure.fault.input, 2 * 411 + 1, "{report}");
    }
}

#[test]
fn wrong_duals_of_a_long_input_are_outvoted() {
    if !geograd_tests::is_due("wrong_duals_of_a_long_input_are_outvoted") {
        return;
    }
    fn sum<S: Scalar>(x: Vec<S>) -> S {
        x.iter().fold(S::lit(0.0), |sum, x| sum + x.sin())
    }
    let wrong = |x: Vec<geograd::Jet<f64, 1>>| {
        let mut y = sum(x.clone());
        y.derivative[0] += 1e-3 * x[700].derivative[0];
        y
    };
    let report = Check::at(vec![0.4; 1000])
        .value(sum)
        .dual(wrong)
        .gradient(|x| x.iter().map(|x| x.cos()).collect())
        .run();
    let fault = report.failures[0].fault;
    assert_eq!((fault.reason, fault.input), (BY_DUALS, 700), "{report}");
    assert_eq!(fault.suspect, Some(Witness::Dual), "{report}");
}

#[test]
fn duals_that_are_not_linear() {
    // Right along every axis, wrong along anything else.
    fn product<S: Scalar>([x, y]: [S; 2]) -> S {
        x * y
    }
    let wrong = |[x, y]: [geograd::Jet<f64, 1>; 2]| {
        let mut z = product([x, y]);
        z.derivative[0] += x.derivative[0] * y.derivative[0];
        z
    };
    let report = Check::at([1.5, 0.7])
        .value(product)
        .dual(wrong)
        .gradient(|[x, y]| [y, x])
        .run();
    assert!(report.refused_for(BY_DUALS), "{report}");
}

#[test]
fn kinks_do_not_hide_a_fault() {
    if !geograd_tests::is_due("kinks_do_not_hide_a_fault") {
        return;
    }
    // Twenty numbers lie exactly where the wrong derivative jumps, so that rounding excuses them;
    // twenty others are plainly wrong.
    fn sines<S: Scalar>(x: Vec<S>) -> S {
        x.iter().fold(S::lit(0.0), |sum, x| sum + x.sin())
    }
    let derivative = |x: &f64| if *x > 1.9 { 1.01 * x.cos() } else { x.cos() };
    let point: Vec<f64> = (0..2000).map(|i| f64::from(i % 97) / 50.0).collect();
    let report = Check::at(point)
        .value(sines)
        .dual(sines)
        .gradient(|x| x.iter().map(derivative).collect())
        .run();
    assert_eq!(report.failures[0].fault.reason, BY_DUALS, "{report}");
    assert_eq!(report.failures[0].code, "vec![2.0]", "{report}");
}
