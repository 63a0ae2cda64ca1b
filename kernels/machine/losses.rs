//! Forms of all pairs over numbers, for the calls by types and by name.
use super::column::Column;
use super::primitives::{Engine, Seed};
use super::results::{Reduced, Reduction};
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::recording::Call;
use crate::kernels::row::item::counts::{entries, expect};

/// Checks a reduction and reduces all pairs.
pub(crate) fn reduced<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    reduction: Reduction<T>,
) -> Result<Reduced<T>, Error> {
    reduction.check(lists[0].len(), lists[1].len())?;
    engine.reduce(call, lists, reduction)
}

/// Returns the number of pairs.
fn pairs_of<T: Real>(lists: &[Column<'_, T>; 2]) -> f64 {
    lists[0].len() as f64 * lists[1].len() as f64
}

/// Returns the mean of all results; zero without pairs.
pub(crate) fn mean<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
) -> Result<f64, Error> {
    let sum = reduced(engine, call, lists, Reduction::Sum)?.sum();
    Ok(sum / pairs_of(lists).max(1.0))
}

/// Writes the cotangents of both lists, with the codes of their shapes. Returns the sum of all results if one factor is
/// the seed of all pairs, otherwise 0.
pub(crate) fn pull_into<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    seed: &Seed<'_, T>,
    bars: [&mut [T]; 2],
) -> Result<f64, Error> {
    if let Seed::Numbers(numbers) = seed {
        let wanted = entries(lists[0].len(), lists[1].len(), 1)?;
        expect(Argument::Upstream, wanted, numbers.len())?;
    }
    let [a_bar, b_bar] = bars;
    let sum = engine.pull_back(call, lists, seed, [&mut *a_bar, &mut *b_bar])?;
    let takes = call.recording.takes.iter();
    for ((list, bar), leaf) in lists.iter().zip([a_bar, b_bar]).zip(takes) {
        if leaf.codes == 0 {
            continue;
        }
        let (shapes, scalars) = (list.all(), leaf.fields - leaf.codes);
        let bars = bar.chunks_exact_mut(leaf.fields);
        for (bar, shape) in bars.zip(shapes.chunks_exact(leaf.fields)) {
            bar[scalars..].copy_from_slice(&shape[scalars..]);
        }
    }
    Ok(sum)
}

/// Returns the sum as [`pull_into`] does, and the cotangents of both lists.
pub(crate) fn pulled<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    seed: &Seed<'_, T>,
) -> Result<(f64, [Vec<T>; 2]), Error> {
    let room = |list: &Column<'_, T>| vec![T::default(); list.len() * list.fields];
    let mut bars = lists.each_ref().map(room);
    let places = bars.each_mut().map(Vec::as_mut_slice);
    let sum = pull_into(engine, call, lists, seed, places)?;
    Ok((sum, bars))
}

/// Returns the mean of all results and its derivatives by both lists; zero without pairs.
pub(crate) fn mean_pulled<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
) -> Result<(f64, [Vec<T>; 2]), Error> {
    let factor = 1.0 / pairs_of(lists).max(1.0);
    let (sum, bars) = pulled(engine, call, lists, &Seed::Factor(T::lit(factor)))?;
    Ok((sum * factor, bars))
}
