//! Adjoint of the area of a clipped border, by Reynolds' transport theorem.
//!
//! When shapes move, an area of intersection changes by the integral of the normal velocity over
//! its moving border. Only two kinds of border move: the parts of b's edges inside a, and the parts
//! of a's sides inside b. Both are lengths (and for the heading first moments) that the clipped
//! border already has. No intersection point is differentiated, and nothing is divided by the sine
//! of the angle between two edges.
//!
//! A side of b may lie exactly along one of a. The shared stretch then counts half for each: the mean
//! of both sides of the kink.
//!
//! Its functions are internal; those of [`overlap`](super::overlap) call them.
use crate::clip::{Clip, End, Relative};
use crate::{Mask, Scalar, Vec2};

/// Derivatives of an area of intersection, in a's frame and the units of the related pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Derivatives<S> {
    /// With respect to b's centre, a standing still.
    pub u: S,
    /// With respect to b's centre, a standing still.
    pub v: S,
    /// With respect to b's heading, about b's own centre.
    pub heading: S,
    /// With respect to half the size of a.
    pub half_a: Vec2<S>,
    /// With respect to half the size of b.
    pub half_b: Vec2<S>,
}

/// Returns the heights at which an upright edge from `low` to `high` enters and leaves a. If both ends are beyond one
/// side, both crossings are at the upper end.
#[inline(always)]
fn crossings<S: Scalar>(low: S, high: S, lower: End<S>, upper: End<S>, steepness: S) -> (S, S) {
    let out = (lower.beyond * upper.beyond).above(S::zero());
    let enter = crossing(low, low, high, lower.beyond * steepness, out);
    let leave = crossing(high, low, high, upper.beyond * steepness, out);
    (
        S::select(lower.beyond.equals(S::zero()), low, enter),
        S::select(upper.beyond.equals(S::zero()), high, leave),
    )
}

/// Returns a height within bounds; the upper one for an edge that runs outside.
#[inline(always)]
fn crossing<S: Scalar>(from: S, low: S, high: S, rise: S, out: S::Mask) -> S {
    let at = from + rise;
    let at = S::select(at.below(low), low, at);
    S::select(out | at.above(high), high, at)
}

/// Returns the height of a that an edge to the left or right of it covers: the part beyond a's right side minus the
/// part beyond the left one, from the edge's first end to its last.
///
/// An edge with both ends beyond one side covers its whole `rise`. The distances beyond the side do not give it: for a
/// tiny box in a huge one both are so large that their difference has no digits left.
#[inline(always)]
fn beside<S: Scalar>(out: S::Mask, [first, last]: [End<S>; 2], rise: S, derivative: S) -> S {
    let one_side = (first.beyond * last.beyond).above(S::zero());
    let covered = S::select(
        one_side,
        rise.signed_as(last.beyond),
        (last.beyond.unsigned() - first.beyond.unsigned()) * derivative,
    );
    S::select(out, S::zero(), covered)
}

/// Returns the length of a's top and bottom inside b that an edge adds: the x at which it returns below
/// (above) minus the x at which it leaves.
#[inline(always)]
fn between<S: Scalar>(out: S::Mask, from: S, start: End<S>, to: S, end: End<S>) -> S {
    S::select(
        out,
        S::zero(),
        end.x.signed_as(to) - start.x.signed_as(from),
    )
}

/// Returns half of `whole` where an edge lies along one of two sides of a, else zero.
#[inline(always)]
fn half_along<S: Scalar>(parallel: S::Mask, at: S, beyond: S, low: S, high: S, whole: S) -> S {
    let along = beyond.equals(S::zero()) & (at.equals(low) | at.equals(high));
    S::select(parallel & along, whole.halved(), S::zero())
}

/// Returns the derivatives of [`clipped_area`](crate::clip::clipped_area).
///
/// With `W` the length in x of the bottom and top edge inside a, `H` the length in y of the right
/// and left edge inside a, `t = tan` of the relative heading, `c` its cosine:
///
/// ```text
/// ∂u = H_right − H_left − t (W_top − W_bottom)      ∂v = W_top − W_bottom + t (H_right − H_left)
/// ∂p = (H_right + H_left) / c                       ∂q = (W_top + W_bottom) / c
/// ∂θ = Σ ± (length inside) · (its middle, along the edge from b's centre)
/// ```
///
/// `∂hx` is the length of a's right and left side inside b: from every edge of b the height of
/// what lies beyond them. `∂hy` is the length of a's top and bottom side inside b: the x between
/// the two edges that leave a corner of b beyond them.
#[inline(always)]
pub(crate) fn clipped_area_derivatives<S: Scalar>(
    pair: &Relative<S>,
    clip: &Clip<S>,
) -> Derivatives<S> {
    let zero = S::zero();
    let [_, ps, _, qs] = clip.arms;
    let (y, above, steepness) = (clip.y, clip.above, clip.steepness);
    let derivative = pair.sin.over(pair.cos);
    let length = S::one().over(pair.cos);

    // Edges that run above or below a, with both ends on one side, share nothing with it.
    let bottom_out = (above[0] * above[1]).above(zero);
    let top_out = (above[2] * above[3]).above(zero);
    let mut width_bottom = S::select(bottom_out, zero, clip.bottom[1].x - clip.bottom[0].x);
    let mut width_top = S::select(top_out, zero, clip.top[0].x - clip.top[1].x);

    let (right_enter, right_leave) = crossings(y[1], y[2], clip.right[0], clip.right[1], steepness);
    let (left_enter, left_leave) = crossings(y[0], y[3], clip.left[1], clip.left[0], steepness);
    let mut height_right = right_leave - right_enter;
    let mut height_left = left_leave - left_enter;

    // a's right and left side inside b.
    let flat = beside(bottom_out, clip.bottom, y[1] - y[0], derivative)
        + beside(top_out, clip.top, y[3] - y[2], derivative);
    let upright = ((right_enter - y[1]).signed_as(clip.right[0].beyond)
        + (y[2] - right_leave).signed_as(clip.right[1].beyond))
        - ((left_enter - y[0]).signed_as(clip.left[1].beyond)
            + (y[3] - left_leave).signed_as(clip.left[0].beyond));
    let mut side_x = flat + upright;

    // a's top and bottom side inside b.
    let right_out = (above[1] * above[2]).above(zero);
    let left_out = (above[3] * above[0]).above(zero);
    let mut side_y = (between(
        bottom_out,
        above[0],
        clip.bottom[0],
        above[1],
        clip.bottom[1],
    ) + between(top_out, above[2], clip.top[0], above[3], clip.top[1]))
        + (between(right_out, above[1], clip.right[0], above[2], clip.right[1])
            + between(left_out, above[3], clip.left[0], above[0], clip.left[1]));

    if pair.parallel.any() {
        let (low, high) = (clip.low, clip.high);
        let half_bottom = half_along(pair.parallel, y[0], above[0], low.y, high.y, width_bottom);
        let half_top = half_along(pair.parallel, y[2], above[2], low.y, high.y, width_top);
        let [right, left] = [clip.right[0], clip.left[0]];
        let half_right = half_along(
            pair.parallel,
            right.x,
            right.beyond,
            low.x,
            high.x,
            height_right,
        );
        let half_left = half_along(
            pair.parallel,
            left.x,
            left.beyond,
            low.x,
            high.x,
            height_left,
        );
        width_bottom -= half_bottom;
        width_top -= half_top;
        height_right -= half_right;
        height_left -= half_left;
        side_y += half_bottom + half_top;
        side_x += half_right + half_left;
    }

    // Middles of the parts inside, along each edge from its own middle.
    let middle_bottom = (clip.bottom[0].x + clip.bottom[1].x).halved() - (clip.u + qs);
    let middle_top = (clip.top[0].x + clip.top[1].x).halved() - (clip.u - qs);
    let middle_right = (right_enter + right_leave).halved() - (clip.v + ps);
    let middle_left = (left_enter + left_leave).halved() - (clip.v - ps);
    let moment = (width_top * middle_top - width_bottom * middle_bottom)
        + (height_left * middle_left - height_right * middle_right);

    let (wide, high) = (width_top - width_bottom, height_right - height_left);
    let half_b = Vec2::new(
        (height_right + height_left) * length,
        (width_top + width_bottom) * length,
    );
    Derivatives {
        u: high - derivative * wide,
        v: wide + derivative * high,
        heading: moment * (length * length),
        half_a: Vec2::new(side_x, side_y),
        half_b: Vec2::new(
            S::select(pair.swapped, half_b.y, half_b.x),
            S::select(pair.swapped, half_b.x, half_b.y),
        ),
    }
}
