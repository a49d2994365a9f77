//! `catoptric completions` and `catoptric man`

use anyhow::{Result, bail};
use clap::CommandFactory as _;

use super::CommandOutcome;
use crate::arguments::{Arguments, CompletionsArguments, HelpArguments, ManArguments};
use crate::completion;
use crate::console::{color_on, print, print_colored};

pub(crate) fn completions(arguments: &CompletionsArguments) -> Result<CommandOutcome> {
    print(&completion::registration(arguments.shell)?)?;
    Ok(CommandOutcome::Done)
}

/// Explains the program or a command as its option `--help` does.
pub(crate) fn help(arguments: &HelpArguments) -> Result<CommandOutcome> {
    let mut command = chosen(arguments.command.as_deref(), |_| true)?;
    let words = command.render_long_help();
    if color_on(&std::io::stdout()) {
        print_colored(&words.ansi().to_string())?;
    } else {
        print(&words.to_string())?;
    }
    Ok(CommandOutcome::Done)
}

/// The command of this name, one of those that `is_meant` accepts, or the whole program.
fn chosen(name: Option<&str>, is_meant: impl Fn(&str) -> bool) -> Result<clap::Command> {
    let mut program = Arguments::command();
    // Hands the version on to the commands.
    program.build();
    let Some(name) = name else { return Ok(program) };
    match program.find_subcommand(name).filter(|command| is_meant(command.get_name())) {
        Some(command) => Ok(command.clone()),
        None => {
            let names = program.get_subcommands().map(clap::Command::get_name);
            let names: Vec<&str> = names.filter(|name| is_meant(name)).collect();
            bail!("there is no command \"{name}\"; choose one of: {}", names.join(", "))
        }
    }
}

pub(crate) fn man(arguments: &ManArguments) -> Result<CommandOutcome> {
    // The pages are the help.
    let command = chosen(arguments.command.as_deref(), |name| name != "help")?;
    let command = match &arguments.command {
        Some(name) => command.name(format!("catoptric-{name}")),
        None => command,
    };
    let mut page = Vec::new();
    let source = concat!("Catoptric ", env!("CARGO_PKG_VERSION"));
    clap_mangen::Man::new(command).source(source).manual("Catoptric").render(&mut page)?;
    print(&String::from_utf8_lossy(&page))?;
    Ok(CommandOutcome::Done)
}
