//! The map over the picture, with its legend and the value under the pointer.

mod legend;

use catoptric_lab::maps::MapKind;
use catoptric_scene::Camera;
use egui::{Color32, Painter, Pos2, Rect, Ui, pos2};
use glam::UVec2;

use crate::base::texts::Texts;
use crate::base::{plates, theme};
use crate::state::context::Cx;
use crate::state::maps::{COARSE, MapKey};

/// Draws the map that is wanted over the picture in `rect`, as `camera` sees the scene, and has it made.
pub(crate) fn draw(painter: &Painter, cx: &mut Cx<'_>, rect: Rect, camera: Camera) {
    let Some(kind) = cx.maps.kind else {
        cx.maps.clear();
        return;
    };
    cx.maps.poll(painter.ctx());
    if let Some(texture) = cx.maps.texture() {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(texture.id(), rect, whole, Color32::WHITE);
    }
    let Some((revision, render_scene)) = cx.live.render_scene() else { return };
    let size = (rect.size() * painter.ctx().pixels_per_point()).round();
    let wanted = MapKey {
        kind,
        revision,
        camera,
        size: [size.x as u32, size.y as u32],
        exposure_stops: cx.view.development.exposure_stops,
        step: COARSE,
    };
    let key = match cx.maps.shown() {
        Some((known, _)) if MapKey { step: COARSE, ..*known } != wanted => wanted,
        Some((known, _)) if known.step == COARSE && !cx.view.is_moving => MapKey { step: 1, ..wanted },
        Some(_) => return,
        None => wanted,
    };
    if cx.view.is_measuring {
        return;
    }
    cx.maps.want(painter.ctx(), &key, render_scene);
}

/// The legend, and the value under the pointer.
///
/// `rect` is the whole picture, `visible` what is seen of it.
pub(crate) fn legend_ui(ui: &mut Ui, cx: &Cx<'_>, rect: Rect, visible: Rect) {
    let Some((key, map)) = cx.maps.shown() else { return };
    let is_whole = key.step == 1;
    let [width, height] = key.size.map(f64::from);
    let done = cx.maps.pixels_done().filter(|_| !is_whole);
    let progress = done.map(|done| (done as f64 / (width * height).max(1.0)).min(1.0) as f32);
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let is_over = |pos: &Pos2| visible.contains(*pos) && ui.ctx().layer_id_at(*pos) == Some(ui.layer_id());
    let value = pointer.filter(is_over).and_then(|pos| {
        let share = (pos - rect.min) / rect.size();
        map.value(UVec2::new((share.x * map.width as f32) as u32, (share.y * map.height as f32) as u32))
    });
    legend::legend_ui(ui, cx.texts, visible, map, value, progress);
    if let (Some(pos), Some(value), false) = (pointer, value, cx.view.is_auditing) {
        let palette = theme::palette(ui.visuals());
        let number = number(cx.texts, map.kind, value);
        plates::beside_pointer(&ui.painter_at(visible), visible, pos, &number, palette);
    }
}

/// The message that names a kind of maps.
pub(crate) const fn key_of(kind: MapKind) -> &'static str {
    match kind {
        MapKind::Generations => "map-generations",
        MapKind::Rays => "map-rays",
        MapKind::LimitLoss => "map-limit-loss",
        MapKind::ThresholdLoss => "map-threshold-loss",
        MapKind::Clipped => "map-clipped",
    }
}

/// A number of a map: a percentage, or a count.
fn number(texts: &Texts, kind: MapKind, value: f32) -> String {
    let digits = |value: f32, places: usize| {
        let text = format!("{value:.places$}");
        let short = text.trim_end_matches('0').trim_end_matches('.').to_owned();
        if places == 0 { text } else { texts.localized(short) }
    };
    match kind.is_share() {
        true => texts.with("map-percent", &[("value", digits(100.0 * value, 2).into())]),
        false => digits(value, usize::from(value.fract() != 0.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;

    #[test]
    fn numbers_are_counts_or_percentages() {
        let texts = Texts::new(Language::English);
        assert_eq!(number(&texts, MapKind::Generations, 10.0), "10");
        assert_eq!(number(&texts, MapKind::Rays, 2.5), "2.5");
        assert_eq!(number(&texts, MapKind::Clipped, 0.125), "12.5%");
        assert_eq!(number(&texts, MapKind::LimitLoss, 0.0), "0%");
    }
}
