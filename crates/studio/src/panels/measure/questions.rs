//! What is asked of the pictures beside their time.

use catoptric_lab::measure::PictureQuestion;
use catoptric_scene::format::spec::Limits;
use catoptric_scene::{Camera, Scene};
use egui::Ui;
use glam::{DVec2, UVec2};

use super::form::whole_ui;
use crate::base::projector::Projector;
use crate::base::texts::Texts;
use crate::state::audit::{PinnedPixel, pixel_at};

/// The questions that are chosen.
#[derive(Default)]
pub(super) struct QuestionsDraft {
    mean: bool,
    pixel: bool,
    flip: bool,
    rays: bool,
    /// A pixel of one's own; otherwise the one that is looked into.
    place: Option<[u32; 2]>,
}

/// The pixel of a picture of this size that shows what the pinned pixel shows; the middle one if none is pinned, or it
/// is out of the picture.
pub(super) fn usual_pixel(scene: &Scene, pin: Option<&PinnedPixel>, size: [u32; 2]) -> [u32; 2] {
    let size = UVec2::from(size);
    let seen = |camera: &Camera| Projector::new(camera, size.as_dvec2());
    let place = pin.and_then(|pin| pixel_at(pin, &seen(&scene.camera)));
    let place = place.filter(|place| place.cmpge(DVec2::ZERO).all() && place.cmplt(size.as_dvec2()).all());
    place.map_or(size / 2, DVec2::as_uvec2).into()
}

impl QuestionsDraft {
    /// What is asked; `usual` is the pixel if none was typed.
    pub(super) fn asked(&self, usual: [u32; 2]) -> Vec<PictureQuestion> {
        let pixel = PictureQuestion::Pixel(self.place.unwrap_or(usual));
        [
            (self.mean, PictureQuestion::Mean),
            (self.pixel, pixel),
            (self.flip, PictureQuestion::Flip),
            (self.rays, PictureQuestion::Rays),
        ]
        .into_iter()
        .filter_map(|(is_asked, question)| is_asked.then_some(question))
        .collect()
    }

    /// Draws the questions with the fields of the pixel.
    pub(super) fn ui(&mut self, ui: &mut Ui, texts: &Texts, usual: [u32; 2], size: [u32; 2]) {
        ui.label(texts.get("measure-answers"))
            .on_hover_text(texts.tip("measure-answers").unwrap_or_default());
        ui.horizontal_wrapped(|ui| {
            for (is_asked, key) in [
                (&mut self.mean, "measure-answer-mean"),
                (&mut self.flip, "measure-answer-flip"),
                (&mut self.rays, "measure-answer-rays"),
            ] {
                let tip = texts.tip(key).unwrap_or_default();
                ui.checkbox(is_asked, texts.get(key)).on_hover_text(tip);
            }
        });
        ui.horizontal(|ui| {
            let key = "measure-answer-pixel";
            let tip = texts.tip(key).unwrap_or_default();
            ui.checkbox(&mut self.pixel, texts.get(key)).on_hover_text(tip);
            if self.pixel {
                let mut place = self.place.unwrap_or(usual);
                let names = ["measure-answer-column", "measure-answer-row"];
                for ((number, side), name) in place.iter_mut().zip(size).zip(names) {
                    let limits = Limits::new(0.0, f64::from(side.saturating_sub(1)));
                    whole_ui(ui, texts, texts.get(name), number, limits);
                }
                if place != self.place.unwrap_or(usual) {
                    self.place = Some(place);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pinned_pixel_is_found_in_a_picture_of_another_size() {
        let scene = Scene::default();
        let pin = |pixel: [u32; 2], size: [u32; 2]| PinnedPixel {
            pixel: pixel.into(),
            size: size.into(),
            camera: scene.camera,
            home: scene.camera,
        };
        assert_eq!(usual_pixel(&scene, None, [320, 180]), [160, 90]);
        assert_eq!(usual_pixel(&scene, Some(&pin([400, 90], [640, 360])), [320, 180]), [200, 45]);
        // A narrower picture does not show it.
        assert_eq!(usual_pixel(&scene, Some(&pin([10, 90], [640, 360])), [180, 180]), [90, 90]);
        let mut questions = QuestionsDraft { pixel: true, rays: true, ..QuestionsDraft::default() };
        assert_eq!(questions.asked([3, 4]), [PictureQuestion::Pixel([3, 4]), PictureQuestion::Rays]);
        questions.place = Some([5, 6]);
        assert_eq!(questions.asked([3, 4]), [PictureQuestion::Pixel([5, 6]), PictureQuestion::Rays]);
    }
}
