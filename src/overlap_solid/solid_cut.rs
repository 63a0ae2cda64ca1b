//! A body that planes cut: its surface stays closed whatever the signs of heights are, so that rounding cannot tear it.
use super::cutting_planes::{Plane, between};
use crate::Vec3;
use std::collections::HashMap;

/// A point between two others, in a plane; all by their numbers.
pub(super) type CutPoint = [usize; 3];

/// The points of cut bodies: corners, then points of edges.
#[derive(Clone, Debug)]
pub(super) struct CutPoints {
    /// The places.
    pub places: Vec<Vec3<f64>>,
    /// The origins of the points behind the corners.
    pub origins: Vec<CutPoint>,
}

impl CutPoints {
    /// Returns the corners of a body.
    pub fn of(corners: &[Vec3<f64>]) -> Self {
        CutPoints {
            places: corners.to_vec(),
            origins: Vec::new(),
        }
    }
    /// Adds the point in a plane between two points, of which each is on another side; one of them that is within the
    /// limit of the plane, so that no rounding moves it along an edge in the plane. Returns its number.
    fn add(&mut self, ends: [usize; 2], heights: [f64; 2], plane: usize, limit: f64) -> usize {
        let near = (0..2).find(|&k| heights[k].abs() <= limit);
        let (ends, heights) = match near {
            Some(k) => ([ends[k]; 2], [heights[k]; 2]),
            None => (ends, heights),
        };
        self.places
            .push(between(ends.map(|k| self.places[k]), heights));
        self.origins.push([ends[0], ends[1], plane]);
        self.places.len() - 1
    }
}

/// A face of a cut body.
#[derive(Clone, Debug)]
pub(super) struct CutFace {
    /// The triangle of the body, or the plane that cut it.
    pub owner: FaceOwner,
    /// Its corners, counter-clockwise seen from outside.
    pub ring: Vec<usize>,
}

/// The surface to which a face belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceOwner {
    /// A triangle of the body.
    Triangle(usize),
    /// A plane.
    Plane(usize),
}

/// Cuts away all that is higher over a plane than `limit`. Returns `true` where some point is within `limit` of it.
pub(super) fn cut(
    points: &mut CutPoints,
    faces: &mut Vec<CutFace>,
    (number, plane): (usize, &Plane<f64>),
    limit: f64,
) -> bool {
    let limit = limit * plane.normal.length();
    let mut heights: HashMap<usize, f64> = HashMap::new();
    for &k in faces.iter().flat_map(|face| &face.ring) {
        heights
            .entry(k)
            .or_insert_with(|| plane.height(points.places[k]));
    }
    let touched = heights.values().any(|height| height.abs() <= limit.abs());
    let is_out = |k: usize| heights[&k] > limit;
    if !heights.values().any(|&height| height > limit) {
        return touched;
    }
    let mut crossings: HashMap<[usize; 2], usize> = HashMap::new();
    // The next corner of the new faces.
    let mut after: HashMap<usize, usize> = HashMap::new();
    for face in faces.iter_mut() {
        let ring = std::mem::take(&mut face.ring);
        let mut left = None;
        let mut entered = None;
        for (k, &from) in ring.iter().enumerate() {
            let to = ring[(k + 1) % ring.len()];
            if !is_out(from) {
                face.ring.push(from);
            }
            if is_out(from) == is_out(to) {
                continue;
            }
            let ends = [from.min(to), from.max(to)];
            let at = *crossings.entry(ends).or_insert_with(|| {
                points.add(ends, ends.map(|end| heights[&end]), number, limit.abs())
            });
            face.ring.push(at);
            if is_out(to) {
                left = Some(at);
            } else {
                match left.take() {
                    Some(from) => {
                        after.insert(at, from);
                    }
                    // The ring began outside: its last way out belongs to this way in.
                    None => entered = Some(at),
                }
            }
        }
        if let (Some(from), Some(at)) = (left, entered) {
            after.insert(at, from);
        }
    }
    faces.retain(|face| !face.ring.is_empty());
    let mut starts: Vec<usize> = after.keys().copied().collect();
    starts.sort_unstable();
    for start in starts {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(next) = after.remove(&at) {
            ring.push(at);
            at = next;
        }
        if ring.len() > 2 {
            faces.push(CutFace {
                owner: FaceOwner::Plane(number),
                ring,
            });
        }
    }
    touched
}

/// Returns the part of a convex ring that is not over a plane.
pub(super) fn cut_ring(
    points: &mut CutPoints,
    ring: &[usize],
    (number, plane): (usize, &Plane<f64>),
) -> Vec<usize> {
    let height = |points: &CutPoints, k: usize| plane.height(points.places[k]);
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (k, &from) in ring.iter().enumerate() {
        let to = ring[(k + 1) % ring.len()];
        let (here, there) = (height(points, from), height(points, to));
        if here <= 0.0 {
            kept.push(from);
        }
        if (here > 0.0) != (there > 0.0) {
            let ends = match from < to {
                true => ([from, to], [here, there]),
                false => ([to, from], [there, here]),
            };
            kept.push(points.add(ends.0, ends.1, number, 0.0));
        }
    }
    kept
}
