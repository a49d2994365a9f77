//! Pictures around the bodies and on them, and patterns.

use catoptric_studio::{FileCommand, PictureCommand};
use std::path::Path;

use catoptric_picture::{Picture, write_exr};
use catoptric_scene::{Image, PatternSpace, ScenePart, SolidKind, Surroundings};

use super::*;
use crate::kit::wait_until;

fn opened(window: &mut Window) {
    window.run_steps(2);
    wait_until(window, "the pictures", |studio| {
        !studio.is_opening_images() && studio.editor().scene().images().all(|image| image.pixels().is_some())
    });
    window.run_steps(2);
}

fn picture(window: &Window) -> Image {
    scene(window).environment.surroundings.picture().unwrap().clone()
}

#[test]
fn surroundings_are_a_color_a_sky_or_a_picture() {
    let mut window = window("four-bodies", ScenePart::Environment);
    let at_first = scene(&window);
    choose(&mut window, "Surroundings", "Gradient sky");
    assert!(scene(&window).environment.surroundings.sky().is_some());
    holds_as_step(&mut window, &at_first, "edit-surroundings");
    assert!(window.query_by_label_contains("Background").is_none(), "there is none under a sky");
    let before = scene(&window);
    enter(&mut window, "Strength", "0.5");
    assert_eq!(scene(&window).environment.strength, 0.5);
    holds_as_step(&mut window, &before, "edit-sky-strength");
    let before = scene(&window);
    choose(&mut window, "Surroundings", "Evening");
    holds_as_step(&mut window, &before, "edit-surroundings");
    opened(&mut window);
    assert_eq!(picture(&window).path(), "builtin:evening");
    let before = scene(&window);
    enter(&mut window, "Rotation", "90");
    assert_eq!(scene(&window).environment.rotation_degrees, 90.0);
    holds_as_step(&mut window, &before, "edit-picture-rotation");
    let editor = window.state_mut().editor_mut();
    while editor.undo() {}
    assert_eq!(*editor.scene(), at_first);
    assert!(!editor.is_changed());
    while editor.redo() {}
    assert!(
        editor.scene().environment.surroundings.picture().unwrap().pixels().is_some(),
        "kept by the steps"
    );
    window.run_steps(3);
}

#[test]
fn a_texture_takes_the_place_of_the_color() {
    let mut window = with_body(Shape::SPHERE);
    let before = scene(&window);
    choose(&mut window, "Texture", "Planet");
    holds_as_step(&mut window, &before, "edit-texture");
    opened(&mut window);
    let texture = own_material(sphere_of(&scene(&window))).pattern.texture.clone().unwrap();
    assert_eq!(texture.path(), "builtin:planet");
    assert!(window.query_by_label_contains("C color").is_none());
    let before = scene(&window);
    choose(&mut window, "Texture", "none");
    assert_eq!(own_material(sphere_of(&scene(&window))).pattern.texture, None);
    holds_as_step(&mut window, &before, "edit-texture");
}

#[test]
fn a_pattern_lies_along_the_axes_of_the_world_or_the_body() {
    let mut window = with_body(Shape::CUBE);
    choose(&mut window, "Pattern", "Stripes");
    let before = scene(&window);
    click(&mut window, Role::RadioButton, "Along axes of: Body");
    let solid = own_material(sphere_of(&scene(&window))).pattern.solid.clone().unwrap();
    assert_eq!((solid.space, solid.kind), (PatternSpace::Body, SolidKind::Stripes));
    holds_as_step(&mut window, &before, "edit-pattern-space");
}

fn write_gray(path: &Path, gray: f32, width: u32) {
    write_exr(path, &Picture::from_fn(width, 1, |_, _| [gray; 3]).unwrap()).unwrap();
}

/// Chooses the next answer of the host as surroundings; what its first pixel is.
fn chosen_gray(window: &mut Window) -> f32 {
    choose(window, "Surroundings", "From a file…");
    opened(window);
    picture(window).pixels().unwrap().pixels()[0][0]
}

fn save_as(window: &mut Window, name: &str) {
    window.state_mut().run(FileCommand::SaveAs);
    window.run_steps(4);
    wait_until(window, "the file", |studio| !studio.is_saving() && studio.editor().title() == name);
}

#[test]
fn a_picture_that_is_picked_is_the_one_that_is_there_now() {
    let host = TestHost::new();
    let (here, away) = (host.path("a.exr"), host.path("away"));
    std::fs::create_dir(&away).unwrap();
    write_gray(&here, 0.25, 2);
    write_gray(&away.join("a.exr"), 0.5, 2);
    for answer in [host.path("a.toml"), here.clone(), here.clone(), away.join("b.toml"), away.join("a.exr")] {
        host.answer(Some(answer));
    }
    let mut window = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    window.set_size(vec2(1280.0, 1700.0));
    select(&mut window, [ScenePart::Environment]);
    save_as(&mut window, "a.toml");
    assert_eq!(chosen_gray(&mut window), 0.25);
    write_gray(&here, 0.75, 3);
    assert_eq!(chosen_gray(&mut window), 0.75, "changed since");
    save_as(&mut window, "b.toml");
    assert_eq!(chosen_gray(&mut window), 0.5, "another file by the same path");
    assert_eq!(picture(&window).path(), "a.exr");
}

#[test]
fn after_saving_elsewhere_every_step_finds_its_pictures() {
    let host = TestHost::new();
    let (here, away) = (host.path("a.exr"), host.path("away"));
    std::fs::create_dir(&away).unwrap();
    write_gray(&here, 0.25, 2);
    for answer in [host.path("a.toml"), here.clone(), away.join("none/b.toml"), away.join("b.toml")] {
        host.answer(Some(answer));
    }
    let mut window = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    window.set_size(vec2(1280.0, 1700.0));
    select(&mut window, [ScenePart::Environment]);
    save_as(&mut window, "a.toml");
    assert_eq!(chosen_gray(&mut window), 0.25);
    let resave = |window: &mut Window| {
        window.state_mut().run(FileCommand::Save);
        window.run_steps(4);
        wait_until(window, "the file", |studio| !studio.is_saving() && !studio.editor().is_changed());
        let saved = catoptric_store::load(window.state().editor().path().unwrap()).unwrap().scene;
        assert_eq!(saved, *scene(window));
        saved.environment.surroundings.picture().map(|image| image.path().to_owned())
    };
    window.state_mut().run(FileCommand::SaveAs);
    window.run_steps(4);
    wait_until(&mut window, "the answer of the disk", |studio| !studio.is_saving());
    window.run_steps(2);
    window.get_by_label_contains("none/b.toml");
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert_eq!(resave(&mut window).as_deref(), Some("a.exr"), "nothing came of saving elsewhere");
    save_as(&mut window, "b.toml");
    assert!(window.state_mut().editor_mut().undo());
    assert_eq!(resave(&mut window), None);
    assert!(window.state_mut().editor_mut().redo());
    assert_eq!(resave(&mut window).as_deref(), here.to_str());
}

#[test]
fn a_picture_is_not_given_to_another_document_than_it_was_asked_for() {
    let host = TestHost::new();
    write_gray(&host.path("a.exr"), 0.25, 2);
    host.answer(Some(host.path("a.exr")));
    let mut window = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    let usage = catoptric_studio::ImageUse::Surroundings;
    window.state_mut().run(PictureCommand::Choose(usage));
    window.state_mut().run(FileCommand::New);
    window.run_steps(4);
    assert_eq!(host.questions.lock().unwrap().len(), 1);
    assert!(scene(&window).images().next().is_none() && !window.state().editor().is_changed());
}

#[test]
fn pictures_of_files_are_named_from_the_folder_of_the_scene_and_move_with_it() {
    let host = TestHost::new();
    let (image, away) = (host.path("around.exr"), host.path("away"));
    write_exr(&image, &Picture::from_fn(2, 1, |x, _| [x as f32; 3]).unwrap()).unwrap();
    std::fs::create_dir(&away).unwrap();
    host.answer(Some(image.clone()));
    host.answer(Some(host.path("a.toml")));
    host.answer(Some(away.join("b.toml")));
    host.answer(Some(host.path("none.png")));
    let mut window = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    window.set_size(vec2(1280.0, 1700.0));
    select(&mut window, [ScenePart::Environment]);
    choose(&mut window, "Surroundings", "From a file…");
    opened(&mut window);
    assert_eq!(Some(picture(&window).path()), image.to_str(), "no file has the scene yet");
    for (name, path) in [("a.toml", "around.exr"), ("b.toml", image.to_str().unwrap())] {
        save_as(&mut window, name);
        assert_eq!(picture(&window).path(), path, "{name}");
        let saved = catoptric_store::load(window.state().editor().path().unwrap()).unwrap();
        assert_eq!(saved.scene, *scene(&window), "{name}");
    }
    let before = scene(&window);
    choose(&mut window, "Surroundings", "From a file…");
    window.run_steps(2);
    wait_until(&mut window, "the answer of the disk", |studio| !studio.is_opening_images());
    window.run_steps(2);
    assert!(picture(&window).path().ends_with("none.png") && picture(&window).pixels().is_none());
    window.get_by_label_contains("cannot be opened: there is no file");
    window.get_by_label_contains("The picture is not there yet.");
    let editor = window.state_mut().editor_mut();
    editor.undo();
    assert_eq!(*editor.scene(), before);
    assert!(matches!(before.environment.surroundings, Surroundings::Picture(_)));
}
