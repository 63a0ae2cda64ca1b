//! The parts of scores of two simple polygons: lengths and areas, with their derivatives by all vertices.
//!
//! The area of intersection is the library's
//! ([`intersection_area`](geograd::overlap_polygon::holed::intersection_area), with its adjoint).
use super::simple::Polygon;
use common::compute::Number;
use geograd::Vec2;
use geograd::ad::adjoint::overlap_rings::intersection_area_vjp;
use geograd::ad::adjoint::ring::signed_area_vjp;
use geograd::hull::hull_area_search;
use geograd::measure::extent::diameter_search;
use geograd::overlap_polygon::holed::intersection_area;

/// Derivatives by the vertices of two polygons, in the order of their vertices.
#[derive(Clone, Debug)]
pub struct Derivatives<T> {
    pub a: Vec<Vec2<T>>,
    pub b: Vec<Vec2<T>>,
}

impl<T: Number> Derivatives<T> {
    /// Derivatives that are all zero.
    pub fn new(a: &Polygon<T>, b: &Polygon<T>) -> Self {
        Derivatives {
            a: vec![Vec2::zero(); a.count()],
            b: vec![Vec2::zero(); b.count()],
        }
    }

    /// Adds other derivatives times a factor.
    pub fn add(&mut self, other: &Self, factor: T) {
        for (own, other) in [(&mut self.a, &other.a), (&mut self.b, &other.b)] {
            for (own, other) in own.iter_mut().zip(other) {
                *own += *other * factor;
            }
        }
    }

    /// The derivative by vertex `k` of both lists one after another.
    fn at(&mut self, k: usize) -> &mut Vec2<T> {
        match k.checked_sub(self.a.len()) {
            None => &mut self.a[k],
            Some(k) => &mut self.b[k],
        }
    }
}

/// A number made of two polygons, and its derivatives by their vertices.
pub struct Part<T> {
    pub value: T,
    pub derivatives: Derivatives<T>,
}

/// The derivatives of `factors[0] A + factors[1] B` with the polygons' own areas A and B.
pub fn own_areas<T: Number>(a: &Polygon<T>, b: &Polygon<T>, factors: [T; 2]) -> Derivatives<T> {
    let mut derivatives = Derivatives::new(a, b);
    signed_area_vjp(&a.vertices, factors[0], &mut derivatives.a);
    signed_area_vjp(&b.vertices, factors[1], &mut derivatives.b);
    derivatives
}

/// The area that both share.
pub fn intersection<T: Number>(a: &Polygon<T>, b: &Polygon<T>, grad: bool) -> Part<T> {
    let mut derivatives = Derivatives::new(a, b);
    let zero = T::zero();
    let (p, q) = (a.bounds, b.bounds);
    if p.max.x <= q.min.x || q.max.x <= p.min.x || p.max.y <= q.min.y || q.max.y <= p.min.y {
        return Part {
            value: zero,
            derivatives,
        };
    }
    let (ring_a, ring_b) = (&a.vertices, &b.vertices);
    let sum = match grad {
        false => intersection_area(ring_a, ring_b),
        true => {
            let (by_a, by_b) = (&mut derivatives.a, &mut derivatives.b);
            intersection_area_vjp(ring_a, ring_b, T::one(), by_a, by_b)
        }
    };
    // Contributions of edges add up with a rounding of the smaller one's size: polygons that only touch
    // share nothing.
    let (p, q) = (p.size(), q.size());
    let rounding = T::lit(16.0 * T::format().epsilon()) * (p.x * p.y).least(q.x * q.y);
    if sum <= rounding {
        return Part {
            value: zero,
            derivatives: Derivatives::new(a, b),
        };
    }
    Part {
        value: sum.least(a.area).least(b.area),
        derivatives,
    }
}

/// The vertices of both.
fn joint<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> Vec<Vec2<T>> {
    [&a.vertices[..], &b.vertices[..]].concat()
}

/// The area of the convex hull of both. Vertices at one place share its derivative.
pub fn hull<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> Part<T> {
    let points = joint(a, b);
    let (value, record) = hull_area_search(&points);
    let mut derivatives = Derivatives::new(a, b);
    let ring: Vec<_> = record.iter().map(|&k| points[k]).collect();
    let mut by = vec![Vec2::zero(); ring.len()];
    signed_area_vjp(&ring, T::one(), &mut by);
    for (&at, by) in ring.iter().zip(by) {
        spread(&points, |p| p == at, by, &mut derivatives);
    }
    Part { value, derivatives }
}

/// Gives all points of some kind an equal share of a derivative.
fn spread<T: Number>(
    points: &[Vec2<T>],
    is_one: impl Fn(Vec2<T>) -> bool,
    derivative: Vec2<T>,
    derivatives: &mut Derivatives<T>,
) {
    let all: Vec<usize> = (0..points.len()).filter(|&k| is_one(points[k])).collect();
    let share = derivative * (T::one() / T::lit(all.len().max(1) as f64));
    for k in all {
        *derivatives.at(k) += share;
    }
}

/// The largest distance of two vertices.
pub fn diameter<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> Part<T> {
    let points = joint(a, b);
    let mut derivatives = Derivatives::new(a, b);
    let Some((value, farthest)) = diameter_search(&points) else {
        return Part {
            value: T::zero(),
            derivatives,
        };
    };
    let way = (points[farthest.to] - points[farthest.from]).normalize_or_zero();
    let (from, to) = (points[farthest.from], points[farthest.to]);
    spread(&points, |p| p == to, way, &mut derivatives);
    spread(&points, |p| p == from, -way, &mut derivatives);
    Part { value, derivatives }
}

/// The diagonal of the axis-aligned box around both.
pub fn diagonal<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> Part<T> {
    let size = a.bounds.join(b.bounds).size();
    Part {
        value: size.length(),
        derivatives: by_bounds(a, b, size.normalize_or_zero()),
    }
}

/// The area of that box.
pub fn bounding_area<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> Part<T> {
    let size = a.bounds.join(b.bounds).size();
    Part {
        value: size.x * size.y,
        derivatives: by_bounds(a, b, Vec2::new(size.y, size.x)),
    }
}

/// The derivatives of a function of the size of that box. Vertices that reach equally far share the derivative.
fn by_bounds<T: Number>(a: &Polygon<T>, b: &Polygon<T>, by: Vec2<T>) -> Derivatives<T> {
    let points = joint(a, b);
    let bounds = a.bounds.join(b.bounds);
    let mut derivatives = Derivatives::new(a, b);
    let (x, y) = (Vec2::new(by.x, T::zero()), Vec2::new(T::zero(), by.y));
    spread(&points, |p| p.x == bounds.max.x, x, &mut derivatives);
    spread(&points, |p| p.x == bounds.min.x, -x, &mut derivatives);
    spread(&points, |p| p.y == bounds.max.y, y, &mut derivatives);
    spread(&points, |p| p.y == bounds.min.y, -y, &mut derivatives);
    derivatives
}
