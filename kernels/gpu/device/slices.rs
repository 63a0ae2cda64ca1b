//! Whole calls from slices to vectors: what [`Backend`](crate::kernels::Backend) runs on a GPU.
use super::pairs::{BarsOf, ShapesOf};
use super::ring::OutOf;
use super::{Gpu, GpuPair, GpuRing};
use crate::Error;
use crate::Vec2;
use crate::error::Argument;
use crate::kernels::cpu::checked::expect;
use crate::kernels::on_cpu::{AlignedGrads, Bars as Both, Loss, PairGrads, ShapeOf};
use crate::kernels::reduce::{Best, Found};

/// Both lists on the GPU.
fn lists<O: GpuPair>(
    gpu: &Gpu,
    a: &[ShapeOf<O>],
    b: &[ShapeOf<O>],
) -> Result<(ShapesOf<O>, ShapesOf<O>), Error> {
    Ok((
        gpu.upload_as(Argument::A, a)?,
        gpu.upload_as(Argument::B, b)?,
    ))
}

/// Both lists of slopes, brought back.
fn both<O: GpuPair>(bars: (BarsOf<O>, BarsOf<O>)) -> Result<Both<O>, Error> {
    let (a, b) = (bars.0.start_download()?, bars.1.start_download()?);
    Ok((a.wait()?, b.wait()?))
}

impl Gpu {
    /// Whether it computes faster than the processor: not so for a driver in software, unless the
    /// environment asks for one.
    pub(crate) fn is_worth_it(&self) -> bool {
        !self.adapter().is_software || std::env::var_os("GEOGRAD_GPU").is_some()
    }

    pub(crate) fn aligned_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Vec<f32>, Error> {
        expect(Argument::B, a.len(), b.len())?;
        let (a, b) = lists::<O>(self, a, b)?;
        self.aligned(O::default(), &a, &b)?.download()
    }

    pub(crate) fn aligned_grad_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<AlignedGrads<O>, Error> {
        expect(Argument::B, a.len(), b.len())?;
        let (a, b) = lists::<O>(self, a, b)?;
        let (values, a_bars, b_bars) = self.aligned_grad(O::default(), &a, &b)?;
        let values = values.start_download()?;
        let (a_bars, b_bars) = both::<O>((a_bars, b_bars))?;
        Ok((values.wait()?, a_bars, b_bars))
    }

    pub(crate) fn aligned_into_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        values: &mut [f32],
    ) -> Result<(), Error> {
        expect(Argument::B, a.len(), b.len())?;
        expect(Argument::Values, a.len(), values.len())?;
        let (a, b) = lists::<O>(self, a, b)?;
        self.aligned(O::default(), &a, &b)?.download_into(values)
    }

    pub(crate) fn aligned_grad_into_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        values: &mut [f32],
        a_bar: &mut [ShapeOf<O>],
        b_bar: &mut [ShapeOf<O>],
    ) -> Result<(), Error> {
        expect(Argument::B, a.len(), b.len())?;
        expect(Argument::Values, a.len(), values.len())?;
        expect(Argument::GradA, a.len(), a_bar.len())?;
        expect(Argument::GradB, b.len(), b_bar.len())?;
        let found = self.aligned_grad_slices::<O>(a, b)?;
        // All of it is here: nothing is left half written.
        values.copy_from_slice(&found.0);
        a_bar.copy_from_slice(&found.1);
        b_bar.copy_from_slice(&found.2);
        Ok(())
    }

    pub(crate) fn aligned_vjp_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        upstream: &[f32],
    ) -> Result<Both<O>, Error> {
        expect(Argument::B, a.len(), b.len())?;
        expect(Argument::Upstream, a.len(), upstream.len())?;
        let (a, b) = lists::<O>(self, a, b)?;
        let upstream = self.upload_values(upstream)?;
        both::<O>(self.aligned_vjp(O::default(), &a, &b, &upstream)?)
    }

    pub(crate) fn all_pairs_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Vec<f32>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.all_pairs(O::default(), &a, &b)?.download()
    }

    pub(crate) fn all_pairs_grad_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<PairGrads<O>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.all_pairs_grad(O::default(), &a, &b)?.download()
    }

    pub(crate) fn all_pairs_vjp_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        upstream: &[f32],
    ) -> Result<Both<O>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        both::<O>(self.all_pairs_vjp_from(O::default(), &a, &b, upstream)?)
    }

    pub(crate) fn sum_grad_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Loss<O>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        let (sum, a_bar, b_bar) = self.sum_grad(O::default(), &a, &b)?;
        let (a_bar, b_bar) = both::<O>((a_bar, b_bar))?;
        Ok((sum, a_bar, b_bar))
    }

    pub(crate) fn mean_grad_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Loss<O>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        let (mean, a_bar, b_bar) = self.mean_grad(O::default(), &a, &b)?;
        let (a_bar, b_bar) = both::<O>((a_bar, b_bar))?;
        Ok((mean, a_bar, b_bar))
    }

    pub(crate) fn row_max_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Vec<Best>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.row_max(O::default(), &a, &b)?.download()
    }

    pub(crate) fn column_max_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<Vec<Best>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.column_max(O::default(), &a, &b)?.download()
    }

    pub(crate) fn above_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        threshold: f32,
    ) -> Result<Vec<Found>, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.above(O::default(), &a, &b, threshold)?.download()
    }

    pub(crate) fn count_above_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
        threshold: f32,
    ) -> Result<u64, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.count_above(O::default(), &a, &b, threshold)
    }

    pub(crate) fn sum_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<f64, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.sum(O::default(), &a, &b)
    }

    pub(crate) fn mean_slices<O: GpuPair>(
        &self,
        a: &[ShapeOf<O>],
        b: &[ShapeOf<O>],
    ) -> Result<f64, Error> {
        let (a, b) = lists::<O>(self, a, b)?;
        self.mean(O::default(), &a, &b)
    }

    pub(crate) fn ragged_slices<O: GpuRing>(
        &self,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
    ) -> Result<Vec<OutOf<O>>, Error> {
        let rings = self.upload_rings(vertices, offsets)?;
        self.ragged(O::default(), &rings)?.download()
    }

    pub(crate) fn ragged_vjp_slices<O: GpuRing>(
        &self,
        vertices: &[Vec2<f32>],
        offsets: &[usize],
        upstream: &[OutOf<O>],
    ) -> Result<Vec<Vec2<f32>>, Error> {
        let rings = self.upload_rings(vertices, offsets)?;
        self.ragged_vjp(O::default(), &rings, upstream)?.download()
    }
}
