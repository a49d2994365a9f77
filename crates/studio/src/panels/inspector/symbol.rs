//! The symbols of the model's formula, which rows and formula share.

/// A quantity of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Symbol {
    /// k_a
    Ambient,
    /// C
    Color,
    /// I_a
    AmbientLight,
    /// V_j
    Visibility,
    /// A(d_j)
    Falloff,
    /// K of the linear falloff
    FalloffConstant,
    /// I_j
    Light,
    /// k_d
    Diffuse,
    /// N·L
    Lambert,
    /// k_s
    Specular,
    /// S·R
    Mirrored,
    /// n
    Shininess,
    /// k_r
    Reflection,
    /// I of the reflected ray
    Reflected,
    /// k_t
    Transmission,
    /// τ
    Tint,
    /// I of the refracted ray
    Refracted,
    /// η
    Ior,
    /// s of a pattern
    PatternSize,
    /// The color of a light
    LightColor,
    /// The intensity of a light
    Intensity,
}

impl Symbol {
    /// The symbol as markup; what has words of its own is given by a message instead.
    pub(crate) const fn markup(self) -> &'static str {
        match self {
            Self::Ambient => "k_a",
            Self::Color => "C",
            Self::AmbientLight => "I_a",
            Self::Visibility => "V_j",
            Self::Falloff => "A(d_j)",
            Self::FalloffConstant => "K",
            Self::Light => "I_j",
            Self::Diffuse => "k_d",
            Self::Lambert => "(~n · ~L_j)",
            Self::Specular => "k_s",
            Self::Mirrored => "((~S · ~R_j)^+)",
            Self::Shininess => "n",
            Self::Reflection => "k_r",
            Self::Transmission => "k_t",
            Self::Tint => "τ",
            Self::Ior => "η",
            Self::PatternSize => "s",
            Self::Reflected | Self::Refracted | Self::LightColor | Self::Intensity => "",
        }
    }

    /// The message that explains it.
    pub(crate) const fn tip_key(self) -> &'static str {
        match self {
            Self::Ambient => "ambient",
            Self::Color => "material-color",
            Self::AmbientLight => "ambient-light",
            Self::Visibility => "in-formula-visibility",
            Self::Falloff => "falloff",
            Self::FalloffConstant => "falloff-constant",
            Self::Light => "in-formula-light",
            Self::Diffuse => "diffuse",
            Self::Lambert => "in-formula-lambert",
            Self::Specular => "specular",
            Self::Mirrored => "in-formula-mirrored",
            Self::Shininess => "shininess",
            Self::Reflection => "reflection",
            Self::Reflected => "in-formula-reflected",
            Self::Transmission => "transmission",
            Self::Tint => "tint",
            Self::Refracted => "in-formula-refracted",
            Self::Ior => "ior",
            Self::PatternSize => "pattern-size",
            Self::LightColor => "light-color",
            Self::Intensity => "intensity",
        }
    }
}
