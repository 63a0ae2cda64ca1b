//! Checks by the harness of functions whose shapes are known at run time.
use super::Harness;
use super::recorded_subject::{Computations, RecordedSubject};
use crate::Real;
use crate::ad::check::subject::Conventions;
use crate::ad::check::{Check, Report, Sampling, examine};
use crate::ad::declared::Kind;
use crate::ad::program::Format;
use crate::ad::sample::drawn::Near;
use crate::ad::sample::several::{TUPLES, combinations, mingle, together, units};
use crate::ad::sample::{Draw, Sampler, moved};
use crate::error::{Argument, Error};
use crate::kernels::dynamic::Program;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::op::Jumps;
use std::sync::Arc;

/// The inputs of a check: shapes one after another, each as its numbers.
///
/// ```
/// use geograd::check::Sampling;
/// use geograd::kernels::check::Inputs;
/// use geograd::kernels::dynamic::operation;
/// let iou = operation("iou_obb2").expect("is listed");
/// let inputs = Inputs::new(iou.samplers());
/// // The area of the first box less that of the second, and what somebody thinks is its gradient.
/// let value = |x: Vec<f64>| x[2] * x[3] - x[7] * x[8];
/// let gradient = |x: Vec<f64>| vec![0.0, 0.0, x[3], x[2], 0.0, 0.0, 0.0, -x[8], x[7], 0.0];
/// let report = inputs.check::<f64>("areas", &Sampling::new(20, 1)).value(value).gradient(gradient).run();
/// assert_eq!(report.failures[0].fault.input, 8);
/// ```
#[derive(Clone, Debug)]
pub struct Inputs {
    parts: Vec<Sampler>,
    kinds: Vec<Kind>,
    lengths: Vec<usize>,
}

impl Inputs {
    /// Creates inputs from the shapes.
    #[must_use]
    pub fn new(parts: Vec<Sampler>) -> Self {
        let kinds: Vec<Vec<Kind>> = parts.iter().map(|part| (part.kinds)()).collect();
        Inputs {
            parts,
            lengths: kinds.iter().map(Vec::len).collect(),
            kinds: kinds.concat(),
        }
    }
    /// Returns the number of scalars of an input.
    #[must_use]
    pub fn count(&self) -> usize {
        self.kinds.len()
    }
    /// Splits the numbers of an input by shapes.
    fn split<'a>(&self, x: &'a [f64]) -> Vec<&'a [f64]> {
        let mut rest = x;
        let part = |&n: &usize| {
            let (own, others) = rest.split_at(n.min(rest.len()));
            rest = others;
            own
        };
        self.lengths.iter().map(part).collect()
    }
    /// Returns `true` if every part is valid.
    #[must_use]
    pub fn inside(&self, x: &[f64]) -> bool {
        let all = || self.parts.iter().zip(self.split(x));
        x.len() == self.count() && all().all(|(part, own)| (part.inside)(own))
    }
    /// Returns for each number the length over which a function is expected to change.
    #[must_use]
    pub fn scales(&self, x: &[f64]) -> Vec<f64> {
        let all = self.parts.iter().zip(self.split(x));
        let own: Vec<f64> = all.flat_map(|(part, own)| (part.scales)(own)).collect();
        together(own, &self.kinds)
    }
    /// Returns a random input. Some have shapes that touch, share numbers, are far away, tiny or huge.
    #[must_use]
    pub fn draw(&self, draw: &mut Draw) -> Vec<f64> {
        let mut parts: Vec<Vec<f64>> = self.parts.iter().map(|part| (part.draw)(draw)).collect();
        let is_like_first =
            self.kinds[..self.lengths.first().copied().unwrap_or(0)] == *self.kinds_of(1);
        if parts.len() > 1 && is_like_first && draw.once_in(16) {
            parts[1] = (self.parts[0].beside)(&parts[0], draw);
        }
        let plain = parts.concat();
        let mut mingled = plain.clone();
        mingle(&mut mingled, &self.kinds, &self.lengths, draw);
        let own = if self.inside(&mingled) {
            mingled
        } else {
            plain
        };
        let scale = match draw.below(16) {
            0 => 1e-4,
            1 => 1e5,
            2 => draw.magnitude(1e-6, 1e6),
            _ => 1.0,
        };
        let shift = match draw.below(12) {
            0 => [1e5, -1e5],
            1 => [draw.within(-1e3, 1e3), draw.within(-1e3, 1e3)],
            _ => [0.0, 0.0],
        };
        let placed = moved(&own, &self.kinds, 0.0, scale, shift.map(|s| s * scale));
        if self.inside(&placed) { placed } else { own }
    }
    fn kinds_of(&self, part: usize) -> &[Kind] {
        let start = self.lengths.iter().take(part).sum::<usize>();
        let length = self.lengths.get(part).copied().unwrap_or(0);
        &self.kinds[start..start + length]
    }
    /// Returns the hard cases of every shape in all combinations, or in some of many.
    #[must_use]
    pub fn hard(&self) -> Vec<Vec<f64>> {
        let cases: Vec<Vec<Vec<f64>>> = self.parts.iter().map(|part| (part.hard)()).collect();
        let counts: Vec<usize> = cases.iter().map(Vec::len).collect();
        if counts.contains(&0) {
            return Vec::new();
        }
        let all = combinations(&counts, TUPLES).into_iter();
        let input = |at: Vec<usize>| -> Vec<f64> {
            let own = at.iter().zip(&cases).map(|(&i, cases)| cases[i].as_slice());
            own.collect::<Vec<_>>().concat()
        };
        all.map(input).filter(|x| self.inside(x)).collect()
    }

    /// Returns the inputs of a sampling, rounded to a format; the number of hard ones, which come first; and the number
    /// of rejected draws outside the domain.
    fn points<S: Real>(&self, sampling: &Sampling<'_>) -> (Vec<Vec<f64>>, usize, u64) {
        let inside = |x: &[f64]| sampling.inside.is_none_or(|inside| inside(x));
        let rounded =
            |x: Vec<f64>| -> Vec<f64> { x.into_iter().map(|x| S::nearest(x).widen()).collect() };
        let hard = match sampling.hard {
            0 => Vec::new(),
            every => self.hard().into_iter().step_by(every).collect(),
        };
        let certain = sampling.points.iter().cloned().chain(hard);
        let mut all: Vec<Vec<f64>> = certain.map(rounded).filter(|x| self.inside(x)).collect();
        let (random_from, mut outside) = (all.len(), 0);
        for i in 0..sampling.samples {
            let mut draw = sampling.draw(i);
            let mut x = rounded(self.draw(&mut draw));
            for _ in 1..ATTEMPTS {
                if inside(&x) {
                    break;
                }
                x = rounded(self.draw(&mut draw));
                outside += 1;
            }
            all.extend(Some(x).filter(|x| self.inside(x)));
        }
        (all, random_from, outside)
    }

    /// The conventions of functions of shapes: a derivative is zero where the value is, or between zero and the
    /// one-sided derivative at the border of the domain, for example of a box without width.
    pub const CONVENTIONS: Conventions = Conventions {
        flat: true,
        jumps: Jumps::Never,
        shared_ties: false,
        searches: false,
    };

    /// Creates a check at the inputs of a sampling, rounded to the format. It follows [these
    /// conventions](Inputs::CONVENTIONS) unless others are set, and needs a function to check.
    #[must_use]
    pub fn check<'a, S: Real>(&'a self, name: &str, sampling: &Sampling<'a>) -> Check<'a, Vec<S>> {
        let (own_inside, own_scales) = (sampling.inside, sampling.scales);
        let inside = move |x: &[f64]| self.inside(x) && own_inside.is_none_or(|inside| inside(x));
        let wide = |x: &Vec<S>| -> Vec<f64> { x.iter().map(|x| x.widen()).collect() };
        let (points, random_from, _) = self.points::<S>(sampling);
        let [certain, random] = {
            let (certain, random) = points.split_at(random_from);
            [certain, random].map(|points| -> Vec<Vec<S>> {
                let inside = points.iter().filter(|x| inside(x));
                inside
                    .map(|x| x.iter().map(|&x| S::nearest(x)).collect())
                    .collect()
            })
        };
        let [absolute, share] = sampling.resolution.unwrap_or([0.0; 2]);
        let mut check = Check::among(certain).named(name).seed(sampling.seed);
        check.points.extend(random);
        check.kinds.clone_from(&self.kinds);
        check
            .inside(move |x| inside(&wide(x)))
            .scales(move |x| {
                let x = wide(x);
                let scales = own_scales.map_or_else(|| self.scales(&x), |scales| scales(&x));
                scales.into_iter().map(S::nearest).collect()
            })
            .resolution(absolute)
            .relative_resolution(share)
            .conventions(Inputs::CONVENTIONS)
    }
}

/// The largest number of draws for a random input inside the domain.
const ATTEMPTS: usize = 16;

impl Near for Inputs {
    fn kinds(&self) -> Vec<Kind> {
        self.kinds.clone()
    }
    fn inside(&self, x: &[f64]) -> bool {
        Inputs::inside(self, x)
    }
    fn scales(&self, x: &[f64]) -> Vec<f64> {
        Inputs::scales(self, x)
    }
    fn units(&self, x: &[f64]) -> Vec<f64> {
        units(&self.extents(x), &self.kinds)
    }
    fn extents(&self, x: &[f64]) -> Vec<f64> {
        let all = self.parts.iter().zip(self.split(x));
        all.flat_map(|(part, own)| (part.extents)(own)).collect()
    }
}

impl<T: Real> Program<T> {
    /// Returns the recording that the harness checks.
    fn computations(&self, jumps: Jumps) -> Computations<T> {
        let recorded = self.recorded();
        Computations {
            derivatives: Arc::new(recorded.value_vjp()),
            value: Arc::new(recorded.clone()),
            reversed: None,
            source: None,
            batch: self.function(),
            by_hand: |_, _| None,
            num_dual: None,
            outputs: self.sizes()[1],
            output_kinds: Vec::new(),
            nests: !recorded.has_shares(),
            invariances: &[],
            jumps,
        }
    }

    /// Checks the derivatives of the program: reverse against forward and differences, second ones against duals of
    /// duals. In `f32` all are compared with `wide`, this function in `f64`, if it is given.
    ///
    /// ```
    /// use geograd::check::{Jumps, Sampling};
    /// use geograd::kernels::check::Inputs;
    /// use geograd::kernels::dynamic::operation;
    /// let row = operation("distance_point_segment").expect("is listed");
    /// let (inputs, sampling) = (Inputs::new(row.samplers()), Sampling::new(20, 1));
    /// let wide = row.program::<f64>()?;
    /// for report in [
    ///     wide.check("distance", &inputs, &sampling, Jumps::Never, None)?,
    ///     row.program::<f32>()?.check("distance", &inputs, &sampling, Jumps::Never, Some(&wide))?,
    /// ] {
    ///     assert!(report.passed(), "{report}");
    /// }
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for inputs with another number of scalars.
    pub fn check(
        &self,
        name: &str,
        inputs: &Inputs,
        sampling: &Sampling<'_>,
        jumps: Jumps,
        wide: Option<&Program<f64>>,
    ) -> Result<Report, Error> {
        expect(Argument::Shape, self.sizes()[0], inputs.count())?;
        let recording = self.computations(jumps);
        let wide = match T::FORMAT {
            Format::F32 => wide.map(|wide| wide.computations(jumps)),
            Format::F64 => None,
        };
        let (points, random_from, outside) = inputs.points::<T>(sampling);
        let report = examine(name, sampling, &points, random_from, |_, judge| {
            let subject = RecordedSubject {
                near: inputs,
                recording: &recording,
                wide: wide.as_ref(),
                batch: None,
            };
            (Harness::<T>::get().judged)(&subject, judge);
        });
        let names = self.takes().into_iter().flat_map(|(argument, layout)| {
            let names = layout.names().into_iter();
            names.map(move |field| match layout.fields() {
                1 => argument.to_string(),
                _ => field.within(&argument.to_string()).to_string(),
            })
        });
        Ok(Report {
            names: names.collect(),
            outside: report.outside + outside,
            ..report
        })
    }
}
