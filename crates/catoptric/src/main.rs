//! The program: arguments → work → output.

mod allocator;
mod arguments;
mod backend;
mod card;
mod commands;
mod completion;
mod console;
mod files;
mod input;
mod interrupt;
mod layers;
mod memory;
mod notes;
mod output;
mod output_kind;
mod progress;
mod stats;

use std::ffi::OsString;
use std::process::ExitCode;

use anyhow::Result;
use clap::Parser as _;

use arguments::{Arguments, Command};
use commands::CommandOutcome;
use console::STATUS_ERROR;

#[global_allocator]
static ALLOCATOR: allocator::Allocator = allocator::Allocator;

fn main() -> ExitCode {
    if completion::is_asked() {
        return ExitCode::SUCCESS;
    }
    allocator::listen();
    interrupt::listen();
    let outcome = match Arguments::try_parse() {
        Ok(Arguments { command: Some(command) }) => run(&command),
        Ok(Arguments { command: None }) => commands::studio::run(None),
        Err(answer) => explain(&answer),
    };
    match outcome {
        Ok(CommandOutcome::Done) => ExitCode::SUCCESS,
        Ok(CommandOutcome::Failed) => ExitCode::from(1),
        Ok(CommandOutcome::WrongInput) => ExitCode::from(STATUS_ERROR),
        Ok(CommandOutcome::Interrupted) => ExitCode::from(interrupt::INTERRUPTED),
        Err(error) => {
            commands::report(&error);
            ExitCode::from(STATUS_ERROR)
        }
    }
}

fn run(command: &Command) -> Result<CommandOutcome> {
    if let Command::Check(_) | Command::Audit(_) | Command::Diff(_) | Command::Convert(_) = command {
        backend::start_threads()?;
    }
    match command {
        Command::Studio(arguments) => commands::studio::run(arguments.scene.as_deref()),
        Command::Render(arguments) => commands::render::run(arguments),
        Command::Check(arguments) => commands::check::run(arguments),
        Command::Audit(arguments) => commands::audit::run(arguments),
        Command::Diff(arguments) => commands::diff::run(arguments),
        Command::Compare(arguments) => commands::compare::run(arguments),
        Command::Measure(arguments) => commands::measure::run(arguments),
        Command::Convert(arguments) => commands::convert::run(arguments),
        Command::Serve(arguments) => commands::serve::run(arguments),
        Command::Examples(arguments) => commands::examples::run(arguments),
        Command::Completions(arguments) => commands::manual::completions(arguments),
        Command::Man(arguments) => commands::manual::man(arguments),
        Command::Help(arguments) => commands::manual::help(arguments),
    }
}

/// Prints what the arguments call for instead of work: help, the version, or what is wrong with them.
fn explain(answer: &clap::Error) -> Result<CommandOutcome> {
    let words = answer.render();
    // Arguments stand in it as they are; with colors of their own, all colors are left out.
    let is_plain = |argument: OsString| !argument.to_string_lossy().contains(catoptric_scene::is_active);
    let is_colored = std::env::args_os().all(is_plain);
    if answer.use_stderr() {
        match is_colored && console::color_on(&std::io::stderr()) {
            true => console::say_colored(words.ansi().to_string().trim_end()),
            false => console::say(words.to_string().trim_end()),
        }
        return Ok(CommandOutcome::WrongInput);
    }
    match is_colored && console::color_on(&std::io::stdout()) {
        true => console::print_colored(&words.ansi().to_string())?,
        false => console::print(&words.to_string())?,
    }
    Ok(CommandOutcome::Done)
}
