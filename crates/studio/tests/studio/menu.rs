//! The menu bar by keys: F10 and Alt, arrows, Enter, Esc.

use catoptric_scene::ShapeKind;
use catoptric_studio::{HelpCommand, StartDocument, Studio};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Popup};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio, studio_with};

type Kit = Harness<'static, Studio>;

fn settle(harness: &mut Kit) {
    harness.run_steps(4);
}

fn press(harness: &mut Kit, key: Key) {
    harness.key_press(key);
    settle(harness);
}

fn opened() -> Kit {
    let mut harness = studio();
    settle(&mut harness);
    harness
}

/// What has the keyboard.
fn focused(harness: &Kit) -> Option<String> {
    let node = harness.query_all_by(|node| node.is_focused() && node.label().is_some()).next()?;
    node.accesskit_node().label()
}

fn is_focused(harness: &Kit, label: &str) -> bool {
    focused(harness).as_deref() == Some(label)
}

fn is_menu_open(harness: &Kit) -> bool {
    Popup::is_any_open(&harness.ctx)
}

fn alt(harness: &mut Kit, is_down: bool) {
    let modifiers = if is_down { Modifiers::ALT } else { Modifiers::NONE };
    harness.event(Event::ModifiersChanged(modifiers));
    harness.step();
}

fn bodies(harness: &Kit) -> usize {
    harness.state().editor().scene().bodies.len()
}

#[test]
fn f10_leads_to_the_bar_and_arrows_walk_along_it() {
    let mut harness = opened();
    press(&mut harness, Key::F10);
    assert!(is_focused(&harness, "File"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowRight);
    assert!(is_focused(&harness, "Edit") && !is_menu_open(&harness));
    press(&mut harness, Key::ArrowLeft);
    press(&mut harness, Key::ArrowLeft);
    assert!(is_focused(&harness, "Help"), "around the end: {:?}", focused(&harness));
    // Bare keys are no shortcuts meanwhile.
    press(&mut harness, Key::G);
    assert!(harness.state().settings().shows_grid);
    press(&mut harness, Key::F10);
    assert_eq!(focused(&harness), None, "it leads back, too");
}

#[test]
fn an_entry_is_chosen_by_keys_and_the_menu_closes() {
    let mut harness = opened();
    press(&mut harness, Key::F10);
    press(&mut harness, Key::ArrowRight);
    press(&mut harness, Key::ArrowRight);
    press(&mut harness, Key::ArrowDown);
    assert!(is_menu_open(&harness) && is_focused(&harness, "Sphere"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowDown);
    assert!(is_focused(&harness, "Cube"), "{:?}", focused(&harness));
    press(&mut harness, Key::Enter);
    assert_eq!((bodies(&harness), is_menu_open(&harness)), (6, false));
    assert!(harness.query_by_label("Optics").is_none());
}

#[test]
fn what_can_be_added_stands_in_groups_and_is_not_called_add_again() {
    for (language, add, front, group, lens) in [
        ("english", "Add", ["Sphere", "Cube", "Cylinder", "Plane", "Light"], "Optics", "Mirror dish"),
        (
            "russian",
            "Добавить",
            ["Шар", "Куб", "Цилиндр", "Плоскость", "Источник света"],
            "Оптика",
            "Вогнутое зеркало",
        ),
    ] {
        // Beside each other, and folded on a telephone.
        for width in [1280.0, 360.0] {
            let host = TestHost::new();
            let text =
                format!(r#"{{"language": "{language}", "is_hint_dismissed": true, "viewport_samples": 1}}"#);
            std::fs::write(host.path("settings.json"), text).unwrap();
            let mut harness = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
            harness.set_size(egui::vec2(width, 640.0));
            settle(&mut harness);
            let menu = harness.state().texts().get("menu-all").to_owned();
            if width < 500.0 {
                harness.get_by_label(&menu).click();
                settle(&mut harness);
            }
            harness.get_by_label(add).click();
            settle(&mut harness);
            for name in front {
                assert!(harness.query_by_role_and_label(Role::Button, name).is_some(), "{name}");
            }
            harness.get_by_label(group).click();
            settle(&mut harness);
            let screen = harness.ctx.content_rect();
            let dish = harness.get_by_role_and_label(Role::Button, lens);
            assert!(screen.contains_rect(dish.rect()), "{language} {width}: {} in {screen}", dish.rect());
            dish.click();
            settle(&mut harness);
            assert_eq!((bodies(&harness), is_menu_open(&harness)), (6, false), "{language} {width}");
        }
    }
}

#[test]
fn every_shape_is_in_a_group_of_the_menu() {
    let mut harness = opened();
    let mut found = Vec::new();
    for group in ["Bodies", "Optics", "Surfaces"] {
        harness.get_by_label("Add").click();
        settle(&mut harness);
        harness.get_by_role_and_label(Role::Button, group).click();
        settle(&mut harness);
        for kind in [ShapeKind::SIMPLE.as_slice(), &ShapeKind::PARAMETRIC].concat() {
            let name = harness.state().texts().get(&format!("name-{}", kind.key())).to_owned();
            let places = harness.query_all_by_label(&name);
            // Four bodies are offered in front as well.
            let count = places.filter(|node| node.accesskit_node().role() == Role::Button).count();
            let is_front = matches!(name.as_str(), "Sphere" | "Cube" | "Cylinder" | "Plane");
            if count > usize::from(is_front) {
                found.push(name);
            }
        }
        press(&mut harness, Key::Escape);
        press(&mut harness, Key::Escape);
        assert!(!is_menu_open(&harness));
    }
    let bodies = "Sphere Cube Cylinder Cone Paraboloid Plane Tube Ring Bowl Wedge";
    let surfaces = ["Open cylinder", "Open cone", "Disc", "Rectangle", "Triangle"];
    let wanted: Vec<&str> =
        bodies.split(' ').chain(["Lens", "Mirror dish", "Prism"]).chain(surfaces).collect();
    assert_eq!(found, wanted);
}

#[test]
fn enter_opens_a_menu_and_arrows_go_from_menu_to_menu() {
    let mut harness = opened();
    press(&mut harness, Key::F10);
    press(&mut harness, Key::Enter);
    assert!(is_focused(&harness, "New scene"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowLeft);
    assert!(is_focused(&harness, "Manual"), "the last menu: {:?}", focused(&harness));
    assert!(harness.query_by_label("New scene").is_none());
    press(&mut harness, Key::ArrowRight);
    assert!(is_focused(&harness, "New scene"), "{:?}", focused(&harness));
    press(&mut harness, Key::Escape);
    assert_eq!((focused(&harness), is_menu_open(&harness)), (None, false));
}

#[test]
fn a_submenu_opens_to_the_right_and_closes_to_the_left() {
    let mut harness = opened();
    press(&mut harness, Key::F10);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::ArrowDown);
    assert!(is_focused(&harness, "Examples"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowRight);
    assert!(is_focused(&harness, "Example gallery…"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowLeft);
    assert!(is_focused(&harness, "Examples"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowRight);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::Enter);
    assert_eq!(harness.state().editor().title(), "four-bodies");
    assert!(!is_menu_open(&harness), "menus and submenus close");
}

#[test]
fn esc_leads_back_to_what_had_the_keyboard() {
    let mut harness = opened();
    harness.get_by_label("Filter by name").focus();
    settle(&mut harness);
    press(&mut harness, Key::F10);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::Escape);
    assert!(harness.get_by_role_and_label(Role::TextInput, "Filter by name").is_focused());
    assert!(!is_menu_open(&harness));
}

#[test]
fn alt_pressed_and_released_alone_leads_to_the_bar() {
    let mut harness = opened();
    alt(&mut harness, true);
    alt(&mut harness, false);
    settle(&mut harness);
    assert!(is_focused(&harness, "File"), "{:?}", focused(&harness));
    alt(&mut harness, true);
    alt(&mut harness, false);
    settle(&mut harness);
    assert_eq!(focused(&harness), None, "and back");
}

#[test]
fn alt_as_a_modifier_leaves_the_bar_alone() {
    let mut harness = opened();
    harness.key_press_modifiers(Modifiers::ALT, Key::Num1);
    settle(&mut harness);
    assert_eq!(focused(&harness), None, "a shortcut");

    alt(&mut harness, true);
    harness.event(Event::WindowFocused(false));
    alt(&mut harness, false);
    settle(&mut harness);
    assert_eq!(focused(&harness), None, "switching windows");

    let center = harness.state().viewport_rect().unwrap().center();
    let button = |pressed| Event::PointerButton {
        pos: center,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::ALT,
    };
    harness.hover_at(center);
    alt(&mut harness, true);
    harness.event(button(true));
    harness.hover_at(center + egui::vec2(20.0, 10.0));
    harness.event(button(false));
    harness.step();
    alt(&mut harness, false);
    settle(&mut harness);
    assert!(!is_focused(&harness, "File"), "a drag");
}

#[test]
fn folded_menus_are_reached_by_keys_too() {
    let mut harness = studio();
    harness.set_size(egui::vec2(420.0, 600.0));
    settle(&mut harness);
    press(&mut harness, Key::F10);
    assert!(is_focused(&harness, "Menu"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::ArrowDown);
    press(&mut harness, Key::ArrowDown);
    assert!(is_focused(&harness, "Add"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowRight);
    assert!(is_focused(&harness, "Sphere"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowLeft);
    assert!(is_focused(&harness, "Add"), "{:?}", focused(&harness));
    press(&mut harness, Key::ArrowRight);
    press(&mut harness, Key::Enter);
    assert_eq!((bodies(&harness), is_menu_open(&harness)), (6, false));
}

#[test]
fn the_bar_behind_a_dialog_is_not_reached() {
    let mut harness = opened();
    harness.state_mut().run(HelpCommand::About);
    settle(&mut harness);
    press(&mut harness, Key::F10);
    alt(&mut harness, true);
    alt(&mut harness, false);
    settle(&mut harness);
    assert!(!is_focused(&harness, "File"));
}
