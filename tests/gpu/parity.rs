//! The same numbers as on the CPU.
use crate::bounds::{EPSILON, ROUNDINGS, close, derivative_bounds, value_bound};
use crate::shapes::{Draw, Draws, Score, bits, fields, shape_of};
use crate::{gpu, small};

use geograd::kernels::gpu::{Gpu, Options};
use geograd::kernels::{Backend, Cpu, Op, reduce};
use geograd::{Aabb2, Fixed, Obb2, Pack};
use geograd_tests::calls;
use geograd_tests::rows::overlap;

/// Pairs of a square whose diagonal is asked for.
const SQUARE: usize = 64;

/// Derivatives of every pair, the fields of b after those of a: from the diagonals of squares, whose shapes are pairs
/// one after the other.
fn derivatives_of_pairs<O: Score>(gpu: &Gpu, a: &[O::Shape], b: &[O::Shape]) -> Vec<Vec<f64>> {
    let places: Vec<(usize, usize)> = (0..a.len())
        .flat_map(|i| (0..b.len()).map(move |j| (i, j)))
        .collect();
    let of_square = |places: &[(usize, usize)]| {
        let side = places.len();
        let mut diagonal = vec![0.0; side * side];
        let ones = diagonal.iter_mut().step_by(side + 1);
        ones.for_each(|x| *x = 1.0);
        let of_a: Vec<O::Shape> = places.iter().map(|&(i, _)| a[i]).collect();
        let of_b: Vec<O::Shape> = places.iter().map(|&(_, j)| b[j]).collect();
        let bars = gpu.all_pairs_vjp(O::default(), &of_a, &of_b, &diagonal);
        let (by_a, by_b) = bars.unwrap();
        let both = by_a.into_iter().zip(by_b);
        both.map(|(a, b)| [fields(a), fields(b)].concat())
            .collect::<Vec<_>>()
    };
    places.chunks(SQUARE).flat_map(of_square).collect()
}

/// Every hard box with every other, and others at random, against bounds that are derived.
pub fn hard_pairs_agree<O: Score>() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(3);
    let mut shapes = O::Shape::hard();
    shapes.extend((0..25).map(|_| O::Shape::draw(&mut draws)));
    let count = shapes.len();
    let values = gpu.all_pairs(O::default(), &shapes, &shapes).unwrap();
    let derivatives = derivatives_of_pairs::<O>(gpu, &shapes, &shapes);
    let run = O::default().value_grad();
    let expected = Backend::Cpu.all_pairs(run, &shapes, &shapes).unwrap();
    for (at, found) in derivatives.iter().enumerate() {
        let (i, j) = (at / count, at % count);
        let (a, b) = (shapes[i], shapes[j]);
        let (value, (by_a, by_b)) = expected.at(i, j);
        let (near, value) = (f64::from(values.at(i, j)), f64::from(value));
        let bound = value_bound::<O>(a, b, value);
        assert!(
            (near - value).abs() <= bound,
            "{}: {a:?} {b:?}: {near} for {value} ± {bound}",
            O::DECLARED.name
        );
        let bounds = derivative_bounds::<O>(a, b, near, &mut draws);
        let expected = [fields(by_a), fields(by_b)].concat();
        for k in 0..found.len() {
            assert!(
                (found[k] - expected[k]).abs() <= bounds[k],
                "{}, derivative {k}: {a:?} {b:?}: {} for {} ± {}",
                O::DECLARED.name,
                found[k],
                expected[k],
                bounds[k]
            );
        }
    }
}

pub fn all_pairs_agree<O: Score>(gpu: &Gpu, rows: usize, columns: usize) {
    let mut draws = Draws(11);
    let a: Vec<O::Shape> = (0..rows).map(|_| Draw::draw(&mut draws)).collect();
    let b: Vec<O::Shape> = (0..columns).map(|_| Draw::draw(&mut draws)).collect();
    let values = gpu.all_pairs(O::default(), &a, &b).unwrap().into_planes();
    let expected = Backend::Cpu.all_pairs(O::default(), &a, &b).unwrap();
    assert_eq!(values.len(), expected.values().len());
    for (at, (&found, &value)) in values.iter().zip(expected.values()).enumerate() {
        let bound = value_bound::<O>(a[at / columns], b[at % columns], f64::from(value));
        assert!(
            (f64::from(found) - f64::from(value)).abs() <= bound,
            "{} {at}: {found} for {value}",
            O::DECLARED.name
        );
    }

    // Sums: whatever the order, an error of one epsilon of the sum of magnitudes per term.
    let derivatives = derivatives_of_pairs::<O>(gpu, &a, &b);
    let upstream: Vec<f32> = (0..values.len()).map(|_| draws.next() - 0.5).collect();
    let (by_a, by_b) = gpu.all_pairs_vjp(O::default(), &a, &b, &upstream).unwrap();
    // Slices and resident data give the same bits.
    let here = Backend::Gpu(gpu).resident();
    let (on_a, on_b) = (here.upload(&a).unwrap(), here.upload(&b).unwrap());
    let on_upstream = here.upload_matrix(rows, columns, &upstream).unwrap();
    let again = here.all_pairs_vjp(O::default(), &on_a, &on_b, &on_upstream);
    let (a_again, b_again) = again.unwrap();
    assert_eq!(by_a, a_again.download().unwrap(), "the same bits");
    assert_eq!(by_b, b_again.download().unwrap(), "the same bits");
    let weigh = |at: usize| f64::from(upstream[at]);
    sums_agree::<O>(&derivatives, &by_a, &by_b, &weigh);
    reductions_agree::<O>(gpu, &a, &b, &values);
    losses_agree::<O>(gpu, &a, &b, &values, &derivatives);
}

/// Derivatives of both lists against weighed sums of the derivatives of every pair.
fn sums_agree<O: Score>(
    derivatives: &[Vec<f64>],
    by_a: &[O::Shape],
    by_b: &[O::Shape],
    weigh: &dyn Fn(usize) -> f64,
) {
    let (rows, columns, len) = (by_a.len(), by_b.len(), O::Shape::LEN);
    let check = |found: f64, terms: &mut dyn Iterator<Item = f64>, n: usize| {
        let (sum, size) = terms.fold((0.0, 0.0), |(x, y), term| (x + term, y + term.abs()));
        let bound = (n as f64 + ROUNDINGS) * EPSILON * size;
        assert!(
            (found - sum).abs() <= bound,
            "{}: {found} for {sum}",
            O::DECLARED.name
        );
    };
    let term =
        |i: usize, j: usize, k: usize| weigh(i * columns + j) * derivatives[i * columns + j][k];
    for (i, bar) in by_a.iter().enumerate() {
        for (k, found) in fields(*bar).into_iter().enumerate() {
            check(found, &mut (0..columns).map(|j| term(i, j, k)), columns);
        }
    }
    for (j, bar) in by_b.iter().enumerate() {
        for (k, found) in fields(*bar).into_iter().enumerate() {
            check(found, &mut (0..rows).map(|i| term(i, j, len + k)), rows);
        }
    }
}

/// Reductions of two lists and of their matrix, both against the matrix itself.
fn reductions_agree<O: Score>(gpu: &Gpu, a: &[O::Shape], b: &[O::Shape], values: &[f32]) {
    let (rows, columns) = (a.len(), b.len());
    let here = Backend::Gpu(gpu).resident();
    let (on_a, on_b) = (here.upload(a).unwrap(), here.upload(b).unwrap());
    let matrix = here.all_pairs(O::default(), &on_a, &on_b).unwrap();
    assert_eq!(bits(&matrix.download().unwrap()), bits(values));
    let held = reduce::Matrix::new(rows, columns, values.to_vec()).unwrap();

    // Only the sums over the matrix are rounded.
    let best = matrix.row_max().unwrap().download().unwrap();
    assert_eq!(best, held.row_max().unwrap());
    let best = matrix.column_max().unwrap().download().unwrap();
    assert_eq!(best, held.column_max().unwrap());
    let threshold = 0.2;
    let found = matrix.above(threshold).unwrap().download().unwrap();
    assert_eq!(found, held.above(threshold).unwrap());
    assert_eq!(matrix.count_above(threshold).unwrap(), found.len() as u64);
    let bound = (1024.0 + ROUNDINGS) * EPSILON;
    assert!((matrix.sum().unwrap() - held.sum()).abs() <= bound * held.sum());
    assert!((matrix.mean().unwrap() - held.mean()).abs() <= bound * held.mean());

    let best = gpu.row_max(O::default(), a, b).unwrap();
    for (row, best) in values.chunks(columns).zip(&best) {
        let most = row.iter().fold(0.0_f32, |x, &y| x.max(y));
        assert!(close(best.value, most) && close(row[best.index], most));
    }
    let best = gpu.column_max(O::default(), a, b).unwrap();
    assert_eq!(best.len(), columns);
    for (j, best) in best.iter().enumerate() {
        let most = (0..rows).fold(0.0_f32, |x, i| x.max(values[i * columns + j]));
        assert!(close(best.value, most) && close(values[best.index * columns + j], most));
    }
    let found = gpu.above(O::default(), a, b, threshold).unwrap();
    let count = gpu.count_above(O::default(), a, b, threshold).unwrap();
    assert_eq!(count, found.len() as u64);
    assert!(found.is_sorted_by_key(|found| (found.row, found.column)));
    assert!(
        found
            .iter()
            .all(|f| f.value > threshold && close(f.value, values[f.row * columns + f.column]))
    );
    let clearly = |by: f32| values.iter().filter(|&&v| v > by).count();
    assert!((clearly(0.20001)..=clearly(0.19999)).contains(&found.len()));
    let exact = held.sum();
    let sum = gpu.sum(O::default(), a, b).unwrap();
    assert!((sum - exact).abs() <= bound * exact);
}

/// The fused sum and its derivatives against the sums of the derivatives of every pair.
fn losses_agree<O: Score>(
    gpu: &Gpu,
    a: &[O::Shape],
    b: &[O::Shape],
    values: &[f32],
    derivatives: &[Vec<f64>],
) {
    let (sum, by_a, by_b) = gpu.sum_grad(O::default(), a, b).unwrap();
    let exact: f64 = values.iter().map(|&x| f64::from(x)).sum();
    let bound = |n: usize| (n as f64 + ROUNDINGS) * EPSILON;
    assert!((sum - exact).abs() <= bound(256) * exact);
    sums_agree::<O>(derivatives, &by_a, &by_b, &|_| 1.0);
    let (mean, ..) = gpu.mean_grad(O::default(), a, b).unwrap();
    assert!((mean - sum / values.len() as f64).abs() <= bound(1) * mean);
}

#[test]
fn repeated_runs_give_the_same_bits() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(1);
    let boxes: Vec<Obb2<f32>> = (0..700).map(|_| Draw::draw(&mut draws)).collect();
    let run = || {
        let table = gpu.all_pairs(overlap::IouObb2, &boxes, &boxes).unwrap();
        let bars = gpu.all_pairs_vjp(overlap::IouObb2, &boxes, &boxes, table.values());
        let (a_bars, b_bars) = bars.unwrap();
        let mut all = bits(table.values());
        for bar in [a_bars, b_bars].iter().flatten() {
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
        let found = gpu.row_max(overlap::IouAabb2, &few, &many).unwrap();
        let expected = calls::row_max::<overlap::IouAabb2, f32>(&few, &many).unwrap();
        let indices = |all: Vec<reduce::Best>| all.iter().map(|x| x.index).collect::<Vec<_>>();
        assert_eq!(indices(found), indices(expected));
        let found = gpu.column_max(overlap::IouAabb2, &many, &few).unwrap();
        let expected = calls::column_max::<overlap::IouAabb2, f32>(&many, &few).unwrap();
        assert_eq!(indices(found), indices(expected));
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
    let run = overlap::IouObb2.value_grad();
    let (values, (a_bars, _)) = gpu.aligned(run, (&boxes, &boxes)).unwrap();
    // Drivers of cards fuse products with sums: differences of equal products leave their roundings.
    let is_exact = gpu.adapter().is_software;
    let off = if is_exact { 0.0 } else { 1e-6 };
    assert!(values.iter().all(|&value| (value - 1.0).abs() <= off));
    let mut own = vec![0.0; boxes.len() * boxes.len()];
    own.iter_mut()
        .step_by(boxes.len() + 1)
        .for_each(|x| *x = 1.0);
    let of_pairs = gpu
        .all_pairs_vjp(overlap::IouObb2, &boxes, &boxes, &own)
        .unwrap();
    let sides = boxes.iter().map(|shape| shape.size.x.min(shape.size.y));
    let sides: Vec<f32> = sides.collect();
    for (k, bar) in a_bars
        .into_iter()
        .chain(of_pairs.0)
        .chain(of_pairs.1)
        .enumerate()
    {
        // A slope is a difference of terms as large as one over the shorter side, and by the heading times the longer one.
        let size = boxes[k % boxes.len()].size;
        let term = size.x.max(size.y).max(1.0) / sides[k % boxes.len()];
        let slack = if is_exact {
            0.0
        } else {
            ROUNDINGS * EPSILON * f64::from(term)
        };
        assert!(
            fields(bar)
                .iter()
                .all(|&derivative| derivative.abs() <= slack),
            "{bar:?}"
        );
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
        let found = gpu.aligned(overlap::IouObb2, (&boxes, &turned)).unwrap();
        let of_pairs = gpu.all_pairs(overlap::IouObb2, &boxes, &turned).unwrap();
        for (i, found) in found.into_iter().enumerate() {
            let wide = |x: &Obb2<f32>| shape_of::<Obb2<f64>>(&fields(*x));
            let exact = wide(&boxes[i]).iou(wide(&turned[i]));
            // The relative heading is right to 2⁻³⁵, which over 25 is 7e-10 of a width of 1e-3.
            for found in [found, of_pairs.at(i, i)] {
                assert!(
                    (f64::from(found) - exact).abs() < 5e-6,
                    "{i}: {found} for {exact}"
                );
            }
        }
    }
}

/// Asserts for sizes that differ by many powers of ten: finite wherever the source is finite (its own
/// tests show that it always is), and the same values.
fn extremes_agree<O: Score<Shape = Obb2<f32>>>(gpu: &Gpu) {
    let sizes = [0.0, 1e-38, 1e-20, 1.0, 1e18, 1e38_f32];
    let mut boxes = Vec::new();
    for x in sizes {
        for y in sizes {
            boxes.push(Obb2::new(0.0, 0.0, x, y, 0.3));
            boxes.push(Obb2::new(x, -y, y, x, 1.0));
        }
    }
    let found = gpu.all_pairs(O::default(), &boxes, &boxes).unwrap();
    let derivatives = derivatives_of_pairs::<O>(gpu, &boxes, &boxes);
    let run = O::default().value_grad();
    let expected = Backend::Cpu.all_pairs(run, &boxes, &boxes).unwrap();
    for (at, derivatives) in derivatives.iter().enumerate() {
        let (i, j) = (at / boxes.len(), at % boxes.len());
        let (value, (by_a, by_b)) = expected.at(i, j);
        let on_cpu = [fields(by_a), fields(by_b)].concat();
        for (k, (found, expected)) in derivatives.iter().zip(on_cpu).enumerate() {
            assert!(
                found.is_finite() || !expected.is_finite(),
                "{} {:?} {:?}, derivative {k}: {found}, on the CPU {expected}",
                O::DECLARED.name,
                boxes[i],
                boxes[j]
            );
        }
        let found = found.at(i, j);
        // Of thin boxes the area is right to what rounding moves of a long border, which here can be any number.
        let bound = value_bound::<O>(boxes[i], boxes[j], f64::from(value)) as f32;
        let slack = if gpu.adapter().is_software {
            0.0
        } else {
            bound
        };
        assert!(
            (found - value).abs() <= slack.max(1e-5 * value.max(1.0)),
            "{}: {found} for {value}",
            O::DECLARED.name
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

/// Long thin boxes that lie along each other with their centres apart: of the difference of the centres the digits
/// that rounding takes away count.
#[test]
fn thin_boxes_along_each_other() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(24);
    let (mut a, mut b) = (Vec::new(), Vec::new());
    // One pair for which the digits are worth 3e-4.
    a.push(Obb2::new(-0.902_125_84, 1.592_955, 50.0, 1e-3, 2.092_978_5));
    b.push(Obb2::new(
        -5.862_623_7_f32,
        10.212_768,
        50.0,
        1e-3,
        2.092_979,
    ));
    while a.len() < 50 {
        let [heading, x, y] = [6.0, 10.0, 10.0].map(|most| most * draws.next());
        let (sin, cos) = heading.sin_cos();
        let (along, across) = (25.0 * draws.next(), 5e-4 * draws.next());
        a.push(Obb2::new(x, y, 50.0, 1e-3, heading));
        b.push(Obb2::new(
            x + (cos * along - sin * across),
            y + (sin * along + cos * across),
            50.0,
            1e-3,
            heading + 1e-6 * draws.next(),
        ));
    }
    let (op, ones) = (overlap::IouObb2, vec![1.0; 50]);
    let (values, (by_a, by_b)) = gpu.aligned(op.value_grad(), (&a, &b)).unwrap();
    let alone = gpu.aligned(op, (&a, &b)).unwrap();
    let pulled = gpu.aligned(op.vjp(), ((&a, &b), &ones)).unwrap();
    let of_pairs = gpu.all_pairs(op, &a, &b).unwrap();
    let bars = derivatives_of_pairs::<overlap::IouObb2>(gpu, &a, &b);
    let wide = |all: &[Obb2<f32>]| -> Vec<Obb2<f64>> {
        all.iter().map(|&x| shape_of(&fields(x))).collect()
    };
    let exact = Cpu::new().aligned(op.value_grad(), (&wide(&a), &wide(&b)));
    let (exact, (by_p, by_q)) = exact.unwrap();
    let mut worst = [0.0_f64; 6];
    for (i, exact) in exact.into_iter().enumerate() {
        for (k, found) in [values[i], alone[i], of_pairs.at(i, i)]
            .into_iter()
            .enumerate()
        {
            worst[k] = worst[k].max((f64::from(found) - exact).abs());
        }
        let exact = [by_p[i].scalars(), by_q[i].scalars()].concat();
        let most = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let derivatives = [
            [fields(by_a[i]), fields(by_b[i])].concat(),
            [fields(pulled.0[i]), fields(pulled.1[i])].concat(),
            bars[i * 50 + i].clone(),
        ];
        for (k, found) in derivatives.iter().enumerate() {
            for (found, exact) in found.iter().zip(&exact) {
                worst[3 + k] = worst[3 + k].max((found - exact).abs() / most);
            }
        }
    }
    // Derivatives of thin boxes that are almost parallel depend on the last digits of the sine between them.
    let (values, derivatives) = worst.split_at(3);
    assert!(values.iter().all(|&x| x < 1e-6), "{worst:?}");
    assert!(derivatives.iter().all(|&x| x < 1e-4), "{worst:?}");
}
