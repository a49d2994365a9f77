//! The files of a report on a measurement: data, tables, plots, and the text around them.

use std::fmt::Write as _;

use catoptric_picture::{BitDepth, Development, encode_png};

use super::language::Language;
use super::plot::{Plot, PlotAxis, PlotCurve, PlotMark};
use super::raster::{RasterError, rasterize};
use super::tables::{Table, csv_line, markdown, tex};
use super::texts::fill;
use crate::machine::Machine;
use crate::measure::{Fit, GrowthLaw, MeasuredPoint, Measurement, Parameter, Series, Summary, series};

/// The files of a report, by name.
#[derive(Clone, Debug)]
pub struct MeasurementReport {
    /// Names and contents, in the order in which to name them.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// The laws in words, a line for each curve.
    pub laws: Vec<String>,
}

impl MeasurementReport {
    /// The names that files can have.
    pub const NAMES: [&'static str; 8] =
        ["runs.csv", "points.csv", "time.png", "time.svg", "rays.png", "rays.svg", "report.md", "report.tex"];
}

/// Pixels for each unit of a plot's size.
const SHARPNESS: f32 = 2.0;

/// Makes the files: `runs.csv` (every measurement), `points.csv` (their summaries), `time.svg` and `time.png`, for
/// generations `rays.svg` and `rays.png` too, `report.md` and `report.tex`.
///
/// The CSV files are the same in every language: decimal points and English heads.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn study(measured: &Measurement, language: Language) -> Result<MeasurementReport, RasterError> {
    let chapter = ReportWriter { measured, curves: series(measured), language };
    let mut files = vec![
        ("runs.csv", runs_csv(measured).into_bytes()),
        ("points.csv", points_csv(&chapter.curves, measured).into_bytes()),
    ];
    let time = chapter.time_plot().svg();
    files.push(("time.png", png(&time)?));
    files.push(("time.svg", time.into_bytes()));
    if let Some(plot) = chapter.rays_plot() {
        let rays = plot.svg();
        files.push(("rays.png", png(&rays)?));
        files.push(("rays.svg", rays.into_bytes()));
    }
    files.push(("report.md", chapter.markdown().into_bytes()));
    files.push(("report.tex", chapter.latex().into_bytes()));
    Ok(MeasurementReport {
        files,
        laws: chapter.curves.iter().map(|curve| chapter.law_line(curve)).collect(),
    })
}

/// The plot of the times, with the laws as far as the points tell them: for measurements under way, too.
pub fn time_plot(measured: &Measurement, language: Language) -> Plot {
    ReportWriter { measured, curves: series(measured), language }.time_plot()
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

/// The heads of the columns that say where a point is.
fn place_heads(measured: &Measurement) -> Vec<String> {
    let axes = measured.axes.iter().map(|axis| axis.parameter.key().to_owned());
    axes.chain(
        ["method", "bodies", "width", "height", "samples", "generations", "threads"]
            .map(|head| format!("drawn_{head}")),
    )
    .collect()
}

fn place(point: &MeasuredPoint) -> Vec<String> {
    let values = point.values.iter().map(ToString::to_string);
    let settings = point.settings;
    values
        .chain([
            point.method.clone(),
            point.bodies.to_string(),
            settings.width.to_string(),
            settings.height.to_string(),
            settings.samples.to_string(),
            point.generations.to_string(),
            point.threads.to_string(),
        ])
        .collect()
}

fn runs_csv(measured: &Measurement) -> String {
    let heads = ["round", "repeats", "prepare_ms", "draw_ms", "passes_ms"].map(str::to_owned);
    let mut text = csv_line(&[place_heads(measured), heads.to_vec()].concat());
    for point in &measured.points {
        for run in &point.runs {
            let passes: Vec<String> =
                run.passes.iter().map(|(pass, time)| format!("{}={time:.4}", pass.name())).collect();
            let fields = [
                run.round.to_string(),
                point.repeats.to_string(),
                format!("{:.4}", run.prepare),
                format!("{:.4}", run.draw),
                passes.join(" "),
            ];
            text.push_str(&csv_line(&[place(point), fields.to_vec()].concat()));
        }
    }
    text
}

fn points_csv(curves: &[Series<'_>], measured: &Measurement) -> String {
    let heads = [
        "runs",
        "median_ms",
        "low_ms",
        "high_ms",
        "coverage",
        "least_ms",
        "greatest_ms",
        "outliers",
        "prepare_ms",
        "law_ms",
        "rays_primary",
        "rays_shadow",
        "rays_reflected",
        "rays_refracted",
    ];
    let mut text = csv_line(&[place_heads(measured), heads.map(str::to_owned).to_vec()].concat());
    for curve in curves {
        for (point, summary) in &curve.points {
            let law = curve.law.as_ref().zip(point.number()).map(|(law, x)| format!("{:.4}", law.at(x)));
            let ms = |value: f64| format!("{value:.4}");
            let fields = vec![
                summary.count.to_string(),
                ms(summary.median),
                ms(summary.low),
                ms(summary.high),
                ms(summary.coverage),
                ms(summary.least),
                ms(summary.greatest),
                summary.outliers.len().to_string(),
                ms(preparing(point)),
                law.unwrap_or_default(),
                point.rays.primary.to_string(),
                point.rays.shadow.to_string(),
                point.rays.reflected.to_string(),
                point.rays.refracted.to_string(),
            ];
            text.push_str(&csv_line(&[place(point), fields].concat()));
        }
    }
    text
}

/// The median time of preparing.
fn preparing(point: &MeasuredPoint) -> f64 {
    let times: Vec<f64> = point.runs.iter().map(|run| run.prepare).collect();
    crate::measure::summarize(&times).map_or(f64::NAN, |summary| summary.median)
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

/// Writes the text around the measurements.
struct ReportWriter<'a> {
    measured: &'a Measurement,
    curves: Vec<Series<'a>>,
    language: Language,
}

impl ReportWriter<'_> {
    fn first(&self) -> Parameter {
        self.measured.axes.first().map_or(Parameter::Size, |axis| axis.parameter)
    }

    fn filled(&self, text: &str) -> String {
        self.filled_with(text, &self.measured.name)
    }

    fn filled_with(&self, text: &str, scene: &str) -> String {
        fill(text, &[("parameter", self.language.depending_on(self.first())), ("scene", scene)])
    }

    fn law_formula(&self, fit: &Fit) -> String {
        let (x, language) = (self.language.letter(self.first()), self.language);
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
                format!("{}: {}", self.language.parameter(axis.parameter), self.language.value_name(value))
            }
            _ => String::new(),
        }
    }

    /// The law of a curve in words.
    fn law_line(&self, curve: &Series<'_>) -> String {
        let name = self.curve_name(curve);
        let law = match &curve.law {
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
        let language = self.language;
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
        self.plot(
            fill(
                language.plot_caption(),
                &[("parameter", language.depending_on(self.first())), ("scene", &self.measured.name)],
            ),
            language.time_axis(),
            curves.collect(),
        )
    }

    fn rays_plot(&self) -> Option<Plot> {
        if self.first() != Parameter::Generations {
            return None;
        }
        let curves = self.curves.iter().map(|curve| {
            let marks = curve.points.iter().filter_map(|(point, _)| {
                let rays = point.rays.total() as f64;
                Some(PlotMark { x: point.number()?, y: rays, low: rays, high: rays, all: Vec::new() })
            });
            PlotCurve {
                label: self.curve_name(curve),
                marks: marks.collect(),
                law: curve.rays.as_ref().map(|fit| self.law_curve(curve, fit)),
            }
        });
        Some(self.plot(self.language.rays_caption().to_owned(), self.language.rays_axis(), curves.collect()))
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
        let (x_log, y_log) = match self.first() {
            Parameter::Bodies | Parameter::Fineness | Parameter::CubeMapSize => {
                let log = spread(&|| xs().collect()) > 8.0;
                (log, log)
            }
            Parameter::Size | Parameter::Samples => (false, false),
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
            x: PlotAxis { title: language.parameter(self.first()).to_owned(), logarithmic: x_log, names },
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
        let axes = self.measured.axes.iter().map(|axis| language.parameter(axis.parameter).to_owned());
        let (ms, prepare) = (language.milliseconds(), language.prepare());
        let heads = axes.chain([
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
        let values = point.values.iter().map(|value| match (value, value.number()) {
            (crate::measure::Value::Size(_), Some(pixels)) => {
                format!("{} = {}", language.value_name(value), language.fixed(pixels, 0))
            }
            _ => language.value_name(value),
        });
        values
            .chain([
                language.significant(summary.median, 4),
                language.interval(summary.low, summary.high, 3),
                summary.count.to_string(),
                summary.outliers.len().to_string(),
                language.significant(preparing(point), 3),
                language.count(point.rays.total()),
            ])
            .collect()
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
    fn setup(&self) -> Vec<String> {
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
        if self.measured.axes.iter().any(|axis| axis.parameter == Parameter::Bodies) {
            text.push(language.grown_text().to_owned());
        }
        text.push(language.interval_text().to_owned());
        if self.first() == Parameter::Generations {
            text.push(language.worst_case().to_owned());
        }
        text
    }

    /// The plots and their captions, in which the scene is called `scene`.
    fn figures(&self, scene: &str) -> Vec<(&'static str, String)> {
        let mut figures = vec![("time", self.filled_with(self.language.plot_caption(), scene))];
        if self.first() == Parameter::Generations {
            figures.push(("rays", self.language.rays_caption().to_owned()));
        }
        figures
    }

    fn markdown(&self) -> String {
        let language = self.language;
        let scene = markdown(&self.measured.name);
        let title = self.filled_with(language.study_title(), &scene);
        let mut text = format!("# {title}\n\n## {}\n\n", language.setup());
        for paragraph in self.setup() {
            let _ = write!(text, "{paragraph}\n\n");
        }
        let _ = write!(text, "{}\n## {}\n\n", self.machine_table().markdown(), language.results_head());
        for ((name, caption), number) in self.figures(&scene).into_iter().zip(1..) {
            let figure = language.figure().replace("{n}", &number.to_string());
            let _ = write!(text, "![{caption}]({name}.svg)\n\n*{figure}. {caption}*\n\n");
        }
        let _ = write!(text, "{}\n## {}\n\n", self.times_table().markdown(), language.law_head());
        match self.laws_table() {
            Some(table) => text.push_str(&table.markdown()),
            None => {
                let _ = writeln!(text, "{}", language.no_law());
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
        for paragraph in self.setup() {
            let _ = write!(text, "{}\n\n", tex(&paragraph));
        }
        let _ = write!(
            text,
            "{}\n\\subsection{{{}}}\n\n",
            self.machine_table().latex("machine"),
            tex(language.results_head())
        );
        for (name, caption) in self.figures(&self.measured.name) {
            let _ = write!(
                text,
                "\\begin{{figure}}[htbp]\n  \\centering\n  \\includegraphics[width=\\linewidth]{{{name}.png}}\n  \
                 \\caption{{{}}}\n  \\label{{fig:{name}}}\n\\end{{figure}}\n\n",
                tex(&caption)
            );
        }
        let _ = writeln!(text, "{}", self.times_table().latex("times"));
        let _ = write!(text, "\\subsection{{{}}}\n\n", tex(language.law_head()));
        match self.laws_table() {
            Some(table) => text.push_str(&table.latex("laws")),
            None => {
                let _ = writeln!(text, "{}", tex(language.no_law()));
            }
        }
        text
    }
}
