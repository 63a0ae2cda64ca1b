//! Checkers of gradients: geograd's harness, two ordinary checkers to compare it with, and any other.
use crate::corpus::function::Function;
use crate::corpus::inputs::name_bits;
use geograd::ad::check::sample::Draw;
use geograd::ad::check::trace::Traced;
use geograd::ad::check::verdict::Reason;
use geograd::ad::check::{Check, Report};
use geograd::{Jet, Pack};

/// One question to a checker: is this the gradient of that function?
pub struct Task<'a> {
    /// The name of the function.
    pub name: &'a str,
    /// The function.
    pub value: &'a dyn Fn(&[f64]) -> f64,
    /// The gradient in question.
    pub gradient: &'a dyn Fn(&[f64]) -> Vec<f64>,
    /// For each number of the input, its interval.
    pub domain: &'a [[f64; 2]],
    /// The inputs to judge; all lie in the domain.
    pub points: &'a [Vec<f64>],
    /// The function's generic source on duals, for checkers that can use it.
    pub dual: fn(&[Jet<f64, 1>]) -> Jet<f64, 1>,
    /// The same on numbers that record comparisons.
    pub traced: fn(&[Traced<f64>]) -> Traced<f64>,
    /// The seed of everything random.
    pub seed: u64,
}

impl<'a> Task<'a> {
    /// The question whether a gradient is that of a function of the corpus.
    #[must_use]
    pub fn new(
        function: &'a Function,
        points: &'a [Vec<f64>],
        gradient: &'a dyn Fn(&[f64]) -> Vec<f64>,
        seed: u64,
    ) -> Self {
        Task {
            name: function.name,
            value: &function.value,
            gradient,
            domain: function.domain,
            points,
            dual: function.dual,
            traced: function.traced,
            seed,
        }
    }
}

/// A checker that accepts or refuses gradients. A closure that takes a [`Task`] is one.
pub trait Checker: Sync {
    /// `true` if the gradient is accepted.
    fn accepts(&self, task: &Task<'_>) -> bool;
}

impl<F: Fn(&Task<'_>) -> bool + Sync> Checker for F {
    fn accepts(&self, task: &Task<'_>) -> bool {
        self(task)
    }
}

/// The checkers that are listed, with their names. Another one is one more line.
pub const CHECKERS: &[(&str, &dyn Checker)] = &[
    ("geograd", &Geograd { generic: true }),
    ("geograd-closures", &Geograd { generic: false }),
    ("differences", &Differences::GRADCHECK),
    ("directions", &Directions::CHECK_GRADS),
];

/// geograd's harness.
#[derive(Clone, Copy, Debug)]
pub struct Geograd {
    /// With the function's generic source (duals, traces), or with value and gradient as closures only.
    pub generic: bool,
}

/// So many inputs are looked at first: most faults show at once, and a refusal is one.
const FIRST: usize = 3;

/// Some numbers, always as many: lists of run-time length are made shorter where a refused input is made simpler.
#[derive(Clone, Debug)]
struct Numbers<S>(Vec<S>);

impl<S: Clone> Pack for Numbers<S> {
    type Scalar = S;
    type With<R: Clone> = Numbers<R>;
    fn remake<R: Clone>(&self, f: &mut impl FnMut(&S) -> R) -> Numbers<R> {
        Numbers(self.0.iter().map(f).collect())
    }
    fn each(&mut self, f: &mut impl FnMut(&mut S)) {
        self.0.iter_mut().for_each(f);
    }
}

impl Geograd {
    /// The whole report at some of the inputs.
    #[must_use]
    pub fn report(self, task: &Task<'_>, points: &[Vec<f64>]) -> Report {
        let within = |(x, [low, high]): (&f64, &[f64; 2])| low <= x && x <= high;
        let check = Check::among(points.iter().cloned().map(Numbers))
            .named(task.name)
            .seed(task.seed)
            .value(|x: Numbers<f64>| (task.value)(&x.0))
            .gradient(|x| Numbers((task.gradient)(&x.0)))
            .inside(|x| x.0.iter().zip(task.domain).all(within));
        if self.generic {
            check
                .dual(|x: Numbers<_>| (task.dual)(&x.0))
                .traced(|x: Numbers<_>| (task.traced)(&x.0))
                .run()
        } else {
            check.run()
        }
    }
}

impl Checker for Geograd {
    fn accepts(&self, task: &Task<'_>) -> bool {
        // Only the last run shows which derivatives could not be judged.
        let final_word = |report: &Report| {
            let unjudged = |r: Reason| matches!(r, Reason::Unjudged | Reason::NothingSmooth);
            report
                .failures
                .iter()
                .any(|failure| !unjudged(failure.fault.reason))
        };
        let first = &task.points[..FIRST.min(task.points.len())];
        !final_word(&self.report(task, first)) && self.report(task, task.points).passed()
    }
}

/// Central differences with one step, number by number, an absolute and a relative tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Differences {
    /// The step.
    pub step: f64,
    /// May differ by this.
    pub absolute: f64,
    /// And by this share of the difference.
    pub relative: f64,
}

impl Differences {
    /// As PyTorch's `torch.autograd.gradcheck` does by default.
    pub const GRADCHECK: Differences = Differences {
        step: 1e-6,
        absolute: 1e-5,
        relative: 1e-3,
    };
}

impl Checker for Differences {
    fn accepts(&self, task: &Task<'_>) -> bool {
        let at = |x: &[f64], i: usize, by: f64| {
            let mut x = x.to_vec();
            x[i] += by;
            (task.value)(&x)
        };
        task.points.iter().all(|x| {
            let gradient = (task.gradient)(x);
            gradient.iter().enumerate().all(|(i, g)| {
                let derivative = (at(x, i, self.step) - at(x, i, -self.step)) / (2.0 * self.step);
                (g - derivative).abs() <= self.absolute + self.relative * derivative.abs()
            })
        })
    }
}

/// Central differences along one random direction at each input, as checkers of whole programs do.
#[derive(Clone, Copy, Debug)]
pub struct Directions {
    /// The step.
    pub step: f64,
    /// Absolute and relative tolerance.
    pub tolerance: f64,
}

impl Directions {
    /// In the manner of JAX's `check_grads` in double precision.
    pub const CHECK_GRADS: Directions = Directions {
        step: 1.0 / 2048.0,
        tolerance: 1e-5,
    };
}

impl Checker for Directions {
    fn accepts(&self, task: &Task<'_>) -> bool {
        let mut draw = Draw::new(task.seed ^ name_bits(task.name));
        task.points.iter().all(|x| {
            // Normally distributed, nearly: a sum of uniform numbers.
            let mut normal = || (0..12).map(|_| draw.unit()).sum::<f64>() - 6.0;
            let direction: Vec<f64> = x.iter().map(|_| normal()).collect();
            let at = |by: f64| {
                let moved: Vec<f64> = x.iter().zip(&direction).map(|(x, d)| x + by * d).collect();
                (task.value)(&moved)
            };
            let derivative = (at(self.step) - at(-self.step)) / (2.0 * self.step);
            let gradient = (task.gradient)(x);
            let along: f64 = gradient.iter().zip(&direction).map(|(g, d)| g * d).sum();
            (along - derivative).abs() <= self.tolerance * (1.0 + derivative.abs())
        })
    }
}
