//! The range of a line inside a cone, flat ones and those without a radius included.
use super::inside::{Beam, Border, Inside, choose, discriminant, roots, sized, sorted};
use crate::distance::edge::scale_of;
use crate::distance::share::Best;
use crate::distance3::near::size_of;
use crate::{Scalar, Vec3};

/// Returns the range inside a cone with its apex at the anchor, given the vector to the centre of its base and the
/// base's radius.
///
/// A line that crosses the plane of the base in the disc leaves or enters there. Another one meets the side twice, or
/// nothing: so the thickness of a flat cone decides of no line that is not nearly parallel to its base.
#[inline]
pub(super) fn in_cone<S: Scalar>(beam: Beam<S>, base: Vec3<S>, radius: S) -> Inside<S> {
    let (zero, one, large) = (S::zero(), S::one(), S::largest());
    let size = scale_of::<S>(size_of(base));
    let (unit, reach) = (base * size, radius * size);
    let (arm, along) = (beam.from, beam.along);
    let (z, rate, square) = (unit.dot(arm), unit.dot(along), unit.length_squared());
    let level = rate.magnitude().at_most(S::rounding(1.0, 2));
    let steady = S::select(level, one, rate);

    // |p × axis|² |axis|² ≤ radius² (p · axis)² for every point p of the line; both factors by a power of two that
    // brings the larger one to about one.
    let shrink = scale_of::<S>(size_of(unit).most(reach.primal()));
    let (tall, wide) = (square * shrink.squared(), (reach * shrink).squared());
    let (u, v) = (along.cross(unit), arm.cross(unit));
    let a = tall * u.length_squared() - wide * rate * rate;
    let b = tall * u.dot(v) - wide * z * rate;
    let c = tall * v.length_squared() - wide * z * z;
    let turn = along.cross(arm);
    let left = wide * unit.cross(turn).length_squared() - tall * unit.dot(turn).squared();
    let left = discriminant(a, b, c, square * tall * left);
    // Both terms of `a` are rounded four times, and across the axis a direction has some roundings; a line so near to
    // parallel to a straight line of the side crosses it once within the cone.
    let least = (tall * u.length_squared() + wide * rate * rate) * S::rounding(4.0, 1)
        + tall * S::rounding(8.0, 2);
    let parallel = a.magnitude().at_most(least);
    // Through the apex, within four roundings, both roots are one, without a slope across the line.
    let slack = size_of(along) * size_of(arm) * S::Primal::rounding(4.0, 1);
    let at_apex = size_of(turn).at_most(slack);
    let left = S::select(at_apex, zero, left);
    let (near, far) = roots(S::select(parallel, one, a), -b, c, left);
    let length = along.length_squared();
    let still = length.at_most(zero);
    let middle = (-arm.dot(along)).over(S::select(still, one, length));
    let tip = S::select(parallel, middle, far.with_primal(middle.primal()));
    let (low, high) = sorted((near, S::select(parallel, near, far)));
    let (low, high) = (S::select(at_apex, tip, low), S::select(at_apex, tip, high));

    let top = unit.dot(base - arm).over(steady);
    let across = unit.cross(arm + along * top - base).length_squared();
    let on = !level & across.at_most(radius * radius * square);
    let through = a.above(zero) & !parallel;
    let center = z + rate * (low + (high - low).halved());
    let under = center.at_least(zero) | at_apex;
    let beside = through & left.at_least(zero) & under & center.at_most(unit.dot(base));

    // Through one side and the other, or in by the side and out by the base, or the reverse. Where the line crosses the
    // base, it meets the side between apex and base, or beyond the base.
    let ahead = rate.above(zero);
    let (tip_plane, base_plane) = ((-z).over(steady), top);
    let side = |t: S, open: S::Mask, end: S, [least, most]: [S; 2]| {
        let within = t.primal().most(least.primal()).least(most.primal());
        let t = S::select(on, t.with_primal(within), t);
        let p = arm + along * t;
        let normal = unit.cross(p).cross(unit) * tall - unit * (unit.dot(p) * wide);
        let none = open | at_apex;
        let border = Border {
            t: S::select(open, end, t),
            normal: Vec3::select(none, Vec3::zero(), sized(normal)),
        };
        Best::of(border.t, border)
    };
    let enter = side(
        S::select(through | !ahead, low, high),
        !through & !ahead,
        -large,
        [S::select(ahead, tip_plane, -large), base_plane],
    );
    let exit = side(
        S::select(through | ahead, high, low),
        !through & ahead,
        large,
        [base_plane, S::select(ahead, large, tip_plane)],
    );
    let disc = Best::of(
        top,
        Border {
            t: top,
            normal: unit,
        },
    );
    let enter = choose(on & !ahead, enter.most(disc), enter);
    let exit = choose(on & ahead, exit.less(disc), exit);
    Inside { enter, exit }.unless(!on & !beside | square.at_most(zero))
}
