//! Sums of least squares over the items of an aligned batch: the normal equations of a step of Gauss and Newton.
use super::columns::listed;
use super::primitives::try_then_check;
use super::{Column, Columns, Engine, Items, Machine, Number, On, count_of};
use crate::Real;
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::Call;
use crate::kernels::machine::found::check_threshold;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::{STRETCH, Target};
use crate::scalar::elementary::ln_1p;

/// The loss of an item's residuals, a function of their length `r`. The threshold is in the unit of the residuals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Robust {
    /// `r² / 2`: least squares.
    Squares,
    /// `r² / 2` up to a threshold `t`, and the line `t · (r − t / 2)` beyond (Huber 1964).
    Huber(f64),
    /// `t² / 2 · ln(1 + r² / t²)` with the threshold `t`, which grows more slowly than any line (Cauchy's density).
    Cauchy(f64),
}

impl Robust {
    /// Returns the loss, and its derivative by half the square of `r`: the weight of the residuals.
    fn of(self, square: f64) -> [f64; 2] {
        match self {
            Robust::Huber(t) if square > t * t => {
                let r = square.sqrt();
                [t * (r - 0.5 * t), t / r]
            }
            Robust::Cauchy(t) => {
                let share = square / (t * t);
                [0.5 * t * t * ln_1p(share), 1.0 / (1.0 + share)]
            }
            Robust::Squares | Robust::Huber(_) => [0.5 * square, 1.0],
        }
    }
    /// Returns an error for a threshold that is not finite and above zero.
    fn check(self) -> Result<(), Error> {
        let (Robust::Huber(t) | Robust::Cauchy(t)) = self else {
            return Ok(());
        };
        check_threshold(t)?;
        match t > 0.0 {
            true => Ok(()),
            false => Err(Error::Invalid {
                argument: Argument::Threshold,
                item: 0,
                flaw: Flaw::NotPositive(Field::VALUE),
            }),
        }
    }
}

/// The sums of least squares over all items, by the numbers of some arguments: `n` numbers in the order of these.
///
/// The step `x` of Gauss and Newton solves `jtj · x = −jtr`.
#[derive(Clone, Debug, PartialEq)]
pub struct Squares {
    /// The matrix `Σ w Jᵀ J`, row by row: `n` times `n` numbers.
    pub jtj: Vec<f64>,
    /// The vector `Σ w Jᵀ r`, the gradient of the cost.
    pub jtr: Vec<f64>,
    /// The sum of the losses.
    pub cost: f64,
}

/// The derivatives of some items: numbers of the result, of all arguments, and the places of the chosen ones.
struct Rows<'a> {
    results: usize,
    numbers: usize,
    chosen: &'a [usize],
}

impl Squares {
    /// Adds an item with its residuals and their Jacobian.
    fn add<T: Real>(&mut self, rows: &Rows<'_>, residuals: &[T], jacobian: &[T], loss: Robust) {
        let square: f64 = residuals.iter().map(|x| x.widen() * x.widen()).sum();
        let [cost, weight] = loss.of(square);
        self.cost += cost;
        let n = rows.chosen.len();
        for k in 0..rows.results {
            let gradient = &jacobian[k * rows.numbers..][..rows.numbers];
            for (i, &at) in rows.chosen.iter().enumerate() {
                let own = weight * gradient[at].widen();
                self.jtr[i] += own * residuals[k].widen();
                for (j, &other) in rows.chosen[..=i].iter().enumerate() {
                    self.jtj[i * n + j] += own * gradient[other].widen();
                }
            }
        }
    }
}

/// Returns the sums of least squares by the arguments with some indices, each of which is one shape for all items.
pub(crate) fn squares<T: Real>(
    engine: &dyn Engine<T>,
    call: &Call<T>,
    columns: &[Column<'_, T>],
    by: &[usize],
    loss: Robust,
) -> Result<Squares, Error> {
    loss.check()?;
    let takes = &call.recording.takes;
    let starts = takes.iter().scan(0, |end, leaf| {
        *end += leaf.fields;
        Some(*end - leaf.fields)
    });
    let starts: Vec<usize> = starts.collect();
    let mut chosen = Vec::new();
    for &argument in by {
        let (Some(column), Some(leaf)) = (columns.get(argument), takes.get(argument)) else {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: argument + 1,
            });
        };
        if let Some(found) = column.count {
            expect(call.argument(argument), 1, found)?;
        }
        let scalars = leaf.fields - leaf.codes;
        chosen.extend(starts[argument]..starts[argument] + scalars);
    }
    let rows = Rows {
        results: call.recording.outputs.iter().sum(),
        numbers: takes.iter().map(|leaf| leaf.fields).sum(),
        chosen: &chosen,
    };
    let n = chosen.len();
    let mut sums = Squares {
        jtj: vec![0.0; n * n],
        jtr: vec![0.0; n],
        cost: 0.0,
    };
    let count = count_of(call, columns)?;
    let derived = call.clone().derived(Mode::Jacobian)?;
    for start in (0..count).step_by(STRETCH) {
        let items = start..count.min(start + STRETCH);
        let mut room = Vec::new();
        let numbers = columns.iter().map(|column| {
            let part = if column.count.is_none() {
                0..1
            } else {
                items.clone()
            };
            column.numbers(part, &mut room).to_vec()
        });
        let numbers: Vec<Vec<T>> = numbers.collect();
        let part = numbers.iter().zip(columns).map(|(numbers, column)| {
            let count = column.count.map(|_| items.len());
            Column::lent(numbers, column.fields, count)
        });
        let part: Vec<_> = part.collect();
        let mut residuals: Vec<Vec<T>> = Vec::new();
        for &fields in &call.recording.outputs {
            residuals.push(vec![T::default(); items.len() * fields]);
        }
        let wide = rows.results * rows.numbers;
        let mut jacobians = vec![T::default(); items.len() * wide];
        try_then_check(|new| {
            let own = residuals.iter_mut().zip(&call.recording.outputs);
            let mut targets: Vec<_> = own
                .map(|(numbers, &fields)| Some(Target::of_rows(numbers, fields)))
                .collect();
            targets.push(Some(Target::of_rows(&mut jacobians, wide)));
            engine.map(&derived, &part, Items::Targets(targets, new))
        })
        .map_err(|error| later(error, start))?;
        let mut own = Vec::new();
        for i in 0..items.len() {
            own.clear();
            for (numbers, &fields) in residuals.iter().zip(&call.recording.outputs) {
                own.extend_from_slice(&numbers[i * fields..][..fields]);
            }
            sums.add(&rows, &own, &jacobians[i * wide..][..wide], loss);
        }
    }
    for i in 0..n {
        for j in 0..i {
            sums.jtj[j * n + i] = sums.jtj[i * n + j];
        }
    }
    Ok(sums)
}

/// Returns an error about an item of a stretch as one about an item of all.
fn later(error: Error, start: usize) -> Error {
    match error {
        Error::Invalid {
            argument,
            item,
            flaw,
        } => Error::Invalid {
            argument,
            item: item + start,
            flaw,
        },
        error => error,
    }
}

/// Sums of least squares.
impl<E: ?Sized> Machine<E> {
    /// Returns the sums of least squares of a function's results, as residuals, over all items: `Σ w Jᵀ J`, `Σ w Jᵀ r`
    /// and the cost. `J` is the Jacobian by the numbers of the arguments whose indices are in `by`; each of these is
    /// one shape for all items ([`One`](crate::kernels::One)).
    ///
    /// `loss` makes outliers count less: `w` is the derivative of the loss of an item by half its squared residual, so
    /// that `jtr` is the gradient of the cost. Sums are added in `f64`, item by item. Memory does not grow with the
    /// number of items.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Machine::aligned); [`Error::Length`] for an argument in `by` that is a list,
    /// [`Error::Arguments`] for an index without an argument, and [`Error::Invalid`] for a threshold that is not finite
    /// and above zero.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, One, Robust, function};
    /// use geograd::{Circle, Scalar, Vec2};
    /// /// How far a point is beyond a circle's border.
    /// fn beyond<S: Scalar>(point: Vec2<S>, circle: Circle<S>) -> S {
    ///     (point - circle.center).length() - circle.radius
    /// }
    /// let points = [(3.0, 0.0), (0.0, 2.0), (-2.0, 0.0), (0.0, -2.0)].map(|(x, y)| Vec2::new(x, y));
    /// let guess = One(Circle::new(Vec2::new(0.0, 0.0), 2.0));
    /// let cpu = Cpu::new();
    /// let sums = cpu.squares(function(beyond), (&points, guess), &[1], Robust::Squares)?;
    /// assert_eq!((sums.cost, &sums.jtr[..]), (0.5, &[-1.0, 0.0, -1.0][..]));
    /// assert_eq!(sums.jtj[8], 4.0); // four points, each with a derivative of -1 by the radius
    /// let robust = cpu.squares(function(beyond), (&points, guess), &[1], Robust::Huber(0.1))?;
    /// assert!((robust.jtr[2] + 0.1).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn squares<C: Columns, R: Function<C::Item>>(
        &self,
        run: R,
        columns: C,
        by: &[usize],
        loss: Robust,
    ) -> Result<Squares, Error>
    where
        Number<C>: On<E>,
    {
        squares(self.engine(), &run.call()?, &listed(&columns), by, loss)
    }
}
