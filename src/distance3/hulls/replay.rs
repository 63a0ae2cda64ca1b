//! The relation of two hulls from the features that a search found: straight lines.
use super::super::between::derived;
use super::super::core::Core;
use super::super::near::{Edge, Nearest, edge_near, normal};
use super::super::relation::{Relation, direction};
use super::super::simplex::{SimplexCore, TriangleCore, on_face};
use super::super::spot::{CoreFeatures, Pull, Spot, plain};
use super::record::{FeaturePair, HullFeatures, HullRecord};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use crate::{Scalar, Vec3};

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

fn face_and_corner<P: Scalar>(face: Corners<P>, corner: Vec3<P>, inside: bool) -> Touching<P> {
    let (u, v, arm) = (face[1] - face[0], face[2] - face[0], corner - face[0]);
    let up = normal(u, v);
    let s = arm.cross(v).dot(up.long).over(up.square);
    let rest = arm - u * s;
    let square = v.length_squared();
    let square = P::select(square.equals(P::zero()), P::one(), square);
    let t = v.dot(rest).over(square);
    let direct = rest - v * t;
    // A plane counts even if its normal has few digits.
    let by_plane = match inside {
        true => !up.none,
        false => up.clear & !up.none,
    };
    let way = Vec3::select(by_plane, up.unit * up.unit.dot(direct), direct);
    Touching {
        way,
        normal: Vec3::select(by_plane, up.unit, direction(direct)),
        on_a: corner - way,
        on_b: corner,
        at_a: on_face(0, [(P::one() - s) - t, s, t]).on(up.clear & !up.none, 8),
        at_b: Spot::corner(0),
    }
}

fn two_edges<P: Scalar>(a: Corners<P>, b: Corners<P>, inside: bool) -> Touching<P> {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let up = normal(u, v);
    let square = v.length_squared();
    let square = P::select(square.equals(P::zero()), P::one(), square);
    let s = held(w.cross(v).dot(up.long).over(up.square));
    let t = held((u.dot(v) * s - w.dot(v)).over(square));
    let direct = w + v * t - u * s;
    let by_plane = match inside {
        true => !up.none,
        false => up.clear & !up.none,
    };
    let way = Vec3::select(by_plane, up.unit * up.unit.dot(direct), direct);
    let free = up.clear & !up.none;
    let core: TriangleCore<P> = SimplexCore(a);
    Touching {
        way,
        normal: Vec3::select(by_plane, up.unit, direction(direct)),
        on_a: a[0] + u * s,
        on_b: b[0] + v * t,
        at_a: core.at_edge(0, s).on(free, 1),
        at_b: core.at_edge(0, t).on(free, 1),
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
    let (from, to) = (a.each_as(plain), b.each_as(plain));
    let found: Touching<P<S>> = match features.pair {
        FeaturePair::Corners => {
            let Nearest { apart: way, .. } = Nearest::of(to[0] - from[0], from[0], to[0]).sum;
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
        FeaturePair::FaceCorner => face_and_corner(from, to[0], inside),
        FeaturePair::CornerFace => face_and_corner(to, from[0], inside).flipped(),
        FeaturePair::Edges => two_edges(from, to, inside),
    };
    let zero = P::<S>::zero();
    let none = zero.below(zero);
    let gap = match inside {
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
fn placed<S: Scalar>(all: &[Vec3<S>], names: [u8; 3], scale: S) -> Corners<S> {
    let at = |name: u8| all.get(usize::from(name)).copied();
    names.each_as(|name| at(name).unwrap_or(Vec3::zero()) * scale)
}

/// Returns the relation of two hulls from the record of a search, in the mean of the features that tie. Where several
/// planes do, direction and points are those of the first.
pub(super) fn replay<S: Scalar>(a: &[Vec3<S>], b: &[Vec3<S>], record: &HullRecord) -> Relation<S> {
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
    let scale = scale_of::<S>(size);
    let mut mean: Option<Relation<S>> = None;
    let planes = 1 + all.iter().map(|features| features.plane).max().unwrap_or(0);
    for features in all {
        let here = placed(a, features.a, scale);
        let there = placed(b, features.b, scale);
        let own = related(features, here, there, record.inside);
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
    let back = |v: Vec3<S>| Vec3::new(v.x.over(scale), v.y.over(scale), v.z.over(scale));
    Relation {
        apart: found.apart.over(scale),
        square: found.square.over(scale).over(scale),
        normal: found.normal,
        on_a: back(found.on_a),
        on_b: back(found.on_b),
    }
}
