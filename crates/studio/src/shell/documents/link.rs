//! Links: a scene as it is seen, in the text of an address.

use std::sync::Arc;
use std::sync::mpsc::TryRecvError;

use catoptric_editor::Editor;
use catoptric_picture::Development;
use catoptric_scene::{Camera, Scene, ScenePart, read, write};
use egui::Context;
use glam::UVec2;
use serde::{Deserialize, Serialize};

use super::{banner, show};
use crate::shell::host::LinkOutcome;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::MessageDialog;
use crate::state::audit::PinnedPixel;
use crate::state::methods::MethodSettings;

/// A scene as it is seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LinkedView {
    title: String,
    /// The text of the scene's file.
    scene: String,
    method: MethodSettings,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    free_camera: Option<LinkedCamera>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    development: Option<LinkedDevelopment>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    selected: Vec<LinkedPart>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pixel: Option<LinkedPixel>,
}

/// A camera, as the text of a scene that has nothing else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LinkedCamera(String);

/// Exposure and tone curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LinkedDevelopment {
    stops: f64,
    tone_curve: String,
}

/// A part of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum LinkedPart {
    Camera,
    Environment,
    Tracing,
    Material(usize),
    Light(usize),
    Body(usize),
}

/// The pixel that is pinned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LinkedPixel {
    at: [u32; 2],
    size: [u32; 2],
    camera: LinkedCamera,
    home: LinkedCamera,
}

impl LinkedCamera {
    fn of(camera: &Camera) -> Self {
        Self(write(&Scene { camera: *camera, ..Scene::default() }))
    }

    fn camera(&self) -> Option<Camera> {
        let reading = read(&self.0);
        (!reading.diagnostics.has_errors()).then_some(reading.scene.camera)
    }
}

impl LinkedDevelopment {
    /// `None` for what every studio begins with.
    fn of(development: &Development) -> Option<Self> {
        let Development { exposure_stops: stops, tone_curve } = *development;
        let own = Self { stops, tone_curve: tone_curve.name().to_owned() };
        (*development != Development::default()).then_some(own)
    }

    fn development(&self) -> Option<Development> {
        let tone_curve = self.tone_curve.parse().ok()?;
        self.stops.is_finite().then_some(Development { exposure_stops: self.stops, tone_curve })
    }
}

impl From<ScenePart> for LinkedPart {
    fn from(part: ScenePart) -> Self {
        match part {
            ScenePart::Camera => Self::Camera,
            ScenePart::Environment => Self::Environment,
            ScenePart::Tracing => Self::Tracing,
            ScenePart::Material(index) => Self::Material(index),
            ScenePart::Light(index) => Self::Light(index),
            ScenePart::Body(index) => Self::Body(index),
        }
    }
}

impl From<LinkedPart> for ScenePart {
    fn from(part: LinkedPart) -> Self {
        match part {
            LinkedPart::Camera => Self::Camera,
            LinkedPart::Environment => Self::Environment,
            LinkedPart::Tracing => Self::Tracing,
            LinkedPart::Material(index) => Self::Material(index),
            LinkedPart::Light(index) => Self::Light(index),
            LinkedPart::Body(index) => Self::Body(index),
        }
    }
}

impl LinkedPixel {
    fn of(pin: &PinnedPixel) -> Self {
        let PinnedPixel { pixel, size, camera, home } = pin;
        let [camera, home] = [camera, home].map(LinkedCamera::of);
        Self { at: (*pixel).into(), size: (*size).into(), camera, home }
    }

    fn pin(&self) -> Option<PinnedPixel> {
        let [pixel, size] = [self.at, self.size].map(UVec2::from);
        let is_in = pixel.cmplt(size).all() && size.max_element() <= 1 << 16;
        let (camera, home) = (self.camera.camera()?, self.home.camera()?);
        is_in.then_some(PinnedPixel { pixel, size, camera, home })
    }
}

/// Has a link to what is shown given to the person.
pub(super) fn copy(studio: &mut Studio) {
    let view = LinkedView {
        title: super::name(studio),
        scene: studio.editor.writing().text(),
        method: studio.settings.methods.clone(),
        free_camera: studio.view.free_camera.as_ref().map(LinkedCamera::of),
        development: LinkedDevelopment::of(&studio.view.development),
        selected: studio.editor.selected_parts().map(LinkedPart::from).collect(),
        pixel: studio.audit.pin().map(LinkedPixel::of),
    };
    // It holds nothing that JSON has not.
    let Ok(text) = serde_json::to_string(&view) else { return };
    studio.documents.linking = studio.host.copy_link(text);
    if studio.editor.scene().images().next().is_some() {
        studio.toasts.info(studio.texts.get("link-without-pictures"));
    }
}

/// Tells what became of a link.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    let Some(answer) = &studio.documents.linking else { return };
    let outcome = match answer.try_recv() {
        Ok(outcome) => outcome,
        Err(TryRecvError::Empty) => return,
        Err(TryRecvError::Disconnected) => LinkOutcome::Refused,
    };
    studio.documents.linking = None;
    match outcome {
        LinkOutcome::Copied => studio.toasts.success(studio.texts.get("link-copied")),
        LinkOutcome::TooLong => studio.toasts.warning(studio.texts.get("link-too-long")),
        LinkOutcome::Refused => studio.toasts.warning(studio.texts.get("link-refused")),
    };
    context.request_repaint();
}

/// Shows what a link holds; returns whether it could be read.
pub(super) fn open(studio: &mut Studio, text: &str) -> bool {
    let Ok(view) = serde_json::from_str::<LinkedView>(text) else {
        let text = studio.texts.get("link-damaged").to_owned();
        studio.dialogs.open(MessageDialog::new(studio.texts.get("open-failed"), text));
        return false;
    };
    let reading = read(&view.scene);
    let text: Arc<str> = view.scene.into();
    show(studio, Editor::untitled(view.title, Arc::clone(&text), reading.scene));
    studio.editor.mark_unsaved();
    studio.settings.last = None;
    banner::show_findings(studio, text, reading.diagnostics);
    studio.settings.methods = view.method;
    let development = view.development.and_then(|development| development.development());
    studio.view.development = development.unwrap_or_default();
    studio.view.free_camera = view.free_camera.and_then(|camera| camera.camera());
    studio.editor.select_parts(view.selected.into_iter().map(ScenePart::from));
    if let Some(pin) = view.pixel.and_then(|pixel| pixel.pin()) {
        studio.view.is_auditing = true;
        studio.audit.pin_to(pin);
    }
    true
}
