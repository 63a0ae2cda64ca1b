//! The stand-in of the GPU in a build without the feature `gpu`: types without values, so that all other code compiles
//! in both builds.
use crate::error::Argument;
use crate::kernels::Fold;
use crate::kernels::call::folding::Folding;
use crate::kernels::call::recording::{Call, Recording};
use crate::kernels::machine::Column;
use crate::kernels::machine::GroupSpans;
use crate::kernels::machine::{Bests, Downloads, Matrix, Pending, Stored};
use crate::kernels::machine::{
    Engine, GroupedReduction, Items, Machine, Numbers, On, Reduced, Reduction, Room, Sealed, Seed,
};
use crate::kernels::machine::{Input, VertexBars};
use crate::kernels::machine::{Least, LeastPairs};
use crate::kernels::row::item::Leaf;
use crate::ring::Measure;
use crate::suppression::Rules;
use crate::{Error, GpuFault, Vec2};
use std::any::Any;
use std::marker::PhantomData;
use std::sync::Arc;

/// A GPU, which a build without the feature `gpu` cannot have.
pub type Gpu = Machine<Device>;

/// The engine of a GPU, which a build without the feature `gpu` cannot have.
#[derive(Clone, Debug)]
pub enum Device {}

impl Machine<Device> {
    /// Returns a context, which a build without the feature `gpu` cannot have.
    ///
    /// # Errors
    ///
    /// Always [`GpuFault::NotBuilt`].
    pub fn new() -> Result<Self, Error> {
        Err(Error::Gpu(GpuFault::NotBuilt))
    }
    /// Waits until all work is done.
    ///
    /// # Errors
    ///
    /// None: there is no such GPU.
    pub fn wait(&self) -> Result<(), Error> {
        match self.engine {}
    }
    pub(crate) fn is_worth_it(&self) -> bool {
        match self.engine {}
    }
}

impl std::fmt::Display for Machine<Device> {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.engine {}
    }
}

impl Sealed for Device {}

impl On<Device> for f32 {
    fn engine(engine: &Device) -> &dyn Engine<f32> {
        match *engine {}
    }
}

impl Engine<f32> for Device {
    fn check(&self, _: Argument, _: Leaf<f32>, _: &[f32]) -> Result<(), Error> {
        match *self {}
    }
    fn keep(&self, _: usize, _: Vec<Numbers<f32>>) -> Result<Stored<f32>, Error> {
        match *self {}
    }
    fn room(&self, _: usize, _: usize) -> Result<Matrix<f32>, Error> {
        match *self {}
    }
    fn map(&self, _: &Call<f32>, _: &[Column<'_, f32>], _: Items<'_, f32>) -> Result<bool, Error> {
        match *self {}
    }
    fn pairs(
        &self,
        _: &Call<f32>,
        _: &[Column<'_, f32>; 2],
        _: Room<'_, f32>,
    ) -> Result<(), Error> {
        match *self {}
    }
    fn reduce(
        &self,
        _: &Call<f32>,
        _: &[Column<'_, f32>; 2],
        _: Reduction<f32>,
    ) -> Result<Reduced<f32>, Error> {
        match *self {}
    }
    fn reduce_grouped(
        &self,
        _: &Call<f32>,
        _: &[Column<'_, f32>; 2],
        _: GroupSpans<'_>,
        _: GroupedReduction<f32>,
    ) -> Result<Reduced<f32>, Error> {
        match *self {}
    }
    fn least(
        &self,
        _: &Call<f32>,
        _: &[Column<'_, f32>; 2],
        _: GroupSpans<'_>,
        _: Least<f32>,
        _: bool,
    ) -> Result<LeastPairs<f32>, Error> {
        match *self {}
    }
    fn pull_back(
        &self,
        _: &Call<f32>,
        _: &[Column<'_, f32>; 2],
        _: &Seed<'_, f32>,
        _: [&mut [f32]; 2],
    ) -> Result<f64, Error> {
        match *self {}
    }
    fn fold(&self, _: &Folding<f32>, _: &Input<'_, f32>, _: &mut [f32]) -> Result<(), Error> {
        match *self {}
    }
    fn fold_back(
        &self,
        _: &Folding<f32>,
        _: &Input<'_, f32>,
        _: &[f32],
        _: &mut [f32],
        _: VertexBars<'_, f32>,
    ) -> Result<(), Error> {
        match *self {}
    }
    fn suppress(
        &self,
        _: &Call<f32>,
        _: &Column<'_, f32>,
        _: Option<&[usize]>,
        _: &[f32],
        _: Rules<'_, f32>,
    ) -> Result<Vec<usize>, Error> {
        match *self {}
    }
    fn pick(&self, _: &Stored<f32>, _: &Bests<f32>) -> Result<Stored<f32>, Error> {
        match *self {}
    }
}

/// Rings on a GPU, which a build without the feature `gpu` cannot have.
#[derive(Clone, Debug)]
pub enum DeviceRings {}

/// Results of rings on a GPU, which a build without the feature `gpu` cannot have.
#[derive(Clone, Debug)]
pub enum DeviceRingValues<T = ()> {
    /// A variant that uses the type parameter; it has no values.
    #[doc(hidden)]
    Never(Device, PhantomData<fn() -> T>),
}

impl<T: 'static> Downloads<Vec<T>> for DeviceRingValues<T> {
    fn started(&self) -> Result<Pending<Vec<T>>, Error> {
        let DeviceRingValues::Never(never, _) = self;
        match *never {}
    }
    fn taken(self: Box<Self>) -> Result<Vec<T>, Error> {
        let DeviceRingValues::Never(never, _) = *self;
        match never {}
    }
    fn boxed(&self) -> Box<dyn Downloads<Vec<T>>> {
        let DeviceRingValues::Never(never, _) = self;
        match *never {}
    }
    fn any(&self) -> &dyn Any {
        self
    }
}

impl DeviceRings {
    pub(crate) fn gpu(&self) -> &Device {
        match *self {}
    }
    pub(crate) fn update(&mut self, _: &[Vec2<f32>]) -> Result<(), Error> {
        match *self {}
    }
}

impl Device {
    pub(crate) fn upload_rings(&self, _: &[Vec2<f32>], _: &[usize]) -> Result<DeviceRings, Error> {
        match *self {}
    }
    pub(crate) fn ragged_of<T>(
        &self,
        _: Measure,
        _: &DeviceRings,
    ) -> Result<DeviceRingValues<T>, Error> {
        match *self {}
    }
    pub(crate) fn ragged_vjp_of(
        &self,
        _: Measure,
        _: &DeviceRings,
        _: (usize, &[f32]),
    ) -> Result<DeviceRingValues<Vec2<f32>>, Error> {
        match *self {}
    }
}

/// Shader sources, each with its name.
type Shaders = Result<Vec<(String, String)>, Error>;

/// Returns the shaders of a straight line, which a build without the feature `gpu` does not have.
///
/// # Errors
///
/// Always [`GpuFault::NotBuilt`](crate::GpuFault::NotBuilt).
#[doc(hidden)]
pub fn line_sources(_: &str, _: Arc<Recording<f32>>) -> Shaders {
    Err(Error::Gpu(GpuFault::NotBuilt))
}

/// Returns the shaders of a fold, which a build without the feature `gpu` does not have.
///
/// # Errors
///
/// Always [`GpuFault::NotBuilt`](crate::GpuFault::NotBuilt).
#[doc(hidden)]
pub fn fold_sources<F: Fold>(_: F) -> Shaders {
    Err(Error::Gpu(GpuFault::NotBuilt))
}
