//! Synthetic mistakes, alone and in pairs, and the sentence that names them.

mod kinds;
pub(crate) mod scenes;

use catoptric_lab::Random;
use catoptric_lab::detective::{
    CodeCurve, Detective, DetectiveError, DetectiveSettings, ObservedPicture, Verdict,
};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, srgb};
use catoptric_scene::{FresnelTerm, Material, MaterialChoice, Scene};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use rayon::prelude::*;

use crate::independent_tracer::{IndependentTracer, Slip};

const SIZE: [u32; 2] = [96, 54];

/// The mistakes by name, and all of them.
macro_rules! mistakes {
    ($($name:ident),+ $(,)?) => {
        /// A mistake that the independent tracer or the writer of its picture makes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Made {
            $($name),+
        }

        impl Made {
            const ALL: &[Self] = &[$(Self::$name),+];
        }
    };
}

mistakes! {
    NoShadows,
    NoSpecular,
    NoReflection,
    NoRefraction,
    NoAmbient,
    Depth1,
    Depth2,
    Clamped,
    Normals,
    Acne,
    HalfPixel,
    LeftHanded,
    AngleForWidth,
    AngleForHeight,
    InvertedIor,
    Diameter,
    Halfway,
    FlippedDown,
    UpsideDown,
    Transposed,
    Gamma,
    Gamma22,
    Darker,
    Brighter,
    BlueFirst,
    Overflow,
    Size,
    Resampled,
}

use Made::*;

impl Made {
    /// The names that are right for it.
    fn keys(self) -> &'static [&'static str] {
        match self {
            NoShadows => &["no-shadows"],
            NoSpecular => &["no-specular"],
            NoReflection => &["no-reflection"],
            NoRefraction => &["no-refraction"],
            NoAmbient => &["no-ambient"],
            Depth1 => &["depth-too-small"],
            Depth2 => &["depth-too-small"],
            Clamped => &["clamped-early"],
            Normals => &["normals-of-scaled-bodies"],
            Acne => &["acne"],
            HalfPixel | Resampled => &["half-pixel"],
            LeftHanded => &["flipped-left-to-right"],
            AngleForWidth => &["field-of-view-taken-as-horizontal"],
            AngleForHeight => &["field-of-view-taken-as-vertical"],
            InvertedIor => &["refraction-indices-exchanged"],
            Diameter => &["diameter-taken-as-radius"],
            Halfway => &["specular-by-halfway-vector"],
            FlippedDown => &["flipped-top-to-bottom"],
            UpsideDown => &["turned-upside-down"],
            Transposed => &["transposed"],
            Gamma | Gamma22 => &["gamma-instead-of-linear"],
            Darker | Brighter => &["exposure"],
            BlueFirst => &["red-and-blue-exchanged"],
            Overflow => &["codes-overflow"],
            Size => &["size"],
        }
    }

    /// Whether a scene shows it.
    fn shows(self, scene: usize) -> bool {
        match self {
            NoRefraction | InvertedIor => scene == 1,
            Normals => scene > 0,
            Clamped | Overflow => scene == 2,
            Depth2 => scene < 2,
            // Without clear bodies, that is a mirror less.
            Depth1 => scene == 1,
            _ => true,
        }
    }

    /// Mistakes of one topic exclude each other; so do those that hide one another.
    fn topic(self) -> u8 {
        match self {
            NoShadows | Acne => 0,
            NoSpecular | Halfway => 1,
            NoReflection | NoRefraction | Depth1 | Depth2 | InvertedIor => 2,
            NoAmbient => 4,
            Clamped | Darker | Brighter | Overflow => 5,
            Normals => 6,
            HalfPixel | Resampled => 7,
            LeftHanded | FlippedDown | UpsideDown | Transposed => 8,
            AngleForWidth | AngleForHeight | Size => 9,
            Diameter => 10,
            Gamma | Gamma22 => 11,
            BlueFirst => 12,
        }
    }

    /// The mistake of the independent tracer, if it is not one of the codes.
    fn slip(self) -> Option<Slip> {
        Some(match self {
            NoShadows => Slip::NoShadows,
            NoSpecular => Slip::NoSpecular,
            NoReflection => Slip::NoReflection,
            NoRefraction => Slip::NoRefraction,
            NoAmbient => Slip::NoAmbient,
            Depth1 => Slip::Depth1,
            Depth2 => Slip::Depth2,
            Clamped => Slip::ClampedRays,
            Normals => Slip::MatrixNormals,
            Acne => Slip::Acne,
            HalfPixel => Slip::Corners,
            LeftHanded => Slip::LeftHanded,
            AngleForWidth => Slip::AngleForWidth,
            AngleForHeight => Slip::AngleForHeight,
            InvertedIor => Slip::RatioTurned,
            Diameter => Slip::DoubledRadius,
            Halfway => Slip::Halfway,
            _ => return None,
        })
    }
}

/// A picture of codes as it is written.
#[derive(Clone)]
struct Coded {
    size: [u32; 2],
    codes: Vec<[u8; 3]>,
}

impl Coded {
    fn of_light(size: [u32; 2], light: &[[f32; 3]], made: &[Made]) -> Self {
        let mut factor = 1.0;
        if made.contains(&Darker) {
            factor = 0.6;
        }
        if made.contains(&Brighter) {
            factor = 1.4;
        }
        let code = |light: f32| {
            let light = f64::from(light) * factor;
            if made.contains(&Overflow) {
                return ((light * 255.0) as u32 % 256) as u8;
            }
            let light = light.clamp(0.0, 1.0);
            let value = if made.contains(&Gamma) {
                srgb::encode(light)
            } else if made.contains(&Gamma22) {
                light.powf(1.0 / 2.2)
            } else {
                light
            };
            // As programs do that know nothing of rounding.
            (value * 255.0) as u8
        };
        let mut codes: Vec<[u8; 3]> = light.iter().map(|light| light.map(code)).collect();
        if made.contains(&BlueFirst) {
            codes.iter_mut().for_each(|code| code.reverse());
        }
        let mut coded = Self { size, codes };
        if made.contains(&Resampled) {
            coded = coded.map(size, |own, x, y| {
                let [right, below] = [(x + 1).min(size[0] - 1), (y + 1).min(size[1] - 1)];
                let four = [own.at(x, y), own.at(right, y), own.at(x, below), own.at(right, below)];
                [0, 1, 2].map(|c| (four.iter().map(|code| u32::from(code[c])).sum::<u32>() / 4) as u8)
            });
        }
        let [width, height] = size;
        if made.contains(&FlippedDown) {
            coded = coded.map(size, |own, x, y| own.at(x, height - 1 - y));
        }
        if made.contains(&UpsideDown) {
            coded = coded.map(size, |own, x, y| own.at(width - 1 - x, height - 1 - y));
        }
        if made.contains(&Transposed) {
            coded = coded.map([height, width], |own, x, y| own.at(y, x));
        }
        coded
    }

    fn at(&self, x: u32, y: u32) -> [u8; 3] {
        self.codes[(y * self.size[0] + x) as usize]
    }

    fn map(&self, size: [u32; 2], code: impl Fn(&Self, u32, u32) -> [u8; 3]) -> Self {
        let all = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        Self { size, codes: all.map(|(x, y)| code(self, x, y)).collect() }
    }

    /// Each code one more or less, or as it is.
    fn with_noise(&self, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut noisy = |code: u8| code.saturating_add_signed(random.below(3) as i8 - 1);
        let codes = self.codes.iter().map(|code| code.map(&mut noisy)).collect();
        Self { size: self.size, codes }
    }

    fn observed(&self) -> ObservedPicture {
        let light = |code: u8| srgb::decode(f64::from(code) / 255.0) as f32;
        let pixels = self.codes.iter().map(|code| code.map(light)).collect();
        ObservedPicture::of_codes(&Picture::from_pixels(self.size[0], self.size[1], pixels).unwrap())
    }
}

/// The picture with these mistakes by the independent tracer.
fn made_by_independent(scene: &Scene, made: &[Made]) -> Coded {
    let slips: Vec<Slip> = made.iter().filter_map(|made| made.slip()).collect();
    let size = if made.contains(&Size) { [80, 45] } else { SIZE };
    let light = IndependentTracer::new(scene, &slips).light(size);
    let light: Vec<[f32; 3]> = light.iter().map(|light| light.as_vec3().to_array()).collect();
    Coded::of_light(size, &light, made)
}

/// The picture with these mistakes by the exact tracer, of a scene that is changed.
fn made_by_exact(scene: &Scene, made: &[Made]) -> Option<Coded> {
    let mut scene = scene.clone();
    for own in made {
        match own {
            NoSpecular => each_phong(&mut scene, |phong| phong.specular = 0.0),
            NoReflection => each_phong(&mut scene, |phong| phong.reflection = Some(0.0)),
            NoAmbient => scene.environment.ambient = catoptric_scene::Color::BLACK,
            Depth1 => scene.tracing.generations = 1,
            Depth2 => scene.tracing.generations = 2,
            InvertedIor => each_phong(&mut scene, |phong| phong.ior = phong.ior.recip()),
            FlippedDown | UpsideDown | Transposed | Gamma | Gamma22 | Darker | Brighter | BlueFirst
            | Overflow | Size | Resampled => {}
            _ => return None,
        }
    }
    let [width, height] = if made.contains(&Size) { [80, 45] } else { SIZE };
    let prepared = RenderScene::build(&scene).unwrap();
    let settings = RenderSettings { width, height, samples: 1 };
    let picture = render(&prepared, settings, &RenderControl::default()).unwrap().picture;
    Some(Coded::of_light([width, height], picture.pixels(), made))
}

fn each_phong(scene: &mut Scene, change: impl Fn(&mut catoptric_scene::Phong)) {
    for body in &mut scene.bodies {
        let MaterialChoice::Inline(material) = &mut body.material else { panic!("materials are inline") };
        let Material::Phong(phong) = &mut **material else { panic!("Phong only") };
        phong.reflection = Some(phong.reflection());
        change(phong);
    }
}

pub(crate) fn settings() -> DetectiveSettings {
    DetectiveSettings {
        curve: CodeCurve::Linear,
        expected_size: Some(SIZE),
        searched_pixels: 1000,
        judged_pixels: 1600,
        ..DetectiveSettings::default()
    }
}

/// Whether the verdict names each of the mistakes, and no other.
fn is_right(verdict: &Verdict, made: &[Made]) -> bool {
    let found: Vec<&str> = verdict.mistakes.iter().map(catoptric_lab::detective::Mistake::key).collect();
    let is_named = |made: &Made| made.keys().iter().any(|key| found.contains(key));
    let is_meant = |key: &&str| made.iter().any(|made| made.keys().contains(key));
    made.iter().all(is_named) && found.iter().all(is_meant)
}

struct Case {
    scene: usize,
    made: Vec<Made>,
    is_exact: bool,
}

/// Every mistake alone in each scene that shows it, by both tracers; pairs, spread evenly.
fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for scene in 0..3 {
        for made in Made::ALL.iter().copied().filter(|made| made.shows(scene)) {
            for is_exact in [false, true] {
                all.push(Case { scene, made: vec![made], is_exact });
            }
        }
    }
    let mut pairs = Vec::new();
    for scene in 0..3 {
        let shown: Vec<Made> = Made::ALL.iter().copied().filter(|made| made.shows(scene)).collect();
        for (index, one) in shown.iter().enumerate() {
            for other in shown.iter().skip(index + 1).filter(|other| other.topic() != one.topic()) {
                pairs.push(Case { scene, made: vec![*one, *other], is_exact: pairs.len() % 2 == 0 });
            }
        }
    }
    // Each eleventh: every mistake is in some of them.
    all.extend(pairs.into_iter().step_by(11));
    all
}

#[test]
fn synthetic_mistakes_are_named() {
    let scenes = scenes::scenes().into_iter().take(3).collect::<Vec<_>>();
    let detectives: Vec<Detective<'_>> =
        scenes.iter().map(|scene| Detective::new(scene, settings()).unwrap()).collect();
    let outcome = |case: &Case| {
        let scene = &scenes[case.scene];
        let picture = if case.is_exact {
            made_by_exact(scene, &case.made)?
        } else {
            made_by_independent(scene, &case.made)
        };
        let verdict = detectives[case.scene].check(&picture.observed(), &RenderControl::default()).unwrap();
        let is_named = is_right(&verdict, &case.made);
        if !is_named {
            println!(
                "{} {:?} {}: {}",
                case.scene,
                case.made,
                if case.is_exact { "exact" } else { "independent" },
                verdict.sentence(scene, Language::English)
            );
        }
        Some((case.made.len(), is_named))
    };
    let outcomes: Vec<(usize, bool)> = cases().par_iter().filter_map(outcome).collect();
    let rate = |count: usize| {
        let own: Vec<bool> = outcomes.iter().filter(|(made, _)| *made == count).map(|(_, is)| *is).collect();
        let right = own.iter().filter(|is| **is).count();
        println!("{count} at once: {right} of {}", own.len());
        (own.len(), right as f64 / own.len() as f64)
    };
    let ((singles, single), (pairs, double)) = (rate(1), rate(2));
    assert!(singles >= 90 && pairs >= 40, "{singles} {pairs}");
    assert!(single >= 0.95, "{single}");
    assert!(double >= 0.8, "{double}");
}

#[test]
fn right_pictures_raise_no_alarm() {
    for (index, scene) in scenes::scenes().iter().enumerate() {
        let detective = Detective::new(scene, settings()).unwrap();
        for picture in [made_by_independent(scene, &[]), made_by_exact(scene, &[]).unwrap()] {
            for seed in 0..4 {
                let noisy = picture.with_noise(seed);
                let verdict = detective.check(&noisy.observed(), &RenderControl::default()).unwrap();
                assert!(verdict.is_right(0.001), "{index}: {}", verdict.sentence(scene, Language::English));
            }
        }
    }
}

/// A scene that weighs clear bodies by the angle, and a picture that does not.
#[test]
fn missing_weights_of_clear_bodies_are_named() {
    let constant = &scenes::scenes()[1];
    let mut weighed = constant.clone();
    each_phong(&mut weighed, |phong| phong.fresnel = FresnelTerm::Schlick);
    assert_ne!(&weighed, constant);
    let detective = Detective::new(&weighed, settings()).unwrap();
    let right = made_by_exact(&weighed, &[]).unwrap();
    let verdict = detective.check(&right.observed(), &RenderControl::default()).unwrap();
    assert!(verdict.is_right(0.001), "{}", verdict.sentence(&weighed, Language::English));
    let picture = made_by_exact(constant, &[]).unwrap();
    let verdict = detective.check(&picture.observed(), &RenderControl::default()).unwrap();
    assert_eq!(verdict.to_json(&weighed, 0.01)["mistakes"][0]["key"], "clear-bodies-not-weighed");
    assert!(verdict.sentence(&weighed, Language::English).contains("Schlick"));
}

#[test]
fn a_verdict_is_told_in_both_languages_and_in_json() {
    let scene = &scenes::scenes()[1];
    let detective = Detective::new(scene, settings()).unwrap();
    let picture = made_by_independent(scene, &[LeftHanded, NoShadows]);
    let verdict = detective.check(&picture.observed(), &RenderControl::default()).unwrap();
    let english = verdict.sentence(scene, Language::English);
    assert!(english.starts_with("flipped left to right") && english.contains("no shadows"), "{english}");
    assert!(verdict.sentence(scene, Language::Russian).contains("нет теней"));
    let json = verdict.to_json(scene, 0.01);
    assert_eq!(json["mistakes"][0]["key"], "flipped-left-to-right");
    assert_eq!(json["mistakes"][1]["key"], "no-shadows");
    assert_eq!(json["right"], false);
    assert!(json["share_explained"].as_f64().unwrap() > 0.99, "{json}");
}

#[test]
fn what_cannot_be_checked_is_refused() {
    let scene = &scenes::scenes()[0];
    let detective = Detective::new(scene, settings()).unwrap();
    let control = RenderControl::default();
    control.cancel();
    let observed = made_by_exact(scene, &[]).unwrap().observed();
    assert!(matches!(detective.check(&observed, &control), Err(DetectiveError::Cancelled)));
}
