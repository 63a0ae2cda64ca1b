//! Files of comma-separated values: rows in, one after another, and rows out, as text that all cores make.
use crate::failure::Failure;
use crate::output::Output;
use crate::progress;
use indicatif::ProgressBar;
use std::fmt::{Debug, Write as _};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::str::FromStr;

/// Rows turned into text at a time by one thread.
const STRETCH: usize = 1 << 14;

/// Bytes after which a row ends though its quotes do not.
const LONGEST: usize = 1 << 20;

/// A file whose bytes move a bar.
struct Watched {
    file: File,
    bar: ProgressBar,
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.bar.inc(count as u64);
        Ok(count)
    }
}

/// A row of a file.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// The fields, one after another, without quotes and the spaces around them.
    text: String,
    ends: Vec<usize>,
    /// The line on which it begins, from 1.
    pub line: usize,
}

impl Record {
    /// The fields.
    pub fn fields(&self) -> impl Iterator<Item = &str> + Clone {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.text[start..end])
    }
    /// How many fields it has.
    pub fn count(&self) -> usize {
        self.ends.len()
    }
    /// `true` if it is a line of spaces.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty() && self.ends.len() < 2
    }

    /// Splits a line. A field in quotes may have commas, and quotes as two quotes.
    fn split(&mut self, line: &str, number: usize) {
        self.text.clear();
        self.ends.clear();
        self.line = number;
        let mut rest = line;
        loop {
            let field = rest.trim_start();
            let (length, after) = match field.strip_prefix('"') {
                None => {
                    let end = field.find(',').unwrap_or(field.len());
                    self.text.push_str(field[..end].trim_end());
                    (end, field)
                }
                Some(mut quoted) => {
                    loop {
                        let end = quoted.find('"').unwrap_or(quoted.len());
                        self.text.push_str(&quoted[..end]);
                        quoted = quoted.get(end + 1..).unwrap_or_default();
                        match quoted.strip_prefix('"') {
                            Some(more) => quoted = more,
                            None => break,
                        }
                        self.text.push('"');
                    }
                    (quoted.find(',').unwrap_or(quoted.len()), quoted)
                }
            };
            self.ends.push(self.text.len());
            match after.get(length + 1..) {
                Some(more) => rest = more,
                None => break,
            }
        }
    }
}

/// The rows of a file, read when they are asked for. Empty lines at its end are no rows.
pub struct Reader {
    name: String,
    lines: BufReader<Watched>,
    bytes: Vec<u8>,
    /// Lines that were read.
    line: usize,
    /// Empty lines that come before `ahead`.
    empty: usize,
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
        let watched = Watched {
            file,
            bar: bar.clone(),
        };
        let mut reader = Reader {
            lines: BufReader::with_capacity(1 << 16, watched),
            name,
            bytes: Vec::new(),
            line: 0,
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

    /// Reads the next line that is not empty, if there is one.
    fn look(&mut self) -> Result<(), Failure> {
        let (mut record, mut empty) = (self.ahead.take().unwrap_or_default(), 0);
        loop {
            self.bytes.clear();
            let first = self.line + 1;
            // A field in quotes goes on over lines; one that never ends does not fill memory.
            let mut is_open = true;
            while is_open && self.bytes.len() < LONGEST {
                let before = self.bytes.len();
                let read = self.lines.read_until(b'\n', &mut self.bytes);
                let read =
                    read.map_err(|error| Failure::Work(format!("{}: {error}", self.name)))?;
                if read == 0 {
                    break;
                }
                self.line += 1;
                let quotes = self.bytes[before..].iter().filter(|&&byte| byte == b'"');
                is_open = (quotes.count() % 2 == 1) != (before > 0);
            }
            if self.bytes.is_empty() {
                return Ok(());
            }
            // A byte that is no UTF-8 becomes a character that is no number, so that its row is told.
            let text = String::from_utf8_lossy(&self.bytes);
            let text = match first {
                1 => text.strip_prefix('\u{feff}').unwrap_or(&text),
                _ => &text,
            };
            record.split(text.trim_end(), first);
            if !record.is_empty() {
                break;
            }
            empty += 1;
        }
        (self.empty, self.ahead) = (empty, Some(record));
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
            self.now.split("", ahead.line - self.empty);
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
