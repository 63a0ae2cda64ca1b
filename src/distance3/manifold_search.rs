//! The search for contact points: which corners and crossings of two faces they are.
use super::contact_points::MOST;
use super::facing::{Patch, PatchName, helper};
use super::manifold_record::{
    ContactOrigin, ContactRecord, Corner, Facing, share_beside, side, turn,
};
use super::relation::Relation;
use super::spot::plain;
use crate::arrays::sort_few;
use crate::predicate::order;
use crate::scalar::{most_of, noted};
use crate::{Scalar, Vec3};

/// The number of roundings of the coordinates by which places of one point differ.
const ROUNDINGS: f64 = 64.0;
/// The sine of the angle between a face and the normal below which the face is seen as a line.
const FLAT: f64 = 1.0 / 16.0;

/// A contact point, and its place in the plane across the normal.
#[derive(Clone, Copy)]
struct Placed<P> {
    origin: ContactOrigin,
    gap: P,
    at: [P; 2],
}

/// The points so far.
struct Found<'a, P> {
    relation: &'a Relation<P>,
    facing: &'a Facing<P>,
    /// A distance that is mostly rounding.
    rounding: P,
    all: Vec<Placed<P>>,
}

impl ContactRecord {
    /// Returns the decisions about contact points, given the relation of two shapes, their faces by names and as
    /// polygons.
    pub fn search<S: Scalar<Mask = bool>>(
        relation: &Relation<S>,
        names: [PatchName; 2],
        faces: impl Fn([PatchName; 2]) -> [Patch<S>; 2],
        within: S,
    ) -> Self {
        let plain = Relation {
            apart: relation.apart.primal(),
            square: relation.square.primal(),
            normal: plain(relation.normal),
            on_a: plain(relation.on_a),
            on_b: plain(relation.on_b),
        };
        let record = match plain.apart.above(within.primal()) {
            true => ContactRecord::none(names),
            false => decided(
                &plain,
                names,
                faces(names).map(|face| face.plain()),
                within.primal(),
            ),
        };
        noted::<S::Primal>(8, record.faces.into_iter().flat_map(PatchName::numbers));
        noted::<S::Primal>(32, record.points.map(ContactOrigin::number));
        noted::<S::Primal>(8, [record.count, record.helper].map(u32::from));
        record
    }
}

impl ContactOrigin {
    /// Returns the origin as a number.
    fn number(self) -> u32 {
        match self {
            ContactOrigin::Nearest => 0,
            ContactOrigin::CornerOfA(k) => 1 | u32::from(k) << 2,
            ContactOrigin::CornerOfB(k) => 2 | u32::from(k) << 2,
            ContactOrigin::Crossing(i, j) => 3 | u32::from(i) << 2 | u32::from(j) << 10,
        }
    }
}

/// Returns the decisions about contact points of shapes that are near each other.
fn decided<P: Scalar<Mask = bool>>(
    relation: &Relation<P>,
    names: [PatchName; 2],
    faces: [Patch<P>; 2],
    within: P,
) -> ContactRecord {
    let helper = helper(relation.normal);
    let facing = Facing::new(relation, &faces, helper);
    let largest = |v: Vec3<P>| most_of([v.x, v.y, v.z].map(|x| x.unsigned()));
    let ways = |size: P, corner: &Corner<P>| size.most(largest(corner.point - relation.on_a));
    let size = facing.corners.iter().flatten().fold(P::zero(), ways);
    let rounding = (size + largest(relation.on_a)) * P::rounding(ROUNDINGS, 1);
    let mut found = Found {
        relation,
        facing: &facing,
        rounding,
        all: Vec::with_capacity(MOST),
    };
    // Points that coincide have no direction to look along.
    if relation.normal.length_squared().above(P::zero()) {
        found.gather();
    }
    // The relation of curved shapes has some roundings more.
    let lowest = relation.apart + rounding * P::lit(8.0);
    if !found.all.iter().any(|p| p.gap.at_most(lowest)) {
        let at = facing.across.place(relation.on_a).at;
        found.all.push(Placed {
            origin: ContactOrigin::Nearest,
            gap: relation.apart,
            at,
        });
    }
    let kept = |p: &Placed<P>| p.gap.at_most(within.most(relation.apart + rounding));
    let mut all: Vec<Placed<P>> = found.all.into_iter().filter(kept).collect();
    arrange(&mut all);
    while all.len() > MOST {
        leave_out(&mut all);
    }
    let mut record = ContactRecord::none(names);
    for (place, point) in record.points.iter_mut().zip(&all) {
        *place = point.origin;
        record.count += 1;
    }
    ContactRecord { helper, ..record }
}

/// Returns the larger magnitude of both coordinates of a place relative to another one.
fn far<P: Scalar>(a: [P; 2], b: [P; 2]) -> P {
    (a[0] - b[0]).unsigned().most((a[1] - b[1]).unsigned())
}

/// Returns the numbers of the sides of a face: one of a segment, none of a point.
fn sides<P>(face: &[Corner<P>]) -> std::ops::Range<usize> {
    match face.len() {
        0..3 => 0..face.len().saturating_sub(1),
        n => 0..n,
    }
}

impl<P: Scalar<Mask = bool>> Found<'_, P> {
    /// Adds all points of both faces.
    fn gather(&mut self) {
        let [a, b] = &self.facing.corners;
        let [by_plane, to_plane] = self.facing.planes;
        // The one point of a ball or a point is the nearest one, which has more digits than its way to a face.
        if (a.len() <= 1 && !by_plane) || (b.len() <= 1 && !to_plane) {
            return;
        }
        for (k, corner) in a.iter().enumerate() {
            if to_plane || self.is_over(corner, b) {
                self.add(ContactOrigin::CornerOfA(k as u8));
            }
        }
        for (k, corner) in b.iter().enumerate() {
            if by_plane || self.is_over(corner, a) {
                self.add(ContactOrigin::CornerOfB(k as u8));
            }
        }
        for i in sides(a) {
            for j in sides(b) {
                if self.cross(side(a, i), side(b, j)) {
                    self.add(ContactOrigin::Crossing(i as u8, j as u8));
                }
            }
        }
    }
    /// Adds a point, unless one at the same place is there.
    fn add(&mut self, origin: ContactOrigin) {
        let (on_a, gap) = self.facing.point(self.relation, origin);
        let at = self.facing.across.place(on_a).at;
        let near = |other: &Placed<P>| {
            let way = [at[0] - other.at[0], at[1] - other.at[1]];
            way[0].hypot(way[1]).at_most(self.rounding)
        };
        if !self.all.iter().any(near) {
            self.all.push(Placed { origin, gap, at });
        }
    }
    /// Returns `true` if a face has a corner's place.
    fn is_over(&self, corner: &Corner<P>, face: &[Corner<P>]) -> bool {
        match face {
            [start, end] => self.is_beside(corner, [start, end]),
            [first, second, third, ..] => {
                // A face that is seen as a line has no points over it.
                let plane = (second.point - first.point).cross(third.point - first.point);
                let slope = plane.dot(self.relation.normal);
                if slope.unsigned().at_most(plane.length() * P::lit(FLAT)) {
                    return false;
                }
                let sign = P::one().signed_as(slope);
                sides(face).all(|k| {
                    let [p, q] = side(face, k);
                    let bound = far(p.at, q.at) * self.rounding;
                    (turn(p.at, q.at, corner.at) * sign).at_least(-bound)
                })
            }
            _ => false,
        }
    }
    /// Returns `true` if a segment passes a corner's place.
    fn is_beside(&self, corner: &Corner<P>, [start, end]: [&Corner<P>; 2]) -> bool {
        let (share, square) = share_beside(corner, [start, end]);
        if square.at_most(self.rounding * self.rounding) {
            return false;
        }
        let aside = turn(start.at, end.at, corner.at).unsigned();
        let slack = self.rounding + far(start.at, end.at) * P::rounding(1.0, 1).root();
        aside.at_most(square.root() * slack) && share.at_least(P::zero()) && share.at_most(P::one())
    }
    /// Returns `true` if two edges cross between their ends.
    fn cross(&self, [p, q]: [&Corner<P>; 2], [r, s]: [&Corner<P>; 2]) -> bool {
        let beyond = |p: &Corner<P>, q: &Corner<P>, r: &Corner<P>, s: &Corner<P>| {
            let bound = far(p.at, q.at) * self.rounding;
            let [at_r, at_s] = [turn(p.at, q.at, r.at), turn(p.at, q.at, s.at)];
            (at_r.above(bound) & at_s.below(-bound)) | (at_r.below(-bound) & at_s.above(bound))
        };
        beyond(p, q, r, s) && beyond(r, s, p, q)
    }
}

/// Removes the point without which the polygon loses the least area, but not the deepest one.
fn leave_out<P: Scalar<Mask = bool>>(all: &mut Vec<Placed<P>>) {
    let n = all.len();
    let deepest = |k: usize, i: usize| if all[i].gap.below(all[k].gap) { i } else { k };
    let deepest = (1..n).fold(0, deepest);
    let area = |k: usize| turn(all[(k + n - 1) % n].at, all[k].at, all[(k + 1) % n].at);
    let smaller = |k: usize, i: usize| if area(i).below(area(k)) { i } else { k };
    let least = (0..n).filter(|&k| k != deepest).reduce(smaller);
    all.remove(least.unwrap_or(0));
}

/// Sorts points counter-clockwise about their mean.
fn arrange<P: Scalar<Mask = bool>>(all: &mut [Placed<P>]) {
    let count = P::lit(all.len().max(1) as f64);
    let sum = |k: usize| all.iter().fold(P::zero(), |sum, p| sum + p.at[k]);
    let mean = [sum(0).over(count), sum(1).over(count)];
    let angle = |p: &Placed<P>| (p.at[1] - mean[1]).atan2(p.at[0] - mean[0]);
    sort_few(all, |a, b| order(angle(a), angle(b)).is_lt());
}
