//! Block kernels of the overlap of boxes: tiles in, tiles out, generic over the vector.
//!
//! Compiled in this library only, by the entries in `arch`.
use crate::ad::adjoint::iou::giou_framed_vjp;
use crate::ad::adjoint::overlap::{score_framed_vjp, tame_score_aabb2_vjp};
use crate::clip::{
    COMMON_FAR, COMMON_LARGE, COMMON_SMALL, FAR_AWAY as FAR, Framed, LARGE, SMALL, fine, frame,
};
use crate::iou::giou_framed;
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::blocks::all_within;
use crate::kernels::cpu::lane::{Lane, PLANE, ResultTiles, Tiles};
use crate::overlap::{Denominator, score_aabb2, score_framed};
use crate::{Aabb2, Fixed, Obb2, Real, Scalar, Vec2};

/// The number of scalars of a rotated box.
pub(crate) const OBB2: usize = 5;
/// The number of scalars of an axis-aligned box.
pub(crate) const AABB2: usize = 4;
/// The number of scalars of an upright box: centre, size, heading.
pub(crate) const UPRIGHT: usize = 7;
/// The number of scalars of bounds: lower x and y, upper x and y.
pub(crate) const BOUNDS: usize = 4;
/// The largest number of scalars of a rotated box with its sine and cosine computed.
const FRAME: usize = 10;

/// Returns the number of scalars of a rotated box with sine and cosine, and with low parts where the format needs them.
pub(crate) fn frame_fields<T: Scalar>() -> usize {
    if T::format().is_compensated() {
        FRAME
    } else {
        6
    }
}

/// The conversion from shapes to rotated boxes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Shapes are rotated boxes.
    Flat,
    /// Shapes are upright boxes, seen from above.
    FromAbove,
    /// Shapes are upright boxes, seen from above, with the centre's height and half the height appended.
    Upright,
}

/// The fields of an upright box that make the rotated box seen from above.
pub(crate) const SEEN: [usize; OBB2] = [0, 1, 3, 4, 6];

impl View {
    /// Returns the number of scalars of a prepared shape.
    pub(crate) fn fields<T: Scalar>(self) -> usize {
        match self {
            View::Flat | View::FromAbove => frame_fields::<T>(),
            View::Upright => frame_fields::<T>() + 2,
        }
    }
}

/// Prepares rotated boxes: computes sines and cosines.
#[inline(always)]
pub(crate) fn obb2_frames<T: Real, V: Vector<T>>(
    shapes: Tiles<'_, T>,
    view: View,
    frames: &mut [Lane<T>],
) {
    let wide = frame_fields::<T>();
    for (t, out) in frames.chunks_exact_mut(view.fields::<T>()).enumerate() {
        let Some(shape) = shapes.lanes.get(t * shapes.step..) else {
            return;
        };
        let seen = match (view, shape) {
            (View::Flat, [x, y, width, height, heading, ..]) => [x, y, width, height, heading],
            (_, [x, y, _, width, height, _, heading, ..]) => [x, y, width, height, heading],
            _ => return,
        };
        for at in V::starts() {
            let framed = frame(Obb2 {
                center: Vec2::new(V::read(seen[0], at), V::read(seen[1], at)),
                size: Vec2::new(V::read(seen[2], at), V::read(seen[3], at)),
                heading: V::read(seen[4], at),
            });
            let mut numbers = [V::zero(); FRAME];
            framed.store(&mut numbers);
            for (lane, number) in out[..wide].iter_mut().zip(numbers) {
                number.write(lane, at);
            }
            if view == View::Upright {
                V::read(&shape[2], at).write(&mut out[wide], at);
                V::read(&shape[5], at)
                    .halved()
                    .write(&mut out[wide + 1], at);
            }
        }
    }
}

/// Returns the lanes of a tile of results, in which field `k` is lane `k * PLANE`.
#[inline(always)]
pub(crate) fn lanes_of<'a, T, const LANES: usize>(
    out: &'a mut ResultTiles<'_, T>,
    t: usize,
) -> Option<&'a mut [Lane<T>; LANES]> {
    out.lanes.get_mut(t..)?.first_chunk_mut()
}

/// Writes numbers as fields of a tile of results, beginning with field `first`.
#[inline(always)]
pub(crate) fn put<T: Real, V: Vector<T>, const N: usize, const LANES: usize>(
    numbers: [V; N],
    out: &mut [Lane<T>; LANES],
    first: usize,
    at: usize,
) {
    let mut k = 0;
    while k < N {
        numbers[k].write(&mut out[(first + k) * PLANE], at);
        k += 1;
    }
}

/// Returns the factor of the derivatives of a tile: the seed, or one without seeds.
#[inline(always)]
pub(crate) fn seed<T: Real, V: Vector<T>>(seeds: Option<Tiles<'_, T>>, t: usize, at: usize) -> V {
    match seeds.and_then(|seeds| seeds.tile::<1>(t)) {
        Some(tile) => V::read(&tile[0], at),
        None => V::one(),
    }
}

/// Returns the vector of prepared boxes that begins at item `at` of tile `t`.
#[inline(always)]
pub(crate) fn framed<T: Real, V: Vector<T>>(
    tiles: Tiles<'_, T>,
    t: usize,
    at: usize,
) -> Option<Framed<V>> {
    let zero = V::zero();
    if T::format().is_compensated() {
        let tile = tiles.tile::<FRAME>(t)?;
        return Some(Framed::load(&[
            V::read(&tile[0], at),
            V::read(&tile[1], at),
            V::read(&tile[2], at),
            V::read(&tile[3], at),
            V::read(&tile[4], at),
            V::read(&tile[5], at),
            V::read(&tile[6], at),
            V::read(&tile[7], at),
            V::read(&tile[8], at),
            V::read(&tile[9], at),
        ]));
    }
    let tile = tiles.tile::<6>(t)?;
    Some(Framed::load(&[
        V::read(&tile[0], at),
        V::read(&tile[1], at),
        V::read(&tile[2], at),
        V::read(&tile[3], at),
        V::read(&tile[4], at),
        V::read(&tile[5], at),
        zero,
        zero,
        zero,
        zero,
    ]))
}

/// Writes the scores of prepared rotated boxes of ordinary size.
#[inline(always)]
pub(crate) fn obb2_scores<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (framed::<T, V>(a, t, at), framed(b, t, at)) else {
                return;
            };
            put([score_framed::<V, false>(over, a, b)], out, 0, at);
        }
    }
}

/// Writes the scores of prepared rotated boxes of ordinary size, each followed by its ten derivatives.
#[inline(always)]
pub(crate) fn obb2_derivatives<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * OBB2 * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (framed::<T, V>(a, t, at), framed(b, t, at)) else {
                return;
            };
            let (value, (a_bar, b_bar)) =
                score_framed_vjp::<V, false>(over, a, b, seed(seeds, t, at));
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * OBB2];
            (a_bar, b_bar).store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

/// Writes the generalised IoU of prepared rotated boxes of [common](all_common_obb2) size.
#[inline(always)]
pub(crate) fn giou_scores<T: Real, V: Vector<T>>(
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (framed::<T, V>(a, t, at), framed(b, t, at)) else {
                return;
            };
            put([giou_framed::<V, false>(a, b)], out, 0, at);
        }
    }
}

/// Writes the generalised IoU of prepared rotated boxes of [common](all_common_obb2) size, each followed by its ten
/// derivatives.
#[inline(always)]
pub(crate) fn giou_derivatives<T: Real, V: Vector<T>>(
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * OBB2 * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (framed::<T, V>(a, t, at), framed(b, t, at)) else {
                return;
            };
            let (value, (a_bar, b_bar)) = giou_framed_vjp::<V, false>(a, b, seed(seeds, t, at));
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * OBB2];
            (a_bar, b_bar).store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

/// Returns the vector of axis-aligned boxes that begins at item `at` of tile `t`.
#[inline(always)]
fn aabb2<T: Real, V: Vector<T>>(tiles: Tiles<'_, T>, t: usize, at: usize) -> Option<Aabb2<V>> {
    let tile = tiles.tile::<AABB2>(t)?;
    Some(Aabb2::new(
        V::read(&tile[0], at),
        V::read(&tile[1], at),
        V::read(&tile[2], at),
        V::read(&tile[3], at),
    ))
}

/// Writes the scores of axis-aligned boxes.
#[inline(always)]
pub(crate) fn aabb2_scores<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, 1>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (aabb2::<T, V>(a, t, at), aabb2(b, t, at)) else {
                return;
            };
            put([score_aabb2(over, a, b)], out, 0, at);
        }
    }
}

/// Writes the scores of axis-aligned boxes, each followed by its eight derivatives.
#[inline(always)]
pub(crate) fn aabb2_derivatives<T: Real, V: Vector<T>>(
    over: Denominator,
    a: Tiles<'_, T>,
    b: Tiles<'_, T>,
    seeds: Option<Tiles<'_, T>>,
    mut out: ResultTiles<'_, T>,
) {
    for t in 0..out.tiles {
        let Some(out) = lanes_of::<T, { 2 * AABB2 * PLANE + 1 }>(&mut out, t) else {
            return;
        };
        for at in V::starts() {
            let (Some(a), Some(b)) = (aabb2::<T, V>(a, t, at), aabb2(b, t, at)) else {
                return;
            };
            let (value, (a_bar, b_bar)) = tame_score_aabb2_vjp(over, a, b, seed(seeds, t, at));
            put([value], out, 0, at);
            let mut derivatives = [V::zero(); 2 * AABB2];
            (a_bar, b_bar).store(&mut derivatives);
            put(derivatives, out, 1, at);
        }
    }
}

/// Returns `true` if every rotated box is valid and [ordinary](crate::clip::is_ordinary).
#[inline(always)]
pub(crate) fn all_ordinary_obb2<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let fine = fine::<T>();
    all_within::<T, V, OBB2>(
        numbers,
        [true, true, false, false, true],
        [fine, fine, SMALL, SMALL, fine],
        [FAR, FAR, LARGE, LARGE, T::format().largest()],
    )
}

/// Returns `true` if every rotated box is valid, of a size from 10⁻⁵ to 10⁶ or zero, and no farther than 10⁹ from the
/// origin.
#[inline(always)]
pub(crate) fn all_common_obb2<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let fine = fine::<T>();
    let (small, large, far) = (COMMON_SMALL, COMMON_LARGE, COMMON_FAR);
    all_within::<T, V, OBB2>(
        numbers,
        [true, true, false, false, true],
        [fine, fine, small, small, fine],
        [far, far, large, large, T::format().largest()],
    )
}

/// Returns `true` if a number is zero or its magnitude within limits.
pub(crate) fn is_within<T: Real>(x: T, low: f64, high: f64) -> bool {
    let x = x.unsigned();
    x == T::default() || (x >= T::lit(low) && x <= T::lit(high))
}

/// Returns `true` if a valid upright box is of common size; [`all_common_upright`] tests many.
pub(crate) fn is_common_upright<T: Real>(x: &[T]) -> bool {
    let fine = fine::<T>();
    let place = |x: &T| is_within(*x, fine, COMMON_FAR);
    let size = |x: &T| is_within(*x, COMMON_SMALL, COMMON_LARGE);
    x[..3].iter().all(place)
        && x[3..6].iter().all(size)
        && is_within(x[6], fine, T::format().largest())
}

/// Returns `true` if a valid rotated box is of common size, and not of zero size.
pub(crate) fn is_solid_obb2<T: Real>(x: &[T]) -> bool {
    let fine = fine::<T>();
    let place = |x: &T| is_within(*x, fine, COMMON_FAR);
    let size = |x: &T| *x > T::default() && is_within(*x, COMMON_SMALL, COMMON_LARGE);
    x[..2].iter().all(place)
        && x[2..4].iter().all(size)
        && is_within(x[4], fine, T::format().largest())
}

/// Returns `true` if every upright box is valid, of a size from 10⁻⁵ to 10⁶ or zero, and no farther than 10⁹ from the
/// origin.
#[inline(always)]
pub(crate) fn all_common_upright<T: Real, V: Vector<T>>(numbers: &[T]) -> bool {
    let fine = fine::<T>();
    let (small, large, far) = (COMMON_SMALL, COMMON_LARGE, COMMON_FAR);
    all_within::<T, V, UPRIGHT>(
        numbers,
        [true, true, true, false, false, false, true],
        [fine, fine, fine, small, small, small, fine],
        [far, far, far, large, large, large, T::format().largest()],
    )
}

/// Writes the bounds of prepared rotated boxes: lower x and y, upper x and y.
///
/// They are so wide that [`relate`](crate::clip::relate) finds boxes apart whose bounds do not meet, in spite of its
/// rounding. Let `R` be the sum of half the widths and heights of both boxes, and ε the distance from 1 to the next
/// number. Let the bounds be apart along x. Each bound has a slack of `4ε |x| + 128ε (half width + half height)`, of
/// which its own rounding takes less than `4ε (|x| + half width + half height)`. So the exact boxes are apart by
/// `g ≥ 120 ε R`. Boxes that are apart by `g` are separated by `g / √2` or more along one of their four axes: where a
/// corner faces a corner, the shortest segment between them lies in the quarter of normals of either. Hence it lies
/// between two axes less than a quarter apart, and within 45° of one of them. The separating-axis test rounds distances
/// of centres and extents by less than `12 ε (g + R)`, which is less than `g / √2`.
#[inline(always)]
pub(crate) fn obb2_bounds<T: Real, V: Vector<T>>(frames: Tiles<'_, T>, bounds: &mut [Lane<T>]) {
    let (of_place, of_size) = (
        V::lit(4.0 * T::format().epsilon()),
        V::lit(128.0 * T::format().epsilon()),
    );
    for (t, out) in bounds.as_chunks_mut::<BOUNDS>().0.iter_mut().enumerate() {
        for at in V::starts() {
            let Some(x) = framed::<T, V>(frames, t, at) else {
                return;
            };
            let (cos, sin) = (x.cos.unsigned(), x.sin.unsigned());
            let slack = (x.half.x + x.half.y) * of_size;
            let slack_x = x.center.x.unsigned() * of_place + slack;
            let slack_y = x.center.y.unsigned() * of_place + slack;
            let reach_x = (cos * x.half.x + sin * x.half.y) + slack_x;
            let reach_y = (sin * x.half.x + cos * x.half.y) + slack_y;
            (x.center.x - reach_x).write(&mut out[0], at);
            (x.center.y - reach_y).write(&mut out[1], at);
            (x.center.x + reach_x).write(&mut out[2], at);
            (x.center.y + reach_y).write(&mut out[3], at);
        }
    }
}
