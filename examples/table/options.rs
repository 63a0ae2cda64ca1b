//! The command line, and the row of the verb that it means.
use common::cli::{Failure, Wish, is_double, usage};
use common::file;
use geograd::kernels::dynamic::{Operation, Sort};
use std::path::PathBuf;

pub const HELP: &str = "\
Any verb of geograd on tables: CSV or Parquet in, CSV or Parquet out.

Usage: table --verb VERB --a SHAPE:FILE [--b SHAPE:FILE] [--c ...] [--d ...] [options]

  --verb VERB              iou, signed_distance, area, ...; `--verb list` prints all with their shapes
  --a SHAPE:FILE, ...      the arguments in order: obb3:boxes.parquet, number:lengths.csv. Columns have the names of
                           the shape's fields, which `--verb list` prints. CSV has a header.
  --column-a NAME, ...     the column of lists or structs with the shape, or what comes before a point in the names
                           of its columns: box, for box.x and box.y
  --all-pairs              every row of A with every row of B, row by row. Without it row i goes with row i.
  --group COLUMN           every row of A with every row of B that has the same value in a column; both files are in
                           ascending order of it
  --above T                only results above T
  --grad                   also the derivatives by every number of the arguments; of results of one number
  --to SHAPE               the shape of the result, where a verb gives several
  --precision f32|f64      the format to compute in [default: f64]
  --backend cpu|gpu|auto   the machine to compute on [default: cpu]. A GPU needs a build with `--features gpu`
                           and --precision f32.
  --out FILE               the result, by its name Parquet or CSV [default: CSV to standard output]
  --help                   this text

Results have the columns a_row and b_row for pairs, row for single rows with --above, the verb's name (with the field,
of shapes), and with --grad VERB_by_a.FIELD and so on. Rows count from 0.

Memory holds a block of either file, or a group where that is larger; --all-pairs holds all of B.

Exit status: 0 when all went well; 1 for a bad row, a file that cannot be read or written, or a GPU that fails; 2 for a
wrong command line. On failure --out is as it was.
";

/// The letters of the arguments.
pub const LETTERS: [&str; 4] = ["a", "b", "c", "d"];

/// The rows that go together.
#[derive(Debug)]
pub enum Which {
    /// Row i of every file.
    Aligned,
    /// Every row of A with every row of B.
    AllPairs,
    /// The same within groups of one value in this column.
    Groups(String),
}

/// A file of one argument.
#[derive(Debug)]
pub struct Input {
    pub path: PathBuf,
    pub column: Option<String>,
}

#[derive(Debug)]
pub struct Options {
    pub operation: &'static Operation,
    pub inputs: Vec<Input>,
    pub which: Which,
    pub grad: bool,
    pub double: bool,
    pub above: Option<f64>,
    pub wish: Wish,
    pub out: Option<PathBuf>,
}

/// The wish of a command line.
#[derive(Debug)]
pub enum Asked {
    Work(Options),
    Help,
    List,
}

pub fn options() -> Result<Asked, Failure> {
    use lexopt::prelude::*;
    let (mut verb, mut to, mut group, mut above, mut out) = (None, None, None, None, None);
    let mut files: [Option<(String, PathBuf)>; 4] = Default::default();
    let mut columns: [Option<String>; 4] = Default::default();
    let (mut all_pairs, mut grad, mut double, mut wish) = (false, false, true, Wish::Cpu);
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        let letter = |name: &str| LETTERS.iter().position(|&letter| letter == name);
        match argument {
            Long("verb") => verb = Some(parser.value()?.string()?),
            Long("to") => to = Some(parser.value()?.string()?.to_lowercase()),
            Long("group") => group = Some(parser.value()?.string()?),
            Long("above") => above = Some(parser.value()?.parse::<f64>()?),
            Long("out") => out = Some(PathBuf::from(parser.value()?)),
            Long("all-pairs") => all_pairs = true,
            Long("grad") => grad = true,
            Long("backend") => wish = Wish::from_name(&parser.value()?.string()?)?,
            Long("precision") => double = is_double(&parser.value()?.string()?)?,
            Long("help") | Short('h') => return Ok(Asked::Help),
            Long(name) if letter(name).is_some() => {
                let (k, name) = (letter(name).unwrap_or(0), name.to_owned());
                let text = parser.value()?.string()?;
                let Some((shape, path)) = text.split_once(':') else {
                    return usage(format!("`--{name} {text}`: it is SHAPE:FILE"));
                };
                files[k] = Some((shape.to_lowercase(), path.into()));
            }
            Long(name) if name.strip_prefix("column-").and_then(letter).is_some() => {
                let k = name.strip_prefix("column-").and_then(letter).unwrap_or(0);
                columns[k] = Some(parser.value()?.string()?);
            }
            _ => return Err(argument.unexpected().into()),
        }
    }
    let Some(verb) = verb else {
        return usage("`--verb` is missing");
    };
    if verb == "list" {
        return Ok(Asked::List);
    }
    let count = files.iter().take_while(|file| file.is_some()).count();
    if let Some(k) = (count..4).find(|&k| files[k].is_some() || columns[k].is_some()) {
        return usage(format!("`--{}` is missing", LETTERS[count.min(k)]));
    }
    let (shapes, paths): (Vec<_>, Vec<_>) = files.into_iter().flatten().unzip();
    let operation = operation(&verb, &shapes, to.as_deref())?;
    let inputs = paths.into_iter().zip(columns);
    let inputs: Vec<_> = inputs
        .map(|(path, column)| Input { path, column })
        .collect();
    let which = match (all_pairs, group) {
        (true, Some(_)) => return usage("`--all-pairs` and `--group` exclude one another"),
        (true, None) => Which::AllPairs,
        (false, Some(column)) => Which::Groups(column),
        (false, None) => Which::Aligned,
    };
    if !matches!(which, Which::Aligned) && inputs.len() != 2 {
        return usage(format!(
            "pairs need two arguments; {verb} of these shapes takes {}",
            inputs.len()
        ));
    }
    let numbers: usize = operation
        .result()
        .iter()
        .map(|shape| shape.fields.len())
        .sum();
    if (grad || above.is_some()) && numbers != 1 {
        return usage(format!(
            "`--grad` and `--above` are for results of one number; {verb} gives {numbers}"
        ));
    }
    if above.is_some_and(|threshold| !threshold.is_finite()) {
        return usage("`--above` needs a finite number");
    }
    if let Some(out) = &out
        && inputs.iter().any(|input| file::same(&input.path, out))
    {
        return usage("`--out` is an input as well");
    }
    Ok(Asked::Work(Options {
        operation,
        inputs,
        which,
        grad,
        double,
        above,
        wish,
        out,
    }))
}

/// Rows of fixed size, which tables hold.
fn fixed() -> impl Iterator<Item = &'static Operation> {
    let all = geograd_rows::operations().iter();
    all.filter(|row| matches!(row.sort, Sort::Straight | Sort::Search))
}

fn shapes_of(row: &Operation) -> Vec<String> {
    let arguments = row.arguments().into_iter();
    arguments
        .map(|argument| argument.shape.name.to_lowercase())
        .collect()
}

/// The row of a verb that takes these shapes.
fn operation(
    verb: &str,
    shapes: &[String],
    to: Option<&str>,
) -> Result<&'static Operation, Failure> {
    let rows: Vec<_> = fixed().filter(|row| row.verb() == verb).collect();
    if rows.is_empty() {
        return usage(format!(
            "no verb is called {verb} and takes shapes of fixed size: see `--verb list`"
        ));
    }
    let gives = |row: &&&Operation| {
        let result = row.result();
        to.is_none_or(|to| result.len() == 1 && result[0].name.to_lowercase() == to)
    };
    let own: Vec<_> = rows
        .iter()
        .filter(|row| shapes_of(row) == shapes)
        .filter(gives)
        .collect();
    match own[..] {
        [row] => Ok(row),
        [] => {
            let mut known: Vec<_> = rows.iter().map(|row| shapes_of(row).join(" ")).collect();
            known.dedup();
            usage(format!(
                "{verb} of {} is not there; it takes\n  {}",
                shapes.join(" "),
                known.join("\n  ")
            ))
        }
        _ => {
            let results: Vec<_> = own
                .iter()
                .map(|row| row.result()[0].name.to_lowercase())
                .collect();
            usage(format!(
                "{verb} gives several shapes; choose by `--to`: {}",
                results.join(", ")
            ))
        }
    }
}

/// All verbs with their shapes, and all shapes with their fields.
pub fn list() -> String {
    let (mut verbs, mut shapes) = (Vec::new(), Vec::new());
    for row in fixed() {
        verbs.push(format!("{} {}", row.verb(), shapes_of(row).join(" ")));
        for argument in row.arguments() {
            let fields = argument.shape.fields.iter();
            let fields: Vec<_> = fields.map(|field| field.name.to_string()).collect();
            shapes.push(format!(
                "{}: {}",
                argument.shape.name.to_lowercase(),
                fields.join(", ")
            ));
        }
    }
    verbs.sort();
    verbs.dedup();
    shapes.sort();
    shapes.dedup();
    format!(
        "Verbs and what they take:\n{}\n\nShapes and their fields:\n{}\n",
        verbs.join("\n"),
        shapes.join("\n")
    )
}
