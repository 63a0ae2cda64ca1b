//! Ragged batches: rings of any number of vertices.
use crate::error::{Argument, Error, Field, finite};
use crate::kernels::cpu::checked::{expect, read_rows, write_rows};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::op::{Op, RingOp};
use crate::kernels::real::Real;
use crate::{Fixed, Vec2};

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
    let mut values = vec![O::Out::<T>::filled(T::default()); offsets.len().saturating_sub(1)];
    ragged_into::<O, T>(vertices, offsets, &mut values)?;
    Ok(values)
}

/// Checks offsets and vertices.
pub(crate) fn check_ragged<T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<(), Error> {
    Simd::current()?;
    if offsets.first() != Some(&0) {
        return Err(Error::Offsets { row: 0 });
    }
    for row in 1..offsets.len() {
        if offsets[row] < offsets[row - 1] || offsets[row] > vertices.len() {
            return Err(Error::Offsets { row });
        }
    }
    if offsets.last() != Some(&vertices.len()) {
        return Err(Error::Offsets {
            row: offsets.len() - 1,
        });
    }
    if (T::kernels().finite_vertices)(vertices) {
        return Ok(());
    }
    for (row, vertex) in vertices.iter().enumerate() {
        finite(vertex.x, Field::X)
            .and_then(|()| finite(vertex.y, Field::Y))
            .map_err(|flaw| Error::Invalid {
                argument: Argument::Vertices,
                row,
                flaw,
            })?;
    }
    Ok(())
}

/// Where to cut a ragged batch: indices of rings, about [`STRETCH`] vertices apart.
fn cuts(offsets: &[usize]) -> Vec<usize> {
    let mut cuts = vec![0];
    let mut start = 0;
    for ring in 1..offsets.len() {
        if offsets[ring] - offsets[start] >= STRETCH || ring - start >= STRETCH {
            cuts.push(ring);
            start = ring;
        }
    }
    if start + 1 < offsets.len() {
        cuts.push(offsets.len() - 1);
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
    check_ragged(vertices, offsets)?;
    expect(Argument::Values, offsets.len() - 1, values.len())?;
    let mut rest = values;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (values, after) = rest.split_at_mut(cut[1] - cut[0]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], values));
    }
    spread(work, |(offsets, values): (&[usize], &mut [O::Out<T>])| {
        let Some(measure) = O::compiled() else {
            return values_of::<O, T>(vertices, offsets, values);
        };
        let mut rows = vec![T::default(); values.len() * O::Out::<T>::LEN];
        (T::kernels().ring_values)(measure, vertices, offsets, &mut rows);
        read_rows(&rows, values);
    });
    Ok(())
}

fn values_of<O: RingOp, T: Real>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    values: &mut [O::Out<T>],
) {
    for (ring, value) in offsets.windows(2).zip(values) {
        *value = O::value(&vertices[ring[0]..ring[1]]);
    }
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
        for &slope in out_bar.to_array().as_ref() {
            finite(slope, Field::Value).map_err(|flaw| Error::Invalid {
                argument: Argument::Upstream,
                row,
                flaw,
            })?;
        }
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
            let mut rows = vec![T::default(); upstream.len() * O::Out::<T>::LEN];
            write_rows(upstream, &mut rows);
            (T::kernels().ring_bars)(measure, vertices, offsets, &rows, bars);
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
