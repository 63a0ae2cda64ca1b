//! Every distance in space is proved by what it comes with: points that are so far apart, and a plane between.
//!
//! The points are on the shapes, so that the distance is at most theirs. The shapes are on both sides of the plane, so
//! that the distance is at least the gap. Of shapes that overlap the plane says how deep they are at most, the normals of
//! all faces and pairs of edges how deep at least. Nothing here is the library's but what is tested: a shape is its
//! corners, the ways along its edges, and a radius.
use super::draw::{FAMILIES, Random};
use geograd::distance3::{Apart, closest_points, distance, penetration, signed_distance};
use geograd::prelude::*;

/// The hull of some corners, inflated.
struct Solid {
    corners: Vec<Vec3<f64>>,
    /// Three ways, of which any two are a face's, or none.
    ways: Vec<Vec3<f64>>,
    radius: f64,
}

impl Solid {
    fn hull(corners: &[Vec3<f64>], radius: f64) -> Self {
        let mut ways = vec![];
        for (i, &p) in corners.iter().enumerate() {
            ways.extend(corners[..i].iter().map(|&q| p - q));
        }
        Solid {
            corners: corners.to_vec(),
            ways,
            radius,
        }
    }
    fn boxed(shape: Obb3<f64>, radius: f64) -> Self {
        let corners = shape.corners();
        let unit = |x, y, z| shape.rotation * Vec3::new(x, y, z);
        Solid {
            corners: corners.to_vec(),
            ways: vec![
                unit(1.0, 0.0, 0.0),
                unit(0.0, 1.0, 0.0),
                unit(0.0, 0.0, 1.0),
            ],
            radius,
        }
    }
    /// The least and the greatest of `normal · point`.
    fn range(&self, normal: Vec3<f64>) -> (f64, f64) {
        let heights = || self.corners.iter().map(|&p| normal.dot(p));
        let low = heights().fold(f64::MAX, f64::min);
        let high = heights().fold(f64::MIN, f64::max);
        (low - self.radius, high + self.radius)
    }
    /// How far a point is outside along any normal of two ways, or of a way and an axis: at most its distance.
    fn outside(&self, point: Vec3<f64>) -> f64 {
        let mut normals = self.ways.clone();
        for (i, u) in self.ways.iter().enumerate() {
            normals.extend(self.ways[..i].iter().map(|v| u.cross(*v)));
        }
        let gaps = normals.into_iter().filter_map(unit).map(|n| {
            let (low, high) = self.range(n);
            (n.dot(point) - high).max(low - n.dot(point))
        });
        gaps.fold(0.0, f64::max)
    }
}

/// A vector with length one; none for one that is rounding.
fn unit(v: Vec3<f64>) -> Option<Vec3<f64>> {
    let length = v.length();
    (length > 1e-9).then(|| v * (1.0 / length))
}

/// By how far a plane parts b from a.
fn gap(a: &Solid, b: &Solid, normal: Vec3<f64>) -> f64 {
    b.range(normal).0 - a.range(normal).1
}

/// The gap of the plane that parts the shapes best, of those along faces and pairs of edges.
fn best(a: &Solid, b: &Solid) -> f64 {
    let ways: Vec<_> = a.ways.iter().chain(&b.ways).copied().collect();
    let mut most = f64::MIN;
    for (i, u) in ways.iter().enumerate() {
        for v in &ways[..i] {
            if let Some(n) = unit(u.cross(*v)) {
                most = most.max(gap(a, b, n)).max(gap(a, b, -n));
            }
        }
    }
    most
}

/// The same, of those across the ways from corner to corner and from corner to edge.
fn best_between(a: &Solid, b: &Solid) -> f64 {
    let mut most = f64::MIN;
    for p in &a.corners {
        for q in &b.corners {
            let way = *q - *p;
            let across = a.ways.iter().chain(&b.ways).map(|&u| {
                let square = u.length_squared();
                let square = if square > 0.0 { square } else { 1.0 };
                way - u * (u.dot(way) / square)
            });
            for n in across.chain([way]).filter_map(unit) {
                most = most.max(gap(a, b, n));
            }
        }
    }
    most
}

/// What a pair says of itself, in numbers of twice the digits for single precision.
struct Told {
    value: f64,
    distance: f64,
    on_a: Vec3<f64>,
    on_b: Vec3<f64>,
    depth: f64,
    normal: Vec3<f64>,
}

fn told<S: Scalar<Mask = bool> + Into<f64>, A: Apart<B, Scalar = S>, B: Copy>(a: A, b: B) -> Told {
    let wide = |v: Vec3<S>| Vec3::new(v.x.into(), v.y.into(), v.z.into());
    let (points, contact) = (closest_points(a, b), penetration(a, b));
    Told {
        value: signed_distance(a, b).into(),
        distance: distance(a, b).into(),
        on_a: wide(points.on_a),
        on_b: wide(points.on_b),
        depth: contact.depth.into(),
        normal: wide(contact.direction),
    }
}

/// Proves a signed distance to within `error`.
fn prove(a: &Solid, b: &Solid, told: &Told, error: f64, solid: bool, name: &str) {
    let Told { value, .. } = *told;
    let say = || format!("{name}: {value:e} {:?} {:?}", told.on_a, told.on_b);
    assert_eq!(told.distance, value.max(0.0), "{}", say());
    assert_eq!(told.depth, (-value).max(0.0), "{}", say());
    // Above: the points are on the shapes and so far apart.
    let way = told.on_b - told.on_a;
    assert!(
        (way.length() - value.abs()).abs() < error,
        "{}: {}",
        say(),
        way.length()
    );
    if value > 0.0 {
        assert!(
            a.outside(told.on_a) < error,
            "{}: a {}",
            say(),
            a.outside(told.on_a)
        );
        assert!(
            b.outside(told.on_b) < error,
            "{}: b {}",
            say(),
            b.outside(told.on_b)
        );
    }
    // Below: the plane. Its direction has half the digits of the distance where features tie to rounding; then one of
    // the planes across all ways between features proves the value.
    if told.normal != Vec3::zero() && value.abs() > error {
        assert!((told.normal.length() - 1.0).abs() < error, "{}", say());
        let parted = gap(a, b, told.normal);
        assert!(
            value < parted + error.sqrt(),
            "{}: parted by {parted:e}",
            say()
        );
        // The directions of short ways have fewer digits.
        let error = error * 1.0_f64.max(4.0 / value.abs());
        if value > parted + error {
            let parted = best(a, b).max(best_between(a, b));
            assert!(
                value < parted + error,
                "{}: parted at best by {parted:e}",
                say()
            );
        }
    }
    if solid && value <= 0.0 {
        let most = best(a, b);
        assert!(value > most - error, "{}: best {most:e}", say());
    }
}

macro_rules! proved {
    ($random:ident, $family:ident, $name:ident, $solid:literal, $a:expr, $b:expr, $core_a:expr, $core_b:expr) => {{
        // All numbers are those of single precision, so that both formats have one truth.
        let (a, b) = ($a.cast::<f32>(), $b.cast::<f32>());
        let (in_a, in_b) = ($core_a(a.cast::<f64>()), $core_b(b.cast::<f64>()));
        let size = if $family == 6 { 4e6 } else { 4.0 };
        let wide = told(a.cast::<f64>(), b.cast::<f64>());
        let near = format!("{} {}", $name, stringify!($a, $b));
        prove(&in_a, &in_b, &wide, 4e-15 * size, $solid, &near);
        prove(&in_a, &in_b, &told(a, b), 2e-6 * size, $solid, &near);
    }};
}

#[test]
fn points_and_planes_prove_every_distance() {
    let mut random = Random(0x1234_5678_9abc_def1);
    let boxed = |shape: Obb3<f64>| Solid::boxed(shape, 0.0);
    let round = |shape: RoundBox3<f64>| Solid::boxed(shape.inner, shape.radius);
    let edge = |s: Segment3<f64>| Solid::hull(&[s.start, s.end], 0.0);
    let link = |s: Capsule3<f64>| Solid::hull(&[s.start, s.end], s.radius);
    let ball = |s: Sphere<f64>| Solid::hull(&[s.center], s.radius);
    let face = |s: Triangle3<f64>| Solid::hull(&s.corners(), 0.0);
    let tetra = |s: Tetrahedron<f64>| Solid::hull(&s.corners(), 0.0);
    for (family, name) in FAMILIES.iter().enumerate() {
        for _ in 0..40 {
            let (a, b) = (random.solid(family), random.solid(family));
            proved!(random, family, name, true, a, b, boxed, boxed);
            let p: [Vec3<f64>; 8] = std::array::from_fn(|_| random.corner(family));
            let radius = random.within(0.0, 1.0);
            let s = Segment3::new(p[0], p[1]);
            proved!(random, family, name, true, s, b, edge, boxed);
            let capsule = Capsule3::new(p[0], p[1], radius);
            let rounded = RoundBox3::new(b, 0.25);
            // Radii end where the depth of the core is known.
            if s.distance(b) > 1e-3 {
                proved!(random, family, name, false, capsule, rounded, link, round);
            }
            let center = Sphere::new(p[2], radius);
            if p[2].distance(b) > 1e-3 {
                proved!(random, family, name, false, center, b, ball, boxed);
            }
            let t = Triangle3::new(p[2], p[3], p[4]);
            proved!(random, family, name, false, s, t, edge, face);
            let u = Triangle3::new(p[5], p[6], p[7]);
            proved!(random, family, name, false, t, u, face, face);
            let v = Tetrahedron::new(p[4], p[5], p[6], p[7]);
            proved!(random, family, name, false, t, v, face, tetra);
            proved!(random, family, name, false, b, v, boxed, tetra);
        }
    }
}
