//! The planes that bound a body, and the triangles of its surface.
use crate::distance::edge::scale_of;
use crate::distance3::hulls::spanning;
use crate::hull3::Surface;
use crate::scalar::largest;
use crate::{Scalar, Vec3, twofold};
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

/// The second of two bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Other<'a, S> {
    /// The corners of a body.
    Corners(&'a [Vec3<S>]),
    /// The half-space behind a plane: its normal and offset.
    HalfSpace(Vec3<S>, S),
}

/// A plane that cuts: points p with `normal · (p − at) > 0` are outside. The normal has any length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<S> {
    pub normal: Vec3<S>,
    at: Vec3<S>,
}

impl<S: Scalar> Plane<S> {
    /// Returns the plane through three corners, counter-clockwise seen from outside.
    fn through(points: &[Vec3<S>], corners: [usize; 3]) -> Self {
        Plane {
            normal: normal_of(corners.map(|k| points[k])),
            at: points[corners[0]],
        }
    }
    /// Returns a plane behind others.
    pub fn of(plane: CutPlane, other: Other<'_, S>, planes: &[Self]) -> Self {
        match (plane, other) {
            (CutPlane::Face(corners), Other::Corners(points)) => Self::through(points, corners),
            (CutPlane::Across([from, to], face), Other::Corners(points)) => {
                let along = points[to] - points[from];
                let along = along * scale_of::<S>(largest([along.x, along.y, along.z]));
                Plane {
                    normal: along.cross(planes[face].normal),
                    at: points[from],
                }
            }
            (_, Other::HalfSpace(normal, offset)) => {
                let scale = scale_of::<S>(largest([normal.x, normal.y, normal.z]));
                let normal = normal * scale;
                let share = (offset * scale).over(normal.length_squared());
                Plane {
                    normal,
                    at: normal * share,
                }
            }
            (CutPlane::HalfSpace, Other::Corners(points)) => Plane {
                normal: Vec3::zero(),
                at: points[0],
            },
        }
    }
    /// Returns the height of a point over the plane, times the length of the normal.
    pub fn height(&self, point: Vec3<S>) -> S {
        self.normal.dot(point - self.at)
    }
}

/// Returns the point between two others at which a height is zero.
pub(super) fn between<S: Scalar>([p, q]: [Vec3<S>; 2], [here, there]: [S; 2]) -> Vec3<S> {
    let (zero, one, fall) = (S::zero(), S::one(), here - there);
    let level = fall.equals(zero);
    let share = here.over(S::select(level, one, fall));
    let share = S::select(share.below(zero) | level, zero, share);
    let share = S::select(one.below(share), one, share);
    p + (q - p) * share
}

/// Returns the normal of a triangle, of any length: its value from exact differences, so that a thin triangle's has all
/// digits.
fn normal_of<S: Scalar>([a, b, c]: [Vec3<S>; 3]) -> Vec3<S> {
    let (u, v) = (b - a, c - a);
    let scale = |v: Vec3<S>| scale_of::<S>(largest([v.x, v.y, v.z]));
    let (unit_u, unit_v) = (scale(u), scale(v));
    let slopes = (u * unit_u).cross(v * unit_v);
    let way = |from: Vec3<S>, to: Vec3<S>, unit: S| {
        twofold::way(twofold::deep(from), twofold::deep(to), unit.primal())
    };
    let [x, y, z] = twofold::cross(way(a, b, unit_u), way(a, c, unit_v));
    Vec3::new(
        slopes.x.with_primal(x),
        slopes.y.with_primal(y),
        slopes.z.with_primal(z),
    )
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
            let plane = Plane::through(points, triangles[first]);
            let limit = NOISE * epsilon * size * plane.normal.length();
            let in_plane = |k: usize| plane.height(points[k]).abs() <= limit;
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
            planes.push((spanning(|k| points[k], &corners, plane.normal), group));
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
