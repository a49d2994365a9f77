//! The panel of the audit: the rays of the pinned pixel with their numbers.

mod listing;
mod numbers;
mod panel;
mod rows;
mod terms;

pub(crate) use listing::AuditListing;
pub(crate) use numbers::{color_text, short};
pub(crate) use panel::panel_ui;
pub(crate) use rows::{kind_color, tag};
