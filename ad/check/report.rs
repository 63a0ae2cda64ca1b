//! What came out: a table for reading, JSON for machines, a drill-down for the one that failed.
use crate::ad::check::verdict::{Fault, Numbers, PAIRS, Reason, Witness, Worst};
use crate::ad::check::witness::Precision;
use std::fmt::{self, Write};

/// One refused sample.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The number of the sample, counted from the first hard case or point.
    pub sample: usize,
    /// What was refused.
    pub fault: Fault,
    /// The input, shrunk as far as it still fails for the same reason.
    pub input: Vec<f64>,
    /// The same as Rust code.
    pub code: String,
}

/// Everything found out about one function.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its name.
    pub name: String,
    /// The format it computes in.
    pub precision: Precision,
    /// What random samples were drawn from.
    pub seed: u64,
    /// How many inputs were judged.
    pub samples: u64,
    /// How many of them were smooth places, kinks, and undefined.
    pub places: [u64; 3],
    /// How many needed a declared convention.
    pub conventions: u64,
    /// How many were jumps of the value.
    pub jumps: u64,
    /// Directions that were smooth, kinked and not to be judged, over all samples.
    pub directions: [u64; 3],
    /// Directions along which another branch was taken however small the step.
    pub switched: u64,
    /// The smallest margin of any comparison that was not a tie.
    pub margin: f64,
    /// The worst of each pair of witnesses.
    pub worst: [Worst; PAIRS.len()],
    /// The input nearest to refusal by each pair of witnesses, as Rust code; empty where all agreed.
    pub nearest: [String; PAIRS.len()],
    /// The input nearest to refusal by differences as SVG, when the plan says to draw it.
    pub picture: Option<String>,
    /// How many samples were refused.
    pub refused: u64,
    /// The first of them.
    pub failures: Vec<Failure>,
}

impl Report {
    /// Whether nothing was refused.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.refused == 0 && self.failures.is_empty()
    }
    /// Whether something was refused for this reason.
    #[must_use]
    pub fn refused_for(&self, reason: Reason) -> bool {
        self.failures
            .iter()
            .any(|failure| failure.fault.reason == reason)
    }
    /// The line over the lines of a table.
    #[must_use]
    pub fn heading() -> String {
        format!(
            "{:<24} {:>4} {:>7} {:>7} {:>6} {:>6} | {:>8} {:>8} {:>8} | {:>8} {:>8} {:>8} | {:>8} {:>9} | {}",
            "function",
            "in",
            "samples",
            "smooth",
            "kink",
            "undef",
            "adj-dual",
            "relative",
            "99% ulps",
            "adj-diff",
            "relative",
            "99% ulps",
            "adj-wide",
            "adj-batch",
            "verdict"
        )
    }
    /// One line of a table.
    #[must_use]
    pub fn line(&self) -> String {
        let number = |worst: &Worst, x: f64| {
            if worst.count == 0 {
                "-".to_owned()
            } else {
                format!("{x:.1e}")
            }
        };
        let [dual, difference, _, wide, _, batch] = &self.worst;
        let usual = |worst: &Worst| {
            if worst.count == 0 {
                "-".to_owned()
            } else {
                format!("<{:.0e}", worst.usual())
            }
        };
        let verdict = if self.passed() {
            "proved".to_owned()
        } else {
            format!("REFUSED ({} samples)", self.refused)
        };
        format!(
            "{:<24} {:>4} {:>7} {:>7} {:>6} {:>6} | {:>8} {:>8} {:>8} | {:>8} {:>8} {:>8} | {:>8} {:>9} | {}",
            self.name,
            self.precision.name(),
            self.samples,
            self.places[0],
            self.places[1],
            self.places[2],
            number(dual, dual.absolute),
            number(dual, dual.relative),
            usual(dual),
            number(difference, difference.absolute),
            number(difference, difference.relative),
            usual(difference),
            number(wide, wide.relative),
            number(batch, batch.relative),
            verdict
        )
    }
    /// The whole report as one JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        let mut out = String::new();
        let _ = write!(
            out,
            "{{\"name\":{},\"precision\":\"{:?}\",\"seed\":{},\"passed\":{},\"samples\":{},\
             \"smooth\":{},\"kink\":{},\"undefined\":{},\"conventions\":{},\"jumps\":{},\
             \"directions\":{{\"smooth\":{},\"kink\":{},\"undefined\":{},\"switched\":{}}},\
             \"smallest_margin\":{},\"refused\":{},\"pairs\":[",
            quoted(&self.name),
            self.precision,
            self.seed,
            self.passed(),
            self.samples,
            self.places[0],
            self.places[1],
            self.places[2],
            self.conventions,
            self.jumps,
            self.directions[0],
            self.directions[1],
            self.directions[2],
            self.switched,
            json_number(self.margin),
            self.refused,
        );
        for (k, ((a, b), worst)) in PAIRS.iter().zip(&self.worst).enumerate() {
            let comma = if k == 0 { "" } else { "," };
            let _ = write!(
                out,
                "{comma}{{\"witnesses\":[\"{a:?}\",\"{b:?}\"],\"compared\":{},\"absolute\":{},\
                 \"relative\":{},\"ulps\":{},\"usual_ulps\":{},\"share_of_tolerance\":{},\"provoked\":{},\"sample\":{},\"input\":{}}}",
                worst.count,
                json_number(worst.absolute),
                json_number(worst.relative),
                json_number(worst.ulps),
                json_number(worst.usual()),
                json_number(worst.nearest.share),
                worst.nearest.provoked,
                worst.nearest.sample,
                worst.nearest.input
            );
        }
        out.push_str("],\"failures\":[");
        for (k, failure) in self.failures.iter().enumerate() {
            let Fault {
                reason,
                suspect,
                output,
                input,
                numbers,
                tolerance,
            } = failure.fault;
            let optional = |x: Option<f64>| x.map_or("null".to_owned(), json_number);
            let list: Vec<String> = failure.input.iter().map(|&x| json_number(x)).collect();
            let _ = write!(
                out,
                "{}{{\"reason\":{},\"suspect\":{},\"sample\":{},\"output\":{output},\
                 \"input\":{input},\"along_direction\":{},\"adjoint\":{},\"dual\":{},\"difference\":{},\"other\":{},\
                 \"tolerance\":{},\"at\":[{}],\"code\":{}}}",
                if k == 0 { "" } else { "," },
                quoted(&format!("{reason:?}")),
                suspect.map_or("null".to_owned(), |s| quoted(&format!("{s:?}"))),
                failure.sample,
                numbers.along,
                optional(numbers.adjoint),
                optional(numbers.dual),
                optional(numbers.difference),
                optional(numbers.other),
                json_number(tolerance),
                list.join(","),
                quoted(&failure.code),
            );
        }
        out.push_str("]}");
        out
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", Report::heading())?;
        writeln!(f, "{}", self.line())?;
        for failure in &self.failures {
            let fault = &failure.fault;
            writeln!(
                f,
                "\n  {:?} at sample {} (seed {}): output {}, input {}{}",
                fault.reason,
                failure.sample,
                self.seed,
                fault.output,
                fault.input,
                others(&fault.numbers)
            )?;
            write_numbers(f, &fault.numbers, fault.tolerance)?;
            if let Some(suspect) = fault.suspect {
                let who = match suspect {
                    Witness::Adjoint => "the derivative by hand",
                    Witness::Dual => "the duals",
                    Witness::Difference => "the differences",
                    Witness::Batch => "the batch",
                    Witness::Value | Witness::Wide | Witness::Further(_) => "another witness",
                };
                writeln!(f, "    outvoted:   {who}")?;
            }
            writeln!(f, "    let input = {};", failure.code)?;
        }
        Ok(())
    }
}

/// What is said behind the number of an input.
pub(crate) fn others(numbers: &Numbers) -> &'static str {
    if numbers.along {
        " and others, along a random direction"
    } else {
        ""
    }
}

/// What every witness says, a line each.
pub(crate) fn write_numbers(
    f: &mut impl fmt::Write,
    numbers: &Numbers,
    tolerance: f64,
) -> fmt::Result {
    let named = [
        ("adjoint", numbers.adjoint),
        ("dual", numbers.dual),
        ("difference", numbers.difference),
        ("other", numbers.other),
    ];
    for (name, number) in named {
        if let Some(number) = number {
            writeln!(f, "    {name:<11} {number:>24.16e}")?;
        }
    }
    if let Some([behind, ahead]) = numbers.sides {
        writeln!(f, "    both sides  {behind:>24.16e} {ahead:>24.16e}")?;
    }
    writeln!(f, "    tolerance   {tolerance:>24.16e}")
}

/// A number as JSON, which knows no infinity.
fn json_number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:?}")
    } else {
        "null".to_owned()
    }
}

/// A string as JSON.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if u32::from(c) < 0x20 => {
                let _ = write!(out, "\\u{:04x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
