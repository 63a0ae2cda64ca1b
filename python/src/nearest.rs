//! The nearest of many: the least results of all pairs, or of those within groups.
use crate::arrays::CallArgument;
use crate::forms::{Call, Object, in_format};
use crate::grouped::both;
use crate::number::{Form, Number};
use crate::pairs::Pairs;
use geograd::kernels::Groups;
use geograd::kernels::dynamic::Function;
use geograd::kernels::machine::{Found, Least};
use geograd::kernels::op::LowerBound;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::borrow::Cow;

/// The arguments of a search besides both lists.
struct Search {
    form: Pairs,
    /// The cap or limit; infinity for none.
    cap: f64,
    lower: Option<LowerBound>,
    groups: Option<[Vec<usize>; 2]>,
}

impl Search {
    /// Returns the search in a format.
    fn wanted<T: Number>(&self) -> Least<T> {
        let cap = T::narrowed(self.cap);
        match self.form {
            Pairs::RowMin | Pairs::RowMinGrad => Least::Rows(cap),
            Pairs::ColumnMin | Pairs::ColumnMinGrad => Least::Columns(cap),
            Pairs::Below | Pairs::CountBelow => Least::Below(cap),
            _ => Least::Groups(cap),
        }
    }
    /// Returns the groups.
    fn groups(&self) -> Option<Groups<'_>> {
        let [a, b] = self.groups.as_ref()?;
        Some(Groups::new(a, b))
    }
    /// Returns the function with the given lower bound.
    fn bounded<'f, T: Number>(&self, of: Cow<'f, Function<T>>) -> Cow<'f, Function<T>> {
        match self.lower {
            Some(lower) => Cow::Owned(of.at_least(lower)),
            None => of,
        }
    }
}

/// Returns the lower bound of a name.
fn bound(name: &str) -> PyResult<LowerBound> {
    match name {
        "distance" => Ok(LowerBound::Distance),
        "squared_distance" => Ok(LowerBound::SquaredDistance),
        _ => Err(PyValueError::new_err(format!(
            "lower: \"distance\", \"squared_distance\" or None is needed, not \"{name}\""
        ))),
    }
}

impl<'py> Call<'_, 'py> {
    /// Runs a form for the nearest of many. `more` has the cap or limit, or none, and the name of a lower bound, or
    /// none.
    pub fn nearest(
        &self,
        form: Pairs,
        more: &Object<'py>,
        groups: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (cap, lower): (Option<f64>, Option<String>) = more.extract()?;
        let search = Search {
            form,
            cap: cap.unwrap_or(f64::INFINITY),
            lower: lower.as_deref().map(bound).transpose()?,
            groups: groups.map(|groups| both(self.py, groups)).transpose()?,
        };
        let given = self.two()?;
        match form {
            Pairs::RowMinGrad | Pairs::ColumnMinGrad | Pairs::NearestGrad => {
                in_format!(self, given, nearest_grad, &search)
            }
            Pairs::RowMin | Pairs::ColumnMin | Pairs::Nearest if search.groups.is_none() => {
                in_format!(self, given, nearest_of_batches, &search)
            }
            _ => in_format!(self, given, nearest_pairs, &search),
        }
    }
    /// Results and indices of least pairs, in an array of some axes: of rows, of columns, or both indices.
    fn least<T: Number>(
        &self,
        search: &Search,
        best: &[Option<Found<T>>],
        axes: Option<&[usize]>,
    ) -> PyResult<Object<'py>> {
        let shaped = |array: &Object<'py>| match axes {
            Some([]) => array
                .call_method1("reshape", (PyTuple::empty(self.py),))?
                .get_item(()),
            Some(axes) => array.call_method1("reshape", (PyTuple::new(self.py, axes)?,)),
            None => Ok(array.clone()),
        };
        let nothing = T::narrowed(f64::INFINITY);
        let values = best
            .iter()
            .map(|best| best.map_or(nothing, |best| best.value));
        let values = PyArray1::from_iter(self.py, values);
        let places = |of: fn(&Found<T>) -> usize| {
            let all = best
                .iter()
                .map(|best| best.as_ref().map_or(-1, |best| of(best) as isize));
            shaped(PyArray1::from_iter(self.py, all).as_any())
        };
        let values = shaped(values.as_any())?;
        let found = match search.form {
            Pairs::RowMin | Pairs::RowMinGrad => {
                (values, places(|best| best.column)?).into_pyobject(self.py)
            }
            Pairs::ColumnMin | Pairs::ColumnMinGrad => {
                (values, places(|best| best.row)?).into_pyobject(self.py)
            }
            _ => {
                let (rows, columns) = (places(|best| best.row)?, places(|best| best.column)?);
                return Ok((values, rows, columns).into_pyobject(self.py)?.into_any());
            }
        };
        Ok(found?.into_any())
    }
    /// The least of rows, columns or all pairs, of every batch.
    fn nearest_of_batches<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        search: &Search,
    ) -> PyResult<Object<'py>> {
        self.one_number()?;
        let (function, machine) = (self.of.function::<T>(Form::Value)?, &self.machine);
        let (mut axes, lists) = self.batched::<T>(given)?;
        let slices = [lists[0].slices()?, lists[1].slices()?];
        let (each, [rows, columns]) = self.each(&axes, &lists, &slices);
        let items = rows.saturating_mul(columns).saturating_mul(each.len());
        let best = self.run(items, || {
            let of = search.bounded(machine.of(function)?);
            let mut best = Vec::new();
            for [a, b] in each {
                best.extend(of.least(a, b, None, search.wanted())?.best);
            }
            Ok(best)
        })?;
        match search.form {
            Pairs::RowMin => axes.push(rows),
            Pairs::ColumnMin => axes.push(columns),
            _ => {}
        }
        self.least(search, &best, Some(&axes))
    }
    /// The least within groups, or all pairs below a limit.
    fn nearest_pairs<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        search: &Search,
    ) -> PyResult<Object<'py>> {
        let (function, machine) = (self.of.function::<T>(Form::Value)?, &self.machine);
        let found = self.reduced::<T, _>(given, |[a, b]| {
            let of = search.bounded(machine.of(function)?);
            of.least(a, b, search.groups(), search.wanted())
        })?;
        match search.form {
            Pairs::CountBelow => Ok(found.pairs.len().into_pyobject(self.py)?.into_any()),
            Pairs::Below => {
                let all = &found.pairs;
                let rows = PyArray1::from_iter(self.py, all.iter().map(|pair| pair.row as isize));
                let columns =
                    PyArray1::from_iter(self.py, all.iter().map(|pair| pair.column as isize));
                let values = PyArray1::from_iter(self.py, all.iter().map(|pair| pair.value));
                Ok((rows, columns, values).into_pyobject(self.py)?.into_any())
            }
            _ => self.least(search, &found.best, None),
        }
    }
    /// The least of rows, columns, groups or all pairs, and the gradients of their sum by both lists.
    fn nearest_grad<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        search: &Search,
    ) -> PyResult<Object<'py>> {
        let (function, machine) = (self.of.function::<T>(Form::Value)?, &self.machine);
        let shapes = self.shapes_of(&given);
        let (best, a, b) = self.reduced::<T, _>(given, |[a, b]| {
            let of = search.bounded(machine.of(function)?);
            of.least_grad(a, b, search.groups(), search.wanted(), None)
        })?;
        let is_lone = search.form == Pairs::NearestGrad && search.groups.is_none();
        let found = self.least(search, &best, is_lone.then_some(&[]))?;
        let derivatives = (self.shaped(a, &shapes[0])?, self.shaped(b, &shapes[1])?);
        Ok((found, derivatives).into_pyobject(self.py)?.into_any())
    }
}
