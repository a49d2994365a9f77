//! A way of drawing a scene as one names it: a method and what is set apart from its defaults.

use std::fmt;
use std::str::FromStr;

use catoptric_scene::Tracing;
use catoptric_tracer::RenderSettings;
use catoptric_tracer::raster::{
    CubeMapSettings, LightModel, Method, MethodKind, SettingError, ShadingSettings, SsrFallback, SsrSettings,
};

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
    /// The text that it was read from.
    pub name: String,
    /// The method with its settings.
    pub method: Method,
    /// The limit of generations, instead of that of the scene.
    pub generations: Option<u32>,
    /// Samples per pixel, instead of those of the whole comparison.
    pub samples: Option<u32>,
}

/// The reason why a text is no [`Variant`].
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
        Self { name: named(&method), method, generations: None, samples: None }
    }
}

/// The method as it would be written, with the settings that are not the usual ones.
fn named(method: &Method) -> String {
    let mut name = method.name().to_owned();
    let mut add = |key: &str, value: String, usual: String| {
        if value != usual {
            name = format!("{name}:{key}={value}");
        }
    };
    let of_map = |map: &CubeMapSettings| (map.size.to_string(), switched(map.parallax));
    let usual_map = of_map(&CubeMapSettings::default());
    match method {
        Method::Whitted => {}
        Method::Flat(own) | Method::Gouraud(own) | Method::Phong(own) => {
            let usual = ShadingSettings::default();
            add("fineness", own.fineness.to_string(), usual.fineness.to_string());
            add("shadows", switched(own.shadows), switched(usual.shadows));
            add("model", own.model.name().to_owned(), usual.model.name().to_owned());
        }
        Method::Ssr(own) => {
            let usual = SsrSettings::default();
            add("step", own.step_pixels.to_string(), usual.step_pixels.to_string());
            add("thickness", own.thickness.to_string(), usual.thickness.to_string());
            add("range", own.range.to_string(), usual.range.to_string());
            add("refinements", own.refinements.to_string(), usual.refinements.to_string());
            if let SsrFallback::CubeMap(map) = &own.fallback {
                let (size, parallax) = of_map(map);
                add("fallback", "cube-map".to_owned(), String::new());
                add("size", size, usual_map.0);
                add("parallax", parallax, usual_map.1);
            }
        }
        Method::CubeMap(map) => {
            let (size, parallax) = of_map(map);
            add("size", size, usual_map.0);
            add("parallax", parallax, usual_map.1);
        }
    }
    name
}

fn switched(is_on: bool) -> String {
    if is_on { "on" } else { "off" }.to_owned()
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
                // Of the map that was named before.
                _ => match &mut ssr.fallback {
                    SsrFallback::CubeMap(map) => set_map(map, key, value, unknown)?,
                    SsrFallback::Background => return Err(unknown),
                },
            },
            (_, Method::CubeMap(map)) => set_map(map, key, value, unknown)?,
            (_, Method::Whitted) => return Err(unknown),
        }
        Ok(())
    }
}

/// Sets one thing of a cube map.
fn set_map(
    map: &mut CubeMapSettings,
    key: &str,
    value: &str,
    unknown: VariantError,
) -> Result<(), VariantError> {
    match key {
        "size" => map.size = number(key, value)?,
        "parallax" => map.parallax = switch(key, value)?,
        _ => return Err(unknown),
    }
    Ok(())
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

fn fallback(key: &str, value: &str) -> Result<SsrFallback, VariantError> {
    match value {
        "background" => Ok(SsrFallback::Background),
        "cube-map" => Ok(SsrFallback::CubeMap(CubeMapSettings::default())),
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
        assert_eq!(ssr.fallback, SsrFallback::CubeMap(CubeMapSettings::default()));
        let Method::CubeMap(map) = variant("cube-map:size=64:parallax=on").method else { panic!() };
        assert_eq!(map, CubeMapSettings { size: 64, parallax: true });
    }

    #[test]
    fn a_method_is_named_as_it_is_written() {
        for name in [
            "whitted",
            "flat:fineness=3:shadows=on:model=lambert",
            "ssr:step=2.5:thickness=0.3:range=7:refinements=0",
            "ssr:fallback=cube-map",
            "ssr:fallback=cube-map:size=64:parallax=on",
            "cube-map:size=64:parallax=on",
        ] {
            assert_eq!(Variant::from(variant(name).method), variant(name));
        }
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
            ("ssr:size=64", "the method ssr has no setting \"size\""),
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
