//! Columns: the arguments of a batch.
//!
//! A *column* is a slice of shapes, or [`One`] that stands for all. Several columns are a tuple:
//! `(&points, One(circle))`. Results are columns, too: a batch whose result is a number and a shape returns
//! `(Vec<f64>, Vec<Shape>)`.
use super::column::{Column, list_of};
use super::held::Held;
use super::{Here, Place, There};
use crate::kernels::row::item::{Item, width};
use crate::{Fixed, Pack};

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
/// ([`Held`](crate::kernels::resident::Held)), or a tuple of these.
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
    /// Passes the columns to `add`, one per shape of an item.
    #[doc(hidden)]
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, <Self::Item as Pack>::Scalar>));
    /// Returns the items as one column, for a list of all pairs. The default is the only column of a
    /// [`Single`](crate::kernels::Single) shape.
    #[doc(hidden)]
    fn list_of_shapes(&self) -> Column<'_, <Self::Item as Pack>::Scalar> {
        let mut first = None;
        self.list(&mut |column| first = first.take().or(Some(column)));
        first.unwrap_or_else(|| Column::lent(&[], 0, Some(0)))
    }
}

/// Shapes in memory.
macro_rules! slices {
    ($(($($length:tt)*) $list:ty;)*) => { $(
        impl<P: Item $($length)*> Columns for $list {
            type Item = P;
            type Place = Here;
            fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, P::Scalar>)) {
                list_of(&self[..], add);
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
        list_of(std::slice::from_ref(&self.0), &mut |column| {
            add(column.repeated())
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

impl<R: Item> Columns for &Held<R> {
    type Item = R;
    type Place = There;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, R::Scalar>)) {
        self.stored().columns().for_each(add);
    }
    fn list_of_shapes(&self) -> Column<'_, R::Scalar> {
        let first = self.stored().columns().next();
        first.unwrap_or_else(|| Column::lent(&[], width::<R>(), Some(self.len())))
    }
}

/// The number type of columns.
pub(crate) type Number<C> = <<C as Columns>::Item as Pack>::Scalar;

/// Returns the columns as a list.
pub(crate) fn listed<C: Columns>(columns: &C) -> Vec<Column<'_, Number<C>>> {
    let mut all = Vec::new();
    columns.list(&mut |column| all.push(column));
    all
}
