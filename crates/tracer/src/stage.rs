//! The prepared scene: everything a ray can meet, in flat arrays.

pub(crate) mod ahead;
mod body;
mod bounds;
mod bvh;
mod camera;
mod cast;
mod checker;
mod curve;
mod double;
mod edit;
mod hull;
mod image;
mod level;
mod light;
mod log;
mod material;
mod only;
mod sight;
mod sky;
mod space;
mod sphere;
mod texture;

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use catoptric_scene::{Camera, Color, Scene, Tracing};
use glam::{DVec3, Vec3, Vec3A};
use rayon::prelude::*;

use crate::lanes::{ScalarWidth, SimdLevel, Width};
use crate::ray::Ray;
use crate::shape::ShapeSpan;
use crate::vector::Vector;

pub(crate) use body::{RenderBody, SurfacePoint};
pub(crate) use bounds::Bounds;
pub(crate) use bvh::{
    BodyVisitor, BuildEntry, Bvh, BvhNode, STREAM, StreamRayRows, StreamRow, StreamTraversalStack,
    StreamVisitor, TINY as BOX_TINY, TraversalStack, WIDEN as BOX_WIDEN, vector_at,
};
pub use camera::RenderCamera;
use camera::SceneExtent;
pub(crate) use camera::{CameraRays, HomogeneousPoint};
use cast::BodyBuild;
pub(crate) use checker::CheckerTexture;
pub(crate) use curve::{ConductorTable, STEPS as CURVE_STEPS};
use double::{Bodies64, Body64};
pub use edit::SceneEdit;
pub(crate) use image::ImageLookup;
pub(crate) use light::{LightFalloff, RenderLight};
use log::EditLog;
pub use log::SceneChanges;
pub(crate) use material::{MaterialModel, RenderMaterial};
pub(crate) use sight::{BoundingCone, VisibleBodies};
pub(crate) use sky::EnvironmentLight;
use space::RenderSpace;
pub(crate) use sphere::BoundingSphere;
pub(crate) use texture::{ImageTexture, LEVEL as TEXTURE_LEVEL};

/// A scene prepared for tracing, shared by reference between threads.
///
/// Bodies stand in the order of the bounding volume hierarchy's leaves, the unbounded ones last. What
/// the search reads is plain single-precision data.
#[derive(Clone, Debug)]
pub struct RenderScene {
    pub(crate) bodies: Vec<RenderBody>,
    /// The place in [`Scene::bodies`] of each body of the stage.
    pub(crate) scene_indices: Vec<u32>,
    /// How many of the bodies are bounded; planes follow them.
    pub(crate) bounded: u32,
    pub(crate) hierarchy: Accelerator,
    /// Around each bounded body.
    pub(crate) spheres: Vec<BoundingSphere>,
    /// The exact numbers of bodies that do not fit single precision.
    doubles: Arc<Bodies64>,
    pub(crate) space: RenderSpace,
    /// The largest extent of the bodies in single precision, meters.
    largest_extent: f64,
    // Shared with the stages of some of the bodies.
    pub(crate) materials: Arc<Vec<RenderMaterial>>,
    pub(crate) checkers: Arc<Vec<CheckerTexture>>,
    pub(crate) lights: Arc<[RenderLight]>,
    pub(crate) camera: RenderCamera,
    pub(crate) sky: EnvironmentLight,
    pub(crate) ambient: [f32; 3],
    pub(crate) generations: u32,
    pub(crate) threshold: f32,
    /// Whether light passes through any body, or did before an edit.
    pub(crate) has_transparency: bool,
    /// Whether there is more than Phong's model in plain colors, point lights and even surroundings, or was before an edit.
    pub(crate) is_full: bool,
    /// Whether light is lost in some body.
    pub(crate) absorbs: bool,
    /// Whether some body splits light into its colors.
    pub(crate) disperses: bool,
    /// The largest [`RenderBody::slack`], or more after an edit.
    pub(crate) largest_slack: f32,
    /// How many rays are traced side by side: kept, since asking the processor can take longer than a tile.
    pub(crate) lanes: SimdLevel,
    /// See [`Self::candidates_to_lights`].
    to_lights: OnceLock<Vec<Option<VisibleBodies>>>,
    /// Materials and checkers that edits have added.
    added: u32,
    /// What edits have changed of the bodies and the hierarchy.
    log: EditLog,
}

/// How the bodies that a ray may meet are found among the bounded ones.
#[derive(Clone, Debug)]
pub(crate) enum Accelerator {
    /// They are few: the sphere around each is tested.
    Few,
    Many(Bvh),
}

/// Which of the bodies a ray is tested against. The picture does not depend on it, but the time does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AcceleratorChoice {
    /// What is quickest for the number of bodies: one by one when they are few, else through a hierarchy of bounding
    /// boxes. The default.
    #[default]
    Quickest,
    /// The bounding sphere of every body, one by one, however many there are: the time grows in proportion to them.
    OneByOne,
}

impl Accelerator {
    /// The hierarchy over these entries of bodies, which are put into its order.
    fn over(entries: &mut [BuildEntry], search: AcceleratorChoice) -> Self {
        if entries.len() <= RenderScene::FEW || search == AcceleratorChoice::OneByOne {
            entries.sort_by_key(BuildEntry::leaf_key);
            Self::Few
        } else {
            Self::Many(Bvh::build(entries))
        }
    }

    /// The box of all its entries, which are these.
    fn bounds(&self, entries: &[BuildEntry]) -> Bounds {
        match self {
            Self::Few => entries.iter().fold(Bounds::EMPTY, |all, entry| all.union(entry.bounds())),
            Self::Many(bvh) => bvh.bounds(),
        }
    }
}

/// Why a scene cannot be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneBuildError {
    /// A body names a material that the scene does not define.
    #[error("body {body}: the material \"{material}\" is not defined")]
    UndefinedMaterial {
        /// The body's name, or its number in the scene counted from 1.
        body: String,
        /// The name that was looked for.
        material: String,
    },
    /// More bodies than the stage can number.
    #[error("{0} bodies are too many: at most {limit} can be traced", limit = RenderScene::MAX_BODIES)]
    TooManyBodies(usize),
}

/// Bounds outside of which rays from the eye may start nearer to the bodies: none, where light is absorbed on the way there,
/// within a plane.
fn bounds_of_free_ways<'b>(
    bounds: Bounds,
    mut planes: impl Iterator<Item = &'b RenderBody>,
    materials: &[RenderMaterial],
) -> Bounds {
    let absorbs =
        |body: &RenderBody| materials.get(body.material as usize).is_some_and(RenderMaterial::absorbs);
    if planes.any(absorbs) { Bounds::EMPTY } else { bounds }
}

impl RenderScene {
    /// The largest number of bodies.
    pub const MAX_BODIES: usize = 1 << 30;

    /// Up to this many bounded bodies, all bounding spheres are tested; from then on a hierarchy of boxes is quicker.
    pub const FEW: usize = 48;

    /// Prepares `scene`, whose values are taken to be valid. Hidden bodies and lights are left out.
    ///
    /// # Errors
    /// When a body that is not hidden names an undefined material, or there are too many bodies.
    pub fn prepare(scene: &Scene) -> Result<Self, SceneBuildError> {
        Self::prepare_for(scene, AcceleratorChoice::Quickest)
    }

    /// Prepares `scene` with a choice of how bodies are found, for measuring what it is worth.
    ///
    /// # Errors
    /// As for [`Self::prepare`].
    pub fn prepare_for(scene: &Scene, search: AcceleratorChoice) -> Result<Self, SceneBuildError> {
        Self::prepare_seen(scene, &scene.camera, search)
    }

    /// Prepares `scene` to be seen by a camera that may be another than its own.
    ///
    /// Numbers are exact for pictures from where this camera is; [`Self::suits`] tells whether they are for another.
    ///
    /// # Errors
    /// As for [`Self::prepare`].
    pub fn prepare_seen(
        scene: &Scene,
        camera: &Camera,
        search: AcceleratorChoice,
    ) -> Result<Self, SceneBuildError> {
        if scene.bodies.len() > Self::MAX_BODIES {
            return Err(SceneBuildError::TooManyBodies(scene.bodies.len()));
        }
        let space = RenderSpace::of(scene, camera);
        let BodyBuild { mut entries, planes, chunks, materials, checkers, doubles } =
            BodyBuild::of(scene, &space)?;
        let hierarchy = Accelerator::over(&mut entries, search);
        let bounds = hierarchy.bounds(&entries);
        let scene_indices: Vec<u32> =
            entries.par_iter().map(BuildEntry::place).chain(planes.par_iter().copied()).collect();
        let bounded = entries.len() as u32;
        drop(entries);
        let bodies: Vec<RenderBody> = scene_indices.par_iter().map(|&index| chunks.body(index)).collect();
        let surroundings = SceneExtent::new(
            bounds_of_free_ways(bounds, bodies.iter().skip(bounded as usize), &materials),
            planes.iter().map(|&index| &scene.bodies[index as usize]),
            &space,
        );
        let Tracing { generations, threshold } = scene.tracing;
        let sky = EnvironmentLight::new(&scene.environment);
        let lanes = match &hierarchy {
            _ if !doubles.is_empty() => SimdLevel::with_doubles(),
            Accelerator::Few => SimdLevel::for_few(),
            Accelerator::Many(_) => SimdLevel::widest(),
        };
        let stage = Self {
            bounded,
            hierarchy,
            spheres: bodies[..bounded as usize].par_iter().map(RenderBody::bounding_sphere).collect(),
            largest_slack: bodies.par_iter().map(|body| body.slack).reduce(|| 0.0, f32::max),
            largest_extent: bodies.par_iter().map(RenderBody::extent).reduce(|| 0.0, f64::max),
            doubles: Arc::new(Bodies64::new(doubles)),
            space,
            bodies,
            scene_indices,
            has_transparency: materials.iter().any(RenderMaterial::is_transparent),
            is_full: materials.iter().any(RenderMaterial::is_full)
                || scene.lights.iter().any(|light| light.radius > 0.0)
                || sky.is_full(),
            absorbs: materials.iter().any(RenderMaterial::absorbs),
            disperses: materials.iter().any(|material| material.dispersion.is_some()),
            materials: materials.into(),
            checkers: checkers.into(),
            lights: scene
                .lights
                .iter()
                .filter(|light| !light.hidden)
                .map(|light| RenderLight::new(light, &space))
                .collect(),
            camera: RenderCamera::new(&scene.camera, surroundings, space.origin),
            sky,
            ambient: numbers(scene.environment.ambient),
            generations: generations.clamp(1, Tracing::MAX_GENERATIONS),
            threshold: threshold as f32,
            lanes,
            to_lights: OnceLock::new(),
            added: 0,
            log: EditLog::new(),
        };
        stage.candidates_to_lights();
        Ok(stage)
    }

    /// The same stage with another limit of generations (at least 1).
    pub fn with_generations(mut self, generations: u32) -> Self {
        self.generations = generations.clamp(1, Tracing::MAX_GENERATIONS);
        self
    }

    /// Whether samples of one pixel differ by chance, so that a picture wants many: rough surfaces, lights that are balls,
    /// bodies that split light.
    pub fn is_noisy(&self) -> bool {
        self.disperses
            || self.lights.iter().any(|light| light.radius > 0.0)
            || self.materials.iter().any(|material| material.alpha > 0.0)
    }

    /// Whether rays may split in two, so that trees may grow with a power of the generations: light passes through some body.
    pub fn forks(&self) -> bool {
        self.has_transparency
    }

    /// Number of bodies.
    pub fn body_count(&self) -> usize {
        self.bodies.len()
    }

    /// Number of lights.
    pub fn light_count(&self) -> usize {
        self.lights.len()
    }

    /// The limit of generations.
    pub fn generations(&self) -> u32 {
        self.generations
    }

    /// The weight below which rays are not traced.
    pub fn threshold(&self) -> f32 {
        self.threshold
    }

    /// The camera.
    pub fn camera(&self) -> &RenderCamera {
        &self.camera
    }

    /// The same stage seen by another camera; nothing is prepared again.
    pub fn camera_for(&self, camera: &Camera) -> RenderCamera {
        self.camera.replaced_by(camera)
    }

    /// How far all bodies of `scene`, which the stage was prepared from, are from the camera's target, meters, if a parallel or
    /// very narrow view is aimed so far beside them that the rounding of single precision shows in its picture.
    pub fn target_beside(&self, scene: &Scene) -> Option<f64> {
        self.space.target_beside(scene)
    }

    /// Whether pictures through a camera are as exact in this stage of `scene` as in one prepared for it.
    pub fn suits(&self, scene: &Scene, camera: &Camera) -> bool {
        let is_double = |scene_index: usize| self.doubles.get(scene_index as u32).is_some();
        let largest = if self.has_doubles() { f64::INFINITY } else { self.largest_extent };
        self.space.suits(scene, camera, largest, is_double)
    }

    /// A point of the space of the rays in the world, meters: rays are traced about an origin near what is seen, where
    /// single precision is exact.
    pub fn world_from_render(&self, point: impl Into<Vec3>) -> DVec3 {
        self.space.origin + point.into().as_dvec3()
    }

    /// A point of the world in the space of the rays, meters.
    pub(crate) fn render_from_world(&self, point: DVec3) -> DVec3 {
        self.space.render_from_world(point)
    }

    /// A ray from a free point of the world in a direction of length 1.
    pub fn ray_from_point(&self, point: DVec3, direction: impl Into<Vec3A>) -> Ray {
        Ray::from_point(self.space.render_from_world(point).as_vec3a(), direction)
    }

    /// The place in [`Scene::bodies`] of the stage's body `index`.
    pub fn scene_index(&self, index: u32) -> Option<usize> {
        self.scene_indices.get(index as usize).map(|&scene_index| scene_index as usize)
    }

    /// Which of two bodies comes first in the scene.
    pub(crate) fn scene_order(&self, a: u32, b: u32) -> std::cmp::Ordering {
        self.scene_indices.get(a as usize).cmp(&self.scene_indices.get(b as usize))
    }

    /// A number for the bodies and the hierarchy as they are: only copies that were not edited share it.
    pub fn state(&self) -> u64 {
        self.log.state()
    }

    /// What has changed of the bodies and the hierarchy since a [state](Self::state); `None` if that is not known.
    pub fn changes_since(&self, state: u64) -> Option<SceneChanges> {
        self.log.since(state)
    }

    /// Bytes held by the stage's arrays, without what is known of a handful of bodies beforehand.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.bodies)
            + size_of_val(&*self.spheres)
            + size_of_val(&*self.scene_indices)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.checkers)
            + size_of_val(&*self.lights)
            + match &self.hierarchy {
                Accelerator::Few => 0,
                Accelerator::Many(bvh) => bvh.bytes(),
            }
    }

    /// The unbounded bodies.
    pub(crate) fn planes(&self) -> Range<u32> {
        self.bounded..self.bodies.len() as u32
    }

    pub(crate) fn body(&self, index: u32) -> &RenderBody {
        &self.bodies[index as usize]
    }

    /// Whether some body is in double precision: then little is known of where bodies lie before they are tested.
    pub(crate) fn has_doubles(&self) -> bool {
        !self.doubles.is_empty()
    }

    /// The body at this place in double precision, if it is.
    fn double(&self, index: u32) -> Option<&Body64> {
        self.doubles.get(*self.scene_indices.get(index as usize)?)
    }

    /// Where lines of the space of the rays, of directions of length 1, cross a body.
    #[inline(always)]
    pub(crate) fn span<W: Width>(
        &self,
        w: W,
        (index, body): (u32, &RenderBody),
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> ShapeSpan<W::R> {
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return double.span(w, origin, direction);
        }
        body.span(origin, direction)
    }

    /// Where such lines cross a face of a body at `t`, as [`RenderBody::point_on_face`].
    #[inline(always)]
    pub(crate) fn point_on_face<W: Width>(
        &self,
        w: W,
        (index, body): (u32, &RenderBody),
        line: (Vector<W::R>, Vector<W::R>),
        t: W::R,
        leaving: W::M,
        face: W::R,
    ) -> SurfacePoint<W::R> {
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return double.surface_point(w, line.0, line.1, leaving);
        }
        body.point_on_face(line, t, leaving, face)
    }

    /// Where a line crosses a body's surface at `t`, on the way out if it is `leaving`.
    pub(crate) fn surface_point(
        &self,
        index: u32,
        (origin, direction): (Vector<f32>, Vector<f32>),
        t: f32,
        leaving: bool,
    ) -> SurfacePoint<f32> {
        let body = self.body(index);
        let span = self.span(ScalarWidth, (index, body), origin, direction);
        let face = if leaving { span.exit_face } else { span.enter_face };
        self.point_on_face(ScalarWidth, (index, body), (origin, direction), t, leaving, face)
    }

    /// Where lines cross a body, and |cos| of the angles between them and the normals where they enter and leave.
    #[inline(always)]
    pub(crate) fn span_and_cosines<W: Width>(
        &self,
        w: W,
        index: u32,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> (ShapeSpan<W::R>, [W::R; 2]) {
        let body = self.body(index);
        if W::TESTS_DOUBLES
            && body.is_double()
            && let Some(double) = self.double(index)
        {
            return (double.span(w, origin, direction), double.cosines(w, origin, direction));
        }
        let span = body.span(origin, direction);
        let cosine = |t, face| body.cosine(origin, direction, t, face);
        (span, [cosine(span.enter, span.enter_face), cosine(span.exit, span.exit_face)])
    }

    /// Whether a point of the space of the rays lies in a body.
    pub(crate) fn contains(&self, index: u32, point: Vector<f32>) -> bool {
        match self.double(index) {
            Some(double) => double.contains(point),
            None => self.body(index).contains(point),
        }
    }

    /// The sphere around a bounded body.
    pub(crate) fn sphere(&self, index: u32) -> &BoundingSphere {
        &self.spheres[index as usize]
    }

    /// Asks for bodies of a leaf, which are probably wanted soon.
    #[inline(always)]
    pub(crate) fn fetch(&self, places: Range<u32>) {
        // Seldom there is a line of the cache between the first and the last one.
        ahead::fetch(&self.spheres, places.start);
        ahead::fetch(&self.spheres, places.end.saturating_sub(1));
        places.for_each(
            #[inline(always)]
            |index| ahead::fetch(&self.bodies, index),
        );
    }

    pub(crate) fn material(&self, body: &RenderBody) -> &RenderMaterial {
        &self.materials[body.material as usize]
    }
}

/// A color as single-precision components.
fn numbers(color: Color) -> [f32; 3] {
    color.to_array().map(|component| component as f32)
}
