//! The nine first operations, bit for bit: values and derivatives at many inputs as one number each. Whoever
//! changes a bit on purpose records the new number and says why.
//!
//! Sines of large angles are those of the system's library; so the numbers are those of one system.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]
use geograd::ad::adjoint::{overlap as obb, ring as rings};
use geograd::{Aabb2, Fixed, Obb2, Pack, Scalar, Vec2, overlap, ring};
use geograd_tests::Dice;

/// Numbers of one format, folded into one (FNV-1a).
struct Print(u64);

impl Print {
    fn take<P: Pack>(&mut self, shape: &P)
    where
        P::Scalar: Into<f64> + Copy,
    {
        for x in shape.scalars() {
            for byte in x.into().to_bits().to_le_bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
}

fn print(run: impl FnOnce(&mut Print)) -> u64 {
    let mut print = Print(0xcbf2_9ce4_8422_2325);
    run(&mut print);
    print.0
}

/// A box and another one, now and then the same, touching, or turned by a quarter.
fn boxes(dice: &mut Dice) -> [Obb2<f64>; 2] {
    let mut one = || {
        let [x, y, w, h, heading] = std::array::from_fn(|_| dice.within(-2.0, 2.0));
        Obb2::new(x, y, 0.1 + w.abs(), 0.1 + h.abs(), heading)
    };
    let (a, mut b) = (one(), one());
    match dice.below(8) {
        0 => b = a,
        1 => b.center.x = a.center.x + (a.size.x + b.size.x) / 2.0,
        2 => b.heading = a.heading,
        3 => b.heading = a.heading + std::f64::consts::FRAC_PI_2,
        _ => (),
    }
    [a, b]
}

fn bounds(shape: Obb2<f64>) -> Aabb2<f64> {
    let (low, high) = (
        shape.center - shape.size * 0.5,
        shape.center + shape.size * 0.5,
    );
    Aabb2::new(low.x, low.y, high.x, high.y)
}

const PAIRS: usize = 20_000;

/// Areas of intersection, IoU, IoF of rotated boxes, of axis-aligned ones; area, perimeter, centroid.
const DOUBLE: [u64; 9] = [
    0x949c_6d09_24ed_d7b5,
    0xbef2_bbfe_8e4b_295c,
    0x2893_eaae_19f6_e1d7,
    0x7cf2_c624_be3d_0c55,
    0xf1de_5695_6d7b_7cbc,
    0xc2ad_50a7_33f8_b869,
    0xe973_9bea_9d01_c743,
    0x14af_a73a_e387_110b,
    0x470d_fb8b_be88_944c,
];
const SINGLE: [u64; 9] = [
    0xccb3_ec6f_c2f3_9be7,
    0x08a8_904d_46a5_b6a5,
    0x299f_4122_e44b_1993,
    0x5de2_d0d0_f412_c509,
    0x3994_2d8b_211e_cfe9,
    0x82b5_47da_bf2a_e65d,
    0x3eaf_564b_820c_7c5c,
    0x8819_a33e_fc29_e841,
    0x032a_dcdb_64f7_d7e3,
];

macro_rules! pairs {
    ($t:ident, $value:path, $grad:path, $made:expr) => {
        print(|print| {
            let mut dice = Dice(9);
            for _ in 0..PAIRS {
                let [a, b] = boxes(&mut dice).map($made).map(|shape| shape.cast::<$t>());
                print.take(&$value(a, b));
                let (value, (a_bar, b_bar)) = $grad(a, b);
                print.take(&value);
                print.take(&a_bar);
                print.take(&b_bar);
            }
        })
    };
}

fn ringed<S, O>(value: fn(&[Vec2<S>]) -> O, vjp: fn(&[Vec2<S>], O, &mut [Vec2<S>])) -> u64
where
    S: Scalar + Into<f64>,
    O: Fixed<Scalar = S>,
{
    print(|print| {
        let mut dice = Dice(10);
        for _ in 0..PAIRS / 4 {
            let count = 3 + dice.below(9);
            let mut vertex = || Vec2::new(dice.within(-3.0, 3.0), dice.within(-3.0, 3.0));
            let ring: Vec<Vec2<S>> = (0..count)
                .map(|_| vertex().remake(&mut |&x| S::lit(x)))
                .collect();
            print.take(&value(&ring));
            let mut bars = vec![Vec2::zero(); count];
            vjp(&ring, O::filled(S::one()), &mut bars);
            print.take(&bars);
        }
    })
}

macro_rules! prints {
    ($t:ident) => {
        [
            pairs!(
                $t,
                overlap::intersection_area_obb2,
                obb::intersection_area_obb2_grad,
                |x| x
            ),
            pairs!($t, overlap::iou_obb2, obb::iou_obb2_grad, |x| x),
            pairs!($t, overlap::iof_obb2, obb::iof_obb2_grad, |x| x),
            pairs!(
                $t,
                overlap::intersection_area_aabb2,
                obb::intersection_area_aabb2_grad,
                bounds
            ),
            pairs!($t, overlap::iou_aabb2, obb::iou_aabb2_grad, bounds),
            pairs!($t, overlap::iof_aabb2, obb::iof_aabb2_grad, bounds),
            ringed::<$t, $t>(ring::signed_area, rings::signed_area_vjp),
            ringed::<$t, $t>(ring::perimeter, rings::perimeter_vjp),
            ringed::<$t, Vec2<$t>>(ring::centroid, rings::centroid_vjp),
        ]
    };
}

#[test]
fn in_single_precision() {
    assert_eq!(prints!(f32), SINGLE, "as hexadecimal: {:#x?}", prints!(f32));
}

#[test]
fn in_double_precision() {
    assert_eq!(prints!(f64), DOUBLE, "as hexadecimal: {:#x?}", prints!(f64));
}
