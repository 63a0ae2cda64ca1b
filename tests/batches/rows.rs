//! Batches of every row: the bits of the function and of its derivatives on plain numbers, at every level of vector
//! instructions and at every position of a batch.
use crate::bits::Turn;
use geograd::ad::check::sample::Draw;
use geograd::kernels::cpu::program::measured::compile_after;
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::dynamic::{Bound, Function, Mode, Rows, Sort, names, operations};
use geograd::kernels::op::Finite;
use geograd::{Error, Real, Unrecordable};
use geograd_tests::list::{self, Tested, each};
use std::collections::HashMap;

/// Lengths of batches: less than any vector, not a whole number of them, several pieces.
const LENGTHS: [usize; 3] = [1, 17, 300];
/// Items of what searches, and of programs of so many operations: each of them costs more.
const FEW: usize = 40;
const LONG: usize = 5000;

/// Bits of numbers; all NaN are one.
pub fn bits<T: Into<f64> + Copy>(numbers: &[T]) -> Vec<u64> {
    let one = |&x: &T| match x.into() {
        x if x.is_nan() => u64::MAX,
        x => x.to_bits(),
    };
    numbers.iter().map(one).collect()
}

/// A number of a batch.
pub trait Number: Real + Into<f64> {}
impl<T: Real + Into<f64>> Number for T {}

/// The results of every item alone, as bits.
struct Known<T> {
    items: Vec<Vec<T>>,
    /// A cotangent of every item.
    bars: Vec<Vec<T>>,
    values: Vec<Vec<u64>>,
    /// Derivatives of the cotangents; of a search none.
    derivatives: Vec<Vec<u64>>,
    /// The value with its gradient, of one number.
    gradients: Vec<Vec<u64>>,
}

impl<T: Number> Known<T> {
    fn new(row: &Tested) -> Self {
        let (operation, name) = (&row.operation, row.name());
        let program = operation.program::<T>();
        let is_long = program
            .as_ref()
            .is_ok_and(|program| program.cost().total() > LONG);
        let count = match operation.sort {
            Sort::Straight if !is_long => LENGTHS[2],
            _ => FEW,
        };
        let mut hard = row.hard().into_iter().step_by(5).take(count / 2);
        let drawn = |draw: &mut Draw| hard.next().unwrap_or_else(|| row.random(draw));
        let items = list::inputs::<T>(row, count, drawn);
        let outputs = list::outputs(row);
        let mut draw = Draw::new(12);
        let mut bar = || {
            (0..outputs)
                .map(|_| T::lit(draw.within(-2.0, 2.0)))
                .collect()
        };
        let bars: Vec<Vec<T>> = items.iter().map(|_| bar()).collect();
        let values = items.iter().map(|x| bits(&row.alone(x))).collect();
        let programs = match program {
            Ok(program) => {
                let gradient = (outputs == 1).then(|| program.value_grad().expect(name));
                Some((program.vjp().expect(name), gradient))
            }
            Err(error) => {
                assert_eq!(operation.sort, Sort::Search, "{name}: {error}");
                assert_eq!(error, Error::Program(Unrecordable::Search), "{name}");
                None
            }
        };
        let by_program = programs.as_ref();
        let derivatives = items.iter().zip(&bars).filter_map(|(x, bar)| {
            if let Some((_, derivatives)) = row.by_hand(x, bar) {
                return Some(bits(&derivatives));
            }
            let given = [&x[..], bar].concat();
            Some(bits(&by_program?.0.eval(&given).expect(name)))
        });
        let gradients = items.iter().filter_map(|x| {
            let program = by_program?.1.as_ref()?;
            if let Some((value, derivatives)) = row.by_hand(x, &[T::one()]) {
                return Some(bits(&[value, derivatives].concat()));
            }
            Some(bits(&program.eval(x).expect(name)))
        });
        Known {
            values,
            derivatives: derivatives.collect(),
            gradients: gradients.collect(),
            items,
            bars,
        }
    }

    /// Compares batches of some lengths.
    fn check(&self, row: &Tested, level: Simd) {
        for count in LENGTHS.map(|count| count.min(self.items.len())) {
            let items = &self.items[..count];
            let of = |mode| row.operation.function::<T>(mode).expect("is of fixed size");
            let values = of_items(&of(Mode::Value), row, items, &[]);
            let derivatives = of_items(&of(Mode::Vjp), row, items, &self.bars);
            let gradients = row
                .operation
                .value_grad::<T>()
                .map(|function| of_items(&function, row, items, &[]));
            assert_eq!(gradients.is_some(), self.bars[0].len() == 1);
            for (i, item) in items.iter().enumerate() {
                let at = || format!("{} {level:?} {count}: {item:?}", row.name());
                assert_eq!(bits(&values[i]), self.values[i], "{}", at());
                if let Some(expected) = self.derivatives.get(i) {
                    assert_eq!(bits(&derivatives[i]), *expected, "derivatives of {}", at());
                }
                let Some(gradients) = &gradients else {
                    continue;
                };
                if let Some(expected) = self.gradients.get(i) {
                    assert_eq!(bits(&gradients[i]), *expected, "gradient of {}", at());
                    continue;
                }
                // The cotangent of a search's result of one number scales its gradient.
                let arguments = row.operation.arguments();
                let fields = arguments.iter().flat_map(|x| &x.shape.fields);
                for (k, field) in fields.enumerate() {
                    let by = match field.bound {
                        Bound::Whole => T::one(),
                        _ => self.bars[i][0],
                    };
                    let expected: f64 = (gradients[i][1 + k] * by).into();
                    let found: f64 = derivatives[i][k].into();
                    assert_eq!(found, expected, "by {k}: {}", at());
                }
            }
        }
    }
}

/// The results of a batch, item by item.
fn of_items<T: Number>(
    function: &Function<T>,
    row: &Tested,
    items: &[Vec<T>],
    bars: &[Vec<T>],
) -> Vec<Vec<T>> {
    let mut columns = list::columns(row, items);
    columns.extend((!bars.is_empty()).then(|| bars[..items.len()].concat()));
    let fields = function
        .takes()
        .into_iter()
        .map(|(_, layout)| layout.fields());
    let rows = columns.iter().zip(fields).map(|(x, n)| Rows::new(x, n));
    let lists = function
        .aligned(&rows.collect::<Vec<_>>())
        .unwrap_or_else(|_| panic!("{}", row.name()));
    let gives = function.gives();
    let item = |i: usize| {
        let lists = lists.iter().zip(&gives);
        lists
            .flat_map(|(list, n)| list[i * n..][..*n].to_vec())
            .collect()
    };
    (0..items.len()).map(item).collect()
}

fn every_row_of_fixed_size<T: Number>() {
    let is_fixed = |row: &&Tested| matches!(row.operation.sort, Sort::Straight | Sort::Search);
    let rows = list::rows().into_iter().filter(is_fixed).collect();
    let rows = list::sample(rows, &list::COMPILED);
    let known = std::sync::Mutex::new(HashMap::new());
    each(&rows, |row| {
        let own = Known::<T>::new(row);
        known.lock().unwrap().insert(row.name(), own);
    });
    let known = known.into_inner().unwrap();
    let _turn = Turn::take();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        // Interpreted, then as machine code, which the baseline has none of.
        let ways: &[usize] = match level {
            Simd::Baseline => &[usize::MAX],
            _ => &[usize::MAX, 0],
        };
        for &tiles in ways {
            compile_after(tiles);
            each(&rows, |row| known[row.name()].check(row, level));
        }
    }
}

#[test]
fn double_has_the_bits_of_the_function() {
    every_row_of_fixed_size::<f64>();
}

#[test]
fn single_has_the_bits_of_the_function() {
    every_row_of_fixed_size::<f32>();
}

/// Tables write the names of rows, and their operations have them.
#[test]
fn rows_are_named_as_their_tables_say() {
    let (names, operations) = (names(), operations());
    assert_eq!(names.len(), operations.len());
    for (name, operation) in names.iter().zip(operations) {
        assert_eq!(name.row, operation.name);
        assert_eq!(name.verb, operation.verb());
        let taken = operation.arguments().len();
        let is_path = operation.sort == Sort::Fold;
        assert!(is_path || taken == name.shapes.len(), "{}", name.spelling);
    }
    let mut all: Vec<&str> = names.iter().map(|name| name.row).collect();
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), names.len(), "every row has a name of its own");
    let mut all: Vec<&str> = names.iter().map(|name| &*name.spelling).collect();
    all.sort_unstable();
    let twice = all.windows(2).find(|pair| pair[0] == pair[1]);
    // A conversion's spelling says what it takes and not what it makes.
    assert!(twice.is_none_or(|pair| pair[0].starts_with("convert(")));
}

/// The inputs of which results of every row are finite.
pub fn finite() -> Vec<(&'static str, Finite)> {
    let all = operations().iter();
    all.map(|operation| (operation.name, operation.finite))
        .collect()
}
