//! What is left when the studio does not end well.

use catoptric_studio::FileCommand;
use std::process::Stdio;

use catoptric_editor::Action;

use super::*;

const CHILD: &str = "CATOPTRIC_TEST_CHILD_FOLDER";

/// The documents that are kept against a crash.
pub(super) fn kept(host: &TestHost) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(host.path("recovery")) else { return Vec::new() };
    entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| read(&path))
        .collect()
}

fn wait_until_kept(harness: &mut Kit, host: &TestHost, name: &str) {
    let name = format!("\"{name}\"");
    wait_until(harness, "the changes are kept", |_| kept(host).iter().any(|text| text.contains(&name)));
}

#[test]
fn changes_are_kept_until_they_are_saved_or_taken_back() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    assert!(kept(&host).is_empty());
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    assert!(harness.state_mut().editor_mut().undo());
    wait_until(&mut harness, "nothing is kept", |_| kept(&host).is_empty());
    rename(&mut harness, "egg");
    wait_until_kept(&mut harness, &host, "egg");
    assert_eq!(read(&path), SCENE, "the file itself is left alone");
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "nothing is kept", |_| kept(&host).is_empty());
    drop(harness);
    assert!(kept(&host).is_empty());
}

#[test]
fn a_document_without_a_file_is_kept_with_whole_paths_of_pictures() {
    let host = TestHost::new();
    let mut harness = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    let text = "format = 'catoptric/1'\n[[bodies]]\nmaterial = { texture = 'wood.png' }\n";
    harness.state_mut().editor_mut().apply(Action::Paste(text.to_owned())).unwrap();
    let whole = std::env::current_dir().unwrap().join("wood.png");
    let whole = format!("\"{}\"", whole.display());
    wait_until(&mut harness, "it is kept", |_| kept(&host).iter().any(|text| text.contains(&whole)));
}

#[test]
fn a_crash_leaves_the_changes_and_the_next_studio_offers_them() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    // Gone without a word.
    drop(harness);

    let mut harness = studio_with(host.clone(), StartDocument::File(path.clone()));
    wait_for_offer(&mut harness);
    assert!(has(&harness, "a.toml") && tells(&harness, "just now"));
    assert!(tells(&harness, &path.display().to_string()));
    press(&mut harness, "Decide later");
    assert_eq!(first_body(&harness), "ball");
    drop(harness);

    let mut harness = studio_with(host.clone(), StartDocument::File(path.clone()));
    wait_for_offer(&mut harness);
    press(&mut harness, "Restore: a.toml");
    wait_until(&mut harness, "it is restored", |studio| studio.editor().is_changed());
    assert_eq!(
        (first_body(&harness).as_str(), harness.state().editor().path()),
        ("orb", Some(path.as_path()))
    );
    // It is never without a copy on the disk: first the new one, then the old one goes.
    wait_until(&mut harness, "it is kept once", |_| {
        let kept = kept(&host);
        assert!(!kept.is_empty());
        kept.len() == 1
    });
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "it is saved", is_saved);
    assert_eq!(read(&path), SCENE.replace("\"ball\"", "\"orb\""));
    wait_until(&mut harness, "nothing is kept", |_| kept(&host).is_empty());
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_restored_scene_survives_another_crash_at_once() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    drop(harness);
    let mut harness = studio_with(host.clone(), StartDocument::File(path.clone()));
    wait_for_offer(&mut harness);
    press(&mut harness, "Restore: a.toml");
    wait_until(&mut harness, "it is restored", |studio| studio.editor().is_changed());
    drop(harness);
    assert!(!kept(&host).is_empty());
    let mut harness = studio_with(host, StartDocument::File(path));
    wait_for_offer(&mut harness);
}

#[test]
fn a_restored_scene_does_not_replace_a_newer_file_unasked() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    drop(harness);
    // Clocks of file systems are coarse.
    std::thread::sleep(std::time::Duration::from_millis(50));
    std::fs::write(&path, format!("{SCENE}# newer\n")).unwrap();
    let mut harness = studio_with(host, StartDocument::File(path.clone()));
    wait_for_offer(&mut harness);
    press(&mut harness, "Restore: a.toml");
    wait_until(&mut harness, "it is restored", |studio| studio.editor().is_changed());
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    assert!(tells(&harness, "Another program has changed") && read(&path).ends_with("# newer\n"));
}

#[test]
fn a_restored_part_does_not_replace_the_whole_file_unasked() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, DAMAGED);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    drop(harness);
    let mut harness = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    wait_for_offer(&mut harness);
    press(&mut harness, "Restore: a.toml");
    wait_until(&mut harness, "it is restored", |studio| studio.editor().is_changed());
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    assert!(has(&harness, "Replace") && read(&path) == DAMAGED);
}

#[test]
fn what_could_not_be_kept_is_tried_again() {
    let host = TestHost::new();
    std::fs::write(host.path("recovery"), "no folder").unwrap();
    let (mut harness, _) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_for(&mut harness, "cannot be kept against a crash");
    std::fs::remove_file(host.path("recovery")).unwrap();
    wait_until_kept(&mut harness, &host, "orb");
}

#[test]
fn what_is_not_wanted_is_discarded_after_a_question() {
    let host = TestHost::new();
    let (mut harness, path) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    drop(harness);
    let mut harness = studio_with(host.clone(), StartDocument::File(path.clone()));
    wait_for_offer(&mut harness);
    press(&mut harness, "Discard: a.toml");
    press(&mut harness, "Cancel");
    assert_eq!(kept(&host).len(), 1);
    press(&mut harness, "Discard: a.toml");
    press(&mut harness, "Discard");
    wait_until(&mut harness, "it is gone", |_| kept(&host).is_empty());
    harness.run_steps(2);
    assert!(!tells(&harness, "Unsaved work was found"), "nothing is left to offer");
}

#[test]
fn leaving_without_saving_on_purpose_keeps_nothing() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    rename(&mut harness, "orb");
    wait_until_kept(&mut harness, &host, "orb");
    run(&mut harness, FileCommand::Quit);
    press(&mut harness, "Don’t save");
    eframe::App::on_exit(harness.state_mut());
    drop(harness);
    assert!(kept(&host).is_empty());
}

fn wait_for_offer(harness: &mut Kit) {
    wait_for(harness, "Unsaved work was found");
}

/// Not a test by itself: a studio that edits for ever, to be killed.
#[test]
fn child_that_edits_for_ever() {
    let Some(folder) = std::env::var_os(CHILD) else { return };
    let host = TestHost::at(Path::new(&folder));
    let (mut harness, _) = with_file(&host, SCENE);
    for edit in 0.. {
        rename(&mut harness, &format!("edit {edit}"));
        std::fs::write(host.path("edits"), edit.to_string()).unwrap();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

#[test]
fn a_killed_studio_loses_at_most_the_last_seconds() {
    let host = TestHost::new();
    let mut child = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["documents::recovery::child_that_edits_for_ever", "--exact", "--nocapture"])
        .env(CHILD, host.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // Long enough for several savings, then at any moment.
    let number = |text: &str| text.split("edit ").nth(1)?.split('"').next()?.parse::<u32>().ok();
    let deadline = Instant::now() + std::time::Duration::from_secs(60);
    while kept(&host).first().and_then(|text| number(text)).is_none_or(|edit| edit == 0) {
        assert!(Instant::now() < deadline, "nothing is kept");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();

    assert_eq!(read(&host.path("a.toml")), SCENE, "the file itself is whole");
    let mut harness = studio_with(host.clone(), StartDocument::Last);
    wait_for_offer(&mut harness);
    press(&mut harness, "Restore: a.toml");
    wait_until(&mut harness, "it is restored", |studio| studio.editor().is_changed());
    let restored = first_body(&harness);
    assert!(restored.starts_with("edit "), "{restored}");
}
