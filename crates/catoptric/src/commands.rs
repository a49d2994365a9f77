//! One file a command.

pub(crate) mod audit;
pub(crate) mod check;
mod check_picture;
mod checking;
pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod diff;
pub(crate) mod examples;
pub(crate) mod manual;
mod mark_class;
pub(crate) mod measure;
pub(crate) mod render;
#[cfg_attr(not(feature = "serve"), path = "commands/no_serve.rs")]
pub(crate) mod serve;
#[cfg_attr(not(feature = "studio"), path = "commands/no_studio.rs")]
pub(crate) mod studio;

use catoptric_scene::visible;
use catoptric_store::LoadError;

use crate::console;

/// How a command ended when nothing went wrong with the program itself. (Interrupted, only those return that are asked
/// to end.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CommandOutcome {
    /// Exit status 0.
    Done,
    /// A comparison failed: exit status 1.
    Failed,
    /// The input is wrong, and that has been said: exit status 2.
    WrongInput,
    /// The studio or a measurement was asked to end by Ctrl-C or the like: exit status 130.
    Interrupted,
}

/// An error with its causes in one line.
pub(crate) fn in_words(error: &anyhow::Error) -> String {
    match error.downcast_ref::<LoadError>() {
        // Its own words already hold the cause.
        Some(error) => error.to_string(),
        None => format!("{error:#}"),
    }
}

/// Prints an error once, with its causes.
pub(crate) fn report(error: &anyhow::Error) {
    match error.downcast_ref::<LoadError>() {
        Some(LoadError::Diagnostics { path, text, diagnostics }) => {
            let color = console::color_on(&std::io::stderr());
            console::say_colored(&diagnostics.render(&path.to_string_lossy(), text, color));
        }
        _ => console::say(&format!("error: {}", visible(&in_words(error)))),
    }
}
