//! The place of columns, and of a call's results.
use super::Column;
use super::primitives::try_then_check;
use super::{Engine, Items, Room, count_of};
use crate::Real;
use crate::error::Error;
use crate::kernels::call::recording::Call;
use crate::kernels::machine::found::{Best, Found};
use crate::kernels::machine::{Bests, Founds, Held, Matrix, Stored};
use crate::kernels::row::item::Results;
use crate::kernels::row::item::rows::shapes;
use crate::kernels::{Single, Table};

/// The place of columns: [`Here`], in the memory of the program, or [`There`], on the machine.
pub trait Place {
    /// The place of the results of a call with columns at both places.
    type With<P: Place>: Place;
    /// The results of a batch, one per item.
    type Many<R: Results>;
    /// The results of all pairs.
    type Table<R: Results>;
    /// The largest results of rows or columns.
    type Bests<T: Real>;
    /// The pairs above a threshold.
    type Founds<T: Real>;
    /// A gradient for every shape of a list.
    type List<P: Single>;
    #[doc(hidden)]
    fn aligned<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        columns: &[Column<'_, R::Scalar>],
    ) -> Result<Self::Many<R>, Error>;
    #[doc(hidden)]
    fn all_pairs<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        lists: &[Column<'_, R::Scalar>; 2],
    ) -> Result<Self::Table<R>, Error>;
    #[doc(hidden)]
    fn bests<T: Real>(found: Bests<T>) -> Result<Self::Bests<T>, Error>;
    #[doc(hidden)]
    fn founds<T: Real>(found: Founds<T>) -> Result<Self::Founds<T>, Error>;
    #[doc(hidden)]
    fn list<P: Single>(
        engine: &dyn Engine<P::Scalar>,
        count: usize,
        numbers: Vec<P::Scalar>,
    ) -> Result<Self::List<P>, Error>;
}

/// The memory of the program: results are vectors.
#[derive(Clone, Copy, Debug)]
pub enum Here {}

/// The machine: results stay there.
#[derive(Clone, Copy, Debug)]
pub enum There {}

impl Place for Here {
    type With<P: Place> = P;
    type Many<R: Results> = R::Many;
    type Table<R: Results> = Table<R>;
    type Bests<T: Real> = Vec<Best<T>>;
    type Founds<T: Real> = Vec<Found<T>>;
    type List<P: Single> = Vec<P>;
    fn aligned<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        columns: &[Column<'_, R::Scalar>],
    ) -> Result<R::Many, Error> {
        let mut many = R::room(count_of(call, columns)?);
        try_then_check(|new| {
            let mut targets = Vec::new();
            R::places(&mut many, &mut |target| targets.push(Some(target)));
            engine.map(call, columns, Items::Targets(targets, new))
        })?;
        Ok(many)
    }
    fn all_pairs<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        lists: &[Column<'_, R::Scalar>; 2],
    ) -> Result<Table<R>, Error> {
        let mut table = Table::new(lists[0].len(), lists[1].len())?;
        engine.pairs(call, lists, Room::Planes(table.planes_mut()))?;
        Ok(table)
    }
    fn bests<T: Real>(found: Bests<T>) -> Result<Vec<Best<T>>, Error> {
        found.taken()
    }
    fn founds<T: Real>(found: Founds<T>) -> Result<Vec<Found<T>>, Error> {
        found.taken()
    }
    fn list<P: Single>(
        _engine: &dyn Engine<P::Scalar>,
        count: usize,
        numbers: Vec<P::Scalar>,
    ) -> Result<Vec<P>, Error> {
        Ok(shapes(count, &numbers))
    }
}

impl Place for There {
    type With<P: Place> = There;
    type Many<R: Results> = Held<R>;
    type Table<R: Results> = Matrix<R::Scalar>;
    type Bests<T: Real> = Bests<T>;
    type Founds<T: Real> = Founds<T>;
    type List<P: Single> = Held<P>;
    fn aligned<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        columns: &[Column<'_, R::Scalar>],
    ) -> Result<Held<R>, Error> {
        let mut stored = Stored::default();
        engine.map(call, columns, Items::Held(&mut stored))?;
        Ok(Held::of(stored))
    }
    fn all_pairs<R: Results>(
        engine: &dyn Engine<R::Scalar>,
        call: &Call<R::Scalar>,
        lists: &[Column<'_, R::Scalar>; 2],
    ) -> Result<Matrix<R::Scalar>, Error> {
        let found = R::widths().iter().sum();
        if found != 1 {
            return Err(Error::NotOneNumber { found });
        }
        let mut matrix = engine.room(lists[0].len(), lists[1].len())?;
        engine.pairs(call, lists, Room::Held(&mut matrix))?;
        Ok(matrix)
    }
    fn bests<T: Real>(found: Bests<T>) -> Result<Bests<T>, Error> {
        Ok(found)
    }
    fn founds<T: Real>(found: Founds<T>) -> Result<Founds<T>, Error> {
        Ok(found)
    }
    fn list<P: Single>(
        engine: &dyn Engine<P::Scalar>,
        count: usize,
        rows: Vec<P::Scalar>,
    ) -> Result<Held<P>, Error> {
        let fields = crate::kernels::row::item::width::<P>();
        let numbers = super::Numbers::new(fields, rows);
        Ok(Held::of(engine.keep(count, vec![numbers])?))
    }
}
