//! Several things at once.

use super::*;
use crate::kit::item_at;
use catoptric_scene::ScenePart;

fn positions(scene: &Scene, names: &[&str]) -> Vec<DVec3> {
    let of = |name: &&str| {
        let body = scene.bodies.iter().find(|body| body.name == **name).unwrap();
        body.placement.world_from_body().translation
    };
    names.iter().map(of).collect()
}

#[test]
fn bodies_move_by_the_same_offset_and_share_the_rest() {
    let mut window = window("four-bodies", None);
    let names = ["cube", "cylinder", "sphere"];
    let items: Vec<ScenePart> = names.iter().map(|name| body(&window, name)).collect();
    select(&mut window, items);
    window.get_by_label("3 bodies");
    let before = scene(&window);
    let old = positions(&before, &names);
    // The primary one, the sphere, is shown.
    enter(&mut window, "Position X", &(old[2].x + 1.5).to_string());
    for (old, new) in old.iter().zip(positions(&scene(&window), &names)) {
        assert!(new.abs_diff_eq(*old + DVec3::X * 1.5, 1e-12), "{old} {new}");
    }
    holds_as_step(&mut window, &before, "edit-position");

    let before = scene(&window);
    // They differ: only the cube is turned.
    let node = window.get_by_role_and_label(Role::SpinButton, "Rotation Y");
    assert_eq!(node.value().as_deref(), Some("—"));
    enter(&mut window, "Rotation Y", "0");
    for name in names {
        let scene = scene(&window);
        let body = scene.bodies.iter().find(|body| body.name == name).unwrap();
        let straight =
            Anchor::Frame { position: positions(&scene, &[name])[0], rotation_degrees: DVec3::ZERO };
        assert_eq!(body.placement.anchor, straight, "{name}");
    }
    holds_as_step(&mut window, &before, "edit-rotation");
}

#[test]
fn materials_of_several_bodies_change_together() {
    let mut window = window("four-bodies", None);
    let names = ["cube", "cylinder", "sphere"];
    let items: Vec<ScenePart> = names.iter().map(|name| body(&window, name)).collect();
    window.state_mut().editor_mut().select_parts([items[0]]);
    window.state_mut().editor_mut().apply(Action::MakeMaterialUnique).unwrap();
    select(&mut window, items);
    let before = scene(&window);
    enter(&mut window, "k_d diffuse", "0.125");
    let scene_now = scene(&window);
    for body in &scene_now.bodies {
        let diffuse = scene_now.material(&body.material).unwrap().as_phong().unwrap().diffuse;
        assert_eq!(diffuse == 0.125, names.contains(&body.name.as_str()), "{}", body.name);
    }
    holds_as_step(&mut window, &before, "edit-diffuse");
}

#[test]
fn locked_ones_among_several_stay() {
    let mut window = window("four-bodies", None);
    let (cube, sphere) = (body(&window, "cube"), body(&window, "sphere"));
    let item = item_at(window.state(), sphere);
    window.state_mut().editor_mut().apply(Action::SetLocked { item, locked: true }).unwrap();
    select(&mut window, [cube, sphere]);
    window.get_by_label_contains("1 of them is locked");
    let old = positions(&scene(&window), &["sphere", "cube"]);
    enter(&mut window, "Position Z", "5");
    let new = positions(&scene(&window), &["sphere", "cube"]);
    assert_eq!(new[0], old[0]);
    assert_eq!(new[1].z, 5.0);
}

#[test]
fn lights_dim_together() {
    let mut window = window("four-bodies", None);
    select(&mut window, [ScenePart::Light(0), ScenePart::Light(1)]);
    window.get_by_label("2 lights");
    let before = scene(&window);
    let node = window.get_by_role_and_label(Role::SpinButton, "Intensity");
    assert_eq!(node.value().as_deref(), Some("—"));
    // Also the number that the primary one has already.
    enter(&mut window, "Intensity", &before.lights[1].intensity.to_string());
    assert!(scene(&window).lights.iter().all(|light| light.intensity == before.lights[1].intensity));
    holds_as_step(&mut window, &before, "edit-intensity");
}
