//! Pictures that are opened apart from the document, and named from where it is saved.

use std::path::Path;
use std::sync::Arc;

use catoptric_editor::{Editor, Label};
use catoptric_scene::{Body, Image, Material, MaterialChoice, Scene, Surroundings};

fn textured(path: &str) -> MaterialChoice {
    MaterialChoice::Inline(Box::new(Material { texture: Some(Image::new(path)), ..Material::default() }))
}

fn scene() -> Scene {
    let body = Body { material: textured("wood.png"), ..Body::default() };
    let mut scene = Scene { bodies: [Body::default(), body].into(), ..Scene::default() };
    scene.environment.surroundings = Surroundings::Picture(Image::new("builtin:evening"));
    scene
}

fn open(path: &str) -> Option<Image> {
    let grid = Image::open("builtin:grid", None).unwrap();
    (path != "none.png").then(|| Image::with_pixels(path, Arc::clone(grid.pixels().unwrap())))
}

fn unopened(editor: &Editor) -> usize {
    editor.scene().images().filter(|image| image.pixels().is_none()).count()
}

#[test]
fn opening_is_no_edit_and_reaches_every_step() {
    let mut editor = Editor::new(scene());
    for path in ["planet.png", "none.png", "moon.png"] {
        editor.change_body(0, Label::new("a", path), |body| body.material = textured(path)).unwrap();
    }
    assert_eq!(unopened(&editor), 3);
    let (revision, steps) = (editor.revision(), editor.steps().len());
    assert!(editor.open_images(open));
    assert_eq!((unopened(&editor), editor.steps().len()), (0, steps));
    assert!(editor.revision() > revision && !editor.open_images(open));
    editor.check_invariants().unwrap();
    editor.undo();
    assert_eq!(unopened(&editor), 1, "one cannot be opened");
    editor.undo();
    assert_eq!(unopened(&editor), 0);
    editor.undo();
    assert_eq!(unopened(&editor), 0);
    assert!(!editor.is_changed(), "the saved scene has them too");
}

#[test]
fn what_is_opened_reaches_steps_that_were_taken_back() {
    let mut editor = Editor::new(Scene { bodies: [Body::default()].into(), ..Scene::default() });
    editor.change_body(0, Label::new("a", ""), |body| body.material = textured("planet.png")).unwrap();
    editor.undo();
    let revision = editor.revision();
    assert!(!editor.open_images(open), "the scene has none now");
    assert_eq!(editor.revision(), revision);
    editor.redo();
    assert_eq!((editor.scene().images().count(), unopened(&editor)), (1, 0));
}

#[test]
fn an_open_gesture_stays_open() {
    let mut editor = Editor::new(scene());
    editor.change_body(0, Label::new("a", ""), |body| body.material = textured("planet.png")).unwrap();
    assert!(editor.open_images(open) && editor.is_in_gesture());
    assert!(editor.settle() && editor.undo());
    assert_eq!(unopened(&editor), 0);
    assert!(!editor.is_changed());
}

#[test]
fn paths_follow_the_document() {
    let mut editor = Editor::open("/scenes/a/room.toml", "", scene());
    let paths = |editor: &Editor| -> Vec<String> {
        editor.scene().images().map(|image| image.path().to_owned()).collect()
    };
    let moved =
        |editor: &mut Editor, to: &str| editor.move_images(Label::new("m", ""), Path::new(to)).unwrap();
    assert!(!moved(&mut editor, "/scenes/a"));
    assert!(moved(&mut editor, "/scenes/b"));
    assert_eq!(paths(&editor), ["builtin:evening", "/scenes/a/wood.png"]);
    assert_eq!(editor.steps().len(), 1);
    editor.undo();
    assert!(moved(&mut editor, "/scenes"));
    assert_eq!(paths(&editor), ["builtin:evening", "a/wood.png"]);
}

#[test]
fn pasting_a_picture_that_is_there_finds_it() {
    let mut editor = Editor::new(scene());
    editor.open_images(open);
    editor.select(catoptric_editor::Item::Body(1));
    let text = editor.copy().unwrap();
    editor.apply(catoptric_editor::Action::Paste(text)).unwrap();
    assert_eq!((editor.scene().bodies.len(), unopened(&editor)), (3, 0));
}
