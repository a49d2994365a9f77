//! The audit: a pixel is pinned, and all its rays are listed with their numbers and drawn in space.

pub(crate) mod clock;
mod hidden;
mod result;
mod segments;

use std::collections::BTreeSet;
use std::sync::Arc;

use catoptric_editor::Editor;
use catoptric_lab::audit::{Audit, AuditError};
use catoptric_live::Live;
use catoptric_scene::{Camera, Scene};
use catoptric_tracer::{RenderSettings, render_pixel};
use egui::Context;
use glam::UVec2;

pub(crate) use clock::SlowLight;
pub(crate) use hidden::{SEEN, SegmentPart};
pub(crate) use result::{AuditRequest, AuditResult};
pub(crate) use segments::{RaySegment, SegmentKind, pixel_at};

use crate::base::latest::Latest;

/// The pixel that an audit examines, and its picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PinnedPixel {
    /// Column and row, from the upper left.
    pub(crate) pixel: UVec2,
    /// Pixels across and down.
    pub(crate) size: UVec2,
    /// The camera of the picture.
    pub(crate) camera: Camera,
    /// The camera before its window was fitted to the panel, for looking through it again.
    pub(crate) home: Camera,
}

/// The audit of the window.
#[derive(Default)]
pub(crate) struct AuditState {
    pin: Option<PinnedPixel>,
    /// A pixel was pinned in this frame: the panel is to be seen.
    pub(crate) wants_panel: bool,
    found: Option<Arc<AuditResult>>,
    pub(crate) failure: Option<AuditError>,
    /// The state of the document that was looked into last, and how it came about.
    seen: Option<DocumentStamp>,
    audits: Latest<(DocumentStamp, PinnedPixel), Result<AuditResult, AuditError>>,
    hidden_parts_job: Latest<HiddenPartsKey, Vec<Vec<SegmentPart>>>,
    hidden_parts: Option<(HiddenPartsKey, Vec<Vec<SegmentPart>>)>,
    probes: Latest<PixelProbe, Option<[f32; 3]>>,
    probed: Option<(PixelProbe, [f32; 3])>,
    serial: u64,
    /// The ray that is lit.
    pub(crate) selected: Option<usize>,
    /// Bring it into view in the list.
    pub(crate) scrolls: bool,
    /// The rays whose terms are listed.
    pub(crate) expanded: BTreeSet<usize>,
    /// The last generation that is shown; `None` for all.
    pub(crate) step: Option<u32>,
    pub(crate) light: SlowLight,
}

/// The number of an audit, and the camera that looks at its rays.
type HiddenPartsKey = (u64, Camera);

/// A state of the document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct DocumentStamp {
    revision: u64,
    /// The steps of the history, and whether another one is under way: the same for all states of one drag.
    step: (usize, bool),
}

/// A pixel under the pointer, in a state of the document.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PixelProbe {
    revision: u64,
    pixel: UVec2,
    size: UVec2,
    camera: Camera,
}

impl AuditState {
    /// The audit of a pixel that was looked into.
    #[cfg(test)]
    pub(crate) fn of(found: AuditResult) -> Self {
        Self { found: Some(Arc::new(found)), ..Self::default() }
    }

    /// The pinned pixel.
    pub(crate) fn pin(&self) -> Option<&PinnedPixel> {
        self.pin.as_ref()
    }

    /// What is known of it.
    pub(crate) fn found(&self) -> Option<&Arc<AuditResult>> {
        self.found.as_ref()
    }

    /// Looks into another pixel.
    pub(crate) fn pin_to(&mut self, pin: PinnedPixel) {
        self.release();
        self.pin = Some(pin);
        self.wants_panel = true;
    }

    /// Looks into no pixel.
    pub(crate) fn release(&mut self) {
        self.audits.cancel();
        self.hidden_parts_job.cancel();
        (self.pin, self.failure, self.seen, self.hidden_parts, self.selected) =
            (None, None, None, None, None);
        self.expanded.clear();
        self.step = None;
        self.light.end();
        if let Some(found) = self.found.take() {
            // A large tree takes its time.
            crate::base::job::let_go(found);
        }
    }

    /// The ray that is lit.
    pub(crate) fn selected(&self) -> Option<usize> {
        self.selected
    }

    /// Lights a ray, here and in the picture.
    pub(crate) fn select(&mut self, node: usize) {
        self.selected = Some(node);
        self.scrolls = true;
    }

    /// Whether rays of a generation are shown.
    pub(crate) fn shows(&self, generation: u32) -> bool {
        self.step.is_none_or(|step| generation <= step)
    }

    /// The parts of the ways as `camera` sees them; those of the last camera while they are being found.
    pub(crate) fn hidden_parts(&self) -> Option<&Vec<Vec<SegmentPart>>> {
        let ((serial, _), parts) = self.hidden_parts.as_ref()?;
        (Some(*serial) == self.found.as_ref().map(|found| found.serial)).then_some(parts)
    }

    /// The linear light of the pixel that was asked for last, if it is known.
    pub(crate) fn probed(&self, pixel: UVec2) -> Option<[f32; 3]> {
        self.probed.as_ref().filter(|(probe, _)| probe.pixel == pixel).map(|(_, light)| *light)
    }

    /// Takes up what was found.
    fn poll(&mut self) {
        if let Some(((seen, pin), found)) = self.audits.poll()
            && self.pin == Some(pin)
        {
            self.seen = Some(seen);
            match found {
                Some(Ok(found)) => self.take(found),
                Some(Err(AuditError::Cancelled)) | None => {}
                Some(Err(error)) => self.failure = Some(error),
            }
        }
        if let Some((key, Some(parts))) = self.hidden_parts_job.poll() {
            self.hidden_parts = Some((key, parts));
        }
        if let Some((probe, Some(Some(light)))) = self.probes.poll() {
            self.probed = Some((probe, light));
        }
    }

    fn take(&mut self, found: AuditResult) {
        self.failure = None;
        let count = found.tree().map_or(0, |tree| tree.nodes.len());
        self.selected = self.selected.filter(|node| *node < count).or_else(|| (count > 0).then_some(0));
        if self.found.is_none() {
            self.expanded.insert(0);
        }
        let generations = found.generations();
        self.step = self.step.filter(|step| *step < generations);
        self.found = Some(Arc::new(found));
    }

    /// The audit before the change that made the present scene.
    fn before(&self, now: DocumentStamp) -> Option<(Arc<Audit>, Arc<Scene>)> {
        let found = self.found.as_ref()?;
        let is_same_change = self.seen.is_some_and(|seen| seen.step == now.step);
        match &found.before {
            Some(before) if is_same_change => Some((Arc::clone(&before.audit), Arc::clone(&before.scene))),
            None if is_same_change => None,
            _ => Some((Arc::clone(&found.audit), Arc::clone(&found.scene))),
        }
    }

    /// Takes up what was found of the pinned pixel, and lets slow light go on; in every frame.
    pub(crate) fn keep_up(&mut self, context: &Context) {
        self.poll();
        if self.light.is_running {
            let span = self.found.as_ref().map(|found| found.span).unwrap_or_default();
            self.light.move_on(context.input(|input| input.time), &span);
            context.request_repaint();
        }
    }

    /// Has the pinned pixel looked into, in the present state of the document; in every frame.
    pub(crate) fn want(&mut self, context: &Context, editor: &Editor, live: &Live) {
        let Some(pin) = self.pin else { return };
        let step = (editor.steps_done(), editor.is_in_gesture());
        let now = DocumentStamp { revision: editor.revision(), step };
        if self.seen.is_some_and(|seen| seen.revision == now.revision) {
            return;
        }
        let scene = editor.scene();
        if self.found.as_ref().is_some_and(|found| is_same_but_for_camera(&found.scene, scene)) {
            self.seen = Some(now);
            return;
        }
        // The scene of this state is on its way; the window wakes up when it is there.
        let Some((_, render_scene)) = live.render_scene().filter(|(revision, _)| *revision == now.revision)
        else {
            return;
        };
        let before = self.before(now);
        self.serial += 1;
        let order = AuditRequest { serial: self.serial, pin, scene: Arc::clone(scene), render_scene, before };
        self.audits.want(context, &(now, pin), move |control| order.carry_out(control));
    }

    /// Finds out which parts of the rays `camera` sees.
    pub(crate) fn update_hidden_parts(&mut self, context: &Context, live: &Live, camera: Camera) {
        let Some(found) = &self.found else { return };
        let key = (found.serial, camera);
        if self.hidden_parts.as_ref().is_some_and(|(known, _)| *known == key) {
            return;
        }
        let Some((_, render_scene)) = live.render_scene() else { return };
        let found = Arc::clone(found);
        self.hidden_parts_job.want(context, &key, move |control| {
            hidden::parts(&found.ways, &found.scene, &render_scene, &camera, control)
        });
    }

    /// Finds out the light of a pixel under the pointer.
    pub(crate) fn probe(
        &mut self,
        context: &Context,
        live: &Live,
        pixel: UVec2,
        size: UVec2,
        camera: Camera,
    ) {
        let Some((revision, render_scene)) = live.render_scene() else { return };
        let probe = PixelProbe { revision, pixel, size, camera };
        if self.probed.as_ref().is_some_and(|(known, _)| *known == probe) {
            return;
        }
        self.probes.want(context, &probe, move |control| {
            let picture = RenderSettings { width: size.x, height: size.y, samples: 1 };
            render_pixel(&render_scene, &render_scene.camera_for(&camera), picture, pixel, control)
                .ok()
                .flatten()
        });
    }
}

/// The audited camera stays where it was, wherever the scene's goes.
fn is_same_but_for_camera(one: &Scene, other: &Scene) -> bool {
    Scene { camera: other.camera, ..one.clone() } == *other
}
