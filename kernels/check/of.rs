//! A check of an operation that is a value: `Check::of(Iou.row::<(Obb2<f64>, Obb2<f64>)>())`.
use crate::ad::check::{Check, Report, SEED, Sampling};
use crate::ad::sample::Sample;
use crate::kernels::check::check_with;
use crate::kernels::row::item::Item;
use crate::kernels::row::op::Op;
use crate::{Fixed, Pack};
use std::marker::PhantomData;
use std::rc::Rc;

type Inside = Rc<dyn Fn(&[f64]) -> bool>;
type Scales = Rc<dyn Fn(&[f64]) -> Vec<f64>>;

/// A check of an operation in both formats; see [`Check::of`].
#[derive(Clone)]
pub struct OfOperation<O> {
    sampling: Sampling<'static>,
    points: Vec<Vec<f64>>,
    inside: Option<Inside>,
    scales: Option<Scales>,
    operation: PhantomData<O>,
}

impl Check<'static, f64> {
    /// Creates a check of an operation in single and in double precision. By default its inputs are the hard cases of
    /// the shapes and two hundred random inputs.
    ///
    /// ```
    /// use geograd::check::*;
    /// use geograd::{operation, Vec2};
    /// operation! {
    ///     /// How far apart two points are, in squares.
    ///     pub Apart = "apart": (a: Vec2<S>, b: Vec2<S>) -> S {
    ///         (a - b).dot(a - b)
    ///     }
    ///     invariances [TranslationX Stays, Rotation Stays, Scaling Power(2), Exchange Stays]
    ///     jumps Never
    ///     derivative Reverse
    /// }
    /// Check::of(Apart).samples(20).assert();
    /// ```
    #[must_use]
    pub fn of<O: Op>(_operation: O) -> OfOperation<O> {
        OfOperation {
            sampling: Sampling::new(200, SEED),
            points: Vec::new(),
            inside: None,
            scales: None,
            operation: PhantomData,
        }
    }
}

impl<O: Op> OfOperation<O>
where
    O::In<f64>: Sample + Item,
    O::Out<f64>: Sample + Item,
    O::In<f32>: Item,
    O::Out<f32>: Item,
{
    /// Sets the number of random inputs.
    #[must_use]
    pub fn samples(mut self, samples: usize) -> Self {
        self.sampling.samples = samples;
        self
    }
    /// Sets the seed.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.sampling.seed = seed;
        self
    }
    /// Uses every `every`-th hard case; none for zero.
    #[must_use]
    pub fn hard(mut self, every: usize) -> Self {
        self.sampling.hard = every;
        self
    }
    /// Adds an input before all others.
    #[must_use]
    pub fn and(mut self, point: O::In<f64>) -> Self {
        self.points.push(point.scalars());
        self
    }
    /// Sets the domain of the operation, in addition to the rules of its shapes: inputs outside are not judged, and no
    /// step leads there. It replaces the [domain](crate::kernels::op::Declared::domain) that the row declares.
    ///
    /// ```
    /// use geograd::check::*;
    /// use geograd::operation;
    /// operation! {
    ///     /// The logarithm of a number.
    ///     pub Logarithm = "logarithm": (x: S) -> S { x.ln() }
    ///     invariances []
    ///     jumps Never
    ///     derivative Reverse
    /// }
    /// Check::of(Logarithm).inside(|x| *x > 1e-3).assert();
    /// ```
    #[must_use]
    pub fn inside(mut self, f: impl Fn(&O::In<f64>) -> bool + 'static) -> Self {
        self.inside = Some(Rc::new(move |x| f(&O::In::<f64>::load(x))));
        self
    }
    /// Sets for each number the length over which the operation is expected to change. The default comes from the
    /// shapes.
    #[must_use]
    pub fn scales(mut self, f: impl Fn(&O::In<f64>) -> O::In<f64> + 'static) -> Self {
        self.scales = Some(Rc::new(move |x| f(&O::In::<f64>::load(x)).scalars()));
        self
    }
    /// Sets the error of values beyond rounding, in the unit of the result: from a lookup table, an iteration that
    /// stops, or digits that cancel in single precision. The tolerance of derivatives does not change. It replaces the
    /// [resolution](crate::kernels::op::Declared::resolution) that the row declares.
    ///
    /// ```
    /// use geograd::check::*;
    /// use geograd::operation;
    /// operation! {
    ///     /// By how much a hyperbola rises above its vertex.
    ///     pub Rise = "rise": (x: S, y: S) -> S {
    ///         (S::one() + x * x + y * y).root() - S::one()
    ///     }
    ///     invariances [Exchange Stays]
    ///     jumps Never
    ///     derivative Reverse
    /// }
    /// // In single precision a sum near one has seven digits after the point.
    /// let [single, double] = Check::of(Rise).run();
    /// assert!(single.refused_for(Reason::ValuesDisagree(Witness::Wide)) && double.passed());
    /// Check::of(Rise).resolution(1e-7).assert();
    /// ```
    #[must_use]
    pub fn resolution(mut self, absolute: f64) -> Self {
        self.sampling
            .resolution
            .get_or_insert(O::DECLARED.resolution)[0] = absolute;
        self
    }
    /// Sets the error of values beyond rounding, relative to each number of the result.
    #[must_use]
    pub fn relative_resolution(mut self, share: f64) -> Self {
        self.sampling
            .resolution
            .get_or_insert(O::DECLARED.resolution)[1] = share;
        self
    }
    /// Requires that a derivative by hand shares exact ties as duals do.
    #[must_use]
    pub fn shared_ties(mut self) -> Self {
        self.sampling.shared_ties = true;
        self
    }
    /// Runs the check. Returns a report in single precision, and one in double.
    #[must_use]
    pub fn run(&self) -> [Report; 2] {
        let sampling = Sampling {
            points: &self.points,
            inside: self.inside.as_deref(),
            scales: self.scales.as_deref(),
            ..self.sampling
        };
        [
            check_with::<O, f32>(&sampling),
            check_with::<O, f64>(&sampling),
        ]
    }
    /// Runs the check, and panics with the report if an input was refused.
    ///
    /// # Panics
    ///
    /// If an input was refused.
    #[track_caller]
    pub fn assert(&self) {
        for report in self.run() {
            assert!(report.passed(), "the operation is refused\n{report}");
        }
    }
}
