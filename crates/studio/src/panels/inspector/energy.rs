//! Notes when a surface or its highlight would send out more light than it receives.

use catoptric_lab::depth::{ExcessKind, excess_of};
use catoptric_scene::{Color, Material, Pattern, SolidTexture};
use egui::{Label, RichText, Sense, Ui, vec2};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::{ICON_INFO, ICON_WARNING};

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::number::shown;
use crate::base::widgets::paint_icon;
use crate::base::widgets::tip::tip_beside;

/// Draws what is to be said of a material.
pub(super) fn energy_ui(ui: &mut Ui, texts: &Texts, material: &Material) {
    let palette = theme::palette(ui.visuals());
    for (kind, amount) in excess_of(material) {
        let (key, sum) = told(texts, material, kind, &shown(texts, amount, 3));
        let text = texts.with(key, &[("sum", sum.replace(' ', "\u{a0}").into())]);
        line_ui(ui, ICON_WARNING, palette.warning, text, texts.tip(key));
    }
    if matches!(material, Material::Coated(coated) if is_brighter_than_white(&coated.pattern)) {
        line_ui(ui, ICON_INFO, palette.weak, texts.get("energy-coat").to_owned(), texts.tip("energy-coat"));
    }
}

/// The message, and how the amount comes about.
fn told(texts: &Texts, material: &Material, kind: ExcessKind, amount: &str) -> (&'static str, String) {
    let ExcessKind::Surface { diffuse, reflection, transmission, .. } = kind else {
        return ("energy-highlight", amount.to_owned());
    };
    match material {
        Material::Mirror(mirror) => {
            let share = mirror.reflection();
            let color = if share > 0.0 { reflection / share } else { 0.0 };
            ("energy-mirror", format!("{} · {} = {amount}", shown(texts, share, 3), shown(texts, color, 3)))
        }
        Material::Matte(_) => ("energy-matte", amount.to_owned()),
        Material::Phong(_)
        | Material::Dielectric(_)
        | Material::Conductor(_)
        | Material::Coated(_)
        | Material::ThinDielectric(_) => {
            let parts = [diffuse, reflection, transmission].map(|part| shown(texts, part, 3));
            ("energy-warning", format!("{} = {amount}", parts.join(" + ")))
        }
    }
}

fn is_brighter_than_white(pattern: &Pattern) -> bool {
    let has_picture = pattern.texture.as_ref().is_some_and(|image| image.pixels().is_some());
    let own = (!has_picture).then_some(pattern.color);
    let patterns = pattern.solid.iter().flat_map(SolidTexture::all);
    let colors = own.into_iter().chain(patterns.map(|solid| solid.color));
    colors.flat_map(Color::to_array).any(|part| part > 1.0)
}

fn line_ui(ui: &mut Ui, icon: MaterialIcon, color: egui::Color32, text: String, tip: Option<&str>) {
    let response = ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let (rect, _) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
        paint_icon(ui, icon, rect.center(), 14.0, color);
        ui.add(Label::new(RichText::new(text).color(color).size(12.0)).wrap())
    });
    tip_beside(ui, response.inner, tip.unwrap_or_default());
}
