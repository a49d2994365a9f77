//! The parameters of measurements, and their values.

use std::fmt;

use catoptric_scene::Tracing;
use catoptric_tracer::raster::{CubeMapSettings, Method, ShadingSettings};
use catoptric_tracer::{AcceleratorChoice, RenderScene, RenderSettings};

use crate::variant::Variant;

/// A parameter that a sweep varies.
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

/// A value of a parameter.
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
}

/// A parameter and its values, at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is varied.
    pub parameter: Parameter,
    /// The values, in the order in which they are shown.
    pub values: Vec<Value>,
}

/// The reason why a text is no [`Axis`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AxisError {
    /// There is no such parameter.
    #[error("cannot vary \"{name}\"; there are {}", Parameter::ALL.map(Parameter::key).join(", "))]
    Parameter {
        /// What was written.
        name: String,
    },
    /// A value makes no sense for the parameter.
    #[error("{parameter} cannot be \"{value}\": {expected}")]
    Value {
        /// The parameter.
        parameter: Parameter,
        /// What was written.
        value: String,
        /// What can be written, or what is wrong.
        expected: String,
    },
    /// One parameter, or two.
    #[error("vary one parameter or two, not {0}")]
    Number(usize),
    /// A parameter is named twice.
    #[error("{0} is varied twice; name each parameter once")]
    Twice(Parameter),
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
    fn value(self, text: &str) -> Result<Value, AxisError> {
        let wrong = |expected: String| AxisError::Value { parameter: self, value: text.to_owned(), expected };
        match self {
            Self::Size => {
                let sides = text.split_once(['x', 'X', '×']);
                let sides =
                    sides.and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
                let size: [u32; 2] = sides
                    .ok_or_else(|| wrong("give width and height in pixels, such as 640x360".to_owned()))?;
                catoptric_picture::Picture::check_size(size[0], size[1])
                    .map_err(|error| wrong(error.to_string()))?;
                Ok(Value::Size(size))
            }
            Self::Method => {
                text.parse().map(Value::Method).map_err(|error: crate::VariantError| wrong(error.to_string()))
            }
            Self::Search => match text {
                "hierarchy" => Ok(Value::Search(AcceleratorChoice::Quickest)),
                "one-by-one" => Ok(Value::Search(AcceleratorChoice::OneByOne)),
                _ => Err(wrong("give hierarchy or one-by-one".to_owned())),
            },
            _ => {
                let least = u32::from(self != Self::Bodies);
                let count = text.parse().ok().filter(|count| (least..=self.most()).contains(count));
                let expected = || wrong(format!("give a whole number from {least} to {}", self.most()));
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
        }
    }
}

impl Value {
    /// The number that a law is about: a count, the pixels of a size, or nothing.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Count(count) => Some(f64::from(*count)),
            Self::Size([width, height]) => Some(f64::from(*width) * f64::from(*height)),
            Self::Method(_) | Self::Search(_) => None,
        }
    }
}

impl Axis {
    /// Reads what to vary: one parameter or two, separated by commas, each with the values that follow a `=` or the
    /// usual ones. In `bodies=10,100,search` a parameter's name ends the values of the one before.
    ///
    /// # Errors
    /// What is wrong, and what can be written.
    pub fn read(text: &str, threads: usize) -> Result<Vec<Self>, AxisError> {
        let mut axes: Vec<Self> = Vec::new();
        for word in text.split(',').map(str::trim) {
            let (key, first) = word.split_once('=').map_or((word, None), |(key, value)| (key, Some(value)));
            match (Parameter::find(key), axes.last_mut()) {
                (Some(parameter), _) => {
                    let values = first.map(|value| parameter.value(value)).transpose()?;
                    axes.push(Self { parameter, values: values.into_iter().collect() });
                }
                // A method may have settings, with a = of their own.
                (None, Some(axis)) if !axis.values.is_empty() => {
                    axis.values.push(axis.parameter.value(word)?);
                }
                _ => return Err(AxisError::Parameter { name: key.to_owned() }),
            }
        }
        for axis in &mut axes {
            if axis.values.is_empty() {
                axis.values = axis.parameter.usual_values(threads);
            }
        }
        Self::check(&axes)?;
        Ok(axes)
    }

    /// One parameter or two different ones.
    pub(super) fn check(axes: &[Self]) -> Result<(), AxisError> {
        match axes {
            [one, other] if one.parameter == other.parameter => Err(AxisError::Twice(one.parameter)),
            [_] | [_, _] => Ok(()),
            _ => Err(AxisError::Number(axes.len())),
        }
    }

    /// The method that the values of a parameter are about, unless it is the one that is asked for.
    pub(super) fn applies(parameter: Parameter, method: &Method) -> bool {
        match parameter {
            Parameter::Fineness => matches!(method, Method::Flat(_) | Method::Gouraud(_) | Method::Phong(_)),
            Parameter::CubeMapSize => matches!(method, Method::CubeMap(_)),
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> String {
        match Axis::read(text, 4) {
            Ok(axes) => {
                let values =
                    |axis: &Axis| axis.values.iter().map(Value::to_string).collect::<Vec<_>>().join(" ");
                axes.iter()
                    .map(|axis| format!("{}: {}", axis.parameter, values(axis)))
                    .collect::<Vec<_>>()
                    .join("; ")
            }
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn parameters_and_values_are_told_apart() {
        assert_eq!(read("threads"), "threads: 1 2 3 4");
        assert_eq!(read("bodies=10,100,search"), "bodies: 10 100; search: hierarchy one-by-one");
        assert_eq!(
            read("size=64x36, 128x72 ,method=whitted,whitted:generations=2,ssr"),
            "size: 64x36 128x72; method: whitted whitted:generations=2 ssr"
        );
        assert_eq!(read("search=one-by-one,bodies=0"), "search: one-by-one; bodies: 0");
    }

    #[test]
    fn usual_values_are_valid() {
        for parameter in Parameter::ALL {
            for threads in [1, 2, 6, 8, 16, 100, 100_000] {
                let values = parameter.usual_values(threads);
                assert!(!values.is_empty());
                for value in &values {
                    assert_eq!(parameter.value(&value.to_string()), Ok(value.clone()), "{parameter}");
                }
                let numbers: Vec<f64> = values.iter().filter_map(Value::number).collect();
                assert!(
                    numbers.windows(2).all(|pair| pair[0] < pair[1]),
                    "{parameter} {threads}: {numbers:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("", "cannot vary \"\"; there are bodies, generations, size"),
            ("speed", "cannot vary \"speed\""),
            ("10,bodies", "cannot vary \"10\""),
            ("bodies,10", "cannot vary \"10\""),
            ("bodies=", "bodies cannot be \"\": give a whole number from 0 to 10000000"),
            ("bodies=-1", "bodies cannot be \"-1\""),
            ("generations=0", "generations cannot be \"0\": give a whole number from 1 to 64"),
            ("generations=65", "generations cannot be \"65\""),
            ("size=64", "size cannot be \"64\": give width and height"),
            ("size=0x5", "size cannot be \"0x5\""),
            ("size=999999x999999", "size cannot be"),
            ("method=raster", "there is no method \"raster\""),
            ("search=bvh", "give hierarchy or one-by-one"),
            ("bodies=1,bodies=2", "bodies is varied twice"),
            ("bodies,size,threads", "vary one parameter or two, not 3"),
        ] {
            let error = read(text);
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
