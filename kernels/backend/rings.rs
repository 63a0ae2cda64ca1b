//! Rings on the machine between calls.
use crate::Vec2;
use crate::error::{Argument, Error};
use crate::kernels::cpu::check_ragged;
use crate::kernels::gpu;
use crate::kernels::machine::{Ready, RingBars, RingValues};
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::numbers;
use crate::kernels::{Backend, Cpu};

/// Rings on a machine, which are checked.
#[derive(Clone, Debug)]
pub struct Rings(Side);

/// On the CPU vertices, and where each ring begins among them.
#[derive(Clone, Debug)]
enum Side {
    Cpu(Vec<Vec2<f32>>, Vec<usize>),
    Gpu(gpu::Rings),
}

impl Backend<'_> {
    /// Checks rings and uploads them. Ring i has the vertices
    /// `offsets[i]..offsets[i + 1]`.
    ///
    /// # Errors
    ///
    /// The input's as [`Cpu::ragged`](crate::kernels::Cpu::ragged), or what the device says.
    pub fn upload_rings(self, vertices: &[Vec2<f32>], offsets: &[usize]) -> Result<Rings, Error> {
        Ok(Rings(match self {
            Backend::Cpu => {
                check_ragged(vertices, offsets)?;
                Side::Cpu(vertices.to_vec(), offsets.to_vec())
            }
            Backend::Gpu(gpu) => Side::Gpu(gpu.engine.upload_rings(vertices, offsets)?),
        }))
    }
}

impl Rings {
    /// [`Cpu::ragged`](crate::kernels::Cpu::ragged) of a measure of rings with kernels by hand: signed area, perimeter,
    /// centroid.
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
            Side::Cpu(vertices, offsets) => {
                RingValues::new(Ready(Cpu::new().ragged(measure, vertices, offsets)?))
            }
            Side::Gpu(own) => RingValues::new(
                own.gpu()
                    .ragged_of(const { F::MEASURE.expect("by hand") }, own)?,
            ),
        })
    }

    /// [`Cpu::ragged_vjp`](crate::kernels::Cpu::ragged_vjp).
    ///
    /// # Errors
    ///
    /// The input's for an upstream of another length or one that is not finite, or what the
    /// device says.
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
            Side::Cpu(vertices, offsets) => RingBars::new(Ready(
                Cpu::new().ragged_vjp(measure, vertices, offsets, upstream)?,
            )),
            Side::Gpu(own) => RingBars::new(own.gpu().ragged_vjp_of(
                const { F::MEASURE.expect("by hand") },
                own,
                (upstream.len(), &numbers(upstream)),
            )?),
        })
    }

    /// Replaces the vertices; each ring keeps its number of them.
    ///
    /// # Errors
    ///
    /// The input's for another number of vertices or one that is not finite (the old ones
    /// are then as they were), or what the device says.
    pub fn update(&mut self, vertices: &[Vec2<f32>]) -> Result<(), Error> {
        match &mut self.0 {
            Side::Cpu(own, offsets) => {
                expect(Argument::Vertices, own.len(), vertices.len())?;
                check_ragged(vertices, offsets)?;
                own.copy_from_slice(vertices);
                Ok(())
            }
            Side::Gpu(own) => own.update(vertices),
        }
    }
}
