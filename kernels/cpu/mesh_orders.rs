//! Searches of many queries in one mesh, in the order of a curve through space, so that neighbours read the same nodes.
//!
//! The order changes no record: see [`mesh`](crate::mesh).
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::work::in_parallel;
use crate::mesh::{FaceRecord, MeshSurface, plain};
use crate::{Ray3, Real, Vec3};
use std::sync::Mutex;

/// The number of queries in a piece of work.
const PIECE: usize = 1024;
/// The number of queries from which on they are sorted.
const MANY: usize = 32;
/// The number of faces up to which rays keep the order of the list: the tree is in the cache in any case.
const SMALL: usize = 8192;
/// The steps of the curve along each axis, by their number of binary digits.
const DIGITS: u32 = 10;

/// Spreads ten binary digits, so that two others fit between neighbours.
fn spread(x: u64) -> u64 {
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

/// Returns the order of places along a Z-curve through their bounds; near places may keep the order of the list.
fn along_curve(places: impl ExactSizeIterator<Item = Vec3<f64>> + Clone) -> Vec<u32> {
    let count = places.len() as u32;
    if places.len() < MANY {
        return (0..count).collect();
    }
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for Vec3 { x, y, z } in places.clone() {
        for (k, x) in [x, y, z].into_iter().enumerate() {
            low[k] = if x < low[k] { x } else { low[k] };
            high[k] = if x > high[k] { x } else { high[k] };
        }
    }
    let steps = f64::from((1 << DIGITS) - 1);
    let scale = [0, 1, 2].map(|k| steps / (high[k] - low[k]));
    let key = |(i, Vec3 { x, y, z }): (usize, Vec3<f64>)| {
        // A conversion of NaN, of an axis without extent, is zero.
        let step = |k: usize, x: f64| spread(((x - low[k]) * scale[k]) as u64 & 0x3ff);
        (step(0, x) | step(1, y) << 1 | step(2, z) << 2) << 32 | i as u64
    };
    sorted(places.enumerate().map(key).collect())
}

/// The shifts of the digits by which keys are sorted, the lower one first; the lowest digit of the curve is left out.
const SHIFTS: [u32; 2] = [32 + DIGITS, 32 + 2 * DIGITS];

/// Returns the lower halves of keys, sorted by counts of digits of the upper halves: a third of the time of comparisons.
/// Keys of equal digits keep the order of the list.
fn sorted(mut keys: Vec<u64>) -> Vec<u32> {
    let mut other = vec![0; keys.len()];
    for shift in SHIFTS {
        let digit = |key: u64| (key >> shift) as usize & ((1 << DIGITS) - 1);
        // How often each digit stands, then where its next key goes.
        let mut next = [0_usize; 1 << DIGITS];
        for &key in &keys {
            next[digit(key)] += 1;
        }
        let mut start = 0;
        for next in &mut next {
            start += std::mem::replace(next, start);
        }
        for &key in &keys {
            let next = &mut next[digit(key)];
            other[*next] = key;
            *next += 1;
        }
        std::mem::swap(&mut keys, &mut other);
    }
    keys.into_iter().map(|key| key as u32).collect()
}

/// Returns the results of a search, in the order of the queries.
fn search<R: Copy + Send>(
    order: &[u32],
    none: R,
    run: impl Fn(&[u32], &mut Vec<R>) + Send + Sync,
) -> Vec<R> {
    let pieces = order.chunks(PIECE).count();
    let found: Vec<Mutex<Vec<R>>> = (0..pieces).map(|_| Mutex::new(Vec::new())).collect();
    let work = order.chunks(PIECE).zip(&found).collect();
    in_parallel(work, |(order, found): (&[u32], &Mutex<Vec<R>>)| {
        let mut own = Vec::with_capacity(order.len());
        run(order, &mut own);
        if let Ok(mut found) = found.lock() {
            *found = own;
        }
    });
    let mut all = vec![none; order.len()];
    for (order, found) in order.chunks(PIECE).zip(found) {
        let found = found.into_inner().unwrap_or_default();
        for (&i, record) in order.iter().zip(found) {
            all[i as usize] = record;
        }
    }
    all
}

/// Returns the nearest faces of points, which must be finite.
pub(super) fn nearest_of_all<T: Real>(
    surface: &MeshSurface<'_, T>,
    points: &[Vec3<T>],
) -> Vec<FaceRecord> {
    let order = along_curve(points.iter().map(|&point| plain(point)));
    search(&order, FaceRecord::NONE, |order, found| {
        (kernels_in::<T>().nearest_faces)(surface, points, order, found);
    })
}

/// Returns the first faces that rays meet, and what a function computes of a ray and its face while both are in the cache.
/// Rays must be finite.
pub(super) fn first_of_all<T: Real, R: Copy + Send>(
    surface: &MeshSurface<'_, T>,
    rays: &[Ray3<T>],
    of: impl Fn(Ray3<T>, u32) -> R + Send + Sync,
) -> Vec<Option<R>> {
    let order = match surface.mesh().faces().len() {
        ..=SMALL => (0..rays.len() as u32).collect(),
        _ => along_curve(rays.iter().map(|ray| plain(ray.point))),
    };
    search(&order, None, |order, found| {
        let mut faces = Vec::with_capacity(order.len());
        (kernels_in::<T>().first_faces)(surface, rays, order, &mut faces);
        let hits = order.iter().zip(faces);
        found.extend(hits.map(|(&i, face)| Some(of(rays[i as usize], face?))));
    })
}
