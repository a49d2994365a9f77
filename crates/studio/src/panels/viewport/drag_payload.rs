//! The things of a drag, as they were when it began.

use catoptric_editor::{Editor, Item, Label, Selection};
use catoptric_scene::{Anchor, Camera, Placement, Scene};
use glam::DVec3;

use super::gizmo::change::GizmoChange;

/// The bodies, lights and camera of a drag, as they were when it began.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DragPayload {
    bodies: Vec<(usize, Placement)>,
    lights: Vec<(usize, DVec3)>,
    camera: Option<Camera>,
    label: Label,
}

impl DragPayload {
    /// Takes what is selected and not locked; `None` when there is nothing. `with_camera` takes the camera, too, if it
    /// is selected. `key` names the step of the history.
    pub(crate) fn take(
        scene: &Scene,
        selection: &Selection,
        with_camera: bool,
        key: &'static str,
    ) -> Option<Self> {
        let is_free = |item: Item| !item.is_locked(scene) && item.is_in(scene);
        let items: Vec<Item> = selection.iter().filter(|item| is_free(*item)).collect();
        let bodies = items.iter().filter_map(|item| match *item {
            Item::Body(index) => Some((index, scene.bodies.get(index)?.placement)),
            _ => None,
        });
        let lights = items.iter().filter_map(|item| match *item {
            Item::Light(index) => Some((index, scene.lights.get(index)?.position)),
            _ => None,
        });
        let camera = (with_camera && items.contains(&Item::Camera)).then_some(scene.camera);
        let (mut bodies, mut lights): (Vec<_>, Vec<_>) = (bodies.collect(), lights.collect());
        bodies.sort_by_key(|(index, _)| *index);
        lights.sort_by_key(|(index, _)| *index);
        let subject = match (bodies.as_slice(), lights.as_slice(), camera) {
            ([(index, _)], [], None) => Item::Body(*index).name(scene),
            ([], [(index, _)], None) => Item::Light(*index).name(scene),
            ([], [], None) => return None,
            _ => "",
        };
        let label = Label::new(key, subject);
        Some(Self { bodies, lights, camera, label })
    }

    /// Brings the first light of it to a place; the move, meters, if there is a light.
    pub(crate) fn bring_to(&self, editor: &mut Editor, place: DVec3) -> Option<DVec3> {
        let (_, start) = self.lights.first()?;
        let step = place - *start;
        self.apply(editor, &GizmoChange::Move(step));
        Some(step)
    }

    /// Has `change` done to it, from how it was when it was taken. What the scene does not allow is left undone.
    pub(crate) fn apply(&self, editor: &mut Editor, change: &GizmoChange) {
        let label = || self.label.clone();
        if !self.bodies.is_empty() {
            let indices = self.bodies.iter().map(|(index, _)| *index);
            let _ = editor.change_bodies(indices, label(), |index, body| {
                if let Some(start) = find(&self.bodies, index) {
                    body.placement = change.placement(start, degrees(&body.placement));
                }
            });
        }
        if !self.lights.is_empty() {
            let indices = self.lights.iter().map(|(index, _)| *index);
            let _ = editor.change_lights(indices, label(), |index, light| {
                if let Some(start) = find(&self.lights, index) {
                    light.position = change.point(*start);
                }
            });
        }
        if let Some(start) = &self.camera {
            let _ = editor.change_camera(label(), |camera| *camera = change.camera(start));
        }
    }
}

/// How the thing at a place was; the list is sorted.
fn find<T>(starts: &[(usize, T)], index: usize) -> Option<&T> {
    let at = starts.binary_search_by_key(&index, |(index, _)| *index).ok()?;
    starts.get(at).map(|(_, start)| start)
}

/// The turns of a placement; zeros when its axis is given by two points.
fn degrees(placement: &Placement) -> DVec3 {
    match placement.anchor {
        Anchor::Frame { rotation_degrees, .. } => rotation_degrees,
        Anchor::Axis { .. } => DVec3::ZERO,
    }
}

/// The place of a body, a light or the camera: where its gizmo stands.
pub(crate) fn place_of(scene: &Scene, item: Item) -> Option<DVec3> {
    match item {
        Item::Body(index) => scene.bodies.get(index).map(|body| body.placement.world_from_body().translation),
        Item::Light(index) => scene.lights.get(index).map(|light| light.position),
        Item::Camera => Some(scene.camera.position),
        Item::Environment | Item::Tracing | Item::Material(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_scene::{Body, Light};

    fn editor() -> Editor {
        let body = |name: &str, locked| Body { name: name.to_owned(), locked, ..Body::default() };
        let scene = Scene {
            bodies: [body("a", false), body("b", true), body("c", false)].into(),
            lights: vec![Light { name: "sun".to_owned(), ..Light::default() }],
            ..Scene::default()
        };
        Editor::new(scene)
    }

    #[test]
    fn locked_things_are_not_taken() {
        let mut editor = editor();
        editor.select(Item::Body(1));
        assert_eq!(DragPayload::take(editor.scene(), editor.selection(), true, "edit-move"), None);
        let all: Selection =
            [Item::Body(1), Item::Body(2), Item::Light(0), Item::Camera].into_iter().collect();
        let payload = DragPayload::take(editor.scene(), &all, false, "edit-move").unwrap();
        let before = editor.scene().clone();
        payload.apply(&mut editor, &GizmoChange::Move(DVec3::X));
        payload.apply(&mut editor, &GizmoChange::Move(2.0 * DVec3::X));
        let after = editor.scene().clone();
        assert_eq!(after.bodies[2].placement, Placement::at(2.0 * DVec3::X));
        assert!(after.bodies.iter().take(2).eq(before.bodies.iter().take(2)));
        assert_eq!(after.lights[0].position, before.lights[0].position + 2.0 * DVec3::X);
        assert_eq!(after.camera, before.camera);
        editor.settle();
        assert_eq!(editor.steps().collect::<Vec<_>>(), [&Label::new("edit-move", "")]);
        editor.undo();
        assert_eq!(editor.scene(), &before);
    }

    #[test]
    fn one_thing_gives_the_step_its_name() {
        let editor = editor();
        let payload = DragPayload::take(editor.scene(), &Item::Light(0).into(), false, "edit-move").unwrap();
        assert_eq!(payload.label, Label::new("edit-move", "sun"));
    }
}
