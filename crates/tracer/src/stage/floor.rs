//! The plane that a tile looks at: what of a handful of bodies its reflection may show, and what may shade it.

use std::cell::OnceCell;

use glam::{DVec3, Vec3};

use super::level::PlaneFrame;
use super::sight::{ROUNDING, VisibleBodies};
use super::{CameraRays, RenderScene};
use crate::vector::Vector;

/// The planes of a stage as an eye looks at them, and the one that the rays of a tile go to.
#[derive(Debug, Default)]
pub(crate) struct FloorCandidates {
    mirrors: Vec<OnceCell<Option<FloorMirror>>>,
    /// If all rays of the tile meet the same plane, or something before it.
    floor: Option<u32>,
    /// What their reflections there may meet.
    reflected: VisibleBodies,
    /// What may lie between what they see of the plane and each of the lights that are points.
    to_lights: Vec<VisibleBodies>,
}

/// A plane in which all that is seen is seen as from the eye's mirror image.
#[derive(Debug)]
struct FloorMirror {
    level: PlaneFrame,
    bodies: VisibleBodies,
    /// Rays that go further up to the plane have too much rounding.
    longest_way: f64,
}

impl FloorMirror {
    /// So many times as far away as the eye is from the middle of the world.
    const LONGEST_WAY: f64 = 32.0;

    /// `None` if the plane may send rays elsewhere.
    fn new(stage: &RenderScene, plane: u32, eye: DVec3) -> Option<Self> {
        let body = stage.body(plane);
        if body.is_transparent() || stage.material(body).alpha > 0.0 {
            return None;
        }
        let level = PlaneFrame::of(body);
        let image = level.image(eye);
        let longest_way = Self::LONGEST_WAY * eye.abs().max(image.abs()).max_element();
        Some(Self { level, bodies: stage.seen_past(image, longest_way)?, longest_way })
    }
}

impl FloorCandidates {
    pub(crate) fn new(stage: &RenderScene) -> Self {
        let mirrors = stage.planes().map(|_| OnceCell::new()).collect();
        Self { mirrors, ..Self::default() }
    }

    /// The plane that all rays of the tile meet, or something before it.
    pub(crate) fn floor(&self) -> Option<u32> {
        self.floor
    }

    /// What their reflections there may meet.
    pub(crate) fn reflected(&self) -> &VisibleBodies {
        &self.reflected
    }

    /// What may lie between what they see of it and a light, of those that are points.
    pub(crate) fn to_light(&self, light: usize) -> Option<&VisibleBodies> {
        self.to_lights.get(light)
    }

    /// Looks along the rays within `reach` pixels of the middle of those. All bodies are `from_eye` and `from_lights` as
    /// they are seen from there.
    pub(crate) fn aim(
        &mut self,
        stage: &RenderScene,
        (rays, reach): (&CameraRays, [f32; 2]),
        from_eye: &VisibleBodies,
        from_lights: &[Option<VisibleBodies>],
    ) {
        self.floor = None;
        let eye = from_eye.point;
        let (axis, cos) = rays.cone(reach);
        let exactly = |direction: Vector<f32>| Vec3::from(direction).as_dvec3();
        let middle = exactly(axis);
        let ways = stage.planes().map(|plane| (plane, PlaneFrame::of(stage.body(plane)).way(eye, middle)));
        let Some((plane, way)) = ways.min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        let Some(cell) = self.mirrors.get((plane - stage.bounded) as usize) else { return };
        if way == f64::INFINITY {
            return;
        }
        let Some(mirror) = cell.get_or_init(|| FloorMirror::new(stage, plane, eye)) else { return };
        let level = &mirror.level;
        let corners = rays.corners(reach).map(exactly);
        let ways = corners.map(|direction| level.way(eye, direction));
        let longest = ways.into_iter().fold(0.0, f64::max);
        if !level.is_below(eye) || longest > mirror.longest_way {
            return;
        }
        self.floor = Some(plane);
        let axis = Vector::from(level.mirrored(middle).as_vec3());
        self.reflected.keep(stage, &mirror.bodies, (axis, cos), longest as f32);
        self.reflected.planes.retain(|&other| other != plane);
        let mut at = corners;
        for (at, way) in at.iter_mut().zip(ways) {
            *at = eye + way * *at;
        }
        let extent = eye.abs().max_element() + longest;
        self.to_lights.resize_with(from_lights.len(), VisibleBodies::default);
        for (near, all) in self.to_lights.iter_mut().zip(from_lights) {
            let Some(all) = all else { continue };
            let light = all.point;
            let directions = at.map(|at| (light - at).normalize_or_zero());
            let axis = directions.iter().sum::<DVec3>().normalize_or_zero();
            let cosines = directions.map(|direction| axis.dot(direction));
            // How far rounding may turn what goes from the light to the plane.
            let turn = 4.0 * ROUNDING * (1.0 + (extent + light.abs().max_element()) / level.height_of(light));
            let cos = cosines.into_iter().fold(1.0, f64::min) - turn;
            if level.is_below(light) && cos > 0.0 {
                near.keep_bodies(all, (axis.as_vec3().into(), cos as f32), 0.0);
            } else {
                near.clone_from(all);
            }
            near.planes.clear();
            near.planes.extend(all.planes.iter().filter(|&&other| other != plane));
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Anchor, Body, Camera, Light, Placement, Projection, Scene, Shape};
    use glam::{DVec2, UVec2};
    use proptest::prelude::*;

    use super::super::RenderBody;
    use super::super::sight::tests::{body, moved, point};
    use super::super::space::RenderSpace;
    use super::*;
    use crate::tile::{TileRect, TILE};

    fn floor(rotation_degrees: DVec3) -> Body {
        let anchor = Anchor::Frame { position: DVec3::new(1.0, -2.0, 3.0), rotation_degrees };
        Body {
            shape: Shape::Plane,
            placement: Placement { anchor, ..Placement::default() },
            ..Body::default()
        }
    }

    /// The floor of the tile around a pixel.
    fn aimed(stage: &RenderScene, pixel: UVec2, size: UVec2) -> FloorCandidates {
        let camera = stage.camera();
        let rays = TileRect::around(pixel, size, TILE).rays_near(camera, size.as_dvec2());
        let reach = [0.5 * TILE as f32 + 8.0; 2];
        let lights: Vec<_> = stage.lights.iter().map(|light| stage.seen_from_light(light.position)).collect();
        let mut floors = FloorCandidates::new(stage);
        let from_eye = stage.seen_from(camera.eye().unwrap().into()).unwrap();
        floors.aim(stage, (&rays, reach), &from_eye, &lights);
        floors
    }

    /// Whether rays of this direction, of length 1, may meet the only body this far away from where they start.
    fn may_meet(sights: &VisibleBodies, direction: DVec3, distance: f64) -> bool {
        let direction = Vector::from(direction.as_vec3());
        sights.bodies.iter().any(|sight| sight.is_met(direction, distance as f32 * (1.0 + 1e-6)))
    }

    proptest! {
        /// Nothing is passed over that a floor reflects for the eye, or that stands between it and a light.
        #[test]
        fn nothing_that_matters_to_a_floor_is_missed(
            other in body(),
            tilt in point(60.0),
            eye in point(10.0),
            light in point(10.0),
            (x, y) in (0..256_u32, 0..192_u32),
            along in 0.0..1.0_f64,
            is_between in proptest::bool::ANY,
        ) {
            let (size, pixel) = (UVec2::new(256, 192), UVec2::new(x, y));
            let level = PlaneFrame::of(&RenderBody::prepare(&floor(tilt), &RenderSpace::default()).body);
            let lifted = |point: DVec3| point + (0.1 + (-level.height_of(point)).max(0.0) * 2.0) * level.up;
            let (eye, light) = (lifted(eye), lifted(light));
            let camera = Camera {
                position: eye,
                target: eye - level.up + 0.5 * level.up.any_orthonormal_vector(),
                projection: Projection::Perspective { fov_degrees: 40.0 },
                ..Camera::default()
            };
            let scene = |bodies: Vec<Body>| Scene {
                bodies: bodies.into(),
                camera,
                lights: vec![Light { position: light, ..Light::default() }],
                ..Scene::default()
            };
            let empty = RenderScene::prepare(&scene(vec![floor(tilt)])).unwrap();
            let ray = empty.camera().ray(pixel.as_dvec2() + DVec2::splat(0.5), size.as_dvec2());
            let direction = ray.direction.as_dvec3();
            let way = level.way(eye, direction);
            prop_assume!(way.is_finite());
            let met = eye + way * direction;
            let beyond = if is_between { light } else { met + 20.0 * level.mirrored(direction) };
            let there = met.lerp(beyond, along);
            let other = moved(other, there);
            let stage = RenderScene::prepare(&scene(vec![floor(tilt), other])).unwrap();
            prop_assume!(!stage.has_doubles() && stage.space.origin == DVec3::ZERO);
            let floors = aimed(&stage, pixel, size);
            prop_assume!(floors.floor().is_some());
            if is_between {
                let (direction, distance) = (light - met).normalize_and_length();
                prop_assert!(may_meet(&floors.to_lights[0], direction, distance));
            } else {
                prop_assert!(may_meet(floors.reflected(), level.mirrored(direction), met.distance(there)));
            }
        }
    }
}
