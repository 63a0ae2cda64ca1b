//! Adjoints of the measures of a ring: one cotangent per vertex, written into the caller's slice.
use crate::ring::Local;
use crate::{Scalar, Vec2};

/// A vertex's slopes at the nearest finite numbers.
#[inline(always)]
fn limited<S: Scalar>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x.saturated(), y.saturated())
}

/// The vertices before and after each one, in the local frame.
#[inline(always)]
fn neighbours<S: Scalar>(local: &Local<'_, S>, n: usize, i: usize) -> (Vec2<S>, Vec2<S>) {
    (
        local.at(if i == 0 { n - 1 } else { i - 1 }),
        local.at(local.after(i)),
    )
}

/// Adjoint of [`signed_area`](crate::ring::signed_area); writes one cotangent per vertex.
///
/// With `p` and `q` the vertices before and after: `v̄ = ā/2 (q_y − p_y, p_x − q_x)`.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
pub fn signed_area_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
    let (local, n) = (Local::new(ring), ring.len());
    for (i, bar) in ring_bar[..n].iter_mut().enumerate() {
        let (before, after) = neighbours(&local, n, i);
        let across = (after - before).halved();
        *bar = limited(
            local.outer(across.y) * out_bar,
            -(local.outer(across.x) * out_bar),
        );
    }
}

/// Adjoint of [`perimeter`](crate::ring::perimeter); writes one cotangent per vertex.
///
/// Each edge pulls its ends apart along itself; an edge of length zero does not pull.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
pub fn perimeter_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: S, ring_bar: &mut [Vec2<S>]) {
    let (local, n) = (Local::new(ring), ring.len());
    for (i, bar) in ring_bar[..n].iter_mut().enumerate() {
        let (before, after) = neighbours(&local, n, i);
        let here = local.at(i);
        let pull = (here - before).normalize_or_zero() + (here - after).normalize_or_zero();
        *bar = pull * out_bar;
    }
}

/// Adjoint of [`centroid`](crate::ring::centroid); writes one cotangent per vertex.
///
/// With `k = p × q` and `m = p + q` of each edge, `T = Σ k`, `c = Σ m k / 3T` and
/// `w = (m · c̄ − 3 c · c̄) / 3T` of each edge:
/// `p̄ = Σ w (q_y, −q_x) + k c̄ / 3T` over the edges that leave the vertex, and
/// `q̄ = Σ w (−p_y, p_x) + k c̄ / 3T` over those that arrive.
///
/// # Panics
///
/// When `ring_bar` is shorter than `ring`.
pub fn centroid_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: Vec2<S>, ring_bar: &mut [Vec2<S>]) {
    let (local, n) = (Local::new(ring), ring.len());
    if n == 0 {
        return;
    }
    let (mut twice, mut moment) = (S::zero(), Vec2::zero());
    for (start, end) in local.edges() {
        let cross = start.perp_dot(end);
        twice += cross;
        moment += (start + end) * cross;
    }
    let flat = twice.equals(S::zero());
    let per = S::one().over(S::lit(3.0) * S::select(flat, S::one(), twice));
    let thrice_at = moment.dot(out_bar) * per * S::lit(3.0);
    let mean = S::one().over(S::lit(n as f64));
    for (i, bar) in ring_bar[..n].iter_mut().enumerate() {
        let (before, after) = neighbours(&local, n, i);
        let here = local.at(i);
        let weight = |m: Vec2<S>| (m.dot(out_bar) - thrice_at) * per;
        let (arrive, leave) = (weight(before + here), weight(here + after));
        let cross = (before.perp_dot(here) + here.perp_dot(after)) * per;
        let pull = |arrive_at: S, leave_at: S, bar: S| {
            let solid = arrive * arrive_at + leave * leave_at + cross * bar;
            S::select(flat, bar * mean, solid)
        };
        *bar = limited(
            pull(-before.y, after.y, out_bar.x),
            pull(before.x, -after.x, out_bar.y),
        );
    }
}

impl<S: Scalar> Vec2<S> {
    #[inline(always)]
    fn halved(self) -> Self {
        Vec2::new(self.x.halved(), self.y.halved())
    }
}
