//! The space that rays are traced in, and which numbers are too large or too small for single precision there.
//!
//! Single precision has 24 bits: at a million meters the next number is 6 cm away. What counts is how far that is in the
//! picture. So the space has its origin near what is seen when that is far from the world's, and bodies that are huge
//! beside what is seen, or extremely flat, are intersected in double precision.

use catoptric_scene::{Body, Camera, Projection, Scene};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;

use crate::geometry::canonical::CanonicalBody;

/// Coordinates and sizes may be so many times as large as the height of the picture where they are seen: then their rounding
/// is less than a hundredth of a pixel in pictures of 1000 pixels.
const MOST_HEIGHTS: f64 = 512.0;

/// What is nearer than this share of the way to the camera's target is not expected to be seen in detail.
const NEAREST: f64 = 1.0 / 64.0;

/// A view narrower than this share of its distance (a twentieth of a degree and less at the limit) wants its target near the
/// origin, not the eye.
const NARROW: f64 = 1e-3;

/// Views wider than a right angle are no coarser in their middle for that.
const WIDEST: f64 = 2.0;

/// A curved body may be so many times as long as it is thick.
const MOST_FLAT: f64 = 1024.0;

/// Up to so many bodies are looked at one by one when the camera moves.
const FEW_TO_CHECK: usize = 4096;

/// The space of the rays: the world's axes, and an origin near what is seen (Pharr, Jakob, Humphreys 2023, Physically Based
/// Rendering, 4th ed., sec. 5.1.1: rendering space).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RenderSpace {
    /// In the world, meters.
    pub(crate) origin: DVec3,
    view: PictureScale,
}

/// How large things are in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PictureScale {
    /// Where distances are measured from, in the world.
    focus: DVec3,
    /// The height of the picture for each meter of distance, and the least one, meters.
    per_meter: f64,
    least: f64,
}

/// The world's own, seen by the default camera.
impl Default for RenderSpace {
    fn default() -> Self {
        Self { origin: DVec3::ZERO, view: PictureScale::of(&Camera::default()) }
    }
}

impl RenderSpace {
    /// The space for a scene seen by a camera.
    pub(crate) fn of(scene: &Scene, camera: &Camera) -> Self {
        let view = PictureScale::of(camera);
        let is_near = view.allows(scene, view.focus.abs().max_element());
        Self { origin: if is_near { DVec3::ZERO } else { view.focus }, view }
    }

    pub(crate) fn render_from_world(&self, point: DVec3) -> DVec3 {
        point - self.origin
    }

    /// How far all bodies are from where numbers are exact, meters, if so far that pictures show it: a parallel or very narrow
    /// view was aimed at a point far from all that is seen.
    pub(crate) fn target_beside(&self, scene: &Scene) -> Option<f64> {
        if self.view.per_meter > 0.0 {
            return None;
        }
        let nearest = self.view.nearest(scene);
        (nearest.is_finite() && nearest > MOST_HEIGHTS * self.view.least).then_some(nearest)
    }

    /// Whether pictures through another camera are as exact in this space, and the same where the world's origin is near.
    /// `largest` is the largest extent of the bodies if all are in single precision, else infinite; `is_double` tells of
    /// those that are not by their place in the scene.
    pub(crate) fn suits(
        &self,
        scene: &Scene,
        camera: &Camera,
        largest: f64,
        is_double: impl Fn(usize) -> bool,
    ) -> bool {
        let view = PictureScale::of(camera);
        let is_near = |origin: DVec3| view.allows(scene, (view.focus - origin).abs().max_element());
        if !is_near(self.origin) || (self.origin != DVec3::ZERO && is_near(DVec3::ZERO)) {
            return false;
        }
        if largest <= MOST_HEIGHTS * view.least || scene.bodies.len() > FEW_TO_CHECK {
            return true;
        }
        let space = Self { view, ..*self };
        let bodies = scene.bodies.iter().enumerate();
        let mut fits = bodies.map(|(index, body)| {
            if body.shape.is_compound() {
                let mut are_single = true;
                body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
                    are_single &= !space.needs_double(&CanonicalBody::placed(part.shape, part.frame));
                });
                return body.hidden || are_single;
            }
            let canonical = CanonicalBody::of(body);
            body.hidden || canonical.is_plane() || is_double(index) == space.needs_double(&canonical)
        });
        fits.all(|fits| fits)
    }

    /// Whether a body is to be intersected in double precision.
    pub(crate) fn needs_double(&self, body: &CanonicalBody) -> bool {
        body.shape.kind.solid().flatness(body.axes()) > MOST_FLAT || (!body.is_plane() && self.is_huge(body))
    }

    fn is_huge(&self, body: &CanonicalBody) -> bool {
        let extent = body.axes().max_element();
        extent > MOST_HEIGHTS * self.view.least
            && extent > MOST_HEIGHTS * self.view.height_at(body.distance(self.view.focus))
    }

    /// A plane's frame moved within the plane to where it is seen, if it is too far away: by whole units, so that pictures
    /// on the plane stay; and how far, in units. `None` where even a unit is too large, and double precision has to do.
    pub(crate) fn frame_near(&self, plane: &CanonicalBody) -> Option<(DAffine3, DVec3)> {
        let transform = &plane.world_from_canonical;
        let height = self.view.height_at(plane.distance(self.view.focus));
        let reach = (transform.translation - self.origin).abs().max_element();
        if reach <= MOST_HEIGHTS * height {
            return Some((*transform, DVec3::ZERO));
        }
        if plane.axes().max_element() > MOST_HEIGHTS * height {
            return None;
        }
        let at = transform.inverse().transform_point3(self.view.focus);
        let shift = DVec3::new(at.x.round(), 0.0, at.z.round());
        Some((DAffine3 { translation: transform.transform_point3(shift), ..*transform }, shift))
    }
}

impl PictureScale {
    fn of(camera: &Camera) -> Self {
        let way = camera.position.distance(camera.target);
        match camera.projection {
            Projection::Perspective { fov_degrees } => {
                let per_meter = (2.0 * (0.5 * fov_degrees.to_radians()).tan()).min(WIDEST);
                if per_meter < NARROW {
                    return Self { focus: camera.target, per_meter: 0.0, least: per_meter * way };
                }
                Self { focus: camera.position, per_meter, least: per_meter * way * NEAREST }
            }
            Projection::Parallel { height } => Self { focus: camera.target, per_meter: 0.0, least: height },
        }
    }

    /// The height of the picture at a distance from the focus, meters.
    fn height_at(&self, distance: f64) -> f64 {
        self.least.max(self.per_meter * distance)
    }

    /// Whether coordinates as large as this are no trouble in the picture of a scene.
    fn allows(&self, scene: &Scene, coordinate: f64) -> bool {
        if coordinate <= MOST_HEIGHTS * self.least || self.per_meter == 0.0 {
            return coordinate <= MOST_HEIGHTS * self.least;
        }
        coordinate <= MOST_HEIGHTS * self.height_at(self.nearest(scene))
    }

    /// About how far the nearest body is from the focus, meters.
    fn nearest(&self, scene: &Scene) -> f64 {
        let nearest_of = |bodies: &[Body]| {
            let seen = bodies.iter().filter(|body| !body.hidden);
            seen.map(|body| self.distance_to(body)).fold(f64::INFINITY, f64::min)
        };
        let slices: Vec<&[Body]> = scene.bodies.slices().collect();
        slices.into_par_iter().map(nearest_of).reduce(|| f64::INFINITY, f64::min)
    }

    /// How far a body's surface is from the focus at least, meters: a rough bound for bodies that are far away.
    fn distance_to(&self, body: &Body) -> f64 {
        if body.shape.is_compound() {
            // The surface of the whole is made by those of its parts.
            let mut nearest = f64::INFINITY;
            body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
                nearest = nearest.min(CanonicalBody::placed(part.shape, part.frame).distance(self.focus));
            });
            return nearest;
        }
        let scale = body.placement.scale.abs().max_element();
        let ball = body.sized_shape().ball(DVec3::ONE);
        let reach = ball.map_or(f64::INFINITY, |(center, radius)| center.length() + radius);
        let way = body.placement.origin().distance(self.focus) - scale * reach;
        if way > scale * reach {
            return way;
        }
        CanonicalBody::of(body).distance(self.focus)
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Placement, Shape};

    use super::*;

    fn ball(radius: f64, at: DVec3) -> Body {
        Body { shape: Shape::Sphere { radius }, placement: Placement::at(at), ..Body::default() }
    }

    fn scene(bodies: Vec<Body>, position: DVec3, target: DVec3) -> Scene {
        let camera = Camera { position, target, ..Camera::default() };
        Scene { camera, bodies: bodies.into(), ..Scene::default() }
    }

    fn is_double(scene: &Scene, index: usize) -> bool {
        let body = scene.bodies.get(index).unwrap();
        RenderSpace::of(scene, &scene.camera).needs_double(&CanonicalBody::of(body))
    }

    #[test]
    fn the_origin_stays_where_numbers_are_small() {
        let near = scene(vec![ball(1.0, DVec3::Y)], DVec3::new(0.0, 2.2, 8.0), DVec3::Y);
        assert_eq!(RenderSpace::of(&near, &near.camera).origin, DVec3::ZERO);
        for far in [1e5, -1e6, 1e9] {
            let offset = DVec3::new(far, 0.0, 0.0);
            let eye = DVec3::new(0.0, 2.2, 8.0) + offset;
            let far = scene(vec![ball(1.0, DVec3::Y + offset)], eye, DVec3::Y + offset);
            assert_eq!(RenderSpace::of(&far, &far.camera).origin, eye);
        }
    }

    #[test]
    fn a_target_beside_everything_is_told() {
        let eye = DVec3::new(0.0, 0.0, 8.0);
        let mut scene = scene(vec![ball(1.0, DVec3::ZERO)], eye, DVec3::ZERO);
        let beside = |scene: &Scene| RenderSpace::of(scene, &scene.camera).target_beside(scene);
        scene.camera.target.z = -1e7;
        assert_eq!(beside(&scene), None, "numbers are exact at the eye of a wide view");
        scene.camera.projection = Projection::Parallel { height: 3.0 };
        assert_eq!(beside(&scene), Some(1e7 - 1.0));
        scene.camera.target.z = -100.0;
        assert_eq!(beside(&scene), None);
    }

    #[test]
    fn bodies_are_huge_by_what_is_seen_of_them() {
        let eye = DVec3::new(0.0, 0.3, 0.0);
        let earth = |radius: f64| ball(radius, DVec3::new(0.0, -radius - 0.5, -1.0));
        assert!(is_double(&scene(vec![earth(6.4e6)], eye, DVec3::NEG_Z), 0));
        assert!(!is_double(&scene(vec![earth(60.0)], eye, DVec3::NEG_Z), 0));
        // From as far away as it is large, it is nothing special.
        let afar = DVec3::new(0.0, 6.4e6, 0.0);
        assert!(!is_double(&scene(vec![earth(6.4e6)], afar, DVec3::ZERO), 0));
    }

    #[test]
    fn needles_and_coins_are_flat_but_panes_are_not() {
        let scaled = |shape: Shape, scale: DVec3| {
            let placement = Placement { scale, ..Placement::default() };
            let body = Body { shape, placement, ..Body::default() };
            is_double(&scene(vec![body], DVec3::new(0.0, 1.0, 5.0), DVec3::ZERO), 0)
        };
        let coin = DVec3::new(1.0, 1e-8, 1.0);
        assert!(scaled(Shape::SPHERE, coin) && scaled(Shape::CONE, coin) && scaled(Shape::PARABOLOID, coin));
        assert!(!scaled(Shape::CYLINDER, coin) && !scaled(Shape::CUBE, coin));
        assert!(scaled(Shape::CYLINDER, DVec3::new(1e-8, 1.0, 1.0)));
        assert!(!scaled(Shape::SPHERE, DVec3::new(1.0, 0.01, 1.0)));
    }
}
