//! The plane that separates two convex bodies best.
use super::convex_body::{Body, Vector, across, aside, unit};
use crate::Vec3;

/// Returns `true` if planes along faces, edges and sections of circles do not suffice.
pub(super) fn curved(a: &Body, b: &Body) -> bool {
    let round = |own: &Body, other: &Body| {
        !own.ellipsoids.is_empty() || !own.rims.is_empty() && !other.is_point()
    };
    round(a, b) || round(b, a)
}

/// The number of cuts after which a part of a plane is smaller than its roundings: each leaves 0.77 of the area.
const CUTS: usize = 300;

/// Returns the gap of the best plane between curved bodies whose normal is less than 70° from a direction, and that
/// normal.
///
/// The gap along a vector is a concave function of it, so that the gap along the direction of a vector has one summit in
/// a plane of vectors, where it is positive. Every slope cuts a part of the plane off. What is left is inside an ellipse
/// (Shor's method).
fn best_near(a: &Body, b: &Body, normal: Vector) -> (f64, Vector) {
    let [x, y] = across(normal);
    let (mut s, mut t) = (0.0, 0.0);
    // The square of the ellipse's matrix.
    let [mut p, mut q, mut r] = [7.3, 0.0, 7.3];
    let mut best = (f64::NEG_INFINITY, normal);
    for _ in 0..CUTS {
        let way = normal + x * s + y * t;
        let length = way.length();
        let direction = way * (1.0 / length);
        let between = b.farthest(-direction) - a.farthest(direction);
        let gap = direction.dot(between);
        if gap > best.0 {
            best = (gap, direction);
        }
        let slope = between - direction * gap.max(0.0);
        let (u, v) = (x.dot(slope), y.dot(slope));
        let (along_u, along_v) = (p * u + q * v, q * u + r * v);
        let square = u * along_u + v * along_v;
        if square.is_nan() || square <= 0.0 {
            break;
        }
        let over = 1.0 / square.sqrt();
        let (step_u, step_v) = (along_u * over, along_v * over);
        (s, t) = (s + step_u / 3.0, t + step_v / 3.0);
        let share = 2.0 / 3.0;
        p = (p - share * step_u * step_u) * (4.0 / 3.0);
        q = (q - share * step_u * step_v) * (4.0 / 3.0);
        r = (r - share * step_v * step_v) * (4.0 / 3.0);
    }
    best
}

/// Returns the gap of the plane that separates two curved bodies best, if they are apart; else that of one that is good.
fn best_of_curved(a: &Body, b: &Body) -> f64 {
    let gap = |n: Vector| -b.reach(-n) - a.reach(n);
    let (of_a, of_b) = (a.points(), b.points());
    let between = of_a.iter().flat_map(|p| of_b.iter().map(|q| *q - *p));
    // The border of a half-space is normal to one of the directions without end.
    let endless = a.endless.iter().chain(&b.endless);
    let ways = a.ways.iter().chain(&b.ways).chain(endless).copied();
    let units = between.chain(ways).filter_map(unit);
    let signed = units.flat_map(|n| [n, -n]).map(|n| (gap(n), n));
    let first = signed.max_by(|p, q| p.0.total_cmp(&q.0));
    let mut best = first.unwrap_or((gap(Vec3::new(1.0, 0.0, 0.0)), Vec3::new(1.0, 0.0, 0.0)));
    // One plane alone has a half-space on one of its sides.
    let is_half_space = |own: &Body| own.endless.len() > 2;
    if is_half_space(a) || is_half_space(b) {
        return best.0;
    }
    for _ in 0..2 {
        let found = best_near(a, b, best.1);
        if found.0 > best.0 {
            best = found;
        }
    }
    best.0
}

/// Returns the gap of the plane that separates two bodies best. It tries planes along faces and pairs of edges, and
/// planes normal to the vectors from corner to corner and from corner to edge.
pub(super) fn best(a: &Body, b: &Body) -> f64 {
    if curved(a, b) {
        return best_of_curved(a, b);
    }
    let (corners_a, ways_a) = a.flat(&b.points());
    let (corners_b, ways_b) = b.flat(&a.points());
    let ways: Vec<Vector> = ways_a.into_iter().chain(ways_b).collect();
    let mut normals = ways.clone();
    for (i, u) in ways.iter().enumerate() {
        // Twice, since the product of directions that are nearly parallel is mostly rounding.
        let product = |v: &Vector| aside(aside(aside(u.cross(*v), *u), *v), *u);
        normals.extend(ways[..i].iter().map(product));
    }
    // For bodies on one line or in one point any orthogonal direction will do.
    normals.extend(ways.iter().flat_map(|&way| across(way)));
    normals.extend(across(Vec3::zero()));
    for p in &corners_a {
        for q in &corners_b {
            let way = *q - *p;
            normals.push(way);
            normals.extend(ways.iter().map(|u| aside(aside(way, *u), *u)));
        }
    }
    let gap = |n: Vector| -b.reach(-n) - a.reach(n);
    let both = normals.into_iter().filter_map(unit);
    both.fold(f64::NEG_INFINITY, |most, n| most.max(gap(n)).max(gap(-n)))
}
