//! The light at a point, term by term.

use catoptric_scene::{Falloff, Light, Phong, Scene};
use egui::{Id, Role, Sense, Ui, WidgetInfo, vec2};

use super::{FormulaFactor, FormulaRow, color_text, rows_ui};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::typeset::{self, TextLine};
use crate::base::widgets::color::screen_color;
use crate::base::widgets::number::shown;
use crate::panels::inspector::InspectorState;
use crate::panels::inspector::header::hint;
use crate::panels::inspector::symbol::Symbol;

/// How many lights are listed with their numbers.
const LISTED: usize = 4;

/// Draws the formula of the local light, reflection and transmission of a material, in symbols and in numbers.
pub(in crate::panels::inspector) fn material_ui(
    ui: &mut Ui,
    texts: &Texts,
    memory: &mut InspectorState,
    phong: &Phong,
    scene: &Scene,
) {
    let mut rows = Vec::new();
    ambient(&mut rows, texts, phong, scene);
    diffuse(&mut rows, texts, phong);
    highlight(&mut rows, texts, phong);
    reflection(&mut rows, texts, phong);
    transmission(&mut rows, texts, phong);
    rows_ui(ui, texts, memory, Id::unique("formula"), &rows);
    refraction_ui(ui, texts, memory, phong);
    lights_ui(ui, texts, scene);
}

fn pair<'t>(
    rows: &mut Vec<FormulaRow<'t>>,
    name: &'t str,
    indent: f32,
    is_idle: bool,
    symbols: Vec<FormulaFactor>,
    numbers: Vec<FormulaFactor>,
) {
    rows.push(FormulaRow { name, factors: symbols, is_numeric: false, is_idle, indent });
    let indent = indent + 18.0;
    rows.push(FormulaRow { name, factors: numbers, is_numeric: true, is_idle, indent });
}

/// I = k_a C I_a
fn ambient<'t>(rows: &mut Vec<FormulaRow<'t>>, texts: &'t Texts, phong: &Phong, scene: &Scene) {
    let symbols = vec![
        FormulaFactor::sign("I = "),
        FormulaFactor::symbol(Symbol::Ambient),
        FormulaFactor::symbol(Symbol::Color),
        FormulaFactor::symbol(Symbol::AmbientLight),
    ];
    let numbers = vec![
        FormulaFactor::number(texts, Symbol::Ambient, phong.ambient),
        FormulaFactor::sign("·"),
        FormulaFactor::color(texts, Symbol::Color, phong.pattern.mean()),
        FormulaFactor::sign("·"),
        FormulaFactor::color(texts, Symbol::AmbientLight, scene.environment.ambient),
    ];
    pair(rows, texts.get("in-formula-ambient"), 0.0, phong.ambient == 0.0, symbols, numbers);
}

/// Σ_j V_j A(d_j) I_j [ k_d C (N·L_j)
fn diffuse<'t>(rows: &mut Vec<FormulaRow<'t>>, texts: &'t Texts, phong: &Phong) {
    let sum = vec![
        FormulaFactor::sign("+ Σ_j "),
        FormulaFactor::symbol(Symbol::Visibility),
        FormulaFactor::symbol(Symbol::Falloff),
        FormulaFactor::symbol(Symbol::Light),
        FormulaFactor::sign(" ["),
    ];
    let is_idle = phong.diffuse == 0.0 && phong.specular == 0.0;
    let name = texts.get("in-formula-sum");
    rows.push(FormulaRow { name, factors: sum, is_numeric: false, is_idle, indent: 14.0 });
    let symbols = vec![
        FormulaFactor::symbol(Symbol::Diffuse),
        FormulaFactor::symbol(Symbol::Color),
        FormulaFactor::symbol(Symbol::Lambert),
    ];
    let numbers = vec![
        FormulaFactor::number(texts, Symbol::Diffuse, phong.diffuse),
        FormulaFactor::sign("·"),
        FormulaFactor::color(texts, Symbol::Color, phong.pattern.mean()),
        FormulaFactor::sign("·"),
        FormulaFactor::symbol(Symbol::Lambert),
    ];
    pair(rows, texts.get("in-formula-diffuse"), 44.0, phong.diffuse == 0.0, symbols, numbers);
}

/// + k_s ((S·R)⁺)ⁿ ]
fn highlight<'t>(rows: &mut Vec<FormulaRow<'t>>, texts: &'t Texts, phong: &Phong) {
    let symbols = vec![
        FormulaFactor::sign("+ "),
        FormulaFactor::symbol(Symbol::Specular),
        FormulaFactor::symbol(Symbol::Mirrored),
        FormulaFactor::text(Symbol::Shininess, "^n"),
        FormulaFactor::sign(" ]"),
    ];
    let exponent = format!("^{{{}}}", shown(texts, phong.shininess, 1));
    let numbers = vec![
        FormulaFactor::number(texts, Symbol::Specular, phong.specular),
        FormulaFactor::sign("·"),
        FormulaFactor::symbol(Symbol::Mirrored),
        FormulaFactor::text(Symbol::Shininess, exponent),
    ];
    pair(rows, texts.get("in-formula-highlight"), 32.0, phong.specular == 0.0, symbols, numbers);
}

/// + k_r I_reflected, weighed by R(θ) if need be
fn reflection<'t>(rows: &mut Vec<FormulaRow<'t>>, texts: &'t Texts, phong: &Phong) {
    let reflected = texts.get("in-formula-reflected");
    let weight = if phong.weighs_by_angle() { " R(θ) " } else { "" };
    let symbols = vec![
        FormulaFactor::sign("+ "),
        FormulaFactor::symbol(Symbol::Reflection),
        FormulaFactor::sign(weight),
        FormulaFactor::text(Symbol::Reflected, reflected),
    ];
    let value = phong.reflection();
    let numbers = vec![
        FormulaFactor::number(texts, Symbol::Reflection, value),
        FormulaFactor::sign(weight),
        FormulaFactor::sign("·"),
        FormulaFactor::text(Symbol::Reflected, reflected),
    ];
    pair(rows, texts.get("in-formula-reflection"), 14.0, value == 0.0, symbols, numbers);
}

/// + k_t τ I_refracted, weighed by 1 − R(θ) if need be
fn transmission<'t>(rows: &mut Vec<FormulaRow<'t>>, texts: &'t Texts, phong: &Phong) {
    let refracted = texts.get("in-formula-refracted");
    let is_weighed = phong.weighs_by_angle() && phong.reflection() > 0.0;
    let weight = if is_weighed { " (1 − R(θ)) " } else { "" };
    let symbols = vec![
        FormulaFactor::sign("+ "),
        FormulaFactor::symbol(Symbol::Transmission),
        FormulaFactor::symbol(Symbol::Tint),
        FormulaFactor::sign(weight),
        FormulaFactor::text(Symbol::Refracted, refracted),
    ];
    let numbers = vec![
        FormulaFactor::number(texts, Symbol::Transmission, phong.transmission),
        FormulaFactor::sign("·"),
        FormulaFactor::color(texts, Symbol::Tint, phong.tint),
        FormulaFactor::sign(weight),
        FormulaFactor::sign("·"),
        FormulaFactor::text(Symbol::Refracted, refracted),
    ];
    pair(rows, texts.get("in-formula-transmission"), 14.0, phong.transmission == 0.0, symbols, numbers);
}

/// Snell's law and the critical angle, for what lets light through.
fn refraction_ui(ui: &mut Ui, texts: &Texts, memory: &mut InspectorState, phong: &Phong) {
    if phong.transmission == 0.0 {
        return;
    }
    let name = texts.get("in-formula-snell");
    let symbols = vec![
        FormulaFactor::sign("sin α = "),
        FormulaFactor::symbol(Symbol::Ior),
        FormulaFactor::sign(" sin β"),
    ];
    let numbers = vec![
        FormulaFactor::sign("sin α = "),
        FormulaFactor::number(texts, Symbol::Ior, phong.ior),
        FormulaFactor::sign(" · sin β"),
    ];
    let mut rows = Vec::new();
    pair(&mut rows, name, 0.0, false, symbols, numbers);
    rows_ui(ui, texts, memory, Id::unique("formula-snell"), &rows);
    let ratio = phong.ior.min(phong.ior.recip());
    if ratio < 1.0 {
        let angle = shown(texts, ratio.asin().to_degrees(), 1);
        let key = if phong.ior > 1.0 { "critical-angle" } else { "critical-angle-outside" };
        hint(ui, &texts.with(key, &[("angle", angle.into())]));
    }
}

/// I_1 = intensity · color, the law of falloff if there is one, and the name.
fn light_ui(ui: &mut Ui, texts: &Texts, light: &Light, number: usize, name: &str) {
    let palette = theme::palette(ui.visuals());
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 17.0), Sense::hover());
    let law = match light.falloff {
        Falloff::None => String::new(),
        Falloff::Linear { constant } => format!(",  A = 1/(d + {})", shown(texts, constant, 3)),
        Falloff::InverseSquare => ",  A = 1/d^2".to_owned(),
    };
    let markup = format!("I_{{{number}}} = {} · ", shown(texts, light.intensity, 3));
    let mut line = TextLine::default();
    line.push(ui, &markup, 12.0, palette.weak);
    line.push_chip(8.0, screen_color(light.color));
    line.push(ui, &format!("{}{law}", color_text(texts, light.color)), 12.0, palette.weak);
    line.space(8.0);
    let room = (rect.width() - line.width()).max(0.0);
    line.push_words(ui, name, 12.0, palette.weak, room);
    line.paint(ui, rect.left_center());
    let words = format!("{}{}{law} {name}", typeset::plain(&markup), color_text(texts, light.color));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &words));
}

/// What the lights of the sum send.
fn lights_ui(ui: &mut Ui, texts: &Texts, scene: &Scene) {
    let lit: Vec<_> = scene.lights.iter().filter(|light| !light.hidden).collect();
    if lit.is_empty() {
        hint(ui, texts.get("formula-no-light"));
        return;
    }
    for (index, light) in lit.iter().take(LISTED).enumerate() {
        let name = if light.name.is_empty() { texts.get("thing-light") } else { &light.name };
        light_ui(ui, texts, light, index + 1, name);
    }
    if lit.len() > LISTED {
        hint(ui, &texts.with("formula-more-lights", &[("count", (lit.len() - LISTED).into())]));
    }
}
