//! Block kernels of rings: small ones side by side, one ring per lane; long ones one after another.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::real::Real;
use crate::ring::Measured;
use crate::{Mask, Vec2, ad, ring};

/// A measure of a ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// [`signed_area`](crate::ring::signed_area).
    SignedArea,
    /// [`perimeter`](crate::ring::perimeter).
    Perimeter,
    /// [`centroid`](crate::ring::centroid).
    Centroid,
}

impl Measure {
    /// Numbers per result.
    pub const fn fields(self) -> usize {
        match self {
            Measure::SignedArea | Measure::Perimeter => 1,
            Measure::Centroid => 2,
        }
    }
}

/// Rings of at most so many vertices are measured side by side. Longer ones keep sixteen sums, which
/// would make the order of additions another.
const SMALL: usize = ring::SIDE;

/// One result per ring; ring `i` has the vertices `offsets[i]..offsets[i + 1]`.
#[inline(always)]
pub(crate) fn values<T: Real, V: Vector<T>>(
    measure: Measure,
    vertices: &[Vec2<T>],
    offsets: &[usize],
    out: &mut [T],
) {
    let fields = measure.fields();
    let rings = offsets.len().saturating_sub(1);
    let is_small = |i: usize| matches!(offsets[i + 1] - offsets[i], 1..=SMALL);
    let mut first = 0;
    while first < rings {
        let whole = (first..rings.min(first + V::WIDTH)).take_while(|&i| is_small(i));
        let side = whole.count();
        let out = &mut out[first * fields..];
        if side == V::WIDTH {
            let ends = &offsets[first..=first + side];
            side_by_side::<T, V>(measure, vertices, ends, out);
            first += side;
            continue;
        }
        let own = &vertices[offsets[first]..offsets[first + 1]];
        one::<T>(measure, own, out);
        first += 1;
    }
}

/// The result of one ring.
#[inline(always)]
fn one<T: Real>(measure: Measure, vertices: &[Vec2<T>], out: &mut [T]) {
    match measure {
        Measure::SignedArea => out[0] = ring::signed_area(vertices),
        Measure::Perimeter => out[0] = ring::perimeter(vertices),
        Measure::Centroid => {
            let center = ring::centroid(vertices);
            (out[0], out[1]) = (center.x, center.y);
        }
    }
}

/// Results of as many rings as there are lanes, none empty, none long. Shorter rings repeat their
/// last vertex, which adds edges of length zero and changes no sum.
#[inline(always)]
fn side_by_side<T: Real, V: Vector<T>>(
    measure: Measure,
    vertices: &[Vec2<T>],
    ends: &[usize],
    out: &mut [T],
) {
    let mut longest = 0;
    for ring in ends.windows(2) {
        longest = longest.max(ring[1] - ring[0]);
    }
    let mut x = [Lane([T::default(); TILE]); SMALL];
    let mut y = x;
    for (lane, ring) in ends.windows(2).enumerate() {
        let ring = &vertices[ring[0]..ring[1]];
        for k in 0..longest {
            let at = ring[k.min(ring.len() - 1)];
            (x[k].0[lane], y[k].0[lane]) = (at.x, at.y);
        }
    }
    let mut room = Lane([T::default(); TILE]);
    match measure {
        Measure::SignedArea => {
            ring::signed_area_of(
                longest,
                #[inline(always)]
                |k| Vec2::new(V::read(&x[k % SMALL], 0), V::read(&y[k % SMALL], 0)),
            )
            .write(&mut room, 0);
            out[..V::WIDTH].copy_from_slice(&room.0[..V::WIDTH]);
        }
        Measure::Perimeter => {
            ring::perimeter_of(
                longest,
                #[inline(always)]
                |k| Vec2::new(V::read(&x[k % SMALL], 0), V::read(&y[k % SMALL], 0)),
            )
            .write(&mut room, 0);
            out[..V::WIDTH].copy_from_slice(&room.0[..V::WIDTH]);
        }
        Measure::Centroid => {
            let Measured { value, flat } = ring::centroid_of(
                longest,
                #[inline(always)]
                |k| Vec2::new(V::read(&x[k % SMALL], 0), V::read(&y[k % SMALL], 0)),
            );
            let mut more = room;
            value.x.write(&mut room, 0);
            value.y.write(&mut more, 0);
            for (lane, out) in out.chunks_exact_mut(2).take(V::WIDTH).enumerate() {
                (out[0], out[1]) = (room.0[lane], more.0[lane]);
            }
            // Repeated vertices would count in the mean that stands for the centroid of nothing.
            if flat.any() {
                for (lane, ring) in ends.windows(2).enumerate() {
                    let ring = &vertices[ring[0]..ring[1]];
                    one::<T>(measure, ring, &mut out[2 * lane..]);
                }
            }
        }
    }
}

/// Adjoints: one cotangent per vertex of the rings, from one upstream slope per result.
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
        match measure {
            Measure::SignedArea => ad::ring::signed_area_vjp(ring, out_bar[0], bars),
            Measure::Perimeter => ad::ring::perimeter_vjp(ring, out_bar[0], bars),
            Measure::Centroid => {
                ad::ring::centroid_vjp(ring, Vec2::new(out_bar[0], out_bar[1]), bars);
            }
        }
    }
}

/// Whether every vertex is finite.
#[inline(always)]
pub(crate) fn all_finite<T: Real, V: Vector<T>>(vertices: &[Vec2<T>]) -> bool {
    vertices
        .iter()
        .fold(true, |all, v| all & v.x.finite() & v.y.finite())
}
