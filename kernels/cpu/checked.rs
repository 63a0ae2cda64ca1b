//! What stands between slices of shapes and plain numbers: checks, and rows of numbers.
use crate::Fixed;
use crate::ad::adjoint::overlap::tamed;
use crate::error::{Argument, Error};
use crate::kernels::cpu::arch;
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::plan::{Plan, of_any};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::{A, B};
use crate::kernels::op::PairOp;
use crate::kernels::real::Real;
use std::borrow::Cow;

/// Checks the number of items of an argument.
pub(crate) fn expect(argument: Argument, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found {
        Ok(())
    } else {
        Err(Error::Length {
            argument,
            expected,
            found,
        })
    }
}

/// The number of entries of a matrix.
pub(crate) fn entries(rows: usize, columns: usize, fields: usize) -> Result<usize, Error> {
    let count = rows
        .checked_mul(columns)
        .and_then(|n| n.checked_mul(fields));
    count
        .filter(|&n| n <= isize::MAX as usize / 8)
        .ok_or(Error::TooLarge)
}

/// Checks that every upstream slope is finite.
pub(crate) fn check_upstream<T: Real>(upstream: &[T]) -> Result<(), Error> {
    if (T::kernels().all_finite)(upstream) {
        return Ok(());
    }
    for (row, &x) in upstream.iter().enumerate() {
        crate::error::finite(x, crate::error::Field::Value).map_err(|flaw| Error::Invalid {
            argument: Argument::Upstream,
            row,
            flaw,
        })?;
    }
    Ok(())
}

/// Upstream slopes that kernels bear: each with what its results are to be multiplied by afterwards.
/// `None` when they are so themselves, as nearly always.
///
/// # Errors
///
/// When one is not finite.
pub(crate) fn tame<T: Real>(upstream: &[T], steepest: f64) -> Result<Option<Vec<(T, T)>>, Error> {
    if (T::kernels().all_up_to)(upstream, steepest) {
        return Ok(None);
    }
    check_upstream(upstream)?;
    Ok(Some(upstream.iter().map(|&x| tamed(x)).collect()))
}

/// Multiplies slopes by what was taken from their upstream slope.
pub(crate) fn restore<T: Real>(slopes: &mut [T], by: T) {
    for x in slopes {
        *x = (*x * by).saturated();
    }
}

/// Shapes as rows of numbers, one after another.
#[inline]
pub(crate) fn write_rows<T: Real, P: Fixed<Scalar = T>>(shapes: &[P], rows: &mut [T]) {
    for (shape, row) in shapes.iter().zip(rows.chunks_exact_mut(P::LEN)) {
        row.copy_from_slice(shape.to_array().as_ref());
    }
}

/// Rows of numbers as shapes.
#[inline]
pub(crate) fn read_rows<T: Real, P: Fixed<Scalar = T>>(rows: &[T], shapes: &mut [P]) {
    for (shape, row) in shapes.iter_mut().zip(rows.chunks_exact(P::LEN)) {
        let mut fields = P::filled(T::default()).to_array();
        fields.as_mut().copy_from_slice(row);
        *shape = P::from_array(fields);
    }
}

/// The numbers of shapes, one shape after another: as they are in memory, or written out.
pub(crate) fn numbers<T: Real, P: Fixed<Scalar = T>>(shapes: &[P]) -> Cow<'_, [T]> {
    match arch::numbers(shapes) {
        Some(numbers) => Cow::Borrowed(numbers),
        None => {
            let mut rows = vec![T::default(); shapes.len() * P::LEN];
            write_rows(shapes, &mut rows);
            Cow::Owned(rows)
        }
    }
}

/// Hands out room for the numbers of shapes, and makes shapes of what was put there.
pub(crate) fn fill<T: Real, P: Fixed<Scalar = T>, R>(
    shapes: &mut [P],
    run: impl FnOnce(&mut [T]) -> R,
) -> R {
    if let Some(numbers) = arch::numbers_mut(shapes) {
        return run(numbers);
    }
    let mut rows = vec![T::default(); shapes.len() * P::LEN];
    let out = run(&mut rows);
    read_rows(&rows, shapes);
    out
}

/// An operation's plan, and of both lists whether some shapes are too rare for kernels.
pub(crate) struct Checked<T: 'static> {
    pub plan: Plan<T>,
    pub rare: [bool; 2],
}

/// Shapes looked at together: few enough for the innermost cache.
const GROUP: usize = 2048;

/// Whether all shapes are valid and ordinary, told quickly.
fn all_ordinary<T: Real, P: Fixed<Scalar = T>>(told: fn(&[T]) -> bool, shapes: &[P]) -> bool {
    shapes.chunks(GROUP).all(|shapes| told(&numbers(shapes)))
}

/// Checks every shape of both lists.
pub(crate) fn check<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<Checked<T>, Error> {
    Simd::current()?;
    let plan = match O::compiled() {
        Some(compiled) => (T::drivers().plan)(compiled),
        None => of_any::<O, T>(),
    };
    // Nearly always all is well, which a look at all numbers at once can tell.
    let mut rare = [false; 2];
    if !all_ordinary(plan.shapes[0].all_ordinary, a) {
        for (row, shape) in a.iter().enumerate() {
            let argument = Argument::A;
            rare[0] |= !O::check_a(shape).map_err(|flaw| Error::Invalid {
                argument,
                row,
                flaw,
            })?;
        }
    }
    if !all_ordinary(plan.shapes[1].all_ordinary, b) {
        for (row, shape) in b.iter().enumerate() {
            let argument = Argument::B;
            rare[1] |= !O::check_b(shape).map_err(|flaw| Error::Invalid {
                argument,
                row,
                flaw,
            })?;
        }
    }
    Ok(Checked { plan, rare })
}

/// Both lists of an all-pairs batch, checked, as numbers.
pub(crate) fn pairs<'a, O: PairOp, T: Real>(
    a: &'a [A<O, T>],
    b: &'a [B<O, T>],
) -> Result<Pairs<'a, T>, Error> {
    let Checked { plan, rare } = check::<O, T>(a, b)?;
    if a.len().max(b.len()) >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    Ok(Pairs {
        plan,
        numbers: [numbers(a), numbers(b)],
        rare,
        filter: crate::kernels::cpu::culling::is_on(),
    })
}
