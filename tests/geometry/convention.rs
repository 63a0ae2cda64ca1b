//! Conventions against their own definitions.
use super::pairs::Random;
use geograd::convention::{
    Clockwise, Degrees, Detectron2Box, ImageBox, KittiBox, Le90, Le135, LidarBox, NuScenesBox,
    OpenCvBox, Period, Radians, Xyxyr,
};
use geograd::{Jet, Obb2, Obb3, Scalar, Vec2, Vec3, YawBox3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

fn same_box(a: Obb2<f64>, b: Obb2<f64>) -> bool {
    (a.iou(b) - 1.0).abs() < 1e-12
}

#[test]
fn images_keep_the_box_whatever_the_range() {
    let mut random = Random(91);
    for n in 0..400 {
        let size = random.size();
        // Multiples of an eighth turn are the ends of all ranges.
        let radians = if n % 2 == 0 {
            random.between(-9.0, 9.0)
        } else {
            (n % 32) as f64 * FRAC_PI_4 - 9.0 * FRAC_PI_4
        };
        let seen = ImageBox {
            center: Vec2::new(random.between(0.0, 9.0), 1.0),
            size: Vec2::new(size.x, size.y),
            heading: Clockwise { radians },
        };
        let (long, le135, cv) = (Le90::from(seen), Le135::from(seen), OpenCvBox::from(seen));
        let (one, two, three) = (
            long.heading.radians,
            le135.heading.radians,
            cv.heading.radians,
        );
        let slack = 1e-14;
        assert!(
            (-FRAC_PI_2..FRAC_PI_2).contains(&one) && long.size.x >= long.size.y,
            "{one}"
        );
        assert!(
            (-FRAC_PI_4..3.0 * FRAC_PI_4).contains(&two) && le135.size.x >= le135.size.y,
            "{two}"
        );
        assert!(three > 0.0 && three <= FRAC_PI_2 + slack, "{three}");
        let detectron = Detectron2Box::from(seen);
        for again in [
            long.into(),
            le135.into(),
            cv.into(),
            ImageBox::from(detectron),
        ] {
            assert!(
                same_box(ImageBox::mirrored(again), seen.mirrored()),
                "{seen:?} {again:?}"
            );
        }
        let up = seen.upright(20.0);
        let back = ImageBox::from_upright(up, 20.0);
        assert!((back.center.y - seen.center.y).abs() < 1e-14 && back.heading == seen.heading);
        // Corners flip one by one.
        let (p, q) = (seen.mirrored().corners(), up.corners());
        for p in p {
            let flipped = Vec2::new(p.x, 20.0 - p.y);
            assert!(q.iter().any(|q| q.distance(flipped) < 1e-13));
        }
        assert!(same_box(Obb2::from(Xyxyr::from(up)), up));
    }
}

#[test]
fn kitti_is_as_its_development_kit_draws_it() {
    let mut random = Random(92);
    for _ in 0..100 {
        let size = random.size();
        let label = KittiBox {
            height: size.x,
            width: size.y,
            length: size.z,
            location: random.vector(5.0),
            rotation_y: random.between(-PI, PI),
        };
        let (sin, cos) = label.rotation_y.sin_cos();
        let upright = YawBox3::from(label);
        let corners = upright.corners();
        for (x, y, z) in [
            (0.5, 0.0, 0.5),
            (-0.5, -1.0, 0.5),
            (0.5, -1.0, -0.5),
            (-0.5, 0.0, -0.5),
        ] {
            let (x, y, z) = (x * label.length, y * label.height, z * label.width);
            let camera = Vec3::new(cos * x + sin * z, y, cos * z - sin * x) + label.location;
            let here = Vec3::new(camera.z, -camera.x, -camera.y);
            assert!(
                corners.iter().any(|c| c.distance(here) < 1e-13),
                "{label:?}"
            );
        }
        let again = KittiBox::from(upright);
        assert!((again.rotation_y - label.rotation_y).abs() < 1e-15);
        assert!(again.location.distance(label.location) < 1e-14);
        assert_eq!(YawBox3::from(LidarBox::from(upright)), upright);
        let turned = Obb3::from(upright);
        assert_eq!(Obb3::from(NuScenesBox::from(turned)), turned);
    }
}

#[test]
fn angles_wrap_with_derivative_one() {
    for (period, length) in [
        (Period::Full, 2.0 * PI),
        (Period::Half, PI),
        (Period::Quarter, FRAC_PI_2),
    ] {
        for k in -50..50 {
            let angle = f64::from(k) * 0.37;
            let wrapped = period.wrap(Jet::<f64, 1>::variable(angle, 0));
            assert!(wrapped.value.abs() <= length / 2.0 + 1e-15);
            let turns = (angle - wrapped.value) / length;
            assert!((turns - turns.round()).abs() < 1e-13);
            assert!((wrapped.derivative[0] - 1.0).abs() < 1e-14);
            assert!(period.loss(angle, angle + length) < 1e-25);
        }
    }
    let degrees = Degrees::from(Radians { value: PI });
    assert!((degrees.value - 180.0).abs() < 1e-12);
    let _ = f64::lit(1.0);
}
