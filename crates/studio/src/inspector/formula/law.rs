//! The laws of surfaces that are not Phong's, in symbols and in numbers.

use catoptric_scene::{Conductor, Material, Model};
use egui::{Id, Ui};

use super::{Factor, Row, color_text, rows_ui};
use crate::inspector::Memory;
use crate::inspector::symbol::Symbol;
use crate::texts::Texts;
use crate::widgets::number::shown;

/// Draws the law of a material's model.
pub(in crate::inspector) fn law_ui(ui: &mut Ui, texts: &Texts, memory: &mut Memory, material: &Material) {
    let mut lines = Lines { rows: Vec::new(), texts };
    match material.model {
        Model::Phong => {}
        Model::Dielectric => lines.dielectric(material),
        Model::Conductor => lines.conductor(material),
        Model::Mirror => lines.mirror(material),
        Model::Matte => lines.matte(),
        Model::Coated => lines.coated(material),
    }
    rows_ui(ui, texts, memory, Id::unique("formula-law"), &lines.rows);
}

struct Lines<'t> {
    rows: Vec<Row<'t>>,
    texts: &'t Texts,
}

impl Lines<'_> {
    fn symbols(&mut self, key: &'static str, factors: Vec<Factor>) {
        let name = self.texts.get(key);
        self.rows.push(Row { name, factors, is_numeric: false, is_idle: false, indent: 0.0 });
    }

    fn numbers(&mut self, key: &'static str, factors: Vec<Factor>) {
        let name = self.texts.get(key);
        self.rows.push(Row { name, factors, is_numeric: true, is_idle: false, indent: 18.0 });
    }

    fn reflected(&self) -> Factor {
        Factor::text(Symbol::Reflected, self.texts.get("in-formula-reflected"))
    }

    fn dielectric(&mut self, material: &Material) {
        let refracted = Factor::text(Symbol::Refracted, self.texts.get("in-formula-refracted"));
        let sum =
            vec![Factor::sign("I = R(θ) "), self.reflected(), Factor::sign(" + (1 − R(θ)) "), refracted];
        self.symbols("in-formula-sum", sum);
        self.straight(material);
        self.symbols(
            "in-formula-snell",
            vec![Factor::sign("sin α = "), Factor::symbol(Symbol::Ior), Factor::sign(" sin β")],
        );
        self.numbers(
            "in-formula-snell",
            vec![
                Factor::sign("sin α = "),
                Factor::number(Symbol::Ior, material.ior()),
                Factor::sign(" · sin β"),
            ],
        );
        if material.attenuation_color != catoptric_scene::Color::WHITE {
            self.symbols("in-formula-loss", vec![Factor::sign("T(d) = c^{d/D}")]);
            let (color, distance) = (color_text(material.attenuation_color), material.attenuation_distance);
            let markup = format!("T(d) = {color}^{{d/{}}}", shown(distance, 3));
            self.numbers("in-formula-loss", vec![Factor::sign(&markup)]);
        }
    }

    /// R(0) of a clear surface.
    fn straight(&mut self, material: &Material) {
        let ior = material.ior();
        let root = (ior - 1.0) / (ior + 1.0);
        self.symbols("in-formula-straight", vec![Factor::sign("R(0) = ((η − 1)/(η + 1))^2")]);
        let index = shown(ior, 3);
        let markup = format!("(({index} − 1)/({index} + 1))^2 = {}", shown(root * root, 4));
        self.numbers("in-formula-straight", vec![Factor::sign(&markup)]);
    }

    fn conductor(&mut self, material: &Material) {
        let sum = vec![Factor::sign("I = R(θ) "), self.reflected()];
        self.symbols("in-formula-sum", sum);
        self.symbols("in-formula-straight", vec![Factor::sign("R(0) = ((n − 1)^2 + k^2)/((n + 1)^2 + k^2)")]);
        let [r, g, b] = match material.conductor {
            Conductor::Metal(metal) => metal.reflectance(1.0, 1.0),
            Conductor::Index { n, k } => {
                let straight = |n: f64, k: f64| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
                [straight(n.x, k.x), straight(n.y, k.y), straight(n.z, k.z)]
            }
        };
        let numbers = [r, g, b].map(|part| shown(part, 3)).join(", ");
        self.numbers("in-formula-straight", vec![Factor::sign(&format!("R(0) = ({numbers})"))]);
    }

    fn mirror(&mut self, material: &Material) {
        self.symbols(
            "in-formula-sum",
            vec![
                Factor::sign("I = "),
                Factor::symbol(Symbol::Reflection),
                Factor::symbol(Symbol::Color),
                self.reflected(),
            ],
        );
        self.numbers(
            "in-formula-sum",
            vec![
                Factor::sign("I = "),
                Factor::number(Symbol::Reflection, material.reflection()),
                Factor::sign("·"),
                Factor::color(Symbol::Color, material.emblem()),
                Factor::sign("·"),
                self.reflected(),
            ],
        );
    }

    fn ground(&mut self) {
        self.symbols(
            "in-formula-ambient",
            vec![
                Factor::sign("I = "),
                Factor::symbol(Symbol::Ambient),
                Factor::symbol(Symbol::Color),
                Factor::symbol(Symbol::AmbientLight),
            ],
        );
        self.symbols(
            "in-formula-diffuse",
            vec![
                Factor::sign("+ Σ_j "),
                Factor::symbol(Symbol::Visibility),
                Factor::symbol(Symbol::Falloff),
                Factor::symbol(Symbol::Light),
                Factor::symbol(Symbol::Color),
                Factor::symbol(Symbol::Lambert),
            ],
        );
    }

    fn matte(&mut self) {
        self.ground();
    }

    fn coated(&mut self, material: &Material) {
        self.ground();
        self.symbols("in-formula-coat", vec![Factor::sign("· (1 − R(θ)) (1 − R(θ_j))/(η^2 (1 − C R_i))")]);
        self.symbols("in-formula-reflection", vec![Factor::sign("+ R(θ) "), self.reflected()]);
        self.straight(material);
    }
}
