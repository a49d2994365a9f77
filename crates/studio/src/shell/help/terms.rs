//! The terms of optics, a sentence each.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, FontId, RichText, Ui};

use crate::base::texts::Texts;
use crate::base::theme;

/// A term: its sign with the index that stands under it, and its message.
struct GlossaryTerm {
    sign: &'static str,
    index: &'static str,
    key: &'static str,
}

const fn term(sign: &'static str, index: &'static str, key: &'static str) -> GlossaryTerm {
    GlossaryTerm { sign, index, key }
}

/// The terms, from the surface over the light to the rays, then the other ways of drawing.
const TERMS: [GlossaryTerm; 27] = [
    term("C", "", "glossary-color"),
    term("k", "a", "glossary-ambient"),
    term("k", "d", "glossary-diffuse"),
    term("k", "s", "glossary-specular"),
    term("n", "", "glossary-shininess"),
    term("k", "r", "glossary-reflection"),
    term("k", "t", "glossary-transmission"),
    term("η", "", "glossary-ior"),
    term("τ", "", "glossary-tint"),
    term("s", "", "glossary-pattern"),
    term("I", "j", "glossary-intensity"),
    term("A(d)", "", "glossary-falloff"),
    term("I", "a", "glossary-ambient-light"),
    term("I", "b", "glossary-background"),
    term("", "", "glossary-generations"),
    term("w", "", "glossary-threshold"),
    term("", "", "glossary-total-reflection"),
    term("", "", "glossary-shadow"),
    term("", "", "glossary-weight"),
    term("", "", "glossary-optical-path"),
    term("", "", "glossary-virtual-image"),
    term("", "", "glossary-facet"),
    term("", "", "glossary-g-buffer"),
    term("", "", "glossary-ssr"),
    term("", "", "glossary-cube-map"),
    term("", "", "glossary-parallax"),
    term("", "", "glossary-flip"),
];

/// Draws the terms.
pub(super) fn terms_ui(ui: &mut Ui, texts: &Texts) {
    let palette = theme::palette(ui.visuals());
    ui.add_space(8.0);
    egui::Grid::new("terms").num_columns(2).spacing([16.0, 10.0]).show(ui, |ui| {
        for term in &TERMS {
            if term.sign.is_empty() {
                // An empty label would be read out.
                ui.allocate_exact_size(egui::Vec2::ZERO, egui::Sense::hover());
            } else {
                ui.label(sign(term, palette.accent));
            }
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                ui.label(RichText::new(texts.get(term.key)).color(palette.text));
                let tip = texts.tip(term.key).unwrap_or_default();
                ui.add(egui::Label::new(RichText::new(tip).color(palette.weak)).wrap());
            });
            ui.end_row();
        }
    });
}

fn sign(term: &GlossaryTerm, color: egui::Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let format = |size, valign| TextFormat {
        font_id: FontId::proportional(size),
        color,
        valign,
        ..Default::default()
    };
    job.append(term.sign, 0.0, format(17.0, Align::Center));
    job.append(term.index, 0.0, format(11.0, Align::BOTTOM));
    job
}
