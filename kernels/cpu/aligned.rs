//! Aligned batches: row i with row i.
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{Checked, check, expect, fill, numbers, restore, tame};
use crate::kernels::cpu::desk::Aligned;
use crate::kernels::cpu::work::spread;
use crate::kernels::cpu::{A, B, Bars};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;

/// Aligned pairs per piece of work: enough to be worth a thread's while.
const STRETCH: usize = 2048;

/// Row i of `a` with row i of `b`: one result per row.
///
/// # Errors
///
/// [`Error::Length`] when the lists differ in length, [`Error::Invalid`] for a shape that is not
/// valid.
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0_f32, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
/// assert_eq!(cpu::aligned::<IouObb2, _>(&a, &b)?, [1.0 / 3.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn aligned<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Vec<T>, Error> {
    let mut values = vec![T::default(); a.len()];
    aligned_into::<O, T>(a, b, &mut values)?;
    Ok(values)
}

/// [`aligned`] into the caller's buffer.
///
/// # Errors
///
/// As [`aligned`], and [`Error::Length`] for a buffer of another length. The buffer is then as it
/// was.
pub fn aligned_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Values, a.len(), values.len())?;
    let Checked { plan, rare } = check::<O, T>(a, b)?;
    let work = a
        .chunks(STRETCH)
        .zip(b.chunks(STRETCH))
        .zip(values.chunks_mut(STRETCH))
        .collect();
    type Work<'a, A, B, T> = ((&'a [A], &'a [B]), &'a mut [T]);
    spread(work, |((a, b), values): Work<'_, A<O, T>, B<O, T>, T>| {
        let work = Aligned {
            shapes: [&numbers(a), &numbers(b)],
            rare,
            values: Some(values),
            bars: None,
            upstream: None,
        };
        (T::drivers().aligned)(&plan, work);
    });
    Ok(())
}

/// Results and slopes of aligned pairs.
pub type AlignedGrads<O, T> = (Vec<T>, Vec<A<O, T>>, Vec<B<O, T>>);

/// [`aligned`] with the slopes of every result with respect to both of its shapes.
///
/// # Errors
///
/// As [`aligned`].
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{cpu, overlap::IouObb2};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// let (iou, a_bar, _) = cpu::aligned_grad::<IouObb2, f64>(&a, &b)?;
/// assert_eq!(iou, [1.0 / 3.0]);
/// assert!((a_bar[0].center.x - 4.0 / 9.0).abs() < 1e-15); // nearer is better
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn aligned_grad<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
) -> Result<AlignedGrads<O, T>, Error> {
    expect(Argument::B, a.len(), b.len())?;
    let (mut values, mut a_bar, mut b_bar) = (vec![T::default(); a.len()], a.to_vec(), b.to_vec());
    aligned_grad_into::<O, T>(a, b, &mut values, &mut a_bar, &mut b_bar)?;
    Ok((values, a_bar, b_bar))
}

/// [`aligned_grad`] into the caller's buffers.
///
/// # Errors
///
/// As [`aligned`], and [`Error::Length`] for a buffer of another length. The buffers are then as
/// they were.
pub fn aligned_grad_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Values, a.len(), values.len())?;
    aligned_slopes::<O, T>(a, b, Seed::One(values), a_bar, b_bar)
}

/// The adjoint of [`aligned`]: `upstream[i]` times the slopes of result i.
///
/// # Errors
///
/// As [`aligned`], and for an upstream of another length or one that is not finite.
pub fn aligned_vjp<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
) -> Result<Bars<O, T>, Error> {
    let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
    aligned_vjp_into::<O, T>(a, b, upstream, &mut a_bar, &mut b_bar)?;
    Ok((a_bar, b_bar))
}

/// [`aligned_vjp`] into the caller's buffers.
///
/// # Errors
///
/// As [`aligned_vjp`], and [`Error::Length`] for a buffer of another length. The buffers are then
/// as they were.
pub fn aligned_vjp_into<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    upstream: &[T],
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::B, a.len(), b.len())?;
    expect(Argument::Upstream, a.len(), upstream.len())?;
    aligned_slopes::<O, T>(a, b, Seed::Upstream(upstream), a_bar, b_bar)
}

/// What slopes are multiplied by, or where the results go.
enum Seed<'a, T> {
    One(&'a mut [T]),
    Upstream(&'a [T]),
}

fn aligned_slopes<O: PairOp, T: Real>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    seed: Seed<'_, T>,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) -> Result<(), Error> {
    expect(Argument::GradA, a.len(), a_bar.len())?;
    expect(Argument::GradB, b.len(), b_bar.len())?;
    let Checked { plan, rare } = check::<O, T>(a, b)?;
    let steep = match seed {
        Seed::Upstream(upstream) => tame(upstream, plan.steepest)?,
        Seed::One(_) => None,
    };
    let tamed: Vec<T> = steep.iter().flatten().map(|x| x.0).collect();
    let seed = match (seed, &steep) {
        (Seed::Upstream(_), Some(_)) => Seed::Upstream(&tamed),
        (seed, _) => seed,
    };
    let seeds: Vec<Seed<'_, T>> = match seed {
        Seed::One(values) => values.chunks_mut(STRETCH).map(Seed::One).collect(),
        Seed::Upstream(upstream) => upstream.chunks(STRETCH).map(Seed::Upstream).collect(),
    };
    let bars = a_bar.chunks_mut(STRETCH).zip(b_bar.chunks_mut(STRETCH));
    let work = a
        .chunks(STRETCH)
        .zip(b.chunks(STRETCH))
        .zip(seeds)
        .zip(bars)
        .collect();
    type Work<'a, A, B, T> = (
        ((&'a [A], &'a [B]), Seed<'a, T>),
        (&'a mut [A], &'a mut [B]),
    );
    spread(
        work,
        |(((a, b), seed), (a_bar, b_bar)): Work<'_, A<O, T>, B<O, T>, T>| {
            let (values, upstream) = match seed {
                Seed::One(values) => (Some(values), None),
                Seed::Upstream(upstream) => (None, Some(upstream)),
            };
            fill(a_bar, |a_bar| {
                fill(b_bar, |b_bar| {
                    let work = Aligned {
                        shapes: [&numbers(a), &numbers(b)],
                        rare,
                        values,
                        bars: Some([a_bar, b_bar]),
                        upstream,
                    };
                    (T::drivers().aligned)(&plan, work);
                });
            });
        },
    );
    for (i, (_, by)) in steep.into_iter().flatten().enumerate() {
        if by != T::one() {
            fill(&mut a_bar[i..=i], |slopes| restore(slopes, by));
            fill(&mut b_bar[i..=i], |slopes| restore(slopes, by));
        }
    }
    Ok(())
}
