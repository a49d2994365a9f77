//! What a shell offers after the tab key: it asks the program, which knows the scene that stands on the line.

mod addresses;
mod line;
mod shells;

use std::ffi::OsStr;
use std::io;
use std::path::Path;

use catoptric_exchange::ForeignFormat;
use catoptric_picture::PictureFormat;
use catoptric_scene::Example;
use catoptric_tracer::raster::MethodKind;
use clap::{Arg, Command, CommandFactory as _};
use clap_complete::env::CompleteEnv;
use clap_complete::{ArgValueCompleter, CompletionCandidate, PathCompleter, Shell};

use crate::arguments::Arguments;
use shells::SHELLS;

/// A shell that asks says its name in this variable of the environment.
const VARIABLE: &str = "CATOPTRIC_COMPLETE";

const PROGRAM: &str = "catoptric";

/// Answers a shell that asks; whether one does. Errors are kept to itself: their words would stand in the middle of the
/// line that somebody types.
pub(crate) fn is_asked() -> bool {
    let asked =
        CompleteEnv::with_factory(command).var(VARIABLE).bin(PROGRAM).completer(PROGRAM).shells(SHELLS);
    let folder = std::env::current_dir().ok();
    asked.try_complete(std::env::args_os(), folder.as_deref()).unwrap_or(true)
}

/// The script that makes a shell ask.
pub(crate) fn registration(shell: Shell) -> io::Result<String> {
    let mut script = Vec::new();
    if let Some(shell) = SHELLS.completer(&shell.to_string()) {
        shell.write_registration(VARIABLE, PROGRAM, PROGRAM, PROGRAM, &mut script)?;
    }
    Ok(String::from_utf8_lossy(&script).into_owned())
}

/// The grammar, with what can stand in the place of its values.
fn command() -> Command {
    Arguments::command().mut_subcommands(|command| {
        let name = command.get_name().to_owned();
        command.mut_args(|argument| with_values(&name, argument))
    })
}

fn with_values(command: &str, argument: Arg) -> Arg {
    let completer = match (command, argument.get_id().as_str()) {
        ("examples", "name") => ArgValueCompleter::new(examples),
        ("man" | "help", "command") => ArgValueCompleter::new(commands),
        (_, "scene" | "scenes") => ArgValueCompleter::new(scenes),
        (_, "edits") => ArgValueCompleter::new(addresses::edits),
        (_, "vary") => ArgValueCompleter::new(addresses::sweeps),
        ("measure", "method") | ("compare", "methods") => ArgValueCompleter::new(methods),
        ("measure", "answers") => ArgValueCompleter::new(|current: &OsStr| {
            after_comma(current, ["mean", "pixel:", "flip", "rays"].map(str::to_owned))
        }),
        ("render", "output") => ArgValueCompleter::new(picture_files),
        ("render", "format") => ArgValueCompleter::new(|current: &OsStr| begun(current, pictures())),
        ("convert", "format") => ArgValueCompleter::new(|current: &OsStr| {
            let scenes = ForeignFormat::ALL.into_iter().flat_map(|format| format.extensions().to_vec());
            let scenes = ["toml"].into_iter().chain(scenes).map(str::to_owned);
            begun(current, pictures().into_iter().chain(scenes))
        }),
        (_, "language") => {
            ArgValueCompleter::new(|current: &OsStr| begun(current, ["en", "ru"].map(str::to_owned)))
        }
        _ => return argument,
    };
    argument.add(completer)
}

/// Those of some words that begin as typed.
fn begun(current: &OsStr, words: impl IntoIterator<Item = String>) -> Vec<CompletionCandidate> {
    let Some(typed) = current.to_str() else { return Vec::new() };
    words.into_iter().filter(|word| word.starts_with(typed)).map(CompletionCandidate::new).collect()
}

/// Words for the last place of a list with commas.
fn after_comma(current: &OsStr, words: impl IntoIterator<Item = String>) -> Vec<CompletionCandidate> {
    let Some(typed) = current.to_str() else { return Vec::new() };
    let (before, last) =
        typed.split_at_checked(typed.rfind(',').map_or(0, |at| at + 1)).unwrap_or(("", typed));
    begun(OsStr::new(last), words).into_iter().map(|found| found.add_prefix(before)).collect()
}

fn examples(current: &OsStr) -> Vec<CompletionCandidate> {
    let found = Example::ALL.iter().filter(|example| example.name.starts_with(&*current.to_string_lossy()));
    found.map(|example| CompletionCandidate::new(example.name).help(Some(example.title().into()))).collect()
}

/// Built-in scenes, and files of scenes.
fn scenes(current: &OsStr) -> Vec<CompletionCandidate> {
    let is_scene = |path: &Path| {
        let is_ours = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
        (is_ours || ForeignFormat::of_path(path).is_some()) && path.is_file()
    };
    let files =
        clap_complete::engine::ValueCompleter::complete(&PathCompleter::any().filter(is_scene), current);
    examples(current).into_iter().chain(files).collect()
}

fn commands(current: &OsStr) -> Vec<CompletionCandidate> {
    begun(current, Arguments::command().get_subcommands().map(|command| command.get_name().to_owned()))
}

/// Methods, in a list with commas; settings may follow each.
fn methods(current: &OsStr) -> Vec<CompletionCandidate> {
    after_comma(current, MethodKind::ALL.map(|kind| kind.name().to_owned()))
}

/// The formats in which a picture can be written.
fn pictures() -> Vec<String> {
    PictureFormat::all_extensions(true).map(str::to_owned).collect()
}

/// Files, and for a name with a point the endings that a picture can have.
fn picture_files(current: &OsStr) -> Vec<CompletionCandidate> {
    let mut found = clap_complete::engine::ValueCompleter::complete(&PathCompleter::any(), current);
    let typed = current.to_str().unwrap_or_default();
    if let Some((stem, _)) =
        typed.rsplit_once('.').filter(|(stem, _)| !stem.is_empty() && !stem.ends_with(['.', '/']))
    {
        let named = begun(current, pictures().into_iter().map(|ending| format!("{stem}.{ending}")));
        found.extend(named.into_iter().filter(|name| !Path::new(name.get_value()).exists()));
    }
    found
}
