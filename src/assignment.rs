//! Pairs of two lists, one to one: greedy, or of the largest sum.
use crate::Scalar;
use crate::error::{Argument, Error, Field, Flaw};
use crate::suppression::Pair;
use std::cmp::Ordering;

/// Selects one-to-one pairs by descending overlap: first the largest, then repeatedly the largest of which both ends
/// are still free. Equal overlaps are ordered by the smaller first index, then by the smaller second index. Pairs whose
/// overlap is NaN are ignored.
///
/// ```
/// use geograd::assignment::greedy;
/// use geograd::suppression::Pair;
/// let pair = |first, second, overlap| Pair { first, second, overlap };
/// let all = [pair(0, 0, 0.8), pair(0, 1, 0.7), pair(1, 0, 0.9), pair(1, 1, 0.1)];
/// assert_eq!(greedy(&all), [all[2], all[1]]);
/// ```
#[must_use]
pub fn greedy<S: Scalar<Mask = bool>>(pairs: &[Pair<S>]) -> Vec<Pair<S>> {
    let mut order: Vec<Pair<S>> = pairs
        .iter()
        .copied()
        .filter(|p| p.overlap.equals(p.overlap))
        .collect();
    order.sort_unstable_by(|a, b| {
        let by_overlap = if a.overlap.above(b.overlap) {
            Ordering::Less
        } else if b.overlap.above(a.overlap) {
            Ordering::Greater
        } else {
            Ordering::Equal
        };
        by_overlap
            .then(a.first.cmp(&b.first))
            .then(a.second.cmp(&b.second))
    });
    let ends = |of: fn(&Pair<S>) -> usize| order.iter().map(of).max().map_or(0, |n| n + 1);
    let (mut first, mut second) = (
        vec![false; ends(|p| p.first)],
        vec![false; ends(|p| p.second)],
    );
    order.retain(|pair| {
        let is_free = !first[pair.first] && !second[pair.second];
        if is_free {
            (first[pair.first], second[pair.second]) = (true, true);
        }
        is_free
    });
    order
}

/// Returns the one-to-one pairs of rows and columns with the largest sum of gains, by row: as many as there are
/// rows or columns, whichever are fewer. Gains come row by row.
///
/// Shortest augmenting paths with potentials, one row at a time (Jonker and Volgenant, *A shortest
/// augmenting path algorithm for dense and sparse linear assignment problems*, 1987), in O(n² m) for n of
/// the fewer and m of the others.
///
/// # Errors
///
/// [`Error::Length`] for another number of gains than rows times columns, [`Error::Invalid`] for a gain
/// that is not finite.
///
/// ```
/// use geograd::assignment::optimal;
/// // Greedy takes 0.9 and is left with 0.1.
/// assert_eq!(optimal(&[0.8, 0.7, 0.9, 0.3], 2, 2)?, [(0, 1), (1, 0)]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn optimal(gains: &[f64], rows: usize, columns: usize) -> Result<Vec<(usize, usize)>, Error> {
    let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
    let argument = Argument::Named("gains");
    if gains.len() != expected {
        return Err(Error::Length {
            argument,
            expected,
            found: gains.len(),
        });
    }
    if let Some(row) = gains.iter().position(|x| !x.is_finite()) {
        let flaw = Flaw::NotFinite(Field::VALUE);
        return Err(Error::Invalid {
            argument,
            item: row,
            flaw,
        });
    }
    // Sums of gains of any size stay finite when they are scaled.
    let largest = gains.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = if largest > 1e290 { 1e-20 } else { 1.0 };
    let mut pairs = match rows <= columns {
        true => assigned(rows, columns, |row, column| {
            -gains[row * columns + column] * scale
        }),
        false => {
            let turned = assigned(columns, rows, |column, row| {
                -gains[row * columns + column] * scale
            });
            turned
                .into_iter()
                .map(|(column, row)| (row, column))
                .collect()
        }
    };
    pairs.sort_unstable();
    Ok(pairs)
}

/// Returns the one-to-one pairs of a list with the largest sum of overlaps, by their first index. Overlaps of zero or
/// less add nothing and are left out.
///
/// Pairs that share no index, such as those of two frames, are independent: one call serves the pairs of all frames, as
/// [`Cpu::above_grouped`](crate::kernels::Cpu::above_grouped) gives them, at the cost of a call per frame at most.
///
/// # Errors
///
/// [`Error::Invalid`] for an overlap that is not finite.
///
/// ```
/// use geograd::assignment::largest;
/// use geograd::suppression::Pair;
/// let pair = |first, second, overlap| Pair { first, second, overlap };
/// // Greedy takes 0.9 alone.
/// let all = [pair(0, 0, 0.8), pair(1, 0, 0.9), pair(1, 1, 0.7), pair(5, 9, 0.1)];
/// assert_eq!(largest(&all)?, [all[0], all[2], all[3]]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn largest(pairs: &[Pair<f64>]) -> Result<Vec<Pair<f64>>, Error> {
    if let Some(item) = pairs.iter().position(|pair| !pair.overlap.is_finite()) {
        return Err(Error::Invalid {
            argument: Argument::Named("pairs"),
            item,
            flaw: Flaw::NotFinite(Field::new("overlap")),
        });
    }
    let mut chosen = Vec::new();
    for part in parts(pairs) {
        let places = |of: fn(&Pair<f64>) -> usize| {
            let mut all: Vec<usize> = part.iter().map(of).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let (rows, columns) = (places(|p| p.first), places(|p| p.second));
        let entries = rows.len().checked_mul(columns.len());
        let mut gains = vec![0.0_f64; entries.ok_or(Error::TooLarge)?];
        let at = |pair: &Pair<f64>| {
            let row = rows.partition_point(|&place| place < pair.first);
            row * columns.len() + columns.partition_point(|&place| place < pair.second)
        };
        for pair in &part {
            let gain = &mut gains[at(pair)];
            *gain = gain.max(pair.overlap);
        }
        for (row, column) in optimal(&gains, rows.len(), columns.len())? {
            let overlap = gains[row * columns.len() + column];
            if overlap > 0.0 {
                let (first, second) = (rows[row], columns[column]);
                chosen.push(Pair {
                    first,
                    second,
                    overlap,
                });
            }
        }
    }
    chosen.sort_unstable_by_key(|pair| (pair.first, pair.second));
    Ok(chosen)
}

/// Splits pairs into groups that share no index.
fn parts(pairs: &[Pair<f64>]) -> Vec<Vec<Pair<f64>>> {
    let mut ends: Vec<(usize, usize)> = Vec::with_capacity(2 * pairs.len());
    // Links from pair to pair, each to an earlier one of its part.
    let mut link: Vec<usize> = (0..pairs.len()).collect();
    fn root(link: &mut [usize], mut of: usize) -> usize {
        while link[of] != of {
            link[of] = link[link[of]];
            of = link[of];
        }
        of
    }
    for of in [
        |pair: &Pair<f64>| pair.first,
        |pair: &Pair<f64>| pair.second,
    ] {
        ends.clear();
        ends.extend(pairs.iter().enumerate().map(|(i, pair)| (of(pair), i)));
        ends.sort_unstable();
        for two in ends.windows(2) {
            if two[0].0 == two[1].0 {
                let (a, b) = (root(&mut link, two[0].1), root(&mut link, two[1].1));
                link[a.max(b)] = a.min(b);
            }
        }
    }
    let mut parts: Vec<Vec<Pair<f64>>> = Vec::new();
    let mut place = vec![usize::MAX; pairs.len()];
    for (i, &pair) in pairs.iter().enumerate() {
        let own = root(&mut link, i);
        if place[own] == usize::MAX {
            place[own] = parts.len();
            parts.push(Vec::new());
        }
        parts[place[own]].push(pair);
    }
    parts
}

/// Returns the pairs of least total cost, for no more rows than columns.
fn assigned(
    rows: usize,
    columns: usize,
    cost: impl Fn(usize, usize) -> f64,
) -> Vec<(usize, usize)> {
    // Column `columns` stands for "none yet": a new row starts from there.
    let (mut row_price, mut column_price) = (vec![0.0; rows], vec![0.0; columns + 1]);
    let mut row_of = vec![None; columns + 1];
    for new in 0..rows {
        row_of[columns] = Some(new);
        let mut least = vec![(f64::INFINITY, columns); columns];
        // Columns whose row is on a path, in the order in which they were reached.
        let mut path: Vec<(usize, usize)> = Vec::new();
        let mut done = vec![false; columns];
        let mut column = columns;
        while let Some(row) = row_of[column] {
            path.push((column, row));
            if column < columns {
                done[column] = true;
            }
            let mut next = (f64::INFINITY, columns);
            for other in (0..columns).filter(|&other| !done[other]) {
                let slack = cost(row, other) - row_price[row] - column_price[other];
                if slack < least[other].0 {
                    least[other] = (slack, column);
                }
                if least[other].0 < next.0 {
                    next = (least[other].0, other);
                }
            }
            for &(seen, row) in &path {
                column_price[seen] -= next.0;
                row_price[row] += next.0;
            }
            for other in (0..columns).filter(|&other| !done[other]) {
                least[other].0 -= next.0;
            }
            column = next.1;
        }
        // Back along the path, every row moves to the column after its own.
        while column != columns {
            let before = least[column].1;
            row_of[column] = row_of[before];
            column = before;
        }
    }
    let own = row_of.into_iter().take(columns).enumerate();
    own.filter_map(|(column, row)| row.map(|row| (row, column)))
        .collect()
}
