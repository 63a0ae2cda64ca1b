//! Results of rows and of pairs of rows, on a machine: the one place where `table` and `iou_csv` compute.
use crate::cli::Machine;
use geograd::kernels::dynamic::{Function, Rows};
use geograd::kernels::item::Single;
use geograd::{Error, Real, Unrecordable};
use std::borrow::Cow;
use std::ops::Range;
use std::str::FromStr;

/// Rows, and pairs of rows, that are computed at a time: enough for all threads, few enough that memory does not grow
/// with the job.
pub const BLOCK: usize = 1 << 18;

/// A format of numbers that machines compute in. A GPU has no `f64`: command lines refuse it.
pub trait Number: Real + Single<Scalar = Self> + FromStr + Into<f64> {}
impl<T: Real + Single<Scalar = T> + FromStr + Into<f64>> Number for T {}

/// Results of pairs of rows, given by their places in both lists: numbers for every column of a result, pair by pair.
///
/// # Errors
///
/// As [`Function::aligned`], and the errors of the machine.
pub fn of_places<T: Number>(
    function: &Function<T>,
    machine: &Machine,
    lists: [Rows<'_, T>; 2],
    places: [&[usize]; 2],
) -> Result<Vec<Vec<T>>, Error> {
    let fields = lists.map(|list| list.fields());
    let picked = [0, 1].map(|k| {
        let (all, fields) = (lists[k].numbers(), fields[k]);
        let mut rows = Vec::with_capacity(places[k].len() * fields);
        for &row in places[k] {
            rows.extend_from_slice(&all[row * fields..(row + 1) * fields]);
        }
        rows
    });
    let rows = [0, 1].map(|k| Rows::new(&picked[k], fields[k]));
    function.on(machine.backend())?.aligned(&rows)
}

/// Some rows of both lists, of their numbers.
fn parts<'a, T: Number>(
    numbers: &'a [Cow<'_, [T]>; 2],
    lists: &[Rows<'_, T>; 2],
    rows: &[Range<usize>; 2],
) -> [Rows<'a, T>; 2] {
    [0, 1].map(|k| {
        let (fields, own) = (lists[k].fields(), &rows[k]);
        Rows::new(&numbers[k][own.start * fields..own.end * fields], fields)
    })
}

/// The same of row i of both lists, of some rows.
///
/// # Errors
///
/// As [`Function::aligned`], and the errors of the machine.
pub fn of_rows<T: Number>(
    function: &Function<T>,
    machine: &Machine,
    lists: [Rows<'_, T>; 2],
    rows: &Range<usize>,
) -> Result<Vec<Vec<T>>, Error> {
    let numbers = lists.map(|list| list.numbers());
    let rows = parts(&numbers, &lists, &[rows.clone(), rows.clone()]);
    function.on(machine.backend())?.aligned(&rows)
}

/// The same of every row of some with every row of others, row by row.
///
/// # Errors
///
/// As [`Function::aligned`], and the errors of the machine.
pub fn of_all<T: Number>(
    function: &Function<T>,
    machine: &Machine,
    lists: [Rows<'_, T>; 2],
    block: &[Range<usize>; 2],
) -> Result<Vec<Vec<T>>, Error> {
    let [rows, columns] = block;
    let numbers = lists.map(|list| list.numbers());
    let [a, b] = parts(&numbers, &lists, block);
    let planes = function.on(machine.backend())?.all_pairs(a, b);
    let planes = match planes {
        // A GPU replays searches item by item.
        Err(Error::Program(Unrecordable::Search)) => {
            let [of_rows, of_columns] = places(rows, columns);
            return of_places(function, machine, lists, [&of_rows, &of_columns]);
        }
        planes => planes?,
    };
    let pairs = rows.len() * columns.len();
    let mut first = 0;
    let list = |fields: usize| {
        let own = &planes[first * pairs..(first + fields) * pairs];
        first += fields;
        if fields == 1 {
            return own.to_vec();
        }
        let numbers = (0..pairs).flat_map(|pair| own.iter().skip(pair).step_by(pairs));
        numbers.copied().collect()
    };
    Ok(function.gives().into_iter().map(list).collect())
}

/// The places of every row with every column, row by row.
#[must_use]
pub fn places(rows: &Range<usize>, columns: &Range<usize>) -> [Vec<usize>; 2] {
    let of_rows = rows
        .clone()
        .flat_map(|row| columns.clone().map(move |_| row));
    let of_columns = rows.clone().flat_map(|_| columns.clone());
    [of_rows.collect(), of_columns.collect()]
}

/// Every row with every column, a block of pairs at a time, in the order of the pairs: rows, and columns of them.
pub fn blocks(
    rows: Range<usize>,
    columns: Range<usize>,
) -> impl Iterator<Item = [Range<usize>; 2]> {
    let high = (BLOCK / columns.len().max(1)).max(1);
    let bands = rows.clone().step_by(high);
    let bands = bands.map(move |start| start..rows.end.min(start + high));
    bands.flat_map(move |band| {
        let (all, end) = (columns.clone().step_by(BLOCK), columns.end);
        all.map(move |start| [band.clone(), start..end.min(start + BLOCK)])
    })
}
