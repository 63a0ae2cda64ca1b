//! The forms of a row as functions of plain numbers.
//!
//! What is generic over an operation only loads, calls and flattens: it is compiled for every row and format.
use crate::print;
use geograd::ad::forward::First;
use geograd::kernels::item::Results;
use geograd::kernels::op::{ValueGrad, Vjp};
use geograd::kernels::real::Real;
use geograd::kernels::{Columns, Cpu, Item, Op, Runs, Search, Single};
use geograd::{Error, Fixed, Jet, Pack, Scalar};
use std::marker::PhantomData;

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

/// What a batch is given: inputs, and a cotangent for each.
pub struct Given {
    pub inputs: Vec<Vec<f64>>,
    pub cotangents: Vec<Vec<f64>>,
}

impl Given {
    pub fn new(inputs: Vec<Vec<f64>>, outputs: usize) -> Self {
        let cotangents = print::cotangents(inputs.len(), outputs);
        Given { inputs, cotangents }
    }
    /// Hashes of the inputs, of items and of batches, or of what a batch is refused with. A form without any number
    /// is none.
    pub fn forms(&self, items: &[(&'static str, OfItem)], batches: &[Batch]) -> Vec<(String, u64)> {
        let mut all = vec![("inputs", Ok(self.inputs.concat()))];
        for (form, item) in items {
            let given = self.inputs.iter().zip(&self.cotangents);
            let found = given.flat_map(|(x, bar)| item(x, bar));
            all.push((form, Ok(found.collect())));
        }
        for batch in batches {
            all.extend(batch(self));
        }
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
pub fn replayed<D: Search, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    let x = load::<D::In<S>>(x);
    flat(&D::replay::<S>(x, D::decide::<S>(x)))
}
/// A search on plain numbers and its replay on duals.
pub fn replayed_duals<D: Search, S: Format>(x: &[f64], _: &[f64]) -> Vec<f64> {
    let shape = load::<D::In<S>>(x);
    let (record, codes) = (D::decide::<S>(shape), shape.codes());
    jacobian::<S>(&x[..D::In::<S>::LEN], &|x| {
        let moved = D::In::load(x).load_codes(&codes);
        D::replay::<First<S>>(moved, record).scalars()
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

fn numbers(many: &impl Flat) -> Vec<f64> {
    let mut all = Vec::new();
    many.flat(&mut all);
    all
}
fn aligned<C: Columns, R: Runs<C::Item>>(run: R, columns: C) -> Result<Vec<f64>, Error>
where
    <R::Out as Results>::Many: Flat,
{
    Ok(numbers(&Cpu::new().aligned(run, columns)?))
}

/// What runs in batches, what it takes and what it gives, by which the forms are found that it has: of a method
/// called on `&&&Of`, the implementation for what is behind more references comes first.
pub struct Of<R, X, Y>(PhantomData<(R, X, Y)>);

impl<R, X, Y> Of<R, X, Y> {
    pub const NEW: Self = Of(PhantomData);
}

/// Values and adjoints of items side by side.
pub fn items<R, X, Y>(given: &Given) -> Vec<Found>
where
    R: Runs<X, Out = Y> + Default,
    Vjp<R>: Runs<(X, Y), Out = X> + Default,
    X: Item<Scalar: Format, Many: Flat>,
    Y: Item<Scalar = X::Scalar, Many: Flat>,
{
    let inputs: Vec<X> = load_all(&given.inputs);
    let mut bars: Vec<Y> = load_all(&given.cotangents);
    let mut all = vec![
        ("aligned", aligned(R::default(), &inputs)),
        ("aligned_vjp", aligned(Vjp::default(), (&inputs, &bars))),
    ];
    // Some cotangents are too large for compiled kernels.
    for bar in bars.iter_mut().step_by(9) {
        *bar = Y::filled(Scalar::lit(1e30));
    }
    all.push((
        "aligned_vjp_large",
        aligned(Vjp::default(), (&inputs, &bars)),
    ));
    all
}

/// Values with gradients, for one number as result.
pub trait Gradients {
    fn gradients(&self) -> Option<Batch>;
}
impl<R, X, T> Gradients for &Of<R, X, T>
where
    ValueGrad<R>: Runs<X, Out = (T, X)> + Default,
    X: Item<Scalar = T, Many: Flat>,
    T: Format,
{
    fn gradients(&self) -> Option<Batch> {
        Some(|given| {
            let inputs: Vec<X> = load_all(&given.inputs);
            vec![(
                "aligned_value_grad",
                aligned(ValueGrad::<R>::default(), &inputs),
            )]
        })
    }
}
impl<R, X, Y> Gradients for Of<R, X, Y> {
    fn gradients(&self) -> Option<Batch> {
        None
    }
}

/// Every shape of a list with every one of another.
pub trait Pairs {
    fn pairs(&self) -> Option<Batch>;
}
/// Of one number as result: reductions and sums of derivatives, too.
impl<R, A, B, T> Pairs for &&Of<R, (A, B), T>
where
    R: Op<In<T> = (A, B), Out<T> = T>,
    A: Single<Scalar = T>,
    B: Single<Scalar = T>,
    T: Format,
{
    fn pairs(&self) -> Option<Batch> {
        Some(scores::<R, A, B, T>)
    }
}
impl<R, A, B, Y> Pairs for &Of<R, (A, B), Y>
where
    R: Op + Runs<(A, B), Out = Y>,
    A: Single<Scalar: Format>,
    B: Single<Scalar = A::Scalar>,
    Y: Item<Scalar = A::Scalar>,
{
    fn pairs(&self) -> Option<Batch> {
        Some(|given| {
            let (a, b) = lists::<A, B>(given);
            vec![("all_pairs", table::<R, A, B>(R::default(), &a, &b))]
        })
    }
}
impl<R, X, Y> Pairs for Of<R, X, Y> {
    fn pairs(&self) -> Option<Batch> {
        None
    }
}

/// The most shapes of a list whose pairs are formed.
const SIDE: usize = 45;

/// First and second shapes of some inputs.
fn lists<A, B>(given: &Given) -> (Vec<A>, Vec<B>)
where
    A: Fixed<Scalar: Format>,
    B: Fixed<Scalar = A::Scalar>,
{
    let step = given.inputs.len().div_ceil(SIDE).max(1);
    let both = given.inputs.iter().step_by(step).map(|x| load::<(A, B)>(x));
    both.unzip()
}
fn wide<S: Format>(numbers: &[S]) -> Vec<f64> {
    numbers.iter().map(|&x| x.into()).collect()
}
fn table<R, A, B>(run: R, a: &[A], b: &[B]) -> Result<Vec<f64>, Error>
where
    R: Runs<(A, B)>,
    A: Single<Scalar: Format>,
    B: Single<Scalar = A::Scalar>,
{
    Ok(wide(Cpu::new().all_pairs(run, a, b)?.planes()))
}
fn scores<R, A, B, T>(given: &Given) -> Vec<Found>
where
    R: Op<In<T> = (A, B), Out<T> = T>,
    A: Single<Scalar = T>,
    B: Single<Scalar = T>,
    T: Format,
{
    let ((a, b), run, cpu) = (lists::<A, B>(given), R::default(), Cpu::new());
    let both = |found: Result<(Vec<A>, Vec<B>), Error>| found.map(|bars| numbers(&bars));
    let bars = print::cotangents(1, a.len() * b.len()).concat();
    let bars: Vec<T> = bars.into_iter().map(T::lit).collect();
    let best = |found: Result<Vec<geograd::kernels::reduce::Best<T>>, Error>| {
        let pair =
            |best: &geograd::kernels::reduce::Best<T>| [best.value.into(), best.index as f64];
        found.map(|all| all.iter().flat_map(pair).collect())
    };
    let above = cpu.above(run, &a, &b, T::lit(0.25)).map(|all| {
        let found = all.iter();
        found
            .flat_map(|x| [x.row as f64, x.column as f64, x.value.into()])
            .collect()
    });
    let summed = cpu.sum_grad(run, &a, &b).map(|(sum, a_bar, b_bar)| {
        let mut all = numbers(&(a_bar, b_bar));
        all.push(sum);
        all
    });
    vec![
        ("all_pairs", table(run, &a, &b)),
        ("all_pairs_value_grad", table(run.value_grad(), &a, &b)),
        ("all_pairs_vjp", both(cpu.all_pairs_vjp(run, &a, &b, &bars))),
        ("row_max", best(cpu.row_max(run, &a, &b))),
        ("column_max", best(cpu.column_max(run, &a, &b))),
        ("above", above),
        ("sum_grad", summed),
    ]
}
