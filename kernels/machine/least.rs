//! The least results of all pairs: the nearest shape of every shape, the nearest pair, and the pairs below a limit.
use super::found::check_sides;
use super::primitives::{Engine, Items, try_then_check};
use super::results::GroupedReduction;
use super::{Best, Column, FOREIGN, Found, GroupSpans, Groups, Least, LeastPairs};
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::recording::Call;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::Target;
use crate::kernels::row::item::counts::{check_finite, expect};

/// Searches by the largest of the negated function, for engines without a search of their own. Of ties the first pair
/// alone is found.
pub(crate) fn by_negation<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    groups: GroupSpans<'_>,
    wanted: Least<T>,
) -> Result<LeastPairs<T>, Error> {
    let negated = call.negated()?;
    let of_rows = !matches!(wanted, Least::Columns(_));
    let reduction = match wanted {
        Least::Below(limit) => GroupedReduction::Above(-limit),
        _ => GroupedReduction::Best { of_rows },
    };
    let found = engine.reduce_grouped(&negated, lists, groups, reduction)?;
    if let Least::Below(_) = wanted {
        let mut pairs = found.founds().taken()?;
        for pair in &mut pairs {
            pair.value = (-pair.value).canonical();
        }
        return Ok(LeastPairs {
            pairs,
            best: Vec::new(),
        });
    }
    let of = |(own, best): (usize, Option<Best<T>>)| {
        let Best { value, index } = best?;
        let value = (-value).canonical();
        let (row, column) = if of_rows { (own, index) } else { (index, own) };
        let is_near = value.at_most(wanted.cap()) && value.below(T::lit(f64::INFINITY));
        is_near.then_some(Found { row, column, value })
    };
    let mut best: Vec<_> = found
        .bests_grouped()
        .into_iter()
        .enumerate()
        .map(of)
        .collect();
    if let Least::Groups(_) = wanted {
        let of_group = |group| {
            let all = best[groups.rows(group)].iter().flatten().copied();
            all.reduce(|a, b| if b.value.below(a.value) { b } else { a })
        };
        best = (0..groups.count()).map(of_group).collect();
    }
    let pairs = best.iter().flatten().copied().collect();
    Ok(LeastPairs { best, pairs })
}

/// Returns the groups of two lists without groups: one with everything.
fn whole<T: Real>(lists: &[Column<'_, T>; 2]) -> [[usize; 2]; 2] {
    lists.each_ref().map(|list| [0, list.len()])
}

/// Checks a search over whole lists and runs it.
pub(crate) fn least_of<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    wanted: Least<T>,
) -> Result<LeastPairs<T>, Error> {
    wanted.check()?;
    let [a, b] = &whole(lists);
    engine.least(call, lists, GroupSpans { a, b }, wanted, false)
}

/// Checks a search within groups and runs it.
pub(crate) fn least_grouped<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    groups: Groups<'_>,
    wanted: Least<T>,
) -> Result<LeastPairs<T>, Error> {
    wanted.check()?;
    let spans = groups.spans(lists.each_ref().map(Column::len))?;
    engine.least(call, lists, spans, wanted, false)
}

/// Returns the least of every row or column without a cap. One without finite results has infinity, at index 0.
pub(crate) fn least_of_all<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    of_rows: bool,
) -> Result<Vec<Best<T>>, Error> {
    check_sides(lists[0].len(), lists[1].len(), of_rows)?;
    let infinite = T::lit(f64::INFINITY);
    let nothing = Best {
        value: infinite,
        index: 0,
    };
    let wanted = side(of_rows, infinite);
    let found = least_of(engine, call, lists, wanted)?;
    let of = |best| best_of(best, of_rows).unwrap_or(nothing);
    Ok(found.best.into_iter().map(of).collect())
}

/// Returns the search for the least of rows or of columns.
pub(crate) fn side<T>(of_rows: bool, cap: T) -> Least<T> {
    match of_rows {
        true => Least::Rows(cap),
        false => Least::Columns(cap),
    }
}

/// Returns the least of a row, with its column, or of a column, with its row.
pub(crate) fn best_of<T>(found: Option<Found<T>>, of_rows: bool) -> Option<Best<T>> {
    let Found { row, column, value } = found?;
    let index = if of_rows { column } else { row };
    Some(Best { value, index })
}

/// Returns the least results of a search, and adds the cotangents of both lists to `bars`: the derivative of the sum of
/// the results, each times its number of `upstream` (or one). Equal pairs share a cotangent equally.
///
/// Pairs without a cotangent are not differentiated. The numbers of both lists are here.
pub(crate) fn least_pulled<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    lists: &[Column<'_, T>; 2],
    groups: Option<Groups<'_>>,
    wanted: Least<T>,
    upstream: Option<&[T]>,
    bars: [&mut [T]; 2],
) -> Result<Vec<Option<Found<T>>>, Error> {
    wanted.check()?;
    let is_away = |list: &Column<'_, T>| list.held.is_some_and(|own| own.here().is_none());
    if lists.iter().any(is_away) {
        return Err(FOREIGN);
    }
    let [a, b] = &whole(lists);
    let spans = match groups {
        Some(groups) => groups.spans(lists.each_ref().map(Column::len))?,
        None => GroupSpans { a, b },
    };
    let found = engine.least(call, lists, spans, wanted, true)?;
    if let Some(upstream) = upstream {
        expect(Argument::Upstream, found.best.len(), upstream.len())?;
        check_finite(Argument::Upstream, upstream)?;
    }
    let slot = |pair: &Found<T>| match wanted {
        Least::Columns(_) => pair.column,
        Least::Groups(_) => spans.a.partition_point(|&start| start <= pair.row) - 1,
        Least::Rows(_) | Least::Below(_) => pair.row,
    };
    let mut ties = vec![0_u32; found.best.len()];
    for pair in &found.pairs {
        ties[slot(pair)] += 1;
    }
    let factor = |pair: &Found<T>| {
        let slot = slot(pair);
        let own = upstream.map_or(T::one(), |upstream| upstream[slot]);
        own.over(T::lit(f64::from(ties[slot])))
    };
    let pairs = found.pairs.iter().map(|pair| (pair, factor(pair)));
    let pairs: Vec<_> = pairs
        .filter(|(_, factor)| *factor != T::default())
        .collect();
    let places = [0, 1].map(|k| {
        let place = |(pair, _): &(&Found<T>, T)| if k == 0 { pair.row } else { pair.column };
        pairs.iter().map(place).collect::<Vec<_>>()
    });
    let mut room = Vec::new();
    let picked = [0, 1].map(|k| {
        let list = &lists[k];
        let mut numbers = Vec::with_capacity(pairs.len() * list.fields);
        for &i in &places[k] {
            numbers.extend_from_slice(list.numbers(i..i + 1, &mut room));
        }
        numbers
    });
    let columns = [0, 1].map(|k| Column::lent(&picked[k], lists[k].fields, Some(pairs.len())));
    let mut own = lists
        .each_ref()
        .map(|list| vec![T::default(); pairs.len() * list.fields]);
    if !pairs.is_empty() {
        let derived = call.clone().derived(Mode::ValueGrad)?;
        try_then_check(|new| {
            let [by_a, by_b] = &mut own;
            let targets = [(by_a, lists[0].fields), (by_b, lists[1].fields)];
            let targets = targets.map(|(rows, fields)| Some(Target::of_rows(rows, fields)));
            let targets = std::iter::once(None).chain(targets).collect();
            engine.map(&derived, &columns, Items::Targets(targets, new))
        })?;
    }
    for k in [0, 1] {
        let (fields, codes) = (lists[k].fields, call.recording.takes[k].codes);
        let rows = own[k].chunks_exact(fields).zip(&places[k]).zip(&pairs);
        for ((by, &i), &(_, factor)) in rows {
            let bar = &mut bars[k][i * fields..][..fields - codes];
            for (sum, &x) in bar.iter_mut().zip(by) {
                *sum = (*sum + x * factor).canonical();
            }
        }
        if codes > 0 {
            let all = lists[k].all();
            let shapes = all.chunks_exact(fields);
            for (bar, shape) in bars[k].chunks_exact_mut(fields).zip(shapes) {
                bar[fields - codes..].copy_from_slice(&shape[fields - codes..]);
            }
        }
    }
    Ok(found.best)
}
