//! Rings: closed polygons given as a slice of vertices, of any number.
//!
//! The last vertex is joined to the first. Repeated vertices, fewer than three vertices, zero area
//! and self-intersection are valid: the functions are sums over edges and say what they give.
//! Vertices are taken relative to the first one and in units of the ring's own extent, so neither
//! the distance from the origin nor the size costs digits.
use crate::{Scalar, Vec2};

/// Vertices worked on side by side: sums of their own that need not wait for each other, and arrays
/// that the compiler turns into SIMD.
pub(crate) const SIDE: usize = 16;

/// A ring in its own frame: the first vertex at the origin, lengths multiplied by a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local<'a, S> {
    ring: &'a [Vec2<S>],
    /// What lengths were multiplied by; a constant.
    pub scale: S,
}

impl<'a, S: Scalar> Local<'a, S> {
    #[inline(always)]
    pub fn new(ring: &'a [Vec2<S>]) -> Self {
        let unscaled = Local {
            ring,
            scale: S::one(),
        };
        let reach = |vertex: Vec2<S>| {
            let at = unscaled.halved(vertex);
            at.x.primal().magnitude().most(at.y.primal().magnitude())
        };
        let mut extent = S::Primal::zero();
        let (blocks, rest) = ring.as_chunks::<SIDE>();
        if !blocks.is_empty() {
            let mut extents = [S::Primal::zero(); SIDE];
            for block in blocks {
                for (extent, &vertex) in extents.iter_mut().zip(block) {
                    *extent = extent.most(reach(vertex));
                }
            }
            for other in extents {
                extent = extent.most(other);
            }
        }
        for &vertex in rest {
            extent = extent.most(reach(vertex));
        }
        Local {
            ring,
            scale: scale_of(extent),
        }
    }
    /// Half the way from the first vertex to another: the whole way may not be finite.
    #[inline(always)]
    fn halved(&self, vertex: Vec2<S>) -> Vec2<S> {
        let first = self.ring[0];
        Vec2::new(
            vertex.x.halved() - first.x.halved(),
            vertex.y.halved() - first.y.halved(),
        )
    }
    /// A vertex in the local frame.
    #[inline(always)]
    pub fn place(&self, vertex: Vec2<S>) -> Vec2<S> {
        self.halved(vertex) * self.scale
    }
    /// The sums of some quantities of an edge over all edges, from start and end of each.
    #[inline(always)]
    pub fn sums<const K: usize>(&self, of_edge: impl Fn(Vec2<S>, Vec2<S>) -> [S; K]) -> [S; K] {
        let (ring, n) = (self.ring, self.ring.len());
        let mut sums = [[S::zero(); SIDE]; K];
        let (mut x, mut y) = ([S::zero(); SIDE + 1], [S::zero(); SIDE + 1]);
        let mut first = 0;
        while first + SIDE < n {
            for (k, &vertex) in ring[first..=first + SIDE].iter().enumerate() {
                let at = self.place(vertex);
                (x[k], y[k]) = (at.x, at.y);
            }
            for k in 0..SIDE {
                let edge = of_edge(Vec2::new(x[k], y[k]), Vec2::new(x[k + 1], y[k + 1]));
                for (sum, of_edge) in sums.iter_mut().zip(edge) {
                    sum[k] += of_edge;
                }
            }
            first += SIDE;
        }
        let mut totals = [S::zero(); K];
        if first > 0 {
            for (total, sums) in totals.iter_mut().zip(sums) {
                for sum in sums {
                    *total += sum;
                }
            }
        }
        let mut start = self.place(ring[first]);
        for i in first..n {
            let end = self.place(ring[if i + 1 == n { 0 } else { i + 1 }]);
            for (total, of_edge) in totals.iter_mut().zip(of_edge(start, end)) {
                *total += of_edge;
            }
            start = end;
        }
        totals
    }
}

/// The power of two by which halved vertices are multiplied, from the largest of their coordinates.
#[inline(always)]
fn scale_of<S: Scalar>(extent: S::Primal) -> S {
    let point = extent.at_most(S::Primal::zero());
    let scale = S::Primal::select(point, S::Primal::one(), extent).binade();
    S::from_primal(S::Primal::select(point, S::Primal::one(), scale))
}

/// A length between halved vertices times a scale in the caller's unit.
#[inline(always)]
fn outer<S: Scalar>(length: S, scale: S) -> S {
    (length + length).over(scale)
}

/// A short ring in its own frame, one vertex after another: what [`Local`] is for slices.
struct Short<S> {
    vertices: [Vec2<S>; SIDE],
    count: usize,
    scale: S,
}

impl<S: Scalar> Short<S> {
    /// From 1 to [`SIDE`] vertices.
    #[inline(always)]
    fn new(count: usize, at: impl Fn(usize) -> Vec2<S>) -> Self {
        let half = |v: Vec2<S>| Vec2::new(v.x.halved(), v.y.halved());
        let first = half(at(0));
        let mut vertices = [Vec2::new(S::zero(), S::zero()); SIDE];
        let mut extent = S::Primal::zero();
        let mut k = 0;
        while k < count {
            let place = half(at(k)) - first;
            let (x, y) = (place.x.primal(), place.y.primal());
            extent = extent.most(x.magnitude().most(y.magnitude()));
            vertices[k % SIDE] = place;
            k += 1;
        }
        let scale = scale_of(extent);
        k = 0;
        while k < count {
            vertices[k % SIDE] = vertices[k % SIDE] * scale;
            k += 1;
        }
        Short {
            vertices,
            count,
            scale,
        }
    }
    /// The sums of some quantities of an edge over all edges, from start and end of each.
    #[inline(always)]
    fn sums<const K: usize>(&self, of_edge: impl Fn(Vec2<S>, Vec2<S>) -> [S; K]) -> [S; K] {
        let mut totals = [S::zero(); K];
        let mut start = self.vertices[0];
        let mut i = 0;
        while i < self.count {
            let next = if i + 1 == self.count { 0 } else { i + 1 };
            let end = self.vertices[next % SIDE];
            let edge = of_edge(start, end);
            let mut k = 0;
            while k < K {
                totals[k] += edge[k];
                k += 1;
            }
            start = end;
            i += 1;
        }
        totals
    }
}
/// The signed area of a ring, in squared units of length: positive when it runs counter-clockwise.
/// Saturates at the largest finite number.
///
/// Each region counts as often as the ring winds around it. Zero for fewer than three vertices.
/// Smooth everywhere. Source: the shoelace formula.
///
/// ```
/// use geograd::{Vec2, ring::signed_area};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(signed_area(&triangle), 6.0);
/// ```
#[must_use]
#[inline(always)]
pub fn signed_area<S: Scalar>(ring: &[Vec2<S>]) -> S {
    if ring.is_empty() {
        return S::zero();
    }
    if ring.len() <= SIDE {
        return signed_area_of(ring.len(), |k| ring[k]);
    }
    let local = Local::new(ring);
    finished_area(local.sums(cross_of), local.scale)
}

#[inline(always)]
fn cross_of<S: Scalar>(start: Vec2<S>, end: Vec2<S>) -> [S; 1] {
    [start.perp_dot(end)]
}

#[inline(always)]
fn finished_area<S: Scalar>([twice]: [S; 1], scale: S) -> S {
    let area = outer(outer(twice.halved(), scale), scale);
    area.saturated().canonical()
}

/// [`signed_area`] of 1 to [`SIDE`] vertices.
#[inline(always)]
pub(crate) fn signed_area_of<S: Scalar>(count: usize, at: impl Fn(usize) -> Vec2<S>) -> S {
    let short = Short::new(count, at);
    finished_area(short.sums(cross_of), short.scale)
}

/// The perimeter of a ring, in units of length: the sum of the lengths of its edges. Saturates at
/// the largest finite number.
///
/// Zero for fewer than two vertices; two vertices count their distance twice. Kink: an edge of
/// length zero, where the slope is zero.
///
/// ```
/// use geograd::{Vec2, ring::perimeter};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(perimeter(&triangle), 12.0);
/// ```
#[must_use]
#[inline(always)]
pub fn perimeter<S: Scalar>(ring: &[Vec2<S>]) -> S {
    if ring.is_empty() {
        return S::zero();
    }
    if ring.len() <= SIDE {
        return perimeter_of(ring.len(), |k| ring[k]);
    }
    let local = Local::new(ring);
    finished_perimeter(local.sums(length_of), local.scale)
}

#[inline(always)]
fn length_of<S: Scalar>(start: Vec2<S>, end: Vec2<S>) -> [S; 1] {
    [(end - start).length()]
}

#[inline(always)]
fn finished_perimeter<S: Scalar>([sum]: [S; 1], scale: S) -> S {
    outer(sum, scale).saturated().canonical()
}

/// [`perimeter`] of 1 to [`SIDE`] vertices.
#[inline(always)]
pub(crate) fn perimeter_of<S: Scalar>(count: usize, at: impl Fn(usize) -> Vec2<S>) -> S {
    let short = Short::new(count, at);
    finished_perimeter(short.sums(length_of), short.scale)
}

/// The centroid of the area of a ring (not of its vertices): where a plate of that shape balances.
///
/// Where the signed area is exactly zero (fewer than three vertices, collinear vertices, a
/// symmetric figure of eight) there is no such point: the mean of the vertices is returned, with
/// its slope; the origin for no vertices. That case is a jump, and near it the result grows without
/// bound for rings whose lobes cancel (it saturates at the largest finite number). Source: Green's
/// theorem.
///
/// ```
/// use geograd::{Vec2, ring::centroid};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(centroid(&triangle), Vec2::new(1.0, 1.0));
/// ```
#[must_use]
#[inline(always)]
pub fn centroid<S: Scalar>(ring: &[Vec2<S>]) -> Vec2<S> {
    let Some(&first) = ring.first() else {
        return Vec2::zero();
    };
    if ring.len() <= SIDE {
        return centroid_of(ring.len(), |k| ring[k]).value;
    }
    let local = Local::new(ring);
    finished_centroid(local.sums(moments_of), local.scale, first, ring.len()).value
}

/// A centroid, and where it stands for one because the area is zero.
pub(crate) struct Measured<S: Scalar> {
    /// The centroid or the mean of the vertices.
    pub value: Vec2<S>,
    /// Where it is the mean of the vertices.
    pub flat: S::Mask,
}

#[inline(always)]
fn moments_of<S: Scalar>(start: Vec2<S>, end: Vec2<S>) -> [S; 5] {
    let cross = start.perp_dot(end);
    let moment = (start + end) * cross;
    [cross, moment.x, moment.y, start.x, start.y]
}

#[inline(always)]
fn finished_centroid<S: Scalar>(
    [twice, moment_x, moment_y, sum_x, sum_y]: [S; 5],
    scale: S,
    first: Vec2<S>,
    count: usize,
) -> Measured<S> {
    let flat = twice.equals(S::zero());
    let thrice = S::lit(3.0) * S::select(flat, S::one(), twice);
    let count = S::lit(count as f64);
    #[inline(always)]
    fn place<S: Scalar>(first: S, at: S, scale: S) -> S {
        (first + outer(at, scale)).saturated().canonical()
    }
    let at_x = S::select(flat, sum_x.over(count), moment_x.over(thrice));
    let at_y = S::select(flat, sum_y.over(count), moment_y.over(thrice));
    Measured {
        value: Vec2::new(place(first.x, at_x, scale), place(first.y, at_y, scale)),
        flat,
    }
}

/// [`centroid`] of 1 to [`SIDE`] vertices.
#[inline(always)]
pub(crate) fn centroid_of<S: Scalar>(count: usize, at: impl Fn(usize) -> Vec2<S>) -> Measured<S> {
    let first = at(0);
    let short = Short::new(count, at);
    finished_centroid(short.sums(moments_of), short.scale, first, count)
}
