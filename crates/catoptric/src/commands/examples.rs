//! `catoptric examples`

use anyhow::{Result, bail};
use catoptric_scene::Example;

use super::CommandOutcome;
use crate::arguments::ExamplesArguments;
use crate::console::print;
use crate::files::CommandFiles;
use crate::input::no_such_example;
use crate::output_kind::OutputKind;

pub(crate) fn run(arguments: &ExamplesArguments) -> Result<CommandOutcome> {
    let Some(name) = &arguments.name else {
        print(&list())?;
        return Ok(CommandOutcome::Done);
    };
    let example = Example::find(name).ok_or_else(|| no_such_example(name))?;
    match &arguments.output {
        Some(path) if matches!(OutputKind::of(path), Some(OutputKind::Picture(_))) => bail!(
            "a scene file should not be called {0}: give a name that ends in .toml; for the picture, use \
             `catoptric render {name} -o {0}`",
            path.display()
        ),
        Some(path) => {
            let mut files = CommandFiles::default();
            files.add_output(path)?;
            files.write(path, example.text.as_bytes())?;
        }
        None => print(example.text)?,
    }
    Ok(CommandOutcome::Done)
}

fn list() -> String {
    let width = Example::ALL.iter().map(|example| example.name.len()).max().unwrap_or(0);
    Example::ALL.iter().map(|example| format!("{:width$}  {}\n", example.name, example.title())).collect()
}
