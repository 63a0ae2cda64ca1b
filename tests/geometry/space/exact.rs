//! Whole numbers in 128 bits: what a hull of corners contains, and where a line enters and leaves it.
use super::draw::Random;
use geograd::{Scalar, Vec3};

/// A point of whole numbers.
pub type Whole = [i128; 3];

pub fn minus(a: Whole, b: Whole) -> Whole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
pub fn plus(a: Whole, b: Whole, times: i128) -> Whole {
    [0, 1, 2].map(|k| a[k] + b[k] * times)
}
pub fn dot(a: Whole, b: Whole) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub fn cross(a: Whole, b: Whole) -> Whole {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}
pub fn length(a: Whole) -> f64 {
    a.iter().map(|&x| (x as f64).powi(2)).sum::<f64>().sqrt()
}
/// The point in a format that holds it exactly.
pub fn place<S: Scalar>(p: Whole) -> Vec3<S> {
    let [x, y, z] = p.map(|x| S::lit(x as f64));
    Vec3::new(x, y, z)
}
/// A point with coordinates up to a size.
pub fn draw(random: &mut Random, size: usize) -> Whole {
    [0; 3].map(|_| random.below(2 * size + 1) as i128 - size as i128)
}

/// Whether a segment has a point, its ends included.
pub fn segment_has(a: Whole, b: Whole, p: Whole) -> bool {
    let along = minus(b, a);
    cross(along, minus(p, a)) == [0; 3] && dot(minus(p, a), minus(p, b)) <= 0
}
/// Whether a triangle with an area has a point, its border included.
fn triangle_has([a, b, c]: [Whole; 3], p: Whole) -> bool {
    let normal = cross(minus(b, a), minus(c, a));
    let left = |p: Whole, q: Whole, r: Whole| dot(normal, cross(minus(q, p), minus(r, p))) >= 0;
    normal != [0; 3]
        && dot(normal, minus(p, a)) == 0
        && left(a, b, p)
        && left(b, c, p)
        && left(c, a, p)
}
/// Three of four corners, in every way.
fn faces([a, b, c, d]: [Whole; 4]) -> [[Whole; 3]; 4] {
    [[b, c, d], [a, c, d], [a, b, d], [a, b, c]]
}
/// Two of four corners, in every way.
fn edges([a, b, c, d]: [Whole; 4]) -> [[Whole; 2]; 6] {
    [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]
}

/// Whether the hull of four corners has a point: by Carathéodory a simplex of some of them does.
pub fn hull_has(corners: [Whole; 4], p: Whole) -> bool {
    let [a, b, c, d] = corners;
    let volume = |a, b, c, d| dot(cross(minus(b, a), minus(c, a)), minus(d, a));
    let whole = volume(a, b, c, d).signum();
    let parts = [
        volume(p, b, c, d),
        volume(a, p, c, d),
        volume(a, b, p, d),
        volume(a, b, c, p),
    ];
    whole != 0 && parts.iter().all(|part| part * whole >= 0)
        || faces(corners).into_iter().any(|face| triangle_has(face, p))
        || edges(corners)
            .into_iter()
            .any(|[a, b]| segment_has(a, b, p))
}

/// A place where a line meets a hull: the parameter, and the sine of the line's angle with the face, or 1.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    pub t: f64,
    pub sine: f64,
}

/// Where a line enters and leaves the hull of four corners.
pub fn line_in_hull(corners: [Whole; 4], from: Whole, way: Whole) -> Option<[Met; 2]> {
    let mut met: Vec<Met> = Vec::new();
    for face in faces(corners) {
        let [a, b, c] = face;
        let normal = cross(minus(b, a), minus(c, a));
        let (under, over) = (dot(normal, way), dot(normal, minus(a, from)));
        if under == 0 {
            continue;
        }
        // The point times the denominator, in the plane by construction.
        let at = [0, 1, 2].map(|k| from[k] * under + way[k] * over);
        let left = |p: Whole, q: Whole| {
            let arm = [0, 1, 2].map(|k| at[k] - p[k] * under);
            dot(normal, cross(minus(q, p), arm)) * under.signum() >= 0
        };
        if left(a, b) && left(b, c) && left(c, a) {
            let sine = (under as f64).abs() / length(normal) / length(way);
            let t = over as f64 / under as f64;
            met.push(Met { t, sine });
        }
    }
    for [a, b] in edges(corners) {
        let (along, arm) = (minus(b, a), minus(a, from));
        let normal = cross(way, along);
        let square = dot(normal, normal);
        let sine = 1.0;
        if square == 0 {
            let ends = [arm, minus(b, from)];
            if cross(arm, way) == [0; 3] {
                let t = ends.map(|end| dot(end, way) as f64 / dot(way, way) as f64);
                met.extend(t.map(|t| Met { t, sine }));
            }
            continue;
        }
        let on_edge = dot(cross(arm, way), normal);
        if dot(arm, normal) == 0 && (0..=square).contains(&on_edge) {
            let t = dot(cross(arm, along), normal) as f64 / square as f64;
            let sine = square as f64 / length(way) / length(way) / length(along) / length(along);
            met.push(Met {
                t,
                sine: sine.sqrt(),
            });
        }
    }
    let by = |a: &Met, b: &Met| a.t.total_cmp(&b.t);
    Some([
        met.iter().copied().min_by(by)?,
        met.iter().copied().max_by(by)?,
    ])
}
