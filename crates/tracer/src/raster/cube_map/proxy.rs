//! Where cube maps are taken, and the box on which their surroundings are thought to be painted.

use glam::{DVec3, Vec3};

use crate::geometry::bounds::Bounds;
use crate::raster::projection::vector64;
use crate::simd::Float as _;
use crate::simd::double::Float64;
use crate::simd::vector::Vector;
use crate::transport::scene::RenderScene;

/// The point around which the map of a body is made, meters: the middle of the body; of a plane, the point below (or
/// above) the middle of all bounded bodies.
pub(crate) fn center_of(scene: &RenderScene, index: u32) -> DVec3 {
    let body = scene.geometry.body(scene.geometry.joined.whole_of(index, false).body);
    let to_world = |point: DVec3| {
        let rows = body.world_from_body.map(|row| DVec3::from(row.map(f64::from)));
        DVec3::from(body.origin.map(f64::from)) + DVec3::from(rows.map(|row| row.dot(point)))
    };
    if let Some(middle) = body.canonical().kind.solid().middle() {
        return to_world(middle);
    }
    let all = extent(scene, None);
    let (point, normal) = (to_world(DVec3::ZERO), plane_normal(scene, index));
    if all == Bounds::EMPTY {
        return point;
    }
    let middle = (0.5 * (all.min + all.max)).as_dvec3();
    middle - normal * (middle - point).dot(normal)
}

/// The box of all bounded bodies but one.
fn extent(scene: &RenderScene, but: Option<u32>) -> Bounds {
    let others = (0..scene.geometry.bounded).filter(|&index| Some(index) != but);
    others.filter_map(|index| scene.geometry.body(index).bounds()).fold(Bounds::EMPTY, Bounds::union)
}

fn plane_normal(scene: &RenderScene, index: u32) -> DVec3 {
    Vec3::from(scene.geometry.body(index).body_from_world[1]).as_dvec3().normalize_or(DVec3::Y)
}

/// The box on which the surroundings of a body are thought to be painted (Lagarde, Zanuttini 2012, Local Image-based
/// Lighting With Parallax-corrected Cubemaps).
///
/// On each of its six sides stands the nearest plane of the scene that runs along the box, a wall; where there is none, the
/// farthest that any other bounded body reaches; and where there is none of these either, nothing: that side is open, and
/// directions through it stay as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ParallaxBox {
    min: DVec3,
    max: DVec3,
}

impl ParallaxBox {
    /// The box around the body `index`, whose map is made around `center`.
    pub(crate) fn around(scene: &RenderScene, index: u32, center: DVec3) -> Self {
        let index = scene.geometry.joined.whole_of(index, false).body;
        /// A plane counts as a wall if it runs along the box but for the rounding of single precision.
        const ALONG: f64 = 1.0 - 1e-6;
        let (mut min, mut max) = (DVec3::NEG_INFINITY, DVec3::INFINITY);
        let is_wall = |&plane: &u32| plane != index && !scene.geometry.body(plane).is_joined();
        for plane in scene.geometry.planes().filter(is_wall) {
            let normal = plane_normal(scene, plane);
            let at = DVec3::from(scene.geometry.body(plane).origin.map(f64::from));
            for axis in (0..3).filter(|&axis| normal[axis].abs() >= ALONG) {
                if at[axis] < center[axis] {
                    min[axis] = min[axis].max(at[axis]);
                } else {
                    max[axis] = max[axis].min(at[axis]);
                }
            }
        }
        let others = extent(scene, Some(index));
        for axis in 0..3 {
            let (low, high) = (f64::from(others.min[axis]), f64::from(others.max[axis]));
            if min[axis] == f64::NEG_INFINITY && low < center[axis] {
                min[axis] = low;
            }
            if max[axis] == f64::INFINITY && high > center[axis] && high > low {
                max[axis] = high;
            }
        }
        Self { min, max }
    }

    /// The direction from `center` to where a ray leaves the box; the ray's own if it starts outside of the box or leaves
    /// through an open side.
    pub(crate) fn corrected(&self, center: DVec3, origin: DVec3, direction: DVec3) -> DVec3 {
        let Vector { x, y, z } = self.corrected_all(center, vector64([origin]), vector64([direction]));
        DVec3::new(x.0[0], y.0[0], z.0[0])
    }

    /// As [`Self::corrected`], for rays side by side.
    #[inline(always)]
    pub(crate) fn corrected_all<const N: usize>(
        &self,
        center: DVec3,
        origin: Vector<Float64<N>>,
        direction: Vector<Float64<N>>,
    ) -> Vector<Float64<N>> {
        let (zero, infinite) = (Float64([0.0; N]), Float64([f64::INFINITY; N]));
        let mut way = infinite;
        let axes = [(origin.x, direction.x), (origin.y, direction.y), (origin.z, direction.z)];
        for (axis, (from, along)) in axes.into_iter().enumerate() {
            let [low, high] = [Float64([self.min[axis]; N]), Float64([self.max[axis]; N])];
            let wall = Float64::select(along.gt(zero), high, low);
            let t = (wall - from) / along;
            way = Float64::select(along.eq(zero), way, t.min(way));
        }
        let leaves = way.ge(zero) & way.lt(infinite);
        Vector::select(leaves, origin + direction * way - vector64([center; N]), direction)
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, Placement, Scene, Shape};

    use super::*;

    fn scene(bodies: Vec<(Shape, DVec3)>) -> RenderScene {
        let body = |(shape, position)| Body { shape, placement: Placement::at(position), ..Body::default() };
        let bodies: Vec<Body> = bodies.into_iter().map(body).collect();
        RenderScene::build(&Scene { bodies: bodies.into(), ..Scene::default() }).unwrap()
    }

    fn index(scene: &RenderScene, place: usize) -> u32 {
        (0..).find(|&index| scene.scene_index(index) == Some(place)).unwrap()
    }

    #[test]
    fn walls_come_before_bodies_and_open_sides_stay_open() {
        let scene = scene(vec![
            (Shape::SPHERE, DVec3::new(0.0, 2.0, 0.0)),
            (Shape::Plane, DVec3::ZERO),
            (Shape::Cube { size: DVec3::ONE }, DVec3::new(5.0, 2.0, 0.0)),
        ]);
        let ball = index(&scene, 0);
        let center = center_of(&scene, ball);
        assert_eq!(center, DVec3::new(0.0, 2.0, 0.0));
        let proxy = ParallaxBox::around(&scene, ball, center);
        assert_eq!(proxy.min.y, 0.0);
        assert!((proxy.max - DVec3::new(5.5, 2.5, 0.5)).abs().max_element() < 1e-4, "{proxy:?}");
        assert_eq!(proxy.min.x, f64::NEG_INFINITY);
        assert!((proxy.min.z + 0.5).abs() < 1e-4);
        let side = DVec3::new(-1.0, 0.0, 0.0);
        assert_eq!(proxy.corrected(center, center + DVec3::Y * 0.3, side), side);
        let down = proxy.corrected(center, center + DVec3::X, DVec3::NEG_Y);
        assert_eq!(down, DVec3::new(1.0, -2.0, 0.0));
    }

    #[test]
    fn the_map_of_a_plane_is_taken_below_the_bodies() {
        let scene = scene(vec![
            (Shape::Plane, DVec3::new(7.0, 1.0, 7.0)),
            (Shape::SPHERE, DVec3::new(2.0, 5.0, 3.0)),
        ]);
        let center = center_of(&scene, index(&scene, 0));
        assert!((center - DVec3::new(2.0, 1.0, 3.0)).length() < 1e-5, "{center}");
    }

    #[test]
    fn a_ray_from_outside_keeps_its_direction() {
        let proxy = ParallaxBox { min: DVec3::splat(-1.0), max: DVec3::ONE };
        let direction = DVec3::new(0.0, 1.0, 0.0);
        assert_eq!(proxy.corrected(DVec3::ZERO, DVec3::new(0.0, 3.0, 0.0), direction), direction);
    }
}
