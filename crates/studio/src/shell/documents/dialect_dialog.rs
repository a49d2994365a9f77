//! How the scenes of a miniRT program are to be read.

use catoptric_exchange::Dialect;
use egui::{Label, RichText, Ui};

use super::open;
use crate::base::texts::Texts;
use crate::base::words::name_of;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::{Dialog, DialogFlow, body_ui, buttons};
use crate::state::settings::LastScene;

/// A dialog that asks what a miniRT program does otherwise than most.
pub(super) struct DialectDialog {
    dialect: Dialect,
}

impl DialectDialog {
    /// Begins with the dialect of the scene that was read last.
    pub(super) fn new(studio: &Studio) -> Self {
        Self { dialect: studio.settings.dialect() }
    }

    fn rows(&mut self) -> [(&mut bool, &'static str); 8] {
        let Dialect {
            has_radius,
            is_cylinder_at_base,
            is_cone_at_base,
            has_angle_of_cone,
            has_height_of_cone_first,
            has_vertical_fov,
            is_left_handed,
            has_added_reflection,
        } = &mut self.dialect;
        [
            (has_radius, "dialect-radius"),
            (is_cylinder_at_base, "dialect-base"),
            (is_cone_at_base, "dialect-cone-base"),
            (has_angle_of_cone, "dialect-cone-angle"),
            (has_height_of_cone_first, "dialect-cone-height-first"),
            (has_vertical_fov, "dialect-vertical-fov"),
            (is_left_handed, "dialect-left-handed"),
            (has_added_reflection, "dialect-added-reflection"),
        ]
    }
}

impl Dialog for DialectDialog {
    fn title(&self, texts: &Texts) -> String {
        texts.get("dialect-title").to_owned()
    }

    fn width(&self) -> f32 {
        520.0
    }

    fn ui(&mut self, ui: &mut Ui, studio: &mut Studio) -> DialogFlow {
        let Some(LastScene::File(path)) = studio.settings.last.clone() else { return DialogFlow::Close };
        let texts = &studio.texts;
        let text = texts.with("dialect-text", &[("name", name_of(&path).into())]);
        body_ui(ui, |ui| {
            ui.add(Label::new(text).wrap());
            ui.add_space(8.0);
            for (is_on, key) in self.rows() {
                ui.checkbox(is_on, texts.get(key));
                ui.indent(key, |ui| {
                    ui.add(Label::new(RichText::new(texts.tip(key).unwrap_or_default()).weak()).wrap());
                });
                ui.add_space(2.0);
            }
        });
        match buttons(ui, &[texts.get("dialect-read"), texts.get("cancel")]) {
            Some(0) => {
                studio.settings.minirt_dialect = self.dialect.to_string();
                open::begin(ui.ctx(), studio, &path);
                DialogFlow::Close
            }
            Some(_) => DialogFlow::Close,
            None => DialogFlow::Stay,
        }
    }
}
