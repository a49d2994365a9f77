//! Materials: the kind of reflection, every coefficient, whether bodies share it, and the formula.

use std::sync::Arc;

use catoptric_editor::{Action, Editor, Label, PartPath, RefusedChange};
use catoptric_scene::format::keys;
use catoptric_scene::{FresnelTerm, Image, Material, MaterialChoice, Mirror, Model, Phong, Scene, ScenePart};
use egui::{Button, ComboBox, Id, TextStyle, Ui, vec2};
use egui_material_icons::icons::ICON_GRID_VIEW;

use super::kinds::{MEDIA, PRESETS, kind_of};
use super::material_owner::{MaterialOwner, apply, home_of, home_of_part, homes_of, material_at};
use super::sheet::{ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail};
use super::symbol::Symbol;
use super::{InspectorState, curve, energy, formula, header, pattern, physical};
use crate::base::texts::Texts;
use crate::base::widgets::choice::{ChoiceItem, choice_ui};
use crate::base::widgets::number::{HEIGHT, shown};
use crate::base::widgets::row::{GAP, control_width};
use crate::base::widgets::section::section;
use crate::base::widgets::tip::tip_beside;
use crate::base::widgets::{ICON_BUTTON, explained_icon_button};
use crate::panels::outliner::part_name;
use crate::state::command::{Command, WindowCommand};
use crate::state::context::Cx;
use crate::state::layout::Pane;

/// The least width of the list of materials beside a button, points.
const LEAST_LIST: f32 = 110.0;

const UNIT_RAIL: SliderRail = SliderRail::Even(0.0, 1.0);

const fn coefficient(
    key: &'static str,
    edit: &'static str,
    name: &'static str,
    symbol: Symbol,
) -> RowQuantity {
    RowQuantity::new(key, edit, &keys::MATERIAL, name).with_symbol(symbol)
}

static COLOR: ColorRow<Material> = ColorRow {
    what: coefficient("material-color", "edit-color", "color", Symbol::Color),
    get: |material| {
        material.pattern().filter(|pattern| pattern.texture.is_none()).map(|pattern| pattern.color)
    },
    set: |material, color| {
        if let Some(pattern) = material.pattern_mut() {
            pattern.color = color;
        }
    },
};

static AMBIENT: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("ambient", "edit-ambient", "ambient", Symbol::Ambient),
    UNIT_RAIL,
    Material::ambient,
    |material, value| {
        if let Some(ambient) = material.ambient_mut() {
            *ambient = value;
        }
    },
);

static DIFFUSE: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("diffuse", "edit-diffuse", "diffuse", Symbol::Diffuse),
    UNIT_RAIL,
    |material| material.as_phong().map(|phong| phong.diffuse),
    |material, value| edit_phong(material, |phong| phong.diffuse = value),
);

static SPECULAR: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("specular", "edit-specular", "specular", Symbol::Specular),
    UNIT_RAIL,
    |material| material.as_phong().map(|phong| phong.specular),
    |material, value| edit_phong(material, |phong| phong.specular = value),
);

static SHININESS: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("shininess", "edit-shininess", "shininess", Symbol::Shininess),
    SliderRail::Logarithmic(1.0, 1000.0),
    |material| material.as_phong().map(|phong| phong.shininess),
    |material, value| edit_phong(material, |phong| phong.shininess = value),
)
.tuned(0.5, 1);

pub(super) static REFLECTION: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("reflection", "edit-reflection", "reflection", Symbol::Reflection),
    UNIT_RAIL,
    Material::reflection,
    |material, value| {
        if let Material::Phong(Phong { reflection, .. }) | Material::Mirror(Mirror { reflection, .. }) =
            material
        {
            *reflection = Some(value);
        }
    },
);

static TRANSMISSION: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("transmission", "edit-transmission", "transmission", Symbol::Transmission),
    UNIT_RAIL,
    |material| material.as_phong().map(|phong| phong.transmission),
    |material, value| edit_phong(material, |phong| phong.transmission = value),
);

/// The index of refraction, unless it is a substance's.
pub(super) static IOR: NumberRow<Material> = NumberRow::<Material>::new(
    coefficient("ior", "edit-ior", "ior", Symbol::Ior),
    SliderRail::Even(1.0, 3.0),
    |material| match material {
        Material::Dielectric(dielectric) if dielectric.index.substance().is_some() => None,
        _ => material.ior(),
    },
    |material, value| {
        if let Some(ior) = material.ior_mut() {
            *ior = value;
        }
    },
);

pub(super) static TINT: ColorRow<Material> = ColorRow {
    what: coefficient("tint", "edit-tint", "tint", Symbol::Tint),
    get: Material::tint,
    set: |material, color| {
        if let Some(tint) = material.tint_mut() {
            *tint = color;
        }
    },
};

fn edit_phong(material: &mut Material, edit: impl FnOnce(&mut Phong)) {
    material.as_phong_mut().map(edit);
}

/// The edited materials, the primary one first.
#[derive(Clone, Copy)]
struct MaterialGroup<'s> {
    homes: &'s [MaterialOwner],
    /// What is made of them; `None` when the material itself is selected.
    chooser: Option<MaterialChooser<'s>>,
    /// What is edited, for the history.
    subject: &'s str,
}

/// Bodies that are made of a material, or a part that is.
#[derive(Clone, Copy)]
struct MaterialChooser<'s> {
    /// The bodies; none for a part.
    bodies: &'s [usize],
    /// The material of the primary one; `None` for a part that is made of what the whole is.
    choice: Option<&'s MaterialChoice>,
    is_free: bool,
}

/// Draws the values of a named material.
pub(super) fn named_ui(ui: &mut Ui, cx: &mut Cx<'_>, memory: &mut InspectorState, index: usize) {
    let scene = Arc::clone(cx.editor.scene());
    let part = ScenePart::Material(index);
    if let Some(item) = cx.editor.edited().item(part) {
        header::header_ui(ui, cx, item);
    }
    let name = part.name(&scene);
    ui.horizontal(|ui| {
        browse_ui(ui, cx);
        header::hint(ui, &used_by(cx, &scene, name));
    });
    sheet_ui(
        ui,
        cx,
        memory,
        &scene,
        &MaterialGroup { homes: &[MaterialOwner::Named(index)], chooser: None, subject: name },
    );
}

/// Draws the material of some bodies, the primary one first.
pub(super) fn of_bodies_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    memory: &mut InspectorState,
    scene: &Arc<Scene>,
    bodies: &[usize],
    subject: &str,
) {
    let homes = homes_of(scene, bodies);
    let own = match homes.as_slice() {
        [MaterialOwner::Named(index)] => Some(part_name(cx.texts, scene, ScenePart::Material(*index))),
        _ => None,
    };
    let subject = own.as_deref().unwrap_or(subject);
    let first = bodies.first().and_then(|index| Some((*index, scene.bodies.get(*index)?)));
    let chooser = first.map(|(index, body)| MaterialChooser {
        bodies,
        choice: Some(&body.material),
        is_free: !ScenePart::Body(index).is_locked(scene),
    });
    sheet_ui(ui, cx, memory, scene, &MaterialGroup { homes: &homes, chooser, subject });
}

/// Draws the material of a part: its own, or the notice that it is that of the whole.
pub(super) fn of_part_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    memory: &mut InspectorState,
    (index, path): (usize, PartPath),
    subject: &str,
) {
    let scene = Arc::clone(cx.editor.scene());
    let Some((body, part)) = scene.bodies.get(index).and_then(|body| Some((body, path.part(body)?))) else {
        return;
    };
    let choice = part.material.as_ref();
    let chooser = MaterialChooser { bodies: &[], choice, is_free: !body.locked };
    if let Some(home) = home_of_part(&scene, index, path) {
        let own = match home {
            MaterialOwner::Named(named) => Some(part_name(cx.texts, &scene, ScenePart::Material(named))),
            MaterialOwner::Body(_) | MaterialOwner::Part(..) => None,
        };
        let subject = own.as_deref().unwrap_or(subject);
        let group = MaterialGroup { homes: &[home], chooser: Some(chooser), subject };
        return sheet_ui(ui, cx, memory, &scene, &group);
    }
    let texts = cx.texts;
    let summary = texts.get("material-of-whole");
    section(ui, "material", texts.get("section-material"), summary, chooser.is_free, |ui| {
        share_ui(ui, cx, &scene, &chooser);
        header::hint(ui, texts.get("part-material-hint"));
    });
}

fn used_by(cx: &Cx<'_>, scene: &Scene, name: &str) -> String {
    let count = scene.bodies.iter().filter(|body| body.uses_material(name)).count();
    cx.texts.with("material-used-by", &[("count", count.into())])
}

/// The button that opens the panel of materials.
fn browse_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let command = Command::Window(WindowCommand::TogglePane(Pane::Materials));
    let (name, tip) =
        (cx.situation().label(&command), cx.situation().tip(&command).unwrap_or_default().to_owned());
    if explained_icon_button(ui, ICON_GRID_VIEW, &name, &format!("{name}\n{tip}"), false).clicked() {
        cx.run(command);
    }
}

/// The width of a button with this text.
fn natural_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::PLACEHOLDER);
    (galley.size().x + 2.0 * ui.spacing().button_padding.x).ceil() + 1.0
}

/// Whose material it is: a list of the shared ones, and buttons that share it or make it the body's own.
fn share_ui(ui: &mut Ui, cx: &mut Cx<'_>, scene: &Scene, chooser: &MaterialChooser<'_>) {
    let texts = cx.texts;
    let MaterialChooser { bodies, choice, .. } = *chooser;
    let is_part = bodies.is_empty();
    let is_mixed = bodies.iter().filter_map(|&index| scene.bodies.get(index)).any(|body| {
        match (&body.material, choice) {
            (MaterialChoice::Named(a), Some(MaterialChoice::Named(b))) => a != b,
            (MaterialChoice::Inline(_), Some(MaterialChoice::Inline(_))) => false,
            _ => true,
        }
    });
    let (shown, is_own) = match choice {
        _ if is_mixed => (texts.get("material-mixed"), false),
        None => (texts.get("material-of-whole"), false),
        Some(MaterialChoice::Named(name)) => (name.as_str(), false),
        Some(MaterialChoice::Inline(_)) => (texts.get("material-own"), true),
    };
    let mut action = None;
    let key = if is_own { "material-share" } else { "material-make-own" };
    let text = texts.get(key);
    let button_width = natural_width(ui, text);
    let is_beside = ui.available_width() >= ICON_BUTTON + LEAST_LIST + button_width + 2.0 * GAP;
    let share = |ui: &mut Ui, width: f32| {
        let response = ui.add_sized(vec2(width, HEIGHT), Button::new(text).truncate());
        tip_beside(ui, response, texts.tip(key).unwrap_or_default()).clicked()
    };
    let mut is_clicked = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        browse_ui(ui, cx);
        let room = ui.available_width() - if is_beside { button_width + GAP } else { 0.0 };
        let combo = ComboBox::from_id_salt("material").selected_text(shown).truncate();
        let list = combo.width(room).show_ui(ui, |ui| {
            let is_whole = choice.is_none();
            if is_part && ui.selectable_label(is_whole, texts.get("material-of-whole")).clicked() && !is_whole
            {
                action = Some(Action::MaterialOfWhole);
            }
            if ui.selectable_label(is_own, texts.get("material-own")).clicked() && !is_own {
                action = Some(Action::MakeMaterialUnique);
            }
            for named in &scene.materials {
                let is_it =
                    !is_mixed && matches!(choice, Some(MaterialChoice::Named(name)) if *name == named.name);
                if ui.selectable_label(is_it, &named.name).clicked() && !is_it {
                    action = Some(Action::AssignMaterial(MaterialChoice::Named(named.name.clone())));
                }
            }
        });
        let name = texts.get("material-choice");
        let tip = texts.tip("material-choice").unwrap_or_default();
        tip_beside(ui, list.response.accessible_name(name), tip);
        if is_beside {
            is_clicked = share(ui, button_width);
        }
    });
    if !is_beside {
        is_clicked = share(ui, ui.available_width());
    }
    if is_clicked {
        action = Some(if is_own { Action::ShareMaterial } else { Action::MakeMaterialUnique });
    }
    if let Some(action) = action {
        cx.run(Command::Edit(action));
    }
    if let (Some(MaterialChoice::Named(name)), false) = (choice, is_mixed) {
        header::hint(ui, &used_by(cx, scene, name));
    }
}

/// Draws the values of some materials, the primary one first, and the formula.
fn sheet_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    memory: &mut InspectorState,
    scene: &Arc<Scene>,
    made: &MaterialGroup<'_>,
) {
    let MaterialGroup { homes, chooser, subject } = *made;
    let things: Vec<&Material> = homes.iter().filter_map(|&home| material_at(scene, home)).collect();
    let (Some(&primary), Some(home)) = (things.first(), homes.first()) else { return };
    let owner = home.key(cx.editor.edited());
    let mut sheet = PropertySheet {
        primary,
        things,
        place: home.place(),
        subject: subject.to_owned(),
        id: Id::unique(("inspector-material", owner)),
        is_free: chooser.is_none_or(|chooser| chooser.is_free),
        apply: &|editor, label, change| apply(editor, homes, label, change),
        cx,
        memory,
    };
    let texts = sheet.texts();
    match chooser {
        Some(chooser) => {
            let summary = match chooser.choice {
                Some(MaterialChoice::Named(name)) => name.as_str(),
                _ => texts.get("material-own"),
            };
            section(ui, "material", texts.get("section-material"), summary, sheet.is_free, |ui| {
                share_ui(ui, sheet.cx, scene, &chooser);
                rows_ui(ui, &mut sheet, homes);
            });
        }
        None => rows_ui(ui, &mut sheet, homes),
    }
    section(ui, "formula", texts.get("section-formula"), "", true, |ui| {
        if let Material::Phong(phong) = primary {
            formula::material_ui(ui, texts, sheet.memory, phong, scene);
        } else {
            header::hint(ui, physical::told(texts, primary.model()));
            formula::law_ui(ui, texts, sheet.memory, primary);
            let seen = sheet.cx.view.seen.filter(|seen| homes.first() == home_of(scene, seen.body).as_ref());
            curve::curve_ui(ui, texts, primary, &mut sheet.memory.curves, seen);
        }
    });
}

fn rows_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, homes: &[MaterialOwner]) {
    if let Some(model) = physical::model_ui(ui, sheet) {
        change_model(sheet, homes, model);
    }
    if let Material::Phong(phong) = sheet.primary {
        kinds_ui(ui, sheet);
        ground_ui(ui, sheet);
        sheet.number(ui, &DIFFUSE, None);
        sheet.number(ui, &SPECULAR, None);
        sheet.number(ui, &SHININESS, None);
        reflection_ui(ui, sheet, phong);
        sheet.number(ui, &TRANSMISSION, None);
        ior_ui(ui, sheet, phong);
        sheet.color(ui, &TINT);
        fresnel_ui(ui, sheet, phong);
    } else {
        ground_ui(ui, sheet);
        physical::rows_ui(ui, sheet);
    }
    pattern::solid_ui(ui, sheet);
    energy::energy_ui(ui, sheet.texts(), sheet.primary);
}

/// Draws color, texture and ambient coefficient, as far as the model has them.
fn ground_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    sheet.color(ui, &COLOR);
    pattern::texture_ui(ui, sheet);
    sheet.number(ui, &AMBIENT, None);
}

/// Changes the model of all materials. Each has what it had when it was last of that model.
fn change_model(sheet: &mut PropertySheet<'_, '_, Material>, homes: &[MaterialOwner], model: Model) {
    let replaced = &mut sheet.memory.replaced;
    let edited = sheet.cx.editor.edited();
    let owners = homes.iter().filter_map(|home| home.key(edited));
    let changed: Vec<Material> =
        owners.zip(&sheet.things).map(|(owner, material)| replaced.replace(owner, material, model)).collect();
    sheet.change("model", "edit-model", |place, material| {
        if let Some(changed) = changed.get(place) {
            material.clone_from(changed);
        }
    });
}

fn kinds_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let texts = sheet.texts();
    let kind_of = |material: &Material| material.as_phong().and_then(kind_of).map(|preset| preset.kind);
    let kind = kind_of(sheet.primary);
    let is_mixed = sheet.things.iter().any(|material| kind_of(material) != kind);
    let mut choices: Vec<ChoiceItem<'_, _>> = PRESETS
        .iter()
        .map(|preset| ChoiceItem {
            value: Some(preset.kind),
            text: texts.get(preset.key),
            tip: texts.tip(preset.key).unwrap_or_default(),
            is_enabled: true,
        })
        .collect();
    choices.push(ChoiceItem {
        value: None,
        text: texts.get("kind-custom"),
        tip: texts.tip("kind-custom").unwrap_or_default(),
        is_enabled: false,
    });
    let id = sheet.id.with("kind");
    let chosen = (!is_mixed).then_some(kind);
    let width = ui.available_width();
    let picked = choice_ui(ui, id, texts.get("kind"), width, &choices, chosen).flatten();
    if let Some(preset) = PRESETS.iter().find(|preset| Some(preset.kind) == picked) {
        sheet.change("kind", "edit-kind", |_, material| edit_phong(material, |phong| preset.give(phong)));
    }
    sheet.note(ui, "kind");
}

/// k_r, which is k_s as long as it has no value of its own.
fn reflection_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, phong: &Phong) {
    let mut follows = phong.reflection.is_none();
    ui.add_enabled_ui(!follows, |ui| sheet.number_or(ui, &REFLECTION, None));
    let texts = sheet.texts();
    let mut is_clicked = false;
    sheet.marked_row(ui, "reflection-same", "k_r = k_s", |_, ui| {
        let response = ui.checkbox(&mut follows, texts.get("reflection-same"));
        let response = tip_beside(ui, response, texts.tip("reflection-same").unwrap_or_default());
        is_clicked = response.clicked();
    });
    if is_clicked {
        sheet.change("reflection-same", "edit-reflection", |_, material| {
            edit_phong(material, |phong| {
                phong.reflection = if follows { None } else { Some(phong.reflection()) };
            });
        });
    }
}

/// How k_r and k_t depend on the angle, of clear bodies.
fn fresnel_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, phong: &Phong) {
    if phong.transmission <= 0.0 {
        return;
    }
    let choices = [(FresnelTerm::Constant, "fresnel-constant"), (FresnelTerm::Schlick, "fresnel-schlick")];
    let other = |material: &&Material| material.as_phong().is_none_or(|other| other.fresnel != phong.fresnel);
    let chosen = (!sheet.things.iter().any(other)).then_some(phong.fresnel);
    if let Some(term) = sheet.choice(ui, "fresnel", &choices, chosen) {
        sheet.change("fresnel", "edit-fresnel", |_, material| {
            edit_phong(material, |phong| phong.fresnel = term);
        });
    }
}

/// η, with a list of media.
fn ior_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, phong: &Phong) {
    sheet.number(ui, &IOR, None);
    let ior = phong.ior;
    let texts = sheet.texts();
    let medium = MEDIA.iter().find(|medium| (medium.ior - ior).abs() < 5e-4);
    let mut picked = None;
    sheet.plain_row(ui, "medium", |_, ui| {
        let name = medium.map_or_else(|| texts.get("medium-other"), |medium| texts.get(medium.key));
        let combo = ComboBox::from_id_salt("medium")
            .selected_text(name)
            .width(control_width(ui))
            .height(280.0)
            .truncate();
        let list = combo.show_ui(ui, |ui| {
            for medium in &MEDIA {
                let text = format!("{}  {}", texts.get(medium.key), shown(texts, medium.ior, 3));
                if ui.selectable_label((medium.ior - ior).abs() < 5e-4, text).clicked() {
                    picked = Some(medium.ior);
                }
            }
        });
        list.response.accessible_name(texts.get("medium"));
    });
    if let Some(value) = picked {
        sheet.change("medium", "edit-ior", |_, material| edit_phong(material, |phong| phong.ior = value));
    }
}

/// Puts a picture on what is selected.
///
/// # Errors
/// When a scene cannot have it.
pub(crate) fn give_texture(editor: &mut Editor, texts: &Texts, image: &Image) -> Result<bool, RefusedChange> {
    let scene = Arc::clone(editor.scene());
    let bodies: Vec<usize> = editor.selected_bodies().collect();
    // A part of the material of the whole has none that could be changed alone.
    let of_part = editor.selected_part().and_then(|(index, path)| home_of_part(&scene, index, path));
    let homes = match editor.primary_part() {
        _ if of_part.is_some() => of_part.into_iter().collect(),
        Some(ScenePart::Material(index)) => vec![MaterialOwner::Named(index)],
        _ => homes_of(&scene, &bodies),
    };
    let subject = editor.primary_part().map(|part| part_name(texts, &scene, part)).unwrap_or_default();
    apply(editor, &homes, Label::new("edit-texture", subject), &mut |_, material| {
        if let Some(pattern) = material.pattern_mut() {
            pattern.texture = Some(image.clone());
        }
    })
}
