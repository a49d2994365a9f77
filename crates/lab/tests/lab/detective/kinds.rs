//! Every kind of mistake of the independent tracer, alone and in pairs, and the pictures of the issue.

use catoptric_lab::Random;
use catoptric_lab::detective::{CodeCurve, Detective, DetectiveSettings, Mistake, ObservedPicture, Verdict};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, srgb};
use catoptric_scene::{Body, Material, Scene};
use catoptric_tracer::RenderControl;
use rayon::prelude::*;

use super::{SIZE, scenes, settings};
use crate::independent_tracer::{Encoding, IndependentTracer, Slip, share_of_differences};

/// The picture that codes make.
fn observed([width, height]: [u32; 2], codes: &[[u8; 3]]) -> ObservedPicture {
    let light = |code: u8| srgb::decode(f64::from(code) / 255.0) as f32;
    let pixels = codes.iter().map(|code| code.map(light)).collect();
    ObservedPicture::of_codes(&Picture::from_pixels(width, height, pixels).unwrap())
}

fn all_scenes() -> Vec<Scene> {
    scenes::scenes().into_iter().chain(scenes::cases()).collect()
}

/// Whether verdicts of a scene take long, since rays go through several clear bodies.
fn is_slow(scene: &Scene) -> bool {
    let is_clear = |body: &Body| match scene.material(&body.material) {
        Some(Material::Phong(phong)) => phong.transmission > 0.0,
        _ => false,
    };
    scene.bodies.iter().filter(|body| is_clear(body)).count() > 1
}

fn keys(verdict: &Verdict) -> Vec<&'static str> {
    verdict.mistakes.iter().map(Mistake::key).collect()
}

/// Other names that say as much of some mistakes.
fn is_name_of(slip: Slip, key: &str) -> bool {
    let others: &[&str] = match slip {
        Slip::Stretched | Slip::Cropped => &["view-stretched-or-cropped", "stretched"],
        // Beside other numbers, both laws are 1/d².
        Slip::FalloffSquaredDistance => &["falloff"],
        // Without clear bodies, that is a mirror less.
        Slip::Depth1 => &["no-reflection"],
        // That no lamp shines anywhere has many causes.
        Slip::ShadowsFromBehind | Slip::LampsAsDirections | Slip::NormalsInward => {
            &["shadows-from-beyond-the-lamp", "shadows-from-behind", "normals-inward"]
        }
        // What stands on a floor looks shorter if it stands lower.
        Slip::CylindersShort => &["kind-of-body-shifted", "middle-and-base-of-cylinders"],
        // Of a ball that is scaled after it was turned, no turn is seen.
        Slip::ScaleAfterTurn => &["rotation-left-out"],
        _ => &[],
    };
    key == slip.key() || others.contains(&key)
}

fn is_named(slips: &[Slip], found: &[&str]) -> bool {
    slips.iter().all(|slip| found.iter().any(|key| is_name_of(*slip, key)))
        && found.iter().all(|key| slips.iter().any(|slip| is_name_of(*slip, key)))
}

/// A scene with its right codes and its detective.
struct Bench<'a> {
    scene: &'a Scene,
    right: Vec<[u8; 3]>,
    detective: Detective<'a>,
}

impl<'a> Bench<'a> {
    fn all(scenes: &'a [Scene]) -> Vec<Self> {
        let bench = |scene: &'a Scene| Bench {
            scene,
            right: IndependentTracer::new(scene, &[]).codes(SIZE, Encoding::Linear),
            detective: Detective::new(scene, settings()).unwrap(),
        };
        scenes.par_iter().map(bench).collect()
    }

    fn codes(&self, slips: &[Slip]) -> Vec<[u8; 3]> {
        IndependentTracer::new(self.scene, slips).codes(SIZE, Encoding::Linear)
    }

    /// The share of pixels that mistakes change.
    fn share(&self, codes: &[[u8; 3]]) -> f64 {
        share_of_differences(codes, &self.right, 4)
    }

    fn verdict(&self, codes: &[[u8; 3]]) -> Verdict {
        self.detective.check(&observed(SIZE, codes), &RenderControl::default()).unwrap()
    }
}

/// The least share of pixels that a mistake changes to be looked for.
const SHOWN: f64 = 0.01;

/// Holds each mistake against as many scenes that show it; those that were not named, or that too few scenes show.
fn missed(slips: &[Slip], most_scenes: usize) -> Vec<String> {
    let scenes = all_scenes();
    let benches = Bench::all(&scenes);
    let of = |(place, slip): (usize, &Slip)| {
        let mut found = Vec::new();
        let mut count = 0;
        // Not always the first scenes.
        let mut order: Vec<usize> = (0..benches.len()).map(|index| (index + place) % benches.len()).collect();
        order.sort_by_key(|index| is_slow(benches[*index].scene));
        for index in order {
            let bench = &benches[index];
            let codes = bench.codes(&[*slip]);
            if count == most_scenes || bench.share(&codes) < SHOWN {
                continue;
            }
            count += 1;
            let verdict = bench.verdict(&codes);
            if !is_named(&[*slip], &keys(&verdict)) {
                let words = verdict.sentence(bench.scene, Language::English);
                found.push(format!("{slip:?} in scene {index}: {words}"));
            }
        }
        if count < most_scenes.min(2) {
            found.push(format!("{slip:?} shows in {count} scenes"));
        }
        found
    };
    slips.par_iter().enumerate().flat_map_iter(of).collect()
}

/// A third of the kinds, in a scene each.
#[test]
fn kinds_of_mistakes_are_named() {
    let some: Vec<Slip> = Slip::ALL.iter().copied().step_by(3).collect();
    let missed = missed(&some, 1);
    // Where a mistake looks like another in one scene, that one is named.
    assert!(missed.len() * 20 <= some.len(), "{missed:#?}");
}

/// Takes a minute on two cores.
#[test]
#[ignore = "exhaustive"]
fn each_kind_of_mistake_is_named() {
    let missed = missed(Slip::ALL, 1);
    assert!(missed.len() * 20 <= Slip::ALL.len(), "{missed:#?}");
}

/// Takes some minutes.
#[test]
#[ignore = "exhaustive"]
fn each_kind_of_mistake_is_named_in_every_scene() {
    let missed = missed(Slip::ALL, usize::MAX);
    assert!(missed.len() * 20 <= 5 * Slip::ALL.len(), "{missed:#?}");
}

/// The random pairs of mistakes that are not named, or with another mistake, in words, of every `step`-th of a hundred; and
/// the number of pairs that were tried.
fn missed_pairs(step: usize) -> (Vec<String>, usize) {
    let scenes = all_scenes();
    let benches = Bench::all(&scenes);
    let mut random = Random::new(7);
    let mut pairs = Vec::new();
    while pairs.len() < 100 {
        let slip = |random: &mut Random| Slip::ALL[random.below(Slip::ALL.len() as u64) as usize];
        let pair = [slip(&mut random), slip(&mut random)];
        let bench = &benches[random.below(benches.len() as u64) as usize];
        // Both must be seen, alone and beside the other.
        let [one, other] = pair.map(|slip| bench.codes(&[slip]));
        let both = bench.codes(&pair);
        let shows = |codes: &[[u8; 3]]| share_of_differences(&both, codes, 4) >= SHOWN;
        if bench.share(&one) >= SHOWN && bench.share(&other) >= SHOWN && shows(&one) && shows(&other) {
            pairs.push((pair, bench, both));
        }
    }
    let outcome = |(pair, bench, codes): &([Slip; 2], &Bench<'_>, Vec<[u8; 3]>)| {
        let verdict = bench.verdict(codes);
        let words = || format!("{pair:?}: {}", verdict.sentence(bench.scene, Language::English));
        (!is_named(pair, &keys(&verdict))).then(words)
    };
    let tried: Vec<_> = pairs.iter().step_by(step).collect();
    (tried.par_iter().copied().filter_map(outcome).collect(), tried.len())
}

#[test]
fn pairs_of_mistakes_are_named() {
    let (missed, tried) = missed_pairs(7);
    // A few of the hundred below, of which a fifth may be missed.
    assert!(missed.len() * 3 <= tried, "{missed:#?}");
}

/// Takes a minute or two.
#[test]
#[ignore = "exhaustive"]
fn of_a_hundred_pairs_of_mistakes_eighty_are_named() {
    let (missed, tried) = missed_pairs(1);
    println!("{} of {tried} pairs were not named", missed.len());
    assert!(missed.len() * 5 <= tried, "{missed:#?}");
}

/// POV-Ray's pictures of the reference scenes are right.
#[test]
fn right_pictures_of_another_renderer_are_not_accused() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let scenes: Vec<_> = files.filter(|path| path.extension().is_some_and(|own| own == "toml")).collect();
    assert!(scenes.len() > 30, "{}", scenes.len());
    let accused = |path: &std::path::PathBuf| {
        let scene =
            catoptric_scene::read(&std::fs::read_to_string(path).unwrap()).into_result().unwrap().value;
        let picture = catoptric_picture::read(&path.with_extension("exr")).unwrap();
        let settings = DetectiveSettings { searched_pixels: 400, judged_pixels: 800, ..settings() };
        let settings = DetectiveSettings { expected_size: None, ..settings };
        let detective = Detective::new(&scene, settings).unwrap();
        let verdict =
            detective.check(&ObservedPicture::of_light(&picture), &RenderControl::default()).unwrap();
        (!verdict.mistakes.is_empty()).then(|| (path.clone(), verdict.sentence(&scene, Language::English)))
    };
    let accused: Vec<_> = scenes.par_iter().filter_map(accused).collect();
    assert!(accused.is_empty(), "{accused:#?}");
}

/// Pictures by a tracer that is neither of this repository's.
#[test]
fn pictures_of_a_third_tracer_are_explained() {
    let cases: [(&[u8], usize, &str); 7] = [
        (include_bytes!("cases/ambient-once-for-each-lamp.png"), 0, "ambient-for-each-lamp"),
        (include_bytes!("cases/caps-missing.png"), 1, "caps-missing"),
        (include_bytes!("cases/checker-truncated-at-zero.png"), 0, "checker-truncated"),
        (include_bytes!("cases/gamma-2.2-twice.png"), 0, "encoded-twice"),
        (include_bytes!("cases/normals-not-normalized.png"), 1, "normals-not-normalized"),
        (include_bytes!("cases/rotations-in-the-other-order.png"), 1, "rotation-order"),
        (include_bytes!("cases/shadow-beyond-the-lamp.png"), 2, "shadows-from-beyond-the-lamp"),
    ];
    let scenes = scenes::cases();
    let curve = CodeCurve::Srgb;
    let settings = DetectiveSettings {
        curve,
        expected_size: None,
        searched_pixels: 1600,
        judged_pixels: 3000,
        ..settings()
    };
    let wrong = |(bytes, scene, key): &(&[u8], usize, &str)| {
        let picture = catoptric_picture::decode(bytes).unwrap();
        let detective = Detective::new(&scenes[*scene], settings).unwrap();
        let observed = ObservedPicture::of_codes(&picture);
        let verdict = detective.check(&observed, &RenderControl::default()).unwrap();
        let is_named = keys(&verdict) == [*key] && verdict.agreed > 0.99;
        (!is_named).then(|| format!("{key}: {}", verdict.sentence(&scenes[*scene], Language::English)))
    };
    let wrong: Vec<String> = cases.par_iter().filter_map(wrong).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
