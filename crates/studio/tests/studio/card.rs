//! The picture drawn by the card of the window: by Mesa's lavapipe, where there is no card.

use std::io::Write as _;
use std::panic::catch_unwind;

use catoptric_editor::Label;
use catoptric_studio::host::Host as _;
use catoptric_studio::{CameraCommand, DisplayCommand, StartDocument, Studio};
use eframe::egui_wgpu::{RenderState, RendererOptions};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_kittest::{Harness, HarnessBuilder};

use crate::kit::{TestHost, wait_until};

fn studio(state: RenderState, settings: &str) -> Harness<'static, Studio> {
    studio_on(TestHost::new(), state, settings)
}

fn studio_on(host: TestHost, state: RenderState, settings: &str) -> Harness<'static, Studio> {
    std::fs::write(host.settings_path().unwrap(), settings).unwrap();
    let start = StartDocument::Example("whitted".to_owned());
    let builder: HarnessBuilder<Studio> = Harness::builder();
    let window = state.clone();
    builder.with_size([1000.0, 700.0]).renderer(WgpuTestRenderer::from_render_state(state)).build_eframe(
        move |creation| {
            let mut studio = Studio::new(&creation.egui_ctx, &start, Box::new(host)).unwrap();
            studio.use_window_card(&window);
            studio
        },
    )
}

/// What draws the window, if anything can.
fn state(test: &str) -> Option<RenderState> {
    let options = RendererOptions { dithering: false, ..RendererOptions::default() };
    // It panics where nothing can draw.
    let state = catch_unwind(|| create_render_state(default_wgpu_setup(), options)).ok();
    if state.is_none() {
        let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {test}: no graphics driver");
    }
    state
}

fn wait_for_picture(harness: &mut Harness<'static, Studio>, backend: &'static str) {
    wait_until(harness, backend, |studio| {
        let status = studio.live().status();
        let is_whole = studio.live().latest().is_some_and(|frame| frame.is_full() && frame.samples == 1);
        status.is_idle && status.backend == backend && is_whole
    });
    harness.run_steps(6);
}

const ASKED: &str =
    r#"{"language": "english", "is_hint_dismissed": true, "viewport_samples": 1, "uses_card": true}"#;

#[test]
fn the_card_of_the_window_draws_the_same_picture() {
    let Some(state) = state("the_card_of_the_window_draws_the_same_picture") else { return };
    let mut harness = studio(state, ASKED);
    wait_for_picture(&mut harness, "GPU");
    let name = harness.state().card_name().unwrap().to_owned();
    let short = name.split(" (").next().unwrap();
    assert!(harness.query_by_label(&format!("GPU · {short}")).is_some(), "{name}");
    let on_card = harness.render().unwrap();
    harness.state_mut().run(DisplayCommand::ToggleCard);
    harness.run_steps(2);
    wait_for_picture(&mut harness, "CPU");
    assert!(harness.state().live().latest().unwrap().card.is_none());
    let on_processor = harness.render().unwrap();
    // The status bar tells who draws.
    let bytes = 4 * 1000 * (700 - 30);
    let pairs = on_card.as_raw().iter().zip(on_processor.as_raw()).take(bytes);
    let off = pairs.filter(|(one, other)| one.abs_diff(**other) > 2).count();
    assert!(off < bytes / 1000, "{off} bytes differ");
    harness.state_mut().run(DisplayCommand::ToggleCard);
    harness.run_steps(2);
    wait_for_picture(&mut harness, "GPU");
}

#[test]
fn a_software_driver_draws_only_when_asked() {
    let Some(state) = state("a_software_driver_draws_only_when_asked") else { return };
    let is_software = state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
    let text = ASKED.replace(r#", "uses_card": true"#, "");
    let mut harness = studio(state, &text);
    wait_for_picture(&mut harness, if is_software { "CPU" } else { "GPU" });
}

#[test]
fn a_card_that_is_lost_is_told_and_the_processor_draws() {
    let Some(state) = state("a_card_that_is_lost_is_told_and_the_processor_draws") else { return };
    let device = state.device.clone();
    let mut harness = studio(state, ASKED);
    wait_for_picture(&mut harness, "GPU");
    device.destroy();
    // The loss is told when the device has done its work; until then, its things are just invalid.
    let _ = device.poll(wgpu::PollType::wait_indefinitely());
    harness.state_mut().run(CameraCommand::ToggleProjection);
    wait_until(&mut harness, "the loss", |studio| studio.live().status().card_lost.is_some());
    // A notice comes with the next frame, and fades in.
    harness.run_steps(4);
    let told = "The processor draws from now on instead of the graphics card: the card is lost.";
    let why = &harness.state().live().status().card_lost;
    assert!(harness.query_by_label_contains(told).is_some(), "{why:?}");
    wait_for_picture(&mut harness, "CPU");
}

#[test]
fn a_window_that_is_lost_is_told_in_every_language_and_work_is_safe_before() {
    let test = "a_window_that_is_lost_is_told_in_every_language_and_work_is_safe_before";
    for (language, told) in [("english", "the window was opened anew"), ("russian", "окно открыто заново")]
    {
        let Some(state) = state(test) else { return };
        let host = TestHost::new();
        let kept = host.recovery_folder().unwrap();
        let mut harness = studio_on(host, state, &ASKED.replace("english", language));
        wait_for_picture(&mut harness, "GPU");
        let context = harness.ctx.clone();
        let studio = harness.state_mut();
        let label = Label::new("edit-rename", "made safe");
        studio.editor_mut().change_body(0, label, |body| "made safe".clone_into(&mut body.name)).unwrap();
        studio.outlive_window(&context);
        let files = std::fs::read_dir(kept).unwrap().map(|entry| entry.unwrap().path());
        let texts: Vec<String> = files.filter_map(|path| std::fs::read_to_string(path).ok()).collect();
        assert!(texts.iter().any(|text| text.contains("made safe")), "{texts:?}");
        assert!(studio.card_name().is_none(), "the card is gone with its window");
        harness.run_steps(2);
        assert!(harness.query_by_label_contains(told).is_some());
        wait_for_picture(&mut harness, "CPU");
        assert!(harness.state().live().latest().unwrap().card.is_none());
        harness.state_mut().editor_mut().undo();
        assert_ne!(harness.state().editor().scene().bodies.get(0).unwrap().name, "made safe");
    }
}
