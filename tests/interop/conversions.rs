//! Conversions of points and vectors there and back, field by field.
use geograd::{Vec2, Vec3};

const FLAT: Vec2<f64> = Vec2 { x: 1.5, y: -2.25 };
const DEEP: Vec3<f64> = Vec3 {
    x: 1.5,
    y: -2.25,
    z: 3.125,
};
const SINGLE: Vec3<f32> = Vec3 {
    x: 1.5,
    y: -2.25,
    z: 3.125,
};

/// Through types of others whose coordinates have names.
macro_rules! by_name {
    ($($v:expr => $theirs:ty { $($field:ident)* };)*) => { $(
        let theirs = <$theirs>::from($v);
        $(assert_eq!(theirs.$field, $v.$field, stringify!($theirs));)*
        assert_eq!($v, theirs.into(), stringify!($theirs));
    )* };
}

#[test]
fn glam() {
    by_name! {
        FLAT => glam::DVec2 { x y };
        DEEP => glam::DVec3 { x y z };
        SINGLE => glam::Vec3 { x y z };
        Vec2::new(1.5_f32, -2.25) => glam::Vec2 { x y };
    }
}

#[test]
fn mint() {
    by_name! {
        FLAT => mint::Vector2<f64> { x y };
        FLAT => mint::Point2<f64> { x y };
        DEEP => mint::Vector3<f64> { x y z };
        DEEP => mint::Point3<f64> { x y z };
    }
    // Whatever takes something of mint takes ours.
    fn of_mint(v: impl Into<mint::Vector3<f64>>) -> f64 {
        v.into().z
    }
    assert_eq!(of_mint(DEEP), 3.125);
}

#[test]
fn nalgebra() {
    by_name! {
        FLAT => nalgebra::Vector2<f64> { x y };
        FLAT => nalgebra::Point2<f64> { x y };
        DEEP => nalgebra::Vector3<f64> { x y z };
        DEEP => nalgebra::Point3<f64> { x y z };
    }
}

#[test]
fn geo_types() {
    by_name! {
        FLAT => geo_types::Coord<f64> { x y };
    }
    let point = geo_types::Point::from(FLAT);
    assert_eq!((point.x(), point.y()), (1.5, -2.25));
    assert_eq!(Vec2::from(point), FLAT);
}
