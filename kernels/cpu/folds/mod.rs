//! Folds over ragged lists of paths: a program computes all edges in parallel, then the states of each path are joined
//! in order.
mod edge_states;
mod near_edges;
pub(crate) mod paths;
mod point_values;

use crate::kernels::call::folding::{Folding, Sizes, backwards};
use crate::kernels::cpu::checked::{check_argument, check_upstream};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::plan::{Preparation, name};
use crate::kernels::cpu::polylines::lengths;
use crate::kernels::cpu::ragged::check_offsets;
use crate::kernels::cpu::stretches::{self, Aligned};
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::{Input, PathSpans};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{STRETCH, Target};
use crate::{Error, Real};
use edge_states::{finished, plan, states};
use paths::{first_flaw, paths, told};
use point_values::point_values;
use std::ops::Range;

/// Writes the numbers of the result of every path.
pub fn values<T: Real>(
    folding: &Folding<T>,
    input: &Input<'_, T>,
    out: &mut [T],
) -> Result<(), Error> {
    if folding.sizes.is_length {
        check_spans(input)?;
        let ends = [0, input.plane.len()];
        return match lengths(input.plane, input.spans.offsets(&ends), out) {
            true => Ok(()),
            false => Err(first_flaw(folding, &input.vertices)),
        };
    }
    check(folding, input)?;
    let (sizes, programs) = (&folding.sizes, (folding.programs)()?);
    if sizes.winding.is_some() {
        out.copy_from_slice(&point_values(folding, &programs, input)?);
        return Ok(());
    }
    let paths = paths(folding, input)?;
    let states = states(sizes, &programs, &paths)?;
    let work = out
        .chunks_mut(STRETCH * sizes.out.max(1))
        .enumerate()
        .collect();
    in_parallel(work, |(i, out): (usize, &mut [T])| {
        finished(folding, &paths, &states, i * STRETCH, out);
    });
    Ok(())
}

/// Returns the cotangents of every context and every vertex from the results' cotangents.
pub fn cotangents<T: Real>(
    folding: &Folding<T>,
    input: &Input<'_, T>,
    upstream: &[T],
) -> Result<(Vec<T>, Vec<T>), Error> {
    check(folding, input)?;
    let (sizes, programs) = (&folding.sizes, (folding.programs)()?);
    let results = input.spans.count();
    check_upstream(upstream, sizes.out.max(1))?;
    let paths = paths(folding, input)?;
    let states = states(sizes, &programs, &paths)?;
    // The adjoint of the last step: from results to the states of every edge.
    let Sizes {
        own,
        wide,
        state,
        element,
        ..
    } = *sizes;
    let mut context_bars = vec![T::default(); results * own];
    let mut state_bars = vec![T::default(); states.len()];
    let mut work = Vec::new();
    let (mut rest, mut contexts) = (&mut state_bars[..], &mut context_bars[..]);
    for first in (0..results).step_by(STRETCH) {
        let end = results.min(first + STRETCH);
        let edges = paths.starts[end] - paths.starts[first];
        let (some, after) = rest.split_at_mut(edges * state);
        let (bars, later) = contexts.split_at_mut((end - first) * own);
        (rest, contexts) = (after, later);
        work.push((first..end, bars, some));
    }
    type Work<'a, T> = (Range<usize>, &'a mut [T], &'a mut [T]);
    in_parallel(work, |(some, context_bars, state_bars): Work<'_, T>| {
        let mut at = 0;
        for (k, path) in some.enumerate() {
            let shared = &paths.shared[path * wide..][..wide];
            let told = told(sizes, &paths, &states, path);
            let before = (folding.before)(told);
            let out_bar = &upstream[path * sizes.out..][..sizes.out];
            let winding = paths.windings[path];
            let (bar, bars) =
                backwards(sizes, &programs, shared, [told, &before], winding, out_bar);
            context_bars[k * own..][..own].copy_from_slice(&bar[..own]);
            state_bars[at..at + bars.len()].copy_from_slice(&bars);
            at += bars.len();
        }
    });
    // The adjoint of the body: from states to the ends of every edge.
    let body = plan(sizes, &programs, Mode::Vjp)?;
    let count = paths.edges.len();
    let mut shared_bars = vec![T::default(); count * wide];
    let mut end_bars = vec![T::default(); count * 2 * element];
    let columns = paths.columns(wide, Some((&state_bars, state)));
    let ends = Target::of_rows(&mut end_bars, 2 * element);
    let mut targets = vec![Some(ends)];
    if wide > 0 {
        targets.insert(0, Some(Target::of_rows(&mut shared_bars, wide)));
    }
    stretches::compute(Aligned {
        unchecked: false,
        plan: &body,
        columns: &columns,
        rare: false,
        count,
        targets,
    });
    let mut path_bars = vec![T::default(); input.vertices.len()];
    let add = |sums: &mut [T], bars: &[T]| {
        for (sum, &x) in sums.iter_mut().zip(bars) {
            *sum += x;
        }
    };
    let ends = end_bars.chunks_exact((2 * element).max(1));
    for (k, (&(path, from, to), bar)) in paths.edges.iter().zip(ends).enumerate() {
        for (end, bar) in [from, to].into_iter().zip(bar.chunks_exact(element)) {
            add(&mut path_bars[end as usize * element..][..element], bar);
        }
        let context = &mut context_bars[path as usize * own..][..own];
        add(context, &shared_bars[k * wide..][..own]);
    }
    for bar in &mut path_bars {
        *bar = bar.canonical();
    }
    Ok((context_bars, path_bars))
}

/// Returns the preparation of every argument of contexts: they are checked only.
fn preparations<T: Real>(folding: &Folding<T>) -> Vec<Preparation<T>> {
    let mut all: Vec<_> = (folding.leaves)()
        .into_iter()
        .map(Preparation::plain)
        .collect();
    name(&mut all, folding.arguments);
    all
}

/// Checks offsets, paths and their contexts. Vertices are checked by the caller, which reads them all anyway.
pub(crate) fn check<T: Real>(folding: &Folding<T>, input: &Input<'_, T>) -> Result<(), Error> {
    check_spans(input)?;
    let (spans, winding) = (input.spans, folding.sizes.winding);
    if winding.is_none() && !(kernels_in::<T>().all_finite)(&input.vertices) {
        return Err(first_flaw(folding, &input.vertices));
    }
    let edges = match spans {
        PathSpans::Shared(paths, length) if winding.is_none() => paths.saturating_mul(length),
        _ => input.vertices.len() / folding.sizes.element.max(1),
    };
    if edges.max(spans.count()) >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    let plans = preparations(folding);
    for (k, column) in input.contexts.iter().enumerate() {
        if let Some(found) = column.count {
            expect(plans[k].argument(k), spans.count(), found)?;
        }
        check_argument(k, &plans, column)?;
    }
    Ok(())
}

/// Checks the offsets of paths.
pub(crate) fn check_spans<T: Real>(input: &Input<'_, T>) -> Result<(), Error> {
    check_offsets::<T>(input.count, input.spans.offsets(&[0, input.count]))
}
