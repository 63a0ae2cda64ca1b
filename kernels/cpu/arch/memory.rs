//! Lanes seen as plain numbers in memory.
use crate::kernels::cpu::lane::{Lane, TILE};
use std::slice;

/// Returns the numbers of lanes, one lane after another.
#[inline]
pub fn flat<T: Copy>(lanes: &[Lane<T>]) -> &[T] {
    const { assert!(size_of::<Lane<T>>() == TILE * size_of::<T>()) };
    // Sound: a lane is an array of `TILE` numbers without padding.
    unsafe { slice::from_raw_parts(lanes.as_ptr().cast(), lanes.len() * TILE) }
}

/// Prefetches as many bytes as the list has, beginning `ahead` numbers behind its start. The address may be invalid.
#[inline(always)]
pub fn prefetch<T>(list: &[T], ahead: usize) {
    #[cfg(all(target_arch = "x86_64", not(geograd_portable)))]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        let first = list.as_ptr().wrapping_add(ahead).cast::<i8>();
        for line in (0..size_of_val(list)).step_by(64) {
            // Sound: no address is a fault, and every x86-64 has the instruction.
            unsafe { _mm_prefetch::<_MM_HINT_T1>(first.wrapping_add(line)) };
        }
    }
    #[cfg(not(all(target_arch = "x86_64", not(geograd_portable))))]
    let _ = (list, ahead);
}
