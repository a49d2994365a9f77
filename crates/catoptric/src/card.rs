//! Graphics cards, if the program is built for them (feature `gpu`).

#[cfg(not(feature = "gpu"))]
mod absent;
#[cfg(feature = "gpu")]
mod present;

use std::time::Duration;

use catoptric_tracer::raster::MethodOutput;

#[cfg(not(feature = "gpu"))]
pub(crate) use absent::{NoCard as Card, is_likely};
#[cfg(feature = "gpu")]
pub(crate) use present::{Card, is_likely};

/// What a card made of a scene.
#[cfg_attr(not(feature = "gpu"), expect(dead_code, reason = "there is no card to make it"))]
pub(crate) enum CardOutcome {
    /// The picture, and the time that the card worked by its own clock.
    Drawn(MethodOutput, Option<Duration>),
    /// Why the card cannot draw the scene, which the processor can.
    Refused(anyhow::Error),
}
