//! Files of comma-separated values: rows in, one after another, and rows out, as text that all cores make.
use crate::failure::Failure;
use crate::output::Output;
use crate::progress;
use ::csv::{ReaderBuilder, StringRecord, Terminator};
use indicatif::ProgressBar;
use std::fmt::{Debug, Write as _};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::str::FromStr;

/// Rows turned into text at a time by one thread.
const STRETCH: usize = 1 << 14;

/// A row of a file.
#[derive(Clone, Debug, Default)]
pub struct Record {
    fields: StringRecord,
    /// The line on which it begins, from 1.
    pub line: u64,
}

/// A field without the spaces around it. Quotes after a space, which other programs write, are text to the crate.
fn plain(field: &str) -> &str {
    let inner = field.trim();
    let quoted = inner.strip_prefix('"').and_then(|x| x.strip_suffix('"'));
    match quoted {
        Some(quoted) if !field.starts_with('"') => quoted,
        _ => inner,
    }
}

impl Record {
    /// The fields.
    pub fn fields(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().map(plain)
    }
    /// The field of a column.
    pub fn field(&self, column: usize) -> Option<&str> {
        self.fields.get(column).map(plain)
    }
    /// How many fields it has.
    pub fn count(&self) -> usize {
        self.fields.len()
    }
    /// `true` if it is a line of spaces.
    pub fn is_empty(&self) -> bool {
        self.count() < 2 && self.fields.as_slice().trim().is_empty()
    }
}

/// The rows of a file, read when they are asked for. Empty lines at its end are no rows.
pub struct Reader {
    name: String,
    rows: ::csv::Reader<Box<dyn Read>>,
    /// Empty lines that come before `ahead`.
    empty: u64,
    ahead: Option<Record>,
    now: Record,
    /// Grows with the bytes that are read.
    pub bar: ProgressBar,
}

impl Reader {
    /// Opens a file, with a bar that a program shows where stderr is a terminal.
    ///
    /// # Errors
    ///
    /// A file that cannot be opened or read.
    pub fn open(path: &Path, program: &str) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let failed = |error: io::Error| Failure::Work(format!("{name}: {error}"));
        let file = File::open(path).map_err(failed)?;
        let bar = progress::bar(program, file.metadata().map_err(failed)?.len());
        // A line break at the end: every row has one, which the count of lines takes for granted.
        let bytes: Box<dyn Read> = Box::new(bar.wrap_read(file).chain(&b"\n"[..]));
        let rows = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            // The crate counts lines right for this byte alone; the other one of a line break is space around a field.
            .terminator(Terminator::Any(b'\n'))
            .buffer_capacity(1 << 16)
            .from_reader(bytes);
        let mut reader = Reader {
            name,
            rows,
            empty: 0,
            ahead: None,
            now: Record::default(),
            bar,
        };
        reader.look()?;
        Ok(reader)
    }
    /// The name of the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Reads the next row that is not empty, if there is one.
    fn look(&mut self) -> Result<(), Failure> {
        let next = self.rows.position().line();
        let mut record = self.ahead.take().unwrap_or_default();
        loop {
            let start = self.rows.position().line();
            let mut bytes = record.fields.into_byte_record();
            let is_there = self.rows.read_byte_record(&mut bytes);
            if !is_there.map_err(|error| Failure::Work(format!("{}: {error}", self.name)))? {
                return Ok(());
            }
            // A byte that is no UTF-8 becomes a character that is no number, so that its row is told.
            record.fields = StringRecord::from_byte_record_lossy(bytes);
            let breaks = record.fields.as_slice().matches('\n').count() as u64;
            // The crate passes over empty lines. A quote that never ends has no line break after it.
            record.line = start.max(self.rows.position().line() - breaks - 1);
            if !record.is_empty() {
                break;
            }
        }
        (self.empty, self.ahead) = (record.line - next, Some(record));
        Ok(())
    }

    /// The first row that waits, without taking it; an empty line is an empty row.
    pub fn peek(&self) -> Option<&Record> {
        self.ahead.as_ref().filter(|_| self.empty == 0)
    }

    /// The next row, and `None` at the end.
    ///
    /// # Errors
    ///
    /// A file that cannot be read.
    pub fn row(&mut self) -> Result<Option<&Record>, Failure> {
        let Some(ahead) = &mut self.ahead else {
            return Ok(None);
        };
        if self.empty > 0 {
            self.now.fields.clear();
            self.now.line = ahead.line - self.empty;
            self.empty -= 1;
        } else {
            std::mem::swap(&mut self.now, ahead);
            self.look()?;
        }
        Ok(Some(&self.now))
    }
}

/// The number in a field, or the flaw of the field of that column.
///
/// # Errors
///
/// Text that is no number.
pub fn number<T: FromStr>(field: &str, column: &str) -> Result<T, String> {
    let number = field.parse();
    number.map_err(|_| format!("{column} is not a number: `{field}`"))
}

/// Rows of an output, below a header.
pub struct Writer {
    output: Output,
    /// The text before the first row. It is written with that row or at the end, so that a job that fails
    /// before writes nothing.
    header: String,
}

impl Writer {
    /// Rows with these columns.
    #[must_use]
    pub fn new<N: AsRef<str>>(output: Output, columns: &[N]) -> Self {
        let names: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
        Writer {
            output,
            header: names.join(",") + "\n",
        }
    }

    /// That many rows; each writes its fields.
    ///
    /// # Errors
    ///
    /// An output that cannot be written.
    pub fn rows(
        &mut self,
        count: usize,
        row: impl Fn(usize, &mut Fields<'_>) + Sync,
    ) -> Result<(), Failure> {
        let text = |start: usize| {
            let mut text = String::new();
            for i in start..count.min(start + STRETCH) {
                row(
                    i,
                    &mut Fields {
                        text: &mut text,
                        any: false,
                    },
                );
                text.push('\n');
            }
            text
        };
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        for round in (0..count).step_by(STRETCH * threads) {
            let starts = (round..count).step_by(STRETCH).take(threads);
            let texts: Vec<String> = std::thread::scope(|scope| {
                let workers: Vec<_> = starts
                    .map(|start| scope.spawn(move || text(start)))
                    .collect();
                let texts = workers.into_iter().map(|worker| worker.join());
                texts
                    .map(|text| text.expect("turning numbers into text cannot fail"))
                    .collect()
            });
            for text in texts {
                self.text(&text)?;
            }
        }
        Ok(())
    }

    fn text(&mut self, text: &str) -> Result<(), Failure> {
        let header = std::mem::take(&mut self.header);
        self.output.text(&header)?;
        self.output.text(text)
    }
    /// `true` if the reader has closed the output: the rest need not be written.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.output.is_closed()
    }

    /// Gives the result its name.
    ///
    /// # Errors
    ///
    /// An output that cannot be written or named.
    pub fn finish(mut self) -> Result<(), Failure> {
        // Without any rows this is where the header goes.
        self.text("")?;
        self.output.finish()
    }
}

/// The fields of a row.
pub struct Fields<'a> {
    text: &'a mut String,
    /// `true` if there is one already.
    any: bool,
}

impl Fields<'_> {
    /// One more number.
    pub fn number<T: Debug>(&mut self, x: T) {
        self.empty();
        shortest(self.text, &x);
    }
    /// One more field, without anything in it.
    pub fn empty(&mut self) {
        if self.any {
            self.text.push(',');
        }
        self.any = true;
    }
}

/// The shortest text that reads back as the same number; zero without its sign.
fn shortest<T: Debug>(text: &mut String, x: &T) {
    let start = text.len();
    let _ = write!(text, "{x:?}");
    match &text[start..] {
        "-0.0" | "0.0" => text.replace_range(start.., "0"),
        whole if whole.ends_with(".0") => text.truncate(text.len() - 2),
        _ => {}
    }
}
