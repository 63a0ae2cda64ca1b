//! The record of a search for contact points, and its replay.
use super::contact_points::{ContactPoint3, Contacts3, MOST};
use super::facing::{Patch, PatchName, across};
use super::relation::Relation;
use crate::arrays::Each;
use crate::{Scalar, Vec3};

/// How a contact point is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactOrigin {
    /// The nearest points.
    Nearest,
    /// A corner of the face of a, by its number, over that of b.
    CornerOfA(u8),
    /// A corner of the face of b over that of a.
    CornerOfB(u8),
    /// The crossing of two sides, by the numbers of their first corners.
    Crossing(u8, u8),
}

/// The decisions of a search for contact points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ContactRecord {
    /// The faces that face each other.
    pub faces: [PatchName; 2],
    /// The points; the first `count` matter. Shapes without a contact have none.
    pub points: [ContactOrigin; MOST],
    /// Their number.
    pub count: u8,
    /// The number of the axis across which directions across the normal begin.
    pub helper: u8,
}

/// A corner or a point of an edge, with its place.
#[derive(Clone, Copy)]
pub struct Corner<S> {
    /// The point.
    pub point: Vec3<S>,
    /// Its coordinates across the normal.
    pub at: [S; 2],
}

/// The plane across a normal.
pub struct Across<S> {
    /// Two directions across the normal.
    pub ways: [Vec3<S>; 2],
    /// The point to which places are relative.
    pub origin: Vec3<S>,
}

impl<S: Scalar> Across<S> {
    /// Returns the plane of a relation's normal.
    pub fn new(relation: &Relation<S>, helper: u8) -> Self {
        Across {
            ways: across(relation.normal, helper),
            origin: relation.on_a,
        }
    }
    /// Returns a point with its place.
    pub fn place(&self, point: Vec3<S>) -> Corner<S> {
        let arm = point - self.origin;
        let at = [self.ways[0].dot(arm), self.ways[1].dot(arm)];
        Corner { point, at }
    }
    /// Returns the corners of a face with their places.
    pub fn corners(&self, patch: &Patch<S>) -> Vec<Corner<S>> {
        match patch {
            Patch::Face { corners, count } => {
                corners[..*count].iter().map(|&p| self.place(p)).collect()
            }
            Patch::Spot | Patch::Plane => Vec::new(),
        }
    }
}

/// Returns twice the area of a triangle in the plane, by the places of its corners.
pub fn turn<S: Scalar>(a: [S; 2], b: [S; 2], c: [S; 2]) -> S {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns a side of a face by the number of its first corner.
pub fn side<S>(face: &[Corner<S>], k: usize) -> [&Corner<S>; 2] {
    [&face[k], &face[(k + 1) % face.len()]]
}

/// Returns the share of a segment's length at which a corner is beside it, and the square of the length, seen along the
/// normal.
pub fn share_beside<S: Scalar>(corner: &Corner<S>, [start, end]: [&Corner<S>; 2]) -> (S, S) {
    let way = [end.at[0] - start.at[0], end.at[1] - start.at[1]];
    let arm = [corner.at[0] - start.at[0], corner.at[1] - start.at[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    (divided(way[0] * arm[0] + way[1] * arm[1], square), square)
}

/// Returns a quotient, or the dividend where the divisor is zero: a record says what is computed, whatever the input.
fn divided<S: Scalar>(dividend: S, divisor: S) -> S {
    let none = divisor.equals(S::zero());
    dividend.over(S::select(none, S::one(), divisor))
}

/// Returns the gap along a direction from a corner to the plane of a face, or to the point of a segment beside it.
pub fn height<S: Scalar>(normal: Vec3<S>, corner: &Corner<S>, face: &[Corner<S>]) -> S {
    match face {
        [start, end] => {
            let (share, _) = share_beside(corner, [start, end]);
            normal.dot(start.point + (end.point - start.point) * share - corner.point)
        }
        [first, second, third, ..] => {
            let plane = (second.point - first.point).cross(third.point - first.point);
            divided(plane.dot(first.point - corner.point), plane.dot(normal))
        }
        _ => S::zero(),
    }
}

/// Returns the points of two sides that cross, seen along the normal.
pub fn crossing<S: Scalar>([p, q]: [&Corner<S>; 2], [r, s]: [&Corner<S>; 2]) -> [Vec3<S>; 2] {
    let share = |p: &Corner<S>, q: &Corner<S>, r: &Corner<S>, s: &Corner<S>| {
        let [at_r, at_s] = [turn(p.at, q.at, r.at), turn(p.at, q.at, s.at)];
        divided(at_r, at_r - at_s)
    };
    let (t, u) = (share(p, q, r, s), share(r, s, p, q));
    [
        p.point + (q.point - p.point) * u,
        r.point + (s.point - r.point) * t,
    ]
}

/// Two faces with the places of their corners.
pub struct Facing<S> {
    /// The plane across the normal.
    pub across: Across<S>,
    /// The corners of both.
    pub corners: [Vec<Corner<S>>; 2],
    /// `true` for the plane of a half-space.
    pub planes: [bool; 2],
}

impl<S: Scalar> Facing<S> {
    /// Returns two faces, given the relation of the shapes.
    pub fn new(relation: &Relation<S>, faces: &[Patch<S>; 2], helper: u8) -> Self {
        let across = Across::new(relation, helper);
        let corners = [across.corners(&faces[0]), across.corners(&faces[1])];
        let planes = [0, 1].each_as(|k: usize| matches!(faces[k], Patch::Plane));
        Facing {
            across,
            corners,
            planes,
        }
    }
    /// Returns the point on a of a contact point, and its gap.
    pub fn point(&self, relation: &Relation<S>, origin: ContactOrigin) -> (Vec3<S>, S) {
        let (normal, [a, b]) = (relation.normal, &self.corners);
        match origin {
            ContactOrigin::Nearest => (relation.on_a, relation.apart),
            ContactOrigin::CornerOfA(k) => {
                let corner = &a[usize::from(k)];
                let gap = match self.planes[1] {
                    true => relation.apart + normal.dot(relation.on_a - corner.point),
                    false => height(normal, corner, b),
                };
                (corner.point, gap)
            }
            ContactOrigin::CornerOfB(k) => {
                let corner = &b[usize::from(k)];
                let gap = match self.planes[0] {
                    true => relation.apart + normal.dot(corner.point - relation.on_b),
                    false => -height(normal, corner, a),
                };
                (corner.point - normal * gap, gap)
            }
            ContactOrigin::Crossing(i, j) => {
                let [on_a, on_b] = crossing(side(a, usize::from(i)), side(b, usize::from(j)));
                (on_a, normal.dot(on_b - on_a))
            }
        }
    }
}

impl ContactRecord {
    /// Returns the record of shapes without a contact.
    pub fn none(faces: [PatchName; 2]) -> Self {
        ContactRecord {
            faces,
            points: [ContactOrigin::Nearest; MOST],
            count: 0,
            helper: 0,
        }
    }
    /// Returns the points, given the relation of the shapes and their faces.
    pub fn replay<S: Scalar>(&self, relation: &Relation<S>, faces: [Patch<S>; 2]) -> Contacts3<S> {
        let empty = ContactPoint3 {
            on_a: Vec3::zero(),
            on_b: Vec3::zero(),
            gap: S::zero(),
        };
        let mut contacts = Contacts3 {
            normal: Vec3::zero(),
            count: S::lit(f64::from(self.count)),
            points: [empty; MOST],
        };
        if self.count == 0 {
            return contacts;
        }
        contacts.normal = relation.normal.canonical();
        let facing = Facing::new(relation, &faces, self.helper);
        let named = &self.points[..usize::from(self.count)];
        for (place, &origin) in contacts.points.iter_mut().zip(named) {
            let (on_a, gap) = facing.point(relation, origin);
            let on_b = match origin {
                ContactOrigin::Nearest => relation.on_b,
                _ => on_a + relation.normal * gap,
            };
            *place = ContactPoint3 {
                on_a: on_a.canonical(),
                on_b: on_b.canonical(),
                gap: gap.saturated().canonical(),
            };
        }
        contacts
    }
}
