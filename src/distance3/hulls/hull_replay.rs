//! The relation of two hulls from the features that a search found: straight lines.
use super::super::between::derived;
use super::super::core::Core3;
use super::super::near::{Edge, edge_near};
use super::super::relation::{Relation, direction};
use super::super::simplex::{SimplexCore, TriangleCore, on_face};
use super::super::spot::{CoreFeatures, Pull, Spot, plain};
use super::CornerList;
use super::hull_record::{FeaturePair, HullFeatures, HullRecord};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::{Scalar, Vec3, twofold};

/// The corners of a feature.
type Corners<S> = [Vec3<S>; 3];

/// Returns a point on each of two features, and their spots.
struct Touching<P: Scalar> {
    /// The vector from a to b.
    way: Vec3<P>,
    /// Its direction, or that of the plane.
    normal: Vec3<P>,
    on_a: Vec3<P>,
    on_b: Vec3<P>,
    at_a: Spot<P>,
    at_b: Spot<P>,
}

impl<P: Scalar> Touching<P> {
    fn flipped(self) -> Self {
        Touching {
            way: -self.way,
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            at_a: self.at_b,
            at_b: self.at_a,
        }
    }
}

/// Returns the number inside bounds that is nearest to one, without derivatives.
fn held<P: Scalar>(t: P) -> P {
    let (zero, one) = (P::zero(), P::one());
    let t = P::select(t.below(zero), zero, t);
    P::select(one.below(t), one, t)
}

fn edge_and_corner<P: Scalar>(edge: Corners<P>, corner: Vec3<P>) -> Touching<P> {
    let (near, t, free) = edge_near(Edge::between(edge[0], edge[1]), corner);
    let way = near.sum.apart;
    let core: TriangleCore<P> = SimplexCore(edge);
    Touching {
        way,
        normal: direction(way),
        on_a: near.sum.on_a,
        on_b: corner,
        at_a: core.at_edge(0, t).on(free, 1),
        at_b: Spot::corner(0),
    }
}

/// A direction across two vectors, from exact differences: even a needle's has all digits.
struct Across<P: Scalar> {
    /// The cross product.
    long: Vec3<P>,
    /// The square of its length; one if it counts as none.
    square: P,
    /// The direction, of length one; zero if there is none.
    unit: Vec3<P>,
    /// `true` if the product counts as none: the features are parallel or points.
    none: P::Mask,
    /// `true` if a plain product has half the digits of the format, so that its derivatives have some.
    clear: P::Mask,
}

impl<P: Scalar<Primal = P>> Across<P> {
    /// Returns the direction across the vectors between the points of two pairs.
    fn new([a, b]: [Vec3<P>; 2], [c, d]: [Vec3<P>; 2]) -> Self {
        let one = P::one();
        let vector = |from, to| twofold::way(twofold::deep(from), twofold::deep(to), one);
        let [x, y, z] = twofold::cross(vector(a, b), vector(c, d));
        let long = Vec3::new(x, y, z);
        let square = long.length_squared();
        let none = square.at_most(P::rounding(1.0, 4));
        let squares = (b - a).length_squared() * (d - c).length_squared();
        let clear = square.above(squares * P::rounding(1.0, 1)) & !none;
        let square = P::select(none, one, square);
        let over = one.over(square.root());
        let unit = Vec3::select(none, Vec3::zero(), long * over);
        Across {
            long,
            square,
            unit,
            none,
            clear,
        }
    }
    /// Returns the part of a vector between both features along the direction, and its direction; the vector itself
    /// and its own direction if there is none.
    fn along(&self, way: Vec3<P>, direct: Vec3<P>) -> (Vec3<P>, Vec3<P>) {
        (
            Vec3::select(self.none, direct, self.unit * self.unit.dot(way)),
            Vec3::select(self.none, direction(direct), self.unit),
        )
    }
}

/// Returns a length squared as a divisor: one for zero.
fn divisor<P: Scalar>(v: Vec3<P>) -> P {
    let square = v.length_squared();
    P::select(square.equals(P::zero()), P::one(), square)
}

fn face_and_corner<P: Scalar<Primal = P>>(face: Corners<P>, corner: Vec3<P>) -> Touching<P> {
    let (u, v, arm) = (face[1] - face[0], face[2] - face[0], corner - face[0]);
    let up = Across::new([face[0], face[1]], [face[0], face[2]]);
    let s = arm.cross(v).dot(up.long).over(up.square);
    // The shares of a needle's corners are mostly rounding.
    let s = P::select(up.clear, s, held(s));
    let rest = arm - u * s;
    let t = v.dot(rest).over(divisor(v));
    let left = P::one() - s;
    let bounded = P::select(left.below(held(t)), left, held(t));
    let t = P::select(up.clear, t, bounded);
    let (way, normal) = up.along(arm, rest - v * t);
    Touching {
        way,
        normal,
        on_a: corner - way,
        on_b: corner,
        at_a: on_face(0, [left - t, s, t]).on(up.clear, 8),
        at_b: Spot::corner(0),
    }
}

fn two_edges<P: Scalar<Primal = P>>(a: Corners<P>, b: Corners<P>) -> Touching<P> {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let up = Across::new([a[0], a[1]], [b[0], b[1]]);
    let s = held(w.cross(v).dot(up.long).over(up.square));
    let t = held((u.dot(v) * s - w.dot(v)).over(divisor(v)));
    // Edges that are all but parallel give any first point, which may lie beside an end of the other edge.
    let again = held(u.dot(w + v * t).over(divisor(u)));
    let s = P::select(up.clear, s, again);
    let (way, normal) = up.along(w, w + v * t - u * s);
    let core: TriangleCore<P> = SimplexCore(a);
    Touching {
        way,
        normal,
        on_a: a[0] + u * s,
        on_b: b[0] + v * t,
        at_a: core.at_edge(0, s).on(up.clear, 1),
        at_b: core.at_edge(0, t).on(up.clear, 1),
    }
}

/// Returns the points of two features, by their corners.
fn touching<P: Scalar<Primal = P>>(
    pair: FeaturePair,
    from: Corners<P>,
    to: Corners<P>,
) -> Touching<P> {
    match pair {
        FeaturePair::Corners => {
            let way = to[0] - from[0];
            Touching {
                way,
                normal: direction(way),
                on_a: from[0],
                on_b: to[0],
                at_a: Spot::corner(0),
                at_b: Spot::corner(0),
            }
        }
        FeaturePair::EdgeCorner => edge_and_corner(from, to[0]),
        FeaturePair::CornerEdge => edge_and_corner(to, from[0]).flipped(),
        FeaturePair::FaceCorner => face_and_corner(from, to[0]),
        FeaturePair::CornerFace => face_and_corner(to, from[0]).flipped(),
        FeaturePair::Edges => two_edges(from, to),
    }
}

/// Returns the relation of two features.
fn related<S: Scalar>(
    features: &HullFeatures,
    a: Corners<S>,
    b: Corners<S>,
    inside: bool,
) -> Relation<S> {
    type P<S> = <S as Scalar>::Primal;
    let found: Touching<P<S>> = touching(features.pair, a.each_as(plain), b.each_as(plain));
    let zero = P::<S>::zero();
    let none = zero.below(zero);
    let by_plane = match features.pair {
        FeaturePair::Corners | FeaturePair::CornerEdge | FeaturePair::EdgeCorner => false,
        FeaturePair::CornerFace | FeaturePair::FaceCorner | FeaturePair::Edges => true,
    };
    let gap = match by_plane {
        true => found.normal.dot(found.way),
        false => found.way.length(),
    };
    let behind = gap.below(zero);
    let chosen = CoreFeatures {
        gap,
        square: P::<S>::select(behind, zero, gap * gap),
        normal: found.normal,
        on_a: found.on_a,
        on_b: found.on_b,
        at_a: found.at_a,
        at_b: found.at_b,
        inside: match inside {
            true => !none,
            false => none,
        },
        tied: none,
        pull_a: Pull::none(),
        pull_b: Pull::none(),
    };
    derived::<S, TriangleCore<S>, TriangleCore<S>>(&SimplexCore(a), &SimplexCore(b), &chosen)
}

/// Returns the corners of a feature in units of their size.
fn placed<S: Scalar>(all: &impl CornerList<S>, names: [u8; 3], scale: S) -> Corners<S> {
    let count = all.count();
    names.each_as(|name| all.at(usize::from(name).min(count - 1)) * scale)
}

/// Returns the units of features: a power of two in which the largest of them has a size of about one.
fn scale_of_features<S: Scalar>(
    a: &impl CornerList<S>,
    b: &impl CornerList<S>,
    record: &HullRecord,
) -> S {
    let all = record.features();
    let one = S::one();
    let from = placed(a, all[0].a, one)[0];
    let mut size = S::Primal::zero();
    for features in all {
        for corner in placed(a, features.a, one)
            .into_iter()
            .chain(placed(b, features.b, one))
        {
            let arm = corner - from;
            let own = largest([arm.x, arm.y, arm.z]);
            size = S::Primal::select(size.below(own), own, size);
        }
    }
    scale_of::<S>(size)
}

/// The share of a feature's corners in a signed distance.
pub(super) struct FeatureShares<P: Scalar> {
    /// The direction from a to b.
    pub normal: Vec3<P>,
    /// The corners of a, by their numbers, and their shares.
    pub of_a: [(usize, P); 3],
    /// The corners of b and their shares.
    pub of_b: [(usize, P); 3],
}

/// Returns the direction of every feature of a record, and the shares of its corners in the points that touch.
pub(super) fn shares<P: Scalar<Primal = P>>(
    a: &impl CornerList<P>,
    b: &impl CornerList<P>,
    record: &HullRecord,
) -> Vec<FeatureShares<P>> {
    let scale = scale_of_features(a, b, record);
    let one = |features: &HullFeatures| {
        let found = touching(
            features.pair,
            placed(a, features.a, scale),
            placed(b, features.b, scale),
        );
        let shares = |names: [u8; 3], count: usize, Spot { parts, .. }: Spot<P>| {
            // The first corner has what the others leave.
            let shares = [P::one() - parts[1] - parts[2], parts[1], parts[2]];
            let named = |k: usize| usize::from(names[k]).min(count - 1);
            [0, 1, 2].each_as(|k| (named(k), shares[k]))
        };
        FeatureShares {
            normal: found.normal,
            of_a: shares(features.a, a.count(), found.at_a),
            of_b: shares(features.b, b.count(), found.at_b),
        }
    };
    record.features().iter().map(one).collect()
}

/// Returns the mean of directions with length one: in a gap that is mostly rounding they differ. Any mean of directions
/// that separate hulls does so, too. Of opposite ones the first counts.
fn lengthened<S: Scalar>(mean: Vec3<S>, first: Vec3<S>) -> Vec3<S> {
    let square = mean.length_squared();
    let whole = S::one() - S::rounding(64.0, 1);
    let opposite = square.below(S::lit(0.25));
    let safe = S::select(opposite, S::one(), square);
    let unit = mean * S::one().over(safe.root());
    let unit = Vec3::select(opposite, first, unit);
    Vec3::select(square.below(whole), unit, mean)
}

/// Returns the relation of two hulls from the record of a search, in the mean of the features that tie. Where several
/// planes do, direction and points are those of the first.
pub(super) fn replay<S: Scalar>(
    a: &impl CornerList<S>,
    b: &impl CornerList<S>,
    record: &HullRecord,
) -> Relation<S> {
    let all = record.features();
    let scale = scale_of_features(a, b, record);
    let of = |features: &HullFeatures| {
        let here = placed(a, features.a, scale);
        let there = placed(b, features.b, scale);
        related(features, here, there, record.inside)
    };
    let found = match all {
        [alone] => of(alone),
        _ => mean_of(all, of),
    };
    // A power of two has an exact reciprocal.
    let back = S::one().over(scale);
    Relation {
        apart: found.apart * back,
        square: found.square * back * back,
        normal: found.normal,
        on_a: found.on_a * back,
        on_b: found.on_b * back,
    }
}

/// Returns the mean of the relations of several features.
fn mean_of<S: Scalar>(
    all: &[HullFeatures],
    of: impl Fn(&HullFeatures) -> Relation<S>,
) -> Relation<S> {
    let mut mean: Option<Relation<S>> = None;
    let planes = 1 + all.iter().map(|features| features.plane).max().unwrap_or(0);
    for features in all {
        let own = of(features);
        let count = all.iter().filter(|other| other.plane == features.plane);
        let count = count.count() as f64;
        let share = S::lit(1.0 / (count * f64::from(planes)));
        let place = if features.plane == 0 {
            1.0 / count
        } else {
            0.0
        };
        let place = S::lit(place);
        let (apart, square) = (own.apart * share, own.square * share);
        mean = Some(match (mean, features.plane) {
            (None, _) => Relation {
                apart,
                square,
                normal: own.normal * place,
                on_a: own.on_a * place,
                on_b: own.on_b * place,
            },
            (Some(sum), 0) => Relation {
                apart: sum.apart + apart,
                square: sum.square + square,
                normal: sum.normal + own.normal * place,
                on_a: sum.on_a + own.on_a * place,
                on_b: sum.on_b + own.on_b * place,
            },
            (Some(sum), _) => Relation {
                apart: sum.apart + apart,
                square: sum.square + square,
                ..sum
            },
        });
    }
    let found = mean.unwrap_or_else(|| unreachable!("a record has a feature"));
    Relation {
        normal: lengthened(found.normal, of(&all[0]).normal),
        ..found
    }
}
