//! Rows and pairs: what is computed, and the columns that it makes.
use crate::buffer::Buffer;
use crate::number::Number;
use crate::options::{LETTERS, Options, Which};
use crate::sink::Sink;
use crate::source::Source;
use arrow::datatypes::{DataType, Field, Schema};
use common::cli::{Failure, Machine, usage};
use common::compute::{self, BLOCK};
use geograd::kernels::Groups;
use geograd::kernels::dynamic::{Function, Mode};
use geograd::kernels::reduce::Found;
use std::cmp::Ordering;
use std::sync::Arc;

struct Work<'a, T: Number> {
    options: &'a Options,
    machine: &'a Machine,
    value: Function<T>,
    /// The value, and with `--grad` its gradient.
    wanted: Function<T>,
    /// How many numbers every column of `wanted` has, and how many of them are told.
    gives: Vec<[usize; 2]>,
    sink: Sink,
}

/// Does what a command line says.
pub fn run<T: Number>(options: &Options, machine: &Machine) -> Result<(), Failure> {
    let group = match &options.which {
        Which::Groups(column) => Some(column.as_str()),
        _ => None,
    };
    let layouts = options.operation.layouts::<T>();
    let mut buffers = Vec::new();
    for ((input, shape), layout) in options
        .inputs
        .iter()
        .zip(options.operation.arguments())
        .zip(layouts)
    {
        buffers.push(Buffer::new(Source::open(input, &shape, layout, group)?));
    }
    let mut work = Work::new(options, machine)?;
    // One bar is enough: the others are hidden.
    buffers.iter().skip(1).for_each(|buffer| {
        buffer
            .source
            .bar
            .set_draw_target(indicatif::ProgressDrawTarget::hidden())
    });
    let bar = buffers[0].source.bar.clone();
    let done = match (&options.which, &mut buffers[..]) {
        (Which::Aligned, buffers) => work.aligned(buffers),
        (Which::AllPairs, [a, b]) => work.all_pairs(a, b),
        (Which::Groups(_), [a, b]) => work.groups(a, b),
        _ => usage("pairs need two arguments"),
    };
    bar.finish_and_clear();
    done?;
    work.sink.finish()
}

impl<'a, T: Number> Work<'a, T> {
    fn new(options: &'a Options, machine: &'a Machine) -> Result<Self, Failure> {
        let operation = options.operation;
        let mode = if options.grad {
            Mode::ValueGrad
        } else {
            Mode::Value
        };
        let (Some(value), Some(wanted)) = (operation.value::<T>(), operation.function::<T>(mode))
        else {
            return usage(format!(
                "{} takes paths, which tables do not hold",
                operation.verb()
            ));
        };
        let (verb, number) = (operation.verb(), T::data_type());
        let mut fields = Vec::new();
        let id = |name: &str| Field::new(name, DataType::UInt64, false);
        match (&options.which, options.above) {
            (Which::Aligned, Some(_)) => fields.push(id("row")),
            (Which::Aligned, None) => {}
            _ => fields.extend([id("a_row"), id("b_row")]),
        }
        for shape in operation.result() {
            for own in &shape.fields {
                let name = if shape.fields.len() == 1 {
                    verb.clone()
                } else {
                    format!("{verb}.{}", own.name)
                };
                fields.push(Field::new(name, number.clone(), false));
            }
        }
        let mut gives: Vec<_> = wanted.gives().into_iter().map(|count| [count; 2]).collect();
        if options.grad {
            let takes = value.takes();
            for (k, (shape, (_, layout))) in operation.arguments().iter().zip(takes).enumerate() {
                // Whole numbers have no derivatives.
                let told = layout.fields() - layout.codes();
                gives[k + 1][1] = told;
                for own in &shape.shape.fields[..told] {
                    let name = format!("{verb}_by_{}.{}", LETTERS[k], own.name);
                    fields.push(Field::new(name, number.clone(), false));
                }
            }
        }
        let sink = Sink::create(options.out.as_deref(), Arc::new(Schema::new(fields)))?;
        Ok(Work {
            options,
            machine,
            value,
            wanted,
            gives,
            sink,
        })
    }

    /// Results as columns of a table.
    fn columns(&self, lists: Vec<Vec<T>>) -> Vec<Vec<T>> {
        let mut columns = Vec::new();
        for (list, &[fields, told]) in lists.into_iter().zip(&self.gives) {
            columns.extend((0..told).map(|k| {
                list.iter()
                    .skip(k)
                    .step_by(fields)
                    .copied()
                    .collect::<Vec<T>>()
            }));
        }
        columns
    }

    fn aligned(&mut self, buffers: &mut [Buffer<T>]) -> Result<(), Failure> {
        while !self.sink.is_closed() {
            for buffer in &mut *buffers {
                buffer.fill(BLOCK)?;
            }
            let count = buffers
                .iter()
                .map(Buffer::len)
                .min()
                .unwrap_or(0)
                .min(BLOCK);
            if count == 0 {
                // A file that has rows left, where another has none.
                let longer = buffers.iter().find(|buffer| buffer.len() > 0);
                let shorter = buffers.iter().find(|buffer| buffer.len() == 0);
                return match (longer, shorter) {
                    (Some(longer), Some(shorter)) => Err(Failure::Work(format!(
                        "{} has {} rows and {} has more; rows need as many of each (or --all-pairs)",
                        shorter.source.name(),
                        shorter.first,
                        longer.source.name(),
                    ))),
                    _ => Ok(()),
                };
            }
            let rows: Vec<_> = buffers.iter().map(|buffer| buffer.rows(count)).collect();
            let mut columns = self.columns(self.wanted.on(self.machine.backend())?.aligned(&rows)?);
            let mut ids = Vec::new();
            if let Some(threshold) = self.options.above {
                let told: Vec<usize> = (0..count)
                    .filter(|&i| columns[0][i] > T::lit(threshold))
                    .collect();
                columns
                    .iter_mut()
                    .for_each(|column| *column = told.iter().map(|&i| column[i]).collect());
                ids.push(
                    told.iter()
                        .map(|&i| (buffers[0].first + i) as u64)
                        .collect(),
                );
            }
            self.sink.write(ids, columns)?;
            buffers
                .iter_mut()
                .for_each(|buffer| buffer.drop_rows(count));
        }
        Ok(())
    }

    /// The numbers of rows of both files, counted from those that wait.
    fn ids([a, b]: [&Buffer<T>; 2], places: [&[usize]; 2]) -> Vec<Vec<u64>> {
        let ids = [(a, places[0]), (b, places[1])].map(|(buffer, places)| {
            let all = places.iter().map(|&row| (buffer.first + row) as u64);
            all.collect()
        });
        ids.into()
    }

    /// Writes pairs that were found among rows that wait in both buffers.
    fn found(&mut self, buffers: [&Buffer<T>; 2], found: &[Found<T>]) -> Result<(), Failure> {
        for found in found.chunks(BLOCK) {
            if self.sink.is_closed() {
                break;
            }
            let rows: Vec<usize> = found.iter().map(|pair| pair.row).collect();
            let columns: Vec<usize> = found.iter().map(|pair| pair.column).collect();
            let places = [&rows[..], &columns[..]];
            let results = match self.options.grad {
                false => vec![found.iter().map(|pair| pair.value).collect()],
                true => {
                    let lists = buffers.map(|buffer| buffer.rows(buffer.len()));
                    let of = compute::of_places(&self.wanted, self.machine, lists, places)?;
                    self.columns(of)
                }
            };
            self.sink.write(Self::ids(buffers, places), results)?;
        }
        Ok(())
    }

    fn all_pairs(&mut self, a: &mut Buffer<T>, b: &mut Buffer<T>) -> Result<(), Failure> {
        b.fill(usize::MAX)?;
        loop {
            a.fill(BLOCK)?;
            let count = a.len().min(BLOCK);
            if count == 0 || self.sink.is_closed() {
                return Ok(());
            }
            match self.options.above {
                Some(threshold) => {
                    let value = self.value.on(self.machine.backend())?;
                    let (of_a, of_b) = (a.rows(count), b.rows(b.len()));
                    let found = value.above(of_a, of_b, T::lit(threshold))?;
                    self.found([a, b], &found)?;
                }
                None => self.product([a, b], 0..count, 0..b.len())?,
            }
            a.drop_rows(count);
        }
    }

    /// Every row of one list with every row of another, row by row.
    fn product(
        &mut self,
        buffers: [&Buffer<T>; 2],
        rows: std::ops::Range<usize>,
        columns: std::ops::Range<usize>,
    ) -> Result<(), Failure> {
        for block in compute::blocks(rows, columns) {
            if self.sink.is_closed() {
                break;
            }
            let [of_rows, of_columns] = compute::places(&block[0], &block[1]);
            let lists = buffers.map(|buffer| buffer.rows(buffer.len()));
            let results = compute::of_all(&self.wanted, self.machine, lists, &block)?;
            let ids = Self::ids(buffers, [&of_rows, &of_columns]);
            self.sink.write(ids, self.columns(results))?;
        }
        Ok(())
    }

    fn groups(&mut self, a: &mut Buffer<T>, b: &mut Buffer<T>) -> Result<(), Failure> {
        let mut wanted = BLOCK;
        while !self.sink.is_closed() {
            a.fill(wanted)?;
            b.fill(wanted)?;
            let is_last = a.open().is_none() && b.open().is_none();
            // Groups that go on in a file wait until it has been read.
            let bound = match (a.open(), b.open()) {
                (None, None) => None,
                (None, other) | (other, None) => other.flatten(),
                (Some(own), Some(other)) => own.min(other),
            }
            .cloned();
            let (offsets, ends) = {
                let ((runs_a, end_a), (runs_b, end_b)) =
                    (a.before(bound.as_ref()), b.before(bound.as_ref()));
                (
                    common_groups([runs_a, runs_b], [end_a, end_b]),
                    [end_a, end_b],
                )
            };
            if ends == [0, 0] && !is_last {
                // A group larger than the block.
                wanted = 2 * a.len().max(b.len()).max(BLOCK / 2);
                continue;
            }
            wanted = BLOCK;
            match self.options.above {
                Some(threshold) => {
                    let groups = Groups::new(&offsets[0], &offsets[1]);
                    let value = self.value.on(self.machine.backend())?;
                    let (of_a, of_b) = (a.rows(ends[0]), b.rows(ends[1]));
                    let found = value.above_grouped(of_a, of_b, groups, T::lit(threshold))?;
                    self.found([a, b], &found)?;
                }
                None => {
                    for (own, other) in offsets[0].windows(2).zip(offsets[1].windows(2)) {
                        self.product([a, b], own[0]..own[1], other[0]..other[1])?;
                    }
                }
            }
            a.drop_rows(ends[0]);
            b.drop_rows(ends[1]);
            if is_last {
                break;
            }
        }
        Ok(())
    }
}

/// The offsets of all groups in both lists, given the first row of each; a group may be in one list alone.
fn common_groups<K: Ord>(runs: [&[(K, usize)]; 2], ends: [usize; 2]) -> [Vec<usize>; 2] {
    let (mut places, mut offsets) = ([0, 0], [vec![0], vec![0]]);
    while places[0] < runs[0].len() || places[1] < runs[1].len() {
        let order = match (runs[0].get(places[0]), runs[1].get(places[1])) {
            (Some(own), Some(other)) => own.0.cmp(&other.0),
            (Some(_), None) => Ordering::Less,
            _ => Ordering::Greater,
        };
        places[0] += usize::from(order != Ordering::Greater);
        places[1] += usize::from(order != Ordering::Less);
        for k in 0..2 {
            offsets[k].push(runs[k].get(places[k]).map_or(ends[k], |run| run.1));
        }
    }
    if offsets[0].len() == 1 {
        // No group at all is one without rows.
        offsets.iter_mut().for_each(|own| own.push(0));
    }
    offsets
}
