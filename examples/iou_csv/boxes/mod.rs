//! Boxes: their columns, and the scores of many pairs of them.
mod plane;
mod space;

use crate::input::{self, Shape};
use crate::metric::Metric;
use crate::number::Number;
use geograd::kernels::Runs;
use geograd::kernels::item::Single;
use geograd::kernels::op::ValueGrad;
use geograd::kernels::{Backend, Cpu, Table};
use geograd::{Error, Program};

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
        backend: Backend<'_>,
        pairs: Pairs<'_, Self>,
        grad: bool,
    ) -> Result<Scores<Self>, Error>;
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

/// Which boxes go with which.
#[derive(Clone, Copy, Debug)]
pub enum Pairs<'a, P> {
    /// Box i of both lists.
    Aligned(&'a [P], &'a [P]),
    /// Every one of the first list with every one of the second.
    All(&'a [P], &'a [P]),
}

impl<P: Copy> Pairs<'_, P> {
    /// The pairs one after another, as two lists.
    fn listed(self) -> (Vec<P>, Vec<P>) {
        match self {
            Pairs::Aligned(a, b) => (a.to_vec(), b.to_vec()),
            Pairs::All(a, b) => (
                a.iter().flat_map(|x| b.iter().map(|_| *x)).collect(),
                a.iter().flat_map(|_| b).copied().collect(),
            ),
        }
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

    pub fn from_table(table: &Table<(P::Scalar, (P, P))>) -> Self {
        let mut scores = Self::with_derivatives(Vec::new(), Vec::new(), Vec::new());
        let Some([a_bar, b_bar]) = &mut scores.derivatives else {
            return scores;
        };
        for row in 0..table.rows() {
            for column in 0..table.columns() {
                let (value, (by_a, by_b)) = table.at(row, column);
                scores.values.push(value);
                a_bar.push(by_a);
                b_bar.push(by_b);
            }
        }
        scores
    }
}

/// The scores of an operation of two boxes.
pub fn on_cpu<P: Boxes, O>(op: O, pairs: Pairs<'_, P>, grad: bool) -> Result<Scores<P>, Error>
where
    O: Runs<(P, P), Out = P::Scalar> + Copy,
{
    let cpu = Cpu::new();
    match pairs {
        Pairs::Aligned(a, b) if grad => {
            let (values, (a_bar, b_bar)) = cpu.aligned(ValueGrad::of(op), (a, b))?;
            Ok(Scores::with_derivatives(values, a_bar, b_bar))
        }
        Pairs::Aligned(a, b) => Ok(Scores::new(cpu.aligned(op, (a, b))?)),
        Pairs::All(a, b) if grad => Ok(Scores::from_table(&cpu.all_pairs(
            ValueGrad::of(op),
            a,
            b,
        )?)),
        Pairs::All(a, b) => Ok(Scores::new(cpu.all_pairs(op, a, b)?.into_planes())),
    }
}

/// The scores of a program of two boxes and a score of theirs that is known, with its derivatives.
fn on_scores<P: Boxes>(
    program: &Program<(P, P, P::Scalar), P::Scalar>,
    pairs: Pairs<'_, P>,
    known: Scores<P>,
) -> Result<Scores<P>, Error> {
    let cpu = Cpu::new();
    let (a, b) = pairs.listed();
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
