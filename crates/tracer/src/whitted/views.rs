//! A handful of bodies as they are seen from where most rays start or end.

use crate::search::Along;
use crate::stage::{RaysNear, Sights, Stage, StageCamera};

/// The bodies of a stage as they are seen from the eye and from the lights, if they are a handful.
#[derive(Debug, Default)]
pub(super) struct Views {
    from_eye: Option<Sights>,
    /// What of it the rays of a tile may meet.
    ahead: Sights,
    /// For each light that is a point.
    from_lights: Vec<Option<Sights>>,
}

impl Views {
    pub(super) fn new(stage: &Stage, camera: &StageCamera) -> Self {
        let lights = stage.lights.iter();
        Self {
            from_eye: camera.eye().and_then(|eye| stage.seen_from(eye.into())),
            ahead: Sights::default(),
            from_lights: lights
                .map(|light| if light.radius == 0.0 { stage.seen_from_light(light.position) } else { None })
                .collect(),
        }
    }

    /// Looks ahead along the rays within `reach` pixels of the middle of those.
    pub(super) fn aim(&mut self, stage: &Stage, rays: &RaysNear, reach: [f32; 2]) {
        if let Some(from_eye) = &self.from_eye {
            self.ahead.keep(stage, from_eye, rays.cone(reach), rays.way());
        }
    }

    /// What rays from the eye may meet that were [aimed](Self::aim) at.
    pub(super) fn ahead(&self) -> Along<'_> {
        if self.from_eye.is_some() { Along::From(&self.ahead) } else { Along::Anything }
    }

    /// What rays may meet on their way to a light.
    pub(super) fn to_light(&self, light: usize) -> Along<'_> {
        match self.from_lights.get(light) {
            Some(Some(sights)) => Along::To(sights),
            _ => Along::Anything,
        }
    }
}
