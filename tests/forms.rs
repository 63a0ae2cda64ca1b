//! Every form of an operation on a GPU.
//!
//! How far a result may be from the processor's is the harness's to say, to which the kernels of items side by side, of
//! values with gradients and of all pairs are witnesses. Everything else is held to those: reductions and sums to the
//! matrix and its derivatives, data that stay to slices.
use crate::adapter::any_gpu;
use geograd::ad::check::sample::{Draw, Sample};
use geograd::ad::check::{Report, Sampling};
use geograd::kernels::check::{check_on, check_pairs_on, check_with};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::item::Results;
use geograd::kernels::{Backend, Cpu, Item, One, Op, Runs, Single, Table};
use geograd::{Error, Fixed, Pack};
use std::fmt::Debug;
use std::marker::PhantomData;

/// An operation's type, by which the forms are found that it has: of a method called on `&&&Forms`, the
/// implementation for what is behind more references comes first.
pub struct Forms<O>(PhantomData<O>);

impl<O> Forms<O> {
    pub const NEW: Self = Forms(PhantomData);
}

/// All forms of an operation.
pub trait Agree {
    /// # Panics
    ///
    /// If the GPU says something else than it should.
    fn agree(&self);
}

/// Of two shapes with one number as result.
impl<O, A, B> Agree for &&Forms<O>
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    A: Single<Scalar = f32> + PartialEq + Debug,
    B: Single<Scalar = f32> + PartialEq + Debug,
{
    fn agree(&self) {
        let Some(gpu) = any_gpu() else { return };
        judged::<O>(&|plan| check_pairs_on::<O, A, B>(Backend::Gpu(gpu), plan));
        let shapes = ordinary::<O>(90);
        let a: Vec<A> = shapes[..20].iter().map(|x| x.0).collect();
        let b: Vec<B> = shapes[20..].iter().map(|x| x.1).collect();
        pairs_agree(gpu, O::default(), &a, &b, Bound::Most);
        let shorter = &b[..a.len()];
        stays(gpu, O::default().value_grad(), &shapes);
        let run = O::default();
        let one = gpu.aligned(run, (One(a[3]), shorter)).unwrap();
        let all = gpu.aligned(run, (&vec![a[3]; a.len()], shorter)).unwrap();
        assert_eq!(bits(&one), bits(&all), "{}", O::NAME);
        let one = gpu.aligned(run, (&a, One(b[3]))).unwrap();
        let all = gpu.aligned(run, (&a, &vec![b[3]; a.len()])).unwrap();
        assert_eq!(bits(&one), bits(&all), "{}", O::NAME);
    }
}

/// Of two shapes with another result.
impl<O, A, B> Agree for &Forms<O>
where
    O: Op<In<f32> = (A, B)>,
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::Out<f32>: Item<Scalar = f32, Many: PartialEq + Debug>,
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    fn agree(&self) {
        let Some(gpu) = any_gpu() else { return };
        judged::<O>(&|plan| check_on::<O>(Backend::Gpu(gpu), plan));
        let shapes = ordinary::<O>(90);
        stays(gpu, O::default(), &shapes);
        let a: Vec<A> = shapes[..20].iter().map(|x| x.0).collect();
        let b: Vec<B> = shapes[20..].iter().map(|x| x.1).collect();
        let found = gpu.all_pairs(O::default(), &a, &b).unwrap();
        let expected = Cpu::new().all_pairs(O::default(), &a, &b).unwrap();
        few_differ(O::NAME, found.planes(), expected.planes());
    }
}

/// Of one shape, or of more than two.
impl<O: Op> Agree for Forms<O>
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32, Many: PartialEq + Debug>,
{
    fn agree(&self) {
        let Some(gpu) = any_gpu() else { return };
        judged::<O>(&|plan| check_on::<O>(Backend::Gpu(gpu), plan));
        stays(gpu, O::default(), &ordinary::<O>(40));
    }
}

/// Values and derivatives are the processor's, within what the harness measures.
fn judged<O: Op>(check: &dyn Fn(&Sampling<'_>) -> Result<Report, Error>)
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    // Of what has tens of thousands of operations, fewer inputs.
    let is_large = O::default().program::<f32>().unwrap().cost().total() > 5000;
    // What takes time is the harness, which has said the same of the processor's batches.
    let plan = Sampling {
        hard: if is_large { 197 } else { 71 },
        ..Sampling::new(if is_large { 4 } else { 10 }, 1)
    };
    let report = check(&plan).unwrap();
    assert!(report.worst[5].count > 0, "{report}");
    // What is refused without a GPU, too, is for the harness's own tests to say.
    let alone = || check_with::<O, f32>(&plan);
    let refused = report.failures.len();
    assert!(
        refused == 0 || refused == alone().failures.len(),
        "{report}"
    );
}

/// Ordinary inputs in single precision.
fn ordinary<O: Op>(count: usize) -> Vec<O::In<f32>>
where
    O::In<f64>: Sample,
    O::In<f32>: Item<Scalar = f32>,
{
    let mut draw = Draw::new(7);
    let drawn = std::iter::repeat_with(|| O::In::<f64>::ordinary(&mut draw));
    let inside = drawn.filter(Sample::inside).map(|x| {
        let numbers: Vec<f32> = x.scalars().iter().map(|&x| x as f32).collect();
        Fixed::load(&numbers)
    });
    inside.take(count).collect()
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

/// Columns that stay give what slices give.
fn stays<R, F>(gpu: &Gpu, run: F, rows: &[R])
where
    R: Item<Scalar = f32>,
    F: Runs<R> + Copy,
    F::Out: Item<Scalar = f32> + Results<Many = <F::Out as Item>::Many>,
    <F::Out as Item>::Many: PartialEq + Debug,
{
    let here = Backend::Gpu(gpu).resident();
    let found = here.aligned(run, &here.upload(rows).unwrap()).unwrap();
    assert_eq!(
        found.download().unwrap(),
        gpu.aligned(run, rows).unwrap(),
        "what stays, and slices"
    );
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

/// All pairs of two lists: tables, reductions, derivatives.
pub fn pairs_agree<O, A, B>(gpu: &Gpu, run: O, a: &[A], b: &[B], bound: Bound)
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    A: Single<Scalar = f32> + PartialEq + Debug,
    B: Single<Scalar = f32> + PartialEq + Debug,
{
    let name = O::NAME;
    let table = gpu.all_pairs(run, a, b).unwrap();
    let expected = Cpu::new().all_pairs(run, a, b).unwrap();
    bound.holds(name, table.planes(), expected.planes());
    let again = gpu.all_pairs(run, a, b).unwrap();
    assert_eq!(bits(table.planes()), bits(again.planes()), "{name}");
    // A gradient per pair.
    let grads = gpu.all_pairs(run.value_grad(), a, b).unwrap();
    let fields = 1 + A::LEN + B::LEN;
    assert_eq!(grads.planes().len(), fields * a.len() * b.len(), "{name}");
    bound.holds(name, grads.values(), expected.values());
    // Reductions are those of the matrix.
    let values = table.values();
    let rows = gpu.row_max(run, a, b).unwrap();
    for (row, best) in values.chunks(b.len()).zip(&rows) {
        let most = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        assert_eq!(best.value, most, "{name}");
        let first = row.iter().position(|&x| x == most);
        assert_eq!(first, Some(best.index), "{name}");
    }
    let columns = gpu.column_max(run, a, b).unwrap();
    for (j, best) in columns.iter().enumerate() {
        let column = || values.iter().skip(j).step_by(b.len()).copied();
        let most = column().fold(f32::NEG_INFINITY, f32::max);
        assert_eq!(best.value, most, "{name}");
        let first = column().position(|x| x == most);
        assert_eq!(first, Some(best.index), "{name}");
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    let threshold = sorted[sorted.len() / 2];
    let above = gpu.above(run, a, b, threshold).unwrap();
    let found: Vec<(usize, f32)> = above
        .iter()
        .map(|found| (found.row * b.len() + found.column, found.value))
        .collect();
    let all = values.iter().copied().enumerate();
    let expected: Vec<(usize, f32)> = all.filter(|&(_, x)| x > threshold).collect();
    assert_eq!(found, expected, "{name}");
    let count = gpu.count_above(run, a, b, threshold).unwrap();
    assert_eq!(count as usize, expected.len(), "{name}");
    let exact: f64 = values.iter().map(|&x| f64::from(x)).sum();
    let size: f64 = values.iter().map(|&x| f64::from(x).abs()).sum();
    let sum = gpu.sum(run, a, b).unwrap();
    assert!(
        (sum - exact).abs() <= 1e-5 * size,
        "{name}: {sum} for {exact}"
    );
    let mean = gpu.mean(run, a, b).unwrap();
    assert_eq!(mean, sum / values.len() as f64, "{name}");
    // Derivatives: sums of those of every pair.
    let mut draw = Draw::new(5);
    let upstream: Vec<f32> = values.iter().map(|_| draw.unit() as f32 - 0.5).collect();
    let bars = gpu.all_pairs_vjp(run, a, b, &upstream).unwrap();
    let again = gpu.all_pairs_vjp(run, a, b, &upstream).unwrap();
    assert_eq!(again, bars, "{name}: the same bits");
    derivatives_agree((name, bound), &grads, &upstream, (&bars.0, &bars.1));
    let (found, a_grad, b_grad) = gpu.sum_grad(run, a, b).unwrap();
    // Kernels by hand add the sum in other groups beside its derivatives.
    assert!(
        (found - sum).abs() <= 1e-6 * size,
        "{name}: {found} for {sum}"
    );
    derivatives_agree(
        (name, bound),
        &grads,
        &vec![1.0; values.len()],
        (&a_grad, &b_grad),
    );
    let (found, mean_bar, _) = gpu.mean_grad(run, a, b).unwrap();
    assert!(
        (found - mean).abs() <= 1e-6 * size / values.len() as f64,
        "{name}: {found} for {mean}"
    );
    assert_eq!(mean_bar.len(), a.len());
    // The same of lists that stay.
    let here = Backend::Gpu(gpu).resident();
    let (on_a, on_b) = (here.upload(a).unwrap(), here.upload(b).unwrap());
    let matrix = here.all_pairs(run, &on_a, &on_b).unwrap();
    assert_eq!(bits(&matrix.download().unwrap()), bits(values), "{name}");
    let best = here.row_max(run, &on_a, &on_b).unwrap();
    assert_eq!(best.download().unwrap(), rows, "{name}");
    let on_upstream = here.upload_matrix(a.len(), b.len(), &upstream).unwrap();
    let (a_bar, b_bar) = here.all_pairs_vjp(run, &on_a, &on_b, &on_upstream).unwrap();
    let again = (a_bar.download().unwrap(), b_bar.download().unwrap());
    assert_eq!(again, bars, "{name}: the same bits");
}

/// Derivatives of both lists are sums of those of pairs, weighed.
fn derivatives_agree<A, B>(
    (name, bound): (&str, Bound),
    grads: &Table<(f32, (A, B))>,
    weights: &[f32],
    (a_bar, b_bar): (&[A], &[B]),
) where
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    let (rows, columns) = (a_bar.len(), b_bar.len());
    // What is left where terms cancel within a derivative is known to a few digits of those.
    let largest = match bound {
        Bound::All => 1.0,
        Bound::Most => {
            let sizes = grads.planes().iter().map(|x| x.abs());
            sizes.fold(1.0, f32::max)
        }
    };
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
    for (i, bar) in a_bar.iter().enumerate() {
        for (k, found) in bar.scalars().into_iter().enumerate() {
            let own = &mut (0..columns).map(|j| i * columns + j);
            check(found, grads.plane(1 + k), own);
        }
    }
    for (j, bar) in b_bar.iter().enumerate() {
        for (k, found) in bar.scalars().into_iter().enumerate() {
            let own = &mut (0..rows).map(|i| i * columns + j);
            check(found, grads.plane(1 + A::LEN + k), own);
        }
    }
}
