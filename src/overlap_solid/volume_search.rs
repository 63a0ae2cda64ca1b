//! The search for the volume that two bodies share: it cuts one of them by the planes of the other.
use super::cutting_planes::{Bounds, CutPlane, Other, Plane};
use super::solid_cut::{CutFace, CutPoint, CutPoints, FaceOwner, cut, cut_ring};
use crate::Vec3;
use crate::scalar::largest;

/// A part of the surface of an intersection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    /// The triangle in which it lies: its corners, of the body that is cut or of the other one.
    pub on: Option<[usize; 3]>,
    /// `true` if the triangle is the other body's.
    pub of_other: bool,
    /// Its corners, counter-clockwise seen from outside.
    pub ring: Vec<usize>,
}

/// The decisions that a record holds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Decisions {
    /// `true` if the second body is cut by the first.
    pub exchanged: bool,
    /// `true` for bodies with equal corners.
    pub same: bool,
    /// `true` if there are two descriptions of the surface, of which points of both bodies' faces belong to the one's
    /// and to the other's.
    pub twice: bool,
    /// The number of corners of the body that is cut.
    pub corners: usize,
    /// The triangles of the surface of the body that is cut, and of the other one.
    pub triangles: [Vec<[usize; 3]>; 2],
    /// The planes that cut.
    pub planes: Vec<CutPlane>,
    /// The points behind the corners.
    pub points: Vec<CutPoint>,
    /// The surface of the intersection; empty where nothing is shared.
    pub pieces: Vec<Piece>,
    /// The number of pieces of the first description, if there are two.
    pub first: usize,
}

impl Decisions {
    /// Returns `true` if the body that is cut has a volume.
    pub fn has_volume(&self) -> bool {
        !self.triangles[0].is_empty()
    }
    /// Leaves out the second description of the surface.
    pub fn leave_second(&mut self) {
        self.pieces.truncate(self.first);
        self.twice = false;
        self.keep_used();
    }
    /// Keeps the points that the pieces need, and numbers them anew.
    fn keep_used(&mut self) {
        let corners = self.corners;
        let mut used = vec![false; corners + self.points.len()];
        for &k in self.pieces.iter().flat_map(|piece| &piece.ring) {
            used[k] = true;
        }
        // The ends have lower numbers than a point between them.
        for (k, &[i, j, _]) in self.points.iter().enumerate().rev() {
            if used[corners + k] {
                (used[i], used[j]) = (true, true);
            }
        }
        let mut names: Vec<usize> = (0..corners).collect();
        let mut next = corners;
        for &used in &used[corners..] {
            names.push(next);
            next += usize::from(used);
        }
        let all = std::mem::take(&mut self.points);
        for (k, [i, j, plane]) in all.into_iter().enumerate() {
            if used[corners + k] {
                self.points.push([names[i], names[j], plane]);
            }
        }
        for name in self.pieces.iter_mut().flat_map(|piece| &mut piece.ring) {
            *name = names[*name];
        }
    }
}

/// Returns the largest distance of corners from the first along an axis.
fn extent(points: &[Vec3<f64>]) -> f64 {
    let arm = |&p: &Vec3<f64>| p - points[0];
    let size = |v: Vec3<f64>| largest([v.x, v.y, v.z]);
    points.iter().map(|p| size(arm(p))).fold(0.0, f64::max)
}

/// Returns the decisions for the volume that a body shares with another one. Corners within two roundings of the size,
/// `epsilon` each, of a plane of the other lie in it.
pub(super) fn search(a: &[Vec3<f64>], b: Other<'_, f64>, epsilon: f64) -> Decisions {
    let mut found = Decisions::default();
    let bounds_a = Bounds::of(a, epsilon);
    match b {
        Other::HalfSpace(..) => {
            let Some(bounds) = bounds_a else {
                return found;
            };
            found.triangles[0] = bounds.triangles.clone();
            found.planes.push(CutPlane::HalfSpace);
            let plane = Plane::of(CutPlane::HalfSpace, b, &[]);
            intersect(&mut found, (a, &bounds), (&[plane], None), epsilon);
        }
        Other::Corners(corners) => {
            let bounds_b = Bounds::of(corners, epsilon);
            found.exchanged = extent(corners) < extent(a);
            let all = [bounds_a, bounds_b];
            let [bounds_a, bounds_b] = match found.exchanged {
                false => all,
                true => {
                    let [a, b] = all;
                    [b, a]
                }
            };
            let (cut, by) = match found.exchanged {
                true => (corners, a),
                false => (a, corners),
            };
            for (triangles, bounds) in found.triangles.iter_mut().zip([&bounds_a, &bounds_b]) {
                if let Some(bounds) = bounds {
                    *triangles = bounds.triangles.clone();
                }
            }
            let (Some(bounds_a), Some(bounds_b)) = (bounds_a, bounds_b) else {
                return found;
            };
            found.same = a == corners;
            if found.same {
                return found;
            }
            let mut planes = Vec::new();
            for &(corners, _) in &bounds_b.planes {
                let plane = CutPlane::Face(corners);
                found.planes.push(plane);
                planes.push(Plane::of(plane, Other::Corners(by), &planes));
            }
            intersect(
                &mut found,
                (cut, &bounds_a),
                (&planes, Some((by, &bounds_b))),
                epsilon,
            );
        }
    }
    found
}

/// Cuts a body by planes, faces of another body if that is given.
fn intersect(
    found: &mut Decisions,
    (a, bounds): (&[Vec3<f64>], &Bounds),
    (planes, by): (&[Plane<f64>], Option<(&[Vec3<f64>], &Bounds)>),
    epsilon: f64,
) {
    let mut points = CutPoints::of(a);
    let mut planes = planes.to_vec();
    let limit = 2.0 * epsilon * extent(a);
    let (mut first, touched) = surface(&mut points, bounds, &planes, limit);
    // Points of the surface belong to either body if faces of both are in one plane.
    let mut second = Vec::new();
    if touched {
        second = surface(&mut points, bounds, &planes, -limit).0;
        // Bodies that merely touch share nothing.
        if second.is_empty() {
            first.clear();
        }
    }
    found.twice = !second.is_empty();
    let mut pieces = Vec::new();
    let faces = first.len();
    for (count, face) in first.into_iter().chain(second).enumerate() {
        if count == faces {
            found.first = pieces.len();
        }
        match (face.owner, by) {
            (FaceOwner::Triangle(k), _) => pieces.push(Piece {
                on: Some(bounds.triangles[k]),
                of_other: false,
                ring: face.ring,
            }),
            (FaceOwner::Plane(_), None) => pieces.push(Piece {
                on: None,
                of_other: true,
                ring: face.ring,
            }),
            (FaceOwner::Plane(number), Some((corners, bounds))) => {
                let mut shared = Shared {
                    found,
                    points: &mut points,
                    planes: &mut planes,
                };
                shared.among_triangles(&mut pieces, (number, &face), (corners, bounds));
            }
        }
    }
    found.corners = a.len();
    found.points = points.origins;
    found.pieces = pieces;
    found.keep_used();
}

/// Returns the surface of a body cut by planes, and whether a corner is within the limit of one.
fn surface(
    points: &mut CutPoints,
    bounds: &Bounds,
    planes: &[Plane<f64>],
    limit: f64,
) -> (Vec<CutFace>, bool) {
    let own = bounds.triangles.iter().enumerate();
    let mut faces: Vec<CutFace> = own
        .map(|(k, corners)| CutFace {
            owner: FaceOwner::Triangle(k),
            ring: corners.to_vec(),
        })
        .collect();
    let mut touched = false;
    for numbered in planes.iter().enumerate() {
        touched |= cut(points, &mut faces, numbered, limit);
        if faces.is_empty() {
            break;
        }
    }
    (faces, touched)
}

/// The intersection so far.
struct Shared<'a> {
    found: &'a mut Decisions,
    points: &'a mut CutPoints,
    planes: &'a mut Vec<Plane<f64>>,
}

impl Shared<'_> {
    /// Adds the pieces of a face that lie in each triangle of its plane.
    fn among_triangles(
        &mut self,
        pieces: &mut Vec<Piece>,
        (number, face): (usize, &CutFace),
        (corners, bounds): (&[Vec3<f64>], &Bounds),
    ) {
        let CutPlane::Face(named) = self.found.planes[number] else {
            return;
        };
        let Some((_, group)) = bounds.planes.iter().find(|(corners, _)| *corners == named) else {
            return;
        };
        for &k in group {
            let triangle = bounds.triangles[k];
            let mut ring = face.ring.clone();
            for edge in 0..3 {
                if !bounds.inner[k][edge] || ring.is_empty() {
                    continue;
                }
                let ends = [triangle[edge], triangle[(edge + 1) % 3]];
                let across = CutPlane::Across(ends, number);
                let known = self.found.planes.iter().position(|&plane| plane == across);
                let place = known.unwrap_or_else(|| {
                    self.found.planes.push(across);
                    let plane = Plane::of(across, Other::Corners(corners), self.planes);
                    self.planes.push(plane);
                    self.planes.len() - 1
                });
                let plane = self.planes[place];
                ring = cut_ring(self.points, &ring, (place, &plane));
            }
            if ring.len() > 2 {
                pieces.push(Piece {
                    on: Some(triangle),
                    of_other: true,
                    ring,
                });
            }
        }
    }
}
