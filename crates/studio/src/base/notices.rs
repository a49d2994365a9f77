//! Short notices in the corner: they fade by themselves, and can be read by screen readers and tests.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Align2, Area, Color32, Context, Id, Order, Rect, Sense, TextStyle, Ui, UiBuilder, UiKind, Vec2};
use egui::{WidgetInfo, pos2, vec2};
use egui_material_icons::{MaterialIcon, icons};

use crate::base::theme;
use crate::base::widgets::{ICON_BUTTON, icon_button, paint_icon};

/// How long a notice stays.
const STAY: Duration = Duration::from_secs(6);

/// Width of a notice without its frame, points.
const WIDTH: f32 = 330.0;

/// How many notices are shown at most; older ones give way.
const MOST: usize = 4;

/// The kind of a notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NoticeKind {
    Success,
    Info,
    Warning,
    Error,
}

/// One notice.
#[derive(Clone, Debug)]
pub(crate) struct Notice {
    kind: NoticeKind,
    text: String,
    /// What is left of its time, seconds; `None` stays until it is closed.
    left: Option<f32>,
}

impl Notice {
    /// How long it stays; `None` until it is closed.
    pub(crate) fn duration(&mut self, duration: Option<Duration>) -> &mut Self {
        self.left = duration.map(|duration| duration.as_secs_f32());
        self
    }
}

/// All notices that are shown, the oldest first.
#[derive(Debug, Default)]
pub(crate) struct Toasts {
    notices: Vec<Notice>,
}

impl Toasts {
    /// Something has been done.
    pub(crate) fn success(&mut self, text: impl Into<String>) -> &mut Notice {
        self.add(NoticeKind::Success, text.into())
    }

    /// Something to know.
    pub(crate) fn info(&mut self, text: impl Into<String>) -> &mut Notice {
        self.add(NoticeKind::Info, text.into())
    }

    /// Something was not done.
    pub(crate) fn warning(&mut self, text: impl Into<String>) -> &mut Notice {
        self.add(NoticeKind::Warning, text.into())
    }

    /// Something has failed; it stays longer.
    pub(crate) fn error(&mut self, text: impl Into<String>) -> &mut Notice {
        self.add(NoticeKind::Error, text.into()).duration(Some(3 * STAY))
    }

    fn add(&mut self, kind: NoticeKind, text: String) -> &mut Notice {
        // The same news twice is said once, anew.
        self.notices.retain(|notice| notice.text != text);
        let surplus = (self.notices.len() + 1).saturating_sub(MOST);
        self.notices.drain(..surplus);
        self.notices.push_mut(Notice { kind, text, left: Some(STAY.as_secs_f32()) })
    }

    /// Draws them at the lower right, above the status bar; `close` names the button that closes one.
    pub(crate) fn show(&mut self, context: &Context, close: &str) {
        if self.notices.is_empty() {
            return;
        }
        let area = Area::new(Id::unique("notices"))
            .kind(UiKind::Tooltip)
            .order(Order::Foreground)
            .anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -40.0))
            .show(context, |ui| {
                ui.spacing_mut().item_spacing = Vec2::splat(8.0);
                let mut closed = None;
                for (place, notice) in self.notices.iter().enumerate() {
                    if notice_ui(ui, notice, close) {
                        closed = Some(place);
                    }
                }
                if let Some(place) = closed {
                    self.notices.remove(place);
                }
            });
        // A notice under the pointer is being read.
        if area.response.contains_pointer() {
            return;
        }
        let passed = context.input(|input| input.unstable_dt.min(0.1));
        for notice in &mut self.notices {
            if let Some(left) = &mut notice.left {
                *left -= passed;
            }
        }
        self.notices.retain(|notice| notice.left.is_none_or(|left| left > 0.0));
        let next = self.notices.iter().filter_map(|notice| notice.left).fold(f32::INFINITY, f32::min);
        if next.is_finite() {
            context.request_repaint_after(Duration::from_secs_f32(next.clamp(0.05, 0.1)));
        }
    }
}

/// Draws a notice; returns whether it is to be closed.
fn notice_ui(ui: &mut Ui, notice: &Notice, close: &str) -> bool {
    let palette = theme::palette(ui.visuals());
    let (icon, color): (MaterialIcon, _) = match notice.kind {
        NoticeKind::Success => (icons::ICON_CHECK_CIRCLE, palette.axes[1]),
        NoticeKind::Info => (icons::ICON_INFO, palette.accent),
        NoticeKind::Warning => (icons::ICON_WARNING, palette.warning),
        NoticeKind::Error => (icons::ICON_ERROR, palette.error),
    };
    let frame = egui::Frame::popup(ui.style()).inner_margin(egui::Margin::symmetric(12, 9));
    frame.show(ui, |ui| body_ui(ui, &notice.text, (icon, color), close)).inner
}

/// The icon and the button stand beside the first line of the text.
fn body_ui(ui: &mut Ui, text: &str, (icon, color): (MaterialIcon, Color32), close: &str) -> bool {
    let font = TextStyle::Body.resolve(ui.style());
    let text_color = ui.visuals().text_color();
    let galley = ui.painter().layout(text.to_owned(), font, text_color, WIDTH - 62.0);
    let line = galley.rows.first().map_or(16.0, |row| row.rect().height());
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, galley.size().y), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    let middle = rect.top() + line / 2.0;
    paint_icon(ui, icon, pos2(rect.left() + 9.0, middle), 18.0, color);
    ui.painter().galley(rect.min + vec2(28.0, 0.0), galley, text_color);
    let button = Rect::from_center_size(pos2(rect.right() - 9.0, middle), Vec2::splat(ICON_BUTTON));
    let builder = UiBuilder::new().max_rect(button);
    ui.scope_builder(builder, |ui| icon_button(ui, icons::ICON_CLOSE, close, false)).inner.clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_news_is_said_once_and_old_news_gives_way() {
        let mut toasts = Toasts::default();
        for text in ["a", "b", "a", "c", "d", "e"] {
            toasts.info(text);
        }
        let texts: Vec<&str> = toasts.notices.iter().map(|notice| notice.text.as_str()).collect();
        assert_eq!(texts, ["a", "c", "d", "e"]);
    }
}
