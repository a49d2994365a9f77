//! The terms of a ray's light: the formula of the model with the numbers in place, line by line.

use catoptric_lab::audit::{Audit, Node};
use catoptric_scene::{Scene, ScenePart};
use catoptric_tracer::{
    BranchOutcome, BranchRecord, ContactRecord, LightTerm, ReflectionModel, ShadowRecord, SurfaceRecord,
};
use glam::{DVec3, Vec3};

use super::numbers::{color, degrees, short, vector};
use crate::base::texts::Texts;
use crate::panels::outliner::part_name;

/// Surfaces between a point and a light that are named; there may be very many.
const MOST_NAMED: usize = 4;

/// The term that a line shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AuditTerm {
    Way,
    Meets,
    Angles,
    Ambient,
    /// How a light stands to the point, and what lies between.
    Light(usize),
    Diffuse(usize),
    Highlight(usize),
    /// What the facets of a rough surface send on.
    Facets(usize),
    /// What comes from a light altogether.
    Arrives(usize),
    Local,
    Reflected,
    Refracted,
    Adds,
    Brings,
}

/// A line of a ray's terms: words, a formula with its numbers, and the value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AuditLine {
    pub(super) part: AuditTerm,
    pub(super) name: String,
    pub(super) words: String,
    /// Markup of [`typeset`](crate::base::typeset).
    pub(super) symbols: &'static str,
    /// Markup, too.
    pub(super) numbers: String,
    pub(super) value: Option<DVec3>,
}

impl AuditLine {
    fn new(part: AuditTerm, name: &str) -> Self {
        let (name, words, numbers) = (name.to_owned(), String::new(), String::new());
        Self { part, name, words, symbols: "", numbers, value: None }
    }

    fn words(mut self, words: String) -> Self {
        self.words = words;
        self
    }

    fn formula(mut self, symbols: &'static str, numbers: String) -> Self {
        (self.symbols, self.numbers) = (symbols, numbers);
        self
    }

    fn value(mut self, value: Vec3) -> Self {
        self.value = Some(value.as_dvec3());
        self
    }

    /// Whether it is a part of the term above it.
    pub(super) fn is_inner(&self) -> bool {
        matches!(
            self.part,
            AuditTerm::Diffuse(_) | AuditTerm::Highlight(_) | AuditTerm::Facets(_) | AuditTerm::Arrives(_)
        )
    }
}

/// All lines about a ray.
pub(super) fn of_node(texts: &Texts, scene: &Scene, audit: &Audit, node: &Node) -> Vec<AuditLine> {
    AuditLineWriter { texts, scene, audit }.node(node)
}

/// What a body is called.
pub(super) fn body_name(texts: &Texts, scene: &Scene, body: usize) -> String {
    part_name(texts, scene, ScenePart::Body(body)).into_owned()
}

struct AuditLineWriter<'a> {
    texts: &'a Texts,
    scene: &'a Scene,
    audit: &'a Audit,
}

impl AuditLineWriter<'_> {
    /// A body, and the part of it whose surface is met, by its address.
    fn surface_name(&self, body: usize, part: Option<usize>) -> String {
        let name = body_name(self.texts, self.scene, body);
        match self.audit.names.part(body, part) {
            Some(part) => format!("{name}, {part}"),
            None => name,
        }
    }

    fn node(&self, node: &Node) -> Vec<AuditLine> {
        let mut terms = vec![self.way(node)];
        match node.answer() {
            Some(answer) => self.surface(&mut terms, node, answer),
            None => {
                let background = self.texts.get("audit-background").to_owned();
                let meets = AuditLine::new(AuditTerm::Meets, self.texts.get("audit-meets")).words(background);
                terms.push(meets.value(node.ray.local));
            }
        }
        let through = match node.ray.through {
            Vec3::ONE => String::new(),
            through => format!(" · {}", color(self.texts, through)),
        };
        let numbers = format!(
            "{}{through} · {}",
            color(self.texts, node.ray.weight),
            color(self.texts, node.ray.local)
        );
        terms.push(
            AuditLine::new(AuditTerm::Adds, self.texts.get("audit-adds"))
                .words(self.texts.get("audit-weight-times-light").to_owned())
                .formula("", numbers)
                .value(node.ray.light),
        );
        if !node.children.is_empty() {
            let mut term = AuditLine::new(AuditTerm::Brings, self.texts.get("audit-brings"))
                .words(self.texts.get("audit-with-branches").to_owned());
            term.value = Some(node.brings);
            terms.push(term);
        }
        terms
    }

    fn way(&self, node: &Node) -> AuditLine {
        let inside = node.ray.media.first().map(|body| body_name(self.texts, self.scene, *body));
        let medium = inside.unwrap_or_else(|| self.texts.get("audit-air").to_owned());
        let arguments = [
            ("origin", vector(self.texts, node.ray.origin).into()),
            ("direction", vector(self.texts, Vec3::from(node.ray.ray.direction)).into()),
            ("medium", medium.into()),
            ("index", short(self.texts, node.ray.ior.into()).into()),
        ];
        let mut words = self.texts.with("audit-way-words", &arguments);
        if let Some(nanometers) = node.ray.wavelength {
            words.push_str(", ");
            words.push_str(
                &self.texts.with("audit-wave", &[("nanometers", short(self.texts, nanometers).into())]),
            );
        }
        if let Some(density) = node.ray.density {
            words.push_str(", ");
            words.push_str(
                &self.texts.with("audit-density", &[("density", short(self.texts, density.into()).into())]),
            );
        }
        AuditLine::new(AuditTerm::Way, self.texts.get("audit-way")).words(words)
    }

    fn surface(&self, terms: &mut Vec<AuditLine>, node: &Node, answer: &SurfaceRecord) {
        let texts = self.texts;
        if let Some(hit) = node.ray.hit {
            let arguments = [
                ("body", self.surface_name(hit.body, hit.part).into()),
                ("distance", short(self.texts, node.ray.distance().unwrap_or(f64::NAN)).into()),
                ("point", vector(self.texts, hit.position).into()),
                ("normal", vector(self.texts, hit.normal).into()),
            ];
            let key = if hit.from_within { "audit-meets-within" } else { "audit-meets-words" };
            terms.push(
                AuditLine::new(AuditTerm::Meets, texts.get("audit-meets")).words(texts.with(key, &arguments)),
            );
        }
        terms.extend(self.angles(node, answer));
        let numbers = format!(
            "{} · {} · {}",
            short(self.texts, answer.ambient_coefficient.into()),
            color(self.texts, answer.color),
            color(self.texts, answer.ambient_light)
        );
        let ambient = AuditLine::new(AuditTerm::Ambient, texts.get("audit-ambient")).value(answer.ambient);
        match answer.law {
            ReflectionModel::Constant | ReflectionModel::Schlick => {
                terms.push(ambient.formula("k_a C I_a", numbers));
            }
            ReflectionModel::Coat => terms.push(ambient.words(texts.get("audit-through-coat").to_owned())),
            ReflectionModel::Mirror
            | ReflectionModel::Dielectric
            | ReflectionModel::Conductor
            | ReflectionModel::ThinDielectric => {}
        }
        for light in &answer.lights {
            self.light(terms, light, answer);
        }
        terms.push(self.local(node, answer));
        let [reflected, refracted] = match answer.law {
            ReflectionModel::Constant => ["k_r", "k_t τ"],
            ReflectionModel::Schlick => ["k_r R(θ)", "k_t τ (1 − R(θ))"],
            ReflectionModel::Mirror => ["C k_r", ""],
            ReflectionModel::Dielectric | ReflectionModel::Conductor | ReflectionModel::Coat => {
                ["R(θ)", "1 − R(θ)"]
            }
            ReflectionModel::ThinDielectric => ["R(θ)", "(1 − R(θ)) τ"],
        };
        terms.push(self.branch(AuditTerm::Reflected, "audit-reflected", reflected, answer.reflected));
        if answer.interface.is_some() {
            let branch = self.branch(AuditTerm::Refracted, "audit-refracted", refracted, answer.refracted);
            let waves = self.audit.trees.first().and_then(|tree| node.waves(tree));
            terms.push(match waves {
                Some(waves) => {
                    let first = waves.first().map_or(0, |first| first + 1);
                    let arguments = [("count", waves.len().into()), ("ray", first.into())];
                    branch.words(texts.with("audit-split", &arguments))
                }
                None => branch,
            });
        }
    }

    fn angles(&self, node: &Node, answer: &SurfaceRecord) -> Option<AuditLine> {
        let incidence = degrees(self.texts, node.incidence?);
        let words = match (answer.interface, node.refraction) {
            (Some(interface), refraction) => {
                let arguments = [
                    ("incidence", incidence.into()),
                    (
                        "refraction",
                        refraction.map(|angle| degrees(self.texts, angle)).unwrap_or_default().into(),
                    ),
                    ("from", short(self.texts, node.ray.ior.into()).into()),
                    ("to", short(self.texts, interface.ior_beyond.into()).into()),
                ];
                let key = if refraction.is_some() { "audit-angles-both" } else { "audit-angles-total" };
                let words = self.texts.with(key, &arguments);
                match answer.contact() {
                    Some(contact) => format!("{words}; {}", self.contact(contact)),
                    None => words,
                }
            }
            (None, _) => self.texts.with("audit-angle", &[("incidence", incidence.into())]),
        };
        Some(AuditLine::new(AuditTerm::Angles, self.texts.get("audit-angles")).words(words))
    }

    /// The bodies of a cemented contact.
    fn contact(&self, contact: ContactRecord) -> String {
        let [left, entered] = contact.bodies.map(|body| body_name(self.texts, self.scene, body));
        let key = if contact.is_seamless { "audit-seamless" } else { "audit-cemented" };
        self.texts.with(key, &[("left", left.into()), ("entered", entered.into())])
    }

    fn light(&self, terms: &mut Vec<AuditLine>, light: &LightTerm, answer: &SurfaceRecord) {
        let texts = self.texts;
        let head = AuditLine::new(AuditTerm::Light(light.light), &self.light_name(light.light));
        let cosine = short(self.texts, light.cosine.into());
        let Some(shadow) = &light.shadow else {
            terms.push(head.words(texts.get("audit-light-below").to_owned()).formula("~n·~L", cosine));
            return;
        };
        let arguments = [
            ("distance", short(self.texts, light.distance.into()).into()),
            ("between", self.between(shadow).into()),
        ];
        terms.push(
            head.words(texts.with("audit-light-words", &arguments))
                .formula("V", color(self.texts, shadow.passed)),
        );
        let Some(sent) = light.answer else { return };
        let mut sum: Vec<String> = Vec::new();
        if answer.diffuse_coefficient != 0.0 {
            let k = short(self.texts, answer.diffuse_coefficient.into());
            let numbers = format!("{k} · {} · {cosine}", color(self.texts, answer.color));
            let diffuse = AuditLine::new(AuditTerm::Diffuse(light.light), texts.get("audit-diffuse"))
                .value(sent.diffuse);
            terms.push(match answer.law {
                ReflectionModel::Coat => diffuse.words(texts.get("audit-through-coat").to_owned()),
                _ => diffuse.formula("k_d C (~n·~L)", numbers),
            });
            sum.push(color(self.texts, sent.diffuse));
        }
        if answer.specular_coefficient != 0.0 {
            let k = short(self.texts, answer.specular_coefficient.into());
            let (base, power) =
                (short(self.texts, sent.highlight_cosine.into()), short(self.texts, answer.shininess.into()));
            let highlight = AuditLine::new(AuditTerm::Highlight(light.light), texts.get("audit-highlight"));
            let numbers = format!("{k} · {base}^{{{power}}}");
            terms.push(highlight.formula("k_s (~S·~R)^n", numbers).value(Vec3::splat(sent.highlight)));
            sum.push(short(self.texts, sent.highlight.into()));
        }
        if answer.alpha > 0.0 {
            let facets = AuditLine::new(AuditTerm::Facets(light.light), texts.get("audit-facets"));
            let numbers = format!("α = {}", short(self.texts, answer.alpha.into()));
            terms.push(facets.formula("π F D G/(4 ~n·~S)", numbers).value(sent.glints));
            sum.push(color(self.texts, sent.glints));
        }
        let sum = if sum.len() > 1 { format!("({})", sum.join(" + ")) } else { sum.concat() };
        let numbers =
            format!("{} · {} · {sum}", color(self.texts, shadow.passed), color(self.texts, sent.power));
        let arrives = AuditLine::new(AuditTerm::Arrives(light.light), texts.get("audit-arrives"));
        terms.push(arrives.formula("V A(d)I (…)", numbers).value(sent.light));
    }

    /// What a light is called; rays know it by its place among those that shine.
    fn light_name(&self, light: usize) -> String {
        let shining = self.scene.lights.iter().enumerate().filter(|(_, light)| !light.hidden);
        let place = shining.map(|(place, _)| place).nth(light).unwrap_or(light);
        part_name(self.texts, self.scene, ScenePart::Light(place)).into_owned()
    }

    /// What lies between a point and a light.
    fn between(&self, shadow: &ShadowRecord) -> String {
        let texts = self.texts;
        // Behind an opaque body nothing matters.
        let end = shadow.crossings.iter().position(|crossing| crossing.filter.is_none());
        let crossings = shadow.crossings.get(..end.map_or(shadow.crossings.len(), |end| end + 1));
        let crossings = crossings.unwrap_or_default();
        let absorbed = end.is_none() && shadow.through != Vec3::ONE;
        if crossings.is_empty() && !absorbed {
            return texts.get("audit-nothing-between").to_owned();
        }
        let mut words: Vec<String> = crossings
            .iter()
            .take(MOST_NAMED)
            .map(|crossing| {
                let name = self.surface_name(crossing.body, crossing.part);
                let at = short(self.texts, crossing.distance.into());
                let mut arguments = vec![("body", name.into()), ("distance", at.into())];
                match crossing.filter {
                    Some(filter) => {
                        arguments.push(("filter", color(self.texts, filter).into()));
                        let Some(into) = crossing.into else {
                            return texts.with("audit-filtered", &arguments);
                        };
                        arguments.push(("into", body_name(texts, self.scene, into).into()));
                        texts.with("audit-filtered-into", &arguments)
                    }
                    None => texts.with("audit-blocked", &arguments),
                }
            })
            .collect();
        if crossings.len() > MOST_NAMED {
            let more = [("count", (crossings.len() - MOST_NAMED).into())];
            words.push(texts.with("audit-more-surfaces", &more));
        }
        if absorbed {
            let filter = [("filter", color(texts, shadow.through).into())];
            words.push(texts.with("audit-medium-before-light", &filter));
        }
        words.join(", ")
    }

    fn local(&self, node: &Node, answer: &SurfaceRecord) -> AuditLine {
        let lights = answer.lights.iter().filter_map(|light| light.answer).map(|answer| answer.light);
        let terms: Vec<String> =
            std::iter::once(answer.ambient).chain(lights).map(|light| color(self.texts, light)).collect();
        // One term by itself is its own sum.
        let numbers = if terms.len() > 1 { terms.join(" + ") } else { String::new() };
        let term = AuditLine::new(AuditTerm::Local, self.texts.get("audit-local"));
        term.formula("I_{local}", numbers).value(node.ray.local)
    }

    /// What becomes of a ray that may go on.
    fn branch(
        &self,
        part: AuditTerm,
        key: &'static str,
        symbols: &'static str,
        branch: BranchRecord,
    ) -> AuditLine {
        let texts = self.texts;
        let weight = || ("weight", color(self.texts, branch.weight).into());
        let words = match branch.fate {
            BranchOutcome::Followed(child) => texts.with("audit-goes-on", &[("ray", (child + 1).into())]),
            BranchOutcome::Nothing => texts.get("audit-ends-nothing").to_owned(),
            BranchOutcome::TotalReflection => texts.get("audit-ends-total").to_owned(),
            BranchOutcome::GenerationLimit => {
                texts.with("audit-ends-limit", &[("limit", self.audit.generations.into()), weight()])
            }
            BranchOutcome::Threshold => {
                let threshold = short(self.texts, self.audit.threshold.into());
                texts.with("audit-ends-threshold", &[("threshold", threshold.into()), weight()])
            }
            BranchOutcome::LeftOut => texts.with("audit-ends-left-out", &[weight()]),
        };
        let term = AuditLine::new(part, texts.get(key)).words(words);
        if branch.fate == BranchOutcome::TotalReflection {
            term
        } else {
            term.formula(symbols, color(self.texts, branch.coefficient))
        }
    }
}
