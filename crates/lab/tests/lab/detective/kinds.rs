//! Every kind of mistake of the independent tracer, alone and in pairs, and the pictures of the issue.

use std::time::Instant;

use catoptric_lab::Random;
use catoptric_lab::detective::{CodeCurve, Detective, DetectiveSettings, Mistake, ObservedPicture, Verdict};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, srgb};
use catoptric_scene::Scene;
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

#[test]
fn each_kind_of_mistake_is_named_in_two_scenes() {
    let scenes = all_scenes();
    let benches = Bench::all(&scenes);
    let start = Instant::now();
    let outcome = |slip: &Slip| {
        let mut tried = Vec::new();
        for (index, bench) in benches.iter().enumerate() {
            let codes = bench.codes(&[*slip]);
            if bench.share(&codes) < SHOWN {
                continue;
            }
            let at = Instant::now();
            let verdict = bench.verdict(&codes);
            let is_named = is_named(&[*slip], &keys(&verdict));
            println!(
                "{slip:?} {index}: {} {:?} {} {}",
                if is_named { "named" } else { "MISSED" },
                keys(&verdict),
                at.elapsed().as_millis(),
                verdict.sentence(bench.scene, Language::English)
            );
            tried.push(is_named);
            if tried.len() == 2 && std::env::var("ALL_SCENES").is_err() {
                break;
            }
        }
        (*slip, tried)
    };
    let outcomes: Vec<(Slip, Vec<bool>)> = Slip::ALL.par_iter().map(outcome).collect();
    let missed: Vec<&(Slip, Vec<bool>)> =
        outcomes.iter().filter(|(_, named)| named.len() < 2 || named.contains(&false)).collect();
    println!("{} ms", start.elapsed().as_millis());
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn pairs_of_mistakes_are_named() {
    let scenes = all_scenes();
    let benches = Bench::all(&scenes);
    let count: usize = std::env::var("PAIRS").map_or(20, |count| count.parse().unwrap());
    let mut random = Random::new(7);
    let mut pairs = Vec::new();
    while pairs.len() < count {
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
        let at = Instant::now();
        let verdict = bench.verdict(codes);
        let is_named = is_named(pair, &keys(&verdict));
        println!(
            "{pair:?}: {} {:?} {} {}",
            if is_named { "named" } else { "MISSED" },
            keys(&verdict),
            at.elapsed().as_millis(),
            verdict.sentence(bench.scene, Language::English)
        );
        is_named
    };
    let named = pairs.par_iter().map(outcome).filter(|is_named| *is_named).count();
    println!("{named} of {count}");
    assert!(named * 10 >= count * 8, "{named} of {count}");
}

/// Pictures by another tracer than the independent one.
#[test]
fn pictures_of_the_issue_are_named() {
    let Some(folder) = std::env::var_os("DETECTIVE_CASES") else { return };
    let cases = [
        ("ambient-once-for-each-lamp", 0, "ambient-for-each-lamp"),
        ("caps-missing", 1, "caps-missing"),
        ("checker-truncated-at-zero", 0, "checker-truncated"),
        ("gamma-2.2-twice", 0, "encoded-twice"),
        ("normals-not-normalised", 1, "normals-not-normalized"),
        ("rotations-in-the-other-order", 1, "rotation-order"),
        ("shadow-beyond-the-lamp", 2, "shadows-from-beyond-the-lamp"),
    ];
    let scenes = scenes::cases();
    let mut missed = Vec::new();
    for (name, scene, key) in cases {
        let path = std::path::Path::new(&folder).join(format!("{name}.png"));
        let picture = catoptric_picture::read(&path).unwrap();
        let settings = DetectiveSettings { curve: CodeCurve::Srgb, ..DetectiveSettings::default() };
        let detective = Detective::new(&scenes[scene], settings).unwrap();
        let verdict = detective.check(&ObservedPicture::of_codes(&picture), &RenderControl::default()).unwrap();
        println!("{name}: {:?} {}", keys(&verdict), verdict.sentence(&scenes[scene], Language::English));
        if keys(&verdict) != [key] {
            missed.push(name);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}
