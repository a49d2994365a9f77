//! The search for the mistakes that explain a picture.

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_tracer::RenderControl;
use rayon::prelude::*;

use super::codes::CodeStage;
use super::facts::SceneFacts;
use super::faults::Fault;
use super::focus::Focus;
use super::mistake::{Explanation, Mistake};
use super::observed::{ObservedPicture, Orientation};
use super::places::{Offset, PixelChoice, Window};
use super::ray_fault::RayFault;
use super::scene_mistake::SceneMistake;
use super::score::{Judge, Score, UprightPixels};
use super::trials::Trials;
use super::{DetectiveError, DetectiveSettings};

/// The mistakes that a scene can show but those of codes and of the place of pixels.
#[derive(Debug)]
pub(super) struct Hypotheses {
    faults: Vec<Fault>,
    rays: Vec<RayFault>,
    scene: Vec<SceneMistake>,
    /// The first numbers of those that have numbers.
    numbers: Vec<SceneMistake>,
    is_lit: bool,
}

impl Hypotheses {
    pub(super) fn of(trials: &Trials<'_>) -> Self {
        let facts = SceneFacts::of(trials.scene());
        let possible = |all: Vec<SceneMistake>| -> Vec<SceneMistake> {
            all.into_iter().filter(|mistake| mistake.is_possible(&facts)).collect()
        };
        Self {
            faults: Fault::possible(trials.scene(), &facts),
            rays: trials.facts().map(RayFault::possible).unwrap_or_default(),
            scene: possible(SceneMistake::all()),
            // Without the trial tracer, each number would prepare the scene anew.
            numbers: if trials.facts().is_some() {
                possible(SceneMistake::first_numbers())
            } else {
                Vec::new()
            },
            is_lit: facts.is_lit,
        }
    }
}

/// A search in one picture.
pub(super) struct Search<'a> {
    trials: &'a Trials<'a>,
    hypotheses: &'a Hypotheses,
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

/// An explanation that is to be tried: as it stands among the others, and the one that it comes from.
struct Move<'c> {
    explanation: Explanation,
    parent: &'c Candidate,
    /// Few pixels, and some more.
    foci: &'c [Focus; 2],
}

impl<'a> Search<'a> {
    /// Explanations that are kept of each round.
    const BEAM: usize = 5;
    /// Mistakes but those of the codes that are looked for together.
    const MOST_MISTAKES: usize = 3;
    /// The least part of the loss that a mistake must save to be named.
    const LEAST_PART: f64 = 0.2;
    /// The least part of the loss that a mistake with numbers of its own must save.
    const LEAST_PART_OF_NUMBERS: f64 = 0.7;
    /// The largest part of the loss without any mistake that an explanation may leave.
    const MOST_LEFT: f64 = 0.5;
    /// Explanations of a round that are tried on all chosen pixels, after all were tried on a few.
    const MOST_TRIED: usize = 9;
    /// Explanations of a round and of one that they come from that are tried on some more pixels.
    const MOST_SCREENED: usize = 40;
    /// Mistakes with numbers whose numbers are searched.
    const MOST_NUMBERS: usize = 3;
    /// The frequency of a mistake counts as little: it decides where two explain the same.
    const RANK: f64 = 1e-7;

    pub(super) fn new(
        (trials, hypotheses): (&'a Trials<'a>, &'a Hypotheses),
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
            hypotheses,
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
        let mut beam = vec![start.clone()];
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
            beam = different(found);
        }
        let best = self.pruned(best)?;
        let best = self.with_numbers(best, start)?;
        // What explains less is as likely to be wrong: an unknown mistake looks a little like some that are known.
        let right = Explanation::right(self.judge.curve);
        let loss = self.loss_of(&right)?;
        let is_explained = best.loss <= Self::MOST_LEFT * loss;
        Ok(if is_explained { best } else { Candidate { explanation: right, loss } })
    }

    fn total(&self, candidate: &Candidate) -> f64 {
        let Explanation { stage, .. } = &candidate.explanation;
        let count = candidate.explanation.deviations() + stage.deviations(self.judge.curve);
        candidate.loss + self.judge.price * count as f64 + Self::RANK * self.rank(&candidate.explanation)
    }

    /// How far its mistakes stand behind in the lists of the likelier ones.
    fn rank(&self, explanation: &Explanation) -> f64 {
        let Hypotheses { faults, rays, scene, .. } = self.hypotheses;
        let of = |place: Option<usize>| place.unwrap_or_default();
        let all = explanation
            .faults
            .iter()
            .map(|own| of(faults.iter().position(|fault| *fault == own)))
            .chain(explanation.rays.iter().map(|own| of(rays.iter().position(|fault| *fault == own))))
            .chain(explanation.scene.iter().map(|own| of(scene.iter().position(|other| *other == own))));
        all.sum::<usize>() as f64
    }

    /// The likeliest explanations with one mistake more than those of the beam.
    fn next(&self, beam: &[Candidate], round: usize) -> Result<Vec<Candidate>, DetectiveError> {
        let foci: Vec<[Focus; 2]> = beam.iter().map(|parent| self.foci(parent)).collect::<Result<_, _>>()?;
        let (mut screened, mut whole): (Vec<Move<'_>>, Vec<Move<'_>>) = (Vec::new(), Vec::new());
        for (parent, foci) in beam.iter().zip(&foci) {
            for explanation in self.moves(&parent.explanation, round) {
                let is_new = |own: &Move<'_>| !own.explanation.is_like(&explanation);
                if !screened.iter().chain(&whole).all(is_new) {
                    continue;
                }
                // What moves all pixels cannot be seen in those that differ, nor acne in a few.
                let is_whole = explanation.orientation != parent.explanation.orientation
                    || explanation.has_acne != parent.explanation.has_acne;
                let list = if is_whole { &mut whole } else { &mut screened };
                list.push(Move { explanation, parent, foci });
            }
        }
        let likely = self.likeliest(screened.iter().collect(), 0, Self::MOST_SCREENED * beam.len().min(2))?;
        let chosen = self.likeliest(likely, 1, Self::MOST_TRIED)?;
        let tried: Vec<&Move<'_>> = chosen.into_iter().chain(&whole).collect();
        tried
            .into_par_iter()
            .map(|own| {
                // What moves pixels makes another last step likely.
                let is_free = round == 0
                    || own.explanation.orientation != own.parent.explanation.orientation
                    || own.explanation.window != own.parent.explanation.window;
                let candidate = self.tried(own.explanation.clone(), (!is_free).then_some(own.parent))?;
                self.with_variants(candidate)
            })
            .collect()
    }

    /// The explanations that fit some pixels best.
    fn likeliest<'m>(
        &self,
        moves: Vec<&'m Move<'m>>,
        focus: usize,
        most: usize,
    ) -> Result<Vec<&'m Move<'m>>, DetectiveError> {
        let totals: Vec<f64> =
            moves.par_iter().map(|own| self.estimate(own, focus)).collect::<Result<_, _>>()?;
        let mut order: Vec<(f64, &Move<'_>)> = totals.into_iter().zip(moves).collect();
        order.sort_by(|one, other| one.0.total_cmp(&other.0));
        Ok(order.into_iter().take(most).map(|(_, own)| own).collect())
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
        let Hypotheses { faults, rays, scene, is_lit, .. } = self.hypotheses;
        all.extend(
            faults
                .iter()
                .filter_map(|fault| Some(Explanation { faults: from.faults.with(*fault)?, ..from.clone() })),
        );
        all.extend(
            rays.iter()
                .filter_map(|fault| Some(Explanation { rays: from.rays.with(*fault)?, ..from.clone() })),
        );
        all.extend(
            scene.iter().filter_map(|mistake| {
                Some(Explanation { scene: from.scene.with(*mistake)?, ..from.clone() })
            }),
        );
        if !from.has_acne && *is_lit {
            all.push(Explanation { has_acne: true, ..from.clone() });
        }
        all
    }

    /// The pixels by which explanations are screened that come from this one.
    fn foci(&self, from: &Candidate) -> Result<[Focus; 2], DetectiveError> {
        let Explanation { orientation, stage, .. } = &from.explanation;
        let (Some(pixels), Some(choice)) = (self.upright.get(orientation), self.choice(*orientation)) else {
            return Ok(<[Focus; 2]>::default());
        };
        let lights = self.trials.lights(choice, &from.explanation, false, self.control)?;
        Ok([Focus::ROUGH, Focus::FINE].map(|most| Focus::new(self.judge, pixels, &lights, stage, most)))
    }

    /// The total of an explanation by a few pixels.
    fn estimate(&self, own: &Move<'_>, focus: usize) -> Result<f64, DetectiveError> {
        let Some(focus) = own.foci.get(focus) else { return Ok(f64::INFINITY) };
        let score = self.score_at(focus, &own.explanation, &own.parent.explanation.stage)?;
        let explanation = Explanation { stage: score.stage, ..own.explanation.clone() };
        Ok(self.total(&Candidate { loss: score.loss, explanation }))
    }

    fn score_at(
        &self,
        focus: &Focus,
        explanation: &Explanation,
        near: &CodeStage,
    ) -> Result<Score, DetectiveError> {
        let Some(choice) = self.choice(explanation.orientation) else {
            return Ok(Score { loss: 1.0, stage: *near });
        };
        let lights = self.trials.lights_at(choice, &focus.places, explanation, self.control)?;
        let score = self.judge.fit(&focus.pixels, &lights, near, false);
        let plain = CodeStage::plain(self.judge.curve);
        if near.curve == plain.curve && near.is_blue_first == plain.is_blue_first {
            return Ok(score);
        }
        // A wrong picture may have led to a last step that no right one needs.
        let other = self.judge.fit(&focus.pixels, &lights, &plain, false);
        Ok(if other.loss < score.loss { other } else { score })
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

    /// The best among an explanation and those whose faults of rays have other numbers.
    fn with_variants(&self, mut best: Candidate) -> Result<Candidate, DetectiveError> {
        /// The most changes of a number.
        const MOST_CHANGES: usize = 6;
        if best.explanation.rays.iter().all(|fault| fault.variants().is_empty()) {
            return Ok(best);
        }
        for _ in 0..MOST_CHANGES {
            let [_, focus] = self.foci(&best)?;
            let stage = best.explanation.stage;
            let own = self.score_at(&focus, &best.explanation, &stage)?.loss;
            let mut least = (own, None);
            for fault in best.explanation.rays.iter() {
                for other in fault.variants() {
                    let rays = best.explanation.rays.without(fault).with(other);
                    let Some(rays) = rays else { continue };
                    let explanation = Explanation { rays, ..best.explanation.clone() };
                    let loss = self.score_at(&focus, &explanation, &stage)?.loss;
                    if loss < least.0 {
                        least = (loss, Some(explanation));
                    }
                }
            }
            let Some(explanation) = least.1 else { break };
            let other = self.tried(explanation, Some(&best))?;
            if other.loss >= best.loss {
                break;
            }
            best = other;
        }
        Ok(best)
    }

    /// The best explanation with mistakes whose numbers must be searched, where all others leave much unexplained.
    fn with_numbers(&self, best: Candidate, start: Candidate) -> Result<Candidate, DetectiveError> {
        /// The loss above which they are looked for, and its part of that without any mistake.
        const UNEXPLAINED: [f64; 2] = [0.004, 0.15];
        let [least, part] = UNEXPLAINED;
        if best.loss < least.max(part * start.loss) {
            return Ok(best);
        }
        let mut bases = vec![best.clone()];
        if best.explanation != start.explanation {
            bases.push(start);
        }
        let mut winner = best.clone();
        for base in &bases {
            let [few, focus] = self.foci(base)?;
            let explanations = self.first_numbers(&base.explanation);
            let stage = base.explanation.stage;
            let losses: Vec<f64> = explanations
                .par_iter()
                .map(|explanation| Ok(self.score_at(&few, explanation, &stage)?.loss))
                .collect::<Result<_, DetectiveError>>()?;
            let mut rough: Vec<(f64, Explanation)> = losses.into_iter().zip(explanations).collect();
            rough.sort_by(|one, other| one.0.total_cmp(&other.0));
            let mut kinds: Vec<&'static str> = Vec::new();
            rough.retain(|(_, explanation)| {
                let key = numbered_key(explanation);
                let is_new = !kinds.contains(&key);
                kinds.push(key);
                is_new
            });
            rough.truncate(Self::MOST_NUMBERS);
            let climbed: Vec<Candidate> = rough
                .into_par_iter()
                .map(|(_, explanation)| self.climbed(&focus, explanation, base))
                .collect::<Result<_, _>>()?;
            for other in climbed {
                let is_enough = other.loss < (1.0 - Self::LEAST_PART_OF_NUMBERS) * best.loss;
                if is_enough && self.total(&other) < self.total(&winner) {
                    winner = other;
                }
            }
        }
        Ok(winner)
    }

    fn first_numbers(&self, from: &Explanation) -> Vec<Explanation> {
        let numbers = self.hypotheses.numbers.iter();
        let mut all: Vec<Explanation> = numbers
            .filter_map(|mistake| Some(Explanation { scene: from.scene.with(*mistake)?, ..from.clone() }))
            .collect();
        if from.window == Window::Right {
            let size = from.orientation.upright_size(self.picture.size());
            let windows = Window::first_fitted(size).into_iter();
            all.extend(windows.map(|window| Explanation { window, ..from.clone() }));
        }
        all
    }

    /// The explanation whose numbers fit best, by steps that become smaller.
    fn climbed(
        &self,
        focus: &Focus,
        mut explanation: Explanation,
        base: &Candidate,
    ) -> Result<Candidate, DetectiveError> {
        /// The most steps of one length.
        const MOST_STEPS: usize = 5;
        let stage = base.explanation.stage;
        let mut loss = self.score_at(focus, &explanation, &stage)?.loss;
        for step in [32, 16, 8, 4, 16, 8, 4, 2, 1] {
            for _ in 0..MOST_STEPS {
                let mut least = (loss, None);
                for other in neighbors(&explanation, step) {
                    let own = self.score_at(focus, &other, &stage)?.loss;
                    if own < least.0 {
                        least = (own, Some(other));
                    }
                }
                let Some(better) = least.1 else { break };
                (loss, explanation) = (least.0, better);
            }
        }
        self.tried(explanation, Some(base))
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

/// The first of the candidates, of each set of names one.
fn different(found: Vec<Candidate>) -> Vec<Candidate> {
    let mut kept: Vec<(Vec<&'static str>, Candidate)> = Vec::new();
    for candidate in found {
        let mistakes = candidate.explanation.mistakes(candidate.explanation.stage.curve);
        let keys: Vec<&'static str> = mistakes.iter().map(Mistake::key).collect();
        if kept.len() < Search::BEAM && kept.iter().all(|(own, _)| *own != keys) {
            kept.push((keys, candidate));
        }
    }
    kept.into_iter().map(|(_, candidate)| candidate).collect()
}

/// The name of the mistake of an explanation that has numbers.
fn numbered_key(explanation: &Explanation) -> &'static str {
    let is_numbered = |mistake: &SceneMistake| !mistake.neighbors(1).is_empty();
    match explanation.scene.iter().find(is_numbered) {
        Some(mistake) => mistake.key(),
        None => Mistake::Window(explanation.window).key(),
    }
}

/// Explanations whose numbers are near those of this one.
fn neighbors(explanation: &Explanation, step: i16) -> Vec<Explanation> {
    let windows = explanation.window.neighbors(step).into_iter();
    let mut all: Vec<Explanation> =
        windows.map(|window| Explanation { window, ..explanation.clone() }).collect();
    for mistake in explanation.scene.iter() {
        let others = mistake.neighbors(step).into_iter();
        all.extend(others.filter_map(|other| {
            let scene = explanation.scene.without(mistake).with(other)?;
            Some(Explanation { scene, ..explanation.clone() })
        }));
    }
    all
}

/// The last steps with one deviation less.
fn simpler_stages(explanation: &Explanation, judge: Judge) -> Vec<CodeStage> {
    let own = explanation.stage;
    let all = [
        CodeStage { curve: judge.curve, ..own },
        CodeStage { factor: 1.0, is_clamped_first: false, ..own },
        CodeStage { is_clamped_first: false, ..own },
        CodeStage { overflows: false, ..own },
        CodeStage { is_blue_first: false, ..own },
    ];
    all.into_iter().filter(|stage| *stage != own).collect()
}
