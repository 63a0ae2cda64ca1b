//! Ragged batches: paths of any number of vertices, and kernels for measures of rings.
use crate::error::{Argument, Error, Validate};
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::row::item::rows::numbers;
use crate::ring::Measure;
use crate::{Real, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

/// The number of vertices, or of rings, in a piece of work.
const STRETCH: usize = 2048;

/// Writes the measures of every ring.
pub(crate) fn measured<T: Real>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    out: &mut [T],
) -> Result<(), Error> {
    // Vertices are tested while they are in the cache.
    let measured = |offsets: &[usize], values: &mut [T]| {
        (kernels_in::<T>().ring_values)(measure, vertices, offsets, values)
    };
    match each_piece(offsets, out, measure.fields(), measured) {
        true => Ok(()),
        false => check_vertices(vertices),
    }
}

/// Runs a function on every piece of a ragged batch and its results, of `fields` numbers for each path. Returns `false`
/// if one of the calls does.
pub(crate) fn each_piece<T: Real>(
    offsets: &[usize],
    out: &mut [T],
    fields: usize,
    run: impl Fn(&[usize], &mut [T]) -> bool + Sync + Send,
) -> bool {
    let paths = offsets.len() - 1;
    if paths <= STRETCH && offsets[paths] - offsets[0] <= STRETCH {
        // A list of one piece would take as long as its few paths.
        return run(offsets, out);
    }
    let (mut rest, mut work) = (out, Vec::new());
    for cut in cuts(offsets).windows(2) {
        let (values, after) = rest.split_at_mut((cut[1] - cut[0]) * fields);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], values));
    }
    let sound = AtomicBool::new(true);
    in_parallel(work, |(offsets, values): (&[usize], &mut [T])| {
        if !run(offsets, values) {
            sound.store(false, Ordering::Relaxed);
        }
    });
    sound.into_inner()
}

/// Writes the cotangents of vertices from the results' cotangents. Offsets were checked.
pub(crate) fn measured_vjp<T: Real>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[T],
    bars: &mut [Vec2<T>],
) -> Result<(), Error> {
    check_finite(vertices)?;
    check_upstream(upstream, measure.fields())?;
    let mut rest = bars;
    let mut work = Vec::new();
    for cut in cuts(offsets).windows(2) {
        let own = cut[0] * measure.fields()..cut[1] * measure.fields();
        let (bars, after) = rest.split_at_mut(offsets[cut[1]] - offsets[cut[0]]);
        rest = after;
        work.push((&offsets[cut[0]..=cut[1]], &upstream[own], bars));
    }
    in_parallel(
        work,
        |(offsets, upstream, bars): (&[usize], &[T], &mut [Vec2<T>])| {
            (kernels_in::<T>().ring_bars)(measure, vertices, offsets, upstream, bars);
        },
    );
    Ok(())
}

/// Checks offsets and vertices.
pub(crate) fn check_ragged<T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<(), Error> {
    check_offsets::<T>(vertices.len(), offsets)?;
    check_finite(vertices)
}

fn check_finite<T: Real>(vertices: &[Vec2<T>]) -> Result<(), Error> {
    match (kernels_in::<T>().all_finite)(&numbers(vertices)) {
        true => Ok(()),
        false => check_vertices(vertices),
    }
}

/// Checks the offsets of a list of `vertices` vertices.
pub(crate) fn check_offsets<T: Real>(vertices: usize, offsets: &[usize]) -> Result<(), Error> {
    Simd::current()?;
    if offsets.first() != Some(&0) {
        return Err(Error::Offsets { item: 0 });
    }
    if !(kernels_in::<T>().never_decreases)(offsets, vertices) {
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

/// Returns the cuts of a ragged batch: indices of rings, [`STRETCH`] vertices or rings apart.
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
