//! The head of the panel: what it is, its name, whether it is hidden or locked.

use catoptric_editor::{Action, EditedScene, Item};
use catoptric_scene::ScenePart;
use egui::{Id, RichText, Sense, Ui, UiBuilder, vec2};
use egui_material_icons::icons::{ICON_LOCK, ICON_LOCK_OPEN, ICON_VISIBILITY, ICON_VISIBILITY_OFF};

use crate::base::theme;
use crate::base::widgets::number::HEIGHT;
use crate::base::widgets::text::text_field;
use crate::base::widgets::tip::tip_beside;
use crate::base::widgets::{explained_icon_button, paint_icon};
use crate::panels::outliner::{item_icon, item_name};
use crate::state::command::Command;
use crate::state::context::Cx;

/// Draws the name field of `item`, with the buttons of what can be hidden and locked.
pub(super) fn header_ui(ui: &mut Ui, cx: &mut Cx<'_>, item: Item) {
    let texts = cx.texts;
    let edited = cx.editor.edited().clone();
    let (is_hidden, is_locked) = (edited.is_hidden(item), edited.is_locked(item));
    let has_toggles = matches!(item, Item::Body(_) | Item::Light(_));
    let mut clash = false;
    // A name that is being typed belongs to this thing, not to the next one that is selected.
    let scope = UiBuilder::new().scope_id(Id::unique(("inspector-name", item)));
    ui.scope_builder(scope, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let palette = theme::palette(ui.visuals());
            let (rect, _) = ui.allocate_exact_size(vec2(20.0, HEIGHT), Sense::hover());
            paint_icon(ui, item_icon(&edited, item), rect.center(), 18.0, palette.weak);
            let room = ui.available_width() - if has_toggles { 2.0 * 26.0 } else { 0.0 };
            let name = edited.name(item);
            let (response, typed, draft) =
                text_field(ui, texts.get("name"), name, texts.get("name-none"), room);
            tip_beside(ui, response, texts.tip("name").unwrap_or_default());
            clash = draft.is_some_and(|draft| is_taken(&edited, item, &draft));
            if let Some(name) = typed {
                cx.run(Command::Edit(Action::Rename { item, name }));
            }
            if has_toggles {
                let icon = if is_hidden { ICON_VISIBILITY_OFF } else { ICON_VISIBILITY };
                let (name, tip) = (texts.get("hidden"), texts.tip("hidden").unwrap_or_default());
                if explained_icon_button(ui, icon, name, tip, is_hidden).clicked() {
                    cx.run(Command::Edit(Action::SetHidden { item, hidden: !is_hidden }));
                }
                let icon = if is_locked { ICON_LOCK } else { ICON_LOCK_OPEN };
                let (name, tip) = (texts.get("locked"), texts.tip("locked").unwrap_or_default());
                if explained_icon_button(ui, icon, name, tip, is_locked).clicked() {
                    cx.run(Command::Edit(Action::SetLocked { item, locked: !is_locked }));
                }
            }
        })
    });
    if clash {
        hint(ui, texts.get("name-taken"));
    }
    if is_hidden {
        hint(ui, texts.get("is-hidden"));
    }
}

/// The selected things of one kind whose values are shown.
pub(super) struct InspectedItems {
    /// The places of the things in their list, that of the primary one first.
    pub(super) indices: Vec<usize>,
    pub(super) first: usize,
    /// The primary thing.
    pub(super) item: Item,
    /// What they are called together.
    pub(super) subject: String,
    /// Whether they can be changed.
    pub(super) is_free: bool,
}

/// Draws the head of the panel for the things of one kind at `selected`, the primary one first: of those that are not
/// locked if there are any, else of all. `several` is the message that counts them.
pub(super) fn chosen_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    kind: fn(usize) -> ScenePart,
    selected: Vec<usize>,
    several: &str,
) -> Option<InspectedItems> {
    let edited = cx.editor.edited().clone();
    let scene = edited.scene();
    let free: Vec<usize> = selected.iter().copied().filter(|&index| !kind(index).is_locked(scene)).collect();
    let (is_free, count, locked) = (!free.is_empty(), selected.len(), selected.len() - free.len());
    let items: Vec<Item> = selected.iter().filter_map(|index| edited.item(kind(*index))).collect();
    let indices = if is_free { free } else { selected };
    let first = *indices.first()?;
    let item = edited.item(kind(first))?;
    let name = item_name(cx.texts, &edited, item);
    let subject = match indices.len() {
        1 => name.clone().into_owned(),
        count => cx.texts.with(several, &[("count", count.into())]),
    };
    if count == 1 {
        header_ui(ui, cx, item);
    } else {
        several_ui(ui, cx, several, count, &name, locked);
    }
    if !is_free {
        locked_ui(ui, cx, &items);
    }
    Some(InspectedItems { indices, first, item, subject, is_free })
}

/// Says that several things are edited together.
fn several_ui(ui: &mut Ui, cx: &Cx<'_>, key: &str, count: usize, name: &str, locked: usize) {
    let texts = cx.texts;
    ui.label(RichText::new(texts.with(key, &[("count", count.into())])).size(15.0));
    hint(ui, &texts.with("several-note", &[("name", name.into())]));
    if locked > 0 {
        hint(ui, &texts.with("several-locked", &[("count", locked.into())]));
    }
}

/// Says that nothing can be changed since everything is locked, and offers to unlock.
fn locked_ui(ui: &mut Ui, cx: &mut Cx<'_>, items: &[Item]) {
    let texts = cx.texts;
    let palette = theme::palette(ui.visuals());
    egui::Frame::new().fill(palette.bar).corner_radius(4.0).inner_margin(6.0).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(16.0, HEIGHT), Sense::hover());
            paint_icon(ui, ICON_LOCK, rect.center(), 15.0, palette.warning);
            ui.label(texts.get("is-locked"));
        });
        let button = egui::Button::new(texts.get("unlock")).min_size(vec2(80.0, HEIGHT));
        let response = ui.add(button).on_hover_text(texts.tip("unlock").unwrap_or_default());
        if response.clicked() {
            for &item in items {
                cx.run(Command::Edit(Action::SetLocked { item, locked: false }));
            }
        }
    });
}

/// A line of less weight.
pub(super) fn hint(ui: &mut Ui, text: &str) {
    let palette = theme::palette(ui.visuals());
    ui.add(egui::Label::new(RichText::new(text).color(palette.weak).size(12.0)).wrap());
}

fn is_taken(edited: &EditedScene, item: Item, name: &str) -> bool {
    let scene = edited.scene();
    let is_other = |place: usize, own: usize, other: &str| place != own && !name.is_empty() && other == name;
    match edited.part(item) {
        Some(ScenePart::Body(own)) => {
            scene.bodies.iter().enumerate().any(|(at, body)| is_other(at, own, &body.name))
        }
        Some(ScenePart::Light(own)) => {
            scene.lights.iter().enumerate().any(|(at, light)| is_other(at, own, &light.name))
        }
        Some(ScenePart::Material(own)) => {
            scene.materials.iter().enumerate().any(|(at, named)| is_other(at, own, &named.name))
        }
        _ => false,
    }
}
