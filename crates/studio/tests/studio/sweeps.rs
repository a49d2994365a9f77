//! Numbers of the scene in the panel of the measurement: their addresses, ranges, and what the pictures answer.

use catoptric_editor::{Action, PartPath, Selection};
use catoptric_scene::{ScenePart, ShapeKind};
use catoptric_studio::{Command, MeasureCommand, StartDocument, Studio};
use egui::accesskit::Role;
use egui::{Key, Modifiers, OutputCommand};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};

use crate::kit::{TestHost, studio_with, wait_until};

fn open(language: &str) -> Harness<'static, Studio> {
    let host = TestHost::new();
    let text = format!(r#"{{"language": "{language}", "is_hint_dismissed": true, "viewport_samples": 1}}"#);
    std::fs::write(host.path("settings.json"), text).unwrap();
    let mut harness = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    harness.set_size(egui::vec2(1280.0, 1200.0));
    wait_until(&mut harness, "a picture", |studio| studio.live().latest().is_some());
    harness
}

fn said(harness: &Harness<'static, Studio>, key: &str) -> String {
    harness.state().texts().get(key).to_owned()
}

fn run(harness: &mut Harness<'static, Studio>, act: MeasureCommand) {
    harness.state_mut().run(Command::Measure(act));
    harness.run_steps(3);
}

/// The text of a field, found by its message.
fn text_of(harness: &Harness<'static, Studio>, key: &str) -> String {
    harness.get_by_label(&said(harness, key)).accesskit_node().value().unwrap()
}

fn retype(harness: &mut Harness<'static, Studio>, label: &str, text: &str) {
    harness.get_by_label(label).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_label(label).type_text(text);
    harness.run_steps(3);
}

/// Types into a number field and takes it.
fn enter(harness: &mut Harness<'static, Studio>, label: &str, number: &str) {
    retype(harness, label, number);
    harness.key_press(Key::Enter);
    harness.run_steps(2);
}

fn has_words(harness: &Harness<'static, Studio>, words: &str) -> bool {
    harness.query_all_by_label_contains(words).next().is_some()
}

/// What was copied in the last frame.
fn copied(harness: &Harness<'static, Studio>) -> Option<String> {
    harness.output().platform_output.commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

#[test]
fn a_number_of_the_scene_is_typed_swept_and_read() {
    for language in ["english", "russian"] {
        let mut harness = open(language);
        let before = harness.state().editor().scene().clone();
        run(&mut harness, MeasureCommand::Vary(None));
        let address = said(&harness, "measure-address");
        assert!(harness.get_by_label(&address).is_focused(), "the address is typed at once");
        harness.get_by_label(&address).type_text("light intens");
        harness.run_steps(3);
        assert!(has_words(&harness, "lights.fill.intensity"), "addresses are suggested");
        harness.key_press(Key::ArrowDown);
        harness.run_steps(1);
        harness.key_press(Key::ArrowUp);
        harness.run_steps(1);
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        let chosen = text_of(&harness, "measure-address");
        assert!(chosen.starts_with("lights.") && chosen.ends_with(".intensity"), "{chosen}");
        retype(&mut harness, &address, "lights.0.intensity");
        // Escape closes the list and leaves what was typed.
        harness.key_press(Key::Escape);
        harness.run_steps(2);
        assert_eq!(text_of(&harness, "measure-address"), "lights.0.intensity");
        let [from, to] = ["measure-from-name", "measure-to-name"].map(|key| said(&harness, key));
        enter(&mut harness, &from, "0");
        enter(&mut harness, &to, "2");
        let steps = said(&harness, "measure-steps");
        for (label, number) in [(steps, "3"), (said(&harness, "measure-rounds"), "1")] {
            let is_field = |node: &Node<'_>| node.accesskit_node().role() != Role::Label;
            harness.get_all_by_label(&label).rfind(is_field).unwrap().focus();
            harness.run_steps(2);
            harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
            harness.run_steps(1);
            for letter in number.chars() {
                harness.event(egui::Event::Text(letter.to_string()));
            }
            harness.run_steps(1);
            harness.key_press(Key::Enter);
            harness.run_steps(2);
        }
        for key in
            ["measure-answer-mean", "measure-answer-pixel", "measure-answer-flip", "measure-answer-rays"]
        {
            harness.get_by_label(&said(&harness, key)).click();
            harness.run_steps(2);
        }
        run(&mut harness, MeasureCommand::Start);
        assert!(harness.state().is_measuring());
        wait_until(&mut harness, "the end of the measurement", |studio| !studio.is_measuring());
        assert_eq!(**harness.state().editor().scene(), *before, "the scene is as it was");
        check_answers(&mut harness, language);
        harness.state_mut().run(Command::Measure(MeasureCommand::Copy));
        let mut table = None;
        for _ in 0..4 {
            harness.step();
            table = table.or_else(|| copied(&harness));
        }
        let table = table.unwrap();
        assert!(table.starts_with("lights.0.intensity,drawn_method,"), "{table}");
        assert!(table.lines().count() == 4 && table.contains(",mean_luminance,"), "{table}");
        assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
    }
}

/// The table of each answer has a row for each value, and more light gives more.
fn check_answers(harness: &mut Harness<'static, Studio>, language: &str) {
    let table = format!("{}: {}", said(harness, "measure-part"), said(harness, "measure-part-table"));
    harness.get_by_label(&table).click();
    harness.run_steps(3);
    let figures = match language {
        "russian" => ["Время", "Средний свет", "Пиксель 160, 90", "FLIP", "Лучи"],
        _ => ["Time", "Mean light", "Pixel 160, 90", "FLIP", "Rays"],
    };
    for figure in figures {
        let choice = format!("{}: {figure}", said(harness, "measure-figure"));
        harness.get_by_label(&choice).click();
        harness.run_steps(3);
        let labels = harness.get_all_by_role(Role::Label);
        let cells: Vec<String> = labels.filter_map(|node| node.accesskit_node().value()).collect();
        let head = cells.iter().position(|cell| cell == "lights.0.intensity").unwrap();
        let numbers: Vec<f64> = cells[head..]
            .iter()
            .filter_map(|cell| cell.replace(',', ".").replace('\u{a0}', "").parse().ok())
            .collect();
        let columns = match figure {
            "FLIP" => 2,
            "Лучи" | "Rays" => 6,
            "Время" | "Time" => continue,
            _ => 5,
        };
        let rows: Vec<&[f64]> = numbers.chunks_exact(columns).take(3).collect();
        assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), [0.0, 1.0, 2.0], "{figure}: {cells:?}");
        let last: Vec<f64> = rows.iter().map(|row| row[columns - 1]).collect();
        let grows = last.windows(2).all(|pair| pair[0] <= pair[1]) && last[2] > 0.0;
        assert!(grows, "{figure}: {rows:?}");
        if columns == 2 {
            assert_eq!(last[0], 0.0, "the first picture is compared with itself");
        }
    }
}

#[test]
fn what_cannot_be_varied_is_said_beside_the_field() {
    let mut harness = open("english");
    run(&mut harness, MeasureCommand::Vary(None));
    let address = said(&harness, "measure-address");
    assert!(has_words(&harness, &said(&harness, "measure-address-empty")));
    for (text, words) in [
        ("bodies.sphere.radios", "radius"),
        ("bodies.nobody.radius", "nobody"),
        ("camera..fov", "not the address"),
        ("bodies.0.shape", "is no number"),
        ("camera.position", "is no number"),
    ] {
        retype(&mut harness, &address, text);
        harness.key_press(Key::Escape);
        harness.run_steps(2);
        assert!(has_words(&harness, words), "{text}");
        run(&mut harness, MeasureCommand::Start);
        assert!(!harness.state().is_measuring(), "{text}");
    }
    retype(&mut harness, &address, "camera.fov");
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    let [from, to] = ["measure-from-name", "measure-to-name"].map(|key| said(&harness, key));
    enter(&mut harness, &from, "30");
    // What the scene cannot have is not taken.
    enter(&mut harness, &to, "500");
    assert!(has_words(&harness, "179.9"));
    enter(&mut harness, &to, "30");
    assert!(has_words(&harness, &said(&harness, "measure-range-empty")));
    run(&mut harness, MeasureCommand::Start);
    assert!(!harness.state().is_measuring());
    retype(&mut harness, &address, "camera.position.z");
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(!has_words(&harness, &said(&harness, "measure-range-empty")), "another number, another range");
}

#[test]
fn a_number_of_the_inspector_is_varied_by_its_menu() {
    let mut harness = open("english");
    harness.state_mut().editor_mut().select_parts([ScenePart::Camera]);
    harness.run_steps(3);
    harness.get_all_by_label("Position Y").last().unwrap().click_secondary();
    harness.run_steps(3);
    harness.get_by_label(&said(&harness, "command-measure-vary")).click();
    harness.run_steps(4);
    assert_eq!(text_of(&harness, "measure-address"), "camera.position.y");
    assert_eq!(harness.state().editor().undo_label(), None, "the document is not changed");
    // The address is copied, too.
    harness.get_all_by_label("Position Y").last().unwrap().click_secondary();
    harness.run_steps(3);
    harness.get_by_label(&said(&harness, "copy-address")).click();
    let mut found = None;
    for _ in 0..4 {
        harness.step();
        found = found.or_else(|| copied(&harness));
    }
    assert_eq!(found.as_deref(), Some("camera.position.y"));
}

#[test]
fn a_number_of_a_part_is_varied_by_its_menu() {
    let mut harness = open("english");
    let editor = harness.state_mut().editor_mut();
    editor.select_parts([1, 2].map(ScenePart::Body));
    editor.apply(Action::Join { shape: ShapeKind::Difference, name: "whole".to_owned() }).unwrap();
    let whole = editor.edited().item(ScenePart::Body(1)).unwrap();
    editor.select(Selection::of_part(whole, PartPath::by([1]).unwrap()));
    harness.run_steps(3);
    for (label, address) in
        [("Position Y", "bodies.whole.parts.cube.position.y"), ("Size X", "bodies.whole.parts.cube.size.x")]
    {
        harness.get_all_by_label(label).last().unwrap().click_secondary();
        harness.run_steps(3);
        harness.get_by_label(&said(&harness, "command-measure-vary")).click();
        harness.run_steps(4);
        assert_eq!(text_of(&harness, "measure-address"), address);
    }
}
