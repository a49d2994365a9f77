//! The ways of drawing: which one is chosen, with which settings, and how they are called.

use catoptric_lab::Variant;
use catoptric_live::DisplayContent;
use catoptric_tracer::raster::{GBufferLayer, Method, MethodKind};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;
use serde::{Deserialize, Serialize};

use crate::base::texts::Texts;

/// The methods with the settings that each had last, and the one that is chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "StoredMethods", into = "StoredMethods")]
pub struct MethodSettings {
    chosen: MethodKind,
    /// In the order of [`MethodKind::ALL`].
    all: [Method; MethodKind::ALL.len()],
}

/// The form in the settings file: each method as the command line writes it.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct StoredMethods {
    chosen: String,
    settings: Vec<String>,
}

impl Default for MethodSettings {
    fn default() -> Self {
        Self { chosen: MethodKind::Whitted, all: MethodKind::ALL.map(MethodKind::method) }
    }
}

impl MethodSettings {
    /// The default settings with one method chosen.
    pub(crate) fn with(kind: MethodKind) -> Self {
        Self { chosen: kind, ..Self::default() }
    }

    /// The chosen one.
    pub fn method(&self) -> Method {
        self.of(self.chosen)
    }

    /// The chosen one without its settings.
    pub fn kind(&self) -> MethodKind {
        self.chosen
    }

    /// A method with the settings that it had last.
    pub fn of(&self, kind: MethodKind) -> Method {
        self.all.iter().copied().find(|method| method.kind() == kind).unwrap_or_else(|| kind.method())
    }

    /// Chooses another one.
    pub fn choose(&mut self, kind: MethodKind) {
        self.chosen = kind;
    }

    /// Gives the method of this kind other settings. All methods of faces have the same.
    pub fn set(&mut self, method: Method) {
        for known in &mut self.all {
            match (known, method) {
                (
                    Method::Flat(own) | Method::Gouraud(own) | Method::Phong(own),
                    Method::Flat(new) | Method::Gouraud(new) | Method::Phong(new),
                ) => *own = new,
                (known, _) if known.kind() == method.kind() => *known = method,
                _ => {}
            }
        }
    }
}

impl From<StoredMethods> for MethodSettings {
    fn from(written: StoredMethods) -> Self {
        let mut methods = Self::default();
        // What another version has written otherwise is as at the first time.
        for method in written.settings.iter().filter_map(|text| text.parse::<Variant>().ok()) {
            methods.set(method.method);
        }
        let chosen = MethodKind::ALL.into_iter().find(|kind| kind.name() == written.chosen);
        methods.chosen = chosen.unwrap_or(MethodKind::Whitted);
        methods
    }
}

impl From<MethodSettings> for StoredMethods {
    fn from(methods: MethodSettings) -> Self {
        let settings = methods.all.map(|method| Variant::from(method).name).to_vec();
        Self { chosen: methods.chosen.name().to_owned(), settings }
    }
}

/// The message that names a method; its attribute `.tip` explains it, and `.short` is for where there is little room.
pub(crate) const fn method_key(kind: MethodKind) -> &'static str {
    match kind {
        MethodKind::Whitted => "command-method-whitted",
        MethodKind::Ssr => "command-method-ssr",
        MethodKind::CubeMap => "command-method-cube-map",
        MethodKind::Phong => "command-method-phong",
        MethodKind::Gouraud => "command-method-gouraud",
        MethodKind::Flat => "command-method-flat",
    }
}

/// A method's name where there is little room.
pub(crate) const fn short_key(kind: MethodKind) -> &'static str {
    match kind {
        MethodKind::Whitted => "method-whitted",
        MethodKind::Ssr => "method-ssr",
        MethodKind::CubeMap => "method-cube-map",
        MethodKind::Phong => "method-phong",
        MethodKind::Gouraud => "method-gouraud",
        MethodKind::Flat => "method-flat",
    }
}

/// What can be seen of a drawing, in the order in which to offer it.
pub(crate) const ALL_SHOWN: [DisplayContent; 9] = [
    DisplayContent::Picture,
    DisplayContent::Layer(GBufferLayer::Depth),
    DisplayContent::Layer(GBufferLayer::Normal),
    DisplayContent::Layer(GBufferLayer::Body),
    DisplayContent::Layer(GBufferLayer::Color),
    DisplayContent::Layer(GBufferLayer::Coefficients),
    DisplayContent::Layer(GBufferLayer::Lit),
    DisplayContent::Layer(GBufferLayer::Reflected),
    DisplayContent::UnfoldedCube(None),
];

/// The message that names what is seen; its attribute `.tip` explains it.
pub(crate) const fn shown_key(shows: DisplayContent) -> &'static str {
    match shows {
        DisplayContent::Picture => "command-show-picture",
        DisplayContent::Layer(GBufferLayer::Depth) => "command-show-depth",
        DisplayContent::Layer(GBufferLayer::Normal) => "command-show-normal",
        DisplayContent::Layer(GBufferLayer::Color) => "command-show-color",
        DisplayContent::Layer(GBufferLayer::Coefficients) => "command-show-coefficients",
        DisplayContent::Layer(GBufferLayer::Body) => "command-show-body",
        DisplayContent::Layer(GBufferLayer::Lit) => "command-show-lit",
        DisplayContent::Layer(GBufferLayer::Reflected) => "command-show-reflected",
        DisplayContent::UnfoldedCube(_) => "command-show-unfolded",
    }
}

/// Whether a method's drawings have what is to be seen.
pub(crate) fn has(method: &Method, shows: DisplayContent) -> bool {
    use catoptric_tracer::raster::SsrFallback;
    match (shows, method) {
        (DisplayContent::Picture, _)
        | (_, Method::CubeMap(_))
        | (DisplayContent::Layer(_), Method::Ssr(_)) => true,
        (DisplayContent::UnfoldedCube(_), Method::Ssr(ssr)) => {
            matches!(ssr.fallback, SsrFallback::CubeMap(_))
        }
        _ => false,
    }
}

/// The icon of a method.
pub(crate) const fn icon(kind: MethodKind) -> MaterialIcon {
    match kind {
        MethodKind::Whitted => icons::ICON_FLARE,
        MethodKind::Ssr => icons::ICON_SCREENSHOT_MONITOR,
        MethodKind::CubeMap => icons::ICON_VRPANO,
        MethodKind::Phong => icons::ICON_BLUR_LINEAR,
        MethodKind::Gouraud => icons::ICON_GRADIENT,
        MethodKind::Flat => icons::ICON_CATEGORY,
    }
}

/// The language in which the lab writes what is said in this one.
pub(crate) fn report_language(texts: &Texts) -> catoptric_lab::report::Language {
    match texts.language() {
        crate::base::texts::Language::English => catoptric_lab::report::Language::English,
        crate::base::texts::Language::Russian => catoptric_lab::report::Language::Russian,
    }
}

#[cfg(test)]
mod tests {
    use catoptric_tracer::raster::{CubeMapSettings, ShadingSettings};

    use super::*;

    #[test]
    fn what_was_chosen_is_remembered() {
        let mut methods = MethodSettings::with(MethodKind::Ssr);
        methods.set(Method::CubeMap(CubeMapSettings { size: 64, parallax: true }));
        methods.set(Method::Flat(ShadingSettings { fineness: 3, ..ShadingSettings::default() }));
        assert_eq!(
            methods.of(MethodKind::Phong),
            Method::Phong(ShadingSettings { fineness: 3, ..ShadingSettings::default() })
        );
        let text = serde_json::to_string(&methods).unwrap();
        assert_eq!(serde_json::from_str::<MethodSettings>(&text).unwrap(), methods);
        let damaged = r#"{"chosen": "radiosity", "settings": ["flat:fineness=900", "cube-map:size=8"]}"#;
        let mut expected = MethodSettings::default();
        expected.set(Method::CubeMap(CubeMapSettings { size: 8, parallax: false }));
        assert_eq!(serde_json::from_str::<MethodSettings>(damaged).unwrap(), expected);
    }
}
