//! The forms of a row as functions of plain numbers.
//!
//! Code generic over an operation only loads, calls and flattens: it is compiled for every row and format.
use crate::print;
use geograd::ad::forward::First;
use geograd::kernels::dynamic::{Mode, Operation, Rows, Sort, operation};
use geograd::kernels::reduce::Best;
use geograd::kernels::{HintedSearch, Op, Single};
use geograd::{Error, Fixed, Jet, Pack, Real, Scalar};

/// A format that batches serve.
pub trait Format: Real + Single<Scalar = Self> + Into<f64> {
    const NAME: &'static str;
}
impl Format for f32 {
    const NAME: &'static str = "f32";
}
impl Format for f64 {
    const NAME: &'static str = "f64";
}

/// A number rounded to a format.
pub fn round<S: Format>(x: f64) -> f64 {
    S::lit(x).into()
}

/// The results of a form of one item, from its numbers and a cotangent.
pub type OfItem = fn(&[f64], &[f64]) -> Vec<f64>;
/// The results of forms of all items together.
pub type Batch = fn(&Given) -> Vec<Found>;
/// A form and its results.
pub type Found = (&'static str, Result<Vec<f64>, Error>);

/// The arguments of a batch: inputs, and a cotangent for each.
pub struct Given {
    /// The name of the row.
    pub row: &'static str,
    pub inputs: Vec<Vec<f64>>,
    pub cotangents: Vec<Vec<f64>>,
}

impl Given {
    pub fn new(row: &'static str, inputs: Vec<Vec<f64>>, outputs: usize) -> Self {
        let cotangents = print::cotangents(inputs.len(), outputs);
        Given {
            row,
            inputs,
            cotangents,
        }
    }
    /// Hashes of the inputs, of items and of batches, or of what a batch is refused with. A form without any number
    /// is none.
    pub fn forms(&self, items: &[(&'static str, OfItem)], batch: Batch) -> Vec<(String, u64)> {
        let mut all = vec![("inputs", Ok(self.inputs.concat()))];
        for (form, item) in items {
            let given = self.inputs.iter().zip(&self.cotangents);
            let found = given.flat_map(|(x, bar)| item(x, bar));
            all.push((form, Ok(found.collect())));
        }
        all.extend(batch(self));
        let hash = |(form, found): Found| match found {
            Ok(numbers) if numbers.is_empty() => None,
            Ok(numbers) => Some((form.to_owned(), print::of_numbers(&numbers))),
            Err(error) => Some((
                format!("{form}_refused"),
                print::of_text(&error.to_string()),
            )),
        };
        all.into_iter().filter_map(hash).collect()
    }
}

/// A shape of numbers, and codes after them.
pub fn load<P: Fixed<Scalar: Scalar>>(x: &[f64]) -> P {
    let (numbers, codes) = x.split_at(P::LEN);
    let numbers: Vec<P::Scalar> = numbers.iter().map(|&x| Scalar::lit(x)).collect();
    let codes: Vec<u32> = codes.iter().map(|&x| x as u32).collect();
    P::load(&numbers).load_codes(&codes)
}
pub fn load_all<P: Fixed<Scalar: Scalar>>(all: &[Vec<f64>]) -> Vec<P> {
    all.iter().map(|x| load(x)).collect()
}
/// The numbers of a shape, and its codes after them.
pub fn flat<P: Fixed<Scalar: Into<f64>>>(shape: &P) -> Vec<f64> {
    let mut all: Vec<f64> = shape.scalars().into_iter().map(Into::into).collect();
    all.extend(shape.codes().into_iter().map(f64::from));
    all
}
/// All derivatives of a function of so many numbers by duals, after its value.
pub fn jacobian<S: Format>(x: &[f64], f: &dyn Fn(&[First<S>]) -> Vec<First<S>>) -> Vec<f64> {
    let (mut values, mut derivatives) = (Vec::new(), Vec::new());
    let width = First::<S>::zero().derivative.len();
    for first in (0..x.len().max(1)).step_by(width) {
        let numbers = x.iter().enumerate();
        let jets: Vec<First<S>> = numbers
            .map(|(i, &x)| Jet::variable(S::lit(x), i.wrapping_sub(first)))
            .collect();
        let found = f(&jets);
        let used = (x.len() - first).min(width);
        values = found.iter().map(|jet| jet.value.into()).collect();
        derivatives.extend(found.iter().flat_map(|jet| jet.derivative[..used].to_vec()));
    }
    values.extend(derivatives.into_iter().map(Into::into));
    values
}

/// The function on plain numbers.
pub fn scalar<O: Op, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    flat(&O::eval(load::<O::In<S>>(x)))
}
/// The function on duals.
pub fn duals<O: Op, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    jacobian::<S>(x, &|x| O::eval(O::In::load(x)).scalars())
}
/// The adjoint by hand, if there is one.
pub fn by_hand<O: Op, S: Format>(x: &[f64], bar: &[f64]) -> Vec<f64> {
    match O::adjoint(load::<O::In<S>>(x), load::<O::Out<S>>(bar)) {
        Some((value, bars)) => [flat(&value), flat(&bars)].concat(),
        None => Vec::new(),
    }
}
/// A search and its replay on plain numbers.
pub fn replayed<D: HintedSearch, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    let x = load::<D::In<S>>(x);
    let (record, hints) = D::decide_with_hints::<S>(x);
    flat(&D::replay_with_hints::<S>(x, record, hints))
}
/// A search on plain numbers and its replay on duals.
pub fn replayed_duals<D: HintedSearch, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    let shape = load::<D::In<S>>(x);
    let codes = shape.codes();
    let (record, hints) = D::decide_with_hints::<S>(shape);
    // Constants: no derivative is by them.
    let hints: Vec<First<S>> = hints
        .scalars()
        .into_iter()
        .map(First::<S>::from_primal)
        .collect();
    jacobian::<S>(&x[..D::In::<S>::LEN], &|x| {
        let moved = D::In::load(x).load_codes(&codes);
        D::replay_with_hints::<First<S>>(moved, record, Fixed::load(&hints)).scalars()
    })
}

/// Results of a batch as numbers, column by column.
pub trait Flat {
    fn flat(&self, all: &mut Vec<f64>);
}
impl<P: Fixed<Scalar: Into<f64>>> Flat for Vec<P> {
    fn flat(&self, all: &mut Vec<f64>) {
        self.iter().for_each(|shape| all.extend(flat(shape)));
    }
}
macro_rules! flats {
    ($($($name:ident)*;)*) => { $(
        impl<$($name: Flat),*> Flat for ($($name,)*) {
            #[allow(non_snake_case)]
            fn flat(&self, all: &mut Vec<f64>) {
                let ($($name,)*) = self;
                $($name.flat(all);)*
            }
        }
    )* };
}
flats!(A B; A B C; A B C D; A B C D E; A B C D E F;);

/// The forms of a batch of what is of fixed size, those that it has.
pub fn batches<S: Format>(given: &Given) -> Vec<Found> {
    let operation = operation(given.row).expect("the row is in the list");
    let rounded = |all: &[Vec<f64>]| -> Vec<Vec<S>> {
        let one = |x: &Vec<f64>| x.iter().map(|&x| S::lit(x)).collect();
        all.iter().map(one).collect()
    };
    let (inputs, mut bars) = (rounded(&given.inputs), rounded(&given.cotangents));
    let layouts = operation.layouts::<S>();
    let fields: Vec<usize> = layouts.iter().map(|layout| layout.fields()).collect();
    let codes: Vec<usize> = layouts.iter().map(|layout| layout.codes()).collect();
    let columns = |inputs: &[Vec<S>]| columns(inputs, &fields, &codes);
    let aligned = |mode: Mode, bars: Option<&[Vec<S>]>| -> Result<Vec<f64>, Error> {
        let function = operation.function::<S>(mode).expect("is of fixed size");
        let mut lists = columns(&inputs);
        lists.extend(bars.map(<[Vec<S>]>::concat));
        let takes = function.takes().into_iter();
        let takes = takes.map(|(_, layout)| layout.fields());
        let rows: Vec<_> = lists
            .iter()
            .zip(takes)
            .map(|(x, n)| Rows::new(x, n))
            .collect();
        Ok(wide(&function.aligned(&rows)?.concat()))
    };
    let mut all = vec![
        ("aligned", aligned(Mode::Value, None)),
        ("aligned_vjp", aligned(Mode::Vjp, Some(&bars))),
    ];
    // Some cotangents are too large for compiled kernels.
    for bar in bars.iter_mut().step_by(9) {
        bar.fill(S::lit(1e30));
    }
    all.push(("aligned_vjp_large", aligned(Mode::Vjp, Some(&bars))));
    let is_number = operation.value_grad::<S>().is_some();
    if is_number {
        all.push(("aligned_value_grad", aligned(Mode::ValueGrad, None)));
    }
    if operation.sort == Sort::Straight && fields.len() == 2 {
        let step = inputs.len().div_ceil(SIDE).max(1);
        let some: Vec<Vec<S>> = inputs.iter().step_by(step).cloned().collect();
        let lists = columns(&some);
        let (a, b) = (
            Rows::new(&lists[0], fields[0]),
            Rows::new(&lists[1], fields[1]),
        );
        all.extend(pairs(operation, is_number, a, b, some.len()));
    }
    all
}

/// The most shapes of a list whose pairs are formed.
const SIDE: usize = 45;

/// Every shape of a list with every one of another; of one number as result reductions and sums of derivatives, too.
fn pairs<S: Format>(
    operation: &Operation,
    is_number: bool,
    a: Rows<'_, S>,
    b: Rows<'_, S>,
    side: usize,
) -> Vec<Found> {
    let run = operation.value::<S>().expect("is of fixed size");
    let planes = run.all_pairs(a, b).map(|planes| wide(&planes));
    let mut all = vec![("all_pairs", planes)];
    if !is_number {
        return all;
    }
    let graded = operation
        .function::<S>(Mode::ValueGrad)
        .expect("is of fixed size");
    let bars = print::cotangents(1, side * side).concat();
    let bars: Vec<S> = bars.into_iter().map(S::lit).collect();
    let pulled = run.all_pairs_vjp(a, b, &bars);
    let best = |found: Result<Vec<Best<S>>, Error>| {
        let pair = |best: &Best<S>| [best.value.into(), best.index as f64];
        found.map(|all| all.iter().flat_map(pair).collect())
    };
    let above = run.above(a, b, S::lit(0.25)).map(|all| {
        let found = all.iter();
        found
            .flat_map(|x| [x.row as f64, x.column as f64, x.value.into()])
            .collect()
    });
    let summed = run.sum_grad(a, b).map(|(sum, a_bar, b_bar)| {
        let mut all = wide(&[a_bar, b_bar].concat());
        all.push(sum);
        all
    });
    all.extend([
        (
            "all_pairs_value_grad",
            graded.all_pairs(a, b).map(|planes| wide(&planes)),
        ),
        ("all_pairs_vjp", pulled.map(|(a, b)| wide(&[a, b].concat()))),
        ("row_max", best(run.row_max(a, b))),
        ("column_max", best(run.column_max(a, b))),
        ("above", above),
        ("sum_grad", summed),
    ]);
    all
}

/// Inputs, of which codes follow all scalars, as columns, in which they follow those of their shape.
fn columns<S: Format>(inputs: &[Vec<S>], fields: &[usize], codes: &[usize]) -> Vec<Vec<S>> {
    let scalars: usize = fields.iter().sum::<usize>() - codes.iter().sum::<usize>();
    let mut columns = vec![Vec::new(); fields.len()];
    for input in inputs {
        let (mut own, mut whole) = input.split_at(scalars);
        for ((column, fields), codes) in columns.iter_mut().zip(fields).zip(codes) {
            let (some, others) = own.split_at(fields - codes);
            let (few, rest) = whole.split_at(*codes);
            column.extend_from_slice(some);
            column.extend_from_slice(few);
            (own, whole) = (others, rest);
        }
    }
    columns
}
fn wide<S: Format>(numbers: &[S]) -> Vec<f64> {
    numbers.iter().map(|&x| x.into()).collect()
}
