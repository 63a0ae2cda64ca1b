//! An item of a search without the types of its shapes, and its derivatives: compiled once per format for all searches.
use crate::kernels::row::derivation::Mode;
use crate::{Jet, Real};

/// The number of inputs per replay on duals. A larger one needs fewer replays with larger duals.
pub(super) const AT_A_TIME: usize = 4;

/// An item that a search has decided, without the types of its shapes: what every search does with it is compiled once
/// per format.
pub(crate) trait SearchedItem<T: Real> {
    /// Writes the result.
    fn value(&self, out: &mut [T]);
    /// Writes the result, then the cotangents of the input by hand in the order of a column. Returns `false` if the search
    /// has none. Without a cotangent of the result it is all ones.
    fn by_hand(&self, out_bar: Option<&[T]>, out: &mut [T]) -> bool;
    /// Returns `false` for a number, by its place, that the replay does not read.
    fn is_read(&self, place: usize) -> bool;
    /// Returns the scalars of the input.
    fn scalars(&self) -> Vec<T>;
    /// Returns the result on duals of the input's scalars.
    fn on_duals(&self, scalars: &[Jet<T, AT_A_TIME>]) -> Vec<Jet<T, AT_A_TIME>>;
    /// Writes derivatives by the input's scalars in the order of a column.
    fn put(&self, scalars: &[T], to: &mut [T]);
    /// Multiplies derivatives in the order of a column.
    fn scale(&self, bars: &mut [T], scale: T);
    /// Returns the number of scalars of the input, of the result, and of a row of the input's column.
    fn sizes(&self) -> [usize; 3];
}

/// Returns a number as a dual without derivatives: no place is so large, so that none is a variable.
pub(super) fn constant<T: Real>(x: T) -> Jet<T, AT_A_TIME> {
    Jet::variable(x, usize::MAX)
}

/// Decides the item of a row, and calls a function with it.
pub(crate) type Decide<T> = fn(&[T], &mut dyn FnMut(&dyn SearchedItem<T>));

/// Decides an item, and writes what a mode gives; the cotangent of the result is `None` unless the mode takes one.
pub(crate) fn compute<T: Real>(
    decide: Decide<T>,
    mode: Mode,
    row: &[T],
    out_bar: Option<&[T]>,
    out: &mut [T],
) {
    decide(row, &mut |item| match mode {
        Mode::Value => item.value(out),
        Mode::Jacobian => with_jacobian(item, out),
        Mode::ValueGrad | Mode::Vjp => with_derivatives(item, out_bar, out),
    });
}

/// Returns the duals of a result for the numbers at up to `AT_A_TIME` places.
fn replayed<T: Real>(
    item: &dyn SearchedItem<T>,
    scalars: &[T],
    places: &[usize],
) -> Vec<Jet<T, AT_A_TIME>> {
    let mut duals: Vec<_> = scalars.iter().copied().map(constant).collect();
    for (k, &place) in places.iter().enumerate() {
        duals[place] = Jet::variable(scalars[place], k);
    }
    item.on_duals(&duals)
}

/// Returns the places of the numbers that a replay reads.
fn places<T: Real>(item: &dyn SearchedItem<T>, scalars: &[T]) -> Vec<usize> {
    let all = 0..scalars.len();
    all.filter(|&place| item.is_read(place)).collect()
}

/// Writes the result of an item, and the gradient of each of its numbers.
fn with_jacobian<T: Real>(item: &dyn SearchedItem<T>, out: &mut [T]) {
    let [inputs, result, width] = item.sizes();
    if result == 1 && item.by_hand(None, out) {
        return;
    }
    let scalars = &item.scalars()[..];
    let mut rows = vec![T::default(); result * inputs];
    for places in places(item, scalars).chunks(AT_A_TIME) {
        let replayed = replayed(item, scalars, places);
        for (row, jet) in rows.chunks_exact_mut(inputs).zip(replayed) {
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                row[place] = derivative;
            }
        }
    }
    item.value(out);
    let gradients = out[result..].chunks_exact_mut(width);
    for (row, gradient) in rows.chunks_exact(inputs).zip(gradients) {
        item.put(row, gradient);
    }
}

/// Writes the result of an item, and its derivatives times a cotangent; without one it is all ones.
fn with_derivatives<T: Real>(item: &dyn SearchedItem<T>, out_bar: Option<&[T]>, out: &mut [T]) {
    let [_, result, _] = item.sizes();
    // The cotangent of one number scales its gradient: both have the same bits but for this product.
    let (own, scale) = match out_bar {
        Some([bar]) => (None, Some(*bar)),
        _ => (out_bar, None),
    };
    if item.by_hand(own, out) {
        if let Some(scale) = scale {
            item.scale(&mut out[result..], scale);
        }
        return;
    }
    item.value(out);
    let scalars = &item.scalars()[..];
    let mut bars = vec![T::default(); scalars.len()];
    for places in places(item, scalars).chunks(AT_A_TIME) {
        let replayed = replayed(item, scalars, places);
        for (k, jet) in replayed.into_iter().enumerate() {
            let by = out_bar.map_or(T::one(), |out_bar| out_bar[k]);
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                bars[place] = if k == 0 {
                    derivative * by
                } else {
                    bars[place] + derivative * by
                };
            }
        }
    }
    item.put(&bars, &mut out[result..]);
}
