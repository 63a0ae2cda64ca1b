//! Ragged batches: paths of any number of vertices, and the measures of rings by kernels of their own.
use crate::error::{Argument, Error, Validate};
use crate::kernels::One;
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check_upstream, expect, numbers};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::fold::Fold;
use crate::kernels::item::Item;
use crate::kernels::real::Real;
use crate::ring::Measure;
use crate::{Fixed, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

/// Vertices, or rings, per piece of work.
const STRETCH: usize = 2048;

impl Cpu {
    /// One result per path of a fold that takes nothing else: [`fold`](Cpu::fold) without contexts. Path i has the
    /// vertices `offsets[i]..offsets[i + 1]`; there is one offset more than there are paths, from 0 to the number of
    /// vertices. Empty paths are valid.
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
    /// assert_eq!(Cpu::new().ragged(SignedArea.over_ring(), &vertices, &[0, 3, 6])?, [6.0, -0.5]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged<F, V: Fixed<Scalar: Real + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        self.fold(fold, One([]), vertices, offsets)
    }

    /// [`ragged`](Cpu::ragged) into the caller's buffer.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Cpu::ragged), and [`Error::Length`] for a buffer of another length. The buffer is then as it
    /// was.
    pub fn ragged_into<F, V: Fixed<Scalar: Real + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
        values: &mut [F::Out<V::Scalar>],
    ) -> Result<(), Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        let all = self.ragged(fold, vertices, offsets)?;
        expect(Argument::Values, all.len(), values.len())?;
        values.copy_from_slice(&all);
        Ok(())
    }

    /// The adjoint of [`ragged`](Cpu::ragged) for one cotangent per result: one cotangent per vertex.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Cpu::ragged), and for cotangents of another number or that are not finite.
    ///
    /// ```
    /// use geograd::Vec2;
    /// use geograd::kernels::{Cpu, SignedArea};
    /// let v = |x, y| Vec2::new(x, y);
    /// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0)];
    /// let bars = Cpu::new().ragged_vjp(SignedArea.over_ring(), &vertices, &[0, 3], &[1.0])?;
    /// assert_eq!(bars, [v(-1.5, -2.0), v(1.5, 0.0), v(0.0, 2.0)]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged_vjp<F, V: Fixed<Scalar: Real + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<Vec<V>, Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        let (_, bars) = self.fold_vjp(fold, One([]), vertices, offsets, upstream)?;
        Ok(bars)
    }

    /// [`ragged_vjp`](Cpu::ragged_vjp) into the caller's buffer.
    ///
    /// # Errors
    ///
    /// As [`ragged_vjp`](Cpu::ragged_vjp), and [`Error::Length`] for a buffer of another length. The buffer is then as
    /// it was.
    pub fn ragged_vjp_into<F, V: Fixed<Scalar: Real + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
        bars: &mut [V],
    ) -> Result<(), Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        if let Some(measure) = F::MEASURE {
            expect(Argument::GradVertices, vertices.len(), bars.len())?;
            let (given, bars) = (numbers(upstream), F::in_plane_mut(bars));
            let given = (upstream.len(), &*given);
            return measured_vjp(measure, F::in_plane(vertices), offsets, given, bars);
        }
        let all = self.ragged_vjp(fold, vertices, offsets, upstream)?;
        expect(Argument::GradVertices, all.len(), bars.len())?;
        bars.copy_from_slice(&all);
        Ok(())
    }
}

/// Measures every ring into numbers of results.
pub(crate) fn measured<T: Real>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    out: &mut [T],
) -> Result<(), Error> {
    let mut rest = out;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let (values, after) = rest.split_at_mut((cut[1] - cut[0]) * measure.fields());
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], values));
    }
    // Vertices are looked at while they are at hand.
    let sound = AtomicBool::new(true);
    spread(work, |(offsets, values): (&[usize], &mut [T])| {
        if !(T::kernels().ring_values)(measure, vertices, offsets, values) {
            sound.store(false, Ordering::Relaxed);
        }
    });
    match sound.into_inner() {
        true => Ok(()),
        false => check_vertices(vertices),
    }
}

/// The cotangents of vertices, for the numbers of those of so many results.
pub(crate) fn measured_vjp<T: Real>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    (results, upstream): (usize, &[T]),
    bars: &mut [Vec2<T>],
) -> Result<(), Error> {
    check_ragged(vertices, offsets)?;
    expect(Argument::Upstream, offsets.len() - 1, results)?;
    check_upstream(upstream, measure.fields())?;
    let mut rest = bars;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let own = cut[0] * measure.fields()..cut[1] * measure.fields();
        let (bars, after) = rest.split_at_mut(offsets[cut[1]] - offsets[cut[0]]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], &upstream[own], bars));
    }
    spread(
        work,
        |(offsets, upstream, bars): (&[usize], &[T], &mut [Vec2<T>])| {
            (T::kernels().ring_bars)(measure, vertices, offsets, upstream, bars);
        },
    );
    Ok(())
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
