//! Synthetic mistakes, alone and in pairs, and the sentence that names them.

mod kinds;
pub(crate) mod scenes;

use catoptric_lab::Random;
use catoptric_lab::detective::{
    CodeCurve, Detective, DetectiveError, DetectiveSettings, Mistake, ObservedPicture,
};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, srgb};
use catoptric_scene::{FresnelTerm, Material, MaterialChoice, Scene};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use rayon::prelude::*;

use crate::independent_tracer::{IndependentTracer, Slip};

const SIZE: [u32; 2] = [96, 54];

/// Lists the mistakes with the key that a verdict should have for each.
macro_rules! mistakes {
    ($($name:ident => $key:literal),+ $(,)?) => {
        /// A mistake in a picture of the exact tracer: of its scene, or of the writer of its codes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Made {
            $($name),+
        }

        impl Made {
            const ALL: &[Self] = &[$(Self::$name),+];

            const fn key(self) -> &'static str {
                match self {
                    $(Self::$name => $key),+
                }
            }
        }
    };
}

mistakes! {
    NoSpecular => "no-specular",
    NoReflection => "no-reflection",
    NoAmbient => "no-ambient",
    Depth1 => "depth-too-small",
    Depth2 => "depth-too-small",
    InvertedIor => "refraction-indices-exchanged",
    FlippedDown => "flipped-top-to-bottom",
    UpsideDown => "turned-upside-down",
    Transposed => "transposed",
    Gamma => "gamma-instead-of-linear",
    Gamma22 => "gamma-instead-of-linear",
    Darker => "exposure",
    Brighter => "exposure",
    BlueFirst => "red-and-blue-exchanged",
    Overflow => "codes-overflow",
    Size => "size",
    Resampled => "half-pixel",
}

use Made::*;

impl Made {
    /// Whether a scene shows it.
    fn shows(self, scene: usize) -> bool {
        match self {
            InvertedIor => scene == 1,
            Overflow => scene == 2,
            Depth2 => scene < 2,
            // Without clear bodies, that is a mirror less.
            Depth1 => scene == 1,
            _ => true,
        }
    }
}

/// A picture of codes as it is written.
#[derive(Clone)]
struct Coded {
    size: [u32; 2],
    codes: Vec<[u8; 3]>,
}

impl Coded {
    fn of_light(size: [u32; 2], light: &[[f32; 3]], made: Option<Made>) -> Self {
        let mut factor = 1.0;
        if made == Some(Darker) {
            factor = 0.6;
        }
        if made == Some(Brighter) {
            factor = 1.4;
        }
        let code = |light: f32| {
            let light = f64::from(light) * factor;
            if made == Some(Overflow) {
                return ((light * 255.0) as u32 % 256) as u8;
            }
            let light = light.clamp(0.0, 1.0);
            let value = if made == Some(Gamma) {
                srgb::encode(light)
            } else if made == Some(Gamma22) {
                light.powf(1.0 / 2.2)
            } else {
                light
            };
            // As programs do that know nothing of rounding.
            (value * 255.0) as u8
        };
        let mut codes: Vec<[u8; 3]> = light.iter().map(|light| light.map(code)).collect();
        if made == Some(BlueFirst) {
            codes.iter_mut().for_each(|code| code.reverse());
        }
        let mut coded = Self { size, codes };
        if made == Some(Resampled) {
            coded = coded.map(size, |own, x, y| {
                let [right, below] = [(x + 1).min(size[0] - 1), (y + 1).min(size[1] - 1)];
                let four = [own.at(x, y), own.at(right, y), own.at(x, below), own.at(right, below)];
                [0, 1, 2].map(|c| (four.iter().map(|code| u32::from(code[c])).sum::<u32>() / 4) as u8)
            });
        }
        let [width, height] = size;
        if made == Some(FlippedDown) {
            coded = coded.map(size, |own, x, y| own.at(x, height - 1 - y));
        }
        if made == Some(UpsideDown) {
            coded = coded.map(size, |own, x, y| own.at(width - 1 - x, height - 1 - y));
        }
        if made == Some(Transposed) {
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
fn made_by_independent(scene: &Scene, slips: &[Slip]) -> Coded {
    let light = IndependentTracer::new(scene, slips).light(SIZE);
    let light: Vec<[f32; 3]> = light.iter().map(|light| light.as_vec3().to_array()).collect();
    Coded::of_light(SIZE, &light, None)
}

/// The picture with a mistake by the exact tracer, of a scene that is changed.
fn made_by_exact(scene: &Scene, made: Option<Made>) -> Coded {
    let mut scene = scene.clone();
    match made {
        Some(NoSpecular) => each_phong(&mut scene, |phong| phong.specular = 0.0),
        Some(NoReflection) => each_phong(&mut scene, |phong| phong.reflection = Some(0.0)),
        Some(NoAmbient) => scene.environment.ambient = catoptric_scene::Color::BLACK,
        Some(Depth1) => scene.tracing.generations = 1,
        Some(Depth2) => scene.tracing.generations = 2,
        Some(InvertedIor) => each_phong(&mut scene, |phong| phong.ior = phong.ior.recip()),
        _ => {}
    }
    let [width, height] = if made == Some(Size) { [80, 45] } else { SIZE };
    let prepared = RenderScene::build(&scene).unwrap();
    let settings = RenderSettings { width, height, samples: 1 };
    let picture = render(&prepared, settings, &RenderControl::default()).unwrap().picture;
    Coded::of_light([width, height], picture.pixels(), made)
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

#[test]
fn mistakes_in_pictures_of_the_exact_tracer_are_named() {
    let scenes = scenes::scenes().into_iter().take(3).collect::<Vec<_>>();
    let detectives: Vec<Detective<'_>> =
        scenes.iter().map(|scene| Detective::new(scene, settings()).unwrap()).collect();
    let of_scene = |scene| {
        Made::ALL.iter().copied().filter(move |made| made.shows(scene)).map(move |made| (scene, made))
    };
    let cases: Vec<(usize, Made)> = (0..3).flat_map(of_scene).collect();
    let wrong = |(index, made): &(usize, Made)| {
        let scene = &scenes[*index];
        let picture = made_by_exact(scene, Some(*made));
        let verdict = detectives[*index].check(&picture.observed(), &RenderControl::default()).unwrap();
        let found: Vec<&str> = verdict.mistakes.iter().map(Mistake::key).collect();
        (found != [made.key()])
            .then(|| format!("{index} {made:?}: {}", verdict.sentence(scene, Language::English)))
    };
    let wrong: Vec<String> = cases.par_iter().filter_map(wrong).collect();
    // Where a mistake looks like another in one scene, that one is named.
    assert!(wrong.len() * 20 <= cases.len(), "{wrong:#?}");
}

#[test]
fn right_pictures_raise_no_alarm() {
    for (index, scene) in scenes::scenes().iter().enumerate() {
        let detective = Detective::new(scene, settings()).unwrap();
        for picture in [made_by_independent(scene, &[]), made_by_exact(scene, None)] {
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
    let right = made_by_exact(&weighed, None);
    let verdict = detective.check(&right.observed(), &RenderControl::default()).unwrap();
    assert!(verdict.is_right(0.001), "{}", verdict.sentence(&weighed, Language::English));
    let picture = made_by_exact(constant, None);
    let verdict = detective.check(&picture.observed(), &RenderControl::default()).unwrap();
    assert_eq!(verdict.to_json(&weighed, 0.01)["mistakes"][0]["key"], "clear-bodies-not-weighed");
    assert!(verdict.sentence(&weighed, Language::English).contains("Schlick"));
}

#[test]
fn a_verdict_is_told_in_both_languages_and_in_json() {
    let scene = &scenes::scenes()[1];
    let detective = Detective::new(scene, settings()).unwrap();
    let picture = made_by_independent(scene, &[Slip::LeftHanded, Slip::NoShadows]);
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
    let observed = made_by_exact(scene, None).observed();
    assert!(matches!(detective.check(&observed, &control), Err(DetectiveError::Cancelled)));
}
