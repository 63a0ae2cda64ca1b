//! Arrays of items that stay on the machine between calls.
use super::column::list_of;
use super::machine_column::Numbers;
use super::pending::Pending;
use super::stored::Stored;
use crate::error::{Argument, Error};
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{Item, Leaf, Results, leaves_of, targets_of};
use std::fmt;
use std::marker::PhantomData;

/// An array on the machine: shapes, numbers, or tuples of these.
///
/// On the CPU these are plain vectors, on a GPU buffers. A GPU keeps what an operation prepares of them at its first
/// call (sines of headings, frames of boxes), the CPU the boxes around their shapes among which it searches for the
/// nearest.
pub struct Held<R: Results> {
    stored: Stored<R::Scalar>,
    item: PhantomData<fn() -> R>,
}

impl<R: Results> fmt::Debug for Held<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_here = self.stored.columns.iter().all(|own| own.here().is_some());
        f.debug_struct("Held")
            .field("count", &self.stored.len())
            .field("place", &if is_here { "CPU" } else { "GPU" })
            .finish()
    }
}

impl<R: Results> Held<R> {
    pub(crate) fn of(stored: Stored<R::Scalar>) -> Self {
        Held {
            stored,
            item: PhantomData,
        }
    }
    pub(crate) fn stored(&self) -> &Stored<R::Scalar> {
        &self.stored
    }
    pub(crate) fn stored_mut(&mut self) -> &mut Stored<R::Scalar> {
        &mut self.stored
    }
    /// Returns the number of items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.stored.len()
    }
    /// Returns `true` without items.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.stored.is_empty()
    }
    /// Returns the numbers of the items: of the first shape of every item, item by item, then of the second.
    ///
    /// ```
    /// use geograd::kernels::Backend;
    /// let held = Backend::Cpu.upload(&[([1.0_f32, 2.0], 3.0_f32), ([4.0, 5.0], 6.0)])?;
    /// assert_eq!(held.numbers()?, [vec![1.0, 2.0, 4.0, 5.0], vec![3.0, 6.0]]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn numbers(&self) -> Result<Vec<Vec<R::Scalar>>, Error> {
        self.stored.numbers()
    }
}

/// Returns the numbers of items, shape by shape, after `check`, a function of the index of the shape.
pub(crate) fn numbers_of<R: Item>(
    items: &[R],
    check: impl Fn(usize, Leaf<R::Scalar>, &[R::Scalar]) -> Result<(), Error>,
) -> Result<Vec<Numbers<R::Scalar>>, Error> {
    let mut all = Vec::new();
    let mut leaves = leaves_of::<R>().into_iter();
    let mut flaw = Ok(());
    list_of(items, &mut |column| {
        let Some(leaf) = leaves.next() else { return };
        let (fields, rows) = (leaf.fields, column.all().into_owned());
        if flaw.is_ok() {
            flaw = check(all.len(), leaf, &rows);
        }
        all.push(Numbers::new(fields, rows));
    });
    flaw.map(|()| all)
}

/// Converts numbers, shape by shape, to items.
fn many_of<R: Item>(count: usize, columns: &[Vec<R::Scalar>]) -> <R as Item>::Many {
    let mut many = R::many(count);
    for (target, numbers) in targets_of::<R>(&mut many).into_iter().zip(columns) {
        let mut rest = &numbers[..];
        for mut piece in target.pieces() {
            let room = piece.numbers();
            let (own, left) = rest.split_at(room.len());
            room.copy_from_slice(own);
            rest = left;
            piece.finish();
        }
    }
    many
}

impl<R: Item> Held<R> {
    /// Downloads the items and waits for them. Returns a vector, or one for every shape of a result.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn download(&self) -> Result<<R as Item>::Many, Error> {
        Ok(many_of::<R>(self.len(), &self.numbers()?))
    }

    /// Starts the download of the items, which is complete at once on the CPU.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<Pending<<R as Item>::Many>, Error>
    where
        <R as Item>::Many: 'static,
    {
        let count = self.len();
        let arriving = self.stored.started()?;
        Ok(arriving.map(move |numbers| many_of::<R>(count, &numbers)))
    }

    /// Replaces the items by as many others, such as in a loop that moves them. A GPU reuses its buffers.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another number of items, [`Error::Invalid`] for one that is not valid (no item changes
    /// then), and the errors of the device.
    pub fn update(&mut self, items: &[R]) -> Result<(), Error> {
        expect(Argument::Shape, self.len(), items.len())?;
        let own = &self.stored.columns;
        let numbers = numbers_of(items, |k, leaf, rows| own[k].check(leaf, rows))?;
        for (own, numbers) in self.stored.columns.iter_mut().zip(numbers) {
            own.update(numbers.rows);
        }
        Ok(())
    }
}

/// Implements the split of tuples into arrays.
macro_rules! split {
    ($($first:ident $($name:ident)*;)*) => { $(
        impl<$first: Item, $($name: Item<Scalar = $first::Scalar>),*> Held<($first, $($name,)*)> {
            /// Splits items that are tuples into one array per entry, without a copy.
            #[must_use]
            #[allow(non_snake_case)]
            pub fn split(self) -> (Held<$first>, $(Held<$name>,)*) {
                let [$first, others] = self.stored.cut(leaves_of::<$first>().len());
                $(let [$name, others] = others.cut(leaves_of::<$name>().len());)*
                drop(others);
                (Held::of($first), $(Held::of($name),)*)
            }
        }
    )* };
}
split!(A B; A B C; A B C D; A B C D E; A B C D E F;);
