//! The command palette: a field to type into, and everything that fits.

mod entries;

use egui::accesskit::Role;
use egui::{Align2, Context, Id, Key, Modal, Modifiers, Rect, ScrollArea, Sense, TextEdit, TextStyle, Ui};
use egui::{WidgetInfo, pos2, vec2};

use crate::base::fuzzy::Query;
use crate::base::theme;
use crate::base::widgets::{paint_icon, paint_line};
use crate::state::command_context::CommandContext;
pub(crate) use entries::{PaletteAction, PaletteItem, all as entries};

/// Height of a row, points.
const ROW: f32 = 28.0;
/// Rows that are visible at once.
const VISIBLE: usize = 12;
/// The most rows a query shows.
const MOST: usize = 200;

/// The palette's state: open or not.
#[derive(Default)]
pub(crate) struct CommandPalette {
    open: Option<OpenPalette>,
}

struct OpenPalette {
    query: String,
    /// What `shown` was found for.
    searched: Option<String>,
    entries: Vec<PaletteItem>,
    /// Places in `entries`, the best first.
    shown: Vec<usize>,
    chosen: usize,
    scrolls: bool,
}

impl CommandPalette {
    /// Opens the palette with everything that can be found in it.
    pub(crate) fn open(&mut self, entries: Vec<PaletteItem>) {
        self.open = Some(OpenPalette {
            query: String::new(),
            searched: None,
            entries,
            shown: Vec::new(),
            chosen: 0,
            scrolls: true,
        });
    }
}

/// Draws the palette if it is open; returns what is chosen in it.
pub(crate) fn palette_ui(
    context: &Context,
    situation: CommandContext<'_>,
    palette: &mut CommandPalette,
) -> Option<PaletteAction> {
    let mut open = palette.open.take()?;
    open.search();
    let done = open.keys(context);
    let width = (context.content_rect().width() - 40.0).min(580.0);
    let area = Modal::default_area(Id::unique("palette"))
        .anchor(Align2::CENTER_TOP, vec2(0.0, 64.0))
        .accessible_name(situation.texts.get("command-palette"));
    let modal = Modal::new(Id::unique("palette")).area(area).show(context, |ui| {
        ui.set_width(width);
        open.field_ui(ui, situation);
        ui.add_space(2.0);
        open.list_ui(ui, situation)
    });
    let chosen = if done { open.shown.get(open.chosen).copied() } else { modal.inner };
    let what = chosen.and_then(|place| open.entries.get(place)).map(|entry| entry.what.clone());
    let what = what.filter(|what| can(situation, what));
    if what.is_none() && !modal.should_close() {
        palette.open = Some(open);
        return None;
    }
    // What is done next must not be taken for typing.
    context.memory_mut(|memory| memory.surrender_focus(field_id()));
    what
}

fn field_id() -> Id {
    Id::unique("palette field")
}

fn can(situation: CommandContext<'_>, what: &PaletteAction) -> bool {
    match what {
        PaletteAction::Run(command) => situation.can(command),
        PaletteAction::Select(item) => situation.editor.edited().contains(*item),
    }
}

impl OpenPalette {
    /// Finds what fits the query, when it has changed.
    fn search(&mut self) {
        if self.searched.as_ref() == Some(&self.query) {
            return;
        }
        let queries = Query::new(&self.query);
        let mut found: Vec<(i32, usize)> = self
            .entries
            .iter()
            .enumerate()
            .filter_map(|(place, entry)| {
                // Names shown have no point within a word, so that one that is typed asks for a stable name.
                let stable_name = entry.stable_name.filter(|_| self.query.contains('.'));
                let names = entry.names.iter().map(String::as_str).chain(stable_name);
                Some((queries.best(names)?, place))
            })
            .collect();
        found.sort_by_key(|&(score, place)| (-score, place));
        found.truncate(MOST);
        self.shown = found.into_iter().map(|(_, place)| place).collect();
        self.chosen = 0;
        self.scrolls = true;
        self.searched = Some(self.query.clone());
    }

    /// Moves the choice; returns whether it is final.
    fn keys(&mut self, context: &Context) -> bool {
        let last = self.shown.len().saturating_sub(1);
        context.input_mut(|input| {
            let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
            let before = self.chosen;
            if pressed(Key::ArrowDown) {
                self.chosen = if self.chosen >= last { 0 } else { self.chosen + 1 };
            }
            if pressed(Key::ArrowUp) {
                self.chosen = self.chosen.checked_sub(1).unwrap_or(last);
            }
            if pressed(Key::PageDown) {
                self.chosen = (self.chosen + VISIBLE).min(last);
            }
            if pressed(Key::PageUp) {
                self.chosen = self.chosen.saturating_sub(VISIBLE);
            }
            self.scrolls |= self.chosen != before;
            pressed(Key::Enter)
        })
    }

    fn field_ui(&mut self, ui: &mut Ui, situation: CommandContext<'_>) {
        let hint = situation.texts.get("palette-hint");
        let field = TextEdit::singleline(&mut self.query)
            .id(field_id())
            .hint_text(hint)
            .font(TextStyle::Heading)
            .margin(egui::Margin::symmetric(8, 6))
            .desired_width(f32::INFINITY);
        let response = ui.add(field).accessible_name(situation.texts.get("command-palette"));
        if !response.has_focus() {
            response.request_focus();
        }
        self.search();
    }

    /// Draws what was found; returns the place of an entry that was clicked.
    fn list_ui(&mut self, ui: &mut Ui, situation: CommandContext<'_>) -> Option<usize> {
        ui.spacing_mut().item_spacing.y = 0.0;
        if self.shown.is_empty() {
            ui.add_space(8.0);
            ui.weak(situation.texts.get("palette-nothing"));
            ui.add_space(8.0);
            return None;
        }
        let rows = VISIBLE.min(((ui.ctx().content_rect().height() - 180.0) / ROW).max(3.0) as usize);
        let height = rows as f32 * ROW;
        let mut clicked = None;
        let mut area =
            ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink([false, true]);
        if std::mem::take(&mut self.scrolls) {
            let seen = egui::scroll_area::State::load(ui.ctx(), ui.make_persistent_id("palette list"));
            let offset = seen.map_or(0.0, |state| state.clamped_offset().y);
            let top = self.chosen as f32 * ROW;
            area = area.vertical_scroll_offset(offset.clamp((top + ROW - height).max(0.0), top));
        }
        area.id_salt("palette list").show_rows(ui, ROW, self.shown.len(), |ui, range| {
            for row in range {
                let Some(&place) = self.shown.get(row) else { continue };
                let Some(entry) = self.entries.get(place) else { continue };
                let response = row_ui(ui, situation, entry, row == self.chosen);
                if response.clicked() {
                    clicked = Some(place);
                }
                if response.hovered() && ui.input(|input| input.pointer.delta() != egui::Vec2::ZERO) {
                    self.chosen = row;
                }
            }
        });
        clicked
    }
}

fn row_ui(
    ui: &mut Ui,
    situation: CommandContext<'_>,
    entry: &PaletteItem,
    is_chosen: bool,
) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::CLICK);
    let is_possible = can(situation, &entry.what);
    response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, is_possible, is_chosen, &entry.name));
    let palette = theme::palette(ui.visuals());
    if is_chosen {
        ui.painter().rect_filled(rect, 4.0, palette.selection);
    }
    let color = if is_possible { palette.text } else { palette.weak };
    paint_icon(ui, entry.icon, pos2(rect.left() + 18.0, rect.center().y), 16.0, palette.weak);
    let small = TextStyle::Small.resolve(ui.style());
    let right = pos2(rect.right() - 10.0, rect.center().y);
    let detail = ui.painter().text(right, Align2::RIGHT_CENTER, &entry.detail, small, palette.weak);
    let text = Rect::from_min_max(rect.min + vec2(38.0, 0.0), pos2(detail.left() - 8.0, rect.bottom()));
    paint_line(ui, text, &entry.name, color);
    match &entry.tip {
        Some(tip) => response.on_hover_text(tip),
        None => response,
    }
}
