//! Hulls and curved shapes against the same solids as other shapes, and the derivatives of flat contacts.
use super::curved_draw::{Body, FAMILIES, frames};
use super::draw::Random;
use geograd::ad::gradient;
use geograd::distance3::{
    Apart, BySupport, SupportFunction, closest_points, farthest_distance, signed_distance,
};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid, Shape};

/// A shape has the distance from a hull that it has from the solid of which the hull is one.
fn agrees<A, B, const N: usize>(curved: A, flat: B, hull: Hull3<f64, N>, told: &str)
where
    A: Body + Apart<B, Scalar = f64> + Apart<Hull3<f64, N>, Scalar = f64>,
    B: Body,
    Hull3<f64, N>: Apart<A, Scalar = f64>,
{
    let between = (curved.middle() - flat.middle()).length();
    let size = curved.size().max(flat.size()).max(between);
    let bound = 1e-12 * size + 1e-15 * curved.middle().length();
    let (known, found) = (signed_distance(curved, flat), signed_distance(curved, hull));
    assert!(
        (known - found).abs() <= bound,
        "{told} {known} {found} {curved:?} {flat:?}"
    );
    let found = signed_distance(hull, curved);
    assert!(
        (known - found).abs() <= bound,
        "{told} {known} {found} {curved:?} {flat:?}"
    );
    let (known, found) = (
        farthest_distance(curved, flat),
        farthest_distance(curved, hull),
    );
    assert!(
        (known - found).abs() <= bound,
        "{told} {known} {found} {curved:?} {flat:?}"
    );
}

#[test]
fn hulls_of_solids_are_as_far_from_curved_shapes_as_the_solids() {
    let mut random = Random(0x1bad_b002_0246_1357);
    for (family, name) in FAMILIES.iter().enumerate() {
        // An axis of 1e-9 has a direction of few digits.
        if family == 5 {
            continue;
        }
        for _ in 0..40 {
            let [first, second] = frames(&mut random, family);
            let (solid, simplex) = (Obb3::drawn(second), Tetrahedron::drawn(second));
            let (hull, four) = (Hull3::from(solid), Hull3::from(simplex));
            macro_rules! with {
                ($($A:ident)*) => { $(
                    agrees($A::drawn(first), solid, hull, name);
                    agrees($A::drawn(first), simplex, four, name);
                )* };
            }
            with!(Ellipsoid Cylinder Cone Disc);
        }
    }
}

/// A ball that only has a support.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
struct Own<S> {
    center: Vec3<S>,
    radius: S,
}

impl<S: Scalar> SupportFunction for Own<S> {
    fn support(&self, way: Vec3<S>) -> Vec3<S> {
        self.center + way.normalize_or_zero() * self.radius
    }
}

#[test]
fn balls_of_three_kinds_are_equally_far_from_hulls() {
    let mut random = Random(0x2468_1357_dead_beef);
    for family in [0, 1, 2, 3, 6, 7, 11] {
        for _ in 0..30 {
            let [first, second] = frames(&mut random, family);
            let hull = super::curved_draw::Hull::drawn(second);
            let ball = Sphere::new(first.at, first.lengths[0]);
            let own = BySupport(Own {
                center: ball.center,
                radius: ball.radius,
            });
            let known = ball.signed_distance(hull);
            let bound = 1e-12 * (1.0 + first.at.length());
            for found in [
                signed_distance(Ellipsoid::from(ball), hull),
                signed_distance(hull, Ellipsoid::from(ball)),
                signed_distance(own, hull),
                signed_distance(hull, own),
            ] {
                assert!(
                    (known - found).abs() <= bound,
                    "{known} {found} {ball:?} {hull:?}"
                );
            }
        }
    }
}

#[test]
fn a_cylinder_on_a_hull_touches_it_in_the_middle_of_the_overlap() {
    // Faces that are flat within rounding only: the hull of a box that is turned.
    let mut random = Random(0x7777_1234_5678_9abc);
    for _ in 0..20 {
        let turn = Rotation3::from_axis_angle(random.vector(1.0), random.within(0.1, 3.0));
        let at = random.vector(1.0);
        let table = Obb3::new(at, Vec3::new(4.0, 2.0, 1.0), turn);
        let foot = at + turn * Vec3::new(1.75, 0.25, 0.75);
        let can = Cylinder::new(foot, foot + turn * Vec3::new(0.0, 0.0, 2.0), 0.5);
        let (hull, bound) = (Hull3::from(table), 1e-12);
        let known = closest_points(table, can);
        let found = closest_points(hull, can);
        assert!(
            (known.on_a - found.on_a).length() < bound,
            "{known:?} {found:?}"
        );
        assert!(
            (known.on_b - found.on_b).length() < bound,
            "{known:?} {found:?}"
        );
        // By a shift, and by a turn about the middle of the table.
        let (_, by) = gradient(
            |(hull, can): (Hull3<_, 8>, Cylinder<_>)| signed_distance(hull, can),
            (hull, can),
        );
        let (mut shift, mut about) = (Vec3::zero(), Vec3::zero());
        for (&vertex, &slope) in hull.vertices.iter().zip(&by.0.vertices) {
            shift += slope;
            about += (vertex - at).cross(slope);
        }
        let up = turn * Vec3::new(0.0, 0.0, 1.0);
        let arm = (known.on_a - at).cross(-up);
        assert!((shift + up).length() < bound, "{shift:?} {up:?}");
        assert!((about - arm).length() < bound, "{about:?} {arm:?}");
    }
}
