//! How far cores are in each other: the plane that parts them best.
//!
//! The gap along any direction of length one is at most the signed distance, and of some face's normal, or some normal
//! of two edges, it is just that. A direction that is mostly rounding costs nothing.
use super::box_core::BoxCore;
use super::core::Core;
use super::near::normal;
use super::place::{Place, Pull};
use crate::distance::share::Carry;
use crate::{Scalar, Vec3};

/// A plane between two cores, and the points that it touches.
///
/// Planes that tie share the derivative. Of corners and of faces that tie, those share whose foot is on the other
/// face: they are the corners of what faces each other.
#[derive(Clone, Copy, Debug)]
pub struct PartingPlane<P> {
    /// How far b begins beyond a; negative where they overlap.
    pub value: P,
    /// How many planes and points of theirs tie.
    pub count: P,
    /// One where the foot is on the other face, else zero.
    pub faces: P,
    /// The plane's normal, of length one, from a to b.
    pub normal: Vec3<P>,
    /// How many of the points have the same normal as the first.
    pub points: P,
    /// The sum of their points of a.
    pub on_a: Vec3<P>,
    /// The sum of their points of b.
    pub on_b: Vec3<P>,
    /// The sum of the places of those of a.
    pub at_a: Place<P>,
    /// The sum of those of b.
    pub at_b: Place<P>,
    /// The sum of the derivatives of the height of a, over all that tie.
    pub pull_a: Pull<P>,
    /// That of b.
    pub pull_b: Pull<P>,
}

/// By so many roundings of the unit, in which all is of a size of at most four, heights and ways differ.
pub(super) const SLACK: f64 = 64.0;

/// By so many roundings of the unit edges must part cores more than faces do.
const MORE: f64 = 8.0;

impl<P: Scalar> PartingPlane<P> {
    /// A plane that touches two points.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new<A: Core<P>, B: Core<P>>(a: &A, b: &B, normal: Vec3<P>, touch: Touch<P>) -> Self {
        PartingPlane {
            value: touch.ahead,
            count: touch.count,
            faces: touch.faces,
            normal,
            points: touch.count,
            on_a: touch.on_a,
            on_b: touch.on_b,
            at_a: touch.at_a,
            at_b: touch.at_b,
            pull_a: a.pull(touch.at_a, normal),
            pull_b: b.pull(touch.at_b, normal),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pick(self, other: Self, keep: P::Mask, tie: P::Mask) -> Self {
        let first = keep | tie;
        let both = tie & self.normal.dot(other.normal).above(P::lit(0.5));
        let sums = |a: Vec3<P>, b: Vec3<P>| Vec3::select(both, a + b, Vec3::select(first, a, b));
        PartingPlane {
            value: P::select(first, self.value, other.value),
            count: self.count.join(other.count, keep, tie),
            faces: P::select(first, self.faces, other.faces),
            normal: Vec3::select(first, self.normal, other.normal),
            points: self.points.join(other.points, first, both),
            on_a: sums(self.on_a, other.on_a),
            on_b: sums(self.on_b, other.on_b),
            at_a: self.at_a.join(other.at_a, first, both),
            at_b: self.at_b.join(other.at_b, first, both),
            pull_a: self.pull_a.join(other.pull_a, keep, tie),
            pull_b: self.pull_b.join(other.pull_b, keep, tie),
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
    /// With a and b exchanged.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        PartingPlane {
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            at_a: self.at_b,
            at_b: self.at_a,
            pull_a: self.pull_b.times(-P::one()),
            pull_b: self.pull_a.times(-P::one()),
            ..self
        }
    }
    /// The mean of all that tie.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn mean(self) -> Self {
        let one = P::one();
        let (share, all) = (one.over(self.points), one.over(self.count));
        PartingPlane {
            on_a: self.on_a * share,
            on_b: self.on_b * share,
            at_a: self.at_a.times(share),
            at_b: self.at_b.times(share),
            pull_a: self.pull_a.times(all),
            pull_b: self.pull_b.times(all),
            ..self
        }
    }
    /// Without value where the mask is true.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn unless(self, none: P::Mask) -> Self {
        PartingPlane {
            value: P::select(none, P::lit(-P::LARGEST), self.value),
            ..self
        }
    }
}

/// Points of both cores along one normal, and how far that of b is beyond that of a; sums of those that tie.
#[derive(Clone, Copy, Debug)]
struct Touch<P> {
    ahead: P,
    faces: P,
    count: P,
    on_a: Vec3<P>,
    on_b: Vec3<P>,
    at_a: Place<P>,
    at_b: Place<P>,
}

impl<P: Scalar> Touch<P> {
    /// The smaller of two corners over one face; of equal ones those whose foot is on it, or else both.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn least(self, other: Self) -> Self {
        let same = self.ahead.equals(other.ahead);
        let tie = same & self.faces.equals(other.faces);
        let keep = self.ahead.below(other.ahead) | same & other.faces.below(self.faces);
        let sums = |a: Vec3<P>, b: Vec3<P>| Vec3::select(tie, a + b, Vec3::select(keep, a, b));
        Touch {
            ahead: P::select(keep | tie, self.ahead, other.ahead),
            faces: P::select(keep | tie, self.faces, other.faces),
            count: self.count.join(other.count, keep, tie),
            on_a: sums(self.on_a, other.on_a),
            on_b: sums(self.on_b, other.on_b),
            at_a: self.at_a.join(other.at_a, keep, tie),
            at_b: self.at_b.join(other.at_b, keep, tie),
        }
    }
    /// A corner over a face, at places of both.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corner(
        ahead: P,
        over: P::Mask,
        normal: Vec3<P>,
        corner: Vec3<P>,
        (at_a, at_b): (Place<P>, Place<P>),
    ) -> Self {
        Touch {
            ahead,
            faces: P::select(over, P::one(), P::zero()),
            count: P::one(),
            on_a: corner - normal * ahead,
            on_b: corner,
            at_a,
            at_b,
        }
    }
}

/// The least over the corners of a core.
#[cfg_attr(not(debug_assertions), inline(always))]
fn least<P: Scalar, B: Core<P>>(
    b: &B,
    mut touch: impl FnMut(Vec3<P>, Place<P>) -> Touch<P>,
) -> Touch<P> {
    let corners = b.corners();
    let corners = corners.as_ref().iter().enumerate();
    let all = corners.map(|(k, &corner)| touch(corner, b.at_corner(k)));
    all.reduce(Touch::least)
        .expect("a core has at least one corner")
}

/// The face of a box that parts it best from another core.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn box_faces<P: Scalar, B: Core<P>>(a: &BoxCore<P>, b: &B) -> PartingPlane<P> {
    let face = |k: usize, low: bool| {
        let turned = |x: P| if low { -x } else { x };
        let axis = a.axes[k];
        let normal = if low { -axis } else { axis };
        let touch = least(b, |corner, there| {
            let at = a.seen(corner);
            let within = |k: usize| at[k].unsigned().at_most(a.half[k]);
            let over = within((k + 1) % 3) & within((k + 2) % 3);
            let mut parts = [P::one(), at[0], at[1], at[2]];
            parts[1 + k] = turned(a.half[k]);
            let feature = P::lit((7 - (1 << k)) as f64);
            let here = Place { parts, feature };
            Touch::corner(
                turned(at[k]) - a.half[k],
                over,
                normal,
                corner,
                (here, there),
            )
        });
        PartingPlane::new(a, b, normal, touch)
    };
    let axis = |k: usize| face(k, false).most(face(k, true));
    axis(0).most(axis(1)).most(axis(2))
}

/// A triangle, the face of a solid with a corner behind it or alone, against another core. A place on it is one of the
/// shares of its corners.
///
/// Both sides count: a solid without volume has two, and of any other one the side within parts nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn triangle_face<P: Scalar, A: Core<P>, B: Core<P>>(
    a: &A,
    b: &B,
    face: [Vec3<P>; 3],
    behind: Option<Vec3<P>>,
    place: impl Fn([P; 3]) -> Place<P>,
) -> PartingPlane<P> {
    let (u, v) = (face[1] - face[0], face[2] - face[0]);
    let normal = normal(u, v);
    let side = |unit: Vec3<P>| {
        // The corner behind is not beyond, whatever the side.
        let top = behind.map_or(P::zero(), |behind| {
            unit.dot(behind - face[0]).most(P::zero())
        });
        let touch = least(b, |corner, there| {
            let arm = corner - face[0];
            let weight = |w: Vec3<P>| w.dot(normal.long).over(normal.square);
            let (s, t) = (weight(arm.cross(v)), weight(u.cross(arm)));
            let (zero, one) = (P::zero(), P::one());
            let over = zero.at_most(s) & zero.at_most(t) & (s + t).at_most(one);
            let here = place([(one - s) - t, s, t]);
            Touch::corner(unit.dot(arm) - top, over, unit, corner, (here, there))
        });
        PartingPlane::new(a, b, unit, touch).unless(normal.none)
    };
    side(normal.unit).most(side(-normal.unit))
}

/// The normals of an edge of each core: that which parts them best; `None` where one of them has no edges.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edges_deep<P: Scalar, A: Core<P>, B: Core<P>>(
    a: &A,
    b: &B,
) -> Option<PartingPlane<P>> {
    let mut best: Option<PartingPlane<P>> = None;
    for (i, &u) in a.ways().as_ref().iter().enumerate() {
        for (j, &v) in b.ways().as_ref().iter().enumerate() {
            let normal = normal(u, v);
            for unit in [normal.unit, -normal.unit] {
                let ((on_a, at_a), (on_b, at_b)) = (a.lowest(-unit, i), b.lowest(unit, j));
                let way = on_b - on_a;
                let ahead = unit.dot(way);
                // Where the edges through both corners cross, seen along the normal.
                let one = P::one();
                let crossing = |w: Vec3<P>| {
                    let part = w.dot(normal.long).over(normal.square);
                    part.clamp(-one, one)
                };
                let (s, t) = (crossing(way.cross(v)), crossing(way.cross(u)));
                let on_a = on_a + u * s;
                let touch = Touch {
                    ahead,
                    faces: P::zero(),
                    count: one,
                    on_a,
                    on_b: on_a + unit * ahead,
                    at_a: a.along(at_a, i, s),
                    at_b: b.along(at_b, j, t),
                };
                let found = PartingPlane::new(a, b, unit, touch).unless(normal.none);
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
pub(super) fn deepest<P: Scalar, A: Core<P>, B: Core<P>>(a: &A, b: &B) -> Option<PartingPlane<P>> {
    if A::DIMENSION + B::DIMENSION < 3 {
        return None;
    }
    let (of_a, of_b) = (a.deep(b), b.deep(a).map(PartingPlane::flipped));
    let faces = match (of_a, of_b) {
        (Some(of_a), Some(of_b)) => Some(of_a.most(of_b).mean()),
        (one, other) => one.or(other).map(PartingPlane::mean),
    };
    let edges = edges_deep(a, b).map(PartingPlane::mean);
    match (faces, edges) {
        (Some(faces), Some(edges)) => {
            let more = faces.value + P::lit(MORE * P::EPSILON);
            let never = P::one().below(P::zero());
            let mut found = faces.pick(edges, edges.value.at_most(more), never);
            found.value = faces.value.most(edges.value);
            Some(found)
        }
        (one, other) => one.or(other),
    }
}
