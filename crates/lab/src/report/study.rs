//! The files of a report on a measurement: data, tables, plots, and the text around them.

mod figures;

use std::borrow::Cow;
use std::fmt::Write as _;

use catoptric_picture::{BitDepth, Development, encode_png};

use super::csv::{points_csv, runs_csv};
use super::language::Language;
use super::plot::{Plot, PlotAxis, PlotCurve, PlotMark};
use super::raster::{RasterError, rasterize};
use super::tables::{Table, markdown, tex};
use super::texts::fill;
use crate::machine::Machine;
use crate::measure::{
    Fit, GrowthLaw, MeasuredPoint, Measurement, Parameter, PictureQuestion, Series, Summary, Variable, series,
};

pub use figures::{MeasurementFigure, figures};

/// The files of a report, by name.
#[derive(Clone, Debug)]
pub struct MeasurementReport {
    /// Names and contents, in the order in which to name them.
    pub files: Vec<(String, Vec<u8>)>,
    /// The laws in words, a line for each curve.
    pub laws: Vec<String>,
}

impl MeasurementReport {
    /// The names that files can have, if these questions are asked.
    pub fn names(questions: &[PictureQuestion]) -> Vec<String> {
        let plots = ["time".to_owned(), "rays".to_owned()];
        let plots = plots.into_iter().chain(questions.iter().map(PictureQuestion::file_stem));
        let plots = plots.flat_map(|stem| [format!("{stem}.png"), format!("{stem}.svg")]);
        let others = ["runs.csv", "points.csv", "report.md", "report.tex"].map(str::to_owned);
        others.into_iter().chain(plots).collect()
    }
}

/// Pixels for each unit of a plot's size.
const SHARPNESS: f32 = 2.0;

/// Makes the files: `runs.csv` (every measurement), `points.csv` (their summaries, with what the pictures answer),
/// `time.svg` and `time.png`, two more for each question, for generations `rays.svg` and `rays.png` in any case,
/// `report.md` and `report.tex`.
///
/// Plots as pixels are left out where the library is built without `plots`.
///
/// The CSV files are the same in every language: decimal points and English heads.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn study(measured: &Measurement, language: Language) -> Result<MeasurementReport, RasterError> {
    let chapter = ReportWriter { measured, curves: series(measured), language };
    let mut files = vec![
        ("runs.csv".to_owned(), runs_csv(measured).into_bytes()),
        ("points.csv".to_owned(), points_csv(measured).into_bytes()),
    ];
    for figure in chapter.figures() {
        let (stem, svg) = (figure.file_stem(), chapter.figure_plot(figure).svg());
        if cfg!(feature = "plots") {
            files.push((format!("{stem}.png"), png(&svg)?));
        }
        files.push((format!("{stem}.svg"), svg.into_bytes()));
    }
    files.push(("report.md".to_owned(), chapter.markdown().into_bytes()));
    files.push(("report.tex".to_owned(), chapter.latex().into_bytes()));
    Ok(MeasurementReport {
        files,
        laws: chapter.curves.iter().map(|curve| chapter.law_line(curve)).collect(),
    })
}

/// The laws in words, a line for each curve.
pub fn law_lines(measured: &Measurement, language: Language) -> Vec<String> {
    let chapter = ReportWriter { measured, curves: series(measured), language };
    chapter.curves.iter().map(|curve| chapter.law_line(curve)).collect()
}

fn png(svg: &str) -> Result<Vec<u8>, RasterError> {
    let picture = rasterize(svg, SHARPNESS)?;
    let developed = Development::default().develop(&picture, BitDepth::Eight)?;
    Ok(encode_png(&developed)?)
}

/// What a reader must know of a machine, rows of a name and a value.
pub fn machine_rows(machine: &Machine, language: Language) -> Vec<Vec<String>> {
    let known = |text: &str| if text.is_empty() { language.unknown().to_owned() } else { text.to_owned() };
    let cores = machine.cores.map_or_else(|| language.unknown().to_owned(), |cores| cores.to_string());
    let memory = match machine.memory_bytes {
        0 => language.unknown().to_owned(),
        bytes => format!("{} {}", language.fixed(bytes as f64 / f64::from(1 << 30), 1), language.gibibytes()),
    };
    [
        (language.processor(), known(&machine.processor)),
        (language.cores(), format!("{cores} / {}", machine.threads)),
        (language.memory(), memory),
        (language.system(), known(&machine.system)),
        (language.program(), machine.program.clone()),
    ]
    .map(|(item, value)| vec![item.to_owned(), value])
    .to_vec()
}

/// A plot of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ReportFigure {
    /// The times.
    Time,
    /// The numbers of rays.
    Rays,
    /// What the pictures answer to the question at this place.
    Answer(usize, PictureQuestion),
}

impl ReportFigure {
    fn file_stem(self) -> String {
        match self {
            Self::Time => "time".to_owned(),
            Self::Rays => PictureQuestion::Rays.file_stem(),
            Self::Answer(_, question) => question.file_stem(),
        }
    }
}

/// How a name is written in a format, so that nothing in it is markup.
type Escape = fn(&str) -> String;

/// Writes the text around the measurements.
struct ReportWriter<'a> {
    measured: &'a Measurement,
    curves: Vec<Series<'a>>,
    language: Language,
}

impl ReportWriter<'_> {
    /// Whether the first axis varies a parameter.
    fn varies(&self, parameter: Parameter) -> bool {
        self.measured.axes.first().is_some_and(|axis| axis.variable == parameter.into())
    }

    /// What the first axis varies, after "depending on".
    fn depending_on(&self) -> Cow<'static, str> {
        let first = self.measured.axes.first();
        first.map_or(Cow::Borrowed(""), |axis| self.language.depending_on(&axis.variable))
    }

    /// The letter of the first axis in formulas.
    fn letter(&self) -> &'static str {
        self.measured.axes.first().map_or("x", |axis| self.language.letter(&axis.variable))
    }

    /// The title of an axis, with the unit of a value of the scene.
    fn axis_title(&self, index: usize) -> String {
        let Some(axis) = self.measured.axes.get(index) else { return String::new() };
        let title = self.language.variable(&axis.variable);
        match self.measured.keys.get(index).copied().flatten().and_then(|key| key.unit(self.language.into()))
        {
            Some(unit) => format!("{title}, {unit}"),
            None => title.into_owned(),
        }
    }

    fn filled(&self, text: &str) -> String {
        self.filled_with(text, str::to_owned)
    }

    /// A text with the names of the scene and of what is varied, as a format needs them.
    fn filled_with(&self, text: &str, escape: Escape) -> String {
        let (parameter, scene) = (escape(&self.depending_on()), escape(&self.measured.name));
        fill(text, &[("parameter", &parameter), ("scene", &scene)])
    }

    fn law_formula(&self, fit: &Fit) -> String {
        let (x, language) = (self.letter(), self.language);
        let value = |symbol: &str| fit.coefficient(symbol).map_or(f64::NAN, |found| found.value);
        let number = |symbol: &str| language.significant(value(symbol).abs(), 3);
        let sign = |symbol: &str| if value(symbol) < 0.0 { "−" } else { "+" };
        let lead = |symbol: &str| language.significant(value(symbol), 3);
        match fit.law {
            GrowthLaw::Constant => format!("t = {}", lead("a")),
            GrowthLaw::Linear => format!("t = {} {} {}·{x}", lead("a"), sign("b"), number("b")),
            GrowthLaw::Square => format!("t = {} {} {}·{x}²", lead("a"), sign("b"), number("b")),
            GrowthLaw::Power => format!("t = {}·{x}^{}", lead("c"), language.fixed(value("α"), 3)),
            GrowthLaw::Bounded => format!("t = {} − {}·{}^{x}", lead("a"), number("b"), number("q")),
            GrowthLaw::Geometric => format!("t = {} + {}·{}^{x}", lead("a"), number("b"), number("q")),
            GrowthLaw::Amdahl => format!("t = {} {} {}/{x}", lead("a"), sign("b"), number("b")),
        }
    }

    fn curve_name(&self, curve: &Series<'_>) -> String {
        match (curve.value, self.measured.axes.get(1)) {
            (Some(value), Some(axis)) => {
                format!("{}: {}", self.language.variable(&axis.variable), self.language.value_name(value))
            }
            _ => String::new(),
        }
    }

    /// The law of a curve in words.
    fn law_line(&self, curve: &Series<'_>) -> String {
        let name = self.curve_name(curve);
        let law = match &curve.law {
            None if self.measured.keys.first().is_some_and(Option::is_some) => self.no_law().to_owned(),
            None => "–".to_owned(),
            Some(fit) => format!(
                "{}, {}, R² = {}",
                self.language.law_name(fit.law),
                self.law_formula(fit),
                self.language.fixed(fit.r_squared, 4)
            ),
        };
        if name.is_empty() { law } else { format!("{name}: {law}") }
    }

    fn time_plot(&self) -> Plot {
        let marks = |curve: &Series<'_>| {
            let marks = curve.points.iter().zip(0_u32..).map(|((point, summary), index)| {
                let all = point.runs.iter().enumerate();
                let all = all.map(|(place, run)| (run.draw, summary.outliers.contains(&place)));
                let x = point.number().unwrap_or(f64::from(index));
                PlotMark { x, y: summary.median, low: summary.low, high: summary.high, all: all.collect() }
            });
            marks.collect()
        };
        let curves = self.curves.iter().map(|curve| PlotCurve {
            label: self.curve_name(curve),
            marks: marks(curve),
            law: curve.law.as_ref().map(|fit| self.law_curve(curve, fit)),
        });
        let caption = self.figure_caption(ReportFigure::Time, str::to_owned);
        self.plot(caption, self.language.time_axis(), curves.collect())
    }

    fn rays_plot(&self) -> Plot {
        let curves = self.curves.iter().map(|curve| {
            let marks = curve.points.iter().zip(0_u32..).map(|((point, _), index)| {
                let (x, rays) = (point.number().unwrap_or(f64::from(index)), point.rays.total() as f64);
                PlotMark { x, y: rays, low: rays, high: rays, all: Vec::new() }
            });
            PlotCurve {
                label: self.curve_name(curve),
                marks: marks.collect(),
                law: curve.rays.as_ref().map(|fit| self.law_curve(curve, fit)),
            }
        });
        let caption = self.figure_caption(ReportFigure::Rays, str::to_owned);
        self.plot(caption, self.language.rays_axis(), curves.collect())
    }

    fn plot(&self, description: String, y_title: &str, curves: Vec<PlotCurve>) -> Plot {
        let language = self.language;
        let ys = || curves.iter().flat_map(|curve| &curve.marks).map(|mark| mark.y);
        let xs = || curves.iter().flat_map(|curve| &curve.marks).map(|mark| mark.x);
        let spread = |values: &dyn Fn() -> Vec<f64>| {
            let values = values();
            let high = values.iter().copied().fold(0.0, f64::max);
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            if low > 0.0 { high / low } else { 0.0 }
        };
        let wide = spread(&|| ys().collect()) > 30.0;
        let (x_log, y_log) = match self.measured.axes.first().map(|axis| &axis.variable) {
            Some(Variable::Parameter(Parameter::Bodies | Parameter::Fineness | Parameter::CubeMapSize)) => {
                let log = spread(&|| xs().collect()) > 8.0;
                (log, log)
            }
            Some(Variable::Parameter(Parameter::Size | Parameter::Samples)) => (false, false),
            _ => (false, wide),
        };
        let names = match self.measured.axes.first() {
            Some(axis) if axis.values.iter().any(|value| value.number().is_none()) => {
                axis.values.iter().map(|value| language.value_name(value)).collect()
            }
            _ => Vec::new(),
        };
        Plot {
            description,
            x: PlotAxis { title: self.axis_title(0), logarithmic: x_log, names },
            y: PlotAxis { title: y_title.to_owned(), logarithmic: y_log, names: Vec::new() },
            curves,
            language,
        }
    }

    /// A law's name and its values between the first and the last point.
    fn law_curve(&self, curve: &Series<'_>, fit: &Fit) -> (String, Vec<(f64, f64)>) {
        let xs: Vec<f64> = curve.points.iter().filter_map(|(point, _)| point.number()).collect();
        let (low, high) =
            xs.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), &x| (low.min(x), high.max(x)));
        let steps = 120_u32;
        let at = |step: u32| {
            let part = f64::from(step) / f64::from(steps);
            let x = if low > 0.0 { low * (high / low).powf(part) } else { low + (high - low) * part };
            (x, fit.at(x))
        };
        (self.law_formula(fit), (0..=steps).map(at).collect())
    }

    fn times_table(&self) -> Table {
        let language = self.language;
        let axes = self.axis_heads();
        let (ms, prepare) = (language.milliseconds(), language.prepare());
        let heads = axes.into_iter().chain([
            format!("{}, {ms}", language.median()),
            format!("{}, {ms}", language.interval_head()),
            language.runs().to_owned(),
            language.outliers().to_owned(),
            format!("{prepare}, {ms}"),
            language.rays().to_owned(),
        ]);
        let rows = self.curves.iter().flat_map(|curve| &curve.points);
        let rows = rows.map(|(point, summary)| self.time_row(point, summary));
        Table { caption: self.filled(language.times_caption()), heads: heads.collect(), rows: rows.collect() }
    }

    fn time_row(&self, point: &MeasuredPoint, summary: &Summary) -> Vec<String> {
        let language = self.language;
        self.place_cells(point)
            .into_iter()
            .chain([
                language.significant(summary.median, 4),
                language.interval(summary.low, summary.high, 3),
                summary.count.to_string(),
                summary.outliers.len().to_string(),
                language.significant(point.preparing(), 3),
                language.count(point.rays.total()),
            ])
            .collect()
    }

    /// The heads of the columns that say which point a row is about.
    fn axis_heads(&self) -> Vec<String> {
        (0..self.measured.axes.len()).map(|index| self.axis_title(index)).collect()
    }

    /// The cells below them.
    fn place_cells(&self, point: &MeasuredPoint) -> Vec<String> {
        let language = self.language;
        let cells = point.values.iter().map(|value| match (value, value.number()) {
            (crate::measure::Value::Size(_), Some(pixels)) => {
                format!("{} = {}", language.value_name(value), language.fixed(pixels, 0))
            }
            _ => language.value_name(value),
        });
        cells.collect()
    }

    /// What the pictures answer to a question.
    fn answers_table(&self, place: usize, question: PictureQuestion) -> Table {
        let language = self.language;
        let heads = self.axis_heads().into_iter().chain(language.answer_columns(question));
        let row = |point: &MeasuredPoint| {
            let numbers = point.answers.get(place).into_iter().flatten().map(|&number| match question {
                PictureQuestion::Rays => language.fixed(number, 0),
                _ => language.significant(number, 5),
            });
            self.place_cells(point).into_iter().chain(numbers).collect()
        };
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        Table {
            caption: self.answer_caption(question, str::to_owned),
            heads: heads.collect(),
            rows: points.map(|(point, _)| row(point)).collect(),
        }
    }

    /// What the pictures answer to a question, the last of its numbers.
    fn answers_plot(&self, place: usize, question: PictureQuestion) -> Plot {
        let curves = self.curves.iter().map(|curve| {
            let marks = curve.points.iter().zip(0_u32..).filter_map(|((point, _), index)| {
                let y = *point.answers.get(place)?.last()?;
                let x = point.number().unwrap_or(f64::from(index));
                Some(PlotMark { x, y, low: y, high: y, all: Vec::new() })
            });
            PlotCurve { label: self.curve_name(curve), marks: marks.collect(), law: None }
        });
        let caption = self.answer_caption(question, str::to_owned);
        let axis = self.language.answer_columns(question).pop().unwrap_or_default();
        self.plot(caption, &axis, curves.collect())
    }

    fn laws_table(&self) -> Option<Table> {
        let language = self.language;
        let of = |curve: &Series<'_>, fit: &Fit, what: &str| {
            let name = [self.curve_name(curve), what.to_owned()];
            let name: Vec<String> = name.into_iter().filter(|part| !part.is_empty()).collect();
            let coefficients: Vec<String> = fit
                .coefficients
                .iter()
                .map(|found| {
                    format!(
                        "{} = {} ({})",
                        found.symbol,
                        language.significant(found.value, 3),
                        language.interval(found.low, found.high, 3)
                    )
                })
                .collect();
            vec![
                name.join(", "),
                format!("{}: {}", language.law_name(fit.law), self.law_formula(fit)),
                coefficients.join("; "),
                language.fixed(fit.r_squared, 4),
                language.fixed(100.0 * fit.error, 2),
            ]
        };
        let mut rows = Vec::new();
        for curve in &self.curves {
            rows.extend(curve.law.as_ref().map(|fit| of(curve, fit, language.time_axis())));
            rows.extend(curve.rays.as_ref().map(|fit| of(curve, fit, language.rays_axis())));
        }
        let heads = [
            language.curve(),
            language.formula(),
            language.coefficients(),
            language.r_squared(),
            language.residual(),
        ];
        let heads = heads.map(str::to_owned).to_vec();
        (!rows.is_empty()).then(|| Table { caption: language.laws_caption().to_owned(), heads, rows })
    }

    fn machine_table(&self) -> Table {
        let language = self.language;
        Table {
            caption: language.machine_caption().to_owned(),
            heads: vec![language.item().to_owned(), language.value().to_owned()],
            rows: machine_rows(&self.measured.machine, language),
        }
    }

    /// What is said before the results.
    fn setup(&self, escape: Escape) -> Vec<String> {
        let language = self.language;
        let counts = [
            ("points", self.measured.points.len().to_string()),
            ("rounds", self.measured.rounds.to_string()),
        ];
        let counts: Vec<(&str, &str)> = counts.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let mut text = vec![fill(language.setup_text(), &counts)];
        if !self.measured.complete {
            text.push(language.incomplete().to_owned());
        }
        for (axis, key) in self.measured.axes.iter().zip(&self.measured.keys) {
            if let Some(key) = key {
                let meaning = key.meaning(language.into());
                let value = escape(&axis.variable.to_string());
                text.push(fill(language.value_text(), &[("value", &value), ("meaning", &meaning)]));
            }
        }
        if self.measured.axes.iter().any(|axis| axis.variable == Parameter::Bodies.into()) {
            text.push(language.grown_text().to_owned());
        }
        text.push(language.interval_text().to_owned());
        if self.varies(Parameter::Generations) {
            text.push(language.worst_case().to_owned());
        }
        text
    }

    /// The plots of the report.
    fn figures(&self) -> Vec<ReportFigure> {
        let questions = &self.measured.questions;
        let has_rays = self.varies(Parameter::Generations) || questions.contains(&PictureQuestion::Rays);
        let answers = questions.iter().copied().enumerate();
        let answers = answers.filter(|(_, question)| *question != PictureQuestion::Rays);
        let rays = has_rays.then_some(ReportFigure::Rays);
        let figures = [ReportFigure::Time].into_iter().chain(rays);
        figures.chain(answers.map(|(place, question)| ReportFigure::Answer(place, question))).collect()
    }

    fn figure_plot(&self, figure: ReportFigure) -> Plot {
        match figure {
            ReportFigure::Time => self.time_plot(),
            ReportFigure::Rays => self.rays_plot(),
            ReportFigure::Answer(place, question) => self.answers_plot(place, question),
        }
    }

    fn figure_caption(&self, figure: ReportFigure, escape: Escape) -> String {
        match figure {
            ReportFigure::Time => {
                let has_law = self.curves.iter().any(|curve| curve.law.is_some());
                let language = self.language;
                let text =
                    if has_law { language.plot_caption() } else { language.plot_caption_without_law() };
                self.filled_with(text, escape)
            }
            ReportFigure::Rays if self.varies(Parameter::Generations) => {
                self.language.rays_caption().to_owned()
            }
            ReportFigure::Rays => self.answer_caption(PictureQuestion::Rays, escape),
            ReportFigure::Answer(_, question) => self.answer_caption(question, escape),
        }
    }

    fn answer_caption(&self, question: PictureQuestion, escape: Escape) -> String {
        self.filled_with(&self.language.answer_caption(question), escape)
    }

    /// The tables of the results with their labels.
    fn result_tables(&self) -> Vec<(String, Table)> {
        let questions = self.measured.questions.iter().enumerate();
        let answers =
            questions.map(|(place, &question)| (question.file_stem(), self.answers_table(place, question)));
        [("times".to_owned(), self.times_table())].into_iter().chain(answers).collect()
    }

    /// Why there is no law.
    fn no_law(&self) -> &'static str {
        let is_value = self.measured.keys.first().is_some_and(Option::is_some);
        if is_value { self.language.no_law_of_value() } else { self.language.no_law() }
    }

    fn markdown(&self) -> String {
        let language = self.language;
        let title = self.filled_with(language.study_title(), markdown);
        let mut text = format!("# {title}\n\n## {}\n\n", language.setup());
        for paragraph in self.setup(markdown) {
            let _ = write!(text, "{paragraph}\n\n");
        }
        let _ = write!(text, "{}\n## {}\n\n", self.machine_table().markdown(), language.results_head());
        for (figure, number) in self.figures().into_iter().zip(1..) {
            let (name, caption) = (figure.file_stem(), self.figure_caption(figure, markdown));
            let figure = language.figure().replace("{n}", &number.to_string());
            let _ = write!(text, "![{caption}]({name}.svg)\n\n*{figure}. {caption}*\n\n");
        }
        for (_, table) in self.result_tables() {
            let _ = writeln!(text, "{}", table.markdown());
        }
        let _ = write!(text, "## {}\n\n", language.law_head());
        match self.laws_table() {
            Some(table) => text.push_str(&table.markdown()),
            None => {
                let _ = writeln!(text, "{}", self.no_law());
            }
        }
        text
    }

    fn latex(&self) -> String {
        let language = self.language;
        let mut text = format!(
            "% \\usepackage{{booktabs, graphicx}}\n\\section{{{}}}\n\n\\subsection{{{}}}\n\n",
            tex(&self.filled(language.study_title())),
            tex(language.setup())
        );
        for paragraph in self.setup(str::to_owned) {
            let _ = write!(text, "{}\n\n", tex(&paragraph));
        }
        let _ = write!(
            text,
            "{}\n\\subsection{{{}}}\n\n",
            self.machine_table().latex("machine"),
            tex(language.results_head())
        );
        for figure in self.figures() {
            let (name, caption) = (figure.file_stem(), self.figure_caption(figure, str::to_owned));
            let _ = write!(
                text,
                "\\begin{{figure}}[htbp]\n  \\centering\n  \\includegraphics[width=\\linewidth]{{{name}.png}}\n  \
                 \\caption{{{}}}\n  \\label{{fig:{name}}}\n\\end{{figure}}\n\n",
                tex(&caption)
            );
        }
        for (label, table) in self.result_tables() {
            let _ = writeln!(text, "{}", table.latex(&label));
        }
        let _ = write!(text, "\\subsection{{{}}}\n\n", tex(language.law_head()));
        match self.laws_table() {
            Some(table) => text.push_str(&table.latex("laws")),
            None => {
                let _ = writeln!(text, "{}", tex(self.no_law()));
            }
        }
        text
    }
}
