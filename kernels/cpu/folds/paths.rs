//! The edges of paths to fold.
use super::near_edges::{NearEdges, NearSearch};
use crate::error::{Argument, Flaw};
use crate::kernels::call::folding::{Folding, Sizes};
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::{Column, Input, PathSpans};
use crate::{Error, Fixed, Real, Vec2};
use std::ops::Range;

/// Paths to fold, with the numbers of every edge.
pub(crate) struct Paths<'a, T> {
    /// The numbers of all vertices, and how many each has.
    pub(super) vertices: &'a [T],
    pub(super) element: usize,
    /// For every edge its path and its end points.
    pub(super) edges: Vec<(u32, u32, u32)>,
    /// The index of the first edge of every path, and the end of the last.
    pub(super) starts: Vec<usize>,
    /// The context and the reference vertex of every path.
    pub(crate) shared: Vec<T>,
    /// The winding number of every path; `None` where all of its edges are listed.
    pub(super) windings: Vec<Option<T>>,
}

/// Lists the edges of checked paths.
pub(crate) fn paths<'a, T: Real>(
    folding: &Folding<T>,
    input: &'a Input<'_, T>,
) -> Result<Paths<'a, T>, Error> {
    let (sizes, spans) = (&folding.sizes, input.spans);
    let mut paths = Paths {
        vertices: &input.vertices,
        element: sizes.element,
        edges: Vec::new(),
        starts: vec![0],
        shared: vec![T::default(); spans.count() * sizes.wide],
        windings: Vec::new(),
    };
    let (mut room, mut context) = (Vec::new(), Vec::new());
    let mut points = Vec::new();
    for path in 0..spans.count() {
        let (own, reference) =
            paths.shared[path * sizes.wide..][..sizes.wide].split_at_mut(sizes.own);
        context.clear();
        for column in &input.contexts {
            context.extend_from_slice(column.numbers(path..path + 1, &mut room));
        }
        own.copy_from_slice(&context[..sizes.own]);
        let bounds = spans.of(path);
        (input.reference)(own, bounds.clone(), reference);
        match sizes.winding {
            Some(_) => points.push(Vec2::load(own)),
            None => {
                let count = sizes.edges(bounds.len());
                paths.add(path, bounds, 0..count);
                paths.windings.push(None);
            }
        }
    }
    if sizes.winding.is_some() {
        let flaw = || first_flaw(folding, &input.vertices);
        let search = NearSearch::new(sizes, input.plane, spans).ok_or_else(flaw)?;
        let cuts = search.cuts();
        let mut pieces: Vec<NearEdges<T>> = Vec::new();
        pieces.resize_with(cuts.len().saturating_sub(1), NearEdges::default);
        let work = cuts.windows(2).zip(&mut pieces).collect();
        in_parallel(work, |(cut, piece): (&[usize], &mut NearEdges<T>)| {
            let own = cut[0]..cut[1];
            *piece = search.piece(&points[own.clone()], own);
        });
        let mut first = 0;
        for piece in pieces {
            if piece.unsound {
                return Err(flaw());
            }
            let count = piece.counts.len();
            paths.add_found(first, spans, piece);
            first += count;
        }
    }
    Ok(paths)
}

impl<T: Real> Paths<'_, T> {
    /// Creates a list of some paths from the numbers of their points, and the edges that a search found.
    pub(super) fn of_found<'a>(
        vertices: &'a [T],
        first: usize,
        spans: PathSpans<'_>,
        points: &[T],
        found: NearEdges<T>,
    ) -> Paths<'a, T> {
        let mut paths = Paths {
            vertices,
            element: 2,
            edges: Vec::with_capacity(found.edges.len()),
            starts: Vec::with_capacity(found.counts.len() + 1),
            shared: points.to_vec(),
            windings: Vec::with_capacity(found.counts.len()),
        };
        paths.starts.push(0);
        paths.add_found(first, spans, found);
        paths
    }
    /// Adds the edges that a search found of paths from the one called `first` on.
    fn add_found(&mut self, first: usize, spans: PathSpans<'_>, found: NearEdges<T>) {
        let mut rest = found.edges.iter().map(|&k| k as usize);
        for (k, (count, winding)) in found.counts.into_iter().enumerate() {
            let path = self.windings.len();
            self.add(path, spans.of(first + k), rest.by_ref().take(count));
            self.windings.push(winding);
        }
    }
    /// Adds edges of the next path, whose vertices lie between two bounds.
    fn add(&mut self, path: usize, bounds: Range<usize>, edges: impl Iterator<Item = usize>) {
        for k in edges {
            let (from, to) = (bounds.start + k, bounds.start + k + 1);
            let to = if to < bounds.end { to } else { bounds.start };
            self.edges.push((path as u32, from as u32, to as u32));
        }
        self.starts.push(self.edges.len());
    }
    /// Writes the numbers of both ends of some edges; a vertex has `N` numbers, or any number for `N = 0`.
    fn ends<const N: usize>(&self, edges: Range<usize>, rows: &mut [T]) {
        let n = if N == 0 { self.element } else { N };
        for (edge, row) in self.edges[edges].iter().zip(rows.chunks_exact_mut(2 * n)) {
            let (from, to) = row.split_at_mut(n);
            from.copy_from_slice(&self.vertices[edge.1 as usize * n..][..n]);
            to.copy_from_slice(&self.vertices[edge.2 as usize * n..][..n]);
        }
    }
    /// Returns the arguments of the body, edge by edge, as columns.
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
                // Points have a loop of a constant length.
                match n {
                    2 => self.ends::<2>(edges, rows),
                    3 => self.ends::<3>(edges, rows),
                    _ => self.ends::<0>(edges, rows),
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

/// Returns the states of the listed edges of a path.
pub(super) fn told<'a, T>(
    sizes: &Sizes,
    paths: &Paths<'_, T>,
    states: &'a [T],
    path: usize,
) -> &'a [T] {
    &states[paths.starts[path] * sizes.state..paths.starts[path + 1] * sizes.state]
}

/// Returns the first number of a vertex that is not finite.
pub(super) fn first_flaw<T: Real>(folding: &Folding<T>, vertices: &[T]) -> Error {
    let at = vertices.iter().position(|x| !x.finite()).unwrap_or(0);
    let element = folding.sizes.element.max(1);
    Error::Invalid {
        argument: Argument::Vertices,
        item: at / element,
        flaw: Flaw::NotFinite((folding.field)(at % element)),
    }
}
