//! Second derivatives of the overlap of parallel boxes by all their numbers, beside differences of derivatives by hand.
use crate::second_order::by_hand;
use geograd::{Fixed, Jet, Obb3, Pose3, Rotation3, Vec3};
use std::array::from_fn;

/// The entries that agree with differences from both sides; a kink is where those differ.
fn compared(which: usize, x: [f64; 20]) -> usize {
    let (mut count, step) = (0, 1.0 / 65536.0);
    for i in 0..20 {
        let duals: [Jet<f64, 1>; 20] = from_fn(|k| Jet {
            value: x[k],
            derivative: [if k == i { 1.0 } else { 0.0 }],
        });
        let (a, b) = Fixed::load(&duals);
        let found = by_hand(which, a, b).map(|d| d.derivative[0]);
        let moved = |by: f64| {
            let mut x = x;
            x[i] += by;
            let (a, b): (Obb3<f64>, Obb3<f64>) = Fixed::load(&x);
            by_hand(which, a, b)
        };
        let (before, here, after) = (moved(-step), moved(0.0), moved(step));
        for j in 0..20 {
            let (left, right) = ((here[j] - before[j]) / step, (after[j] - here[j]) / step);
            let (mean, near) = ((left + right) / 2.0, 1e-3 * (1.0 + left.abs()));
            if (left - right).abs() < near {
                count += 1;
                let off = (found[j] - mean).abs();
                assert!(off < near, "{which} {i} {j} {x:?}: {} {mean}", found[j]);
            }
        }
    }
    count
}

/// Two boxes of eighths, the first one turned by zeros and ones: no two faces are in one plane.
fn boxes(dice: &mut geograd_tests::Dice, case: usize) -> [f64; 20] {
    let turns = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 0.0, -1.0, 0.0],
        [1.0, 1.0, 1.0, 1.0],
    ];
    let mut number = |least: i32| f64::from(dice.below(16) as i32 + least) / 8.0;
    let mut x = [0.0; 20];
    for k in [0, 10] {
        for i in 0..3 {
            // Odd multiples of a sixteenth.
            x[k + i] = number(-8) + if k == 10 { 0.0625 } else { 0.0 };
            x[k + 3 + i] = number(4) * 2.0;
        }
    }
    x[6..10].copy_from_slice(&turns[case % 5]);
    x[16] = 1.0;
    x
}

#[test]
fn overlaps_of_parallel_boxes_have_second_derivatives_by_all_numbers() {
    if !geograd_tests::is_due("overlaps_of_parallel_boxes_have_second_derivatives_by_all_numbers") {
        return;
    }
    let (mut dice, mut count) = (geograd_tests::Dice(5), 0);
    for case in 0..100 {
        let x = boxes(&mut dice, case);
        count += (0..3).map(|which| compared(which, x)).sum::<usize>();
    }
    assert!(count > 100_000, "{count}");
}

#[test]
fn overlaps_of_boxes_with_a_common_turn_have_second_derivatives_by_all_numbers() {
    if !geograd_tests::is_due(
        "overlaps_of_boxes_with_a_common_turn_have_second_derivatives_by_all_numbers",
    ) {
        return;
    }
    let turns = [
        Rotation3::new(0.6, 0.0, 0.0, 0.8),
        Rotation3::new(0.9, 0.1, -0.3, 0.2),
        Rotation3::new(0.5, -0.5, 0.25, 0.75),
    ];
    let (mut dice, mut count) = (geograd_tests::Dice(7), 0);
    for case in 0..60 {
        let (a, b): (Obb3<f64>, Obb3<f64>) = Fixed::load(&boxes(&mut dice, case));
        let turn = turns[case % 3].normalized();
        let turned = |shape: Obb3<f64>| Pose3::new(Vec3::zero(), turn) * shape;
        let mut x = [0.0; 20];
        (turned(a), turned(b)).store(&mut x);
        count += (0..3).map(|which| compared(which, x)).sum::<usize>();
    }
    assert!(count > 60_000, "{count}");
}
