//! Validation of scenes in memory, by the rules that scene files are read by.

use std::collections::{HashMap, HashSet};
use std::fmt;

use crate::Scene;
use crate::body::Body;
use crate::camera::Camera;
use crate::compound::Form;
use crate::format::address::part_step;
use crate::format::material;
use crate::format::message::{Collection, Component, FoundValue, Message, Subject};
use crate::format::quote::quoted;
use crate::format::record::{self, Datum, Record};
use crate::format::rules;
use crate::format::spec::{KeySpec, Kind, Limits};
use crate::instances::InstanceFault;
use crate::language::Language;
use crate::light::Light;
use crate::material::{Material, MaterialChoice, NamedMaterial, SolidTexture};
use crate::part::ScenePart;
use crate::placement::Anchor;
use crate::shape::Shape;

/// A problem of a scene that no file could express.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where it is.
    pub part: ScenePart,
    /// The key of the value that is wrong, as files call it.
    pub key: &'static str,
    /// The name of the part, between backquotes; `None` for what has none.
    name: Option<String>,
    /// The address of the part of a body that has it, `parts.front`; empty for all else.
    within: String,
    /// What is wrong.
    message: Message,
}

impl Problem {
    /// What is wrong, with the name of the part: ``body `floor`: …``.
    pub fn message(&self, language: Language) -> String {
        let what = self.message.text(language);
        if matches!(self.message, Message::NumbersOfName { .. }) {
            what
        } else {
            format!("{}: {what}", self.title(language))
        }
    }

    /// What the part is called: ``body `floor` ``, or `body 3` when it has no name.
    fn title(&self, language: Language) -> String {
        let (english, russian, index) = match self.part {
            ScenePart::Camera => ("the camera", "камера", None),
            ScenePart::Environment => ("the environment", "окружение", None),
            ScenePart::Tracing => ("the tracing", "трассировка", None),
            ScenePart::Material(index) => ("material", "материал", Some(index)),
            ScenePart::Light(index) => ("light", "источник света", Some(index)),
            ScenePart::Body(index) => ("body", "тело", Some(index)),
        };
        let kind = language.pick(english, russian);
        let title = match (index, &self.name) {
            (None, _) => kind.to_owned(),
            (Some(_), Some(name)) => format!("{kind} {name}"),
            (Some(index), None) => format!("{kind} {}", index + 1),
        };
        if self.within.is_empty() { title } else { format!("{title}, `{}`", self.within) }
    }
}

/// In English.
impl fmt::Display for Problem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message(Language::English))
    }
}

impl std::error::Error for Problem {}

impl Scene {
    /// All problems of the scene: values out of range, names used twice, materials that are not defined. A scene
    /// without problems can be written, and reads back the same.
    pub fn check(&self) -> Vec<Problem> {
        let mut check = SceneValidator { problems: Vec::new() };
        check.camera(&self.camera);
        check.record(&NamedPart::unnamed(ScenePart::Environment), &record::environment(&self.environment));
        check.record(&NamedPart::unnamed(ScenePart::Tracing), &record::tracing(&self.tracing));
        for (index, named) in self.materials.iter().enumerate() {
            check.material(index, named);
        }
        for (index, light) in self.lights.iter().enumerate() {
            check.light(index, light);
        }
        for (index, body) in self.bodies.iter().enumerate() {
            check.body(index, body);
        }
        check.names(self);
        check.instances(self, |_| true);
        check.problems
    }

    /// The problems of one part, by itself: its values, whether its name is another's too, whether its material is
    /// defined. Much cheaper than [`Self::check`] where only this part can have changed. A part that the scene does not
    /// have has no problems.
    pub fn check_part(&self, part: ScenePart) -> Vec<Problem> {
        let mut check = SceneValidator { problems: Vec::new() };
        match part {
            ScenePart::Camera => check.camera(&self.camera),
            ScenePart::Environment => {
                check.record(
                    &NamedPart::unnamed(ScenePart::Environment),
                    &record::environment(&self.environment),
                );
            }
            ScenePart::Tracing => {
                check.record(&NamedPart::unnamed(ScenePart::Tracing), &record::tracing(&self.tracing));
            }
            ScenePart::Material(index) => {
                if let Some(named) = self.materials.get(index) {
                    check.material(index, named);
                    let names = self.materials.iter().map(|other| other.name.as_str());
                    check.other_uses(Collection::Materials, names, &named.name, part);
                }
            }
            ScenePart::Light(index) => {
                if let Some(light) = self.lights.get(index) {
                    check.light(index, light);
                    let names = self.lights.iter().map(|other| other.name.as_str());
                    check.other_uses(Collection::Lights, names, &light.name, part);
                }
            }
            ScenePart::Body(index) => {
                if let Some(body) = self.bodies.get(index) {
                    check.body(index, body);
                    let names = self.bodies.iter().map(|other| other.name.as_str());
                    check.other_uses(Collection::Bodies, names, &body.name, part);
                    let is_defined = |name: &str| self.materials.iter().any(|named| named.name == name);
                    check.undefined(index, body, is_defined);
                    check.instances(self, |fault| fault.body == index);
                }
            }
        }
        check.problems
    }
}

impl Camera {
    /// Whether a scene can have this camera: finite numbers within the format's limits, a direction of view, and an
    /// upward direction across it.
    pub fn is_valid(&self) -> bool {
        let mut check = SceneValidator { problems: Vec::new() };
        check.camera(self);
        check.problems.is_empty()
    }
}

fn named_alike(things: Collection, name: &str, first: usize, second: usize) -> Message {
    let (first, second) = (first.to_string(), second.to_string());
    Message::NumbersOfName { things, name: quoted(name), first, second }
}

/// The part that is looked at, with its name.
struct NamedPart<'a> {
    part: ScenePart,
    name: &'a str,
    /// The address of a part within a body; empty for what is a part of the scene itself.
    within: String,
}

impl NamedPart<'static> {
    /// A part without a name.
    fn unnamed(part: ScenePart) -> Self {
        Self { part, name: "", within: String::new() }
    }
}

struct SceneValidator {
    problems: Vec<Problem>,
}

impl SceneValidator {
    fn add(&mut self, of: &NamedPart<'_>, key: &'static str, message: Message) {
        let name = (!of.name.is_empty()).then(|| quoted(of.name));
        let within = of.within.clone();
        self.problems.push(Problem { part: of.part, key, name, within, message });
    }

    fn camera(&mut self, camera: &Camera) {
        let before = self.problems.len();
        let of = NamedPart::unnamed(ScenePart::Camera);
        self.record(&of, &record::camera(camera));
        if self.problems.len() > before {
            return;
        }
        if let Some(broken) = rules::camera(camera.position, camera.target, camera.up) {
            self.add(&of, broken.key, broken.message);
        }
    }

    fn material(&mut self, index: usize, named: &NamedMaterial) {
        let of = NamedPart { part: ScenePart::Material(index), name: &named.name, within: String::new() };
        self.record(&of, &material::record(&named.material));
        self.pattern(&of, &named.material);
        if named.name.is_empty() {
            self.add(&of, "name", Message::UnnamedMaterial);
        }
    }

    fn light(&mut self, index: usize, light: &Light) {
        let of = NamedPart { part: ScenePart::Light(index), name: &light.name, within: String::new() };
        self.record(&of, &record::light(light));
    }

    fn body(&mut self, index: usize, body: &Body) {
        let of = NamedPart { part: ScenePart::Body(index), name: &body.name, within: String::new() };
        self.geometry(&of, &record::body(body), &body.form(), 0);
        for choice in body.materials() {
            if let MaterialChoice::Inline(own) = choice {
                self.pattern(&of, own);
            }
        }
    }

    /// How deep patterns lie within patterns.
    fn pattern(&mut self, of: &NamedPart<'_>, material: &Material) {
        let solid = material.pattern().and_then(|pattern| pattern.solid.as_ref());
        if let Some(solid) = solid.filter(|solid| solid.depth() > SolidTexture::MAX_DEPTH) {
            self.add(of, solid.kind.key(), Message::PatternsTooDeep);
        }
    }

    /// The values of a body or a part, and what they are together; `depth` is the number of wholes around it.
    fn geometry(&mut self, of: &NamedPart<'_>, record: &Record<'_>, form: &Form<'_>, depth: usize) {
        let before = self.problems.len();
        self.record(of, record);
        let is_in_range = self.problems.len() == before;
        self.place(of, form, is_in_range);
        // The parts of instances are looked at where they are.
        if form.instance.is_some() || form.parametric().is_some() {
            return;
        }
        if !form.shape.is_compound() && !form.parts.is_empty() {
            self.add(of, "parts", Message::PartsOfSimple { shape: form.shape.key() });
            return;
        }
        if let Some(broken) = rules::parts(form) {
            self.add(of, broken.key, broken.message);
        }
        if depth == Shape::MAX_DEPTH && !form.parts.is_empty() {
            self.add(of, "parts", Message::PartsTooDeep);
            return;
        }
        let mut names: HashSet<&str> = HashSet::new();
        for (index, part) in form.parts.iter().enumerate() {
            let within = format!("{}{}", of.within, part_step(part, index, of.within.is_empty()));
            let inner = NamedPart { part: of.part, name: of.name, within };
            self.geometry(&inner, &record::part(part), &part.form(), depth + 1);
            if !part.name.is_empty() && !names.insert(&part.name) {
                self.add(of, "parts", Message::PartNameTwice { name: quoted(&part.name) });
            }
        }
    }

    /// Where a body or a part stands, and its height.
    fn place(&mut self, of: &NamedPart<'_>, form: &Form<'_>, is_in_range: bool) {
        let Anchor::Axis { base, top } = form.placement.anchor else {
            if let Some(broken) = rules::sizes(&form.body_shape()).filter(|_| is_in_range) {
                self.add(of, broken.key, broken.message);
            }
            return;
        };
        if form.shape.height().is_none() {
            self.add(of, "base", Message::NoAxis { shape: form.body_shape().key() });
            return;
        }
        if let Some(broken) = rules::axis(base, top).filter(|_| is_in_range) {
            self.add(of, broken.key, broken.message);
        }
    }

    /// Holds every value against the limits of its key.
    fn record(&mut self, of: &NamedPart<'_>, record: &Record<'_>) {
        for (name, datum) in &record.values {
            let Some((_, key)) = record.table.0.find(name) else { continue };
            match datum {
                Datum::Table(inner) => self.record(of, inner),
                Datum::Text(path) if matches!(key.kind, Kind::File) && path.is_empty() => {
                    self.add(of, key.name, Message::EmptyPath { key: key.name });
                }
                // Parts are looked at one by one.
                Datum::Text(_) | Datum::Flag(_) | Datum::Tables(_) => {}
                Datum::Number(value) => self.number(of, key, *value, Component::Whole),
                Datum::Integer(value) => self.number(of, key, f64::from(*value), Component::Whole),
                Datum::Vector(values) => {
                    for (value, which) in values.iter().zip(Component::IN_ORDER) {
                        self.number(of, key, *value, which);
                    }
                }
            }
        }
    }

    fn number(&mut self, of: &NamedPart<'_>, key: &'static KeySpec, value: f64, which: Component) {
        let limits: Option<Limits> = key.kind.limits();
        let Some(limits) = limits.filter(|limits| !limits.contains(value)) else { return };
        let message = Message::OutOfRange {
            subject: Subject::component(which, key.name),
            value: FoundValue::Value(value.into()),
            requirement: limits.requirement(value),
        };
        self.add(of, key.name, message);
    }

    fn names(&mut self, scene: &Scene) {
        let materials = scene.materials.iter().map(|named| named.name.as_str());
        self.unique(Collection::Materials, materials, ScenePart::Material);
        self.unique(
            Collection::Lights,
            scene.lights.iter().map(|light| light.name.as_str()),
            ScenePart::Light,
        );
        self.unique(Collection::Bodies, scene.bodies.iter().map(|body| body.name.as_str()), ScenePart::Body);
        let defined: HashSet<&str> = scene.materials.iter().map(|named| named.name.as_str()).collect();
        for (index, body) in scene.bodies.iter().enumerate() {
            self.undefined(index, body, |name| defined.contains(name));
        }
    }

    fn undefined(&mut self, index: usize, body: &Body, is_defined: impl Fn(&str) -> bool) {
        for name in body.materials().filter_map(MaterialChoice::name).filter(|name| !is_defined(name)) {
            let of = NamedPart { part: ScenePart::Body(index), name: &body.name, within: String::new() };
            self.add(&of, "material", Message::Undefined { name: quoted(name) });
        }
    }

    /// Instances that cannot be.
    fn instances(&mut self, scene: &Scene, is_asked: impl Fn(&InstanceFault) -> bool) {
        for fault in scene.instance_faults().iter().filter(|fault| is_asked(fault)) {
            let Some(body) = scene.bodies.get(fault.body) else { continue };
            let of = NamedPart { part: ScenePart::Body(fault.body), name: &body.name, within: String::new() };
            let broken = rules::instance(fault);
            self.add(&of, broken.key, broken.message);
        }
    }

    /// Reports a name that several have, of which `part` is one.
    fn other_uses<'a>(
        &mut self,
        things: Collection,
        names: impl Iterator<Item = &'a str>,
        name: &str,
        part: ScenePart,
    ) {
        if name.is_empty() {
            return;
        }
        let mut users = names.enumerate().filter(|(_, other)| *other == name).map(|(index, _)| index + 1);
        if let (Some(first), Some(second)) = (users.next(), users.next()) {
            self.add(&NamedPart::unnamed(part), "name", named_alike(things, name, first, second));
        }
    }

    fn unique<'a>(
        &mut self,
        things: Collection,
        names: impl Iterator<Item = &'a str>,
        part: impl Fn(usize) -> ScenePart,
    ) {
        let mut first_at: HashMap<&str, usize> = HashMap::new();
        for (index, name) in names.enumerate().filter(|(_, name)| !name.is_empty()) {
            let first = *first_at.entry(name).or_insert(index);
            if first != index {
                let message = named_alike(things, name, first + 1, index + 1);
                self.add(&NamedPart::unnamed(part(index)), "name", message);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{BodyPart, Phong, Placement};

    #[test]
    fn a_default_scene_has_no_problems() {
        assert_eq!(Scene::default().check(), []);
    }

    #[test]
    fn problems_name_their_part() {
        let ball = Body {
            name: "ball".to_owned(),
            shape: Shape::Sphere { radius: -1.0 },
            placement: Placement::at(DVec3::new(0.0, f64::NAN, 0.0)),
            material: MaterialChoice::Named("glass".to_owned()),
            ..Body::default()
        };
        let axis = Anchor::Axis { base: DVec3::ZERO, top: DVec3::ZERO };
        let rod = Body {
            shape: Shape::CYLINDER,
            placement: Placement { anchor: axis, scale: DVec3::ONE },
            ..Body::default()
        };
        let cube = Body { shape: Shape::CUBE, ..rod.clone() };
        let material = Phong { ior: 0.0, ..Phong::default() }.into();
        let mut scene = Scene {
            materials: vec![NamedMaterial { name: "m".to_owned(), material }],
            lights: vec![Light { intensity: -1.0, ..Light::default() }],
            bodies: [ball.clone(), ball, rod, cube].into(),
            ..Scene::default()
        };
        scene.camera.target = scene.camera.position;
        scene.tracing.generations = 0;
        let messages: Vec<String> = scene.check().iter().map(Problem::to_string).collect();
        let expected = [
            "the camera: `target` and `position` of the camera are the same point",
            "the tracing: `generations` is 0, but must be at least 1",
            "material `m`: `ior` is 0, but must be at least 0.01",
            "light 1: `intensity` is -1, but must be 0 or more",
            "body `ball`: `radius` is -1, but must be greater than 0",
            "body `ball`: the second number of `position` is NaN, but must be a finite number",
            "body `ball`: `radius` is -1, but must be greater than 0",
            "body `ball`: the second number of `position` is NaN, but must be a finite number",
            "body 3: `base` and `top` are the same point",
            "body 4: a cube cannot be placed by `base` and `top`",
            "two bodies have the name `ball`: numbers 1 and 2",
            "body `ball`: the material `glass` is not defined",
            "body `ball`: the material `glass` is not defined",
        ];
        assert_eq!(messages, expected);
    }

    #[test]
    fn a_part_has_the_problems_that_it_has_in_the_whole() {
        let named = |name: &str, ior| NamedMaterial {
            name: name.to_owned(),
            material: Phong { ior, ..Phong::default() }.into(),
        };
        let body = |name: &str, radius, material: &str| Body {
            name: name.to_owned(),
            shape: Shape::Sphere { radius },
            material: MaterialChoice::Named(material.to_owned()),
            ..Body::default()
        };
        let light = |name: &str| Light { name: name.to_owned(), ..Light::default() };
        let mut scene = Scene {
            materials: vec![named("m", 0.0), named("", 1.5), named("m", 1.5)],
            lights: vec![light(""), light("a"), light("a"), light("")],
            bodies: [body("", 1.0, "m"), body("b", -1.0, "none"), body("c", 1.0, "m"), body("b", 1.0, "m")]
                .into(),
            ..Scene::default()
        };
        scene.camera.up = DVec3::ZERO;
        scene.tracing.threshold = 2.0;
        scene.environment.ambient.r = f64::INFINITY;
        let whole = scene.check();
        let parts = [ScenePart::Camera, ScenePart::Environment, ScenePart::Tracing].into_iter();
        let parts = parts.chain((0..3).map(ScenePart::Material)).chain((0..4).map(ScenePart::Light));
        let mut alone: Vec<Problem> =
            parts.chain((0..5).map(ScenePart::Body)).flat_map(|part| scene.check_part(part)).collect();
        for problem in whole {
            let at = alone.iter().position(|other| *other == problem);
            alone.remove(at.unwrap_or_else(|| panic!("{problem} is in no part")));
        }
        // By itself the first of two with a name is as wrong as the second.
        let left: Vec<ScenePart> = alone.iter().map(|problem| problem.part).collect();
        assert_eq!(left, [ScenePart::Material(0), ScenePart::Light(1), ScenePart::Body(1)]);
        assert!(alone.iter().all(|problem| problem.key == "name"));
    }

    #[test]
    fn parts_have_problems_by_their_address() {
        let part = |name: &str, shape| BodyPart { name: name.to_owned(), shape, ..BodyPart::default() };
        let bad = Shape::Sphere { radius: -1.0 };
        let inner = BodyPart {
            parts: vec![part("", bad), part("a b", bad), part("c", Shape::CUBE), part("c", Shape::CUBE)],
            ..part("front", Shape::Union)
        };
        let material = Some(MaterialChoice::Named("none".to_owned()));
        let whole = Body {
            name: "lens".to_owned(),
            shape: Shape::Difference,
            parts: vec![inner, BodyPart { material, ..part("", Shape::Group) }],
            ..Body::default()
        };
        let simple = Body { parts: vec![part("", Shape::CUBE)], ..Body::default() };
        let mut deep = part("", Shape::CUBE);
        for _ in 0..Shape::MAX_DEPTH {
            deep = BodyPart { parts: vec![deep], ..part("", Shape::Group) };
        }
        let deep = Body { shape: Shape::Group, parts: vec![deep], ..Body::default() };
        let many = Body {
            shape: Shape::Union,
            parts: vec![part("", Shape::CUBE); Shape::MAX_PARTS + 1],
            ..Body::default()
        };
        let group = Body { shape: Shape::Group, ..many.clone() };
        let scene = Scene { bodies: [whole, simple, deep, many, group].into(), ..Scene::default() };
        let messages: Vec<String> = scene.check().iter().map(Problem::to_string).collect();
        let seven = ["parts.0"; Shape::MAX_DEPTH].join(".");
        let expected = [
            "body `lens`, `parts.front.parts.0`: `radius` is -1, but must be greater than 0".to_owned(),
            "body `lens`, `parts.front.parts.\"a b\"`: `radius` is -1, but must be greater than 0".to_owned(),
            "body `lens`, `parts.front`: two parts have the name `c`".to_owned(),
            "body `lens`, `parts.1`: a group needs at least one part".to_owned(),
            "body 2: a sphere has no parts".to_owned(),
            format!("body 3, `{seven}`: parts are nested too deep"),
            "body 4: this union has 65 simple parts, but can have at most 64".to_owned(),
            "body `lens`: the material `none` is not defined".to_owned(),
        ];
        assert_eq!(messages, expected);
    }
}
