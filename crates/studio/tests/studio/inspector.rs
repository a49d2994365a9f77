//! The panel of values: every quantity is set by hand, undone and done again.

use std::sync::Arc;

use catoptric_editor::Action;
use catoptric_scene::{
    Anchor, Body, Color, Falloff, MaterialChoice, Phong, Projection, Scene, ScenePart, Shape,
};
use catoptric_studio::{StartDocument, Studio};
use egui::{Event, Key, Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;

use crate::kit::{TestHost, studio_with};

mod adjust;
mod choose;
mod colors;
mod formulas;
mod pictures;
mod refuse;
mod several;

type Window = Harness<'static, Studio>;

/// A window so high that no row has to be scrolled to, with `item` of the example selected.
fn window(example: &str, item: impl Into<Option<ScenePart>>) -> Window {
    window_in("english", example, item)
}

fn window_in(language: &str, example: &str, item: impl Into<Option<ScenePart>>) -> Window {
    use catoptric_studio::host::Host as _;
    let host = TestHost::new();
    let text = format!(r#"{{"language": "{language}", "is_hint_dismissed": true}}"#);
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    let mut window = studio_with(host, StartDocument::Example(example.to_owned()));
    window.set_size(vec2(1280.0, 1700.0));
    window.run_steps(2);
    select(&mut window, item.into());
    window
}

fn select(window: &mut Window, item: impl IntoIterator<Item = ScenePart>) {
    window.state_mut().editor_mut().select_parts(item);
    window.run_steps(4);
}

fn scene(window: &Window) -> Arc<Scene> {
    Arc::clone(window.state().editor().scene())
}

/// The index of the body of this name.
fn body(window: &Window, name: &str) -> ScenePart {
    ScenePart::Body(scene(window).bodies.iter().position(|body| body.name == name).unwrap())
}

/// Types `text` into the field called `name` and leaves it with Enter.
fn enter(window: &mut Window, name: &str, text: &str) {
    type_into(window, name, text);
    window.key_press(Key::Enter);
    window.run_steps(3);
}

/// Picks an entry of a list.
fn choose(window: &mut Window, list: &str, entry: &str) {
    click(window, Role::ComboBox, list);
    window.get_all_by_label(entry).last().unwrap().click();
    window.run_steps(3);
}

/// Types `text` into the number field called `name`, and stays in it.
fn type_into(window: &mut Window, name: &str, text: &str) {
    window.get_by_role_and_label(Role::SpinButton, name).click();
    window.run_steps(3);
    window.event(Event::Text(text.to_owned()));
    window.run_steps(2);
}

/// Clicks what has this role and name.
fn click(window: &mut Window, role: Role, name: &str) {
    window.get_by_role_and_label(role, name).click();
    window.run_steps(3);
}

/// Holds that what was just done is one step called `key`, that undo restores `before` exactly, and redo what is now.
fn holds_as_step(window: &mut Window, before: &Arc<Scene>, key: &str) {
    let after = scene(window);
    assert_ne!(*before, after, "{key}: nothing changed");
    let editor = window.state_mut().editor_mut();
    assert!(!editor.is_in_gesture(), "{key}: still open");
    assert_eq!(editor.undo_label().map(|label| label.key), Some(key));
    assert!(editor.undo());
    assert_eq!(editor.scene(), before, "{key}: undone");
    assert!(editor.redo());
    assert_eq!(*editor.scene(), after, "{key}: done again");
    editor.check_invariants().unwrap();
    window.run_steps(2);
    assert_eq!(own_missing(window), Vec::<String>::new());
}

/// The messages that are missing.
fn own_missing(window: &Window) -> Vec<String> {
    window.state().texts().missing()
}

/// The material of a body that has one of its own, of Phong's model.
fn own_material(body: &Body) -> &Phong {
    let MaterialChoice::Inline(material) = &body.material else { unreachable!("it has one of its own") };
    material.as_phong().unwrap()
}

/// A window with a single selected body of this kind, with a material of its own.
fn with_body(shape: Shape) -> Window {
    let mut window = window("four-bodies", None);
    let item = body(&window, "sphere");
    let editor = window.state_mut().editor_mut();
    editor.select_parts([item]);
    editor.apply(Action::MakeMaterialUnique).unwrap();
    let ScenePart::Body(index) = item else { unreachable!() };
    editor
        .change_body(index, catoptric_editor::Label::new("edit-shape", ""), |body| body.shape = shape)
        .unwrap();
    editor.settle();
    window.run_steps(4);
    window
}

/// The body that [`with_body`] made.
fn sphere_of(scene: &Scene) -> &Body {
    scene.bodies.iter().find(|body| body.name == "sphere").unwrap()
}
