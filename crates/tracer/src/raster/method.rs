//! The methods of drawing reflections, by name and with their settings.

use crate::raster::settings::{CubeMapSettings, SettingError, ShadingSettings, SsrSettings};

/// How reflections are found, with the settings of each way. Each has a page in the documents, `methods/`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Whitted's tree of rays (Whitted 1980): the truth of this program.
    Whitted,
    /// Bodies of flat faces, one intensity for each; no reflections.
    Flat(ShadingSettings),
    /// Intensities at the vertices, interpolated across the faces (Gouraud 1971); no reflections.
    Gouraud(ShadingSettings),
    /// Normals interpolated across the faces, the local terms in each pixel (Phong 1975); no reflections.
    Phong(ShadingSettings),
    /// Reflected rays marched through the depths of the picture itself (Sousa et al. 2011; McGuire, Mara 2014).
    Ssr(SsrSettings),
    /// Reflected directions looked up in a picture of the surroundings (Blinn, Newell 1976; Greene 1986).
    CubeMap(CubeMapSettings),
}

/// A [`Method`] without its settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MethodKind {
    /// [`Method::Whitted`].
    Whitted,
    /// [`Method::Flat`].
    Flat,
    /// [`Method::Gouraud`].
    Gouraud,
    /// [`Method::Phong`].
    Phong,
    /// [`Method::Ssr`].
    Ssr,
    /// [`Method::CubeMap`].
    CubeMap,
}

/// What a method can do, for those who offer methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodAbilities {
    /// Its pictures are the truth that others are compared with.
    pub is_reference: bool,
    /// A finished picture takes further samples: a [`Film`](crate::Film) serves.
    pub accumulates: bool,
    /// Graphics cards draw it.
    pub runs_on_gpu: bool,
    /// A tree of rays stands behind each pixel, so that its work can be estimated.
    pub has_ray_tree: bool,
    /// Its pictures have [layers](crate::raster::GBufferLayer).
    pub has_layers: bool,
}

impl MethodKind {
    /// All methods, in the order in which to offer them.
    pub const ALL: [Self; 6] =
        [Self::Whitted, Self::Ssr, Self::CubeMap, Self::Phong, Self::Gouraud, Self::Flat];

    /// The method's name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whitted => "whitted",
            Self::Flat => "flat",
            Self::Gouraud => "gouraud",
            Self::Phong => "phong",
            Self::Ssr => "ssr",
            Self::CubeMap => "cube-map",
        }
    }

    /// What the method can do.
    pub const fn abilities(self) -> MethodAbilities {
        let is_traced = matches!(self, Self::Whitted);
        MethodAbilities {
            is_reference: is_traced,
            accumulates: is_traced,
            runs_on_gpu: is_traced,
            has_ray_tree: is_traced,
            has_layers: matches!(self, Self::Ssr | Self::CubeMap),
        }
    }

    /// The method with default settings.
    pub fn method(self) -> Method {
        match self {
            Self::Whitted => Method::Whitted,
            Self::Flat => Method::Flat(ShadingSettings::default()),
            Self::Gouraud => Method::Gouraud(ShadingSettings::default()),
            Self::Phong => Method::Phong(ShadingSettings::default()),
            Self::Ssr => Method::Ssr(SsrSettings::default()),
            Self::CubeMap => Method::CubeMap(CubeMapSettings::default()),
        }
    }
}

impl std::fmt::Display for MethodKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

impl Method {
    /// The method without its settings.
    pub const fn kind(&self) -> MethodKind {
        match self {
            Self::Whitted => MethodKind::Whitted,
            Self::Flat(_) => MethodKind::Flat,
            Self::Gouraud(_) => MethodKind::Gouraud,
            Self::Phong(_) => MethodKind::Phong,
            Self::Ssr(_) => MethodKind::Ssr,
            Self::CubeMap(_) => MethodKind::CubeMap,
        }
    }

    /// What the method can do.
    pub const fn abilities(&self) -> MethodAbilities {
        self.kind().abilities()
    }

    /// The method's name on the command line and in reports.
    pub const fn name(&self) -> &'static str {
        self.kind().name()
    }

    /// Whether the settings are within their ranges.
    ///
    /// # Errors
    /// For the first setting that is not.
    pub fn check(&self) -> Result<(), SettingError> {
        match self {
            Self::Whitted => Ok(()),
            Self::Flat(settings) | Self::Gouraud(settings) | Self::Phong(settings) => settings.check(),
            Self::Ssr(settings) => settings.check(),
            Self::CubeMap(settings) => settings.check(),
        }
    }
}
