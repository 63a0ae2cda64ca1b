//! Boxes: their columns, and the scores of many pairs of them.
mod kinds;

use crate::input::{self, Shape};
use crate::metric::Metric;
use common::cli::{Failure, Machine};
use common::compute::{self, Number};
use geograd::kernels::Cpu;
use geograd::kernels::dynamic::{Mode, Operation, Rows};
use geograd::kernels::item::Single;
use geograd::{Error, Program};
use std::ops::Range;

/// A kind of box.
pub trait Boxes: Single<Scalar: Number> + Send + Sync {
    /// The columns of a table of them.
    const COLUMNS: &'static [&'static str];
    /// The names of a box's derivatives, in the order of [`derivatives`](Boxes::derivatives).
    const DERIVATIVE: &'static [&'static str];

    /// Checks a box of finite numbers; the error says what is wrong with it.
    fn check(self) -> Result<(), String> {
        Ok(())
    }

    /// The derivatives of a result with respect to this box, given those with respect to its numbers.
    fn derivatives(self, by: Self) -> Vec<Self::Scalar> {
        by.scalars()
    }

    /// The row of the library that computes a metric, or what [`rest`](Boxes::rest) needs.
    fn row(metric: Metric) -> Operation;

    /// A metric that no row computes: a function of two boxes and of the result of the row.
    fn rest(_metric: Metric) -> Option<Result<Rest<Self, Self::Scalar>, Error>> {
        None
    }
}

/// A score of two boxes and of another score of theirs, which is known.
pub type Rest<P, T> = Program<(P, P, T), T>;

impl<P: Boxes> Shape for P {
    fn is_header(names: &[String]) -> Result<bool, String> {
        input::names_columns(names, P::COLUMNS)
    }

    fn parse(fields: &[&str]) -> Result<Self, String> {
        if fields.len() != P::COLUMNS.len() {
            let wanted = P::COLUMNS.join(",");
            return Err(format!("{} fields where {wanted} is needed", fields.len()));
        }
        let mut numbers = Vec::with_capacity(fields.len());
        for (column, field) in P::COLUMNS.iter().zip(fields) {
            let number: P::Scalar = input::number(field, column)?;
            let is_size = matches!(*column, "w" | "h" | "dx" | "dy" | "dz");
            if is_size && number < P::Scalar::default() {
                return Err(format!("{column} is negative: `{field}`"));
            }
            numbers.push(number);
        }
        let shape = P::load(&numbers);
        shape.check()?;
        Ok(shape)
    }
}

/// The rows that go together.
#[derive(Clone, Debug)]
pub enum Which {
    /// Row i of both lists, of some rows.
    Aligned(Range<usize>),
    /// Every one of some rows of the first list with every one of some of the second.
    All([Range<usize>; 2]),
}

impl Which {
    /// The places of the pairs in both lists.
    pub fn places(&self) -> [Vec<usize>; 2] {
        match self {
            Which::Aligned(rows) => [rows.clone().collect(), rows.clone().collect()],
            Which::All([rows, columns]) => compute::places(rows, columns),
        }
    }
}

/// A score per pair, and if they were wanted its derivatives with respect to both boxes.
#[derive(Debug)]
pub struct Scores<P: Boxes> {
    pub values: Vec<P::Scalar>,
    pub derivatives: Option<[Vec<P>; 2]>,
}

/// The scores of pairs of two lists of boxes as numbers, with derivatives if they are wanted.
pub fn scores<P: Boxes>(
    metric: Metric,
    machine: &Machine,
    lists: [Rows<'_, P::Scalar>; 2],
    which: &Which,
    grad: bool,
) -> Result<Scores<P>, Failure> {
    let row = P::row(metric);
    let mode = if grad { Mode::ValueGrad } else { Mode::Value };
    let Some(function) = row.function::<P::Scalar>(mode) else {
        return Err(Failure::Work(format!("{} takes paths", row.name)));
    };
    let found = match which {
        Which::Aligned(rows) => compute::of_rows(&function, machine, lists, rows)?,
        Which::All(block) => compute::of_all(&function, machine, lists, block)?,
    };
    let mut found = found.into_iter();
    let values = found.next().unwrap_or_default();
    let by = [found.next(), found.next()].map(|numbers| {
        let numbers = numbers.unwrap_or_default();
        numbers.chunks_exact(P::LEN).map(P::load).collect()
    });
    let known = Scores {
        values,
        derivatives: grad.then_some(by),
    };
    match P::rest(metric) {
        Some(program) => on_scores(&program?, lists, which, known),
        None => Ok(known),
    }
}

/// The scores of a program of two boxes and a score of theirs that is known, with its derivatives.
fn on_scores<P: Boxes>(
    program: &Rest<P, P::Scalar>,
    lists: [Rows<'_, P::Scalar>; 2],
    which: &Which,
    known: Scores<P>,
) -> Result<Scores<P>, Failure> {
    let places = which.places();
    let [a, b] = [0, 1].map(|k| {
        let numbers = lists[k].numbers();
        let own = places[k].iter();
        let own = own.map(|&row| P::load(&numbers[row * P::LEN..(row + 1) * P::LEN]));
        own.collect::<Vec<P>>()
    });
    let columns = (&a, &b, &known.values);
    let Some(by_known) = known.derivatives else {
        let values = Cpu::new().aligned(program, columns)?;
        return Ok(Scores {
            values,
            derivatives: None,
        });
    };
    let (values, (by_a, by_b, along)) = Cpu::new().aligned(&program.value_grad(), columns)?;
    let [known_a, known_b] = by_known;
    let derivatives = [(known_a, by_a), (known_b, by_b)].map(|(known, own)| {
        let all = known.into_iter().zip(own).zip(&along);
        all.map(|((known, own), &along)| sum(known, along, own))
            .collect()
    });
    Ok(Scores {
        values,
        derivatives: Some(derivatives),
    })
}

/// `x · factor + y`, number by number.
fn sum<P: Boxes>(x: P, factor: P::Scalar, y: P) -> P {
    let (mut x, y) = (x.scalars(), y.scalars());
    for (x, y) in x.iter_mut().zip(y) {
        *x = *x * factor + y;
    }
    P::load(&x)
}
