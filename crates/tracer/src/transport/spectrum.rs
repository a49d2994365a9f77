//! The colors that white light is split into.

use catoptric_optics::observer;

/// Light of some wavelengths that makes white together; other ones in every sample.
#[derive(Clone, Debug, Default)]
pub(crate) struct SampledWavelengths(Vec<observer::Wave>);

impl SampledWavelengths {
    /// So many that one sample of a prism shows its colors.
    pub(crate) const COUNT: usize = 8;

    /// Those of a sample.
    pub(crate) fn of_sample(sample: u32) -> Self {
        // Multiples of the golden ratio fill the steps between them evenly.
        const STEP: f64 = 0.618_033_988_749_894_8;
        Self(observer::waves(Self::COUNT, (0.5 + f64::from(sample) * STEP).fract()))
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Linear light; all together are white.
    pub(crate) fn color(&self, number: usize) -> [f32; 3] {
        self.0.get(number).map_or([0.0; 3], |wave| wave.color.map(|part| part as f32))
    }

    /// Nanometers in vacuum.
    pub(crate) fn nanometers(&self, number: u32) -> Option<f64> {
        self.0.get(number as usize).map(|wave| wave.nanometers)
    }
}
