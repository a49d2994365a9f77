//! Known answers of joining bodies and taking them apart.

use catoptric_editor::{Action, ActionError, Editor, Label, NewBodyPlacement, bounds};
use catoptric_scene::{Anchor, Body, MaterialChoice, Placement, Scene, ScenePart, Shape, ShapeKind};
use glam::{DAffine3, DVec3};

use crate::common::{act, bodies, gray, names, refuse, selected, selecting};

fn join(shape: ShapeKind) -> Action {
    Action::Join { shape, name: String::new() }
}

/// The simple parts of all bodies in the world: shape, frame, name of the material.
fn pieces(scene: &Scene) -> Vec<(Shape, DAffine3, Option<String>)> {
    let mut found = Vec::new();
    for body in &scene.bodies {
        body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
            let material = part.material.unwrap_or(&body.material).name().map(str::to_owned);
            found.push((part.shape, part.frame, material));
        });
    }
    found.sort_by(|a, b| a.1.translation.x.total_cmp(&b.1.translation.x));
    found
}

fn assert_same_pieces(one: &Scene, other: &Scene) {
    let (one, other) = (pieces(one), pieces(other));
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(&other) {
        assert_eq!(a.2, b.2);
        assert!(a.1.abs_diff_eq(b.1, 1e-9), "{a:?} is not {b:?}");
    }
}

#[test]
fn joined_bodies_stay_where_they_are_and_come_apart_again() {
    for shape in [ShapeKind::Union, ShapeKind::Intersection, ShapeKind::Difference, ShapeKind::Group] {
        // Chosen in another order than that of the scene.
        let mut editor = selecting(bodies([2, 0]));
        let before = editor.scene().clone();
        act(&mut editor, &join(shape));
        assert_eq!(names(&editor), ["b", shape.key(), "d"]);
        assert_eq!(selected(&editor), [ScenePart::Body(1)]);
        assert_same_pieces(&before, editor.scene());
        let whole = &editor.scene().bodies[1];
        assert_eq!((whole.shape, whole.placement), (shape.shape(), Placement::at(DVec3::X * 6.0)));
        assert_eq!(whole.material, MaterialChoice::Named("blue".to_owned()));
        let parts: Vec<_> =
            whole.parts.iter().map(|part| (part.name.as_str(), part.material.is_some())).collect();
        assert_eq!(parts, [("c", false), ("a", true)]);
        assert_eq!(editor.undo_label().unwrap().subject, shape.key());
        act(&mut editor, &Action::TakeApart);
        assert_eq!(names(&editor), ["b", "c", "a", "d"]);
        assert_eq!(selected(&editor), [ScenePart::Body(1), ScenePart::Body(2)]);
        assert_same_pieces(&before, editor.scene());
        editor.apply(Action::Undo).unwrap();
        editor.apply(Action::Undo).unwrap();
        assert_eq!(editor.scene(), &before);
        assert!(editor.edited().scene().check().is_empty());
    }
}

#[test]
fn parts_keep_their_frames_where_the_whole_is_turned_and_stretched() {
    let anchor = |x: f64, turn: DVec3| Anchor::Frame { position: DVec3::X * x, rotation_degrees: turn };
    let mut editor = selecting(bodies([0, 1, 2]));
    let turned =
        Placement { anchor: anchor(3.0, DVec3::new(10.0, 20.0, 30.0)), scale: DVec3::new(1.0, 2.0, 3.0) };
    let rod = Anchor::Axis { base: DVec3::new(6.0, 1.0, 0.0), top: DVec3::new(7.0, 3.0, 1.0) };
    editor.change_body(1, crate::common::label("edit-a"), |body| body.placement = turned).unwrap();
    let rod_of = |body: &mut Body| {
        body.shape = Shape::Cylinder { radius: 0.25, height: 1.0 };
        body.placement.anchor = rod;
    };
    editor.change_body(2, crate::common::label("edit-b"), rod_of).unwrap();
    act(&mut editor, &join(ShapeKind::Union));
    let whole = Placement { anchor: anchor(1.0, DVec3::new(-40.0, 0.0, 80.0)), scale: DVec3::splat(2.0) };
    editor.change_body(0, crate::common::label("edit-c"), |body| body.placement = whole).unwrap();
    let before = editor.scene().clone();
    act(&mut editor, &Action::TakeApart);
    assert_eq!(names(&editor), ["a", "b", "c", "d"]);
    // A round body may stand turned about its axis.
    for ((shape, frame, _), (other, own, _)) in pieces(&before).iter().zip(&pieces(editor.scene())) {
        assert_eq!(shape.kind(), other.kind());
        assert!((frame.translation - own.translation).length() < 1e-9);
        for direction in [DVec3::X, DVec3::Y, DVec3::NEG_Z, DVec3::ONE] {
            let reach = |shape: &Shape, frame: &DAffine3| {
                shape.support(frame.matrix3.transpose() * direction).unwrap()
            };
            assert!((reach(shape, frame) - reach(other, own)).abs() < 1e-8);
        }
    }
}

#[test]
fn what_would_be_sheared_stays_a_part() {
    let mut editor = selecting(bodies([0, 1]));
    let leaning = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::Z * 45.0 };
    let cube = |body: &mut Body| {
        body.shape = Shape::CUBE;
        body.placement.anchor = leaning;
    };
    editor.change_body(1, crate::common::label("edit-a"), cube).unwrap();
    act(&mut editor, &join(ShapeKind::Union));
    let stretch = |body: &mut Body| body.placement.scale = DVec3::new(1.0, 2.0, 1.0);
    editor.change_body(0, crate::common::label("edit-b"), stretch).unwrap();
    editor.settle();
    let error = refuse(&mut editor, &Action::TakeApart);
    assert!(matches!(&error, ActionError::Sheared { name } if name == "b"), "{error}");
}

#[test]
fn joining_takes_two_bodies_and_taking_apart_one_of_parts() {
    let mut editor = selecting(bodies([0]));
    assert!(matches!(gray(&mut editor, &join(ShapeKind::Union)), ActionError::OneBody));
    assert!(matches!(gray(&mut editor, &Action::TakeApart), ActionError::NothingToDo));
    editor.select_parts([ScenePart::Light(0)]);
    assert!(matches!(gray(&mut editor, &join(ShapeKind::Union)), ActionError::NothingSelected));
    editor.select_parts(bodies([0, 1]));
    assert!(matches!(gray(&mut editor, &join(ShapeKind::Sphere)), ActionError::NothingSelected));
    act(&mut editor, &Action::ToggleLocked);
    assert!(matches!(gray(&mut editor, &join(ShapeKind::Union)), ActionError::Locked));
    let body = Action::AddBody {
        shape: ShapeKind::Union,
        placement: NewBodyPlacement::at(DVec3::ZERO),
        name: String::new(),
    };
    assert!(matches!(gray(&mut editor, &body), ActionError::NothingToDo));
}

#[test]
fn materials_of_parts_follow_names_and_count_as_used() {
    let mut editor = selecting(bodies([0, 2]));
    act(&mut editor, &join(ShapeKind::Group));
    let blue = editor.edited().item(ScenePart::Material(1)).unwrap();
    act(&mut editor, &Action::Rename { item: blue, name: "sky".to_owned() });
    assert!(editor.scene().bodies[0].uses_material("sky") && editor.scene().check().is_empty());
    let text = editor.copy().unwrap();
    assert!(text.contains("[materials.sky]"), "{text}");
    act(&mut editor, &Action::RemoveUnusedMaterials);
    assert_eq!(editor.scene().materials.len(), 2);
    act(&mut editor, &Action::Paste(text));
    assert!(editor.scene().bodies.last().unwrap().uses_material("sky"));
    editor.select_parts([ScenePart::Material(1)]);
    act(&mut editor, &Action::Delete);
    assert!(!editor.scene().bodies[0].uses_material("sky") && editor.scene().check().is_empty());
}

#[test]
fn bounds_of_joined_bodies_hold_them() {
    let joined = |shape: ShapeKind, gap: f64| {
        let mut scene = crate::common::scene();
        scene.bodies[1].placement = Placement::at(DVec3::X * gap);
        let mut editor = Editor::new(scene);
        editor.select_parts(bodies([0, 1]));
        act(&mut editor, &join(shape));
        let found = bounds::of_body(&editor.scene().bodies[0]).unwrap();
        (found.min.x, found.max.x)
    };
    assert_eq!(joined(ShapeKind::Union, 1.0), (-1.0, 2.0));
    assert_eq!(joined(ShapeKind::Group, 1.0), (-1.0, 2.0));
    assert_eq!(joined(ShapeKind::Intersection, 1.0), (0.0, 1.0));
    assert_eq!(joined(ShapeKind::Difference, 1.0), (-1.0, 1.0));
    // What holds nothing is a point.
    assert_eq!(joined(ShapeKind::Intersection, 5.0), (0.0, 0.0));
}

#[test]
fn a_lens_is_added_copied_changed_and_taken_apart() {
    let mut editor = Editor::new(Scene::default());
    for shape in ShapeKind::PARAMETRIC {
        let placement = NewBodyPlacement { size: 2.0, ..NewBodyPlacement::at(DVec3::Y) };
        act(&mut editor, &Action::AddBody { shape, placement, name: String::new() });
        let body = &editor.scene().bodies[editor.scene().bodies.len() - 1];
        assert_eq!((body.body_shape().kind(), body.name.as_str()), (shape, shape.key()));
        let bottom = bounds::of_body(body).unwrap().min.y;
        assert!((bottom - 1.0).abs() < 1e-12, "{shape:?} stands at {bottom}");
    }
    editor.select_parts([ScenePart::Body(0)]);
    act(&mut editor, &Action::Duplicate);
    let lens = |editor: &Editor, index: usize| editor.scene().bodies[index].body_shape();
    assert_eq!(lens(&editor, 0), lens(&editor, editor.scene().bodies.len() - 1));
    let before = lens(&editor, 0);
    let change = |body: &mut Body| body.change_shape(|shape| shape.set_number("focal_length", 4.0));
    assert_eq!(editor.change_body(0, Label::new("edit-focal-length", "lens"), change), Ok(true));
    assert!(editor.settle());
    assert_eq!(lens(&editor, 0).number("focal_length"), Some(4.0));
    assert!(editor.undo());
    assert_eq!(lens(&editor, 0), before);
    editor.select_parts([ScenePart::Body(0)]);
    let count = editor.scene().bodies[0].parts.len();
    act(&mut editor, &Action::TakeApart);
    let kinds: Vec<ShapeKind> =
        editor.scene().bodies.iter().take(count).map(|body| body.body_shape().kind()).collect();
    assert_eq!(kinds, [ShapeKind::Cylinder, ShapeKind::Sphere, ShapeKind::Sphere]);
}
