//! Links to a scene as it is seen.

use std::sync::{Arc, Mutex};

use catoptric_editor::Action;
use catoptric_scene::ScenePart;
use catoptric_studio::host::Host as _;
use catoptric_studio::{CameraCommand, DisplayCommand, FileCommand, StartDocument};
use catoptric_tracer::raster::MethodKind;
use egui_kittest::kittest::Queryable as _;

use crate::kit::{TestHost, item_at, studio_with, wait_until};

fn host_with_links() -> (TestHost, Arc<Mutex<Vec<String>>>) {
    let links = Arc::<Mutex<Vec<String>>>::default();
    let mut host = TestHost::new();
    host.links = Some(Arc::clone(&links));
    (host, links)
}

#[test]
fn a_link_opens_what_was_seen_byte_by_byte() {
    let (host, links) = host_with_links();
    let mut harness = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    harness.run_steps(3);
    let studio = harness.state_mut();
    studio.editor_mut().apply(Action::SelectAll).unwrap();
    studio.editor_mut().apply(Action::MoveDown).ok();
    let ball = item_at(studio, ScenePart::Body(1));
    studio.editor_mut().select(ball);
    studio.run(CameraCommand::ToggleFreeView);
    studio.run(DisplayCommand::Method(MethodKind::Gouraud));
    harness.run_steps(3);
    harness.state_mut().run(FileCommand::CopyLink);
    harness.run_steps(3);
    harness.get_by_label_contains("The link is in the clipboard");
    let view = links.lock().unwrap().pop().unwrap();
    let (host, links) = host_with_links();
    let mut other = studio_with(host, StartDocument::Link(view.clone()));
    other.run_steps(3);
    let (one, two) = (harness.state(), other.state());
    assert_eq!(one.editor().writing().text(), two.editor().writing().text());
    assert_eq!(two.editor().primary_part(), Some(ScenePart::Body(1)));
    assert_eq!(one.view_camera(), two.view_camera());
    assert_eq!(one.settings().methods, two.settings().methods);
    assert!(two.editor().has_unsaved_work(), "no file has it");
    // A link to the same again is the same link.
    other.state_mut().run(FileCommand::CopyLink);
    other.run_steps(3);
    assert_eq!(links.lock().unwrap().pop().unwrap(), view);
}

#[test]
fn damaged_links_are_told_of_and_lose_nothing() {
    for view in ["", "{", "[1]", r#"{"title": "a"}"#, r#"{"title": "a", "scene": 1, "method": {}}"#] {
        let mut harness = studio_with(host_with_links().0, StartDocument::Link(view.to_owned()));
        harness.run_steps(3);
        harness.get_by_label_contains("The link is damaged");
        wait_until(&mut harness, "the first example", |studio| !studio.editor().scene().bodies.is_empty());
    }
}

#[test]
fn a_scene_with_errors_comes_as_far_as_it_can_be_read() {
    let view = |scene: &str| {
        let method = serde_json::to_value(catoptric_studio::Settings::default().methods).unwrap();
        serde_json::json!({ "title": "a", "scene": scene, "method": method, "selected": [{ "body": 7 }] })
    };
    let mut harness = studio_with(host_with_links().0, StartDocument::Link(view(super::DAMAGED).to_string()));
    harness.run_steps(3);
    assert_eq!(harness.state().editor().scene().bodies.len(), 2);
    assert!(harness.state().editor().selection().is_empty());
}

#[test]
fn where_there_are_no_links_none_are_offered() {
    let mut harness = studio_with(TestHost::new(), StartDocument::Example("four-bodies".to_owned()));
    harness.run_steps(3);
    harness.get_by_label("File").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Copy link").is_none());
    harness.get_by_label_contains("Save as");
}

#[test]
fn an_example_by_its_name_is_traced_whatever_was_drawn_last() {
    let start = |document| {
        let host = TestHost::new();
        let settings = r#"{"language": "english", "is_hint_dismissed": true, "viewport_samples": 1,
            "methods": {"chosen": "ssr"}, "last": {"example": "whitted"}}"#;
        std::fs::write(host.settings_path().unwrap(), settings).unwrap();
        studio_with(host, document).state().settings().methods.kind()
    };
    assert_eq!(start(StartDocument::Example("whitted".to_owned())), MethodKind::Whitted);
    assert_eq!(start(StartDocument::Last), MethodKind::Ssr);
}

#[test]
fn a_link_brings_exposure_and_tone_curve() {
    let copied = |view: String| {
        let (host, links) = host_with_links();
        let mut harness = studio_with(host, StartDocument::Link(view));
        harness.run_steps(3);
        harness.state_mut().run(FileCommand::CopyLink);
        harness.run_steps(3);
        let text = links.lock().unwrap().pop().unwrap();
        serde_json::from_str::<serde_json::Value>(&text).unwrap()
    };
    let method = serde_json::to_value(catoptric_studio::Settings::default().methods).unwrap();
    let scene = "format = 'catoptric/1'\n";
    let plain = serde_json::json!({ "title": "a", "scene": scene, "method": method });
    assert_eq!(copied(plain.to_string()).get("development"), None);
    for (stops, tone_curve, is_known) in
        [(1.5, "filmic", true), (0.0, "linear-codes", true), (1.0, "none such", false)]
    {
        let mut view = plain.clone();
        view["development"] = serde_json::json!({ "stops": stops, "tone_curve": tone_curve });
        let found = copied(view.to_string());
        assert_eq!(found.get("development"), view.get("development").filter(|_| is_known), "{tone_curve}");
    }
}
