//! `catoptric check`

use anyhow::Result;
use catoptric_scene::LoadError;

use super::Outcome;
use crate::arguments::CheckArguments;
use crate::input;
use crate::output::{color_on, print};

pub(crate) fn run(arguments: &CheckArguments) -> Result<Outcome> {
    let mut outcome = Outcome::Done;
    let color = color_on(&std::io::stdout());
    for name in &arguments.scenes {
        let report = match input::scene(name) {
            Ok(input) => {
                let warnings = &input.loaded.warnings;
                let scene = &input.loaded.scene;
                let found = if warnings.is_empty() {
                    String::new()
                } else {
                    format!("{}\n", warnings.render(name, &input.loaded.text, color))
                };
                let verdict = match warnings.len() {
                    0 => "good".to_owned(),
                    1 => "good, 1 warning".to_owned(),
                    count => format!("good, {count} warnings"),
                };
                let (bodies, lights) = (scene.bodies.len(), scene.lights.len());
                format!("{found}{name}: {verdict} ({bodies} bodies, {lights} lights)\n")
            }
            Err(error) => {
                outcome = Outcome::WrongInput;
                match error.downcast_ref::<LoadError>() {
                    Some(LoadError::Diagnostics { text, diagnostics, .. }) => {
                        format!("{}\n", diagnostics.render(name, text, color))
                    }
                    _ => format!("error: {error:#}\n"),
                }
            }
        };
        print(&report)?;
    }
    Ok(outcome)
}
