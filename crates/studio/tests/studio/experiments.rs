//! The lab: ways of drawing, the comparison, the measurement. In both languages, by what a screen reader hears.

use std::path::Path;
use std::time::{Duration, Instant};

use catoptric_live::DisplayContent;
use catoptric_picture::{BitDepth, Development, Picture, write_png};
use catoptric_studio::{
    Command, CompareCommand, DisplayCommand, MeasureCommand, Pane, PictureCommand, StartDocument, Studio,
    WindowCommand,
};
use catoptric_tracer::raster::{GBufferLayer, Method, MethodKind};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use egui::{Key, Modifiers, accesskit};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

const LANGUAGES: [&str; 2] = ["english", "russian"];

/// A studio in a language with the example of four bodies.
fn open(language: &str) -> (TestHost, Harness<'static, Studio>) {
    let host = TestHost::new();
    let text = format!(r#"{{"language": "{language}", "is_hint_dismissed": true, "viewport_samples": 1}}"#);
    std::fs::write(host.path("settings.json"), text).unwrap();
    let mut harness = studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()));
    harness.set_size(egui::vec2(1280.0, 800.0));
    wait_until(&mut harness, "a picture", |studio| studio.live().latest().is_some());
    (host, harness)
}

/// The message of a key in the present language.
fn said(harness: &Harness<'static, Studio>, key: &str) -> String {
    harness.state().texts().get(key).to_owned()
}

fn click(harness: &mut Harness<'static, Studio>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(3);
}

fn run(harness: &mut Harness<'static, Studio>, command: impl Into<Command>) {
    harness.state_mut().run(command);
    harness.run_steps(3);
}

fn check_texts(harness: &Harness<'static, Studio>) {
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_way_of_drawing_is_chosen_over_the_picture() {
    for language in LANGUAGES {
        let (_host, mut harness) = open(language);
        let traced = said(&harness, "command-method-whitted");
        let button = harness.state().texts().with("viewport-method-name", &[("method", traced.into())]);
        click(&mut harness, &button);
        let flat = said(&harness, "command-method-flat");
        click(&mut harness, &flat);
        let status = |studio: &Studio| studio.live().status().method;
        wait_until(&mut harness, "a flat picture", |studio| status(studio) == Some(MethodKind::Flat));
        // Its settings are there at once, and stay with the other methods of faces.
        let shadows = said(&harness, "method-shadows");
        harness
            .get_all_by_label(&shadows)
            .find(|node| node.accesskit_node().role() == accesskit::Role::CheckBox)
            .unwrap()
            .click();
        harness.run_steps(3);
        let phong = harness.state().settings().methods.of(MethodKind::Phong);
        assert!(matches!(phong, Method::Phong(shading) if shading.shadows), "{phong:?}");
        harness.key_press(Key::Escape);
        harness.run_steps(2);
        // The status bar tells the method.
        let short = said(&harness, "method-flat");
        assert!(harness.get_all_by_label(&short).count() >= 1);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Num3);
        wait_until(&mut harness, "cube maps", |studio| studio.live().status().cube_maps.is_some());
        check_texts(&harness);
    }
}

#[test]
fn layers_and_cubes_are_seen_and_become_pictures() {
    let (_host, mut harness) = open("english");
    // A traced picture has no layers.
    run(&mut harness, DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Depth)));
    run(&mut harness, DisplayCommand::Method(MethodKind::Ssr));
    let shown = |studio: &Studio| studio.live().latest().map(|frame| frame.shows);
    wait_until(&mut harness, "reflections", |studio| {
        studio.live().status().method == Some(MethodKind::Ssr)
            && shown(studio) == Some(DisplayContent::Picture)
    });
    run(&mut harness, DisplayCommand::Show(DisplayContent::Layer(GBufferLayer::Normal)));
    wait_until(&mut harness, "normals", |studio| {
        shown(studio) == Some(DisplayContent::Layer(GBufferLayer::Normal))
    });
    run(&mut harness, PictureCommand::RenderShown);
    wait_until(&mut harness, "a picture of them", |studio| !studio.is_rendering());
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("Picture ").is_some());
    run(&mut harness, DisplayCommand::Method(MethodKind::CubeMap));
    run(&mut harness, DisplayCommand::Show(DisplayContent::UnfoldedCube(None)));
    wait_until(&mut harness, "a cube", |studio| {
        matches!(shown(studio), Some(DisplayContent::UnfoldedCube(Some(_))))
    });
    check_texts(&harness);
}

#[test]
fn pictures_are_compared_and_reported() {
    for language in LANGUAGES {
        let (host, mut harness) = open(language);
        run(&mut harness, WindowCommand::TogglePane(Pane::Compare));
        wait_until(&mut harness, "a comparison", Studio::is_compared);
        harness.run_steps(4);
        for label in ["RMSE", "SSIM", "FLIP"] {
            assert!(harness.query_all_by_label(label).count() >= 1, "{label}");
        }
        // The line is moved by keys.
        let label = said(&harness, "compare-divider");
        let value = |harness: &Harness<'static, Studio>| {
            harness.get_by_label(&label).accesskit_node().numeric_value().unwrap()
        };
        assert_eq!(value(&harness), 50.0);
        harness.get_by_label(&label).focus();
        harness.run_steps(2);
        harness.key_press(Key::ArrowRight);
        harness.run_steps(2);
        assert_eq!(value(&harness), 52.0);
        harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
        harness.run_steps(2);
        assert_eq!(value(&harness), 42.0);
        for (mode, picture) in [
            ("compare-mode-difference", "compare-picture-difference"),
            ("compare-mode-flip", "compare-picture-flip"),
            ("compare-mode-reasons", "compare-picture-reasons"),
            ("compare-mode-b", "compare-picture-b"),
        ] {
            let label = format!("{}: {}", said(&harness, "compare-mode"), said(&harness, mode));
            click(&mut harness, &label);
            assert!(harness.query_by_label(&said(&harness, picture)).is_some(), "{mode}");
        }
        host.answer(Some(host.path("report.html")));
        run(&mut harness, Command::Compare(CompareCommand::Save));
        let path = host.path("report.html");
        wait_until(&mut harness, "a report", |_| path.exists());
        let html = std::fs::read_to_string(&path).unwrap();
        let code = if language == "russian" { "ru" } else { "en" };
        assert!(html.contains(&format!("lang=\"{code}\"")) && html.contains("ssr"), "{language}");
        check_texts(&harness);
    }
}

/// Waits until something is said.
fn wait_for(harness: &mut Harness<'static, Studio>, part: &str) {
    let deadline = Instant::now() + Duration::from_secs(60);
    while harness.query_all_by_label_contains(part).count() == 0 {
        harness.step();
        assert!(Instant::now() < deadline, "{part}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The measures that the panel shows.
fn compared(harness: &Harness<'static, Studio>) -> Vec<String> {
    let labels = harness.get_all_by_role(accesskit::Role::Label);
    let values = labels.filter_map(|node| node.accesskit_node().value());
    values.filter(|text| text.starts_with("0.") && text.len() > 5).collect()
}

#[test]
fn a_comparison_follows_the_scene_and_reads_files() {
    let (host, mut harness) = open("english");
    run(&mut harness, WindowCommand::TogglePane(Pane::Compare));
    wait_until(&mut harness, "a comparison", Studio::is_compared);
    harness.run_steps(4);
    let drawn = compared(&harness);
    // A body goes: other pictures are compared.
    harness.state_mut().editor_mut().select_parts([catoptric_scene::ScenePart::Body(1)]);
    run(&mut harness, Command::Edit(catoptric_editor::Action::Delete));
    let deadline = Instant::now() + Duration::from_secs(60);
    while compared(&harness) == drawn {
        harness.step();
        assert!(Instant::now() < deadline, "the comparison does not follow");
        std::thread::sleep(Duration::from_millis(5));
    }
    let picture = Picture::from_fn(40, 30, |x, _| [x as f32 / 40.0; 3]).unwrap();
    let path = host.path("own.exr");
    catoptric_picture::write_exr(&path, &picture).unwrap();
    for act in [CompareCommand::FileA, CompareCommand::FileB] {
        host.answer(Some(path.clone()));
        run(&mut harness, Command::Compare(act));
    }
    let equal = "1.0000";
    wait_until(&mut harness, "files", Studio::is_compared);
    // A file is like itself.
    wait_for(&mut harness, equal);
    // A file that is none is told.
    std::fs::write(host.path("broken.png"), "no picture").unwrap();
    host.answer(Some(host.path("broken.png")));
    run(&mut harness, Command::Compare(CompareCommand::FileB));
    wait_for(&mut harness, "broken.png” cannot be read");
    check_texts(&harness);
}

#[test]
fn what_is_wrong_with_a_file_is_found() {
    let (host, mut harness) = open("english");
    let scene = RenderScene::build(harness.state().editor().scene()).unwrap();
    let settings = RenderSettings { width: 160, height: 90, samples: 1 };
    let right = render(&scene, settings, &RenderControl::default()).unwrap().picture;
    let flipped = Picture::from_fn(160, 90, |x, y| right.pixel(159 - x, y).unwrap()).unwrap();
    let path = host.path("flipped.png");
    write_png(&path, &Development::default().develop(&flipped, BitDepth::Eight).unwrap()).unwrap();
    run(&mut harness, WindowCommand::TogglePane(Pane::Compare));
    host.answer(Some(path));
    run(&mut harness, Command::Compare(CompareCommand::FileB));
    let check = said(&harness, "compare-check");
    wait_for(&mut harness, &check);
    click(&mut harness, &check);
    wait_for(&mut harness, "flipped left to right");
    check_texts(&harness);
}

/// Types other values into a field of the form.
fn retype(harness: &mut Harness<'static, Studio>, label: &str, text: &str) {
    harness.get_by_label(label).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_label(label).type_text(text);
    harness.run_steps(3);
}

#[test]
fn times_are_measured_while_the_picture_waits_and_saved() {
    for language in LANGUAGES {
        let (host, mut harness) = open(language);
        run(&mut harness, WindowCommand::TogglePane(Pane::Measure));
        let russian = language == "russian";
        let pixels = if russian { "Число пикселей C" } else { "Pixels C" };
        let values = harness.state().texts().with("measure-values", &[("parameter", pixels.into())]);
        retype(&mut harness, &values, "16x16, large");
        run(&mut harness, Command::Measure(MeasureCommand::Start));
        assert!(!harness.state().is_measuring());
        assert!(harness.query_by_label_contains("large").is_some(), "what is wrong is named");
        retype(&mut harness, &values, "16x16, 24x24, 32x32, 48x48");
        let start = said(&harness, "command-measure-start");
        click(&mut harness, &start);
        assert!(harness.state().is_measuring());
        // The scene may be edited meanwhile; its picture comes afterwards.
        let before = harness.state().live().latest().unwrap().revision;
        harness.state_mut().editor_mut().select_parts([catoptric_scene::ScenePart::Body(1)]);
        run(&mut harness, Command::Edit(catoptric_editor::Action::Delete));
        if harness.state().is_measuring() {
            assert_eq!(harness.state().live().latest().unwrap().revision, before);
        }
        wait_until(&mut harness, "the end of the measurement", |studio| !studio.is_measuring());
        wait_until(&mut harness, "the picture", move |studio| {
            studio.live().latest().is_some_and(|frame| frame.revision != before)
        });
        assert!(harness.query_by_label_contains("R² = ").is_some(), "the law is named");
        for part in ["measure-part-table", "measure-part-machine", "measure-part-plot"] {
            let label = format!("{}: {}", said(&harness, "measure-part"), said(&harness, part));
            click(&mut harness, &label);
        }
        host.answer(Some(host.path("times")));
        run(&mut harness, Command::Measure(MeasureCommand::Save));
        let report = host.path("times/report.tex");
        wait_until(&mut harness, "the files", |_| report.exists());
        let report = std::fs::read_to_string(host.path("times/report.md")).unwrap();
        assert!(report.contains(if russian { "Время построения" } else { "Time of drawing" }));
        for name in ["runs.csv", "points.csv", "time.svg", "time.png"] {
            assert!(Path::new(&host.path("times")).join(name).exists(), "{name}");
        }
        check_texts(&harness);
    }
}

#[test]
fn a_measurement_is_stopped() {
    let (_host, mut harness) = open("english");
    run(&mut harness, Command::Measure(MeasureCommand::Start));
    assert!(harness.state().is_measuring());
    run(&mut harness, Command::Measure(MeasureCommand::Stop));
    wait_until(&mut harness, "the end", |studio| !studio.is_measuring());
    harness.run_steps(3);
    let said = said(&harness, "measure-nothing-measured");
    assert!(harness.query_by_label(&said).is_some());
}
