//! Comparison of pictures of the same view with the first of them.

use std::time::Duration;

use catoptric_picture::{
    CompareError as PictureError, Comparison, Difference, Flip, FlipMap, Picture, SizeError, ssim,
};
use catoptric_scene::Scene;
use catoptric_tracer::raster::{MethodError, MethodOutput, PassName, ReasonMap, draw, reasons};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, SceneBuildError};

use crate::measure::summarize;
use crate::variant::Variant;

/// A picture that takes part.
#[derive(Clone, Debug)]
pub struct Contender {
    /// What it is called in the report.
    pub name: String,
    /// Linear light.
    pub picture: Picture,
    /// How it came about, if it was drawn here.
    pub drawn: Option<ContenderPicture>,
}

/// The times of a contender, and the reasons of its differences.
#[derive(Clone, Debug)]
pub struct ContenderPicture {
    /// The median time of each pass, milliseconds.
    pub passes: Vec<(PassName, f64)>,
    /// The median time of all passes together, milliseconds.
    pub time: f64,
    /// How often it was drawn for that.
    pub runs: u32,
    /// The reasons why its pixels differ from the traced ones; `None` for the truth itself and where they are not
    /// known.
    pub reasons: Option<ReasonMap>,
}

/// The measures of a contender's difference from the truth.
#[derive(Clone, Debug)]
pub struct Metrics {
    /// Channel by channel.
    pub difference: Difference,
    /// Structural similarity; `None` when the pictures are smaller than its window.
    pub ssim: Option<f64>,
    /// The mean of ꟻLIP.
    pub flip: f64,
    /// ꟻLIP of each pixel.
    pub flip_map: FlipMap,
}

/// The contenders, and the difference of each from the first.
#[derive(Clone, Debug)]
pub struct MethodComparison {
    /// The pictures; the first is the truth.
    pub contenders: Vec<Contender>,
    /// For each but the first.
    pub metrics: Vec<Metrics>,
    /// The difference of a channel from which on a pixel counts as wrong.
    pub bound: f64,
}

/// The reason why nothing could be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// One picture alone.
    #[error("a comparison takes two pictures or more, not {0}")]
    Few(usize),
    /// A picture does not fit the first.
    #[error("cannot compare {name} with {truth}")]
    Picture {
        /// The first picture.
        truth: String,
        /// The other one.
        name: String,
        /// Why.
        source: PictureError,
    },
    /// The scene cannot be prepared.
    #[error(transparent)]
    Stage(#[from] SceneBuildError),
    /// A picture cannot be drawn.
    #[error("cannot draw {name}")]
    Method {
        /// Which one.
        name: String,
        /// Why.
        source: MethodError,
    },
    /// [`RenderControl::cancel`] was called.
    #[error("the comparison was cancelled")]
    Cancelled,
}

impl CompareError {
    fn method(name: &str, source: MethodError) -> Self {
        match source {
            MethodError::Cancelled => Self::Cancelled,
            source => Self::Method { name: name.to_owned(), source },
        }
    }
}

/// The methods to compare, and the settings of their pictures.
#[derive(Clone, Debug)]
pub struct CompareJob<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The ways of drawing it, in the order of the report.
    pub variants: &'a [Variant],
    /// Size and samples, where a variant has none of its own.
    pub settings: RenderSettings,
    /// How often each is drawn after a first time that is not counted; at least once.
    pub runs: u32,
    /// The difference of a channel from which on a pixel counts as wrong, linear light.
    pub bound: f64,
}

/// Draws a scene in several ways on the threads of the current rayon pool, in rounds, so that whatever drifts hits all
/// alike. `watch` gets the number of finished pictures, and of all.
///
/// Reasons are told for what was drawn by another method than the first with the samples and generations of the first,
/// if that is traced.
///
/// # Errors
/// When the scene cannot be prepared, a picture cannot be drawn, or the work is cancelled.
pub fn draw_all(
    job: &CompareJob<'_>,
    control: &RenderControl,
    watch: &mut dyn FnMut(usize, usize),
) -> Result<Vec<Contender>, CompareError> {
    let runs = job.runs.max(1);
    let total = job.variants.len() * (runs as usize + 1);
    let render_scene = RenderScene::build(job.scene)?;
    let mut works: Vec<ContenderRun<'_>> =
        job.variants.iter().map(|variant| ContenderRun::new(job, variant, &render_scene)).collect();
    for round in 0..=runs {
        for (index, work) in works.iter_mut().enumerate() {
            work.draw(control, round > 0)?;
            watch(round as usize * job.variants.len() + index + 1, total);
        }
    }
    let truth = works.first().and_then(|work| Some((work.variant, work.drawing.as_ref()?.picture.clone())));
    works
        .into_iter()
        .enumerate()
        .filter_map(|(index, work)| {
            let reasons = match &truth {
                Some((variant, picture)) if index > 0 => work.reasons(variant, picture, job.bound, control),
                _ => Ok(None),
            };
            match reasons {
                Ok(reasons) => work.finish(reasons).map(Ok),
                Err(error) => Some(Err(error)),
            }
        })
        .collect()
}

/// A contender while it is drawn.
struct ContenderRun<'a> {
    variant: &'a Variant,
    render_scene: RenderScene,
    settings: RenderSettings,
    drawing: Option<MethodOutput>,
    times: Vec<Vec<(PassName, Duration)>>,
}

impl<'a> ContenderRun<'a> {
    fn new(job: &CompareJob<'_>, variant: &'a Variant, render_scene: &RenderScene) -> Self {
        let render_scene = render_scene.clone();
        Self {
            variant,
            render_scene: match variant.generations {
                Some(generations) => render_scene.with_generations(generations),
                None => render_scene,
            },
            settings: RenderSettings {
                samples: variant.samples.unwrap_or(job.settings.samples),
                ..job.settings
            },
            drawing: None,
            times: Vec::new(),
        }
    }

    fn draw(&mut self, control: &RenderControl, counts: bool) -> Result<(), CompareError> {
        let drawing = draw(&self.render_scene, &self.variant.method, self.settings, control)
            .map_err(|error| CompareError::method(&self.variant.name, error))?;
        if counts {
            self.times.push(drawing.passes.clone());
        }
        self.drawing = Some(drawing);
        Ok(())
    }

    /// Why its pixels differ from those of a traced picture; `None` where the method cannot tell.
    fn reasons(
        &self,
        truth: &Variant,
        picture: &Picture,
        bound: f64,
        control: &RenderControl,
    ) -> Result<Option<ReasonMap>, CompareError> {
        let Some(drawing) = &self.drawing else { return Ok(None) };
        let alike = self.variant.generations == truth.generations && self.variant.samples == truth.samples;
        let traced = truth.method.abilities().is_reference;
        if !alike || !traced || self.variant.method.abilities().is_reference {
            return Ok(None);
        }
        reasons(&self.render_scene, &self.variant.method, self.settings, picture, drawing, bound, control)
            .map(Some)
            .map_err(|error| CompareError::method(&self.variant.name, error))
    }

    fn finish(self, reasons: Option<ReasonMap>) -> Option<Contender> {
        let drawing = self.drawing?;
        let median = |times: Vec<f64>| summarize(&times).map_or(0.0, |summary| summary.median);
        let milliseconds = |time: &Duration| time.as_secs_f64() * 1e3;
        let of_pass = |name: PassName| {
            let times = self.times.iter().flatten().filter(|(other, _)| *other == name);
            (name, median(times.map(|(_, time)| milliseconds(time)).collect()))
        };
        let sum =
            |passes: &Vec<(PassName, Duration)>| passes.iter().map(|(_, time)| milliseconds(time)).sum();
        Some(Contender {
            name: self.variant.name.clone(),
            picture: drawing.picture,
            drawn: Some(ContenderPicture {
                passes: drawing.passes.iter().map(|(name, _)| of_pass(*name)).collect(),
                time: median(self.times.iter().map(sum).collect()),
                runs: self.times.len() as u32,
                reasons,
            }),
        })
    }
}

/// Holds each contender against the first, as a display shows them: light clamped to 0…1.
///
/// # Errors
/// When there are fewer than two, or the sizes differ.
pub fn compare(contenders: Vec<Contender>, bound: f64) -> Result<MethodComparison, CompareError> {
    let Some((truth, others @ [_, ..])) = contenders.split_first() else {
        return Err(CompareError::Few(contenders.len()));
    };
    let metrics = others.iter().map(|other| {
        Metrics::between(&truth.picture, &other.picture, bound).map_err(|source| CompareError::Picture {
            truth: truth.name.clone(),
            name: other.name.clone(),
            source,
        })
    });
    let metrics = metrics.collect::<Result<_, _>>()?;
    Ok(MethodComparison { contenders, metrics, bound })
}

impl Metrics {
    /// All measures of a picture against the truth.
    ///
    /// # Errors
    /// When the sizes differ.
    pub fn between(truth: &Picture, other: &Picture, bound: f64) -> Result<Self, PictureError> {
        let ssim = match ssim(truth, other) {
            Err(PictureError::TooSmall { .. }) => None,
            found => Some(found?),
        };
        let flip_map = Flip::default().compare(truth, other)?;
        Ok(Self {
            difference: Comparison { clamp: true, bound }.compare(truth, other)?,
            ssim,
            flip: flip_map.mean(),
            flip_map,
        })
    }
}

impl MethodComparison {
    /// The picture that the others are compared with.
    pub fn truth(&self) -> Option<&Contender> {
        self.contenders.first()
    }

    /// The other contenders with their differences.
    pub fn others(&self) -> impl Iterator<Item = (&Contender, &Metrics)> {
        self.contenders.iter().skip(1).zip(&self.metrics)
    }

    /// The end of a scale of differences that suits all contenders: the least of 1/16, 1/8, 1/4, 1/2 and 1 that at most
    /// a hundredth of all pixels exceed.
    pub fn scale(&self) -> f64 {
        let Some(truth) = self.truth() else { return 1.0 };
        let exceed = |bound: f64| {
            let comparison = Comparison { clamp: true, bound };
            let shares = self.contenders.iter().skip(1).filter_map(|other| {
                Some(comparison.compare(&truth.picture, &other.picture).ok()?.share_above)
            });
            shares.sum::<f64>() / self.metrics.len().max(1) as f64
        };
        [1.0 / 16.0, 0.125, 0.25, 0.5].into_iter().find(|bound| exceed(*bound) <= 0.01).unwrap_or(1.0)
    }
}

/// The picture of the reasons: a color for each, gray where the pictures agree.
///
/// # Errors
/// When there is too little memory.
pub fn reason_picture(map: &ReasonMap) -> Result<Picture, SizeError> {
    let mut picture = Picture::new(map.width(), map.height())?;
    for (pixel, reason) in picture.pixels_mut().iter_mut().zip(map.reasons()) {
        *pixel = reason
            .map_or(AGREED, reason_color)
            .map(|code| catoptric_picture::srgb::decode(f64::from(code) / 255.0) as f32);
    }
    Ok(picture)
}

/// The gray of pixels that agree, sRGB codes.
pub const AGREED: [u8; 3] = [0xd9, 0xd9, 0xd9];

/// The color of a reason, sRGB codes: fifteen that differ in hue and lightness.
pub fn reason_color(reason: catoptric_tracer::raster::Reason) -> [u8; 3] {
    use catoptric_tracer::raster::Reason;
    match reason {
        Reason::LeftScreen => [0x00, 0x72, 0xb2],
        Reason::Hidden => [0xd5, 0x5e, 0x00],
        Reason::Thickness => [0xf0, 0xe4, 0x42],
        Reason::Step => [0x00, 0x9e, 0x73],
        Reason::OutOfRange => [0x56, 0xb4, 0xe9],
        Reason::Parallax => [0xaa, 0x33, 0x77],
        Reason::SelfMissing => [0xe6, 0x9f, 0x00],
        Reason::Sampling => [0x7f, 0x7f, 0x00],
        Reason::ReflectionMissing => [0x33, 0x22, 0x88],
        Reason::SecondReflectionMissing => [0x88, 0xcc, 0xee],
        Reason::RefractionMissing => [0x44, 0xaa, 0x99],
        Reason::Facet => [0xcc, 0x66, 0x77],
        Reason::Shading => [0xa6, 0x76, 0x1d],
        Reason::ShadowMissing => [0x1a, 0x1a, 0x1a],
        Reason::Highlight => [0xff, 0x99, 0xbb],
    }
}
