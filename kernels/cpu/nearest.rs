//! A block kernel of points and paths: the candidates for the nearest edge, and the winding number.
//!
//! Squared distances, with a bound of their rounding errors, exclude most edges. Only the remaining edges are folded
//! with derivatives. The result has the bits of the fold over all edges, for every vector width.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::kernels::cpu::arch::{Vector, flat};
use crate::kernels::cpu::lane::{Lane, TILE, tiles};
use crate::{Real, Scalar, Vec2};

/// The limits within which squared distances and signs are reliable.
#[derive(Clone, Copy, Debug)]
pub struct ReliableLimits<T> {
    /// The largest distance of a vertex from the point.
    far: T,
    /// The smallest distance of the farthest vertex from the point.
    near: T,
    /// The squared length up to which an edge is replaced by its ends, since it is shorter than the rounding error.
    short: T,
    /// The smallest magnitude of a product whose sign is reliable.
    doubt: T,
}

impl<T: Real> ReliableLimits<T> {
    pub(crate) fn new() -> Self {
        let power = |exponent: f64| T::largest_to(exponent);
        ReliableLimits {
            far: power(0.39),
            near: power(-0.26),
            short: power(-0.83),
            doubt: power(-0.8),
        }
    }
}

/// The rounding error of a distance, in units of ε times the farthest coordinate. Both formulas of a distance err by
/// less than half of it. Each of their two products and quotients of vectors has a few roundings of a length below
/// `2√2` such units; the ends of an edge have two more.
const SLACK: f64 = 64.0;

/// The state after some edges.
struct NearestState<S> {
    /// The least squared distance.
    least: S,
    /// The farthest coordinate of a vertex.
    extent: S,
    /// The edges that decide the winding number.
    passes: Passes<S>,
}

/// The edges that pass a point on its right.
pub(crate) struct Passes<S> {
    /// How many more of them go up than down.
    winding: S,
    /// The least magnitude of the products whose signs decided it.
    doubt: S,
}

impl<S: Scalar> Passes<S> {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Passes {
            winding: S::zero(),
            doubt: S::lit(S::format().largest()),
        }
    }
    /// Counts the edge from a to b, seen from the point.
    #[inline(always)]
    pub(crate) fn see(&mut self, a: Vec2<S>, b: Vec2<S>) {
        let (zero, one) = (S::zero(), S::one());
        // Up to a power of two this is the number whose sign the fold uses.
        let side = a.perp_dot(b);
        let up = a.y.at_most(zero) & zero.below(b.y);
        let down = b.y.at_most(zero) & zero.below(a.y);
        let turns = S::select(
            up & side.above(zero),
            one,
            S::select(down & side.below(zero), -one, zero),
        );
        self.winding += turns;
        self.doubt = self.doubt.least(S::select(
            up | down,
            side.unsigned(),
            S::lit(S::format().largest()),
        ));
    }
    /// Joins what the lanes of a vector have seen.
    #[inline(always)]
    pub(crate) fn folded<T: Real>(self) -> Passes<T>
    where
        S: Vector<T>,
    {
        let mut lanes = [Lane::default(); 2];
        self.winding.write(&mut lanes[0], 0);
        self.doubt.write(&mut lanes[1], 0);
        let mut all = Passes::<T>::none();
        let mut k = 0;
        while k < S::WIDTH {
            all.winding += lanes[0].0[k];
            all.doubt = all.doubt.least(lanes[1].0[k]);
            k += 1;
        }
        all
    }
}

impl<T: Real> Passes<T> {
    /// Returns the winding number; `None` where a sign is unreliable. `extent` is the farthest coordinate of a vertex.
    #[inline(always)]
    pub(crate) fn reliable(&self, extent: T, limits: ReliableLimits<T>) -> Option<T> {
        let is_ordinary = extent.below(limits.far)
            & limits.near.below(extent)
            & limits.doubt.below(self.doubt)
            & (T::lit(4.0 / T::format().largest()) * extent * extent).below(self.doubt);
        is_ordinary.then_some(self.winding)
    }
}

impl<S: Scalar> NearestState<S> {
    #[inline(always)]
    fn nothing() -> Self {
        NearestState {
            least: S::lit(S::format().largest()),
            extent: S::zero(),
            passes: Passes::none(),
        }
    }
    /// Updates the state with the edge from a to b, seen from the origin. Returns its squared distance. An edge of
    /// squared length up to `short` is replaced by its ends.
    #[inline(always)]
    fn see(&mut self, a: Vec2<S>, b: Vec2<S>, short: S) -> S {
        let (zero, one) = (S::zero(), S::one());
        let along = b - a;
        let square = along.length_squared();
        let (ahead, turn) = (-a.dot(along), a.perp_dot(along));
        let is_inside = zero.below(ahead) & ahead.below(square) & short.below(square);
        let across = turn.over(S::select(is_inside, square, one)) * turn;
        let (start, end) = (a.length_squared(), b.length_squared());
        let distance = S::select(is_inside, across, start.least(end));
        self.passes.see(a, b);
        self.extent = self.extent.most(a.x.unsigned().most(a.y.unsigned()));
        self.least = self.least.least(distance);
        distance
    }
}

/// A path in columns: its vertices up to the one after the last edge, with padding for the last lane and one more.
#[derive(Debug, Default)]
pub struct Edges<T> {
    x: Vec<Lane<T>>,
    y: Vec<Lane<T>>,
    /// The number of edges.
    pub(crate) count: usize,
}

impl<T: Real> Edges<T> {
    /// Replaces the path by another one, closed or not.
    pub(crate) fn set(&mut self, path: &[Vec2<T>], closed: bool) {
        self.count = path.len() - usize::from(!closed && !path.is_empty());
        let lanes = tiles(self.count) + 1;
        if self.x.len() < lanes {
            self.x.resize(lanes, Lane::default());
            self.y.resize(lanes, Lane::default());
        }
        let (whole, rest) = path.as_chunks::<TILE>();
        for ((x, y), vertices) in self.x.iter_mut().zip(&mut self.y).zip(whole) {
            for ((x, y), vertex) in x.0.iter_mut().zip(&mut y.0).zip(vertices) {
                (*x, *y) = (vertex.x, vertex.y);
            }
        }
        let Some(&end) = (if closed { path.first() } else { path.last() }) else {
            return;
        };
        for at in whole.len() * TILE..lanes * TILE {
            let vertex = *rest.get(at - whole.len() * TILE).unwrap_or(&end);
            self.x[at / TILE].0[at % TILE] = vertex.x;
            self.y[at / TILE].0[at % TILE] = vertex.y;
        }
    }
}

/// Returns the lane of the numbers that begin one place after lane `t`.
#[inline(always)]
fn later<T: Real>(lanes: &[Lane<T>], t: usize) -> Option<Lane<T>> {
    Some(Lane(*flat(lanes).get(t * TILE + 1..)?.first_chunk()?))
}

/// Lists the edges of a path that can be nearest to a point, in order. Returns their number and the path's winding
/// number, or `None` where squared distances or signs are unreliable. `squares` and `picked` have room for sixteen more
/// numbers than edges.
#[inline(always)]
pub(crate) fn near_edges<T: Real, V: Vector<T>>(
    point: Vec2<T>,
    path: &Edges<T>,
    limits: ReliableLimits<T>,
    squares: &mut [Lane<T>],
    picked: &mut [u32],
) -> Option<(usize, T)> {
    let origin = Vec2::new(V::splat(point.x), V::splat(point.y));
    let short = V::splat(limits.short);
    let mut all = NearestState::<V>::nothing();
    let columns = path.x.iter().zip(&path.y).take(tiles(path.count));
    for (t, ((x, y), square)) in columns.zip(squares.iter_mut()).enumerate() {
        let (next_x, next_y) = (later(&path.x, t)?, later(&path.y, t)?);
        let mut at = 0;
        while at < TILE {
            let a = Vec2::new(V::read(x, at), V::read(y, at)) - origin;
            let b = Vec2::new(V::read(&next_x, at), V::read(&next_y, at)) - origin;
            all.see(a, b, short).write(square, at);
            at += V::WIDTH;
        }
    }
    let mut lanes = [Lane::default(); 2];
    all.least.write(&mut lanes[0], 0);
    all.extent.write(&mut lanes[1], 0);
    let mut seen = NearestState::<T>::nothing();
    let mut k = 0;
    while k < V::WIDTH {
        seen.least = seen.least.least(lanes[0].0[k]);
        seen.extent = seen.extent.most(lanes[1].0[k]);
        k += 1;
    }
    let extent = seen.extent;
    let winding = all.passes.folded::<T>().reliable(extent, limits)?;
    let reach = seen.least.root() + T::lit(2.0 * SLACK * T::format().epsilon()) * extent;
    let limit = V::splat(reach * reach * T::lit(1.0 + 16.0 * T::format().epsilon()));
    let mut count = 0;
    for (t, lane) in squares.iter().enumerate().take(tiles(path.count)) {
        let mut at = 0;
        while at < TILE {
            let mut bits = V::bits(V::read(lane, at).at_most(limit));
            while bits != 0 {
                let edge = t * TILE + at + bits.trailing_zeros() as usize;
                // The padding of the last lane repeats the last vertex.
                if let (true, Some(place)) = (edge < path.count, picked.get_mut(count)) {
                    *place = edge as u32;
                    count += 1;
                }
                bits &= bits - 1;
            }
            at += V::WIDTH;
        }
    }
    Some((count, winding))
}
