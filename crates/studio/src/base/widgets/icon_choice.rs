//! A choice of many things by icon and name: a list that opens as a grid under heads.

use std::ops::Range;

use egui::{
    Atoms, ComboBox, EventFilter, FontId, Id, IntoAtoms as _, Key, Modifiers, Rect, Response, Role, Sense,
    Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};
use egui_material_icons::MaterialIcon;

use crate::base::theme;
use crate::base::widgets::number::MIXED;
use crate::base::widgets::tip::tip_beside_entry;
use crate::base::widgets::{paint_icon, paint_line_in, text_width};

/// The columns of the grid.
const COLUMNS: usize = 2;

/// The heights of a cell and of a head, points.
const CELL: f32 = 26.0;
const HEAD: f32 = 22.0;

/// What a cell has beside its text: the icon and the margins, points.
const BESIDE_TEXT: f32 = 42.0;

/// One thing to choose.
pub(crate) struct IconChoiceItem<'a, V> {
    /// What it stands for.
    pub(crate) value: V,
    pub(crate) icon: MaterialIcon,
    pub(crate) text: &'a str,
    /// What it means.
    pub(crate) tip: &'a str,
}

/// Things under a head.
pub(crate) struct IconChoiceGroup<'a, V> {
    pub(crate) head: &'a str,
    pub(crate) items: Vec<IconChoiceItem<'a, V>>,
}

/// Draws the choice called `name`, so wide, with the thing that is chosen; `None` where several are. Returns the one
/// that is chosen instead, by a click or by keys.
pub(crate) fn icon_choice_ui<V: Copy + PartialEq>(
    ui: &mut Ui,
    id: Id,
    (name, width): (&str, f32),
    groups: &[IconChoiceGroup<'_, V>],
    chosen: Option<V>,
) -> Option<V> {
    let items = || groups.iter().flat_map(|group| &group.items);
    let place = items().position(|item| Some(item.value) == chosen);
    let item = place.and_then(|place| items().nth(place));
    let text = item.map_or(MIXED, |item| item.text);
    let atoms: Atoms<'_> =
        item.map_or_else(|| MIXED.into_atoms(), |item| (item.icon.rich_text().size(16.0), text).into_atoms());
    let list_id = ui.make_persistent_id(id);
    let room = ui.ctx().content_rect().height() - 40.0;
    let list = ComboBox::from_id_salt(id).selected_text(atoms).width(width - 8.0).height(room);
    let shown = list.show_ui(ui, |ui| IconGrid::new(ui, id, name, groups, place).ui(ui, groups));
    let (picked, is_left) = shown.inner.unwrap_or_default();
    let is_open = ComboBox::is_open(ui.ctx(), list_id);
    let response = shown.response.accessible_name(name);
    ui.ctx().accesskit_node_builder(response.id, |node| {
        // Without the sign of the icon.
        node.set_value(text);
        node.set_expanded(is_open);
    });
    let is_keyed = |key| ui.input(|input| input.key_pressed(key));
    if is_left || picked.is_some() && [Key::Enter, Key::Space].into_iter().any(is_keyed) {
        response.request_focus();
    }
    picked.filter(|picked| Some(*picked) != chosen)
}

/// The open grid.
struct IconGrid<'a> {
    id: Id,
    /// What is chosen here, for those who do not see it.
    name: &'a str,
    /// How many things there are, and the one that is chosen.
    count: usize,
    chosen: Option<usize>,
    /// The things of each row.
    rows: Vec<Range<usize>>,
    /// The width of a cell, points.
    width: f32,
}

impl<'a> IconGrid<'a> {
    fn new<V>(
        ui: &Ui,
        id: Id,
        name: &'a str,
        groups: &[IconChoiceGroup<'_, V>],
        chosen: Option<usize>,
    ) -> Self {
        let texts =
            groups.iter().flat_map(|group| &group.items).map(|item| text_width(ui, item.text, &font()));
        let widest = texts.fold(0.0, f32::max) + BESIDE_TEXT;
        let width = widest.max((ui.available_width() / COLUMNS as f32).floor());
        let mut rows = Vec::new();
        let mut start = 0;
        for group in groups {
            let end = start + group.items.len();
            while start < end {
                let next = (start + COLUMNS).min(end);
                rows.push(start..next);
                start = next;
            }
        }
        Self { id, name, count: start, chosen, rows, width }
    }

    fn cell_id(&self, place: usize) -> Id {
        self.id.with(("cell", place))
    }

    /// Draws the grid; returns what was chosen, and whether the keys have left it.
    fn ui<V: Copy>(&self, ui: &mut Ui, groups: &[IconChoiceGroup<'_, V>]) -> (Option<V>, bool) {
        ui.spacing_mut().item_spacing = vec2(0.0, 0.0);
        ui.set_width(COLUMNS as f32 * self.width);
        let (moved, is_left) = self.keys(ui);
        let mut picked = None;
        let mut rows = self.rows.iter();
        let mut items = groups.iter().flat_map(|group| &group.items);
        for group in groups {
            self.head_ui(ui, group.head);
            for row in rows.by_ref().take(group.items.len().div_ceil(COLUMNS)) {
                let size = vec2(COLUMNS as f32 * self.width, CELL);
                let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
                for ((column, place), item) in row.clone().enumerate().zip(items.by_ref()) {
                    let left = whole.left() + column as f32 * self.width;
                    let rect = Rect::from_min_size(pos2(left, whole.top()), vec2(self.width, CELL));
                    let response = self.cell_ui(ui, place, rect, item);
                    if moved == Some(place) {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() {
                        picked = Some(item.value);
                        // A click closes the list by itself, a key does not.
                        ui.close();
                    }
                }
            }
        }
        (picked, is_left)
    }

    /// Arrows walk over the cells, and Esc closes; returns the one that has got the keys, and whether it was closed so.
    fn keys(&self, ui: &Ui) -> (Option<usize>, bool) {
        let place = (0..self.count).find(|place| ui.memory(|memory| memory.has_focus(self.cell_id(*place))));
        let next = match place {
            Some(place) => self.walked(ui, place),
            // It has just been opened.
            None if self.is_new(ui) => self.chosen.or(Some(0)),
            None => None,
        };
        if place.is_some() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            ui.close();
            return (None, true);
        }
        if let Some(kept) = next.or(place) {
            let filter =
                EventFilter { tab: false, horizontal_arrows: true, vertical_arrows: true, escape: true };
            ui.memory_mut(|memory| {
                memory.request_focus(self.cell_id(kept));
                memory.set_focus_lock_filter(self.cell_id(kept), filter);
            });
        }
        (next, false)
    }

    /// Whether the grid was not seen in the pass before.
    fn is_new(&self, ui: &Ui) -> bool {
        if ui.is_sizing_pass() {
            return false;
        }
        let pass = ui.ctx().cumulative_pass_nr();
        let before = ui.data_mut(|data| {
            let before = data.get_temp::<u64>(self.id);
            data.insert_temp(self.id, pass);
            before
        });
        before.is_none_or(|before| before + 1 < pass)
    }

    /// Where an arrow leads from a cell.
    fn walked(&self, ui: &Ui, place: usize) -> Option<usize> {
        let _ = self.is_new(ui);
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let row = self.rows.iter().position(|row| row.contains(&place))?;
        let column = place - self.rows.get(row)?.start;
        let in_row = |row: Option<&Range<usize>>| row.map(|row| (row.start + column).min(row.end - 1));
        let last = self.count.checked_sub(1)?;
        if pressed(Key::ArrowLeft) {
            place.checked_sub(1)
        } else if pressed(Key::ArrowRight) {
            Some((place + 1).min(last))
        } else if pressed(Key::ArrowUp) {
            in_row(row.checked_sub(1).and_then(|row| self.rows.get(row)))
        } else if pressed(Key::ArrowDown) {
            in_row(self.rows.get(row + 1))
        } else if pressed(Key::Home) {
            Some(0)
        } else if pressed(Key::End) {
            Some(last)
        } else {
            None
        }
    }

    fn head_ui(&self, ui: &mut Ui, head: &str) {
        let (rect, response) =
            ui.allocate_exact_size(vec2(COLUMNS as f32 * self.width, HEAD), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, head));
        let color = theme::palette(ui.visuals()).accent;
        paint_line_in(ui, rect.shrink2(vec2(8.0, 0.0)), head, FontId::proportional(12.0), color);
    }

    fn cell_ui<V>(&self, ui: &Ui, place: usize, rect: Rect, item: &IconChoiceItem<'_, V>) -> Response {
        let palette = theme::palette(ui.visuals());
        let is_chosen = self.chosen == Some(place);
        let response = ui.interact(rect, self.cell_id(place), Sense::click());
        let inside = rect.shrink(1.0);
        if is_chosen {
            ui.painter().rect_filled(inside, 3.0, palette.selection);
        } else if response.hovered() {
            ui.painter().rect_filled(inside, 3.0, palette.hovered);
        }
        if response.has_focus() {
            let ring = Stroke::new(1.0, palette.accent);
            ui.painter().rect_stroke(inside, 3.0, ring, StrokeKind::Inside);
        }
        let icon = pos2(rect.left() + 18.0, rect.center().y);
        paint_icon(ui, item.icon, icon, 17.0, palette.text);
        let text = rect.with_min_x(rect.left() + 34.0).with_max_x(rect.right() - 4.0);
        paint_line_in(ui, text, item.text, font(), palette.text);
        let label = format!("{}: {}", self.name, item.text);
        response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, is_chosen, &label));
        tip_beside_entry(response, item.tip)
    }
}

fn font() -> FontId {
    FontId::proportional(13.0)
}
