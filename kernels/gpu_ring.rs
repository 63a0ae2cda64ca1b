//! Batches of rings on the GPU.
use super::source::{GpuRing, Kernel, Source, ring_source};
use super::work::{Params, Work, groups};
use super::{Gpu, Pending};
use crate::error::{Argument, Error};
use crate::kernels::GpuError;
use crate::kernels::ragged::check_ragged;
use crate::kernels::tile::{check_upstream, expect};
use crate::{Fixed, Vec2};
use std::marker::PhantomData;

/// A run of rings that fits the buffers.
#[derive(Clone, Debug)]
struct Run {
    vertices: wgpu::Buffer,
    offsets: wgpu::Buffer,
    rings: usize,
    corners: usize,
}

/// Rings on the GPU, checked.
#[derive(Clone, Debug)]
pub struct Rings {
    gpu: Gpu,
    runs: Vec<Run>,
    len: usize,
}

impl Rings {
    /// How many rings.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}

/// One result per ring, on the GPU.
#[derive(Clone, Debug)]
pub struct RingValues<T> {
    gpu: Gpu,
    parts: Vec<(wgpu::Buffer, u64)>,
    result: PhantomData<fn() -> T>,
}

/// One slope per vertex, on the GPU.
#[derive(Clone, Debug)]
pub struct RingBars {
    values: RingValues<Vec2<f32>>,
}

impl<T: Fixed<Scalar = f32> + 'static> RingValues<T> {
    /// Starts bringing the results back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<T>>, GpuError> {
        let parts: Vec<_> = self.parts.iter().map(|(buffer, n)| (buffer, *n)).collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(Pending::new(arrival, |arrival| {
            let mut all = Vec::new();
            arrival.read(|_, numbers| {
                let numbers: &[f32] = bytemuck::cast_slice(numbers);
                all.extend(numbers.chunks_exact(T::LEN).map(|numbers| {
                    let mut fields = T::filled(0.0).to_array();
                    fields.as_mut().copy_from_slice(numbers);
                    T::from_array(fields)
                }));
            })?;
            Ok(all)
        }))
    }

    /// Brings the results back, in the order of the rings.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<T>, GpuError> {
        self.start_download()?.wait()
    }
}

impl RingBars {
    /// Starts bringing the slopes back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<Vec2<f32>>>, GpuError> {
        self.values.start_download()
    }

    /// Brings the slopes back, in the order of the vertices.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<Vec2<f32>>, GpuError> {
        self.values.download()
    }
}

/// A result of an operation of rings.
pub type OutOf<O> = <O as crate::kernels::op::Op>::Out<f32>;

impl Gpu {
    /// Checks rings and brings them to the GPU. Ring i has the vertices
    /// `offsets[i]..offsets[i + 1]`.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] as [`ragged`](crate::kernels::cpu::ragged), [`GpuError::TooLarge`] for a
    /// ring that fits no buffer, or what the device says.
    pub fn upload_rings(
        &self,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
    ) -> Result<Rings, GpuError> {
        check_ragged(vertices, offsets)?;
        let inner = &self.inner;
        let most_vertices = (inner.most_bytes / 8) as usize;
        let most_rings = inner.chunk - 1;
        let mut cuts = vec![0];
        for ring in 1..offsets.len() {
            let start = cuts[cuts.len() - 1];
            if offsets[ring] - offsets[ring - 1] > most_vertices {
                return Err(GpuError::TooLarge);
            }
            if offsets[ring] - offsets[start] > most_vertices || ring - start > most_rings {
                cuts.push(ring - 1);
            }
        }
        if offsets.len() > 1 {
            cuts.push(offsets.len() - 1);
        }
        let runs = inner.guarded(|| {
            let run = |cut: &[usize]| {
                let own = &offsets[cut[0]..=cut[1]];
                let base = own[0];
                let corners: Vec<[f32; 2]> = vertices[base..own[own.len() - 1]]
                    .iter()
                    .map(|v| [v.x, v.y])
                    .collect();
                let own: Vec<u32> = own.iter().map(|&at| (at - base) as u32).collect();
                Run {
                    vertices: inner.stored(&corners),
                    offsets: inner.stored(&own),
                    rings: own.len() - 1,
                    corners: corners.len(),
                }
            };
            Ok(cuts.windows(2).map(run).collect())
        })?;
        Ok(Rings {
            gpu: self.clone(),
            runs,
            len: offsets.len() - 1,
        })
    }

    /// One result per ring.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], or what the device says.
    pub fn ragged<O: GpuRing>(&self, rings: &Rings) -> Result<RingValues<OutOf<O>>, GpuError> {
        self.owns(&rings.gpu)?;
        let inner = &self.inner;
        let fields = OutOf::<O>::LEN;
        inner.guarded(|| {
            let pipeline = inner.pipeline(
                Source::of(Kernel::Ragged, O::NAME),
                O::ENTRY,
                ring_source::<O>,
            );
            let mut work = Work::new(inner);
            let mut parts = Vec::new();
            for run in &rings.runs {
                let values = inner.storage(run.rings * fields);
                let buffers = [(1, &run.vertices), (2, &run.offsets), (4, &values)];
                work.dispatch(
                    &pipeline,
                    ring_params(run),
                    &buffers,
                    [groups(run.rings), 1],
                );
                parts.push((values, 4 * (run.rings * fields) as u64));
            }
            work.submit()?;
            Ok(RingValues {
                gpu: self.clone(),
                parts,
                result: PhantomData,
            })
        })
    }

    /// The adjoint of [`ragged`](Gpu::ragged): one slope per vertex.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Gpu::ragged), and [`GpuError::Input`] for an upstream of another length or
    /// one that is not finite.
    pub fn ragged_vjp<O: GpuRing>(
        &self,
        rings: &Rings,
        upstream: &[OutOf<O>],
    ) -> Result<RingBars, GpuError> {
        self.owns(&rings.gpu)?;
        expect(Argument::Upstream, rings.len, upstream.len())?;
        let fields = OutOf::<O>::LEN;
        let mut numbers = vec![0.0; upstream.len() * fields];
        for (out_bar, numbers) in upstream.iter().zip(numbers.chunks_exact_mut(fields)) {
            numbers.copy_from_slice(out_bar.to_array().as_ref());
        }
        check_upstream(&numbers).map_err(|error| match error {
            Error::Invalid {
                argument,
                row,
                flaw,
            } => Error::Invalid {
                argument,
                row: row / fields,
                flaw,
            },
            other => other,
        })?;
        let inner = &self.inner;
        inner.guarded(|| {
            let pipeline = inner.pipeline(
                Source::of(Kernel::Ragged, O::NAME),
                O::VJP_ENTRY,
                ring_source::<O>,
            );
            let mut work = Work::new(inner);
            let mut parts = Vec::new();
            let mut rest = &numbers[..];
            for run in &rings.runs {
                let (own, after) = rest.split_at(run.rings * fields);
                rest = after;
                let (upstream, bars) = (inner.stored(own), inner.storage(2 * run.corners));
                let buffers = [
                    (1, &run.vertices),
                    (2, &run.offsets),
                    (3, &upstream),
                    (5, &bars),
                ];
                work.dispatch(
                    &pipeline,
                    ring_params(run),
                    &buffers,
                    [groups(run.rings), 1],
                );
                parts.push((bars, 8 * run.corners as u64));
            }
            work.submit()?;
            let values = RingValues {
                gpu: self.clone(),
                parts,
                result: PhantomData,
            };
            Ok(RingBars { values })
        })
    }
}

fn ring_params(run: &Run) -> Params {
    Params {
        own_count: run.rings as u32,
        ..Params::default()
    }
}
