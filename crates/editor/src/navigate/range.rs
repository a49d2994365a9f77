//! The distances that navigation allows, from the extent of a scene.

use catoptric_scene::format::spec::Limits;
use catoptric_scene::{Body, Camera, Light, List, Projection, Scene};
use glam::DVec3;

use super::dolly;
use crate::bounds::{self, Bounds};

/// The nearest distance over the radius of the smallest body: at a thousandth of it, its surface is a plane.
const NEAREST: f64 = 1e-3;
/// The farthest distance over the radius of the scene: at a thousand of them, it is a few pixels.
const FARTHEST: f64 = 1e3;
/// The radius of a scene in which nothing has an extent, meters.
const DEFAULT_RADIUS: f64 = 10.0;
/// The radius of the smallest body over that of the scene, where no body has an extent.
const DEFAULT_DETAIL: f64 = 0.1;

/// The distances that navigation allows between a camera and its target, and from the middle of the scene.
///
/// A camera that stands outside, as a scene file may have it, can come back and is never moved by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraRange {
    center: DVec3,
    detail: f64,
    nearest: f64,
    farthest: f64,
}

impl CameraRange {
    /// The range of the bodies and lights that are not hidden. Planes have no extent: where there are none but planes,
    /// their places count as points.
    pub fn of_scene(scene: &Scene) -> Self {
        Self::of_parts(&scene.bodies, &scene.lights)
    }

    fn of_parts(bodies: &List<Body>, lights: &[Light]) -> Self {
        let shown = || bodies.iter().filter(|body| !body.hidden);
        let lights = lights.iter().filter(|light| !light.hidden).map(|light| Bounds::at(light.position));
        let solid = shown().filter_map(bounds::of_body).reduce(Bounds::union);
        let planes = shown().filter(|_| solid.is_none());
        let points = planes.map(|body| Bounds::at(body.placement.world_from_body().translation));
        let whole = solid.into_iter().chain(points).chain(lights).reduce(Bounds::union);
        let radius = whole.map_or(0.0, |bounds| 0.5 * bounds.size().length());
        let radius = if radius > 0.0 { radius } else { DEFAULT_RADIUS };
        let radii = shown().filter_map(bounds::ball_of_body).map(|ball| ball.radius);
        let detail = radii.reduce(f64::min).unwrap_or(DEFAULT_DETAIL * radius);
        Self {
            center: whole.map_or(DVec3::ZERO, |bounds| bounds.center()),
            detail,
            nearest: (NEAREST * detail).max(Limits::LENGTH.min),
            // What is farther has no place in a scene file.
            farthest: (FARTHEST * radius).min(Limits::PLACE.max),
        }
    }

    /// The least distance from the target, or the least height of a parallel window, meters.
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// The greatest distance from the target and from the middle of the scene, and the greatest height of a parallel
    /// window, meters.
    pub fn farthest(&self) -> f64 {
        self.farthest
    }

    /// The distance that the speed of a flight goes by, meters: that of the target, within what the scene's details
    /// and its extent suggest.
    pub fn flight_distance(&self, camera: &Camera) -> f64 {
        let least = 0.2 * self.detail;
        camera.position.distance(camera.target).clamp(least, self.farthest.max(least))
    }

    /// The part of a dolly or zoom by `factor` that the range allows.
    pub fn allowed_factor(&self, camera: &Camera, factor: f64) -> f64 {
        let size = size(camera);
        if factor.is_nan() || factor <= 0.0 || size.is_nan() || size <= 0.0 {
            return 1.0;
        }
        factor.clamp((self.nearest / size).min(1.0), (self.farthest / size).max(1.0))
    }

    /// The camera `after` a move from `before`, held within the range: a move ends where the range does.
    pub fn limit(&self, before: &Camera, after: Camera) -> Camera {
        let (old, new) = (size(before), size(&after));
        let is_alike =
            std::mem::discriminant(&before.projection) == std::mem::discriminant(&after.projection);
        let mut limited = after;
        if is_alike && new > 0.0 {
            let allowed = new.clamp(self.nearest.min(old), self.farthest.max(old));
            if allowed != new {
                limited = dolly(&after, allowed / new);
            }
        }
        self.near_the_scene(before, limited)
    }

    /// Ends the way of a camera at the farthest distance from the middle of the scene.
    ///
    /// With the start p and the way d from the middle, |p + s·d|² = r² gives s·d·d = √((p·d)² + d·d·(r² − p·p)) − p·d,
    /// whose smaller root lies behind the start.
    fn near_the_scene(&self, before: &Camera, after: Camera) -> Camera {
        let (start, end) = (before.position - self.center, after.position - self.center);
        let radius = self.farthest.max(start.length());
        if end.length() <= radius {
            return after;
        }
        let way = end - start;
        let (along, length) = (start.dot(way), way.length_squared());
        let room = along.mul_add(along, length * (radius * radius - start.length_squared()));
        let share = ((room.max(0.0).sqrt() - along) / length).clamp(0.0, 1.0);
        let back = (share - 1.0) * way;
        let to = Camera { position: after.position + back, target: after.target + back, ..after };
        if to.is_valid() { to } else { *before }
    }
}

/// What a dolly changes, meters: the distance of the target, or the height of a parallel window.
fn size(camera: &Camera) -> f64 {
    match camera.projection {
        Projection::Perspective { .. } => camera.position.distance(camera.target),
        Projection::Parallel { height } => height,
    }
}

/// The range of a scene, computed anew only when its bodies or lights have changed.
#[derive(Clone, Debug, Default)]
pub struct CachedCameraRange(Option<(List<Body>, Vec<Light>, CameraRange)>);

impl CachedCameraRange {
    /// The range of `scene`. Bodies that it shares with the last one are compared at once.
    pub fn of_scene(&mut self, scene: &Scene) -> CameraRange {
        match &self.0 {
            Some((bodies, lights, range)) if *lights == scene.lights && *bodies == scene.bodies => *range,
            _ => {
                let range = CameraRange::of_scene(scene);
                self.0 = Some((scene.bodies.clone(), scene.lights.clone(), range));
                range
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Placement, Shape};
    use proptest::prelude::*;

    use super::*;
    use crate::navigate::{fly, orbit, pan, zoom_towards};

    fn ball(radius: f64, position: DVec3) -> Body {
        Body { shape: Shape::Sphere { radius }, placement: Placement::at(position), ..Body::default() }
    }

    fn scene(bodies: Vec<Body>) -> Scene {
        Scene { bodies: bodies.into(), ..Scene::default() }
    }

    fn looking(distance: f64) -> Camera {
        Camera { position: DVec3::Z * distance, target: DVec3::ZERO, ..Camera::default() }
    }

    #[test]
    fn it_goes_by_the_smallest_body_and_the_whole_extent() {
        for unit in [1e-3, 1.0, 1e6] {
            let bodies = vec![ball(unit, DVec3::ZERO), ball(0.1 * unit, DVec3::X * 9.9 * unit)];
            let range = CameraRange::of_scene(&scene(bodies));
            assert!((range.nearest() / (1e-4 * unit) - 1.0).abs() < 1e-12, "{range:?}");
            // A box of 11 by 2 by 2.
            let radius = 0.5 * f64::from(129_u8).sqrt();
            let farthest = (1e3 * radius * unit).min(1e9);
            assert!((range.farthest() / farthest - 1.0).abs() < 1e-12, "{range:?}");
        }
        let mut hidden = scene(vec![ball(1.0, DVec3::ZERO), ball(1e-4, DVec3::ZERO)]);
        hidden.bodies[1].hidden = true;
        assert!((CameraRange::of_scene(&hidden).nearest() - 1e-3).abs() < 1e-12);
    }

    #[test]
    fn scenes_without_an_extent_have_a_range() {
        let empty = CameraRange::of_scene(&Scene { lights: Vec::new(), ..Scene::default() });
        assert!((empty.nearest() - 1e-3).abs() < 1e-12 && (empty.farthest() - 1e4).abs() < 1e-6, "{empty:?}");
        let mut floor = scene(vec![Body { shape: Shape::Plane, ..Body::default() }]);
        assert_eq!(CameraRange::of_scene(&floor), empty);
        floor.lights = vec![Light { position: DVec3::Y * 2.0, ..Light::default() }];
        let lit = CameraRange::of_scene(&floor);
        assert!((lit.farthest() - 1e3).abs() < 1e-9 && lit.nearest() > 0.0, "{lit:?}");
    }

    #[test]
    fn moves_end_where_the_range_does() {
        let range = CameraRange::of_scene(&scene(vec![ball(1.0, DVec3::ZERO)]));
        let camera = looking(5.0);
        let nearest = range.limit(&camera, dolly(&camera, 1e-9));
        assert!((size(&nearest) - 1e-3).abs() < 1e-12, "{nearest:?}");
        assert_eq!(range.allowed_factor(&camera, 0.5), 0.5);
        let factor = range.allowed_factor(&camera, 1e-9);
        let zoomed = zoom_towards(&camera, DVec3::new(1.0, 0.0, 2.0), factor);
        assert!((size(&zoomed) - range.nearest()).abs() < 1e-12);
        let away = range.limit(&camera, fly(&camera, DVec3::new(0.0, 0.0, -1e7), 0.0, 0.0));
        assert!((away.position.length() / range.farthest() - 1.0).abs() < 1e-9, "{away:?}");
        assert!((away.position.distance(away.target) - 5.0).abs() < 1e-6);
        let parallel = Camera { projection: Projection::Parallel { height: 2.0 }, ..camera };
        let flat = range.limit(&parallel, dolly(&parallel, 1e-9));
        let Projection::Parallel { height } = flat.projection else { panic!("{flat:?}") };
        assert!((height - range.nearest()).abs() < 1e-12);
    }

    #[test]
    fn a_camera_outside_may_come_back_and_never_jumps() {
        let range = CameraRange::of_scene(&scene(vec![ball(1.0, DVec3::ZERO)]));
        let (near, far) = (looking(1e-6), looking(1e8));
        for camera in [near, far] {
            assert_eq!(range.limit(&camera, camera), camera);
            let turned = orbit(&camera, 0.1, 0.0);
            assert!(range.limit(&camera, turned).position.distance(turned.position) < 1e-6 * size(&camera));
        }
        let nearer = range.limit(&near, dolly(&near, 0.5));
        assert!((size(&nearer) - 1e-6).abs() < 1e-15, "no nearer than it was");
        assert!((size(&range.limit(&near, dolly(&near, 2.0))) - 2e-6).abs() < 1e-15);
        assert!((size(&range.limit(&far, dolly(&far, 0.5))) - 5e7).abs() < 1e-3);
        assert!(size(&range.limit(&far, dolly(&far, 2.0))) <= 1.000_001e8);
        assert_eq!(range.allowed_factor(&near, 0.5), 1.0);
        assert_eq!(range.allowed_factor(&far, 2.0), 1.0);
        assert_eq!(range.allowed_factor(&far, f64::NAN), 1.0);
    }

    #[test]
    fn a_cached_range_follows_the_scene() {
        let mut cached = CachedCameraRange::default();
        let mut own = scene(vec![ball(1.0, DVec3::ZERO)]);
        assert_eq!(cached.of_scene(&own), CameraRange::of_scene(&own));
        own.bodies[0] = ball(2.0, DVec3::X);
        assert_eq!(cached.of_scene(&own), CameraRange::of_scene(&own));
        own.lights.push(Light { position: DVec3::Y * 700.0, ..Light::default() });
        assert_eq!(cached.of_scene(&own), CameraRange::of_scene(&own));
    }

    proptest! {
        #[test]
        fn no_series_of_moves_leaves_the_range(
            unit in prop_oneof![Just(1e-3), Just(1.0), Just(1e5)],
            start in 1e-4..1e3f64,
            moves in proptest::collection::vec((0usize..4, -1.0..1.0f64), 1..60),
        ) {
            let range = CameraRange::of_scene(&scene(vec![ball(unit, DVec3::ONE * unit)]));
            let first = looking(start * unit);
            let mut camera = first;
            for (kind, amount) in moves {
                let after = match kind {
                    0 => dolly(&camera, (20.0 * amount).exp()),
                    1 => {
                        let factor = range.allowed_factor(&camera, (20.0 * amount).exp());
                        zoom_towards(&camera, DVec3::ONE * unit, factor)
                    }
                    2 => fly(&camera, DVec3::splat(1e6 * amount * unit), amount, 0.5 * amount),
                    _ => pan(&camera, 1e7 * amount * unit, 0.0),
                };
                camera = range.limit(&camera, after);
                let slack = 1.0 + 1e-6;
                prop_assert!(camera.is_valid());
                prop_assert!(size(&camera) * slack >= range.nearest().min(size(&first)), "{camera:?}");
                prop_assert!(size(&camera) <= slack * range.farthest().max(size(&first)), "{camera:?}");
                let away = |camera: &Camera| camera.position.distance(DVec3::ONE * unit);
                prop_assert!(away(&camera) <= slack * range.farthest().max(away(&first)), "{camera:?}");
            }
        }
    }
}
