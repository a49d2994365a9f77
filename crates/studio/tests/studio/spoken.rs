//! Whoever hears the window: everything in it has a role and a name in words.

use std::collections::BTreeSet;
use std::path::PathBuf;

use catoptric_scene::ScenePart;
use catoptric_studio::host::Host as _;
use catoptric_studio::{Command, Language, StartDocument, Studio, WindowCommand};
use egui::accesskit::Role;
use egui::{Event, Key, PointerButton, Pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::{AccessKitNode, NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

type Window = Harness<'static, Studio>;

/// Opens a scene in a language, with first steps to be shown.
fn open(language: &str, scene: &str) -> Window {
    let host = TestHost::new();
    let text = format!(r#"{{"language": "{language}", "viewport_samples": 1}}"#);
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    let mut window = studio_with(host, StartDocument::Example(scene.to_owned()));
    window.run_steps(3);
    window
}

/// Signs of fonts of icons, which are no words.
fn is_sign(letter: char) -> bool {
    matches!(letter, '\u{e000}'..='\u{f8ff}' | '\u{f0000}'..)
}

fn is_said(words: Option<&str>) -> bool {
    words.is_some_and(|words| words.chars().any(|letter| !letter.is_whitespace() && !is_sign(letter)))
}

/// What only holds other things needs no name.
fn is_frame(role: Role) -> bool {
    matches!(role, Role::GenericContainer | Role::TextRun | Role::ScrollView | Role::ScrollBar | Role::Pane)
}

/// Whether what opens is called by what opens it: a list by its field, a menu by its button.
fn is_named_by_opener(node: &AccessKitNode<'_>) -> bool {
    matches!(node.role(), Role::Menu | Role::ListBox | Role::Dialog)
        && node
            .parent()
            .is_some_and(|opener| opener.role() != Role::Window && is_said(opener.label().as_deref()))
}

/// What is wrong with a thing, as a screen reader finds it.
fn fault(node: &AccessKitNode<'_>) -> Option<&'static str> {
    let role = node.role();
    let (label, value) = (node.label(), node.value());
    let texts = [label.as_deref(), value.as_deref(), node.data().placeholder(), node.data().description()];
    if role != Role::TextRun && texts.into_iter().flatten().any(|text| text.contains(is_sign)) {
        return Some("the sign of an icon for a word");
    }
    match role {
        Role::Unknown => Some("no role"),
        _ if is_frame(role) || is_named_by_opener(node) => None,
        Role::Label => (!is_said(value.as_deref()) && !is_said(label.as_deref())).then_some("an empty label"),
        _ => (!is_said(label.as_deref()) && !is_said(node.data().placeholder())).then_some("no name"),
    }
}

fn faults(window: &Window, state: &str) -> BTreeSet<String> {
    let root = window.root();
    let nodes = root.children_recursive().map(|node| node.accesskit_node());
    let nodes = nodes.chain([root.accesskit_node()]).filter(|node| !node.is_hidden());
    nodes
        .filter_map(|node| {
            let what = fault(&node)?;
            let around = std::iter::successors(node.parent(), AccessKitNode::parent);
            let around = around.filter_map(|node| node.label()).next().unwrap_or_default();
            let own = node.label().or(node.value()).unwrap_or_default();
            let place = node.raw_bounds();
            Some(format!("{state}: {:?} {own:?} in {around:?} at {place:?}: {what}", node.role()))
        })
        .collect()
}

fn run(window: &mut Window, command: &str) {
    window.state_mut().run(Command::from_name(command).unwrap().clone());
    window.run_steps(4);
}

fn escape(window: &mut Window) {
    for _ in 0..2 {
        window.key_press(Key::Escape);
        window.run_steps(2);
    }
}

fn said(window: &Window, key: &str) -> String {
    window.state().texts().get(key).to_owned()
}

fn press_at(window: &mut Window, at: Pos2, button: PointerButton) {
    window.hover_at(at);
    let modifiers = egui::Modifiers::NONE;
    for pressed in [true, false] {
        window.event(Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(4);
}

/// Shows one thing after the other; `look` is called for each.
fn walk(window: &mut Window, look: &mut impl FnMut(&Window, &str)) {
    look(window, "start");
    run(window, "help.first-steps");
    look(window, "first steps");
    window.key_press(Key::F10);
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    for menu in ["File", "Edit", "Add", "View", "Lab", "Help"] {
        window.run_steps(3);
        look(window, menu);
        window.key_press(Key::ArrowRight);
    }
    escape(window);
    for pane in ["history", "problems", "audit", "compare", "measure", "materials"] {
        run(window, &format!("window.pane.{pane}"));
        look(window, pane);
    }
    run(window, "measure.vary");
    look(window, "a number to vary");
    let overs = [
        "help.manual",
        "help.shortcuts",
        "help.terms",
        "help.about",
        "file.examples",
        "picture.render",
        "file.open",
        "file.save-as",
        "window.palette",
        "measure.start",
    ];
    for command in overs {
        run(window, command);
        look(window, command);
        escape(window);
    }
    run(window, "measure.stop");
    parts(window, look);
    pixel(window, look);
    window.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    window.run_steps(2);
    run(window, "edit.rename");
    look(window, "a name being typed");
    escape(window);
    run(window, "edit.delete");
    run(window, "file.new");
    look(window, "a question");
    escape(window);
}

/// What can be selected, and the lists of the inspector.
fn parts(window: &mut Window, look: &mut impl FnMut(&Window, &str)) {
    let parts = [
        vec![ScenePart::Light(0)],
        vec![ScenePart::Material(0)],
        vec![ScenePart::Camera],
        vec![ScenePart::Environment],
        vec![ScenePart::Tracing],
        vec![ScenePart::Body(1), ScenePart::Body(2)],
        vec![ScenePart::Body(1)],
    ];
    for selected in parts {
        let state = format!("{selected:?}");
        window.state_mut().editor_mut().select_parts(selected);
        window.run_steps(3);
        look(window, &state);
    }
    let lists = window.query_all_by_role(Role::ComboBox).count();
    for list in 0..lists {
        window.query_all_by_role(Role::ComboBox).nth(list).unwrap().focus();
        window.run_steps(1);
        window.key_press(Key::Space);
        window.run_steps(3);
        look(window, &format!("list {list}"));
        escape(window);
    }
    run(window, "window.pane.outliner");
    let scene = said(window, "pane-outliner");
    let tree = window.get_by_role_and_label(Role::Tree, &scene).rect();
    press_at(window, tree.center_bottom() - egui::vec2(0.0, 6.0), PointerButton::Secondary);
    look(window, "the menu of the scene");
    escape(window);
    let middle = window.state().viewport_rect().unwrap().center();
    press_at(window, middle, PointerButton::Secondary);
    look(window, "the menu of the picture");
    escape(window);
}

/// A pixel that is looked into.
fn pixel(window: &mut Window, look: &mut impl FnMut(&Window, &str)) {
    run(window, "audit.tool");
    let rect = window.state().viewport_rect().unwrap();
    press_at(window, rect.center(), PointerButton::Primary);
    wait_until(window, "the rays of the pixel", |studio| studio.audit_rays().is_some());
    window.run_steps(3);
    look(window, "a pixel");
    run(window, "audit.release");
    run(window, "audit.tool");
}

#[test]
fn everything_has_a_role_and_a_name_in_words() {
    let mut all = BTreeSet::new();
    for language in ["english", "russian"] {
        let mut window = open(language, "four-bodies");
        walk(&mut window, &mut |window, state| all.extend(faults(window, &format!("{language}, {state}"))));
        assert_eq!(window.state().texts().missing(), Vec::<String>::new());
    }
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.into_iter().collect::<Vec<_>>().join("\n"));
}

/// A file with problems has a banner, a panel and marks of its own.
#[test]
fn what_is_told_of_a_file_with_problems_has_words_too() {
    let host = TestHost::new();
    let path: PathBuf = host.path("a.toml");
    std::fs::write(
        &path,
        "format = \"catoptric/1\"\n[[bodies]]\nshape = \"sphere\"\n[[bodies]]\nshape = \"banana\"\n",
    )
    .unwrap();
    let mut window = studio_with(host, StartDocument::File(path.clone()));
    window.run_steps(4);
    let mut all = faults(&window, "problems");
    std::fs::write(&path, "format = \"catoptric/1\"\n").unwrap();
    window.event(Event::WindowFocused(true));
    let reload = said(&window, "outside-reload");
    for _ in 0..2000 {
        window.step();
        if window.query_by_label(&reload).is_some() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(window.query_by_label(&reload).is_some(), "the change is seen");
    all.extend(faults(&window, "changed outside"));
    assert!(all.is_empty(), "{all:#?}");
}

/// The window itself is called after the document, in both languages.
#[test]
fn the_window_is_called_after_its_document() {
    let mut window = open("english", "four-bodies");
    let name = |window: &Window| window.root().accesskit_node().label().unwrap_or_default();
    assert_eq!(window.root().accesskit_node().role(), Role::Window);
    assert!(
        name(&window).contains("Four bodies") && name(&window).contains("Catoptric"),
        "{}",
        name(&window)
    );
    window.state_mut().run(WindowCommand::Language(Language::Russian));
    window.run_steps(3);
    assert!(name(&window).contains("Четыре тела"), "{}", name(&window));
}
