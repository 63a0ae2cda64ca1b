//! The engine of a GPU, behind the calls of [`Machine`](crate::kernels::machine::Machine).
use super::context::Device;
use super::generated::held::HeldColumn;
use super::lists::DeviceLists;
use super::matrix::DeviceMatrix;
use super::reduce::DeviceBests;
use super::seed::PairSeed;
use crate::error::{Argument, Error};
use crate::kernels::call::folding::Folding;
use crate::kernels::call::recording::Call;
use crate::kernels::cpu::checked::check;
use crate::kernels::cpu::checked::check_numbers;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::plan::plan;
use crate::kernels::machine::Column;
use crate::kernels::machine::GroupSpans;
use crate::kernels::machine::{
    self, Engine, GroupedReduction, Items, Numbers, On, Reduced, Reduction, Room, Sealed,
};
use crate::kernels::machine::{Input, VertexBars};
use crate::kernels::machine::{MachineColumn, Stored};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::Leaf;
use crate::kernels::row::item::counts::expect;
use crate::suppression::Rules;

/// Returns columns on the device as one handle.
fn stored(count: usize, columns: impl IntoIterator<Item = HeldColumn>) -> Stored<f32> {
    let columns = columns.into_iter();
    Stored::new(
        count,
        columns
            .map(|own| Box::new(own) as Box<dyn MachineColumn<f32>>)
            .collect(),
    )
}

impl Sealed for Device {}

impl On<Device> for f32 {
    fn engine(engine: &Device) -> &dyn Engine<f32> {
        engine
    }
}

impl Engine<f32> for Device {
    fn check(&self, argument: Argument, leaf: Leaf<f32>, numbers: &[f32]) -> Result<(), Error> {
        check_numbers(argument, leaf, numbers)
    }

    fn keep(&self, count: usize, columns: Vec<Numbers<f32>>) -> Result<Stored<f32>, Error> {
        let own = |own: Numbers<f32>| HeldColumn::new(self, own.fields, own.rows);
        let columns = columns
            .into_iter()
            .map(own)
            .collect::<Result<Vec<_>, _>>()?;
        Ok(stored(count, columns))
    }

    fn fold(
        &self,
        folding: &Folding<f32>,
        input: &Input<'_, f32>,
        out: &mut [f32],
    ) -> Result<(), Error> {
        self.folded(folding, input, out)
    }

    fn fold_back(
        &self,
        folding: &Folding<f32>,
        input: &Input<'_, f32>,
        upstream: &[f32],
        by_context: &mut [f32],
        by_vertex: VertexBars<'_, f32>,
    ) -> Result<(), Error> {
        self.folded_back(folding, input, upstream, by_context, by_vertex)
    }

    fn room(&self, rows: usize, columns: usize) -> Result<machine::Matrix, Error> {
        let made = self
            .inner
            .guarded(|| DeviceMatrix::room(self, rows, columns))?;
        Ok(machine::Matrix(Box::new(made)))
    }

    fn map(
        &self,
        call: &Call<f32>,
        columns: &[Column<'_, f32>],
        results: Items<'_, f32>,
    ) -> Result<bool, Error> {
        match results {
            Items::Targets(targets, _) => {
                self.aligned(call, columns, targets)?;
            }
            Items::Held(over) => {
                let made = call.generated(false)?;
                let count = machine::count_of(call, columns)?;
                *over = stored(count, self.held_aligned(&made, columns, &over.own()?)?);
            }
        }
        Ok(true)
    }

    fn pairs(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        results: Room<'_, f32>,
    ) -> Result<(), Error> {
        match results {
            Room::Planes(planes) => self.planes(call, lists, planes),
            Room::Held(matrix) => {
                DeviceLists::new(self, call, lists)?.matrix_into(matrix.own_mut()?)
            }
        }
    }

    fn reduce(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        reduction: Reduction<f32>,
    ) -> Result<Reduced<f32>, Error> {
        DeviceLists::new(self, call, lists)?.reduce(reduction)
    }

    fn reduce_grouped(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        groups: GroupSpans<'_>,
        reduction: GroupedReduction<f32>,
    ) -> Result<Reduced<f32>, Error> {
        DeviceLists::new(self, call, lists)?.reduce_grouped(groups, reduction)
    }

    fn least(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        groups: GroupSpans<'_>,
        wanted: machine::Least<f32>,
        _ties: bool,
    ) -> Result<machine::LeastPairs<f32>, Error> {
        machine::least::by_negation(self, call, lists, groups, wanted)
    }

    fn pull_back(
        &self,
        call: &Call<f32>,
        lists: &[Column<'_, f32>; 2],
        seed: &machine::Seed<'_, f32>,
        bars: [&mut [f32]; 2],
    ) -> Result<f64, Error> {
        let seed = match seed {
            machine::Seed::Numbers(numbers) => {
                check_upstream(numbers, 1)?;
                PairSeed::Numbers(numbers)
            }
            machine::Seed::Matrix(matrix) => PairSeed::Matrix(matrix.own()?),
            machine::Seed::Factor(factor) => {
                check_upstream(&[*factor], 1)?;
                PairSeed::Factor(*factor)
            }
        };
        let adjoint = call.clone().derived(Mode::Vjp)?;
        let (found, sum) = DeviceLists::new(self, &adjoint, lists)?.derivatives(&seed)?;
        let sum = match (seed, sum) {
            (PairSeed::Factor(_), Some(sum)) => sum,
            (PairSeed::Factor(_), None) => self.reduce(call, lists, Reduction::Sum)?.sum(),
            _ => 0.0,
        };
        for (bar, found) in bars.into_iter().zip(found) {
            bar.copy_from_slice(&found);
        }
        Ok(sum)
    }

    fn suppress(
        &self,
        call: &Call<f32>,
        shapes: &Column<'_, f32>,
        groups: Option<&[usize]>,
        scores: &[f32],
        rules: Rules<'_, f32>,
    ) -> Result<Vec<usize>, Error> {
        let own = super::generated::held::held(self, shapes)?;
        let rows = own.map(|own| own.numbers()).transpose()?;
        let here = rows
            .as_ref()
            .map(|rows| Column::lent(rows, shapes.fields, shapes.count));
        let shapes = here.as_ref().unwrap_or(shapes);
        let Some(offsets) = groups else {
            return self.kept(call, shapes, scores, rules);
        };
        // The loop computes group after group. All shapes are checked first, so that errors name the caller's rows.
        check(Argument::A, &plan(call, true)?.arguments[0], shapes)?;
        let (all, mut kept) = (shapes.all(), Vec::new());
        for ends in offsets.windows(2) {
            let group = ends[0]..ends[1];
            let numbers = &all[group.start * shapes.fields..group.end * shapes.fields];
            let list = Column::lent(numbers, shapes.fields, Some(group.len()));
            let rules = Rules {
                classes: rules.classes.map(|classes| &classes[group.clone()]),
                ..rules
            };
            let found = self.kept(call, &list, &scores[group.clone()], rules)?;
            kept.extend(found.into_iter().map(|place| place + group.start));
        }
        Ok(kept)
    }

    fn pick(&self, list: &Stored<f32>, bests: &machine::Bests<f32>) -> Result<Stored<f32>, Error> {
        let found: &DeviceBests = bests.own()?;
        found.is_of(self)?;
        let own = list.own::<HeldColumn>()?;
        for column in &own {
            column.is_of(self)?;
        }
        expect(Argument::Shape, bests.among, list.len())?;
        let found = bests.download()?;
        let picked = own.into_iter().map(|own| own.picked(&found));
        Ok(stored(found.len(), picked.collect::<Result<Vec<_>, _>>()?))
    }
}
