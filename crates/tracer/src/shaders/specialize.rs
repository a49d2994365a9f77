//! Which shader fits a scene, and which scenes none does.

use crate::geometry::Accelerator;
use crate::geometry::body::RenderBody;
use crate::geometry::shape::ShapeKind;
use crate::shaders::constants::{MOST_INTERVALS, MOST_MEDIA, MOST_RAYS};
use crate::shaders::features::PhysicalFeatures;
use crate::transport::camera::RenderCamera;
use crate::transport::environment::EnvironmentLight;
use crate::transport::media::MediumStacks;
use crate::transport::scene::RenderScene;
use crate::transport::scene::log::SceneChanges;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::texture::solid::SolidNode;

/// What is found among the bodies of a scene, or was before an edit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneContents {
    /// A bit for each kind of shape.
    shapes: u32,
    /// How many are transparent, or more.
    transparent: usize,
    /// Whether light passes any as if it were not there.
    shadowless: bool,
    /// The longest way through the hierarchy of boxes, nodes; 0 without one.
    depth: u32,
    /// The most parts of a joined body.
    parts: u32,
}

/// What a shader is made for: scenes and cameras of one kind share it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ShaderSpecialization {
    /// A bit for each [`ShapeKind`] that occurs.
    pub shapes: u32,
    /// The longest way through the hierarchy of boxes, nodes; 0 where a few bounding spheres are tested instead.
    pub depth: u32,
    /// How many transparent bodies a ray may be inside of at once; 0 if there are none.
    pub media: u32,
    /// Whether light passes some bodies as if they were not there.
    pub shadowless: bool,
    /// How many rays of one tree may wait.
    pub stack: u32,
    /// Whether bodies have patterns.
    pub solids: bool,
    /// Whether there are others than checkerboards, or patterns within patterns.
    pub any_solids: bool,
    /// Whether primary rays start in different media: those of a parallel projection, among transparent bodies.
    pub asks_each_start: bool,
    /// What there is of physical materials and lights.
    pub physical: PhysicalFeatures,
    /// What surrounds the bodies.
    pub sky: EnvironmentKind,
    /// Whether there are pictures on bodies.
    pub textures: bool,
    /// How many parts a joined body may have; 0 if there are none.
    pub parts: u32,
    /// Whether groups have members, or joined bodies parts.
    pub members: bool,
}

/// What surrounds the bodies of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EnvironmentKind {
    /// The same light from everywhere.
    #[default]
    Even,
    /// Light that changes with the height.
    Gradient,
    /// A picture.
    Picture,
}

impl EnvironmentKind {
    fn of(scene: &RenderScene) -> Self {
        match scene.sky {
            EnvironmentLight::Even(_) => Self::Even,
            EnvironmentLight::Gradient { .. } => Self::Gradient,
            EnvironmentLight::Picture { .. } => Self::Picture,
        }
    }
}

/// What a graphics card cannot draw; the CPU can.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnsupportedOnGpu {
    /// Some body is huge beside what is seen, or extremely flat, and is intersected in double precision.
    #[error("a body is so large or so flat that it needs double precision, which the GPU does not have")]
    DoublePrecision,
    /// The eye stands inside of very many transparent bodies at once.
    #[error("the eye is inside of {0} transparent bodies at once; the GPU follows rays through {MOST_MEDIA}")]
    EyeMedia(usize),
    /// A ray came to be inside of very many transparent bodies at once; found out only while drawing.
    #[error(
        "a ray is inside of more than {MOST_MEDIA} transparent bodies at once, or a shadow ray goes through more than \
         {MOST_INTERVALS} where some absorb or are cemented; the GPU has no room for that"
    )]
    NestedMedia,
    /// The tree of a pixel has very many rays; found out only while drawing.
    #[error("a pixel needs more rays than the GPU follows at once, {MOST_RAYS} at most")]
    LongTree,
}

impl SceneContents {
    /// Looks at all bodies of a scene.
    pub fn of(scene: &RenderScene) -> Self {
        let trees = scene.geometry.joined.bodies.iter().map(|body| body.tree.parts);
        let mut contents =
            Self { depth: depth(scene), parts: trees.max().unwrap_or_default(), ..Self::default() };
        let (whole, parts) = scene.geometry.bodies.split_at(scene.body_count());
        contents.add(whole);
        // A whole is transparent if one of its parts is, and has no end if one of them has none.
        parts.iter().for_each(|part| contents.shapes |= shape_bit(part));
        contents
    }

    /// Takes up what bodies that have changed are now.
    pub fn follow(&mut self, scene: &RenderScene, changes: &SceneChanges) {
        for range in &changes.bodies {
            let range = range.start as usize..range.end as usize;
            self.add(scene.geometry.bodies.get(range).unwrap_or_default());
        }
    }

    fn add(&mut self, bodies: &[RenderBody]) {
        for body in bodies {
            self.shapes |= shape_bit(body);
            self.transparent += usize::from(body.is_transparent());
            self.shadowless |= body.is_shadowless();
        }
    }
}

/// None for a joined body: its parts tell.
fn shape_bit(body: &RenderBody) -> u32 {
    if body.is_joined() { 0 } else { 1 << u32::from(body.kind) }
}

impl ShaderSpecialization {
    /// The specialization for a scene seen through a camera, or what in them the shaders cannot draw.
    ///
    /// # Errors
    /// What is known beforehand not to fit; [`UnsupportedOnGpu::NestedMedia`] only shows while drawing.
    pub fn of(
        contents: &SceneContents,
        scene: &RenderScene,
        camera: &RenderCamera,
    ) -> Result<Self, UnsupportedOnGpu> {
        if scene.geometry.has_doubles() {
            return Err(UnsupportedOnGpu::DoublePrecision);
        }
        let physical = PhysicalFeatures::of(scene);
        let is_textured = |material: &RenderMaterial| material.texture.is_some();
        let around_eye = eye_media(scene, camera).len();
        if around_eye > MOST_MEDIA {
            return Err(UnsupportedOnGpu::EyeMedia(around_eye));
        }
        let SceneContents { shapes, transparent, shadowless, depth, parts } = *contents;
        let is_clear = transparent > 0;
        // One ray may wait for each generation, in the last one only one that goes straight on, and one more among waves; in
        // steps, so that fewer shaders are needed.
        let waiting = scene.generations() + u32::from(physical.has(PhysicalFeatures::DISPERSES));
        let media = transparent.min(MOST_MEDIA).next_power_of_two() as u32;
        Ok(Self {
            shapes,
            depth,
            media: if is_clear { media } else { 0 },
            stack: if is_clear { waiting.next_multiple_of(4) } else { 0 },
            shadowless,
            solids: !scene.solids.is_empty(),
            any_solids: !scene.solids.iter().all(SolidNode::is_checker_alone),
            asks_each_start: is_clear && camera.parallel_height().is_some(),
            physical,
            sky: EnvironmentKind::of(scene),
            textures: scene.materials.iter().any(is_textured),
            parts: if parts > 0 { parts.next_power_of_two() } else { 0 },
            members: !scene.geometry.members.scene_indices.is_empty(),
        })
    }

    /// Whether shapes of this kind occur.
    pub fn has(&self, kind: ShapeKind) -> bool {
        self.shapes & (1 << kind as u32) != 0
    }
}

/// The transparent bodies around the eye, the outermost first; none for a parallel projection.
pub(crate) fn eye_media(scene: &RenderScene, camera: &RenderCamera) -> Vec<u32> {
    let Some(eye) = camera.eye() else { return Vec::new() };
    let mut table = MediumStacks::default();
    let media = table.at_point(scene, eye);
    let mut bodies: Vec<u32> = table.bodies(media).collect();
    bodies.reverse();
    bodies
}

/// The longest way from the root through the nodes of the hierarchy; 0 without one.
fn depth(scene: &RenderScene) -> u32 {
    let Accelerator::Many(bvh) = &scene.geometry.hierarchy else { return 0 };
    let nodes = bvh.nodes();
    let mut depths = vec![1_u32; nodes.len()];
    let mut deepest = 1;
    // A node comes before those below it.
    for (index, node) in nodes.iter().enumerate() {
        let below = depths.get(index).map_or(1, |depth| depth + 1);
        for child in node.children() {
            if let Some(depth) = depths.get_mut(child as usize) {
                *depth = below;
                deepest = deepest.max(below);
            }
        }
    }
    deepest
}
