//! Pairs within groups, and suppression.
use crate::arrays::{ArgumentNumbers, CallArgument, is_double, offsets};
use crate::column::{Column, NUMBERS};
use crate::forms::{Call, Object, in_format};
use crate::number::{Form, Number};
use geograd::kernels::Groups;
use geograd::kernels::dynamic::Rows;
use geograd::kernels::reduce::{Best, Found};
use geograd::suppression::Rules;
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Returns the offsets of both lists.
pub fn both(py: Python<'_>, groups: &Object<'_>) -> PyResult<[Vec<usize>; 2]> {
    let needed = || PyTypeError::new_err("groups: the offsets of both lists are needed");
    let pair = groups.try_iter().map_err(|_| needed())?;
    let pair = pair.take(3).collect::<PyResult<Vec<_>>>()?;
    let [a, b] = &pair[..] else {
        return Err(needed());
    };
    Ok([
        offsets(py, a, "groups of `a`")?,
        offsets(py, b, "groups of `b`")?,
    ])
}

/// The arguments of suppression besides shapes.
pub struct SuppressArguments<'a, 'py> {
    pub scores: &'a Object<'py>,
    pub overlap: f64,
    pub score: Option<f64>,
    pub most: Option<usize>,
    pub classes: Option<Vec<u32>>,
    pub offsets: Option<Vec<usize>>,
}

impl<'a, 'py> SuppressArguments<'a, 'py> {
    pub fn new(
        scores: &'a Object<'py>,
        overlap: f64,
        classes: Option<Vec<u32>>,
        score: Option<f64>,
        most: Option<usize>,
        groups: Option<&Object<'py>>,
    ) -> PyResult<Self> {
        let offsets = groups.map(|groups| offsets(groups.py(), groups, "groups"));
        Ok(SuppressArguments {
            scores,
            overlap,
            score,
            most,
            classes,
            offsets: offsets.transpose()?,
        })
    }
}

impl<'py> Call<'_, 'py> {
    /// Returns every pair of a group above a threshold: rows, columns, values.
    pub fn above_grouped(&self, threshold: f64, groups: &Object<'py>) -> PyResult<Object<'py>> {
        let (given, groups) = (self.two()?, both(self.py, groups)?);
        in_format!(self, given, found_grouped, threshold, &groups)
    }
    fn found_grouped<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        threshold: f64,
        groups: &[Vec<usize>; 2],
    ) -> PyResult<Object<'py>> {
        let (function, machine) = (self.of.function::<T>(Form::Value)?, &self.machine);
        let all: Vec<Found<T>> = self.reduced::<T, _>(given, |lists| {
            let groups = Groups::new(&groups[0], &groups[1]);
            machine
                .of(function)?
                .above_grouped(lists[0], lists[1], groups, T::narrowed(threshold))
        })?;
        let rows = PyArray1::from_iter(self.py, all.iter().map(|found| found.row as isize));
        let columns = PyArray1::from_iter(self.py, all.iter().map(|found| found.column as isize));
        let values = PyArray1::from_iter(self.py, all.iter().map(|found| found.value));
        Ok((rows, columns, values).into_pyobject(self.py)?.into_any())
    }

    /// Returns the largest result of every row or column of a group, and its index; -inf and -1 without pairs.
    pub fn most_grouped(&self, of_rows: bool, groups: &Object<'py>) -> PyResult<Object<'py>> {
        let (given, groups) = (self.two()?, both(self.py, groups)?);
        in_format!(self, given, best_grouped, of_rows, &groups)
    }
    fn best_grouped<T: Number>(
        &self,
        given: Vec<CallArgument<'py>>,
        of_rows: bool,
        groups: &[Vec<usize>; 2],
    ) -> PyResult<Object<'py>> {
        let (function, machine) = (self.of.function::<T>(Form::Value)?, &self.machine);
        let all: Vec<Option<Best<T>>> = self.reduced::<T, _>(given, |lists| {
            let groups = Groups::new(&groups[0], &groups[1]);
            match of_rows {
                true => machine
                    .of(function)?
                    .row_max_grouped(lists[0], lists[1], groups),
                false => machine
                    .of(function)?
                    .column_max_grouped(lists[0], lists[1], groups),
            }
        })?;
        let nothing = T::narrowed(f64::NEG_INFINITY);
        let values = all
            .iter()
            .map(|best| best.map_or(nothing, |best| best.value));
        let places = all
            .iter()
            .map(|best| best.map_or(-1, |best| best.index as isize));
        let values = PyArray1::from_iter(self.py, values);
        let places = PyArray1::from_iter(self.py, places);
        Ok((values, places).into_pyobject(self.py)?.into_any())
    }

    /// Returns the indices of the shapes that suppression keeps. It decides shape by shape, on the CPU alone.
    pub fn suppress(&self, asked: &SuppressArguments<'_, 'py>) -> PyResult<Object<'py>> {
        let given = self.two()?;
        match is_double(self.py, &given) {
            true => self.kept::<f64>(given, asked),
            false => self.kept::<f32>(given, asked),
        }
    }
    fn kept<T: Number>(
        &self,
        mut given: Vec<CallArgument<'py>>,
        asked: &SuppressArguments<'_, 'py>,
    ) -> PyResult<Object<'py>> {
        let function = self.of.function::<T>(Form::Value)?;
        let needed = || PyTypeError::new_err("a list of shapes is needed");
        let column = &self.of.takes[0];
        let shapes = ArgumentNumbers::<T>::new(self.py, given.pop().ok_or_else(needed)?, column)?;
        let scores = Column {
            name: "scores".to_owned(),
            kind: NUMBERS,
            axes: Vec::new(),
        };
        let scores =
            ArgumentNumbers::<T>::new(self.py, CallArgument::new(asked.scores, &scores)?, &scores)?;
        let (lead, numbers) = (shapes.lead().len(), scores.numbers()?);
        if lead != 1 || scores.lead().len() != 1 {
            return Err(PyValueError::new_err(
                "suppress takes a list of shapes, of shape (N, fields), and a list of scores, of shape (N,)",
            ));
        }
        let slices = shapes.slices()?;
        let rows: Rows<'_, T> = shapes.rows(&slices, false);
        let whole = vec![0, shapes.count()];
        let offsets = asked.offsets.as_ref().unwrap_or(&whole);
        let all = Rules::above(T::narrowed(asked.overlap));
        let rules = Rules {
            classes: asked.classes.as_deref(),
            score: asked.score.map_or(all.score, T::narrowed),
            most: asked.most.unwrap_or(usize::MAX),
            ..all
        };
        let kept = self.run(shapes.count().saturating_mul(64), || {
            function.suppress(rows, offsets, numbers, rules)
        })?;
        let kept = kept.into_iter().map(|place| place as isize);
        Ok(PyArray1::from_iter(self.py, kept).into_any())
    }
}
