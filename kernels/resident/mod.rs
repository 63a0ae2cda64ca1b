//! Data that stay where a [`Backend`] computes, between calls: the same code on the CPU and on a GPU.
//!
//! Columns go up once, results stay as handles, calls chain on handles, and only what is asked for comes back. On
//! the CPU a handle is the data itself, so nothing is lost there.
//!
//! [`Backend::resident`] has the calls of [`Cpu`](crate::kernels::Cpu) for any operation and any program
//! ([`Resident`]): `upload`, `aligned`, `all_pairs`, adjoints and reductions, over handles of any shapes ([`Held`]).
//!
//! Boxes in the plane and rings have kernels by hand on GPUs, with handles of their own: [`Backend::upload`] and
//! [`Backend::upload_rings`].
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, IouObb2};
//! let backend = Backend::Cpu; // or of a GPU
//! let mut guesses = vec![Obb2::new(0.4, 0.0, 2.0, 2.0, 0.0); 3];
//! let truths = vec![Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0); 3];
//!
//! let (mut a, b) = (backend.upload(&guesses)?, backend.upload(&truths)?);
//! let (mut iou, mut slopes, mut unused) = a.aligned_grad(IouObb2, &b)?;
//! for _ in 0..20 {
//!     for (guess, slope) in guesses.iter_mut().zip(slopes.download()?) {
//!         guess.center += slope.center * 0.05;
//!     }
//!     a.update(&guesses)?; // into the same buffers, and so are the results
//!     a.aligned_grad_into(IouObb2, &b, &mut iou, &mut slopes, &mut unused)?;
//! }
//! assert!(iou.download()?.iter().all(|&iou| iou > 0.95));
//!
//! let matrix = a.all_pairs(IouObb2, &b)?;
//! let best = matrix.row_max()?;            // of a matrix that is there already
//! let matched = b.pick(&best)?;            // the truth of every guess
//! assert!(a.aligned(IouObb2, &matched)?.download()?[0] > 0.95);
//! # Ok::<(), geograd::Error>(())
//! ```
use crate::GpuFault;
use crate::error::{Argument, Error};
use crate::kernels::Backend;
use crate::kernels::cpu::checked::{check_upstream, expect};
use crate::kernels::gpu::{self, GpuPair, GpuShape};
use crate::kernels::on_cpu::PairGrads;
use crate::kernels::reduce::{self, Best, Found};
use crate::{Fixed, Vec2};
use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

/// On the CPU the data, on a GPU a handle.
#[derive(Clone, Debug)]
enum Side<C, G> {
    Cpu(C),
    #[cfg_attr(not(feature = "gpu"), allow(dead_code))]
    Gpu(G),
}

/// Runs the one where all are the CPU's, the other where all are a GPU's, and refuses a mixture.
macro_rules! on {
    ($($name:ident = $of:expr),+; $cpu:expr; $gpu:expr) => {
        match ($($of,)+) {
            ($(Side::Cpu($name),)+) => $cpu,
            #[cfg(feature = "gpu")]
            ($(Side::Gpu($name),)+) => $gpu,
            #[allow(unreachable_patterns)]
            _ => Err($crate::Error::Gpu($crate::GpuFault::ForeignBuffer)),
        }
    };
}

mod held;
mod matrix;
mod pairs;
mod ring;

pub use held::{Held, HeldColumns, Resident};
pub use pairs::Slopes;
pub use ring::Rings;

/// Handles: name, what is kept on the CPU and on a GPU, what comes back and how.
macro_rules! handles {
    ($($(#[$doc:meta])* $name:ident[$($p:ident: $bound:ident)?] $cpu:ty, $gpu:ty => $out:ty = $get:expr;)*) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name<$($p: $bound)?>(Side<$cpu, $gpu>);

        impl<$($p: $bound)?> $name<$($p)?> {
            /// Brings it back and waits for it.
            ///
            /// # Errors
            ///
            /// What the device says.
            pub fn download(&self) -> Result<$out, Error> {
                self.start_download()?.wait()
            }

            /// Starts bringing it back. On the CPU it is there at once.
            ///
            /// # Errors
            ///
            /// What the device says.
            pub fn start_download(&self) -> Result<Pending<$out>, Error> {
                on!(own = &self.0;
                    Ok(Pending(Side::Cpu(Some($get(own)))));
                    Ok(Pending(Side::Gpu(own.start_download()?))))
            }
        }
    )* };
}

handles! {
    /// One number per aligned pair.
    Values[] Vec<f32>, gpu::Values => Vec<f32> = Vec::clone;
    /// Slopes with respect to every shape of a list.
    Bars[P: GpuShape] Vec<P>, gpu::Bars<P> => Vec<P> = Vec::clone;
    /// One number per row of one list and row of another.
    Matrix[] reduce::Matrix, gpu::Matrix => Vec<f32> = |own: &reduce::Matrix| own.values.clone();
    /// The largest score of every row or column and where it is.
    Bests[] (Vec<Best>, usize), gpu::Bests => Vec<Best> = |own: &(Vec<Best>, usize)| own.0.clone();
    /// Pairs whose score is above a threshold, row by row and within a row by column.
    Founds[] Vec<Found>, gpu::Founds => Vec<Found> = Vec::clone;
    /// One result per ring.
    RingValues[T: RingResult] Vec<T>, gpu::RingValues<T> => Vec<T> = Vec::clone;
    /// One slope per vertex.
    RingBars[] Vec<Vec2<f32>>, gpu::RingBars => Vec<Vec2<f32>> = Vec::clone;
    /// The results of all pairs and their slopes.
    PairBars[O: GpuPair] PairGrads<O>, gpu::PairBars<O> => PairGrads<O> = Clone::clone;
}

/// A result of an operation of rings.
pub trait RingResult: Fixed<Scalar = f32> + 'static {}
impl<T: Fixed<Scalar = f32> + 'static> RingResult for T {}

/// A download that was started: wait for it, or await it.
#[must_use = "nothing arrives unless waited for"]
#[derive(Debug)]
pub struct Pending<T>(Side<Option<T>, gpu::Pending<T>>);

impl<T> Pending<T> {
    /// Waits for it.
    ///
    /// # Errors
    ///
    /// [`GpuFault::DeviceLost`], or [`GpuFault::OutOfMemory`] when there is no room for it.
    pub fn wait(self) -> Result<T, Error> {
        on!(own = self.0; own.ok_or(Error::Gpu(GpuFault::DeviceLost)); own.wait())
    }
}

impl<T: Unpin> Future for Pending<T> {
    type Output = Result<T, Error>;

    #[cfg_attr(not(feature = "gpu"), allow(unused_variables))]
    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        match &mut self.get_mut().0 {
            // Polled again after it was ready, it has nothing more to give.
            Side::Cpu(own) => own.take().map_or(Poll::Pending, |own| Poll::Ready(Ok(own))),
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => Pin::new(own).poll(context),
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => Poll::Ready(Err(Error::Gpu(GpuFault::NotBuilt))),
        }
    }
}

/// Shapes, checked and ready.
#[derive(Clone, Debug)]
pub struct Shapes<P>(Side<Vec<P>, gpu::Shapes<P>>);

impl Backend<'_> {
    /// Checks shapes and brings them to where it computes.
    ///
    /// # Errors
    ///
    /// The input's for a shape that is not valid, or what the device says.
    pub fn upload<P: GpuShape>(self, shapes: &[P]) -> Result<Shapes<P>, Error> {
        Ok(Shapes(match self {
            Backend::Cpu => Side::Cpu(checked(shapes)?.to_vec()),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Side::Gpu(gpu.upload(shapes)?),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }))
    }

    /// Brings numbers to where it computes, such as an upstream gradient.
    ///
    /// # Errors
    ///
    /// The input's for a number that is not finite, or what the device says.
    pub fn upload_values(self, values: &[f32]) -> Result<Values, Error> {
        Ok(Values(match self {
            Backend::Cpu => {
                check_upstream(values, 1)?;
                Side::Cpu(values.to_vec())
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Side::Gpu(gpu.upload_values(values)?),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }))
    }

    /// Brings a matrix to where it computes, row by row.
    ///
    /// # Errors
    ///
    /// The input's for a number that is not finite or a slice of another length than rows
    /// times columns, or what the device says.
    pub fn upload_matrix(
        self,
        rows: usize,
        columns: usize,
        values: &[f32],
    ) -> Result<Matrix, Error> {
        Ok(Matrix(match self {
            Backend::Cpu => {
                let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
                expect(Argument::Upstream, expected, values.len())?;
                check_upstream(values, 1)?;
                Side::Cpu(reduce::Matrix::new(rows, columns, values.to_vec())?)
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Side::Gpu(gpu.upload_matrix(rows, columns, values)?),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }))
    }
}

/// The same shapes, all of them valid.
fn checked<P: GpuShape>(shapes: &[P]) -> Result<&[P], Error> {
    for (row, shape) in shapes.iter().enumerate() {
        shape.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Shape,
            row,
            flaw,
        })?;
    }
    Ok(shapes)
}

impl<P: GpuShape> Bars<P> {
    /// Brings the slopes back into a slice.
    ///
    /// # Errors
    ///
    /// The input's for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [P]) -> Result<(), Error> {
        on!(own = &self.0;
        {
            expect(Argument::Values, own.len(), to.len())?;
            to.copy_from_slice(own);
            Ok(())
        };
        own.download_into(to))
    }
}

impl Values {
    /// Brings the numbers back into a slice.
    ///
    /// # Errors
    ///
    /// The input's for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [f32]) -> Result<(), Error> {
        on!(own = &self.0;
        {
            expect(Argument::Values, own.len(), to.len())?;
            to.copy_from_slice(own);
            Ok(())
        };
        own.download_into(to))
    }

    /// Puts as many other numbers in their place.
    ///
    /// # Errors
    ///
    /// The input's for another number of them or one that is not finite, or what the device
    /// says.
    pub fn update(&mut self, values: &[f32]) -> Result<(), Error> {
        on!(own = &mut self.0;
        {
            expect(Argument::Upstream, own.len(), values.len())?;
            check_upstream(values, 1)?;
            own.copy_from_slice(values);
            Ok(())
        };
        own.update(values))
    }
}
