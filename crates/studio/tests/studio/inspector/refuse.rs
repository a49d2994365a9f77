//! What is typed wrongly, and what the scene would not be.

use super::*;
use crate::kit::item_at;
use catoptric_scene::ScenePart;

#[test]
fn a_radius_that_cannot_be_leaves_the_scene_and_says_why() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    for (text, why) in [
        ("-5", "It must be above 0 and at most 1e9"),
        ("0", "It must be above 0"),
        ("2e9", "It must be above 0"),
        ("abc", "That is not a number"),
        ("nan", "That is not a number"),
        ("1e999", "That is not a number"),
    ] {
        enter(&mut window, "Radius", text);
        assert_eq!(scene(&window), before, "{text}");
        assert!(window.query_by_label_contains(why).is_some(), "{text}: {why}");
    }
    enter(&mut window, "Radius", "1e9");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius: 1e9 });
    assert!(window.query_by_label_contains("It must be above 0").is_none());
    assert_eq!(scene(&window).check(), []);
}

#[test]
fn numbers_are_read_as_people_write_them() {
    let mut window = with_body(Shape::SPHERE);
    for (text, radius) in [("0,75", 0.75), ("1.5 m", 1.5), ("1 000", 1000.0), ("2.5e-3", 0.0025)] {
        enter(&mut window, "Radius", text);
        assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius }, "{text}");
    }
}

#[test]
fn arithmetic_and_units_are_computed() {
    let mut window = with_body(Shape::SPHERE);
    for (text, radius) in [
        ("0.1*3", 0.3),
        ("1/3", 1.0 / 3.0),
        ("(1 + 2)*2", 6.0),
        ("2^3", 8.0),
        ("sqrt(2)", std::f64::consts::SQRT_2),
        ("pi", std::f64::consts::PI),
        ("50 cm", 0.5),
        ("1500мм", 1.5),
        ("1 m + 20 cm", 1.2),
        ("1/4 m", 0.25),
        ("0,1*3", 0.3),
    ] {
        let before = scene(&window);
        enter(&mut window, "Radius", text);
        assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius }, "{text}");
        holds_as_step(&mut window, &before, "edit-radius");
    }
    // Narrow fields, and those beside a slider.
    enter(&mut window, "Rotation Y", "90/4");
    enter(&mut window, "Position X", "-3 m/4");
    enter(&mut window, "k_d diffuse", "1/4");
    let after = scene(&window);
    let Anchor::Frame { position, rotation_degrees } = sphere_of(&after).placement.anchor else { panic!() };
    assert_eq!((position.x, rotation_degrees.y), (-0.75, 22.5));
    assert_eq!(own_material(sphere_of(&after)).diffuse, 0.25);
}

#[test]
fn a_refused_text_changes_nothing_and_waits_to_be_corrected() {
    let value = |window: &Window| window.get_by_role_and_label(Role::SpinButton, "Radius").value();
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    let steps = window.state().editor().steps().len();
    for (text, why) in [
        ("0.5abc", "“abc” (character 4)"),
        ("0.5 0.6", "before “0.6” (character 5)"),
        ("2*", "missing at character 3"),
        ("(1 + 2", "“(” (character 1)"),
        ("1/0", "no finite value"),
        ("45°", "units in “45°”"),
        ("1,500", "the comma in “1,500”"),
    ] {
        enter(&mut window, "Radius", text);
        assert_eq!(scene(&window), before, "{text}");
        assert_eq!(window.state().editor().steps().len(), steps, "{text}");
        assert_eq!(value(&window).as_deref(), Some(text), "the text stays");
        assert!(window.query_by_label_contains(why).is_some(), "{text}: {why}");
        window.get_by_label_contains("m, cm, mm, km");
    }
    // What is corrected is taken, and the message goes.
    enter(&mut window, "Radius", "0.75");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius: 0.75 });
    assert!(window.query_by_label_contains("not a number").is_none());
    let before = scene(&window);
    enter(&mut window, "Radius", "abc");
    click(&mut window, Role::SpinButton, "Radius");
    assert_eq!(value(&window).as_deref(), Some("abc"), "it is there again to be corrected");
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert_eq!(value(&window).as_deref(), Some("0.75 m"));
    assert!(window.query_by_label_contains("not a number").is_none(), "given up");
    assert_eq!(scene(&window), before);
}

#[test]
fn a_refused_component_leaves_the_others() {
    let mut window = with_body(Shape::SPHERE);
    enter(&mut window, "Position X", "2");
    let before = scene(&window);
    enter(&mut window, "Position Y", "7abc");
    assert_eq!(scene(&window), before);
    // All three factors of a linked scale come back.
    enter(&mut window, "Scale X", "3abc");
    assert_eq!(scene(&window), before);
    // From one field straight into the next, which is then refused.
    type_into(&mut window, "Position X", "5");
    type_into(&mut window, "Position Y", "6x");
    window.key_press(Key::Enter);
    window.run_steps(3);
    let Anchor::Frame { position, .. } = sphere_of(&scene(&window)).placement.anchor else { panic!() };
    assert_eq!((position.x, position.y), (5.0, 1.0));
}

#[test]
fn whole_numbers_stay_whole() {
    let mut window = window("four-bodies", ScenePart::Tracing);
    let before = scene(&window);
    enter(&mut window, "Generations", "2.5");
    assert_eq!(scene(&window), before);
    window.get_by_label_contains("Only whole numbers");
    enter(&mut window, "Generations", "3*4");
    assert_eq!(scene(&window).tracing.generations, 12);
}

#[test]
fn russian_numbers_have_a_comma() {
    let mut window = window_in("russian", "four-bodies", None);
    let sphere = body(&window, "sphere");
    select(&mut window, [sphere]);
    let texts = |window: &Window, key: &str| window.state().texts().get(key).to_owned();
    let name = texts(&window, "radius");
    enter(&mut window, &name, "0.75");
    assert_eq!(window.get_by_role_and_label(Role::SpinButton, &name).value().as_deref(), Some("0,75 м"));
    enter(&mut window, &name, "1,500");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius: 1.5 });
    enter(&mut window, &name, "50 см");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius: 0.5 });
    enter(&mut window, &name, "5 аршин");
    window.get_by_label_contains("«аршин» (знак 3)");
    // No number of the window has a point: neither in the panel nor in the bars.
    let mut pointed = Vec::new();
    for node in window.query_all_by(|_| true) {
        let node = node.accesskit_node();
        for text in [node.label(), node.value()].into_iter().flatten() {
            let letters: Vec<char> = text.chars().collect();
            let is_decimal =
                |part: &[char]| part[0].is_ascii_digit() && part[1] == '.' && part[2].is_ascii_digit();
            if letters.windows(3).any(is_decimal) {
                pointed.push(text);
            }
        }
    }
    assert_eq!(pointed, Vec::<String>::new());
}

#[test]
fn a_camera_that_sees_nothing_is_refused() {
    let mut window = window("four-bodies", ScenePart::Camera);
    for (axis, text) in [("X", "0"), ("Y", "0"), ("Z", "0")] {
        enter(&mut window, &format!("Up {axis}"), text);
    }
    assert_eq!(scene(&window).camera.up, DVec3::Y);
    window.get_by_label_contains("must not point along the view");
    enter(&mut window, "Up X", "1");
    assert!(window.query_by_label_contains("must not point along the view").is_none());
    assert_eq!(scene(&window).check(), []);
}

#[test]
fn a_locked_body_is_left_alone() {
    let mut window = window("four-bodies", None);
    let cube = body(&window, "cube");
    let item = item_at(window.state(), cube);
    window.state_mut().editor_mut().apply(Action::SetLocked { item, locked: true }).unwrap();
    select(&mut window, [cube]);
    let before = scene(&window);
    for name in ["Size X", "Position Y", "k_d diffuse"] {
        let node = window.get_by_role_and_label(Role::SpinButton, name);
        assert!(node.accesskit_node().is_disabled(), "{name}");
        node.set_value_accesskit(0.5);
        window.run_steps(2);
    }
    click(&mut window, Role::ComboBox, "Shape");
    assert!(window.query_by_role_and_label(Role::RadioButton, "Shape: Sphere").is_none());
    assert_eq!(scene(&window), before);
}
