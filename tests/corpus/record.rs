//! The known errors of geograd's harness: a test reports any other.
use crate::corpus::checkers::{Geograd, Task};
use crate::corpus::faults::faults;
use crate::corpus::inputs::{Inputs, RANDOM};
use crate::corpus::kind::Kind;
use crate::corpus::measure::{Question, right};
use crate::corpus::tables::Run;
use std::fmt::Write;

/// Errors of a derivative that are smaller, relative to its usual size, are counted in the table of sizes only. One
/// part in a million of a derivative changes a value by less than its rounding when the value is larger by as
/// much.
pub const VISIBLE: f64 = 1e-6;

/// The name of geograd's harness with a function's generic source.
pub const GEOGRAD: &str = "geograd";

/// An error that is known: of a checker, about right gradients of a function.
struct Known {
    checker: &'static str,
    function: &'static str,
}

/// Functions whose right gradients are refused at some inputs, and why.
const REFUSED: &[Known] = &[
    // Near its axis the derivative across it is a difference of numbers near 1. It has half of its digits, though it
    // stands beside derivatives of one.
    Known {
        checker: "geograd",
        function: "capsule_distance",
    },
    Known {
        checker: "geograd-closures",
        function: "capsule_distance",
    },
    // The derivative has the rest of 1 - tanh², where digits cancel.
    Known {
        checker: "geograd",
        function: "gelu_neuron",
    },
    // A tie at the border of the domain: one side only can be seen.
    Known {
        checker: "geograd-closures",
        function: "rounded_box",
    },
];

/// `true` if a checker of ours, by its name, is known to refuse right gradients of a function.
#[must_use]
pub fn refused(checker: &str, function: &str) -> bool {
    let here = |known: &Known| known.checker == checker && known.function == function;
    REFUSED.iter().any(here)
}

/// `true` if the error of geograd's harness is a known one.
fn known(checker: &str, function: &str, question: &Question) -> bool {
    match question.kind {
        // A derivative that jumps within the last digit of the input is taken to be rounded so badly.
        Some(_) => question.unsteady,
        None => refused(checker, function),
    }
}

/// The errors of one of geograd's checkers.
pub struct Verdict {
    /// The errors in words, with the report of every unknown refusal.
    pub text: String,
    /// How many errors are of no known kind.
    pub unknown: usize,
}

/// The errors of a checker, by its name and its place in the order in which checkers were asked; `None` for others
/// than geograd's.
#[must_use]
pub fn verdict(checker: &str, place: usize, runs: &[Run]) -> Option<Verdict> {
    let generic = match checker {
        "geograd" => true,
        "geograd-closures" => false,
        _ => return None,
    };
    let (mut text, mut unknown) = ("\n".to_owned(), 0);
    let [mut everywhere, mut unsteady, mut right_ones] = [[0_usize; 2]; 3];
    for run in runs {
        let function = run.findings.function.name;
        for question in &run.findings.questions {
            let accepted = question.accepted[place];
            let (counts, wrong) = match question.kind {
                Some(_) if question.error <= VISIBLE => continue,
                Some(_) if question.unsteady => (&mut unsteady, accepted),
                Some(_) => (&mut everywhere, accepted),
                None => (&mut right_ones, !accepted),
            };
            counts[1] += 1;
            counts[0] += usize::from(wrong);
            if wrong && !known(checker, function, question) {
                unknown += 1;
                let kind = question
                    .kind
                    .map_or("right, and refused".to_owned(), Kind::name);
                let _ = writeln!(
                    text,
                    "{checker}: {function}, {kind}: {} (error {:.1e}, seed {})",
                    question.what, question.error, run.seed
                );
                text += &match question.kind {
                    Some(_) => missed(run, question),
                    None => refusal(generic, run, &question.what),
                };
            }
        }
    }
    let share = |[wrong, of]: [usize; 2]| 100.0 * wrong as f64 / of.max(1) as f64;
    let _ = writeln!(
        text,
        "{checker} misses {} of {} faults with an error above {VISIBLE:e} ({:.2} %), {} of {} that jump within the \
         last digit of the input ({:.1} %), and refuses {} of {} right gradients ({:.2} %); of no known kind: {unknown}",
        everywhere[0],
        everywhere[1],
        share(everywhere),
        unsteady[0],
        unsteady[1],
        share(unsteady),
        right_ones[0],
        right_ones[1],
        share(right_ones),
    );
    Some(Verdict { text, unknown })
}

/// The input at which a fault is most wrong, with its gradient and the right one.
fn missed(run: &Run, question: &Question) -> String {
    let function = run.findings.function;
    let inputs = Inputs::new(function, RANDOM, run.seed);
    let mut all = faults(function, &inputs).into_iter();
    let fault = all.find(|fault| Some(fault.kind) == question.kind && fault.what == question.what);
    let gradient = fault.expect("it was asked about").gradient();
    let (mut worst, mut text) = (0.0, String::new());
    for x in &inputs.points {
        let (wrong, right) = (gradient(x), (function.gradient)(x));
        let gap = wrong
            .iter()
            .zip(&right)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        if gap > worst {
            (worst, text) = (
                gap,
                format!("  at    {x:?}\n  says  {wrong:?}\n  right {right:?}\n"),
            );
        }
    }
    text
}

/// The report in which our harness refuses a right gradient.
fn refusal(generic: bool, run: &Run, what: &str) -> String {
    let function = run.findings.function;
    let inputs = Inputs::new(function, RANDOM, run.seed);
    let gradient = right(function).into_iter().find(|(name, _)| *name == what);
    let (_, gradient) = gradient.expect("it was asked about");
    let task = Task::new(function, &inputs.points, &gradient, run.seed);
    Geograd { generic }
        .report(&task, &inputs.points)
        .to_string()
}
