//! A handful of bodies as they are seen from where most rays start or end.

use crate::search::Candidates;
use crate::stage::{FloorCandidates, ShadowCandidates, CameraRays, VisibleBodies, RenderScene, RenderCamera};

/// Where rays come from, as far as it tells what they may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CandidateSource {
    /// The eye.
    Eye,
    /// The eye, and the floor of the tile has reflected them.
    Floor,
    /// The inside of this bounded body, and of no other.
    Within(u32),
    Elsewhere,
}

/// The bodies of a stage as they are seen from the eye and from the lights, if they are a handful.
#[derive(Debug)]
pub(super) struct TileCandidates<'a> {
    from_eye: Option<VisibleBodies>,
    /// What of it the rays of a tile may meet.
    ahead: VisibleBodies,
    outlook: &'a ShadowCandidates,
    floors: FloorCandidates,
    /// Whether the next rays that do not come from the eye are its own, reflected by the tile's floor.
    are_next_of_floor: bool,
}

impl<'a> TileCandidates<'a> {
    pub(super) fn new(stage: &'a RenderScene, camera: &RenderCamera) -> Self {
        Self {
            from_eye: camera.eye().and_then(|eye| stage.seen_from(eye.into())),
            ahead: VisibleBodies::default(),
            outlook: stage.outlook(),
            floors: FloorCandidates::new(stage),
            are_next_of_floor: false,
        }
    }

    /// Looks ahead along the rays within `reach` pixels of the middle of those.
    pub(super) fn aim(&mut self, stage: &RenderScene, rays: &CameraRays, reach: [f32; 2]) {
        if let Some(from_eye) = &self.from_eye {
            self.ahead.keep(stage, from_eye, rays.cone(reach), rays.way());
            self.floors.aim(stage, (rays, reach), from_eye, &self.outlook.from_lights);
        }
    }

    /// See [`WhittedIntegrator::expect_reflections`](super::Whitted::expect_reflections).
    pub(super) fn expect_reflections(&mut self, are_of_floor: bool) {
        self.are_next_of_floor = are_of_floor;
    }

    /// Where rays come from that come from the eye or do not, and are inside of this body only, if of one.
    #[inline(always)]
    pub(super) fn whence(&mut self, are_from_eye: bool, inside: Option<u32>) -> CandidateSource {
        if are_from_eye {
            return if self.from_eye.is_some() { CandidateSource::Eye } else { CandidateSource::Elsewhere };
        }
        if std::mem::take(&mut self.are_next_of_floor) {
            return CandidateSource::Floor;
        }
        match inside {
            Some(body) if self.outlook.within(body).is_some() => CandidateSource::Within(body),
            _ => CandidateSource::Elsewhere,
        }
    }

    /// What rays may meet, those from the eye being those that were [aimed](Self::aim).
    #[inline(always)]
    pub(super) fn along(&self, whence: CandidateSource) -> Candidates<'_> {
        match whence {
            CandidateSource::Eye => Candidates::Seen(&self.ahead),
            CandidateSource::Floor => Candidates::Seen(self.floors.reflected()),
            CandidateSource::Within(body) => self.outlook.within(body).map_or(Candidates::Anything, Candidates::Seen),
            CandidateSource::Elsewhere => Candidates::Anything,
        }
    }

    /// Whether a body is the floor of the tile.
    #[inline(always)]
    pub(super) fn is_floor(&self, body: u32) -> bool {
        self.floors.floor() == Some(body)
    }

    /// What rays may meet on their way to a light, if they start from one body, with [`INWARDS`] from its inner side, or from
    /// various, [`NO_BODY`]; `on_floor` stands where that is the tile's floor and they start where the tile's rays met it.
    ///
    /// [`NO_BODY`]: crate::ray::NO_BODY
    /// [`INWARDS`]: crate::ray::INWARDS
    #[inline(always)]
    pub(super) fn to_light(&self, light: usize, start: u32, on_floor: bool) -> Candidates<'_> {
        let Some(all) = self.outlook.to_light(light) else { return Candidates::Anything };
        let some =
            if on_floor { self.floors.to_light(light) } else { self.outlook.to_light_from(light, start) };
        Candidates::Seen(some.unwrap_or(all))
    }
}
