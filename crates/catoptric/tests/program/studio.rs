//! `catoptric studio`, and `catoptric` alone, where there is no window.

use std::process::Command;

use crate::common::{Folder, Ran, skip};

/// The program without a display and with a home of its own.
fn command(folder: &Folder, line: &str) -> Command {
    let mut command = folder.command(line.split_whitespace());
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    for name in ["HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_RUNTIME_DIR"] {
        command.env(name, folder.path("home"));
    }
    command
}

/// Runs it; it must refuse, in one line.
fn refused(mut command: Command) -> String {
    let ran = Ran::of(command.output().unwrap());
    assert_eq!((ran.status, ran.output.as_str()), (Some(2), ""), "{ran:?}");
    assert!(ran.errors.starts_with("error: ") && ran.errors.lines().count() == 1, "{ran:?}");
    ran.errors
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_display_the_studio_names_the_command_render() {
    let folder = Folder::new();
    folder.write("bad.toml", crate::common::FIVE_ERRORS);
    for line in ["", "studio", "studio whitted", "studio bad.toml"] {
        let errors = refused(command(&folder, line));
        assert!(errors.contains("there is no display") && errors.contains("`catoptric render`"), "{errors}");
    }
    assert_eq!(folder.names(), ["bad.toml"], "nothing is written without a window");
}

#[cfg(target_os = "linux")]
#[test]
fn a_display_that_does_not_answer_is_no_panic() {
    let folder = Folder::new();
    if std::path::Path::new("/tmp/.X11-unix/X9731").exists() {
        return skip("there is a display :9731");
    }
    for (name, value) in [("DISPLAY", ":9731"), ("WAYLAND_DISPLAY", "no-such-socket")] {
        let mut command = command(&folder, "studio");
        command.env(name, value);
        let errors = refused(command);
        // A system without the libraries of windows says which one is missing.
        assert!(errors.contains("cannot be reached") || errors.contains("is missing"), "{errors}");
        assert!(errors.contains("`catoptric render`") && !errors.contains("panicked"), "{errors}");
    }
}

#[test]
fn wrong_scenes_are_refused_before_a_window_opens() {
    let folder = Folder::new();
    for (line, said) in [
        ("studio whited", "did you mean \"whitted\"?"),
        ("studio nonsense", "`catoptric examples` lists the scenes"),
        ("studio no.toml", "there is no such file"),
        ("studio .", "it is a folder"),
    ] {
        let errors = refused(command(&folder, line));
        assert!(errors.contains(said), "{line}: {errors}");
    }
}
