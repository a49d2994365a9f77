//! The formula of a light's falloff with distance.

use catoptric_scene::{Falloff, Light};
use egui::{Id, Ui};

use super::{FormulaFactor, FormulaRow, rows_ui};
use crate::base::texts::Texts;
use crate::base::widgets::number::shown;
use crate::panels::inspector::InspectorState;
use crate::panels::inspector::header::hint;
use crate::panels::inspector::symbol::Symbol;

/// The distances for which the falloff is written, meters.
const DISTANCES: [f64; 3] = [1.0, 5.0, 10.0];

/// Draws what a light sends to a point at the distance d, in symbols and in numbers.
pub(in crate::panels::inspector) fn falloff_ui(
    ui: &mut Ui,
    texts: &Texts,
    memory: &mut InspectorState,
    light: &Light,
) {
    let name = texts.get("in-formula-sent");
    let law = match light.falloff {
        Falloff::None => vec![FormulaFactor::text(Symbol::Falloff, "1")],
        Falloff::Linear { .. } => {
            vec![
                FormulaFactor::sign("1 / (d + "),
                FormulaFactor::text(Symbol::FalloffConstant, "K"),
                FormulaFactor::sign(")"),
            ]
        }
        Falloff::InverseSquare => vec![FormulaFactor::text(Symbol::Falloff, "1 / d^2")],
    };
    let mut symbols = vec![
        FormulaFactor::text(Symbol::Falloff, "A(d)"),
        FormulaFactor::sign(" · "),
        FormulaFactor::text(Symbol::Intensity, texts.get("in-formula-intensity")),
        FormulaFactor::sign(" · "),
        FormulaFactor::text(Symbol::LightColor, texts.get("in-formula-color")),
        FormulaFactor::sign(",   A(d) = "),
    ];
    symbols.extend(law);
    let mut numbers = match light.falloff {
        Falloff::None => vec![FormulaFactor::text(Symbol::Falloff, "1")],
        Falloff::Linear { constant } => vec![
            FormulaFactor::sign("1 / (d + "),
            FormulaFactor::number(texts, Symbol::FalloffConstant, constant),
            FormulaFactor::sign(")"),
        ],
        Falloff::InverseSquare => vec![FormulaFactor::text(Symbol::Falloff, "1 / d^2")],
    };
    numbers.extend([
        FormulaFactor::sign(" · "),
        FormulaFactor::number(texts, Symbol::Intensity, light.intensity),
        FormulaFactor::sign(" · "),
        FormulaFactor::color(texts, Symbol::LightColor, light.color),
    ]);
    let rows = [
        FormulaRow { name, factors: symbols, is_numeric: false, is_idle: false, indent: 0.0 },
        FormulaRow { name, factors: numbers, is_numeric: true, is_idle: light.hidden, indent: 0.0 },
    ];
    rows_ui(ui, texts, memory, Id::unique("formula-falloff"), &rows);
    if light.falloff != Falloff::None {
        let unit = texts.get("unit-meters");
        let told = DISTANCES
            .map(|d| format!("A({}{unit}) = {}", shown(texts, d, 0), shown(texts, at(light.falloff, d), 3)));
        hint(ui, &told.join(";  "));
    }
}

/// A(d) of the model.
fn at(falloff: Falloff, distance: f64) -> f64 {
    match falloff {
        Falloff::None => 1.0,
        Falloff::Linear { constant } => 1.0 / (distance + constant),
        Falloff::InverseSquare => 1.0 / (distance * distance),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_laws_are_those_of_the_model() {
        assert_eq!(at(Falloff::None, 7.0), 1.0);
        assert_eq!(at(Falloff::Linear { constant: 1.0 }, 3.0), 0.25);
        assert_eq!(at(Falloff::InverseSquare, 2.0), 0.25);
    }
}
