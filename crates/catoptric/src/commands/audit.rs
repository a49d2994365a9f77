//! `catoptric audit`

use anyhow::{Context as _, Result};
use catoptric_lab::audit::{Audit, AuditSettings, audit};
use catoptric_lab::exact;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};

use super::CommandOutcome;
use crate::arguments::AuditArguments;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::input;

pub(crate) fn run(arguments: &AuditArguments) -> Result<CommandOutcome> {
    let mut files = CommandFiles::default();
    for path in arguments.dot.iter().chain(&arguments.svg) {
        files.add_output(path)?;
    }
    let input = input::scene(&arguments.scene, &arguments.set, Some(arguments.size), &mut files)?;
    input.warn();
    let scene = &input.loaded.scene;
    let render_scene = RenderScene::build(scene).with_context(|| input.name.clone())?;
    let render_scene = match arguments.generations {
        Some(generations) => render_scene.with_generations(generations),
        None => render_scene,
    };
    if arguments.exact {
        let answers = exact::answers(scene);
        let text =
            if arguments.json { json_text(&exact::to_json(&answers)) } else { exact::to_text(&answers) };
        print(&text)?;
    }
    if let Some(pixel) = arguments.pixel {
        let picture = RenderSettings {
            width: arguments.size.width,
            height: arguments.size.height,
            samples: arguments.samples,
        };
        let settings = AuditSettings { picture, ..AuditSettings::default() };
        let pixel = glam::UVec2::new(pixel.x, pixel.y);
        let audit =
            audit(scene, &render_scene, render_scene.camera(), pixel, &settings, &RenderControl::default())?;
        write(&audit, arguments, &files)?;
    }
    Ok(CommandOutcome::Done)
}

fn write(audit: &Audit, arguments: &AuditArguments, files: &CommandFiles) -> Result<()> {
    let (path, text) = match (&arguments.dot, &arguments.svg) {
        (Some(path), _) => (path, audit.to_dot(arguments.depth)),
        (_, Some(path)) => (path, audit.to_svg(arguments.depth)),
        _ if arguments.json => return print(&json_text(&audit.to_json())),
        _ => return print(&audit.to_text(arguments.depth)),
    };
    files.write(path, text.as_bytes())
}
