//! Plans of batches on the CPU: a preparation per shape, a computation per pair.
mod compiled;
mod computation;
pub(crate) mod makers;

pub(crate) use computation::name;
pub use computation::{List, Plan, Preparation, Rare, Shapes};
pub(crate) use makers::{of_items, of_recorded};

use crate::Real;
use crate::error::Error;
use crate::kernels::call::recording::{Body, Call};
use crate::kernels::row::once::Key;
use compiled::{of_compiled, outline};
use makers::of_replays;
use std::sync::Arc;

/// Returns the plan of a call, aligned or (`framed`) for all pairs with shapes prepared once. It is made once per
/// function, mode and form.
pub(crate) fn plan<T: Real>(call: &Call<T>, framed: bool) -> Result<Arc<Plan<T>>, Error> {
    let (recording, mode) = (&*call.recording, call.mode);
    // A search has one plan for both forms: it computes item by item.
    let framed = framed && !matches!(recording.body, Body::Search(_));
    recording.made(Key::Cpu(mode, framed), &|| {
        let mut plan = match (&recording.body, recording.compiled) {
            (Body::Search(search), _) if search.steps.is_empty() => of_items(
                mode,
                recording.takes.clone(),
                recording.outputs.clone(),
                (search.item)(mode),
            ),
            (Body::Search(search), _) => of_replays(mode, recording, search),
            (_, compiled) => match compiled.and_then(|compiled| of_compiled(compiled, mode)) {
                Some(plan) => plan,
                None => {
                    let program = recording.program(mode)?;
                    let (takes, outputs) = (recording.takes.clone(), recording.outputs.clone());
                    let mut plan = of_recorded(mode, takes, outputs, &program, framed)?;
                    for argument in &mut plan.arguments {
                        argument.bounds = compiled.and_then(outline);
                    }
                    plan
                }
            },
        };
        name(&mut plan.arguments, recording.arguments);
        Ok(plan)
    })
}
