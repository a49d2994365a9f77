//! What is typed wrongly, and what the scene would not be.

use super::*;

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
fn a_camera_that_sees_nothing_is_refused() {
    let mut window = window("four-bodies", Item::Camera);
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
    let item = body(&window, "cube");
    window.state_mut().editor_mut().apply(Action::SetLocked { item, locked: true }).unwrap();
    select(&mut window, [item]);
    let before = scene(&window);
    for name in ["Size X", "Position Y", "k_d diffuse"] {
        let node = window.get_by_role_and_label(Role::SpinButton, name);
        assert!(node.accesskit_node().is_disabled(), "{name}");
        node.set_value_accesskit(0.5);
        window.run_steps(2);
    }
    click(&mut window, Role::RadioButton, "Shape: Sphere");
    assert_eq!(scene(&window), before);
}
