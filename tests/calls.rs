//! Batches of two lists, spelled for tests: results as separate values, operations as types.
use geograd::kernels::reduce::{Best, Found};
use geograd::kernels::{Cpu, Fold, Op, Single, Table};
use geograd::{Error, Real, Vec2};
use std::sync::atomic::{AtomicBool, Ordering};

/// A format that batches serve.
pub trait Number: Real + Single<Scalar = Self> {}
impl<T: Real + Single<Scalar = T>> Number for T {}

/// A number as `f64`, exactly.
pub fn wide<T: Number>(x: T) -> f64 {
    x.widen()
}

/// An operation of two shapes with one number as result.
pub trait Pair<T: Number>: Op<In<T> = (Self::A, Self::B), Out<T> = T> {
    /// The first shape.
    type A: Single<Scalar = T> + std::fmt::Debug + PartialEq;
    /// The second shape.
    type B: Single<Scalar = T> + std::fmt::Debug + PartialEq;
}

impl<O, A, B, T: Number> Pair<T> for O
where
    O: Op<In<T> = (A, B), Out<T> = T>,
    A: Single<Scalar = T> + std::fmt::Debug + PartialEq,
    B: Single<Scalar = T> + std::fmt::Debug + PartialEq,
{
    type A = A;
    type B = B;
}

static UNCULLED: AtomicBool = AtomicBool::new(false);

/// Switches the filter of all-pairs batches on or off for all calls of this module.
pub fn cull(on: bool) {
    UNCULLED.store(!on, Ordering::Relaxed);
}
fn cpu() -> Cpu {
    Cpu::new().culled(!UNCULLED.load(Ordering::Relaxed))
}

/// Shapes of both lists.
type Bars<O, T> = (Vec<<O as Pair<T>>::A>, Vec<<O as Pair<T>>::B>);
/// A result and its derivatives.
type Graded<O, T> = (T, (<O as Pair<T>>::A, <O as Pair<T>>::B));

pub fn aligned<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<Vec<T>, Error> {
    cpu().aligned(O::default(), (a, b))
}
pub fn aligned_into<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    values: &mut [T],
) -> Result<(), Error> {
    cpu().aligned_into(O::default(), (a, b), values)
}
pub fn aligned_grad<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
) -> Result<(Vec<T>, Vec<O::A>, Vec<O::B>), Error> {
    let (values, (a_bar, b_bar)) = cpu().aligned(O::default().value_grad(), (a, b))?;
    Ok((values, a_bar, b_bar))
}
pub fn aligned_grad_into<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    values: &mut [T],
    a_bar: &mut [O::A],
    b_bar: &mut [O::B],
) -> Result<(), Error> {
    cpu().aligned_into(O::default().value_grad(), (a, b), (values, (a_bar, b_bar)))
}
pub fn aligned_vjp<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    up: &[T],
) -> Result<Bars<O, T>, Error> {
    cpu().aligned(O::default().vjp(), ((a, b), up))
}
pub fn aligned_vjp_into<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    up: &[T],
    a_bar: &mut [O::A],
    b_bar: &mut [O::B],
) -> Result<(), Error> {
    cpu().aligned_into(O::default().vjp(), ((a, b), up), (a_bar, b_bar))
}
pub fn all_pairs<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<Vec<T>, Error> {
    cpu().all_pairs(O::default(), a, b).map(Table::into_planes)
}
pub fn all_pairs_into<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    values: &mut [T],
) -> Result<(), Error> {
    cpu().all_pairs_planes(O::default(), a, b, values)
}
pub fn all_pairs_grad<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
) -> Result<Table<Graded<O, T>>, Error> {
    cpu().all_pairs(O::default().value_grad(), a, b)
}
pub fn all_pairs_vjp<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    up: &[T],
) -> Result<Bars<O, T>, Error> {
    cpu().all_pairs_vjp(O::default(), a, b, up)
}
pub fn all_pairs_vjp_into<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    up: &[T],
    a_bar: &mut [O::A],
    b_bar: &mut [O::B],
) -> Result<(), Error> {
    cpu().all_pairs_vjp_into(O::default(), a, b, up, a_bar, b_bar)
}
pub fn row_max<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<Vec<Best<T>>, Error> {
    cpu().row_max(O::default(), a, b)
}
pub fn column_max<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<Vec<Best<T>>, Error> {
    cpu().column_max(O::default(), a, b)
}
pub fn above<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    threshold: T,
) -> Result<Vec<Found<T>>, Error> {
    cpu().above(O::default(), a, b, threshold)
}
pub fn count_above<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
    threshold: T,
) -> Result<u64, Error> {
    cpu().count_above(O::default(), a, b, threshold)
}
pub fn sum<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<f64, Error> {
    cpu().sum(O::default(), a, b)
}
pub fn mean<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Result<f64, Error> {
    cpu().mean(O::default(), a, b)
}
pub fn sum_grad<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
) -> Result<(f64, Vec<O::A>, Vec<O::B>), Error> {
    cpu().sum_grad(O::default(), a, b)
}
pub fn mean_grad<O: Pair<T>, T: Number>(
    a: &[O::A],
    b: &[O::B],
) -> Result<(f64, Vec<O::A>, Vec<O::B>), Error> {
    cpu().mean_grad(O::default(), a, b)
}
/// A fold over rings that takes nothing else.
pub trait OfRings<T: Number>: Fold<Context<T> = [T; 0], Element<T> = Vec2<T>> {}
impl<F, T: Number> OfRings<T> for F where F: Fold<Context<T> = [T; 0], Element<T> = Vec2<T>> {}

pub fn ragged<F: OfRings<T>, T: Number>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
) -> Result<Vec<F::Out<T>>, Error> {
    cpu().ragged(F::default(), vertices, offsets)
}
pub fn ragged_vjp<F: OfRings<T>, T: Number>(
    vertices: &[Vec2<T>],
    offsets: &[usize],
    up: &[F::Out<T>],
) -> Result<Vec<Vec2<T>>, Error> {
    cpu().ragged_vjp(F::default(), vertices, offsets, up)
}
