//! A finished picture in a window of its own.

use catoptric_picture::Development;
use egui::{
    Align, Button, CentralPanel, Context, Frame, Id, Label, Layout, Margin, Panel, RichText, Stroke, Ui,
    Vec2, Window, vec2,
};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::{ICON_CONTENT_COPY, ICON_SAVE};

use super::{copy, fields, save};
use crate::base::job::let_go;
use crate::base::proof::size_of;
use crate::base::texts::Texts;
use crate::base::{theme, words};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::pictures::{FinishedPicture, PictureSaveState, SavedPlace};

/// The smallest window of a picture, points.
const LEAST: Vec2 = vec2(540.0, 340.0);

/// The pressed button of the window.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ResultAction {
    Save,
    Copy,
    Close,
}

impl FinishedPicture {
    /// Does something with the picture of this number, if it is still there.
    pub(crate) fn with(studio: &mut Studio, number: u64, act: impl FnOnce(&mut Studio, &mut Self)) {
        let mut all = std::mem::take(&mut studio.pictures.finished);
        if let Some(finished) = all.iter_mut().find(|finished| finished.number == number) {
            act(studio, finished);
        }
        studio.pictures.finished = all;
    }
}

/// Draws the windows of the finished pictures.
pub(super) fn results_ui(context: &Context, studio: &mut Studio) {
    let mut all = std::mem::take(&mut studio.pictures.finished);
    let mut closed = None;
    for finished in &mut all {
        save::poll(context, studio, finished);
        match window_ui(context, studio, finished) {
            Some(ResultAction::Save) => save::ask(studio, finished),
            Some(ResultAction::Copy) => copy::copy_finished(context, studio, finished),
            Some(ResultAction::Close) if finished.kept.is_some() => closed = Some(finished.number),
            Some(ResultAction::Close) => ask_to_drop(studio, finished.number),
            None => {}
        }
    }
    studio.pictures.finished = all;
    if let Some(number) = closed {
        close(studio, number);
    }
}

fn close(studio: &mut Studio, number: u64) {
    let all = &mut studio.pictures.finished;
    if let Some(place) = all.iter().position(|finished| finished.number == number) {
        let_go(all.remove(place).picture);
    }
}

fn ask_to_drop(studio: &mut Studio, number: u64) {
    let texts = &studio.texts;
    let question = QuestionDialog::new(texts.get("picture-drop-title"), texts.get("picture-drop-text"))
        .choice(texts.get("picture-save"), move |_, studio| FinishedPicture::with(studio, number, save::ask))
        .choice(texts.get("cancel"), |_, _| {})
        .choice(texts.get("picture-drop"), move |_, studio| close(studio, number));
    studio.dialogs.open(question);
}

fn window_ui(context: &Context, studio: &mut Studio, finished: &mut FinishedPicture) -> Option<ResultAction> {
    let whole = studio.visible_rect().unwrap_or_else(|| context.content_rect());
    let title = {
        let [width, height] = size_of(&finished.picture);
        studio.texts.with("picture-title", &[("size", words::size(width, height).into())])
    };
    // At first it has the proportions of the picture, with room for what is below.
    let [width, height] = size_of(&finished.picture).map(|side| side as f32);
    let most = (0.9 * whole.size()).min(vec2(1040.0, 860.0)).max(LEAST);
    let size = vec2(most.x, (most.x * height / width + 156.0).clamp(LEAST.y, most.y));
    // The next window does not hide the one before.
    let shift = 24.0 * (finished.place % 5) as f32;
    let window = Window::new(RichText::new(&title).strong())
        .id(Id::unique(("picture", finished.place)))
        .title_frame(Frame::window(&context.global_style()).inner_margin(Margin::symmetric(14, 8)))
        .collapsible(false)
        .resizable(true)
        .default_size(size)
        // Magnified, the whole window may have less room than that.
        .min_size(LEAST.min(0.9 * context.content_rect().size()))
        .default_pos(whole.center() - 0.5 * size + vec2(shift, shift))
        .constrain_to(context.content_rect());
    window.show(context, |ui| contents_ui(ui, studio, finished)).and_then(|shown| shown.inner).flatten()
}

fn contents_ui(ui: &mut Ui, studio: &mut Studio, finished: &mut FinishedPicture) -> Option<ResultAction> {
    let controls = Panel::bottom("controls").frame(Frame::NONE);
    let press = controls.resizable(false).show_separator_line(false).show(ui, |ui| {
        ui.add_space(8.0);
        facts_ui(ui, &studio.texts, finished);
        ui.add_space(4.0);
        development_ui(ui, &studio.texts, &mut finished.order.development);
        ui.add_space(6.0);
        buttons_ui(ui, studio, finished)
    });
    CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
        let FinishedPicture { shown, picture, order, .. } = finished;
        shown.ui(ui, &studio.texts, picture, order.development);
    });
    press.inner
}

/// How the picture was made.
fn facts_ui(ui: &mut Ui, texts: &Texts, finished: &FinishedPicture) {
    let millions = (finished.counts.total() as f64 / 1e6).ceil() as u64;
    let text = texts.with(
        "picture-facts",
        &[
            ("name", finished.order.name.as_str().into()),
            ("samples", finished.order.choices.samples.into()),
            ("time", words::clock(finished.elapsed).into()),
            ("rays", millions.into()),
        ],
    );
    ui.add(Label::new(RichText::new(text).color(theme::palette(ui.visuals()).weak)).truncate());
}

fn development_ui(ui: &mut Ui, texts: &Texts, development: &mut Development) {
    ui.horizontal(|ui| {
        fields::name_ui(ui, texts.get("viewport-exposure"));
        fields::exposure_ui(ui, texts, development);
        ui.add_space(8.0);
        fields::name_ui(ui, texts.get("viewport-tone"));
        fields::tone_ui(ui, texts, development);
    });
}

/// The kind of file and the buttons; at the left, where there is room, what has become of the picture.
fn buttons_ui(ui: &mut Ui, studio: &Studio, finished: &mut FinishedPicture) -> Option<ResultAction> {
    let mut press = None;
    let is_narrow = ui.available_width() < LEAST.x - 60.0;
    let layout = if is_narrow {
        Layout::left_to_right(Align::Center).with_main_wrap(true)
    } else {
        Layout::right_to_left(Align::Center)
    };
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, layout, |ui| {
        let texts = &studio.texts;
        let is_copying = copy::is_copying(studio, finished.number);
        let is_saving = !matches!(finished.saving, PictureSaveState::No);
        if button_ui(ui, texts, "picture-save", Some(ICON_SAVE), !is_saving) {
            press = Some(ResultAction::Save);
        }
        fields::kind_ui(ui, texts, &mut finished.order.choices.kind);
        if button_ui(ui, texts, "picture-copy", Some(ICON_CONTENT_COPY), !copy::is_any_copying(studio)) {
            press = Some(ResultAction::Copy);
        }
        if button_ui(ui, texts, "picture-close", None, !is_saving && !is_copying) {
            press = Some(ResultAction::Close);
        }
        if is_narrow {
            state_ui(ui, texts, finished, is_copying);
        } else {
            let layout = Layout::left_to_right(Align::Center);
            ui.with_layout(layout, |ui| state_ui(ui, texts, finished, is_copying));
        }
    });
    press
}

fn button_ui(ui: &mut Ui, texts: &Texts, key: &str, icon: Option<MaterialIcon>, is_enabled: bool) -> bool {
    let palette = theme::palette(ui.visuals());
    let name = texts.get(key);
    let text = match icon {
        Some(icon) => format!("{}  {name}", icon.codepoint),
        None => texts.get("close").to_owned(),
    };
    let mut button = Button::new(text).min_size(vec2(84.0, 28.0));
    if key == "picture-save" {
        button = button.fill(palette.selection).stroke(Stroke::new(1.0, palette.accent));
    }
    let response = ui.add_enabled(is_enabled, button).accessible_name(name);
    match texts.tip(key) {
        Some(tip) => response.on_hover_text(tip).clicked(),
        None => response.clicked(),
    }
}

/// What is being done with the picture, or has been.
fn state_ui(ui: &mut Ui, texts: &Texts, finished: &FinishedPicture, is_copying: bool) {
    let text = match (&finished.kept, &finished.saving) {
        (_, PictureSaveState::Writing(..)) => texts.get("picture-writing").to_owned(),
        _ if is_copying => texts.get("picture-copying").to_owned(),
        (Some(SavedPlace::File(name)), _) => texts.with("picture-saved", &[("name", name.as_str().into())]),
        (Some(SavedPlace::Clipboard), _) => texts.get("picture-in-clipboard").to_owned(),
        (None, _) => return,
    };
    if is_copying || matches!(finished.saving, PictureSaveState::Writing(..)) {
        ui.spinner();
    }
    let palette = theme::palette(ui.visuals());
    ui.add(Label::new(RichText::new(text).color(palette.weak)).truncate());
}
