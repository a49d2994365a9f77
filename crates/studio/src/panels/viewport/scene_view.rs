//! The displayed picture with its camera, for hit tests.

use std::sync::Arc;

use catoptric_editor::Item;
use catoptric_scene::{Camera, Scene, ScenePart};
use catoptric_tracer::{RayIntersection, RayOrigin, RenderCamera, RenderScene};
use egui::{Pos2, Rect, pos2};
use glam::{DVec2, DVec3};

use super::drag_payload::place_of;
use super::gizmo::{Gizmo, GizmoHandle};
use super::offscreen;
use crate::base::projector::Projector;
use crate::state::context::Cx;
use crate::state::view::ProjectedPoint;

/// How near to a light's or the camera's handle the pointer takes it, points.
const REACH: f64 = 12.0;

/// The displayed picture, for hit tests.
pub(crate) struct SceneView {
    /// Where the whole picture is, points of the window.
    pub(crate) rect: Rect,
    /// The part of it that no panel covers.
    pub(crate) visible: Rect,
    /// The part of that below the bar over the picture.
    pub(crate) clear: Rect,
    /// The camera of the picture.
    pub(crate) camera: Camera,
    pub(crate) projector: Projector,
    /// The scene prepared for rays, with the same camera.
    render_scene: Option<(Arc<RenderScene>, RenderCamera)>,
}

/// The thing under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PointerTarget {
    /// A part of the gizmo.
    Handle(GizmoHandle),
    /// The handle of a light or of the camera.
    Mark(Item),
    /// The arrow at the picture's edge towards one that is out of view.
    Arrow(Item),
    /// A body, at a point.
    Body { item: Item, point: DVec3 },
    /// A plane, or a body that surrounds the camera: it cannot be dragged.
    Surroundings,
    /// Nothing.
    Nothing,
}

impl SceneView {
    /// The picture of `camera` in `rect`, with the scene that is hit in it, as far as `tile` shows it; a bar reaches so far down from the tile's top, points.
    pub(crate) fn new(
        render_scene: Option<Arc<RenderScene>>,
        rect: Rect,
        (tile, bar): (Rect, f32),
        camera: Camera,
    ) -> Self {
        /// In small windows the bar may take a part of the picture that cannot be done without.
        const MOST: f32 = 0.4;
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        let render_scene = render_scene.map(|render_scene| {
            let seen = render_scene.camera_for(&camera);
            (render_scene, seen)
        });
        let visible = tile.intersect(rect);
        let top = (tile.top() + bar).clamp(visible.top(), visible.top() + MOST * visible.height().max(0.0));
        let clear = visible.with_min_y(top);
        Self { rect, visible, clear, camera, projector: Projector::new(&camera, size), render_scene }
    }

    /// A place of the window in the picture.
    pub(crate) fn at(&self, pos: Pos2) -> DVec2 {
        let offset = pos - self.rect.min;
        DVec2::new(f64::from(offset.x), f64::from(offset.y))
    }

    /// A place of the picture in the window.
    pub(crate) fn pos(&self, at: DVec2) -> Pos2 {
        pos2(self.rect.min.x + at.x as f32, self.rect.min.y + at.y as f32)
    }

    /// A point of the world in the window.
    pub(crate) fn point(&self, point: DVec3) -> Option<Pos2> {
        self.projector.project(point).map(|at| self.pos(at))
    }

    /// The nearest body under a place.
    pub(crate) fn body_at(&self, at: DVec2) -> Option<RayIntersection> {
        let (render_scene, camera) = self.render_scene.as_ref()?;
        render_scene.closest_hit(&camera.ray(at, self.projector.size()))
    }

    /// Under which angle the nearest body is seen at a place.
    pub(crate) fn seen_at(&self, at: DVec2) -> Option<ProjectedPoint> {
        let (render_scene, camera) = self.render_scene.as_ref()?;
        let ray = camera.ray(at, self.projector.size());
        let hit = render_scene.closest_hit(&ray)?;
        let (direction, normal) = (ray.direction.as_dvec3(), hit.normal.as_dvec3());
        let degrees = direction.cross(normal).length().atan2(-direction.dot(normal)).to_degrees();
        Some(ProjectedPoint {
            body: hit.body,
            degrees: degrees.clamp(0.0, 90.0),
            is_from_inside: hit.from_within,
        })
    }

    /// All bodies under a place, the nearest first.
    pub(crate) fn bodies_at(&self, at: DVec2) -> Vec<usize> {
        let Some((render_scene, camera)) = &self.render_scene else { return Vec::new() };
        let hits = render_scene.hits_along(&camera.ray(at, self.projector.size()));
        hits.into_iter().map(|hit| hit.body).collect()
    }

    /// The bodies around the eye, found along the ray at a place: each is left on its way.
    pub(crate) fn rooms_at(&self, at: DVec2) -> Vec<usize> {
        let Some((render_scene, camera)) = &self.render_scene else { return Vec::new() };
        let hits = render_scene.hits_along(&camera.ray(at, self.projector.size()));
        hits.into_iter().filter(|hit| hit.from_within).map(|hit| hit.body).collect()
    }

    /// What lies between a point and a surface point, and how far from the first: the nearest body.
    pub(crate) fn between(&self, from: DVec3, surface: DVec3) -> Option<RayIntersection> {
        /// Nearer to the surface than this part of the way, it is the surface itself.
        const ARRIVED: f64 = 1e-3;
        let (render_scene, _) = self.render_scene.as_ref()?;
        let direction = (surface - from).normalize_or_zero();
        let hit = render_scene.closest_hit(&render_scene.ray_from_point(from, direction.as_vec3()))?;
        let way = surface.distance(from);
        (hit.position.distance(from) < way * (1.0 - ARRIVED)).then_some(hit)
    }

    /// How far a ray gets from a surface before it meets another body, meters; `None` when it meets none.
    pub(crate) fn free_way(&self, from: &RayIntersection, direction: DVec3) -> Option<f64> {
        let (render_scene, _) = self.render_scene.as_ref()?;
        let mut ray = render_scene.ray_from_point(from.position, direction.as_vec3());
        // Bodies are convex: seen from outside, the surface itself is in nobody's way.
        ray.start = RayOrigin { body: from.hit.body, inwards: from.hit.leaving };
        render_scene.closest_hit(&ray).map(|hit| hit.position.distance(from.position))
    }

    /// Whether nothing stands between a point and a surface point.
    pub(crate) fn is_clear(&self, from: DVec3, surface: DVec3) -> bool {
        self.between(from, surface).is_none()
    }

    /// The lights, and the camera in the free view, under a place, the nearest in the picture first.
    pub(crate) fn marks_at(&self, cx: &Cx<'_>, at: DVec2) -> Vec<Item> {
        let mut near: Vec<(Item, f64)> = marks(cx)
            .into_iter()
            .filter_map(|item| {
                let place = self.projector.project(place_of(cx.editor.edited(), item)?)?;
                Some((item, place.distance(at)))
            })
            .filter(|(_, distance)| *distance <= REACH)
            .collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1));
        near.into_iter().map(|(item, _)| item).collect()
    }

    /// The target of a pointer at a place.
    pub(crate) fn target(&self, cx: &Cx<'_>, gizmo: Option<&Gizmo>, at: DVec2) -> PointerTarget {
        if let Some(handle) = gizmo.and_then(|gizmo| gizmo.handle_at(&self.projector, at)) {
            return PointerTarget::Handle(handle);
        }
        if let Some(item) = self.marks_at(cx, at).first() {
            return PointerTarget::Mark(*item);
        }
        if let Some(item) = offscreen::arrow_at(cx, self, self.pos(at)) {
            return PointerTarget::Arrow(item);
        }
        match self.body_at(at) {
            Some(hit) if hit.from_within || is_plane(cx.editor.scene(), hit.body) => {
                PointerTarget::Surroundings
            }
            Some(hit) => match cx.editor.edited().item(ScenePart::Body(hit.body)) {
                Some(item) => PointerTarget::Body { item, point: hit.position },
                None => PointerTarget::Nothing,
            },
            None => PointerTarget::Nothing,
        }
    }

    /// All things under a place, in the order in which clicks choose them.
    pub(crate) fn things_at(&self, cx: &Cx<'_>, at: DVec2) -> Vec<Item> {
        let mut marks = self.marks_at(cx, at);
        marks.extend(offscreen::arrow_at(cx, self, self.pos(at)));
        let bodies = self.bodies_at(at).into_iter();
        marks.extend(bodies.filter_map(|index| cx.editor.edited().item(ScenePart::Body(index))));
        marks
    }
}

/// What has a handle of its own over the picture.
pub(crate) fn marks(cx: &Cx<'_>) -> Vec<Item> {
    if !cx.settings.shows_handles {
        return Vec::new();
    }
    let lights = cx.editor.edited().lights();
    let camera = cx.view.free_camera.is_some().then_some(Item::Camera);
    lights.chain(camera).collect()
}

/// Whether a body has no end.
fn is_plane(scene: &Scene, index: usize) -> bool {
    scene.bodies.get(index).is_none_or(|body| body.form().extent().is_none())
}
