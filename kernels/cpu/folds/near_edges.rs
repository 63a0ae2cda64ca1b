//! A search on all threads for the edges of paths that can be nearest to their points.
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, TILE, tiles};
use crate::kernels::cpu::nearest::{Edges, ReliableLimits};
use crate::kernels::cpu::ragged::cuts;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::PathSpans;
use crate::kernels::row::item::rows::numbers;
use crate::{Real, Vec2};

/// The edges of some paths that can be nearest to the point of each path, path after path.
#[derive(Default)]
pub struct NearEdges<T> {
    pub(crate) edges: Vec<u32>,
    /// The number of edges of every path, and its winding number; `None` where all edges count.
    pub(crate) counts: Vec<(usize, Option<T>)>,
    /// `true` if a vertex was not finite.
    pub(super) unsound: bool,
}

/// The number of vertices in a piece of work.
pub(super) const PIECE: usize = 1 << 14;

/// Returns the edges of every path that can be nearest to its point, computed on all threads; `None` if a vertex is not
/// finite.
pub fn sieved<T: Real>(
    points: &[Vec2<T>],
    vertices: &[Vec2<T>],
    spans: PathSpans<'_>,
    closed: bool,
) -> Option<Vec<NearEdges<T>>> {
    let mut one = Edges::default();
    let cuts = match spans {
        PathSpans::Ragged(offsets) => cuts(offsets),
        PathSpans::Shared(paths, length) => {
            if !(kernels_in::<T>().all_finite)(&numbers(vertices)) {
                return None;
            }
            one.set(vertices, closed);
            let step = (PIECE / length.max(1)).max(1);
            (0..paths).step_by(step).chain([paths]).collect()
        }
    };
    let mut pieces: Vec<NearEdges<T>> = Vec::new();
    pieces.resize_with(cuts.len().saturating_sub(1), NearEdges::default);
    let work = cuts.windows(2).zip(&mut pieces).collect();
    let (limits, one) = (ReliableLimits::new(), &one);
    in_parallel(work, |(cut, sieved): (&[usize], &mut NearEdges<T>)| {
        let (mut squares, mut picked) = (Vec::new(), Vec::new());
        let mut own = Edges::default();
        for path in cut[0]..cut[1] {
            let edges = match spans {
                PathSpans::Shared(..) => one,
                PathSpans::Ragged(_) => {
                    let vertices = &vertices[spans.of(path)];
                    sieved.unsound |= !(kernels_in::<T>().all_finite)(&numbers(vertices));
                    own.set(vertices, closed);
                    &own
                }
            };
            squares.resize(tiles(edges.count).max(squares.len()), Lane::default());
            picked.resize((edges.count + TILE).max(picked.len()), 0);
            let near = kernels_in::<T>().near_edges;
            let found = near(points[path], edges, limits, &mut squares, &mut picked);
            match found {
                Some((count, _)) => sieved.edges.extend_from_slice(&picked[..count]),
                None => sieved.edges.extend(0..edges.count as u32),
            }
            let count = found.map_or(edges.count, |found| found.0);
            sieved.counts.push((count, found.map(|found| found.1)));
        }
    });
    let sound = pieces.iter().all(|piece| !piece.unsound);
    sound.then_some(pieces)
}
