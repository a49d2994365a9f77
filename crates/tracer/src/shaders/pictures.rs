//! The pictures of a scene as the shaders read them.

use crate::transport::environment::EnvironmentLight;
use crate::transport::scene::RenderScene;
use crate::transport::texture::ImageTexture;
use crate::transport::texture::lookup::ImageLookup;

/// Texels to a row of the texture in which all pictures lie. Cards have no narrower limit (WebGPU's is the same).
pub const PICTURES_ACROSS: u32 = 8192;

/// A texel: the record of a picture (its first pixel, width and height), or a pixel.
pub type AtlasTexel = [u32; 4];

/// All pictures of a scene, each once, that around the bodies first. They are kept while this is, and equal only to
/// themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureAtlas(Vec<ImageLookup>);

impl PictureAtlas {
    pub(crate) fn of(scene: &RenderScene) -> Self {
        let around = match &scene.sky {
            EnvironmentLight::Picture { image, .. } => Some(image),
            _ => None,
        };
        let textures = scene.materials.iter().filter_map(|material| material.texture.as_ref());
        let mut on_bodies: Vec<&ImageLookup> =
            textures.map(ImageTexture::image).filter(|image| Some(*image) != around).collect();
        // An order that does not change with the materials': else all pictures would be sent again.
        on_bodies.sort_unstable_by_key(|image| image.number());
        on_bodies.dedup();
        Self(around.into_iter().chain(on_bodies).cloned().collect())
    }

    /// A picture in the place of a color: no color is below 0.
    pub(crate) fn in_place_of_color(&self, texture: &ImageTexture) -> [f32; 3] {
        let place = self.0.iter().position(|image| image == texture.image()).unwrap_or_default();
        [-1.0 - place as f32, 0.0, 0.0]
    }

    /// Rows of texels.
    pub fn rows(&self) -> u64 {
        let pixels = |image: &ImageLookup| image.pixels().len() as u64;
        let texels = self.0.iter().map(|image| 1 + pixels(image)).sum::<u64>();
        texels.div_ceil(u64::from(PICTURES_ACROSS))
    }

    /// All texels, so many whole rows at a time or fewer.
    pub fn pieces(&self, rows: usize) -> impl Iterator<Item = Vec<AtlasTexel>> {
        const ACROSS: usize = PICTURES_ACROSS as usize;
        let mut first = self.0.len();
        let records = self.0.iter().map(move |image| {
            let record = [first as u32, image.width(), image.height(), 0];
            first += image.pixels().len();
            record
        });
        let pixels = self.0.iter().flat_map(ImageLookup::pixels);
        let mut texels = records.chain(pixels.map(|pixel| {
            let [red, green, blue] = pixel.map(f32::to_bits);
            [red, green, blue, 0]
        }));
        std::iter::from_fn(move || {
            let mut piece: Vec<AtlasTexel> = texels.by_ref().take(rows * ACROSS).collect();
            piece.resize(piece.len().next_multiple_of(ACROSS), [0; 4]);
            Some(piece).filter(|piece| !piece.is_empty())
        })
    }
}
