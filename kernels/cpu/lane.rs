//! Memory of blocks: sixteen numbers of one field side by side, on a cache line's border.
//!
//! A *tile* is sixteen items, field after field; each field of it is one [`Lane`]. Kernels read and
//! write tiles whatever their vectors' width is, so the layout is the same at every level.

use crate::Real;
use crate::scalar::real::in_format;
use std::cell::RefCell;
use std::ops::{Deref, DerefMut};
use std::thread::LocalKey;

/// Items of a tile.
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

/// Items in tiles, to be read: field `k` of tile `t` is `lanes[t * step + k]`. With a step of zero
/// the first tile stands for all.
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
    /// One tile after another, of so many fields.
    pub fn new(lanes: &'a [Lane<T>], fields: usize) -> Self {
        Tiles {
            lanes,
            step: fields,
        }
    }
    /// One tile that stands for all.
    pub fn one(lanes: &'a [Lane<T>]) -> Self {
        Tiles { lanes, step: 0 }
    }
    /// Returns the fields of a tile; `None` where there is no such tile.
    #[inline(always)]
    pub fn tile<const FIELDS: usize>(&self, t: usize) -> Option<&'a [Lane<T>; FIELDS]> {
        self.lanes.get(t * self.step..)?.first_chunk()
    }
}

/// Most tiles of a block of results.
pub(crate) const BLOCK: usize = 64;

/// Lanes from one field of results to the next: odd, so that not all fields want the same lines of the
/// cache, and a constant, so that kernels need no more than one pointer.
pub(crate) const PLANE: usize = BLOCK + 1;

/// Room for results, field by field: field `k` of tile `t` goes to `lanes[k * PLANE + t]`.
#[derive(Debug)]
pub(crate) struct Results<'a, T> {
    pub lanes: &'a mut [Lane<T>],
    /// How many tiles are asked for.
    pub tiles: usize,
}

impl<T> Results<'_, T> {
    /// Returns the same room, lent on.
    pub fn again(&mut self) -> Results<'_, T> {
        Results {
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

/// Lanes that results of so many fields take.
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
    /// Returns the tiles of a field and whatever follows.
    #[inline(always)]
    pub fn field(&self, k: usize) -> &'a [Lane<T>] {
        self.0.get(k * PLANE..).unwrap_or_default()
    }
    /// From a field on.
    #[inline(always)]
    pub fn from(&self, k: usize) -> Self {
        Planes(self.field(k))
    }
}

/// Returns how many tiles so many items take.
pub(crate) const fn tiles(items: usize) -> usize {
    items.div_ceil(TILE)
}

thread_local! {
    static F32: Stock<f32> = const { Stock::new() };
    static F64: Stock<f64> = const { Stock::new() };
}

/// Lanes of each thread, kept from call to call: to make room anew would take a short batch's time, most of it
/// the system's for giving pages and taking them back.
#[derive(Debug)]
pub struct Stock<T> {
    /// The lanes that a call computes with.
    desk: RefCell<Vec<Lane<T>>>,
    /// Lists that are not lent.
    lists: RefCell<Vec<Vec<Lane<T>>>>,
    /// Rooms, each with the number of its owner; the latest come last.
    rooms: RefCell<Vec<(u64, Vec<Lane<T>>)>>,
}

impl<T> Stock<T> {
    const fn new() -> Self {
        Stock {
            desk: RefCell::new(Vec::new()),
            lists: RefCell::new(Vec::new()),
            rooms: RefCell::new(Vec::new()),
        }
    }
}

/// Returns the lanes that this thread keeps.
#[inline]
fn stock<T: Real>() -> &'static LocalKey<Stock<T>> {
    in_format([&F32, &F64])
}

/// Lends the thread's lanes, with anything in them.
pub(crate) fn with_lanes<T: Real, R>(count: usize, run: impl FnOnce(&mut [Lane<T>]) -> R) -> R {
    stock::<T>().with(|kept| match kept.desk.try_borrow_mut() {
        Ok(mut lanes) => {
            if lanes.len() < count {
                lanes.resize(count, Lane::default());
            }
            run(&mut lanes[..count])
        }
        // The lanes are lent already, further up.
        Err(_) => run(&mut vec![Lane::default(); count]),
    })
}

/// Lends the thread's room of a number. `furnish` makes one unless the thread still keeps it.
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

/// How many lists and rooms a thread keeps, and of how many lanes at most: half a megabyte of single precision. A
/// longer list takes longer to fill than to allocate.
const KEPT_LISTS: usize = 8;
const KEPT_LANES: usize = 1 << 13;

/// Lanes for as long as they are needed, with anything in them.
#[derive(Debug)]
pub struct Lent<T: Real> {
    lanes: Vec<Lane<T>>,
    count: usize,
}

impl<T: Real> Lent<T> {
    /// So many lanes: those of a list that is not lent, or new ones.
    pub(crate) fn new(count: usize) -> Self {
        if count == 0 {
            return Lent {
                lanes: Vec::new(),
                count,
            };
        }
        let old = stock::<T>().with(|kept| {
            let mut lists = kept.lists.borrow_mut();
            let fitting = lists.iter().position(|lanes| lanes.len() >= count);
            fitting.map(|at| lists.swap_remove(at))
        });
        let lanes = old.unwrap_or_else(|| vec![Lane::default(); count]);
        Lent { lanes, count }
    }
}

impl<T: Real> Deref for Lent<T> {
    type Target = [Lane<T>];
    #[inline]
    fn deref(&self) -> &[Lane<T>] {
        self.lanes.get(..self.count).unwrap_or_default()
    }
}
impl<T: Real> DerefMut for Lent<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [Lane<T>] {
        self.lanes.get_mut(..self.count).unwrap_or_default()
    }
}

impl<T: Real> Drop for Lent<T> {
    fn drop(&mut self) {
        let mut lanes = std::mem::take(&mut self.lanes);
        if lanes.is_empty() || lanes.len() > KEPT_LANES {
            return;
        }
        // A thread that ends keeps nothing.
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
