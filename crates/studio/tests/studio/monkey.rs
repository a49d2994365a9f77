//! A monkey at the studio: random acts from a seed, none of which may find a panic or break the document.
//!
//! `CATOPTRIC_MONKEY_STEPS` and `CATOPTRIC_MONKEY_SEED` choose how many and which. In long runs glibc keeps what large
//! pictures leave between small things; `MALLOC_ARENA_MAX=1 MALLOC_MMAP_THRESHOLD_=65536` shows what is really in use.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use catoptric_editor::{Action, Item, Label, NewBodyPlacement};
use catoptric_scene::{Example, MaterialChoice, ScenePart, ShapeKind};
use catoptric_studio::{CameraCommand, Command, FileCommand, StartDocument, Studio};
use egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, accesskit,
    pos2, vec2,
};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;
use glam::DVec3;

use crate::kit::{TestHost, studio_with_any_letters};

/// Steps in the usual tests.
const STEPS: u64 = 1500;
/// After so many steps a new document is begun, and memory compared.
const ROUND: u64 = 500;
/// After so many steps the monkey rests, and so must the camera.
const REST: u64 = 25;
/// Growth of memory over all rounds but the first that would mean a leak.
const GROWTH: u64 = 96 << 20;

/// SplitMix64 (Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.roll() % count.max(1) as u64) as usize
    }

    fn unit(&mut self) -> f32 {
        (self.roll() >> 40) as f32 / (1_u64 << 24) as f32
    }

    fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }

    /// From tiny to huge, now and then no number at all.
    fn number(&mut self) -> f64 {
        match self.below(20) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => 0.0,
            3 => -1e12,
            4 => 1e-12,
            _ => 20.0 * f64::from(self.unit()) - 10.0,
        }
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

struct Monkey {
    dice: Dice,
    host: TestHost,
    harness: Harness<'static, Studio>,
    /// How often a faulty key has moved the camera.
    steered: usize,
    /// What was done, for the message of a failure.
    log: Vec<String>,
}

impl Monkey {
    fn new(seed: u64) -> Self {
        let host = TestHost::new();
        let harness = studio_with_any_letters(host.clone(), StartDocument::Example("four-bodies".to_owned()));
        Self { dice: Dice(seed), host, harness, steered: 0, log: Vec::new() }
    }

    fn step(&mut self) {
        let act = match self.dice.below(100) {
            0..20 => self.command(),
            20..45 => self.widget(),
            45..60 => self.drag(),
            60..71 => self.keys(),
            71..75 => self.faulty_keys(),
            75..90 => self.edit(),
            90..95 => self.wheel(),
            95..97 => self.resize(),
            _ => self.file(),
        };
        self.log.push(act);
        self.harness.step();
    }

    fn check(&self, seed: u64) {
        let studio = self.harness.state();
        let tail = || self.log[self.log.len().saturating_sub(12)..].join("\n");
        assert!(!PANICKED.load(Ordering::Relaxed), "seed {seed}: a thread panicked\n{}", tail());
        if let Err(broken) = studio.editor().check_invariants() {
            panic!("seed {seed}, step {}: {broken}\n{}", self.log.len(), tail());
        }
        let missing = studio.texts().missing();
        assert!(missing.is_empty(), "seed {seed}, step {}: {missing:?}\n{}", self.log.len(), tail());
    }

    fn command(&mut self) -> String {
        let all: Vec<&Command> = Command::all().collect();
        let command = match self.dice.below(12) {
            0 => FileCommand::OpenExample(self.dice.one(Example::ALL).name).into(),
            1 => FileCommand::OpenFile(self.scene_file()).into(),
            _ => (*self.dice.one(&all)).clone(),
        };
        let said = format!("{command:?}");
        self.harness.state_mut().run(command);
        said
    }

    /// Clicks something that can be clicked.
    fn widget(&mut self) -> String {
        use accesskit::Role;
        let nodes: Vec<(Pos2, String)> = self
            .harness
            .root()
            .children_recursive()
            .filter(|node| {
                let role = node.accesskit_node().role();
                // Containers have no place of their own.
                !matches!(role, Role::Label | Role::GenericContainer | Role::Window | Role::Unknown)
                    && node.accesskit_node().bounding_box().is_some()
            })
            .map(|node| (node.rect().center(), format!("{:?}", node.accesskit_node().label())))
            .collect();
        if nodes.is_empty() {
            return "nothing to click".to_owned();
        }
        let (at, label) = self.dice.one(&nodes).clone();
        let button = if self.dice.below(6) == 0 { PointerButton::Secondary } else { PointerButton::Primary };
        self.click(at, button);
        format!("click {button:?} on {label} at {at}")
    }

    fn press(&self, pos: Pos2, button: PointerButton, modifiers: Modifiers, pressed: bool) {
        self.harness.event(Event::PointerMoved(pos));
        self.harness.event_modifiers(Event::PointerButton { pos, button, pressed, modifiers }, modifiers);
    }

    /// Every event is a frame of a quarter of a second: with any other between the two this would be no click.
    fn click(&self, at: Pos2, button: PointerButton) {
        let modifiers = Modifiers::NONE;
        self.harness.event(Event::PointerMoved(at));
        for pressed in [true, false] {
            self.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
        }
    }

    fn place(&mut self) -> Pos2 {
        let size = self.harness.input().screen_rect.map_or(vec2(800.0, 600.0), |rect| rect.size());
        pos2(size.x * self.dice.unit(), size.y * self.dice.unit())
    }

    fn drag(&mut self) -> String {
        let (from, to) = (self.place(), self.place());
        let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let button = *self.dice.one(&buttons);
        let modifiers = *self.dice.one(&[Modifiers::NONE, Modifiers::SHIFT, Modifiers::CTRL, Modifiers::ALT]);
        self.press(from, button, modifiers, true);
        self.harness.step();
        for part in 1..=4 {
            self.harness.event(Event::PointerMoved(from.lerp(to, part as f32 / 4.0)));
            self.harness.step();
        }
        if self.dice.below(5) == 0 {
            self.harness.key_press(Key::Escape);
        }
        self.press(to, button, modifiers, false);
        format!("drag {button:?} with {modifiers:?} from {from} to {to}")
    }

    fn keys(&mut self) -> String {
        const KEYS: &[Key] = &[
            Key::Enter,
            Key::Escape,
            Key::Escape,
            Key::Tab,
            Key::ArrowUp,
            Key::ArrowDown,
            Key::ArrowLeft,
            Key::Delete,
            Key::Backspace,
            Key::Space,
            Key::W,
            Key::F,
            Key::F2,
            Key::Z,
            Key::D,
            Key::PageUp,
        ];
        const TEXTS: &[&str] = &["1", "-5", "1e9", "0.25", "abc", "шар", "", "#ff8800", "NaN"];
        if self.dice.below(3) == 0 {
            let text = (*self.dice.one(TEXTS)).to_owned();
            self.harness.event(Event::Text(text.clone()));
            return format!("type {text}");
        }
        let key = *self.dice.one(KEYS);
        let modifiers =
            *self.dice.one(&[Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND]);
        self.harness.key_press_modifiers(modifiers, key);
        format!("press {key:?} with {modifiers:?}")
    }

    /// Keys whose releases have another name, or are lost with the focus or to the system.
    fn faulty_keys(&mut self) -> String {
        const KEYS: &[(Key, Key, Key)] = &[
            (Key::Plus, Key::Equals, Key::Equals),
            (Key::Plus, Key::CloseBracket, Key::OpenBracket),
            (Key::Questionmark, Key::Num7, Key::Num7),
            (Key::PageUp, Key::PageUp, Key::PageUp),
            (Key::ArrowLeft, Key::ArrowLeft, Key::ArrowLeft),
            (Key::W, Key::Z, Key::W),
            (Key::D, Key::D, Key::D),
        ];
        let (key, physical, released) = *self.dice.one(KEYS);
        let modifiers = *self.dice.one(&[Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND]);
        let stroke = |key, pressed, modifiers| Event::Key {
            key,
            physical_key: Some(physical),
            pressed,
            repeat: false,
            modifiers,
        };
        self.harness.event(Event::ModifiersChanged(modifiers));
        self.harness.event(stroke(key, true, modifiers));
        let how = self.dice.below(4);
        match how {
            0 => {
                self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
                self.harness.event(stroke(released, false, Modifiers::NONE));
            }
            1 => {
                for focused in [false, true] {
                    self.harness.input_mut().focused = focused;
                    self.harness.event(Event::WindowFocused(focused));
                    self.harness.step();
                }
            }
            // The release is lost, but the key has repeated.
            _ => {
                self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
                for _ in 0..how {
                    self.harness.event(stroke(key, true, Modifiers::NONE));
                }
            }
        }
        format!("faulty {key:?} at {physical:?} with {modifiers:?}, {how}")
    }

    /// Steers with a key of which something is wrong, over a picture that listens if that can be had; then stops. The
    /// camera stands still within a few frames. A file that is being opened may bring another one.
    fn rest(&mut self, seed: u64) {
        const FRAMES: usize = 32;
        for _ in 0..6 {
            self.harness.key_press(Key::Escape);
            self.harness.step();
        }
        if self.dice.below(3) == 0 {
            self.harness.state_mut().run(CameraCommand::ToggleFly);
            self.harness.step();
        }
        let before = self.harness.state().view_camera();
        let act = self.faulty_keys();
        self.log.push(act);
        self.harness.step();
        self.steered += usize::from(self.harness.state().view_camera() != before);
        let mut still = 0;
        let mut last = self.harness.state().view_camera();
        for _ in 0..FRAMES {
            self.harness.step();
            let now = self.harness.state().view_camera();
            still = if now == last { still + 1 } else { 0 };
            last = now;
            if still == 8 {
                return;
            }
        }
        let tail = self.log[self.log.len().saturating_sub(12)..].join("\n");
        panic!("seed {seed}, step {}: the camera moves by itself: {last:?}\n{tail}", self.log.len());
    }

    /// Changes the document behind the back of the window.
    fn edit(&mut self) -> String {
        let action = self.action();
        let said = format!("{action:?}");
        let number = self.dice.number();
        let vector = self.dice.vector();
        let index = self.dice.below(8);
        let editor = self.harness.state_mut().editor_mut();
        if index < 3 {
            let label = Label::new("edit-move", "monkey");
            // A refusal is a good answer.
            let _ = editor.change_body(index, label, |body| body.placement = body.placement.moved_by(vector));
            let _ = editor.change_light(index, Label::new("edit-intensity", "monkey"), |light| {
                light.intensity = number;
            });
            return format!("move {index} by {vector}, intensity {number}");
        }
        let _ = editor.apply(action);
        said
    }

    fn action(&mut self) -> Action {
        let edited = self.harness.state().editor().edited();
        let parts = [ScenePart::Body(0), ScenePart::Body(7), ScenePart::Light(0), ScenePart::Material(1)];
        let items = parts.map(|part| edited.item(part).unwrap_or(Item::Camera));
        let item = *self.dice.one(&items);
        let name = (*self.dice.one(&["", "a", "шар", "a\"b\n", "sphere 2"])).to_owned();
        match self.dice.below(25) {
            0 => {
                let placement =
                    NewBodyPlacement { size: self.dice.number(), ..NewBodyPlacement::at(self.dice.vector()) };
                let shapes = [ShapeKind::SIMPLE.as_slice(), &ShapeKind::PARAMETRIC].concat();
                Action::AddBody { shape: *self.dice.one(&shapes), placement, name }
            }
            1 => Action::AddLight { at: self.dice.vector(), name },
            2 => Action::AddMaterial { name },
            3 => Action::Rename { item, name },
            4 => Action::Paste(Example::ALL[self.dice.below(Example::ALL.len())].text.to_owned()),
            5 => Action::Paste(name),
            6 => Action::MoveToIndex(self.dice.below(9)),
            7 => Action::AssignMaterial(MaterialChoice::Named(name)),
            8 => Action::SetHidden { item, hidden: true },
            9 => Action::SetLocked { item, locked: self.dice.below(2) == 0 },
            10 => Action::SelectAll,
            11 => Action::Duplicate,
            12 => Action::Delete,
            13 => Action::Cut,
            14 => Action::ShareMaterial,
            15 => Action::MakeMaterialUnique,
            16 => Action::DropToGround,
            17 => Action::ResetPlacement,
            18 => Action::Redo,
            19 => Action::ShowAll,
            20 => Action::UnlockAll,
            21 => Action::Join { shape: *self.dice.one(&ShapeKind::ALL), name },
            22 => Action::TakeApart,
            23 => Action::DuplicateAsInstance,
            24 => Action::MakeOwn,
            _ => Action::Undo,
        }
    }

    fn wheel(&mut self) -> String {
        let at = self.place();
        let delta = vec2(0.0, 200.0 * (self.dice.unit() - 0.5));
        self.harness.event(Event::PointerMoved(at));
        self.harness.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta,
            phase: TouchPhase::Move,
            source: MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        format!("wheel {delta} at {at}")
    }

    fn resize(&mut self) -> String {
        let size = vec2(300.0 + 1200.0 * self.dice.unit(), 200.0 + 800.0 * self.dice.unit());
        self.harness.set_size(size);
        format!("resize to {size}")
    }

    fn scene_file(&mut self) -> PathBuf {
        const NAMES: &[&str] = &["a.toml", "b.toml", "missing.toml"];
        let name = *self.dice.one(NAMES);
        self.host.path(name)
    }

    /// Prepares the answer to the next question for a file, or puts a good or bad scene file there.
    fn file(&mut self) -> String {
        let path = self.scene_file();
        match self.dice.below(4) {
            0 => self.host.answer(None),
            1 => self.host.answer(Some(path.clone())),
            2 => write(&path, "format = \"catoptric/1\"\n[[bodies]]\nshape = \"sphere\"\nradius = -1\n"),
            _ => write(&path, self.dice.one(Example::ALL).text),
        }
        format!("file {}", path.display())
    }

    /// Closes the windows of finished pictures, whose memory is theirs until then.
    fn close_pictures(&mut self) {
        // The question whether to lose the picture lies over its window.
        const CLOSE: &[&str] = &["Don’t save", "Не сохранять", "Close the picture", "Закрыть изображение"];
        for attempt in 0..1500 {
            if attempt > 100 {
                // One that is being saved or copied cannot be closed yet.
                std::thread::sleep(Duration::from_millis(20));
            }
            if attempt % 64 == 63 {
                // What was being saved may end with another question.
                self.harness.key_press(Key::Escape);
                self.harness.step();
            }
            let rank = |node: &egui_kittest::Node<'_>| {
                let node = node.accesskit_node();
                let label = node.label().filter(|_| node.role() == accesskit::Role::Button)?;
                CLOSE.iter().position(|other| *other == label)
            };
            let nodes = self.harness.root().children_recursive();
            let found: Vec<_> = nodes.filter_map(|node| Some((rank(&node)?, node.rect()))).collect();
            let Some(first) = found.iter().map(|&(rank, _)| rank).min() else { return };
            // Of several questions one lies over the others, and only it can be answered.
            let found: Vec<_> = found.iter().filter(|&&(rank, _)| rank == first).collect();
            let (_, at) = found[attempt % found.len()];
            self.click(at.center(), PointerButton::Primary);
            self.harness.step();
        }
        let context = &self.harness.ctx;
        let nodes = self.harness.root().children_recursive();
        let labels: Vec<_> = nodes
            .filter_map(|node| {
                let access = node.accesskit_node();
                let label = access.label()?;
                let place = CLOSE.contains(&label.as_str()).then(|| node.rect());
                Some((label, place))
            })
            .collect();
        let (rect, zoom) = (context.content_rect(), context.zoom_factor());
        let over = |at: egui::Rect| context.layer_id_at(at.center());
        let covers: Vec<_> = labels.iter().filter_map(|(_, place)| place.map(over)).collect();
        panic!("a picture cannot be closed in {rect}, zoom {zoom}, under {covers:?}: {labels:?}");
    }

    /// Back to a small document without a history, whatever is open.
    fn begin_anew(&mut self) {
        // The commands open questions over questions, as no person can.
        for _ in 0..64 {
            self.harness.key_press(Key::Escape);
            self.harness.step();
        }
        // In the smallest windows what closes a picture lies off the screen.
        self.harness.set_size(vec2(1280.0, 800.0));
        self.close_pictures();
        let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
        *self.harness.state_mut().editor_mut() = catoptric_editor::Editor::new(scene);
        for _ in 0..4 {
            self.harness.step();
        }
        self.log.clear();
    }
}

/// A folder may have been made in that place.
fn write(path: &PathBuf, text: &str) {
    let _ = std::fs::write(path, text);
}

fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// Bytes of memory in use, where the system tells.
fn memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: u64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4096)
}

/// Whether a thread of the studio panicked, which the window survives.
static PANICKED: AtomicBool = AtomicBool::new(false);

fn watch_for_panics() {
    let tell = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        // The threads of tests are named by their paths.
        if !std::thread::current().name().is_some_and(|name| name.contains("::")) {
            PANICKED.store(true, Ordering::Relaxed);
        }
        tell(info);
    }));
}

#[test]
fn a_monkey_finds_nothing_to_break() {
    let steps = from_environment("CATOPTRIC_MONKEY_STEPS", STEPS);
    let seed = from_environment("CATOPTRIC_MONKEY_SEED", 1);
    watch_for_panics();
    let mut monkey = Monkey::new(seed);
    let mut at_rest = Vec::new();
    for step in 0..steps {
        if step % ROUND == 0 && step > 0 {
            monkey.begin_anew();
            at_rest.extend(memory());
            println!("{step} steps, {} MB", at_rest.last().map_or(0, |bytes| bytes >> 20));
        }
        monkey.step();
        monkey.check(seed);
        if step % REST == REST - 1 {
            monkey.rest(seed);
        }
    }
    // Otherwise it would be no wonder that the camera rests.
    assert!(steps < STEPS || monkey.steered > 5, "{} keys have steered", monkey.steered);
    println!("{} keys have steered", monkey.steered);
    // The first round fills caches: fonts, thumbnails.
    if let [_, second, .., last] = at_rest[..] {
        assert!(last < second + GROWTH, "memory grew from {second} to {last} bytes");
    }
}
