//! The panel of the picture.

use catoptric_editor::navigate::{self, Axis};
use catoptric_editor::{Label, bounds};
use catoptric_scene::Camera;
use egui::{Color32, ColorImage, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2};
use glam::DVec3;

use crate::app::Studio;
use crate::context::Cx;

/// What the viewport keeps from frame to frame.
#[derive(Default)]
pub(crate) struct Viewport {
    texture: Option<TextureHandle>,
    /// The picture in the texture.
    shown: Option<u64>,
    size_in_pixels: Option<[u32; 2]>,
    rect: Option<Rect>,
}

impl Viewport {
    /// The size for which a picture is wanted, once the panel has been drawn.
    pub(crate) fn size_in_pixels(&self) -> Option<[u32; 2]> {
        self.size_in_pixels
    }

    /// Where the picture is in the window.
    pub(crate) fn rect(&self) -> Option<Rect> {
        self.rect
    }

    /// Width over height.
    pub(crate) fn aspect(&self) -> f64 {
        self.size_in_pixels.map_or(1.0, |[width, height]| f64::from(width.max(1)) / f64::from(height.max(1)))
    }
}

/// Draws the picture.
pub(crate) fn viewport_ui(ui: &mut Ui, cx: &mut Cx<'_>, viewport: &mut Viewport) {
    let (rect, _response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    viewport.rect = Some(rect);
    let scale = ui.ctx().pixels_per_point();
    let pixels = (rect.size() * scale).round().max(egui::Vec2::ZERO);
    viewport.size_in_pixels = Some([pixels.x as u32, pixels.y as u32]);
    let Some(frame) = cx.live.latest() else { return };
    if viewport.shown != Some(frame.picture_serial) {
        let size = frame.picture_size.map(|side| side as usize);
        let image = ColorImage::from_rgba_unmultiplied(size, &frame.pixels);
        match &mut viewport.texture {
            Some(texture) => texture.set(image, TextureOptions::LINEAR),
            None => viewport.texture = Some(ui.ctx().load_texture("picture", image, TextureOptions::LINEAR)),
        }
        viewport.shown = Some(frame.picture_serial);
    }
    if let Some(texture) = &viewport.texture {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
    }
}

/// Where a new body is to stand: on the ground, where the view looks.
pub(crate) fn place_for_new(studio: &Studio) -> DVec3 {
    let target = studio.view.camera(studio.editor.scene()).target;
    DVec3::new(target.x, 0.0, target.z)
}

/// Where a new light is to hang: above where the view looks.
pub(crate) fn place_for_new_light(studio: &Studio) -> DVec3 {
    let camera = studio.view.camera(studio.editor.scene());
    camera.target + 0.5 * camera.target.distance(camera.position) * DVec3::Y
}

/// Moves the camera of the view: the free one, or else the scene's as one step of the history.
pub(crate) fn set_camera(studio: &mut Studio, key: &'static str, camera: Camera) {
    match &mut studio.view.free_camera {
        Some(free) => *free = camera,
        None => set_scene_camera(studio, key, camera),
    }
}

/// Moves the scene's camera as one step of the history.
pub(crate) fn set_scene_camera(studio: &mut Studio, key: &'static str, camera: Camera) {
    studio.editor.settle();
    // A camera that navigation made is valid.
    let _ = studio.editor.change_camera(Label::new(key, ""), |own| *own = camera);
    studio.editor.settle();
}

/// Brings the selected or all bodies into view.
pub(crate) fn frame(studio: &mut Studio, all: bool) {
    let scene = studio.editor.scene();
    let selected = if all { None } else { bounds::ball_of_selection(scene, studio.editor.selection()) };
    let Some(ball) = selected.or_else(|| bounds::ball_of_scene(scene)) else { return };
    let camera = studio.view.camera(scene);
    let camera = navigate::frame(&camera, ball.center, ball.radius, studio.panes.viewport.aspect());
    set_camera(studio, "edit-frame", camera);
}

/// Looks along an axis, in the free view: the scene's camera stays.
pub(crate) fn look_along(studio: &mut Studio, axis: Axis) {
    let camera = studio.view.camera(studio.editor.scene());
    studio.view.free_camera = Some(navigate::look_along(&camera, axis, camera.target));
}
