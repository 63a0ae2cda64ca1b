//! Every operation of the library in every form, on any machine: shapes are drawn and brought up once, then it
//! runs as often as it is asked to.
pub mod parity;
pub mod ready;

use crate::list::{Tested, rows};
use geograd::Error;
use geograd::kernels::Backend;
use geograd::kernels::dynamic::{Mode, Sort};
use ready::{Ready, aligned, pairs, paths};

/// The forms of an operation that can be run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Results of items.
    Value,
    /// Results of items with their gradients.
    Gradient,
    /// Derivatives of items times a cotangent of the result.
    Adjoint,
    /// Results of all pairs.
    Pairs,
    /// Derivatives of all pairs times an upstream matrix, summed for every row and column.
    PairsAdjoint,
    /// Results of paths.
    Paths,
    /// Derivatives of paths times a cotangent of the result.
    PathsAdjoint,
}

impl Form {
    pub fn title(self) -> &'static str {
        match self {
            Form::Value => "aligned",
            Form::Gradient => "aligned, value and gradient",
            Form::Adjoint => "aligned, adjoint",
            Form::Pairs => "all pairs",
            Form::PairsAdjoint => "all pairs, adjoint",
            Form::Paths => "paths",
            Form::PathsAdjoint => "paths, adjoint",
        }
    }
}

/// An operation of the library.
#[derive(Clone, Copy)]
pub struct Listed {
    pub name: &'static str,
    row: &'static Tested,
}

impl Listed {
    /// The forms that it has: the gradient of one number, or of more the adjoint; pairs of two shapes with one number
    /// as result.
    pub fn forms(&self) -> Vec<Form> {
        let operation = &self.row.operation;
        if operation.sort == Sort::Fold {
            return vec![Form::Paths, Form::PathsAdjoint];
        }
        let is_number = operation.value_grad::<f32>().is_some();
        let is_straight = operation.sort == Sort::Straight;
        let derivatives = match is_number && is_straight {
            true => Form::Gradient,
            false => Form::Adjoint,
        };
        let mut forms = vec![Form::Value, derivatives];
        if is_straight && is_number && operation.layouts::<f32>().len() == 2 {
            forms.extend([Form::Pairs, Form::PairsAdjoint]);
        }
        forms
    }
    /// Gets a batch of so many items ready on a machine, and runs it once.
    pub fn make<'a>(
        &self,
        form: Form,
        backend: Backend<'a>,
        count: usize,
    ) -> Result<Box<dyn Ready + 'a>, Error> {
        let side = (count as f64).sqrt() as usize;
        match form {
            Form::Value => aligned(backend, self.row, Mode::Value, count),
            Form::Gradient => aligned(backend, self.row, Mode::ValueGrad, count),
            Form::Adjoint => aligned(backend, self.row, Mode::Vjp, count),
            Form::Pairs => pairs(backend, self.row, side, false),
            Form::PairsAdjoint => pairs(backend, self.row, side, true),
            Form::Paths => paths(backend, self.row, count, false),
            Form::PathsAdjoint => paths(backend, self.row, count, true),
        }
    }
    /// The texts of its shaders, with names.
    pub fn shaders(&self) -> Result<Vec<(String, String)>, Error> {
        self.row.shaders()
    }
}

/// The whole list.
pub fn list() -> Vec<Listed> {
    let listed = |row: &'static Tested| Listed {
        name: row.name(),
        row,
    };
    rows().into_iter().map(listed).collect()
}
