//! Every key of the format, set by its address: read back, undone, done again, saved and read from the file.

use std::num::NonZero;
use std::thread;

use catoptric_editor::Editor;
use catoptric_scene::format::keys;
use catoptric_scene::format::spec::{KeySpec, Kind, Limits};
use catoptric_scene::{Example, Scene, SceneEdit, SceneKey, ScenePath, SceneValue, read, write};

use crate::common::label;

/// A scene with one element of each kind.
const SMALL: &str = "# mine
format = 'catoptric/1' # one
[materials.glass]
model = 'dielectric'
[materials.'my wood'] # two
color = [0.5, 0.4, 0.3]
[[lights]]
name = 'sun'
intensity = 2
[[bodies]]
name = 'ball' # round
radius = 0.5
material = 'glass'
[[bodies]]
material = { color = [0.1, 0.2, 0.3] }
[[bodies]]
name = 'pair'
shape = 'union'
[[bodies.parts]]
name = 'left' # three
radius = 0.5
material = 'glass'
[[bodies.parts]]
position = [1.0, 0.0, 0.0]
[[bodies]]
name = 'crowd'
shape = 'group'
[[bodies.parts]]
name = 'member'
";

/// What can be wrong with values that are valid by themselves.
const RULES: [&str; 17] = [
    "the body `",
    "with this instance of",
    "`target` and",
    "`up` is",
    "`base` and `top` are",
    "`focal_length` ",
    "`inner_radius` is not smaller",
    "`thickness` is not smaller",
    "the rim of this",
    "a face with a radius",
    "the faces of this lens",
    "the ball of a face",
    "a lens whose index",
    "no lens of this",
    "a surface has no inside",
    "the first part of a surface",
    "the corners `a`",
];

/// Values of a key at the ends of what it can be and between.
fn values(scene: &Scene, key: &KeySpec) -> Vec<SceneValue> {
    let middle = |limits: Limits| if limits.contains(0.75) { 0.75 } else { 0.5 * (limits.min + limits.max) };
    let vectors = |limits: Limits| {
        let (Limits { min, max }, middle) = (limits, middle(limits));
        [[min, middle, max], [middle, min, middle], [middle, 0.5 * middle, middle]].map(SceneValue::from)
    };
    match key.kind {
        Kind::Text if key.name == "instance_of" => ["ball".into(), "another".into()].into(),
        Kind::Text => ["another".into(), "имя \"в кавычках\". = # '".into()].into(),
        Kind::File => ["builtin:grid".into(), "a folder/b.png".into()].into(),
        Kind::Flag => [true.into(), false.into()].into(),
        Kind::Choice(words) => words.iter().copied().map(SceneValue::from).collect(),
        Kind::Number(limits) => [limits.min, middle(limits), limits.max].map(SceneValue::from).into(),
        Kind::Integer(limits) => {
            [limits.min, middle(limits).round(), limits.max].map(SceneValue::from).into()
        }
        Kind::Vector(limits) | Kind::Color(limits) => vectors(limits).into(),
        Kind::NumberOrVector(limits) => [&vectors(limits)[..], &[middle(limits).into()]].concat(),
        Kind::NameOrTable(_) => scene.materials.iter().map(|named| named.name.as_str().into()).collect(),
        Kind::Version(_) | Kind::Table(_) | Kind::Named(_) | Kind::List(_) => panic!("no value"),
    }
}

/// The edit of a key, with that of the key that must stand beside it.
fn edits(scene: &Scene, key: &SceneKey, value: Option<SceneValue>) -> Vec<SceneEdit> {
    let own = SceneEdit { path: key.path.clone(), value };
    let text = key.path.to_string();
    let partner = key.spec.requires.filter(|_| own.value.is_some()).and_then(|name| {
        let (table, _) = text.rsplit_once('.')?;
        let path: ScenePath = format!("{table}.{name}").parse().ok()?;
        let value = match key.spec.name {
            "layer" => "builtin:grid".into(),
            "ior" => 2.0.into(),
            _ => [1.0, 2.0, 3.0].into(),
        };
        scene.get(&path).is_err().then_some(SceneEdit { path, value: Some(value) })
    });
    [own].into_iter().chain(partner).collect()
}

/// Sets one key in an open document; returns whether that changed the scene.
fn check(editor: &mut Editor, key: &SceneKey, value: Option<SceneValue>) -> bool {
    let start = Scene::clone(editor.scene());
    let edits = edits(&start, key, value);
    let (path, value) = (&key.path, &edits[0].value);
    let mut expected = start.clone();
    if let Err(error) = expected.edit(&edits) {
        let error = error.to_string();
        let is_known =
            RULES.iter().any(|rule| error.starts_with(rule)) || error.contains("needs at least one part");
        assert!(is_known, "{path} = {value:?}: {error}");
        return false;
    }
    let set = editor.change(label("edit-value"), |scene| scene.edit(&edits).unwrap());
    if expected == start {
        assert_eq!(set, Ok(false), "{path} = {value:?}");
        return false;
    }
    assert_eq!(set, Ok(true), "{path} = {value:?}");
    assert!(editor.settle() && editor.undo());
    assert_eq!(**editor.scene(), start, "{path} = {value:?}");
    assert!(editor.redo());
    assert_eq!(**editor.scene(), expected, "{path} = {value:?}");
    if let Some(value) = value
        && *key.spec.name != *"name"
    {
        assert_eq!(editor.scene().get(path).as_ref(), Ok(value), "{path}");
    }
    let reading = read(&editor.writing().text());
    assert!(!reading.diagnostics.has_errors(), "{path} = {value:?}: {}", reading.diagnostics);
    assert_eq!(reading.scene, expected, "{path} = {value:?}");
    assert!(editor.undo());
    true
}

/// Sets every key of a scene to each of these values.
fn check_all(
    text: &str,
    scene: &Scene,
    values: impl Fn(&KeySpec) -> Vec<Option<SceneValue>>,
    changed: &mut Vec<&'static KeySpec>,
) {
    let mut editor = Editor::open("scene.toml", text, scene.clone());
    for key in scene.keys() {
        for value in values(key.spec) {
            if check(&mut editor, &key, value) && !changed.contains(&key.spec) {
                changed.push(key.spec);
            }
        }
    }
    assert_eq!(&**editor.scene(), scene);
    assert!(!editor.is_changed());
}

#[test]
fn what_is_set_at_every_key_is_saved_and_can_be_undone() {
    let mut changed = Vec::new();
    let small = read(SMALL).into_result().unwrap().value;
    let values = &|key: &KeySpec| {
        // Keys beside a choice may need its word; those beside another key go with it.
        let can_go = !matches!(key.kind, Kind::Choice(_));
        values(&small, key).into_iter().map(Some).chain(can_go.then_some(None)).collect()
    };
    check_all(SMALL, &small, values, &mut changed);
    // Other words of the choices have other keys.
    let others: Vec<Scene> = small
        .keys()
        .flat_map(|key| {
            let Kind::Choice(words) = key.spec.kind else { return Vec::new() };
            let with = |word: &&str| {
                let mut scene = small.clone();
                (scene.set(&key.path, *word).is_ok() && scene != small).then_some(scene)
            };
            words.iter().filter_map(with).collect()
        })
        .collect();
    // All processors have a part of them: it takes long.
    let count = thread::available_parallelism().map_or(1, NonZero::get);
    let parts: Vec<Vec<&'static KeySpec>> = thread::scope(|scope| {
        let part = |first| {
            let others = &others;
            scope.spawn(move || {
                let mut changed = Vec::new();
                for scene in others.iter().skip(first).step_by(count) {
                    check_all(&write(scene), scene, values, &mut changed);
                }
                changed
            })
        };
        let parts: Vec<_> = (0..count).map(part).collect();
        parts.into_iter().map(|part| part.join().unwrap()).collect()
    });
    changed.extend(parts.into_iter().flatten());
    let keys = keys::TABLES.iter().filter(|table| ***table != keys::ROOT).flat_map(|table| table.keys);
    let keys = keys.filter(|key| !matches!(key.kind, Kind::Table(_) | Kind::List(_)));
    let missing: Vec<&str> = keys.filter(|key| !changed.contains(key)).map(|key| key.name).collect();
    assert_eq!(missing, Vec::<&str>::new(), "keys that were never set to another value");
}

#[test]
fn the_keys_of_the_examples_are_saved_and_can_be_undone() {
    for example in Example::ALL {
        let mut changed = Vec::new();
        let scene = read(example.text).into_result().unwrap().value;
        let one = |key: &KeySpec| values(&scene, key).pop().into_iter().map(Some).collect();
        check_all(example.text, &scene, one, &mut changed);
        assert!(changed.len() > 20, "{}: {}", example.name, changed.len());
    }
}
