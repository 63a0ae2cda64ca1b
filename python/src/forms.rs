//! The forms of a call, for rows of the table and traced functions alike.
use crate::arrays::{
    ArgumentNumbers, CallArgument, Target, aligned, broadcast, with_fields, written,
};
use crate::call::Callable;
use crate::column::{Column, NUMBERS};
use crate::machine::Machine;
use crate::number::{Form, Number};
use crate::raised;
use crate::shapes::dressed;
use crate::threads::on_threads;
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

pub type Object<'py> = Bound<'py, PyAny>;

/// A call: what of, its name in messages, and its arguments.
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
        match $crate::arrays::is_double($call.py, &$given) {
            true if $call.machine.is_gpu() => Err(pyo3::exceptions::PyTypeError::new_err(
                "backend=\"gpu\" computes in float32: pass arrays of float32",
            )),
            true => $call.$run::<f64>($given $(, $more)*),
            false => $call.$run::<f32>($given $(, $more)*),
        }
    };
}

pub(crate) use in_format;

/// Results of a list by their places: what `out` has there.
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
    /// The arguments of columns.
    pub fn given(&self, columns: &[Column]) -> PyResult<Vec<CallArgument<'py>>> {
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
    pub fn lent<T: Number>(
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

    /// Item by item.
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
    /// Results that a call writes, of so many items.
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
    /// New arrays for results, or the caller's.
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
    /// Results in the form that a caller takes apart.
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
    /// Fails unless the function gives one number.
    pub fn one_number(&self) -> PyResult<()> {
        self.of.signature(Form::Value)?;
        match self.of.outputs() {
            1 => Ok(()),
            found => Err(raised(geograd::Error::NotOneNumber { found })),
        }
    }
    /// Numbers as an array.
    pub fn shaped<T: Number>(&self, numbers: Vec<T>, shape: &[usize]) -> PyResult<Object<'py>> {
        PyArray1::from_vec(self.py, numbers)
            .as_any()
            .call_method1("reshape", (PyTuple::new(self.py, shape)?,))
    }
}
