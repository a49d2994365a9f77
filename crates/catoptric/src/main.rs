//! The program: arguments → work → output.

mod arguments;
mod commands;
mod input;
mod interrupt;
mod memory;
mod output;
mod progress;
mod stats;

use std::process::ExitCode;

use catoptric_scene::LoadError;
use clap::Parser as _;

use arguments::{Arguments, Command};
use commands::Outcome;

fn main() -> ExitCode {
    let Arguments { command } = Arguments::parse();
    let outcome = match command {
        Command::Render(arguments) => commands::render::run(&arguments),
        Command::Check(arguments) => commands::check::run(&arguments),
        Command::Diff(arguments) => commands::diff::run(&arguments),
        Command::Convert(arguments) => commands::convert::run(&arguments),
        Command::Examples(arguments) => commands::examples::run(&arguments),
        Command::Completions(arguments) => commands::manual::completions(&arguments),
        Command::Man(arguments) => commands::manual::man(&arguments),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::from(1),
        Ok(Outcome::WrongInput) => ExitCode::from(2),
        Ok(Outcome::Interrupted) => {
            eprintln!("interrupted; nothing was written");
            ExitCode::from(130)
        }
        Err(error) => {
            report(&error);
            ExitCode::from(2)
        }
    }
}

/// Prints an error once, with its causes.
fn report(error: &anyhow::Error) {
    match error.downcast_ref::<LoadError>() {
        Some(LoadError::Diagnostics { path, text, diagnostics }) => {
            let color = output::color_on(&std::io::stderr());
            eprintln!("{}", diagnostics.render(&path.to_string_lossy(), text, color));
        }
        _ => eprintln!("error: {error:#}"),
    }
}
