//! The nearest feature of one triangle to a point, in double precision: the decision of searches.
//!
//! No closures: batches compile it for the vectors of the processor, and closures would stay behind.
use crate::Vec3;
use crate::twofold::{cross, deep, way};

/// The part of a triangle that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaceFeature {
    /// The interior.
    Interior,
    /// An edge, by two corners of the face (0, 1 or 2). The first one is at the lower place, by x, then y, then z, so
    /// that both faces of an edge compute the same point.
    Edge {
        /// The corner at the lower place.
        from: u8,
        /// The other one.
        to: u8,
    },
    /// A corner of the face: 0, 1 or 2.
    Vertex {
        /// The corner.
        corner: u8,
    },
}

/// The record of a search for the nearest point of a mesh: a face and its feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FaceRecord {
    /// The face, from zero.
    pub face: u32,
    /// The feature of the face.
    pub feature: FaceFeature,
}

impl FaceRecord {
    /// The record of queries that are not finite.
    pub(crate) const NONE: FaceRecord = FaceRecord {
        face: 0,
        feature: FaceFeature::Interior,
    };
}

/// The sine of a triangle's smallest angle, squared, below which its normal is computed with twice the digits.
pub const THIN: f64 = 1e-6;

/// Returns the triangle's normal, of twice its area, to some roundings; zero for a triangle without area.
#[inline(always)]
pub fn normal([a, b, c]: [Vec3<f64>; 3]) -> Vec3<f64> {
    let (ab, ac) = (b - a, c - a);
    let plain = ab.cross(ac);
    let (x, y, z) = (
        ab.length_squared(),
        ac.length_squared(),
        (c - b).length_squared(),
    );
    // The product of the two longest edges, times the shortest one's square.
    if plain.length_squared() * x.min(y).min(z) > THIN * (x * y * z) {
        return plain;
    }
    thin_normal(a, b, c)
}

/// Returns the normal with twice the digits. Out of line, so that searches keep their registers.
#[cold]
#[inline(never)]
fn thin_normal(a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>) -> Vec3<f64> {
    let [a, b, c] = [a, b, c].map(deep);
    let [x, y, z] = cross(way(a, b, 1.0), way(a, c, 1.0));
    Vec3::new(x, y, z)
}

/// Returns `true` if a corner is at a lower place than another one: by x, then y, then z.
#[inline(always)]
fn is_lower(a: Vec3<f64>, b: Vec3<f64>) -> bool {
    (a.x, a.y, a.z) < (b.x, b.y, b.z)
}

/// Returns the squared distance of a point from a triangle, and the nearest feature.
///
/// Edges and corners have the same bits in every triangle that has them. Overestimates are within some roundings of the
/// sizes, for triangles of any form: the interior counts only where the point projects into it.
#[inline(always)]
pub fn nearest_feature(point: Vec3<f64>, triangle: [Vec3<f64>; 3]) -> (f64, FaceFeature) {
    let [a, b, c] = triangle;
    let corners = [a - point, b - point, c - point];
    // Of the triangle and not of the offsets, which lose the digits of edges far away: replays have the edges in full.
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let n = normal(triangle);
    // Twice the areas of the triangles of the projected point and each edge, times the normal's length.
    let sides = [
        ab.cross(corners[0]).dot(n),
        bc.cross(corners[1]).dot(n),
        ca.cross(corners[2]).dot(n),
    ];
    let square = n.length_squared();
    let is_over = (sides[0] < 0.0) & (sides[1] < 0.0) & (sides[2] < 0.0);
    if square > 0.0 && is_over {
        let height = n.dot(corners[0]);
        return (height * height / square, FaceFeature::Interior);
    }
    let mut best = (f64::INFINITY, FaceFeature::Vertex { corner: 0 });
    for (i, j) in [(0_u8, 1_u8), (1, 2), (2, 0)] {
        let (p, q) = (triangle[usize::from(i)], triangle[usize::from(j)]);
        let (from, to) = if is_lower(q, p) { (j, i) } else { (i, j) };
        let (start, end) = (triangle[usize::from(from)], triangle[usize::from(to)]);
        let found = nearest_of_edge(corners, end - start, from, to);
        if found.0 < best.0 {
            best = found;
        }
    }
    best
}

/// Returns the squared distance of the origin from an edge, and the nearest feature.
#[inline(always)]
fn nearest_of_edge(
    corners: [Vec3<f64>; 3],
    edge: Vec3<f64>,
    from: u8,
    to: u8,
) -> (f64, FaceFeature) {
    let (start, end) = (corners[usize::from(from)], corners[usize::from(to)]);
    let along = -start.dot(edge);
    if along <= 0.0 {
        return (start.length_squared(), FaceFeature::Vertex { corner: from });
    }
    let square = edge.length_squared();
    if along >= square {
        return (end.length_squared(), FaceFeature::Vertex { corner: to });
    }
    let nearest = start + edge * (along / square);
    (nearest.length_squared(), FaceFeature::Edge { from, to })
}
