//! The proof of a finished picture: developed and made as large as its window shows it.

use std::sync::Arc;

use catoptric_picture::{Development, Picture};
use egui::emath::GuiRounding as _;
use egui::{
    Align2, Color32, ColorImage, Context, Rect, Role, Sense, TextStyle, TextureHandle, TextureOptions, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};

use crate::base::job::{Job, JobStatus};
use crate::base::proof::{ProofKey, fitting, proof, size_of};
use crate::base::texts::Texts;
use crate::base::theme;

/// The proof of the picture in the window.
#[derive(Default)]
pub(crate) struct PictureProof {
    texture: Option<(ProofKey, TextureHandle)>,
    job: Option<(ProofKey, Job<ColorImage>)>,
    /// What is not tried again.
    failed: Option<ProofKey>,
}

impl PictureProof {
    /// Draws the picture as large as it fits, and has it developed again when something else is wanted.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        texts: &Texts,
        picture: &Arc<Picture>,
        development: Development,
    ) {
        let palette = theme::palette(ui.visuals());
        let (room, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        let scale = ui.ctx().pixels_per_point();
        let side = ui.input(|input| input.max_texture_side) as f32;
        let most = (room.size() * scale).max(Vec2::ZERO).min(Vec2::splat(side));
        let size = fitting(size_of(picture), [most.x as u32, most.y as u32]);
        self.poll(ui.ctx());
        self.want(ui.ctx(), picture, ProofKey { development, size });
        ui.painter().rect_filled(room, 4.0, palette.bar);
        let size = vec2(size[0] as f32, size[1] as f32) / scale;
        let place = Rect::from_center_size(room.center(), size.min(room.size())).round_to_pixels(scale);
        match &self.texture {
            Some((_, texture)) => {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture.id(), place, whole, Color32::WHITE);
            }
            None => {
                let font = TextStyle::Body.resolve(ui.style());
                let text = texts.get("picture-developing");
                ui.painter().text(room.center(), Align2::CENTER_CENTER, text, font, palette.weak);
            }
        }
        let name = texts.get("picture-preview");
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    }

    /// Takes up what has been developed.
    fn poll(&mut self, context: &Context) {
        let Some((wanted, job)) = self.job.take() else { return };
        let image = match job.poll() {
            JobStatus::Waiting => return self.job = Some((wanted, job)),
            JobStatus::Lost => return self.failed = Some(wanted),
            JobStatus::Done(image) => image,
        };
        match &mut self.texture {
            Some((made, texture)) => {
                texture.set(image, TextureOptions::LINEAR);
                *made = wanted;
            }
            none => {
                let texture = context.load_texture("finished picture", image, TextureOptions::LINEAR);
                *none = Some((wanted, texture));
            }
        }
    }

    /// Has the picture developed as wanted, when nothing else is being developed.
    fn want(&mut self, context: &Context, picture: &Arc<Picture>, wanted: ProofKey) {
        let is_shown = self.texture.as_ref().is_some_and(|(made, _)| *made == wanted);
        if is_shown || self.job.is_some() || self.failed == Some(wanted) {
            return;
        }
        let picture = Arc::clone(picture);
        self.job =
            Job::start(context, "proof", move || proof(&picture, &wanted)).ok().map(|job| (wanted, job));
    }
}
