//! Curved shapes of narrow numbers, on grids and without some extents: as apart as the same shapes in wide ones.
use super::curved_draw::{Body, Frame, frames};
use super::draw::Random;
use geograd::distance3::{closest_points, signed_distance};
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid};

/// The largest error, relative to the size.
const BOUND: f64 = 4e-6;

/// A frame on a grid, turned by quarters and eighths, with some lengths of zero.
fn frame(random: &mut Random) -> Frame {
    let mut few = |n: usize| random.below(n) as f64;
    let at = Vec3::new(few(5) - 2.0, few(5) - 2.0, few(5) * 0.5 - 1.0);
    let mut turn = Rotation3::identity();
    for axis in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)] {
        let eighths = [0.0, 0.0, 2.0, 4.0, 1.0][few(5) as usize];
        let (x, y, z) = axis;
        let by =
            Rotation3::from_axis_angle(Vec3::new(x, y, z), eighths * std::f64::consts::FRAC_PI_4);
        turn = turn * by;
    }
    let lengths = [few(3) * 0.5, few(3) * 0.5, few(3) * 0.5];
    Frame { at, turn, lengths }
}

macro_rules! same_in_few_digits {
    ($($A:ident $B:ident),*) => { $({
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        for k in 0..600 {
            let [first, second] = match k % 3 {
                0 => frames(&mut random, 9),
                _ => [frame(&mut random), frame(&mut random)],
            };
            let (few_a, few_b) = ($A::drawn(first).cast::<f32>(), $B::drawn(second).cast::<f32>());
            let (a, b): ($A<f64>, $B<f64>) = (few_a.cast(), few_b.cast());
            let bound = BOUND * a.size().max(b.size()).max((a.middle() - b.middle()).length());
            let wide = signed_distance(a, b);
            for (apart, [on_a, on_b]) in [
                (signed_distance(few_a, few_b), { let p = closest_points(few_a, few_b); [p.on_a, p.on_b] }),
                (signed_distance(few_b, few_a), { let p = closest_points(few_b, few_a); [p.on_b, p.on_a] }),
            ] {
                let (apart, on_a, on_b): (f64, Vec3<f64>, Vec3<f64>) = (apart.into(), on_a.cast(), on_b.cast());
                assert!((apart - wide).abs() <= bound, "{apart} for {wide}: {a:?} {b:?}");
                let outside = a.outside(on_a).max(b.outside(on_b));
                assert!(outside <= bound, "{outside} {a:?} {b:?}");
                let between = (on_b - on_a).length();
                assert!((between - apart.abs()).abs() <= bound, "{between} for {apart}: {a:?} {b:?}");
            }
        }
    })* };
}

/// The support of a flat ellipsoid jumps from end to end with a normal across it, whose rounding then counts.
#[test]
fn narrow_numbers_give_the_distances_of_wide_ones() {
    same_in_few_digits!(
        Ellipsoid Ellipsoid, Ellipsoid Cylinder, Ellipsoid Cone, Ellipsoid Disc, Ellipsoid Obb3, Ellipsoid Vec3,
        Ellipsoid Segment3, Cylinder Cylinder, Cylinder Cone, Cylinder Disc, Cylinder Obb3, Cone Cone, Cone Disc,
        Cone Obb3, Disc Disc, Disc Obb3, Disc Vec3, Disc Triangle3
    );
    let turned = |w: f32, x: f32| Rotation3 {
        w,
        x,
        y: 0.0,
        z: 0.0,
    };
    let plate = Ellipsoid::new(
        Vec3::new(0.0, 1.0, 0.0),
        Vec3::new(0.0, 0.5, 1.0),
        turned(1.0, 1.0),
    );
    let needle = Ellipsoid::new(
        Vec3::new(0.0, -1.0, -0.5),
        Vec3::new(0.0, 0.0, 0.5),
        turned(0.0, -1.0),
    );
    assert_eq!(signed_distance(plate, needle), 1.0);
    assert_eq!(signed_distance(needle, plate), 1.0);
}
