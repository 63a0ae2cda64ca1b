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

#[test]
fn kurbo() {
    use geograd::curve::{Arc2, Cubic2, CurvePath, Quadratic2};
    use kurbo::{ParamCurve, ParamCurveArclen, ParamCurveArea, ParamCurveNearest, Shape};
    by_name! {
        FLAT => kurbo::Point { x y };
        FLAT => kurbo::Vec2 { x y };
    }
    let at = |x: f64, y: f64| Vec2::new(x, y);
    let cubic = Cubic2::new(at(0.0, 1.0), at(2.0, 3.0), at(-1.0, 4.0), at(3.0, 0.5));
    let theirs = kurbo::CubicBez::from(cubic);
    assert_eq!(Cubic2::from(theirs), cubic);
    let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() < by, "{a} {b}");
    near(theirs.arclen(1e-12), cubic.length(), 1e-10);
    let point = at(1.0, 1.5);
    let nearest = theirs.nearest(point.into(), 1e-12);
    near(nearest.distance_sq.sqrt(), cubic.distance(point), 1e-9);
    near(theirs.eval(0.3).x, cubic.point(0.3).x, 1e-15);
    let chord = 0.5 * at(0.0, 1.0).perp_dot(at(3.0, 0.5));
    near(theirs.signed_area(), cubic.signed_area() + chord, 1e-14);
    let quadratic = Quadratic2::new(at(0.0, 1.0), at(2.0, 3.0), at(-1.0, 4.0));
    assert_eq!(Quadratic2::from(kurbo::QuadBez::from(quadratic)), quadratic);
    let line = geograd::Segment2::new(at(0.0, 1.0), at(2.0, 3.0));
    assert_eq!(geograd::Segment2::from(kurbo::Line::from(line)), line);

    let text = "M0 0 L4 0 Q6 2 4 4 C3 6 1 6 0 4 Z M1 1 L1 2 L2 2 Z";
    let theirs = kurbo::BezPath::from_svg(text).unwrap();
    let path = CurvePath::try_from(&theirs).unwrap();
    assert_eq!(kurbo::BezPath::try_from(&path).unwrap(), theirs);
    near(theirs.area(), path.signed_area(), 1e-13);
    near(theirs.perimeter(1e-12), path.length(), 1e-9);
    let (bounds, theirs_bounds) = (path.bounding().unwrap(), theirs.bounding_box());
    near(bounds.max.y, theirs_bounds.y1, 1e-14);
    for point in [at(2.0, 2.0), at(1.1, 1.9), at(4.9, 2.0), at(5.1, 2.0)] {
        assert_eq!(path.winding_number(point), theirs.winding(point.into()));
    }
    let error = kurbo::BezPath::try_from(&path.arc_to(at(0.0, 3.0), 1.0)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "elements[9] is an arc, which kurbo's paths lack"
    );

    let round = kurbo::Arc::new((1.0, 2.0), (3.0, 3.0), 0.5, -5.0, 0.25);
    let path = CurvePath::try_from(round).unwrap();
    near(path.length(), 15.0, 1e-13);
    let Some(geograd::curve::CurvePiece::Arc(half)) = path.piece(1) else {
        panic!("{path:?}");
    };
    let back = kurbo::Arc::try_from(half).unwrap();
    near(back.center.distance(round.center), 0.0, 1e-14);
    near(back.sweep_angle, -2.5, 1e-14);
    let oval = kurbo::Arc {
        radii: (3.0, 2.0).into(),
        ..round
    };
    assert_eq!(
        CurvePath::try_from(oval).unwrap_err().to_string(),
        "radii differ"
    );
    let straight = Arc2::new(at(0.0, 0.0), at(1.0, 0.0), 0.0);
    assert!(kurbo::Arc::try_from(straight).is_err());
}
