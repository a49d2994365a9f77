//! `catoptric examples`

use anyhow::{Result, bail};
use catoptric_scene::{Example, save};

use super::Outcome;
use crate::arguments::ExamplesArguments;
use crate::output::print;

pub(crate) fn run(arguments: &ExamplesArguments) -> Result<Outcome> {
    let Some(name) = &arguments.name else {
        let width = Example::ALL.iter().map(|example| example.name.len()).max().unwrap_or(0);
        let list: String = Example::ALL
            .iter()
            .map(|example| format!("{:width$}  {}\n", example.name, example.title()))
            .collect();
        print(&list)?;
        return Ok(Outcome::Done);
    };
    let Some(example) = Example::find(name) else {
        match Example::nearest(name) {
            Some(near) => bail!("there is no built-in scene \"{name}\"; did you mean \"{}\"?", near.name),
            None => bail!("there is no built-in scene \"{name}\"; `catoptric examples` lists them"),
        }
    };
    match &arguments.output {
        Some(path) => save(path, example.text)?,
        None => print(example.text)?,
    }
    Ok(Outcome::Done)
}
