//! The relation of two boxes of any orientation, from which their overlap is computed.
use super::precise::{bounded, difference, into_frame, matrix, product, relative, sum};
pub(crate) use super::rename::Renaming;
use super::rename::smallest_turn;
use crate::shape::Obb3;
use crate::{Scalar, Vec3};

/// The larger box of a pair may be 2³⁸ times as large as the smaller one: its volume fits an `f32`.
const LARGEST_INVERSE: f64 = 1.0 / (1_u64 << 38) as f64;

/// Box b in the frame of box a, in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative3<S: Scalar> {
    /// The rotation: `turn[i][m]` is coordinate i, in a's frame, of b's axis m. The axes of b are
    /// renamed so that the rotation is as small as it can be: no entry of the diagonal is below 0.457,
    /// the cosine of the largest such rotation, 62.8 degrees.
    pub turn: [[S; 3]; 3],
    /// The centre of b in a's frame.
    pub center: [S; 3],
    /// Half the size of a.
    pub half_a: [S; 3],
    /// Half the size of b, along the renamed axes.
    pub half_b: [S; 3],
    /// The renaming of b's axes.
    pub renamed: Renaming<S>,
    /// The power of two by which lengths were multiplied.
    pub scale: S,
    /// `true` where both boxes are one set of points.
    pub same: S::Mask,
}

/// Returns the power of two by which a pair of boxes is multiplied so that no volume over- or underflows: it
/// brings the largest side of the smaller box near one, unless that is zero or the other box would
/// become too large.
#[inline(always)]
pub(crate) fn size_scale3<S: Scalar>(half_a: Vec3<S>, half_b: Vec3<S>) -> S {
    let size_a = half_a.x.most(half_a.y).most(half_a.z);
    let size_b = half_b.x.most(half_b.y).most(half_b.z);
    let (smaller, larger) = (size_a.least(size_b), size_a.most(size_b));
    let bounded = smaller.most(larger * S::lit(LARGEST_INVERSE));
    let size = S::select(smaller.at_most(S::zero()), larger, bounded);
    let zero = size.at_most(S::zero());
    S::select(zero, S::one(), S::select(zero, S::one(), size).binade())
}

/// Returns a number, or zero where it is smaller than another one.
#[inline(always)]
fn levelled<S: Scalar>(x: S, flat: S) -> S {
    let nothing = x.unsigned().below(flat);
    S::select(nothing, x.with_primal(S::Primal::zero()), x)
}

/// Sees `b` from `a`.
#[inline(always)]
pub(crate) fn relate3<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> Relative3<S> {
    let half = S::lit(0.5);
    relate3_in(a, b, size_scale3(a.size * half, b.size * half))
}

/// Sees `b` from `a` in units of `1 / scale`, a power of two.
#[inline(always)]
pub(crate) fn relate3_in<S: Scalar>(a: Obb3<S>, b: Obb3<S>, scale: S) -> Relative3<S> {
    let half = S::lit(0.5);
    let (half_a, half_b) = (a.size * half * scale, b.size * half * scale);
    let (dx, lost_x) = difference(a.center.x, b.center.x, scale);
    let (dy, lost_y) = difference(a.center.y, b.center.y, scale);
    let (dz, lost_z) = difference(a.center.z, b.center.z, scale);
    let (from, to) = (bounded(a.rotation), bounded(b.rotation));
    let center = into_frame(from, [dx, dy, dz], [lost_x, lost_y, lost_z]);

    let (high, low) = relative(from, to);
    let whole = match low {
        Some(low) => sum(high, low),
        None => high,
    };
    let (cube, renamed) = smallest_turn(whole);
    let turned = match low {
        Some(low) => sum(product(high, cube), product(low, cube)),
        None => product(high, cube),
    };
    // Nothing but rounding is left of an angle below this one.
    let [w, x, y, z] = turned;
    let flat = w.unsigned() * S::lit(S::format().parallel());
    let (x, y, z) = (levelled(x, flat), levelled(y, flat), levelled(z, flat));
    let half_a = [half_a.x, half_a.y, half_a.z];
    let half_b = renamed.rename([half_b.x, half_b.y, half_b.z]);
    let none = S::zero();
    let still = (x.equals(none) & y.equals(none) & z.equals(none))
        & (center[0].equals(none) & center[1].equals(none) & center[2].equals(none));
    let same = still
        & (half_a[0].equals(half_b[0]) & half_a[1].equals(half_b[1]) & half_a[2].equals(half_b[2]));
    Relative3 {
        turn: matrix([w, x, y, z]),
        center,
        half_a,
        half_b,
        renamed,
        scale,
        same,
    }
}
