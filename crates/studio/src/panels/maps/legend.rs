//! The legend of a map: what it shows, and its scale.

use catoptric_lab::maps::{Map, MapKind};
use egui::accesskit::Role;
use egui::{
    Align2, Color32, FontId, Id, Rect, Sense, Stroke, StrokeKind, Ui, Visuals, WidgetInfo, pos2, vec2,
};

use super::{key_of, number};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::state::maps::scale;

/// Size of the legend, points.
const WIDTH: f32 = 330.0;
const HEIGHT: f32 = 62.0;
/// Room at its sides.
const SIDE: f32 = 14.0;
/// More steps than this are shown as an even scale.
const MOST_STEPS: f32 = 20.0;

/// Draws the legend at the lower left corner of `rect`, with a mark at `value`; `progress` tells how far a finer map
/// is, 0 to 1.
pub(super) fn legend_ui(
    ui: &mut Ui,
    texts: &Texts,
    rect: Rect,
    map: &Map,
    value: Option<f32>,
    progress: Option<f32>,
) {
    let palette = theme::palette(&Visuals::dark());
    let size = vec2(WIDTH.min(rect.width() - 16.0), HEIGHT);
    let plate = Rect::from_min_size(rect.left_bottom() + vec2(8.0, -8.0 - size.y), size);
    let painter = ui.painter_at(rect);
    painter.rect(
        plate,
        6.0,
        palette.panel.gamma_multiply(0.94),
        Stroke::new(1.0, palette.line),
        StrokeKind::Inside,
    );
    let title = texts.get(key_of(map.kind));
    let mean = number(texts, map.kind, map.mean() as f32);
    let note = match progress {
        Some(progress) => {
            texts.with("map-refining", &[("percent", format!("{:.0}", 100.0 * progress).into())])
        }
        None => texts.with("map-mean", &[("value", mean.into())]),
    };
    let (big, small) = (FontId::proportional(12.5), FontId::proportional(11.0));
    let top = plate.top() + 13.0;
    painter.text(pos2(plate.left() + SIDE, top), Align2::LEFT_CENTER, title, big, palette.text);
    painter.text(pos2(plate.right() - SIDE, top), Align2::RIGHT_CENTER, &note, small.clone(), palette.weak);
    let bar = Rect::from_min_max(plate.left_top() + vec2(SIDE, 25.0), plate.right_top() + vec2(-SIDE, 37.0));
    let end = map.scale_end();
    let has_steps = map.kind == MapKind::Generations && end <= MOST_STEPS;
    let count = if has_steps { end as usize + 1 } else { bar.width() as usize };
    let width = bar.width() / count.max(1) as f32;
    for place in 0..count {
        let share = place as f32 / count.saturating_sub(1).max(1) as f32;
        let left = bar.left() + width * place as f32;
        let cell = Rect::from_min_max(pos2(left, bar.top()), pos2(left + width + 0.5, bar.bottom()));
        painter.rect_filled(cell, 0.0, scale(share));
    }
    // Numbers of steps stand below their middles.
    let at = |value: f32| match has_steps {
        true => bar.left() + width * (value + 0.5),
        false => bar.left() + bar.width() * (value / end).clamp(0.0, 1.0),
    };
    let ticks = if has_steps { count - 1 } else { 4 };
    for tick in 0..=ticks {
        let value = end * tick as f32 / ticks as f32;
        let value = if map.kind.is_share() { value } else { value.round() };
        let text = number(texts, map.kind, value);
        painter.text(
            pos2(at(value), bar.bottom() + 11.0),
            Align2::CENTER_CENTER,
            text,
            small.clone(),
            palette.weak,
        );
    }
    if let Some(value) = value {
        let mark = Rect::from_center_size(pos2(at(value), bar.center().y), vec2(3.0, bar.height() + 6.0));
        painter.rect(mark, 1.0, Color32::WHITE, Stroke::new(1.0, Color32::BLACK), StrokeKind::Outside);
    }
    tell(ui, plate, (texts, map), &format!("{title}: {note}"));
}

fn tell(ui: &Ui, plate: Rect, (texts, map): (&Texts, &Map), name: &str) {
    let response = ui.interact(plate, Id::unique("map legend"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
    let mut tip = texts.tip(key_of(map.kind)).unwrap_or_default().to_owned();
    if map.incomplete > 0 {
        tip.push(' ');
        tip.push_str(&texts.with("map-incomplete", &[("count", map.incomplete.into())]));
    }
    response.on_hover_text(tip);
}
