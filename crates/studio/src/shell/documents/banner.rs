//! The banner about problems, files under way, and the drop target.

use std::sync::Arc;

use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::Diagnostics;
use egui::{Align, Align2, Area, Frame, Id, Label, Layout, Margin, Order, Panel, Spinner, Ui, vec2};
use egui_material_icons::icons;

use super::watch;
use crate::base::theme;
use crate::base::widgets::icon_ui;
use crate::base::words::name_of;
use crate::shell::studio::Studio;
use crate::state::layout::{self, Pane};

/// Shorter work is not displayed.
const PATIENCE: Duration = Duration::from_millis(300);

/// Lists what was found in the document's file. Notes are listed without a banner: nothing is wrong.
pub(super) fn show_findings(studio: &mut Studio, text: Arc<str>, findings: Diagnostics) {
    if findings.is_empty() {
        clear_findings(studio);
        return;
    }
    let errors =
        findings.iter().filter(|finding| finding.severity == catoptric_scene::Severity::Error).count();
    let (errors, others) = (errors + findings.omitted(), findings.len() - errors);
    let problems = &mut studio.panes.problems;
    problems.set(studio.editor.title(), text, findings, studio.editor.scene());
    if problems.has_only_notes() {
        studio.documents.notice.banner = None;
        hide_pane(studio);
        return;
    }
    studio.documents.notice.banner = Some((errors, others - problems.note_count()));
    studio.documents.notice.has_shown_pane |= !layout::is_visible(&studio.layout, Pane::Problems);
    layout::set_visible(&mut studio.layout, Pane::Problems, true);
}

/// Lists nothing any more.
pub(super) fn clear_findings(studio: &mut Studio) {
    studio.documents.notice.banner = None;
    studio.panes.problems.clear();
    hide_pane(studio);
}

/// Hides the panel of problems if only the document has opened it.
fn hide_pane(studio: &mut Studio) {
    if std::mem::take(&mut studio.documents.notice.has_shown_pane) {
        layout::set_visible(&mut studio.layout, Pane::Problems, false);
    }
}

/// Whether the panel of problems is open only because of this document.
pub(super) fn has_shown_pane(studio: &Studio) -> bool {
    studio.documents.notice.has_shown_pane && layout::is_visible(&studio.layout, Pane::Problems)
}

/// Draws the banners about a file that another program has changed, and about one with problems.
pub(crate) fn banner_ui(ui: &mut Ui, studio: &mut Studio) {
    watch::banner_ui(ui, studio);
    let Some((errors, warnings)) = studio.documents.notice.banner else { return };
    let palette = theme::palette(ui.visuals());
    let (icon, color) =
        if errors > 0 { (icons::ICON_ERROR, palette.error) } else { (icons::ICON_WARNING, palette.warning) };
    let texts = &studio.texts;
    let text = if errors > 0 {
        texts.with("banner-problems", &[("number", (errors + warnings).into())])
    } else {
        texts.with("banner-warnings", &[("number", warnings.into())])
    };
    let frame = Frame::new().fill(palette.field).inner_margin(Margin::symmetric(10, 4));
    let (mut show, mut dismiss) = (false, false);
    Panel::top("problems banner").frame(frame).show_separator_line(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            icon_ui(ui, icon, 16.0, color);
            ui.add(Label::new(text).truncate());
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                dismiss = ui.button(texts.get("banner-dismiss")).clicked();
                show = ui.button(texts.get("banner-show")).clicked();
            });
        });
    });
    if show {
        layout::set_visible(&mut studio.layout, Pane::Problems, true);
    }
    if dismiss {
        studio.documents.notice.banner = None;
    }
}

/// Draws what is being opened or saved, over the window, and where a file can be dropped.
pub(crate) fn progress_ui(ui: &mut Ui, studio: &mut Studio) {
    let documents = &studio.documents;
    let under_way = match (&documents.saving, &documents.reading) {
        (Some(saving), _) => Some(("saving", name_of(saving.path()), saving.since())),
        (None, Some(reading)) => Some(("opening", name_of(&reading.path), reading.since())),
        (None, None) => None,
    };
    if let Some((key, name, since)) = under_way {
        let passed = Instant::now().saturating_duration_since(since);
        if passed < PATIENCE {
            ui.ctx().request_repaint_after(PATIENCE - passed);
        } else {
            let text = studio.texts.with(key, &[("name", name.into())]);
            let area = Area::new(Id::unique("file under way")).order(Order::Foreground);
            area.anchor(Align2::CENTER_TOP, vec2(0.0, 48.0)).interactable(false).show(ui.ctx(), |ui| {
                Frame::popup(ui.style()).inner_margin(Margin::symmetric(14, 8)).show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.add(Spinner::new().size(16.0));
                        ui.label(text);
                    });
                });
            });
        }
    }
    if ui.input(|input| !input.raw.hovered_files.is_empty()) {
        drop_ui(ui, studio.texts.get("drop-here"));
    }
}

fn drop_ui(ui: &Ui, text: &str) {
    let palette = theme::palette(ui.visuals());
    let rect = ui.ctx().content_rect();
    let layer = egui::LayerId::new(Order::Foreground, Id::unique("drop here"));
    let painter = ui.ctx().layer_painter(layer);
    painter.rect_filled(rect, 0.0, egui::Color32::from_black_alpha(140));
    let stroke = egui::Stroke::new(2.0, palette.accent);
    painter.rect_stroke(rect.shrink(12.0), 10.0, stroke, egui::StrokeKind::Inside);
    let font = egui::FontId::proportional(20.0);
    painter.text(rect.center(), Align2::CENTER_CENTER, text, font, egui::Color32::WHITE);
}
