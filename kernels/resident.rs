//! Data that stay where a [`Backend`] computes, between calls: the same code on the CPU and on a GPU.
//!
//! Shapes go up once ([`Backend::upload`]), results stay as handles, calls chain on handles, and only
//! what is asked for comes back. On the CPU a handle is the data itself, so nothing is lost there.
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, IouObb2};
//! let backend = Backend::Cpu; // or of a GPU
//! let mut guesses = vec![Obb2::new(0.4, 0.0, 2.0, 2.0, 0.0); 3];
//! let truths = vec![Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0); 3];
//!
//! let (mut a, b) = (backend.upload(&guesses)?, backend.upload(&truths)?);
//! let (mut iou, mut slopes, mut unused) = a.aligned_grad::<IouObb2>(&b)?;
//! for _ in 0..20 {
//!     for (guess, slope) in guesses.iter_mut().zip(slopes.download()?) {
//!         guess.center += slope.center * 0.05;
//!     }
//!     a.update(&guesses)?; // into the same buffers, and so are the results
//!     a.aligned_grad_into::<IouObb2>(&b, &mut iou, &mut slopes, &mut unused)?;
//! }
//! assert!(iou.download()?.iter().all(|&iou| iou > 0.95));
//!
//! let matrix = a.all_pairs::<IouObb2>(&b)?;
//! let best = matrix.row_max()?;            // of a matrix that is there already
//! let matched = b.pick(&best)?;            // the truth of every guess
//! assert!(a.aligned::<IouObb2>(&matched)?.download()?[0] > 0.95);
//! # Ok::<(), geograd::kernels::GpuError>(())
//! ```
use crate::error::{Argument, Error};
use crate::kernels::cpu::{self, PairGrads};
use crate::kernels::gpu::{self, GpuPair, GpuShape};
use crate::kernels::reduce::{self, Best, Found};
use crate::kernels::tile::{check_upstream, expect};
use crate::kernels::{Backend, GpuError};
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
            _ => Err(GpuError::ForeignBuffer),
        }
    };
}

/// Handles: name, what is kept on the CPU and on a GPU, what comes back and how.
macro_rules! handles {
    ($($(#[$doc:meta])* $name:ident[$($p:ident: $bound:ident)?] $cpu:ty, $gpu:ty => $out:ty = $get:expr;)*) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub struct $name<$($p)?>(Side<$cpu, $gpu>);

        impl<$($p: $bound)?> $name<$($p)?> {
            /// Brings it back and waits for it.
            ///
            /// # Errors
            ///
            /// What the device says.
            pub fn download(&self) -> Result<$out, GpuError> {
                self.start_download()?.wait()
            }

            /// Starts bringing it back. On the CPU it is there at once.
            ///
            /// # Errors
            ///
            /// What the device says.
            pub fn start_download(&self) -> Result<Pending<$out>, GpuError> {
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
    /// The results of all pairs and their slopes.
    PairBars[O: GpuPair] PairGrads<O, f32>, gpu::PairBars<O> => PairGrads<O, f32> = PairGrads::clone;
}

/// A download that was started: wait for it, or await it.
#[must_use = "nothing arrives unless waited for"]
#[derive(Debug)]
pub struct Pending<T>(Side<Option<T>, gpu::Pending<T>>);

impl<T> Pending<T> {
    /// Waits for it.
    ///
    /// # Errors
    ///
    /// [`GpuError::DeviceLost`], or [`GpuError::OutOfMemory`] when there is no room for it.
    pub fn wait(self) -> Result<T, GpuError> {
        on!(own = self.0; own.ok_or(GpuError::DeviceLost); own.wait())
    }
}

impl<T: Unpin> Future for Pending<T> {
    type Output = Result<T, GpuError>;

    #[cfg_attr(not(feature = "gpu"), allow(unused_variables))]
    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        match &mut self.get_mut().0 {
            // Polled again after it was ready, it has nothing more to give.
            Side::Cpu(own) => own.take().map_or(Poll::Pending, |own| Poll::Ready(Ok(own))),
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => Pin::new(own).poll(context),
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => Poll::Ready(Err(GpuError::NotBuilt)),
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
    /// [`GpuError::Input`] for a shape that is not valid, or what the device says.
    pub fn upload<P: GpuShape>(self, shapes: &[P]) -> Result<Shapes<P>, GpuError> {
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
    /// [`GpuError::Input`] for a number that is not finite, or what the device says.
    pub fn upload_values(self, values: &[f32]) -> Result<Values, GpuError> {
        Ok(Values(match self {
            Backend::Cpu => {
                check_upstream(values)?;
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
    /// [`GpuError::Input`] for a number that is not finite or a slice of another length than rows
    /// times columns, or what the device says.
    pub fn upload_matrix(
        self,
        rows: usize,
        columns: usize,
        values: &[f32],
    ) -> Result<Matrix, GpuError> {
        Ok(Matrix(match self {
            Backend::Cpu => {
                let expected = rows.checked_mul(columns).ok_or(Error::TooLarge)?;
                expect(Argument::Upstream, expected, values.len())?;
                check_upstream(values)?;
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

/// Shapes of an operation, and slopes with respect to them.
type ShapesOf<O> = Shapes<<O as GpuPair>::Shape>;
type BarsOf<O> = Bars<<O as GpuPair>::Shape>;
/// Slopes with respect to both lists.
pub type Slopes<O> = (BarsOf<O>, BarsOf<O>);

/// The calls of two lists that give something new: the macro lists them.
macro_rules! calls {
    ($($(#[$doc:meta])* $name:ident($($arg:ident: $type:ty),*) -> $out:ty
        = |$a:ident, $b:ident| $cpu:expr; |$gpu:ident| $wrap:expr;)*) => { $(
        $(#[$doc])*
        ///
        /// # Errors
        ///
        /// [`GpuError::Input`] as on the CPU, [`GpuError::ForeignBuffer`] for handles of different
        /// backends, or what the device says.
        pub fn $name<O: GpuPair<Shape = P>>(
            &self,
            b: &Shapes<P>,
            $($arg: $type),*
        ) -> Result<$out, GpuError> {
            on!($a = &self.0, $b = &b.0;
                Ok($cpu);
                {
                    let $gpu = $a.gpu().$name::<O>($a, $b, $($arg),*)?;
                    Ok($wrap)
                })
        }
    )* };
}

impl<P: GpuShape> Shapes<P> {
    calls! {
        /// [`cpu::aligned`].
        aligned() -> Values
            = |a, b| Values(Side::Cpu(cpu::aligned::<O, f32>(a, b)?));
            |x| Values(Side::Gpu(x));
        /// [`cpu::aligned_grad`].
        aligned_grad() -> (Values, BarsOf<O>, BarsOf<O>)
            = |a, b| {
                let (values, a_bar, b_bar) = cpu::aligned_grad::<O, f32>(a, b)?;
                (Values(Side::Cpu(values)), Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (Values(Side::Gpu(x.0)), Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`cpu::all_pairs`].
        all_pairs() -> Matrix
            = |a, b| {
                let values = cpu::all_pairs::<O, f32>(a, b)?;
                Matrix(Side::Cpu(reduce::Matrix::new(a.len(), b.len(), values)?))
            };
            |x| Matrix(Side::Gpu(x));
        /// [`cpu::all_pairs_grad`].
        all_pairs_grad() -> PairBars<O>
            = |a, b| PairBars(Side::Cpu(cpu::all_pairs_grad::<O, f32>(a, b)?));
            |x| PairBars(Side::Gpu(x));
        /// [`reduce::sum_grad`].
        sum_grad() -> (f64, BarsOf<O>, BarsOf<O>)
            = |a, b| {
                let (sum, a_bar, b_bar) = reduce::sum_grad::<O, f32>(a, b)?;
                (sum, Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (x.0, Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`reduce::mean_grad`].
        mean_grad() -> (f64, BarsOf<O>, BarsOf<O>)
            = |a, b| {
                let (mean, a_bar, b_bar) = reduce::mean_grad::<O, f32>(a, b)?;
                (mean, Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (x.0, Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`reduce::row_max`].
        row_max() -> Bests
            = |a, b| Bests(Side::Cpu((reduce::row_max::<O, f32>(a, b)?, b.len())));
            |x| Bests(Side::Gpu(x));
        /// [`reduce::column_max`].
        column_max() -> Bests
            = |a, b| Bests(Side::Cpu((reduce::column_max::<O, f32>(a, b)?, a.len())));
            |x| Bests(Side::Gpu(x));
        /// [`reduce::above`].
        above(threshold: f32) -> Founds
            = |a, b| Founds(Side::Cpu(reduce::above::<O, f32>(a, b, threshold)?));
            |x| Founds(Side::Gpu(x));
        /// [`reduce::count_above`].
        count_above(threshold: f32) -> u64
            = |a, b| reduce::count_above::<O, f32>(a, b, threshold)?;
            |x| x;
        /// [`reduce::sum`].
        sum() -> f64
            = |a, b| reduce::sum::<O, f32>(a, b)?;
            |x| x;
        /// [`reduce::mean`].
        mean() -> f64
            = |a, b| reduce::mean::<O, f32>(a, b)?;
            |x| x;
    }

    /// [`cpu::aligned_vjp`].
    ///
    /// # Errors
    ///
    /// As [`aligned`](Shapes::aligned), and for an upstream of another length.
    pub fn aligned_vjp<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        upstream: &Values,
    ) -> Result<Slopes<O>, GpuError> {
        on!(a = &self.0, b = &b.0, upstream = &upstream.0;
        {
            let (a_bar, b_bar) = cpu::aligned_vjp::<O, f32>(a, b, upstream)?;
            Ok((Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar))))
        };
        {
            let (a_bar, b_bar) = a.gpu().aligned_vjp::<O>(a, b, upstream)?;
            Ok((Bars(Side::Gpu(a_bar)), Bars(Side::Gpu(b_bar))))
        })
    }

    /// [`cpu::all_pairs_vjp`].
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Shapes::all_pairs), and for an upstream of another size.
    pub fn all_pairs_vjp<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        upstream: &Matrix,
    ) -> Result<Slopes<O>, GpuError> {
        on!(a = &self.0, b = &b.0, upstream = &upstream.0;
        {
            fits(a, b, upstream, Argument::Upstream)?;
            let (a_bar, b_bar) = cpu::all_pairs_vjp::<O, f32>(a, b, &upstream.values)?;
            Ok((Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar))))
        };
        {
            let (a_bar, b_bar) = a.gpu().all_pairs_vjp::<O>(a, b, upstream)?;
            Ok((Bars(Side::Gpu(a_bar)), Bars(Side::Gpu(b_bar))))
        })
    }

    /// [`aligned`](Shapes::aligned) over results that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Shapes::aligned), and for results of another length.
    pub fn aligned_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        values: &mut Values,
    ) -> Result<(), GpuError> {
        on!(a = &self.0, b = &b.0, values = &mut values.0;
            Ok(cpu::aligned_into::<O, f32>(a, b, values)?);
            a.gpu().aligned_into::<O>(a, b, values))
    }

    /// [`aligned_grad`](Shapes::aligned_grad) over results and slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Shapes::aligned), and for results or slopes of another length.
    pub fn aligned_grad_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        values: &mut Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), GpuError> {
        on!(a = &self.0, b = &b.0, v = &mut values.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(cpu::aligned_grad_into::<O, f32>(a, b, v, x, y)?);
            a.gpu().aligned_grad_into::<O>(a, b, v, x, y))
    }

    /// [`aligned_vjp`](Shapes::aligned_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned_vjp`](Shapes::aligned_vjp), and for slopes of another length.
    pub fn aligned_vjp_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        upstream: &Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), GpuError> {
        on!(a = &self.0, b = &b.0, u = &upstream.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(cpu::aligned_vjp_into::<O, f32>(a, b, u, x, y)?);
            a.gpu().aligned_vjp_into::<O>(a, b, u, x, y))
    }

    /// [`all_pairs`](Shapes::all_pairs) over a matrix that is there already.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Shapes::all_pairs), and for a matrix of another size.
    pub fn all_pairs_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        matrix: &mut Matrix,
    ) -> Result<(), GpuError> {
        on!(a = &self.0, b = &b.0, matrix = &mut matrix.0;
        {
            fits(a, b, matrix, Argument::Values)?;
            Ok(cpu::all_pairs_into::<O, f32>(a, b, &mut matrix.values)?)
        };
        a.gpu().all_pairs_into::<O>(a, b, matrix))
    }

    /// [`all_pairs_vjp`](Shapes::all_pairs_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Shapes::all_pairs_vjp), and for slopes of another length.
    pub fn all_pairs_vjp_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        upstream: &Matrix,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), GpuError> {
        on!(a = &self.0, b = &b.0, u = &upstream.0, x = &mut a_bar.0, y = &mut b_bar.0;
        {
            fits(a, b, u, Argument::Upstream)?;
            Ok(cpu::all_pairs_vjp_into::<O, f32>(a, b, &u.values, x, y)?)
        };
        a.gpu().all_pairs_vjp_into::<O>(a, b, u, x, y))
    }

    /// The sum of all results; over slopes that are there already those of the sum times `factor`:
    /// [`reduce::sum_grad_into`].
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Shapes::sum_grad), and for slopes of another length or a factor that is not
    /// finite.
    pub fn sum_grad_into<O: GpuPair<Shape = P>>(
        &self,
        b: &ShapesOf<O>,
        factor: f32,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<f64, GpuError> {
        on!(a = &self.0, b = &b.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(reduce::sum_grad_into::<O, f32>(a, b, factor, x, y)?);
            a.gpu().sum_grad_into::<O>(a, b, factor, x, y))
    }

    /// Puts as many other shapes in their place: what a loop does that moves them. On a GPU no
    /// buffer is made.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] for another number of shapes or one that is not valid (the old ones are
    /// then as they were), or what the device says.
    pub fn update(&mut self, shapes: &[P]) -> Result<(), GpuError> {
        on!(own = &mut self.0;
        {
            expect(Argument::Shape, own.len(), shapes.len())?;
            own.copy_from_slice(checked(shapes)?);
            Ok(())
        };
        own.update(shapes))
    }

    /// The shape of this list that each row (or column) found best: `b.pick(&row_max)` has as many
    /// shapes as `a`, ready to be aligned with it.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], [`GpuError::Input`] for results about a list of another length,
    /// or what the device says.
    pub fn pick(&self, bests: &Bests) -> Result<Shapes<P>, GpuError> {
        on!(own = &self.0, bests = &bests.0;
        {
            expect(Argument::Shape, bests.1, own.len())?;
            let picked = bests.0.iter().map(|best| own[best.index]).collect();
            Ok(Shapes(Side::Cpu(picked)))
        };
        Ok(Shapes(Side::Gpu(own.pick(bests)?))))
    }
}

/// Refuses a matrix of another size than two lists have.
fn fits<P>(a: &[P], b: &[P], matrix: &reduce::Matrix, argument: Argument) -> Result<(), Error> {
    expect(argument, a.len(), matrix.rows())?;
    expect(argument, b.len(), matrix.columns())
}

impl<P: GpuShape> Bars<P> {
    /// Brings the slopes back into a slice.
    ///
    /// # Errors
    ///
    /// [`GpuError::Input`] for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [P]) -> Result<(), GpuError> {
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
    /// [`GpuError::Input`] for a slice of another length, or what the device says.
    pub fn download_into(&self, to: &mut [f32]) -> Result<(), GpuError> {
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
    /// [`GpuError::Input`] for another number of them or one that is not finite, or what the device
    /// says.
    pub fn update(&mut self, values: &[f32]) -> Result<(), GpuError> {
        on!(own = &mut self.0;
        {
            expect(Argument::Upstream, own.len(), values.len())?;
            check_upstream(values)?;
            own.copy_from_slice(values);
            Ok(())
        };
        own.update(values))
    }
}

/// What a matrix that is there already is reduced to: the macro lists the calls.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($arg:ident)?) -> $out:ty
        = |$cpu:ident| $held:expr; |$gpu:ident| $wrap:expr;)*) => {
        impl Matrix { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// [`GpuError::Input`] as on the CPU, or what the device says.
            pub fn $name(&self $(, $arg: f32)?) -> Result<$out, GpuError> {
                on!(own = &self.0;
                    { let $cpu = own; Ok($held) };
                    { let $gpu = own.$name($($arg)?)?; Ok($wrap) })
            }
        )* }
    };
}

reductions! {
    /// The largest number of every row and its column; of several the first.
    row_max() -> Bests
        = |own| Bests(Side::Cpu((own.row_max()?, own.columns())));
        |x| Bests(Side::Gpu(x));
    /// The largest number of every column and its row; of several the first.
    column_max() -> Bests
        = |own| Bests(Side::Cpu((own.column_max()?, own.rows())));
        |x| Bests(Side::Gpu(x));
    /// Every number above the threshold and where it is.
    above(threshold) -> Founds
        = |own| Founds(Side::Cpu(own.above(threshold)?));
        |x| Founds(Side::Gpu(x));
    /// How many numbers are above the threshold.
    count_above(threshold) -> u64
        = |own| own.count_above(threshold)?;
        |x| x;
    /// The sum of all numbers.
    sum() -> f64
        = |own| own.sum();
        |x| x;
    /// The mean of all numbers; zero where there are none.
    mean() -> f64
        = |own| own.mean();
        |x| x;
}
