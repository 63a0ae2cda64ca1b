//! The report of a check: a line of a table, and the refusals as text. [`examine`](fn@crate::ad::check::examine) fills
//! it.
use crate::ad::check::verdict::{ByWitness, Fault, PAIRS, Reason, Worst};
use crate::ad::check::witness::Precision;
use crate::ad::check::words::{outvoted, place, remedy, write_numbers};
use std::fmt;

/// One refused sample.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The number of the sample, counted from the first hard case or point.
    pub sample: usize,
    /// The refused derivative or property.
    pub fault: Fault,
    /// The input, shrunk as far as it still fails for the same reason.
    pub input: Vec<f64>,
    /// The input as Rust code.
    pub code: String,
    /// The input that a motion makes of it, as Rust code, where the value breaks an invariance; else empty.
    pub moved: String,
}

impl Failure {
    /// Returns a failure of the function as a whole, without an input.
    pub(crate) fn of_all(reason: Reason, sample: usize, input: usize) -> Self {
        Failure {
            sample,
            fault: Fault {
                reason,
                suspect: None,
                output: 0,
                input,
                numbers: ByWitness::default(),
                tolerance: 0.0,
            },
            input: Vec::new(),
            code: String::new(),
            moved: String::new(),
        }
    }
}

/// The results of the check of one function.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its name.
    pub name: String,
    /// The format it computes in.
    pub precision: Precision,
    /// The seed of the random samples.
    pub seed: u64,
    /// The number of inputs that were judged.
    pub samples: u64,
    /// The number of inputs outside the domain, which are not judged.
    pub outside: u64,
    /// The numbers of inputs that were smooth, at kinks, and undefined.
    pub places: [u64; 3],
    /// The number of inputs that needed a declared convention.
    pub conventions: u64,
    /// The number of inputs at which the value jumps.
    pub jumps: u64,
    /// The numbers of directions that were smooth, kinked and undecided, over all samples.
    pub directions: [u64; 3],
    /// The number of directions along which another branch was taken however small the step.
    pub switched: u64,
    /// The smallest margin of any comparison that was not a tie.
    pub margin: f64,
    /// The worst of each pair of witnesses.
    pub worst: [Worst; PAIRS.len()],
    /// The input nearest to refusal by each pair of witnesses, as Rust code; empty where all agreed.
    pub nearest: [String; PAIRS.len()],
    /// The input nearest to refusal by differences as SVG, if the sampling has it drawn.
    pub picture: Option<String>,
    /// The names of the input's numbers, if they have some.
    pub names: Vec<String>,
    /// The number of refused samples.
    pub refused: u64,
    /// `true` if inputs were not judged because too many before them were refused.
    pub stopped: bool,
    /// The first refused samples, one for each reason.
    pub failures: Vec<Failure>,
}

impl Report {
    /// Creates a report without comparisons.
    pub(crate) fn empty(name: &str, seed: u64) -> Self {
        Report {
            name: name.to_owned(),
            precision: Precision::F64,
            seed,
            samples: 0,
            outside: 0,
            places: [0; 3],
            conventions: 0,
            jumps: 0,
            directions: [0; 3],
            switched: 0,
            margin: f64::INFINITY,
            worst: [Worst::default(); PAIRS.len()],
            nearest: Default::default(),
            picture: None,
            names: Vec::new(),
            refused: 0,
            stopped: false,
            failures: Vec::new(),
        }
    }
    /// Returns the report on a function that cannot be judged.
    pub(crate) fn refused_whole(
        name: &str,
        seed: u64,
        precision: Precision,
        reason: Reason,
    ) -> Self {
        Report {
            precision,
            refused: 1,
            failures: vec![Failure::of_all(reason, 0, 0)],
            ..Report::empty(name, seed)
        }
    }
    /// Returns `true` if nothing was refused.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.refused == 0 && self.failures.is_empty()
    }
    /// Returns `true` if something was refused for this reason.
    #[must_use]
    pub fn refused_for(&self, reason: Reason) -> bool {
        self.failures
            .iter()
            .any(|failure| failure.fault.reason == reason)
    }
    /// Returns the meaning of the columns of a table.
    #[must_use]
    pub fn legend() -> &'static str {
        "Every gradient of a function was compared with those of other ways to compute it: dual numbers, differences of \
         values,\n\
         num-dual's numbers (where the gradient is by hand), the same function in double precision, and a batch. A distance in\n\
         space was compared with its proof: the plane that parts the bodies best, and their nearest points.\n\
         A share says how much of the error that both may have was used by the worst of all comparisons; that error is \
         measured\n\
         at every input. More than 100 % is refused; - was not compared. `--details` has the numbers.\n\
         smooth, kink, undefined: whether the function has a derivative at an input, one on either side, or none."
    }
    /// Returns the lines over the lines of a table; see [`legend`](Report::legend).
    #[must_use]
    pub fn heading() -> String {
        let groups = format!(
            "{:<36} {:>6} | {:<31} | {:<54} |",
            "", "", "inputs", "share of the allowed error, compared with"
        );
        format!(
            "{groups}\n{:<36} {:>6} | {:>7} {:>7} {:>5} {:>9} | {:>6} {:>11} {:>8} {:>8} {:>8} {:>8} | verdict",
            "function",
            "format",
            "judged",
            "smooth",
            "kink",
            "undefined",
            "duals",
            "differences",
            "num-dual",
            "f64",
            "batch",
            "proof",
        )
    }
    /// Returns one line of a table.
    #[must_use]
    pub fn line(&self) -> String {
        let used = |worst: &Worst| match worst.nearest.share {
            _ if worst.count == 0 => "-".to_owned(),
            share if share > 1.0 => ">100 %".to_owned(),
            share => format!("{:.0} %", 100.0 * share),
        };
        let [
            dual,
            difference,
            _,
            wide,
            _,
            batch,
            num_dual,
            planes,
            points,
        ] = &self.worst;
        let proof = match planes.nearest.share > points.nearest.share {
            true => planes,
            false => points,
        };
        let proof = if points.count == 0 { planes } else { proof };
        let verdict = if self.passed() {
            "checked".to_owned()
        } else {
            format!("REFUSED ({} samples)", self.refused)
        };
        format!(
            "{:<36} {:>6} | {:>7} {:>7} {:>5} {:>9} | {:>6} {:>11} {:>8} {:>8} {:>8} {:>8} | {verdict}",
            self.name,
            self.precision.name(),
            self.samples,
            self.places[0],
            self.places[1],
            self.places[2],
            used(dual),
            used(difference),
            used(num_dual),
            used(wide),
            used(batch),
            used(proof),
        )
    }
}

/// The first refusal with its numbers, and of further ones a line each; `{:#}` has the numbers of all.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", Report::heading())?;
        writeln!(f, "{}", self.line())?;
        if self.outside > 0 {
            writeln!(
                f,
                "  {} inputs outside the domain are not judged",
                self.outside
            )?;
        }
        if self.stopped {
            writeln!(
                f,
                "  further inputs were not judged: {} were refused, the last of them for no new reason",
                self.refused
            )?;
        }
        // One mistake causes several refusals: the first is shown in full, further ones in a line.
        for (k, failure) in self.failures.iter().enumerate() {
            if k == 0 || f.alternate() {
                self.write_failure(f, failure)?;
                continue;
            }
            let Failure { sample, fault, .. } = failure;
            let place = place(fault, &self.names);
            let also = if k == 1 { "\n  also: " } else { "  also: " };
            writeln!(f, "{also}{}: {place} (sample {sample})", fault.reason)?;
            write_remedy(f, fault.reason)?;
        }
        if self.failures.len() > 1 && !f.alternate() {
            writeln!(f, "  (`{{report:#}}` has the numbers and inputs of all)")?;
        }
        Ok(())
    }
}

fn write_remedy(f: &mut fmt::Formatter<'_>, reason: Reason) -> fmt::Result {
    for line in remedy(reason) {
        writeln!(f, "    {line}")?;
    }
    Ok(())
}

impl Report {
    /// Writes one refusal with its numbers and its input.
    fn write_failure(&self, f: &mut fmt::Formatter<'_>, failure: &Failure) -> fmt::Result {
        let Failure {
            sample,
            fault,
            code,
            moved,
            ..
        } = failure;
        writeln!(f, "\n  {}", fault.reason)?;
        let place = place(fault, &self.names);
        match fault.reason {
            Reason::Unrecordable(_) => writeln!(f, "    {place}")?,
            _ => writeln!(f, "    {place} (sample {sample}, seed {})", self.seed)?,
        }
        write_numbers(f, fault.reason, &fault.numbers, fault.tolerance)?;
        if let Some(suspect) = fault.suspect {
            writeln!(f, "    {}", outvoted(suspect))?;
        }
        if !code.is_empty() {
            writeln!(f, "    let input = {code};")?;
        }
        if !moved.is_empty() {
            writeln!(f, "    let moved = {moved};")?;
        }
        write_remedy(f, fault.reason)?;
        writeln!(f, "    {:?}", fault.reason)
    }
}
