//! Lists that stay on the GPU: shapes, results, slopes.
use super::download::{Arrival, download, parts};
use super::source::{GpuShape, MOST_QUADS, TILE};
use super::work::{Params, Work, groups};
use super::{Gpu, Inner, Pending};
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{check_upstream, expect};
use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A buffer and how many items it holds.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub buffer: wgpu::Buffer,
    pub items: usize,
}

/// Shapes on the GPU, checked and prepared. Clones of a handle are the same shapes.
#[derive(Clone, Debug)]
pub struct Shapes<P> {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
    is_ordinary: Arc<AtomicBool>,
    shape: PhantomData<fn() -> P>,
}

/// One number per aligned pair, on the GPU. Clones of a handle are the same numbers.
#[derive(Clone, Debug)]
pub struct Values {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
}

/// Slopes with respect to every shape of a list, on the GPU. Clones of a handle are the same
/// numbers.
#[derive(Clone, Debug)]
pub struct Bars<P> {
    pub(super) gpu: Gpu,
    pub(super) pieces: Vec<Piece>,
    pub(super) len: usize,
    shape: PhantomData<fn() -> P>,
}

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
}

impl Gpu {
    /// Checks shapes, prepares them and brings them to the GPU.
    ///
    /// # Errors
    ///
    /// The input's for a shape that is not valid, or what the device says.
    pub fn upload<P: GpuShape>(&self, shapes: &[P]) -> Result<Shapes<P>, Error> {
        self.upload_as(Argument::Shape, shapes)
    }

    pub(crate) fn upload_as<P: GpuShape>(
        &self,
        argument: Argument,
        shapes: &[P],
    ) -> Result<Shapes<P>, Error> {
        let is_ordinary = checked(argument, shapes)?;
        self.inner.guarded(|| {
            let made = Shapes::room(self, shapes.len(), is_ordinary);
            made.write(shapes);
            Ok(made)
        })
    }

    /// Brings numbers to the GPU, such as the upstream gradient of aligned pairs.
    ///
    /// # Errors
    ///
    /// The input's for a number that is not finite, or what the device says.
    pub fn upload_values(&self, values: &[f32]) -> Result<Values, Error> {
        check_upstream(values, 1)?;
        self.inner.guarded(|| {
            let made = Values::room(self, values.len());
            made.write(values);
            Ok(made)
        })
    }
}

/// Checks shapes; whether all are ordinary.
fn checked<P: GpuShape>(argument: Argument, shapes: &[P]) -> Result<bool, Error> {
    let mut is_ordinary = true;
    for (row, shape) in shapes.iter().enumerate() {
        shape.validate().map_err(|flaw| Error::Invalid {
            argument,
            row,
            flaw,
        })?;
        is_ordinary &= shape.is_ordinary();
    }
    Ok(is_ordinary)
}

impl<P> Shapes<P> {
    /// The context that they are in.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }
}

impl<P: GpuShape> Shapes<P> {
    /// Room for shapes.
    pub(super) fn room(gpu: &Gpu, len: usize, is_ordinary: bool) -> Self {
        Shapes {
            gpu: gpu.clone(),
            pieces: gpu.inner.pieces(len, 4 * P::QUADS),
            len,
            is_ordinary: Arc::new(AtomicBool::new(is_ordinary)),
            shape: PhantomData,
        }
    }

    fn write(&self, shapes: &[P]) {
        let inner = &self.gpu.inner;
        for (piece, shapes) in self.pieces.iter().zip(shapes.chunks(inner.chunk)) {
            inner.write(&piece.buffer, &quads(shapes));
        }
    }

    /// Whether plain products of their numbers stay far from over- and underflow.
    pub(super) fn is_ordinary(&self) -> bool {
        self.is_ordinary.load(Ordering::Acquire)
    }

    /// Puts as many other shapes in their place: what a loop does that moves them. No buffer is
    /// made. Calls before it used the old ones, and keep their results.
    ///
    /// # Errors
    ///
    /// The input's for another number of shapes or one that is not valid (the old ones are
    /// then as they were), or what the device says.
    pub fn update(&mut self, shapes: &[P]) -> Result<(), Error> {
        expect(Argument::Shape, self.len, shapes.len())?;
        let is_ordinary = checked(Argument::Shape, shapes)?;
        self.gpu.inner.guarded(|| {
            self.write(shapes);
            self.is_ordinary.store(is_ordinary, Ordering::Release);
            Ok(())
        })
    }
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
    pub(super) fn room(gpu: &Gpu, len: usize) -> Self {
        Values {
            gpu: gpu.clone(),
            pieces: gpu.inner.pieces(len, 1),
            len,
        }
    }

    fn write(&self, values: &[f32]) {
        let inner = &self.gpu.inner;
        for (piece, values) in self.pieces.iter().zip(values.chunks(inner.chunk)) {
            inner.write(&piece.buffer, values);
        }
    }

    /// Puts as many other numbers in their place, without a new buffer.
    ///
    /// # Errors
    ///
    /// The input's for another number of them or one that is not finite, or what the device
    /// says.
    pub fn update(&mut self, values: &[f32]) -> Result<(), Error> {
        expect(Argument::Upstream, self.len, values.len())?;
        check_upstream(values, 1)?;
        self.gpu.inner.guarded(|| {
            self.write(values);
            Ok(())
        })
    }

    /// The same numbers in other buffers, copied by a kernel: also how fast memory can be had.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn duplicate(&self) -> Result<Values, Error> {
        self.gpu.inner.guarded(|| {
            let to = Values::room(&self.gpu, self.len);
            self.copy_to(&to)?;
            Ok(to)
        })
    }

    /// [`duplicate`](Values::duplicate) over numbers that are there already.
    ///
    /// # Errors
    ///
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), The input's for another number of them, or what the
    /// device says.
    pub fn duplicate_into(&self, to: &mut Values) -> Result<(), Error> {
        self.gpu.owns(&to.gpu)?;
        expect(Argument::Values, self.len, to.len)?;
        self.gpu.inner.guarded(|| self.copy_to(to))
    }

    fn copy_to(&self, to: &Values) -> Result<(), Error> {
        let inner = &self.gpu.inner;
        let pipeline = inner.gather_pipeline("copy_main");
        let mut work = Work::new(inner);
        for (from, to) in self.pieces.iter().zip(&to.pieces) {
            let params = Params {
                own_count: from.items as u32,
                ..Params::default()
            };
            let buffers = [(3, &from.buffer), (4, &to.buffer)];
            work.dispatch(&pipeline, params, &buffers, [groups(from.items), 1]);
        }
        work.submit().map(drop)
    }

    /// Brings the numbers back into a slice.
    ///
    /// # Errors
    ///
    /// The input's for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [f32]) -> Result<(), Error> {
        expect(Argument::Values, self.len, to.len())?;
        let inner = &self.gpu.inner;
        let mut rest = to.chunks_mut(inner.chunk);
        inner
            .bring(&self.gpu, &parts(&self.pieces, |n| n))?
            .finish(|_, numbers| {
                if let Some(to) = rest.next() {
                    to.copy_from_slice(bytemuck::cast_slice(numbers));
                }
            })
    }

    /// Starts bringing the numbers back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<f32>>, Error> {
        let len = self.len;
        let parts = parts(&self.pieces, |n| n);
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = Vec::with_capacity(len);
            arrival.read(|_, numbers| all.extend_from_slice(bytemuck::cast_slice(numbers)))?;
            Ok(all)
        }))
    }
}

impl<P: GpuShape> Bars<P> {
    pub(super) fn room(gpu: &Gpu, len: usize) -> Self {
        Bars {
            gpu: gpu.clone(),
            pieces: gpu.inner.pieces(len, P::LEN),
            len,
            shape: PhantomData,
        }
    }

    /// Starts bringing the slopes back, in the order of the shapes.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<P>>, Error> {
        let (len, chunk) = (self.len, self.gpu.inner.chunk);
        let arrival = self.bring()?;
        Ok(Pending::new(arrival, move |arrival| {
            let mut all = vec![P::filled(0.0); len];
            let mut rest = all.chunks_mut(chunk);
            arrival.read(|_, numbers| untile(numbers, rest.next().unwrap_or_default()))?;
            Ok(all)
        }))
    }

    /// Brings the slopes back into a slice.
    ///
    /// # Errors
    ///
    /// The input's for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [P]) -> Result<(), Error> {
        expect(Argument::Values, self.len, to.len())?;
        let mut rest = to.chunks_mut(self.gpu.inner.chunk);
        self.bring()?
            .finish(|_, numbers| untile(numbers, rest.next().unwrap_or_default()))
    }

    fn bring(&self) -> Result<Arrival, Error> {
        let whole = |n: usize| n.next_multiple_of(TILE) * P::LEN;
        let parts = parts(&self.pieces, whole);
        self.gpu.inner.bring(&self.gpu, &parts)
    }
}

/// Shapes out of tiles of single fields.
fn untile<P: GpuShape>(numbers: &[u32], to: &mut [P]) {
    let lanes: &[f32] = bytemuck::cast_slice(numbers);
    for (i, shape) in to.iter_mut().enumerate() {
        let tile = &lanes[i / TILE * P::LEN * TILE..];
        let mut fields = tile[i % TILE..].iter().step_by(TILE);
        shape.each(&mut |field| *field = *fields.next().unwrap_or(field));
    }
}

download! {
    [] Values => Vec<f32>;
    [P: GpuShape] Bars<P> => Vec<P>;
}
