//! Rendering pictures, saving and copying them.

use std::path::Path;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use catoptric_picture::{BitDepth, Development, Picture, ToneCurve, encode_exr, encode_png, read};
use catoptric_scene::Scene;
use catoptric_studio::host::PictureClipboard;
use catoptric_studio::{
    CameraCommand, Language, PictureCommand, StartDocument, Studio, WindowCommand, ZoomStep,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use egui::accesskit::Role;
use egui::{OutputCommand, ViewportCommand};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio, studio_with, wait_until};

type Hands = Harness<'static, Studio>;

fn on(host: &TestHost) -> Hands {
    studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()))
}

fn open_dialog(harness: &mut Hands) {
    harness.state_mut().run(PictureCommand::Render);
    settle(harness);
    assert!(is_seen(harness, "Render a picture"));
}

/// Whether something has this in its label.
fn is_seen(harness: &Hands, label: &str) -> bool {
    harness.query_all_by_label_contains(label).next().is_some()
}

/// Some frames: a new window is first measured, then shown.
fn settle(harness: &mut Hands) {
    harness.run_steps(4);
}

/// Steps until something with this label can be seen.
fn wait_for(harness: &mut Hands, label: &str) {
    let deadline = Instant::now() + Duration::from_secs(300);
    while !is_seen(harness, label) {
        assert!(Instant::now() < deadline, "waited in vain: {label}");
        harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    settle(harness);
}

fn press(harness: &mut Hands, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    settle(harness);
}

/// Types a number into a field.
fn enter(harness: &mut Hands, label: &str, number: f64) {
    harness.get_by_role_and_label(Role::SpinButton, label).set_value_accesskit(number);
    settle(harness);
}

fn choose(harness: &mut Hands, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

/// Opens a list to choose from.
fn open_list(harness: &mut Hands, label: &str) {
    harness.get_by_role_and_label(Role::ComboBox, label).click();
    settle(harness);
}

/// Picks one of several choices side by side.
fn pick(harness: &mut Hands, label: &str) {
    harness.get_by_role_and_label(Role::RadioButton, label).click();
    settle(harness);
}

/// Opens the dialog and starts a small picture.
fn start_small(harness: &mut Hands) {
    open_dialog(harness);
    enter(harness, "Width", 96.0);
    enter(harness, "Samples", 4.0);
    press(harness, "Render");
}

/// What the tracer makes of it.
fn truth(scene: &Scene, [width, height]: [u32; 2], samples: u32, generations: Option<u32>) -> Picture {
    let mut render_scene = RenderScene::build(scene).unwrap();
    if let Some(generations) = generations {
        render_scene = render_scene.with_generations(generations);
    }
    render(&render_scene, RenderSettings { width, height, samples }, &RenderControl::default())
        .unwrap()
        .picture
}

fn save_to(harness: &mut Hands, host: &TestHost, path: &Path) {
    host.answer(Some(path.to_owned()));
    press(harness, "Save…");
    wait_for(harness, &format!("Saved: {}", path.file_name().unwrap().display()));
}

fn close_requested(harness: &mut Hands) {
    let viewport = harness.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    viewport.events.push(egui::ViewportEvent::Close);
    harness.step();
}

fn viewport_commands(harness: &Hands) -> Vec<ViewportCommand> {
    let outputs = &harness.output().viewport_output;
    outputs.values().flat_map(|output| output.commands.clone()).collect()
}

#[test]
fn a_saved_picture_is_the_traced_one() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    let path = host.path("out.png");
    save_to(&mut harness, &host, &path);
    let question = host.questions.lock().unwrap().last().unwrap().clone();
    assert_eq!((question.name.as_str(), question.is_saving), ("four-bodies.png", true));
    let picture = truth(harness.state().editor().scene(), [96, 54], 4, None);
    let developed = Development::default().develop(&picture, BitDepth::Eight).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), encode_png(&developed).unwrap());
    assert_eq!(read(&path).unwrap().width(), 96);
    // It is saved: nothing is asked.
    press(&mut harness, "Close the picture");
    assert!(!is_seen(&harness, "Picture 96 × 54"));
    assert!(!is_seen(&harness, "Close without saving?"));
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn exr_keeps_every_bit_and_deep_png_every_step() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    open_dialog(&mut harness);
    open_list(&mut harness, "File");
    choose(&mut harness, "EXR");
    assert!(is_seen(&harness, "This kind of file keeps the linear light"));
    enter(&mut harness, "Width", 64.0);
    pick(&mut harness, "Samples: 1");
    pick(&mut harness, "Generations: Own");
    enter(&mut harness, "Generations: Own", 2.0);
    press(&mut harness, "Render");
    wait_for(&mut harness, "Picture 64 × 36");
    let scene = harness.state().editor().scene().clone();
    let picture = truth(&scene, [64, 36], 1, Some(2));
    assert!(picture != truth(&scene, [64, 36], 1, None), "two generations look different");

    let exr = host.path("out.exr");
    save_to(&mut harness, &host, &exr);
    assert_eq!(host.questions.lock().unwrap().last().unwrap().name, "four-bodies.exr");
    assert_eq!(std::fs::read(&exr).unwrap(), encode_exr(&picture).unwrap());
    assert!(read(&exr).unwrap() == picture);

    // Developed again, without tracing.
    harness.get_by_role_and_label(Role::Slider, "Exposure").set_value_accesskit(-1.5);
    settle(&mut harness);
    open_list(&mut harness, "Tone curve");
    choose(&mut harness, "Filmic");
    open_list(&mut harness, "File");
    choose(&mut harness, "PNG, 16 bit");
    let png = host.path("deep.png");
    save_to(&mut harness, &host, &png);
    let development = Development { exposure_stops: -1.5, tone_curve: ToneCurve::Filmic };
    let developed = development.develop(&picture, BitDepth::Sixteen).unwrap();
    assert_eq!(std::fs::read(&png).unwrap(), encode_png(&developed).unwrap());
    let remembered = &harness.state().settings().render;
    assert_eq!((remembered.samples, remembered.generations), (1, Some(2)));
    assert_eq!(remembered.folder.as_deref(), exr.parent());
}

#[test]
fn edits_and_the_free_view_do_not_disturb_a_render() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    harness.state_mut().run(CameraCommand::LookAlong(catoptric_editor::navigate::ViewSide::Left));
    harness.run();
    open_dialog(&mut harness);
    assert!(is_seen(&harness, "through the scene’s camera"));
    enter(&mut harness, "Width", 320.0);
    enter(&mut harness, "Samples", 16.0);
    let before = harness.state().editor().scene().clone();
    press(&mut harness, "Render");
    assert!(harness.state().is_rendering());
    let label = catoptric_editor::Label::new("edit-place", "");
    let editor = harness.state_mut().editor_mut();
    editor.change_body(0, label, |body| body.hidden = true).unwrap();
    wait_for(&mut harness, "Picture 320 × 180");
    assert!(!harness.state().is_rendering());
    assert!(**harness.state().editor().scene() != *before);
    let path = host.path("out.exr");
    save_to(&mut harness, &host, &path);
    assert!(read(&path).unwrap() == truth(&before, [320, 180], 16, None));
}

#[test]
fn a_cancelled_render_leaves_nothing() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    open_dialog(&mut harness);
    pick(&mut harness, "Samples: 256");
    press(&mut harness, "Render");
    wait_for(&mut harness, "Rendering 1920 × 1080");
    assert!(is_seen(&harness, "passed"));
    press(&mut harness, "Cancel the render");
    assert!(!harness.state().is_rendering());
    assert!(!is_seen(&harness, "Rendering 1920 × 1080"));
    assert!(!is_seen(&harness, "Picture 1920 × 1080"));
    assert!(host.questions.lock().unwrap().is_empty());
    // The viewport refines again.
    wait_until(&mut harness, "the viewport is refined", |studio| studio.live().status().is_idle);
}

#[test]
fn a_second_render_replaces_the_first_and_a_third_joins_the_finished() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    open_dialog(&mut harness);
    pick(&mut harness, "Samples: 256");
    press(&mut harness, "Render");
    open_dialog(&mut harness);
    assert!(is_seen(&harness, "it will be given up"));
    enter(&mut harness, "Width", 96.0);
    pick(&mut harness, "Samples: 1");
    press(&mut harness, "Give up and render");
    wait_for(&mut harness, "Picture 96 × 54");
    open_dialog(&mut harness);
    enter(&mut harness, "Height", 27.0);
    press(&mut harness, "Render");
    wait_for(&mut harness, "Picture 48 × 27");
    assert!(is_seen(&harness, "Picture 96 × 54"));
    assert!(!is_seen(&harness, "Picture 1920 × 1080"));
}

#[test]
fn proportions_are_kept_or_not() {
    let mut harness = studio();
    harness.run();
    open_dialog(&mut harness);
    enter(&mut harness, "Width", 960.0);
    let height = |harness: &Hands| harness.get_by_role_and_label(Role::SpinButton, "Height").value();
    assert_eq!(height(&harness).as_deref(), Some("540"));
    choose(&mut harness, "Keep proportions");
    enter(&mut harness, "Width", 500.0);
    assert_eq!(height(&harness).as_deref(), Some("540"));
    open_list(&mut harness, "Size");
    choose(&mut harness, "Square: 1080 × 1080");
    assert_eq!(height(&harness).as_deref(), Some("1080"));
    enter(&mut harness, "Height", 300.0);
    let width = harness.get_by_role_and_label(Role::SpinButton, "Width").value();
    assert_eq!(width.as_deref(), Some("1080"));
}

#[test]
fn impossible_sizes_are_refused() {
    let mut harness = studio();
    harness.run();
    open_dialog(&mut harness);
    choose(&mut harness, "Keep proportions");
    enter(&mut harness, "Width", 20_000.0);
    enter(&mut harness, "Height", 20_000.0);
    assert!(is_seen(&harness, "268 million pixels are possible"));
    assert!(harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
    press(&mut harness, "Render");
    assert!(!harness.state().is_rendering());
    harness.key_press(egui::Key::Enter);
    settle(&mut harness);
    assert!(!harness.state().is_rendering());
    enter(&mut harness, "Height", 1.0);
    assert!(!harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
}

#[test]
fn a_picture_that_memory_cannot_hold_is_refused() {
    let host = TestHost::new();
    *host.free_memory.lock().unwrap() = Some(10_000_000);
    let mut harness = on(&host);
    harness.run();
    open_dialog(&mut harness);
    assert!(is_seen(&harness, "only 10 MB are free"));
    assert!(harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
    open_list(&mut harness, "Size");
    choose(&mut harness, "HD: 1280 × 720");
    assert!(harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
    enter(&mut harness, "Width", 640.0);
    assert!(!harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
}

#[test]
fn an_unsaved_picture_is_not_dropped_without_asking() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    press(&mut harness, "Close the picture");
    harness.step();
    assert!(is_seen(&harness, "Close without saving?"));
    press(&mut harness, "Cancel");
    assert!(is_seen(&harness, "Picture 96 × 54"));
    close_requested(&mut harness);
    assert!(viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
    settle(&mut harness);
    press(&mut harness, "Stay");
    press(&mut harness, "Close the picture");
    harness.step();
    press(&mut harness, "Don’t save");
    assert!(!is_seen(&harness, "Picture 96 × 54"));
    close_requested(&mut harness);
    assert!(!viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
}

#[test]
fn a_picture_can_be_closed_however_much_is_magnified() {
    for language in Language::ALL {
        let host = TestHost::new();
        let mut harness = on(&host);
        harness.run();
        start_small(&mut harness);
        wait_for(&mut harness, "Picture 96 × 54");
        harness.state_mut().run(WindowCommand::Language(language));
        for _ in 0..12 {
            harness.state_mut().run(WindowCommand::Zoom(ZoomStep::In));
            harness.step();
        }
        settle(&mut harness);
        let label = if language == Language::English {
            "Close the picture"
        } else {
            "Закрыть изображение"
        };
        let button = harness.get_by_role_and_label(Role::Button, label).rect();
        let whole = harness.ctx.content_rect();
        assert!(whole.width() < 540.0 && whole.contains_rect(button), "{button} in {whole}");
    }
}

#[test]
fn leaving_while_a_picture_is_rendered_asks() {
    let mut harness = studio();
    harness.run();
    open_dialog(&mut harness);
    pick(&mut harness, "Samples: 256");
    press(&mut harness, "Render");
    close_requested(&mut harness);
    assert!(viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
    settle(&mut harness);
    assert!(is_seen(&harness, "A picture is still being rendered"));
    press(&mut harness, "Leave");
    close_requested(&mut harness);
    assert!(!viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
}

#[test]
fn a_file_is_replaced_only_when_that_is_agreed() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    let path = host.path("mine.png");
    std::fs::write(&path, "precious").unwrap();
    // The system has asked about `mine`, not about `mine.png`.
    host.answer(Some(host.path("mine")));
    press(&mut harness, "Save…");
    wait_for(&mut harness, "Replace “mine.png”?");
    press(&mut harness, "Cancel");
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    host.answer(Some(host.path("mine")));
    press(&mut harness, "Save…");
    wait_for(&mut harness, "Replace “mine.png”?");
    press(&mut harness, "Replace");
    wait_for(&mut harness, "Saved: mine.png");
    assert_eq!(read(&path).unwrap().width(), 96);
}

#[test]
fn a_file_that_cannot_be_written_is_told() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    host.answer(Some(host.path("no/such/folder/out.png")));
    press(&mut harness, "Save…");
    wait_for(&mut harness, "The picture is not saved");
    assert!(is_seen(&harness, "no/such/folder"));
    press(&mut harness, "OK");
    // Nothing is lost.
    assert!(is_seen(&harness, "Picture 96 × 54"));
}

#[test]
fn a_finished_picture_goes_to_the_clipboard() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    harness.get_by_role_and_label(Role::Button, "Copy").click();
    let image = wait_for_image(&mut harness);
    let picture = truth(harness.state().editor().scene(), [96, 54], 4, None);
    let mut codes = vec![[0; 4]; 96 * 54];
    Development::default().develop_rgba8(picture.pixels(), &mut codes);
    assert_eq!(image.as_raw(), codes.as_flattened());
    settle(&mut harness);
    assert!(is_seen(&harness, "In the clipboard"));
    // The clipboard may go with the studio.
    close_requested(&mut harness);
    assert!(viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
    settle(&mut harness);
    press(&mut harness, "Stay");
    // It is kept: nothing is asked.
    press(&mut harness, "Close the picture");
    assert!(!is_seen(&harness, "Picture 96 × 54"));
    close_requested(&mut harness);
    assert!(!viewport_commands(&harness).contains(&ViewportCommand::CancelClose));
}

#[test]
fn pictures_go_to_the_clipboard_one_after_another() {
    static COPIED: Mutex<Vec<[usize; 2]>> = Mutex::new(Vec::new());
    let clipboard: PictureClipboard = |size, _| {
        COPIED.lock().unwrap().push(size);
        Ok(())
    };
    let mut host = TestHost::new();
    host.clipboard = Some(clipboard);
    let mut harness = on(&host);
    harness.run();
    start_small(&mut harness);
    wait_for(&mut harness, "Picture 96 × 54");
    wait_until(&mut harness, "the viewport is refined", |studio| studio.live().status().is_idle);
    // The clipboard is busy with the first for a while.
    let busy = COPIED.lock().unwrap();
    press(&mut harness, "Copy");
    harness.state_mut().run(PictureCommand::Copy);
    settle(&mut harness);
    assert!(harness.get_by_role_and_label(Role::Button, "Copy").accesskit_node().is_disabled());
    drop(busy);
    wait_for(&mut harness, "In the clipboard");
    let deadline = Instant::now() + Duration::from_secs(300);
    while COPIED.lock().unwrap().len() < 2 {
        assert!(Instant::now() < deadline, "the viewport is not copied");
        harness.step();
    }
    assert_eq!(COPIED.lock().unwrap()[0], [96, 54]);
}

#[test]
fn the_refined_viewport_goes_to_the_clipboard() {
    let host = TestHost::new();
    let settings = r#"{"language": "english", "is_hint_dismissed": true, "viewport_samples": 3}"#;
    std::fs::write(host.path("settings.json"), settings).unwrap();
    let mut harness = on(&host);
    harness.run();
    harness.state_mut().run(PictureCommand::Copy);
    let image = wait_for_image(&mut harness);
    let frame = harness.state().live().latest().unwrap();
    assert_eq!(image.size, frame.view_size.map(|side| side as usize));
    assert_eq!(frame.samples, 3);
    assert_eq!(image.as_raw(), frame.pixels.as_slice());
}

fn wait_for_image(harness: &mut Hands) -> egui::ColorImage {
    let deadline = Instant::now() + Duration::from_secs(300);
    loop {
        harness.step();
        let commands = &harness.output().platform_output.commands;
        let image = commands.iter().find_map(|command| match command {
            OutputCommand::CopyImage(image) => Some(image.clone()),
            _ => None,
        });
        if let Some(image) = image {
            return image;
        }
        assert!(Instant::now() < deadline, "waited in vain for the clipboard");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_render_that_ends_behind_other_windows_asks_for_attention() {
    let mut harness = studio();
    harness.run();
    open_dialog(&mut harness);
    enter(&mut harness, "Width", 640.0);
    // So many that it is not done within the frames of the click, whose commands nobody sees.
    enter(&mut harness, "Samples", 64.0);
    press(&mut harness, "Render");
    harness.input_mut().focused = false;
    let deadline = Instant::now() + Duration::from_secs(300);
    let is_attention =
        |command: &ViewportCommand| matches!(command, ViewportCommand::RequestUserAttention(_));
    while !viewport_commands(&harness).iter().any(is_attention) {
        assert!(Instant::now() < deadline);
        harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    settle(&mut harness);
    assert!(is_seen(&harness, "Picture 640 × 360"));
}

#[test]
fn everything_is_said_in_russian_too() {
    let host = TestHost::new();
    let mut harness = on(&host);
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    harness.run();
    harness.state_mut().run(PictureCommand::Render);
    settle(&mut harness);
    for label in ["Рендер изображения", "Отсчётов на пиксель: 16", "Файл", "Тональная кривая"]
    {
        assert!(harness.query_all_by_label(label).next().is_some(), "{label}");
    }
    enter(&mut harness, "Ширина", 96.0);
    press(&mut harness, "Начать рендер");
    wait_for(&mut harness, "Изображение 96 × 54");
    press(&mut harness, "Закрыть изображение");
    harness.step();
    assert!(is_seen(&harness, "Закрыть без сохранения?"));
    harness.run();
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

/// Fields outside of the inspector read the same texts.
#[test]
fn sizes_are_computed_or_refused_whole() {
    let mut harness = studio();
    open_dialog(&mut harness);
    let value = |harness: &Hands| harness.get_by_role_and_label(Role::SpinButton, "Width").value();
    for (text, kept) in [("640*2", "1280"), ("2^10", "1024"), ("640x480", "640x480")] {
        harness.get_by_role_and_label(Role::SpinButton, "Width").click();
        harness.run_steps(3);
        harness.event(egui::Event::Text(text.to_owned()));
        harness.run_steps(2);
        harness.key_press(egui::Key::Tab);
        harness.run_steps(3);
        assert_eq!(value(&harness).as_deref(), Some(kept), "{text}");
    }
    assert!(harness.query_by_label_contains("“x” (character 4)").is_some(), "it says why");
    press(&mut harness, "Render");
    assert!(!harness.state().is_rendering(), "the size from before is not what was asked for");
    // Another number takes the place of the text.
    open_list(&mut harness, "Size");
    choose(&mut harness, "Full HD: 1920 × 1080");
    assert!(harness.query_by_label_contains("“x” (character 4)").is_none());
    assert!(!harness.get_by_role_and_label(Role::Button, "Render").accesskit_node().is_disabled());
}
