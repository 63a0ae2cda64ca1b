//! A recorded operation as a subject of the verification harness: functions from lists of numbers to lists of numbers.
//! `Harness` sees to it that it is compiled once, in the library.
use crate::ad::check::noise::{Noisy, noisy};
use crate::ad::check::subject::{Conventions, Subject};
use crate::ad::check::trace::{Trace, Traced, num_duals, of_num_duals, trace};
use crate::ad::check::trace_lanes::{LANES, TracedLanes, trace_lanes};
use crate::ad::check::witness::Precision;
use crate::ad::declared::{Invariance, Kind};
use crate::ad::forward::{Along, First};
use crate::ad::program::recorded::Recorded;
use crate::ad::sample::drawn::Near;
use crate::kernels::check::jets::{self, moving, nearest, noisy_list, widened};
use crate::kernels::check::subject::Path;
use crate::kernels::check::witness::Batch;
use crate::kernels::dynamic::{Function, Rows};
use crate::kernels::row::op::Jumps;
use crate::{Jet, Real, Scalar};
use std::sync::Arc;

/// The result and the derivatives by hand, from an input and a cotangent; `None` without them.
pub(crate) type ByHand<S> = fn(&[S], &[S]) -> Option<(Vec<S>, Vec<S>)>;

/// The computations of an operation in one format that the harness compares.
#[derive(Clone)]
pub(crate) struct Computations<S: Real> {
    /// The recorded result.
    pub value: Arc<Recorded>,
    /// The recorded result with derivatives, from the input and a cotangent, by the declared source of derivatives.
    pub derivatives: Arc<Recorded>,
    /// Reverse derivatives of the recorded function, as a second derivation, if the first is by hand. In double
    /// precision alone, since cotangents of nearly parallel boxes cancel in single.
    pub reversed: Option<Arc<Recorded>>,
    /// The function itself on plain numbers, if it is more than its recording.
    pub source: Option<Path<S>>,
    /// A batch of the result.
    pub batch: Function<S>,
    /// The derivatives by hand on plain numbers.
    pub by_hand: ByHand<S>,
    /// The function itself on num-dual's numbers, if derivatives are by hand.
    pub num_dual: Option<fn(&[S::NumDual]) -> Vec<S::NumDual>>,
    /// The number of scalars of a result.
    pub outputs: usize,
    /// The kind of each number of a result.
    pub output_kinds: Vec<Kind>,
    /// `true` if duals of duals compute its second derivatives; not so if a part has a gradient by hand.
    pub nests: bool,
    /// Its invariances.
    pub invariances: &'static [Invariance],
    /// Places at which its value may jump.
    pub jumps: Jumps,
}

impl<S: Real> Computations<S> {
    /// Returns the result of a batch of one item; an empty list if the batch refuses it.
    fn batch_value(&self, x: &[S]) -> Vec<S> {
        let mut rest = x;
        let takes = self.batch.takes().into_iter();
        let rows: Vec<Rows<'_, S>> = takes
            .map(|(_, layout)| {
                let (own, others) = rest.split_at(layout.fields());
                rest = others;
                Rows::new(own, layout.fields())
            })
            .collect();
        self.batch
            .aligned(&rows)
            .map_or(Vec::new(), |lists| lists.concat())
    }
    /// Returns the derivatives, on any scalar.
    fn derivatives_on<T: Scalar>(&self, x: Vec<T>, y_bar: Vec<T>) -> Vec<T> {
        let mut all = self.derivatives.run_on(&[x, y_bar].concat());
        all.split_off(self.outputs)
    }
    /// Returns reverse derivatives of the recorded function, if they are a second derivation.
    fn reversed_on<T: Scalar>(&self, x: &[T], y_bar: &[T]) -> Option<Vec<T>> {
        let mut all = self.reversed.as_ref()?.run_on(&[x, y_bar].concat());
        Some(all.split_off(self.outputs))
    }
    /// Returns the Hessian times a direction, from the derivatives on another number type.
    fn bends<T>(&self, x: &[f64], y_bar: &[f64], direction: &[f64], of: impl Fn(S) -> T) -> Vec<T>
    where
        T: Scalar<Primal = T>,
    {
        let y_bar = y_bar.iter().map(|&y| <Jet<T, 1> as Scalar>::lit(y));
        jets::slopes(&self.derivatives_on(moving(x, direction, of), y_bar.collect()))
    }
}

/// A recorded operation near an input.
pub struct RecordedSubject<'a, S: Real> {
    pub(crate) near: &'a dyn Near,
    pub(crate) recording: &'a Computations<S>,
    /// The operation in double precision.
    pub(crate) wide: Option<&'a Computations<f64>>,
    /// A batch on a backend, as a further witness.
    pub(crate) batch: Option<&'a Batch<'a>>,
}

impl<S: Real> Subject for RecordedSubject<'_, S> {
    fn precision(&self) -> Precision {
        Precision::of::<S>()
    }
    fn value(&self, x: &[f64]) -> Vec<f64> {
        let list: Vec<S> = nearest(x);
        let recording = self.recording;
        widened(&match recording.source {
            Some(source) => source(&list),
            None => recording.value.run(&list),
        })
    }
    fn other_values(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let list: Vec<S> = nearest(x);
        let recording = self.recording;
        let mut all = vec![
            widened(&recording.value.run(&list)),
            widened(&recording.batch_value(&list)),
            jets::values_of_jets::<S>(x, |x| recording.value.run_on(x)),
        ];
        let ones = vec![S::one(); recording.outputs];
        let fused = (recording.by_hand)(&list, &ones);
        all.extend(fused.map(|fused| widened(&fused.0)));
        all
    }
    fn adjoint(&self, x: &[f64], y_bar: &[f64]) -> Option<Vec<f64>> {
        let (x, y_bar): (Vec<S>, Vec<S>) = (nearest(x), nearest(y_bar));
        let derivatives = match (self.recording.by_hand)(&x, &y_bar) {
            Some((_, derivatives)) => derivatives,
            None => self.recording.derivatives_on(x, y_bar),
        };
        Some(widened(&derivatives))
    }
    fn noisy(&self, x: &[f64], y_bar: &[f64], seed: u64) -> Option<Vec<f64>> {
        // Low parts in single precision hold rounding errors; other values would distort them.
        if S::format().is_compensated() {
            return None;
        }
        let derivatives = noisy(seed, || {
            let (x, y_bar) = (noisy_list::<S>(x), noisy_list(y_bar));
            self.recording.derivatives_on(x, y_bar)
        });
        Some(derivatives.iter().map(|s| s.0.widen()).collect())
    }
    fn further(&self, x: &[f64], y_bar: &[f64]) -> Vec<Vec<f64>> {
        let (x, y_bar): (Vec<S>, Vec<S>) = (nearest(x), nearest(y_bar));
        // Derivatives by a second derivation, and as batches compute them.
        let reversed = self.recording.reversed_on(&x, &y_bar);
        let mut all = vec![widened(&self.recording.derivatives_on::<S>(x, y_bar))];
        all.extend(reversed.map(|derivatives| widened(&derivatives)));
        all
    }
    fn noisy_further(
        &self,
        x: &[f64],
        y_bar: &[f64],
        position: usize,
        seed: u64,
    ) -> Option<Vec<f64>> {
        if position == 0 {
            return None;
        }
        let derivatives = noisy(seed, || {
            let (x, y_bar) = (noisy_list::<S>(x), noisy_list(y_bar));
            self.recording.reversed_on(&x, &y_bar)
        });
        Some(derivatives?.iter().map(|s| s.0.widen()).collect())
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
        let eval = |x: &[First<S>]| self.recording.value.run_on(x);
        Some(jets::jacobian(self.recording.outputs, x, eval))
    }
    fn along(&self, x: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let input = moving(x, direction, |x: S| x);
        Some(widened(&jets::slopes(&self.recording.value.run_on(&input))))
    }
    fn num_dual(&self, x: &[f64], direction: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let source = self.recording.num_dual?;
        let input = num_duals::<S>(x, direction);
        Some(of_num_duals::<S>(source(&input)))
    }
    fn traced(&self, x: &[f64]) -> Option<(Vec<f64>, Trace)> {
        let input: Vec<Traced<S>> = x.iter().map(|&x| Traced(S::nearest(x))).collect();
        let (out, trace) = trace(|| self.recording.value.run_on(&input));
        Some((out.iter().map(|y| y.0.widen()).collect(), trace))
    }
    fn traced_all(&self, inputs: &[Vec<f64>]) -> Option<Vec<(Vec<f64>, Trace)>> {
        let mut all = Vec::with_capacity(inputs.len());
        for block in inputs.chunks(LANES) {
            // Lanes without an input repeat the last one.
            let lane = |i: usize| &block[i.min(block.len() - 1)];
            let numbers = 0..lane(0).len();
            let input: Vec<TracedLanes<S>> = numbers
                .map(|k| TracedLanes(std::array::from_fn(|i| S::nearest(lane(i)[k]))))
                .collect();
            let (out, traces) = trace_lanes(|| self.recording.value.run_on(&input));
            all.extend((0..block.len()).map(|i| {
                let values = out.iter().map(|y| y.0[i].widen());
                (values.collect(), traces[i])
            }));
        }
        Some(all)
    }
    fn curvature(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        let bends = self.recording.bends(x, y_bar, direction, |x| x);
        Some(bends.iter().map(|bend| bend.widen()).collect())
    }
    fn noisy_curvature(
        &self,
        x: &[f64],
        y_bar: &[f64],
        direction: &[f64],
        seed: u64,
    ) -> Option<Vec<f64>> {
        if S::format().is_compensated() {
            return None;
        }
        let bends = noisy(seed, || self.recording.bends(x, y_bar, direction, Noisy));
        Some(bends.iter().map(|bend| bend.0.widen()).collect())
    }
    fn second_order(&self, x: &[f64], y_bar: &[f64], direction: &[f64]) -> Option<Vec<f64>> {
        if !self.recording.nests {
            return None;
        }
        let eval = |x: &[Along<S>]| self.recording.value.run_on(x);
        Some(jets::second_order(x, y_bar, direction, eval))
    }
    fn wide(&self) -> Option<Box<dyn Subject + '_>> {
        let recording = self.wide?;
        Some(Box::new(RecordedSubject {
            near: self.near,
            recording,
            wide: None,
            batch: None,
        }))
    }
    fn inside(&self, x: &[f64]) -> bool {
        self.near.inside(x)
    }
    fn total(&self) -> bool {
        // A straight line.
        true
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        self.near.scales(x)
    }
    fn units(&self, x: &[f64]) -> Vec<f64> {
        self.near.units(x)
    }
    fn comparable(&self) -> bool {
        true
    }
    fn rounding(&self, x: &[f64]) -> Vec<f64> {
        jets::rounding(self.near, self.precision(), x)
    }
    fn kinds(&self) -> Vec<Kind> {
        self.near.kinds()
    }
    fn output_kinds(&self) -> Vec<Kind> {
        self.recording.output_kinds.clone()
    }
    fn invariances(&self) -> &[Invariance] {
        self.recording.invariances
    }
    fn conventions(&self) -> Conventions {
        Conventions {
            flat: true,
            jumps: self.recording.jumps,
            shared_ties: false,
            searches: false,
        }
    }
}
