//! The simplest pixel that differs, where all that is simpler agrees.

use catoptric_lab::detective::{
    CodeCurve, DetectiveSettings, DifferenceKind, ObservedPicture, SimplestDifference, Verdict,
};
use catoptric_lab::report::Language;
use catoptric_scene::{Color, Scene};

use super::agreement::{check, settings, traced};

const SIZE: [u32; 2] = [48, 36];

/// A plain body, one with a highlight, one that reflects and one of glass, side by side; a body out of sight throws a shadow
/// on the first.
const BODIES: &str = "format = 'catoptric/1'
    camera = { position = [0.0, 0.0, 9.0], target = [0.0, 0.0, 0.0], fov = 40.0 }
    environment = { background = [0.1, 0.2, 0.3], ambient = [1.0, 1.0, 1.0] }
    lights = [{ position = [-4.0, 5.0, 8.0], intensity = 0.9 }]
    tracing = { generations = 5 }
    materials.plain = { color = [0.6, 0.5, 0.4], ambient = 0.2, diffuse = 0.6, specular = 0.0 }
    materials.shiny = { color = [0.3, 0.5, 0.3], ambient = 0.2, diffuse = 0.5, specular = 0.4, shininess = 20.0, reflection = 0.0 }
    materials.mirror = { color = [0.0, 0.0, 0.0], ambient = 0.0, diffuse = 0.0, specular = 0.0, reflection = 0.7 }
    materials.glass = { color = [0.0, 0.0, 0.0], ambient = 0.0, diffuse = 0.0, specular = 0.0, reflection = 0.0, transmission = 0.8, ior = 1.3 }
    bodies = [
        { name = 'plain', shape = 'sphere', position = [-3.2, 0.0, 0.0], material = 'plain' },
        { name = 'shiny', shape = 'sphere', position = [-1.0, 0.0, 0.0], material = 'shiny' },
        { name = 'mirror', shape = 'sphere', position = [1.2, 0.0, 0.0], material = 'mirror' },
        { name = 'glass', shape = 'sphere', position = [3.3, 0.0, 0.0], material = 'glass' },
        { name = 'above', shape = 'sphere', radius = 0.4, position = [-3.6, 2.5, 4.0], material = 'plain' },
    ]";

fn scene(changes: &[(&str, &str)]) -> Scene {
    let text = changes.iter().fold(BODIES.to_owned(), |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    });
    catoptric_scene::read(&text).into_result().unwrap().value
}

fn verdict(wrong: &Scene) -> Verdict {
    let picture = ObservedPicture::of_light(&traced(wrong, SIZE));
    check(&scene(&[]), settings(CodeCurve::Linear), &picture)
}

fn simplest(changes: &[(&str, &str)]) -> SimplestDifference {
    let verdict = verdict(&scene(changes));
    assert!(!verdict.is_right(Verdict::ALLOWED), "{changes:?}");
    verdict.simplest.unwrap()
}

#[test]
fn the_last_term_of_the_simplest_pixel_is_named_with_its_light() {
    let shininess = ("shininess = 20.0", "shininess = 60.0");
    let mirror = ("reflection = 0.7", "reflection = 0.4");
    let glass = ("transmission = 0.8", "transmission = 0.5");
    let plain = ("[0.6, 0.5, 0.4]", "[0.6, 0.1, 0.4]");
    // What is simpler hides what is not.
    for (changes, body, term, generation) in [
        (&[glass][..], 3, DifferenceKind::Refraction, 3),
        (&[mirror, glass], 2, DifferenceKind::Reflection, 2),
        (&[shininess, mirror], 1, DifferenceKind::Highlight, 1),
        (&[plain, shininess, glass], 0, DifferenceKind::Surface, 1),
    ] {
        let found = simplest(changes);
        assert_eq!(
            (found.pixel.body, found.term, found.generation),
            (Some(body), term, generation),
            "{found:?}"
        );
        let [own, wrong] = [scene(&[]), scene(changes)].map(|scene| {
            let [x, y] = found.pixel.pixel;
            traced(&scene, SIZE).pixel(x, y).unwrap()
        });
        // The difference of the term is that of the pixel.
        for channel in 0..3 {
            let difference = found.found_light[channel] - found.expected_light[channel];
            assert!(
                (difference - (wrong[channel] - own[channel])).abs() < 1e-4,
                "{found:?} {own:?} {wrong:?}"
            );
        }
        if term == DifferenceKind::Reflection {
            // Seven tenths of the background, of which the other picture has four.
            assert!(
                (found.expected_light[2] - 0.21).abs() < 0.2
                    && found.found_light[2] < found.expected_light[2]
            );
        }
    }
    let mut wrong = scene(&[plain]);
    wrong.environment.background = Color::from([0.1, 0.2, 0.6]);
    let found = verdict(&wrong).simplest.unwrap();
    assert_eq!((found.pixel.body, found.term), (None, DifferenceKind::Background));
    assert!((found.found_light[2] - 0.6).abs() < 1e-4 && (found.expected_light[2] - 0.3).abs() < 1e-4);
}

#[test]
fn a_lost_shadow_is_the_light_of_lamps_where_none_should_be() {
    let found = simplest(&[("radius = 0.4", "radius = 0.01")]);
    assert_eq!((found.pixel.body, found.term, found.generation), (Some(0), DifferenceKind::Shadow, 1));
    assert!(found.expected_light == [0.0; 3] && found.found_light[0] > 0.1, "{found:?}");
}

#[test]
fn where_to_look_is_told_in_words_and_numbers() {
    let scene = scene(&[]);
    let wrong = self::scene(&[("[0.6, 0.5, 0.4]", "[0.6, 0.1, 0.4]")]);
    let verdict = verdict(&wrong);
    let found = verdict.simplest.unwrap();
    let [x, y] = found.pixel.stored;
    let words = found.in_words(&scene, Language::English);
    assert!(
        words.starts_with(&format!("look first at pixel {x},{y} (\"plain\", generation 1, surface")),
        "{words}"
    );
    let russian = found.in_words(&scene, Language::Russian);
    assert!(
        russian.starts_with(&format!("начните с пикселя {x},{y} (")) && russian.contains("0,"),
        "{russian}"
    );
    let json = verdict.to_json(&scene, 0.01);
    assert_eq!(json["look_first"]["term"], "surface");
    assert_eq!(json["look_first"]["generation"], 1);
    assert_eq!(json["look_first"]["words"], words);
    assert!(json["share_beyond_edges"].as_f64().unwrap() > 0.01);
    let exact = ObservedPicture::of_light(&traced(&scene, SIZE));
    let settings = DetectiveSettings { curve: CodeCurve::Linear, ..DetectiveSettings::default() };
    assert!(check(&scene, settings, &exact).to_json(&scene, 0.01)["look_first"].is_null());
}
