//! The result: block by block, and under its name only when it is complete.
use arrow::array::RecordBatch;
use arrow::csv::WriterBuilder;
use arrow::datatypes::SchemaRef;
use arrow::error::ArrowError;
use common::cli::Failure;
use parquet::arrow::ArrowWriter;
use parquet::errors::ParquetError;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An open output.
type Output = BufWriter<Box<dyn Write + Send>>;

enum Writer {
    Csv(Box<arrow::csv::Writer<Output>>),
    Parquet(Box<ArrowWriter<Output>>),
}

pub struct Sink {
    writer: Option<Writer>,
    schema: SchemaRef,
    /// `true` once there is a row or a header.
    is_begun: bool,
    name: String,
    pending: Pending,
    /// `true` if the reader has closed the output: the rest need not be written.
    pub is_closed: bool,
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

impl Sink {
    /// The file of that name, or standard output, for columns of a schema.
    pub fn create(out: Option<&Path>, schema: SchemaRef) -> Result<Self, Failure> {
        let (to, name, pending): (Box<dyn Write + Send>, _, _) = match out {
            None => (
                Box::new(io::stdout()),
                "standard output".to_owned(),
                Pending(None),
            ),
            Some(path) => {
                let name = path.display().to_string();
                let failed = |error: io::Error| Failure::Work(format!("{name}: {error}"));
                // Through links, so that the file behind one is replaced and not the link.
                let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
                if target.exists() && !target.is_file() {
                    // A device or a pipe is written to; it must not be replaced.
                    let file = File::options().write(true).open(&target).map_err(failed)?;
                    (Box::new(file), name, Pending(None))
                } else {
                    let mut part = target.clone().into_os_string();
                    part.push(format!(".{}.part", std::process::id()));
                    let part = PathBuf::from(part);
                    let file = File::create_new(&part).map_err(failed)?;
                    (Box::new(file), name, Pending(Some((part, target))))
                }
            }
        };
        let to = BufWriter::with_capacity(1 << 16, to);
        let is_parquet =
            out.is_some_and(|path| path.extension().is_some_and(|end| end == "parquet"));
        let writer = if is_parquet {
            let writer = ArrowWriter::try_new(to, Arc::clone(&schema), None);
            Writer::Parquet(Box::new(
                writer.map_err(|error| Failure::Work(format!("{name}: {error}")))?,
            ))
        } else {
            Writer::Csv(Box::new(WriterBuilder::new().with_header(true).build(to)))
        };
        Ok(Sink {
            writer: Some(writer),
            schema,
            is_begun: false,
            name,
            pending,
            is_closed: false,
        })
    }

    pub fn write(&mut self, batch: &RecordBatch) -> Result<(), Failure> {
        self.is_begun = true;
        let written = match &mut self.writer {
            Some(Writer::Csv(writer)) => writer.write(batch).map_err(Why::from),
            Some(Writer::Parquet(writer)) => writer.write(batch).map_err(Why::from),
            None => Ok(()),
        };
        self.check(written)
    }

    fn check(&mut self, written: Result<(), Why>) -> Result<(), Failure> {
        match written {
            // As `| head` does: the reader has all it wants, which is no failure.
            Err(Why::Closed) => {
                self.is_closed = true;
                Ok(())
            }
            Err(Why::Other(why)) => Err(Failure::Work(format!("{}: {why}", self.name))),
            Ok(()) => Ok(()),
        }
    }

    /// Gives the result its name.
    pub fn finish(mut self) -> Result<(), Failure> {
        if !self.is_begun {
            // Without any row there is a header, too.
            self.write(&RecordBatch::new_empty(Arc::clone(&self.schema)))?;
        }
        let flushed = match self.writer.take() {
            Some(Writer::Csv(writer)) => writer.into_inner().flush().map_err(Why::from),
            Some(Writer::Parquet(writer)) => {
                let inner = writer.into_inner().map_err(Why::from);
                inner.and_then(|mut to| to.flush().map_err(Why::from))
            }
            None => Ok(()),
        };
        self.check(flushed)?;
        if let Some((part, target)) = &self.pending.0 {
            let synced = File::open(part).and_then(|file| file.sync_all());
            let named = synced.and_then(|()| std::fs::rename(part, target));
            named.map_err(|error| Failure::Work(format!("{}: {error}", self.name)))?;
            self.pending.0 = None;
        }
        Ok(())
    }
}

/// Why something is not written.
enum Why {
    Closed,
    Other(String),
}

impl From<io::Error> for Why {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Why::Closed,
            _ => Why::Other(error.to_string()),
        }
    }
}
impl From<ArrowError> for Why {
    fn from(error: ArrowError) -> Self {
        match error {
            ArrowError::IoError(_, error) => error.into(),
            other => Why::Other(other.to_string()),
        }
    }
}
impl From<ParquetError> for Why {
    fn from(error: ParquetError) -> Self {
        Why::Other(error.to_string())
    }
}
