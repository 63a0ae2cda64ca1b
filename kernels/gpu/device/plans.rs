//! Plans of a function for both machines, without the types of its shapes.
use crate::Error;
use crate::kernels::cpu::plan::{Compiled, Face};
use crate::kernels::gpu::Generated;
use crate::kernels::item::Item;
use crate::kernels::op::{Ask, Runs};
use crate::kernels::replays::Replays;
use std::marker::PhantomData;
use std::sync::Arc;

/// A function as the GPU's batches see it.
pub(crate) trait Plans {
    /// Its plan on the processor.
    fn face(&self, ask: Ask) -> Result<Arc<Face<f32>>, Error>;
    /// Its compiled kernels.
    fn compiled(&self) -> Option<Compiled>;
    /// Its shaders.
    fn generated(&self, ask: Ask) -> Result<Arc<Generated<f32>>, Error>;
    /// Its replays, if it searches.
    fn replays(&self, ask: Ask) -> Option<Result<Arc<dyn Replays<f32>>, Error>>;
}

/// Something that runs on rows of shapes.
pub(crate) struct Typed<'a, R, X>(&'a X, PhantomData<fn() -> R>);

impl<'a, R, X> Typed<'a, R, X> {
    pub fn new(run: &'a X) -> Self {
        Typed(run, PhantomData)
    }
}

impl<R: Item<Scalar = f32>, X: Runs<R>> Plans for Typed<'_, R, X> {
    fn face(&self, ask: Ask) -> Result<Arc<Face<f32>>, Error> {
        self.0.face(ask)
    }
    fn compiled(&self) -> Option<Compiled> {
        self.0.compiled()
    }
    fn generated(&self, ask: Ask) -> Result<Arc<Generated<f32>>, Error> {
        self.0.generated(ask)
    }
    fn replays(&self, ask: Ask) -> Option<Result<Arc<dyn Replays<f32>>, Error>> {
        self.0.replays(ask)
    }
}
