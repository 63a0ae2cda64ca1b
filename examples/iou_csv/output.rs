//! Writes the result: block by block, on all cores, and under its name only when complete.
use common::cli::Failure;
use std::fmt::{Debug, Write as _};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Rows turned into text at a time by one thread.
const STRETCH: usize = 1 << 14;

/// The output: a file or standard output.
pub struct Sink {
    to: BufWriter<Box<dyn Write>>,
    name: String,
    /// The text before the first row. It is written with that row or at the end, so that a job that fails
    /// before writes nothing.
    header: String,
    /// The file being written and the name it gets when complete.
    pending: Option<(PathBuf, PathBuf)>,
    /// `true` if the reader has closed the output: the rest need not be written.
    closed: bool,
}

impl Sink {
    /// The file of that name, or standard output, for rows of these columns.
    pub fn create(out: Option<&Path>, columns: &[String]) -> Result<Self, Failure> {
        let (to, name, pending): (Box<dyn Write>, _, _) = match out {
            None => (Box::new(io::stdout()), "standard output".to_string(), None),
            Some(path) => {
                let failed = |error| Failure::Work(format!("{}: {error}", path.display()));
                let name = path.display().to_string();
                // Through links, so that the file behind one is replaced and not the link.
                let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
                if target.exists() && !target.is_file() {
                    // A device or a pipe is written to; it must not be replaced.
                    let file = File::options().write(true).open(&target);
                    (Box::new(file.map_err(failed)?), name, None)
                } else {
                    let mut part = target.clone().into_os_string();
                    part.push(format!(".{}.part", std::process::id()));
                    let part = PathBuf::from(part);
                    let file = File::create_new(&part).map_err(failed)?;
                    (Box::new(file), name, Some((part, target)))
                }
            }
        };
        Ok(Sink {
            to: BufWriter::with_capacity(1 << 16, to),
            name,
            header: columns.join(",") + "\n",
            pending,
            closed: false,
        })
    }

    /// That many rows; each writes its fields.
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
                workers
                    .into_iter()
                    .map(|worker| {
                        worker
                            .join()
                            .expect("turning numbers into text cannot fail")
                    })
                    .collect()
            });
            for text in texts {
                self.write(&text)?;
            }
        }
        Ok(())
    }

    fn write(&mut self, text: &str) -> Result<(), Failure> {
        if self.closed {
            return Ok(());
        }
        let header = std::mem::take(&mut self.header);
        let written = self
            .to
            .write_all(header.as_bytes())
            .and_then(|()| self.to.write_all(text.as_bytes()));
        self.check(written)
    }

    fn check(&mut self, written: io::Result<()>) -> Result<(), Failure> {
        match written {
            // As `| head` does: the reader has all it wants, which is no failure.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(())
            }
            other => other.map_err(|error| Failure::Work(format!("{}: {error}", self.name))),
        }
    }

    /// `true` if the reader has closed the output.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Gives the result its name.
    pub fn finish(mut self) -> Result<(), Failure> {
        // Without any rows this is where the header goes.
        self.write("")?;
        let flushed = self.to.flush();
        self.check(flushed)?;
        if let Some((part, target)) = self.pending.take() {
            std::fs::rename(&part, &target).map_err(|error| {
                // The part is of no use without its name.
                let _ = std::fs::remove_file(&part);
                Failure::Work(format!("{}: {error}", self.name))
            })?;
        }
        Ok(())
    }
}

impl Drop for Sink {
    /// Leaves nothing half-written behind.
    fn drop(&mut self) {
        if let Some((part, _)) = &self.pending {
            let _ = std::fs::remove_file(part);
        }
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
        number(self.text, &x);
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
fn number<T: Debug>(text: &mut String, x: &T) {
    let start = text.len();
    let _ = write!(text, "{x:?}");
    match &text[start..] {
        "-0.0" | "0.0" => text.replace_range(start.., "0"),
        whole if whole.ends_with(".0") => text.truncate(text.len() - 2),
        _ => {}
    }
}
