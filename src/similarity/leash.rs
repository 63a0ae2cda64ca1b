//! The shortest leash of two walks from vertex to vertex: its length by a table of all pairs, and the pair that decides it.
use crate::{Scalar, Vec2};

/// Tables of up to so many pairs are computed whole: a search of the pairs that can be reached has branches that nobody
/// foresees, and takes twenty times as long for a pair.
const SMALL: usize = 1 << 12;
/// The share of larger tables that such a search may look at before the whole table takes less time.
const SHARE: usize = 32;

/// Squares from here on have their digits.
const LEAST: f64 = 1e-280;

/// Vertices by axis.
type Columns<'a> = [&'a [f64]; 2];

/// Returns the pair that decides the shortest leash of two paths; `None` where one has no vertices.
pub(super) fn deciding<S: Scalar<Mask = bool>>(a: &[Vec2<S>], b: &[Vec2<S>]) -> Option<[usize; 2]> {
    let (n, m) = (a.len(), b.len());
    // Both paths by axis, the second one backwards, then the table's room.
    let mut numbers = vec![f64::INFINITY; 2 * (n + m) + 3 * (n + 2)];
    let (paths, table) = numbers.split_at_mut(2 * (n + m));
    let (own, other) = paths.split_at_mut(2 * n);
    let (ax, ay) = own.split_at_mut(n);
    let (bx, by) = other.split_at_mut(m);
    let is_plain = put(a.iter(), ax, ay) & put(b.iter().rev(), bx, by);
    let sizes = paths.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let by_distance = || deciding_by([n, m], |i, j| a[i].distance(b[j]));
    // Squares would leave the format.
    if !is_plain || !(1e-100..1e100).contains(&sizes) {
        return by_distance();
    }
    let (own, other) = paths.split_at(2 * n);
    let (own, other) = (own.split_at(n).into(), other.split_at(m).into());
    let pair = deciding_by_squares(own, other, table)?;
    // Squares of paths that are all but equal have lost their digits.
    match square(own, other, pair) < LEAST {
        true => by_distance(),
        false => Some(pair),
    }
}

/// Returns the pair that decides by squares of distances, and needs room for a table of infinite numbers. The second path is
/// backwards.
fn deciding_by_squares(a: Columns<'_>, b: Columns<'_>, table: &mut [f64]) -> Option<[usize; 2]> {
    let (n, m) = (a[0].len(), b[0].len());
    let cost = |i: usize, j: usize| square(a, b, [i, j]);
    let pairs = n.saturating_mul(m);
    if pairs > SMALL {
        let bound = greedy([n, m], &cost)?;
        if let Ok(found) = reached([n, m], &cost, bound, (pairs / SHARE).max(n + m)) {
            return found;
        }
    }
    let least = length(a, b, table)?;
    if let Some(pair) = only(a, b, least) {
        return Some(pair);
    }
    // Pairs that tie: the walk tells which one is first. No longer leash needs to be looked at.
    reached([n, m], &cost, least, usize::MAX).ok()?
}

/// Returns the squared distance of a pair of vertices. The second path is backwards.
#[inline(always)]
fn square([ax, ay]: Columns<'_>, [bx, by]: Columns<'_>, [i, j]: [usize; 2]) -> f64 {
    let k = bx.len() - 1 - j;
    let (x, y) = (ax[i] - bx[k], ay[i] - by[k]);
    x * x + y * y
}

/// Writes the coordinates of vertices. Returns `true` if all are plain numbers.
fn put<'a, S: Scalar + 'a>(
    all: impl Iterator<Item = &'a Vec2<S>>,
    x: &mut [f64],
    y: &mut [f64],
) -> bool {
    let mut is_plain = true;
    for ((x, y), v) in x.iter_mut().zip(y).zip(all) {
        match (v.x.widened(), v.y.widened()) {
            (Some(own_x), Some(own_y)) => (*x, *y) = (own_x, own_y),
            _ => is_plain = false,
        }
    }
    is_plain
}

/// Returns the pair that decides the shortest leash by any cost of pairs.
fn deciding_by<C: Scalar<Mask = bool>>(
    counts: [usize; 2],
    cost: impl Fn(usize, usize) -> C,
) -> Option<[usize; 2]> {
    let bound = greedy(counts, &cost)?;
    reached(counts, &cost, bound, usize::MAX).ok()?
}

/// Returns the least of the largest costs of walks, given the vertices of one path and those of the other backwards.
///
/// Pairs of one sum of indices depend on those of the two sums before, not on each other.
fn length([ax, ay]: Columns<'_>, [bx, by]: Columns<'_>, table: &mut [f64]) -> Option<f64> {
    let (n, m) = (ax.len(), bx.len());
    if n == 0 || m == 0 {
        return None;
    }
    // By the index on the first path, from one on, with room beside both ends; all are infinite.
    let (mut older, rest) = table.split_at_mut(n + 2);
    let (mut old, mut new) = rest.split_at_mut(n + 2);
    // Nothing is before the first pair.
    older[0] = f64::NEG_INFINITY;
    for sum in 0..n + m - 1 {
        let (low, high) = (sum.saturating_sub(m - 1), sum.min(n - 1));
        let count = high + 1 - low;
        // The second path's index is the sum less the first one's, and its vertices are backwards.
        let first = m - 1 + low - sum;
        let a = ax[low..=high].iter().zip(&ay[low..=high]);
        let b = bx[first..first + count]
            .iter()
            .zip(&by[first..first + count]);
        let before = older[low..low + count].iter();
        let before = before.zip(
            old[low..low + count]
                .iter()
                .zip(&old[low + 1..low + 1 + count]),
        );
        let cells = new[low + 1..low + 1 + count].iter_mut();
        for (cell, ((a, b), (both, (one, other)))) in cells.zip(a.zip(b).zip(before)) {
            let (x, y) = (a.0 - b.0, a.1 - b.1);
            let own = x * x + y * y;
            let least = if one < both { *one } else { *both };
            let least = if *other < least { *other } else { least };
            *cell = if own > least { own } else { least };
        }
        new[low] = f64::INFINITY;
        new[low + 1 + count] = f64::INFINITY;
        (older, old, new) = (old, new, older);
    }
    Some(old[n])
}

/// Returns the pair of some cost, unless there are several. The second path is backwards.
fn only([ax, ay]: Columns<'_>, [bx, by]: Columns<'_>, cost: f64) -> Option<[usize; 2]> {
    let mut found = None;
    for (i, a) in ax.iter().zip(ay).enumerate() {
        let is_it = |b: (&f64, &f64)| {
            let (x, y) = (a.0 - b.0, a.1 - b.1);
            x * x + y * y == cost
        };
        let count: u32 = bx.iter().zip(by).map(|b| u32::from(is_it(b))).sum();
        match (count, found) {
            (0, _) => {}
            (1, None) => {
                let j = bx.iter().zip(by).position(is_it)?;
                found = Some([i, bx.len() - 1 - j]);
            }
            _ => return None,
        }
    }
    found
}

/// Returns the largest cost of a walk by the nearest pairs, which bounds that of others.
fn greedy<C: Scalar<Mask = bool>>(
    [n, m]: [usize; 2],
    cost: &impl Fn(usize, usize) -> C,
) -> Option<C> {
    if n == 0 || m == 0 {
        return None;
    }
    let (mut i, mut j, mut most) = (0, 0, cost(0, 0));
    while i + 1 < n || j + 1 < m {
        let mut next = None::<(C, usize, usize)>;
        for (k, l) in [(i + 1, j + 1), (i + 1, j), (i, j + 1)] {
            if k < n && l < m {
                let own = cost(k, l);
                if next.is_none_or(|(least, ..)| own.below(least)) {
                    next = Some((own, k, l));
                }
            }
        }
        let (own, k, l) = next?;
        (i, j) = (k, l);
        most = if most.below(own) { own } else { most };
    }
    Some(most)
}

/// More pairs than a search may look at.
struct TooMany;

/// Returns the pair that decides the least of the largest costs of walks, of which one costs no more than `most`.
fn reached<C: Scalar<Mask = bool>>(
    [n, m]: [usize; 2],
    cost: &impl Fn(usize, usize) -> C,
    most: C,
    mut room: usize,
) -> Result<Option<[usize; 2]>, TooMany> {
    // The least cost up to each vertex of the second path and the present one of the first, with the pair that decides it;
    // none where all walks cost more than that one. Only places from `first` on can be reached.
    let mut row = vec![None::<(C, [u32; 2])>; m];
    let (mut first, mut end) = (0, 1);
    for i in 0..n {
        let (mut diagonal, mut left) = (None, None);
        let (from, mut to) = (first, first);
        let mut is_first = true;
        for (j, place) in row.iter_mut().enumerate().skip(from) {
            if j > end && left.is_none() && i > 0 {
                break;
            }
            let up = if i > 0 && j < end { *place } else { None };
            let before = [diagonal, up, left].into_iter().flatten();
            let shortest = before.reduce(|x, y| if y.0.below(x.0) { y } else { x });
            let own = cost(i, j);
            let is_reached = shortest.is_some() || (i == 0 && j == 0);
            let found = (is_reached && own.at_most(most)).then(|| match shortest {
                Some(before) if own.at_most(before.0) => before,
                _ => (own, [i as u32, j as u32]),
            });
            (diagonal, left, *place) = (up, found, found);
            if found.is_some() {
                if is_first {
                    (first, is_first) = (j, false);
                }
                to = j + 1;
            }
            room = room.checked_sub(1).ok_or(TooMany)?;
        }
        end = to;
    }
    Ok(row[m - 1].map(|(_, pair)| pair.map(|k| k as usize)))
}
