//! What a graphics card needs to trace as this crate does: the shaders and the stage as bytes.
//!
//! The shaders stand beside the Rust files whose twins they are, step for step and name for name (`search.wgsl` beside
//! `search.rs`); [`shader`] puts them together for what a stage contains. Constants that both need come from the Rust
//! side. Nothing here talks to a card.

mod bytes;
mod fit;
mod laws;
mod pictures;

use std::fmt::Write as _;

use crate::ray::{INWARDS, NO_BODY, NO_START, POINT_ROUNDING};
use crate::search::GRAZING;
use crate::shape::{SLAB_TINY, ShapeKind};
use crate::stage::{BOX_TINY, BOX_WIDEN, BoundingSphere, TEXTURE_LEVEL};
use crate::surface::MOST_LIGHT;
use crate::tile::TILE;

pub use bytes::{CameraRaysBytes, FRAME_PLACES, FrameUniforms, SceneArrays, tile_rays};
pub use fit::{EnvironmentKind, SceneContents, ShaderSpecialization, UnsupportedOnGpu};
pub use laws::{PhysicalFeatures, WavelengthUniforms};
pub use pictures::{AtlasTexel, PICTURES_ACROSS, PictureAtlas};

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

/// The most bodies that a list of media of the shaders has room for.
pub(crate) const MOST_MEDIA: usize = 16;

/// The most transparent bodies on the way to a light that the shaders have room for, where some of them absorb.
const MOST_INTERVALS: u32 = 24;

/// The most rays of one tree: what a thread of a slow card can trace before its driver takes it for hung.
pub(crate) const MOST_RAYS: u32 = 1 << 16;

/// The shaders of every stage, in the order of their Rust twins.
const ALWAYS: &[&str] = &[
    include_str!("vector.wgsl"),
    include_str!("ray.wgsl"),
    include_str!("shape.wgsl"),
    include_str!("shape/sphere.wgsl"),
    include_str!("shape/slab.wgsl"),
    include_str!("shape/cube.wgsl"),
    include_str!("shape/cylinder.wgsl"),
    include_str!("shape/cone.wgsl"),
    include_str!("shape/plane.wgsl"),
    include_str!("stage/body.wgsl"),
    include_str!("stage/light.wgsl"),
    include_str!("stage/checker.wgsl"),
    include_str!("stage/camera.wgsl"),
    include_str!("media.wgsl"),
    include_str!("search.wgsl"),
    include_str!("surface.wgsl"),
    include_str!("whitted.wgsl"),
    include_str!("tile.wgsl"),
];

/// Those of stages without physical materials.
const PLAIN: &[&str] = &[
    include_str!("stage/material/plain.wgsl"),
    include_str!("stage/light/point.wgsl"),
    include_str!("whitted/plain.wgsl"),
];

/// Those of stages with physical materials, or lights that are balls.
const PHYSICAL: &[&str] = &[
    include_str!("stage/material/physical.wgsl"),
    include_str!("stage/curve.wgsl"),
    include_str!("stage/light/ball.wgsl"),
    include_str!("facets.wgsl"),
    include_str!("whitted/dice.wgsl"),
    include_str!("whitted/encounter.wgsl"),
    include_str!("whitted/gloss.wgsl"),
    include_str!("whitted/waves.wgsl"),
    include_str!("whitted/spawn.wgsl"),
    include_str!("whitted/physical.wgsl"),
];

/// The source of the shader for stages of this kind, in WGSL.
pub fn shader(special: &ShaderSpecialization) -> String {
    let walk = match special.depth {
        0 => include_str!("stage/sphere.wgsl"),
        _ => include_str!("stage/bvh.wgsl"),
    };
    let mut source = constants(special).text();
    let is_plain = special.physical == PhysicalFeatures::NOTHING;
    if !is_plain {
        source.push_str(&laws::constants(special).text());
    }
    if special.sky == EnvironmentKind::Picture || special.textures {
        source.push_str(&picture_constants().text());
        source.push_str(include_str!("stage/image.wgsl"));
    }
    source.push_str(match special.sky {
        EnvironmentKind::Even => include_str!("stage/sky/even.wgsl"),
        EnvironmentKind::Gradient => include_str!("stage/sky/gradient.wgsl"),
        EnvironmentKind::Picture => include_str!("stage/sky/picture.wgsl"),
    });
    source.push_str(match special.textures {
        false => include_str!("stage/texture/none.wgsl"),
        true => include_str!("stage/texture.wgsl"),
    });
    source.push_str(match special.physical.has(PhysicalFeatures::ABSORBS) {
        true => include_str!("search/absorption.wgsl"),
        false => include_str!("search/absorption/none.wgsl"),
    });
    source.push_str(walk);
    ALWAYS.iter().chain(if is_plain { PLAIN } else { PHYSICAL }).for_each(|part| source.push_str(part));
    source
}

/// Constants of the Rust side, and those that a shader is specialized by.
struct ShaderConstants {
    words: Vec<(&'static str, u32)>,
    numbers: Vec<(&'static str, f32)>,
    flags: Vec<(&'static str, bool)>,
}

impl ShaderConstants {
    fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        for (name, value) in &self.words {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        for (name, value) in &self.numbers {
            let _ = writeln!(text, "const {name}: f32 = {value:e}f;");
        }
        for (name, value) in &self.flags {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        text
    }
}

/// The constants of shaders for stages with pictures.
fn picture_constants() -> ShaderConstants {
    ShaderConstants {
        words: vec![("PICTURES_ACROSS", PICTURES_ACROSS)],
        numbers: vec![("PI", std::f32::consts::PI), ("TEXTURE_LEVEL", TEXTURE_LEVEL)],
        flags: Vec::new(),
    }
}

/// The constants of every shader.
fn constants(special: &ShaderSpecialization) -> ShaderConstants {
    let words = vec![
        ("NO_BODY", NO_BODY),
        ("NO_START", NO_START),
        ("INWARDS", INWARDS),
        ("SPHERE", ShapeKind::Sphere as u32),
        ("CUBE", ShapeKind::Cube as u32),
        ("CYLINDER", ShapeKind::Cylinder as u32),
        ("CONE", ShapeKind::Cone as u32),
        ("PLANE", ShapeKind::Plane as u32),
        ("SIDE", crate::shape::SIDE as u32),
        ("LOWER_CAP", crate::shape::LOWER_CAP as u32),
        ("UPPER_CAP", crate::shape::UPPER_CAP as u32),
        ("FALLOFF_NONE", bytes::FALLOFF_NONE),
        ("FALLOFF_LINEAR", bytes::FALLOFF_LINEAR),
        ("TILE", TILE as u32),
        ("BLOCKS_ACROSS", BLOCKS_ACROSS),
        ("MOST_RAYS", MOST_RAYS),
        ("MOST_INTERVALS", MOST_INTERVALS),
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
        ("LEAST_NORMAL", f32::MIN_POSITIVE),
        ("MOST_LIGHT", MOST_LIGHT),
    ];
    let flags = vec![
        ("HAS_SPHERES", special.has(ShapeKind::Sphere)),
        ("HAS_CUBES", special.has(ShapeKind::Cube)),
        ("HAS_CYLINDERS", special.has(ShapeKind::Cylinder)),
        ("HAS_CONES", special.has(ShapeKind::Cone)),
        ("HAS_PLANES", special.has(ShapeKind::Plane)),
        ("HAS_TRANSPARENCY", special.media > 0),
        ("HAS_CHECKERS", special.checkers),
        ("ASKS_EACH_START", special.asks_each_start),
        ("ABSORBS", special.physical.has(PhysicalFeatures::ABSORBS)),
    ];
    ShaderConstants { words, numbers, flags }
}
