//! Rows for the placement of bodies: position, rotation and scale, or the two ends of their axis.

use catoptric_scene::format::keys;
use catoptric_scene::{Anchor, Body};
use egui::Ui;

use super::reshape;
use super::sheet::{PropertySheet, RowQuantity, Unit, VectorRow, VectorSpread};
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::section::section;

static POSITION: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("position", "edit-position", &keys::BODY, "position").in_unit(Unit::Meters),
    VectorSpread::Offset,
    |body| if let Anchor::Frame { position, .. } = body.placement.anchor { Some(position) } else { None },
    |body, value| {
        if let Anchor::Frame { position, .. } = &mut body.placement.anchor {
            *position = value;
        }
    },
);

static ROTATION: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("rotation", "edit-rotation", &keys::BODY, "rotation").in_unit(Unit::Degrees),
    VectorSpread::Same,
    |body| match body.placement.anchor {
        Anchor::Frame { rotation_degrees, .. } => Some(rotation_degrees),
        Anchor::Axis { .. } => None,
    },
    |body, value| {
        if let Anchor::Frame { rotation_degrees, .. } = &mut body.placement.anchor {
            *rotation_degrees = value;
        }
    },
)
.tuned(0.5, 2);

static BASE: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("base", "edit-base", &keys::BODY, "base").in_unit(Unit::Meters),
    VectorSpread::Offset,
    |body| if let Anchor::Axis { base, .. } = body.placement.anchor { Some(base) } else { None },
    |body, value| {
        if let Anchor::Axis { base, .. } = &mut body.placement.anchor {
            *base = value;
        }
    },
);

static TOP: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("top", "edit-top", &keys::BODY, "top").in_unit(Unit::Meters),
    VectorSpread::Offset,
    |body| if let Anchor::Axis { top, .. } = body.placement.anchor { Some(top) } else { None },
    |body, value| {
        if let Anchor::Axis { top, .. } = &mut body.placement.anchor {
            *top = value;
        }
    },
);

static SCALE: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("scale", "edit-scale", &keys::BODY, "scale"),
    VectorSpread::Same,
    |body| Some(body.placement.scale),
    |body, value| body.placement.scale = value,
)
.linked(|memory| &mut memory.scale_link);

/// Draws the values of the place.
pub(super) fn place_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    let texts = sheet.texts();
    section(ui, "place", texts.get("section-place"), "", sheet.is_free, |ui| {
        if sheet.primary.shape.height().is_some() {
            anchor_ui(ui, sheet);
        }
        sheet.vector(ui, &POSITION);
        sheet.vector(ui, &ROTATION);
        sheet.vector(ui, &BASE);
        sheet.vector(ui, &TOP);
        sheet.vector(ui, &SCALE);
    });
}

/// The choice between the two ways of placing a body that stands on an axis. Neither moves the body.
fn anchor_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    let texts = sheet.texts();
    let can_be_axis = reshape::to_axis(sheet.primary).is_some();
    let axis_tip = if can_be_axis { texts.tip("anchor-axis") } else { texts.tip("anchor-refused") };
    let choices = [
        ChoiceItem {
            value: false,
            text: texts.get("anchor-frame"),
            tip: texts.tip("anchor-frame").unwrap_or_default(),
            is_enabled: true,
        },
        ChoiceItem {
            value: true,
            text: texts.get("anchor-axis"),
            tip: axis_tip.unwrap_or_default(),
            is_enabled: can_be_axis,
        },
    ];
    let is_axis = |body: &Body| matches!(body.placement.anchor, Anchor::Axis { .. });
    let id = sheet.id.with("anchor");
    let width = ui.available_width();
    let chosen = Some(is_axis(sheet.primary));
    match choice_ui(ui, id, texts.get("anchor"), width, &choices, chosen) {
        Some(true) => sheet.change("anchor", "edit-anchor", |_, body| {
            if let Some(placed) = reshape::to_axis(body) {
                *body = placed;
            }
        }),
        Some(false) => sheet.change("anchor", "edit-anchor", |_, body| reshape::to_frame(body)),
        None => {}
    }
    sheet.note(ui, "anchor");
}
