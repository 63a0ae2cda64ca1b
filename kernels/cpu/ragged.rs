//! Ragged batches: rings of any number of vertices.
use crate::error::{Argument, Error, Validate};
use crate::kernels::cpu::checked::{expect, fill, numbers};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::op::{Op, RingOp};
use crate::kernels::real::Real;
use crate::{Fixed, Pack, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

/// Vertices, or rings, per piece of work.
const STRETCH: usize = 2048;

/// One result per ring. Ring i has the vertices `offsets[i]..offsets[i + 1]`; there is one offset
/// more than there are rings, from 0 to the number of vertices. Empty rings are valid.
///
/// # Errors
///
/// [`Error::Offsets`] for offsets that decrease or do not cover the vertices, [`Error::Invalid`]
/// for a vertex that is not finite.
///
/// ```
/// use geograd::Vec2;
/// use geograd::kernels::{cpu, ring::SignedArea};
/// let v = |x, y| Vec2::new(x, y);
/// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0), v(0.0, 0.0), v(0.0, 1.0), v(1.0, 0.0)];
/// assert_eq!(cpu::ragged::<SignedArea, f64>(&vertices, &[0, 3, 6])?, [6.0, -0.5]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn ragged<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
) -> Result<Vec<O::Out<T>>, Error> {
    check_offsets::<T>(vertices.len(), offsets)?;
    let mut all = vec![O::Out::<T>::filled(T::default()); offsets.len() - 1];
    let mut rest = &mut all[..];
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (values, after) = rest.split_at_mut(cut[1] - cut[0]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], values));
    }
    // Vertices are looked at while they are at hand.
    let sound = AtomicBool::new(true);
    spread(work, |(offsets, values): (&[usize], &mut [O::Out<T>])| {
        let own = &vertices[offsets[0]..offsets[offsets.len() - 1]];
        if !(T::kernels().all_finite)(&numbers(own)) {
            sound.store(false, Ordering::Relaxed);
            return;
        }
        match O::compiled() {
            Some(measure) => fill(values, |values| {
                (T::kernels().ring_values)(measure, vertices, offsets, values);
            }),
            None => {
                for (ring, value) in offsets.windows(2).zip(values) {
                    *value = O::value(&vertices[ring[0]..ring[1]]);
                }
            }
        }
    });
    match sound.into_inner() {
        true => Ok(all),
        false => check_vertices(vertices).map(|()| all),
    }
}

/// Checks offsets and vertices.
pub(crate) fn check_ragged<T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<(), Error> {
    check_offsets::<T>(vertices.len(), offsets)?;
    match (T::kernels().all_finite)(&numbers(vertices)) {
        true => Ok(()),
        false => check_vertices(vertices),
    }
}

/// Checks offsets of so many vertices.
fn check_offsets<T: Real>(vertices: usize, offsets: &[usize]) -> Result<(), Error> {
    Simd::current()?;
    if offsets.first() != Some(&0) {
        return Err(Error::Offsets { row: 0 });
    }
    if !(T::kernels().never_decreases)(offsets, vertices) {
        for row in 1..offsets.len() {
            if offsets[row] < offsets[row - 1] || offsets[row] > vertices {
                return Err(Error::Offsets { row });
            }
        }
    }
    match offsets.last() == Some(&vertices) {
        true => Ok(()),
        false => Err(Error::Offsets {
            row: offsets.len() - 1,
        }),
    }
}

/// Finds the first vertex that is not finite.
fn check_vertices<T: Real>(vertices: &[Vec2<T>]) -> Result<(), Error> {
    for (row, vertex) in vertices.iter().enumerate() {
        vertex.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Vertices,
            row,
            flaw,
        })?;
    }
    Ok(())
}

/// Where to cut a ragged batch: indices of rings, about [`STRETCH`] vertices or rings apart.
fn cuts(offsets: &[usize]) -> Vec<usize> {
    let rings = offsets.len() - 1;
    let mut cuts = vec![0];
    let mut start = 0;
    while start < rings {
        let rest = &offsets[start + 1..=rings.min(start + STRETCH)];
        let near = rest.partition_point(|&end| end - offsets[start] < STRETCH);
        start += rest.len().min(near + 1);
        cuts.push(start);
    }
    cuts
}

/// [`ragged`] into the caller's buffer.
///
/// # Errors
///
/// As [`ragged`], and [`Error::Length`] for a buffer of another length. The buffer is then as it
/// was.
pub fn ragged_into<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    values: &mut [O::Out<T>],
) -> Result<(), Error> {
    let all = ragged::<O, T>(vertices, offsets)?;
    expect(Argument::Values, all.len(), values.len())?;
    values.copy_from_slice(&all);
    Ok(())
}

/// Results and slopes of a ragged batch.
pub type RaggedGrads<O, T> = (Vec<<O as Op>::Out<T>>, Vec<Vec2<T>>);

/// [`ragged`] with the adjoint for the given upstream, one slope per result: results, and one
/// cotangent per vertex.
///
/// # Errors
///
/// As [`ragged`], and for an upstream of another length or one that is not finite.
pub fn ragged_grad<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
) -> Result<RaggedGrads<O, T>, Error> {
    Ok((
        ragged::<O, T>(vertices, offsets)?,
        ragged_vjp::<O, T>(vertices, offsets, upstream)?,
    ))
}

/// The adjoint of [`ragged`]: one cotangent per vertex.
///
/// # Errors
///
/// As [`ragged`], and for an upstream of another length or one that is not finite.
///
/// ```
/// use geograd::Vec2;
/// use geograd::kernels::{cpu, ring::SignedArea};
/// let v = |x, y| Vec2::new(x, y);
/// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0)];
/// let bars = cpu::ragged_vjp::<SignedArea, f64>(&vertices, &[0, 3], &[1.0])?;
/// assert_eq!(bars, [v(-1.5, -2.0), v(1.5, 0.0), v(0.0, 2.0)]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn ragged_vjp<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
) -> Result<Vec<Vec2<T>>, Error> {
    let mut bars = vec![Vec2::new(T::default(), T::default()); vertices.len()];
    ragged_vjp_into::<O, T>(vertices, offsets, upstream, &mut bars)?;
    Ok(bars)
}

/// [`ragged_vjp`] into the caller's buffer.
///
/// # Errors
///
/// As [`ragged_vjp`], and [`Error::Length`] for a buffer of another length. The buffer is then as
/// it was.
pub fn ragged_vjp_into<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
    bars: &mut [Vec2<T>],
) -> Result<(), Error> {
    check_ragged(vertices, offsets)?;
    expect(Argument::Upstream, offsets.len() - 1, upstream.len())?;
    expect(Argument::GradVertices, vertices.len(), bars.len())?;
    for (row, out_bar) in upstream.iter().enumerate() {
        let mut valid = Ok(());
        out_bar.map(&mut |slope| valid = valid.and_then(|()| slope.validate()));
        valid.map_err(|flaw| Error::Invalid {
            argument: Argument::Upstream,
            row,
            flaw,
        })?;
    }
    let mut rest = bars;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (bars, after) = rest.split_at_mut(offsets[cut[1]] - offsets[cut[0]]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], &upstream[cut[0]..cut[1]], bars));
    }
    spread(
        work,
        |(offsets, upstream, bars): (&[usize], &[O::Out<T>], &mut [Vec2<T>])| {
            let Some(measure) = O::compiled() else {
                return bars_of::<O, T>(vertices, offsets, upstream, bars);
            };
            let upstream = numbers(upstream);
            (T::kernels().ring_bars)(measure, vertices, offsets, &upstream, bars);
        },
    );
    Ok(())
}

fn bars_of<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[O::Out<T>],
    bars: &mut [Vec2<T>],
) {
    for (ring, &out_bar) in offsets.windows(2).zip(upstream) {
        let bars = &mut bars[ring[0] - offsets[0]..ring[1] - offsets[0]];
        O::ring_vjp(&vertices[ring[0]..ring[1]], out_bar, bars);
    }
}
