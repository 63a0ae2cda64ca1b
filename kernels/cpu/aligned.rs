//! Aligned batches of columns of numbers.
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{check, check_upstream};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::plan::{Plan, Preparation};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::stretches::{self, Aligned};
use crate::kernels::machine::Column;
use crate::kernels::row::item::Target;

/// Checks columns. Returns the number of items, and `true` if some may be too extreme for kernels.
pub(crate) fn checked<T: Real>(
    plan: &Plan<T>,
    columns: &[Column<'_, T>],
) -> Result<(usize, bool), Error> {
    let count = items(&plan.arguments, columns)?;
    let rare = sound(&plan.arguments, plan.steepest, columns)?;
    Ok((count, rare))
}

/// Returns the name of column `k`: arguments come first, then cotangents.
pub(crate) fn name_of<T>(arguments: &[Preparation<T>], k: usize) -> Argument {
    let own = arguments.get(k);
    own.map_or(Argument::Upstream, |argument| argument.argument(k))
}

/// Returns the number of items of the columns of arguments and cotangents.
pub(crate) fn items<T: Real>(
    arguments: &[Preparation<T>],
    columns: &[Column<'_, T>],
) -> Result<usize, Error> {
    let mut count = None;
    for (k, column) in columns.iter().enumerate() {
        match (count, column.count) {
            (None, found) => count = found,
            (Some(expected), Some(found)) if expected != found => {
                return Err(Error::Length {
                    argument: name_of(arguments, k),
                    expected,
                    found,
                });
            }
            _ => (),
        }
    }
    Ok(count.unwrap_or(1))
}

/// Checks the numbers of columns. Returns `true` if some may be too extreme, or too steep, for kernels.
pub(crate) fn sound<T: Real>(
    arguments: &[Preparation<T>],
    steepest: f64,
    columns: &[Column<'_, T>],
) -> Result<bool, Error> {
    let mut rare = false;
    for (k, column) in columns.iter().enumerate() {
        match arguments.get(k) {
            Some(own) => rare |= check(own.argument(k), own, column)?,
            None => {
                let numbers = column.all();
                check_upstream(&numbers, column.fields)?;
                // A cotangent too steep for kernels makes its item rare, as a rare shape does.
                rare |= !(kernels_in::<T>().all_up_to)(&numbers, steepest);
            }
        }
    }
    Ok(rare)
}

pub(crate) fn compute<'a, T: Real>(
    plan: &'a Plan<T>,
    columns: &'a [Column<'a, T>],
    rare: bool,
    count: usize,
    targets: Vec<Option<Target<'a, T>>>,
) {
    stretches::compute(Aligned {
        plan,
        columns,
        rare,
        count,
        unchecked: false,
        targets,
    });
}

/// Returns `true` if [unchecked](compute_unchecked) numbers may be computed with, so that a program reads them from memory
/// once.
pub(crate) fn checks_later<T: Real>(plan: &Plan<T>) -> bool {
    let is_brief = || plan.maker.rows().is_some_and(|rows| rows.is_brief());
    let mut arguments = plan.arguments.iter();
    plan.rare.is_none()
        && arguments.all(|x| x.frame.is_none() && x.all_ordinary.is_some())
        && is_brief()
        && Simd::current().is_ok()
}

/// Computes items with unchecked numbers into new targets. Returns `false` where some are suspect; the results are then
/// incomplete.
pub(crate) fn compute_unchecked<'a, T: Real>(
    plan: &'a Plan<T>,
    columns: &'a [Column<'a, T>],
    count: usize,
    targets: Vec<Option<Target<'a, T>>>,
) -> bool {
    stretches::compute(Aligned {
        plan,
        columns,
        rare: false,
        count,
        unchecked: true,
        targets,
    })
}
