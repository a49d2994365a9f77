//! The scale of a plot: from values to places on paper.

use crate::report::language::{Language, superscript};

/// A scale along a line.
#[derive(Clone, Debug)]
pub struct Scale {
    /// The values at the ends; their decimal logarithms when logarithmic.
    low: f64,
    high: f64,
    logarithmic: bool,
    /// The places of the ends.
    from: f64,
    to: f64,
}

/// A place with a line, and perhaps a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// The value there.
    pub value: f64,
    /// Whether its number is written.
    pub labeled: bool,
}

impl Scale {
    /// The scale that shows these values, from 0 if it is linear and they are above it.
    pub fn over(values: impl Iterator<Item = f64>, logarithmic: bool, from: f64, to: f64) -> Self {
        let usable = values.filter(|value| value.is_finite() && (!logarithmic || *value > 0.0));
        let (low, high) = usable
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low <= high { (low, high) } else { (1.0, 10.0) };
        let (low, high) = if logarithmic {
            let (low, high) = (low.log10(), high.log10());
            let margin = (0.04 * (high - low)).max(0.05);
            (low - margin, high + margin)
        } else {
            let low = low.min(0.0);
            let span = if high > low { high - low } else { 1.0 };
            (if low < 0.0 { low - 0.04 * span } else { 0.0 }, low + 1.05 * span)
        };
        Self { low, high, logarithmic, from, to }
    }

    /// The scale of places that have names: 0, 1, 2 …
    pub fn of_places(count: usize, from: f64, to: f64) -> Self {
        Self { low: -0.5, high: count.max(1) as f64 - 0.5, logarithmic: false, from, to }
    }

    /// Whether a value can be shown.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// The place of a value.
    pub fn at(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value };
        let part = ((value - self.low) / (self.high - self.low)).clamp(-0.05, 1.05);
        self.from + part * (self.to - self.from)
    }

    /// The lines of the grid.
    pub fn ticks(&self) -> Vec<Tick> {
        if !self.logarithmic {
            let step = self.step();
            let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
            return (first..=last.min(first + 50))
                .map(|k| Tick { value: k as f64 * step, labeled: true })
                .collect();
        }
        let decades = self.high - self.low;
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let last = last.min(first.saturating_add(80));
        let every = (decades / 8.0).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for decade in first..=last {
            for factor in 1..10_u8 {
                let value = f64::from(factor) * 10.0_f64.powi(decade);
                let labeled = match factor {
                    1 => decade.rem_euclid(every) == 0,
                    2 | 5 => decades < 2.2,
                    3 | 4 | 6 | 7 | 8 => decades < 0.5,
                    _ => false,
                };
                if (factor == 1 || decades < 4.0) && (self.low..=self.high).contains(&value.log10()) {
                    ticks.push(Tick { value, labeled });
                }
            }
        }
        ticks
    }

    /// A step of 1, 2 or 5 times a power of ten that makes four to ten of them.
    fn step(&self) -> f64 {
        let rough = (self.high - self.low) / 6.0;
        let power = 10.0_f64.powf(rough.log10().floor());
        let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= rough).unwrap_or(10.0);
        factor * power
    }

    /// The number at a tick.
    pub fn label(&self, value: f64, language: Language) -> String {
        if !self.logarithmic {
            let step = self.step();
            if self.high >= 1e6 {
                let power = self.high.log10().floor() as i32;
                let places = (power - step.log10().floor() as i32).clamp(0, 6) as usize;
                return match value == 0.0 {
                    true => "0".to_owned(),
                    false => format!(
                        "{}·10{}",
                        language.fixed(value / 10.0_f64.powi(power), places),
                        superscript(power)
                    ),
                };
            }
            let places = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
            return language.fixed(value, places);
        }
        let power = value.log10().floor();
        if (-3.0..5.0).contains(&power) {
            return language.fixed(value, (-power).max(0.0) as usize);
        }
        let factor = (value / 10.0_f64.powf(power)).round();
        let raised = superscript(power as i32);
        if factor == 1.0 { format!("10{raised}") } else { format!("{factor}·10{raised}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64], logarithmic: bool, language: Language) -> Vec<String> {
        let scale = Scale::over(values.iter().copied(), logarithmic, 0.0, 100.0);
        let ticks = scale.ticks().into_iter().filter(|tick| tick.labeled);
        ticks.map(|tick| scale.label(tick.value, language)).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(&[0.3, 1.0], false, Language::Russian), ["0,0", "0,2", "0,4", "0,6", "0,8", "1,0"]);
        assert_eq!(
            labels(&[10.0, 1e5], true, Language::English),
            ["10", "100", "1000", "10\u{a0}000", "10⁵"]
        );
        assert_eq!(labels(&[1.0, 30.0], true, Language::English), ["1", "2", "5", "10", "20"]);
        assert_eq!(labels(&[0.0, 2e6], false, Language::English)[1], "0.5·10⁶");
    }

    #[test]
    fn any_values_have_a_scale() {
        for values in [&[][..], &[0.0], &[f64::NAN, f64::INFINITY], &[1e-300, 1e300], &[-5.0, 5.0], &[7.0; 4]]
        {
            for logarithmic in [false, true] {
                let scale = Scale::over(values.iter().copied(), logarithmic, 10.0, 20.0);
                let ticks = scale.ticks();
                assert!(ticks.len() < 800, "{values:?}");
                for tick in ticks {
                    assert!((9.0..=21.0).contains(&scale.at(tick.value)), "{values:?}");
                    scale.label(tick.value, Language::English);
                }
            }
        }
    }
}
