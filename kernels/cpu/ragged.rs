//! Ragged batches: rings of any number of vertices.
use crate::error::{Argument, Error, Validate};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{expect, fill, numbers};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::op::RingOp;
use crate::kernels::real::Real;
use crate::{Fixed, Pack, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

/// Vertices, or rings, per piece of work.
const STRETCH: usize = 2048;

impl Cpu {
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
    /// use geograd::kernels::{Cpu, SignedArea};
    /// let v = |x, y| Vec2::new(x, y);
    /// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0), v(0.0, 0.0), v(0.0, 1.0), v(1.0, 0.0)];
    /// assert_eq!(Cpu::new().ragged(SignedArea, &vertices, &[0, 3, 6])?, [6.0, -0.5]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged<T: Real, O: RingOp>(
        &self,
        _ring: O,
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
            let done = match O::compiled() {
                Some(measure) => fill(values, |values| {
                    (T::kernels().ring_values)(measure, vertices, offsets, values)
                }),
                None => {
                    let finite = (T::kernels().all_finite)(&numbers(own));
                    if finite {
                        for (ring, value) in offsets.windows(2).zip(values) {
                            *value = O::value(&vertices[ring[0]..ring[1]]);
                        }
                    }
                    finite
                }
            };
            if !done {
                sound.store(false, Ordering::Relaxed);
            }
        });
        match sound.into_inner() {
            true => Ok(all),
            false => check_vertices(vertices).map(|()| all),
        }
    }

    /// [`ragged`](Cpu::ragged) into the caller's buffer.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Cpu::ragged), and [`Error::Length`] for a buffer of another length. The buffer is then as it
    /// was.
    pub fn ragged_into<T: Real, O: RingOp>(
        &self,
        ring: O,
        vertices: &[Vec2<T>],
        offsets: &[usize],
        values: &mut [O::Out<T>],
    ) -> Result<(), Error> {
        let all = self.ragged(ring, vertices, offsets)?;
        expect(Argument::Values, all.len(), values.len())?;
        values.copy_from_slice(&all);
        Ok(())
    }

    /// [`ragged`](Cpu::ragged) with the adjoint for the given upstream, one derivative per result: results, and one
    /// cotangent per vertex.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Cpu::ragged), and for an upstream of another length or one that is not finite.
    pub fn ragged_grad<T: Real, O: RingOp>(
        &self,
        ring: O,
        vertices: &[Vec2<T>],
        offsets: &[usize],
        upstream: &[O::Out<T>],
    ) -> Result<(Vec<O::Out<T>>, Vec<Vec2<T>>), Error> {
        Ok((
            self.ragged(ring, vertices, offsets)?,
            self.ragged_vjp(ring, vertices, offsets, upstream)?,
        ))
    }

    /// The adjoint of [`ragged`](Cpu::ragged): one cotangent per vertex.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Cpu::ragged), and for an upstream of another length or one that is not finite.
    ///
    /// ```
    /// use geograd::Vec2;
    /// use geograd::kernels::{Cpu, SignedArea};
    /// let v = |x, y| Vec2::new(x, y);
    /// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0)];
    /// let bars = Cpu::new().ragged_vjp(SignedArea, &vertices, &[0, 3], &[1.0])?;
    /// assert_eq!(bars, [v(-1.5, -2.0), v(1.5, 0.0), v(0.0, 2.0)]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged_vjp<T: Real, O: RingOp>(
        &self,
        ring: O,
        vertices: &[Vec2<T>],
        offsets: &[usize],
        upstream: &[O::Out<T>],
    ) -> Result<Vec<Vec2<T>>, Error> {
        let mut bars = vec![Vec2::new(T::default(), T::default()); vertices.len()];
        self.ragged_vjp_into(ring, vertices, offsets, upstream, &mut bars)?;
        Ok(bars)
    }

    /// [`ragged_vjp`](Cpu::ragged_vjp) into the caller's buffer.
    ///
    /// # Errors
    ///
    /// As [`ragged_vjp`](Cpu::ragged_vjp), and [`Error::Length`] for a buffer of another length. The buffer is then as
    /// it was.
    pub fn ragged_vjp_into<T: Real, O: RingOp>(
        &self,
        ring: O,
        vertices: &[Vec2<T>],
        offsets: &[usize],
        upstream: &[O::Out<T>],
        bars: &mut [Vec2<T>],
    ) -> Result<(), Error> {
        check_ragged(vertices, offsets)?;
        expect(Argument::Upstream, offsets.len() - 1, upstream.len())?;
        expect(Argument::GradVertices, vertices.len(), bars.len())?;
        for (row, out_bar) in upstream.iter().enumerate() {
            for derivative in out_bar.scalars() {
                derivative.validate().map_err(|flaw| Error::Invalid {
                    argument: Argument::Upstream,
                    item: row,
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
                    return bars_of(ring, vertices, offsets, upstream, bars);
                };
                let upstream = numbers(upstream);
                (T::kernels().ring_bars)(measure, vertices, offsets, &upstream, bars);
            },
        );
        Ok(())
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
pub(crate) fn check_offsets<T: Real>(vertices: usize, offsets: &[usize]) -> Result<(), Error> {
    Simd::current()?;
    if offsets.first() != Some(&0) {
        return Err(Error::Offsets { item: 0 });
    }
    if !(T::kernels().never_decreases)(offsets, vertices) {
        for row in 1..offsets.len() {
            if offsets[row] < offsets[row - 1] || offsets[row] > vertices {
                return Err(Error::Offsets { item: row });
            }
        }
    }
    match offsets.last() == Some(&vertices) {
        true => Ok(()),
        false => Err(Error::Offsets {
            item: offsets.len() - 1,
        }),
    }
}

/// Finds the first vertex that is not finite.
pub(crate) fn check_vertices<T: Real>(vertices: &[Vec2<T>]) -> Result<(), Error> {
    for (row, vertex) in vertices.iter().enumerate() {
        vertex.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Vertices,
            item: row,
            flaw,
        })?;
    }
    Ok(())
}

/// The cuts of a ragged batch: indices of rings, about [`STRETCH`] vertices or rings apart.
pub(crate) fn cuts(offsets: &[usize]) -> Vec<usize> {
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

fn bars_of<T: Real, O: RingOp>(
    _ring: O,
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
