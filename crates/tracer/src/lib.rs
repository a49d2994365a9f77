//! The optics.
