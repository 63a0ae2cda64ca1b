//! Duals of duals, and functions on them.
use crate::ad::check::trace::Trace;
use crate::{Jet, Pack, Scalar};

/// A number with its derivatives along two directions, and the mixed second derivative.
pub type Bent<T> = Jet<Jet<T, 1>, 1>;

/// A function on duals of duals near an input: evaluated at a point, along two directions.
pub(crate) type BentFn<'a, X> = Box<dyn Fn(&X, [&[f64]; 3]) -> Vec<Bent<f64>> + 'a>;
/// A function on duals of duals that returns its trace, too.
pub(crate) type TracedBentFn<'a, X> = Box<dyn Fn(&X, [&[f64]; 3]) -> (Vec<Bent<f64>>, Trace) + 'a>;

/// Returns a shape of duals of duals, its numbers made by `of`.
pub(crate) fn bent<X: Pack, T: Scalar>(
    near: &X,
    [x, u, v]: [&[f64]; 3],
    of: impl Fn(f64) -> T,
) -> X::With<Bent<T>> {
    let mut i = 0;
    near.remake(&mut |_| {
        i += 1;
        let jet = |value, derivative| Jet {
            value: of(value),
            derivative: [of(derivative)],
        };
        Jet {
            value: jet(x[i - 1], v[i - 1]),
            derivative: [jet(u[i - 1], 0.0)],
        }
    })
}

/// Returns the results as a list.
pub(crate) fn straight<T: Scalar, Y: Pack<Scalar = Bent<T>>>(
    y: &Y,
    of: impl Fn(T) -> f64,
) -> Vec<Bent<f64>> {
    let jet = |jet: &Jet<T, 1>| Jet {
        value: of(jet.value),
        derivative: [of(jet.derivative[0])],
    };
    let numbers = y.scalars();
    let bent = |y: &Bent<T>| Jet {
        value: jet(&y.value),
        derivative: [jet(&y.derivative[0])],
    };
    numbers.iter().map(bent).collect()
}
