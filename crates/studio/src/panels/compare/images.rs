//! The pictures in the memory of whatever draws the window.

use std::sync::Arc;

use catoptric_picture::Development;
use egui::{ColorImage, Context, TextureFilter, TextureHandle, TextureOptions};

use super::task::{CompareResult, image};
use crate::base::job::{Job, JobStatus};

/// Pixels stay pixels when they are enlarged.
const OPTIONS: TextureOptions = TextureOptions {
    magnification: TextureFilter::Nearest,
    minification: TextureFilter::Linear,
    ..TextureOptions::LINEAR
};

/// The images of a comparison, as textures.
#[derive(Default)]
pub(super) struct CompareImages {
    of: Option<Arc<CompareResult>>,
    /// The two pictures, as they were developed.
    pictures: Option<(Development, [TextureHandle; 2])>,
    developing: Option<(Development, Job<[ColorImage; 2]>)>,
    difference: Option<TextureHandle>,
    flip: Option<TextureHandle>,
    reasons: Option<TextureHandle>,
}

impl CompareImages {
    /// Brings the images up to `found` and `development`, as soon as they are developed.
    pub(super) fn keep_up(
        &mut self,
        context: &Context,
        found: &Arc<CompareResult>,
        development: Development,
    ) {
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, found)) {
            *self = Self { of: Some(Arc::clone(found)), pictures: self.pictures.take(), ..Self::default() };
            let load = |name: &str, image: &ColorImage| context.load_texture(name, image.clone(), OPTIONS);
            self.difference = Some(load("difference", &found.difference));
            self.flip = Some(load("flip", &found.flip));
            self.reasons = found.reasons.as_ref().map(|image| load("reasons", image));
            self.develop(context, found, development);
        }
        if let Some((of, job)) = self.developing.take() {
            match job.poll() {
                JobStatus::Waiting => self.developing = Some((of, job)),
                JobStatus::Lost => {}
                JobStatus::Done([a, b]) => {
                    let load = |name: &str, image| context.load_texture(name, image, OPTIONS);
                    self.pictures = Some((of, [load("picture A", a), load("picture B", b)]));
                }
            }
        }
        let is_current = self.pictures.as_ref().is_some_and(|(shown, _)| *shown == development);
        if !is_current && self.developing.is_none() {
            self.develop(context, found, development);
        }
    }

    fn develop(&mut self, context: &Context, found: &Arc<CompareResult>, development: Development) {
        let own = Arc::clone(found);
        let work = move || {
            let developed = |index: usize| {
                let picture = own.compared.contenders.get(index).map(|contender| &contender.picture);
                picture.map(|picture| image(picture, development)).unwrap_or_default()
            };
            [developed(0), developed(1)]
        };
        self.developing = Job::start(context, "develop", work).ok().map(|job| (development, job));
    }

    /// The two pictures.
    pub(super) fn pictures(&self) -> Option<&[TextureHandle; 2]> {
        self.pictures.as_ref().map(|(_, pictures)| pictures)
    }

    /// By how much they differ.
    pub(super) fn difference(&self) -> Option<&TextureHandle> {
        self.difference.as_ref()
    }

    /// How different they look.
    pub(super) fn flip(&self) -> Option<&TextureHandle> {
        self.flip.as_ref()
    }

    /// Why they differ.
    pub(super) fn reasons(&self) -> Option<&TextureHandle> {
        self.reasons.as_ref()
    }
}
