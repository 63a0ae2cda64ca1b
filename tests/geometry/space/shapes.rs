//! Measures of shapes of space, and what they contain.
use super::draw::Random;
use geograd::prelude::*;
use geograd::{Flaw, Validate};

#[test]
fn volumes_are_shares_of_the_bounds() {
    if !geograd_tests::is_due("volumes_are_shares_of_the_bounds") {
        return;
    }
    let mut random = Random(11);
    let p = [
        Vec3::new(-0.3, 0.1, 0.2),
        Vec3::new(0.9, 0.4, -0.5),
        Vec3::new(0.1, -0.8, 0.6),
        Vec3::new(-0.6, -0.2, -0.9),
    ];
    let inner = Obb3::new(
        p[0],
        Vec3::new(1.0, 0.5, 0.8),
        Rotation3::new(0.5, 0.1, -0.3, 0.7),
    );
    /// The share of points of the bounds that a shape contains, and whether all that it contains are in the bounds.
    macro_rules! share {
        ($shape:expr) => {{
            let (shape, n) = ($shape, 200_000);
            let (bounds, mut inside) = (shape.bounding(), 0);
            let (low, side) = (bounds.min, bounds.size());
            for _ in 0..n {
                let at = low
                    + Vec3::new(
                        side.x * random.within(-0.05, 1.05),
                        side.y * random.within(-0.05, 1.05),
                        side.z * random.within(-0.05, 1.05),
                    );
                if shape.contains(at) {
                    inside += 1;
                    assert!(bounds.contains(at), "{shape:?} {at:?}");
                }
            }
            let volume = f64::from(inside) / f64::from(n) * bounds.volume() * 1.1_f64.powi(3);
            assert!(
                (volume / shape.volume() - 1.0).abs() < 0.03,
                "{shape:?}: {volume} {}",
                shape.volume()
            );
        }};
    }
    share!(Capsule3::new(p[0], p[1], 0.4));
    share!(Cylinder::new(p[0], p[1], 0.4));
    share!(Cone::new(p[0], p[1], 0.6));
    share!(Cone::new(p[1], p[0], 0.6));
    share!(Tetrahedron::new(p[0], p[1], p[2], p[3]));
    share!(RoundBox3::new(inner, 0.3));
    share!(Sphere::new(p[0], 0.7));
}

#[test]
fn surfaces_are_the_slopes_of_volumes_by_the_radius() {
    let (p, q) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.0, -0.4, 0.6));
    let link = Capsule3::new(p, q, 0.4);
    let (_, slope): (f64, f64) = gradient(|r| Capsule3::new(p.lift(), q.lift(), r).volume(), 0.4);
    assert!((slope - link.surface()).abs() < 1e-14);
    let inner = Obb3::new(p, Vec3::new(1.0, 0.5, 0.8), Rotation3::identity());
    let round = RoundBox3::new(inner, 0.3);
    let (_, slope): (f64, f64) = gradient(|r| RoundBox3::new(inner.lift(), r).volume(), 0.3);
    assert!((slope - round.surface()).abs() < 1e-14);
    let can = Cylinder::new(p, q, 0.4);
    let side = can.volume() * 2.0 / 0.4;
    assert!((can.surface() - side - std::f64::consts::TAU * 0.16).abs() < 1e-14);
    let corner = Tetrahedron::new(
        Vec3::zero(),
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.0, 1.0),
    );
    assert!((corner.surface() - 1.5 - 0.75_f64.sqrt()).abs() < 1e-15);
    assert!(corner.signed_volume() > 0.0);
}

#[test]
fn flaws_are_named() {
    let (p, q) = (Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    assert!(Capsule3::try_new(p, p, 0.0).is_ok());
    assert_eq!(
        Capsule3::try_new(p, q, -1.0).unwrap_err().to_string(),
        "radius is negative"
    );
    assert!(matches!(Ray3::try_new(p, p), Err(Flaw::Zero(_))));
    assert!(matches!(Line3::try_new(p, p), Err(Flaw::Zero(_))));
    assert_eq!(
        Cylinder::try_new(p, p, 1.0).unwrap_err().to_string(),
        "end is the start"
    );
    assert_eq!(
        Cone::try_new(p, p, 1.0).unwrap_err().to_string(),
        "base is the apex"
    );
    assert!(RoundBox3::try_new(Obb3::new(p, q, Rotation3::identity()), -1.0).is_err());
    assert!(Tetrahedron::new(p, p, q, q).validate().is_ok());
}

#[test]
fn poses_move_what_shapes_contain() {
    let mut random = Random(12);
    for _ in 0..200 {
        let p: [Vec3<f64>; 4] = std::array::from_fn(|_| random.vector(1.0));
        let motion = Pose3::new(random.vector(2.0), random.solid(0).rotation);
        let (radius, at) = (random.within(0.1, 1.0), random.vector(1.0));
        macro_rules! moves {
            ($($shape:expr),*) => { $(
                let shape = $shape;
                assert_eq!(shape.contains(at), (motion * shape).contains(motion * at), "{shape:?}");
            )* };
        }
        moves!(
            Capsule3::new(p[0], p[1], radius),
            Cylinder::new(p[0], p[1], radius),
            Cone::new(p[0], p[1], radius),
            Tetrahedron::new(p[0], p[1], p[2], p[3]),
            Sphere::new(p[0], radius),
            Plane3::new(p[0], 0.2),
            RoundBox3::new(random.solid(0), 0.2)
        );
        let (ray, line) = (Ray3::new(p[0], p[1]), Line3::new(p[0], p[1]));
        let gap = (motion * ray.nearest(at)) - (motion * ray).nearest(motion * at);
        assert!(gap.length() < 1e-14);
        let gap = (motion * line.nearest(at)) - (motion * line).nearest(motion * at);
        assert!(gap.length() < 1e-14);
        let (wire, face) = (Segment3::new(p[0], p[1]), Triangle3::new(p[0], p[1], p[2]));
        assert!(((motion * wire).length() - wire.length()).abs() < 1e-14);
        assert!(((motion * face).area() - face.area()).abs() < 1e-14);
    }
}
