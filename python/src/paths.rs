//! The forms of rows of paths.
use crate::arrays::{ArgumentNumbers, CallArgument, Target, offsets, with_fields, written};
use crate::column::{Column, NUMBERS};
use crate::forms::{Call, Object, in_format};
use crate::number::{Form, Number};
use crate::raised;
use crate::shapes::{Paths, dressed};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

impl<'py> Call<'_, 'py> {
    /// A row of paths: the value, its gradient, or its adjoint.
    pub fn paths(&self, form: Form) -> PyResult<Object<'py>> {
        if !matches!(form, Form::Value | Form::ValueGrad | Form::Vjp) {
            return Err(PyTypeError::new_err(format!(
                "{} is of paths: it has value_grad and vjp",
                self.name
            )));
        }
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
        // One path stands for all rows, as one row does for all paths.
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
    /// A row for every path.
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
