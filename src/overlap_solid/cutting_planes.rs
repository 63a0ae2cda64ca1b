//! The planes that bound a body, and the triangles of its surface.
use crate::Vec3;
use crate::distance3::hulls::spanning;
use crate::hull3::Surface;
use crate::scalar::largest;
use crate::twofold;
use std::collections::HashMap;

/// The part of a rounding of the size by which faces of one plane deviate from it: corners of rotated boxes do by
/// about one.
const NOISE: f64 = 4.0;

/// A plane by three corners of a body, or across a face along an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CutPlane {
    /// Through three corners, counter-clockwise seen from outside.
    Face([usize; 3]),
    /// Orthogonal to the face of another plane, through two corners; it keeps the left side of the way from the first
    /// to the second.
    Across([usize; 2], usize),
    /// The border of a half-space.
    HalfSpace,
}

/// A plane as numbers: points p with `normal · (p − at) > 0` are outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneNumbers {
    pub normal: Vec3<f64>,
    pub at: Vec3<f64>,
}

impl PlaneNumbers {
    /// Returns the plane through three corners; `None` for those on a line. The normal has length one.
    pub fn through(points: &[Vec3<f64>], corners: [usize; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|k| points[k]);
        let normal = unit(across([a, b], [a, c]))?;
        Some(PlaneNumbers { normal, at: a })
    }
    /// Returns the height of a point over the plane.
    pub fn height(&self, point: Vec3<f64>) -> f64 {
        self.normal.dot(point - self.at)
    }
}

/// Returns a vector of length one along another; `None` for zero.
pub(super) fn unit(v: Vec3<f64>) -> Option<Vec3<f64>> {
    let size = largest([v.x, v.y, v.z]);
    (size > 0.0).then(|| {
        let v = v * (1.0 / size);
        v * (1.0 / v.length())
    })
}

/// Returns the cross product of two vectors between points, from exact differences.
fn across([a, b]: [Vec3<f64>; 2], [c, d]: [Vec3<f64>; 2]) -> Vec3<f64> {
    let way = |from, to| twofold::way(twofold::deep(from), twofold::deep(to), 1.0);
    let [x, y, z] = twofold::cross(way(a, b), way(c, d));
    Vec3::new(x, y, z)
}

/// The surface of a body with a volume.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds {
    /// The triangles of its surface, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// Its planes, each with the triangles in it.
    pub planes: Vec<([usize; 3], Vec<usize>)>,
    /// The triangles that the neighbours across the edges from each corner to the next are, where these are in the
    /// same plane.
    pub inner: Vec<[bool; 3]>,
}

impl Bounds {
    /// Returns the surface of the hull of points; `None` where all are in one plane. Faces that are in one plane but for
    /// four roundings of the size, `epsilon` each, have one plane.
    pub fn of(points: &[Vec3<f64>], epsilon: f64) -> Option<Self> {
        let surface = Surface::of(points);
        if surface.dimension < 3 {
            return None;
        }
        let mut triangles = Vec::new();
        for ring in surface.facets() {
            for pair in ring[1..].windows(2) {
                triangles.push([ring[0], pair[0], pair[1]]);
            }
        }
        let size = surface
            .corners
            .iter()
            .map(|&k| points[k] - points[surface.corners[0]])
            .fold(0.0_f64, |most, v| most.max(largest([v.x, v.y, v.z])));
        let mut beside: HashMap<[usize; 2], usize> = HashMap::new();
        for (k, corners) in triangles.iter().enumerate() {
            for edge in 0..3 {
                beside.insert([corners[edge], corners[(edge + 1) % 3]], k);
            }
        }
        let neighbour = |corners: [usize; 3], edge: usize| {
            beside
                .get(&[corners[(edge + 1) % 3], corners[edge]])
                .copied()
        };
        let area = |&[a, b, c]: &[usize; 3]| {
            (points[b] - points[a])
                .cross(points[c] - points[a])
                .length_squared()
        };
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        order.sort_by(|&i, &j| area(&triangles[j]).total_cmp(&area(&triangles[i])));
        let mut owner = vec![usize::MAX; triangles.len()];
        let mut planes: Vec<([usize; 3], Vec<usize>)> = Vec::new();
        for first in order {
            if owner[first] != usize::MAX {
                continue;
            }
            let own = planes.len();
            let Some(plane) = PlaneNumbers::through(points, triangles[first]) else {
                continue;
            };
            let in_plane = |k: usize| plane.height(points[k]).abs() <= NOISE * epsilon * size;
            if surface.corners.iter().all(|&k| in_plane(k)) {
                return None;
            }
            owner[first] = own;
            let (mut group, mut read) = (vec![first], 0);
            while read < group.len() {
                let corners = triangles[group[read]];
                read += 1;
                for edge in 0..3 {
                    let Some(there) = neighbour(corners, edge) else {
                        continue;
                    };
                    if owner[there] == usize::MAX && triangles[there].into_iter().all(in_plane) {
                        owner[there] = own;
                        group.push(there);
                    }
                }
            }
            let mut corners: Vec<usize> = group.iter().flat_map(|&k| triangles[k]).collect();
            corners.sort_unstable();
            corners.dedup();
            planes.push((spanning(points, &corners, plane.normal), group));
        }
        let inner = triangles
            .iter()
            .enumerate()
            .map(|(k, &corners)| {
                [0, 1, 2].map(|edge| {
                    neighbour(corners, edge).is_some_and(|there| owner[there] == owner[k])
                })
            })
            .collect();
        Some(Bounds {
            triangles,
            planes,
            inner,
        })
    }
}
