//! The entries of the palette.

use catoptric_editor::Item;
use catoptric_scene::Example;
use egui::Context;
use egui_material_icons::{MaterialIcon, icons};

use crate::base::example_texts::example_title;
use crate::base::shortcut_text;
use crate::base::texts::{Language, Texts};
use crate::panels::outliner::{item_icon, item_name};
use crate::state::command::{Command, FileCommand, WindowCommand};
use crate::state::command_context::CommandContext;

/// An entry of the palette.
pub(crate) struct PaletteItem {
    /// What it is called in the present language.
    pub(crate) name: String,
    /// What it can be found by: its names in all languages.
    pub(crate) names: Vec<String>,
    /// The stable name of a command.
    pub(crate) stable_name: Option<&'static str>,
    /// At its right: a shortcut, or what kind of thing it is.
    pub(crate) detail: String,
    pub(crate) tip: Option<String>,
    pub(crate) icon: MaterialIcon,
    pub(crate) what: PaletteAction,
}

/// The action of an entry.
#[derive(Clone)]
pub(crate) enum PaletteAction {
    Run(Command),
    Select(Item),
}

/// Commands first, then examples, recent files, and the things of the scene.
pub(crate) fn all(context: &Context, situation: CommandContext<'_>) -> Vec<PaletteItem> {
    let mut entries = commands(context, situation);
    entries.extend(examples(situation));
    entries.extend(recent(situation));
    entries.extend(things(situation));
    entries
}

fn commands(context: &Context, situation: CommandContext<'_>) -> Vec<PaletteItem> {
    let others: Vec<Texts> = Language::ALL
        .into_iter()
        .filter(|language| *language != situation.texts.language())
        .map(Texts::new)
        .collect();
    let entries = Command::all()
        .filter(|command| **command != WindowCommand::Palette.into() && situation.is_offered(command))
        .filter_map(|command| {
            let look = command.look()?;
            let name = situation.label(command);
            let mut names = vec![name.clone(), situation.texts.get(look.key).to_owned()];
            names.extend(others.iter().map(|texts| texts.get(look.key).to_owned()));
            let shortcut =
                look.usable_shortcuts().next().map(|shortcut| shortcut_text::text(context, shortcut));
            Some(PaletteItem {
                name,
                names,
                stable_name: Some(look.name),
                detail: shortcut.unwrap_or_default(),
                tip: situation.tip(command).map(str::to_owned),
                icon: look.icon,
                what: PaletteAction::Run(command.clone()),
            })
        });
    entries.collect()
}

fn examples(situation: CommandContext<'_>) -> impl Iterator<Item = PaletteItem> {
    let detail = situation.texts.get("palette-example");
    let language = situation.texts.language();
    Example::ALL.iter().map(move |example| PaletteItem {
        name: example_title(example, language).to_owned(),
        names: vec![example.title().to_owned(), example.russian_title().to_owned(), example.name.to_owned()],
        stable_name: None,
        detail: detail.to_owned(),
        tip: None,
        icon: icons::ICON_PHOTO_LIBRARY,
        what: PaletteAction::Run(FileCommand::OpenExample(example.name).into()),
    })
}

fn recent(situation: CommandContext<'_>) -> impl Iterator<Item = PaletteItem> {
    let detail = situation.texts.get("palette-recent");
    situation.settings.recent.iter().map(move |path| {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        PaletteItem {
            names: vec![name.clone()],
            name,
            stable_name: None,
            detail: detail.to_owned(),
            tip: Some(path.display().to_string()),
            icon: icons::ICON_DESCRIPTION,
            what: PaletteAction::Run(FileCommand::OpenFile(path.clone()).into()),
        }
    })
}

fn things(situation: CommandContext<'_>) -> impl Iterator<Item = PaletteItem> {
    let edited = situation.editor.edited();
    let fixed = [Item::Camera, Item::Environment, Item::Tracing];
    let items = fixed.into_iter().chain(edited.lights()).chain(edited.bodies()).chain(edited.materials());
    let detail = situation.texts.get("palette-thing");
    items.map(move |item| {
        let name = item_name(situation.texts, edited, item).into_owned();
        PaletteItem {
            names: vec![name.clone()],
            name,
            stable_name: None,
            detail: detail.to_owned(),
            tip: None,
            icon: item_icon(edited, item),
            what: PaletteAction::Select(item),
        }
    })
}
