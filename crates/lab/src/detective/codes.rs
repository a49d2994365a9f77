//! From light to the codes of a picture, as programs do it rightly and wrongly.

use std::sync::OnceLock;

/// The curve from light 0…1 to codes 0…1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CodeCurve {
    /// Codes are in proportion to light.
    #[default]
    Linear,
    /// The function of sRGB.
    Srgb,
    /// The power 1/2.2.
    Gamma,
    /// The square root.
    SquareRoot,
    /// The power 2.2: decoded where it should be encoded, or not at all.
    Darkened,
    /// x / (1 + x) of the light before it is clamped, without another curve.
    Reinhard,
    /// The inverse of the function of sRGB.
    Decoded,
    /// The power 1/2.2 twice.
    GammaTwice,
    /// The function of sRGB, then the power 1/2.2.
    SrgbThenGamma,
    /// The power 1/2.2, then the function of sRGB.
    GammaThenSrgb,
    /// The function of sRGB twice.
    SrgbTwice,
}

impl CodeCurve {
    pub(super) const ALL: [Self; 11] = [
        Self::Linear,
        Self::Srgb,
        Self::Gamma,
        Self::SquareRoot,
        Self::Darkened,
        Self::Reinhard,
        Self::Decoded,
        Self::GammaTwice,
        Self::SrgbThenGamma,
        Self::GammaThenSrgb,
        Self::SrgbTwice,
    ];

    /// The name in JSON.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "srgb",
            Self::Gamma => "gamma-2.2",
            Self::SquareRoot => "square-root",
            Self::Darkened => "power-2.2",
            Self::Reinhard => "reinhard",
            Self::Decoded => "srgb-inverse",
            Self::GammaTwice => "gamma-2.2-twice",
            Self::SrgbTwice => "srgb-twice",
            Self::SrgbThenGamma => "srgb-then-gamma-2.2",
            Self::GammaThenSrgb => "gamma-2.2-then-srgb",
        }
    }

    /// The two curves that it consists of, the first applied first.
    const fn both(self) -> Option<[Self; 2]> {
        match self {
            Self::GammaTwice => Some([Self::Gamma, Self::Gamma]),
            Self::SrgbTwice => Some([Self::Srgb, Self::Srgb]),
            Self::SrgbThenGamma => Some([Self::Srgb, Self::Gamma]),
            Self::GammaThenSrgb => Some([Self::Gamma, Self::Srgb]),
            _ => None,
        }
    }

    /// Whether light is encoded twice.
    pub(super) const fn is_double(self) -> bool {
        self.both().is_some()
    }

    fn exact(self, light: f64) -> f64 {
        if let Some([first, second]) = self.both() {
            return second.exact(first.exact(light));
        }
        match self {
            Self::Linear | Self::Reinhard => light,
            Self::Srgb => catoptric_picture::srgb::encode(light),
            Self::Gamma => light.powf(1.0 / 2.2),
            Self::SquareRoot => light.sqrt(),
            Self::Darkened => light.powf(2.2),
            Self::Decoded => catoptric_picture::srgb::decode(light),
            // Told above.
            Self::GammaTwice | Self::SrgbTwice | Self::SrgbThenGamma | Self::GammaThenSrgb => light,
        }
    }

    /// The light of a code, the inverse of the curve.
    pub(super) fn light(self, code: f32) -> f32 {
        if let Some([first, second]) = self.both() {
            return first.light(second.light(code));
        }
        let code = f64::from(code);
        let light = match self {
            Self::Linear => code,
            Self::Srgb => catoptric_picture::srgb::decode(code),
            Self::Gamma => code.powf(2.2),
            Self::SquareRoot => code * code,
            Self::Darkened => code.powf(1.0 / 2.2),
            Self::Reinhard => code / (1.0 - code).max(1e-3),
            Self::Decoded => catoptric_picture::srgb::encode(code),
            // Told above.
            Self::GammaTwice | Self::SrgbTwice | Self::SrgbThenGamma | Self::GammaThenSrgb => code,
        };
        light as f32
    }

    /// The code of light.
    fn code(self, light: f32) -> f32 {
        /// Steps of the table over the square root of the light, where most curves are smooth.
        const STEPS: usize = 1024;
        /// The first steps, in which double curves are too steep for the table.
        const STEEP: usize = 16;
        static TABLES: OnceLock<Vec<Vec<f32>>> = OnceLock::new();
        match self {
            Self::Linear => return light.clamp(0.0, 1.0),
            Self::Reinhard => return light.max(0.0) / (1.0 + light.max(0.0)),
            _ => {}
        }
        let tables = TABLES.get_or_init(|| {
            let root = |step: usize| step as f64 / STEPS as f64;
            let table = |curve: &Self| {
                (0..=STEPS + 1).map(|step| curve.exact(root(step) * root(step)) as f32).collect()
            };
            Self::ALL.iter().map(table).collect()
        });
        let at = light.clamp(0.0, 1.0).sqrt() * STEPS as f32;
        let step = at as usize;
        if step < STEEP && self.is_double() {
            return self.exact(f64::from(light.max(0.0))) as f32;
        }
        match tables.get(self as usize).and_then(|table| table.get(step..step + 2)) {
            Some([low, high]) => low + (high - low) * (at - step as f32),
            _ => 1.0,
        }
    }
}

/// The last step of a picture: from light to codes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodeStage {
    /// The curve.
    pub curve: CodeCurve,
    /// What light is multiplied with first.
    pub factor: f32,
    /// Whether light is clamped to 1 before it is multiplied.
    pub is_clamped_first: bool,
    /// Whether codes above 255 begin again at 0.
    pub overflows: bool,
    /// Whether red and blue are exchanged.
    pub is_blue_first: bool,
}

impl CodeStage {
    /// Light as it is, by a curve.
    pub(super) fn plain(curve: CodeCurve) -> Self {
        Self { curve, factor: 1.0, is_clamped_first: false, overflows: false, is_blue_first: false }
    }

    /// The codes of light, parts of the largest, within a fifth of a code of 255.
    pub(super) fn apply(&self, light: [f32; 3]) -> [f32; 3] {
        self.codes(light, |light| self.curve.code(light))
    }

    /// The codes of light by the formula of the curve.
    pub(super) fn exact(&self, light: [f32; 3]) -> [f32; 3] {
        self.codes(light, |light| match self.curve {
            CodeCurve::Linear | CodeCurve::Reinhard => self.curve.code(light),
            curve => curve.exact(f64::from(light.clamp(0.0, 1.0))) as f32,
        })
    }

    /// The light of codes: the inverse, but for what is clamped or overflows.
    pub(super) fn light(&self, codes: [f32; 3]) -> [f32; 3] {
        let [red, green, blue] = codes.map(|code| self.curve.light(code) / self.factor);
        if self.is_blue_first { [blue, green, red] } else { [red, green, blue] }
    }

    fn codes(&self, light: [f32; 3], code: impl Fn(f32) -> f32) -> [f32; 3] {
        let [red, green, blue] = light.map(|light| {
            let light = if self.is_clamped_first { light.min(1.0) } else { light };
            let light = light * self.factor;
            if self.overflows && light > 1.0 {
                // The code is cut to a byte; with a curve, the light above 1 has codes above 255, too.
                let code = self.curve.exact(f64::from(light)) * 255.0;
                return ((code.floor() % 256.0) / 255.0) as f32;
            }
            code(light)
        });
        if self.is_blue_first { [blue, green, red] } else { [red, green, blue] }
    }

    /// In how many ways it differs from what is expected.
    pub(super) fn deviations(&self, expected: CodeCurve) -> usize {
        usize::from(self.curve != expected)
            + usize::from(self.factor != 1.0)
            + usize::from(self.is_clamped_first)
            + usize::from(self.overflows)
            + usize::from(self.is_blue_first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_follow_the_formulas_within_a_fifth_of_a_code() {
        for curve in CodeCurve::ALL {
            for step in 0..=1000 {
                let light = step as f32 / 1000.0;
                let expected = match curve {
                    CodeCurve::Reinhard => f64::from(light / (1.0 + light)),
                    curve => curve.exact(f64::from(light)),
                };
                let found = curve.code(light);
                assert!((f64::from(found) - expected).abs() < 0.2 / 255.0, "{curve:?} {light}: {found}");
                if found < 0.99 {
                    assert!((curve.light(found) - light).abs() < 2e-3, "{curve:?} {light}");
                }
            }
        }
    }

    #[test]
    fn codes_overflow_and_channels_change_places() {
        let stage = CodeStage { overflows: true, ..CodeStage::plain(CodeCurve::Linear) };
        // 1.5 · 255 = 382.5, cut to 382 − 256.
        assert_eq!(stage.apply([1.5, 0.5, 1.0]), [126.0 / 255.0, 0.5, 1.0]);
        let stage = CodeStage { is_blue_first: true, factor: 2.0, ..CodeStage::plain(CodeCurve::Linear) };
        assert_eq!(stage.apply([0.1, 0.2, 0.8]), [1.0, 0.4, 0.2]);
    }
}
