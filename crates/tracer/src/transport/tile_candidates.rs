//! What rays from the eye and rays to the lights may meet of a few bodies.

use crate::geometry::query::candidates::Candidates;
use crate::geometry::visible_bodies::VisibleBodies;
use crate::transport::camera::{CameraRays, RenderCamera};
use crate::transport::scene::RenderScene;

/// The bodies as they are seen from the eye, through a tile, and from the lights, if they are few.
#[derive(Debug)]
pub(crate) struct TileCandidates<'a> {
    from_eye: Option<VisibleBodies>,
    /// Those of them that rays through the tile may meet.
    in_tile: VisibleBodies,
    to_lights: &'a [Option<VisibleBodies>],
}

impl<'a> TileCandidates<'a> {
    pub(crate) fn new(scene: &'a RenderScene, camera: &RenderCamera) -> Self {
        Self {
            from_eye: camera.eye().and_then(|eye| scene.geometry.visible_from(eye.into())),
            in_tile: VisibleBodies::default(),
            to_lights: scene.candidates_to_lights(),
        }
    }

    /// Goes on to the tile whose rays lie within `t_max` pixels of the middle of these.
    pub(crate) fn begin_tile(&mut self, scene: &RenderScene, rays: &CameraRays, t_max: [f32; 2]) {
        if let Some(from_eye) = &self.from_eye {
            self.in_tile.keep(&scene.geometry, from_eye, rays.cone(t_max), rays.way());
        }
    }

    /// What rays from the eye through the tile may meet.
    #[inline(always)]
    pub(crate) fn through_tile(&self) -> Candidates<'_> {
        if self.from_eye.is_some() { Candidates::Only(&self.in_tile) } else { Candidates::All }
    }

    /// What rays may meet on their way to a light.
    #[inline(always)]
    pub(crate) fn to_light(&self, light: usize) -> Candidates<'_> {
        self.to_lights.get(light).and_then(Option::as_ref).map_or(Candidates::All, Candidates::Only)
    }
}
