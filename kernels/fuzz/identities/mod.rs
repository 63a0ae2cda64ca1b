//! Identities between verbs, as data: equations between the results of several rows for one input.
//!
//! Inputs lie on a coarse grid, so that shapes share ends, vertices, planes and directions, are flat or have no size.
//! They are exact, rounded, rotated as a whole, or off the grid by a few roundings. Every identity names its verbs, and
//! is tested for every pair of shapes that has rows of them.
//!
//! A program with this list compiles every row: the example takes a minute to build, and only its types are checked here.
//!
//! ```no_run,standalone_crate
//! use geograd::kernels::identities;
//! let asked = identities::all().find(|asked| asked.name() == "exchange of distance_obb2").expect("has rows");
//! let fuzzed = asked.fuzz::<f64>(2000, 1);
//! assert_eq!(fuzzed.broken, None, "{fuzzed}");
//! ```
mod operands;
mod sentences;

use crate::Real;
use crate::ad::sample::{Draw, fewer_digits};
use crate::kernels::dynamic::{Function, Rows};
use crate::kernels::fuzz::couples::OF_SEARCHES;
use crate::kernels::fuzz::tested::{Tested, rows};
use crate::kernels::fuzz::{self, Broken, Fuzzed, Property};
use operands::ArgumentRanges;
use sentences::{Case, SENTENCES, Sentence, ShapeOf};
use std::collections::HashMap;
use std::time::Instant;

/// The number of inputs in a batch.
const CHUNK: u64 = 1024;

/// An identity of certain rows.
#[derive(Clone, Debug)]
pub struct Identity {
    name: &'static str,
    sentence: &'static Sentence,
    /// The row whose arguments are the input.
    row: &'static Tested,
    parts: ArgumentRanges,
    /// The other rows; `true` if a row takes its arguments in exchanged order.
    asked: Vec<(&'static Tested, bool)>,
}

/// Returns all identities of all rows.
// Inlined, so that the calling crate compiles the rows, not this one.
#[inline]
pub fn all() -> impl Iterator<Item = Identity> {
    of_rows(rows())
}

/// Returns the identities of some rows.
fn of_rows(rows: &'static [Tested]) -> impl Iterator<Item = Identity> {
    let mut by_shapes: HashMap<(String, String), &'static Tested> = HashMap::new();
    for row in rows {
        by_shapes.insert((row.operation.verb(), shapes_of(row).join(" ")), row);
    }
    SENTENCES.iter().flat_map(move |sentence| {
        let of = |row: &'static Tested| Identity::of(sentence, row, &by_shapes);
        let of_verb = |row: &&Tested| sentence.verbs.contains(&&*row.operation.verb());
        let found: Vec<Identity> = rows.iter().filter(of_verb).filter_map(of).collect();
        found
    })
}

/// Returns the largest magnitude of a number and some more.
fn largest_of(first: f64, rest: &[f64]) -> f64 {
    rest.iter().fold(first, |most, x| most.max(x.abs()))
}

/// Returns the names of the shapes that a row takes.
fn shapes_of(row: &Tested) -> Vec<String> {
    let arguments = row.operation.arguments().into_iter();
    arguments.map(|argument| argument.shape.name).collect()
}

/// A row on columns, and the numbers of its arguments.
struct RowColumns<T: Real> {
    function: Function<T>,
    fields: [usize; 2],
}

impl<T: Real> RowColumns<T> {
    fn of(row: &Tested) -> Option<Self> {
        let layouts = row.operation.layouts::<T>();
        let [a, b] = &layouts[..] else { return None };
        Some(RowColumns {
            function: row.operation.value()?,
            fields: [a.fields(), b.fields()],
        })
    }
    /// Returns the results for items, each with the numbers of both arguments.
    fn results(&self, items: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let column = |from: usize, n: usize| -> Vec<T> {
            let own = items.iter().flat_map(|x| &x[from..from + n]);
            own.map(|&x| T::lit(x)).collect()
        };
        let [n, m] = self.fields;
        let columns = [column(0, n), column(n, m)];
        let rows = [Rows::new(&columns[0], n), Rows::new(&columns[1], m)];
        let lists = self.function.aligned(&rows).ok()?;
        let gives = self.function.gives();
        let result = |i: usize| {
            let lists = lists.iter().zip(&gives);
            let own = lists.flat_map(|(list, n)| &list[i * n..][..*n]);
            own.map(|x| x.widen()).collect()
        };
        Some((0..items.len()).map(result).collect())
    }
}

impl Identity {
    fn of(
        sentence: &'static Sentence,
        row: &'static Tested,
        rows: &HashMap<(String, String), &'static Tested>,
    ) -> Option<Self> {
        let shapes = shapes_of(row);
        let parts = ArgumentRanges::of(row)?;
        if shapes.len() != 2 {
            return None;
        }
        let point = match parts.dimension {
            2 => "Vec2",
            _ => "Vec3",
        };
        let mut asked = Vec::new();
        for question in sentence.asks {
            let verb = match question.verb {
                "" => row.operation.verb(),
                verb => verb.to_owned(),
            };
            let name = |part: ShapeOf| match part {
                ShapeOf::Argument(k) => shapes[k].as_str(),
                ShapeOf::Point => point,
            };
            let by = |of: [ShapeOf; 2]| {
                let shapes = of.map(name).join(" ");
                rows.get(&(verb.clone(), shapes)).copied()
            };
            let [first, second] = question.of;
            let straight = by([first, second]).map(|row| (row, false));
            asked.push(straight.or_else(|| by([second, first]).map(|row| (row, true)))?);
        }
        // A row compared with itself would test nothing.
        let says_nothing =
            sentence
                .asks
                .iter()
                .zip(&asked)
                .any(|(question, (other, exchanged))| {
                    question.of == [ShapeOf::Argument(1), ShapeOf::Argument(0)]
                        && *exchanged
                        && other.name() == row.name()
                });
        (!says_nothing).then(|| Identity {
            // Names live as long as rows, which are static.
            name: Box::leak(format!("{} of {}", sentence.name, row.name()).into_boxed_str()),
            sentence,
            row,
            parts,
            asked,
        })
    }

    /// Returns the sentence with its row: `hits lie on the shape of first_hit_ray2_circle`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the name of the row's function: `first_hit_ray2_circle`.
    #[must_use]
    pub fn row(&self) -> &'static str {
        self.row.name()
    }

    /// Returns the index of the first input for which the identity does not hold.
    fn first_broken<T: Real>(&self, inputs: &[Vec<f64>]) -> Option<usize> {
        let Some(values) = RowColumns::<T>::of(self.row)?.results(inputs) else {
            return Some(0);
        };
        let mut cases: Vec<Case<'_>> = Vec::new();
        for (input, value) in inputs.iter().zip(values) {
            cases.push(Case {
                parts: &self.parts,
                input,
                value,
                slack: 0.0,
            });
        }
        let mut largest: Vec<f64> = inputs.iter().map(|x| largest_of(0.0, x)).collect();
        // The answers of the other rows for every case; `None` if one row has no answer.
        let mut answers: Vec<Option<Vec<f64>>> = cases.iter().map(|_| Some(Vec::new())).collect();
        for (question, &(row, exchanged)) in self.sentence.asks.iter().zip(&self.asked) {
            let (mut items, mut whose) = (Vec::new(), Vec::new());
            let layouts = row.operation.layouts::<T>();
            for (i, case) in cases.iter().enumerate() {
                let Some([first, second]) = (question.arguments)(case) else {
                    answers[i] = None;
                    continue;
                };
                let both = if exchanged {
                    [second, first]
                } else {
                    [first, second]
                };
                let is_valid = both.iter().zip(&layouts).all(|(x, layout)| {
                    let x: Vec<T> = x.iter().map(|&x| T::lit(x)).collect();
                    layout.check(&x).is_ok()
                });
                let item = both.concat();
                match is_valid && row.operation.is_inside(&item) {
                    true => {
                        largest[i] = largest_of(largest[i], &item);
                        items.push(item);
                        whose.push(i);
                    }
                    false => answers[i] = None,
                }
            }
            let Some(results) = RowColumns::<T>::of(row)?.results(&items) else {
                return whose.first().copied();
            };
            for (i, result) in whose.into_iter().zip(results) {
                if let Some(answers) = &mut answers[i] {
                    answers.push(result[0]);
                }
            }
        }
        for (case, largest) in cases.iter_mut().zip(largest) {
            let roundings = self.sentence.roundings * T::format().epsilon();
            case.slack = roundings.max(OF_SEARCHES) * largest;
        }
        let mut all = cases.iter().zip(&answers);
        all.position(|(case, answers)| {
            let answers = answers.as_ref();
            answers.is_some_and(|answers| !(self.sentence.holds)(case, answers))
        })
    }

    /// Tests it for `count` inputs from a seed.
    #[must_use]
    pub fn fuzz<T: Real>(&self, count: u64, seed: u64) -> Fuzzed {
        let start = Instant::now();
        let mut draw = Draw::new(seed);
        let (mut done, mut outside, mut broken) = (0, 0, None);
        while done < count && broken.is_none() {
            let mut inputs = Vec::new();
            while (inputs.len() as u64) < CHUNK.min(count - done) {
                match self.parts.draw::<T>(self.row, &mut draw) {
                    Some(x) => inputs.push(x),
                    None => outside += 1,
                }
            }
            done += inputs.len() as u64;
            let at = self.first_broken::<T>(&inputs);
            broken = at.map(|at| self.shrunk::<T>(inputs.swap_remove(at)));
        }
        Fuzzed {
            op: self.name,
            format: fuzz::format::<T>(),
            inputs: done,
            outside,
            time: start.elapsed(),
            broken,
        }
    }

    /// Returns the input with as few digits as possible for which the identity is broken.
    fn shrunk<T: Real>(&self, mut x: Vec<f64>) -> Broken {
        let is_broken = |x: &Vec<f64>| {
            self.parts.is_valid::<T>(self.row, x)
                && self.first_broken::<T>(std::slice::from_ref(x)).is_some()
        };
        // Every step has fewer digits than the one before, so the loop ends.
        while let Some(simpler) = fewer_digits(x.clone()).find(is_broken) {
            x = simpler;
        }
        Broken {
            property: Property::Identity(self.sentence.name),
            code: format!("{} at {}", self.row.name(), self.row.show(&x)),
            upstream: Vec::new(),
            input: x,
        }
    }
}
