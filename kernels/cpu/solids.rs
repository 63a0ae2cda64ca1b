//! Bounds in the plane of boxes in space, as seen from above: pairs whose bounds do not meet are apart.
use crate::kernels::cpu::boxes3::OBB3;
use crate::kernels::cpu::lane::{Lane, TILE, Tiles};
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::{Real, Scalar};

/// The number of scalars of an axis-aligned box: lower corner, upper corner.
const AABB3: usize = 6;

/// Writes the bounds of axis-aligned boxes, which are the boxes themselves.
pub(crate) fn aabb3_bounds<T: Real>(shapes: Tiles<'_, T>, bounds: &mut [Lane<T>]) {
    for (t, out) in bounds.as_chunks_mut::<BOUNDS>().0.iter_mut().enumerate() {
        if let Some(shape) = shapes.tile::<AABB3>(t) {
            *out = [shape[0], shape[1], shape[3], shape[4]];
        }
    }
}

/// The margin of bounds, as a share of the ball around a box. Boxes whose bounds do not meet are then far apart: the
/// separating axes of a pair, edge against edge, show it in single precision, too.
const SLACK: f64 = 0.01;

/// Writes the bounds of boxes of any orientation: of the ball around each, which a rotation does not change.
pub(crate) fn obb3_bounds<T: Real>(shapes: Tiles<'_, T>, bounds: &mut [Lane<T>]) {
    for (t, out) in bounds.as_chunks_mut::<BOUNDS>().0.iter_mut().enumerate() {
        let Some(shape) = shapes.tile::<OBB3>(t) else {
            return;
        };
        for i in 0..TILE {
            let [x, y, _, dx, dy, dz] = [0, 1, 2, 3, 4, 5].map(|k| shape[k].0[i].widen());
            let ball = (Scalar::hypot(Scalar::hypot(dx, dy), dz) / 2.0) * (1.0 + SLACK);
            let reach = |x: f64| ball + 4.0 * T::format().epsilon() * x.abs();
            let [low_x, low_y, high_x, high_y] =
                [x - reach(x), y - reach(y), x + reach(x), y + reach(y)];
            // Bounds must be finite like shapes: infinite ones would meet the padding after the last shape.
            let bound = |x: f64| T::lit(x.clamp(-T::format().largest(), T::format().largest()));
            out[0].0[i] = bound(low_x);
            out[1].0[i] = bound(low_y);
            out[2].0[i] = bound(high_x);
            out[3].0[i] = bound(high_y);
        }
    }
}
