//! Data that stays on the GPU: shapes, results, slopes, matrices; and how they come back.
use super::source::{GpuShape, MOST_QUADS, TILE};
use super::work::{Params, Work, groups};
use super::{Gpu, Inner};
use crate::error::{Argument, Error};
use crate::kernels::GpuError;
use crate::kernels::tile::{check_upstream, expect};
use std::future::Future;
use std::marker::PhantomData;
use std::pin::Pin;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};
use std::time::Duration;

/// A buffer and how many items it holds.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub buffer: wgpu::Buffer,
    pub items: usize,
}

/// Shapes on the GPU, checked and prepared.
#[derive(Clone, Debug)]
pub struct Shapes<P> {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
    pub(super) is_ordinary: bool,
    shape: PhantomData<fn() -> P>,
}

/// One number per aligned pair, on the GPU.
#[derive(Clone, Debug)]
pub struct Values {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
}

/// Slopes with respect to every shape of a list, on the GPU.
#[derive(Clone, Debug)]
pub struct Bars<P> {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
    shape: PhantomData<fn() -> P>,
}

/// A part of a matrix that fits one buffer: rows of one piece of `a` by all columns of one piece
/// of `b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// Which piece of `a`, where in it the rows begin, and the first one's index in the list.
    pub row_piece: usize,
    pub row_start: usize,
    pub row_base: usize,
    pub rows: usize,
    /// Which piece of `b`, and the first column's index in the list.
    pub column_piece: usize,
    pub column_base: usize,
    pub columns: usize,
}

/// A matrix on the GPU: one number per row of one list and row of another.
#[derive(Clone, Debug)]
pub struct Matrix {
    pub(super) gpu: Gpu,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) blocks: Vec<(Block, wgpu::Buffer)>,
}

/// Cuts a matrix into blocks of at most so many pairs. `a` and `b` are the items of each piece.
fn blocks(a: &[usize], b: &[usize], most_pairs: usize) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut base = 0;
    // The widest piece of columns sets the height of all blocks, so that blocks of a band have the
    // same rows.
    let widest = b.iter().copied().max().unwrap_or(1);
    let most_rows = (most_pairs / widest).clamp(1, MOST_ROWS);
    for (row_piece, &items) in a.iter().enumerate() {
        let mut row_start = 0;
        while row_start < items {
            let rows = most_rows.min(items - row_start);
            let mut column_base = 0;
            for (column_piece, &columns) in b.iter().enumerate() {
                blocks.push(Block {
                    row_piece,
                    row_start,
                    row_base: base + row_start,
                    rows,
                    column_piece,
                    column_base,
                    columns,
                });
                column_base += columns;
            }
            row_start += rows;
        }
        base += items;
    }
    blocks
}

/// Rows per block: what one dimension of a dispatch may hold.
const MOST_ROWS: usize = 65_535 * super::source::STEP;

/// Pairs per dispatch: drivers reset a GPU that is busy with one for seconds.
const MOST_PAIRS: u64 = 1 << 30;

impl Inner {
    /// Buffers for a list of items of so many numbers each.
    pub fn pieces(&self, len: usize, fields: usize) -> Vec<Piece> {
        self.counted(len)
            .into_iter()
            .map(|items| {
                let buffer = self.storage(items.next_multiple_of(TILE) * fields);
                Piece { buffer, items }
            })
            .collect()
    }

    /// Starts bringing numbers back.
    pub fn bring(&self, gpu: &Gpu, parts: &[(&wgpu::Buffer, u64)]) -> Result<Arrival, GpuError> {
        self.guarded(|| {
            let mut encoder = self.encoder();
            let mut staged = Vec::new();
            for &(buffer, bytes) in parts.iter().filter(|&&(_, bytes)| bytes > 0) {
                let staging = self.staging(bytes);
                encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, bytes);
                staged.push((staging, bytes));
            }
            let submission = self.queue.submit([encoder.finish()]);
            let state = State::of(staged.iter().map(|(staging, _)| staging));
            Ok(Arrival {
                gpu: gpu.clone(),
                staged,
                state,
                submission,
                watched: false,
            })
        })
    }
}

/// How far a download is.
#[derive(Debug, Default)]
pub(super) struct State {
    left: AtomicUsize,
    failed: AtomicBool,
    waker: Mutex<Option<Waker>>,
    arrived: Condvar,
}

impl State {
    /// Maps buffers for reading.
    pub fn of<'a>(staged: impl ExactSizeIterator<Item = &'a wgpu::Buffer>) -> Arc<State> {
        let state = Arc::new(State {
            left: AtomicUsize::new(staged.len()),
            ..State::default()
        });
        for staging in staged {
            let state = Arc::clone(&state);
            staging.map_async(wgpu::MapMode::Read, .., move |mapped| {
                if let Err(error) = mapped {
                    log::error!("mapping: {error}");
                    state.failed.store(true, Ordering::Release);
                }
                let waker = {
                    let mut waker = super::locked(&state.waker);
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
    /// Any thread that drives the device may be the one that is told of a mapped buffer, so the
    /// end of the submission is not the end of the wait.
    pub fn wait(&self, inner: &Inner, submission: &wgpu::SubmissionIndex) -> Result<(), GpuError> {
        inner.wait(Some(submission.clone()))?;
        let mut waker = super::locked(&self.waker);
        while !self.is_ready() {
            let told = self.arrived.wait_timeout(waker, PATIENCE);
            waker = told.unwrap_or_else(PoisonError::into_inner).0;
            inner.alive()?;
        }
        if self.failed.load(Ordering::Acquire) {
            return Err(GpuError::OutOfMemory);
        }
        Ok(())
    }
}

/// How long to wait for another thread before looking whether the device is still there.
const PATIENCE: Duration = Duration::from_millis(50);

/// Buffers on their way to the processor.
#[derive(Debug)]
pub(super) struct Arrival {
    gpu: Gpu,
    staged: Vec<(wgpu::Buffer, u64)>,
    state: Arc<State>,
    submission: wgpu::SubmissionIndex,
    watched: bool,
}

impl Arrival {
    /// Waits, then hands each part over.
    pub fn finish(self, each: impl FnMut(usize, &[u32])) -> Result<(), GpuError> {
        self.wait()?;
        self.read(each)
    }

    fn wait(&self) -> Result<(), GpuError> {
        self.state.wait(&self.gpu.inner, &self.submission)
    }

    /// Hands each part over, in order.
    pub fn read(&self, mut each: impl FnMut(usize, &[u32])) -> Result<(), GpuError> {
        self.gpu.inner.alive()?;
        if self.state.failed.load(Ordering::Acquire) {
            return Err(GpuError::OutOfMemory);
        }
        for (part, (staging, bytes)) in self.staged.iter().enumerate() {
            let view = staging
                .get_mapped_range(..*bytes)
                .map_err(|_| GpuError::DeviceLost)?;
            each(part, bytemuck::cast_slice(&view[..]));
        }
        Ok(())
    }
}

/// Makes what was asked for out of what arrived.
type Make<T> = dyn FnMut(&Arrival) -> Result<T, GpuError> + Send;

/// A download that was started: wait for it with [`wait`](Pending::wait), or await it.
#[must_use = "nothing arrives unless waited for"]
pub struct Pending<T> {
    arrival: Arrival,
    make: Box<Make<T>>,
}

impl<T> std::fmt::Debug for Pending<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Pending")
            .field("is_ready", &self.arrival.state.is_ready())
            .finish_non_exhaustive()
    }
}

impl<T> Pending<T> {
    pub(super) fn new(
        arrival: Arrival,
        make: impl FnMut(&Arrival) -> Result<T, GpuError> + Send + 'static,
    ) -> Self {
        Pending {
            arrival,
            make: Box::new(make),
        }
    }

    /// Whether the numbers have arrived. Never blocks.
    ///
    /// # Errors
    ///
    /// [`GpuError::DeviceLost`].
    pub fn is_ready(&self) -> Result<bool, GpuError> {
        let inner = &self.arrival.gpu.inner;
        inner.alive()?;
        let polled = inner.device.poll(wgpu::PollType::Poll);
        inner.alive()?;
        polled.map_err(|_| GpuError::DeviceLost)?;
        Ok(self.arrival.state.is_ready())
    }

    /// Waits for the numbers.
    ///
    /// # Errors
    ///
    /// [`GpuError::DeviceLost`], or [`GpuError::OutOfMemory`] when they have no room.
    pub fn wait(mut self) -> Result<T, GpuError> {
        self.arrival.wait()?;
        (self.make)(&self.arrival)
    }
}

impl<T> Future for Pending<T> {
    type Output = Result<T, GpuError>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let this = self.get_mut();
        *super::locked(&this.arrival.state.waker) = Some(context.waker().clone());
        match this.is_ready() {
            Ok(true) => return Poll::Ready((this.make)(&this.arrival)),
            Ok(false) => {}
            Err(error) => return Poll::Ready(Err(error)),
        }
        if !this.arrival.watched {
            this.arrival.watched = true;
            // Somebody has to drive the device while the task sleeps.
            let (gpu, state) = (this.arrival.gpu.clone(), Arc::clone(&this.arrival.state));
            let submission = this.arrival.submission.clone();
            std::thread::spawn(move || {
                let _ = gpu.inner.wait(Some(submission));
                if let Some(waker) = super::locked(&state.waker).take() {
                    waker.wake();
                }
            });
        }
        Poll::Pending
    }
}

impl Gpu {
    /// Checks shapes, prepares them and brings them to the GPU.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] for a shape that is not valid, or what the device says.
    pub fn upload<P: GpuShape>(&self, shapes: &[P]) -> Result<Shapes<P>, GpuError> {
        self.upload_as(Argument::Shape, shapes)
    }

    pub(super) fn upload_as<P: GpuShape>(
        &self,
        argument: Argument,
        shapes: &[P],
    ) -> Result<Shapes<P>, GpuError> {
        let mut is_ordinary = true;
        for (row, shape) in shapes.iter().enumerate() {
            shape.validate().map_err(|flaw| Error::Invalid {
                argument,
                row,
                flaw,
            })?;
            is_ordinary &= shape.is_ordinary();
        }
        let pieces = self.inner.guarded(|| {
            let pieces = shapes.chunks(self.inner.chunk).map(|shapes| Piece {
                buffer: self.inner.stored(&quads(shapes)),
                items: shapes.len(),
            });
            Ok(pieces.collect())
        })?;
        Ok(Shapes {
            gpu: self.clone(),
            pieces,
            len: shapes.len(),
            is_ordinary,
            shape: PhantomData,
        })
    }

    /// Brings numbers to the GPU, such as the upstream gradient of aligned pairs.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] for a number that is not finite, or what the device says.
    pub fn upload_values(&self, values: &[f32]) -> Result<Values, GpuError> {
        check_upstream(values)?;
        let pieces = self.inner.guarded(|| {
            let pieces = values.chunks(self.inner.chunk).map(|values| Piece {
                buffer: self.inner.stored(values),
                items: values.len(),
            });
            Ok(pieces.collect())
        })?;
        Ok(Values {
            gpu: self.clone(),
            pieces,
            len: values.len(),
        })
    }

    /// Brings a matrix to the GPU, such as the upstream gradient of all pairs of two lists.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] for a number that is not finite or a slice of another length than
    /// rows times columns, or what the device says.
    pub fn upload_matrix(
        &self,
        rows: usize,
        columns: usize,
        values: &[f32],
    ) -> Result<Matrix, GpuError> {
        let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
        expect(Argument::Upstream, expected, values.len())?;
        check_upstream(values)?;
        let inner = &self.inner;
        let blocks = inner.guarded(|| {
            let made = inner
                .cut(rows, columns, 4)
                .into_iter()
                .map(|block| (block, inner.stored(&block_of(&block, columns, values))));
            Ok(made.collect())
        })?;
        Ok(Matrix {
            gpu: self.clone(),
            rows,
            columns,
            blocks,
        })
    }
}

/// The numbers of one block of a matrix, row by row.
pub(super) fn block_of(block: &Block, columns: usize, values: &[f32]) -> Vec<f32> {
    let mut own = Vec::with_capacity(block.rows * block.columns);
    for row in block.row_base..block.row_base + block.rows {
        own.extend_from_slice(&values[row * columns + block.column_base..][..block.columns]);
    }
    own
}

/// Prepared shapes in tiles.
fn quads<P: GpuShape>(shapes: &[P]) -> Vec<[f32; 4]> {
    let mut tiles = vec![[0.0; 4]; shapes.len().next_multiple_of(TILE) * P::QUADS];
    let fill = |(shapes, tile): (&[P], &mut [[f32; 4]])| {
        for (i, &shape) in shapes.iter().enumerate() {
            let quads: [[f32; 4]; MOST_QUADS] = shape.quads();
            for (q, &quad) in quads[..P::QUADS].iter().enumerate() {
                tile[q * TILE + i] = quad;
            }
        }
    };
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        let tiles = tiles.par_chunks_mut(TILE * P::QUADS);
        shapes.par_chunks(TILE).zip(tiles).for_each(fill);
    }
    #[cfg(not(feature = "parallel"))]
    {
        let tiles = tiles.chunks_mut(TILE * P::QUADS);
        shapes.chunks(TILE).zip(tiles).for_each(fill);
    }
    tiles
}

impl Inner {
    /// How a list is cut: the items of each piece.
    fn counted(&self, len: usize) -> Vec<usize> {
        (0..len.div_ceil(self.chunk))
            .map(|i| self.chunk.min(len - i * self.chunk))
            .collect()
    }

    /// How a matrix is cut, of whose pairs each takes so many bytes.
    pub fn cut(&self, rows: usize, columns: usize, bytes: u64) -> Vec<Block> {
        let most_pairs = (self.most_bytes / bytes).min(MOST_PAIRS) as usize;
        blocks(&self.counted(rows), &self.counted(columns), most_pairs)
    }
}

/// The number of items of each handle, and what comes back of it.
macro_rules! list {
    ($($name:ident $(<$p:ident: $bound:ident>)?,)*) => { $(
        impl$(<$p>)? $name$(<$p>)? {
            /// How many items.
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
    )* };
}
list!(Shapes<P: GpuShape>, Bars<P: GpuShape>, Values,);

impl Values {
    /// The same numbers in other buffers, copied by a kernel: also how fast memory can be had.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn duplicate(&self) -> Result<Values, GpuError> {
        let inner = &self.gpu.inner;
        inner.guarded(|| {
            let pipeline = inner.copy_pipeline();
            let pieces = inner.pieces(self.len, 1);
            let mut work = Work::new(inner);
            for (from, to) in self.pieces.iter().zip(&pieces) {
                let params = Params {
                    own_count: from.items as u32,
                    ..Params::default()
                };
                let buffers = [(3, &from.buffer), (4, &to.buffer)];
                work.dispatch(&pipeline, params, &buffers, [groups(from.items), 1]);
            }
            work.submit()?;
            Ok(Values {
                gpu: self.gpu.clone(),
                pieces,
                len: self.len,
            })
        })
    }

    /// Starts bringing the numbers back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<f32>>, GpuError> {
        let len = self.len;
        let arrival = self
            .gpu
            .inner
            .bring(&self.gpu, &parts(&self.pieces, |n| n))?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = Vec::with_capacity(len);
            arrival.read(|_, numbers| all.extend_from_slice(bytemuck::cast_slice(numbers)))?;
            Ok(all)
        }))
    }

    /// Brings the numbers back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<f32>, GpuError> {
        self.start_download()?.wait()
    }
}

/// What to bring back of each piece, whose numbers follow from its items.
pub(super) fn parts(
    pieces: &[Piece],
    numbers: impl Fn(usize) -> usize,
) -> Vec<(&wgpu::Buffer, u64)> {
    pieces
        .iter()
        .map(|piece| (&piece.buffer, 4 * numbers(piece.items) as u64))
        .collect()
}

impl<P: GpuShape> Bars<P> {
    pub(super) fn new(gpu: &Gpu, len: usize) -> Self {
        Bars {
            gpu: gpu.clone(),
            pieces: gpu.inner.pieces(len, P::LEN),
            len,
            shape: PhantomData,
        }
    }

    /// Starts bringing the slopes back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<P>>, GpuError> {
        let items: Vec<usize> = self.pieces.iter().map(|piece| piece.items).collect();
        let whole = |n: usize| n.next_multiple_of(TILE) * P::LEN;
        let arrival = self
            .gpu
            .inner
            .bring(&self.gpu, &parts(&self.pieces, whole))?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = Vec::with_capacity(items.iter().sum());
            arrival.read(|part, numbers| {
                let lanes: &[f32] = bytemuck::cast_slice(numbers);
                let mut fields = P::filled(0.0).to_array();
                for i in 0..items[part] {
                    let tile = &lanes[i / TILE * P::LEN * TILE..];
                    for (k, field) in fields.as_mut().iter_mut().enumerate() {
                        *field = tile[k * TILE + i % TILE];
                    }
                    all.push(P::from_array(fields));
                }
            })?;
            Ok(all)
        }))
    }

    /// Brings the slopes back, in the order of the shapes.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<P>, GpuError> {
        self.start_download()?.wait()
    }
}

impl Matrix {
    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// How many columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Starts bringing the matrix back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<f32>>, GpuError> {
        let (rows, columns) = (self.rows, self.columns);
        let blocks: Vec<Block> = self.blocks.iter().map(|&(block, _)| block).collect();
        let parts: Vec<_> = self
            .blocks
            .iter()
            .map(|(block, buffer)| (buffer, 4 * (block.rows * block.columns) as u64))
            .collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = vec![0.0; rows * columns];
            arrival.read(|part, numbers| {
                place_block(
                    &blocks[part],
                    columns,
                    bytemuck::cast_slice(numbers),
                    &mut all,
                );
            })?;
            Ok(all)
        }))
    }

    /// Brings the matrix back, row by row.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<f32>, GpuError> {
        self.start_download()?.wait()
    }
}

/// Copies a block to its place in a matrix of so many columns.
pub(super) fn place_block(block: &Block, columns: usize, from: &[f32], to: &mut [f32]) {
    for (i, row) in from.chunks_exact(block.columns).enumerate() {
        let at = (block.row_base + i) * columns + block.column_base;
        to[at..][..block.columns].copy_from_slice(row);
    }
}
