//! Memory of blocks: sixteen numbers of one field side by side, on a cache line's border.
//!
//! A *tile* is sixteen items, field after field; each field of it is one [`Lane`]. Kernels read and
//! write tiles whatever their vectors' width is, so the layout is the same at every level.

use std::cell::RefCell;
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
    /// The fields of a tile; `None` where there is no such tile.
    #[inline(always)]
    pub fn tile<const FIELDS: usize>(&self, t: usize) -> Option<&'a [Lane<T>; FIELDS]> {
        self.lanes.get(t * self.step..)?.first_chunk()
    }
}

/// How many tiles so many items take.
pub(crate) const fn tiles(items: usize) -> usize {
    items.div_ceil(TILE)
}

thread_local! {
    static F32: RefCell<Vec<Lane<f32>>> = const { RefCell::new(Vec::new()) };
    static F64: RefCell<Vec<Lane<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Lanes of each thread, kept from call to call: to make room anew would take a short batch's time.
pub trait Kept: Sized + 'static {
    #[doc(hidden)]
    fn kept() -> &'static LocalKey<RefCell<Vec<Lane<Self>>>>;
}
impl Kept for f32 {
    fn kept() -> &'static LocalKey<RefCell<Vec<Lane<f32>>>> {
        &F32
    }
}
impl Kept for f64 {
    fn kept() -> &'static LocalKey<RefCell<Vec<Lane<f64>>>> {
        &F64
    }
}

/// Lends the thread's lanes, with anything in them.
pub(crate) fn with_lanes<T: Kept + Copy + Default, R>(
    count: usize,
    run: impl FnOnce(&mut [Lane<T>]) -> R,
) -> R {
    T::kept().with(|kept| match kept.try_borrow_mut() {
        Ok(mut lanes) => {
            if lanes.len() < count {
                lanes.resize(count, Lane::default());
            }
            run(&mut lanes[..count])
        }
        // Lent already, further up.
        Err(_) => run(&mut vec![Lane::default(); count]),
    })
}
