//! The menu bar.

use catoptric_editor::Action;
use catoptric_editor::navigate::ViewSide;
use catoptric_lab::maps::MapKind;
use catoptric_scene::Example;
use catoptric_tracer::raster::MethodKind;
use egui::accesskit::Role;
use egui::containers::menu::{MenuBar, SubMenuButton};
use egui::{Align, Button, Id, Layout, Popup, Response, ScrollArea, SetOpenCommand, Style, Ui, Vec2, vec2};
use egui_material_icons::{MaterialIcon, icons};

use crate::base::example_texts::example_title;
use crate::base::shapes::ShapeGroup;
use crate::base::texts::Language;
use crate::base::theme::{self, Theme};
use crate::base::widgets::icon_button;
use crate::base::widgets::tip::tip_beside_entry;
use crate::panels::add_menu;
use crate::panels::menu_entry::{dress_menu, item_response, submenu};
use crate::shell::documents::recent;
use crate::shell::menu_focus::MenuFocus;
use crate::shell::studio::Studio;
use crate::state::command::{
    AddCommand, AuditCommand, CameraCommand, Command, CompareCommand, DisplayCommand, FileCommand,
    HelpCommand, JOINS, MeasureCommand, PictureCommand, SelectionCommand, Tool, ToolCommand, WindowCommand,
    ZoomStep,
};
use crate::state::layout::Pane;
use crate::state::methods;

/// What the bar needs to show all menus beside each other, points; below it they are folded into one.
const FULL_WIDTH: f32 = 520.0;

/// An entry of a menu.
enum MenuItem {
    /// A command.
    Do(Command),
    /// A line.
    Line,
    /// A menu of its own.
    Sub(&'static str, MaterialIcon, fn(&mut Ui, &Studio, &mut Vec<Command>)),
}

/// A menu of the bar.
struct Menu {
    key: &'static str,
    entries: fn() -> Vec<MenuItem>,
}

const MENUS: [Menu; 6] = [
    Menu { key: "menu-file", entries: file },
    Menu { key: "menu-edit", entries: edit },
    Menu { key: "menu-add", entries: add },
    Menu { key: "menu-view", entries: view },
    Menu { key: "menu-lab", entries: lab },
    Menu { key: "menu-help", entries: help },
];

/// Draws the menus, and at the right the language and the theme.
pub(crate) fn menu_ui(ui: &mut Ui, studio: &mut Studio) {
    let mut commands = Vec::new();
    let shown_before = ui.data(|data| data.get_temp(recent_id()));
    let mut focus = std::mem::take(&mut studio.menu_focus);
    focus.begin(ui.ctx());
    MenuBar::new().style(dress_bar as fn(&mut Style)).ui(ui, |ui| {
        ui.ctx().accesskit_node_builder(ui.unique_id(), |bar| {
            bar.set_role(Role::MenuBar);
            bar.set_label(studio.texts.get("menu-bar"));
        });
        if ui.available_width() < FULL_WIDTH {
            let name = studio.texts.get("menu-all");
            bar_button(ui, (icons::ICON_MENU.rich_text(), name), &mut focus, |ui, focus| {
                for menu in &MENUS {
                    let (response, _) = SubMenuButton::new(studio.texts.get(menu.key))
                        .ui(ui, |ui| entries_ui(ui, studio, (menu.entries)(), &mut commands, None));
                    if !ui.is_sizing_pass() {
                        focus.add_entry(&response, true);
                    }
                }
            });
        } else {
            for menu in &MENUS {
                let name = studio.texts.get(menu.key);
                bar_button(ui, (egui::RichText::new(name), name), &mut focus, |ui, focus| {
                    let focus = (!ui.is_sizing_pass()).then_some(focus);
                    entries_ui(ui, studio, (menu.entries)(), &mut commands, focus);
                });
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| right_ui(ui, studio, &mut commands));
    });
    focus.end(ui.ctx());
    studio.menu_focus = focus;
    look_up_recent(ui.ctx(), studio, shown_before);
    studio.commands.append(&mut commands);
}

/// A button of the bar with its menu. While a menu is open, moving the pointer over another button opens that one's.
fn bar_button(
    ui: &mut Ui,
    (text, name): (egui::RichText, &str),
    focus: &mut MenuFocus,
    content: impl FnOnce(&mut Ui, &mut MenuFocus),
) {
    let open_id = Id::unique("open menu of the bar");
    let response = ui.button(text).accessible_name(name);
    focus.add_button(&response);
    let popup_id = Popup::default_response_id(&response);
    let mut popup = Popup::menu(&response).style(dress_menu as fn(&mut Style));
    let is_entered =
        response.hovered() && !response.clicked() && ui.input(|input| input.pointer.delta() != Vec2::ZERO);
    let open: Option<Id> = ui.data(|data| data.get_temp(open_id));
    if is_entered && open.is_some_and(|open| open != popup_id && Popup::is_id_open(ui.ctx(), open)) {
        popup = popup.open_memory(Some(SetOpenCommand::Bool(true)));
    }
    if popup.show(|ui| content(ui, focus)).is_some() {
        ui.data_mut(|data| data.insert_temp(open_id, popup_id));
    }
}

fn dress_bar(style: &mut Style) {
    egui::containers::menu::menu_style(style);
    style.spacing.button_padding = vec2(8.0, 2.0);
    style.spacing.item_spacing.x = 2.0;
}

/// The theme, then the languages, from right to left.
fn right_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let is_dark = ui.visuals().dark_mode;
    let (icon, other, key) = if is_dark {
        (icons::ICON_LIGHT_MODE, Theme::Light, "theme-to-light")
    } else {
        (icons::ICON_DARK_MODE, Theme::Dark, "theme-to-dark")
    };
    if icon_button(ui, icon, studio.texts.get(key), false).clicked() {
        commands.push(WindowCommand::Theme(other).into());
    }
    ui.add_space(6.0);
    let palette = theme::palette(ui.visuals());
    for language in Language::ALL.into_iter().rev() {
        let is_on = studio.texts.language() == language;
        let color = if is_on { palette.text } else { palette.weak };
        let text = egui::RichText::new(language.letters()).color(color);
        let button = Button::selectable(is_on, text).min_size(vec2(30.0, 20.0));
        let response = ui.add(button).on_hover_text(studio.texts.tip("language").unwrap_or_default());
        if response.accessible_name(language.own_name()).clicked() {
            commands.push(WindowCommand::Language(language).into());
        }
    }
}

/// Draws the entries of a menu; those of the bar's own menus are told to `focus`.
fn entries_ui(
    ui: &mut Ui,
    studio: &Studio,
    entries: Vec<MenuItem>,
    commands: &mut Vec<Command>,
    mut focus: Option<&mut MenuFocus>,
) {
    ui.set_min_width(230.0);
    let is_offered = |entry: &MenuItem| match entry {
        MenuItem::Do(command) => studio.situation().is_offered(command),
        MenuItem::Line | MenuItem::Sub(..) => true,
    };
    let mut entries = entries.into_iter().filter(is_offered).peekable();
    while let Some(entry) = entries.next() {
        let is_submenu = matches!(entry, MenuItem::Sub(..));
        let response = match entry {
            MenuItem::Do(command) => {
                let response = item_response(ui, studio.situation(), &command);
                if response.as_ref().is_some_and(Response::clicked) {
                    commands.push(command);
                }
                response
            }
            MenuItem::Line => {
                // What would follow may not be offered: a page cannot quit.
                if entries.peek().is_some_and(|next| !matches!(next, MenuItem::Line)) {
                    ui.separator();
                }
                None
            }
            MenuItem::Sub(key, icon, content) => {
                Some(submenu(ui, (icon, studio.texts.get(key)), |ui| content(ui, studio, commands)))
            }
        };
        if let (Some(focus), Some(response)) = (&mut focus, response) {
            focus.add_entry(&response, is_submenu);
        }
    }
}

fn commands_of<const N: usize>(commands: [impl Into<Command>; N]) -> impl Iterator<Item = MenuItem> {
    commands.into_iter().map(|command| MenuItem::Do(command.into()))
}

fn file() -> Vec<MenuItem> {
    let mut entries: Vec<MenuItem> = commands_of([FileCommand::New, FileCommand::Open]).collect();
    entries.push(MenuItem::Sub("menu-recent", icons::ICON_HISTORY, recent_ui));
    entries.push(MenuItem::Sub("menu-examples", icons::ICON_PHOTO_LIBRARY, examples_ui));
    entries.push(MenuItem::Line);
    entries.extend(commands_of([
        FileCommand::Save,
        FileCommand::SaveAs,
        FileCommand::Revert,
        FileCommand::ReadOtherwise,
        FileCommand::CopyLink,
    ]));
    entries.push(MenuItem::Line);
    entries.extend(commands_of([PictureCommand::Render, PictureCommand::RenderShown, PictureCommand::Copy]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(FileCommand::Quit.into()));
    entries
}

fn edit() -> Vec<MenuItem> {
    let edit = Command::Edit;
    let mut entries: Vec<MenuItem> = commands_of([edit(Action::Undo), edit(Action::Redo)]).collect();
    entries.push(MenuItem::Line);
    entries.extend(commands_of([SelectionCommand::Cut, SelectionCommand::Copy, SelectionCommand::Paste]));
    entries.extend(commands_of([
        edit(Action::Duplicate),
        edit(Action::Delete),
        SelectionCommand::Rename.into(),
    ]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Sub("menu-select", icons::ICON_SELECT_ALL, select_ui));
    entries.push(MenuItem::Sub("menu-material", icons::ICON_PALETTE, material_ui));
    entries.push(MenuItem::Line);
    entries.extend(commands_of([edit(Action::ToggleHidden), edit(Action::ShowAll)]));
    entries.extend(commands_of([edit(Action::ToggleLocked), edit(Action::UnlockAll)]));
    entries.push(MenuItem::Line);
    entries.extend(commands_of([edit(Action::MoveUp), edit(Action::MoveDown)]));
    entries.extend(commands_of([edit(Action::DropToGround), edit(Action::ResetPlacement)]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Sub("menu-join", icons::ICON_JOIN_FULL, join_ui));
    entries.extend(commands_of([Action::TakeApart, Action::Nest(None), Action::TakeOut(None)].map(edit)));
    entries.extend(commands_of([edit(Action::DuplicateAsInstance), edit(Action::MakeOwn)]));
    entries
}

fn add() -> Vec<MenuItem> {
    use ShapeGroup::{Bodies, Optics, Surfaces};
    let mut entries: Vec<MenuItem> = commands_of(add_menu::FRONT).collect();
    entries.push(MenuItem::Line);
    entries.extend([
        MenuItem::Sub(Bodies.key(), add_menu::icon(Bodies), |ui, studio, commands| {
            add_menu::group_ui(ui, studio.situation(), commands, Bodies);
        }),
        MenuItem::Sub(Optics.key(), add_menu::icon(Optics), |ui, studio, commands| {
            add_menu::group_ui(ui, studio.situation(), commands, Optics);
        }),
        MenuItem::Sub(Surfaces.key(), add_menu::icon(Surfaces), |ui, studio, commands| {
            add_menu::group_ui(ui, studio.situation(), commands, Surfaces);
        }),
    ]);
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(AddCommand::Material.into()));
    entries
}

fn view() -> Vec<MenuItem> {
    let mut entries: Vec<MenuItem> =
        commands_of([CameraCommand::FrameSelection, CameraCommand::FrameAll]).collect();
    entries.push(MenuItem::Sub("menu-sides", icons::ICON_VIEW_IN_AR, sides_ui));
    entries.extend(commands_of([CameraCommand::ToggleProjection, CameraCommand::ToggleFreeView]));
    entries.extend(commands_of([CameraCommand::FromView, CameraCommand::ToggleFly]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Sub("menu-method", icons::ICON_FLARE, methods_ui));
    entries.push(MenuItem::Sub("menu-shown", icons::ICON_LAYERS, shown_ui));
    entries.push(MenuItem::Do(DisplayCommand::ToggleCard.into()));
    entries.push(MenuItem::Line);
    entries.extend(commands_of([Tool::Move, Tool::Rotate, Tool::Scale].map(ToolCommand::Take)));
    entries.extend(commands_of([ToolCommand::AimLight, ToolCommand::ToggleGizmoSpace]));
    entries.extend(commands_of([DisplayCommand::ToggleGrid, DisplayCommand::ToggleHandles]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Sub("menu-panels", icons::ICON_DASHBOARD, panels_ui));
    entries.push(MenuItem::Sub("menu-theme", icons::ICON_CONTRAST, theme_ui));
    entries.push(MenuItem::Sub("menu-language", icons::ICON_LANGUAGE, language_ui));
    entries.push(MenuItem::Sub("menu-zoom", icons::ICON_ZOOM_IN, zoom_ui));
    entries
}

fn lab() -> Vec<MenuItem> {
    use AuditCommand::{All, Copy, Next, Play, Previous, Release, Save, Tool, View};
    let (audit, compare, measure) = (Command::Audit, Command::Compare, Command::Measure);
    let mut entries: Vec<MenuItem> = commands_of([Tool, View].map(audit)).collect();
    entries.extend(commands_of([Previous, Next, All, Play].map(audit)));
    entries.extend(commands_of([Copy, Save, Release].map(audit)));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(DisplayCommand::ToggleExact.into()));
    entries.push(MenuItem::Sub("menu-map", icons::ICON_STACKS, maps_ui));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(WindowCommand::TogglePane(Pane::Compare).into()));
    entries.extend(commands_of([CompareCommand::Swap, CompareCommand::Save].map(compare)));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(WindowCommand::TogglePane(Pane::Measure).into()));
    entries.extend(commands_of([MeasureCommand::Vary(None), MeasureCommand::Start].map(measure)));
    entries
        .extend(commands_of([MeasureCommand::Stop, MeasureCommand::Copy, MeasureCommand::Save].map(measure)));
    entries
}

fn help() -> Vec<MenuItem> {
    let mut entries =
        vec![MenuItem::Do(HelpCommand::Manual.into()), MenuItem::Do(WindowCommand::Palette.into())];
    entries.push(MenuItem::Line);
    entries.extend(commands_of([HelpCommand::FirstSteps, HelpCommand::ExampleNote]));
    entries.extend(commands_of([HelpCommand::Terms, HelpCommand::Shortcuts]));
    entries.push(MenuItem::Line);
    entries.push(MenuItem::Do(HelpCommand::About.into()));
    entries
}

fn do_ui<const N: usize>(
    ui: &mut Ui,
    studio: &Studio,
    commands: &mut Vec<Command>,
    list: [impl Into<Command>; N],
) {
    entries_ui(ui, studio, commands_of(list).collect(), commands, None);
}

fn select_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    use Action::{
        InvertSelection, SelectAll, SelectNext, SelectNone, SelectPart, SelectPrevious, SelectWhole,
    };
    let list = [SelectAll, SelectNone, InvertSelection, SelectNext, SelectPrevious];
    do_ui(ui, studio, commands, list.map(Command::Edit));
    ui.separator();
    do_ui(ui, studio, commands, [SelectPart, SelectWhole].map(Command::Edit));
}

fn material_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    use Action::{MakeMaterialUnique, MaterialOfWhole, RemoveUnusedMaterials, ShareMaterial};
    do_ui(ui, studio, commands, [WindowCommand::TogglePane(Pane::Materials)]);
    ui.separator();
    do_ui(
        ui,
        studio,
        commands,
        [ShareMaterial, MakeMaterialUnique, MaterialOfWhole, RemoveUnusedMaterials].map(Command::Edit),
    );
}

fn join_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, JOINS.map(Command::Edit));
}

fn sides_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, ViewSide::ALL.map(CameraCommand::LookAlong));
}

fn maps_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, [DisplayCommand::Map(None)]);
    ui.separator();
    do_ui(ui, studio, commands, MapKind::ALL.map(|kind| DisplayCommand::Map(Some(kind))));
}

fn methods_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, MethodKind::ALL.map(DisplayCommand::Method));
}

fn shown_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, methods::ALL_SHOWN.map(DisplayCommand::Show));
}

fn panels_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let panes = [
        Pane::Outliner,
        Pane::History,
        Pane::Inspector,
        Pane::Problems,
        Pane::Audit,
        Pane::Compare,
        Pane::Measure,
        Pane::Materials,
        Pane::Viewport,
    ];
    do_ui(ui, studio, commands, panes.map(WindowCommand::TogglePane));
    ui.separator();
    do_ui(ui, studio, commands, [WindowCommand::ResetLayout]);
}

fn theme_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, [Theme::Dark, Theme::Light, Theme::System].map(WindowCommand::Theme));
}

fn language_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, Language::ALL.map(WindowCommand::Language));
}

fn zoom_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, [ZoomStep::In, ZoomStep::Out, ZoomStep::Normal].map(WindowCommand::Zoom));
}

/// The pass in which the recent files were shown last.
fn recent_id() -> Id {
    Id::unique("recent files shown")
}

/// Looks up which of the recent files are still there, whenever their menu has opened.
fn look_up_recent(context: &egui::Context, studio: &mut Studio, shown_before: Option<u64>) {
    let pass = context.cumulative_pass_nr();
    let shown = context.data(|data| data.get_temp::<u64>(recent_id()));
    if shown == Some(pass) && shown_before.is_none_or(|before| before + 1 < pass) {
        recent::look_again(studio);
    }
}

/// The files opened or saved last; missing ones are dim.
fn recent_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let pass = ui.ctx().cumulative_pass_nr();
    ui.data_mut(|data| data.insert_temp(recent_id(), pass));
    ui.set_min_width(200.0);
    if studio.settings.recent.is_empty() {
        ui.add_enabled(false, Button::new(studio.texts.get("menu-no-recent")));
    }
    for path in &studio.settings.recent {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let mut text = egui::RichText::new(name.as_ref());
        if recent::is_missing(studio, path) {
            text = text.weak();
        }
        let button = Button::new((icons::ICON_DESCRIPTION.rich_text(), text));
        let response = ui.add(button).accessible_name(name.as_ref());
        if tip_beside_entry(response, &path.display().to_string()).clicked() {
            commands.push(FileCommand::OpenFile(path.clone()).into());
            ui.close();
        }
    }
}

/// The built-in scenes, and all of them with pictures.
fn examples_ui(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    do_ui(ui, studio, commands, [FileCommand::Examples]);
    ui.separator();
    let room = (ui.ctx().content_rect().height() - 190.0).max(120.0);
    let height = room.min(Example::ALL.len() as f32 * (ui.spacing().interact_size.y + 1.0));
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
        for example in Example::ALL {
            let title = example_title(example, studio.texts.language());
            if ui.button(title).clicked() {
                commands.push(FileCommand::OpenExample(example.name).into());
                ui.close();
            }
        }
    });
}
