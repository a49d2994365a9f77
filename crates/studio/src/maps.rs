//! Maps over the picture: a number for each pixel, in colors, with a legend and the value under the pointer.

mod legend;

use catoptric_lab::maps::{Map, MapKind, MapSettings, map};
use catoptric_picture::{scale_color, srgb};
use catoptric_scene::Camera;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use egui::{Color32, ColorImage, Context, Painter, Pos2, Rect, TextureHandle, TextureOptions, Ui, pos2};
use glam::UVec2;

use crate::context::Cx;
use crate::latest::Latest;
use crate::texts::Texts;
use crate::viewport;

/// A map is made of one pixel in so many across and down first.
const COARSE: u32 = 6;
/// Colors of a map.
const SHADES: usize = 512;

/// The map of the window, if one is displayed.
#[derive(Default)]
pub(crate) struct MapState {
    pub(crate) kind: Option<MapKind>,
    work: Latest<MapKey, Option<MapImage>>,
    shown: Option<(MapKey, Map)>,
    texture: Option<TextureHandle>,
}

impl MapState {
    /// The device of the window is another: the map is made again.
    pub(crate) fn forget_textures(&mut self) {
        (self.shown, self.texture) = (None, None);
    }
}

/// The inputs of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MapKey {
    kind: MapKind,
    revision: u64,
    camera: Camera,
    size: [u32; 2],
    exposure_stops: f64,
    /// Pixels of the picture to a pixel of the map, across and down.
    step: u32,
}

/// A map and its image.
struct MapImage {
    map: Map,
    image: ColorImage,
}

impl MapKey {
    fn carry_out(self, render_scene: &RenderScene, control: &RenderControl) -> Option<MapImage> {
        let [width, height] = self.size.map(|side| side.div_ceil(self.step).max(1));
        let settings = MapSettings {
            kind: self.kind,
            picture: RenderSettings { width, height, samples: 1 },
            exposure_stops: self.exposure_stops,
        };
        let map = map(render_scene, &render_scene.camera_for(&self.camera), &settings, control).ok()?;
        // A scale of so many colors looks even.
        let scale: Vec<Color32> =
            (0..SHADES).map(|shade| scale(shade as f32 / (SHADES - 1) as f32)).collect();
        let end = map.scale_end();
        let shade = |value: &f32| ((value / end).clamp(0.0, 1.0) * (SHADES - 1) as f32).round() as usize;
        let pixels = map.values.iter().map(|value| scale.get(shade(value)).copied().unwrap_or_default());
        let pixels = pixels.collect();
        let image = ColorImage::new([width as usize, height as usize], pixels);
        Some(MapImage { map, image })
    }
}

/// The color of the scale at `share`, 0 to 1, as a display shows it.
fn scale(share: f32) -> Color32 {
    let light = scale_color(f64::from(share));
    let [red, green, blue] = light.map(|part| (255.0 * srgb::encode(f64::from(part))).round() as u8);
    Color32::from_rgb(red, green, blue)
}

/// Draws the map that is wanted over the picture in `rect`, as `camera` sees the scene, and has it made.
pub(crate) fn draw(painter: &Painter, cx: &mut Cx<'_>, rect: Rect, camera: Camera) {
    let Some(kind) = cx.maps.kind else {
        cx.maps.work.cancel();
        (cx.maps.shown, cx.maps.texture) = (None, None);
        return;
    };
    poll(painter.ctx(), cx.maps);
    if let Some(texture) = &cx.maps.texture {
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
    let key = match &cx.maps.shown {
        Some((known, _)) if MapKey { step: COARSE, ..*known } != wanted => wanted,
        Some((known, _)) if known.step == COARSE && !cx.view.is_moving => MapKey { step: 1, ..wanted },
        Some(_) => return,
        None => wanted,
    };
    if cx.view.is_measuring {
        return;
    }
    cx.maps.work.want(painter.ctx(), &key, move |control| key.carry_out(&render_scene, control));
}

/// Takes up a map that is ready.
fn poll(context: &Context, maps: &mut MapState) {
    let Some((key, Some(Some(MapImage { map, image })))) = maps.work.poll() else { return };
    let is_whole = key.step == 1;
    let options = if is_whole { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
    match &mut maps.texture {
        Some(texture) => texture.set(image, options),
        None => maps.texture = Some(context.load_texture("map", image, options)),
    }
    maps.shown = Some((key, map));
}

/// The legend, and the value under the pointer.
///
/// `rect` is the whole picture, `visible` what is seen of it.
pub(crate) fn legend_ui(ui: &mut Ui, cx: &Cx<'_>, rect: Rect, visible: Rect) {
    let Some((key, map)) = cx.maps.shown.as_ref().filter(|_| cx.maps.kind.is_some()) else { return };
    let is_whole = key.step == 1;
    let [width, height] = key.size.map(f64::from);
    let done = cx.maps.work.pixels_done().filter(|_| !is_whole);
    let progress = done.map(|done| (done as f64 / (width * height).max(1.0)).min(1.0) as f32);
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let is_over = |pos: &Pos2| visible.contains(*pos) && ui.ctx().layer_id_at(*pos) == Some(ui.layer_id());
    let value = pointer.filter(is_over).and_then(|pos| {
        let share = (pos - rect.min) / rect.size();
        map.value(UVec2::new((share.x * map.width as f32) as u32, (share.y * map.height as f32) as u32))
    });
    legend::legend_ui(ui, cx.texts, visible, map, value, progress);
    if let (Some(pos), Some(value), false) = (pointer, value, cx.view.is_auditing) {
        let palette = crate::theme::palette(ui.visuals());
        viewport::note_beside(
            &ui.painter_at(visible),
            visible,
            pos,
            &number(cx.texts, map.kind, value),
            palette,
        );
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
    use crate::texts::Language;

    #[test]
    fn numbers_are_counts_or_percentages() {
        let texts = Texts::new(Language::English);
        assert_eq!(number(&texts, MapKind::Generations, 10.0), "10");
        assert_eq!(number(&texts, MapKind::Rays, 2.5), "2.5");
        assert_eq!(number(&texts, MapKind::Clipped, 0.125), "12.5%");
        assert_eq!(number(&texts, MapKind::LimitLoss, 0.0), "0%");
    }
}
