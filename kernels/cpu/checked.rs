//! Checks of columns of shapes and of cotangents.
use crate::Real;
use crate::ad::adjoint::overlap::tamed;
use crate::error::{Argument, Error, Validate};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::plan::Preparation;
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::Column;
use crate::kernels::row::item::Leaf;
use std::sync::Mutex;

/// Checks that every upstream derivative is finite; each has `fields` numbers.
pub(crate) fn check_upstream<T: Real>(upstream: &[T], fields: usize) -> Result<(), Error> {
    if (kernels_in::<T>().all_finite)(upstream) {
        return Ok(());
    }
    for (i, &x) in upstream.iter().enumerate() {
        x.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Upstream,
            item: i / fields,
            flaw,
        })?;
    }
    Ok(())
}

/// Scales upstream derivatives into the range of kernels. Returns each of them with the factor that its results need
/// afterwards, or `None` if all are in range, the usual case.
///
/// # Errors
///
/// [`Error::Invalid`] for one that is not finite.
pub(crate) fn tame<T: Real>(upstream: &[T], steepest: f64) -> Result<Option<Vec<(T, T)>>, Error> {
    if (kernels_in::<T>().all_up_to)(upstream, steepest) {
        return Ok(None);
    }
    check_upstream(upstream, 1)?;
    Ok(Some(upstream.iter().map(|&x| tamed(x)).collect()))
}

/// Multiplies derivatives by the factor that [`tame`] took from their upstream derivative.
pub(crate) fn restore<T: Real>(derivatives: &mut [T], by: T) {
    for x in derivatives {
        *x = (*x * by).saturated();
    }
}

/// Checks every shape of column `k`. Returns `true` if some may be too extreme for kernels.
pub(crate) fn check_argument<T: Real>(
    k: usize,
    arguments: &[Preparation<T>],
    column: &Column<'_, T>,
) -> Result<bool, Error> {
    check(arguments[k].argument(k), &arguments[k], column)
}

/// Checks the shapes of a layout, one after another.
pub(crate) fn check_numbers<T: Real>(
    argument: Argument,
    leaf: Leaf<T>,
    numbers: &[T],
) -> Result<(), Error> {
    let count = numbers.len() / leaf.fields.max(1);
    let column = Column::lent(numbers, leaf.fields, Some(count));
    check(argument, &Preparation::plain(leaf), &column).map(drop)
}

/// Checks every shape of a column. Returns `true` if some may be too extreme for kernels.
pub(crate) fn check<T: Real>(
    argument: Argument,
    preparation: &Preparation<T>,
    column: &Column<'_, T>,
) -> Result<bool, Error> {
    Simd::current()?;
    let (count, group) = (column.len(), column.group());
    let doubtful: Vec<usize> = {
        let mut room = Vec::new();
        let mut is_doubtful = |&start: &usize| {
            preparation.all_ordinary.is_none_or(|test| {
                !test(column.numbers(start..count.min(start + group), &mut room))
            })
        };
        // One test of all numbers suffices for the usual column.
        (0..count)
            .step_by(group)
            .filter(|x| is_doubtful(x))
            .collect()
    };
    let first_flaw = Mutex::new(None);
    let is_any_rare = Mutex::new(false);
    in_parallel(doubtful, |start: usize| {
        let mut room = Vec::new();
        let numbers = column.numbers(start..count.min(start + group), &mut room);
        let mut rare = false;
        for (i, shape) in numbers.chunks_exact(preparation.fields).enumerate() {
            if let Err(flaw) = (preparation.check)(shape) {
                let row = start + i;
                if let Ok(mut first) = first_flaw.lock()
                    && first.is_none_or(|(other, _)| row < other)
                {
                    *first = Some((row, flaw));
                }
                return;
            }
            rare |= (preparation.is_rare)(shape);
        }
        if rare && let Ok(mut any) = is_any_rare.lock() {
            *any = true;
        }
    });
    match first_flaw.into_inner() {
        Ok(Some((row, flaw))) => Err(Error::Invalid {
            argument,
            item: row,
            flaw,
        }),
        _ => Ok(is_any_rare.into_inner().unwrap_or(true)),
    }
}
