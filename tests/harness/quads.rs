//! The area that two quadrilaterals share, wherever it has one derivative.
use geograd::ad::adjoint::overlap_quad::intersection_area_quads_vjp;
use geograd::check::Check;
use geograd::kernels::op::Declares;
use geograd::overlap_polygon::intersection_area_quads;
use geograd::{Pack, Scalar, Triangle2, Vec2, operation};
use geograd_tests::rows::IntersectionAreaQuads;

type Corners = [Vec2<f64>; 4];

fn size(v: Vec2<f64>) -> f64 {
    v.x.abs() + v.y.abs()
}

/// Returns `true` where two corners in a row are nearly one point: the border of convex quadrilaterals, beyond which
/// one of the two turns the wrong way.
fn repeats(q: &Corners) -> bool {
    let reach = (1..4).map(|k| size(q[k] - q[0])).fold(0.0, f64::max);
    (0..4).any(|k| size(q[(k + 1) % 4] - q[k]) <= 1e-3 * reach)
}

/// Returns `true` where a side of each lies on one line, up to rounding.
fn share_a_line(a: &Corners, b: &Corners) -> bool {
    let sides = |q: &Corners| {
        let all = [0, 1, 2, 3].map(|k| (q[k], q[(k + 1) % 4] - q[k]));
        all.into_iter().filter(|&(_, along)| size(along) > 0.0)
    };
    let on = |(start, along): (Vec2<f64>, Vec2<f64>), point: Vec2<f64>| {
        let to = point - start;
        along.perp_dot(to).abs() <= 1e-6 * size(along) * size(to)
    };
    sides(a).any(|f| sides(b).any(|g| on(f, g.0) && on(f, g.0 + g.1)))
}

/// The corners of a triangle as those of a quadrilateral, of which the last is repeated.
fn as_quad<S: Scalar>(t: Triangle2<S>) -> [Vec2<S>; 4] {
    [t.a, t.b, t.c, t.c]
}

/// A cotangent of such corners as one of the triangle.
fn of_triangle<S: Scalar>([a, b, c, repeated]: [Vec2<S>; 4]) -> Triangle2<S> {
    Triangle2::new(a, b, c + repeated)
}

operation! {
    /// The area that two triangles share, as quadrilaterals with a repeated corner.
    pub OfTriangles = "area_of_triangles_as_quads": (a: Triangle2<S>, b: Triangle2<S>) -> S {
        intersection_area_quads(as_quad(a), as_quad(b))
    }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Exchange Stays]
    jumps Never
    derivative ByHand |(a, b), out_bar| {
        let (area, (a, b)) = intersection_area_quads_vjp(as_quad(a), as_quad(b), out_bar);
        (area, (of_triangle(a), of_triangle(b)))
    }
}

/// Returns `true` where corners are further from the origin than from each other by so much that differences round.
fn is_far(q: &Corners) -> bool {
    let reach = (1..4).map(|k| size(q[k] - q[0])).fold(0.0, f64::max);
    reach <= 1e-3 * size(q[0])
}

/// With a repeated corner the derivative has one side in the domain. Rounding takes a tie from the duals first.
#[test]
fn area_shared_by_quads_of_four_corners_is_accepted() {
    let domain = IntersectionAreaQuads::DECLARED.domain;
    let is_convex = domain.expect("not every quadrilateral is convex");
    let reports = Check::of(IntersectionAreaQuads)
        .inside(move |(a, b)| {
            let is_tied = (is_far(a) || is_far(b)) && share_a_line(a, b);
            is_convex(&(*a, *b).scalars()) && !repeats(a) && !repeats(b) && !is_tied
        })
        .run();
    for report in reports {
        assert!(report.passed(), "{report:#}");
        assert!(report.samples > 100, "{report}");
    }
}

/// A corner that is repeated moves as one. Sides on one line share the derivative by hand half and half, the derivative
/// by duals otherwise.
#[test]
fn area_shared_by_triangles_as_quads_is_accepted() {
    if !geograd_tests::is_due("area_shared_by_triangles_as_quads_is_accepted") {
        return;
    }
    let reports = Check::of(OfTriangles)
        .inside(|(a, b)| !share_a_line(&as_quad(*a), &as_quad(*b)))
        .run();
    for report in reports {
        assert!(report.passed(), "{report:#}");
        assert!(report.samples > 100, "{report}");
    }
}
