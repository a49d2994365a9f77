//! The studio's own dialog for files, which appears where the system has none.

use catoptric_studio::FileCommand;
use egui::Key;

use super::*;

fn type_name(harness: &mut Kit, text: &str) {
    harness.get_by_role_and_label(Role::TextInput, "Name").focus();
    harness.step();
    harness.get_by_role_and_label(Role::TextInput, "Name").type_text(text);
    harness.run_steps(3);
}

/// Opens the dialog, which lists the folder of the document.
fn open(harness: &mut Kit, command: impl Into<Command>, listed: &str) {
    run(harness, command);
    wait_for(harness, listed);
}

#[test]
fn a_file_is_found_by_typing_and_opened_with_enter() {
    let host = TestHost::new();
    for name in ["scenes", "empty"] {
        std::fs::create_dir(host.path(name)).unwrap();
    }
    std::fs::write(host.path("scenes/deep.toml"), SCENE).unwrap();
    std::fs::write(host.path("picture.png"), "no scene").unwrap();
    let (mut harness, _) = with_file(&host, SCENE);
    open(&mut harness, FileCommand::Open, "a.toml");
    assert!(has(&harness, "scenes") && !has(&harness, "picture.png"), "only what fits");
    harness.get_by_label("All files").click();
    harness.run_steps(2);
    assert!(has(&harness, "picture.png"));
    type_name(&mut harness, "scen");
    assert!(!has(&harness, "empty"), "the list is narrowed");
    harness.key_press(Key::Enter);
    wait_for(&mut harness, "deep.toml");
    harness.key_press(Key::ArrowDown);
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "the file is open", |studio| title(studio) == "deep.toml");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_typed_path_is_opened() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let other = host.path("b.toml");
    std::fs::write(&other, SCENE).unwrap();
    open(&mut harness, FileCommand::Open, "a.toml");
    type_name(&mut harness, &other.display().to_string());
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "the file is open", |studio| title(studio) == "b.toml");
}

#[test]
fn a_file_is_saved_under_a_new_name() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    open(&mut harness, FileCommand::SaveAs, "a.toml");
    // The old name is proposed, and replaced by the new one as a whole.
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    type_name(&mut harness, "c");
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "it is saved", |studio| title(studio) == "c.toml");
    assert!(read(&host.path("c.toml")).contains("\"orb\"") && read(&path) == SCENE);
}

#[test]
fn an_existing_file_is_replaced_only_after_a_question() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let other = host.path("b.toml");
    std::fs::write(&other, "theirs").unwrap();
    open(&mut harness, FileCommand::SaveAs, "b.toml");
    harness.get_by_role_and_label(Role::Button, "b.toml").click();
    harness.run_steps(2);
    press(&mut harness, "Save");
    assert!(tells(&harness, "Replace “b.toml”?"));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(has(&harness, "All files") && read(&other) == "theirs", "the dialog is still open");
    press(&mut harness, "Save");
    press(&mut harness, "Replace");
    wait_until(&mut harness, "it is saved", |studio| title(studio) == "b.toml");
    assert_eq!(read(&other), SCENE);
}

#[test]
fn folders_lead_up_and_back_and_esc_closes() {
    let host = TestHost::new();
    std::fs::create_dir(host.path("scenes")).unwrap();
    std::fs::write(host.path("scenes/deep.toml"), SCENE).unwrap();
    let mut harness = studio_with(host.clone(), StartDocument::File(host.path("scenes/deep.toml")));
    harness.run_steps(3);
    open(&mut harness, FileCommand::Open, "deep.toml");
    press(&mut harness, "Parent folder");
    wait_for(&mut harness, "scenes");
    assert!(has(&harness, "scenes") && !has(&harness, "deep.toml"));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!has(&harness, "All files"));
    // Nothing is being asked any more: the question can be asked again.
    open(&mut harness, FileCommand::Open, "deep.toml");
}

#[test]
fn a_new_folder_is_made_and_entered() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    open(&mut harness, FileCommand::SaveAs, "a.toml");
    press(&mut harness, "New folder");
    let field = |harness: &Kit| {
        harness.get_by_role_and_label(Role::TextInput, "Name of the new folder").value().unwrap_or_default()
    };
    assert_eq!(field(&harness), "New folder", "a name is proposed");
    // Its name is taken: this is said in place, and the dialog stays.
    std::fs::create_dir(host.path("New folder")).unwrap();
    harness.key_press(Key::Enter);
    wait_for(&mut harness, "There is something of this name already");
    harness.get_by_role_and_label(Role::TextInput, "Name of the new folder").type_text("mine");
    harness.run_steps(2);
    assert!(!tells(&harness, "There is something of this name already"));
    press(&mut harness, "Create");
    wait_for(&mut harness, "No matching files here");
    assert!(host.path("mine").is_dir());
    assert!(harness.query_by_role_and_label(Role::TextInput, "Name of the new folder").is_none());
    // The name of the file is typed next, and lies in the new folder.
    harness.key_press(Key::Enter);
    wait_until(&mut harness, "it is saved", is_saved);
    assert!(read(&host.path("mine/a.toml")).contains("\"orb\""));
}

#[test]
fn esc_gives_up_the_new_folder_and_not_the_dialog() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    open(&mut harness, FileCommand::Open, "a.toml");
    press(&mut harness, "New folder");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::TextInput, "Name of the new folder").is_none());
    assert!(has(&harness, "All files"), "the dialog is open");
    assert!(!host.path("New folder").exists());
}
