//! Reading, and one pixel of what was read.

use catoptric_exchange::{
    DEFAULT_SIZE, ExportOptions, ForeignFormat, ImportOptions, ImportedScene, read, write,
};
use catoptric_scene::{Diagnostics, Scene, Severity};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};

/// Reads a text that has no errors.
pub(crate) fn good(format: ForeignFormat, text: &str, options: &ImportOptions) -> ImportedScene {
    read(format, text, options).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Reads a text that has errors, and gives them one on each line.
pub(crate) fn bad(format: ForeignFormat, text: &str) -> String {
    let errors = read(format, text, &ImportOptions::default()).unwrap_err();
    assert!(errors.has_errors());
    errors.to_string()
}

/// Writes a scene exactly, and reads it again.
pub(crate) fn written_and_read(format: ForeignFormat, scene: &Scene) -> (String, Scene) {
    let options = ExportOptions { is_approximate: false, size: Some(DEFAULT_SIZE) };
    let written = write(format, scene, &options).unwrap_or_else(|error| panic!("{format:?}: {error}")).text;
    let found = read(format, &written, &ImportOptions::default());
    let found = found.unwrap_or_else(|errors| panic!("{errors}\n{written}")).scene;
    (written, found)
}

/// The light of a pixel of a picture of this size.
pub(crate) fn pixel(imported: &ImportedScene, [width, height]: [u32; 2], [x, y]: [u32; 2]) -> [f32; 3] {
    let scene = RenderScene::build(&imported.scene).unwrap();
    let settings = RenderSettings { width, height, samples: 1 };
    let rendered = render(&scene, settings, &RenderControl::default()).unwrap();
    rendered.picture.pixel(x, y).unwrap()
}

/// Fails unless the light is this.
#[track_caller]
pub(crate) fn assert_light(found: [f32; 3], expected: [f32; 3]) {
    let is_near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5);
    assert!(is_near, "{found:?}, not {expected:?}");
}

/// How many findings are of this severity.
pub(crate) fn count(report: &Diagnostics, severity: Severity) -> usize {
    report.iter().filter(|finding| finding.severity == severity).count()
}
