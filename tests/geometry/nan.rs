//! A NaN in any number of a shape is NaN in every number of a verb's result, in every scalar; what belongs to a shape
//! with a NaN is nothing.
use geograd::distance::Convex;
use geograd::distance::ring::{
    distance_to_polyline, distance_to_ring, signed_distance_to_ring, winding_of_ring,
};
use geograd::prelude::*;
use geograd::{
    Cylinder, Fixed, Interval, Jet, Lanes, Line3, Mask, Obb3, Plane3, Ray2, Ray3, RoundBox3,
    Segment3, Sphere, Tetrahedron, Triangle3, YawBox3, kernels,
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
    Interval [0.0 2.0] [5.0 6.0];
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
        "volume": |a: YawBox3, b: Obb3| a.intersection_volume(b);
        "iof": |a: Obb3, b: Aabb3| a.iof(b);
        "span": |a: Line2, b: Obb2| geograd::intersection::span(a, b);
        "hit": |a: Ray2, b: Capsule2| geograd::intersection::first_hit(a, b);
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
        "of": |a: Obb2, b: Obb2| kernels::HullArea.of(a, b);
    }
}

#[test]
fn measures_and_parts() {
    nan_of! { in every scalar:
        "area": |a: Triangle2| kernels::Area.of(a);
        "root": |a: Vec2| (a.x + a.y).root();
        "length": |a: Vec2| a.length();
    }
    nan_of! { in double precision:
        "area": |a: Aabb2| a.area();
        "interval": |a: Interval, b: Interval| a.distance(b);
        "interval": |a: Interval, b: Interval| a.iou(b);
        "interval": |a: Interval, b: Interval| a.intersection_length(b);
        "nearest": |a: Segment2, b: Vec2| a.nearest(b);
        "nearest": |a: Ray2, b: Vec2| a.nearest(b);
        "nearest": |a: Segment3, b: Vec3| a.nearest(b);
        "nearest": |a: Ray3, b: Vec3| a.nearest(b);
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

/// The truths of a NaN in each number in turn, of a point in the shape.
macro_rules! contains {
    ($($Shape:ident $Point:ident)*) => { $( {
        let numbers = [<$Shape<f64> as Numbers>::NUMBERS[0], <$Point<f64> as Numbers>::NUMBERS[0]].concat();
        for k in 0..numbers.len() {
            let mut own = numbers.clone();
            own[k] = f64::NAN;
            let shape = $Shape::<f64>::load(&own);
            let point = $Point::<f64>::load(&own[$Shape::<f64>::LEN..]);
            assert!(!shape.contains(point), "{shape:?} contains {point:?}");
        }
    } )* };
}

#[test]
fn nothing_is_inside_a_shape_with_a_nan() {
    contains! {
        Aabb2 Vec2 Obb2 Vec2 Circle Vec2 Capsule2 Vec2 Triangle2 Vec2 Aabb3 Vec3 YawBox3 Vec3 Obb3 Vec3 RoundBox3 Vec3
        Sphere Vec3 Capsule3 Vec3 Cylinder Vec3 Tetrahedron Vec3 Plane3 Vec3
    }
}

/// A quotient `q / q` is 1, or NaN of zero.
fn spoiled<S: Scalar>(car: Obb2<S>, q: S) -> Obb2<S> {
    let one = q.over(q);
    Obb2 {
        heading: car.heading * one,
        ..car
    }
}
fn gap<S: Scalar>(a: Obb2<S>, b: Obb2<S>, q: S) -> S {
    spoiled(a, q).distance(b)
}
fn score<S: Scalar>(a: Obb2<S>, b: Obb2<S>, q: S) -> S {
    a.iou(spoiled(b, q)) + kernels::Giou.of(spoiled(a, q), b)
}
fn reach<S: Scalar>(a: Capsule3<S>, b: Obb3<S>, q: S) -> S {
    let radius = a.radius * q.over(q);
    Capsule3 { radius, ..a }.distance(b)
}

/// Few items run interpreted, many become machine code.
#[test]
fn a_nan_inside_a_function_of_ones_own_is_nan_of_its_item() {
    if !geograd_tests::is_due("a_nan_inside_a_function_of_ones_own_is_nan_of_its_item") {
        return;
    }
    macro_rules! judge {
        ($S:ty: $($function:ident $A:ident $B:ident)*) => { $( for count in [3, 4000] {
            let [a, far] = <$A<$S> as Numbers>::NUMBERS.map(|x| x.iter().map(|&x| x as $S).collect::<Vec<_>>());
            let [near, b] = <$B<$S> as Numbers>::NUMBERS.map(|x| x.iter().map(|&x| x as $S).collect::<Vec<_>>());
            let (a, b) = ([&a, &far].map(|x| $A::<$S>::load(x)), [&near, &b].map(|x| $B::<$S>::load(x)));
            let a: Vec<_> = (0..count).map(|i| a[i % 2]).collect();
            let b: Vec<_> = (0..count).map(|i| b[i / 2 % 2]).collect();
            let q: Vec<$S> = (0..count).map(|i| if i % 3 == 1 { 0.0 } else { 1.0 }).collect();
            let found = Cpu::new().aligned(function($function), (&a[..], &b[..], &q[..])).unwrap();
            for i in 0..count {
                let expected = $function(a[i], b[i], q[i]);
                assert_eq!(q[i] == 0.0, expected.is_nan(), "{} by itself, item {i}", stringify!($function));
                let same = found[i].to_bits() == expected.to_bits() || found[i].is_nan() && expected.is_nan();
                assert!(same, "{} of {count}, item {i}: {} and {expected}", stringify!($function), found[i]);
            }
        } )* };
    }
    judge!(f64: gap Obb2 Obb2 score Obb2 Obb2 reach Capsule3 Obb3);
    judge!(f32: gap Obb2 Obb2 score Obb2 Obb2 reach Capsule3 Obb3);
}

#[test]
fn a_program_of_a_row_has_the_nan_of_its_input() {
    let iou = kernels::Op::program::<f64>(kernels::Iou.row::<(Obb2<f64>, Obb2<f64>)>()).unwrap();
    let (a, b) = (
        Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0),
        Obb2::new(9.0, f64::NAN, 2.0, 2.0, 0.0),
    );
    assert!(iou.eval((a, b)).is_nan());
    assert_eq!(iou.eval((a, a)), 1.0);
}

#[test]
fn paths_and_polygons() {
    let ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    let path = ring.map(|v| Vec3::new(v.x, v.y, 1.0));
    for k in 0..ring.len() + 1 {
        for x in [f64::NAN, 1.0] {
            let (mut ring, mut path, mut point) = (ring, path, Vec2::new(1.0, 1.0));
            let y = ring.get(k).map_or(1.0, |v| v.y);
            match k < ring.len() {
                true => ring[k].y = if x.is_nan() { x } else { y },
                false => point.x = x,
            }
            match k < path.len() {
                true => path[k].z = x,
                false => point.x = x,
            }
            let found = [
                distance_to_polyline(point, &ring),
                distance_to_ring(point, &ring),
                signed_distance_to_ring(point, &ring),
                winding_of_ring(point, &ring),
                geograd::distance3::polyline::distance_to_polyline(
                    Vec3::new(point.x, 1.0, 5.0),
                    &path,
                ),
            ];
            assert!(
                found.iter().all(|y| y.is_nan() == x.is_nan()),
                "vertex {k}, {x}: {found:?}"
            );
        }
    }
}
