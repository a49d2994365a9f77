//! The line that is typed, and the scene on it.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::{Scene, SceneEdit, decode, read, read_bytes};
use catoptric_store::read_file;
use clap::{Arg, ArgMatches, CommandFactory as _, value_parser};

use crate::arguments::Arguments;
use crate::input::{SceneSource, source};

/// The longest scene file that is read for its addresses, bytes: nobody waits long for a key.
const LONGEST: u64 = 4 << 20;

/// The scene on the line that the shell asks about, as the values before set it; none if there is none yet, or it cannot
/// be read.
pub(super) fn scene() -> Option<Scene> {
    let mut words: Vec<OsString> = std::env::args_os().skip_while(|word| word != "--").skip(1).collect();
    let index = std::env::var("_CLAP_COMPLETE_INDEX").ok().and_then(|index| index.parse().ok());
    let current = index.unwrap_or(words.len().saturating_sub(1));
    let word = words.get_mut(current)?;
    // The word that is typed is not known yet, but an option before it has a value.
    *word = if word.to_string_lossy().starts_with('-') { "--".into() } else { "typed".into() };
    let matches = forgiving().try_get_matches_from(words).ok()?;
    let (_, command) = matches.subcommand()?;
    let mut scene = load(Path::new(values(command, "scene").chain(values(command, "scenes")).next()?))?;
    for edit in values(command, "edits").filter_map(|edit| edit.to_str()?.parse::<SceneEdit>().ok()) {
        // What is wrong is told when the command runs.
        let _ = scene.edit(&[edit]);
    }
    Some(scene)
}

/// The grammar, but any word is a value, and what is missing or wrong is left out.
fn forgiving() -> clap::Command {
    let of_any_value = |argument: Arg| match argument.get_action().takes_values() {
        true => argument.value_parser(value_parser!(OsString)),
        false => argument,
    };
    let program = Arguments::command().ignore_errors(true);
    program.mut_subcommands(|command| command.mut_args(of_any_value))
}

/// The values of an argument of a command; none if it has no such argument.
fn values<'m>(command: &'m ArgMatches, name: &str) -> impl Iterator<Item = &'m OsString> + use<'m> {
    command.try_get_many::<OsString>(name).ok().flatten().into_iter().flatten()
}

/// A scene as far as it can be understood, without its pictures. What is no plain file, or has no length, may never end.
fn load(path: &Path) -> Option<Scene> {
    match source(path).ok()? {
        SceneSource::Example(example) => Some(read(example.text).scene),
        SceneSource::File(path) => {
            let file = fs::metadata(path).ok()?;
            if !file.is_file() || file.len() == 0 || file.len() > LONGEST {
                return None;
            }
            let bytes = read_file(path, LONGEST as usize).ok()?;
            let Some(format) = ForeignFormat::of_path(path) else { return Some(read_bytes(bytes).0.scene) };
            let options = ImportOptions { is_approximate: true, ..ImportOptions::default() };
            Some(catoptric_exchange::read(format, &decode(bytes).ok()?, &options).ok()?.scene)
        }
    }
}
