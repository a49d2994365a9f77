//! The driver of the window fails: the studio opens the window anew, with everything in it.
//!
//! Skipped, with a word about it, where there is no Xvfb. This program is also the studio whose driver fails: a window
//! is opened by the main thread, which the tests of the usual harness do not have.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

#[cfg(target_os = "linux")]
#[path = "program/common.rs"]
mod common;

#[cfg(target_os = "linux")]
#[path = "program/desk.rs"]
mod desk;

fn main() {
    #[cfg(target_os = "linux")]
    linux::main();
}

#[cfg(target_os = "linux")]
mod linux {
    use std::io::{Read as _, Write as _};
    use std::path::PathBuf;
    use std::process::{Command, Stdio};
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    use catoptric_studio::{InjectedLoss, Interruption, StartDocument, open_with_fault};
    use x11rb::protocol::xproto::Window;

    use crate::desk::{Opened, PATIENCE, SCENE};

    /// The first argument of the studio whose driver fails.
    const STUDIO: &str = "studio";

    /// How far the disc is dragged, pixels.
    const SHIFT: i16 = 90;

    pub(super) fn main() {
        let mut arguments = std::env::args().skip(1);
        match (arguments.next().as_deref(), arguments.next()) {
            (Some(STUDIO), Some(scene)) => studio(scene.into()),
            _ => std::thread::scope(|scope| {
                scope.spawn(a_window_that_is_lost_comes_back_with_the_edit_and_its_undo);
                scope.spawn(a_driver_that_fails_again_and_again_ends_the_studio_and_work_is_kept);
            }),
        }
    }

    /// The studio; its device is lost with every byte that comes in.
    fn studio(scene: PathBuf) {
        let fault = InjectedLoss::default();
        let driver = fault.clone();
        std::thread::spawn(move || std::io::stdin().lock().bytes().for_each(|_| driver.strike()));
        if let Err(error) = open_with_fault(&StartDocument::File(scene), &Interruption::default(), &fault) {
            let _ = writeln!(std::io::stderr().lock(), "{error}");
            std::process::exit(2);
        }
    }

    /// The driver of the window traces the picture, too.
    fn open_disc() -> Option<Opened> {
        let mut program = Command::new(std::env::current_exe().unwrap());
        program.arg(STUDIO).stdin(Stdio::piped()).stderr(Stdio::piped());
        Opened::start(program, true)
    }

    fn lose_device(opened: &mut Opened) {
        opened.studio.0.stdin.as_mut().unwrap().write_all(b"!").unwrap();
    }

    /// Waits for another window than `before`; there is none when the studio has ended.
    fn wait_for_other_window(opened: &mut Opened, before: Window) -> Option<Window> {
        let deadline = Instant::now() + PATIENCE;
        while opened.studio.0.try_wait().unwrap().is_none() {
            let window = opened.desk.find_window().filter(|window| *window != before);
            if window.is_some() {
                return window;
            }
            assert!(Instant::now() < deadline, "there is no other window");
            sleep(Duration::from_millis(50));
        }
        None
    }

    /// The device is lost while a body is being dragged: the drag ends, and what it did can be undone.
    fn a_window_that_is_lost_comes_back_with_the_edit_and_its_undo() {
        const CONTROL: u32 = 0xffe3;
        const Z: u32 = 0x7a;
        let Some(mut opened) = open_disc() else { return };
        let seen = |(left, right, _)| right - left > 60;
        let (left, right, middle) = opened.desk.wait_for_red("the picture", seen);
        let center = i16::midpoint(left, right);
        opened.desk.drag_and_hold((center, middle), (center + SHIFT, middle));
        let dragged = opened.desk.wait_for_red("the dragged disc", |red| red.0 > left + SHIFT / 2);

        let before = opened.desk.window();
        lose_device(&mut opened);
        let window = wait_for_other_window(&mut opened, before).unwrap();
        assert!(opened.kept().unwrap().contains("disc"), "the work was made safe first");
        let is_there =
            |red: (i16, i16, i16)| (red.0 - dragged.0).abs() <= 4 && (red.1 - dragged.1).abs() <= 4;
        opened.desk.wait_for_red("the disc in the new window", is_there);

        // The pointer holds nothing any more.
        opened.desk.release();
        opened.desk.point((center - SHIFT, middle));
        opened.desk.wait_for_red("the disc left alone", is_there);

        opened.desk.focus(window);
        opened.desk.press(&[CONTROL, Z]);
        opened.desk.wait_for_red("the disc back in its place", |red| (red.0 - left).abs() <= 4);
        opened.desk.drag((center, middle), (center + SHIFT, middle));
        opened.desk.wait_for_red("the disc dragged again", |red| red.0 > left + SHIFT / 2);
        opened.desk.press(&[CONTROL, Z]);
        opened.desk.wait_for_red("the disc back again", |red| (red.0 - left).abs() <= 4);

        opened.desk.ask_to_close(window);
        let status = opened.wait_for_end();
        assert!(status.success(), "{status}: {}", opened.errors());
        assert_eq!(opened.errors(), "");
        assert_eq!(std::fs::read_to_string(&opened.scene).unwrap(), SCENE, "nobody saved it");
        assert_eq!(opened.kept(), None, "nothing is unsaved");
    }

    fn a_driver_that_fails_again_and_again_ends_the_studio_and_work_is_kept() {
        let Some(mut opened) = open_disc() else { return };
        let seen = |(left, right, _)| right - left > 60;
        let (left, right, middle) = opened.desk.wait_for_red("the picture", seen);
        let center = i16::midpoint(left, right);
        opened.desk.drag((center, middle), (center + SHIFT, middle));
        opened.desk.wait_for_red("the dragged disc", |red| red.0 > left + SHIFT / 2);
        let mut window = opened.desk.find_window();
        while let Some(before) = window {
            lose_device(&mut opened);
            window = wait_for_other_window(&mut opened, before);
            if window.is_some() {
                opened.desk.wait_for_red("the disc in a new window", |red| red.0 > left + SHIFT / 2);
            }
        }
        assert_eq!(opened.wait_for_end().code(), Some(2));
        let errors = opened.errors();
        assert!(errors.contains("driver failed") && errors.contains("kept and offered"), "{errors}");
        assert!(!errors.contains("panicked"), "{errors}");
        let kept = opened.kept().unwrap();
        assert!(kept.contains("position = [") && !kept.contains("position = [0.0, 1.0, 0.0]"), "{kept}");
        assert_eq!(std::fs::read_to_string(&opened.scene).unwrap(), SCENE, "the file itself is left alone");
    }
}
