//! The pictures under their headings, and the keys that walk over them.

use std::ops::Range;
use std::sync::Arc;

use catoptric_scene::Scene;
use egui::{
    Align2, EventFilter, FontId, Key, Modifiers, Pos2, Rangef, Rect, Role, ScrollArea, Sense, Ui, WidgetInfo,
    pos2, vec2,
};

use super::card::{CARD, GAP, card_ui};
use super::preview::MaterialPreview;
use super::{MaterialBrowser, MaterialItem, MaterialSection, list_id};
use crate::base::theme;
use crate::base::widgets::paint_line_in;
use crate::state::command::WindowCommand;
use crate::state::context::Cx;
use crate::state::layout::Pane;

/// Height of a heading, points.
const HEAD: f32 = 24.0;

/// A line of the list.
struct BrowserLine {
    top: f32,
    kind: BrowserLineKind,
}

enum BrowserLineKind {
    Head(MaterialSection),
    /// There is none in the scene.
    Nothing,
    /// The cards of a range of materials.
    Cards(Range<usize>),
}

impl BrowserLine {
    fn height(&self) -> f32 {
        match self.kind {
            BrowserLineKind::Head(_) | BrowserLineKind::Nothing => HEAD,
            BrowserLineKind::Cards(_) => CARD.y + GAP,
        }
    }

    /// From where to where it reaches.
    fn span(&self) -> Rangef {
        Rangef::new(self.top, self.top + self.height())
    }
}

/// Draws what was found; returns what was chosen.
pub(super) fn grid_ui(ui: &mut Ui, cx: &mut Cx<'_>, browser: &mut MaterialBrowser) -> Option<MaterialItem> {
    let things = browser.found.as_ref().map(|found| found.things.clone()).unwrap_or_default();
    let rect = ui.available_rect_before_wrap();
    focus(ui, cx, browser, rect);
    // The scroll bar lies over the right edge.
    let room = ui.available_width() - 10.0;
    let columns = (((room + GAP) / (CARD.x + GAP)).floor() as usize).max(1);
    let lines = lines(&things, columns, browser.filter.trim().is_empty());
    let mut chosen = None;
    if ui.memory(|memory| memory.has_focus(list_id())) && keys(ui, cx, browser, &lines) {
        chosen = things.get(browser.cursor).copied();
    }
    if things.is_empty() {
        let font = FontId::proportional(13.5);
        let color = theme::palette(ui.visuals()).weak;
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, cx.t("materials-none"), font, color);
        return None;
    }
    let height = lines.last().map_or(0.0, |line| line.top + line.height());
    let mut drawn = Vec::new();
    ScrollArea::vertical().id_salt("materials").auto_shrink(false).show_viewport(ui, |ui, view| {
        ui.set_height(height);
        let corner = ui.max_rect().left_top();
        if std::mem::take(&mut browser.scrolls)
            && let Some(place) = place_of(&lines, columns, browser.cursor)
        {
            ui.scroll_to_rect(Rect::from_min_size(corner + place.to_vec2(), CARD), None);
        }
        for line in lines.iter().filter(|line| view.y_range().intersects(line.span())) {
            let left_top = corner + vec2(0.0, line.top);
            match &line.kind {
                BrowserLineKind::Head(section) => head_ui(ui, cx, left_top, room, *section),
                BrowserLineKind::Nothing => note_ui(ui, cx, left_top, room),
                BrowserLineKind::Cards(range) => {
                    for (column, place) in range.clone().enumerate() {
                        let Some(thing) = things.get(place).copied() else { continue };
                        let rect =
                            Rect::from_min_size(left_top + vec2(column as f32 * (CARD.x + GAP), 0.0), CARD);
                        drawn.push(thing);
                        if card_ui(ui, cx, browser, (thing, place), rect) {
                            (browser.cursor, browser.wants_focus) = (place, true);
                            chosen = Some(thing);
                        }
                    }
                }
            }
        }
    });
    want(ui, cx, browser, &drawn);
    chosen
}

/// The headings and rows of what was found; the scene's heading stands there even without materials, unless something
/// is looked for.
fn lines(things: &[MaterialItem], columns: usize, is_all: bool) -> Vec<BrowserLine> {
    let mut lines: Vec<BrowserLine> = Vec::new();
    let mut top = 0.0;
    let mut push = |kind| {
        let line = BrowserLine { top, kind };
        top += line.height();
        lines.push(line);
    };
    let mut start = 0;
    for section in MaterialSection::ALL {
        let count = things.iter().skip(start).take_while(|thing| thing.section() == section).count();
        let end = start + count;
        if count > 0 || section == MaterialSection::Scene && is_all {
            push(BrowserLineKind::Head(section));
        }
        if count == 0 && section == MaterialSection::Scene && is_all {
            push(BrowserLineKind::Nothing);
        }
        while start < end {
            let next = (start + columns).min(end);
            push(BrowserLineKind::Cards(start..next));
            start = next;
        }
    }
    lines
}

/// Where the card of the thing at a place begins.
fn place_of(lines: &[BrowserLine], columns: usize, place: usize) -> Option<Pos2> {
    let line = lines
        .iter()
        .find(|line| matches!(&line.kind, BrowserLineKind::Cards(range) if range.contains(&place)))?;
    let BrowserLineKind::Cards(range) = &line.kind else { return None };
    let column = (place - range.start).min(columns);
    Some(pos2(column as f32 * (CARD.x + GAP), line.top))
}

/// Lets the list have the focus as a whole: arrows walk over the cards, and Tab passes them in one step.
fn focus(ui: &mut Ui, cx: &Cx<'_>, browser: &mut MaterialBrowser, rect: Rect) {
    let list = ui.interact(rect, list_id(), Sense::focusable_noninteractive());
    list.widget_info(|| WidgetInfo::labeled(Role::ListBox, true, cx.texts.get("materials-list")));
    if std::mem::take(&mut browser.wants_focus) {
        list.request_focus();
    }
    if list.has_focus() {
        let filter = EventFilter { tab: false, horizontal_arrows: true, vertical_arrows: true, escape: true };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(list_id(), filter));
    }
}

/// Arrows walk over the cards, Escape closes; whether Enter or Space chose the one they have come to.
fn keys(ui: &Ui, cx: &mut Cx<'_>, browser: &mut MaterialBrowser, lines: &[BrowserLine]) -> bool {
    if egui::Popup::is_any_open(ui.ctx()) {
        return false;
    }
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let before = browser.cursor;
    let rows: Vec<&Range<usize>> = lines
        .iter()
        .filter_map(|line| if let BrowserLineKind::Cards(range) = &line.kind { Some(range) } else { None })
        .collect();
    let row = rows.iter().position(|range| range.contains(&before));
    let beside = |row: Option<usize>| {
        let here = rows.iter().find(|range| range.contains(&before))?;
        let there = rows.get(row?)?;
        Some((there.start + before - here.start).min(there.end.saturating_sub(1)))
    };
    let last = rows.last().map_or(0, |range| range.end.saturating_sub(1));
    if pressed(Key::ArrowLeft) {
        browser.cursor = before.saturating_sub(1);
    }
    if pressed(Key::ArrowRight) {
        browser.cursor = (before + 1).min(last);
    }
    if pressed(Key::ArrowUp) {
        browser.cursor = beside(row.and_then(|row| row.checked_sub(1))).unwrap_or(before);
    }
    if pressed(Key::ArrowDown) {
        browser.cursor = beside(row.map(|row| row + 1)).unwrap_or(before);
    }
    browser.scrolls |= browser.cursor != before;
    if pressed(Key::Escape) {
        ui.memory_mut(|memory| memory.surrender_focus(list_id()));
        cx.run(WindowCommand::TogglePane(Pane::Materials));
    }
    let enter = pressed(Key::Enter);
    pressed(Key::Space) || enter
}

fn head_ui(ui: &mut Ui, cx: &Cx<'_>, left_top: Pos2, width: f32, section: MaterialSection) {
    let rect = Rect::from_min_size(left_top, vec2(width, HEAD));
    let title = cx.texts.get(section.key());
    let response = ui.interact(rect, list_id().with(section.key()), Sense::empty());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, title));
    paint_line_in(ui, rect, title, FontId::proportional(13.5), theme::palette(ui.visuals()).accent);
}

fn note_ui(ui: &Ui, cx: &Cx<'_>, left_top: Pos2, width: f32) {
    let rect = Rect::from_min_size(left_top, vec2(width, HEAD));
    let color = theme::palette(ui.visuals()).weak;
    paint_line_in(ui, rect, cx.t("materials-scene-none"), FontId::proportional(12.5), color);
}

/// Has the pictures traced that are seen and missing.
fn want(ui: &Ui, cx: &Cx<'_>, browser: &mut MaterialBrowser, drawn: &[MaterialItem]) {
    if cx.view.is_measuring || cx.view.is_moving {
        return;
    }
    let scene = Arc::clone(cx.editor.scene());
    let wanted: Vec<MaterialPreview> = drawn.iter().filter_map(|thing| preview(ui, &scene, *thing)).collect();
    browser.thumbnails.want(ui.ctx(), &wanted, |preview| Some((preview.scene()?, preview.settings())));
}

/// A thing as it is to be seen on this screen.
pub(super) fn preview(ui: &Ui, scene: &Scene, thing: MaterialItem) -> Option<MaterialPreview> {
    let material = Box::new(thing.material(scene)?.clone());
    let side = (super::card::PICTURE * ui.ctx().pixels_per_point()).round();
    Some(MaterialPreview { material, side: side.clamp(48.0, 256.0) as u32 })
}
