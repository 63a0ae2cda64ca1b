//! Columns that stay between calls of any operation.
use super::Side;

use crate::error::{Argument, Error};
use crate::kernels::Cpu;
use crate::kernels::backend::Backend;
use crate::kernels::cpu::checked::{check, expect};
use crate::kernels::cpu::plan::Preparation;
use crate::kernels::gpu;
use crate::kernels::op::Runs;
use crate::kernels::row::{
    Column, Columns, One, Row, Single, Target, get, leaves_of, targets_of, width,
};
use std::fmt;
use std::marker::PhantomData;

mod pairs;

/// Numbers of one shape of every item.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Numbers {
    fields: usize,
    rows: Vec<f32>,
}

/// Items that stay where they were computed or brought: shapes, numbers, or results of several of both.
///
/// On the CPU these are plain vectors. On a GPU they lie in buffers; what an operation wants prepared
/// beforehand (sines of headings, frames of boxes) is computed at its first call and kept.
pub struct Held<R> {
    count: usize,
    columns: Side<Vec<Numbers>, Vec<gpu::HeldColumn>>,
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
    fn new(count: usize, columns: Side<Vec<Numbers>, Vec<gpu::HeldColumn>>) -> Self {
        Held {
            count,
            columns,
            row: PhantomData,
        }
    }
    /// How many items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// The numbers of rows, checked, shape by shape.
fn numbers_of<R: Row<Scalar = f32>>(rows: &[R]) -> Result<Vec<Numbers>, Error> {
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
fn many_of<R: Row<Scalar = f32>>(count: usize, columns: &[Vec<f32>]) -> R::Many {
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

impl<R: Row<Scalar = f32>> Held<R> {
    /// Brings the items back and waits for them: a vector, or one for every shape of a result.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<R::Many, Error> {
        Ok(many_of::<R>(self.count, &self.numbers()?))
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
    /// What the device says.
    pub fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        match &self.columns {
            Side::Cpu(own) => Ok(own.iter().map(|own| own.rows.clone()).collect()),
            #[cfg(feature = "gpu")]
            Side::Gpu(own) => gpu::held::start_download(own)?.wait(),
            #[cfg(not(feature = "gpu"))]
            Side::Gpu(_) => Err(Error::Gpu(crate::GpuFault::NotBuilt)),
        }
    }

    /// Puts as many other items in their place: what a loop does that moves them. On a GPU no buffer is
    /// made.
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
        impl<$first: Row<Scalar = f32>, $($name: Row<Scalar = f32>),*> Held<($first, $($name,)*)> {
            /// The parts of every item, each as a handle of its own. Nothing moves.
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

/// One argument of a call, wherever it is.
#[doc(hidden)]
#[derive(Debug)]
pub enum Given<'a> {
    Cpu(&'a Numbers, usize),
    Gpu(&'a gpu::HeldColumn),
    One(Vec<f32>),
}

/// The arguments of a batch that stay: a handle, [`One`], or a tuple of such.
pub trait HeldColumns {
    /// The arguments of one item.
    type Row: Row<Scalar = f32>;
    /// The columns, one per shape of a row.
    #[doc(hidden)]
    fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>));
}

impl<R: Row<Scalar = f32>> HeldColumns for &Held<R> {
    type Row = R;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Given<'a>)) {
        match &self.columns {
            Side::Cpu(own) => own.iter().for_each(|own| add(Given::Cpu(own, self.count))),
            Side::Gpu(own) => own.iter().for_each(|own| add(Given::Gpu(own))),
        }
    }
}

impl<R: Row<Scalar = f32>> HeldColumns for One<R> {
    type Row = R;
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
            type Row = ($first::Row, $($name::Row,)*);
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

/// Columns for the processor.
struct OnCpu<'a, R> {
    given: &'a [Given<'a>],
    row: PhantomData<fn() -> R>,
}

impl<R: Row<Scalar = f32>> Columns for OnCpu<'_, R> {
    type Row = R;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, f32>)) {
        for given in self.given {
            add(match given {
                Given::Cpu(own, count) => Column::lent(&own.rows, own.fields, Some(*count)),
                Given::One(numbers) => Column::lent(numbers, numbers.len(), None),
                // Refused before.
                Given::Gpu(_) => Column::lent(&[], 1, Some(0)),
            });
        }
    }
}

/// Batches of any operation over columns that stay, behind one front: the calls of [`Cpu`].
///
/// ```
/// use geograd::kernels::{Backend, DistancePointSegment, IouObb3, Op, One};
/// use geograd::shape::{Obb3, Rotation3};
/// use geograd::{Segment2, Vec2, Vec3};
/// let resident = Backend::Cpu.resident(); // or of a GPU
///
/// let boxes = |turn| {
///     let size = Vec3::new(4.0, 2.0, 1.5);
///     [0.0, 5.0].map(|x| Obb3::new(Vec3::new(x, 0.0, 0.0), size, Rotation3::new(1.0, 0.0, 0.0, turn)))
/// };
/// let (a, b) = (resident.upload(&boxes(0.0))?, resident.upload(&boxes(0.1))?);
/// let iou = resident.aligned(IouObb3, (&a, &b))?; // stays there
/// let matrix = resident.all_pairs(IouObb3, &a, &b)?; // of the same boxes: nothing goes up again
/// assert_eq!(matrix.download()?[3], iou.download()?[1]);
///
/// // Results are arguments of what comes next: here slopes, times those of what is made of the distances.
/// let points = resident.upload(&[Vec2::new(0.0, 1.0), Vec2::new(3.0, 0.0)])?;
/// let wall = One(Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(2.0, 0.0)));
/// let (distances, _) = resident.aligned(DistancePointSegment.value_grad(), (&points, wall))?.split();
/// let slopes = resident.aligned(DistancePointSegment.vjp(), ((&points, wall), &distances))?;
/// assert_eq!(slopes.download()?.0, [Vec2::new(0.0, 1.0), Vec2::new(1.0, 0.0)]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Resident<'a>(Backend<'a>);

impl<'a> Backend<'a> {
    /// Batches of any operation whose arguments and results stay where it computes.
    #[must_use]
    pub fn resident(self) -> Resident<'a> {
        Resident(self)
    }
}

/// The columns of a call as a list.
fn listed<C: HeldColumns>(columns: &C) -> Vec<Given<'_>> {
    let mut all = Vec::new();
    columns.list(&mut |given| all.push(given));
    all
}

/// Shapes on the processor.
fn shapes_of<P: Single<Scalar = f32>>(held: &Held<P>) -> Result<Vec<P>, Error> {
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

fn foreign() -> Error {
    Error::Gpu(crate::GpuFault::ForeignBuffer)
}

/// Shapes that were computed on the processor.
fn held_of<P: Single<Scalar = f32>>(shapes: &[P]) -> Held<P> {
    let numbers = Numbers {
        fields: width::<P>(),
        rows: Column::of(shapes).all().into_owned(),
    };
    Held::new(shapes.len(), Side::Cpu(vec![numbers]))
}

#[cfg(feature = "gpu")]
mod on_gpu {
    use super::{Error, Given, Held, Side, foreign, gpu};

    /// The only column of a list of shapes.
    pub fn column<P>(held: &Held<P>) -> Result<&gpu::HeldColumn, Error> {
        match &held.columns {
            Side::Gpu(own) => own.first().ok_or_else(foreign),
            Side::Cpu(_) => Err(foreign()),
        }
    }

    /// Arguments that are there.
    pub fn given<'a>(all: &'a [Given<'a>]) -> Result<Vec<gpu::Given<'a>>, Error> {
        all.iter()
            .map(|given| match given {
                Given::Gpu(own) => Ok(gpu::Given::Held(own)),
                Given::One(numbers) => Ok(gpu::Given::One(numbers)),
                Given::Cpu(..) => Err(foreign()),
            })
            .collect()
    }
}

impl Resident<'_> {
    /// Checks items and brings them to where it computes.
    ///
    /// # Errors
    ///
    /// The input's for a shape that is not valid, or what the device says.
    pub fn upload<R: Row<Scalar = f32>>(self, items: &[R]) -> Result<Held<R>, Error> {
        let numbers = numbers_of(items)?;
        let columns = match self.0 {
            Backend::Cpu => Side::Cpu(numbers),
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => Side::Gpu(
                numbers
                    .into_iter()
                    .map(|own| gpu::HeldColumn::new(gpu, own.fields, own.rows))
                    .collect::<Result<_, _>>()?,
            ),
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        };
        Ok(Held::new(items.len(), columns))
    }

    /// Item i of every column, as [`Cpu::aligned`]: one result per item, which stays.
    ///
    /// What a GPU computed is not looked at before it is computed with; the CPU refuses what is not valid.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] when columns differ in length, [`Error::Program`] on a GPU for what searches,
    /// [`GpuFault::ForeignBuffer`](crate::GpuFault::ForeignBuffer) for handles of other backends, or what
    /// the device says.
    pub fn aligned<C: HeldColumns, R: Runs<C::Row>>(
        self,
        run: R,
        columns: C,
    ) -> Result<Held<R::Out>, Error> {
        let given = listed(&columns);
        match self.0 {
            Backend::Cpu => {
                let mut held = Held::new(0, Side::Cpu(Vec::new()));
                compute::<C::Row, R>(run, &given, &mut held)?;
                Ok(held)
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(gpu) => {
                let made = run.generated(crate::kernels::op::Ask::ALIGNED)?;
                let given = on_gpu::given(&given)?;
                Ok(of_gpu(gpu.programs().held_aligned(&made, &given, &[])?))
            }
            #[cfg(not(feature = "gpu"))]
            Backend::Gpu(gpu) => match *gpu {},
        }
    }

    /// [`aligned`](Resident::aligned) over results that are there already: in the same buffers, if no
    /// other handle has a part of them.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Resident::aligned), and [`Error::Length`] for another number of results.
    pub fn aligned_into<C: HeldColumns, R: Runs<C::Row>>(
        self,
        run: R,
        columns: C,
        results: &mut Held<R::Out>,
    ) -> Result<(), Error> {
        let given = listed(&columns);
        match (self.0, &results.columns) {
            (Backend::Cpu, Side::Cpu(_)) => {
                let count = count_of(&given)?;
                expect(Argument::Values, count, results.count)?;
                compute::<C::Row, R>(run, &given, results)
            }
            #[cfg(feature = "gpu")]
            (Backend::Gpu(gpu), Side::Gpu(over)) => {
                let made = run.generated(crate::kernels::op::Ask::ALIGNED)?;
                let given = on_gpu::given(&given)?;
                let programs = gpu.programs();
                expect(
                    Argument::Values,
                    programs.held_count(&made, &given)?,
                    results.count,
                )?;
                let found = programs.held_aligned(&made, &given, over)?;
                results.columns = Side::Gpu(found);
                Ok(())
            }
            _ => Err(foreign()),
        }
    }
}

/// Results of a GPU.
#[cfg(feature = "gpu")]
fn of_gpu<R>(columns: Vec<gpu::HeldColumn>) -> Held<R> {
    let count = columns.first().map_or(0, gpu::HeldColumn::count);
    Held::new(count, Side::Gpu(columns))
}

/// How many items there are on the processor: those of the first column. That others have as many is for
/// the call to say.
fn count_of(given: &[Given<'_>]) -> Result<usize, Error> {
    if given.iter().any(|given| matches!(given, Given::Gpu(_))) {
        return Err(foreign());
    }
    let counts = given.iter().find_map(|given| match given {
        Given::Cpu(_, count) => Some(*count),
        _ => None,
    });
    Ok(counts.unwrap_or(1))
}

/// Item i of every column, on the processor.
fn compute<R: Row<Scalar = f32>, F: Runs<R>>(
    run: F,
    given: &[Given<'_>],
    results: &mut Held<F::Out>,
) -> Result<(), Error> {
    let count = count_of(given)?;
    let leaves = leaves_of::<F::Out>();
    let mut found: Vec<Numbers> = leaves
        .iter()
        .map(|leaf| Numbers {
            fields: leaf.fields,
            rows: vec![0.0; leaf.fields * count],
        })
        .collect();
    let targets = found
        .iter_mut()
        .map(|own| Some(Target::of_rows(&mut own.rows, own.fields)));
    let columns = OnCpu::<R> {
        given,
        row: PhantomData,
    };
    Cpu::new().run_into(run, columns, targets.collect())?;
    *results = Held::new(count, Side::Cpu(found));
    Ok(())
}
