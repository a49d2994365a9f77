//! Comparisons and their page.

use catoptric_lab::compare::{CompareError, CompareJob, Contender, compare, draw_all};
use catoptric_lab::report::{Language, PageSettings, page};
use catoptric_lab::{Machine, Variant};
use catoptric_picture::{Development, Picture};
use catoptric_scene::Example;
use catoptric_tracer::{RenderControl, RenderSettings};

fn contender(name: &str, light: f32) -> Contender {
    let picture = Picture::from_fn(32, 18, |x, _| [light + 0.01 * x as f32; 3]).unwrap();
    Contender { name: name.to_owned(), picture, drawn: None }
}

fn machine() -> Machine {
    Machine {
        processor: "A <processor> & more".to_owned(),
        cores: None,
        threads: 2,
        memory_bytes: 3 << 30,
        system: String::new(),
        program: "catoptric".to_owned(),
    }
}

fn settings(language: Language) -> PageSettings {
    PageSettings {
        scene: Some("four-bodies".to_owned()),
        bodies_and_lights: Some([5, 1]),
        samples: Some(1),
        generations: Some(6),
        threads: 2,
        development: Development::default(),
        language,
    }
}

/// The traced scene with fewer and fewer generations.
fn drawn() -> Vec<Contender> {
    let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
    let names = ["whitted", "whitted:generations=2", "whitted:generations=1"];
    let variants: Vec<Variant> = names.iter().map(|name| name.parse().unwrap()).collect();
    let settings = RenderSettings { width: 64, height: 36, samples: 1 };
    let job = CompareJob { scene: &scene, variants: &variants, settings, runs: 2, bound: 1.0 / 255.0 };
    let mut told = Vec::new();
    let contenders =
        draw_all(&job, &RenderControl::default(), &mut |done, total| told.push((done, total))).unwrap();
    assert_eq!(told, (1..=9).map(|done| (done, 9)).collect::<Vec<_>>());
    contenders
}

#[test]
fn fewer_generations_are_farther_from_the_truth() {
    let compared = compare(drawn(), 1.0 / 255.0).unwrap();
    let flips: Vec<f64> = compared.others().map(|(_, metrics)| metrics.flip).collect();
    assert!(0.0 < flips[0] && flips[0] < flips[1], "{flips:?}");
    let similar: Vec<f64> = compared.others().filter_map(|(_, metrics)| metrics.ssim).collect();
    assert!(1.0 > similar[0] && similar[0] > similar[1], "{similar:?}");
    for contender in &compared.contenders {
        let drawn = contender.drawn.as_ref().unwrap();
        assert_eq!((drawn.runs, drawn.passes.len()), (2, 1));
        assert!(drawn.time > 0.0 && drawn.reasons.is_none());
    }
}

#[test]
fn numbers_of_pictures_that_differ_by_a_constant() {
    let compared = compare(vec![contender("a", 0.25), contender("b", 0.375)], 0.1).unwrap();
    let (_, metrics) = compared.others().next().unwrap();
    assert!((metrics.difference.rmse - 0.125).abs() < 1e-6 && metrics.difference.share_above == 1.0);
    assert_eq!(compared.scale(), 0.25, "the least end of the scale that shows it");
}

#[test]
fn the_page_is_whole_and_well_formed_in_both_languages() {
    for language in Language::ALL {
        let mut contenders = drawn();
        contenders.push(Contender { name: "<i>\"&".to_owned(), ..contenders[0].clone() });
        let compared = compare(contenders, 1.0 / 255.0).unwrap();
        let html = page(&compared, &machine(), &settings(language)).unwrap();
        let body = html.strip_prefix("<!DOCTYPE html>\n").unwrap();
        let document = roxmltree::Document::parse(body).unwrap();
        assert_eq!(document.root_element().attribute("lang"), Some(language.code()));
        let count = |name: &str| document.descendants().filter(|node| node.has_tag_name(name)).count();
        // Four pictures, two of which differ from the first, with two maps each.
        assert_eq!((count("image"), count("section"), count("input")), (4 + 2 * 2, 3, 3));
        let mut ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
        for node in document.descendants().filter(|node| node.has_tag_name("use")) {
            assert!(ids.contains(&node.attribute("href").unwrap().trim_start_matches('#')));
        }
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{ids:?}");
        // Nothing is fetched: no address outside of the page but the names of namespaces.
        for node in document.descendants() {
            let addresses = ["href", "src"].into_iter().filter_map(|name| node.attribute(name));
            for address in addresses {
                assert!(
                    address.starts_with('#') || address.starts_with("data:image/png;base64,"),
                    "{address}"
                );
            }
        }
        let text: String = document.descendants().filter_map(|node| node.text()).collect();
        assert!(text.contains("A <processor> & more") && text.contains("<i>\"&"));
        assert!(!text.contains("{name}") && !text.contains("{truth}") && !text.contains("{count}"));
        match language {
            Language::English => assert!(text.contains("3.0 GiB") && text.contains("Wrong pixels, %")),
            Language::Russian => assert!(text.contains("3,0 ГиБ") && text.contains("Неверных пикселей, %")),
        }
    }
}

#[test]
fn what_cannot_be_compared_is_refused() {
    assert!(matches!(compare(Vec::new(), 0.1), Err(CompareError::Few(0))));
    assert!(matches!(compare(vec![contender("a", 0.1)], 0.1), Err(CompareError::Few(1))));
    let small = Contender { picture: Picture::new(3, 3).unwrap(), ..contender("small", 0.0) };
    let error = compare(vec![contender("a", 0.1), small], 0.1).unwrap_err();
    assert_eq!(error.to_string(), "cannot compare small with a");
    let control = RenderControl::default();
    control.cancel();
    let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
    let variants = ["whitted".parse().unwrap()];
    let settings = RenderSettings { width: 64, height: 36, samples: 1 };
    let job = CompareJob { scene: &scene, variants: &variants, settings, runs: 1, bound: 0.1 };
    assert!(matches!(draw_all(&job, &control, &mut |_, _| {}), Err(CompareError::Cancelled)));
}
