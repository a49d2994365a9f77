//! How the window is drawn where there is no graphics card.

use std::io::Write as _;
use std::panic::catch_unwind;

use catoptric_scene::ScenePart;
use catoptric_studio::host::Host as _;
use catoptric_studio::{DisplayCommand, HelpCommand, StartDocument, Studio, Theme, WindowCommand};
use eframe::egui_wgpu::{RenderState, RendererOptions};
use egui::{Color32, FontId};
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_kittest::{Harness, HarnessBuilder};

use crate::kit::{TestHost, wait_until};

#[derive(Clone, Copy, PartialEq)]
enum By {
    Egui,
    Software,
}

/// What a software driver draws with, if there is one.
fn state() -> Option<RenderState> {
    let options = RendererOptions { dithering: false, ..RendererOptions::default() };
    // It panics where nothing can draw.
    let state = catch_unwind(|| create_render_state(default_wgpu_setup(), options)).ok()?;
    (state.adapter.get_info().device_type == wgpu::DeviceType::Cpu).then_some(state)
}

fn studio(by: By, state: RenderState) -> Harness<'static, Studio> {
    let host = TestHost::new();
    let text = r#"{"language": "russian", "is_hint_dismissed": true, "viewport_samples": 1}"#;
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    let start = StartDocument::Example("four-bodies".to_owned());
    let builder: HarnessBuilder<Studio> = Harness::builder();
    builder.with_size([1000.0, 700.0]).renderer(WgpuTestRenderer::from_render_state(state)).build_eframe(
        move |creation| {
            if by == By::Software {
                catoptric_studio::prepare_window(creation);
            }
            Studio::new(&creation.egui_ctx, &start, Box::new(host)).unwrap()
        },
    )
}

/// Puts the digits of times and rates, and more, into the atlas of glyphs before any of them is shown. Slanted glyphs
/// are sampled between its texels, so that they show traces of their neighbors there, which depend on who came first.
fn fill_atlas(harness: &Harness<'static, Studio>) {
    let all: String = (' '..='~').chain('А'..='я').collect();
    let fonts: Vec<FontId> = harness.ctx.global_style().text_styles.values().cloned().collect();
    harness.ctx.fonts_mut(|view| {
        for font in fonts {
            view.layout_no_wrap(all.clone(), font, Color32::WHITE);
        }
    });
}

#[test]
fn a_window_drawn_in_parts_looks_as_egui_draws_it() {
    let (Some(one), Some(other)) = (state(), state()) else {
        // Not captured, as the output of tests is.
        let _ =
            writeln!(std::io::stderr().lock(), "SKIPPED: no software driver for graphics (Mesa's lavapipe)");
        return;
    };
    let mut theirs = studio(By::Egui, one);
    let mut ours = studio(By::Software, other);
    fill_atlas(&theirs);
    fill_atlas(&ours);
    type Step = fn(&mut Studio);
    let steps: [(&str, Step); 6] = [
        ("the camera", |studio| studio.editor_mut().select_parts([ScenePart::Camera])),
        ("a body selected", |studio| studio.editor_mut().select_parts([ScenePart::Body(1)])),
        ("another one", |studio| studio.editor_mut().select_parts([ScenePart::Body(3)])),
        ("a dialog over it", |studio| studio.run(HelpCommand::Terms)),
        ("other colors", |studio| studio.run(WindowCommand::Theme(Theme::Light))),
        ("no grid", |studio| studio.run(DisplayCommand::ToggleGrid)),
    ];
    for (what, step) in steps {
        let [expected, found] = [&mut theirs, &mut ours].map(|harness| {
            step(harness.state_mut());
            harness.run_steps(2);
            wait_until(harness, "the picture", |studio| studio.live().status().is_idle);
            harness.run_steps(12);
            harness.render().unwrap()
        });
        assert_eq!(ours.output().shapes.len(), 1, "{what}: drawn by egui after all");
        assert_eq!(expected.dimensions(), found.dimensions());
        // The status bar tells the time that each picture took.
        let bytes = 4 * 1000 * (700 - 30);
        let pairs = expected.as_raw().iter().zip(found.as_raw()).take(bytes);
        assert_eq!(pairs.filter(|(one, other)| one.abs_diff(**other) > 2).count(), 0, "{what}");
    }
}
