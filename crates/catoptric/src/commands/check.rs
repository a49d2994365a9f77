//! `catoptric check`

use std::path::Path;

use anyhow::Result;
use catoptric_scene::{AddressError, Diagnostics, Language, Scene, SceneKey, Severity, visible};
use catoptric_store::LoadError;

use super::{CommandOutcome, in_words};
use crate::arguments::CheckArguments;
use crate::console::{color_on, count, print_colored};
use crate::files::{CommandFiles, OutputIsInput};
use crate::{input, notes};

pub(crate) fn run(arguments: &CheckArguments) -> Result<CommandOutcome> {
    let color = color_on(&std::io::stdout());
    let mut outcome = CommandOutcome::Done;
    for path in &arguments.scenes {
        let (good, report) = check(path, arguments, color)?;
        if !good {
            outcome = CommandOutcome::WrongInput;
        }
        print_colored(&report)?;
    }
    Ok(outcome)
}

/// Whether the scene can be used, and a report on it: its findings, notes, and a line with the verdict.
fn check(path: &Path, arguments: &CheckArguments, color: bool) -> Result<(bool, String)> {
    let name = visible(&path.display().to_string()).into_owned();
    Ok(match input::scene(path, &arguments.set, None, &mut CommandFiles::default()) {
        Ok(input::NamedScene { loaded, .. }) => {
            let found = findings(&loaded.warnings, &name, &loaded.text, color);
            let notes = notes::on_scene(&name, &loaded.scene);
            let keys = if arguments.keys { keys(&loaded.scene) } else { String::new() };
            (true, format!("{found}{notes}{keys}{name}: {}\n", praise(&loaded.scene, &loaded.warnings)))
        }
        // Nothing may be printed then.
        Err(error) if error.is::<OutputIsInput>() => return Err(error),
        Err(error) => match error.downcast_ref::<LoadError>() {
            Some(LoadError::Diagnostics { text, diagnostics, .. }) => {
                let found = findings(diagnostics, &name, text, color);
                (false, format!("{found}{name}: {}\n", blame(diagnostics)))
            }
            _ => {
                let verdict = if error.is::<AddressError>() { "bad, 1 error" } else { "not read" };
                (false, format!("error: {}\n{name}: {verdict}\n", visible(&in_words(&error))))
            }
        },
    })
}

fn findings(diagnostics: &Diagnostics, name: &str, text: &str, color: bool) -> String {
    if diagnostics.is_empty() {
        return String::new();
    }
    format!("{}\n", diagnostics.render(name, text, color))
}

/// The addresses of all values: what stands there, and what it means.
fn keys(scene: &Scene) -> String {
    let line = |key: SceneKey| {
        let value = key.value.as_ref().map(|value| format!(" {value}")).unwrap_or_default();
        let assignment = format!("{} ={value}", key.path);
        format!("{assignment:39} # {}\n", key.spec.meaning(Language::English))
    };
    scene.keys().map(line).collect()
}

fn praise(scene: &Scene, warnings: &Diagnostics) -> String {
    let bodies = count(scene.bodies.len(), "body", "bodies");
    let lights = count(scene.lights.len(), "light", "lights");
    let notes = warnings.iter().filter(|finding| finding.severity == Severity::Note).count();
    let mut verdict = String::from("good");
    for (number, one, many) in
        [(warnings.len() + warnings.omitted() - notes, "warning", "warnings"), (notes, "note", "notes")]
    {
        if number > 0 {
            verdict += &format!(", {}", count(number, one, many));
        }
    }
    format!("{verdict} ({bodies}, {lights})")
}

fn blame(diagnostics: &Diagnostics) -> String {
    if diagnostics.omitted() > 0 {
        return format!("bad, {} findings", diagnostics.len() + diagnostics.omitted());
    }
    let errors = diagnostics.iter().filter(|finding| finding.severity == Severity::Error).count();
    let verdict = format!("bad, {}", count(errors, "error", "errors"));
    let warnings = diagnostics.iter().filter(|finding| finding.severity == Severity::Warning).count();
    match warnings {
        0 => verdict,
        warnings => format!("{verdict}, {}", count(warnings, "warning", "warnings")),
    }
}
