//! The depth by which cores overlap: the plane that separates them best.
//!
//! The gap along any direction of length one is at most the signed distance, and equals it for some face's normal, or
//! some normal of two edges. A direction that is mostly rounding costs nothing.
use super::core::{BoxCore, Core3};
use super::near::normal;
use super::parting::{PartingPlane, grade};
use super::spot::{MeanSpot, Pull, Spot};
use crate::arrays::Each;
use crate::distance::share::Carry;
use crate::{Scalar, Vec3};

/// The number of roundings of the unit by which heights and vectors may differ, if all sizes are at most four.
pub(super) const SLACK: f64 = 64.0;

/// The number of roundings of the unit by which one plane must separate cores more than another, one corner be ahead of
/// another, and a foot be beyond an end.
pub(super) const MORE: f64 = 8.0;

/// The number of roundings of the unit within which edges of a box are equally far: four of a normal, and those of a
/// sum of four products with coordinates of at most four. Planes through such edges differ by up to four times that.
pub(super) const EQUAL: f64 = 32.0;

/// A corner over a face, and the spot of its foot there.
#[derive(Clone, Copy, Debug)]
struct CornerOverFace<P: Scalar> {
    ahead: P,
    /// `true` if the foot is on the face.
    on_face: P::Mask,
    corner: Vec3<P>,
    foot: Spot<P>,
    there: Spot<P>,
}

/// Returns the corners of b that are least ahead of a face of a; of equal ones those whose foot is on it, if any are.
///
/// If the only corners with a foot on the face are ones that rounding may have put ahead of the others, they are taken:
/// an edge parallel to the face meets it there, and not beyond its border.
#[cfg_attr(not(debug_assertions), inline(always))]
fn least<P: Scalar, B: Core3<P>>(
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
        CornerOverFace {
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
    let rounded = value + P::rounding(MORE, 1);
    for over in all {
        any = any | over.ahead.equals(value) & over.on_face;
        about = about | over.ahead.at_most(rounded) & over.on_face;
    }
    let about = about & !any;
    let mut found = PartingPlane {
        value,
        grade: P::select(any | about, P::lit(grade::FACE), P::lit(grade::BOUND)),
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

/// Returns both faces of a box across an axis, against another core.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn box_faces<P: Scalar, B: Core3<P>>(
    a: &BoxCore<P>,
    axis: usize,
    b: &B,
) -> PartingPlane<P> {
    let [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
    // As of two edges that are as short.
    let area = (a.half[j] + a.half[j]) * (a.half[k] + a.half[k]);
    let empty = area.at_most(P::rounding(1.0, 2));
    let sides = [false, true].each_as(|low| {
        let turned = |x: P| if low { -x } else { x };
        let normal = if low { -a.axes[axis] } else { a.axes[axis] };
        let slack = P::rounding(MORE, 1);
        let plane = least(normal, b, |corner| {
            let at = a.seen(corner);
            let within = |k: usize| at[k].unsigned().at_most(a.half[k] + slack);
            let on_face = within(j) & within(k);
            let mut parts = [P::one(), at[0], at[1], at[2]];
            parts[1 + axis] = turned(a.half[axis]);
            let feature = P::lit((7 - (1 << axis)) as f64);
            let foot = Spot { parts, feature };
            (turned(at[axis]) - a.half[axis], on_face, foot)
        });
        PartingPlane {
            grade: P::select(empty, P::lit(grade::EMPTY), plane.grade),
            area: P::select(empty, P::zero(), P::one()),
            ..plane
        }
    });
    PartingPlane::of_sides(sides)
}

/// Returns both sides of a triangle, the face of a solid with a corner behind it or alone, against another core. A spot
/// on it is one of the shares of its corners.
///
/// A solid without volume has two sides; the inner side of any other one is a bound, whose feet are on no face.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn triangle_face<P: Scalar, B: Core3<P>>(
    face: [Vec3<P>; 3],
    behind: Option<Vec3<P>>,
    b: &B,
    spot: impl Fn([P; 3]) -> Spot<P>,
) -> PartingPlane<P> {
    let (u, v) = (face[1] - face[0], face[2] - face[0]);
    let normal = normal(u, v);
    let over = P::one().over(normal.square);
    let (zero, slack) = (P::zero(), P::rounding(MORE, 1));
    // A foot is so far beyond an end as `product` is beyond zero, over the lengths of the normal and of that edge.
    let beyond = (slack * slack) * normal.square;
    let [bound_u, bound_v, bound_w] = [u, v, v - u].each_as(|w| beyond * w.length_squared());
    let within = |product: P, bound: P| zero.at_most(product) | (product * product).at_most(bound);
    // Beyond the tip of a needle a foot projects onto none of the edges: along the longest one it is beyond the end.
    let longer = |most: Vec3<P>, way: Vec3<P>| {
        let longer = most.length_squared().below(way.length_squared());
        Vec3::select(longer, way, most)
    };
    let long = longer(longer(u, v), v - u);
    let ends = [long.dot(u), long.dot(v)];
    let (low, high) = (
        ends[0].least(ends[1]).least(zero),
        ends[0].most(ends[1]).most(zero),
    );
    let past = (slack * slack) * long.length_squared();
    let sides = [normal.unit, -normal.unit].each_as(|unit| {
        // The corner behind is not beyond on either side.
        let top = behind.map_or(zero, |behind| unit.dot(behind - face[0]).most(zero));
        let plane = least(unit, b, |corner| {
            let arm = corner - face[0];
            let (s, t) = (arm.cross(v).dot(normal.long), u.cross(arm).dot(normal.long));
            let rest = (normal.square - s) - t;
            let on_face = within(s, bound_v) & within(t, bound_u) & within(rest, bound_w);
            let along = long.dot(arm);
            let out = along - along.clamp(low, high);
            // The normal of a needle has too few digits to locate a foot.
            let on_face = on_face & (out * out).at_most(past) & normal.clear;
            let (s, t) = (s * over, t * over);
            let foot = spot([(P::one() - s) - t, s, t]);
            (unit.dot(arm) - top, on_face, foot)
        });
        let inner = top.above(slack);
        let plane = PartingPlane {
            grade: P::select(inner, P::lit(grade::BOUND), plane.grade),
            ..plane
        };
        plane.unless(normal.none)
    });
    PartingPlane::of_sides(sides)
}

/// Returns both sides of the normal of an edge of each core.
#[cfg_attr(not(debug_assertions), inline(always))]
fn across_edges<P: Scalar, A: Core3<P>, B: Core3<P>>(
    (a, i, u): (&A, usize, Vec3<P>),
    (b, j, v): (&B, usize, Vec3<P>),
) -> PartingPlane<P> {
    let normal = normal(u, v);
    let over = P::one().over(normal.square);
    let slack = P::rounding(MORE, 1);
    // A point is so far beyond an end of one edge as the normal has roundings along the other.
    let beyond = (slack * slack) * over;
    let sides = [normal.unit, -normal.unit].each_as(|unit| {
        let (low_a, low_b) = (a.lowest(-unit, i), b.lowest(unit, j));
        let middle = |point: Vec3<P>, way: Vec3<P>, centered: bool| match centered {
            true => point,
            false => point + way * P::lit(0.5),
        };
        let (on_a, on_b) = (
            middle(low_a.point, u, A::CENTERED),
            middle(low_b.point, v, B::CENTERED),
        );
        let (low_a, low_b) = (
            a.beside(low_a, -unit, i, on_b),
            b.beside(low_b, unit, j, on_a),
        );
        let way = low_b.point - low_a.point;
        let ahead = unit.dot(way) + (low_a.rest + low_b.rest);
        // The crossing of the edges through both points, seen along the normal.
        let crossing = |w: Vec3<P>, other: Vec3<P>, centered: bool| {
            let (low, high) = if centered { (-0.5, 0.5) } else { (0.0, 1.0) };
            let part = w.dot(normal.long) * over;
            let held = part.clamp(P::lit(low), P::lit(high));
            let out = part - held;
            let bound = beyond * other.length_squared();
            (held, (out * out).at_most(bound))
        };
        let (s, on_a) = crossing(way.cross(v), v, A::CENTERED);
        let (t, on_b) = crossing(way.cross(u), u, B::CENTERED);
        let meet = on_a & on_b & low_a.is_edge & low_b.is_edge;
        let clear = P::select(normal.clear, P::lit(grade::EDGES), P::lit(grade::STEEP));
        let on_a = low_a.point + u * s;
        let plane = PartingPlane {
            value: ahead,
            grade: P::select(meet, clear, P::lit(grade::BOUND)),
            normal: unit,
            points: P::one(),
            on_a,
            on_b: on_a + unit * ahead,
            at_a: a.along(low_a.spot, i, s),
            at_b: b.along(low_b.spot, j, t),
            ..PartingPlane::none()
        };
        plane.unless(normal.none)
    });
    PartingPlane::of_sides(sides)
}

/// The planes that separate two cores best.
///
/// Planes that tie share the derivative. Corners and faces that tie share it if their foot is on the other face: they
/// are the corners of the region where both faces overlap. Direction and points are those of the first plane and of
/// others with its normal.
pub(super) struct Deepest<P> {
    /// The gap between a and b; negative where they overlap.
    pub value: P,
    /// The certainty that the points are on both cores: one of the [`grades`](grade).
    pub grade: P,
    /// The number of planes and points that tie.
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
    /// The derivative by the numbers of b.
    pub pull_b: Pull<P>,
    /// The direction of one of the planes that separate them best, of any grade.
    pub lead: Vec3<P>,
}

/// Returns the planes that separate two cores best; `None` where their difference has no volume.
///
/// If several planes separate them equally within rounding, those of the highest grade count: their points are on both
/// cores.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn deepest<P: Scalar, A: Core3<P>, B: Core3<P>>(a: &A, b: &B) -> Option<Deepest<P>> {
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
    let planes = || faces().chain(edges.as_ref().iter().flat_map(AsRef::as_ref));
    let (never, empty) = (P::lowest(), P::lit(grade::EMPTY));
    let value = planes().fold(never, |most, plane| most.most(plane.value));
    // If there is no other face, faces without area belong to cores whose difference has no volume.
    let part = planes().fold(never, |most, plane| {
        let counts = plane.area.above(P::zero());
        most.most(P::select(counts, plane.value, never))
    });
    let lead = planes().fold(Vec3::zero(), |lead, plane| {
        Vec3::select(plane.value.equals(value), plane.lead, lead)
    });
    let value = P::select(part.above(never), value, never);
    let about = value - P::rounding(3.0 * EQUAL, 1);
    let best = planes().fold(empty, |best, plane| {
        let counts = plane.value.at_least(about);
        best.most(P::select(counts, plane.grade, empty))
    });
    let ahead = planes().fold(never, |most, plane| {
        let counts = plane.grade.equals(best);
        most.most(P::select(counts, plane.value, never))
    });
    let mut found = Deepest {
        value,
        grade: best,
        count: P::zero(),
        normal: Vec3::zero(),
        on_a: Vec3::zero(),
        on_b: Vec3::zero(),
        at_a: Spot::none(),
        at_b: Spot::none(),
        pull_a: Pull::none(),
        pull_b: Pull::none(),
        lead,
    };
    let mut points = P::zero();
    for plane in planes() {
        let counts = plane.value.equals(ahead) & plane.grade.equals(best);
        let (zero, first) = (Vec3::zero(), counts & found.count.equals(P::zero()));
        found.count += P::select(counts, plane.points + plane.behind, P::zero());
        found.normal = Vec3::select(first, plane.normal, found.normal);
        let turn = (plane.normal - found.normal).length_squared();
        let same = counts & turn.at_most(P::rounding(SLACK, 2));
        points += P::select(same, plane.points, P::zero());
        found.on_a += Vec3::select(same, plane.on_a, zero);
        found.on_b += Vec3::select(same, plane.on_b, zero);
        found.at_a.add(same, plane.at_a.times(plane.points), first);
        found.at_b.add(same, plane.at_b.times(plane.points), first);
        let normal = Vec3::select(counts, plane.normal, zero);
        let all = |spot: Spot<P>, count: P| MeanSpot { spot, count };
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
