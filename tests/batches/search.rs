//! Searches over shapes with codes (polygons, which count their vertices), all pairs.
use geograd::kernels::Cpu;
use geograd::kernels::Iou;
use geograd::{ConvexPolygon, Fixed, Pack, Vec2};
use geograd_tests::Dice;
use std::f64::consts::TAU;

/// Regular polygons of three to five corners.
fn polygons(dice: &mut Dice, count: usize) -> Vec<ConvexPolygon<f64, 5>> {
    let mut one = || {
        let corners = 3 + dice.below(3);
        let center = Vec2::new(dice.within(-2.0, 2.0), dice.within(-2.0, 2.0));
        let radius = dice.within(0.5, 2.0);
        let corner = |k: usize| {
            let at = TAU * k as f64 / corners as f64;
            center + Vec2::new(radius * at.cos(), radius * at.sin())
        };
        ConvexPolygon::try_new(&(0..corners).map(corner).collect::<Vec<_>>()).unwrap()
    };
    std::iter::repeat_with(&mut one).take(count).collect()
}

#[test]
fn all_pairs_of_polygons_are_those_of_aligned_pairs() {
    let mut dice = Dice(5);
    let (a, b) = (polygons(&mut dice, 23), polygons(&mut dice, 37));
    let run = Iou;
    let cpu = Cpu::new();
    let table = cpu.all_pairs(run, &a, &b).unwrap();
    let derivatives = cpu.all_pairs(run.value_grad(), &a, &b).unwrap();
    let upstream: Vec<f64> = (0..a.len() * b.len()).map(|k| k as f64 - 400.0).collect();
    let (a_bar, b_bar) = cpu.all_pairs_vjp(run, &a, &b, &upstream).unwrap();
    let mut sums = [vec![vec![0.0; 10]; a.len()], vec![vec![0.0; 10]; b.len()]];
    let mut meeting = 0;
    for i in 0..a.len() {
        for j in 0..b.len() {
            let (iou, (by_a, by_b)) = cpu
                .aligned(run.value_grad(), (&a[i..=i], &b[j..=j]))
                .unwrap();
            meeting += usize::from(iou[0] > 0.0);
            assert_eq!(table.at(i, j), iou[0]);
            assert_eq!(derivatives.at(i, j), (iou[0], (by_a[0], by_b[0])));
            let by = upstream[i * b.len() + j];
            for (list, at, derivative) in [(0, i, by_a[0]), (1, j, by_b[0])] {
                for (sum, x) in sums[list][at].iter_mut().zip(derivative.scalars()) {
                    *sum += by * x;
                }
            }
        }
    }
    assert!(meeting > 100, "{meeting}");
    for (list, bars, shapes) in [(0, &a_bar, &a), (1, &b_bar, &b)] {
        for (i, bar) in bars.iter().enumerate() {
            assert_eq!(
                bar.codes(),
                shapes[i].codes(),
                "a gradient has its shape's vertices"
            );
            for (x, sum) in bar.scalars().iter().zip(&sums[list][i]) {
                assert!((x - sum).abs() <= 1e-9 * (1.0 + sum.abs()), "{x} {sum}");
            }
        }
    }
    let best = cpu.row_max(run, &a, &b).unwrap();
    for (i, best) in best.iter().enumerate() {
        let row = (0..b.len()).map(|j| table.at(i, j)).fold(0.0, f64::max);
        assert_eq!(best.value, row);
    }
}
