//! Materials of other models than Phong's: what they are made of, and how rough they are.

use catoptric_optics::{CLEAR, FraunhoferLines, METALS};
use catoptric_scene::format::keys;
use catoptric_scene::{Conductor, Dielectric, Material, MetalOptics, Model, RefractiveIndex};
use egui::{ComboBox, Ui};
use glam::DVec3;

use super::material::{IOR, REFLECTION, TINT};
use super::sheet::{
    ColorRow, NumberRow, PropertySheet, RowQuantity, SliderRail, Unit, VectorRow, VectorSpread,
};
use crate::base::texts::Texts;
use crate::base::widgets::number::shown;
use crate::base::widgets::row::control_width;
use crate::base::widgets::tip::tip_beside;

static ABBE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("abbe", "edit-abbe", &keys::MATERIAL, "abbe"),
    SliderRail::Even(20.0, 100.0),
    |material| match dielectric(material)? {
        Dielectric { index: RefractiveIndex::Own { abbe, .. }, dispersion: true, .. } => Some(*abbe),
        _ => None,
    },
    |material, value| {
        if let Material::Dielectric(Dielectric { index: RefractiveIndex::Own { abbe, .. }, .. }) = material {
            *abbe = value;
        }
    },
)
.tuned(0.1, 1);

static ATTENUATION_COLOR: ColorRow<Material> = ColorRow {
    what: RowQuantity::new("attenuation-color", "edit-attenuation", &keys::MATERIAL, "attenuation_color"),
    get: |material| dielectric(material).map(|dielectric| dielectric.attenuation.color),
    set: |material, color| edit_dielectric(material, |dielectric| dielectric.attenuation.color = color),
};

static ATTENUATION_DISTANCE: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("attenuation-distance", "edit-attenuation", &keys::MATERIAL, "attenuation_distance")
        .in_unit(Unit::Meters),
    SliderRail::None,
    |material| dielectric(material).map(|dielectric| dielectric.attenuation.distance),
    |material, value| edit_dielectric(material, |dielectric| dielectric.attenuation.distance = value),
);

static ROUGHNESS: NumberRow<Material> = NumberRow::<Material>::new(
    RowQuantity::new("roughness", "edit-roughness", &keys::MATERIAL, "roughness"),
    SliderRail::Even(0.0, 1.0),
    Material::roughness,
    |material, value| {
        if let Some(roughness) = material.roughness_mut() {
            *roughness = value;
        }
    },
);

static N: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("conductor-n", "edit-conductor", &keys::MATERIAL, "n"),
    VectorSpread::Same,
    |material| index_of(material).map(|[n, _]| n),
    |material, value| {
        if let Material::Conductor(Conductor { metal: MetalOptics::Index { n, .. }, .. }) = material {
            *n = value;
        }
    },
);

static K: VectorRow<Material> = VectorRow::<Material>::new(
    RowQuantity::new("conductor-k", "edit-conductor", &keys::MATERIAL, "k"),
    VectorSpread::Same,
    |material| index_of(material).map(|[_, k]| k),
    |material, value| {
        if let Material::Conductor(Conductor { metal: MetalOptics::Index { k, .. }, .. }) = material {
            *k = value;
        }
    },
);

fn dielectric(material: &Material) -> Option<&Dielectric> {
    match material {
        Material::Dielectric(dielectric) => Some(dielectric),
        _ => None,
    }
}

fn edit_dielectric(material: &mut Material, edit: impl FnOnce(&mut Dielectric)) {
    if let Material::Dielectric(dielectric) = material {
        edit(dielectric);
    }
}

fn index_of(material: &Material) -> Option<[DVec3; 2]> {
    match material {
        Material::Conductor(Conductor { metal: MetalOptics::Index { n, k }, .. }) => Some([*n, *k]),
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
        Model::ThinDielectric => "model-thin-dielectric",
    }
}

/// Draws the choice of the model; returns the one that was picked.
pub(super) fn model_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) -> Option<Model> {
    let texts = sheet.texts();
    let model = sheet.primary.model();
    let is_mixed = sheet.things.iter().any(|material| material.model() != model);
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
    picked
}

/// Draws what a model has besides color and ambient light.
pub(super) fn rows_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>) {
    match sheet.primary {
        Material::Dielectric(dielectric) => {
            substance_ui(ui, sheet, dielectric);
            sheet.number(ui, &IOR, None);
            dispersion_ui(ui, sheet, dielectric);
            sheet.number(ui, &ABBE, None);
            sheet.color(ui, &ATTENUATION_COLOR);
            sheet.number(ui, &ATTENUATION_DISTANCE, None);
        }
        Material::Conductor(conductor) => {
            metal_ui(ui, sheet, conductor);
            sheet.vector(ui, &N);
            sheet.vector(ui, &K);
        }
        Material::Mirror(_) => sheet.number_or(ui, &REFLECTION, Some(1.0)),
        Material::Coated(_) => sheet.number(ui, &IOR, None),
        Material::ThinDielectric(_) => {
            sheet.number(ui, &IOR, None);
            sheet.color(ui, &TINT);
        }
        Material::Phong(_) | Material::Matte(_) => {}
    }
    sheet.number(ui, &ROUGHNESS, None);
}

/// Water, glass, diamond …, or an index of one's own.
fn substance_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, dielectric: &Dielectric) {
    let texts = sheet.texts();
    let own = dielectric.index.substance();
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
            edit_dielectric(material, |dielectric| {
                let index = dielectric.index;
                // One's own index begins where the substance was.
                let own = || RefractiveIndex::Own { ior: index.ior(), abbe: index.dispersion().abbe() };
                dielectric.index = substance.map_or_else(own, RefractiveIndex::Substance);
            });
        });
    }
}

fn metal_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, conductor: &Conductor) {
    let texts = sheet.texts();
    let own = conductor.metal;
    let mut picked = None;
    sheet.plain_row(ui, "metal", |_, ui| {
        let key = match own {
            MetalOptics::Metal(metal) => named("metal", metal.name),
            MetalOptics::Index { .. } => "metal-own".to_owned(),
        };
        let shown_name = texts.get(&key);
        let combo = ComboBox::from_id_salt("metal")
            .selected_text(shown_name)
            .width(control_width(ui))
            .height(320.0)
            .truncate();
        let list = combo.show_ui(ui, |ui| {
            for metal in METALS {
                let is_it = own == MetalOptics::Metal(metal);
                let response = ui.selectable_label(is_it, texts.get(&named("metal", metal.name)));
                if tip_beside(ui, response, metal.source).clicked() {
                    picked = Some(MetalOptics::Metal(metal));
                }
            }
            let is_own = matches!(own, MetalOptics::Index { .. });
            if ui.selectable_label(is_own, texts.get("metal-own")).clicked() && !is_own {
                picked = Some(index_like(own));
            }
        });
        list.response.accessible_name(texts.get("metal"));
    });
    if let Some(metal) = picked {
        sheet.change("metal", "edit-conductor", |_, material| {
            if let Material::Conductor(conductor) = material {
                conductor.metal = metal;
            }
        });
    }
}

/// Indices of one's own that begin with those of a metal, at the wavelengths at which screens are red, green and blue.
fn index_like(metal: MetalOptics) -> MetalOptics {
    match metal {
        MetalOptics::Metal(metal) => {
            let [r, g, b] = [630.0, 532.0, 465.0].map(|nanometers| metal.index(nanometers));
            let rounded = |value: f64| (value * 1e3).round() / 1e3;
            let of = |part: usize| {
                DVec3::from([r, g, b].map(|index| rounded(index.get(part).copied().unwrap_or(1.0))))
            };
            MetalOptics::Index { n: of(0).max(DVec3::splat(0.001)), k: of(1) }
        }
        own @ MetalOptics::Index { .. } => own,
    }
}

fn dispersion_ui(ui: &mut Ui, sheet: &mut PropertySheet<'_, '_, Material>, dielectric: &Dielectric) {
    let mut is_on = dielectric.dispersion;
    let mut is_clicked = false;
    let texts = sheet.texts();
    sheet.plain_row(ui, "dispersion", |_, ui| {
        let response = ui.checkbox(&mut is_on, texts.get("dispersion-words"));
        is_clicked = tip_beside(ui, response, texts.tip("dispersion").unwrap_or_default()).clicked();
    });
    if is_clicked {
        sheet.change("dispersion", "edit-dispersion", |_, material| {
            edit_dielectric(material, |dielectric| dielectric.dispersion = is_on);
        });
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
    use crate::base::texts::Language;

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
            let metal_of_ones_own = index_like(MetalOptics::Metal(metal));
            let material = Material::from(Conductor { metal: metal_of_ones_own, ..Conductor::default() });
            let measured = metal.reflectance(1.0, 1.0).into_iter().fold(0.0, f64::max).min(1.0);
            assert!((material.reflects().straight - measured).abs() < 0.06, "{}", metal.name);
        }
    }
}
