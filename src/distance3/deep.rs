//! How far cores are in each other: the plane that parts them best.
//!
//! The gap along any direction of length one is at most the signed distance, and of some face's normal, or some normal
//! of two edges, it is just that. A direction that is mostly rounding costs nothing.
use super::core::{BoxCore, Core};
use super::near::normal;
use crate::{Scalar, Vec3};

/// A plane between two cores, and the points that it touches.
///
/// Planes that tie share the derivative. Of corners and of faces that tie, those share whose foot is on the other
/// face: they are the corners of what faces each other.
#[derive(Clone, Copy, Debug)]
pub struct PartingPlane<S> {
    /// How far b begins beyond a; negative where they overlap.
    pub value: S,
    /// The sum of that of all that tie, with derivatives.
    pub ahead: S,
    /// How many they are.
    pub count: S,
    /// One where the foot is on the other face, else zero.
    pub faces: S,
    /// The plane's normal, of length one, from a to b.
    pub normal: Vec3<S>,
    /// The sum of the points of a, of those planes that have the same normal as the first.
    pub on_a: Vec3<S>,
    /// The sum of the points of b.
    pub on_b: Vec3<S>,
    /// How many points those are.
    pub points: S,
}

/// By so many roundings of the unit, in which all is of a size of at most four, heights and ways differ.
pub(super) const SLACK: f64 = 64.0;

/// By so many roundings of the unit edges must part cores more than faces do.
const MORE: f64 = 8.0;

impl<S: Scalar> PartingPlane<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pick(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        let sum = |a: S, b: S| S::select(tie, a + b, S::select(keep, a, b));
        let first = keep | tie;
        let both = tie & self.normal.dot(other.normal).above(S::lit(0.5));
        let sums = |a: Vec3<S>, b: Vec3<S>| Vec3::select(both, a + b, Vec3::select(first, a, b));
        let (p, q) = (self.points, other.points);
        PartingPlane {
            value: S::select(first, self.value, other.value),
            ahead: sum(self.ahead, other.ahead),
            count: sum(self.count, other.count),
            faces: S::select(first, self.faces, other.faces),
            normal: Vec3::select(first, self.normal, other.normal),
            on_a: sums(self.on_a, other.on_a),
            on_b: sums(self.on_b, other.on_b),
            points: S::select(both, p + q, S::select(first, p, q)),
        }
    }
    /// The larger of two; of equal ones those whose feet are on the other face, or else both.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn most(self, other: Self) -> Self {
        let same = self.value.equals(other.value);
        let tie = same & self.faces.equals(other.faces);
        let keep = other.value.below(self.value) | same & other.faces.below(self.faces);
        self.pick(other, keep, tie)
    }
    /// The smaller of two corners over one face; of equal ones as in [`most`](Self::most).
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn least(self, other: Self) -> Self {
        let same = self.value.equals(other.value);
        let tie = same & self.faces.equals(other.faces);
        let keep = self.value.below(other.value) | same & other.faces.below(self.faces);
        self.pick(other, keep, tie)
    }
    /// With a and b exchanged.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        PartingPlane {
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            ..self
        }
    }
    /// The mean of all that tie.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn mean(self) -> Self {
        let (one, share) = (S::one(), S::one().over(self.points));
        PartingPlane {
            ahead: self.ahead.over(self.count),
            count: one,
            on_a: self.on_a * share,
            on_b: self.on_b * share,
            points: one,
            ..self
        }
    }
    /// A corner over a face.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corner(ahead: S, over: S::Mask, normal: Vec3<S>, corner: Vec3<S>) -> Self {
        PartingPlane {
            value: ahead,
            ahead,
            count: S::one(),
            faces: S::select(over, S::one(), S::zero()),
            normal,
            on_a: corner - normal * ahead,
            on_b: corner,
            points: S::one(),
        }
    }
    /// Without value where the mask is true.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn unless(self, none: S::Mask) -> Self {
        PartingPlane {
            value: S::select(none, S::lit(-S::LARGEST), self.value),
            ..self
        }
    }
}

/// The least of at least one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn least<S: Scalar>(candidates: impl Iterator<Item = PartingPlane<S>>) -> PartingPlane<S> {
    candidates
        .reduce(PartingPlane::least)
        .expect("a core has at least one corner")
}

/// The face of a box that parts it best from some corners.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn box_faces<S: Scalar>(shape: &BoxCore<S>, corners: &[Vec3<S>]) -> PartingPlane<S> {
    let face = |k: usize, low: bool| {
        let turned = |x: S| if low { -x } else { x };
        let axis = shape.axes[k];
        let normal = if low { -axis } else { axis };
        least(corners.iter().map(|&corner| {
            let at = shape.seen(corner);
            let within = |k: usize| at[k].unsigned().at_most(shape.half[k]);
            let over = within((k + 1) % 3) & within((k + 2) % 3);
            PartingPlane::corner(turned(at[k]) - shape.half[k], over, normal, corner)
        }))
    };
    let axis = |k: usize| face(k, false).most(face(k, true));
    axis(0).most(axis(1)).most(axis(2))
}

/// A triangle, the face of a solid with a corner behind it or alone, against some corners.
///
/// Both sides count: a solid without volume has two, and of any other one the side within parts nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn triangle_face<S: Scalar>(
    face: [Vec3<S>; 3],
    behind: Option<Vec3<S>>,
    corners: &[Vec3<S>],
) -> PartingPlane<S> {
    let (u, v) = (face[1] - face[0], face[2] - face[0]);
    let normal = normal(u, v);
    let side = |unit: Vec3<S>| {
        // The corner behind is not beyond, whatever the side.
        let top = behind.map_or(S::Primal::zero(), |behind| {
            let height = unit.dot(behind - face[0]).primal();
            height.most(S::Primal::zero())
        });
        let found = least(corners.iter().map(|&corner| {
            let arm = corner - face[0];
            let weight = |w: Vec3<S>| w.dot(normal.long).over(normal.square);
            let (s, t) = (weight(arm.cross(v)), weight(u.cross(arm)));
            let zero = S::zero();
            let over = zero.at_most(s) & zero.at_most(t) & (s + t).at_most(S::one());
            let ahead = unit.dot(arm) - S::from_primal(top);
            PartingPlane::corner(ahead, over, unit, corner)
        }));
        found.unless(normal.none)
    };
    side(normal.unit).most(side(-normal.unit))
}

/// The normals of an edge of each core: that which parts them best; `None` where one of them has no edges.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edges_deep<S: Scalar, A: Core<S>, B: Core<S>>(
    a: &A,
    b: &B,
) -> Option<PartingPlane<S>> {
    let mut best: Option<PartingPlane<S>> = None;
    for (i, &u) in a.ways().as_ref().iter().enumerate() {
        for (j, &v) in b.ways().as_ref().iter().enumerate() {
            let normal = normal(u, v);
            for unit in [normal.unit, -normal.unit] {
                let (on_a, on_b) = (a.lowest(-unit, i), b.lowest(unit, j));
                let way = on_b - on_a;
                let ahead = unit.dot(way);
                // Where the edges through both corners cross, seen along the normal.
                let s = way.cross(v).dot(normal.long).over(normal.square);
                let on_a = on_a + u * s.clamp(-S::one(), S::one());
                let found = PartingPlane {
                    value: ahead,
                    ahead,
                    count: S::one(),
                    faces: S::zero(),
                    normal: unit,
                    on_a,
                    on_b: on_a + unit * ahead,
                    points: S::one(),
                };
                let found = found.unless(normal.none);
                best = Some(best.map_or(found, |best| best.most(found)));
            }
        }
    }
    best
}

/// The plane that parts two cores best; `None` where their difference has no volume.
///
/// Edges count where they part the cores by more than rounding more than faces do: the normal of edges that are all
/// but parallel turns too fast with them for a derivative.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn deepest<S: Scalar, A: Core<S>, B: Core<S>>(a: &A, b: &B) -> Option<PartingPlane<S>> {
    if A::DIMENSION + B::DIMENSION < 3 {
        return None;
    }
    let of_a = a.deep(b.corners().as_ref());
    let of_b = b.deep(a.corners().as_ref()).map(PartingPlane::flipped);
    let faces = match (of_a, of_b) {
        (Some(of_a), Some(of_b)) => Some(of_a.most(of_b).mean()),
        (one, other) => one.or(other).map(PartingPlane::mean),
    };
    let edges = edges_deep(a, b).map(PartingPlane::mean);
    match (faces, edges) {
        (Some(faces), Some(edges)) => {
            let more = faces.value + S::lit(MORE * S::EPSILON);
            let mut found = faces.pick(edges, edges.value.at_most(more), S::one().below(S::zero()));
            let value = faces.value.primal().most(edges.value.primal());
            found.value = S::from_primal(value);
            found.ahead = found.ahead.with_primal(value);
            Some(found)
        }
        (one, other) => one.or(other),
    }
}
