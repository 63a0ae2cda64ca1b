//! A search for the edges of paths that results need: those that can be nearest to a point, or those whose passing of it is
//! uncertain.
use crate::kernels::call::folding::Sizes;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, TILE, tiles};
use crate::kernels::cpu::nearest::{Edges, ReliableLimits};
use crate::kernels::cpu::ragged::cuts;
use crate::kernels::cpu::winding::SlabLanes;
use crate::kernels::machine::PathSpans;
use crate::kernels::row::item::rows::numbers;
use crate::{Real, Vec2};
use std::ops::Range;

/// The edges of some paths that results need, path after path.
#[derive(Default)]
pub struct NearEdges<T> {
    pub(super) edges: Vec<u32>,
    /// The number of edges of every path, and its winding number; `None` where all edges count.
    pub(super) counts: Vec<(usize, Option<T>)>,
    /// `true` if a vertex was not finite.
    pub(super) unsound: bool,
}

/// The number of vertices in a piece of work.
const PIECE: usize = 1 << 14;
/// The number of points from which the edges of a shared ring are worth sorting.
const MANY: usize = 16;

/// A search among paths, each with a point of its own.
pub(super) struct NearSearch<'a, T> {
    vertices: &'a [Vec2<T>],
    spans: PathSpans<'a>,
    closed: bool,
    is_winding: bool,
    limits: ReliableLimits<T>,
    /// The edges of a path that all points share, in lanes.
    shared: Option<Edges<T>>,
    /// Those of a ring for winding numbers, in slabs.
    slabs: Option<SlabLanes<T>>,
}

impl<'a, T: Real> NearSearch<'a, T> {
    /// Prepares a search; `None` if a vertex of a shared path is not finite.
    pub(super) fn new(
        sizes: &Sizes,
        vertices: &'a [Vec2<T>],
        spans: PathSpans<'a>,
    ) -> Option<Self> {
        let mut search = NearSearch {
            vertices,
            spans,
            closed: sizes.closed,
            is_winding: sizes.is_winding,
            limits: ReliableLimits::new(),
            shared: None,
            slabs: None,
        };
        if let PathSpans::Shared(paths, _) = spans {
            if !(kernels_in::<T>().all_finite)(&numbers(vertices)) {
                return None;
            }
            if !search.is_winding {
                let mut edges = Edges::default();
                edges.set(vertices, search.closed);
                search.shared = Some(edges);
            } else if paths >= MANY {
                search.slabs = Some(SlabLanes::of(vertices));
            }
        }
        Some(search)
    }
    /// Returns the cuts of the paths into pieces of work.
    pub(super) fn cuts(&self) -> Vec<usize> {
        match self.spans {
            PathSpans::Ragged(offsets) => cuts(offsets),
            PathSpans::Shared(paths, length) => {
                let most = if self.is_winding { PIECE / MANY } else { PIECE };
                let step = PIECE / length.clamp(1, most);
                (0..paths).step_by(step).chain([paths]).collect()
            }
        }
    }
    /// Finds the edges of some paths, for a point each.
    pub(super) fn piece(&self, points: &[Vec2<T>], paths: Range<usize>) -> NearEdges<T> {
        let mut found = NearEdges {
            edges: Vec::with_capacity(paths.len()),
            counts: Vec::with_capacity(paths.len()),
            unsound: false,
        };
        match self.is_winding {
            true => self.wind(points, paths, &mut found),
            false => self.sieve(points, paths, &mut found),
        }
        found
    }
    fn sieve(&self, points: &[Vec2<T>], paths: Range<usize>, found: &mut NearEdges<T>) {
        let kernels = kernels_in::<T>();
        let (mut squares, mut picked) = (Vec::new(), Vec::new());
        let mut own = Edges::default();
        for (path, &point) in paths.zip(points) {
            let edges = match &self.shared {
                Some(shared) => shared,
                None => {
                    let vertices = &self.vertices[self.spans.of(path)];
                    found.unsound |= !(kernels.all_finite)(&numbers(vertices));
                    own.set(vertices, self.closed);
                    &own
                }
            };
            squares.resize(tiles(edges.count).max(squares.len()), Lane::default());
            picked.resize((edges.count + TILE).max(picked.len()), 0);
            let near = (kernels.near_edges)(point, edges, self.limits, &mut squares, &mut picked);
            let (count, winding) = match near {
                Some((count, winding)) => (count, Some(winding)),
                None => (edges.count, None),
            };
            match winding {
                Some(_) => found.edges.extend_from_slice(&picked[..count]),
                None => found.edges.extend(0..count as u32),
            }
            found.counts.push((count, winding));
        }
    }
    fn wind(&self, points: &[Vec2<T>], paths: Range<usize>, found: &mut NearEdges<T>) {
        let kernels = kernels_in::<T>();
        for (path, &point) in paths.zip(points) {
            let own = self.spans.of(path);
            let winding = match &self.slabs {
                Some(slabs) => (kernels.winding_of_slabs)(point, slabs, self.limits),
                None => {
                    let ring = numbers(&self.vertices[own.clone()]);
                    found.unsound |= !(kernels.all_finite)(&ring);
                    (kernels.winding_of_ring)(point, &ring, self.limits)
                }
            };
            // All edges decide where it is uncertain.
            let count = if winding.is_some() { 0 } else { own.len() };
            found.edges.extend(0..count as u32);
            found.counts.push((count, winding));
        }
    }
}
