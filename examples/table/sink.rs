//! The result: block by block, and under its name only when it is complete.
use crate::number::Number;
use arrow::array::{ArrayRef, RecordBatch, UInt64Array};
use arrow::datatypes::SchemaRef;
use common::cli::Failure;
use common::csv;
use common::output::Output;
use parquet::arrow::ArrowWriter;
use std::path::Path;
use std::sync::Arc;

pub enum Sink {
    Csv(csv::Writer),
    Parquet(Box<Parquet>),
}

pub struct Parquet {
    writer: ArrowWriter<Output>,
    schema: SchemaRef,
    name: String,
}

impl Parquet {
    fn failed(&self, error: impl std::fmt::Display) -> Failure {
        Failure::Work(format!("{}: {error}", self.name))
    }
}

impl Sink {
    /// The file of that name, or standard output, for columns of a schema.
    pub fn create(out: Option<&Path>, schema: SchemaRef) -> Result<Self, Failure> {
        let output = Output::create(out)?;
        let is_parquet =
            out.is_some_and(|path| path.extension().is_some_and(|end| end == "parquet"));
        if !is_parquet {
            let names: Vec<_> = schema.fields().iter().map(|field| field.name()).collect();
            return Ok(Sink::Csv(csv::Writer::new(output, &names)));
        }
        let name = output.name().to_owned();
        let writer = ArrowWriter::try_new(output, Arc::clone(&schema), None);
        let writer = writer.map_err(|error| Failure::Work(format!("{name}: {error}")))?;
        Ok(Sink::Parquet(Box::new(Parquet {
            writer,
            schema,
            name,
        })))
    }

    /// Rows: columns of whole numbers, then those of results.
    pub fn write<T: Number>(
        &mut self,
        ids: Vec<Vec<u64>>,
        columns: Vec<Vec<T>>,
    ) -> Result<(), Failure> {
        match self {
            Sink::Csv(writer) => {
                let count = columns.first().map_or(0, Vec::len);
                writer.rows(count, |i, fields| {
                    ids.iter().for_each(|own| fields.number(own[i]));
                    columns.iter().for_each(|own| fields.number(own[i]));
                })
            }
            Sink::Parquet(own) => {
                let ids = ids.into_iter();
                let ids = ids.map(|ids| Arc::new(UInt64Array::from(ids)) as ArrayRef);
                let all = ids.chain(columns.into_iter().map(T::column)).collect();
                let batch = RecordBatch::try_new(Arc::clone(&own.schema), all);
                let batch = batch.map_err(|error| own.failed(error))?;
                own.writer.write(&batch).map_err(|error| own.failed(error))
            }
        }
    }

    /// `true` if the reader has closed the output: the rest need not be written.
    pub fn is_closed(&self) -> bool {
        match self {
            Sink::Csv(writer) => writer.is_closed(),
            Sink::Parquet(own) => own.writer.inner().is_closed(),
        }
    }

    /// Gives the result its name.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Sink::Csv(writer) => writer.finish(),
            Sink::Parquet(own) => {
                let Parquet { writer, name, .. } = *own;
                let output = writer.into_inner();
                let output = output.map_err(|error| Failure::Work(format!("{name}: {error}")));
                output?.finish()
            }
        }
    }
}
