//! The tree as a drawing.

use std::fmt::Write as _;

use catoptric_picture::srgb;
use catoptric_tracer::{BranchOutcome, SurfaceRecord};
use glam::DVec3;

use super::drawing::{self, RayDiagram};
use super::layout::tidy;
use super::numbers::{exact, exact_color, short_color};
use super::{Audit, Node, NodeKind, Proof, RayTree};
use crate::report::html::escape;

/// Size of a node's card, and the distances between cards, in pixels.
const CARD: [f64; 2] = [200.0, 58.0];
const STEP: [f64; 2] = [282.0, 74.0];
const MARGIN: f64 = 28.0;
const HEAD: f64 = 84.0;

impl Audit {
    /// How many rays of a sample are drawn at most.
    pub const MOST_DRAWN: usize = 4096;

    /// The tree of the first sample as an SVG picture: a card for each ray, colored by kind, with what it meets, the
    /// share that it brings and its lights; lines as wide as the weight. Rays more than `depth` steps from the eye are
    /// left out if that is given, and those beyond [`Audit::MOST_DRAWN`].
    pub fn to_svg(&self, depth: Option<usize>) -> String {
        let mut body = String::new();
        let mut size = [0.0_f64; 2];
        let mut hidden = 0;
        if let Some(tree) = self.trees.first() {
            let drawing = TreeDrawing::new(self, tree, depth);
            size = drawing.size();
            hidden = drawing.hidden;
            drawing.lines(&mut body);
            drawing.cards(&mut body);
        }
        // The heading and the legend need room, whatever the tree.
        let width = (size[0] + 2.0 * MARGIN).max(860.0);
        let height = size[1] + HEAD + MARGIN + 52.0;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"Inter, 'Segoe UI', 'DejaVu Sans', sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fbfbfa\"/>\n"
        );
        self.heading(&mut text, hidden);
        text.push_str(&body);
        legend(&mut text, height - 34.0);
        text + "</svg>\n"
    }

    fn heading(&self, text: &mut String, hidden: usize) {
        let swatch = css(DVec3::from(self.light.map(f64::from)));
        let [red, green, blue] = self.light.map(exact);
        let _ = writeln!(
            text,
            "<rect x=\"{MARGIN}\" y=\"24\" width=\"38\" height=\"38\" rx=\"7\" fill=\"{swatch}\" stroke=\"#0002\"/>\n\
             <text x=\"{x}\" y=\"40\" font-size=\"17\" font-weight=\"600\" fill=\"#1d2129\">Pixel {},{} of {} × {}</text>",
            self.pixel.x,
            self.pixel.y,
            self.picture.width,
            self.picture.height,
            x = MARGIN + 52.0
        );
        let mut words = format!("linear light {red}  {green}  {blue}");
        let samples = self.picture.samples;
        if samples > 1 {
            let _ = write!(words, ", the mean of {samples} samples; the first is drawn");
        } else if self.proof == Proof::AnyOrder {
            words.push_str(", the exact sum of these rays");
        }
        if hidden > 0 {
            let _ = write!(words, "; {hidden} rays are not drawn");
        }
        let _ = writeln!(
            text,
            "<text x=\"{}\" y=\"61\" font-size=\"13\" fill=\"#5a6270\">{words}</text>",
            MARGIN + 52.0
        );
    }
}

/// A tree with the places of its cards in the drawing.
struct TreeDrawing<'a> {
    audit: &'a Audit,
    tree: &'a RayTree,
    /// The nodes that are drawn, with the upper left corners of their cards.
    cards: Vec<(usize, [f64; 2])>,
    hidden: usize,
}

impl<'a> TreeDrawing<'a> {
    fn new(audit: &'a Audit, tree: &'a RayTree, depth: Option<usize>) -> Self {
        let RayDiagram { places, hidden } = RayDiagram::of(tree, depth, Audit::MOST_DRAWN);
        let parents: Vec<Option<usize>> = places
            .iter()
            .map(|&place| {
                let parent = tree.nodes.get(place)?.ray.parent?;
                places.binary_search(&parent).ok()
            })
            .collect();
        let across = tidy(&parents);
        let mut steps: Vec<f64> = Vec::with_capacity(places.len());
        for parent in &parents {
            let above = parent.and_then(|parent| steps.get(parent).copied());
            steps.push(above.map_or(0.0, |steps| steps + 1.0));
        }
        let corner = |(step, across): (&f64, &f64)| [MARGIN + STEP[0] * step, HEAD + STEP[1] * across];
        let corners = steps.iter().zip(&across).map(corner);
        Self { audit, tree, cards: places.iter().copied().zip(corners).collect(), hidden }
    }

    /// From the margin to the far sides of the last cards.
    fn size(&self) -> [f64; 2] {
        let most = |axis: usize, start: f64| {
            let reach = self.cards.iter().filter_map(|(_, corner)| corner.get(axis));
            reach.fold(0.0_f64, |most, corner| most.max(corner - start))
        };
        [most(0, MARGIN) + CARD[0], most(1, HEAD) + CARD[1]]
    }

    fn corner(&self, place: usize) -> Option<[f64; 2]> {
        let index = self.cards.binary_search_by_key(&place, |card| card.0).ok()?;
        self.cards.get(index).map(|card| card.1)
    }

    fn lines(&self, text: &mut String) {
        for &(place, [x, y]) in &self.cards {
            let Some(node) = self.tree.nodes.get(place) else { continue };
            let Some(from) = node.ray.parent.and_then(|parent| self.corner(parent)) else { continue };
            let (start, end) = ([from[0] + CARD[0], from[1] + 0.5 * CARD[1]], [x, y + 0.5 * CARD[1]]);
            let bend = 0.5 * (end[0] - start[0]);
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {:.1}C{:.1} {:.1} {:.1} {:.1} {:.1} {:.1}\" fill=\"none\" stroke=\"{}\" \
                 stroke-width=\"{:.2}\" stroke-opacity=\"0.55\"/>",
                start[0],
                start[1],
                start[0] + bend,
                start[1],
                end[0] - bend,
                end[1],
                end[0],
                end[1],
                drawing::color(node.kind),
                drawing::line_width(node)
            );
            let factor = exact_color(node.coefficient);
            // On the outer side of the line.
            let away = 0.5 * f64::from(drawing::line_width(node));
            let beside = if end[1] > start[1] { away + 13.0 } else { -away - 5.0 };
            let _ = writeln!(
                text,
                "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"end\" fill=\"#5a6270\" \
                 stroke=\"#fbfbfa\" stroke-width=\"3\" paint-order=\"stroke\">× {factor}</text>",
                end[0] - 8.0,
                end[1] + beside,
            );
        }
    }

    fn cards(&self, text: &mut String) {
        for &(place, corner) in &self.cards {
            if let Some(node) = self.tree.nodes.get(place) {
                self.card(text, place, node, corner);
            }
        }
    }

    fn card(&self, text: &mut String, place: usize, node: &Node, [x, y]: [f64; 2]) {
        let color = drawing::color(node.kind);
        let [width, height] = CARD;
        let name = shortened(&drawing::end_of(self.audit, node));
        let share = share(node.brings, self.audit.sum);
        let _ = writeln!(
            text,
            "<g transform=\"translate({x:.1} {y:.1})\"><title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fff\" stroke=\"{color}\" stroke-opacity=\"0.5\"/>\n\
             <path d=\"M8 0H6V{height}H8A8 8 0 0 1 0 {bottom}V8A8 8 0 0 1 8 0\" fill=\"{color}\"/>\n\
             <text x=\"16\" y=\"17\" font-size=\"10.5\" fill=\"{color}\">{} {} · generation {}</text>\n\
             <text x=\"16\" y=\"34\" font-size=\"13.5\" font-weight=\"600\" fill=\"#1d2129\">{}</text>\n\
             <text x=\"16\" y=\"50\" font-size=\"10.5\" fill=\"#5a6270\">{share}{}</text>\n\
             <rect x=\"{}\" y=\"19\" width=\"20\" height=\"20\" rx=\"5\" fill=\"{}\" stroke=\"#0002\"/>",
            escape(&format!(
                "ray {}: weight {}, brings {}",
                place + 1,
                exact_color(node.ray.weight),
                short_color(node.brings)
            )),
            place + 1,
            node.kind.in_words(),
            node.ray.generation,
            escape(&name),
            endings(node.answer()),
            width - 30.0,
            css(node.radiance),
            bottom = height - 8.0,
        );
        self.lamps(text, node.answer());
        text.push_str("</g>\n");
    }

    /// A dot for each light: full if it shines on the point, half if it is filtered, empty if something is in the way.
    fn lamps(&self, text: &mut String, answer: Option<&SurfaceRecord>) {
        /// More would run into the text.
        const MOST: usize = 5;
        let lights =
            answer.into_iter().flat_map(|answer| &answer.lights).filter(|light| light.shadow.is_some());
        for (number, light) in lights.take(MOST).enumerate() {
            let passed = light.shadow.as_ref().map_or(0.0, |shadow| shadow.passed.max_element());
            let x = CARD[0] - 12.0 - 11.0 * number as f64;
            let _ = writeln!(
                text,
                "<circle cx=\"{x}\" cy=\"12\" r=\"3.6\" fill=\"#f2a900\" fill-opacity=\"{:.2}\" stroke=\"#b77f00\"/>",
                passed.clamp(0.0, 1.0)
            );
        }
    }
}

/// What part of the pixel's light a ray brings.
fn share(brings: DVec3, whole: DVec3) -> String {
    let (part, whole) = (brings.element_sum(), whole.element_sum());
    if whole > 0.0 && part.is_finite() {
        format!("brings {:.1} %", 100.0 * part / whole)
    } else {
        format!("brings {}", short_color(brings))
    }
}

/// Why branches end that would have carried something.
fn endings(answer: Option<&SurfaceRecord>) -> String {
    let Some(answer) = answer else { return String::new() };
    let mut reasons: Vec<&str> = [answer.reflected.fate, answer.refracted.fate]
        .iter()
        .filter_map(|fate| match fate {
            BranchOutcome::GenerationLimit => Some("limit"),
            BranchOutcome::Threshold => Some("threshold"),
            BranchOutcome::LeftOut => Some("left out"),
            BranchOutcome::Followed(_) | BranchOutcome::Nothing | BranchOutcome::TotalReflection => None,
        })
        .collect();
    reasons.dedup();
    if reasons.is_empty() { String::new() } else { format!(" · ends: {}", reasons.join(", ")) }
}

fn legend(text: &mut String, y: f64) {
    let mut x = MARGIN;
    for kind in NodeKind::ALL {
        let _ = writeln!(
            text,
            "<rect x=\"{x}\" y=\"{:.1}\" width=\"22\" height=\"6\" rx=\"3\" fill=\"{}\"/>\
             <text x=\"{}\" y=\"{:.1}\" font-size=\"12\" fill=\"#5a6270\">{}</text>",
            y - 6.0,
            drawing::color(kind),
            x + 30.0,
            y + 1.0,
            kind.in_words()
        );
        x += 58.0 + 7.0 * kind.in_words().len() as f64;
    }
    let _ = writeln!(
        text,
        "<circle cx=\"{}\" cy=\"{:.1}\" r=\"4\" fill=\"#f2a900\" stroke=\"#b77f00\"/>\
         <text x=\"{}\" y=\"{:.1}\" font-size=\"12\" fill=\"#5a6270\">a light that reaches the point (empty: in shadow)</text>",
        x + 6.0,
        y - 3.0,
        x + 18.0,
        y + 1.0
    );
}

/// Linear light as a color of CSS.
fn css(light: DVec3) -> String {
    let [red, green, blue] = light.to_array().map(|channel| (255.0 * srgb::encode(channel)).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn shortened(name: &str) -> String {
    const MOST: usize = 19;
    let name = name.trim_matches('"');
    if name.chars().count() <= MOST {
        return name.to_owned();
    }
    let kept: String = name.chars().take(MOST - 1).collect();
    kept + "…"
}
