//! Threads that stand back behind others.

/// The priority of a thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Priority {
    /// That of the program.
    Normal,
    /// For what is to be seen soon.
    Low,
    /// For what may take its time.
    Lowest,
}

/// Lowers the priority of the current thread, so that a window drawn by the same processors stays smooth. Where the
/// system does not allow it, nothing is lost but that.
#[cfg(not(target_family = "wasm"))]
pub fn lower_priority(priority: Priority) {
    use thread_priority::{ThreadPriority, set_current_thread_priority};

    // Of 0…99; the middle is normal. On Linux they make a niceness of 4 and 19: beside other programs that are busy,
    // such as a compiler, the view should still move.
    let value: u8 = match priority {
        Priority::Normal => return,
        Priority::Low => 38,
        Priority::Lowest => 0,
    };
    if let Ok(value) = value.try_into() {
        let _ = set_current_thread_priority(ThreadPriority::Crossplatform(value));
    }
}

/// A page does not choose the priority of its threads.
#[cfg(target_family = "wasm")]
pub fn lower_priority(_priority: Priority) {}
