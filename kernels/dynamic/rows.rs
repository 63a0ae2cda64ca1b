//! Columns of plain numbers, and the layouts that they must have.
use crate::error::{Argument, Error, Field, Validate};
use crate::kernels::machine::{Column, in_range};
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{Item, Leaf, leaf};
use crate::{Fixed, Real, Rule};
use std::borrow::Cow;
use std::ops::Range;

/// The memory of rows.
#[derive(Clone, Copy, Debug)]
enum RowMemory<'a, T> {
    /// Row-major: the fields of a row are adjacent.
    Together(&'a [T]),
    /// Elsewhere.
    Scattered(Scattered<'a, T>),
}

/// The memory of rows whose numbers are not adjacent.
#[derive(Clone, Copy, Debug)]
enum Scattered<'a, T> {
    /// One slice per field.
    Fields(&'a [&'a [T]]),
    /// Items of a shared column.
    Items(SharedItems<'a, T>),
}

/// Items of a shared column, so many of them a row.
#[derive(Clone, Copy, Debug)]
struct SharedItems<'a, T> {
    shared: &'a [T],
    /// The number of numbers of an item.
    size: usize,
    indices: &'a [u32],
    corners: usize,
}

/// One argument of every item as plain numbers: rows in row-major order, a slice for every field, or items of a shared
/// column.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, T> {
    numbers: RowMemory<'a, T>,
    fields: usize,
    is_one: bool,
}

impl<'a, T: Real> Rows<'a, T> {
    /// Creates rows of `fields` numbers each, in row-major order.
    #[must_use]
    pub const fn new(numbers: &'a [T], fields: usize) -> Self {
        Rows {
            numbers: RowMemory::Together(numbers),
            fields,
            is_one: false,
        }
    }
    /// Creates one row that stands for all items.
    #[must_use]
    pub const fn one(row: &'a [T]) -> Self {
        Rows {
            numbers: RowMemory::Together(row),
            fields: row.len(),
            is_one: true,
        }
    }
    /// Creates rows with one slice per field, such as the structs of Arrow. Calls read the slices in place, a few
    /// thousand rows at a time.
    ///
    /// ```
    /// use geograd::kernels::dynamic::{Rows, operation};
    /// let iou = operation("iou_aabb2").and_then(|iou| iou.value::<f64>()).expect("is listed");
    /// let (low, right, zero) = ([0.0, 1.0], [2.0, 3.0], [0.0, 0.0]);
    /// let fields: [&[f64]; 4] = [&low, &zero, &right, &[2.0, 2.0]];
    /// let boxes = Rows::apart(&fields);
    /// assert_eq!(iou.all_pairs(boxes, boxes)?, [1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub const fn apart(fields: &'a [&'a [T]]) -> Self {
        Rows {
            numbers: RowMemory::Scattered(Scattered::Fields(fields)),
            fields: fields.len(),
            is_one: false,
        }
    }
    /// Creates rows that are made of items of a shared column, `corners` of them each: triangles over vertices, edges
    /// over points, listed boxes. `size` is the number of numbers of an item. Calls read the items where they lie;
    /// [`gathered`](Rows::gathered) brings derivatives back to them.
    ///
    /// ```
    /// use geograd::kernels::dynamic::{Rows, operation};
    /// let area = operation("area_triangle").and_then(|area| area.value_grad::<f64>()).expect("is listed");
    /// let vertices = [0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0];
    /// let faces = Rows::indexed(&vertices, 2, &[0, 1, 2, 0, 2, 3], 3);
    /// let found = area.aligned(&[faces])?;
    /// assert_eq!(found[0], [2.0, 2.0]);
    /// assert_eq!(faces.gathered(&found[1])?[4..6], [1.0, 1.0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub const fn indexed(shared: &'a [T], size: usize, indices: &'a [u32], corners: usize) -> Self {
        Rows {
            numbers: RowMemory::Scattered(Scattered::Items(SharedItems {
                shared,
                size,
                indices,
                corners,
            })),
            fields: size * corners,
            is_one: false,
        }
    }
    /// Returns the derivatives by the numbers of shared items from those by all rows: their sums, added in double
    /// precision in the order of rows. Derivatives by rows that are no [indices](Rows::indexed) are returned as they are.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] unless there is one derivative per number of a row, and as calls for indices out of range.
    pub fn gathered(&self, derivatives: &[T]) -> Result<Vec<T>, Error> {
        self.column(Argument::Named("indices"), self.fields)?;
        let expected = self.count().unwrap_or(1) * self.fields;
        expect(Argument::Upstream, expected, derivatives.len())?;
        let RowMemory::Scattered(Scattered::Items(items)) = self.numbers else {
            return Ok(derivatives.to_vec());
        };
        let SharedItems { shared, size, .. } = items;
        let mut sums = vec![0.0; shared.len()];
        for (&index, part) in items
            .indices
            .iter()
            .zip(derivatives.chunks_exact(size.max(1)))
        {
            let own = &mut sums[size * index as usize..];
            own.iter_mut()
                .zip(part)
                .for_each(|(sum, x)| *sum += x.widen());
        }
        Ok(sums.into_iter().map(T::nearest).collect())
    }
    /// Returns the numbers in row-major order; copies separate fields.
    #[must_use]
    pub fn numbers(&self) -> Cow<'a, [T]> {
        match self.numbers {
            RowMemory::Together(numbers) => Cow::Borrowed(numbers),
            RowMemory::Scattered(memory) => {
                let count = self.count().unwrap_or(0);
                let mut rows = vec![T::default(); count * self.fields];
                memory.read(0..count, &mut rows);
                Cow::Owned(rows)
            }
        }
    }
    /// Returns the number of rows; `None` for one that stands for all items.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        let numbers = match self.numbers {
            RowMemory::Together(numbers) => numbers.len().checked_div(self.fields).unwrap_or(0),
            RowMemory::Scattered(memory) => memory.count(),
        };
        (!self.is_one).then_some(numbers)
    }
    /// Returns the number of fields of a row.
    #[must_use]
    pub const fn fields(&self) -> usize {
        self.fields
    }
    /// Returns `true` unless the numbers of a row are adjacent.
    pub(super) const fn is_apart(&self) -> bool {
        matches!(self.numbers, RowMemory::Scattered(_))
    }
    /// Returns some rows, copied to `room` unless their numbers are adjacent; a row that stands for all is returned as it is.
    pub(super) fn some<'s>(&'s self, items: Range<usize>, room: &'s mut Vec<T>) -> Rows<'s, T> {
        match self.numbers {
            RowMemory::Together(_) if self.is_one => *self,
            RowMemory::Together(numbers) => {
                let fields = self.fields;
                Rows::new(&numbers[items.start * fields..items.end * fields], fields)
            }
            RowMemory::Scattered(memory) => {
                room.resize(items.len() * self.fields, T::default());
                memory.read(items, room);
                Rows::new(room, self.fields)
            }
        }
    }
    /// Converts it to a column, and checks its number of fields.
    pub(super) fn column(
        &self,
        argument: Argument,
        expected: usize,
    ) -> Result<Column<'a, T>, Error> {
        if self.fields != expected {
            return Err(Error::Fields {
                argument,
                expected,
                found: self.fields,
            });
        }
        match self.numbers {
            RowMemory::Together(numbers) => {
                expect_parts(argument, numbers.len(), expected)?;
            }
            RowMemory::Scattered(Scattered::Fields(fields)) => {
                let count = fields.first().map_or(0, |field| field.len());
                let mut lengths = fields.iter().map(|field| field.len());
                lengths.try_for_each(|found| expect(argument, count, found))?;
            }
            RowMemory::Scattered(Scattered::Items(items)) => items.check(argument)?,
        }
        Ok(self.lent())
    }
    /// Converts it to a column with any number of fields.
    pub(super) fn lent(&self) -> Column<'a, T> {
        match self.numbers {
            RowMemory::Together(numbers) => Column::lent(numbers, self.fields, self.count()),
            RowMemory::Scattered(memory) => {
                let read = move |items: Range<usize>, rows: &mut [T]| memory.read(items, rows);
                Column::read(self.fields, self.count().unwrap_or(0), read)
            }
        }
    }
}

/// Checks that so many numbers make whole parts of a length.
fn expect_parts(argument: Argument, count: usize, part: usize) -> Result<(), Error> {
    expect(argument, count - count % part.max(1), count)
}

impl<T: Real> Scattered<'_, T> {
    /// Returns the number of rows.
    fn count(&self) -> usize {
        match self {
            Scattered::Fields(fields) => fields.iter().map(|field| field.len()).min().unwrap_or(0),
            Scattered::Items(items) => items.indices.len().checked_div(items.corners).unwrap_or(0),
        }
    }
    /// Copies some rows to row-major order.
    fn read(&self, items: Range<usize>, rows: &mut [T]) {
        match self {
            Scattered::Fields(fields) => gather(fields, items, rows),
            Scattered::Items(shared) => shared.read(items, rows),
        }
    }
}

impl<T: Real> SharedItems<'_, T> {
    /// Checks that items and rows are whole, and that indices are in range.
    fn check(&self, argument: Argument) -> Result<(), Error> {
        let (size, corners) = (self.size.max(1), self.corners.max(1));
        expect_parts(argument, self.shared.len(), size)?;
        expect_parts(argument, self.indices.len(), corners)?;
        in_range(
            argument,
            self.shared.len() / size,
            self.indices,
            [0, corners],
        )
    }
    /// Copies some rows to row-major order.
    fn read(&self, items: Range<usize>, rows: &mut [T]) {
        let (size, own) = (
            self.size,
            items.start * self.corners..items.end * self.corners,
        );
        for (place, &index) in rows.chunks_exact_mut(size.max(1)).zip(&self.indices[own]) {
            place.copy_from_slice(&self.shared[size * index as usize..][..size]);
        }
    }
}

/// Copies rows of separate fields to row-major order.
fn gather<T: Real>(fields: &[&[T]], items: Range<usize>, rows: &mut [T]) {
    for (k, field) in fields.iter().enumerate() {
        let places = rows.iter_mut().skip(k).step_by(fields.len());
        places
            .zip(&field[items.clone()])
            .for_each(|(place, &x)| *place = x);
    }
}

/// The meaning of a column of numbers: the fields of a row, their names, and the valid values.
#[derive(Debug)]
pub struct Layout<T> {
    pub(super) leaf: Leaf<T>,
}

impl<T> Clone for Layout<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Layout<T> {}

impl<T: Real> Layout<T> {
    /// Returns the layout of `fields` finite numbers.
    ///
    /// ```
    /// use geograd::kernels::dynamic::Layout;
    /// assert_eq!(Layout::<f64>::numbers(3).names()[2].as_str(), "[2]");
    /// ```
    #[must_use]
    pub fn numbers(fields: usize) -> Self {
        Layout {
            leaf: Leaf::numbers(fields),
        }
    }
    /// Returns the layout of a shape.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::dynamic::Layout;
    /// let layout = Layout::of::<Obb2<f64>>();
    /// assert_eq!((layout.name().as_str(), layout.fields()), ("Obb2", 5));
    /// assert_eq!(layout.names()[4].as_str(), "heading");
    /// ```
    #[must_use]
    pub fn of<P: Item<Scalar = T> + Fixed + Validate>() -> Self {
        Layout { leaf: leaf::<P>() }
    }
    /// Returns the name of the shape; `number` or `numbers` without one.
    #[must_use]
    pub fn name(&self) -> String {
        match ((self.leaf.shape)(), self.leaf.fields) {
            ("", 1) => "number".to_owned(),
            ("", _) => "numbers".to_owned(),
            (name, _) => shape_name(name),
        }
    }
    /// Returns the number of fields of a row: scalars, then whole numbers.
    #[must_use]
    pub const fn fields(&self) -> usize {
        self.leaf.fields
    }
    /// Returns the number of fields that are whole numbers, which have no derivatives.
    #[must_use]
    pub const fn codes(&self) -> usize {
        self.leaf.codes
    }
    /// Returns the names of its scalars.
    #[must_use]
    pub fn names(&self) -> Vec<Field> {
        let scalars = 0..self.leaf.fields - self.leaf.codes;
        scalars.map(self.leaf.name).collect()
    }
    /// Returns the rules of its numbers ([`Validate::RULES`]).
    #[must_use]
    pub const fn rules(&self) -> &'static [Rule] {
        self.leaf.rules
    }
    /// Checks that a row is valid.
    ///
    /// # Errors
    ///
    /// [`Error::Fields`] for another number of fields, [`Error::Invalid`] for numbers that are not valid.
    pub fn check(&self, row: &[T]) -> Result<(), Error> {
        let argument = Argument::Shape;
        if row.len() != self.leaf.fields {
            return Err(Error::Fields {
                argument,
                expected: self.leaf.fields,
                found: row.len(),
            });
        }
        (self.leaf.check)(row).map_err(|flaw| Error::Invalid {
            argument,
            item: 0,
            flaw,
        })
    }
}

/// Returns the name of a shape from the name of its type, without paths and the format of its numbers.
pub(super) fn shape_name(of_type: &str) -> String {
    let mut name = String::new();
    for part in of_type.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_' && c != ':') {
        name.push_str(part.rsplit("::").next().unwrap_or(part));
    }
    for format in ["f32", "f64"] {
        if name == format {
            return "number".to_owned();
        }
        name = name
            .replace(&format!("<{format}>"), "")
            .replace(&format!("<{format}, "), "<");
    }
    name
}

/// Returns the names of arguments: declared ones, or else their places.
pub(super) fn named(names: &[&'static str], count: usize) -> Vec<Argument> {
    (0..count)
        .map(|k| match names.get(k) {
            Some(name) if names.len() == count => Argument::Named(name),
            _ => Argument::input(k),
        })
        .collect()
}

/// Returns an error with the names of arguments in place of their letters.
pub(super) fn renamed(error: Error, names: &[Argument]) -> Error {
    let name = |argument: Argument| {
        let place = (0..names.len()).find(|&k| Argument::input(k) == argument);
        place.map_or(argument, |k| names[k])
    };
    match error {
        Error::Length {
            argument,
            expected,
            found,
        } => Error::Length {
            argument: name(argument),
            expected,
            found,
        },
        Error::Invalid {
            argument,
            item: row,
            flaw,
        } => Error::Invalid {
            argument: name(argument),
            item: row,
            flaw,
        },
        Error::NoLargest { argument } => Error::NoLargest {
            argument: name(argument),
        },
        Error::GroupsOf { argument, item } => Error::GroupsOf {
            argument: name(argument),
            item,
        },
        _ => error,
    }
}
