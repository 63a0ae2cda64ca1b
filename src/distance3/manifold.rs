//! Contact manifolds: where two shapes of space lie on each other, in several points.
use super::apart::Apart;
use super::facing::{Patch, across};
use super::relation::Relation;
use crate::predicate::order;
use crate::scalar::most_of;
use crate::{Scalar, Vec3};

/// The largest number of points of a contact.
const MOST: usize = 8;

/// A pair of points in which two shapes touch, or all but touch.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint3<S> {
    /// The point of a.
    pub on_a: Vec3<S>,
    /// The point of b.
    pub on_b: Vec3<S>,
    /// The signed distance of the points along the normal: minus the depth.
    #[shape(number)]
    pub gap: S,
}

/// The contact of two shapes of space: a direction, and up to eight pairs of points.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contacts3<S> {
    /// The direction, of length one, in which the shapes are apart or must part, from a to b; zero without a contact.
    #[shape(direction)]
    pub normal: Vec3<S>,
    /// The number of points. A constant.
    #[shape(number)]
    pub count: S,
    /// The points, counter-clockwise as the normal is seen from its tip; zero from `count` on.
    pub points: [ContactPoint3<S>; MOST],
}

impl<S: Scalar<Mask = bool>> Contacts3<S> {
    /// Returns the points that there are.
    #[must_use]
    pub fn points(&self) -> &[ContactPoint3<S>] {
        let is = |&k: &usize| S::lit(k as f64).below(self.count);
        &self.points[..(0..MOST).take_while(is).count()]
    }
}

/// Returns where two shapes of space touch, or come within a distance of each other.
///
/// The direction is that of the shortest way between the shapes, or out of each other. Along it the faces that face each
/// other most are compared: the points are the corners of their overlap, each with its own gap, those whose gap is at
/// most `within`. Two boxes that lie on each other have four points or more, a capsule along a face two, a ball one. The
/// least gap is the signed distance. Shapes that are farther apart have no points.
///
/// Faces of segments and capsules are their axes, those of points and balls their centres, each moved by the radius along
/// the direction: points of a face that is tilted by φ lie up to r(1 − cos φ) inside.
/// Flat ends of cylinders and cones, and discs, count as regular octagons on their rims, their sides as the straight line
/// that faces the other shape most. Ellipsoids and own shapes have one point, the nearest one. Of faces of hulls with more
/// than sixteen corners sixteen count. Of more than eight points those are left out that take the least area along, but
/// never the deepest one.
///
/// Derivatives are those of points that are fixed on their features: corners, and crossings of edges seen along the
/// direction. Kinks: another face, corner or edge takes part, or a gap becomes `within`. Points closer than some
/// roundings are one, with the derivative of the first.
///
/// ```
/// use geograd::distance3::contacts;
/// use geograd::{Capsule3, Obb3, Rotation3, Sphere, Vec3};
/// let table = Obb3::new(Vec3::zero(), Vec3::new(4.0, 4.0, 1.0), Rotation3::identity());
/// let book = Obb3::new(Vec3::new(2.0, 0.0, 0.75), Vec3::new(2.0, 1.0, 0.5), Rotation3::identity());
/// let found = contacts(table, book, 0.01); // half of the book is over the edge
/// assert_eq!((found.normal, found.count), (Vec3::new(0.0, 0.0, 1.0), 4.0));
/// assert!(found.points().iter().all(|p| p.on_a.x >= 1.0 && p.on_a.x <= 2.0 && p.gap == 0.0));
/// let pen = Capsule3::new(Vec3::new(-1.0, 0.0, 0.6), Vec3::new(1.0, 0.0, 0.6), 0.1);
/// assert_eq!(contacts(table, pen, 0.01).count, 2.0);
/// assert_eq!(contacts(table, Sphere::new(Vec3::new(0.0, 0.0, 2.0), 1.0), 0.01).count, 0.0);
/// ```
#[must_use]
pub fn contacts<S: Scalar<Mask = bool>, A: Apart<B, Scalar = S>, B: Copy>(
    a: A,
    b: B,
    within: S,
) -> Contacts3<S> {
    let guard = a.guarded_with(&b).and_number(within);
    let relation = a.relation(b);
    let facing = a.facing(&b, relation.normal);
    guard.result(manifold(&relation, facing, within))
}

/// A contact point, and its place in the plane across the normal.
#[derive(Clone, Copy)]
struct Placed<S: Scalar> {
    point: ContactPoint3<S>,
    at: [S::Primal; 2],
}

/// The points so far.
struct Found<'a, S: Scalar> {
    relation: &'a Relation<S>,
    /// Two directions across the normal, and a point to which places are relative.
    across: [Vec3<S>; 2],
    origin: Vec3<S>,
    /// A distance that is mostly rounding.
    rounding: S::Primal,
    all: Vec<Placed<S>>,
}

/// A corner or a point of an edge, with its place.
#[derive(Clone, Copy)]
struct Corner<S> {
    point: Vec3<S>,
    at: [S; 2],
}

impl<S: Scalar<Mask = bool>> Found<'_, S> {
    fn place(&self, point: Vec3<S>) -> Corner<S> {
        let arm = point - self.origin;
        let at = [self.across[0].dot(arm), self.across[1].dot(arm)];
        Corner { point, at }
    }
    fn normal(&self) -> Vec3<S> {
        self.relation.normal
    }
    /// Adds a pair of points whose way is along the normal, unless one at the same place is there.
    fn add(&mut self, on_a: Vec3<S>, gap: S) {
        let at = self.place(on_a).at.map(|x| x.primal());
        let near = |other: &Placed<S>| {
            let way = [at[0] - other.at[0], at[1] - other.at[1]];
            way[0].hypot(way[1]).at_most(self.rounding)
        };
        if self.all.iter().any(near) {
            return;
        }
        let on_b = on_a + self.normal() * gap;
        let point = ContactPoint3 { on_a, on_b, gap };
        self.all.push(Placed { point, at });
    }
}

/// Returns twice the area of a triangle in the plane, by the places of its corners.
fn turn<S: Scalar>(a: [S; 2], b: [S; 2], c: [S; 2]) -> S {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns the larger magnitude of both coordinates of a place relative to another one.
fn far<S: Scalar>(a: [S; 2], b: [S; 2]) -> S {
    (a[0] - b[0]).unsigned().most((a[1] - b[1]).unsigned())
}

/// Returns the points of a contact, given the faces of both shapes.
fn manifold<S: Scalar<Mask = bool>>(
    relation: &Relation<S>,
    facing: [Patch<S>; 2],
    within: S,
) -> Contacts3<S> {
    let normal = relation.normal;
    let none = Contacts3 {
        normal: Vec3::zero(),
        count: S::zero(),
        points: [ContactPoint3 {
            on_a: Vec3::zero(),
            on_b: Vec3::zero(),
            gap: S::zero(),
        }; MOST],
    };
    if relation.apart.above(within) {
        return none;
    }
    let origin = relation.on_a;
    let size = facing.iter().fold(S::zero(), |size, patch| match patch {
        Patch::Face { corners, count } => corners[..*count].iter().fold(size, |size, &corner| {
            let arm = corner - origin;
            let parts = [arm.x, arm.y, arm.z].map(|x| x.unsigned());
            size.most(most_of(parts))
        }),
        _ => size,
    });
    let coordinates = [origin.x, origin.y, origin.z].map(|x| x.unsigned());
    let rounding =
        (size.primal() + most_of(coordinates).primal()) * S::Primal::rounding(ROUNDINGS, 1);
    let mut found = Found {
        relation,
        across: across(normal),
        origin,
        rounding,
        all: Vec::with_capacity(MOST),
    };
    // Points that coincide have no direction to look along.
    if normal.length_squared().above(S::zero()) {
        match facing {
            [
                Patch::Face {
                    corners: a,
                    count: m,
                },
                Patch::Face {
                    corners: b,
                    count: n,
                },
            ] => {
                let placed = |all: &[Vec3<S>]| -> Vec<Corner<S>> {
                    all.iter().map(|&corner| found.place(corner)).collect()
                };
                let (a, b) = (placed(&a[..m]), placed(&b[..n]));
                faces(&mut found, &a, &b);
            }
            [Patch::Plane, Patch::Face { corners, count }] => {
                for &corner in &corners[..count] {
                    let gap = relation.apart + normal.dot(corner - relation.on_b);
                    found.add(corner - normal * gap, gap);
                }
            }
            [Patch::Face { corners, count }, Patch::Plane] => {
                for &corner in &corners[..count] {
                    let gap = relation.apart + normal.dot(relation.on_a - corner);
                    found.add(corner, gap);
                }
            }
            _ => {}
        }
    }
    let slack = S::from_primal(rounding);
    // The relation of curved shapes has some roundings more.
    let lowest = relation.apart + slack * S::lit(8.0);
    let deepest = |p: &Placed<S>| p.point.gap.at_most(lowest);
    if !found.all.iter().any(deepest) {
        let at = found.place(relation.on_a).at.map(|x| x.primal());
        let point = ContactPoint3 {
            on_a: relation.on_a,
            on_b: relation.on_b,
            gap: relation.apart,
        };
        found.all.push(Placed { point, at });
    }
    let kept = |p: &Placed<S>| p.point.gap.at_most(within.most(relation.apart + slack));
    let mut all: Vec<Placed<S>> = found.all.into_iter().filter(kept).collect();
    arrange(&mut all);
    while all.len() > MOST {
        leave_out(&mut all);
    }
    let mut contacts = Contacts3 {
        normal: normal.canonical(),
        count: S::lit(all.len() as f64),
        ..none
    };
    for (place, Placed { point, .. }) in contacts.points.iter_mut().zip(&all) {
        *place = ContactPoint3 {
            on_a: point.on_a.canonical(),
            on_b: point.on_b.canonical(),
            gap: point.gap.saturated().canonical(),
        };
    }
    contacts
}

/// The number of roundings of the coordinates by which places of one point differ.
const ROUNDINGS: f64 = 64.0;

/// Adds the corners of the overlap of two faces.
fn faces<S: Scalar<Mask = bool>>(found: &mut Found<S>, a: &[Corner<S>], b: &[Corner<S>]) {
    for corner in a {
        if let Some(gap) = over(found, corner, b, S::one()) {
            found.add(corner.point, gap);
        }
    }
    for corner in b {
        if let Some(gap) = over(found, corner, a, -S::one()) {
            found.add(corner.point - found.normal() * gap, gap);
        }
    }
    for [p, q] in sides(a) {
        for [r, s] in sides(b) {
            crossing(found, [p, q], [r, s]);
        }
    }
}

/// Returns the sides of a face: one of a segment, none of a point.
fn sides<S: Scalar>(face: &[Corner<S>]) -> impl Iterator<Item = [&Corner<S>; 2]> {
    let n = if face.len() > 2 {
        face.len()
    } else {
        face.len() - 1
    };
    (0..n).map(move |k| [&face[k], &face[(k + 1) % face.len()]])
}

/// Returns the gap from a corner along the normal, or against it, to a face, if that has the corner's place.
fn over<S: Scalar<Mask = bool>>(
    found: &Found<S>,
    corner: &Corner<S>,
    face: &[Corner<S>],
    sign: S,
) -> Option<S> {
    match face {
        [start, end] => beside(found, corner, [start, end], sign),
        [first, second, third, ..] => {
            // The plane of the face; a face that is seen as a line has no points over it.
            let plane = (second.point - first.point).cross(third.point - first.point);
            let slope = plane.dot(found.normal());
            if slope.unsigned().at_most(plane.length() * S::lit(FLAT)) {
                return None;
            }
            let side = S::one().signed_as(slope);
            let slack = S::from_primal(found.rounding);
            let inside = sides(face).all(|[p, q]| {
                let bound = far(p.at, q.at) * slack;
                (turn(p.at, q.at, corner.at) * side).at_least(-bound)
            });
            let height = plane.dot(first.point - corner.point).over(slope);
            inside.then_some(height * sign)
        }
        _ => None,
    }
}

/// The sine of the angle between a face and the normal below which the face is seen as a line.
const FLAT: f64 = 1.0 / 16.0;

/// Returns the gap from a corner to a segment, if that passes the corner's place.
fn beside<S: Scalar<Mask = bool>>(
    found: &Found<S>,
    corner: &Corner<S>,
    [start, end]: [&Corner<S>; 2],
    sign: S,
) -> Option<S> {
    let way = [end.at[0] - start.at[0], end.at[1] - start.at[1]];
    let arm = [corner.at[0] - start.at[0], corner.at[1] - start.at[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let slack = S::from_primal(found.rounding);
    if square.at_most(slack * slack) {
        return None;
    }
    let t = (way[0] * arm[0] + way[1] * arm[1]).over(square);
    let aside = turn(start.at, end.at, corner.at).unsigned();
    let on_line =
        aside.at_most(square.root() * (slack + far(start.at, end.at) * S::rounding(1.0, 1).root()));
    if !on_line || t.below(S::zero()) || t.above(S::one()) {
        return None;
    }
    let foot = start.point + (end.point - start.point) * t;
    Some(found.normal().dot(foot - corner.point) * sign)
}

/// Adds the crossing of two edges, seen along the normal, if they cross between their ends.
fn crossing<S: Scalar<Mask = bool>>(
    found: &mut Found<S>,
    [p, q]: [&Corner<S>; 2],
    [r, s]: [&Corner<S>; 2],
) {
    let slack = S::from_primal(found.rounding);
    let beyond = |p: &Corner<S>, q: &Corner<S>, r: &Corner<S>, s: &Corner<S>| {
        let bound = far(p.at, q.at) * slack;
        let [at_r, at_s] = [turn(p.at, q.at, r.at), turn(p.at, q.at, s.at)];
        let apart =
            (at_r.above(bound) & at_s.below(-bound)) | (at_r.below(-bound) & at_s.above(bound));
        apart.then(|| at_r.over(at_r - at_s))
    };
    if let (Some(t), Some(u)) = (beyond(p, q, r, s), beyond(r, s, p, q)) {
        let on_a = p.point + (q.point - p.point) * u;
        let on_b = r.point + (s.point - r.point) * t;
        found.add(on_a, found.normal().dot(on_b - on_a));
    }
}

/// Removes the point without which the polygon loses the least area, but not the deepest one.
fn leave_out<S: Scalar<Mask = bool>>(all: &mut Vec<Placed<S>>) {
    let n = all.len();
    let deepest = |k: usize, i: usize| match all[i].point.gap.below(all[k].point.gap) {
        true => i,
        false => k,
    };
    let deepest = (1..n).fold(0, deepest);
    let area = |k: usize| turn(all[(k + n - 1) % n].at, all[k].at, all[(k + 1) % n].at);
    let smaller = |k: usize, i: usize| if area(i).below(area(k)) { i } else { k };
    let least = (0..n).filter(|&k| k != deepest).reduce(smaller);
    all.remove(least.unwrap_or(0));
}

/// Sorts points counter-clockwise about their mean.
fn arrange<S: Scalar<Mask = bool>>(all: &mut [Placed<S>]) {
    let count = S::Primal::lit(all.len().max(1) as f64);
    let sum = |k: usize| all.iter().fold(S::Primal::zero(), |sum, p| sum + p.at[k]);
    let mean = [sum(0).over(count), sum(1).over(count)];
    let angle = |p: &Placed<S>| (p.at[1] - mean[1]).atan2(p.at[0] - mean[0]);
    all.sort_by(|a, b| order(angle(a), angle(b)));
}
