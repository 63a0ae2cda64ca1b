//! Reductions of plain numbers: sums, maximum, and tests of limits.
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::{Mask, Real};

/// The number of numbers that one turn of a loop reads.
const SIDE: usize = 32;

/// Returns the largest number; minus infinity for an empty list.
#[inline(always)]
pub(crate) fn largest<T: Real, V: Vector<T>>(numbers: &[T]) -> T {
    let least = T::lit(f64::NEG_INFINITY);
    let mut lanes = [least; SIDE];
    let (whole, rest) = numbers.as_chunks::<SIDE>();
    for part in whole {
        for (lane, &x) in lanes.iter_mut().zip(part) {
            *lane = if x > *lane { x } else { *lane };
        }
    }
    let all = lanes.iter().chain(rest);
    all.fold(least, |most, &x| if x > most { x } else { most })
}

/// Returns the number of entries above a threshold.
#[inline(always)]
pub(crate) fn count_above<T: Real, V: Vector<T>>(numbers: &[T], threshold: T) -> u64 {
    numbers.iter().map(|&x| u64::from(x > threshold)).sum()
}

/// Adds numbers to sixteen sums, number `i` to sum `i` modulo sixteen.
#[inline(always)]
pub(crate) fn add_up<T: Real, V: Vector<T>>(numbers: &[T], sums: &mut [f64; TILE]) {
    let (whole, rest) = numbers.as_chunks::<TILE>();
    for part in whole {
        for (sum, x) in sums.iter_mut().zip(part) {
            *sum += x.widen();
        }
    }
    for (sum, x) in sums.iter_mut().zip(rest) {
        *sum += x.widen();
    }
}

/// Returns `true` if every number is finite.
#[allow(clippy::eq_op)]
#[inline(always)]
pub(crate) fn all_finite<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (whole, rest) = numbers.as_chunks::<TILE>();
    // A finite number minus itself is zero, any other one minus itself is NaN. Separate sums need not wait for each
    // other.
    let mut sums = [V::zero(); 4];
    for numbers in whole {
        let lane = Lane(*numbers);
        for (k, at) in V::starts().enumerate() {
            let x = V::read(&lane, at);
            sums[k % 4] += x - x;
        }
    }
    let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    sum.equals(V::zero()).all() && rest.iter().all(|x| x.finite())
}

/// Returns `true` if every number is finite and none beyond a limit.
#[inline(always)]
pub(crate) fn all_up_to<T: Real, V: Vector<T>>(numbers: &[T], limit: f64) -> bool {
    let (whole, rest) = numbers.as_chunks::<TILE>();
    let (zero, limit) = (V::zero(), T::lit(limit));
    let (most, mut all) = (V::splat(limit), zero.equals(zero));
    for numbers in whole {
        let lane = Lane(*numbers);
        for at in V::starts() {
            all = all & V::read(&lane, at).unsigned().at_most(most);
        }
    }
    all.all() && rest.iter().all(|x| x.unsigned().at_most(limit))
}

/// Returns `all` restricted to places whose number is zero or within limits. `limits` are: −1 to limit the magnitude,
/// else 1; the smallest size; the largest size.
#[inline(always)]
fn within<T: Real, V: Vector<T>>(
    numbers: &[T; TILE],
    [sign, low, high]: &[Lane<T>; 3],
    mut all: V::Mask,
) -> V::Mask {
    let (numbers, zero) = (Lane(*numbers), V::zero());
    let mut at = 0;
    while at < TILE {
        let x = V::read(&numbers, at);
        // One maximum is cheaper than a selection.
        let size = x.most(x * V::read(sign, at));
        let above = V::read(low, at).at_most(size) | size.equals(zero);
        all = all & above & size.at_most(V::read(high, at));
        at += V::WIDTH;
    }
    all
}

/// Returns `true` if every number is zero or within the limits of its field, for items of `FIELDS` numbers. The limits
/// of a signed field apply to the magnitude.
#[inline(always)]
pub(crate) fn all_within<T: Real, V: Vector<T>, const FIELDS: usize>(
    numbers: &[T],
    signed: [bool; FIELDS],
    low: [f64; FIELDS],
    high: [f64; FIELDS],
) -> bool {
    let is_within = |(i, &x): (usize, &T)| {
        let k = i % FIELDS;
        let (x, low, high) = (if signed[k] { x.unsigned() } else { x }, low[k], high[k]);
        x.at_most(T::lit(high)) && (x.at_least(T::lit(low)) || x.equals(T::default()))
    };
    // Less work than to write the limits.
    if numbers.len() < FIELDS * TILE {
        return numbers.iter().enumerate().all(is_within);
    }
    // Sixteen items are FIELDS lanes, whose limits repeat.
    let limits = |k: usize, of: [f64; FIELDS]| {
        let mut lane = Lane([T::default(); TILE]);
        for (i, x) in lane.0.iter_mut().enumerate() {
            *x = T::lit(of[(k * TILE + i) % FIELDS]);
        }
        lane
    };
    let mut lanes = [[Lane::default(); 3]; FIELDS];
    let signs = signed.map(|signed| if signed { -1.0 } else { 1.0 });
    for (k, lane) in lanes.iter_mut().enumerate() {
        *lane = [limits(k, signs), limits(k, low), limits(k, high)];
    }
    let zero = V::zero();
    let mut all = zero.equals(zero);
    let (whole, rest) = numbers.as_chunks::<TILE>();
    let (groups, few) = whole.as_chunks::<FIELDS>();
    for group in groups {
        let mut k = 0;
        while k < FIELDS {
            all = within::<T, V>(&group[k], &lanes[k], all);
            k += 1;
        }
    }
    for (numbers, limits) in few.iter().zip(&lanes) {
        all = within::<T, V>(numbers, limits, all);
    }
    let done = whole.len() * TILE;
    all.all() && (done..).zip(rest).all(is_within)
}

/// Returns `true` if every axis-aligned box is finite and no lower bound is above its upper one.
#[inline(always)]
pub(crate) fn all_aabb2<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let (items, _) = numbers.as_chunks::<4>();
    let ordered = items
        .iter()
        .fold(true, |all, x| all & x[0].at_most(x[2]) & x[1].at_most(x[3]));
    ordered & all_finite::<T, V>(numbers)
}
