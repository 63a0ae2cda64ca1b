//! Reads a table of shapes, or says everything that is wrong with it.
use crate::options::PROGRAM;
use common::cli::Failure;
use common::csv::{self, Reader, Record};
use std::path::Path;
use std::str::FromStr;

/// Bad rows told one by one; of the rest only the number.
const TOLD: usize = 10;

/// A shape that a row of a table is.
pub trait Shape: Sized {
    /// `true` if names are a header of such a table; `Err` for one that would mix the columns up.
    fn is_header(names: &[String]) -> Result<bool, String>;
    /// The shape of the fields of a row.
    fn parse(fields: &[&str]) -> Result<Self, String>;
}

/// The shapes of a file, or a message that names the file, each bad row and what is wrong with it.
pub fn read<P: Shape>(path: &Path, option: &str) -> Result<Vec<P>, String> {
    let name = path.display();
    let told = |failure| match failure {
        Failure::Work(why) | Failure::Usage(why) => why.replacen(':', &format!(" ({option}):"), 1),
    };
    let mut reader = Reader::open(path, PROGRAM).map_err(told)?;
    let is_header = reader.peek().map_or(Ok(false), is_header::<P>);
    if is_header.map_err(|why| format!("{name}: header (line 1): {why}"))? {
        reader.row().map_err(told)?;
    }
    let (mut shapes, mut wrong, mut more) = (Vec::new(), Vec::new(), 0);
    while let Some(record) = reader.row().map_err(told)? {
        let row = shapes.len() + wrong.len() + more + 1;
        let parsed = match record.is_empty() {
            true => Err("is empty".into()),
            false => P::parse(&record.fields().collect::<Vec<_>>()),
        };
        match parsed {
            Ok(shape) => shapes.push(shape),
            Err(why) if wrong.len() < TOLD => {
                wrong.push(format!("{name}: row {row} (line {}): {why}", record.line));
            }
            Err(_) => more += 1,
        }
    }
    reader.bar.finish_and_clear();
    if wrong.is_empty() {
        return Ok(shapes);
    }
    if more > 0 {
        wrong.push(format!("{name}: and {more} more bad rows"));
    }
    Err(wrong.join("\n"))
}

/// `true` if the first row is a header: no field of it is a number.
fn is_header<P: Shape>(first: &Record) -> Result<bool, String> {
    let names: Vec<String> = first.fields().map(str::to_lowercase).collect();
    let is_number = |name: &String| name.parse::<f64>().is_ok();
    Ok(!names.iter().any(is_number) && P::is_header(&names)?)
}

/// `true` if names are a header of these columns. A header in another order is an error,
/// because reading on would mix them up.
pub fn names_columns(names: &[String], columns: &[&str]) -> Result<bool, String> {
    let wanted = columns.join(",");
    if names.len() != columns.len() {
        return Err(format!("{} names where {wanted} is needed", names.len()));
    }
    if names == columns {
        return Ok(true);
    }
    let (mut sorted, mut known) = (names.to_vec(), columns.to_vec());
    sorted.sort();
    known.sort_unstable();
    if sorted == known {
        let line = names.join(",");
        return Err(format!("`{line}`: the order must be {wanted}"));
    }
    Ok(true)
}

/// A finite number, or what is wrong with the field of that column.
pub fn number<T: FromStr + Into<f64> + Copy>(field: &str, column: &str) -> Result<T, String> {
    let number: T = csv::number(field, column)?;
    // Numbers beyond the format's range read as infinite.
    if !number.into().is_finite() {
        return Err(format!("{column} is not finite: `{field}`"));
    }
    Ok(number)
}
