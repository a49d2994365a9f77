//! Checks of pictures that scripts of a page ask for.

use js_sys::{Array, Uint8Array};
use wasm_bindgen::prelude::*;

use crate::check::{CheckReport, ScriptCheck};
use crate::threads;

/// A picture that is being held against a scene.
#[wasm_bindgen(js_name = Check)]
pub struct WebCheck(ScriptCheck);

#[wasm_bindgen(js_class = Check)]
impl WebCheck {
    /// Starts a check; the order is JSON, and its files lie in the store.
    #[wasm_bindgen(constructor)]
    pub fn new(order: &str) -> Result<WebCheck, JsError> {
        threads::tell_of_panics();
        Ok(Self(ScriptCheck::start(order)?))
    }

    /// What was found as JSON, and then PNG files as arrays of bytes, once; `undefined` before it is finished.
    pub fn take(&self) -> Result<Option<Array>, JsError> {
        let Some(CheckReport { json, pictures }) = self.0.take()? else { return Ok(None) };
        let found = Array::of1(&json.into());
        for png in pictures {
            found.push(&Uint8Array::from(&png[..]).into());
        }
        Ok(Some(found))
    }
}
