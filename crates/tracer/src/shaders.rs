//! What a graphics card needs to trace as this crate does: the shaders and the scene as bytes.
//!
//! The shaders stand beside the Rust files whose twins they are, step for step and name for name (`query.wgsl` beside
//! `query.rs`); [`shader`] puts them together for what a scene contains. Constants that both need come from the Rust
//! side. Nothing here talks to a card.

pub(crate) mod bytes;
pub(crate) mod constants;
pub(crate) mod features;
pub(crate) mod joined;
pub(crate) mod materials;
pub(crate) mod pictures;
pub(crate) mod specialize;

use catoptric_scene::SolidKind;

use crate::geometry::body::{CEMENTABLE, CEMENTS, FILTERS, SHADOWLESS, TRANSPARENT};
use crate::geometry::bvh::{TINY as BOX_TINY, WIDEN as BOX_WIDEN};
use crate::geometry::query::closest::GRAZING;
use crate::geometry::ray::{INWARDS, NO_BODY, NO_START, POINT_ROUNDING};
use crate::geometry::shape::ShapeKind;
use crate::geometry::shape::slab::TINY as SLAB_TINY;
use crate::geometry::shape::solid::CAP_LEVEL;
use crate::geometry::sphere::BoundingSphere;
use crate::shaders::constants::{MOST_CROSSINGS, MOST_INTERVALS, MOST_RAYS, ShaderConstants};
use crate::simd::vector::MOST_LIGHT;
use crate::transport::surface::NARROW_HIGHLIGHT;
use crate::transport::texture::solid::SolidNode;
use crate::transport::tile_rect::TILE;

pub use crate::shaders::bytes::{CameraRaysBytes, FrameUniforms, SceneArrays, tile_rays};
pub use crate::shaders::constants::FRAME_PLACES;
pub use crate::shaders::features::PhysicalFeatures;
pub use crate::shaders::materials::WavelengthUniforms;
pub use crate::shaders::pictures::{AtlasTexel, PICTURES_ACROSS, PictureAtlas};
pub use crate::shaders::specialize::{
    EnvironmentKind, SceneContents, ShaderSpecialization, UnsupportedOnGpu,
};

/// Bytes before the first pixel of a film: the counts of rays and the words behind them.
pub const FILM_HEAD: u64 = 32;
/// Bytes to a pixel of a film: its light and the number of the body in it.
pub const FILM_PIXEL: u64 = 16;
/// Blocks of 8 × 8 pixels along the side of a tile.
const BLOCKS_ACROSS: u32 = (TILE / 8) as u32;
/// Blocks of 8 × 8 pixels to a tile, the first number of a dispatch.
pub const TILE_BLOCKS: u32 = BLOCKS_ACROSS * BLOCKS_ACROSS;
const _: () = assert!(TILE.is_multiple_of(8), "a tile is made of whole blocks");
/// The function to dispatch.
pub const ENTRY_POINT: &str = "add_samples";

/// The shaders of every scene, in the order of their Rust twins.
const ALWAYS: &[&str] = &[
    include_str!("simd/vector.wgsl"),
    include_str!("geometry/ray.wgsl"),
    include_str!("geometry/shape.wgsl"),
    include_str!("geometry/shape/sphere.wgsl"),
    include_str!("geometry/shape/slab.wgsl"),
    include_str!("geometry/shape/cube.wgsl"),
    include_str!("geometry/shape/cylinder.wgsl"),
    include_str!("geometry/shape/cone.wgsl"),
    include_str!("geometry/shape/paraboloid.wgsl"),
    include_str!("geometry/shape/plane.wgsl"),
    include_str!("geometry/body.wgsl"),
    include_str!("transport/light.wgsl"),
    include_str!("transport/texture/solid.wgsl"),
    include_str!("transport/camera.wgsl"),
    include_str!("transport/media.wgsl"),
    include_str!("geometry/query.wgsl"),
    include_str!("geometry/query/cemented.wgsl"),
    include_str!("transport/surface.wgsl"),
    include_str!("transport/shading.wgsl"),
    include_str!("transport/integrator/whitted.wgsl"),
    include_str!("transport/tile.wgsl"),
];

/// Those of scenes without physical materials.
const PLAIN: &[&str] = &[
    include_str!("transport/surface/material/plain.wgsl"),
    include_str!("transport/light/point.wgsl"),
    include_str!("transport/interaction/plain.wgsl"),
    include_str!("transport/integrator/whitted/plain.wgsl"),
];

/// Those of scenes with physical materials, or lights that are balls.
const PHYSICAL: &[&str] = &[
    include_str!("transport/surface/material/physical.wgsl"),
    include_str!("transport/surface/model/conductor.wgsl"),
    include_str!("transport/light/sphere.wgsl"),
    include_str!("transport/surface/microfacet.wgsl"),
    include_str!("transport/sampler.wgsl"),
    include_str!("transport/surface/bsdf.wgsl"),
    include_str!("transport/interaction.wgsl"),
    include_str!("transport/cemented.wgsl"),
    include_str!("transport/spectrum.wgsl"),
    include_str!("transport/integrator/whitted/scatter.wgsl"),
    include_str!("transport/integrator/whitted/physical.wgsl"),
];

/// The source of the shader for scenes of this kind, in WGSL.
pub fn shader(special: &ShaderSpecialization) -> String {
    let walk = match special.depth {
        0 => include_str!("geometry/sphere.wgsl"),
        _ => include_str!("geometry/bvh.wgsl"),
    };
    let mut source = constants(special).text();
    let is_plain = special.physical == PhysicalFeatures::NOTHING;
    if !is_plain {
        source.push_str(&materials::constants(special).text());
    }
    if special.sky == EnvironmentKind::Picture || special.textures {
        source.push_str(&picture_constants().text());
        source.push_str(include_str!("transport/texture/lookup.wgsl"));
    }
    source.push_str(match special.sky {
        EnvironmentKind::Even => include_str!("transport/environment/even.wgsl"),
        EnvironmentKind::Gradient => include_str!("transport/environment/gradient.wgsl"),
        EnvironmentKind::Picture => include_str!("transport/environment/picture.wgsl"),
    });
    source.push_str(match special.textures {
        false => include_str!("transport/texture/none.wgsl"),
        true => include_str!("transport/texture.wgsl"),
    });
    source.push_str(match special.any_solids {
        false => include_str!("transport/texture/solid/checkers.wgsl"),
        true => include_str!("transport/texture/solid/any.wgsl"),
    });
    source.push_str(match special.physical.has(PhysicalFeatures::ABSORBS) {
        true => include_str!("transport/media/absorption.wgsl"),
        false => include_str!("transport/media/absorption/none.wgsl"),
    });
    source.push_str(match special.physical.has(PhysicalFeatures::CEMENTED) {
        true => include_str!("transport/media/shadow_crossings.wgsl"),
        false => include_str!("transport/media/shadow_crossings/none.wgsl"),
    });
    source.push_str(walk);
    match special.parts {
        0 => source.push_str(include_str!("geometry/joined/none.wgsl")),
        parts => {
            source.push_str(&joined::constants(parts).text());
            source.push_str(include_str!("geometry/joined.wgsl"));
            source.push_str(include_str!("geometry/query/joined.wgsl"));
        }
    }
    ALWAYS.iter().chain(if is_plain { PLAIN } else { PHYSICAL }).for_each(|part| source.push_str(part));
    source
}

/// The constants of shaders for scenes with pictures.
fn picture_constants() -> ShaderConstants {
    ShaderConstants {
        words: vec![("PICTURES_ACROSS", PICTURES_ACROSS)],
        numbers: vec![("PI", std::f32::consts::PI), ("TEXTURE_LEVEL", CAP_LEVEL)],
        flags: Vec::new(),
    }
}

/// The constants of every shader.
fn constants(special: &ShaderSpecialization) -> ShaderConstants {
    let words = vec![
        ("NO_BODY", NO_BODY),
        ("NO_START", NO_START),
        ("INWARDS", INWARDS),
        ("TRANSPARENT", u32::from(TRANSPARENT)),
        ("SHADOWLESS", u32::from(SHADOWLESS)),
        ("FILTERS", u32::from(FILTERS)),
        ("CEMENTABLE", u32::from(CEMENTABLE)),
        ("CEMENTS", u32::from(CEMENTS)),
        ("SPHERE", ShapeKind::Sphere as u32),
        ("CUBE", ShapeKind::Cube as u32),
        ("CYLINDER", ShapeKind::Cylinder as u32),
        ("CONE", ShapeKind::Cone as u32),
        ("PARABOLOID", ShapeKind::Paraboloid as u32),
        ("PLANE", ShapeKind::Plane as u32),
        ("CHECKER", SolidKind::Checker as u32),
        ("RINGS", SolidKind::Rings as u32),
        ("GRADIENT", SolidKind::Gradient as u32),
        ("MOST_SOLIDS", SolidNode::MOST as u32),
        ("SIDE", crate::geometry::shape::SIDE as u32),
        ("LOWER_CAP", crate::geometry::shape::LOWER_CAP as u32),
        ("UPPER_CAP", crate::geometry::shape::UPPER_CAP as u32),
        ("FALLOFF_NONE", bytes::FALLOFF_NONE),
        ("FALLOFF_LINEAR", bytes::FALLOFF_LINEAR),
        ("TILE", TILE as u32),
        ("BLOCKS_ACROSS", BLOCKS_ACROSS),
        ("MOST_RAYS", MOST_RAYS),
        ("MOST_INTERVALS", MOST_INTERVALS),
        ("MOST_CROSSINGS", MOST_CROSSINGS),
        ("MOST_SAMPLES", FRAME_PLACES as u32),
        ("DEPTH", special.depth.max(1)),
        ("MEDIA", special.media.max(1) + u32::from(special.physical.has(PhysicalFeatures::DISPERSES))),
        ("STACK", special.stack.max(1)),
    ];
    let numbers = vec![
        ("POINT_ROUNDING", POINT_ROUNDING),
        ("GRAZING", GRAZING),
        ("SPHERE_ROUNDING", BoundingSphere::ROUNDING),
        ("SLAB_TINY", SLAB_TINY),
        ("BOX_TINY", BOX_TINY),
        ("BOX_WIDEN", BOX_WIDEN),
        ("SOLID_BORDER", SolidNode::BORDER),
        ("NARROW_HIGHLIGHT", NARROW_HIGHLIGHT),
        ("LEAST_NORMAL", f32::MIN_POSITIVE),
        ("MOST_LIGHT", MOST_LIGHT),
    ];
    let flags = vec![
        ("HAS_SPHERES", special.has(ShapeKind::Sphere)),
        ("HAS_CUBES", special.has(ShapeKind::Cube)),
        ("HAS_CYLINDERS", special.has(ShapeKind::Cylinder)),
        ("HAS_CONES", special.has(ShapeKind::Cone)),
        ("HAS_PARABOLOIDS", special.has(ShapeKind::Paraboloid)),
        ("HAS_PLANES", special.has(ShapeKind::Plane)),
        ("HAS_TRANSPARENCY", special.media > 0),
        ("HAS_SHADOWLESS", special.shadowless),
        ("HAS_SOLIDS", special.solids),
        ("HAS_MEMBERS", special.members),
        ("ASKS_EACH_START", special.asks_each_start),
        ("ABSORBS", special.physical.has(PhysicalFeatures::ABSORBS)),
        ("CEMENTED", special.physical.has(PhysicalFeatures::CEMENTED)),
    ];
    ShaderConstants { words, numbers, flags }
}
