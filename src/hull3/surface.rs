//! The surface of a hull: its facets, each a convex polygon, and its edges.
use super::orientation::{on_line, seen, side, turn_along};
use super::start::{Start, by_coordinates, least, start};
use super::triangles::{Triangle, triangles};
use crate::Vec3;
use crate::arrays::sort_few;
use crate::hull::hull_search;
use crate::predicate::Turn;

/// The surface of the hull of some points, by their numbers. A flat hull has two facets, a segment one edge and none.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    /// The number of independent directions, 0 to 3.
    pub dimension: usize,
    /// The corners of the hull, in increasing order.
    pub corners: Vec<usize>,
    /// The corners of all facets, counter-clockwise seen from outside, one facet after another.
    rings: Vec<usize>,
    /// The end of each facet in `rings`.
    ends: Vec<usize>,
}

/// An edge of a hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HullEdge {
    /// Its ends.
    pub ends: [usize; 2],
    /// The next corners of both facets. The edge is the highest along a direction orthogonal to it if neither is
    /// higher. For a segment the ends.
    pub beside: [usize; 2],
}

impl Surface {
    /// Returns the surface of the hull of some points, decided exactly where no product over- or underflows.
    pub fn of(points: &[Vec3<f64>]) -> Self {
        match start(points) {
            Start::Point => Surface {
                corners: least(points).into_iter().collect(),
                ..Surface::default()
            },
            Start::Line([low, mut high]) => {
                for k in 0..points.len() {
                    if by_coordinates(points[k], points[high]).is_gt() {
                        high = k;
                    }
                }
                Surface {
                    dimension: 1,
                    corners: vec![low.min(high), low.max(high)],
                    ..Surface::default()
                }
            }
            Start::Plane(plane) => Self::flat(points, plane),
            Start::Solid(corners) => Self::solid(points, &triangles(points, corners)),
        }
    }
    /// Returns the facets, each its corners counter-clockwise seen from outside.
    pub fn facets(&self) -> impl Iterator<Item = &[usize]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.rings[start..end])
    }
    /// Adds a facet.
    pub fn add_ring(&mut self, ring: impl Iterator<Item = usize>) {
        self.rings.extend(ring);
        self.ends.push(self.rings.len());
    }
    /// Returns the edges, each once.
    pub fn edges(&self) -> Vec<HullEdge> {
        if let (1, &[from, to]) = (self.dimension, &self.corners[..]) {
            return vec![HullEdge {
                ends: [from, to],
                beside: [from, to],
            }];
        }
        let mut sides: Vec<([usize; 2], bool, usize)> = Vec::with_capacity(self.rings.len());
        for ring in self.facets() {
            let n = ring.len();
            for k in 0..n {
                let (from, to, next) = (ring[k], ring[(k + 1) % n], ring[(k + 2) % n]);
                sides.push(([from.min(to), from.max(to)], from > to, next));
            }
        }
        sides.sort_unstable();
        let pairs = sides.chunks_exact(2);
        let edge = |pair: &[([usize; 2], bool, usize)]| HullEdge {
            ends: pair[0].0,
            beside: [pair[0].2, pair[1].2],
        };
        pairs.map(edge).collect()
    }
    /// Returns the surface of points in the plane of three of them.
    fn flat(points: &[Vec3<f64>], [a, b, c]: [usize; 3]) -> Self {
        let plane = [points[a], points[b], points[c]];
        let Vec3 { x, y, z } = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
        let sizes = [x.abs(), y.abs(), z.abs()];
        let mut axes = [0, 1, 2];
        sort_few(&mut axes, |&i, &j| sizes[j].total_cmp(&sizes[i]).is_lt());
        let clear = |&axis: &usize| turn_along(axis, plane) != Turn::Straight;
        let axis = axes.into_iter().find(clear).unwrap_or(axes[0]);
        let seen: Vec<_> = points.iter().map(|&point| seen(axis, point)).collect();
        let ring = hull_search(&seen);
        let mut corners = ring.clone();
        corners.sort_unstable();
        let back = ring.iter().rev();
        Surface {
            dimension: 2,
            corners,
            ends: vec![ring.len(), 2 * ring.len()],
            rings: ring.iter().chain(back).copied().collect(),
        }
    }
    /// Returns the surface of a solid from its triangles: those in one plane are one facet, and points on the line
    /// through their neighbours are no corners.
    fn solid(points: &[Vec3<f64>], all: &[Triangle]) -> Self {
        let mut surface = Surface {
            dimension: 3,
            ..Surface::default()
        };
        let opposite = |triangle: &Triangle, edge: usize| triangle.corners[(edge + 2) % 3];
        let joined = |here: usize, there: usize| {
            let (triangle, other) = (&all[here], &all[there]);
            let edge = other.beside.iter().position(|&k| k == here).unwrap_or(0);
            let plane = triangle.corners.map(|k| points[k]);
            side(plane, points[opposite(other, edge)]) == 0.0
        };
        // The first triangle of the facet that each one belongs to.
        let mut owner = vec![usize::MAX; all.len()];
        let mut group: Vec<usize> = Vec::new();
        let mut border: Vec<[usize; 2]> = Vec::new();
        for first in 0..all.len() {
            if !all[first].kept || owner[first] != usize::MAX {
                continue;
            }
            owner[first] = first;
            group.clear();
            group.push(first);
            border.clear();
            let mut read = 0;
            while read < group.len() {
                let here = group[read];
                for (k, &there) in all[here].beside.iter().enumerate() {
                    if owner[there] == first {
                        continue;
                    }
                    if joined(here, there) {
                        owner[there] = first;
                        group.push(there);
                    } else {
                        let corners = all[here].corners;
                        border.push([corners[k], corners[(k + 1) % 3]]);
                    }
                }
                read += 1;
            }
            surface.add(points, &border);
        }
        surface.corners = surface.rings.clone();
        surface.corners.sort_unstable();
        surface.corners.dedup();
        surface
    }
    /// Adds the facet with a border of directed edges.
    fn add(&mut self, points: &[Vec3<f64>], border: &[[usize; 2]]) {
        let start = self.rings.len();
        let Some(&[first, mut next]) = border.first() else {
            return;
        };
        let mut ring = vec![first];
        while next != first && ring.len() < border.len() {
            ring.push(next);
            let after = border.iter().find(|&&[from, _]| from == next);
            next = after.map_or(first, |&[_, to]| to);
        }
        let n = ring.len();
        for k in 0..n {
            let around = [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
            if n == 3 || !on_line(around.map(|k| points[k])) {
                self.rings.push(ring[k]);
            }
        }
        // From the least corner on, so that the order of the points decides alone.
        let facet = &mut self.rings[start..];
        let least = (0..facet.len()).min_by_key(|&k| facet[k]).unwrap_or(0);
        facet.rotate_left(least);
        self.ends.push(self.rings.len());
    }
}
