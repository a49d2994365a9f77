//! Scenes of other ray tracers.

use catoptric_editor::Action;
use catoptric_studio::FileCommand;
use egui_kittest::kittest::NodeT as _;

use super::*;

const MINIRT: &str = "A 0.2 255,255,255
C 0,0,5 0,0,-1 70
L 0,9,0 0.6 255,255,255
sp 0,0,0 1 255,0,0
";

/// Whether the picture is shown in linear codes, by what the menu of the exposure says.
fn has_linear_codes(harness: &mut Kit) -> bool {
    let name = harness.state().texts().get("viewport-exposure").to_owned();
    harness.get_all_by_label(&name).next().unwrap().click();
    harness.run_steps(3);
    let choice = harness.state().texts().get("viewport-tone-linear-codes").to_owned();
    let toggled = harness.get_by_label(&choice).accesskit_node().toggled();
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    toggled == Some(egui::accesskit::Toggled::True)
}

#[test]
fn a_scene_of_another_ray_tracer_is_shown_in_its_codes_and_the_next_one_is_not() {
    let host = TestHost::new();
    let (mut harness, own) = with_file(&host, SCENE);
    std::fs::write(host.path("ball.rt"), MINIRT).unwrap();
    assert!(!has_linear_codes(&mut harness));
    run(&mut harness, FileCommand::OpenFile(host.path("ball.rt")));
    wait_until(&mut harness, "the scene is open", |studio| title(studio) == "ball");
    assert!(has_linear_codes(&mut harness));
    run(&mut harness, FileCommand::OpenFile(own));
    let discard = harness.state().texts().get("do-not-save").to_owned();
    wait_for(&mut harness, &discard);
    press(&mut harness, &discard);
    wait_until(&mut harness, "the own file", |studio| title(studio) == "a.toml");
    assert!(!has_linear_codes(&mut harness));
}

#[test]
fn what_cannot_be_taken_over_exactly_is_opened_approximately_when_asked() {
    let host = TestHost::new();
    let (mut harness, _) = with_file(&host, SCENE);
    let path = host.path("torus.rt");
    std::fs::write(&path, format!("{MINIRT}to 0,0,0 1,0,0 2 1 255,0,0\n")).unwrap();
    run(&mut harness, FileCommand::OpenFile(path.clone()));
    wait_for(&mut harness, "Open approximately");
    assert!(tells(&harness, "5:1: error: there is no element `to`"));
    press(&mut harness, "Cancel");
    assert_eq!(title(harness.state()), "a.toml");
    run(&mut harness, FileCommand::OpenFile(path.clone()));
    wait_for(&mut harness, "Open approximately");
    press(&mut harness, "Open approximately");
    wait_until(&mut harness, "the scene is open", |studio| title(studio) == "torus");
    assert_eq!(harness.state().editor().scene().bodies.len(), 1);
    // What no approximation helps is refused with its errors alone.
    std::fs::write(&path, "sp\n").unwrap();
    run(&mut harness, FileCommand::OpenFile(path));
    wait_for(&mut harness, "miniRT");
    assert!(!has(&harness, "Open approximately"));
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn a_minirt_scene_is_read_otherwise_when_asked() {
    let host = TestHost::new();
    let (mut harness, own) = with_file(&host, SCENE);
    let path = host.path("ball.rt");
    std::fs::write(&path, MINIRT).unwrap();
    let radius = |studio: &Studio| studio.editor().scene().bodies[0].shape.number("radius");
    run(&mut harness, FileCommand::OpenFile(path.clone()));
    wait_until(&mut harness, "the scene is open", |studio| title(studio) == "ball");
    assert_eq!(radius(harness.state()), Some(0.5));
    run(&mut harness, FileCommand::ReadOtherwise);
    wait_for(&mut harness, "Read otherwise");
    harness.get_by_label("Radius, not diameter").click();
    press(&mut harness, "Read");
    // Nothing was changed, so nothing is asked.
    wait_until(&mut harness, "it is read again", |studio| radius(studio) == Some(1.0));
    // The program writes all its scenes so.
    std::fs::write(host.path("other.rt"), MINIRT).unwrap();
    run(&mut harness, FileCommand::OpenFile(host.path("other.rt")));
    let discard = harness.state().texts().get("do-not-save").to_owned();
    wait_for(&mut harness, &discard);
    press(&mut harness, &discard);
    wait_until(&mut harness, "another scene", |studio| title(studio) == "other");
    assert_eq!(radius(harness.state()), Some(1.0));
    // A change is not lost without a question.
    run(&mut harness, Action::SelectAll);
    run(&mut harness, Action::Delete);
    run(&mut harness, FileCommand::ReadOtherwise);
    wait_for(&mut harness, "Read otherwise");
    harness.get_by_label("Radius, not diameter").click();
    press(&mut harness, "Read");
    wait_for(&mut harness, &discard);
    press(&mut harness, &discard);
    wait_until(&mut harness, "as at first", |studio| {
        studio.editor().scene().bodies.len() == 1 && radius(studio) == Some(0.5)
    });
    run(&mut harness, FileCommand::OpenFile(own));
    wait_for(&mut harness, &discard);
    press(&mut harness, &discard);
    wait_until(&mut harness, "the own file", |studio| title(studio) == "a.toml");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}
