//! Shapes of the plane whose cores touch within rounding: the shift that is told parts them.
use geograd::distance::{penetration, signed_distance};
use geograd::prelude::*;

macro_rules! contacts {
    ($name:ident, $S:ty, $error:expr) => {
        #[test]
        fn $name() {
            // One decimal, which no format has: ends on the other axis are beside it by rounding.
            let at = |k: i32| f64::from(k) / 10.0;
            let mut touching = 0;
            for n in 0..20_000_i32 {
                let digit =
                    |k: u32| (n.wrapping_mul(2_654_435).rotate_left(7 * k) & 0xffff) % 13 - 6;
                let (p, q) = (
                    Vec2::new(at(digit(0)), at(digit(1))),
                    Vec2::new(at(digit(2)), at(digit(3))),
                );
                let part = at((digit(4) + 6) % 11);
                let end = p + (q - p) * part;
                let other = Vec2::new(at(digit(5)), at(digit(1) + digit(4)));
                let a = Capsule2::new(p, q, 0.2).cast::<$S>();
                let b = Capsule2::new(end, other, 0.1).cast::<$S>();
                let (axis, link) = (Segment2::new(a.from, a.to), Segment2::new(b.from, b.to));
                if f64::from(axis.signed_distance(link)) < -$error {
                    continue;
                }
                touching += 1;
                for (a, b) in [(a, b), (b, a)] {
                    let found = penetration(a, b);
                    let shift = found.direction * found.depth;
                    let moved = Capsule2::new(b.from + shift, b.to + shift, b.radius);
                    let left = f64::from(signed_distance(a, moved));
                    // Two points that are one have no direction.
                    let none = found.direction.length() == 0.0;
                    assert!(
                        none || left > -$error,
                        "{a:?} {b:?}: {found:?} leaves {left}"
                    );
                }
            }
            assert!(touching > 5_000, "{touching}");
        }
    };
}
contacts!(shifts_part_axes_that_touch_within_rounding, f64, 1e-13);
contacts!(
    shifts_part_axes_that_touch_within_rounding_in_single_precision,
    f32,
    1e-5
);

#[test]
fn capsules_whose_axes_cross_by_rounding_part() {
    let a = Capsule2::new(Vec2::new(-0.7_f32, -0.7), Vec2::new(0.3, -0.3), 0.2);
    let b = Capsule2::new(Vec2::new(-0.9_f32, 0.9), Vec2::new(0.5, -0.5), 0.1);
    let found = penetration(a, b);
    let shift = found.direction * found.depth;
    let moved = Capsule2::new(b.from + shift, b.to + shift, b.radius);
    assert!(signed_distance(a, moved) > -1e-6, "{found:?}");
}
