//! Winding numbers of rings around points on all threads, with the edges of those rings alone whose number is uncertain.
use super::near_edges::{NearEdges, PIECE};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::nearest::ReliableLimits;
use crate::kernels::cpu::ragged::cuts;
use crate::kernels::cpu::winding::SlabLanes;
use crate::kernels::cpu::work::in_parallel;
use crate::kernels::machine::PathSpans;
use crate::kernels::row::item::rows::numbers;
use crate::{Real, Vec2};

/// The number of points from which the edges of a shared ring are worth sorting.
const MANY: usize = 16;

/// Returns the winding number of every ring, and its edges where that is uncertain; `None` if a vertex is not finite.
pub fn wound<T: Real>(
    points: &[Vec2<T>],
    vertices: &[Vec2<T>],
    spans: PathSpans<'_>,
) -> Option<Vec<NearEdges<T>>> {
    let (mut slabs, mut cut_at) = (None, Vec::new());
    match spans {
        PathSpans::Ragged(offsets) => cut_at = cuts(offsets),
        PathSpans::Shared(paths, length) => {
            if !(kernels_in::<T>().all_finite)(&numbers(vertices)) {
                return None;
            }
            if paths >= MANY {
                slabs = Some(SlabLanes::of(vertices));
            }
            let step = (PIECE / length.clamp(1, PIECE / MANY)).max(1);
            cut_at.extend((0..paths).step_by(step).chain([paths]));
        }
    }
    let mut pieces: Vec<NearEdges<T>> = Vec::new();
    pieces.resize_with(cut_at.len().saturating_sub(1), NearEdges::default);
    let work = cut_at.windows(2).zip(&mut pieces).collect();
    let (limits, slabs) = (ReliableLimits::new(), &slabs);
    in_parallel(work, |(cut, piece): (&[usize], &mut NearEdges<T>)| {
        for (path, &point) in points.iter().enumerate().take(cut[1]).skip(cut[0]) {
            let own = spans.of(path);
            let found = match slabs {
                Some(slabs) => (kernels_in::<T>().winding_of_slabs)(point, slabs, limits),
                None => {
                    let ring = numbers(&vertices[own.clone()]);
                    piece.unsound |= !(kernels_in::<T>().all_finite)(&ring);
                    (kernels_in::<T>().winding_of_ring)(point, &ring, limits)
                }
            };
            let count = if found.is_some() { 0 } else { own.len() };
            piece.edges.extend(0..count as u32);
            piece.counts.push((count, found));
        }
    });
    let sound = pieces.iter().all(|piece| !piece.unsound);
    sound.then_some(pieces)
}
