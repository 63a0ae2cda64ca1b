//! Adjoints of the measures of a ring: one cotangent per vertex, written into the caller's slice.
use crate::ring::{Local, Measure, SIDE, signed_area};
use crate::{Mask, Scalar, Vec2};

/// Returns a vertex's derivatives at the nearest finite numbers.
#[inline(always)]
fn limited<S: Scalar>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x, y).saturated().canonical()
}

/// Writes a cotangent for every vertex, from it and its neighbours, each brought to its `place`
/// first.
#[inline(always)]
fn each_vertex<S: Scalar>(
    ring: &[Vec2<S>],
    ring_bar: &mut [Vec2<S>],
    place: impl Fn(Vec2<S>) -> Vec2<S>,
    derivative: impl Fn(Vec2<S>, Vec2<S>, Vec2<S>) -> Vec2<S>,
) {
    let n = ring.len();
    let ring_bar = &mut ring_bar[..n];
    if n == 0 {
        return;
    }
    let (origin, last) = (place(ring[0]), place(ring[n - 1]));
    ring_bar[0] = derivative(last, origin, place(ring[1 % n]));
    let (mut x, mut y) = ([S::zero(); SIDE + 2], [S::zero(); SIDE + 2]);
    let (mut x_bar, mut y_bar) = ([S::zero(); SIDE], [S::zero(); SIDE]);
    let mut first = 1;
    while first + SIDE < n {
        for (k, &vertex) in ring[first - 1..=first + SIDE].iter().enumerate() {
            let at = place(vertex);
            (x[k], y[k]) = (at.x, at.y);
        }
        let at = |k: usize| Vec2::new(x[k], y[k]);
        for k in 0..SIDE {
            let bar = derivative(at(k), at(k + 1), at(k + 2));
            (x_bar[k], y_bar[k]) = (bar.x, bar.y);
        }
        for (k, bar) in ring_bar[first..first + SIDE].iter_mut().enumerate() {
            *bar = Vec2::new(x_bar[k], y_bar[k]);
        }
        first += SIDE;
    }
    if first < n {
        let (mut before, mut here) = (place(ring[first - 1]), place(ring[first]));
        for i in first..n {
            let after = if i + 1 == n {
                origin
            } else {
                place(ring[i + 1])
            };
            ring_bar[i] = derivative(before, here, after);
            (before, here) = (here, after);
        }
    }
}

/// Writes the cotangents of [`signed_area`], one per vertex.
///
/// With `p` and `q` the vertices before and after: `v̄ = ā/2 (q_y − p_y, p_x − q_x)`.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
#[inline(always)]
pub fn signed_area_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
    // Halved first, since the whole difference may not be finite.
    each_vertex(ring, ring_bar, Vec2::halved, |before, _, after| {
        let across = after - before;
        limited(across.y * out_bar, -(across.x * out_bar))
    });
}

/// Writes the cotangents of [`perimeter`](crate::ring::perimeter), one per vertex.
///
/// Each edge pulls its ends apart along itself; an edge of length zero has no derivative.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
#[inline(always)]
pub fn perimeter_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
    if ring.is_empty() {
        return;
    }
    let local = Local::new(ring);
    each_vertex(
        ring,
        ring_bar,
        |v| local.place(v),
        |before, here, after| {
            let pull = (here - before).normalize_or_zero() + (here - after).normalize_or_zero();
            limited(pull.x * out_bar, pull.y * out_bar)
        },
    );
}

/// Writes the cotangents of [`centroid`](crate::ring::centroid), one per vertex.
///
/// With `k = p × q` and `m = p + q` of each edge, `T = Σ k`, `c = Σ m k / 3T` and
/// `w = (m · c̄ − 3 c · c̄) / 3T` of each edge:
/// `p̄ = Σ w (q_y, −q_x) + k c̄ / 3T` over the edges that leave the vertex, and
/// `q̄ = Σ w (−p_y, p_x) + k c̄ / 3T` over those that arrive.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
#[inline(always)]
pub fn centroid_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: Vec2<S>, ring_bar: &mut [Vec2<S>]) {
    if ring.is_empty() {
        return;
    }
    let local = Local::new(ring);
    let [twice, moment_x, moment_y] = local.sums(ring, |start, end| {
        let cross = start.perp_dot(end);
        let moment = (start + end) * cross;
        [cross, moment.x, moment.y]
    });
    let flat = twice.equals(S::zero());
    // An area next to nothing, or an enormous upstream derivative: then no term of a sum is larger than the
    // largest number, so that two of opposite sign leave a number.
    let large = S::largest_to(0.125);
    let tame = (twice.magnitude() * large).at_least(S::one())
        & (out_bar.x.magnitude().most(out_bar.y.magnitude())).at_most(large);
    let wild = !(tame | flat).all();
    let bounded = |x: S| if wild { x.saturated() } else { x };
    let dot = |a: Vec2<S>| bounded(a.x * out_bar.x) + bounded(a.y * out_bar.y);
    let per = bounded(S::one().over(S::lit(3.0) * S::select(flat, S::one(), twice)));
    let thrice_at = bounded(bounded(dot(Vec2::new(moment_x, moment_y))) * per * S::lit(3.0));
    let mean = S::one().over(S::lit(ring.len() as f64));
    let weight = |m: Vec2<S>| bounded((bounded(dot(m)) - thrice_at) * per);
    each_vertex(
        ring,
        ring_bar,
        |v| local.place(v),
        |before, here, after| {
            let (arrive, leave) = (weight(before + here), weight(here + after));
            let cross = bounded((before.perp_dot(here) + here.perp_dot(after)) * per);
            let pull = |arrive_at: S, leave_at: S, bar: S| {
                let two = bounded(arrive * arrive_at) + bounded(leave * leave_at);
                let solid = bounded(two) + bounded(cross * bar);
                S::select(flat, bar * mean, solid)
            };
            limited(
                pull(-before.y, after.y, out_bar.x),
                pull(before.x, -after.x, out_bar.y),
            )
        },
    );
}

impl<S: Scalar> Vec2<S> {
    #[inline(always)]
    fn halved(self) -> Self {
        Vec2::new(self.x.halved(), self.y.halved())
    }
}

/// Writes the cotangents of a [`Measure`] for those of its numbers, one per vertex.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`, or there are fewer cotangents than numbers.
#[inline(always)]
pub fn measure_vjp<S: Scalar>(
    measure: Measure,
    ring: &[Vec2<S>],
    out_bar: &[S],
    ring_bar: &mut [Vec2<S>],
) {
    match measure {
        Measure::SignedArea => signed_area_vjp(ring, out_bar[0], ring_bar),
        Measure::Area => {
            let (area, zero) = (signed_area(ring), S::zero());
            let turned = S::select(area.equals(zero), zero, out_bar[0].signed_as(area));
            signed_area_vjp(ring, turned, ring_bar);
        }
        Measure::Perimeter => perimeter_vjp(ring, out_bar[0], ring_bar),
        Measure::Centroid => centroid_vjp(ring, Vec2::new(out_bar[0], out_bar[1]), ring_bar),
    }
}
