//! Functions of `f32` on the processor or on a GPU.
use super::forms::Function;
use super::rows::Rows;
use crate::error::Error;
use crate::kernels::backend::Backend;
use crate::kernels::reduce::{Best, Found};
#[cfg(feature = "gpu")]
use crate::kernels::{gpu::Lists, reduce::Loss};

/// The call on one machine or the other.
macro_rules! on_either {
    ($backend:expr, $cpu:expr, |$gpu:ident| $on_gpu:expr) => {
        match $backend {
            Backend::Cpu => $cpu,
            #[cfg(feature = "gpu")]
            Backend::Gpu($gpu) => $on_gpu,
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu($gpu) => match *$gpu {},
        }
    };
}

/// The same calls on the processor or on a GPU, where numbers are `f32`.
///
/// # Errors
///
/// As the calls without a backend; [`Error::Gpu`] are the GPU's, and all pairs of searches are refused there with
/// [`Unrecordable::Search`](crate::Unrecordable::Search).
impl Function<f32> {
    /// [`aligned`](Function::aligned) on a machine.
    ///
    /// # Errors
    ///
    /// See [there](Function::aligned); [`Error::Gpu`] are the GPU's.
    pub fn aligned_on(
        &self,
        backend: Backend<'_>,
        rows: &[Rows<'_, f32>],
    ) -> Result<Vec<Vec<f32>>, Error> {
        on_either!(backend, self.aligned(rows), |gpu| {
            self.named(gpu.lists(&self.call()?, &self.listed(rows)?))
        })
    }

    /// [`all_pairs`](Function::all_pairs) on a machine.
    ///
    /// # Errors
    ///
    /// See [there](Function::all_pairs); [`Error::Gpu`] are the GPU's.
    pub fn all_pairs_on(
        &self,
        backend: Backend<'_>,
        a: Rows<'_, f32>,
        b: Rows<'_, f32>,
    ) -> Result<Vec<f32>, Error> {
        on_either!(backend, self.all_pairs(a, b), |gpu| {
            let lists = self.lists(&a, &b)?;
            let [rows, columns] = [lists[0].len(), lists[1].len()];
            let wanted =
                crate::kernels::cpu::checked::entries(rows, columns, self.gives().iter().sum())?;
            let mut planes = vec![0.0; wanted];
            self.named(gpu.planes(&self.call()?, &lists, &mut planes))?;
            Ok(planes)
        })
    }
}

/// Reductions on either machine: a documentation, a name, what it is on the processor, what else it takes, its result,
/// and what it is on a GPU.
macro_rules! reductions {
    ($($(#[$doc:meta])* $name:ident = $cpu:ident($($more:ident: $type:ty)?) -> $out:ty = |$found:ident| $after:expr;)*) => {
        impl Function<f32> { $(
            $(#[$doc])*
            ///
            /// # Errors
            ///
            /// See there; [`Error::Gpu`] are the GPU's.
            pub fn $name(
                &self,
                backend: Backend<'_>,
                a: Rows<'_, f32>,
                b: Rows<'_, f32>,
                $($more: $type,)?
            ) -> Result<$out, Error> {
                on_either!(backend, self.$cpu(a, b $(, $more)?), |gpu| {
                    self.one_number()?;
                    let lists = self.lists(&a, &b)?;
                    let run = || {
                        let lists = Lists::of_columns(gpu, &self.call()?, &lists)?;
                        let $found = lists.$cpu($($more)?)?;
                        $after
                    };
                    self.named(run())
                })
            }
        )* }
    };
}

reductions! {
    /// [`row_max`](Function::row_max) on a machine.
    row_max_on = row_max() -> Vec<Best> = |found| found.download();
    /// [`column_max`](Function::column_max) on a machine.
    column_max_on = column_max() -> Vec<Best> = |found| found.download();
    /// [`above`](Function::above) on a machine.
    above_on = above(threshold: f32) -> Vec<Found> = |found| found.download();
    /// [`count_above`](Function::count_above) on a machine.
    count_above_on = count_above(threshold: f32) -> u64 = |found| Ok(found);
    /// [`sum`](Function::sum) on a machine.
    sum_on = sum() -> f64 = |found| Ok(found);
    /// [`mean`](Function::mean) on a machine.
    mean_on = mean() -> f64 = |found| Ok(found);
}

/// A number, and derivatives of both lists.
type Loss32 = (f64, Vec<f32>, Vec<f32>);

impl Function<f32> {
    /// [`sum_grad`](Function::sum_grad) on a machine.
    ///
    /// # Errors
    ///
    /// See [there](Function::sum_grad); [`Error::Gpu`] are the GPU's.
    pub fn sum_grad_on(
        &self,
        backend: Backend<'_>,
        a: Rows<'_, f32>,
        b: Rows<'_, f32>,
    ) -> Result<Loss32, Error> {
        on_either!(backend, self.sum_grad(a, b), |gpu| {
            self.loss(gpu, &a, &b, Loss::Sum)
        })
    }
    /// [`mean_grad`](Function::mean_grad) on a machine.
    ///
    /// # Errors
    ///
    /// See [there](Function::mean_grad); [`Error::Gpu`] are the GPU's.
    pub fn mean_grad_on(
        &self,
        backend: Backend<'_>,
        a: Rows<'_, f32>,
        b: Rows<'_, f32>,
    ) -> Result<Loss32, Error> {
        on_either!(backend, self.mean_grad(a, b), |gpu| {
            self.loss(gpu, &a, &b, Loss::Mean)
        })
    }
    /// [`all_pairs_vjp`](Function::all_pairs_vjp) on a machine.
    ///
    /// # Errors
    ///
    /// See [there](Function::all_pairs_vjp); [`Error::Gpu`] are the GPU's.
    pub fn all_pairs_vjp_on(
        &self,
        backend: Backend<'_>,
        a: Rows<'_, f32>,
        b: Rows<'_, f32>,
        upstream: &[f32],
    ) -> Result<(Vec<f32>, Vec<f32>), Error> {
        on_either!(backend, self.all_pairs_vjp(a, b, upstream), |gpu| {
            self.one_number()?;
            let lists = self.lists(&a, &b)?;
            let [a, b] = self.named(gpu.pulled(&self.call()?, &lists, upstream))?;
            Ok((a, b))
        })
    }
}

#[cfg(feature = "gpu")]
mod on_gpu {
    use super::{Function, Loss32, Rows};
    use crate::error::Error;
    use crate::kernels::dynamic::rows::renamed;
    use crate::kernels::gpu::Gpu;
    use crate::kernels::reduce::Loss;

    impl Function<f32> {
        /// An error with the names of arguments.
        pub(super) fn named<X>(&self, result: Result<X, Error>) -> Result<X, Error> {
            result.map_err(|error| renamed(error, &self.names))
        }
        pub(super) fn loss(
            &self,
            gpu: &Gpu,
            a: &Rows<'_, f32>,
            b: &Rows<'_, f32>,
            loss: Loss,
        ) -> Result<Loss32, Error> {
            self.one_number()?;
            let lists = self.lists(a, b)?;
            let (value, [a, b]) = self.named(gpu.loss_of(&self.call()?, &lists, loss))?;
            Ok((value, a, b))
        }
    }
}
