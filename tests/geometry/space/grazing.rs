//! Lines that graze a solid, run along its side, or meet a body that is thin to some roundings: the chord is where the
//! solid is. Found by identities over 10⁸ inputs.
use geograd::intersection3::{Pierced, span};
use geograd::prelude::*;
use geograd::{
    Capsule3, Cone, Cylinder, Line3, Obb3, Ray2, Ray3, Rotation3, Sphere, Tetrahedron, Triangle2,
    Vec2, Vec3,
};

fn at([x, y, z]: [f64; 3]) -> Vec3<f64> {
    Vec3::new(x, y, z)
}
fn line(point: [f64; 3], direction: [f64; 3]) -> Line3<f64> {
    Line3::new(at(point), at(direction))
}

/// The middle of the chord and both ends are no farther from the shape than some roundings.
fn touches<A: Pierced<Scalar = f64>>(
    line: Line3<f64>,
    shape: A,
    distance: impl Fn(Vec3<f64>) -> f64,
) {
    let found = span(line, shape);
    assert_eq!(found.found, 1.0);
    for t in [found.enter, 0.5 * (found.enter + found.exit), found.exit] {
        let off = distance(line.point_at(t));
        assert!(off < 1e-14, "{found:?} {t} {off}");
    }
}

#[test]
fn round_surfaces_are_grazed_in_one_point() {
    let sphere = Sphere::new(
        at([
            -1.4826050411922216,
            -0.3333333333333333,
            0.48657467990310643,
        ]),
        1.0,
    );
    let beside = line(
        [-0.9157870006998257, -1.0, 0.9705921016225278],
        [-1.4597240397093194, -3.0, -2.422644366780792],
    );
    touches(beside, sphere, |p| p.distance(sphere));
    let cylinder = Cylinder::new(
        at([0.0, 0.2860759100036273, -1.3849767412182765]),
        at([-1.0, 0.2860759100036273, -1.3849767412182765]),
        1.0,
    );
    let beside = line(
        [0.0, 0.8355263256109519, -0.5494504156073245],
        [0.0, -0.8355263256109519, 0.5494504156073245],
    );
    touches(beside, cylinder, |p| p.distance(cylinder));
    let capsule = Capsule3::new(
        at([1.7097546812411073, -0.0025950726142461855, 1.0]),
        at([0.0; 3]),
        0.3333333333333333,
    );
    let beside = line(
        [1.859863005269231, 0.29502650282775517, 1.0],
        [0.8928647263260041, -0.45032497208437133, 3.0],
    );
    touches(beside, capsule, |p| p.distance(capsule));
}

#[test]
fn lines_along_a_side_miss_what_they_do_not_meet() {
    let cone = Cone::new(at([-0.1, 0.1, -0.1]), at([0.0, 0.1, -0.1]), 0.1);
    let along = Ray3::new(at([-0.1, 0.1, 0.0]), at([-1.0, -1.0, 0.0]));
    assert_eq!(along.first_hit(cone).kind, 0.0);
    let needle = Cone::new(
        at([0.13938600453245167, 0.0, -0.4636322283845973]),
        at([0.05413708063686906, 0.0, 0.0]),
        0.0,
    );
    let along = line(
        [0.13938600453245167, 0.328125, -0.4636322283845973],
        [-0.25574677168674786, 0.0, 1.3908966851537918],
    );
    assert_eq!(along.span(needle).found, 0.0);
    let tube = Cylinder::new(
        at([
            -0.8473496455753933,
            -0.6666666666666666,
            -0.14063534180685433,
        ]),
        at([
            -0.053369166093169856,
            -0.6666666666666666,
            0.4673079106445389,
        ]),
        0.328125,
    );
    let along = line(
        [-1.0, 0.0, 0.0],
        [1.587960958964447, 0.0, 1.2158865049027865],
    );
    assert_eq!(along.span(tube).found, 0.0);
}

#[test]
fn tetrahedra_thin_to_some_roundings_are_met_where_they_are() {
    let flat = |corners: [[f64; 3]; 4]| {
        let [a, b, c, d] = corners.map(at);
        Tetrahedron::new(a, b, c, d)
    };
    let third = 1.0 / 3.0;
    let broadside = flat([
        [-1.5, -0.5, -1.0],
        [1.5, -1.499999999999994, -1.0],
        [0.0; 3],
        [-1.5, -0.500000000000006, -1.0],
    ]);
    touches(line([0.5, -0.5, -0.5], [3.0; 3]), broadside, |p| {
        p.distance(broadside)
    });
    let edge_on = flat([
        [-0.3333333333333335, 0.0, 2e-16],
        [0.0, 0.33333333333333315, -third],
        [0.0, third, -third],
        [-third, -third, third],
    ]);
    let ray = line([-0.328125, 0.33333333333333315, -third], [0.0, -1.0, 1.0]);
    touches(ray, edge_on, |p| p.distance(edge_on));
    assert!((ray.span(edge_on).enter - 0.328125).abs() < 1e-14);
    // A needle, beyond its end.
    let needle = flat([
        [-third, 0.0, -third],
        [third, 0.0, third],
        [0.6666666666666666, 0.0, 0.6666666666666697],
        [-0.33333333333333637, 0.0, -third],
    ]);
    let beyond = line(
        [0.9999999999999969, 0.0, 1.000000000000003],
        [0.0, 1.0, 0.0],
    );
    assert_eq!(beyond.span(needle).found, 0.0);
    let tall = flat([
        [0.0, third, -0.33333333333333437],
        [0.0, -0.6666666666666655, 0.6666666666666666],
        [0.0, 0.6666666666666677, -0.6666666666666677],
        [0.0; 3],
    ]);
    let along = line(
        [0.0, 0.6666666666666666, -0.6666666666666666],
        [-2.0, -2.0, 2.0],
    );
    if along.span(tall).found == 1.0 {
        touches(along, tall, |p| p.distance(tall));
    }
}

#[test]
fn a_sliver_of_the_plane_ends_at_its_corner() {
    let tip = Vec2::new(0.999_993_26_f32, 1.0);
    let sliver = Triangle2::new(tip, Vec2::new(0.0, 0.0), Vec2::new(-6.724_416e-6, 0.0));
    let hit = Ray2::new(tip, Vec2::new(1.0, 1.0)).first_hit(sliver);
    assert_eq!((hit.parameter, hit.point), (0.0, tip));
}

#[test]
fn a_segment_almost_along_a_face_is_closest_over_the_face() {
    let segment = Capsule3::new(
        at([-1.0, -1.5, 0.4999999999999981]),
        at([-1.0, -0.4999999999999981, -1.5]),
        0.0,
    );
    let rotation = Rotation3::new(-1.0, 0.0, -1.0, -1.0);
    let block = Obb3::new(at([-1.5, -1.0, 0.0]), at([1.0, 1.0, 0.5]), rotation);
    let found = segment.closest_points(block);
    assert!(found.on_b.distance(block) < 1e-14, "{found:?}");
    let apart = (found.on_b - found.on_a).length();
    assert!((apart - 1.0 / 12.0).abs() < 1e-13, "{apart}");
}
