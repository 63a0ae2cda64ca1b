//! The rows as untyped values for the harness, the fuzzer, tests and benches.
//!
//! A program that uses them compiles every row with its tests, and should do so in one place.
use crate::ad::check::{Report, Sampling};
use crate::ad::sample::drawn::Kinship;
use crate::ad::sample::{Draw, Family, Sample, random};
use crate::error::{Error, Field};
use crate::kernels::Backend;
use crate::kernels::call::search::HintedSearch;
use crate::kernels::check::proofs::Proofs;
use crate::kernels::check::{
    Folded, LineCode, LineProperties, ScalarCode, WithAdjoint, check_fold_on, check_fold_with,
    check_search_proved, examined,
};
use crate::kernels::dynamic::{self, Operation};
use crate::kernels::fuzz::{self, Fuzzed, Job, LineSource, fuzzed_in};
use crate::kernels::ops;
use crate::kernels::ops::walk::{Walk, Written};
use crate::kernels::row::fold::{Fold, by_hand, fold};
use crate::kernels::row::item::{Item, item_of};
use crate::kernels::row::op::Op;
use crate::scalar::real::in_format;
use crate::{Fixed, Pack, Real};
use std::fmt;
use std::sync::OnceLock;

/// Shader sources, each with its name.
pub type Shaders = Result<Vec<(String, String)>, Error>;

/// A row of the library, with the source of its inputs and its tests.
///
/// An input is a list of numbers: its shapes one after another, each with its scalars and then its codes, and last the
/// vertices of a path.
#[derive(Clone, Copy)]
pub struct Tested {
    /// The row.
    pub operation: Operation,
    inputs: RowInputs,
    single: RowInFormat<f32>,
    double: RowInFormat<f64>,
    shaders: fn(&Operation) -> Shaders,
}

impl fmt::Debug for Tested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Tested").field(&self.operation.name).finish()
    }
}

/// The inputs of a row.
#[derive(Clone, Copy)]
struct RowInputs {
    random: fn(&mut Draw) -> Vec<f64>,
    ordinary: fn(&mut Draw) -> Vec<f64>,
    hard: fn() -> Vec<Vec<f64>>,
    show: fn(&[f64]) -> String,
    kinship: Kinship,
    name: fn(usize) -> Field,
}

/// A row in one format.
struct RowInFormat<S: Real> {
    code: ScalarCode<S>,
    check: fn(&Tested, &Sampling<'_>, Option<Backend<'_>>) -> Result<Report, Error>,
    fuzz: fn(&Tested, u64, u64) -> Fuzzed,
}

impl<S: Real> Clone for RowInFormat<S> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: Real> Copy for RowInFormat<S> {}

impl Tested {
    /// Returns the name of its function.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.operation.declared.name
    }
    /// Runs every check of the harness. With a backend, its batches are further witnesses of `f32`. Searches and folds
    /// have none.
    ///
    /// # Errors
    ///
    /// The errors of the backend.
    pub fn check<S: Real>(
        &self,
        plan: &Sampling<'_>,
        backend: Option<Backend<'_>>,
    ) -> Result<Report, Error> {
        (self.formed::<S>().check)(self, plan, backend)
    }
    /// Fuzzes it with `count` inputs from a seed.
    #[must_use]
    pub fn fuzz<S: Real>(&self, count: u64, seed: u64) -> Fuzzed {
        (self.formed::<S>().fuzz)(self, count, seed)
    }
    /// Returns the result of one input by the function itself.
    #[must_use]
    pub fn alone<S: Real>(&self, x: &[S]) -> Vec<S> {
        (self.formed::<S>().code.alone)(x)
    }
    /// Returns the result and the derivatives by hand, from a cotangent; `None` without them.
    #[must_use]
    pub fn by_hand<S: Real>(&self, x: &[S], out_bar: &[S]) -> Option<(Vec<S>, Vec<S>)> {
        (self.formed::<S>().code.by_hand)(x, out_bar)
    }
    /// Returns a random input.
    #[must_use]
    pub fn random(&self, draw: &mut Draw) -> Vec<f64> {
        (self.inputs.random)(draw)
    }
    /// Returns a random input of about unit size near the origin.
    #[must_use]
    pub fn ordinary(&self, draw: &mut Draw) -> Vec<f64> {
        (self.inputs.ordinary)(draw)
    }
    /// Returns the hard cases of its shapes, in which geometry often fails.
    #[must_use]
    pub fn hard(&self) -> Vec<Vec<f64>> {
        (self.inputs.hard)()
    }
    /// Returns an input as code.
    #[must_use]
    pub fn show(&self, x: &[f64]) -> String {
        (self.inputs.show)(x)
    }
    /// Returns every shader that it can need; a search has none of its own.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    pub fn shaders(&self) -> Shaders {
        (self.shaders)(&self.operation)
    }

    fn formed<S: Real>(&self) -> &RowInFormat<S> {
        in_format([&self.single, &self.double])
    }
    fn stated(&self) -> LineProperties {
        LineProperties {
            declared: self.operation.declared,
            output_kinds: self.operation.kinds[1],
        }
    }
    fn examined<S: Real>(&self) -> Option<LineCode<S>> {
        Some(LineCode {
            recording: self.operation.straight::<S>()?,
            code: self.formed::<S>().code,
        })
    }
}

/// Checks a straight line.
fn check_straight<S: Real>(
    row: &Tested,
    plan: &Sampling<'_>,
    backend: Option<Backend<'_>>,
) -> Result<Report, Error> {
    match (row.examined::<S>(), row.examined::<f64>()) {
        (Some(own), Some(wide)) => {
            let kin = (row.inputs.kinship, row.inputs.name);
            let others = rows().iter().map(|row| &row.operation);
            let proofs = Proofs::<S>::of(&row.operation, others);
            let proof = |x: &[f64]| proofs.as_ref()?.at(x, &[]);
            let plan = &Sampling {
                proof: plan.proof.or(Some(&proof)),
                ..*plan
            };
            examined::<S>(&row.stated(), kin, &own, &wide, (plan, backend, true))
        }
        _ => unreachable!("a straight line is checked as one"),
    }
}

/// Checks a search.
fn check_search<D: HintedSearch, S: Real>(
    row: &Tested,
    plan: &Sampling<'_>,
    _: Option<Backend<'_>>,
) -> Result<Report, Error>
where
    D::In<f64>: Sample,
    D::Out<f64>: Sample,
{
    let others = rows().iter().map(|row| &row.operation);
    let proofs = Proofs::<S>::of(&row.operation, others);
    Ok(check_search_proved::<D, S>(plan, proofs.as_ref()))
}

/// Fuzzes a straight line.
fn fuzz_straight<S: Real>(row: &Tested, count: u64, seed: u64) -> Fuzzed {
    let Some(LineCode { recording, code }) = row.examined::<S>() else {
        unreachable!("a straight line is fuzzed as one")
    };
    let operation = &row.operation;
    let job = Job::of_line(&LineSource {
        declared: operation.declared,
        op: operation.name,
        recording,
        alone: code.alone,
        by_hand: code.by_hand,
        kinds: operation.kinds[0],
        sample: row.inputs.random,
        show: row.inputs.show,
    });
    fuzzed_in::<S>()(&job, count, seed)
}

impl RowInputs {
    /// Returns the inputs of one type.
    const fn of<X: Sample + Item>() -> Self {
        RowInputs {
            random: fuzz::sampled::<X>,
            ordinary: |draw| fuzz::all_numbers(&Family::Ordinary.draw::<X>(draw)),
            hard: || X::hard().iter().map(fuzz::all_numbers).collect(),
            show: fuzz::shown::<X>,
            kinship: Kinship::of::<X>(),
            name: X::name,
        }
    }
    /// Returns inputs with a path, and with a context if it has one.
    const fn of_path<X: Sample>() -> Self {
        RowInputs {
            random: |draw| random::<X>(draw).scalars(),
            ordinary: |draw| Family::Ordinary.draw::<X>(draw).scalars(),
            hard: || X::hard().iter().map(Pack::scalars).collect(),
            show: |x| format!("{x:?}"),
            kinship: Kinship::of::<X>(),
            // The numbers of a path have no names.
            name: f64::name,
        }
    }
}

/// A list of rows, filled by the walk over all rows.
struct RowList(Vec<Tested>);

impl Walk for RowList {
    fn straight<O: Op>(&mut self, row: Written)
    where
        O::In<f32>: Item<Scalar = f32>,
        O::Out<f32>: Item<Scalar = f32>,
        O::In<f64>: Item<Scalar = f64> + Sample,
        O::Out<f64>: Item<Scalar = f64> + Sample,
    {
        const fn formed<O: Op, S: Real>() -> RowInFormat<S>
        where
            O::In<S>: Item<Scalar = S>,
            O::Out<S>: Item<Scalar = S>,
            O::In<f64>: Sample,
        {
            RowInFormat {
                code: ScalarCode::of::<O>(),
                check: check_straight::<S>,
                fuzz: fuzz_straight::<S>,
            }
        }
        self.0.push(Tested {
            operation: const { dynamic::straight::<O>() }.written(row),
            ..const {
                Tested {
                    operation: dynamic::straight::<O>(),
                    inputs: RowInputs::of::<O::In<f64>>(),
                    single: formed::<O, f32>(),
                    double: formed::<O, f64>(),
                    shaders: Operation::shaders,
                }
            }
        });
    }
    fn search<D: HintedSearch>(&mut self, row: Written)
    where
        D::In<f32>: Item<Scalar = f32>,
        D::Out<f32>: Item<Scalar = f32>,
        D::In<f64>: Item<Scalar = f64> + Sample,
        D::Out<f64>: Item<Scalar = f64> + Sample,
    {
        const fn formed<D: HintedSearch, S: Real>() -> RowInFormat<S>
        where
            D::In<S>: Item<Scalar = S>,
            D::Out<S>: Item<Scalar = S>,
            D::In<f64>: Item<Scalar = f64> + Sample,
            D::Out<f64>: Sample,
        {
            RowInFormat {
                code: ScalarCode {
                    alone: |x| {
                        let input = item_of::<D::In<S>>(x);
                        let (record, hints) = D::decide_with_hints::<S>(input);
                        D::replay_with_hints::<S>(input, record, hints).scalars()
                    },
                    by_hand: |_, _| None,
                    num_dual: None,
                },
                check: check_search::<D, S>,
                fuzz: |_, count, seed| fuzz::decided::<D, S>(count, seed),
            }
        }
        self.0.push(Tested {
            operation: const { dynamic::search::<D>() }.written(row),
            inputs: const { RowInputs::of::<D::In<f64>>() },
            single: const { formed::<D, f32>() },
            double: const { formed::<D, f64>() },
            shaders: |_| Ok(Vec::new()),
        });
    }
    fn fold<F: Fold>(&mut self, row: Written)
    where
        F::Context<f32>: Item<Scalar = f32>,
        F::Out<f32>: Item<Scalar = f32>,
        F::Context<f64>: Item<Scalar = f64> + Sample,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
        F::Out<f64>: Item<Scalar = f64> + Sample,
    {
        const fn formed<F: Fold, S: Real>(
            check: fn(&Tested, &Sampling<'_>, Option<Backend<'_>>) -> Result<Report, Error>,
        ) -> RowInFormat<S>
        where
            F::Context<S>: Item<Scalar = S>,
            F::Context<f64>: Item<Scalar = f64> + Sample,
            F::Element<f64>: Sample,
            Vec<F::Element<f64>>: Sample,
            F::Out<f64>: Sample,
        {
            RowInFormat {
                code: ScalarCode {
                    alone: |x| {
                        let (context, vertices) = x.split_at(F::Context::<S>::LEN);
                        let path = vertices.chunks_exact(F::Element::<S>::LEN);
                        let path = path.map(F::Element::<S>::load).collect();
                        Folded::<F>::eval::<S>(&(F::Context::load(context), path)).scalars()
                    },
                    by_hand: |x, out_bar| {
                        let (context, vertices) = x.split_at(F::Context::<S>::LEN);
                        let path = vertices.chunks_exact(F::Element::<S>::LEN);
                        let path: Vec<F::Element<S>> = path.map(F::Element::<S>::load).collect();
                        let bars = by_hand::<F, S>(&path, F::Out::<S>::load(out_bar))?;
                        let value = fold::<F, S>(F::Context::load(context), &path);
                        Some((value.scalars(), bars))
                    },
                    num_dual: None,
                },
                check,
                fuzz: |_, count, seed| fuzz::fold::<F, S>(count, seed),
            }
        }
        self.0.push(Tested {
            operation: const { dynamic::fold::<F>() }.written(row),
            inputs: const { RowInputs::of_path::<(F::Context<f64>, Vec<F::Element<f64>>)>() },
            single: const {
                formed::<F, f32>(|_, plan, backend| match backend {
                    Some(backend) => check_fold_on::<F>(backend, plan),
                    None => Ok(check_fold_with::<F, f32>(plan)),
                })
            },
            double: const { formed::<F, f64>(|_, plan, _| Ok(check_fold_with::<F, f64>(plan))) },
            shaders: |_| crate::kernels::gpu::fold_sources(F::default()),
        });
    }
}

/// Returns every row of the library, in the order of [`operations`](crate::kernels::dynamic::operations).
// Inlined, so that the calling crate compiles the rows.
#[inline]
#[must_use]
pub fn rows() -> &'static [Tested] {
    static ALL: OnceLock<Vec<Tested>> = OnceLock::new();
    ALL.get_or_init(|| {
        let mut all = RowList(Vec::new());
        ops::each(&mut all);
        all.0
    })
}
