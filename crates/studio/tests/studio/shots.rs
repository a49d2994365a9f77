//! scratch
use crate::kit::{TestHost, studio_with};
use catoptric_editor::Item;
use catoptric_studio::host::Host as _;
use catoptric_studio::{Start, Studio};
use egui_kittest::Harness;

fn open(language: &str, theme: &str, example: &str, width: f32) -> Harness<'static, Studio> {
    let host = TestHost::new();
    let scale: f32 = std::env::var("SCALE").map_or(1.0, |scale| scale.parse().unwrap());
    let text = format!(
        r#"{{"language": "{language}", "theme": "{theme}", "is_hint_dismissed": true, "zoom": {scale}}}"#
    );
    std::fs::write(host.settings_path().unwrap(), text).unwrap();
    let mut harness = studio_with(host, Start::Example(example.to_owned()));
    harness.set_size(egui::vec2(width * 4.0, 1500.0));
    harness
}

#[test]
#[ignore]
fn shots() {
    let wanted = std::env::var("SHOTS").unwrap_or_default();
    for (language, theme, width) in [
        ("english", "dark", 320.0),
        ("russian", "light", 320.0),
        ("russian", "dark", 420.0),
        ("english", "light", 420.0),
    ] {
        for (name, example, item) in [
            ("sphere", "four-bodies", Some(Item::Body(1))),
            ("cone", "four-bodies", Some(Item::Body(4))),
            ("glass", "whitted", Some(Item::Body(1))),
            ("light", "falloff", Some(Item::Light(1))),
            ("none", "four-bodies", None),
            ("material", "four-bodies", Some(Item::Material(0))),
        ] {
            let file = format!("{name}-{language}-{theme}-{width}");
            if !file.contains(&wanted) {
                continue;
            }
            let mut harness = open(language, theme, example, width);
            harness.run_steps(3);
            let selection =
                item.map_or_else(catoptric_editor::Selection::none, catoptric_editor::Selection::one);
            harness.state_mut().editor_mut().select(selection);
            if theme == "light" {
                harness.state_mut().run(catoptric_studio::Command::Theme(catoptric_studio::Theme::Light));
            }
            harness.run_steps(6);
            let image = harness.render().unwrap();
            image.save(format!("/tmp/insp/{file}.png")).unwrap();
            eprintln!("{file} missing {:?}", harness.state().texts().missing());
        }
    }
}
