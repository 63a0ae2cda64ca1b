//! Rings on the machine between calls.
use crate::Vec2;
use crate::error::{Argument, Error};
use crate::kernels::cpu::check_ragged;
use crate::kernels::gpu;
use crate::kernels::machine::{InMemory, RingBars, RingValues};
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::numbers;
use crate::kernels::{Backend, Cpu};

/// Checked rings on a machine.
#[derive(Clone, Debug)]
pub struct Rings(MachineRings);

/// The rings of a machine: on the CPU vertices and offsets.
#[derive(Clone, Debug)]
enum MachineRings {
    Cpu(Vec<Vec2<f32>>, Vec<usize>),
    Gpu(gpu::DeviceRings),
}

impl Backend<'_> {
    /// Checks rings and uploads them. Ring i has the vertices
    /// `offsets[i]..offsets[i + 1]`.
    ///
    /// # Errors
    ///
    /// The errors of the input as in [`Cpu::ragged`](crate::kernels::Cpu::ragged), or those of the device.
    pub fn upload_rings(self, vertices: &[Vec2<f32>], offsets: &[usize]) -> Result<Rings, Error> {
        Ok(Rings(match self {
            Backend::Cpu => {
                check_ragged(vertices, offsets)?;
                MachineRings::Cpu(vertices.to_vec(), offsets.to_vec())
            }
            Backend::Gpu(gpu) => MachineRings::Gpu(gpu.engine.upload_rings(vertices, offsets)?),
        }))
    }
}

impl Rings {
    /// Computes [`Cpu::ragged`](crate::kernels::Cpu::ragged) for a measure of rings with kernels by hand: signed area,
    /// perimeter, centroid.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn ragged<F>(&self, measure: F) -> Result<RingValues<F::Out<f32>>, Error>
    where
        F: Fold<Element<f32> = Vec2<f32>, Context<f32> = [f32; 0]>,
    {
        const {
            assert!(
                F::MEASURE.is_some(),
                "resident rings have areas, perimeters and centroids"
            )
        };
        Ok(match &self.0 {
            MachineRings::Cpu(vertices, offsets) => {
                RingValues::new(InMemory(Cpu::new().ragged(measure, vertices, offsets)?))
            }
            MachineRings::Gpu(own) => RingValues::new(
                own.gpu()
                    .ragged_of(const { F::MEASURE.expect("by hand") }, own)?,
            ),
        })
    }

    /// Computes the adjoint, as [`Cpu::ragged_vjp`](crate::kernels::Cpu::ragged_vjp).
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for an upstream of another length, [`Error::Invalid`] for one that is not finite, or the
    /// errors of the device.
    pub fn ragged_vjp<F>(&self, measure: F, upstream: &[F::Out<f32>]) -> Result<RingBars, Error>
    where
        F: Fold<Element<f32> = Vec2<f32>, Context<f32> = [f32; 0]>,
    {
        const {
            assert!(
                F::MEASURE.is_some(),
                "resident rings have areas, perimeters and centroids"
            )
        };
        Ok(match &self.0 {
            MachineRings::Cpu(vertices, offsets) => RingBars::new(InMemory(
                Cpu::new().ragged_vjp(measure, vertices, offsets, upstream)?,
            )),
            MachineRings::Gpu(own) => RingBars::new(own.gpu().ragged_vjp_of(
                const { F::MEASURE.expect("by hand") },
                own,
                (upstream.len(), &numbers(upstream)),
            )?),
        })
    }

    /// Replaces the vertices; the sizes of rings do not change.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another number of vertices, [`Error::Invalid`] for one that is not finite (no vertex
    /// changes then), or the errors of the device.
    pub fn update(&mut self, vertices: &[Vec2<f32>]) -> Result<(), Error> {
        match &mut self.0 {
            MachineRings::Cpu(own, offsets) => {
                expect(Argument::Vertices, own.len(), vertices.len())?;
                check_ragged(vertices, offsets)?;
                own.copy_from_slice(vertices);
                Ok(())
            }
            MachineRings::Gpu(own) => own.update(vertices),
        }
    }
}
