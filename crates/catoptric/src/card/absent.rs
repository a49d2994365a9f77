//! A program that is built without graphics cards: none can be opened.

use anyhow::{Result, bail};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use serde_json::Value;

use super::CardOutcome;
use crate::arguments::BackendArguments;

/// A card that cannot be had.
pub(crate) enum NoCard {}

pub(crate) fn is_likely(_: &BackendArguments) -> bool {
    false
}

impl NoCard {
    pub(crate) fn open(_: &BackendArguments) -> Result<Self> {
        bail!(
            "this program is built without graphics cards; use --backend cpu, or build it with all features: \
             `cargo install --path crates/catoptric`"
        )
    }

    pub(crate) fn name(&self) -> &str {
        match *self {}
    }

    pub(crate) fn to_json(&self) -> Value {
        match *self {}
    }

    pub(crate) fn draw(&self, _: &RenderScene, _: RenderSettings, _: &RenderControl) -> Result<CardOutcome> {
        match *self {}
    }
}
