//! Overlap of boxes of any orientation.
use super::border::{Shared3, shared_volume};
use super::relate::{Relative3, relate3};
use super::{score, volume_from_half};
use crate::arrays::Each;
use crate::overlap::Denominator;
use crate::shape::Obb3;
use crate::{Mask, Scalar};
use std::any::TypeId;

/// Returns the volume that two related boxes share, in units of `1 / scale³`.
///
/// Floats compute the value alone. For numbers with derivatives, and symbols of programs to be differentiated, the
/// derivatives g come from the formula for derivatives, because the value's own arithmetic loses them where edges are
/// parallel to faces. With `x₀` the value of an input x without its derivatives,
///
/// ```text
/// V(x₀) + Σ ½ (g(x) + g(x₀)) · (x − x₀)
/// ```
///
/// has the first derivative g and the second derivative g′. (Higher ones are not those of the volume.) The
/// differences are zero as a value, so that a program of the value has none of it.
#[inline(always)]
fn volume<S: Scalar, const PIECES: bool>(pair: &Relative3<S>) -> S {
    // In one piece there are only plain vectors. Said as a constant: what follows is not compiled for them then.
    if PIECES {
        if is_plain::<S>() {
            return shared_volume::<S, false, PIECES>(pair).volume;
        }
        volume_and_curvature(pair)
    } else {
        shared_volume::<S, false, PIECES>(pair).volume
    }
}

/// Returns `true` for numbers without derivatives.
#[inline(always)]
fn is_plain<S: Scalar>() -> bool {
    let number = TypeId::of::<S>();
    number == TypeId::of::<f32>() || number == TypeId::of::<f64>()
}

/// Returns the volume of numbers with derivatives.
#[inline(never)]
fn volume_and_curvature<S: Scalar>(pair: &Relative3<S>) -> S {
    let found = shared_volume::<S, true, true>(&without_curvature(pair));
    moved_by(pair, &found, |g| (g + S::from_primal(g.primal())).halved())
}

/// Returns a volume as a constant, plus the products of the derivatives `g` with the changes of the pair's numbers.
///
/// The rotation enters by the entries of its matrix R: a turn ω changes them by `ω × R`, so the derivative τ by a turn
/// is `½ τ × R` by the entries.
#[inline(always)]
fn moved_by<S: Scalar>(pair: &Relative3<S>, g: &Shared3<S>, of: impl Fn(S) -> S) -> S {
    let mut volume = S::from_primal(g.volume.primal());
    let moved = |x: S| x.with_primal(S::Primal::zero());
    for i in 0..3 {
        volume += of(g.center[i]) * moved(pair.center[i]);
        volume += of(g.half_a[i]) * moved(pair.half_a[i]);
        volume += of(g.half_b[i]) * moved(pair.half_b[i]);
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        for m in 0..3 {
            let by_entry = g.turn[j] * pair.turn[l][m] - g.turn[l] * pair.turn[j][m];
            volume += of(by_entry.halved()) * moved(pair.turn[i][m]);
        }
    }
    volume
}

/// Returns a volume whose derivatives are known, with the first ones.
#[inline(never)]
fn volume_and_slope<S: Scalar>(pair: &Relative3<S>, found: &Shared3<S>) -> S {
    moved_by(pair, found, |g| S::from_primal(g.primal()))
}

/// Returns the pair as constants where sizes or positions are so different that second derivatives could overflow: only
/// first derivatives exist there.
#[inline(always)]
fn without_curvature<S: Scalar>(pair: &Relative3<S>) -> Relative3<S> {
    let large = |v: [S; 3]| {
        let v = v.each_as(|x| x.primal().magnitude());
        v[0].most(v[1]).most(v[2])
    };
    let size = large(pair.half_a).most(large(pair.half_b));
    let size = size.most(large(pair.center));
    let extreme = size.above(S::Primal::largest_to(0.1));
    let held = |x: S| S::select(extreme, S::from_primal(x.primal()), x);
    Relative3 {
        turn: pair.turn.each_as(|row| row.each_as(held)),
        center: pair.center.each_as(held),
        half_a: pair.half_a.each_as(held),
        half_b: pair.half_b.each_as(held),
        ..*pair
    }
}

/// Returns `true` where two related boxes can share nothing at a glance: balls around them are apart.
#[inline(always)]
pub(crate) fn far_apart<S: Scalar>(pair: &Relative3<S>) -> S::Mask {
    // (|h| + |p|)² ≤ 2 |h|² + 2 |p|², with room for rounding.
    let reach = squared_length(pair.half_a) + squared_length(pair.half_b);
    // Not "above": a centre whose coordinates in the pair's unit overflowed may be NaN.
    !squared_length(pair.center).at_most(reach * S::Primal::lit(2.001))
}

#[inline(always)]
fn squared_length<S: Scalar>(v: [S; 3]) -> S::Primal {
    let [x, y, z] = [v[0].primal(), v[1].primal(), v[2].primal()];
    (x * x + y * y) + z * z
}

/// Relates the pair in a function of its own, so that its stack is free again when volumes are measured.
#[inline(never)]
pub(crate) fn related<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> Relative3<S> {
    relate3(a, b)
}

/// Returns a score as a function of its own, one for each kind of number however many callers.
#[inline(never)]
pub(crate) fn score_obb3<S: Scalar>(over: Denominator, a: Obb3<S>, b: Obb3<S>) -> S {
    score_related::<S, true>(over, &related(a, b))
}

/// Returns a score in one piece, as code for vector instructions must be.
#[inline(always)]
pub(crate) fn score_obb3_here<S: Scalar>(over: Denominator, a: Obb3<S>, b: Obb3<S>) -> S {
    score_related::<S, false>(over, &relate3(a, b))
}

#[inline(always)]
fn score_related<S: Scalar, const PIECES: bool>(over: Denominator, pair: &Relative3<S>) -> S {
    let apart = far_apart(pair);
    if apart.all() {
        return S::zero();
    }
    let shared = volume::<S, PIECES>(pair);
    let (volume_a, volume_b) = (own_volume(pair, pair.half_a), own_volume(pair, pair.half_b));
    let shared = within(shared, volume_a, volume_b);
    let value = score(over, shared, volume_a, volume_b, pair.scale);
    let value = S::select(apart, S::zero(), value);
    match over {
        Denominator::Union => {
            let constant = S::from_primal(value.primal());
            S::select(pair.same, constant, value).canonical()
        }
        _ => value.canonical(),
    }
}

/// Returns the volume of a box of the pair; a constant if its derivatives by the sizes could overflow: for sizes far
/// below one, of which one is at least 10⁸ times another.
#[inline(always)]
fn own_volume<S: Scalar>(pair: &Relative3<S>, half: [S; 3]) -> S {
    let [x, y, z] = half;
    let size = x.primal().most(y.primal()).most(z.primal());
    let steep = (pair.scale.primal() * size) * size;
    let steep = steep.above(S::Primal::lit(S::format().largest() / 4096.0));
    let volume = volume_from_half(half);
    S::select(steep, S::from_primal(volume.primal()), volume)
}

/// Returns a volume that is not above that of either box, as scores measure boxes; derivatives stay.
#[inline(always)]
fn within<S: Scalar>(shared: S, volume_a: S, volume_b: S) -> S {
    let limit = volume_a.primal().least(volume_b.primal());
    let limit = limit.most(S::Primal::zero());
    let beyond = shared.above(S::from_primal(limit));
    S::select(beyond, shared.with_primal(limit), shared)
}

/// Returns the shared volume for numbers with derivatives, whose value has derivatives, too: those of a ratio of
/// volumes pass through it.
#[inline(always)]
pub(crate) fn shared_within<S: Scalar, const PIECES: bool>(
    pair: &Relative3<S>,
) -> (Shared3<S>, S, S) {
    let mut shared = shared_volume::<S, true, PIECES>(pair);
    if PIECES && !is_plain::<S>() {
        shared.volume = volume_and_slope(pair, &shared);
    }
    let (volume_a, volume_b) = (volume_from_half(pair.half_a), volume_from_half(pair.half_b));
    shared.volume = within(shared.volume, volume_a, volume_b);
    (shared, volume_a, volume_b)
}

/// Returns the volume shared by two boxes of any orientation, from 0 to the volume of the smaller one, in cubed
/// units of length. Saturates at the largest finite number.
///
/// By the integral over the clamped [`border`](super::border): straight line, continuous in every number. The error is
/// a few roundings of two volumes: the volume that the first box shares with bounds around the second one, along the
/// first one's axes; and the smaller box's surface times the longest side. For boxes of similar sizes these are about
/// their volumes. A rod of 13000 × 0.0001 × 0.0001 across a plate of 13000 × 13000 × 72 is right to 10⁻⁸ of its volume
/// in `f64` as the first box, and to 10⁻³ as the second: the thinner box belongs first. In `f32` boxes 5·10⁴ times as
/// long as thick that cross at any angle share 10⁻⁵ of their volume. The error is 10⁻⁶ of the box's volume in 99 of 100
/// pairs and 3·10⁻⁵ in all; in nine of ten it is 0.5 % of the shared volume. Derivatives by a rotation's quaternion are
/// those of its direction; see [`Rotation3`](crate::shape::Rotation3). Derivatives above the second are not supported.
/// Kinks and conventions: see the [module](super).
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3, overlap3::intersection_volume_obb3};
/// let (origin, size) = (Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0));
/// let cube = Obb3::new(origin, size, Rotation3::identity());
/// // Turned by a sixth of a turn about its diagonal: they share two pyramids over a hexagon.
/// let turned = Obb3::new(origin, size, Rotation3::new(3.0, 1.0, 1.0, 1.0));
/// assert!((intersection_volume_obb3(cube, turned) - 0.75).abs() < 1e-15);
/// assert_eq!(intersection_volume_obb3(cube, cube), 1.0);
/// ```
#[must_use]
#[inline]
pub fn intersection_volume_obb3<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    score_obb3(Denominator::None, a, b)
}

/// Returns the intersection over union of two boxes of any orientation, in `[0, 1]`.
///
/// As for [`intersection_volume_obb3`].
///
/// ```
/// use geograd::{Obb3, Rotation3, Vec3, overlap3::iou_obb3};
/// let turn = Rotation3::new(0.9, 0.1, -0.3, 0.2);
/// let a = Obb3::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(4.0, 2.0, 1.0), turn);
/// assert_eq!(iou_obb3(a, a), 1.0);
/// // Half of it: moved by half its length along its own x axis.
/// let b = Obb3 { center: a.world_from_local() * Vec3::new(2.0_f64, 0.0, 0.0), ..a };
/// assert!((iou_obb3(a, b) - 1.0 / 3.0).abs() < 1e-14);
/// ```
#[must_use]
#[inline]
pub fn iou_obb3<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    score_obb3(Denominator::Union, a, b)
}

/// Returns the share of the first box that lies in the second, in `[0, 1]`.
///
/// As for [`intersection_volume_obb3`].
#[must_use]
#[inline]
pub fn iof_obb3<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    score_obb3(Denominator::First, a, b)
}
