//! Bodies: their shape and sizes. Place and material have files of their own.

use std::sync::Arc;

use catoptric_scene::format::keys;
use catoptric_scene::{Body, BodyContact, DishProfile, Scene, ScenePart, Shadow, ShapeKind, VisibleSide};
use egui::{Id, Ui};

use super::sheet::{NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread};
use super::{InspectorState, header, material, part, parts, place, reshape};
use crate::base::shapes::{ShapeGroup, shape_choice};
use crate::base::texts::Texts;
use crate::base::widgets::icon_choice::{IconChoiceGroup, IconChoiceItem, icon_choice_ui};
use crate::base::widgets::section::section;
use crate::panels::outliner::shape_icon;
use crate::state::context::Cx;

/// The row of a length of a shape, by its message, that of its edit, and its key in scene files.
macro_rules! length_row {
    ($name:literal, $edit:literal, $key:literal) => {
        NumberRow::<Body>::new(
            RowQuantity::new($name, $edit, &keys::BODY, $key).in_unit(Unit::Meters),
            SliderRail::None,
            |body| body.body_shape().shown_number($key),
            |body, value| body.change_shape(|shape| shape.set_number($key, value)),
        )
    };
}

/// The row of a corner of a triangle, by its message and its key in scene files.
macro_rules! corner_row {
    ($name:literal, $key:literal) => {
        VectorRow::<Body>::new(
            RowQuantity::new($name, "edit-corner", &keys::BODY, $key).in_unit(Unit::Meters),
            VectorSpread::Same,
            |body| body.body_shape().vector($key),
            |body, value| body.change_shape(|shape| shape.set_vector($key, value)),
        )
    };
}

static RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.body_shape().number("radius").filter(|_| body.body_shape().number("top_radius").is_none()),
    |body, value| {
        if body.body_shape().number("top_radius").is_none() {
            body.change_shape(|shape| shape.set_number("radius", value));
        }
    },
);

static BASE_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("base-radius", "edit-radius", &keys::BODY, "radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.body_shape().number("radius").filter(|_| body.body_shape().number("top_radius").is_some()),
    |body, value| {
        if body.body_shape().number("top_radius").is_some() {
            body.change_shape(|shape| shape.set_number("radius", value));
        }
    },
);

static TOP_RADIUS: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("top-radius", "edit-top-radius", &keys::BODY, "top_radius").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.body_shape().number("top_radius"),
    |body, value| body.change_shape(|shape| shape.set_number("top_radius", value)),
);

static HEIGHT: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("height", "edit-height", &keys::BODY, "height").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.height().or_else(|| body.body_shape().shown_number("height")),
    reshape::set_height,
);

static FOCAL_LENGTH: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("focal-length", "edit-focal-length", &keys::BODY, "focal_length").in_unit(Unit::Meters),
    SliderRail::None,
    |body| body.sized_shape().focal_length().or_else(|| body.body_shape().shown_number("focal_length")),
    reshape::set_focal_length,
);

static SIDES: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("sides", "edit-sides", &keys::BODY, "sides"),
    SliderRail::None,
    |body| body.body_shape().shown_number("sides"),
    |body, value| body.change_shape(|shape| shape.set_number("sides", value)),
)
.tuned(0.05, 0);

static INNER_RADIUS: NumberRow<Body> = length_row!("inner-radius", "edit-inner-radius", "inner_radius");

static THICKNESS: NumberRow<Body> = length_row!("thickness", "edit-thickness", "thickness");

static LENS_IOR: NumberRow<Body> = NumberRow::<Body>::new(
    RowQuantity::new("lens-ior", "edit-lens-ior", &keys::BODY, "ior"),
    SliderRail::None,
    |body| body.body_shape().shown_number("ior"),
    |body, value| body.change_shape(|shape| shape.set_number("ior", value)),
);

static CURVATURE_RADIUS: NumberRow<Body> =
    length_row!("curvature-radius", "edit-curvature-radius", "curvature_radius");

static FRONT_RADIUS: NumberRow<Body> = length_row!("front-radius", "edit-front-radius", "front_radius");

static BACK_RADIUS: NumberRow<Body> = length_row!("back-radius", "edit-back-radius", "back_radius");

static SIZE: VectorRow<Body> = VectorRow::<Body>::new(
    RowQuantity::new("size", "edit-size", &keys::BODY, "size").in_unit(Unit::Meters),
    VectorSpread::Same,
    |body| body.body_shape().vector("size"),
    |body, value| body.change_shape(|shape| shape.set_vector("size", value)),
)
.linked(|memory| &mut memory.size_link);

static WIDTH: NumberRow<Body> = length_row!("width", "edit-width", "width");

static LENGTH: NumberRow<Body> = length_row!("length", "edit-length", "length");

static CORNERS: [VectorRow<Body>; 3] =
    [corner_row!("corner-a", "a"), corner_row!("corner-b", "b"), corner_row!("corner-c", "c")];

/// Draws the values of the selected bodies.
pub(super) fn bodies_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    if cx.editor.selected_part().is_some() {
        return part::part_ui(ui, cx, memory);
    }
    let scene = Arc::clone(cx.editor.scene());
    let selected = cx.editor.selected_bodies().rev().collect();
    let chosen = header::chosen_ui(ui, cx, ScenePart::Body, selected, "several-bodies");
    let Some(header::InspectedItems { indices, first, item, subject, is_free }) = chosen else { return };
    let Some(primary) = scene.bodies.get(first) else { return };
    let mut sheet = PropertySheet {
        primary,
        things: indices.iter().filter_map(|&index| scene.bodies.get(index)).collect(),
        place: ScenePart::Body(first).into(),
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

pub(super) fn shape_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    let texts = sheet.texts();
    let kind = sheet.primary.body_shape().kind();
    let summary = texts.get(shape_choice(kind));
    let original = sheet.primary.instance.as_ref().map(|instance| instance.of.clone());
    let is_own = sheet.things.iter().all(|body| body.instance.is_none());
    section(ui, "shape", texts.get("section-shape"), summary, sheet.is_free && is_own, |ui| {
        if let Some(original) = original {
            header::hint(ui, &texts.with("instance-hint", &[("body", original.into())]));
        }
        let groups = shape_groups(texts, kind.is_compound());
        let is_mixed = sheet.things.iter().any(|body| body.body_shape().kind() != kind);
        let chosen = (!is_mixed).then_some(kind);
        let id = sheet.id.with("shape");
        let named = (texts.get("section-shape"), ui.available_width());
        if let Some(kind) = icon_choice_ui(ui, id, named, &groups, chosen) {
            sheet.change("shape", "edit-shape", |_, body| reshape::reshape(body, kind));
        }
        sheet.note(ui, "shape");
        let chosen = Some(kind.key());
        sheet.vector(ui, &SIZE);
        for corner in &CORNERS {
            sheet.vector(ui, corner);
        }
        for row in
            [&WIDTH, &LENGTH, &SIDES, &RADIUS, &BASE_RADIUS, &TOP_RADIUS, &INNER_RADIUS, &THICKNESS, &HEIGHT]
        {
            sheet.number(ui, row, chosen);
        }
        word_ui(
            ui,
            sheet,
            "profile",
            ["profile", "edit-profile"],
            &[
                (DishProfile::Parabolic.key(), "profile-parabolic"),
                (DishProfile::Spherical.key(), "profile-spherical"),
            ],
        );
        for row in [&FRONT_RADIUS, &BACK_RADIUS, &FOCAL_LENGTH, &LENS_IOR, &CURVATURE_RADIUS] {
            sheet.number(ui, row, chosen);
        }
        word_ui(
            ui,
            sheet,
            "visible_side",
            ["visible-side", "edit-visible-side"],
            &[
                (VisibleSide::Both.key(), "visible-side-both"),
                (VisibleSide::Outer.key(), "visible-side-outer"),
                (VisibleSide::Inner.key(), "visible-side-inner"),
            ],
        );
        shadow_ui(ui, sheet);
        contact_ui(ui, sheet);
        if kind.is_compound() && is_own && sheet.things.len() == 1 {
            parts::parts_ui(ui, texts, &sheet.primary.parts);
        }
    });
}

/// The shapes that a body can have instead of its own, by groups.
fn shape_groups(texts: &Texts, is_compound: bool) -> Vec<IconChoiceGroup<'_, ShapeKind>> {
    let item = |kind| {
        let key = shape_choice(kind);
        let (text, tip) = (texts.get(key), texts.tip(key).unwrap_or_default());
        IconChoiceItem { value: kind, icon: shape_icon(kind), text, tip }
    };
    let groups = if is_compound { [ShapeGroup::Joined].as_slice() } else { &ShapeGroup::ADDED };
    let groups = groups.iter();
    groups
        .map(|group| IconChoiceGroup {
            head: texts.get(group.key()),
            items: group.shapes().map(item).collect(),
        })
        .collect()
}

/// What the bodies leave of light on its way to others; parts do as the whole.
fn shadow_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    if !sheet.place.within.is_whole() {
        return;
    }
    let choices =
        [(Shadow::Filtered, "shadow-filtered"), (Shadow::None, "shadow-none"), (Shadow::Full, "shadow-full")];
    let own = sheet.primary.shadow;
    let is_mixed = sheet.things.iter().any(|body| body.shadow != own);
    if let Some(shadow) = sheet.choice(ui, "shadow", &choices, (!is_mixed).then_some(own)) {
        sheet.change("shadow", "edit-shadow", |_, body| body.shadow = shadow);
    }
}

/// In scenes of more bodies the choice of contact is offered without looking for what touches the body.
const MOST_LOOKED_AT: usize = 1000;

/// Whether it may make a difference what lies between a body and others.
fn may_touch(scene: &Scene, place: ScenePart) -> bool {
    let ScenePart::Body(index) = place else { return false };
    scene.bodies.len() > MOST_LOOKED_AT || scene.contacts_of(index).next().is_some()
}

/// What lies between the bodies and others, offered where clear bodies may touch; parts do as the whole.
fn contact_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Body>) {
    let own = sheet.primary.contact;
    let is_offered = own != BodyContact::Scene || may_touch(sheet.cx.editor.scene(), sheet.place.part);
    if !sheet.place.within.is_whole() || !is_offered {
        return;
    }
    let choices = [
        (BodyContact::Scene, "contact-scene"),
        (BodyContact::Air, "contact-air"),
        (BodyContact::Cemented, "contact-cemented"),
    ];
    let is_mixed = sheet.things.iter().any(|body| body.contact != own);
    if let Some(contact) = sheet.choice(ui, "contact", &choices, (!is_mixed).then_some(own)) {
        sheet.change("contact", "edit-contact", |_, body| body.contact = contact);
    }
}

/// The choice of a word of the shape, if it has it: `key`, with its label, the label of the change, and the words with
/// their texts.
fn word_ui(
    ui: &mut Ui,
    sheet: &mut PropertySheet<'_, '_, Body>,
    key: &'static str,
    [label, edit]: [&'static str; 2],
    words: &[(&'static str, &'static str)],
) {
    let Some(chosen) = sheet.primary.body_shape().word(key) else { return };
    let is_mixed = sheet.things.iter().any(|body| body.body_shape().word(key) != Some(chosen));
    if let Some(word) = sheet.choice(ui, label, words, (!is_mixed).then_some(chosen)) {
        sheet.change(label, edit, |_, body| body.change_shape(|shape| shape.set_word(key, word)));
    }
}
