//! Lines and rays that are all but parallel: no farther off than a rounding of their directions puts them.
use super::draw::{Random, wide};
use super::oracle::{Vector, Wide, minus};
use geograd::distance3::{closest_points, distance};
use geograd::prelude::*;

fn cross(a: Vector, b: Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

fn dot(a: Vector, b: Vector) -> Wide {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The distance of two lines along their common normal, and the angle between them.
fn of_lines(p: Vec3<f64>, u: Vec3<f64>, q: Vec3<f64>, v: Vec3<f64>) -> (f64, f64) {
    let normal = cross(wide(u), wide(v));
    let length = dot(normal, normal).near().sqrt();
    let height = dot(normal, minus(wide(q), wide(p))).near();
    ((height / length).abs(), length / (u.length() * v.length()))
}

#[test]
fn lines_and_rays_err_by_what_a_rounding_of_a_direction_moves_them() {
    let mut random = Random(0x3141_5926_5358_9793);
    for _ in 0..6000 {
        let (u, turn) = (random.vector(1.0), random.power(-9.0, 0.0));
        let length = random.power(-0.3, 0.3);
        let v = (u + random.vector(turn))
            * if random.below(2) == 0 {
                length
            } else {
                -length
            };
        let normal = u.cross(v);
        let normal = normal * (1.0 / normal.length());
        // Rays whose nearest points are on them, and between those the common normal.
        let near = random.vector(1.0);
        let p = near - u * random.within(0.1, 3.0);
        let q = near + normal * random.within(0.1, 3.0) - v * random.within(0.1, 3.0);
        macro_rules! checked {
            ($t:ty) => {{
                let [p, u, q, v] = [p, u, q, v].map(|x| x.cast::<$t>());
                let [a, b, c, d] = [p, u, q, v].map(|x| x.cast::<f64>());
                let (right, angle) = of_lines(a, b, c, d);
                let epsilon = f64::from(<$t>::EPSILON);
                // Below that angle they count as parallel.
                if angle > 64.0 * epsilon {
                    let slack = 4.0 * epsilon * ((c - a).length() / angle + 1.0);
                    let (first, second) = (Line3::new(p, u), Line3::new(q, v));
                    for found in [distance(first, second), distance(second, first)] {
                        let error = (f64::from(found) - right).abs();
                        assert!(
                            error < slack,
                            "{found} {right} {angle} {first:?} {second:?}"
                        );
                    }
                    let points = closest_points(first, second);
                    let long = f64::from((points.on_b - points.on_a).length());
                    assert!(
                        (long - right).abs() < slack,
                        "{long} {right} {first:?} {second:?}"
                    );
                    let (first, second) = (Ray3::new(p, u), Ray3::new(q, v));
                    // The ends of what was rounded may be before a ray's start.
                    if angle > 1e3 * epsilon {
                        let error = (f64::from(distance(first, second)) - right).abs();
                        assert!(error < slack, "{right} {angle} {first:?} {second:?}");
                    }
                }
            }};
        }
        checked!(f64);
        checked!(f32);
    }
}
