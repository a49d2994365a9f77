//! The form of a measurement.

use catoptric_lab::Variant;
use catoptric_lab::measure::{Axis, MeasurePlan, Parameter, Value, Variable};
use catoptric_lab::report::Language;
use catoptric_scene::format::spec::Limits;
use catoptric_scene::{Scene, ScenePath};
use catoptric_tracer::RenderSettings;
use catoptric_tracer::raster::{Method, MethodKind};
use egui::{Button, ComboBox, Id, Popup, PopupCloseBehavior, RichText, TextEdit, Ui};

use super::number_axis::{NumberDraft, NumberFault};
use super::questions::{QuestionsDraft, usual_pixel};
use crate::base::texts::{DecimalSign, Texts};
use crate::base::theme;
use crate::base::widgets::number::{NumberField, Unit, evaluate};
use crate::panels::method_chooser::methods_ui;
use crate::state::audit::PinnedPixel;
use crate::state::context::Cx;
use crate::state::methods::{MethodSettings, icon, method_key, report_language, short_key};

/// The largest picture that is offered, pixels along a side.
const MOST_SIDE: u32 = 8192;

/// The most rounds that are offered.
const MOST_ROUNDS: u32 = 1000;

/// The choices of the form.
pub(super) struct MeasureForm {
    /// What is varied; the second one may be nothing.
    axes: [AxisDraft; 2],
    questions: QuestionsDraft,
    pub(super) methods: MethodSettings,
    size: [u32; 2],
    rounds: u32,
}

/// What is varied, as typed.
enum AxisDraft {
    Nothing,
    Parameter(ParameterDraft),
    Number(NumberDraft),
}

/// A parameter and its values as typed.
struct ParameterDraft {
    parameter: Parameter,
    values: String,
}

/// What the list of an axis offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum AxisChoice {
    Nothing,
    Parameter(Parameter),
    Number,
}

/// The reason why a choice cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum MeasureFormError {
    /// A text is no value of the parameter.
    Value(Parameter, String),
    /// A number of the scene cannot be varied.
    Number(NumberFault),
    /// One thing is chosen twice.
    Twice,
}

impl Default for MeasureForm {
    fn default() -> Self {
        Self {
            axes: [AxisDraft::Parameter(ParameterDraft::usual(Parameter::Size)), AxisDraft::Nothing],
            questions: QuestionsDraft::default(),
            methods: MethodSettings::default(),
            size: [320, 180],
            rounds: MeasurePlan::ROUNDS,
        }
    }
}

impl AxisDraft {
    fn of(choice: AxisChoice, scene: &Scene) -> Self {
        match choice {
            AxisChoice::Nothing => Self::Nothing,
            AxisChoice::Parameter(parameter) => Self::Parameter(ParameterDraft::usual(parameter)),
            AxisChoice::Number => Self::Number(NumberDraft::of(scene, None)),
        }
    }

    fn choice(&self) -> AxisChoice {
        match self {
            Self::Nothing => AxisChoice::Nothing,
            Self::Parameter(draft) => AxisChoice::Parameter(draft.parameter),
            Self::Number(_) => AxisChoice::Number,
        }
    }

    /// The axis, if one was chosen.
    fn axis(&self, scene: &Scene) -> Result<Option<Axis>, MeasureFormError> {
        match self {
            Self::Nothing => Ok(None),
            Self::Parameter(draft) => draft.axis().map(Some),
            Self::Number(draft) => draft.axis(scene).map(Some).map_err(MeasureFormError::Number),
        }
    }
}

impl ParameterDraft {
    /// A parameter with the values that are usual for this machine.
    fn usual(parameter: Parameter) -> Self {
        let values = parameter.usual_values(catoptric_platform::threads::processors());
        let values = values.iter().map(Value::to_string).collect::<Vec<_>>().join(", ");
        Self { parameter, values }
    }

    fn axis(&self) -> Result<Axis, MeasureFormError> {
        let parameter = self.parameter;
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
        Ok(axis)
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
    /// Varies a number of the scene, or one whose address is still to be typed, instead of what was varied.
    pub(super) fn vary(&mut self, scene: &Scene, path: Option<&ScenePath>) {
        let [first, second] = &mut self.axes;
        *first = AxisDraft::Number(NumberDraft::of(scene, path));
        let is_same = |axis: &Axis| matches!(&axis.variable, Variable::Setting(other) if Some(other) == path);
        if second.axis(scene).is_ok_and(|axis| axis.as_ref().is_some_and(is_same)) {
            *second = AxisDraft::Nothing;
        }
    }

    /// What to measure, of a scene as it is seen through its own camera.
    pub(super) fn plan(
        &self,
        scene: &Scene,
        name: String,
        pin: Option<&PinnedPixel>,
    ) -> Result<MeasurePlan, MeasureFormError> {
        let [first, second] = &self.axes;
        let axes: Vec<Axis> = [first.axis(scene)?, second.axis(scene)?].into_iter().flatten().collect();
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
            questions: self.questions.asked(usual_pixel(scene, pin, self.size)),
            rounds: self.rounds,
            least_time: MeasurePlan::LEAST_TIME,
        })
    }

    /// Whether a parameter is varied.
    fn varies(&self, parameter: Parameter) -> bool {
        self.axes.iter().any(|axis| axis.choice() == AxisChoice::Parameter(parameter))
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
    pub(super) fn ui(&mut self, ui: &mut Ui, cx: &Cx<'_>) {
        let texts = cx.texts;
        let width = ui.available_width();
        let [first, second] = &mut self.axes;
        let is_changed = axis_ui(ui, cx, width, (first, "measure-vary", false));
        let is_changed = axis_ui(ui, cx, width, (second, "measure-vary-too", true)) || is_changed;
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
            let limits = Limits::new(1.0, f64::from(MOST_ROUNDS));
            whole_ui(ui, texts, texts.get("measure-rounds"), &mut self.rounds, limits);
        });
        ui.add_space(2.0);
        let usual = usual_pixel(cx.editor.scene(), cx.audit.pin(), self.size);
        self.questions.ui(ui, texts, usual, self.size);
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
            let limits = Limits::new(1.0, f64::from(MOST_SIDE));
            let named = |key| format!("{}: {}", texts.get("pane-measure"), texts.get(key));
            whole_ui(ui, texts, &named("render-width"), width, limits);
            ui.label("×");
            whole_ui(ui, texts, &named("render-height"), height, limits);
            ui.label(RichText::new(texts.get("render-pixels")).color(theme::palette(ui.visuals()).weak));
        });
    }
}

/// Draws what is varied and its values; returns whether something else was chosen.
fn axis_ui(
    ui: &mut Ui,
    cx: &Cx<'_>,
    width: f32,
    (draft, key, is_optional): (&mut AxisDraft, &'static str, bool),
) -> bool {
    let language = report_language(cx.texts);
    let mut picked = None;
    ui.label(RichText::new(cx.texts.get(key)).color(theme::palette(ui.visuals()).weak))
        .on_hover_text(cx.texts.tip(key).unwrap_or_default());
    let choice = draft.choice();
    let text = |choice| match choice {
        AxisChoice::Nothing => cx.texts.get("measure-nothing"),
        AxisChoice::Parameter(parameter) => language.parameter(parameter),
        AxisChoice::Number => cx.texts.get("measure-number"),
    };
    let choices = is_optional.then_some(AxisChoice::Nothing).into_iter();
    let choices = choices.chain([AxisChoice::Number]).chain(Parameter::ALL.map(AxisChoice::Parameter));
    let list = ComboBox::from_id_salt(key).selected_text(text(choice)).width(width - 8.0);
    let shown = list.height(300.0).show_ui(ui, |ui| {
        for offered in choices {
            let is_on = choice == offered;
            if ui.selectable_label(is_on, text(offered)).clicked() && !is_on {
                picked = Some(offered);
            }
        }
    });
    shown.response.accessible_name(cx.texts.get(key));
    if let Some(choice) = picked {
        *draft = AxisDraft::of(choice, cx.editor.scene());
    }
    match draft {
        AxisDraft::Nothing => {}
        AxisDraft::Parameter(draft) => values_ui(ui, cx.texts, language, width, draft),
        AxisDraft::Number(draft) => draft.ui(ui, cx, Id::unique(("measure address", key)), width),
    }
    picked.is_some()
}

/// Draws the values of a parameter.
fn values_ui(ui: &mut Ui, texts: &Texts, language: Language, width: f32, draft: &mut ParameterDraft) {
    let parameter = draft.parameter;
    let name = texts.with("measure-values", &[("parameter", language.parameter(parameter).into())]);
    let is_wrong = draft.axis().is_err();
    let mut edit = TextEdit::multiline(&mut draft.values).desired_rows(1).desired_width(width - 8.0);
    if is_wrong {
        edit = edit.text_color(theme::palette(ui.visuals()).error);
    }
    let response = ui.add(edit.return_key(None)).accessible_name(name);
    response.on_hover_text(texts.get(expected_key(parameter)));
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

/// Draws a field for a whole number.
pub(super) fn whole_ui(ui: &mut Ui, texts: &Texts, name: &str, value: &mut u32, limits: Limits) {
    let field = NumberField {
        texts,
        name,
        value: f64::from(*value),
        is_mixed: false,
        limits,
        speed: 0.5,
        decimals: 0,
        unit: Unit::None,
        edge: None,
        width: 54.0,
        explains: true,
    };
    if let Some(entered) = field.show(ui).value {
        *value = entered.round().clamp(limits.min, limits.max) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_is_read_or_named() {
        let mut chosen = ParameterDraft { parameter: Parameter::Size, values: "64x36; 128×72,".to_owned() };
        let axis = chosen.axis().unwrap();
        assert_eq!(axis.values, [Value::Size([64, 36]), Value::Size([128, 72])]);
        chosen.values = "64x36, large".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Size, "large".to_owned())));
        // The name of a parameter is no value of another.
        chosen = ParameterDraft { parameter: Parameter::Bodies, values: "10, threads".to_owned() };
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, "threads".to_owned())));
        chosen.values = "2^4, 3*(5 + 5)".to_owned();
        assert_eq!(chosen.axis().unwrap().values, [Value::Count(16), Value::Count(30)]);
        chosen.values = "10abc".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, "10abc".to_owned())));
        chosen.values = " , ".to_owned();
        assert_eq!(chosen.axis(), Err(MeasureFormError::Value(Parameter::Bodies, String::new())));
        for parameter in Parameter::ALL {
            assert!(ParameterDraft::usual(parameter).axis().is_ok(), "{parameter}");
        }
        let scene = Scene::default();
        let mut form = MeasureForm::default();
        form.axes[1] = AxisDraft::Parameter(ParameterDraft::usual(Parameter::Size));
        assert_eq!(form.plan(&scene, String::new(), None).unwrap_err(), MeasureFormError::Twice);
        form.axes[1] = AxisDraft::Parameter(ParameterDraft::usual(Parameter::Fineness));
        form.fit_method();
        assert_eq!(form.methods.kind(), MethodKind::Phong);
        assert_eq!(form.plan(&scene, String::new(), None).unwrap().axes.len(), 2);
        // A number takes the place of what was varied, and stands for one axis alone.
        let path: ScenePath = "camera.fov".parse().unwrap();
        form.axes[1] = AxisDraft::Number(NumberDraft::of(&scene, Some(&path)));
        form.vary(&scene, Some(&path));
        let plan = form.plan(&scene, String::new(), None).unwrap();
        assert_eq!(plan.axes.len(), 1);
        assert_eq!(plan.axes[0].variable, Variable::Setting(path));
        form.vary(&scene, None);
        let fault = form.plan(&scene, String::new(), None).unwrap_err();
        assert_eq!(fault, MeasureFormError::Number(NumberFault::Empty));
    }
}
