//! Takes the pictures of the studio that the documents show, in every language and theme, without a window.
//!
//! `cargo xtask screenshots` calls this; by itself: `screenshots FOLDER [WIDTHxHEIGHT]`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a chore")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use catoptric_editor::Item;
use catoptric_studio::host::{FileAnswer, FileQuestion, Host};
use catoptric_studio::{Command, MeasureAct, Pane, Start, Studio};
use egui_kittest::Harness;

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
    /// The body to select.
    body: Option<usize>,
    /// What is done one after the other.
    commands: Vec<Command>,
    hint: bool,
}

const fn shot(name: &'static str, language: &'static str, theme: &'static str, scene: &'static str) -> Shot {
    Shot { name, language, theme, scene, body: None, commands: Vec::new(), hint: false }
}

fn shots() -> Vec<Shot> {
    vec![
        Shot { body: Some(1), ..shot("studio-en-dark", "english", "dark", "four-bodies") },
        Shot { body: Some(1), ..shot("studio-en-light", "english", "light", "four-bodies") },
        Shot { body: Some(1), ..shot("studio-ru-dark", "russian", "dark", "whitted") },
        Shot { body: Some(1), ..shot("studio-ru-light", "russian", "light", "whitted") },
        Shot {
            commands: vec![Command::Examples],
            ..shot("studio-examples", "english", "dark", "four-bodies")
        },
        Shot { commands: vec![Command::Render], ..shot("studio-render", "russian", "light", "still-life") },
        Shot { commands: vec![Command::Palette], ..shot("studio-palette", "english", "light", "glass-row") },
        Shot {
            commands: vec![Command::Shortcuts],
            ..shot("studio-shortcuts", "russian", "dark", "four-bodies")
        },
        Shot {
            commands: vec![Command::TogglePane(Pane::Compare)],
            ..shot("studio-compare", "english", "dark", "four-bodies")
        },
        Shot {
            commands: vec![Command::TogglePane(Pane::Measure), Command::Measure(MeasureAct::Start)],
            ..shot("studio-measure", "english", "light", "four-bodies")
        },
        Shot { hint: true, ..shot("studio-first", "english", "dark", "four-bodies") },
    ]
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| ".".to_owned()));
    let size = arguments.next().unwrap_or_else(|| "1440x900".to_owned());
    let (width, height) = size.split_once('x').unwrap_or_else(|| panic!("{size}: write WIDTHxHEIGHT"));
    let size = [width.parse().unwrap(), height.parse().unwrap()];
    let wanted: Vec<String> = arguments.collect();
    std::fs::create_dir_all(&folder).unwrap();
    for shot in shots() {
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
    let start = Start::Example(shot.scene.to_owned());
    let theme = if shot.theme == "light" { egui::Theme::Light } else { egui::Theme::Dark };
    let builder = Harness::builder().with_size(size).with_max_steps(64).with_theme(theme).wgpu();
    let mut harness = builder.build_eframe(|creation| {
        Studio::new(&creation.egui_ctx, &start, Box::new(Nowhere { settings })).unwrap()
    });
    harness.step();
    if let Some(body) = shot.body {
        harness.state_mut().editor_mut().select(Item::Body(body));
    }
    for command in &shot.commands {
        harness.state_mut().run(command.clone());
        harness.step();
        harness.step();
    }
    let has_thumbnails = shot.commands.contains(&Command::Examples);
    wait(&mut harness, Duration::from_secs(if has_thumbnails { 40 } else { 2 }));
    let image = harness.render().unwrap();
    write_jpeg(&folder.join(format!("{}.jpg", shot.name)), image.width(), image.height(), image.as_raw());
    println!("{}", shot.name);
}

/// Pictures in documents are JPEG: a repository should stay small.
fn write_jpeg(path: &Path, width: u32, height: u32, rgba: &[u8]) {
    let mut encoder = jpeg_encoder::Encoder::new_file(path, 80).unwrap();
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
