//! Light of the scene by rays and sums that may be wrong, kept as long as there is room.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use catoptric_picture::Picture;
use catoptric_scene::Scene;
use catoptric_tracer::{
    RenderControl, RenderError, RenderScene, RenderSettings, SceneBuildError, WhittedIntegrator, render,
};
use glam::DVec2;
use rayon::prelude::*;

use super::DetectiveError;
use super::faults::FaultSet;
use super::light_tree::{LightLaw, LightTrees};
use super::mistake::{Explanation, SceneMistake};
use super::places::{Offset, PixelChoice, Window};

/// The rays of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct RayKey {
    size: [u32; 2],
    /// How many pixels are chosen: of one size and count, always the same ones.
    count: usize,
    window: Window,
    offset: Offset,
    scene: Option<SceneMistake>,
}

impl RayKey {
    fn new(choice: &PixelChoice, explanation: &Explanation, offset: Offset) -> Self {
        let Explanation { window, scene, .. } = *explanation;
        Self { size: choice.size, count: choice.pixels.len(), window, offset, scene }
    }
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

/// The scenes with and without mistakes, and the light that they gave so far.
#[derive(Debug)]
pub(super) struct Trials<'a> {
    scene: &'a Scene,
    expected_size: Option<[u32; 2]>,
    prepared: RenderScene,
    changed: [OnceLock<(Scene, RenderScene)>; SceneMistake::ALL.len()],
    trees: Mutex<Shelf<RayKey, Arc<LightTrees>>>,
    lights: Mutex<Shelf<LightKey, PixelLight>>,
}

impl<'a> Trials<'a> {
    /// Sets of trees that are kept: a few megabytes each.
    const MOST_TREES: usize = 12;
    /// Sums of light that are kept: some fifty kilobytes each.
    const MOST_LIGHTS: usize = 2000;
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
            changed: Default::default(),
            trees: Mutex::new(Shelf::new(Self::MOST_TREES)),
            lights: Mutex::new(Shelf::new(Self::MOST_LIGHTS)),
        })
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Whether the mistake of the window can be in a picture of this size.
    pub(super) fn has_window(&self, window: Window, size: [u32; 2]) -> bool {
        window.scale(self.scene, size, self.expected_size).is_some()
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
        let trees = self.trees_of(choice, rays, control)?;
        let (scene, _) = self.scene_with(rays.scene)?;
        let law = LightLaw::new(scene, &key.faults);
        let law = if is_dark { law.darkened() } else { law };
        let light: Vec<[f32; 3]> = (0..trees.len())
            .into_par_iter()
            .map_init(Vec::new, |sums, place| trees.light(place, &law, sums))
            .collect();
        let light = Arc::new(light);
        locked(&self.lights, |lights| lights.put(key, Arc::clone(&light)));
        Ok(light)
    }

    /// The trees of the chosen pixels with the rays of an explanation, which are not kept.
    pub(super) fn traced_once(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        offset: Offset,
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        self.traced(choice, (RayKey::new(choice, explanation, offset), DVec2::ZERO), control)
    }

    /// The trees of rays beside those of the offset, which are not kept.
    pub(super) fn traced_beside(
        &self,
        choice: &PixelChoice,
        explanation: &Explanation,
        (offset, beside): (Offset, DVec2),
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        self.traced(choice, (RayKey::new(choice, explanation, offset), beside), control)
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

    /// The scene with or without a mistake.
    pub(super) fn changed_scene(&self, mistake: Option<SceneMistake>) -> Result<&Scene, DetectiveError> {
        self.scene_with(mistake).map(|(scene, _)| scene)
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
        let trees = Arc::new(self.traced(choice, (key, DVec2::ZERO), control)?);
        locked(&self.trees, |shelf| shelf.put(key, Arc::clone(&trees)));
        Ok(trees)
    }

    fn traced(
        &self,
        choice: &PixelChoice,
        (key, beside): (RayKey, DVec2),
        control: &RenderControl,
    ) -> Result<LightTrees, DetectiveError> {
        let (scene, prepared) = self.scene_with(key.scene)?;
        let [width, height] = choice.size.map(f64::from);
        let size = DVec2::new(width, height);
        let scale = key.window.scale(self.scene, choice.size, self.expected_size).unwrap_or(DVec2::ONE);
        let generations = scene.tracing.generations.saturating_add(Self::MORE_GENERATIONS);
        let threshold = prepared.threshold().max(Self::LEAST_WEIGHT);
        let part = |pixels: &[[u32; 2]]| {
            let camera = prepared.camera();
            let mut integrator =
                WhittedIntegrator::watched(prepared, camera, control).with_limits(generations, threshold);
            let mut trees = LightTrees::default();
            for pixel in pixels {
                let at = 0.5 * size + (key.offset.at(*pixel, choice.size) + beside - 0.5 * size) * scale;
                trees.push(scene, &integrator.tree(camera.ray(at, size), Self::MOST_RAYS));
            }
            control.add_pixels(pixels.len() as u64);
            trees
        };
        let parts: Vec<LightTrees> = choice.pixels.par_chunks(256).map(part).collect();
        if control.is_cancelled() {
            return Err(DetectiveError::Cancelled);
        }
        let mut trees = LightTrees::default();
        parts.into_iter().for_each(|part| trees.append(part));
        Ok(trees)
    }

    fn scene_with(&self, mistake: Option<SceneMistake>) -> Result<(&Scene, &RenderScene), DetectiveError> {
        let Some(mistake) = mistake else { return Ok((self.scene, &self.prepared)) };
        let Some(place) = self.changed.get(mistake as usize) else { return Ok((self.scene, &self.prepared)) };
        if place.get().is_none() {
            let scene = mistake.applied(self.scene);
            let prepared = RenderScene::build(&scene)?;
            // Another thread may have been quicker; its scene is the same.
            drop(place.set((scene, prepared)));
        }
        Ok(place.get().map_or((self.scene, &self.prepared), |(scene, prepared)| (scene, prepared)))
    }
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
