//! Proofs of distances in space: shapes as convex bodies, and the nearest points of the row for them.
use crate::ad::check::certificate::{Body, Proof, Proved};
use crate::kernels::dynamic::{Function, Operation, Rows};
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Fixed, Line3, Obb3, Plane3, Ray3, Real, RoundBox3, Segment3,
    Sphere, Tetrahedron, Triangle3, Vec3, YawBox3,
};

/// Returns a box as a body, from its size and its axes.
fn boxed(center: Vec3<f64>, size: Vec3<f64>, axes: [Vec3<f64>; 3], radius: f64) -> Body {
    let half = [size.x, size.y, size.z].map(|side| side / 2.0);
    Body::boxed(center, [0, 1, 2].map(|k| axes[k] * half[k]), axes, radius)
}

/// Returns a shape as a body, and the numbers that follow it.
fn body<'a>(shape: &str, x: &'a [f64]) -> Option<(Body, &'a [f64])> {
    fn of<P: Fixed<Scalar = f64>>(x: &[f64], body: fn(P) -> Body) -> Option<(Body, &[f64])> {
        let (own, rest) = x.split_at_checked(P::LEN)?;
        Some((body(P::load(own)), rest))
    }
    match shape {
        "Vec3" => of(x, |p: Vec3<f64>| Body::hull(&[p], 0.0)),
        "Sphere" => of(x, |ball: Sphere<f64>| {
            Body::hull(&[ball.center], ball.radius)
        }),
        "Segment3" => of(x, |edge: Segment3<f64>| {
            Body::hull(&[edge.start, edge.end], 0.0)
        }),
        "Capsule3" => of(x, |link: Capsule3<f64>| {
            Body::hull(&[link.start, link.end], link.radius)
        }),
        "Triangle3" => of(x, |face: Triangle3<f64>| Body::hull(&face.corners(), 0.0)),
        "Tetrahedron" => of(x, |solid: Tetrahedron<f64>| {
            Body::hull(&solid.corners(), 0.0)
        }),
        "Aabb3" => of(x, |shape: Aabb3<f64>| {
            let middle = (shape.min + shape.max) * 0.5;
            boxed(middle, shape.max - shape.min, turned(|v| v), 0.0)
        }),
        "YawBox3" => of(x, |shape: YawBox3<f64>| {
            let (sin, cos) = shape.heading.sin_cos();
            let turn =
                move |v: Vec3<f64>| Vec3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z);
            boxed(shape.center, shape.size, turned(turn), 0.0)
        }),
        "Obb3" => of(x, |shape: Obb3<f64>| {
            boxed(
                shape.center,
                shape.size,
                turned(|v| shape.rotation * v),
                0.0,
            )
        }),
        "RoundBox3" => of(x, |shape: RoundBox3<f64>| {
            let inner = shape.inner;
            boxed(
                inner.center,
                inner.size,
                turned(|v| inner.rotation * v),
                shape.radius,
            )
        }),
        "Cylinder" => of(x, |s: Cylinder<f64>| {
            Body::cylinder(s.start, s.end, s.radius)
        }),
        "Cone" => of(x, |s: Cone<f64>| Body::cone(s.apex, s.base, s.radius)),
        "Plane3" => of(x, |plane: Plane3<f64>| {
            Body::half_space(plane.normal, plane.offset)
        }),
        "Line3" => of(x, |line: Line3<f64>| {
            Body::line(line.point, line.direction, true)
        }),
        "Ray3" => of(x, |ray: Ray3<f64>| {
            Body::line(ray.point, ray.direction, false)
        }),
        _ => None,
    }
}

/// Returns the rotated coordinate axes.
fn turned(turn: impl Fn(Vec3<f64>) -> Vec3<f64>) -> [Vec3<f64>; 3] {
    let (x, y, z) = (
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    );
    [turn(x), turn(y), turn(z)]
}

/// The source of proofs for a row.
pub(crate) struct Proofs<S: Real> {
    measure: Proved,
    shapes: &'static [&'static str],
    /// The row of the nearest points of these shapes, if there is one.
    points: Option<Function<S>>,
}

impl<S: Real> Proofs<S> {
    /// Returns the source of proofs for a distance of two shapes in space.
    pub(crate) fn of<'a>(
        row: &Operation,
        mut others: impl Iterator<Item = &'a Operation>,
    ) -> Option<Self> {
        let measure = match row.verb().as_str() {
            "distance" => Proved::Distance,
            "squared_distance" => Proved::SquaredDistance,
            "signed_distance" => Proved::SignedDistance,
            _ => return None,
        };
        let shapes = row.row.shapes;
        let known = |shape: &&str| body(shape, &[0.0; 16]).is_some();
        if shapes.len() != 2 || !shapes.iter().all(known) {
            return None;
        }
        let points =
            others.find(|other| other.verb() == "closest_points" && other.row.shapes == shapes);
        Some(Proofs {
            measure,
            shapes,
            points: points.and_then(Operation::value),
        })
    }
    /// Returns the proof at an input.
    pub(crate) fn at(&self, x: &[f64]) -> Option<Proof> {
        let (a, rest) = body(self.shapes[0], x)?;
        let (b, _) = body(self.shapes[1], rest)?;
        Some(Proof {
            measure: self.measure,
            bodies: [a, b],
            points: self.points.as_ref().and_then(|row| points(row, x)),
        })
    }
}

/// Returns the nearest points by a batch of one item.
fn points<S: Real>(row: &Function<S>, x: &[f64]) -> Option<[Vec3<f64>; 2]> {
    let list: Vec<S> = x.iter().map(|&x| S::nearest(x)).collect();
    let mut rest = &list[..];
    let mut columns = Vec::new();
    for (_, layout) in row.takes() {
        let (own, others) = rest.split_at_checked(layout.fields())?;
        columns.push(Rows::new(own, layout.fields()));
        rest = others;
    }
    let found: Vec<f64> = row
        .aligned(&columns)
        .ok()?
        .concat()
        .iter()
        .map(|x| x.widen())
        .collect();
    let point = |k: usize| Vec3::new(found[k], found[k + 1], found[k + 2]);
    (found.len() == 6).then(|| [point(0), point(3)])
}
