//! The same numbers as on the CPU.
use crate::bounds::{EPSILON, ROUNDINGS, close, slope_bounds, value_bound};
use crate::shapes::{Draw, Draws, bits, fields, pairs, shape_of};
use crate::{gpu, small};

use geograd::kernels::Backend;
use geograd::kernels::gpu::{Gpu, GpuPair, Options};
use geograd::kernels::ops::overlap;
use geograd::kernels::{Table, reduce};
use geograd::{Aabb2, Fixed, Obb2, Pack};
use geograd_tests::calls;

pub fn aligned_agree<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let (a, b) = pairs::<O::Shape>(300);
    let (on_a, on_b) = (gpu.upload(&a).unwrap(), gpu.upload(&b).unwrap());
    let expected = Backend::Cpu.aligned_grad(O::default(), &a, &b).unwrap();
    let values = gpu
        .aligned(O::default(), &on_a, &on_b)
        .unwrap()
        .download()
        .unwrap();
    let (same, a_bars, b_bars) = gpu.aligned_grad(O::default(), &on_a, &on_b).unwrap();
    let (same, a_bars, b_bars) = (
        same.download().unwrap(),
        a_bars.download().unwrap(),
        b_bars.download().unwrap(),
    );
    assert_eq!(values.len(), a.len());
    let mut draws = Draws(3);
    for i in 0..a.len() {
        let found = f64::from(values[i]);
        let bound = value_bound::<O>(a[i], b[i], f64::from(expected.0[i]));
        for found in [found, f64::from(same[i])] {
            assert!(
                (found - f64::from(expected.0[i])).abs() <= bound,
                "{} {i}: {:?} {:?}: {found} for {} ± {bound}",
                O::NAME,
                a[i],
                b[i],
                expected.0[i]
            );
        }
        let found = [fields(a_bars[i]), fields(b_bars[i])].concat();
        let expected = [fields(expected.1[i]), fields(expected.2[i])].concat();
        let bounds = slope_bounds::<O>(a[i], b[i], f64::from(values[i]), &mut draws);
        for k in 0..found.len() {
            assert!(
                (found[k] - expected[k]).abs() <= bounds[k],
                "{} {i}, slope {k}: {:?} {:?}: {} for {} ± {}",
                O::NAME,
                a[i],
                b[i],
                found[k],
                expected[k],
                bounds[k]
            );
        }
    }
    // An upstream of ones changes nothing, one of twos doubles exactly.
    for (factor, upstream) in [(1.0, vec![1.0; a.len()]), (2.0, vec![2.0; a.len()])] {
        let upstream = gpu.upload_values(&upstream).unwrap();
        let (again, _) = gpu
            .aligned_vjp(O::default(), &on_a, &on_b, &upstream)
            .unwrap();
        for (again, once) in again.download().unwrap().iter().zip(&a_bars) {
            for (again, once) in fields(*again).iter().zip(fields(*once)) {
                assert_eq!(*again, once * factor);
            }
        }
    }
}

pub fn all_pairs_agree<O: GpuPair>(gpu: &Gpu, rows: usize, columns: usize)
where
    O::Shape: Draw,
{
    let mut draws = Draws(11);
    let a: Vec<O::Shape> = (0..rows).map(|_| Draw::draw(&mut draws)).collect();
    let b: Vec<O::Shape> = (0..columns).map(|_| Draw::draw(&mut draws)).collect();
    let (on_a, on_b) = (gpu.upload(&a).unwrap(), gpu.upload(&b).unwrap());
    let matrix = gpu.all_pairs(O::default(), &on_a, &on_b).unwrap();
    let values = matrix.download().unwrap();
    let expected = Backend::Cpu.all_pairs(O::default(), &a, &b).unwrap();
    assert_eq!(values.len(), expected.len());
    for (at, (&found, &value)) in values.iter().zip(&expected).enumerate() {
        let bound = value_bound::<O>(a[at / columns], b[at % columns], f64::from(value));
        assert!(
            (f64::from(found) - f64::from(value)).abs() <= bound,
            "{} {at}: {found} for {value}",
            O::NAME
        );
    }

    // Sums: whatever the order, an error of one epsilon of the sum of magnitudes per term.
    let grads = gpu
        .all_pairs_grad(O::default(), &on_a, &on_b)
        .unwrap()
        .download()
        .unwrap();
    let upstream: Vec<f32> = (0..values.len()).map(|_| draws.next() - 0.5).collect();
    let on_upstream = gpu.upload_matrix(rows, columns, &upstream).unwrap();
    let (a_bars, b_bars) = gpu
        .all_pairs_vjp(O::default(), &on_a, &on_b, &on_upstream)
        .unwrap();
    let (a_again, b_again) = gpu
        .all_pairs_vjp_from(O::default(), &on_a, &on_b, &upstream)
        .unwrap();
    let (a_bars, b_bars) = (a_bars.download().unwrap(), b_bars.download().unwrap());
    assert_eq!(a_bars, a_again.download().unwrap(), "the same bits");
    assert_eq!(b_bars, b_again.download().unwrap(), "the same bits");
    let len = O::Shape::LEN;
    let check = |bars: Vec<f64>, terms: &dyn Fn(usize, usize) -> f64, n: usize| {
        for (k, found) in bars.into_iter().enumerate() {
            let (mut sum, mut size) = (0.0, 0.0);
            for i in 0..n {
                sum += terms(k, i);
                size += terms(k, i).abs();
            }
            let bound = (n as f64 + ROUNDINGS) * EPSILON * size;
            assert!(
                (found - sum).abs() <= bound,
                "{}: {found} for {sum}",
                O::NAME
            );
        }
    };
    for i in 0..rows {
        let term = |k: usize, j: usize| {
            f64::from(upstream[i * columns + j]) * f64::from(grads.plane(1 + k)[i * columns + j])
        };
        check(fields(a_bars[i]), &term, columns);
    }
    for j in 0..columns {
        let term = |k: usize, i: usize| {
            f64::from(upstream[i * columns + j])
                * f64::from(grads.plane(1 + len + k)[i * columns + j])
        };
        check(fields(b_bars[j]), &term, rows);
    }
    reductions_agree::<O>(gpu, &a, &b, &values);
    losses_agree::<O>(gpu, &a, &b, &grads);
}

/// Reductions of two lists and of their matrix, both against the matrix itself.
fn reductions_agree<O: GpuPair>(gpu: &Gpu, a: &[O::Shape], b: &[O::Shape], values: &[f32])
where
    O::Shape: Draw,
{
    let (rows, columns) = (a.len(), b.len());
    let (on_a, on_b) = (gpu.upload(a).unwrap(), gpu.upload(b).unwrap());
    let matrix = gpu.all_pairs(O::default(), &on_a, &on_b).unwrap();
    let held = reduce::Matrix::new(rows, columns, values.to_vec()).unwrap();

    // Of the matrix there is nothing to round but sums.
    assert_eq!(
        matrix.row_max().unwrap().download().unwrap(),
        held.row_max().unwrap()
    );
    assert_eq!(
        matrix.column_max().unwrap().download().unwrap(),
        held.column_max().unwrap()
    );
    let threshold = 0.2;
    let found = matrix.above(threshold).unwrap();
    assert_eq!(found.len() as u64, held.count_above(threshold).unwrap());
    assert_eq!(found.download().unwrap(), held.above(threshold).unwrap());
    assert_eq!(matrix.count_above(threshold).unwrap(), found.len() as u64);
    let bound = (1024.0 + ROUNDINGS) * EPSILON;
    assert!((matrix.sum().unwrap() - held.sum()).abs() <= bound * held.sum());
    assert!((matrix.mean().unwrap() - held.mean()).abs() <= bound * held.mean());

    let best = gpu
        .row_max(O::default(), &on_a, &on_b)
        .unwrap()
        .download()
        .unwrap();
    for (row, best) in values.chunks(columns).zip(&best) {
        let most = row.iter().fold(0.0_f32, |x, &y| x.max(y));
        assert!(close(best.value, most) && close(row[best.index], most));
    }
    let best = gpu
        .column_max(O::default(), &on_a, &on_b)
        .unwrap()
        .download()
        .unwrap();
    assert_eq!(best.len(), columns);
    for (j, best) in best.iter().enumerate() {
        let most = (0..rows).fold(0.0_f32, |x, i| x.max(values[i * columns + j]));
        assert!(close(best.value, most) && close(values[best.index * columns + j], most));
    }
    let found = gpu
        .above(O::default(), &on_a, &on_b, threshold)
        .unwrap()
        .download()
        .unwrap();
    assert_eq!(
        gpu.count_above(O::default(), &on_a, &on_b, threshold)
            .unwrap(),
        found.len() as u64
    );
    assert!(found.is_sorted_by_key(|found| (found.row, found.column)));
    assert!(
        found
            .iter()
            .all(|f| f.value > threshold && close(f.value, values[f.row * columns + f.column]))
    );
    let clearly = |by: f32| values.iter().filter(|&&v| v > by).count();
    assert!((clearly(0.20001)..=clearly(0.19999)).contains(&found.len()));
    let exact = held.sum();
    let sum = gpu.sum(O::default(), &on_a, &on_b).unwrap();
    assert!((sum - exact).abs() <= bound * exact);
}

/// The fused sum and its slopes against the sums of the slopes of every pair.
fn losses_agree<O: GpuPair>(
    gpu: &Gpu,
    a: &[O::Shape],
    b: &[O::Shape],
    grads: &Table<(f32, (O::Shape, O::Shape))>,
) where
    O::Shape: Draw,
{
    let (rows, columns, len) = (a.len(), b.len(), O::Shape::LEN);
    let (on_a, on_b) = (gpu.upload(a).unwrap(), gpu.upload(b).unwrap());
    let (sum, a_bar, b_bar) = gpu.sum_grad(O::default(), &on_a, &on_b).unwrap();
    let exact: f64 = grads.values().iter().map(|&x| f64::from(x)).sum();
    let bound = |n: usize| (n as f64 + ROUNDINGS) * EPSILON;
    assert!((sum - exact).abs() <= bound(256) * exact);
    let plane = |k: usize, i: usize, j: usize| f64::from(grads.plane(1 + k)[i * columns + j]);
    let check = |found: f64, terms: &mut dyn Iterator<Item = f64>, n: usize| {
        let (exact, size) = terms.fold((0.0, 0.0), |(x, y), term| (x + term, y + term.abs()));
        assert!(
            (found - exact).abs() <= bound(n) * size,
            "{found} for {exact}"
        );
    };
    for (i, bar) in a_bar.download().unwrap().into_iter().enumerate() {
        for (k, found) in fields(bar).into_iter().enumerate() {
            check(found, &mut (0..columns).map(|j| plane(k, i, j)), columns);
        }
    }
    for (j, bar) in b_bar.download().unwrap().into_iter().enumerate() {
        for (k, found) in fields(bar).into_iter().enumerate() {
            check(found, &mut (0..rows).map(|i| plane(len + k, i, j)), rows);
        }
    }
    let (mean, ..) = gpu.mean_grad(O::default(), &on_a, &on_b).unwrap();
    assert!((mean - sum / (rows * columns) as f64).abs() <= bound(1) * mean);
}

#[test]
fn repeated_runs_give_the_same_bits() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(1);
    let boxes: Vec<Obb2<f32>> = (0..700).map(|_| Draw::draw(&mut draws)).collect();
    let on = gpu.upload(&boxes).unwrap();
    let run = || {
        let matrix = gpu.all_pairs(overlap::IouObb2, &on, &on).unwrap();
        let bars = gpu.all_pairs_vjp(overlap::IouObb2, &on, &on, &matrix);
        let (a_bars, b_bars) = bars.unwrap();
        let mut all = bits(&matrix.download().unwrap());
        for bar in [a_bars, b_bars].iter().flat_map(|x| x.download().unwrap()) {
            all.extend(bits(&bar.scalars()));
        }
        all
    };
    let first = run();
    for _ in 0..3 {
        assert_eq!(run(), first);
    }
}

#[test]
fn the_first_of_several_is_the_best() {
    let Some((_turn, gpu)) = gpu() else { return };
    // The same few boxes again and again, in more than one strip, tile and buffer.
    let few = Aabb2::<f32>::hard();
    let many: Vec<_> = few.iter().copied().cycle().take(2500).collect();
    for gpu in [gpu, &small()] {
        let (on_few, on_many) = (gpu.upload(&few).unwrap(), gpu.upload(&many).unwrap());
        let found = gpu.row_max(overlap::IouAabb2, &on_few, &on_many).unwrap();
        let expected = calls::row_max::<overlap::IouAabb2, f32>(&few, &many).unwrap();
        let indices = |all: Vec<reduce::Best>| all.iter().map(|x| x.index).collect::<Vec<_>>();
        assert_eq!(indices(found.download().unwrap()), indices(expected));
        let found = gpu
            .column_max(overlap::IouAabb2, &on_many, &on_few)
            .unwrap();
        let expected = calls::column_max::<overlap::IouAabb2, f32>(&many, &few).unwrap();
        assert_eq!(indices(found.download().unwrap()), indices(expected));
    }
}

#[test]
fn more_than_a_strip() {
    let Some((_turn, gpu)) = gpu() else { return };
    all_pairs_agree::<overlap::IouAabb2>(gpu, 3, 2500);
    all_pairs_agree::<overlap::IouObb2>(gpu, 2500, 3);
}

#[test]
fn without_subgroups() {
    let Some((_turn, _)) = gpu() else { return };
    let mut options = Options::default();
    options.subgroups = false;
    let gpu = Gpu::with(&options).unwrap();
    assert!(!gpu.has_subgroups());
    all_pairs_agree::<overlap::IouObb2>(&gpu, 40, 300);
    all_pairs_agree::<overlap::IofAabb2>(&gpu, 300, 40);
}

#[test]
fn identical_and_thin_boxes() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(9);
    let mut boxes: Vec<Obb2<f32>> = (0..200).map(|_| Draw::draw(&mut draws)).collect();
    boxes.extend((0..200).map(|_| Obb2::new(0.0, 0.0, 1e-3, 50.0, 7.0 * draws.next())));
    let on = gpu.upload(&boxes).unwrap();
    let (values, a_bars, _) = gpu.aligned_grad(overlap::IouObb2, &on, &on).unwrap();
    assert!(values.download().unwrap().iter().all(|&value| value == 1.0));
    for bar in a_bars.download().unwrap() {
        assert!(fields(bar).iter().all(|&slope| slope == 0.0), "{bar:?}");
    }
    // Thin boxes ever so slightly turned: the exact ratio, from f64, to the last few digits.
    for by in [1e-7_f32, 1e-6, 1e-5] {
        let turned: Vec<Obb2<f32>> = boxes
            .iter()
            .map(|shape| Obb2 {
                heading: shape.heading + by,
                ..*shape
            })
            .collect();
        let found = gpu.upload(&turned).unwrap();
        let found = gpu.aligned(overlap::IouObb2, &on, &found).unwrap();
        for (i, found) in found.download().unwrap().into_iter().enumerate() {
            let wide = |x: &Obb2<f32>| shape_of::<Obb2<f64>>(&fields(*x));
            let exact = wide(&boxes[i]).iou(wide(&turned[i]));
            // The relative heading is right to 2⁻³⁵, which over 25 is 7e-10 of a width of 1e-3.
            assert!(
                (f64::from(found) - exact).abs() < 5e-6,
                "{i}: {found} for {exact}"
            );
        }
    }
}

/// Where sizes differ by many powers of ten: finite wherever the source is finite (that it always
/// is, is for its own tests), and the same values.
fn extremes_agree<O: GpuPair<Shape = Obb2<f32>>>(gpu: &Gpu) {
    let sizes = [0.0, 1e-38, 1e-20, 1.0, 1e18, 1e38_f32];
    let mut boxes = Vec::new();
    for x in sizes {
        for y in sizes {
            boxes.push(Obb2::new(0.0, 0.0, x, y, 0.3));
            boxes.push(Obb2::new(x, -y, y, x, 1.0));
        }
    }
    let on = gpu.upload(&boxes).unwrap();
    let found = gpu
        .all_pairs_grad(O::default(), &on, &on)
        .unwrap()
        .download()
        .unwrap();
    let expected = Backend::Cpu
        .all_pairs_grad(O::default(), &boxes, &boxes)
        .unwrap();
    for (at, (found, expected)) in found.planes().iter().zip(expected.planes()).enumerate() {
        let (i, j) = (at / boxes.len() % boxes.len(), at % boxes.len());
        assert!(
            found.is_finite() || !expected.is_finite(),
            "{} {:?} {:?}: {found}, on the CPU {expected}",
            O::NAME,
            boxes[i],
            boxes[j]
        );
    }
    for (found, expected) in found.values().iter().zip(expected.values()) {
        assert!(
            (found - expected).abs() <= 1e-5 * expected.max(1.0),
            "{}: {found} for {expected}",
            O::NAME
        );
    }
}

#[test]
fn extreme_sizes() {
    let Some((_turn, gpu)) = gpu() else { return };
    extremes_agree::<overlap::IntersectionAreaObb2>(gpu);
    extremes_agree::<overlap::IouObb2>(gpu);
    extremes_agree::<overlap::IofObb2>(gpu);
}
