//! The edges of polygons in horizontal slabs, by which a point finds those that its horizontal line can meet.
use super::{Fill, Rings};
use crate::contain::{Location, locate_by};
use crate::shape::edges;
use crate::{Real, Vec2};

/// Slabs of equal height, each with the edges that reach it.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeightSlabs {
    low: f64,
    /// The number of slabs in a unit of height.
    scale: f64,
    /// The place of the first edge of every slab in `edges`, and the end of the last slab.
    pub(crate) starts: Vec<usize>,
    /// The edges of one slab after another, ascending in each.
    pub(crate) edges: Vec<u32>,
}

impl HeightSlabs {
    /// Sorts edges by the heights of their ends. A slab has at least about `few` of them. There are about five times as
    /// many entries as edges at most: tall edges are in many slabs.
    pub(crate) fn new(heights: impl Iterator<Item = [f64; 2]> + Clone, few: usize) -> Self {
        let sorted = |[a, b]: [f64; 2]| if a <= b { [a, b] } else { [b, a] };
        let heights = heights.map(sorted);
        let none = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
        let (low, high, tall, count) =
            heights
                .clone()
                .fold(none, |(low, high, tall, count), [bottom, top]| {
                    (
                        low.min(bottom),
                        high.max(top),
                        tall + (top - bottom),
                        count + 1.0,
                    )
                });
        // How many slabs an edge reaches beside its first one, as a share of all.
        let share = tall / (high - low);
        let slabs = (count / few.max(1) as f64).min(4.0 * count / share).floor();
        let scale = slabs / (high - low);
        let is_sorted = slabs > 1.0 && scale.is_finite() && scale > 0.0;
        let (slabs, scale) = match is_sorted {
            true => (slabs as usize, scale),
            false => (1, 0.0),
        };
        let mut own = HeightSlabs {
            low,
            scale,
            starts: vec![0; slabs + 1],
            edges: Vec::new(),
        };
        for ends in heights.clone() {
            let [from, to] = ends.map(|height| own.slab(height));
            for count in &mut own.starts[from + 1..=to + 1] {
                *count += 1;
            }
        }
        let mut sum = 0;
        for start in &mut own.starts {
            sum += *start;
            *start = sum;
        }
        let mut next = own.starts.clone();
        own.edges = vec![0; own.starts[slabs]];
        for (edge, ends) in heights.enumerate() {
            let [from, to] = ends.map(|height| own.slab(height));
            for place in &mut next[from..=to] {
                own.edges[*place] = edge as u32;
                *place += 1;
            }
        }
        own
    }
    /// Returns the slab of a height, which never decreases with it: an edge reaches the slabs between those of its ends.
    #[inline]
    pub(crate) fn slab(&self, height: f64) -> usize {
        // A cast of a negative number gives zero.
        (((height - self.low) * self.scale) as usize).min(self.starts.len().saturating_sub(2))
    }
}

/// The edges of a polygon in horizontal slabs, for the location of many points: each is compared with the edges of its
/// slab alone.
///
/// ```
/// use geograd::polygon::{Fill, Slabs};
/// use geograd::{Aabb2, Rings, Vec2};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let rings = [outer.as_slice(), &hole];
/// let slabs = Slabs::of(Rings::from(&rings[..]));
/// assert!(slabs.contains(Vec2::new(3.0, 1.5), Fill::EvenOdd));
/// assert!(!slabs.contains(Vec2::new(1.5, 1.5), Fill::EvenOdd));
/// ```
#[derive(Clone, Debug)]
pub struct Slabs<T> {
    slabs: HeightSlabs,
    /// The edges of one slab after another.
    edges: Vec<[Vec2<T>; 2]>,
}

/// The number of edges for which a slab is worth its memory.
const FEW: usize = 4;

impl<T: Real> Slabs<T> {
    /// Sorts the edges of a polygon into slabs. It takes time in proportion to their number.
    #[must_use]
    pub fn of(rings: Rings<'_, T>) -> Self {
        let all: Vec<[Vec2<T>; 2]> = rings.iter().flat_map(edges).collect();
        let heights: Vec<[f64; 2]> = all
            .iter()
            .map(|edge| edge.map(|end| end.y.widen()))
            .collect();
        let slabs = HeightSlabs::new(heights.into_iter(), FEW);
        let edges = slabs.edges.iter().map(|&edge| all[edge as usize]).collect();
        Slabs { slabs, edges }
    }
    /// Returns the location of a point, as [`Rings::locate`]: decided exactly.
    #[must_use]
    pub fn locate(&self, point: Vec2<T>) -> Location {
        let slab = self.slabs.slab(point.y.widen());
        let own = self.slabs.starts[slab]..self.slabs.starts[slab + 1];
        locate_by(self.edges[own].iter().copied(), point)
    }
    /// Returns `true` if a point is in the polygon by a fill rule, as [`Rings::contains`]: decided exactly.
    #[must_use]
    pub fn contains(&self, point: Vec2<T>, fill: Fill) -> bool {
        self.locate(point).is_inside(fill)
    }
}
