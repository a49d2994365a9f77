//! The laws of surfaces that are not Phong's, in symbols and in numbers.

use catoptric_optics::{Metal, fresnel, observer};
use catoptric_scene::{Coated, Conductor, Dielectric, Material, MetalOptics, Mirror, ThinDielectric};
use egui::{Id, Ui};

use super::{FormulaFactor, FormulaRow, color_text, rows_ui};
use crate::base::texts::Texts;
use crate::base::widgets::number::{list, shown};
use crate::panels::inspector::InspectorState;
use crate::panels::inspector::header::hint;
use crate::panels::inspector::symbol::Symbol;

/// Draws the law of a material's model.
pub(in crate::panels::inspector) fn law_ui(
    ui: &mut Ui,
    texts: &Texts,
    memory: &mut InspectorState,
    material: &Material,
) {
    let mut lines = LawLines { rows: Vec::new(), texts };
    match material {
        Material::Phong(_) => {}
        Material::Dielectric(dielectric) => lines.dielectric(dielectric),
        Material::Conductor(conductor) => lines.conductor(conductor.metal),
        Material::Mirror(mirror) => lines.mirror(mirror),
        Material::Matte(_) => lines.matte(),
        Material::Coated(coated) => lines.coated(coated),
        Material::ThinDielectric(sheet) => lines.thin_dielectric(sheet),
    }
    rows_ui(ui, texts, memory, Id::unique("formula-law"), &lines.rows);
    if let Material::Conductor(Conductor { metal: MetalOptics::Metal(metal), .. }) = material {
        metal_ui(ui, texts, metal);
    }
}

/// What the numbers of a metal mean: the spectrum is reflected in part, and its color may lie outside of sRGB.
fn metal_ui(ui: &mut Ui, texts: &Texts, metal: &Metal) {
    let [(at_least, least), (at_most, most)] = spectral_range(metal);
    let arguments = [
        ("least", shown(texts, least, 3).into()),
        ("at-least", shown(texts, at_least, 0).into()),
        ("most", shown(texts, most, 3).into()),
        ("at-most", shown(texts, at_most, 0).into()),
        ("luminous", shown(texts, luminance(metal.reflectance(1.0, 1.0)), 3).into()),
    ];
    hint(ui, &texts.with("law-spectrum", &arguments));
    if metal.reflectance(1.0, 1.0).into_iter().any(|part| part > 1.0) {
        hint(ui, texts.get("law-gamut"));
    }
}

/// The wavelengths, nanometers, at which a metal reflects the least and the most straight on, with R(0).
fn spectral_range(metal: &Metal) -> [(f64, f64); 2] {
    let shares = (0..=80).map(|step| {
        let nanometers = observer::VISIBLE.start() + 5.0 * f64::from(step);
        let [n, k] = metal.index(nanometers);
        (nanometers, fresnel::conductor(1.0, n, k).mean())
    });
    let pick = |other: fn(f64, f64) -> bool| {
        shares
            .clone()
            .reduce(|best, next| if other(next.1, best.1) { next } else { best })
            .unwrap_or_default()
    };
    [pick(|next, best| next < best), pick(|next, best| next > best)]
}

/// Luminance Y of a color in linear sRGB, where white has 1 (IEC 61966-2-1).
fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

struct LawLines<'t> {
    rows: Vec<FormulaRow<'t>>,
    texts: &'t Texts,
}

impl LawLines<'_> {
    fn symbols(&mut self, key: &'static str, factors: Vec<FormulaFactor>) {
        let name = self.texts.get(key);
        self.rows.push(FormulaRow { name, factors, is_numeric: false, is_idle: false, indent: 0.0 });
    }

    fn numbers(&mut self, key: &'static str, factors: Vec<FormulaFactor>) {
        let name = self.texts.get(key);
        self.rows.push(FormulaRow { name, factors, is_numeric: true, is_idle: false, indent: 18.0 });
    }

    fn reflected(&self) -> FormulaFactor {
        FormulaFactor::text(Symbol::Reflected, self.texts.get("in-formula-reflected"))
    }

    fn dielectric(&mut self, dielectric: &Dielectric) {
        let Dielectric { index, attenuation, .. } = *dielectric;
        let refracted = FormulaFactor::text(Symbol::Refracted, self.texts.get("in-formula-refracted"));
        let sum = vec![
            FormulaFactor::sign("I = R(θ) "),
            self.reflected(),
            FormulaFactor::sign(" + (1 − R(θ)) "),
            refracted,
        ];
        self.symbols("in-formula-sum", sum);
        self.straight(index.ior());
        self.symbols(
            "in-formula-snell",
            vec![
                FormulaFactor::sign("sin α = "),
                FormulaFactor::symbol(Symbol::Ior),
                FormulaFactor::sign(" sin β"),
            ],
        );
        self.numbers(
            "in-formula-snell",
            vec![
                FormulaFactor::sign("sin α = "),
                FormulaFactor::number(self.texts, Symbol::Ior, index.ior()),
                FormulaFactor::sign(" · sin β"),
            ],
        );
        if attenuation.color != catoptric_scene::Color::WHITE {
            self.symbols("in-formula-loss", vec![FormulaFactor::sign("T(d) = c^{d/D}")]);
            let color = color_text(self.texts, attenuation.color);
            let markup = format!("T(d) = {color}^{{d/{}}}", shown(self.texts, attenuation.distance, 3));
            self.numbers("in-formula-loss", vec![FormulaFactor::sign(&markup)]);
        }
    }

    fn thin_dielectric(&mut self, sheet: &ThinDielectric) {
        let refracted = FormulaFactor::text(Symbol::Refracted, self.texts.get("in-formula-refracted"));
        let sum = vec![
            FormulaFactor::sign("I = R(θ) "),
            self.reflected(),
            FormulaFactor::sign(" + (1 − R(θ)) "),
            FormulaFactor::symbol(Symbol::Tint),
            FormulaFactor::sign(" "),
            refracted,
        ];
        self.symbols("in-formula-sum", sum);
        let straight = "R(0) = (η − 1)^2/(η^2 + 1)";
        self.symbols("in-formula-straight", vec![FormulaFactor::sign(straight)]);
        let index = shown(self.texts, sheet.ior, 3);
        let share = shown(self.texts, fresnel::sheet(1.0, sheet.ior).mean(), 4);
        let markup = format!("({index} − 1)^2/({index}^2 + 1) = {share}");
        self.numbers("in-formula-straight", vec![FormulaFactor::sign(&markup)]);
    }

    /// R(0) of a clear surface.
    fn straight(&mut self, ior: f64) {
        let root = (ior - 1.0) / (ior + 1.0);
        self.symbols("in-formula-straight", vec![FormulaFactor::sign("R(0) = ((η − 1)/(η + 1))^2")]);
        let index = shown(self.texts, ior, 3);
        let markup = format!("(({index} − 1)/({index} + 1))^2 = {}", shown(self.texts, root * root, 4));
        self.numbers("in-formula-straight", vec![FormulaFactor::sign(&markup)]);
    }

    fn conductor(&mut self, metal: MetalOptics) {
        let sum = vec![FormulaFactor::sign("I = R(θ) "), self.reflected()];
        self.symbols("in-formula-sum", sum);
        self.symbols(
            "in-formula-straight",
            vec![FormulaFactor::sign("R(0) = ((n − 1)^2 + k^2)/((n + 1)^2 + k^2)")],
        );
        let [r, g, b] = match metal {
            MetalOptics::Metal(metal) => {
                let [least, most] = spectral_range(metal).map(|(_, share)| shown(self.texts, share, 3));
                self.numbers(
                    "in-formula-straight",
                    vec![FormulaFactor::sign(&format!("R(0) = {least} … {most}"))],
                );
                metal.reflectance(1.0, 1.0)
            }
            MetalOptics::Index { n, k } => {
                let straight = |n: f64, k: f64| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
                [straight(n.x, k.x), straight(n.y, k.y), straight(n.z, k.z)]
            }
        };
        let numbers = list(self.texts, [r, g, b].map(|part| shown(self.texts, part, 3)));
        self.numbers("in-formula-straight", vec![FormulaFactor::sign(&format!("RGB = ({numbers})"))]);
    }

    fn mirror(&mut self, mirror: &Mirror) {
        self.symbols(
            "in-formula-sum",
            vec![
                FormulaFactor::sign("I = "),
                FormulaFactor::symbol(Symbol::Reflection),
                FormulaFactor::symbol(Symbol::Color),
                self.reflected(),
            ],
        );
        self.numbers(
            "in-formula-sum",
            vec![
                FormulaFactor::sign("I = "),
                FormulaFactor::number(self.texts, Symbol::Reflection, mirror.reflection()),
                FormulaFactor::sign("·"),
                FormulaFactor::color(self.texts, Symbol::Color, mirror.pattern.mean()),
                FormulaFactor::sign("·"),
                self.reflected(),
            ],
        );
    }

    fn ground(&mut self) {
        self.symbols(
            "in-formula-ambient",
            vec![
                FormulaFactor::sign("I = "),
                FormulaFactor::symbol(Symbol::Ambient),
                FormulaFactor::symbol(Symbol::Color),
                FormulaFactor::symbol(Symbol::AmbientLight),
            ],
        );
        self.symbols(
            "in-formula-diffuse",
            vec![
                FormulaFactor::sign("+ Σ_j "),
                FormulaFactor::symbol(Symbol::Visibility),
                FormulaFactor::symbol(Symbol::Falloff),
                FormulaFactor::symbol(Symbol::Light),
                FormulaFactor::symbol(Symbol::Color),
                FormulaFactor::symbol(Symbol::Lambert),
            ],
        );
    }

    fn matte(&mut self) {
        self.ground();
    }

    fn coated(&mut self, coated: &Coated) {
        self.ground();
        self.symbols(
            "in-formula-coat",
            vec![FormulaFactor::sign("· (1 − R(θ)) (1 − R(θ_j))/(η^2 (1 − C R_i))")],
        );
        self.symbols("in-formula-reflection", vec![FormulaFactor::sign("+ R(θ) "), self.reflected()]);
        self.straight(coated.ior);
    }
}

#[cfg(test)]
mod tests {
    use catoptric_optics::METALS;

    use super::*;

    #[test]
    fn no_wavelength_comes_back_more_than_whole_though_a_color_may_leave_srgb() {
        for metal in METALS {
            let [(_, least), (_, most)] = spectral_range(metal);
            assert!(0.0 < least && least < most && most < 1.0, "{}: {least} {most}", metal.name);
            let seen = luminance(metal.reflectance(1.0, 1.0));
            assert!((least..=most).contains(&seen), "{}: {seen}", metal.name);
        }
        let gold = Metal::named("gold").unwrap();
        assert!(gold.reflectance(1.0, 1.0)[0] > 1.0);
        // Y of the color that the library colour-science 0.4 (Python) gives: 1.0375, 0.7284, 0.3646.
        assert!((luminance(gold.reflectance(1.0, 1.0)) - 0.7679).abs() < 1e-3);
    }
}
