//! Fields for one number.

use catoptric_scene::format::spec::Limits;
use egui::text::{CCursor, CCursorRange};
use egui::{
    Color32, DragValue, Id, Key, Modifiers, Response, RichText, TextEdit, Tooltip, Ui, WidgetInfo, accesskit,
    emath, vec2,
};

use super::{HEIGHT, MIXED, Unit, evaluate, exact, fitting, tidy};
use crate::base::texts::Texts;
use crate::base::theme;

mod refusal;

use refusal::RefusalReason;
pub(crate) use refusal::{Refusal, limits_in_words};

/// A field that is no wider, points, does not show its unit.
const NARROW: f32 = 72.0;

/// A field for one number. It is dragged, or typed as a number or an arithmetic expression. What cannot be read is
/// refused as a whole: the number becomes again what it was, and the text stays to be corrected.
pub(crate) struct NumberField<'a> {
    pub(crate) texts: &'a Texts,
    /// The accessible name.
    pub(crate) name: &'a str,
    /// The number now.
    pub(crate) value: f64,
    /// Whether several things have different numbers; `value` is then the one that dragging starts from.
    pub(crate) is_mixed: bool,
    /// What it can be.
    pub(crate) limits: Limits,
    /// How much it changes for each point dragged.
    pub(crate) speed: f64,
    /// How many decimals are shown at most while it is not typed; with 0, only whole numbers are taken.
    pub(crate) decimals: usize,
    pub(crate) unit: Unit,
    /// The color of the field's edge, for components of vectors.
    pub(crate) edge: Option<Color32>,
    /// How wide it is.
    pub(crate) width: f32,
    /// Whether the field itself says why a text was refused; otherwise its panel does.
    pub(crate) explains: bool,
}

/// The changes of a number field in a frame.
pub(crate) struct NumberResponse {
    pub(crate) response: Response,
    /// The new number, if it was changed.
    pub(crate) value: Option<f64>,
    /// Whether typing begins.
    pub(crate) has_begun: bool,
    /// Whether what was typed no longer holds; `value` is then the number from before, if it was changed meanwhile.
    pub(crate) is_taken_back: bool,
    /// Why what was typed has been refused, once it is left.
    pub(crate) refusal: Option<Refusal>,
    /// Why the text that waits in the field to be corrected was refused.
    pub(crate) waiting: Option<Refusal>,
}

/// The text that is being typed.
#[derive(Clone)]
struct TypingState {
    text: String,
    /// The number when it began, as text and by itself.
    before: String,
    start: f64,
    /// Whether it began with a text that was refused.
    is_correction: bool,
    /// The number that was reported last.
    told: f64,
    /// The last pass in which the field was drawn.
    pass: u64,
}

/// A refused text that waits to be corrected.
#[derive(Clone)]
struct RefusedText {
    text: String,
    refusal: Refusal,
    /// The number that stands meanwhile.
    value: f64,
    pass: u64,
}

/// The result of reading a text.
enum TextVerdict {
    Taken(f64),
    Unchanged,
    Refused(RefusalReason),
}

/// The result of a text whose field was left.
#[derive(Default)]
struct TypingResult {
    value: Option<f64>,
    is_taken_back: bool,
    refusal: Option<Refusal>,
}

impl NumberField<'_> {
    /// Draws the field.
    pub(crate) fn show(&self, ui: &mut Ui) -> NumberResponse {
        let inner = ui.scope(|ui| self.show_scoped(ui));
        inner.inner
    }

    fn show_scoped(&self, ui: &mut Ui) -> NumberResponse {
        let palette = theme::palette(ui.visuals());
        let widgets = &mut ui.visuals_mut().widgets;
        widgets.inactive.weak_bg_fill = palette.field;
        widgets.inactive.bg_stroke.color = palette.line;
        ui.spacing_mut().button_padding = vec2(4.0, 2.0);
        let (id, layer) = (ui.next_auto_id(), ui.layer_id());
        let is_typed = ui.is_enabled()
            && ui.memory_mut(|memory| {
                memory.interested_in_focus(id, layer);
                memory.has_focus(id)
            });
        let mut entered = if is_typed { self.type_ui(ui, id) } else { self.rest_ui(ui, id) };
        self.paint_edge(ui, &entered.response);
        entered.response = entered.response.accessible_name(self.name);
        entered
    }

    /// Draws the field while nothing is typed: it can be dragged.
    fn rest_ui(&self, ui: &mut Ui, id: Id) -> NumberResponse {
        let left = self.leave(ui, id);
        let draft = self.draft(ui, id);
        let palette = theme::palette(ui.visuals());
        let unit = if self.is_mixed || draft.is_some() || self.width <= NARROW {
            ""
        } else {
            self.unit.suffix(self.texts)
        };
        let letters = ((self.width - 12.0) / 7.0) as usize;
        let text = match (&draft, self.is_mixed) {
            (Some(draft), _) => draft.text.clone(),
            (None, true) => MIXED.to_owned(),
            (None, false) => {
                let room = letters.saturating_sub(unit.chars().count()).max(4);
                fitting(self.texts, self.value, self.decimals, room)
            }
        };
        if draft.is_some() {
            ui.visuals_mut().override_text_color = Some(palette.error);
            ui.visuals_mut().widgets.inactive.bg_stroke.color = palette.error;
        }
        let is_coarse = ui.input(|input| input.modifiers.command && !input.modifiers.shift);
        let mut value = self.value;
        let response =
            ui.add(
                DragValue::new(&mut value)
                    .speed(if is_coarse { 10.0 * self.speed } else { self.speed })
                    .range(self.limits.min..=self.limits.max)
                    .clamp_existing_to_range(false)
                    .suffix(RichText::new(unit).color(palette.weak))
                    .min_size(vec2(self.width, HEIGHT))
                    .clip_text(true)
                    .custom_formatter(|value, _| {
                        if value == self.value { text.clone() } else { exact(self.texts, value) }
                    }),
            );
        if let Some(draft) = &draft {
            self.explain(&response, draft);
        }
        // Assistive technology can ask for values of disabled fields.
        let is_changed = ui.is_enabled() && value.to_bits() != self.value.to_bits();
        NumberResponse {
            response,
            value: is_changed.then_some(value).or(left.value),
            has_begun: false,
            is_taken_back: left.is_taken_back,
            refusal: left.refusal,
            waiting: draft.map(|draft| draft.refusal),
        }
    }

    /// Draws the field while it is typed in.
    fn type_ui(&self, ui: &mut Ui, id: Id) -> NumberResponse {
        let pass = ui.ctx().cumulative_pass_nr();
        let kept = take::<TypingState>(ui, typing_id(id));
        let kept = kept.filter(|typing| typing.pass + 1 >= pass);
        let has_begun = kept.is_none();
        // A number that was changed by something else has another text; one that the scene refused has not changed.
        let is_known =
            |typing: &TypingState| [typing.told, typing.start].iter().any(|own| is_near(*own, self.value));
        let mut typing = kept.filter(is_known).unwrap_or_else(|| self.begin(ui, id));
        if !is_near(typing.told, self.value) {
            typing.told = self.value;
        }
        let mut value = self.stepped(ui, id);
        if let Some(value) = value {
            typing.text = exact(self.texts, value);
            typing.told = value;
        }
        let edit = TextEdit::singleline(&mut typing.text).id(id).clip_text(true).desired_width(0.0);
        let edit = edit.align(ui.layout().align2()).min_size(vec2(self.width, HEIGHT));
        let response = ui.add(edit.font(ui.style().drag_value_text_style.clone()));
        let mut is_taken_back = false;
        if response.changed() {
            match self.judge(&typing) {
                TextVerdict::Taken(number) => value = Some(number),
                _ if typing.told.to_bits() != typing.start.to_bits() => {
                    (value, is_taken_back) = (Some(typing.start), true);
                }
                _ => {}
            }
            typing.told = value.unwrap_or(typing.told);
        }
        self.tell_assistive_technology(ui, &response);
        ui.data_mut(|data| data.insert_temp(typing_id(id), TypingState { pass, ..typing }));
        let value = value.filter(|value| value.to_bits() != self.value.to_bits() || self.is_mixed);
        NumberResponse { response, value, has_begun, is_taken_back, refusal: None, waiting: None }
    }

    /// Begins to type, with the text that was refused, if there is one, or with the number in full.
    fn begin(&self, ui: &Ui, id: Id) -> TypingState {
        let before = if self.is_mixed { MIXED.to_owned() } else { exact(self.texts, self.value) };
        let draft = take::<RefusedText>(ui, draft_id(id));
        let draft = draft.filter(|draft| is_near(draft.value, self.value));
        let is_correction = draft.is_some();
        let text = draft.map_or_else(|| before.clone(), |draft| draft.text);
        let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
        let whole = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(whole));
        state.store(ui.ctx(), id);
        TypingState { text, before, is_correction, start: self.value, told: self.value, pass: 0 }
    }

    /// The number after the arrow keys, or assistive technology, stepped it.
    fn stepped(&self, ui: &Ui, id: Id) -> Option<f64> {
        let steps = ui.input_mut(|input| {
            let up = input.count_and_consume_key(Modifiers::NONE, Key::ArrowUp)
                + input.num_accesskit_action_requests(id, accesskit::Action::Increment);
            let down = input.count_and_consume_key(Modifiers::NONE, Key::ArrowDown)
                + input.num_accesskit_action_requests(id, accesskit::Action::Decrement);
            up as f64 - down as f64
        });
        if steps == 0.0 {
            return None;
        }
        let speed = if self.decimals == 0 { self.speed.max(1.0) } else { self.speed };
        let decimals =
            (ui.input(egui::InputState::aim_radius) / speed as f32).log10().ceil().clamp(0.0, 15.0);
        let stepped = emath::round_to_decimals(self.value + steps * speed, decimals as usize);
        Some(tidy(stepped.clamp(self.limits.min, self.limits.max)))
    }

    /// What was typed, once the field is left.
    fn leave(&self, ui: &Ui, id: Id) -> TypingResult {
        let pass = ui.ctx().cumulative_pass_nr();
        let typing = take::<TypingState>(ui, typing_id(id));
        let Some(typing) = typing.filter(|typing| typing.pass + 1 >= pass) else {
            return TypingResult::default();
        };
        let is_told = |value: f64| value.to_bits() == typing.told.to_bits();
        let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
        let back = Some(typing.start).filter(|start| !is_told(*start));
        match self.judge(&typing) {
            TextVerdict::Taken(value) if !is_given_up => TypingResult {
                value: Some(value).filter(|value| !is_told(*value) || self.is_mixed),
                ..TypingResult::default()
            },
            TextVerdict::Refused(reason) if !is_given_up => {
                let refusal = Refusal { text: typing.text.clone(), unit: self.unit, reason };
                let draft =
                    RefusedText { text: typing.text, refusal: refusal.clone(), value: typing.start, pass };
                ui.data_mut(|data| data.insert_temp(draft_id(id), draft));
                TypingResult { value: back, is_taken_back: true, refusal: Some(refusal) }
            }
            _ => {
                let is_taken_back = is_given_up || typing.is_correction || back.is_some();
                TypingResult { value: back, is_taken_back, refusal: None }
            }
        }
    }

    /// The text that waits to be corrected. It is dropped once the number is another, or the field was not seen.
    fn draft(&self, ui: &Ui, id: Id) -> Option<RefusedText> {
        let pass = ui.ctx().cumulative_pass_nr();
        let draft = take::<RefusedText>(ui, draft_id(id))?;
        // The number is that from before only in the next pass.
        let is_fresh = draft.pass == pass;
        let stands = draft.pass + 1 >= pass && (is_fresh || is_near(draft.value, self.value));
        let kept = stands.then_some(RefusedText { pass, ..draft });
        if let Some(draft) = &kept {
            ui.data_mut(|data| data.insert_temp(draft_id(id), draft.clone()));
        }
        kept
    }

    fn judge(&self, typing: &TypingState) -> TextVerdict {
        let typed = typing.text.trim();
        if typed.is_empty() || typed == typing.before || typed == MIXED {
            return TextVerdict::Unchanged;
        }
        let own = self.unit.suffix(self.texts).trim();
        let is_bare = matches!(self.unit, Unit::Pixels | Unit::Stops);
        let plain = if is_bare { typed.strip_suffix(own).unwrap_or(typed) } else { typed };
        let sign = self.texts.language().decimal_sign();
        match evaluate(plain, self.unit, sign) {
            Err(fault) => TextVerdict::Refused(RefusalReason::Fault(fault)),
            Ok(number) if !self.limits.contains(number) => {
                TextVerdict::Refused(RefusalReason::OutOfLimits(self.limits))
            }
            Ok(number) if self.decimals == 0 && number.fract() != 0.0 => {
                TextVerdict::Refused(RefusalReason::NotWhole)
            }
            Ok(number) => TextVerdict::Taken(number),
        }
    }

    /// Says why a text was refused, beside it.
    fn explain(&self, response: &Response, draft: &RefusedText) {
        if !self.explains {
            return;
        }
        let color = theme::palette(&response.ctx.global_style().visuals).error;
        let text = draft.refusal.explained(self.texts);
        let id = response.id.with("refusal");
        Tooltip::always_open(response.ctx.clone(), response.layer_id, id, response.rect).show(|ui| {
            ui.label(RichText::new(text).color(color));
        });
    }

    /// A text that is a number.
    fn tell_assistive_technology(&self, ui: &Ui, response: &Response) {
        response.widget_info(|| WidgetInfo::drag_value(ui.is_enabled(), self.value));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_min_numeric_value(self.limits.min);
            node.set_max_numeric_value(self.limits.max);
            node.set_numeric_value_step(self.speed);
            node.add_action(accesskit::Action::Increment);
            node.add_action(accesskit::Action::Decrement);
        });
    }

    fn paint_edge(&self, ui: &Ui, response: &Response) {
        let Some(color) = self.edge else { return };
        let mut bar = response.rect.shrink2(vec2(0.0, 3.0));
        bar.min.x += 1.5;
        bar.max.x = bar.min.x + 2.0;
        let color = if ui.is_enabled() { color } else { color.gamma_multiply(0.4) };
        ui.painter().rect_filled(bar, 1.0, color);
    }
}

/// Takes what was kept under `id`.
fn take<T: Clone + Send + Sync + 'static>(ui: &Ui, id: Id) -> Option<T> {
    ui.data_mut(|data| {
        let kept = data.get_temp::<T>(id);
        data.remove::<T>(id);
        kept
    })
}

fn typing_id(id: Id) -> Id {
    id.with("typing")
}

fn draft_id(id: Id) -> Id {
    id.with("draft")
}

/// Whether two numbers are the same but for what the scene rounds.
fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-5 * a.abs().max(1e-6)
}
