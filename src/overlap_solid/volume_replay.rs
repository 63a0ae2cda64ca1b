//! The volume that two bodies share, from the decisions of a search: straight lines.
//!
//! The value is the sum of tetrahedra over the surface. Its derivatives are those of Reynolds' theorem: a move of a
//! corner moves the triangles around it, each point by its share of the corner, and the volume grows by the move's
//! height over the surface, summed over the part of a triangle that is surface of the intersection. No point at which
//! an edge crosses a face is differentiated for them, so that nearly parallel faces lose no digits.
use super::cutting_planes::{Other, Plane, between};
use super::volume_search::{Decisions, Piece};
use crate::distance::edge::scale_of;
use crate::scalar::{largest, power_of_largest};
use crate::{Scalar, Vec3};
use std::any::TypeId;

/// Volumes in cubed units of length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedVolume<S> {
    /// The volume that both share.
    pub shared: S,
    /// The volume of the first body.
    pub first: S,
    /// The volume of the second body; zero for a half-space.
    pub second: S,
}

/// Returns `true` for numbers without derivatives.
fn is_plain<S: Scalar>() -> bool {
    let number = TypeId::of::<S>();
    number == TypeId::of::<f32>() || number == TypeId::of::<f64>()
}

/// Returns the planes that cut.
pub(super) fn planes_of<S: Scalar>(found: &Decisions, other: Other<'_, S>) -> Vec<Plane<S>> {
    let mut planes: Vec<Plane<S>> = Vec::with_capacity(found.planes.len());
    for &plane in &found.planes {
        planes.push(Plane::of(plane, other, &planes));
    }
    planes
}

/// Returns the corners of the body that is cut and the points that cuts make.
pub(super) fn points_of<S: Scalar>(
    found: &Decisions,
    corners: &[Vec3<S>],
    planes: &[Plane<S>],
) -> Vec<Vec3<S>> {
    let mut points = corners.to_vec();
    for &[i, j, plane] in &found.points {
        let plane = planes[plane];
        let (p, q) = (points[i], points[j]);
        points.push(between([p, q], [plane.height(p), plane.height(q)]));
    }
    points
}

/// Returns six times the volume under some triangles, seen from a point.
fn six_volumes<S: Scalar>(points: &[Vec3<S>], triangles: &[[usize; 3]]) -> S {
    let Some(&[first, _, _]) = triangles.first() else {
        return S::zero();
    };
    let from = points[first];
    let of = |corners: &[usize; 3]| {
        let [a, b, c] = corners.map(|k| points[k] - from);
        a.dot((b - a).cross(c - a))
    };
    triangles
        .iter()
        .fold(S::zero(), |sum, corners| sum + of(corners))
}

/// The derivatives of a volume.
struct Slopes<S> {
    /// By the corners of the body that is cut, and of the other one.
    corners: [Vec<Vec3<S>>; 2],
    /// By the normal and the offset of a half-space.
    plane: (Vec3<S>, S),
}

impl<S: Scalar> Slopes<S> {
    /// Adds those by the corners of the triangle in which a piece lies.
    fn add(
        &mut self,
        piece: &Piece,
        points: &[Vec3<S>],
        (corners, other): (&[Vec3<S>], Other<'_, S>),
        share: S,
    ) {
        let ring = &piece.ring;
        let from = points[ring[0]];
        let parts = ring[1..].windows(2).map(|pair| {
            let (q, r) = (points[pair[0]], points[pair[1]]);
            let third = S::lit(1.0 / 3.0);
            let middle = (q - from + (r - from)) * third + from;
            ((q - from).cross(r - from) * (share * S::lit(0.5)), middle)
        });
        match (piece.on, piece.of_other, other) {
            (Some(on), false, _) => self.share_out(0, on, corners, parts),
            (Some(on), true, Other::Corners(corners)) => self.share_out(1, on, corners, parts),
            (_, _, Other::HalfSpace(normal, _)) => {
                let long = normal.length();
                for (area, middle) in parts {
                    let along = area.dot(normal).over(long);
                    let by_offset = along.over(long);
                    self.plane.1 += by_offset;
                    self.plane.0 -= middle * by_offset;
                }
            }
            (None, _, Other::Corners(_)) => {}
        }
    }
    /// Adds those by the corners of one triangle, for parts of it given by their areas as vectors and their middles.
    fn share_out(
        &mut self,
        body: usize,
        on: [usize; 3],
        corners: &[Vec3<S>],
        parts: impl Iterator<Item = (Vec3<S>, Vec3<S>)>,
    ) {
        let [a, b, c] = on.map(|k| corners[k]);
        let (u, v) = (b - a, c - a);
        let unit = scale_of::<S>(largest([u.x, u.y, u.z, v.x, v.y, v.z]));
        let long = (u * unit).cross(v * unit);
        let square = long.length_squared();
        let none = square.at_most(S::lit(power_of_largest::<S>(-0.4)));
        let over = S::one().over(S::select(none, S::one(), square));
        for (area, middle) in parts {
            let along = area.dot(long) * over;
            let share = |from: Vec3<S>, to: Vec3<S>| {
                let way = (to - from) * unit;
                long.dot(way.cross((middle - from) * unit)) * over
            };
            let (second, third) = (share(c, a), share(a, b));
            let flat = S::lit(1.0 / 3.0);
            let (second, third) = (S::select(none, flat, second), S::select(none, flat, third));
            let by = long * along;
            let slopes = &mut self.corners[body];
            for (k, share) in on
                .into_iter()
                .zip([S::one() - second - third, second, third])
            {
                slopes[k] += by * share;
            }
        }
    }
}

/// Returns a change by the derivatives of it: zero as a value, with first and second derivatives.
fn moved<S: Scalar>(slope: S, x: S) -> S {
    let mean = (slope + S::from_primal(slope.primal())).halved();
    mean * x.with_primal(S::Primal::zero())
}

fn moved_point<S: Scalar>(slope: Vec3<S>, p: Vec3<S>) -> S {
    moved(slope.x, p.x) + moved(slope.y, p.y) + moved(slope.z, p.z)
}

/// Returns the volumes of two bodies and of their intersection, from decisions.
pub(super) fn replay<S: Scalar>(
    a: &[Vec3<S>],
    b: Other<'_, S>,
    found: &Decisions,
) -> SharedVolume<S> {
    let (cut, other) = match (found.exchanged, b) {
        (true, Other::Corners(b)) => (b, Other::Corners(a)),
        _ => (a, b),
    };
    let sixth = S::lit(1.0 / 6.0);
    let own = six_volumes(cut, &found.triangles[0]) * sixth;
    let others = match other {
        Other::Corners(points) => six_volumes(points, &found.triangles[1]) * sixth,
        Other::HalfSpace(..) => S::zero(),
    };
    let shared = match found.same {
        true => own.halved() + others.halved(),
        false => shared_volume(cut, other, found),
    };
    let limit = match other {
        Other::Corners(_) => own.primal().least(others.primal()),
        Other::HalfSpace(..) => own.primal(),
    };
    let beyond = shared.above(S::from_primal(limit));
    let shared = S::select(beyond, shared.with_primal(limit), shared);
    let none = shared.at_most(S::zero());
    let shared = S::select(none, S::zero(), shared);
    let (first, second) = match found.exchanged {
        true => (others, own),
        false => (own, others),
    };
    SharedVolume {
        shared,
        first,
        second,
    }
}

fn shared_volume<S: Scalar>(cut: &[Vec3<S>], other: Other<'_, S>, found: &Decisions) -> S {
    let planes = planes_of(found, other);
    let points = points_of(found, cut, &planes);
    let Some(first) = found.pieces.first() else {
        return S::zero();
    };
    let from = points[first.ring[0]];
    let mut six = S::Primal::zero();
    let plain = |p: Vec3<S>| Vec3::new(p.x.primal(), p.y.primal(), p.z.primal());
    for piece in &found.pieces {
        let a = plain(points[piece.ring[0]] - from);
        for pair in piece.ring[1..].windows(2) {
            let [b, c] = [plain(points[pair[0]] - from), plain(points[pair[1]] - from)];
            six += a.dot((b - a).cross(c - a));
        }
    }
    let share = S::lit(if found.twice { 0.5 } else { 1.0 });
    let volume = S::from_primal(six) * (share * S::lit(1.0 / 6.0));
    if is_plain::<S>() {
        return volume;
    }
    let count = match other {
        Other::Corners(points) => points.len(),
        Other::HalfSpace(..) => 0,
    };
    let mut slopes = Slopes {
        corners: [cut.len(), count].map(|count| vec![Vec3::zero(); count]),
        plane: (Vec3::zero(), S::zero()),
    };
    for piece in &found.pieces {
        slopes.add(piece, &points, (cut, other), share);
    }
    let mut sum = volume;
    for (&slope, &p) in slopes.corners[0].iter().zip(cut) {
        sum += moved_point(slope, p);
    }
    match other {
        Other::Corners(points) => {
            for (&slope, &p) in slopes.corners[1].iter().zip(points) {
                sum += moved_point(slope, p);
            }
        }
        Other::HalfSpace(normal, offset) => {
            sum += moved_point(slopes.plane.0, normal) + moved(slopes.plane.1, offset);
        }
    }
    sum
}
