//! Rows with three numbers.

use super::*;
use crate::base::widgets::explained_icon_button;
use crate::base::widgets::number::list;
use egui_material_icons::icons::{ICON_LINK, ICON_LINK_OFF};

/// The way that a change of the primary thing's vector applies to the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VectorSpread {
    /// The changed component becomes the same for all.
    Same,
    /// All change by the same difference.
    Offset,
}

/// A row with three numbers.
pub(crate) struct VectorRow<T> {
    pub(crate) what: RowQuantity,
    pub(crate) spread: VectorSpread,
    /// How much a point of dragging changes a component.
    pub(crate) speed: f64,
    pub(crate) decimals: usize,
    /// Where the memory has whether the components keep their ratios; `None` when they never do.
    pub(crate) link: Option<fn(&mut InspectorState) -> &mut bool>,
    pub(crate) get: fn(&T) -> Option<DVec3>,
    pub(crate) set: fn(&mut T, DVec3),
}

/// The vectors at the start of a gesture, so that rounding does not accumulate.
#[derive(Clone, Debug, Default)]
pub(crate) struct StartVectors {
    label: Option<Label>,
    vectors: Vec<Option<DVec3>>,
}

const LINK: f32 = 22.0;

impl<T> VectorRow<T> {
    /// A row with three numbers that spread like this over several things.
    pub(crate) const fn new(
        what: RowQuantity,
        spread: VectorSpread,
        get: fn(&T) -> Option<DVec3>,
        set: fn(&mut T, DVec3),
    ) -> Self {
        Self { what, spread, speed: 0.01, decimals: 3, link: None, get, set }
    }

    /// Sets the speed of dragging and the number of decimals.
    pub(crate) const fn tuned(mut self, speed: f64, decimals: usize) -> Self {
        self.speed = speed;
        self.decimals = decimals;
        self
    }

    /// Adds a button that keeps the ratios of the components.
    pub(crate) const fn linked(mut self, link: fn(&mut InspectorState) -> &mut bool) -> Self {
        self.link = Some(link);
        self
    }
}

impl<T> PropertySheet<'_, '_, T> {
    /// Draws a row with three numbers.
    pub(crate) fn vector(&mut self, ui: &mut Ui, vector: &VectorRow<T>) {
        let default = vector.what.spec().and_then(KeySpec::default_vector).map(DVec3::from_array);
        let Some(value) = (vector.get)(self.primary) else { return };
        let tip = self.tip(&vector.what, default.map(|value| vector_text(self.texts(), value)));
        self.row(ui, &vector.what, vector.what.unit, tip, |sheet, ui| {
            sheet.vector_contents(ui, vector, value, default);
        });
    }

    fn vector_contents(&mut self, ui: &mut Ui, vector: &VectorRow<T>, value: DVec3, default: Option<DVec3>) {
        let what = &vector.what;
        let name = what.label(self.texts());
        let room = control_width(ui) - if vector.link.is_some() { LINK + GAP } else { 0.0 };
        let width = ((room - 2.0 * GAP) / 3.0).floor();
        let mut new = None;
        for axis in 0..3 {
            if let Some(component) = self.component(ui, vector, &name, value, axis, width) {
                new = Some((axis, component));
            }
        }
        if let Some(link) = vector.link {
            self.link_button(ui, link, &name);
        }
        let is_mixed = vector.spread == VectorSpread::Same && self.is_mixed(vector.get);
        let is_default = default.is_none_or(|default| !is_mixed && value == default);
        let default_text = default.map(|value| vector_text(self.texts(), value)).unwrap_or_default();
        if self.reset(ui, is_default, &name, &default_text)
            && let Some(default) = default
        {
            self.change(what.key, what.edit, |_, thing| {
                if (vector.get)(thing).is_some() {
                    (vector.set)(thing, default);
                }
            });
        } else if let Some((axis, component)) = new {
            self.spread(vector, value, axis, component);
        }
    }

    /// Draws the field of one component.
    fn component(
        &mut self,
        ui: &mut Ui,
        vector: &VectorRow<T>,
        name: &str,
        value: DVec3,
        axis: usize,
        width: f32,
    ) -> Option<f64> {
        let texts = self.texts();
        let number = component_of(value, axis);
        let is_mixed = vector.spread == VectorSpread::Same
            && self.is_mixed(|thing| (vector.get)(thing).map(|value| component_of(value, axis)));
        let letter = ["X", "Y", "Z"].get(axis).copied().unwrap_or_default();
        let palette = theme::palette(ui.visuals());
        let name = format!("{name} {letter}");
        let unit = vector.what.unit.suffix(texts);
        let field = NumberField {
            texts,
            name: &name,
            value: number,
            is_mixed,
            limits: vector.what.limits(),
            speed: vector.speed * (number.abs() / 10.0).max(1.0),
            decimals: vector.decimals,
            unit: vector.what.unit,
            edge: palette.axes.get(axis).copied(),
            width,
            explains: false,
        };
        let entered = field.show(ui);
        self.cx.view.is_moving |= entered.response.dragged();
        let full = format!("{letter}  {}{unit}", exact(texts, number));
        let typed = self.typed(vector.what.key, &entered);
        self.number_menu(&entered.response, &vector.what, Some(axis));
        tip_beside(ui, entered.response, &full);
        typed
    }

    fn link_button(&mut self, ui: &mut Ui, link: fn(&mut InspectorState) -> &mut bool, name: &str) {
        let texts = self.texts();
        let is_linked = link(self.memory);
        let icon = if *is_linked { ICON_LINK } else { ICON_LINK_OFF };
        let label = texts.with("linked-of", &[("name", name.into())]);
        let tip = texts.tip("linked").unwrap_or_default();
        if explained_icon_button(ui, icon, &label, tip, *is_linked).clicked() {
            *is_linked = !*is_linked;
        }
    }

    /// Carries the change of the primary thing's vector to all.
    fn spread(&mut self, vector: &VectorRow<T>, old: DVec3, axis: usize, component: f64) {
        let what = &vector.what;
        let is_linked = vector.link.is_some_and(|link| *link(self.memory));
        let starts = self.starts(vector);
        let origin = starts.first().copied().flatten().unwrap_or(old);
        let new = moved(if is_linked { origin } else { old }, axis, component, is_linked);
        let (spread, get, set) = (vector.spread, vector.get, vector.set);
        self.change(what.key, what.edit, |index, thing| {
            let Some(current) = get(thing) else { return };
            let start = starts.get(index).copied().flatten().unwrap_or(current);
            let result = match spread {
                // The primary one becomes exactly what was entered.
                _ if index == 0 => new,
                VectorSpread::Offset => tidy_vector(start + (new - origin)),
                VectorSpread::Same if is_linked => tidy_vector(start * (new / origin)),
                VectorSpread::Same => moved(current, axis, component, false),
            };
            set(thing, result);
        });
    }

    /// The vectors of all things when the gesture on this row began.
    fn starts(&mut self, vector: &VectorRow<T>) -> Vec<Option<DVec3>> {
        let label = Label::new(vector.what.edit, self.subject.clone());
        let is_going_on = self.cx.editor.gesture_label() == Some(&label);
        let starts = &mut self.memory.starts;
        if !is_going_on || starts.label.as_ref() != Some(&label) || starts.vectors.len() != self.things.len()
        {
            *starts = StartVectors {
                label: Some(label),
                vectors: self.things.iter().map(|thing| (vector.get)(thing)).collect(),
            };
        }
        starts.vectors.clone()
    }
}

/// The vector with one component replaced, and the others in proportion when they are linked.
fn moved(value: DVec3, axis: usize, component: f64, is_linked: bool) -> DVec3 {
    let old = component_of(value, axis);
    if is_linked && value.x == value.y && value.y == value.z {
        return DVec3::splat(component);
    }
    let mut new = if is_linked && old != 0.0 { tidy_vector(value * (component / old)) } else { value };
    if let Some(slot) = new.as_mut().get_mut(axis) {
        *slot = component;
    }
    new
}

fn component_of(value: DVec3, axis: usize) -> f64 {
    value.as_ref().get(axis).copied().unwrap_or_default()
}

/// A vector free of the noise of binary arithmetic.
pub(crate) fn tidy_vector(value: DVec3) -> DVec3 {
    value.map(tidy)
}

/// A vector for people.
pub(crate) fn vector_text(texts: &Texts, value: DVec3) -> String {
    list(texts, value.to_array().map(|part| exact(texts, part)))
}
