//! The prepared scene: everything a ray can meet, in flat arrays.

mod body;
mod bounds;
mod bvh;
mod camera;
mod checker;
mod few;
mod light;
mod material;
mod only;

use std::ops::Range;
use std::sync::Arc;

use catoptric_scene::{Body, Camera, Color, Scene, Tracing};
use glam::DVec3;
use rayon::prelude::*;

pub(crate) use body::StageBody;
pub(crate) use bounds::Bounds;
pub(crate) use bvh::Bvh;
pub(crate) use bvh::{PacketPart, Visit};
pub use camera::StageCamera;
use camera::Surroundings;
pub(crate) use checker::StageChecker;
use few::FewBodies;
pub(crate) use light::StageLight;
pub(crate) use material::StageMaterial;

use material::MaterialTable;

/// A scene prepared for tracing: immutable, shared by reference between threads.
///
/// Bodies stand in the order of the bounding volume hierarchy's leaves, the unbounded ones last. What
/// the search reads is plain single-precision data.
#[derive(Clone, Debug)]
pub struct Stage {
    pub(crate) bodies: Vec<StageBody>,
    /// The place in [`Scene::bodies`] of each body of the stage.
    pub(crate) scene_indices: Vec<u32>,
    /// How many of the bodies are bounded; planes follow them.
    pub(crate) bounded: u32,
    pub(crate) hierarchy: Hierarchy,
    // Shared with the stages of some of the bodies.
    pub(crate) materials: Arc<[StageMaterial]>,
    pub(crate) checkers: Arc<[StageChecker]>,
    pub(crate) lights: Arc<[StageLight]>,
    pub(crate) camera: StageCamera,
    pub(crate) background: [f32; 3],
    pub(crate) ambient: [f32; 3],
    pub(crate) generations: u32,
    pub(crate) threshold: f32,
    pub(crate) has_transparency: bool,
    /// The largest [`StageBody::slack`].
    pub(crate) largest_slack: f32,
}

/// How the bodies that a ray may meet are found among the bounded ones.
#[derive(Clone, Debug)]
pub(crate) enum Hierarchy {
    Few(FewBodies),
    Many(Bvh),
}

impl Hierarchy {
    /// The hierarchy over these boxes, which are put into its order.
    fn over(boxes: &mut [(Bounds, u32)], kind: impl Fn(u32) -> u32 + Copy + Sync) -> Self {
        if boxes.len() <= Stage::FEW {
            boxes.sort_by_key(|&(_, index)| kind(index));
            Self::Few(FewBodies::new(boxes.iter().map(|entry| entry.0)))
        } else {
            Self::Many(Bvh::build(boxes, kind))
        }
    }
}

/// Why a scene cannot be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StageError {
    /// A body names a material that the scene does not define.
    #[error("body {body}: the material \"{material}\" is not defined")]
    UndefinedMaterial {
        /// The body's name, or its number in the scene counted from 1.
        body: String,
        /// The name that was looked for.
        material: String,
    },
    /// More bodies than the stage can number.
    #[error("{0} bodies are too many: at most {limit} can be traced", limit = Stage::MAX_BODIES)]
    TooManyBodies(usize),
}

impl Stage {
    /// The largest number of bodies.
    pub const MAX_BODIES: usize = 1 << 30;

    /// Up to this many bounded bodies, all bounding spheres are tested; from then on a hierarchy of boxes is quicker.
    const FEW: usize = 12;

    /// Prepares `scene`, whose values are taken to be valid. Hidden bodies and lights are left out.
    ///
    /// # Errors
    /// When a body that is not hidden names an undefined material, or there are too many bodies.
    pub fn prepare(scene: &Scene) -> Result<Self, StageError> {
        if scene.bodies.len() > Self::MAX_BODIES {
            return Err(StageError::TooManyBodies(scene.bodies.len()));
        }
        let mut cast = Cast::prepare(scene)?;
        let camera = StageCamera::new(&scene.camera, cast.surroundings(scene));
        let (order, hierarchy) = cast.order();
        let bounded = cast.boxes.len() as u32;
        let largest_slack = order.iter().map(|&index| cast.bodies[index as usize].slack).fold(0.0, f32::max);
        let Tracing { generations, threshold } = scene.tracing;
        Ok(Self {
            bodies: cast.take_bodies(&order),
            scene_indices: order,
            bounded,
            hierarchy,
            largest_slack,
            has_transparency: cast.materials.iter().any(StageMaterial::is_transparent),
            materials: cast.materials.into(),
            checkers: cast.checkers.into(),
            lights: scene.lights.iter().filter(|light| !light.hidden).map(StageLight::new).collect(),
            camera,
            background: numbers(scene.environment.background),
            ambient: numbers(scene.environment.ambient),
            generations: generations.clamp(1, Tracing::MAX_GENERATIONS),
            threshold: threshold as f32,
        })
    }

    /// The same stage with another limit of generations (at least 1).
    pub fn with_generations(mut self, generations: u32) -> Self {
        self.generations = generations.clamp(1, Tracing::MAX_GENERATIONS);
        self
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

    /// The camera.
    pub fn camera(&self) -> &StageCamera {
        &self.camera
    }

    /// The same stage seen by another camera; nothing is prepared again.
    pub fn camera_for(&self, camera: &Camera) -> StageCamera {
        self.camera.replaced_by(camera)
    }

    /// The place in [`Scene::bodies`] of the stage's body `index`.
    pub fn scene_index(&self, index: u32) -> Option<usize> {
        self.scene_indices.get(index as usize).map(|&scene_index| scene_index as usize)
    }

    /// Which of two bodies comes first in the scene.
    pub(crate) fn scene_order(&self, a: u32, b: u32) -> std::cmp::Ordering {
        self.scene_indices.get(a as usize).cmp(&self.scene_indices.get(b as usize))
    }

    /// Bytes held by the stage's arrays.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.bodies)
            + size_of_val(&*self.scene_indices)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.checkers)
            + size_of_val(&*self.lights)
            + match &self.hierarchy {
                Hierarchy::Few(few) => few.bytes(),
                Hierarchy::Many(bvh) => bvh.bytes(),
            }
    }

    /// The unbounded bodies.
    pub(crate) fn planes(&self) -> Range<u32> {
        self.bounded..self.bodies.len() as u32
    }

    pub(crate) fn body(&self, index: u32) -> &StageBody {
        &self.bodies[index as usize]
    }

    pub(crate) fn material(&self, body: &StageBody) -> &StageMaterial {
        &self.materials[body.material as usize]
    }
}

/// The bodies of a scene on their way to the stage, in the scene's order.
struct Cast {
    bodies: Vec<StageBody>,
    materials: Vec<StageMaterial>,
    checkers: Vec<StageChecker>,
    /// The bounds of each bounded body with its place in `bodies`.
    boxes: Vec<(Bounds, u32)>,
    planes: Vec<u32>,
}

impl Cast {
    fn prepare(scene: &Scene) -> Result<Self, StageError> {
        let (mut bodies, bounds): (Vec<StageBody>, Vec<Option<Bounds>>) =
            scene.bodies.par_iter().map(StageBody::new).unzip();
        let mut table = MaterialTable::new(scene);
        let mut checkers = Vec::new();
        for (index, (prepared, body)) in bodies.iter_mut().zip(&scene.bodies).enumerate() {
            if body.hidden {
                continue;
            }
            let (material, source) =
                table.find(&body.material).ok_or_else(|| undefined_material(index, body))?;
            prepared.material = material;
            prepared.transparent = u16::from(table.prepared(material).is_transparent());
            if let Some(checker) = &source.checker {
                prepared.checker = checkers.len() as u32;
                checkers.push(StageChecker::new(checker, body));
            }
        }
        let mut boxes = Vec::with_capacity(bounds.len());
        let mut planes = Vec::new();
        for ((bounds, body), index) in bounds.into_iter().zip(&scene.bodies).zip(0..) {
            match bounds {
                _ if body.hidden => {}
                Some(bounds) => boxes.push((bounds, index)),
                None => planes.push(index),
            }
        }
        Ok(Self { bodies, materials: table.into_prepared(), checkers, boxes, planes })
    }

    /// What is in the way of rays from afar.
    fn surroundings(&self, scene: &Scene) -> Surroundings {
        let all = self.boxes.iter().fold(Bounds::EMPTY, |all, entry| all.union(entry.0));
        let (center, radius) = if self.boxes.is_empty() {
            (DVec3::ZERO, f64::INFINITY)
        } else {
            (0.5 * all.doubled_center().as_dvec3(), 0.5 * f64::from(all.min.distance(all.max)))
        };
        let plane = |&index: &u32| {
            let frame = scene.bodies[index as usize].placement.world_from_body();
            let normal = frame.matrix3.inverse().transpose() * DVec3::Y;
            (frame.translation, normal.normalize_or(DVec3::Y))
        };
        Surroundings { center, radius, planes: self.planes.iter().map(plane).collect() }
    }

    /// The order in which the bodies stand in the stage, and the hierarchy over the bounded ones.
    fn order(&mut self) -> (Vec<u32>, Hierarchy) {
        let hierarchy = Hierarchy::over(&mut self.boxes, |index| u32::from(self.bodies[index as usize].kind));
        let bounded = self.boxes.iter().map(|&(_, index)| index);
        (bounded.chain(self.planes.iter().copied()).collect(), hierarchy)
    }

    fn take_bodies(&mut self, order: &[u32]) -> Vec<StageBody> {
        let bodies = std::mem::take(&mut self.bodies);
        order.iter().map(|&index| bodies[index as usize]).collect()
    }
}

fn undefined_material(index: usize, body: &Body) -> StageError {
    StageError::UndefinedMaterial {
        body: if body.name.is_empty() {
            format!("number {}", index + 1)
        } else {
            format!("\"{}\"", body.name)
        },
        material: body.material.name().unwrap_or_default().to_owned(),
    }
}

/// A color as single-precision components.
fn numbers(color: Color) -> [f32; 3] {
    color.to_array().map(|component| component as f32)
}
