//! A display of its own (Xvfb) with a mouse and a keyboard, and a scene that is easily found on it.

#![allow(dead_code, reason = "each test program uses its own part")]

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ClientMessageEvent, ConnectionExt as _, EventMask, ImageFormat,
    InputFocus, KEY_PRESS_EVENT, KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use crate::common::skip;

const WIDTH: u16 = 1280;
const HEIGHT: u16 = 800;

/// Columns of the window that surely belong to the picture: beside it, panels show colors too.
const PICTURE: std::ops::Range<i16> = 240..940;

/// Generous: the studio is not optimized here, and draws without a graphics card.
pub(crate) const PATIENCE: Duration = Duration::from_secs(120);

/// A red disc before black, without any shading.
pub(crate) const SCENE: &str = r#"format = "catoptric/1"

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
pub(crate) struct Ending(pub(crate) Child);

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

/// A studio with the red disc in a window of its own display.
pub(crate) struct Opened {
    _server: Ending,
    pub(crate) home: tempfile::TempDir,
    pub(crate) scene: PathBuf,
    pub(crate) desk: Desk,
    pub(crate) studio: Ending,
}

impl Opened {
    /// Has `program` open the scene, which becomes its last argument. Skipped where there can be no display.
    pub(crate) fn start(mut program: Command, uses_card: bool) -> Option<Self> {
        let Some((server, display)) = start_display() else {
            skip("Xvfb is not installed, so there is no display for a window");
            return None;
        };
        let home = tempfile::tempdir().unwrap();
        let scene = home.path().join("disc.toml");
        std::fs::write(&scene, SCENE).unwrap();
        let config = home.path().join("config/catoptric");
        std::fs::create_dir_all(&config).unwrap();
        let settings = format!(
            r#"{{"language": "english", "is_hint_dismissed": true, "shows_grid": false, "uses_card": {uses_card}}}"#
        );
        std::fs::write(config.join("settings.json"), settings).unwrap();
        let desk = Desk::connect(&display);
        let studio = program
            .arg(&scene)
            .env("DISPLAY", &display)
            .env_remove("WAYLAND_DISPLAY")
            .env("HOME", home.path())
            .env("XDG_CONFIG_HOME", home.path().join("config"))
            .env("XDG_STATE_HOME", home.path().join("state"))
            .env("XDG_RUNTIME_DIR", home.path())
            .spawn();
        Some(Self { _server: server, home, scene, desk, studio: Ending(studio.unwrap()) })
    }

    /// What has been kept of unsaved work, if anything.
    pub(crate) fn kept(&self) -> Option<String> {
        let recovery = std::fs::read_dir(self.home.path().join("state/catoptric/recovery")).ok()?;
        let mut paths = recovery.map(|entry| entry.unwrap().path());
        let kept = paths.find(|path| path.extension().is_some_and(|extension| extension == "toml"))?;
        Some(std::fs::read_to_string(kept).unwrap())
    }

    /// What the program has said of errors, once it has ended; its stream must be piped.
    pub(crate) fn errors(&mut self) -> String {
        let mut errors = String::new();
        self.studio.0.stderr.as_mut().unwrap().read_to_string(&mut errors).unwrap();
        errors
    }

    /// Waits until the program has ended.
    pub(crate) fn wait_for_end(&mut self) -> ExitStatus {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.studio.0.try_wait().unwrap() {
                return status;
            }
            assert!(Instant::now() < deadline, "the studio does not end");
            sleep(Duration::from_millis(50));
        }
    }
}

/// The pixels from the left to the right edge of the red disc.
pub(crate) type Extent = (i16, i16, i16);

pub(crate) struct Desk {
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
    pub(crate) fn red(&self) -> Option<Extent> {
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
    pub(crate) fn wait_for_red(&self, what: &str, condition: impl Fn(Extent) -> bool) -> Extent {
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

    pub(crate) fn drag(&self, from: (i16, i16), to: (i16, i16)) {
        self.drag_and_hold(from, to);
        self.release();
    }

    /// Drags without letting go in the end.
    pub(crate) fn drag_and_hold(&self, from: (i16, i16), to: (i16, i16)) {
        const STEPS: i16 = 10;
        self.point((from.0 - 3, from.1));
        self.point(from);
        self.fake(BUTTON_PRESS_EVENT, 1, 0, 0);
        for step in 1..=STEPS {
            let at = |from: i16, to: i16| from + (to - from) * step / STEPS;
            self.point((at(from.0, to.0), at(from.1, to.1)));
        }
    }

    pub(crate) fn release(&self) {
        self.fake(BUTTON_RELEASE_EVENT, 1, 0, 0);
    }

    pub(crate) fn point(&self, at: (i16, i16)) {
        self.fake(MOTION_NOTIFY_EVENT, 0, at.0, at.1);
    }

    /// Presses keys together.
    pub(crate) fn press(&self, keysyms: &[u32]) {
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
    pub(crate) fn window(&self) -> Window {
        self.find_window().unwrap()
    }

    /// The studio's window, if there is one.
    pub(crate) fn find_window(&self) -> Option<Window> {
        let protocols = self.atom("WM_PROTOCOLS");
        let tree = self.connection.query_tree(self.root).unwrap().reply().unwrap();
        let has_protocols = |&window: &Window| {
            // It may have been closed a moment ago.
            let properties = self.connection.list_properties(window).unwrap().reply();
            properties.is_ok_and(|properties| properties.atoms.contains(&protocols))
        };
        tree.children.into_iter().find(has_protocols)
    }

    pub(crate) fn focus(&self, window: Window) {
        self.connection.set_input_focus(InputFocus::PARENT, window, 0_u32).unwrap();
        self.connection.flush().unwrap();
    }

    pub(crate) fn ask_to_close(&self, window: Window) {
        let data = [self.atom("WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let message = ClientMessageEvent::new(32, window, self.atom("WM_PROTOCOLS"), data);
        self.connection.send_event(false, window, EventMask::NO_EVENT, message).unwrap();
        self.connection.flush().unwrap();
    }
}
