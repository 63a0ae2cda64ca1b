//! The findings, as tables.
use crate::corpus::measure::{Findings, Question};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// One function with one seed.
pub struct Run {
    /// The field it belongs to.
    pub field: &'static str,
    /// The seed of the inputs.
    pub seed: u64,
    /// The findings.
    pub findings: Findings,
}

/// A line of a table: the counts of several questions.
#[derive(Default)]
struct Line {
    functions: BTreeSet<&'static str>,
    right: usize,
    faults: usize,
    equivalent: usize,
    /// For each checker: right ones refused, faults missed, seconds.
    errors: Vec<(usize, usize, f64)>,
}

impl Line {
    fn count(&mut self, question: &Question) {
        self.errors.resize(question.accepted.len(), (0, 0, 0.0));
        match question.kind {
            None => self.right += 1,
            Some(_) => self.faults += 1,
        }
        for ((refused, missed, _), accepted) in self.errors.iter_mut().zip(&question.accepted) {
            match question.kind {
                None => *refused += usize::from(!accepted),
                Some(_) => *missed += usize::from(*accepted),
            }
        }
    }
}

fn share(part: usize, of: usize) -> String {
    match of {
        0 => "-".to_owned(),
        _ => format!("{part} ({:.2} %)", 100.0 * part as f64 / of as f64),
    }
}

/// A table of faults missed by each checker, a line for each group.
fn missed(title: &str, checkers: &[&str], lines: &BTreeMap<String, Line>) -> String {
    let mut out = format!("\n{title:<26} {:>8}", "faults");
    for name in checkers {
        let _ = write!(out, " {:>20}", format!("{name} misses"));
    }
    out.push('\n');
    for (name, line) in lines.iter().filter(|(_, line)| line.faults > 0) {
        let _ = write!(out, "{name:<26} {:>8}", line.faults);
        for (_, missed, _) in &line.errors {
            let _ = write!(out, " {:>20}", share(*missed, line.faults));
        }
        out.push('\n');
    }
    out
}

fn fields(checkers: &[&str], lines: &BTreeMap<String, Line>) -> String {
    let mut out = String::new();
    for (k, name) in checkers.iter().enumerate() {
        let _ = writeln!(
            out,
            "\n{name:<18} {:>9} {:>8} {:>11} {:>18} {:>6} {:>18} {:>8}",
            "functions", "faults", "equivalent", "missed", "right", "falsely refused", "seconds"
        );
        for (field, line) in lines {
            let (refused, missed, seconds) = line.errors[k];
            let _ = writeln!(
                out,
                "{field:<18} {:>9} {:>8} {:>11} {:>18} {:>6} {:>18} {seconds:>8.1}",
                line.functions.len(),
                line.faults,
                line.equivalent,
                share(missed, line.faults),
                line.right,
                share(refused, line.right),
            );
        }
    }
    out
}

/// How large an error is, by powers of ten.
fn size(error: f64) -> String {
    if error.is_infinite() {
        return "error not finite".to_owned();
    }
    match error.log10().floor() as i32 {
        power if power >= 0 => "error above 1".to_owned(),
        power if power < -11 => "error below 1e-11".to_owned(),
        power => format!("error above 1e-{:02}", -power),
    }
}

/// Every question and every answer, with commas between.
#[must_use]
pub fn csv(checkers: &[&str], runs: &[Run]) -> String {
    let mut out = String::from("seed,field,function,kind,fault,error");
    for name in checkers {
        let _ = write!(out, ",{name}");
    }
    out.push('\n');
    for run in runs {
        for question in &run.findings.questions {
            let kind = question.kind.map_or("right".to_owned(), |kind| kind.name());
            let (name, what) = (run.findings.function.name, question.what.replace('"', "'"));
            let _ = write!(
                out,
                "{},{},{name},\"{kind}\",\"{what}\",{:e}",
                run.seed, run.field, question.error
            );
            for accepted in &question.accepted {
                out.push_str(if *accepted { ",accepted" } else { ",refused" });
            }
            out.push('\n');
        }
    }
    out
}

/// Tables by field, by kind of fault and by the size of the error; checkers by their names, in the order in which they
/// were asked.
#[must_use]
pub fn tables(checkers: &[&str], runs: &[Run]) -> String {
    let [mut by_field, mut by_kind, mut by_size]: [BTreeMap<String, Line>; 3] = Default::default();
    for run in runs {
        for name in [run.field, "together"] {
            let line = by_field.entry(name.to_owned()).or_default();
            line.functions.insert(run.findings.function.name);
            line.equivalent += run.findings.equivalent;
            for question in &run.findings.questions {
                line.count(question);
            }
            for ((_, _, all), seconds) in line.errors.iter_mut().zip(&run.findings.seconds) {
                *all += seconds;
            }
        }
        for question in &run.findings.questions {
            if let Some(kind) = question.kind {
                by_kind.entry(kind.name()).or_default().count(question);
                by_size
                    .entry(size(question.error))
                    .or_default()
                    .count(question);
            }
        }
    }
    fields(checkers, &by_field)
        + &missed("kind of fault", checkers, &by_kind)
        + &missed("size, of the usual derivative", checkers, &by_size)
}
