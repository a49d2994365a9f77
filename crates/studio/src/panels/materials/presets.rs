//! Materials to be taken as they are, and how they are found by their names.

use std::sync::LazyLock;

use catoptric_optics::{CLEAR, ClearSubstance, METALS, Metal};
use catoptric_scene::{
    Attenuation, Coated, Color, Conductor, Dielectric, Material, Matte, MetalOptics, Mirror, Phong,
    RefractiveIndex, ThinDielectric,
};

use super::MaterialSection;
use crate::base::texts::{Language, Texts};
use crate::panels::inspector::{KINDS, KindPreset as Kind};

/// A material with a name.
pub(super) struct MaterialPreset {
    pub(super) section: MaterialSection,
    /// The message that names it.
    pub(super) key: String,
    pub(super) material: Material,
    pub(super) about: PresetDescription,
}

/// The source of a preset's tooltip.
#[derive(Clone, Copy)]
pub(super) enum PresetDescription {
    /// What the message's attribute says.
    Tip,
    /// A measured metal.
    Metal(&'static Metal),
    /// A measured clear substance.
    Clear(&'static ClearSubstance),
}

/// All presets, in the order in which to show them.
pub(super) static PRESETS: LazyLock<Vec<MaterialPreset>> = LazyLock::new(|| {
    let mut all: Vec<MaterialPreset> = KINDS.iter().map(kind).collect();
    all.extend(METALS.iter().map(|metal| MaterialPreset {
        section: MaterialSection::Metals,
        key: format!("metal-{}", metal.name),
        material: of_metal(metal, 0.0),
        about: PresetDescription::Metal(metal),
    }));
    let satin = [
        ("preset-satin-aluminum", "aluminum", 0.36),
        ("preset-satin-titanium", "titanium", 0.42),
        ("preset-satin-copper", "copper", 0.34),
        ("preset-satin-gold", "gold", 0.34),
    ];
    all.extend(satin.into_iter().filter_map(|(key, name, roughness)| {
        let metal = Metal::named(name)?;
        Some(tipped(MaterialSection::Metals, key, of_metal(metal, roughness)))
    }));
    all.extend(CLEAR.iter().map(|clear| MaterialPreset {
        section: MaterialSection::Clear,
        key: format!("substance-{}", clear.name),
        material: of_substance(clear, 0.0),
        about: PresetDescription::Clear(clear),
    }));
    all.extend(clear_colored());
    all.extend(coats());
    all.extend(rough());
    all
});

/// The four kinds of Phong's and Whitted's models, in a color that suits them.
fn kind(kind: &'static Kind) -> MaterialPreset {
    let color = if kind.key == "kind-glossy" { Color::new(0.75, 0.06, 0.05) } else { Color::gray(0.8) };
    let mut phong = Phong { pattern: color.into(), ..Phong::default() };
    kind.give(&mut phong);
    tipped(MaterialSection::Constant, kind.key, phong)
}

fn tipped(section: MaterialSection, key: &str, material: impl Into<Material>) -> MaterialPreset {
    let material = material.into();
    MaterialPreset { section, key: key.to_owned(), material, about: PresetDescription::Tip }
}

fn of_metal(metal: &'static Metal, roughness: f64) -> Material {
    Conductor { metal: MetalOptics::Metal(metal), roughness }.into()
}

fn of_substance(substance: &'static ClearSubstance, roughness: f64) -> Material {
    Dielectric { index: RefractiveIndex::Substance(substance), roughness, ..Dielectric::default() }.into()
}

/// Glass that absorbs light, in colors that a body of a meter shows well, and thin glass.
fn clear_colored() -> impl Iterator<Item = MaterialPreset> {
    let all = [
        ("preset-bottle-glass", [0.25, 0.62, 0.30]),
        ("preset-cobalt-glass", [0.12, 0.25, 0.80]),
        ("preset-ruby-glass", [0.72, 0.04, 0.07]),
    ];
    let colored = all.into_iter().map(|(key, [r, g, b])| {
        let attenuation = Attenuation { color: Color::new(r, g, b), ..Attenuation::default() };
        let glass = Dielectric { index: 1.52.into(), attenuation, ..Dielectric::default() };
        tipped(MaterialSection::Clear, key, glass)
    });
    let pane = ThinDielectric { ior: 1.52, ..ThinDielectric::default() };
    colored.chain(std::iter::once(tipped(MaterialSection::Clear, "preset-window-pane", pane)))
}

fn coats() -> impl Iterator<Item = MaterialPreset> {
    let mirror = Mirror { pattern: Color::WHITE.into(), ..Mirror::default() };
    let all = [
        ("preset-red-lacquer", [0.50, 0.015, 0.02], 1.52),
        ("preset-black-lacquer", [0.012, 0.012, 0.014], 1.52),
        ("preset-white-ceramic", [0.86, 0.85, 0.81], 1.5),
        ("preset-blue-ceramic", [0.03, 0.12, 0.42], 1.5),
        ("preset-green-plastic", [0.04, 0.36, 0.11], 1.46),
        ("preset-yellow-plastic", [0.86, 0.56, 0.04], 1.46),
    ];
    let coated = all.into_iter().map(|(key, color, ior)| {
        let pattern = Color::from(color).into();
        tipped(MaterialSection::Coats, key, Coated { pattern, ior, ..Coated::default() })
    });
    std::iter::once(tipped(MaterialSection::Coats, "preset-ideal-mirror", mirror)).chain(coated)
}

fn rough() -> impl Iterator<Item = MaterialPreset> {
    let pattern = |r, g, b| Color::new(r, g, b).into();
    let matte = |r, g, b| Matte { pattern: pattern(r, g, b), ..Matte::default() }.into();
    let mirror = Mirror { pattern: pattern(0.9, 0.9, 0.9), roughness: 0.3, ..Mirror::default() };
    let plastic = Coated { pattern: pattern(0.10, 0.20, 0.50), roughness: 0.45, ..Coated::default() };
    let frosted = ClearSubstance::named("crown-glass").map(|glass| of_substance(glass, 0.35));
    let others = [
        ("preset-dull-mirror", mirror.into()),
        ("preset-satin-plastic", plastic.into()),
        ("preset-plaster", matte(0.85, 0.84, 0.80)),
        ("preset-terracotta", matte(0.55, 0.20, 0.10)),
    ];
    let all = frosted.map(|frosted| ("preset-frosted-glass", frosted)).into_iter().chain(others);
    all.map(|(key, material): (_, Material)| tipped(MaterialSection::Rough, key, material))
}

/// For each preset what it can be found by: its name and its section in all languages.
static FOUND_BY: LazyLock<Vec<String>> = LazyLock::new(|| {
    let all = Language::ALL.map(Texts::new);
    let words = PRESETS.iter().map(|preset| {
        let of = |texts: &Texts| format!("{} {}", texts.get(&preset.key), texts.get(preset.section.key()));
        all.iter().map(of).collect::<Vec<_>>().join(" ").to_lowercase()
    });
    words.collect()
});

/// The places of the presets that have all words of `filter`, in lower case, in their name or section.
pub(super) fn found(filter: &str) -> impl Iterator<Item = usize> {
    let all = 0..PRESETS.len();
    all.filter(move |&place| filter.is_empty() || FOUND_BY.get(place).is_some_and(|text| has(text, filter)))
}

/// Whether a text has all words of `filter`, both in lower case.
pub(super) fn has(text: &str, filter: &str) -> bool {
    filter.split_whitespace().all(|word| text.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_lab::depth::excess_of;

    #[test]
    fn every_preset_has_a_name_and_gives_no_more_light_than_it_gets() {
        for language in Language::ALL {
            let texts = Texts::new(language);
            for preset in PRESETS.iter() {
                assert_ne!(texts.get(&preset.key), preset.key, "{language:?}");
                let is_told =
                    !matches!(preset.about, PresetDescription::Tip) || texts.tip(&preset.key).is_some();
                assert!(is_told, "{}", preset.key);
            }
        }
        assert!(PRESETS.iter().all(|preset| excess_of(&preset.material).next().is_none()));
        let metals =
            PRESETS.iter().filter(|preset| matches!(preset.about, PresetDescription::Metal(_))).count();
        let clear =
            PRESETS.iter().filter(|preset| matches!(preset.about, PresetDescription::Clear(_))).count();
        assert_eq!((metals, clear), (METALS.len(), CLEAR.len()));
    }

    #[test]
    fn presets_are_found_in_both_languages_and_by_their_section() {
        let keys = |filter: &str| found(filter).map(|place| PRESETS[place].key.as_str()).collect::<Vec<_>>();
        assert_eq!(keys("").len(), PRESETS.len());
        assert_eq!(keys("diamond"), ["substance-diamond"]);
        assert_eq!(keys("алмаз"), ["substance-diamond"]);
        assert_eq!(keys("gold"), ["metal-gold", "preset-satin-gold"]);
        assert_eq!(keys("металл").len(), METALS.len() + 4);
        assert!(keys("unobtainium").is_empty());
    }
}
