//! Block kernels of the winding number of a ring around a point: over all edges, or over those of a slab.
//!
//! Both have the bits of the fold over all edges. Signs of products decide, and near zero these are unreliable: the
//! edges are then folded one by one.
use crate::kernels::cpu::arch::Vector;
use crate::kernels::cpu::lane::{Lane, TILE, tiles};
use crate::kernels::cpu::nearest::{Passes, ReliableLimits};
use crate::polygon::slabs::HeightSlabs;
use crate::shape::edges;
use crate::{Real, Vec2};

/// The edges of a ring in slabs, in lanes.
pub struct SlabLanes<T> {
    slabs: HeightSlabs,
    /// The first tile of every slab, and the number of its edges.
    places: Vec<(usize, usize)>,
    /// For sixteen edges of a slab the coordinates of both ends.
    tiles: Vec<[Lane<T>; 4]>,
    /// The lowest and the highest coordinates.
    low: Vec2<T>,
    high: Vec2<T>,
}

impl<T: Real> SlabLanes<T> {
    pub(crate) fn of(ring: &[Vec2<T>]) -> Self {
        let all: Vec<[f64; 2]> = edges(ring)
            .map(|edge| edge.map(|end| end.y.widen()))
            .collect();
        let slabs = HeightSlabs::new(all.into_iter(), TILE / 2);
        let (mut places, mut all) = (Vec::new(), Vec::new());
        for ends in slabs.starts.windows(2) {
            let own = &slabs.edges[ends[0]..ends[1]];
            places.push((all.len(), own.len()));
            for some in own.chunks(TILE) {
                // Edges of length zero, which no line passes, fill the rest.
                let mut tile = [Lane::default(); 4];
                for (k, &edge) in some.iter().enumerate() {
                    let (from, to) = (edge as usize, edge as usize + 1);
                    let (from, to) = (ring[from], ring[if to < ring.len() { to } else { 0 }]);
                    for (lane, x) in tile.iter_mut().zip([from.x, from.y, to.x, to.y]) {
                        lane.0[k] = x;
                    }
                }
                all.push(tile);
            }
        }
        let (mut low, mut high) = (Vec2::zero(), Vec2::zero());
        if let Some(&first) = ring.first() {
            (low, high) = (first, first);
        }
        for v in ring {
            low = Vec2::new(low.x.least(v.x), low.y.least(v.y));
            high = Vec2::new(high.x.most(v.x), high.y.most(v.y));
        }
        SlabLanes {
            slabs,
            places,
            tiles: all,
            low,
            high,
        }
    }
}

/// Returns the winding number of a ring around a point; `None` where a sign is unreliable.
#[inline(always)]
pub(crate) fn of_slabs<T: Real, V: Vector<T>>(
    point: Vec2<T>,
    ring: &SlabLanes<T>,
    limits: ReliableLimits<T>,
) -> Option<T> {
    let origin = Vec2::new(V::splat(point.x), V::splat(point.y));
    let mut all = Passes::<V>::none();
    let slab = ring.slabs.slab(point.y.widen());
    let &(first, count) = ring.places.get(slab)?;
    for (t, tile) in ring
        .tiles
        .get(first..)?
        .iter()
        .take(tiles(count))
        .enumerate()
    {
        let mut at = 0;
        while at < TILE && t * TILE + at < count {
            let a = Vec2::new(V::read(&tile[0], at), V::read(&tile[1], at));
            let b = Vec2::new(V::read(&tile[2], at), V::read(&tile[3], at));
            all.see(a - origin, b - origin);
            at += V::WIDTH;
        }
    }
    let (low, high) = (ring.low - point, ring.high - point);
    let extent = low.x.unsigned().most(low.y.unsigned());
    let extent = extent.most(high.x.unsigned()).most(high.y.unsigned());
    all.folded::<T>().reliable(extent, limits)
}

/// Returns the winding number of a ring around a point, from the numbers of its vertices; `None` where a sign is
/// unreliable.
#[inline(always)]
pub(crate) fn of_ring<T: Real, V: Vector<T>>(
    point: Vec2<T>,
    ring: &[T],
    limits: ReliableLimits<T>,
) -> Option<T> {
    let origin = Vec2::new(V::splat(point.x), V::splat(point.y));
    let (mut all, mut extent) = (Passes::<V>::none(), V::zero());
    let count = ring.len() / 2;
    let mut first = 0;
    while first + V::WIDTH < count {
        let own = ring.get(2 * first..)?;
        let [x, y, next_x, next_y] = V::from_items(
            #[inline(always)]
            |i| match own[2 * i..].first_chunk() {
                Some(edge) => *edge,
                None => [T::default(); 4],
            },
        );
        let a = Vec2::new(x, y) - origin;
        all.see(a, Vec2::new(next_x, next_y) - origin);
        extent = extent.most(a.x.unsigned().most(a.y.unsigned()));
        first += V::WIDTH;
    }
    let mut lane = Lane::default();
    extent.write(&mut lane, 0);
    let mut extent = T::default();
    for &x in &lane.0[..V::WIDTH] {
        extent = extent.most(x);
    }
    let mut all = all.folded::<T>();
    while first < count {
        let next = if first + 1 < count { first + 1 } else { 0 };
        let a = Vec2::new(ring[2 * first], ring[2 * first + 1]) - point;
        all.see(a, Vec2::new(ring[2 * next], ring[2 * next + 1]) - point);
        extent = extent.most(a.x.unsigned().most(a.y.unsigned()));
        first += 1;
    }
    all.reliable(extent, limits)
}
