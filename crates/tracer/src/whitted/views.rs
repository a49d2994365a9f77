//! A handful of bodies as they are seen from where most rays start or end.

use crate::search::Along;
use crate::stage::{Floors, RaysNear, Sights, Stage, StageCamera, StageLight};

/// Where rays come from, as far as it tells what they may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whence {
    /// The eye.
    Eye,
    /// The eye, and the floor of the tile has reflected them.
    Floor,
    Elsewhere,
}

/// The bodies of a stage as they are seen from the eye and from the lights, if they are a handful.
#[derive(Debug, Default)]
pub(super) struct Views {
    from_eye: Option<Sights>,
    /// What of it the rays of a tile may meet.
    ahead: Sights,
    /// For each light that is a point.
    from_lights: Vec<Option<Sights>>,
    /// By light and body, what may shade the body's outer side.
    before: Vec<Vec<Sights>>,
    floors: Floors,
    /// Whether the next rays that do not come from the eye are its own, reflected by the tile's floor.
    are_next_of_floor: bool,
}

impl Views {
    /// With more lights and bodies it would take long to find out what may shade what.
    const MOST_BEFORE: usize = 1 << 14;

    pub(super) fn new(stage: &Stage, camera: &StageCamera) -> Self {
        let from_light = |light: &StageLight| match light.radius {
            0.0 => stage.seen_from_light(light.position),
            _ => None,
        };
        let from_lights: Vec<_> = stage.lights.iter().map(from_light).collect();
        let bodies = stage.bounded as usize;
        let mut before = Vec::new();
        if bodies * bodies * from_lights.len() <= Self::MOST_BEFORE {
            let all = from_lights.iter().map(|all| all.as_ref().map(|all| stage.seen_before(all)));
            before.extend(all.map(Option::unwrap_or_default));
        }
        Self {
            from_eye: camera.eye().and_then(|eye| stage.seen_from(eye.into())),
            ahead: Sights::default(),
            from_lights,
            before,
            floors: Floors::new(stage),
            are_next_of_floor: false,
        }
    }

    /// Looks ahead along the rays within `reach` pixels of the middle of those.
    pub(super) fn aim(&mut self, stage: &Stage, rays: &RaysNear, reach: [f32; 2]) {
        if let Some(from_eye) = &self.from_eye {
            self.ahead.keep(stage, from_eye, rays.cone(reach), rays.way());
            self.floors.aim(stage, (rays, reach), from_eye, &self.from_lights);
        }
    }

    /// See [`Whitted::expect_reflections`](super::Whitted::expect_reflections).
    pub(super) fn expect_reflections(&mut self, are_of_floor: bool) {
        self.are_next_of_floor = are_of_floor;
    }

    /// Where rays come from that come from the eye or do not.
    #[inline(always)]
    pub(super) fn whence(&mut self, are_from_eye: bool) -> Whence {
        if are_from_eye {
            return if self.from_eye.is_some() { Whence::Eye } else { Whence::Elsewhere };
        }
        if std::mem::take(&mut self.are_next_of_floor) { Whence::Floor } else { Whence::Elsewhere }
    }

    /// What rays may meet, those from the eye being those that were [aimed](Self::aim).
    #[inline(always)]
    pub(super) fn along(&self, whence: Whence) -> Along<'_> {
        match whence {
            Whence::Eye => Along::Seen(&self.ahead),
            Whence::Floor => Along::Seen(self.floors.reflected()),
            Whence::Elsewhere => Along::Anything,
        }
    }

    /// Whether a body is the floor of the tile.
    #[inline(always)]
    pub(super) fn is_floor(&self, body: u32) -> bool {
        self.floors.floor() == Some(body)
    }

    /// What rays may meet on their way to a light, if they start from the outer side of one body or none, [`NO_BODY`];
    /// `on_floor` stands where that is the tile's floor and they start where the tile's rays met it.
    ///
    /// [`NO_BODY`]: crate::ray::NO_BODY
    #[inline(always)]
    pub(super) fn to_light(&self, light: usize, body: u32, on_floor: bool) -> Along<'_> {
        let Some(Some(all)) = self.from_lights.get(light) else { return Along::Anything };
        let some = if on_floor {
            self.floors.to_light(light)
        } else {
            self.before.get(light).and_then(|before| before.get(body as usize))
        };
        Along::Seen(some.unwrap_or(all))
    }
}
