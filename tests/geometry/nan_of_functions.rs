//! A NaN in any number of an argument is NaN in every number of a free function of lines and planes, too.
use geograd::intersection::{crossing_of_lines, length_inside_ring, meeting_of_segments};
use geograd::intersection3::{
    crossing_of_three_planes, crossing_of_two_planes, first_hit, first_hit_of_segment,
    first_hit_triangle, length_inside, span,
};
use geograd::{
    Aabb3, Capsule3, Cone, Cylinder, Fixed, Line2, Line3, Obb3, Pack, Plane3, Ray3, RoundBox3,
    Segment2, Segment3, Sphere, Tetrahedron, Triangle3, Vec2, YawBox3,
};

/// Numbers of any shape: sizes are positive, and quaternions have a length.
fn numbers<P: Fixed<Scalar = f64>>() -> Vec<f64> {
    (0..P::LEN)
        .map(|k| 0.25 + 0.5 * ((k * k) % 5) as f64)
        .collect()
}

/// The places of a NaN from which a function of two shapes makes a number.
fn planted<A, B, Out>(function: impl Fn(A, B) -> Out) -> Vec<usize>
where
    A: Fixed<Scalar = f64>,
    B: Fixed<Scalar = f64>,
    Out: Pack<Scalar = f64>,
{
    let all = [numbers::<A>(), numbers::<B>()].concat();
    let call = |all: &[f64]| function(A::load(all), B::load(&all[A::LEN..])).scalars();
    assert!(call(&all).iter().all(|x| x.is_finite()));
    let swallowed = |&k: &usize| {
        let mut own = all.clone();
        own[k] = f64::NAN;
        call(&own).iter().any(|x| !x.is_nan())
    };
    (0..all.len()).filter(swallowed).collect()
}

#[test]
fn free_functions_of_lines_and_planes_pass_nan_on() {
    let mut found = Vec::new();
    macro_rules! solids {
        ($($Shape:ident)*) => { $(
            found.push((concat!("hit of ", stringify!($Shape)), planted(|a: Ray3<f64>, b: $Shape<f64>| first_hit(a, b))));
            found.push((concat!("span of ", stringify!($Shape)), planted(|a: Line3<f64>, b: $Shape<f64>| span(a, b))));
            found.push((
                concat!("length in ", stringify!($Shape)),
                planted(|a: Segment3<f64>, b: $Shape<f64>| length_inside(a, b)),
            ));
        )* };
    }
    solids!(Sphere Aabb3 YawBox3 Obb3 RoundBox3 Capsule3 Cylinder Cone Tetrahedron Plane3);
    found.push((
        "ray and triangle",
        planted(|a: Ray3<f64>, b: Triangle3<f64>| first_hit_triangle(a, b)),
    ));
    found.push((
        "segment and triangle",
        planted(|a: Segment3<f64>, b: Triangle3<f64>| first_hit_of_segment(a, b)),
    ));
    found.push((
        "segment in a ring",
        planted(|a: Segment2<f64>, b: [Vec2<f64>; 3]| length_inside_ring(a, &b)),
    ));
    found.push((
        "two planes",
        planted(|a: Plane3<f64>, b: Plane3<f64>| crossing_of_two_planes(a, b)),
    ));
    let three = |a: [Plane3<f64>; 2], c: Plane3<f64>| crossing_of_three_planes(a[0], a[1], c);
    found.push(("three planes", planted(three)));
    found.push((
        "two lines",
        planted(|a: Line2<f64>, b: Line2<f64>| crossing_of_lines(a, b)),
    ));
    found.push((
        "two segments",
        planted(|a: Segment2<f64>, b: Segment2<f64>| meeting_of_segments(a, b)),
    ));
    found.retain(|(_, places)| !places.is_empty());
    assert!(found.is_empty(), "numbers of NaN:\n{found:?}");
}
