//! The forms of a call, for rows of the table and for traced functions.
use crate::arrays::{
    ArgumentNumbers, CallArgument, Target, aligned, broadcast, is_double, offsets, with_fields,
    written,
};
use crate::call::Callable;
use crate::column::{Column, NUMBERS};
use crate::machine::Machine;
use crate::number::{Form, Number};
use crate::raised;
use crate::shapes::{Paths, dressed};
use crate::threads::on_threads;
use geograd::kernels::dynamic::Rows;
use geograd::kernels::reduce::{Best, Found};
use numpy::{PyArray1, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

pub type Object<'py> = Bound<'py, PyAny>;

/// A call: the callable, its name in messages, and its arguments.
pub struct Call<'a, 'py> {
    pub py: Python<'py>,
    pub of: &'a Callable,
    pub name: &'a str,
    pub arguments: &'a [Object<'py>],
    pub out: Option<&'a Object<'py>>,
    pub machine: Machine,
}

/// Runs a call in the format of its arguments.
macro_rules! in_format {
    ($call:expr, $given:expr, $run:ident $(, $more:expr)*) => {
        match is_double($call.py, &$given) {
            true if $call.machine.is_gpu() => Err(PyTypeError::new_err(
                "backend=\"gpu\" computes in float32: pass arrays of float32",
            )),
            true => $call.$run::<f64>($given $(, $more)*),
            false => $call.$run::<f32>($given $(, $more)*),
        }
    };
}

pub(crate) use in_format;

/// Lists the entries of `out` in the order of results.
fn flattened<'py>(out: &Object<'py>, into: &mut Vec<Option<Object<'py>>>) -> PyResult<()> {
    if out.cast::<PyTuple>().is_ok() || out.cast::<PyList>().is_ok() {
        for part in out.try_iter()? {
            flattened(&part?, into)?;
        }
    } else {
        into.push((!out.is_none()).then(|| out.clone()));
    }
    Ok(())
}

impl<'py> Call<'_, 'py> {
    /// Reads the arguments of columns.
    fn given(&self, columns: &[Column]) -> PyResult<Vec<CallArgument<'py>>> {
        if self.arguments.len() != columns.len() {
            let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            return Err(PyTypeError::new_err(format!(
                "{} takes {} ({} arguments), not {}",
                self.name,
                names.join(", "),
                columns.len(),
                self.arguments.len()
            )));
        }
        self.arguments
            .iter()
            .zip(columns)
            .map(|(x, column)| CallArgument::new(x, column))
            .collect()
    }
    fn lent<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        columns: &[Column],
    ) -> PyResult<Vec<ArgumentNumbers<'py, T>>> {
        given
            .into_iter()
            .zip(columns)
            .map(|(x, column)| ArgumentNumbers::new(self.py, x, column))
            .collect()
    }
    pub fn run<R: Send>(
        &self,
        items: usize,
        run: impl FnOnce() -> Result<R, geograd::Error> + Send,
    ) -> PyResult<R> {
        let done = match self.machine.is_gpu() {
            true => self.py.detach(run),
            false => on_threads(self.py, items, run)?,
        };
        done.map_err(raised)
    }

    /// Computes item by item.
    pub fn item_by_item(&self, form: Form) -> PyResult<Object<'py>> {
        let signature = self.of.signature(form)?;
        if form == Form::ValueGrad {
            self.one_number()?;
        }
        let given = self.given(&signature.takes)?;
        in_format!(self, given, items, form)
    }
    fn items<T: Number>(&self, given: Vec<CallArgument<'py>>, form: Form) -> PyResult<Object<'py>> {
        let takes = &self.of.signature(form)?.takes;
        let function = self.of.function::<T>(form)?;
        let lent = self.lent::<T>(given, takes)?;
        let (lead, count) = broadcast(&lent, takes)?;
        let lent = aligned(self.py, lent, takes, &lead, count)?;
        let slices = lent.iter().map(ArgumentNumbers::slices);
        let slices = slices.collect::<PyResult<Vec<_>>>()?;
        let rows = lent.iter().zip(&slices);
        let rows: Vec<_> = rows.map(|(x, slices)| x.rows(slices, true)).collect();
        let (machine, is_new) = (&self.machine, self.out.is_none());
        self.filled::<T>(form, &lead, count, |slices| {
            let function = machine.of(function)?;
            match is_new {
                true => function.aligned_into_new(&rows, slices),
                false => function.aligned_into(&rows, slices),
            }
        })
    }
    /// Computes the results of `count` items into targets.
    fn filled<T: Number>(
        &self,
        form: Form,
        lead: &[usize],
        count: usize,
        run: impl FnOnce(&mut [Option<&mut [T]>]) -> Result<(), geograd::Error> + Send,
    ) -> PyResult<Object<'py>> {
        let gives = &self.of.signature(form)?.gives;
        let targets = self.targets::<T>(lead, gives)?;
        let mut guards = Vec::with_capacity(targets.len());
        for (target, column) in targets.iter().zip(gives) {
            guards.push(
                target
                    .as_ref()
                    .map(|target| target.lock(&column.name))
                    .transpose()?,
            );
        }
        let mut slices = Vec::with_capacity(guards.len());
        for guard in &mut guards {
            slices.push(guard.as_mut().map(written).transpose()?);
        }
        self.run(count, || run(&mut slices))?;
        drop(slices);
        drop(guards);
        let mut results = Vec::with_capacity(gives.len());
        for (k, (target, column)) in targets.into_iter().zip(gives).enumerate() {
            let is_value = matches!(form, Form::Value | Form::ValueGrad | Form::Jvp)
                && k < self.of.gives().len();
            let kind = if is_value { column.kind } else { NUMBERS };
            results.push(match target {
                None => self.py.None().into_bound(self.py),
                Some(target) => {
                    target.done(|array| match lead.is_empty() && column.axes.is_empty() {
                        true => array.get_item(PyTuple::empty(self.py)),
                        false => dressed(array, kind),
                    })?
                }
            });
        }
        self.arranged(form, results)
    }
    /// Returns new arrays for results, or the caller's.
    fn targets<T: Number>(
        &self,
        lead: &[usize],
        gives: &[Column],
    ) -> PyResult<Vec<Option<Target<'py, T>>>> {
        let Some(out) = self.out else {
            let new = |column: &Column| Target::new(self.py, &with_fields(lead, column)).map(Some);
            return gives.iter().map(new).collect();
        };
        let mut all = Vec::with_capacity(gives.len());
        flattened(out, &mut all)?;
        if all.len() != gives.len() {
            let names: Vec<&str> = gives.iter().map(|column| column.name.as_str()).collect();
            return Err(PyValueError::new_err(format!(
                "out: {} arrays where {} are needed ({}; None for what is not wanted)",
                all.len(),
                gives.len(),
                names.join(", ")
            )));
        }
        let given = all.iter().zip(gives).map(|(out, column)| match out {
            None => Ok(None),
            Some(out) => Target::given(out, &with_fields(lead, column), &column.name).map(Some),
        });
        given.collect()
    }
    /// Returns results in the structure that the caller expects.
    pub fn arranged(&self, form: Form, mut results: Vec<Object<'py>>) -> PyResult<Object<'py>> {
        let (py, values) = (self.py, self.of.gives().len());
        let tuple = |list: Vec<Object<'py>>| PyTuple::new(py, list).map(Bound::into_any);
        let value = |mut list: Vec<Object<'py>>| match (self.of.is_tuple(), list.pop()) {
            (false, Some(one)) if list.is_empty() => Ok(one),
            (_, last) => tuple(list.into_iter().chain(last).collect()),
        };
        let derivatives = |mut list: Vec<Object<'py>>| match (self.of.takes.len(), list.pop()) {
            (1, Some(one)) => Ok(one),
            (_, last) => tuple(list.into_iter().chain(last).collect()),
        };
        match form {
            Form::Value => value(results),
            Form::ValueGrad => {
                let gradient = derivatives(results.split_off(values))?;
                tuple(vec![value(results)?, gradient])
            }
            Form::Jvp => {
                let along = value(results.split_off(values))?;
                tuple(vec![value(results)?, along])
            }
            Form::Vjp | Form::Hvp => derivatives(results),
            Form::Jacobian | Form::Hessian => Ok(results.remove(0)),
        }
    }

    /// Reads both lists of a call of all pairs.
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
    /// Returns the axes of the batches, and both lists with all of these axes.
    fn batched<T: Number>(
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
    /// Returns the lists of every batch, and the numbers of rows of both.
    fn each<'a, T: Number>(
        &self,
        batches: &[usize],
        lists: &[ArgumentNumbers<'py, T>; 2],
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
    fn one_number(&self) -> PyResult<()> {
        self.of.signature(Form::Value)?;
        match self.of.outputs() {
            1 => Ok(()),
            found => Err(raised(geograd::Error::NotOneNumber { found })),
        }
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

    /// Computes every row of `a` with every row of `b`.
    pub fn all_pairs(&self) -> PyResult<Object<'py>> {
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
            // The axis of a result's numbers is the last one, as in other forms.
            Some(_) => self
                .py
                .import("numpy")?
                .call_method1("moveaxis", (array, -3, -1)),
        })
    }

    /// Returns the largest result of every row or of every column, and its index.
    pub fn most(&self, of_rows: bool) -> PyResult<Object<'py>> {
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

    /// Returns every pair above a threshold: rows, columns, values.
    pub fn above(&self, threshold: f64) -> PyResult<Object<'py>> {
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

    /// Returns the number of pairs above a threshold.
    pub fn count_above(&self, threshold: f64) -> PyResult<u64> {
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

    /// Returns the sum of all results, or their mean.
    pub fn total(&self, is_mean: bool) -> PyResult<f64> {
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

    /// Returns the sum of all results, or their mean, with its gradient by both lists.
    pub fn total_grad(&self, is_mean: bool) -> PyResult<Object<'py>> {
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

    /// Returns the gradients of the sum of all results, each weighted by an entry of the matrix `upstream`.
    pub fn all_pairs_vjp(&self, upstream: &Object<'py>) -> PyResult<Object<'py>> {
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
    fn shapes_of(&self, given: &[CallArgument<'py>]) -> Vec<Vec<usize>> {
        let shape = |given: &CallArgument<'py>| match given {
            CallArgument::Array(array) => array.shape().to_vec(),
            CallArgument::Columns(columns) => {
                let count = columns.first().map_or(0, |own| own.bind(self.py).len());
                vec![count, columns.len()]
            }
            CallArgument::Number(_) => Vec::new(),
        };
        given.iter().map(shape).collect()
    }
    fn shaped<T: Number>(&self, numbers: Vec<T>, shape: &[usize]) -> PyResult<Object<'py>> {
        PyArray1::from_vec(self.py, numbers)
            .as_any()
            .call_method1("reshape", (PyTuple::new(self.py, shape)?,))
    }

    /// Computes a row of paths: the value, its gradient, or its adjoint.
    pub fn paths(&self, form: Form) -> PyResult<Object<'py>> {
        let takes = &self.of.takes;
        let wanted = takes.len() + 1 + usize::from(form == Form::Vjp);
        if self.arguments.len() != wanted {
            let mut names: Vec<&str> = takes.iter().map(|column| column.name.as_str()).collect();
            names.push("paths");
            names.extend((form == Form::Vjp).then_some("upstream"));
            return Err(PyTypeError::new_err(format!(
                "{} takes {}",
                self.name,
                names.join(", ")
            )));
        }
        if !matches!(form, Form::Value | Form::ValueGrad | Form::Vjp) {
            return Err(PyTypeError::new_err(format!(
                "{} is of paths: it has value_grad and vjp",
                self.name
            )));
        }
        let (contexts, rest) = self.arguments.split_at(takes.len());
        let Ok(paths) = rest[0].cast::<Paths>() else {
            return Err(PyTypeError::new_err(format!(
                "{}: geograd.Paths is needed for paths",
                self.name
            )));
        };
        let mut given = contexts
            .iter()
            .zip(takes)
            .map(|(x, column)| CallArgument::new(x, column))
            .collect::<PyResult<Vec<_>>>()?;
        given.push(CallArgument::Array(
            paths.get().vertices.bind(self.py).clone(),
        ));
        if let Some(upstream) = rest.get(1) {
            given.push(CallArgument::new(upstream, &self.upstream())?);
        }
        let array = paths.get().offsets.bind(self.py);
        let offsets = offsets(self.py, array.as_any(), "offsets")?;
        in_format!(self, given, on_paths, form, offsets)
    }
    fn upstream(&self) -> Column {
        let axes = self
            .of
            .gives()
            .first()
            .map(|column| column.axes.clone())
            .unwrap_or_default();
        Column {
            name: "upstream".to_owned(),
            kind: NUMBERS,
            axes,
        }
    }
    fn on_paths<T: Number>(
        &self,
        mut given: Vec<CallArgument<'py>>,
        form: Form,
        offsets: Vec<usize>,
    ) -> PyResult<Object<'py>> {
        let function = self.of.on_paths::<T>()?;
        let takes = &self.of.takes;
        let paths = offsets.len().saturating_sub(1);
        let rest = given.split_off(takes.len());
        let mut rest = rest.into_iter();
        let column = Column {
            name: "vertices".to_owned(),
            kind: NUMBERS,
            axes: vec![function.vertex()],
        };
        let vertices = rest
            .next()
            .ok_or_else(|| PyTypeError::new_err("paths are needed"))?;
        let vertices = ArgumentNumbers::<T>::new(self.py, vertices, &column)?;
        let lent = given.into_iter().zip(takes);
        let lent = lent
            .map(|(given, column)| ArgumentNumbers::<T>::new(self.py, given, column))
            .collect::<PyResult<Vec<_>>>()?;
        // One path stands for all rows, and one row for all paths.
        let many = lent
            .iter()
            .map(ArgumentNumbers::count)
            .find(|&rows| rows != 1);
        let count = match (paths, many) {
            (1, Some(rows)) if !self.machine.is_gpu() => rows,
            _ => paths,
        };
        let upstream = match rest.next() {
            None => None,
            Some(upstream) => {
                let column = self.upstream();
                let lent = ArgumentNumbers::<T>::new(self.py, upstream, &column)?;
                Some(self.full(lent, &column, count)?)
            }
        };
        let mut contexts = Vec::new();
        for (lent, column) in lent.into_iter().zip(takes) {
            contexts.push(self.full::<T>(lent, column, count)?);
        }
        let slices = contexts.iter().map(ArgumentNumbers::slices);
        let slices = slices.collect::<PyResult<Vec<_>>>()?;
        let rows = contexts.iter().zip(&slices);
        let rows: Vec<_> = rows.map(|(x, slices)| x.rows(slices, false)).collect();
        let (numbers, machine) = (vertices.numbers()?, &self.machine);
        let items = numbers.len();
        let gives = self.of.gives();
        let shape = gives
            .first()
            .map(|column| with_fields(&[count], column))
            .unwrap_or_default();
        let kind = gives.first().map_or(NUMBERS, |column| column.kind);
        let value =
            |of: Vec<T>| -> PyResult<Object<'py>> { dressed(self.shaped(of, &shape)?, kind) };
        let derivatives =
            |(columns, vertices): (Vec<Vec<T>>, Vec<T>)| -> PyResult<Vec<Object<'py>>> {
                let mut all = Vec::new();
                for (numbers, column) in columns.into_iter().zip(takes) {
                    all.push(self.shaped(numbers, &with_fields(&[count], column))?);
                }
                let n = function.vertex();
                let size = vertices.len() / n;
                all.push(self.shaped(vertices, &[size, n])?);
                Ok(all)
            };
        let grouped = |mut all: Vec<Object<'py>>| match all.len() {
            1 => Ok(all.remove(0)),
            _ => PyTuple::new(self.py, all).map(Bound::into_any),
        };
        match form {
            Form::Value => {
                let found = self.run(items, || {
                    machine.of_paths(function)?.values(&rows, numbers, &offsets)
                })?;
                match self.out {
                    None => value(found),
                    Some(out) => {
                        let target = Target::<T>::given(out, &shape, "result")?;
                        let mut guard = target.lock("result")?;
                        written(&mut guard)?.copy_from_slice(&found);
                        drop(guard);
                        target.done(Ok)
                    }
                }
            }
            _ if self.out.is_some() => Err(PyTypeError::new_err("out is for values of paths only")),
            Form::ValueGrad => {
                if function.gives() != 1 {
                    return Err(raised(geograd::Error::NotOneNumber {
                        found: function.gives(),
                    }));
                }
                let ones = vec![T::narrowed(1.0); count];
                let (values, bars) = self.run(items, || {
                    let values = machine
                        .of_paths(function)?
                        .values(&rows, numbers, &offsets)?;
                    let bars = machine
                        .of_paths(function)?
                        .vjp(&rows, numbers, &offsets, &ones)?;
                    Ok((values, bars))
                })?;
                Ok((value(values)?, grouped(derivatives(bars)?)?)
                    .into_pyobject(self.py)?
                    .into_any())
            }
            _ => {
                let upstream = upstream
                    .as_ref()
                    .ok_or_else(|| PyTypeError::new_err("upstream is needed"))?;
                let upstream = upstream.numbers()?;
                let bars = self.run(items, || {
                    machine
                        .of_paths(function)?
                        .vjp(&rows, numbers, &offsets, upstream)
                })?;
                grouped(derivatives(bars)?)
            }
        }
    }
    /// Repeats an argument to a row for every path.
    fn full<T: Number>(
        &self,
        lent: ArgumentNumbers<'py, T>,
        column: &Column,
        count: usize,
    ) -> PyResult<ArgumentNumbers<'py, T>> {
        if lent.lead() == [count] {
            return Ok(lent);
        }
        if lent.count() != 1 {
            return Err(PyValueError::new_err(format!(
                "`{}` has {} rows where {count} are needed, one for each path",
                column.name,
                lent.count()
            )));
        }
        lent.repeated(self.py, &[count], column)
    }
}
