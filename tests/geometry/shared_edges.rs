//! The common edge of two polygons belongs to one of them, and rays without a direction hit nothing.
use geograd::contain::crossing;
use geograd::intersection::{first_hit, length_inside, span};
use geograd::shape::edges;
use geograd::{
    Aabb2, Capsule2, Circle, Line2, Obb2, Ray2, Real, Scalar, Segment2, Triangle2, Vec2,
};

/// Quadrilaterals of decimals, cut by a diagonal, and points that are on it but for rounding.
fn on_one_side<S: Real + Scalar<Mask = bool>>() {
    let at = |x: i32, y: i32| Vec2::new(S::lit(f64::from(x) / 10.0), S::lit(f64::from(y) / 10.0));
    let (mut some, mut rounded) = (0, 0);
    for (x, y) in (1..8).flat_map(|x| (1..8).map(move |y| (x, y))) {
        let (a, c) = (at(-x, -y), at(y + 3, x + 4));
        let (b, d) = (at(9, -9), at(-9, 9));
        let around = |ring: &[Vec2<S>], p| {
            edges(ring)
                .map(|[a, b]| crossing(a, b, p))
                .fold(S::zero(), |all, x| all + x)
        };
        for k in 1..40 {
            let p = a + (c - a) * S::lit(f64::from(k) / 40.0);
            let (there, back) = (crossing(a, c, p), crossing(c, a, p));
            assert!((there + back).equals(S::zero()), "{a:?} {c:?} {p:?}");
            rounded += u32::from(!(c - a).perp_dot(p - a).equals(S::zero()));
            let both = around(&[a, b, c], p) + around(&[a, c, d], p);
            assert!(both.equals(S::one()), "{a:?} {c:?} {p:?}: {both:?}");
            some += 1;
        }
    }
    assert!(some > 1000 && rounded > 100, "{some} {rounded}");
}

#[test]
fn points_on_a_common_edge_are_in_one_of_its_polygons() {
    on_one_side::<f32>();
    on_one_side::<f64>();
}

#[test]
fn what_has_no_direction_meets_nothing() {
    let none = Vec2::new(0.0, 0.0);
    for (x, y) in (-3..4).flat_map(|x| (-3..4).map(move |y| (x, y))) {
        let from = Vec2::new(f64::from(x), f64::from(y));
        let (ray, line) = (Ray2::new(from, none), Line2::new(from, none));
        macro_rules! missed {
            ($($shape:expr),*) => { $( {
                let hit = first_hit(ray, $shape);
                assert_eq!((hit.kind, hit.point, hit.normal), (0.0, from, none), "{from:?}");
                let chord = span(line, $shape);
                assert_eq!((chord.found, chord.enter, chord.exit), (0.0, 0.0, 0.0), "{from:?}");
                assert_eq!(length_inside(Segment2::new(from, from), $shape), 0.0, "{from:?}");
            } )* };
        }
        missed!(
            Circle::new(none, 1.0),
            Capsule2::new(none, Vec2::new(1.0, 0.0), 1.0),
            Aabb2::new(-1.0, -1.0, 1.0, 1.0),
            Obb2::new(0.0, 0.0, 2.0, 1.0, 0.5),
            Triangle2::new(none, Vec2::new(2.0, 0.0), Vec2::new(0.0, 2.0))
        );
    }
}
