//! Light of the scene by rays and sums that may be wrong, kept as long as there is room.

use std::collections::HashMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

use catoptric_picture::Picture;
use catoptric_scene::Scene;
use catoptric_tracer::{
    RenderControl, RenderError, RenderScene, RenderSettings, SceneBuildError, WhittedIntegrator, render,
};
use glam::DVec2;
use rayon::prelude::*;

use super::DetectiveError;
use super::faults::FaultSet;
use super::light_law::LightLaw;
use super::light_tree::LightTrees;
use super::mistake::Explanation;
use super::places::{Offset, PixelChoice, Window};
use super::ray_fault::RayFaults;
use super::scene_mistake::SceneMistakes;
use super::trial_tracer::{TrialFacts, TrialLimits, TrialTracer};

/// The rays of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct RayKey {
    size: [u32; 2],
    /// How many pixels are chosen: of one size and count, always the same ones.
    count: usize,
    window: Window,
    offset: Offset,
    scene: SceneMistakes,
    rays: RayFaults,
}

impl RayKey {
    fn new(choice: &PixelChoice, explanation: &Explanation, offset: Offset) -> Self {
        let Explanation { window, scene, rays, .. } = explanation.clone();
        Self { size: choice.size, count: choice.pixels.len(), window, offset, scene, rays }
    }
}

/// A ray of a pixel beside the one that an explanation has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RayBeside {
    /// How far to the right and below, pixels.
    pub(super) at: DVec2,
    /// The sample whose random numbers it has; `None` for those in the middle of their ranges.
    pub(super) sample: Option<u32>,
}

/// The sums of light of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct LightKey {
    rays: RayKey,
    faults: FaultSet,
    is_dark: bool,
}

/// The light of the chosen pixels.
pub(super) type PixelLight = Arc<Vec<[f32; 3]>>;

/// A scene with mistakes, prepared.
type ChangedScene = Arc<(Scene, RenderScene)>;

/// The scenes with and without mistakes, and the light that they gave so far.
pub(super) struct Trials<'a> {
    scene: &'a Scene,
    expected_size: Option<[u32; 2]>,
    prepared: RenderScene,
    /// What the trial tracer could be asked for, if it can trace the scene.
    facts: Option<TrialFacts>,
    changed: Mutex<Shelf<SceneMistakes, ChangedScene>>,
    trees: Mutex<Shelf<RayKey, Arc<LightTrees>>>,
    lights: Mutex<Shelf<LightKey, PixelLight>>,
}

impl fmt::Debug for Trials<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Trials").field("expected_size", &self.expected_size).finish_non_exhaustive()
    }
}

impl<'a> Trials<'a> {
    /// Sets of trees that are kept: a few megabytes each.
    const MOST_TREES: usize = 16;
    /// Sums of light that are kept: some fifty kilobytes each.
    const MOST_LIGHTS: usize = 2000;
    /// Prepared scenes that are kept.
    const MOST_SCENES: usize = 16;
    /// Rays of a tree that are followed.
    const MOST_RAYS: usize = 256;
    /// Generations beyond those of the scene that are followed.
    const MORE_GENERATIONS: u32 = 4;
    /// Rays of less weight change no code.
    const LEAST_WEIGHT: f32 = 0.001;

    pub(super) fn new(scene: &'a Scene, expected_size: Option<[u32; 2]>) -> Result<Self, SceneBuildError> {
        Ok(Self {
            scene,
            expected_size,
            prepared: RenderScene::build(scene)?,
            facts: TrialFacts::of(scene),
            changed: Mutex::new(Shelf::new(Self::MOST_SCENES)),
            trees: Mutex::new(Shelf::new(Self::MOST_TREES)),
            lights: Mutex::new(Shelf::new(Self::MOST_LIGHTS)),
        })
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// What faults of rays the scene can show; `None` if they cannot be tried.
    pub(super) fn facts(&self) -> Option<&TrialFacts> {
        self.facts.as_ref()
    }

    /// Whether the mistake of the window can be in a picture of this size.
    pub(super) fn has_window(&self, window: Window, size: [u32; 2]) -> bool {
        window.placed(self.scene, size, self.expected_size).is_some()
    }

    /// The light of the chosen pixels, one picture for each ray of a pixel.
    pub(super) fn lights(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        is_dark: bool,
        control: &RenderControl,
    ) -> Result<Vec<PixelLight>, DetectiveError> {
        let rays = explanation.offset.rays();
        rays.into_iter().map(|offset| self.light(choice, explanation, offset, is_dark, control)).collect()
    }

    fn light(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        offset: Offset,
        is_dark: bool,
        control: &RenderControl,
    ) -> Result<PixelLight, DetectiveError> {
        let rays = RayKey::new(choice, explanation, offset);
        let key = LightKey { rays, faults: explanation.faults.clone(), is_dark };
        if let Some(light) = locked(&self.lights, |lights| lights.get(&key)) {
            return Ok(light);
        }
        let trees = self.trees_of(choice, key.rays.clone(), control)?;
        let law = LightLaw::new(self.scene, &key.faults);
        let law = if is_dark { law.darkened() } else { law };
        let light: Vec<[f32; 3]> = (0..trees.len())
            .into_par_iter()
            .map_init(Vec::new, |sums, place| trees.light(place, &law, sums))
            .collect();
        let light = Arc::new(light);
        locked(&self.lights, |lights| lights.put(key, Arc::clone(&light)));
        Ok(light)
    }

    /// The light of some of the chosen pixels, by their places, one picture for each ray of a pixel. The rays are those
    /// that are kept if there are such; others are traced for these pixels alone.
    pub(super) fn lights_at(
        &self,
        choice: &PixelChoice,
        places: &[usize],
        explanation: &Explanation,
        control: &RenderControl,
    ) -> Result<Vec<PixelLight>, DetectiveError> {
        let law = LightLaw::new(self.scene, &explanation.faults);
        let mut sums = Vec::new();
        let rays = explanation.offset.rays().into_iter();
        rays.map(|offset| {
            let key = RayKey::new(choice, explanation, offset);
            if let Some(trees) = locked(&self.trees, |trees| trees.get(&key)) {
                return Ok(Arc::new(
                    places.iter().map(|place| trees.light(*place, &law, &mut sums)).collect(),
                ));
            }
            let pixels = places.iter().filter_map(|place| choice.pixels.get(*place).copied()).collect();
            let part = PixelChoice { size: choice.size, pixels, pairs: Vec::new() };
            let trees = self.traced(&part, (&key, RayBeside::default()), control)?;
            Ok(Arc::new((0..trees.len()).map(|place| trees.light(place, &law, &mut sums)).collect()))
        })
        .collect()
    }

    /// The trees of the chosen pixels with the rays of an explanation, which are not kept.
    pub(super) fn traced_once(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        offset: Offset,
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        self.traced(choice, (&RayKey::new(choice, explanation, offset), RayBeside::default()), control)
    }

    /// The trees of rays beside those of the offset, which are not kept.
    pub(super) fn traced_beside(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        (offset, beside): (Offset, RayBeside),
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        self.traced(choice, (&RayKey::new(choice, explanation, offset), beside), control)
    }

    /// The exact picture.
    pub(super) fn exact(
        &self,
        [width, height]: [u32; 2],
        control: &RenderControl,
    ) -> Result<Picture, DetectiveError> {
        let settings = RenderSettings { width, height, samples: 1 };
        match render(&self.prepared, settings, control) {
            Ok(output) => Ok(output.picture),
            Err(RenderError::Cancelled) => Err(DetectiveError::Cancelled),
            Err(error) => Err(error.into()),
        }
    }

    fn trees_of(
        &self,
        choice: &PixelChoice,
        key: RayKey,
        control: &RenderControl,
    ) -> Result<Arc<LightTrees>, DetectiveError> {
        if let Some(trees) = locked(&self.trees, |trees| trees.get(&key)) {
            return Ok(trees);
        }
        let trees = Arc::new(self.traced(choice, (&key, RayBeside::default()), control)?);
        locked(&self.trees, |shelf| shelf.put(key, Arc::clone(&trees)));
        Ok(trees)
    }

    fn traced(
        &self,
        choice: &PixelChoice,
        (key, beside): (&RayKey, RayBeside),
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        let [width, height] = choice.size.map(f64::from);
        let size = DVec2::new(width, height);
        let placed = key.window.placed(self.scene, choice.size, self.expected_size);
        let [scale, shift] = placed.unwrap_or([DVec2::ONE, DVec2::ZERO]);
        let at = |pixel: [u32; 2]| {
            let middle = 0.5 * size;
            middle + (key.offset.at(pixel, choice.size) + beside.at - middle) * scale + shift * middle
        };
        let parts: Vec<LightTrees> = if key.scene.is_empty() && key.rays.is_empty() {
            exact_parts(self.scene, &self.prepared, (choice, size), (at, beside.sample), control)
        } else if self.facts.is_some() {
            let scene = key.scene.applied(self.scene);
            match TrialTracer::new(&scene, &key.rays) {
                Some(tracer) => {
                    let limits = TrialLimits {
                        generations: scene.tracing.generations.saturating_add(Self::MORE_GENERATIONS),
                        rays: Self::MOST_RAYS,
                        weight: self.prepared.threshold().max(Self::LEAST_WEIGHT),
                    };
                    let part = |pixels: &[[u32; 2]]| {
                        let mut trees = LightTrees::default();
                        for pixel in pixels {
                            if !control.is_cancelled() {
                                tracer.trace(at(*pixel), size, limits, &mut trees);
                            }
                        }
                        trees
                    };
                    choice.pixels.par_chunks(256).map(part).collect()
                }
                None => self.changed_parts(&key.scene, (choice, size), (at, beside.sample), control)?,
            }
        } else {
            self.changed_parts(&key.scene, (choice, size), (at, beside.sample), control)?
        };
        control.add_pixels(choice.pixels.len() as u64);
        if control.is_cancelled() {
            return Err(DetectiveError::Cancelled);
        }
        let mut trees = LightTrees::default();
        parts.into_iter().for_each(|part| trees.append(part));
        Ok(trees)
    }

    /// The trees of a scene with mistakes by the exact tracer.
    fn changed_parts(
        &self,
        mistakes: &SceneMistakes,
        choice: (&PixelChoice, DVec2),
        rays: (impl Fn([u32; 2]) -> DVec2 + Sync, Option<u32>),
        control: &RenderControl,
    ) -> Result<Vec<LightTrees>, DetectiveError> {
        let changed = self.changed(mistakes)?;
        let (scene, prepared) = &*changed;
        Ok(exact_parts(scene, prepared, choice, rays, control))
    }

    fn changed(&self, mistakes: &SceneMistakes) -> Result<ChangedScene, DetectiveError> {
        if let Some(changed) = locked(&self.changed, |changed| changed.get(mistakes)) {
            return Ok(changed);
        }
        let scene = mistakes.applied(self.scene);
        let prepared = RenderScene::build(&scene)?;
        let changed = Arc::new((scene, prepared));
        locked(&self.changed, |shelf| shelf.put(mistakes.clone(), Arc::clone(&changed)));
        Ok(changed)
    }
}

/// The trees of a scene by the exact tracer.
fn exact_parts(
    scene: &Scene,
    prepared: &RenderScene,
    (choice, size): (&PixelChoice, DVec2),
    (at, sample): (impl Fn([u32; 2]) -> DVec2 + Sync, Option<u32>),
    control: &RenderControl,
) -> Vec<LightTrees> {
    let generations = scene.tracing.generations.saturating_add(Trials::MORE_GENERATIONS);
    let threshold = prepared.threshold().max(Trials::LEAST_WEIGHT);
    let part = |pixels: &[[u32; 2]]| {
        let camera = prepared.camera();
        let mut integrator =
            WhittedIntegrator::watched(prepared, camera, control).with_limits(generations, threshold);
        let mut trees = LightTrees::default();
        for pixel in pixels {
            let ray = camera.ray(at(*pixel), size);
            let records = match sample {
                Some(sample) => integrator.tree_of_sample(ray, (*pixel).into(), sample, Trials::MOST_RAYS),
                None => integrator.tree(ray, Trials::MOST_RAYS),
            };
            trees.push(scene, &records);
        }
        trees
    };
    choice.pixels.par_chunks(256).map(part).collect()
}
/// Results that are kept; when there are too many, the older half goes.
#[derive(Debug)]
struct Shelf<K, V> {
    most: usize,
    clock: u64,
    kept: HashMap<K, (u64, V)>,
}

impl<K: Hash + Eq + Clone, V: Clone> Shelf<K, V> {
    fn new(most: usize) -> Self {
        Self { most, clock: 0, kept: HashMap::new() }
    }

    fn get(&mut self, key: &K) -> Option<V> {
        self.clock += 1;
        let (used, value) = self.kept.get_mut(key)?;
        *used = self.clock;
        Some(value.clone())
    }

    fn put(&mut self, key: K, value: V) {
        if self.kept.len() >= self.most {
            let mut uses: Vec<u64> = self.kept.values().map(|(used, _)| *used).collect();
            uses.sort_unstable();
            let middle = uses.get(uses.len() / 2).copied().unwrap_or_default();
            self.kept.retain(|_, (used, _)| *used >= middle);
        }
        self.clock += 1;
        self.kept.insert(key, (self.clock, value));
    }
}

/// What `work` finds in what the lock guards; a panic of another thread leaves it usable.
fn locked<T, R>(shared: &Mutex<T>, work: impl FnOnce(&mut T) -> R) -> R {
    work(&mut shared.lock().unwrap_or_else(PoisonError::into_inner))
}
