//! Block kernels of rings: one short ring per lane, or one long ring at a time; and of the edges of polylines.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::blocks::all_finite;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::row::item::memory;
pub use crate::ring::Measure;
use crate::ring::{Measured, Vertices};
use crate::{Mask, Real, Vec2, ad, ring};

/// The largest number of vertices of a ring that shares a vector with others. Longer rings use sixteen partial sums,
/// which is another order of additions.
const SMALL: usize = ring::SIDE;

/// Writes the measures of every ring: ring `i` has the vertices `offsets[i]..offsets[i + 1]`. Returns `false` if a
/// vertex is not finite; the measures are then arbitrary.
#[inline(always)]
pub(crate) fn values<T: Real, V: Vector<T>>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    out: &mut [T],
) -> bool {
    let fields = measure.fields();
    let rings = offsets.len().saturating_sub(1);
    let empty = Lane([T::default(); TILE]);
    let mut side = RingLanes {
        x: [empty; SMALL],
        y: [empty; SMALL],
        count: 0,
    };
    let mut first = 0;
    // The number of rings that follow and are measured one at a time.
    let mut alone = 0;
    while first < rings {
        let out = &mut out[first * fields..];
        if alone == 0
            && let Some(ends) = offsets[first..].get(..=V::WIDTH)
        {
            let mut small = true;
            for ring in ends.windows(2) {
                let count = ring[1] - ring[0];
                small &= (0 < count) & (count <= SMALL);
            }
            if small {
                side.fill::<V>(vertices, ends);
                // The vertices in tiles are tested there. An infinite sum of finite numbers is recognised later.
                let own = vertices.get(ends[0]..ends[V::WIDTH]).unwrap_or_default();
                if !side.is_finite::<V>() && !finite::<T, V>(own) {
                    return false;
                }
                if side_by_side::<T, V>(measure, &side, out) {
                    first += V::WIDTH;
                    continue;
                }
                alone = V::WIDTH;
            }
        }
        alone = alone.saturating_sub(1);
        let own = vertices
            .get(offsets[first]..offsets[first + 1])
            .unwrap_or_default();
        if !finite::<T, V>(own) {
            return false;
        }
        measure.write(own, out);
        first += 1;
    }
    true
}

/// Returns `true` if every vertex is finite.
#[inline(always)]
fn finite<T: Real, V: Vector<T>>(vertices: &[Vec2<T>]) -> bool {
    match memory::lent(vertices) {
        Some(numbers) => all_finite::<T, V>(numbers),
        None => vertices.iter().all(|v| v.x.finite() && v.y.finite()),
    }
}

/// The vertices of as many rings as there are lanes, one ring per lane.
struct RingLanes<T> {
    x: [Lane<T>; SMALL],
    y: [Lane<T>; SMALL],
    /// The most vertices of a ring.
    count: usize,
}

impl<T: Real> RingLanes<T> {
    /// Fills the lanes from short rings of at least one vertex. Shorter ones repeat their last vertex, which adds edges
    /// of length zero and changes no sum.
    #[inline(always)]
    fn fill<V: Vector<T>>(&mut self, vertices: &[Vec2<T>], ends: &[usize]) {
        let count = ends[1] - ends[0];
        let mut same = true;
        for ring in ends.windows(2) {
            same &= ring[1] - ring[0] == count;
        }
        if same {
            // Rings of equal size are the usual case.
            self.count = count;
            let all = memory::lent(vertices).unwrap_or_default();
            let own = all.get(2 * ends[0]..).unwrap_or_default();
            let done = match count {
                3 => self.fill_same::<V, 6>(own),
                4 => self.fill_same::<V, 8>(own),
                5 => self.fill_same::<V, 10>(own),
                6 => self.fill_same::<V, 12>(own),
                7 => self.fill_same::<V, 14>(own),
                8 => self.fill_same::<V, 16>(own),
                12 => self.fill_same::<V, 24>(own),
                16 => self.fill_same::<V, 32>(own),
                _ => None,
            };
            if done.is_some() {
                return;
            }
        }
        let sizes = ends.windows(2).map(|ring| ring[1] - ring[0]);
        self.count = sizes.fold(0, usize::max);
        for (lane, ring) in ends.windows(2).enumerate() {
            let ring = &vertices[ring[0]..ring[1]];
            for k in 0..self.count {
                let at = ring[k.min(ring.len() - 1)];
                (self.x[k].0[lane], self.y[k].0[lane]) = (at.x, at.y);
            }
        }
    }
    /// Returns `true` if every vertex is finite. It returns `false` also when finite vertices have an infinite sum.
    #[inline(always)]
    fn is_finite<V: Vector<T>>(&self) -> bool {
        let (mut x, mut y) = (V::zero(), V::zero());
        for k in 0..self.count {
            x += V::read(&self.x[k % SMALL], 0);
            y += V::read(&self.y[k % SMALL], 0);
        }
        let sum = x + y;
        // A finite number minus itself is zero, any other one minus itself is NaN.
        #[allow(clippy::eq_op)]
        let nothing = sum - sum;
        nothing.equals(V::zero()).all()
    }
    /// Fills the lanes from rings of `NUMBERS` coordinates each, two vertices at a time.
    #[inline(always)]
    fn fill_same<V: Vector<T>, const NUMBERS: usize>(&mut self, numbers: &[T]) -> Option<()> {
        let rings = numbers.as_chunks::<NUMBERS>().0.get(..V::WIDTH)?;
        let mut k = 0;
        while 2 * k < NUMBERS {
            // The last pair of vertices may overlap the one before.
            let at = if 2 * k + 4 > NUMBERS {
                NUMBERS - 4
            } else {
                2 * k
            };
            let [x, y, next_x, next_y] = V::from_items(
                #[inline(always)]
                |i| match rings[i][at..].first_chunk() {
                    Some(two) => *two,
                    None => [T::default(); 4],
                },
            );
            x.write(&mut self.x[at / 2], 0);
            y.write(&mut self.y[at / 2], 0);
            next_x.write(&mut self.x[at / 2 + 1], 0);
            next_y.write(&mut self.y[at / 2 + 1], 0);
            k += 2;
        }
        Some(())
    }
}

impl<T: Real, V: Vector<T>> Vertices<V> for &RingLanes<T> {
    #[inline(always)]
    fn count(self) -> usize {
        self.count
    }
    #[inline(always)]
    fn at(self, k: usize) -> Vec2<V> {
        Vec2::new(
            V::read(&self.x[k % SMALL], 0),
            V::read(&self.y[k % SMALL], 0),
        )
    }
    #[inline(always)]
    fn slice(&self) -> &[Vec2<V>] {
        &[]
    }
}

/// Writes the results of as many rings as there are lanes. Returns `false` if each ring must be measured alone.
#[inline(always)]
fn side_by_side<T: Real, V: Vector<T>>(
    measure: Measure,
    side: &RingLanes<T>,
    out: &mut [T],
) -> bool {
    let mut room = Lane([T::default(); TILE]);
    match measure {
        Measure::SignedArea => {
            let area: V = ring::signed_area_of(side);
            area.write(&mut room, 0);
            out[..V::WIDTH].copy_from_slice(&room.0[..V::WIDTH]);
        }
        Measure::Area => {
            let area: V = ring::signed_area_of(side);
            area.magnitude().write(&mut room, 0);
            out[..V::WIDTH].copy_from_slice(&room.0[..V::WIDTH]);
        }
        Measure::Perimeter => {
            let perimeter: V = ring::perimeter_of(side);
            perimeter.write(&mut room, 0);
            out[..V::WIDTH].copy_from_slice(&room.0[..V::WIDTH]);
        }
        Measure::Centroid => {
            let Measured::<V> { value, flat } = ring::centroid_of(side);
            let mut more = room;
            value.x.write(&mut room, 0);
            value.y.write(&mut more, 0);
            for (lane, out) in out.chunks_exact_mut(2).take(V::WIDTH).enumerate() {
                (out[0], out[1]) = (room.0[lane], more.0[lane]);
            }
            // A ring without area has the mean of its vertices as centroid, in which repeated ones would count.
            return !flat.any();
        }
    }
    true
}

/// Writes the adjoints: one cotangent per vertex, from one upstream derivative per result.
#[inline(always)]
pub(crate) fn bars<T: Real, V: Vector<T>>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    upstream: &[T],
    bars: &mut [Vec2<T>],
) {
    let base = offsets.first().copied().unwrap_or(0);
    let upstream = upstream.chunks_exact(measure.fields());
    for (ring, out_bar) in offsets.windows(2).zip(upstream) {
        let bars = &mut bars[ring[0] - base..ring[1] - base];
        let ring = &vertices[ring[0]..ring[1]];
        ad::adjoint::ring::measure_vjp(measure, ring, out_bar, bars);
    }
}

/// Writes the distance of every vertex from the one before: one number less than vertices.
///
/// Squares of ordinary numbers need no scale: it is a power of two, so that results have the bits of
/// [`length`](Vec2::length) without it.
#[inline(always)]
pub(crate) fn edge_lengths<T: Real, V: Vector<T>>(vertices: &[T], out: &mut [T]) {
    // Squares of such numbers are normal, and smaller ones beside them change no digit.
    let (small, large) = (
        V::splat(T::largest_to(-0.25)),
        V::splat(T::largest_to(0.25)),
    );
    let (mut whole, mut first) = (out.chunks_exact_mut(V::WIDTH), 0);
    for out in whole.by_ref() {
        let own = &vertices[2 * first..][..2 * V::WIDTH + 2];
        let [x, y, next_x, next_y] = V::from_items(
            #[inline(always)]
            |i| match own[2 * i..].first_chunk() {
                Some(edge) => *edge,
                None => [T::default(); 4],
            },
        );
        let mut lane = Lane([T::default(); TILE]);
        let along = Vec2::new(next_x, next_y) - Vec2::new(x, y);
        let most = along.x.unsigned().most(along.y.unsigned());
        let is_ordinary = small.below(most) & most.below(large);
        let length = match is_ordinary.all() {
            true => along.length_squared().root(),
            false => along.length(),
        };
        length.write(&mut lane, 0);
        out.copy_from_slice(&lane.0[..V::WIDTH]);
        first += V::WIDTH;
    }
    let rest = vertices[2 * first..].windows(4).step_by(2);
    for (out, edge) in whole.into_remainder().iter_mut().zip(rest) {
        *out = Vec2::new(edge[2] - edge[0], edge[3] - edge[1]).length();
    }
}

/// Returns `true` if offsets never decrease and none exceeds the number of vertices.
#[inline(always)]
pub(crate) fn never_decreases<T: Real, V: Vector<T>>(offsets: &[usize], vertices: usize) -> bool {
    let rises = offsets
        .windows(2)
        .fold(true, |all, pair| all & (pair[0] <= pair[1]));
    rises & offsets.last().is_none_or(|&last| last <= vertices)
}
