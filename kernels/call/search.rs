//! Operations with a search: decided on plain values, then replayed.
//!
//! A search yields a *record* of decisions: indices and small enums, never numbers. The result is computed from the
//! input and the record by a straight line, which duals and batches replay. Between decisions the result is smooth.
//! Derivatives belong to the branch taken, also where a decision changes.
use crate::ad::program::record::record_in;
use crate::ad::program::{Neutral, Program};
use crate::error::Error;
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::{self, Body, Call, Recording};
use crate::kernels::call::replayed::SearchCode;
use crate::kernels::call::searched::{AT_A_TIME, SearchedItem, constant};
pub use crate::kernels::row::decision::{HintedSearch, Search};
use crate::kernels::row::item::{Item, item_of, leaves_of, width, widths};
use crate::kernels::row::once::known;
use crate::kernels::row::op::{Hvp, Jacobian, Jvp, ValueGrad, Vjp};
use crate::{Fixed, Jet, Pack, Real, Scalar};
use std::sync::Arc;

/// An item of a search: its input, the decisions and the hints.
struct ItemOf<'a, D: HintedSearch, R: Item> {
    input: &'a R,
    record: D::Record,
    hints: D::Hints<R::Scalar>,
}

impl<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item> SearchedItem<R::Scalar>
    for ItemOf<'_, D, R>
{
    fn value(&self, out: &mut [R::Scalar]) {
        D::replay_with_hints::<R::Scalar>(*self.input, self.record, self.hints).store(out);
    }
    fn by_hand(&self, out_bar: Option<&[R::Scalar]>, out: &mut [R::Scalar]) -> bool {
        let out_bar = match out_bar {
            Some(out_bar) => D::Out::<R::Scalar>::load(out_bar),
            None => D::Out::<R::Scalar>::filled(R::Scalar::one()),
        };
        let found =
            D::adjoint_with_hints::<R::Scalar>(*self.input, &self.record, &self.hints, out_bar);
        let Some((value, bars)) = found else {
            return false;
        };
        let (result, mut row) = out.split_at_mut(D::Out::<R::Scalar>::LEN);
        value.store(result);
        // Derivatives have the input's codes.
        bars.to_row(self.input, &mut row);
        true
    }
    fn is_read(&self, place: usize) -> bool {
        D::is_read(&self.record, place)
    }
    fn scalars(&self) -> Vec<R::Scalar> {
        self.input.scalars()
    }
    fn on_duals(&self, scalars: &[Jet<R::Scalar, AT_A_TIME>]) -> Vec<Jet<R::Scalar, AT_A_TIME>> {
        let mut moved = D::In::<Jet<R::Scalar, AT_A_TIME>>::load(scalars);
        if const { R::CODES > 0 } {
            moved = moved.load_codes(&self.input.codes());
        }
        let mut hints = Vec::new();
        if const { D::Hints::<R::Scalar>::LEN > 0 } {
            hints.extend(self.hints.scalars().into_iter().map(constant));
        }
        let hints = D::Hints::<Jet<R::Scalar, AT_A_TIME>>::load(&hints);
        D::replay_with_hints::<Jet<R::Scalar, AT_A_TIME>>(moved, self.record, hints).scalars()
    }
    fn put(&self, scalars: &[R::Scalar], mut to: &mut [R::Scalar]) {
        R::load(scalars).to_row(self.input, &mut to);
    }
    fn scale(&self, mut bars: &mut [R::Scalar], scale: R::Scalar) {
        if const { R::CODES == 0 } {
            return bars.iter_mut().for_each(|bar| *bar *= scale);
        }
        R::leaves(&mut |leaf| {
            let (own, rest) = std::mem::take(&mut bars).split_at_mut(leaf.fields);
            let (scalars, _) = own.split_at_mut(leaf.fields - leaf.codes);
            scalars.iter_mut().for_each(|bar| *bar *= scale);
            bars = rest;
        });
    }
    fn sizes(&self) -> [usize; 3] {
        [R::LEN, D::Out::<R::Scalar>::LEN, width::<R>()]
    }
}

/// Decides the item of a row, and calls a function with it.
fn decided<D: HintedSearch<In<<R as Pack>::Scalar> = R>, R: Item>(
    row: &[R::Scalar],
    run: &mut dyn FnMut(&dyn SearchedItem<R::Scalar>),
) {
    let input: R = item_of(row);
    let (record, hints) = D::decide_with_hints::<R::Scalar>(input);
    let item = ItemOf::<'_, D, R> {
        input: &input,
        record,
        hints,
    };
    run(&item);
}

/// Makes the recording of a search.
// A function, since a closure would be compiled twice for every search.
fn made<D, R: Item>() -> Result<Recording<R::Scalar>, Error>
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
    D::Out<R::Scalar>: Item,
{
    let body = Body::Search(recording::UntypedSearch {
        decide: decided::<D, R>,
        code: const { &SearchCode::of::<D, R>() },
        steps: Vec::new(),
    });
    let (takes, outputs) = (leaves_of::<R>(), widths::<D::Out<R::Scalar>>());
    let mut made = Recording::new(takes, outputs, D::DECLARED.arguments, body);
    made.lower = D::DECLARED.lower;
    Ok(made)
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
    let made = known::<Searched<D>, _>(made::<D, R>);
    made.unwrap_or_else(|_| unreachable!("a search is not recorded"))
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
