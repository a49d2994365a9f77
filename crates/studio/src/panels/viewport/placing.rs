//! The placing of new things: on what the middle of the picture shows, clear of other things, at a size that suits it.

mod body;
mod light;

use catoptric_live::Live;
use catoptric_scene::{Camera, Scene};
use egui::{Rect, vec2};
use glam::{DVec2, DVec3};

use super::Viewport;
use super::scene_view::SceneView;
use crate::state::view::ViewState;

pub(crate) use body::placement_for_body;
pub(crate) use light::place_for_light;

/// Points that lie farther off than so many distances to the subject are no places for new things.
const FARTHEST: f64 = 4.0;

/// The view into which a new thing is placed.
struct PlacementView<'a> {
    scene: &'a Scene,
    scene_view: SceneView,
    /// The point that the middle of the picture shows, or the camera's target.
    subject: DVec3,
    /// The bodies around the eye, as places in [`Scene::bodies`].
    rooms: Vec<usize>,
}

impl<'a> PlacementView<'a> {
    fn new(scene: &'a Scene, view: &ViewState, viewport: &Viewport, live: &Live) -> Self {
        let camera = view.camera(scene);
        let rects = viewport.rect().zip(viewport.visible_rect());
        let rects = rects.filter(|(_, visible)| visible.width() >= 1.0 && visible.height() >= 1.0);
        // Before the first frame, any window will do.
        let any = Rect::from_min_size(egui::Pos2::ZERO, vec2(800.0, 600.0));
        let (rect, visible) = rects.unwrap_or((any, any));
        let scene_view = SceneView::new(viewport.render_scene(live), rect, (visible, viewport.bar), camera);
        let middle = scene_view.at(scene_view.clear.center());
        let reach = camera.position.distance(camera.target);
        let subject = scene_view.body_at(middle).map(|hit| hit.position);
        let subject = subject.filter(|point| point.distance(camera.position) < FARTHEST * reach);
        let rooms = scene_view.rooms_at(middle);
        Self { scene, subject: subject.unwrap_or(camera.target), scene_view, rooms }
    }

    fn camera(&self) -> &Camera {
        &self.scene_view.camera
    }

    /// How far off the subject is, meters.
    fn reach(&self) -> f64 {
        self.camera().position.distance(self.subject)
    }

    /// The corners of what nothing covers of the picture: the upper left and the lower right one.
    fn corners(&self) -> [DVec2; 2] {
        [self.scene_view.at(self.scene_view.clear.min), self.scene_view.at(self.scene_view.clear.max)]
    }

    /// A place of the picture by its shares of the width and height that nothing covers.
    fn place(&self, shares: DVec2) -> DVec2 {
        let [least, most] = self.corners();
        least + shares * (most - least)
    }

    /// The point at a place of the picture whose depth is that of the subject times `factor`.
    fn point_at(&self, at: DVec2, factor: f64) -> DVec3 {
        let projector = &self.scene_view.projector;
        let [_, _, forward] = projector.axes();
        let ray = projector.ray(at);
        ray.at(factor * projector.depth(self.subject) / ray.direction.dot(forward))
    }

    /// Whether nothing stands between the eye and a point.
    fn is_seen(&self, point: DVec3) -> bool {
        let Some(at) = self.scene_view.projector.project(point) else { return false };
        let met = self.scene_view.body_at(at).map(|hit| self.scene_view.projector.depth(hit.position));
        met.is_none_or(|depth| depth > self.scene_view.projector.depth(point))
    }
}
