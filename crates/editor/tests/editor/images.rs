//! Pictures that are opened apart from the document, and named from where it is saved.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

use catoptric_editor::{Action, Editor, Label};
use catoptric_scene::{
    Body, Image, ImageSource, Material, MaterialChoice, NamedMaterial, Pattern, Phong, Scene, ScenePart,
    Surroundings,
};
use proptest::prelude::*;

fn textured(path: &str) -> MaterialChoice {
    MaterialChoice::Inline(Box::new(Material::Phong(Phong {
        pattern: Pattern { texture: Some(Image::new(path)), ..Pattern::default() },
        ..Phong::default()
    })))
}

fn scene() -> Scene {
    let body = Body { material: textured("wood.png"), ..Body::default() };
    let mut scene = Scene { bodies: [Body::default(), body].into(), ..Scene::default() };
    scene.environment.surroundings = Surroundings::Picture(Image::new("builtin:evening"));
    scene
}

fn open(source: &ImageSource) -> Option<Image> {
    let path = source.path();
    let grid = Image::built_in("grid").unwrap();
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

#[derive(Clone, Debug)]
enum Edit {
    Texture(usize),
    SharedTexture,
    Surroundings,
    Insert(usize),
    Append,
    Delete(usize),
    Undo,
    Redo,
    Revert,
    Replace,
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let place = 0_usize..700;
    let edit = prop_oneof![
        4 => place.clone().prop_map(Edit::Texture),
        1 => Just(Edit::SharedTexture),
        1 => Just(Edit::Surroundings),
        1 => place.clone().prop_map(Edit::Insert),
        2 => Just(Edit::Append),
        2 => place.prop_map(Edit::Delete),
        4 => Just(Edit::Undo),
        2 => Just(Edit::Redo),
        1 => Just(Edit::Revert),
        1 => Just(Edit::Replace),
    ];
    proptest::collection::vec(edit, 1..40)
}

/// A scene of three slices of bodies, with pictures of its own.
fn large(number: usize) -> Scene {
    let body = |index: usize| {
        let material = textured(&format!("{number}-{index}.png"));
        Body { material, ..Body::default() }
    };
    let materials = vec![NamedMaterial { name: "shared".to_owned(), material: Material::default() }];
    Scene { bodies: (0..600).map(body).collect(), materials, ..Scene::default() }
}

fn edit(editor: &mut Editor, edit: &Edit, number: usize) {
    let path = format!("{number}.png");
    let label = Label::new("edit", path.clone());
    let new = Body { material: textured(&path), ..Body::default() };
    let count = editor.scene().bodies.len();
    let changed = match *edit {
        Edit::Texture(place) => editor.change_body(place, label, |body| body.material = new.material),
        Edit::SharedTexture => editor.change_material(0, label, |material| {
            material.pattern_mut().unwrap().texture = Some(Image::new(path));
        }),
        Edit::Surroundings => editor.change_environment(label, |environment| {
            environment.surroundings = Surroundings::Picture(Image::new(path));
        }),
        Edit::Insert(place) => editor.change(label, |scene| scene.bodies.insert(place.min(count), new)),
        Edit::Append => editor.change(label, |scene| scene.bodies.push(new)),
        Edit::Delete(place) if place < count => {
            editor.change(label, |scene| drop(scene.bodies.remove(place)))
        }
        Edit::Delete(_) => Ok(false),
        Edit::Undo => Ok(editor.undo()),
        Edit::Redo => Ok(editor.redo()),
        Edit::Revert => editor.revert("", large(number)).map(|()| true),
        Edit::Replace => {
            *editor = Editor::new(large(number)).succeeding(editor);
            Ok(true)
        }
    };
    changed.unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whoever_has_seen_a_scene_needs_to_see_only_what_it_does_not_share(edits in edits()) {
        let mut editor = Editor::new(large(1000));
        let mut before = Arc::clone(editor.scene());
        let mut seen: HashSet<String> = before.images().map(|image| image.path().to_owned()).collect();
        for (number, next) in edits.iter().enumerate() {
            edit(&mut editor, next, number);
            let scene = Arc::clone(editor.scene());
            seen.extend(scene.images_besides(&before).map(|image| image.path().to_owned()));
            for image in scene.images() {
                prop_assert!(seen.contains(image.path()), "{} after {:?}", image.path(), next);
            }
            before = scene;
        }
    }
}

fn paths(scene: &Scene) -> Vec<String> {
    scene.images().map(|image| image.path().to_owned()).collect()
}

fn save_to(editor: &mut Editor, path: &str) -> Vec<String> {
    let writing = editor.writing_to(Path::new(path));
    editor.mark_written(&writing, path, writing.text());
    assert!(!editor.is_changed() && Arc::ptr_eq(editor.scene(), writing.scene()));
    paths(editor.scene())
}

#[test]
fn paths_follow_the_document() {
    let mut editor = Editor::open("/scenes/a/room.toml", "", scene());
    let revision = editor.revision();
    assert_eq!(save_to(&mut editor, "/scenes/a/hall.toml"), ["builtin:evening", "wood.png"]);
    assert_eq!(editor.revision(), revision);
    assert_eq!(save_to(&mut editor, "/scenes/b/room.toml"), ["builtin:evening", "/scenes/a/wood.png"]);
    assert!(editor.revision() > revision);
    assert_eq!(save_to(&mut editor, "/scenes/room.toml"), ["builtin:evening", "a/wood.png"]);
    assert_eq!(editor.steps().len(), 0, "this is no edit");
}

#[test]
fn paths_follow_the_document_in_all_its_steps() {
    let mut editor = Editor::open("/scenes/a/room.toml", "", scene());
    for path in ["planet.png", "moon.png"] {
        editor.change_body(0, Label::new("a", path), |body| body.material = textured(path)).unwrap();
    }
    editor.undo();
    save_to(&mut editor, "/scenes/b/room.toml");
    editor.check_invariants().unwrap();
    let wood = "/scenes/a/wood.png";
    assert!(editor.undo() && editor.is_changed());
    assert_eq!(save_to(&mut editor, "/scenes/b/room.toml"), ["builtin:evening", wood]);
    assert!(editor.redo() && editor.redo(), "saving leaves what was undone to be done again");
    let moon = ["builtin:evening", "/scenes/a/moon.png", wood];
    assert_eq!(save_to(&mut editor, "/scenes/b/room.toml"), moon);
    assert_eq!(save_to(&mut editor, "/scenes/room.toml"), ["builtin:evening", "a/moon.png", "a/wood.png"]);
}

#[test]
fn a_document_that_could_not_be_saved_elsewhere_keeps_its_paths() {
    let editor = Editor::open("/scenes/a/room.toml", "", scene());
    let writing = editor.writing_to(Path::new("/scenes/b/room.toml"));
    assert_eq!(paths(writing.scene()), ["builtin:evening", "/scenes/a/wood.png"]);
    assert!(writing.text().contains("/scenes/a/wood.png"));
    assert_eq!(paths(editor.scene()), ["builtin:evening", "wood.png"]);
    assert!(!editor.is_changed());
}

#[test]
fn a_document_that_is_saved_while_its_pictures_are_being_opened_is_saved() {
    let mut editor = Editor::new(scene());
    let writing = editor.writing_to(Path::new("/scenes/a.toml"));
    assert!(editor.open_images(open));
    editor.mark_written(&writing, "/scenes/a.toml", writing.text());
    assert_eq!(unopened(&editor), 0);
    assert!(!editor.is_changed());
}

#[test]
fn an_edit_while_the_document_is_being_saved_elsewhere_follows_it() {
    let mut editor = Editor::open("/scenes/a/room.toml", "", scene());
    let writing = editor.writing_to(Path::new("/scenes/b/room.toml"));
    editor.change_body(0, Label::new("a", ""), |body| body.material = textured("moon.png")).unwrap();
    editor.mark_written(&writing, "/scenes/b/room.toml", writing.text());
    assert_eq!(paths(editor.scene()), ["builtin:evening", "/scenes/a/moon.png", "/scenes/a/wood.png"]);
    assert!(editor.is_in_gesture() && editor.is_changed());
    assert!(editor.undo() && !editor.is_changed());
}

#[test]
fn pasting_a_picture_that_is_there_finds_it() {
    let mut editor = Editor::new(scene());
    editor.open_images(open);
    editor.select_parts([ScenePart::Body(1)]);
    let text = editor.copy().unwrap();
    editor.apply(Action::Paste(text)).unwrap();
    assert_eq!((editor.scene().bodies.len(), unopened(&editor)), (3, 0));
}

#[test]
fn what_is_pasted_in_another_folder_has_the_same_pictures() {
    let mut from = Editor::open("/scenes/a/room.toml", "", scene());
    from.select_parts([ScenePart::Body(1)]);
    let text = from.copy().unwrap();
    assert!(text.contains("\"/scenes/a/wood.png\""), "{text}");
    for (file, path) in [
        ("/scenes/b/c.toml", "/scenes/a/wood.png"),
        ("/scenes/c.toml", "a/wood.png"),
        ("/scenes/a/c.toml", "wood.png"),
    ] {
        let mut to = Editor::open(file, "", Scene::default());
        to.apply(Action::Paste(text.clone())).unwrap();
        assert_eq!(paths(to.scene()), [path], "{file}");
    }
    from.apply(Action::Paste(text)).unwrap();
    assert_eq!(paths(from.scene()), ["builtin:evening", "wood.png", "wood.png"]);
    let by_hand = "format = 'catoptric/1'\n[[bodies]]\nmaterial = { texture = '../t/wood.png' }\n";
    from.apply(Action::Paste(by_hand.to_owned())).unwrap();
    assert_eq!(paths(from.scene())[3], "../t/wood.png");
    let mut whole = Editor::open("/scenes/a/room.toml", "", Scene::default());
    whole.apply(Action::Paste(by_hand.replace("../t", "/scenes/a"))).unwrap();
    assert_eq!(paths(whole.scene()), ["wood.png"]);
    whole.change_body(0, Label::new("a", ""), |body| body.material = textured("/scenes/a/wood.png")).unwrap();
    whole.apply(Action::Paste(whole.copy().unwrap())).unwrap();
    assert_eq!(paths(whole.scene()), ["/scenes/a/wood.png"; 2], "as it is called there");
}
