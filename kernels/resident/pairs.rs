//! The calls of two lists of shapes.
use super::{Bars, Bests, Founds, Matrix, PairBars, Shapes, Side, Values, checked};
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::expect;
use crate::kernels::gpu::{GpuPair, GpuShape};
use crate::kernels::on_cpu;
use crate::kernels::reduce;

/// Shapes of an operation, and slopes with respect to them.
type ShapesOf<O> = Shapes<<O as GpuPair>::Shape>;
type BarsOf<O> = Bars<<O as GpuPair>::Shape>;
/// Slopes with respect to both lists.
pub type Slopes<O> = (BarsOf<O>, BarsOf<O>);

/// The calls of two lists that give something new: the macro lists them.
macro_rules! calls {
    ($($(#[$doc:meta])* $name:ident($($arg:ident: $type:ty),*) -> $out:ty
        = |$op:ident, $a:ident, $b:ident| $cpu:expr; |$gpu:ident| $wrap:expr;)*) => { $(
        $(#[$doc])*
        ///
        /// # Errors
        ///
        /// The input's as on the CPU, [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for handles of different
        /// backends, or what the device says.
        pub fn $name<O: GpuPair<Shape = P>>(
            &self,
            $op: O,
            b: &Shapes<P>,
            $($arg: $type),*
        ) -> Result<$out, Error> {
            on!($a = &self.0, $b = &b.0;
                Ok($cpu);
                {
                    let $gpu = $a.gpu().$name($op, $a, $b, $($arg),*)?;
                    Ok($wrap)
                })
        }
    )* };
}

impl<P: GpuShape> Shapes<P> {
    calls! {
        /// [`Cpu::aligned`](crate::kernels::Cpu::aligned).
        aligned() -> Values
            = |op, a, b| Values(Side::Cpu(on_cpu::aligned(op, a, b)?));
            |x| Values(Side::Gpu(x));
        /// [`Cpu::aligned`](crate::kernels::Cpu::aligned) of [`value_grad`](crate::kernels::Op::value_grad).
        aligned_grad() -> (Values, BarsOf<O>, BarsOf<O>)
            = |op, a, b| {
                let (values, a_bar, b_bar) = on_cpu::aligned_grad(op, a, b)?;
                (Values(Side::Cpu(values)), Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (Values(Side::Gpu(x.0)), Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs).
        all_pairs() -> Matrix
            = |op, a, b| {
                let values = on_cpu::all_pairs(op, a, b)?;
                Matrix(Side::Cpu(reduce::Matrix::new(a.len(), b.len(), values)?))
            };
            |x| Matrix(Side::Gpu(x));
        /// [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs) of [`value_grad`](crate::kernels::Op::value_grad).
        all_pairs_grad() -> PairBars<O>
            = |op, a, b| PairBars(Side::Cpu(on_cpu::all_pairs_grad(op, a, b)?));
            |x| PairBars(Side::Gpu(x));
        /// [`Cpu::sum_grad`](crate::kernels::Cpu::sum_grad).
        sum_grad() -> (f64, BarsOf<O>, BarsOf<O>)
            = |op, a, b| {
                let (sum, a_bar, b_bar) = on_cpu::sum_grad(op, a, b)?;
                (sum, Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (x.0, Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`Cpu::mean_grad`](crate::kernels::Cpu::mean_grad).
        mean_grad() -> (f64, BarsOf<O>, BarsOf<O>)
            = |op, a, b| {
                let (mean, a_bar, b_bar) = on_cpu::mean_grad(op, a, b)?;
                (mean, Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar)))
            };
            |x| (x.0, Bars(Side::Gpu(x.1)), Bars(Side::Gpu(x.2)));
        /// [`Cpu::row_max`](crate::kernels::Cpu::row_max).
        row_max() -> Bests
            = |op, a, b| Bests(Side::Cpu((on_cpu::row_max(op, a, b)?, b.len())));
            |x| Bests(Side::Gpu(x));
        /// [`Cpu::column_max`](crate::kernels::Cpu::column_max).
        column_max() -> Bests
            = |op, a, b| Bests(Side::Cpu((on_cpu::column_max(op, a, b)?, a.len())));
            |x| Bests(Side::Gpu(x));
        /// [`Cpu::above`](crate::kernels::Cpu::above).
        above(threshold: f32) -> Founds
            = |op, a, b| Founds(Side::Cpu(on_cpu::above(op, a, b, threshold)?));
            |x| Founds(Side::Gpu(x));
        /// [`Cpu::count_above`](crate::kernels::Cpu::count_above).
        count_above(threshold: f32) -> u64
            = |op, a, b| on_cpu::count_above(op, a, b, threshold)?;
            |x| x;
        /// [`Cpu::sum`](crate::kernels::Cpu::sum).
        sum() -> f64
            = |op, a, b| on_cpu::sum(op, a, b)?;
            |x| x;
        /// [`Cpu::mean`](crate::kernels::Cpu::mean).
        mean() -> f64
            = |op, a, b| on_cpu::mean(op, a, b)?;
            |x| x;
    }

    /// [`Cpu::aligned`](crate::kernels::Cpu::aligned) of [`vjp`](crate::kernels::Op::vjp).
    ///
    /// # Errors
    ///
    /// As [`aligned`](Shapes::aligned), and for an upstream of another length.
    pub fn aligned_vjp<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        upstream: &Values,
    ) -> Result<Slopes<O>, Error> {
        on!(a = &self.0, b = &b.0, upstream = &upstream.0;
        {
            let (a_bar, b_bar) = on_cpu::aligned_vjp(op, a, b, upstream)?;
            Ok((Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar))))
        };
        {
            let (a_bar, b_bar) = a.gpu().aligned_vjp(op, a, b, upstream)?;
            Ok((Bars(Side::Gpu(a_bar)), Bars(Side::Gpu(b_bar))))
        })
    }

    /// [`Cpu::all_pairs_vjp`](crate::kernels::Cpu::all_pairs_vjp).
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Shapes::all_pairs), and for an upstream of another size.
    pub fn all_pairs_vjp<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        upstream: &Matrix,
    ) -> Result<Slopes<O>, Error> {
        on!(a = &self.0, b = &b.0, upstream = &upstream.0;
        {
            fits(a, b, upstream, Argument::Upstream)?;
            let (a_bar, b_bar) = on_cpu::all_pairs_vjp(op, a, b, &upstream.values)?;
            Ok((Bars(Side::Cpu(a_bar)), Bars(Side::Cpu(b_bar))))
        };
        {
            let (a_bar, b_bar) = a.gpu().all_pairs_vjp(op, a, b, upstream)?;
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
        op: O,
        b: &ShapesOf<O>,
        values: &mut Values,
    ) -> Result<(), Error> {
        on!(a = &self.0, b = &b.0, values = &mut values.0;
            Ok(on_cpu::aligned_into(op, a, b, values)?);
            a.gpu().aligned_into(op, a, b, values))
    }

    /// [`aligned_grad`](Shapes::aligned_grad) over results and slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Shapes::aligned), and for results or slopes of another length.
    pub fn aligned_grad_into<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        values: &mut Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        on!(a = &self.0, b = &b.0, v = &mut values.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(on_cpu::aligned_grad_into(op, a, b, v, x, y)?);
            a.gpu().aligned_grad_into(op, a, b, v, x, y))
    }

    /// [`aligned_vjp`](Shapes::aligned_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned_vjp`](Shapes::aligned_vjp), and for slopes of another length.
    pub fn aligned_vjp_into<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        upstream: &Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        on!(a = &self.0, b = &b.0, u = &upstream.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(on_cpu::aligned_vjp_into(op, a, b, u, x, y)?);
            a.gpu().aligned_vjp_into(op, a, b, u, x, y))
    }

    /// [`all_pairs`](Shapes::all_pairs) over a matrix that is there already.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Shapes::all_pairs), and for a matrix of another size.
    pub fn all_pairs_into<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        matrix: &mut Matrix,
    ) -> Result<(), Error> {
        on!(a = &self.0, b = &b.0, matrix = &mut matrix.0;
        {
            fits(a, b, matrix, Argument::Values)?;
            Ok(on_cpu::all_pairs_into(op, a, b, &mut matrix.values)?)
        };
        a.gpu().all_pairs_into(op, a, b, matrix))
    }

    /// [`all_pairs_vjp`](Shapes::all_pairs_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Shapes::all_pairs_vjp), and for slopes of another length.
    pub fn all_pairs_vjp_into<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        upstream: &Matrix,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        on!(a = &self.0, b = &b.0, u = &upstream.0, x = &mut a_bar.0, y = &mut b_bar.0;
        {
            fits(a, b, u, Argument::Upstream)?;
            Ok(on_cpu::all_pairs_vjp_into(op, a, b, &u.values, x, y)?)
        };
        a.gpu().all_pairs_vjp_into(op, a, b, u, x, y))
    }

    /// The sum of all results; over slopes that are there already those of the sum times `factor`:
    /// [`Cpu::sum_grad_into`](crate::kernels::Cpu::sum_grad_into).
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Shapes::sum_grad), and for slopes of another length or a factor that is not
    /// finite.
    pub fn sum_grad_into<O: GpuPair<Shape = P>>(
        &self,
        op: O,
        b: &ShapesOf<O>,
        factor: f32,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<f64, Error> {
        on!(a = &self.0, b = &b.0, x = &mut a_bar.0, y = &mut b_bar.0;
            Ok(on_cpu::sum_grad_into(op, a, b, factor, x, y)?);
            a.gpu().sum_grad_into(op, a, b, factor, x, y))
    }

    /// Puts as many other shapes in their place: what a loop does that moves them. On a GPU no
    /// buffer is made.
    ///
    /// # Errors
    ///
    /// The input's for another number of shapes or one that is not valid (the old ones are
    /// then as they were), or what the device says.
    pub fn update(&mut self, shapes: &[P]) -> Result<(), Error> {
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
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), The input's for results about a list of another length,
    /// or what the device says.
    pub fn pick(&self, bests: &Bests) -> Result<Shapes<P>, Error> {
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
