//! Maps over the picture: a number for each pixel, in colors.

use std::sync::Arc;

use catoptric_lab::maps::{Map, MapKind, MapSettings, map};
use catoptric_picture::{scale_color, srgb};
use catoptric_scene::Camera;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use crate::base::latest::Latest;

/// A map is made of one pixel in so many across and down first.
pub(crate) const COARSE: u32 = 6;
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

    /// The finished map and its key, if a map is wanted.
    pub(crate) fn shown(&self) -> Option<&(MapKey, Map)> {
        self.shown.as_ref().filter(|_| self.kind.is_some())
    }

    /// The image of the map that was made last.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// How many pixels are done of the map that is being made.
    pub(crate) fn pixels_done(&self) -> Option<u64> {
        self.work.pixels_done()
    }

    /// Forgets the map, since none is wanted.
    pub(crate) fn clear(&mut self) {
        self.work.cancel();
        self.forget_textures();
    }

    /// Has a map made on a thread.
    pub(crate) fn want(&mut self, context: &Context, key: &MapKey, render_scene: Arc<RenderScene>) {
        let own = *key;
        self.work.want(context, key, move |control| own.carry_out(&render_scene, control));
    }

    /// Takes up a map that is ready.
    pub(crate) fn poll(&mut self, context: &Context) {
        let Some((key, Some(Some(MapImage { map, image })))) = self.work.poll() else { return };
        let is_whole = key.step == 1;
        let options = if is_whole { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(context.load_texture("map", image, options)),
        }
        self.shown = Some((key, map));
    }
}

/// The inputs of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MapKey {
    pub(crate) kind: MapKind,
    pub(crate) revision: u64,
    pub(crate) camera: Camera,
    pub(crate) size: [u32; 2],
    pub(crate) exposure_stops: f64,
    /// Pixels of the picture to a pixel of the map, across and down.
    pub(crate) step: u32,
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
pub(crate) fn scale(share: f32) -> Color32 {
    let light = scale_color(f64::from(share));
    let [red, green, blue] = light.map(|part| (255.0 * srgb::encode(f64::from(part))).round() as u8);
    Color32::from_rgb(red, green, blue)
}
