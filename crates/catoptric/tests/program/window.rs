//! The studio in a real window, on a display of its own (Xvfb), used with a mouse and a keyboard.
//!
//! Skipped, with a word about it, where there is no Xvfb.

use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::desk::{Opened, SCENE};

/// Two studios beside each other would trace and draw too slowly to be used like by hand.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

fn open_disc() -> Option<Opened> {
    let mut program = Command::new(env!("CARGO_BIN_EXE_catoptric"));
    program.arg("studio");
    Opened::start(program, false)
}

/// A newcomer drags a body with the mouse, sees it move with the pointer, takes that back, and closes the window.
#[test]
fn a_body_follows_the_mouse_in_a_real_window() {
    const CONTROL: u32 = 0xffe3;
    const Z: u32 = 0x7a;
    const SHIFT: i16 = 90;
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(mut opened) = open_disc() else { return };
    let desk = &opened.desk;

    let (left, right, middle) = desk.wait_for_red("the picture", |(left, right, _)| right - left > 60);
    desk.focus(desk.window());
    let center = i16::midpoint(left, right);
    desk.drag((center, middle), (center + SHIFT, middle));
    let near = |a: i16, b: i16| (a - b).abs() <= 4;
    // What was grabbed is the near side of the ball, and stays under the pointer; the outline lies farther away.
    let moved = SHIFT * 15 / 16;
    desk.wait_for_red("the dragged disc", |red| near(red.0, left + moved) && near(red.1, right + moved));

    desk.press(&[CONTROL, Z]);
    desk.wait_for_red("the disc back in its place", |red| near(red.0, left) && near(red.1, right));

    desk.ask_to_close(desk.window());
    let status = opened.wait_for_end();
    assert!(status.success(), "{status}");
    assert_eq!(std::fs::read_to_string(&opened.scene).unwrap(), SCENE, "nobody saved it");
}

/// Asked to end by a signal, the studio keeps what is unsaved; nobody is there to answer a question.
#[test]
fn a_signal_ends_the_studio_and_unsaved_work_is_kept() {
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(mut opened) = open_disc() else { return };
    let desk = &opened.desk;
    let (left, right, middle) = desk.wait_for_red("the picture", |(left, right, _)| right - left > 60);
    let center = i16::midpoint(left, right);
    desk.drag((center, middle), (center + 60, middle));
    desk.wait_for_red("the dragged disc", |red| red.0 > left + 40);

    let pid = opened.studio.0.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &pid]).status().unwrap().success());
    let status = opened.studio.0.wait().unwrap();
    assert_eq!(status.code(), Some(130), "{status}");
    assert_eq!(std::fs::read_to_string(&opened.scene).unwrap(), SCENE, "the file itself is left alone");
    let kept = opened.kept().unwrap();
    assert!(kept.contains("position = [") && !kept.contains("position = [0.0, 1.0, 0.0]"), "{kept}");
}
