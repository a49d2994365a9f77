//! Experiments over the picture and in the inspector: maps, depth, energy, exact answers.

use catoptric_lab::maps::MapKind;
use catoptric_studio::{DisplayCommand, Language, StartDocument, Studio, WindowCommand};
use egui::Event;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

fn example(name: &str) -> Harness<'static, Studio> {
    let mut harness = studio_with(TestHost::new(), StartDocument::Example(name.to_owned()));
    harness.run_steps(3);
    harness
}

/// All labels and values of the window.
fn words(harness: &Harness<'static, Studio>) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes.filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value())).collect()
}

fn wait_for(harness: &mut Harness<'static, Studio>, start: &str) -> String {
    for _ in 0..4000 {
        harness.step();
        if let Some(found) = words(harness).into_iter().find(|words| words.starts_with(start)) {
            return found;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    panic!("waited in vain: {start}: {:#?}", words(harness));
}

#[test]
fn a_map_is_shown_with_a_legend_in_both_languages() {
    let mut harness = example("four-bodies");
    harness.state_mut().run(DisplayCommand::Map(Some(MapKind::Generations)));
    wait_for(&mut harness, "Generations reached: mean ");
    let middle = harness.state().viewport_rect().unwrap().center();
    harness.event(Event::PointerMoved(middle));
    harness.run_steps(3);
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    harness.state_mut().run(DisplayCommand::Map(Some(MapKind::Clipped)));
    wait_for(&mut harness, "Свет ярче белого: в среднем ");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
    harness.state_mut().run(DisplayCommand::Map(None));
    harness.run_steps(3);
    assert!(!words(&harness).iter().any(|words| words.starts_with("Свет ярче белого")));
    wait_until(&mut harness, "the picture", |studio| studio.live().latest().is_some());
    assert!(harness.query_by_label("Свет ярче белого").is_none());
}

#[test]
fn the_generations_that_are_needed_are_told_and_set() {
    let mut harness = example("hall-of-mirrors");
    harness.state_mut().editor_mut().select(catoptric_editor::Item::Tracing);
    wait_for(&mut harness, "Before tracing: ");
    wait_for(&mut harness, "As traced: ");
    let button = words(&harness).into_iter().rfind(|words| words.starts_with("Set ")).unwrap();
    let wanted: u32 = button[4..].parse().unwrap();
    assert_ne!(harness.state().editor().scene().tracing.generations, wanted);
    harness.get_by_label(&button).click();
    harness.run_steps(3);
    assert_eq!(harness.state().editor().scene().tracing.generations, wanted);
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    wait_for(&mut harness, "До трассировки: ");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn materials_that_give_more_than_they_get_are_told() {
    let mut harness = example("four-bodies");
    let scene = harness.state().editor().scene().clone();
    let body = scene.bodies.iter().position(|body| scene.material(&body.material).is_some()).unwrap();
    let part = catoptric_scene::ScenePart::Body(body);
    harness.state_mut().editor_mut().select_parts([part]);
    harness.run_steps(3);
    let is_told =
        |words: &[String]| words.iter().any(|words| words.starts_with("The highlight sends out more"));
    assert!(!is_told(&words(&harness)));
    let action = catoptric_editor::Action::MakeMaterialUnique;
    let _ = harness.state_mut().editor_mut().apply(action);
    let label = catoptric_editor::Label::new("edit-specular", "");
    let edit = |_: usize, body: &mut catoptric_scene::Body| {
        if let catoptric_scene::MaterialChoice::Inline(material) = &mut body.material {
            let phong = material.as_phong_mut().unwrap();
            (phong.specular, phong.shininess) = (0.5, 20.0);
            (phong.diffuse, phong.reflection) = (0.75, Some(0.5));
            phong.pattern.color = catoptric_scene::Color::WHITE;
        }
    };
    harness.state_mut().editor_mut().change_bodies([body], label, edit).unwrap();
    harness.run_steps(3);
    assert!(
        words(&harness).iter().any(|words| words.ends_with("\u{a0}=\u{a0}1.25")),
        "{:#?}",
        words(&harness)
    );
}

#[test]
fn every_model_is_warned_of_in_its_own_words() {
    use catoptric_scene::{Color, Material, MaterialChoice, Model, Phong};
    let pattern = || Color::new(0.5, 1.25, 0.2).into();
    let bright = |model| {
        let mut material = Material::from(model);
        *material.pattern_mut().unwrap() = pattern();
        material
    };
    let excessive = Phong {
        pattern: pattern(),
        diffuse: 0.4,
        reflection: Some(0.3),
        transmission: 0.5,
        ..Phong::default()
    };
    let phong = Material::Phong(excessive);
    let cases = [
        (
            phong,
            "Sends out more light than it receives: 0.5 + 0.3 + 0.5 = 1.3",
            "Отдаёт больше света, чем получает:",
        ),
        (
            bright(Model::Mirror),
            "Reflects more light than it receives: 1 · 1.25 = 1.25",
            "Отражает больше света,",
        ),
        (bright(Model::Matte), "Scatters more light than it receives: 1.25", "Рассеивает больше света,"),
        (bright(Model::Coated), "Under a coat, a color above 1 counts as 1.", "Под лаком цвет больше 1"),
    ];
    let mut harness = example("four-bodies");
    harness.state_mut().editor_mut().select_parts([catoptric_scene::ScenePart::Body(1)]);
    for (material, english, russian) in cases {
        let give = |harness: &mut Harness<'static, Studio>, material| {
            let choice = MaterialChoice::Inline(Box::new(material));
            let action = catoptric_editor::Action::AssignMaterial(choice);
            let _ = harness.state_mut().editor_mut().apply(action);
        };
        give(&mut harness, material.clone());
        harness.state_mut().run(WindowCommand::Language(Language::English));
        harness.run_steps(4);
        let seen = words(&harness);
        assert!(seen.iter().any(|words| words.replace('\u{a0}', " ") == english), "{english}: {seen:#?}");
        harness.state_mut().run(WindowCommand::Language(Language::Russian));
        harness.run_steps(4);
        assert!(words(&harness).iter().any(|words| words.starts_with(russian)), "{russian}");
        let mut fair = Material::from(material.model());
        *fair.pattern_mut().unwrap() = Color::gray(0.5).into();
        give(&mut harness, fair);
        harness.run_steps(4);
        assert!(!words(&harness).iter().any(|words| words.starts_with(russian)), "{russian}");
    }
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn exact_answers_stand_over_the_picture() {
    let mut harness = example("ring-of-images");
    let scene = harness.state().editor().scene().clone();
    let body = scene.bodies.iter().position(|body| body.name == "red ball").unwrap();
    harness.state_mut().editor_mut().select_parts([catoptric_scene::ScenePart::Body(body)]);
    harness.state_mut().run(DisplayCommand::ToggleExact);
    let image = wait_for(&mut harness, "Image in ");
    assert!(image.contains("\ntracer: off by "), "{image}");
    let is_ring = |words: &String| words.contains(" images between mirrors at 60°");
    assert!(words(&harness).iter().any(is_ring), "{:#?}", words(&harness));
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    wait_for(&mut harness, "Изображение в зеркале ");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
    harness.state_mut().run(DisplayCommand::ToggleExact);
    harness.run_steps(3);
    assert!(!words(&harness).iter().any(|words| words.starts_with("Изображение в зеркале ")));
}
