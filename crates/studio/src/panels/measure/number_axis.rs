//! A number of the scene as what is varied: its address and a range.

use catoptric_lab::measure::{Axis, MeasurePlan};
use catoptric_scene::format::spec::{KeySpec, Kind, Limits};
use catoptric_scene::{AddressError, Scene, ScenePath, SceneValue};
use egui::{Id, Label, RichText, Ui};

use super::address_field::AddressField;
use super::form::whole_ui;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::number::{NumberField, Unit};
use crate::state::context::Cx;

/// The steps of a range to begin with.
const STEPS: u32 = 9;

/// The decimals of an end of the range.
const DECIMALS: usize = 6;

/// A number of the scene and its range, as typed.
#[derive(Default)]
pub(super) struct NumberDraft {
    address: AddressField,
    range: [f64; 2],
    steps: u32,
    /// The address that the range belongs to.
    of: Option<ScenePath>,
}

/// The reason why a number cannot be varied.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NumberFault {
    /// No address was typed.
    Empty,
    /// It leads nowhere.
    Address(AddressError),
    /// What stands there is no number.
    NotNumber(String),
    /// The range has one number.
    OneNumber,
}

/// A number of the scene.
struct SceneNumber {
    path: ScenePath,
    key: &'static KeySpec,
    value: f64,
}

impl NumberDraft {
    /// A number with a range that is usual for it; no address if none is given, to be typed at once.
    pub(super) fn of(scene: &Scene, path: Option<&ScenePath>) -> Self {
        let address = AddressField::new(path.map(ScenePath::to_string).unwrap_or_default());
        let mut draft = Self { address, ..Self::default() };
        draft.fit_range(scene);
        draft
    }

    /// What stands at the address.
    fn number(&self, scene: &Scene) -> Result<SceneNumber, NumberFault> {
        let text = self.address.text.trim();
        if text.is_empty() {
            return Err(NumberFault::Empty);
        }
        let path: ScenePath = text.parse().map_err(NumberFault::Address)?;
        let key = scene.key(&path).map_err(NumberFault::Address)?;
        match scene.get(&path).map_err(NumberFault::Address)? {
            SceneValue::Number(value) => Ok(SceneNumber { path, key, value }),
            _ => Err(NumberFault::NotNumber(text.to_owned())),
        }
    }

    /// Gives another number its usual range.
    fn fit_range(&mut self, scene: &Scene) {
        let Ok(number) = self.number(scene) else { return };
        if self.of.as_ref() != Some(&number.path) {
            self.range = Axis::usual_range(number.key, number.value);
            let whole = (self.range[1] - self.range[0]) as u32 + 1;
            self.steps = if is_whole(number.key) { STEPS.min(whole) } else { STEPS };
            self.of = Some(number.path);
        }
    }

    /// The number with its range.
    pub(super) fn axis(&self, scene: &Scene) -> Result<Axis, NumberFault> {
        let SceneNumber { path, key, .. } = self.number(scene)?;
        let axis = Axis::over(path, key, self.range, self.steps as usize);
        axis.filter(|axis| self.range[0] != self.range[1] && axis.values.len() > 1)
            .ok_or(NumberFault::OneNumber)
    }

    /// Draws the address, what is wrong with it, and the range.
    pub(super) fn ui(&mut self, ui: &mut Ui, cx: &Cx<'_>, id: Id, width: f32) {
        let scene = cx.editor.scene();
        let fault = self.axis(scene).err();
        let is_wrong = matches!(fault, Some(NumberFault::Address(_) | NumberFault::NotNumber(_)));
        if self.address.ui(ui, cx, id, width - 8.0, is_wrong) {
            self.fit_range(scene);
        }
        if let Ok(number) = self.number(scene) {
            let meaning = number.key.meaning(cx.texts.language().into());
            ui.add(Label::new(RichText::new(meaning).small().weak()).wrap());
            self.range_ui(ui, cx.texts, number.key);
        }
        if let Some(fault) = fault {
            let palette = theme::palette(ui.visuals());
            let color = if fault == NumberFault::Empty { palette.weak } else { palette.error };
            ui.add(Label::new(RichText::new(fault.in_words(cx.texts)).color(color).small()).wrap());
        }
    }

    fn range_ui(&mut self, ui: &mut Ui, texts: &Texts, key: &KeySpec) {
        ui.horizontal(|ui| self.ends_ui(ui, texts, key));
        ui.horizontal(|ui| {
            ui.label(texts.get("measure-steps"))
                .on_hover_text(texts.tip("measure-steps").unwrap_or_default());
            let limits = Limits::new(2.0, MeasurePlan::MOST_POINTS as f64);
            whole_ui(ui, texts, texts.get("measure-steps"), &mut self.steps, limits);
        });
    }

    fn ends_ui(&mut self, ui: &mut Ui, texts: &Texts, key: &KeySpec) {
        let ends = [("measure-from", "measure-from-name"), ("measure-to", "measure-to-name")];
        for (end, (label, name)) in self.range.iter_mut().zip(ends) {
            ui.label(texts.get(label));
            let field = NumberField {
                texts,
                name: texts.get(name),
                value: *end,
                is_mixed: false,
                limits: key.limits().unwrap_or(Limits::PLACE),
                speed: 0.01 * end.abs().max(1.0),
                decimals: if is_whole(key) { 0 } else { DECIMALS },
                unit: Unit::None,
                edge: None,
                width: 84.0,
                explains: true,
            };
            if let Some(value) = field.show(ui).value {
                *end = value;
            }
        }
    }
}

fn is_whole(key: &KeySpec) -> bool {
    matches!(key.kind, Kind::Integer(_))
}

impl NumberFault {
    /// What is wrong, in the language of the window.
    pub(super) fn in_words(&self, texts: &Texts) -> String {
        match self {
            Self::Empty => texts.get("measure-address-empty").to_owned(),
            Self::Address(error) => address_words(texts, error),
            Self::NotNumber(address) => {
                texts.with("measure-address-no-number", &[("address", address.as_str().into())])
            }
            Self::OneNumber => texts.get("measure-range-empty").to_owned(),
        }
    }
}

/// What is wrong with an address or its value, and what is allowed.
pub(super) fn address_words(texts: &Texts, error: &AddressError) -> String {
    let language = texts.language().into();
    let parts = [Some(error.message(language)), error.label(language), error.help(language)];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ").replace('`', "")
}

#[cfg(test)]
mod tests {
    use catoptric_lab::measure::Value;

    use super::*;

    fn scene() -> Scene {
        let text = "format = 'catoptric/1'\n[[bodies]]\nname = 'ball'\nradius = 0.5\nposition = [1, 2, 3]\n";
        catoptric_scene::read(text).into_result().unwrap().value
    }

    fn draft(scene: &Scene, address: &str) -> NumberDraft {
        let address = AddressField::new(address.to_owned());
        let mut draft = NumberDraft { address, ..NumberDraft::default() };
        draft.fit_range(scene);
        draft
    }

    #[test]
    fn an_address_brings_its_range() {
        let scene = scene();
        let radius = draft(&scene, " bodies.ball.radius");
        assert_eq!((radius.range, radius.steps), ([0.25, 1.0], STEPS));
        let axis = radius.axis(&scene).unwrap();
        assert_eq!(axis.variable.to_string(), "bodies.ball.radius");
        assert_eq!(axis.values.len(), 9);
        assert_eq!(axis.values.last().and_then(Value::number), Some(1.0));
        let mut generations = draft(&scene, "tracing.generations");
        assert_eq!((generations.range, generations.steps), ([3.0, 12.0], STEPS));
        generations.range = [1.0, 2.0];
        assert_eq!(generations.axis(&scene).unwrap().values.len(), 2);
        // A range of one's own stays with its number.
        generations.fit_range(&scene);
        assert_eq!(generations.range, [1.0, 2.0]);
    }

    #[test]
    fn what_cannot_be_varied_is_said() {
        let scene = scene();
        let fault = |address: &str| draft(&scene, address).axis(&scene).unwrap_err();
        assert_eq!(fault(" "), NumberFault::Empty);
        assert_eq!(fault("bodies.ball.shape"), NumberFault::NotNumber("bodies.ball.shape".to_owned()));
        assert_eq!(fault("camera.position"), NumberFault::NotNumber("camera.position".to_owned()));
        let texts = Texts::new(crate::base::texts::Language::English);
        for (address, said) in [
            ("bodies.bal.radius", "ball"),
            ("bodies.ball.radios", "radius"),
            ("camera..fov", "address"),
            ("camera.position.w", "x"),
            ("camera", "fov"),
        ] {
            let words = fault(address).in_words(&texts);
            assert!(matches!(fault(address), NumberFault::Address(_)) && words.contains(said), "{words}");
        }
        let mut ends = draft(&scene, "bodies.ball.radius");
        ends.range = [0.5, 0.5];
        assert_eq!(ends.axis(&scene), Err(NumberFault::OneNumber));
        let mut whole = draft(&scene, "tracing.generations");
        whole.range = [3.0, 3.0];
        assert_eq!(whole.axis(&scene), Err(NumberFault::OneNumber));
    }
}
