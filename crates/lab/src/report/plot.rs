//! Plots as SVG, for the screen and for paper.

mod scale;

use std::fmt::Write as _;

use super::html::escape;
use super::language::Language;
pub use scale::{Scale, Tick};

/// The title and scale of an axis.
#[derive(Clone, Debug)]
pub struct PlotAxis {
    /// The title of the axis, with the unit.
    pub title: String,
    /// Whether it is logarithmic; only where all values are above 0.
    pub logarithmic: bool,
    /// The names of the places 0, 1, 2 … instead of numbers.
    pub names: Vec<String>,
}

/// A measured value with its interval.
#[derive(Clone, Debug)]
pub struct PlotMark {
    /// The place along the first axis: a value, or the number of its name.
    pub x: f64,
    /// The median.
    pub y: f64,
    /// The interval of y.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
    /// All measurements, and whether each is an outlier.
    pub all: Vec<(f64, bool)>,
}

/// Measured values and the law through them.
#[derive(Clone, Debug)]
pub struct PlotCurve {
    /// For the legend; not drawn when empty.
    pub label: String,
    /// In the order of the first axis.
    pub marks: Vec<PlotMark>,
    /// The law's name for the legend and its values.
    pub law: Option<(String, Vec<(f64, f64)>)>,
}

/// A plot of curves over one axis.
#[derive(Clone, Debug)]
pub struct Plot {
    /// What it shows, in a sentence.
    pub description: String,
    /// Across.
    pub x: PlotAxis,
    /// Up.
    pub y: PlotAxis,
    /// In the order of the legend.
    pub curves: Vec<PlotCurve>,
    /// How numbers are written.
    pub language: Language,
}

/// Colors that the color-blind can tell apart (M. Okabe, K. Ito, 2008), the darker ones first.
const COLORS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#a06a00", "#56b4e9", "#333333"];

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 20.0;
const TOP: f64 = 18.0;
const BOTTOM: f64 = 58.0;
/// Height of a line of the legend.
const LINE: f64 = 20.0;

impl Plot {
    /// The plot as a document of its own.
    pub(crate) fn svg(&self) -> String {
        let entries = self.legend();
        let height = HEIGHT + LINE * entries.len() as f64;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" \
             height=\"{height}\" role=\"img\" font-family=\"Ubuntu, 'DejaVu Sans', 'Segoe UI', 'Helvetica Neue', Arial, \
             sans-serif\" font-size=\"13\">\n<title>{}</title>\n<rect width=\"{WIDTH}\" height=\"{height}\" \
             fill=\"#ffffff\"/>\n",
            escape(&self.description)
        );
        let (x, y) = self.scales();
        self.draw_grid(&mut svg, &x, &y);
        for (curve, index) in self.curves.iter().zip(0..) {
            draw_curve(&mut svg, curve, index, &x, &y);
        }
        for (index, entry) in entries.iter().enumerate() {
            draw_entry(&mut svg, entry, HEIGHT + LINE * (index as f64 + 0.3));
        }
        svg.push_str("</svg>\n");
        svg
    }

    fn scales(&self) -> (Scale, Scale) {
        self.scales_over([LEFT, WIDTH - RIGHT], [HEIGHT - BOTTOM, TOP])
    }

    /// The scales of both axes between these places: left and right, bottom and top.
    pub fn scales_over(&self, [left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> (Scale, Scale) {
        let marks = || self.curves.iter().flat_map(|curve| &curve.marks);
        let laws = || self.curves.iter().filter_map(|curve| curve.law.as_ref()).flat_map(|(_, law)| law);
        let xs = marks().map(|mark| mark.x).chain(laws().map(|point| point.0));
        let all = |mark: &PlotMark| mark.all.iter().map(|(y, _)| *y).collect::<Vec<_>>();
        let ys = marks().flat_map(|mark| [vec![mark.low, mark.high, mark.y], all(mark)].concat());
        let ys = ys.chain(laws().map(|point| point.1));
        let x = if self.x.names.is_empty() {
            Scale::over(xs, self.x.logarithmic, left, right)
        } else {
            Scale::of_places(self.x.names.len(), left, right)
        };
        (x, Scale::over(ys, self.y.logarithmic, bottom, top))
    }

    /// The lines, numbers and titles.
    fn draw_grid(&self, svg: &mut String, x: &Scale, y: &Scale) {
        let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for tick in y.ticks() {
            let at = y.at(tick.value);
            let _ = writeln!(
                svg,
                "<line x1=\"{LEFT}\" y1=\"{at:.2}\" x2=\"{right}\" y2=\"{at:.2}\" stroke=\"{}\"/>",
                if tick.labeled { "#d9d9d9" } else { "#efefef" }
            );
            if tick.labeled {
                let text = y.label(tick.value, self.language);
                text_at(svg, [LEFT - 8.0, at + 4.5], "end", &text);
            }
        }
        let names = self.x.names.iter().zip(0..).map(|(name, place)| (f64::from(place), name.clone()));
        let labels: Vec<(f64, String)> = if self.x.names.is_empty() {
            for tick in x.ticks() {
                let at = x.at(tick.value);
                let _ = writeln!(
                    svg,
                    "<line x1=\"{at:.2}\" y1=\"{TOP}\" x2=\"{at:.2}\" y2=\"{bottom}\" stroke=\"{}\"/>",
                    if tick.labeled { "#d9d9d9" } else { "#efefef" }
                );
            }
            let labeled = x.ticks().into_iter().filter(|tick| tick.labeled);
            labeled.map(|tick| (tick.value, x.label(tick.value, self.language))).collect()
        } else {
            names.collect()
        };
        for (value, text) in labels {
            text_at(svg, [x.at(value), bottom + 18.0], "middle", &text);
        }
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" fill=\"none\" stroke=\"#222222\" stroke-width=\"1.2\"/>"
        );
        text_at(svg, [0.5 * (LEFT + right), HEIGHT - 14.0], "middle", &self.x.title);
        let middle = 0.5 * (TOP + bottom);
        let _ = writeln!(
            svg,
            "<text transform=\"translate(20 {middle:.2}) rotate(-90)\" text-anchor=\"middle\" \
             fill=\"#222222\">{}</text>",
            escape(&self.y.title)
        );
    }

    /// What stands below the plot: a line for each curve and each law.
    fn legend(&self) -> Vec<LegendEntry> {
        let mut entries = Vec::new();
        for (curve, index) in self.curves.iter().zip(0..) {
            let law = curve.law.as_ref().map(|(name, _)| name.as_str()).unwrap_or_default();
            let text: Vec<&str> =
                [curve.label.as_str(), law].into_iter().filter(|text| !text.is_empty()).collect();
            if !text.is_empty() {
                entries.push(LegendEntry { index, line: curve.law.is_some(), text: text.join(": ") });
            }
        }
        entries
    }
}

/// A line of the legend.
struct LegendEntry {
    index: usize,
    line: bool,
    text: String,
}

fn color(index: usize) -> &'static str {
    COLORS.get(index % COLORS.len()).copied().unwrap_or("#333333")
}

fn text_at(svg: &mut String, [x, y]: [f64; 2], anchor: &str, text: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" fill=\"#222222\">{}</text>",
        escape(text)
    );
}

fn draw_entry(svg: &mut String, entry: &LegendEntry, y: f64) {
    if entry.line {
        let _ = writeln!(
            svg,
            "<line x1=\"{}\" y1=\"{y:.2}\" x2=\"{}\" y2=\"{y:.2}\" stroke=\"{}\" stroke-width=\"1.6\"/>",
            LEFT,
            LEFT + 34.0,
            color(entry.index)
        );
    }
    draw_symbol(svg, [LEFT + 17.0, y], entry.index);
    text_at(svg, [LEFT + 44.0, y + 4.5], "start", &entry.text);
}

/// The law, the measurements, their intervals and medians, from back to front.
fn draw_curve(svg: &mut String, curve: &PlotCurve, index: usize, x: &Scale, y: &Scale) {
    let color = color(index);
    if let Some((_, law)) = &curve.law {
        let places: Vec<String> = law
            .iter()
            .filter(|(at, value)| x.shows(*at) && y.shows(*value))
            .map(|(at, value)| format!("{:.2},{:.2}", x.at(*at), y.at(*value)))
            .collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.6\"/>",
            places.join(" ")
        );
    }
    for mark in &curve.marks {
        let at = x.at(mark.x);
        // Side by side, or measurements that are close hide each other.
        let count = mark.all.len() as f64;
        for ((time, outlier), place) in mark.all.iter().zip(0_u32..) {
            let aside = if count > 1.0 { 10.0 * (f64::from(place) / (count - 1.0) - 0.5) } else { 0.0 };
            let _ = writeln!(
                svg,
                "<circle cx=\"{:.2}\" cy=\"{:.2}\" {}/>",
                at + aside,
                y.at(*time),
                if *outlier {
                    format!("r=\"3\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1\"")
                } else {
                    format!("r=\"1.5\" fill=\"{color}\" fill-opacity=\"0.45\"")
                }
            );
        }
        let (low, high) = (y.at(mark.low), y.at(mark.high));
        let _ = writeln!(
            svg,
            "<path d=\"M{:.2} {low:.2}h8M{:.2} {high:.2}h8M{at:.2} {low:.2}V{high:.2}\" stroke=\"{color}\" \
             stroke-width=\"1.4\" fill=\"none\"/>",
            at - 4.0,
            at - 4.0
        );
        draw_symbol(svg, [at, y.at(mark.y)], index);
    }
}

/// The symbol of a curve, which distinguishes it on a black and white print too.
fn draw_symbol(svg: &mut String, [x, y]: [f64; 2], index: usize) {
    let shape = match index % 4 {
        0 => format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4.2\""),
        1 => format!("<rect x=\"{:.2}\" y=\"{:.2}\" width=\"7.6\" height=\"7.6\"", x - 3.8, y - 3.8),
        2 => format!("<path d=\"M{x:.2} {:.2}l4.8 8.2h-9.6z\"", y - 5.0),
        _ => format!("<path d=\"M{x:.2} {:.2}l5 5l-5 5l-5 -5z\"", y - 5.0),
    };
    let _ = writeln!(svg, "{shape} fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"1\"/>", color(index));
}
