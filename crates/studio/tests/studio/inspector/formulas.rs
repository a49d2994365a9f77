//! The formula beside the material.

use super::*;
use catoptric_scene::ScenePart;

fn is_lit(window: &Window, name: &str) -> bool {
    let node = window.get_by_label(name);
    node.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
}

#[test]
fn the_formula_has_the_present_numbers() {
    let mut window = with_body(Shape::SPHERE);
    for (field, text) in [("k_a ambient", "0.17"), ("k_d diffuse", "0.62"), ("k_s highlight", "0.28")] {
        enter(&mut window, field, text);
    }
    enter(&mut window, "n shininess", "77");
    enter(&mut window, "k_r reflection", "0.11");
    enter(&mut window, "k_t transmission", "0.23");
    for name in [
        "Ambient term: 0.17",
        "Ambient term: (0.8, 0.1, 0.06)",
        "Diffuse term: 0.62",
        "Highlight term: 0.28",
        "Highlight term: ^77",
        "Reflection term: 0.11",
        "Transmission term: 0.23",
        "Law of refraction: 1.5",
    ] {
        assert!(window.query_by_label(name).is_some(), "{name}");
    }
}

#[test]
fn rows_light_the_formula_and_the_formula_lights_rows() {
    let mut window = with_body(Shape::SPHERE);
    assert!(!is_lit(&window, "Diffuse term: k_d"));
    window.get_by_role_and_label(Role::Slider, "k_d diffuse: slider").hover();
    window.run_steps(3);
    assert!(is_lit(&window, "Diffuse term: k_d") && is_lit(&window, "Diffuse term: 0.85"));
    assert!(!is_lit(&window, "Ambient term: k_a"));
    window.get_by_label("Highlight term: k_s").hover();
    window.run_steps(3);
    assert!(is_lit(&window, "Highlight term: k_s") && !is_lit(&window, "Diffuse term: k_d"));
    // The color stands in two terms.
    window.get_by_role_and_label(Role::ColorWell, "C color").hover();
    window.run_steps(3);
    assert!(is_lit(&window, "Ambient term: C") && is_lit(&window, "Diffuse term: C"));
}

#[test]
fn terms_explain_themselves() {
    let mut window = with_body(Shape::SPHERE);
    window.get_all_by_label("Diffuse term: (n · L_j)").next().unwrap().hover();
    window.run_steps(60);
    window.get_by_label_contains("The cosine between the normal");
}

#[test]
fn a_surface_that_makes_light_is_told_of() {
    let mut window = with_body(Shape::SPHERE);
    // Of a gray of 0.8.
    enter(&mut window, "k_d diffuse", "0.75");
    enter(&mut window, "k_r reflection", "0.4");
    assert!(window.query_by_label_contains("Sends out more light").is_none(), "just all of it");
    enter(&mut window, "k_t transmission", "0.3");
    window.get_by_label(
        "Sends out more light than it receives: 0.6\u{a0}+\u{a0}0.4\u{a0}+\u{a0}0.3\u{a0}=\u{a0}1.3",
    );
}

#[test]
fn the_law_of_a_light_has_its_numbers() {
    let mut window = window("falloff", None);
    let scene = scene(&window);
    for (index, light) in scene.lights.iter().enumerate() {
        select(&mut window, [ScenePart::Light(index)]);
        let name = format!("Light sent: {}", light.intensity);
        assert!(window.query_by_label(&name).is_some(), "{name}");
    }
    let linear = scene.lights.iter().position(|light| matches!(light.falloff, Falloff::Linear { .. }));
    select(&mut window, linear.map(ScenePart::Light));
    enter(&mut window, "K constant", "3");
    window.get_by_label("Light sent: 3");
    window.get_by_label_contains("A(1 m) = 0.25");
}

#[test]
fn every_panel_speaks_both_languages() {
    for language in ["english", "russian"] {
        let mut window = window_in(language, "still-life", None);
        let scene = scene(&window);
        let mut items: Vec<Option<ScenePart>> =
            vec![None, Some(ScenePart::Camera), Some(ScenePart::Environment), Some(ScenePart::Tracing)];
        items.extend((0..scene.bodies.len()).map(|index| Some(ScenePart::Body(index))));
        items.extend((0..scene.lights.len()).map(|index| Some(ScenePart::Light(index))));
        items.extend((0..scene.materials.len()).map(|index| Some(ScenePart::Material(index))));
        for item in items {
            select(&mut window, item);
        }
        let all: Vec<ScenePart> = (0..scene.bodies.len()).map(ScenePart::Body).collect();
        select(&mut window, all);
        assert_eq!(own_missing(&window), Vec::<String>::new());
    }
}

#[test]
fn a_narrow_panel_can_be_used() {
    let mut window = with_body(Shape::CUBE);
    choose(&mut window, "Pattern", "Checker");
    for width in [500.0, 200.0, 60.0] {
        window.set_size(vec2(width, 600.0));
        for item in [
            body(&window, "sphere"),
            ScenePart::Light(0),
            ScenePart::Camera,
            ScenePart::Environment,
            ScenePart::Material(0),
        ] {
            select(&mut window, [item]);
        }
    }
    window.set_size(vec2(1280.0, 1700.0));
    let sphere = body(&window, "sphere");
    select(&mut window, [sphere]);
    enter(&mut window, "Size X", "3");
}
