//! Opening: files with problems, what cannot be opened, recent and dropped files, the examples.

use std::path::Path;
use std::sync::Arc;

use catoptric_studio::{FileCommand, Language, WindowCommand};
use egui::{DroppedFile, Key};
use egui_kittest::kittest::NodeT as _;

use super::*;

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_files(harness: &mut Kit, paths: &[PathBuf]) {
    let files = paths.iter().map(|path| Arc::new(Dropped(path.clone())) as _);
    harness.input_mut().dropped_files = files.collect();
    harness.run_steps(3);
}

#[test]
fn the_good_part_of_a_damaged_file_opens_and_its_problems_are_listed() {
    let (mut harness, _) = with_file(&TestHost::new(), DAMAGED);
    let names: Vec<String> =
        harness.state().editor().scene().bodies.iter().map(|body| body.name.clone()).collect();
    assert_eq!(names, ["ball", "box"]);
    assert!(tells(&harness, "The file has 2 problems; what could be read is open."));
    assert!(tells(&harness, "2 problems in a.toml"));
    assert!(tells(&harness, "line 11, column 8: error"), "the size");
    assert!(tells(&harness, "line 15, column 9: error"), "the shape");
    // The text of the file is shown beside, with the line of the selected problem.
    assert!(tells(&harness, "size = \"large\""));
    harness.get_all_by_label_contains("line 15, column 9").last().unwrap().click();
    harness.run_steps(3);
    assert!(tells(&harness, "shape = \"banana\""));
    press(&mut harness, "Dismiss");
    assert!(!tells(&harness, "what could be read is open") && tells(&harness, "2 problems in a.toml"));
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_partly_read_file_is_replaced_only_after_a_question() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, DAMAGED);
    rename(&mut harness, "orb");
    run(&mut harness, FileCommand::Save);
    assert!(tells(&harness, "Only a part of “a.toml” is open"));
    press(&mut harness, "Cancel");
    assert_eq!(read(&path), DAMAGED);
    // The proposed answer is another name.
    run(&mut harness, FileCommand::Save);
    host.answer(Some(host.path("b.toml")));
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "it is saved elsewhere", is_saved);
    assert_eq!((title(harness.state()).as_str(), read(&path).as_str()), ("b.toml", DAMAGED));
    harness.run_steps(2);
    assert!(!tells(&harness, "2 problems"), "the new file has none");
    // From now on it is a file like others.
    rename(&mut harness, "egg");
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "it is saved", is_saved);
}

#[test]
fn warnings_are_listed_too() {
    let text =
        format!("{SCENE}\n[materials.unused]\ncolor = [1, 0, 0]\n[materials.unused.checker]\nsise = 2\n");
    let host = TestHost::new();
    let (harness, _) = with_file(&host, &text);
    assert!(tells(&harness, "in a.toml"), "there is a finding");
}

/// The findings of the panel, each as its button is called.
fn findings(harness: &Kit) -> Vec<String> {
    let buttons =
        harness.query_all_by_role(Role::Button).filter_map(|button| button.accesskit_node().label());
    let is_finding = |label: &String| label.contains(": error: ") || label.contains(": ошибка: ");
    buttons.filter(is_finding).collect()
}

#[test]
fn findings_are_told_in_the_language_of_the_window() {
    let (mut harness, _) = with_file(&TestHost::new(), DAMAGED);
    assert_eq!(
        findings(&harness),
        [
            "line 11, column 8: error: `size` is a text, but must be a number or three numbers",
            "line 15, column 9: error: `shape` is `banana`, but must be \"sphere\", \"cube\", \"cylinder\", \
             \"cone\", \"paraboloid\", \"plane\", \"lens\", \"mirror-dish\", \"tube\", \"ring\", \"bowl\", \
             \"prism\", \"wedge\", \"open-cylinder\", \"open-cone\", \"disc\", \"rectangle\", \"triangle\", \
             \"union\", \"intersection\", \"difference\", \"surface\" or \"group\"",
        ]
    );
    // The same findings, in the other language, without reading the file again.
    run(&mut harness, WindowCommand::Language(Language::Russian));
    assert_eq!(
        findings(&harness),
        [
            "строка 11, столбец 8: ошибка: `size` — текст, а ожидается число или три числа",
            "строка 15, столбец 9: ошибка: `shape` — `banana`, а ожидается \"sphere\", \"cube\", \"cylinder\", \
             \"cone\", \"paraboloid\", \"plane\", \"lens\", \"mirror-dish\", \"tube\", \"ring\", \"bowl\", \
             \"prism\", \"wedge\", \"open-cylinder\", \"open-cone\", \"disc\", \"rectangle\", \"triangle\", \
             \"union\", \"intersection\", \"difference\", \"surface\" или \"group\"",
        ]
    );
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_file_without_a_scene_is_refused_in_the_language_of_the_window() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    run(&mut harness, WindowCommand::Language(Language::Russian));
    std::fs::write(host.path("other.toml"), "[package]\nname = 'x'\n").unwrap();
    run(&mut harness, FileCommand::OpenFile(host.path("other.toml")));
    wait_until(&mut harness, "the file is refused", |studio| !studio.is_opening());
    harness.run_steps(2);
    assert!(tells(&harness, "1:2: ошибка: у сцены нет ключа `package`"));
}

#[test]
fn what_cannot_be_opened_leaves_the_open_document() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    std::fs::write(host.path("bytes.toml"), [0xff_u8, 0xfe, 0]).unwrap();
    std::fs::write(host.path("other.toml"), "[package]\nname = 'x'\n").unwrap();
    let folder = host.path("folder.toml");
    std::fs::create_dir(&folder).unwrap();
    for (name, words) in [
        ("missing.toml", "There is no file"),
        ("bytes.toml", "the file is not UTF-8 text"),
        ("other.toml", "There is no scene in"),
        ("folder.toml", "is a folder"),
    ] {
        run(&mut harness, FileCommand::OpenFile(host.path(name)));
        wait_until(&mut harness, "the file is refused", |studio| !studio.is_opening());
        harness.run_steps(2);
        assert!(tells(&harness, words), "{name}");
        assert_eq!((title(harness.state()).as_str(), first_body(&harness).as_str()), ("a.toml", "ball"));
        press(&mut harness, "OK");
        assert!(!tells(&harness, words), "{name}");
    }
}

#[test]
fn a_recent_file_opens_and_a_missing_one_leaves_the_list() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    let other = host.path("b.toml");
    std::fs::write(&other, SCENE).unwrap();
    run(&mut harness, FileCommand::OpenFile(other.clone()));
    wait_until(&mut harness, "b is open", |studio| title(studio) == "b.toml");
    assert_eq!(harness.state().settings().recent, [other.clone(), path.clone()]);
    std::fs::remove_file(&path).unwrap();
    run(&mut harness, FileCommand::OpenFile(path));
    wait_until(&mut harness, "it is refused", |studio| !studio.is_opening());
    harness.run_steps(2);
    assert!(tells(&harness, "There is no file"));
    assert_eq!(harness.state().settings().recent, [other]);
}

#[test]
fn a_dropped_scene_opens_after_the_question_about_changes() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let other = host.path("b.toml");
    std::fs::write(&other, SCENE).unwrap();
    drop_files(&mut harness, &[host.path("letter.txt")]);
    assert!(tells(&harness, "Only scene files"));
    drop_files(&mut harness, &[host.path("picture.png"), other.clone(), host.path("c.toml")]);
    wait_until(&mut harness, "b is open", |studio| title(studio) == "b.toml");
    rename(&mut harness, "orb");
    drop_files(&mut harness, &[host.path("a.toml")]);
    wait_for(&mut harness, "Save the changes to “b.toml”?");
    press(&mut harness, "Don’t save");
    assert_eq!((title(harness.state()).as_str(), read(&other).as_str()), ("a.toml", SCENE));
}

#[test]
fn a_dropped_picture_becomes_the_surroundings() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let picture = catoptric_picture::Picture::from_fn(2, 1, |x, _| [x as f32; 3]).unwrap();
    catoptric_picture::write_exr(&host.path("sky.exr"), &picture).unwrap();
    drop_files(&mut harness, &[host.path("sky.exr")]);
    let surroundings = |studio: &Studio| studio.editor().scene().environment.surroundings.clone();
    wait_until(&mut harness, "it is there", |studio| {
        surroundings(studio).picture().is_some_and(|image| image.pixels().is_some())
    });
    assert_eq!(surroundings(harness.state()).picture().unwrap().path(), "sky.exr");
    assert!(harness.state().editor().is_changed());
}

#[test]
fn a_document_that_is_opened_again_after_saving_shows_what_was_saved() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    run(&mut harness, FileCommand::OpenFile(path));
    wait_for(&mut harness, "Save the changes to “a.toml”?");
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "it is saved and open again", |studio| {
        !studio.is_saving() && !studio.is_opening() && studio.editor().steps().len() == 0
    });
    assert_eq!((first_body(&harness).as_str(), harness.state().editor().is_changed()), ("orb", false));
}

#[test]
fn an_example_is_found_in_the_gallery_and_opened_by_keys() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    run(&mut harness, FileCommand::Examples);
    assert!(has(&harness, "Four bodies"));
    harness.get_by_role_and_label(Role::SearchInput, "Search the examples").type_text("whitted");
    harness.run_steps(3);
    assert!(!has(&harness, "Four bodies"));
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(title(harness.state()), "whitted");
    assert!(!tells(&harness, "Search the examples"), "the gallery is closed");
}

#[test]
fn the_arrow_keys_walk_through_the_gallery_and_a_click_opens() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    run(&mut harness, FileCommand::Examples);
    harness.key_press(Key::ArrowRight);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(title(harness.state()), catoptric_scene::Example::ALL[1].name);
    run(&mut harness, FileCommand::Examples);
    press(&mut harness, "Four bodies");
    assert_eq!(title(harness.state()), "four-bodies");
    run(&mut harness, FileCommand::Examples);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!tells(&harness, "Search the examples"));
}

#[test]
fn a_file_that_was_being_read_while_the_scene_changed_is_shown_after_a_question() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let other = host.path("b.toml");
    // Long enough to be read for a while.
    let mut text = SCENE.to_owned();
    for index in 0..20_000 {
        text += &format!("[[bodies]]\nname = \"b{index}\"\nshape = \"sphere\"\nposition = [{index}, 0, 0]\n");
    }
    std::fs::write(&other, text).unwrap();
    harness.state_mut().run(FileCommand::OpenFile(other));
    harness.step();
    rename(&mut harness, "orb");
    wait_until(&mut harness, "the file has been read", |studio| !studio.is_opening());
    harness.run_steps(2);
    assert_eq!(title(harness.state()), "a.toml");
    press(&mut harness, "Cancel");
    assert_eq!((title(harness.state()).as_str(), first_body(&harness).as_str()), ("a.toml", "orb"));
}

#[test]
fn an_unused_material_opens_without_alarm_and_is_a_note() {
    let (mut harness, _) =
        with_file(&TestHost::new(), &format!("{SCENE}\n[materials.spare]\ncolor = [1, 0, 0]\n"));
    assert!(!tells(&harness, "warning") && !tells(&harness, "is not used"), "no banner, no panel");
    run(&mut harness, WindowCommand::TogglePane(catoptric_studio::Pane::Problems));
    assert!(tells(&harness, "1 note on a.toml"));
    assert!(tells(&harness, "note: the material `spare` is not used"));
}

#[test]
fn a_note_beside_a_warning_is_not_counted_as_one() {
    let text = format!("{SCENE}\n[materials.spare]\ncolor = [1, 0, 0]\n[environment]\nambient = [0, 0, 0]\n");
    let (harness, _) = with_file(&TestHost::new(), &text);
    assert!(tells(&harness, "there is 1 warning about it"));
    assert!(tells(&harness, "2 problems in a.toml"));
}

#[test]
fn the_second_click_of_a_double_click_stays_in_the_gallery() {
    let (mut harness, _) = with_file(&TestHost::new(), SCENE);
    run(&mut harness, FileCommand::Examples);
    let at = harness.get_by_role_and_label(Role::Button, "Four bodies").rect().center();
    let button = |pressed| egui::Event::PointerButton {
        pos: at,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    harness.hover_at(at);
    for pressed in [true, false, true, false] {
        harness.event(button(pressed));
        harness.step();
    }
    harness.run_steps(3);
    assert_eq!(title(harness.state()), "four-bodies");
    let viewport = harness.state().viewport_rect().unwrap();
    assert!(viewport.contains(at), "the second click would reach the picture");
    assert!(harness.state().editor().selection().is_empty(), "and nothing is selected");
    // Later clicks reach it, once the scene is prepared.
    wait_until(&mut harness, "the scene is prepared", |studio| {
        let revision = studio.editor().revision();
        studio.live().render_scene().is_some_and(|(prepared, _)| prepared == revision)
    });
    harness.run_steps(40);
    for pressed in [true, false] {
        harness.event(button(pressed));
        harness.step();
    }
    harness.run_steps(2);
    assert!(!harness.state().editor().selection().is_empty(), "a body is there");
}
