//! Shapes as rows of numbers: in place, or copied.
use super::layout::{Single, get, put, width};
use super::memory;
use crate::error::Error;
use crate::{Fixed, Real};
use std::any::Any;
use std::borrow::Cow;

/// Returns the numbers of shapes, one shape after another: in place if possible, else copied.
pub(crate) fn numbers<T: Real, P: Fixed<Scalar = T>>(shapes: &[P]) -> Cow<'_, [T]> {
    match memory::lent(shapes) {
        Some(numbers) => Cow::Borrowed(numbers),
        None => {
            let mut rows = vec![T::default(); shapes.len() * width::<P>()];
            // Shapes may have no numbers.
            for (shape, row) in shapes
                .iter()
                .zip(rows.chunks_exact_mut(width::<P>().max(1)))
            {
                put(*shape, row);
            }
            Cow::Owned(rows)
        }
    }
}

/// Returns the numbers of a list of shapes; the list itself if its items are numbers.
pub(crate) fn into_numbers<T: Real, P: Fixed<Scalar = T>>(shapes: Vec<P>) -> Vec<T> {
    let mut shapes = Some(shapes);
    let own: &mut dyn Any = &mut shapes;
    match own.downcast_mut::<Option<Vec<T>>>().and_then(Option::take) {
        Some(numbers) => numbers,
        None => numbers(&shapes.unwrap_or_default()).into_owned(),
    }
}

/// Runs a function on a buffer for the numbers of shapes, and converts them to the shapes, which keep their codes.
pub(crate) fn fill<T: Real, P: Fixed<Scalar = T>, R>(
    shapes: &mut [P],
    run: impl FnOnce(&mut [T]) -> R,
) -> R {
    if let Some(numbers) = memory::lent_mut(shapes) {
        return run(numbers);
    }
    let mut rows = vec![T::default(); shapes.len() * width::<P>()];
    let out = run(&mut rows);
    // Shapes may have no numbers.
    let rows = rows.chunks_exact(width::<P>().max(1));
    for (shape, row) in shapes.iter_mut().zip(rows) {
        *shape = P::load(row).load_codes(&shape.codes());
    }
    out
}

/// Runs a function on a buffer for the numbers and codes of shapes, and converts them to the shapes. If the function
/// fails without writing, the shapes keep their values.
pub(crate) fn fill_whole<T: Real, P: Fixed<Scalar = T>, R>(
    shapes: &mut [P],
    run: impl FnOnce(&mut [T]) -> Result<R, Error>,
) -> Result<R, Error> {
    if let Some(numbers) = memory::lent_mut(shapes) {
        return run(numbers);
    }
    let mut rows = vec![T::default(); shapes.len() * width::<P>()];
    let out = run(&mut rows)?;
    for (shape, row) in shapes
        .iter_mut()
        .zip(rows.chunks_exact(width::<P>().max(1)))
    {
        *shape = get(row);
    }
    Ok(out)
}

/// Returns shapes from their numbers.
pub(crate) fn shapes<P: Single>(count: usize, numbers: &[P::Scalar]) -> Vec<P> {
    let mut many = P::many(count);
    match memory::lent_mut(&mut many) {
        Some(to) => to.copy_from_slice(numbers),
        None => {
            let rows = numbers.chunks_exact(width::<P>().max(1));
            many.iter_mut()
                .zip(rows)
                .for_each(|(shape, row)| *shape = get(row));
        }
    }
    many
}
