//! A part of a joined body: the same values as of a body, within the whole.

use std::sync::Arc;

use catoptric_editor::{Action, Item, PartPath, Selection};
use catoptric_scene::{Body, ScenePart};
use egui::{Button, Id, Sense, Ui, UiBuilder, vec2};
use egui_material_icons::icons::{ICON_ARROW_UPWARD, ICON_LOCK};

use super::header::hint;
use super::sheet::{PropertySheet, SheetPlace};
use super::{InspectorState, body, material, place};
use crate::base::theme;
use crate::base::widgets::number::HEIGHT;
use crate::base::widgets::paint_icon;
use crate::base::widgets::text::text_field;
use crate::base::widgets::tip::tip_beside;
use crate::panels::outliner::{part_role, path_title, shape_icon};
use crate::state::command::Command;
use crate::state::context::Cx;

/// Draws the values of the part that is meant.
pub(super) fn part_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState) {
    let Some((index, path)) = cx.editor.selected_part() else { return };
    let scene = Arc::clone(cx.editor.scene());
    let Some(whole) = scene.bodies.get(index) else { return };
    let (Some(as_body), Some(item)) = (path.as_body(whole), cx.editor.edited().item(ScenePart::Body(index)))
    else {
        return;
    };
    let subject = path_title(cx.texts, cx.editor.edited(), (item, path)).into_owned();
    head_ui(ui, cx, (item, path), &as_body);
    notes_ui(ui, cx, whole, path);
    let mut sheet = PropertySheet {
        primary: &as_body,
        things: vec![&as_body],
        place: SheetPlace { part: ScenePart::Body(index), within: path },
        subject: subject.clone(),
        id: Id::unique(("inspector-part", item, path)),
        is_free: !whole.locked,
        apply: &|editor, label, change| {
            editor.change_body(index, label, |whole| {
                let Some(mut body) = path.as_body(whole) else { return };
                change(0, &mut body);
                if let Some(part) = path.part_mut(whole) {
                    (part.shape, part.placement) = (body.shape, body.placement);
                    (part.parts, part.parametric) = (body.parts, body.parametric);
                }
            })
        },
        cx,
        memory,
    };
    body::shape_ui(ui, &mut sheet);
    place::place_ui(ui, &mut sheet);
    material::of_part_ui(ui, cx, memory, (index, path), &subject);
}

/// The way back to what is around the part, and the field of its name.
fn head_ui(ui: &mut Ui, cx: &mut Cx<'_>, (item, path): (Item, PartPath), part: &Body) {
    let texts = cx.texts;
    let around = path.parent().unwrap_or(PartPath::WHOLE);
    let name = path_title(texts, cx.editor.edited(), (item, around)).into_owned();
    let label = texts.with("part-of", &[("name", name.into())]);
    let button = Button::new((ICON_ARROW_UPWARD.rich_text(), label.as_str())).truncate();
    let back = ui.add(button.min_size(vec2(0.0, HEIGHT))).accessible_name(&label);
    if tip_beside(ui, back, texts.tip("part-of").unwrap_or_default()).clicked() {
        cx.editor.settle();
        cx.editor.select(Selection::of_part(item, around));
    }
    let scope = UiBuilder::new().scope_id(Id::unique(("inspector-name", item, path)));
    ui.scope_builder(scope, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let palette = theme::palette(ui.visuals());
            let (rect, _) = ui.allocate_exact_size(vec2(20.0, HEIGHT), Sense::hover());
            paint_icon(ui, shape_icon(part.body_shape().kind()), rect.center(), 18.0, palette.weak);
            let room = ui.available_width();
            let (response, typed, _) =
                text_field(ui, texts.get("name"), &part.name, texts.get("name-none"), room);
            tip_beside(ui, response, texts.tip("name").unwrap_or_default());
            if let Some(name) = typed {
                cx.run(Command::Edit(Action::RenamePart { whole: item, part: path, name }));
            }
        })
    });
}

/// What the part does in its whole, and what keeps it from being changed.
fn notes_ui(ui: &mut Ui, cx: &Cx<'_>, whole: &Body, path: PartPath) {
    let texts = cx.texts;
    let around = path.parent().and_then(|around| around.form(whole));
    let role = around.zip(path.place()).and_then(|(around, place)| part_role(around.shape, place));
    if let Some(role) = role {
        hint(ui, &format!("{}  {}", role.sign, texts.get(role.key)));
    }
    if around.is_some_and(|around| around.parts.len() == 1) {
        hint(ui, texts.get("part-alone"));
    }
    if whole.locked {
        ui.horizontal_wrapped(|ui| {
            let palette = theme::palette(ui.visuals());
            let (rect, _) = ui.allocate_exact_size(vec2(16.0, HEIGHT), Sense::hover());
            paint_icon(ui, ICON_LOCK, rect.center(), 15.0, palette.warning);
            ui.label(texts.get("part-locked"));
        });
    }
}
