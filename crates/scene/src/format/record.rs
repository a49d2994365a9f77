//! The document's types as keys and values: what the writer writes, the update compares and the validation checks.

use std::borrow::Cow;

use glam::DVec3;

use crate::body::Body;
use crate::camera::{Camera, Projection};
use crate::color::Color;
use crate::compound::{BodyPart, Form};
use crate::format::keys;
use crate::format::material;
use crate::format::spec::{Default, KeySpec, Kind, TableSpec, When};
use crate::image::Image;
use crate::light::{Falloff, Light};
use crate::material::MaterialChoice;
use crate::placement::Anchor;
use crate::{Environment, Sky, Surroundings, Tracing};

/// A value of the document.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Datum<'a> {
    Number(f64),
    Integer(u32),
    /// A vector or a color.
    Vector([f64; 3]),
    Text(Cow<'a, str>),
    Flag(bool),
    Table(Record<'a>),
    /// A list of tables.
    Tables(Vec<Record<'a>>),
}

/// The keys of one table that apply, with their values, in the order of writing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Record<'a> {
    pub(crate) table: TableRef,
    pub(crate) values: Vec<(&'static str, Datum<'a>)>,
}

/// A table of the format, equal only to itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TableRef(pub(crate) &'static TableSpec);

impl PartialEq for TableRef {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl<'a> Record<'a> {
    pub(crate) fn new(table: &'static TableSpec) -> Self {
        Self { table: TableRef(table), values: Vec::with_capacity(table.keys.len()) }
    }

    pub(crate) fn with(mut self, key: &'static str, datum: Datum<'a>) -> Self {
        self.values.push((key, datum));
        self
    }

    pub(crate) fn number(self, key: &'static str, value: f64) -> Self {
        self.with(key, Datum::Number(value))
    }

    /// A number that is absent where it has no value of its own.
    pub(crate) fn optional_number(self, key: &'static str, value: Option<f64>) -> Self {
        match value {
            Some(value) => self.number(key, value),
            None => self,
        }
    }

    pub(crate) fn vector(self, key: &'static str, value: DVec3) -> Self {
        self.with(key, Datum::Vector(value.to_array()))
    }

    pub(crate) fn color(self, key: &'static str, value: Color) -> Self {
        self.with(key, Datum::Vector(value.to_array()))
    }

    pub(crate) fn text(self, key: &'static str, value: &'a str) -> Self {
        self.with(key, Datum::Text(Cow::Borrowed(value)))
    }

    pub(crate) fn flag(self, key: &'static str, value: bool) -> Self {
        self.with(key, Datum::Flag(value))
    }

    /// A name is absent when it is empty.
    fn name(self, value: &'a str) -> Self {
        if value.is_empty() { self } else { self.text("name", value) }
    }

    /// Three factors or lengths; one number when they are equal.
    pub(crate) fn number_or_vector(self, key: &'static str, value: DVec3) -> Self {
        if value.x == value.y && value.y == value.z {
            self.number(key, value.x)
        } else {
            self.vector(key, value)
        }
    }

    /// The value of a key.
    pub(crate) fn get(&self, key: &str) -> Option<&Datum<'a>> {
        self.values.iter().find(|(name, _)| *name == key).map(|(_, datum)| datum)
    }

    /// Whether `datum` is what the absent `key` of this record stands for.
    pub(crate) fn is_default(&self, key: &KeySpec, datum: &Datum<'_>) -> bool {
        match (key.default, datum) {
            (Default::Number(default), Datum::Number(value)) => default == *value,
            (Default::Number(default), Datum::Integer(value)) => default == f64::from(*value),
            (Default::Vector(default), Datum::Vector(value)) => default == *value,
            (Default::Text(default), Datum::Text(value)) => default == value,
            (Default::Flag(default), Datum::Flag(value)) => default == *value,
            (Default::ByChoice(_), Datum::Number(value)) => {
                let When::Choice { choice, .. } = key.when else { return false };
                key.default_number(self.chosen(choice)) == Some(*value)
            }
            // Without a material an instance has that of the other body.
            (Default::EmptyTable, Datum::Table(record)) => {
                record.is_all_default() && self.get("instance_of").is_none()
            }
            _ => false,
        }
    }

    pub(crate) fn is_all_default(&self) -> bool {
        self.values
            .iter()
            .all(|(name, datum)| self.table.0.find(name).is_some_and(|(_, key)| self.is_default(key, datum)))
    }

    /// The word of a choice.
    pub(crate) fn chosen(&self, choice: &str) -> Option<&'static str> {
        let Kind::Choice(words) = self.table.0.key(choice)?.kind else { return None };
        let Datum::Text(chosen) = self.get(choice)? else { return None };
        words.iter().find(|word| *word == chosen).copied()
    }

    /// The key that stands here and excludes `key`.
    pub(crate) fn key_against(&self, key: &KeySpec) -> Option<&'static KeySpec> {
        let mut standing = self.written().filter_map(|(name, _)| self.table.0.key(name));
        standing.find(|other| other.excludes.contains(&key.name))
    }

    /// The keys that are written: those that always are, and those that are not at their default.
    pub(crate) fn written(&self) -> impl Iterator<Item = (&'static str, &Datum<'a>)> {
        self.values.iter().filter_map(|(name, datum)| {
            let (_, key) = self.table.0.find(name)?;
            (key.always_written || !self.is_default(key, datum)).then_some((*name, datum))
        })
    }
}

pub(crate) fn camera(camera: &Camera) -> Record<'static> {
    let record = Record::new(&keys::CAMERA)
        .vector("position", camera.position)
        .vector("target", camera.target)
        .vector("up", camera.up);
    match camera.projection {
        Projection::Perspective { fov_degrees } => {
            record.text("projection", "perspective").number("fov", fov_degrees)
        }
        Projection::Parallel { height } => record.text("projection", "parallel").number("height", height),
    }
}

pub(crate) fn environment(environment: &Environment) -> Record<'_> {
    let record = Record::new(&keys::ENVIRONMENT)
        .color("background", environment.background)
        .color("ambient", environment.ambient);
    let record = match &environment.surroundings {
        Surroundings::Even => record,
        Surroundings::Sky(Sky { zenith, horizon, nadir }) => {
            let sky = Record::new(&keys::SKY);
            let sky = sky.color("zenith", *zenith).color("horizon", *horizon).color("nadir", *nadir);
            record.with("sky", Datum::Table(sky))
        }
        Surroundings::Picture(image) => picture(record, "picture", image),
    };
    let record = record.number("rotation", environment.rotation_degrees);
    record.number("strength", environment.strength).text("contact", environment.contact.key())
}

/// The path of a picture, and its layer.
pub(crate) fn picture<'a>(record: Record<'a>, key: &'static str, image: &'a Image) -> Record<'a> {
    let record = record.text(key, image.path());
    match image.layer() {
        Some(layer) => record.text("layer", layer),
        None => record,
    }
}

pub(crate) fn tracing(tracing: &Tracing) -> Record<'static> {
    Record::new(&keys::TRACING)
        .with("generations", Datum::Integer(tracing.generations))
        .number("threshold", tracing.threshold)
}

pub(crate) fn light(light: &Light) -> Record<'_> {
    let record = Record::new(&keys::LIGHT)
        .name(&light.name)
        .vector("position", light.position)
        .color("color", light.color)
        .number("intensity", light.intensity)
        .text("falloff", light.falloff.key());
    let record = match light.falloff {
        Falloff::Linear { constant } => record.number("falloff_constant", constant),
        Falloff::None | Falloff::InverseSquare => record,
    };
    record.number("radius", light.radius).flag("hidden", light.hidden).flag("locked", light.locked)
}

pub(crate) fn body(body: &Body) -> Record<'_> {
    let mut record = geometry(Record::new(&keys::BODY).name(&body.name), &body.form());
    if body.instance.as_ref().is_none_or(|instance| instance.has_own_material) {
        record = material_choice(record, &body.material);
    }
    let record = record.flag("hidden", body.hidden).text("shadow", body.shadow.key());
    let record = record.text("contact", body.contact.key());
    with_parts(record.flag("locked", body.locked), &body.form())
}

pub(crate) fn part(part: &BodyPart) -> Record<'_> {
    let mut record = geometry(Record::new(&keys::PART).name(&part.name), &part.form());
    let takes_other = part.instance.as_ref().is_some_and(|instance| !instance.has_own_material);
    if let Some(material) = part.material.as_ref().filter(|_| !takes_other) {
        record = material_choice(record, material);
    }
    with_parts(record, &part.form())
}

/// Shape, sizes and place; of an instance, what it is one of and its place.
fn geometry<'a>(record: Record<'a>, form: &Form<'a>) -> Record<'a> {
    let record = match form.instance {
        Some(instance) => record.text("instance_of", &instance.of),
        None => sizes(record, form),
    };
    let record = match form.placement.anchor {
        Anchor::Frame { position, rotation_degrees } => {
            record.vector("position", position).vector("rotation", rotation_degrees)
        }
        Anchor::Axis { base, top } => record.vector("base", base).vector("top", top),
    };
    record.number_or_vector("scale", form.placement.scale)
}

fn sizes<'a>(record: Record<'a>, form: &Form<'_>) -> Record<'a> {
    let shape = form.body_shape();
    let mut record = record.with("shape", Datum::Text(Cow::Borrowed(shape.key())));
    let is_on_axis = matches!(form.placement.anchor, Anchor::Axis { .. });
    for key in
        record.table.0.keys.iter().filter(|key| !(is_on_axis && keys::SAID_BY_AXIS.contains(&key.name)))
    {
        if let Some(number) = shape.number(key.name) {
            record = match key.kind {
                Kind::Integer(_) => record.with(key.name, Datum::Integer(number as u32)),
                _ => record.number(key.name, number),
            };
        } else if let Some(vector) = shape.vector(key.name) {
            record = match key.kind {
                Kind::Vector(_) => record.vector(key.name, vector),
                _ => record.number_or_vector(key.name, vector),
            };
        } else if let Some(word) = shape.word(key.name) {
            record = record.text(key.name, word);
        }
    }
    record
}

fn material_choice<'a>(record: Record<'a>, choice: &'a MaterialChoice) -> Record<'a> {
    match choice {
        MaterialChoice::Named(name) => record.text("material", name),
        MaterialChoice::Inline(own) => record.with("material", Datum::Table(material::record(own))),
    }
}

/// The parts of a shape that is given them.
fn with_parts<'a>(record: Record<'a>, form: &Form<'a>) -> Record<'a> {
    match form.instance.is_none() && form.body_shape().kind().is_compound() {
        true => record.with("parts", Datum::Tables(form.parts.iter().map(part).collect())),
        false => record,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::ShapeKind;

    #[test]
    fn the_table_and_the_types_have_the_same_shapes() {
        let Kind::Choice(words) = keys::BODY.key("shape").unwrap().kind else { panic!() };
        assert_eq!(words, ShapeKind::ALL.map(ShapeKind::key));
    }

    #[test]
    fn the_table_tells_limits_and_defaults() {
        let radius = keys::BODY.key("radius").unwrap();
        assert_eq!(radius.limits().map(|limits| (limits.min, limits.max)), Some((1e-9, 1e9)));
        assert_eq!(
            (radius.default_number(Some("sphere")), radius.default_number(Some("cone"))),
            (Some(1.0), Some(0.5))
        );
        assert_eq!((radius.default_number(Some("cube")), radius.default_number(None)), (None, None));
        let size = keys::BODY.key("size").unwrap();
        assert_eq!((size.default_number(None), size.default_vector()), (Some(1.0), Some([1.0; 3])));
        let color = keys::MATERIAL.key("color").unwrap();
        assert_eq!((color.default_number(None), color.default_vector()), (None, Some([0.8; 3])));
        assert!(keys::BODY.key("nothing").is_none() && keys::BODY.key("name").unwrap().limits().is_none());
    }

    #[test]
    fn the_table_and_the_types_have_the_same_defaults() {
        assert!(camera(&Camera::default()).is_all_default());
        assert!(environment(&Environment::default()).is_all_default());
        let surroundings = Surroundings::Sky(Sky::default());
        let under_sky = Environment { surroundings, ..Environment::default() };
        let Some(Datum::Table(sky)) = environment(&under_sky).get("sky").cloned() else { panic!() };
        assert!(sky.is_all_default());
        assert!(tracing(&Tracing::default()).is_all_default());
        assert!(light(&Light::default()).is_all_default());
        for kind in ShapeKind::ALL {
            let body_of = Body::of_shape(kind.body_shape());
            let record = body(&body_of);
            for (name, datum) in &record.values {
                let (_, key) = keys::BODY.find(name).unwrap();
                let is_said = *name == "shape" || *name == "parts";
                assert!(is_said || record.is_default(key, datum), "{name} of {kind:?}");
            }
            // A shape has the sizes that have a default for it, and no others.
            let depends = |key: &&KeySpec| matches!(key.when, When::Choice { .. }) && key.name != "parts";
            for key in keys::BODY.keys.iter().filter(depends) {
                let is_given = key.default_number(Some(kind.key())).is_some()
                    || matches!(key.default, Default::Text(_) | Default::Vector(_));
                let has_default = key.belongs_to("shape", kind.key()) && is_given && key.requires.is_none();
                assert_eq!(record.get(key.name).is_some(), has_default, "{} of {kind:?}", key.name);
            }
        }
        assert!(body(&Body::default()).is_all_default());
        assert!(part(&BodyPart::default()).is_all_default());
        let parallel = Camera { projection: Projection::Parallel { height: 5.0 }, ..Camera::default() };
        assert!(camera(&parallel).is_default(keys::CAMERA.find("height").unwrap().1, &Datum::Number(5.0)));
        let linear = Light { falloff: Falloff::Linear { constant: 1.0 }, ..Light::default() };
        let key = keys::LIGHT.find("falloff_constant").unwrap().1;
        assert!(light(&linear).is_default(key, &Datum::Number(1.0)));
    }
}
