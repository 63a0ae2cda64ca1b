//! Results of points and paths, piece by piece: the numbers of a piece stay in the cache from the search to the result.
use super::edge_states::{finished, states};
use super::near_edges::NearSearch;
use super::paths::{Paths, first_flaw};
use crate::kernels::call::folding::{FoldPrograms, Folding};
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::{Column, Input};
use crate::{Error, Fixed, Real, Vec2};
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The numbers of a point.
const POINT: usize = 2;

/// Returns the numbers of the result of every path, for a fold whose context is a point. The input was checked, but for
/// vertices.
pub(super) fn point_values<T: Real>(
    folding: &Folding<T>,
    programs: &FoldPrograms,
    input: &Input<'_, T>,
) -> Result<Vec<T>, Error> {
    let flaw = || first_flaw(folding, &input.vertices);
    let search = NearSearch::new(&folding.sizes, input.plane, input.spans).ok_or_else(flaw)?;
    let mut out = vec![T::default(); input.spans.count() * folding.sizes.out];
    let (mut rest, mut work) = (&mut out[..], Vec::new());
    for cut in search.cuts().windows(2) {
        let (own, after) = rest.split_at_mut((cut[1] - cut[0]) * folding.sizes.out);
        rest = after;
        work.push((cut[0]..cut[1], own));
    }
    let (vertices, contexts, spans) = (&*input.vertices, &input.contexts[..], input.spans);
    let (failed, sound) = (OnceLock::new(), AtomicBool::new(true));
    in_parallel(work, |(paths, out): (Range<usize>, &mut [T])| {
        let points = points_of(contexts, paths.clone());
        let places: Vec<Vec2<T>> = points.chunks_exact(POINT).map(Vec2::load).collect();
        let found = search.piece(&places, paths.clone());
        if found.unsound {
            sound.store(false, Ordering::Relaxed);
        } else if folding.sizes.is_winding && found.edges.is_empty() {
            // A certain winding number is the result.
            for (out, (_, winding)) in out.iter_mut().zip(found.counts) {
                *out = winding.unwrap_or_default().canonical();
            }
        } else {
            let paths = Paths::of_found(vertices, paths.start, spans, &points, found);
            match states(&folding.sizes, programs, &paths) {
                Ok(states) => finished(folding, &paths, &states, 0, out),
                // One of several errors is enough.
                Err(error) => drop(failed.set(error)),
            }
        }
    });
    if !sound.into_inner() {
        return Err(flaw());
    }
    failed.into_inner().map_or(Ok(out), Err)
}

/// Returns the numbers of the points of some paths.
fn points_of<T: Real>(contexts: &[Column<'_, T>], paths: Range<usize>) -> Vec<T> {
    let (mut points, mut room) = (Vec::with_capacity(POINT * paths.len()), Vec::new());
    if let [column] = contexts
        && column.count.is_some()
    {
        points.extend_from_slice(column.numbers(paths, &mut room));
        return points;
    }
    for path in paths {
        for column in contexts {
            points.extend_from_slice(column.numbers(path..path + 1, &mut room));
        }
    }
    points
}
