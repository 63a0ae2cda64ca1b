//! Functions of `f32` on columns that stay on a machine.
use super::forms::Function;
use super::rows::Rows;
use crate::error::Error;
use crate::kernels::machine::Column;
use crate::kernels::machine::{Engine, Items, Machine, Numbers, Room, Seed};
use crate::kernels::machine::{HeldNumbers, Matrix};

/// Returns the first column.
fn list(held: &HeldNumbers) -> Column<'_, f32> {
    let first = held.columns().next();
    first.unwrap_or_else(|| Column::lent(&[], 1, Some(0)))
}

/// Untyped functions on columns that stay on the machine.
impl Machine<dyn Engine<f32>> {
    /// Uploads columns of arguments of a function, all of one length. The call that takes them checks them.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    #[doc(hidden)]
    pub fn upload_rows(&self, columns: &[Rows<'_, f32>]) -> Result<HeldNumbers, Error> {
        let count = columns.first().and_then(Rows::count).unwrap_or(0);
        let numbers = columns
            .iter()
            .map(|rows| Numbers::new(rows.fields(), rows.numbers().into_owned()));
        self.engine.keep(count, numbers.collect())
    }

    /// Computes item i of every column, as [`aligned`](Machine::aligned), into `into` if given.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Machine::aligned).
    #[doc(hidden)]
    pub fn aligned_rows(
        &self,
        run: &Function<f32>,
        columns: &HeldNumbers,
        into: Option<HeldNumbers>,
    ) -> Result<HeldNumbers, Error> {
        let columns: Vec<_> = columns.columns().collect();
        let mut stored = into.unwrap_or_default();
        self.engine
            .map(&run.call()?, &columns, Items::Held(&mut stored))?;
        Ok(stored)
    }

    /// Computes every row of one column with every row of another, for results of one number, as
    /// [`all_pairs`](Machine::all_pairs), into `into` if given.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Machine::all_pairs), and [`Error::Length`] for a matrix of another size.
    #[doc(hidden)]
    pub fn all_pairs_rows(
        &self,
        run: &Function<f32>,
        a: &HeldNumbers,
        b: &HeldNumbers,
        into: Option<Matrix>,
    ) -> Result<Matrix, Error> {
        let mut matrix = match into {
            Some(matrix) => matrix,
            None => self.engine.room(a.len(), b.len())?,
        };
        self.engine
            .pairs(&run.call()?, &[list(a), list(b)], Room::Held(&mut matrix))?;
        Ok(matrix)
    }

    /// Returns the adjoint of all pairs, as [`all_pairs_vjp`](Machine::all_pairs_vjp).
    ///
    /// # Errors
    ///
    /// As [`all_pairs_vjp`](Machine::all_pairs_vjp).
    #[doc(hidden)]
    pub fn all_pairs_vjp_rows(
        &self,
        run: &Function<f32>,
        a: &HeldNumbers,
        b: &HeldNumbers,
        upstream: &Matrix,
    ) -> Result<[HeldNumbers; 2], Error> {
        let lists = [list(a), list(b)];
        let room = |list: &Column<'_, f32>| vec![0.0; list.len() * list.fields];
        let [mut by_a, mut by_b] = lists.each_ref().map(room);
        let seed = Seed::Matrix(upstream);
        self.engine
            .pull_back(&run.call()?, &lists, &seed, [&mut by_a, &mut by_b])?;
        let kept = |list: &Column<'_, f32>, rows| {
            let fields = list.fields;
            self.engine
                .keep(list.len(), vec![Numbers::new(fields, rows)])
        };
        Ok([kept(&lists[0], by_a)?, kept(&lists[1], by_b)?])
    }
}
