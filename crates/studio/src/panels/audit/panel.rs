//! The panel of the audit: the pixel and its value, the steps, slow light, and the list of rays.

use std::sync::Arc;

use catoptric_lab::audit::Proof;
use egui::{RichText, Slider, Ui};
use egui_material_icons::icons;

use super::rows::chip_color;
use super::{AuditListing, rows};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::explained_icon_button;
use crate::base::widgets::number::{Unit, evaluate, shown};
use crate::state::audit::AuditResult;
use crate::state::audit::clock::{self, LightSpan};
use crate::state::command::{AuditCommand, Command};
use crate::state::context::Cx;

/// Draws the panel.
pub(crate) fn panel_ui(ui: &mut Ui, cx: &mut Cx<'_>, listing: &mut AuditListing) {
    let Some(found) = cx.audit.found().cloned() else {
        empty_ui(ui, cx);
        return;
    };
    head_ui(ui, cx, &found);
    controls_ui(ui, cx, &found);
    ui.separator();
    rows::list_ui(ui, cx, listing, &found);
}

/// There is nothing to show yet.
fn empty_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let text = match (&cx.audit.failure, cx.audit.pin()) {
        (Some(error), _) => {
            let text = cx.texts.with("audit-failed", &[("error", error.to_string().into())]);
            RichText::new(text).color(theme::palette(ui.visuals()).error)
        }
        (None, Some(_)) => RichText::new(cx.t("audit-under-way")).weak(),
        (None, None) if cx.view.is_auditing => RichText::new(cx.t("audit-click")).weak(),
        (None, None) => RichText::new(cx.t("audit-choose-tool")).weak(),
    };
    ui.vertical_centered(|ui| {
        ui.add_space((0.5 * ui.available_height() - 34.0).max(4.0));
        ui.label(text);
        if !cx.view.is_auditing {
            ui.add_space(4.0);
            if ui.button(cx.t("audit-begin")).clicked() {
                cx.run(Command::Audit(AuditCommand::Tool));
            }
        }
    });
}

/// The pixel, its light, and how it is known that the rays make it.
fn head_ui(ui: &mut Ui, cx: &mut Cx<'_>, found: &AuditResult) {
    let texts = cx.texts;
    let palette = theme::palette(ui.visuals());
    ui.horizontal_wrapped(|ui| {
        let (rect, _) = ui.allocate_exact_size(egui::Vec2::splat(18.0), egui::Sense::hover());
        let light = glam::DVec3::from(found.audit.light.map(f64::from));
        ui.painter().rect(
            rect,
            3.0,
            chip_color(light),
            egui::Stroke::new(1.0, palette.line),
            egui::StrokeKind::Inside,
        );
        let pin = &found.pin;
        let arguments = [
            ("x", pin.pixel.x.to_string().into()),
            ("y", pin.pixel.y.to_string().into()),
            ("width", pin.size.x.to_string().into()),
            ("height", pin.size.y.to_string().into()),
        ];
        ui.label(RichText::new(texts.with("audit-pixel", &arguments)).strong());
        let [red, green, blue] = found.audit.light.map(|part| texts.localized(part.to_string()));
        let value = format!("{red}  {green}  {blue}");
        ui.label(RichText::new(value).monospace()).on_hover_text(cx.t("audit-linear"));
        let (key, is_whole) = match found.audit.proof {
            Proof::AnyOrder => ("audit-proof-exact", true),
            Proof::Rendered { is_same: true } => ("audit-proof-same", true),
            Proof::Rendered { is_same: false } => ("audit-proof-last-bit", true),
            Proof::Incomplete => ("audit-proof-incomplete", false),
        };
        let color = if is_whole { palette.weak } else { palette.warning };
        let proof = ui.label(RichText::new(cx.t(key)).color(color));
        proof.on_hover_text(cx.texts.tip(key).unwrap_or_default());
    });
}

/// Steps, slow light, and what can be done with the audit.
fn controls_ui(ui: &mut Ui, cx: &mut Cx<'_>, found: &Arc<AuditResult>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        button(ui, cx, AuditCommand::Previous);
        let shown = cx.audit.step.unwrap_or(found.generations());
        let arguments = [("shown", shown.into()), ("count", found.generations().into())];
        ui.label(cx.texts.with("audit-generations", &arguments));
        button(ui, cx, AuditCommand::Next);
        button(ui, cx, AuditCommand::All);
        ui.separator();
        light_ui(ui, cx, found);
        ui.separator();
        for act in [AuditCommand::View, AuditCommand::Copy, AuditCommand::Save, AuditCommand::Release] {
            button(ui, cx, act);
        }
        if found.ways_left_out > 0 {
            let count = [("count", found.ways_left_out.into())];
            ui.weak(cx.texts.with("audit-not-drawn", &count));
        }
    });
}

/// Slow light: run, stop, how far it has come, and how long it takes.
fn light_ui(ui: &mut Ui, cx: &mut Cx<'_>, found: &AuditResult) {
    button(ui, cx, AuditCommand::Play);
    ui.spacing_mut().slider_width = 90.0;
    front_ui(ui, cx, found.span);
    duration_ui(ui, cx);
}

/// How far slow light has come. The slider counts shares of the time, and shows the path from the eye.
fn front_ui(ui: &mut Ui, cx: &mut Cx<'_>, span: LightSpan) {
    let texts = cx.texts;
    let mut share = cx.audit.light.front.map_or(1.0, |front| span.share(front));
    // Digits enough for the shortest way.
    let decimals = (1.0 - span.finest().log10()).ceil().clamp(2.0, 9.0) as usize;
    // The slider rounds to as many digits as it shows, and would take that for a drag.
    let slider = Slider::new(&mut share, 0.0..=1.0)
        .suffix(format!(" {}", cx.t("audit-meters")))
        .custom_formatter(move |share, _| texts.localized(format!("{:.decimals$}", span.path(share))))
        .custom_parser(move |typed| read(texts, Unit::Meters, typed).map(|path| span.share(path)));
    let response = ui.add(slider).accessible_name(texts.get("audit-front"));
    if response.changed() {
        cx.audit.light.is_running = false;
        cx.audit.light.front = Some(span.path(share)).filter(|_| share < 1.0);
    }
    response.on_hover_text(texts.tip("audit-front").unwrap_or_default());
}

/// How long slow light takes.
fn duration_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let texts = cx.texts;
    let unit = format!(" {}", cx.t("audit-seconds"));
    let slider = Slider::new(&mut cx.audit.light.duration, clock::DURATIONS).logarithmic(true);
    let slider = slider
        .max_decimals(1)
        .suffix(unit)
        .custom_formatter(|seconds, _| shown(texts, seconds, 1))
        .custom_parser(move |typed| read(texts, Unit::None, typed));
    let response = ui.add(slider).accessible_name(texts.get("audit-duration"));
    response.on_hover_text(texts.tip("audit-duration").unwrap_or_default());
}

/// The number that was typed.
fn read(texts: &Texts, unit: Unit, typed: &str) -> Option<f64> {
    evaluate(typed, unit, texts.language().decimal_sign()).ok()
}

fn button(ui: &mut Ui, cx: &mut Cx<'_>, act: AuditCommand) {
    let command = Command::Audit(act);
    let Some(look) = command.look() else { return };
    let situation = cx.situation();
    let name = situation.label(&command);
    let tip = situation.tip(&command).map_or_else(|| name.clone(), |tip| format!("{name}\n{tip}"));
    let is_on = situation.is_on(&command) == Some(true);
    let can = situation.can(&command);
    let icon = if is_on { icons::ICON_PAUSE } else { look.icon };
    let response = ui.add_enabled_ui(can, |ui| explained_icon_button(ui, icon, &name, &tip, is_on)).inner;
    if response.clicked() {
        cx.run(command);
    }
}
