//! What a panel or a dialog is for is in sight, in the usual window and in the smallest one.

use std::path::{Path, PathBuf};

use catoptric_picture::{Picture, write_exr};
use catoptric_studio::host::Host as _;
use catoptric_studio::{Command, CompareCommand, Pane, StartDocument, Studio};
use egui::accesskit::Role;
use egui::{Event, PointerButton, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

type Window = Harness<'static, Studio>;

/// The window that is usual on a small screen, and the smallest one.
const SIZES: [[f32; 2]; 2] = [[1280.0, 720.0], [800.0, 500.0]];

fn open(host: &TestHost, language: &str) -> Window {
    let text = format!(r#"{{"language": "{language}", "is_hint_dismissed": true, "viewport_samples": 1}}"#);
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    studio_with(host.clone(), StartDocument::Example("four-bodies".to_owned()))
}

fn run(window: &mut Window, command: &str) {
    window.state_mut().run(Command::from_name(command).unwrap().clone());
    window.run_steps(4);
}

/// The buttons and fields with this name.
fn places(window: &Window, name: &str) -> Vec<Rect> {
    let is_act = |role| matches!(role, Role::Button | Role::TextInput | Role::SearchInput);
    window
        .query_all_by_label(name)
        .filter(|node| is_act(node.accesskit_node().role()))
        .map(|node| node.rect())
        .collect()
}

/// What of the acts, by their messages, is not whole within the panel, or within the window, at any size.
fn hidden(window: &mut Window, pane: Option<Pane>, acts: &[&str]) -> Vec<String> {
    let mut hidden = Vec::new();
    for [width, height] in SIZES {
        window.set_size(vec2(width, height));
        window.run_steps(4);
        let screen = window.ctx.content_rect();
        let panel = pane.map_or(screen, |pane| window.state().pane_rect(pane).unwrap().intersect(screen));
        for act in acts {
            let name = window.state().texts().get(act).to_owned();
            let places = places(window, &name);
            if !places.iter().any(|place| panel.expand(0.5).contains_rect(*place)) {
                hidden.push(format!("{pane:?} {name:?} at {width}×{height}: {places:?} in {panel}"));
            }
        }
    }
    hidden
}

#[test]
fn the_act_of_each_panel_is_in_sight() {
    let mut all = Vec::new();
    for language in ["english", "russian"] {
        let host = TestHost::new();
        let window = &mut open(&host, language);
        all.extend(hidden(window, Some(Pane::Outliner), &["outliner-filter", "outliner-add-body"]));
        for (pane, command, acts) in [
            (Pane::Audit, "window.pane.audit", ["audit-begin"].as_slice()),
            (Pane::Compare, "window.pane.compare", &["command-compare-save"]),
            (Pane::Materials, "window.pane.materials", &["materials-filter"]),
            (
                Pane::Measure,
                "window.pane.measure",
                &["command-measure-start", "command-measure-copy", "command-measure-save"],
            ),
        ] {
            run(window, command);
            all.extend(hidden(window, Some(pane), acts));
        }
        // A second number to vary and questions to the pictures make the form longer.
        run(window, "measure.vary");
        all.extend(hidden(window, Some(Pane::Measure), &["command-measure-start"]));
        window.state_mut().run(catoptric_studio::MeasureCommand::Vary(Some("camera.fov".parse().unwrap())));
        run(window, "measure.start");
        assert!(window.state().is_measuring());
        all.extend(hidden(window, Some(Pane::Measure), &["command-measure-stop"]));
        run(window, "measure.stop");
        wait_until(window, "the end of the measurement", |studio| !studio.is_measuring());
        all.extend(pixel(window));
        all.extend(file(language));
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

/// The steps of a pixel that is looked into.
fn pixel(window: &mut Window) -> Vec<String> {
    run(window, "audit.tool");
    let center = window.state().viewport_rect().unwrap().center();
    window.hover_at(center);
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, egui::Modifiers::NONE);
        window.event(Event::PointerButton { pos: center, button, pressed, modifiers });
    }
    wait_until(window, "the rays of the pixel", |studio| studio.audit_rays().is_some());
    let hidden = hidden(window, Some(Pane::Audit), &["command-audit-next", "command-audit-play"]);
    run(window, "audit.release");
    run(window, "audit.tool");
    hidden
}

/// The check of a picture file.
fn file(language: &str) -> Vec<String> {
    let host = TestHost::new();
    let window = &mut open(&host, language);
    let picture = Picture::from_fn(160, 90, |x, _| [x as f32 / 160.0; 3]).unwrap();
    let path: PathBuf = host.path("own.exr");
    write_exr(Path::new(&path), &picture).unwrap();
    run(window, "window.pane.compare");
    host.answer(Some(path));
    window.state_mut().run(CompareCommand::FileB);
    window.run_steps(4);
    wait_until(window, "the comparison", Studio::is_compared);
    hidden(window, Some(Pane::Compare), &["compare-check", "command-compare-save"])
}

#[test]
fn the_act_of_each_dialog_is_in_sight() {
    let mut all = Vec::new();
    for language in ["english", "russian"] {
        let host = TestHost::new();
        let window = &mut open(&host, language);
        for (command, acts) in [
            ("picture.render", ["render-start", "cancel"].as_slice()),
            ("file.examples", &["open", "cancel"]),
            ("help.about", &["close"]),
        ] {
            run(window, command);
            all.extend(hidden(window, None, acts));
            window.key_press(egui::Key::Escape);
            window.run_steps(3);
        }
        // Magnified, even the smallest window leaves the buttons in sight.
        window.ctx.set_zoom_factor(1.5);
        run(window, "picture.render");
        window.set_size(vec2(800.0, 500.0) / 1.5);
        window.run_steps(4);
        let start = window.state().texts().get("render-start").to_owned();
        let screen = window.ctx.content_rect();
        let places = places(window, &start);
        if !places.iter().all(|place| screen.contains_rect(*place)) {
            all.push(format!("{start} magnified: {places:?} in {screen}"));
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}
