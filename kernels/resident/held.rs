//! Columns that stay on the machine between calls.
use super::{Pending, Side};
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::{check, expect};
use crate::kernels::cpu::plan::Preparation;
use crate::kernels::gpu;
use crate::kernels::item::{Column, Columns, Item, One, Single, get, leaves_of, targets_of, width};
use std::fmt;
use std::marker::PhantomData;

/// Numbers of one shape of every item.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Numbers {
    pub(super) fields: usize,
    pub(super) rows: Vec<f32>,
}

/// A handle of items on the machine: shapes, numbers, or results of several of both.
///
/// On the CPU these are plain vectors. On a GPU they lie in buffers; what an operation wants prepared
/// beforehand (sines of headings, frames of boxes) is computed at its first call and kept.
pub struct Held<R> {
    pub(super) count: usize,
    pub(super) columns: Side<Vec<Numbers>, Vec<gpu::HeldColumn>>,
    row: PhantomData<fn() -> R>,
}

impl<R> fmt::Debug for Held<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = match self.columns {
            Side::Cpu(_) => "CPU",
            Side::Gpu(_) => "GPU",
        };
        f.debug_struct("Held")
            .field("count", &self.count)
            .field("place", &place)
            .finish()
    }
}

impl<R> Held<R> {
    pub(super) fn new(count: usize, columns: Side<Vec<Numbers>, Vec<gpu::HeldColumn>>) -> Self {
        Held {
            count,
            columns,
            row: PhantomData,
        }
    }
    /// The number of items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }
    /// `true` without items.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
    /// The numbers of the items: those of the first shape of every item, item by item, then those of the
    /// second.
    ///
    /// ```
    /// use geograd::kernels::Backend;
    /// let held = Backend::Cpu.resident().upload(&[([1.0_f32, 2.0], 3.0_f32), ([4.0, 5.0], 6.0)])?;
    /// assert_eq!(held.numbers()?, [vec![1.0, 2.0, 4.0, 5.0], vec![3.0, 6.0]]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        match &self.columns {
            Side::Cpu(own) => Ok(own.iter().map(|own| own.rows.clone()).collect()),
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => gpu::held::start_download(own)?.wait(),
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => Err(Error::Gpu(crate::GpuFault::NotBuilt)),
        }
    }
}

/// The numbers of rows, checked, shape by shape.
pub(super) fn numbers_of<R: Item<Scalar = f32>>(rows: &[R]) -> Result<Vec<Numbers>, Error> {
    let columns = &rows;
    let mut all = Vec::new();
    let mut leaves = leaves_of::<R>().into_iter();
    let mut flaw = Ok(());
    columns.list(&mut |column| {
        let Some(leaf) = leaves.next() else { return };
        if flaw.is_ok() {
            flaw = check(Argument::Shape, &Preparation::plain(leaf), &column).map(drop);
        }
        all.push(Numbers {
            fields: leaf.fields,
            rows: column.all().into_owned(),
        });
    });
    flaw.map(|()| all)
}

/// Results of their numbers, shape by shape.
fn many_of<R: Item<Scalar = f32>>(count: usize, columns: &[Vec<f32>]) -> R::Many {
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

impl<R: Item<Scalar = f32>> Held<R> {
    /// Downloads the items and waits for them: a vector, or one for every shape of a result.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn download(&self) -> Result<R::Many, Error> {
        Ok(many_of::<R>(self.count, &self.numbers()?))
    }

    /// Starts the download of the items, which is complete at once on the CPU.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<Pending<R::Many>, Error> {
        match &self.columns {
            Side::Cpu(_) => Ok(Pending(Side::Cpu(Some(self.download()?)))),
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => {
                let count = self.count;
                let arriving = gpu::held::start_download(own)?;
                let made = move |numbers: Vec<Vec<f32>>| many_of::<R>(count, &numbers);
                Ok(Pending(Side::Gpu(arriving.map(made))))
            }
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => Err(Error::Gpu(crate::GpuFault::NotBuilt)),
        }
    }

    /// Replaces the items by as many others, as a loop does that moves them. On a GPU it reuses the buffer.
    ///
    /// # Errors
    ///
    /// The input's for another number of items or one that is not valid (the old ones are then as they
    /// were), or what the device says.
    pub fn update(&mut self, items: &[R]) -> Result<(), Error> {
        expect(Argument::Shape, self.count, items.len())?;
        let numbers = numbers_of(items)?;
        match &mut self.columns {
            Side::Cpu(own) => *own = numbers,
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => {
                for (own, numbers) in own.iter_mut().zip(numbers) {
                    own.update(numbers.rows);
                }
            }
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => return Err(Error::Gpu(crate::GpuFault::NotBuilt)),
        }
        Ok(())
    }
}

/// Results of several shapes as handles of their own.
macro_rules! split {
    ($($first:ident $($name:ident)*;)*) => { $(
        impl<$first: Item<Scalar = f32>, $($name: Item<Scalar = f32>),*> Held<($first, $($name,)*)> {
            /// The parts of every item, each as a handle of its own. No data are copied.
            #[must_use]
            #[allow(non_snake_case)]
            pub fn split(self) -> (Held<$first>, $(Held<$name>,)*) {
                let count = self.count;
                let counts = [leaves_of::<$first>().len(), $(leaves_of::<$name>().len(),)*];
                let mut parts = match self.columns {
                    Side::Cpu(own) => portions(own, &counts).map(Side::Cpu).collect::<Vec<_>>(),
                    Side::Gpu(own) => portions(own, &counts).map(Side::Gpu).collect::<Vec<_>>(),
                }
                .into_iter();
                let mut next = || parts.next().unwrap_or(Side::Cpu(Vec::new()));
                let $first = Held::new(count, next());
                $(let $name = Held::new(count, next());)*
                ($first, $($name,)*)
            }
        }
    )* };
}
split!(A B; A B C; A B C D; A B C D E; A B C D E F;);

/// A list cut into so many each.
fn portions<T>(all: Vec<T>, counts: &[usize]) -> impl Iterator<Item = Vec<T>> {
    let mut all = all.into_iter();
    counts.iter().map(move |&n| all.by_ref().take(n).collect())
}

/// One argument of a call: a handle or a shape that all items share.
#[doc(hidden)]
#[derive(Debug)]
pub enum Given<'a> {
    Cpu(&'a Numbers, usize),
    Gpu(&'a gpu::HeldColumn),
    One(Vec<f32>),
}

/// The arguments of a batch on handles: a handle, [`One`], or a tuple of them.
pub trait HeldColumns {
    /// The arguments of one item.
    type Item: Item<Scalar = f32>;
    /// The columns, one per shape of a row.
    #[doc(hidden)]
    fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>));
}

impl<R: Item<Scalar = f32>> HeldColumns for &Held<R> {
    type Item = R;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>)) {
        match &self.columns {
            Side::Cpu(own) => own.iter().for_each(|own| add(Given::Cpu(own, self.count))),
            Side::Gpu(own) => own.iter().for_each(|own| add(Given::Gpu(own))),
        }
    }
}

impl<R: Item<Scalar = f32>> HeldColumns for One<R> {
    type Item = R;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>)) {
        Columns::list(self, &mut |column| {
            add(Given::One(column.all().into_owned()))
        });
    }
}

/// Arguments of several columns.
macro_rules! columns {
    ($($first:ident $($name:ident)*;)*) => { $(
        impl<$first: HeldColumns, $($name: HeldColumns),*> HeldColumns for ($first, $($name,)*) {
            type Item = ($first::Item, $($name::Item,)*);
            #[allow(non_snake_case)]
            fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>)) {
                let ($first, $($name,)*) = self;
                $first.list(add);
                $($name.list(add);)*
            }
        }
    )* };
}
columns!(A B; A B C; A B C D; A B C D E; A B C D E F;);

/// Shapes on the processor.
pub(super) fn shapes_of<P: Single<Scalar = f32>>(held: &Held<P>) -> Result<Vec<P>, Error> {
    match &held.columns {
        Side::Cpu(own) => {
            let rows = own
                .iter()
                .flat_map(|own| own.rows.chunks_exact(width::<P>().max(1)));
            Ok(rows.map(get::<P>).collect())
        }
        Side::Gpu(_) => Err(foreign()),
    }
}

pub(super) fn foreign() -> Error {
    Error::Gpu(crate::GpuFault::ForeignBuffer)
}

/// Shapes that were computed on the processor.
pub(super) fn held_of<P: Single<Scalar = f32>>(shapes: &[P]) -> Held<P> {
    let numbers = Numbers {
        fields: width::<P>(),
        rows: Column::of(shapes).all().into_owned(),
    };
    Held::new(shapes.len(), Side::Cpu(vec![numbers]))
}
