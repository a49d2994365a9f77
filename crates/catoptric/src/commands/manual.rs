//! `catoptric completions` and `catoptric man`

use anyhow::{Result, bail};
use clap::CommandFactory as _;

use super::Outcome;
use crate::arguments::{Arguments, CompletionsArguments, ManArguments};
use crate::console::print;

pub(crate) fn completions(arguments: &CompletionsArguments) -> Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "catoptric", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}

pub(crate) fn man(arguments: &ManArguments) -> Result<Outcome> {
    let mut program = Arguments::command().disable_help_subcommand(true);
    // Hands the version on to the commands.
    program.build();
    let command = match &arguments.command {
        None => program.clone(),
        Some(name) => match program.find_subcommand(name) {
            Some(command) => command.clone().name(format!("catoptric-{name}")),
            None => {
                let names: Vec<&str> = program.get_subcommands().map(clap::Command::get_name).collect();
                bail!("there is no command \"{name}\"; choose one of: {}", names.join(", "))
            }
        },
    };
    let mut page = Vec::new();
    let source = concat!("Catoptric ", env!("CARGO_PKG_VERSION"));
    clap_mangen::Man::new(command).source(source).manual("Catoptric").render(&mut page)?;
    print(&String::from_utf8_lossy(&page))?;
    Ok(Outcome::Done)
}
