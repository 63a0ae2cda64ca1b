//! Operations on very many inputs that nobody would think of: what is promised of all finite valid
//! input, at tens of millions of inputs a second.
//!
//! Of every input: value and slopes are finite, and the value is in its range. Of pairs: identical
//! shapes share all they have, or nothing where they count as empty, with slopes of zero; and what
//! stays when shapes are exchanged stays to a few roundings of the longest aspect. Of some inputs:
//! the scalar code and other positions in a batch give the same bits.
//!
//! ```
//! use geograd::kernels::{IouObb2, fuzz};
//! let fuzzed = fuzz::pairs::<IouObb2, f32>(100_000, 1);
//! assert_eq!(fuzzed.broken, None, "{fuzzed}");
//! ```
use crate::ad::sample::Draw;
use crate::ad::symmetry::{Answer, Motion};
use crate::kernels::check::promises;
use crate::kernels::cpu;
use crate::kernels::cpu::arch::memory;
use crate::kernels::op::{PairOp, RingOp};
use crate::kernels::real::Real;
use crate::{Aabb2, Fixed, Obb2, Pack, Vec2};
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Inputs of one batch.
const CHUNK: usize = 4096;
/// Of so many inputs one is computed again by the scalar code.
const SINGLE: usize = 61;
/// Shapes of a square that is computed as all pairs.
const SQUARE: usize = 16;

/// Values may change by so many roundings, times the longest aspect, when shapes are exchanged, for
/// aspects up to a limit.
const ROUNDINGS: f64 = 64.0;
const LIMIT: f64 = 1e20;

/// How an operation broke what is promised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Promise {
    /// A valid input was refused.
    Accepted,
    /// A value or a slope is infinite or not a number.
    Finite,
    /// A ratio is in `[0, 1]`, an area or a length is not negative.
    Range,
    /// Identical shapes score 1 (or 0 where they count as empty) with slopes of zero.
    Identical,
    /// Exchanging the shapes changes nothing.
    Symmetric,
    /// All forms give the same bits.
    SameBits,
}

impl fmt::Display for Promise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Promise::Accepted => "a valid input is refused",
            Promise::Finite => "a number is not finite",
            Promise::Range => "the value is out of range",
            Promise::Identical => "identical shapes do not score as such",
            Promise::Symmetric => "exchanging the shapes changes the value",
            Promise::SameBits => "two forms give different bits",
        })
    }
}

/// The input at which a promise is broken.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// Which promise.
    pub promise: Promise,
    /// The numbers of the input, all shapes in a row.
    pub input: Vec<f64>,
}

/// What was fuzzed, and how it went.
#[derive(Clone, Debug, PartialEq)]
pub struct Fuzzed {
    /// The operation.
    pub op: &'static str,
    /// `f32` or `f64`.
    pub format: &'static str,
    /// How many inputs were drawn.
    pub inputs: u64,
    /// How long it took.
    pub time: Duration,
    /// The first thing that was found, if any.
    pub broken: Option<Broken>,
}

impl fmt::Display for Fuzzed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rate = self.inputs as f64 / self.time.as_secs_f64() / 1e6;
        let Fuzzed {
            op, format, inputs, ..
        } = self;
        write!(
            f,
            "{op:24} {format}  {inputs:>13} inputs, {rate:6.1} million a second: "
        )?;
        match &self.broken {
            None => f.write_str("ok"),
            Some(Broken { promise, input }) => write!(f, "{promise}: {input:?}"),
        }
    }
}

/// Numbers of a kind that breaks things.
#[derive(Clone, Copy)]
enum Family {
    /// Any bits that are a finite number.
    Bits,
    /// Sizes and places a few orders of magnitude apart.
    Moderate,
    /// Few different numbers, so that shapes share coordinates.
    Shared,
    /// Those, with angles of multiples of 45 degrees.
    Eighths,
    /// Of about unit size.
    Ordinary,
}

const FAMILIES: [Family; 5] = [
    Family::Bits,
    Family::Moderate,
    Family::Shared,
    Family::Eighths,
    Family::Ordinary,
];

/// Few different numbers.
const SHARED: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0, 0.1, -0.1, 1e-3, 1e3, 0.25, 1.5, -3.0,
];

impl Family {
    #[inline]
    fn number<T: Real>(self, bits: u64) -> T {
        match self {
            Family::Bits if is_wide::<T>() => T::lit(finite(f64::from_bits(bits))),
            Family::Bits => T::lit(finite(f32::from_bits((bits >> 32) as u32).into())),
            // From 2⁻¹⁶ to 2¹⁶, both signs.
            Family::Moderate => {
                let power = 1023 - 16 + (bits & 31);
                let sign = bits << 58 & 1 << 63;
                T::lit(f64::from_bits(sign | power << 52 | bits >> 12))
            }
            Family::Shared | Family::Eighths => T::lit(SHARED[(bits >> 60) as usize]),
            Family::Ordinary => T::lit((bits >> 11) as f64 / (1_u64 << 51) as f64 - 2.0),
        }
    }
    #[inline]
    fn angle<T: Real>(self, bits: u64) -> T {
        match self {
            Family::Eighths => {
                let eighth = (bits >> 60) as f64 - 8.0;
                T::lit(eighth * std::f64::consts::FRAC_PI_4)
            }
            _ => self.number(bits),
        }
    }
    fn any(draw: &mut Draw) -> Self {
        FAMILIES[draw.below(FAMILIES.len())]
    }
}

fn is_wide<T: Real>() -> bool {
    T::LARGEST > f64::from(f32::MAX)
}

fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { 1.0 }
}

/// A shape that can be drawn.
pub trait Drawn<T>: Fixed<Scalar = T> {
    /// A valid one from any numbers; `next(true)` is an angle.
    fn drawn(next: impl FnMut(bool) -> T) -> Self;
    /// The sizes of its sides, the shorter one first.
    fn sides(&self) -> [f64; 2];
}

impl<T: Real> Drawn<T> for Obb2<T> {
    #[inline]
    fn drawn(mut next: impl FnMut(bool) -> T) -> Self {
        let [x, y, w, h] = [(); 4].map(|()| next(false));
        Obb2::new(x, y, w.unsigned(), h.unsigned(), next(true))
    }
    fn sides(&self) -> [f64; 2] {
        let (w, h) = (self.size.x.widen(), self.size.y.widen());
        [w.min(h), w.max(h)]
    }
}

impl<T: Real> Drawn<T> for Aabb2<T> {
    #[inline]
    fn drawn(mut next: impl FnMut(bool) -> T) -> Self {
        let [left, bottom, right, top] = [(); 4].map(|()| next(false));
        Aabb2::new(
            left.least(right),
            bottom.least(top),
            left.most(right),
            bottom.most(top),
        )
    }
    fn sides(&self) -> [f64; 2] {
        let (w, h) = (
            self.max.x.widen() - self.min.x.widen(),
            self.max.y.widen() - self.min.y.widen(),
        );
        [w.min(h), w.max(h)]
    }
}

#[inline]
fn draw_shape<T: Real, X: Drawn<T>>(family: Family, draw: &mut Draw) -> X {
    X::drawn(|is_angle| match is_angle {
        true => family.angle(draw.bits()),
        false => family.number(draw.bits()),
    })
}

/// Runs chunks on all cores until there are so many inputs or one breaks a promise. A chunk gives the
/// number of its inputs.
fn run<T: Real>(
    op: &'static str,
    (count, seed): (u64, u64),
    chunk: impl Fn(&mut Draw) -> Result<(), Broken> + Sync,
) -> Fuzzed {
    let start = Instant::now();
    let (next, done) = (AtomicU64::new(0), AtomicU64::new(0));
    let broken: Mutex<Option<(u64, Broken)>> = Mutex::new(None);
    let chunks = count.div_ceil(CHUNK as u64);
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= chunks {
                return;
            }
            // Every chunk has numbers of its own, whoever draws them.
            let mut draw = Draw::new(Draw::new(seed).bits() ^ i << 20);
            let outcome = chunk(&mut draw);
            done.fetch_add(CHUNK as u64, Ordering::Relaxed);
            if let Err(found) = outcome {
                let mut first = broken.lock().unwrap_or_else(PoisonError::into_inner);
                if first.as_ref().is_none_or(|(at, _)| i < *at) {
                    *first = Some((i, found));
                }
                next.store(chunks, Ordering::Relaxed);
            }
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 1..cores {
            scope.spawn(work);
        }
        work();
    });
    let broken = broken.into_inner().unwrap_or_else(PoisonError::into_inner);
    Fuzzed {
        op,
        format: if is_wide::<T>() { "f64" } else { "f32" },
        inputs: done.into_inner(),
        time: start.elapsed(),
        broken: broken.map(|(_, broken)| broken),
    }
}

/// All numbers of shapes.
fn flat<X: Fixed>(shapes: &[X]) -> &[X::Scalar]
where
    X::Scalar: Real,
{
    memory::numbers(shapes).unwrap_or_default()
}

/// Whether two lists have the same bits.
fn same<T: Real>(a: &[T], b: &[T]) -> bool {
    let bits = |x: &T| x.widen().to_bits();
    a.len() == b.len() && a.iter().map(bits).eq(b.iter().map(bits))
}

/// The first place of a number that is not finite.
#[allow(clippy::eq_op)]
fn not_finite<T: Real>(list: &[T]) -> Option<usize> {
    // A number less itself is zero, unless it is infinite or none; sums need no branches.
    let (whole, rest) = list.as_chunks::<16>();
    let mut sums = [T::zero(); 16];
    for numbers in whole {
        for (sum, &x) in sums.iter_mut().zip(numbers) {
            *sum += x - x;
        }
    }
    let all = sums.iter().chain(rest).all(|x| x.widen().is_finite());
    if all {
        return None;
    }
    list.iter().position(|x| !x.widen().is_finite())
}

/// Fuzzes an operation of two shapes on all cores; stops at the first thing that it finds.
#[must_use]
pub fn pairs<O: PairOp, T: Real>(count: u64, seed: u64) -> Fuzzed
where
    O::A<T>: Drawn<T> + Into<O::B<T>>,
    O::B<T>: Drawn<T> + Into<O::A<T>>,
{
    run::<T>(O::NAME, (count, seed), |draw| {
        let (first, second) = (Family::any(draw), Family::any(draw));
        let (mut a, mut b) = (Vec::with_capacity(CHUNK), Vec::with_capacity(CHUNK));
        for i in 0..CHUNK {
            // Mostly two shapes of one family.
            a.push(draw_shape(first, draw));
            b.push(draw_shape(if i % 8 == 0 { second } else { first }, draw));
        }
        check_pairs::<O, T>(&a, &b)
    })
}

fn check_pairs<O: PairOp, T: Real>(a: &[O::A<T>], b: &[O::B<T>]) -> Result<(), Broken>
where
    O::A<T>: Drawn<T> + Into<O::B<T>>,
    O::B<T>: Drawn<T> + Into<O::A<T>>,
{
    let broken = |promise, i: usize| {
        let input = [a[i].scalars(), b[i].scalars()].concat();
        let input = input.iter().map(|x| x.widen()).collect();
        Err(Broken { promise, input })
    };
    let Ok((values, by_a, by_b)) = cpu::aligned_grad::<O, T>(a, b) else {
        return broken(Promise::Accepted, 0);
    };
    let slopes = [(flat(&by_a), O::A::<T>::LEN), (flat(&by_b), O::B::<T>::LEN)];
    for (list, fields) in [(&values[..], 1), slopes[0], slopes[1]] {
        if let Some(at) = not_finite(list) {
            return broken(Promise::Finite, at / fields);
        }
    }
    let is_ratio = O::NAME.starts_with("io");
    let limit = if is_ratio {
        T::one()
    } else {
        T::lit(T::LARGEST)
    };
    let outside = |x: &T| *x < T::zero() || *x > limit;
    if let Some(i) = values.iter().position(outside) {
        return broken(Promise::Range, i);
    }

    // A box with itself.
    let itself: Vec<O::B<T>> = a.iter().map(|x| (*x).into()).collect();
    let Ok((alone, by_a, by_b)) = cpu::aligned_grad::<O, T>(a, &itself) else {
        return broken(Promise::Accepted, 0);
    };
    if is_ratio {
        let ill = |x: &T| *x != T::one() && *x != T::zero();
        if let Some(i) = alone.iter().position(ill) {
            return broken(Promise::Identical, i);
        }
        // Nothing decides a union alone; a share of the first box has a kink here.
        let smooth = O::NAME.starts_with("iou");
        for (list, fields) in [(flat(&by_a), O::A::<T>::LEN), (flat(&by_b), O::B::<T>::LEN)] {
            let at = list.iter().position(|x| *x != T::zero());
            if let Some(at) = at.filter(|_| smooth) {
                return broken(Promise::Identical, at / fields);
            }
        }
    }

    // Exchanged.
    let mut promises = promises(O::NAME).iter();
    if promises.any(|x| (x.motion, x.answer) == (Motion::Exchange, Answer::Stays)) {
        let (p, q): (Vec<O::A<T>>, Vec<O::B<T>>) = a
            .iter()
            .zip(b)
            .map(|(a, b)| ((*b).into(), (*a).into()))
            .unzip();
        let Ok(exchanged) = cpu::aligned::<O, T>(&p, &q) else {
            return broken(Promise::Accepted, 0);
        };
        for (i, (&x, &y)) in values.iter().zip(&exchanged).enumerate() {
            let apart = (x.widen() - y.widen()).abs();
            if apart > 0.0
                && apart > exchange_may_change(is_ratio, a[i].sides(), b[i].sides()) * T::EPSILON
            {
                return broken(Promise::Symmetric, i);
            }
        }
    }

    // One by one, and all with all.
    for i in (0..a.len()).step_by(SINGLE) {
        let (p, q) = (O::frame_a(a[i]), O::frame_b(b[i]));
        let (value, (p, q)) = O::grad::<T, true>(p, q);
        let here = [&[values[i]], &flat_of(&slopes, i)[..]].concat();
        let single = [vec![value], p.scalars(), q.scalars()].concat();
        if !same(&here, &single) {
            return broken(Promise::SameBits, i);
        }
    }
    let square = SQUARE.min(a.len());
    let Ok(grads) = cpu::all_pairs_grad::<O, T>(&a[..square], &b[..square]) else {
        return broken(Promise::Accepted, 0);
    };
    for i in 0..square {
        let (p, q) = grads.at(i, i);
        let there = [vec![grads.values[i * square + i]], p.scalars(), q.scalars()].concat();
        let here = [&[values[i]], &flat_of(&slopes, i)[..]].concat();
        if !same(&here, &there) {
            return broken(Promise::SameBits, i);
        }
    }
    Ok(())
}

/// By how many roundings of one a score of two boxes with such sides may change when they are
/// exchanged; infinite where nothing is promised.
fn exchange_may_change(is_ratio: bool, a: [f64; 2], b: [f64; 2]) -> f64 {
    // A rounding of the longest side moves a side of the shorter ones.
    let aspect = a[1].max(b[1]) / a[0].min(b[0]);
    if !(aspect < LIMIT) {
        return f64::INFINITY;
    }
    let of_one = ROUNDINGS * aspect;
    if is_ratio {
        of_one
    } else {
        of_one * (a[0] * a[1]).min(b[0] * b[1])
    }
}

/// All slopes of one pair.
fn flat_of<T: Real>(slopes: &[(&[T], usize)], i: usize) -> Vec<T> {
    let of = |&(list, fields): &(&[T], usize)| list[i * fields..][..fields].to_vec();
    slopes.iter().flat_map(of).collect()
}

/// Fuzzes an operation of a ring on all cores; stops at the first thing that it finds.
#[must_use]
pub fn rings<O: RingOp, T: Real>(count: u64, seed: u64) -> Fuzzed {
    run::<T>(O::NAME, (count, seed), |draw| {
        let family = Family::any(draw);
        let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
        for _ in 0..CHUNK {
            for _ in 0..draw.below(9) {
                let (x, y) = (family.number(draw.bits()), family.number(draw.bits()));
                vertices.push(Vec2::new(x, y));
            }
            offsets.push(vertices.len());
        }
        check_rings::<O, T>(&vertices, &offsets)
    })
}

fn check_rings<O: RingOp, T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<(), Broken> {
    let ring = |i: usize| &vertices[offsets[i]..offsets[i + 1]];
    let broken = |promise, i: usize| {
        let input = ring(i).iter().flat_map(|v| [v.x.widen(), v.y.widen()]);
        Err(Broken {
            promise,
            input: input.collect(),
        })
    };
    let outcome = cpu::ragged::<O, T>(vertices, offsets).and_then(|values| {
        let ones: Vec<O::Out<T>> = values
            .iter()
            .map(|x| x.refill(&vec![T::one(); 2][..O::Out::<T>::LEN]))
            .collect();
        let bars = cpu::ragged_vjp::<O, T>(vertices, offsets, &ones)?;
        Ok((values, ones, bars))
    });
    let Ok((values, ones, bars)) = outcome else {
        return broken(Promise::Accepted, 0);
    };
    if let Some(at) = not_finite(flat(&values)) {
        return broken(Promise::Finite, at / O::Out::<T>::LEN);
    }
    if let Some(at) = not_finite(flat(&bars)) {
        return broken(
            Promise::Finite,
            offsets.partition_point(|&x| x <= at / 2) - 1,
        );
    }
    for i in (0..values.len()).step_by(SINGLE / 4) {
        let ring = ring(i);
        let mut slopes = ring.to_vec();
        O::ring_vjp(ring, ones[i], &mut slopes);
        let value = O::value(ring);
        let here = flat(&bars[offsets[i]..offsets[i + 1]]);
        if !same(&value.scalars(), &values[i].scalars()) || !same(flat(&slopes), here) {
            return broken(Promise::SameBits, i);
        }
    }
    Ok(())
}
