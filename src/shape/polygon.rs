//! Convex polygons that store their vertices inline, and the edges of any ring.
use super::convexity::{
    between, check_capacity, check_convex, check_finite, corner_of, runs_clockwise,
};
use crate::arrays::Each;
use crate::error::{Flaw, Validate, VertexFault};
use crate::predicate::{Turn, same, turn};
use crate::{Aabb2, Obb2, Scalar, Shape, Vec2};

/// A convex polygon of up to `N` vertices, counter-clockwise, without heap memory.
///
/// The first `count` vertices are the polygon; what lies behind them has no meaning and takes no part
/// in anything. Valid when finite, of at least three vertices, and every vertex a strict turn to the
/// left, once around, all of it decided exactly: see [`try_new`](ConvexPolygon::try_new).
///
/// Polygons made from boxes of zero size, or by rounding, can have repeated or collinear vertices.
/// Every operation accepts those; they change no area, length or distance.
///
/// ```
/// use geograd::{ConvexPolygon, Vec2};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// let polygon: ConvexPolygon<f64, 8> = ConvexPolygon::try_new(&triangle).unwrap();
/// assert_eq!(polygon.as_slice(), triangle);
/// ```
#[derive(Clone, Copy, Debug, Shape)]
#[repr(C)]
#[shape(except(Validate, Sample, Arbitrary))]
pub struct ConvexPolygon<S, const N: usize> {
    /// The vertices, counter-clockwise; the first `count` of them matter.
    pub vertices: [Vec2<S>; N],
    /// The number of vertices, at most `N`.
    #[shape(code)]
    pub count: usize,
}

impl<S: PartialEq, const N: usize> PartialEq for ConvexPolygon<S, N> {
    /// Returns `true` if both have equal vertices in one order.
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<S, const N: usize> ConvexPolygon<S, N> {
    /// Returns the vertices, counter-clockwise.
    #[must_use]
    #[inline]
    pub fn as_slice(&self) -> &[Vec2<S>] {
        &self.vertices[..self.count.min(N)]
    }
}

impl<S: Scalar, const N: usize> ConvexPolygon<S, N> {
    /// Creates a polygon from the first `N` of some vertices, unchecked.
    #[must_use]
    #[inline]
    pub fn from_vertices(vertices: &[Vec2<S>]) -> Self {
        let at = |k: usize| vertices.get(k).copied().unwrap_or(Vec2::zero());
        ConvexPolygon {
            vertices: std::array::from_fn(at),
            count: vertices.len().min(N),
        }
    }
    /// Creates a polygon from vertices in counter-clockwise order, each a strict turn to the left.
    ///
    /// # Errors
    ///
    /// [`Flaw::Vertex`] with the first vertex at fault: not finite, beyond the capacity, missing (fewer
    /// than three), repeated, collinear with its neighbours, turning clockwise, or starting a second
    /// round. [`cleaned`](ConvexPolygon::cleaned) mends what can be mended.
    pub fn try_new(vertices: &[Vec2<S>]) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        check_capacity::<S, N>(vertices)?;
        check_convex(vertices)?;
        Ok(Self::from_vertices(vertices))
    }
    /// Creates a polygon from the vertices of a convex ring of either orientation. Returns also the index of each of
    /// the polygon's vertices in the ring. Repeated and collinear vertices are left out, clockwise rings are reversed.
    ///
    /// ```
    /// use geograd::{ConvexPolygon, Vec2};
    /// let ring = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.5, 0.0)].map(|(x, y)| Vec2::new(x, y));
    /// let (polygon, places) = ConvexPolygon::<f64, 4>::cleaned(&ring).unwrap();
    /// assert_eq!(polygon.as_slice(), [ring[0], ring[3], ring[2], ring[1]]);
    /// assert_eq!(places, [0, 3, 2, 1]);
    /// ```
    ///
    /// # Errors
    ///
    /// [`Flaw::Vertex`] where the ring is not finite or not convex, where fewer than three vertices
    /// are left, or more than `N`.
    pub fn cleaned(ring: &[Vec2<S>]) -> Result<(Self, [usize; N]), Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        check_finite(ring)?;
        let n = ring.len();
        let missing = Flaw::Vertex {
            index: n,
            fault: VertexFault::Missing,
        };
        // From a true corner on, so that no straight path crosses the seam.
        let start = corner_of(ring).ok_or(missing)?;
        let backwards = runs_clockwise(ring);
        let place = |k: usize| {
            let k = if backwards { n - k % n } else { k };
            (start + k) % n
        };
        let (mut kept, mut count) = ([0; N], 0);
        for k in 0..n {
            let here = place(k);
            let next = place(k + 1);
            if same(ring[here], ring[next]) && k + 1 < n {
                continue;
            }
            if count > 0 {
                let before = ring[kept[count - 1]];
                let closed = same(ring[here], ring[next]) && k + 1 == n;
                let on_the_way = turn(before, ring[here], ring[next]) == Turn::Straight
                    && between(before, ring[here], ring[next]);
                if closed || on_the_way {
                    continue;
                }
            }
            if count == N {
                return Err(Flaw::Vertex {
                    index: here,
                    fault: VertexFault::Surplus,
                });
            }
            kept[count] = here;
            count += 1;
        }
        let mut vertices = [Vec2::zero(); N];
        for (vertex, &from) in vertices.iter_mut().zip(&kept[..count]) {
            *vertex = ring[from];
        }
        let made = ConvexPolygon { vertices, count };
        match check_convex(made.as_slice()) {
            Ok(()) => Ok((made, kept)),
            Err(Flaw::Vertex { index, fault }) => Err(Flaw::Vertex {
                index: kept
                    .get(index)
                    .copied()
                    .filter(|_| index < count)
                    .unwrap_or(ring.len()),
                fault,
            }),
            Err(other) => Err(other),
        }
    }
    /// Returns a vertex by number, counted around and around; the origin for a polygon without vertices.
    #[must_use]
    #[inline]
    pub fn vertex(&self, k: usize) -> Vec2<S> {
        let all = self.as_slice();
        match all.len() {
            0 => Vec2::zero(),
            n => all[k % n],
        }
    }
    /// Returns `N` vertices of the polygon: behind the last one the first is repeated, `N − count` times. As a closed
    /// ring it has `N` edges, and those beyond the polygon's own lead from the first vertex to itself. Straight-line
    /// code over `N` edges therefore needs no count.
    #[must_use]
    #[inline]
    pub fn padded(&self) -> [Vec2<S>; N] {
        let first = self.vertex(0);
        let count = self.count;
        let mut k = 0;
        self.vertices.each_as(|vertex| {
            k += 1;
            if k <= count { vertex } else { first }
        })
    }
    /// Returns the polygon's edges, each from its start to its end.
    #[inline]
    pub fn edges(&self) -> impl Iterator<Item = [Vec2<S>; 2]> + '_ {
        edges(self.as_slice())
    }
    /// Returns `N` edges: those of the polygon, then edges of length zero, from the first vertex to itself.
    #[must_use]
    #[inline]
    pub fn padded_edges(&self) -> [[Vec2<S>; 2]; N] {
        let all = self.padded();
        std::array::from_fn(|k| [all[k], all[if k + 1 < N { k + 1 } else { 0 }]])
    }
    /// Returns the smallest axis-aligned box around it; a point at the origin for no vertices. Ties share
    /// the derivative.
    #[must_use]
    #[inline]
    pub fn bounding(&self) -> Aabb2<S> {
        let zero = Aabb2 {
            min: Vec2::zero(),
            max: Vec2::zero(),
        };
        Aabb2::around(self.as_slice()).unwrap_or(zero)
    }
}

/// Returns the edges of a ring, each from its start to its end; the last one leads back to the first vertex.
///
/// ```
/// use geograd::{Vec2, shape::edges};
/// let ring = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(edges(&ring).map(|[a, b]| a.distance(b)).sum::<f64>(), 12.0);
/// ```
#[inline]
pub fn edges<S: Copy>(ring: &[Vec2<S>]) -> impl Iterator<Item = [Vec2<S>; 2]> + '_ {
    let ends = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(ends).map(|(&start, &end)| [start, end])
}

/// Returns the edges of a polyline, each from its start to its end: one fewer than vertices.
#[inline]
pub fn polyline_edges<S: Copy>(path: &[Vec2<S>]) -> impl Iterator<Item = [Vec2<S>; 2]> + '_ {
    path.windows(2).map(|pair| [pair[0], pair[1]])
}

impl<S: Scalar, const N: usize> From<[Vec2<S>; N]> for ConvexPolygon<S, N> {
    /// Creates a polygon with these vertices, unchecked.
    #[inline]
    fn from(vertices: [Vec2<S>; N]) -> Self {
        ConvexPolygon { vertices, count: N }
    }
}
impl<S: Scalar> From<Aabb2<S>> for ConvexPolygon<S, 4> {
    /// Creates a polygon with the box's corners, from the lower left.
    #[inline]
    fn from(shape: Aabb2<S>) -> Self {
        shape.corners().into()
    }
}
impl<S: Scalar> From<Obb2<S>> for ConvexPolygon<S, 4> {
    /// Creates a polygon with the box's corners, the first edge along its heading.
    #[inline]
    fn from(shape: Obb2<S>) -> Self {
        shape.corners().into()
    }
}

impl<S: Scalar<Mask = bool>, const N: usize> Validate for ConvexPolygon<S, N> {
    fn validate(&self) -> Result<(), Flaw> {
        if self.count > N {
            return Err(Flaw::Vertex {
                index: N,
                fault: VertexFault::Surplus,
            });
        }
        check_convex(self.as_slice())
    }
}
