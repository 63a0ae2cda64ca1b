//! Reads a table of shapes, or says everything that is wrong with it.
use std::path::Path;
use std::str::FromStr;

/// Bad rows told one by one; of the rest only the number.
const TOLD: usize = 10;

/// A shape that a row of a table is.
pub trait Shape: Sized {
    /// `true` if names are a header of such a table; `Err` for one that would mix the columns up.
    fn is_header(names: &[String], line: &str) -> Result<bool, String>;
    /// The shape of the fields of a row.
    fn parse(fields: &[&str]) -> Result<Self, String>;
}

/// The shapes of a file, or a message that names the file, each bad row and what is wrong with it.
pub fn read<P: Shape>(path: &Path, option: &str) -> Result<Vec<P>, String> {
    let name = path.display();
    let bytes = std::fs::read(path).map_err(|error| format!("{name} ({option}): {error}"))?;
    // A byte that is no UTF-8 becomes a character that is no number, so its row is told like any.
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text).trim_end();
    let mut lines = text.lines().enumerate().peekable();
    match lines.peek().map(|(_, line)| header::<P>(line)) {
        Some(Ok(true)) => drop(lines.next()),
        Some(Ok(false)) | None => {}
        Some(Err(why)) => return Err(format!("{name}: header (line 1): {why}")),
    }
    let mut shapes = Vec::new();
    let (mut wrong, mut more) = (Vec::new(), 0);
    for (row, (line, text)) in lines.enumerate() {
        match parse(text) {
            Ok(shape) => shapes.push(shape),
            Err(why) if wrong.len() < TOLD => {
                wrong.push(format!(
                    "{name}: row {} (line {}): {why}",
                    row + 1,
                    line + 1
                ));
            }
            Err(_) => more += 1,
        }
    }
    if wrong.is_empty() {
        return Ok(shapes);
    }
    if more > 0 {
        wrong.push(format!("{name}: and {more} more bad rows"));
    }
    Err(wrong.join("\n"))
}

/// `true` if the first line is a header: no field of it is a number.
fn header<P: Shape>(line: &str) -> Result<bool, String> {
    let names: Vec<String> = line.split(',').map(|f| f.trim().to_lowercase()).collect();
    if line.trim().is_empty() || names.iter().any(|name| name.parse::<f64>().is_ok()) {
        return Ok(false);
    }
    P::is_header(&names, line.trim())
}

fn parse<P: Shape>(line: &str) -> Result<P, String> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    if line.trim().is_empty() {
        return Err("is empty".into());
    }
    P::parse(&fields)
}

/// `true` if names are a header of these columns. A header in another order is an error,
/// because reading on would mix them up.
pub fn names_columns(names: &[String], columns: &[&str], line: &str) -> Result<bool, String> {
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
        return Err(format!("`{line}`: the order must be {wanted}"));
    }
    Ok(true)
}

/// A finite number, or what is wrong with the field of that column.
pub fn number<T: FromStr + Into<f64> + Copy>(field: &str, column: &str) -> Result<T, String> {
    let number: T = field
        .parse()
        .map_err(|_| format!("{column} is not a number: `{field}`"))?;
    // Numbers beyond the format's range read as infinite.
    if !number.into().is_finite() {
        return Err(format!("{column} is not finite: `{field}`"));
    }
    Ok(number)
}
