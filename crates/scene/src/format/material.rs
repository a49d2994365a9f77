//! The keys of materials and the fields that they stand for: for each model how it is read and how it is written.

use catoptric_optics::{ClearSubstance, Metal};

use crate::format::keys;
use crate::format::record::{Datum, Record, picture};
use crate::format::typed::Fields;
use crate::material::{
    Attenuation, Coated, Conductor, Dielectric, FresnelTerm, Material, Matte, MetalOptics, Mirror, Model,
    Pattern, PatternSpace, Phong, RefractiveIndex, SolidKind, SolidTexture, ThinDielectric,
};

/// Reads a material but for its pattern, which is a table of its own.
pub(crate) fn read(fields: &mut Fields<'_, '_, '_>) -> Material {
    let model = fields.word("model", Model::of_key).unwrap_or_default();
    let material = match model {
        Model::Phong => read_phong(fields).into(),
        Model::Dielectric => read_dielectric(fields).into(),
        Model::Conductor => read_conductor(fields).into(),
        Model::Mirror => read_mirror(fields).into(),
        Model::Matte => read_matte(fields).into(),
        Model::Coated => read_coated(fields).into(),
        Model::ThinDielectric => read_thin_dielectric(fields).into(),
    };
    fields.check_inapplicable("model", model.key());
    material
}

/// The keys of a material with their values.
pub(crate) fn record(material: &Material) -> Record<'_> {
    let record = Record::new(&keys::MATERIAL).text("model", material.model().key());
    match material {
        Material::Phong(phong) => record_phong(record, phong),
        Material::Dielectric(dielectric) => record_dielectric(record, dielectric),
        Material::Conductor(conductor) => record_conductor(record, conductor),
        Material::Mirror(mirror) => record_mirror(record, mirror),
        Material::Matte(matte) => record_matte(record, matte),
        Material::Coated(coated) => record_coated(record, coated),
        Material::ThinDielectric(sheet) => record_thin_dielectric(record, sheet),
    }
}

fn read_phong(fields: &mut Fields<'_, '_, '_>) -> Phong {
    let default = Phong::DEFAULT;
    Phong {
        pattern: read_pattern(fields),
        ambient: fields.number("ambient").unwrap_or(default.ambient),
        diffuse: fields.number("diffuse").unwrap_or(default.diffuse),
        specular: fields.number("specular").unwrap_or(default.specular),
        shininess: fields.number("shininess").unwrap_or(default.shininess),
        reflection: fields.number("reflection"),
        transmission: fields.number("transmission").unwrap_or(default.transmission),
        ior: fields.number("ior").unwrap_or(default.ior),
        tint: fields.color("tint").unwrap_or(default.tint),
        fresnel: fields.word("fresnel", FresnelTerm::of_key).unwrap_or_default(),
    }
}

fn record_phong<'a>(record: Record<'a>, phong: &'a Phong) -> Record<'a> {
    let Phong {
        pattern,
        ambient,
        diffuse,
        specular,
        shininess,
        reflection,
        transmission,
        ior,
        tint,
        fresnel,
    } = phong;
    let record = record
        .color("color", pattern.color)
        .number("ambient", *ambient)
        .number("diffuse", *diffuse)
        .number("specular", *specular)
        .number("shininess", *shininess)
        .optional_number("reflection", *reflection)
        .number("transmission", *transmission)
        .number("ior", *ior)
        .color("tint", *tint)
        .text("fresnel", fresnel.key());
    record_details(record, pattern)
}

fn read_dielectric(fields: &mut Fields<'_, '_, '_>) -> Dielectric {
    let default = Dielectric::DEFAULT;
    let ior = fields.number("ior").unwrap_or(RefractiveIndex::DEFAULT_IOR);
    let abbe = fields.number("abbe").unwrap_or(RefractiveIndex::DEFAULT_ABBE);
    let substance = fields.word("substance", ClearSubstance::named);
    Dielectric {
        index: substance.map_or(RefractiveIndex::Own { ior, abbe }, RefractiveIndex::Substance),
        dispersion: fields.flag("dispersion").unwrap_or(default.dispersion),
        attenuation: Attenuation {
            color: fields.color("attenuation_color").unwrap_or(default.attenuation.color),
            distance: fields.number("attenuation_distance").unwrap_or(default.attenuation.distance),
        },
        roughness: fields.number("roughness").unwrap_or(default.roughness),
    }
}

fn record_dielectric<'a>(record: Record<'a>, dielectric: &Dielectric) -> Record<'a> {
    let Dielectric { index, dispersion, attenuation: Attenuation { color, distance }, roughness } =
        *dielectric;
    let record = match index {
        RefractiveIndex::Own { ior, abbe } => {
            record.number("ior", ior).flag("dispersion", dispersion).number("abbe", abbe)
        }
        RefractiveIndex::Substance(substance) => {
            record.text("substance", substance.name).flag("dispersion", dispersion)
        }
    };
    record
        .color("attenuation_color", color)
        .number("attenuation_distance", distance)
        .number("roughness", roughness)
}

fn read_conductor(fields: &mut Fields<'_, '_, '_>) -> Conductor {
    let default = Conductor::default();
    Conductor {
        metal: read_metal(fields).unwrap_or(default.metal),
        roughness: fields.number("roughness").unwrap_or(default.roughness),
    }
}

/// What a conductor is, if it is said.
fn read_metal(fields: &mut Fields<'_, '_, '_>) -> Option<MetalOptics> {
    match fields.choice("metal") {
        Ok(Some(name)) => Metal::named(name).map(MetalOptics::Metal),
        _ => Some(MetalOptics::Index { n: fields.vector("n")?, k: fields.vector("k")? }),
    }
}

fn record_conductor<'a>(record: Record<'a>, conductor: &Conductor) -> Record<'a> {
    let Conductor { metal, roughness } = *conductor;
    let record = match metal {
        MetalOptics::Metal(metal) => record.text("metal", metal.name),
        MetalOptics::Index { n, k } => record.vector("n", n).vector("k", k),
    };
    record.number("roughness", roughness)
}

fn read_mirror(fields: &mut Fields<'_, '_, '_>) -> Mirror {
    Mirror {
        pattern: read_pattern(fields),
        reflection: fields.number("reflection"),
        roughness: fields.number("roughness").unwrap_or(Mirror::DEFAULT.roughness),
    }
}

fn record_mirror<'a>(record: Record<'a>, mirror: &'a Mirror) -> Record<'a> {
    let Mirror { pattern, reflection, roughness } = mirror;
    let record = record
        .color("color", pattern.color)
        .optional_number("reflection", *reflection)
        .number("roughness", *roughness);
    record_details(record, pattern)
}

fn read_matte(fields: &mut Fields<'_, '_, '_>) -> Matte {
    Matte {
        pattern: read_pattern(fields),
        ambient: fields.number("ambient").unwrap_or(Matte::DEFAULT.ambient),
    }
}

fn record_matte<'a>(record: Record<'a>, matte: &'a Matte) -> Record<'a> {
    let Matte { pattern, ambient } = matte;
    record_details(record.color("color", pattern.color).number("ambient", *ambient), pattern)
}

fn read_thin_dielectric(fields: &mut Fields<'_, '_, '_>) -> ThinDielectric {
    let default = ThinDielectric::DEFAULT;
    ThinDielectric {
        ior: fields.number("ior").unwrap_or(default.ior),
        tint: fields.color("tint").unwrap_or(default.tint),
    }
}

fn record_thin_dielectric<'a>(record: Record<'a>, sheet: &ThinDielectric) -> Record<'a> {
    let ThinDielectric { ior, tint } = *sheet;
    record.number("ior", ior).color("tint", tint)
}

fn read_coated(fields: &mut Fields<'_, '_, '_>) -> Coated {
    let default = Coated::DEFAULT;
    Coated {
        pattern: read_pattern(fields),
        ambient: fields.number("ambient").unwrap_or(default.ambient),
        ior: fields.number("ior").unwrap_or(default.ior),
        roughness: fields.number("roughness").unwrap_or(default.roughness),
    }
}

fn record_coated<'a>(record: Record<'a>, coated: &'a Coated) -> Record<'a> {
    let Coated { pattern, ambient, ior, roughness } = coated;
    let record = record
        .color("color", pattern.color)
        .number("ambient", *ambient)
        .number("ior", *ior)
        .number("roughness", *roughness);
    record_details(record, pattern)
}

fn read_pattern(fields: &mut Fields<'_, '_, '_>) -> Pattern {
    Pattern {
        color: fields.color("color").unwrap_or(Pattern::DEFAULT.color),
        texture: fields.image("texture", "layer"),
        solid: None,
    }
}

/// What a pattern has besides its color.
fn record_details<'a>(mut record: Record<'a>, pattern: &'a Pattern) -> Record<'a> {
    let Pattern { color: _, texture, solid } = pattern;
    if let Some(texture) = texture {
        record = picture(record, "texture", texture);
    }
    with_solid(record, solid.as_ref())
}

/// A pattern under the key of its kind.
fn with_solid<'a>(record: Record<'a>, solid: Option<&'a SolidTexture>) -> Record<'a> {
    match solid {
        Some(solid) => record.with(solid.kind.key(), Datum::Table(record_solid(solid))),
        None => record,
    }
}

/// Reads a pattern but for those within it, which are tables of their own.
pub(crate) fn read_solid(kind: SolidKind, fields: &mut Fields<'_, '_, '_>) -> SolidTexture {
    let default = SolidTexture::DEFAULT;
    SolidTexture {
        kind,
        color: fields.color("color").unwrap_or(default.color),
        size: fields.number("size").unwrap_or(default.size),
        space: fields.word("space", PatternSpace::of_key).unwrap_or(default.space),
        position: fields.vector("position").unwrap_or(default.position),
        rotation_degrees: fields.vector("rotation").unwrap_or(default.rotation_degrees),
        scale: fields.number_or_vector("scale").unwrap_or(default.scale),
        first: None,
        second: None,
    }
}

fn record_solid(solid: &SolidTexture) -> Record<'_> {
    let SolidTexture { kind: _, color, size, space, position, rotation_degrees, scale, first, second } =
        solid;
    let mut record = Record::new(&keys::PATTERN)
        .color("color", *color)
        .number("size", *size)
        .text("space", space.key())
        .vector("position", *position)
        .vector("rotation", *rotation_degrees)
        .number_or_vector("scale", *scale);
    for (key, inner) in [("first", first), ("second", second)] {
        if inner.is_some() {
            let inner = with_solid(Record::new(&keys::NESTED_PATTERN), inner.as_deref());
            record = record.with(key, Datum::Table(inner));
        }
    }
    record
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_and_the_types_have_the_same_models_and_defaults() {
        for model in Model::ALL {
            let material = Material::from(model);
            let record = record(&material);
            let chosen = |name: &str| (name == "model").then_some(model.key());
            for (name, datum) in &record.values {
                let key = keys::MATERIAL.key(name).unwrap();
                assert!(key.applies(chosen), "{name} for {model:?}");
                assert!(*name == "model" || record.is_default(key, datum), "{name} of {model:?}");
            }
            let color = keys::MATERIAL.key("color").unwrap();
            assert_eq!(color.applies(chosen), material.pattern().is_some());
        }
        assert!(record(&Material::default()).is_all_default());
        assert!(record_solid(&SolidTexture::default()).is_all_default());
    }
}
