//! Every number, one by one.

use super::*;
use catoptric_scene::ScenePart;

/// Sets a number by typing, holds it, and takes it back by the button beside it, if its default is another.
fn adjusts(window: &mut Window, name: &str, value: f64, step: &str, get: impl Fn(&Scene) -> f64) {
    let before = scene(window);
    enter(window, name, &value.to_string());
    assert_eq!(get(&scene(window)), value, "{name}");
    holds_as_step(window, &before, step);
    assert_eq!(get(&scene(window)), value, "{name} done again");
}

fn position_of(body: &Body) -> DVec3 {
    match body.placement.anchor {
        Anchor::Frame { position, .. } => position,
        Anchor::Axis { .. } => DVec3::NAN,
    }
}

fn rotation_of(body: &Body) -> DVec3 {
    match body.placement.anchor {
        Anchor::Frame { rotation_degrees, .. } => rotation_degrees,
        Anchor::Axis { .. } => DVec3::NAN,
    }
}

#[test]
fn a_unit_may_be_typed_in_narrow_fields_too() {
    let cube = body(&window("four-bodies", None), "cube");
    let mut window = window("four-bodies", cube);
    enter(&mut window, "Position X", "2 m");
    enter(&mut window, "Rotation Y", "45°");
    let ScenePart::Body(index) = cube else { panic!() };
    let anchor = scene(&window).bodies[index].placement.anchor;
    let Anchor::Frame { position, rotation_degrees } = anchor else { panic!("{anchor:?}") };
    assert_eq!((position.x, rotation_degrees.y), (2.0, 45.0));
}

#[test]
fn sizes_of_each_shape() {
    let mut window = with_body(Shape::SPHERE);
    adjusts(&mut window, "Radius", 2.5, "edit-radius", |scene| match sphere_of(scene).shape {
        Shape::Sphere { radius } => radius,
        _ => f64::NAN,
    });

    let mut window = with_body(Shape::CUBE);
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        let name = format!("Size {letter}");
        adjusts(&mut window, &name, 1.5 + axis as f64, "edit-size", |scene| match sphere_of(scene).shape {
            Shape::Cube { size } => size[axis],
            _ => f64::NAN,
        });
    }

    let mut window = with_body(Shape::CYLINDER);
    adjusts(&mut window, "Radius", 0.25, "edit-radius", |scene| match sphere_of(scene).shape {
        Shape::Cylinder { radius, .. } => radius,
        _ => f64::NAN,
    });
    adjusts(&mut window, "Height", 3.0, "edit-height", |scene| sphere_of(scene).height().unwrap());

    let mut window = with_body(Shape::CONE);
    adjusts(&mut window, "Base radius", 0.75, "edit-radius", |scene| match sphere_of(scene).shape {
        Shape::Cone { radius, .. } => radius,
        _ => f64::NAN,
    });
    adjusts(&mut window, "Top radius", 0.125, "edit-top-radius", |scene| match sphere_of(scene).shape {
        Shape::Cone { top_radius, .. } => top_radius,
        _ => f64::NAN,
    });
    adjusts(&mut window, "Height", 2.0, "edit-height", |scene| sphere_of(scene).height().unwrap());
}

#[test]
fn the_place_of_a_body() {
    let mut window = with_body(Shape::CYLINDER);
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        let value = -2.0 - axis as f64;
        adjusts(&mut window, &format!("Position {letter}"), value, "edit-position", |scene| {
            position_of(sphere_of(scene))[axis]
        });
        adjusts(&mut window, &format!("Rotation {letter}"), 30.0 * value, "edit-rotation", |scene| {
            rotation_of(sphere_of(scene))[axis]
        });
    }
    // While linked, all three factors of the scale change.
    adjusts(&mut window, "Scale X", 2.0, "edit-scale", |scene| sphere_of(scene).placement.scale.z);
    click(&mut window, Role::Button, "Keep proportions: Scale");
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        adjusts(&mut window, &format!("Scale {letter}"), 0.5 + axis as f64, "edit-scale", |scene| {
            sphere_of(scene).placement.scale[axis]
        });
    }
    assert_eq!(sphere_of(&scene(&window)).placement.scale, DVec3::new(0.5, 1.5, 2.5));
}

#[test]
fn the_two_ends_of_an_axis() {
    let mut window = with_body(Shape::CYLINDER);
    let before = scene(&window);
    let middle = |scene: &Scene| {
        let body = sphere_of(scene);
        body.placement.world_from_body().transform_point3(DVec3::Y * 0.5 * body.height().unwrap())
    };
    click(&mut window, Role::RadioButton, "Placed by: Two points");
    holds_as_step(&mut window, &before, "edit-anchor");
    assert!(middle(&before).abs_diff_eq(middle(&scene(&window)), 1e-9), "it has moved");
    let ends = |scene: &Scene| match sphere_of(scene).placement.anchor {
        Anchor::Axis { base, top } => [base, top],
        Anchor::Frame { .. } => [DVec3::NAN; 2],
    };
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        let value = 4.0 + axis as f64;
        adjusts(&mut window, &format!("Base {letter}"), -value, "edit-base", |scene| ends(scene)[0][axis]);
        adjusts(&mut window, &format!("Top {letter}"), value, "edit-top", |scene| ends(scene)[1][axis]);
    }
    adjusts(&mut window, "Height", 2.0, "edit-height", |scene| {
        (sphere_of(scene).height().unwrap() * 1e9).round() / 1e9
    });
    let before = scene(&window);
    click(&mut window, Role::RadioButton, "Placed by: Position and rotation");
    holds_as_step(&mut window, &before, "edit-anchor");
    assert!(middle(&before).abs_diff_eq(middle(&scene(&window)), 1e-9), "it has moved back");
}

#[test]
fn every_coefficient() {
    let mut window = with_body(Shape::SPHERE);
    type Case = (&'static str, f64, &'static str, fn(&Phong) -> f64);
    let cases: [Case; 7] = [
        ("k_a ambient", 0.25, "edit-ambient", |m| m.ambient),
        ("k_d diffuse", 0.45, "edit-diffuse", |m| m.diffuse),
        ("k_s highlight", 0.35, "edit-specular", |m| m.specular),
        ("n shininess", 128.0, "edit-shininess", |m| m.shininess),
        ("k_r reflection", 0.15, "edit-reflection", |m| m.reflection()),
        ("k_t transmission", 0.75, "edit-transmission", |m| m.transmission),
        ("η refraction", 1.33, "edit-ior", |m| m.ior),
    ];
    for (name, value, step, get) in cases {
        adjusts(&mut window, name, value, step, |scene| get(own_material(sphere_of(scene))));
    }
    choose(&mut window, "Pattern", "Checker");
    adjusts(&mut window, "s cell size", 0.5, "edit-pattern-size", |scene| {
        own_material(sphere_of(scene)).pattern.solid.as_ref().unwrap().size
    });
}

#[test]
fn the_same_coefficients_of_a_shared_material() {
    let mut window = window("four-bodies", None);
    let sphere = body(&window, "sphere");
    select(&mut window, [sphere]);
    let red =
        |scene: &Scene| scene.materials.iter().find(|named| named.name == "red").unwrap().material.clone();
    adjusts(&mut window, "k_d diffuse", 0.3, "edit-diffuse", |scene| red(scene).as_phong().unwrap().diffuse);
    let index = scene(&window).materials.iter().position(|named| named.name == "red").unwrap();
    select(&mut window, [ScenePart::Material(index)]);
    adjusts(&mut window, "k_t transmission", 0.5, "edit-transmission", |scene| {
        red(scene).as_phong().unwrap().transmission
    });
}

#[test]
fn lights() {
    let mut window = window("four-bodies", ScenePart::Light(1));
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        adjusts(&mut window, &format!("Position {letter}"), 9.0 + axis as f64, "edit-position", |scene| {
            scene.lights[1].position[axis]
        });
    }
    adjusts(&mut window, "Intensity", 2.5, "edit-intensity", |scene| scene.lights[1].intensity);
    click(&mut window, Role::RadioButton, "Falloff: linear");
    adjusts(&mut window, "K constant", 3.0, "edit-falloff-constant", |scene| match scene.lights[1].falloff {
        Falloff::Linear { constant } => constant,
        _ => f64::NAN,
    });
}

#[test]
fn the_camera() {
    let mut window = window("four-bodies", ScenePart::Camera);
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        let value = 3.0 + axis as f64;
        adjusts(&mut window, &format!("Position {letter}"), value, "edit-camera-position", |scene| {
            scene.camera.position[axis]
        });
        adjusts(&mut window, &format!("Target {letter}"), -value, "edit-camera-target", |scene| {
            scene.camera.target[axis]
        });
        adjusts(&mut window, &format!("Up {letter}"), [0.5, 2.0, 0.25][axis], "edit-camera-up", |scene| {
            scene.camera.up[axis]
        });
    }
    adjusts(&mut window, "Angle of view", 40.0, "edit-fov", |scene| match scene.camera.projection {
        Projection::Perspective { fov_degrees } => fov_degrees,
        Projection::Parallel { .. } => f64::NAN,
    });
    let view = |scene: &Scene| scene.camera.target - scene.camera.position;
    let rounded = |value: f64| (value * 1e6).round() / 1e6;
    adjusts(&mut window, "Distance", 5.0, "edit-view-direction", |scene| rounded(view(scene).length()));
    adjusts(&mut window, "Elevation", -30.0, "edit-view-direction", |scene| {
        rounded((view(scene).y / view(scene).length()).asin().to_degrees())
    });
    adjusts(&mut window, "Azimuth", 90.0, "edit-view-direction", |scene| {
        rounded(view(scene).x.atan2(-view(scene).z).to_degrees())
    });
    assert_eq!(scene(&window).camera.position, DVec3::new(3.0, 4.0, 5.0), "only the target moves");
    click(&mut window, Role::RadioButton, "Projection: Parallel");
    adjusts(&mut window, "Window height", 6.5, "edit-window-height", |scene| match scene.camera.projection {
        Projection::Parallel { height } => height,
        Projection::Perspective { .. } => f64::NAN,
    });
}

#[test]
fn the_limits_of_tracing() {
    for item in [Some(ScenePart::Tracing), None] {
        let mut window = window("four-bodies", item);
        adjusts(&mut window, "Generations", 12.0, "edit-generations", |scene| {
            f64::from(scene.tracing.generations)
        });
        adjusts(&mut window, "Threshold", 0.25, "edit-threshold", |scene| scene.tracing.threshold);
    }
}

#[test]
fn a_slider_is_one_step_however_long_it_is_dragged() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    let steps = window.state().editor().steps().len();
    let rail = window.get_by_role_and_label(Role::Slider, "k_d diffuse: slider").rect();
    window.hover_at(rail.center());
    window.run_steps(2);
    window.drag_at(rail.center());
    window.run_steps(2);
    for part in [0.4, 0.3, 0.2] {
        window.hover_at(rail.lerp_inside(vec2(part, 0.5)));
        window.run_steps(2);
        assert!(window.state().editor().is_in_gesture());
    }
    let seen = own_material(sphere_of(&scene(&window))).diffuse;
    assert!((0.1..0.3).contains(&seen), "the picture follows: {seen}");
    window.drop_at(rail.lerp_inside(vec2(0.2, 0.5)));
    window.run_steps(3);
    assert_eq!(window.state().editor().steps().len(), steps + 1);
    holds_as_step(&mut window, &before, "edit-diffuse");
}

#[test]
fn a_field_is_dragged_and_escape_takes_the_drag_back() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    let steps = window.state().editor().steps().len();
    for is_given_up in [true, false] {
        let start = window.get_by_role_and_label(Role::SpinButton, "Position Y").rect().center();
        window.hover_at(start);
        window.run_steps(2);
        window.drag_at(start);
        window.run_steps(2);
        window.hover_at(start + vec2(60.0, 0.0));
        window.run_steps(2);
        window.hover_at(start + vec2(80.0, 0.0));
        window.run_steps(2);
        let position = position_of(sphere_of(&scene(&window)));
        assert!(position.y > 1.2, "{position}");
        if is_given_up {
            window.key_press(Key::Escape);
            window.run_steps(2);
            window.hover_at(start + vec2(120.0, 0.0));
            window.run_steps(2);
            assert_eq!(scene(&window), before);
        }
        window.drop_at(start + vec2(120.0, 0.0));
        window.run_steps(3);
        assert_eq!(window.state().editor().steps().len(), steps + usize::from(!is_given_up));
    }
    holds_as_step(&mut window, &before, "edit-position");
}

#[test]
fn escape_takes_typing_back() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    type_into(&mut window, "Radius", "3");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::Sphere { radius: 3.0 }, "it follows while typed");
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert_eq!(scene(&window), before);
    assert!(!window.state().editor().is_in_gesture());
    enter(&mut window, "Radius", "4");
    holds_as_step(&mut window, &before, "edit-radius");
}

#[test]
fn leaving_a_field_without_typing_changes_nothing() {
    let mut window = with_body(Shape::Sphere { radius: 1.0 / 3.0 });
    let before = scene(&window);
    for leave in [Key::Tab, Key::Enter] {
        click(&mut window, Role::SpinButton, "Radius");
        window.key_press(leave);
        window.run_steps(3);
    }
    assert_eq!(scene(&window), before);
}

#[test]
fn arrow_keys_step_a_number() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    click(&mut window, Role::SpinButton, "k_d diffuse");
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(2);
    let (was, is) =
        (own_material(sphere_of(&before)).diffuse, own_material(sphere_of(&scene(&window))).diffuse);
    assert!(is < was && is > was - 0.05, "{was} {is}");
    holds_as_step(&mut window, &before, "edit-diffuse");
}

#[test]
fn the_default_comes_back_by_a_button() {
    let mut window = with_body(Shape::CYLINDER);
    assert!(window.query_by_label("Reset: Height").is_none(), "it has its default");
    enter(&mut window, "Height", "4");
    let before = scene(&window);
    click(&mut window, Role::Button, "Reset: Height");
    assert_eq!(sphere_of(&scene(&window)).shape, Shape::CYLINDER);
    holds_as_step(&mut window, &before, "edit-height");
    let before = scene(&window);
    click(&mut window, Role::Button, "Reset: Position");
    assert_eq!(position_of(sphere_of(&scene(&window))), DVec3::ZERO);
    holds_as_step(&mut window, &before, "edit-position");
    let before = scene(&window);
    click(&mut window, Role::Button, "Reset: k_d diffuse");
    assert_eq!(own_material(sphere_of(&scene(&window))).diffuse, 0.9);
    holds_as_step(&mut window, &before, "edit-diffuse");
}
