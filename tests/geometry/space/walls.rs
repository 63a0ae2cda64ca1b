//! Boxes of walls of integer bricks, turned as a whole, against integers: they share faces, edges, corners and planes.
use super::draw::Random;
use geograd::ad::gradient;
use geograd::distance3::{
    closest_points, distance, penetration, signed_distance, squared_distance,
};
use geograd::prelude::*;

/// A brick of a wall: its lowest corner and its size, whole numbers.
#[derive(Clone, Copy, Debug)]
struct Brick {
    low: [i32; 3],
    size: [i32; 3],
}

impl Brick {
    /// How far two bricks are apart along the three axes; negative where they overlap.
    fn gaps(self, other: Brick) -> [i32; 3] {
        [0, 1, 2].map(|k| {
            let (a, b) = (self.low[k], other.low[k]);
            (b - a - self.size[k]).max(a - b - other.size[k])
        })
    }
    /// The signed distance of two bricks, and the square of the distance.
    fn apart(self, other: Brick) -> (f64, f64) {
        let gaps = self.gaps(other);
        let square: i32 = gaps.map(|gap| gap.max(0).pow(2)).iter().sum();
        let most = gaps.into_iter().max().unwrap_or(0);
        let signed = if most > 0 {
            f64::from(square).sqrt()
        } else {
            f64::from(most)
        };
        (signed, f64::from(square))
    }
}

fn vector(x: [f64; 3]) -> Vec3<f64> {
    Vec3::new(x[0], x[1], x[2])
}

/// The rotations of a cube.
fn rotations() -> Vec<Rotation3<f64>> {
    let digits = |code: i32| [0, 1, 2, 3].map(|k| code / 3_i32.pow(k) % 3 - 1);
    let all = (0..81).map(digits).filter(|q| {
        let count = q.iter().filter(|x| **x != 0).count();
        let first = q.iter().find(|x| **x != 0);
        count != 0 && count != 3 && first == Some(&1)
    });
    let all = all.map(|q| q.map(f64::from));
    all.map(|[w, x, y, z]| Rotation3::new(w, x, y, z)).collect()
}

/// A wall: what turns, moves and scales all bricks.
struct Wall {
    turn: Rotation3<f64>,
    shift: Vec3<f64>,
    unit: f64,
}

impl Wall {
    fn random(random: &mut Random) -> Wall {
        let axis = random.vector(2.0);
        Wall {
            turn: match random.below(4) {
                0 => Rotation3::identity(),
                _ => Rotation3::from_rotation_vector(axis),
            },
            shift: match random.below(2) {
                0 => Vec3::zero(),
                _ => random.vector(3.0),
            },
            unit: [1.0, 0.1, 1.0 / 3.0][random.below(3)],
        }
    }
    /// The brick as a box whose own axes are permuted by a rotation of a cube.
    fn place(&self, brick: Brick, own: Rotation3<f64>) -> Obb3<f64> {
        let size = vector(brick.size.map(f64::from));
        let middle = vector(brick.low.map(f64::from)) + size * 0.5;
        let Vec3 { x, y, z } = own.inverse() * size;
        let size = vector([x, y, z].map(|side| side.abs().round()));
        let center = self.shift + self.turn * (middle * self.unit);
        Obb3::new(center, size * self.unit, self.turn * own)
    }
}

/// Two bricks of one wall, as boxes and as integers.
fn bricks(random: &mut Random, rotations: &[Rotation3<f64>]) -> ([Obb3<f64>; 2], [Brick; 2], f64) {
    let mut whole = |below: usize, from: i32| [0; 3].map(|_| random.below(below) as i32 + from);
    let both = [(); 2].map(|()| Brick {
        low: whole(5, 0),
        size: whole(3, 1),
    });
    let wall = Wall::random(random);
    let boxes = both.map(|brick| wall.place(brick, rotations[random.below(rotations.len())]));
    (boxes, both, wall.unit)
}

/// All that is said of two boxes, against their signed distance and its square, in one format.
macro_rules! said {
    ($a:expr, $b:expr, $signed:expr, $square:expr, $slack:literal) => {{
        let (a, b, signed, slack) = ($a, $b, $signed, $slack);
        let about = |x, right: f64, told: &str| {
            assert!(
                (f64::from(x) - right).abs() < slack,
                "{told}: {x} {right} {a:?} {b:?}"
            );
        };
        about(distance(a, b), signed.max(0.0), "distance");
        about(signed_distance(a, b), signed, "signed distance");
        about(squared_distance(a, b), $square, "square");
        let points = closest_points(a, b);
        about((points.on_b - points.on_a).length(), signed.abs(), "points");
        about(distance(points.on_a, a), 0.0, "the point of a");
        about(distance(points.on_b, b), 0.0, "the point of b");
        let found = penetration(a, b);
        about(found.depth, (-signed).max(0.0), "depth");
        if signed < 0.0 {
            let center = b.center + found.direction * found.depth;
            about(
                signed_distance(a, Obb3 { center, ..b }),
                0.0,
                "after the shift",
            );
        }
    }};
}

#[test]
fn bricks_of_a_wall_are_as_far_apart_as_integers_say() {
    if !geograd_tests::is_due("bricks_of_a_wall_are_as_far_apart_as_integers_say") {
        return;
    }
    let (rotations, mut random) = (rotations(), Random(0x1234_5678_9abc_def1));
    assert_eq!(rotations.len(), 24);
    let mut touching = 0;
    for _ in 0..6000 {
        let ([a, b], [p, q], unit) = bricks(&mut random, &rotations);
        let (signed, square) = p.apart(q);
        touching += usize::from(signed == 0.0);
        let (signed, square) = (signed * unit, square * unit * unit);
        for (a, b) in [(a, b), (b, a)] {
            said!(a, b, signed, square, 1e-13);
            said!(a.cast::<f32>(), b.cast::<f32>(), signed, square, 1e-5);
        }
    }
    assert!(touching > 1000);
}

#[test]
fn bricks_with_round_edges_are_nearer_by_both_radii() {
    let (rotations, mut random) = (rotations(), Random(0x0fed_cba9_8765_4321));
    for _ in 0..2000 {
        let ([a, b], [p, q], unit) = bricks(&mut random, &rotations);
        let signed = p.apart(q).0 * unit;
        let (round_a, round_b) = (RoundBox3::new(a, 0.25), RoundBox3::new(b, 0.5));
        for found in [
            signed_distance(round_a, round_b) + 0.75,
            signed_distance(round_b, round_a) + 0.75,
            signed_distance(a, round_b) + 0.5,
            f64::from(signed_distance(round_a.cast::<f32>(), b.cast())) + 0.25,
        ] {
            assert!(
                (found - signed).abs() < 1e-5,
                "{found} {signed} {a:?} {b:?}"
            );
        }
    }
}

/// The slope of the signed distance by the centre of b is a direction along which all of b is beyond all of a, or the
/// mean of several.
#[test]
fn bricks_that_touch_part_along_a_plane_between_them() {
    let (rotations, mut random) = (rotations(), Random(0x7777_1234_5678_0001));
    let mut touching = 0;
    for _ in 0..6000 {
        let ([a, b], [p, q], _) = bricks(&mut random, &rotations);
        if p.apart(q).0 != 0.0 {
            continue;
        }
        touching += 1;
        let f = |(a, b): (Obb3<_>, Obb3<_>)| signed_distance(a, b);
        let (by_a, by_b) = gradient(f, (a, b)).1;
        assert!((by_a.center + by_b.center).length() < 1e-13);
        let way = by_b.center;
        let high = a
            .corners()
            .map(|corner| way.dot(corner))
            .into_iter()
            .fold(f64::MIN, f64::max);
        let low = b
            .corners()
            .map(|corner| way.dot(corner))
            .into_iter()
            .fold(f64::MAX, f64::min);
        assert!(
            way.length() > 0.5 && low - high > -1e-13,
            "{way:?} {low} {high} {a:?} {b:?}"
        );
    }
    assert!(touching > 1000);
}

/// Two boxes that share an edge and the plane of a side, whose coordinates have one decimal.
#[test]
fn boxes_that_share_an_edge_and_a_plane_touch() {
    let upright = |c: [f64; 3], s: [f64; 3]| Obb3::new(vector(c), vector(s), Rotation3::identity());
    let a = upright([1.7, 0.2, 0.3], [2.0, 0.3, 1.1]);
    let b = upright([3.1, 0.9, 1.8], [0.8, 1.7, 1.9]);
    for (a, b) in [(a, b), (b, a)] {
        assert!(distance(a, b) < 1e-15 && signed_distance(a, b).abs() < 1e-15);
        assert!(distance(a.cast::<f32>(), b.cast::<f32>()) < 1e-6);
    }
}

/// Points of boxes in any position are on the boxes, and as far apart as the distance or the depth says.
#[test]
fn closest_points_of_boxes_are_on_the_boxes() {
    let mut random = Random(0x2468_ace0_1357_9bdf);
    let mut whole = |below: usize, from: f64| {
        let mut one = || random.below(below) as f64 + from;
        [one(), one(), one(), one()]
    };
    for n in 0..8000 {
        let unit = if n % 2 == 0 { 1.0 } else { 0.1 };
        let mut make = || {
            let ([x, y, z, _], [dx, dy, dz, _]) = (whole(5, -2.0), whole(4, 0.0));
            let [w, i, j, k] = whole(4, -1.0);
            let turn = if [w, i, j, k] == [0.0; 4] { 1.0 } else { w };
            let (center, size) = (Vec3::new(x, y, z) * unit, Vec3::new(dx, dy, dz) * unit);
            Obb3::new(center, size, Rotation3::new(turn, i, j, k))
        };
        let (a, b) = (make(), make());
        macro_rules! on_both {
            ($a:expr, $b:expr, $slack:literal) => {{
                let (a, b) = ($a, $b);
                let points = closest_points(a, b);
                let apart = (points.on_b - points.on_a).length() - signed_distance(a, b).abs();
                let off = distance(points.on_a, a).max(distance(points.on_b, b));
                assert!(
                    apart.abs() < $slack && off < $slack,
                    "{apart} {off} {a:?} {b:?}"
                );
            }};
        }
        on_both!(a, b, 1e-14);
        on_both!(a.cast::<f32>(), b.cast::<f32>(), 5e-6);
    }
}

/// Flat boxes that stand on a box's plane, or pierce each other, in both orders.
#[test]
fn flat_boxes_are_as_far_apart_in_either_order() {
    let flat = |c: [f64; 3], s: [f64; 3], [w, x, y, z]: [f64; 4]| {
        Obb3::new(vector(c), vector(s), Rotation3::new(w, x, y, z))
    };
    let plates = [
        flat([-1.0; 3], [3.0, 0.0, 2.0], [-1.0, 2.0, -1.0, 2.0]),
        flat([1.0, 1.0, 0.0], [2.0, 0.0, 3.0], [2.0, 2.0, 2.0, -1.0]),
    ];
    let wire = flat([0.2, -0.2, -0.1], [0.0, 0.3, 0.0], [2.0, 2.0, 1.0, 1.0]);
    let plate = flat([0.2, -0.1, 0.0], [0.0, 0.3, 0.1], [0.0, 0.0, 2.0, 1.0]);
    for ([a, b], right) in [(plates, 22.0 / 13.0), ([wire, plate], 0.0)] {
        for (a, b) in [(a, b), (b, a)] {
            assert!((distance(a, b) - right).abs() < 1e-14, "{a:?} {b:?}");
            assert!((f64::from(distance(a.cast::<f32>(), b.cast())) - right).abs() < 1e-6);
        }
    }
}
