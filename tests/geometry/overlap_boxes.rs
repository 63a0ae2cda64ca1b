//! Overlap scores: right values by an independent oracle_boxes, ranges, symmetry,
//! invariance, exact answers for identical and separate boxes, finite results everywhere.
use crate::oracle_boxes;

use geograd::ad::adjoint::overlap::{iou_aabb2_grad, iou_obb2_grad};
use geograd::ad::check::strategy::{self, ordinary, thin, touching};
use geograd::overlap::{intersection_area_obb2, iof_obb2, iou_aabb2, iou_obb2};
use geograd::{Aabb2, Obb2, Pack, Scalar, Vec2};
use geograd_tests::calls;
use proptest::prelude::*;

/// A small reproducible source of numbers in `[0, 1)`.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        ((mixed ^ (mixed >> 29)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }
    /// The distribution of the paper's benchmark.
    fn obb(&mut self) -> Obb2<f64> {
        Obb2::new(
            self.within(-5.0, 5.0),
            self.within(-5.0, 5.0),
            self.within(0.0, 5.0),
            self.within(0.0, 5.0),
            self.within(-5.0, 5.0),
        )
    }
}

fn narrow(x: Obb2<f64>) -> Obb2<f32> {
    x.remake(&mut |&x| x as f32)
}

fn widen(x: Obb2<f32>) -> Obb2<f64> {
    x.remake(&mut |&x| f64::from(x))
}

#[test]
fn f64_agrees_with_the_oracle_on_random_boxes() {
    let mut dice = Dice(1);
    for _ in 0..3000 {
        let (a, b) = (dice.obb(), dice.obb());
        let (got, exact) = (iou_obb2(a, b), oracle_boxes::iou(a, b));
        assert!(
            (got - exact).abs() < 1e-12,
            "{a} and {b}: {got}, exactly {exact}"
        );
    }
}

#[test]
fn f32_agrees_with_the_oracle_on_random_boxes() {
    let mut dice = Dice(2);
    for _ in 0..3000 {
        let (a, b) = (narrow(dice.obb()), narrow(dice.obb()));
        let (got, exact) = (iou_obb2(a, b), oracle_boxes::iou(widen(a), widen(b)));
        assert!(
            (f64::from(got) - exact).abs() < 2e-6,
            "{a} and {b}: {got}, exactly {exact}"
        );
    }
}

/// A million pairs, against f64 (which the oracle_boxes vouches for above).
#[test]
fn f32_agrees_with_f64_on_a_million_pairs() {
    use geograd_tests::rows::IouObb2;
    let mut dice = Dice(3);
    let mut list = || (0..1000).map(|_| narrow(dice.obb())).collect::<Vec<_>>();
    let (a, b) = (list(), list());
    let wide = |list: &[Obb2<f32>]| list.iter().map(|&x| widen(x)).collect::<Vec<_>>();
    let got = calls::all_pairs::<IouObb2, f32>(&a, &b).unwrap();
    let exact = calls::all_pairs::<IouObb2, f64>(&wide(&a), &wide(&b)).unwrap();
    for (got, exact) in got.iter().zip(&exact) {
        assert!(
            (f64::from(*got) - exact).abs() < 2e-6,
            "{got}, exactly {exact}"
        );
    }
}

/// Far from the origin and small: as exact as the inputs' own rounding.
#[test]
fn far_and_small_boxes_keep_their_digits() {
    let mut dice = Dice(4);
    for _ in 0..500 {
        // Centres on the grid that f32 has at 1e5, sizes of a few of its steps.
        let step = 2f64.powi(-7);
        let mut place = || 1e5 + (dice.within(-4.0, 4.0)).round() * step;
        let (x, y, u, v) = (place(), place(), place(), place());
        let mut size = || dice.within(1.0, 6.0) * step;
        let (w, h, p, q) = (size(), size(), size(), size());
        let a = narrow(Obb2::new(x, y, w, h, dice.within(-5.0, 5.0)));
        let b = narrow(Obb2::new(u, v, p, q, dice.within(-5.0, 5.0)));
        let exact = oracle_boxes::iou(widen(a), widen(b));
        assert!(
            (f64::from(iou_obb2(a, b)) - exact).abs() < 2e-6,
            "{a} and {b}"
        );
        let (a, b) = (widen(a), widen(b));
        assert!((iou_obb2(a, b) - exact).abs() < 1e-12, "{a} and {b}");
    }
    let a = Obb2::new(1e5, -1e5, 1e-4, 2e-4, 0.3);
    let b = Obb2::new(1e5 + 3e-5, -1e5, 1e-4, 2e-4, 0.4);
    assert!((iou_obb2(a, b) - oracle_boxes::iou(a, b)).abs() < 1e-12);
}

/// Thin boxes a hair's breadth from parallel, shifted along and across each other, at any heading,
/// at the origin (where differences of centres are exact) and elsewhere.
#[test]
fn thin_nearly_parallel_boxes() {
    let mut dice = Dice(5);
    for i in 0..2000 {
        let heading = dice.within(-3.2, 3.2) as f32;
        let apart = 10f64.powf(dice.within(-7.0, -3.0)) as f32;
        let quarter = if i % 3 == 0 {
            std::f32::consts::FRAC_PI_2
        } else {
            0.0
        };
        // Fifty thousand times longer than wide, and a million times.
        let (thin, limit) = match i % 5 {
            0 => (5e-5, 2e-5),
            _ => (1e-3, 2e-6),
        };
        let (along, across) = (dice.within(-20.0, 20.0), dice.within(-0.8, 0.8) * thin);
        let (sin, cos) = f64::from(heading).sin_cos();
        let (x, y) = (along * cos - across * sin, along * sin + across * cos);
        let (w, h) = if i % 3 == 0 {
            (thin as f32, 50.0)
        } else {
            (50.0, thin as f32)
        };
        let (x0, y0) = match i % 2 {
            0 => (0.0, 0.0),
            _ => (dice.within(-50.0, 50.0), dice.within(-50.0, 50.0)),
        };
        let a = Obb2::new(x0 as f32, y0 as f32, 50.0, thin as f32, heading);
        let (x, y) = ((x0 + x) as f32, (y0 + y) as f32);
        let b = Obb2::new(x, y, w, h, heading + apart + quarter);
        let exact = oracle_boxes::iou(widen(a), widen(b));
        for (a, b) in [(a, b), (b, a)] {
            let got = f64::from(iou_obb2(a, b));
            assert!(
                (got - exact).abs() < limit,
                "{a} and {b}: {got}, exactly {exact}"
            );
        }
        let got = iou_obb2(widen(a), widen(b));
        assert!(
            (got - exact).abs() < 1e-10,
            "{a} and {b}: {got}, exactly {exact}"
        );
    }
}

/// Boxes whose products are exact ties, in every combination.
fn hard() -> Vec<Obb2<f64>> {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let mut all = Vec::new();
    for heading in [0.0, FRAC_PI_2, PI, FRAC_PI_4, 0.5, 1e-7] {
        for (x, y) in [
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (2.0, 0.0),
            (0.5, 0.25),
            (1e5, 1e5),
        ] {
            for (w, h) in [
                (2.0, 2.0),
                (4.0, 2.0),
                (2.0, 1.0),
                (0.0, 2.0),
                (0.0, 0.0),
                (1e-3, 50.0),
            ] {
                all.push(Obb2::new(x, y, w, h, heading));
            }
        }
    }
    all
}

#[test]
fn hard_pairs_agree_with_the_oracle() {
    if !geograd_tests::is_due("hard_pairs_agree_with_the_oracle") {
        return;
    }
    for (i, &a) in hard().iter().enumerate() {
        // Every pair would be 46,656 exact clippings; a stride prime to all factors samples them.
        for &b in hard().iter().skip(i % 7).step_by(7) {
            let exact = oracle_boxes::iou(a, b);
            let got = iou_obb2(a, b);
            assert!(
                (got - exact).abs() < 1e-10,
                "{a} and {b}: {got}, exactly {exact}"
            );
            let (a, b) = (narrow(a), narrow(b));
            let exact = oracle_boxes::iou(widen(a), widen(b));
            let got = f64::from(iou_obb2(a, b));
            assert!(
                (got - exact).abs() < 1e-4,
                "{a} and {b}: {got}, exactly {exact}"
            );
        }
    }
}

/// Scores and derivatives of every pair of hard boxes are finite, within range, and agree in format.
fn sound<S: Scalar<Mask = bool> + Into<f64>>(a: Obb2<S>, b: Obb2<S>) {
    let (iou, (a_bar, b_bar)) = iou_obb2_grad(a, b);
    assert!(
        iou.at_least(S::zero()) && iou.at_most(S::one()),
        "{a:?} {b:?}: {iou:?}"
    );
    for derivative in (a_bar, b_bar).scalars() {
        assert!(
            Into::<f64>::into(derivative).is_finite(),
            "{a:?} {b:?}: {a_bar:?} {b_bar:?}"
        );
    }
    let iof = iof_obb2(a, b);
    assert!(
        iof.at_least(S::zero()) && iof.at_most(S::one()),
        "{a:?} {b:?}: {iof:?}"
    );
    let inter: f64 = intersection_area_obb2(a, b).into();
    assert!(inter.is_finite() && inter >= 0.0);
}

#[test]
fn hard_pairs_are_sound() {
    for &a in &hard() {
        for &b in &hard() {
            sound(a, b);
            sound(narrow(a), narrow(b));
        }
    }
}

#[test]
fn extreme_sizes_are_sound() {
    let sizes: [f64; 11] = [
        0.0, 1e-300, 1e-40, 1e-20, 1e-5, 1.0, 1e5, 1e20, 1e37, 1e150, 1e307,
    ];
    for &s in &sizes {
        for &t in &sizes {
            for place in [0.0, 0.3, 1.0, 1e10] {
                for heading in [0.0, 0.7, 1e6, 1e300] {
                    let a = Obb2::new(0.0, 0.0, s, s / 2.0, 0.1);
                    let b = Obb2::new(place * s, place * t, t / 3.0, t, heading);
                    sound(a, b);
                    if s < 1e38 && t < 1e38 && heading < 1e38 && place * s.max(t) < 1e38 {
                        sound(narrow(a), narrow(b));
                    }
                }
            }
        }
    }
    // Scaled alike, the same bits.
    let unit = Obb2::new(0.25, 0.5, 2.0, 1.0, 0.3);
    let other = Obb2::new(0.5, 0.125, 1.5, 3.0, 1.1);
    let scaled = |x: Obb2<f64>, by: f64| Obb2 {
        center: x.center * by,
        size: x.size * by,
        ..x
    };
    for by in [
        2f64.powi(-1000),
        2f64.powi(-60),
        2f64.powi(60),
        2f64.powi(1000),
    ] {
        assert_eq!(
            iou_obb2(scaled(unit, by), scaled(other, by)),
            iou_obb2(unit, other)
        );
    }
}

#[test]
fn identical_boxes_give_one_and_no_derivative() {
    let mut dice = Dice(6);
    for _ in 0..20_000 {
        let a = dice.obb();
        if a.area() == 0.0 {
            continue;
        }
        let (iou, derivatives) = iou_obb2_grad(a, a);
        assert_eq!(iou, 1.0, "{a}");
        assert!(
            derivatives.scalars().iter().all(|&s| s == 0.0),
            "{a}: {derivatives:?}"
        );
        let a = narrow(a);
        let (iou, derivatives) = iou_obb2_grad(a, a);
        assert_eq!(iou, 1.0, "{a}");
        assert!(
            derivatives.scalars().iter().all(|&s| s == 0.0),
            "{a}: {derivatives:?}"
        );
    }
}

#[test]
fn boxes_that_are_apart_or_touch_give_zero_and_no_derivative() {
    let mut dice = Dice(7);
    let mut found = 0;
    for _ in 0..20_000 {
        let (a, b) = (dice.obb(), dice.obb());
        // Separated for certain: their circles do not meet.
        let reach = (a.size.length() + b.size.length()) / 2.0;
        if a.center.distance(b.center) > reach * (1.0 + 1e-6) {
            found += 1;
            let (iou, derivatives) = iou_obb2_grad(a, b);
            assert_eq!(iou, 0.0);
            assert!(derivatives.scalars().iter().all(|&s| s == 0.0));
        }
    }
    assert!(found > 1000);
    let square = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
    for touching in [
        Obb2::new(2.0, 0.0, 2.0, 2.0, 0.0),
        Obb2::new(2.0, 2.0, 2.0, 2.0, 0.0),
    ] {
        let (iou, derivatives) = iou_obb2_grad(square, touching);
        assert_eq!(iou, 0.0);
        assert!(derivatives.scalars().iter().all(|&s| s == 0.0));
    }
}

/// Bugs of other libraries that must not come back: their inputs and the true values.
#[test]
fn cases_that_others_get_wrong() {
    let case = |a: [f64; 5], b: [f64; 5], exact: f64| {
        let shape = |x: [f64; 5]| Obb2::new(x[0], x[1], x[2], x[3], x[4]);
        let got = iou_obb2(shape(a), shape(b));
        assert!(
            (got - exact).abs() < 1e-12,
            "{a:?} {b:?}: {got}, exactly {exact}"
        );
    };
    // Equal headings: reported as containment.
    case([0.0, 0.0, 2.0, 2.0, 0.3], [10.0, 0.0, 2.0, 2.0, 0.3], 0.0);
    case(
        [0.0, 0.0, 2.0, 2.0, 0.0],
        [1.0, 0.0, 2.0, 2.0, 0.0],
        1.0 / 3.0,
    );
    // Axis-aligned: 4 × 2 shifted by half, 4 × 2 with 2 × 4, a thin one far away.
    case(
        [0.0, 0.0, 4.0, 2.0, 0.0],
        [2.0, 0.0, 4.0, 2.0, 0.0],
        1.0 / 3.0,
    );
    case(
        [0.0, 0.0, 4.0, 2.0, 0.0],
        [0.0, 0.0, 2.0, 4.0, 0.0],
        1.0 / 3.0,
    );
    case([0.0, 0.0, 100.0, 2.0, 0.0], [0.0, 50.0, 2.0, 2.0, 0.0], 0.0);
    // The same box turned by a quarter.
    let quarter = std::f64::consts::FRAC_PI_2;
    case(
        [1.0, 2.0, 3.0, 3.0, 0.0],
        [1.0, 2.0, 3.0, 3.0, quarter],
        1.0,
    );
    case(
        [1.0, 2.0, 3.0, 1.0, 0.2],
        [1.0, 2.0, 1.0, 3.0, 0.2 + quarter],
        1.0,
    );
    // The derivative of equal axis-aligned boxes is not ±1.
    let square = Aabb2::new(0.0, 0.0, 1.0, 1.0);
    let (iou, derivatives) = iou_aabb2_grad(square, square);
    assert_eq!(iou, 1.0);
    assert!(derivatives.scalars().iter().all(|&s: &f64| s == 0.0));
}

/// Any two boxes: tiny, huge, far, thin, touching, with ties.
fn any_pair() -> impl Strategy<Value = (Obb2<f64>, Obb2<f64>)> {
    prop_oneof![
        strategy::any(),
        strategy::hard(),
        strategy::tiny(),
        strategy::huge()
    ]
}

/// Boxes of ordinary size, some thin.
fn obb() -> impl Strategy<Value = Obb2<f64>> {
    prop_oneof![3 => ordinary::<Obb2<f64>>(), 1 => thin()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn symmetric(a in obb(), b in obb()) {
        let (ab, ba) = (iou_obb2(a, b), iou_obb2(b, a));
        prop_assert!((ab - ba).abs() < 1e-12, "{ab} {ba}");
    }

    #[test]
    fn ratios_of_any_boxes_stay_in_bounds((a, b) in any_pair()) {
        let (iou, derivatives) = iou_obb2_grad(a, b);
        prop_assert!((0.0..=1.0).contains(&iou), "{iou}");
        prop_assert!(derivatives.scalars().iter().all(|s| s.is_finite()));
        let single: f32 = iou_obb2(a.cast::<f32>(), b.cast::<f32>());
        prop_assert!((0.0..=1.0).contains(&single), "{single}");
    }

    #[test]
    fn touching_boxes_share_no_more_than_rounding((a, b) in touching::<(Obb2<f64>, Obb2<f64>)>()) {
        prop_assert!(iou_obb2(a, b) < 1e-12, "{}", iou_obb2(a, b));
    }

    #[test]
    fn invariant_under_motion_and_scale(
        a in obb(), b in obb(), turn in -3.0..3.0, x in -100.0..100.0, y in -100.0..100.0,
        scale in 0.01..100.0,
    ) {
        let motion = geograd::Pose2::new(Vec2::new(x, y), turn);
        let moved = |s: Obb2<f64>| {
            let there = motion * s;
            Obb2 { center: there.center * scale, size: there.size * scale, ..there }
        };
        // The motion itself rounds at 1e-14 of 100; thin boxes of 1e-3 make that 1e-9.
        prop_assert!((iou_obb2(a, b) - iou_obb2(moved(a), moved(b))).abs() < 1e-8);
    }

    #[test]
    fn a_half_turn_changes_nothing(a in obb(), b in obb()) {
        let turned = Obb2 { heading: b.heading + std::f64::consts::PI, ..b };
        prop_assert!((iou_obb2(a, b) - iou_obb2(a, turned)).abs() < 1e-10);
    }

    #[test]
    fn cutting_a_box_cuts_its_overlap(a in obb(), b in obb(), cut in 0.0..1.0_f64) {
        // Area is additive over the two parts of a box.
        let along = |shift: f64, share: f64| Obb2 {
            center: b.center + b.world_from_local().rotation * Vec2::new(b.size.x * shift, 0.0),
            size: Vec2::new(b.size.x * share, b.size.y),
            ..b
        };
        let left = along(-(1.0 - cut) / 2.0, cut);
        let right = along(cut / 2.0, 1.0 - cut);
        let (whole, parts) = (
            a.intersection_area(b),
            a.intersection_area(left) + a.intersection_area(right),
        );
        prop_assert!((whole - parts).abs() < 1e-11 * (1.0 + whole), "{whole} {parts}");
    }

    #[test]
    fn growing_never_shrinks_the_overlap(a in obb(), b in obb(), by in 0.0..2.0) {
        let grown = Obb2 { size: b.size + Vec2::new(by, by), ..b };
        prop_assert!(a.intersection_area(grown) >= a.intersection_area(b) - 1e-12);
    }

    #[test]
    fn aabb_is_an_obb_without_heading(
        x in -5.0..5.0, y in -5.0..5.0, w in 0.0..5.0, h in 0.0..5.0,
        u in -5.0..5.0, v in -5.0..5.0, p in 0.0..5.0, q in 0.0..5.0,
    ) {
        let a: Aabb2<f64> = Aabb2::new(x, y, x + w, y + h);
        let b = Aabb2::new(u, v, u + p, v + q);
        prop_assert!((iou_aabb2(a, b) - iou_obb2(a.into(), b.into())).abs() < 1e-12);
        let area: f64 = a.intersection_area(b);
        prop_assert!((area - Obb2::from(a).intersection_area(b.into())).abs() < 1e-12);
    }

    #[test]
    fn moving_both_boxes_changes_nothing(a in obb(), b in obb()) {
        // So the derivatives of both centres cancel, and turning about the origin gives no torque.
        let (_, (a_bar, b_bar)) = iou_obb2_grad(a, b);
        let sum = a_bar.center + b_bar.center;
        let size = a_bar.center.length() + 1.0;
        prop_assert!(sum.length() < 1e-12 * size);
        let torque = a.center.perp_dot(a_bar.center) + b.center.perp_dot(b_bar.center)
            + a_bar.heading + b_bar.heading;
        prop_assert!(torque.abs() < 1e-9 * size, "{torque}");
        // Scaling everything changes nothing either (Euler).
        let euler = a.center.dot(a_bar.center) + b.center.dot(b_bar.center)
            + a.size.dot(a_bar.size) + b.size.dot(b_bar.size);
        prop_assert!(euler.abs() < 1e-9 * size, "{euler}");
    }
}
