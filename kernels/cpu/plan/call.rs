//! The plan of a call, made once per function, mode and form.
use super::compiled::{of_compiled, outline};
use super::computation::{Face, name};
use super::makers::{of_recorded, of_replays};
use crate::Real;
use crate::error::Error;
use crate::kernels::recording::{Body, Call, Key};
use std::sync::Arc;

/// How the CPU computes a call: aligned, or for all pairs with shapes prepared once.
pub(crate) fn plan<T: Real>(call: &Call<T>, framed: bool) -> Result<Arc<Face<T>>, Error> {
    let (recording, mode) = (&*call.recording, call.mode);
    // A search computes item by item in either form.
    let framed = framed && !matches!(recording.body, Body::Search(_));
    recording.made(Key::Cpu(mode, framed), &|| {
        let mut face = match (&recording.body, recording.compiled) {
            (Body::Search(search), _) if search.steps.is_empty() => (search.plan)(mode),
            (Body::Search(search), _) => of_replays(mode, recording, search),
            (_, compiled) => match compiled.and_then(|compiled| of_compiled(compiled, mode)) {
                Some(face) => face,
                None => {
                    let program = recording.program(mode)?;
                    let (takes, outputs) = (recording.takes.clone(), recording.outputs.clone());
                    let mut face = of_recorded(mode, takes, outputs, &program, framed)?;
                    for argument in &mut face.arguments {
                        argument.bounds = compiled.and_then(outline);
                    }
                    face
                }
            },
        };
        name(&mut face.arguments, recording.arguments);
        Ok(face)
    })
}
