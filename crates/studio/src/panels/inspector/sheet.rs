//! A sheet of values: the rows of one kind of thing, read from all that are selected and written to all of them.

use catoptric_editor::{Editor, Label, PartPath, RefusedChange};
use catoptric_scene::format::spec::{KeySpec, Limits, TableSpec};
use catoptric_scene::{Color, ScenePart};
use egui::{Id, Ui};
use glam::DVec3;

use crate::base::texts::Texts;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
pub(crate) use crate::base::widgets::number::Unit;
use crate::base::widgets::number::{NumberField, NumberResponse, exact, limits_in_words, tidy};
use crate::base::widgets::row::{GAP, RowLabel, control_width, reset_button, row};
use crate::base::widgets::tip::tip_beside;
use crate::base::{theme, typeset};
use crate::panels::inspector::symbol::Symbol;
use crate::panels::inspector::{InspectorState, RefusalNote};
use crate::state::context::Cx;
use crate::state::refusal;

mod color;
mod menu;
mod number;
mod vector;

pub(crate) use color::ColorRow;
pub(crate) use number::{NumberRow, SliderRail};
pub(crate) use vector::{StartVectors, VectorRow, VectorSpread};

/// Applies a change to all things of a sheet; the function gets the place of each in the sheet.
pub(crate) type ApplyToAll<'s, T> =
    dyn Fn(&mut Editor, Label, &mut dyn FnMut(usize, &mut T)) -> Result<bool, RefusedChange> + 's;

/// The quantity that a row shows: its message, key, unit and symbol.
#[derive(Clone, Copy)]
pub(crate) struct RowQuantity {
    /// The message that names it; its attribute `.tip` explains it.
    pub(crate) key: &'static str,
    /// The message that names its change in the history.
    pub(crate) edit: &'static str,
    /// Where the format says what it can be.
    pub(crate) table: &'static TableSpec,
    /// The key in that table.
    pub(crate) name: &'static str,
    /// What it is measured in.
    pub(crate) unit: Unit,
    /// The symbol in the model.
    pub(crate) symbol: Option<Symbol>,
}

impl RowQuantity {
    /// A quantity of a table of the format.
    pub(crate) const fn new(
        key: &'static str,
        edit: &'static str,
        table: &'static TableSpec,
        name: &'static str,
    ) -> Self {
        Self { key, edit, table, name, unit: Unit::None, symbol: None }
    }

    /// Sets the unit.
    pub(crate) const fn in_unit(mut self, unit: Unit) -> Self {
        self.unit = unit;
        self
    }

    /// Sets the symbol.
    pub(crate) const fn with_symbol(mut self, symbol: Symbol) -> Self {
        self.symbol = Some(symbol);
        self
    }

    pub(crate) fn spec(&self) -> Option<&'static KeySpec> {
        self.table.key(self.name)
    }

    pub(crate) fn limits(&self) -> Limits {
        let all = Limits::new(f64::MIN, f64::MAX);
        self.spec().and_then(KeySpec::limits).unwrap_or(all)
    }

    fn markup(&self) -> &'static str {
        self.symbol.map_or("", Symbol::markup)
    }

    /// What the row is called.
    pub(crate) fn label(&self, texts: &Texts) -> String {
        typeset::named(self.markup(), texts.get(self.key))
    }
}

/// Where the scene has what a sheet shows.
#[derive(Clone, Copy)]
pub(crate) struct SheetPlace {
    /// The part of the scene, or that around it.
    pub(crate) part: ScenePart,
    /// The way to the part of a joined body, if that is shown.
    pub(crate) within: PartPath,
}

impl From<ScenePart> for SheetPlace {
    fn from(part: ScenePart) -> Self {
        Self { part, within: PartPath::WHOLE }
    }
}

/// The rows for the selected things of one kind.
pub(crate) struct PropertySheet<'s, 'a, T> {
    pub(crate) cx: &'s mut Cx<'a>,
    pub(crate) memory: &'s mut InspectorState,
    /// The one whose values are shown.
    pub(crate) primary: &'s T,
    /// All, the primary one first.
    pub(crate) things: Vec<&'s T>,
    /// Where the scene has the primary one.
    pub(crate) place: SheetPlace,
    /// What they are called in the history.
    pub(crate) subject: String,
    /// Which things these are, for the identity of widgets.
    pub(crate) id: Id,
    /// Whether they can be changed.
    pub(crate) is_free: bool,
    pub(crate) apply: &'s ApplyToAll<'s, T>,
}

impl<'a, T> PropertySheet<'_, 'a, T> {
    pub(crate) fn texts(&self) -> &'a Texts {
        self.cx.texts
    }

    /// Changes all things; says at the row `key` why not, if it is refused.
    pub(crate) fn change(
        &mut self,
        key: &'static str,
        edit: &'static str,
        mut change: impl FnMut(usize, &mut T),
    ) {
        if self.memory.is_given_up {
            return;
        }
        let label = Label::new(edit, self.subject.clone());
        match (self.apply)(self.cx.editor, label.clone(), &mut change) {
            Ok(has_changed) => {
                self.memory.note = None;
                if has_changed {
                    self.memory.gesture = Some(label);
                }
            }
            Err(refused) => {
                let text = refusal::of_change(self.cx.texts, &refused);
                self.memory.note = Some(RefusalNote { id: self.id, key, text });
            }
        }
    }

    /// Whether all things that have this number have the same one.
    fn is_mixed<V: PartialEq>(&self, get: impl Fn(&T) -> Option<V>) -> bool {
        let mut values = self.things.iter().filter_map(|thing| get(thing));
        let Some(first) = values.next() else { return false };
        values.any(|value| value != first)
    }

    /// Draws a row for a quantity, with the note of what was refused there. Its label tells the unit that its fields
    /// have no room for.
    pub(crate) fn row(
        &mut self,
        ui: &mut Ui,
        what: &RowQuantity,
        unit: Unit,
        tip: String,
        contents: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let texts = self.texts();
        let label = RowLabel {
            id: self.id.with(what.key),
            text: texts.get(what.key),
            symbol: what.markup(),
            unit: unit.suffix(texts),
            tip,
            is_highlighted: what.symbol.is_some() && self.memory.pointed == what.symbol,
        };
        let ((), is_hovered) = row(ui, &label, |ui, _| contents(self, ui));
        if is_hovered && what.symbol.is_some() {
            self.memory.row_hovered = what.symbol;
        }
        self.note(ui, what.key);
    }

    /// A row with a label but without limits and a default.
    pub(crate) fn plain_row(
        &mut self,
        ui: &mut Ui,
        key: &'static str,
        contents: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let text = self.texts().get(key);
        self.labelled_row(ui, key, "", text, contents);
    }

    /// A row with a few choices side by side, each with the key of its text, of which `chosen` is lit. Returns another one
    /// when it is clicked.
    pub(crate) fn choice<V: Copy + PartialEq>(
        &mut self,
        ui: &mut Ui,
        key: &'static str,
        choices: &[(V, &'static str)],
        chosen: Option<V>,
    ) -> Option<V> {
        let mut picked = None;
        self.plain_row(ui, key, |sheet, ui| {
            let texts = sheet.texts();
            let item = |&(value, key)| ChoiceItem {
                value,
                text: texts.get(key),
                tip: texts.tip(key).unwrap_or_default(),
                is_enabled: true,
            };
            let items: Vec<ChoiceItem<'_, V>> = choices.iter().map(item).collect();
            let (id, width) = (sheet.id.with(key), ui.available_width());
            picked = choice_ui(ui, id, texts.get(key), width, &items, chosen);
        });
        picked
    }

    /// A row whose label is a formula, without limits and a default.
    pub(crate) fn marked_row(
        &mut self,
        ui: &mut Ui,
        key: &'static str,
        markup: &str,
        contents: impl FnOnce(&mut Self, &mut Ui),
    ) {
        self.labelled_row(ui, key, markup, "", contents);
    }

    fn labelled_row(
        &mut self,
        ui: &mut Ui,
        key: &'static str,
        symbol: &str,
        text: &str,
        contents: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let tip = self.texts().tip(key).unwrap_or_default().to_owned();
        let label = RowLabel { id: self.id.with(key), text, symbol, unit: "", tip, is_highlighted: false };
        row(ui, &label, |ui, _| contents(self, ui));
        self.note(ui, key);
    }

    /// Says what was refused at the row `key`.
    pub(crate) fn note(&self, ui: &mut Ui, key: &str) {
        let Some(note) = self.memory.note.as_ref() else { return };
        if note.key == key && note.id == self.id {
            let palette = theme::palette(ui.visuals());
            ui.add(egui::Label::new(egui::RichText::new(&note.text).color(palette.error).small()).wrap());
        }
    }

    /// Follows what is typed into a number field of the row `key`: one text is one step of the history, and one that is
    /// not taken leaves no trace. Returns the number to be set.
    fn typed(&mut self, key: &'static str, entered: &NumberResponse) -> Option<f64> {
        if entered.has_begun {
            self.cx.editor.settle();
        }
        let is_ours =
            self.memory.gesture.is_some() && self.cx.editor.gesture_label() == self.memory.gesture.as_ref();
        if entered.is_taken_back && is_ours {
            self.cx.editor.abandon();
            self.memory.gesture = None;
        }
        if let Some(refusal) = &entered.refusal {
            let text = refusal.explained(self.texts());
            self.memory.note = Some(RefusalNote { id: self.id, key, text });
        } else if entered.is_taken_back && self.memory.note.as_ref().is_some_and(|note| note.key == key) {
            self.memory.note = None;
        }
        entered.value.filter(|_| !entered.is_taken_back)
    }

    /// What a row explains: the term, its limits, what it is at first.
    fn tip(&self, what: &RowQuantity, default: Option<String>) -> String {
        let texts = self.texts();
        let mut tip = texts.tip(what.key).unwrap_or_default().to_owned();
        let unit = what.unit.suffix(texts);
        tip.push('\n');
        tip.push_str(&limits_in_words(texts, what.limits(), unit));
        if let Some(default) = default {
            tip.push('\n');
            tip.push_str(&texts.with("default-is", &[("value", format!("{default}{unit}").into())]));
        }
        tip
    }

    fn reset(&self, ui: &mut Ui, is_default: bool, name: &str, default: &str) -> bool {
        if is_default {
            return reset_button(ui, true, "", "");
        }
        let texts = self.texts();
        let label = texts.with("reset-of", &[("name", name.into())]);
        let tip = texts.with("reset-to", &[("value", default.into())]);
        reset_button(ui, false, &label, &tip)
    }
}
