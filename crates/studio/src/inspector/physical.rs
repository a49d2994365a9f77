//! Materials of other models than Phong's: what they are made of, and how rough they are.

use catoptric_optics::{CLEAR, FraunhoferLines, METALS};
use catoptric_scene::format::keys;
use catoptric_scene::{Conductor, Material, Model};
use egui::{ComboBox, Ui};
use glam::DVec3;

use super::sheet::{
    ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread,
};
use super::symbol::Symbol;
use crate::texts::Texts;
use crate::widgets::number::shown;
use crate::widgets::row::control_width;
use crate::widgets::tip::tip_beside;

static CLEAR_IOR: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("ior", "edit-ior", &keys::MATERIAL, "ior").with_symbol(Symbol::Ior),
    SliderRail::Even(1.0, 3.0),
    |material| {
        let is_own = material.model == Model::Coated || material.substance.is_none();
        (is_own && matches!(material.model, Model::Dielectric | Model::Coated)).then_some(material.ior)
    },
    |material, value| material.ior = value,
);

static ABBE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("abbe", "edit-abbe", &keys::MATERIAL, "abbe"),
    SliderRail::Even(20.0, 100.0),
    |material| (material.dispersion && material.substance.is_none()).then_some(material.abbe),
    |material, value| material.abbe = value,
)
.tuned(0.1, 1);

static ATTENUATION_COLOR: ColorRow<Material> = ColorRow {
    what: RowQuantity::new("attenuation-color", "edit-attenuation", &keys::MATERIAL, "attenuation_color"),
    get: |material| (material.model == Model::Dielectric).then_some(material.attenuation_color),
    set: |material, color| material.attenuation_color = color,
};

static ATTENUATION_DISTANCE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("attenuation-distance", "edit-attenuation", &keys::MATERIAL, "attenuation_distance")
        .in_unit(Unit::Meters),
    SliderRail::None,
    |material| (material.model == Model::Dielectric).then_some(material.attenuation_distance),
    |material, value| material.attenuation_distance = value,
);

static ROUGHNESS: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("roughness", "edit-roughness", &keys::MATERIAL, "roughness"),
    SliderRail::Even(0.0, 1.0),
    |material| (!matches!(material.model, Model::Phong | Model::Matte)).then_some(material.roughness),
    |material, value| material.roughness = value,
);

static MIRROR: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("reflection", "edit-reflection", &keys::MATERIAL, "reflection")
        .with_symbol(Symbol::Reflection),
    SliderRail::Even(0.0, 1.0),
    |material| (material.model == Model::Mirror).then(|| material.reflection()),
    |material, value| material.reflection = Some(value),
);

static N: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("conductor-n", "edit-conductor", &keys::MATERIAL, "n"),
    VectorSpread::Same,
    |material| index_of(material).map(|[n, _]| n),
    |material, n| {
        if let Conductor::Index { n: own, .. } = &mut material.conductor {
            *own = n;
        }
    },
);

static K: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("conductor-k", "edit-conductor", &keys::MATERIAL, "k"),
    VectorSpread::Same,
    |material| index_of(material).map(|[_, k]| k),
    |material, k| {
        if let Conductor::Index { k: own, .. } = &mut material.conductor {
            *own = k;
        }
    },
);

fn index_of(material: &Material) -> Option<[DVec3; 2]> {
    match material.conductor {
        Conductor::Index { n, k } if material.model == Model::Conductor => Some([n, k]),
        _ => None,
    }
}

/// The message that names a model.
const fn model_key(model: Model) -> &'static str {
    match model {
        Model::Phong => "model-phong",
        Model::Dielectric => "model-dielectric",
        Model::Conductor => "model-conductor",
        Model::Mirror => "model-mirror",
        Model::Matte => "model-matte",
        Model::Coated => "model-coated",
    }
}

/// Draws the choice of the model.
pub(super) fn model_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let texts = sheet.texts();
    let model = sheet.primary.model;
    let is_mixed = sheet.things.iter().any(|material| material.model != model);
    let mut picked = None;
    sheet.plain_row(ui, "model", |_, ui| {
        let shown = if is_mixed { texts.get("material-mixed") } else { texts.get(model_key(model)) };
        let combo = ComboBox::from_id_salt("model").selected_text(shown).width(control_width(ui)).truncate();
        let list = combo.show_ui(ui, |ui| {
            for other in Model::ALL {
                let key = model_key(other);
                let response = ui.selectable_label(!is_mixed && other == model, texts.get(key));
                if tip_beside(ui, response, texts.tip(key).unwrap_or_default()).clicked() {
                    picked = Some(other);
                }
            }
        });
        list.response.accessible_name(texts.get("model"));
    });
    if let Some(model) = picked {
        sheet.change("model", "edit-model", |_, material| material.model = model);
    }
}

/// Draws what a model has besides color and ambient light.
pub(super) fn rows_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    match sheet.primary.model {
        Model::Dielectric => {
            substance_ui(ui, sheet);
            sheet.number(ui, &CLEAR_IOR, None);
            dispersion_ui(ui, sheet);
            sheet.number(ui, &ABBE, None);
            sheet.color(ui, &ATTENUATION_COLOR);
            sheet.number(ui, &ATTENUATION_DISTANCE, None);
        }
        Model::Conductor => {
            metal_ui(ui, sheet);
            sheet.vector(ui, &N);
            sheet.vector(ui, &K);
        }
        Model::Mirror => sheet.number_or(ui, &MIRROR, Some(1.0)),
        Model::Coated => sheet.number(ui, &CLEAR_IOR, None),
        Model::Phong | Model::Matte => {}
    }
    sheet.number(ui, &ROUGHNESS, None);
}

/// Water, glass, diamond …, or an index of one's own.
fn substance_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let texts = sheet.texts();
    let own = sheet.primary.substance;
    let mut picked = None;
    sheet.plain_row(ui, "substance", |_, ui| {
        let key = own.map_or_else(|| "substance-own".to_owned(), |clear| named("substance", clear.name));
        let shown_name = texts.get(&key);
        let combo = ComboBox::from_id_salt("substance")
            .selected_text(shown_name)
            .width(control_width(ui))
            .height(320.0)
            .truncate();
        let list = combo.show_ui(ui, |ui| {
            if ui.selectable_label(own.is_none(), texts.get("substance-own")).clicked() {
                picked = Some(None);
            }
            for clear in CLEAR {
                let index = shown(texts, clear.dispersion.index(FraunhoferLines::D), 3);
                let text = format!("{}  {index}", texts.get(&named("substance", clear.name)));
                let response = ui.selectable_label(own == Some(clear), text);
                if tip_beside(ui, response, clear.source).clicked() {
                    picked = Some(Some(clear));
                }
            }
        });
        list.response.accessible_name(texts.get("substance"));
    });
    if let Some(substance) = picked {
        sheet.change("substance", "edit-substance", |_, material| {
            // One's own index begins where the substance was.
            material.ior = material.ior();
            material.substance = substance;
        });
    }
}

fn metal_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let texts = sheet.texts();
    let own = sheet.primary.conductor;
    let mut picked = None;
    sheet.plain_row(ui, "metal", |_, ui| {
        let key = match own {
            Conductor::Metal(metal) => named("metal", metal.name),
            Conductor::Index { .. } => "metal-own".to_owned(),
        };
        let shown_name = texts.get(&key);
        let combo = ComboBox::from_id_salt("metal")
            .selected_text(shown_name)
            .width(control_width(ui))
            .height(320.0)
            .truncate();
        let list = combo.show_ui(ui, |ui| {
            for metal in METALS {
                let is_it = own == Conductor::Metal(metal);
                let response = ui.selectable_label(is_it, texts.get(&named("metal", metal.name)));
                if tip_beside(ui, response, metal.source).clicked() {
                    picked = Some(Conductor::Metal(metal));
                }
            }
            let is_own = matches!(own, Conductor::Index { .. });
            if ui.selectable_label(is_own, texts.get("metal-own")).clicked() && !is_own {
                picked = Some(index_like(own));
            }
        });
        list.response.accessible_name(texts.get("metal"));
    });
    if let Some(conductor) = picked {
        sheet.change("metal", "edit-conductor", |_, material| material.conductor = conductor);
    }
}

/// Indices of one's own that begin with those of a metal, at the wavelengths at which screens are red, green and blue.
fn index_like(conductor: Conductor) -> Conductor {
    match conductor {
        Conductor::Metal(metal) => {
            let [r, g, b] = [630.0, 532.0, 465.0].map(|nanometers| metal.index(nanometers));
            let rounded = |value: f64| (value * 1e3).round() / 1e3;
            let of = |part: usize| {
                DVec3::from([r, g, b].map(|index| rounded(index.get(part).copied().unwrap_or(1.0))))
            };
            Conductor::Index { n: of(0).max(DVec3::splat(0.001)), k: of(1) }
        }
        own @ Conductor::Index { .. } => own,
    }
}

fn dispersion_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    let mut is_on = sheet.primary.dispersion;
    let mut is_clicked = false;
    let texts = sheet.texts();
    sheet.plain_row(ui, "dispersion", |_, ui| {
        let response = ui.checkbox(&mut is_on, texts.get("dispersion-words"));
        is_clicked = tip_beside(ui, response, texts.tip("dispersion").unwrap_or_default()).clicked();
    });
    if is_clicked {
        sheet.change("dispersion", "edit-dispersion", |_, material| material.dispersion = is_on);
    }
}

/// The message that names a substance or metal of the tables.
fn named(what: &str, name: &str) -> String {
    format!("{what}-{name}")
}

/// What a material of such a model does, in a sentence.
pub(crate) fn told(texts: &Texts, model: Model) -> &str {
    texts.tip(model_key(model)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::Language;

    #[test]
    fn all_substances_and_metals_have_names() {
        for language in [Language::English, Language::Russian] {
            let texts = Texts::new(language);
            let substances = CLEAR.iter().map(|clear| named("substance", clear.name));
            for key in substances.chain(METALS.iter().map(|metal| named("metal", metal.name))) {
                assert_ne!(texts.get(&key), key, "{language:?}");
            }
        }
    }

    #[test]
    fn indices_of_ones_own_begin_where_the_metal_was() {
        for metal in METALS {
            let material = Material {
                model: Model::Conductor,
                conductor: index_like(Conductor::Metal(metal)),
                ..Material::default()
            };
            let measured = metal.reflectance(1.0, 1.0).into_iter().fold(0.0, f64::max).min(1.0);
            assert!((material.reflects().straight - measured).abs() < 0.06, "{}", metal.name);
        }
    }
}
