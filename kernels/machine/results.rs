//! Results that stay on a machine until they are downloaded: reductions, measures of rings, and matrices with their
//! reductions.
use super::found::{Best, Found, check_sides, check_threshold};
use super::machine_column::FOREIGN;
use super::pending::Pending;
use crate::error::{Argument, Error};
use crate::kernels::row::item::counts::{check_finite, expect};
use crate::{Fixed, Real, Vec2};
use std::any::Any;
use std::fmt;

/// A result that stays on a machine until it is downloaded.
pub(crate) trait Downloads<X>: Send + Sync {
    /// Starts the download.
    #[doc(hidden)]
    fn started(&self) -> Result<Pending<X>, Error>;
    /// Returns the result, without a copy if it is in the memory of the program.
    #[doc(hidden)]
    fn taken(self: Box<Self>) -> Result<X, Error>;
    #[doc(hidden)]
    fn boxed(&self) -> Box<dyn Downloads<X>>;
    #[doc(hidden)]
    fn any(&self) -> &dyn Any;
}

/// A result in the memory of the program.
#[derive(Clone, Debug)]
pub(crate) struct InMemory<X>(pub X);

impl<X: Clone + Send + Sync + 'static> Downloads<X> for InMemory<X> {
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

/// Defines handles of results: a name, and the downloaded type.
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
            /// Returns the handle of machine type `D`, or an error for another machine.
            #[allow(dead_code)]
            pub(crate) fn own<D: 'static>(&self) -> Result<&D, Error> {
                self.found.any().downcast_ref().ok_or(FOREIGN)
            }

            /// Downloads the result and waits for it.
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

            /// Returns the result, without a copy if it is in the memory of the program.
            #[allow(dead_code)]
            pub(crate) fn taken(self) -> Result<$out, Error> {
                self.found.taken()
            }
        }
    )* };
}

handles! {
    /// The largest score of every row or column, with its index below `among`.
    Bests<T: [Real] = f32> { among: usize } => Vec<Best<T>>;
    /// Pairs whose score is above a threshold, ordered by row and then by column.
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
    /// Reduces the matrix; the reduction was checked.
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

/// One number per pair of two lists, in row-major order, on a machine.
#[derive(Debug)]
pub struct Matrix<T: Real = f32>(pub(crate) Box<dyn Matrices<T>>);

impl<T: Real> Clone for Matrix<T> {
    fn clone(&self) -> Self {
        self.0.boxed()
    }
}

impl<T: Real> Matrix<T> {
    /// Returns the matrix of machine type `M`, or an error for another machine.
    pub(crate) fn own<M: 'static>(&self) -> Result<&M, Error> {
        self.0.any().downcast_ref().ok_or(FOREIGN)
    }
    pub(crate) fn own_mut<M: 'static>(&mut self) -> Result<&mut M, Error> {
        self.0.any_mut().downcast_mut().ok_or(FOREIGN)
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.0.size()[0]
    }
    /// Returns the number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.0.size()[1]
    }

    /// Downloads the matrix and waits for it.
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

    /// Replaces the numbers by as many others, in place.
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

    /// Returns a copy of the matrix on its machine.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn duplicate(&self) -> Result<Matrix<T>, Error> {
        self.0.duplicate()
    }

    /// Copies the numbers to another matrix of equal size; this measures the speed of memory.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for a matrix of another size, [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for
    /// one of another machine, and the errors of the device.
    pub fn duplicate_into(&self, to: &mut Matrix<T>) -> Result<(), Error> {
        self.0.duplicate_into(to)
    }
}

/// Defines the reductions of a matrix on the machine.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($arg:ident)?) -> $out:ty = $reduction:expr, $taken:ident;)*) => {
        impl<T: Real> Matrix<T> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// [`Error::Length`] for the largest of an empty row or column, [`Error::Invalid`] for a threshold that is
            /// not finite, and the errors of the device.
            pub fn $name(&self $(, $arg: T)?) -> Result<$out, Error> {
                let reduction: Reduction<T> = $reduction;
                reduction.check(self.rows(), self.columns())?;
                Ok(self.0.reduce(reduction)?.$taken())
            }
        )* }
    };
}

reductions! {
    /// Returns the largest number of every row and its column; the first of equal ones.
    row_max() -> Bests<T> = Reduction::Best { of_rows: true }, bests;
    /// Returns the largest number of every column and its row; the first of equal ones.
    column_max() -> Bests<T> = Reduction::Best { of_rows: false }, bests;
    /// Returns every number above the threshold, with its row and column.
    above(threshold) -> Founds<T> = Reduction::Above(threshold), founds;
    /// Returns the number of entries above the threshold.
    count_above(threshold) -> u64 = Reduction::Count(threshold), count;
    /// Returns the sum of all numbers.
    sum() -> f64 = Reduction::Sum, sum;
}

impl<T: Real> Matrix<T> {
    /// Returns the mean of all numbers; 0 for an empty matrix.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn mean(&self) -> Result<f64, Error> {
        Ok(self.sum()? / (self.rows() as f64 * self.columns() as f64).max(1.0))
    }
}

/// A reduction of all results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reduction<T> {
    /// The largest result of every row, or of every column.
    Best {
        /// `true` for rows.
        of_rows: bool,
    },
    /// The pairs above a threshold.
    Above(T),
    /// The number of pairs above a threshold.
    Count(T),
    /// The sum.
    Sum,
}

impl<T: Real> Reduction<T> {
    /// Returns an error for the largest result of nothing, and for a threshold that is not finite.
    pub(crate) fn check(self, rows: usize, columns: usize) -> Result<(), Error> {
        match self {
            Reduction::Best { of_rows } => check_sides(rows, columns, of_rows),
            Reduction::Above(threshold) | Reduction::Count(threshold) => check_threshold(threshold),
            Reduction::Sum => Ok(()),
        }
    }
}

/// A reduction of the pairs within groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GroupedReduction<T> {
    /// The largest result of every row, or of every column, within its group; none without pairs.
    Best {
        /// `true` for rows.
        of_rows: bool,
    },
    /// The pairs above a threshold, ordered by row and then by column.
    Above(T),
}

/// The result of a reduction, on the machine.
#[derive(Clone, Debug)]
pub enum Reduced<T: Real> {
    /// The largest results of rows or columns.
    Bests(Bests<T>),
    /// The largest results of rows or columns within groups.
    BestsGrouped(Vec<Option<Best<T>>>),
    /// The pairs above a threshold.
    Founds(Founds<T>),
    /// The number of pairs above a threshold.
    Count(u64),
    /// The sum.
    Sum(f64),
}

/// Defines the functions that unwrap [`Reduced`], one for every kind.
macro_rules! taken {
    ($($name:ident: $kind:ident -> $out:ty;)*) => {
        impl<T: Real> Reduced<T> { $(
            pub(crate) fn $name(self) -> $out {
                match self {
                    Reduced::$kind(found) => found,
                    _ => unreachable!("a reduction gives what it is asked for"),
                }
            }
        )* }
    };
}
taken! {
    bests: Bests -> Bests<T>;
    bests_grouped: BestsGrouped -> Vec<Option<Best<T>>>;
    founds: Founds -> Founds<T>;
    count: Count -> u64;
    sum: Sum -> f64;
}
