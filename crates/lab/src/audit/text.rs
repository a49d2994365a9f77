//! The audit as a text: the tree at a glance, each ray with its formula, and the sum.

use std::fmt::Write as _;

use catoptric_tracer::{
    BranchOutcome, BranchRecord, LightTerm, ReflectionModel, ShadowRecord, SurfaceRecord,
};
use glam::Vec3;

use super::numbers::{degrees, exact, exact_color, exact_double, short, short_color, short_vector};
use super::{Audit, Node, NodeKind, Proof, RayTree};

impl Audit {
    /// The audit in words and numbers, plain text of several lines in English: the tree at a glance, then every ray
    /// with the terms of its light, then the sum. Rays more than `depth` steps from the eye are left out if that is
    /// given (0 leaves the primary ray alone); the sum has all.
    ///
    /// Light, weights and coefficients stand in the shortest digits that name their single-precision number and no
    /// other; lengths, directions and angles have four significant digits.
    pub fn to_text(&self, depth: Option<usize>) -> String {
        let mut text = self.head();
        for tree in &self.trees {
            if self.picture.samples > 1 {
                let _ = writeln!(
                    text,
                    "\nSample {} of {}, at {},{} in the pixel",
                    tree.sample + 1,
                    self.picture.samples,
                    short(tree.offset.x),
                    short(tree.offset.y)
                );
            }
            AuditText { audit: self, tree, depth, text: &mut text }.write();
        }
        self.write_mean(&mut text);
        text
    }

    fn head(&self) -> String {
        let [red, green, blue] = self.light.map(exact);
        let rays: usize = self.trees.iter().map(|tree| tree.nodes.len()).sum();
        let shadows: usize = self.trees.iter().map(RayTree::shadow_rays).sum();
        let deepest = self.trees.iter().map(RayTree::generations).max().unwrap_or(0);
        let mut text = format!(
            "Pixel {},{} of {}x{}: linear light {red} {green} {blue}\n{}, {}, {} of at most {}\n{}\n",
            self.pixel.x,
            self.pixel.y,
            self.picture.width,
            self.picture.height,
            counted(rays, "ray"),
            counted(shadows, "shadow ray"),
            counted(deepest as usize, "generation"),
            self.generations,
            self.proof.in_words(),
        );
        if self.proof == Proof::Incomplete {
            let left_out: usize = self.trees.iter().map(|tree| tree.left_out).sum();
            let missing = self.picture.samples as usize - self.trees.len();
            let _ = writeln!(
                text,
                "Left out: {} with all that grows from them, and {}.",
                counted(left_out, "branch"),
                counted(missing, "whole sample")
            );
        }
        text
    }

    /// Of several samples, their light and its mean.
    fn write_mean(&self, text: &mut String) {
        if self.picture.samples == 1 {
            return;
        }
        let _ = writeln!(text, "\nThe mean of {}", counted(self.picture.samples as usize, "sample"));
        for tree in &self.trees {
            line(text, &format!("sample {}", tree.sample + 1), &tree.light.to_array().map(exact));
        }
        line(text, "mean", &self.sum.to_array().map(exact_double));
        line(text, "pixel", &self.light.map(exact));
    }
}

/// A line of a sum.
fn line(text: &mut String, what: &str, channels: &[String; 3]) {
    let _ = writeln!(text, "  {what:<13} {}", columns(channels, 22));
}

impl Proof {
    /// What is known, in a sentence.
    fn in_words(self) -> &'static str {
        match self {
            Self::AnyOrder => "The light of the rays adds up to the pixel exactly, in whatever order.",
            Self::Rendered { is_same: true } => {
                "The light of the rays adds up to the pixel; its last bit could depend on the order, so the pixel was rendered anew."
            }
            Self::Rendered { is_same: false } => {
                "The light of the rays adds up to the pixel but for its last bit, which depends on the order; the pixel was rendered anew."
            }
            Self::Incomplete => {
                "There are more rays than are written down; the pixel was traced once more to see the whole."
            }
        }
    }
}

/// `1 ray`, `2 rays`.
pub(super) fn counted(number: usize, what: &str) -> String {
    let ending = match (number, what) {
        (1, _) => "",
        (_, "branch") => "es",
        _ => "s",
    };
    format!("{number} {what}{ending}")
}

fn columns(texts: &[String], width: usize) -> String {
    let padded: Vec<String> = texts.iter().map(|text| format!("{text:<width$}")).collect();
    padded.concat().trim_end().to_owned()
}

/// The text of an audit while it is written.
struct AuditText<'a> {
    audit: &'a Audit,
    tree: &'a RayTree,
    depth: Option<usize>,
    text: &'a mut String,
}

impl AuditText<'_> {
    fn write(&mut self) {
        let depths = depths(self.tree);
        let shown: Vec<usize> = (0..self.tree.nodes.len())
            .filter(|&place| self.depth.is_none_or(|depth| depths.get(place).is_some_and(|d| *d <= depth)))
            .collect();
        self.overview(&shown);
        for &place in &shown {
            self.ray(place);
        }
        self.sum();
    }

    /// The tree at a glance: a line for each ray.
    fn overview(&mut self, shown: &[usize]) {
        let branches = branch_lines(self.tree);
        let rows: Vec<[String; 6]> = shown
            .iter()
            .filter_map(|&place| {
                let node = self.tree.nodes.get(place)?;
                let line = branches.get(place).map_or("", String::as_str);
                Some([
                    format!("{}", place + 1),
                    format!("{line}{}", node.kind.in_words()),
                    format!("{}", node.ray.generation),
                    exact_color(node.ray.weight),
                    self.end_of(node),
                    short_color(node.brings),
                ])
            })
            .collect();
        let heads = ["ray", "", "generation", "weight", "ends at", "brings"].map(str::to_owned);
        let mut widths = [0; 6];
        for row in std::iter::once(&heads).chain(&rows) {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        let _ = writeln!(self.text);
        for row in std::iter::once(&heads).chain(&rows) {
            let cells: Vec<String> =
                row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}  ")).collect();
            let _ = writeln!(self.text, "  {}", cells.concat().trim_end());
        }
        let hidden = self.tree.nodes.len() - shown.len();
        if hidden > 0 {
            let _ = writeln!(self.text, "  and {} deeper in the tree", counted(hidden, "ray"));
        }
    }

    fn end_of(&self, node: &Node) -> String {
        node.ray.hit.map_or_else(|| "background".to_owned(), |hit| self.audit.names.body(hit.body))
    }

    fn line(&mut self, head: &str, rest: &str) {
        let _ = writeln!(self.text, "  {head:<11} {rest}");
    }

    /// One ray, term by term.
    fn ray(&mut self, place: usize) {
        let tree = self.tree;
        let Some(node) = tree.nodes.get(place) else { return };
        let from = node.ray.parent.map_or_else(String::new, |parent| format!(", from ray {}", parent + 1));
        let _ = writeln!(
            self.text,
            "\nRay {}: {}, generation {}{from}",
            place + 1,
            node.kind.in_words(),
            node.ray.generation
        );
        let origin = short_vector(node.ray.origin);
        let direction = short_vector(Vec3::from(node.ray.ray.direction));
        let through = match node.ray.media.first() {
            Some(&body) => format!("in {}, index {}", self.audit.names.body(body), exact(node.ray.ior)),
            None => "in air".to_owned(),
        };
        let color = match node.ray.wavelength {
            Some(nanometers) => format!(", light of {nanometers:.1} nm"),
            None => String::new(),
        };
        let density = match node.ray.density {
            Some(density) => format!(", chosen with a density of {} per steradian", exact(density)),
            None => String::new(),
        };
        self.line("way", &format!("from {origin} along {direction}, {through}{color}{density}"));
        match node.answer() {
            Some(answer) => self.surface(node, answer),
            None => self.line("meets", &format!("nothing: the background {}", exact_color(node.ray.local))),
        }
        let through = match node.ray.through {
            Vec3::ONE => String::new(),
            through => format!(" × {} left by the way", exact_color(through)),
        };
        let sum = format!(
            "weight {}{through} × {} = {}",
            exact_color(node.ray.weight),
            exact_color(node.ray.local),
            exact_color(node.ray.light)
        );
        self.line("adds", &sum);
    }

    fn surface(&mut self, node: &Node, answer: &SurfaceRecord) {
        let Some(hit) = node.ray.hit else { return };
        let side = if hit.from_within { " from within" } else { "" };
        self.line(
            "meets",
            &format!(
                "{}{side} after {} m at {}, n̂ {}",
                self.audit.names.surface(hit.body, hit.part),
                short(node.ray.distance().unwrap_or(f64::NAN)),
                short_vector(hit.position),
                short_vector(hit.normal)
            ),
        );
        self.angles(node, answer);
        let second = match answer.second_share {
            Some(1.0) => ", the pattern's second color".to_owned(),
            Some(share) if share > 0.0 => format!(", {} of the pattern's second color", short(share.into())),
            _ => String::new(),
        };
        let is_seamless = answer.is_seamless();
        if !is_seamless && (answer.law.has_ground() || answer.law == ReflectionModel::Mirror) {
            self.line("color", &format!("C = {}{second}", exact_color(answer.color)));
        }
        if is_seamless {
            self.line("cemented", "no surface: light goes on as in one body");
        } else if matches!(answer.law, ReflectionModel::Constant | ReflectionModel::Schlick) {
            self.line(
                "ambient",
                &format!(
                    "k_a·C·I_a = {} × {} × {} = {}",
                    exact(answer.ambient_coefficient),
                    exact_color(answer.color),
                    exact_color(answer.ambient_light),
                    exact_color(answer.ambient)
                ),
            );
        } else if answer.law == ReflectionModel::Coat {
            self.line("ambient", &format!("{} through the coat", exact_color(answer.ambient)));
        }
        for light in &answer.lights {
            self.light(light, answer);
        }
        self.local(node, answer);
        let by = match (answer.law, node.incidence) {
            _ if is_seamless => String::new(),
            (ReflectionModel::Constant, _) | (_, None) => String::new(),
            (ReflectionModel::Schlick, Some(angle)) => format!(" by Schlick's formula at {}", degrees(angle)),
            (ReflectionModel::Mirror, _) => " in the mirror's color".to_owned(),
            (ReflectionModel::Dielectric, Some(angle)) => format!(" by Fresnel at {}", degrees(angle)),
            (ReflectionModel::Conductor, Some(angle)) => {
                format!(" by Fresnel for metals at {}", degrees(angle))
            }
            (ReflectionModel::Coat, Some(angle)) => format!(" by Fresnel for the coat at {}", degrees(angle)),
            (ReflectionModel::ThinDielectric, Some(angle)) => {
                format!(" by Fresnel for both faces of the sheet at {}", degrees(angle))
            }
        };
        let reflected = self.branch(&format!("reflected{by}"), answer.reflected);
        self.line("goes on", &reflected);
        if answer.interface.is_some() {
            let refracted = match node.waves(self.tree) {
                Some(waves) => format!(
                    "refracted: split by color into {} rays, the first {}; together weight × {}",
                    waves.len(),
                    waves.first().map_or(0, |first| first + 1),
                    exact_color(answer.refracted.coefficient)
                ),
                None => self.branch("refracted", answer.refracted),
            };
            self.line("", &refracted);
        }
    }

    /// The sum of the local terms, if there is more than one.
    fn local(&mut self, node: &Node, answer: &SurfaceRecord) {
        let lights = answer.lights.iter().filter_map(|light| light.answer);
        let terms: Vec<String> = std::iter::once(answer.ambient)
            .chain(lights.map(|answer| answer.light))
            .map(exact_color)
            .collect();
        if terms.len() > 1 {
            self.line("local", &format!("{} = {}", terms.join(" + "), exact_color(node.ray.local)));
        }
    }

    fn angles(&mut self, node: &Node, answer: &SurfaceRecord) {
        let Some(incidence) = node.incidence else { return };
        let mut words = format!("incidence {}", degrees(incidence));
        if let Some(interface) = answer.interface {
            let (from, to) = (exact(node.ray.ior), exact(interface.ior_beyond));
            let indices = match interface.contact {
                Some(contact) => {
                    let [left, entered] = contact.bodies.map(|body| self.audit.names.body(body));
                    format!("cemented: from {left}, index {from}, to {entered}, index {to}")
                }
                None => format!("index {from} to {to}"),
            };
            let _ = match node.refraction {
                Some(refraction) => write!(words, ", refraction {} ({indices})", degrees(refraction)),
                None => write!(words, ", total internal reflection ({indices})"),
            };
        }
        self.line("angles", &words);
    }

    fn light(&mut self, light: &LightTerm, answer: &SurfaceRecord) {
        let name = self.audit.names.light(light.light);
        let facing = format!("d = {} m, n̂·L̂ = {}", short(light.distance.into()), exact(light.cosine));
        let Some(shadow) = &light.shadow else {
            self.line(&name, &format!("{facing}: below the surface, adds nothing"));
            return;
        };
        let way = self.way(shadow);
        let Some(sent) = light.answer else {
            self.line(&name, &format!("{facing}, V = 0: {way}"));
            return;
        };
        self.line(&name, &format!("{facing}, V = {}: {way}", exact_color(shadow.passed)));
        let mut terms = Vec::new();
        let diffuse = exact_color(sent.diffuse);
        if answer.diffuse_coefficient != 0.0 {
            let (k, c) = (exact(answer.diffuse_coefficient), exact_color(answer.color));
            let cosine = exact(light.cosine);
            let said = match answer.law {
                ReflectionModel::Coat => format!("diffuse through the coat, of {c} × {cosine}: {diffuse}"),
                _ => format!("diffuse k_d·C·(n̂·L̂) = {k} × {c} × {cosine} = {diffuse}"),
            };
            self.line("", &said);
            terms.push(diffuse);
        }
        if answer.specular_coefficient != 0.0 {
            self.line(
                "",
                &format!(
                    "highlight k_s·(Ŝ·R̂)ⁿ = {} × {}^{} = {}",
                    exact(answer.specular_coefficient),
                    exact(sent.highlight_cosine),
                    exact(answer.shininess),
                    exact(sent.highlight)
                ),
            );
            terms.push(exact(sent.highlight));
        }
        if answer.alpha > 0.0 {
            let (alpha, glints) = (exact(answer.alpha), exact_color(sent.glints));
            self.line("", &format!("facets (α = {alpha}) send on {glints}"));
            terms.push(glints);
        }
        let terms = match terms.as_slice() {
            [only] => only.clone(),
            several => format!("({})", several.join(" + ")),
        };
        let (passed, power) = (exact_color(shadow.passed), exact_color(sent.power));
        let light = exact_color(sent.light);
        self.line("", &format!("A(d)·I·(…)·V = {power} × {terms} × {passed} = {light}"));
    }

    /// What lies between a point and a light.
    fn way(&self, shadow: &ShadowRecord) -> String {
        const MOST: usize = 6;
        let absorbed = shadow.through != Vec3::ONE;
        if shadow.crossings.is_empty() && !absorbed {
            return "nothing between".to_owned();
        }
        let mut words: Vec<String> = shadow
            .crossings
            .iter()
            .take(MOST)
            .map(|crossing| {
                let name = self.audit.names.surface(crossing.body, crossing.part);
                let at = short(crossing.distance.into());
                match crossing.filter {
                    Some(filter) => {
                        let act = if crossing.leaving { "leaves" } else { "enters" };
                        let into = crossing.into.map(|body| format!(" into {}", self.audit.names.body(body)));
                        let into = into.unwrap_or_default();
                        format!("{act} {name}{into} at {at} m × {}", exact_color(filter))
                    }
                    None if crossing.leaving => format!("{name} to {at} m"),
                    None => format!("{name} in the way at {at} m"),
                }
            })
            .collect();
        if shadow.crossings.len() > MOST {
            words.push(format!("and {} more", counted(shadow.crossings.len() - MOST, "surface")));
        }
        if absorbed {
            words.push(format!("the medium before the light × {}", exact_color(shadow.through)));
        }
        words.join(", ")
    }

    fn branch(&self, name: &str, branch: BranchRecord) -> String {
        let BranchRecord { coefficient, weight, fate } = branch;
        let weight = exact_color(weight);
        let rest = match fate {
            BranchOutcome::Followed(child) => {
                format!("ray {}, weight × {}", child + 1, exact_color(coefficient))
            }
            BranchOutcome::Nothing => "nothing, the coefficient is 0".to_owned(),
            BranchOutcome::TotalReflection => "nothing, all light is reflected".to_owned(),
            BranchOutcome::GenerationLimit => {
                format!("ends at the limit of {} generations; its weight {weight}", self.audit.generations)
            }
            BranchOutcome::Threshold => {
                format!("ends: its weight {weight} is below {}", exact(self.audit.threshold))
            }
            BranchOutcome::LeftOut => format!("left out of this list; its weight {weight}"),
        };
        format!("{name}: {rest}")
    }

    /// What the rays add, line by line, and the sum.
    fn sum(&mut self) {
        let _ = writeln!(self.text, "\nThe sum");
        for (place, node) in self.tree.nodes.iter().enumerate() {
            line(self.text, &format!("ray {}", place + 1), &node.ray.light.to_array().map(exact));
        }
        line(self.text, "sum", &self.tree.sum().to_array().map(exact_double));
        match self.audit.picture.samples {
            1 => line(self.text, "pixel", &self.audit.light.map(exact)),
            _ => line(self.text, "light", &self.tree.light.to_array().map(exact)),
        }
    }
}

impl NodeKind {
    pub(super) fn in_words(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Reflected => "reflected",
            Self::TotallyReflected => "totally reflected",
            Self::Refracted => "refracted",
        }
    }
}

/// How many steps each ray is from the eye.
pub(super) fn depths(tree: &RayTree) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        let above = node.ray.parent.and_then(|parent| depths.get(parent).copied());
        depths.push(above.map_or(0, |depth| depth + 1));
    }
    depths
}

/// The lines of a tree before each of its rays: `│ ├─ `.
fn branch_lines(tree: &RayTree) -> Vec<String> {
    /// Deeper, the lines would run out of the page.
    const DEEPEST: usize = 40;
    let depths = depths(tree);
    let mut open: Vec<bool> = Vec::new();
    let mut lines = Vec::with_capacity(tree.nodes.len());
    for (place, (node, &depth)) in tree.nodes.iter().zip(&depths).enumerate() {
        let siblings = node.ray.parent.and_then(|parent| tree.nodes.get(parent)).map(|node| &node.children);
        let is_last = siblings.is_none_or(|siblings| siblings.last() == Some(&place));
        open.truncate(depth.saturating_sub(1));
        let mut line: String =
            open.iter().take(DEEPEST).map(|&is_open| if is_open { "│ " } else { "  " }).collect();
        if depth > 0 {
            line.push_str(if is_last { "└─ " } else { "├─ " });
            open.push(!is_last);
        }
        lines.push(line);
    }
    lines
}
