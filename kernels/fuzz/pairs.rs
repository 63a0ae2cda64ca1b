//! What is promised of operations of two shapes.
use super::draw::{Drawn, Family};
use super::{Broken, Fuzzed, Outcome, Promise, SINGLE, first_where, not_finite, run, same};
use crate::ad::check::sample::Draw;
use crate::ad::check::symmetry::{Answer, Motion};
use crate::kernels::cpu::checked::numbers;
use crate::kernels::op::Op;
use crate::kernels::real::Real;
use crate::kernels::{Cpu, Single};

const CPU: Cpu = Cpu::new();

/// Pairs of one batch: few enough for one thread.
const CHUNK: usize = 2048;

/// Shapes of a square that is computed as all pairs.
const SQUARE: usize = 16;

/// Values may change by so many roundings, times the longest aspect, when shapes are exchanged, for
/// aspects up to a limit.
const ROUNDINGS: f64 = 64.0;
const LIMIT: f64 = 1e20;

/// Fuzzes an operation of two shapes on all cores; stops at the first thing that it finds.
#[must_use]
pub fn pairs<O, P, T>(count: u64, seed: u64) -> Fuzzed
where
    O: Op<In<T> = (P, P), Out<T> = T>,
    P: Single<Scalar = T> + Drawn<T>,
    T: Real + Single<Scalar = T>,
{
    run::<T, _>(
        O::NAME,
        (count, seed),
        CHUNK,
        Lists::<O, P, T>::new,
        |lists, draw| {
            lists.draw(draw);
            lists.check()
        },
    )
}

/// Lists of one thread, used again and again.
struct Lists<O, P, T> {
    op: O,
    a: Vec<P>,
    b: Vec<P>,
    upstream: Vec<T>,
    values: Vec<T>,
    others: Vec<T>,
    bars: (Vec<P>, Vec<P>),
    is_symmetric: bool,
}

impl<O, P, T> Lists<O, P, T>
where
    O: Op<In<T> = (P, P), Out<T> = T>,
    P: Single<Scalar = T> + Drawn<T>,
    T: Real + Single<Scalar = T>,
{
    fn new() -> Self {
        let numbers = vec![T::default(); CHUNK];
        let a = vec![P::filled(T::default()); CHUNK];
        let b = a.clone();
        let mut promises = O::PROMISES.iter();
        Lists {
            op: O::default(),
            upstream: numbers.clone(),
            values: numbers.clone(),
            others: numbers,
            bars: (a.clone(), b.clone()),
            a,
            b,
            is_symmetric: promises
                .any(|x| (x.motion, x.answer) == (Motion::Exchange, Answer::Stays)),
        }
    }

    /// Draws both lists, mostly of one family, and upstream slopes.
    fn draw(&mut self, draw: &mut Draw) {
        let (first, second) = (Family::any(draw), Family::any(draw));
        first.shapes(draw, &mut self.a);
        first.shapes(draw, &mut self.b);
        let few = CHUNK / 8;
        second.shapes(draw, &mut self.b[..few]);
        Family::any(draw).fill(draw, &mut self.upstream);
    }

    fn broken(&self, promise: Promise, i: usize) -> Broken {
        let input = [self.a[i].scalars(), self.b[i].scalars()].concat();
        Broken {
            promise,
            input: input.iter().map(|x| x.widen()).collect(),
        }
    }

    /// A promise is broken at a place, if there is one.
    fn unless(&self, promise: Promise, place: Option<usize>) -> Outcome {
        place.map_or(Ok(()), |i| Err(self.broken(promise, i)))
    }

    fn check(&mut self) -> Outcome {
        let into = (&mut self.values, (&mut self.bars.0, &mut self.bars.1));
        let done = CPU.aligned_into(self.op.value_grad(), (&self.a, &self.b), into);
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        self.unless(Promise::Finite, not_finite(&self.values))?;
        self.finite_slopes()?;
        let [least, most] = match Scale::of::<O>() {
            Scale::Ratio => [0.0, 1.0],
            Scale::Signed => [-1.0, 1.0],
            Scale::Content => [0.0, T::LARGEST],
        };
        let (least, most) = (T::lit(least), T::lit(most));
        let outside = |x: &T| (*x < least) | (*x > most);
        self.unless(Promise::Range, first_where(&self.values, outside))?;
        self.same_bits()?;
        self.with_upstream()?;
        self.with_itself()?;
        match self.is_symmetric {
            true => self.with_exchanged(),
            false => Ok(()),
        }
    }

    fn finite_slopes(&self) -> Outcome {
        let place = not_finite(&numbers(&self.bars.0)).map(|at| at / P::LEN);
        self.unless(Promise::Finite, place)?;
        let place = not_finite(&numbers(&self.bars.1)).map(|at| at / P::LEN);
        self.unless(Promise::Finite, place)
    }

    /// One by one, and all with all.
    fn same_bits(&self) -> Outcome {
        let (a, b) = (&self.a, &self.b);
        let here = |i: usize| (self.values[i], self.bars.0[i], self.bars.1[i]);
        let differs = |x: (T, P, P), y: (T, P, P)| {
            !same(&[x.0], &[y.0])
                || !same(&x.1.scalars(), &y.1.scalars())
                || !same(&x.2.scalars(), &y.2.scalars())
        };
        let mut places = (0..CHUNK).step_by(SINGLE);
        let place = places.find(|&i| match O::adjoint::<T>((a[i], b[i]), T::one()) {
            Some((value, (p, q))) => differs(here(i), (value, p, q)),
            None => !same(&[self.values[i]], &[O::eval::<T>((a[i], b[i]))]),
        });
        self.unless(Promise::SameBits, place)?;
        // From a place of no multiple of anything.
        let square = 1..1 + SQUARE;
        let grads = CPU.all_pairs(self.op.value_grad(), &a[square.clone()], &b[square]);
        let Ok(grads) = grads else {
            return Err(self.broken(Promise::Accepted, 1));
        };
        let place = (0..SQUARE).find(|&i| {
            let (value, (p, q)) = grads.at(i, i);
            differs(here(1 + i), (value, p, q))
        });
        self.unless(Promise::SameBits, place.map(|i| 1 + i))
    }

    /// Upstream slopes of all sizes.
    fn with_upstream(&mut self) -> Outcome {
        let (a_bar, b_bar) = (&mut self.bars.0, &mut self.bars.1);
        let columns = ((&self.a, &self.b), &self.upstream);
        let done = CPU.aligned_into(self.op.vjp(), columns, (a_bar, b_bar));
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        self.finite_slopes()
    }

    fn with_itself(&mut self) -> Outcome {
        let into = (&mut self.others, (&mut self.bars.0, &mut self.bars.1));
        let done = CPU.aligned_into(self.op.value_grad(), (&self.a, &self.a), into);
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        if Scale::of::<O>() == Scale::Content {
            return Ok(());
        }
        let ill = |x: &T| (*x != T::one()) & (*x != T::zero());
        self.unless(Promise::Identical, first_where(&self.others, ill))?;
        // Nothing decides a union alone; a share of the first box has a kink here.
        if !O::NAME.starts_with("iou") {
            return Ok(());
        }
        let some = |x: &T| *x != T::zero();
        let place = first_where(&numbers(&self.bars.0), some).map(|at| at / P::LEN);
        self.unless(Promise::Identical, place)?;
        let place = first_where(&numbers(&self.bars.1), some).map(|at| at / P::LEN);
        self.unless(Promise::Identical, place)
    }

    fn with_exchanged(&mut self) -> Outcome {
        let done = CPU.aligned_into(self.op, (&self.b, &self.a), &mut self.others);
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        let place = self.values.iter().zip(&self.others).position(|(&x, &y)| {
            // No aspect is below one: what differs by less needs no closer look.
            let quick = T::lit(ROUNDINGS * T::EPSILON);
            let is_content = Scale::of::<O>() == Scale::Content;
            (x - y).unsigned() > quick * if is_content { x } else { T::one() }
        });
        let Some(first) = place else { return Ok(()) };
        let place = (first..CHUNK).find(|&i| {
            let apart = (self.values[i].widen() - self.others[i].widen()).abs();
            apart > 0.0
                && apart > exchange_may_change::<O, T, P>(&self.a[i], &self.b[i]) * T::EPSILON
        });
        self.unless(Promise::Symmetric, place)
    }
}

/// What the values of an operation are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// In `[0, 1]`.
    Ratio,
    /// In `[−1, 1]`.
    Signed,
    /// An area or a volume.
    Content,
}

impl Scale {
    fn of<O: Op>() -> Self {
        match O::NAME {
            name if name.starts_with("io") => Scale::Ratio,
            name if name.starts_with("giou") => Scale::Signed,
            _ => Scale::Content,
        }
    }
}

/// By how many roundings of one a score of two shapes may change when they are exchanged; infinite where
/// nothing is promised.
fn exchange_may_change<O: Op, T, P: Drawn<T>>(a: &P, b: &P) -> f64 {
    // A rounding of the longest side moves a side of the shorter ones.
    let (own, other) = (a.sides(), b.sides());
    let aspect = own[1].max(other[1]) / own[0].min(other[0]);
    if aspect.is_nan() || aspect >= LIMIT {
        return f64::INFINITY;
    }
    let of_one = ROUNDINGS * aspect;
    match Scale::of::<O>() {
        Scale::Content => of_one * a.content().min(b.content()),
        _ => of_one,
    }
}
