//! The origins of a vertex of the result, from the edges before and after it.
use super::grid::Grid;
use super::{Origin, OverlayTrace, VertexId};
use i_overlay::i_float::int::point::IntPoint;

/// A piece of the border of the result.
pub(super) struct Border {
    /// The numbers of the edges that it lies on, in ascending order.
    pub edges: Vec<usize>,
    /// Its end.
    pub end: IntPoint<i64>,
}

/// The kinds of meetings of two edges.
enum EdgeMeeting {
    /// In a vertex of one ring, or in two successive ones that coincide.
    Joined([VertexId; 2]),
    /// They cross.
    Across(Origin),
    /// They are in line with each other.
    InLine,
}

/// Returns the kind of meeting of the edges before and after a vertex of the border.
fn meeting(grid: &Grid, before: usize, after: usize, at: IntPoint<i64>) -> EdgeMeeting {
    let (first, second) = (&grid.edges[before], &grid.edges[after]);
    let own = (first.vertex_at(at), second.vertex_at(at));
    if let (Some(u), Some(v)) = own
        && before != after
        && grid.is_joined(u, v)
    {
        return EdgeMeeting::Joined([u, v]);
    }
    let (u, v) = (first.along, second.along);
    // If both end here, the crossing of edges that rounding makes parallel to a thousandth of a right angle's digits
    // could be anywhere; the vertices of both edges are then taken.
    let slight = if own.0.is_some() && own.1.is_some() {
        1e-13
    } else {
        0.0
    };
    let cross = u.perp_dot(v).abs();
    if before == after || cross <= slight * u.length() * v.length() {
        return EdgeMeeting::InLine;
    }
    // Both orders give one origin, so that equal origins compare equal.
    let (p, q) = (first.id.min(second.id), first.id.max(second.id));
    EdgeMeeting::Across(Origin::Cross(p, q))
}

/// Adds the vertex between two pieces of the border: two vertices where they are in line, or where an
/// input has two there.
pub(super) fn corner(grid: &Grid, before: &Border, after: &Border, trace: &mut OverlayTrace) {
    let [first, second] = origins(grid, before, after);
    push(trace, &first);
    if second != first {
        push(trace, &second);
    }
}

/// Returns the origins of the end of a piece of the border and of the start of the next one, which coincide.
///
/// The ends of a piece on several edges move with the mean of these.
pub(super) fn origins(grid: &Grid, before: &Border, after: &Border) -> [Vec<Origin>; 2] {
    let at = before.end;
    joined(grid, before, after)
        .or_else(|| across(grid, before, after))
        .unwrap_or_else(|| {
            [before, after].map(|piece| {
                let along = |&k: &usize| in_line(grid, k, before, after, at);
                piece.edges.iter().map(along).collect()
            })
        })
}

fn push(trace: &mut OverlayTrace, origins: &[Origin]) {
    if !origins.is_empty() {
        trace.origins.extend(origins);
        trace.vertices.push(trace.origins.len());
    }
}

/// Returns the vertices at which every edge before continues in one after.
fn joined(grid: &Grid, before: &Border, after: &Border) -> Option<[Vec<Origin>; 2]> {
    if before.edges.len() != after.edges.len() {
        return None;
    }
    let mut found = [Vec::new(), Vec::new()];
    let mut taken = Vec::new();
    for &i in &before.edges {
        let mut next = after.edges.iter().filter(|j| !taken.contains(*j));
        let (j, pair) = next.find_map(|&j| match meeting(grid, i, j, before.end) {
            EdgeMeeting::Joined(pair) => Some((j, pair)),
            _ => None,
        })?;
        taken.push(j);
        found[0].push(Origin::Vertex(pair[0]));
        found[1].push(Origin::Vertex(pair[1]));
    }
    Some(found)
}

/// Returns the points at which all edges before cross all after, or are joined to them.
fn across(grid: &Grid, before: &Border, after: &Border) -> Option<[Vec<Origin>; 2]> {
    let mut found = [Vec::new(), Vec::new()];
    for &i in &before.edges {
        for &j in &after.edges {
            let pair = match meeting(grid, i, j, before.end) {
                EdgeMeeting::Joined(pair) => pair.map(Origin::Vertex),
                EdgeMeeting::Across(origin) => [origin; 2],
                EdgeMeeting::InLine => return None,
            };
            found[0].push(pair[0]);
            found[1].push(pair[1]);
        }
    }
    Some(found)
}

/// Returns the point on one of several collinear edges at which another one begins or ends.
fn in_line(grid: &Grid, edge: usize, before: &Border, after: &Border, at: IntPoint<i64>) -> Origin {
    let here = &grid.edges[edge];
    if let Some(vertex) = here.vertex_at(at) {
        return Origin::Vertex(vertex);
    }
    let all = || before.edges.iter().chain(&after.edges);
    if let Some(of) = all().find_map(|&k| grid.edges[k].vertex_at(at)) {
        return Origin::Foot { of, on: here.id };
    }
    // Rounded to the grid they were in line, though none ends here: where they cross.
    match all().find(|&&k| k != edge) {
        Some(&other) => {
            let other = grid.edges[other].id;
            Origin::Cross(here.id.min(other), here.id.max(other))
        }
        None => Origin::Vertex(here.vertex(true)),
    }
}
