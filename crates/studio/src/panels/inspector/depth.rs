//! The generations that the scene needs: from the mirrors alone, and from tracing the view.

use std::sync::Arc;

use catoptric_lab::depth::{DepthBound, DepthMeasure};
use catoptric_lab::work::RayEstimate;
use catoptric_scene::{Camera, Scene, ScenePart, Tracing};
use catoptric_tracer::{RenderControl, RenderScene};
use egui::{Button, Label, Response, RichText, Ui, vec2};
use glam::UVec2;

use super::sheet::PropertySheet;
use crate::base::latest::Latest;
use crate::base::theme;
use crate::base::typeset::TextLine;
use crate::base::widgets::number::{HEIGHT, shown};
use crate::base::widgets::tip::tip_beside;
use crate::panels::audit::short;
use crate::panels::outliner::part_name;

/// The size of letters in the formula.
const SIZE: f32 = 13.5;

/// Finds how many generations the scene needs.
#[derive(Default)]
pub(crate) struct DepthAdviser {
    work: Latest<DepthKey, DepthAdvice>,
    known: Option<(DepthKey, DepthAdvice)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct DepthKey {
    revision: u64,
    /// The picture that is traced for it; `None` to look at the mirrors alone.
    picture: Option<(Camera, [u32; 2])>,
}

#[derive(Clone, Debug)]
struct DepthAdvice {
    bound: DepthBound,
    /// The rays of a picture as the scene is, and with the advised threshold, if they are very many.
    work: Option<[RayEstimate; 2]>,
    measure: Option<DepthMeasure>,
}

impl DepthKey {
    fn carry_out(self, scene: &Scene, render_scene: &RenderScene, control: &RenderControl) -> DepthAdvice {
        let bound = DepthBound::of(scene, render_scene);
        let work = work_of(render_scene, self.picture, control);
        let measure = self.picture.and_then(|(camera, size)| {
            DepthMeasure::of(render_scene, &render_scene.camera_for(&camera), UVec2::from(size), control).ok()
        });
        DepthAdvice { bound, work, measure }
    }
}

/// The rays of a picture, if they are very many, and those that the advised threshold would leave.
fn work_of(
    render_scene: &RenderScene,
    picture: Option<(Camera, [u32; 2])>,
    control: &RenderControl,
) -> Option<[RayEstimate; 2]> {
    if !render_scene.forks() {
        return None;
    }
    let camera = picture.map(|(camera, _)| render_scene.camera_for(&camera));
    let camera = camera.as_ref().unwrap_or_else(|| render_scene.camera());
    let size = UVec2::from(picture.map_or([1280, 720], |(_, size)| size));
    let now = RayEstimate::of(render_scene, camera, size, control).ok()?;
    let threshold = render_scene.threshold().max(RayEstimate::ADVISED_THRESHOLD as f32);
    let limits = (render_scene.generations(), threshold);
    let bounded = if now.is_worth_a_warning() {
        RayEstimate::within(render_scene, camera, size, limits, control).ok()?
    } else {
        now
    };
    now.is_worth_a_warning().then_some([now, bounded])
}

/// Draws what is known, with buttons that set the generations; has the rest found out.
pub(super) fn depth_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Tracing>) {
    keep_up(ui, sheet);
    let Some((key, advice)) = sheet.memory.adviser.known.clone() else { return };
    ui.add_space(4.0);
    bound_ui(ui, sheet, &advice.bound);
    if let Some(work) = &advice.work {
        work_ui(ui, sheet, work);
    }
    match &advice.measure {
        Some(measure) => measure_ui(ui, sheet, measure),
        None if key.picture.is_none() => {
            ui.label(RichText::new(sheet.texts().get("depth-under-way")).weak().size(12.0));
        }
        None => {}
    }
}

/// The mirrors are looked at at once; what is seen is traced when the picture is done.
fn keep_up(ui: &Ui, sheet: &mut PropertySheet<'_, '_, Tracing>) {
    let adviser = &mut sheet.memory.adviser;
    if let Some((key, Some(advice))) = adviser.work.poll() {
        adviser.known = Some((key, advice));
    }
    let Some((revision, render_scene)) = sheet.cx.live.render_scene() else { return };
    let scene = Arc::clone(sheet.cx.editor.scene());
    if sheet.cx.view.is_measuring || revision != sheet.cx.editor.revision() {
        return;
    }
    let key = match (&adviser.known, sheet.cx.live.latest()) {
        (Some((known, _)), Some(frame)) if known.revision == revision => {
            let picture = Some((frame.camera, frame.view_size));
            if known.picture == picture || !sheet.cx.live.status().is_idle {
                return;
            }
            DepthKey { revision, picture }
        }
        _ => DepthKey { revision, picture: None },
    };
    adviser.work.want(ui.ctx(), &key, move |control| key.carry_out(&scene, &render_scene, control));
}

/// The series of the strongest cycle of mirrors.
fn bound_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Tracing>, bound: &DepthBound) {
    let texts = sheet.texts();
    let palette = theme::palette(ui.visuals());
    if bound.cycle.is_empty() {
        note(ui, texts.get("depth-no-mirrors"), texts.tip("depth-no-mirrors"));
        return;
    }
    let scene = Arc::clone(sheet.cx.editor.scene());
    let names = bound.cycle.iter().map(|body| part_name(texts, &scene, ScenePart::Body(*body)));
    let names: Vec<String> =
        names.map(|name| texts.with("depth-body", &[("name", (*name).into())])).collect();
    let arguments = [("bodies", names.join(", ").into()), ("factor", shown(texts, bound.factor, 3).into())];
    let key = match bound.generations {
        Some(_) => "depth-cycle",
        None if bound.factor < 1.0 => "depth-many",
        None => "depth-endless",
    };
    note(ui, &texts.with(key, &arguments), texts.tip(key));
    let Some(generations) = bound.generations else { return };
    let mut line = TextLine::default();
    let (now, next) = (generations, generations + 1);
    line.push(ui, &format!("k^{{{now}}} + k^{{{next}}} + … < 1/512"), SIZE, palette.accent);
    advice_ui(ui, sheet, &line, generations);
}

/// Very many rays, and a button that sets the threshold that bounds them.
fn work_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Tracing>, [now, bounded]: &[RayEstimate; 2]) {
    let texts = sheet.texts();
    let threshold = RayEstimate::ADVISED_THRESHOLD;
    let rays = |estimate: &RayEstimate| short(texts, estimate.per_sample.round());
    let arguments = [
        ("rays", rays(now).into()),
        ("bounded", rays(bounded).into()),
        ("threshold", short(texts, threshold).into()),
    ];
    note(ui, &texts.with("depth-work", &arguments), texts.tip("depth-work"));
    if sheet.primary.threshold >= threshold {
        return;
    }
    let text = texts.with("depth-set-threshold", &arguments);
    if ui.button(text).clicked() {
        sheet.change("threshold", "edit-threshold", |_, tracing| tracing.threshold = threshold);
        sheet.cx.editor.settle();
    }
}

/// What tracing showed.
fn measure_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Tracing>, measure: &DepthMeasure) {
    let texts = sheet.texts();
    let limit = sheet.primary.generations;
    let place = usize::try_from(limit.saturating_sub(1)).unwrap_or(usize::MAX);
    let loss = measure.losses.get(place).copied().unwrap_or(0.0);
    let arguments = [
        ("count", measure.generations.into()),
        ("limit", limit.into()),
        ("loss", short(texts, loss).into()),
        ("pixels", measure.pixels.into()),
    ];
    let key = match measure.is_complete {
        true if loss == 0.0 => "depth-measured-all",
        true => "depth-measured",
        false => "depth-measured-part",
    };
    note(ui, &texts.with(key, &arguments), texts.tip(key));
    let mut line = TextLine::default();
    let color = theme::palette(ui.visuals()).accent;
    line.push_words(ui, &texts.with("depth-enough", &arguments), SIZE, color, ui.available_width() - 96.0);
    advice_ui(ui, sheet, &line, measure.generations);
}

fn note(ui: &mut Ui, text: &str, tip: Option<&str>) -> Response {
    let color = theme::palette(ui.visuals()).weak;
    let response = ui.add(Label::new(RichText::new(text).color(color).size(12.0)).wrap());
    tip_beside(ui, response, tip.unwrap_or_default())
}

/// A line, and a button that sets the generations.
fn advice_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Tracing>, line: &TextLine, generations: u32) {
    let text = sheet.texts().with("depth-set", &[("count", generations.into())]);
    let is_set = sheet.primary.generations == generations;
    let is_clicked = ui
        .horizontal(|ui| {
            let size = vec2((ui.available_width() - 92.0).max(60.0), HEIGHT);
            let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
            line.paint(ui, rect.left_center());
            ui.add_enabled(!is_set, Button::new(text).min_size(vec2(84.0, HEIGHT))).clicked()
        })
        .inner;
    if is_clicked {
        sheet.change("generations", "edit-generations", |_, tracing| tracing.generations = generations);
        sheet.cx.editor.settle();
    }
}
