//! Columns: one argument of every item.
//!
//! A *column* is a slice of shapes, or [`One`] that stands for all. Several columns are a tuple: `(&points, One(circle))`.
//! Results come out column by column, too: a batch whose result is a number and a shape gives `(Vec<f64>, Vec<Shape>)`.
use super::{Here, Place};
use crate::kernels::item::{Item, by_shape, leaves_of, memory, put, width};
use crate::kernels::resident::Stays;
use crate::{Fixed, Pack, Real};
use std::borrow::Cow;
use std::ops::Range;

/// Reads the numbers of some shapes, one after another.
type Read<'a, T> = Box<dyn Fn(Range<usize>, &mut [T]) + Send + Sync + 'a>;

/// The numbers of a column, in memory or by a function.
enum Numbers<'a, T> {
    Lent(&'a [T]),
    Read(Read<'a, T>),
}

/// One argument of every item, as numbers.
pub struct Column<'a, T> {
    numbers: Numbers<'a, T>,
    /// Numbers per item.
    pub fields: usize,
    /// How many items; `None` for one that stands for any number.
    pub count: Option<usize>,
    /// The column on the machine, if it stays there.
    pub(crate) held: Option<&'a dyn Stays<T>>,
}

impl<'a, T: Real> Column<'a, T> {
    /// Shapes as a column.
    pub(crate) fn of<P: Item<Scalar = T>>(shapes: &'a [P]) -> Self {
        let numbers = match memory::lent(shapes) {
            Some(numbers) => Numbers::Lent(numbers),
            None => Numbers::Read(Box::new(move |items, rows| {
                let rows = rows.chunks_exact_mut(width::<P>());
                for (shape, row) in shapes[items].iter().zip(rows) {
                    put(*shape, row);
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
    /// A column that stays on a machine, with its numbers if that is the CPU.
    pub(crate) fn held(own: &'a dyn Stays<T>, count: usize) -> Self {
        Column {
            held: Some(own),
            ..Column::lent(own.here().unwrap_or_default(), own.fields(), Some(count))
        }
    }
    /// Numbers of shapes, one shape after another; `None` items for one that stands for any number.
    pub(crate) fn lent(numbers: &'a [T], fields: usize, count: Option<usize>) -> Self {
        Column {
            numbers: Numbers::Lent(numbers),
            fields,
            count,
            held: None,
        }
    }
    /// Numbers that are read when they are needed.
    pub(crate) fn read(
        fields: usize,
        count: usize,
        read: impl Fn(Range<usize>, &mut [T]) + Send + Sync + 'a,
    ) -> Self {
        Column {
            numbers: Numbers::Read(Box::new(read)),
            fields,
            count: Some(count),
            held: None,
        }
    }
    /// Some numbers of every shape of a list.
    fn part<P: Item<Scalar = T>>(shapes: &'a [P], part: Range<usize>) -> Self {
        let fields = part.len();
        Column {
            numbers: Numbers::Read(Box::new(move |items, rows| {
                let mut all = vec![T::default(); width::<P>()];
                let mut scalars = vec![T::default(); P::LEN];
                for (shape, row) in shapes[items].iter().zip(rows.chunks_exact_mut(fields)) {
                    shape.store(&mut scalars);
                    by_shape::<P>(&scalars, &shape.codes(), &mut all);
                    row.copy_from_slice(&all[part.clone()]);
                }
            })),
            fields,
            count: Some(shapes.len()),
            held: None,
        }
    }
    /// How many items it holds itself.
    pub(crate) fn len(&self) -> usize {
        self.count.unwrap_or(1)
    }
    /// The numbers of some items, as they lie in memory or written into `room`.
    pub(crate) fn numbers<'r>(&'r self, items: Range<usize>, room: &'r mut Vec<T>) -> &'r [T] {
        let items = match self.count {
            Some(_) => items,
            None => 0..1,
        };
        match &self.numbers {
            Numbers::Lent(numbers) => &numbers[items.start * self.fields..items.end * self.fields],
            Numbers::Read(read) => {
                room.resize(items.len() * self.fields, T::default());
                read(items, room);
                room
            }
        }
    }
    /// All its numbers.
    pub(crate) fn all(&self) -> Cow<'_, [T]> {
        match &self.numbers {
            Numbers::Lent(numbers) => Cow::Borrowed(numbers),
            Numbers::Read(read) => {
                let mut room = vec![T::default(); self.len() * self.fields];
                read(0..self.len(), &mut room);
                Cow::Owned(room)
            }
        }
    }
}

/// One shape that stands for all items of its column.
///
/// ```
/// use geograd::kernels::{Cpu, Iou, One};
/// use geograd::Obb2;
/// let goal = Obb2::new(0.0_f64, 0.0, 2.0, 2.0, 0.0);
/// let boxes = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), goal];
/// assert_eq!(Cpu::new().aligned(Iou, (&boxes, One(goal)))?, [1.0 / 3.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct One<P>(pub P);

/// The arguments of a batch: a slice or vector of shapes or numbers, [`One`], an array on the machine
/// ([`Held`](crate::kernels::resident::Held)), or a tuple of such.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a column",
    label = "not a column",
    note = "a column is a slice, `&a` or `&a[..]`, one shape for all items, `One(shape)`, or an array on the machine",
    note = "a tuple has two to six columns; arrays, tuples and derived shapes hold more arguments in one"
)]
pub trait Columns {
    /// The arguments of one item.
    type Item: Item;
    /// The place of the columns and their results: the memory of the program or the machine.
    type Place: Place;
    /// The columns, one per shape of an item.
    #[doc(hidden)]
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, <Self::Item as Pack>::Scalar>));
    /// The items as one column, for a list of all pairs. By default the first column: an item of a list is a
    /// [`Single`](crate::kernels::Single), which has no other.
    #[doc(hidden)]
    fn list_of_shapes(&self) -> Column<'_, <Self::Item as Pack>::Scalar> {
        let mut first = None;
        self.list(&mut |column| first = first.take().or(Some(column)));
        first.unwrap_or_else(|| Column::lent(&[], 0, Some(0)))
    }
}

fn list_slice<'a, P: Item>(shapes: &'a [P], add: &mut dyn FnMut(Column<'a, P::Scalar>)) {
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

/// Shapes in memory.
macro_rules! slices {
    ($(($($length:tt)*) $list:ty;)*) => { $(
        impl<P: Item $($length)*> Columns for $list {
            type Item = P;
            type Place = Here;
            fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, P::Scalar>)) {
                list_slice(&self[..], add);
            }
            fn list_of_shapes(&self) -> Column<'_, P::Scalar> {
                Column::of(&self[..])
            }
        }
    )* };
}
slices!(() &[P]; () &Vec<P>; (, const N: usize) &[P; N];);

impl<P: Item> Columns for One<P> {
    type Item = P;
    type Place = Here;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, P::Scalar>)) {
        list_slice(std::slice::from_ref(&self.0), &mut |column| {
            add(Column {
                count: None,
                ..column
            })
        });
    }
    fn list_of_shapes(&self) -> Column<'_, P::Scalar> {
        Column::of(std::slice::from_ref(&self.0))
    }
}

/// The place of several columns.
macro_rules! joined {
    ($last:ident) => { $last::Place };
    ($first:ident $($name:ident)+) => { <$first::Place as Place>::With<joined!($($name)+)> };
}

/// Columns of several arguments.
macro_rules! columns {
    ($($first:ident $($name:ident)*;)*) => { $(
        impl<$first: Columns, $($name: Columns),*> Columns for ($first, $($name,)*)
        where
            $($name::Item: Fixed<Scalar = <$first::Item as Pack>::Scalar>,)*
        {
            type Item = ($first::Item, $($name::Item,)*);
            type Place = joined!($first $($name)*);
            #[allow(non_snake_case)]
            fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, <$first::Item as Pack>::Scalar>)) {
                let ($first, $($name,)*) = self;
                $first.list(add);
                $($name.list(add);)*
            }
        }
    )* };
}
columns!(A B; A B C; A B C D; A B C D E; A B C D E F;);
