//! The little bar over the picture.

use catoptric_picture::ToneCurve;
use egui::accesskit::Role;
use egui::scroll_area::ScrollBarVisibility;
use egui::{
    Align2, Color32, CornerRadius, FontId, Frame, Layout, Margin, Popup, PopupCloseBehavior, Rect, Response,
    ScrollArea, Sense, Stroke, StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::{ICON_360, ICON_EXPOSURE};

use super::compass;
use crate::base::widgets::number::Unit;
use crate::base::widgets::slider::SliderField;
use crate::base::widgets::{icon_ui, paint_icon};
use crate::base::{shortcut_text, theme};
use crate::panels::method_chooser::chooser_ui;
use crate::state::command::{AuditCommand, CameraCommand, Command, DisplayCommand, Tool, ToolCommand};
use crate::state::context::Cx;
use crate::state::layout::is_narrow;

/// Side of a button, points.
const BUTTON: f32 = 28.0;

/// How far the exposure can be set, stops.
const STOPS: f64 = 5.0;

/// Draws the bar and, below it, the badge of the free view. Returns how far down they reach, points.
pub(crate) fn toolbar_ui(ui: &mut Ui, cx: &mut Cx<'_>, rect: Rect) -> f32 {
    let beside = if compass::fits(rect) { compass::WIDTH } else { 10.0 };
    let room = Rect::from_min_max(rect.min + Vec2::splat(10.0), rect.max - vec2(beside, 10.0));
    let builder = UiBuilder::new().max_rect(room).layout(Layout::top_down(egui::Align::Min));
    let bar = ui.scope_builder(builder, |ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 6.0);
        row(ui, "tools", |ui| {
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            tools(ui, cx);
            gap(ui);
            shown(ui, cx);
            gap(ui);
            looking(ui, cx);
            gap(ui);
            exposure(ui, cx);
            gap(ui);
            chooser_ui(ui, cx, BUTTON);
        });
        if cx.view.free_camera.is_some() {
            row(ui, "free view", |ui| free_view(ui, cx));
        }
    });
    bar.response.rect.bottom() - rect.top()
}

/// Content on a half-transparent plate, in as many rows as it needs. In narrow windows it is one row that scrolls: several
/// would hide the picture of a telephone.
fn row(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    let palette = theme::palette(ui.visuals());
    Frame::new()
        .fill(palette.panel.gamma_multiply(0.88))
        .stroke(Stroke::new(1.0, palette.line.gamma_multiply(0.8)))
        .corner_radius(CornerRadius::same(7))
        .inner_margin(Margin::same(3))
        .show(ui, |ui| {
            if !is_narrow(ui.ctx().content_rect().size()) {
                ui.horizontal_wrapped(content);
                return;
            }
            // By the wheel of a mouse, too.
            ui.style_mut().always_scroll_the_only_direction = true;
            ScrollArea::horizontal()
                .id_salt(name)
                .scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden)
                .show(ui, |ui| ui.horizontal(content));
        });
}

fn gap(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(9.0, BUTTON), Sense::hover());
    let color = theme::palette(ui.visuals()).line;
    ui.painter().vline(rect.center().x, rect.y_range().shrink(5.0), Stroke::new(1.0, color));
}

fn tools(ui: &mut Ui, cx: &mut Cx<'_>) {
    for tool in [Tool::Move, Tool::Rotate, Tool::Scale] {
        command_button(ui, cx, ToolCommand::Take(tool));
    }
    command_button(ui, cx, ToolCommand::AimLight);
    command_button(ui, cx, Command::Audit(AuditCommand::Tool));
    gap(ui);
    command_button(ui, cx, ToolCommand::ToggleGizmoSpace);
}

fn shown(ui: &mut Ui, cx: &mut Cx<'_>) {
    command_button(ui, cx, DisplayCommand::ToggleGrid);
    command_button(ui, cx, DisplayCommand::ToggleHandles);
}

fn looking(ui: &mut Ui, cx: &mut Cx<'_>) {
    let has_selected = cx.situation().can(&CameraCommand::FrameSelection.into());
    command_button(
        ui,
        cx,
        if has_selected { CameraCommand::FrameSelection } else { CameraCommand::FrameAll },
    );
    command_button(ui, cx, CameraCommand::ToggleProjection);
    command_button(ui, cx, CameraCommand::ToggleFreeView);
    command_button(ui, cx, CameraCommand::ToggleFly);
}

/// Exposure and tone curve, in a popup.
fn exposure(ui: &mut Ui, cx: &mut Cx<'_>) {
    let development = cx.view.development;
    let is_set = development != catoptric_picture::Development::default();
    let name = cx.t("viewport-exposure");
    let tip = cx.texts.tip("viewport-exposure").unwrap_or_default();
    let button = icon_button(ui, ICON_EXPOSURE, name, Some(is_set)).on_hover_text(format!("{name}\n{tip}"));
    if development.exposure_stops != 0.0 {
        let stops = super::labels::signed_stops(cx.texts, development.exposure_stops);
        let text = cx.texts.with("viewport-exposure-stops", &[("stops", stops.into())]);
        let color = theme::palette(ui.visuals()).text;
        let galley = ui.painter().layout_no_wrap(text, FontId::proportional(12.0), color);
        let (rect, _) = ui.allocate_exact_size(vec2(galley.size().x + 8.0, BUTTON), Sense::hover());
        let corner = Align2::LEFT_CENTER.anchor_size(rect.left_center(), galley.size()).min;
        ui.painter().galley(corner, galley, color);
    }
    Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_min_width(250.0);
        exposure_ui(ui, cx);
    });
}

fn exposure_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    ui.spacing_mut().slider_width = 150.0;
    ui.label(cx.t("viewport-exposure-slider"));
    ui.horizontal(|ui| {
        let stops = &mut cx.view.development.exposure_stops;
        let slider = SliderField {
            texts: cx.texts,
            name: cx.texts.get("viewport-exposure-slider"),
            value: *stops,
            range: -STOPS..=STOPS,
            is_logarithmic: false,
            step: 0.05,
            decimals: 2,
            unit: Unit::Stops,
            width: 82.0,
        };
        let (slider, changed) = slider.show(ui);
        *stops = changed.unwrap_or(*stops);
        slider.on_hover_text(cx.texts.tip("viewport-exposure-slider").unwrap_or_default());
    });
    let is_set = cx.view.development.exposure_stops != 0.0;
    let reset = ui.add_enabled(is_set, egui::Button::new(cx.t("viewport-exposure-reset")));
    if reset.clicked() {
        cx.view.development.exposure_stops = 0.0;
    }
    ui.separator();
    ui.label(cx.t("viewport-tone"));
    for (curve, key) in [
        (ToneCurve::None, "viewport-tone-none"),
        (ToneCurve::Reinhard, "viewport-tone-reinhard"),
        (ToneCurve::Filmic, "viewport-tone-filmic"),
        (ToneCurve::LinearCodes, "viewport-tone-linear-codes"),
    ] {
        let name = cx.texts.get(key);
        let choice = ui.radio_value(&mut cx.view.development.tone_curve, curve, name);
        choice.on_hover_text(cx.texts.tip(key).unwrap_or_default());
    }
}

/// Says that the scene's camera stays, and offers to put it here.
fn free_view(ui: &mut Ui, cx: &mut Cx<'_>) {
    let palette = theme::palette(ui.visuals());
    ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
    ui.add_space(4.0);
    icon_ui(ui, ICON_360, 16.0, palette.accent);
    ui.label(cx.t("viewport-free-badge"));
    let put = ui.button(cx.t("viewport-camera-here"));
    if put.on_hover_text(cx.texts.tip("viewport-camera-here").unwrap_or_default()).clicked() {
        cx.run(CameraCommand::FromView);
    }
    let back = ui.button(cx.t("viewport-camera-back"));
    if back.on_hover_text(cx.texts.tip("viewport-camera-back").unwrap_or_default()).clicked() {
        cx.run(CameraCommand::ToggleFreeView);
    }
}

/// A button for a command, with its icon, name and shortcut.
fn command_button(ui: &mut Ui, cx: &mut Cx<'_>, command: impl Into<Command>) {
    let command = command.into();
    let Some(look) = command.look() else { return };
    let situation = cx.situation();
    let name = situation.label(&command);
    let mut tip = name.clone();
    if let Some(shortcut) = look.usable_shortcuts().next() {
        tip = format!("{tip} ({})", shortcut_text::text(ui.ctx(), shortcut));
    }
    if let Some(explained) = situation.tip(&command) {
        tip = format!("{tip}\n{explained}");
    }
    let is_on = situation.is_on(&command);
    if icon_button(ui, look.icon, &name, is_on).on_hover_text(tip).clicked() {
        cx.run(command);
    }
}

/// A flat button with an icon; `is_on` is given for those that can be on.
fn icon_button(ui: &mut Ui, icon: MaterialIcon, name: &str, is_on: Option<bool>) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(BUTTON), Sense::click());
    response.widget_info(|| match is_on {
        Some(is_on) => WidgetInfo::selected(Role::Button, true, is_on, name),
        None => WidgetInfo::labeled(Role::Button, true, name),
    });
    let palette = theme::palette(ui.visuals());
    let is_on = is_on == Some(true);
    let fill = match (is_on, response.hovered()) {
        (true, _) => palette.selection,
        (false, true) => palette.hovered,
        (false, false) => Color32::TRANSPARENT,
    };
    let painter = ui.painter();
    painter.rect_filled(rect, 5.0, fill);
    if response.gained_focus() {
        // The row may have it beyond its end.
        response.scroll_to_me(None);
    }
    if response.has_focus() {
        painter.rect_stroke(rect, 5.0, Stroke::new(1.5, palette.accent), StrokeKind::Inside);
    }
    let color = if is_on || response.hovered() { palette.text } else { palette.text.gamma_multiply(0.85) };
    paint_icon(ui, icon, rect.center(), 17.0, color);
    response
}
