//! The same calls on columns of plain numbers, of functions without the types of their shapes.
#[cfg(feature = "gpu")]
use super::calls::{of_gpu, on_gpu};
#[cfg(feature = "gpu")]
use super::held::Given;
use super::held::{Held, Numbers, foreign};
use super::{Matrix, Resident, Side};
use crate::error::{Argument, Error};
use crate::kernels::backend::Backend;
use crate::kernels::cpu::checked::expect;
use crate::kernels::dynamic::{Function, Rows};
#[cfg(feature = "gpu")]
use crate::kernels::gpu::{HeldColumn, lists::Lists, seed::Seed};
#[cfg(feature = "gpu")]
use crate::kernels::recording::Mode;
use crate::kernels::reduce;

/// Columns of plain numbers that stay on the machine.
pub type HeldNumbers = Held<()>;

/// Columns on the processor as rows of numbers.
fn rows(held: &HeldNumbers) -> Result<Vec<Rows<'_, f32>>, Error> {
    match &held.columns {
        Side::Cpu(own) => Ok(own
            .iter()
            .map(|own| Rows::new(&own.rows, own.fields))
            .collect()),
        Side::Gpu(_) => Err(foreign()),
    }
}
/// The only column of a list.
fn list(held: &HeldNumbers) -> Result<Rows<'_, f32>, Error> {
    rows(held)?.first().copied().ok_or_else(foreign)
}

impl Resident<'_> {
    /// Uploads columns of arguments of a function, all of one length; the call that takes them checks them.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    #[doc(hidden)]
    pub fn upload_rows(self, columns: &[Rows<'_, f32>]) -> Result<HeldNumbers, Error> {
        let count = columns.first().and_then(Rows::count).unwrap_or(0);
        let numbers = columns.iter().map(|rows| Numbers {
            fields: rows.fields(),
            rows: rows.numbers().to_vec(),
        });
        self.kept(count, numbers.collect())
    }

    /// Item i of every column, as [`aligned`](Resident::aligned).
    ///
    /// # Errors
    ///
    /// As there.
    #[doc(hidden)]
    pub fn aligned_rows(
        self,
        run: &Function<f32>,
        columns: &HeldNumbers,
        into: Option<HeldNumbers>,
    ) -> Result<HeldNumbers, Error> {
        match self.0 {
            Backend::Cpu => {
                drop(into);
                let lists = run.aligned(&rows(columns)?)?;
                let numbers = lists.into_iter().zip(run.gives());
                let numbers = numbers.map(|(rows, fields)| Numbers { fields, rows });
                self.kept(columns.count, numbers.collect())
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let Side::Gpu(own) = &columns.columns else {
                    return Err(foreign());
                };
                let made = run.call()?.generated(false)?;
                let given: Vec<Given<'_>> = own.iter().map(Given::Gpu).collect();
                let over = match into.as_ref().map(|into| &into.columns) {
                    Some(Side::Gpu(over)) => &over[..],
                    _ => &[],
                };
                Ok(of_gpu(gpu.held_aligned(
                    &made,
                    &on_gpu::given(&given)?,
                    over,
                )?))
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// Every row of one column with every row of another, for results of one number, as
    /// [`all_pairs`](Resident::all_pairs), into an existing matrix if there is one.
    ///
    /// # Errors
    ///
    /// As there, and [`Error::Length`] for a matrix of another size.
    #[doc(hidden)]
    pub fn all_pairs_rows(
        self,
        run: &Function<f32>,
        a: &HeldNumbers,
        b: &HeldNumbers,
        into: Option<Matrix>,
    ) -> Result<Matrix, Error> {
        match self.0 {
            Backend::Cpu => {
                // A new matrix costs less than a check of the old one's size.
                drop(into);
                let values = run.all_pairs(list(a)?, list(b)?)?;
                Ok(Matrix(Side::Cpu(reduce::Matrix::new(
                    a.count, b.count, values,
                )?)))
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let (x, y) = (on_gpu::column(a)?, on_gpu::column(b)?);
                let lists = Lists::of_held_numbers(gpu, &run.call()?, x, y)?;
                match into {
                    Some(Matrix(Side::Gpu(mut own))) => {
                        lists.matrix_into(&mut own)?;
                        Ok(Matrix(Side::Gpu(own)))
                    }
                    Some(Matrix(Side::Cpu(_))) => Err(foreign()),
                    None => Ok(Matrix(Side::Gpu(lists.matrix()?))),
                }
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// The adjoint of all pairs, as [`all_pairs_vjp`](Resident::all_pairs_vjp).
    ///
    /// # Errors
    ///
    /// As there.
    #[doc(hidden)]
    pub fn all_pairs_vjp_rows(
        self,
        run: &Function<f32>,
        a: &HeldNumbers,
        b: &HeldNumbers,
        upstream: &Matrix,
    ) -> Result<[HeldNumbers; 2], Error> {
        match (self.0, &upstream.0) {
            (Backend::Cpu, Side::Cpu(own)) => {
                expect(Argument::Upstream, a.count, own.rows())?;
                expect(Argument::Upstream, b.count, own.columns())?;
                let (x, y) = (list(a)?, list(b)?);
                let (by_a, by_b) = run.all_pairs_vjp(x, y, &own.values)?;
                let kept = |count, fields, rows| self.kept(count, vec![Numbers { fields, rows }]);
                Ok([
                    kept(a.count, x.fields(), by_a)?,
                    kept(b.count, y.fields(), by_b)?,
                ])
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(own)) => {
                let (x, y) = (on_gpu::column(a)?, on_gpu::column(b)?);
                let lists = Lists::of_held_numbers(gpu, &run.call()?.derived(Mode::Vjp)?, x, y)?;
                let [by_a, by_b] = lists.derivatives(&Seed::Matrix(own))?;
                Ok([
                    of_gpu(vec![HeldColumn::new(gpu, x.fields(), by_a)?]),
                    of_gpu(vec![HeldColumn::new(gpu, y.fields(), by_b)?]),
                ])
            }
            _ => Err(foreign()),
        }
    }
}
