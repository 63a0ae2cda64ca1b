//! Slopes by the radius of cylinders and cones without one: those of a small radius.
use geograd::ad::gradient;
use geograd::distance3::{farthest_distance, signed_distance};
use geograd::prelude::*;

/// The slope by the radius at zero, and that at a small one.
macro_rules! limits {
    ($Shape:ident, $function:ident, $point:expr, $from:expr, $to:expr) => {{
        let slope = |radius: f64| {
            let f = |(point, shape): (Vec3<_>, $Shape<_>)| $function(point, shape);
            let shape = $Shape::new($from, $to, radius);
            gradient(f, ($point, shape)).1.1.radius
        };
        let told = stringify!($Shape $function);
        let (none, small) = (slope(0.0), slope(1e-7));
        assert!((none - small).abs() < 1e-6, "{told}: {none} {small} {:?} {:?} {:?}", $point, $from, $to);
    }};
}

#[test]
fn without_a_radius_the_slope_by_it_is_that_of_a_small_one() {
    if !geograd_tests::is_due("without_a_radius_the_slope_by_it_is_that_of_a_small_one") {
        return;
    }
    let places = |n: i32| f64::from(n % 5 - 2);
    let mut count = 0;
    for code in 0..3125 {
        let at = |k: u32| places(code / 5_i32.pow(k));
        let (point, from) = (Vec3::new(at(0), at(1), at(2)), Vec3::new(-1.0, 1.0, 0.0));
        let to = Vec3::new(at(3), at(4), 1.0);
        let (axis, arm) = (to - from, point - from);
        let across = axis.cross(arm).length();
        // On the axis, and on the planes through its ends and its middle, slopes jump.
        let along = axis.dot(arm) / axis.length_squared();
        if across == 0.0 || along == 0.0 || along == 1.0 || along == 0.5 {
            continue;
        }
        count += 1;
        limits!(Cone, signed_distance, point, from, to);
        limits!(Cylinder, signed_distance, point, from, to);
        limits!(Cone, farthest_distance, point, from, to);
        limits!(Cylinder, farthest_distance, point, from, to);
    }
    assert!(count > 2000);
}

#[test]
fn beside_its_middle_a_cone_grows_by_half_its_radius() {
    let shape = |point: Vec3<f64>, apex, base| {
        let f = |(point, shape): (Vec3<_>, Cone<_>)| signed_distance(point, shape);
        gradient(f, (point, Cone::new(apex, base, 0.0))).1.1.radius
    };
    let (apex, base) = (Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.0));
    assert_eq!(shape(Vec3::new(2.0, 0.0, 0.0), apex, base), -0.5);
    let (apex, base) = (Vec3::new(-1.0, 1.0, -1.0), Vec3::new(1.0, -1.0, 2.0));
    let slope = shape(Vec3::new(-2.0, 0.0, 0.0), apex, base);
    assert!((slope + 3.0 / 17.0).abs() < 1e-15, "{slope}");
}
