//! What miniRT programs do differently.

use std::fmt;
use std::str::FromStr;

use crate::phrase::ConeNumbers;

/// What a miniRT program does otherwise than the school's subject says, or where that is silent, than most programs
/// do. Default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dialect {
    /// `radius`: spheres, cylinders and cones are given by their radius, not by their diameter.
    pub has_radius: bool,
    /// `base`: the position of a cylinder is the center of its base, not of the cylinder.
    pub is_cylinder_at_base: bool,
    /// `cone-base`: the position of a cone is the center of its base, and its axis points to the apex.
    pub is_cone_at_base: bool,
    /// `cone-angle`: half the angle at the apex stands in the place of a cone's diameter, degrees.
    pub has_angle_of_cone: bool,
    /// `cone-height-first`: the height of a cone stands before its diameter or angle.
    pub has_height_of_cone_first: bool,
    /// `vertical-fov`: the angle of view is the vertical one.
    pub has_vertical_fov: bool,
    /// `left-handed`: with y up and z into the picture, x points to the right.
    pub is_left_handed: bool,
    /// `added-reflection`: what a mirror reflects is added to its own light, which stays undiminished.
    pub has_added_reflection: bool,
}

/// There is no such word of a dialect.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no dialect \"{word}\"; give one or several of: {}", Dialect::WORDS.join(", "))]
pub struct UnknownDialect {
    /// The word.
    pub word: String,
}

impl Dialect {
    /// The words, in the order of the fields.
    pub const WORDS: [&'static str; 8] = [
        "radius",
        "base",
        "cone-base",
        "cone-angle",
        "cone-height-first",
        "vertical-fov",
        "left-handed",
        "added-reflection",
    ];

    /// The radius that a number stands for which is a diameter, or is said to be a radius.
    pub(crate) fn radius(self, number: f64) -> f64 {
        if self.has_radius { number } else { 0.5 * number }
    }

    /// What the two numbers of a cone are.
    pub(crate) fn cone_numbers(self) -> ConeNumbers {
        ConeNumbers { has_angle: self.has_angle_of_cone, is_height_first: self.has_height_of_cone_first }
    }

    fn flags(&mut self) -> [&mut bool; 8] {
        [
            &mut self.has_radius,
            &mut self.is_cylinder_at_base,
            &mut self.is_cone_at_base,
            &mut self.has_angle_of_cone,
            &mut self.has_height_of_cone_first,
            &mut self.has_vertical_fov,
            &mut self.is_left_handed,
            &mut self.has_added_reflection,
        ]
    }
}

/// Words with commas between them.
///
/// ```
/// use catoptric_exchange::Dialect;
/// let dialect: Dialect = "radius,left-handed".parse().unwrap();
/// assert!(dialect.has_radius && dialect.is_left_handed && !dialect.has_vertical_fov);
/// assert!("diameter".parse::<Dialect>().is_err());
/// ```
impl FromStr for Dialect {
    type Err = UnknownDialect;

    fn from_str(text: &str) -> Result<Self, UnknownDialect> {
        let mut dialect = Self::default();
        for word in text.split(',').map(str::trim).filter(|word| !word.is_empty()) {
            let known = Self::WORDS.iter().position(|known| *known == word);
            match known.and_then(|index| dialect.flags().into_iter().nth(index)) {
                Some(flag) => *flag = true,
                None => return Err(UnknownDialect { word: word.to_owned() }),
            }
        }
        Ok(dialect)
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut own = *self;
        let words = Self::WORDS.into_iter().zip(own.flags()).filter(|(_, flag)| **flag);
        out.write_str(&words.map(|(word, _)| word).collect::<Vec<_>>().join(","))
    }
}
