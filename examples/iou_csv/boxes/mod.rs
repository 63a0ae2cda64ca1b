//! Boxes: their columns, and the scores of many pairs of them.
mod plane;
mod space;

use crate::input::{self, Shape};
use crate::metric::Metric;
use crate::number::Number;
use common::cli::{Failure, Machine};
use common::compute;
use geograd::Program;
use geograd::kernels::Cpu;
use geograd::kernels::dynamic::{Mode, Operation, Rows};
use geograd::kernels::item::Single;
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

    /// Shows the derivatives of a result with respect to this box, given those with respect to its numbers.
    fn derivatives(self, by: Self, show: &mut dyn FnMut(Self::Scalar));

    /// The scores of pairs, with derivatives if they are wanted.
    fn scores(
        metric: Metric,
        machine: &Machine,
        pairs: &Pairs<'_, Self::Scalar>,
        grad: bool,
    ) -> Result<Scores<Self>, Failure>;
}

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

/// Pairs of two lists of boxes as numbers.
#[derive(Clone, Debug)]
pub struct Pairs<'a, T> {
    pub lists: [Rows<'a, T>; 2],
    pub which: Which,
}

impl<T: Number> Pairs<'_, T> {
    /// The places of the pairs in both lists.
    pub fn places(&self) -> [Vec<usize>; 2] {
        match &self.which {
            Which::Aligned(rows) => [rows.clone().collect(), rows.clone().collect()],
            Which::All([rows, columns]) => compute::places(rows, columns),
        }
    }
    /// The boxes of the pairs, as two lists.
    fn listed<P: Boxes<Scalar = T>>(&self) -> [Vec<P>; 2] {
        let places = self.places();
        [0, 1].map(|k| {
            let (all, fields) = (self.lists[k].numbers(), self.lists[k].fields());
            let own = places[k].iter();
            own.map(|&row| P::load(&all[row * fields..(row + 1) * fields]))
                .collect()
        })
    }
}

/// A score per pair, and if they were wanted its derivatives with respect to both boxes.
#[derive(Debug)]
pub struct Scores<P: Boxes> {
    pub values: Vec<P::Scalar>,
    pub derivatives: Option<[Vec<P>; 2]>,
}

impl<P: Boxes> Scores<P> {
    pub fn new(values: Vec<P::Scalar>) -> Self {
        Scores {
            values,
            derivatives: None,
        }
    }

    pub fn with_derivatives(values: Vec<P::Scalar>, a_bar: Vec<P>, b_bar: Vec<P>) -> Self {
        Scores {
            values,
            derivatives: Some([a_bar, b_bar]),
        }
    }
}

/// The scores of a row of two boxes.
pub fn of_row<P: Boxes>(
    row: &Operation,
    machine: &Machine,
    pairs: &Pairs<'_, P::Scalar>,
    grad: bool,
) -> Result<Scores<P>, Failure> {
    let mode = if grad { Mode::ValueGrad } else { Mode::Value };
    let Some(function) = row.function::<P::Scalar>(mode) else {
        return Err(Failure::Work(format!("{} takes paths", row.name)));
    };
    let lists = match &pairs.which {
        Which::Aligned(rows) => compute::of_rows(&function, machine, pairs.lists, rows)?,
        Which::All(block) => compute::of_all(&function, machine, pairs.lists, block)?,
    };
    let shapes =
        |numbers: &[P::Scalar]| -> Vec<P> { numbers.chunks_exact(P::LEN).map(P::load).collect() };
    let mut lists = lists.into_iter();
    let values = lists.next().unwrap_or_default();
    Ok(match (lists.next(), lists.next()) {
        (Some(a_bar), Some(b_bar)) => {
            Scores::with_derivatives(values, shapes(&a_bar), shapes(&b_bar))
        }
        _ => Scores::new(values),
    })
}

/// The row of a verb for two boxes of a kind.
macro_rules! row {
    ($verb:ident, $shape:ident) => {
        const {
            geograd::kernels::dynamic::straight::<
                geograd::kernels::RowOf<
                    geograd::kernels::$verb,
                    (geograd::$shape<f64>, geograd::$shape<f64>),
                >,
            >()
        }
    };
}
use row;

/// The scores of a program of two boxes and a score of theirs that is known, with its derivatives.
fn on_scores<P: Boxes>(
    program: &Program<(P, P, P::Scalar), P::Scalar>,
    pairs: &Pairs<'_, P::Scalar>,
    known: Scores<P>,
) -> Result<Scores<P>, Failure> {
    let cpu = Cpu::new();
    let [a, b] = pairs.listed::<P>();
    let columns = (&a, &b, &known.values);
    let Some([mut known_a, mut known_b]) = known.derivatives else {
        return Ok(Scores::new(cpu.aligned(program, columns)?));
    };
    let (values, (a_bar, b_bar, along)) = cpu.aligned(&program.value_grad(), columns)?;
    for (known, own) in [(&mut known_a, a_bar), (&mut known_b, b_bar)] {
        for ((known, own), &along) in known.iter_mut().zip(own).zip(&along) {
            *known = sum(*known, along, own);
        }
    }
    Ok(Scores::with_derivatives(values, known_a, known_b))
}

/// `x · factor + y`, number by number.
fn sum<P: Boxes>(x: P, factor: P::Scalar, y: P) -> P {
    let (mut x, y) = (x.scalars(), y.scalars());
    for (x, y) in x.iter_mut().zip(y) {
        *x = *x * factor + y;
    }
    P::load(&x)
}
