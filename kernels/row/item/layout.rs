//! Layouts of items, and the memory for their results.
use super::memory;
use crate::ad::program::Neutral;
use crate::error::{Field, Flaw, Validate};
use crate::overlap_polygon::check_quad;
use crate::shape::{Obb3, YawBox3};
use crate::{Aabb2, Fixed, Obb2, Pack, Real, Rule, Vec2};
use std::any::TypeId;
use std::borrow::Cow;
use std::marker::PhantomData;
use std::ops::Range;

/// The layout of one shape of an item: the number of its scalars, their names, and its checks.
#[derive(Debug)]
pub struct Leaf<T> {
    /// The name of its type, with its path.
    pub shape: fn() -> &'static str,
    /// The number of its fields: scalars, then codes.
    pub fields: usize,
    /// The number of codes: whole numbers without derivatives, such as counts ([`Fixed::CODES`]).
    pub codes: usize,
    /// The name of a scalar.
    pub name: fn(usize) -> Field,
    /// The check of a shape's numbers; its error is the flaw.
    pub check: fn(&[T]) -> Result<(), Flaw>,
    /// The quick test of many shapes.
    pub quick: Quick,
    /// The rules of its numbers, as far as they are data ([`Validate::RULES`]).
    pub rules: &'static [Rule],
    /// The bounds along the axes, from the scalars: [`Fixed::axis_bounds`].
    pub(crate) axis_bounds: fn(&[Neutral]) -> Vec<Neutral>,
}

/// A quick test of many numbers, which accepts only valid shapes, and perhaps not all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quick {
    /// There is none.
    Never,
    /// All numbers are valid.
    Always,
    /// Finite numbers are valid.
    Finite,
    /// The rules of axis-aligned boxes.
    Aabb2,
    /// The rules of rotated boxes.
    Obb2,
    /// The rules of upright boxes.
    Upright,
    /// The rules of boxes of any orientation.
    Obb3,
    /// The rules of convex quadrilaterals.
    Quads,
}

impl<T> Clone for Leaf<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Leaf<T> {}

impl<T: Real> Leaf<T> {
    /// Returns the layout of `fields` numbers that belong to no shape.
    pub(crate) fn numbers(fields: usize) -> Self {
        Leaf {
            shape: || "",
            fields,
            codes: 0,
            name: match fields {
                1 => |_| Field::VALUE,
                _ => |i| Field::VALUE.within_item(i),
            },
            check: match fields {
                1 => |x: &[T]| x[0].validate(),
                _ => |x: &[T]| {
                    let wild = x.iter().position(|x| x.validate().is_err());
                    wild.map_or(Ok(()), |i| {
                        Err(Flaw::NotFinite(Field::VALUE.within_item(i)))
                    })
                },
            },
            quick: Quick::Finite,
            rules: &[],
            axis_bounds: |_| Vec::new(),
        }
    }
    /// Returns the layout of the scalars alone; beside codes they belong to no shape.
    pub(crate) fn without_codes(self) -> Self {
        match self.codes {
            0 => self,
            codes => Leaf {
                name: self.name,
                ..Leaf::numbers(self.fields - codes)
            },
        }
    }
    /// Returns this layout with the condition that quadrilaterals are convex.
    pub(crate) fn convex(self) -> Self {
        Leaf {
            check: |numbers| check_quad(<[Vec2<T>; 4]>::load(numbers)),
            quick: Quick::Quads,
            rules: &[Rule::ConvexQuad { first: 0 }],
            ..self
        }
    }
}

/// The type of an item: a number, a shape, or a tuple of these.
///
/// Numbers are `f32` or `f64`. `#[derive(Shape)]` implements it.
pub trait Item: Fixed<Scalar: Real> {
    /// A list of items: a vector of shapes; for a tuple a tuple of vectors.
    type Many: Send;
    /// Returns `count` items, all of them zero.
    #[doc(hidden)]
    fn many(count: usize) -> Self::Many;
    /// Takes an item off a row of its columns: of every shape the scalars, then the codes.
    #[doc(hidden)]
    fn from_row(row: &mut &[Self::Scalar]) -> Self;
    /// Writes the scalars of an item, and the codes of another one, as such a row.
    #[doc(hidden)]
    fn to_row(&self, coded: &Self, row: &mut &mut [Self::Scalar]);
    /// Adds the layout of every shape of an item, in order.
    #[doc(hidden)]
    fn leaves(add: &mut dyn FnMut(Leaf<Self::Scalar>));
    /// Adds the targets of results, one per shape of an item.
    #[doc(hidden)]
    fn targets<'a>(many: &'a mut Self::Many, add: &mut dyn FnMut(Target<'a, Self::Scalar>));
}

/// The result of a batch per item: a shape or number, or a result with its [Jacobian](WithJacobian).
pub trait Results {
    /// The number type, `f32` or `f64`.
    type Scalar: Real;
    /// A list of results.
    type Many: Send;
    /// Returns memory for `count` results, all of them zero.
    #[doc(hidden)]
    fn room(count: usize) -> Self::Many;
    /// Returns the number of scalars of every target.
    #[doc(hidden)]
    fn widths() -> Vec<usize>;
    /// Adds the targets of the results.
    #[doc(hidden)]
    fn places<'a>(many: &'a mut Self::Many, add: &mut dyn FnMut(Target<'a, Self::Scalar>));
}

impl<R: Item> Results for R {
    type Scalar = <R as Pack>::Scalar;
    type Many = <R as Item>::Many;
    fn room(count: usize) -> Self::Many {
        R::many(count)
    }
    fn widths() -> Vec<usize> {
        widths::<R>()
    }
    fn places<'a>(many: &'a mut Self::Many, add: &mut dyn FnMut(Target<'a, Self::Scalar>)) {
        R::targets(many, add);
    }
}

/// A result `Y` with its Jacobian with respect to an input `X`. A batch returns its results and a list of Jacobians. A
/// Jacobian is a `Y` with a gradient, an `X`, in place of every number.
#[derive(Clone, Copy, Debug)]
pub struct WithJacobian<Y, X>(PhantomData<fn(X) -> Y>);

impl<Y: Item, X: Item<Scalar = Y::Scalar>> Results for WithJacobian<Y, X>
where
    Y::With<X>: Send,
{
    type Scalar = <Y as Pack>::Scalar;
    type Many = (<Y as Item>::Many, Vec<Y::With<X>>);
    fn room(count: usize) -> Self::Many {
        let zero = Self::Scalar::default();
        let gradient = Y::filled(zero).remake(&mut |_| X::filled(zero));
        (Y::many(count), vec![gradient; count])
    }
    fn widths() -> Vec<usize> {
        let mut all = widths::<Y>();
        all.push(Y::LEN * width::<X>());
        all
    }
    fn places<'a>(
        (results, all): &'a mut Self::Many,
        add: &mut dyn FnMut(Target<'a, Self::Scalar>),
    ) {
        Y::targets(results, add);
        add(jacobians::<Y, X>(all));
    }
}

/// Returns Jacobians as a target: their gradients, one after another.
pub(crate) fn jacobians<Y: Item, X: Item<Scalar = Y::Scalar>>(
    all: &mut [Y::With<X>],
) -> Target<'_, Y::Scalar>
where
    Y::With<X>: Send,
{
    let (count, fields) = (all.len(), width::<X>());
    let pieces = all.chunks_mut(STRETCH).map(|jacobians| {
        let rows = (jacobians.len(), Y::LEN * fields);
        TargetPiece::written(rows.0, rows.1, move |first, numbers: &[Y::Scalar]| {
            let rows = numbers.chunks_exact(rows.1);
            for (jacobian, mut row) in jacobians[first..].iter_mut().zip(rows) {
                *jacobian = Y::filled(Y::Scalar::default()).remake(&mut |_| X::from_row(&mut row));
            }
        })
    });
    Target {
        pieces: pieces.collect(),
        count,
    }
}

/// Returns the number of fields of a shape in a column: its scalars, then its codes.
pub(crate) const fn width<P: Fixed>() -> usize {
    P::LEN + P::CODES
}

/// Returns a shape from the numbers of a column.
pub(crate) fn get<P: Fixed<Scalar: Real>>(numbers: &[P::Scalar]) -> P {
    let shape = P::load(numbers);
    // A `const` condition, since then the rest is not compiled for shapes without codes.
    if const { P::CODES == 0 } {
        return shape;
    }
    let (mut few, mut many) = ([0; FEW_CODES], Vec::new());
    let codes = few.get_mut(..P::CODES).unwrap_or_else(|| {
        many.resize(P::CODES, 0);
        &mut many
    });
    for (code, &x) in codes.iter_mut().zip(&numbers[P::LEN..]) {
        *code = code_of(x);
    }
    shape.load_codes(codes)
}

/// The number of codes up to which they need no list on the heap.
const FEW_CODES: usize = 8;

/// Returns the code that a column's number stands for.
fn code_of<T: Real>(x: T) -> u32 {
    // Via `i64`, since columns have codes of either sign.
    x.widen() as i64 as u32
}

/// Returns a code as a number of a column. Signed integers keep their sign, so that `f32` is exact from −2²⁴ to 2²⁴.
fn number_of_code<T: Real>(code: u32) -> T {
    T::lit(f64::from(code as i32))
}

/// Writes a shape as the numbers of a column.
pub(crate) fn put<P: Fixed<Scalar: Real>>(shape: P, numbers: &mut [P::Scalar]) {
    put_coded(&shape, &shape, numbers);
}

/// Writes the scalars of a shape, and the codes of another one, as the numbers of a column.
fn put_coded<P: Fixed<Scalar: Real>>(shape: &P, coded: &P, numbers: &mut [P::Scalar]) {
    shape.store(numbers);
    if const { P::CODES > 0 } {
        let (mut few, mut many) = ([0; FEW_CODES], Vec::new());
        let codes = few.get_mut(..P::CODES).unwrap_or_else(|| {
            many.resize(P::CODES, 0);
            &mut many
        });
        coded.store_codes(codes);
        for (x, &mut code) in numbers[P::LEN..].iter_mut().zip(codes) {
            *x = number_of_code(code);
        }
    }
}

/// Takes a shape off a row of columns.
#[doc(hidden)]
pub fn shape_of_row<P: Fixed<Scalar: Real>>(row: &mut &[P::Scalar]) -> P {
    let (own, rest) = row.split_at(width::<P>());
    *row = rest;
    get(own)
}

/// Writes the scalars of a shape, and the codes of another one, as part of a row of columns.
#[doc(hidden)]
pub fn shape_to_row<P: Fixed<Scalar: Real>>(shape: &P, coded: &P, row: &mut &mut [P::Scalar]) {
    let (own, rest) = std::mem::take(row).split_at_mut(width::<P>());
    *row = rest;
    put_coded(shape, coded, own);
}

/// Returns the item with the numbers of a row of its columns.
pub(crate) fn item_of<R: Item>(mut row: &[R::Scalar]) -> R {
    R::from_row(&mut row)
}

/// Reorders the numbers of an item. In columns each shape has its scalars and then its codes; for [`Fixed::load`] all
/// scalars come first, then all codes.
pub(crate) fn by_kind<R: Item>(numbers: &[R::Scalar]) -> Cow<'_, [R::Scalar]> {
    if const { R::CODES == 0 } {
        return Cow::Borrowed(numbers);
    }
    let mut all = numbers.to_vec();
    let (mut rest, mut scalar, mut code) = (numbers, 0, R::LEN);
    R::leaves(&mut |leaf| {
        let (own, others) = rest.split_at(leaf.fields);
        let (own, own_codes) = own.split_at(leaf.fields - leaf.codes);
        all[scalar..][..own.len()].copy_from_slice(own);
        all[code..][..own_codes.len()].copy_from_slice(own_codes);
        (scalar, code, rest) = (scalar + own.len(), code + own_codes.len(), others);
    });
    Cow::Owned(all)
}

/// Writes scalars and codes shape by shape, the inverse of [`by_kind`].
pub(crate) fn by_shape<R: Item>(
    mut scalars: &[R::Scalar],
    codes: &[u32],
    mut to: &mut [R::Scalar],
) {
    if const { R::CODES == 0 } {
        return to.copy_from_slice(scalars);
    }
    let mut codes = codes.iter();
    R::leaves(&mut |leaf| {
        let (own, rest) = std::mem::take(&mut to).split_at_mut(leaf.fields);
        let (own_scalars, others) = scalars.split_at(leaf.fields - leaf.codes);
        own[..own_scalars.len()].copy_from_slice(own_scalars);
        for (x, &code) in own[own_scalars.len()..].iter_mut().zip(&mut codes) {
            *x = number_of_code(code);
        }
        (to, scalars) = (rest, others);
    });
}

/// Returns the layout of an item that is a single shape.
pub fn leaf<P: Item + Validate>() -> Leaf<P::Scalar> {
    Leaf {
        shape: std::any::type_name::<P>,
        fields: width::<P>(),
        codes: P::CODES,
        name: P::name,
        // Functions, since closures would be compiled twice for every shape.
        check: check::<P>,
        quick: quick_of::<P>(),
        rules: P::RULES,
        axis_bounds: axis_bounds::<P>,
    }
}

fn check<P: Item + Validate>(numbers: &[P::Scalar]) -> Result<(), Flaw> {
    get::<P>(numbers).validate()
}

fn axis_bounds<P: Item + Validate>(numbers: &[Neutral]) -> Vec<Neutral> {
    P::Of::<Neutral>::load(numbers).axis_bounds()
}

/// Returns the quick test of a shape: for finite numbers, or for the rules of boxes.
fn quick_of<P: Item + Validate>() -> Quick {
    let is = |shape: TypeId| TypeId::of::<P>() == shape;
    if P::FINITE_SUFFICES {
        Quick::Finite
    } else if is(TypeId::of::<Obb2<P::Scalar>>()) {
        Quick::Obb2
    } else if is(TypeId::of::<Aabb2<P::Scalar>>()) {
        Quick::Aabb2
    } else if is(TypeId::of::<YawBox3<P::Scalar>>()) {
        Quick::Upright
    } else if is(TypeId::of::<Obb3<P::Scalar>>()) {
        Quick::Obb3
    } else {
        Quick::Never
    }
}

/// Returns the layouts of all shapes of an item.
pub(crate) fn leaves_of<P: Item>() -> Vec<Leaf<P::Scalar>> {
    let mut all = Vec::new();
    P::leaves(&mut |leaf| all.push(leaf));
    all
}

/// Returns the number of fields of every shape of an item.
pub(crate) fn widths<P: Item>() -> Vec<usize> {
    leaves_of::<P>().iter().map(|leaf| leaf.fields).collect()
}

/// An item that is one shape.
#[doc(hidden)]
#[macro_export]
macro_rules! __item_of_one {
    () => {
        type Many = ::std::vec::Vec<Self>;
        fn many(count: usize) -> Self::Many {
            let zero = <Self::Scalar as ::core::default::Default>::default();
            ::std::vec![<Self as $crate::__private::Fixed>::filled(zero); count]
        }
        fn from_row(row: &mut &[Self::Scalar]) -> Self {
            $crate::__private::shape_of_row(row)
        }
        fn to_row(&self, coded: &Self, row: &mut &mut [Self::Scalar]) {
            $crate::__private::shape_to_row(self, coded, row);
        }
        fn leaves(add: &mut dyn FnMut($crate::__private::Leaf<Self::Scalar>)) {
            // A shape without numbers, such as `[T; 0]`, has no column.
            if <Self as $crate::__private::Fixed>::LEN > 0 {
                add($crate::__private::leaf::<Self>());
            }
        }
        fn targets<'a>(
            many: &'a mut Self::Many,
            add: &mut dyn FnMut($crate::__private::Target<'a, Self::Scalar>),
        ) {
            if <Self as $crate::__private::Fixed>::LEN > 0 {
                add($crate::__private::target(many));
            }
        }
    };
}

impl Item for f32 {
    crate::__item_of_one!();
}
impl Item for f64 {
    crate::__item_of_one!();
}

impl<P: Item + Validate, const N: usize> Item for [P; N] {
    crate::__item_of_one!();
}

/// Items of several shapes.
macro_rules! tuples {
    ($($first:ident $first_coded:ident $($name:ident $coded:ident)*;)*) => { $(
        impl<$first: Item, $($name: Item<Scalar = $first::Scalar>),*> Item for ($first, $($name,)*) {
            type Many = ($first::Many, $($name::Many,)*);
            fn many(count: usize) -> Self::Many {
                ($first::many(count), $($name::many(count),)*)
            }
            fn from_row(row: &mut &[Self::Scalar]) -> Self {
                ($first::from_row(row), $($name::from_row(row),)*)
            }
            #[allow(non_snake_case)]
            fn to_row(&self, coded: &Self, row: &mut &mut [Self::Scalar]) {
                let ($first, $($name,)*) = self;
                let ($first_coded, $($coded,)*) = coded;
                $first.to_row($first_coded, row);
                $($name.to_row($coded, row);)*
            }
            fn leaves(add: &mut dyn FnMut(Leaf<Self::Scalar>)) {
                $first::leaves(add);
                $($name::leaves(add);)*
            }
            #[allow(non_snake_case)]
            fn targets<'a>(
                ($first, $($name,)*): &'a mut Self::Many,
                add: &mut dyn FnMut(Target<'a, Self::Scalar>),
            ) {
                $first::targets($first, add);
                $($name::targets($name, add);)*
            }
        }
    )* };
}
tuples!(A a B b; A a B b C c; A a B b C c D d; A a B b C c D d E e; A a B b C c D d E e F f;);

/// Returns the targets of results, one per shape of an item.
pub(crate) fn targets_of<P: Item>(many: &mut P::Many) -> Vec<Target<'_, P::Scalar>> {
    let mut all = Vec::new();
    P::targets(many, &mut |target| all.push(target));
    all
}

/// A single shape, not a tuple: the lists of all pairs consist of these.
pub trait Single: Item<Many = Vec<Self>> {}
impl<P: Item<Many = Vec<P>>> Single for P {}

/// A function that converts numbers to shapes, one after another, beginning with one of a piece.
type Write<'a, T> = Box<dyn FnMut(usize, &[T]) + Send + 'a>;

/// The memory for one shape of every result.
pub struct Target<'a, T> {
    /// The pieces, of [`STRETCH`] items each; the last one may have fewer.
    pieces: Vec<TargetPiece<'a, T>>,
    /// The number of items.
    pub(crate) count: usize,
}

/// A piece of a target.
pub(crate) enum TargetPiece<'a, T> {
    /// Numbers in place.
    Lent(&'a mut [T]),
    /// Numbers that become shapes which are no slice of numbers.
    Written(WrittenRows<'a, T>),
}

/// Rows of numbers for some shapes of a piece, and the function that converts them.
pub(crate) struct WrittenRows<'a, T> {
    /// The numbers of a row, and of the rows of the piece.
    fields: usize,
    count: usize,
    /// The first of the shapes whose numbers are in the room.
    first: usize,
    room: Vec<T>,
    write: Write<'a, T>,
}

/// The number of items in a piece of work.
pub(crate) const STRETCH: usize = 2048;

/// Returns shapes as a target.
pub fn target<P: Item>(shapes: &mut [P]) -> Target<'_, P::Scalar> {
    let count = shapes.len();
    let pieces = shapes.chunks_mut(STRETCH).map(|shapes| {
        if memory::is_plain::<P>() {
            return TargetPiece::Lent(memory::lent_mut(shapes).unwrap_or_default());
        }
        let count = shapes.len();
        TargetPiece::written(count, width::<P>(), move |first, rows: &[P::Scalar]| {
            let rows = rows.chunks_exact(width::<P>());
            for (shape, row) in shapes[first..].iter_mut().zip(rows) {
                *shape = get(row);
            }
        })
    });
    Target {
        pieces: pieces.collect(),
        count,
    }
}

impl<'a, T: Real> Target<'a, T> {
    /// Creates a target from rows of `fields` numbers.
    pub(crate) fn of_rows(rows: &'a mut [T], fields: usize) -> Self {
        Target {
            count: rows.len() / fields,
            pieces: rows
                .chunks_mut(STRETCH * fields)
                .map(TargetPiece::Lent)
                .collect(),
        }
    }
    /// Returns the pieces.
    pub(crate) fn pieces(self) -> Vec<TargetPiece<'a, T>> {
        self.pieces
    }
}

impl<'a, T: Real> TargetPiece<'a, T> {
    /// Returns a piece of `count` shapes with rows of `fields` numbers, which a function converts.
    fn written(count: usize, fields: usize, write: impl FnMut(usize, &[T]) + Send + 'a) -> Self {
        TargetPiece::Written(WrittenRows {
            fields,
            count,
            first: 0,
            room: Vec::new(),
            write: Box::new(write),
        })
    }
    /// Returns the numbers of all its items for writing.
    pub(crate) fn numbers(&mut self) -> &mut [T] {
        match self {
            TargetPiece::Lent(numbers) => numbers,
            TargetPiece::Written(rows) => {
                let all = 0..rows.count;
                rows.numbers(all)
            }
        }
    }
    /// Returns the numbers of some of its items for writing, `fields` each. Those of others must be [finished](Self::finish).
    pub(crate) fn numbers_of(&mut self, items: Range<usize>, fields: usize) -> &mut [T] {
        match self {
            TargetPiece::Lent(numbers) => &mut numbers[items.start * fields..items.end * fields],
            TargetPiece::Written(rows) => rows.numbers(items),
        }
    }
    /// Converts the numbers to shapes.
    pub(crate) fn finish(&mut self) {
        if let TargetPiece::Written(rows) = self {
            (rows.write)(rows.first, &rows.room);
        }
    }
}

impl<T: Real> WrittenRows<'_, T> {
    fn numbers(&mut self, items: Range<usize>) -> &mut [T] {
        self.first = items.start;
        self.room.resize(items.len() * self.fields, T::default());
        &mut self.room
    }
}
