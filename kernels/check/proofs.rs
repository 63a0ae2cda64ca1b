//! Proofs of distances in space: shapes as convex bodies, and the nearest points of the row for them.
use crate::ad::check::certificate::{Body, Proof, Proved};
use crate::kernels::dynamic::{Function, Operation, Rows};
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Disc, Ellipsoid, Fixed, Hull3, Line3, Obb3, Plane3, Ray3,
    Real, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3, Vec3, YawBox3,
};

/// Returns a box as a body, from its size and its axes.
fn boxed(center: Vec3<f64>, size: Vec3<f64>, axes: [Vec3<f64>; 3], radius: f64) -> Body {
    let half = [size.x, size.y, size.z].map(|side| side / 2.0);
    Body::boxed(center, [0, 1, 2].map(|k| axes[k] * half[k]), axes, radius)
}

/// The scalars and codes of some shapes, one shape after another.
#[derive(Clone, Copy)]
struct Numbers<'a> {
    scalars: &'a [f64],
    codes: &'a [u32],
}

/// Returns a shape as a body, and the numbers that follow it.
fn body<'a>(shape: &str, x: Numbers<'a>) -> Option<(Body, Numbers<'a>)> {
    fn of<'a, P: Fixed<Scalar = f64>>(
        x: Numbers<'a>,
        body: fn(P) -> Body,
    ) -> Option<(Body, Numbers<'a>)> {
        let (own, scalars) = x.scalars.split_at_checked(P::LEN)?;
        let (own_codes, codes) = x.codes.split_at_checked(P::CODES)?;
        let shape = P::load(own).load_codes(own_codes);
        Some((body(shape), Numbers { scalars, codes }))
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
        "Disc" => of(x, |s: Disc<f64>| Body::disc(s.center, s.normal, s.radius)),
        "Ellipsoid" => of(x, |s: Ellipsoid<f64>| {
            let half = [s.semi_axes.x, s.semi_axes.y, s.semi_axes.z];
            Body::ellipsoid(s.center, half, turned(|v| s.rotation * v))
        }),
        "Plane3" => of(x, |plane: Plane3<f64>| {
            Body::half_space(plane.normal, plane.offset)
        }),
        "Line3" => of(x, |line: Line3<f64>| {
            Body::line(line.point, line.direction, true)
        }),
        "Ray3" => of(x, |ray: Ray3<f64>| {
            Body::line(ray.point, ray.direction, false)
        }),
        "Hull3_8" => of(x, |hull: Hull3<f64, 8>| Body::hull(hull.as_slice(), 0.0)),
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
        let known = |shape: &&str| {
            let (scalars, codes) = (&[0.0; 32][..], &[1; 2][..]);
            body(shape, Numbers { scalars, codes }).is_some()
        };
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
    /// Returns the proof at an input, given its scalars and its codes.
    pub(crate) fn at(&self, scalars: &[f64], codes: &[u32]) -> Option<Proof> {
        let x = Numbers { scalars, codes };
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
fn points<S: Real>(row: &Function<S>, x: Numbers<'_>) -> Option<[Vec3<f64>; 2]> {
    let Numbers {
        mut scalars,
        mut codes,
    } = x;
    let mut shapes: Vec<Vec<S>> = Vec::new();
    for (_, layout) in row.takes() {
        let (own, others) = scalars.split_at_checked(layout.fields() - layout.codes())?;
        let (own_codes, other_codes) = codes.split_at_checked(layout.codes())?;
        let own_codes = own_codes.iter().map(|&code| f64::from(code));
        let numbers = own.iter().copied().chain(own_codes);
        shapes.push(numbers.map(S::nearest).collect());
        (scalars, codes) = (others, other_codes);
    }
    let columns: Vec<Rows<'_, S>> = shapes
        .iter()
        .map(|shape| Rows::new(shape, shape.len()))
        .collect();
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
