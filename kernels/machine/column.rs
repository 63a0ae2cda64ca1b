//! Columns as numbers: one argument of every item.
use super::machine_column::MachineColumn;
use crate::Real;
use crate::error::Error;
use crate::kernels::call::recording::Call;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{Item, STRETCH, leaves_of, memory, width};
use std::borrow::Cow;
use std::ops::Range;

/// How many numbers are written at once, few enough for a core's own cache.
const NUMBERS: usize = 1 << 14;

/// A function that writes the numbers of some shapes, one after another.
type Read<'a, T> = Box<dyn Fn(Range<usize>, &mut [T]) + Send + Sync + 'a>;

/// The source of a column's numbers: memory, or a function.
enum ColumnSource<'a, T> {
    Lent(&'a [T]),
    Read(Read<'a, T>),
}

/// One argument of every item, as numbers.
pub struct Column<'a, T> {
    numbers: ColumnSource<'a, T>,
    /// The number of scalars per item.
    pub fields: usize,
    /// The number of items; `None` for one that stands for any number.
    pub count: Option<usize>,
    /// The column on the machine, if it is there.
    pub(crate) held: Option<&'a dyn MachineColumn<T>>,
}

impl<'a, T: Real> Column<'a, T> {
    /// Creates a column from shapes.
    pub(crate) fn of<P: Item<Scalar = T>>(shapes: &'a [P]) -> Self {
        let numbers = match memory::lent(shapes) {
            Some(numbers) => ColumnSource::Lent(numbers),
            None => ColumnSource::Read(Box::new(move |items, rows| {
                let rows = rows.chunks_exact_mut(width::<P>());
                for (shape, row) in shapes[items].iter().zip(rows) {
                    shape.to_row(shape, &mut &mut row[..]);
                }
            })),
        };
        Column {
            numbers,
            fields: width::<P>(),
            count: Some(shapes.len()),
            held: None,
        }
    }
    /// Creates a column from one on a machine, with its numbers if that is the CPU.
    pub(crate) fn held(own: &'a dyn MachineColumn<T>, count: usize) -> Self {
        Column {
            held: Some(own),
            ..Column::lent(own.here().unwrap_or_default(), own.fields(), Some(count))
        }
    }
    /// Creates a column from the numbers of shapes, one shape after another; `None` items for one that stands for any
    /// number.
    pub(crate) fn lent(numbers: &'a [T], fields: usize, count: Option<usize>) -> Self {
        Column {
            numbers: ColumnSource::Lent(numbers),
            fields,
            count,
            held: None,
        }
    }
    /// Creates a column whose numbers `read` writes when they are needed.
    pub(crate) fn read(
        fields: usize,
        count: usize,
        read: impl Fn(Range<usize>, &mut [T]) + Send + Sync + 'a,
    ) -> Self {
        Column {
            numbers: ColumnSource::Read(Box::new(read)),
            fields,
            count: Some(count),
            held: None,
        }
    }
    /// Creates a column from some of the scalars of every shape of a list.
    fn part<P: Item<Scalar = T>>(shapes: &'a [P], part: Range<usize>) -> Self {
        let fields = part.len();
        Column {
            numbers: ColumnSource::Read(Box::new(move |items, rows| {
                let mut all = vec![T::default(); width::<P>()];
                for (shape, row) in shapes[items].iter().zip(rows.chunks_exact_mut(fields)) {
                    shape.to_row(shape, &mut &mut all[..]);
                    row.copy_from_slice(&all[part.clone()]);
                }
            })),
            fields,
            count: Some(shapes.len()),
            held: None,
        }
    }
    /// Returns the column as one whose item stands for all.
    pub(super) fn repeated(self) -> Self {
        Column {
            count: None,
            ..self
        }
    }
    /// Returns the number of items in memory.
    pub(crate) fn len(&self) -> usize {
        self.count.unwrap_or(1)
    }
    /// Returns the number of items, a multiple of sixteen, whose [numbers](Self::numbers) stay in a core's cache where they
    /// are written.
    pub(crate) fn group(&self) -> usize {
        match &self.numbers {
            ColumnSource::Lent(_) => STRETCH,
            ColumnSource::Read(_) => (NUMBERS / self.fields.max(1)).clamp(16, STRETCH) / 16 * 16,
        }
    }
    /// Returns the numbers of some items: in place if they are contiguous, else written into `room`.
    pub(crate) fn numbers<'r>(&'r self, items: Range<usize>, room: &'r mut Vec<T>) -> &'r [T] {
        let items = match self.count {
            Some(_) => items,
            None => 0..1,
        };
        match &self.numbers {
            ColumnSource::Lent(numbers) => {
                &numbers[items.start * self.fields..items.end * self.fields]
            }
            ColumnSource::Read(read) => {
                room.resize(items.len() * self.fields, T::default());
                read(items, room);
                room
            }
        }
    }
    /// Returns all its numbers.
    pub(crate) fn all(&self) -> Cow<'_, [T]> {
        match &self.numbers {
            ColumnSource::Lent(numbers) => Cow::Borrowed(numbers),
            ColumnSource::Read(read) => {
                let mut room = vec![T::default(); self.len() * self.fields];
                read(0..self.len(), &mut room);
                Cow::Owned(room)
            }
        }
    }
}

/// Lists the columns of items in memory, one per shape of an item.
pub(super) fn list_of<'a, P: Item>(shapes: &'a [P], add: &mut dyn FnMut(Column<'a, P::Scalar>)) {
    let leaves = leaves_of::<P>();
    if leaves.len() == 1 {
        return add(Column::of(shapes));
    }
    let mut start = 0;
    for leaf in leaves {
        add(Column::part(shapes, start..start + leaf.fields));
        start += leaf.fields;
    }
}

/// Returns the number of items of the columns of a call.
pub(crate) fn count_of<T: Real>(call: &Call<T>, columns: &[Column<'_, T>]) -> Result<usize, Error> {
    let mut count = None;
    for (k, column) in columns.iter().enumerate() {
        match (count, column.count) {
            (None, found) => count = found,
            (Some(expected), Some(found)) => expect(call.argument(k), expected, found)?,
            _ => (),
        }
    }
    Ok(count.unwrap_or(1))
}
