//! Fields of text that are taken when they are left.

use egui::{Key, Response, TextEdit, Ui, vec2};

use crate::base::theme;
use crate::base::widgets::number::HEIGHT;

/// The text that is being typed.
#[derive(Clone, Default)]
struct TextDraft {
    text: String,
    /// The last pass in which its field was drawn.
    pass: u64,
}

/// A field that shows `current` until something else is typed. What was typed comes once the field is left, but not
/// when it is cancelled with Escape. The second value is what stands in the field meanwhile.
pub(crate) fn text_field(
    ui: &mut Ui,
    name: &str,
    current: &str,
    hint: &str,
    width: f32,
) -> (Response, Option<String>, Option<String>) {
    let inner = ui.scope(|ui| {
        ui.visuals_mut().widgets.inactive.bg_stroke.color = theme::palette(ui.visuals()).line;
        let id = ui.next_auto_id();
        let pass = ui.ctx().cumulative_pass_nr();
        // A field that was not drawn since is another one by now, though it may have the same place.
        let draft =
            ui.data_mut(|data| data.remove_temp::<TextDraft>(id)).filter(|draft| draft.pass + 1 >= pass);
        let draft = draft.map(|draft| draft.text);
        let mut text = draft.clone().unwrap_or_else(|| current.to_owned());
        let edit = TextEdit::singleline(&mut text)
            .id(id)
            .clip_text(true)
            .hint_text(hint)
            .align(egui::Align2::LEFT_CENTER)
            .min_size(vec2(width, HEIGHT))
            .desired_width(width - 8.0);
        let response = ui.add_sized(vec2(width, HEIGHT), edit).accessible_name(name);
        if response.has_focus() {
            ui.data_mut(|data| data.insert_temp(id, TextDraft { text: text.clone(), pass }));
            return (response, None, Some(text));
        }
        if draft.is_none() {
            return (response, None, None);
        }
        let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
        let taken = (!is_given_up && text != current).then_some(text);
        (response, taken, None)
    });
    inner.inner
}
