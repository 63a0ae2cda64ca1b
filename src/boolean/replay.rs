//! The result of a boolean operation from its inputs and its record.
use super::records::ValidOrigin;
use super::{EdgeId, IouTrace, Origin, OverlayTrace, ValidTrace, VertexId};
use crate::clipping::crossing::crossing;
use crate::overlap::ratio_of_first;
use crate::polygon::{Polygon, Rings};
use crate::reference::Reference;
use crate::{Scalar, Vec2, ring};

/// Returns a vertex of an input.
#[inline]
pub(crate) fn input_vertex<S: Scalar>(inputs: [Rings<'_, S>; 2], id: VertexId) -> Vec2<S> {
    inputs[id.owner as usize].ring(id.ring)[id.vertex]
}

/// Returns both ends of an edge of an input, with the number of the second one.
#[inline]
pub(crate) fn input_edge<S: Scalar>(
    inputs: [Rings<'_, S>; 2],
    id: EdgeId,
) -> ([Vec2<S>; 2], usize) {
    let ring = inputs[id.owner as usize].ring(id.ring);
    let next = if id.edge + 1 < ring.len() {
        id.edge + 1
    } else {
        0
    };
    ([ring[id.edge], ring[next]], next)
}

/// Returns the point of a line nearest to a point: the origin of the local frame, the direction of the line, the
/// fraction along it, and the square of its length (one for a point).
#[inline]
pub(crate) fn foot<S: Scalar>(point: Vec2<S>, line: [Vec2<S>; 2]) -> (Reference<S>, Vec2<S>, S, S) {
    let seen = Reference::of_ring(&line);
    let [start, end] = line.map(|v| seen.place(v));
    let along = end - start;
    let square = along.length_squared();
    let square = S::select(square.at_most(S::zero()), S::one(), square);
    let share = (seen.place(point) - start).dot(along).over(square);
    (seen, along, share, square)
}

fn place<S: Scalar>(inputs: [Rings<'_, S>; 2], origin: Origin) -> Vec2<S> {
    match origin {
        Origin::Vertex(id) => input_vertex(inputs, id).canonical(),
        Origin::Cross(first, second) => {
            crossing(input_edge(inputs, first).0, input_edge(inputs, second).0)
        }
        Origin::Foot { of, on } => {
            let line = input_edge(inputs, on).0;
            let (seen, along, share, _) = foot(input_vertex(inputs, of), line);
            seen.outer_place(seen.place(line[0]) + along * share)
                .canonical()
        }
    }
}

/// Returns the mean of some points.
pub(super) fn mean<S: Scalar>(inputs: [Rings<'_, S>; 2], all: &[Origin]) -> Vec2<S> {
    match all {
        [only] => place(inputs, *only),
        _ => {
            let share = S::lit(1.0 / all.len() as f64);
            all.iter()
                .fold(Vec2::zero(), |sum, &one| sum + place(inputs, one) * share)
        }
    }
}

/// Returns the result of a boolean operation, from both inputs and the record of
/// `overlay_search`: parts counter-clockwise, holes clockwise. Derivatives of a crossing are those of
/// the two edges that cross; its own are unbounded as these become parallel, though those of areas are
/// not.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of other inputs.
#[must_use]
pub fn overlay_replay<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &OverlayTrace,
) -> Polygon<S> {
    let inputs = [a.into(), b.into()];
    let vertices = trace.origins().map(|all| mean(inputs, all));
    let mut vertices = vertices.collect::<Vec<_>>().into_iter();
    let mut made = Polygon::new();
    let mut start = 0;
    for &end in &trace.rings {
        made.push(vertices.by_ref().take(end - start));
        start = end;
    }
    made
}

/// Returns the result of a boolean operation as polygons that are valid by the OGC's rules, one per part, from both
/// inputs and the record of `valid_search`: the outer ring first, counter-clockwise, then the holes, clockwise. Values
/// are those of the record, on its grid; derivatives are those of the origin of each vertex.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of other inputs.
#[must_use]
pub fn valid_replay<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &ValidTrace,
) -> Vec<Polygon<S>> {
    let inputs = [a.into(), b.into()];
    let vertex = |k: usize| {
        let near = match &trace.made[k] {
            &ValidOrigin::One(origin) => place(inputs, origin),
            ValidOrigin::Of(all) => mean(inputs, all),
            &ValidOrigin::Along(edge, share) => {
                let [start, end] = input_edge(inputs, edge).0;
                start * S::lit(1.0 - share) + end * S::lit(share)
            }
        };
        let [x, y] = trace.places[k].map(S::Primal::lit);
        Vec2::new(near.x.with_primal(x), near.y.with_primal(y))
    };
    let (mut ring, mut start) = (0, 0);
    let part = |&rings: &usize| {
        let mut made = Polygon::new();
        while ring < rings {
            made.push((start..trace.rings[ring]).map(vertex));
            start = trace.rings[ring];
            ring += 1;
        }
        made
    };
    trace.parts.iter().map(part).collect()
}

/// Returns the intersection over union, in `[0, 1]`, from both inputs and the record of `iou_search`; zero with
/// derivative zero where the union is empty.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of other inputs.
#[must_use]
pub fn iou_replay<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &IouTrace,
) -> S {
    let (a, b) = (a.into(), b.into());
    // In a unit in which the area of the union is about one.
    let seen = a
        .bounds()
        .into_iter()
        .chain(b.bounds())
        .reduce(|a, b| a.join(b));
    let Some(seen) = seen.map(Reference::of_bounds) else {
        return S::zero();
    };
    let area = |trace| {
        let shape = overlay_replay(a, b, trace);
        let mut sum = S::zero();
        for part in shape.rings().iter() {
            let local: Vec<_> = part.iter().map(|&v| seen.place(v)).collect();
            sum += ring::signed_area(&local);
        }
        sum
    };
    let (inter, union) = (area(&trace.intersection), area(&trace.union));
    let ratio = ratio_of_first(inter, union);
    S::select(
        ratio.above(S::one()),
        ratio.with_primal(S::Primal::one()),
        ratio,
    )
    .canonical()
}
