//! Hulls as solids of smooth pieces: corners, edges, and faces, each by three corners that span it.
use super::super::mix::Mix;
use super::curved_replay::Pieces;
use super::grip::{Grip, between};
use super::piece::{Piece, PieceKind, Place, along, within};
use super::support::{Supported, start};
use super::{Curved, Placed, farthest, relate};
use crate::arrays::Each;
use crate::distance3::apart::Apart;
use crate::distance3::curved::{BySupport, SupportFunction};
use crate::distance3::facing::{Patch, PatchName};
use crate::distance3::half_space::Bounded;
use crate::distance3::hulls::{
    CornerList, Cornered, FixedCorners, HullBody, HullFace, PointColumns, PointGroups, around,
    numbers, patch_ring, spanning,
};
use crate::distance3::relation::Relation;
use crate::scalar::{Guard, largest};
use crate::shape::{Cone, Cylinder, Disc, Ellipsoid};
use crate::{Hull3, Scalar, Vec3};
use std::cell::OnceCell;

/// The corners of a piece, by their numbers: of a corner one, of an edge two, of a face three that span it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Named {
    corners: [usize; 3],
    count: usize,
}

/// The bits of the number of a corner.
const BITS: u32 = 8;

impl Named {
    fn new(corners: &[usize]) -> Self {
        let at = |k: usize| corners[if k < corners.len() { k } else { 0 }];
        Named {
            corners: [at(0), at(1), at(2)],
            count: corners.len(),
        }
    }
    /// Returns it as one number, larger than those in the list of pieces.
    fn number(self) -> usize {
        let [i, j, k] = self.corners;
        i | j << BITS | k << (2 * BITS) | self.count << (3 * BITS)
    }
    /// Returns the piece of a number; `None` of a place in the list of pieces.
    fn of(number: usize) -> Option<Self> {
        let one = |k: u32| number >> (k * BITS) & 0xff;
        let corners = [one(0), one(1), one(2)];
        let count = number >> (3 * BITS);
        (count > 0).then_some(Named { corners, count })
    }
    /// Returns the piece, given all corners.
    fn piece<S: Scalar>(self, points: &[Vec3<S>]) -> Piece<S> {
        let [from, i, j] = self
            .corners
            .each_as(|k| points.get(k).copied().unwrap_or(Vec3::zero()));
        let (u, v) = (i - from, j - from);
        match self.count {
            1 => Piece::point(from),
            2 => Piece::line(from, u),
            _ => Piece::plane(
                PieceKind::Face,
                from,
                [u.normalize_or_zero(), v.normalize_or_zero()],
                [u.length(), v.length()],
            ),
        }
    }
}

/// A hull in the units of a search.
#[derive(Clone, Copy, Debug)]
pub struct HullInUnits<S, const N: usize> {
    points: [Vec3<S>; N],
    count: usize,
}

impl<S: Scalar, const N: usize> Pieces<S> for HullInUnits<S, N> {
    fn piece_at(&self, k: usize, _: Vec3<S>) -> Piece<S> {
        Named::of(k).map_or(Piece::point(Vec3::zero()), |named| {
            named.piece(&self.points)
        })
    }
}

/// A face, and its corners in the coordinates of its piece.
#[derive(Debug)]
struct Ring {
    corners: Vec<usize>,
    /// The corners, counter-clockwise from outside as the ring is.
    seen: Vec<[f64; 2]>,
    normal: Vec3<f64>,
}

/// A hull of plain numbers.
#[derive(Debug)]
pub struct HullPieces {
    points: Vec<Vec3<f64>>,
    groups: PointGroups,
    /// Its surface, which a search needs only where it is not simple.
    surface: OnceCell<NamedPieces>,
}

/// The pieces of the surface of a hull.
#[derive(Debug)]
struct NamedPieces {
    pieces: Vec<Named>,
    /// The rings of the faces, which are the last pieces.
    rings: Vec<Ring>,
}

/// The height below the highest corners from which others play no part, relative to the size.
const PLAIN: f64 = 1e-9;
/// The height over the plane of a face below which a corner is in it.
const FLAT: f64 = 1e-14;

impl NamedPieces {
    fn new(points: &[Vec3<f64>]) -> Self {
        let body = HullBody::of(points, f64::EPSILON);
        let mut faces: Vec<(Named, Vec<usize>, Vec3<f64>)> = Vec::new();
        let size = |face: &HullFace| {
            let [apex, from, to] = face.plane.map(|k| points[k]);
            (from - apex).cross(to - apex).length_squared()
        };
        let known = |face: &&HullFace| face.normal != Vec3::zero();
        let mut flat: Vec<&HullFace> = body.faces.iter().filter(known).collect();
        flat.sort_by(|p, q| size(q).total_cmp(&size(p)));
        for face in flat {
            // Parts of a face that is flat within rounding are one; the largest has a normal with the most digits.
            let part = |other: &(Named, Vec<usize>, Vec3<f64>)| {
                other.2.dot(face.normal) > 0.0 && face.ring.iter().all(|k| other.1.contains(k))
            };
            if faces.iter().any(part) {
                continue;
            }
            let ring = patch_ring(points, &body.corners, (face.plane[0], face.normal), FLAT);
            if ring.len() > 2 {
                faces.push((Named::new(&face.plane), ring, face.normal));
            }
        }
        let corners = body.corners.iter().map(|&k| Named::new(&[k]));
        let edges = body.edges.iter().map(|edge| Named::new(&edge.ends));
        let mut pieces: Vec<Named> = corners.chain(edges).collect();
        let mut rings = Vec::new();
        for (named, corners, normal) in faces {
            let piece = named.piece(points);
            let seen = |&k: &usize| {
                let [x, y, _] = start(&piece, points[k], normal, false).y;
                [x, y]
            };
            let seen = corners.iter().map(seen).collect();
            pieces.push(named);
            rings.push(Ring {
                corners,
                seen,
                normal,
            });
        }
        NamedPieces { pieces, rings }
    }
}

impl HullPieces {
    fn new(points: Vec<Vec3<f64>>) -> Self {
        let mut groups = PointGroups::with_room([points.len()]);
        groups.add(points.len(), |k| points[k] - points[0]);
        HullPieces {
            groups,
            points,
            surface: OnceCell::new(),
        }
    }
    fn columns(&self) -> PointColumns<'_> {
        self.groups.columns(0, self.points.len())
    }
    fn surface(&self) -> &NamedPieces {
        self.surface.get_or_init(|| NamedPieces::new(&self.points))
    }
    /// Returns the ring of a piece of the list; `None` of a corner or an edge.
    fn ring(&self, k: usize) -> Option<&Ring> {
        if Named::of(k).is_some() {
            return None;
        }
        let NamedPieces { pieces, rings } = self.surface();
        let first = pieces.len() - rings.len();
        k.checked_sub(first).and_then(|k| rings.get(k))
    }
    /// Returns one less than the number of corners up to a slack below the highest along a normal, three at most.
    fn level(&self, normal: Vec3<f64>, slack: f64) -> usize {
        let (_, highest) = self.columns().highest(normal);
        let mut count = 0;
        self.columns()
            .above(normal, normal.dot(highest) - slack, |_| count += 1);
        count.clamp(1, 4) - 1
    }
    /// Returns a piece by its place in the list or by its number.
    fn named(&self, k: usize) -> Named {
        Named::of(k).unwrap_or_else(|| self.surface().pieces[k])
    }
}

impl Ring {
    /// Returns the point of the face that is nearest to another one in its plane, in the coordinates of a piece.
    fn clamped(&self, piece: &Piece<f64>, at: [f64; 2]) -> [f64; 2] {
        let way = |[x, y]: [f64; 2], [z, w]: [f64; 2]| {
            piece.ways[0] * (piece.sizes[0] * (z - x)) + piece.ways[1] * (piece.sizes[1] * (w - y))
        };
        let (mut best, mut nearest, mut inside) = (f64::INFINITY, at, true);
        for (k, &from) in self.seen.iter().enumerate() {
            let to = self.seen[(k + 1) % self.seen.len()];
            let (along, arm) = (way(from, to), way(from, at));
            inside &= self.normal.dot(along.cross(arm)) >= 0.0;
            let square = along.length_squared();
            let share = if square > 0.0 {
                (along.dot(arm) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let foot = [0, 1].map(|k| from[k] + (to[k] - from[k]) * share);
            let off = way(foot, at).length_squared();
            if off < best {
                (best, nearest) = (off, foot);
            }
        }
        if inside { at } else { nearest }
    }
}

impl Supported for HullPieces {
    fn support(&self, way: Vec3<f64>) -> Vec3<f64> {
        self.points[self.columns().highest(way).0]
    }
    fn middle(&self) -> Vec3<f64> {
        let arms = self.points.iter().map(|&point| point - self.points[0]);
        let sum = arms.fold(Vec3::zero(), |sum, arm| sum + arm);
        self.points[0] + sum * (1.0 / self.points.len() as f64)
    }
    fn size(&self) -> f64 {
        let lengths = self
            .points
            .iter()
            .map(|&point| (point - self.points[0]).length());
        lengths.fold(0.0, f64::max)
    }
    fn pieces(&self) -> usize {
        self.surface().pieces.len()
    }
    fn piece(&self, k: usize, _: Vec3<f64>) -> Piece<f64> {
        self.named(k).piece(&self.points)
    }
    fn coded(&self, way: Vec3<f64>) -> (Vec3<f64>, usize) {
        let number = self.columns().highest(way).0;
        (self.points[number], number)
    }
    fn likely(&self, mix: &Mix, _: Vec3<f64>, normal: Vec3<f64>) -> Option<(usize, Place<f64>)> {
        let codes = mix.codes();
        let face = match codes.len() {
            1 | 2 => Named::new(codes),
            3 => Named::new(&spanning(|k| self.points[k], codes, normal)),
            _ => return None,
        };
        let [_, i, j] = face.corners.each_as(|k| mix.weight(k));
        let place = match face.count {
            1 => Place::zero(),
            2 => along(i),
            _ => within(i, j),
        };
        Some((face.number(), place))
    }
    fn flatness(&self, normal: Vec3<f64>, slack: f64) -> usize {
        self.level(normal, slack)
    }
    fn is_plain(&self, normal: Vec3<f64>, dimension: usize) -> bool {
        self.level(normal, PLAIN * self.size()) == dimension
    }
    // A search around the longest edge needs the surface, and has found nothing better among 480,000 prisms.
    fn may_be_round(&self) -> bool {
        false
    }
    fn clamped(&self, k: usize, place: &Place<f64>) -> Place<f64> {
        let mut place = *place;
        place.s = place.s.clamp(0.0, 1.0);
        let [x, y, _] = place.y;
        if Named::of(k).is_some_and(|named| named.count > 2) {
            // Between three corners.
            let [x, y] = [x.max(0.0), y.max(0.0)];
            let sum = (x + y).max(1.0);
            place.y = [x / sum, y / sum, 0.0];
        } else if let Some(ring) = self.ring(k) {
            let [x, y] = ring.clamped(&self.named(k).piece(&self.points), [x, y]);
            place.y = [x, y, 0.0];
        }
        place
    }
    fn middle_of(&self, k: usize, piece: &Piece<f64>) -> Vec3<f64> {
        let Some(ring) = self.ring(k) else {
            return piece.from + piece.along * 0.5;
        };
        let arms = ring.corners.iter().map(|&k| self.points[k] - piece.from);
        let sum = arms.fold(Vec3::zero(), |sum, arm| sum + arm);
        piece.from + sum * (1.0 / ring.corners.len() as f64)
    }
    fn replayed(&self, k: usize, place: &Place<f64>) -> (usize, Place<f64>) {
        let named = self.named(k);
        let Some(ring) = self.ring(k).filter(|ring| ring.corners.len() > 3) else {
            return (named.number(), *place);
        };
        let at = named.piece(&self.points).at(place);
        let up = (ring.normal, ring.normal);
        let named = Named::new(&around(&self.points, &ring.corners, up, at));
        let piece = named.piece(&self.points);
        (named.number(), start(&piece, at, ring.normal, false))
    }
}

impl<S: Scalar, const N: usize> Placed<S> for HullInUnits<S, N> {
    type Plain = HullPieces;
    fn grip(&self, k: usize, place: &Place<S>, _: Vec3<S>) -> Option<Grip<S>> {
        Named::of(k).map(|named| between(&named.corners[..named.count.clamp(1, 3)], place))
    }
    fn reach(&self) -> S::Primal {
        let all = self.points[..self.count].iter();
        all.fold(S::Primal::zero(), |most, p| {
            most.most(largest([p.x, p.y, p.z]))
        })
    }
    fn plain(&self) -> Option<HullPieces> {
        numbers(&FixedCorners(&self.points[..self.count])).map(HullPieces::new)
    }
}

impl<S: Scalar, const N: usize> Curved for Hull3<S, N> {
    type Placed = HullInUnits<S, N>;
    fn anchor_point(&self) -> Vec3<S> {
        self.vertices[0]
    }
    fn in_units(&self, from: Vec3<S>, scale: S, _: S) -> HullInUnits<S, N> {
        let corners = self.corners_from(from);
        let count = corners.count();
        // Behind the last vertex the first is repeated.
        let at = |k: usize| corners.at(if k < count { k } else { 0 }) * scale;
        HullInUnits {
            points: std::array::from_fn(at),
            count,
        }
    }
}

macro_rules! hulls {
    ($([$($generic:tt)*] $A:ty, $B:ty, |$a:ident, $b:ident| $guard:expr;)*) => { $(
        impl<S: Scalar<Mask = bool>, const N: usize, $($generic)*> Apart<$B> for $A {
            type Scalar = S;
            fn guarded_with(&self, other: &$B) -> Guard<S> {
                let ($a, $b) = (self, other);
                $guard
            }
            fn relation(self, other: $B) -> Relation<S> {
                relate(self, other, true)
            }
            fn relation_without_points(self, other: $B) -> Relation<S> {
                relate(self, other, false)
            }
            fn facing(&self, other: &$B, normal: Vec3<S>) -> [PatchName; 2] {
                [self.face(normal), other.face(-normal)]
            }
            fn patches(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                [self.patch(a, normal), other.patch(b, -normal)]
            }
            fn farthest(self, other: $B) -> S {
                farthest(self, other)
            }
        }
    )* };
}
macro_rules! both {
    ($([$($generic:tt)*] $A:ty;)*) => { hulls! { $(
        [$($generic)*] $A, Hull3<S, N>, |a, b| b.with_guard(Guard::of(a));
        [$($generic)*] Hull3<S, N>, $A, |a, b| a.with_guard(Guard::of(b));
    )* } };
}
both! {
    [] Ellipsoid<S>;
    [] Disc<S>;
    [] Cylinder<S>;
    [] Cone<S>;
    [O: SupportFunction<Scalar = S, With<f64>: SupportFunction<Scalar = f64>>] BySupport<O>;
}
