//! The test if a line meets a hull of corners: by the sides of the corners, with signs that rounding does not change.
use super::lines::plain;
use crate::distance::beam::{Beam, Border, Inside};
use crate::distance::edge::{scale_of, size_of, unit};
use crate::distance::share::Best;
use crate::twofold::Twofold;
use crate::{Line2, Mask, Scalar, Vec2};

/// Returns the side of a corner of the line through a point, in units of the given sizes: positive to the left, zero on
/// the line to some ε².
#[inline(always)]
fn side<P: Scalar<Primal = P>>(point: Vec2<P>, way: Vec2<P>, corner: Vec2<P>, unit: P) -> P {
    let rounded = way.perp_dot((corner - point) * unit);
    // The direction is below 4, the arm below 8: three roundings of products up to 32, and that of their difference.
    let within = |most: f64, side: P| side.unsigned().at_most(P::lit(most));
    let doubt = within(128.0 * P::format().epsilon(), rounded);
    if !doubt.any() {
        return rounded;
    }
    let exact = wide_side(point, way, corner, unit);
    let zero = within(256.0 * P::format().epsilon().powi(2), exact);
    P::select(doubt, P::select(zero, P::zero(), exact), rounded)
}

/// Returns the side of a corner in twice the digits.
#[cold]
#[inline(never)]
fn wide_side<P: Scalar>(point: Vec2<P>, way: Vec2<P>, corner: Vec2<P>, unit: P) -> P {
    let arm = [(corner.x, point.x), (corner.y, point.y)]
        .map(|(to, from)| Twofold::difference(to, from).scaled(unit));
    Twofold::cross([Twofold::of(way.x), Twofold::of(way.y)], arm).high
}

/// A corner relative to a line.
#[derive(Clone, Copy)]
struct SeenCorner<S> {
    side: S,
    t: S,
    corner: Vec2<S>,
}

impl<S: Scalar> SeenCorner<S> {
    #[inline(always)]
    fn select(mask: S::Mask, yes: Self, no: Self) -> Self {
        SeenCorner {
            side: S::select(mask, yes.side, no.side),
            t: S::select(mask, yes.t, no.t),
            corner: Vec2::select(mask, yes.corner, no.corner),
        }
    }
}

/// Returns the range of a line inside a hull of corners, from that behind its faces: empty where all corners are on one
/// side, and the crossing of the hull where rounding leaves none or the hull is flat. Along a side it is that side.
///
/// The corners are given in the caller's coordinates and in those of the beam.
#[inline(always)]
pub(super) fn met<S: Scalar>(
    inside: Inside<S>,
    (line, beam): (Line2<S>, Beam<S>),
    (corners, placed): (&[Vec2<S>], &[Vec2<S>]),
    (scale, length): (S, S),
) -> Inside<S> {
    let (zero, large) = (S::zero(), S::largest());
    let size = scale_of::<S>(size_of(line.direction)).primal();
    let (point, way) = (plain(line.point), plain(line.direction) * size);
    let length = length.primal() * size;
    let seen = |k: usize| {
        let arm = placed[k] - beam.from;
        let side = side(point, way, plain(corners[k]), scale.primal()).over(length);
        SeenCorner {
            side: beam.along.perp_dot(arm).with_primal(side),
            t: beam.along.dot(arm),
            corner: placed[k],
        }
    };
    let (mut left, mut right) = (seen(0), seen(0));
    let (mut first, mut last) = (large, -large);
    // The chord is within the corners, along the line: two sides of a sliver may cross it elsewhere.
    let (mut low, mut high) = (left.t, left.t);
    for k in 0..corners.len() {
        let corner = seen(k);
        left = SeenCorner::select(left.side.below(corner.side), corner, left);
        right = SeenCorner::select(corner.side.below(right.side), corner, right);
        (low, high) = (low.least(corner.t), high.most(corner.t));
        let on = corner.side.equals(zero);
        first = S::select(on, first.least(corner.t), first);
        last = S::select(on, last.most(corner.t), last);
    }
    let still = way.x.equals(S::Primal::zero()) & way.y.equals(S::Primal::zero());
    let meets = right.side.at_most(zero) & left.side.at_least(zero);
    // The line crosses the hull between the corners that are farthest to both sides, or at corners on the line.
    let on = first.below(large);
    let apart = left.side - right.side;
    let safe = S::select(apart.equals(zero), S::one(), apart);
    let crossing = (right.t * left.side - left.t * right.side).over(safe);
    let (first, last) = (
        S::select(on, first, crossing),
        S::select(on, last, crossing),
    );
    let away = |found: S, wanted: S| (found - wanted).unsigned().above(S::rounding(64.0, 1));
    let off = away(inside.enter.value, first) | away(inside.exit.value, last);
    let anew = !still & meets & (inside.is_empty() | (first.below(last) & off));
    let missed = !still & !meets;
    let (is_early, is_late) = (
        inside.enter.value.below(low) & away(inside.enter.value, low),
        inside.exit.value.above(high) & away(inside.exit.value, high),
    );

    // Outwards: across the hull where it is flat, else across the line or, where all is on the line, along it.
    let edge = unit((left.corner - right.corner).perp());
    let [on_left, on_right] = [left, right].map(|corner| corner.side.equals(zero));
    let aside = Vec2::select(on_left, beam.along.perp(), -beam.along.perp());
    let normal = |out: Vec2<S>| {
        let across = Vec2::select(edge.dot(out).below(zero), -edge, edge);
        let touched = Vec2::select(on_left | on_right, aside, across);
        Vec2::select(on_left & on_right, out, touched)
    };
    let border =
        |best: Best<S, Border<S>>, (is_out, end): (S::Mask, S), t: S, out: Vec2<S>, never: S| {
            let (other, t) = (is_out | anew, S::select(anew, t, end));
            Best {
                value: S::select(missed, never, S::select(other, t, best.value)),
                sum: Border {
                    t: S::select(other, t, best.sum.t),
                    normal: Vec2::select(anew, normal(out), best.sum.normal),
                },
                count: S::select(other, S::one(), best.count),
            }
        };
    Inside {
        enter: border(inside.enter, (is_early, low), first, -beam.along, large),
        exit: border(inside.exit, (is_late, high), last, beam.along, -large),
    }
}
