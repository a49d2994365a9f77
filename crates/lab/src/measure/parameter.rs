//! The parameters of drawing, and their values.

use std::fmt;

use catoptric_scene::{SceneValue, Tracing};
use catoptric_tracer::raster::{CubeMapSettings, ShadingSettings};
use catoptric_tracer::{AcceleratorChoice, RenderScene, RenderSettings};

use crate::variant::Variant;

/// A parameter of drawing that a sweep varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// The number of bodies N: the scene's own, then those of a cloud (see [`grown`](crate::cloud::grown)).
    Bodies,
    /// The limit of generations K.
    Generations,
    /// The size of the picture, C pixels.
    Size,
    /// Samples per pixel.
    Samples,
    /// The number of threads.
    Threads,
    /// How reflections are found.
    Method,
    /// Into how many parts a quarter of a circle is divided (`flat`, `gouraud`, `phong`).
    Fineness,
    /// The edge of a face of a cube map, pixels (`cube-map`).
    CubeMapSize,
    /// With or without a hierarchy of bounding volumes.
    Search,
}

/// A value of what is varied.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number of bodies, generations, samples, threads, parts or pixels.
    Count(u32),
    /// Pixels across and down.
    Size([u32; 2]),
    /// A method with its settings.
    Method(Variant),
    /// How bodies are found.
    Search(AcceleratorChoice),
    /// A value of the scene.
    Setting(SceneValue),
}

impl Parameter {
    /// All parameters, in the order in which to offer them.
    pub const ALL: [Self; 9] = [
        Self::Bodies,
        Self::Generations,
        Self::Size,
        Self::Samples,
        Self::Threads,
        Self::Method,
        Self::Fineness,
        Self::CubeMapSize,
        Self::Search,
    ];

    /// The name on the command line and in files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Bodies => "bodies",
            Self::Generations => "generations",
            Self::Size => "size",
            Self::Samples => "samples",
            Self::Threads => "threads",
            Self::Method => "method",
            Self::Fineness => "fineness",
            Self::CubeMapSize => "cube-map-size",
            Self::Search => "search",
        }
    }

    /// The parameter of this name.
    pub fn find(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.key() == key)
    }

    /// The most that a count may be.
    fn most(self) -> u32 {
        match self {
            // A body takes some hundred bytes in the scene and the scene.
            Self::Bodies => (RenderScene::MAX_BODIES as u32).min(10_000_000),
            Self::Generations => Tracing::MAX_GENERATIONS,
            Self::Samples => RenderSettings::MAX_SAMPLES,
            Self::Threads => 1024,
            Self::Fineness => *ShadingSettings::FINENESS.end(),
            Self::CubeMapSize => *CubeMapSettings::SIZE.end(),
            Self::Size | Self::Method | Self::Search => 0,
        }
    }

    /// The values when none are given, `threads` being those of the machine.
    pub fn usual_values(self, threads: usize) -> Vec<Value> {
        let counts = |counts: &[u32]| counts.iter().copied().map(Value::Count).collect();
        match self {
            Self::Bodies => counts(&[10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000]),
            Self::Generations => counts(&[1, 2, 3, 4, 5, 6, 8, 10, 12]),
            Self::Size => {
                let sizes =
                    [[160, 90], [240, 135], [320, 180], [480, 270], [640, 360], [960, 540], [1280, 720]];
                sizes.map(Value::Size).to_vec()
            }
            Self::Samples => counts(&[1, 2, 4, 8, 16]),
            Self::Threads => {
                let threads = u32::try_from(threads).unwrap_or(u32::MAX).clamp(1, self.most());
                let all = 1..=threads.min(8);
                let doubled = std::iter::successors(Some(12), |count| Some(count / 2 * 3)).take(14);
                let more = doubled.filter(|count| *count < threads);
                let mut values: Vec<u32> = all.chain(more).chain([threads]).collect();
                values.dedup();
                counts(&values)
            }
            Self::Method => {
                let kinds = catoptric_tracer::raster::MethodKind::ALL;
                kinds.map(|kind| Value::Method(kind.method().into())).to_vec()
            }
            Self::Fineness => counts(&[1, 2, 4, 8, 16, 32, 64]),
            Self::CubeMapSize => counts(&[16, 32, 64, 128, 256, 512]),
            Self::Search => {
                [AcceleratorChoice::Quickest, AcceleratorChoice::OneByOne].map(Value::Search).to_vec()
            }
        }
    }

    /// Reads a value.
    ///
    /// # Errors
    /// What can be written.
    pub(super) fn value(self, text: &str) -> Result<Value, String> {
        match self {
            Self::Size => {
                let sides = text.split_once(['x', 'X', '×']);
                let sides =
                    sides.and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
                let size: [u32; 2] = sides.ok_or("give width and height in pixels, such as 640x360")?;
                catoptric_picture::Picture::check_size(size[0], size[1])
                    .map_err(|error| error.to_string())?;
                Ok(Value::Size(size))
            }
            Self::Method => {
                text.parse().map(Value::Method).map_err(|error: crate::VariantError| error.to_string())
            }
            Self::Search => match text {
                "hierarchy" => Ok(Value::Search(AcceleratorChoice::Quickest)),
                "one-by-one" => Ok(Value::Search(AcceleratorChoice::OneByOne)),
                _ => Err("give hierarchy or one-by-one".to_owned()),
            },
            _ => {
                let least = u32::from(self != Self::Bodies);
                let count = text.parse().ok().filter(|count| (least..=self.most()).contains(count));
                let expected = || format!("give a whole number from {least} to {}", self.most());
                Ok(Value::Count(count.ok_or_else(expected)?))
            }
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.key())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count}"),
            Self::Size([width, height]) => write!(f, "{width}x{height}"),
            Self::Method(variant) => variant.fmt(f),
            Self::Search(AcceleratorChoice::Quickest) => f.pad("hierarchy"),
            Self::Search(AcceleratorChoice::OneByOne) => f.pad("one-by-one"),
            Self::Setting(SceneValue::Text(text)) => f.pad(text),
            Self::Setting(value) => value.fmt(f),
        }
    }
}

impl Value {
    /// The number along an axis: a count, the pixels of a size, a number of the scene, or nothing.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(f64::from(*count)),
            Self::Size([width, height]) => Some(f64::from(*width) * f64::from(*height)),
            Self::Setting(SceneValue::Number(number)) => Some(*number),
            Self::Method(_) | Self::Search(_) | Self::Setting(_) => None,
        }
    }
}
