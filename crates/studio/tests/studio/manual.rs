//! The manual: pages, links, search, in both languages, with letters that the fonts have.

use catoptric_studio::{Command, HelpCommand, Language, Studio, WindowCommand};
use egui::accesskit::Role;
use egui::{Key, OutputCommand};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::studio;

type Kit = Harness<'static, Studio>;

fn run(harness: &mut Kit, command: impl Into<Command>) {
    harness.state_mut().run(command);
    harness.run_steps(4);
}

fn open(language: Language) -> Kit {
    let mut harness = studio();
    run(&mut harness, WindowCommand::Language(language));
    run(&mut harness, HelpCommand::Manual);
    harness
}

/// The page that is read.
fn page(harness: &Kit) -> String {
    harness.get_by_role(Role::Document).accesskit_node().label().unwrap_or_default()
}

fn tells(harness: &Kit, words: &str) -> bool {
    harness.query_all_by_label_contains(words).next().is_some()
}

fn click(harness: &mut Kit, label: &str) {
    harness.get_all_by_role_and_label(Role::Button, label).next().unwrap().click();
    harness.run_steps(4);
}

fn search(harness: &mut Kit, name: &str, words: &str) {
    harness.get_by_role_and_label(Role::SearchInput, name).type_text(words);
    harness.run_steps(3);
}

/// The kit panics at a letter that no font has; a page is drawn as a whole when it is shown first.
fn every_page_can_be_read(language: Language, first: &str, count: usize) {
    let mut harness = open(language);
    assert_eq!(page(&harness), first);
    let titles: Vec<String> =
        harness.query_all_by_role(Role::Button).filter_map(|node| node.accesskit_node().label()).collect();
    let mut seen = std::collections::BTreeSet::new();
    for title in titles {
        let Some(button) = harness.query_all_by_role_and_label(Role::Button, &title).next() else { continue };
        if button.rect().left() > 460.0 || button.rect().top() < 80.0 || button.rect().left() < 150.0 {
            continue;
        }
        button.click();
        harness.run_steps(4);
        seen.insert(page(&harness));
    }
    assert!(seen.len() >= count, "{seen:?}");
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn every_english_page_can_be_read() {
    every_page_can_be_read(Language::English, "The studio", 14);
}

#[test]
fn every_russian_page_can_be_read() {
    every_page_can_be_read(Language::Russian, "Студия", 14);
}

#[test]
fn links_lead_to_pages_and_headings_and_back() {
    let mut harness = open(Language::English);
    click(&mut harness, "Measuring");
    harness.get_all_by_role_and_label(Role::Link, "measures").next().unwrap().click();
    harness.run_steps(4);
    assert_eq!(page(&harness), "Measuring time");
    click(&mut harness, "Back");
    assert_eq!(page(&harness), "The studio");
    click(&mut harness, "The laboratory");
    harness.get_all_by_role_and_label(Role::Link, "A pixel explained").next().unwrap().click();
    harness.run_steps(4);
    assert_eq!(page(&harness), "A pixel explained");
}

#[test]
fn links_into_the_web_open_in_the_browser() {
    let mut harness = open(Language::English);
    click(&mut harness, "Scene files: catoptric/1");
    harness.get_all_by_role_and_label(Role::Link, "TOML").next().unwrap().click();
    let mut opened = Vec::new();
    for _ in 0..4 {
        harness.step();
        opened.extend(harness.output().platform_output.commands.iter().filter_map(|command| match command {
            OutputCommand::OpenUrl(url) => Some(url.url.clone()),
            _ => None,
        }));
    }
    assert_eq!(opened, ["https://toml.io"]);
}

#[test]
fn a_search_finds_all_pages_and_a_hit_jumps_to_its_place() {
    let mut harness = open(Language::English);
    search(&mut harness, "Search all pages", "brewster");
    assert!(tells(&harness, "Brewster"));
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert!(tells(&harness, "Brewster"));
    harness.get_by_role(Role::SearchInput).focus();
    harness.run_steps(2);
    search(&mut harness, "Search all pages", " xyzzy");
    assert!(tells(&harness, "Nothing was found"));
}

#[test]
fn the_language_of_the_window_is_that_of_the_manual() {
    let mut harness = open(Language::English);
    assert_eq!(page(&harness), "The studio");
    run(&mut harness, WindowCommand::Language(Language::Russian));
    assert_eq!(page(&harness), "Студия");
}

#[test]
fn esc_closes_the_manual_only_while_it_is_used() {
    let mut harness = open(Language::English);
    // The window lies over the middle; what is beside it can be used.
    let aside = egui::pos2(60.0, 700.0);
    harness.drag_at(aside);
    harness.drop_at(aside);
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(page(&harness), "The studio", "Esc was for the picture");
    harness.get_by_role(Role::SearchInput).click();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_role(Role::Document).is_none());
}

#[test]
fn keys_scroll_the_page_and_leave_the_picture() {
    let mut harness = open(Language::English);
    harness.get_by_role(Role::SearchInput).focus();
    harness.run_steps(2);
    let camera = harness.state().editor().scene().camera;
    // From the search, the page takes the keyboard by a click.
    let rect = harness.get_by_role(Role::Document).rect();
    harness.drag_at(rect.right_center() - egui::vec2(20.0, 0.0));
    harness.drop_at(rect.right_center() - egui::vec2(20.0, 0.0));
    harness.run_steps(3);
    assert!(tells(&harness, "The picture in the middle"));
    for _ in 0..3 {
        harness.key_press(Key::PageDown);
        harness.run_steps(20);
    }
    assert!(!tells(&harness, "The picture in the middle"));
    assert_eq!(harness.state().editor().scene().camera, camera);
}
