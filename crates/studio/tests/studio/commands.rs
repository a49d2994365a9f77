//! Commands: by menu, by key, by the palette; help and the status bar.

use std::path::Path;

use catoptric_editor::Action;
use catoptric_scene::ScenePart;
use catoptric_studio::{
    CameraCommand, Command, CommandGroup, FileCommand, Language, Pane, StartDocument, Studio, Texts, Theme,
    Tool, ToolCommand, WindowCommand,
};
use catoptric_tracer::raster::MethodKind;
use egui::accesskit::Role;
use egui::{Event, Key, ModifierNames, Modifiers, OutputCommand};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use crate::kit::{TestHost, studio, studio_with, wait_until};

type Kit = Harness<'static, Studio>;

fn choose(harness: &mut Kit, menu: &str, item: &str) {
    harness.get_by_label(menu).click();
    settle(harness);
    harness.get_by_label(item).click();
    settle(harness);
}

/// A few frames: popups need one to measure themselves, and refinement never lets the window rest.
fn settle(harness: &mut Kit) {
    harness.run_steps(4);
}

/// Whether an entry of the open menu is on. Menus lie above the toolbar, which has buttons of the same names.
fn toggled(harness: &Kit, label: &str) -> Option<egui::accesskit::Toggled> {
    harness.get_all_by_label(label).last().and_then(|node| node.accesskit_node().toggled())
}

fn press(harness: &mut Kit, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    settle(harness);
}

fn bodies(harness: &Kit) -> usize {
    harness.state().editor().scene().bodies.len()
}

#[test]
fn the_language_switch_changes_every_menu_at_once() {
    let mut harness = studio();
    settle(&mut harness);
    for title in ["File", "Edit", "Add", "View", "Help"] {
        assert!(harness.query_by_label(title).is_some(), "{title}");
    }
    harness.get_by_label("Русский").click();
    settle(&mut harness);
    for title in ["Файл", "Правка", "Добавить", "Вид", "Справка"] {
        assert!(harness.query_by_label(title).is_some(), "{title}");
    }
    for title in ["Камера", "Тела"] {
        assert!(harness.query_by_role_and_label(Role::TreeItem, title).is_some(), "{title}");
    }
    assert!(harness.query_by_label("File").is_none());
    assert_eq!(harness.state().settings().language, Language::Russian);
    harness.get_by_label("English").click();
    settle(&mut harness);
    assert!(harness.query_by_label("File").is_some());
}

#[test]
fn the_theme_switch_is_a_button_in_the_bar() {
    let mut harness = studio();
    settle(&mut harness);
    harness.get_by_label("Switch to the light theme").click();
    settle(&mut harness);
    assert_eq!(harness.state().settings().theme, Theme::Light);
    assert!(!harness.ctx.global_style().visuals.dark_mode);
    assert!(harness.query_by_label("Switch to the dark theme").is_some());
}

#[test]
fn menus_tell_what_they_undo_and_redo() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    choose(&mut harness, "Edit", "Duplicate");
    assert_eq!(bodies(&harness), 6);
    choose(&mut harness, "Edit", "Undo: Duplicate “sphere”");
    assert_eq!(bodies(&harness), 5);
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    settle(&mut harness);
    choose(&mut harness, "Правка", "Повторить: Дублирование: «sphere»");
    assert_eq!(bodies(&harness), 6);
}

#[test]
fn entries_that_can_do_nothing_are_disabled_and_toggles_are_checked() {
    let mut harness = studio();
    settle(&mut harness);
    harness.get_by_label("Edit").click();
    settle(&mut harness);
    assert!(harness.get_by_label("Undo").accesskit_node().is_disabled());
    assert!(harness.get_by_label("Rename").accesskit_node().is_disabled());
    assert!(!harness.get_by_label("Paste").accesskit_node().is_disabled());
    harness.key_press(Key::Escape);
    settle(&mut harness);
    harness.get_by_label("View").click();
    settle(&mut harness);
    assert_eq!(toggled(&harness, "Ground grid"), Some(true.into()));
    assert_eq!(toggled(&harness, "Move"), Some(true.into()));
    assert_eq!(toggled(&harness, "Free view"), Some(false.into()));
}

#[test]
fn a_narrow_window_folds_the_menus_into_one() {
    let mut harness = studio();
    harness.set_size(egui::vec2(420.0, 600.0));
    settle(&mut harness);
    assert!(harness.query_by_label("File").is_none());
    harness.get_by_label("Menu").click();
    settle(&mut harness);
    assert!(harness.query_by_label("File").is_some());
    let bar: Vec<egui::Rect> =
        ["Menu", "English", "Русский"].map(|label| harness.get_by_label(label).rect()).into();
    for (place, rect) in bar.iter().enumerate() {
        assert!(bar.iter().skip(place + 1).all(|other| !rect.intersects(*other)), "{bar:?}");
        assert!(rect.min.x >= 0.0 && rect.max.x <= 420.0, "{bar:?}");
    }
}

#[test]
fn keys_edit_the_document() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    press(&mut harness, Modifiers::COMMAND, Key::D);
    assert_eq!(bodies(&harness), 6);
    press(&mut harness, Modifiers::NONE, Key::Delete);
    assert_eq!(bodies(&harness), 5);
    press(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(bodies(&harness), 6);
    press(&mut harness, Modifiers::COMMAND, Key::Y);
    assert_eq!(bodies(&harness), 5);
    press(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    press(&mut harness, Modifiers::COMMAND, Key::A);
    assert_eq!(harness.state().editor().selection().len(), 7);
    press(&mut harness, Modifiers::NONE, Key::H);
    assert!(harness.state().editor().scene().bodies.iter().all(|body| body.hidden));
    press(&mut harness, Modifiers::ALT, Key::H);
    assert!(harness.state().editor().scene().bodies.iter().all(|body| !body.hidden));
}

#[test]
fn keys_do_nothing_while_a_name_is_typed() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    harness.get_by_label("Filter by name").focus();
    settle(&mut harness);
    for key in [Key::Delete, Key::H, Key::L, Key::G, Key::End, Key::Num5] {
        press(&mut harness, Modifiers::NONE, key);
    }
    assert_eq!(harness.state().editor().steps().len(), 0);
    assert!(harness.state().settings().shows_grid);
    press(&mut harness, Modifiers::COMMAND, Key::D);
    assert_eq!(bodies(&harness), 6, "a shortcut that text fields do not know");
}

#[test]
fn keys_do_nothing_behind_a_dialog() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    press(&mut harness, Modifiers::NONE, Key::F1);
    assert!(harness.query_by_label("Mouse in the picture").is_some());
    press(&mut harness, Modifiers::NONE, Key::Delete);
    press(&mut harness, Modifiers::COMMAND, Key::D);
    assert_eq!(bodies(&harness), 5);
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label("Mouse in the picture").is_none());
    press(&mut harness, Modifiers::NONE, Key::Delete);
    assert_eq!(bodies(&harness), 4);
}

#[test]
fn bodies_go_through_the_clipboard_as_text() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    harness.event(Event::Copy);
    harness.step();
    let commands = harness.output().platform_output.commands.clone();
    let text = commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let text = text.expect("something was copied");
    assert!(text.contains("sphere"), "{text}");
    harness.event(Event::Cut);
    settle(&mut harness);
    assert_eq!(bodies(&harness), 4);
    harness.event(Event::Paste(text.clone()));
    settle(&mut harness);
    assert_eq!(bodies(&harness), 5);

    harness.get_by_label("Filter by name").focus();
    settle(&mut harness);
    harness.event(Event::Paste(text));
    settle(&mut harness);
    assert_eq!(bodies(&harness), 5, "the text goes into the field");
}

#[test]
fn a_text_that_is_no_scene_is_refused_with_a_notice() {
    let mut harness = studio();
    settle(&mut harness);
    harness.event(Event::Paste("bodies = 3".to_owned()));
    settle(&mut harness);
    assert!(harness.query_by_label("The clipboard does not hold the text of a scene.").is_some());
    harness.get_by_label("Close").click();
    settle(&mut harness);
    assert!(harness.query_by_label("The clipboard does not hold the text of a scene.").is_none());
}

#[test]
fn paste_chosen_in_the_palette_takes_the_text_that_comes_later() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    let text = harness.state().editor().copy().unwrap();
    run_by_palette(&mut harness, "Paste");
    harness.event(Event::Paste(text));
    settle(&mut harness);
    assert_eq!(bodies(&harness), 6);
}

fn open_palette(harness: &mut Kit) {
    press(harness, Modifiers::COMMAND, Key::P);
}

fn is_palette_open(harness: &Kit) -> bool {
    harness.query_all_by_role(Role::TextInput).any(|field| {
        let label = field.accesskit_node().label();
        label.is_some_and(|label| label == "Find a command…" || label == "Найти команду…")
    })
}

fn run_by_palette(harness: &mut Kit, query: &str) {
    open_palette(harness);
    harness.event(Event::Text(query.to_owned()));
    settle(harness);
    press(harness, Modifiers::NONE, Key::Enter);
}

#[test]
fn the_palette_finds_commands_by_their_stable_names() {
    let mut harness = studio();
    settle(&mut harness);
    harness.state_mut().run(WindowCommand::Language(Language::Russian));
    settle(&mut harness);
    run_by_palette(&mut harness, "view.method.cube");
    assert_eq!(harness.state().settings().methods.kind(), MethodKind::CubeMap);
    run_by_palette(&mut harness, "window.language.english");
    assert_eq!(harness.state().settings().language, Language::English);
}

#[test]
fn the_palette_finds_commands_in_both_languages_examples_and_bodies() {
    let mut harness = studio();
    settle(&mut harness);
    run_by_palette(&mut harness, "add cub");
    assert_eq!(bodies(&harness), 6);
    run_by_palette(&mut harness, "добавить конус");
    assert_eq!(bodies(&harness), 7);
    run_by_palette(&mut harness, "cylinder");
    let scene = harness.state().editor().scene();
    let cylinder = scene.bodies.iter().position(|body| body.name == "cylinder").unwrap();
    assert_eq!(harness.state().editor().primary_part(), Some(ScenePart::Body(cylinder)));
    open_palette(&mut harness);
    harness.event(Event::Text("sphereflake".to_owned()));
    settle(&mut harness);
    assert!(harness.query_by_label("Sphereflake").is_some());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!is_palette_open(&harness));
}

#[test]
fn the_arrows_of_the_palette_choose() {
    let mut harness = studio();
    settle(&mut harness);
    open_palette(&mut harness);
    harness.event(Event::Text("tool rotate".to_owned()));
    settle(&mut harness);
    harness.event(Event::Text("zzz".to_owned()));
    settle(&mut harness);
    assert!(harness.query_by_label("No matches").is_some());
    press(&mut harness, Modifiers::NONE, Key::Escape);
    open_palette(&mut harness);
    let chosen = |harness: &Kit| {
        let rows = harness.get_all_by_role(Role::ListBoxOption);
        rows.enumerate().find(|(_, row)| row.accesskit_node().toggled() == Some(true.into())).unwrap().0
    };
    assert_eq!(chosen(&harness), 0);
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    press(&mut harness, Modifiers::NONE, Key::ArrowDown);
    press(&mut harness, Modifiers::NONE, Key::ArrowUp);
    assert_eq!(chosen(&harness), 1);
}

/// Every command by its name, in this language; what it opens is closed again.
fn every_command_runs(language: Language) {
    let host = TestHost::new();
    let mut harness = studio_with(host, StartDocument::Example("four-bodies".to_owned()));
    for command in Command::all() {
        if *command == WindowCommand::Palette.into() {
            continue;
        }
        harness.state_mut().run(WindowCommand::Language(language));
        harness.state_mut().editor_mut().select_parts([ScenePart::Body(0)]);
        settle(&mut harness);
        let name = harness.state().texts().get(command.look().unwrap().key).to_owned();
        run_by_palette(&mut harness, &name);
        harness.state().editor().check_invariants().unwrap();
        for _ in 0..3 {
            press(&mut harness, Modifiers::NONE, Key::Escape);
        }
        assert!(!is_palette_open(&harness), "{name}");
        if let Command::Window(WindowCommand::Zoom(_)) = command {
            assert!(harness.state().settings().zoom.is_finite());
        }
    }
    assert_eq!(harness.state().texts().missing(), Vec::<String>::new());
}

#[test]
fn every_command_runs_by_its_english_name() {
    every_command_runs(Language::English);
}

#[test]
fn every_command_runs_by_its_russian_name() {
    every_command_runs(Language::Russian);
}

#[test]
fn a_panel_behind_another_comes_to_the_front_before_it_hides() {
    let mut harness = studio();
    settle(&mut harness);
    assert!(harness.query_by_label("Opened").is_none());
    harness.state_mut().run(WindowCommand::TogglePane(Pane::History));
    settle(&mut harness);
    assert!(harness.query_by_label("Opened").is_some());
    harness.state_mut().run(WindowCommand::TogglePane(Pane::History));
    settle(&mut harness);
    assert!(harness.query_by_label("Opened").is_none());
    assert!(harness.query_by_label("Bodies").is_some(), "the panel before it is seen again");
}

#[test]
fn a_click_in_the_history_goes_to_that_step() {
    let mut harness = studio();
    settle(&mut harness);
    for body in 1..4 {
        harness.state_mut().editor_mut().select_parts([ScenePart::Body(body)]);
        harness.state_mut().editor_mut().apply(Action::Duplicate).unwrap();
    }
    harness.state_mut().run(WindowCommand::TogglePane(Pane::History));
    settle(&mut harness);
    harness.get_by_label("Duplicate “sphere”").click();
    settle(&mut harness);
    assert_eq!((harness.state().editor().steps_done(), bodies(&harness)), (1, 6));
    harness.get_by_label("Duplicate “cylinder”").click();
    settle(&mut harness);
    assert_eq!(bodies(&harness), 8);
    harness.get_by_label("Opened").click();
    settle(&mut harness);
    assert_eq!(bodies(&harness), 5);
}

#[test]
fn help_has_its_pages() {
    let mut harness = studio();
    settle(&mut harness);
    choose(&mut harness, "Help", "Terms of optics");
    assert!(harness.query_by_label("Index of refraction").is_some());
    harness.get_by_label("About Catoptric").click();
    settle(&mut harness);
    let version = format!("Version {}", env!("CARGO_PKG_VERSION"));
    assert!(harness.query_by_label(&version).is_some());
    harness.get_by_label("Close").click();
    settle(&mut harness);
    assert!(harness.query_by_label(&version).is_none());
}

#[test]
fn the_first_steps_tick_themselves_and_stay_away_once_dismissed() {
    let host = TestHost::new();
    std::fs::write(host.path("settings.json"), r#"{"language": "english"}"#).unwrap();
    let mut harness = studio_with(host, StartDocument::Last);
    settle(&mut harness);
    assert!(harness.query_by_label("First steps").is_some());
    assert!(harness.query_all_by_label_contains("That is all.").next().is_none());
    let label = || catoptric_editor::Label::new("edit-reset-placement", "sphere");
    // The wheel comes closer, which is no turn.
    let center = harness.state().viewport_rect().unwrap().center();
    harness.hover_at(center);
    let wheel = Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: egui::vec2(0.0, 3.0),
        modifiers: Modifiers::NONE,
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
    };
    let before = harness.state().editor().scene().camera.position;
    harness.event(wheel);
    harness.run_steps(30);
    assert_ne!(harness.state().editor().scene().camera.position, before);
    let editor = harness.state_mut().editor_mut();
    editor
        .change(label(), |scene| {
            scene.bodies[1].placement.anchor = catoptric_scene::Placement::default().anchor;
        })
        .unwrap();
    editor
        .change(label(), |scene| scene.materials[1].material.as_phong_mut().unwrap().reflection = Some(0.9))
        .unwrap();
    settle(&mut harness);
    assert!(
        harness.query_all_by_label_contains("That is all.").next().is_none(),
        "the view is not turned yet"
    );
    let editor = harness.state_mut().editor_mut();
    editor.change(label(), |scene| scene.camera.position.x += 1.0).unwrap();
    settle(&mut harness);
    assert!(harness.query_all_by_label_contains("That is all.").next().is_some());
    harness.get_by_label("Dismiss the hint").click();
    settle(&mut harness);
    assert!(harness.query_by_label("First steps").is_none());
    assert!(harness.state().settings().is_hint_dismissed);
    choose(&mut harness, "Help", "First steps");
    assert!(harness.query_by_label("Dismiss the hint").is_some());
}

/// A studio in which all first steps have been done.
fn with_first_steps_done() -> Kit {
    let host = TestHost::new();
    std::fs::write(host.path("settings.json"), r#"{"language": "english"}"#).unwrap();
    let mut harness = studio_with(host, StartDocument::Last);
    settle(&mut harness);
    let change = |scene: &mut catoptric_scene::Scene| {
        scene.camera.position.x += 1.0;
        scene.bodies[1].placement.anchor = catoptric_scene::Placement::default().anchor;
        scene.materials[1].material.as_phong_mut().unwrap().reflection = Some(0.9);
    };
    let label = catoptric_editor::Label::new("edit-reset-placement", "sphere");
    harness.state_mut().editor_mut().change(label, change).unwrap();
    settle(&mut harness);
    harness
}

#[test]
fn the_first_steps_leave_scenes_alone_that_were_asked_for_by_name() {
    let host = TestHost::new();
    std::fs::write(host.path("settings.json"), r#"{"language": "english"}"#).unwrap();
    std::fs::write(host.path("a.toml"), "format = \"catoptric/1\"\n").unwrap();
    let starts = [
        StartDocument::Example("four-bodies".to_owned()),
        StartDocument::File(host.path("a.toml")),
        StartDocument::Link("nothing".to_owned()),
    ];
    for start in starts {
        let mut harness = studio_with(host.clone(), start.clone());
        settle(&mut harness);
        assert!(harness.query_by_label("First steps").is_none(), "{start:?}");
        assert!(!harness.state().settings().is_hint_dismissed, "they come with another start");
    }
    let mut harness = studio_with(host.clone(), StartDocument::Last);
    settle(&mut harness);
    assert!(harness.query_by_label("First steps").is_some());
    harness.state_mut().run(FileCommand::OpenFile(host.path("a.toml")));
    wait_until(&mut harness, "the file is open", |studio| studio.editor().title() == "a.toml");
    settle(&mut harness);
    assert!(harness.query_by_label("First steps").is_none());
    choose(&mut harness, "Help", "First steps");
    assert!(harness.query_by_label("Dismiss the hint").is_some(), "asked for, they come at once");
}

#[test]
fn the_first_steps_lead_on_to_the_examples_and_the_laboratory() {
    let mut harness = with_first_steps_done();
    harness.get_by_label("Examples…").click();
    settle(&mut harness);
    assert!(harness.query_by_label("Search the examples").is_some());
    let mut harness = with_first_steps_done();
    harness.get_by_label("Laboratory").click();
    settle(&mut harness);
    assert!(harness.query_by_label("First steps").is_none());
    harness.get_by_label("Lab").click();
    settle(&mut harness);
    let audit = harness.state().texts().get("command-audit").to_owned();
    assert_eq!(toggled(&harness, &audit), Some(true.into()));
}

#[test]
fn the_status_bar_tells_how_the_picture_is_doing() {
    let mut harness = studio();
    wait_until(&mut harness, "the picture is refined", |studio| {
        let status = studio.live().status();
        status.is_idle && status.samples_wanted > 0 && status.samples_done >= status.samples_wanted
    });
    settle(&mut harness);
    let [width, height] = harness.state().live().status().picture_size;
    assert!(harness.query_by_label(&format!("{width} × {height}")).is_some());
    assert!(harness.query_by_label("done").is_some());
    assert!(harness.query_by_label("5 bodies · 2 lights").is_some());
    assert!(harness.query_by_role_and_label(Role::Label, "Free view").is_none());
    harness.state_mut().run(CameraCommand::ToggleFreeView);
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::Label, "Free view").is_some());
}

#[test]
fn tools_are_chosen_by_their_keys_but_not_in_flight() {
    let mut harness = studio();
    settle(&mut harness);
    let is_on = |harness: &mut Kit, label: &str| {
        harness.get_by_label("View").click();
        settle(harness);
        let toggled = toggled(harness, label);
        press(harness, Modifiers::NONE, Key::Escape);
        toggled == Some(true.into())
    };
    press(&mut harness, Modifiers::NONE, Key::E);
    assert!(is_on(&mut harness, "Rotate"));
    harness.state_mut().run(ToolCommand::Take(Tool::Move));
    press(&mut harness, Modifiers::SHIFT, Key::F);
    press(&mut harness, Modifiers::NONE, Key::E);
    assert!(!is_on(&mut harness, "Rotate"), "the key flies");
}

/// The list of commands for maintainers; `BLESS=1` writes it.
#[test]
fn the_list_of_names_is_up_to_date() {
    let texts = Texts::new(Language::English);
    let mut list = String::from(
        "# Names of commands\n\n\
         The commands of the studio by their stable names, for the palette, tests and programs: `Command::from_name`. \
         Written by\n`BLESS=1 cargo test -p catoptric-studio`.\n",
    );
    for group in CommandGroup::ALL {
        list += &format!("\n## {}\n\n| Name | Command | Keys |\n|---|---|---|\n", texts.get(group.key()));
        for look in Command::all().filter_map(Command::look).filter(|look| look.group == group) {
            let keys = look
                .shortcuts
                .iter()
                .map(|keys| keys.format(&ModifierNames::NAMES, false).replace('|', "\\|"));
            let keys = keys.collect::<Vec<_>>().join(", ");
            list += &format!("| `{}` | {} | {keys} |\n", look.name, texts.get(look.key));
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/dev/commands.md");
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &list).unwrap();
    }
    // Checkouts on Windows have other ends of lines.
    let written = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(written == list, "docs/dev/commands.md is not up to date; set BLESS=1 to write it");
}
