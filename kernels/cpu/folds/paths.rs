//! Paths that are folded, edge by edge.
use super::programs::with_winding;
use crate::kernels::cpu::checked::numbers;
use crate::kernels::cpu::nearest::Spans;
use crate::kernels::cpu::ragged::check_vertices;
use crate::kernels::fold::{Fold, edges};
use crate::kernels::item::Column;
use crate::kernels::real::Real;
use crate::{Error, Fixed, Pack, Vec2};
use std::borrow::Cow;
use std::ops::Range;

/// Paths that are folded, with the numbers of every edge.
pub(super) struct Paths<'a, T: Clone> {
    /// The numbers of all vertices, and how many one has.
    pub(super) vertices: Cow<'a, [T]>,
    pub(super) element: usize,
    /// The path of every edge, and its ends.
    pub(super) edges: Vec<(u32, u32, u32)>,
    /// The index of the first edge of every path, and the end of the last.
    pub(super) starts: Vec<usize>,
    /// The context and then the reference of every path.
    pub(super) shared: Vec<T>,
    /// The winding number of every path; `None` where all of its edges are listed.
    pub(super) windings: Vec<Option<T>>,
}

pub(super) fn paths<'a, F: Fold, T: Real>(
    contexts: &[Column<'_, T>],
    vertices: &'a [F::Element<T>],
    spans: Spans<'_>,
) -> Result<Paths<'a, T>, Error> {
    let mut paths = Paths {
        vertices: numbers(vertices),
        element: F::Element::<T>::LEN,
        edges: Vec::new(),
        starts: vec![0],
        shared: Vec::new(),
        windings: vec![None; spans.count()],
    };
    let (mut room, mut own) = (Vec::new(), Vec::new());
    let mut points = Vec::new();
    for path in 0..spans.count() {
        own.clear();
        for column in contexts {
            own.extend_from_slice(column.numbers(path..path + 1, &mut room));
        }
        let context = F::Context::<T>::load(&own);
        let bounds = spans.of(path);
        let start = paths.shared.len();
        let wide = F::Context::<T>::LEN + F::Reference::<T>::LEN;
        paths.shared.resize(start + wide, T::default());
        context.store(&mut paths.shared[start..]);
        let reference = F::reference(context, &vertices[bounds.clone()]);
        reference.store(&mut paths.shared[start + F::Context::<T>::LEN..]);
        match F::WINDING {
            Some(_) => points.push(Vec2::load(&own)),
            None => {
                let count = edges::<F>(bounds.len());
                paths.add(path, bounds, 0..count);
            }
        }
    }
    if F::WINDING.is_some() {
        let (mut path, vertices) = (0, F::in_plane(vertices));
        let Some(pieces) = (T::drivers().sieved)(&points, vertices, spans, F::CLOSED) else {
            check_vertices(vertices)?;
            return Ok(paths);
        };
        for sieved in pieces {
            let mut rest = sieved.edges.iter().map(|&k| k as usize);
            for (count, winding) in sieved.counts {
                paths.add(path, spans.of(path), rest.by_ref().take(count));
                paths.windings[path] = winding;
                path += 1;
            }
        }
    }
    Ok(paths)
}

impl<T: Real> Paths<'_, T> {
    /// Lists edges of the next path, which has the vertices between two bounds.
    fn add(&mut self, path: usize, bounds: Range<usize>, edges: impl Iterator<Item = usize>) {
        for k in edges {
            let (from, to) = (bounds.start + k, bounds.start + k + 1);
            let to = if to < bounds.end { to } else { bounds.start };
            self.edges.push((path as u32, from as u32, to as u32));
        }
        self.starts.push(self.edges.len());
    }
    /// The arguments of the body, edge by edge, as columns.
    pub(super) fn columns<'a>(
        &'a self,
        wide: usize,
        bars: Option<(&'a [T], usize)>,
    ) -> Vec<Column<'a, T>> {
        let (count, n) = (self.edges.len(), self.element);
        let mut all = vec![
            Column::read(wide, count, move |edges, rows| {
                for (edge, row) in self.edges[edges].iter().zip(rows.chunks_exact_mut(wide)) {
                    row.copy_from_slice(&self.shared[edge.0 as usize * wide..][..wide]);
                }
            }),
            Column::read(2 * n, count, move |edges, rows| {
                for (edge, row) in self.edges[edges].iter().zip(rows.chunks_exact_mut(2 * n)) {
                    row[..n].copy_from_slice(&self.vertices[edge.1 as usize * n..][..n]);
                    row[n..].copy_from_slice(&self.vertices[edge.2 as usize * n..][..n]);
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

/// The states of the listed edges of a path.
pub(super) fn told<F: Fold, T: Real>(
    paths: &Paths<'_, T>,
    states: &[T],
    path: usize,
) -> impl Iterator<Item = F::State<T>> {
    let fields = F::State::<T>::LEN;
    let own = paths.starts[path] * fields..paths.starts[path + 1] * fields;
    states[own].chunks_exact(fields).map(F::State::load)
}

/// The result of a path.
pub(super) fn finished<F: Fold, T: Real>(
    paths: &Paths<'_, T>,
    states: &[T],
    path: usize,
) -> F::Out<T> {
    let own = F::Context::<T>::LEN;
    let wide = own + F::Reference::<T>::LEN;
    let shared = &paths.shared[path * wide..][..wide];
    let told = told::<F, T>(paths, states, path);
    let state = with_winding::<F, T>(told.fold(F::empty(), F::join), paths.windings[path]);
    let out = F::finish(
        F::Context::load(shared),
        F::Reference::load(&shared[own..]),
        state,
    );
    let canonical: Vec<T> = out.scalars().iter().map(|x| x.canonical()).collect();
    F::Out::load(&canonical)
}
