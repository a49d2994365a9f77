//! Known answers of the actions on bodies and lights.

use catoptric_editor::{Action, ActionError, Item, NewBodyPlacement, bounds};
use catoptric_scene::{Anchor, Placement, ScenePart, Shape, ShapeKind};
use glam::DVec3;

use crate::common::{act, bodies, editor, gray, items, label, names, refuse, selected, selecting};

fn add(shape: ShapeKind, placement: NewBodyPlacement) -> Action {
    Action::AddBody { shape, placement, name: String::new() }
}

#[test]
fn new_bodies_stand_where_they_are_told_in_colors_of_their_own() {
    let mut editor = editor();
    let foot = DVec3::new(0.123, 7.0, 20.0);
    for (shape, height) in [
        (ShapeKind::Sphere, 2.0),
        (ShapeKind::Cube, 1.0),
        (ShapeKind::Cylinder, 0.0),
        (ShapeKind::Cone, 0.0),
        (ShapeKind::Paraboloid, 0.0),
        (ShapeKind::Sphere, 2.0),
    ] {
        act(&mut editor, &add(shape, NewBodyPlacement { size: 2.0, ..NewBodyPlacement::at(foot) }));
        let body = editor.scene().bodies.last().unwrap();
        assert_eq!(body.placement, Placement::at(foot + height * DVec3::Y));
        assert_eq!(bounds::of_body(body).unwrap().min.y, 7.0);
    }
    let scene = editor.scene();
    assert_eq!(names(&editor)[4..], ["sphere", "cube", "cylinder", "cone", "paraboloid", "sphere 2"]);
    assert_eq!(selected(&editor), [ScenePart::Body(9)]);
    assert_eq!(editor.undo_label().unwrap().subject, "sphere 2");
    let mut colors = Vec::new();
    for (index, body) in scene.bodies.iter().skip(4).enumerate() {
        let color = scene.material(&body.material).unwrap().pattern().unwrap().color;
        assert!(!colors.contains(&color), "number {index}");
        colors.push(color);
    }
    let name = " Пол ".to_owned();
    act(
        &mut editor,
        &Action::AddBody { shape: ShapeKind::Plane, placement: NewBodyPlacement::at(foot), name },
    );
    let plane = editor.scene().bodies.last().unwrap();
    assert_eq!((plane.name.as_str(), plane.placement.origin()), ("Пол", foot));
    let far = NewBodyPlacement::at(DVec3::new(f64::NAN, 0.0, 0.0));
    assert!(matches!(refuse(&mut editor, &add(ShapeKind::Cube, far)), ActionError::Refused(_)));
}

#[test]
fn new_lights_and_materials_are_selected() {
    let mut editor = editor();
    act(&mut editor, &Action::AddLight { at: DVec3::new(1.0, 2.0, 3.0), name: "left".to_owned() });
    let light = editor.scene().lights.last().unwrap();
    assert_eq!((light.name.as_str(), light.position), ("left 2", DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(selected(&editor), [ScenePart::Light(2)]);
    act(&mut editor, &Action::AddMaterial { name: String::new() });
    assert_eq!(editor.scene().materials.last().unwrap().name, "material");
    assert_eq!(selected(&editor), [ScenePart::Material(3)]);
}

#[test]
fn duplicates_are_named_moved_and_selected() {
    let mut editor = selecting([
        ScenePart::Body(1),
        ScenePart::Light(0),
        ScenePart::Material(0),
        ScenePart::Camera,
        ScenePart::Body(0),
    ]);
    let item = items(&editor);
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(0)), locked: true }).unwrap();
    act(&mut editor, &Action::Duplicate);
    let scene = editor.scene();
    assert_eq!(names(&editor), ["a", "b", "c", "d", "a 2", "b 2"]);
    assert_eq!(scene.lights[2].name, "left 2");
    assert_eq!(
        (scene.materials[3].name.as_str(), scene.materials[3].material.clone()),
        ("red 2", scene.materials[0].material.clone())
    );
    assert_eq!(selected(&editor), [ScenePart::Light(2), ScenePart::Body(4), ScenePart::Body(5)]);
    assert!(scene.bodies[0].locked && !scene.bodies[4].locked);
    // All by the same way, half the radius of the ball around the copies (x from −1 to 4).
    let offset = scene.bodies[4].placement.origin() - scene.bodies[0].placement.origin();
    assert_eq!(offset, DVec3::new(1.25, 0.0, 1.25));
    assert_eq!(scene.bodies[5].placement.origin(), DVec3::X * 3.0 + offset);
    assert_eq!(scene.lights[2].position, scene.lights[0].position + offset);
    editor.select(Item::Tracing);
    assert!(matches!(gray(&mut editor, &Action::Duplicate), ActionError::NothingSelected));
}

#[test]
fn deletion_keeps_what_is_locked() {
    let mut editor = selecting([
        ScenePart::Body(2),
        ScenePart::Light(1),
        ScenePart::Body(0),
        ScenePart::Body(1),
        ScenePart::Tracing,
    ]);
    let item = items(&editor);
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(2)), locked: true }).unwrap();
    act(&mut editor, &Action::Delete);
    assert_eq!(names(&editor), ["c", "d"]);
    assert_eq!(editor.scene().lights.len(), 1);
    assert_eq!(selected(&editor), [ScenePart::Body(0), ScenePart::Tracing]);
    assert!(matches!(gray(&mut editor, &Action::Delete), ActionError::Locked));
    assert!(matches!(gray(&mut editor, &Action::Cut), ActionError::Locked));
    editor.apply(Action::Undo).unwrap();
    editor.select_parts([ScenePart::Light(1), ScenePart::Light(0), ScenePart::Body(0), ScenePart::Body(3)]);
    for item in [ScenePart::Light(1), ScenePart::Body(3)].map(&item) {
        editor.apply(Action::SetLocked { item, locked: true }).unwrap();
    }
    act(&mut editor, &Action::Delete);
    assert_eq!(selected(&editor), [ScenePart::Light(0), ScenePart::Body(2)]);
    assert_eq!(editor.scene().lights[0].name, "right");
    editor.apply(Action::UnlockAll).unwrap();
    editor.select_parts([ScenePart::Body(2)]);
    act(&mut editor, &Action::Cut);
    assert_eq!(editor.undo_label().unwrap().subject, "d");
    assert!(matches!(gray(&mut editor, &Action::Delete), ActionError::NothingSelected));
}

#[test]
fn things_are_hidden_and_locked() {
    let mut editor = selecting([ScenePart::Body(0), ScenePart::Light(0), ScenePart::Camera]);
    let item = items(&editor);
    let hidden = |editor: &catoptric_editor::Editor| {
        (editor.scene().bodies[0].hidden, editor.scene().bodies[1].hidden, editor.scene().lights[0].hidden)
    };
    act(&mut editor, &Action::SetHidden { item: item(ScenePart::Light(0)), hidden: true });
    act(&mut editor, &Action::ToggleHidden);
    assert_eq!(hidden(&editor), (true, false, true));
    act(&mut editor, &Action::ToggleHidden);
    assert_eq!(hidden(&editor), (false, false, false));
    assert!(matches!(gray(&mut editor, &Action::ShowAll), ActionError::NothingToDo));
    act(&mut editor, &Action::ToggleLocked);
    assert!(editor.scene().bodies[0].locked && editor.scene().lights[0].locked);
    act(&mut editor, &Action::ToggleHidden);
    assert_eq!(hidden(&editor), (true, false, true));
    act(&mut editor, &Action::ShowAll);
    assert_eq!(hidden(&editor), (false, false, false));
    act(&mut editor, &Action::UnlockAll);
    assert!(!editor.scene().bodies[0].locked && !editor.scene().lights[0].locked);
    let unhide = Action::SetHidden { item: item(ScenePart::Body(0)), hidden: false };
    assert!(matches!(gray(&mut editor, &unhide), ActionError::NothingToDo));
    for item in [ScenePart::Body(9), ScenePart::Material(0), ScenePart::Camera].map(item) {
        let error = gray(&mut editor, &Action::SetLocked { item, locked: true });
        assert!(matches!(error, ActionError::NoSuchItem));
    }
    editor.select_parts([ScenePart::Material(0)]);
    assert!(matches!(gray(&mut editor, &Action::ToggleHidden), ActionError::NothingSelected));
}

#[test]
fn lists_are_put_in_order() {
    let order = |editor: &catoptric_editor::Editor| names(editor).concat();
    let mut editor = selecting(bodies([3, 1]));
    act(&mut editor, &Action::MoveUp);
    assert_eq!(
        (order(&editor), selected(&editor)),
        ("badc".to_owned(), vec![ScenePart::Body(2), ScenePart::Body(0)])
    );
    act(&mut editor, &Action::MoveUp);
    assert_eq!(order(&editor), "bdac");
    assert!(matches!(gray(&mut editor, &Action::MoveUp), ActionError::NothingToDo));
    act(&mut editor, &Action::MoveDown);
    assert_eq!(order(&editor), "abdc");
    act(&mut editor, &Action::MoveToIndex(0));
    assert_eq!(order(&editor), "bdac");
    act(&mut editor, &Action::MoveToIndex(usize::MAX));
    assert_eq!(
        (order(&editor), selected(&editor)),
        ("acbd".to_owned(), vec![ScenePart::Body(3), ScenePart::Body(2)])
    );
    // Before the element that stands there now.
    act(&mut editor, &Action::MoveToIndex(1));
    assert_eq!(order(&editor), "abdc");
    assert!(matches!(gray(&mut editor, &Action::MoveToIndex(2)), ActionError::NothingToDo));
    editor.select_parts([ScenePart::Body(1), ScenePart::Light(0), ScenePart::Light(1)]);
    assert!(matches!(gray(&mut editor, &Action::MoveUp), ActionError::NothingToDo));
    editor.select_parts([ScenePart::Material(2)]);
    act(&mut editor, &Action::MoveToIndex(0));
    assert_eq!(editor.scene().materials[0].name, "spare");
    assert_eq!(selected(&editor), [ScenePart::Material(0)]);
    editor.select(Item::Camera);
    assert!(matches!(gray(&mut editor, &Action::MoveDown), ActionError::NothingSelected));
}

#[test]
fn selections_go_round() {
    let mut editor = editor();
    editor.change_body(1, label("x"), |body| body.hidden = true).unwrap();
    editor.change_body(2, label("x"), |body| body.locked = true).unwrap();
    editor.settle();
    let steps = editor.steps_done();
    let mut select = |action: Action| {
        assert!(editor.can(&action));
        editor.apply(action).unwrap();
        selected(&editor)
    };
    let (body, light) = (ScenePart::Body, ScenePart::Light);
    assert_eq!(select(Action::SelectAll), [light(1), light(0), body(3), body(0)]);
    assert_eq!(select(Action::SelectNone), []);
    assert_eq!(select(Action::SelectNext), [body(0)]);
    assert_eq!(select(Action::SelectNext), [body(2)]);
    assert_eq!(select(Action::SelectPrevious), [body(0)]);
    assert_eq!(select(Action::SelectPrevious), [light(1)]);
    assert_eq!(select(Action::SelectNext), [body(0)]);
    assert_eq!(select(Action::InvertSelection), [light(1), light(0), body(3)]);
    assert_eq!(select(Action::InvertSelection), [body(0)]);
    assert_eq!(editor.steps_done(), steps);
    editor.apply(Action::SelectAll).unwrap();
    gray(&mut editor, &Action::SelectAll);
    let mut empty = catoptric_editor::Editor::new(catoptric_scene::Scene::default());
    for action in [
        Action::SelectAll,
        Action::SelectNone,
        Action::SelectNext,
        Action::SelectPrevious,
        Action::Undo,
        Action::Redo,
    ] {
        assert!(matches!(gray(&mut empty, &action), ActionError::NothingToDo));
    }
}

#[test]
fn bodies_are_dropped_and_reset() {
    let mut editor = selecting(bodies([0, 1, 2]));
    editor
        .change_body(0, label("x"), |body| {
            body.shape = Shape::Cube { size: DVec3::ONE };
            body.placement.anchor =
                Anchor::Frame { position: DVec3::new(1.0, 5.0, 2.0), rotation_degrees: DVec3::Z * 45.0 };
            body.placement.scale = DVec3::splat(2.0);
        })
        .unwrap();
    editor
        .change_body(1, label("x"), |body| {
            body.shape = Shape::Cylinder { radius: 0.25, height: 1.0 };
            body.placement.anchor =
                Anchor::Axis { base: DVec3::new(3.0, -1.0, 0.0), top: DVec3::new(6.0, 3.0, 0.0) };
        })
        .unwrap();
    editor.change_body(2, label("x"), |body| body.locked = true).unwrap();
    act(&mut editor, &Action::DropToGround);
    let origin = |index: usize| editor.scene().bodies[index].placement.origin();
    assert!((origin(0) - DVec3::new(1.0, 2f64.sqrt(), 2.0)).length() < 1e-12);
    // The axis rises 4 in 5, so the disc's edge hangs 3/5 of the radius below its center.
    assert!((origin(1) - DVec3::new(3.0, 0.15, 0.0)).length() < 1e-12);
    assert_eq!(origin(2), DVec3::X * 6.0);
    assert!(matches!(gray(&mut editor, &Action::DropToGround), ActionError::NothingToDo));
    act(&mut editor, &Action::ResetPlacement);
    let scene = editor.scene();
    assert!((scene.bodies[0].placement.origin() - DVec3::new(1.0, 2f64.sqrt(), 2.0)).length() < 1e-12);
    for index in 0..2 {
        let body = &scene.bodies[index];
        assert_eq!(body.placement, Placement::at(body.placement.origin()));
    }
    let Shape::Cylinder { radius, height } = scene.bodies[1].shape else { panic!() };
    assert!(radius == 0.25 && (height - 5.0).abs() < 1e-12);
    assert!(matches!(gray(&mut editor, &Action::ResetPlacement), ActionError::NothingToDo));
    editor.select_parts([ScenePart::Body(2)]);
    assert!(matches!(gray(&mut editor, &Action::DropToGround), ActionError::Locked));
    editor.select_parts([ScenePart::Light(0)]);
    assert!(matches!(gray(&mut editor, &Action::ResetPlacement), ActionError::NothingSelected));
}
