//! Data that stay on the machine between calls: the same code for the CPU and for a GPU.
//!
//! [`Backend::resident`] has the calls of [`Cpu`](crate::kernels::Cpu) for any operation and any program over
//! handles: columns are uploaded once, results stay as handles, calls chain on handles, and only
//! [`download`](Held::download) brings data back. On the CPU a handle is the data itself, at no cost.
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, Iou, Op};
//! let here = Backend::Cpu.resident(); // or of a GPU
//! let mut guesses = vec![Obb2::new(0.4, 0.0, 2.0, 2.0, 0.0); 3];
//! let truths = vec![Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0); 3];
//!
//! let (mut a, b) = (here.upload(&guesses)?, here.upload(&truths)?);
//! let mut found = here.aligned(Iou.value_grad(), (&a, &b))?;
//! for _ in 0..20 {
//!     let (_, (derivatives, _)) = found.download()?;
//!     for (guess, derivative) in guesses.iter_mut().zip(derivatives) {
//!         guess.center += derivative.center * 0.05;
//!     }
//!     a.update(&guesses)?; // into the same buffers, and so are the results
//!     here.aligned_into(Iou.value_grad(), (&a, &b), &mut found)?;
//! }
//! let (iou, _) = found.split(); // a handle of each part
//! assert!(iou.download()?.iter().all(|&iou| iou > 0.95));
//!
//! let matrix = here.all_pairs(Iou, &a, &b)?;
//! let best = matrix.row_max()?; // of a matrix that is there already
//! let matched = here.pick(&b, &best)?; // the truth of every guess
//! assert!(here.aligned(Iou, (&a, &matched))?.download()?[0] > 0.95);
//! # Ok::<(), geograd::Error>(())
//! ```
use crate::GpuFault;
use crate::error::{Argument, Error};
use crate::kernels::Backend;
use crate::kernels::cpu::checked::{check_upstream, expect};
use crate::kernels::gpu;
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

mod calls;
mod held;
mod matrix;
mod numbers;
mod pairs;
mod rings;

pub use held::{Held, HeldColumns};
#[doc(hidden)]
pub use numbers::HeldNumbers;
pub use rings::Rings;

/// Handles: name, what is kept on the CPU and on a GPU, what comes back and how.
macro_rules! handles {
    ($($(#[$doc:meta])* $name:ident[$($p:ident: $bound:ident)?] $cpu:ty, $gpu:ty => $out:ty = $get:expr;)*) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name<$($p: $bound)?>(Side<$cpu, $gpu>);

        impl<$($p: $bound)?> $name<$($p)?> {
            /// Downloads it and waits for it.
            ///
            /// # Errors
            ///
            /// The errors of the device.
            pub fn download(&self) -> Result<$out, Error> {
                self.start_download()?.wait()
            }

            /// Starts the download, which is complete at once on the CPU.
            ///
            /// # Errors
            ///
            /// The errors of the device.
            pub fn start_download(&self) -> Result<Pending<$out>, Error> {
                on!(own = &self.0;
                    Ok(Pending(Side::Cpu(Some($get(own)))));
                    Ok(Pending(Side::Gpu(own.start_download()?))))
            }
        }
    )* };
}

handles! {
    /// One number per pair of two lists, row by row.
    Matrix[] reduce::Matrix, gpu::Matrix => Vec<f32> = |own: &reduce::Matrix| own.values.clone();
    /// The largest score of every row or column, with its place.
    Bests[] (Vec<Best>, usize), gpu::Bests => Vec<Best> = |own: &(Vec<Best>, usize)| own.0.clone();
    /// Pairs whose score is above a threshold, row by row and within a row by column.
    Founds[] Vec<Found>, gpu::Founds => Vec<Found> = Vec::clone;
    /// One result per ring.
    RingValues[T: RingResult] Vec<T>, gpu::RingValues<T> => Vec<T> = Vec::clone;
    /// One cotangent per vertex.
    RingBars[] Vec<Vec2<f32>>, gpu::RingBars => Vec<Vec2<f32>> = Vec::clone;
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

/// The calls of [`Cpu`](crate::kernels::Cpu) on data that stay on the machine: [`Backend::resident`] returns it.
///
/// ```
/// use geograd::kernels::{Backend, Distance, Iou, Op, One};
/// use geograd::{Obb3, Rotation3, Segment2, Vec2, Vec3};
/// let resident = Backend::Cpu.resident(); // or of a GPU
///
/// let boxes = |turn| {
///     let size = Vec3::new(4.0, 2.0, 1.5);
///     [0.0, 5.0].map(|x| Obb3::new(Vec3::new(x, 0.0, 0.0), size, Rotation3::new(1.0, 0.0, 0.0, turn)))
/// };
/// let (a, b) = (resident.upload(&boxes(0.0))?, resident.upload(&boxes(0.1))?);
/// let iou = resident.aligned(Iou, (&a, &b))?; // stays there
/// let matrix = resident.all_pairs(Iou, &a, &b)?; // of the same boxes: nothing goes up again
/// assert_eq!(matrix.download()?[3], iou.download()?[1]);
///
/// // Results are arguments of what comes next: here derivatives, times those of what is made of the distances.
/// let points = resident.upload(&[Vec2::new(0.0, 1.0), Vec2::new(3.0, 0.0)])?;
/// let wall = One(Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(2.0, 0.0)));
/// let (distances, _) = resident.aligned(Distance.value_grad(), (&points, wall))?.split();
/// let derivatives = resident.aligned(Distance.vjp(), ((&points, wall), &distances))?;
/// assert_eq!(derivatives.download()?.0, [Vec2::new(0.0, 1.0), Vec2::new(1.0, 0.0)]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Resident<'a>(Backend<'a>);

impl<'a> Backend<'a> {
    /// The same calls on data that stay on the machine.
    #[must_use]
    pub fn resident(self) -> Resident<'a> {
        Resident(self)
    }
}

impl Resident<'_> {
    /// Uploads a matrix, row by row.
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
        Ok(Matrix(match self.0 {
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

impl Matrix {
    /// A copy of the numbers on the same machine.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn duplicate(&self) -> Result<Matrix, Error> {
        on!(own = &self.0;
            Ok(Matrix(Side::Cpu(own.clone())));
            Ok(Matrix(Side::Gpu(own.duplicate()?))))
    }

    /// [`duplicate`](Matrix::duplicate) into another matrix of the same size; it measures the speed of memory.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for a matrix of another size, [`GpuFault::ForeignBuffer`] for one of another backend, or
    /// those of the device.
    pub fn duplicate_into(&self, to: &mut Matrix) -> Result<(), Error> {
        on!(own = &self.0, to = &mut to.0;
        {
            expect(Argument::Values, own.rows(), to.rows())?;
            expect(Argument::Values, own.columns(), to.columns())?;
            to.values.copy_from_slice(&own.values);
            Ok(())
        };
        own.duplicate_into(to))
    }
}
