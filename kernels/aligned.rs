//! Aligned batches: row i with row i.
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B, Bars};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::kernels::tile::{
    check, check_upstream, expect, gather, load, opaque, padded, run, scatter, spread, start_of,
    store, times, widened, width_of,
};

/// Aligned pairs per piece of work: enough to be worth a thread's while.
const STRETCH: usize = 2048;

/// Tiles whose shapes wait in bundles between one loop and the next: few enough for the innermost
/// cache.
const BLOCK: usize = 8;

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
    let extreme = check::<O, T>(a, b)?;
    let work = a
        .chunks(STRETCH)
        .zip(b.chunks(STRETCH))
        .zip(values.chunks_mut(STRETCH))
        .collect();
    spread(
        work,
        |((a, b), values): ((&[A<O, T>], &[B<O, T>]), &mut [T])| {
            let (n, width) = (a.len(), width_of::<T>(extreme));
            let (wide_a, wide_b) = (widened(a, width), widened(b, width));
            let mut wide = wide_a.as_ref().map(|_| vec![T::default(); width]);
            run!(
                extreme,
                aligned_values::<O, T>(
                    wide_a.as_deref().unwrap_or(a),
                    wide_b.as_deref().unwrap_or(b),
                    wide.as_deref_mut().unwrap_or(values),
                )
            );
            if let Some(wide) = wide {
                values.copy_from_slice(&wide[..n]);
            }
        },
    );
    Ok(())
}

#[inline(always)]
fn aligned_values<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    values: &mut [T],
) {
    let tiles = a.len().div_ceil(L::WIDTH);
    let mut shapes = Vec::with_capacity(BLOCK);
    for first in (0..tiles).step_by(BLOCK) {
        bring::<O, T, L>(a, b, first..tiles.min(first + BLOCK), &mut shapes);
        for (k, &(a_tile, b_tile)) in shapes.iter().enumerate() {
            let start = start_of::<T, L>(first + opaque(k), a.len());
            let value = O::value::<L, EXTREME>(O::frame_a(a_tile), O::frame_b(b_tile));
            store::<T, L>(value, &mut values[start..]);
        }
    }
}

/// Some tiles of both lists, in bundles.
#[inline(always)]
fn bring<O: PairOp, T: Real, L: Bundle<T>>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    tiles: std::ops::Range<usize>,
    shapes: &mut Vec<(A<O, L>, B<O, L>)>,
) {
    shapes.clear();
    for tile in tiles {
        let start = start_of::<T, L>(opaque(tile), a.len());
        shapes.push((
            gather::<T, L, _, _>(&a[start..]),
            gather::<T, L, _, _>(&b[start..]),
        ));
    }
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
    let extreme = check::<O, T>(a, b)?;
    if let Seed::Upstream(upstream) = seed {
        check_upstream(upstream)?;
    }
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
    spread(
        work,
        |(((a, b), mut seed), (a_bar, b_bar)): (
            ((&[A<O, T>], &[B<O, T>]), _),
            (&mut [A<O, T>], &mut [B<O, T>]),
        )| {
            let (n, width) = (a.len(), width_of::<T>(extreme));
            let (wide_a, wide_b) = (widened(a, width), widened(b, width));
            let (mut wide_a_bar, mut wide_b_bar) = (wide_a.clone(), wide_b.clone());
            let mut wide = match &seed {
                _ if wide_a.is_none() => Vec::new(),
                Seed::One(_) => vec![T::default(); width],
                Seed::Upstream(upstream) => padded(upstream, width),
            };
            let mut to = match &mut seed {
                Seed::One(_) if wide_a.is_some() => Seed::One(&mut wide),
                Seed::Upstream(_) if wide_a.is_some() => Seed::Upstream(&wide),
                Seed::One(values) => Seed::One(values),
                Seed::Upstream(upstream) => Seed::Upstream(upstream),
            };
            run!(
                extreme,
                aligned_bars::<O, T>(
                    wide_a.as_deref().unwrap_or(a),
                    wide_b.as_deref().unwrap_or(b),
                    &mut to,
                    wide_a_bar.as_deref_mut().unwrap_or(a_bar),
                    wide_b_bar.as_deref_mut().unwrap_or(b_bar),
                )
            );
            if let (Some(wide_a_bar), Some(wide_b_bar)) = (wide_a_bar, wide_b_bar) {
                if let Seed::One(values) = seed {
                    values.copy_from_slice(&wide[..n]);
                }
                a_bar.copy_from_slice(&wide_a_bar[..n]);
                b_bar.copy_from_slice(&wide_b_bar[..n]);
            }
        },
    );
    Ok(())
}

#[inline(always)]
fn aligned_bars<O: PairOp, T: Real, L: Bundle<T>, const EXTREME: bool>(
    a: &[A<O, T>],
    b: &[B<O, T>],
    seed: &mut Seed<'_, T>,
    a_bar: &mut [A<O, T>],
    b_bar: &mut [B<O, T>],
) {
    let tiles = a.len().div_ceil(L::WIDTH);
    let mut shapes = Vec::with_capacity(BLOCK);
    for first in (0..tiles).step_by(BLOCK) {
        bring::<O, T, L>(a, b, first..tiles.min(first + BLOCK), &mut shapes);
        // The slopes take the shapes' place.
        for (k, tile) in shapes.iter_mut().enumerate() {
            let start = start_of::<T, L>(first + opaque(k), a.len());
            let (value, bars) = O::grad::<L, EXTREME>(O::frame_a(tile.0), O::frame_b(tile.1));
            match seed {
                Seed::One(values) => {
                    store::<T, L>(value, &mut values[start..]);
                    *tile = bars;
                }
                Seed::Upstream(upstream) => {
                    let factor = load::<T, L>(&upstream[start..]);
                    *tile = (times(bars.0, factor), times(bars.1, factor));
                }
            }
        }
        for (k, &(a_tile, b_tile)) in shapes.iter().enumerate() {
            let start = start_of::<T, L>(first + opaque(k), a.len());
            scatter::<T, L, _, _>(a_tile, &mut a_bar[start..]);
            scatter::<T, L, _, _>(b_tile, &mut b_bar[start..]);
        }
    }
}
