//! What is systematically different in a picture file: a button, then the verdict.

use std::sync::Arc;

use catoptric_lab::detective::{Detective, DetectiveSettings, ObservedPicture, Verdict};
use catoptric_picture::{Development, Picture, PictureFormat};
use catoptric_scene::Scene;
use catoptric_tracer::RenderControl;
use catoptric_tracer::raster::Method;
use egui::{Align, Button, Context, Label, RichText, Ui};

use super::task::CompareResult;
use super::{ComparedPicture, ComparisonKey};
use crate::base::job::{Job, JobStatus};
use crate::base::theme;
use crate::state::context::Cx;
use crate::state::methods::report_language;

/// The check of the comparison that is shown.
#[derive(Default)]
pub(crate) struct CheckState {
    running: Option<CheckTask>,
    /// Of which comparison, and what was found; or why nothing was.
    found: Option<(ComparisonKey, Result<CheckedScene, String>)>,
    /// Whether that is to be brought into view.
    is_new: bool,
}

/// A verdict, and the scene that it names things of.
struct CheckedScene {
    verdict: Verdict,
    scene: Scene,
}

/// A check under way. Dropping this ends it.
struct CheckTask {
    key: ComparisonKey,
    control: Arc<RenderControl>,
    job: Job<Result<CheckedScene, String>>,
}

impl Drop for CheckTask {
    fn drop(&mut self) {
        self.control.cancel();
    }
}

impl CheckTask {
    fn start(
        context: &Context,
        found: &Arc<CompareResult>,
        development: Development,
    ) -> std::io::Result<Self> {
        let control = Arc::new(RenderControl::default());
        let (compared, own) = (Arc::clone(found), Arc::clone(&control));
        let job = Job::start(context, "check", move || check(&compared, development, &own))?;
        Ok(Self { key: found.key.clone(), control, job })
    }
}

fn check(
    found: &CompareResult,
    development: Development,
    control: &RenderControl,
) -> Result<CheckedScene, String> {
    let Some((picture, view)) = picture_to_check(found).zip(found.key.view.as_ref()) else {
        return Err(String::new());
    };
    let scene = Scene { camera: view.camera, ..Scene::clone(&found.scene) };
    let format = found.key.sources.iter().find_map(format_of);
    let is_light = format.is_some_and(PictureFormat::is_of_light);
    let observed =
        if is_light { ObservedPicture::of_light(picture) } else { ObservedPicture::of_codes(picture) };
    let settings = DetectiveSettings::of_file(format, Some(development.tone_curve), false);
    let checked = Detective::new(&scene, settings).and_then(|detective| detective.check(&observed, control));
    match checked {
        Ok(verdict) => Ok(CheckedScene { verdict, scene }),
        Err(error) => Err(error.to_string()),
    }
}

fn format_of(source: &ComparedPicture) -> Option<PictureFormat> {
    match source {
        ComparedPicture::File(path) => PictureFormat::of_path(path),
        ComparedPicture::Method(_) => None,
    }
}

/// The picture of the file, where a traced one is held against it.
fn picture_to_check(found: &CompareResult) -> Option<&Picture> {
    let truth = found.compared.truth()?;
    let (other, _) = found.compared.others().next()?;
    let file = match &found.key.sources {
        [ComparedPicture::File(_), ComparedPicture::Method(Method::Whitted)] => truth,
        [ComparedPicture::Method(Method::Whitted), ComparedPicture::File(_)] => other,
        _ => return None,
    };
    Some(&file.picture)
}

/// Draws the button of the check or, while it runs, the one that ends it; nothing where there is no file to check.
pub(super) fn act_ui(ui: &mut Ui, cx: &Cx<'_>, state: &mut CheckState, found: &Arc<CompareResult>) {
    state.take_result();
    if picture_to_check(found).is_none() || state.result_of(found).is_some() {
        return;
    }
    if state.running.as_ref().is_some_and(|running| running.key == found.key) {
        ui.spinner();
        ui.weak(cx.t("compare-checking"));
        if ui.button(cx.t("cancel")).accessible_name(cx.t("compare-check-cancel")).clicked() {
            state.running = None;
        }
        return;
    }
    let fill = theme::palette(ui.visuals()).selection;
    let button = ui.add(Button::new(cx.t("compare-check")).fill(fill));
    if button.on_hover_text(cx.texts.tip("compare-check").unwrap_or_default()).clicked() {
        match CheckTask::start(ui.ctx(), found, cx.view.development) {
            Ok(running) => state.running = Some(running),
            Err(error) => state.found = Some((found.key.clone(), Err(error.to_string()))),
        }
    }
}

/// Draws what the check has found, if it is done.
pub(super) fn result_ui(ui: &mut Ui, cx: &Cx<'_>, state: &mut CheckState, found: &Arc<CompareResult>) {
    let is_new = std::mem::take(&mut state.is_new);
    let Some(result) = state.result_of(found) else { return };
    ui.add_space(4.0);
    let head = ui.label(RichText::new(cx.t("compare-check-head")).strong());
    if is_new {
        head.scroll_to_me(Some(Align::Min));
    }
    match result {
        Ok(checked) => verdict_ui(ui, cx, checked),
        Err(reason) => {
            let palette = theme::palette(ui.visuals());
            let text = cx.texts.with("compare-check-failed", &[("reason", reason.as_str().into())]);
            ui.add(Label::new(RichText::new(text).color(palette.error)).wrap());
        }
    }
}

fn verdict_ui(ui: &mut Ui, cx: &Cx<'_>, checked: &CheckedScene) {
    let language = report_language(cx.texts);
    let verdict = &checked.verdict;
    ui.add(Label::new(verdict.sentence(&checked.scene, language)).wrap());
    if let Some(simplest) = verdict.simplest.filter(|_| !verdict.is_right(Verdict::ALLOWED)) {
        ui.add(Label::new(simplest.in_words(&checked.scene, language)).wrap());
    }
    for line in verdict.lines(&checked.scene, language) {
        ui.add(Label::new(RichText::new(line).weak()).wrap());
    }
}

impl CheckState {
    /// What was found out about this comparison.
    fn result_of(&self, found: &CompareResult) -> Option<&Result<CheckedScene, String>> {
        self.found.as_ref().filter(|(key, _)| *key == found.key).map(|(_, result)| result)
    }

    fn take_result(&mut self) {
        let Some(running) = &self.running else { return };
        let result = match running.job.poll() {
            JobStatus::Waiting => return,
            JobStatus::Done(result) => result,
            JobStatus::Lost => Err(String::new()),
        };
        self.found = Some((running.key.clone(), result));
        (self.running, self.is_new) = (None, true);
    }
}
