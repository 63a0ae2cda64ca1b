//! Folds over ragged lists of paths: edges side by side as a program, what they tell joined in order.
pub(crate) mod folding;
mod paths;
mod programs;

use crate::error::{Argument, Field, Flaw};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check_argument, check_upstream, expect, fill, numbers};
use crate::kernels::cpu::desk::Aligned;
use crate::kernels::cpu::nearest::Spans;
use crate::kernels::cpu::plan::{Face, of_recorded};
use crate::kernels::cpu::ragged::{check_offsets, measured, measured_vjp};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::fold::Fold;
use crate::kernels::item::{Columns, Leaf, STRETCH, Target};
use crate::kernels::real::Real;
use crate::kernels::recording::{Key, Mode};
use crate::{Error, Fixed, Pack};
pub(crate) use folding::backwards;
use folding::{Folding, Sizes};
pub use paths::Input;
use paths::{Paths, paths, told};
pub(crate) use programs::Programs;
#[cfg(any(feature = "gpu", feature = "check"))]
pub(crate) use programs::programs;
use std::ops::Range;
use std::sync::Arc;

/// Checks paths; of every one its context and then its reference, as numbers.
#[cfg(feature = "gpu")]
pub(crate) fn shared<F: Fold, T: Real, C: Columns>(
    context: &C,
    vertices: &[F::Element<T>],
    offsets: &[usize],
) -> Result<Vec<T>, Error>
where
    C::Item: Pack<Scalar = T>,
{
    on::<F, C, T, _>(
        context,
        vertices,
        Spans::Ragged(offsets),
        |folding, input| {
            folding.checked(input)?;
            Ok(paths(folding, input)?.shared)
        },
    )
}

impl Cpu {
    /// One result per path. Path i has the vertices `offsets[i]..offsets[i + 1]`; there is one offset
    /// more than there are paths, from 0 to the number of vertices. `context` is what else the fold
    /// takes, one per path or [`One`](crate::kernels::One) for all.
    ///
    /// # Errors
    ///
    /// [`Error::Offsets`] for offsets that decrease or do not cover the vertices, [`Error::Length`] for
    /// another number of contexts than paths, [`Error::Invalid`] for a vertex or context that is not
    /// valid.
    pub fn fold<F, C: Columns, V: Fixed<Scalar: Real>>(
        &self,
        _fold: F,
        context: C,
        vertices: &[V],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        folded::<F, C, V::Scalar>(&context, vertices, Spans::Ragged(offsets))
    }

    /// [`fold`](Cpu::fold) for one path that all contexts share: one result per context; a single one where one
    /// context stands for all, or contexts have no numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a vertex or context that is not valid, [`Error::Length`] for contexts of different
    /// numbers.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, SignedDistance};
    /// use geograd::{Aabb2, Vec2};
    /// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
    /// let points = [Vec2::new(1.0, 2.0), Vec2::new(7.0, 8.0)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.fold_one(SignedDistance.over_ring(), &points, &square)?, [-1.0, 5.0]);
    /// let (by_point, by_vertex) = cpu.fold_one_vjp(SignedDistance.over_ring(), &points, &square, &[1.0, 1.0])?;
    /// assert_eq!(by_point[0].x, -1.0);
    /// assert!((by_vertex[2].x + 0.6).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn fold_one<F, C: Columns, V: Fixed<Scalar: Real>>(
        &self,
        _fold: F,
        contexts: C,
        path: &[V],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        let count = contexts_of(&contexts);
        folded::<F, C, V::Scalar>(&contexts, path, Spans::Shared(count, path.len()))
    }

    /// The adjoint of [`fold`](Cpu::fold): one cotangent per context and one per vertex, for one of
    /// every result.
    ///
    /// # Errors
    ///
    /// As [`fold`](Cpu::fold), and for cotangents of another number or not finite.
    pub fn fold_vjp<F, C: Columns, V: Fixed<Scalar: Real>>(
        &self,
        _fold: F,
        context: C,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<(Vec<C::Item>, Vec<V>), Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        pulled_back::<F, C, V::Scalar>(&context, vertices, Spans::Ragged(offsets), upstream)
    }

    /// The adjoint of [`fold_one`](Cpu::fold_one): one cotangent per context, and one per vertex, added up over all
    /// contexts.
    ///
    /// # Errors
    ///
    /// As [`fold_one`](Cpu::fold_one), and for cotangents of another number or not finite.
    pub fn fold_one_vjp<F, C: Columns, V: Fixed<Scalar: Real>>(
        &self,
        _fold: F,
        contexts: C,
        path: &[V],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<(Vec<C::Item>, Vec<V>), Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        let spans = Spans::Shared(contexts_of(&contexts), path.len());
        pulled_back::<F, C, V::Scalar>(&contexts, path, spans, upstream)
    }
}

/// How many contexts there are: one where one stands for all.
fn contexts_of<C: Columns>(contexts: &C) -> usize {
    let mut count = None;
    contexts.list(&mut |column| count = count.or(column.count));
    count.unwrap_or(1)
}

/// Runs something on a fold, contexts and paths without their types.
fn on<F: Fold, C: Columns, T: Real, R>(
    context: &C,
    vertices: &[F::Element<T>],
    spans: Spans<'_>,
    run: impl FnOnce(&Folding<T>, &Input<'_, T>) -> Result<R, Error>,
) -> Result<R, Error>
where
    C::Item: Pack<Scalar = T>,
{
    let mut contexts = Vec::new();
    context.list(&mut |column| contexts.push(column));
    let input = Input {
        contexts,
        vertices: numbers(vertices),
        plane: F::in_plane(vertices),
        spans,
        refer: &|context, path, reference| {
            F::reference(F::Context::load(context), &vertices[path]).store(reference);
        },
    };
    run(&Folding::of::<F, C::Item>(), &input)
}

/// The result of every path.
fn folded<F: Fold, C: Columns, T: Real>(
    context: &C,
    vertices: &[F::Element<T>],
    spans: Spans<'_>,
) -> Result<Vec<F::Out<T>>, Error>
where
    C::Item: Pack<Scalar = T>,
{
    if let Some(measure) = F::MEASURE {
        let (plane, ends) = (F::in_plane(vertices), [0, vertices.len()]);
        let offsets = spans.offsets(&ends);
        check_offsets::<T>(vertices.len(), offsets)?;
        let mut out = vec![F::Out::filled(T::default()); spans.count()];
        fill(&mut out, |out| measured(measure, plane, offsets, out))?;
        return Ok(out);
    }
    on::<F, C, T, _>(context, vertices, spans, |folding, input| {
        let numbers = (T::drivers().folded)(folding, input)?;
        let mut out = vec![F::Out::filled(T::default()); spans.count()];
        for (out, numbers) in out.iter_mut().zip(folding.sizes.results(&numbers)) {
            *out = F::Out::load(numbers);
        }
        Ok(out)
    })
}

/// Cotangents of every context and every vertex.
type Pulled<F, T> = (Vec<<F as Fold>::Context<T>>, Vec<<F as Fold>::Element<T>>);

fn pulled_back<F: Fold, C: Columns, T: Real>(
    context: &C,
    vertices: &[F::Element<T>],
    spans: Spans<'_>,
    upstream: &[F::Out<T>],
) -> Result<Pulled<F, T>, Error>
where
    C::Item: Pack<Scalar = T>,
{
    let seeds = numbers(upstream);
    if let Some(measure) = F::MEASURE {
        let (plane, ends) = (F::in_plane(vertices), [0, vertices.len()]);
        let given = (upstream.len(), &*seeds);
        let mut bars = vec![F::Element::filled(T::default()); vertices.len()];
        let own = F::in_plane_mut(&mut bars);
        measured_vjp(measure, plane, spans.offsets(&ends), given, own)?;
        return Ok((vec![F::Context::filled(T::default()); upstream.len()], bars));
    }
    on::<F, C, T, _>(context, vertices, spans, |folding, input| {
        let (by_context, by_vertex) =
            (T::drivers().pulled_back)(folding, input, upstream.len(), &seeds)?;
        // Loops, since every adapter of an iterator is compiled for every fold.
        let mut context_bars = vec![F::Context::filled(T::default()); upstream.len()];
        for (bar, numbers) in context_bars
            .iter_mut()
            .zip(by_context.chunks_exact(folding.sizes.own.max(1)))
        {
            *bar = F::Context::load(numbers);
        }
        let mut path_bars = vec![F::Element::filled(T::default()); vertices.len()];
        for (bar, numbers) in path_bars
            .iter_mut()
            .zip(by_vertex.chunks_exact(folding.sizes.element.max(1)))
        {
            *bar = F::Element::load(numbers);
        }
        Ok((context_bars, path_bars))
    })
}

/// The numbers of the result of every path.
pub fn values<T: Real>(folding: &Folding<T>, input: &Input<'_, T>) -> Result<Vec<T>, Error> {
    folding.checked(input)?;
    let (sizes, programs) = (&folding.sizes, (folding.programs)()?);
    let paths = paths(folding, input)?;
    let states = states(sizes, &programs, &paths)?;
    let mut out = vec![T::default(); input.spans.count() * sizes.out];
    let work = out
        .chunks_mut(STRETCH * sizes.out.max(1))
        .enumerate()
        .collect();
    spread(work, |(i, out): (usize, &mut [T])| {
        let mut state = vec![T::default(); sizes.state];
        for (k, out) in out.chunks_exact_mut(sizes.out).enumerate() {
            let path = i * STRETCH + k;
            (folding.joined)(told(sizes, &paths, &states, path), &mut state);
            sizes.wind(&mut state, paths.windings[path]);
            (folding.finish)(
                &paths.shared[path * sizes.wide..][..sizes.wide],
                &state,
                out,
            );
            for x in out {
                *x = x.canonical();
            }
        }
    });
    Ok(out)
}

/// The numbers of the cotangents of every context and every vertex, for so many of results.
pub fn cotangents<T: Real>(
    folding: &Folding<T>,
    input: &Input<'_, T>,
    results: usize,
    upstream: &[T],
) -> Result<(Vec<T>, Vec<T>), Error> {
    folding.checked(input)?;
    let (sizes, programs) = (&folding.sizes, (folding.programs)()?);
    expect(Argument::Upstream, input.spans.count(), results)?;
    check_upstream(upstream, sizes.out.max(1))?;
    let paths = paths(folding, input)?;
    let states = states(sizes, &programs, &paths)?;
    // From results to what every edge told.
    let Sizes {
        own,
        wide,
        state,
        element,
        ..
    } = *sizes;
    let mut context_bars = vec![T::default(); results * own];
    let mut state_bars = vec![T::default(); states.len()];
    let mut work = Vec::new();
    let (mut rest, mut contexts) = (&mut state_bars[..], &mut context_bars[..]);
    for first in (0..results).step_by(STRETCH) {
        let end = results.min(first + STRETCH);
        let edges = paths.starts[end] - paths.starts[first];
        let (some, after) = rest.split_at_mut(edges * state);
        let (bars, later) = contexts.split_at_mut((end - first) * own);
        (rest, contexts) = (after, later);
        work.push((first..end, bars, some));
    }
    type Work<'a, T> = (Range<usize>, &'a mut [T], &'a mut [T]);
    spread(work, |(some, context_bars, state_bars): Work<'_, T>| {
        let mut at = 0;
        for (k, path) in some.enumerate() {
            let shared = &paths.shared[path * wide..][..wide];
            let told = told(sizes, &paths, &states, path);
            let before = (folding.before)(told);
            let out_bar = &upstream[path * sizes.out..][..sizes.out];
            let winding = paths.windings[path];
            let (bar, bars) =
                backwards(sizes, &programs, shared, [told, &before], winding, out_bar);
            context_bars[k * own..][..own].copy_from_slice(&bar[..own]);
            state_bars[at..at + bars.len()].copy_from_slice(&bars);
            at += bars.len();
        }
    });
    // From there to the ends of every edge.
    let body = plan(sizes, &programs, Mode::Vjp)?;
    let count = paths.edges.len();
    let mut shared_bars = vec![T::default(); count * wide];
    let mut end_bars = vec![T::default(); count * 2 * element];
    let columns = paths.columns(wide, Some((&state_bars, state)));
    let ends = Target::of_rows(&mut end_bars, 2 * element);
    let mut targets = vec![Some(ends)];
    if wide > 0 {
        targets.insert(0, Some(Target::of_rows(&mut shared_bars, wide)));
    }
    (T::drivers().aligned)(Aligned {
        unchecked: false,
        face: &body,
        columns: &columns,
        rare: false,
        count,
        targets,
    });
    let mut path_bars = vec![T::default(); input.vertices.len()];
    let add = |sums: &mut [T], bars: &[T]| {
        for (sum, &x) in sums.iter_mut().zip(bars) {
            *sum += x;
        }
    };
    let ends = end_bars.chunks_exact((2 * element).max(1));
    for (k, (&(path, from, to), bar)) in paths.edges.iter().zip(ends).enumerate() {
        for (end, bar) in [from, to].into_iter().zip(bar.chunks_exact(element)) {
            add(&mut path_bars[end as usize * element..][..element], bar);
        }
        let context = &mut context_bars[path as usize * own..][..own];
        add(context, &shared_bars[k * wide..][..own]);
    }
    for bar in &mut path_bars {
        *bar = bar.canonical();
    }
    Ok((context_bars, path_bars))
}

impl<T: Real> Folding<T> {
    /// Checks paths and their contexts. Whoever looks at every vertex anyway finds those that are not finite itself.
    fn checked(&self, input: &Input<'_, T>) -> Result<(), Error> {
        let (spans, winding) = (input.spans, self.sizes.winding);
        let vertices = input.vertices.len() / self.sizes.element.max(1);
        match spans {
            Spans::Ragged(offsets) => check_offsets::<T>(vertices, offsets)?,
            Spans::Shared(..) => {
                Simd::current()?;
            }
        }
        if winding.is_none() && !(T::kernels().all_finite)(&input.vertices) {
            return Err(self.first_flaw(&input.vertices));
        }
        let edges = match spans {
            Spans::Shared(paths, length) if winding.is_none() => paths.saturating_mul(length),
            _ => vertices,
        };
        if edges.max(spans.count()) >= u32::MAX as usize {
            return Err(Error::TooLarge);
        }
        let plans = self.preparations();
        for (k, column) in input.contexts.iter().enumerate() {
            if let Some(found) = column.count {
                expect(plans[k].argument(k), spans.count(), found)?;
            }
            check_argument(k, &plans, column)?;
        }
        Ok(())
    }
    /// The first number of a vertex that is not finite.
    fn first_flaw(&self, vertices: &[T]) -> Error {
        let at = vertices.iter().position(|x| !x.finite()).unwrap_or(0);
        let element = self.sizes.element.max(1);
        Error::Invalid {
            argument: Argument::Vertices,
            item: at / element,
            flaw: Flaw::NotFinite((self.field)(at % element)),
        }
    }
}

/// A body of edges as a batch sees it.
fn plan<T: Real>(sizes: &Sizes, programs: &Programs, mode: Mode) -> Result<Arc<Face<T>>, Error> {
    let recorded = match mode {
        Mode::Vjp => &programs.edge_vjp,
        _ => &programs.edge,
    };
    programs.made.made(Key::Cpu(mode, false), &|| {
        let leaf = |fields| Leaf {
            shape: || "",
            fields,
            codes: 0,
            name: |_| Field::VALUE,
            check: |_: &[T]| Ok(()),
            all_valid: |_| true,
        };
        let arguments = [sizes.wide, 2 * sizes.element]
            .into_iter()
            .filter(|&fields| fields > 0)
            .map(leaf);
        of_recorded(
            mode,
            arguments.collect(),
            vec![sizes.state],
            recorded,
            false,
        )
    })
}

/// The states of all edges.
fn states<T: Real>(
    sizes: &Sizes,
    programs: &Programs,
    paths: &Paths<'_, T>,
) -> Result<Vec<T>, Error> {
    let body = plan(sizes, programs, Mode::Value)?;
    let count = paths.edges.len();
    let mut states = vec![T::default(); count * sizes.state];
    let targets = vec![Some(Target::of_rows(&mut states, sizes.state))];
    (T::drivers().aligned)(Aligned {
        unchecked: false,
        face: &body,
        columns: &paths.columns(sizes.wide, None),
        rare: false,
        count,
        targets,
    });
    Ok(states)
}
