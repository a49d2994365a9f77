//! The search for the mistakes that explain a picture.

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_tracer::RenderControl;
use rayon::prelude::*;

use super::facts::SceneFacts;
use super::faults::Fault;
use super::mistake::{Explanation, SceneMistake};
use super::observed::{ObservedPicture, Orientation};
use super::places::{Offset, PixelChoice, Window};
use super::score::{Judge, Score, UprightPixels};
use super::trials::Trials;
use super::{DetectiveError, DetectiveSettings};

/// A search in one picture.
pub(super) struct Search<'a> {
    trials: &'a Trials<'a>,
    faults: &'a [Fault],
    facts: SceneFacts,
    judge: Judge,
    picture: &'a ObservedPicture,
    expected_size: Option<[u32; 2]>,
    control: &'a RenderControl,
    choices: HashMap<[u32; 2], Arc<PixelChoice>>,
    upright: HashMap<Orientation, Arc<UprightPixels>>,
}

/// An explanation with its loss.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) explanation: Explanation,
    pub(super) loss: f64,
}

impl<'a> Search<'a> {
    /// Explanations that are kept of each round.
    const BEAM: usize = 5;
    /// Mistakes but those of the codes that are looked for together.
    const MOST_MISTAKES: usize = 3;
    /// The least part of the loss that a mistake must save to be named.
    const LEAST_PART: f64 = 0.1;

    pub(super) fn new(
        (trials, faults): (&'a Trials<'a>, &'a [Fault]),
        settings: &DetectiveSettings,
        picture: &'a ObservedPicture,
        control: &'a RenderControl,
    ) -> Self {
        let stored = picture.size();
        let fits = |orientation: &Orientation| orientation.fits(stored, settings.expected_size);
        let orientations = Orientation::OTHERS.into_iter().filter(fits);
        let (mut choices, mut upright) = (HashMap::new(), HashMap::new());
        for orientation in [Orientation::Upright].into_iter().chain(orientations) {
            let size = orientation.upright_size(stored);
            let choice = choices
                .entry(size)
                .or_insert_with(|| Arc::new(PixelChoice::new(size, settings.searched_pixels)));
            upright.insert(orientation, Arc::new(UprightPixels::new(picture, orientation, choice)));
        }
        Self {
            trials,
            faults,
            facts: SceneFacts::of(trials.scene()),
            judge: settings.judge(),
            picture,
            expected_size: settings.expected_size,
            control,
            choices,
            upright,
        }
    }

    /// The best explanation.
    pub(super) fn run(&self) -> Result<Candidate, DetectiveError> {
        let right = Explanation::right(self.judge.curve);
        let start = self.tried(right, None)?;
        let mut best = start.clone();
        let mut beam = vec![start];
        for round in 0..Self::MOST_MISTAKES {
            if best.loss < self.judge.price {
                break;
            }
            let mut found = self.next(&beam, round)?;
            found.sort_by(|one, other| self.total(one).total_cmp(&self.total(other)));
            let Some(first) = found.first() else { break };
            let has_improved = self.total(first) < self.total(&best);
            if has_improved {
                best = first.clone();
            }
            // What fits no better than before may still be half of two mistakes, but not of three.
            if !has_improved && round > 0 {
                break;
            }
            found.truncate(Self::BEAM);
            beam = found;
        }
        self.pruned(best)
    }

    fn total(&self, candidate: &Candidate) -> f64 {
        let Explanation { stage, .. } = &candidate.explanation;
        let count = candidate.explanation.deviations() + stage.deviations(self.judge.curve);
        candidate.loss + self.judge.price * count as f64
    }

    /// All explanations with one mistake more than those of the beam.
    fn next(&self, beam: &[Candidate], round: usize) -> Result<Vec<Candidate>, DetectiveError> {
        let mut moves: Vec<(Explanation, Option<&Candidate>)> = Vec::new();
        for candidate in beam {
            for explanation in self.moves(&candidate.explanation, round) {
                if !moves.iter().any(|(own, _)| own.is_like(&explanation)) {
                    // What moves pixels makes another last step likely.
                    let is_free = round == 0
                        || explanation.orientation != candidate.explanation.orientation
                        || explanation.window != candidate.explanation.window;
                    moves.push((explanation, (!is_free).then_some(candidate)));
                }
            }
        }
        moves.into_par_iter().map(|(explanation, parent)| self.tried(explanation, parent)).collect()
    }

    fn moves(&self, from: &Explanation, round: usize) -> Vec<Explanation> {
        let mut all = Vec::new();
        let size = from.orientation.upright_size(self.picture.size());
        if from.orientation == Orientation::Upright {
            let others = Orientation::OTHERS.into_iter().filter(|other| self.upright.contains_key(other));
            all.extend(others.map(|orientation| Explanation { orientation, ..from.clone() }));
        }
        if from.window == Window::Right {
            let others = Window::OTHERS.into_iter().filter(|window| self.trials.has_window(*window, size));
            all.extend(others.map(|window| Explanation { window, ..from.clone() }));
        }
        if from.offset == Offset::default() {
            // Each offset is traced anew: beside other mistakes, only the usual ones are tried.
            let count = if round == 0 { Offset::OTHERS.len() } else { Offset::USUAL };
            let others = Offset::OTHERS.into_iter().take(count);
            all.extend(others.map(|offset| Explanation { offset, ..from.clone() }));
        }
        all.extend(
            self.faults
                .iter()
                .filter_map(|fault| Some(Explanation { faults: from.faults.with(*fault)?, ..from.clone() })),
        );
        if from.scene.is_none() {
            let others = SceneMistake::ALL.into_iter().filter(|mistake| match mistake {
                SceneMistake::StraightRefraction | SceneMistake::InvertedRefraction => self.facts.transmits,
                SceneMistake::DoubledRadius | SceneMistake::HalvedRadius => self.facts.is_round,
                SceneMistake::NoPattern => self.facts.has_patterns,
                SceneMistake::CylindersUp | SceneMistake::CylindersDown => self.facts.has_cylinders,
                SceneMistake::TurnedCones => self.facts.has_cones,
            });
            all.extend(others.map(|scene| Explanation { scene: Some(scene), ..from.clone() }));
        }
        if !from.has_acne && self.facts.is_lit {
            all.push(Explanation { has_acne: true, ..from.clone() });
        }
        all
    }

    /// The explanation with the last step that fits best: near that of its parent, if there is one.
    fn tried(
        &self,
        mut explanation: Explanation,
        parent: Option<&Candidate>,
    ) -> Result<Candidate, DetectiveError> {
        let (Some(pixels), Some(choice)) =
            (self.upright.get(&explanation.orientation), self.choice(explanation.orientation))
        else {
            return Ok(Candidate { explanation, loss: 1.0 });
        };
        let lights = self.trials.lights(choice, &explanation, false, self.control)?;
        let near = parent.map_or(explanation.stage, |parent| parent.explanation.stage);
        let Score { mut loss, stage } = self.judge.fit(pixels, &lights, &near, parent.is_none());
        explanation.stage = stage;
        if explanation.has_acne {
            let dark = self.trials.lights(choice, &explanation, true, self.control)?;
            loss = self.judge.loss_with_acne((pixels, choice), (&lights, &dark), &stage).unwrap_or(1.0);
        }
        Ok(Candidate { explanation, loss })
    }

    /// The choice of pixels of the upright picture.
    fn choice(&self, orientation: Orientation) -> Option<&PixelChoice> {
        self.choices.get(&orientation.upright_size(self.picture.size())).map(|choice| &**choice)
    }

    /// The explanation without what explains too little.
    fn pruned(&self, mut best: Candidate) -> Result<Candidate, DetectiveError> {
        while let Some(simpler) = self.simplest(&best)? {
            best = simpler;
        }
        Ok(best)
    }

    /// An explanation with one mistake less that is nearly as good.
    fn simplest(&self, best: &Candidate) -> Result<Option<Candidate>, DetectiveError> {
        let mut others = Vec::new();
        for explanation in best.explanation.simpler() {
            others.push(self.tried(explanation, Some(best))?);
            // The last step may have made up for the mistake.
            others.extend(others.last().cloned().map(|own| self.restaged(own)).transpose()?);
        }
        for stage in simpler_stages(&best.explanation, self.judge) {
            let explanation = Explanation { stage, ..best.explanation.clone() };
            let loss = self.loss_of(&explanation)?;
            others.push(Candidate { explanation, loss });
        }
        let is_enough =
            |other: &Candidate| other.loss - best.loss < self.judge.price.max(Self::LEAST_PART * other.loss);
        let enough = others.into_iter().filter(is_enough);
        Ok(enough.min_by(|one, other| self.total(one).total_cmp(&self.total(other))))
    }

    fn restaged(&self, candidate: Candidate) -> Result<Candidate, DetectiveError> {
        self.tried(candidate.explanation, None)
    }

    fn loss_of(&self, explanation: &Explanation) -> Result<f64, DetectiveError> {
        let (Some(pixels), Some(choice)) =
            (self.upright.get(&explanation.orientation), self.choice(explanation.orientation))
        else {
            return Ok(1.0);
        };
        let lights = self.trials.lights(choice, explanation, false, self.control)?;
        if !explanation.has_acne {
            return Ok(self.judge.loss(pixels, &lights, &explanation.stage));
        }
        let dark = self.trials.lights(choice, explanation, true, self.control)?;
        let loss = self.judge.loss_with_acne((pixels, choice), (&lights, &dark), &explanation.stage);
        Ok(loss.unwrap_or(1.0))
    }

    /// The size that is expected, if the picture has another one.
    pub(super) fn other_size(&self, orientation: Orientation) -> Option<[u32; 2]> {
        let own = orientation.upright_size(self.picture.size());
        self.expected_size.filter(|expected| *expected != own)
    }
}

/// The last steps with one deviation less.
fn simpler_stages(explanation: &Explanation, judge: Judge) -> Vec<super::codes::CodeStage> {
    let own = explanation.stage;
    let all = [
        super::codes::CodeStage { curve: judge.curve, ..own },
        super::codes::CodeStage { factor: 1.0, is_clamped_first: false, ..own },
        super::codes::CodeStage { is_clamped_first: false, ..own },
        super::codes::CodeStage { overflows: false, ..own },
        super::codes::CodeStage { is_blue_first: false, ..own },
    ];
    all.into_iter().filter(|stage| *stage != own).collect()
}
