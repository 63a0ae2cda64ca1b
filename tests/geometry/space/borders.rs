//! Borders, corners and planes of triangles, against whole numbers, and closed surfaces without holes.
use super::draw::Random;
use geograd::intersection3::{Hit3, first_hit_of_segment, first_hit_triangle};
use geograd::{Pack, Ray3, Segment3, Triangle3, Vec3};

type Whole = [i128; 3];

/// A place in units that every number of one decimal digit is a multiple of, as single precision rounds it.
fn whole(v: Vec3<f64>) -> Whole {
    [v.x, v.y, v.z].map(|x| {
        let units = x * 2.0_f64.powi(34);
        assert!(units.fract() == 0.0 && x.abs() < 8.0, "{x}");
        units as i128
    })
}

fn minus(a: Whole, b: Whole) -> Whole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn triple(a: Whole, b: Whole, c: Whole) -> i128 {
    let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
    a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)
}

/// The sign of a triple product, and if it is not zero but too close to it for twice the digits of a format.
fn sign(a: Whole, b: Whole, c: Whole, epsilon: f64) -> (i128, bool) {
    let size = |v: Whole| v.map(i128::abs).into_iter().fold(0, i128::max) as f64;
    let value = triple(a, b, c);
    let close = value.abs() as f64 <= 1024.0 * epsilon.powi(2) * size(a) * size(b) * size(c);
    (value.signum(), close && value != 0)
}

/// Whether a line from a point in a direction, which ends where it says so, has a point of a triangle; nothing where a
/// sign is in doubt.
fn meets(
    from: Whole,
    way: Whole,
    to: Option<Whole>,
    corners: [Whole; 3],
    epsilon: f64,
) -> Option<bool> {
    let [a, b, c] = corners.map(|corner| minus(corner, from));
    let sides = [(b, c), (c, a), (a, b)].map(|(p, q)| sign(way, p, q, epsilon));
    let edges = [1, 2].map(|k| minus(corners[k], corners[0]));
    let behind = |place: Whole| sign(minus(corners[0], place), edges[0], edges[1], epsilon);
    let ends = [behind(from), to.map_or((0, false), behind)];
    if sides.iter().chain(&ends).any(|&(_, doubt)| doubt) {
        return None;
    }
    let some = |side: i128| sides.contains(&(side, false));
    if some(1) == some(-1) {
        return Some(false);
    }
    let rate = if some(1) { 1 } else { -1 };
    Some(ends[0].0 * rate >= 0 && ends[1].0 * rate <= 0)
}

/// A place with coordinates of one decimal digit.
fn place(random: &mut Random) -> Vec3<f64> {
    let mut digit = || f64::from((random.below(21) as f32 - 10.0) / 10.0);
    Vec3::new(digit(), digit(), digit())
}

/// As single precision rounds it.
fn rounded(v: Vec3<f64>) -> Vec3<f64> {
    v.cast::<f32>().cast()
}

/// A place at a corner, on an edge or inside, as far as rounding lets it, or anywhere.
fn aim(random: &mut Random, [a, b, c]: [Vec3<f64>; 3]) -> Vec3<f64> {
    match random.below(6) {
        0 => [a, b, c][random.below(3)],
        1 => rounded(b.lerp(c, 0.5)),
        2 => rounded(a.lerp(b, 0.25)),
        3 => rounded(a.lerp(b, 0.5).lerp(c, 0.5)),
        4 => rounded(b + (b - a)),
        _ => place(random),
    }
}

fn judge(
    found: Hit3<f64>,
    from: Vec3<f64>,
    corners: [Vec3<f64>; 3],
    expected: bool,
    epsilon: f64,
) -> bool {
    if !expected {
        return found.kind == 0.0;
    }
    let [a, b, c] = corners;
    let (low, high) = (a.least(b).least(c), a.most(b).most(c));
    let off = (low - found.point).most(found.point - high);
    let size = corners
        .iter()
        .fold(1.0, |most: f64, &p| most.max((p - from).length()));
    found.kind == 1.0 && off.x.max(off.y).max(off.z) <= 100.0 * epsilon * size
}

/// What both formats find, of a ray and of a segment, in any order of the corners. Returns how many were in doubt.
fn meet(from: Vec3<f64>, to: Vec3<f64>, way: Vec3<f64>, corners: [Vec3<f64>; 3]) -> usize {
    let (start, exact) = (whole(from), corners.map(whole));
    let mut doubts = 0;
    let mut check = |found: Hit3<f64>, wire: bool, epsilon: f64| {
        let end = whole(to);
        let expected = match wire {
            true => meets(start, minus(end, start), Some(end), exact, epsilon),
            false => meets(start, whole(way), None, exact, epsilon),
        };
        let Some(expected) = expected else {
            doubts += 1;
            return;
        };
        let right = judge(found, from, corners, expected, epsilon);
        assert!(
            right,
            "{from:?} {to:?} {way:?} {corners:?} {wire} {epsilon}: {found:?} {expected}"
        );
    };
    let [a, b, c] = corners;
    for [a, b, c] in [[a, b, c], [c, a, b], [b, a, c]] {
        let (ray, wire, face) = (
            Ray3::new(from, way),
            Segment3::new(from, to),
            Triangle3::new(a, b, c),
        );
        let (thin, short, flat) = (ray.cast::<f32>(), wire.cast::<f32>(), face.cast::<f32>());
        let (double, single) = (f64::EPSILON, f64::from(f32::EPSILON));
        check(first_hit_triangle(ray, face), false, double);
        check(first_hit_of_segment(wire, face), true, double);
        check(first_hit_triangle(thin, flat).cast(), false, single);
        check(first_hit_of_segment(short, flat).cast(), true, single);
    }
    doubts
}

#[test]
fn borders_belong_to_triangles_as_whole_numbers_say() {
    let mut random = Random(61);
    let mut doubts = 0;
    for _ in 0..8000 {
        let mut corners = [place(&mut random), place(&mut random), place(&mut random)];
        if random.below(4) == 0 {
            let z = corners[0].z;
            corners.iter_mut().for_each(|corner| corner.z = z);
        }
        if random.below(10) == 0 {
            corners[2] = aim(&mut random, corners);
        }
        let from = match random.below(3) {
            0 => aim(&mut random, corners),
            _ => place(&mut random),
        };
        let to = aim(&mut random, corners);
        // A direction that leads through the aim where it does not round, or along an edge.
        let way = match random.below(4) {
            0 => rounded(corners[1] - corners[0]),
            1 => rounded((to - from) * 0.5),
            _ => rounded(to - from),
        };
        doubts += meet(from, to, way, corners);
    }
    assert!(doubts < 3000, "{doubts}");
}

#[test]
fn segments_end_in_corners() {
    let mut random = Random(62);
    for _ in 0..4000 {
        let corners = [(); 3].map(|()| random.vector(1.0));
        let [a, b, c] = corners;
        let from = random.vector(2.0);
        if (b - a).cross(c - a).dot(from - a).abs() < 1e-9 {
            continue;
        }
        for corner in corners {
            let found = first_hit_of_segment(Segment3::new(from, corner), Triangle3::new(a, b, c));
            assert_eq!(
                (found.kind, found.parameter, found.point),
                (1.0, 1.0, corner)
            );
            let found = first_hit_of_segment(Segment3::new(corner, from), Triangle3::new(a, b, c));
            assert_eq!(
                (found.kind, found.parameter, found.point),
                (1.0, 0.0, corner)
            );
            let found =
                first_hit_triangle(Ray3::new(corner, from - corner), Triangle3::new(a, b, c));
            assert_eq!(
                (found.kind, found.parameter, found.point),
                (1.0, 0.0, corner)
            );
        }
    }
}

/// Faces of an octahedron, and of one whose vertices are drawn.
fn surface(random: &mut Random) -> Vec<[Vec3<f64>; 3]> {
    let mut vertex = |x: f64, y: f64, z: f64| {
        let sizes = [(); 3].map(|()| random.within(0.2, 1.0));
        let spread = random.vector(0.1);
        Vec3::new(x * sizes[0], y * sizes[1], z * sizes[2]) + spread
    };
    let [right, left] = [vertex(1.0, 0.0, 0.0), vertex(-1.0, 0.0, 0.0)];
    let [back, front] = [vertex(0.0, 1.0, 0.0), vertex(0.0, -1.0, 0.0)];
    let [up, down] = [vertex(0.0, 0.0, 1.0), vertex(0.0, 0.0, -1.0)];
    let around = [right, back, left, front];
    let faces = |pole: Vec3<f64>| (0..4).map(move |k| [around[k], around[(k + 1) % 4], pole]);
    faces(up).chain(faces(down)).collect()
}

#[test]
fn closed_surfaces_let_no_ray_through() {
    let mut random = Random(63);
    for k in 0..1500 {
        let shift = random.vector(1.0) * [0.0, 1.0, 100.0][k % 3];
        let faces: Vec<[Vec3<f32>; 3]> = surface(&mut random)
            .into_iter()
            .map(|face| face.map(|vertex| (vertex + shift).cast()))
            .collect();
        let from: Vec3<f32> = (shift + random.vector(0.02)).cast();
        for face in &faces {
            let [a, b, _] = *face;
            for at in [a, b.lerp(a, 0.5), a.lerp(b, random.within(0.0, 1.0) as f32)] {
                let way = at - from;
                let hits = faces.iter().filter(|&&[a, b, c]| {
                    first_hit_triangle(Ray3::new(from, way), Triangle3::new(a, b, c)).kind == 1.0
                });
                let single = hits.count();
                let hits = faces.iter().filter(|&&face: &&[Vec3<f32>; 3]| {
                    let [a, b, c] = face.map(|vertex: Vec3<f32>| vertex.cast::<f64>());
                    let ray = Ray3::new(from.cast(), way.cast::<f64>());
                    first_hit_triangle(ray, Triangle3::new(a, b, c)).kind == 1.0
                });
                let double = hits.count();
                assert!(
                    single > 0 && double > 0,
                    "{single} {double} {from:?} {way:?} {faces:?}"
                );
            }
        }
    }
}
