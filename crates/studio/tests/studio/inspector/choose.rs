//! Everything that is chosen rather than measured.

use super::*;
use catoptric_scene::{Material, ScenePart, ShapeKind, SolidKind, SolidTexture};

#[test]
fn every_shape() {
    let mut window = with_body(Shape::CONE);
    let shapes = [
        ("Sphere", ShapeKind::Sphere),
        ("Cube", ShapeKind::Cube),
        ("Cylinder", ShapeKind::Cylinder),
        ("Plane", ShapeKind::Plane),
        ("Cone", ShapeKind::Cone),
    ];
    for (name, kind) in shapes {
        let before = scene(&window);
        click(&mut window, Role::ComboBox, "Shape");
        click(&mut window, Role::RadioButton, &format!("Shape: {name}"));
        assert_eq!(sphere_of(&scene(&window)).shape.kind(), kind);
        holds_as_step(&mut window, &before, "edit-shape");
    }
}

#[test]
fn every_kind_of_reflection_keeps_the_color() {
    let mut window = with_body(Shape::SPHERE);
    let color = own_material(sphere_of(&scene(&window))).pattern.color;
    type Case = (&'static str, fn(&Phong) -> bool);
    let cases: [Case; 4] = [
        ("Mirror", |m| m.reflection() > 0.8 && m.transmission == 0.0),
        ("Glass", |m| m.transmission > 0.5),
        ("Matte", |m| m.reflection() == 0.0 && m.specular == 0.0 && m.diffuse > 0.5),
        ("Glossy", |m| m.specular > 0.0 && m.diffuse > 0.5 && m.transmission == 0.0),
    ];
    for (name, is_it) in cases {
        let before = scene(&window);
        let label = format!("Kind of reflection: {name}");
        click(&mut window, Role::RadioButton, &label);
        let material = own_material(sphere_of(&scene(&window))).clone();
        assert!(is_it(&material), "{name}: {material:?}");
        assert_eq!(material.pattern.color, color);
        assert!(is_chosen(&window, &label), "{name}");
        holds_as_step(&mut window, &before, "edit-kind");
    }
    enter(&mut window, "k_t transmission", "0.3");
    assert!(is_chosen(&window, "Kind of reflection: Custom"));
}

fn is_chosen(window: &Window, name: &str) -> bool {
    let node = window.get_by_role_and_label(Role::RadioButton, name);
    node.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
}

#[test]
fn reflection_follows_the_highlight_or_not() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    click(&mut window, Role::CheckBox, "as the highlight");
    assert_eq!(own_material(sphere_of(&scene(&window))).reflection, None);
    holds_as_step(&mut window, &before, "edit-reflection");
    assert!(window.get_by_role_and_label(Role::SpinButton, "k_r reflection").accesskit_node().is_disabled());
    enter(&mut window, "k_s highlight", "0.4");
    let before = scene(&window);
    click(&mut window, Role::CheckBox, "as the highlight");
    assert_eq!(own_material(sphere_of(&scene(&window))).reflection, Some(0.4));
    holds_as_step(&mut window, &before, "edit-reflection");
}

#[test]
fn a_model_that_comes_back_has_its_numbers_again() {
    fn model(window: &mut Window, model: &str) -> Material {
        let before = scene(window);
        choose(window, "Model", model);
        holds_as_step(window, &before, "edit-model");
        let MaterialChoice::Inline(material) = sphere_of(&scene(window)).material.clone() else { panic!() };
        *material
    }
    let mut window = with_body(Shape::SPHERE);
    enter(&mut window, "k_d diffuse", "0.35");
    let phong = own_material(sphere_of(&scene(&window))).clone();
    let Material::Dielectric(clear) = model(&mut window, "Clear body") else { panic!() };
    assert_eq!(clear.index.ior(), phong.ior);
    click(&mut window, Role::CheckBox, "splits light");
    enter(&mut window, "η refraction", "1.7");
    assert_eq!(model(&mut window, "Phong, Whitted"), Phong { ior: 1.7, ..phong.clone() }.into());
    let Material::Dielectric(again) = model(&mut window, "Clear body") else { panic!() };
    assert!(again.dispersion && again.index.ior() == 1.7);
}

#[test]
fn the_pattern_is_chosen() {
    let mut window = with_body(Shape::SPHERE);
    let solid = |window: &Window| own_material(sphere_of(&scene(window))).pattern.solid.clone();
    let before = scene(&window);
    choose(&mut window, "Pattern", "Rings");
    assert_eq!(solid(&window).unwrap().kind, SolidKind::Rings);
    holds_as_step(&mut window, &before, "edit-pattern");
    enter(&mut window, "s cell size", "0.25");
    // What the other has too stays.
    choose(&mut window, "Pattern", "Gradient");
    let gradient = SolidTexture { kind: SolidKind::Gradient, size: 0.25, ..SolidTexture::default() };
    assert_eq!(solid(&window), Some(gradient));
    let before = scene(&window);
    choose(&mut window, "Pattern", "none");
    assert_eq!(solid(&window), None);
    holds_as_step(&mut window, &before, "edit-pattern");
}

#[test]
fn a_medium_sets_the_index_of_refraction() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    click(&mut window, Role::ComboBox, "Medium");
    window.get_by_label_contains("Diamond").click();
    window.run_steps(4);
    assert_eq!(own_material(sphere_of(&scene(&window))).ior, 2.42);
    holds_as_step(&mut window, &before, "edit-ior");
}

#[test]
fn every_law_of_falloff() {
    let mut window = window("four-bodies", ScenePart::Light(0));
    let laws = [
        ("linear", Falloff::Linear { constant: 1.0 }),
        ("inverse square", Falloff::InverseSquare),
        ("none", Falloff::None),
    ];
    for (name, falloff) in laws {
        let before = scene(&window);
        click(&mut window, Role::RadioButton, &format!("Falloff: {name}"));
        assert_eq!(scene(&window).lights[0].falloff, falloff);
        holds_as_step(&mut window, &before, "edit-falloff");
    }
}

#[test]
fn the_projection() {
    let mut window = window("four-bodies", ScenePart::Camera);
    for name in ["Parallel", "Perspective"] {
        let before = scene(&window);
        click(&mut window, Role::RadioButton, &format!("Projection: {name}"));
        let is_parallel = matches!(scene(&window).camera.projection, Projection::Parallel { .. });
        assert_eq!(is_parallel, name == "Parallel");
        holds_as_step(&mut window, &before, "edit-projection");
    }
}

#[test]
fn a_material_is_shared_made_own_and_chosen() {
    let mut window = window("four-bodies", None);
    let item = body(&window, "sphere");
    select(&mut window, [item]);
    click(&mut window, Role::Button, "Make unique");
    let red = own_material(sphere_of(&scene(&window))).clone();
    click(&mut window, Role::Button, "Share");
    let choice = sphere_of(&scene(&window)).material.clone();
    assert!(matches!(choice, MaterialChoice::Named(_)));
    assert_eq!(scene(&window).material(&choice), Some(&red.into()));
    click(&mut window, Role::ComboBox, "Material of the body");
    window.get_all_by_label("floor").last().unwrap().click();
    window.run_steps(4);
    assert_eq!(sphere_of(&scene(&window)).material, MaterialChoice::Named("floor".to_owned()));
    window.get_by_label("2 bodies use this material.");
}

#[test]
fn names_are_typed() {
    let mut window = window("four-bodies", None);
    for (item, new) in
        [(body(&window, "cube"), "die"), (ScenePart::Light(0), "sun"), (ScenePart::Material(0), "ground")]
    {
        select(&mut window, [item]);
        let before = scene(&window);
        window.get_by_role_and_label(Role::TextInput, "Name").click();
        window.run_steps(2);
        window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        window.event(Event::Text(new.to_owned()));
        window.run_steps(2);
        window.key_press(Key::Enter);
        window.run_steps(3);
        assert_eq!(item.name(&scene(&window)), new);
        let editor = window.state_mut().editor_mut();
        editor.undo();
        assert_eq!(*editor.scene(), before);
        editor.redo();
        assert_eq!(item.name(editor.scene()), new);
    }
}

#[test]
fn a_typed_name_is_taken_by_what_it_was_typed_for() {
    let cube = body(&window("four-bodies", None), "cube");
    let mut window = window("four-bodies", cube);
    window.get_by_role_and_label(Role::TextInput, "Name").click();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    window.event(Event::Text("die".to_owned()));
    window.run_steps(2);
    let pos = window.get_by_role_and_label(Role::TreeItem, "cone").rect().center();
    let button = egui::PointerButton::Primary;
    window.hover_at(pos);
    window.step();
    for pressed in [true, false] {
        let modifiers = egui::Modifiers::NONE;
        window.event(Event::PointerButton { pos, button, pressed, modifiers });
        window.step();
    }
    window.run_steps(3);
    let cone = body(&window, "cone");
    assert_eq!(window.state().editor().primary_part(), Some(cone));
    assert_eq!(cube.name(&scene(&window)), "die");
    select(&mut window, [cube]);
    select(&mut window, [cone]);
    assert_eq!(window.state().editor().steps().len(), 1);
}

#[test]
fn bodies_and_lights_are_hidden_and_locked() {
    let mut window = window("four-bodies", None);
    for item in [body(&window, "cone"), ScenePart::Light(1)] {
        select(&mut window, [item]);
        click(&mut window, Role::Button, "Hidden");
        assert!(item.is_hidden(&scene(&window)));
        click(&mut window, Role::Button, "Hidden");
        assert!(!item.is_hidden(&scene(&window)));
        click(&mut window, Role::Button, "Locked");
        assert!(item.is_locked(&scene(&window)));
        let field = window.get_by_role_and_label(Role::SpinButton, "Position X");
        assert!(field.accesskit_node().is_disabled());
        window.get_by_label("Locked: its values cannot be changed.");
        click(&mut window, Role::Button, "Unlock");
        assert!(!item.is_locked(&scene(&window)));
        let field = window.get_by_role_and_label(Role::SpinButton, "Position X");
        assert!(!field.accesskit_node().is_disabled());
    }
}

#[test]
fn sections_are_folded_and_stay_so() {
    let mut window = window("four-bodies", None);
    let (sphere, cone) = (body(&window, "sphere"), body(&window, "cone"));
    select(&mut window, [sphere]);
    click(&mut window, Role::DisclosureTriangle, "Place");
    window.run_steps(20);
    assert!(window.query_by_label("Position X").is_none());
    select(&mut window, [cone]);
    assert!(window.query_by_label("Position X").is_none());
    click(&mut window, Role::DisclosureTriangle, "Place");
    window.run_steps(20);
    assert!(window.query_by_label("Position X").is_some());
}

#[test]
fn the_list_of_shapes_is_walked_by_keys() {
    let mut window = with_body(Shape::SPHERE);
    let list = |window: &Window| {
        let node = window.get_by_role_and_label(Role::ComboBox, "Shape");
        (node.accesskit_node().value().unwrap_or_default(), node.is_focused())
    };
    let press = |window: &mut Window, key| {
        window.key_press(key);
        window.run_steps(3);
    };
    let at = |window: &Window, name: &str| {
        window.get_by_role_and_label(Role::RadioButton, &format!("Shape: {name}")).is_focused()
    };
    window.get_by_role_and_label(Role::ComboBox, "Shape").focus();
    window.run_steps(2);
    assert_eq!(list(&window), ("Sphere".to_owned(), true));
    press(&mut window, Key::Space);
    assert!(at(&window, "Sphere") && is_chosen(&window, "Shape: Sphere"), "it opens at what is chosen");
    // Rows of two; heads are passed.
    for (key, name) in [
        (Key::ArrowRight, "Cube"),
        (Key::ArrowDown, "Cone"),
        (Key::End, "Triangle"),
        (Key::ArrowDown, "Triangle"),
        (Key::ArrowUp, "Disc"),
        (Key::Home, "Sphere"),
        (Key::ArrowLeft, "Sphere"),
        (Key::ArrowDown, "Cylinder"),
    ] {
        press(&mut window, key);
        assert!(at(&window, name), "{key:?} to {name}");
    }
    press(&mut window, Key::Escape);
    assert_eq!(list(&window), ("Sphere".to_owned(), true), "the keys are back at the list");
    assert!(window.query_by_role_and_label(Role::RadioButton, "Shape: Cone").is_none());
    press(&mut window, Key::Enter);
    press(&mut window, Key::ArrowRight);
    press(&mut window, Key::Enter);
    assert_eq!(sphere_of(&scene(&window)).shape.kind(), ShapeKind::Cube);
    assert_eq!(list(&window), ("Cube".to_owned(), true));
}
