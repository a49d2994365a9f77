//! What is written down of a ray of the tree.

use glam::{DVec3, Vec3};

use crate::geometry::ray::Ray;
use crate::transport::pick::RayIntersection;
use crate::transport::surface::model::ReflectionModel;

/// Why a ray was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye, or wherever the tree begins.
    Primary,
    /// Mirrored, total internal reflection included.
    Reflected,
    /// Bent into or out of a transparent body.
    Refracted,
}

/// One ray of a tree, with every number that its light is made of, in the renderer's single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct RayRecord {
    /// The ray itself, in the space of the rays.
    pub ray: Ray,
    /// Where it starts in the world, meters.
    pub origin: DVec3,
    /// Why it was sent.
    pub kind: RayKind,
    /// The place in the tree of the ray at whose end it starts; `None` for the first.
    pub parent: Option<usize>,
    /// Its generation; the first ray is generation 1.
    pub generation: u32,
    /// Its wavelength, nanometers, once a body has split its light; `None` for light of all colors.
    pub wavelength: Option<f64>,
    /// The coefficient that its parent gave it: k_r, 1 or k_t·τ, or what a law of reflection made of them; 1 for the
    /// first ray.
    pub coefficient: Vec3,
    /// Of a ray that a facet of a rough surface sent: the probability density of its direction, for each steradian. `None`
    /// where there was only one direction.
    pub density: Option<f32>,
    /// How far along it from the eye it starts, meters: the primary ray of an eye that is far from all bodies starts closer
    /// to them, where single precision is finer. 0 for all others.
    pub start_distance: f64,
    /// Product of the coefficients on the way from the eye.
    pub weight: Vec3,
    /// The share of light that the media leave on its way; 1 but in bodies that absorb.
    pub through: Vec3,
    /// What this ray alone adds to the pixel: `weight` × `through` × `local`.
    pub light: Vec3,
    /// The sum of the local terms at its end, or the background: ((ambient + first light) + second light) + ….
    pub local: Vec3,
    /// The transparent bodies that it flies in, the one entered last first: places in
    /// [`Scene::bodies`](catoptric_scene::Scene::bodies).
    pub media: Vec<usize>,
    /// The index of refraction there, 1 in air.
    pub ior: f32,
    /// What it meets.
    pub hit: Option<RayIntersection>,
    /// How the surface there answers.
    pub answer: Option<SurfaceRecord>,
}

impl SurfaceRecord {
    /// The cemented contact that the surface is, if it is one.
    pub fn contact(&self) -> Option<ContactRecord> {
        self.interface?.contact
    }

    /// Whether light goes on through a cemented contact as in one body.
    pub fn is_seamless(&self) -> bool {
        self.contact().is_some_and(|contact| contact.is_seamless)
    }
}

impl RayRecord {
    /// How far what it meets is from where it comes from, the eye or a surface, meters.
    pub fn distance(&self) -> Option<f64> {
        self.hit.map(|hit| self.start_distance + f64::from(hit.hit.t))
    }
}

/// How a surface answers a ray that meets it. At a [seamless](ContactRecord::is_seamless) contact its coefficients are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceRecord {
    /// By which law it reflects; the coefficients are those of the [branches](BranchRecord).
    pub law: ReflectionModel,
    /// Width of the slopes of its facets, α; 0 is smooth. The coefficients are those of the facet that this ray met.
    pub alpha: f32,
    /// C: the body's color at this point.
    pub color: Vec3,
    /// How far C is the second color of the body's pattern; of patterns within each other, of the outermost.
    pub second_share: Option<f32>,
    /// k_a.
    pub ambient_coefficient: f32,
    /// I_a.
    pub ambient_light: Vec3,
    /// The ambient term k_a·C·I_a.
    pub ambient: Vec3,
    /// k_d.
    pub diffuse_coefficient: f32,
    /// k_s.
    pub specular_coefficient: f32,
    /// n.
    pub shininess: f32,
    /// Each light that shines, in the order of the scene; none if the surface answers no light, k_d = k_s = 0.
    pub lights: Vec<LightTerm>,
    /// What becomes of a ray across the surface, if it is transparent.
    pub interface: Option<InterfaceRecord>,
    /// The reflected ray; the totally reflected one, if nothing passes.
    pub reflected: BranchRecord,
    /// The refracted ray.
    pub refracted: BranchRecord,
}

/// The border of two media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceRecord {
    /// The index of refraction beyond the surface.
    pub ior_beyond: f32,
    /// The index on this side divided by that beyond.
    pub ratio: f32,
    /// Whether all light is reflected (total internal reflection).
    pub is_total: bool,
    /// The two bodies of a cemented contact.
    pub contact: Option<ContactRecord>,
}

/// A cemented contact: one body is left and another entered, with nothing between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactRecord {
    /// The body that is left, and the one that is entered: places in [`Scene::bodies`](catoptric_scene::Scene::bodies). One of
    /// them has the surface that was met.
    pub bodies: [usize; 2],
    /// Whether light goes on as in one body, so that there is no surface.
    pub is_seamless: bool,
}

/// A ray that may go on from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchRecord {
    /// k_r or 1 for the reflected ray, k_t·τ for the refracted one.
    pub coefficient: Vec3,
    /// The weight that the ray has, or would have.
    pub weight: Vec3,
    /// What becomes of it.
    pub fate: BranchOutcome,
}

/// What becomes of a ray that may go on from a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchOutcome {
    /// It is this ray of the tree.
    Followed(usize),
    /// It would carry nothing: the surface is opaque, or no mirror, or the weight has sunk to 0.
    Nothing,
    /// There is no refracted ray at total internal reflection.
    TotalReflection,
    /// Its generation would be above the limit.
    GenerationLimit,
    /// Its weight is below the threshold.
    Threshold,
    /// The renderer follows it, but the tree was to have no more rays.
    LeftOut,
}

/// What a surface makes of a light.
#[derive(Clone, Debug, PartialEq)]
pub struct LightTerm {
    /// The light's place among those of the scene that are not hidden.
    pub light: usize,
    /// L̂, the direction to the light.
    pub direction: Vec3,
    /// d, meters.
    pub distance: f32,
    /// n̂·L̂. A light at or below 0 takes no part.
    pub cosine: f32,
    /// What lies between; `None` if the light takes no part.
    pub shadow: Option<ShadowRecord>,
    /// What the surface sends on; `None` if nothing arrives.
    pub answer: Option<LightContribution>,
}

/// The way of a shadow ray.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowRecord {
    /// V: the share that passes, per channel.
    pub passed: Vec3,
    /// Every surface on the way, the nearest first, those behind an opaque one included.
    pub crossings: Vec<ShadowCrossing>,
    /// The share of light that the medium leaves between the last of them and the light; 1 but in bodies that absorb. With
    /// the filters of all crossings it makes V, but for rounding.
    pub through: Vec3,
}

/// A surface between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowCrossing {
    /// The place of the body in [`Scene::bodies`](catoptric_scene::Scene::bodies).
    pub body: usize,
    /// Which of its simple parts, as [`RayIntersection::part`](crate::RayIntersection::part).
    pub part: Option<usize>,
    /// Distance from the point, meters.
    pub distance: f32,
    /// Whether the body is left here, not entered.
    pub leaving: bool,
    /// What the crossing lets through: k_t·τ, or what is not reflected; and what the medium leaves on the way there from the
    /// point or the crossing before. `None` if the body is opaque.
    pub filter: Option<Vec3>,
    /// The body that is entered here, too, if this is a cemented contact: its place in the scene.
    pub into: Option<usize>,
}

/// What a surface sends on of a light: `light` = `power` × (`diffuse` + `highlight` + `glints`) × V, in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightContribution {
    /// What the facets of a rough surface send on, for each unit of `power`.
    pub glints: Vec3,
    /// A(d)·I_j.
    pub power: Vec3,
    /// k_d·C·(n̂·L̂).
    pub diffuse: Vec3,
    /// Ŝ·R̂; no number without a highlight.
    pub highlight_cosine: f32,
    /// k_s·(Ŝ·R̂)ⁿ.
    pub highlight: f32,
    /// The term of this light.
    pub light: Vec3,
}
