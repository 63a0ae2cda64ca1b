//! Batches of rings on the GPU.
use super::context::{Device, SharedContext};
use super::download::DevicePending;
use super::download::downloads;
use super::work::{Commands, Params, groups};
use super::written::{Kernel, LONG, ROW, SPAN};
use crate::Error;
use crate::error::Argument;
use crate::kernels::cpu::check_ragged;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::machine::Downloads;
use crate::kernels::row::item::counts::expect;
use crate::ring::Measure;
use crate::{Fixed, Vec2};
use std::marker::PhantomData;

/// A run of rings that fit the buffers.
#[derive(Clone, Debug)]
struct RingRun {
    vertices: wgpu::Buffer,
    offsets: wgpu::Buffer,
    rings: usize,
    corners: usize,
    long: Option<LongRings>,
}

/// The long rings of a run, split into spans, since one thread for such a ring would be slow.
#[derive(Clone, Debug)]
struct LongRings {
    /// For each span the index of its long ring, and the first vertex in it.
    spans: wgpu::Buffer,
    span_count: usize,
    /// For each long ring its index, its first span, and the number of spans.
    longs: wgpu::Buffer,
    long_count: usize,
}

impl LongRings {
    fn new(inner: &SharedContext, offsets: &[u32]) -> Option<Self> {
        let (mut spans, mut longs): (Vec<[u32; 2]>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
        for (ring, ends) in offsets.windows(2).enumerate() {
            let count = ends[1] - ends[0];
            if count >= LONG as u32 {
                let (long, first) = (longs.len() as u32, spans.len() as u32);
                spans.extend((0..count).step_by(SPAN).map(|start| [long, start]));
                longs.push([ring as u32, first, spans.len() as u32 - first]);
            }
        }
        (!longs.is_empty()).then(|| LongRings {
            span_count: spans.len(),
            spans: inner.stored(&spans),
            long_count: longs.len(),
            longs: inner.stored(&longs),
        })
    }
}

/// The items of a kernel of long rings: spans, or whole rings.
enum LongItems {
    Spans,
    Longs,
}

/// The sizes in bytes of a span's sums, and of a ring's sums with its scale.
const PART_BYTES: usize = 24;
const WHOLE_BYTES: usize = 32;

/// Checked rings on the GPU.
#[derive(Clone, Debug)]
pub struct DeviceRings {
    gpu: Device,
    runs: Vec<RingRun>,
    len: usize,
}

impl DeviceRings {
    /// Returns the context of the rings.
    pub(crate) fn gpu(&self) -> &Device {
        &self.gpu
    }

    /// Replaces the vertices in place; the sizes of rings do not change.
    ///
    /// # Errors
    ///
    /// [`Error::Length`](crate::Error::Length) for another number of vertices,
    /// [`Error::Invalid`](crate::Error::Invalid) for one that is not finite (no vertex changes then), or the errors of
    /// the device.
    pub fn update(&mut self, vertices: &[Vec2<f32>]) -> Result<(), Error> {
        let corners = self.runs.iter().map(|run| run.corners).sum();
        expect(Argument::Vertices, corners, vertices.len())?;
        check_ragged(vertices, &[0, corners])?;
        let inner = &self.gpu.inner;
        inner.guarded(|| {
            let mut rest = vertices;
            for run in &self.runs {
                let (own, after) = rest.split_at(run.corners);
                rest = after;
                inner.write(&run.vertices, &pairs_of(own));
            }
            Ok(())
        })
    }
}

/// Returns vertices in the shader's layout.
fn pairs_of(vertices: &[Vec2<f32>]) -> Vec<[f32; 2]> {
    vertices.iter().map(|v| [v.x, v.y]).collect()
}

/// One result per ring, on the GPU.
#[derive(Clone, Debug)]
pub struct DeviceRingValues<T> {
    gpu: Device,
    parts: Vec<(wgpu::Buffer, u64)>,
    result: PhantomData<fn() -> T>,
}

impl<T: Fixed<Scalar = f32> + 'static> DeviceRingValues<T> {
    /// Starts the download of the results, in the order of the rings.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<DevicePending<Vec<T>>, Error> {
        let parts: Vec<_> = self.parts.iter().map(|(buffer, n)| (buffer, *n)).collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(DevicePending::new(arrival, |arrival| {
            let mut all = Vec::new();
            arrival.read(|_, numbers| {
                let numbers: &[f32] = bytemuck::cast_slice(numbers);
                all.extend(numbers.chunks_exact(T::LEN).map(T::load));
            })?;
            Ok(all)
        }))
    }
}

impl<T: Fixed<Scalar = f32> + 'static> Downloads<Vec<T>> for DeviceRingValues<T> {
    downloads!(Vec<T>);
}

impl Device {
    /// Checks rings and uploads them. Ring i has the vertices `offsets[i]..offsets[i + 1]`.
    ///
    /// # Errors
    ///
    /// The errors of the input as in [`Cpu::ragged`](crate::kernels::Cpu::ragged),
    /// [`GpuFault::TooLarge`](crate::GpuFault::TooLarge) for a ring that fits no buffer, or the errors of the device.
    pub(crate) fn upload_rings(
        &self,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
    ) -> Result<DeviceRings, Error> {
        check_ragged(vertices, offsets)?;
        let inner = &self.inner;
        let most_vertices = (inner.most_bytes / 8) as usize;
        let most_rings = inner.chunk - 1;
        let mut cuts = vec![0];
        for ring in 1..offsets.len() {
            let start = cuts[cuts.len() - 1];
            let vertices = offsets[ring] - offsets[ring - 1];
            if vertices > most_vertices {
                return Err(inner.too_large(2 * vertices));
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
                let corners = pairs_of(&vertices[base..own[own.len() - 1]]);
                let own: Vec<u32> = own.iter().map(|&at| (at - base) as u32).collect();
                RingRun {
                    vertices: inner.stored(&corners),
                    offsets: inner.stored(&own),
                    rings: own.len() - 1,
                    corners: corners.len(),
                    long: LongRings::new(inner, &own),
                }
            };
            Ok(cuts.windows(2).map(run).collect())
        })?;
        Ok(DeviceRings {
            gpu: self.clone(),
            runs,
            len: offsets.len() - 1,
        })
    }

    /// Returns one result per ring.
    ///
    /// # Errors
    ///
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), or the errors of the device.
    pub(crate) fn ragged_of<T: Fixed<Scalar = f32>>(
        &self,
        measure: Measure,
        rings: &DeviceRings,
    ) -> Result<DeviceRingValues<T>, Error> {
        self.owns(&rings.gpu)?;
        let inner = &self.inner;
        let fields = measure.fields();
        inner.guarded(|| {
            let mut work = Commands::new(inner);
            let mut parts = Vec::new();
            for run in &rings.runs {
                let values = inner.storage(run.rings * fields);
                run.dispatch(measure, &mut work, "ragged_main", &[(4, &values)]);
                if let Some(long) = &run.long {
                    let wholes = run.sum_up(measure, &mut work, long);
                    let bound = [(4, &values), (7, &long.longs), (9, &wholes)];
                    run.over(
                        measure,
                        &mut work,
                        long,
                        "long_main",
                        LongItems::Longs,
                        &bound,
                    );
                }
                parts.push((values, 4 * (run.rings * fields) as u64));
            }
            work.submit()?;
            Ok(DeviceRingValues {
                gpu: self.clone(),
                parts,
                result: PhantomData,
            })
        })
    }

    /// Returns the adjoint of [`ragged_of`](Self::ragged_of): one derivative per vertex, from the cotangents of the
    /// results.
    ///
    /// # Errors
    ///
    /// As [`ragged_of`](Self::ragged_of), and [`Error::Length`](crate::Error::Length) for an upstream of another
    /// length, [`Error::Invalid`](crate::Error::Invalid) for one that is not finite.
    pub(crate) fn ragged_vjp_of(
        &self,
        measure: Measure,
        rings: &DeviceRings,
        (results, numbers): (usize, &[f32]),
    ) -> Result<DeviceRingValues<Vec2<f32>>, Error> {
        self.owns(&rings.gpu)?;
        expect(Argument::Upstream, rings.len, results)?;
        let fields = measure.fields();
        check_upstream(numbers, fields)?;
        let inner = &self.inner;
        inner.guarded(|| {
            let mut work = Commands::new(inner);
            let mut parts = Vec::new();
            let mut rest = numbers;
            for run in &rings.runs {
                let (own, after) = rest.split_at(run.rings * fields);
                rest = after;
                let (upstream, bars) = (inner.stored(own), inner.storage(2 * run.corners));
                let bound = [(3, &upstream), (5, &bars)];
                run.dispatch(measure, &mut work, "ragged_vjp_main", &bound);
                if let Some(long) = &run.long {
                    let wholes = run.sum_up(measure, &mut work, long);
                    let bound = [
                        (3, &upstream),
                        (5, &bars),
                        (6, &long.spans),
                        (7, &long.longs),
                        (9, &wholes),
                    ];
                    run.over(
                        measure,
                        &mut work,
                        long,
                        "long_vjp_main",
                        LongItems::Spans,
                        &bound,
                    );
                }
                parts.push((bars, 8 * run.corners as u64));
            }
            work.submit()?;
            Ok(DeviceRingValues {
                gpu: self.clone(),
                parts,
                result: PhantomData,
            })
        })
    }
}

impl RingRun {
    /// Dispatches the kernel of short rings, one thread per ring.
    fn dispatch(
        &self,
        measure: Measure,
        work: &mut Commands<'_>,
        entry: &'static str,
        bound: &[(u32, &wgpu::Buffer)],
    ) {
        let mut buffers = vec![(1, &self.vertices), (2, &self.offsets)];
        buffers.extend(bound);
        let pipeline = ring_pipeline(measure, work.inner, entry);
        let size = [groups(self.rings), 1];
        work.dispatch(&pipeline, counted(self.rings), &buffers, size);
    }

    /// Dispatches a kernel of long rings.
    fn over(
        &self,
        measure: Measure,
        work: &mut Commands<'_>,
        long: &LongRings,
        entry: &'static str,
        over: LongItems,
        bound: &[(u32, &wgpu::Buffer)],
    ) {
        let (count, size) = match over {
            LongItems::Spans => {
                let wide = long.span_count.min(ROW);
                let tall = long.span_count.div_ceil(ROW);
                (long.span_count, [wide as u32, tall as u32])
            }
            LongItems::Longs => (long.long_count, [groups(long.long_count), 1]),
        };
        let mut buffers: Vec<_> = match entry {
            // It reads no vertices.
            "scale_main" | "whole_main" => Vec::new(),
            _ => vec![(1, &self.vertices), (2, &self.offsets)],
        };
        buffers.extend(bound);
        let pipeline = ring_pipeline(measure, work.inner, entry);
        work.dispatch(&pipeline, counted(count), &buffers, size);
    }

    /// Returns the scale and the sums of every long ring.
    fn sum_up(&self, measure: Measure, work: &mut Commands<'_>, long: &LongRings) -> wgpu::Buffer {
        let inner = work.inner;
        let parts = inner.storage(long.span_count * PART_BYTES / 4);
        let wholes = inner.storage(long.long_count * WHOLE_BYTES / 4);
        let (spans, longs) = ((6, &long.spans), (7, &long.longs));
        let (parts, sums) = ((8, &parts), (9, &wholes));
        for (entry, over, bound) in [
            ("extent_main", LongItems::Spans, &[spans, longs, parts][..]),
            ("scale_main", LongItems::Longs, &[longs, parts, sums]),
            ("sums_main", LongItems::Spans, &[spans, longs, parts, sums]),
            ("whole_main", LongItems::Longs, &[longs, parts, sums]),
        ] {
            self.over(measure, work, long, entry, over, bound);
        }
        wholes
    }
}

fn ring_pipeline(
    measure: Measure,
    inner: &SharedContext,
    entry: &'static str,
) -> wgpu::ComputePipeline {
    inner.written(Kernel::Ragged(measure), entry)
}

fn counted(count: usize) -> Params {
    Params {
        own_count: count as u32,
        ..Params::default()
    }
}
