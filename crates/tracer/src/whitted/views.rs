//! A handful of bodies as they are seen from where most rays start or end.

use crate::search::Along;
use crate::stage::{Hierarchy, RaysNear, Sight, Stage, StageCamera};

/// The bodies of a stage as they are seen from the eye and from the lights, if they are a handful.
#[derive(Debug, Default)]
pub(super) struct Views {
    from_eye: Option<Vec<Sight>>,
    /// What of it the rays of a tile may meet.
    ahead: Vec<Sight>,
    /// For each light that is a point.
    from_lights: Vec<Option<Vec<Sight>>>,
}

impl Views {
    pub(super) fn new(stage: &Stage, camera: &StageCamera) -> Self {
        let Hierarchy::Few(few) = &stage.hierarchy else { return Self::default() };
        Self {
            from_eye: camera.eye().map(|eye| few.seen_from(eye.into())),
            ahead: Vec::new(),
            from_lights: stage
                .lights
                .iter()
                .map(|light| (light.radius == 0.0).then(|| few.seen_from(light.position)))
                .collect(),
        }
    }

    /// Looks ahead along the rays within `reach` pixels of the middle of those.
    pub(super) fn aim(&mut self, rays: &RaysNear, reach: [f32; 2]) {
        let Some(from_eye) = &self.from_eye else { return };
        let (axis, cos) = rays.cone(reach);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.ahead.clear();
        let met = from_eye.iter().filter(|sight| sight.is_met_by_cone(axis, cos, sin));
        self.ahead.extend(met.map(|sight| sight.nearer_by(rays.way())));
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
