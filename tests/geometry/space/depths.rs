//! Depths of overlap, their slopes and points, where faces and edges are parallel, against whole numbers.
//!
//! The oracle takes all differences of corners, and the planes through any three of them that have all others on one
//! side, in whole numbers. It names no face and no edge. Slopes are its one-sided differences.
use super::draw::{Random, wide};
use super::oracle::hulls;
use geograd::ad::gradient;
use geograd::distance3::{closest_points, penetration, signed_distance};
use geograd::prelude::*;

type Point = [i128; 3];

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}
fn dot(a: Point, b: Point) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A length of one, so that steps of a millionth are whole.
const ONE: i128 = 1 << 20;
/// What halves of sizes along the axes of all [`TURNS`] are whole in units of.
const UNIT: i128 = 50;
/// Quaternions whose rotations have numbers of fifths.
const TURNS: [[i128; 4]; 5] = [
    [1, 0, 0, 0],
    [1, 1, 1, 1],
    [2, 1, 0, 0],
    [1, 0, 0, 1],
    [1, 2, 0, 0],
];

/// The gap along the plane that parts two hulls best, and how many do; `None` where they are apart or without volume.
fn deepest(a: &[Point], b: &[Point]) -> Option<(f64, usize)> {
    let mut points: Vec<Point> = vec![];
    for &p in a {
        points.extend(b.iter().map(|&q| minus(q, p)));
    }
    points.sort_unstable();
    points.dedup();
    let mut best: Option<(f64, Vec<[f64; 3]>)> = None;
    let mut solid = false;
    for (i, &p) in points.iter().enumerate() {
        for (j, &q) in points[..i].iter().enumerate() {
            for &r in &points[..j] {
                let normal = cross(minus(q, p), minus(r, p));
                if normal == [0; 3] {
                    continue;
                }
                let at = dot(normal, p);
                let over = |&point: &Point| dot(normal, point) - at;
                let (below, above) = (
                    points.iter().any(|p| over(p) < 0),
                    points.iter().any(|p| over(p) > 0),
                );
                solid |= below || above;
                let long = normal.map(|x| x as f64);
                let length = long.iter().map(|x| x * x).sum::<f64>().sqrt();
                for (blocked, sign) in [(below, 1.0), (above, -1.0)] {
                    let unit = long.map(|x| sign * x / length);
                    let gap = sign * at as f64 / length / (ONE * UNIT) as f64;
                    match &mut best {
                        _ if blocked => {}
                        Some((most, units)) if (gap - *most).abs() < 1e-13 => {
                            let same =
                                |u: &[f64; 3]| (0..3).all(|k| (u[k] - unit[k]).abs() < 1e-12);
                            if !units.iter().any(same) {
                                units.push(unit);
                            }
                        }
                        Some((most, _)) if gap < *most => {}
                        _ => best = Some((gap, vec![unit])),
                    }
                }
            }
        }
    }
    best.filter(|(gap, _)| solid && *gap <= 0.0)
        .map(|(gap, units)| (gap, units.len()))
}

/// A shape of whole numbers: its corners one after another, or the centre and the size of a box that is turned.
#[derive(Clone, Debug)]
struct Solid {
    numbers: Vec<i128>,
    turn: Option<usize>,
}

impl Solid {
    /// At random, of some corners or a box.
    fn draw(random: &mut Random, corners: usize, turn: usize) -> Self {
        let mut within = |low: i128, count: usize| (low + random.below(count) as i128) * ONE;
        let is_box = corners == 0;
        let numbers = match is_box {
            true => (0..6)
                .map(|k| if k < 3 { within(-1, 3) } else { within(0, 4) })
                .collect(),
            false => (0..3 * corners).map(|_| within(-2, 5)).collect(),
        };
        let turn = is_box.then_some(turn);
        Solid { numbers, turn }
    }
    fn corners(&self) -> Vec<Point> {
        let x = &self.numbers;
        let Some(turn) = self.turn else {
            return x
                .chunks(3)
                .map(|p| [p[0], p[1], p[2]].map(|x| x * UNIT))
                .collect();
        };
        let [w, i, j, k] = TURNS[turn];
        let square = w * w + i * i + j * j + k * k;
        let axes = [
            [
                w * w + i * i - j * j - k * k,
                2 * (i * j + w * k),
                2 * (i * k - w * j),
            ],
            [
                2 * (i * j - w * k),
                w * w + j * j - i * i - k * k,
                2 * (j * k + w * i),
            ],
            [
                2 * (i * k + w * j),
                2 * (j * k - w * i),
                w * w + k * k - i * i - j * j,
            ],
        ];
        let corner = |n: usize| {
            [0, 1, 2].map(|c| {
                let arm = |k: usize| {
                    let arm = x[3 + k] * axes[k][c] * UNIT / (2 * square);
                    if n >> k & 1 == 1 { arm } else { -arm }
                };
                x[c] * UNIT + arm(0) + arm(1) + arm(2)
            })
        };
        (0..8).map(corner).collect()
    }
    /// All its numbers for the library.
    fn scalars(&self) -> Vec<f64> {
        let mut found: Vec<f64> = self
            .numbers
            .iter()
            .map(|&x| x as f64 / ONE as f64)
            .collect();
        if let Some(turn) = self.turn {
            found.extend(TURNS[turn].map(|x| x as f64));
        }
        found
    }
    /// With one of its numbers changed.
    fn moved(&self, number: usize, by: i128) -> Self {
        let mut found = self.clone();
        found.numbers[number] += by;
        found
    }
    /// `true` of the size of a box that is zero, which has one side only.
    fn ends(&self, number: usize) -> bool {
        self.turn.is_some() && number >= 3 && self.numbers[number] == 0
    }
}

/// Pairs of whole numbers that overlap, against the oracle.
macro_rules! overlap {
    ($($name:ident: $A:ident $m:literal, $B:ident $n:literal;)*) => { $(
        #[test]
        fn $name() {
            if !geograd_tests::is_due(stringify!($name)) {
                return;
            }
            let mut random = Random(0x9e37_79b9_7f4a_7c15);
            let (mut found, mut kinks) = (0, 0);
            while found < 60 {
                let (turn, other) = (random.below(5), random.below(5));
                let a = Solid::draw(&mut random, $m, turn);
                let mut b = Solid::draw(&mut random, $n, other);
                if $m == $n && random.below(2) == 0 {
                    let step = [0; 3].map(|_: i128| (random.below(3) as i128 - 1) * ONE);
                    b = a.clone();
                    for (k, x) in b.numbers.iter_mut().enumerate() {
                        *x += step[k % 3];
                    }
                }
                let Some((depth, planes)) = deepest(&a.corners(), &b.corners()) else {
                    continue;
                };
                found += 1;
                let wide = ($A::load(&a.scalars()), $B::load(&b.scalars()));
                overlaps!((a, b), wide, $A, $B, f64, 1e-14, (depth, planes), kinks);
                let near = ($A::load(&a.scalars()).cast::<f32>(), $B::load(&b.scalars()).cast::<f32>());
                overlaps!((a, b), near, $A, $B, f32, 5e-6, (depth, planes), kinks);
            }
            assert!(kinks < 40, "{kinks} of 120 have several planes");
        }
    )* };
}

/// One pair in one format.
macro_rules! overlaps {
    (($x:ident, $y:ident), $shapes:expr, $A:ident, $B:ident, $S:ty, $error:expr,
        ($depth:expr, $planes:expr), $kinks:ident) => {{
        let (a, b) = $shapes;
        let value = f64::from(signed_distance(a, b));
        let say = || format!("{a:?} {b:?}: {value}, right {}", $depth);
        assert!((value - $depth).abs() < $error, "{}", say());
        assert!(
            (f64::from(signed_distance(b, a)) - $depth).abs() < $error,
            "{}",
            say()
        );
        // The points are on the shapes, and the shift brings them together.
        let (points, contact) = (closest_points(a, b), penetration(a, b));
        let shift = contact.direction * contact.depth;
        let rest = [
            (points.on_b + shift - points.on_a).length(),
            points.on_a.distance(a),
            points.on_b.distance(b),
        ];
        assert!(
            rest.into_iter().all(|x| f64::from(x) < 4.0 * $error),
            "{}: {points:?} {rest:?}",
            say()
        );
        let parted = shifted!(b, $B, shift).signed_distance(a);
        assert!(
            f64::from(parted) > -4.0 * $error,
            "{}: left {parted}",
            say()
        );
        $kinks += usize::from($planes > 1);
        // With one plane each slope is between both one-sided ones.
        if $planes == 1 && $depth < 0.0 {
            let f = |(a, b): ($A<_>, $B<_>)| signed_distance(a, b);
            let (_, (by_a, by_b)) = gradient(f, (a, b));
            let (m, n) = ($x.numbers.len(), $y.numbers.len());
            let slopes: Vec<$S> = by_a.scalars()[..m]
                .iter()
                .chain(&by_b.scalars()[..n])
                .copied()
                .collect();
            for (k, slope) in slopes.into_iter().map(f64::from).enumerate() {
                if if k < m { $x.ends(k) } else { $y.ends(k - m) } {
                    continue;
                }
                let side = |by: i128| {
                    let (p, q) = if k < m {
                        ($x.moved(k, by), $y.clone())
                    } else {
                        ($x.clone(), $y.moved(k - m, by))
                    };
                    let (moved, _) = deepest(&p.corners(), &q.corners()).expect("they overlap");
                    (moved - $depth) / (by as f64 / ONE as f64)
                };
                let (ahead, back) = (side(64), side(-64));
                let (low, high) = (ahead.min(back) - 1e-3, ahead.max(back) + 1e-3);
                assert!(
                    low < slope && slope < high,
                    "{}: number {k}: {slope}, in {low} to {high}",
                    say()
                );
            }
        }
    }};
}

/// A shape of corners, or a box, elsewhere.
macro_rules! shifted {
    ($shape:expr, Obb3, $shift:expr) => {
        Obb3::new($shape.center + $shift, $shape.size, $shape.rotation)
    };
    ($shape:expr, $Shape:ident, $shift:expr) => {{
        let way = [$shift.x, $shift.y, $shift.z];
        let numbers = $shape.scalars().into_iter().enumerate();
        $Shape::load(&numbers.map(|(k, x)| x + way[k % 3]).collect::<Vec<_>>())
    }};
}

overlap! {
    tetrahedra_overlap_as_the_oracle_says: Tetrahedron 4, Tetrahedron 4;
    segments_and_tetrahedra_overlap_as_the_oracle_says: Segment3 2, Tetrahedron 4;
    triangles_and_tetrahedra_overlap_as_the_oracle_says: Triangle3 3, Tetrahedron 4;
    triangles_overlap_as_the_oracle_says: Triangle3 3, Triangle3 3;
    segments_and_boxes_overlap_as_the_oracle_says: Segment3 2, Obb3 0;
    triangles_and_boxes_overlap_as_the_oracle_says: Triangle3 3, Obb3 0;
    boxes_and_tetrahedra_overlap_as_the_oracle_says: Obb3 0, Tetrahedron 4;
}

fn corner(x: f64, y: f64, z: f64) -> Vec3<f64> {
    Vec3::new(x, y, z)
}

#[test]
fn a_corner_behind_the_face_of_a_moved_copy_pulls_by_its_foot() {
    let at = [
        corner(0.0, 0.0, 0.0),
        corner(4.0, 0.0, 0.0),
        corner(0.0, 4.0, 0.0),
        corner(0.0, 0.0, 4.0),
    ];
    let step = corner(1.0, 0.5, 0.25);
    let solid = |by: Vec3<f64>| Tetrahedron::new(at[0] + by, at[1] + by, at[2] + by, at[3] + by);
    let f = |(a, b): (Tetrahedron<_>, Tetrahedron<_>)| signed_distance(a, b);
    let (depth, (by_a, by_b)) = gradient(f, (solid(Vec3::zero()), solid(step)));
    let root = 3_f64.sqrt();
    assert!((depth + 2.25 / root).abs() < 1e-15);
    // The corner at the step lies 2.25 / 3 below the face in each coordinate: at (1.75, 1.25, 1) of it.
    for (slope, part) in [(by_a.b, 1.75), (by_a.c, 1.25), (by_a.d, 1.0)] {
        let right = -part / 4.0 / root;
        for x in [slope.x, slope.y, slope.z] {
            assert!((x - right).abs() < 1e-15, "{slope:?} {right}");
        }
    }
    for x in [by_b.a.x, by_b.a.y, by_b.a.z] {
        assert!((x - 1.0 / root).abs() < 1e-15, "{by_b:?}");
    }
    assert_eq!(
        (by_b.b, by_b.c, by_b.d),
        (Vec3::zero(), Vec3::zero(), Vec3::zero())
    );
}

#[test]
fn a_capsule_through_a_face_along_it_pulls_between_the_edges() {
    let bar = Capsule3::new(
        corner(-0.125, 0.25, -0.25),
        corner(-0.125, 0.25, 0.75),
        0.25,
    );
    let room = Obb3::new(
        Vec3::zero(),
        corner(1.125, 0.875, 0.375),
        Rotation3::identity(),
    );
    let f = |(a, b): (Capsule3<_>, Obb3<_>)| signed_distance(a, b);
    let (depth, (by_bar, _)) = gradient(f, (bar, room));
    assert_eq!(depth, -0.4375);
    let (start, end) = (by_bar.start.y, by_bar.end.y);
    assert!(
        (0.5625..=0.9375).contains(&start) && (0.0625..=0.4375).contains(&end),
        "{start} {end}"
    );
    assert!((start + end - 1.0).abs() < 1e-15);
}

#[test]
fn points_of_planes_that_tie_are_those_of_one() {
    let rod = Capsule3::new(corner(-1.0, -1.0, -1.0), corner(1.0, 1.0, 0.0), 0.0);
    let cube = Obb3::new(Vec3::zero(), corner(1.0, 1.0, 1.0), Rotation3::identity());
    let found = closest_points(rod, cube);
    let depth = penetration(rod, cube).depth;
    assert!(
        ((found.on_b - found.on_a).length() - depth).abs() < 1e-15,
        "{found:?} {depth}"
    );
    assert!(found.on_a.distance(rod) < 1e-15 && found.on_b.distance(cube) < 1e-15);
}

#[test]
fn planes_that_all_but_tie_pull_alone() {
    // Two planes are a millionth apart, an edge and a face along each other to a millionth.
    let a = [
        corner(0.0, 0.0, -1e-6),
        corner(1.0, -1.0, -1e-6),
        corner(2.0, 2.0, 1.999999),
        corner(-2.0, 2.0, 1.999999),
    ];
    let b = [
        corner(-2.0, 2.0, -2.0),
        corner(0.0, -1.0, 0.0),
        corner(1.0, 1.0, -2.0),
        corner(1.0, 1.0, 0.0),
    ];
    let solid = |p: [Vec3<f64>; 4]| Tetrahedron::new(p[0], p[1], p[2], p[3]);
    let f = |(a, b): (Tetrahedron<_>, Tetrahedron<_>)| signed_distance(a, b);
    let (_, (by_a, by_b)) = gradient(f, (solid(a), solid(b)));
    let depth = |a: [Vec3<f64>; 4], b: [Vec3<f64>; 4]| hulls(&a.map(wide), &b.map(wide), true);
    let slopes = by_a.scalars().into_iter().chain(by_b.scalars());
    for (k, slope) in slopes.enumerate() {
        let side = |by: f64| {
            let step = [
                corner(by, 0.0, 0.0),
                corner(0.0, by, 0.0),
                corner(0.0, 0.0, by),
            ][k % 3];
            let (mut p, mut q) = (a, b);
            if k < 12 {
                p[k / 3] += step
            } else {
                q[k / 3 - 4] += step
            }
            (depth(p, q) - depth(a, b)) / by
        };
        let (ahead, back) = (side(1e-8), side(-1e-8));
        let (low, high) = (ahead.min(back) - 1e-6, ahead.max(back) + 1e-6);
        assert!(
            low < slope && slope < high,
            "number {k}: {slope}, in {low} to {high}"
        );
    }
}

#[test]
fn an_edge_along_the_face_of_a_box_pulls_between_both_sides() {
    let a = Tetrahedron::new(
        corner(1.0, 1.0, 2.0),
        corner(2.0, 1.0, 2.0),
        corner(0.0, 0.0, -2.0),
        corner(1.0, 1.0, -1.0),
    );
    let b = Obb3::new(
        corner(2.0, 2.0, 2.0),
        corner(3.0, 3.0, 2.0),
        Rotation3::new(2.0, 1.0, 0.0, 0.0),
    );
    let f = |(a, b): (Tetrahedron<_>, Obb3<_>)| signed_distance(a, b);
    let (_, (by_a, _)) = gradient(f, (a, b));
    assert!((-0.8..=1e-15).contains(&by_a.a.y), "{by_a:?}");
}
