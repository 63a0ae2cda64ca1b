//! Boxes around the shapes of a list, and the lower bounds of distances from them.
use crate::Real;
use crate::kernels::cpu::blocks::SPACE;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, LaneBuffer, TILE, Tiles, tiles};
use crate::kernels::cpu::plan::Prepare;
use crate::kernels::machine::Column;
use crate::kernels::row::item::STRETCH;
use std::ops::Range;

/// The smallest number of boxes that are sorted.
const SORTED: usize = 512;

/// Boxes of a long list in an order in which neighbours share tiles, with the box around each tile.
struct Sorted<T> {
    /// The item of every place.
    order: Vec<u32>,
    /// Boxes in tiles, in this order.
    lanes: Vec<Lane<T>>,
    /// Boxes around tiles, in tiles.
    upper: Vec<Lane<T>>,
}

/// Axis-aligned boxes around the shapes of a list, a little wider than these.
pub(crate) struct Boxes<T: Real> {
    /// Boxes in tiles.
    lanes: LaneBuffer<T>,
    sorted: Option<Sorted<T>>,
    count: usize,
}

/// The lower bounds of an item's results with some tiles of others; NaN for others that are computed or not wanted.
#[derive(Default)]
pub(crate) struct Open<T> {
    /// The index of each tile.
    tiles: Vec<u32>,
    /// The bounds of each tile.
    bounds: Vec<Lane<T>>,
    /// The least bound of each of the first tiles, as long as none has been removed.
    least: Vec<T>,
    /// The bounds of all tiles, in tiles; NaN for tiles that are open. Empty if all are.
    upper: Vec<Lane<T>>,
    /// Bounds and places of others that may be near.
    near: Vec<(T, u32)>,
}

/// Interleaves the bits of a coordinate below 2¹⁰ with two zeros each, for Morton's curve in space.
fn interleave(place: f64) -> u32 {
    let place = place as u32 & 0x3ff;
    let place = (place | place << 16) & 0x0300_00ff;
    let place = (place | place << 8) & 0x0300_f00f;
    let place = (place | place << 4) & 0x030c_30c3;
    (place | place << 2) & 0x0924_9249
}

/// Returns a box of a list in tiles.
fn box_at<T: Real>(lanes: &[Lane<T>], i: usize) -> [T; SPACE] {
    std::array::from_fn(|k| lanes[i / TILE * SPACE + k].0[i % TILE])
}

/// Returns boxes in tiles. The last box pads the last tile.
fn in_tiles<T: Real>(boxes: &[[T; SPACE]]) -> Vec<Lane<T>> {
    let mut lanes = vec![Lane::default(); tiles(boxes.len()) * SPACE];
    for (t, tile) in lanes.as_chunks_mut::<SPACE>().0.iter_mut().enumerate() {
        for i in 0..TILE {
            let one = boxes[(t * TILE + i).min(boxes.len() - 1)];
            for (lane, x) in tile.iter_mut().zip(one) {
                lane.0[i] = x;
            }
        }
    }
    lanes
}

impl<T: Real> Sorted<T> {
    fn new(lanes: &[Lane<T>], count: usize) -> Self {
        let center = |i: usize| {
            let own = box_at(lanes, i).map(|x| 0.5 * x.widen());
            // Endless boxes have no centre.
            [0, 1, 2]
                .map(|k| own[k] + own[k + 3])
                .map(|x| if x.is_finite() { x } else { 0.0 })
        };
        let centers: Vec<[f64; 3]> = (0..count).map(center).collect();
        let ends = [0, 1, 2].map(|k| {
            let all = centers.iter().map(|center| center[k]);
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        });
        let widest = ends
            .iter()
            .map(|[low, high]| high - low)
            .fold(0.0, f64::max);
        // One scale for all axes keeps the boxes of tiles short in a long, narrow scene.
        let scale = 1023.0 / widest;
        let place = |(i, center): (usize, &[f64; 3])| {
            let [x, y, z] = [0, 1, 2].map(|k| interleave((center[k] - ends[k][0]) * scale));
            u64::from(x | y << 1 | z << 2) << 32 | i as u64
        };
        let mut order: Vec<u64> = centers.iter().enumerate().map(place).collect();
        order.sort_unstable();
        let order: Vec<u32> = order.into_iter().map(|own| own as u32).collect();
        let boxes: Vec<_> = order.iter().map(|&i| box_at(lanes, i as usize)).collect();
        let around = |tile: &[[T; SPACE]]| {
            tile[1..].iter().fold(tile[0], |all, one| {
                std::array::from_fn(|k| match k < 3 {
                    true => all[k].least(one[k]),
                    false => all[k].most(one[k]),
                })
            })
        };
        let upper: Vec<_> = boxes.chunks(TILE).map(around).collect();
        Sorted {
            order,
            lanes: in_tiles(&boxes),
            upper: in_tiles(&upper),
        }
    }
}

/// Replaces the numbers from an index on by NaN.
fn forget<T: Real>(bounds: &mut [Lane<T>], from: usize) {
    for i in from..bounds.len() * TILE {
        bounds[i / TILE].0[i % TILE] = T::lit(f64::NAN);
    }
}

impl<T: Real> Boxes<T> {
    /// Creates the boxes from bounds in tiles; `sorted` is `true` if a search among them is in all of them.
    fn new(mut lanes: LaneBuffer<T>, count: usize, sorted: bool) -> Self {
        (kernels_in::<T>().widen)(&mut lanes);
        let sorted = (sorted && count >= SORTED).then(|| Sorted::new(&lanes, count));
        Boxes {
            lanes,
            sorted,
            count,
        }
    }
    /// Returns the boxes around checked shapes, by the preparation of their bounds.
    pub(crate) fn of(
        list: &Column<'_, T>,
        (wide, bounds): &(usize, Prepare<T>),
        sorted: bool,
    ) -> Self {
        let (count, fields) = (list.len(), list.fields);
        let mut shapes = LaneBuffer::new(tiles(count) * fields);
        let mut room = Vec::new();
        for start in (0..count).step_by(STRETCH) {
            let items = start..count.min(start + STRETCH);
            let to = start / TILE * fields..tiles(items.end) * fields;
            let numbers = list.numbers(items, &mut room);
            (kernels_in::<T>().bring)(numbers, fields, &mut shapes[to]);
        }
        let mut lanes = LaneBuffer::new(tiles(count) * SPACE);
        let shapes = Tiles::new(&shapes, fields);
        if *wide == SPACE {
            bounds(shapes, &mut lanes);
        } else {
            let mut plane = LaneBuffer::new(tiles(count) * wide);
            bounds(shapes, &mut plane);
            // Boxes of the plane are endless along z.
            let [low, high] = [f64::NEG_INFINITY, f64::INFINITY].map(|x| Lane([T::lit(x); TILE]));
            let tiles = lanes.as_chunks_mut::<SPACE>().0.iter_mut();
            for (tile, own) in tiles.zip(plane.chunks_exact(*wide)) {
                *tile = [own[0], own[1], low, own[2], own[3], high];
            }
        }
        Boxes::new(lanes, count, sorted)
    }
    /// Returns the box of an item.
    pub(crate) fn around(&self, item: usize) -> [T; SPACE] {
        box_at(&self.lanes, item)
    }
    /// Returns the item of a place that [`Open`] passes.
    pub(crate) fn item(&self, place: u32) -> u32 {
        match &self.sorted {
            Some(sorted) => sorted.order[place as usize],
            None => place,
        }
    }
    /// Begins a search for the items of a range that are near a box. If these are sorted, the nearest tile is open, else
    /// all are.
    pub(crate) fn begin(&self, own: &[T; SPACE], range: Range<usize>, open: &mut Open<T>) {
        let gaps = kernels_in::<T>().gaps;
        open.tiles.clear();
        open.bounds.clear();
        open.least.clear();
        open.upper.clear();
        if let Some(sorted) = &self.sorted {
            let upper = Tiles::new(&sorted.upper, SPACE);
            open.upper.resize(tiles(tiles(self.count)), Lane::default());
            gaps(own, upper, &mut open.upper);
            forget(&mut open.upper, tiles(self.count));
            let all = open.upper.iter().flat_map(|lane| lane.0).enumerate();
            let least = all
                .take(tiles(self.count))
                .reduce(|a, b| match b.1.below(a.1) {
                    true => b,
                    false => a,
                });
            if let Some((tile, _)) = least {
                self.open(own, tile, open);
            }
            return;
        }
        if range.is_empty() {
            return;
        }
        let own_tiles = range.start / TILE..tiles(range.end);
        let boxes = &self.lanes[own_tiles.start * SPACE..own_tiles.end * SPACE];
        open.bounds.resize(own_tiles.len(), Lane::default());
        gaps(own, Tiles::new(boxes, SPACE), &mut open.bounds);
        let first = own_tiles.start * TILE;
        for i in 0..range.start - first {
            open.bounds[0].0[i] = T::lit(f64::NAN);
        }
        forget(&mut open.bounds, range.end - first);
        open.tiles.extend(own_tiles.map(|tile| tile as u32));
    }
    /// Opens the tiles that are left and have a bound up to a limit.
    pub(crate) fn open_rest(&self, own: &[T; SPACE], limit: T, open: &mut Open<T>) {
        for tile in 0..open.upper.len() * TILE {
            if open.upper[tile / TILE].0[tile % TILE].at_most(limit) {
                self.open(own, tile, open);
            }
        }
    }
    /// Opens a tile of sorted items.
    fn open(&self, own: &[T; SPACE], tile: usize, open: &mut Open<T>) {
        let Some(sorted) = &self.sorted else { return };
        let boxes = Tiles::new(&sorted.lanes[tile * SPACE..][..SPACE], SPACE);
        let mut bounds = [Lane::default()];
        (kernels_in::<T>().gaps)(own, boxes, &mut bounds);
        forget(&mut bounds, (self.count - tile * TILE).min(TILE));
        open.upper[tile / TILE].0[tile % TILE] = T::lit(f64::NAN);
        open.tiles.push(tile as u32);
        open.bounds.extend(bounds);
    }
}

/// Returns the least number of a lane; infinity if all are NaN.
#[inline]
fn least<T: Real>(lane: &Lane<T>) -> T {
    let lower = |a: T, b: T| if b < a { b } else { a };
    // Four at a time, which the compiler makes vectors of.
    let mut four = [T::lit(f64::INFINITY); 4];
    for part in lane.0.as_chunks::<4>().0 {
        for (least, &x) in four.iter_mut().zip(part) {
            *least = lower(*least, x);
        }
    }
    let [a, b, c, d] = four;
    lower(lower(a, b), lower(c, d))
}

/// The number of tiles up to which a search's room is kept for the next one.
const SHORT: usize = 64;

impl<T: Real> Open<T> {
    /// Returns `true` if its room is small.
    pub(crate) fn is_short(&self) -> bool {
        self.bounds.capacity() <= SHORT && self.near.capacity() <= SHORT * TILE
    }
    /// Removes up to two others with a bound up to a limit, and passes their places: those of the least bounds of two
    /// tiles.
    pub(crate) fn first(&mut self, limit: T, mut pass: impl FnMut(u32)) {
        let mut two = [(T::lit(f64::INFINITY), usize::MAX); 2];
        self.least.extend(self.bounds.iter().map(least));
        for (tile, &least) in self.least.iter().enumerate() {
            let own = (least, tile);
            if own.0 < two[0].0 {
                two = [own, two[0]];
            } else if own.0 < two[1].0 {
                two[1] = own;
            }
        }
        for (bound, tile) in two {
            let Some(lane) = self.bounds.get_mut(tile) else {
                continue;
            };
            let at = lane.0.iter().position(|x| x.equals(bound));
            if let (Some(at), true) = (at, bound.at_most(limit)) {
                lane.0[at] = T::lit(f64::NAN);
                pass(self.tiles[tile] * TILE as u32 + at as u32);
            }
        }
    }
    /// Lists the others with a bound up to a limit that are not removed.
    pub(crate) fn gather(&mut self, limit: T) {
        self.near.clear();
        let others = &self.bounds[self.least.len()..];
        self.least.extend(others.iter().map(least));
        let tiles = self.bounds.iter().zip(&self.tiles).zip(&self.least);
        for ((lane, &tile), _) in tiles.filter(|(_, least)| least.at_most(limit)) {
            for (&bound, i) in lane.0.iter().zip(tile * TILE as u32..) {
                if bound.at_most(limit) {
                    self.near.push((bound, i));
                }
            }
        }
    }
    /// Removes listed others and passes their places: all if there are up to `few`, else `some` of the least bounds.
    pub(crate) fn some(&mut self, few: usize, some: usize, mut pass: impl FnMut(u32)) {
        let order = |a: &(T, u32), b: &(T, u32)| {
            let by_bound = a.0.partial_cmp(&b.0);
            by_bound.map_or(a.1.cmp(&b.1), |order| order.then(a.1.cmp(&b.1)))
        };
        let now = match self.near.len() > few {
            true => {
                self.near.select_nth_unstable_by(some, order);
                some
            }
            false => self.near.len(),
        };
        for (_, place) in self.near.drain(..now) {
            pass(place);
        }
    }
    /// Removes the listed others and passes the places of those with a bound up to a limit.
    pub(crate) fn rest(&mut self, limit: T, mut pass: impl FnMut(u32)) {
        for (bound, place) in self.near.drain(..) {
            if bound.at_most(limit) {
                pass(place);
            }
        }
    }
}
