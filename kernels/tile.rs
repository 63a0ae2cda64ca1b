//! What all CPU batches are made of: pieces of work, tiles of lanes, checks of arguments.
use crate::error::{Argument, Error};
use crate::kernels::cpu::{A, B};
use crate::kernels::op::PairOp;
use crate::kernels::real::{Bundle, Real};
use crate::{Fixed, Scalar};
use std::hint::black_box;

/// Runs every piece of work, on all threads when there are threads.
pub(crate) fn spread<W: Send>(work: Vec<W>, run: impl Fn(W) + Send + Sync) {
    #[cfg(feature = "parallel")]
    if work.len() > 1 {
        use rayon::prelude::*;
        work.into_par_iter().with_max_len(1).for_each(run);
        return;
    }
    work.into_iter().for_each(run);
}

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

/// Checks every shape of both lists; `Ok(true)` when some product might over- or underflow.
pub(crate) fn check<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> Result<bool, Error> {
    // Nearly always all is well, which one pass without branches can tell.
    if crate::kernels::simd::vectorized!(all_ordinary::<O, T>(a, b)) {
        return Ok(false);
    }
    let mut ordinary = true;
    for (row, shape) in a.iter().enumerate() {
        let argument = Argument::A;
        ordinary &= O::check_a(shape).map_err(|flaw| Error::Invalid {
            argument,
            row,
            flaw,
        })?;
    }
    for (row, shape) in b.iter().enumerate() {
        let argument = Argument::B;
        ordinary &= O::check_b(shape).map_err(|flaw| Error::Invalid {
            argument,
            row,
            flaw,
        })?;
    }
    Ok(!ordinary)
}

/// Whether every shape is valid and ordinary.
#[inline(always)]
fn all_ordinary<O: PairOp, T: Real>(a: &[A<O, T>], b: &[B<O, T>]) -> bool {
    let mut all = true;
    for shape in a {
        all &= O::is_ordinary_a(*shape);
    }
    for shape in b {
        all &= O::is_ordinary_b(*shape);
    }
    all
}

/// Checks that every upstream slope is finite.
pub(crate) fn check_upstream<T: Real>(upstream: &[T]) -> Result<(), Error> {
    for (row, &x) in upstream.iter().enumerate() {
        crate::error::finite(x, crate::error::Field::Value).map_err(|flaw| Error::Invalid {
            argument: Argument::Upstream,
            row,
            flaw,
        })?;
    }
    Ok(())
}

/// Runs a kernel on bundles with the best instructions there are, or one pair after another where
/// sizes are extreme: too rare a case to be compiled once more for every instruction set.
macro_rules! run {
    ($extreme:expr, $kernel:ident::<$op:ident, $t:ident>($($argument:expr),* $(,)?)) => {
        if $extreme {
            $kernel::<$op, $t, $t::Single, true>($($argument),*)
        } else {
            crate::kernels::simd::vectorized!($kernel::<$op, $t, $t::Bundle, false>($($argument),*))
        }
    };
}

pub(crate) use run;

/// The shape of a bundle: one shape per lane, from as many shapes as there are lanes.
///
/// Kernels call it, and [`scatter`], in loops of their own: next to the arithmetic the compiler
/// would see through the transposition and compute the whole kernel one lane at a time.
#[inline(always)]
pub(crate) fn gather<T: Real, L: Bundle<T>, P: Fixed<Scalar = T>, Q: Fixed<Scalar = L>>(
    shapes: &[P],
) -> Q {
    let shapes = &shapes[..L::WIDTH];
    let mut bundles = zeros::<L, Q>().to_array();
    for (field, bundle) in bundles.as_mut().iter_mut().enumerate() {
        for (x, shape) in bundle.lanes_mut().iter_mut().zip(shapes) {
            *x = shape.to_array().as_ref()[field];
        }
    }
    Q::from_array(bundles)
}

/// The other way.
#[inline(always)]
pub(crate) fn scatter<T: Real, L: Bundle<T>, P: Fixed<Scalar = T>, Q: Fixed<Scalar = L>>(
    from: Q,
    shapes: &mut [P],
) {
    let shapes = &mut shapes[..L::WIDTH];
    let lanes = from.to_array();
    for (lane, shape) in shapes.iter_mut().enumerate() {
        let mut one = zeros::<T, P>().to_array();
        for (x, bundle) in one.as_mut().iter_mut().zip(lanes.as_ref()) {
            *x = bundle.lanes()[lane];
        }
        *shape = P::from_array(one);
    }
}

/// One shape in every lane.
#[inline(always)]
pub(crate) fn splat<T: Real, L: Bundle<T>, P: Fixed<Scalar = T>, Q: Fixed<Scalar = L>>(
    shape: P,
) -> Q {
    let one = shape.to_array();
    let mut lanes = zeros::<L, Q>().to_array();
    for (bundle, &x) in lanes.as_mut().iter_mut().zip(one.as_ref()) {
        *bundle = L::splat(x);
    }
    Q::from_array(lanes)
}

/// Copies a bundle out.
#[inline(always)]
pub(crate) fn store<T: Real, L: Bundle<T>>(from: L, to: &mut [T]) {
    to[..L::WIDTH].copy_from_slice(from.lanes());
}

/// Copies a bundle in.
#[inline(always)]
pub(crate) fn load<T: Real, L: Bundle<T>>(from: &[T]) -> L {
    let mut lanes = L::splat(T::default());
    lanes.lanes_mut().copy_from_slice(&from[..L::WIDTH]);
    lanes
}

/// Where a tile starts. The last one overlaps the one before where the items do not come out even
/// (its results are the same bits): no kernel has a case for what is left over. There are at least
/// as many items as lanes; see [`padded`].
#[inline(always)]
pub(crate) fn start_of<T: Real, L: Bundle<T>>(tile: usize, items: usize) -> usize {
    (tile * L::WIDTH).min(items - L::WIDTH)
}

/// A list too short for one tile, filled up with copies of its last item.
pub(crate) fn padded<P: Copy>(items: &[P], width: usize) -> Vec<P> {
    let mut padded = items.to_vec();
    padded.extend(
        items
            .last()
            .copied()
            .into_iter()
            .cycle()
            .take(width - items.len()),
    );
    padded
}

/// Columns too few for one tile, filled up; `None` where there are enough.
pub(crate) fn widened<P: Copy>(columns: &[P], width: usize) -> Option<Vec<P>> {
    (columns.len() < width).then(|| padded(columns, width))
}

/// The first columns of every row.
pub(crate) fn narrow<T: Copy>(from: &[T], width: usize, to: &mut [T], columns: usize) {
    for (to, from) in to.chunks_mut(columns).zip(from.chunks(width)) {
        to.copy_from_slice(&from[..columns]);
    }
}

/// The lanes of the narrowest tile there may be.
pub(crate) fn width_of<T: Real>(extreme: bool) -> usize {
    if extreme {
        T::Single::WIDTH
    } else {
        T::Bundle::WIDTH
    }
}

/// The index of a tile, hidden from the optimizer.
///
/// Without it the loop over tiles is itself vectorised, sixteen tiles at a time through gathers and
/// scatters, at a third of the speed.
#[inline(always)]
pub(crate) fn opaque(tile: usize) -> usize {
    black_box(tile)
}

/// Every field times a factor.
#[inline(always)]
pub(crate) fn times<S: Scalar, P: Fixed<Scalar = S>>(shape: P, factor: S) -> P {
    let mut fields = shape.to_array();
    for field in fields.as_mut() {
        *field *= factor;
    }
    P::from_array(fields)
}

/// Field by field the sum.
#[inline(always)]
pub(crate) fn plus<S: Scalar, P: Fixed<Scalar = S>>(x: P, y: P) -> P {
    let (mut fields, more) = (x.to_array(), y.to_array());
    for (field, &y) in fields.as_mut().iter_mut().zip(more.as_ref()) {
        *field += y;
    }
    P::from_array(fields)
}

/// A shape of zeros.
#[inline(always)]
pub(crate) fn zeros<S: Scalar, P: Fixed<Scalar = S>>() -> P {
    P::filled(S::zero())
}
