//! How far two lines of the plane are from each other: Hausdorff's and Fréchet's distance.
//!
//! Both are those of shapely, GEOS and boost.geometry. [`hausdorff`] is the largest distance of a vertex of one outline
//! from the other outline, borders alone; [`frechet`] is the discrete one, the shortest leash for two walks from vertex to
//! vertex, none of which goes back. A search gives the pair that decides, and a replay computes the distance of that pair
//! in any scalar, so duals pass through and a cotangent has two or three vertices.
//!
//! ```
//! use geograd::Vec2;
//! use geograd::similarity::{Outline, frechet_replay, frechet_search, hausdorff};
//! let road = [(0.0, 0.0), (4.0, 0.0), (8.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
//! let track = [(0.0, 1.0), (4.0, 3.0), (8.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
//! assert_eq!(hausdorff(&Outline::path(&road), &Outline::path(&track)), Some(3.0));
//! let (leash, pair) = frechet_search(&road, &track).expect("both have vertices");
//! assert_eq!((leash, pair), (3.0, [1, 1]));
//! let (_, (_, by_track)) = geograd::gradient(|(a, b)| frechet_replay(&a, &b, pair), (road, track));
//! assert_eq!(by_track.map(|v| v.y), [0.0, 1.0, 0.0]);
//! ```
mod leash;

use crate::distance::distance;
use crate::polygon::{EdgeBoxes, Rings};
use crate::{Scalar, Segment2, Vec2};
use std::borrow::Cow;

/// Vertices, and for each of them the vertex at the end of its edge: an open path, a ring, or the rings of a polygon.
#[derive(Clone, Debug)]
pub struct Outline<'a, S: Scalar> {
    vertices: Cow<'a, [Vec2<S>]>,
    following: Cow<'a, [usize]>,
}

impl<'a, S: Scalar> Outline<'a, S> {
    /// Creates the outline of an open path. Its last vertex has an edge of length zero.
    #[must_use]
    pub fn path(vertices: &'a [Vec2<S>]) -> Self {
        let last = vertices.len().saturating_sub(1);
        Outline {
            vertices: vertices.into(),
            following: (1..=last)
                .chain((!vertices.is_empty()).then_some(last))
                .collect(),
        }
    }
    /// Creates the outline of all rings of a polygon.
    #[must_use]
    pub fn rings(rings: impl Into<Rings<'a, S>>) -> Self {
        let (mut vertices, mut following) = (Vec::new(), Vec::new());
        for ring in rings.into().iter() {
            let first = vertices.len();
            vertices.extend_from_slice(ring);
            following.extend(first + 1..vertices.len());
            following.extend((!ring.is_empty()).then_some(first));
        }
        Outline {
            vertices: vertices.into(),
            following: following.into(),
        }
    }
    /// Creates an outline from vertices and the places of the vertices after them; `None` where one is beyond the vertices
    /// or there is another number of them.
    #[must_use]
    pub fn linked(vertices: &'a [Vec2<S>], following: &'a [usize]) -> Option<Self> {
        let is_known = following.len() == vertices.len()
            && following.iter().all(|&next| next < vertices.len());
        is_known.then_some(Outline {
            vertices: vertices.into(),
            following: following.into(),
        })
    }
    /// Returns the vertices.
    #[must_use]
    pub fn vertices(&self) -> &[Vec2<S>] {
        &self.vertices
    }
    fn edge(&self, vertex: usize) -> [usize; 2] {
        [vertex, self.following[vertex]]
    }
}

/// The vertex of one outline that is farthest from the other one, and the edge there that is nearest to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FarthestVertex {
    /// `true` for a vertex of the second outline and an edge of the first one.
    pub of_second: bool,
    /// The place of the vertex.
    pub vertex: usize,
    /// The places of both ends of the edge.
    pub edge: [usize; 2],
}

/// Returns Hausdorff's distance of two outlines, at least 0, in units of length; `None` where one has no vertices.
///
/// It is the largest distance of a vertex of either from the edges of the other one. That is the distance of the point sets
/// where they are polygons whose edges cross nowhere far from vertices; between vertices, points of an edge may be farther
/// by at most half of its length.
///
/// Kinks: vertices that are equally far, of which the first one counts, those of `a` before those of `b`; edges that are
/// equally near, of which the first one counts; and zero, where the derivative is zero.
///
/// ```
/// use geograd::similarity::{Outline, hausdorff};
/// use geograd::{Aabb2, Vec2};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// assert_eq!(hausdorff(&Outline::rings(&a), &Outline::rings(&b)), Some(2.0_f64.sqrt()));
/// assert_eq!(hausdorff(&Outline::rings(&a), &Outline::path(&[])), None);
/// # let _: [Vec2<f64>; 4] = a;
/// ```
#[must_use]
pub fn hausdorff<S: Scalar<Mask = bool>>(a: &Outline<'_, S>, b: &Outline<'_, S>) -> Option<S> {
    hausdorff_search(a, b).map(|(found, _)| found)
}

/// Returns [`hausdorff`] with the vertex and the edge that decide it.
///
/// Vertices that are nearer than the farthest one so far are left out by their first edge that is, other edges by boxes
/// around them: time grows as the number of vertices where outlines are alike.
#[must_use]
pub fn hausdorff_search<S: Scalar<Mask = bool>>(
    a: &Outline<'_, S>,
    b: &Outline<'_, S>,
) -> Option<(S, FarthestVertex)> {
    if a.vertices.is_empty() || b.vertices.is_empty() {
        return None;
    }
    let mut best: Option<(S, FarthestVertex)> = None;
    for (of_second, own, other) in [(false, a, b), (true, b, a)] {
        let ends = (0..other.vertices.len()).map(|k| other.edge(k).map(|end| other.vertices[end]));
        let boxes = EdgeBoxes::of_edges(ends);
        let few = FewEdges::of(own, other);
        let (mut near, mut room) = (0, Vec::new());
        for (vertex, &point) in own.vertices.iter().enumerate() {
            let floor = best.map_or(-S::one(), |(found, _)| found);
            if few.as_ref().is_some_and(|few| few.is_within(point, floor)) {
                continue;
            }
            if let Some((found, edge)) = boxes.nearest_to(point, near, floor, &mut room) {
                near = edge;
                let edge = other.edge(edge);
                let record = FarthestVertex {
                    of_second,
                    vertex,
                    edge,
                };
                best = Some((found, record));
            }
        }
    }
    best
}

/// So many edges are compared one by one in less time than by boxes.
const FEW: usize = 96;

/// A few edges as plain numbers side by side, for distances up to roundings.
struct FewEdges {
    start: [Vec<f64>; 2],
    along: [Vec<f64>; 2],
    /// The inverse of the squared length; zero for a point.
    inverse: Vec<f64>,
    /// A bound of the roundings of a distance.
    slack: f64,
}

impl FewEdges {
    /// Returns `None` for many edges, and where squares would leave the format.
    fn of<S: Scalar>(points: &Outline<'_, S>, edges: &Outline<'_, S>) -> Option<Self> {
        if edges.vertices.len() > FEW {
            return None;
        }
        let wide = |v: &Vec2<S>| Some([v.x.widened()?, v.y.widened()?]);
        let [mut low, mut high] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for v in edges.vertices.iter().chain(&*points.vertices) {
            let v = wide(v)?;
            low = [0, 1].map(|k| low[k].min(v[k]));
            high = [0, 1].map(|k| high[k].max(v[k]));
        }
        let spread = (high[0] - low[0]).max(high[1] - low[1]);
        if !(1e-100..1e100).contains(&spread) {
            return None;
        }
        let mut made = FewEdges {
            start: [Vec::new(), Vec::new()],
            along: [Vec::new(), Vec::new()],
            inverse: Vec::new(),
            slack: 32.0 * f64::EPSILON.max(S::format().epsilon()) * spread,
        };
        for k in 0..edges.vertices.len() {
            let [from, to] = edges.edge(k).map(|end| wide(&edges.vertices[end]));
            let (from, to) = (from?, to?);
            let along = [to[0] - from[0], to[1] - from[1]];
            for axis in 0..2 {
                made.start[axis].push(from[axis]);
                made.along[axis].push(along[axis]);
            }
            let square = along[0] * along[0] + along[1] * along[1];
            made.inverse
                .push(if square > 0.0 { square.recip() } else { 0.0 });
        }
        Some(made)
    }
    /// Returns `true` if an edge is certainly less than `floor` away from a point.
    fn is_within<S: Scalar>(&self, point: Vec2<S>, floor: S) -> bool {
        let all = (point.x.widened(), point.y.widened(), floor.widened());
        let (Some(x), Some(y), Some(floor)) = all else {
            return false;
        };
        let limit = floor - self.slack;
        if limit <= 0.0 {
            return false;
        }
        let limit = limit * limit;
        let edges = (self.start[0].iter().zip(&self.start[1]))
            .zip(self.along[0].iter().zip(&self.along[1]))
            .zip(&self.inverse);
        let mut least = f64::INFINITY;
        for (((a, b), (u, v)), inverse) in edges {
            let (p, q) = (x - a, y - b);
            let t = (p * u + q * v) * inverse;
            let t = if t > 0.0 { t } else { 0.0 };
            let t = if t < 1.0 { t } else { 1.0 };
            let (p, q) = (p - t * u, q - t * v);
            let square = p * p + q * q;
            least = if square < least { square } else { least };
        }
        least < limit
    }
}

/// Returns the distance of the vertex and the edge of a record, in any scalar: [`hausdorff`] where the record is its own.
///
/// # Panics
///
/// When the record has places beyond the vertices.
#[must_use]
pub fn hausdorff_replay<S: Scalar>(a: &[Vec2<S>], b: &[Vec2<S>], record: FarthestVertex) -> S {
    let (own, other) = if record.of_second { (b, a) } else { (a, b) };
    let [from, to] = record.edge.map(|end| other[end]);
    distance(own[record.vertex], Segment2::new(from, to))
}

/// Returns the discrete Fréchet distance of two paths, at least 0, in units of length; `None` where one has no vertices.
///
/// Two walkers go along the vertices of one path each, one or both a vertex at a time and never back. The distance is that
/// of the shortest leash that lets them reach the ends. Time grows with the product of both numbers of vertices, memory
/// with the second (Eiter and Mannila 1994).
///
/// Kinks: pairs of vertices that are equally far, of which one counts, and zero, where the derivative is zero.
///
/// ```
/// use geograd::{Vec2, similarity::frechet};
/// let there = [0.0, 1.0, 2.0, 3.0].map(|x| Vec2::new(x, 0.0));
/// let mut back = there;
/// back.reverse();
/// assert_eq!(frechet(&there, &there), Some(0.0));
/// assert_eq!(frechet(&there, &back), Some(3.0));
/// ```
#[must_use]
pub fn frechet<S: Scalar<Mask = bool>>(a: &[Vec2<S>], b: &[Vec2<S>]) -> Option<S> {
    frechet_search(a, b).map(|(found, _)| found)
}

/// Returns [`frechet`] with the vertices of both paths that decide it.
#[must_use]
pub fn frechet_search<S: Scalar<Mask = bool>>(
    a: &[Vec2<S>],
    b: &[Vec2<S>],
) -> Option<(S, [usize; 2])> {
    let pair = leash::deciding(a, b)?;
    Some((frechet_replay(a, b, pair), pair))
}

/// Returns the distance of a vertex of each path, in any scalar: [`frechet`] where they are those that decide it.
///
/// # Panics
///
/// When a path has no such vertex.
#[must_use]
pub fn frechet_replay<S: Scalar>(a: &[Vec2<S>], b: &[Vec2<S>], [i, j]: [usize; 2]) -> S {
    a[i].distance(b[j])
}
