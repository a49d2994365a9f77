//! The picture that follows the document: a window asks, a worker traces, the newest picture is there to be shown.
//!
//! [`Live`] never blocks the thread that asks. While something moves, pictures are traced at the resolution that holds
//! the frame rate; then the picture grows to the full resolution and is antialiased sample by sample. The fully
//! refined picture equals [`catoptric_tracer::render`] bit by bit. Beside the picture stand the [outlines](Polyline) of
//! chosen bodies and a [ground grid](GridLine), both found by tracing.
//!
//! A graphics card can draw in place of the processor ([`Live::draw_with`]); its pictures stay on it
//! ([`Frame::card`]). What it cannot draw, the processor draws.
//!
//! Whitted's tree is the usual way of drawing; a [`Request`] may name another, or ask for what lies behind its picture.
//!
//! [`RenderJob`] renders a final picture in the background.

mod canvas;
mod frame;
mod grid;
mod job;
mod live;
mod method_picture;
mod outline;
mod pace;
mod priority;
mod request;
mod request_state;
mod shared;
mod status;
mod worker;

pub use frame::{Frame, GridKind, GridLine, Polyline};
pub use job::{JobError, JobProgress, RenderJob};
pub use live::{Live, LiveOptions};
pub use request::{DisplayContent, GridSpec, Request};
pub use status::{LiveError, Status};
