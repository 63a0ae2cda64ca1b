//! Batches of simple polygons: overlap scores of rings from two ragged lists.
use crate::ad::adjoint::overlap_rings;
use crate::error::{Argument, Error, Flaw, VertexFault};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, TILE, Tiles, tiles};
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::kernels::cpu::ragged::check_offsets;
use crate::kernels::cpu::work::{in_parallel, rows_per_piece};
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::numbers;
use crate::overlap_polygon::holed;
use crate::reference::bounds_of;
use crate::scalar::real::in_format;
use crate::{Aabb2, Real, Vec2};

/// A list of polygons with one ring each: polygon i has the vertices `offsets[i]..offsets[i + 1]`. The first offset is
/// 0, the last one the number of vertices.
///
/// Rings have any number of vertices and either orientation, convex or not, and do not cross themselves. One
/// of fewer than three vertices has no area and shares nothing.
#[derive(Clone, Copy, Debug)]
pub struct RingList<'a, T> {
    /// The vertices of all polygons.
    pub vertices: &'a [Vec2<T>],
    /// The first vertex of each polygon, and the end of the last.
    pub offsets: &'a [usize],
}

impl<'a, T> RingList<'a, T> {
    /// Returns the number of polygons.
    fn count(&self) -> usize {
        self.offsets.len() - 1
    }
    /// Returns the vertices of a polygon.
    fn ring(&self, i: usize) -> &'a [Vec2<T>] {
        &self.vertices[self.offsets[i]..self.offsets[i + 1]]
    }
}

/// A measure of two polygons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RingScore {
    /// The [area](crate::overlap_polygon::holed::intersection_area) that both share, in squared units of
    /// length.
    IntersectionArea,
    /// [Intersection over union](crate::overlap_polygon::holed::iou), in `[0, 1]`.
    Iou,
    /// The [share](crate::overlap_polygon::holed::iof) of the first that lies in the second, in `[0, 1]`.
    Iof,
}

impl RingScore {
    fn value<T: Real>(self, a: &[Vec2<T>], b: &[Vec2<T>]) -> T {
        match self {
            RingScore::IntersectionArea => holed::intersection_area(a, b),
            RingScore::Iou => holed::iou(a, b),
            RingScore::Iof => holed::iof(a, b),
        }
    }
    /// Writes the derivatives times a cotangent. Returns the value.
    fn vjp<T: Real>(
        self,
        [a, b]: [&[Vec2<T>]; 2],
        out_bar: T,
        [a_bar, b_bar]: [&mut [Vec2<T>]; 2],
    ) -> T {
        match self {
            RingScore::IntersectionArea => {
                overlap_rings::intersection_area_vjp(a, b, out_bar, a_bar, b_bar)
            }
            RingScore::Iou => overlap_rings::iou_vjp(a, b, out_bar, a_bar, b_bar),
            RingScore::Iof => overlap_rings::iof_vjp(a, b, out_bar, a_bar, b_bar),
        }
    }
}

/// Two lists and the pairs to compute: polygons of equal index, or all pairs.
#[derive(Clone, Copy)]
pub struct RingPairs<'a, T> {
    score: RingScore,
    lists: [RingList<'a, T>; 2],
    all: bool,
}

/// Results and cotangents of both lists.
pub type Pulled<T> = (Vec<T>, [Vec<Vec2<T>>; 2]);

impl Cpu {
    /// Returns the score of every pair of polygons with equal index.
    ///
    /// Every result has the bits of the function for two polygons, for any number of threads.
    ///
    /// # Errors
    ///
    /// [`Error::OffsetsOf`] for offsets of a list that decrease or do not cover its vertices,
    /// [`Error::Length`] for lists of different lengths, [`Error::Invalid`] with the polygon as its row and
    /// [`Flaw::Vertex`] for a vertex that is not finite.
    ///
    /// ```
    /// use geograd::Aabb2;
    /// use geograd::kernels::Cpu;
    /// use geograd::kernels::cpu::polygons::{RingList, RingScore};
    /// let a = Aabb2::new(0.0, 0.0, 2.0, 2.0).corners();
    /// let b = Aabb2::new(1.0, 0.0, 3.0, 2.0).corners();
    /// let (a, b) = (
    ///     RingList { vertices: &a, offsets: &[0, 4] },
    ///     RingList { vertices: &b[..3], offsets: &[0, 3] },
    /// );
    /// let found = Cpu::new().rings(RingScore::IntersectionArea, a, b)?;
    /// assert!((found[0] - 0.5_f64).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn rings<T: Real>(
        &self,
        score: RingScore,
        a: RingList<'_, T>,
        b: RingList<'_, T>,
    ) -> Result<Vec<T>, Error> {
        Ok((drivers_in::<T>().ring_scores)(aligned(score, a, b)?))
    }

    /// Computes [`rings`](Cpu::rings) with its adjoint. Returns the results, and one cotangent per vertex of either
    /// list, from one cotangent per result.
    ///
    /// # Errors
    ///
    /// As [`rings`](Cpu::rings), and [`Error::Length`] unless there is one cotangent per result,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn rings_vjp<T: Real>(
        &self,
        score: RingScore,
        a: RingList<'_, T>,
        b: RingList<'_, T>,
        upstream: &[T],
    ) -> Result<Pulled<T>, Error> {
        let pairs = aligned(score, a, b)?;
        expect(Argument::Upstream, a.count(), upstream.len())?;
        check_upstream(upstream, 1)?;
        Ok((drivers_in::<T>().ring_derivatives)(pairs, upstream))
    }

    /// Returns the score of every polygon of one list with every polygon of another, in row-major order. Pairs whose
    /// bounds do not meet cost next to nothing.
    ///
    /// # Errors
    ///
    /// As [`rings`](Cpu::rings), but lists may have different lengths; [`Error::TooLarge`] for more results than
    /// memory can hold.
    pub fn all_rings<T: Real>(
        &self,
        score: RingScore,
        a: RingList<'_, T>,
        b: RingList<'_, T>,
    ) -> Result<Vec<T>, Error> {
        Ok((drivers_in::<T>().ring_scores)(crossed(score, a, b)?))
    }

    /// Computes [`all_rings`](Cpu::all_rings) with its adjoint. Returns the results, and one cotangent per vertex of
    /// either list, summed over all pairs, from one cotangent per result. Pairs of cotangent zero are skipped.
    ///
    /// # Errors
    ///
    /// As [`all_rings`](Cpu::all_rings), and [`Error::Length`] unless there is one cotangent per result,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn all_rings_vjp<T: Real>(
        &self,
        score: RingScore,
        a: RingList<'_, T>,
        b: RingList<'_, T>,
        upstream: &[T],
    ) -> Result<Pulled<T>, Error> {
        let pairs = crossed(score, a, b)?;
        expect(Argument::Upstream, a.count() * b.count(), upstream.len())?;
        check_upstream(upstream, 1)?;
        Ok((drivers_in::<T>().ring_derivatives)(pairs, upstream))
    }
}

/// The functions over pairs that are compiled in this library for both formats, so that a calling crate compiles no
/// copy.
struct RingKernels<T: Real> {
    ring_scores: fn(RingPairs<'_, T>) -> Vec<T>,
    ring_derivatives: fn(RingPairs<'_, T>, &[T]) -> Pulled<T>,
}

static F32: RingKernels<f32> = RingKernels {
    ring_scores: scores,
    ring_derivatives: derivatives,
};
static F64: RingKernels<f64> = RingKernels {
    ring_scores: scores,
    ring_derivatives: derivatives,
};

#[inline]
fn drivers_in<T: Real>() -> &'static RingKernels<T> {
    in_format([&F32, &F64])
}

/// Returns polygons of equal index as pairs, after checks.
fn aligned<'a, T: Real>(
    score: RingScore,
    a: RingList<'a, T>,
    b: RingList<'a, T>,
) -> Result<RingPairs<'a, T>, Error> {
    check(Argument::A, a)?;
    check(Argument::B, b)?;
    expect(Argument::B, a.count(), b.count())?;
    let lists = [a, b];
    let all = false;
    Ok(RingPairs { score, lists, all })
}

/// Returns all polygons of one list with all of another as pairs, after checks.
fn crossed<'a, T: Real>(
    score: RingScore,
    a: RingList<'a, T>,
    b: RingList<'a, T>,
) -> Result<RingPairs<'a, T>, Error> {
    check(Argument::A, a)?;
    check(Argument::B, b)?;
    let count = a.count().checked_mul(b.count());
    let bytes = count.and_then(|count| count.checked_mul(size_of::<T>()));
    if bytes.is_none_or(|bytes| bytes > isize::MAX as usize) || b.count() >= u32::MAX as usize {
        return Err(Error::TooLarge);
    }
    let lists = [a, b];
    let all = true;
    Ok(RingPairs { score, lists, all })
}

fn check<T: Real>(argument: Argument, list: RingList<'_, T>) -> Result<(), Error> {
    check_offsets::<T>(list.vertices.len(), list.offsets).map_err(|error| match error {
        Error::Offsets { item: row } => Error::OffsetsOf {
            argument,
            item: row,
        },
        error => error,
    })?;
    if (kernels_in::<T>().all_finite)(&numbers(list.vertices)) {
        return Ok(());
    }
    for row in 0..list.count() {
        let bad = |vertex: &Vec2<T>| !vertex.is_finite();
        if let Some(index) = list.ring(row).iter().position(bad) {
            let fault = VertexFault::NotFinite;
            return Err(Error::Invalid {
                argument,
                item: row,
                flaw: Flaw::Vertex { index, fault },
            });
        }
    }
    Ok(())
}

/// Returns the bounds of polygons in tiles. Bounds of a polygon without vertices meet nothing.
fn bounds<T: Real>(list: RingList<'_, T>) -> Vec<Lane<T>> {
    let (least, most) = (T::lit(f64::NEG_INFINITY), T::lit(f64::INFINITY));
    let mut all = vec![Lane::default(); tiles(list.count()) * BOUNDS];
    for tile in all.as_chunks_mut::<BOUNDS>().0 {
        *tile = [most, most, least, least].map(|x| Lane([x; TILE]));
    }
    for i in 0..list.count() {
        if let Some(Aabb2 { min, max }) = bounds_of(list.ring(i)) {
            for (k, x) in [min.x, min.y, max.x, max.y].into_iter().enumerate() {
                all[i / TILE * BOUNDS + k].0[i % TILE] = x;
            }
        }
    }
    all
}

/// A search for the polygons of b whose bounds meet the bounds of a polygon of a.
struct NearSearch<'a, T> {
    pairs: RingPairs<'a, T>,
    bounds: Option<[Vec<Lane<T>>; 2]>,
}

impl<'a, T: Real> NearSearch<'a, T> {
    fn new(pairs: RingPairs<'a, T>) -> Self {
        let bounds = pairs.all.then(|| pairs.lists.map(bounds));
        NearSearch { pairs, bounds }
    }
    /// Returns the number of results per polygon of a.
    fn wide(&self) -> usize {
        match self.bounds {
            Some(_) => self.pairs.lists[1].count(),
            None => 1,
        }
    }
    /// Calls `run` for every polygon of b whose bounds meet those of polygon `i` of a, in ascending order. It passes
    /// the index of the result in its row.
    fn each(&self, i: usize, hits: &mut Vec<u32>, mut run: impl FnMut(usize, usize)) {
        let Some([rows, columns]) = &self.bounds else {
            return run(i, 0);
        };
        let row: [T; BOUNDS] = std::array::from_fn(|k| rows[i / TILE * BOUNDS + k].0[i % TILE]);
        hits.resize(columns.len() / BOUNDS * TILE + TILE, 0);
        let found = (kernels_in::<T>().near)(&row, Tiles::new(columns, BOUNDS), 0, hits);
        for &j in hits[..found]
            .iter()
            .filter(|&&j| (j as usize) < self.wide())
        {
            run(j as usize, j as usize);
        }
    }
}

/// Returns the results of all pairs, on all threads.
pub(crate) fn scores<T: Real>(pairs: RingPairs<'_, T>) -> Vec<T> {
    let near = NearSearch::new(pairs);
    let [a, b] = pairs.lists;
    let wide = near.wide();
    let mut out = vec![T::default(); a.count() * wide];
    if out.is_empty() {
        return out;
    }
    let rows = rows_per_piece(a.count());
    let work = out.chunks_mut(rows * wide).enumerate().collect();
    in_parallel(work, |(piece, out): (usize, &mut [T])| {
        let mut hits = Vec::new();
        for (i, out) in out.chunks_mut(wide).enumerate() {
            let i = piece * rows + i;
            near.each(i, &mut hits, |j, place| {
                out[place] = pairs.score.value(a.ring(i), b.ring(j));
            });
        }
    });
    out
}

/// Returns the results of all pairs, and derivatives times cotangents, on all threads.
pub(crate) fn derivatives<T: Real>(pairs: RingPairs<'_, T>, upstream: &[T]) -> Pulled<T> {
    let near = NearSearch::new(pairs);
    let [a, b] = pairs.lists;
    let wide = near.wide();
    let mut out = vec![T::default(); a.count() * wide];
    let mut bars = [a, b].map(|list| vec![Vec2::<T>::zero(); list.vertices.len()]);
    if out.is_empty() {
        return (out, bars);
    }
    let rows = rows_per_piece(a.count());
    let [a_bars, b_bars] = &mut bars;
    // Derivatives by b are summed within each piece of rows, then over pieces.
    let pieces = a.count().div_ceil(rows);
    let mut sums: Vec<Vec<Vec2<T>>> = vec![Vec::new(); pieces];
    let mut work = Vec::new();
    let (mut rest, mut given) = (&mut a_bars[..], upstream);
    for ((piece, out), sum) in out.chunks_mut(rows * wide).enumerate().zip(&mut sums) {
        let (first, end) = (piece * rows, a.count().min((piece + 1) * rows));
        let (own, after) = rest.split_at_mut(a.offsets[end] - a.offsets[first]);
        let (up, later) = given.split_at(out.len());
        (rest, given) = (after, later);
        work.push((first, out, up, own, sum));
    }
    type Work<'a, T> = (
        usize,
        &'a mut [T],
        &'a [T],
        &'a mut [Vec2<T>],
        &'a mut Vec<Vec2<T>>,
    );
    in_parallel(work, |(first, out, up, a_bars, b_bars): Work<'_, T>| {
        let (mut hits, mut one, mut other) = (Vec::new(), Vec::new(), Vec::new());
        let last = first + out.len() / wide;
        // The vertices of the second list that the piece uses: of equal indices if aligned, else all.
        let base = if pairs.all { 0 } else { b.offsets[first] };
        let end = if pairs.all {
            b.vertices.len()
        } else {
            b.offsets[last]
        };
        b_bars.resize(end - base, Vec2::zero());
        for (row, (out, up)) in out.chunks_mut(wide).zip(up.chunks(wide)).enumerate() {
            let i = first + row;
            let a_bars = &mut a_bars[a.offsets[i] - a.offsets[first]..][..a.ring(i).len()];
            near.each(i, &mut hits, |j, place| {
                let (p, q) = (a.ring(i), b.ring(j));
                if up[place] == T::zero() {
                    out[place] = pairs.score.value(p, q);
                    return;
                }
                one.resize(p.len(), Vec2::zero());
                other.resize(q.len(), Vec2::zero());
                let pulled = [&mut one[..], &mut other[..]];
                out[place] = pairs.score.vjp([p, q], up[place], pulled);
                let b_bars = &mut b_bars[b.offsets[j] - base..][..q.len()];
                add(a_bars, &one);
                add(b_bars, &other);
            });
        }
    });
    let mut at = 0;
    for sum in sums {
        let from = if pairs.all { 0 } else { at };
        add(&mut b_bars[from..], &sum);
        at += sum.len();
    }
    for bar in a_bars.iter_mut().chain(b_bars) {
        *bar = bar.canonical();
    }
    (out, bars)
}

/// Adds `from` to `to`, entry by entry.
fn add<T: Real>(to: &mut [Vec2<T>], from: &[Vec2<T>]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += *from;
    }
}
