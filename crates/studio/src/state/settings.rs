//! The settings that the studio remembers.

use std::path::{Path, PathBuf};

use catoptric_exchange::{Dialect, ForeignFormat, ImportOptions};
use catoptric_platform::files;
use catoptric_tracer::raster::MethodKind;
use egui_tiles::Tree;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::base::texts::Language;
use crate::base::theme::Theme;
use crate::state::layout::Pane;
use crate::state::methods::MethodSettings;
use crate::state::render_choices::RenderChoices;

/// How many files the menu of recent ones holds.
const RECENT: usize = 12;

/// A longer file of settings is damaged, bytes.
const LONGEST: u64 = 1 << 20;

/// The saved settings. A missing, unknown or unreadable entry has its default, so that files of other versions can be
/// read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// The language; that of the system at the first start.
    pub language: Language,
    /// Light, dark, or as the system has it.
    pub theme: Theme,
    /// The scene files opened or saved last, the newest first.
    pub recent: Vec<PathBuf>,
    /// The scene that was open when the studio was left.
    pub last: Option<LastScene>,
    /// How scenes of miniRT programs are read: [words](Dialect::WORDS) with commas between them.
    pub minirt_dialect: String,
    /// Whether the hint of the first start has been dismissed.
    pub is_hint_dismissed: bool,
    /// Whether the ground grid is drawn.
    pub shows_grid: bool,
    /// Whether lights and the axes are drawn over the picture.
    pub shows_handles: bool,
    /// Whether the graphics card draws the picture; as the studio thinks best until that was chosen.
    pub uses_card: Option<bool>,
    /// How the picture is drawn.
    pub methods: MethodSettings,
    /// The two ways of drawing that were compared last.
    pub compared: [MethodSettings; 2],
    /// Samples per pixel up to which the idle picture is refined.
    pub viewport_samples: u32,
    /// Size of everything in the window, 1 being normal.
    pub zoom: f32,
    /// Inner size of the window, points.
    pub window_size: Option<[f32; 2]>,
    /// Whether the window takes the whole screen.
    pub is_maximized: bool,
    /// The arrangement of the panels.
    pub layout: Option<Tree<Pane>>,
    /// How the last picture was rendered.
    pub render: RenderChoices,
}

/// A scene to come back to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LastScene {
    /// A file.
    File(PathBuf),
    /// A built-in example, by name.
    Example(String),
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            language: Language::default(),
            theme: Theme::default(),
            recent: Vec::new(),
            last: None,
            minirt_dialect: String::new(),
            is_hint_dismissed: false,
            shows_grid: true,
            shows_handles: true,
            uses_card: None,
            methods: MethodSettings::default(),
            compared: [MethodKind::Whitted, MethodKind::Ssr].map(MethodSettings::with),
            viewport_samples: 16,
            zoom: 1.0,
            window_size: None,
            is_maximized: false,
            layout: None,
            render: RenderChoices::default(),
        }
    }
}

impl Settings {
    /// The settings of the first start: the system's language.
    pub fn first() -> Self {
        Self { language: Language::of_system(), ..Self::default() }
    }

    /// Reads the settings at `path`. A file that is missing or damaged gives those of the first start.
    pub fn load(path: &Path) -> Self {
        let text = files::read_text(path, LONGEST).unwrap_or_default();
        let mut settings = Self::of(serde_json::from_str(&text).unwrap_or_default());
        settings.zoom = if settings.zoom.is_finite() { settings.zoom.clamp(0.5, 3.0) } else { 1.0 };
        settings.viewport_samples = settings.viewport_samples.clamp(1, 1024);
        let is_size = |side: &f32| (100.0..=16384.0).contains(side);
        settings.window_size = settings.window_size.filter(|size| size.iter().all(is_size));
        settings.render.check();
        settings
    }

    /// The settings of the first start with the entries found, each as far as it can be read.
    fn of(found: Map<String, Value>) -> Self {
        let mut settings = Self::first();
        let Ok(Value::Object(mut readable)) = serde_json::to_value(&settings) else { return settings };
        for (name, value) in found {
            let mut tried = readable.clone();
            tried.insert(name, value);
            if let Ok(read) = serde_json::from_value(Value::Object(tried.clone())) {
                (settings, readable) = (read, tried);
            }
        }
        settings
    }

    /// Writes the settings to `path`, whole or not at all.
    ///
    /// # Errors
    /// When the file or its folder cannot be written.
    pub fn save(&self, path: &Path) -> std::io::Result<()> {
        if let Some(folder) = path.parent() {
            files::create_folders(folder)?;
        }
        let text = serde_json::to_string_pretty(self)?;
        files::write_bytes(path, text.as_bytes()).map_err(std::io::Error::other)
    }

    /// How scenes of other ray tracers are read at first: exactly.
    pub(crate) fn import_options(&self) -> ImportOptions {
        ImportOptions { dialect: self.dialect(), ..ImportOptions::default() }
    }

    /// How scenes of miniRT programs are read.
    pub(crate) fn dialect(&self) -> Dialect {
        self.minirt_dialect.parse().unwrap_or_default()
    }

    /// Whether the last scene was read from a miniRT program's file.
    pub(crate) fn last_is_minirt(&self) -> bool {
        let Some(LastScene::File(path)) = &self.last else { return false };
        ForeignFormat::of_path(path) == Some(ForeignFormat::MiniRt)
    }

    /// Width over height of the pictures to be made.
    pub fn picture_aspect(&self) -> f64 {
        f64::from(self.render.width.max(1)) / f64::from(self.render.height.max(1))
    }

    /// Puts `path` first among the recent files.
    pub fn remember_recent(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_saved_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deeper/settings.json");
        let mut settings = Settings { language: Language::Russian, zoom: 1.25, ..Settings::default() };
        settings.layout = Some(crate::state::layout::default_layout());
        settings.remember_recent(Path::new("/a.toml"));
        settings.remember_recent(Path::new("/b.toml"));
        settings.remember_recent(Path::new("/a.toml"));
        assert_eq!(settings.recent, [PathBuf::from("/a.toml"), PathBuf::from("/b.toml")]);
        settings.save(&path).unwrap();
        assert_eq!(Settings::load(&path), settings);
    }

    #[test]
    fn a_damaged_file_gives_the_first_settings() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("settings.json");
        for text in ["", "{", "[1, 2]", "{\"zoom\": \"large\"}", "{\"layout\": 3}"] {
            std::fs::write(&path, text).unwrap();
            assert_eq!(Settings::load(&path), Settings::first(), "{text}");
        }
        let text = r#"{"theme": "sepia", "zoom": 1.5, "layout": {"root": "a"}, "shows_grid": false}"#;
        std::fs::write(&path, text).unwrap();
        let expected = Settings { zoom: 1.5, shows_grid: false, ..Settings::first() };
        assert_eq!(Settings::load(&path), expected, "what can be read is kept");
        for (size, read) in [("[1280, 800]", Some([1280.0, 800.0])), ("[0, 800]", None), ("[1e9, 800]", None)]
        {
            std::fs::write(&path, format!("{{\"window_size\": {size}}}")).unwrap();
            assert_eq!(Settings::load(&path).window_size, read, "{size}");
        }
        std::fs::write(&path, "{\"theme\": \"light\", \"unknown\": 1, \"zoom\": 1e9}").unwrap();
        let settings = Settings::load(&path);
        assert_eq!((settings.theme, settings.zoom), (Theme::Light, 3.0));
    }
}
