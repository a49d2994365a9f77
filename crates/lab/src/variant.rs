//! A way of drawing a scene as one names it: a method and what is set apart from its defaults.

use std::fmt;
use std::str::FromStr;

use catoptric_scene::Tracing;
use catoptric_tracer::RenderSettings;
use catoptric_tracer::method::{CubeMapSettings, Fallback, LightModel, Method, MethodKind, SettingError};

/// A method with settings, and the limit of generations and samples where they are set apart.
///
/// Written as `METHOD[:KEY=VALUE]…`, for example `whitted:generations=2` or `ssr:range=5:fallback=cube-map`.
///
/// ```
/// use catoptric_lab::Variant;
/// let variant: Variant = "cube-map:size=64:parallax".parse()?;
/// assert_eq!(variant.name, "cube-map:size=64:parallax");
/// assert!("whitted:size=64".parse::<Variant>().is_err());
/// # Ok::<(), catoptric_lab::VariantError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// As it was written.
    pub name: String,
    /// The method with its settings.
    pub method: Method,
    /// The limit of generations, instead of that of the scene.
    pub generations: Option<u32>,
    /// Samples per pixel, instead of those of the whole comparison.
    pub samples: Option<u32>,
}

/// Why a text is no [`Variant`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VariantError {
    /// There is no such method.
    #[error("there is no method \"{name}\"; there are {}", names())]
    Method {
        /// What was written.
        name: String,
    },
    /// The method has no such setting.
    #[error("the method {method} has no setting \"{key}\"; it has {}", keys(*method).join(", "))]
    Key {
        /// The method.
        method: MethodKind,
        /// What was written.
        key: String,
    },
    /// The value cannot be read.
    #[error("the setting {key} cannot be \"{value}\"; give {expected}")]
    Value {
        /// The setting.
        key: String,
        /// What was written.
        value: String,
        /// What can be written.
        expected: &'static str,
    },
    /// The value is out of its range.
    #[error(transparent)]
    Range(#[from] SettingError),
}

fn names() -> String {
    MethodKind::ALL.map(MethodKind::name).join(", ")
}

/// The settings that a method has.
fn keys(method: MethodKind) -> Vec<&'static str> {
    let own: &[&str] = match method {
        MethodKind::Whitted => &[],
        MethodKind::Flat | MethodKind::Gouraud | MethodKind::Phong => &["fineness", "shadows", "model"],
        MethodKind::Ssr => &["step", "thickness", "range", "refinements", "fallback"],
        MethodKind::CubeMap => &["size", "parallax"],
    };
    own.iter().copied().chain(["generations", "samples"]).collect()
}

impl From<Method> for Variant {
    fn from(method: Method) -> Self {
        Self { name: method.name().to_owned(), method, generations: None, samples: None }
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name)
    }
}

impl FromStr for Variant {
    type Err = VariantError;

    fn from_str(text: &str) -> Result<Self, VariantError> {
        let mut parts = text.trim().split(':');
        let name = parts.next().unwrap_or_default();
        let kind = MethodKind::ALL.into_iter().find(|kind| kind.name() == name);
        let kind = kind.ok_or_else(|| VariantError::Method { name: name.to_owned() })?;
        let mut variant = Self { name: text.trim().to_owned(), ..kind.method().into() };
        for part in parts {
            // A key alone switches on.
            let (key, value) = part.split_once('=').unwrap_or((part, "on"));
            variant.set(key.trim(), value.trim())?;
        }
        variant.method.check()?;
        Ok(variant)
    }
}

impl Variant {
    /// Sets one thing.
    fn set(&mut self, key: &str, value: &str) -> Result<(), VariantError> {
        let unknown = VariantError::Key { method: self.method.kind(), key: key.to_owned() };
        match (key, &mut self.method) {
            ("generations", _) => self.generations = Some(within(key, value, Tracing::MAX_GENERATIONS)?),
            ("samples", _) => self.samples = Some(within(key, value, RenderSettings::MAX_SAMPLES)?),
            (_, Method::Flat(shading) | Method::Gouraud(shading) | Method::Phong(shading)) => match key {
                "fineness" => shading.fineness = number(key, value)?,
                "shadows" => shading.shadows = switch(key, value)?,
                "model" => shading.model = model(key, value)?,
                _ => return Err(unknown),
            },
            (_, Method::Ssr(ssr)) => match key {
                "step" => ssr.step_pixels = number(key, value)?,
                "thickness" => ssr.thickness = number(key, value)?,
                "range" => ssr.range = number(key, value)?,
                "refinements" => ssr.refinements = number(key, value)?,
                "fallback" => ssr.fallback = fallback(key, value)?,
                _ => return Err(unknown),
            },
            (_, Method::CubeMap(map)) => match key {
                "size" => map.size = number(key, value)?,
                "parallax" => map.parallax = switch(key, value)?,
                _ => return Err(unknown),
            },
            (_, Method::Whitted) => return Err(unknown),
        }
        Ok(())
    }
}

fn wrong(key: &str, value: &str, expected: &'static str) -> VariantError {
    VariantError::Value { key: key.to_owned(), value: value.to_owned(), expected }
}

fn number<T: FromStr>(key: &str, value: &str) -> Result<T, VariantError> {
    value.parse().map_err(|_| wrong(key, value, "a number"))
}

fn within(key: &str, value: &str, most: u32) -> Result<u32, VariantError> {
    match number(key, value)? {
        0 => Err(wrong(key, value, "at least 1")),
        number if number > most => {
            let (value, most) = (f64::from(number), f64::from(most));
            let name = if key == "samples" { "number of samples" } else { "limit of generations" };
            Err(SettingError { name, value, least: 1.0, most }.into())
        }
        number => Ok(number),
    }
}

fn switch(key: &str, value: &str) -> Result<bool, VariantError> {
    match value {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(wrong(key, value, "on or off")),
    }
}

fn model(key: &str, value: &str) -> Result<LightModel, VariantError> {
    let models = [LightModel::Lambert, LightModel::Phong];
    let found = models.into_iter().find(|model| model.name() == value);
    found.ok_or_else(|| wrong(key, value, "lambert or phong"))
}

fn fallback(key: &str, value: &str) -> Result<Fallback, VariantError> {
    match value {
        "background" => Ok(Fallback::Background),
        "cube-map" => Ok(Fallback::CubeMap(CubeMapSettings::default())),
        _ => Err(wrong(key, value, "background or cube-map")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variant(text: &str) -> Variant {
        text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    #[test]
    fn every_method_and_setting_can_be_named() {
        for kind in MethodKind::ALL {
            assert_eq!(variant(kind.name()), kind.method().into());
        }
        let whitted = variant("whitted:generations=2:samples=16");
        assert_eq!((whitted.generations, whitted.samples), (Some(2), Some(16)));
        let Method::Phong(shading) = variant("phong:fineness=3:shadows:model=lambert").method else {
            panic!()
        };
        assert_eq!((shading.fineness, shading.shadows, shading.model), (3, true, LightModel::Lambert));
        let text = "ssr:step=2.5:thickness=0.3:range=7:refinements=0:fallback=cube-map";
        let Method::Ssr(ssr) = variant(text).method else { panic!() };
        assert_eq!((ssr.step_pixels, ssr.thickness, ssr.range, ssr.refinements), (2.5, 0.3, 7.0, 0));
        assert_eq!(ssr.fallback, Fallback::CubeMap(CubeMapSettings::default()));
        let Method::CubeMap(map) = variant("cube-map:size=64:parallax=on").method else { panic!() };
        assert_eq!(map, CubeMapSettings { size: 64, parallax: true });
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("", "there is no method \"\"; there are whitted, ssr, cube-map, phong, gouraud, flat"),
            ("raster", "there is no method \"raster\""),
            ("whitted:size=3", "the method whitted has no setting \"size\"; it has generations, samples"),
            ("ssr:", "the method ssr has no setting \"\"; it has step, thickness"),
            ("ssr:range=far", "the setting range cannot be \"far\"; give a number"),
            ("ssr:range=-1", "the range in meters is -1"),
            ("ssr:range=NaN", "the range in meters is NaN"),
            ("flat:fineness=0", "the fineness is 0; it must be from 1 to 128"),
            ("flat:shadows=yes", "give on or off"),
            ("flat:model=blinn", "give lambert or phong"),
            ("cube-map:size=-4", "give a number"),
            ("whitted:generations=0", "give at least 1"),
            ("whitted:generations=65", "the limit of generations is 65; it must be from 1 to 64"),
            ("whitted:samples=65537", "the number of samples is 65537"),
        ] {
            let error = text.parse::<Variant>().unwrap_err().to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
