//! Callables: a row of the table, or a traced function, with their derivatives.
use crate::column::{Column, Kind, NUMBERS};
use crate::number::{BothFormats, Form, Number};
use crate::raised;
use crate::tracing::Traced;
use geograd::kernels::dynamic::{Function, Mode, OnPaths, Operation, Program, Sort};
use pyo3::PyResult;
use pyo3::exceptions::PyTypeError;
use std::sync::OnceLock;

#[derive(Default)]
struct Cache {
    signatures: [OnceLock<Signature>; 7],
    made: BothFormats,
}

enum CallableBody {
    Row(&'static Operation),
    Traced(Traced),
}

/// A row or a traced function.
pub struct Callable {
    body: CallableBody,
    /// The arguments, without paths.
    pub takes: Vec<Column>,
    /// The results; a traced function has them after its first recording.
    gives: OnceLock<Vec<Column>>,
    cache: Cache,
}

/// The arguments and results of a form.
pub struct Signature {
    pub takes: Vec<Column>,
    pub gives: Vec<Column>,
}

impl Callable {
    pub fn of_row(operation: &'static Operation, takes: Vec<Column>, gives: Vec<Column>) -> Self {
        Callable {
            body: CallableBody::Row(operation),
            takes,
            gives: OnceLock::from(gives),
            cache: Cache::default(),
        }
    }
    pub fn of_traced(traced: Traced, takes: Vec<Column>) -> Self {
        Callable {
            body: CallableBody::Traced(traced),
            takes,
            gives: OnceLock::new(),
            cache: Cache::default(),
        }
    }
    /// Returns the row, if it is one.
    pub fn operation(&self) -> Option<&'static Operation> {
        match &self.body {
            CallableBody::Row(operation) => Some(operation),
            CallableBody::Traced(_) => None,
        }
    }
    /// Returns the function of Python that it records, if it is one.
    pub fn traced(&self) -> Option<&Traced> {
        match &self.body {
            CallableBody::Row(_) => None,
            CallableBody::Traced(traced) => Some(traced),
        }
    }
    pub fn is_of_paths(&self) -> bool {
        self.operation().is_some_and(|row| row.sort == Sort::Fold)
    }
    /// Returns `true` if its result is a tuple, even of one.
    pub fn is_tuple(&self) -> bool {
        match &self.body {
            CallableBody::Row(_) => self.gives().len() > 1,
            CallableBody::Traced(traced) => traced.is_tuple(),
        }
    }
    /// Returns the results; an empty list before the recording.
    pub fn gives(&self) -> &[Column] {
        self.gives.get().map_or(&[], |gives| gives)
    }
    /// Returns the number of scalars of a result.
    pub fn outputs(&self) -> usize {
        self.gives().iter().map(Column::fields).sum()
    }
    /// Returns the number of scalars of an input.
    pub fn inputs(&self) -> usize {
        self.takes.iter().map(Column::fields).sum()
    }

    /// Returns the columns of a form.
    pub fn signature(&self, form: Form) -> PyResult<&Signature> {
        let kept = &self.cache.signatures[form as usize];
        if let Some(signature) = kept.get() {
            return Ok(signature);
        }
        if self.gives.get().is_none() {
            self.program::<f64>(Form::Value)?;
        }
        let made = self.signed(form);
        Ok(kept.get_or_init(|| made))
    }
    fn signed(&self, form: Form) -> Signature {
        let named = |name: String, kind: Kind, like: &Column| Column {
            name,
            kind,
            axes: like.axes.clone(),
        };
        let (mut takes, mut gives) = (self.takes.clone(), self.gives().to_vec());
        let own = self.takes.iter();
        let derivatives = own
            .clone()
            .map(|x| named(format!("gradient by {}", x.name), NUMBERS, x));
        let directions = own.map(|x| named(format!("direction of {}", x.name), NUMBERS, x));
        let (inputs, outputs) = (self.inputs(), self.outputs());
        let lone = match &gives[..] {
            [one] => one.axes.is_empty(),
            _ => false,
        };
        let matrix = |name: &str, axes: Vec<usize>| Column {
            name: name.to_owned(),
            kind: NUMBERS,
            axes,
        };
        match form {
            Form::Value => {}
            Form::ValueGrad => gives.extend(derivatives),
            Form::Vjp => {
                takes.extend(
                    gives
                        .iter()
                        .map(|x| named("upstream".to_owned(), NUMBERS, x)),
                );
                gives = derivatives.collect();
            }
            Form::Jvp => {
                takes.extend(directions);
                let along: Vec<Column> = gives
                    .iter()
                    .map(|x| named("derivative".to_owned(), NUMBERS, x))
                    .collect();
                gives.extend(along);
            }
            Form::Hvp => {
                takes.extend(directions);
                gives = derivatives.collect();
            }
            Form::Jacobian => {
                let axes = if lone {
                    vec![inputs]
                } else {
                    vec![outputs, inputs]
                };
                gives = vec![matrix("jacobian", axes)];
            }
            Form::Hessian => gives = vec![matrix("hessian", vec![inputs, inputs])],
        }
        Signature { takes, gives }
    }

    /// Returns the program of a form.
    pub fn program<T: Number>(&self, form: Form) -> PyResult<&Program<T>> {
        let kept = &T::made(&self.cache.made).programs[form as usize];
        if let Some(program) = kept.get() {
            return Ok(program);
        }
        let made = match (form, &self.body) {
            (Form::Value, CallableBody::Row(operation)) => {
                operation.program::<T>().map_err(raised)?
            }
            (Form::Value, CallableBody::Traced(traced)) => {
                let (program, gives) = traced.record::<T>(&self.takes)?;
                let known = self.gives.get_or_init(|| gives.clone());
                let widths =
                    |all: &[Column]| all.iter().map(|x| x.axes.clone()).collect::<Vec<_>>();
                if widths(known) != widths(&gives) {
                    return Err(PyTypeError::new_err(
                        "the function gave other results when it was recorded for the other format",
                    ));
                }
                program
            }
            _ => form.of(self.program::<T>(Form::Value)?)?,
        };
        Ok(kept.get_or_init(|| made))
    }

    /// Returns the function of a form.
    pub fn function<T: Number>(&self, form: Form) -> PyResult<&Function<T>> {
        let kept = &T::made(&self.cache.made).functions[form as usize];
        if let Some(function) = kept.get() {
            return Ok(function);
        }
        let of_row = match &self.body {
            CallableBody::Row(operation) => {
                let mode = match form {
                    Form::Value => Some(Mode::Value),
                    Form::ValueGrad => Some(Mode::ValueGrad),
                    Form::Vjp => Some(Mode::Vjp),
                    _ => None,
                };
                mode.and_then(|mode| operation.function::<T>(mode))
            }
            CallableBody::Traced(_) => None,
        };
        let made = match of_row {
            Some(function) => function,
            None => self.program::<T>(form)?.function(),
        };
        Ok(kept.get_or_init(|| made))
    }

    /// Returns the function of paths.
    pub fn on_paths<T: Number>(&self) -> PyResult<&OnPaths<T>> {
        let kept = T::made(&self.cache.made)
            .on_paths
            .get_or_init(|| self.operation()?.on_paths::<T>());
        kept.as_ref()
            .ok_or_else(|| PyTypeError::new_err("takes no paths"))
    }
}
