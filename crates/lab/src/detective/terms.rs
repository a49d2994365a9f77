//! What makes up the light of a pixel, found by laws that leave a term out.

use glam::Vec3;

use super::DetectiveError;
use super::codes::CodeStage;
use super::faults::{Fault, FaultSet};
use super::light_law::LightLaw;
use super::light_tree::LightTrees;
use super::mistake::Explanation;
use super::remainder::DifferenceKind;
use super::score::Judge;
use super::trials::Trials;

/// The last of the terms that make up the light of a pixel, in the order in which a program learns them: background,
/// surface, shadow, highlight, reflection, refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PixelTerm {
    pub(super) kind: DifferenceKind,
    /// The generation of the last ray that adds to the pixel.
    pub(super) generation: u32,
    /// The light of the term.
    pub(super) light: Vec3,
    /// The light of all others.
    pub(super) rest: Vec3,
}

/// Trees of the rays of a pixel, and its place among them.
#[derive(Clone, Copy)]
pub(super) struct PixelTrees<'a> {
    pub(super) trees: &'a [LightTrees],
    pub(super) place: usize,
}

impl PixelTrees<'_> {
    fn mean(self, value: impl FnMut(&LightTrees) -> Vec3) -> Vec3 {
        self.trees.iter().map(value).sum::<Vec3>() / self.trees.len().max(1) as f32
    }

    /// The body that the eye sees.
    pub(super) fn body(self) -> Option<usize> {
        self.trees.first()?.body(self.place)
    }
}

/// The law of an explanation, and others that leave a term out.
pub(super) struct TermLaws<'a> {
    stage: CodeStage,
    own: LightLaw<'a>,
    /// The law without lamps: that of points in their own shadow.
    dark: LightLaw<'a>,
    has_acne: bool,
    /// The simplest term first.
    others: Vec<(DifferenceKind, LightLaw<'a>)>,
    /// The laws of 1, 2, 3 … generations.
    generations: Vec<LightLaw<'a>>,
    /// The limit of generations.
    last: u32,
}

impl<'a> TermLaws<'a> {
    /// The most generations that are told apart.
    const MOST_GENERATIONS: u8 = 16;
    /// Light that changes no code: half of one.
    const LEAST_LIGHT: f32 = 0.5 / 255.0;

    pub(super) fn new(trials: &'a Trials<'_>, explanation: &Explanation) -> Result<Self, DetectiveError> {
        let scene = trials.scene();
        let law = |faults: &FaultSet| LightLaw::new(scene, faults);
        let with = |fault| explanation.faults.with(fault).map(|faults| law(&faults));
        let others = [
            (DifferenceKind::Shadow, Fault::NoShadows),
            (DifferenceKind::Highlight, Fault::NoHighlight),
            (DifferenceKind::Reflection, Fault::NoReflection),
            (DifferenceKind::Refraction, Fault::NoRefraction),
        ];
        let last = explanation.faults.generations(scene.tracing.generations);
        let fewer = (1..=Self::MOST_GENERATIONS).take_while(|generations| u32::from(*generations) < last);
        Ok(Self {
            stage: explanation.stage,
            own: law(&explanation.faults),
            dark: law(&explanation.faults).darkened(),
            has_acne: explanation.has_acne,
            others: others.into_iter().filter_map(|(kind, fault)| Some((kind, with(fault)?))).collect(),
            generations: fewer.filter_map(|generations| with(Fault::Generations(generations))).collect(),
            last,
        })
    }

    /// The code of a pixel by a law: the mean of its rays.
    fn code(&self, pixel: PixelTrees<'_>, law: &LightLaw<'_>, sums: &mut Vec<Vec3>) -> [f32; 3] {
        pixel.mean(|own| Vec3::from(self.stage.exact(own.light(pixel.place, law, sums)))).to_array()
    }

    /// The code that the explanation gives a pixel.
    pub(super) fn expected(&self, pixel: PixelTrees<'_>, sums: &mut Vec<Vec3>) -> [f32; 3] {
        self.code(pixel, &self.own, sums)
    }

    /// Whether a pixel is right as a point in its own shadow, if there are such.
    pub(super) fn agrees_in_own_shadow(
        &self,
        pixel: PixelTrees<'_>,
        differs: impl Fn([f32; 3]) -> bool,
        sums: &mut Vec<Vec3>,
    ) -> bool {
        self.has_acne && !differs(self.code(pixel, &self.dark, sums))
    }

    /// What the difference of a pixel has to do with: the term without which it is explained best.
    pub(super) fn kind(
        &self,
        pixel: PixelTrees<'_>,
        (found, expected): ([f32; 3], [f32; 3]),
        sums: &mut Vec<Vec3>,
    ) -> DifferenceKind {
        let mut nearest = (plain_kind(pixel), 0.5 * Judge::distance(found, expected));
        let others = self.others.iter().map(|(kind, law)| (*kind, law));
        for (kind, law) in others.chain([(DifferenceKind::Shadow, &self.dark)]) {
            let distance = Judge::distance(found, self.code(pixel, law, sums));
            if distance < nearest.1 {
                nearest = (kind, distance);
            }
        }
        nearest.0
    }

    /// The last term of a pixel.
    pub(super) fn term(&self, pixel: PixelTrees<'_>, sums: &mut Vec<Vec3>) -> PixelTerm {
        let mut light = |law: &LightLaw<'_>| pixel.mean(|own| Vec3::from(own.light(pixel.place, law, sums)));
        let is_same = |one: Vec3, other: Vec3| (one - other).abs().max_element() < Self::LEAST_LIGHT;
        let all = light(&self.own);
        let others = self.others.iter().rev().map(|(kind, law)| (*kind, light(law)));
        let last = others.into_iter().find(|(_, rest)| !is_same(*rest, all));
        let (kind, rest) = match last {
            // Without shadows there is more light: what the lamps give with them is the term.
            Some((DifferenceKind::Shadow, _)) => (DifferenceKind::Shadow, light(&self.dark)),
            Some(other) => other,
            None => (plain_kind(pixel), Vec3::ZERO),
        };
        let generation = match kind {
            DifferenceKind::Reflection | DifferenceKind::Refraction => {
                let fewest = self.generations.iter().position(|law| is_same(light(law), all));
                fewest.map_or(self.last, |fewer| fewer as u32 + 1)
            }
            _ => 1,
        };
        PixelTerm { kind, generation, light: all - rest, rest }
    }
}

/// What a difference has to do with if no term explains it.
fn plain_kind(pixel: PixelTrees<'_>) -> DifferenceKind {
    if pixel.body().is_some() { DifferenceKind::Surface } else { DifferenceKind::Background }
}
