//! `catoptric studio`, and `catoptric` alone

use std::path::Path;

use anyhow::{Result, anyhow};
use catoptric_studio::{Interruption, Start, StudioError, open};

use super::Outcome;
use crate::{input, interrupt};

pub(crate) fn run(scene: Option<&Path>) -> Result<Outcome> {
    let start = match scene {
        None => Start::Last,
        Some(scene) => match input::source(scene)? {
            input::Source::Example(example) => Start::Example(example.name.to_owned()),
            // One with errors is opened in part.
            input::Source::File(path) => {
                input::check_readable(path)?;
                Start::File(path.to_owned())
            }
        },
    };
    let interruption = Interruption::default();
    interrupt::ask_first({
        let interruption = interruption.clone();
        move || interruption.ask()
    });
    match open(&start, &interruption) {
        Ok(()) if interruption.is_asked() => Ok(Outcome::Interrupted),
        Ok(()) => Ok(Outcome::Done),
        Err(error @ StudioError::Thread(_)) => Err(error.into()),
        Err(error) => Err(anyhow!("{error}; `catoptric render` makes pictures without a window")),
    }
}
