//! Rows of a source that wait for being computed.
use crate::block::Key;
use crate::number::Number;
use crate::source::Source;
use common::cli::Failure;
use geograd::kernels::dynamic::Rows;

pub struct Buffer<T: Number> {
    pub source: Source<T>,
    numbers: Vec<T>,
    /// The groups of the rows, and the first row of each in the buffer.
    runs: Vec<(Key, usize)>,
    /// The row of the file with which the buffer begins.
    pub first: usize,
    is_at_end: bool,
}

impl<T: Number> Buffer<T> {
    pub fn new(source: Source<T>) -> Self {
        Buffer {
            source,
            numbers: Vec::new(),
            runs: Vec::new(),
            first: 0,
            is_at_end: false,
        }
    }
    /// How many rows wait.
    pub fn len(&self) -> usize {
        self.numbers.len() / self.source.fields()
    }
    /// The first rows that wait.
    pub fn rows(&self, count: usize) -> Rows<'_, T> {
        let fields = self.source.fields();
        Rows::new(&self.numbers[..count * fields], fields)
    }
    /// Reads until so many rows wait, or the file ends.
    pub fn fill(&mut self, count: usize) -> Result<(), Failure> {
        while !self.is_at_end && self.len() < count {
            let before = self.len();
            match self.source.next()? {
                None => self.is_at_end = true,
                Some(block) => {
                    self.numbers.extend(block.numbers);
                    self.add(before, block.keys)?;
                }
            }
        }
        Ok(())
    }
    fn add(&mut self, before: usize, keys: Vec<Key>) -> Result<(), Failure> {
        for (row, key) in keys.into_iter().enumerate() {
            match self.runs.last() {
                Some((last, _)) if *last == key => continue,
                Some((last, _)) if *last > key => {
                    let why =
                        format!("group {key} comes after {last}: sort the file by its groups");
                    return Err(self.source.at(self.first + before + row, &why));
                }
                _ => self.runs.push((key, before + row)),
            }
        }
        Ok(())
    }
    /// The group that may go on in the file; `None` at its end.
    pub fn open(&self) -> Option<Option<&Key>> {
        (!self.is_at_end).then(|| self.runs.last().map(|run| &run.0))
    }
    /// Groups before one, with their first rows and where the last of them ends; all groups without one.
    pub fn before(&self, key: Option<&Key>) -> (&[(Key, usize)], usize) {
        let count = key.map_or(self.runs.len(), |key| {
            self.runs.partition_point(|run| run.0 < *key)
        });
        let end = self.runs.get(count).map_or(self.len(), |run| run.1);
        (&self.runs[..count], end)
    }
    /// Forgets the first rows.
    pub fn drop_rows(&mut self, count: usize) {
        self.numbers.drain(..count * self.source.fields());
        // The last group stays, even without rows: what follows is compared with it.
        let gone = self
            .runs
            .partition_point(|run| run.1 < count)
            .min(self.runs.len().saturating_sub(1));
        self.runs.drain(..gone);
        self.runs
            .iter_mut()
            .for_each(|run| run.1 = run.1.saturating_sub(count));
        self.first += count;
    }
}
