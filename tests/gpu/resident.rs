//! Data that stay between calls: the same code on the CPU and on a GPU.
use crate::bounds::{close, value_bound};
use crate::gpu;
use crate::shapes::{Draw, Draws, Score, bits, fields};
use geograd::GpuFault;
use geograd::error::{Argument, Field};
use geograd::kernels::reduce::{Best, Found};
use geograd::kernels::resident::Held;
use geograd::kernels::{Backend, Op};
use geograd::{Aabb2, Error, Flaw, Obb2};
use geograd_tests::rows::overlap;

/// The results of a chain of calls.
struct Outcome<P> {
    values: Vec<f32>,
    bars: [Vec<P>; 8],
    matrix: Vec<f32>,
    bests: [Vec<Best>; 4],
    founds: [Vec<Found>; 2],
    counts: [u64; 2],
    sums: [f64; 6],
    picked: Vec<f32>,
}

/// Every call there is on handles, one result feeding the next.
fn chain<O: Score>(
    backend: Backend<'_>,
    a: &[O::Shape],
    b: &[O::Shape],
) -> Result<Outcome<O::Shape>, Error> {
    let here = backend.resident();
    let run = O::default();
    let (a, b, same) = (
        here.upload(a)?,
        here.upload(b)?,
        here.upload(&b[..a.len()])?,
    );
    let (values, bars) = here.aligned(run.value_grad(), (&a, &same))?.split();
    let (a_bar, b_bar) = bars.split();
    let (by_a, by_b) = here.aligned(run.vjp(), ((&a, &same), &values))?.split();
    let matrix = here.all_pairs(run, &a, &b)?;
    // The matrix is its own upstream: half the derivatives of the sum of squares.
    let (all_a, all_b) = here.all_pairs_vjp(run, &a, &b, &matrix)?;
    let (sum, sum_a, sum_b) = here.sum_grad(run, &a, &b)?;
    let (mean, ..) = here.mean_grad(run, &a, &b)?;
    let best = here.row_max(run, &a, &b)?;
    let picked = here.pick(&b, &best)?;
    let picked = here.aligned(run, (&a, &picked))?;
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
        bests: [
            best.download()?,
            here.column_max(run, &a, &b)?.download()?,
            matrix.row_max()?.download()?,
            matrix.column_max()?.download()?,
        ],
        founds: [
            here.above(run, &a, &b, 0.3)?.download()?,
            matrix.above(0.3)?.download()?,
        ],
        counts: [
            here.count_above(run, &a, &b, 0.3)?,
            matrix.count_above(0.3)?,
        ],
        sums: [
            sum,
            mean,
            here.sum(run, &a, &b)?,
            here.mean(run, &a, &b)?,
            matrix.sum()?,
            matrix.mean()?,
        ],
        picked: picked.download()?,
    })
}

pub fn chains_agree<O: Score>() {
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
        // Derivatives are held to their bounds by the tests of each call; here only that the handles
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
            assert!(off <= 1e-3 * size, "{}: {off} of {size}", O::DECLARED.name);
        }
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
    let here = backend.resident();
    let (mut a, b) = (here.upload(&guesses)?, here.upload(&truths)?);
    let run = overlap::IouObb2.value_grad();
    let mut found = here.aligned(run, (&a, &b))?;
    for step in 0..steps {
        let (_, (derivative, _)) = found.download()?;
        let pace = 0.1 / (1.0 + 0.05 * step as f32);
        for (guess, derivative) in guesses.iter_mut().zip(&derivative) {
            guess.center += derivative.center * pace;
            guess.size += derivative.size * pace;
            guess.heading += derivative.heading * pace * 0.1;
        }
        a.update(&guesses)?;
        here.aligned_into(run, (&a, &b), &mut found)?;
    }
    Ok(found.download()?.0)
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
    let run = overlap::IouObb2;
    let mut draws = Draws(31);
    let mut some = || -> Vec<Obb2<f32>> { (0..150).map(|_| Draw::draw(&mut draws)).collect() };
    let (first, second, other) = (some(), some(), some());
    for backend in [
        Backend::Cpu,
        Backend::Gpu(gpu),
        Backend::Gpu(&crate::small()),
    ] {
        let here = backend.resident();
        let (mut a, b) = (here.upload(&first).unwrap(), here.upload(&other).unwrap());
        let mut values = here.aligned(run, (&a, &b)).unwrap();
        let mut grads = here.aligned(run.value_grad(), (&a, &b)).unwrap();
        let mut matrix = here.all_pairs(run, &a, &b).unwrap();
        a.update(&second).unwrap();
        here.aligned_into(run, (&a, &b), &mut values).unwrap();
        here.aligned_into(run.value_grad(), (&a, &b), &mut grads)
            .unwrap();
        here.all_pairs_into(run, &a, &b, &mut matrix).unwrap();
        let anew = here.upload(&second).unwrap();
        let bits_of = |held: &Held<f32>| bits(&held.download().unwrap());
        assert!(bits_of(&values) == bits_of(&here.aligned(run, (&anew, &b)).unwrap()));
        let again = here.aligned(run.value_grad(), (&anew, &b)).unwrap();
        assert!(grads.numbers().unwrap() == again.numbers().unwrap());
        for (x, y) in values
            .download()
            .unwrap()
            .iter()
            .zip(grads.download().unwrap().0)
        {
            assert!(close(*x, y));
        }
        let again = here.all_pairs(run, &anew, &b).unwrap();
        assert!(bits(&matrix.download().unwrap()) == bits(&again.download().unwrap()));

        // Sums with derivatives are those of an upstream of ones.
        let (_, sum_a, sum_b) = here.sum_grad(run, &a, &b).unwrap();
        let ones = here.upload_matrix(150, 150, &[1.0; 150 * 150]).unwrap();
        let (by_a, by_b) = here.all_pairs_vjp(run, &a, &b, &ones).unwrap();
        assert!(sum_a.numbers().unwrap() == by_a.numbers().unwrap());
        assert!(sum_b.numbers().unwrap() == by_b.numbers().unwrap());

        let mut upstream = here.upload(&[1.0_f32; 150]).unwrap();
        let once = here.aligned(run.vjp(), ((&a, &b), &upstream)).unwrap();
        upstream.update(&[2.0; 150]).unwrap();
        let twice = here.aligned(run.vjp(), ((&a, &b), &upstream)).unwrap();
        let (once, twice) = (once.numbers().unwrap(), twice.numbers().unwrap());
        let mut both = once.iter().flatten().zip(twice.iter().flatten());
        assert!(both.all(|(x, y)| 2.0 * x == *y));
    }
}

#[test]
fn updates_are_checked_and_change_nothing_when_refused() {
    let Some((_turn, gpu)) = gpu() else { return };
    let run = overlap::IouAabb2;
    let good = Aabb2::new(0.0, 0.0, 2.0, 2.0);
    let bad = Aabb2::new(0.0, 0.0, f32::NAN, 2.0);
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let here = backend.resident();
        let mut a = here.upload(&[good, good]).unwrap();
        let expected = Error::Invalid {
            argument: Argument::Shape,
            item: 1,
            flaw: Flaw::NotFinite(Field::new("max.x")),
        };
        assert_eq!(a.update(&[good, bad]).unwrap_err(), expected);
        let expected = Error::Length {
            argument: Argument::Shape,
            expected: 2,
            found: 1,
        };
        assert_eq!(a.update(&[good]).unwrap_err(), expected);
        let mut values = here.aligned(run, (&a, &a)).unwrap();
        assert_eq!(values.download().unwrap(), [1.0, 1.0]);
        let one = here.upload(&[good]).unwrap();
        let refused = here.aligned_into(run, (&one, &one), &mut values);
        let expected = Error::Length {
            argument: Argument::Values,
            expected: 1,
            found: 2,
        };
        assert_eq!(refused.unwrap_err(), expected);
        let mut matrix = here.all_pairs(run, &a, &one).unwrap();
        assert!(here.all_pairs_into(run, &one, &one, &mut matrix).is_err());
        assert!(here.all_pairs_vjp(run, &one, &one, &matrix).is_err());
        // Results about a list of another length pick nothing.
        let best = here.row_max(run, &one, &a).unwrap();
        assert!(here.pick(&one, &best).is_err());
        assert!(here.pick(&a, &best).is_ok());
    }
    // Handles of both do not mix.
    let (cpu, gpu) = (Backend::Cpu.resident(), Backend::Gpu(gpu).resident());
    let (on_cpu, on_gpu) = (cpu.upload(&[good]).unwrap(), gpu.upload(&[good]).unwrap());
    let foreign = Error::Gpu(GpuFault::ForeignBuffer);
    for here in [cpu, gpu] {
        let refused = here.aligned(run, (&on_cpu, &on_gpu));
        assert_eq!(refused.unwrap_err(), foreign);
        let refused = here.row_max(run, &on_gpu, &on_cpu);
        assert_eq!(refused.unwrap_err(), foreign);
    }
}

/// Ordinary boxes made extreme in place take the shader for extremes from then on.
#[test]
fn an_update_to_extremes_is_noticed() {
    let Some((_turn, gpu)) = gpu() else { return };
    let run = overlap::IntersectionAreaObb2;
    let tiny = Obb2::new(0.0, 0.0, 1e-30, 1e-30, 0.3);
    let huge = Obb2::new(0.0, 0.0, 1e18, 1e18, 0.3);
    let here = Backend::Gpu(gpu).resident();
    let mut a = here.upload(&[Obb2::new(0.0, 0.0, 1.0, 1.0, 0.3)]).unwrap();
    assert!((here.sum(run, &a, &a).unwrap() - 1.0).abs() <= 1e-6);
    for shape in [huge, tiny] {
        a.update(&[shape]).unwrap();
        let expected = Backend::Cpu.sum(run, &[shape], &[shape]).unwrap();
        let found = here.aligned(run, (&a, &a)).unwrap().download().unwrap();
        for found in [f64::from(found[0]), here.sum(run, &a, &a).unwrap()] {
            assert!((found - expected).abs() <= 1e-5 * expected);
        }
    }
}

#[test]
fn downloads_of_either_side_can_be_awaited() {
    let Some((_turn, gpu)) = gpu() else { return };
    let boxes = Obb2::<f32>::hard();
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let here = backend.resident();
        let on = here.upload(&boxes).unwrap();
        let matrix = here.all_pairs(overlap::IouObb2, &on, &on).unwrap();
        let awaited = pollster::block_on(matrix.start_download().unwrap()).unwrap();
        assert_eq!(bits(&awaited), bits(&matrix.download().unwrap()));
        let held = here
            .aligned(overlap::IouObb2.value_grad(), (&on, &on))
            .unwrap();
        let awaited = pollster::block_on(held.start_download().unwrap()).unwrap();
        assert_eq!(awaited, held.download().unwrap());
    }
}

/// Slices in, slices out, through the front.
#[test]
fn slices_into_slices() {
    let Some((_turn, gpu)) = gpu() else { return };
    let run = overlap::IouObb2;
    let mut draws = Draws(4);
    let boxes: Vec<Obb2<f32>> = (0..70).map(|_| Draw::draw(&mut draws)).collect();
    for backend in [Backend::Cpu, Backend::Gpu(gpu)] {
        let columns = (&boxes, &boxes);
        let expected = backend.aligned(run.value_grad(), columns).unwrap();
        let (mut values, mut x, mut y) = (vec![0.0; 70], boxes.clone(), boxes.clone());
        let into = (&mut values[..], (&mut x[..], &mut y[..]));
        backend
            .aligned_into(run.value_grad(), columns, into)
            .unwrap();
        assert_eq!(
            (&values, (&x, &y)),
            (&expected.0, (&expected.1.0, &expected.1.1))
        );
        let mut again = vec![0.0; 70];
        backend.aligned_into(run, columns, &mut again[..]).unwrap();
        assert!(again.iter().zip(&values).all(|(x, y)| close(*x, *y)));
        let refused = backend.aligned_into(run, columns, &mut again[1..]);
        assert!(refused.is_err());
        let (sum, x, _) = backend.sum_grad(run, &boxes, &boxes).unwrap();
        let (mean, z, _) = backend.mean_grad(run, &boxes, &boxes).unwrap();
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
