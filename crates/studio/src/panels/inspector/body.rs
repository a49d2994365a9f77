//! Bodies: their shape and sizes. Place and material have files of their own.

use std::sync::Arc;

use catoptric_scene::format::keys;
use catoptric_scene::{Body, ScenePart, ShapeKind};
use egui::{Id, Ui};

use super::sheet::{NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread};
use super::{InspectorState, header, material, parts, place, reshape};
use crate::base::shapes::shape_choice;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::section::section;
use crate::state::context::Cx;

static RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.shape.number("radius").filter(|_| body.shape.number("top_radius").is_none()),
    |body, value| {
        if body.shape.number("top_radius").is_none() {
            body.shape.set_number("radius", value);
        }
    },
);

static BASE_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("base-radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.shape.number("radius").filter(|_| body.shape.number("top_radius").is_some()),
    |body, value| {
        if body.shape.number("top_radius").is_some() {
            body.shape.set_number("radius", value);
        }
    },
);

static TOP_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("top-radius", "edit-top-radius", &keys::BODY, "top_radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.shape.number("top_radius"),
    |body, value| body.shape.set_number("top_radius", value),
);

static HEIGHT: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("height", "edit-height", &keys::BODY, "height").in_unit(Unit::Meters),
    SliderRail::None,
    Body::height,
    reshape::set_height,
);

static FOCAL_LENGTH: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("focal-length", "edit-focal-length", &keys::BODY, "focal_length").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.sized_shape().focal_length(),
    reshape::set_focal_length,
);

static SIZE: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("size", "edit-size", &keys::BODY, "size").in_unit(Unit::Meters),
    VectorSpread::Same,
    |body| body.shape.vector("size"),
    |body, value| body.shape.set_vector("size", value),
)
.linked(|memory| &mut memory.size_link);

/// Draws the values of the selected bodies.
pub(super) fn bodies_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let selected = cx.editor.selected_bodies().rev().collect();
    let chosen = header::chosen_ui(ui, cx, ScenePart::Body, selected, "several-bodies");
    let Some(header::InspectedItems { indices, first, item, subject, is_free }) = chosen else { return };
    let Some(primary) = scene.bodies.get(first) else { return };
    let mut sheet = PropertySheet {
        primary,
        things: indices.iter().filter_map(|&index| scene.bodies.get(index)).collect(),
        part: ScenePart::Body(first),
        subject: subject.clone(),
        id: Id::unique(("inspector-body", item)),
        is_free,
        apply: &|editor, label, change| {
            // They are changed in the order in which they are given.
            let mut places = 0..;
            editor.change_bodies(indices.iter().copied(), label, |_, body| {
                change(places.next().unwrap_or_default(), body);
            })
        },
        cx,
        memory,
    };
    shape_ui(ui, &mut sheet);
    place::place_ui(ui, &mut sheet);
    material::of_bodies_ui(ui, cx, memory, &scene, &indices, &subject);
}

fn shape_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    let texts = sheet.texts();
    let kind = sheet.primary.shape.kind();
    let summary = texts.get(shape_choice(kind));
    section(ui, "shape", texts.get("section-shape"), summary, sheet.is_free, |ui| {
        let kinds = ShapeKind::ALL.into_iter().filter(|other| other.is_compound() == kind.is_compound());
        let choices: Vec<ChoiceItem<'_, ShapeKind>> = kinds
            .map(|kind| {
                let key = shape_choice(kind);
                ChoiceItem {
                    value: kind,
                    text: texts.get(key),
                    tip: texts.tip(key).unwrap_or_default(),
                    is_enabled: true,
                }
            })
            .collect();
        let is_mixed = sheet.things.iter().any(|body| body.shape.kind() != kind);
        let chosen = (!is_mixed).then_some(kind);
        let id = sheet.id.with("shape");
        let width = ui.available_width();
        if let Some(kind) = choice_ui(ui, id, texts.get("section-shape"), width, &choices, chosen) {
            sheet.change("shape", "edit-shape", |_, body| reshape::reshape(body, kind));
        }
        sheet.note(ui, "shape");
        let chosen = Some(sheet.primary.shape.key());
        sheet.vector(ui, &SIZE);
        sheet.number(ui, &RADIUS, chosen);
        sheet.number(ui, &BASE_RADIUS, chosen);
        sheet.number(ui, &TOP_RADIUS, chosen);
        sheet.number(ui, &HEIGHT, chosen);
        sheet.number(ui, &FOCAL_LENGTH, chosen);
        if sheet.primary.shape.is_compound() && sheet.things.len() == 1 {
            parts::parts_ui(ui, texts, &sheet.primary.parts);
        }
    });
}
