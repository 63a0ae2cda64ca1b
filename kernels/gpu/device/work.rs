//! The execution of kernels: pipelines, dispatches, error scopes.
use super::context::{SharedContext, locked};
use super::download::DownloadState;
use super::generated::text::Pipeline;
use super::written::{GROUP, Kernel};
use crate::{Error, GpuFault};
use std::sync::atomic::Ordering;
use std::time::Duration;

/// The parameters of every kernel of pairs; the shader's `Params`.
#[derive(Clone, Copy, Debug, Default, bytemuck::NoUninit)]
#[repr(C)]
pub(super) struct Params {
    pub own_count: u32,
    pub loop_count: u32,
    pub own_start: u32,
    pub loop_start: u32,
    pub loop_base: u32,
    pub own_base: u32,
    pub parts: u32,
    pub more: u32,
    /// The threshold of scores, or the factor of derivatives.
    pub factor: f32,
    pub fields: u32,
    pub out_start: u32,
    /// The lengths of a row of a matrix, and of a whole plane of it.
    pub stride: u32,
    pub plane: u32,
}

/// The size of the parameters in bytes, rounded up as uniform buffers require.
const PARAMS_BYTES: u64 = 64;

/// Commands to be submitted to the queue.
pub(super) struct Commands<'a> {
    pub inner: &'a SharedContext,
    encoder: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    timed: u32,
}

/// The largest number of passes whose time one submission can measure.
const MOST_TIMED: u32 = 2048;

impl<'a> Commands<'a> {
    pub fn new(inner: &'a SharedContext) -> Self {
        let queries = inner.timing.then(|| {
            inner.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST_TIMED,
            })
        });
        Commands {
            inner,
            encoder: inner.encoder(),
            queries,
            timed: 0,
        }
    }

    /// Adds a dispatch; `buffers` pairs each buffer with its binding.
    pub fn dispatch(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        params: Params,
        buffers: &[(u32, &wgpu::Buffer)],
        groups: [u32; 2],
    ) {
        self.run(
            pipeline,
            &self.inner.uniform(&[params], PARAMS_BYTES),
            buffers,
            groups,
        );
    }

    /// Adds a dispatch with the parameters of a generated kernel.
    pub fn dispatch_with(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        params: &[[u32; 4]],
        buffers: &[(u32, &wgpu::Buffer)],
        groups: [u32; 2],
    ) {
        let bytes = size_of_val(params) as u64;
        self.run(
            pipeline,
            &self.inner.uniform(params, bytes),
            buffers,
            groups,
        );
    }

    fn run(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        uniform: &wgpu::Buffer,
        buffers: &[(u32, &wgpu::Buffer)],
        groups: [u32; 2],
    ) {
        let mut entries = vec![wgpu::BindGroupEntry {
            binding: 0,
            resource: uniform.as_entire_binding(),
        }];
        entries.extend(
            buffers
                .iter()
                .map(|&(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                }),
        );
        let group = self
            .inner
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
        let timestamps = self.queries.as_ref().filter(|_| self.timed < MOST_TIMED);
        let mut pass = self
            .encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: None,
                timestamp_writes: timestamps.map(|set| wgpu::ComputePassTimestampWrites {
                    query_set: set,
                    beginning_of_pass_write_index: Some(2 * self.timed),
                    end_of_pass_write_index: Some(2 * self.timed + 1),
                }),
            });
        self.timed += u32::from(timestamps.is_some());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], 1);
    }

    /// Adds a copy of a buffer's bytes from `offset` on to the start of another buffer.
    pub fn copy(&mut self, from: &wgpu::Buffer, offset: u64, to: &wgpu::Buffer, bytes: u64) {
        self.encoder
            .copy_buffer_to_buffer(from, offset, to, 0, bytes);
    }

    /// Adds a copy between ranges of two buffers, in bytes.
    pub fn copy_to(
        &mut self,
        from: &wgpu::Buffer,
        start: u64,
        to: &wgpu::Buffer,
        at: u64,
        bytes: u64,
    ) {
        if bytes > 0 {
            self.encoder
                .copy_buffer_to_buffer(from, start, to, at, bytes);
        }
    }

    /// Submits the commands to the queue; with timing it waits for them.
    pub fn submit(mut self) -> Result<wgpu::SubmissionIndex, Error> {
        let Some(queries) = self.queries.take().filter(|_| self.timed > 0) else {
            return Ok(self.inner.queue.submit([self.encoder.finish()]));
        };
        let bytes = u64::from(self.timed) * 16;
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved = self.inner.buffer(bytes, usage);
        self.encoder
            .resolve_query_set(&queries, 0..2 * self.timed, &resolved, 0);
        let staging = self.inner.staging(bytes);
        self.copy(&resolved, 0, &staging, bytes);
        let index = self.inner.queue.submit([self.encoder.finish()]);
        DownloadState::of([&staging].into_iter()).wait(self.inner, &index)?;
        let view = staging
            .get_mapped_range(..)
            .map_err(|_| Error::Gpu(GpuFault::DeviceLost))?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&view[..]);
        let sum: u64 = ticks
            .chunks_exact(2)
            .map(|pass| pass[1].saturating_sub(pass[0]))
            .sum();
        let nanoseconds = sum as f64 * f64::from(self.inner.queue.get_timestamp_period());
        *locked(&self.inner.kernel_time) += Duration::from_nanos(nanoseconds as u64);
        Ok(index)
    }
}

/// The largest number of workgroups along one dimension of a dispatch, as WebGPU guarantees on every device.
pub(super) const MOST_GROUPS: usize = 65_535;

/// Returns the number of workgroups for `threads` threads.
pub(super) fn groups(threads: usize) -> u32 {
    threads.div_ceil(GROUP) as u32
}

impl SharedContext {
    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: None })
    }

    /// Returns a buffer. Its size is a multiple of four and never zero, since WebGPU cannot bind an empty buffer.
    pub fn buffer(&self, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes.max(16).next_multiple_of(4),
            usage,
            mapped_at_creation: false,
        })
    }

    /// Returns a buffer for `numbers` numbers that kernels read and write.
    pub fn storage(&self, numbers: usize) -> wgpu::Buffer {
        self.buffer(
            4 * numbers as u64,
            wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
        )
    }

    /// Returns a buffer that the CPU can read.
    pub fn staging(&self, bytes: u64) -> wgpu::Buffer {
        self.buffer(
            bytes,
            wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        )
    }

    /// Returns a buffer with a kernel's parameters.
    fn uniform<T: bytemuck::NoUninit>(&self, params: &[T], bytes: u64) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        self.filled(params, bytes, usage)
    }

    /// Returns a buffer with contents.
    pub fn filled<T: bytemuck::NoUninit>(
        &self,
        from: &[T],
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        let buffer = self.buffer(bytes, usage);
        self.write(&buffer, from);
        buffer
    }

    /// Writes to the start of a buffer.
    pub fn write<T: bytemuck::NoUninit>(&self, buffer: &wgpu::Buffer, from: &[T]) {
        self.write_at(buffer, 0, from);
    }

    /// Writes to a buffer from an offset in bytes on.
    pub fn write_at<T: bytemuck::NoUninit>(&self, buffer: &wgpu::Buffer, offset: u64, from: &[T]) {
        if !from.is_empty() {
            self.queue
                .write_buffer(buffer, offset, bytemuck::cast_slice(from));
        }
    }

    /// Returns a storage buffer with contents.
    pub fn stored<T: bytemuck::NoUninit>(&self, from: &[T]) -> wgpu::Buffer {
        self.filled(
            from,
            size_of_val(from) as u64,
            wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
        )
    }

    /// Returns the pipeline of an entry point, compiled at the first call.
    pub fn pipeline(
        &self,
        kernel: Kernel,
        entry: &'static str,
        text: impl FnOnce() -> String,
    ) -> wgpu::ComputePipeline {
        let place = Pipeline::clone(locked(&self.pipelines).entry((kernel, entry)).or_default());
        let make = || {
            log::debug!("compiling {entry} of {kernel:?}");
            self.compiled(entry, entry, text())
        };
        place.get_or_init(make).clone()
    }

    /// Compiles an entry point of a shader.
    pub fn compiled(&self, name: &str, entry: &str, text: String) -> wgpu::ComputePipeline {
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(name),
                source: wgpu::ShaderSource::Wgsl(text.into()),
            });
        self.device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout: None,
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    // Kernels write workgroup memory before they read it.
                    zero_initialize_workgroup_memory: false,
                    ..Default::default()
                },
                cache: None,
            })
    }

    /// Returns an error if the device is lost.
    pub fn alive(&self) -> Result<(), Error> {
        if self.lost.load(Ordering::Acquire) {
            return Err(Error::Gpu(GpuFault::DeviceLost));
        }
        Ok(())
    }

    /// Waits for a submission, or for all.
    pub fn wait(&self, submission: Option<wgpu::SubmissionIndex>) -> Result<(), Error> {
        self.alive()?;
        let waited = self.device.poll(wgpu::PollType::Wait {
            submission_index: submission,
            timeout: None,
        });
        self.alive()?;
        waited.map(|_| ()).map_err(|error| {
            log::error!("waiting: {error}");
            Error::Gpu(GpuFault::DeviceLost)
        })
    }

    /// Returns the error for a smallest unit of work of `numbers` numbers that exceeds a buffer.
    pub fn too_large(&self, numbers: usize) -> Error {
        Error::Gpu(GpuFault::TooLarge {
            bytes: 4 * numbers as u64,
            most: self.most_bytes,
        })
    }

    /// Runs calls of the device, and returns the device's faults as errors.
    pub fn guarded<T>(&self, run: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        self.alive()?;
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let out = run();
        let internal = pollster::block_on(internal.pop());
        let validation = pollster::block_on(validation.pop());
        let memory = pollster::block_on(memory.pop());
        self.alive()?;
        match memory.or(validation).or(internal) {
            None => out,
            Some(error) => {
                log::error!("{error}");
                Err(match error {
                    wgpu::Error::OutOfMemory { .. } => Error::Gpu(GpuFault::OutOfMemory),
                    _ => Error::Gpu(GpuFault::Shader),
                })
            }
        }
    }
}
