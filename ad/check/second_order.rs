//! The generic source of a checked function on duals of duals: second derivatives, and what a
//! function of `f32` is in double precision.
use crate::ad::check::Check;
use crate::ad::check::placed::Near;
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::tolerances::FEW_INPUTS;
use crate::ad::check::trace::{Trace, Traced, trace};
use crate::ad::check::witness::{Precision, axis, combined, dot};
use crate::{Jet, Pack, Real, Scalar};
use std::fmt::Debug;

/// A number with its derivatives along two directions, and how the one changes along the other.
pub type Bent<T> = Jet<Jet<T, 1>, 1>;

/// A function on duals of duals near an input: at a point, along two directions.
pub(crate) type BentFn<'a, X> = Box<dyn Fn(&X, [&[f64]; 3]) -> Vec<Bent<f64>> + 'a>;
/// The same with its branches.
pub(crate) type TracedBentFn<'a, X> = Box<dyn Fn(&X, [&[f64]; 3]) -> (Vec<Bent<f64>>, Trace) + 'a>;

/// A shape of duals of duals, its numbers made by `of`.
fn bent<X: Pack, T: Scalar>(
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

/// The results as a list.
fn straight<T: Scalar, Y: Pack<Scalar = Bent<T>>>(y: &Y, of: impl Fn(T) -> f64) -> Vec<Bent<f64>> {
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

impl<'a, S: Real, X: Pack<Scalar = S> + Debug + 'a> Check<'a, X> {
    /// The generic source, called with duals of duals: a witness for [`hessian_times`].
    ///
    /// ```
    /// use geograd::{Scalar, ad::check::Check};
    /// fn cube<S: Scalar>(x: S) -> S {
    ///     x * x * x
    /// }
    /// Check::at(1.3)
    ///     .value(cube)
    ///     .gradient(|x| 3.0 * x * x)
    ///     .hessian_times(|x, v| 6.0 * x * v)
    ///     .second_order(cube)
    ///     .assert();
    /// ```
    ///
    /// [`hessian_times`]: Check::hessian_times
    #[must_use]
    pub fn second_order<Y>(mut self, f: impl Fn(X::With<Bent<S>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Bent<S>>,
    {
        self.second_order = Some(Box::new(move |near, at| {
            straight(&f(bent(near, at, S::nearest)), S::widen)
        }));
        self
    }
    /// The generic source in double precision, of a function of `f32`: then values and derivatives are
    /// compared with those, and differences are taken there, where they are not mostly rounding.
    /// A function of `f64` does not use it.
    ///
    /// ```
    /// use geograd::ad::check::Check;
    /// use geograd::ad::check::verdict::{Reason, Witness};
    /// use geograd::Scalar;
    /// fn half_angle<S: Scalar>(x: S) -> S {
    ///     (S::one() - x.sin_cos().1).halved() // 1 - cos: the digits are lost for small x
    /// }
    /// let report = Check::at(1e-3_f32)
    ///     .value(half_angle)
    ///     .wide(half_angle)
    ///     .gradient(|x| 0.5 * x.sin())
    ///     .run();
    /// assert!(report.refused_for(Reason::ValuesDisagree(Witness::Wide)));
    /// ```
    #[must_use]
    pub fn wide<Y>(mut self, f: impl Fn(X::With<Bent<Traced<f64>>>) -> Y + 'a) -> Self
    where
        Y: Pack<Scalar = Bent<Traced<f64>>>,
    {
        self.wide = Some(Box::new(move |near, at| {
            trace(|| straight(&f(bent(near, at, Traced)), |x| x.0))
        }));
        self
    }
}

/// A matrix of `rows` lists of equal length by columns.
pub(crate) fn transposed(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows)
        .map(|j| columns.iter().map(|column| column[j]).collect())
        .collect()
}

/// The Hessian of `y_bar · f` times a direction.
pub(crate) fn bends(
    f: impl Fn([&[f64]; 3]) -> Vec<Bent<f64>>,
    x: &[f64],
    y_bar: &[f64],
    direction: &[f64],
) -> Vec<f64> {
    let bend = |i: usize| {
        let along = f([x, &axis(x.len(), i), direction]);
        let bends: Vec<f64> = along
            .iter()
            .map(|y| y.derivative[0].derivative[0])
            .collect();
        dot(y_bar, &bends)
    };
    (0..x.len()).map(bend).collect()
}

/// A checked function of `f32` in double precision.
pub(crate) struct Wide<'c, 'a, X: Pack> {
    pub(crate) narrow: &'c Near<'c, 'a, X>,
    pub(crate) source: &'c TracedBentFn<'a, X>,
}

impl<X: Pack> Wide<'_, '_, X> {
    fn at(&self, x: &[f64], direction: &[f64]) -> Vec<Bent<f64>> {
        let still = vec![0.0; x.len()];
        (self.source)(self.narrow.near, [x, direction, &still]).0
    }
}

impl<S: Real, X: Pack<Scalar = S>> Subject for Wide<'_, '_, X> {
    fn precision(&self) -> Precision {
        Precision::F64
    }
    fn value(&self, x: &[f64]) -> Vec<f64> {
        let still = vec![0.0; x.len()];
        self.at(x, &still).iter().map(|y| y.value.value).collect()
    }
    fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let ahead = self.at(x, direction);
        Some(ahead.iter().map(|y| y.derivative[0].value).collect())
    }
    fn jacobian(&self, x: &[f64]) -> Option<Vec<Vec<f64>>> {
        let column = |i| self.along(x, &axis(x.len(), i));
        let columns: Option<Vec<_>> = (0..x.len()).map(column).collect();
        Some(transposed(&columns?))
    }
    fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>> {
        // By duals, one number after the other: for short inputs.
        let jacobian = (x.len() <= FEW_INPUTS).then(|| self.jacobian(x))??;
        Some(combined(y_bar, &jacobian, x.len()))
    }
    fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let near = self.narrow.near;
        Some(bends(|at| (self.source)(near, at).0, x, y_bar, direction))
    }
    fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        let still = vec![0.0; x.len()];
        let (y, trace) = (self.source)(self.narrow.near, [x, &still, &still]);
        Some((y.iter().map(|y| y.value.value).collect(), trace))
    }
    fn inside(&self, x: &[f64]) -> bool {
        self.narrow.inside(x)
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        self.narrow.scales(x)
    }
    fn conventions(&self) -> Conventions {
        self.narrow.conventions()
    }
}
