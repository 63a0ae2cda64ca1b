//! Public reports of wrong or doubted results of other geometry libraries, as a table: the input, the right value by an
//! independent source, and what geograd answers. `README.md` beside this file is that table.
//!
//! Inputs are those of the threads, or of the kind that a thread without numbers describes. Right values are never
//! taken from a thread.
#![expect(
    clippy::excessive_precision,
    clippy::inconsistent_digit_grouping,
    clippy::approx_constant,
    reason = "numbers as the reports give them"
)]
use std::fmt::Write;

mod boxes;
mod cameras;
mod detection;
mod hits;
mod measures;
mod plane;
mod polygons;
mod rotations;
mod solid_boxes;
mod space;
mod triangles;

/// A report and the check of geograd's answer.
pub struct Report {
    /// Owner and name of the repository that has the thread.
    pub library: &'static str,
    /// The number of the issue or pull request.
    pub number: u32,
    /// What went wrong there.
    pub about: &'static str,
    /// What is computed here.
    pub asked: &'static str,
    /// Where the right value comes from.
    pub source: &'static str,
    /// The answer of geograd.
    pub found: fn() -> Vec<f64>,
    /// The right answer.
    pub right: fn() -> Vec<f64>,
    /// The largest difference of a number from the right one; 0 asks for the same bits.
    pub within: f64,
}

impl Report {
    /// What is wrong with the answer, if something is.
    fn fault(&self) -> Option<String> {
        let (found, right) = ((self.found)(), (self.right)());
        let close = |(x, y): (&f64, &f64)| (x - y).abs() <= self.within;
        let holds = found.len() == right.len() && found.iter().zip(&right).all(close);
        (!holds).then(|| {
            format!(
                "{}#{}: {}: {found:?}, right {right:?}",
                self.library, self.number, self.asked
            )
        })
    }
}

/// The reports of a field, by its name.
fn fields() -> [(&'static str, Vec<Report>); 11] {
    [
        ("Boxes in the plane", boxes::reports()),
        ("Boxes in space", solid_boxes::reports()),
        ("Distances and hits in the plane", plane::reports()),
        ("Circles, rectangles, hulls, centroids", measures::reports()),
        ("Polygons", polygons::reports()),
        ("Distances and contacts in space", space::reports()),
        ("Points and triangles in space", triangles::reports()),
        ("Hits and inertia in space", hits::reports()),
        ("Detection", detection::reports()),
        ("Rotations", rotations::reports()),
        ("Cameras and conventions", cameras::reports()),
    ]
}

/// A flag as a number.
fn flag(is: bool) -> f64 {
    if is { 1.0 } else { 0.0 }
}

/// A number to six digits.
fn shown(x: f64) -> String {
    if x == 0.0 || x.fract() == 0.0 && x.abs() < 1e9 {
        return format!("{}", x + 0.0);
    }
    if !(1e-3..1e9).contains(&x.abs()) {
        return format!("{x:.3e}");
    }
    let whole = (x.abs().log10().floor().max(0.0) as usize).min(6);
    let text = format!("{x:.*}", 6 - whole.min(5));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn table() -> String {
    let fields = fields();
    let count: usize = fields.iter().map(|(_, reports)| reports.len()).sum();
    let mut text = format!(
        "# Public reports of other geometry libraries\n\n\
         {count} reports of wrong or doubted results, each a test: geograd's answer to the same input, against a right\n\
         value from an independent source. Where a thread gives no numbers, the input is of the kind that it describes.\n\
         Numbers are shown to six digits, those below the tolerance of their test as 0; 1 and 0 also stand for yes and\n\
         no. `GEOGRAD_WRITE_TABLES=1 cargo test -p geograd-tests --test geometry reports` writes this page.\n"
    );
    for (name, reports) in &fields {
        write!(
            text,
            "\n## {name}\n\n| report | there | asked here | right value | geograd | source of the right value |\n"
        )
        .unwrap();
        text.push_str("| --- | --- | --- | --- | --- | --- |\n");
        for report in reports {
            let to = |x: f64| if x.abs() <= report.within { 0.0 } else { x };
            let list = |numbers: Vec<f64>| {
                let texts: Vec<String> = numbers.into_iter().map(|x| shown(to(x))).collect();
                texts.join(", ")
            };
            let (right, found) = (list((report.right)()), list((report.found)()));
            let (library, number) = (report.library, report.number);
            writeln!(
                text,
                "| [{library} {number}](https://github.com/{library}/issues/{number}) | {} | {} | {right} | {found} | {} |",
                report.about, report.asked, report.source
            )
            .unwrap();
        }
    }
    text
}

#[test]
fn answers_to_reports_are_right() {
    let faults: Vec<String> = fields()
        .iter()
        .flat_map(|(_, reports)| reports.iter().filter_map(Report::fault))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_report_has_one_number() {
    let mut seen = std::collections::HashSet::new();
    for (_, reports) in fields() {
        for report in reports {
            let name = (report.library, report.number, report.asked);
            assert!(seen.insert(name), "{name:?} is there twice");
        }
    }
}

#[test]
fn the_page_of_reports_is_that_of_the_tests() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/geometry/reports/README.md");
    let found = std::fs::read_to_string(path).unwrap_or_default();
    let expected = table();
    if found != expected && std::env::var_os("GEOGRAD_WRITE_TABLES").is_some() {
        std::fs::write(path, &expected).unwrap();
        return;
    }
    assert!(
        found == expected,
        "GEOGRAD_WRITE_TABLES=1 writes the file anew"
    );
}
