//! The bodies of a scene on their way to the scene.

use catoptric_scene::{Body, List, Scene};
use rayon::prelude::*;

use crate::geometry::body::double::Body64;
use crate::geometry::body::{BodyParts, RenderBody};
use crate::geometry::bvh::entry::BuildEntry;
use crate::geometry::ray::NO_BODY;
use crate::geometry::space::RenderSpace;
use crate::transport::scene::SceneBuildError;
use crate::transport::surface::material::{MaterialTable, NamedMaterials, RenderMaterial};
use crate::transport::texture::checker::CheckerTexture;

/// What is known of a scene's bodies before they are brought into the hierarchy's order.
pub(crate) struct BodyBuild {
    /// One for each visible bounded body.
    pub(crate) entries: Vec<BuildEntry>,
    /// The places of the visible planes.
    pub(crate) planes: Vec<u32>,
    pub(crate) chunks: BodyChunks,
    pub(crate) materials: Vec<RenderMaterial>,
    pub(crate) checkers: Vec<CheckerTexture>,
    /// Those in double precision, by their places in the scene, in order.
    pub(crate) doubles: Vec<(u32, Body64)>,
}

/// So many bodies that are neighbors in the scene are prepared by one thread.
const CHUNK: usize = SLICES * List::<Body>::SLICE;
const SLICES: usize = 16;

/// The prepared bodies in the scene's order, the hidden ones with them.
pub(crate) struct BodyChunks(Vec<(Vec<RenderBody>, ChunkIndices)>);

/// What the materials and checkers of a chunk are numbered in the scene.
struct ChunkIndices {
    materials: Vec<u32>,
    first_checker: u32,
}

/// What one thread finds out about some bodies.
struct ChunkBuild<'a> {
    bodies: Vec<RenderBody>,
    entries: Vec<BuildEntry>,
    planes: Vec<u32>,
    materials: MaterialTable<'a>,
    checkers: Vec<CheckerTexture>,
    doubles: Vec<(u32, Body64)>,
}

impl BodyBuild {
    /// Prepares the bodies of a scene for rays in `space`.
    pub(crate) fn of(scene: &Scene, space: &RenderSpace) -> Result<Self, SceneBuildError> {
        let named = MaterialTable::named(scene);
        let slices: Vec<&[Body]> = scene.bodies.slices().collect();
        let chunks = slices.par_chunks(SLICES).enumerate();
        let chunks: Vec<_> =
            chunks.map(|(chunk, slices)| ChunkBuild::of(slices, chunk * CHUNK, (&named, space))).collect();
        // Of several undefined materials the first is told.
        let chunks = chunks.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut table = MaterialTable::default();
        let mut cast = Self {
            entries: Vec::with_capacity(chunks.iter().map(|chunk| chunk.entries.len()).sum()),
            planes: Vec::new(),
            chunks: BodyChunks(Vec::with_capacity(chunks.len())),
            materials: Vec::new(),
            checkers: Vec::new(),
            doubles: Vec::new(),
        };
        for chunk in chunks {
            let numbering = ChunkIndices {
                materials: table.append(&chunk.materials),
                first_checker: cast.checkers.len() as u32,
            };
            cast.entries.extend(chunk.entries);
            cast.planes.extend(chunk.planes);
            cast.checkers.extend(chunk.checkers);
            cast.doubles.extend(chunk.doubles);
            cast.chunks.0.push((chunk.bodies, numbering));
        }
        cast.materials = table.into_prepared();
        Ok(cast)
    }
}

impl BodyChunks {
    /// The body at this place in the scene, which is not hidden.
    pub(crate) fn body(&self, index: u32) -> RenderBody {
        let (bodies, numbering) = &self.0[index as usize / CHUNK];
        let mut body = bodies[index as usize % CHUNK];
        body.material = numbering.materials[body.material as usize];
        if body.checker != NO_BODY {
            body.checker += numbering.first_checker;
        }
        body
    }
}

impl<'a> ChunkBuild<'a> {
    /// Prepares some bodies, the first of which is at the place `first`.
    fn of(
        slices: &[&'a [Body]],
        first: usize,
        (named, space): (&NamedMaterials<'a>, &RenderSpace),
    ) -> Result<Self, SceneBuildError> {
        let count = slices.iter().map(|slice| slice.len()).sum();
        let mut chunk = Self {
            bodies: Vec::with_capacity(count),
            entries: Vec::with_capacity(count),
            planes: Vec::new(),
            materials: MaterialTable::default(),
            checkers: Vec::new(),
            doubles: Vec::new(),
        };
        for (body, index) in slices.iter().copied().flatten().zip(first..) {
            let BodyParts { body: mut prepared, bounds, double } = RenderBody::prepare(body, space);
            if !body.hidden {
                chunk.doubles.extend(double.map(|double| (index as u32, *double)));
                let found = chunk.materials.find(named, &body.material);
                let (material, source) = found.ok_or_else(|| undefined_material(index, body))?;
                prepared.material = material;
                prepared.transparent = u8::from(chunk.materials.prepared(material).is_transparent());
                if let Some(checker) = source.pattern().and_then(|pattern| pattern.checker.as_ref()) {
                    prepared.checker = chunk.checkers.len() as u32;
                    chunk.checkers.push(CheckerTexture::new(checker, body, space, prepared.is_double()));
                }
                match bounds {
                    Some(bounds) => {
                        chunk.entries.push(BuildEntry::new(bounds, index as u32, u32::from(prepared.kind)));
                    }
                    None => chunk.planes.push(index as u32),
                }
            }
            chunk.bodies.push(prepared);
        }
        Ok(chunk)
    }
}

fn undefined_material(index: usize, body: &Body) -> SceneBuildError {
    SceneBuildError::UndefinedMaterial {
        body: if body.name.is_empty() {
            format!("number {}", index + 1)
        } else {
            format!("\"{}\"", body.name)
        },
        material: body.material.name().unwrap_or_default().to_owned(),
    }
}
