//! Tests of a list of inputs of an operation.
use super::arguments::InputColumns;
use super::families::{Family, limits_of, power};
use super::job::{Job, ResultLists};
use super::property::{Finding, Property};
use crate::ad::declared::Kind;
use crate::ad::forward::First;
use crate::ad::sample::Draw;
use crate::kernels::cpu::simd::Simd;
use crate::kernels::row::op::{Finite, Limits};
use crate::scalar::Guard;
use crate::{Jet, Real, Scalar};

/// The steps between inputs that the scalar code computes, too, and between inputs of duals.
const SINGLE: usize = 127;
const DUAL: usize = 1021;

/// The number of shapes whose all pairs are computed.
const SQUARE: usize = 16;

/// The number of roundings by which the value of duals may differ, apart from numbers below the smallest normal one.
const DUAL_ROUNDINGS: f64 = 16.0;

/// The choice of tests for a list, since all tests for all inputs would take too long.
#[derive(Clone, Copy, Debug)]
pub(super) struct TestSelection {
    /// `true` to compute at all levels of instructions.
    pub levels: bool,
    /// `true` to use cotangents of all sizes.
    pub upstream: bool,
    /// `true` to test exchanged and identical shapes.
    pub pairs: bool,
    /// The steps between inputs that the scalar code computes, too, and between inputs of duals.
    pub single: usize,
    pub dual: usize,
}

impl TestSelection {
    /// All tests.
    pub const ALL: TestSelection = TestSelection {
        levels: true,
        upstream: true,
        pairs: true,
        single: 1,
        dual: 1,
    };
    /// Returns a random choice of tests.
    pub fn some(draw: &mut Draw) -> Self {
        TestSelection {
            levels: draw.once_in(8),
            upstream: draw.once_in(2),
            pairs: draw.once_in(3),
            single: SINGLE,
            dual: DUAL,
        }
    }
}

/// Results and derivatives of many inputs.
pub(super) struct BatchResults<T> {
    pub values: ResultLists<T>,
    pub derivatives: ResultLists<T>,
}

pub(super) type Outcome = Result<(), Finding>;

/// Returns the finding that a property is broken at `place`; no finding for `None`.
pub(super) fn unless(property: Property, place: Option<usize>) -> Outcome {
    place.map_or(Ok(()), |at| Err(Finding { property, at }))
}

/// Returns `true` if two lists have equal bits.
fn same<T: Real>(a: &[T], b: &[T]) -> bool {
    let bits = |x: &T| x.widen().to_bits();
    a.len() == b.len() && a.iter().map(bits).eq(b.iter().map(bits))
}

/// Returns the index of the first number that is not finite.
#[allow(clippy::eq_op)]
fn not_finite<T: Real>(list: &[T]) -> Option<usize> {
    // A number minus itself is zero unless it is infinite or NaN; sums need no branches.
    let (whole, rest) = list.as_chunks::<16>();
    let mut sums = [T::zero(); 16];
    for numbers in whole {
        for (sum, &x) in sums.iter_mut().zip(numbers) {
            *sum += x - x;
        }
    }
    match sums.iter().chain(rest).all(|x| x.finite()) {
        true => None,
        false => list.iter().position(|x| !x.finite()),
    }
}

/// Returns the index of the first entry that is `ill`, which is rare.
pub(super) fn first_where<T>(list: &[T], ill: impl Fn(&T) -> bool) -> Option<usize> {
    let found = list.iter().fold(false, |any, x| any | ill(x));
    found.then(|| list.iter().position(ill)).flatten()
}

impl<T: Real> Job<T> {
    /// Returns cotangents of one.
    fn ones(&self, count: usize) -> ResultLists<T> {
        let of = |&fields: &usize| vec![T::one(); fields * count];
        self.outputs.iter().map(of).collect()
    }

    pub(super) fn compute(&self, inputs: &InputColumns<T>) -> Result<BatchResults<T>, Finding> {
        let refused = |_| Finding {
            property: Property::Accepted,
            at: 0,
        };
        if let Some(both) = &self.both {
            let mut values = both(inputs, []).map_err(refused)?;
            let derivatives = values.split_off(self.outputs.len());
            return Ok(BatchResults {
                values,
                derivatives,
            });
        }
        let values = (self.values)(inputs, []).map_err(refused)?;
        let derivatives =
            (self.derivatives)(inputs, [&self.ones(inputs.count)]).map_err(refused)?;
        Ok(BatchResults {
            values,
            derivatives,
        })
    }

    /// Returns the index of the input to which derivative number `at` of a list belongs.
    fn input_at(&self, inputs: &InputColumns<T>, list: usize, at: usize) -> usize {
        match self.shapes.get(list) {
            Some(shape) => at / shape.leaf.fields,
            None => {
                inputs
                    .offsets
                    .partition_point(|&x| x <= at / self.vertex.len().max(1))
                    - 1
            }
        }
    }

    /// Returns the derivatives of one input.
    pub(super) fn derivatives_of(
        &self,
        inputs: &InputColumns<T>,
        derivatives: &ResultLists<T>,
        i: usize,
    ) -> Vec<T> {
        let mut own = Vec::with_capacity(self.kinds.len());
        for (k, list) in derivatives.iter().enumerate() {
            match self.shapes.get(k) {
                Some(shape) => {
                    let n = shape.leaf.fields;
                    own.extend_from_slice(&list[i * n..][..n - shape.leaf.codes]);
                }
                None => {
                    let n = self.vertex.len();
                    own.extend_from_slice(&list[n * inputs.offsets[i]..n * inputs.offsets[i + 1]]);
                }
            }
        }
        own
    }

    pub(super) fn value_of(&self, values: &ResultLists<T>, i: usize) -> Vec<T> {
        let own = values.iter().zip(&self.outputs);
        own.flat_map(|(list, &n)| list[i * n..][..n].to_vec())
            .collect()
    }

    fn finite_values(&self, values: &ResultLists<T>) -> Outcome {
        if self.declared.finite == Finite::Undeclared {
            return Ok(());
        }
        values
            .iter()
            .zip(&self.outputs)
            .try_for_each(|(list, n)| unless(Property::Finite, not_finite(list).map(|at| at / n)))
    }

    fn finite_derivatives(
        &self,
        inputs: &InputColumns<T>,
        derivatives: &ResultLists<T>,
    ) -> Outcome {
        if matches!(self.declared.finite, Finite::Undeclared | Finite::Values(_)) {
            return Ok(());
        }
        derivatives.iter().enumerate().try_for_each(|(k, list)| {
            let place = not_finite(list).map(|at| self.input_at(inputs, k, at));
            unless(Property::Finite, place)
        })
    }

    /// Tests inputs until the first finding.
    pub(super) fn judge(
        &self,
        inputs: &InputColumns<T>,
        upstream: &ResultLists<T>,
        how: TestSelection,
    ) -> Outcome {
        let found = self.compute(inputs)?;
        self.finite_values(&found.values)?;
        self.finite_derivatives(inputs, &found.derivatives)?;
        let range = self.declared.range;
        let (least, most) = (T::lit(range.least), T::lit(range.largest));
        for (list, n) in found.values.iter().zip(&self.outputs) {
            let outside = first_where(list, |x| (*x < least) | (*x > most));
            unless(Property::Range, outside.map(|at| at / n))?;
        }
        self.same_bits(inputs, &found, how)?;
        self.duals(inputs, &found, how)?;
        self.nan(inputs, &found, how)?;
        if how.upstream && self.declared.finite == Finite::Always {
            let derivatives = (self.derivatives)(inputs, [upstream]);
            let derivatives = derivatives.map_err(|_| Finding {
                property: Property::Accepted,
                at: 0,
            })?;
            self.finite_derivatives(inputs, &derivatives)?;
        }
        self.apart(inputs, &found)?;
        if !how.pairs || self.shapes.len() != 2 {
            return Ok(());
        }
        self.identical(inputs)?;
        self.exchanged(inputs, &found)
    }

    /// Tests that the scalar code, other levels, other forms and other positions give equal bits.
    fn same_bits(
        &self,
        inputs: &InputColumns<T>,
        found: &BatchResults<T>,
        how: TestSelection,
    ) -> Outcome {
        let broken = |place| unless(Property::SameBits, place);
        let accepted = |place| Finding {
            property: Property::Accepted,
            at: place,
        };
        let is_wild = |list: &[T]| {
            self.declared.finite == Finite::Undeclared && !list.iter().all(|x| x.finite())
        };
        let mut places = (0..inputs.count).step_by(how.single);
        broken(places.find(|&i| {
            let x = inputs.item(self, i);
            let value = self.value_of(&found.values, i);
            if is_wild(&value) {
                return false;
            }
            let ones: Vec<T> = value.iter().map(|_| T::one()).collect();
            // Batches return no zero with a sign.
            let plain =
                |list: Vec<T>| -> Vec<T> { list.into_iter().map(|x| x.canonical()).collect() };
            !same(&plain((self.alone)(&x)), &value)
                || (self.by_hand)(&x, &ones).is_some_and(|(other, derivatives)| {
                    !same(&plain(other), &value)
                        || !same(
                            &plain(derivatives),
                            &self.derivatives_of(inputs, &found.derivatives, i),
                        )
                })
        }))?;
        let compare = |other: &ResultLists<T>, own: &ResultLists<T>, is_derivative: bool| {
            for (k, (other, own)) in other.iter().zip(own).enumerate() {
                if same(other, own) {
                    continue;
                }
                let differs = |i: &usize| {
                    other[*i].widen().to_bits() != own[*i].widen().to_bits()
                        && !is_wild(&own[*i..=*i])
                };
                let place = (0..own.len()).find(differs);
                broken(place.map(|at| match is_derivative {
                    true => self.input_at(inputs, k, at),
                    false => at / self.outputs[k],
                }))?;
            }
            Ok(())
        };
        if how.levels {
            let values = (self.values)(inputs, []).map_err(|_| accepted(0))?;
            compare(&values, &found.values, false)?;
            let derivatives = (self.derivatives)(inputs, [&self.ones(inputs.count)]);
            compare(
                &derivatives.map_err(|_| accepted(0))?,
                &found.derivatives,
                true,
            )?;
            let level = Simd::in_use();
            for other in Simd::available() {
                Simd::limit(Some(other)).map_err(|_| accepted(0))?;
                let again = self.compute(inputs);
                Simd::limit(Some(level)).map_err(|_| accepted(0))?;
                let again = again?;
                compare(&again.values, &found.values, false)?;
                compare(&again.derivatives, &found.derivatives, true)?;
            }
        }
        let Some(square) = self
            .square
            .as_ref()
            .filter(|_| how.pairs && inputs.count > SQUARE)
        else {
            return Ok(());
        };
        // From an index that is no multiple of a lane's length.
        let items = 1..1 + SQUARE;
        let planes = square(inputs, items.clone()).map_err(|_| accepted(1))?;
        let place = (0..SQUARE).find(|&i| {
            let here = [
                self.value_of(&found.values, 1 + i),
                match self.both {
                    Some(_) => self.derivatives_of(inputs, &found.derivatives, 1 + i),
                    None => Vec::new(),
                },
            ]
            .concat();
            let matrix = SQUARE * SQUARE;
            let there: Vec<T> = planes
                .iter()
                .skip(i * (SQUARE + 1))
                .step_by(matrix)
                .copied()
                .collect();
            !is_wild(&here) && !same(&here, &there)
        });
        broken(place.map(|i| 1 + i))
    }

    /// Tests that duals are finite, with the value of plain numbers.
    fn duals(
        &self,
        inputs: &InputColumns<T>,
        found: &BatchResults<T>,
        how: TestSelection,
    ) -> Outcome {
        let Some(recorded) = &self.recorded else {
            return Ok(());
        };
        if !matches!(self.declared.finite, Finite::Always | Finite::Within(_)) {
            return Ok(());
        }
        let chunk = <First<T> as Scalar>::lit(0.0).derivative.len();
        for i in (0..inputs.count).step_by(how.dual) {
            let x = inputs.item(self, i);
            if self.declared.finite == Finite::Always && !self.is_for_duals(&x) {
                continue;
            }
            let value = self.value_of(&found.values, i);
            for start in (0..x.len()).step_by(chunk) {
                let jets = x.iter().enumerate();
                let jets: Vec<First<T>> = jets
                    .map(|(k, &x)| Jet::variable(x, k.wrapping_sub(start)))
                    .collect();
                for (jet, &value) in recorded.run_on(&jets).iter().zip(&value) {
                    let finite = jet.value.finite() && jet.derivative.iter().all(|x| x.finite());
                    let (one, other) = (jet.value.widen(), value.widen());
                    let apart =
                        (one - other).abs() - DUAL_ROUNDINGS * T::format().epsilon() * other.abs();
                    let property = match finite {
                        true if apart <= 1.0 / T::format().largest() * 8.0 => continue,
                        true => Property::Duals,
                        false => Property::Finite,
                    };
                    return Err(Finding { property, at: i });
                }
            }
        }
        Ok(())
    }

    /// Sets one number after another of some inputs to NaN: guarded results must be NaN, and without NaN guards must
    /// not change a bit.
    fn nan(
        &self,
        inputs: &InputColumns<T>,
        found: &BatchResults<T>,
        how: TestSelection,
    ) -> Outcome {
        let Some(recorded) = &self.recorded else {
            return Ok(());
        };
        for (turn, i) in (0..inputs.count).step_by(how.dual).enumerate() {
            let mut x = inputs.item(self, i);
            let guarded = |x: &[T]| -> Vec<T> {
                let guard = Guard::of_numbers(x);
                let value = recorded.run(x).into_iter();
                value.map(|number| guard.result(number)).collect()
            };
            let value = self.value_of(&found.values, i);
            let kept = guarded(&x);
            let k = turn % x.len().max(1);
            x[k] = T::lit(f64::NAN);
            let lost = guarded(&x).iter().any(|number| number.equals(*number));
            let is_number = value.iter().all(|x| x.finite());
            if lost || is_number && !kept.iter().zip(&value).all(|(a, &b)| a.equals(b)) {
                return Err(Finding {
                    property: Property::Nan,
                    at: i,
                });
            }
        }
        Ok(())
    }

    /// Returns `true` if duals are declared to be finite, too.
    fn is_for_duals(&self, x: &[T]) -> bool {
        let [least, most] = limits_of::<T>(Finite::Within(Limits::ORDINARY)).unwrap_or_default();
        let range = power(least)..=power(most);
        x.iter().zip(&self.kinds).all(|(x, &kind)| {
            let size = x.widen().abs();
            kind.is_angle() || size == 0.0 || range.contains(&size)
        })
    }

    /// Returns cotangents of all sizes.
    pub(super) fn cotangents(&self, draw: &mut Draw, count: usize) -> ResultLists<T> {
        let family = Family::any::<T>(draw);
        let mut of = |&fields: &usize| {
            let numbers = (0..fields * count).map(|_| family.number(Kind::Number, draw));
            numbers.collect()
        };
        self.outputs.iter().map(&mut of).collect()
    }
}
