//! The bodies of a scene on their way to the scene.

use std::ops::Range;

use catoptric_scene::{Body, BodyPart, Contact, Form, List, MaterialChoice, Scene, Shape};
use glam::DAffine3;
use rayon::prelude::*;

use crate::geometry::Members;
use crate::geometry::body::double::Body64;
use crate::geometry::body::{PreparedBody, RenderBody, contact_bits, passage};
use crate::geometry::bounds::Bounds;
use crate::geometry::bvh::entry::BuildEntry;
use crate::geometry::canonical::CanonicalBody;
use crate::geometry::joined::JoinTree;
use crate::geometry::ray::NO_BODY;
use crate::geometry::space::RenderSpace;
use crate::transport::scene::SceneBuildError;
use crate::transport::surface::material::{MaterialTable, NamedMaterials, RenderMaterial};
use crate::transport::surface::model::MaterialModel;
use crate::transport::texture::solid::SolidNode;

/// What is known of a scene's bodies before they are brought into the hierarchy's order.
///
/// Each has a number: its place in the scene, or beyond those its place among the [`Members`] of groups and the parts of
/// joined bodies.
pub(crate) struct BodyBuild {
    /// One for each visible bounded body.
    pub(crate) entries: Vec<BuildEntry>,
    /// The numbers of the visible bodies without end.
    pub(crate) planes: Vec<u32>,
    pub(crate) bodies: NumberedBodies,
    pub(crate) joined: Vec<JoinedBuild>,
    pub(crate) materials: Vec<RenderMaterial>,
    pub(crate) solids: Vec<SolidNode>,
    /// Those in double precision, by their numbers, in order.
    pub(crate) doubles: Vec<(u32, Body64)>,
}

/// A body that is joined of others.
pub(crate) struct JoinedBuild {
    /// The number of its first part.
    first: u32,
    pub(crate) tree: JoinTree,
}

/// So many bodies that are neighbors in the scene are prepared by one thread.
const CHUNK: usize = SLICES * List::<Body>::SLICE;
const SLICES: usize = 16;

/// The prepared bodies by their numbers, the hidden ones with them.
pub(crate) struct NumberedBodies {
    chunks: Vec<(Vec<RenderBody>, ChunkNumbering)>,
    members: Vec<RenderBody>,
    numbering: Members,
}

/// What the materials, patterns and joined bodies of a chunk are numbered in the scene.
struct ChunkNumbering {
    materials: Vec<u32>,
    first_solid: u32,
    first_joined: u32,
}

/// What all bodies of a scene share.
#[derive(Clone, Copy)]
struct BuildContext<'a> {
    named: &'a NamedMaterials<'a>,
    space: &'a RenderSpace,
    /// What lies between bodies that touch.
    contact: Contact,
}

/// What one thread finds out about some bodies.
struct ChunkBuild<'a> {
    around: BuildContext<'a>,
    bodies: Vec<RenderBody>,
    entries: Vec<BuildEntry>,
    planes: Vec<u32>,
    materials: MaterialTable<'a>,
    solids: Vec<SolidNode>,
    doubles: Vec<(u32, Body64)>,
    /// Members of groups and parts of joined bodies, numbered from 0 on.
    members: Vec<MemberBuild>,
    joined: Vec<JoinedBuild>,
    /// How many simple parts of the body at hand came before.
    parts_before: u32,
    /// Left to several threads.
    large_groups: Vec<ScenePlace<'a>>,
}

/// A body that the scene has only as a part of another.
struct MemberBuild {
    /// The place in the scene of what it belongs to.
    scene_index: u32,
    /// Which of the simple parts of that it is.
    part: u32,
    body: RenderBody,
    double: Option<Box<Body64>>,
    /// Whether searches look for it, and within which bounds: a part of a joined body is no place by itself.
    search: Option<SearchedBounds>,
}

/// Where searches look for a body.
#[derive(Clone, Copy)]
enum SearchedBounds {
    Bounded(Bounds),
    Endless,
}

impl SearchedBounds {
    /// Of a simple body: without bounds it has no end.
    fn of(bounds: Option<Bounds>) -> Self {
        bounds.map_or(Self::Endless, Self::Bounded)
    }
}

impl BodyBuild {
    /// Prepares the bodies of a scene for rays in `space`.
    pub(crate) fn of(scene: &Scene, space: &RenderSpace) -> Result<Self, SceneBuildError> {
        let named = MaterialTable::named(scene);
        let around = BuildContext { named: &named, space, contact: scene.environment.contact };
        let slices: Vec<&[Body]> = scene.bodies.slices().collect();
        let chunks = slices.par_chunks(SLICES).enumerate();
        let chunks: Vec<_> =
            chunks.map(|(chunk, slices)| ChunkBuild::of(slices, chunk * CHUNK, around)).collect();
        // Of several undefined materials the first is told.
        let mut chunks = chunks.into_iter().collect::<Result<Vec<_>, _>>()?;
        let runs: Vec<_> = chunks.iter().flat_map(|chunk| &chunk.large_groups).flat_map(runs).collect();
        let runs = runs.into_par_iter().map(|run| ChunkBuild::of_run(run, around));
        chunks.extend(runs.collect::<Vec<_>>().into_iter().collect::<Result<Vec<_>, _>>()?);
        let mut table = MaterialTable::default();
        let mut all = Self {
            entries: Vec::with_capacity(chunks.iter().map(|chunk| chunk.entries.len()).sum()),
            planes: Vec::new(),
            bodies: NumberedBodies {
                chunks: Vec::with_capacity(chunks.len()),
                members: Vec::new(),
                numbering: Members {
                    first: scene.bodies.len() as u32,
                    scene_indices: Vec::new(),
                    parts: Vec::new(),
                },
            },
            joined: Vec::new(),
            materials: Vec::new(),
            solids: Vec::new(),
            doubles: Vec::new(),
        };
        let mut member_doubles = Vec::new();
        for chunk in chunks {
            let numbering = ChunkNumbering {
                materials: table.append(&chunk.materials),
                first_solid: all.solids.len() as u32,
                first_joined: all.joined.len() as u32,
            };
            all.entries.extend(chunk.entries);
            all.planes.extend(chunk.planes);
            all.solids.extend(chunk.solids);
            all.doubles.extend(chunk.doubles);
            let first_member = all.bodies.member_number();
            let joined = chunk.joined.into_iter();
            all.joined
                .extend(joined.map(|joined| JoinedBuild { first: first_member + joined.first, ..joined }));
            for member in chunk.members {
                let number = all.bodies.member_number();
                let MemberBuild { scene_index, part, body, double, search } = member;
                member_doubles.extend(double.map(|double| (number, *double)));
                match search {
                    Some(SearchedBounds::Bounded(bounds)) => {
                        all.entries.push(BuildEntry::new(bounds, number, u32::from(body.kind)));
                    }
                    Some(SearchedBounds::Endless) => all.planes.push(number),
                    None => {}
                }
                all.bodies.members.push(numbering.applied(body));
                all.bodies.numbering.scene_indices.push(scene_index);
                all.bodies.numbering.parts.push(part);
            }
            all.bodies.chunks.push((chunk.bodies, numbering));
        }
        all.doubles.extend(member_doubles);
        all.materials = table.into_prepared();
        Ok(all)
    }
}

impl JoinedBuild {
    /// The numbers of its parts.
    pub(crate) fn parts(&self) -> Range<u32> {
        self.first..self.first + self.tree.parts
    }
}

impl ChunkNumbering {
    fn applied(&self, mut body: RenderBody) -> RenderBody {
        body.material = self.materials.get(body.material as usize).copied().unwrap_or_default();
        if body.solid != NO_BODY {
            body.solid += self.first_solid;
        }
        if body.is_joined() {
            body.set_joined_number(body.joined_number() as u32 + self.first_joined);
        }
        body
    }
}

impl NumberedBodies {
    /// The number of the next member.
    fn member_number(&self) -> u32 {
        self.numbering.first + self.members.len() as u32
    }

    /// Which members belong to what.
    pub(crate) fn members(&self) -> Members {
        self.numbering.clone()
    }

    /// The body of this number, which is not hidden.
    pub(crate) fn body(&self, number: u32) -> RenderBody {
        match number.checked_sub(self.numbering.first) {
            Some(member) => self.members[member as usize],
            None => {
                let (bodies, numbering) = &self.chunks[number as usize / CHUNK];
                numbering.applied(bodies[number as usize % CHUNK])
            }
        }
    }
}

impl<'a> ChunkBuild<'a> {
    /// Prepares some bodies, the first of which is at the place `first`.
    fn of(slices: &[&'a [Body]], first: usize, around: BuildContext<'a>) -> Result<Self, SceneBuildError> {
        let count = slices.iter().map(|slice| slice.len()).sum();
        let mut chunk = Self::empty(around, count);
        for (body, index) in slices.iter().copied().flatten().zip(first as u32..) {
            chunk.add(body, index)?;
        }
        Ok(chunk)
    }

    /// Prepares some members of a large group.
    fn of_run(run: MemberRun<'a>, around: BuildContext<'a>) -> Result<Self, SceneBuildError> {
        let mut chunk = Self { parts_before: run.first_part, ..Self::empty(around, 0) };
        chunk.add_members(run.place, run.parts, run.material, run.frame)?;
        Ok(chunk)
    }

    /// With room for `count` bodies of the scene.
    fn empty(around: BuildContext<'a>, count: usize) -> Self {
        Self {
            around,
            bodies: Vec::with_capacity(count),
            entries: Vec::with_capacity(count),
            planes: Vec::new(),
            materials: MaterialTable::default(),
            solids: Vec::new(),
            doubles: Vec::new(),
            members: Vec::new(),
            joined: Vec::new(),
            parts_before: 0,
            large_groups: Vec::new(),
        }
    }

    fn add(&mut self, body: &'a Body, index: u32) -> Result<(), SceneBuildError> {
        if body.hidden {
            self.bodies.push(RenderBody::NONE);
            return Ok(());
        }
        let place = ScenePlace { body, index };
        self.parts_before = 0;
        let (prepared, search) = match body.shape {
            Shape::Group => {
                if body.form().simple_parts(RUN) > RUN {
                    self.large_groups.push(place);
                } else {
                    let frame = body.placement.world_from_body();
                    self.add_members(place, body.form().parts, &body.material, frame)?;
                }
                (RenderBody::NONE, None)
            }
            Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } => {
                self.join(place, &body.form(), &body.material, DAffine3::IDENTITY)?
            }
            _ => {
                let PreparedBody { body: prepared, bounds, double } =
                    self.prepare(place, &CanonicalBody::of(body), &body.material)?;
                self.doubles.extend(double.map(|double| (index, *double)));
                (prepared, Some(SearchedBounds::of(bounds)))
            }
        };
        match search {
            Some(SearchedBounds::Bounded(bounds)) => {
                self.entries.push(BuildEntry::new(bounds, index, u32::from(prepared.kind)));
            }
            Some(SearchedBounds::Endless) => self.planes.push(index),
            None => {}
        }
        self.bodies.push(prepared);
        Ok(())
    }

    /// Prepares a simple body with its material and its pattern.
    fn prepare(
        &mut self,
        place: ScenePlace<'_>,
        canonical: &CanonicalBody,
        choice: &'a MaterialChoice,
    ) -> Result<PreparedBody, SceneBuildError> {
        let mut prepared = RenderBody::prepare_shape(canonical, self.around.space);
        let body = &mut prepared.body;
        let found = self.materials.find(self.around.named, choice);
        let (material, source) = found.ok_or_else(|| place.undefined_material(choice))?;
        body.material = material;
        let own = self.materials.prepared(material);
        body.passes = passage_of(own.is_transparent(), own, place.body, self.around.contact);
        if let Some(solid) = source.pattern().and_then(|pattern| pattern.solid.as_ref()) {
            body.solid = self.solids.len() as u32;
            self.solids.extend(SolidNode::row(solid, canonical, self.around.space, body.is_double()));
        }
        Ok(prepared)
    }

    /// Adds members of a group with the frame `frame`.
    fn add_members(
        &mut self,
        place: ScenePlace<'_>,
        members: &'a [BodyPart],
        material: &'a MaterialChoice,
        frame: DAffine3,
    ) -> Result<(), SceneBuildError> {
        for part in members {
            let (form, material) = (part.form(), part.material.as_ref().unwrap_or(material));
            let part = self.parts_before;
            let (body, double, search) = match form.shape {
                Shape::Group => {
                    let frame = frame * form.placement.world_from_body();
                    self.add_members(place, form.parts, material, frame)?;
                    continue;
                }
                Shape::Union | Shape::Intersection | Shape::Difference | Shape::Surface { .. } => {
                    let (body, search) = self.join(place, &form, material, frame)?;
                    (body, None, search)
                }
                _ => {
                    let frame = frame * form.placement.world_from_body();
                    let canonical = CanonicalBody::placed(form.sized_shape(), frame);
                    let PreparedBody { body, bounds, double } = self.prepare(place, &canonical, material)?;
                    self.parts_before += 1;
                    (body, double, Some(SearchedBounds::of(bounds)))
                }
            };
            self.members.push(MemberBuild { scene_index: place.index, part, body, double, search });
        }
        Ok(())
    }

    /// Adds the parts of what is joined that stands in the frame `around`. What is made of them,
    /// and where searches look for it: nowhere if it is empty.
    fn join(
        &mut self,
        place: ScenePlace<'_>,
        form: &Form<'a>,
        material: &'a MaterialChoice,
        around: DAffine3,
    ) -> Result<(RenderBody, Option<SearchedBounds>), SceneBuildError> {
        let tree = JoinTree::of(form);
        if tree.parts as usize > Shape::MAX_PARTS {
            return Err(place.too_many_parts(tree.parts));
        }
        let mut parts = Vec::with_capacity(tree.parts as usize);
        for part in form.parts {
            part.form().each_simple(DAffine3::IDENTITY, &mut |simple| {
                let material = simple.material.or(part.material.as_ref()).unwrap_or(material);
                parts.push((simple, material));
            });
        }
        // Boxes in the frame of the whole are mostly the tighter ones.
        let (mut boxes, mut own_boxes, mut members) = (Vec::new(), Vec::new(), Vec::new());
        let frame = around * form.placement.world_from_body();
        let first_part = self.parts_before;
        self.parts_before += tree.parts;
        for ((part, material), number) in parts.into_iter().zip(first_part..) {
            let in_whole = CanonicalBody::placed(part.shape, part.frame);
            own_boxes.push(in_whole.bounds().unwrap_or(Bounds::EVERYWHERE));
            let canonical = CanonicalBody::placed(part.shape, frame * part.frame);
            let PreparedBody { body, bounds, double } = self.prepare(place, &canonical, material)?;
            boxes.push(bounds.unwrap_or(Bounds::EVERYWHERE));
            let scene_index = place.index;
            members.push(MemberBuild { scene_index, part: number, body, double, search: None });
        }
        let of_all =
            |boxes: &[Bounds]| tree.bounds(|part| boxes.get(part as usize).copied().unwrap_or(Bounds::EMPTY));
        let (bounds, own_bounds) = (of_all(&boxes), of_all(&own_boxes));
        if bounds.is_empty() || own_bounds.is_empty() {
            return Ok((RenderBody::NONE, None));
        }
        let is_bounded = own_bounds.is_finite() && bounds.is_finite();
        let error_bound = members.iter().map(|part| part.body.error_bound).fold(0.0, f32::max);
        let number = self.joined.len() as u32;
        let own_box = is_bounded.then(|| {
            let frame = frame * own_bounds.frame();
            DAffine3 { translation: self.around.space.render_from_world(frame.translation), ..frame }
        });
        let mut whole = RenderBody::joined(number, own_box, error_bound);
        let bounds = whole.bounds().map_or(bounds, |own| own.common(bounds));
        let found = self.materials.find(self.around.named, material);
        (whole.material, _) = found.ok_or_else(|| place.undefined_material(material))?;
        let is_transparent = members.iter().any(|part| part.body.is_transparent());
        let own = self.materials.prepared(whole.material);
        whole.passes = match tree.is_surface() && is_transparent {
            true => passage(is_transparent, place.body.shadow),
            false => passage_of(is_transparent, own, place.body, self.around.contact),
        };
        self.joined.push(JoinedBuild { first: self.members.len() as u32, tree });
        self.members.extend(members);
        let search = if is_bounded { SearchedBounds::Bounded(bounds) } else { SearchedBounds::Endless };
        Ok((whole, Some(search)))
    }
}

/// How rays and light pass a body of this material, and what lies between it and others, as [`RenderBody::passes`] has it.
pub(crate) fn passage_of(is_transparent: bool, material: &RenderMaterial, body: &Body, scene: Contact) -> u8 {
    // Thin sheets and clear surfaces have two sides, neither of which goes away where it touches something.
    let is_sheet = matches!(material.law, MaterialModel::ThinDielectric(_));
    passage(is_transparent, body.shadow) | if is_sheet { 0 } else { contact_bits(scene, body.contact) }
}

/// So many simple parts of a group are prepared by one thread.
const RUN: usize = 4096;

/// Members of a large group, or of one within it, that stand side by side.
#[derive(Clone, Copy)]
struct MemberRun<'a> {
    place: ScenePlace<'a>,
    parts: &'a [BodyPart],
    /// What those are made of that have no material of their own.
    material: &'a MaterialChoice,
    /// Of the group.
    frame: DAffine3,
    /// How many simple parts of the body come before.
    first_part: u32,
}

/// The members of a large group in their order, in runs of at most [`RUN`] simple parts, or of one member.
fn runs<'a>(place: &ScenePlace<'a>) -> Vec<MemberRun<'a>> {
    let body = place.body;
    let whole = (body.form().parts, &body.material, body.placement.world_from_body());
    let (mut runs, mut first_part) = (Vec::new(), 0);
    add_runs(*place, whole, &mut first_part, &mut runs);
    runs.retain(|run| !run.parts.is_empty());
    runs
}

fn add_runs<'a>(
    place: ScenePlace<'a>,
    (parts, material, frame): (&'a [BodyPart], &'a MaterialChoice, DAffine3),
    first_part: &mut u32,
    runs: &mut Vec<MemberRun<'a>>,
) {
    let (mut begin, mut count) = (0, 0);
    for (at, part) in parts.iter().enumerate() {
        let form = part.form();
        let own = form.simple_parts(RUN);
        let is_large = own > RUN && form.shape == Shape::Group;
        if is_large || count + own > RUN {
            runs.push(MemberRun {
                place,
                parts: &parts[begin..at],
                material,
                frame,
                first_part: *first_part,
            });
            *first_part += count as u32;
            (begin, count) = (at, 0);
        }
        if is_large {
            let inner = frame * form.placement.world_from_body();
            let material = part.material.as_ref().unwrap_or(material);
            add_runs(place, (form.parts, material, inner), first_part, runs);
            begin = at + 1;
        } else {
            count += own;
        }
    }
    runs.push(MemberRun { place, parts: &parts[begin..], material, frame, first_part: *first_part });
    *first_part += count as u32;
}

/// A body of the scene, to be named in errors.
#[derive(Clone, Copy)]
struct ScenePlace<'a> {
    body: &'a Body,
    index: u32,
}

impl ScenePlace<'_> {
    fn name(self) -> String {
        let Self { body, index } = self;
        if body.name.is_empty() { format!("number {}", index + 1) } else { format!("\"{}\"", body.name) }
    }

    fn undefined_material(self, choice: &MaterialChoice) -> SceneBuildError {
        let material = choice.name().unwrap_or_default().to_owned();
        SceneBuildError::UndefinedMaterial { body: self.name(), material }
    }

    fn too_many_parts(self, parts: u32) -> SceneBuildError {
        SceneBuildError::TooManyParts { body: self.name(), parts }
    }
}
