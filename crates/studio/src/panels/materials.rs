//! The materials to choose from: those of the scene and many others, each with a traced picture.

mod card;
mod grid;
mod presets;
mod preview;

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_editor::{Action, Label};
use catoptric_scene::{Material, MaterialChoice, Scene, ScenePart};
use egui::{Align, Id, Key, Layout, RichText, Ui, vec2};
use egui_material_icons::icons::ICON_LINK;

use crate::base::theme;
use crate::base::thumbnails::Thumbnails;
use crate::base::widgets::explained_icon_button;
use crate::base::widgets::filter::filter_field;
use crate::panels::outliner::part_name;
use crate::state::command::{Command, WindowCommand};
use crate::state::context::Cx;
use crate::state::layout::Pane;
use presets::PRESETS;
use preview::MaterialPreview;

/// The width of the field above the pictures, points; where less than twice this is there, it takes a line of its own.
const FILTER: f32 = 240.0;

/// A section of the list of materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MaterialSection {
    /// What bodies of this scene share.
    Scene,
    /// Phong's and Whitted's models.
    Constant,
    Metals,
    Clear,
    Coats,
    Rough,
}

impl MaterialSection {
    const ALL: [Self; 6] = [Self::Scene, Self::Constant, Self::Metals, Self::Clear, Self::Coats, Self::Rough];

    /// The message that names it.
    const fn key(self) -> &'static str {
        match self {
            Self::Scene => "materials-scene",
            Self::Constant => "materials-constant",
            Self::Metals => "materials-metals",
            Self::Clear => "materials-clear",
            Self::Coats => "materials-coats",
            Self::Rough => "materials-rough",
        }
    }
}

/// A material to choose: the scene's or a preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum MaterialItem {
    /// The scene's material at this place.
    Scene(usize),
    /// The preset at this place.
    Preset(usize),
}

impl MaterialItem {
    fn material(self, scene: &Scene) -> Option<&Material> {
        match self {
            Self::Scene(place) => scene.materials.get(place).map(|named| &named.material),
            Self::Preset(place) => PRESETS.get(place).map(|preset| &preset.material),
        }
    }

    fn section(self) -> MaterialSection {
        match self {
            Self::Scene(_) => MaterialSection::Scene,
            Self::Preset(place) => {
                PRESETS.get(place).map_or(MaterialSection::Constant, |preset| preset.section)
            }
        }
    }

    /// What a body is given.
    fn choice(self, scene: &Scene) -> Option<MaterialChoice> {
        match self {
            Self::Scene(place) => Some(MaterialChoice::Named(scene.materials.get(place)?.name.clone())),
            Self::Preset(_) => self.material(scene).map(|own| MaterialChoice::Inline(Box::new(own.clone()))),
        }
    }
}

/// The state of the panel.
#[derive(Default)]
pub(crate) struct MaterialBrowser {
    filter: String,
    found: Option<MaterialFilterResult>,
    /// The thing that the keys have come to, among those that were found.
    cursor: usize,
    /// Whether it is to be brought into view.
    scrolls: bool,
    /// Whether the list is to have the keys.
    wants_focus: bool,
    thumbnails: Thumbnails<MaterialPreview>,
    /// What materials of the scene were by name when there last was a picture: it stays until there is one of what they
    /// are now.
    seen: HashMap<String, MaterialPreview>,
}

/// The materials that pass a filter, with the document and filter they belong to.
struct MaterialFilterResult {
    key: (u64, String),
    things: Vec<MaterialItem>,
}

impl MaterialBrowser {
    /// The panel was asked for: arrows choose at once.
    pub(crate) fn take_focus(&mut self) {
        (self.wants_focus, self.scrolls) = (true, true);
    }

    /// The device of the window is another.
    pub(crate) fn forget_textures(&mut self) {
        self.thumbnails.forget_textures();
    }

    /// How many materials there is a picture of.
    pub(crate) fn pictured(&self) -> usize {
        self.thumbnails.count()
    }

    /// Looks for what fits the filter, if that or the document has changed.
    fn find(&mut self, cx: &Cx<'_>) {
        let key = (cx.editor.revision(), self.filter.trim().to_lowercase());
        if self.found.as_ref().is_some_and(|found| found.key == key) {
            return;
        }
        let materials = cx.editor.scene().materials.iter().enumerate();
        let of_scene = materials
            .filter(|(_, named)| key.1.is_empty() || presets::has(&named.name.to_lowercase(), &key.1));
        let mut things: Vec<MaterialItem> = of_scene.map(|(place, _)| MaterialItem::Scene(place)).collect();
        things.extend(presets::found(&key.1).map(MaterialItem::Preset));
        if self.found.as_ref().is_some_and(|found| found.key.1 != key.1) {
            (self.cursor, self.scrolls) = (0, true);
        }
        self.cursor = self.cursor.min(things.len().saturating_sub(1));
        self.found = Some(MaterialFilterResult { key, things });
    }
}

/// The list of materials has the keyboard's focus under this id while it is used.
pub(crate) fn list_id() -> Id {
    Id::unique("list of materials")
}

/// Draws the materials; one that is chosen is given to what is selected.
pub(crate) fn materials_ui(ui: &mut Ui, cx: &mut Cx<'_>, browser: &mut MaterialBrowser) {
    head_ui(ui, cx, browser);
    browser.find(cx);
    if let Some(thing) = grid::grid_ui(ui, cx, browser) {
        give(cx, thing);
    }
}

/// The field that finds by name, and what a click does.
fn head_ui(ui: &mut Ui, cx: &mut Cx<'_>, browser: &mut MaterialBrowser) {
    let is_wide = ui.available_width() > 2.0 * FILTER;
    if is_wide {
        ui.horizontal(|ui| {
            filter_ui(ui, cx, browser, FILTER);
            target_ui(ui, cx);
        });
    } else {
        filter_ui(ui, cx, browser, ui.available_width());
        ui.horizontal(|ui| target_ui(ui, cx));
    }
    ui.add_space(2.0);
}

fn filter_ui(ui: &mut Ui, cx: &mut Cx<'_>, browser: &mut MaterialBrowser, width: f32) {
    let texts = cx.texts;
    let tip = texts.tip("materials-filter").unwrap_or_default();
    let words = [texts.get("materials-filter"), tip, texts.get("outliner-filter-clear")];
    let response = filter_field(ui, &mut browser.filter, width, words);
    let (escape, enter, down) = ui.input(|input| {
        let pressed = |key| input.key_pressed(key);
        (pressed(Key::Escape), pressed(Key::Enter), pressed(Key::ArrowDown))
    });
    if response.lost_focus() && escape {
        cx.run(WindowCommand::TogglePane(Pane::Materials));
    } else if response.lost_focus() && enter {
        browser.find(cx);
        let found = browser.found.as_ref();
        if let Some(thing) = found.and_then(|found| found.things.get(browser.cursor)) {
            give(cx, *thing);
        }
        browser.wants_focus = true;
    } else if response.has_focus() && down {
        browser.wants_focus = true;
    }
}

/// What is given a material that is clicked, and the button that shares it.
fn target_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let palette = theme::palette(ui.visuals());
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let share = Command::Edit(Action::ShareMaterial);
        let situation = cx.situation();
        let (name, tip) = (situation.label(&share), situation.tip(&share).unwrap_or_default());
        let is_clicked = ui.add_enabled_ui(situation.can(&share), |ui| {
            explained_icon_button(ui, ICON_LINK, &name, &format!("{name}\n{tip}"), false).clicked()
        });
        if is_clicked.inner {
            cx.run(share);
        }
        ui.allocate_ui_with_layout(
            vec2(ui.available_width(), 22.0),
            Layout::left_to_right(Align::Center),
            |ui| {
                let (text, is_ready) = target(cx);
                let color = if is_ready { palette.weak } else { palette.warning };
                ui.add(egui::Label::new(RichText::new(text).color(color).size(12.5)).truncate());
            },
        );
    });
}

/// What a click changes, in words, and whether there is something.
fn target(cx: &Cx<'_>) -> (String, bool) {
    let scene = cx.editor.scene();
    let bodies: Vec<usize> = cx.editor.selected_bodies().take(2).collect();
    let material = cx.editor.primary_part().filter(|part| matches!(part, ScenePart::Material(_)));
    match (bodies.as_slice(), material) {
        ([body], _) => {
            let name = part_name(cx.texts, scene, ScenePart::Body(*body)).into_owned();
            (cx.texts.with("materials-for-body", &[("name", name.into())]), true)
        }
        ([_, ..], _) => {
            let count = cx.editor.selected_bodies().count();
            (cx.texts.with("materials-for-bodies", &[("count", count.into())]), true)
        }
        ([], Some(part)) => {
            let name = part.name(scene).to_owned();
            (cx.texts.with("materials-for-material", &[("name", name.into())]), true)
        }
        ([], None) => (cx.t("materials-for-none").to_owned(), false),
    }
}

/// Gives the selected bodies a material: one of the scene is shared, a preset becomes their own. If materials are
/// selected instead, they become what the preset is.
fn give(cx: &mut Cx<'_>, thing: MaterialItem) {
    let scene = Arc::clone(cx.editor.scene());
    let materials: Vec<usize> = cx.editor.selected_materials().collect();
    let is_for_bodies = cx.editor.selected_bodies().next().is_some();
    match (thing, thing.material(&scene)) {
        (MaterialItem::Preset(_), Some(preset)) if !is_for_bodies && !materials.is_empty() => {
            cx.editor.settle();
            let subject = match materials.as_slice() {
                [only] => ScenePart::Material(*only).name(&scene).to_owned(),
                _ => String::new(),
            };
            // It can be refused by no limit: presets are materials that files can hold.
            let _ = cx.editor.change(Label::new("edit-assign-material", subject), |scene| {
                for place in &materials {
                    if let Some(named) = scene.materials.get_mut(*place) {
                        named.material = preset.clone();
                    }
                }
            });
            cx.editor.settle();
        }
        _ => {
            if let Some(choice) = thing.choice(&scene) {
                cx.run(Command::Edit(Action::AssignMaterial(choice)));
            }
        }
    }
}
