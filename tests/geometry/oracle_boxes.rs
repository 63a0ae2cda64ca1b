//! An independent oracle for areas of intersection: Sutherland-Hodgman clipping of the corners in
//! fixed-point numbers of 256 fractional bits, from the exact values of the floats. It shares no
//! code and no method with the library.
use geograd::Obb2;
use num_bigint::{BigInt, Sign};

pub(super) const BITS: usize = 256;

/// A fixed-point number: an integer times 2⁻²⁵⁶.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(super) struct Fixed(pub(super) BigInt);

impl Fixed {
    /// The exact value of a float, as far as 256 bits after the point hold it.
    pub(super) fn new(x: f64) -> Self {
        assert!(x.is_finite());
        if x == 0.0 {
            return Fixed(BigInt::from(0));
        }
        let bits = x.abs().to_bits();
        let (exponent, fraction) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = if exponent == 0 {
            (fraction, -1074)
        } else {
            (fraction | 1 << 52, exponent - 1075)
        };
        let shift = exponent + BITS as i64;
        let magnitude = BigInt::from(mantissa);
        let magnitude = if shift >= 0 {
            magnitude << shift
        } else {
            magnitude >> -shift
        };
        Fixed(if x < 0.0 { -magnitude } else { magnitude })
    }
    pub(super) fn to_f64(&self) -> f64 {
        let negative = self.0.sign() == Sign::Minus;
        let magnitude = self.0.magnitude();
        let drop = magnitude.bits().saturating_sub(64);
        let top = (magnitude >> drop).iter_u64_digits().next().unwrap_or(0);
        let x = top as f64 * 2f64.powi(drop as i32 - BITS as i32);
        if negative { -x } else { x }
    }
    pub(super) fn add(&self, other: &Self) -> Self {
        Fixed(&self.0 + &other.0)
    }
    pub(super) fn sub(&self, other: &Self) -> Self {
        Fixed(&self.0 - &other.0)
    }
    pub(super) fn mul(&self, other: &Self) -> Self {
        Fixed((&self.0 * &other.0) >> BITS)
    }
    pub(super) fn div(&self, other: &Self) -> Self {
        Fixed((&self.0 << BITS) / &other.0)
    }
    pub(super) fn is_negative(&self) -> bool {
        self.0.sign() == Sign::Minus
    }
    /// Cosine and sine by their power series at a 2⁻¹⁶ part of the angle, then doubling.
    pub(super) fn cos_sin(&self) -> (Self, Self) {
        let small = Fixed(&self.0 >> 16);
        let one = Fixed(BigInt::from(1) << BITS);
        let (mut cos, mut sin, mut term) = (one.clone(), Fixed(BigInt::from(0)), one.clone());
        for n in 1..60 {
            term = Fixed(term.mul(&small).0 / n);
            match n % 4 {
                1 => sin = sin.add(&term),
                2 => cos = cos.sub(&term),
                3 => sin = sin.sub(&term),
                _ => cos = cos.add(&term),
            }
        }
        for _ in 0..16 {
            let twice = sin.mul(&cos);
            let square = sin.mul(&sin);
            sin = twice.add(&twice);
            cos = one.sub(&square.add(&square));
        }
        (cos, sin)
    }
}

type Point = [Fixed; 2];

fn corners(shape: Obb2<f64>) -> Vec<Point> {
    let (cos, sin) = Fixed::new(shape.heading).cos_sin();
    let half = |x: f64| Fixed(Fixed::new(x).0 / 2);
    let (w, h) = (half(shape.size.x), half(shape.size.y));
    let zero = Fixed(BigInt::from(0));
    let (x, y) = (Fixed::new(shape.center.x), Fixed::new(shape.center.y));
    [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        .iter()
        .map(|&(i, j)| {
            let along = if i < 0 { zero.sub(&w) } else { w.clone() };
            let across = if j < 0 { zero.sub(&h) } else { h.clone() };
            [
                x.add(&cos.mul(&along)).sub(&sin.mul(&across)),
                y.add(&sin.mul(&along)).add(&cos.mul(&across)),
            ]
        })
        .collect()
}

/// Twice the signed area of a triangle: positive when `p` is left of `a → b`.
fn side(a: &Point, b: &Point, p: &Point) -> Fixed {
    let (ab, ap) = (
        [b[0].sub(&a[0]), b[1].sub(&a[1])],
        [p[0].sub(&a[0]), p[1].sub(&a[1])],
    );
    ab[0].mul(&ap[1]).sub(&ab[1].mul(&ap[0]))
}

/// The area shared by two boxes.
fn area_of_intersection(a: Obb2<f64>, b: Obb2<f64>) -> Fixed {
    let zero = Fixed(BigInt::from(0));
    if a.area() == 0.0 || b.area() == 0.0 {
        return zero;
    }
    let (mut polygon, clip) = (corners(b), corners(a));
    for i in 0..4 {
        let (from, to) = (&clip[i], &clip[(i + 1) % 4]);
        let mut kept = Vec::new();
        for j in 0..polygon.len() {
            let (p, q) = (&polygon[j], &polygon[(j + 1) % polygon.len()]);
            let (at_p, at_q) = (side(from, to, p), side(from, to, q));
            if !at_p.is_negative() {
                kept.push(p.clone());
            }
            if at_p.is_negative() != at_q.is_negative() {
                let t = at_p.div(&at_p.sub(&at_q));
                kept.push([0, 1].map(|k| p[k].add(&t.mul(&q[k].sub(&p[k])))));
            }
        }
        polygon = kept;
    }
    let mut twice = zero;
    for j in 1..polygon.len().max(1) - usize::from(!polygon.is_empty()) {
        twice = twice.add(&side(&polygon[0], &polygon[j], &polygon[j + 1]));
    }
    Fixed(twice.0 / 2)
}

/// Intersection over union of two boxes; zero for an empty union.
pub fn iou(a: Obb2<f64>, b: Obb2<f64>) -> f64 {
    let inter = area_of_intersection(a, b);
    let area = |x: Obb2<f64>| Fixed::new(x.size.x).mul(&Fixed::new(x.size.y));
    let total = area(a).add(&area(b)).sub(&inter);
    if total.0 == BigInt::from(0) {
        0.0
    } else {
        inter.div(&total).to_f64()
    }
}
