//! Scratch.
use crate::kit::{TestHost, studio_with};
use catoptric_studio::{Command, Language, Start, Theme};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

#[test]
fn look() {
    for (language, code) in [(Language::English, "en"), (Language::Russian, "ru")] {
        for (theme, shade) in [(Theme::Dark, "dark"), (Theme::Light, "light")] {
            let host = TestHost::new();
            let mut harness = studio_with(host.clone(), Start::Example("four-bodies".to_owned()));
            harness.run();
            harness.state_mut().run(Command::Language(language));
            harness.state_mut().run(Command::Theme(theme));
            harness.run_steps(3);
            let shot = |harness: &mut egui_kittest::Harness<'static, catoptric_studio::Studio>,
                        name: &str| {
                harness.run_steps(6);
                std::thread::sleep(std::time::Duration::from_millis(400));
                harness.run_steps(6);
                harness.render().unwrap().save(format!("/tmp/look/{name}-{code}-{shade}.png")).unwrap();
            };
            harness.state_mut().run(Command::Render);
            shot(&mut harness, "dialog");
            let (exr, start) = match language {
                Language::English => ("File: EXR", "Render"),
                Language::Russian => ("Файл: EXR", "Начать рендер"),
            };
            harness.get_by_label(exr).click();
            shot(&mut harness, "exr");
            harness.get_by_role_and_label(Role::Button, start).click();
            shot(&mut harness, "card");
            let since = std::time::Instant::now();
            while harness.state().is_rendering() && since.elapsed().as_secs() < 100 {
                harness.step();
                std::thread::sleep(std::time::Duration::from_millis(20));
            }
            shot(&mut harness, "result");
        }
    }
}
