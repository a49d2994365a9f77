//! Threads of the studio: workers that the page starts.

use std::cell::Cell;
use std::io;

use catoptric_platform::threads::{ThreadWork, use_threads};
use js_sys::Promise;
use js_sys::futures::future_to_promise;
use wasm_bindgen::prelude::*;

thread_local! {
    /// Whether this worker is drawing a frame.
    static IS_DRAWING: Cell<bool> = const { Cell::new(false) };
}

#[wasm_bindgen]
extern "C" {
    /// Tells the page something, from whichever worker.
    #[wasm_bindgen(js_name = postMessage)]
    fn post_message(message: &JsValue);
}

/// From now on the page starts threads, of which so many run at the same time: to be called if it can share memory.
#[wasm_bindgen(js_name = useThreads)]
pub fn use_page_threads(processors: usize) {
    use_threads(processors, |name, work| {
        let work = Box::into_raw(Box::new(work)) as u32;
        tell("thread", &[("name", name.into()), ("work", work.into())])
            .map_err(|_| io::ErrorKind::Other.into())
    });
}

/// Does what a message `thread` asked for: in the new worker, once. What it gives is done when that is.
///
/// # Safety
/// `work` comes from that message, and is done only once.
#[allow(unsafe_code, reason = "a worker is handed its work as a number")]
#[wasm_bindgen(js_name = runThread)]
pub unsafe fn run_thread(work: u32) -> Option<Promise> {
    // SAFETY: `use_page_threads` made it from a box, and the page hands it on to one worker.
    let work = unsafe { Box::from_raw(work as *mut ThreadWork) };
    work().map(|task| {
        future_to_promise(async {
            task.await;
            Ok(JsValue::UNDEFINED)
        })
    })
}

/// From now on the page is told of a panic, in whichever worker: the browser itself knows no more than that something
/// unreachable was reached.
pub(crate) fn tell_of_panics() {
    std::panic::set_hook(Box::new(|info| {
        let _ = tell("panic", &[("message", info.to_string().into())]);
    }));
}

/// Draws a frame.
pub(crate) fn drawing<T>(frame: impl FnOnce() -> T) -> T {
    IS_DRAWING.set(true);
    let drawn = frame();
    IS_DRAWING.set(false);
    drawn
}

/// Has a frame drawn soon, whoever asks for it.
pub(crate) fn wake() {
    // Each frame says itself when the next one is wanted.
    if !IS_DRAWING.get() {
        // A page that is gone needs no frame.
        let _ = tell("wake", &[]);
    }
}

fn tell(kind: &str, parts: &[(&str, JsValue)]) -> Result<(), JsValue> {
    let message = js_sys::Object::new();
    js_sys::Reflect::set(&message, &"type".into(), &kind.into())?;
    for (key, value) in parts {
        js_sys::Reflect::set(&message, &(*key).into(), value)?;
    }
    post_message(&message);
    Ok(())
}
