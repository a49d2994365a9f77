//! The form of a measurement.

use catoptric_lab::Variant;
use catoptric_lab::measure::{Axis, MeasurePlan, Parameter, Value};
use catoptric_lab::report::Language;
use catoptric_scene::Scene;
use catoptric_scene::format::spec::Limits;
use catoptric_tracer::RenderSettings;
use catoptric_tracer::raster::{Method, MethodKind};
use egui::{Button, ComboBox, Popup, PopupCloseBehavior, RichText, TextEdit, Ui};

use crate::base::texts::{DecimalSign, Texts};
use crate::base::theme;
use crate::base::widgets::number::{NumberField, Unit, evaluate};
use crate::panels::method_chooser::methods_ui;
use crate::state::methods::{MethodSettings, icon, method_key, report_language, short_key};

/// The largest picture that is offered, pixels along a side.
const MOST_SIDE: u32 = 8192;

/// The most rounds that are offered.
const MOST_ROUNDS: u32 = 1000;

/// The choices of the form.
pub(super) struct MeasureForm {
    /// What is varied; the second one may be nothing.
    axes: [ParameterDraft; 2],
    pub(super) methods: MethodSettings,
    size: [u32; 2],
    rounds: u32,
}

/// A parameter and its values as typed.
struct ParameterDraft {
    parameter: Option<Parameter>,
    values: String,
}

/// The reason why a choice cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum MeasureFormError {
    /// A text is no value of the parameter.
    Value(Parameter, String),
    /// One parameter is chosen twice.
    Twice,
}

impl Default for MeasureForm {
    fn default() -> Self {
        Self {
            axes: [ParameterDraft::usual(Some(Parameter::Size)), ParameterDraft::usual(None)],
            methods: MethodSettings::default(),
            size: [320, 180],
            rounds: MeasurePlan::ROUNDS,
        }
    }
}

impl ParameterDraft {
    /// A parameter with the values that are usual for this machine.
    fn usual(parameter: Option<Parameter>) -> Self {
        let threads = catoptric_platform::threads::processors();
        let values = parameter.map_or_else(Vec::new, |parameter| parameter.usual_values(threads));
        let values = values.iter().map(Value::to_string).collect::<Vec<_>>().join(", ");
        Self { parameter, values }
    }

    /// The axis, if one was chosen.
    fn axis(&self) -> Result<Option<Axis>, MeasureFormError> {
        let Some(parameter) = self.parameter else { return Ok(None) };
        let mut axis = Axis { variable: parameter.into(), values: Vec::new() };
        for word in self.values.split([',', ';']).map(str::trim).filter(|word| !word.is_empty()) {
            let wrong = || MeasureFormError::Value(parameter, word.to_owned());
            let value = computed(parameter, word);
            let read = Axis::read(&format!("{}={value}", parameter.key()), 1).map_err(|_| wrong())?;
            axis.values.extend(read.into_iter().next().ok_or_else(wrong)?.values);
        }
        if axis.values.is_empty() {
            return Err(MeasureFormError::Value(parameter, String::new()));
        }
        Ok(Some(axis))
    }
}

/// A count that is written as arithmetic, in figures; any other word as it is: in sizes, × is no product.
fn computed(parameter: Parameter, word: &str) -> String {
    if matches!(parameter, Parameter::Size | Parameter::Method | Parameter::Search) {
        return word.to_owned();
    }
    match evaluate(word, Unit::None, DecimalSign::Point) {
        Ok(count) if count.fract() == 0.0 && (0.0..1e15).contains(&count) => format!("{count}"),
        _ => word.to_owned(),
    }
}

impl MeasureForm {
    /// What to measure, of a scene as it is seen through its own camera.
    pub(super) fn plan(&self, scene: &Scene, name: String) -> Result<MeasurePlan, MeasureFormError> {
        let [first, second] = &self.axes;
        let axes: Vec<Axis> = [first.axis()?, second.axis()?].into_iter().flatten().collect();
        if let [one, other] = axes.as_slice()
            && one.variable == other.variable
        {
            return Err(MeasureFormError::Twice);
        }
        Ok(MeasurePlan {
            scene: scene.clone(),
            name,
            variant: Variant::from(self.methods.method()),
            settings: RenderSettings { width: self.size[0], height: self.size[1], samples: 1 },
            threads: 0,
            axes,
            questions: Vec::new(),
            rounds: self.rounds,
            least_time: MeasurePlan::LEAST_TIME,
        })
    }

    /// Whether a parameter is varied.
    fn varies(&self, parameter: Parameter) -> bool {
        self.axes.iter().any(|axis| axis.parameter == Some(parameter))
    }

    /// Chooses a method that the parameters say something of.
    fn fit_method(&mut self) {
        let kind = self.methods.kind();
        let is_faces =
            matches!(self.methods.method(), Method::Flat(_) | Method::Gouraud(_) | Method::Phong(_));
        if self.varies(Parameter::Method) {
            return;
        }
        if self.varies(Parameter::Fineness) && !is_faces {
            self.methods.choose(MethodKind::Phong);
        } else if self.varies(Parameter::CubeMapSize) && kind != MethodKind::CubeMap {
            self.methods.choose(MethodKind::CubeMap);
        }
    }

    /// Draws the fields, one below the other.
    pub(super) fn ui(&mut self, ui: &mut Ui, texts: &Texts) {
        let language = report_language(texts);
        let width = ui.available_width();
        let [first, second] = &mut self.axes;
        let is_changed = axis_ui(ui, texts, language, width, (first, "measure-vary", false));
        let is_changed =
            axis_ui(ui, texts, language, width, (second, "measure-vary-too", true)) || is_changed;
        if is_changed {
            self.fit_method();
        }
        ui.add_space(2.0);
        if !self.varies(Parameter::Method) {
            self.method_ui(ui, texts);
        }
        if !self.varies(Parameter::Size) {
            self.size_ui(ui, texts);
        }
        ui.horizontal(|ui| {
            ui.label(texts.get("measure-rounds"))
                .on_hover_text(texts.tip("measure-rounds").unwrap_or_default());
            whole_ui(ui, texts, texts.get("measure-rounds"), &mut self.rounds, MOST_ROUNDS);
        });
    }

    fn method_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        ui.horizontal(|ui| {
            ui.label(texts.get("measure-method"));
            let kind = self.methods.kind();
            let text = (icon(kind).rich_text().size(15.0), RichText::new(texts.get(short_key(kind))));
            let name = texts.with("viewport-method-name", &[("method", texts.get(method_key(kind)).into())]);
            let name = format!("{}: {name}", texts.get("pane-measure"));
            let response = ui.add(Button::new(text)).accessible_name(name);
            let response = response.on_hover_text(texts.tip(method_key(kind)).unwrap_or_default());
            Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
                ui.set_min_width(330.0);
                ui.set_max_width(330.0);
                methods_ui(ui, texts, &mut self.methods, false);
            });
        });
    }

    fn size_ui(&mut self, ui: &mut Ui, texts: &Texts) {
        ui.horizontal(|ui| {
            ui.label(texts.get("render-size")).on_hover_text(texts.tip("render-size").unwrap_or_default());
            let [width, height] = &mut self.size;
            let named = |key| format!("{}: {}", texts.get("pane-measure"), texts.get(key));
            whole_ui(ui, texts, &named("render-width"), width, MOST_SIDE);
            ui.label("×");
            whole_ui(ui, texts, &named("render-height"), height, MOST_SIDE);
            ui.label(RichText::new(texts.get("render-pixels")).color(theme::palette(ui.visuals()).weak));
        });
    }
}

/// Draws a parameter and its values; returns whether another parameter was chosen.
fn axis_ui(
    ui: &mut Ui,
    texts: &Texts,
    language: Language,
    width: f32,
    (chosen, key, is_optional): (&mut ParameterDraft, &'static str, bool),
) -> bool {
    let mut picked = None;
    ui.label(RichText::new(texts.get(key)).color(theme::palette(ui.visuals()).weak))
        .on_hover_text(texts.tip(key).unwrap_or_default());
    let text =
        chosen.parameter.map_or(texts.get("measure-nothing"), |parameter| language.parameter(parameter));
    let list = ComboBox::from_id_salt(key).selected_text(text).width(width - 8.0);
    let shown = list.show_ui(ui, |ui| {
        if is_optional
            && ui.selectable_label(chosen.parameter.is_none(), texts.get("measure-nothing")).clicked()
        {
            picked = Some(None);
        }
        for parameter in Parameter::ALL {
            let is_on = chosen.parameter == Some(parameter);
            if ui.selectable_label(is_on, language.parameter(parameter)).clicked() && !is_on {
                picked = Some(Some(parameter));
            }
        }
    });
    shown.response.accessible_name(texts.get(key));
    if let Some(parameter) = picked {
        *chosen = ParameterDraft::usual(parameter);
    }
    if let Some(parameter) = chosen.parameter {
        let name = texts.with("measure-values", &[("parameter", language.parameter(parameter).into())]);
        let is_wrong = chosen.axis().is_err();
        let mut edit = TextEdit::multiline(&mut chosen.values).desired_rows(1).desired_width(width - 8.0);
        if is_wrong {
            edit = edit.text_color(theme::palette(ui.visuals()).error);
        }
        let response = ui.add(edit.return_key(None)).accessible_name(name);
        response.on_hover_text(texts.get(expected_key(parameter)));
    }
    picked.is_some()
}

/// The message about the values that a parameter can have.
pub(super) const fn expected_key(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Size => "measure-expected-sizes",
        Parameter::Method => "measure-expected-methods",
        Parameter::Search => "measure-expected-search",
        Parameter::Bodies
        | Parameter::Generations
        | Parameter::Samples
        | Parameter::Threads
        | Parameter::Fineness
        | Parameter::CubeMapSize => "measure-expected-counts",
    }
}

fn whole_ui(ui: &mut Ui, texts: &Texts, name: &str, value: &mut u32, most: u32) {
    let field = NumberField {
        texts,
        name,
        value: f64::from(*value),
        is_mixed: false,
        limits: Limits::new(1.0, f64::from(most)),
        speed: 0.5,
        decimals: 0,
        unit: Unit::None,
        edge: None,
        width: 60.0,
        explains: true,
    };
    if let Some(entered) = field.show(ui).value {
        *value = (entered.round() as u32).clamp(1, most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_is_read_or_named() {
        let mut chosen =
            ParameterDraft { parameter: Some(Parameter::Size), values: "64x36; 128×72,".to_owned() };
        let axis = chosen.axis().unwrap().unwrap();
        assert_eq!(axis.values, [Value::Size([64, 36]), Value::Size([128, 72])]);
        chosen.values = "64x36, large".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Size, "large".to_owned())));
        // The name of a parameter is no value of another.
        chosen = ParameterDraft { parameter: Some(Parameter::Bodies), values: "10, threads".to_owned() };
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, "threads".to_owned())));
        chosen.values = "2^4, 3*(5 + 5)".to_owned();
        assert_eq!(chosen.axis().unwrap().unwrap().values, [Value::Count(16), Value::Count(30)]);
        chosen.values = "10abc".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, "10abc".to_owned())));
        chosen.values = " , ".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, String::new())));
        for parameter in Parameter::ALL {
            assert!(ParameterDraft::usual(Some(parameter)).axis().unwrap().is_some(), "{parameter}");
        }
        let mut form = MeasureForm::default();
        form.axes[1] = ParameterDraft::usual(Some(Parameter::Size));
        assert_eq!(form.plan(&Scene::default(), String::new()).unwrap_err(), MeasureFormError::Twice);
        form.axes[1] = ParameterDraft::usual(Some(Parameter::Fineness));
        form.fit_method();
        assert_eq!(form.methods.kind(), MethodKind::Phong);
        assert_eq!(form.plan(&Scene::default(), String::new()).unwrap().axes.len(), 2);
    }
}
