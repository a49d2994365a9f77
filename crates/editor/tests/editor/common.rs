//! Small scenes and short ways to say things.

use catoptric_editor::{Action, ActionError, Editor, Item, Label};
use catoptric_scene::{
    Body, Light, Material, MaterialChoice, NamedMaterial, Phong, Placement, Scene, ScenePart, Shape,
};
use glam::DVec3;

pub(crate) fn ball(name: &str, x: f64) -> Body {
    Body {
        name: name.to_owned(),
        shape: Shape::SPHERE,
        placement: Placement::at(DVec3::X * x),
        ..Body::default()
    }
}

pub(crate) fn of(body: Body, material: &str) -> Body {
    Body { material: MaterialChoice::Named(material.to_owned()), ..body }
}

pub(crate) fn lamp(name: &str) -> Light {
    Light { name: name.to_owned(), ..Light::default() }
}

pub(crate) fn named(name: &str, ior: f64) -> NamedMaterial {
    NamedMaterial { name: name.to_owned(), material: Material::Phong(Phong { ior, ..Phong::default() }) }
}

/// Bodies a to d at x = 0, 3, 6 and 9 of the materials red, red, blue and their own; two lamps; a third material.
pub(crate) fn scene() -> Scene {
    Scene {
        materials: vec![named("red", 1.1), named("blue", 1.2), named("spare", 1.3)],
        lights: vec![lamp("left"), lamp("right")],
        bodies: [
            of(ball("a", 0.0), "red"),
            of(ball("b", 3.0), "red"),
            of(ball("c", 6.0), "blue"),
            ball("d", 9.0),
        ]
        .into(),
        ..Scene::default()
    }
}

pub(crate) fn editor() -> Editor {
    Editor::new(scene())
}

/// An editor with the things at these places selected.
pub(crate) fn selecting(parts: impl IntoIterator<Item = ScenePart>) -> Editor {
    let mut editor = editor();
    editor.select_parts(parts);
    editor
}

/// What stands at each place now; where nothing does, a thing that the scene does not have.
pub(crate) fn items(editor: &Editor) -> impl Fn(ScenePart) -> Item + use<> {
    let edited = editor.edited().clone();
    let stranger = self::editor().edited().bodies().next().unwrap();
    move |part| edited.item(part).unwrap_or(stranger)
}

pub(crate) fn bodies(indices: impl IntoIterator<Item = usize>) -> impl Iterator<Item = ScenePart> {
    indices.into_iter().map(ScenePart::Body)
}

pub(crate) fn label(key: &'static str) -> Label {
    Label::new(key, "")
}

/// Tells that the document as it is now was saved.
pub(crate) fn save(editor: &mut Editor, path: &str, text: &str) {
    let writing = editor.writing();
    editor.mark_written(&writing, path, text);
}

pub(crate) fn names(editor: &Editor) -> Vec<&str> {
    editor.scene().bodies.iter().map(|body| body.name.as_str()).collect()
}

/// The places of what is selected.
pub(crate) fn selected(editor: &Editor) -> Vec<ScenePart> {
    editor.selected_parts().collect()
}

/// Applies an action that must work, be one step with its key, be undone exactly, and be done again.
pub(crate) fn act(editor: &mut Editor, action: &Action) {
    editor.settle();
    let (before, selection, steps) =
        (editor.scene().clone(), editor.selection().clone(), editor.steps_done());
    assert!(editor.can(action), "{action:?}");
    editor.apply(action.clone()).unwrap_or_else(|error| panic!("{action:?}: {error}"));
    editor.check_invariants().unwrap();
    assert_eq!(editor.steps_done(), steps + 1, "{action:?}");
    assert_eq!(editor.undo_label().unwrap().key, action.key());
    let (after, selection_after) = (editor.scene().clone(), editor.selection().clone());
    assert_ne!(before, after);
    assert!(editor.undo());
    assert_eq!((editor.scene(), editor.selection()), (&before, &selection));
    assert_eq!(editor.redo_label().unwrap().key, action.key());
    assert!(editor.redo());
    assert_eq!((editor.scene(), editor.selection()), (&after, &selection_after));
}

/// Applies an action that cannot be done, and nothing may have changed.
pub(crate) fn refuse(editor: &mut Editor, action: &Action) -> ActionError {
    let (before, selection, steps) =
        (editor.scene().clone(), editor.selection().clone(), editor.steps_done());
    let error = editor.apply(action.clone()).unwrap_err();
    assert_eq!((editor.scene(), editor.selection(), editor.steps_done()), (&before, &selection, steps));
    error
}

/// Applies an action that cannot be done and whose menu entry is gray; nothing may have changed.
pub(crate) fn gray(editor: &mut Editor, action: &Action) -> ActionError {
    assert!(!editor.can(action), "{action:?}");
    refuse(editor, action)
}
