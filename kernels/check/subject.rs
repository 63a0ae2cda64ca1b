//! An operation as a subject of the verification harness: its witnesses, its invariances, what it
//! does on purpose.
use crate::ad::check::noise::{Noisy, noisy};
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::trace::{Number, Trace, Traced, of_num_duals, trace};
use crate::ad::check::witness::Precision;
use crate::ad::declared::{Invariance, Kind};
use crate::ad::forward::{Along, First};
use crate::ad::sample::Sample;
use crate::kernels::check::Source;
use crate::kernels::witness::Batch;
use crate::scalar::float::Float;
use crate::{Fixed, Jet, Pack, Scalar};
use std::marker::PhantomData;

/// An operation's value by another path.
pub type Path<S> = fn(&[S]) -> Vec<S>;
/// An operation's value and derivatives, fused.
pub type Fused<S> = fn(&[S]) -> (Vec<S>, Vec<S>);

/// An operation near an input, in one format.
pub struct OpSubject<'a, O: Source, S: Number>
where
    O::In<f64>: Sample,
{
    near: &'a O::In<f64>,
    paths: &'a [Path<S>],
    fused: Option<Fused<S>>,
    batch: Option<&'a Batch<'a>>,
    op: PhantomData<O>,
}

/// Lists between formats.
pub(crate) fn widened<S: Float>(list: &[S]) -> Vec<f64> {
    list.iter().map(|x| x.widen()).collect()
}
pub(crate) fn nearest<S: Number>(list: &[f64]) -> Vec<S> {
    list.iter().map(|&x| S::nearest(x)).collect()
}

impl<'a, O: Source, S: Number> OpSubject<'a, O, S>
where
    O::In<f64>: Sample,
{
    /// Near an input, which says how many numbers there are.
    #[must_use]
    pub fn new(near: &'a O::In<f64>, paths: &'a [Path<S>], fused: Option<Fused<S>>) -> Self {
        OpSubject {
            near,
            paths,
            fused,
            batch: None,
            op: PhantomData,
        }
    }
    /// With a batch as a further witness; a batch computes in `f32`.
    #[must_use]
    pub fn with_batch(mut self, batch: Option<&'a Batch<'a>>) -> Self {
        self.batch = batch;
        self
    }
    /// The input made of another scalar, one made from the index and value of each number.
    fn made<T: Scalar>(&self, x: &[f64], mut of: impl FnMut(usize, S) -> T) -> O::In<T> {
        let mut i = 0;
        O::map::<f64, T>(self.near, &mut |_| {
            i += 1;
            of(i - 1, S::nearest(x[i - 1]))
        })
    }
    /// The derivatives by hand, on another kind of number.
    fn derivatives<T: Scalar<Mask = bool>>(
        &self,
        x: &[f64],
        y_bar: &[f64],
        of: impl Fn(S) -> T,
    ) -> Vec<T> {
        let y_bar: Vec<T> = y_bar.iter().map(|&y| of(S::nearest(y))).collect();
        O::vjp::<T>(&self.made(x, |_, v| of(v)), O::Out::<T>::load(&y_bar)).scalars()
    }
    /// The Hessian times a direction, through the adjoint, on another kind of number.
    fn bends<T>(&self, x: &[f64], y_bar: &[f64], direction: &[f64], of: impl Fn(S) -> T) -> Vec<T>
    where
        T: Scalar<Primal = T, Mask = bool>,
    {
        let input = self.made(x, |i, value| Jet {
            value: of(value),
            derivative: [of(S::nearest(direction[i]))],
        });
        let y_bar: Vec<Jet<T, 1>> = y_bar
            .iter()
            .map(|&y| <Jet<T, 1> as Scalar>::lit(y))
            .collect();
        let y_bar = O::Out::<Jet<T, 1>>::load(&y_bar);
        let derivatives = O::vjp::<Jet<T, 1>>(&input, y_bar).scalars();
        derivatives.iter().map(|jet| jet.derivative[0]).collect()
    }
}

impl<O: Source, S: Number> Subject for OpSubject<'_, O, S>
where
    O::In<f64>: Sample,
    O::Out<f64>: Sample,
{
    fn precision(&self) -> Precision {
        Precision::of::<S>()
    }
    fn value(&self, x: &[f64]) -> Vec<f64> {
        widened(&O::eval::<S>(&self.made(x, |_, v| v)).scalars())
    }
    fn other_values(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let list: Vec<S> = nearest(x);
        let jets = O::eval::<First<S>>(&self.made(x, |i, v| Jet::variable(v, i))).scalars();
        let mut all: Vec<Vec<f64>> = self
            .paths
            .iter()
            .map(|path| widened(&path(&list)))
            .collect();
        all.extend(self.fused.map(|fused| widened(&fused(&list).0)));
        all.push(jets.iter().map(|jet| jet.value.widen()).collect());
        all
    }
    fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>> {
        Some(widened(&self.derivatives(x, y_bar, |x| x)))
    }
    fn noisy(&self, x: &[f64], y_bar: &[f64], seed: u64) -> Option<Vec<f64>> {
        // Low parts of single precision hold what roundings leave; others would spoil them.
        if S::COMPENSATED {
            return None;
        }
        let derivatives = noisy(seed, || self.derivatives(x, y_bar, Noisy));
        Some(derivatives.iter().map(|s| s.0.widen()).collect())
    }
    fn further(&self, x: &[f64], y_bar: &[f64]) -> Vec<Vec<f64>> {
        let fused = self.fused.map(|fused| fused(&nearest(x)).1);
        let scaled = |list: Vec<S>| list.iter().map(|s| s.widen() * y_bar[0]).collect();
        fused.map(scaled).into_iter().collect()
    }
    fn forms(&self) -> usize {
        self.batch.map_or(0, Batch::forms)
    }
    fn batch(&self, form: usize, x: &[f64], y_bar: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let answer = self.batch?.about(form, x)?;
        let derivatives = answer.derivatives(y_bar);
        Some((answer.value, derivatives))
    }
    fn jacobian(&self, x: &[f64]) -> Option<Vec<Vec<f64>>> {
        let mut rows = vec![vec![0.0; x.len()]; O::Out::<S>::LEN];
        let chunk = <First<S> as Scalar>::lit(0.0).derivative.len();
        for start in (0..x.len()).step_by(chunk) {
            let jets = self.made(x, |i, v| Jet::variable(v, i.wrapping_sub(start)));
            for (row, jet) in rows.iter_mut().zip(O::eval::<First<S>>(&jets).scalars()) {
                for (slot, derivative) in row[start..].iter_mut().zip(jet.derivative) {
                    *slot = derivative.widen();
                }
            }
        }
        Some(rows)
    }
    fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let input = self.made(x, |i, value| Jet {
            value,
            derivative: [S::nearest(direction[i])],
        });
        let out = O::eval::<Jet<S, 1>>(&input).scalars();
        Some(out.iter().map(|jet| jet.derivative[0].widen()).collect())
    }
    fn num_dual(&self, x: &[f64], direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let input = self.made(x, |i, v| S::num_dual(v, S::nearest(direction[i])));
        let out = O::on_num_dual::<S>(&input)?;
        Some(of_num_duals::<S>(out.scalars()))
    }
    fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        let input = self.made(x, |_, v| Traced(v));
        let (out, trace) = trace(|| O::eval::<Traced<S>>(&input));
        Some((out.scalars().iter().map(|y| y.0.widen()).collect(), trace))
    }
    fn curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let bends = self.bends(x, y_bar, direction, |x| x);
        Some(bends.iter().map(|bend| bend.widen()).collect())
    }
    fn noisy_curvature(
        &self,
        x: &[f64],
        y_bar: &[f64],
        direction: &[f64],
        seed: u64,
    ) -> Option<Vec<f64>> {
        if S::COMPENSATED {
            return None;
        }
        let bends = noisy(seed, || self.bends(x, y_bar, direction, Noisy));
        Some(bends.iter().map(|bend| bend.0.widen()).collect())
    }
    fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let chunk = <First<S> as Scalar>::lit(0.0).derivative.len();
        let mut bends = vec![0.0; x.len()];
        for start in (0..x.len()).step_by(chunk) {
            let input = self.made(x, |i, value| {
                let along = |value, derivative| Jet {
                    value,
                    derivative: [derivative],
                };
                let mut jet: Along<S> = <Along<S> as Scalar>::lit(0.0);
                jet.value = along(value, S::nearest(direction[i]));
                if let Some(derivative) = jet.derivative.get_mut(i.wrapping_sub(start)) {
                    *derivative = along(S::nearest(1.0), S::nearest(0.0));
                }
                jet
            });
            for (y_bar, jet) in y_bar.iter().zip(O::eval::<Along<S>>(&input).scalars()) {
                for (bend, derivative) in bends[start..].iter_mut().zip(jet.derivative) {
                    *bend += y_bar * derivative.derivative[0].widen();
                }
            }
        }
        Some(bends)
    }
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        (self.precision() == Precision::F32)
            .then(|| Box::new(OpSubject::<O, f64>::new(self.near, &[], None)) as Box<dyn Subject>)
    }
    fn inside(&self, x: &[f64]) -> bool {
        self.near.refill(x).inside()
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        self.near.refill(x).scales()
    }
    fn units(&self, x: &[f64]) -> Vec<f64> {
        self.near.refill(x).units()
    }
    fn comparable(&self) -> bool {
        true
    }
    fn rounding(&self, x: &[f64]) -> Vec<f64> {
        let eps = self.precision().epsilon();
        let extents = self.near.refill(x).extents();
        extents
            .iter()
            .zip(x)
            .map(|(extent, x)| eps * extent.max(0.5 * x.abs()))
            .collect()
    }
    fn kinds(&self) -> Vec<Kind> {
        self.near.kinds()
    }
    fn output_kinds(&self) -> Vec<Kind> {
        O::Out::<f64>::filled(1.0).kinds()
    }
    fn invariances(&self) -> &[Invariance] {
        O::INVARIANCES
    }
    fn conventions(&self) -> Conventions {
        Conventions {
            flat: true,
            jumps: O::JUMPS,
            shared_ties: false,
            searches: O::SEARCHES,
        }
    }
}
