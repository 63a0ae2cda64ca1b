//! Downloads of results: blocking, started and awaited later, or as futures.
use super::context::{Device, SharedContext, locked};
use super::data::BufferPiece;
use crate::kernels::machine::DeviceDownload;
use crate::{Error, GpuFault};
use std::future::Future;
use std::pin::Pin;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};
use std::time::Duration;

impl SharedContext {
    /// Starts the download of the first bytes of every buffer.
    pub fn bring(
        &self,
        gpu: &Device,
        parts: &[(&wgpu::Buffer, u64)],
    ) -> Result<BufferDownload, Error> {
        let whole: Vec<_> = parts
            .iter()
            .map(|&(from, bytes)| (from, 0, bytes))
            .collect();
        self.bring_parts(gpu, &whole)
    }

    /// Starts the download of a range of bytes of every buffer: first byte, number of bytes.
    pub fn bring_parts(
        &self,
        gpu: &Device,
        parts: &[(&wgpu::Buffer, u64, u64)],
    ) -> Result<BufferDownload, Error> {
        self.guarded(|| {
            let mut encoder = self.encoder();
            let mut staged = Vec::new();
            for &(buffer, start, bytes) in parts.iter().filter(|&&(_, _, bytes)| bytes > 0) {
                let staging = self.staging(bytes);
                encoder.copy_buffer_to_buffer(buffer, start, &staging, 0, bytes);
                staged.push((staging, bytes));
            }
            let submission = self.queue.submit([encoder.finish()]);
            let state = DownloadState::of(staged.iter().map(|(staging, _)| staging));
            Ok(BufferDownload {
                gpu: gpu.clone(),
                staged,
                state,
                submission,
                watched: false,
            })
        })
    }
}

/// The state of a download.
#[derive(Debug, Default)]
pub(super) struct DownloadState {
    left: AtomicUsize,
    failed: AtomicBool,
    waker: Mutex<Option<Waker>>,
    arrived: Condvar,
}

impl DownloadState {
    /// Maps buffers for reading.
    pub fn of<'a>(staged: impl ExactSizeIterator<Item = &'a wgpu::Buffer>) -> Arc<DownloadState> {
        let state = Arc::new(DownloadState {
            left: AtomicUsize::new(staged.len()),
            ..DownloadState::default()
        });
        for staging in staged {
            let state = Arc::clone(&state);
            staging.map_async(wgpu::MapMode::Read, .., move |mapped| {
                if let Err(error) = mapped {
                    log::error!("mapping: {error}");
                    state.failed.store(true, Ordering::Release);
                }
                let waker = {
                    let mut waker = locked(&state.waker);
                    state.left.fetch_sub(1, Ordering::AcqRel);
                    state.arrived.notify_all();
                    waker.take()
                };
                if let Some(waker) = waker {
                    waker.wake();
                }
            });
        }
        state
    }

    fn is_ready(&self) -> bool {
        self.left.load(Ordering::Acquire) == 0
    }

    /// Waits for a submission and for what it maps.
    ///
    /// The callback of a mapped buffer runs on any thread that polls the device, so the end of the submission does not
    /// end the wait.
    pub fn wait(
        &self,
        inner: &SharedContext,
        submission: &wgpu::SubmissionIndex,
    ) -> Result<(), Error> {
        inner.wait(Some(submission.clone()))?;
        let mut waker = locked(&self.waker);
        while !self.is_ready() {
            let told = self.arrived.wait_timeout(waker, PATIENCE);
            waker = told.unwrap_or_else(PoisonError::into_inner).0;
            inner.alive()?;
        }
        if self.failed.load(Ordering::Acquire) {
            return Err(Error::Gpu(GpuFault::OutOfMemory));
        }
        Ok(())
    }
}

/// The wait for another thread, after which it is checked that the device still exists.
const PATIENCE: Duration = Duration::from_millis(50);

/// Buffers that are being downloaded.
#[derive(Debug)]
pub(super) struct BufferDownload {
    gpu: Device,
    staged: Vec<(wgpu::Buffer, u64)>,
    state: Arc<DownloadState>,
    submission: wgpu::SubmissionIndex,
    watched: bool,
}

impl BufferDownload {
    /// Waits, then passes each part to `each`.
    pub fn finish(self, each: impl FnMut(usize, &[u32])) -> Result<(), Error> {
        self.wait()?;
        self.read(each)
    }

    fn wait(&self) -> Result<(), Error> {
        self.state.wait(&self.gpu.inner, &self.submission)
    }

    /// Passes each part to `each`, in order.
    pub fn read(&self, mut each: impl FnMut(usize, &[u32])) -> Result<(), Error> {
        self.gpu.inner.alive()?;
        if self.state.failed.load(Ordering::Acquire) {
            return Err(Error::Gpu(GpuFault::OutOfMemory));
        }
        for (part, (staging, bytes)) in self.staged.iter().enumerate() {
            let view = staging
                .get_mapped_range(..*bytes)
                .map_err(|_| Error::Gpu(GpuFault::DeviceLost))?;
            each(part, bytemuck::cast_slice(&view[..]));
        }
        Ok(())
    }
}

/// A conversion of downloaded buffers to the result.
type Make<T> = dyn FnMut(&BufferDownload) -> Result<T, Error> + Send;

/// A started download: wait for it with [`wait`](DevicePending::wait), or await it.
#[must_use = "nothing arrives unless waited for"]
pub struct DevicePending<T> {
    arrival: BufferDownload,
    make: Box<Make<T>>,
}

impl<T> std::fmt::Debug for DevicePending<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DevicePending")
            .field("is_ready", &self.arrival.state.is_ready())
            .finish_non_exhaustive()
    }
}

impl<T> DevicePending<T> {
    pub(super) fn new(
        arrival: BufferDownload,
        make: impl FnMut(&BufferDownload) -> Result<T, Error> + Send + 'static,
    ) -> Self {
        DevicePending {
            arrival,
            make: Box::new(make),
        }
    }

    /// Returns `true` if the numbers have arrived. Never blocks.
    ///
    /// # Errors
    ///
    /// [`GpuFault::DeviceLost`](crate::GpuFault::DeviceLost).
    pub fn is_ready(&self) -> Result<bool, Error> {
        let inner = &self.arrival.gpu.inner;
        inner.alive()?;
        let polled = inner.device.poll(wgpu::PollType::Poll);
        inner.alive()?;
        polled.map_err(|_| Error::Gpu(GpuFault::DeviceLost))?;
        Ok(self.arrival.state.is_ready())
    }

    /// Waits for the numbers.
    ///
    /// # Errors
    ///
    /// [`GpuFault::DeviceLost`](crate::GpuFault::DeviceLost), or
    /// [`GpuFault::OutOfMemory`](crate::GpuFault::OutOfMemory) when memory for them is missing.
    pub fn wait(mut self) -> Result<T, Error> {
        self.arrival.wait()?;
        (self.make)(&self.arrival)
    }
}

impl<T> Future for DevicePending<T> {
    type Output = Result<T, Error>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let this = self.get_mut();
        *locked(&this.arrival.state.waker) = Some(context.waker().clone());
        match this.is_ready() {
            Ok(true) => return Poll::Ready((this.make)(&this.arrival)),
            Ok(false) => {}
            Err(error) => return Poll::Ready(Err(error)),
        }
        if !this.arrival.watched {
            this.arrival.watched = true;
            // A thread polls the device while the task sleeps.
            let (gpu, state) = (this.arrival.gpu.clone(), Arc::clone(&this.arrival.state));
            let submission = this.arrival.submission.clone();
            std::thread::spawn(move || {
                let _ = gpu.inner.wait(Some(submission));
                if let Some(waker) = locked(&state.waker).take() {
                    waker.wake();
                }
            });
        }
        Poll::Pending
    }
}

/// Returns the buffers of some pieces and the numbers of bytes to download; `numbers` is the number of scalars of some
/// items.
pub(super) fn parts(
    pieces: &[BufferPiece],
    numbers: impl Fn(usize) -> usize,
) -> Vec<(&wgpu::Buffer, u64)> {
    pieces
        .iter()
        .map(|piece| (&piece.buffer, 4 * numbers(piece.items) as u64))
        .collect()
}

impl<T> DeviceDownload<T> for DevicePending<T> {
    fn wait(self: Box<Self>) -> Result<T, Error> {
        DevicePending::wait(*self)
    }
}

/// Implements the download methods of the machines' interface for a handle that has `start_download`.
macro_rules! downloads {
    ($out:ty) => {
        fn started(&self) -> Result<crate::kernels::resident::Pending<$out>, Error> {
            Ok(crate::kernels::resident::Pending::later(
                self.start_download()?,
            ))
        }
        fn taken(self: Box<Self>) -> Result<$out, Error> {
            self.start_download()?.wait()
        }
        fn boxed(&self) -> Box<dyn Downloads<$out>> {
            Box::new(self.clone())
        }
        fn any(&self) -> &dyn std::any::Any {
            self
        }
    };
}

pub(super) use downloads;
