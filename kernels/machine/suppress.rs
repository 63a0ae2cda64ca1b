//! The rules of suppression, and the order of shapes in it.
use crate::error::Argument;
use crate::kernels::machine::Column;
use crate::kernels::machine::found::{Found, check_threshold};
use crate::suppression::{Pair, Rules, check_rules};
use crate::{Error, Real};

impl<T> From<Found<T>> for Pair<T> {
    /// Copies the pair.
    fn from(found: Found<T>) -> Self {
        Pair {
            first: found.row,
            second: found.column,
            overlap: found.value,
        }
    }
}

/// Checks the arguments of suppression, except the shapes.
pub(crate) fn checked<S: Real>(
    count: usize,
    scores: &[S],
    rules: &Rules<'_, S>,
) -> Result<(), Error> {
    if scores.len() != count {
        return Err(Error::Length {
            argument: Argument::Named("scores"),
            expected: count,
            found: scores.len(),
        });
    }
    check_rules(count, rules)?;
    check_threshold(rules.overlap)
}

/// The rules of suppression.
#[derive(Clone, Copy, Debug)]
pub struct Greed<'a, T> {
    /// Results above this one suppress.
    pub threshold: T,
    /// The class of every shape, if there are several.
    pub classes: Option<&'a [u32]>,
    /// The largest number of kept shapes.
    pub most: usize,
}

/// The shapes to suppress, best first.
pub(crate) struct RankedShapes<T> {
    /// Their indices in the caller's list.
    pub order: Vec<usize>,
    /// Their numbers, shape after shape.
    numbers: Vec<T>,
    fields: usize,
    /// Their classes, if there are several.
    classes: Option<Vec<u32>>,
}

impl<T: Real> RankedShapes<T> {
    /// Reads shapes in the order of their indices.
    pub fn of(order: Vec<usize>, shapes: &Column<'_, T>, rules: &Rules<'_, T>) -> Self {
        let (all, fields) = (shapes.all(), shapes.fields);
        let own = |&i: &usize| &all[i * fields..(i + 1) * fields];
        RankedShapes {
            numbers: order.iter().flat_map(own).copied().collect(),
            fields,
            classes: rules
                .classes
                .map(|all| order.iter().map(|&i| all[i]).collect()),
            order,
        }
    }
    /// Returns the shapes as both lists of all pairs.
    pub fn lists(&self) -> [Column<'_, T>; 2] {
        [(); 2].map(|()| Column::lent(&self.numbers, self.fields, Some(self.order.len())))
    }
    /// Returns the rules of suppression, with the classes of the ranked shapes.
    pub fn greed(&self, rules: &Rules<'_, T>) -> Greed<'_, T> {
        Greed {
            threshold: rules.overlap,
            classes: self.classes.as_deref(),
            most: rules.most,
        }
    }
}
