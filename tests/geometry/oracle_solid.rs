//! An independent oracle for volumes of intersection: the faces of both boxes, each clipped by the other
//! box's planes (Sutherland-Hodgman), and the divergence theorem, in fixed-point numbers of 256 fractional
//! bits from the exact values of the floats. It shares no code and no method with the library.
use super::oracle_boxes::{BITS, Fixed};
use geograd::Obb3;
use geograd::shape::FACES;
use num_bigint::BigInt;

type Point = [Fixed; 3];

fn zero() -> Fixed {
    Fixed(BigInt::from(0))
}
fn minus(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|i| a[i].sub(&b[i]))
}
fn dot(a: &Point, b: &Point) -> Fixed {
    (a[0].mul(&b[0]))
        .add(&a[1].mul(&b[1]))
        .add(&a[2].mul(&b[2]))
}
fn cross(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].mul(&b[k]).sub(&a[k].mul(&b[j]))
    })
}
fn negated(x: &Fixed) -> Fixed {
    zero().sub(x)
}

/// A box: its corners and the planes `normal · p ≤ offset` of its faces, in the order of `FACES`.
struct Solid {
    corners: Vec<Point>,
    planes: Vec<(Point, Fixed)>,
    volume: Fixed,
}

fn solid(shape: Obb3<f64>, origin: &Point) -> Solid {
    let q = shape.rotation;
    let [w, x, y, z] = [q.w, q.x, q.y, q.z].map(Fixed::new);
    let norm = (w.mul(&w).add(&x.mul(&x))).add(&y.mul(&y)).add(&z.mul(&z));
    let two = |a: Fixed| Fixed(a.0 * 2);
    let axes: [Point; 3] = [
        [
            w.mul(&w).add(&x.mul(&x)).sub(&y.mul(&y)).sub(&z.mul(&z)),
            two(x.mul(&y).add(&w.mul(&z))),
            two(x.mul(&z).sub(&w.mul(&y))),
        ],
        [
            two(x.mul(&y).sub(&w.mul(&z))),
            w.mul(&w).sub(&x.mul(&x)).add(&y.mul(&y)).sub(&z.mul(&z)),
            two(y.mul(&z).add(&w.mul(&x))),
        ],
        [
            two(x.mul(&z).add(&w.mul(&y))),
            two(y.mul(&z).sub(&w.mul(&x))),
            w.mul(&w).sub(&x.mul(&x)).sub(&y.mul(&y)).add(&z.mul(&z)),
        ],
    ]
    .map(|axis| axis.map(|c| c.div(&norm)));
    let size = [shape.size.x, shape.size.y, shape.size.z].map(Fixed::new);
    let half = [0, 1, 2].map(|i| Fixed(&size[i].0 / 2));
    let center = [shape.center.x, shape.center.y, shape.center.z].map(Fixed::new);
    let center = minus(&center, origin);
    let corners = (0..8)
        .map(|k| {
            let mut at = center.clone();
            for i in 0..3 {
                let side = if k >> i & 1 == 1 {
                    half[i].clone()
                } else {
                    negated(&half[i])
                };
                at = [0, 1, 2].map(|n| at[n].add(&axes[i][n].mul(&side)));
            }
            at
        })
        .collect();
    let planes = (0..6)
        .map(|face| {
            let axis = axes[face / 2].clone();
            let normal = if face % 2 == 1 {
                axis
            } else {
                [0, 1, 2].map(|n| negated(&axis[n]))
            };
            let offset = dot(&normal, &center).add(&half[face / 2]);
            (normal, offset)
        })
        .collect();
    Solid {
        corners,
        planes,
        volume: size[0].mul(&size[1]).mul(&size[2]),
    }
}

/// Six times the volume under the part of a box's faces that is in the other box. Faces that lie in a
/// plane of the other box count for the first box only, if they look the same way.
fn six_under(own: &Solid, other: &Solid, first: bool) -> Fixed {
    let near = BigInt::from(1) << (BITS - 180);
    let mut six = zero();
    for (face, corners) in FACES.iter().enumerate() {
        let mut polygon: Vec<Point> = corners.iter().map(|&n| own.corners[n].clone()).collect();
        for (normal, offset) in &other.planes {
            let heights: Vec<Fixed> = polygon
                .iter()
                .map(|p| {
                    let height = dot(normal, p).sub(offset);
                    if height.0.magnitude() < near.magnitude() {
                        zero()
                    } else {
                        height
                    }
                })
                .collect();
            if heights.iter().all(|h| h.0 == zero().0) {
                if !first || dot(normal, &own.planes[face].0).is_negative() {
                    polygon.clear();
                }
                continue;
            }
            let above = |h: &Fixed| zero().sub(h).is_negative();
            let mut kept = Vec::new();
            for i in 0..polygon.len() {
                let j = (i + 1) % polygon.len();
                let (p, q) = (&polygon[i], &polygon[j]);
                if !above(&heights[i]) {
                    kept.push(p.clone());
                }
                if above(&heights[i]) != above(&heights[j]) {
                    let t = heights[i].div(&heights[i].sub(&heights[j]));
                    kept.push([0, 1, 2].map(|k| p[k].add(&t.mul(&q[k].sub(&p[k])))));
                }
            }
            polygon = kept;
        }
        for i in 1..polygon.len().max(2) - 1 {
            six = six.add(&dot(&polygon[0], &cross(&polygon[i], &polygon[i + 1])));
        }
    }
    six
}

/// The volumes shared by two boxes, of the first, of the second, and intersection over union.
pub fn overlap(a: Obb3<f64>, b: Obb3<f64>) -> [f64; 4] {
    let origin = [a.center.x, a.center.y, a.center.z].map(Fixed::new);
    let (first, second) = (solid(a, &origin), solid(b, &origin));
    let flat = |x: &Solid| x.volume.0 == zero().0;
    let shared = if flat(&first) || flat(&second) {
        zero()
    } else {
        let six = six_under(&first, &second, true).add(&six_under(&second, &first, false));
        Fixed(six.0 / 6)
    };
    let total = first.volume.add(&second.volume).sub(&shared);
    let iou = if total.0 == zero().0 {
        0.0
    } else {
        shared.div(&total).to_f64()
    };
    [
        shared.to_f64(),
        first.volume.to_f64(),
        second.volume.to_f64(),
        iou,
    ]
}
