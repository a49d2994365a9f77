//! Builds the document's types from tables. Everything absent or wrong keeps its default.

use std::collections::HashMap;

use glam::DVec3;

use crate::body::{Body, Shadow};
use crate::camera::{Camera, Projection};
use crate::compound::{BodyPart, BodyShape, Instance};
use crate::contact::{BodyContact, Contact};
use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::keys;
use crate::format::material;
use crate::format::message::{KeyMeaning, Message};
use crate::format::quote::quoted;
use crate::format::rules::{self, BrokenRule};
use crate::format::spec::{Kind, TableSpec};
use crate::format::toml::{Span, Value, ValueKind};
use crate::format::tree::Table;
use crate::format::typed::Fields;
use crate::light::{Falloff, Light};
use crate::material::{Material, MaterialChoice, SolidKind, SolidTexture};
use crate::placement::{Anchor, Placement};
use crate::shape::ShapeKind;
use crate::{Environment, Sky, Surroundings, Tracing};

/// Builds the document from tables.
pub(crate) struct SceneBuilder<'a, 't> {
    pub(crate) text: &'t str,
    pub(crate) found: &'a mut Diagnostics,
}

/// A body as far as it could be understood.
pub(crate) struct BuiltBody {
    pub(crate) body: Body,
    /// Whether its shape and parts are known; the scene cannot hold it otherwise.
    pub(crate) is_known: bool,
    /// Place of its name, when it has one.
    pub(crate) name_span: Option<Span>,
    /// Place of the name of its material, when it has one.
    pub(crate) material_span: Option<Span>,
    pub(crate) parts: PartPositions,
}

/// A part of a body as far as it could be understood.
struct BuiltPart {
    part: BodyPart,
    is_known: bool,
    material_span: Option<Span>,
}

/// The places of parts in the file.
#[derive(Default)]
pub(crate) struct PartPositions {
    /// The names of their materials.
    pub(crate) materials: Vec<(String, Span)>,
    /// The names of what they, or the body itself, are instances of.
    pub(crate) instances: Vec<(String, Span)>,
    /// Intersections that hold nothing.
    pub(crate) empty: Vec<(&'static str, Span)>,
}

impl<'t> SceneBuilder<'_, 't> {
    fn fields<'b>(&mut self, spec: &'static TableSpec, table: &'b Table<'t>) -> Fields<'_, 'b, 't> {
        let mut fields = Fields { text: self.text, spec, table, found: self.found };
        fields.check_choices();
        fields
    }

    /// The table `name` of the file.
    pub(crate) fn root<'b>(&mut self, root: &'b Table<'t>, name: &str) -> Option<&'b Table<'t>> {
        self.fields(&keys::ROOT, root).child(name)
    }

    pub(crate) fn camera(&mut self, table: &Table<'t>) -> Camera {
        let mut fields = self.fields(&keys::CAMERA, table);
        let default = Camera::default();
        let position = fields.vector("position");
        let target = fields.vector("target");
        let up = fields.vector("up");
        let is_known = |name, value: Option<DVec3>| value.is_some() || !table_has(table, name);
        let all_known = is_known("position", position) && is_known("target", target) && is_known("up", up);
        let projection = match fields.choice("projection") {
            Ok(Some("parallel")) => Projection::Parallel { height: fields.number("height").unwrap_or(5.0) },
            Ok(_) => Projection::Perspective { fov_degrees: fields.number("fov").unwrap_or(27.0) },
            Err(()) => {
                fields.check_dependent("projection", &[]);
                default.projection
            }
        };
        let mut camera = Camera {
            position: position.unwrap_or(default.position),
            target: target.unwrap_or(default.target),
            up: up.unwrap_or(default.up),
            projection,
        };
        if let Some(broken) = rules::camera(camera.position, camera.target, camera.up) {
            if all_known {
                report(&mut fields, broken, &["target", "position", "up"]);
            }
            camera = Camera { projection, ..default };
        }
        camera
    }

    pub(crate) fn environment(&mut self, table: &Table<'t>) -> Environment {
        let mut fields = self.fields(&keys::ENVIRONMENT, table);
        check_company(&mut fields, &Message::EitherOr);
        let default = Environment::default();
        let mut environment = Environment {
            background: fields.color("background").unwrap_or(default.background),
            ambient: fields.color("ambient").unwrap_or(default.ambient),
            surroundings: fields.image("picture", "layer").map_or(Surroundings::Even, Surroundings::Picture),
            rotation_degrees: fields.number("rotation").unwrap_or(default.rotation_degrees),
            strength: fields.number("strength").unwrap_or(default.strength),
            contact: fields.word("contact", Contact::of_key).unwrap_or_default(),
        };
        if let Some(sky) = fields.child("sky") {
            environment.surroundings = Surroundings::Sky(self.sky(sky));
        }
        environment
    }

    fn sky(&mut self, table: &Table<'t>) -> Sky {
        let mut fields = self.fields(&keys::SKY, table);
        let default = Sky::default();
        Sky {
            zenith: fields.color("zenith").unwrap_or(default.zenith),
            horizon: fields.color("horizon").unwrap_or(default.horizon),
            nadir: fields.color("nadir").unwrap_or(default.nadir),
        }
    }

    pub(crate) fn tracing(&mut self, table: &Table<'t>) -> Tracing {
        let mut fields = self.fields(&keys::TRACING, table);
        let default = Tracing::default();
        Tracing {
            generations: fields.number("generations").map_or(default.generations, |number| number as u32),
            threshold: fields.number("threshold").unwrap_or(default.threshold),
        }
    }

    pub(crate) fn material(&mut self, table: &Table<'t>) -> Material {
        let mut fields = self.fields(&keys::MATERIAL, table);
        check_company(&mut fields, &Message::EitherOr);
        let mut material = material::read(&mut fields);
        let solid = self.solid(&keys::MATERIAL, table);
        if let Some(pattern) = material.pattern_mut() {
            pattern.solid = solid;
        }
        material
    }

    /// The pattern in a table that may have one. How deep they lie is known to be bounded.
    fn solid(&mut self, spec: &'static TableSpec, table: &Table<'t>) -> Option<SolidTexture> {
        let mut found = None;
        for kind in SolidKind::ALL {
            let mut fields = Fields { text: self.text, spec, table, found: self.found };
            let Some(table) = fields.child(kind.key()) else { continue };
            let mut solid = material::read_solid(kind, &mut self.fields(&keys::PATTERN, table));
            solid.first = self.nested_solid(table, "first");
            solid.second = self.nested_solid(table, "second");
            found = Some(solid);
        }
        found
    }

    fn nested_solid(&mut self, table: &Table<'t>, key: &str) -> Option<Box<SolidTexture>> {
        let mut fields = Fields { text: self.text, spec: &keys::PATTERN, table, found: self.found };
        let inner = fields.child(key)?;
        check_company(&mut self.fields(&keys::NESTED_PATTERN, inner), &Message::EitherOr);
        self.solid(&keys::NESTED_PATTERN, inner).map(Box::new)
    }

    /// A light, and the place of its name.
    pub(crate) fn light(&mut self, table: &Table<'t>) -> (Light, Option<Span>) {
        let mut fields = self.fields(&keys::LIGHT, table);
        let default = Light::default();
        let falloff = match fields.choice("falloff") {
            Ok(Some("linear")) => {
                Falloff::Linear { constant: fields.number("falloff_constant").unwrap_or(1.0) }
            }
            Ok(Some("inverse-square")) => Falloff::InverseSquare,
            Ok(_) => Falloff::None,
            Err(()) => {
                fields.check_dependent("falloff", &[]);
                default.falloff
            }
        };
        let light = Light {
            name: fields.text("name").unwrap_or_default(),
            position: fields.vector("position").unwrap_or(default.position),
            color: fields.color("color").unwrap_or(default.color),
            intensity: fields.number("intensity").unwrap_or(default.intensity),
            falloff,
            radius: fields.number("radius").unwrap_or(default.radius),
            hidden: fields.flag("hidden").unwrap_or_default(),
            locked: fields.flag("locked").unwrap_or_default(),
        };
        (light, table.get("name").map(|value| value.span))
    }

    /// A body; a sphere when its shape is not known.
    pub(crate) fn body(&mut self, table: &Table<'t>) -> BuiltBody {
        let mut parts = PartPositions::default();
        let built = self.part_of(&keys::BODY, table, &mut parts);
        let mut fields = Fields { text: self.text, spec: &keys::BODY, table, found: self.found };
        let shadow = fields.word("shadow", Shadow::of_key).unwrap_or_default();
        let contact = fields.word("contact", BodyContact::of_key).unwrap_or_default();
        let [hidden, locked] = ["hidden", "locked"].map(|key| fields.flag(key).unwrap_or_default());
        let BodyPart { name, shape, placement, material, parts: own, parametric, instance } = built.part;
        let body = Body {
            name,
            shape,
            placement,
            material: material.unwrap_or_default(),
            hidden,
            shadow,
            contact,
            locked,
            parts: own,
            parametric,
            instance,
        };
        let name_span = table.get("name").map(|value| value.span);
        BuiltBody { body, is_known: built.is_known, name_span, material_span: built.material_span, parts }
    }

    /// What a body and a part of a body have in common.
    fn part_of(
        &mut self,
        spec: &'static TableSpec,
        table: &Table<'t>,
        places: &mut PartPositions,
    ) -> BuiltPart {
        let mut fields = self.fields(spec, table);
        let name = fields.text("name").unwrap_or_default();
        let instance_of = fields.text("instance_of");
        let shape = shape(&mut fields);
        let anchor = anchor(&mut fields, shape);
        let scale = fields.number_or_vector("scale").unwrap_or(DVec3::ONE);
        let (material, material_span) = self.material_choice(spec, table);
        let (parts, are_known) = self.parts(spec, table, places);
        let is_known = shape.is_ok();
        let mut shape = shape.unwrap_or_default();
        if let Anchor::Axis { base, top } = anchor {
            shape.set_number("height", base.distance(top));
        }
        let (shape, parts, parametric) = shape.into_form(parts);
        let placement = Placement { anchor, scale };
        let has_own_material = material.is_some();
        let instance = instance_of.map(|of| Instance::new(of, has_own_material));
        if let (Some(instance), Some(value)) = (&instance, table.get("instance_of")) {
            places.instances.push((instance.of.clone(), value.span));
        }
        let part = BodyPart { name, shape, placement, material, parts, parametric, instance };
        let broken = rules::parts(&part.form());
        let is_known = is_known && broken.is_none();
        if are_known {
            let mut fields = Fields { text: self.text, spec, table, found: self.found };
            if let Some(broken) = broken {
                report(&mut fields, broken, &["shape"]);
            } else if let Some(value) = table.get("shape")
                && part.parts.iter().all(|part| part.instance.is_none())
                && rules::is_empty(&part.form())
            {
                places.empty.push((part.shape.key(), value.span));
            }
        }
        BuiltPart { part, is_known, material_span }
    }

    /// The parts of a body or part, without those of an unknown shape, and whether these are all.
    fn parts(
        &mut self,
        spec: &'static TableSpec,
        table: &Table<'t>,
        places: &mut PartPositions,
    ) -> (Vec<BodyPart>, bool) {
        let Some(value) = table.get("parts") else { return (Vec::new(), true) };
        let ValueKind::Tables(tables) = &value.kind else {
            let mut fields = Fields { text: self.text, spec, table, found: self.found };
            if let Some(key) = spec.key("parts").filter(|_| !matches!(value.kind, ValueKind::Invalid)) {
                let _: Option<()> = fields.wrong_type(key, value);
            }
            return (Vec::new(), false);
        };
        let mut first_at: HashMap<&str, Span> = HashMap::new();
        let mut parts = Vec::with_capacity(tables.len());
        for table in tables {
            let BuiltPart { mut part, is_known, material_span } = self.part_of(&keys::PART, table, places);
            if let (Some(MaterialChoice::Named(name)), Some(span)) = (&part.material, material_span) {
                places.materials.push((name.clone(), span));
            }
            if let Some(Value { span, kind: ValueKind::Text(name) }) = table.get("name")
                && !name.is_empty()
            {
                let first = *first_at.entry(name).or_insert(*span);
                if first != *span {
                    part.name.clear();
                    self.found.push_with(|| named_twice(name, first, *span));
                }
            }
            if is_known {
                parts.push(part);
            }
        }
        let are_all = parts.len() == tables.len();
        (parts, are_all)
    }

    fn material_choice(
        &mut self,
        spec: &'static TableSpec,
        table: &Table<'t>,
    ) -> (Option<MaterialChoice>, Option<Span>) {
        match table.get("material") {
            Some(Value { span, kind: ValueKind::Text(name) }) => {
                (Some(MaterialChoice::Named(name.as_ref().to_owned())), Some(*span))
            }
            Some(Value { kind: ValueKind::Table(material), .. }) => {
                (Some(MaterialChoice::Inline(Box::new(self.material(material)))), None)
            }
            None | Some(Value { kind: ValueKind::Invalid, .. }) => (None, None),
            Some(value) => {
                let mut fields = Fields { text: self.text, spec, table, found: self.found };
                if let Some((_, key)) = spec.find("material") {
                    let _: Option<()> = fields.wrong_type(key, value);
                }
                (None, None)
            }
        }
    }
}

/// A name that another part of the same whole has.
fn named_twice(name: &str, first: Span, second: Span) -> Diagnostic {
    Diagnostic::error(second.range(), Message::PartNameTwice { name: quoted(name) })
        .with_label(Message::SecondOne)
        .with_help(Message::Rename)
        .with_related(first.range(), Message::FirstOne)
}

fn table_has(table: &Table<'_>, name: &str) -> bool {
    table.get(name).is_some()
}

/// The shape of a body; `Err` when it is not known which.
fn shape(fields: &mut Fields<'_, '_, '_>) -> Result<BodyShape, ()> {
    let is_on_axis = fields.has("base") || fields.has("top");
    let Ok(chosen) = fields.choice("shape") else {
        // `base` and `top` are checked with the place of the body, and leave nothing for `height` to say.
        let elsewhere = [&["base", "top"], keys::SAID_BY_AXIS].concat();
        let elsewhere = if is_on_axis { elsewhere.as_slice() } else { &[] };
        fields.check_dependent("shape", elsewhere);
        return Err(());
    };
    let kind = chosen.and_then(ShapeKind::of_key).unwrap_or_default();
    let mut shape = kind.body_shape();
    let sizes = fields.spec.keys.iter().filter(|key| key.belongs_to("shape", kind.key()));
    for key in sizes.filter(|key| !(is_on_axis && keys::SAID_BY_AXIS.contains(&key.name))) {
        match key.kind {
            Kind::Number(_) | Kind::Integer(_) => {
                if let Some(number) = fields.number(key.name) {
                    shape.set_number(key.name, number);
                }
            }
            Kind::NumberOrVector(_) => {
                if let Some(vector) = fields.number_or_vector(key.name) {
                    shape.set_vector(key.name, vector);
                }
            }
            Kind::Choice(_) => {
                if let Ok(Some(word)) = fields.choice(key.name) {
                    shape.set_word(key.name, word);
                }
            }
            // The ends of the axis belong to the place.
            Kind::Vector(_) if !["base", "top"].contains(&key.name) => {
                if let Some(vector) = fields.vector(key.name) {
                    shape.set_vector(key.name, vector);
                }
            }
            _ => {}
        }
    }
    match rules::sizes(&shape) {
        Some(broken) => {
            report(fields, broken, &["radius", "thickness", "a", "b", "shape"]);
            Ok(kind.body_shape())
        }
        None => Ok(shape),
    }
}

/// Where the body stands: by base and top where both are given and allowed, else by position and rotation.
fn anchor(fields: &mut Fields<'_, '_, '_>, shape: Result<BodyShape, ()>) -> Anchor {
    // A body of an unknown shape with a base is meant to be one of those that take it.
    let takes_axis = shape.is_ok_and(|shape| shape.axis_height().is_some()) || shape.is_err();
    if takes_axis && (fields.has("base") || fields.has("top")) {
        check_company(fields, &Message::AxisOrFrame);
        let (base, top) = (fields.vector("base"), fields.vector("top"));
        if let (Some(base), Some(top)) = (base, top) {
            match rules::axis(base, top) {
                Some(broken) => report(fields, broken, &["top"]),
                None => return Anchor::Axis { base, top },
            }
        }
        return Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::ZERO };
    }
    check_company(fields, &Message::EitherOr);
    Anchor::Frame {
        position: fields.vector("position").unwrap_or(DVec3::ZERO),
        rotation_degrees: fields.vector("rotation").unwrap_or(DVec3::ZERO),
    }
}

/// Reports keys that lack the key they need, or stand beside one that excludes them.
/// `help` is what to do about the latter.
fn check_company(fields: &mut Fields<'_, '_, '_>, help: &Message) {
    let mut reported: Vec<&str> = Vec::new();
    for key in fields.spec.keys {
        let Some(span) = fields.key_span(key.name).filter(|_| fields.has_meaning(key)) else { continue };
        if let Some(other) = key.requires.filter(|other| !fields.has(other)) {
            let finding = Diagnostic::error(span.clone(), Message::Needs { key: key.name, other })
                .with_label(Message::Missing { key: other });
            let meaning = fields.spec.key(other).map(|key| KeyMeaning { key, has_range: false });
            fields.found.push(match meaning {
                Some(meaning) => finding.with_help(Message::KeyMeans { meaning }),
                None => finding,
            });
        }
        for &other in key.excludes {
            let Some(other_span) = fields.key_span(other) else { continue };
            if reported.contains(&other) || reported.contains(&key.name) {
                continue;
            }
            reported.push(other);
            fields.found.push(
                Diagnostic::error(other_span, Message::CannotStandBeside { key: other, other: key.name })
                    .with_label(Message::SetAlready { key: key.name })
                    .with_help(help.clone())
                    .with_related(span.clone(), Message::StandsHere { key: key.name }),
            );
        }
    }
}

/// Reports a broken rule at its key, or at the first of `others` that is given.
fn report(fields: &mut Fields<'_, '_, '_>, broken: BrokenRule, others: &[&str]) {
    let span = fields
        .key_span(broken.key)
        .or_else(|| others.iter().find_map(|key| fields.key_span(key)))
        .unwrap_or_default();
    fields.found.push(Diagnostic::error(span, broken.message).with_help(broken.help));
}
