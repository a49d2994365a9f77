//! The things of a drag, as they were when it began.

use catoptric_editor::{EditedScene, Editor, Item, Label, Selection};
use catoptric_scene::{Anchor, Camera, Placement, ScenePart};
use glam::DVec3;

use super::gizmo::change::GizmoChange;

/// The bodies, lights and camera of a drag, as they were when it began.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DragPayload {
    bodies: Vec<(Item, Placement)>,
    lights: Vec<(Item, DVec3)>,
    camera: Option<Camera>,
    label: Label,
}

impl DragPayload {
    /// Takes what is selected and not locked; `None` when there is nothing. `with_camera` takes the camera, too, if it
    /// is selected. `key` names the step of the history.
    pub(crate) fn take(
        edited: &EditedScene,
        selection: &Selection,
        with_camera: bool,
        key: &'static str,
    ) -> Option<Self> {
        let scene = edited.scene();
        let (mut bodies, mut lights, mut camera) = (Vec::new(), Vec::new(), None);
        for item in selection.iter() {
            match edited.part(item) {
                Some(part) if part.is_locked(scene) => {}
                Some(ScenePart::Body(index)) => {
                    bodies.extend(scene.bodies.get(index).map(|body| (item, body.placement)));
                }
                Some(ScenePart::Light(index)) => {
                    lights.extend(scene.lights.get(index).map(|light| (item, light.position)));
                }
                Some(ScenePart::Camera) if with_camera => camera = Some(scene.camera),
                _ => {}
            }
        }
        let subject = match (bodies.as_slice(), lights.as_slice(), camera) {
            ([(item, _)], [], None) | ([], [(item, _)], None) => edited.name(*item),
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
        let bodies = placed(editor.edited(), &self.bodies);
        if !bodies.is_empty() {
            let mut starts = bodies.iter();
            let _ = editor.change_bodies(bodies.iter().map(|(index, _)| *index), label(), |_, body| {
                if let Some((_, start)) = starts.next() {
                    body.placement = change.placement(start, degrees(&body.placement));
                }
            });
        }
        let lights = placed(editor.edited(), &self.lights);
        if !lights.is_empty() {
            let mut starts = lights.iter();
            let _ = editor.change_lights(lights.iter().map(|(index, _)| *index), label(), |_, light| {
                if let Some((_, start)) = starts.next() {
                    light.position = change.point(*start);
                }
            });
        }
        if let Some(start) = &self.camera {
            let _ = editor.change_camera(label(), |camera| *camera = change.camera(start));
        }
    }
}

/// The places of the things that the scene has now, each with how it was.
fn placed<T: Copy>(edited: &EditedScene, starts: &[(Item, T)]) -> Vec<(usize, T)> {
    let place = |(item, start): &(Item, T)| match edited.part(*item)? {
        ScenePart::Body(index) | ScenePart::Light(index) => Some((index, *start)),
        _ => None,
    };
    starts.iter().filter_map(place).collect()
}

/// The turns of a placement; zeros when its axis is given by two points.
fn degrees(placement: &Placement) -> DVec3 {
    match placement.anchor {
        Anchor::Frame { rotation_degrees, .. } => rotation_degrees,
        Anchor::Axis { .. } => DVec3::ZERO,
    }
}

/// The place of a body, a light or the camera: where its gizmo stands.
pub(crate) fn place_of(edited: &EditedScene, item: Item) -> Option<DVec3> {
    let scene = edited.scene();
    match edited.part(item)? {
        ScenePart::Body(index) => {
            scene.bodies.get(index).map(|body| body.placement.world_from_body().translation)
        }
        ScenePart::Light(index) => scene.lights.get(index).map(|light| light.position),
        ScenePart::Camera => Some(scene.camera.position),
        ScenePart::Environment | ScenePart::Tracing | ScenePart::Material(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_scene::{Body, Light, Scene};

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
        let item = |editor: &Editor, part| editor.edited().item(part).unwrap();
        let [one, two] = [ScenePart::Body(1), ScenePart::Body(2)].map(|part| item(&editor, part));
        let light = item(&editor, ScenePart::Light(0));
        editor.select(one);
        assert_eq!(DragPayload::take(editor.edited(), editor.selection(), true, "edit-move"), None);
        let all: Selection = [one, two, light, Item::Camera].into_iter().collect();
        let payload = DragPayload::take(editor.edited(), &all, false, "edit-move").unwrap();
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
        let light = editor.edited().lights().next().unwrap();
        let payload = DragPayload::take(editor.edited(), &light.into(), false, "edit-move").unwrap();
        assert_eq!(payload.label, Label::new("edit-move", "sun"));
    }
}
