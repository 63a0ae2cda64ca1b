//! Reads a table of boxes, or says everything that is wrong with it.
use geograd::Obb2;
use geograd::kernels::real::Real;
use std::path::Path;
use std::str::FromStr;

/// The columns, in order.
const COLUMNS: [&str; 5] = ["x", "y", "w", "h", "r"];

/// Bad rows told one by one; of the rest only the number.
const TOLD: usize = 10;

/// The boxes of a file, or a message that names the file, each bad row and what is wrong with it.
pub fn read<T: Real + FromStr>(path: &Path, option: &str) -> Result<Vec<Obb2<T>>, String> {
    let name = path.display();
    let bytes = std::fs::read(path).map_err(|error| format!("{name} ({option}): {error}"))?;
    // A byte that is no UTF-8 becomes a character that is no number, so its row is told like any.
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text).trim_end();
    let mut lines = text.lines().enumerate().peekable();
    match lines.peek().map(|(_, line)| header(line)) {
        Some(Ok(true)) => drop(lines.next()),
        Some(Ok(false)) | None => {}
        Some(Err(why)) => return Err(format!("{name}: header (line 1): {why}")),
    }
    let mut boxes = Vec::new();
    let (mut wrong, mut more) = (Vec::new(), 0);
    for (row, (line, text)) in lines.enumerate() {
        match parse(text) {
            Ok(shape) => boxes.push(shape),
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
        return Ok(boxes);
    }
    if more > 0 {
        wrong.push(format!("{name}: and {more} more bad rows"));
    }
    Err(wrong.join("\n"))
}

/// Whether the first line is a header: no field of it is a number.
///
/// One that names the five columns in another order is an error, because reading on would mix them
/// up.
fn header(line: &str) -> Result<bool, String> {
    let mut names: Vec<String> = line.split(',').map(|f| f.trim().to_lowercase()).collect();
    if line.trim().is_empty() || names.iter().any(|name| name.parse::<f64>().is_ok()) {
        return Ok(false);
    }
    if names.len() != COLUMNS.len() {
        return Err(format!("{} names where x,y,w,h,r is needed", names.len()));
    }
    if names == COLUMNS {
        return Ok(true);
    }
    names.sort();
    let mut sorted = COLUMNS;
    sorted.sort_unstable();
    if names == sorted {
        return Err(format!("`{}`: the order must be x,y,w,h,r", line.trim()));
    }
    Ok(true)
}

fn parse<T: Real + FromStr>(line: &str) -> Result<Obb2<T>, String> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    if line.trim().is_empty() {
        return Err("is empty".into());
    }
    if fields.len() != COLUMNS.len() {
        return Err(format!("{} fields where x,y,w,h,r is needed", fields.len()));
    }
    let mut numbers = [T::default(); 5];
    for ((number, column), field) in numbers.iter_mut().zip(COLUMNS).zip(&fields) {
        *number = field
            .parse()
            .map_err(|_| format!("{column} is not a number: `{field}`"))?;
        // Numbers beyond the format's range read as infinite.
        if !number.widen().is_finite() {
            return Err(format!("{column} is not finite: `{field}`"));
        }
        if (column == "w" || column == "h") && *number < T::default() {
            return Err(format!("{column} is negative: `{field}`"));
        }
    }
    let [x, y, w, h, r] = numbers;
    Ok(Obb2::new(x, y, w, h, r))
}
