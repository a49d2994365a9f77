//! The entries of the palette.

use catoptric_editor::Item;
use catoptric_scene::Example;
use egui::Context;
use egui_material_icons::{MaterialIcon, icons};

use crate::app::Studio;
use crate::command::Command;
use crate::outliner::{item_icon, item_name};
use crate::shortcuts;
use crate::texts::{Language, Texts};

/// An entry of the palette.
pub(super) struct PaletteItem {
    /// What it is called in the present language.
    pub(super) name: String,
    /// What it can be found by: its names in all languages.
    pub(super) names: Vec<String>,
    /// At its right: a shortcut, or what kind of thing it is.
    pub(super) detail: String,
    pub(super) tip: Option<String>,
    pub(super) icon: MaterialIcon,
    pub(super) what: PaletteAction,
}

/// The action of an entry.
#[derive(Clone)]
pub(super) enum PaletteAction {
    Run(Command),
    Select(Item),
}

/// Commands first, then examples, recent files, and the things of the scene.
pub(super) fn all(context: &Context, studio: &Studio) -> Vec<PaletteItem> {
    let mut entries = commands(context, studio);
    entries.extend(examples(studio));
    entries.extend(recent(studio));
    entries.extend(things(studio));
    entries
}

fn commands(context: &Context, studio: &Studio) -> Vec<PaletteItem> {
    let others: Vec<Texts> = Language::ALL
        .into_iter()
        .filter(|language| *language != studio.texts.language())
        .map(Texts::new)
        .collect();
    let situation = studio.situation();
    let entries = Command::all().filter(|command| **command != Command::Palette).filter_map(|command| {
        let look = command.look()?;
        let name = situation.name(command);
        let mut names = vec![name.clone(), studio.texts.get(look.key).to_owned()];
        names.extend(others.iter().map(|texts| texts.get(look.key).to_owned()));
        let shortcut = look.shortcuts.first().map(|shortcut| shortcuts::text(context, shortcut));
        Some(PaletteItem {
            name,
            names,
            detail: shortcut.unwrap_or_default(),
            tip: situation.tip(command).map(str::to_owned),
            icon: look.icon,
            what: PaletteAction::Run(command.clone()),
        })
    });
    entries.collect()
}

fn examples(studio: &Studio) -> impl Iterator<Item = PaletteItem> {
    let detail = studio.texts.get("palette-example");
    let language = studio.texts.language();
    Example::ALL.iter().map(move |example| PaletteItem {
        name: crate::example_note::example_title(example, language).to_owned(),
        names: vec![example.title().to_owned(), example.russian_title().to_owned(), example.name.to_owned()],
        detail: detail.to_owned(),
        tip: None,
        icon: icons::ICON_PHOTO_LIBRARY,
        what: PaletteAction::Run(Command::OpenExample(example.name)),
    })
}

fn recent(studio: &Studio) -> impl Iterator<Item = PaletteItem> {
    let detail = studio.texts.get("palette-recent");
    studio.settings.recent.iter().map(move |path| {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        PaletteItem {
            names: vec![name.clone()],
            name,
            detail: detail.to_owned(),
            tip: Some(path.display().to_string()),
            icon: icons::ICON_DESCRIPTION,
            what: PaletteAction::Run(Command::OpenFile(path.clone())),
        }
    })
}

fn things(studio: &Studio) -> impl Iterator<Item = PaletteItem> {
    let scene = studio.editor.scene();
    let fixed = [Item::Camera, Item::Environment, Item::Tracing];
    let items = fixed
        .into_iter()
        .chain((0..scene.lights.len()).map(Item::Light))
        .chain((0..scene.bodies.len()).map(Item::Body))
        .chain((0..scene.materials.len()).map(Item::Material));
    let detail = studio.texts.get("palette-thing");
    items.map(move |item| {
        let name = item_name(&studio.texts, scene, item).into_owned();
        PaletteItem {
            names: vec![name.clone()],
            name,
            detail: detail.to_owned(),
            tip: None,
            icon: item_icon(scene, item),
            what: PaletteAction::Select(item),
        }
    })
}
