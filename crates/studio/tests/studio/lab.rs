//! Experiments over the picture and in the inspector: maps, depth, energy, exact answers.

use catoptric_lab::maps::MapKind;
use catoptric_studio::{Command, Language, Start, Studio};
use egui::Event;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio_with, wait_until};

fn example(name: &str) -> Harness<'static, Studio> {
    let mut harness = studio_with(TestHost::new(), Start::Example(name.to_owned()));
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
    harness.state_mut().run(Command::Map(Some(MapKind::Generations)));
    wait_for(&mut harness, "Generations reached: mean ");
    let middle = harness.state().viewport_rect().unwrap().center();
    harness.event(Event::PointerMoved(middle));
    harness.run_steps(3);
    harness.state_mut().run(Command::Language(Language::Russian));
    harness.state_mut().run(Command::Map(Some(MapKind::Clipped)));
    wait_for(&mut harness, "Свет ярче белого: в среднем ");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
    harness.state_mut().run(Command::Map(None));
    harness.run_steps(3);
    assert!(!words(&harness).iter().any(|words| words.starts_with("Свет ярче белого")));
    wait_until(&mut harness, "the picture", |studio| studio.live().latest().is_some());
    assert!(harness.query_by_label("Свет ярче белого").is_none());
}
