//! The reduction of an input to a simpler one that breaks its property.
use super::Broken;
use super::arguments::InputColumns;
use super::families::limits_of;
use super::inputs::is_valid;
use super::job::{Job, ResultLists};
use super::properties::TestSelection;
use super::property::Property;
use crate::Real;

/// The number of copies of an input, so that forms for long lists are tested, too.
const COPIES: usize = 20;

/// The largest number of attempts.
const ATTEMPTS: usize = 4000;

/// Returns the property that an input breaks.
fn broken<T: Real>(job: &Job<T>, x: &[T], bars: &[T]) -> Option<Property> {
    let inputs = InputColumns::repeated(job, x, COPIES);
    let mut rest = bars;
    let bar = |&fields: &usize| {
        let (own, others) = rest.split_at(fields);
        rest = others;
        own.repeat(COPIES)
    };
    let bars: ResultLists<T> = job.outputs.iter().map(bar).collect();
    let found = job.judge(&inputs, &bars, TestSelection::ALL);
    found.err().map(|found| found.property)
}

/// Returns `true` if a number is within the row's limits.
fn fits<T: Real>(job: &Job<T>, x: T) -> bool {
    let Some([least, most]) = limits_of::<T>(job.declared.finite) else {
        return true;
    };
    let size = x.widen().abs();
    size == 0.0 || (super::families::power(least)..=super::families::power(most)).contains(&size)
}

/// Returns simpler numbers, the simplest first.
fn simpler<T: Real>(x: T, others: &[T]) -> Vec<T> {
    let wide = x.widen();
    let mut all = vec![0.0, 1.0, -1.0, 2.0, 0.5];
    all.extend([3, 8, 20].map(|bits: u32| {
        // Fewer binary digits.
        f64::from_bits(wide.to_bits() & !((1 << (52 - bits)) - 1))
    }));
    all.push(wide.round());
    for digits in [1, 2, 4] {
        all.extend(format!("{wide:.digits$e}").parse::<f64>());
    }
    let own = all.iter().position(|&y| y == wide).unwrap_or(all.len());
    all.truncate(own);
    let mut all: Vec<T> = all.into_iter().map(T::lit).filter(|y| y.finite()).collect();
    if own > 0 {
        all.extend(others.iter().copied().filter(|y| *y != x));
    }
    all
}

/// Returns the approximate number of digits of all numbers.
fn length<T: Real>(numbers: &[T]) -> usize {
    let digits = |x: &T| match x.widen() {
        0.0 => 0,
        1.0 => 1,
        x => format!("{x:e}").len(),
    };
    numbers.iter().map(digits).sum()
}

/// Returns the simplest input near `x` that breaks a property, and the property.
pub(super) fn shrunk<T: Real>(job: &Job<T>, x: Vec<T>, bars: Vec<T>, property: Property) -> Broken {
    let (mut x, mut bars) = (x, bars);
    let is_alone = broken(job, &x, &bars) == Some(property);
    let mut attempts = if is_alone { ATTEMPTS } else { 0 };
    let ones = vec![T::one(); bars.len()];
    if is_alone && broken(job, &x, &ones) == Some(property) {
        bars = ones;
    }
    // Drops vertices that are not needed.
    let own = job.kinds.len();
    let mut at = own;
    while is_alone && at + 2 <= x.len() {
        let fewer = [&x[..at], &x[at + 2..]].concat();
        match broken(job, &fewer, &bars) == Some(property) {
            true => x = fewer,
            false => at += 2,
        }
    }
    let mut is_better = true;
    while is_better && attempts > 0 {
        is_better = false;
        for i in 0..x.len() + bars.len() {
            let number = |i: usize, x: &[T], bars: &[T]| match i < x.len() {
                true => x[i],
                false => bars[i - x.len()],
            };
            if i >= x.len() && number(i, &x, &bars) == T::one() {
                continue;
            }
            for y in simpler(number(i, &x, &bars), if i < x.len() { &x } else { &[] }) {
                if attempts == 0 {
                    break;
                }
                attempts -= 1;
                let (mut near, mut near_bars) = (x.clone(), bars.clone());
                match i < near.len() {
                    true => near[i] = y,
                    false => near_bars[i - x.len()] = y,
                }
                let numbers = |x: &[T], bars: &[T]| length(x) + length(bars);
                if numbers(&near, &near_bars) < numbers(&x, &bars)
                    && near.iter().all(|&x| fits(job, x))
                    && is_valid(job, &near)
                    && broken(job, &near, &near_bars) == Some(property)
                {
                    (x, bars) = (near, near_bars);
                    is_better = true;
                    break;
                }
            }
        }
    }
    // The shortest decimals of the format.
    let plain = |x: &T| match super::families::is_wide::<T>() {
        true => x.widen(),
        false => (x.widen() as f32)
            .to_string()
            .parse()
            .unwrap_or_else(|_| x.widen()),
    };
    let input: Vec<f64> = x.iter().map(plain).collect();
    let upstream: Vec<f64> = bars.iter().map(plain).collect();
    Broken {
        property,
        code: format!("{}: {}", job.op, (job.show)(&input)),
        input,
        upstream,
    }
}
