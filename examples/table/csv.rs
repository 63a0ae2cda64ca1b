//! Rows of CSV as numbers.
use crate::block::{Block, Key};
use crate::number::Number;
use common::cli::Failure;
use common::csv::{Reader, Record, number};
use geograd::Error;
use geograd::kernels::dynamic::Layout;

/// A file, and the places of the columns that are wanted in it.
pub struct Table {
    reader: Reader,
    /// The names of all columns.
    pub names: Vec<String>,
    row: usize,
}

impl Table {
    /// A file whose first row is a header.
    pub fn new(mut reader: Reader) -> Result<Self, Failure> {
        let names = reader
            .row()?
            .map(|header| header.fields().map(str::to_owned).collect());
        match names {
            Some(names) => Ok(Table {
                reader,
                names,
                row: 0,
            }),
            None => Err(Failure::Work(format!(
                "{}: it has no header",
                reader.name()
            ))),
        }
    }

    /// The next rows, at most so many: the numbers of a shape in some columns and the group of each, checked. `None` at
    /// the end.
    pub fn next<T: Number>(
        &mut self,
        most: usize,
        layout: Layout<T>,
        columns: &[usize],
        group: Option<usize>,
    ) -> Result<Option<Block<T>>, Failure> {
        let mut block = Block {
            numbers: Vec::new(),
            keys: Vec::new(),
        };
        let first = self.row;
        while self.row - first < most {
            let Some(record) = self.reader.row()? else {
                break;
            };
            if let Err(why) = add(&mut block, record, &self.names, layout, columns, group) {
                let (row, line) = (self.row, record.line);
                let name = self.reader.name();
                return Err(Failure::Work(format!(
                    "{name}: row {row} (line {line}): {why}"
                )));
            }
            self.row += 1;
        }
        Ok((self.row > first).then_some(block))
    }
}

/// Adds a row to a block, or says the flaw of the row.
fn add<T: Number>(
    block: &mut Block<T>,
    record: &Record,
    names: &[String],
    layout: Layout<T>,
    columns: &[usize],
    group: Option<usize>,
) -> Result<(), String> {
    if record.is_empty() {
        return Err("is empty".to_owned());
    }
    if record.count() != names.len() {
        let (found, needed) = (record.count(), names.len());
        return Err(format!("{found} fields where the header has {needed}"));
    }
    let begin = block.numbers.len();
    let field = |column: usize| match record.field(column) {
        Some("") | None => Err(format!("{} is empty", names[column])),
        Some(field) => Ok(field),
    };
    for &column in columns {
        block.numbers.push(number(field(column)?, &names[column])?);
    }
    if let Err(Error::Invalid { flaw, .. }) = layout.check(&block.numbers[begin..]) {
        return Err(flaw.to_string());
    }
    if let Some(column) = group {
        let text = field(column)?;
        // CSV does not say which columns are numbers.
        let number = text.parse().map(Key::Number);
        block
            .keys
            .push(number.unwrap_or_else(|_| Key::Text(text.to_owned())));
    }
    Ok(())
}
