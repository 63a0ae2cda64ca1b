//! Plans of batches on the CPU: a preparation per shape, a computation per pair.
mod compiled;
mod computation;
pub(crate) mod makers;

pub(crate) use computation::name;
pub use computation::{List, Plan, Preparation, Prepare, Rare, Shapes};
pub(crate) use makers::{of_items, of_recorded};

use crate::Real;
use crate::ad::program::record::listed;
use crate::error::Error;
use crate::kernels::call::recording::{Body, Call, Recording};
use crate::kernels::cpu::program::split::Subgraph;
use crate::kernels::row::once::Key;
use compiled::{of_compiled, outline};
use makers::{of_replays, prepared};
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
                search.decide,
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

/// The preparations of the bounds of both arguments along the axes: the number of bounds, and the program of each.
pub(crate) type AxisBounds<T> = [(usize, Prepare<T>); 2];

/// Returns the preparations of the bounds of both arguments; `None` unless both have some.
pub(crate) fn axis_bounds<T: Real>(
    recording: &Recording<T>,
) -> Result<Arc<Option<AxisBounds<T>>>, Error> {
    recording.made(Key::AxisBounds, &|| {
        let mut both = Vec::new();
        for leaf in &recording.takes {
            // Shapes with codes are not straight lines.
            if leaf.codes > 0 {
                return Ok(None);
            }
            let bounds = listed(T::FORMAT, leaf.fields, 0, &leaf.axis_bounds)?;
            if ![4, 6].contains(&bounds.value.outputs.len()) {
                return Ok(None);
            }
            let graph = Subgraph {
                graph: bounds.value.graph,
                outputs: bounds.value.outputs,
            };
            both.push(prepared(&graph, leaf.fields)?);
        }
        Ok(<[_; 2]>::try_from(both).ok())
    })
}
