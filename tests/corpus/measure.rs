//! How often a checker errs.
use crate::corpus::checkers::{Checker, Task};
use crate::corpus::faults::{Fault, Gradient, faults};
use crate::corpus::function::Function;
use crate::corpus::inputs::{Inputs, RANDOM, ROUNDING, name_bits};
use crate::corpus::kind::Kind;
use geograd::Jet;
use geograd::ad::check::sample::Draw;
use std::time::Instant;

/// The question about one gradient.
#[derive(Clone, Debug)]
pub struct Question {
    /// The kind of fault; none for a right gradient.
    pub kind: Option<Kind>,
    /// Which one.
    pub what: String,
    /// How wrong it is, by [`Inputs::error`].
    pub error: f64,
    /// `true` if each of its errors is a jump, by [`Inputs::unsteady`].
    pub unsteady: bool,
    /// For each checker, `true` if it accepts.
    pub accepted: Vec<bool>,
}

/// The findings about one function.
pub struct Findings {
    /// The function.
    pub function: &'static Function,
    /// Everything asked.
    pub questions: Vec<Question>,
    /// Faults that change nothing, or nothing but rounding: not asked.
    pub equivalent: usize,
    /// Seconds that each checker took.
    pub seconds: Vec<f64>,
}

/// Right gradients of a function: by hand, by duals, and by hand with its last digit rounded otherwise.
#[must_use]
pub fn right(function: &'static Function) -> Vec<(&'static str, Gradient)> {
    let by_duals = |x: &[f64]| -> Vec<f64> {
        let derivative = |i: usize| {
            let jet = |(k, &value): (usize, &f64)| Jet {
                value,
                derivative: [f64::from(k == i)],
            };
            let x: Vec<Jet<f64, 1>> = x.iter().enumerate().map(jet).collect();
            (function.dual)(&x).derivative[0]
        };
        (0..x.len()).map(derivative).collect()
    };
    let rounded = |x: &[f64]| -> Vec<f64> {
        let other = |g: f64| g * (1.0 + (g.to_bits() % 3) as f64 * f64::EPSILON - f64::EPSILON);
        (function.gradient)(x).into_iter().map(other).collect()
    };
    vec![
        ("by hand", Box::new(function.gradient)),
        ("by duals", Box::new(by_duals)),
        ("rounded otherwise", Box::new(rounded)),
    ]
}

/// Asks checkers about a function: right gradients first, then faults; of more faults than `most`, a random choice.
#[must_use]
pub fn measure(
    function: &'static Function,
    checkers: &[&dyn Checker],
    seed: u64,
    most: Option<usize>,
    tick: &dyn Fn(),
) -> Findings {
    let inputs = Inputs::new(function, RANDOM, seed);
    let mut findings = Findings {
        function,
        questions: Vec::new(),
        equivalent: 0,
        seconds: vec![0.0; checkers.len()],
    };
    for (what, gradient) in right(function) {
        let question = Question {
            kind: None,
            what: what.to_owned(),
            error: 0.0,
            unsteady: false,
            accepted: Vec::new(),
        };
        findings.ask(question, &inputs, checkers, seed, &|| Box::new(&gradient));
        tick();
    }
    for fault in chosen(
        faults(function, &inputs),
        most,
        seed ^ name_bits(function.name),
    ) {
        let error = inputs.error(&fault.gradient());
        if error <= ROUNDING {
            findings.equivalent += 1;
        } else {
            let question = Question {
                kind: Some(fault.kind),
                what: fault.what.clone(),
                error,
                unsteady: inputs.unsteady(&fault.gradient()),
                accepted: Vec::new(),
            };
            findings.ask(question, &inputs, checkers, seed, &|| fault.gradient());
        }
        tick();
    }
    findings
}

/// So many of the faults, in their order, each as likely as any other.
fn chosen(mut all: Vec<Fault>, most: Option<usize>, seed: u64) -> Vec<Fault> {
    let mut draw = Draw::new(seed);
    while all.len() > most.unwrap_or(usize::MAX) {
        all.swap_remove(draw.below(all.len()));
    }
    all
}

impl Findings {
    fn ask<'g>(
        &mut self,
        mut question: Question,
        inputs: &Inputs,
        checkers: &[&dyn Checker],
        seed: u64,
        fresh: &dyn Fn() -> Box<dyn Fn(&[f64]) -> Vec<f64> + 'g>,
    ) {
        for (checker, seconds) in checkers.iter().zip(&mut self.seconds) {
            let start = Instant::now();
            let gradient = fresh();
            let task = Task::new(self.function, &inputs.points, &gradient, seed);
            question.accepted.push(checker.accepts(&task));
            *seconds += start.elapsed().as_secs_f64();
        }
        self.questions.push(question);
    }
}
