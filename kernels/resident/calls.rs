//! Aligned batches on handles.
use super::held::{Given, Held, HeldColumns, Numbers, foreign, numbers_of};
use super::{Resident, Side};
use crate::error::{Argument, Error};
use crate::kernels::Cpu;
use crate::kernels::backend::Backend;
use crate::kernels::cpu::checked::expect;
#[cfg(feature = "gpu")]
use crate::kernels::gpu;
use crate::kernels::item::{Column, Columns, Item, Results, Target};
use crate::kernels::op::Runs;
use std::marker::PhantomData;

/// Columns for the processor.
struct OnCpu<'a, R> {
    given: &'a [Given<'a>],
    row: PhantomData<fn() -> R>,
}

impl<R: Item<Scalar = f32>> Columns for OnCpu<'_, R> {
    type Item = R;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, f32>)) {
        for given in self.given {
            add(match given {
                Given::Cpu(own, count) => Column::lent(&own.rows, own.fields, Some(*count)),
                Given::One(numbers) => Column::lent(numbers, numbers.len(), None),
                // Refused before.
                Given::Gpu(_) => Column::lent(&[], 1, Some(0)),
            });
        }
    }
}

/// The columns of a call as a list.
fn listed<C: HeldColumns>(columns: &C) -> Vec<Given<'_>> {
    let mut all = Vec::new();
    columns.list(&mut |given| all.push(given));
    all
}

#[cfg(feature = "gpu")]
pub(super) mod on_gpu {
    use super::{Error, Given, Held, Side, foreign, gpu};

    /// The only column of a list of shapes.
    pub fn column<P>(held: &Held<P>) -> Result<&gpu::HeldColumn, Error> {
        match &held.columns {
            Side::Gpu(own) => own.first().ok_or_else(foreign),
            Side::Cpu(_) => Err(foreign()),
        }
    }

    /// Arguments that are there.
    pub fn given<'a>(all: &'a [Given<'a>]) -> Result<Vec<gpu::Given<'a>>, Error> {
        all.iter()
            .map(|given| match given {
                Given::Gpu(own) => Ok(gpu::Given::Held(own)),
                Given::One(numbers) => Ok(gpu::Given::One(numbers)),
                Given::Cpu(..) => Err(foreign()),
            })
            .collect()
    }
}

impl Resident<'_> {
    /// Checks items and uploads them.
    ///
    /// # Errors
    ///
    /// The input's for a shape that is not valid, or what the device says.
    pub fn upload<R: Item<Scalar = f32>>(self, items: &[R]) -> Result<Held<R>, Error> {
        self.kept(items.len(), numbers_of(items)?)
    }

    /// Columns of numbers, checked, where they stay.
    pub(super) fn kept<R>(self, count: usize, numbers: Vec<Numbers>) -> Result<Held<R>, Error> {
        let columns = match self.0 {
            Backend::Cpu => Side::Cpu(numbers),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Side::Gpu(
                numbers
                    .into_iter()
                    .map(|own| gpu::HeldColumn::new(gpu, own.fields, own.rows))
                    .collect::<Result<_, _>>()?,
            ),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        };
        Ok(Held::new(count, columns))
    }

    /// Computes item i of every column, as [`Cpu::aligned`]: a handle of one result per item.
    ///
    /// Results of a GPU are not checked before a further call takes them; the CPU refuses invalid ones.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] when columns differ in length, [`Error::Program`] on a GPU for what searches,
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for handles of other backends, or what
    /// the device says.
    pub fn aligned<C: HeldColumns, R: Runs<C::Item>>(
        self,
        run: R,
        columns: C,
    ) -> Result<Held<R::Out>, Error> {
        let given = listed(&columns);
        match self.0 {
            Backend::Cpu => {
                let mut held = Held::new(0, Side::Cpu(Vec::new()));
                compute::<C::Item, R>(run, &given, &mut held)?;
                Ok(held)
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let made = run.call()?.generated(false)?;
                let given = on_gpu::given(&given)?;
                Ok(of_gpu(gpu.held_aligned(&made, &given, &[])?))
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// [`aligned`](Resident::aligned) into an existing handle, in the same buffers unless another handle
    /// shares them.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Resident::aligned), and [`Error::Length`] for another number of results.
    pub fn aligned_into<C: HeldColumns, R: Runs<C::Item>>(
        self,
        run: R,
        columns: C,
        results: &mut Held<R::Out>,
    ) -> Result<(), Error> {
        let given = listed(&columns);
        match (self.0, &results.columns) {
            (Backend::Cpu, Side::Cpu(_)) => {
                let count = count_of(&given)?;
                expect(Argument::Values, count, results.count)?;
                compute::<C::Item, R>(run, &given, results)
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(over)) => {
                let made = run.call()?.generated(false)?;
                let given = on_gpu::given(&given)?;
                let count = gpu.held_count(&made, &given)?;
                expect(Argument::Values, count, results.count)?;
                let found = gpu.held_aligned(&made, &given, over)?;
                results.columns = Side::Gpu(found);
                Ok(())
            }
            _ => Err(foreign()),
        }
    }
}

/// Results of a GPU.
#[cfg(feature = "gpu")]
pub(super) fn of_gpu<R>(columns: Vec<gpu::HeldColumn>) -> Held<R> {
    let count = columns.first().map_or(0, gpu::HeldColumn::count);
    Held::new(count, Side::Gpu(columns))
}

/// The number of items on the CPU: those of the first column. The call checks the others.
fn count_of(given: &[Given<'_>]) -> Result<usize, Error> {
    if given.iter().any(|given| matches!(given, Given::Gpu(_))) {
        return Err(foreign());
    }
    let counts = given.iter().find_map(|given| match given {
        Given::Cpu(_, count) => Some(*count),
        _ => None,
    });
    Ok(counts.unwrap_or(1))
}

/// Item i of every column, on the processor.
fn compute<R: Item<Scalar = f32>, F: Runs<R>>(
    run: F,
    given: &[Given<'_>],
    results: &mut Held<F::Out>,
) -> Result<(), Error> {
    let count = count_of(given)?;
    let mut found: Vec<Numbers> = F::Out::widths()
        .into_iter()
        .map(|fields| Numbers {
            fields,
            rows: vec![0.0; fields * count],
        })
        .collect();
    let targets = found
        .iter_mut()
        .map(|own| Some(Target::of_rows(&mut own.rows, own.fields)));
    let columns = OnCpu::<R> {
        given,
        row: PhantomData,
    };
    Cpu::new().run_into(run, columns, targets.collect())?;
    *results = Held::new(count, Side::Cpu(found));
    Ok(())
}
