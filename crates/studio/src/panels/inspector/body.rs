//! Bodies: their shape and sizes. Place and material have files of their own.

use std::sync::Arc;

use catoptric_editor::Item;
use catoptric_scene::format::keys;
use catoptric_scene::{Body, Shape, ShapeKind};
use egui::{Id, Ui};

use super::sheet::{NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread};
use super::{InspectorState, header, material, place, reshape};
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::section::section;
use crate::state::context::Cx;

static RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| match body.shape {
        Shape::Sphere { radius } | Shape::Cylinder { radius, .. } => Some(radius),
        _ => None,
    },
    |body, value| {
        if let Shape::Sphere { radius } | Shape::Cylinder { radius, .. } = &mut body.shape {
            *radius = value;
        }
    },
);

static BASE_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("base-radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| if let Shape::Cone { radius, .. } = body.shape { Some(radius) } else { None },
    |body, value| {
        if let Shape::Cone { radius, .. } = &mut body.shape {
            *radius = value;
        }
    },
);

static TOP_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("top-radius", "edit-top-radius", &keys::BODY, "top_radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| if let Shape::Cone { top_radius, .. } = body.shape { Some(top_radius) } else { None },
    |body, value| {
        if let Shape::Cone { top_radius, .. } = &mut body.shape {
            *top_radius = value;
        }
    },
);

static HEIGHT: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("height", "edit-height", &keys::BODY, "height").in_unit(Unit::Meters),
    SliderRail::None,
    Body::height,
    reshape::set_height,
);

static SIZE: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("size", "edit-size", &keys::BODY, "size").in_unit(Unit::Meters),
    VectorSpread::Same,
    |body| if let Shape::Cube { size } = body.shape { Some(size) } else { None },
    |body, value| {
        if let Shape::Cube { size } = &mut body.shape {
            *size = value;
        }
    },
)
.linked(|memory| &mut memory.size_link);

/// Draws the values of the selected bodies.
pub(super) fn bodies_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let scene = Arc::clone(cx.editor.scene());
    let selected = cx.editor.selection().bodies().rev().collect();
    let chosen = header::chosen_ui(ui, cx, Item::Body, selected, "several-bodies");
    let Some(header::InspectedItems { indices, first, subject, is_free }) = chosen else { return };
    let Some(primary) = scene.bodies.get(first) else { return };
    let mut sheet = PropertySheet {
        primary,
        things: indices.iter().filter_map(|&index| scene.bodies.get(index)).collect(),
        subject: subject.clone(),
        id: Id::unique(("inspector-body", first)),
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
    let summary = texts.get(shape_key(&sheet.primary.shape));
    section(ui, "shape", texts.get("section-shape"), summary, sheet.is_free, |ui| {
        let choices = ShapeKind::ALL.map(|kind| {
            let key = shape_key(&kind.shape());
            ChoiceItem {
                value: kind,
                text: texts.get(key),
                tip: texts.tip(key).unwrap_or_default(),
                is_enabled: true,
            }
        });
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
    });
}

/// The message that names a shape.
pub(super) fn shape_key(shape: &Shape) -> &'static str {
    match shape {
        Shape::Sphere { .. } => "shape-sphere",
        Shape::Cube { .. } => "shape-cube",
        Shape::Cylinder { .. } => "shape-cylinder",
        Shape::Cone { .. } => "shape-cone",
        Shape::Plane => "shape-plane",
    }
}
