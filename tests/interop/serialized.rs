//! Shapes as JSON: the names of their fields, and every bit of their numbers.
use geograd::ad::check::sample::{Draw, Sample, random};
use geograd::curve::{Arc2, Cubic2, Quadratic2};
use geograd::{
    Aabb2, Aabb3, Capsule2, Capsule3, Circle, Cone, Cylinder, Interval, Line2, Line3, Obb2, Obb3,
    Plane3, Pose2, Pose3, Ray2, Ray3, Rotation3, RoundBox3, Segment2, Segment3, Sphere,
    Tetrahedron, Triangle2, Triangle3, Vec2, Vec3, YawBox3,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

fn there_and_back<X: Sample + Serialize + DeserializeOwned + PartialEq + Debug>() {
    let mut draw = Draw::new(3);
    for _ in 0..50 {
        let x: X = random(&mut draw);
        let text = serde_json::to_string(&x).unwrap();
        let back: X = serde_json::from_str(&text).unwrap();
        assert_eq!(back, x, "{text}");
    }
}

macro_rules! all {
    ($($shape:ident)*) => {
        $(there_and_back::<$shape<f64>>();)*
    };
}

#[test]
fn shapes_come_back_with_all_bits() {
    all! {
        Aabb2 Aabb3 Arc2 Capsule2 Capsule3 Circle Cone Cubic2 Cylinder Interval Line2 Line3 Obb2 Obb3 Plane3 Pose2 Pose3 Quadratic2 Ray2
        Ray3 Rotation3 RoundBox3 Segment2 Segment3 Sphere Tetrahedron Triangle2 Triangle3 Vec2 Vec3 YawBox3
    }
}

#[test]
fn fields_have_their_names() {
    let text = serde_json::to_string(&Obb2::new(1.0, 2.0, 4.0, 3.0, 0.5)).unwrap();
    let expected = r#"{"center":{"x":1.0,"y":2.0},"size":{"x":4.0,"y":3.0},"heading":0.5}"#;
    assert_eq!(text, expected);
    let missing = serde_json::from_str::<Circle<f64>>(r#"{"radius":1.0}"#);
    assert!(missing.unwrap_err().to_string().contains("center"));
}
