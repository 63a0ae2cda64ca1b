//! Recordings that are opened and finished by calls, for functions that are not Rust's.
use super::graph::Node;
use super::in_progress::Recording;
use super::record::places;
use super::recorded::Recorded;
use super::sym::{Sym, SymMask};
use crate::{Real, Unrecordable};
use std::marker::PhantomData;

/// The recording of this thread, until it is finished or dropped.
#[derive(Debug)]
pub(crate) struct Opened<T> {
    name: u64,
    inputs: usize,
    /// It belongs to its thread.
    thread: PhantomData<*const T>,
}

impl<T: Real> Opened<T> {
    /// Opens a recording of a function of `inputs` numbers; returns an error if one is open on this thread.
    pub(crate) fn start(inputs: usize) -> Result<Self, Unrecordable> {
        if Recording::is_open() {
            return Err(Unrecordable::Nested);
        }
        Ok(Opened {
            name: Recording::open(T::FORMAT, false),
            inputs,
            thread: PhantomData,
        })
    }
    /// Returns the symbols of its input.
    pub(crate) fn inputs(&self) -> Vec<Sym<T>> {
        let places = 0..self.inputs as u32;
        places.map(|place| Sym::leaf(Node::Input(place))).collect()
    }
    /// Returns the program with these results.
    pub(crate) fn finish(self, outputs: &[Sym<T>]) -> Result<Recorded, Unrecordable> {
        for output in outputs {
            output.belongs()?;
        }
        let mut recording = Recording::close(self.name).ok_or(Unrecordable::ForeignSymbol)?;
        recording.sound()?;
        if recording.hints > 0 {
            return Err(Unrecordable::Hint);
        }
        let outputs = places(&mut recording, outputs)?;
        Recorded::new(recording.graph, self.inputs, &outputs).checked_constants()
    }
}

impl<T> Drop for Opened<T> {
    fn drop(&mut self) {
        Recording::close(self.name);
    }
}

/// Returns `true` while a recording is open on this thread.
pub(crate) fn is_open() -> bool {
    Recording::is_open()
}

/// Returns an error unless a recording of this format is open on this thread.
pub(crate) fn is_open_in<T: Real>() -> Result<(), Unrecordable> {
    Recording::takes(T::FORMAT)
}

impl<T: Real> Sym<T> {
    /// Returns an error unless it is of the recording that is open on this thread.
    pub(crate) fn belongs(self) -> Result<(), Unrecordable> {
        Recording::owns(self.symbol)
    }
}
impl<T: Real> SymMask<T> {
    /// Returns an error unless it is of the recording that is open on this thread.
    pub(crate) fn belongs(self) -> Result<(), Unrecordable> {
        Recording::owns(self.symbol)
    }
}
