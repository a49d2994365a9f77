//! The card that shows how far a render is, in the lower right corner of the picture.

use egui::{Align, Align2, Area, Frame, Id, Layout, Margin, Order, ProgressBar, RichText, Ui, vec2};
use egui_material_icons::icons::ICON_CLOSE;

use crate::base::texts::Texts;
use crate::base::{theme, words};
use crate::shell::studio::Studio;
use crate::shell::studio::pictures::RenderTask;

const WIDTH: f32 = 330.0;

/// Draws the card while a picture is being rendered.
pub(crate) fn card_ui(ui: &Ui, studio: &mut Studio) {
    let Some(running) = &studio.pictures.running else { return };
    let context = ui.ctx();
    let whole = context.content_rect();
    let picture = studio.visible_rect().map_or(whole, |rect| rect.intersect(whole));
    let title = title(&studio.texts, running);
    let is_cancelled = Area::new(Id::unique("render progress"))
        .accessible_name(&title)
        .order(Order::Middle)
        .pivot(Align2::RIGHT_BOTTOM)
        .fixed_pos(picture.right_bottom() - vec2(14.0, 14.0))
        .constrain_to(whole)
        .show(context, |ui| {
            Frame::window(ui.style())
                .inner_margin(Margin::symmetric(14, 12))
                .show(ui, |ui| {
                    ui.set_width(WIDTH);
                    progress_ui(ui, &studio.texts, running, &title)
                })
                .inner
        })
        .inner;
    if is_cancelled {
        studio.pictures.cancel();
        studio.toasts.info(studio.texts.get("render-cancelled"));
    }
}

fn title(texts: &Texts, running: &RenderTask) -> String {
    let choices = &running.order.choices;
    texts.with("render-progress", &[("size", words::size(choices.width, choices.height).into())])
}

fn progress_ui(ui: &mut Ui, texts: &Texts, running: &RenderTask, title: &str) -> bool {
    let palette = theme::palette(ui.visuals());
    let progress = running.job.progress();
    let mut is_cancelled = false;
    ui.horizontal(|ui| {
        ui.label(RichText::new(title).strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            // A whole only once there is the whole.
            let percent = (100.0 * progress.fraction).floor() as u32;
            let text = texts.with("render-percent", &[("percent", percent.into())]);
            ui.label(RichText::new(text).color(palette.weak));
        });
    });
    let bar = ProgressBar::new(progress.fraction as f32)
        .desired_width(ui.available_width())
        .desired_height(6.0)
        .corner_radius(3.0)
        .fill(palette.accent);
    ui.add_space(2.0);
    ui.add(bar).accessible_name(title);
    ui.add_space(2.0);
    ui.horizontal(|ui| {
        let elapsed = words::clock(progress.elapsed).into();
        let text = match progress.remaining {
            Some(left) => {
                let arguments = [("elapsed", elapsed), ("left", words::clock(left).into())];
                texts.with("render-times", &arguments)
            }
            None => texts.with("render-preparing", &[("elapsed", elapsed)]),
        };
        ui.label(RichText::new(text).color(palette.weak));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let label = format!("{} {}", ICON_CLOSE.codepoint, texts.get("render-cancel"));
            let response = ui.button(label).accessible_name(texts.get("render-cancel-name"));
            let response = response.on_hover_text(texts.tip("render-cancel").unwrap_or_default());
            is_cancelled = response.clicked();
        });
    });
    is_cancelled
}
