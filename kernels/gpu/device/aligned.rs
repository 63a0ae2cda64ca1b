//! Aligned batches on the GPU: row i with row i.
use super::data::Piece;
use super::pairs::{BarsOf, ShapesOf, source_for};
use super::source::{GpuPair, Kernel};
use super::work::{Params, Work, groups};
use super::{Bars, Gpu, Values};
use crate::Error;
use crate::error::Argument;
use crate::kernels::cpu::checked::expect;

/// Results and slopes with respect to both lists.
pub type AlignedBars<O> = (Values, BarsOf<O>, BarsOf<O>);

impl Gpu {
    /// Row i of `a` with row i of `b`: one result per row.
    ///
    /// # Errors
    ///
    /// The input's when the lists differ in length, [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer), or what
    /// the device says.
    pub fn aligned<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Values, Error> {
        self.aligned_lists(a, b)?;
        let mut values = self.inner.guarded(|| Ok(Values::room(self, a.len)))?;
        self.aligned_into(op, a, b, &mut values)?;
        Ok(values)
    }

    /// [`aligned`](Gpu::aligned) over results that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned), and for results of another length.
    pub fn aligned_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        values: &mut Values,
    ) -> Result<(), Error> {
        self.aligned_lists(a, b)?;
        self.fits(&values.gpu, Argument::Values, a.len, values.len)?;
        self.run_aligned::<O>("aligned_main", a, b, &[(4, &values.pieces)])
    }

    /// [`aligned`](Gpu::aligned) with the slopes of every result with respect to both shapes.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned).
    pub fn aligned_grad<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<AlignedBars<O>, Error> {
        self.aligned_lists(a, b)?;
        let (mut values, mut a_bar, mut b_bar) = self.inner.guarded(|| {
            let bars = || Bars::room(self, a.len);
            Ok((Values::room(self, a.len), bars(), bars()))
        })?;
        self.aligned_grad_into(op, a, b, &mut values, &mut a_bar, &mut b_bar)?;
        Ok((values, a_bar, b_bar))
    }

    /// [`aligned_grad`](Gpu::aligned_grad) over results and slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned), and for results or slopes of another length.
    pub fn aligned_grad_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        values: &mut Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        self.aligned_lists(a, b)?;
        self.fits(&values.gpu, Argument::Values, a.len, values.len)?;
        self.fit_bars::<O>(a, b, a_bar, b_bar)?;
        let bound = [
            (4, &values.pieces[..]),
            (5, &a_bar.pieces),
            (6, &b_bar.pieces),
        ];
        self.run_aligned::<O>("aligned_grad_main", a, b, &bound)
    }

    /// The adjoint of [`aligned`](Gpu::aligned): `upstream[i]` times the slopes of result i.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Gpu::aligned), and for an upstream of another length.
    pub fn aligned_vjp<O: GpuPair>(
        &self,
        op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Values,
    ) -> Result<(BarsOf<O>, BarsOf<O>), Error> {
        self.aligned_lists(a, b)?;
        let bars = || Ok((Bars::room(self, a.len), Bars::room(self, b.len)));
        let (mut a_bar, mut b_bar) = self.inner.guarded(bars)?;
        self.aligned_vjp_into(op, a, b, upstream, &mut a_bar, &mut b_bar)?;
        Ok((a_bar, b_bar))
    }

    /// [`aligned_vjp`](Gpu::aligned_vjp) over slopes that are there already.
    ///
    /// # Errors
    ///
    /// As [`aligned_vjp`](Gpu::aligned_vjp), and for slopes of another length.
    pub fn aligned_vjp_into<O: GpuPair>(
        &self,
        _op: O,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        upstream: &Values,
        a_bar: &mut BarsOf<O>,
        b_bar: &mut BarsOf<O>,
    ) -> Result<(), Error> {
        self.aligned_lists(a, b)?;
        self.fits(&upstream.gpu, Argument::Upstream, a.len, upstream.len)?;
        self.fit_bars::<O>(a, b, a_bar, b_bar)?;
        let bound = [
            (3, &upstream.pieces[..]),
            (5, &a_bar.pieces),
            (6, &b_bar.pieces),
        ];
        self.run_aligned::<O>("aligned_vjp_main", a, b, &bound)
    }

    /// Refuses lists of other contexts or different lengths.
    fn aligned_lists<P>(&self, a: &super::Shapes<P>, b: &super::Shapes<P>) -> Result<(), Error> {
        self.owns(&a.gpu)?;
        self.fits(&b.gpu, Argument::B, a.len, b.len)
    }

    /// Refuses a handle of another context or another length than expected.
    pub(super) fn fits(
        &self,
        of: &Gpu,
        argument: Argument,
        expected: usize,
        found: usize,
    ) -> Result<(), Error> {
        self.owns(of)?;
        expect(argument, expected, found)
    }

    /// Refuses slopes that do not belong to these lists.
    pub(super) fn fit_bars<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        a_bar: &BarsOf<O>,
        b_bar: &BarsOf<O>,
    ) -> Result<(), Error> {
        self.fits(&a_bar.gpu, Argument::GradA, a.len, a_bar.len)?;
        self.fits(&b_bar.gpu, Argument::GradB, b.len, b_bar.len)
    }

    /// Runs a kernel over every piece of both lists; `bound` says what else is bound where.
    fn run_aligned<O: GpuPair>(
        &self,
        entry: &'static str,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        bound: &[(u32, &[Piece])],
    ) -> Result<(), Error> {
        let inner = &self.inner;
        inner.guarded(|| {
            let source = source_for::<O>(Kernel::Aligned, a, b);
            let pipeline = inner.pair_pipeline::<O>(source, entry);
            let mut work = Work::new(inner);
            for (i, (a, b)) in a.pieces.iter().zip(&b.pieces).enumerate() {
                let mut buffers = vec![(1, &a.buffer), (2, &b.buffer)];
                buffers.extend(bound.iter().map(|&(at, pieces)| (at, &pieces[i].buffer)));
                let params = Params {
                    own_count: a.items as u32,
                    ..Params::default()
                };
                work.dispatch(&pipeline, params, &buffers, [groups(a.items), 1]);
            }
            work.submit().map(drop)
        })
    }
}
