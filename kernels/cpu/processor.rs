//! [`Engine`] on the CPU.
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::call::folding::Folding;
use crate::kernels::call::recording::{Body, Call};
use crate::kernels::cpu::Processor;
use crate::kernels::cpu::aligned::{checked, checks_later, compute, compute_unchecked};
use crate::kernels::cpu::checked::{
    check, check_argument, check_numbers, check_upstream, restore, tame,
};
use crate::kernels::cpu::folds;
use crate::kernels::cpu::greedy;
use crate::kernels::cpu::grouped;
use crate::kernels::cpu::least::Search;
use crate::kernels::cpu::lower_bounds::Boxes;
use crate::kernels::cpu::matrix;
use crate::kernels::cpu::pairs::{self, Pairs};
use crate::kernels::cpu::plan::{Plan, Shapes, axis_bounds, plan};
use crate::kernels::cpu::ragged::{measured, measured_vjp};
use crate::kernels::cpu::reductions;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::machine::Column;
use crate::kernels::machine::found::Best;
use crate::kernels::machine::least::by_negation;
use crate::kernels::machine::suppress::RankedShapes;
use crate::kernels::machine::{Bests, FOREIGN, Founds, InMemory, MachineColumn, Matrix, Stored};
use crate::kernels::machine::{
    Engine, GroupedReduction, Items, Numbers, On, Reduced, Reduction, Room, Sealed, Seed, count_of,
};
use crate::kernels::machine::{GroupSpans, ranked_groups};
use crate::kernels::machine::{Input, VertexBars};
use crate::kernels::machine::{Least, LeastPairs};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::counts::{entries, expect};
use crate::kernels::row::item::{Leaf, Target};
use crate::kernels::row::limits::LowerBound;
use crate::scalar::real::in_format;
use crate::suppression::{Rules, order};
use std::sync::Arc;

/// Returns an error for a column that stays on a GPU.
pub(crate) fn check_here<T: Real>(columns: &[Column<'_, T>]) -> Result<(), Error> {
    let is_away = |column: &Column<'_, T>| column.held.is_some_and(|own| own.here().is_none());
    match columns.iter().any(is_away) {
        true => Err(FOREIGN),
        false => Ok(()),
    }
}

impl Processor {
    /// Checks both lists of a batch of all pairs.
    pub(crate) fn lists<'a, T: Real>(
        &self,
        plan: &'a Plan<T>,
        lists: &'a [Column<'_, T>; 2],
    ) -> Result<Pairs<'a, T>, Error> {
        check_here(lists)?;
        if lists.iter().any(|list| list.len() >= u32::MAX as usize) {
            return Err(Error::TooLarge);
        }
        let [a, b] = lists;
        let rare = [
            check_argument(0, &plan.arguments, a)?,
            check_argument(1, &plan.arguments, b)?,
        ];
        Ok(Pairs {
            plan,
            shapes: [Shapes::of(a), Shapes::of(b)],
            rare,
            filter: self.cull,
        })
    }
}

/// Cotangents within the range of a kernel.
struct ScaledCotangents<T> {
    /// The cotangents divided by `factor`; `None` if all are within range.
    scaled: Option<Vec<T>>,
    /// The power of two by which the results are multiplied.
    factor: T,
}

impl<T: Real> ScaledCotangents<T> {
    /// Divides all cotangents by one power of two if one exceeds the range of the kernel ([`Plan::steepest`]).
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for one that is not finite.
    fn new(plan: &Plan<T>, upstream: &Upstream<'_, T>) -> Result<Self, Error> {
        let steep = tame(upstream.derivatives, plan.steepest)?;
        let factor = steep.iter().flatten().map(|x| x.1).fold(T::one(), T::most);
        let all = upstream.derivatives.iter();
        let scaled = steep.map(|_| all.map(|&x| x.over(factor)).collect());
        Ok(ScaledCotangents { scaled, factor })
    }
    /// Writes the cotangents of both lists.
    fn pull_back(
        &self,
        pairs: &Pairs<'_, T>,
        upstream: Upstream<'_, T>,
        [a_bar, b_bar]: [&mut [T]; 2],
    ) {
        let derivatives = self.scaled.as_deref().unwrap_or(upstream.derivatives);
        let upstream = Upstream {
            derivatives,
            ..upstream
        };
        pairs::pull_back(pairs, upstream, a_bar, b_bar);
        if self.scaled.is_some() {
            restore(a_bar, self.factor);
            restore(b_bar, self.factor);
        }
    }
}

/// The engine of a format. These coercions make this library compile the engines, so that a calling crate compiles no
/// copy.
type EngineOf<T> = fn(&Processor) -> &dyn Engine<T>;
static F32: EngineOf<f32> = |engine| engine;
static F64: EngineOf<f64> = |engine| engine;

impl<T: Real> On<Processor> for T {
    fn engine(engine: &Processor) -> &dyn Engine<T> {
        in_format::<EngineOf<T>>([&F32, &F64])(engine)
    }
}

impl Sealed for Processor {}

impl<T: Real> Engine<T> for Processor {
    fn check(&self, argument: Argument, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error> {
        check_numbers(argument, leaf, numbers)
    }

    fn keep(&self, count: usize, columns: Vec<Numbers<T>>) -> Result<Stored<T>, Error> {
        let columns = columns
            .into_iter()
            .map(|own| Box::new(own) as Box<dyn MachineColumn<T>>);
        Ok(Stored::new(count, columns.collect()))
    }

    fn fold(&self, folding: &Folding<T>, input: &Input<'_, T>, out: &mut [T]) -> Result<(), Error> {
        if let Some(measure) = folding.measure {
            folds::check_spans(input)?;
            let ends = [0, input.plane.len()];
            return measured(measure, input.plane, input.spans.offsets(&ends), out);
        }
        folds::values(folding, input, out)
    }

    fn fold_back(
        &self,
        folding: &Folding<T>,
        input: &Input<'_, T>,
        upstream: &[T],
        by_context: &mut [T],
        by_vertex: VertexBars<'_, T>,
    ) -> Result<(), Error> {
        match by_vertex {
            VertexBars::Plane(measure, bars) => {
                folds::check_spans(input)?;
                let ends = [0, input.plane.len()];
                let offsets = input.spans.offsets(&ends);
                measured_vjp(measure, input.plane, offsets, upstream, bars)
            }
            VertexBars::Numbers(bars) => {
                let (own, path) = folds::cotangents(folding, input, upstream)?;
                by_context.copy_from_slice(&own);
                bars.copy_from_slice(&path);
                Ok(())
            }
        }
    }

    fn room(&self, rows: usize, columns: usize) -> Result<Matrix<T>, Error> {
        let numbers = vec![T::default(); entries(rows, columns, 1)?];
        Ok(Matrix(Box::new(matrix::Matrix::new(
            rows, columns, numbers,
        )?)))
    }

    fn map(
        &self,
        call: &Call<T>,
        columns: &[Column<'_, T>],
        results: Items<'_, T>,
    ) -> Result<bool, Error> {
        check_here(columns)?;
        let plan = plan(call, false)?;
        match results {
            Items::Targets(targets, true) if checks_later(&plan) => {
                let count = count_of(call, columns)?;
                return Ok(compute_unchecked(&plan, columns, count, targets));
            }
            Items::Targets(targets, _) => {
                let (count, rare) = checked(&plan, columns)?;
                compute(&plan, columns, rare, count, targets);
            }
            Items::Held(stored) => {
                stored.own::<Numbers<T>>()?;
                let (count, rare) = checked(&plan, columns)?;
                let mut found = Vec::new();
                for &fields in &plan.gives {
                    let rows = vec![T::default(); entries(count, 1, fields)?];
                    found.push(Numbers::new(fields, rows));
                }
                let targets = found.iter_mut();
                let targets = targets.map(|own| Some(Target::of_rows(&mut own.rows, own.fields)));
                compute(&plan, columns, rare, count, targets.collect());
                *stored = self.keep(count, found)?;
            }
        }
        Ok(true)
    }

    fn pairs(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        results: Room<'_, T>,
    ) -> Result<(), Error> {
        let planes = match results {
            Room::Planes(planes) => planes,
            Room::Held(matrix) => {
                let matrix = matrix.own_mut::<matrix::Matrix<T>>()?;
                expect(Argument::Values, lists[0].len(), matrix.rows())?;
                expect(Argument::Values, lists[1].len(), matrix.columns())?;
                &mut matrix.values
            }
        };
        let plan = plan(call, true)?;
        pairs::planes(&self.lists(&plan, lists)?, planes);
        Ok(())
    }

    fn reduce(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        reduction: Reduction<T>,
    ) -> Result<Reduced<T>, Error> {
        let plan = plan(call, true)?;
        let mut pairs = self.lists(&plan, lists)?;
        if let Reduction::Above(threshold) | Reduction::Count(threshold) = reduction {
            pairs.filter_above(threshold);
        }
        Ok(match reduction {
            Reduction::Best { of_rows } => {
                let (best, among) = match of_rows {
                    true => (reductions::most_of_rows(&pairs), lists[1].len()),
                    false => (reductions::most_of_columns(&pairs), lists[0].len()),
                };
                Reduced::Bests(Bests::new(InMemory(best), among))
            }
            Reduction::Above(threshold) => {
                Reduced::Founds(Founds::new(InMemory(reductions::above(&pairs, threshold))))
            }
            Reduction::Count(threshold) => {
                Reduced::Count(reductions::count_above(&pairs, threshold))
            }
            Reduction::Sum => Reduced::Sum(reductions::sum(&pairs)),
        })
    }

    fn reduce_grouped(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        groups: GroupSpans<'_>,
        reduction: GroupedReduction<T>,
    ) -> Result<Reduced<T>, Error> {
        let plan = plan(call, true)?;
        let mut pairs = self.lists(&plan, lists)?;
        Ok(match reduction {
            GroupedReduction::Best { of_rows } => {
                Reduced::BestsGrouped(grouped::most(&pairs, groups, of_rows))
            }
            GroupedReduction::Above(threshold) => {
                pairs.filter_above(threshold);
                let found = grouped::above(&pairs, groups, threshold);
                Reduced::Founds(Founds::new(InMemory(found)))
            }
        })
    }

    fn least(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        groups: GroupSpans<'_>,
        wanted: Least<T>,
        ties: bool,
    ) -> Result<LeastPairs<T>, Error> {
        let bounds = match call.lower {
            LowerBound::Unknown => None,
            _ if !self.cull => None,
            _ => Arc::unwrap_or_clone(axis_bounds(&call.recording)?),
        };
        let recording = &*call.recording;
        let is_search = matches!(recording.body, Body::Search(_));
        if bounds.is_none() && !ties && !is_search && recording.compiled.is_none() {
            return by_negation(self, call, lists, groups, wanted);
        }
        let plan = plan(call, false)?;
        check_here(lists)?;
        if lists.iter().any(|list| list.len() >= u32::MAX as usize) {
            return Err(Error::TooLarge);
        }
        let sorted = groups.count() == 1;
        // Boxes around a list are kept with it if the machine holds it.
        let boxes_of = |k: usize| {
            let make = || {
                check_argument(k, &plan.arguments, &lists[k])?;
                let bounds = bounds.as_ref();
                Ok(bounds.map(|bounds| Boxes::of(&lists[k], &bounds[k], sorted)))
            };
            let held = lists[k].held.and_then(|own| own.any().downcast_ref());
            match held {
                Some(Numbers::<T> { prepared, .. }) if bounds.is_some() => {
                    prepared.made((recording.number, k, sorted), make)
                }
                _ => make().map(Arc::new),
            }
        };
        let boxes = [boxes_of(0)?, boxes_of(1)?];
        let search = Search {
            plan: &plan,
            lists,
            boxes: match &boxes.each_ref().map(|own| own.as_ref().as_ref()) {
                [Some(a), Some(b)] => Some([a, b]),
                _ => None,
            },
            squared: call.lower == LowerBound::SquaredDistance,
            groups,
            wanted,
            ties,
        };
        Ok(search.run())
    }

    fn pull_back(
        &self,
        call: &Call<T>,
        lists: &[Column<'_, T>; 2],
        seed: &Seed<'_, T>,
        bars: [&mut [T]; 2],
    ) -> Result<f64, Error> {
        let factors;
        let [rows, columns] = [lists[0].len(), lists[1].len()];
        let (derivatives, step) = match seed {
            Seed::Numbers(numbers) => (*numbers, columns),
            Seed::Matrix(matrix) => {
                let own = matrix.own::<matrix::Matrix<T>>()?;
                expect(Argument::Upstream, rows, own.rows())?;
                expect(Argument::Upstream, columns, own.columns())?;
                (&own.values[..], columns)
            }
            Seed::Factor(factor) => {
                factors = vec![*factor; columns.max(1)];
                check_upstream(&factors[..1], 1)?;
                (&factors[..], 0)
            }
        };
        let upstream = Upstream { derivatives, step };
        let plan = plan(&call.clone().derived(Mode::Vjp)?, true)?;
        let pairs = self.lists(&plan, lists)?;
        ScaledCotangents::new(&plan, &upstream)?.pull_back(&pairs, upstream, bars);
        match seed {
            Seed::Factor(_) => Ok(self.reduce(call, lists, Reduction::Sum)?.sum()),
            _ => Ok(0.0),
        }
    }

    fn suppress(
        &self,
        call: &Call<T>,
        shapes: &Column<'_, T>,
        groups: Option<&[usize]>,
        scores: &[T],
        rules: Rules<'_, T>,
    ) -> Result<Vec<usize>, Error> {
        let plan = plan(call, true)?;
        check_here(std::slice::from_ref(shapes))?;
        // All shapes are checked, so that errors name the caller's rows.
        check(Argument::A, &plan.arguments[0], shapes)?;
        let (order, ends) = match groups {
            None => (order(scores, rules.score)?, None),
            Some(offsets) => {
                let (order, ends) = ranked_groups(scores, offsets, rules.score)?;
                (order, Some(ends))
            }
        };
        let ranked = RankedShapes::of(order, shapes, &rules);
        let (lists, greed) = (ranked.lists(), ranked.greed(&rules));
        let pairs = self.lists(&plan, &lists)?;
        let kept = match ends {
            None => greedy::suppress(&pairs, greed),
            Some(ends) => grouped::suppress(&pairs, &ends, greed),
        };
        Ok(kept.into_iter().map(|place| ranked.order[place]).collect())
    }

    fn pick(&self, list: &Stored<T>, bests: &Bests<T>) -> Result<Stored<T>, Error> {
        let own = list.own::<Numbers<T>>()?;
        let found = bests.own::<InMemory<Vec<Best<T>>>>()?;
        expect(Argument::Shape, bests.among, list.len())?;
        let columns = own.into_iter().map(|own| {
            let rows = found.0.iter();
            let row = |best: &Best<T>| &own.rows[best.index * own.fields..][..own.fields];
            Numbers::new(own.fields, rows.flat_map(row).copied().collect())
        });
        self.keep(found.0.len(), columns.collect())
    }
}
