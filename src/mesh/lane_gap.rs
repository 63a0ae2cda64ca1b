//! Lower bounds of the distances of eight triangles from a box or a triangle, in single precision.
//!
//! Two convex shapes are at least as far apart as the gap between their extents along any direction. The direction is
//! that between points that alternating projections bring near each other; where they have not come to the nearest ones
//! the bound is less, and still one.
//!
//! No closures: batches compile it for the vectors of the processor, and closures would stay behind.
use super::packet::EightLanes;
use crate::Vec3;

/// How often points are projected to both shapes. Each time the bound is taken.
const ROUNDS: usize = 3;

/// Returns a vector's length squared, above zero.
#[inline(always)]
fn square<L: EightLanes>(v: Vec3<L>) -> L {
    v.length_squared().most(L::all(f32::MIN_POSITIVE))
}

/// Returns points of triangles that are nearest to points, or near them.
#[inline(always)]
fn closest<L: EightLanes>([a, b, c]: [Vec3<L>; 3], point: Vec3<L>) -> Vec3<L> {
    let (zero, one) = (L::all(0.0), L::all(1.0));
    let n = (b - a).cross(c - a);
    let (mut best, mut least) = (a, L::all(f32::INFINITY));
    let mut inside = zero.at_most(one);
    for (start, end) in [(a, b), (b, c), (c, a)] {
        let (edge, arm) = (end - start, point - start);
        let t = (edge.dot(arm) / square(edge)).most(zero).least(one);
        let foot = start + edge * t;
        let apart = (foot - point).length_squared();
        best = Vec3::select(apart.below(least), foot, best);
        least = apart.least(least);
        inside = inside & edge.cross(arm).dot(n).above(zero);
    }
    let flat = point + n * (n.dot(a - point) / square(n));
    Vec3::select(inside, flat, best)
}

/// Returns the least of three products.
#[inline(always)]
fn lowest<L: EightLanes>([a, b, c]: [Vec3<L>; 3], way: Vec3<L>) -> L {
    a.dot(way).least(b.dot(way)).least(c.dot(way))
}

#[inline(always)]
fn middle<L: EightLanes>([a, b, c]: [Vec3<L>; 3]) -> Vec3<L> {
    (a + b + c) * L::all(1.0 / 3.0)
}

/// Returns a vector everywhere.
#[inline(always)]
pub(super) fn all_of<L: EightLanes>(v: [f32; 3]) -> Vec3<L> {
    Vec3::new(L::all(v[0]), L::all(v[1]), L::all(v[2]))
}

/// Returns the point of a box around the origin that is nearest to a point.
#[inline(always)]
fn clamped<L: EightLanes>(v: Vec3<L>, half: Vec3<L>) -> Vec3<L> {
    Vec3::new(
        v.x.most(-half.x).least(half.x),
        v.y.most(-half.y).least(half.y),
        v.z.most(-half.z).least(half.z),
    )
}

/// Returns the distance of triangles from a box around the origin by half its size, or less, at least 0.
#[inline(always)]
pub(super) fn gap_of_box<L: EightLanes>(face: [Vec3<L>; 3], half: [f32; 3]) -> L {
    let half = all_of::<L>(half);
    let mut gap = L::all(0.0);
    let mut own = clamped(middle(face), half);
    for _ in 0..ROUNDS {
        let other = closest(face, own);
        own = clamped(other, half);
        let way = other - own;
        let reach =
            way.x.magnitude() * half.x + way.y.magnitude() * half.y + way.z.magnitude() * half.z;
        let between = lowest(face, way) - reach;
        gap = gap.most(between / square(way).root());
    }
    gap
}

/// Returns the distance of triangles from others, or less, at least 0.
#[inline(always)]
pub(super) fn gap_of_faces<L: EightLanes>(face: [Vec3<L>; 3], facing: [Vec3<L>; 3]) -> L {
    let mut gap = L::all(0.0);
    let mut own = middle(facing);
    for _ in 0..ROUNDS {
        let other = closest(face, own);
        own = closest(facing, other);
        let way = other - own;
        let between = lowest(face, way) + lowest(facing, -way);
        gap = gap.most(between / square(way).root());
    }
    gap
}
