//! Columns of plain numbers, and what is asked of them.
use crate::Fixed;
use crate::error::{Argument, Error, Field, Validate};
use crate::kernels::cpu::checked::expect;
use crate::kernels::item::{Column, Item, Leaf, leaf};
use crate::kernels::real::Real;

/// One argument of every item as plain numbers: rows of so many fields, one after another.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, T> {
    numbers: &'a [T],
    fields: usize,
    is_one: bool,
}

impl<'a, T: Real> Rows<'a, T> {
    /// Rows of so many fields each.
    #[must_use]
    pub const fn new(numbers: &'a [T], fields: usize) -> Self {
        Rows {
            numbers,
            fields,
            is_one: false,
        }
    }
    /// One row that stands for all items.
    #[must_use]
    pub const fn one(row: &'a [T]) -> Self {
        Rows {
            numbers: row,
            fields: row.len(),
            is_one: true,
        }
    }
    /// The numbers, row by row.
    #[must_use]
    pub const fn numbers(&self) -> &'a [T] {
        self.numbers
    }
    /// How many rows there are; `None` for one that stands for all.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        (!self.is_one).then(|| self.numbers.len().checked_div(self.fields).unwrap_or(0))
    }
    /// Numbers of a row.
    #[must_use]
    pub const fn fields(&self) -> usize {
        self.fields
    }
    /// As a column of rows of so many fields.
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
        let whole = self.numbers.len() - self.numbers.len() % expected.max(1);
        expect(argument, whole, self.numbers.len())?;
        Ok(Column::lent(self.numbers, self.fields, self.count()))
    }
}

/// The meaning of a column of numbers: fields of a row, their names, and which values are valid.
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
    /// So many finite numbers.
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
    /// A shape.
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
    /// The name of the shape; `number` or `numbers` without one.
    #[must_use]
    pub fn name(&self) -> String {
        match ((self.leaf.shape)(), self.leaf.fields) {
            ("", 1) => "number".to_owned(),
            ("", _) => "numbers".to_owned(),
            (name, _) => shape_name(name),
        }
    }
    /// Numbers of a row: scalars, then whole numbers.
    #[must_use]
    pub const fn fields(&self) -> usize {
        self.leaf.fields
    }
    /// How many of them are whole numbers, which have no derivatives.
    #[must_use]
    pub const fn codes(&self) -> usize {
        self.leaf.codes
    }
    /// The names of its scalars.
    #[must_use]
    pub fn names(&self) -> Vec<Field> {
        let scalars = 0..self.leaf.fields - self.leaf.codes;
        scalars.map(self.leaf.name).collect()
    }
    /// `Ok` when a row is valid.
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

/// The name of a shape, from that of its type: without paths and without the format of its numbers.
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

/// The names of arguments: their own, or those of their places.
pub(super) fn named(names: &[&'static str], count: usize) -> Vec<Argument> {
    (0..count)
        .map(|k| match names.get(k) {
            Some(name) if names.len() == count => Argument::Named(name),
            _ => Argument::input(k),
        })
        .collect()
}

/// An error with the names of arguments in place of their letters.
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
        Error::GroupsOf { argument, item } => Error::GroupsOf {
            argument: name(argument),
            item,
        },
        _ => error,
    }
}
