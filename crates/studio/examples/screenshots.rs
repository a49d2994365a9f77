//! Takes the pictures of the studio that the documents show, in every language and theme, without a window.
//!
//! `cargo xtask screenshots` calls this; by itself: `screenshots FOLDER [WIDTHxHEIGHT]`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a chore")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use catoptric_scene::ScenePart;
use catoptric_studio::host::{FileAnswer, FileQuestion, Host};
use catoptric_studio::{AuditCommand, Command, StartDocument, Studio};
use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

/// A system without files but for the settings.
struct Nowhere {
    settings: PathBuf,
}

impl Host for Nowhere {
    fn ask_file(&mut self, _question: &FileQuestion) -> Option<FileAnswer> {
        None
    }

    fn settings_path(&self) -> Option<PathBuf> {
        Some(self.settings.clone())
    }

    fn recovery_folder(&self) -> Option<PathBuf> {
        None
    }
}

/// What a picture shows.
struct Shot {
    name: &'static str,
    language: &'static str,
    theme: &'static str,
    scene: &'static str,
    /// What to select.
    selected: Option<ScenePart>,
    /// What is done one after the other.
    commands: Vec<&'static str>,
    hint: bool,
    /// The list that is opened, by its message.
    list: Option<&'static str>,
    /// The keys that are pressed then.
    keys: Vec<Key>,
    /// How far down the keys walk in the materials.
    rows_down: usize,
    /// Where the pointer rests in the picture, or below it.
    pointer: Option<[f32; 2]>,
    /// What is looked into: a pixel, and how the view is turned then.
    audit: Option<Look>,
}

/// Places are shares of the picture's width and height.
#[derive(Clone, Copy)]
struct Look {
    pixel: [f32; 2],
    /// A drag beside everything.
    turn: Option<[[f32; 2]; 2]>,
    /// How far slow light has come, frames of a quarter of a second.
    frames: Option<usize>,
    /// The ray that is chosen, from 0.
    ray: Option<usize>,
}

const fn shot(name: &'static str, language: &'static str, theme: &'static str, scene: &'static str) -> Shot {
    Shot {
        name,
        language,
        theme,
        scene,
        selected: None,
        commands: Vec::new(),
        hint: false,
        list: None,
        keys: Vec::new(),
        rows_down: 0,
        pointer: None,
        audit: None,
    }
}

/// What is selected: the body at this place.
fn body(index: usize) -> Option<ScenePart> {
    Some(ScenePart::Body(index))
}

fn shots() -> Vec<Shot> {
    vec![
        Shot { selected: body(1), ..shot("studio-en-dark", "english", "dark", "four-bodies") },
        Shot { selected: body(1), ..shot("studio-en-light", "english", "light", "four-bodies") },
        Shot { selected: body(1), ..shot("studio-ru-dark", "russian", "dark", "whitted") },
        Shot { selected: body(1), ..shot("studio-ru-light", "russian", "light", "whitted") },
        Shot { commands: vec!["file.examples"], ..shot("studio-examples", "english", "dark", "four-bodies") },
        Shot { commands: vec!["picture.render"], ..shot("studio-render", "russian", "light", "still-life") },
        Shot { commands: vec!["window.palette"], ..shot("studio-palette", "english", "light", "glass-row") },
        Shot {
            commands: vec!["help.shortcuts"],
            ..shot("studio-shortcuts", "russian", "dark", "four-bodies")
        },
        Shot { audit: Some(OUTSIDE), ..shot("studio-audit-en", "english", "dark", "whitted") },
        Shot { audit: Some(OUTSIDE), ..shot("studio-audit-ru", "russian", "light", "whitted") },
        Shot {
            audit: Some(Look { frames: Some(10), ..OUTSIDE }),
            ..shot("studio-slow-light", "english", "light", "whitted")
        },
        Shot {
            commands: vec!["view.map.generations"],
            ..shot("studio-map", "english", "dark", "mirror-box")
        },
        Shot {
            commands: vec!["view.exact"],
            selected: body(5),
            ..shot("studio-exact-en", "english", "dark", "ring-of-images")
        },
        Shot {
            commands: vec!["view.exact"],
            selected: body(5),
            ..shot("studio-exact-ru", "russian", "light", "ring-of-images")
        },
        Shot {
            selected: body(12),
            pointer: Some([0.66, 0.5]),
            ..shot("studio-material-en", "english", "dark", "metals")
        },
        Shot {
            selected: body(14),
            pointer: Some([0.48, 0.5]),
            ..shot("studio-material-ru", "russian", "light", "rising-index")
        },
        Shot {
            selected: body(12),
            commands: vec!["window.pane.materials"],
            rows_down: 3,
            pointer: Some([0.568, 1.5]),
            ..shot("studio-materials-en", "english", "dark", "metals")
        },
        Shot {
            selected: body(14),
            commands: vec!["window.pane.materials"],
            rows_down: 5,
            ..shot("studio-materials-ru", "russian", "light", "rising-index")
        },
        Shot {
            selected: Some(ScenePart::Environment),
            ..shot("studio-surroundings-en", "english", "dark", "sky-room")
        },
        Shot { selected: body(4), ..shot("studio-surroundings-ru", "russian", "light", "textures") },
        Shot {
            commands: vec!["window.pane.compare"],
            ..shot("studio-compare", "english", "dark", "four-bodies")
        },
        Shot {
            commands: vec!["window.pane.measure", "measure.start"],
            ..shot("studio-measure", "english", "light", "four-bodies")
        },
    ]
}

/// The shots of what opens over the window.
fn popup_shots() -> Vec<Shot> {
    vec![
        Shot { hint: true, ..shot("studio-first", "english", "dark", "four-bodies") },
        Shot { keys: OPTICS.into(), ..shot("studio-add-en", "english", "dark", "four-bodies") },
        Shot { keys: OPTICS.into(), ..shot("studio-add-ru", "russian", "light", "four-bodies") },
        Shot {
            selected: body(1),
            list: Some("section-shape"),
            ..shot("studio-shapes-en", "english", "dark", "four-bodies")
        },
        Shot {
            selected: body(1),
            list: Some("section-shape"),
            ..shot("studio-shapes-ru", "russian", "light", "four-bodies")
        },
    ]
}

/// The keys that lead into the menu `Add`, and there into the optics.
const OPTICS: [Key; 11] = {
    use Key::{ArrowDown, ArrowRight, F10};
    [
        F10, ArrowRight, ArrowRight, ArrowDown, ArrowDown, ArrowDown, ArrowDown, ArrowDown, ArrowDown,
        ArrowDown, ArrowRight,
    ]
};

/// The rays of a pixel of the glass ball in Whitted's scene from beside, the one through the ball chosen.
const OUTSIDE: Look =
    Look { pixel: [0.42, 0.46], turn: Some([[0.9, 0.6], [0.66, 0.78]]), frames: None, ray: Some(2) };

fn main() {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| ".".to_owned()));
    let size = arguments.next().unwrap_or_else(|| "1440x900".to_owned());
    let (width, height) = size.split_once('x').unwrap_or_else(|| panic!("{size}: write WIDTHxHEIGHT"));
    let size = [width.parse().unwrap(), height.parse().unwrap()];
    let wanted: Vec<String> = arguments.collect();
    std::fs::create_dir_all(&folder).unwrap();
    for shot in shots().into_iter().chain(popup_shots()) {
        if wanted.is_empty() || wanted.iter().any(|name| name == shot.name) {
            take(&shot, size, &folder);
        }
    }
}

fn take(shot: &Shot, size: [f32; 2], folder: &Path) {
    let scratch = tempfile::tempdir().unwrap();
    let settings = scratch.path().join("settings.json");
    let text = format!(
        r#"{{"language": "{}", "theme": "{}", "is_hint_dismissed": {}}}"#,
        shot.language, shot.theme, !shot.hint
    );
    std::fs::write(&settings, text).unwrap();
    // The hint does not stand over a scene that is asked for by name.
    let start = if shot.hint { StartDocument::Last } else { StartDocument::Example(shot.scene.to_owned()) };
    let theme = if shot.theme == "light" { egui::Theme::Light } else { egui::Theme::Dark };
    let builder = Harness::builder().with_size(size).with_max_steps(64).with_theme(theme).wgpu();
    let mut harness = builder.build_eframe(|creation| {
        Studio::new(&creation.egui_ctx, &start, Box::new(Nowhere { settings })).unwrap()
    });
    harness.step();
    if let Some(part) = shot.selected {
        harness.state_mut().editor_mut().select_parts([part]);
    }
    for command in &shot.commands {
        harness.state_mut().run(Command::from_name(command).unwrap().clone());
        harness.step();
        harness.step();
    }
    for _ in 0..shot.rows_down {
        harness.key_press(Key::ArrowDown);
        harness.step();
    }
    if let Some(list) = shot.list {
        harness.run_steps(4);
        let name = harness.state().texts().get(list).to_owned();
        harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, &name).click();
        harness.run_steps(4);
    }
    for key in &shot.keys {
        harness.key_press(*key);
        harness.run_steps(2);
    }
    let pictured = ["file.examples", "window.pane.materials"];
    let has_thumbnails = shot.commands.iter().any(|command| pictured.contains(command));
    wait(&mut harness, Duration::from_secs(if has_thumbnails { 40 } else { 2 }));
    if let Some(look) = &shot.audit {
        audit(&mut harness, look);
    }
    if let Some([x, y]) = shot.pointer {
        let rect = harness.state().viewport_rect().unwrap();
        harness.event(Event::PointerMoved(rect.min + egui::vec2(x, y) * rect.size()));
        harness.run_steps(4);
    }
    let image = harness.render().unwrap();
    write_jpeg(&folder.join(format!("{}.jpg", shot.name)), image.width(), image.height(), image.as_raw());
    println!("{}", shot.name);
}

/// Pins a pixel, and looks at its rays.
fn audit(harness: &mut Harness<'_, Studio>, look: &Look) {
    harness.state_mut().run(AuditCommand::Tool);
    wait(harness, Duration::from_secs(1));
    let rect = harness.state().viewport_rect().unwrap();
    let place = |[x, y]: [f32; 2]| rect.min + egui::vec2(x, y) * rect.size();
    drag(harness, &[place(look.pixel)]);
    wait(harness, Duration::from_secs(1));
    // The panel covers a part of the picture by now.
    let rect = harness.state().visible_rect().unwrap();
    let place = |[x, y]: [f32; 2]| rect.min + egui::vec2(x, y) * rect.size();
    if let Some([from, to]) = look.turn {
        let steps: Vec<Pos2> = (0..=10).map(|step| place(from).lerp(place(to), step as f32 / 10.0)).collect();
        drag(harness, &steps);
        wait(harness, Duration::from_secs(1));
    }
    if let Some(ends) = look.ray.and_then(|ray| harness.state().audit_ray_in_window(ray)) {
        drag(harness, &[ends[0].lerp(ends[1], 0.4)]);
    }
    harness.event(Event::PointerMoved(rect.left_bottom() + egui::vec2(40.0, 60.0)));
    wait(harness, Duration::from_secs(1));
    if let Some(frames) = look.frames {
        harness.state_mut().run(AuditCommand::Play);
        harness.run_steps(frames);
    }
}

/// Presses the button at the first place and lets it go at the last.
fn drag(harness: &mut Harness<'_, Studio>, places: &[Pos2]) {
    let button = |pos, pressed| {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos, button, pressed, modifiers }
    };
    let (first, last) = (places[0], places[places.len() - 1]);
    harness.event(Event::PointerMoved(first));
    harness.step();
    harness.event(button(first, true));
    for place in places {
        harness.event(Event::PointerMoved(*place));
        harness.step();
    }
    harness.event(button(last, false));
    harness.run_steps(3);
}

/// Pictures in documents are JPEG: a repository should stay small.
fn write_jpeg(path: &Path, width: u32, height: u32, rgba: &[u8]) {
    let mut encoder = jpeg_encoder::Encoder::new_file(path, 70).unwrap();
    encoder.set_optimized_huffman_tables(true);
    encoder.encode(rgba, width as u16, height as u16, jpeg_encoder::ColorType::Rgba).unwrap();
}

/// Waits until the picture is refined, but at least for `least`.
fn wait(harness: &mut Harness<'_, Studio>, least: Duration) {
    let start = Instant::now();
    loop {
        harness.step();
        let is_refined = harness.state().live().status().is_idle && !harness.state().is_measuring();
        if (is_refined && start.elapsed() > least) || start.elapsed() > Duration::from_secs(120) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}
