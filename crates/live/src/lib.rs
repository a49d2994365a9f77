#![doc = include_str!("../README.md")]
//! ## Resolution, processor and method
//!
//! While something moves, pictures have the resolution that holds the frame rate. Outlines and the ground grid are found
//! by tracing.
//!
//! A graphics card can draw in place of the processor ([`Live::draw_with`]); its pictures stay on it ([`Frame::card`]).
//! What it cannot draw, the processor draws.
//!
//! A [`Request`] may name another method than Whitted's tree, or ask for [the layers behind its picture](DisplayContent).

mod canvas;
mod card;
mod frame;
mod grid;
mod job;
mod live;
mod method_picture;
mod options;
mod outline;
mod pace;
mod request;
mod request_state;
mod shared;
mod status;
mod worker;

pub use card::{CardPicture, CardSource};
pub use frame::{Frame, GridKind, GridLine, Polyline};
pub use job::{JobError, JobProgress, RenderJob};
pub use live::Live;
pub use options::LiveOptions;
pub use request::{DisplayContent, GridSpec, Request};
pub use status::{LiveError, Status};
