//! The parts of a body, as a list to be read.

use catoptric_scene::{BodyPart, MaterialChoice};
use egui::{Label, RichText, Ui};

use super::header::hint;
use crate::base::shapes::shape_name;
use crate::base::texts::Texts;
use crate::base::theme;

/// The most parts that are listed: place and material below stay in sight.
const MOST: usize = 8;

/// Draws the list.
pub(super) fn parts_ui(ui: &mut Ui, texts: &Texts, parts: &[BodyPart]) {
    let mut lines = Vec::new();
    add_lines(texts, parts, 0, &mut lines);
    ui.add_space(4.0);
    ui.label(texts.get("parts"));
    for line in lines.iter().take(MOST) {
        ui.add(Label::new(line).truncate());
    }
    if let Some(more) = lines.len().checked_sub(MOST).filter(|more| *more > 0) {
        let color = theme::palette(ui.visuals()).weak;
        ui.label(RichText::new(texts.with("parts-more", &[("count", more.into())])).color(color));
    }
    hint(ui, texts.get(if parts.len() == 1 { "parts-alone" } else { "parts-hint" }));
}

/// A line for each part: how deep it lies, its name or its shape, and the shared material that it has of its own.
fn add_lines(texts: &Texts, parts: &[BodyPart], depth: usize, lines: &mut Vec<String>) {
    for part in parts {
        if lines.len() > 10 * MOST {
            return;
        }
        let kind = part.form().body_shape().kind();
        let shape = texts.get(shape_name(kind));
        let name = if part.name.is_empty() { shape.to_owned() } else { format!("{} ({shape})", part.name) };
        let material = match &part.material {
            Some(MaterialChoice::Named(name)) => format!(", {name}"),
            Some(MaterialChoice::Inline(_)) => format!(", {}", texts.get("material-own")),
            None => String::new(),
        };
        lines.push(format!("{}• {name}{material}", "    ".repeat(depth)));
        // The parts of a lens or a tube are nobody's to change.
        if kind.is_compound() {
            add_lines(texts, &part.parts, depth + 1, lines);
        }
    }
}
