//! All-pairs batches: every shape of one list with every shape of another.
use crate::error::{Argument, Error};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check_argument, entries, expect, fill, numbers, restore, tame};
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::plan::Face;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::cpu::table::Table;
use crate::kernels::item::{Column, Results, Single};
use crate::kernels::op::Runs;
use crate::kernels::real::Real;
use crate::kernels::recording::Mode;
use crate::kernels::reduce::{Best, Found, check_sides, check_threshold};

/// Lists of shapes, checked.
pub(crate) fn pairs<'a, T: Real, A: Single<Scalar = T>, B: Single<Scalar = T>>(
    cpu: &Cpu,
    face: &'a Face<T>,
    a: &'a [A],
    b: &'a [B],
) -> Result<Pairs<'a, T>, Error> {
    if a.len().max(b.len()) >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    let rare = [
        check_argument(0, &face.arguments, &Column::of(a))?,
        check_argument(1, &face.arguments, &Column::of(b))?,
    ];
    Ok(Pairs {
        face,
        numbers: [numbers(a), numbers(b)],
        rare,
        filter: cpu.cull,
    })
}

/// Upstream derivatives that kernels bear.
pub(crate) struct Bearable<T> {
    /// The smaller derivatives that stand for them, if some are too steep.
    down: Option<Vec<T>>,
    /// The factor of the results.
    by: T,
}

impl<T: Real> Bearable<T> {
    /// Divides all by the same power of two where one is too steep for kernels.
    ///
    /// # Errors
    ///
    /// When one is not finite.
    pub fn new(face: &Face<T>, upstream: &Upstream<'_, T>) -> Result<Self, Error> {
        let steep = tame(upstream.derivatives, face.steepest)?;
        let by = steep.iter().flatten().map(|x| x.1).fold(T::one(), T::most);
        let down = steep.map(|_| upstream.derivatives.iter().map(|&x| x.over(by)).collect());
        Ok(Bearable { down, by })
    }
    /// Derivatives of both lists.
    pub fn pull_back(
        &self,
        pairs: &Pairs<'_, T>,
        upstream: Upstream<'_, T>,
        a_bar: &mut [T],
        b_bar: &mut [T],
    ) {
        let derivatives = self.down.as_deref().unwrap_or(upstream.derivatives);
        let upstream = Upstream {
            derivatives,
            ..upstream
        };
        (T::drivers().pull_back)(pairs, upstream, a_bar, b_bar);
        if self.down.is_some() {
            restore(a_bar, self.by);
            restore(b_bar, self.by);
        }
    }
}

impl Cpu {
    /// Computes every shape of `a` with every shape of `b`: a table with a row per shape of `a`.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, [`Error::TooLarge`] when the table has more
    /// numbers than memory has addresses.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou, Op};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.all_pairs(Iou, &a, &b)?.values(), [0.0, 1.0 / 3.0]);
    ///
    /// let (_, (_, b_bar)) = cpu.all_pairs(Iou.value_grad(), &a, &b)?.at(0, 1);
    /// assert!((b_bar.center.x + 4.0_f64 / 9.0).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn all_pairs<A: Single, B: Single<Scalar = A::Scalar>, R: Runs<(A, B)>>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<Table<R::Out>, Error> {
        let mut table = Table::new(a.len(), b.len())?;
        self.all_pairs_into(run, a, b, &mut table)?;
        Ok(table)
    }

    /// [`all_pairs`](Cpu::all_pairs) into the caller's table.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Cpu::all_pairs), and [`Error::Length`] for a table of another size. The table
    /// is then as it was.
    pub fn all_pairs_into<A: Single, B: Single<Scalar = A::Scalar>, R: Runs<(A, B)>>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        table: &mut Table<R::Out>,
    ) -> Result<(), Error> {
        expect(Argument::Values, a.len(), table.rows())?;
        expect(Argument::Values, b.len(), table.columns())?;
        self.all_pairs_planes(run, a, b, table.planes_mut())
    }

    /// [`all_pairs`](Cpu::all_pairs) into the caller's numbers: plane after plane, of results of one
    /// number a matrix, row by row.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Cpu::all_pairs), and [`Error::Length`] for another number of them. They are
    /// then as they were.
    pub fn all_pairs_planes<A: Single, B: Single<Scalar = A::Scalar>, R: Runs<(A, B)>>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        planes: &mut [A::Scalar],
    ) -> Result<(), Error> {
        let wanted = entries(a.len(), b.len(), R::Out::widths().iter().sum())?;
        expect(Argument::Values, wanted, planes.len())?;
        let face = run.call()?.plan(true)?;
        let pairs = pairs(self, &face, a, b)?;
        (A::Scalar::drivers().planes)(&pairs, planes);
        Ok(())
    }

    /// The adjoint of [`all_pairs`](Cpu::all_pairs) for one number as result: derivatives of
    /// `Σ upstream[i, j] · result[i, j]` with respect to every shape of both lists. `upstream` is a
    /// matrix, row by row.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Cpu::all_pairs), and for an upstream of another size or one that is not finite.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let (a_bar, b_bar) = Cpu::new().all_pairs_vjp(Iou, &a, &b, &[1.0, 3.0])?;
    /// assert!((a_bar[0].center.x - 3.0 * 4.0_f64 / 9.0).abs() < 1e-15);
    /// assert_eq!(b_bar[0].center.x, 0.0);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn all_pairs_vjp<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        upstream: &[A::Scalar],
    ) -> Result<(Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
        self.all_pairs_vjp_into(run, a, b, upstream, &mut a_bar, &mut b_bar)?;
        Ok((a_bar, b_bar))
    }

    /// [`all_pairs_vjp`](Cpu::all_pairs_vjp) into the caller's slices.
    ///
    /// Beside the results it holds one partial gradient of `b` per 16 or more rows of `a`: less than
    /// the upstream matrix has.
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Cpu::all_pairs_vjp), and [`Error::Length`] for a slice of another length.
    /// The slices are then as they were.
    pub fn all_pairs_vjp_into<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        upstream: &[A::Scalar],
        a_bar: &mut [A],
        b_bar: &mut [B],
    ) -> Result<(), Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let wanted = entries(a.len(), b.len(), 1)?;
        expect(Argument::Upstream, wanted, upstream.len())?;
        let upstream = Upstream {
            derivatives: upstream,
            step: b.len(),
        };
        let face = run.call()?.derived(Mode::Vjp)?.plan(true)?;
        self.pull_back(&face, a, b, upstream, a_bar, b_bar)
    }

    fn pull_back<T: Real, A: Single<Scalar = T>, B: Single<Scalar = T>>(
        &self,
        face: &Face<T>,
        a: &[A],
        b: &[B],
        upstream: Upstream<'_, T>,
        a_bar: &mut [A],
        b_bar: &mut [B],
    ) -> Result<(), Error> {
        expect(Argument::GradA, a.len(), a_bar.len())?;
        expect(Argument::GradB, b.len(), b_bar.len())?;
        let pairs = pairs(self, face, a, b)?;
        let bearable = Bearable::new(face, &upstream)?;
        // A gradient has the codes of its shape.
        if A::CODES > 0 {
            a_bar.copy_from_slice(a);
        }
        if B::CODES > 0 {
            b_bar.copy_from_slice(b);
        }
        fill(a_bar, |a_bar| {
            fill(b_bar, |b_bar| {
                bearable.pull_back(&pairs, upstream, a_bar, b_bar);
            });
        });
        Ok(())
    }

    /// The largest result of every row and its column; of several the first.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid, [`Error::Length`] for rows without columns.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou};
    /// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
    /// let b = [Obb2::new(9.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
    /// let best = Cpu::new().row_max(Iou, &a, &b)?;
    /// assert_eq!((best[0].value, best[0].index), (1.0 / 3.0, 1));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn row_max<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<Vec<Best<A::Scalar>>, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        check_sides(a.len(), b.len(), true)?;
        let face = run.call()?.plan(true)?;
        Ok((A::Scalar::drivers().row_max)(&pairs(self, &face, a, b)?))
    }

    /// The largest result of every column and its row; of several the first.
    ///
    /// # Errors
    ///
    /// As [`row_max`](Cpu::row_max), for columns without rows.
    pub fn column_max<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<Vec<Best<A::Scalar>>, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        check_sides(a.len(), b.len(), false)?;
        let face = run.call()?.plan(true)?;
        Ok((A::Scalar::drivers().column_max)(&pairs(
            self, &face, a, b,
        )?))
    }

    /// Every pair whose result is above the threshold, row by row and within a row by column.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid or a threshold that is not finite.
    pub fn above<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        threshold: A::Scalar,
    ) -> Result<Vec<Found<A::Scalar>>, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        check_threshold(threshold)?;
        let face = run.call()?.plan(true)?;
        let mut pairs = pairs(self, &face, a, b)?;
        // Zeros are above a negative threshold, too.
        pairs.filter &= threshold >= A::Scalar::default();
        Ok((A::Scalar::drivers().above)(&pairs, threshold))
    }

    /// The number of pairs whose result is above the threshold.
    ///
    /// # Errors
    ///
    /// As [`above`](Cpu::above).
    pub fn count_above<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        threshold: A::Scalar,
    ) -> Result<u64, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        check_threshold(threshold)?;
        let face = run.call()?.plan(true)?;
        let mut pairs = pairs(self, &face, a, b)?;
        pairs.filter &= threshold >= A::Scalar::default();
        Ok((A::Scalar::drivers().count_above)(&pairs, threshold))
    }

    /// The sum of all results, added in `f64`, always in the same order.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid.
    pub fn sum<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<f64, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let face = run.call()?.plan(true)?;
        Ok((A::Scalar::drivers().sum)(&pairs(self, &face, a, b)?))
    }

    /// The mean of all results; 0 without pairs, as the loss of a step without matches.
    ///
    /// # Errors
    ///
    /// As [`sum`](Cpu::sum).
    pub fn mean<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<f64, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let count = a.len() as f64 * b.len() as f64;
        Ok(self.sum(run, a, b)? / count.max(1.0))
    }

    /// The sum of all results and its gradient with respect to every shape of both lists: a loss and its
    /// gradient without a matrix of results or cotangents.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a shape that is not valid.
    ///
    /// ```
    /// use geograd::Aabb2;
    /// use geograd::kernels::{Cpu, IntersectionArea};
    /// let a = [Aabb2::new(0.0, 0.0, 2.0, 2.0)];
    /// let b = [Aabb2::new(1.0, 0.0, 3.0, 2.0), Aabb2::new(-1.0, 1.0, 3.0, 3.0)];
    /// let (sum, a_bar, _) = Cpu::new().sum_grad(IntersectionArea, &a, &b)?;
    /// assert_eq!(sum, 4.0);
    /// assert_eq!(a_bar[0].max.x, 3.0); // 2 along the one, 1 along the other
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn sum_grad<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<(f64, Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
        let one = <A::Scalar as crate::Scalar>::one();
        let sum = self.sum_grad_into(run, a, b, one, &mut a_bar, &mut b_bar)?;
        Ok((sum, a_bar, b_bar))
    }

    /// The mean of all results and its gradient, as [`sum_grad`](Cpu::sum_grad); zeros without pairs.
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Cpu::sum_grad).
    pub fn mean_grad<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
    ) -> Result<(f64, Vec<A>, Vec<B>), Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let (mut a_bar, mut b_bar) = (a.to_vec(), b.to_vec());
        let factor = 1.0 / (a.len() as f64 * b.len() as f64).max(1.0);
        let each = <A::Scalar as crate::Scalar>::lit(factor);
        let sum = self.sum_grad_into(run, a, b, each, &mut a_bar, &mut b_bar)?;
        Ok((sum * factor, a_bar, b_bar))
    }

    /// The sum of all results; into the caller's slices the derivatives of the sum times `factor`.
    ///
    /// # Errors
    ///
    /// As [`sum_grad`](Cpu::sum_grad), and for a slice of another length or a factor that is not
    /// finite. The slices are then as they were.
    pub fn sum_grad_into<A: Single, B: Single<Scalar = A::Scalar>, R>(
        &self,
        run: R,
        a: &[A],
        b: &[B],
        factor: A::Scalar,
        a_bar: &mut [A],
        b_bar: &mut [B],
    ) -> Result<f64, Error>
    where
        R: Runs<(A, B), Out = A::Scalar>,
    {
        let face = run.call()?.derived(Mode::Vjp)?.plan(true)?;
        let upstream = Upstream {
            derivatives: &vec![factor; b.len().max(1)],
            step: 0,
        };
        self.pull_back(&face, a, b, upstream, a_bar, b_bar)?;
        let face = run.call()?.plan(true)?;
        Ok((A::Scalar::drivers().sum)(&pairs(self, &face, a, b)?))
    }
}
