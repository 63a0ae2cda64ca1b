//! Batches as witnesses: what a [`Backend`] answers, beside what everybody else says.
//!
//! ```
//! use geograd::ad::check::Sampling;
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, Iou, RowOf, check::check_on};
//! // Of the hard cases every hundredth.
//! let plan = Sampling { hard: 100, ..Sampling::new(10, 1) };
//! // Backend::Gpu(&gpu) asks a GPU.
//! let report = check_on::<RowOf<Iou, (Obb2<f64>, Obb2<f64>)>>(Backend::Cpu, &plan)?;
//! assert!(report.passed(), "{report}");
//! # Ok::<(), geograd::Error>(())
//! ```
use crate::Error;
use crate::kernels::Backend;
use crate::kernels::cpu::plan::{self, Face, Want};
#[cfg(feature = "gpu")]
use crate::kernels::gpu::Generated;
use crate::kernels::gpu::GpuRing;
use crate::kernels::item::{Item, Single};
use crate::kernels::op::{self, Op, RingOp, Runs};
use crate::{Fixed, Pack, Vec2};
use std::cell::Cell;
use std::collections::HashMap;
use std::sync::Arc;

/// What a batch says about one input.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The value.
    pub value: Vec<f64>,
    /// The derivatives of every output.
    pub rows: Vec<Vec<f64>>,
}

impl Answer {
    /// The derivatives of `y_bar · value`.
    #[must_use]
    pub fn derivatives(&self, y_bar: &[f64]) -> Vec<f64> {
        let count = self.rows.first().map_or(0, Vec::len);
        let derivative = |i| self.rows.iter().zip(y_bar).map(|(row, y)| row[i] * y).sum();
        (0..count).map(derivative).collect()
    }
}

/// Something that answers many inputs, given as lists of numbers, at once.
pub type Ask<'a> = &'a dyn Fn(&[Vec<f32>]) -> Result<Vec<Answer>, Error>;

/// Batches as witnesses, one of each form. Inputs known beforehand are asked about in one large batch, as users would;
/// others (shrunk ones, those beside a point) one by one.
pub struct Batch<'a> {
    asks: Vec<Ask<'a>>,
    /// What each form answered.
    known: Vec<HashMap<Vec<u32>, Answer>>,
    error: Cell<Option<Error>>,
}

fn single(x: &[f64]) -> Vec<f32> {
    x.iter().map(|&x| x as f32).collect()
}
fn key(x: &[f32]) -> Vec<u32> {
    x.iter().map(|x| x.to_bits()).collect()
}
fn widened(list: &[f32]) -> Vec<f64> {
    list.iter().map(|&x| f64::from(x)).collect()
}

impl<'a> Batch<'a> {
    /// Witnesses that have been asked about all these inputs.
    ///
    /// # Errors
    ///
    /// As the batches'.
    pub fn new(asks: Vec<Ask<'a>>, inputs: &[Vec<f64>]) -> Result<Self, Error> {
        let inputs: Vec<Vec<f32>> = inputs.iter().map(|x| single(x)).collect();
        let answers =
            |ask: &Ask<'_>| Ok(inputs.iter().map(|x| key(x)).zip(ask(&inputs)?).collect());
        Ok(Batch {
            known: asks.iter().map(answers).collect::<Result<_, Error>>()?,
            asks,
            error: Cell::new(None),
        })
    }
    /// How many forms there are.
    #[must_use]
    pub fn forms(&self) -> usize {
        self.asks.len()
    }
    /// What a form says about an input; nothing after an error, which [`error`](Batch::error) keeps.
    #[must_use]
    pub fn about(&self, form: usize, x: &[f64]) -> Option<Answer> {
        let x = single(x);
        if let Some(known) = self.known.get(form)?.get(&key(&x)) {
            return Some(known.clone());
        }
        if self.error.get().is_some() {
            return None;
        }
        match self.asks[form](&[x]) {
            Ok(answers) => answers.into_iter().next(),
            Err(error) => {
                self.error.set(Some(error));
                None
            }
        }
    }
    /// The first error, if there was one.
    #[must_use]
    pub fn error(&self) -> Option<Error> {
        self.error.get()
    }
}

/// Inputs that all pairs are asked about at a time: of their square only the diagonal says something.
const SIDE: usize = 64;

/// Asks a backend about two shapes by all pairs: values from the matrix, derivatives from the adjoint of an upstream
/// that counts every row with its own column alone. Inputs whose derivatives would meet infinite ones of a row with
/// another column, which are none of theirs, are asked about by themselves.
pub(crate) fn ask_pairs<O, A, B>(
    backend: Backend<'_>,
    inputs: &[Vec<f32>],
) -> Result<Vec<Answer>, Error>
where
    O: Default + Runs<(A, B), Out = f32>,
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    let mut answers: Vec<Answer> = Vec::with_capacity(inputs.len());
    for inputs in inputs.chunks(SIDE) {
        let first = answers.len();
        let split = |x: &Vec<f32>| (A::load(&x[..A::LEN]), B::load(&x[A::LEN..]));
        let (a, b): (Vec<A>, Vec<B>) = inputs.iter().map(split).unzip();
        let side = a.len();
        let mut own = vec![0.0; side * side];
        own.iter_mut().step_by(side + 1).for_each(|x| *x = 1.0);
        let values = backend.all_pairs(O::default(), &a, &b)?;
        let (by_a, by_b) = backend.all_pairs_vjp(O::default(), &a, &b, &own)?;
        answers.extend(
            by_a.iter()
                .zip(&by_b)
                .enumerate()
                .map(|(i, (a, b))| Answer {
                    value: widened(&[values.at(i, i)]),
                    rows: vec![widened(&[a.scalars(), b.scalars()].concat())],
                }),
        );
        let is_finite = |answer: &Answer| answer.rows[0].iter().all(|x| x.is_finite());
        for (input, answer) in inputs.iter().zip(&mut answers[first..]) {
            if side > 1 && !is_finite(answer) {
                let alone = ask_pairs::<O, A, B>(backend, std::slice::from_ref(input))?;
                *answer = alone.into_iter().next().unwrap_or(answer.clone());
            }
        }
    }
    Ok(answers)
}

/// Asks a backend about any operation, one call per output for the derivatives.
pub(crate) fn ask_any<O: Op>(
    backend: Backend<'_>,
    inputs: &[Vec<f32>],
) -> Result<Vec<Answer>, Error>
where
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    let run = O::default();
    let shapes: Vec<O::In<f32>> = inputs.iter().map(|x| O::In::<f32>::load(x)).collect();
    let values = backend.rows(run, &shapes[..])?;
    let mut answers: Vec<Answer> = values
        .iter()
        .map(|value| Answer {
            value: widened(value),
            rows: Vec::new(),
        })
        .collect();
    let outputs = O::Out::<f32>::LEN;
    for j in 0..outputs {
        let seed: Vec<f32> = (0..outputs).map(|k| f32::from(u8::from(j == k))).collect();
        let seeds = vec![O::Out::<f32>::load(&seed); inputs.len()];
        let bars = backend.rows(run.vjp(), (&shapes[..], &seeds[..]))?;
        for (answer, bar) in answers.iter_mut().zip(&bars) {
            answer.rows.push(widened(bar));
        }
    }
    Ok(answers)
}

/// Asks a backend about an operation with one number as result, by the kernel that computes it with its gradient;
/// nothing of others.
pub(crate) fn ask_gradient<O: Op>(
    backend: Backend<'_>,
    inputs: &[Vec<f32>],
) -> Result<Vec<Answer>, Error>
where
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    if O::Out::<f32>::LEN != 1 {
        return Ok(Vec::new());
    }
    let shapes: Vec<O::In<f32>> = inputs.iter().map(|x| O::In::<f32>::load(x)).collect();
    let all = backend.rows(AnyGradient(O::default()), &shapes[..])?;
    let answer = |numbers: Vec<f32>| Answer {
        value: widened(&numbers[..1]),
        rows: vec![widened(&numbers[1..])],
    };
    Ok(all.into_iter().map(answer).collect())
}

/// [`ValueGrad`](crate::kernels::op::ValueGrad) of an operation of which only its length says that its result is a
/// number.
struct AnyGradient<O>(O);

impl<O, R: Item> Runs<R> for AnyGradient<O>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item<Scalar = R::Scalar>,
{
    type Out = (O::Out<R::Scalar>, R);
    fn face(&self, ask: op::Ask) -> Result<Arc<Face<R::Scalar>>, Error> {
        plan::face_of::<O, R>(Want::ValueGrad, ask.framed)
    }
    #[cfg(feature = "gpu")]
    fn generated(&self, ask: op::Ask) -> Result<Arc<Generated<R::Scalar>>, Error> {
        plan::generated_of::<O, R>(Want::ValueGrad, ask.framed)
    }
}

/// Asks a backend about rings, one call per output for the derivatives.
pub(crate) fn ask_rings<O: GpuRing>(
    backend: Backend<'_>,
    inputs: &[Vec<f32>],
) -> Result<Vec<Answer>, Error> {
    let mut offsets = vec![0];
    let mut vertices = Vec::new();
    for x in inputs {
        vertices.extend(x.chunks_exact(2).map(|p| Vec2::new(p[0], p[1])));
        offsets.push(vertices.len());
    }
    let values = backend.ragged(O::default(), &vertices, &offsets)?;
    let mut answers: Vec<Answer> = values
        .iter()
        .map(|value| Answer {
            value: widened(&value.scalars()),
            rows: Vec::new(),
        })
        .collect();
    let outputs = <O as RingOp>::Out::<f32>::LEN;
    for j in 0..outputs {
        let seed: Vec<f32> = (0..outputs).map(|k| f32::from(u8::from(j == k))).collect();
        let seeds = vec![<O as RingOp>::Out::<f32>::load(&seed); inputs.len()];
        let bars = backend.ragged_vjp(O::default(), &vertices, &offsets, &seeds)?;
        for (answer, bounds) in answers.iter_mut().zip(offsets.windows(2)) {
            let ring = bars[bounds[0]..bounds[1]].iter();
            answer
                .rows
                .push(ring.flat_map(|p| [p.x.into(), p.y.into()]).collect());
        }
    }
    Ok(answers)
}
