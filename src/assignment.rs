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
    optimal_until(gains, rows, columns, &|| false)
}

/// Returns what [`optimal`] does, or no pairs once `is_over` returns `true`: it is asked before every row.
///
/// # Errors
///
/// See [`optimal`].
///
/// ```
/// use geograd::assignment::optimal_until;
/// let gains = [0.8, 0.7, 0.9, 0.3];
/// assert_eq!(optimal_until(&gains, 2, 2, &|| false)?, [(0, 1), (1, 0)]);
/// assert_eq!(optimal_until(&gains, 2, 2, &|| true)?, []);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn optimal_until(
    gains: &[f64],
    rows: usize,
    columns: usize,
    is_over: &dyn Fn() -> bool,
) -> Result<Vec<(usize, usize)>, Error> {
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
    let is_wide = rows <= columns;
    let mut pairs = match is_wide {
        true => assigned(rows, columns, is_over, |row, costs| {
            for (cost, gain) in costs.iter_mut().zip(&gains[row * columns..][..columns]) {
                *cost = -gain * scale;
            }
        }),
        false => assigned(columns, rows, is_over, |column, costs| {
            for (cost, row) in costs.iter_mut().zip(gains.chunks_exact(columns)) {
                *cost = -row[column] * scale;
            }
        }),
    };
    if !is_wide {
        for pair in &mut pairs {
            *pair = (pair.1, pair.0);
        }
    }
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
    largest_until(pairs, &|| false)
}

/// Returns what [`largest`] does, or fewer pairs once `is_over` returns `true`: it is asked before every index.
///
/// # Errors
///
/// See [`largest`].
///
/// ```
/// use geograd::assignment::largest_until;
/// use geograd::suppression::Pair;
/// let all = [Pair { first: 0, second: 0, overlap: 0.8 }];
/// assert_eq!(largest_until(&all, &|| false)?, all);
/// assert_eq!(largest_until(&all, &|| true)?, []);
/// # Ok::<(), geograd::Error>(())
/// ```
pub fn largest_until(
    pairs: &[Pair<f64>],
    is_over: &dyn Fn() -> bool,
) -> Result<Vec<Pair<f64>>, Error> {
    if let Some(item) = pairs.iter().position(|pair| !pair.overlap.is_finite()) {
        return Err(Error::Invalid {
            argument: Argument::Named("pairs"),
            item,
            flaw: Flaw::NotFinite(Field::new("overlap")),
        });
    }
    let (firsts, seconds) = (
        Places::of(pairs, |pair| pair.first),
        Places::of(pairs, |pair| pair.second),
    );
    let mut chosen = Vec::new();
    for part in parts(&firsts, &seconds) {
        let (rows, columns) = (part.rows.len(), part.columns.len());
        let mut gains = vec![0.0_f64; rows.checked_mul(columns).ok_or(Error::TooLarge)?];
        for (pair, row, column) in part.pairs {
            let gain = &mut gains[row * columns + column];
            *gain = gain.max(pairs[pair].overlap);
        }
        for (row, column) in optimal_until(&gains, rows, columns, is_over)? {
            let overlap = gains[row * columns + column];
            if overlap > 0.0 {
                let (first, second) = (
                    firsts.all[part.rows[row]],
                    seconds.all[part.columns[column]],
                );
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

/// The different indices at one end of some pairs.
struct Places {
    /// All of them, ascending.
    all: Vec<usize>,
    /// For every pair, which of them is its own.
    of_pairs: Vec<usize>,
}

impl Places {
    fn of(pairs: &[Pair<f64>], end: fn(&Pair<f64>) -> usize) -> Self {
        let most = pairs.iter().map(end).max().unwrap_or(0);
        // A table is faster than a sort unless most of it is empty.
        if most > 8 * pairs.len() + 1024 {
            let mut all: Vec<usize> = pairs.iter().map(end).collect();
            all.sort_unstable();
            all.dedup();
            let place = |pair: &Pair<f64>| all.partition_point(|&other| other < end(pair));
            let of_pairs = pairs.iter().map(place).collect();
            return Places { all, of_pairs };
        }
        let mut table = vec![usize::MAX; most + 1];
        for pair in pairs {
            table[end(pair)] = 0;
        }
        let mut all = Vec::new();
        for (index, place) in table.iter_mut().enumerate() {
            if *place == 0 {
                *place = all.len();
                all.push(index);
            }
        }
        let of_pairs = pairs.iter().map(|pair| table[end(pair)]).collect();
        Places { all, of_pairs }
    }
}

/// Pairs that share no index with other pairs.
#[derive(Default)]
struct Part {
    /// The places of its first and of its second indices, ascending.
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// Its pairs, each by its index, its row and its column.
    pairs: Vec<(usize, usize, usize)>,
}

/// Splits pairs into parts that share no index.
fn parts(firsts: &Places, seconds: &Places) -> Vec<Part> {
    // Links from place to place, each to an earlier one of its part; second indices follow first ones.
    let rows = firsts.all.len();
    let mut link: Vec<usize> = (0..rows + seconds.all.len()).collect();
    fn root(link: &mut [usize], mut of: usize) -> usize {
        while link[of] != of {
            link[of] = link[link[of]];
            of = link[of];
        }
        of
    }
    for (&first, &second) in firsts.of_pairs.iter().zip(&seconds.of_pairs) {
        let (a, b) = (root(&mut link, first), root(&mut link, rows + second));
        link[a.max(b)] = a.min(b);
    }
    let mut parts: Vec<Part> = Vec::new();
    // The part of every place, and its row or column there.
    let mut own: Vec<(usize, usize)> = Vec::with_capacity(link.len());
    for place in 0..link.len() {
        let root = root(&mut link, place);
        let part = if root == place {
            parts.len()
        } else {
            own[root].0
        };
        if root == place {
            parts.push(Part::default());
        }
        let list = match place < rows {
            true => &mut parts[part].rows,
            false => &mut parts[part].columns,
        };
        own.push((part, list.len()));
        list.push(if place < rows { place } else { place - rows });
    }
    let ends = firsts.of_pairs.iter().zip(&seconds.of_pairs);
    for (pair, (&first, &second)) in ends.enumerate() {
        let (part, row) = own[first];
        parts[part].pairs.push((pair, row, own[rows + second].1));
    }
    parts
}

/// The number of columns that are searched together, one in each lane of a vector.
const LANES: usize = 8;

/// Returns the pairs of least total cost, for no more rows than columns. `cost` writes the costs of a row.
fn assigned(
    rows: usize,
    columns: usize,
    is_over: &dyn Fn() -> bool,
    mut cost: impl FnMut(usize, &mut [f64]),
) -> Vec<(usize, usize)> {
    // Columns up to a whole number of lanes are infinitely far.
    let wide = columns.next_multiple_of(LANES);
    let mut costs = vec![f64::INFINITY; rows * wide];
    for (row, costs) in costs.chunks_exact_mut(wide.max(1)).enumerate() {
        cost(row, &mut costs[..columns]);
    }
    let (mut row_prices, mut column_prices) = (vec![0.0; rows], vec![0.0; wide]);
    let mut row_of = vec![None; columns];
    let (mut search, mut path) = (Search::new(wide), Path::default());
    for new in 0..rows {
        if is_over() {
            return Vec::new();
        }
        search.begin(&column_prices);
        path.clear();
        // A new row starts from no column.
        let (mut row, mut column, mut step) = (new, columns, 0.0);
        loop {
            path.push(row, row_prices[row], column, search.prices.get(column));
            search.close(column);
            step = search.nearest(&costs[row * wide..][..wide], row_prices[row], column, step);
            path.pay(step);
            let found = search.least.iter().position(|&least| least == step);
            let Some(next) = found.filter(|&next| next < columns) else {
                // No column is left, which fewer rows than columns exclude.
                return Vec::new();
            };
            column = next;
            match row_of[column] {
                Some(of) => row = of,
                None => break,
            }
        }
        path.put(&mut row_prices, &mut column_prices);
        // Back along the path, every row moves to the column after its own.
        while column != columns {
            let before = search.before[column];
            row_of[column] = match before == columns {
                true => Some(new),
                false => row_of[before],
            };
            column = before;
        }
    }
    let own = row_of.into_iter().enumerate();
    own.filter_map(|(column, row)| row.map(|row| (row, column)))
        .collect()
}

/// The columns that the search for a path has not reached.
struct Search {
    /// The least slack of every column, infinite for those that were reached.
    least: Vec<f64>,
    /// The column before it on the shortest path.
    before: Vec<usize>,
    /// Their prices; minus infinity for those that were reached.
    prices: Vec<f64>,
}

impl Search {
    fn new(wide: usize) -> Self {
        Search {
            least: vec![0.0; wide],
            before: vec![0; wide],
            prices: vec![0.0; wide],
        }
    }
    fn begin(&mut self, prices: &[f64]) {
        self.least.fill(f64::INFINITY);
        self.prices.copy_from_slice(prices);
    }
    /// Leaves out a column; nothing for that of a new row.
    fn close(&mut self, column: usize) {
        if let (Some(least), Some(price)) =
            (self.least.get_mut(column), self.prices.get_mut(column))
        {
            (*least, *price) = (f64::INFINITY, f64::NEG_INFINITY);
        }
    }
    /// Lowers all slacks by the last step and to those of a row. Returns the least.
    fn nearest(&mut self, costs: &[f64], price: f64, column: usize, step: f64) -> f64 {
        let mut nearest = [f64::INFINITY; LANES];
        let (least, _) = self.least.as_chunks_mut::<LANES>();
        let (before, _) = self.before.as_chunks_mut::<LANES>();
        let (prices, _) = self.prices.as_chunks::<LANES>();
        let (costs, _) = costs.as_chunks::<LANES>();
        for (((least, before), prices), costs) in
            least.iter_mut().zip(before).zip(prices).zip(costs)
        {
            let mut k = 0;
            while k < LANES {
                let (slack, kept) = (costs[k] - price - prices[k], least[k] - step);
                let is_less = slack < kept;
                least[k] = if is_less { slack } else { kept };
                before[k] = if is_less { column } else { before[k] };
                nearest[k] = if least[k] < nearest[k] {
                    least[k]
                } else {
                    nearest[k]
                };
                k += 1;
            }
        }
        nearest.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// The rows and columns that a search has reached, and their prices.
#[derive(Default)]
struct Path {
    rows: Vec<(usize, usize)>,
    row_prices: Vec<f64>,
    column_prices: Vec<f64>,
}

impl Path {
    fn clear(&mut self) {
        self.rows.clear();
        self.row_prices.clear();
        self.column_prices.clear();
    }
    fn push(&mut self, row: usize, price: f64, column: usize, column_price: Option<&f64>) {
        self.rows.push((row, column));
        self.row_prices.push(price);
        self.column_prices
            .push(column_price.copied().unwrap_or(0.0));
    }
    /// Raises the prices of rows and lowers those of columns.
    fn pay(&mut self, step: f64) {
        for (row, column) in self.row_prices.iter_mut().zip(&mut self.column_prices) {
            *row += step;
            *column -= step;
        }
    }
    /// Writes the prices to those of all rows and columns.
    fn put(&self, row_prices: &mut [f64], column_prices: &mut [f64]) {
        let prices = self.row_prices.iter().zip(&self.column_prices);
        for (&(row, column), (&own, &other)) in self.rows.iter().zip(prices) {
            row_prices[row] = own;
            if let Some(price) = column_prices.get_mut(column) {
                *price = other;
            }
        }
    }
}
