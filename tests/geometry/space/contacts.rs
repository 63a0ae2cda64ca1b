//! Capsules, segments and boxes that touch within rounding: the shift that is told parts them.
use super::draw::Random;
use geograd::distance3::{distance, penetration};
use geograd::prelude::*;

/// A rotation at random.
fn turn(random: &mut Random) -> Rotation3<f64> {
    let v = random.vector(1.0);
    Rotation3::new(random.within(-1.0, 1.0), v.x, v.y, v.z)
}

/// Shifts b by what is told, and says by how much they still overlap.
macro_rules! parts {
    ($a:expr, $b:expr, $radius:expr, $S:ty, $error:expr) => {{
        let (a, link) = ($a, $b);
        let b = Capsule3::new(link.start, link.end, $radius).cast::<$S>();
        let found = penetration(a, b);
        let core = Segment3::new(b.start, b.end);
        let gap = f64::from(distance(a, core));
        assert!(gap < $error, "{a:?} {b:?}: they touch");
        // Two points that are one have no direction.
        if gap > 0.0 || found.direction.length() > 0.0 {
            let length = f64::from(found.direction.length());
            assert!((length - 1.0).abs() < $error, "{a:?} {b:?}: {found:?}");
            let shift = found.direction * found.depth;
            let moved = Capsule3::new(b.start + shift, b.end + shift, b.radius);
            let left = f64::from(a.signed_distance(moved));
            assert!(left > -$error, "{a:?} {b:?}: {found:?} leaves {left}");
        }
    }};
}

macro_rules! contacts {
    ($name:ident, $S:ty, $error:expr) => {
        #[test]
        fn $name() {
            let mut random = Random(0x5eed);
            for _ in 0..300 {
                let radius = random.within(0.05, 0.3);
                let [x, y, z] = [0; 3].map(|_| random.within(0.1, 0.6));
                let solid = Obb3::new(random.vector(1.0), Vec3::new(x, y, z), turn(&mut random));
                let part = |random: &mut Random| [-0.5, 0.5, random.within(-0.5, 0.5)];
                let parts = [part(&mut random), part(&mut random), part(&mut random)];
                // A corner, a point of an edge, or of a face.
                let free = random.below(4);
                let side = |random: &mut Random, k: usize| {
                    parts[k][if k + 1 == free { 2 } else { random.below(2) }]
                };
                let at = Vec3::new(
                    side(&mut random, 0),
                    side(&mut random, 1),
                    side(&mut random, 2),
                );
                let at = solid.center
                    + solid.rotation
                        * Vec3::new(
                            at.x * solid.size.x,
                            at.y * solid.size.y,
                            at.z * solid.size.z,
                        );
                // Outwards on both sides: across the way from the centre.
                let out = at - solid.center;
                let way = out.cross(random.vector(1.0));
                let (s, t) = (random.within(0.2, 1.0), random.within(0.2, 1.0));
                let link = Segment3::new(at - way * s, at + way * t);
                let near = solid.cast::<$S>();
                let reach = Segment3::new(link.start, link.end).cast::<$S>();
                if f64::from(near.signed_distance(reach)) > -$error {
                    parts!(near, link, radius, $S, $error);
                }
                // An end on another axis, and axes that cross.
                let (p, q) = (random.vector(1.0), random.vector(1.0));
                let other = Segment3::new(p, q);
                let touch = p + (q - p) * random.within(0.0, 1.0);
                let way = random.vector(1.0);
                let back = [0.0, 0.5][random.below(2)];
                let link = Segment3::new(touch - way * back, touch + way);
                let round = Capsule3::new(other.start, other.end, 0.0).cast::<$S>();
                parts!(round, link, radius, $S, $error);
                let flat = Triangle3::new(p, q, random.vector(1.0));
                let touch =
                    p + (q - p) * random.within(0.1, 0.4) + (flat.c - p) * random.within(0.1, 0.4);
                let link = Segment3::new(touch, touch + way);
                parts!(flat.cast::<$S>(), link, radius, $S, $error);
            }
        }
    };
}
contacts!(shifts_part_what_touches_within_rounding, f64, 1e-13);
contacts!(
    shifts_part_what_touches_within_rounding_in_single_precision,
    f32,
    4e-5
);
