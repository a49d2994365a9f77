//! The things of a drag, as they were when it began.

use catoptric_editor::{EditedScene, Editor, Item, Label, PartPath, Selection};
use catoptric_scene::{Anchor, Camera, Placement, ScenePart};
use glam::{DAffine3, DMat3, DVec3};

use super::gizmo::change::GizmoChange;

/// The bodies, lights and camera of a drag, as they were when it began.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DragPayload {
    bodies: Vec<(Item, Placement)>,
    lights: Vec<(Item, DVec3)>,
    camera: Option<Camera>,
    part: Option<StartPart>,
    label: Label,
}

/// A part of a body as it was when its drag began.
#[derive(Clone, Debug, PartialEq)]
struct StartPart {
    whole: Item,
    path: PartPath,
    placement: Placement,
    /// To the frame in which it is placed.
    around_from_world: DAffine3,
    /// The turn of that frame in the world.
    turn: DMat3,
}

impl StartPart {
    /// The part that is meant, unless its body is locked.
    fn take(edited: &EditedScene, selection: &Selection) -> Option<Self> {
        let (index, path) = edited.part_in(selection)?;
        let body = edited.scene().bodies.get(index).filter(|body| !body.locked)?;
        Some(Self {
            whole: selection.primary()?,
            path,
            placement: path.part(body)?.placement,
            around_from_world: path.frame_around(body).inverse(),
            turn: path.parent()?.rotation(body),
        })
    }

    fn apply(&self, editor: &mut Editor, label: Label, change: &GizmoChange) {
        let Some(ScenePart::Body(index)) = editor.edited().part(self.whole) else { return };
        let change = change.within(self.around_from_world, self.turn);
        let _ = editor.change_part(index, self.path, label, |part| {
            part.placement = change.placement(&self.placement, degrees(&part.placement));
        });
    }
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
        if let Some((index, path)) = edited.part_in(selection) {
            let part = StartPart::take(edited, selection)?;
            let name = scene.bodies.get(index).and_then(|body| Some(path.part(body)?.name.clone()));
            let label = Label::new(key, name.unwrap_or_default());
            return Some(Self {
                bodies: Vec::new(),
                lights: Vec::new(),
                camera: None,
                part: Some(part),
                label,
            });
        }
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
        Some(Self { bodies, lights, camera, part: None, label })
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
        if let Some(part) = &self.part {
            part.apply(editor, label(), change);
        }
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

/// The place of the part that is meant: where its gizmo stands.
pub(crate) fn place_of_part(edited: &EditedScene, selection: &Selection) -> Option<DVec3> {
    let (index, path) = edited.part_in(selection)?;
    Some(path.frame(edited.scene().bodies.get(index)?).translation)
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

    #[test]
    fn a_part_follows_the_pointer_in_the_world() {
        use catoptric_scene::{BodyPart, Shape};
        let turned = |scale: f64, x: f64| Placement {
            anchor: Anchor::Frame {
                position: DVec3::X * x,
                rotation_degrees: DVec3::new(20.0, 130.0, -40.0),
            },
            scale: DVec3::splat(scale),
        };
        let ball = BodyPart { placement: turned(0.5, 1.0), ..BodyPart::default() };
        let inner = BodyPart {
            shape: Shape::Union,
            parts: vec![ball],
            placement: turned(3.0, -2.0),
            ..BodyPart::default()
        };
        let body =
            Body { shape: Shape::Group, parts: vec![inner], placement: turned(0.7, 5.0), ..Body::default() };
        let mut editor = Editor::new(Scene { bodies: [body].into(), ..Scene::default() });
        let path = PartPath::by([0, 0]).unwrap();
        let whole = editor.edited().bodies().next().unwrap();
        editor.select(Selection::of_part(whole, path));
        let payload = DragPayload::take(editor.edited(), editor.selection(), false, "edit-move").unwrap();
        let frame = |editor: &Editor| path.frame(&editor.scene().bodies[0]);
        let start = frame(&editor);
        let step = DVec3::new(0.3, -2.0, 1.1);
        payload.apply(&mut editor, &GizmoChange::Move(step));
        let moved = frame(&editor);
        assert!((moved.translation - start.translation - step).length() < 1e-9);
        assert!(moved.matrix3.abs_diff_eq(start.matrix3, 1e-9));
        let pivot = start.translation + DVec3::Y;
        payload.apply(&mut editor, &GizmoChange::Turn { pivot, axis: DVec3::Z, radians: 1.0 });
        let turn = DMat3::from_axis_angle(DVec3::Z, 1.0);
        let turned = frame(&editor);
        assert!((turned.translation - pivot - turn * (start.translation - pivot)).length() < 1e-9);
        assert!(turned.matrix3.abs_diff_eq(turn * start.matrix3, 1e-6));
        let factors = DVec3::splat(2.0);
        payload.apply(&mut editor, &GizmoChange::Scale { pivot, axes: DVec3::AXES, factors });
        let scaled = frame(&editor);
        assert!((scaled.translation - pivot - 2.0 * (start.translation - pivot)).length() < 1e-9);
        assert!(scaled.matrix3.abs_diff_eq(start.matrix3 * 2.0, 1e-9));
        editor.settle();
        assert_eq!(editor.steps().len(), 1);
    }
}
