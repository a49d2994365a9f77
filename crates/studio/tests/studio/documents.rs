//! Scene files in the studio: nothing that was made is ever lost.

mod dialogs;
mod files;
mod foreign;
mod link;
mod outside;
mod recovery;

use std::path::{Path, PathBuf};
use std::time::Instant;

use catoptric_editor::Label;
use catoptric_studio::{
    CameraCommand, Command, DisplayCommand, FileCommand, StartDocument, Studio, WindowCommand,
};
use egui::accesskit::Role;
use egui::{ViewportCommand, ViewportEvent, ViewportId};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, deadline, studio_with, wait_until};

type Kit = Harness<'static, Studio>;

/// A scene with comments, which saving must keep.
const SCENE: &str = "\
# mine
format = \"catoptric/1\"  # the first

[[bodies]]
name = \"ball\" # round
shape = \"sphere\"
radius = 2.0
";

/// A scene file with two errors: the cube cannot be read whole, the banana not at all.
const DAMAGED: &str = "\
# mine
format = \"catoptric/1\"

[[bodies]]
name = \"ball\"
shape = \"sphere\"

[[bodies]]
name = \"box\"
shape = \"cube\"
size = \"large\"

[[bodies]]
name = \"fruit\"
shape = \"banana\"
";

/// A studio on `host` with the scene file `a.toml`.
fn with_file(host: &TestHost, text: &str) -> (Kit, PathBuf) {
    let path = host.path("a.toml");
    std::fs::write(&path, text).unwrap();
    let mut harness = studio_with(host.clone(), StartDocument::File(path.clone()));
    harness.run_steps(3);
    (harness, path)
}

/// Gives the first body another name: a change that its file shows.
fn rename(harness: &mut Kit, name: &str) {
    let editor = harness.state_mut().editor_mut();
    editor.change_body(0, Label::new("edit-rename", name), |body| name.clone_into(&mut body.name)).unwrap();
    editor.settle();
    harness.step();
}

fn first_body(harness: &Kit) -> String {
    harness.state().editor().scene().bodies.get(0).map(|body| body.name.clone()).unwrap_or_default()
}

fn run(harness: &mut Kit, command: impl Into<Command>) {
    harness.state_mut().run(command);
    harness.run_steps(3);
}

/// Presses the button of the dialog on top.
fn press(harness: &mut Kit, label: &str) {
    harness.get_all_by_role_and_label(Role::Button, label).last().unwrap().click();
    harness.run_steps(3);
}

fn has(harness: &Kit, label: &str) -> bool {
    harness.query_all_by_label(label).next().is_some()
}

/// Whether some text contains these words.
fn tells(harness: &Kit, words: &str) -> bool {
    harness.query_all_by_label_contains(words).next().is_some()
}

/// All that the window says, for the message of a test that has failed.
fn told(harness: &Kit) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes.filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value())).collect()
}

/// Steps until some text contains these words.
fn wait_for(harness: &mut Kit, words: &str) {
    let deadline = deadline();
    while !tells(harness, words) {
        assert!(Instant::now() < deadline, "waited in vain for the words \"{words}\": {:#?}", told(harness));
        harness.step();
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    harness.run_steps(2);
}

fn is_saved(studio: &Studio) -> bool {
    !studio.editor().is_changed()
}

fn title(studio: &Studio) -> String {
    studio.editor().title().to_owned()
}

/// The window manager asks the window to close; whether the window agrees.
fn closes(harness: &mut Kit) -> bool {
    let input = harness.input_mut();
    input.viewports.entry(ViewportId::ROOT).or_default().events.push(ViewportEvent::Close);
    harness.step();
    let commands = &harness.output().viewport_output[&ViewportId::ROOT].commands;
    let agrees = !commands.contains(&ViewportCommand::CancelClose);
    harness.run_steps(2);
    agrees
}

/// Steps until the studio itself asks for its window to be closed.
fn wait_for_close(harness: &mut Kit) {
    let deadline = deadline();
    while !harness.output().viewport_output[&ViewportId::ROOT].commands.contains(&ViewportCommand::Close) {
        assert!(Instant::now() < deadline, "the window was not closed: {:#?}", told(harness));
        harness.step();
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn saving_keeps_comments_and_the_file_opens_again() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    assert_eq!(first_body(&harness), "ball");
    rename(&mut harness, "orb");
    assert!(harness.state().editor().is_changed());
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the file is saved", is_saved);
    assert_eq!(read(&path), SCENE.replace("\"ball\"", "\"orb\""));
    wait_for(&mut harness, "Saved: a.toml");
    eframe::App::on_exit(harness.state_mut());
    drop(harness);

    let mut harness = studio_with(host, StartDocument::Last);
    harness.step();
    assert_eq!((title(harness.state()).as_str(), first_body(&harness).as_str()), ("a.toml", "orb"));
}

#[test]
fn save_as_asks_for_a_name_and_adds_the_extension() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    host.answer(Some(host.path("b")));
    run(&mut harness, FileCommand::SaveAs);
    wait_until(&mut harness, "b.toml is saved", |studio| title(studio) == "b.toml");
    assert_eq!(host.questions.lock().unwrap()[0].name, "a.toml");
    assert!(read(&host.path("b.toml")).contains("\"orb\"") && read(&path) == SCENE);
    assert_eq!(harness.state().settings().recent[0], host.path("b.toml"));
}

#[test]
fn an_example_is_saved_under_a_name() {
    let host = TestHost::new();
    let mut harness = studio_with(host.clone(), StartDocument::Example("whitted".to_owned()));
    harness.run_steps(2);
    host.answer(Some(host.path("mine.toml")));
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "it is saved", |studio| title(studio) == "mine.toml");
    assert_eq!(host.questions.lock().unwrap()[0].name, "whitted.toml");
    assert!(read(&host.path("mine.toml")).starts_with("# "), "the comments are kept");
}

#[test]
fn a_cancelled_question_saves_nothing() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    host.answer(None);
    run(&mut harness, FileCommand::SaveAs);
    harness.run_steps(5);
    assert!(harness.state().editor().is_changed() && title(harness.state()) == "a.toml");
}

#[test]
fn an_unchanged_scene_closes_without_a_question() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    assert!(closes(&mut harness));
}

#[test]
fn closing_with_changes_asks_and_cancel_stays() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    assert!(!closes(&mut harness));
    assert!(tells(&harness, "Save the changes to “a.toml”?"));
    // Another try asks no second time.
    assert!(!closes(&mut harness));
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert!(!tells(&harness, "Save the changes"));
    assert!(harness.state().editor().is_changed() && read(&path) == SCENE);
    assert!(!closes(&mut harness), "it is asked again");
    press(&mut harness, "Cancel");
    assert!(!tells(&harness, "Save the changes"));
}

#[test]
fn closing_with_changes_can_save_them() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    assert!(!closes(&mut harness));
    // Pressed and let go, a key makes a step of two frames; a quick save asks for the close in the first.
    harness.key_down(egui::Key::Enter);
    wait_for_close(&mut harness);
    assert!(read(&path).contains("\"orb\""));
    assert!(closes(&mut harness));
}

#[test]
fn closing_with_changes_can_drop_them() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    run(&mut harness, FileCommand::Quit);
    harness.get_by_role_and_label(Role::Button, "Don’t save").click();
    wait_for_close(&mut harness);
    assert!(closes(&mut harness));
    assert_eq!(read(&path), SCENE);
}

#[test]
fn a_new_scene_is_ready_to_work_in_and_replaces_changes_only_after_a_question() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    run(&mut harness, FileCommand::New);
    assert_eq!(first_body(&harness), "orb");
    press(&mut harness, "Don’t save");
    let scene = harness.state().editor().scene().clone();
    let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!((names, scene.lights.len()), (vec!["Plane", "Sphere"], 1));
    assert!(!harness.state().editor().is_changed() && harness.state().editor().path().is_none());
}

#[test]
fn looking_around_in_an_example_raises_no_alarm() {
    let host = TestHost::new();
    let mut harness = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    harness.run_steps(3);
    let before = harness.state().editor().scene().camera;
    run(&mut harness, CameraCommand::FrameAll);
    assert_ne!(harness.state().editor().scene().camera, before, "a render shows what is seen");
    let title = |harness: &mut Kit| {
        // The title is told when it changes.
        let mut told = None;
        for _ in 0..4 {
            for command in &harness.output().viewport_output[&ViewportId::ROOT].commands {
                if let ViewportCommand::Title(title) = command {
                    told = Some(title.clone());
                }
            }
            harness.step();
        }
        told
    };
    assert_eq!(title(&mut harness), None, "no mark");
    // Longer than it takes until changes are kept.
    let start = Instant::now();
    while start.elapsed() < std::time::Duration::from_millis(900) {
        harness.step();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(recovery::kept(&host).is_empty());
    run(&mut harness, FileCommand::OpenExample("whitted"));
    assert_eq!(harness.state().editor().title(), "whitted", "without a question");
    run(&mut harness, CameraCommand::FrameAll);
    assert!(closes(&mut harness));
    // With work under it, it is another thing.
    let mut harness = studio_with(TestHost::new(), StartDocument::Example("four-bodies".to_owned()));
    harness.run_steps(3);
    rename(&mut harness, "orb");
    assert!(title(&mut harness).is_some_and(|title| title.starts_with(['*', '•', '●'])));
    run(&mut harness, CameraCommand::FrameAll);
    assert!(!closes(&mut harness));
    assert!(has(&harness, "Don’t save"));
}

#[test]
fn turning_the_view_of_a_file_changes_the_file() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    run(&mut harness, CameraCommand::FrameAll);
    assert!(!closes(&mut harness));
    // As above.
    harness.key_down(egui::Key::Enter);
    wait_for_close(&mut harness);
    assert!(read(&path).contains("[camera]"));
}

#[test]
fn what_is_edited_while_the_file_is_written_is_not_taken_for_saved() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    harness.state_mut().run(FileCommand::Save);
    harness.step();
    rename(&mut harness, "egg");
    wait_until(&mut harness, "the first name is written", |_| read(&path).contains("\"orb\""));
    wait_until(&mut harness, "saving ends", |studio| !studio.is_saving());
    assert!(harness.state().editor().is_changed() && first_body(&harness) == "egg");
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the second name is written", is_saved);
    assert!(read(&path).contains("\"egg\""));
}

#[test]
fn what_comes_while_the_file_is_written_waits_for_it() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    for command in [FileCommand::Save, FileCommand::Save, FileCommand::New] {
        harness.state_mut().run(command);
    }
    wait_until(&mut harness, "the new scene is there", |studio| studio.editor().path().is_none());
    wait_until(&mut harness, "nothing is written any more", |studio| !studio.is_saving());
    harness.run_steps(3);
    assert!(!tells(&harness, "Save the changes"), "nothing would be lost");
    assert!(harness.state().editor().path().is_none(), "the new scene was not saved over the old one");
    assert_eq!(read(&path), SCENE.replace("\"ball\"", "\"orb\""));
}

#[test]
fn a_file_changed_by_another_program_is_replaced_only_after_a_question() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    let theirs = format!("{SCENE}# theirs\n");
    std::fs::write(&path, &theirs).unwrap();
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    assert!(tells(&harness, "Another program has changed “a.toml”"));
    press(&mut harness, "Cancel");
    assert!(read(&path) == theirs && harness.state().editor().is_changed());
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    press(&mut harness, "Replace");
    wait_until(&mut harness, "it is replaced", is_saved);
    assert_eq!(read(&path), SCENE.replace("\"ball\"", "\"orb\""));
}

#[test]
fn a_failed_saving_loses_nothing() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    host.answer(Some(host.path("no/such/folder/b.toml")));
    run(&mut harness, FileCommand::SaveAs);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    assert!(tells(&harness, "there is no folder") && tells(&harness, "Nothing is lost"));
    assert!(harness.state().editor().is_changed() && read(&path) == SCENE);
    host.answer(Some(host.path("b.toml")));
    press(&mut harness, "Save as…");
    wait_until(&mut harness, "it is saved elsewhere", is_saved);
    assert_eq!(title(harness.state()), "b.toml");
}

#[test]
fn reverting_is_one_step_that_can_be_undone() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    rename(&mut harness, "egg");
    run(&mut harness, FileCommand::Revert);
    wait_until(&mut harness, "the file is back", is_saved);
    assert_eq!(first_body(&harness), "ball");
    assert!(harness.state_mut().editor_mut().undo());
    assert_eq!(first_body(&harness), "egg");
}

#[test]
fn the_title_of_the_window_names_the_document_and_marks_changes() {
    let host = TestHost::new();
    let path = host.path("a.toml");
    std::fs::write(&path, SCENE).unwrap();
    let mut harness = studio_with(host, StartDocument::File(path));
    let titles = |harness: &Kit| {
        let commands = &harness.output().viewport_output[&ViewportId::ROOT].commands;
        commands
            .iter()
            .filter_map(|command| match command {
                ViewportCommand::Title(title) => Some(title.clone()),
                _ => None,
            })
            .collect::<Vec<_>>()
    };
    // The first frame has been drawn already.
    rename(&mut harness, "orb");
    assert_eq!(titles(&harness), ["● a.toml — Catoptric"]);
    harness.step();
    assert!(titles(&harness).is_empty(), "it is said only once");
    assert!(harness.state_mut().editor_mut().undo());
    harness.step();
    assert_eq!(titles(&harness), ["a.toml — Catoptric"]);
}

#[test]
fn settings_survive_a_restart() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    run(&mut harness, WindowCommand::Language(catoptric_studio::Language::Russian));
    run(&mut harness, DisplayCommand::ToggleGrid);
    eframe::App::on_exit(harness.state_mut());
    drop(harness);
    let mut harness = studio_with(host, StartDocument::Last);
    harness.step();
    let settings = harness.state().settings();
    assert_eq!(settings.language, catoptric_studio::Language::Russian);
    assert_eq!((settings.shows_grid, settings.recent.as_slice()), (false, [path].as_slice()));
    assert_eq!(title(harness.state()), "a.toml");
}

#[test]
fn settings_are_written_while_the_studio_runs() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    run(&mut harness, DisplayCommand::ToggleGrid);
    let settings = host.path("settings.json");
    wait_until(&mut harness, "the settings are written", |_| {
        read(&settings).contains("\"shows_grid\": false")
    });
}

#[test]
fn a_missing_last_scene_gives_way_to_an_example() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    eframe::App::on_exit(harness.state_mut());
    drop(harness);
    std::fs::remove_file(path).unwrap();
    let mut harness = studio_with(host, StartDocument::Last);
    harness.run_steps(3);
    assert_eq!(title(harness.state()), "four-bodies");
    assert!(tells(&harness, "There is no file"));
    assert!(harness.state().settings().recent.is_empty());
}
