//! Adjoints of what points and rays find on a mesh, along the record of a search.
//!
//! A foot `f` on a face is the sum of its corners, each times its weight `w`; the normal is `n`, of length one.
//!
//! *Distances.* At the foot `p − f` is normal to the feature, so that the distance does not depend on where the foot is
//! along it: with the unit vector `u` from the foot, the derivative is `u` by the point and `−w u` by a corner. The
//! height over a plane has `n` for `u`.
//!
//! *Closest points.* A moved point moves the foot by its share along the feature. On a face, a corner moved along the
//! normal lifts the foot by its weight, and tilts the plane: the foot moves by the height times the weight's gradient
//! `g`. So with the cotangent `c` the corner has `n (w n·c + h g·c)`, and the point has `c` without its part along `n`.
//! On an edge `e` from `s` to `t`, with the foot at the share `k`, `r = p − f` and `τ = e·c / e²`, the point has `τ e`,
//! the end `k (c − τ e) + τ r`, the start `(1 − k) (c − τ e) − τ r`.
//!
//! *Hits.* The parameter of a ray is `n·(a − o) / n·d`. With `s` the cotangent over `n·d`, the start has `−s n`, the
//! direction that times the parameter, and a corner `w s n`.
//!
//! All are in double precision, for vertices of either format.
use crate::mesh::{FaceFeature, normal};
use crate::{Ray3, Vec3};

/// The cotangents of a query and of the corners of the face that it found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceBars<Q> {
    /// The cotangent of the query.
    pub query: Q,
    /// The cotangents of the corners.
    pub corners: [Vec3<f64>; 3],
}

impl FaceBars<Vec3<f64>> {
    fn none() -> Self {
        FaceBars {
            query: Vec3::zero(),
            corners: [Vec3::zero(); 3],
        }
    }
}

/// A foot on a feature.
struct Foot {
    /// The query less the foot.
    offset: Vec3<f64>,
    weights: [f64; 3],
}

/// Returns the share of an edge at which the foot is.
fn share(point: Vec3<f64>, start: Vec3<f64>, edge: Vec3<f64>) -> f64 {
    let square = edge.length_squared();
    if square > 0.0 {
        edge.dot(point - start) / square
    } else {
        0.0
    }
}

/// Returns the weights of the corners at the foot of a point on a plane with a normal, of any length but zero.
fn weights(point: Vec3<f64>, [a, b, c]: [Vec3<f64>; 3], n: Vec3<f64>) -> [f64; 3] {
    let square = n.length_squared();
    [(b, c - b), (c, a - c), (a, b - a)]
        .map(|(corner, edge)| (corner - point).cross(edge).dot(n) / square)
}

fn foot(point: Vec3<f64>, triangle: [Vec3<f64>; 3], feature: FaceFeature) -> Foot {
    let mut own = [0.0; 3];
    let offset = match feature {
        FaceFeature::Vertex { corner } => {
            own[usize::from(corner)] = 1.0;
            point - triangle[usize::from(corner)]
        }
        FaceFeature::Edge { from, to } => {
            let start = triangle[usize::from(from)];
            let edge = triangle[usize::from(to)] - start;
            let k = share(point, start, edge);
            own[usize::from(from)] = 1.0 - k;
            own[usize::from(to)] = k;
            point - start - edge * k
        }
        FaceFeature::Interior => {
            let n = normal(triangle);
            let square = n.length_squared();
            if square <= 0.0 {
                own[0] = 1.0;
                return Foot {
                    offset: Vec3::zero(),
                    weights: own,
                };
            }
            own = weights(point, triangle, n);
            n * (n.dot(point - triangle[0]) / square)
        }
    };
    Foot {
        offset,
        weights: own,
    }
}

fn along(u: Vec3<f64>, weights: [f64; 3]) -> FaceBars<Vec3<f64>> {
    FaceBars {
        query: u,
        corners: weights.map(|w| u * -w),
    }
}

/// Returns the adjoint of [`distance_replay`](crate::mesh::distance_replay); zero at distance zero.
#[must_use]
pub fn distance_vjp(
    point: Vec3<f64>,
    triangle: [Vec3<f64>; 3],
    feature: FaceFeature,
    bar: f64,
) -> FaceBars<Vec3<f64>> {
    let foot = foot(point, triangle, feature);
    along(foot.offset.normalize_or_zero() * bar, foot.weights)
}

/// Returns the adjoint of [`squared_distance_replay`](crate::mesh::squared_distance_replay).
#[must_use]
pub fn squared_distance_vjp(
    point: Vec3<f64>,
    triangle: [Vec3<f64>; 3],
    feature: FaceFeature,
    bar: f64,
) -> FaceBars<Vec3<f64>> {
    let foot = foot(point, triangle, feature);
    along(foot.offset * (2.0 * bar), foot.weights)
}

/// Returns the adjoint of the height over the plane of a face; zero for a face without area.
#[must_use]
pub fn height_vjp(point: Vec3<f64>, triangle: [Vec3<f64>; 3], bar: f64) -> FaceBars<Vec3<f64>> {
    let n = normal(triangle);
    if n.length_squared() <= 0.0 {
        return FaceBars::none();
    }
    along(n.normalize_or_zero() * bar, weights(point, triangle, n))
}

/// Returns the adjoint of [`closest_replay`](crate::mesh::closest_replay).
#[must_use]
pub fn closest_vjp(
    point: Vec3<f64>,
    triangle: [Vec3<f64>; 3],
    feature: FaceFeature,
    bar: Vec3<f64>,
) -> FaceBars<Vec3<f64>> {
    let mut bars = FaceBars::none();
    match feature {
        FaceFeature::Vertex { corner } => bars.corners[usize::from(corner)] = bar,
        FaceFeature::Edge { from, to } => {
            let (from, to) = (usize::from(from), usize::from(to));
            let start = triangle[from];
            let edge = triangle[to] - start;
            let k = share(point, start, edge);
            let square = edge.length_squared();
            let tau = if square > 0.0 {
                edge.dot(bar) / square
            } else {
                0.0
            };
            let rest = bar - edge * tau;
            let turn = (point - start - edge * k) * tau;
            bars.query = edge * tau;
            bars.corners[from] = rest * (1.0 - k) - turn;
            bars.corners[to] = rest * k + turn;
        }
        FaceFeature::Interior => {
            let n = normal(triangle);
            let square = n.length_squared();
            if square <= 0.0 {
                return bars;
            }
            let weights = weights(point, triangle, n);
            let [a, b, c] = triangle;
            let lift = n.dot(bar) / square;
            let height = n.dot(point - a) / square;
            bars.query = bar - n * lift;
            for (k, edge) in [c - b, a - c, b - a].into_iter().enumerate() {
                let tilt = n.cross(edge).dot(bar) / square;
                bars.corners[k] = n * (weights[k] * lift + height * tilt);
            }
        }
    }
    bars
}

/// Returns the cotangents of a ray that misses: zeros.
#[must_use]
pub fn no_hit() -> FaceBars<Ray3<f64>> {
    let zero = Vec3::zero();
    FaceBars {
        query: Ray3 {
            point: zero,
            direction: zero,
        },
        corners: [zero; 3],
    }
}

/// Returns the adjoint of the parameter of [`first_hit_triangle`](crate::intersection3::first_hit_triangle), where it
/// hits; zero for a face that the ray sees edge-on.
#[must_use]
pub fn hit_vjp(ray: Ray3<f64>, triangle: [Vec3<f64>; 3], bar: f64) -> FaceBars<Ray3<f64>> {
    let Ray3 { point, direction } = ray;
    let n = normal(triangle);
    let slope = n.dot(direction);
    if slope == 0.0 {
        return no_hit();
    }
    let [a, b, c] = triangle.map(|corner| corner - point);
    let by = n * (bar / slope);
    let parameter = n.dot(a) / slope;
    FaceBars {
        query: Ray3 {
            point: -by,
            direction: by * -parameter,
        },
        corners: [(b, c), (c, a), (a, b)]
            .map(|(p, q)| by * (p.cross(q - p).dot(direction) / slope)),
    }
}
