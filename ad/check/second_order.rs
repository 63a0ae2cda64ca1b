//! The generic source of a checked function on duals of duals: second derivatives, and a function of `f32` in double
//! precision. [`Check::second_order`] and [`Check::wide`] add it.
use crate::ad::check::bent::{Bent, TracedBentFn, bent, straight};
use crate::ad::check::builder::{Check, CheckAtPoint};
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::tolerances::FEW_INPUTS;
use crate::ad::check::trace::{Trace, Traced, trace};
use crate::ad::check::witness::{Precision, axis, combined, dot};
use crate::{Pack, Real};
use std::fmt::Debug;

impl<'a, S: Real, X: Pack<Scalar = S> + Debug + 'a> Check<'a, X> {
    /// Sets the generic source, called with duals of duals: a witness for [`hessian_times`].
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
    /// Sets the generic source in double precision, of a function of `f32`. Values and derivatives are then compared
    /// with those of the source, and differences are taken in double precision, where they are not mostly rounding. A
    /// function of `f64` does not use it.
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

/// Returns a matrix of `rows` lists of equal length by columns.
pub(crate) fn transposed(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows)
        .map(|j| columns.iter().map(|column| column[j]).collect())
        .collect()
}

/// Returns the Hessian of `y_bar · f` times a direction.
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
    pub(crate) narrow: &'c CheckAtPoint<'c, 'a, X>,
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
        // Duals differentiate by one number after the other, which suits short inputs.
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
