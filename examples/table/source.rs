//! A table as rows of numbers, block by block.
use crate::PROGRAM;
use crate::block::{Block, Key};
use crate::csv::Table;
use crate::lists::{self, Wrong};
use crate::number::Number;
use crate::options::Input;
use arrow::array::{Array, ArrayRef, AsArray, RecordBatch};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Field, Int64Type, Schema};
use arrow::error::ArrowError;
use common::cli::Failure;
use common::csv::Reader;
use common::progress;
use geograd::Error;
use geograd::kernels::dynamic::{Layout, Parameter};
use indicatif::ProgressBar;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::fs::File;
use std::path::PathBuf;

/// Rows that are read at a time.
const READ: usize = 1 << 15;

/// The columns that have the numbers of a shape.
enum Place {
    /// One for every number.
    Fields(Vec<String>),
    /// One of lists.
    Lists(String),
    /// One of structs.
    Structs(String, Vec<String>),
}

/// The rows of a file.
enum Rows {
    /// With the places of the columns of the shape, and of the groups.
    Csv(Box<Table>, Vec<usize>, Option<usize>),
    Parquet(Box<dyn Iterator<Item = Result<RecordBatch, ArrowError>>>),
}

pub struct Source<T: Number> {
    path: PathBuf,
    rows: Rows,
    place: Place,
    layout: Layout<T>,
    group: Option<String>,
    /// The row that comes next.
    row: usize,
    /// Grows with what is read: with bytes of CSV, with rows of Parquet.
    pub bar: ProgressBar,
}

impl<T: Number> Source<T> {
    /// Opens a file and finds the columns of a shape in it.
    pub fn open(
        input: &Input,
        shape: &Parameter,
        layout: Layout<T>,
        group: Option<&str>,
    ) -> Result<Self, Failure> {
        let name = input.path.display();
        let failed = |why: &dyn std::fmt::Display| Failure::Work(format!("{name}: {why}"));
        let is_csv = input.path.extension().is_none_or(|end| end != "parquet");
        let fields = shape.shape.fields.iter();
        let fields: Vec<String> = fields.map(|field| field.name.to_string()).collect();
        let (rows, place, bar);
        if is_csv {
            let reader = Reader::open(&input.path, PROGRAM)?;
            bar = reader.bar.clone();
            let table = Table::new(reader)?;
            let names = table.names.iter();
            let schema: Vec<_> = names
                .map(|name| Field::new(name, DataType::Utf8, true))
                .collect();
            let schema = Schema::new(schema);
            place = find(&schema, fields, input.column.as_deref()).map_err(|why| failed(&why))?;
            let wanted = columns(&schema, &place, None).map_err(|why| failed(&why))?;
            let group = group.map(|name| index(&schema, name)).transpose();
            rows = Rows::Csv(Box::new(table), wanted, group.map_err(|why| failed(&why))?);
        } else {
            let file = File::open(&input.path).map_err(|error| failed(&error))?;
            let builder =
                ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| failed(&error))?;
            place = find(builder.schema(), fields, input.column.as_deref())
                .map_err(|why| failed(&why))?;
            let wanted = columns(builder.schema(), &place, group).map_err(|why| failed(&why))?;
            let mask = ProjectionMask::roots(builder.parquet_schema(), wanted);
            let count = builder.metadata().file_metadata().num_rows();
            bar = progress::bar(PROGRAM, count.unsigned_abs());
            let reader = builder.with_projection(mask).with_batch_size(READ).build();
            rows = Rows::Parquet(Box::new(reader.map_err(|error| failed(&error))?));
        }
        Ok(Source {
            path: input.path.clone(),
            rows,
            place,
            layout,
            group: group.map(str::to_owned),
            row: 0,
            bar,
        })
    }

    /// The name of the file.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }
    /// The numbers of a row.
    pub fn fields(&self) -> usize {
        self.layout.fields()
    }
    /// A failure at a row, counted from the file's first.
    pub fn at(&self, row: usize, why: &str) -> Failure {
        Failure::Work(format!("{}: row {row}: {why}", self.name()))
    }

    /// The next rows, checked; `None` at the end.
    pub fn next(&mut self) -> Result<Option<Block<T>>, Failure> {
        let batch = match &mut self.rows {
            Rows::Csv(table, columns, group) => {
                return table.next(READ, self.layout, columns, *group);
            }
            Rows::Parquet(batches) => match batches.next() {
                Some(batch) => batch,
                None => return Ok(None),
            },
        };
        let batch = batch.map_err(|error| {
            Failure::Work(format!("{}: after row {}: {error}", self.name(), self.row))
        })?;
        let (count, fields) = (batch.num_rows(), self.fields());
        let column = |name: &str| match batch.column_by_name(name) {
            Some(column) => Ok(column),
            None => Err(Failure::Work(format!("{}: no column {name}", self.name()))),
        };
        let mut lanes = Vec::new();
        match &self.place {
            Place::Fields(names) => {
                for name in names {
                    lanes.push(self.lane(column(name)?, name)?);
                }
            }
            Place::Structs(name, names) => {
                let whole = column(name)?;
                self.no_null(whole, name)?;
                for field in names {
                    let own = whole.as_struct().column_by_name(field);
                    let own =
                        own.ok_or_else(|| self.at(self.row, &format!("no field {name}.{field}")))?;
                    lanes.push(self.lane(own, &format!("{name}.{field}"))?);
                }
            }
            Place::Lists(name) => {
                let numbers = self.lists(column(name)?, name)?;
                return self.finish(&batch, numbers);
            }
        }
        let mut numbers = vec![T::default(); count * fields];
        for (k, lane) in lanes.iter().enumerate() {
            let targets = numbers.iter_mut().skip(k).step_by(fields);
            targets.zip(lane).for_each(|(target, &x)| *target = x);
        }
        self.finish(&batch, numbers)
    }

    fn finish(
        &mut self,
        batch: &RecordBatch,
        numbers: Vec<T>,
    ) -> Result<Option<Block<T>>, Failure> {
        for (row, numbers) in numbers.chunks_exact(self.fields()).enumerate() {
            if let Err(Error::Invalid { flaw, .. }) = self.layout.check(numbers) {
                return Err(self.at(self.row + row, &flaw.to_string()));
            }
        }
        let keys = match &self.group {
            Some(name) => self.keys(batch.column_by_name(name), name)?,
            None => Vec::new(),
        };
        self.row += batch.num_rows();
        self.bar.set_position(self.row as u64);
        Ok(Some(Block { numbers, keys }))
    }

    fn no_null(&self, column: &ArrayRef, name: &str) -> Result<(), Failure> {
        match (0..column.len()).find(|&row| column.is_null(row)) {
            Some(row) if column.null_count() > 0 => {
                Err(self.at(self.row + row, &format!("{name} is null")))
            }
            _ => Ok(()),
        }
    }

    /// The numbers of a column.
    fn lane(&self, column: &ArrayRef, name: &str) -> Result<Vec<T>, Failure> {
        self.no_null(column, name)?;
        if !column.data_type().is_numeric() {
            let why = format!(
                "{}: {name} is a column of {}, not of numbers",
                self.name(),
                column.data_type()
            );
            return Err(Failure::Work(why));
        }
        let numbers = cast(column, &T::data_type())
            .map_err(|error| self.at(self.row, &format!("{name}: {error}")))?;
        Ok(numbers.as_primitive::<T::Arrow>().values().to_vec())
    }

    /// The numbers of a column of lists.
    fn lists(&self, column: &ArrayRef, name: &str) -> Result<Vec<T>, Failure> {
        self.no_null(column, name)?;
        let fields = self.fields();
        let values = lists::values(column, fields).map_err(|wrong| match wrong {
            Wrong::Width { row, found } => self.at(
                self.row + row,
                &format!("{name} has {found} numbers, not {fields}"),
            ),
            Wrong::Null { row, field } => {
                self.at(self.row + row, &format!("{name}[{field}] is null"))
            }
        })?;
        self.lane(&values, name)
    }

    /// The group of every row.
    fn keys(&self, column: Option<&ArrayRef>, name: &str) -> Result<Vec<Key>, Failure> {
        let column =
            column.ok_or_else(|| Failure::Work(format!("{}: no column {name}", self.name())))?;
        self.no_null(column, name)?;
        let failed = |error: ArrowError| self.at(self.row, &format!("{name}: {error}"));
        if column.data_type().is_integer() {
            let keys = cast(column, &DataType::Int64).map_err(failed)?;
            return Ok(keys
                .as_primitive::<Int64Type>()
                .values()
                .iter()
                .map(|&x| Key::Number(x))
                .collect());
        }
        if column.data_type().is_floating() {
            return Err(Failure::Work(format!(
                "{}: groups are whole numbers or text; {name} has neither",
                self.name()
            )));
        }
        let keys = cast(column, &DataType::Utf8).map_err(failed)?;
        let key = |text: Option<&str>| Key::Text(text.unwrap_or_default().to_owned());
        Ok(keys.as_string::<i32>().iter().map(key).collect())
    }
}

/// The columns of a shape with these fields.
fn find(schema: &Schema, fields: Vec<String>, column: Option<&str>) -> Result<Place, String> {
    let there: Vec<&String> = schema.fields().iter().map(|field| field.name()).collect();
    if let Some((_, own)) = column.and_then(|name| schema.column_with_name(name)) {
        let name = own.name().clone();
        match own.data_type() {
            DataType::FixedSizeList(..) | DataType::List(_) => return Ok(Place::Lists(name)),
            DataType::Struct(inner) => {
                let missing: Vec<_> = fields
                    .iter()
                    .filter(|field| inner.find(field).is_none())
                    .cloned()
                    .collect();
                let inner: Vec<_> = inner.iter().map(|field| field.name().clone()).collect();
                return match missing.is_empty() {
                    true => Ok(Place::Structs(name, fields)),
                    false => Err(format!(
                        "{name} has no field {}; it has {}",
                        missing.join(", "),
                        inner.join(", ")
                    )),
                };
            }
            _ if fields.len() == 1 => return Ok(Place::Fields(vec![name])),
            _ => {}
        }
    }
    let own = |field: String| column.map_or(field.clone(), |name| format!("{name}.{field}"));
    let names: Vec<String> = fields.into_iter().map(own).collect();
    let missing: Vec<_> = names
        .iter()
        .filter(|name| !there.contains(name))
        .map(String::as_str)
        .collect();
    if missing.is_empty() {
        return Ok(Place::Fields(names));
    }
    let there: Vec<_> = there.into_iter().map(String::as_str).collect();
    Err(format!(
        "no column {}; there are {}",
        missing.join(", "),
        there.join(", ")
    ))
}

/// The place of a column in a file.
fn index(schema: &Schema, name: &str) -> Result<usize, String> {
    schema.index_of(name).map_err(|_| {
        let there = schema.fields().iter();
        let there: Vec<_> = there.map(|field| field.name().as_str()).collect();
        format!("no column {name}; there are {}", there.join(", "))
    })
}

/// The places of columns in a file.
fn columns(schema: &Schema, place: &Place, group: Option<&str>) -> Result<Vec<usize>, String> {
    let names: Vec<&str> = match place {
        Place::Fields(names) => names.iter().map(String::as_str).collect(),
        Place::Lists(name) | Place::Structs(name, _) => vec![name],
    };
    let mut places = Vec::new();
    for name in names.into_iter().chain(group) {
        let place = index(schema, name)?;
        if !places.contains(&place) {
            places.push(place);
        }
    }
    Ok(places)
}
