//! Folds over ragged lists of paths: edges side by side as a program, what they tell joined in order.
use crate::ad::program::record::record;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Sym};
use crate::error::{Argument, Field};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check, check_upstream, expect};
use crate::kernels::cpu::desk::Aligned;
use crate::kernels::cpu::plan::{Face, Known, Preparation, Want, known, of_recorded};
use crate::kernels::cpu::ragged::check_ragged;
use crate::kernels::cpu::work::spread;
use crate::kernels::fold::{Fold, edges};
use crate::kernels::real::Real;
use crate::kernels::row::{Column, Columns, Leaf, STRETCH, Target, leaves_of};
use crate::{Error, Fixed, Pack, Scalar, Vec2};
use std::sync::Arc;

/// The bodies of a fold as programs.
pub(crate) struct Programs {
    /// From context, reference and both ends to a state, and its pull-back.
    pub(crate) edge: Recorded,
    pub(crate) edge_vjp: Recorded,
    /// Joining two states, and its pull-back.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a GPU joins by it")
    )]
    pub(crate) join: Recorded,
    pub(crate) join_vjp: Recorded,
    /// The end, and its pull-back.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a GPU ends by it")
    )]
    pub(crate) finish: Recorded,
    pub(crate) finish_vjp: Recorded,
}

pub(crate) fn programs<F: Fold, T: Plain>() -> Result<Arc<Programs>, Error> {
    type Context<F, T> = <F as Fold>::Context<Sym<T>>;
    type Reference<F, T> = <F as Fold>::Reference<Sym<T>>;
    type State<F, T> = <F as Fold>::State<Sym<T>>;
    type Point<T> = Vec2<Sym<T>>;
    known::<F, T, _>(Known::Fold, || {
        let edge = record::<T, (Context<F, T>, Reference<F, T>, Point<T>, Point<T>), State<F, T>>(
            |(context, reference, from, to)| F::edge(context, reference, from, to),
        )?;
        let join = record::<T, (State<F, T>, State<F, T>), State<F, T>>(|(a, b)| F::join(a, b))?;
        let finish = record::<T, (Context<F, T>, Reference<F, T>, State<F, T>), F::Out<Sym<T>>>(
            |(context, reference, state)| F::finish(context, reference, state),
        )?;
        Ok(Programs {
            edge_vjp: edge.value_vjp(),
            join_vjp: join.vjp(),
            finish_vjp: finish.vjp(),
            edge,
            join,
            finish,
        })
    })
}

/// The adjoint of a fold for one path, on any scalar: cotangents of the context and of every vertex.
pub(crate) fn pull_back<F: Fold, S: Scalar>(
    context: F::Context<S>,
    path: &[Vec2<S>],
    out_bar: F::Out<S>,
) -> (F::Context<S>, Vec<Vec2<S>>) {
    // In the format that the scalar has.
    let found = match S::EPSILON > 1e-10 {
        true => programs::<F, f32>(),
        false => programs::<F, f64>(),
    };
    let Ok(programs) = found else {
        // What cannot be recorded has no slopes, and the harness says so.
        let none = S::lit(f64::NAN);
        return (Fixed::filled(none), vec![Vec2::filled(none); path.len()]);
    };
    let reference = F::reference(context, path);
    let ends = |k: usize| [path[k], path[(k + 1) % path.len()]];
    let count = edges::<F>(path.len());
    let states: Vec<F::State<S>> = (0..count)
        .map(|k| F::edge(context, reference, ends(k)[0], ends(k)[1]))
        .collect();
    let shared = [context.scalars(), reference.scalars()].concat();
    let (mut context_bar, state_bars) = backwards::<F, S>(&programs, &shared, &states, out_bar);
    let mut path_bar = vec![Vec2::<S>::zero(); path.len()];
    for (k, state_bar) in state_bars.into_iter().enumerate() {
        let [from, to] = ends(k);
        let points = [from.x, from.y, to.x, to.y];
        let input = [&shared[..], &points, &state_bar.scalars()].concat();
        let bars = &programs.edge_vjp.run_on(&input)[F::State::<S>::LEN..];
        for (bar, &x) in context_bar.iter_mut().zip(bars) {
            *bar += x;
        }
        let at = |i: usize| bars[shared.len() + i];
        path_bar[k] += Vec2::new(at(0), at(1));
        path_bar[(k + 1) % path.len()] += Vec2::new(at(2), at(3));
    }
    (F::Context::load(&context_bar), path_bar)
}

/// From the cotangent of a result to that of the context and of what every edge told.
fn backwards<F: Fold, S: Scalar>(
    programs: &Programs,
    shared: &[S],
    states: &[F::State<S>],
    out_bar: F::Out<S>,
) -> (Vec<S>, Vec<F::State<S>>) {
    // What is known before every edge, and after the last one.
    let mut before = vec![F::empty::<S>()];
    for &state in states {
        before.push(F::join(before[before.len() - 1], state));
    }
    let last = before[states.len()];
    let input = [shared, &last.scalars(), &out_bar.scalars()].concat();
    let bars = programs.finish_vjp.run_on(&input);
    let mut bar = F::State::<S>::load(&bars[shared.len()..]);
    let mut state_bars = vec![bar; states.len()];
    for k in (0..states.len()).rev() {
        let input = [before[k].scalars(), states[k].scalars(), bar.scalars()].concat();
        let bars = programs.join_vjp.run_on(&input);
        bar = F::State::<S>::load(&bars);
        state_bars[k] = F::State::<S>::load(&bars[F::State::<S>::LEN..]);
    }
    (bars[..F::Context::<S>::LEN].to_vec(), state_bars)
}

/// Paths that are folded: what belongs to every edge.
struct Paths<'a, T> {
    vertices: &'a [Vec2<T>],
    /// The path of every edge, and its ends.
    edges: Vec<(u32, u32, u32)>,
    /// Where the edges of every path begin, and the end.
    starts: Vec<usize>,
    /// Of every path its context and then its reference.
    shared: Vec<T>,
}

fn paths<'a, F: Fold, T: Real>(
    contexts: &[Column<'_, T>],
    vertices: &'a [Vec2<T>],
    offsets: &[usize],
) -> Paths<'a, T> {
    let mut paths = Paths {
        vertices,
        edges: Vec::with_capacity(vertices.len()),
        starts: vec![0],
        shared: Vec::new(),
    };
    let (mut room, mut numbers) = (Vec::new(), Vec::new());
    for (path, bounds) in offsets.windows(2).enumerate() {
        numbers.clear();
        for column in contexts {
            numbers.extend_from_slice(column.numbers(path..path + 1, &mut room));
        }
        let context = F::Context::<T>::load(&numbers);
        let own = &vertices[bounds[0]..bounds[1]];
        let start = paths.shared.len();
        let wide = F::Context::<T>::LEN + F::Reference::<T>::LEN;
        paths.shared.resize(start + wide, T::default());
        context.store(&mut paths.shared[start..]);
        F::reference(context, own).store(&mut paths.shared[start + F::Context::<T>::LEN..]);
        for k in 0..edges::<F>(own.len()) {
            let end = bounds[0] + (k + 1) % own.len();
            paths
                .edges
                .push((path as u32, (bounds[0] + k) as u32, end as u32));
        }
        paths.starts.push(paths.edges.len());
    }
    paths
}

/// Checks paths; of every one its context and then its reference, as numbers.
#[cfg(feature = "gpu")]
pub(crate) fn shared<F: Fold, T: Real, C: Columns>(
    context: &C,
    vertices: &[Vec2<T>],
    offsets: &[usize],
) -> Result<Vec<T>, Error>
where
    C::Row: Pack<Scalar = T>,
{
    let contexts = checked(context, vertices, offsets)?;
    Ok(paths::<F, T>(&contexts, vertices, offsets).shared)
}

impl<T: Real> Paths<'_, T> {
    /// What the body takes, edge by edge, as columns.
    fn columns<'a>(&'a self, wide: usize, bars: Option<(&'a [T], usize)>) -> Vec<Column<'a, T>> {
        let count = self.edges.len();
        let mut all = vec![
            Column::read(wide, count, move |edges, rows| {
                for (edge, row) in self.edges[edges].iter().zip(rows.chunks_exact_mut(wide)) {
                    row.copy_from_slice(&self.shared[edge.0 as usize * wide..][..wide]);
                }
            }),
            Column::read(4, count, move |edges, rows| {
                for (edge, row) in self.edges[edges].iter().zip(rows.chunks_exact_mut(4)) {
                    let (from, to) = (
                        self.vertices[edge.1 as usize],
                        self.vertices[edge.2 as usize],
                    );
                    row.copy_from_slice(&[from.x, from.y, to.x, to.y]);
                }
            }),
        ];
        if let Some((bars, fields)) = bars {
            all.push(Column::read(fields, count, move |edges, rows| {
                rows.copy_from_slice(&bars[edges.start * fields..edges.end * fields]);
            }));
        }
        if wide == 0 {
            all.remove(0);
        }
        all
    }
}

/// A body of edges as a batch sees it.
fn face<T: Real>(
    recorded: &Recorded,
    wide: usize,
    state: usize,
    want: Want,
) -> Result<Face<T>, Error> {
    let leaf = |fields| Leaf {
        fields,
        codes: 0,
        name: |_| Field::VALUE,
        check: |_: &[T]| Ok(()),
    };
    let arguments = [wide, 4].into_iter().filter(|&fields| fields > 0).map(leaf);
    of_recorded(want, arguments.collect(), vec![state], recorded, false)
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
    pub fn fold<F, C: Columns, T: Real>(
        &self,
        _fold: F,
        context: C,
        vertices: &[Vec2<T>],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<T>>, Error>
    where
        F: Fold<Context<T> = C::Row>,
        C::Row: Pack<Scalar = T>,
    {
        let contexts = checked(&context, vertices, offsets)?;
        let programs = programs::<F, T>()?;
        let paths = paths::<F, T>(&contexts, vertices, offsets);
        let states = states::<F, T>(&programs, &paths)?;
        let mut out = vec![F::Out::<T>::filled(T::default()); offsets.len() - 1];
        let work = out.chunks_mut(STRETCH).enumerate().collect();
        spread(work, |(i, out): (usize, &mut [F::Out<T>])| {
            for (k, out) in out.iter_mut().enumerate() {
                *out = finished::<F, T>(&paths, &states, i * STRETCH + k);
            }
        });
        Ok(out)
    }

    /// The adjoint of [`fold`](Cpu::fold): one cotangent per context and one per vertex, for one of
    /// every result.
    ///
    /// # Errors
    ///
    /// As [`fold`](Cpu::fold), and for cotangents of another number or not finite.
    pub fn fold_vjp<F, C: Columns, T: Real>(
        &self,
        _fold: F,
        context: C,
        vertices: &[Vec2<T>],
        offsets: &[usize],
        upstream: &[F::Out<T>],
    ) -> Result<(Vec<F::Context<T>>, Vec<Vec2<T>>), Error>
    where
        F: Fold<Context<T> = C::Row>,
        C::Row: Pack<Scalar = T>,
    {
        let contexts = checked(&context, vertices, offsets)?;
        expect(Argument::Upstream, offsets.len() - 1, upstream.len())?;
        let numbers: Vec<T> = upstream.iter().flat_map(Pack::scalars).collect();
        check_upstream(&numbers, F::Out::<T>::LEN.max(1))?;
        let programs = programs::<F, T>()?;
        let paths = paths::<F, T>(&contexts, vertices, offsets);
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
                let own_states = told::<F, T>(&paths, &states, path);
                let (bar, bars) = backwards::<F, T>(&programs, shared, &own_states, upstream[path]);
                *context_bar = F::Context::<T>::load(&bar);
                for bar in bars {
                    bar.store(&mut state_bars[at..]);
                    at += state;
                }
            }
        });
        // From there to the ends of every edge.
        let body = face::<T>(&programs.edge_vjp, wide, state, Want::Vjp)?;
        let count = paths.edges.len();
        let (mut shared_bars, mut end_bars) = (
            vec![T::default(); count * wide],
            vec![[T::default(); 4]; count],
        );
        let columns = paths.columns(wide, Some((&state_bars, state)));
        let ends = Target::of_rows(end_bars.as_flattened_mut(), 4);
        let mut targets = vec![Some(ends)];
        if wide > 0 {
            targets.insert(0, Some(Target::of_rows(&mut shared_bars, wide)));
        }
        (T::drivers().aligned)(Aligned {
            face: &body,
            columns,
            rare: false,
            count,
            targets,
        });
        let mut path_bars = vec![Vec2::<T>::zero(); vertices.len()];
        for (k, (&(path, from, to), bar)) in paths.edges.iter().zip(&end_bars).enumerate() {
            path_bars[from as usize] += Vec2::new(bar[0], bar[1]);
            path_bars[to as usize] += Vec2::new(bar[2], bar[3]);
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
        Ok((context_bars, path_bars))
    }
}

/// Checks paths and their contexts.
fn checked<'a, C: Columns, T: Real>(
    context: &'a C,
    vertices: &[Vec2<T>],
    offsets: &[usize],
) -> Result<Vec<Column<'a, T>>, Error>
where
    C::Row: Pack<Scalar = T>,
{
    check_ragged(vertices, offsets)?;
    if vertices.len() >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    let mut contexts = Vec::new();
    context.list(&mut |column| contexts.push(column));
    for (k, (column, leaf)) in contexts.iter().zip(leaves_of::<C::Row>()).enumerate() {
        if let Some(found) = column.count {
            expect(Argument::input(k), offsets.len() - 1, found)?;
        }
        check(Argument::input(k), &Preparation::plain(leaf), column)?;
    }
    Ok(contexts)
}

/// What every edge tells.
fn states<F: Fold, T: Real>(programs: &Programs, paths: &Paths<'_, T>) -> Result<Vec<T>, Error> {
    let (wide, state) = (
        F::Context::<T>::LEN + F::Reference::<T>::LEN,
        F::State::<T>::LEN,
    );
    let body = face::<T>(&programs.edge, wide, state, Want::Value)?;
    let count = paths.edges.len();
    let mut states = vec![T::default(); count * state];
    let targets = vec![Some(Target::of_rows(&mut states, state))];
    (T::drivers().aligned)(Aligned {
        face: &body,
        columns: paths.columns(wide, None),
        rare: false,
        count,
        targets,
    });
    Ok(states)
}

/// What the edges of a path told.
fn told<F: Fold, T: Real>(paths: &Paths<'_, T>, states: &[T], path: usize) -> Vec<F::State<T>> {
    let fields = F::State::<T>::LEN;
    let own = paths.starts[path] * fields..paths.starts[path + 1] * fields;
    states[own]
        .chunks_exact(fields)
        .map(F::State::load)
        .collect()
}

/// The result of a path.
fn finished<F: Fold, T: Real>(paths: &Paths<'_, T>, states: &[T], path: usize) -> F::Out<T> {
    let own = F::Context::<T>::LEN;
    let wide = own + F::Reference::<T>::LEN;
    let shared = &paths.shared[path * wide..][..wide];
    let told = told::<F, T>(paths, states, path);
    let state = told.into_iter().fold(F::empty(), F::join);
    let out = F::finish(
        F::Context::load(shared),
        F::Reference::load(&shared[own..]),
        state,
    );
    let canonical: Vec<T> = out.scalars().iter().map(|x| x.canonical()).collect();
    F::Out::load(&canonical)
}
