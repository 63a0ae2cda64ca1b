//! Untyped operations of any sort, so that the fuzzer is compiled once.
use super::arguments::InputColumns;
use super::rules::Rules;
use crate::ad::declared::Kind;
use crate::ad::program::recorded::Recorded;
use crate::ad::sample::{Draw, Sample, random};
use crate::error::Error;
use crate::kernels::Cpu;
use crate::kernels::call::modes::recording_of;
use crate::kernels::call::recording::{Call, Recording};
use crate::kernels::call::search::{self, HintedSearch};
use crate::kernels::check::{Folded, WithAdjoint};
use crate::kernels::cpu::aligned::{checked, compute};
use crate::kernels::cpu::pairs::{self, Pairs};
use crate::kernels::cpu::plan::{Plan, Shapes, plan};
use crate::kernels::machine::Column;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::fold::{Fold, by_hand, fold};
use crate::kernels::row::item::rows::numbers;
use crate::kernels::row::item::{Item, Leaf, Target, item_of, leaves_of};
use crate::kernels::row::op::{Declared, Op};
use crate::{Fixed, Pack, Real};
use std::sync::Arc;

/// The numbers of results, a list for each of their shapes.
pub(super) type ResultLists<T> = Vec<Vec<T>>;
type Compute<T, const N: usize> =
    Box<dyn Fn(&InputColumns<T>, [&[Vec<T>]; N]) -> Result<ResultLists<T>, Error> + Sync>;

/// One shape of an input.
pub(super) struct InputShape<T> {
    pub leaf: Leaf<T>,
    pub kinds: Vec<Kind>,
    pub rules: Rules,
}

/// An operation in one format.
pub struct Job<T: Real> {
    /// The name of the operation's type.
    pub(super) op: &'static str,
    pub(super) shapes: Vec<InputShape<T>>,
    /// The kinds of the input scalars. Vertices are listed separately.
    pub(super) kinds: Vec<Kind>,
    /// The kinds of the scalars of a vertex, if an input has a path.
    pub(super) vertex: Vec<Kind>,
    /// The number of scalars of every shape of a result.
    pub(super) outputs: Vec<usize>,
    pub(super) declared: &'static Declared,
    /// A batch of results.
    pub(super) values: Compute<T, 0>,
    /// A batch of derivatives from cotangents.
    pub(super) derivatives: Compute<T, 1>,
    /// A batch of results of one number with their derivatives.
    pub(super) both: Option<Compute<T, 0>>,
    /// The results of all pairs of some shapes.
    pub(super) square: Option<Square<T>>,
    /// The scalar code of the result.
    pub(super) alone: fn(&[T]) -> Vec<T>,
    /// The scalar code of derivatives by hand.
    pub(super) by_hand: fn(&[T], &[T]) -> Option<(Vec<T>, Vec<T>)>,
    /// The recorded function.
    pub(super) recorded: Option<Arc<Recorded>>,
    pub(super) sample: fn(&mut Draw) -> Vec<f64>,
    pub(super) show: fn(&[f64]) -> String,
}

/// A straight line in one format, with the source of its inputs.
pub(crate) struct LineSource<T: Real> {
    pub(crate) declared: &'static Declared,
    pub(crate) op: &'static str,
    pub(crate) recording: Arc<Recording<T>>,
    pub(crate) alone: fn(&[T]) -> Vec<T>,
    pub(crate) by_hand: fn(&[T], &[T]) -> Option<(Vec<T>, Vec<T>)>,
    pub(crate) kinds: fn() -> Vec<Kind>,
    pub(crate) sample: fn(&mut Draw) -> Vec<f64>,
    pub(crate) show: fn(&[f64]) -> String,
}

/// A computation of all pairs of the shapes with some indices.
pub(super) type Square<T> =
    Box<dyn Fn(&InputColumns<T>, std::ops::Range<usize>) -> Result<Vec<T>, Error> + Sync>;

/// Returns the last part of a type's name.
fn short(name: &'static str) -> &'static str {
    let end = name.find('<').unwrap_or(name.len());
    let start = name[..end].rfind("::").map_or(0, |at| at + 2);
    &name[start..]
}

/// Returns the scalars and codes of a shape, in the order of columns.
pub(crate) fn all_numbers<X: Item>(x: &X) -> Vec<X::Scalar> {
    if const { X::CODES == 0 } {
        return x.scalars();
    }
    let mut all = vec![X::Scalar::default(); leaves_of::<X>().iter().map(|leaf| leaf.fields).sum()];
    x.to_row(x, &mut &mut all[..]);
    all
}

pub(crate) fn sampled<X: Sample + Item>(draw: &mut Draw) -> Vec<f64> {
    all_numbers(&random::<X>(draw))
}

pub(crate) fn shown<X: Sample + Item>(numbers: &[f64]) -> String {
    format!("{:?}", item_of::<X>(numbers))
}

/// Returns the shapes of an input, with their rules.
fn shapes<T: Real>(leaves: Vec<Leaf<T>>, kinds: &[Kind]) -> Vec<InputShape<T>> {
    let mut rest = kinds;
    let shape = |leaf: Leaf<T>| {
        let (own, others) = rest.split_at(leaf.fields - leaf.codes);
        rest = others;
        let kinds = [own, &vec![Kind::Number; leaf.codes]].concat();
        InputShape {
            rules: Rules::of(&leaf),
            leaf,
            kinds,
        }
    };
    leaves.into_iter().map(shape).collect()
}

/// Returns the kinds of the scalars of a shape.
fn kinds_of<X: Sample + Fixed>() -> Vec<Kind> {
    X::filled(1.0).kinds()
}

/// A function from a mode and a form (aligned, or all pairs) to its plan.
type PlanOf<T> = Arc<dyn Fn(Mode, bool) -> Result<Arc<Plan<T>>, Error> + Send + Sync>;

fn planned<T: Real>(recording: &Arc<Recording<T>>) -> PlanOf<T> {
    let call = Call::of(Arc::clone(recording));
    Arc::new(move |mode, framed| plan(&call.clone().derived(mode)?, framed))
}

/// Returns the computation of results by a plan of a mode.
fn computed<T: Real, const N: usize>(make: &PlanOf<T>, mode: Mode) -> Compute<T, N> {
    let make = Arc::clone(make);
    Box::new(move |inputs, bars| {
        // The plan is made at the first call.
        let plan = &make(mode, false)?;
        let columns = plan.arguments.iter().zip(&inputs.columns);
        let mut columns: Vec<Column<'_, T>> = columns
            .map(|(argument, numbers)| Column::lent(numbers, argument.fields, Some(inputs.count)))
            .collect();
        for bars in bars.iter().flat_map(|bars| bars.iter()) {
            columns.push(Column::lent(
                bars,
                bars.len() / inputs.count,
                Some(inputs.count),
            ));
        }
        run_columns(plan, columns)
    })
}

/// Returns the computation of all pairs by a plan of two shapes.
fn squared<T: Real>(plan: impl Fn() -> Result<Arc<Plan<T>>, Error> + Sync + 'static) -> Square<T> {
    Box::new(move |inputs, items| {
        let plan = plan()?;
        let part = |k: usize| {
            let n = plan.arguments[k].fields;
            &inputs.columns[k][items.start * n..items.end * n]
        };
        let columns =
            [0, 1].map(|k| Column::lent(part(k), plan.arguments[k].fields, Some(items.len())));
        let pairs = Pairs {
            plan: &plan,
            shapes: columns.each_ref().map(Shapes::of),
            rare: [true; 2],
            filter: true,
        };
        let mut planes = vec![T::zero(); items.len() * items.len() * plan.made()];
        pairs::planes(&pairs, &mut planes);
        Ok(planes)
    })
}

impl<T: Real> Job<T> {
    /// Returns the job of an operation of fixed size.
    pub(super) fn of_op<O: Op>() -> Self
    where
        O::In<T>: Item<Scalar = T>,
        O::Out<T>: Item<Scalar = T>,
        O::In<f64>: Sample + Item<Scalar = f64>,
    {
        Job::of_line(&LineSource {
            declared: const { &O::DECLARED },
            op: short(std::any::type_name::<O>()),
            recording: recording_of::<O, O::In<T>>(),
            alone: |x| O::eval(O::In::<T>::load(x)).scalars(),
            by_hand: |x, out_bar| {
                let (value, bars) = O::adjoint(O::In::<T>::load(x), O::Out::<T>::load(out_bar))?;
                Some((value.scalars(), bars.scalars()))
            },
            kinds: kinds_of::<O::In<f64>>,
            sample: sampled::<O::In<f64>>,
            show: shown::<O::In<f64>>,
        })
    }

    /// Returns the job of an untyped straight line.
    pub(crate) fn of_line(line: &LineSource<T>) -> Self {
        let recording = &line.recording;
        let outputs = recording.outputs.clone();
        let is_number = outputs == [1];
        let (kinds, leaves) = ((line.kinds)(), recording.takes.clone());
        let make = planned(recording);
        Job {
            op: line.op,
            square: (leaves.len() == 2).then(|| {
                let mode = match is_number {
                    true => Mode::ValueGrad,
                    false => Mode::Value,
                };
                let make = make.clone();
                squared(move || make(mode, true))
            }),
            shapes: shapes(leaves, &kinds),
            kinds,
            vertex: Vec::new(),
            outputs,
            declared: line.declared,
            values: computed(&make, Mode::Value),
            derivatives: computed(&make, Mode::Vjp),
            both: is_number.then(|| computed(&make, Mode::ValueGrad)),
            alone: line.alone,
            by_hand: line.by_hand,
            recorded: recording.program(Mode::Value).ok(),
            sample: line.sample,
            show: line.show,
        }
    }

    /// Returns the job of an operation with a search.
    pub(super) fn of_search<D: HintedSearch>() -> Self
    where
        D::In<T>: Item<Scalar = T>,
        D::Out<T>: Item<Scalar = T>,
        D::In<f64>: Sample + Item<Scalar = f64>,
    {
        let is_number = D::Out::<T>::LEN == 1;
        let mut kinds = Vec::new();
        let scalars = kinds_of::<D::In<f64>>();
        let mut rest = &scalars[..];
        // The codes of a shape follow its scalars.
        for leaf in leaves_of::<D::In<T>>() {
            let (own, others) = rest.split_at(leaf.fields - leaf.codes);
            kinds.extend_from_slice(own);
            kinds.resize(kinds.len() + leaf.codes, Kind::Number);
            rest = others;
        }
        let make = planned(&search::recording::<D, D::In<T>>());
        Job {
            op: short(std::any::type_name::<D>()),
            shapes: shapes(leaves_of::<D::In<T>>(), &scalars),
            kinds,
            vertex: Vec::new(),
            outputs: leaves_of::<D::Out<T>>()
                .iter()
                .map(|leaf| leaf.fields)
                .collect(),
            declared: const { &D::DECLARED },
            values: computed(&make, Mode::Value),
            derivatives: computed(&make, Mode::Vjp),
            both: is_number.then(|| computed(&make, Mode::ValueGrad)),
            square: None,
            alone: |x| {
                let input = item_of::<D::In<T>>(x);
                let (record, hints) = D::decide_with_hints::<T>(input);
                D::replay_with_hints::<T>(input, record, hints).scalars()
            },
            by_hand: |_, _| None,
            recorded: None,
            sample: sampled::<D::In<f64>>,
            show: shown::<D::In<f64>>,
        }
    }

    /// Returns the job of a fold over a path.
    pub(super) fn of_fold<F: Fold>() -> Self
    where
        F::Context<T>: Item<Scalar = T>,
        F::Context<f64>: Sample + Item<Scalar = f64>,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
    {
        let kinds = kinds_of::<F::Context<f64>>();
        Job {
            op: short(std::any::type_name::<F>()),
            shapes: shapes(leaves_of::<F::Context<T>>(), &kinds),
            kinds,
            vertex: kinds_of::<F::Element<f64>>(),
            outputs: vec![F::Out::<T>::LEN],
            declared: const { &F::DECLARED },
            values: Box::new(|inputs, []| {
                let contexts = contexts::<F, T>(inputs);
                let vertices = loaded::<F::Element<T>>(&inputs.vertices);
                let (run, offsets) = (F::default(), &inputs.offsets);
                let values =
                    Cpu::new().fold::<F, _, F::Element<T>>(run, &contexts, &vertices, offsets)?;
                Ok(vec![numbers(&values).into_owned()])
            }),
            derivatives: Box::new(|inputs, [bars]| {
                let (contexts, bars) = (contexts::<F, T>(inputs), loaded::<F::Out<T>>(&bars[0]));
                let vertices = loaded::<F::Element<T>>(&inputs.vertices);
                let (run, offsets) = (F::default(), &inputs.offsets);
                let derivatives = Cpu::new()
                    .fold_vjp::<F, _, F::Element<T>>(run, &contexts, &vertices, offsets, &bars)?;
                let own = (F::Context::<T>::LEN > 0).then(|| numbers(&derivatives.0).into_owned());
                Ok(own
                    .into_iter()
                    .chain([numbers(&derivatives.1).into_owned()])
                    .collect())
            }),
            both: None,
            square: None,
            alone: |x| {
                let (context, vertices) = x.split_at(F::Context::<T>::LEN);
                let path = loaded::<F::Element<T>>(vertices);
                Folded::<F>::eval::<T>(&(F::Context::load(context), path)).scalars()
            },
            by_hand: |x, out_bar| {
                let path = loaded::<F::Element<T>>(x.get(F::Context::<T>::LEN..)?);
                let bars = by_hand::<F, T>(&path, F::Out::load(out_bar))?;
                Some((fold::<F, T>(F::Context::load(x), &path).scalars(), bars))
            },
            recorded: None,
            sample: |draw| random::<(F::Context<f64>, Vec<F::Element<f64>>)>(draw).scalars(),
            show: |x| {
                let (context, vertices) = x.split_at(F::Context::<f64>::LEN);
                format!(
                    "({:?}, vec!{:?})",
                    F::Context::<f64>::load(context),
                    loaded::<F::Element<f64>>(vertices)
                )
            },
        }
    }
}

fn contexts<F: Fold, T: Real>(inputs: &InputColumns<T>) -> Vec<F::Context<T>>
where
    F::Context<T>: Item<Scalar = T>,
{
    let mut all = Vec::new();
    for row in context_rows(inputs).chunks_exact(F::Context::<T>::LEN.max(1)) {
        all.push(F::Context::<T>::load(row));
    }
    all.resize(inputs.count, F::Context::<T>::filled(T::default()));
    all
}

/// Returns the numbers of all shapes of a context, context by context.
fn context_rows<T: Real>(inputs: &InputColumns<T>) -> Vec<T> {
    let mut all = Vec::new();
    for i in 0..inputs.count {
        for column in &inputs.columns {
            let fields = column.len() / inputs.count;
            all.extend_from_slice(&column[i * fields..][..fields]);
        }
    }
    all
}

fn loaded<P: Fixed>(numbers: &[P::Scalar]) -> Vec<P> {
    // A loop, since every adapter of an iterator would be compiled for every shape.
    let mut all = Vec::new();
    for own in numbers.chunks_exact(P::LEN) {
        all.push(P::load(own));
    }
    all
}

/// Returns the results for columns of shapes and cotangents: a list of numbers for every shape of a result.
fn run_columns<T: Real>(plan: &Plan<T>, columns: Vec<Column<'_, T>>) -> Result<Vec<Vec<T>>, Error> {
    let (count, rare) = checked(plan, &columns)?;
    let lists = plan.gives.iter().map(|n| vec![T::default(); n * count]);
    let mut lists: Vec<Vec<T>> = lists.collect();
    let targets = lists.iter_mut().zip(&plan.gives);
    let targets = targets.map(|(list, &fields)| Some(Target::of_rows(list, fields)));
    compute(plan, &columns, rare, count, targets.collect());
    Ok(lists)
}
