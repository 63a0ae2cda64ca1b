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

/// Returns the places of the numbers that a replay reads.
fn places<D: HintedSearch>(record: &D::Record) -> Vec<usize> {
    let all = 0..D::In::<f64>::LEN;
    all.filter(|&place| D::is_read(record, place)).collect()
}

/// Returns the result on duals, with derivatives by the numbers at up to `AT_A_TIME` places. `codes` are the input's.
fn replayed<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    codes: &[u32],
    places: &[usize],
    (record, hints): (D::Record, D::Hints<R::Scalar>),
) -> Vec<Jet<R::Scalar, AT_A_TIME>> {
    // No place is so large, so that none is a variable.
    let constant = |&x: &R::Scalar| Jet::variable(x, usize::MAX);
    let mut jets: Vec<Jet<R::Scalar, AT_A_TIME>> = numbers[..R::LEN].iter().map(constant).collect();
    for (k, &place) in places.iter().enumerate() {
        jets[place] = Jet::variable(numbers[place], k);
    }
    let moved = D::In::<Jet<R::Scalar, AT_A_TIME>>::load(&jets).load_codes(codes);
    let hints: Vec<_> = hints.scalars().iter().map(constant).collect();
    let hints = D::Hints::<Jet<R::Scalar, AT_A_TIME>>::load(&hints);
    D::replay_with_hints::<Jet<R::Scalar, AT_A_TIME>>(moved, record, hints).scalars()
}

/// Returns the result of one item and the cotangents of its arguments by hand, if the search has them; without a
/// cotangent of the result it is all ones.
fn by_hand<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    input: R,
    (record, hints): &(D::Record, D::Hints<R::Scalar>),
    out_bar: Option<&[R::Scalar]>,
) -> Option<(D::Out<R::Scalar>, R)> {
    let ones = vec![R::Scalar::one(); D::Out::<R::Scalar>::LEN];
    let out_bar = D::Out::<R::Scalar>::load(out_bar.unwrap_or(&ones));
    D::adjoint_with_hints::<R::Scalar>(input, record, hints, out_bar)
}

/// Writes the result of one item, and the gradient of each of its numbers.
fn item_and_jacobian<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    out: &mut [R::Scalar],
) {
    let numbers = by_kind::<R>(numbers);
    let input = get::<R>(&numbers);
    let found = D::decide_with_hints::<R::Scalar>(input);
    let (record, hints) = found;
    let codes: Vec<u32> = input.codes();
    let result = D::Out::<R::Scalar>::LEN;
    if result == 1
        && let Some((value, bars)) = by_hand::<D, R>(input, &found, None)
    {
        value.store(out);
        by_shape::<R>(&bars.scalars(), &codes, &mut out[result..]);
        return;
    }
    let mut rows = vec![R::Scalar::default(); result * R::LEN];
    for places in places::<D>(&record).chunks(AT_A_TIME) {
        let replayed = replayed::<D, R>(&numbers, &codes, places, found);
        for (row, jet) in rows.chunks_exact_mut(R::LEN).zip(replayed) {
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                row[place] = derivative;
            }
        }
    }
    D::replay_with_hints::<R::Scalar>(input, record, hints).store(out);
    let gradients = out[result..].chunks_exact_mut(width::<R>());
    for (row, gradient) in rows.chunks_exact(R::LEN).zip(gradients) {
        // A gradient has the input's codes.
        by_shape::<R>(row, &codes, gradient);
    }
}

/// Writes the result of one item, and its derivatives times a cotangent; without one it is all ones.
fn item<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    out_bar: Option<&[R::Scalar]>,
    out: &mut [R::Scalar],
    derivatives: bool,
) {
    let numbers = by_kind::<R>(numbers);
    let input = get::<R>(&numbers);
    let found = D::decide_with_hints::<R::Scalar>(input);
    let (record, hints) = found;
    let result = D::Out::<R::Scalar>::LEN;
    if derivatives {
        // The cotangent of one number scales its gradient: both have the same bits but for this product.
        let (own, scale) = match out_bar {
            Some([bar]) => (None, Some(*bar)),
            _ => (out_bar, None),
        };
        if let Some((value, bars)) = by_hand::<D, R>(input, &found, own) {
            value.store(out);
            let mut bars = bars.scalars();
            if let Some(scale) = scale {
                bars.iter_mut().for_each(|bar| *bar *= scale);
            }
            by_shape::<R>(&bars, &input.codes(), &mut out[result..]);
            return;
        }
    }
    D::replay_with_hints::<R::Scalar>(input, record, hints).store(out);
    if !derivatives {
        return;
    }
    let codes: Vec<u32> = input.codes();
    let mut bars = vec![R::Scalar::default(); R::LEN];
    for places in places::<D>(&record).chunks(AT_A_TIME) {
        let replayed = replayed::<D, R>(&numbers, &codes, places, found);
        for (k, jet) in replayed.into_iter().enumerate() {
            let by = out_bar.map_or(R::Scalar::one(), |out_bar| out_bar[k]);
            for (&place, derivative) in places.iter().zip(jet.derivative) {
                bars[place] = if k == 0 {
                    derivative * by
                } else {
                    bars[place] + derivative * by
                };
            }
        }
    }
    // A gradient has the input's codes.
    by_shape::<R>(&bars, &codes, &mut out[result..]);
}

/// Returns the function of one item in a mode of a search.
fn item_in<D, R: Item>(mode: Mode) -> Each<R::Scalar>
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
{
    match mode {
        Mode::Value => |x, bar, out| item::<D, R>(x, bar, out, false),
        Mode::Jacobian => |x, _, out| item_and_jacobian::<D, R>(x, out),
        Mode::ValueGrad | Mode::Vjp => |x, bar, out| item::<D, R>(x, bar, out, true),
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
