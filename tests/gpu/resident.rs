//! Data that stay between calls: the same code on the CPU and on a GPU.
use crate::bounds::{close, value_bound};
use crate::gpu;
use crate::shapes::{Draw, Draws, bits, fields};
use geograd::GpuFault;
use geograd::error::{Argument, Field};
use geograd::kernels::Backend;
use geograd::kernels::gpu::GpuPair;
use geograd::kernels::ops::overlap;
use geograd::kernels::reduce::{Best, Found};
use geograd::kernels::resident::{Bars, Shapes};
use geograd::{Aabb2, Error, Flaw, Obb2};

/// What a chain of calls comes to.
struct Outcome<P> {
    values: Vec<f32>,
    bars: [Vec<P>; 8],
    matrix: Vec<f32>,
    planes: Vec<f32>,
    bests: [Vec<Best>; 4],
    founds: [Vec<Found>; 2],
    counts: [u64; 2],
    sums: [f64; 6],
    picked: Vec<f32>,
}

/// Every call there is on handles, one result feeding the next.
fn chain<O: GpuPair>(
    backend: Backend<'_>,
    a: &[O::Shape],
    b: &[O::Shape],
) -> Result<Outcome<O::Shape>, Error> {
    let (on_a, on_b) = (backend.upload(a)?, backend.upload(b)?);
    let same = backend.upload(&b[..a.len()])?;
    let (values, a_bar, b_bar) = on_a.aligned_grad(O::default(), &same)?;
    let (by_a, by_b) = on_a.aligned_vjp(O::default(), &same, &values)?;
    let matrix = on_a.all_pairs(O::default(), &on_b)?;
    let grads = on_a.all_pairs_grad(O::default(), &on_b)?;
    // The matrix is its own upstream: half the slopes of the sum of squares.
    let (all_a, all_b) = on_a.all_pairs_vjp(O::default(), &on_b, &matrix)?;
    let (sum, sum_a, sum_b) = on_a.sum_grad(O::default(), &on_b)?;
    let (mean, ..) = on_a.mean_grad(O::default(), &on_b)?;
    let best = on_a.row_max(O::default(), &on_b)?;
    let picked = on_b.pick(&best)?;
    let picked = on_a.aligned(O::default(), &picked)?;
    Ok(Outcome {
        values: values.download()?,
        bars: [
            a_bar.download()?,
            b_bar.download()?,
            by_a.download()?,
            by_b.download()?,
            all_a.download()?,
            all_b.download()?,
            sum_a.download()?,
            sum_b.download()?,
        ],
        matrix: matrix.download()?,
        planes: grads.download()?.into_planes(),
        bests: [
            best.download()?,
            on_a.column_max(O::default(), &on_b)?.download()?,
            matrix.row_max()?.download()?,
            matrix.column_max()?.download()?,
        ],
        founds: [
            on_a.above(O::default(), &on_b, 0.3)?.download()?,
            matrix.above(0.3)?.download()?,
        ],
        counts: [
            on_a.count_above(O::default(), &on_b, 0.3)?,
            matrix.count_above(0.3)?,
        ],
        sums: [
            sum,
            mean,
            on_a.sum(O::default(), &on_b)?,
            on_a.mean(O::default(), &on_b)?,
            matrix.sum()?,
            matrix.mean()?,
        ],
        picked: picked.download()?,
    })
}

pub fn chains_agree<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draws = Draws(23);
    let mut some = |n: usize| -> Vec<O::Shape> { (0..n).map(|_| Draw::draw(&mut draws)).collect() };
    let (a, b) = (some(70), some(90));
    let expected = chain::<O>(Backend::Cpu, &a, &b).unwrap();
    for gpu in [gpu, &crate::small()] {
        let found = chain::<O>(Backend::Gpu(gpu), &a, &b).unwrap();
        let near = |found: &[f32], expected: &[f32], pair: &dyn Fn(usize) -> (usize, usize)| {
            assert_eq!(found.len(), expected.len());
            for (at, (&x, &y)) in found.iter().zip(expected).enumerate() {
                let (i, j) = pair(at);
                let bound = value_bound::<O>(a[i], b[j], f64::from(y));
                assert!((f64::from(x) - f64::from(y)).abs() <= bound, "{x} for {y}");
            }
        };
        let matrix = &expected.matrix;
        near(&found.values, &expected.values, &|at| (at, at));
        near(&found.matrix, matrix, &|at| (at / b.len(), at % b.len()));
        // A box that holds several others is as good a match for each of them but for rounding, so
        // which one is best may differ, but not how good it is.
        for (k, (found, expected)) in found.bests.iter().zip(&expected.bests).enumerate() {
            let pair = |at: usize, index| if k % 2 == 0 { (at, index) } else { (index, at) };
            for (at, (x, y)) in found.iter().zip(expected).enumerate() {
                let (i, j) = pair(at, x.index);
                let bound = value_bound::<O>(a[i], b[j], f64::from(y.value));
                assert!((f64::from(x.value) - f64::from(y.value)).abs() <= bound);
                let there = matrix[i * b.len() + j];
                assert!((f64::from(there) - f64::from(y.value)).abs() <= bound);
            }
        }
        let best = &found.bests[0];
        let most: Vec<f32> = best.iter().map(|best| best.value).collect();
        near(&found.picked, &most, &|at| (at, best[at].index));
        let places = |all: &[Found]| all.iter().map(|x| (x.row, x.column)).collect::<Vec<_>>();
        for (found, expected) in found.founds.iter().zip(&expected.founds) {
            assert_eq!(places(found), places(expected));
        }
        assert_eq!(found.counts, expected.counts);
        for (found, expected) in found.sums.iter().zip(expected.sums) {
            assert!(
                (found - expected).abs() <= 1e-4 * expected,
                "{found} for {expected}"
            );
        }
        // Slopes are held to their bounds by the tests of each call; here only that the handles
        // carry the right ones: all of one kind together.
        for (found, expected) in found.bars.iter().zip(&expected.bars) {
            assert_eq!(found.len(), expected.len());
            let (mut off, mut size) = (0.0_f64, 0.0_f64);
            for (x, y) in found.iter().zip(expected) {
                for (x, y) in fields(*x).into_iter().zip(fields(*y)) {
                    off += (x - y).abs();
                    size += y.abs();
                }
            }
            assert!(off <= 1e-3 * size, "{}: {off} of {size}", O::NAME);
        }
        assert_eq!(found.planes.len(), expected.planes.len());
    }
}

/// A thousand steps of gradient ascent, of a few boxes, in buffers that are made once.
fn climb(backend: Backend<'_>, steps: usize) -> Result<Vec<f32>, Error> {
    let truths: Vec<_> = (0..80)
        .map(|i| Obb2::new(i as f32, 0.0, 4.0, 2.0, 0.1))
        .collect();
    let mut guesses: Vec<Obb2<f32>> = truths
        .iter()
        .map(|t| Obb2::new(t.center.x + 0.5, 0.3, 4.4, 1.8, 0.3))
        .collect();
    let (mut a, b) = (backend.upload(&guesses)?, backend.upload(&truths)?);
    let (mut iou, mut slopes, mut unused) = a.aligned_grad(overlap::IouObb2, &b)?;
    let mut slope = guesses.clone();
    for step in 0..steps {
        slopes.download_into(&mut slope)?;
        let pace = 0.1 / (1.0 + 0.05 * step as f32);
        for (guess, slope) in guesses.iter_mut().zip(&slope) {
            guess.center += slope.center * pace;
            guess.size += slope.size * pace;
            guess.heading += slope.heading * pace * 0.1;
        }
        a.update(&guesses)?;
        a.aligned_grad_into(overlap::IouObb2, &b, &mut iou, &mut slopes, &mut unused)?;
    }
    iou.download()
}

#[test]
fn a_thousand_steps_in_the_same_buffers() {
    let Some((_turn, gpu)) = gpu() else { return };
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let (first, last) = (climb(backend, 0).unwrap(), climb(backend, 1000).unwrap());
        for (first, last) in first.iter().zip(&last) {
            assert!(last > &0.97 && last > first, "{first} to {last}");
        }
    }
}

/// Calls over results that are there already leave the bits that new results have.
#[test]
fn into_is_the_same_as_anew() {
    let Some((_turn, gpu)) = gpu() else { return };
    type O = overlap::IouObb2;
    let mut draws = Draws(31);
    let mut some = || -> Vec<Obb2<f32>> { (0..150).map(|_| Draw::draw(&mut draws)).collect() };
    let (first, second, other) = (some(), some(), some());
    for backend in [
        Backend::Cpu,
        Backend::Gpu(gpu),
        Backend::Gpu(&crate::small()),
    ] {
        let run = |a: &Shapes<Obb2<f32>>, b: &Shapes<Obb2<f32>>| -> Vec<u32> {
            let (values, x, y) = a.aligned_grad(O::default(), b).unwrap();
            let matrix = a.all_pairs(O::default(), b).unwrap();
            let (z, w) = a.all_pairs_vjp(O::default(), b, &matrix).unwrap();
            let mut all = bits(&values.download().unwrap());
            all.extend(bits(&matrix.download().unwrap()));
            all.extend([x, y, z, w].iter().flat_map(bits_of));
            all
        };
        let (mut a, b) = (
            backend.upload(&first).unwrap(),
            backend.upload(&other).unwrap(),
        );
        let (mut values, mut x, mut y) = a.aligned_grad(O::default(), &b).unwrap();
        let mut matrix = a.all_pairs(O::default(), &b).unwrap();
        let (mut z, mut w) = a.all_pairs_vjp(O::default(), &b, &matrix).unwrap();
        a.update(&second).unwrap();
        a.aligned_into(O::default(), &b, &mut values).unwrap();
        let alone = values.download().unwrap();
        a.aligned_grad_into(O::default(), &b, &mut values, &mut x, &mut y)
            .unwrap();
        for (x, y) in alone.iter().zip(values.download().unwrap()) {
            assert!(close(*x, y));
        }
        a.all_pairs_into(O::default(), &b, &mut matrix).unwrap();
        a.all_pairs_vjp_into(O::default(), &b, &matrix, &mut z, &mut w)
            .unwrap();
        let mut all = bits(&values.download().unwrap());
        all.extend(bits(&matrix.download().unwrap()));
        all.extend([&x, &y, &z, &w].into_iter().flat_map(bits_of));
        let anew = backend.upload(&second).unwrap();
        assert!(all == run(&anew, &b));

        let (sum, sum_a, sum_b) = a.sum_grad(O::default(), &b).unwrap();
        let again = a
            .sum_grad_into(O::default(), &b, 1.0, &mut z, &mut w)
            .unwrap();
        assert_eq!(sum, again);
        assert!(bits_of(&z) == bits_of(&sum_a) && bits_of(&w) == bits_of(&sum_b));
        let ones = backend.upload_matrix(150, 150, &[1.0; 150 * 150]).unwrap();
        a.all_pairs_vjp_into(O::default(), &b, &ones, &mut z, &mut w)
            .unwrap();
        assert!(
            bits_of(&z) == bits_of(&sum_a),
            "an upstream of ones is the sum"
        );

        let mut upstream = backend.upload_values(&[1.0; 150]).unwrap();
        let (once, _) = a.aligned_vjp(O::default(), &b, &upstream).unwrap();
        upstream.update(&[2.0; 150]).unwrap();
        a.aligned_vjp_into(O::default(), &b, &upstream, &mut x, &mut y)
            .unwrap();
        for (once, twice) in once.download().unwrap().iter().zip(x.download().unwrap()) {
            assert!(
                fields(*once)
                    .iter()
                    .zip(fields(twice))
                    .all(|(x, y)| 2.0 * x == y)
            );
        }
    }
}

fn bits_of(bars: &Bars<Obb2<f32>>) -> Vec<u32> {
    let all = bars.download().unwrap();
    all.iter()
        .flat_map(|bar| bits(&geograd::Pack::scalars(bar)))
        .collect()
}

#[test]
fn updates_are_checked_and_change_nothing_when_refused() {
    let Some((_turn, gpu)) = gpu() else { return };
    type O = overlap::IouAabb2;
    let good = Aabb2::new(0.0, 0.0, 2.0, 2.0);
    let bad = Aabb2::new(0.0, 0.0, f32::NAN, 2.0);
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let mut a = backend.upload(&[good, good]).unwrap();
        let expected = Error::Invalid {
            argument: Argument::Shape,
            row: 1,
            flaw: Flaw::NotFinite(Field::new("max.x")),
        };
        assert_eq!(a.update(&[good, bad]).unwrap_err(), expected);
        let expected = Error::Length {
            argument: Argument::Shape,
            expected: 2,
            found: 1,
        };
        assert_eq!(a.update(&[good]).unwrap_err(), expected);
        assert_eq!(
            a.aligned(O::default(), &a).unwrap().download().unwrap(),
            [1.0, 1.0]
        );
        let one = backend.upload(&[good]).unwrap();
        let (mut values, mut x, _) = one.aligned_grad(O::default(), &one).unwrap();
        assert!(a.aligned_into(O::default(), &a, &mut values).is_err());
        let mut y = x.clone();
        let refused = one.aligned_grad_into(O::default(), &one, &mut values, &mut x, &mut y);
        assert_eq!(refused.unwrap(), ());
        let mut values = a.aligned(O::default(), &a).unwrap();
        let refused = a.aligned_grad_into(O::default(), &a, &mut values, &mut x, &mut y);
        let expected = Error::Length {
            argument: Argument::GradA,
            expected: 2,
            found: 1,
        };
        assert_eq!(refused.unwrap_err(), expected);
        // Results about a list of another length pick nothing.
        let best = one.row_max(O::default(), &a).unwrap();
        assert!(one.pick(&best).is_err());
        assert!(a.pick(&best).is_ok());
    }
    // Handles of both do not mix.
    let on_cpu = Backend::Cpu.upload(&[good]).unwrap();
    let on_gpu = Backend::Gpu(gpu).upload(&[good]).unwrap();
    assert_eq!(
        on_cpu.aligned(O::default(), &on_gpu).unwrap_err(),
        Error::Gpu(GpuFault::ForeignBuffer)
    );
    assert_eq!(
        on_gpu.aligned(O::default(), &on_cpu).unwrap_err(),
        Error::Gpu(GpuFault::ForeignBuffer)
    );
}

/// Ordinary boxes made extreme in place take the shader for extremes from then on.
#[test]
fn an_update_to_extremes_is_noticed() {
    let Some((_turn, gpu)) = gpu() else { return };
    type O = overlap::IntersectionAreaObb2;
    let tiny = Obb2::new(0.0, 0.0, 1e-30, 1e-30, 0.3);
    let huge = Obb2::new(0.0, 0.0, 1e18, 1e18, 0.3);
    let mut a = gpu.upload(&[Obb2::new(0.0, 0.0, 1.0, 1.0, 0.3)]).unwrap();
    let clone = a.clone();
    for shape in [huge, tiny] {
        a.update(&[shape]).unwrap();
        let expected = Backend::Cpu.sum(O::default(), &[shape], &[shape]).unwrap();
        for a in [&a, &clone] {
            let found = gpu.aligned(O::default(), a, a).unwrap().download().unwrap();
            assert!((f64::from(found[0]) - expected).abs() <= 1e-5 * expected);
        }
    }
}

#[test]
fn downloads_of_either_side_can_be_awaited() {
    let Some((_turn, gpu)) = gpu() else { return };
    let boxes = Obb2::<f32>::hard();
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let on = backend.upload(&boxes).unwrap();
        let matrix = on.all_pairs(overlap::IouObb2, &on).unwrap();
        let awaited = pollster::block_on(matrix.start_download().unwrap()).unwrap();
        assert_eq!(bits(&awaited), bits(&matrix.download().unwrap()));
    }
}

/// Slices in, slices out, through the front.
#[test]
fn slices_into_slices() {
    let Some((_turn, gpu)) = gpu() else { return };
    type O = overlap::IouObb2;
    let mut draws = Draws(4);
    let boxes: Vec<Obb2<f32>> = (0..70).map(|_| Draw::draw(&mut draws)).collect();
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let expected = backend
            .aligned_grad(O::default(), &boxes, &boxes[..])
            .unwrap();
        let (mut values, mut x, mut y) = (vec![0.0; 70], boxes.clone(), boxes.clone());
        backend
            .aligned_grad_into(O::default(), &boxes, &boxes, &mut values, &mut x, &mut y)
            .unwrap();
        assert_eq!((&values, &x, &y), (&expected.0, &expected.1, &expected.2));
        let mut again = vec![0.0; 70];
        backend
            .aligned_into(O::default(), &boxes, &boxes, &mut again)
            .unwrap();
        assert!(again.iter().zip(&values).all(|(x, y)| close(*x, *y)));
        let refused = backend.aligned_into(O::default(), &boxes, &boxes, &mut again[1..]);
        assert!(refused.is_err());
        let (sum, x, _) = backend.sum_grad(O::default(), &boxes, &boxes).unwrap();
        let (mean, z, _) = backend.mean_grad(O::default(), &boxes, &boxes).unwrap();
        assert!((sum / 4900.0 - mean).abs() <= 1e-6 * mean);
        let size = |bars: &[Obb2<f32>]| {
            bars.iter()
                .flat_map(|x| fields(*x))
                .map(f64::abs)
                .sum::<f64>()
        };
        assert!((size(&x) / 4900.0 - size(&z)).abs() <= 1e-4 * size(&z));
    }
}
