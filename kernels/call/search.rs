//! Operations with a search: decided on plain values, then replayed.
//!
//! A search yields a *record* of decisions: indices and small enums, never numbers. The result is computed from the
//! input and the record by a straight line, which duals and batches replay. Between decisions the result is smooth.
//! Derivatives belong to the branch taken, also where a decision changes.
use crate::ad::program::record::record_in;
use crate::ad::program::{Neutral, Program};
use crate::error::Error;
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::{self, Body, Call, Each, Recording};
pub use crate::kernels::row::decision::{HintedSearch, Search};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::{Item, by_kind, by_shape, get, leaves_of, width, widths};
use crate::kernels::row::once::known;
use crate::kernels::row::op::{Hvp, Jacobian, Jvp, ValueGrad, Vjp};
use crate::{Fixed, Jet, Pack, Real, Scalar};
use std::sync::Arc;

/// The number of inputs per replay on duals. A larger one needs fewer replays with larger duals.
const AT_A_TIME: usize = 4;

/// An item that a search has decided, without the types of its shapes: what every search does with it is compiled once
/// per format.
trait SearchedItem<T: Real> {
    /// Writes the result.
    fn value(&self, out: &mut [T]);
    /// Returns the result, and the cotangents of the input's scalars by hand, if the search has them; without a cotangent
    /// of the result it is all ones.
    fn by_hand(&self, out_bar: Option<&[T]>) -> Option<[Vec<T>; 2]>;
    /// Returns `false` for a number, by its place, that the replay does not read.
    fn is_read(&self, place: usize) -> bool;
    /// Returns the result on duals of the input's scalars.
    fn on_duals(&self, scalars: &[Jet<T, AT_A_TIME>]) -> Vec<Jet<T, AT_A_TIME>>;
    /// Writes derivatives by the input's scalars in the order of a column.
    fn put(&self, scalars: &[T], to: &mut [T]);
    /// Returns the number of scalars of the input, of the result, and of a row of the input's column.
    fn sizes(&self) -> [usize; 3];
}

/// An item of a search: its input, the decisions and the hints.
struct ItemOf<D: HintedSearch, R: Item> {
    input: R,
    record: D::Record,
    hints: D::Hints<R::Scalar>,
}

/// Returns a number as a dual without derivatives: no place is so large, so that none is a variable.
fn constant<T: Real>(x: T) -> Jet<T, AT_A_TIME> {
    Jet::variable(x, usize::MAX)
}

impl<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item> SearchedItem<R::Scalar>
    for ItemOf<D, R>
{
    fn value(&self, out: &mut [R::Scalar]) {
        D::replay_with_hints::<R::Scalar>(self.input, self.record, self.hints).store(out);
    }
    fn by_hand(&self, out_bar: Option<&[R::Scalar]>) -> Option<[Vec<R::Scalar>; 2]> {
        let ones = vec![R::Scalar::one(); D::Out::<R::Scalar>::LEN];
        let out_bar = D::Out::<R::Scalar>::load(out_bar.unwrap_or(&ones));
        let found =
            D::adjoint_with_hints::<R::Scalar>(self.input, &self.record, &self.hints, out_bar);
        found.map(|(value, bars)| [value.scalars(), bars.scalars()])
    }
    fn is_read(&self, place: usize) -> bool {
        D::is_read(&self.record, place)
    }
    fn on_duals(&self, scalars: &[Jet<R::Scalar, AT_A_TIME>]) -> Vec<Jet<R::Scalar, AT_A_TIME>> {
        let codes = self.input.codes();
        let moved = D::In::<Jet<R::Scalar, AT_A_TIME>>::load(scalars).load_codes(&codes);
        let hints: Vec<_> = self.hints.scalars().into_iter().map(constant).collect();
        let hints = D::Hints::<Jet<R::Scalar, AT_A_TIME>>::load(&hints);
        D::replay_with_hints::<Jet<R::Scalar, AT_A_TIME>>(moved, self.record, hints).scalars()
    }
    fn put(&self, scalars: &[R::Scalar], to: &mut [R::Scalar]) {
        // Derivatives have the input's codes.
        by_shape::<R>(scalars, &self.input.codes(), to);
    }
    fn sizes(&self) -> [usize; 3] {
        [R::LEN, D::Out::<R::Scalar>::LEN, width::<R>()]
    }
}

/// Returns the duals of a result for the numbers at up to `AT_A_TIME` places.
fn replayed<T: Real>(
    item: &dyn SearchedItem<T>,
    scalars: &[T],
    places: &[usize],
) -> Vec<Jet<T, AT_A_TIME>> {
    let mut duals: Vec<_> = scalars.iter().copied().map(constant).collect();
    for (k, &place) in places.iter().enumerate() {
        duals[place] = Jet::variable(scalars[place], k);
    }
    item.on_duals(&duals)
}

/// Returns the places of the numbers that a replay reads.
fn places<T: Real>(item: &dyn SearchedItem<T>, scalars: &[T]) -> Vec<usize> {
    let all = 0..scalars.len();
    all.filter(|&place| item.is_read(place)).collect()
}

/// Writes the result of an item, and the gradient of each of its numbers.
fn with_jacobian<T: Real>(item: &dyn SearchedItem<T>, scalars: &[T], out: &mut [T]) {
    let [inputs, result, width] = item.sizes();
    if result == 1
        && let Some([value, bars]) = item.by_hand(None)
    {
        out[..result].copy_from_slice(&value);
        item.put(&bars, &mut out[result..]);
        return;
    }
    let mut rows = vec![T::default(); result * inputs];
    for places in places(item, scalars).chunks(AT_A_TIME) {
        let replayed = replayed(item, scalars, places);
        for (row, jet) in rows.chunks_exact_mut(inputs).zip(replayed) {
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                row[place] = derivative;
            }
        }
    }
    item.value(out);
    let gradients = out[result..].chunks_exact_mut(width);
    for (row, gradient) in rows.chunks_exact(inputs).zip(gradients) {
        item.put(row, gradient);
    }
}

/// Writes the result of an item, and its derivatives times a cotangent; without one it is all ones.
fn with_derivatives<T: Real>(
    item: &dyn SearchedItem<T>,
    scalars: &[T],
    out_bar: Option<&[T]>,
    out: &mut [T],
) {
    let [_, result, _] = item.sizes();
    // The cotangent of one number scales its gradient: both have the same bits but for this product.
    let (own, scale) = match out_bar {
        Some([bar]) => (None, Some(*bar)),
        _ => (out_bar, None),
    };
    if let Some([value, mut bars]) = item.by_hand(own) {
        out[..result].copy_from_slice(&value);
        if let Some(scale) = scale {
            bars.iter_mut().for_each(|bar| *bar *= scale);
        }
        item.put(&bars, &mut out[result..]);
        return;
    }
    item.value(out);
    let mut bars = vec![T::default(); scalars.len()];
    for places in places(item, scalars).chunks(AT_A_TIME) {
        let replayed = replayed(item, scalars, places);
        for (k, jet) in replayed.into_iter().enumerate() {
            let by = out_bar.map_or(T::one(), |out_bar| out_bar[k]);
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                bars[place] = if k == 0 {
                    derivative * by
                } else {
                    bars[place] + derivative * by
                };
            }
        }
    }
    item.put(&bars, &mut out[result..]);
}

/// Decides an item, and calls a function with it and the scalars of its input.
fn decided<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    run: &mut dyn FnMut(&dyn SearchedItem<R::Scalar>, &[R::Scalar]),
) {
    let numbers = by_kind::<R>(numbers);
    let input = get::<R>(&numbers);
    let (record, hints) = D::decide_with_hints::<R::Scalar>(input);
    let item = ItemOf::<D, R> {
        input,
        record,
        hints,
    };
    run(&item, &numbers[..R::LEN]);
}

/// Returns the function of one item in a mode of a search.
fn item_in<D, R: Item>(mode: Mode) -> Each<R::Scalar>
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
{
    match mode {
        Mode::Value => |x, _, out| decided::<D, R>(x, &mut |item, _| item.value(out)),
        Mode::Jacobian => |x, _, out| {
            decided::<D, R>(x, &mut |item, scalars| with_jacobian(item, scalars, out));
        },
        Mode::ValueGrad | Mode::Vjp => |x, bar, out| {
            decided::<D, R>(x, &mut |item, scalars| {
                with_derivatives(item, scalars, bar, out);
            });
        },
    }
}

/// Returns the recording of a search, which is made once.
pub(crate) fn recording<D, R: Item>() -> Arc<Recording<R::Scalar>>
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
    D::Out<R::Scalar>: Item,
{
    const {
        assert!(
            <D::Out<R::Scalar> as Fixed>::CODES == 0,
            "the result of a search has no codes: its derivatives are by scalars alone"
        );
    }
    let made = known::<Searched<D>, _>(|| {
        let body = Body::Search(recording::UntypedSearch {
            item: item_in::<D, R>,
            replays: crate::kernels::call::replayed::of::<D, R>,
            steps: Vec::new(),
        });
        let (takes, outputs) = (leaves_of::<R>(), widths::<D::Out<R::Scalar>>());
        let mut made = Recording::new(takes, outputs, D::DECLARED.arguments, body);
        made.lower = D::DECLARED.lower;
        Ok(made)
    });
    made.unwrap_or_else(|_: Error| unreachable!("a search is not recorded"))
}

/// A search as a function of batches, made by [`search`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Searched<D>(std::marker::PhantomData<fn() -> D>);

/// Turns a search into a function of batches, with gradients like any other.
///
/// Aligned batches run it on the CPU and on a GPU; all pairs and their reductions run on the CPU.
///
/// ```
/// use geograd::kernels::op::{Declared, Declares, Jumps};
/// use geograd::kernels::search::{Search, replay, search};
/// use geograd::kernels::Cpu;
/// use geograd::{Scalar, Segment2, Vec2};
///
/// /// The end of a segment that is nearer to a point.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct NearerEnd;
///
/// impl Declares for NearerEnd {
///     const DECLARED: Declared = Declared::new("nearer_end", &[], Jumps::Anywhere);
/// }
///
/// impl Search for NearerEnd {
///     type In<S: Scalar> = (Vec2<S>, Segment2<S>);
///     type Out<S: Scalar> = Vec2<S>;
///     type Record = bool;
///     fn decide<S: Scalar<Mask = bool>>((point, segment): Self::In<S>) -> bool {
///         let [to_from, to_to] = [segment.from, segment.to].map(|end| (end - point).length_squared());
///         to_from.at_most(to_to)
///     }
///     fn replay<S: Scalar>((_, segment): Self::In<S>, is_from: bool) -> Vec2<S> {
///         if is_from { segment.from } else { segment.to }
///     }
/// }
///
/// let points = [Vec2::new(1.0_f64, 2.0), Vec2::new(8.0, 1.0)];
/// let segments = [Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(9.0, 0.0)); 2];
/// let cpu = Cpu::new();
/// // The decision of one input, as a program that leaves the library.
/// let text = replay(NearerEnd, (points[1], segments[1]))?.c("end")?;
/// assert!(text.contains("void end(const double *x, double *out)"));
///
/// let (ends, by) = cpu.aligned(search(NearerEnd).jacobian(), (&points, &segments))?;
/// assert_eq!(ends[1], Vec2::new(9.0, 0.0));
/// assert_eq!(by[1].x.1.to.x, 1.0);
/// # Ok::<(), geograd::Error>(())
/// ```
#[must_use]
pub const fn search<D: HintedSearch>(_search: D) -> Searched<D> {
    Searched(std::marker::PhantomData)
}

/// Returns the replay of a search as a program, by the record that an input has. For an input of another record its
/// decisions are wrong.
///
/// # Errors
///
/// [`Error::Program`] for shapes with whole numbers ([`Unrecordable::Codes`](crate::Unrecordable::Codes)), and those of
/// recording it.
pub fn replay<D: Search, T: Real>(
    _search: D,
    input: D::In<T>,
) -> Result<Program<D::In<T>, D::Out<T>>, Error> {
    let decided = D::decide::<T>(input);
    let replay = |input: D::In<Neutral>| D::replay::<Neutral>(input, decided);
    record_in(T::FORMAT, replay).map(Program::of)
}

impl<D: HintedSearch> Searched<D> {
    /// Returns the search with its gradient: batches return the result, one number, and the gradient by every argument.
    #[must_use]
    pub const fn value_grad(self) -> ValueGrad<Self> {
        ValueGrad(self)
    }
    /// Returns the search with its Jacobian: aligned batches return the result, and in its shape the gradient of every
    /// number.
    #[must_use]
    pub const fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
    /// Returns the adjoint: batches take the arguments and a cotangent of the result, and return the cotangents of the
    /// arguments.
    #[must_use]
    pub const fn vjp(self) -> Vjp<Self> {
        Vjp(self)
    }
    /// Returns the search with its derivative along a direction: aligned batches take arguments and directions of them.
    /// The decisions are those at the arguments.
    #[must_use]
    pub const fn jvp(self) -> Jvp<Self> {
        Jvp::of(self)
    }
    /// Returns the Hessian of the search times a direction; the result is one number.
    #[must_use]
    pub const fn hvp(self) -> Hvp<Self> {
        Hvp::of(self)
    }
}

/// A function of batches that is a search.
pub trait Searches {
    /// The search.
    type Search: HintedSearch;
}
impl<D: HintedSearch> Searches for Searched<D> {
    type Search = D;
}

impl<D, R: Item> Function<R> for Searched<D>
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
    D::Out<R::Scalar>: Item,
{
    type Out = D::Out<R::Scalar>;
    fn call(&self) -> Result<Call<R::Scalar>, Error> {
        Ok(Call::of(recording::<D, R>()))
    }
}
