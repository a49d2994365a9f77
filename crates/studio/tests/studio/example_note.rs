//! The note below the picture: what to notice in an example.

use catoptric_scene::Example;
use catoptric_studio::{Command, FileCommand, HelpCommand, Pane, StartDocument, Studio};
use egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use crate::kit::{TestHost, studio, studio_with, wait_until};

type Kit = Harness<'static, Studio>;

const NOTE: &str = "Four bodies: what to notice";

fn has(harness: &Kit, words: &str) -> bool {
    harness.query_all_by_label_contains(words).next().is_some()
}

fn run(harness: &mut Kit, command: impl Into<Command>) {
    harness.state_mut().run(command);
    harness.run_steps(4);
}

#[test]
fn an_example_says_what_to_notice_until_the_note_is_closed_and_again_when_asked() {
    let mut harness = studio();
    harness.run_steps(4);
    assert!(has(&harness, NOTE) && has(&harness, "Four exact bodies"));
    harness.get_by_label("Close the note").click();
    harness.run_steps(3);
    assert!(!has(&harness, NOTE));
    // It is remembered for the document, whatever is done to it.
    harness.state_mut().editor_mut().select_parts([catoptric_scene::ScenePart::Body(1)]);
    run(&mut harness, Command::Edit(catoptric_editor::Action::Duplicate));
    assert!(!has(&harness, NOTE));
    run(&mut harness, HelpCommand::ExampleNote);
    assert!(has(&harness, NOTE));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!has(&harness, NOTE));
    // Another example has its own.
    run(&mut harness, FileCommand::New);
    harness.get_by_label("Don’t save").click();
    harness.run_steps(3);
    assert!(!has(&harness, "what to notice"));
    run(&mut harness, FileCommand::OpenExample("whitted"));
    assert!(has(&harness, "what to notice"));
}

#[test]
fn esc_is_for_what_is_being_done_before_it_is_for_the_note() {
    let mut harness = studio();
    harness.run_steps(4);
    harness.get_by_label("Filter by name").focus();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(has(&harness, NOTE), "the field was left");
    harness.get_by_label("File").click();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(has(&harness, NOTE), "the menu was closed");
    run(&mut harness, HelpCommand::About);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(has(&harness, NOTE), "the explanations were closed");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!has(&harness, NOTE));
}

#[test]
fn the_note_lies_beside_the_picture_and_makes_way_in_a_small_window() {
    let mut harness = studio();
    for name in Example::ALL.iter().map(|example| example.name) {
        run(&mut harness, FileCommand::OpenExample(name));
        let pane = harness.state().pane_rect(Pane::Viewport).unwrap();
        let picture = harness.state().viewport_rect().unwrap();
        let note = harness.get_by_label_contains("what to notice").rect();
        assert!(pane.contains_rect(note) && !picture.intersects(note), "{name}: {note} {picture}");
        assert!(picture.height() > 0.6 * pane.height(), "{name}: {picture} of {pane}");
    }
    harness.set_size(egui::vec2(800.0, 380.0));
    harness.run_steps(4);
    assert!(!has(&harness, "what to notice"));
    // There is no room, but it can be read.
    run(&mut harness, HelpCommand::ExampleNote);
    assert!(has(&harness, "what to notice"));
    harness.get_by_label("OK").click();
    harness.run_steps(3);
    assert!(!has(&harness, "what to notice"));
}

#[test]
fn a_saved_example_keeps_its_note_and_a_file_has_none() {
    let host = TestHost::new();
    let mut harness = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    harness.run_steps(3);
    host.answer(Some(host.path("mine.toml")));
    run(&mut harness, FileCommand::SaveAs);
    wait_until(&mut harness, "it is saved", |studio| studio.editor().title() == "mine.toml");
    harness.run_steps(3);
    assert!(has(&harness, NOTE));
    drop(harness);
    let mut harness = studio_with(host.clone(), StartDocument::File(host.path("mine.toml")));
    harness.run_steps(3);
    assert!(!has(&harness, "what to notice"));
}
