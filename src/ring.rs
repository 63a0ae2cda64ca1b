//! Rings: closed polygons given as a slice of vertices, of any number.
//!
//! The last vertex is joined to the first. Repeated vertices, fewer than three vertices, zero area and
//! self-intersection are valid: the functions are sums over edges, and their pages state the results. Vertices are
//! taken relative to the first one and in units of the ring's own extent, so neither the distance from the origin nor
//! the size costs digits.
//!
//! Signed area, perimeter and centroid, and their derivatives, are finite for all finite vertices.
use crate::scalar::power_of_largest;
use crate::{Mask, Scalar, Vec2};

/// The number of vertices processed side by side: their sums are independent, and the compiler turns their arrays into
/// SIMD.
pub(crate) const SIDE: usize = 16;

/// The vertices of a ring, at least one, by number.
pub(crate) trait Vertices<S>: Copy {
    /// Returns the number of vertices, at least one.
    fn count(self) -> usize;
    /// Returns vertex `k`.
    fn at(self, k: usize) -> Vec2<S>;
    /// Returns the slice of all vertices.
    fn slice(&self) -> &[Vec2<S>];
}

impl<S: Copy> Vertices<S> for &[Vec2<S>] {
    #[inline(always)]
    fn count(self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn at(self, k: usize) -> Vec2<S> {
        self[k]
    }
    #[inline(always)]
    fn slice(&self) -> &[Vec2<S>] {
        self
    }
}

/// The local frame of a ring's vertices: relative to the first one, and in units of a power of two for an extreme
/// extent, so that no product over- or underflows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local<S> {
    first: Vec2<S>,
    /// The factor of halved vertices, a constant; `None` leaves vertices as they are.
    scale: Option<S>,
}

impl<S: Scalar> Local<S> {
    /// Creates the frame of a ring of any extent.
    #[inline(always)]
    pub fn new(ring: impl Vertices<S>) -> Self {
        match is_ordinary::<S>(extent_of(ring)).all() {
            true => Self::plain(ring),
            false => Self::scaled(ring),
        }
    }
    #[inline(always)]
    fn plain(ring: impl Vertices<S>) -> Self {
        Local {
            first: ring.at(0),
            scale: None,
        }
    }
    #[inline(always)]
    fn scaled(ring: impl Vertices<S>) -> Self {
        let first = halved(ring.at(0));
        let from = primal(first);
        let extent = largest_of(
            ring,
            #[inline(always)]
            |vertex| primal(halved(vertex)) - from,
        );
        let point = extent.at_most(S::Primal::zero());
        let scale = S::Primal::select(point, S::Primal::one(), extent).binade();
        let scale = S::Primal::select(point, S::Primal::one(), scale);
        Local {
            first,
            scale: Some(S::from_primal(scale)),
        }
    }
    /// Returns a vertex in the local frame.
    #[inline(always)]
    pub fn place(&self, vertex: Vec2<S>) -> Vec2<S> {
        match self.scale {
            None => vertex - self.first,
            // Halved, since the whole difference may not be finite.
            Some(scale) => (halved(vertex) - self.first) * scale,
        }
    }
    /// Returns a local length in the caller's unit.
    #[inline(always)]
    fn outer(&self, length: S) -> S {
        match self.scale {
            None => length,
            Some(scale) => (length + length).over(scale),
        }
    }
    /// Returns the sums of some quantities of an edge over all edges, from start and end of each.
    ///
    /// Rings of more than [`SIDE`] vertices have as many sums of their own, which are added first.
    #[inline(always)]
    pub fn sums<const K: usize>(
        &self,
        ring: impl Vertices<S>,
        of_edge: impl Fn(Vec2<S>, Vec2<S>) -> [S; K],
    ) -> [S; K] {
        let mut totals = [S::zero(); K];
        let count = ring.count();
        let mut first = 0;
        if count > SIDE {
            let mut sums = [[S::zero(); SIDE]; K];
            let (mut x, mut y) = ([S::zero(); SIDE + 1], [S::zero(); SIDE + 1]);
            while first + SIDE < count {
                let block = &ring.slice()[first..=first + SIDE];
                for ((x, y), &vertex) in x.iter_mut().zip(&mut y).zip(block) {
                    let at = self.place(vertex);
                    (*x, *y) = (at.x, at.y);
                }
                for k in 0..SIDE {
                    let edge = of_edge(Vec2::new(x[k], y[k]), Vec2::new(x[k + 1], y[k + 1]));
                    for (sum, of_edge) in sums.iter_mut().zip(edge) {
                        sum[k] += of_edge;
                    }
                }
                first += SIDE;
            }
            for (total, sums) in totals.iter_mut().zip(sums) {
                for sum in sums {
                    *total += sum;
                }
            }
        }
        let mut start = self.place(ring.at(first));
        first += 1;
        while first <= count {
            // The last edge leads back to the first vertex.
            let end = self.place(ring.at(if first == count { 0 } else { first }));
            let edge = of_edge(start, end);
            let mut k = 0;
            while k < K {
                totals[k] += edge[k];
                k += 1;
            }
            start = end;
            first += 1;
        }
        totals
    }
}

#[inline(always)]
fn halved<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    Vec2::new(v.x.halved(), v.y.halved())
}
#[inline(always)]
fn primal<S: Scalar>(v: Vec2<S>) -> Vec2<S::Primal> {
    Vec2::new(v.x.primal(), v.y.primal())
}

/// Returns the largest coordinate of a ring relative to its first vertex.
#[inline(always)]
fn extent_of<S: Scalar>(ring: impl Vertices<S>) -> S::Primal {
    let first = primal(ring.at(0));
    largest_of(
        ring,
        #[inline(always)]
        |vertex| primal(vertex) - first,
    )
}

/// Returns the largest local coordinate of the vertices.
#[inline(always)]
fn largest_of<S: Scalar>(
    ring: impl Vertices<S>,
    place: impl Fn(Vec2<S>) -> Vec2<S::Primal>,
) -> S::Primal {
    #[inline(always)]
    fn reach<P: Scalar>(at: Vec2<P>) -> P {
        at.x.magnitude().most(at.y.magnitude())
    }
    let mut largest = S::Primal::zero();
    let count = ring.count();
    let mut first = 0;
    if count > SIDE {
        let mut side = [S::Primal::zero(); SIDE];
        let (blocks, _) = ring.slice().as_chunks::<SIDE>();
        for block in blocks {
            for (largest, &vertex) in side.iter_mut().zip(block) {
                *largest = largest.most(reach(place(vertex)));
            }
        }
        first = blocks.len() * SIDE;
        for other in side {
            largest = largest.most(other);
        }
    }
    while first < count {
        largest = largest.most(reach(place(ring.at(first))));
        first += 1;
    }
    largest
}

/// Returns `true` where products of three lengths of that extent stay far from over- and underflow.
#[inline(always)]
fn is_ordinary<S: Scalar>(extent: S::Primal) -> S::Mask {
    // A quarter of the range of exponents, to either side of one.
    let large = power_of_largest::<S>(0.25);
    let zero = extent.equals(S::Primal::zero());
    extent.at_most(S::Primal::lit(large)) & (extent.at_least(S::Primal::lit(1.0 / large)) | zero)
}

/// Returns a measure of a ring by sums over its edges, in the caller's unit: `finish` is given the sums, and
/// what turns a local length into one of the caller.
#[inline(always)]
fn measure<S: Scalar, const K: usize, const N: usize>(
    ring: impl Vertices<S>,
    of_edge: impl Fn(Vec2<S>, Vec2<S>) -> [S; K] + Copy,
    finish: impl Fn([S; K], &Local<S>) -> [S; N],
) -> [S; N] {
    let ordinary = is_ordinary::<S>(extent_of(ring));
    let local = Local::plain(ring);
    let plain = finish(local.sums(ring, of_edge), &local);
    if ordinary.all() {
        return plain;
    }
    let local = Local::scaled(ring);
    let mut scaled = finish(local.sums(ring, of_edge), &local);
    for (scaled, plain) in scaled.iter_mut().zip(plain) {
        *scaled = S::select(ordinary, plain, *scaled);
    }
    scaled
}

/// Returns the signed area of a ring, in squared units of length: positive when it runs counter-clockwise.
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
    signed_area_of(ring)
}

/// Returns the [`signed_area`] of a ring that has vertices.
#[inline(always)]
pub(crate) fn signed_area_of<S: Scalar>(ring: impl Vertices<S>) -> S {
    let [area] = measure(
        ring,
        #[inline(always)]
        |start, end| [start.perp_dot(end)],
        #[inline(always)]
        |[twice], local| {
            let area = local.outer(local.outer(twice.halved()));
            [area.saturated().canonical()]
        },
    );
    area
}

/// Returns the perimeter of a ring, in units of length: the sum of the lengths of its edges. Saturates at
/// the largest finite number.
///
/// Zero for fewer than two vertices; two vertices count their distance twice. Kink: an edge of
/// length zero, where the derivative is zero.
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
    perimeter_of(ring)
}

/// Returns the [`perimeter`] of a ring that has vertices.
#[inline(always)]
pub(crate) fn perimeter_of<S: Scalar>(ring: impl Vertices<S>) -> S {
    let [perimeter] = measure(
        ring,
        #[inline(always)]
        |start, end| [(end - start).length()],
        #[inline(always)]
        |[sum], local| [local.outer(sum).saturated().canonical()],
    );
    perimeter
}

/// Returns the centroid of the area of a ring (not of its vertices): where a plate of that shape balances.
///
/// If the signed area is exactly zero (fewer than three vertices, collinear vertices, a symmetric figure of eight)
/// there is no such point. The result is then the mean of the vertices, with its derivative; the origin for no
/// vertices. This case is a jump, and near it the result grows without bound for rings whose lobes cancel (it saturates
/// at the largest finite number). Source: Green's theorem.
///
/// ```
/// use geograd::{Vec2, ring::centroid};
/// let triangle = [Vec2::new(0.0, 0.0), Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)];
/// assert_eq!(centroid(&triangle), Vec2::new(1.0, 1.0));
/// ```
#[must_use]
#[inline(always)]
pub fn centroid<S: Scalar>(ring: &[Vec2<S>]) -> Vec2<S> {
    if ring.is_empty() {
        return Vec2::zero();
    }
    centroid_of(ring).value
}

/// A centroid, and where it stands for one because the area is zero.
pub(crate) struct Measured<S: Scalar> {
    /// The centroid or the mean of the vertices.
    pub value: Vec2<S>,
    /// `true` where it is the mean of the vertices.
    pub flat: S::Mask,
}

/// Returns the [`centroid`] of a ring that has vertices.
#[inline(always)]
pub(crate) fn centroid_of<S: Scalar>(ring: impl Vertices<S>) -> Measured<S> {
    let (first, count) = (ring.at(0), S::lit(ring.count() as f64));
    let [x, y, flat] = measure(
        ring,
        #[inline(always)]
        |start, end| {
            let cross = start.perp_dot(end);
            let moment = (start + end) * cross;
            [cross, moment.x, moment.y, start.x, start.y]
        },
        #[inline(always)]
        |[twice, moment_x, moment_y, sum_x, sum_y], local| {
            let flat = twice.equals(S::zero());
            let thrice = S::lit(3.0) * S::select(flat, S::one(), twice);
            let at_x = S::select(flat, sum_x.over(count), moment_x.over(thrice));
            let at_y = S::select(flat, sum_y.over(count), moment_y.over(thrice));
            [
                (first.x + local.outer(at_x)).saturated().canonical(),
                (first.y + local.outer(at_y)).saturated().canonical(),
                S::select(flat, S::one(), S::zero()),
            ]
        },
    );
    Measured {
        value: Vec2::new(x, y),
        flat: flat.above(S::zero()),
    }
}

/// The measures that kernels of the library compute.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// [`signed_area`].
    SignedArea,
    /// The magnitude of the [`signed_area`].
    Area,
    /// [`perimeter`].
    Perimeter,
    /// [`centroid`].
    Centroid,
}

impl Measure {
    /// Returns the count of numbers per result.
    #[must_use]
    pub const fn fields(self) -> usize {
        match self {
            Measure::SignedArea | Measure::Area | Measure::Perimeter => 1,
            Measure::Centroid => 2,
        }
    }
    /// Writes the numbers of the result to the first [`fields`](Measure::fields) places.
    #[inline(always)]
    pub fn write<S: Scalar>(self, ring: &[Vec2<S>], out: &mut [S]) {
        match self {
            Measure::SignedArea => out[0] = signed_area(ring),
            Measure::Area => out[0] = signed_area(ring).magnitude(),
            Measure::Perimeter => out[0] = perimeter(ring),
            Measure::Centroid => {
                let center = centroid(ring);
                (out[0], out[1]) = (center.x, center.y);
            }
        }
    }
}
