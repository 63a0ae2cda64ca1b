//! Memory of blocks: sixteen numbers of one field side by side, on a cache line's border.
//!
//! A *tile* is sixteen items, field after field; each field of it is one [`Lane`]. Kernels of every vector width read
//! and write tiles, so all levels share one layout.

use crate::Real;
use crate::scalar::real::in_format;
use std::any::Any;
use std::cell::RefCell;
use std::ops::{Deref, DerefMut};
use std::thread::LocalKey;

/// The number of items of a tile.
pub(crate) const TILE: usize = 16;

/// One field of a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lane<T>(pub [T; TILE]);

impl<T: Copy + Default> Default for Lane<T> {
    fn default() -> Self {
        Lane([T::default(); TILE])
    }
}

/// Items in tiles, to be read: field `k` of tile `t` is `lanes[t * step + k]`. With a step of zero the first tile is
/// every tile.
#[derive(Debug)]
pub(crate) struct Tiles<'a, T> {
    pub lanes: &'a [Lane<T>],
    pub step: usize,
}

impl<T> Clone for Tiles<'_, T> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Tiles<'_, T> {}

impl<'a, T> Tiles<'a, T> {
    /// Creates a view of tiles in memory order, each of `fields` lanes.
    pub fn new(lanes: &'a [Lane<T>], fields: usize) -> Self {
        Tiles {
            lanes,
            step: fields,
        }
    }
    /// Creates a view of one tile that stands for all.
    pub fn one(lanes: &'a [Lane<T>]) -> Self {
        Tiles { lanes, step: 0 }
    }
    /// Returns the fields of a tile; `None` beyond the last tile.
    #[inline(always)]
    pub fn tile<const FIELDS: usize>(&self, t: usize) -> Option<&'a [Lane<T>; FIELDS]> {
        self.lanes.get(t * self.step..)?.first_chunk()
    }
}

/// The largest number of tiles in a block of results.
pub(crate) const BLOCK: usize = 64;

/// The number of lanes from one field of results to the next: odd, so that fields do not compete for one set of cache
/// lines, and a constant, so that kernels need no more than one pointer.
pub(crate) const PLANE: usize = BLOCK + 1;

/// A buffer for results, field by field: field `k` of tile `t` goes to `lanes[k * PLANE + t]`.
#[derive(Debug)]
pub(crate) struct ResultTiles<'a, T> {
    pub lanes: &'a mut [Lane<T>],
    /// The number of tiles to compute.
    pub tiles: usize,
}

impl<T> ResultTiles<'_, T> {
    /// Returns a shorter borrow of this buffer.
    pub fn again(&mut self) -> ResultTiles<'_, T> {
        ResultTiles {
            lanes: self.lanes,
            tiles: self.tiles,
        }
    }
    /// Returns the lane of a field of a tile.
    #[inline(always)]
    pub fn lane(&mut self, t: usize, k: usize) -> Option<&mut Lane<T>> {
        self.lanes.get_mut(k * PLANE + t)
    }
}

/// Returns the number of lanes of a buffer for results with `fields` numbers.
pub(crate) const fn planes(fields: usize) -> usize {
    fields * PLANE
}

/// Results to be read.
#[derive(Debug)]
pub(crate) struct Planes<'a, T>(pub &'a [Lane<T>]);

impl<T> Clone for Planes<'_, T> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Planes<'_, T> {}

impl<'a, T> Planes<'a, T> {
    /// Returns the tiles of field `k`, and what follows in memory.
    #[inline(always)]
    pub fn field(&self, k: usize) -> &'a [Lane<T>] {
        self.0.get(k * PLANE..).unwrap_or_default()
    }
    /// Returns the results without their first `k` fields.
    #[inline(always)]
    pub fn from(&self, k: usize) -> Self {
        Planes(self.field(k))
    }
}

/// Returns the number of tiles that `items` items fill.
pub(crate) const fn tiles(items: usize) -> usize {
    items.div_ceil(TILE)
}

thread_local! {
    static F32: Stock<f32> = const { Stock::new() };
    static F64: Stock<f64> = const { Stock::new() };
}

/// The buffers of one thread, kept from call to call. New buffers would take as long as a short batch, most of it for
/// the system's page allocation.
#[derive(Debug)]
pub struct Stock<T> {
    /// The lanes that a call computes with.
    scratch: RefCell<Vec<Lane<T>>>,
    /// Lists that no [`LaneBuffer`] holds now.
    lists: RefCell<Vec<Vec<Lane<T>>>>,
    /// Furnished buffers, each with the number of its owner; the latest come last.
    rooms: RefCell<Vec<(u64, Vec<Lane<T>>)>>,
}

impl<T> Stock<T> {
    const fn new() -> Self {
        Stock {
            scratch: RefCell::new(Vec::new()),
            lists: RefCell::new(Vec::new()),
            rooms: RefCell::new(Vec::new()),
        }
    }
}

/// Returns the buffers of this thread.
#[inline]
fn stock<T: Real>() -> &'static LocalKey<Stock<T>> {
    in_format([&F32, &F64])
}

/// Calls `run` with `count` lanes of this thread; their contents are arbitrary.
pub(crate) fn with_lanes<T: Real, R>(count: usize, run: impl FnOnce(&mut [Lane<T>]) -> R) -> R {
    stock::<T>().with(|kept| match kept.scratch.try_borrow_mut() {
        Ok(mut lanes) => {
            if lanes.len() < count {
                lanes.resize(count, Lane::default());
            }
            run(&mut lanes[..count])
        }
        // An outer call uses the lanes already.
        Err(_) => run(&mut vec![Lane::default(); count]),
    })
}

/// Calls `run` with this thread's buffer number `whose`. `furnish` makes the buffer unless the thread still has it.
pub(crate) fn with_room<T: Real, R>(
    whose: u64,
    furnish: impl FnOnce() -> Vec<Lane<T>>,
    run: impl FnOnce(&mut [Lane<T>]) -> R,
) -> R {
    let kept = stock::<T>().with(|kept| {
        let mut rooms = kept.rooms.borrow_mut();
        let at = rooms.iter().position(|room| room.0 == whose);
        at.map(|at| rooms.remove(at).1)
    });
    let mut room = kept.unwrap_or_else(furnish);
    let result = run(&mut room);
    if room.len() <= KEPT_LANES {
        stock::<T>().with(|kept| {
            let mut rooms = kept.rooms.borrow_mut();
            if rooms.len() == KEPT_LISTS {
                rooms.remove(0);
            }
            rooms.push((whose, room));
        });
    }
    result
}

/// Calls `run` with this thread's value of a type: the default, or as the last call left it.
pub(crate) fn with_kept<X: Default + 'static, R>(run: impl FnOnce(&mut X) -> R) -> R {
    thread_local! {
        static KEPT: RefCell<Vec<Box<dyn Any>>> = const { RefCell::new(Vec::new()) };
    }
    // Taken out, since `run` may come here again.
    let mut own: Box<dyn Any> = KEPT.with(|kept| {
        let mut all = kept.borrow_mut();
        match all.iter().position(|own| own.is::<X>()) {
            Some(at) => all.swap_remove(at),
            None => Box::new(X::default()),
        }
    });
    let mut other = X::default();
    let result = run(own.downcast_mut().unwrap_or(&mut other));
    KEPT.with(|kept| kept.borrow_mut().push(own));
    result
}

/// The limits of a thread's stock: the number of lists and buffers, and the lanes of each, half a megabyte in single
/// precision. Filling a longer list takes longer than allocating it.
const KEPT_LISTS: usize = 8;
const KEPT_LANES: usize = 1 << 13;

/// Lanes from the thread's stock, with arbitrary contents. They return to the stock when this value is dropped.
#[derive(Debug)]
pub struct LaneBuffer<T: Real> {
    lanes: Vec<Lane<T>>,
    count: usize,
}

impl<T: Real> LaneBuffer<T> {
    /// Takes `count` lanes from the stock, or allocates them.
    pub(crate) fn new(count: usize) -> Self {
        if count == 0 {
            return LaneBuffer {
                lanes: Vec::new(),
                count,
            };
        }
        let old = stock::<T>().with(|kept| {
            let mut lists = kept.lists.borrow_mut();
            // The shortest one, so that long ones are left for those that need them.
            let fitting = lists.iter().enumerate().filter(|own| own.1.len() >= count);
            let (at, _) = fitting.min_by_key(|own| own.1.len())?;
            Some(lists.swap_remove(at))
        });
        let lanes = old.unwrap_or_else(|| vec![Lane::default(); count]);
        LaneBuffer { lanes, count }
    }
}

impl<T: Real> Deref for LaneBuffer<T> {
    type Target = [Lane<T>];
    #[inline]
    fn deref(&self) -> &[Lane<T>] {
        self.lanes.get(..self.count).unwrap_or_default()
    }
}
impl<T: Real> DerefMut for LaneBuffer<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [Lane<T>] {
        self.lanes.get_mut(..self.count).unwrap_or_default()
    }
}

impl<T: Real> Drop for LaneBuffer<T> {
    fn drop(&mut self) {
        let mut lanes = std::mem::take(&mut self.lanes);
        if lanes.is_empty() || lanes.len() > KEPT_LANES {
            return;
        }
        // The stock of a thread that ends is gone already.
        let _ = stock::<T>().try_with(|kept| {
            let Ok(mut lists) = kept.lists.try_borrow_mut() else {
                return;
            };
            if lists.len() < KEPT_LISTS {
                return lists.push(lanes);
            }
            if let Some(least) = lists.iter_mut().min_by_key(|lanes| lanes.len())
                && least.len() < lanes.len()
            {
                std::mem::swap(least, &mut lanes);
            }
        });
    }
}
