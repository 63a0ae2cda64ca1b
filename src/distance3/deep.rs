//! How far cores are in each other: the plane that parts them best.
//!
//! The gap along any direction of length one is at most the signed distance, and of some face's normal, or some normal
//! of two edges, it is just that. A direction that is mostly rounding costs nothing.
use super::core::{BoxCore, Core};
use super::near::normal;
use super::parting::PartingPlane;
use super::spot::{Counted, Pull, Spot};
use crate::arrays::Each;
use crate::distance::share::Carry;
use crate::{Scalar, Vec3};

/// By so many roundings of the unit, in which all is of a size of at most four, heights and ways differ.
pub(super) const SLACK: f64 = 64.0;

/// By so many roundings of the unit edges must part cores more than faces do, and corners be ahead of others.
const MORE: f64 = 8.0;

/// A corner over a face, and the spot of its foot there.
#[derive(Clone, Copy, Debug)]
struct Over<P: Scalar> {
    ahead: P,
    /// `true` if the foot is on the face.
    on_face: P::Mask,
    corner: Vec3<P>,
    foot: Spot<P>,
    there: Spot<P>,
}

/// The corners of b that are least ahead of a face of a; of equal ones those whose foot is on it, if any are.
///
/// Where only corners have a foot on it that rounding may have put ahead of the others, those are taken: an edge that is
/// parallel to the face meets it there, and not beyond its border.
#[cfg_attr(not(debug_assertions), inline(always))]
fn least<P: Scalar, B: Core<P>>(
    normal: Vec3<P>,
    b: &B,
    over: impl Fn(Vec3<P>) -> (P, P::Mask, Spot<P>),
) -> PartingPlane<P> {
    let zero = P::zero();
    let mut k = 0;
    let all = b.corners().each_as(|corner| {
        let (ahead, on_face, foot) = over(corner);
        let there = b.at_corner(k);
        k += 1;
        Over {
            ahead,
            on_face,
            corner,
            foot,
            there,
        }
    });
    let all = all.as_ref();
    let values = all.iter().map(|over| over.ahead);
    let value = values.reduce(P::least).unwrap_or_else(P::zero);
    let (mut any, mut about) = (zero.below(zero), zero.below(zero));
    let rounded = value + P::lit(MORE * P::EPSILON);
    for over in all {
        any = any | over.ahead.equals(value) & over.on_face;
        about = about | over.ahead.at_most(rounded) & over.on_face;
    }
    let about = about & !any;
    let mut found = PartingPlane {
        value,
        faces: P::select(any | about, P::one(), zero),
        normal,
        ..PartingPlane::none()
    };
    for over in all {
        let least = over.ahead.equals(value) & (over.on_face | !any);
        let beside = over.ahead.at_most(rounded) & over.on_face;
        let counts = least & !about | beside & about;
        found.points += P::select(counts, P::one(), zero);
        found.on_b += Vec3::select(counts, over.corner, Vec3::zero());
        let foot = over.corner - normal * over.ahead;
        found.on_a += Vec3::select(counts, foot, Vec3::zero());
        found.at_a.add(counts, over.foot, counts);
        found.at_b.add(counts, over.there, counts);
    }
    let share = P::one().over(found.points);
    (found.at_a, found.at_b) = (found.at_a.times(share), found.at_b.times(share));
    // The feature is the face, whichever corner it is.
    if let Some(over) = all.first() {
        found.at_a.feature = over.foot.feature;
    }
    found
}

/// Both faces of a box across an axis, against another core.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn box_faces<P: Scalar, B: Core<P>>(
    a: &BoxCore<P>,
    axis: usize,
    b: &B,
) -> PartingPlane<P> {
    PartingPlane::of_sides([false, true].each_as(|low| {
        let turned = |x: P| if low { -x } else { x };
        let normal = if low { -a.axes[axis] } else { a.axes[axis] };
        least(normal, b, |corner| {
            let at = a.seen(corner);
            let within = |k: usize| at[k].unsigned().at_most(a.half[k]);
            let on_face = within((axis + 1) % 3) & within((axis + 2) % 3);
            let mut parts = [P::one(), at[0], at[1], at[2]];
            parts[1 + axis] = turned(a.half[axis]);
            let feature = P::lit((7 - (1 << axis)) as f64);
            let foot = Spot { parts, feature };
            (turned(at[axis]) - a.half[axis], on_face, foot)
        })
    }))
}

/// Both sides of a triangle, the face of a solid with a corner behind it or alone, against another core. A spot on it is
/// one of the shares of its corners.
///
/// Both sides count: a solid without volume has two, and of any other one the side within parts nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn triangle_face<P: Scalar, B: Core<P>>(
    face: [Vec3<P>; 3],
    behind: Option<Vec3<P>>,
    b: &B,
    spot: impl Fn([P; 3]) -> Spot<P>,
) -> PartingPlane<P> {
    let (u, v) = (face[1] - face[0], face[2] - face[0]);
    let normal = normal(u, v);
    let over = P::one().over(normal.square);
    let sides = [normal.unit, -normal.unit].each_as(|unit| {
        // The corner behind is not beyond, whatever the side.
        let top = behind.map_or(P::zero(), |behind| {
            unit.dot(behind - face[0]).most(P::zero())
        });
        let plane = least(unit, b, |corner| {
            let arm = corner - face[0];
            let (s, t) = (arm.cross(v).dot(normal.long), u.cross(arm).dot(normal.long));
            let zero = P::zero();
            let on_face = zero.at_most(s) & zero.at_most(t) & (s + t).at_most(normal.square);
            let (s, t) = (s * over, t * over);
            let foot = spot([(P::one() - s) - t, s, t]);
            (unit.dot(arm) - top, on_face, foot)
        });
        plane.unless(normal.none)
    });
    PartingPlane::of_sides(sides)
}

/// Both sides of the normal of an edge of each core.
#[cfg_attr(not(debug_assertions), inline(always))]
fn across_edges<P: Scalar, A: Core<P>, B: Core<P>>(
    (a, i, u): (&A, usize, Vec3<P>),
    (b, j, v): (&B, usize, Vec3<P>),
) -> PartingPlane<P> {
    let normal = normal(u, v);
    let over = P::one().over(normal.square);
    let sides = [normal.unit, -normal.unit].each_as(|unit| {
        let ((on_a, at_a), (on_b, at_b)) = (a.lowest(-unit, i), b.lowest(unit, j));
        let way = on_b - on_a;
        let (ahead, one) = (unit.dot(way), P::one());
        // Where the edges through both corners cross, seen along the normal.
        let crossing = |w: Vec3<P>| {
            let part = w.dot(normal.long) * over;
            part.clamp(-one, one)
        };
        let (s, t) = (crossing(way.cross(v)), crossing(way.cross(u)));
        let on_a = on_a + u * s;
        let plane = PartingPlane {
            value: ahead,
            faces: P::zero(),
            normal: unit,
            points: one,
            on_a,
            on_b: on_a + unit * ahead,
            at_a: a.along(at_a, i, s),
            at_b: b.along(at_b, j, t),
            ..PartingPlane::none()
        };
        plane.unless(normal.none)
    });
    PartingPlane::of_sides(sides)
}

/// The planes that part two cores best.
///
/// Planes that tie share the derivative. Of corners and of faces that tie, those share whose foot is on the other
/// face: they are the corners of what faces each other. Direction and points are those of the first plane and of others
/// with its normal.
pub(super) struct Deepest<P> {
    /// How far b begins beyond a; negative where they overlap.
    pub value: P,
    /// How many planes and points of theirs tie.
    pub count: P,
    /// The direction from a to b.
    pub normal: Vec3<P>,
    /// The point of a.
    pub on_a: Vec3<P>,
    /// The point of b.
    pub on_b: Vec3<P>,
    /// The spot of that of a.
    pub at_a: Spot<P>,
    /// The spot of that of b.
    pub at_b: Spot<P>,
    /// The derivative of the height of a, in the mean of all that tie.
    pub pull_a: Pull<P>,
    /// That of b.
    pub pull_b: Pull<P>,
}

/// The planes that part two cores best; `None` where their difference has no volume.
///
/// Edges count where they part the cores by more than rounding more than faces do: the normal of edges that are all
/// but parallel turns too fast with them for a derivative.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn deepest<P: Scalar, A: Core<P>, B: Core<P>>(a: &A, b: &B) -> Option<Deepest<P>> {
    if A::DIMENSION + B::DIMENSION < 3 {
        return None;
    }
    let of_a = a.faces().each_as(|face| a.parting(face, b));
    let of_b = b.faces().each_as(|face| b.parting(face, a).flipped());
    let mut i = 0;
    let edges = a.ways().each_as(|u| {
        let mut j = 0;
        let planes = b.ways().each_as(|v| {
            let planes = across_edges((a, i, u), (b, j, v));
            j += 1;
            planes
        });
        i += 1;
        planes
    });
    let faces = || of_a.as_ref().iter().chain(of_b.as_ref());
    let edges = || edges.as_ref().iter().flat_map(AsRef::as_ref);
    let never = P::lit(-P::LARGEST);
    let best = |value: P, plane: &PartingPlane<P>| value.most(plane.value);
    let (by_face, by_edge) = (faces().fold(never, best), edges().fold(never, best));
    let is_edge = by_edge.above(by_face + P::lit(MORE * P::EPSILON));
    // The plane of a sliver's face beside the foot may be ahead by rounding.
    let by_foot = faces().fold(never, |value, plane| {
        let over = plane.faces.above(P::zero());
        value.most(P::select(over, plane.value, never))
    });
    let any = by_foot.above(never) & by_face.at_most(by_foot + P::lit(MORE * P::EPSILON));
    let on_face = P::select(any, P::one(), P::zero());
    let ahead = P::select(any, by_foot, by_face);
    let of_faces = faces().map(|plane| {
        let counts = plane.value.equals(ahead) & plane.faces.equals(on_face) & !is_edge;
        (plane, counts)
    });
    let of_edges = edges().map(|plane| (plane, plane.value.equals(by_edge) & is_edge));
    let mut found = Deepest {
        value: by_face.most(by_edge),
        count: P::zero(),
        normal: Vec3::zero(),
        on_a: Vec3::zero(),
        on_b: Vec3::zero(),
        at_a: Spot::none(),
        at_b: Spot::none(),
        pull_a: Pull::none(),
        pull_b: Pull::none(),
    };
    let mut points = P::zero();
    for (plane, counts) in of_faces.chain(of_edges) {
        let (zero, first) = (Vec3::zero(), counts & found.count.equals(P::zero()));
        found.count += P::select(counts, plane.points + plane.behind, P::zero());
        found.normal = Vec3::select(first, plane.normal, found.normal);
        let same = counts & plane.normal.dot(found.normal).above(P::lit(0.5));
        points += P::select(same, plane.points, P::zero());
        found.on_a += Vec3::select(same, plane.on_a, zero);
        found.on_b += Vec3::select(same, plane.on_b, zero);
        found.at_a.add(same, plane.at_a.times(plane.points), first);
        found.at_b.add(same, plane.at_b.times(plane.points), first);
        let normal = Vec3::select(counts, plane.normal, zero);
        let all = |spot: Spot<P>, count: P| Counted { spot, count };
        let (of_a, of_b) = (all(plane.at_a, plane.points), all(plane.at_b, plane.points));
        let (behind_a, behind_b) = (
            all(plane.behind_a, plane.behind),
            all(plane.behind_b, plane.behind),
        );
        found.pull_a.add(a.pull(of_a, behind_a, normal));
        found.pull_b.add(b.pull(of_b, behind_b, normal));
    }
    let (share, all) = (P::one().over(points), P::one().over(found.count));
    Some(Deepest {
        on_a: found.on_a * share,
        on_b: found.on_b * share,
        at_a: found.at_a.times(share),
        at_b: found.at_b.times(share),
        pull_a: found.pull_a.times(all),
        pull_b: found.pull_b.times(all),
        ..found
    })
}
