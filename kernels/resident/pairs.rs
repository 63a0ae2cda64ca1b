//! All pairs of two handles.
#[cfg(feature = "gpu")]
use super::calls::{of_gpu, on_gpu::column};
use super::held::{Held, foreign, held_of, shapes_of};
use super::{Bests, Founds, Matrix, Resident, Side};
use crate::error::{Argument, Error};
use crate::kernels::backend::Backend;
use crate::kernels::cpu::checked::expect;
#[cfg(feature = "gpu")]
use crate::kernels::gpu::{
    Gpu, HeldColumn,
    lists::{Lists, loss},
    seed::Seed,
};
use crate::kernels::item::Single;
use crate::kernels::op::Runs;
#[cfg(feature = "gpu")]
use crate::kernels::recording::{Call, Mode};
use crate::kernels::reduce::Loss;
use crate::kernels::{Cpu, reduce};

impl Resident<'_> {
    /// Computes every shape of `a` with every shape of `b`, as [`Cpu::all_pairs`], for results of one number: a handle
    /// of the matrix.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Resident::aligned).
    pub fn all_pairs<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
    ) -> Result<Matrix, Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        match self.0 {
            Backend::Cpu => {
                let table = Cpu::new().all_pairs(run, &shapes_of(a)?, &shapes_of(b)?)?;
                let values = table.into_planes();
                Ok(Matrix(Side::Cpu(reduce::Matrix::new(
                    a.count, b.count, values,
                )?)))
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let lists = Lists::of_held(gpu, &run, column(a)?, column(b)?)?;
                Ok(Matrix(Side::Gpu(lists.matrix()?)))
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// [`all_pairs`](Resident::all_pairs) into an existing matrix, in the same buffers.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Resident::all_pairs), and [`Error::Length`] for a matrix of another size.
    pub fn all_pairs_into<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
        matrix: &mut Matrix,
    ) -> Result<(), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        match (self.0, &mut matrix.0) {
            (Backend::Cpu, Side::Cpu(own)) => {
                fits(a, b, own, Argument::Values)?;
                let (a, b) = (shapes_of(a)?, shapes_of(b)?);
                Cpu::new().all_pairs_planes(run, &a, &b, &mut own.values)
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(own)) => {
                Lists::of_held(gpu, &run, column(a)?, column(b)?)?.matrix_into(own)
            }
            _ => Err(foreign()),
        }
    }

    /// The adjoint of [`all_pairs`](Resident::all_pairs), as [`Cpu::all_pairs_vjp`]: cotangents summed for
    /// every shape of both lists.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Resident::all_pairs), and [`Error::Length`] for an upstream of another size.
    pub fn all_pairs_vjp<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
        upstream: &Matrix,
    ) -> Result<(Held<A>, Held<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        match (self.0, &upstream.0) {
            (Backend::Cpu, Side::Cpu(own)) => {
                fits(a, b, own, Argument::Upstream)?;
                let (a, b) = (shapes_of(a)?, shapes_of(b)?);
                let (by_a, by_b) = Cpu::new().all_pairs_vjp(run, &a, &b, &own.values)?;
                Ok((held_of(&by_a), held_of(&by_b)))
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(own)) => {
                let (x, y) = (column(a)?, column(b)?);
                let lists = Lists::of_held_numbers(gpu, &run.call()?.derived(Mode::Vjp)?, x, y)?;
                both(gpu, [x, y], lists.derivatives(&Seed::Matrix(own))?)
            }
            _ => Err(foreign()),
        }
    }

    /// The sum of all results, and its gradient by every shape of both lists, as [`Cpu::sum_grad`].
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Resident::all_pairs).
    pub fn sum_grad<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
    ) -> Result<(f64, Held<A>, Held<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        self.loss(run, a, b, Loss::Sum)
    }

    /// The mean of all results, 0 without pairs, and its gradient, as [`Cpu::mean_grad`].
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Resident::all_pairs).
    pub fn mean_grad<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
    ) -> Result<(f64, Held<A>, Held<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        self.loss(run, a, b, Loss::Mean)
    }

    fn loss<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
        self,
        run: R,
        a: &Held<A>,
        b: &Held<B>,
        of: Loss,
    ) -> Result<(f64, Held<A>, Held<B>), Error>
    where
        R: Runs<(A, B), Out = f32>,
    {
        match self.0 {
            Backend::Cpu => {
                let (a, b) = (shapes_of(a)?, shapes_of(b)?);
                let (value, by_a, by_b) = match of {
                    Loss::Sum => Cpu::new().sum_grad(run, &a, &b)?,
                    Loss::Mean => Cpu::new().mean_grad(run, &a, &b)?,
                };
                Ok((value, held_of(&by_a), held_of(&by_b)))
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let (x, y) = (column(a)?, column(b)?);
                let lists = |call: &Call<f32>| Lists::of_held_numbers(gpu, call, x, y);
                let (value, derivatives) = loss(run.call()?, lists, of)?;
                let (by_a, by_b) = both(gpu, [x, y], derivatives)?;
                Ok((value, by_a, by_b))
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// The shape of a list that each row (or column) found best: `pick(&b, &row_max)` has as many shapes as
    /// `a`, ready to be aligned with it.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for results about a list of another length,
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for handles of other backends, or what the
    /// device says.
    pub fn pick<P: Single<Scalar = f32>>(
        self,
        list: &Held<P>,
        bests: &Bests,
    ) -> Result<Held<P>, Error> {
        match (self.0, &bests.0) {
            (Backend::Cpu, Side::Cpu((found, among))) => {
                expect(Argument::Shape, *among, list.count)?;
                let shapes = shapes_of(list)?;
                let picked: Vec<P> = found.iter().map(|best| shapes[best.index]).collect();
                Ok(held_of(&picked))
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(found)) => {
                let own = column(list)?;
                own.is_of(gpu)?;
                found.is_of(gpu)?;
                expect(Argument::Shape, found.among, list.count)?;
                Ok(of_gpu(vec![own.picked(&found.download()?)?]))
            }
            _ => Err(foreign()),
        }
    }
}

/// Derivatives of both lists, which stay.
#[cfg(feature = "gpu")]
fn both<A, B>(
    gpu: &Gpu,
    [a, b]: [&HeldColumn; 2],
    [by_a, by_b]: [Vec<f32>; 2],
) -> Result<(Held<A>, Held<B>), Error> {
    Ok((
        of_gpu(vec![HeldColumn::new(gpu, a.fields(), by_a)?]),
        of_gpu(vec![HeldColumn::new(gpu, b.fields(), by_b)?]),
    ))
}

/// Refuses a matrix of another size than two lists have.
fn fits<A, B>(
    a: &Held<A>,
    b: &Held<B>,
    matrix: &reduce::Matrix,
    argument: Argument,
) -> Result<(), Error> {
    expect(argument, a.count, matrix.rows())?;
    expect(argument, b.count, matrix.columns())
}

/// Reductions of all pairs, without the matrix.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident($($arg:ident)?) -> $out:ty
        = |$found:ident, $a:ident, $b:ident| $cpu:expr, $gpu:expr;)*) => {
        impl Resident<'_> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// As [`all_pairs`](Resident::all_pairs).
            pub fn $name<A: Single<Scalar = f32>, B: Single<Scalar = f32>, R>(
                self,
                run: R,
                $a: &Held<A>,
                $b: &Held<B>,
                $($arg: f32,)?
            ) -> Result<$out, Error>
            where
                R: Runs<(A, B), Out = f32>,
            {
                match self.0 {
                    Backend::Cpu => {
                        let (x, y) = (shapes_of($a)?, shapes_of($b)?);
                        let $found = Cpu::new().$name(run, &x, &y $(, $arg)?)?;
                        Ok($cpu)
                    }
                    #[cfg(feature = "gpu")]
                    Backend::Gpu(gpu) => {
                        let (x, y) = (column($a)?, column($b)?);
                        let $found = Lists::of_held(gpu, &run, x, y)?.$name($($arg)?)?;
                        Ok($gpu)
                    }
                    #[cfg(not(feature = "gpu"))]
                    Backend::Gpu(gpu) => match *gpu {},
                }
            }
        )* }
    };
}

reductions! {
    /// The largest result of every row and its column, of several the first, as [`Cpu::row_max`].
    row_max() -> Bests = |found, a, b| Bests(Side::Cpu((found, b.count))), Bests(Side::Gpu(found));
    /// The largest result of every column and its row, of several the first, as [`Cpu::column_max`].
    column_max() -> Bests = |found, a, b| Bests(Side::Cpu((found, a.count))), Bests(Side::Gpu(found));
    /// Every pair whose result is above the threshold, row by row, as [`Cpu::above`].
    above(threshold) -> Founds = |found, a, b| Founds(Side::Cpu(found)), Founds(Side::Gpu(found));
    /// The number of pairs whose result is above the threshold, as [`Cpu::count_above`].
    count_above(threshold) -> u64 = |found, a, b| found, found;
    /// The sum of all results, as [`Cpu::sum`].
    sum() -> f64 = |found, a, b| found, found;
    /// The mean of all results, 0 without pairs, as [`Cpu::mean`].
    mean() -> f64 = |found, a, b| found, found;
}
