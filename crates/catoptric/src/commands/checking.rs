//! Pictures of other ray tracers that are held against a scene: how they are read, and by which settings.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use anyhow::Result;
use catoptric_lab::detective::{DetectiveSettings, ObservedPicture, Verdict};
use catoptric_picture::{Development, Picture, PictureFormat, ReadError};
use catoptric_scene::Scene;
use catoptric_tracer::RenderSettings;

use crate::arguments::{CompareArguments, Size};
use crate::files::CommandFiles;
use crate::input::{self, NamedScene, SceneSource};
use crate::layers::LayerReader;

/// A picture file.
pub(super) struct PictureFile {
    pub path: PathBuf,
    pub picture: Picture,
    pub head: PictureHead,
}

/// What decides how a picture is checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PictureHead {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The format that its first bytes tell, of a plain file.
    pub format: Option<PictureFormat>,
}

impl PictureFile {
    pub(super) fn read(path: PathBuf, layers: &mut LayerReader) -> Result<Self, ReadError> {
        let picture = layers.read(&path)?;
        let head = PictureHead { size: [picture.width(), picture.height()], format: format_of(&path) };
        Ok(Self { path, picture, head })
    }

    /// Its codes, or its light.
    pub(super) fn observed(&self) -> ObservedPicture {
        ObservedPicture::of_file(&self.picture, self.head.format)
    }

    /// How it is shown: of codes, reading has made light by the sRGB curve.
    pub(super) fn development(&self, settings: &DetectiveSettings) -> Development {
        let is_light = self.head.format.is_some_and(PictureFormat::is_of_light);
        if is_light { settings.development() } else { Development::default() }
    }
}

fn format_of(path: &Path) -> Option<PictureFormat> {
    let mut start = [0; 32];
    let count = if path.is_file() { File::open(path).ok()?.read(&mut start).ok()? } else { 0 };
    PictureFormat::of_content(start.get(..count)?)
}

/// How the exact picture is traced.
pub(super) fn exact_settings(verdict: &Verdict) -> RenderSettings {
    let [width, height] = verdict.scene_size;
    RenderSettings { width, height, samples: 1 }
}

/// A scene against which pictures are held.
pub(super) struct ExactScene<'a> {
    path: &'a Path,
    arguments: &'a CompareArguments,
    input: NamedScene,
}

/// What pictures share that are checked by one preparation of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CheckKey {
    /// The size for which the scene is read anew; `None` if it is the one that is expected.
    size: Option<[u32; 2]>,
    pub settings: DetectiveSettings,
}

impl<'a> ExactScene<'a> {
    pub(super) fn read(
        path: &'a Path,
        arguments: &'a CompareArguments,
        files: &mut CommandFiles,
    ) -> Result<Self> {
        Ok(Self { path, arguments, input: input::scene(path, &arguments.set, arguments.size, files)? })
    }

    /// Shows the warnings about it.
    pub(super) fn warn(&self) {
        self.input.warn();
    }

    /// What it is called without its folder, which is no matter to who reads a page.
    pub(super) fn name(&self) -> String {
        let name = &self.input.name;
        Path::new(name).file_name().map_or(name.as_str().into(), OsStr::to_string_lossy).into_owned()
    }

    pub(super) fn key(&self, head: PictureHead) -> Result<CheckKey> {
        let expected = self.expected_size();
        // A picture that was transposed has the sides exchanged.
        let [width, height] = head.size;
        let is_expected = expected == Some([width, height]) || expected == Some([height, width]);
        let is_fixed = self.input.foreign.is_none()
            || is_expected
            || matches!(input::source(self.path)?, SceneSource::Example(_));
        let size = (!is_fixed).then_some(head.size);
        Ok(CheckKey { size, settings: self.settings(head) })
    }

    /// The scene for pictures of a key: read anew for their size, to which a horizontal angle of view belongs.
    pub(super) fn scene(&self, key: &CheckKey, files: &mut CommandFiles) -> Result<Scene> {
        let Some([width, height]) = key.size else { return Ok(self.input.loaded.scene.clone()) };
        let size = Size { width, height };
        Ok(input::scene(self.path, &self.arguments.set, Some(size), files)?.loaded.scene)
    }

    /// The size that pictures should have.
    fn expected_size(&self) -> Option<[u32; 2]> {
        self.arguments.size.map(Into::into).or(self.input.foreign?.size)
    }

    fn settings(&self, head: PictureHead) -> DetectiveSettings {
        let curve = self.arguments.development.tone_curve;
        let usual = DetectiveSettings::of_file(head.format, curve, self.input.foreign.is_some());
        DetectiveSettings {
            expected_size: self.expected_size(),
            tolerance: self.arguments.tolerance.unwrap_or(usual.tolerance),
            ..usual
        }
    }
}
