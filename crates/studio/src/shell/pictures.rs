//! Pictures that are made: one is rendered in the background while the studio goes on, finished ones lie in windows
//! of their own until they are saved, copied or dropped.

mod card;
mod close_guard;
mod copy;
pub(crate) mod fields;
mod result;
mod save;

use std::sync::Arc;
use std::time::Duration;

use catoptric_live::{DisplayContent, JobError, RenderJob};
use catoptric_picture::Development;
use catoptric_scene::Scene;
use catoptric_tracer::raster::{GBufferLayer, Method};
use egui::{Context, Ui, UserAttentionType, ViewportCommand};

use crate::base::job::let_go;
use crate::base::words::{self, plain_name};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::MessageDialog;
use crate::shell::studio::pictures::{FinishedPicture, RenderRequest, RenderTask};
use crate::state::methods;
use crate::state::render_choices::{PictureKind, RenderChoices};
pub(crate) use close_guard::hold;
pub(crate) use copy::copy_viewport;

/// How often the progress is looked at.
const LOOK: Duration = Duration::from_millis(200);

/// Starts to render the document as it is now, through its own camera; cancels the present render.
pub(crate) fn start(studio: &mut Studio, choices: RenderChoices, development: Development, method: Method) {
    let scene = Arc::clone(studio.editor.scene());
    let order = RenderRequest { choices, development, name: studio.editor.title().to_owned() };
    begin(studio, scene, (method, DisplayContent::Picture), order);
}

/// Starts to make a picture of what the viewport shows, as large as there and through its camera.
pub(crate) fn start_shown(studio: &mut Studio) {
    let Some([width, height]) = studio.panes.viewport.size_in_pixels() else { return };
    let method = studio.settings.methods.method();
    let shows =
        if methods::has(&method, studio.view.shows) { studio.shown() } else { DisplayContent::Picture };
    let scene = Scene { camera: studio.shown_camera(), ..Scene::clone(studio.editor.scene()) };
    // Layers are of the first sample, and most of them are numbers that no exposure changes.
    let is_light = matches!(shows, DisplayContent::Picture | DisplayContent::UnfoldedCube(_))
        || matches!(shows, DisplayContent::Layer(GBufferLayer::Lit | GBufferLayer::Reflected));
    let samples = if shows == DisplayContent::Picture { studio.settings.viewport_samples } else { 1 };
    let size = RenderChoices { width, height, samples, generations: None, ..studio.settings.render.clone() };
    let development = if is_light { studio.view.development } else { Development::default() };
    let what = if shows == DisplayContent::Picture {
        method.name()
    } else {
        studio.texts.get(methods::shown_key(studio.view.shows))
    };
    let name = format!("{} {what}", studio.editor.title().trim_end_matches(".toml"));
    begin(studio, Arc::new(scene), (method, shows), RenderRequest { choices: size, development, name });
}

fn begin(
    studio: &mut Studio,
    scene: Arc<Scene>,
    (method, shows): (Method, DisplayContent),
    order: RenderRequest,
) {
    studio.pictures.cancel();
    studio.pictures.close_guard.forget();
    let (settings, generations) = (order.choices.settings(), order.choices.generations);
    match RenderJob::drawn(scene, method, shows, settings, generations, 0) {
        Ok(job) => studio.pictures.running = Some(RenderTask { job, order }),
        Err(error) => {
            let text = words::fault(&studio.texts, &error.to_string());
            studio.dialogs.open(MessageDialog::new(studio.texts.get("render-failed"), text));
        }
    }
}

/// Draws the progress and the finished pictures, and takes up what threads have done: once a frame.
pub(crate) fn pictures_ui(ui: &mut Ui, studio: &mut Studio) {
    take_result(ui.ctx(), studio);
    studio.view.is_rendering = studio.pictures.is_rendering();
    card::card_ui(ui, studio);
    result::results_ui(ui.ctx(), studio);
    copy::poll(ui.ctx(), studio);
    close_guard::poll(studio);
}

/// Makes a finished render a finished picture.
fn take_result(context: &Context, studio: &mut Studio) {
    let Some(running) = &studio.pictures.running else { return };
    context.request_repaint_after(LOOK);
    let Some(result) = running.job.take_result() else { return };
    let elapsed = running.job.progress().elapsed;
    let Some(RenderTask { order, job }) = studio.pictures.running.take() else { return };
    let_go(job);
    match result {
        Ok(rendering) => {
            let pictures = &mut studio.pictures;
            pictures.count += 1;
            pictures.close_guard.forget();
            let number = pictures.count;
            let finished = FinishedPicture::new(number, &pictures.finished, rendering, order, elapsed);
            pictures.finished.push(finished);
            if !context.input(|input| input.focused) {
                context.send_viewport_cmd(ViewportCommand::RequestUserAttention(
                    UserAttentionType::Informational,
                ));
            }
        }
        Err(JobError::Cancelled) => {}
        Err(error) => {
            let text = words::job_error(&studio.texts, &error);
            studio.dialogs.open(MessageDialog::new(studio.texts.get("render-failed"), text));
        }
    }
}

/// The name that a new picture file gets.
fn file_name(order: &RenderRequest, kind: PictureKind) -> String {
    format!("{}.{}", plain_name(&order.name), kind.extension())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_harmless() {
        let name = |name: &str, kind| {
            let (choices, development) = (RenderChoices::default(), Development::default());
            file_name(&RenderRequest { choices, development, name: name.to_owned() }, kind)
        };
        assert_eq!(name("four-bodies", PictureKind::Png16), "four-bodies.png");
        assert_eq!(name("a/b: c?.toml", PictureKind::Exr), "a-b- c-.exr");
        assert_eq!(name("", PictureKind::Png8), "catoptric.png");
    }
}
