//! Cameras and conventions of data sets.
use super::Report;
use geograd::camera::{Fisheye, Pinhole};
use geograd::convention::KittiBox;
use geograd::{Vec2, Vec3, YawBox3};
use std::f64::consts::FRAC_PI_2;

/// Points at angles from the axis of a camera without distortion, of focal length one.
fn seen(degrees: [f64; 3]) -> Vec<f64> {
    let camera = Fisheye {
        pinhole: Pinhole::new(Vec2::new(1.0, 1.0), Vec2::new(0.0, 0.0)),
        radial: [0.0; 4],
    };
    let image = |angle: f64| camera.project(Vec3::new(angle.sin(), 0.0, angle.cos())).x;
    degrees.map(|d| image(d.to_radians())).to_vec()
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "opencv/opencv",
            number: 19433,
            about: "angles beyond a right one fold back",
            asked: "images of points 60, 100, 170 degrees from the axis of a fisheye camera",
            source: "closed form: the angle",
            found: || seen([60.0, 100.0, 170.0]),
            right: || [60.0_f64, 100.0, 170.0].map(f64::to_radians).to_vec(),
            within: 1e-14,
        },
        Report {
            library: "ADLab-AutoDrive/BEVHeight",
            number: 9,
            about: "π/2 − yaw",
            asked: "KITTI's `rotation_y` of boxes with yaw 0 and 0.3",
            source: "definition: −π/2 − yaw",
            found: || {
                [0.0, 0.3]
                    .map(|yaw| {
                        KittiBox::from(YawBox3::new(Vec3::zero(), Vec3::new(4.0, 2.0, 1.5), yaw))
                            .rotation_y
                    })
                    .to_vec()
            },
            right: || vec![-FRAC_PI_2, -FRAC_PI_2 - 0.3],
            within: 1e-15,
        },
    ]
}
