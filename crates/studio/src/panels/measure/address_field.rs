//! A field for the address of a number of the scene, with suggestions while it is typed.

use std::iter;

use catoptric_scene::ScenePath;
use egui::{
    EventFilter, Id, Key, Modifiers, Popup, PopupCloseBehavior, Rect, RectAlign, Response, TextEdit, Ui,
};

use crate::base::fuzzy::Query;
use crate::base::theme;
use crate::state::context::Cx;

/// The most suggestions.
const MOST: usize = 10;

/// The most values of the scene that are looked through.
const MOST_KEYS: usize = 20_000;

/// An address as typed.
#[derive(Default)]
pub(super) struct AddressField {
    pub(super) text: String,
    list: Option<SuggestionList>,
    /// Whether the field gets the focus in the next frame.
    wants_focus: bool,
}

/// The open list of suggestions.
#[derive(Default)]
struct SuggestionList {
    /// Addresses with what they mean, the best first.
    found: Vec<(String, String)>,
    chosen: usize,
    /// What was searched, in which state of the document.
    of: Option<(String, u64)>,
    /// Where the list was drawn.
    rect: Option<Rect>,
}

/// What the keys asked of the list.
enum ListKey {
    Take,
    Close,
}

impl AddressField {
    /// A field with this text; an empty one is to be typed in at once.
    pub(super) fn new(text: String) -> Self {
        Self { wants_focus: text.is_empty(), text, list: None }
    }

    /// Draws the field; returns whether the address is another one now.
    pub(super) fn ui(&mut self, ui: &mut Ui, cx: &Cx<'_>, id: Id, width: f32, is_wrong: bool) -> bool {
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        let mut picked = None;
        if has_focus {
            match self.keys(ui) {
                Some(ListKey::Take) => picked = self.chosen(),
                Some(ListKey::Close) => self.list = None,
                None => {}
            }
        }
        // Escape closes the list first, and leaves the field when there is none.
        let filter = EventFilter {
            escape: self.list.is_some(),
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        let mut edit = TextEdit::singleline(&mut self.text).id(id).desired_width(width).event_filter(filter);
        // With the list open, the address is still being typed.
        if is_wrong && self.list.is_none() {
            edit = edit.text_color(theme::palette(ui.visuals()).error);
        }
        let response = ui.add(edit.hint_text(cx.t("measure-address-hint")));
        let response = response.accessible_name(cx.t("measure-address"));
        if std::mem::take(&mut self.wants_focus) {
            response.request_focus();
        }
        let is_changed = response.changed();
        if is_changed || (response.gained_focus() && self.text.is_empty()) {
            self.list.get_or_insert_default();
        }
        self.search(cx);
        picked = self.list_ui(&response).or(picked);
        if let Some(address) = &picked {
            self.text.clone_from(address);
            self.list = None;
        } else if !response.has_focus() && !self.is_pressed(ui) {
            self.list = None;
        }
        is_changed || picked.is_some()
    }

    /// Moves the choice; `Down` opens the list, too.
    fn keys(&mut self, ui: &Ui) -> Option<ListKey> {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let Some(list) = self.list.as_mut().filter(|list| !list.found.is_empty()) else {
            if pressed(Key::ArrowDown) {
                self.list.get_or_insert_default();
            }
            return (self.list.is_some() && pressed(Key::Escape)).then_some(ListKey::Close);
        };
        let last = list.found.len().saturating_sub(1);
        if pressed(Key::ArrowDown) {
            list.chosen = if list.chosen >= last { 0 } else { list.chosen + 1 };
        }
        if pressed(Key::ArrowUp) {
            list.chosen = list.chosen.checked_sub(1).unwrap_or(last);
        }
        if pressed(Key::Enter) {
            return Some(ListKey::Take);
        }
        pressed(Key::Escape).then_some(ListKey::Close)
    }

    fn chosen(&self) -> Option<String> {
        let list = self.list.as_ref()?;
        list.found.get(list.chosen).map(|(address, _)| address.clone())
    }

    /// Finds what fits the text, when that or the scene has changed; without a text, what is selected comes first.
    fn search(&mut self, cx: &Cx<'_>) {
        let Some(list) = &mut self.list else { return };
        let of = (self.text.clone(), cx.editor.revision());
        if list.of.as_ref() == Some(&of) {
            return;
        }
        let scene = cx.editor.scene();
        // Words may be typed apart: "light intensity".
        let query = Query::new(&self.text.replace(char::is_whitespace, ""));
        let selected = cx.editor.primary_part().map(|part| scene.keys_of(part)).unwrap_or_default();
        let mut found: Vec<(i32, String, String)> = Vec::new();
        for key in selected.into_iter().chain(scene.keys().take(MOST_KEYS)) {
            for address in key.numbers().iter().map(ScenePath::to_string) {
                if let Some(score) = query.best(iter::once(address.as_str())) {
                    found.push((score, address, key.spec.meaning(cx.texts.language().into())));
                }
            }
        }
        found.sort_by_key(|(score, ..)| -score);
        let mut best: Vec<(String, String)> = Vec::new();
        for (_, address, meaning) in found {
            if best.len() < MOST && best.iter().all(|(known, _)| *known != address) {
                best.push((address, meaning));
            }
        }
        *list = SuggestionList { found: best, of: Some(of), ..SuggestionList::default() };
    }

    /// Draws the list below the field; returns what is clicked.
    fn list_ui(&mut self, response: &Response) -> Option<String> {
        let list = self.list.as_mut()?;
        // What is typed in full needs no suggestion.
        let is_typed = matches!(list.found.as_slice(), [(only, _)] if *only == self.text);
        let popup = Popup::from_response(response)
            .open(!list.found.is_empty() && !is_typed)
            .align(RectAlign::BOTTOM_START)
            .close_behavior(PopupCloseBehavior::IgnoreClicks);
        let shown = popup.show(|ui| {
            ui.set_min_width(response.rect.width());
            let mut picked = None;
            for (place, (address, meaning)) in list.found.iter().enumerate() {
                let row = ui.selectable_label(place == list.chosen, address).on_hover_text(meaning);
                if row.clicked() {
                    picked = Some(address.clone());
                }
            }
            picked
        })?;
        list.rect = Some(shown.response.rect);
        shown.inner
    }

    /// Whether the pointer is pressed on the list: the field has lost the focus then, and the click is still to come.
    fn is_pressed(&self, ui: &Ui) -> bool {
        let Some(rect) = self.list.as_ref().and_then(|list| list.rect) else { return false };
        ui.input(|input| {
            let is_busy = input.pointer.any_down() || input.pointer.any_released();
            is_busy && input.pointer.interact_pos().is_some_and(|place| rect.contains(place))
        })
    }
}
