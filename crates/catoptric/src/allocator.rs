//! The allocator, and what happens when the system refuses memory.
//!
//! Where much memory is asked for at once, as for a picture or a file, its refusal is an error like any other.
//! Everywhere else Rust ends a program by `abort`, for which there is no stable hook. On Unix that is a signal: here it
//! becomes words and the exit status of errors.
#![allow(
    unsafe_code,
    reason = "the trait of allocators and handlers of signals are unsafe; all of both is in this file"
)]

use std::alloc::{GlobalAlloc, Layout};
use std::sync::atomic::{AtomicBool, Ordering};

use mimalloc::MiMalloc;

/// Whether the system has refused memory: a program that aborts after that aborts for it, most likely.
static IS_REFUSED: AtomicBool = AtomicBool::new(false);

/// Gives memory back soon after it was used. The C library of Linux keeps up to 64 MB for each of many threads: the
/// studio grew to several times what it needed.
pub(crate) struct Allocator;

// SAFETY: every call is passed on as it came to mimalloc, which fulfils the contract. Looking at the result and storing
// a flag allocates nothing and cannot panic.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise is passed on.
        noted(unsafe { MiMalloc.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise is passed on.
        noted(unsafe { MiMalloc.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's promise is passed on.
        noted(unsafe { MiMalloc.realloc(block, layout, size) })
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is passed on.
        unsafe { MiMalloc.dealloc(block, layout) }
    }
}

fn noted(block: *mut u8) -> *mut u8 {
    if block.is_null() {
        IS_REFUSED.store(true, Ordering::Relaxed);
    }
    block
}

/// From now on, a program that aborts because memory was refused says so and ends with the status of errors.
#[cfg(unix)]
pub(crate) fn listen() {
    use std::fs::File;
    use std::io::{Write as _, stderr};
    use std::os::fd::AsFd as _;

    use signal_hook::consts::SIGABRT;
    use signal_hook::low_level::{emulate_default_handler, exit, register};

    const WORDS: &[u8] =
        b"error: the system refuses memory for this; close other programs, raise the limit of memory, \
        or make scene and picture smaller\n";
    let Ok(stderr) = stderr().as_fd().try_clone_to_owned().map(File::from) else { return };
    let act = move || {
        if !IS_REFUSED.load(Ordering::Relaxed) {
            let _ = emulate_default_handler(SIGABRT);
            return;
        }
        // Straight to the descriptor: the stream of the library has a lock.
        let _ = (&stderr).write_all(WORDS);
        exit(crate::console::STATUS_ERROR.into());
    };
    // SAFETY: the handler only loads an atomic, writes to a descriptor and leaves by `_exit`; all of these, and
    // `emulate_default_handler`, are safe in the handler of a signal. It allocates nothing and takes no lock.
    let _ = unsafe { register(SIGABRT, act) };
}

#[cfg(not(unix))]
pub(crate) fn listen() {}
