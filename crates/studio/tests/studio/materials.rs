//! The browser of materials: pictures, keys, and what a click gives.

use catoptric_scene::{Body, Conductor, Material, MaterialChoice, MetalOptics, Model, ScenePart};
use catoptric_studio::{Language, Pane, Studio, WindowCommand};
use egui::{Event, Key, Modifiers, Role};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::kit::{TestHost, studio, studio_with, wait_until};

type Kit = Harness<'static, Studio>;

/// The bodies of the example, and the button that opens the panel.
const SPHERE: usize = 1;
const CUBE: usize = 2;
const BROWSE: &str = "Material browser";

/// The panel over the example of four bodies, with these selected.
fn open(selected: &[ScenePart]) -> Kit {
    let mut harness = studio();
    harness.run_steps(3);
    select(&mut harness, selected);
    press(&mut harness, Key::M);
    harness
}

fn select(harness: &mut Kit, items: &[ScenePart]) {
    harness.state_mut().editor_mut().select_parts(items.iter().copied());
    harness.run_steps(3);
}

fn press(harness: &mut Kit, key: Key) {
    harness.key_press(key);
    harness.run_steps(4);
}

fn is_open(harness: &Kit) -> bool {
    harness.query_by_role_and_label(Role::ListBox, "Materials to choose from").is_some()
}

fn find(harness: &mut Kit, words: &str) {
    harness.get_by_label("Find by name").click();
    harness.run_steps(2);
    harness.event(Event::Text(words.to_owned()));
    harness.run_steps(3);
}

fn click(harness: &mut Kit, name: &str) {
    harness.get_by_role_and_label(Role::Button, name).click();
    harness.run_steps(3);
}

fn body(harness: &Kit, place: usize) -> Body {
    harness.state().editor().scene().bodies[place].clone()
}

fn is_gold(choice: &MaterialChoice) -> bool {
    let MaterialChoice::Inline(material) = choice else { return false };
    let Material::Conductor(Conductor { metal: MetalOptics::Metal(metal), roughness }) = **material else {
        return false;
    };
    metal.name == "gold" && roughness == 0.0
}

#[test]
fn a_preset_is_found_and_given_as_one_step() {
    let mut harness = open(&[ScenePart::Body(SPHERE), ScenePart::Body(CUBE)]);
    harness.get_by_label("A click gives it to 2 selected bodies.");
    find(&mut harness, "gold");
    assert!(harness.query_by_role_and_label(Role::Button, "Diamond").is_none());
    let before = harness.state().editor().scene().clone();
    click(&mut harness, "Gold");
    assert!([SPHERE, CUBE].iter().all(|place| is_gold(&body(&harness, *place).material)));
    let editor = harness.state().editor();
    assert_eq!(
        (editor.steps_done(), editor.undo_label().map(|label| label.key)),
        (1, Some("edit-assign-material"))
    );
    harness.get_by_label("Edit").click();
    harness.run_steps(3);
    harness.get_by_label("Undo: Assign material").click();
    harness.run_steps(3);
    assert_eq!(*harness.state().editor().scene(), before);
}

#[test]
fn a_material_of_the_scene_is_shared() {
    let mut harness = open(&[ScenePart::Body(SPHERE)]);
    harness.get_by_label("In this scene");
    harness.get_by_label("A click gives it to “sphere”.");
    click(&mut harness, "blue");
    assert_eq!(body(&harness, SPHERE).material, MaterialChoice::Named("blue".to_owned()));
    harness.get_by_label("2 bodies use this material.");
    // A preset is the body's own, and can be shared in its turn.
    find(&mut harness, "plaster");
    click(&mut harness, "Plaster");
    assert!(matches!(body(&harness, SPHERE).material, MaterialChoice::Inline(_)));
    click(&mut harness, "Share material");
    assert_eq!(body(&harness, SPHERE).material, MaterialChoice::Named("sphere".to_owned()));
}

#[test]
fn with_nothing_selected_it_is_told_what_to_do() {
    let mut harness = open(&[]);
    let before = harness.state().editor().scene().clone();
    harness.get_by_label("Select a body: a click on a material then gives it.");
    find(&mut harness, "diamond");
    click(&mut harness, "Diamond");
    harness.get_by_label("Select a body first: the material is given to what is selected.");
    assert_eq!(*harness.state().editor().scene(), before);
}

#[test]
fn a_selected_material_becomes_like_a_preset() {
    let mut harness = open(&[ScenePart::Material(1)]);
    let before = harness.state().editor().scene().clone();
    harness.get_by_label("A click makes “red” like it, on all bodies of this material.");
    find(&mut harness, "terracotta");
    click(&mut harness, "Terracotta");
    let editor = harness.state_mut().editor_mut();
    assert_eq!(editor.scene().materials[1].material.model(), Model::Matte);
    assert_eq!(editor.scene().bodies, before.bodies);
    assert!(editor.undo() && *editor.scene() == before);
}

#[test]
fn keys_walk_choose_and_close() {
    let mut harness = open(&[ScenePart::Body(SPHERE)]);
    assert!(is_open(&harness));
    for key in [Key::ArrowRight, Key::ArrowRight, Key::Enter] {
        press(&mut harness, key);
    }
    assert_eq!(body(&harness, SPHERE).material, MaterialChoice::Named("green".to_owned()));
    // The row below holds the kinds of Phong's model, the third of which mirrors.
    for key in [Key::ArrowDown, Key::Space] {
        press(&mut harness, key);
    }
    let MaterialChoice::Inline(mirror) = body(&harness, SPHERE).material else { panic!() };
    assert_eq!(mirror.as_phong().unwrap().reflection(), 0.9);
    assert!(!body(&harness, SPHERE).hidden);
    press(&mut harness, Key::Escape);
    assert!(!is_open(&harness));
    // From the field: Enter gives the first one, Escape closes as well.
    harness.get_by_role_and_label(Role::Button, BROWSE).click();
    harness.run_steps(3);
    find(&mut harness, "gold metals");
    press(&mut harness, Key::Enter);
    assert!(is_gold(&body(&harness, SPHERE).material));
    harness.get_by_label("Find by name").click();
    harness.run_steps(3);
    press(&mut harness, Key::Escape);
    assert!(!is_open(&harness));
    harness.key_press_modifiers(Modifiers::NONE, Key::F8);
    harness.run_steps(3);
    assert!(is_open(&harness));
}

#[test]
fn pictures_are_traced_behind_the_window() {
    let mut harness = open(&[]);
    wait_until(&mut harness, "pictures", |studio| studio.pictured_materials() >= 6);
    // What a material of the scene looks like follows its values.
    let before = harness.state().pictured_materials();
    let label = catoptric_editor::Label::new("edit-color", "");
    let editor = harness.state_mut().editor_mut();
    editor.change_material(0, label, |material| *material.ambient_mut().unwrap() = 0.7).unwrap();
    editor.settle();
    wait_until(&mut harness, "the new picture", move |studio| studio.pictured_materials() > before);
}

#[test]
fn the_panel_speaks_both_languages_and_is_remembered() {
    let host = TestHost::new();
    let start = catoptric_studio::StartDocument::Example("four-bodies".to_owned());
    let mut harness = studio_with(host.clone(), start.clone());
    harness.run_steps(3);
    harness.state_mut().run(WindowCommand::TogglePane(Pane::Materials));
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    harness.run_steps(4);
    harness.get_by_label("В этой сцене");
    harness.get_by_label("Найти по названию").click();
    harness.run_steps(2);
    harness.event(Event::Text("diamond".to_owned()));
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, "Алмаз").hover();
    harness.run_steps(60);
    assert!(harness.query_by_label_contains("Показатель преломления 2,417").is_some());
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
    eframe::App::on_exit(harness.state_mut());
    let mut again = studio_with(host, start);
    again.run_steps(4);
    assert!(again.query_by_role_and_label(Role::ListBox, "Материалы на выбор").is_some());
}
