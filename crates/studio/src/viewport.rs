//! The panel of the picture.

use egui::{Color32, ColorImage, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2};

use crate::context::Cx;

/// What the viewport keeps from frame to frame.
#[derive(Default)]
pub(crate) struct Viewport {
    texture: Option<TextureHandle>,
    /// The picture in the texture.
    shown: Option<u64>,
    size_in_pixels: Option<[u32; 2]>,
}

impl Viewport {
    /// The size for which a picture is wanted, once the panel has been drawn.
    pub(crate) fn size_in_pixels(&self) -> Option<[u32; 2]> {
        self.size_in_pixels
    }
}

/// Draws the picture.
pub(crate) fn viewport_ui(ui: &mut Ui, cx: &mut Cx<'_>, viewport: &mut Viewport) {
    let (rect, _response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
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
