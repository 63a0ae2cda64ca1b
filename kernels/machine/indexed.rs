//! Columns by indices: every item is made of items of a shared column.
//!
//! A column by indices is a column of every call: faces of a mesh over its vertices, edges of a graph over its nodes,
//! listed pairs of boxes. Numbers are read where a machine needs them, without a copy of the column; a GPU gets the
//! items of the batch. Derivatives of a call are one per item; [`Indexed::gathered`] adds them to the shared items.
use super::columns::Columns;
use super::{Column, Here};
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::row::item::layout::put;
use crate::kernels::row::item::{Single, width};
use crate::{Pack, Real, Segment2, Segment3, Tetrahedron, Triangle2, Triangle3, Vec2, Vec3};

/// Indices of an item: of one shared item, or of the corners of a shape over shared points.
///
/// A `u32` stands for the item itself. Two indices of points are a segment, three a triangle, four points of space a
/// tetrahedron. Users implement it for shapes of their own.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no index of a shape over `{B}`",
    label = "no index of a shape over `{B}`",
    note = "`u32` is the item itself, `[u32; 2]` a segment of points, `[u32; 3]` a triangle, `[u32; 4]` a tetrahedron"
)]
pub trait IndexOf<B: Single>: Copy + Send + Sync {
    /// The shape of an item.
    type Shape: Single<Scalar = B::Scalar>;
    /// Returns the indices.
    fn indices(&self) -> &[u32];
    /// Returns the shape of shared items, of which `at` gives that with the index in a place.
    fn shape(at: impl Fn(usize) -> B) -> Self::Shape;
    /// Calls `add` with the part of each shared item in a cotangent, and its place.
    fn parts(bar: Self::Shape, add: impl FnMut(usize, B));
}

/// Checks that indices are below a number of shared items; the first item that they make, and how many make one, name a
/// wrong one.
pub(crate) fn in_range(
    argument: Argument,
    shared: usize,
    indices: &[u32],
    [first, corners]: [usize; 2],
) -> Result<(), Error> {
    let Some(wrong) = indices.iter().position(|&index| index as usize >= shared) else {
        return Ok(());
    };
    let (item, place) = (wrong / corners.max(1), wrong % corners.max(1));
    let name = format!("index {} in place {place}", indices[wrong]);
    Err(Error::Invalid {
        argument,
        item: first + item,
        flaw: Flaw::Broken(Field::new(&name), "is not one of the shared column"),
    })
}

impl<B: Single> IndexOf<B> for u32 {
    type Shape = B;
    fn indices(&self) -> &[u32] {
        std::slice::from_ref(self)
    }
    fn shape(at: impl Fn(usize) -> B) -> B {
        at(0)
    }
    fn parts(bar: B, mut add: impl FnMut(usize, B)) {
        add(0, bar);
    }
}

macro_rules! corners {
    ($($count:literal $Point:ident $Shape:ident [$($corner:ident $place:literal)*];)*) => { $(
        impl<T: Real> IndexOf<$Point<T>> for [u32; $count]
        where
            $Point<T>: Single<Scalar = T>,
            $Shape<T>: Single<Scalar = T>,
        {
            type Shape = $Shape<T>;
            fn indices(&self) -> &[u32] {
                self
            }
            fn shape(at: impl Fn(usize) -> $Point<T>) -> $Shape<T> {
                $Shape { $($corner: at($place)),* }
            }
            fn parts(bar: $Shape<T>, mut add: impl FnMut(usize, $Point<T>)) {
                $( add($place, bar.$corner); )*
            }
        }
    )* };
}
corners! {
    2 Vec2 Segment2 [from 0 to 1];
    3 Vec2 Triangle2 [a 0 b 1 c 2];
    2 Vec3 Segment3 [start 0 end 1];
    3 Vec3 Triangle3 [a 0 b 1 c 2];
    4 Vec3 Tetrahedron [a 0 b 1 c 2 d 3];
}

/// A column whose items are made of items of a shared column: item i of those with the indices `indices[i]`.
///
/// ```
/// use geograd::kernels::{Area, Cpu, Distance, Indexed, Op};
/// use geograd::{Circle, Vec2, Vec3};
/// let vertices = [(0.0_f64, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
/// let faces = [[0, 1, 2], [0, 2, 3]];
/// let column = Indexed::new(&vertices, &faces)?;
/// let cpu = Cpu::new();
/// assert_eq!(cpu.aligned(Area, column)?, [2.0, 2.0]);
/// // A derivative for every vertex, of the sum of all areas.
/// let by_face = cpu.aligned(Area.vjp(), (column, &[1.0, 1.0]))?;
/// assert_eq!(column.gathered(&by_face)?[2], Vec3::new(1.0, 1.0, 0.0));
///
/// // Listed pairs of a column.
/// let discs = [0.0_f64, 3.0, 9.0].map(|x| Circle::new(Vec2::new(x, 0.0), 1.0));
/// let (left, right) = (Indexed::new(&discs, &[0, 1])?, Indexed::new(&discs, &[1, 2])?);
/// assert_eq!(cpu.aligned(Distance, (left, right))?, [1.0, 4.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Debug)]
pub struct Indexed<'a, B, I> {
    shared: &'a [B],
    indices: &'a [I],
}

impl<B, I> Clone for Indexed<'_, B, I> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<B, I> Copy for Indexed<'_, B, I> {}

impl<'a, B: Single, I: IndexOf<B>> Indexed<'a, B, I> {
    /// Creates the column.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] with the first item that has an index beyond the shared column, the place of that index and
    /// the index.
    pub fn new(shared: &'a [B], indices: &'a [I]) -> Result<Self, Error> {
        for (item, own) in indices.iter().enumerate() {
            let argument = Argument::Named("indices");
            let all = own.indices();
            in_range(argument, shared.len(), all, [item, all.len()])?;
        }
        Ok(Indexed { shared, indices })
    }
    /// Creates the column of indices that are known to be in range.
    pub(crate) fn unchecked(shared: &'a [B], indices: &'a [I]) -> Self {
        Indexed { shared, indices }
    }
    /// Returns the shared items.
    #[must_use]
    pub fn shared(&self) -> &'a [B] {
        self.shared
    }
    /// Returns the indices.
    #[must_use]
    pub fn indices(&self) -> &'a [I] {
        self.indices
    }
    /// Returns the shape of an item.
    ///
    /// # Panics
    ///
    /// When there is no such item.
    #[must_use]
    #[inline]
    pub fn shape(&self, item: usize) -> I::Shape {
        let own = self.indices[item].indices();
        I::shape(|place| self.shared[own[place] as usize])
    }
    /// Returns the cotangents of the shared items from those of all items: their sums, added in double precision in the
    /// order of items. Shared items without an index have zero.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] unless there is one cotangent per item.
    pub fn gathered(&self, bars: &[I::Shape]) -> Result<Vec<B>, Error> {
        if bars.len() != self.indices.len() {
            return Err(Error::Length {
                argument: Argument::Upstream,
                expected: self.indices.len(),
                found: bars.len(),
            });
        }
        let zero = <B::Scalar as Real>::nearest(0.0);
        let mut numbers = vec![zero; B::LEN];
        let mut sums = vec![0.0; B::LEN * self.shared.len()];
        for (own, &bar) in self.indices.iter().zip(bars) {
            let own = own.indices();
            I::parts(bar, |place, part: B| {
                part.store(&mut numbers);
                let from = B::LEN * own[place] as usize;
                for (sum, x) in sums[from..].iter_mut().zip(&numbers) {
                    *sum += x.widen();
                }
            });
        }
        let mut all = self.shared.to_vec();
        for (k, item) in all.iter_mut().enumerate() {
            let mut own = sums[B::LEN * k..].iter();
            item.each(&mut |x| *x = own.next().map_or(zero, |&sum| Real::nearest(sum)));
        }
        Ok(all)
    }
}

impl<B: Single, I: IndexOf<B>> Columns for Indexed<'_, B, I> {
    type Item = I::Shape;
    type Place = Here;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, <I::Shape as Pack>::Scalar>)) {
        let width = width::<I::Shape>();
        let own = *self;
        add(Column::read(
            width,
            own.indices.len(),
            move |items, rows| {
                for (item, row) in items.zip(rows.chunks_exact_mut(width)) {
                    put(own.shape(item), row);
                }
            },
        ));
    }
}
