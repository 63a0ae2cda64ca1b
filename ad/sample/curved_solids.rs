//! Ellipsoids and discs to test with.
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, Sample};
use crate::error::Validate;
use crate::{Disc, Ellipsoid, Obb3, Rotation3, Vec3};
use std::f64::consts::FRAC_PI_4;

/// Returns the ellipsoid inside a box.
fn inside(shape: Obb3<f64>) -> Ellipsoid<f64> {
    Ellipsoid::new(shape.center, shape.size * 0.5, shape.rotation)
}

/// Returns the box around an ellipsoid, along its axes.
fn around(shape: &Ellipsoid<f64>) -> Obb3<f64> {
    Obb3::new(shape.center, shape.semi_axes * 2.0, shape.rotation)
}

impl Sample for Ellipsoid<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        inside(Obb3::ordinary(draw))
    }
    fn thin(draw: &mut Draw) -> Self {
        inside(Obb3::thin(draw))
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        inside(around(self).beside(draw))
    }
    fn hard() -> Vec<Self> {
        let made = |x: f64, [a, b, c]: [f64; 3], rotation| {
            Ellipsoid::new(Vec3::new(x, 0.0, 0.0), Vec3::new(a, b, c), rotation)
        };
        let none = Rotation3::identity();
        let turned = Rotation3::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), FRAC_PI_4);
        // Few: every pair of them is a long computation.
        vec![
            made(0.0, [1.0, 0.5, 0.75], none),
            made(1.75, [0.75, 0.5, 0.25], none),
            made(0.0, [1.0, 0.5, 0.75], Rotation3::new(-2.0, 0.0, 0.0, 0.0)),
            made(0.25, [1.5, 0.7, 0.7], turned),
            // A ball, a needle, a plate, a point.
            made(0.5, [0.5, 0.5, 0.5], none),
            made(0.0, [20.0, 1e-3, 1e-3], turned),
            made(0.3, [1.0, 0.0, 0.5], none),
            made(1.0, [0.0, 0.0, 0.0], none),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        around(self).kinds()
    }
    fn scales(&self) -> Vec<f64> {
        around(self).scales()
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

impl Sample for Disc<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let shape = Obb3::ordinary(draw);
        let normal = shape.rotation * Vec3::new(0.0, 0.0, draw.within(0.5, 2.0));
        Disc::new(shape.center, normal, shape.size.x * 0.5)
    }
    fn thin(draw: &mut Draw) -> Self {
        Disc {
            radius: draw.magnitude(1e-3, 0.1),
            ..Self::ordinary(draw)
        }
    }
    fn hard() -> Vec<Self> {
        let made = |z: f64, [x, y, up]: [f64; 3], radius| {
            Disc::new(Vec3::new(0.0, 0.0, z), Vec3::new(x, y, up), radius)
        };
        vec![
            made(0.0, [0.0, 0.0, 1.0], 1.0),
            made(0.5, [0.0, 0.0, -2.0], 0.75),
            made(0.5, [0.6, 0.0, 0.8], 1.0),
            made(0.25, [1.0, 0.0, 0.0], 20.0),
            made(0.0, [0.0, 1e-5, 1.0], 1.0),
            made(1.0, [0.0, 1.0, 0.0], 1e-3),
            made(0.5, [0.0, 0.0, 1.0], 0.0),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        use Kind::{DirectionX, DirectionY, DirectionZ, Length, X, Y, Z};
        vec![X, Y, Z, DirectionX, DirectionY, DirectionZ, Length]
    }
    fn scales(&self) -> Vec<f64> {
        let size = if self.radius > 0.0 { self.radius } else { 1.0 };
        let length = self.normal.length();
        vec![size, size, size, length, length, length, size]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}
