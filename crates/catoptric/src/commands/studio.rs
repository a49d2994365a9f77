//! `catoptric studio`, and `catoptric` alone

use std::path::Path;

use anyhow::{Result, anyhow};
use catoptric_studio::{Interruption, StartDocument, StudioError, open};

use super::CommandOutcome;
use crate::{input, interrupt};

pub(crate) fn run(scene: Option<&Path>) -> Result<CommandOutcome> {
    let start = match scene {
        None => StartDocument::Last,
        Some(scene) => match input::source(scene)? {
            input::SceneSource::Example(example) => StartDocument::Example(example.name.to_owned()),
            // One with errors is opened in part.
            input::SceneSource::File(path) => {
                input::check_readable(path)?;
                StartDocument::File(path.to_owned())
            }
        },
    };
    let interruption = Interruption::default();
    interrupt::ask_first({
        let interruption = interruption.clone();
        move || interruption.ask()
    });
    match open(&start, &interruption) {
        Ok(()) if interruption.is_asked() => Ok(CommandOutcome::Interrupted),
        Ok(()) => Ok(CommandOutcome::Done),
        Err(error @ StudioError::Thread(_)) => Err(error.into()),
        Err(error) => Err(anyhow!("{error}; `catoptric render` makes pictures without a window")),
    }
}
