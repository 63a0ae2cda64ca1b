//! Adjoints of the overlap of boxes of any orientation.
use crate::overlap::{Denominator, tamed};
use crate::overlap3::relate::{Relative3, relate3};
use crate::overlap3::{far_apart, related, score, shared_within, to_about_half};
use crate::shape::{Obb3, Rotation3};
use crate::{Scalar, Vec3};

/// Returns `out_bar` times the derivatives of a score by the volume shared and by the volumes of both boxes.
///
/// `I / U` with `U = A + B − I`: `∂I = (1 + I/U) / U`, `∂A = ∂B = −(I/U) / U`. `I / A`: `∂I = 1/A`,
/// `∂A = −(I/A) / A`. Zero where the denominator is.
#[inline(always)]
fn by_volumes<S: Scalar>(
    over: Denominator,
    value: S,
    [shared, a, b]: [S; 3],
    out_bar: S,
) -> [S; 3] {
    let zero = S::zero();
    let divisor = match over {
        Denominator::None => S::one(),
        Denominator::Union => a + b - shared,
        Denominator::First => a,
    };
    let empty = divisor.at_most(S::lit(S::format().empty()));
    let per = S::one().over(S::select(empty, S::one(), divisor));
    let per = S::select(empty, zero, per) * out_bar;
    match over {
        Denominator::None => [out_bar, zero, zero],
        Denominator::Union => [per + value * per, -(value * per), -(value * per)],
        Denominator::First => [per, -(value * per), zero],
    }
}

/// Returns the value of a score and `out_bar` times its derivatives, one function for each kind of number.
pub(crate) fn score_obb3_vjp<S: Scalar>(
    over: Denominator,
    a: Obb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Obb3<S>, Obb3<S>)) {
    score_related_vjp::<S, true, true>(over, &related(a, b), [a, b], out_bar)
}

/// Returns the value of a score and `out_bar` times its derivatives, for boxes of common size. Everything is inlined,
/// as code for vector instructions requires.
#[inline(always)]
pub(crate) fn score_obb3_vjp_here<S: Scalar>(
    over: Denominator,
    a: Obb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Obb3<S>, Obb3<S>)) {
    score_related_vjp::<S, false, false>(over, &relate3(a, b), [a, b], out_bar)
}

/// Multiplies a derivative by factors one after another, all except the first powers of two. With `EXTREME` products
/// are clamped to the largest number.
#[inline(always)]
fn times<S: Scalar, const EXTREME: bool>(x: S, by: [S; 4]) -> S {
    let mut x = x;
    for factor in by {
        x *= factor;
        if EXTREME {
            x = x.saturated();
        }
    }
    x
}
#[inline(always)]
fn times_each<S: Scalar, const EXTREME: bool>(v: Vec3<S>, by: [S; 4]) -> Vec3<S> {
    Vec3::new(
        times::<S, EXTREME>(v.x, by),
        times::<S, EXTREME>(v.y, by),
        times::<S, EXTREME>(v.z, by),
    )
}

/// Returns the value of a score and `out_bar` times its derivatives.
///
/// The derivatives of the volume come in a's frame: force F by the centre of b, torque τ by a turn of b about that
/// centre. Moving b is moving a by the opposite vector; turning the pair about a's centre changes nothing, so the
/// torque on a is `−(τ + c × F)`. Both torques are by body tangents; the quaternions' gradients follow.
///
/// `EXTREME` allows sizes, quaternions and `out_bar` so small or large that products over- or underflow: derivatives
/// too steep for the format are then its largest number. Ordinary boxes have equal bits in both cases.
#[inline(always)]
fn score_related_vjp<S: Scalar, const EXTREME: bool, const PIECES: bool>(
    over: Denominator,
    pair: &Relative3<S>,
    [a, b]: [Obb3<S>; 2],
    out_bar: S,
) -> (S, (Obb3<S>, Obb3<S>)) {
    let (mut shared, volume_a, volume_b) = shared_within::<S, PIECES>(pair);
    // Centres so far apart that their coordinates in the pair's unit overflow have no derivatives either.
    let apart = far_apart(pair);
    for derivatives in [
        &mut shared.center,
        &mut shared.turn,
        &mut shared.half_a,
        &mut shared.half_b,
    ] {
        *derivatives = zero_where(apart, *derivatives);
    }
    let value = score(over, shared.volume, volume_a, volume_b, pair.scale);
    let value = S::select(apart, S::zero(), value);
    let one = S::one();
    let (out_bar, steep) = if EXTREME {
        tamed(out_bar)
    } else {
        (out_bar, one)
    };
    let ratio = match over {
        Denominator::None => shared.volume,
        _ => value,
    };
    let bars = by_volumes(over, ratio, [shared.volume, volume_a, volume_b], out_bar);
    // Identical boxes: the derivatives of the union's ratio are zero by symmetry. Boxes apart: those of every
    // score are zero.
    let flat = match over {
        Denominator::Union => pair.same | apart,
        _ => apart,
    };
    let [bar, bar_a, bar_b] = zero_where(flat, bars);
    let (length, turn) = match over {
        // A volume in the caller's unit is three lengths; its derivative by a length is two.
        Denominator::None => {
            let per = one.over(pair.scale);
            ([per, per], [bar, per, per, per])
        }
        _ => ([pair.scale, one], [bar, one, one, one]),
    };
    let way = [bar, length[0], length[1], one];
    let length = [length[0], length[1], one, one];

    let size_a = by_size::<S, EXTREME>(pair.half_a, shared.half_a, [bar, bar_a]);
    let size_b = by_size::<S, EXTREME>(pair.half_b, shared.half_b, [bar, bar_b]);
    let size_b = pair.renamed.restore(size_b);

    let (force, torque) = (vector(shared.center), vector(shared.turn));
    let place = if EXTREME {
        zero_where(apart, pair.center)
    } else {
        pair.center
    };
    let own_torque = -(torque + vector(place).cross(force));
    let axes = a.rotation.axes();
    let (force, torque) = (along_axes(axes, force), along_axes(axes, torque));
    let axes_b = b.rotation.axes();
    let torque = Vec3::new(
        axes_b[0].dot(torque),
        axes_b[1].dot(torque),
        axes_b[2].dot(torque),
    );
    let center = times_each::<S, EXTREME>(force, way);
    let grad_a = gradient::<S, EXTREME>(
        -center,
        times_each::<S, EXTREME>(vector(size_a), length),
        by_quaternion::<S, EXTREME>(a.rotation, times_each::<S, EXTREME>(own_torque, turn)),
        steep,
    );
    let grad_b = gradient::<S, EXTREME>(
        center,
        times_each::<S, EXTREME>(vector(size_b), length),
        by_quaternion::<S, EXTREME>(b.rotation, times_each::<S, EXTREME>(torque, turn)),
        steep,
    );
    (value.canonical(), (grad_a, grad_b))
}

// Functions, not closures: those do not inherit instruction sets.

#[inline(always)]
fn vector<S: Scalar>(v: [S; 3]) -> Vec3<S> {
    Vec3::new(v[0], v[1], v[2])
}

#[inline(always)]
fn zero_where<S: Scalar>(mask: S::Mask, x: [S; 3]) -> [S; 3] {
    let zero = S::zero();
    [
        S::select(mask, zero, x[0]),
        S::select(mask, zero, x[1]),
        S::select(mask, zero, x[2]),
    ]
}

/// Returns a vector given along three axes.
#[inline(always)]
fn along_axes<S: Scalar>(axes: [Vec3<S>; 3], v: Vec3<S>) -> Vec3<S> {
    (axes[0] * v.x + axes[1] * v.y) + axes[2] * v.z
}

/// Returns the derivatives by the sizes of a box from those by its halves and by its own volume. A size is twice its
/// half; a volume is eight times the product of the halves.
#[inline(always)]
fn by_size<S: Scalar, const EXTREME: bool>(
    half: [S; 3],
    derivative: [S; 3],
    [bar, own]: [S; 2],
) -> [S; 3] {
    let mut out = [S::zero(); 3];
    for i in 0..3 {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        let face = (half[j] + half[j]) * (half[l] + half[l]);
        let (shared, whole) = (derivative[i].halved() * bar, face * own);
        out[i] = if EXTREME {
            shared.saturated() + whole.saturated()
        } else {
            shared + whole
        };
    }
    out
}

/// Returns the gradient by a quaternion from that by a body tangent.
#[inline(always)]
fn by_quaternion<S: Scalar, const EXTREME: bool>(
    rotation: Rotation3<S>,
    tangent: Vec3<S>,
) -> Rotation3<S> {
    if !EXTREME {
        return rotation.quaternion_gradient(tangent);
    }
    // The rotation gets a length of about one half: sums of products with it are finite where the tangent leaves
    // some room. The derivative grows as the length falls.
    let (near, first) = to_about_half(rotation);
    let (near, second) = to_about_half(near);
    let most = S::lit(S::format().largest() / 4096.0);
    let tangent = Vec3::new(
        tangent.x.clamp(-most, most),
        tangent.y.clamp(-most, most),
        tangent.z.clamp(-most, most),
    );
    let g = near.quaternion_gradient(tangent);
    Rotation3::new(
        ((g.w * first).saturated() * second).saturated(),
        ((g.x * first).saturated() * second).saturated(),
        ((g.y * first).saturated() * second).saturated(),
        ((g.z * first).saturated() * second).saturated(),
    )
}

/// Returns a derivative without the sign of a zero, times what was taken from the upstream derivative.
#[inline(always)]
fn finished<S: Scalar, const EXTREME: bool>(x: S, steep: S) -> S {
    if EXTREME {
        (x * steep).saturated().canonical()
    } else {
        x.canonical()
    }
}
#[inline(always)]
fn finished_each<S: Scalar, const EXTREME: bool>(v: Vec3<S>, steep: S) -> Vec3<S> {
    Vec3::new(
        finished::<S, EXTREME>(v.x, steep),
        finished::<S, EXTREME>(v.y, steep),
        finished::<S, EXTREME>(v.z, steep),
    )
}

/// Returns a gradient without signs of zeros, times what was taken from the upstream derivative.
#[inline(always)]
fn gradient<S: Scalar, const EXTREME: bool>(
    center: Vec3<S>,
    size: Vec3<S>,
    rotation: Rotation3<S>,
    steep: S,
) -> Obb3<S> {
    let g = rotation;
    Obb3 {
        center: finished_each::<S, EXTREME>(center, steep),
        size: finished_each::<S, EXTREME>(size, steep),
        rotation: Rotation3::new(
            finished::<S, EXTREME>(g.w, steep),
            finished::<S, EXTREME>(g.x, steep),
            finished::<S, EXTREME>(g.y, steep),
            finished::<S, EXTREME>(g.z, steep),
        ),
    }
}

/// Returns the volume shared by two boxes of any orientation, and `out_bar` times its derivatives by both.
///
/// Derivatives by the rotations are by the four numbers of their quaternions; [`Rotation3::tangent_gradient`] converts
/// them to those by body tangents.
///
/// ```
/// use geograd::ad::adjoint::overlap3::intersection_volume_obb3_vjp;
/// use geograd::{Obb3, Rotation3, Vec3};
/// let cube = Obb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0), Rotation3::identity());
/// let moved = Obb3 { center: Vec3::new(0.5, 0.5, 0.5), ..cube };
/// let (volume, (by_cube, by_moved)) = intersection_volume_obb3_vjp(cube, moved, 1.0_f64);
/// assert!((volume - 1.5_f64.powi(3)).abs() < 1e-15);
/// assert!((by_moved.center.x + 1.5 * 1.5).abs() < 1e-15);
/// assert!((by_cube.size.x - 1.5 * 1.5 / 2.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn intersection_volume_obb3_vjp<S: Scalar>(
    a: Obb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Obb3<S>, Obb3<S>)) {
    score_obb3_vjp(Denominator::None, a, b, out_bar)
}

/// Returns the intersection over union of two boxes of any orientation, and `out_bar` times its derivatives by both.
///
/// As for [`intersection_volume_obb3_vjp`].
#[must_use]
#[inline]
pub fn iou_obb3_vjp<S: Scalar>(a: Obb3<S>, b: Obb3<S>, out_bar: S) -> (S, (Obb3<S>, Obb3<S>)) {
    score_obb3_vjp(Denominator::Union, a, b, out_bar)
}

/// Returns the share of the first box that lies in the second, and `out_bar` times its derivatives by both.
///
/// As for [`intersection_volume_obb3_vjp`].
#[must_use]
#[inline]
pub fn iof_obb3_vjp<S: Scalar>(a: Obb3<S>, b: Obb3<S>, out_bar: S) -> (S, (Obb3<S>, Obb3<S>)) {
    score_obb3_vjp(Denominator::First, a, b, out_bar)
}
