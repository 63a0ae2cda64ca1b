//! Replays along the record of a nearest feature: straight lines.
use super::face_measure::{FaceFeature, THIN};
use crate::twofold::{cross, deep, way};
use crate::{Mask, Scalar, Triangle3, Vec3};

/// The closest point in terms of the corners' offsets from the query.
struct Foot<S> {
    /// The closest point less the query.
    offset: Vec3<S>,
    /// The closest point.
    point: Vec3<S>,
}

/// Returns the normal of twice the area; its value has twice the digits where a triangle is thin, so that it keeps its
/// normal.
#[inline(always)]
fn sharp_normal<S: Scalar>(triangle: Triangle3<S>) -> Vec3<S> {
    let plain = triangle.twice_area_normal();
    let (a, b, c) = (primal(triangle.a), primal(triangle.b), primal(triangle.c));
    let x = (b - a).length_squared();
    let y = (c - a).length_squared();
    let z = (c - b).length_squared();
    let value = primal(plain);
    let thin =
        (value.length_squared() * x.least(y).least(z)).at_most(S::Primal::lit(THIN) * (x * y * z));
    if !thin.any() {
        return plain;
    }
    let [a, b, c] = [deep(triangle.a), deep(triangle.b), deep(triangle.c)];
    let one = S::Primal::one();
    let [x, y, z] = cross(way(a, b, one), way(a, c, one));
    Vec3::new(
        plain.x.with_primal(S::Primal::select(thin, x, value.x)),
        plain.y.with_primal(S::Primal::select(thin, y, value.y)),
        plain.z.with_primal(S::Primal::select(thin, z, value.z)),
    )
}

#[inline(always)]
fn primal<S: Scalar>(v: Vec3<S>) -> Vec3<S::Primal> {
    Vec3::new(v.x.primal(), v.y.primal(), v.z.primal())
}

/// Returns a divisor that is not zero.
#[inline(always)]
fn safe<S: Scalar>(x: S) -> S {
    S::select(x.equals(S::zero()), S::one(), x)
}

#[inline(always)]
fn corner<S: Scalar>(triangle: Triangle3<S>, k: u8) -> Vec3<S> {
    match k {
        0 => triangle.a,
        1 => triangle.b,
        _ => triangle.c,
    }
}

#[inline(always)]
fn foot<S: Scalar>(point: Vec3<S>, triangle: Triangle3<S>, feature: FaceFeature) -> Foot<S> {
    match feature {
        FaceFeature::Interior => {
            let n = sharp_normal(triangle);
            let height = n.dot(triangle.a - point).over(safe(n.length_squared()));
            let offset = n * height;
            Foot {
                offset,
                point: point + offset,
            }
        }
        FaceFeature::Edge { from, to } => {
            let (start, end) = (corner(triangle, from), corner(triangle, to));
            let (edge, arm) = (end - start, point - start);
            let along = edge.dot(arm).over(safe(edge.length_squared()));
            Foot {
                offset: edge * along - arm,
                point: start + edge * along,
            }
        }
        FaceFeature::Vertex { corner: k } => {
            let corner = corner(triangle, k);
            Foot {
                offset: corner - point,
                point: corner,
            }
        }
    }
}

/// Returns the point of a face's feature that is nearest to a point: of the plane, of the line through the edge, or the
/// corner.
#[must_use]
#[inline]
pub fn closest_replay<S: Scalar>(
    point: Vec3<S>,
    triangle: Triangle3<S>,
    feature: FaceFeature,
) -> Vec3<S> {
    foot(point, triangle, feature).point.canonical()
}

/// Returns the distance of a point from a face's feature. Derivative zero at distance zero.
#[must_use]
#[inline]
pub fn distance_replay<S: Scalar>(
    point: Vec3<S>,
    triangle: Triangle3<S>,
    feature: FaceFeature,
) -> S {
    match feature {
        FaceFeature::Interior => height_replay(point, triangle).magnitude(),
        _ => foot(point, triangle, feature).offset.length(),
    }
}

/// Returns the height of a point over the plane of a face, positive on the side of its normal. It is smooth through the
/// plane.
#[must_use]
#[inline]
pub fn height_replay<S: Scalar>(point: Vec3<S>, triangle: Triangle3<S>) -> S {
    let n = sharp_normal(triangle);
    n.dot(point - triangle.a).over(safe(n.length()))
}

/// Returns the squared distance of a point from a face's feature; smooth also at distance zero.
#[must_use]
#[inline]
pub fn squared_distance_replay<S: Scalar>(
    point: Vec3<S>,
    triangle: Triangle3<S>,
    feature: FaceFeature,
) -> S {
    foot(point, triangle, feature)
        .offset
        .length_squared()
        .canonical()
}

/// Returns the unit vector from the closest point to the query, or the face's normal where the query is over the
/// interior; zero at distance zero from an edge or a corner.
#[must_use]
#[inline]
pub fn normal_replay<S: Scalar>(
    point: Vec3<S>,
    triangle: Triangle3<S>,
    feature: FaceFeature,
) -> Vec3<S> {
    match feature {
        FaceFeature::Interior => sharp_normal(triangle).normalize_or_zero().canonical(),
        _ => (-foot(point, triangle, feature).offset)
            .normalize_or_zero()
            .canonical(),
    }
}
