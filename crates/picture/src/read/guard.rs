//! A guard around decoders: a panic becomes the error of the file.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

use super::DecodeError;
use crate::format::PictureFormat;

thread_local! {
    /// True while this thread runs a decoder.
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Runs a decoder; should it panic, the result is [`DecodeError::Breakdown`] and no message appears.
///
/// The message of a panic comes from a hook of the whole process. The hook that was there before stays in charge of
/// all other panics, also of those of other threads meanwhile.
pub(super) fn guarded<T>(
    format: PictureFormat,
    decode: impl FnOnce() -> Result<T, DecodeError>,
) -> Result<T, DecodeError> {
    static HOOK: Once = Once::new();
    // A thread that panics may not change the hook.
    if !std::thread::panicking() {
        HOOK.call_once(|| {
            let others = take_hook();
            set_hook(Box::new(move |panic| {
                if !IS_GUARDED.try_with(Cell::get).unwrap_or(false) {
                    others(panic);
                }
            }));
        });
    }
    let was_guarded = IS_GUARDED.replace(true);
    let decoded = catch_unwind(AssertUnwindSafe(decode));
    IS_GUARDED.set(was_guarded);
    decoded.unwrap_or(Err(DecodeError::Breakdown { format: format.name() }))
}
