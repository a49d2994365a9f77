//! Where to look first: the simplest pixel that differs.

use std::collections::BTreeMap;

use catoptric_scene::Scene;
use glam::Vec3;
use serde_json::{Value, json};

use super::codes::CodeStage;
use super::remainder::{DifferenceKind, WorstPixel};
use super::tally::{DifferingPixel, Tally};
use super::verdict::body_in_words;
use crate::report::Language;

/// The simplest pixel that differs: of the fewest generations, then of the fewest terms. All that is simpler agrees, so
/// its last term is likely to be wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplestDifference {
    /// The pixel with its codes.
    pub pixel: WorstPixel,
    /// The last term that makes up its light.
    pub term: DifferenceKind,
    /// The generation of the last ray that adds to it, 1 for the primary one.
    pub generation: u32,
    /// The light of that term, linear.
    pub expected_light: [f32; 3],
    /// The light of that term in the picture, if all other terms are right; at least so much where the code is the largest.
    pub found_light: [f32; 3],
}

impl SimplestDifference {
    /// The simplest of pixels that differ. Pixels at edges count if they are too many for rounding; of equally simple
    /// pixels that which differs most is taken.
    pub(super) fn of(tally: &Tally, stage: &CodeStage) -> Option<Self> {
        let mut groups: BTreeMap<_, Vec<&DifferingPixel>> = BTreeMap::new();
        for other in &tally.others {
            groups.entry((other.term.generation, other.term.kind.rank())).or_default().push(other);
        }
        let is_certain = |group: &&Vec<&DifferingPixel>| {
            group.iter().any(|other| other.is_beyond) || tally.share(group.iter().copied()) > Tally::FLIPPED
        };
        let group = groups.values().find(is_certain).or(groups.values().next())?;
        let simplest = group.iter().max_by(|one, other| {
            let by_place = one.is_beyond.cmp(&other.is_beyond);
            by_place.then(one.pixel.difference.total_cmp(&other.pixel.difference))
        })?;
        let found = Vec3::from(stage.light(simplest.found)) - simplest.term.rest;
        Some(Self {
            pixel: simplest.pixel,
            term: simplest.term.kind,
            generation: simplest.term.generation,
            expected_light: simplest.term.light.to_array(),
            found_light: found.max(Vec3::ZERO).to_array(),
        })
    }

    /// Where to look, and both numbers.
    pub fn in_words(&self, scene: &Scene, language: Language) -> String {
        let [x, y] = self.pixel.stored;
        let codes = |codes: [u8; 3]| codes.map(|code| code.to_string()).join(",");
        let [found, expected] = [self.pixel.found, self.pixel.expected].map(codes);
        let light = |light: [f32; 3]| light.map(|light| language.fixed(f64::from(light), 3)).join(" ");
        let [found_light, expected_light] = [self.found_light, self.expected_light].map(light);
        let body = self.pixel.body.map(|body| format!("{}, ", body_in_words(body, scene, language)));
        let body = body.unwrap_or_default();
        let generation = self.generation;
        let term = match self.term {
            DifferenceKind::Background => language.choose("background", "фон"),
            DifferenceKind::Surface => language.choose("surface without shadow", "поверхность без тени"),
            DifferenceKind::Shadow => language.choose("lamps and shadows", "лампы и тени"),
            DifferenceKind::Highlight => language.choose("highlight", "блик"),
            DifferenceKind::Reflection => language.choose("reflection", "отражение"),
            DifferenceKind::Refraction => language.choose("what is seen through it", "видимое насквозь"),
        };
        match language {
            Language::English => format!(
                "look first at pixel {x},{y} ({body}generation {generation}, {term}): {found} instead of {expected}; \
                 light of that term {found_light} instead of {expected_light}"
            ),
            Language::Russian => format!(
                "начните с пикселя {x},{y} ({body}поколение {generation}, {term}): {found} вместо {expected}; свет \
                 этого слагаемого {found_light} вместо {expected_light}"
            ),
        }
    }

    /// The numbers as JSON, with names that stay.
    pub(super) fn to_json(self, scene: &Scene) -> Value {
        json!({
            "words": self.in_words(scene, Language::English),
            "pixel": self.pixel.stored,
            "pixel_of_scene": self.pixel.pixel,
            "body": self.pixel.body.map(|body| body_in_words(body, scene, Language::English)),
            "generation": self.generation,
            "term": self.term.key(),
            "found": self.pixel.found,
            "expected": self.pixel.expected,
            "light_found": self.found_light,
            "light_expected": self.expected_light,
        })
    }
}
