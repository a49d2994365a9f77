//! Colors: by code, by the picker, and brighter than white.

use super::*;
use catoptric_scene::ScenePart;

/// Types `text` into the code of the color called `name`.
fn enter_code(window: &mut Window, name: &str, text: &str) {
    window.get_by_role_and_label(Role::TextInput, &format!("{name}: code")).click();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    window.event(Event::Text(text.to_owned()));
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
}

#[test]
fn every_color_by_its_code() {
    let orange = Color::from_srgb8([0xff, 0x80, 0x10]);
    let mut window = with_body(Shape::SPHERE);
    choose(&mut window, "Pattern", "Checker");
    type Case = (&'static str, &'static str, fn(&Phong) -> Color);
    let cases: [Case; 3] = [
        ("C color", "edit-color", |m| m.pattern.color),
        ("τ tint", "edit-tint", |m| m.tint),
        ("Second color", "edit-pattern-color", |m| m.pattern.solid.as_ref().unwrap().color),
    ];
    for (name, step, get) in cases {
        let before = scene(&window);
        enter_code(&mut window, name, "#ff8010");
        assert_eq!(get(own_material(sphere_of(&scene(&window)))), orange, "{name}");
        holds_as_step(&mut window, &before, step);
    }

    select(&mut window, [ScenePart::Light(0)]);
    let before = scene(&window);
    enter_code(&mut window, "Color", "ff8010");
    assert_eq!(scene(&window).lights[0].color, orange);
    holds_as_step(&mut window, &before, "edit-color");

    select(&mut window, [ScenePart::Environment]);
    let before = scene(&window);
    enter_code(&mut window, "Background", "#ff8010");
    assert_eq!(scene(&window).environment.background, orange);
    holds_as_step(&mut window, &before, "edit-background");
    let before = scene(&window);
    enter_code(&mut window, "I_a ambient light", "#ff8010");
    assert_eq!(scene(&window).environment.ambient, orange);
    holds_as_step(&mut window, &before, "edit-ambient-light");
    click(&mut window, Role::Button, "Reset: I_a ambient light");
    assert_eq!(scene(&window).environment.ambient, Color::WHITE);
}

#[test]
fn no_code_no_change() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    for text in ["orange", "#12", ""] {
        enter_code(&mut window, "C color", text);
        assert_eq!(scene(&window), before, "{text}");
        window.get_by_label_contains("A color is written as #");
    }
    enter_code(&mut window, "C color", "#000000");
    assert_eq!(own_material(sphere_of(&scene(&window))).pattern.color, Color::BLACK);
    assert!(window.query_by_label_contains("A color is written as #").is_none());
}

#[test]
fn the_picker_changes_the_color_while_it_is_dragged() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    click(&mut window, Role::ColorWell, "C color");
    let square = window.get_by_label("C color: saturation and brightness").rect();
    let color = |window: &Window| own_material(sphere_of(&scene(window))).pattern.color;
    window.hover_at(square.center());
    window.run_steps(2);
    window.drag_at(square.center());
    window.run_steps(2);
    let first = color(&window);
    window.hover_at(square.right_top());
    window.run_steps(2);
    let Color { r, g, b } = color(&window);
    assert!(first != before.material(&sphere_of(&before).material).unwrap().pattern().unwrap().color);
    assert!(r == 1.0 && g < 0.2 && b < 0.2, "full red: {r} {g} {b}");
    window.drop_at(square.right_top());
    window.run_steps(3);
    holds_as_step(&mut window, &before, "edit-color");
    let before = scene(&window);
    let strip = window.get_by_label("C color: hue").rect();
    window.hover_at(strip.lerp_inside(vec2(0.333, 0.5)));
    window.run_steps(2);
    window.drag_at(strip.lerp_inside(vec2(0.333, 0.5)));
    window.run_steps(2);
    window.drop_at(strip.lerp_inside(vec2(0.333, 0.5)));
    window.run_steps(3);
    let Color { r, g, b } = color(&window);
    assert!(g == 1.0 && r < 0.1 && b < 0.1, "green: {r} {g} {b}");
    holds_as_step(&mut window, &before, "edit-color");
}

#[test]
fn light_can_be_brighter_than_white() {
    let mut window = window("four-bodies", ScenePart::Environment);
    let before = scene(&window);
    click(&mut window, Role::ColorWell, "Background");
    enter(&mut window, "Background: red", "3.5");
    assert_eq!(scene(&window).environment.background.r, 3.5);
    holds_as_step(&mut window, &before, "edit-background");
    window.get_by_label_contains("Brighter than white");
    // Leaving the code as it is keeps what it cannot say.
    let before = scene(&window);
    window.get_by_role_and_label(Role::TextInput, "Background: code").click();
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(scene(&window), before);
}
