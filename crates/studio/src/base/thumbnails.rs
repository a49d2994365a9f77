//! Small pictures of scenes, traced in the background, one after another.

use catoptric_picture::Development;
use catoptric_scene::Scene;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use crate::base::latest::Latest;

/// The most pictures that are kept; the oldest that are not wanted go first.
const MOST: usize = 250;

/// The pictures so far, each of what its key stands for.
pub(crate) struct Thumbnails<K> {
    /// Of some scenes there can be no picture.
    pictures: Vec<(K, Option<TextureHandle>)>,
    work: Latest<K, TracedThumbnail>,
}

/// The finished picture, or `None` if the request was superseded.
type TracedThumbnail = Option<Option<ColorImage>>;

impl<K> Default for Thumbnails<K> {
    fn default() -> Self {
        Self { pictures: Vec::new(), work: Latest::default() }
    }
}

impl<K: Clone + PartialEq + Send + 'static> Thumbnails<K> {
    /// Takes up what has been traced, and has the first of `wanted` traced of which there is no picture yet: `scene`,
    /// called in the background, tells what that shows and how it is traced. To be asked in every frame.
    pub(crate) fn want(
        &mut self,
        context: &Context,
        wanted: &[K],
        scene: fn(&K) -> Option<(Scene, RenderSettings)>,
    ) {
        self.poll(context, wanted);
        let is_missing = |key: &&K| !self.pictures.iter().any(|(other, _)| other == *key);
        // What is under way is finished if it is wanted at all.
        let under_way = self.work.key().filter(|key| wanted.contains(key));
        let Some(key) = under_way.or_else(|| wanted.iter().find(is_missing)).cloned() else { return };
        let own = key.clone();
        self.work.want(context, &key, move |control| {
            let picture = scene(&own).and_then(|(scene, settings)| trace(&scene, settings, control));
            (!control.is_cancelled()).then_some(picture)
        });
    }

    fn poll(&mut self, context: &Context, wanted: &[K]) {
        let Some((key, traced)) = self.work.poll() else { return };
        // What broke down would do so again.
        let Some(picture) = traced.unwrap_or(Some(None)) else { return };
        let texture = picture.map(|image| context.load_texture("thumbnail", image, TextureOptions::LINEAR));
        if self.pictures.len() >= MOST {
            let oldest = self.pictures.iter().position(|(other, _)| !wanted.contains(other));
            self.pictures.remove(oldest.unwrap_or(0));
        }
        self.pictures.push((key, texture));
    }

    /// The device of the window is another: the pictures are traced again.
    pub(crate) fn forget_textures(&mut self) {
        self.pictures.clear();
    }

    /// How many pictures there are.
    pub(crate) fn count(&self) -> usize {
        self.pictures.iter().filter(|(_, picture)| picture.is_some()).count()
    }

    /// The picture, if it is there.
    pub(crate) fn get(&self, key: &K) -> Option<&TextureHandle> {
        self.pictures.iter().find(|(other, _)| other == key)?.1.as_ref()
    }
}

fn trace(scene: &Scene, settings: RenderSettings, control: &RenderControl) -> Option<ColorImage> {
    let render_scene = RenderScene::build(scene).ok()?;
    let picture = render(&render_scene, settings, control).ok()?.picture;
    let mut pixels = vec![[0; 4]; picture.pixels().len()];
    Development::default().develop_rgba8(picture.pixels(), &mut pixels);
    let size = [settings.width, settings.height].map(|side| side as usize);
    Some(ColorImage::from_rgba_unmultiplied(size, pixels.as_flattened()))
}
