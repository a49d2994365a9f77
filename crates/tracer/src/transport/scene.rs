//! The prepared scene: everything a ray can meet, in flat arrays.

pub(crate) mod build;
pub(crate) mod edit;
pub(crate) mod log;
pub(crate) mod subset;

use std::sync::{Arc, OnceLock};

use catoptric_scene::{Camera, Scene, Shape, Tracing};
use glam::{DVec3, Vec3, Vec3A};
use rayon::prelude::*;

use crate::geometry::body::RenderBody;
use crate::geometry::body::double::Bodies64;
use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::entry::BuildEntry;
use crate::geometry::joined::JoinedBodies;
use crate::geometry::plane_frame::PlaneFrame;
use crate::geometry::ray::Ray;
use crate::geometry::space::RenderSpace;
use crate::geometry::visible_bodies::VisibleBodies;
use crate::geometry::{Accelerator, AcceleratorChoice, Geometry};
use crate::simd::wide::SimdLevel;
use crate::transport::camera::{ExtentPlane, RenderCamera, SceneExtent};
pub(crate) use crate::transport::color::linear_rgb;
use crate::transport::environment::EnvironmentLight;
use crate::transport::light::RenderLight;
use crate::transport::scene::build::{BodyBuild, JoinedBuild};
use crate::transport::scene::log::EditLog;
pub(crate) use crate::transport::scene::log::SceneChanges;
use crate::transport::surface::bsdf::BodyMaterials;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::texture::solid::SolidNode;

/// A scene prepared for tracing, shared by reference between threads.
///
/// Bodies stand in the order of the bounding volume hierarchy's leaves, the unbounded ones last. What
/// the search reads is plain single-precision data.
#[derive(Clone, Debug)]
pub struct RenderScene {
    pub(crate) geometry: Geometry,
    // Shared with the scenes of some of the bodies.
    pub(crate) materials: Arc<Vec<RenderMaterial>>,
    /// The patterns of bodies, those of a body in a row.
    pub(crate) solids: Arc<Vec<SolidNode>>,
    pub(crate) lights: Arc<[RenderLight]>,
    pub(crate) camera: RenderCamera,
    pub(crate) sky: EnvironmentLight,
    pub(crate) ambient: [f32; 3],
    pub(crate) generations: u32,
    pub(crate) threshold: f32,
    /// Whether there is more than Phong's model in plain colors, point lights, even surroundings and air between bodies, or
    /// was before an edit.
    pub(crate) is_full: bool,
    /// Whether light is lost in some body.
    pub(crate) absorbs: bool,
    /// Whether some body splits light into its colors.
    pub(crate) disperses: bool,
    /// How many rays are traced side by side: kept, since asking the processor can take longer than a tile.
    pub(crate) lanes: SimdLevel,
    /// For each light, the bodies that may stand in the way to it: [`Self::candidates_to_lights`] finds them.
    to_lights: OnceLock<Vec<Option<VisibleBodies>>>,
    /// Materials and patterns that edits have added.
    added: u32,
    /// What edits have changed of the bodies and the hierarchy.
    log: EditLog,
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
    /// More bodies than the scene can number.
    #[error("{0} bodies are too many: at most {limit} can be traced", limit = RenderScene::MAX_BODIES)]
    TooManyBodies(usize),
    /// A union, an intersection or a difference has more parts than a ray can keep apart.
    #[error("body {body}: {parts} parts are too many: at most {limit} can be joined", limit = Shape::MAX_PARTS)]
    TooManyParts {
        /// The body's name, or its number in the scene counted from 1.
        body: String,
        /// How many simple parts it has.
        parts: u32,
    },
}

/// Where rays from the eye may meet something: within the bounds of the bodies that have some, and at planes; anywhere if what
/// has no end is joined of others.
fn extent_of(
    bounds: Bounds,
    geometry: &Geometry,
    materials: &[RenderMaterial],
    scene: &Scene,
) -> SceneExtent {
    let are_planes = geometry.planes().all(|index| !geometry.body(index).is_joined());
    let planes = geometry.planes().map(|index| {
        let kept = geometry.body(index);
        let number = geometry.numbers.get(index as usize).copied().unwrap_or(u32::MAX);
        let absorbs = materials.get(kept.material as usize).is_some_and(RenderMaterial::absorbs);
        // Of members of groups, there is only what is kept of them.
        let own = scene.bodies.get(number as usize).filter(|body| body.shape == Shape::Plane);
        let (point, normal) = own.map_or_else(
            || PlaneFrame::of(kept).point_and_normal(),
            |body| {
                let frame = body.placement.world_from_body();
                let normal = frame.matrix3.inverse().transpose() * DVec3::Y;
                (geometry.space.render_from_world(frame.translation), normal.normalize_or(DVec3::Y))
            },
        );
        ExtentPlane { point, normal, absorbs }
    });
    SceneExtent::new(are_planes.then_some(bounds), planes)
}

impl RenderScene {
    /// The largest number of bodies.
    pub const MAX_BODIES: usize = 1 << 30;

    /// Up to this many bounded bodies, all bounding spheres are tested; from then on a hierarchy of boxes is quicker.
    pub const FEW: usize = Geometry::FEW;

    /// From so many bounded bodies on, rays from the eye are sorted by what they may meet, as all others are in a hierarchy.
    pub const VERY_MANY: usize = Geometry::VERY_MANY as usize;

    /// Prepares `scene`, whose values are taken to be valid. Hidden bodies and lights are left out.
    ///
    /// # Errors
    /// When a body that is not hidden names an undefined material, or there are too many bodies.
    pub fn build(scene: &Scene) -> Result<Self, SceneBuildError> {
        Self::build_with(scene, AcceleratorChoice::Quickest)
    }

    /// Prepares `scene` with a choice of how bodies are found, for measuring what it is worth.
    ///
    /// # Errors
    /// As for [`Self::build`].
    pub fn build_with(scene: &Scene, search: AcceleratorChoice) -> Result<Self, SceneBuildError> {
        Self::build_for_camera(scene, &scene.camera, search)
    }

    /// Prepares `scene` to be seen by a camera that may be another than its own.
    ///
    /// Numbers are exact for pictures from where this camera is; [`Self::suits`] tells whether they are for another.
    ///
    /// # Errors
    /// As for [`Self::build`].
    pub fn build_for_camera(
        scene: &Scene,
        camera: &Camera,
        search: AcceleratorChoice,
    ) -> Result<Self, SceneBuildError> {
        if scene.bodies.len() > Self::MAX_BODIES {
            return Err(SceneBuildError::TooManyBodies(scene.bodies.len()));
        }
        let space = RenderSpace::of(scene, camera);
        let BodyBuild { mut entries, planes, bodies, joined, materials, solids, doubles } =
            BodyBuild::of(scene, &space)?;
        let hierarchy = Accelerator::over(&mut entries, search);
        let bounds = hierarchy.bounds(&entries);
        let whole = entries.par_iter().map(BuildEntry::place).chain(planes.par_iter().copied());
        let parts = joined.par_iter().flat_map_iter(JoinedBuild::parts);
        let numbers: Vec<u32> = whole.chain(parts).collect();
        let (bounded, first_part) = (entries.len(), entries.len() + planes.len());
        drop(entries);
        let members = Arc::new(bodies.members());
        let bodies: Vec<RenderBody> = numbers.par_iter().map(|&number| bodies.body(number)).collect();
        let Tracing { generations, threshold } = scene.tracing;
        let sky = EnvironmentLight::new(&scene.environment);
        let lanes = match &hierarchy {
            _ if !doubles.is_empty() => SimdLevel::with_doubles(),
            Accelerator::Few => SimdLevel::for_few(),
            Accelerator::Many(_) => SimdLevel::widest(),
        };
        let geometry = Geometry {
            bounded: bounded as u32,
            spheres: bodies[..bounded].par_iter().map(RenderBody::bounding_sphere).collect(),
            largest_error_bound: bodies.par_iter().map(|body| body.error_bound).reduce(|| 0.0, f32::max),
            largest_extent: bodies.par_iter().map(RenderBody::extent).reduce(|| 0.0, f64::max),
            doubles: Arc::new(Bodies64::new(doubles)),
            has_transparency: materials.iter().any(RenderMaterial::is_transparent),
            has_cemented: Geometry::has_cemented(&bodies),
            joined: JoinedBodies::new(
                &bodies,
                first_part as u32,
                joined.into_iter().map(|joined| joined.tree),
            ),
            hierarchy,
            space,
            bodies,
            numbers,
            members,
        };
        let surroundings = extent_of(bounds, &geometry, &materials, scene);
        let render_scene = Self {
            is_full: materials.iter().any(RenderMaterial::is_full)
                || geometry.has_cemented
                || scene.lights.iter().any(|light| light.radius > 0.0)
                || sky.is_full(),
            geometry,
            absorbs: materials.iter().any(RenderMaterial::absorbs),
            disperses: materials.iter().any(|material| material.dispersion.is_some()),
            materials: materials.into(),
            solids: solids.into(),
            lights: scene
                .lights
                .iter()
                .filter(|light| !light.hidden)
                .map(|light| RenderLight::new(light, &space))
                .collect(),
            camera: RenderCamera::new(&scene.camera, surroundings, space.origin),
            sky,
            ambient: linear_rgb(scene.environment.ambient),
            generations: generations.clamp(1, Tracing::MAX_GENERATIONS),
            threshold: threshold as f32,
            lanes,
            to_lights: OnceLock::new(),
            added: 0,
            log: EditLog::new(),
        };
        render_scene.candidates_to_lights();
        Ok(render_scene)
    }

    /// This scene with another limit of generations (at least 1).
    pub fn with_generations(mut self, generations: u32) -> Self {
        self.generations = generations.clamp(1, Tracing::MAX_GENERATIONS);
        self
    }

    /// This scene traced in a width of choice, for measuring what the best one is worth. Bodies in double precision need the
    /// width that knows of them, which stays then.
    pub fn at_level(mut self, level: SimdLevel) -> Self {
        if !self.geometry.has_doubles() {
            self.lanes = level;
        }
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
        self.geometry.has_transparency
    }

    /// Number of bodies, each member of a group counted, a joined body as one.
    pub fn body_count(&self) -> usize {
        self.geometry.joined.first_part as usize
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

    /// The camera of this scene replaced by another; nothing is prepared again.
    pub fn camera_for(&self, camera: &Camera) -> RenderCamera {
        self.camera.replaced_by(camera)
    }

    /// How far all bodies of `scene`, which the scene was prepared from, are from the camera's target, meters, if a parallel or
    /// very narrow view is aimed so far beside them that the rounding of single precision shows in its picture.
    pub fn target_beside(&self, scene: &Scene) -> Option<f64> {
        self.geometry.space.target_beside(scene)
    }

    /// Whether pictures through a camera are as exact in this scene of `scene` as in one prepared for it.
    pub fn suits(&self, scene: &Scene, camera: &Camera) -> bool {
        let is_double = |scene_index: usize| self.geometry.doubles.get(scene_index as u32).is_some();
        let largest = if self.geometry.has_doubles() { f64::INFINITY } else { self.geometry.largest_extent };
        self.geometry.space.suits(scene, camera, largest, is_double)
    }

    /// A point of the space of the rays in the world, meters: rays are traced about an origin near what is seen, where
    /// single precision is exact.
    pub fn world_from_render(&self, point: impl Into<Vec3>) -> DVec3 {
        self.geometry.world_from_render(point)
    }

    /// A point of the world in the space of the rays, meters.
    pub(crate) fn render_from_world(&self, point: DVec3) -> DVec3 {
        self.geometry.space.render_from_world(point)
    }

    /// A ray from a free point of the world in a direction of length 1.
    pub fn ray_from_point(&self, point: DVec3, direction: impl Into<Vec3A>) -> Ray {
        Ray::from_point(self.geometry.space.render_from_world(point).as_vec3a(), direction)
    }

    /// The place in [`Scene::bodies`] of the scene's body `index`.
    pub fn scene_index(&self, index: u32) -> Option<usize> {
        self.geometry.scene_index(index)
    }

    /// A number for body `index`, or for the whole that it is a part of: its place in [`Scene::bodies`], or beyond those
    /// its place among the members of groups.
    pub(crate) fn number(&self, index: u32) -> Option<usize> {
        let whole = self.geometry.joined.whole_of(index, false).body;
        self.geometry.numbers.get(whole as usize).map(|&number| number as usize)
    }

    /// A number for the bodies and the hierarchy as they are: only copies that were not edited share it.
    pub fn state(&self) -> u64 {
        self.log.state()
    }

    /// What has changed of the bodies and the hierarchy since a [state](Self::state); `None` if that is not known.
    pub fn changes_since(&self, state: u64) -> Option<SceneChanges> {
        self.log.since(state)
    }

    /// Bytes held by the scene's arrays, without what is known of a handful of bodies beforehand.
    pub fn bytes(&self) -> usize {
        self.geometry.bytes()
            + size_of_val(&*self.materials)
            + size_of_val(&*self.solids)
            + size_of_val(&*self.lights)
    }

    /// For each light that is a point, what may stand in the way to it, if there are few bodies; found once.
    pub(crate) fn candidates_to_lights(&self) -> &[Option<VisibleBodies>] {
        let to_light = |light: &RenderLight| match light.radius {
            0.0 => self.geometry.candidates_to_light(light.position),
            _ => None,
        };
        self.to_lights.get_or_init(|| self.lights.iter().map(to_light).collect())
    }

    /// This scene with all bodies as candidates of shadow rays, for measuring what it is worth to know fewer.
    pub fn without_candidates(self) -> Self {
        Self { to_lights: OnceLock::from(Vec::new()), ..self }
    }

    pub(crate) fn material(&self, body: &RenderBody) -> &RenderMaterial {
        &self.materials[body.material as usize]
    }

    /// The materials of bodies by their places.
    #[inline(always)]
    pub(crate) fn body_materials(&self) -> BodyMaterials<'_> {
        BodyMaterials { geometry: &self.geometry, materials: &self.materials }
    }
}
