//! A [`Report`] as JSON, for programs that read it.
use crate::ad::check::report::Report;
use crate::ad::check::verdict::{Fault, PAIRS};
use std::fmt::Write;

impl Report {
    /// Returns the whole report as one JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        let mut out = String::new();
        let _ = write!(
            out,
            "{{\"name\":{},\"precision\":\"{:?}\",\"seed\":{},\"passed\":{},\"samples\":{},\
             \"outside\":{},\"smooth\":{},\"kink\":{},\"undefined\":{},\"conventions\":{},\"jumps\":{},\
             \"directions\":{{\"smooth\":{},\"kink\":{},\"undefined\":{},\"switched\":{}}},\
             \"smallest_margin\":{},\"refused\":{},\"pairs\":[",
            quoted(&self.name),
            self.precision,
            self.seed,
            self.passed(),
            self.samples,
            self.outside,
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
                worst.nearest.perturbed,
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
            let lengths = numbers.lengths.map_or("null".to_owned(), |[got, wanted]| {
                format!("[{got},{wanted}]")
            });
            let optional = |x: Option<f64>| x.map_or("null".to_owned(), json_number);
            let list: Vec<String> = failure.input.iter().map(|&x| json_number(x)).collect();
            let _ = write!(
                out,
                "{}{{\"reason\":{},\"suspect\":{},\"sample\":{},\"output\":{output},\
                 \"input\":{input},\"along_direction\":{},\"adjoint\":{},\"dual\":{},\"difference\":{},\"other\":{},\
                 \"lengths\":{lengths},\"tolerance\":{},\"at\":[{}],\"code\":{}}}",
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

/// Returns a number as JSON, which knows no infinity.
fn json_number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:?}")
    } else {
        "null".to_owned()
    }
}

/// Returns a string as JSON.
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
