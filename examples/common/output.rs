//! A file that appears under its name only when it is complete, or standard output.
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// An output that is being written.
pub struct Output {
    to: BufWriter<Box<dyn Write + Send>>,
    name: String,
    pending: Pending,
    /// `true` if the reader has closed the output: the rest need not be written.
    closed: bool,
}

/// The file that is written, and the name that it gets when it is complete. It is removed before.
struct Pending(Option<(PathBuf, PathBuf)>);

impl Drop for Pending {
    fn drop(&mut self) {
        if let Some((part, _)) = &self.0 {
            let _ = std::fs::remove_file(part);
        }
    }
}

impl Output {
    /// The file of that name, or standard output.
    ///
    /// # Errors
    ///
    /// A file that cannot be written.
    pub fn create(out: Option<&Path>) -> Result<Self, Failure> {
        let (to, name, pending): (Box<dyn Write + Send>, _, _) = match out {
            None => (Box::new(io::stdout()), "standard output".to_owned(), None),
            Some(path) => {
                let name = path.display().to_string();
                let failed = |error: io::Error| Failure::Work(format!("{name}: {error}"));
                // Through links, so that the file behind one is replaced and not the link.
                let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
                if target.exists() && !target.is_file() {
                    // A device or a pipe is written to; it must not be replaced.
                    let file = File::options().write(true).open(&target).map_err(failed)?;
                    (Box::new(file), name, None)
                } else {
                    let mut part = target.clone().into_os_string();
                    part.push(format!(".{}.part", std::process::id()));
                    let part = PathBuf::from(part);
                    let file = File::create_new(&part).map_err(failed)?;
                    (Box::new(file), name, Some((part, target)))
                }
            }
        };
        Ok(Output {
            to: BufWriter::with_capacity(1 << 16, to),
            name,
            pending: Pending(pending),
            closed: false,
        })
    }

    /// Its name, for messages.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
    /// `true` if the reader has closed the output: the rest need not be written.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed
    }
    fn failed(&self, error: io::Error) -> Failure {
        Failure::Work(format!("{}: {error}", self.name))
    }

    /// Writes a text.
    ///
    /// # Errors
    ///
    /// An output that cannot be written.
    pub fn text(&mut self, text: &str) -> Result<(), Failure> {
        self.write_all(text.as_bytes())
            .map_err(|error| self.failed(error))
    }

    /// Gives the result its name.
    ///
    /// # Errors
    ///
    /// An output that cannot be written or named.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.flush().map_err(|error| self.failed(error))?;
        if let Some((part, target)) = &self.pending.0 {
            let synced = File::open(part).and_then(|file| file.sync_all());
            let named = synced.and_then(|()| std::fs::rename(part, target));
            named.map_err(|error| self.failed(error))?;
            self.pending.0 = None;
        }
        Ok(())
    }

    /// As `| head` does: the reader has all it wants, which is no failure.
    fn unless_closed<R>(&mut self, done: io::Result<R>, otherwise: R) -> io::Result<R> {
        match done {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(otherwise)
            }
            other => other,
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.closed {
            return Ok(bytes.len());
        }
        let done = self.to.write(bytes);
        self.unless_closed(done, bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        if self.closed {
            return Ok(());
        }
        let done = self.to.flush();
        self.unless_closed(done, ())
    }
}
