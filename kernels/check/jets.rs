//! Jets as inputs and derivatives as lists, for recorded and for generic functions.
use crate::ad::check::noise::Noisy;
use crate::ad::check::witness::Precision;
use crate::ad::forward::{Along, First};
use crate::ad::sample::drawn::Near;
use crate::{Jet, Real, Scalar};

/// Returns a list in double precision.
pub(crate) fn widened<S: Real>(list: &[S]) -> Vec<f64> {
    list.iter().map(|x| x.widen()).collect()
}
pub(crate) fn nearest<S: Real>(list: &[f64]) -> Vec<S> {
    list.iter().map(|&x| S::nearest(x)).collect()
}
pub(crate) fn noisy_list<S: Real>(list: &[f64]) -> Vec<Noisy<S>> {
    list.iter().map(|&x| Noisy(S::nearest(x))).collect()
}

/// Returns numbers that move along a direction.
pub(crate) fn moving<S: Real, T: Scalar>(
    x: &[f64],
    direction: &[f64],
    of: impl Fn(S) -> T,
) -> Vec<Jet<T, 1>> {
    let jets = x.iter().zip(direction).map(|(&x, &d)| Jet {
        value: of(S::nearest(x)),
        derivative: [of(S::nearest(d))],
    });
    jets.collect()
}
/// Returns the derivatives of jets along one direction.
pub(crate) fn slopes<T: Copy>(jets: &[Jet<T, 1>]) -> Vec<T> {
    jets.iter().map(|jet| jet.derivative[0]).collect()
}

/// Returns numbers as variables; some of them, from index `start` on, have a derivative of their own.
fn variables<S: Real>(x: &[f64], start: usize) -> Vec<First<S>> {
    let jets = x.iter().enumerate();
    let jets = jets.map(|(i, &x)| Jet::variable(S::nearest(x), i.wrapping_sub(start)));
    jets.collect()
}

/// Returns the values of jets that a function returns.
pub(crate) fn values_of_jets<S: Real>(
    x: &[f64],
    eval: impl Fn(&[First<S>]) -> Vec<First<S>>,
) -> Vec<f64> {
    let jets = eval(&variables(x, 0));
    jets.iter().map(|jet| jet.value.widen()).collect()
}

/// Returns the Jacobian of a function with `outputs` results, some variables at a time: one row per result.
pub(crate) fn jacobian<S: Real>(
    outputs: usize,
    x: &[f64],
    eval: impl Fn(&[First<S>]) -> Vec<First<S>>,
) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; x.len()]; outputs];
    let chunk = <First<S> as Scalar>::lit(0.0).derivative.len();
    for start in (0..x.len()).step_by(chunk) {
        for (row, jet) in rows.iter_mut().zip(eval(&variables(x, start))) {
            for (slot, derivative) in row[start..].iter_mut().zip(jet.derivative) {
                *slot = derivative.widen();
            }
        }
    }
    rows
}

/// Returns the Hessian of `y_bar · value` times a direction, by duals of duals.
pub(crate) fn second_order<S: Real>(
    x: &[f64],
    y_bar: &[f64],
    direction: &[f64],
    eval: impl Fn(&[Along<S>]) -> Vec<Along<S>>,
) -> Vec<f64> {
    let along = |value, derivative| Jet {
        value,
        derivative: [derivative],
    };
    let chunk = <First<S> as Scalar>::lit(0.0).derivative.len();
    let mut bends = vec![0.0; x.len()];
    for start in (0..x.len()).step_by(chunk) {
        let jets = x.iter().zip(direction).enumerate().map(|(i, (&x, &d))| {
            let mut jet: Along<S> = <Along<S> as Scalar>::lit(0.0);
            jet.value = along(S::nearest(x), S::nearest(d));
            if let Some(derivative) = jet.derivative.get_mut(i.wrapping_sub(start)) {
                *derivative = along(S::nearest(1.0), S::nearest(0.0));
            }
            jet
        });
        let jets: Vec<Along<S>> = jets.collect();
        for (y_bar, jet) in y_bar.iter().zip(eval(&jets)) {
            for (bend, derivative) in bends[start..].iter_mut().zip(jet.derivative) {
                *bend += y_bar * derivative.derivative[0].widen();
            }
        }
    }
    bends
}

/// Returns the backward error per number: the perturbation of the input that may explain the rounding of shapes.
pub(crate) fn rounding(near: &dyn Near, precision: Precision, x: &[f64]) -> Vec<f64> {
    let (eps, extents) = (precision.epsilon(), near.extents(x));
    let of = |(extent, x): (&f64, &f64)| eps * extent.max(0.5 * x.abs());
    extents.iter().zip(x).map(of).collect()
}
