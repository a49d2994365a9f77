//! The studio in a real window, on a display of its own (Xvfb), used with a mouse and a keyboard.
//!
//! Skipped, with a word about it, where there is no Xvfb.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod common;

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ClientMessageEvent, ConnectionExt as _, EventMask, ImageFormat,
    InputFocus, KEY_PRESS_EVENT, KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use common::skip;

const WIDTH: u16 = 1280;
const HEIGHT: u16 = 800;

/// Columns of the window that surely belong to the picture: beside it, panels show colors too.
const PICTURE: std::ops::Range<i16> = 240..940;

/// Two studios beside each other would trace and draw too slowly to be used like by hand.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Generous: the studio is not optimized here, and draws without a graphics card.
const PATIENCE: Duration = Duration::from_secs(120);

/// A red disc before black, without any shading.
const SCENE: &str = r#"format = "catoptric/1"

[environment]
background = [0.0, 0.0, 0.0]

[[bodies]]
name = "disc"
shape = "sphere"
position = [0.0, 1.0, 0.0]
radius = 0.5
material = { color = [1.0, 0.0, 0.0], ambient = 1.0, diffuse = 0.0 }
"#;

/// A process that ends with the test.
struct Ending(Child);

impl Drop for Ending {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A display without a screen.
fn start_display() -> Option<(Ending, String)> {
    let size = format!("{WIDTH}x{HEIGHT}x24");
    let display = Command::new("Xvfb")
        .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &size])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let mut display = display.ok()?;
    let mut number = String::new();
    BufReader::new(display.stdout.take()?).read_line(&mut number).ok()?;
    Some((Ending(display), format!(":{}", number.trim())))
}

fn start_studio(display: &str, home: &Path, scene: &Path) -> Ending {
    let config = home.join("config/catoptric");
    std::fs::create_dir_all(&config).unwrap();
    let settings = r#"{"language": "english", "is_hint_dismissed": true, "shows_grid": false}"#;
    std::fs::write(config.join("settings.json"), settings).unwrap();
    let studio = Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .arg("studio")
        .arg(scene)
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", home)
        .env("XDG_CONFIG_HOME", home.join("config"))
        .env("XDG_STATE_HOME", home.join("state"))
        .env("XDG_RUNTIME_DIR", home)
        .spawn();
    Ending(studio.unwrap())
}

/// The pixels from the left to the right edge of the red disc.
type Extent = (i16, i16, i16);

struct Desk {
    connection: RustConnection,
    root: Window,
}

impl Desk {
    fn connect(display: &str) -> Self {
        let (connection, screen) = x11rb::connect(Some(display)).unwrap();
        let root = connection.setup().roots[screen].root;
        Self { connection, root }
    }

    /// Left and right edge of what is purely red on the screen, and the row of its middle.
    fn red(&self) -> Option<Extent> {
        let image = self
            .connection
            .get_image(ImageFormat::Z_PIXMAP, self.root, 0, 0, WIDTH, HEIGHT, !0)
            .unwrap()
            .reply()
            .unwrap();
        let red = |pixel: &[u8]| pixel[2] > 240 && pixel[1] < 12 && pixel[0] < 12;
        let found: Vec<(i16, i16)> = image
            .data
            .chunks_exact(4)
            .enumerate()
            .filter(|(_, pixel)| red(pixel))
            .map(|(at, _)| ((at % usize::from(WIDTH)) as i16, (at / usize::from(WIDTH)) as i16))
            .filter(|(column, _)| PICTURE.contains(column))
            .collect();
        let columns = found.iter().map(|at| at.0);
        let rows = found.iter().map(|at| at.1);
        let middle = i16::midpoint(rows.clone().min()?, rows.max()?);
        Some((columns.clone().min()?, columns.max()?, middle))
    }

    /// Waits until the red disc satisfies `condition` and stays where it is for a while.
    fn wait_for_red(&self, what: &str, condition: impl Fn(Extent) -> bool) -> Extent {
        let deadline = Instant::now() + PATIENCE;
        let mut last = None;
        let mut since = Instant::now();
        loop {
            let red = self.red();
            if red != last {
                last = red;
                since = Instant::now();
            }
            if let Some(red) = red
                && condition(red)
                && since.elapsed() > Duration::from_secs(1)
            {
                return red;
            }
            assert!(Instant::now() < deadline, "waited in vain: {what}; the disc is at {red:?}");
            sleep(Duration::from_millis(100));
        }
    }

    fn fake(&self, kind: u8, detail: u8, x: i16, y: i16) {
        self.connection.xtest_fake_input(kind, detail, 0, self.root, x, y, 0).unwrap();
        self.connection.flush().unwrap();
        sleep(Duration::from_millis(40));
    }

    fn drag(&self, from: (i16, i16), to: (i16, i16)) {
        const STEPS: i16 = 10;
        self.fake(MOTION_NOTIFY_EVENT, 0, from.0 - 3, from.1);
        self.fake(MOTION_NOTIFY_EVENT, 0, from.0, from.1);
        self.fake(BUTTON_PRESS_EVENT, 1, 0, 0);
        for step in 1..=STEPS {
            let at = |from: i16, to: i16| from + (to - from) * step / STEPS;
            self.fake(MOTION_NOTIFY_EVENT, 0, at(from.0, to.0), at(from.1, to.1));
        }
        self.fake(BUTTON_RELEASE_EVENT, 1, 0, 0);
    }

    /// Presses keys together.
    fn press(&self, keysyms: &[u32]) {
        let codes: Vec<u8> = keysyms.iter().map(|&keysym| self.key_code(keysym)).collect();
        for &code in &codes {
            self.fake(KEY_PRESS_EVENT, code, 0, 0);
        }
        for &code in codes.iter().rev() {
            self.fake(KEY_RELEASE_EVENT, code, 0, 0);
        }
    }

    fn key_code(&self, keysym: u32) -> u8 {
        let setup = self.connection.setup();
        let (first, count) = (setup.min_keycode, setup.max_keycode - setup.min_keycode + 1);
        let mapping = self.connection.get_keyboard_mapping(first, count).unwrap().reply().unwrap();
        let width = usize::from(mapping.keysyms_per_keycode);
        let place = mapping.keysyms.chunks(width).position(|keysyms| keysyms.contains(&keysym)).unwrap();
        first + place as u8
    }

    fn atom(&self, name: &str) -> u32 {
        self.connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    /// The studio's window: without a window manager it is a child of the root.
    fn window(&self) -> Window {
        let protocols = self.atom("WM_PROTOCOLS");
        let tree = self.connection.query_tree(self.root).unwrap().reply().unwrap();
        let has_protocols = |&window: &Window| {
            let properties = self.connection.list_properties(window).unwrap().reply().unwrap();
            properties.atoms.contains(&protocols)
        };
        tree.children.into_iter().find(has_protocols).unwrap()
    }

    fn focus(&self, window: Window) {
        self.connection.set_input_focus(InputFocus::PARENT, window, 0_u32).unwrap();
        self.connection.flush().unwrap();
    }

    fn ask_to_close(&self, window: Window) {
        let data = [self.atom("WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let message = ClientMessageEvent::new(32, window, self.atom("WM_PROTOCOLS"), data);
        self.connection.send_event(false, window, EventMask::NO_EVENT, message).unwrap();
        self.connection.flush().unwrap();
    }
}

/// A studio with the red disc in a window of its own display.
struct Opened {
    server: Ending,
    home: tempfile::TempDir,
    scene: std::path::PathBuf,
    desk: Desk,
    studio: Ending,
}

fn open_disc() -> Option<Opened> {
    let Some((server, display)) = start_display() else {
        skip("Xvfb is not installed, so there is no display for a window");
        return None;
    };
    let home = tempfile::tempdir().unwrap();
    let scene = home.path().join("disc.toml");
    std::fs::write(&scene, SCENE).unwrap();
    let desk = Desk::connect(&display);
    let studio = start_studio(&display, home.path(), &scene);
    Some(Opened { server, home, scene, desk, studio })
}

/// A newcomer drags a body with the mouse, sees it move with the pointer, takes that back, and closes the window.
#[test]
fn a_body_follows_the_mouse_in_a_real_window() {
    const CONTROL: u32 = 0xffe3;
    const Z: u32 = 0x7a;
    const SHIFT: i16 = 90;
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(Opened { server: _server, home: _home, scene, desk, mut studio }) = open_disc() else { return };

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
    let deadline = Instant::now() + PATIENCE;
    let status = loop {
        if let Some(status) = studio.0.try_wait().unwrap() {
            break status;
        }
        assert!(Instant::now() < deadline, "the window does not close");
        sleep(Duration::from_millis(50));
    };
    assert!(status.success(), "{status}");
    assert_eq!(std::fs::read_to_string(&scene).unwrap(), SCENE, "nobody saved it");
}

/// Asked to end by a signal, the studio keeps what is unsaved; nobody is there to answer a question.
#[test]
fn a_signal_ends_the_studio_and_unsaved_work_is_kept() {
    let _turn = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(Opened { server: _server, home, scene, desk, mut studio }) = open_disc() else { return };
    let (left, right, middle) = desk.wait_for_red("the picture", |(left, right, _)| right - left > 60);
    let center = i16::midpoint(left, right);
    desk.drag((center, middle), (center + 60, middle));
    desk.wait_for_red("the dragged disc", |red| red.0 > left + 40);

    let pid = studio.0.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &pid]).status().unwrap().success());
    let status = studio.0.wait().unwrap();
    assert_eq!(status.code(), Some(130), "{status}");
    assert_eq!(std::fs::read_to_string(&scene).unwrap(), SCENE, "the file itself is left alone");
    let recovery = std::fs::read_dir(home.path().join("state/catoptric/recovery")).unwrap();
    let kept = recovery.map(|entry| entry.unwrap().path()).find(|path| path.extension().unwrap() == "toml");
    let kept = std::fs::read_to_string(kept.unwrap()).unwrap();
    assert!(kept.contains("position = [") && !kept.contains("position = [0.0, 1.0, 0.0]"), "{kept}");
}
