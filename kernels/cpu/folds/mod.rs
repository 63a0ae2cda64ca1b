//! Folds over ragged lists of paths: edges side by side as a program, what they tell joined in order.
mod paths;
mod programs;

use crate::error::{Argument, Field};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check_argument, check_upstream, expect, numbers};
use crate::kernels::cpu::desk::Aligned;
use crate::kernels::cpu::nearest::Spans;
use crate::kernels::cpu::plan::{Face, Preparation, name, of_recorded};
use crate::kernels::cpu::ragged::{check_elements, check_offsets};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::cpu::work::spread;
use crate::kernels::fold::Fold;
use crate::kernels::item::{Column, Columns, Leaf, STRETCH, Target, leaves_of};
use crate::kernels::real::Real;
use crate::kernels::recording::{Key, Mode};
use crate::{Error, Fixed, Pack};
use paths::{Paths, finished, paths, told};
pub(crate) use programs::{Programs, backwards, programs};
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
    let spans = Spans::Ragged(offsets);
    let contexts = checked::<F, C, T>(context, vertices, spans)?;
    Ok(paths::<F, T>(&contexts, vertices, spans)?.shared)
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

/// The result of every path.
fn folded<F: Fold, C: Columns, T: Real>(
    context: &C,
    vertices: &[F::Element<T>],
    spans: Spans<'_>,
) -> Result<Vec<F::Out<T>>, Error>
where
    C::Item: Pack<Scalar = T>,
{
    let contexts = checked::<F, C, T>(context, vertices, spans)?;
    let programs = programs::<F, T>()?;
    let paths = paths::<F, T>(&contexts, vertices, spans)?;
    let states = states::<F, T>(&programs, &paths)?;
    let mut out = vec![F::Out::<T>::filled(T::default()); spans.count()];
    let work = out.chunks_mut(STRETCH).enumerate().collect();
    spread(work, |(i, out): (usize, &mut [F::Out<T>])| {
        for (k, out) in out.iter_mut().enumerate() {
            *out = finished::<F, T>(&paths, &states, i * STRETCH + k);
        }
    });
    Ok(out)
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
    let contexts = checked::<F, C, T>(context, vertices, spans)?;
    expect(Argument::Upstream, spans.count(), upstream.len())?;
    let numbers: Vec<T> = upstream.iter().flat_map(Pack::scalars).collect();
    check_upstream(&numbers, F::Out::<T>::LEN.max(1))?;
    let programs = programs::<F, T>()?;
    let paths = paths::<F, T>(&contexts, vertices, spans)?;
    let states = states::<F, T>(&programs, &paths)?;
    // From results to what every edge told.
    let (own, state) = (F::Context::<T>::LEN, F::State::<T>::LEN);
    let wide = own + F::Reference::<T>::LEN;
    let mut context_bars = vec![F::Context::<T>::filled(T::default()); upstream.len()];
    let mut state_bars = vec![T::default(); states.len()];
    let mut work = Vec::new();
    let mut rest = &mut state_bars[..];
    for (i, bars) in context_bars.chunks_mut(STRETCH).enumerate() {
        let first = i * STRETCH;
        let edges = paths.starts[first + bars.len()] - paths.starts[first];
        let (some, after) = rest.split_at_mut(edges * state);
        rest = after;
        work.push((first, bars, some));
    }
    type Work<'a, F, T> = (usize, &'a mut [<F as Fold>::Context<T>], &'a mut [T]);
    spread(work, |(first, context_bars, state_bars): Work<'_, F, T>| {
        let mut at = 0;
        for (k, context_bar) in context_bars.iter_mut().enumerate() {
            let path = first + k;
            let shared = &paths.shared[path * wide..][..wide];
            let own_states: Vec<_> = told::<F, T>(&paths, &states, path).collect();
            let winding = paths.windings[path];
            let (bar, bars) =
                backwards::<F, T>(&programs, shared, &own_states, winding, upstream[path]);
            *context_bar = F::Context::<T>::load(&bar);
            for bar in bars {
                bar.store(&mut state_bars[at..]);
                at += state;
            }
        }
    });
    // From there to the ends of every edge.
    let body = plan::<F, T>(&programs, Mode::Vjp)?;
    let count = paths.edges.len();
    let element = F::Element::<T>::LEN;
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
    let mut path_bars = vec![T::default(); vertices.len() * element];
    let element = element.max(1);
    let ends = end_bars.chunks_exact(2 * element);
    for (k, (&(path, from, to), bar)) in paths.edges.iter().zip(ends).enumerate() {
        for (end, bar) in [from, to].into_iter().zip(bar.chunks_exact(element)) {
            let sums = &mut path_bars[end as usize * element..][..element];
            for (sum, &x) in sums.iter_mut().zip(bar) {
                *sum += x;
            }
        }
        if own > 0 {
            let mut sum = context_bars[path as usize].scalars();
            for (sum, &x) in sum.iter_mut().zip(&shared_bars[k * wide..][..own]) {
                *sum += x;
            }
            context_bars[path as usize] = F::Context::<T>::load(&sum);
        }
    }
    for bar in &mut path_bars {
        *bar = bar.canonical();
    }
    let path_bars = path_bars.chunks_exact(element).map(F::Element::load);
    Ok((context_bars, path_bars.collect()))
}

/// Checks paths and their contexts. Whoever looks at every vertex anyway finds those that are not finite itself.
fn checked<'a, F: Fold, C: Columns, T: Real>(
    context: &'a C,
    vertices: &[F::Element<T>],
    spans: Spans<'_>,
) -> Result<Vec<Column<'a, T>>, Error>
where
    C::Item: Pack<Scalar = T>,
{
    match spans {
        Spans::Ragged(offsets) => check_offsets::<T>(vertices.len(), offsets)?,
        Spans::Shared(..) => {
            Simd::current()?;
        }
    }
    if F::WINDING.is_none() && !(T::kernels().all_finite)(&numbers(vertices)) {
        check_elements(vertices)?;
    }
    let edges = match spans {
        Spans::Shared(paths, length) if F::WINDING.is_none() => paths.saturating_mul(length),
        _ => vertices.len(),
    };
    if edges.max(spans.count()) >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    let mut contexts = Vec::new();
    context.list(&mut |column| contexts.push(column));
    let leaves = leaves_of::<C::Item>();
    let mut plans: Vec<_> = leaves.into_iter().map(Preparation::plain).collect();
    name(&mut plans, F::ARGUMENTS);
    for (k, column) in contexts.iter().enumerate() {
        if let Some(found) = column.count {
            expect(plans[k].argument(k), spans.count(), found)?;
        }
        check_argument(k, &plans, column)?;
    }
    Ok(contexts)
}

/// A body of edges as a batch sees it.
fn plan<F: Fold, T: Real>(programs: &Programs, mode: Mode) -> Result<Arc<Face<T>>, Error> {
    let recorded = match mode {
        Mode::Vjp => &programs.edge_vjp,
        _ => &programs.edge,
    };
    let wide = F::Context::<T>::LEN + F::Reference::<T>::LEN;
    let state = F::State::<T>::LEN;
    programs.made.made(Key::Cpu(mode, false), &|| {
        let leaf = |fields| Leaf {
            shape: || "",
            fields,
            codes: 0,
            name: |_| Field::VALUE,
            check: |_: &[T]| Ok(()),
            all_valid: |_| true,
        };
        let arguments = [wide, 2 * F::Element::<T>::LEN]
            .into_iter()
            .filter(|&fields| fields > 0)
            .map(leaf);
        of_recorded(mode, arguments.collect(), vec![state], recorded, false)
    })
}

/// The states of all edges.
fn states<F: Fold, T: Real>(programs: &Programs, paths: &Paths<'_, T>) -> Result<Vec<T>, Error> {
    let (wide, state) = (
        F::Context::<T>::LEN + F::Reference::<T>::LEN,
        F::State::<T>::LEN,
    );
    let body = plan::<F, T>(programs, Mode::Value)?;
    let count = paths.edges.len();
    let mut states = vec![T::default(); count * state];
    let targets = vec![Some(Target::of_rows(&mut states, state))];
    (T::drivers().aligned)(Aligned {
        unchecked: false,
        face: &body,
        columns: &paths.columns(wide, None),
        rare: false,
        count,
        targets,
    });
    Ok(states)
}
