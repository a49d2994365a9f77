//! Clocks. In a browser they are those of the page, which the standard library does not know.

pub use std::time::Duration;
pub use web_time::{Instant, SystemTime, UNIX_EPOCH};
