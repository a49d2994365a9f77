//! A comparison as one page: pictures within, no network, prints on A4.

pub(crate) mod frame;
mod pairs;

use std::fmt::Write as _;

use base64::Engine as _;
use catoptric_picture::{
    BitDepth, CompareError, Development, EncodeError, Picture, SizeError, encode_png, inferno,
};
use catoptric_tracer::raster::PassName;

use super::html::{escape, table};
use super::language::Language;
use super::study::machine_rows;
use super::texts::fill;
use crate::compare::{Contender, MethodComparison, Metrics};
use crate::machine::Machine;

/// The circumstances that a page states.
#[derive(Clone, Debug)]
pub struct PageSettings {
    /// What the scene is called; `None` when only files are compared.
    pub scene: Option<String>,
    /// How many bodies and lights it has.
    pub bodies_and_lights: Option<[usize; 2]>,
    /// Samples per pixel, where nothing was drawn `None`.
    pub samples: Option<u32>,
    /// The limit of generations of the scene.
    pub generations: Option<u32>,
    /// The number of threads that drew.
    pub threads: usize,
    /// How linear light becomes what the page shows.
    pub development: Development,
    /// The language of the page.
    pub language: Language,
}

/// The reason why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// There is too little memory for a picture.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The heat maps cannot be made.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// A picture cannot be put into the page.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

/// Makes the page. It is well-formed XML, needs no network, follows the light or dark choice of the reader, and without
/// scripts only the dividing lines do not move.
///
/// # Errors
/// When there is too little memory.
pub fn page(
    compared: &MethodComparison,
    machine: &Machine,
    settings: &PageSettings,
) -> Result<String, PageError> {
    let page = HtmlPage { compared, machine, settings };
    let language = settings.language;
    let title = fill(language.compare_title(), &[("truth", page.truth_name())]);
    let mut html = frame::head(language, &title);
    html.push_str(&page.definitions()?);
    let bound = language.significant(compared.bound, 2);
    let lead = fill(language.compare_lead(), &[("bound", &bound), ("truth", page.truth_name())]);
    let _ = write!(html, "<h1>{}</h1>\n<p class=\"lead\">{}</p>\n", escape(&title), escape(&lead));
    page.gallery(&mut html);
    page.results(&mut html);
    page.pairs(&mut html)?;
    page.conditions(&mut html);
    page.reading(&mut html);
    html.push_str(&frame::end());
    Ok(html)
}

/// A page while it is written.
struct HtmlPage<'a> {
    compared: &'a MethodComparison,
    machine: &'a Machine,
    settings: &'a PageSettings,
}

impl HtmlPage<'_> {
    fn truth_name(&self) -> &str {
        self.compared.truth().map_or("", |truth| &truth.name)
    }

    /// Pixels across and down.
    fn size(&self) -> [u32; 2] {
        self.compared.truth().map_or([1, 1], |truth| [truth.picture.width(), truth.picture.height()])
    }

    /// Every picture once; the page uses them by their numbers.
    fn definitions(&self) -> Result<String, PageError> {
        let [width, height] = self.size();
        let mut svg =
            "<svg width=\"0\" height=\"0\" class=\"definitions\" aria-hidden=\"true\"><defs>\n".to_owned();
        for (index, contender) in self.compared.contenders.iter().enumerate() {
            let data = data_uri(&contender.picture, &self.settings.development)?;
            let _ = writeln!(
                svg,
                "<image id=\"p{index}\" width=\"{width}\" height=\"{height}\" href=\"{data}\"/>"
            );
        }
        let _ =
            write!(svg, "<linearGradient id=\"inferno\">{}</linearGradient>\n</defs></svg>\n", color_stops());
        Ok(svg)
    }

    /// All pictures side by side.
    fn gallery(&self, html: &mut String) {
        let language = self.settings.language;
        let [width, height] = self.size();
        let _ = write!(html, "<h2>{}</h2>\n<div class=\"gallery\">\n", language.pictures());
        for (index, contender) in self.compared.contenders.iter().enumerate() {
            let time = match &contender.drawn {
                Some(drawn) => {
                    format!("{} {}", language.significant(drawn.time, 3), language.milliseconds())
                }
                None => language.read_from_file().to_owned(),
            };
            let _ = writeln!(
                html,
                "<figure><svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{name}\"><use \
                 href=\"#p{index}\"/></svg><figcaption><b>{name}</b> · {}</figcaption></figure>",
                escape(&time),
                name = escape(&contender.name)
            );
        }
        html.push_str("</div>\n");
    }

    /// The tables of differences and times.
    fn results(&self, html: &mut String) {
        let language = self.settings.language;
        let heads = [
            language.picture(),
            language.largest(),
            language.mean(),
            "RMSE",
            language.decibels(),
            "SSIM",
            "ꟻLIP",
            language.wrong_pixels(),
            language.time(),
        ];
        let first = self.compared.truth().map(|truth| self.result_row(truth, None));
        let others = self.compared.others().map(|(other, metrics)| self.result_row(other, Some(metrics)));
        let rows: Vec<Vec<String>> = first.into_iter().chain(others).collect();
        let caption = fill(language.results_caption(), &[("truth", self.truth_name())]);
        let _ = write!(
            html,
            "<h2>{}</h2>\n{}",
            language.results(),
            table(&caption, &heads.map(str::to_owned), &rows)
        );
        let runs = self.compared.contenders.iter().find_map(|contender| Some(contender.drawn.as_ref()?.runs));
        if let Some(runs) = runs {
            let values = [("count", runs.to_string()), ("threads", self.settings.threads.to_string())];
            let values = values.each_ref().map(|(name, value)| (*name, value.as_str()));
            let _ = writeln!(html, "<p class=\"note\">{}</p>", escape(&fill(language.times_note(), &values)));
        }
        self.passes(html);
    }

    fn result_row(&self, contender: &Contender, metrics: Option<&Metrics>) -> Vec<String> {
        let language = self.settings.language;
        let dash = || "–".to_owned();
        let number = |value: f64, places: usize| language.fixed(value, places);
        let metric = |value: &dyn Fn(&Metrics) -> String| metrics.map_or_else(dash, value);
        vec![
            contender.name.clone(),
            metric(&|metrics| number(metrics.difference.max, 3)),
            metric(&|metrics| number(metrics.difference.mean, 4)),
            metric(&|metrics| number(metrics.difference.rmse, 4)),
            metric(&|metrics| number(metrics.difference.psnr_db, 1)),
            metric(&|metrics| metrics.ssim.map_or_else(dash, |ssim| number(ssim, 4))),
            metric(&|metrics| number(metrics.flip, 4)),
            metric(&|metrics| number(100.0 * metrics.difference.share_above, 2)),
            contender.drawn.as_ref().map_or_else(dash, |drawn| language.significant(drawn.time, 3)),
        ]
    }

    /// The time of each pass of each method, where there is more than one.
    fn passes(&self, html: &mut String) {
        let language = self.settings.language;
        let drawn =
            || self.compared.contenders.iter().filter_map(|other| Some((&other.name, other.drawn.as_ref()?)));
        if drawn().all(|(_, drawn)| drawn.passes.len() < 2) {
            return;
        }
        let mut names: Vec<PassName> = Vec::new();
        for (name, _) in drawn().flat_map(|(_, drawn)| &drawn.passes) {
            if !names.contains(name) {
                names.push(*name);
            }
        }
        let heads = [language.picture().to_owned()].into_iter();
        let heads: Vec<String> =
            heads.chain(names.iter().map(|name| language.pass_name(*name).to_owned())).collect();
        let rows: Vec<Vec<String>> = drawn()
            .map(|(name, drawn)| {
                let time = |wanted: &PassName| {
                    let pass = drawn.passes.iter().find(|(pass, _)| pass == wanted);
                    pass.map_or_else(|| "–".to_owned(), |(_, time)| language.significant(*time, 3))
                };
                [name.clone()].into_iter().chain(names.iter().map(time)).collect()
            })
            .collect();
        let _ = write!(
            html,
            "<h3>{}</h3>\n{}",
            language.passes(),
            table(language.passes_caption(), &heads, &rows)
        );
    }

    /// What was drawn, and where.
    fn conditions(&self, html: &mut String) {
        let language = self.settings.language;
        let [width, height] = self.size();
        let size = format!("{width}×{height} {}", language.pixels());
        let rows = [
            (language.scene(), self.settings.scene.clone()),
            (language.size(), Some(size)),
            (language.samples_per_pixel(), self.settings.samples.map(|samples| samples.to_string())),
            (language.generations_limit(), self.settings.generations.map(|limit| limit.to_string())),
            (
                language.bodies_and_lights(),
                self.settings.bodies_and_lights.map(|[bodies, lights]| {
                    format!("{} / {}", language.count(bodies as u64), language.count(lights as u64))
                }),
            ),
            (language.threads_used(), Some(self.settings.threads.to_string())),
        ];
        let rows = rows.into_iter().filter_map(|(item, value)| Some(vec![item.to_owned(), value?]));
        let rows: Vec<Vec<String>> = rows.chain(machine_rows(self.machine, language)).collect();
        let heads = [language.item(), language.value()].map(str::to_owned);
        let _ = write!(
            html,
            "<h2>{}</h2>\n<div class=\"words\">{}</div>",
            language.conditions(),
            table(language.conditions_caption(), &heads, &rows)
        );
    }

    /// How the numbers are made.
    fn reading(&self, html: &mut String) {
        let language = self.settings.language;
        let _ = writeln!(html, "<h2>{}</h2>", language.reading());
        for text in [language.reading_rmse(), language.reading_ssim(), language.reading_flip()] {
            let _ = writeln!(html, "<p>{}</p>", escape(text));
        }
    }
}

/// The color scale of heat maps.
fn color_stops() -> String {
    const STOPS: u32 = 24;
    let mut stops = String::new();
    for stop in 0..=STOPS {
        let part = f64::from(stop) / f64::from(STOPS);
        let [red, green, blue] = inferno(part).map(|channel| (channel * 255.0).round() as u8);
        let _ = write!(stops, "<stop offset=\"{part:.4}\" stop-color=\"#{red:02x}{green:02x}{blue:02x}\"/>");
    }
    stops
}

/// A picture within the page.
pub(crate) fn data_uri(picture: &Picture, development: &Development) -> Result<String, PageError> {
    let png = encode_png(&development.develop(picture, BitDepth::Eight)?)?;
    Ok(format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png)))
}
