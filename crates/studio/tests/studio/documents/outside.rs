//! Another program changes the file of the open document.

use super::*;
use catoptric_studio::FileCommand;

const CHANGED: &str = "Another program has changed “a.toml”";

fn theirs() -> String {
    SCENE.replace("\"ball\"", "\"theirs\"")
}

/// The window gets the focus, as when a person comes back from the other program.
fn focus(harness: &mut Kit) {
    harness.event(egui::Event::WindowFocused(true));
    harness.step();
}

#[test]
fn a_changed_file_can_be_reloaded_and_the_reload_undone() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    std::fs::write(&path, theirs()).unwrap();
    focus(&mut harness);
    wait_for(&mut harness, CHANGED);
    assert!(!tells(&harness, "your changes here are not saved"));
    press(&mut harness, "Reload");
    wait_until(&mut harness, "it is reloaded", |studio| !studio.is_opening());
    harness.run_steps(2);
    assert_eq!((first_body(&harness).as_str(), harness.state().editor().is_changed()), ("theirs", false));
    assert!(!tells(&harness, CHANGED));
    assert!(harness.state_mut().editor_mut().undo());
    assert_eq!(first_body(&harness), "ball");
    // The file is known as it is now: saving asks nothing.
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "it is saved", is_saved);
    assert_eq!(read(&path), SCENE);
}

#[test]
fn what_is_kept_is_said_once_and_saving_asks() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    rename(&mut harness, "orb");
    std::fs::write(&path, theirs()).unwrap();
    wait_for(&mut harness, CHANGED);
    assert!(tells(&harness, "your changes here are not saved"));
    press(&mut harness, "Keep mine");
    focus(&mut harness);
    std::thread::sleep(std::time::Duration::from_millis(300));
    harness.run_steps(3);
    assert!(!tells(&harness, CHANGED) && first_body(&harness) == "orb");
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "the answer of the disk", |studio| !studio.is_saving());
    harness.run_steps(2);
    assert!(tells(&harness, "is no longer the one that was opened here"));
    press(&mut harness, "Cancel");
    // Another change is another offer.
    std::fs::write(&path, format!("{}# more\n", theirs())).unwrap();
    focus(&mut harness);
    wait_for(&mut harness, CHANGED);
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn the_same_text_and_own_savings_are_no_changes() {
    let (mut harness, path) = with_file(&TestHost::new(), SCENE);
    // Written again by another program, with another time.
    std::fs::write(&path, SCENE).unwrap();
    focus(&mut harness);
    std::thread::sleep(std::time::Duration::from_millis(500));
    harness.run_steps(3);
    rename(&mut harness, "orb");
    run(&mut harness, FileCommand::Save);
    wait_until(&mut harness, "it is saved", is_saved);
    for _ in 0..5 {
        focus(&mut harness);
        std::thread::sleep(std::time::Duration::from_millis(100));
        harness.run_steps(2);
    }
    assert!(!tells(&harness, CHANGED));
    assert!(read(&path).contains("orb"));
}
