//! A card: the picture of a material with its name below.

use std::borrow::Cow;

use catoptric_lab::depth::excess_of;
use catoptric_optics::FraunhoferLines;
use catoptric_scene::{MaterialChoice, Scene};
use egui::{
    Align2, CornerRadius, FontId, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo,
    pos2, vec2,
};
use egui_material_icons::icons::{ICON_CHECK_CIRCLE, ICON_HOURGLASS_EMPTY, ICON_WARNING};

use super::grid::preview;
use super::presets::{MaterialPreset, PRESETS, PresetDescription};
use super::{MaterialBrowser, MaterialItem, list_id};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::number::shown;
use crate::base::widgets::paint_icon;
use crate::state::context::Cx;

/// Side of the picture, points.
pub(super) const PICTURE: f32 = 96.0;
/// The picture with two lines of text.
pub(super) const CARD: Vec2 = vec2(PICTURE, PICTURE + 33.0);
/// The most materials of scenes whose last pictures are remembered.
const MOST_SEEN: usize = 400;
/// Between cards, points.
pub(super) const GAP: f32 = 8.0;

/// Draws the card of a thing, which is at this place among those that were found; returns whether it was clicked.
pub(super) fn card_ui(
    ui: &mut Ui,
    cx: &Cx<'_>,
    browser: &mut MaterialBrowser,
    (thing, place): (MaterialItem, usize),
    rect: Rect,
) -> bool {
    let scene = std::sync::Arc::clone(cx.editor.scene());
    let response = ui.interact(rect, list_id().with(thing), Sense::CLICK);
    let Some(name) = name_of(cx.texts, &scene, thing) else { return false };
    let is_worn = is_worn(cx, &scene, thing);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_worn, name.as_ref()));
    let palette = theme::palette(ui.visuals());
    let is_at = browser.cursor == place && ui.memory(|memory| memory.has_focus(list_id()));
    let fill = match (is_worn, response.hovered()) {
        (true, _) => palette.selection,
        (false, true) => palette.hovered,
        (false, false) => palette.field,
    };
    let painter = ui.painter();
    painter.rect_filled(rect, 6.0, fill);
    let picture = Rect::from_min_size(rect.min, Vec2::splat(PICTURE));
    picture_ui(ui, browser, &scene, thing, picture);
    let text = Rect::from_min_max(picture.left_bottom() + vec2(3.0, 2.0), rect.max - vec2(3.0, 1.0));
    let mut job = egui::text::LayoutJob::simple(
        name.to_string(),
        FontId::proportional(11.5),
        palette.text,
        text.width(),
    );
    job.wrap.max_rows = 2;
    job.halign = egui::Align::Center;
    let galley = painter.layout_job(job);
    painter.galley(pos2(text.center().x, text.center().y - galley.size().y / 2.0), galley, palette.text);
    let corner = picture.right_top() + vec2(-11.0, 11.0);
    if is_worn {
        painter.circle_filled(corner, 8.0, palette.panel);
        paint_icon(ui, ICON_CHECK_CIRCLE, corner, 17.0, palette.accent);
    }
    if thing.material(&scene).is_some_and(|material| excess_of(material).next().is_some()) {
        let corner = picture.left_top() + vec2(11.0, 11.0);
        painter.circle_filled(corner, 9.0, palette.panel);
        paint_icon(ui, ICON_WARNING, corner, 13.0, palette.warning);
    }
    if is_at {
        ui.painter().rect_stroke(rect, 6.0, Stroke::new(1.5, palette.accent), StrokeKind::Outside);
    }
    let is_clicked = response.clicked();
    tip_ui(response, cx, &scene, thing, &name);
    is_clicked
}

/// The picture, or what it was before; an hourglass until there is one.
fn picture_ui(ui: &Ui, browser: &mut MaterialBrowser, scene: &Scene, thing: MaterialItem, rect: Rect) {
    let Some(preview) = preview(ui, scene, thing) else { return };
    let named = match thing {
        MaterialItem::Scene(place) => scene.materials.get(place),
        MaterialItem::Preset(_) => None,
    };
    let mut texture = browser.thumbnails.get(&preview);
    if let Some(named) = named {
        if texture.is_none() {
            texture = browser.seen.get(&named.name).and_then(|before| browser.thumbnails.get(before));
        } else if browser.seen.get(&named.name) != Some(&preview) {
            if browser.seen.len() >= MOST_SEEN {
                browser.seen.clear();
            }
            browser.seen.insert(named.name.clone(), preview);
        }
    }
    match texture {
        Some(texture) => {
            egui::Image::new(texture)
                .corner_radius(CornerRadius { nw: 6, ne: 6, sw: 0, se: 0 })
                .paint_at(ui, rect);
        }
        None => {
            let color = theme::palette(ui.visuals()).weak;
            ui.painter().text(
                rect.center(),
                Align2::CENTER_CENTER,
                ICON_HOURGLASS_EMPTY.codepoint,
                FontId::proportional(20.0),
                color,
            );
        }
    }
}

/// Whether the selected body is made of it.
fn is_worn(cx: &Cx<'_>, scene: &Scene, thing: MaterialItem) -> bool {
    let body = cx.editor.selected_bodies().next_back().and_then(|body| scene.bodies.get(body));
    match (thing, body.map(|body| &body.material)) {
        (MaterialItem::Scene(place), Some(MaterialChoice::Named(name))) => {
            scene.materials.get(place).is_some_and(|named| named.name == *name)
        }
        (MaterialItem::Preset(_), Some(MaterialChoice::Inline(own))) => thing.material(scene) == Some(own),
        _ => false,
    }
}

fn name_of<'a>(texts: &'a Texts, scene: &'a Scene, thing: MaterialItem) -> Option<Cow<'a, str>> {
    match thing {
        MaterialItem::Scene(place) => {
            scene.materials.get(place).map(|named| Cow::Borrowed(named.name.as_str()))
        }
        MaterialItem::Preset(place) => PRESETS.get(place).map(|preset| Cow::Borrowed(texts.get(&preset.key))),
    }
}

/// The tooltip of a material: its name, what it is, and where its numbers come from.
fn tip_ui(response: Response, cx: &Cx<'_>, scene: &Scene, thing: MaterialItem, name: &str) {
    response.on_hover_ui(|ui| {
        ui.set_max_width(320.0);
        ui.strong(name);
        match thing {
            MaterialItem::Scene(place) => {
                let Some(named) = scene.materials.get(place) else { return };
                ui.label(crate::panels::inspector::model_told(cx.texts, named.material.model()));
                let count = scene.bodies.iter().filter(|body| body.uses_material(&named.name)).count();
                ui.label(cx.texts.with("material-used-by", &[("count", count.into())]));
                if excess_of(&named.material).next().is_some() {
                    let color = theme::palette(ui.visuals()).warning;
                    ui.label(egui::RichText::new(cx.texts.get("materials-excess")).color(color));
                }
            }
            MaterialItem::Preset(place) => {
                if let Some(preset) = PRESETS.get(place) {
                    about_ui(ui, cx.texts, preset);
                }
            }
        }
    });
}

fn about_ui(ui: &mut Ui, texts: &Texts, preset: &MaterialPreset) {
    let source = match preset.about {
        PresetDescription::Tip => {
            ui.label(texts.tip(&preset.key).unwrap_or_default());
            return;
        }
        PresetDescription::Metal(metal) => {
            let share = |share: f64| shown(texts, 100.0 * share.min(1.0), 0);
            let [red, green, blue] = metal.reflectance(1.0, 1.0).map(share);
            let shares = [("red", red.into()), ("green", green.into()), ("blue", blue.into())];
            ui.label(texts.with("materials-metal", &shares));
            metal.source
        }
        PresetDescription::Clear(clear) => {
            let index = shown(texts, clear.dispersion.index(FraunhoferLines::D), 3);
            let abbe = shown(texts, clear.dispersion.abbe(), 0);
            ui.label(texts.with("materials-index", &[("index", index.into()), ("abbe", abbe.into())]));
            clear.source
        }
    };
    let color = theme::palette(ui.visuals()).weak;
    ui.label(egui::RichText::new(source).color(color).size(11.5));
}
