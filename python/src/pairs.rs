//! The forms of two lists: every row of the one with every row of the other.
use crate::arrays::{ArgumentNumbers, CallArgument, Target, written};
use crate::column::{Column, NUMBERS};
use crate::forms::{Call, Object, in_format};
use crate::number::{Form, Number};
use geograd::kernels::dynamic::Rows;
use geograd::kernels::reduce::{Best, Found};
use numpy::{PyArray1, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A form of two lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairs {
    All,
    RowMax,
    ColumnMax,
    Above,
    CountAbove,
    Sum,
    Mean,
    SumGrad,
    MeanGrad,
    Vjp,
    RowMin,
    ColumnMin,
    Nearest,
    Below,
    CountBelow,
    RowMinGrad,
    ColumnMinGrad,
    NearestGrad,
}

impl Pairs {
    const ALL: [(&'static str, Pairs); 18] = [
        ("all_pairs", Pairs::All),
        ("row_max", Pairs::RowMax),
        ("column_max", Pairs::ColumnMax),
        ("above", Pairs::Above),
        ("count_above", Pairs::CountAbove),
        ("sum", Pairs::Sum),
        ("mean", Pairs::Mean),
        ("sum_grad", Pairs::SumGrad),
        ("mean_grad", Pairs::MeanGrad),
        ("all_pairs_vjp", Pairs::Vjp),
        ("row_min", Pairs::RowMin),
        ("column_min", Pairs::ColumnMin),
        ("nearest", Pairs::Nearest),
        ("below", Pairs::Below),
        ("count_below", Pairs::CountBelow),
        ("row_min_grad", Pairs::RowMinGrad),
        ("column_min_grad", Pairs::ColumnMinGrad),
        ("nearest_grad", Pairs::NearestGrad),
    ];
    /// Returns the form of a name.
    pub fn named(name: &str) -> PyResult<Pairs> {
        let form = Pairs::ALL.iter().find(|form| form.0 == name);
        form.map(|form| form.1)
            .ok_or_else(|| PyValueError::new_err(format!("no form is called {name}")))
    }
}

impl<'py> Call<'_, 'py> {
    /// Runs a form of two lists: with a threshold or upstream derivatives where it takes `more`, and within groups
    /// where these are given.
    pub fn of_pairs(
        &self,
        form: Pairs,
        more: Option<&Object<'py>>,
        groups: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let py = self.py;
        let more = || more.ok_or_else(|| PyTypeError::new_err("a third argument is needed"));
        let threshold = || more()?.extract::<f64>();
        match (form, groups) {
            (Pairs::All, _) => self.all_pairs(),
            (Pairs::RowMax | Pairs::ColumnMax, None) => self.most(form == Pairs::RowMax),
            (Pairs::RowMax | Pairs::ColumnMax, Some(groups)) => {
                self.most_grouped(form == Pairs::RowMax, groups)
            }
            (Pairs::Above, None) => self.above(threshold()?),
            (Pairs::Above, Some(groups)) => self.above_grouped(threshold()?, groups),
            (Pairs::CountAbove, _) => Ok(self
                .count_above(threshold()?)?
                .into_pyobject(py)?
                .into_any()),
            (Pairs::Sum | Pairs::Mean, _) => Ok(self
                .total(form == Pairs::Mean)?
                .into_pyobject(py)?
                .into_any()),
            (Pairs::SumGrad | Pairs::MeanGrad, _) => self.total_grad(form == Pairs::MeanGrad),
            (Pairs::Vjp, _) => self.all_pairs_vjp(more()?),
            (_, groups) => self.nearest(form, more()?, groups),
        }
    }
    /// Both lists of a call of all pairs.
    pub fn two(&self) -> PyResult<Vec<CallArgument<'py>>> {
        let takes = &self.of.takes;
        if takes.len() != 2 {
            return Err(PyTypeError::new_err(format!(
                "{} takes {} arguments; pairs are of two",
                self.name,
                takes.len()
            )));
        }
        self.given(takes)
    }
    fn lists<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
    ) -> PyResult<[ArgumentNumbers<'py, T>; 2]> {
        let takes = &self.of.takes;
        let lent = self.lent::<T>(given, takes)?;
        for (one, column) in lent.iter().zip(takes) {
            if one.lead().len() > 1 {
                return Err(PyValueError::new_err(format!(
                    "`{}`: a list of rows is needed, an array of shape {}, not one with {} leading axes",
                    column.name,
                    if column.axes.is_empty() {
                        "(N,)".to_owned()
                    } else {
                        format!("(N, {})", column.fields())
                    },
                    one.lead().len()
                )));
            }
        }
        <[ArgumentNumbers<'py, T>; 2]>::try_from(lent)
            .map_err(|_| PyTypeError::new_err("two lists are needed"))
    }
    /// Both lists of every batch: the axes of the batches, and the lists, each with all of these axes.
    pub fn batched<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
    ) -> PyResult<(Vec<usize>, [ArgumentNumbers<'py, T>; 2])> {
        let takes = &self.of.takes;
        let lent = self.lent::<T>(given, takes)?;
        let most = lent.iter().map(|x| x.lead().len()).max().unwrap_or(0);
        let pair = |all: Vec<ArgumentNumbers<'py, T>>| {
            <[ArgumentNumbers<'py, T>; 2]>::try_from(all)
                .map_err(|_| PyTypeError::new_err("two lists are needed"))
        };
        if most <= 1 {
            return Ok((Vec::new(), pair(lent)?));
        }
        let axes = |x: &ArgumentNumbers<'py, T>| {
            x.lead()
                .split_last()
                .map_or((1, Vec::new()), |(&n, axes)| (n, axes.to_vec()))
        };
        let own: Vec<(usize, Vec<usize>)> = lent.iter().map(axes).collect();
        let mut batches = vec![1_usize; most - 1];
        for ((_, axes), column) in own.iter().zip(takes) {
            let from = batches.len() - axes.len();
            for (axis, &size) in batches[from..].iter_mut().zip(axes) {
                match (*axis, size) {
                    (a, b) if a == b || b == 1 => {}
                    (1, size) => *axis = size,
                    (a, b) => {
                        return Err(PyValueError::new_err(format!(
                            "`{}` has {b} batches where {a} are needed",
                            column.name
                        )));
                    }
                }
            }
        }
        let fitted =
            lent.into_iter()
                .zip(own)
                .zip(takes)
                .map(|((x, (n, axes)), column)| match axes == batches {
                    true => Ok(x),
                    false => x.repeated(self.py, &[&batches[..], &[n]].concat(), column),
                });
        let fitted = pair(fitted.collect::<PyResult<Vec<_>>>()?)?;
        Ok((batches, fitted))
    }
    /// The lists of every batch, and how many rows each has.
    pub fn each<'a, T: Number>(
        &self,
        batches: &[usize],
        lists: &'a [ArgumentNumbers<'py, T>; 2],
        slices: &'a [Vec<&'a [T]>; 2],
    ) -> (Vec<[Rows<'a, T>; 2]>, [usize; 2]) {
        let count: usize = batches.iter().product();
        let rows = [0, 1].map(|k| lists[k].lead().last().copied().unwrap_or(1));
        let of = |k: usize, i: usize| {
            if batches.is_empty() {
                return lists[k].rows(&slices[k], false);
            }
            let fields = self.of.takes[k].fields();
            let size = rows[k] * fields;
            Rows::new(&slices[k][0][i * size..(i + 1) * size], fields)
        };
        ((0..count).map(|i| [of(0, i), of(1, i)]).collect(), rows)
    }
    pub fn reduced<T: Number, R: Send>(
        &self,
        given: Vec<CallArgument<'py>>,
        reduce: impl FnOnce([Rows<'_, T>; 2]) -> Result<R, geograd::Error> + Send,
    ) -> PyResult<R> {
        self.one_number()?;
        let [a, b] = self.lists::<T>(given)?;
        let items = a.count().saturating_mul(b.count());
        let slices = [a.slices()?, b.slices()?];
        let lists = [a.rows(&slices[0], false), b.rows(&slices[1], false)];
        self.run(items, || reduce(lists))
    }

    /// Every row of `a` with every row of `b`.
    fn all_pairs(&self) -> PyResult<Object<'py>> {
        self.of.signature(Form::Value)?;
        let given = self.two()?;
        in_format!(self, given, pairs)
    }
    fn pairs<T: Number>(&self, given: Vec<CallArgument<'py>>) -> PyResult<Object<'py>> {
        let function = self.of.function::<T>(Form::Value)?;
        let (batches, lists) = self.batched::<T>(given)?;
        let slices = [lists[0].slices()?, lists[1].slices()?];
        let (each, [rows, columns]) = self.each(&batches, &lists, &slices);
        let numbers = self.of.outputs();
        let planes = (numbers != 1).then_some(numbers);
        let mut shape = batches.clone();
        shape.extend(planes.into_iter().chain([rows, columns]));
        let target = match self.out {
            None => Target::new(self.py, &shape)?,
            Some(out) => Target::given(out, &shape, "result")?,
        };
        let mut guard = target.lock("result")?;
        let slice = written(&mut guard)?;
        let (machine, size) = (&self.machine, numbers * rows * columns);
        self.run(slice.len(), || {
            let mut slices = slice.chunks_exact_mut(size.max(1));
            each.into_iter().try_for_each(|lists| {
                machine.of(function)?.all_pairs_into(
                    lists[0],
                    lists[1],
                    slices.next().unwrap_or_default(),
                )
            })
        })?;
        drop(guard);
        target.done(|array| match planes {
            None => Ok(array),
            // Numbers of a result last, as everywhere.
            Some(_) => self
                .py
                .import("numpy")?
                .call_method1("moveaxis", (array, -3, -1)),
        })
    }

    /// The largest result of every row or of every column, and where it is.
    fn most(&self, of_rows: bool) -> PyResult<Object<'py>> {
        let given = self.two()?;
        in_format!(self, given, best, of_rows)
    }
    fn best<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        of_rows: bool,
    ) -> PyResult<Object<'py>> {
        self.one_number()?;
        let function = self.of.function::<T>(Form::Value)?;
        let (batches, lists) = self.batched::<T>(given)?;
        let slices = [lists[0].slices()?, lists[1].slices()?];
        let (each, [rows, columns]) = self.each(&batches, &lists, &slices);
        let machine = &self.machine;
        let items = rows.saturating_mul(columns).saturating_mul(each.len());
        let (own, others) = if of_rows {
            (rows, columns)
        } else {
            (columns, rows)
        };
        if others == 0 {
            // As in a group: a frame without truths is an ordinary one.
            let mut shape = batches;
            shape.push(own);
            let numpy = self.py.import("numpy")?;
            let full =
                |x: Object<'py>| numpy.call_method1("full", (PyTuple::new(self.py, &shape)?, x));
            let nothing = PyArray1::from_vec(self.py, vec![T::narrowed(f64::NEG_INFINITY)]);
            let none = PyArray1::from_vec(self.py, vec![-1_isize]);
            let (nothing, none) = (nothing.get_item(0)?, none.get_item(0)?);
            return Ok((full(nothing)?, full(none)?)
                .into_pyobject(self.py)?
                .into_any());
        }
        let found: Vec<Best<T>> = self.run(items, || {
            let all = each.into_iter().map(|lists| match of_rows {
                true => machine.of(function)?.row_max(lists[0], lists[1]),
                false => machine.of(function)?.column_max(lists[0], lists[1]),
            });
            Ok(all.collect::<Result<Vec<_>, geograd::Error>>()?.concat())
        })?;
        let values = PyArray1::from_iter(self.py, found.iter().map(|best| best.value));
        let places = PyArray1::from_iter(self.py, found.iter().map(|best| best.index as isize));
        let mut shape = batches;
        shape.push(if of_rows { rows } else { columns });
        let shaped =
            |array: &Object<'py>| array.call_method1("reshape", (PyTuple::new(self.py, &shape)?,));
        Ok((shaped(values.as_any())?, shaped(places.as_any())?)
            .into_pyobject(self.py)?
            .into_any())
    }

    /// Every pair above a threshold: rows, columns, values.
    fn above(&self, threshold: f64) -> PyResult<Object<'py>> {
        let given = self.two()?;
        in_format!(self, given, found, threshold)
    }
    fn found<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        threshold: f64,
    ) -> PyResult<Object<'py>> {
        let function = self.of.function::<T>(Form::Value)?;
        let machine = &self.machine;
        let all: Vec<Found<T>> = self.reduced::<T, _>(given, |lists| {
            machine
                .of(function)?
                .above(lists[0], lists[1], T::narrowed(threshold))
        })?;
        let rows = PyArray1::from_iter(self.py, all.iter().map(|found| found.row as isize));
        let columns = PyArray1::from_iter(self.py, all.iter().map(|found| found.column as isize));
        let values = PyArray1::from_iter(self.py, all.iter().map(|found| found.value));
        Ok((rows, columns, values).into_pyobject(self.py)?.into_any())
    }

    /// How many pairs are above a threshold.
    fn count_above(&self, threshold: f64) -> PyResult<u64> {
        let given = self.two()?;
        in_format!(self, given, counted, threshold)
    }
    fn counted<T: Number>(&self, given: Vec<CallArgument<'py>>, threshold: f64) -> PyResult<u64> {
        let function = self.of.function::<T>(Form::Value)?;
        let machine = &self.machine;
        self.reduced::<T, _>(given, |lists| {
            machine
                .of(function)?
                .count_above(lists[0], lists[1], T::narrowed(threshold))
        })
    }

    /// The sum of all results, or their mean.
    fn total(&self, is_mean: bool) -> PyResult<f64> {
        let given = self.two()?;
        in_format!(self, given, totalled, is_mean)
    }
    fn totalled<T: Number>(&self, given: Vec<CallArgument<'py>>, is_mean: bool) -> PyResult<f64> {
        let function = self.of.function::<T>(Form::Value)?;
        let machine = &self.machine;
        self.reduced::<T, _>(given, |lists| match is_mean {
            true => machine.of(function)?.mean(lists[0], lists[1]),
            false => machine.of(function)?.sum(lists[0], lists[1]),
        })
    }

    /// The same with its gradient by both lists.
    fn total_grad(&self, is_mean: bool) -> PyResult<Object<'py>> {
        let given = self.two()?;
        in_format!(self, given, lost, is_mean)
    }
    fn lost<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        is_mean: bool,
    ) -> PyResult<Object<'py>> {
        let function = self.of.function::<T>(Form::Value)?;
        let machine = &self.machine;
        let shapes = self.shapes_of(&given);
        let (value, a, b) = self.reduced::<T, _>(given, |lists| match is_mean {
            true => machine.of(function)?.mean_grad(lists[0], lists[1]),
            false => machine.of(function)?.sum_grad(lists[0], lists[1]),
        })?;
        let derivatives = (self.shaped(a, &shapes[0])?, self.shaped(b, &shapes[1])?);
        Ok((value, derivatives).into_pyobject(self.py)?.into_any())
    }

    /// Gradients of the sum of all results, each times its number of a matrix.
    fn all_pairs_vjp(&self, upstream: &Object<'py>) -> PyResult<Object<'py>> {
        let mut given = self.two()?;
        let column = Column {
            name: "upstream".to_owned(),
            kind: NUMBERS,
            axes: Vec::new(),
        };
        given.push(CallArgument::new(upstream, &column)?);
        in_format!(self, given, pulled)
    }
    fn pulled<T: Number>(&self, mut given: Vec<CallArgument<'py>>) -> PyResult<Object<'py>> {
        let function = self.of.function::<T>(Form::Value)?;
        let column = Column {
            name: "upstream".to_owned(),
            kind: NUMBERS,
            axes: Vec::new(),
        };
        let upstream = given
            .pop()
            .ok_or_else(|| PyTypeError::new_err("upstream is needed"))?;
        let upstream = ArgumentNumbers::<T>::new(self.py, upstream, &column)?;
        let shapes = self.shapes_of(&given);
        self.one_number()?;
        let [a, b] = self.lists::<T>(given)?;
        let wanted = [a.count(), b.count()];
        if upstream.lead() != wanted {
            return Err(PyValueError::new_err(format!(
                "`upstream`: an array of shape {wanted:?} is needed, a number for every pair, not {:?}",
                upstream.lead()
            )));
        }
        let slices = [a.slices()?, b.slices()?];
        let lists = [a.rows(&slices[0], false), b.rows(&slices[1], false)];
        let (numbers, machine) = (upstream.numbers()?, &self.machine);
        let (a, b) = self.run(wanted[0].saturating_mul(wanted[1]), || {
            machine
                .of(function)?
                .all_pairs_vjp(lists[0], lists[1], numbers)
        })?;
        Ok((self.shaped(a, &shapes[0])?, self.shaped(b, &shapes[1])?)
            .into_pyobject(self.py)?
            .into_any())
    }
    pub fn shapes_of(&self, given: &[CallArgument<'py>]) -> Vec<Vec<usize>> {
        let shape = |given: &CallArgument<'py>| match given {
            CallArgument::Array(array) => array.shape().to_vec(),
            CallArgument::Columns(columns) => {
                let count = columns.first().map_or(0, |own| own.bind(self.py).len());
                vec![count, columns.len()]
            }
            CallArgument::Indexed(items) => vec![items.count(), items.fields(self.py)],
            CallArgument::Number(_) => Vec::new(),
        };
        given.iter().map(shape).collect()
    }
}
