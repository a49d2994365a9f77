//! Haines's Neutral File Format (E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987).

mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;
