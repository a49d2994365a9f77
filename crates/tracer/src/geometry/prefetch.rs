//! Memory asked for ahead of its use.

/// Asks the processor to fetch an item of `list`, without waiting for it. Nothing happens if there is none, or on processors
/// other than x86-64.
#[inline(always)]
#[cfg_attr(target_arch = "x86_64", allow(unsafe_code, reason = "there is no safe way to ask"))]
pub(crate) fn fetch<T>(list: &[T], index: u32) {
    #[cfg(target_arch = "x86_64")]
    if let Some(item) = list.get(index as usize) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        const LINE: usize = 64;
        let start = std::ptr::from_ref(item).cast::<i8>();
        for line in (0..size_of::<T>()).step_by(LINE) {
            // SAFETY: every x86-64 processor has the instruction, which changes nothing that a program can see, and no address
            // makes it fail.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (list, index);
}
