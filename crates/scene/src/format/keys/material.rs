//! The tables of materials and of their patterns.

use super::common::{LAYER, ROTATION, SCALE, amount, color, flag};
use crate::format::spec::{Default, KeySpec, Kind, Limits, TableSpec};
use crate::material::{
    Attenuation, DEFAULT_METAL, Dielectric, FresnelTerm, METAL_NAMES, Model, Pattern, PatternSpace, Phong,
    RefractiveIndex, SUBSTANCE_NAMES, SolidTexture,
};

/// `[materials.NAME]`, and the inline material of a body.
pub static MATERIAL: TableSpec = TableSpec {
    name: "a material",
    doc: "How a surface answers light",
    keys: &[
        KeySpec::new("model", Kind::Choice(Model::KEYS), "what the surface does with light")
            .or(Default::Text(Model::Phong.key())),
        KeySpec::new("color", Kind::Color(Limits::AMOUNT), "the color of the body")
            .or(color(Pattern::DEFAULT.color))
            .only("model", &["phong", "mirror", "matte", "coated"])
            .written(),
        amount("ambient", "the ambient coefficient")
            .or(Default::Number(Phong::DEFAULT.ambient))
            .only("model", &["phong", "matte", "coated"]),
        amount("diffuse", "the diffuse coefficient")
            .or(Default::Number(Phong::DEFAULT.diffuse))
            .only("model", PHONG),
        amount("specular", "the coefficient of the highlight")
            .or(Default::Number(Phong::DEFAULT.specular))
            .only("model", PHONG),
        amount("shininess", "the exponent of the highlight")
            .or(Default::Number(Phong::DEFAULT.shininess))
            .only("model", PHONG),
        amount(
            "reflection",
            "the coefficient of reflected light; when absent, the same as `specular`, or 1 for a mirror",
        )
        .only("model", &["phong", "mirror"]),
        amount("transmission", "the coefficient of transmitted light; 0 is opaque")
            .or(Default::Number(Phong::DEFAULT.transmission))
            .only("model", PHONG),
        KeySpec::new(
            "ior",
            Kind::Number(Limits::new(0.01, 100.0)),
            "the index of refraction relative to air",
        )
        .or(Default::Number(RefractiveIndex::DEFAULT_IOR))
        .only("model", &["phong", "dielectric", "coated", "thin-dielectric"]),
        KeySpec::new("tint", Kind::Color(Limits::AMOUNT), "the tint of transmitted light")
            .or(color(Phong::DEFAULT.tint))
            .only("model", &["phong", "thin-dielectric"]),
        KeySpec::new(
            "fresnel",
            Kind::Choice(FresnelTerm::KEYS),
            "how reflection and transmission of a clear body depend on the angle: not at all (`constant`), or by Schlick's \
             formula (`schlick`)",
        )
        .or(Default::Text(FresnelTerm::Constant.key()))
        .only("model", PHONG),
        KeySpec::new("substance", Kind::Choice(&SUBSTANCE_NAMES), "what a clear body is made of")
            .only("model", DIELECTRIC)
            .excluding(&["ior", "abbe"]),
        flag("dispersion", "whether the body bends light of different colors differently")
            .only("model", DIELECTRIC),
        KeySpec::new("abbe", Kind::Number(Limits::new(1.0, 1e6)), "the Abbe number, how little it does so")
            .or(Default::Number(RefractiveIndex::DEFAULT_ABBE))
            .only("model", DIELECTRIC),
        KeySpec::new(
            "attenuation_color",
            Kind::Color(Limits::new(0.0, 1.0)),
            "the color that white light has after `attenuation_distance` in the body",
        )
        .or(color(Attenuation::DEFAULT.color))
        .only("model", DIELECTRIC),
        KeySpec::new(
            "attenuation_distance",
            Kind::Number(Limits::LENGTH),
            "the way after which light has `attenuation_color`, meters",
        )
        .or(Default::Number(Attenuation::DEFAULT.distance))
        .only("model", DIELECTRIC),
        KeySpec::new("metal", Kind::Choice(&METAL_NAMES), "a measured metal")
            .or(Default::Text(DEFAULT_METAL.name))
            .only("model", CONDUCTOR)
            .written(),
        KeySpec::new(
            "n",
            Kind::Vector(Limits::new(0.001, 100.0)),
            "the refractive index for red, green and blue light",
        )
        .only("model", CONDUCTOR)
        .beside("k", &["metal"]),
        KeySpec::new(
            "k",
            Kind::Vector(Limits::new(0.0, 100.0)),
            "the extinction coefficient for red, green and blue light",
        )
        .only("model", CONDUCTOR)
        .beside("n", &["metal"]),
        KeySpec::new(
            "roughness",
            Kind::Number(Limits::new(0.0, 1.0)),
            "how rough the surface is that reflects, 0 being smooth",
        )
        .or(Default::Number(Dielectric::DEFAULT.roughness))
        .only("model", &["dielectric", "conductor", "mirror", "coated"]),
        KeySpec::new("texture", Kind::File, "a picture on the body in the place of its color")
            .only("model", &["phong", "mirror", "matte", "coated"]),
        KeySpec::new("layer", Kind::Text, LAYER)
            .only("model", &["phong", "mirror", "matte", "coated"])
            .beside("texture", &[]),
        checker(&PATTERN).only("model", &["phong", "mirror", "matte", "coated"]),
        stripes(&PATTERN).only("model", &["phong", "mirror", "matte", "coated"]),
        rings(&PATTERN).only("model", &["phong", "mirror", "matte", "coated"]),
        gradient(&PATTERN).only("model", &["phong", "mirror", "matte", "coated"]),
    ],
};

const PHONG: &[&str] = &["phong"];
const DIELECTRIC: &[&str] = &["dielectric"];
const CONDUCTOR: &[&str] = &["conductor"];

/// A table has itself within only by a reference that it is given.
const fn checker(table: &'static TableSpec) -> KeySpec {
    KeySpec::new("checker", Kind::Table(table), "a second color in a checkerboard")
        .excluding(&["stripes", "rings", "gradient"])
}

const fn stripes(table: &'static TableSpec) -> KeySpec {
    KeySpec::new("stripes", Kind::Table(table), "a second color in every other layer along the X axis")
        .excluding(&["checker", "rings", "gradient"])
}

const fn rings(table: &'static TableSpec) -> KeySpec {
    KeySpec::new("rings", Kind::Table(table), "a second color in every other ring about the Y axis")
        .excluding(&["checker", "stripes", "gradient"])
}

const fn gradient(table: &'static TableSpec) -> KeySpec {
    let doc = "a second color to which the first one changes along the X axis, again and again";
    KeySpec::new("gradient", Kind::Table(table), doc).excluding(&["checker", "stripes", "rings"])
}

/// `checker`, `stripes`, `rings` or `gradient` of a material.
pub static PATTERN: TableSpec = TableSpec {
    name: "a pattern",
    doc: "A pattern of two colors",
    keys: &[
        KeySpec::new("color", Kind::Color(Limits::AMOUNT), "the second color, of odd cells")
            .or(color(SolidTexture::DEFAULT.color))
            .written(),
        KeySpec::new("size", Kind::Number(Limits::LENGTH), "the width of a cell, meters")
            .or(Default::Number(SolidTexture::DEFAULT.size))
            .written(),
        KeySpec::new(
            "space",
            Kind::Choice(PatternSpace::KEYS),
            "what the cells are at rest in; those of a body move and turn with it",
        )
        .or(Default::Text(SolidTexture::DEFAULT.space.key())),
        KeySpec::new("position", Kind::Vector(Limits::PLACE), "where the pattern begins, meters")
            .or(Default::Vector([0.0; 3])),
        ROTATION,
        SCALE,
        KeySpec::new("first", Kind::Table(&NESTED_PATTERN), "a pattern in the place of the first color"),
        KeySpec::new("second", Kind::Table(&NESTED_PATTERN), "a pattern in the place of the second color"),
    ],
};

/// `first` or `second` of a pattern.
pub static NESTED_PATTERN: TableSpec = TableSpec {
    name: "a pattern within another",
    doc: "A pattern in the place of a color of another",
    keys: &[checker(&PATTERN), stripes(&PATTERN), rings(&PATTERN), gradient(&PATTERN)],
};
