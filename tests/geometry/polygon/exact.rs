//! The oracle: areas, cuts and lengths in big fixed-point numbers, by clipping against half-planes one
//! after the other and the shoelace formula; shares no code with the library.
use geograd::Vec2;
use num_bigint::{BigInt, Sign};

const BITS: u64 = 320;

/// A number with 320 binary places.
#[derive(Clone, Debug, PartialEq)]
pub struct Big(pub BigInt);

impl Big {
    pub fn new(x: f64) -> Self {
        let bits = x.abs().to_bits();
        let (exponent, fraction) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = match exponent {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, exponent - 1075),
        };
        let shift = exponent + BITS as i64;
        let magnitude = BigInt::from(mantissa);
        let magnitude = match shift >= 0 {
            true => magnitude << shift,
            false => magnitude >> -shift,
        };
        Big(if x < 0.0 { -magnitude } else { magnitude })
    }
    pub fn to_f64(&self) -> f64 {
        let magnitude = self.0.magnitude();
        let drop = magnitude.bits().saturating_sub(64);
        let top = (magnitude >> drop).iter_u64_digits().next().unwrap_or(0);
        let x = top as f64 * 2f64.powi(drop as i32 - BITS as i32);
        if self.0.sign() == Sign::Minus { -x } else { x }
    }
    pub fn add(&self, other: &Self) -> Self {
        Big(&self.0 + &other.0)
    }
    pub fn sub(&self, other: &Self) -> Self {
        Big(&self.0 - &other.0)
    }
    pub fn mul(&self, other: &Self) -> Self {
        Big((&self.0 * &other.0) >> BITS)
    }
    pub fn div(&self, other: &Self) -> Self {
        Big((&self.0 << BITS) / &other.0)
    }
    pub fn sign(&self) -> i32 {
        match self.0.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }
}

pub type Point = [Big; 2];

pub fn points(ring: &[Vec2<f64>]) -> Vec<Point> {
    ring.iter()
        .map(|v| [Big::new(v.x), Big::new(v.y)])
        .collect()
}

/// Twice the signed area of a triangle: positive when `p` is left of `a → b`.
pub fn side(a: &Point, b: &Point, p: &Point) -> Big {
    let (ab, ap) = (
        [b[0].sub(&a[0]), b[1].sub(&a[1])],
        [p[0].sub(&a[0]), p[1].sub(&a[1])],
    );
    ab[0].mul(&ap[1]).sub(&ab[1].mul(&ap[0]))
}

/// The part of a ring on the left of a line. Only its signed area means something when the ring is
/// not convex.
pub fn cut(ring: &[Point], from: &Point, to: &Point) -> Vec<Point> {
    let mut kept = Vec::new();
    for j in 0..ring.len() {
        let (p, q) = (&ring[j], &ring[(j + 1) % ring.len()]);
        let (at_p, at_q) = (side(from, to, p), side(from, to, q));
        if at_p.sign() >= 0 {
            kept.push(p.clone());
        }
        if (at_p.sign() < 0) != (at_q.sign() < 0) {
            let t = at_p.div(&at_p.sub(&at_q));
            kept.push([0, 1].map(|k| p[k].add(&t.mul(&q[k].sub(&p[k])))));
        }
    }
    kept
}

/// The ring clipped to a convex polygon.
pub fn clipped(ring: &[Vec2<f64>], convex: &[Vec2<f64>]) -> Vec<Point> {
    let (mut ring, convex) = (points(ring), points(convex));
    for i in 0..convex.len() {
        let next = (i + 1) % convex.len();
        if convex[i] != convex[next] {
            ring = cut(&ring, &convex[i], &convex[next]);
        }
    }
    ring
}

/// The signed area.
pub fn area(ring: &[Point]) -> Big {
    let mut twice = Big::new(0.0);
    for j in 2..ring.len() {
        twice = twice.add(&side(&ring[0], &ring[j - 1], &ring[j]));
    }
    Big(twice.0 / 2)
}

/// The signed area of the part of a ring inside a convex polygon that has an area.
pub fn area_inside(ring: &[Vec2<f64>], convex: &[Vec2<f64>]) -> f64 {
    area(&clipped(ring, convex)).to_f64()
}

/// The signed area of a ring.
pub fn ring_area(ring: &[Vec2<f64>]) -> f64 {
    area(&points(ring)).to_f64()
}

/// The convex hull by brute force: all points that some line through two points has on its border,
/// around; without collinear ones. `O(n³)`.
pub fn hull(all: &[Vec2<f64>]) -> Vec<Vec2<f64>> {
    let big = points(all);
    let n = all.len();
    let Some(first) = (0..n).min_by(|&i, &j| {
        let key = |k: usize| (all[k].x, all[k].y);
        key(i).partial_cmp(&key(j)).unwrap()
    }) else {
        return Vec::new();
    };
    let mut out = vec![first];
    loop {
        let here = *out.last().unwrap();
        let mut next = None;
        for k in 0..n {
            if all[k] == all[here] {
                continue;
            }
            let right_most = (0..n).all(|m| {
                let s = side(&big[here], &big[k], &big[m]).sign();
                s > 0
                    || s == 0 && {
                        let d = |q: usize| (all[q] - all[here]).length_squared();
                        // No farther on the same line, on the same side.
                        d(m) <= d(k) || (all[m] - all[here]).dot(all[k] - all[here]) < 0.0
                    }
            });
            if right_most {
                next = Some(k);
                break;
            }
        }
        match next {
            Some(k) if all[k] != all[first] && out.len() <= n => out.push(k),
            _ => return out.into_iter().map(|k| all[k]).collect(),
        }
    }
}
