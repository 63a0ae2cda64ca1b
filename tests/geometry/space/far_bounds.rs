//! Axis-aligned boxes far from the origin: shapes that move together by a way without rounding stay as they are.
use super::draw::Random;
use geograd::distance3::{distance, signed_distance, squared_distance};
use geograd::intersection3::{first_hit, length_inside, span};
use geograd::prelude::*;

/// Places of whole numbers of some unit, and the way to where that unit is the last digit.
macro_rules! far_is_near {
    ($name:ident: $t:ty, unit $unit:expr, far $far:expr, slack $slack:expr) => {
        #[test]
        fn $name() {
            let mut random = Random(0x1357_9bdf_0246_8ace);
            let far = Vec3::<$t>::new($far, -$far, $far);
            for _ in 0..500 {
                let mut place = |low: f64, high: f64| {
                    let mut one = || (random.within(low, high).round() * $unit) as $t;
                    Vec3::new(one(), one(), one())
                };
                let (size, min) = (place(0.0, 16.0), place(-8.0, 8.0));
                let shape = Aabb3::new(min, min + size);
                let [a, b, c, d] = [(); 4].map(|()| place(-24.0, 24.0));
                let side = place(1.0, 16.0);
                let moved = |p: Vec3<$t>| p + far;
                let there = Aabb3::new(moved(shape.min), moved(shape.max));
                assert_eq!((there.size(), there.min - far), (shape.size(), shape.min));
                let close = |x: $t, y: $t, size: f64, told: &str| {
                    let error = f64::from(x - y).abs();
                    assert!(
                        error <= $slack * size,
                        "{told}: {x} {y} {shape:?} {a:?} {b:?} {c:?} {d:?}"
                    );
                };
                let size = 64.0 * $unit;
                macro_rules! apart {
                    ($told:literal, $of:expr) => {{
                        let of = $of;
                        let (near, away) = (of(&|p| p), of(&moved));
                        let all = [
                            (distance(shape, near), distance(there, away), size),
                            (distance(near, shape), distance(away, there), size),
                            (
                                signed_distance(shape, near),
                                signed_distance(there, away),
                                size,
                            ),
                            (
                                squared_distance(near, shape),
                                squared_distance(away, there),
                                size * size,
                            ),
                        ];
                        for (x, y, size) in all {
                            close(x, y, size, $told);
                        }
                    }};
                }
                type Move<'a> = &'a dyn Fn(Vec3<$t>) -> Vec3<$t>;
                let turn = Rotation3::new(1.0, 0.5, -0.25, 0.125);
                apart!("segment", |at: Move| Segment3::new(at(a), at(b)));
                apart!("capsule", |at: Move| Capsule3::new(
                    at(a),
                    at(b),
                    $unit as $t
                ));
                apart!("triangle", |at: Move| Triangle3::new(at(a), at(b), at(c)));
                apart!("tetrahedron", |at: Move| Tetrahedron::new(
                    at(a),
                    at(b),
                    at(c),
                    at(d)
                ));
                apart!("ball", |at: Move| Sphere::new(at(a), $unit as $t));
                apart!("box", |at: Move| Obb3::new(at(a), side, turn));
                apart!("upright box", |at: Move| YawBox3::new(at(a), side, 0.5));
                apart!("round box", |at: Move| RoundBox3::new(
                    Obb3::new(at(a), side, turn),
                    $unit as $t
                ));
                apart!("line", |at: Move| Line3::new(at(a), b));
                apart!("ray", |at: Move| Ray3::new(at(a), b));
                for (start, end) in [(a, b), (b, c), (c, d)] {
                    let way = end - start;
                    if way.length() < $unit as $t {
                        continue;
                    }
                    let parts = size / f64::from(way.length());
                    let (near, away) = (Ray3::new(start, way), Ray3::new(moved(start), way));
                    let (x, y) = (first_hit(near, shape), first_hit(away, there));
                    assert_eq!(x.kind, y.kind, "{shape:?} {near:?}");
                    close(x.parameter, y.parameter, parts, "hit");
                    let (near, away) = (Line3::new(start, way), Line3::new(moved(start), way));
                    let (x, y) = (span(near, shape), span(away, there));
                    assert_eq!(x.found, y.found, "{shape:?} {near:?}");
                    close(x.enter, y.enter, parts, "enter");
                    close(x.exit, y.exit, parts, "exit");
                    let (near, away) = (
                        Segment3::new(start, end),
                        Segment3::new(moved(start), moved(end)),
                    );
                    close(
                        length_inside(near, shape),
                        length_inside(away, there),
                        size,
                        "length",
                    );
                }
            }
        }
    };
}
far_is_near!(far_bounds_keep_their_digits_in_f32: f32, unit 1.0 / 1024.0, far 10_000.0, slack 4e-7);
far_is_near!(far_bounds_keep_their_digits_in_f64: f64, unit 1.0 / 1024.0, far 5e12, slack 1e-15);

#[test]
fn a_box_of_one_last_digit_is_where_its_bounds_are() {
    let shape = Aabb3::new(
        Vec3::new(10_000.0_f32, 0.0, 0.0),
        Vec3::new(10_000.001, 1.0, 1.0),
    );
    let (from, to) = (Vec3::new(9998.0_f32, 0.5, 0.5), Vec3::new(9999.0, 0.5, 0.5));
    assert_eq!(distance(Segment3::new(from, to), shape), 1.0);
    assert_eq!(
        first_hit(Ray3::new(to, Vec3::new(1.0, 0.0, 0.0)), shape).parameter,
        1.0
    );
}
