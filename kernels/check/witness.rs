//! Batches as witnesses: results of a [`Backend`] that the harness compares with all others.
//!
//! ```
//! use geograd::ad::check::Sampling;
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, Iou, RowOf, check::check_on};
//! // Of the hard cases every hundredth.
//! let plan = Sampling { hard: 100, ..Sampling::new(10, 1) };
//! // Backend::Gpu(&gpu) takes a GPU.
//! let report = check_on::<RowOf<Iou, (Obb2<f64>, Obb2<f64>)>>(Backend::Cpu, &plan)?;
//! assert!(report.passed(), "{report}");
//! # Ok::<(), geograd::Error>(())
//! ```
use super::with_adjoint::context_and_path;
use crate::Error;
use crate::kernels::Backend;
use crate::kernels::call::recording::Recording;
use crate::kernels::dynamic::{Function, Layout, Rows};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::Item;
use crate::{Fixed, Pack};
use std::cell::Cell;
use std::collections::HashMap;
use std::sync::Arc;

/// The results of a batch for one input.
#[derive(Clone, Debug)]
pub struct BatchResult {
    /// The value.
    pub value: Vec<f64>,
    /// The derivatives of every output.
    pub rows: Vec<Vec<f64>>,
}

impl BatchResult {
    /// Returns the derivatives of `y_bar · value`.
    #[must_use]
    pub fn derivatives(&self, y_bar: &[f64]) -> Vec<f64> {
        let count = self.rows.first().map_or(0, Vec::len);
        let derivative = |i| self.rows.iter().zip(y_bar).map(|(row, y)| row[i] * y).sum();
        (0..count).map(derivative).collect()
    }
}

/// A function from many inputs, lists of numbers, to their results on a machine.
pub type ByMachine<'a> = &'a dyn Fn(&[Vec<f32>]) -> Result<Vec<BatchResult>, Error>;

/// Batches as witnesses, one of each form. Inputs known beforehand are computed in one large batch, as users would.
/// Others (shrunk ones, neighbours of a point) are computed one by one.
pub struct Batch<'a> {
    asks: Vec<ByMachine<'a>>,
    /// The results so far, for each form.
    known: Vec<HashMap<Vec<u32>, BatchResult>>,
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
    /// Creates witnesses and computes the results of all these inputs.
    ///
    /// # Errors
    ///
    /// The errors of the batches.
    pub fn new(asks: Vec<ByMachine<'a>>, inputs: &[Vec<f64>]) -> Result<Self, Error> {
        let inputs: Vec<Vec<f32>> = inputs.iter().map(|x| single(x)).collect();
        let answers =
            |ask: &ByMachine<'_>| Ok(inputs.iter().map(|x| key(x)).zip(ask(&inputs)?).collect());
        Ok(Batch {
            known: asks.iter().map(answers).collect::<Result<_, Error>>()?,
            asks,
            error: Cell::new(None),
        })
    }
    /// Returns the number of forms.
    #[must_use]
    pub fn forms(&self) -> usize {
        self.asks.len()
    }
    /// Returns the result of a form for an input; `None` after an error, which [`error`](Batch::error) returns.
    #[must_use]
    pub fn about(&self, form: usize, x: &[f64]) -> Option<BatchResult> {
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
    /// Returns the first error, if there was one.
    #[must_use]
    pub fn error(&self) -> Option<Error> {
        self.error.get()
    }
}

/// The number of inputs in one batch of all pairs, of which only the diagonal is used.
const SIDE: usize = 64;

/// Returns the columns of a function's arguments from the numbers of every input.
fn columns(function: &Function<f32>, inputs: &[Vec<f32>]) -> Vec<(Vec<f32>, usize)> {
    let mut from = 0;
    let column = |(_, layout): (_, Layout<f32>)| {
        let own = from..from + layout.fields();
        from = own.end;
        let rows = inputs.iter().flat_map(|x| x[own.clone()].iter().copied());
        (rows.collect(), layout.fields())
    };
    function.takes().into_iter().map(column).collect()
}

/// Returns the results of a function of columns on a backend, item by item.
fn asked(
    backend: Backend<'_>,
    function: &Function<f32>,
    inputs: &[Vec<f32>],
) -> Result<Vec<Vec<f64>>, Error> {
    let columns = columns(function, inputs);
    let rows: Vec<_> = columns.iter().map(|(x, n)| Rows::new(x, *n)).collect();
    let lists = function.on(backend)?.aligned(&rows)?;
    let gives = function.gives();
    let item = |i: usize| {
        let lists = lists.iter().zip(&gives);
        lists
            .flat_map(|(list, n)| widened(&list[i * n..][..*n]))
            .collect()
    };
    Ok((0..inputs.len()).map(item).collect())
}

/// Computes two shapes by all pairs on a backend: values from the matrix, derivatives from the adjoint of an upstream
/// that is one on the diagonal. Inputs with infinite derivatives elsewhere in their row or column are computed alone.
/// Returns nothing for other operations.
pub(crate) fn ask_pairs(
    backend: Backend<'_>,
    recording: &Arc<Recording<f32>>,
    inputs: &[Vec<f32>],
) -> Result<Vec<BatchResult>, Error> {
    let function = Function::of_straight(Arc::clone(recording), Mode::Value);
    let mut answers: Vec<BatchResult> = Vec::with_capacity(inputs.len());
    if recording.outputs != [1] || function.takes().len() != 2 {
        return Ok(answers);
    }
    for inputs in inputs.chunks(SIDE) {
        let first = answers.len();
        let side = inputs.len();
        let lists = columns(&function, inputs);
        let [(a, a_fields), (b, b_fields)] = &lists[..] else {
            return Ok(answers);
        };
        let (a, b) = (Rows::new(a, *a_fields), Rows::new(b, *b_fields));
        let mut own = vec![0.0; side * side];
        own.iter_mut().step_by(side + 1).for_each(|x| *x = 1.0);
        let values = function.on(backend)?.all_pairs(a, b)?;
        let (by_a, by_b) = function.on(backend)?.all_pairs_vjp(a, b, &own)?;
        let derivatives = by_a
            .chunks_exact(*a_fields)
            .zip(by_b.chunks_exact(*b_fields));
        answers.extend(derivatives.enumerate().map(|(i, (a, b))| BatchResult {
            value: widened(&values[i * (side + 1)..][..1]),
            rows: vec![widened(&[a, b].concat())],
        }));
        let is_finite = |answer: &BatchResult| answer.rows[0].iter().all(|x| x.is_finite());
        for (input, answer) in inputs.iter().zip(&mut answers[first..]) {
            if side > 1 && !is_finite(answer) {
                let alone = ask_pairs(backend, recording, std::slice::from_ref(input))?;
                *answer = alone.into_iter().next().unwrap_or(answer.clone());
            }
        }
    }
    Ok(answers)
}

/// Computes any operation on a backend, with one call per output for the derivatives.
pub(crate) fn ask_any(
    backend: Backend<'_>,
    recording: &Arc<Recording<f32>>,
    inputs: &[Vec<f32>],
) -> Result<Vec<BatchResult>, Error> {
    let values = asked(
        backend,
        &Function::of_straight(Arc::clone(recording), Mode::Value),
        inputs,
    )?;
    let alone = |value| BatchResult {
        value,
        rows: Vec::new(),
    };
    let mut answers: Vec<BatchResult> = values.into_iter().map(alone).collect();
    let (adjoint, outputs) = (
        Function::of_straight(Arc::clone(recording), Mode::Vjp),
        recording.outputs.iter().sum::<usize>(),
    );
    for j in 0..outputs {
        let seed = (0..outputs).map(|k| f32::from(u8::from(j == k)));
        let seeded = |x: &Vec<f32>| x.iter().copied().chain(seed.clone()).collect();
        let inputs: Vec<Vec<f32>> = inputs.iter().map(seeded).collect();
        let bars = asked(backend, &adjoint, &inputs)?;
        for (answer, bar) in answers.iter_mut().zip(bars) {
            answer.rows.push(bar);
        }
    }
    Ok(answers)
}

/// Computes an operation of one number on a backend, by the kernel of the value with its gradient; nothing for others.
pub(crate) fn ask_gradient(
    backend: Backend<'_>,
    recording: &Arc<Recording<f32>>,
    inputs: &[Vec<f32>],
) -> Result<Vec<BatchResult>, Error> {
    if recording.outputs != [1] {
        return Ok(Vec::new());
    }
    let function = Function::of_straight(Arc::clone(recording), Mode::ValueGrad);
    let answer = |numbers: Vec<f64>| BatchResult {
        value: numbers[..1].to_vec(),
        rows: vec![numbers[1..].to_vec()],
    };
    let all = asked(backend, &function, inputs)?;
    Ok(all.into_iter().map(answer).collect())
}

/// Computes folds over paths on a backend, with one call per output for the derivatives.
pub(crate) fn ask_folds<F: Fold>(
    backend: Backend<'_>,
    inputs: &[Vec<f32>],
) -> Result<Vec<BatchResult>, Error>
where
    F::Context<f32>: Item<Scalar = f32>,
{
    let own = F::Context::<f32>::LEN;
    let mut offsets = vec![0];
    let (mut contexts, mut vertices) = (Vec::new(), Vec::new());
    for x in inputs {
        let (context, path) = context_and_path::<F, f32>(x);
        contexts.push(context);
        vertices.extend(path);
        offsets.push(vertices.len());
    }
    let values = backend.fold(F::default(), &contexts, &vertices, &offsets)?;
    let mut answers: Vec<BatchResult> = values
        .iter()
        .map(|value| BatchResult {
            value: widened(&value.scalars()),
            rows: Vec::new(),
        })
        .collect();
    let outputs = F::Out::<f32>::LEN;
    for j in 0..outputs {
        let seed: Vec<f32> = (0..outputs).map(|k| f32::from(u8::from(j == k))).collect();
        let seeds = vec![F::Out::<f32>::load(&seed); inputs.len()];
        let (by_context, by_vertex) =
            backend.fold_vjp(F::default(), &contexts, &vertices, &offsets, &seeds)?;
        for (i, answer) in answers.iter_mut().enumerate() {
            let mut row = by_context.get(i).map_or(Vec::new(), Pack::scalars);
            row.truncate(own);
            for bar in &by_vertex[offsets[i]..offsets[i + 1]] {
                row.extend(bar.scalars());
            }
            answer.rows.push(widened(&row));
        }
    }
    Ok(answers)
}
