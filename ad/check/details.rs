//! The long form of a report, for `--details`: the difference of every pair of witnesses, and the input at which they
//! came nearest to refusal.
use crate::ad::check::report::Report;
use crate::ad::check::verdict::{PAIRS, Reason, Witness, Worst};
use crate::ad::check::words::write_numbers;
use std::fmt::{self, Write};

/// Returns a witness as the subject of a sentence.
fn who(witness: Witness) -> &'static str {
    match witness {
        Witness::Value => "value",
        Witness::Adjoint => "adjoint",
        Witness::Dual => "duals",
        Witness::NumDual => "num-dual's numbers",
        Witness::Difference => "differences",
        Witness::Wide => "duals in double precision",
        Witness::Planes => "planes between the bodies",
        Witness::Points => "nearest points",
        Witness::Batch => "batch",
        Witness::Further(_) => "other paths",
    }
}

/// Writes the share of the comparisons that differ by a number of units of the precision, decade by decade.
fn write_decades(out: &mut String, worst: &Worst) -> fmt::Result {
    out.push_str("    units in the last place of the largest one:");
    let total = worst.decades.iter().sum::<u64>().max(1) as f64;
    let mut seen = 0;
    for (decade, count) in (0..).zip(worst.decades) {
        seen += count;
        if count > 0 {
            let share = 100.0 * seen as f64 / total;
            write!(out, "  < {:.0e} {share:.2} %", 10_f64.powi(decade))?;
        }
    }
    writeln!(out)
}

impl Report {
    /// Returns everything that the [line](Report::line) leaves out: the kinds of points, and for each pair of witnesses
    /// their differences. These are in units in the last place of the largest derivative of the same unit. The numbers
    /// at which they came nearest to refusal follow.
    #[must_use]
    pub fn details(&self) -> String {
        let mut out = String::new();
        // Writing to a string does not fail.
        let _ = self.write_details(&mut out);
        out
    }

    fn write_details(&self, out: &mut String) -> fmt::Result {
        let verdict = if self.passed() { "checked" } else { "REFUSED" };
        let [smooth, kinks, undefined] = self.places;
        writeln!(
            out,
            "{} in {}: {verdict} at {} inputs, seed {}",
            self.name,
            self.precision.name(),
            self.samples,
            self.seed
        )?;
        writeln!(
            out,
            "  {smooth} smooth, {kinks} on a kink, {undefined} undefined; {} by a declared \
             convention, {} where the value jumps",
            self.conventions, self.jumps
        )?;
        let [smooth, kinks, undefined] = self.directions;
        writeln!(
            out,
            "  {smooth} directions smooth, {kinks} across a kink, {undefined} where steps say \
             nothing"
        )?;
        if self.margin.is_finite() {
            let margin = self.margin;
            writeln!(out, "  nearest change of branch {margin:.1e}, relative")?;
        }
        for ((a, b), (worst, code)) in PAIRS.iter().zip(self.worst.iter().zip(&self.nearest)) {
            if worst.count == 0 {
                continue;
            }
            let count = worst.count;
            writeln!(
                out,
                "\n  {} and {}: {count} {} compared",
                who(*a),
                who(*b),
                if *a == Witness::Value {
                    "distances"
                } else {
                    "derivatives"
                }
            )?;
            write_decades(out, worst)?;
            let nearest = &worst.nearest;
            if nearest.share > 0.0 {
                writeln!(
                    out,
                    "    nearest to refusal: {:.0} % of what their errors allow{}, at sample {}, \
                     output {}, input {}{}",
                    100.0 * nearest.share,
                    if nearest.perturbed {
                        ", as provoked rounding showed"
                    } else {
                        ""
                    },
                    nearest.sample,
                    nearest.output,
                    nearest.input,
                    if nearest.numbers.along {
                        " and others, along a random direction"
                    } else {
                        ""
                    }
                )?;
                let reason = Reason::Disagree(*a, *b);
                write_numbers(out, reason, &nearest.numbers, nearest.tolerance)?;
                writeln!(out, "    let input = {code};")?;
            } else {
                writeln!(out, "    the same to the last bit")?;
            }
        }
        Ok(())
    }
}
