//! Data that stay on the machine between calls: the same code for the CPU and for a GPU.
//!
//! [`upload`](Machine::upload) makes an array on the machine, a column of every call. Results of such columns
//! stay there, too, so that calls chain; only [`download`](Held::download) brings data back. Slices and
//! [`One`](crate::kernels::One) may stand beside arrays. On the CPU an array is the data itself, at no cost.
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, Iou, Op};
//! let here = Backend::Cpu; // or a GPU
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
use crate::error::{Argument, Error};
use crate::kernels::item::counts::{check_finite, expect};
use crate::kernels::machine::found::{Best, Found};
use crate::kernels::machine::{Reduced, Reduction};
use crate::{Fixed, GpuFault, Real, Vec2};
use std::any::Any;
use std::fmt;

mod held;
pub(crate) mod pending;

pub(crate) use held::Stays;
pub(crate) use held::numbers_of;
pub use held::{Held, Stored};
pub use pending::Pending;

#[doc(inline)]
#[cfg(doc)]
use crate::kernels::machine::Machine;

/// Columns of plain numbers that stay on the machine.
pub type HeldNumbers = Stored<f32>;

/// The error for data of another machine.
pub(crate) const FOREIGN: Error = Error::Gpu(GpuFault::ForeignBuffer);

/// A result that stays on a machine until it is wanted.
pub(crate) trait Downloads<X>: Send + Sync {
    /// Starts its download.
    #[doc(hidden)]
    fn started(&self) -> Result<Pending<X>, Error>;
    /// The result itself, if it is in the memory of the program.
    #[doc(hidden)]
    fn taken(self: Box<Self>) -> Result<X, Error>;
    #[doc(hidden)]
    fn boxed(&self) -> Box<dyn Downloads<X>>;
    #[doc(hidden)]
    fn any(&self) -> &dyn Any;
}

/// A result in the memory of the program.
#[derive(Clone, Debug)]
pub(crate) struct Ready<X>(pub X);

impl<X: Clone + Send + Sync + 'static> Downloads<X> for Ready<X> {
    fn started(&self) -> Result<Pending<X>, Error> {
        Ok(Pending::ready(self.0.clone()))
    }
    fn taken(self: Box<Self>) -> Result<X, Error> {
        Ok(self.0)
    }
    fn boxed(&self) -> Box<dyn Downloads<X>> {
        Box::new(self.clone())
    }
    fn any(&self) -> &dyn Any {
        self
    }
}

/// Handles of results: a name, and what comes back.
macro_rules! handles {
    ($($(#[$doc:meta])* $name:ident<$p:ident: [$($bound:tt)+] $(= $default:ty)?> $({ $more:ident: $type:ty })? => $out:ty;)*) => { $(
        $(#[$doc])*
        pub struct $name<$p: $($bound)+ $(= $default)?> {
            found: Box<dyn Downloads<$out>>,
            $(pub(crate) $more: $type,)?
        }

        impl<$p: $($bound)+> fmt::Debug for $name<$p> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($name)).finish_non_exhaustive()
            }
        }

        impl<$p: $($bound)+> Clone for $name<$p> {
            fn clone(&self) -> Self {
                $name { found: self.found.boxed() $(, $more: self.$more)? }
            }
        }

        impl<$p: $($bound)+> $name<$p> {
            pub(crate) fn new(found: impl Downloads<$out> + 'static $(, $more: $type)?) -> Self {
                $name { found: Box::new(found) $(, $more)? }
            }
            /// The handle of a machine, if it is of that one.
            #[allow(dead_code)]
            pub(crate) fn own<D: 'static>(&self) -> Result<&D, Error> {
                self.found.any().downcast_ref().ok_or(FOREIGN)
            }

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
                self.found.started()
            }

            /// What comes back, without a copy where it is in the memory of the program.
            #[allow(dead_code)]
            pub(crate) fn taken(self) -> Result<$out, Error> {
                self.found.taken()
            }
        }
    )* };
}

handles! {
    /// The largest score of every row or column, with its place among so many.
    Bests<T: [Real] = f32> { among: usize } => Vec<Best<T>>;
    /// Pairs whose score is above a threshold, row by row and within a row by column.
    Founds<T: [Real] = f32> => Vec<Found<T>>;
    /// One result per ring.
    RingValues<T: [Fixed<Scalar = f32> + 'static]> => Vec<T>;
    /// One cotangent per vertex.
    RingBars<T: [Real] = f32> => Vec<Vec2<T>>;
}

/// A matrix of a machine.
pub(crate) trait Matrices<T: Real>: fmt::Debug + Send + Sync {
    #[doc(hidden)]
    fn size(&self) -> [usize; 2];
    #[doc(hidden)]
    fn update(&mut self, values: &[T]) -> Result<(), Error>;
    #[doc(hidden)]
    fn started(&self) -> Result<Pending<Vec<T>>, Error>;
    /// A reduction, which was checked.
    #[doc(hidden)]
    fn reduce(&self, reduction: Reduction<T>) -> Result<Reduced<T>, Error>;
    #[doc(hidden)]
    fn duplicate(&self) -> Result<Matrix<T>, Error>;
    #[doc(hidden)]
    fn duplicate_into(&self, to: &mut Matrix<T>) -> Result<(), Error>;
    #[doc(hidden)]
    fn boxed(&self) -> Matrix<T>;
    #[doc(hidden)]
    fn any(&self) -> &dyn Any;
    #[doc(hidden)]
    fn any_mut(&mut self) -> &mut dyn Any;
}

/// One number per pair of two lists, row by row, on a machine.
#[derive(Debug)]
pub struct Matrix<T: Real = f32>(pub(crate) Box<dyn Matrices<T>>);

impl<T: Real> Clone for Matrix<T> {
    fn clone(&self) -> Self {
        self.0.boxed()
    }
}

impl<T: Real> Matrix<T> {
    /// The matrix of a machine, if it is of that one.
    pub(crate) fn own<M: 'static>(&self) -> Result<&M, Error> {
        self.0.any().downcast_ref().ok_or(FOREIGN)
    }
    pub(crate) fn own_mut<M: 'static>(&mut self) -> Result<&mut M, Error> {
        self.0.any_mut().downcast_mut().ok_or(FOREIGN)
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.0.size()[0]
    }
    /// The number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.0.size()[1]
    }

    /// Downloads it and waits for it.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn download(&self) -> Result<Vec<T>, Error> {
        self.start_download()?.wait()
    }

    /// Starts the download, which is complete at once on the CPU.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<Pending<Vec<T>>, Error> {
        self.0.started()
    }

    /// Replaces the numbers by as many others, in the same buffers.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another number of values, [`Error::Invalid`] for one that is not finite, and the errors of
    /// the device.
    pub fn update(&mut self, values: &[T]) -> Result<(), Error> {
        expect(
            Argument::Upstream,
            self.rows() * self.columns(),
            values.len(),
        )?;
        check_finite(Argument::Upstream, values)?;
        self.0.update(values)
    }

    /// A copy of the numbers on the same machine.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn duplicate(&self) -> Result<Matrix<T>, Error> {
        self.0.duplicate()
    }

    /// [`duplicate`](Matrix::duplicate) into another matrix of the same size; it measures the speed of memory.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for a matrix of another size, [`GpuFault::ForeignBuffer`] for one of another machine, and
    /// those of the device.
    pub fn duplicate_into(&self, to: &mut Matrix<T>) -> Result<(), Error> {
        self.0.duplicate_into(to)
    }
}

/// Reductions of a matrix on the machine.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($arg:ident)?) -> $out:ty = $reduction:expr, $taken:ident;)*) => {
        impl<T: Real> Matrix<T> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// [`Error::Length`] for rows or columns of nothing, [`Error::Invalid`] for a threshold that is not finite,
            /// and the errors of the device.
            pub fn $name(&self $(, $arg: T)?) -> Result<$out, Error> {
                let reduction: Reduction<T> = $reduction;
                reduction.check(self.rows(), self.columns())?;
                Ok(self.0.reduce(reduction)?.$taken())
            }
        )* }
    };
}

reductions! {
    /// The largest number of every row and its column; of several the first.
    row_max() -> Bests<T> = Reduction::Best { of_rows: true }, bests;
    /// The largest number of every column and its row; of several the first.
    column_max() -> Bests<T> = Reduction::Best { of_rows: false }, bests;
    /// Every number above the threshold, with its place.
    above(threshold) -> Founds<T> = Reduction::Above(threshold), founds;
    /// The count of numbers above the threshold.
    count_above(threshold) -> u64 = Reduction::Count(threshold), count;
    /// The sum of all numbers.
    sum() -> f64 = Reduction::Sum, sum;
}

impl<T: Real> Matrix<T> {
    /// The mean of all numbers; 0 without any.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn mean(&self) -> Result<f64, Error> {
        Ok(self.sum()? / (self.rows() as f64 * self.columns() as f64).max(1.0))
    }
}
