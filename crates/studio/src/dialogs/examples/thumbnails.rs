//! Small pictures of the built-in scenes, traced in the background, one after another.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};

use catoptric_picture::Development;
use catoptric_scene::Example;
use catoptric_tracer::{Control, RenderSettings, Stage, render};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};

/// Width and height, pixels.
pub(crate) const SIZE: [u32; 2] = [288, 162];
const SAMPLES: u32 = 4;

/// The pictures so far; they stay as long as the studio.
#[derive(Default)]
pub(crate) struct Thumbnails {
    pictures: Vec<Option<TextureHandle>>,
}

/// The thread that traces. Dropping it cancels the picture under way.
pub(crate) struct Work {
    results: Receiver<(usize, ColorImage)>,
    control: Arc<Control>,
}

impl Drop for Work {
    fn drop(&mut self) {
        self.control.cancel();
    }
}

impl Thumbnails {
    /// Begins to trace what is missing.
    pub(crate) fn begin(&mut self, context: &Context) -> Option<Work> {
        self.pictures.resize(Example::ALL.len(), None);
        let missing: Vec<usize> = (0..self.pictures.len())
            .filter(|index| matches!(self.pictures.get(*index), Some(None)))
            .collect();
        if missing.is_empty() {
            return None;
        }
        let (sender, results) = mpsc::channel();
        let control = Arc::new(Control::default());
        let (context, cancelled) = (context.clone(), Arc::clone(&control));
        let work = move || {
            for index in missing {
                let picture = Example::ALL.get(index).and_then(|example| trace(example, &cancelled));
                if cancelled.is_cancelled() {
                    return;
                }
                if let Some(picture) = picture
                    && sender.send((index, picture)).is_err()
                {
                    return;
                }
                context.request_repaint();
            }
        };
        // Without a thread, the placeholders stay.
        let started = std::thread::Builder::new().name("thumbnails".to_owned()).spawn(work);
        started.ok().map(|_| Work { results, control })
    }

    /// Takes up what has been traced.
    pub(crate) fn poll(&mut self, context: &Context, work: &Work) {
        while let Ok((index, picture)) = work.results.try_recv() {
            let texture = context.load_texture(format!("example {index}"), picture, TextureOptions::LINEAR);
            if let Some(place) = self.pictures.get_mut(index) {
                *place = Some(texture);
            }
        }
    }

    /// The picture of the example at this place, if it is there.
    pub(crate) fn get(&self, index: usize) -> Option<&TextureHandle> {
        self.pictures.get(index)?.as_ref()
    }
}

fn trace(example: &Example, control: &Control) -> Option<ColorImage> {
    let scene = example.load().ok()?.scene;
    let stage = Stage::prepare(&scene).ok()?;
    let [width, height] = SIZE;
    let picture = render(&stage, RenderSettings { width, height, samples: SAMPLES }, control).ok()?.picture;
    let mut pixels = vec![[0; 4]; picture.pixels().len()];
    Development::default().develop_rgba8(picture.pixels(), &mut pixels);
    Some(ColorImage::from_rgba_unmultiplied(SIZE.map(|side| side as usize), pixels.as_flattened()))
}
