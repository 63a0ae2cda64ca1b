//! The tables, as text and in BENCHMARKS.md.
use crate::rates::Rate;
use geograd::kernels::gpu::Adapter;
use geograd_tests::listed::parity::{Compared, FEW, NEAR};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::{SystemTime, UNIX_EPOCH};

/// The marks between which the tables are in BENCHMARKS.md.
const MARKS: [&str; 2] = ["<!-- gpu report -->", "<!-- end of gpu report -->"];

/// A form of a row on both machines; nothing is found where a GPU refuses it.
pub struct Parity {
    pub row: String,
    pub form: &'static str,
    pub found: Option<Compared>,
}

/// All that was found on a GPU.
pub struct Report {
    pub adapter: Adapter,
    pub parity: Vec<Parity>,
    pub rates: Vec<Rate>,
    pub items: usize,
}

/// The day, as year, month and day, in the calendar of 400 years of 146,097 days that begin on a first of March.
fn date(seconds: u64) -> String {
    let days = seconds / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let of_month = of_year - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{of_month:02}", era * 400 + year + next)
}

impl Report {
    /// Rows and forms that differ by more than their bound.
    pub fn wrong(&self) -> Vec<String> {
        let own = self.parity.iter();
        let wrong = own.filter(|x| x.found.is_some_and(|found| !found.is_within()));
        wrong.map(|x| format!("{}, {}", x.row, x.form)).collect()
    }

    /// The tables in Markdown.
    pub fn text(&self) -> String {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let adapter = &self.adapter;
        let rows: std::collections::BTreeSet<&str> = self.parity.iter().map(|x| &*x.row).collect();
        let numbers: usize = self
            .parity
            .iter()
            .filter_map(|x| x.found)
            .map(|x| x.results)
            .sum();
        let refused = self.parity.iter().filter(|x| x.found.is_none()).count();
        let mut text = format!(
            "{}, {}: {} ({}, {}){}. {} rows in {} forms of {} items, {numbers} numbers compared with the CPU's; {refused} forms \
             refused. A number is near within {NEAR:.0e} of itself and of one. One that is not, and is not what the CPU gives for \
             inputs a few last digits away either, is outside; {FEW} in a thousand of a form may be.\n\n",
            date(now.map_or(0, |now| now.as_secs())),
            "`gpu_report`",
            adapter.name,
            adapter.backend,
            adapter.driver,
            if adapter.is_software {
                ", a driver in software"
            } else {
                ""
            },
            rows.len(),
            self.parity.len(),
            self.items,
        );
        text += "| verb | rows | numbers | not near | outside | beyond the bound |\n| --- | ---: | ---: | ---: | ---: | --- |\n";
        let mut verbs: BTreeMap<&str, Vec<&Parity>> = BTreeMap::new();
        for own in &self.parity {
            verbs
                .entry(own.row.split('(').next().unwrap_or(&own.row))
                .or_default()
                .push(own);
        }
        for (verb, all) in &verbs {
            let rows: std::collections::BTreeSet<&str> = all.iter().map(|x| &*x.row).collect();
            let sum = |of: fn(&Compared) -> usize| -> usize {
                all.iter().filter_map(|x| x.found.as_ref()).map(of).sum()
            };
            let wrong = all
                .iter()
                .filter(|x| x.found.is_some_and(|found| !found.is_within()));
            let wrong: Vec<_> = wrong.map(|x| format!("{}, {}", x.row, x.form)).collect();
            let wrong = if wrong.is_empty() {
                "none".to_owned()
            } else {
                wrong.join("; ")
            };
            let _ = writeln!(
                text,
                "| `{verb}` | {} | {} | {} | {} | {wrong} |",
                rows.len(),
                sum(|x| x.results),
                sum(|x| x.apart),
                sum(|x| x.wrong)
            );
        }
        text += "\nMillions a second over arrays that stay; the CPU with slices, on all its threads.\n\n\
                 | row | call | pairs | GPU, call | GPU, kernels | CPU |\n| --- | --- | ---: | ---: | ---: | ---: |\n";
        for rate in &self.rates {
            let kernels = rate
                .kernel_rate
                .map_or("—".to_owned(), |rate| format!("{rate:.1}"));
            let _ = writeln!(
                text,
                "| `{}` | {} | {} | {:.1} | {kernels} | {:.1} |",
                rate.row, rate.call, rate.pairs, rate.call_rate, rate.cpu_rate
            );
        }
        text
    }
}

/// Puts the tables between the marks of BENCHMARKS.md.
pub fn write(text: &str) -> Result<(), String> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../BENCHMARKS.md");
    let told = |why: std::io::Error| format!("{}: {why}", path.display());
    let whole = std::fs::read_to_string(&path).map_err(told)?;
    let [start, end] = MARKS.map(|mark| whole.find(mark));
    let (Some(start), Some(end)) = (start, end) else {
        return Err(format!("{}: without the marks {MARKS:?}", path.display()));
    };
    let (before, after) = (&whole[..start + MARKS[0].len()], &whole[end..]);
    std::fs::write(&path, format!("{before}\n{text}{after}")).map_err(told)
}
