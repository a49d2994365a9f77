//! The program: arguments → work → output.

mod arguments;
mod backend;
mod canvas;
mod commands;
mod console;
mod input;
mod interrupt;
mod memory;
mod notes;
mod output;
mod progress;
mod stats;

use std::io::Write as _;
use std::process::ExitCode;

use anyhow::Result;
use catoptric_scene::LoadError;
use clap::Parser as _;

use arguments::{Arguments, Command};
use commands::Outcome;

/// Gives memory back soon after it was used. The C library of Linux keeps up to 64 MB for each of many threads: the studio
/// grew to several times what it needed.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    interrupt::listen();
    let outcome = match Arguments::try_parse() {
        Ok(Arguments { command: Some(command) }) => run(&command),
        Ok(Arguments { command: None }) => commands::studio::run(None),
        Err(answer) => explain(&answer),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::from(1),
        Ok(Outcome::WrongInput) => ExitCode::from(2),
        Ok(Outcome::Interrupted) => ExitCode::from(interrupt::INTERRUPTED),
        Err(error) => {
            report(&error);
            ExitCode::from(2)
        }
    }
}

fn run(command: &Command) -> Result<Outcome> {
    match command {
        Command::Studio(arguments) => commands::studio::run(arguments.scene.as_deref()),
        Command::Render(arguments) => commands::render::run(arguments),
        Command::Check(arguments) => commands::check::run(arguments),
        Command::Audit(arguments) => commands::audit::run(arguments),
        Command::Diff(arguments) => commands::diff::run(arguments),
        Command::Compare(arguments) => commands::compare::run(arguments),
        Command::Measure(arguments) => commands::measure::run(arguments),
        Command::Convert(arguments) => commands::convert::run(arguments),
        Command::Examples(arguments) => commands::examples::run(arguments),
        Command::Completions(arguments) => commands::manual::completions(arguments),
        Command::Man(arguments) => commands::manual::man(arguments),
    }
}

/// Prints what the arguments call for instead of work: help, the version, or what is wrong with them.
fn explain(answer: &clap::Error) -> Result<Outcome> {
    let printed = answer.print();
    if answer.use_stderr() {
        return Ok(Outcome::WrongInput);
    }
    console::unless_closed(printed.and_then(|()| std::io::stdout().flush()))?;
    Ok(Outcome::Done)
}

/// Prints an error once, with its causes.
fn report(error: &anyhow::Error) {
    match error.downcast_ref::<LoadError>() {
        Some(LoadError::Diagnostics { path, text, diagnostics }) => {
            let color = console::color_on(&std::io::stderr());
            console::say(&diagnostics.render(&path.to_string_lossy(), text, color));
        }
        _ => console::say(&format!("error: {}", commands::in_words(error))),
    }
}
