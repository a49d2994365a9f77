//! The traced picture on the screen.

use std::sync::Arc;

use catoptric_live::{DisplayContent, Frame, LiveError};
use catoptric_tracer::SceneBuildError;
use egui::{Align2, Color32, ColorImage, FontId, Painter, Rect, TextureHandle, TextureOptions, pos2};

use crate::base::picture_frame;
use crate::base::texts::Texts;
use crate::base::theme::ThemeColors;
use crate::state::context::Cx;

/// What is left free around an unfolded cube: the bar over the picture, points.
const CUBE_MARGIN: f32 = 52.0;

/// The newest picture as a texture.
#[derive(Default)]
pub(crate) struct ViewportPicture {
    texture: Option<TextureHandle>,
    /// The picture in the texture.
    shown: Option<u64>,
}

impl ViewportPicture {
    /// Draws the newest picture, or why there is none, and gives the frame that it belongs to.
    pub(crate) fn show(
        &mut self,
        painter: &Painter,
        rect: Rect,
        cx: &mut Cx<'_>,
        palette: &ThemeColors,
    ) -> Option<Arc<Frame>> {
        let frame = cx.live.latest();
        let texture = frame.as_ref().and_then(|frame| match &frame.card {
            Some(picture) => cx.card.texture(picture, frame.view_size != frame.picture_size),
            None => {
                self.upload(painter, frame);
                self.texture.as_ref().map(TextureHandle::id)
            }
        });
        match texture {
            Some(texture) => {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                let place = place_of(rect, frame.as_deref());
                if place != rect {
                    painter.rect_filled(rect, 0.0, palette.field);
                }
                painter.image(texture, place, whole, Color32::WHITE);
            }
            None => {
                painter.rect_filled(rect, 0.0, palette.field);
            }
        }
        let error = cx.live.status().error;
        let message = match (&error, &frame) {
            (Some(error), _) => Some((why(cx.texts, error), palette.warning)),
            (None, None) => Some((cx.t("viewport-first-picture").to_owned(), palette.weak)),
            (None, Some(_)) => None,
        };
        if let Some((text, color)) = message {
            message_ui(painter, rect, text, color, palette);
        }
        frame
    }

    fn upload(&mut self, painter: &Painter, frame: &Frame) {
        if self.shown == Some(frame.picture_serial) {
            return;
        }
        let size = frame.picture_size.map(|side| side as usize);
        if frame.pixels.len() != 4 * size[0] * size[1] {
            return;
        }
        // Opaque: nothing is to be multiplied.
        let image = ColorImage::from_rgba_premultiplied(size, &frame.pixels);
        // Pixel upon pixel there is nothing to smooth.
        let is_whole = frame.view_size == frame.picture_size;
        let options = if is_whole { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(painter.ctx().load_texture("picture", image, options)),
        }
        self.shown = Some(frame.picture_serial);
    }
}

/// Where the picture lies: everywhere, but for an unfolded cube, which keeps its proportions.
fn place_of(rect: Rect, frame: Option<&Frame>) -> Rect {
    let Some(frame) = frame.filter(|frame| is_apart(frame)) else { return rect };
    let [width, height] = frame.picture_size.map(|side| side as f32);
    picture_frame::frame(rect.shrink(CUBE_MARGIN), f64::from(width) / f64::from(height.max(1.0)))
}

/// Whether what is seen is no view of the scene: nothing can be drawn over it or picked in it.
pub(crate) fn is_apart(frame: &Frame) -> bool {
    matches!(frame.shows, DisplayContent::UnfoldedCube(_))
}

fn message_ui(painter: &Painter, rect: Rect, text: String, color: Color32, palette: &ThemeColors) {
    let width = (rect.width() - 48.0).clamp(80.0, 460.0);
    let galley = painter.layout(text, FontId::proportional(14.0), color, width);
    let size = galley.size() + egui::vec2(28.0, 18.0);
    let back = Align2::CENTER_CENTER.anchor_size(rect.center(), size);
    painter.rect_filled(back, 8.0, palette.panel.gamma_multiply(0.92));
    painter.galley(back.min + egui::vec2(14.0, 9.0), galley, color);
}

/// Why there is no picture, in the words of the present language.
pub(crate) fn why(texts: &Texts, error: &LiveError) -> String {
    match error {
        LiveError::Stage(SceneBuildError::UndefinedMaterial { body, material }) => texts.with(
            "viewport-error-material",
            &[("body", body.as_str().into()), ("material", material.as_str().into())],
        ),
        LiveError::Stage(SceneBuildError::TooManyBodies(count)) => {
            texts.with("viewport-error-bodies", &[("count", (*count).into())])
        }
        LiveError::Stage(SceneBuildError::TooManyParts { body, parts }) => {
            let arguments = [("body", body.as_str().into()), ("count", (*parts).into())];
            texts.with("viewport-error-parts", &arguments)
        }
        LiveError::Size(_) | LiveError::TooLarge { .. } => texts.get("viewport-error-size").to_owned(),
        LiveError::Setting(error) => error.to_string(),
        LiveError::TooManyCubeMaps { bodies, size } => {
            let arguments = [("bodies", (*bodies).into()), ("size", (*size).into())];
            texts.with("viewport-error-maps", &arguments)
        }
        LiveError::Camera => texts.get("viewport-error-camera").to_owned(),
        LiveError::Fault(fault) => texts.with("viewport-error-fault", &[("fault", fault.as_str().into())]),
    }
}
