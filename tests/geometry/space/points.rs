//! Boxes of size zero, or of almost none, and boxes that are segments, against the points and segments that they are.
use super::draw::Random;
use geograd::ad::gradient;
use geograd::distance3::{Apart, distance, penetration, signed_distance};
use geograd::prelude::*;

/// A place of whole numbers.
fn place(random: &mut Random, size: usize) -> Vec3<f64> {
    let mut one = || random.below(2 * size + 1) as f64 - size as f64;
    Vec3::new(one(), one(), one())
}

/// A box as thin as `thin`, `long` along one axis.
fn rod(random: &mut Random, thin: f64, long: Option<f64>) -> (Obb3<f64>, Segment3<f64>) {
    let turns = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 1.0, 1.0],
        [2.0, 1.0, 0.0, 0.0],
        [0.3, -0.2, 0.7, 0.1],
    ];
    let [w, x, y, z] = turns[random.below(4)];
    let (center, rotation, axis) = (
        place(random, 2),
        Rotation3::new(w, x, y, z),
        random.below(3),
    );
    let (mut size, mut half) = ([thin; 3], [0.0; 3]);
    if let Some(long) = long {
        (size[axis], half[axis]) = (long, long / 2.0);
    }
    let arm = rotation * Vec3::new(half[0], half[1], half[2]);
    let size = Vec3::new(size[0], size[1], size[2]);
    (
        Obb3::new(center, size, rotation),
        Segment3::new(center - arm, center + arm),
    )
}

/// A shape against a box, and against the segment that it is.
macro_rules! is_segment {
    ($a:expr, $solid:expr, $edge:expr, $error:expr) => {{
        let (a, solid, edge) = ($a, $solid, $edge);
        let truth = signed_distance(a, edge);
        for found in [signed_distance(a, solid), signed_distance(solid, a)] {
            assert!(
                (found - truth).abs() < $error,
                "{a:?} {solid:?}: {found}, right {truth}"
            );
        }
        assert!(
            (distance(a, solid) - truth.max(0.0)).abs() < $error,
            "{a:?} {solid:?}"
        );
        let (round, link) = (
            RoundBox3::new(solid, 0.25),
            Capsule3::new(edge.start, edge.end, 0.25),
        );
        let (found, truth) = (signed_distance(round, a), signed_distance(link, a));
        assert!(
            (found - truth).abs() < $error,
            "{a:?} {round:?}: {found}, right {truth}"
        );
        if size_of(solid) == 0.0 {
            let upright = Aabb3::new(solid.center, solid.center);
            let (found, truth) = (
                signed_distance(a, upright),
                signed_distance(a, solid.center),
            );
            assert!(
                (found - truth).abs() < $error,
                "{a:?} {upright:?}: {found}, right {truth}"
            );
            let yaw = YawBox3::new(solid.center, solid.size, 0.5);
            assert!(
                (signed_distance(yaw, a) - truth).abs() < $error,
                "{a:?} {yaw:?}"
            );
        }
    }};
}

fn size_of<S: Scalar<Mask = bool> + Into<f64>>(solid: Obb3<S>) -> f64 {
    [solid.size.x, solid.size.y, solid.size.z]
        .map(Into::into)
        .into_iter()
        .fold(0.0, f64::max)
}

macro_rules! thin_boxes {
    ($name:ident, $S:ty, $error:expr, $thin:expr) => {
        #[test]
        fn $name() {
            let mut random = Random(77);
            for _ in 0..250 {
                let thin: f64 = $thin[random.below($thin.len())];
                let long = (random.below(2) == 0).then(|| 1.0 + random.below(3) as f64);
                let (solid, edge) = rod(&mut random, thin, long);
                let (solid, edge) = (solid.cast::<$S>(), edge.cast::<$S>());
                let [p, q, r, s] = [0; 4].map(|_| place(&mut random, 3).cast::<$S>());
                let error = $error + 2.0 * thin as $S;
                is_segment!(Segment3::new(p, q), solid, edge, error);
                is_segment!(Capsule3::new(p, q, 0.5), solid, edge, error);
                is_segment!(Triangle3::new(p, q, r), solid, edge, error);
                is_segment!(Triangle3::new(p, q, p + (q - p) * 2.0), solid, edge, error);
                is_segment!(Tetrahedron::new(p, q, r, s), solid, edge, error);
                is_segment!(Tetrahedron::new(p, q, r, p + q - r), solid, edge, error);
            }
        }
    };
}
thin_boxes!(
    boxes_without_size_are_points,
    f64,
    1e-14,
    [0.0, 0.0, 1e-9, 1e-15, 1e-17, 1e-20, 1e-30, 1e-33, 1e-40]
);
thin_boxes!(
    boxes_without_size_are_points_in_single_precision,
    f32,
    5e-6,
    [0.0, 0.0, 1e-5, 1e-7, 1e-8, 1e-10, 1e-14, 1e-17]
);

#[test]
fn a_point_that_is_a_box_touches_without_a_slope() {
    let wire = Segment3::new(Vec3::new(-1.0_f64, -1.0, -1.0), Vec3::new(1.0, 1.0, 2.0));
    for center in [wire.start, Vec3::zero()] {
        let point = Obb3::new(center, Vec3::zero(), Rotation3::identity());
        let f = |(a, b): (Segment3<_>, Obb3<_>)| signed_distance(a, b);
        let (found, (by_wire, _)) = gradient(f, (wire, point));
        let right: f64 = center.distance(wire);
        assert!((found - right).abs() < 1e-15, "{found} {right}");
        let (_, by_point) = gradient(
            |(a, b): (Segment3<_>, Vec3<_>)| signed_distance(a, b),
            (wire, center),
        );
        assert!(
            (by_wire.start - by_point.0.start).length() < 1e-15,
            "{by_wire:?}"
        );
        let capsule = Capsule3::new(wire.start, wire.end, 1.0);
        assert!((capsule.signed_distance(point) - (right - 1.0)).abs() < 1e-15);
    }
    // On the wire: a capsule of radius one about it is one deep.
    let wire = Capsule3::new(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0), 1.0);
    let point = Obb3::new(Vec3::zero(), Vec3::zero(), Rotation3::identity());
    assert_eq!(
        (wire.signed_distance(point), penetration(wire, point).depth),
        (-1.0, 1.0)
    );
}
