//! A tree of bounds, for finding the few items of a long list that a row may overlap.
use crate::Real;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::cpu::overlaps::BOUNDS;

/// Bounds in tiles of sixteen; each tile has one bound in the level above, up to a single tile.
///
/// Items are sorted by their centres along Morton's curve, so that neighbours share tiles.
pub struct Tree<T> {
    levels: Vec<Vec<Lane<T>>>,
    order: Vec<u32>,
}

/// Interleaves the bits of a coordinate below 2¹⁶ with zeros, for Morton's curve.
fn interleave(place: f64) -> u32 {
    let place = place as u32 & 0xffff;
    let place = (place | place << 8) & 0x00ff_00ff;
    let place = (place | place << 4) & 0x0f0f_0f0f;
    let place = (place | place << 2) & 0x3333_3333;
    (place | place << 1) & 0x5555_5555
}

impl<T: Real> Tree<T> {
    /// Builds a tree over bounds in tiles.
    pub fn new(bounds: &[Lane<T>], count: usize) -> Self {
        let of = |i: usize| -> [T; BOUNDS] {
            std::array::from_fn(|k| bounds[i / TILE * BOUNDS + k].0[i % TILE])
        };
        let center = |i: usize| {
            let own = of(i).map(|x| 0.5 * x.widen());
            // Bounds of rare shapes are infinite and have no centre.
            [own[0] + own[2], own[1] + own[3]].map(|x| if x.is_finite() { x } else { 0.0 })
        };
        let centers: Vec<[f64; 2]> = (0..count).map(center).collect();
        let ends = |k: usize| {
            let all = centers.iter().map(|center| center[k]);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            })
        };
        let ((left, right), (bottom, top)) = (ends(0), ends(1));
        // One scale for both axes keeps tiles short in a long, narrow scene.
        let scale = 65_535.0 / (right - left).max(top - bottom);
        let place = |(i, [x, y]): (usize, &[f64; 2])| {
            let along = interleave((x - left) * scale) | interleave((y - bottom) * scale) << 1;
            u64::from(along) << 32 | i as u64
        };
        let mut order: Vec<u64> = centers.iter().enumerate().map(place).collect();
        order.sort_unstable();
        let order: Vec<u32> = order.into_iter().map(|own| own as u32).collect();
        let mut levels = Vec::new();
        let mut boxes: Vec<[T; BOUNDS]> = order.iter().map(|&i| of(i as usize)).collect();
        loop {
            let mut lanes = vec![Lane::default(); boxes.len().div_ceil(TILE) * BOUNDS];
            // Nothing meets the padding of the last tile.
            let (least, most) = (T::lit(f64::NEG_INFINITY), T::lit(f64::INFINITY));
            for tile in lanes.chunks_mut(BOUNDS) {
                for (k, lane) in tile.iter_mut().enumerate() {
                    lane.0.fill(if k < 2 { most } else { least });
                }
            }
            for (i, one) in boxes.iter().enumerate() {
                for (lane, &x) in lanes[i / TILE * BOUNDS..].iter_mut().zip(one) {
                    lane.0[i % TILE] = x;
                }
            }
            levels.push(lanes);
            if boxes.len() <= TILE {
                return Tree { levels, order };
            }
            let around = |boxes: &[[T; BOUNDS]]| {
                boxes[1..].iter().fold(boxes[0], |all, one| {
                    [
                        all[0].least(one[0]),
                        all[1].least(one[1]),
                        all[2].most(one[2]),
                        all[3].most(one[3]),
                    ]
                })
            };
            boxes = boxes.chunks(TILE).map(around).collect();
        }
    }
    /// Returns every item whose bounds meet the given ones, ascending; `room` is a buffer.
    pub fn near<'r>(&self, bounds: &[T; BOUNDS], room: &'r mut Vec<u32>) -> &'r [u32] {
        let [start, end] = (kernels_in::<T>().search)(bounds, &self.levels, room);
        let hits = &mut room[start..end];
        for hit in &mut *hits {
            *hit = self.order[*hit as usize];
        }
        hits.sort_unstable();
        hits
    }
}
