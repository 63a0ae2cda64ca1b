//! Operations and programs on a GPU, by WGSL functions written from their recordings.
mod aligned;
mod by_hand;
mod columns;
mod derivatives;
mod folds;
pub(crate) mod held;
mod instructions;
pub(crate) mod operation;
mod pairs;
pub(super) mod replays;
mod shader;
mod side;
mod suppress;
pub(super) mod template;
pub(super) mod text;
pub(super) mod uploaded;

use super::context::{SharedContext, locked};
use super::written::{SeedSource, Take, ring_source};
use crate::kernels::Fold;
use crate::kernels::call::folding;
use crate::kernels::call::modes::recording_of;
use crate::kernels::call::recording::{Call, Recording};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::Item;
use crate::kernels::row::op::Op;
use crate::{Error, Pack};
use operation::{Generated, ProgramName};
use std::sync::Arc;
use text::{KernelForm, Pipeline, SummedLists};
use uploaded::MOST_OPERATIONS;

impl SharedContext {
    /// Returns the pipeline of a generated kernel, compiled at the first call. It also drops the pipelines of programs
    /// that no longer exist.
    fn generated(
        &self,
        name: &ProgramName,
        form: KernelForm,
        text: impl FnOnce() -> String,
    ) -> wgpu::ComputePipeline {
        let mut pipelines = locked(&self.generated);
        let key = (*name.0, form);
        let place = match pipelines.get(&key) {
            Some((_, place)) => Pipeline::clone(place),
            None => {
                pipelines.retain(|_, (owner, _)| owner.strong_count() > 0);
                let place = Pipeline::default();
                pipelines.insert(key, (Arc::downgrade(&name.0), Pipeline::clone(&place)));
                place
            }
        };
        drop(pipelines);
        let pipeline = place.get_or_init(|| self.compiled("generated", form.entry(), text()));
        pipeline.clone()
    }
}

impl Generated<f32> {
    /// Returns the pipeline of a kernel around it.
    pub(super) fn pipeline(
        &self,
        inner: &SharedContext,
        form: KernelForm,
    ) -> wgpu::ComputePipeline {
        inner.generated(&self.name, form, || form.text(self))
    }
    /// Returns the largest number of pairs in a dispatch: an operating system resets a GPU after seconds of one
    /// dispatch.
    pub(super) fn most_pairs(&self) -> usize {
        MOST_OPERATIONS / self.bodies[0].operations.max(1)
    }
}

/// Returns every shader that an operation can need, with its name: for tests without a GPU.
///
/// # Errors
///
/// The errors of recording it.
#[doc(hidden)]
pub fn op_sources<O: Op>() -> Result<Vec<(String, String)>, Error>
where
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    sources(
        O::DECLARED.name,
        recording_of::<O, O::In<f32>>(),
        &Take::ALL,
    )
}

/// Returns the shaders of a straight line. Reductions have one template, so only one of them is included.
#[doc(hidden)]
pub fn line_sources(
    name: &str,
    recording: Arc<Recording<f32>>,
) -> Result<Vec<(String, String)>, Error> {
    sources(name, recording, &[Take::Best])
}

fn sources(
    name: &str,
    recording: Arc<Recording<f32>>,
    taken: &[Take],
) -> Result<Vec<(String, String)>, Error> {
    let outputs = recording.outputs.iter().sum();
    let modes: &[Mode] = match outputs {
        1 => &[Mode::Value, Mode::ValueGrad, Mode::Vjp],
        _ => &[Mode::Value, Mode::Vjp],
    };
    let mut all = Vec::new();
    let call = Call::of(recording);
    for &mode in modes {
        let call = call.clone().derived(mode)?;
        let made = call.generated(false)?;
        let mut add = |form: KernelForm, made: &Generated<f32>| {
            all.push((format!("{name} {mode:?} {form:?}"), form.text(made)));
        };
        add(KernelForm::Aligned, &made);
        add(KernelForm::Columns, &made);
        if made.arguments.len() != 2 {
            continue;
        }
        let made = call.generated(true)?;
        for (made, which) in [(Some(&made), ""), (made.extreme.as_ref(), " extreme")] {
            let Some(made) = made else { continue };
            for form in forms(mode, made, outputs, taken) {
                all.push((format!("{name} {mode:?} {form:?}{which}"), form.text(made)));
            }
        }
    }
    Ok(all)
}

/// Returns the forms of all pairs of a mode. Each template with a snippet for the seed occurs once.
fn forms(mode: Mode, made: &Generated<f32>, outputs: usize, taken: &[Take]) -> Vec<KernelForm> {
    let mut all = Vec::new();
    match mode {
        Mode::Value if made.gives == [1] => {
            all.push(KernelForm::Pairs);
            all.extend(taken.iter().map(|&take| KernelForm::Reduce(take, true)));
            // Reductions share one template around one body: it is tested once.
            if taken.len() > 1 {
                all.extend(Take::OF_GROUPS.map(|take| KernelForm::ReduceGroups(take, true)));
            }
            // The arguments may be two shapes of one list.
            if made.arguments[0].fields == made.arguments[1].fields {
                all.push(KernelForm::Masks);
            }
        }
        Mode::Value | Mode::ValueGrad | Mode::Jacobian => all.push(KernelForm::Pairs),
        Mode::Vjp if outputs == 1 && made.kind.is_some() => {
            for slots in [0, 8] {
                all.extend(
                    [SeedSource::Matrix, SeedSource::Factor]
                        .map(|seed| KernelForm::Derivatives(SummedLists::Both(slots), seed)),
                );
            }
        }
        Mode::Vjp if outputs == 1 => {
            all.push(KernelForm::Derivatives(
                SummedLists::Rows,
                SeedSource::Factor,
            ));
            all.push(KernelForm::Derivatives(
                SummedLists::Columns,
                SeedSource::Matrix,
            ));
        }
        Mode::Vjp => (),
    }
    all
}

/// Returns every shader that a fold can need, with its name.
///
/// # Errors
///
/// The errors of recording it.
#[doc(hidden)]
pub fn fold_sources<F: Fold>(_fold: F) -> Result<Vec<(String, String)>, Error> {
    if let Some(measure) = F::MEASURE {
        return Ok(vec![(F::DECLARED.name.to_owned(), ring_source(measure))]);
    }
    let programs = folding::programs::<F, f32>()?;
    let made = folds::shaders(
        &programs,
        &folding::Sizes::of::<F>(),
        F::empty::<f32>().scalars(),
    )?;
    Ok([KernelForm::Fold, KernelForm::FoldDerivatives]
        .map(|form| (format!("{form:?}"), made.text(form)))
        .into())
}

/// Returns the shader that replays recorded decisions.
#[doc(hidden)]
#[must_use]
pub fn replay_source() -> String {
    replays::text()
}
