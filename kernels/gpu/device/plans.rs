//! The kernels of a call on a GPU, made once per function, mode and form.
use super::generated::operation::Generated;
use super::generated::replays::SearchReplays;
use crate::kernels::call::recording::{Body, Call, Recording};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::once::Key;
use crate::{Error, Unrecordable};
use std::sync::Arc;

impl Call<f32> {
    /// Returns the kernels of a call: aligned, or for all pairs with shapes prepared once.
    ///
    /// # Errors
    ///
    /// The errors of recording the function; [`Unrecordable::Search`](crate::Unrecordable::Search) for a search, which
    /// has no kernel of its own.
    pub(crate) fn generated(&self, framed: bool) -> Result<Arc<Generated<f32>>, Error> {
        let (recording, mode) = (&*self.recording, self.mode);
        recording.made(Key::Gpu(mode, framed), &|| {
            if framed && let Some(made) = Generated::by_hand(self)? {
                return Ok(made.named(recording.arguments));
            }
            let program = recording.program(mode)?;
            let (takes, outputs) = (recording.takes.clone(), recording.outputs.clone());
            let made = Generated::new(mode, takes, outputs, &program, framed)?;
            Ok(made.named(recording.arguments))
        })
    }
    /// Returns the replays of a search; `None` for other functions.
    pub(crate) fn replays(&self) -> Option<Arc<SearchReplays>> {
        let Body::Search(search) = &self.recording.body else {
            return None;
        };
        let (key, mode) = (Key::Replays(self.mode), self.mode);
        let made = self
            .recording
            .made(key, &|| Ok(SearchReplays::new(search.replays(mode))));
        let made = made.unwrap_or_else(|_: Error| unreachable!("a replay is recorded later"));
        Some(made)
    }
    /// Returns a call that runs another call's kernels on a GPU, for tests of the harness with wrong results.
    ///
    /// # Errors
    ///
    /// The errors of recording either function.
    #[doc(hidden)]
    pub fn with_kernels_of(&self, other: &Self) -> Result<Self, Error> {
        let recording = &self.recording;
        if matches!(recording.body, Body::Search(_)) {
            return Err(Error::Program(Unrecordable::Search));
        }
        // A copy of the recording that has no plans yet.
        let (takes, outputs) = (recording.takes.clone(), recording.outputs.clone());
        let body = Body::Graph(recording.program(Mode::Value)?);
        let mut own = Recording::new(takes, outputs, recording.arguments, body);
        own.compiled = recording.compiled;
        for framed in [false, true] {
            let program = other.recording.program(other.mode)?;
            let (takes, outputs) = (own.takes.clone(), own.outputs.clone());
            own.made(Key::Gpu(self.mode, framed), &|| {
                Generated::new(other.mode, takes.clone(), outputs.clone(), &program, framed)
            })?;
        }
        Ok(Call {
            recording: Arc::new(own),
            mode: self.mode,
            lower: self.lower,
        })
    }
}
