//! Every form of an operation of two shapes on a GPU.
//!
//! How far a result may be from the processor's is the harness's to say, to which the kernels of items side by side, of
//! values with gradients and of all pairs are witnesses. Everything else is held to those: reductions and sums to the
//! matrix and its derivatives, data that stay to slices.
use crate::adapter::any_gpu;
use crate::list::{self, Tested};
use geograd::Pack;
use geograd::ad::check::sample::{Draw, Sample};
use geograd::kernels::dynamic::{self, Mode, Operation, Rows};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Backend, Item, Op, Single};
use std::fmt::Debug;

/// All pairs of a row's ordinary shapes, in every form or in one; of rows of other than two shapes nothing.
///
/// # Panics
///
/// If the GPU says something else than it should.
pub fn agree(row: &Tested, every: bool) {
    let Some(gpu) = any_gpu() else { return };
    let operation = &row.operation;
    let Some(value) = operation.value::<f32>() else {
        return;
    };
    let takes = value.takes();
    let [(_, a_layout), (_, b_layout)] = &takes[..] else {
        return;
    };
    let drawn = |draw: &mut Draw| row.ordinary(draw);
    let columns = list::columns::<f32>(row, &list::inputs(row, 90, drawn));
    let (n, m) = (a_layout.fields(), b_layout.fields());
    let (a, b) = (&columns[0][..20 * n], &columns[1][20 * m..]);
    let (a, b) = (Rows::new(a, n), Rows::new(b, m));
    if !every {
        let found = value
            .on(Backend::Gpu(gpu))
            .unwrap()
            .all_pairs(a, b)
            .unwrap();
        return few_differ(row.name(), &found, &value.all_pairs(a, b).unwrap());
    }
    if list::outputs(row) == 1 {
        numbers_agree(gpu, operation, a, b, Bound::Most);
    } else {
        let found = value
            .on(Backend::Gpu(gpu))
            .unwrap()
            .all_pairs(a, b)
            .unwrap();
        few_differ(row.name(), &found, &value.all_pairs(a, b).unwrap());
    }
    // One shape for all.
    let on = |rows: &[Rows<'_, f32>]| {
        value
            .on(Backend::Gpu(gpu))
            .unwrap()
            .aligned(rows)
            .unwrap()
            .concat()
    };
    let (of_a, of_b) = (a.numbers(), b.numbers());
    let (one, other) = (&of_a[3 * n..4 * n], &of_b[3 * m..4 * m]);
    let first = Rows::new(&of_b[..20 * m], m);
    let found = on(&[Rows::one(one), first]);
    let expected = on(&[Rows::new(&one.repeat(20), n), first]);
    assert_eq!(bits(&found), bits(&expected), "{}", row.name());
    let found = on(&[a, Rows::one(other)]);
    let expected = on(&[a, Rows::new(&other.repeat(20), m)]);
    assert_eq!(bits(&found), bits(&expected), "{}", row.name());
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

/// How results are held to those of the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// All of them closely: of what neither jumps nor cancels at these inputs.
    All,
    /// Nearly all; the harness judges the others.
    Most,
}

impl Bound {
    fn holds(self, name: &str, found: &[f32], expected: &[f32]) {
        if self == Bound::Most {
            return few_differ(name, found, expected);
        }
        assert_eq!(found.len(), expected.len());
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let off = (found - expected).abs();
            assert!(
                off <= 1e-4 * (1.0 + expected.abs()),
                "{name} {i}: {found} for {expected}"
            );
        }
    }
}

/// Nearly all numbers are near: where a value jumps, or cancels, rounding may carry it away.
fn few_differ(name: &str, found: &[f32], expected: &[f32]) {
    assert_eq!(found.len(), expected.len());
    let is_near = |(x, y): &(&f32, &f32)| (*x - *y).abs() <= 1e-3 * (1.0 + y.abs());
    let near = found.iter().zip(expected).filter(is_near).count();
    let far = found.len() - near;
    assert!(200 * far <= found.len(), "{name}: {far} of {}", found.len());
}

/// All pairs of two lists of an operation, in slices and as data that stay: tables, reductions, derivatives.
///
/// # Panics
///
/// If the GPU says something else than it should.
pub fn pairs_agree<O, A, B>(gpu: &Gpu, run: O, a: &[A], b: &[B], bound: Bound)
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    O::In<f64>: Item<Scalar = f64> + Sample,
    O::Out<f64>: Item<Scalar = f64> + Sample,
    A: Single<Scalar = f32> + PartialEq + Debug,
    B: Single<Scalar = f32> + PartialEq + Debug,
{
    let name = O::DECLARED.name;
    let (of_a, of_b) = (
        a.iter().flat_map(Pack::scalars),
        b.iter().flat_map(Pack::scalars),
    );
    let (of_a, of_b): (Vec<f32>, Vec<f32>) = (of_a.collect(), of_b.collect());
    let (rows, columns) = (Rows::new(&of_a, A::LEN), Rows::new(&of_b, B::LEN));
    let values = numbers_agree(gpu, &dynamic::straight::<O>(), rows, columns, bound);
    let table = gpu.all_pairs(run, a, b).unwrap();
    assert_eq!(bits(table.planes()), bits(&values), "{name}");
    let mut draw = Draw::new(5);
    let upstream: Vec<f32> = values.iter().map(|_| draw.unit() as f32 - 0.5).collect();
    let bars = gpu.all_pairs_vjp(run, a, b, &upstream).unwrap();
    // The same of lists that stay.
    let here = Backend::Gpu(gpu).resident();
    let (on_a, on_b) = (here.upload(a).unwrap(), here.upload(b).unwrap());
    let matrix = here.all_pairs(run, &on_a, &on_b).unwrap();
    assert_eq!(bits(&matrix.download().unwrap()), bits(&values), "{name}");
    let best = here.row_max(run, &on_a, &on_b).unwrap();
    assert_eq!(
        best.download().unwrap(),
        gpu.row_max(run, a, b).unwrap(),
        "{name}"
    );
    let on_upstream = here.upload_matrix(a.len(), b.len(), &upstream).unwrap();
    let (a_bar, b_bar) = here.all_pairs_vjp(run, &on_a, &on_b, &on_upstream).unwrap();
    let again = (a_bar.download().unwrap(), b_bar.download().unwrap());
    assert_eq!(again, bars, "{name}: the same bits");
    // Items side by side that stay, with their gradients.
    let both: Vec<(A, B)> = a.iter().copied().zip(b.iter().copied()).collect();
    let held = here.upload(&both).unwrap();
    let found = here.aligned(run.value_grad(), &held).unwrap();
    assert_eq!(
        found.download().unwrap(),
        gpu.aligned(run.value_grad(), &both[..]).unwrap(),
        "{name}: what stays, and slices"
    );
}

/// All pairs of two lists of plain numbers; returns the matrix.
fn numbers_agree(
    gpu: &Gpu,
    operation: &Operation,
    a: Rows<'_, f32>,
    b: Rows<'_, f32>,
    bound: Bound,
) -> Vec<f32> {
    let (name, on) = (operation.name, Backend::Gpu(gpu));
    let run = operation.value::<f32>().unwrap();
    let [rows, columns] = [a, b].map(|list| list.count().unwrap());
    let values = run.on(on).unwrap().all_pairs(a, b).unwrap();
    bound.holds(name, &values, &run.all_pairs(a, b).unwrap());
    let again = run.on(on).unwrap().all_pairs(a, b).unwrap();
    assert_eq!(bits(&values), bits(&again), "{name}");
    // A gradient per pair.
    let both = operation.function::<f32>(Mode::ValueGrad).unwrap();
    let grads = both.on(on).unwrap().all_pairs(a, b).unwrap();
    let fields = 1 + a.fields() + b.fields();
    assert_eq!(grads.len(), fields * rows * columns, "{name}");
    bound.holds(name, &grads[..values.len()], &values);
    // Reductions are those of the matrix.
    let best = run.on(on).unwrap().row_max(a, b).unwrap();
    for (row, best) in values.chunks(columns).zip(&best) {
        let most = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        assert_eq!(best.value, most, "{name}");
        let first = row.iter().position(|&x| x == most);
        assert_eq!(first, Some(best.index), "{name}");
    }
    let best = run.on(on).unwrap().column_max(a, b).unwrap();
    for (j, best) in best.iter().enumerate() {
        let column = || values.iter().skip(j).step_by(columns).copied();
        let most = column().fold(f32::NEG_INFINITY, f32::max);
        assert_eq!(best.value, most, "{name}");
        let first = column().position(|x| x == most);
        assert_eq!(first, Some(best.index), "{name}");
    }
    let mut sorted = values.clone();
    sorted.sort_by(f32::total_cmp);
    let threshold = sorted[sorted.len() / 2];
    let above = run.on(on).unwrap().above(a, b, threshold).unwrap();
    let found: Vec<(usize, f32)> = above
        .iter()
        .map(|found| (found.row * columns + found.column, found.value))
        .collect();
    let all = values.iter().copied().enumerate();
    let expected: Vec<(usize, f32)> = all.filter(|&(_, x)| x > threshold).collect();
    assert_eq!(found, expected, "{name}");
    let count = run.on(on).unwrap().count_above(a, b, threshold).unwrap();
    assert_eq!(count as usize, expected.len(), "{name}");
    let exact: f64 = values.iter().map(|&x| f64::from(x)).sum();
    let size: f64 = values.iter().map(|&x| f64::from(x).abs()).sum();
    let sum = run.on(on).unwrap().sum(a, b).unwrap();
    assert!(
        (sum - exact).abs() <= 1e-5 * size,
        "{name}: {sum} for {exact}"
    );
    let mean = run.on(on).unwrap().mean(a, b).unwrap();
    assert_eq!(mean, sum / values.len() as f64, "{name}");
    // Derivatives: sums of those of every pair.
    let mut draw = Draw::new(5);
    let upstream: Vec<f32> = values.iter().map(|_| draw.unit() as f32 - 0.5).collect();
    let bars = run.on(on).unwrap().all_pairs_vjp(a, b, &upstream).unwrap();
    let again = run.on(on).unwrap().all_pairs_vjp(a, b, &upstream).unwrap();
    assert_eq!(again, bars, "{name}: the same bits");
    let sides = [(rows, a.fields()), (columns, b.fields())];
    let derivatives = |weights: &[f32], bars: [&[f32]; 2]| {
        derivatives_agree((name, bound), &grads, weights, bars, sides);
    };
    derivatives(&upstream, [&bars.0, &bars.1]);
    let (found, a_grad, b_grad) = run.on(on).unwrap().sum_grad(a, b).unwrap();
    // Kernels by hand add the sum in other groups beside its derivatives.
    assert!(
        (found - sum).abs() <= 1e-6 * size,
        "{name}: {found} for {sum}"
    );
    derivatives(&vec![1.0; values.len()], [&a_grad, &b_grad]);
    let (found, mean_bar, _) = run.on(on).unwrap().mean_grad(a, b).unwrap();
    assert!(
        (found - mean).abs() <= 1e-6 * size / values.len() as f64,
        "{name}: {found} for {mean}"
    );
    assert_eq!(mean_bar.len(), a.numbers().len());
    values
}

/// Derivatives of both lists are sums of those of pairs, weighed; `sides` says how many shapes a list has, and how
/// many numbers each of them.
fn derivatives_agree(
    (name, bound): (&str, Bound),
    grads: &[f32],
    weights: &[f32],
    bars: [&[f32]; 2],
    [(rows, a_fields), (columns, b_fields)]: [(usize, usize); 2],
) {
    // A derivative whose terms cancel is known to a few digits of the terms.
    let largest = match bound {
        Bound::All => 1.0,
        Bound::Most => grads.iter().map(|x| x.abs()).fold(1.0, f32::max),
    };
    let plane = |k: usize| &grads[k * rows * columns..][..rows * columns];
    let check = |found: f32, plane: &[f32], places: &mut dyn Iterator<Item = usize>| {
        let (mut sum, mut size) = (0.0, 0.0);
        for at in places {
            let term = f64::from(plane[at]) * f64::from(weights[at]);
            sum += term;
            size += term.abs();
        }
        assert!(
            (f64::from(found) - sum).abs() <= 1e-3 * size + 1e-5 * f64::from(largest),
            "{name}: {found} for {sum}"
        );
    };
    for (i, bar) in bars[0].chunks_exact(a_fields).enumerate() {
        for (k, &found) in bar.iter().enumerate() {
            check(
                found,
                plane(1 + k),
                &mut (0..columns).map(|j| i * columns + j),
            );
        }
    }
    for (j, bar) in bars[1].chunks_exact(b_fields).enumerate() {
        for (k, &found) in bar.iter().enumerate() {
            check(
                found,
                plane(1 + a_fields + k),
                &mut (0..rows).map(|i| i * columns + j),
            );
        }
    }
}
