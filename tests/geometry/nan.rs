//! A NaN in any number of a shape is NaN in every number of a verb's result, in every scalar; what belongs to a shape
//! with a NaN is nothing.
use geograd::distance::Convex;
use geograd::prelude::*;
use geograd::{
    Cylinder, Fixed, Jet, Lanes, Line3, Mask, Obb3, Plane3, Ray2, Ray3, RoundBox3, Segment3,
    Sphere, Tetrahedron, Triangle3, YawBox3, kernels,
};
use num_dual::{Dual2, Dual64};

/// Numbers of shapes, one list near the origin and one far from it.
trait Numbers: Fixed {
    const NUMBERS: [&'static [f64]; 2];
}

macro_rules! numbers {
    ($($Shape:ident [$($near:literal)+] [$($far:literal)+];)*) => { $(
        impl<S: Scalar> Numbers for $Shape<S> {
            const NUMBERS: [&'static [f64]; 2] = [&[$($near),+], &[$($far),+]];
        }
    )* };
}
numbers! {
    Vec2 [0.1 0.2] [9.0 5.0];
    Segment2 [-1.0 -0.5 1.0 0.75] [5.0 6.0 7.0 9.0];
    Ray2 [-1.0 -0.5 1.0 0.75] [5.0 6.0 7.0 9.0];
    Line2 [-1.0 -0.5 1.0 0.75] [5.0 6.0 7.0 9.0];
    Triangle2 [0.0 0.0 2.0 0.0 0.0 1.5] [5.0 5.0 8.0 5.0 5.0 8.0];
    Aabb2 [-1.0 -1.0 1.5 1.0] [4.0 5.0 6.0 7.0];
    Obb2 [0.25 0.0 2.0 1.0 0.5] [7.0 8.0 1.0 2.0 -0.25];
    Circle [0.0 0.5 1.0] [9.0 7.0 2.0];
    Capsule2 [-1.0 0.0 1.0 0.25 0.5] [6.0 6.0 7.0 9.0 0.25];
    Vec3 [0.1 0.2 0.3] [9.0 5.0 4.0];
    Segment3 [-1.0 -0.5 0.0 1.0 0.75 0.5] [5.0 6.0 7.0 9.0 8.0 6.0];
    Ray3 [-1.0 -0.5 0.0 1.0 0.75 0.5] [5.0 6.0 7.0 9.0 8.0 6.0];
    Line3 [-1.0 -0.5 0.0 1.0 0.75 0.5] [5.0 6.0 7.0 9.0 8.0 6.0];
    Triangle3 [0.0 0.0 0.0 2.0 0.0 0.0 0.0 1.5 0.5] [5.0 5.0 5.0 8.0 5.0 5.0 5.0 8.0 5.0];
    Tetrahedron [0.0 0.0 0.0 2.0 0.0 0.0 0.0 1.5 0.0 0.0 0.0 1.0] [5.0 5.0 5.0 8.0 5.0 5.0 5.0 8.0 5.0 5.0 5.0 9.0];
    Aabb3 [-1.0 -1.0 -1.0 1.5 1.0 1.0] [4.0 5.0 6.0 7.0 8.0 9.0];
    YawBox3 [0.25 0.0 0.0 2.0 1.0 1.5 0.5] [7.0 8.0 6.0 1.0 2.0 1.0 -0.25];
    Obb3 [0.25 0.0 0.0 2.0 1.0 1.5 1.0 0.0 0.25 0.0] [7.0 8.0 6.0 1.0 2.0 1.0 1.0 0.5 0.25 0.0];
    RoundBox3 [0.25 0.0 0.0 2.0 1.0 1.5 1.0 0.0 0.25 0.0 0.25] [7.0 8.0 6.0 1.0 2.0 1.0 1.0 0.5 0.25 0.0 0.5];
    Sphere [0.0 0.5 0.0 1.0] [9.0 7.0 5.0 2.0];
    Capsule3 [-1.0 0.0 0.0 1.0 0.25 0.0 0.5] [6.0 6.0 6.0 7.0 9.0 6.0 0.25];
    Cylinder [-1.0 0.0 0.0 1.0 0.25 0.0 0.5] [6.0 6.0 6.0 7.0 9.0 6.0 0.25];
    Plane3 [0.0 0.5 1.0 0.25] [1.0 0.0 0.5 9.0];
}

fn is_nan<S: Scalar>(x: S) -> bool {
    !x.equals(x).any()
}

/// Plants NaN in each number in turn, of shapes near each other and apart.
fn planted<S: Scalar, Out: Fixed<Scalar = S>>(
    what: &str,
    lists: &[[&[f64]; 2]],
    function: impl Fn(&[S]) -> Out,
) -> Vec<String> {
    let mut found = Vec::new();
    for choice in 0..1 << (lists.len() - 1) {
        let parts = lists.iter().enumerate();
        let numbers: Vec<f64> = parts
            .flat_map(|(i, list)| list[usize::from(i > 0) & choice].to_vec())
            .collect();
        for k in 0..numbers.len() {
            let mut own: Vec<S> = numbers.iter().map(|&x| S::lit(x)).collect();
            own[k] = S::lit(f64::NAN);
            let out = function(&own).scalars();
            if !out.iter().all(|&x| is_nan(x)) {
                let scalar = std::any::type_name::<S>();
                found.push(format!(
                    "{what} of {scalar}, number {k}, case {choice}: {out:?}"
                ));
            }
        }
    }
    found
}

/// Calls of two shapes or of one in every scalar.
macro_rules! nan_of {
    (in every scalar: $($calls:tt)*) => {
        nan_of!(@each [$($calls)*] [f64] [f32] [Jet<f64, 2>] [Jet<Jet<f32, 1>, 1>] [Dual64] [Dual2<f64>] [Lanes<f64, 4>] [Lanes<f32, 8>]);
    };
    (in single precision: $($calls:tt)*) => {
        nan_of!(@each [$($calls)*] [f32]);
    };
    (in double precision: $($calls:tt)*) => {
        nan_of!(@each [$($calls)*] [f64]);
    };
    (@each $calls:tt $($S:tt)*) => {
        $( nan_of!(@calls $S $calls); )*
    };
    (@calls [$S:ty] [$($name:literal: |$a:ident: $A:ident $(, $b:ident: $B:ident)?| $call:expr;)*]) => {{
        let mut found = Vec::new();
        $( found.extend(planted::<$S, _>(
            $name,
            &[<$A<$S> as Numbers>::NUMBERS $(, <$B<$S> as Numbers>::NUMBERS)?],
            |numbers| {
                let $a = $A::<$S>::load(numbers);
                $( let $b = $B::<$S>::load(&numbers[$A::<$S>::LEN..]); )?
                $call
            },
        )); )*
        assert!(found.is_empty(), "{} of finite numbers:\n{}", found.len(), found.join("\n"));
    }};
}

/// All distances of a pair.
macro_rules! distances {
    ($($A:ident $B:ident)*) => { nan_of! { in double precision: $(
        "distance": |a: $A, b: $B| a.distance(b);
        "distance by exchange": |a: $A, b: $B| b.distance(a);
        "squared distance": |a: $A, b: $B| a.squared_distance(b);
        "signed distance": |a: $A, b: $B| a.signed_distance(b);
        "closest points": |a: $A, b: $B| a.closest_points(b);
        "penetration": |a: $A, b: $B| a.penetration(b);
        "farthest distance": |a: $A, b: $B| a.farthest_distance(b);
    )* } };
}

#[test]
fn distances_of_the_plane() {
    distances! {
        Vec2 Obb2 Segment2 Segment2 Ray2 Circle Line2 Aabb2 Triangle2 Triangle2 Aabb2 Aabb2 Obb2 Obb2 Circle Circle
        Capsule2 Obb2
    }
    nan_of! { in single precision:
        "distance": |a: Circle, b: Circle| a.distance(b);
        "closest points": |a: Capsule2, b: Segment2| a.closest_points(b);
        "penetration": |a: Triangle2, b: Aabb2| a.penetration(b);
    }
    nan_of! { in double precision:
        "closest points": |a: Vec2, b: Vec2| a.closest_points(b);
        "farthest points": |a: Obb2, b: Capsule2| Convex::farthest_points(a, b);
        "corners": |a: Triangle2, b: Circle| a.corners().signed_distance(b);
    }
}

#[test]
fn distances_of_space() {
    distances! {
        Vec3 Vec3 Segment3 Capsule3 Triangle3 Tetrahedron Sphere Aabb3 Obb3 YawBox3 Plane3 RoundBox3 Plane3 Cylinder
        Vec3 Cylinder Line3 Obb3 Ray3 Line3
    }
    nan_of! { in single precision:
        "distance": |a: Vec3, b: Obb3| a.distance(b);
        "penetration": |a: Sphere, b: Aabb3| a.penetration(b);
    }
}

#[test]
fn verbs_by_method_and_by_of() {
    nan_of! { in every scalar:
        "distance": |a: Obb2, b: Obb2| a.distance(b);
        "distance": |a: Vec2, b: Vec2| a.distance(b);
        "distance": |a: Capsule3, b: Obb3| a.distance(b);
        "iou": |a: Obb2, b: Obb2| a.iou(b);
        "of": |a: Circle, b: Obb2| kernels::SignedDistance.of(a, b);
    }
    nan_of! { in double precision:
        "iou": |a: Aabb2, b: Aabb2| a.iou(b);
        "iou": |a: Obb3, b: Obb3| a.iou(b);
        "iou": |a: YawBox3, b: YawBox3| a.iou(b);
        "iof": |a: Obb2, b: Obb2| a.iof(b);
        "giou": |a: Obb2, b: Obb2| a.giou(b);
        "giou": |a: Aabb2, b: Aabb2| a.giou(b);
        "diou": |a: Obb2, b: Obb2| a.diou(b);
        "ciou": |a: Obb2, b: Obb2| a.ciou(b);
        "eiou": |a: Aabb2, b: Aabb2| a.eiou(b);
        "area": |a: Obb2, b: Obb2| a.intersection_area(b);
        "volume": |a: Aabb3, b: Aabb3| a.intersection_volume(b);
        "hull": |a: Obb2, b: Obb2| a.hull_area(b);
        "wasserstein": |a: Obb2, b: Obb2| a.wasserstein(b);
        "probiou": |a: Obb3, b: Obb3| a.probiou(b);
        "first hit": |a: Ray2, b: Obb2| a.first_hit(b);
        "first hit": |a: Ray3, b: Sphere| a.first_hit(b);
        "span": |a: Line2, b: Circle| a.span(b);
        "length inside": |a: Segment2, b: Aabb2| a.length_inside(b);
        "crossing": |a: Line2, b: Line2| a.crossing(b);
        "of": |a: Obb2, b: Obb2| kernels::Distance.of(a, b);
        "of": |a: Circle, b: Obb2| kernels::SignedDistance.of(a, b);
        "of": |a: Obb2, b: Obb2| kernels::GiouHull.of(a, b);
    }
}

#[test]
fn measures_and_parts() {
    nan_of! { in every scalar:
        "area": |a: Obb2| a.area();
        "root": |a: Vec2| (a.x + a.y).root();
        "length": |a: Vec2| a.length();
    }
    nan_of! { in double precision:
        "area": |a: Aabb2| a.area();
        "area": |a: Capsule2| a.area();
        "bounding": |a: Obb2| a.bounding();
        "bounding": |a: Capsule2| a.bounding();
        "bounding": |a: Triangle2| a.bounding();
        "bounding": |a: Obb3| a.bounding();
        "bounding": |a: Cylinder| a.bounding();
        "nearest": |a: Segment2, b: Vec2| a.nearest(b);
        "nearest": |a: Ray2, b: Vec2| a.nearest(b);
        "nearest": |a: Segment3, b: Vec3| a.nearest(b);
        "nearest": |a: Ray3, b: Vec3| a.nearest(b);
        "meet": |a: Aabb2, b: Aabb2| a.meet(b);
        "join": |a: Aabb2, b: Aabb2| a.join(b);
        "meet": |a: Aabb3, b: Aabb3| a.meet(b);
        "join": |a: Aabb3, b: Aabb3| a.join(b);
        "circumcircle": |a: Triangle2| a.circumcircle();
        "incircle": |a: Triangle2| a.incircle();
        "perimeter": |a: Triangle2| a.perimeter();
        "length": |a: Vec2| a.length();
        "length": |a: Vec3| a.length();
        "unit": |a: Vec2| a.normalize_or_zero();
        "unit": |a: Vec3| a.normalize_or_zero();
        "angle": |a: Vec2| a.angle();
        "angle": |a: Vec3, b: Vec3| a.angle_to(b);
    }
}
