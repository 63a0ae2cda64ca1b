//! Two cores of space against each other, once for all functions of distance.
use super::contact::{across, parted};
use super::core::Core3;
use super::deep::{Deepest, SLACK, deepest};
use super::near::{Candidate, Nearest, edges_near};
use super::pair;
use super::parting::grade;
use super::relation::{Relation, direction};
use super::spot::{CoreFeatures, Pull, Spot, fixed, fixed_vector, valued, vanish, vanishing};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::distance::share::{Best, Carry};
use crate::{Mask, Scalar, Vec3};

/// Returns a common anchor of two cores and the scale of their extent, so that no product over- or underflows. All
/// products are of differences. Corners that were given are therefore not moved, which would round them.
#[cfg_attr(not(debug_assertions), inline(always))]
fn view<S: Scalar, A: Core3<S>, B: Core3<S>>(a: &A, b: &B) -> (Vec3<S>, S) {
    let anchor = a.anchor();
    let origin = match (A::CENTERED, B::CENTERED) {
        (true, _) => anchor,
        (_, true) => b.anchor(),
        _ => Vec3::zero(),
    };
    let size = a.extent(anchor).most(b.extent(anchor));
    (origin, scale_of::<S>(size))
}

/// Returns the relation of two cores: plain numbers decide which features are nearest, and the distance of these is
/// computed once.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn relate<S: Scalar, A: Core3<S>, B: Core3<S>>(a: A, b: B) -> Relation<S> {
    // Lanes of vectors must be inlined: their instructions are those of the calling function.
    let is_dual =
        size_of::<S::Primal>() <= size_of::<f64>() && size_of::<S>() > size_of::<S::Primal>();
    match S::RECORDS || is_dual {
        true => related_once(a, b),
        false => related(a, b),
    }
}

/// Returns the relation of two cores of symbols or of duals, whose code is long, for all functions that compute it.
#[inline(never)]
fn related_once<S: Scalar, A: Core3<S>, B: Core3<S>>(a: A, b: B) -> Relation<S> {
    related(a, b)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn related<S: Scalar, A: Core3<S>, B: Core3<S>>(a: A, b: B) -> Relation<S> {
    if let (Some(a), Some(b)) = (a.as_box(), b.as_box()) {
        return pair::relate(a, b);
    }
    let (origin, scale) = view(&a, &b);
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let found = derived(&a, &b, &choose(&a.plain(), &b.plain()));
    // Growth has the value zero and derivatives only, so values need no normal.
    let slope = |x: S| x.with_primal(S::Primal::zero());
    let growth = a.growth(found.normal) + b.growth(found.normal);
    let by_growth = found.square.root() * growth;
    let square = found.square - slope(by_growth + by_growth);
    let back = |v: Vec3<S>| {
        let v = Vec3::new(v.x.over(scale), v.y.over(scale), v.z.over(scale));
        origin + v
    };
    Relation {
        apart: (found.apart - slope(growth)).over(scale),
        square: square.over(scale).over(scale),
        normal: found.normal,
        on_a: back(found.on_a),
        on_b: back(found.on_b),
    }
}

/// Returns `true` for cores that a slab across the nearest points parts by more than roundings could feign: then no
/// plane overrules these points.
#[cfg_attr(not(debug_assertions), inline(always))]
fn are_clear<P: Scalar, A: Core3<P>, B: Core3<P>>(a: &A, b: &B, near: &Nearest<P>) -> P::Mask {
    let way = near.apart;
    let width = parted((a, near.on_a), (b, near.on_b), (way, direction(way)));
    // The best plane is known within a quarter of it, so that none has cores overlap.
    width.above(P::rounding(4.0 * SLACK, 1))
}

/// Returns the features that are nearest, or the planes that separate two cores of plain numbers best.
#[cfg_attr(not(debug_assertions), inline(always))]
fn choose<P: Scalar, A: Core3<P>, B: Core3<P>>(a: &A, b: &B) -> CoreFeatures<P> {
    let Candidate {
        near, at_a, at_b, ..
    } = nearest(a, b);
    let is_clear = A::DIMENSION + B::DIMENSION < 3 || are_clear(a, b, &near).all();
    let deep = match is_clear {
        true => None,
        false => deepest(a, b),
    };
    let found = joined(near, deep.as_ref());
    let (relation, inside) = (found.relation, found.inside);
    let none = inside & !inside;
    // A vector of the size of rounding has no direction that separates.
    let slack = P::rounding(SLACK, 1);
    let close = near.apart.length_squared().at_most(slack.squared()) & !inside;
    let (lost, beside) = match close.any() {
        true => {
            let way = (near.apart, relation.normal);
            let lost = close & parted((a, near.on_a), (b, near.on_b), way).below(-slack);
            (lost, across(a, b, relation.normal))
        }
        false => (none, relation.normal),
    };
    let chosen = CoreFeatures {
        gap: relation.apart,
        square: relation.square,
        normal: Vec3::select(lost, beside, relation.normal),
        on_a: relation.on_a,
        on_b: relation.on_b,
        at_a,
        at_b,
        inside,
        tied: none,
        pull_a: Pull::none(),
        pull_b: Pull::none(),
    };
    let Some(deep) = deep else {
        return chosen;
    };
    let lost = lost & deep.value.above(P::lowest());
    let inside = inside | lost;
    let placed = lost & deep.grade.above(P::lit(grade::STEEP));
    let pick = |lost, plane: Vec3<P>, other: Vec3<P>| Vec3::select(lost, plane, other);
    CoreFeatures {
        normal: pick(lost, deep.normal, chosen.normal),
        on_a: pick(placed, deep.on_a, chosen.on_a),
        on_b: pick(placed, deep.on_b, chosen.on_b),
        at_a: deep.at_a.join(at_a, inside, none),
        at_b: deep.at_b.join(at_b, inside, none),
        inside,
        tied: inside & deep.count.above(P::one()),
        pull_a: deep.pull_a,
        pull_b: deep.pull_b,
        ..chosen
    }
}

/// Returns the relation of the features that were chosen, with derivatives; the values are those that were found with
/// them.
///
/// A feature that is free along two directions is in a plane, whose normal turns. Along one it is a line, to which the
/// vector between the nearest points is orthogonal; along none that vector joins two fixed points. Its height along the
/// normal, held fixed, has the first derivatives of all three. The terms that are added have derivatives of second
/// order only: they are products of numbers that vanish, such as the vector's component orthogonal to the normal.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn derived<S: Scalar, A: Core3<S>, B: Core3<S>>(
    a: &A,
    b: &B,
    chosen: &CoreFeatures<S::Primal>,
) -> Relation<S> {
    let (from, to) = (a.point(chosen.at_a), b.point(chosen.at_b));
    let ((along_a, free_a), (along_b, free_b)) = (a.free(chosen.at_a), b.free(chosen.at_b));
    let lit = S::Primal::lit;
    let (zero, one) = (S::zero(), S::one());
    let none = Vec3::zero();
    let (has_a, has_b) = (free_a.above(lit(0.0)), free_b.above(lit(0.0)));
    let u = Vec3::select(has_a, along_a[0], along_b[0]);
    let second = Vec3::select(free_b.above(lit(1.0)), along_b[1], along_a[1]);
    let v = Vec3::select(has_a & has_b, along_b[0], second);
    let ways = free_a + free_b;
    let linear = ways.equals(lit(1.0));
    let normal = fixed_vector::<S>(chosen.normal);
    let way = to - from;
    let height = normal.dot(way).with_primal(chosen.gap.primal());
    let aside = vanishing(way - normal * height);

    // From a line: what is along it does not count.
    let uu = u.length_squared();
    let over = one.over(S::select(uu.above(zero), uu, one));
    let along = vanish(u.dot(way)) * over;
    let rise = S::select(linear, vanish(normal.dot(u)) * along, zero);
    let near = height - rise;
    let across = aside - Vec3::select(linear, u * along - normal * rise, none);
    let across_square = across.length_squared();
    // Duals of a tiny length pass through numbers beyond the largest one.
    let long = chosen.gap.above(S::Primal::speck()) & !chosen.inside;
    let sum = (near * near + across_square).root() + near;
    let bend = S::select(long, across_square.over(S::select(long, sum, one)), zero) - rise;

    // From a plane: the turn of its normal, where that has digits.
    let product = u.cross(v);
    let clear = product
        .length_squared()
        .above(uu * v.length_squared() * S::rounding(1.0, 1));
    // A gap whose square vanishes has no normal to turn.
    let lead = normal.dot(product);
    let planar = ways.equals(lit(2.0)) & clear & lead.unsigned().above(zero);
    let side = one.signed_as(fixed(lead.primal()));
    let lead = S::select(planar, lead * side, one);
    let turn = vanishing((product - normal * normal.dot(product)) * side);
    let turn = Vec3::select(planar, turn, none);
    let tilt = turn.length_squared();
    let size = (lead * lead + tilt).root();
    let tip = turn.dot(aside).over(size) - (height * tilt).over(size * (size + lead));

    let others = b.height(chosen.pull_b) - a.height(chosen.pull_a);
    let others = S::select(chosen.tied, vanish(others - normal.dot(way)), zero);
    let by_plane = planar | chosen.inside;
    let gap = height + S::select(by_plane, tip, bend) + others;
    let gap = gap.with_primal(chosen.gap.primal());
    let square = S::select(by_plane, gap * gap, near * near + across_square);
    let overlap = chosen.inside & chosen.gap.below(lit(0.0));
    let square = S::select(overlap, zero, square).with_primal(chosen.square.primal());
    let length = S::select(long, gap, one);
    let still = normal + Vec3::select(long, across, none) * one.over(length);
    let bent = still - normal * (bend + rise).over(length);
    let tilted = (normal * lead + turn) * one.over(size);
    let direction = Vec3::select(by_plane, tilted, bent);
    let direction = valued(direction, chosen.normal);

    // Points on two edges slide, others are fixed or the foot of such.
    let both = planar & has_a & has_b;
    let off = |x: Vec3<S>| x - u * (u.dot(x) * over);
    let beside = off(v);
    let base = S::select(both, beside.length_squared(), one);
    let t = S::select(both, off(way).dot(beside).over(base), zero);
    let step = Vec3::select(by_plane, direction * gap, normal * near + across);
    let foot = has_b & !has_a;
    let on_b = Vec3::select(foot, from + step, to - v * t);
    let on_a = Vec3::select(foot, from, on_b - step);
    Relation {
        apart: gap,
        square,
        normal: direction,
        on_a: valued(on_a, chosen.on_a),
        on_b: valued(on_b, chosen.on_b),
    }
}

/// Returns the nearest points of two cores that do not overlap, in the mean of all that tie.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nearest<P: Scalar, A: Core3<P>, B: Core3<P>>(a: &A, b: &B) -> Candidate<P> {
    let mut n = 0;
    // A point is only a corner, which the other core's edges have been compared with.
    if A::DIMENSION == 0 {
        let point = a.anchor();
        return b.near(point, Spot::corner(0)).flipped();
    }
    let of_b = b.corners().each_as(|corner| {
        n += 1;
        a.near(corner, b.at_corner(n - 1))
    });
    if B::DIMENSION == 0 {
        return of_b.as_ref()[0];
    }
    n = 0;
    let of_a = a.corners().each_as(|corner| {
        n += 1;
        b.near(corner, a.at_corner(n - 1)).flipped()
    });
    let mut i = 0;
    let edges = a.edges().each_as(|first| {
        let mut j = 0;
        let row = b.edges().each_as(|second| {
            let (near, [s, t], clear) = edges_near(first, second);
            let spots = [a.at_edge(i, s), b.at_edge(j, t)];
            let [here, there] = spots.each_as(|spot| Spot {
                feature: P::select(clear, spot.feature, P::zero()),
                ..spot
            });
            j += 1;
            Candidate::new(near, here, there)
        });
        i += 1;
        row
    });
    let edges = edges.as_ref().iter().flat_map(AsRef::as_ref);
    let all = of_b.as_ref().iter().chain(of_a.as_ref()).chain(edges);
    let squares = all.clone().map(|one| one.square);
    let least = squares.fold(P::largest(), P::least);
    let mut count = P::zero();
    let mut sum = Candidate::none(least);
    for one in all {
        count += sum.add(one);
    }
    sum.times(P::one().over(count))
}

/// Returns the relation by the nearest points, or by the plane that separates two cores best.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn joined<S: Scalar>(near: Nearest<S>, deep: Option<&Deepest<S>>) -> CoreRelation<S> {
    let given = near.normal.length_squared().above(S::zero());
    let length = near.apart.length();
    // The mean of normals, of which some are none, is shorter than one.
    let direction = direction(Vec3::select(given, near.normal, near.apart));
    // Duals of a tiny length pass through numbers beyond the largest one.
    let along = near.apart.dot(direction.constant());
    let along = along.with_primal(length.primal());
    let length = S::select(length.at_most(S::speck()), along, length);
    let none = length.at_most(S::zero());
    let square = near.apart.length_squared();
    let Some(deep) = deep else {
        // Without a volume nothing overlaps.
        let relation = Relation {
            apart: length,
            square,
            normal: direction,
            on_a: near.on_a,
            on_b: near.on_b,
        };
        let inside = none & !none;
        return CoreRelation { relation, inside };
    };
    let parted = deep.value.above(S::lowest());
    // Shifted by their depth, cores that overlap touch, and then a corner or an edge of one is on the other: without
    // the shift it is no farther from there than the depth. Faces too small to count would have separated all others.
    let reachable = (S::rounding(SLACK, 1) - deep.value) - deep.value;
    let behind = deep.value.below(S::zero()) & length.at_most(reachable);
    // For a point on a face, its height and the plane decide the side with different roundings. Few shapes are so
    // close, and batches leave out what only these need.
    let slack = S::rounding(SLACK, 1);
    let close = square.at_most(slack.squared());
    let against = direction.dot(deep.lead).below(S::zero());
    let opposite = close & !deep.value.below(S::zero()) & against;
    let inside = parted & (behind | none | opposite);
    // Cores with a point in common are not apart, however the height over a face was rounded.
    let rounded = none & deep.value.above(S::zero());
    let ahead = S::select(rounded, S::zero(), deep.value);
    let overlap = parted & (behind | none) & deep.value.below(S::zero());
    // Nearest points of cores that touch are on both. This need not hold for a plane that only bounds, nor where nearly
    // parallel edges cross.
    let touching = length.at_most(slack) & (-deep.value).at_most(slack);
    let placed = inside & !(touching & deep.grade.at_most(S::lit(grade::STEEP)));
    let relation = Relation {
        apart: S::select(inside, ahead, length),
        square: S::select(overlap, S::zero(), square),
        normal: Vec3::select(inside, deep.normal, direction),
        on_a: Vec3::select(placed, deep.on_a, near.on_a),
        on_b: Vec3::select(placed, deep.on_b, near.on_b),
    };
    CoreRelation { relation, inside }
}

/// A relation, and `true` if a plane gives it.
pub(super) struct CoreRelation<S: Scalar> {
    pub relation: Relation<S>,
    pub inside: S::Mask,
}

/// Returns the largest squared distance of a corner of one core from one of another; ties share the derivative.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn farthest<S: Scalar, A: Core3<S>, B: Core3<S>>(a: A, b: B) -> S {
    if let (Some(a), Some(b)) = (a.as_box(), b.as_box()) {
        return pair::farthest(a, b);
    }
    let (origin, scale) = view(&a, &b);
    let (a, b) = (a.placed(origin, scale), b.placed(origin, scale));
    let (from, to) = (a.corners(), b.corners());
    let squares = from.as_ref().iter().flat_map(|&p| {
        let to = to.as_ref().iter();
        to.map(move |&q| {
            let square = (q - p).length_squared();
            Best::of(square, square)
        })
    });
    Best::most_of(squares).mean().root().over(scale)
}
