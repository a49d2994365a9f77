//! `catoptric studio`, and `catoptric` alone

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use catoptric_scene::Example;
use catoptric_studio::{Start, StudioError, open};

use super::Outcome;

pub(crate) fn run(scene: Option<&str>) -> Result<Outcome> {
    let start = match scene {
        None => Start::Last,
        Some(name) if Example::find(name).is_some() => Start::Example(name.to_owned()),
        Some(path) => Start::File(PathBuf::from(path)),
    };
    match open(start) {
        Ok(()) => Ok(Outcome::Done),
        Err(error @ StudioError::NoDisplay) => {
            Err(anyhow!("{error}; to make a picture without one, see `catoptric render --help`"))
        }
        Err(error) => Err(error.into()),
    }
}
