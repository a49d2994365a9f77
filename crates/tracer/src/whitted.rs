//! Whitted's tree of rays, walked with an explicit stack.
//!
//! Turner Whitted, An improved illumination model for shaded display, Communications of the ACM 23(6), 1980.

mod tree;

use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, Vec3A};

use crate::counts::RayCounts;
use crate::medium::{Media, MediaArena};
use crate::ray::{Ray, Start};
use crate::search::{Flight, Hit};
use crate::stage::{Pending, Stage, StageBody, StageCamera, StageMaterial};
use crate::surface::{mend_unit, phong_highlight, reflect, refract};

pub use tree::{RayKind, TracedRay};

/// Walks trees of rays; reusable from pixel to pixel by one thread.
pub struct Whitted<'a> {
    stage: &'a Stage,
    camera: &'a StageCamera,
    cancel: &'a AtomicBool,
    pending: Vec<Branch>,
    /// Working memory of searches.
    parts: Vec<Pending>,
    arena: MediaArena,
    /// Media at the eye, and the arena's mark above them.
    eye_media: Option<Media>,
    eye_mark: usize,
    counts: RayCounts,
}

/// A ray still to be traced.
#[derive(Clone, Copy)]
struct Branch {
    ray: Ray,
    /// Product of the coefficients on the way from the eye.
    weight: Vec3A,
    generation: u32,
    media: Media,
    /// The arena's length when this branch was made: all later lists are free once it is taken up.
    mark: usize,
}

/// The point that a ray met, with all that shading needs.
struct Encounter<'a> {
    hit: Hit,
    body: &'a StageBody,
    material: &'a StageMaterial,
    color: Vec3A,
    position: Vec3A,
    /// Unit normal facing the ray.
    normal: Vec3A,
}

impl<'a> Whitted<'a> {
    /// Rays between two looks at the cancel flag.
    const CANCEL_INTERVAL: u32 = 1024;

    /// A walker over `stage` that stops early, with unfinished pixels, when `cancel` is set.
    pub fn new(stage: &'a Stage, cancel: &'a AtomicBool) -> Self {
        Self::through(stage, stage.camera(), cancel)
    }

    /// The same through a camera of [`Stage::camera_for`].
    pub fn through(stage: &'a Stage, camera: &'a StageCamera, cancel: &'a AtomicBool) -> Self {
        let mut arena = MediaArena::default();
        let eye_media = camera.eye().map(|eye| arena.at_point(stage, eye));
        let eye_mark = arena.mark();
        Self {
            stage,
            camera,
            cancel,
            pending: Vec::new(),
            parts: Vec::new(),
            arena,
            eye_media,
            eye_mark,
            counts: RayCounts::default(),
        }
    }

    /// The rays traced so far.
    pub fn counts(&self) -> RayCounts {
        self.counts
    }

    /// The light that reaches the point `at` of a picture of `size` pixels (see [`StageCamera::ray`]).
    pub fn trace(&mut self, at: DVec2, size: DVec2) -> Vec3A {
        let primary = self.camera.ray(at, size);
        let mut branch = self.root(primary, self.eye_media);
        let mut light = Vec3A::ZERO;
        let mut until_look = Self::CANCEL_INTERVAL;
        loop {
            let (own, goes_on) = self.follow(&mut branch);
            light += own;
            until_look -= 1;
            if until_look == 0 {
                if self.cancel.load(Ordering::Relaxed) {
                    return light;
                }
                until_look = Self::CANCEL_INTERVAL;
            }
            if !goes_on {
                let Some(next) = self.pending.pop() else {
                    return light;
                };
                self.arena.rewind(next.mark);
                branch = next;
            }
        }
    }

    /// The first branch of a tree, in `media` if they are known already.
    fn root(&mut self, primary: Ray, media: Option<Media>) -> Branch {
        self.arena.rewind(self.eye_mark);
        let media = media.unwrap_or_else(|| self.arena.at_point(self.stage, primary.origin));
        self.counts.primary += 1;
        self.pending.clear();
        Branch { ray: primary, weight: Vec3A::ONE, generation: 1, media, mark: self.arena.mark() }
    }

    /// Traces one ray and returns its own weighted share of the light. If true comes with it, the branch was replaced
    /// by its reflected child, to be followed next; a refracted child is left pending.
    fn follow(&mut self, branch: &mut Branch) -> (Vec3A, bool) {
        let flight = Flight { stage: self.stage, arena: &self.arena, ray: branch.ray, media: branch.media };
        let Some(hit) = flight.nearest(&mut self.parts) else {
            return (branch.weight * self.stage.background, false);
        };
        let encounter = Encounter::new(self.stage, &branch.ray, hit);
        let light = branch.weight * self.local_light(branch, &encounter);
        (light, branch.generation < self.stage.generations() && self.spawn(branch, &encounter))
    }

    /// The ambient, diffuse and highlight terms.
    fn local_light(&mut self, branch: &Branch, at: &Encounter<'_>) -> Vec3A {
        let material = at.material;
        let mut light = material.ambient * at.color * self.stage.ambient;
        let diffuse = material.diffuse * at.color;
        if diffuse == Vec3A::ZERO && material.specular == 0.0 {
            return light;
        }
        for source in &*self.stage.lights {
            let offset = source.position - at.position;
            let distance = offset.length();
            let to_light = offset / distance;
            let cos = at.normal.dot(to_light);
            // A light that stands exactly here has no direction.
            let lit = distance > 0.0 && cos > 0.0 && source.power != Vec3A::ZERO;
            if !lit {
                continue;
            }
            self.counts.shadow += 1;
            let ray = at.ray_on_this_side(to_light);
            let flight = Flight { stage: self.stage, arena: &self.arena, ray, media: branch.media };
            let passed = flight.transmittance(distance, &mut self.parts);
            if passed == Vec3A::ZERO {
                continue;
            }
            let highlight = if material.specular == 0.0 {
                0.0
            } else {
                phong_highlight(-branch.ray.direction, to_light, at.normal, material.shininess)
            };
            light += passed * source.power_at(distance) * (diffuse * cos + material.specular * highlight);
        }
        light
    }

    /// Leaves the refracted ray pending and turns the branch into the reflected one, each if it carries anything;
    /// false if there is no reflected one.
    fn spawn(&mut self, branch: &mut Branch, at: &Encounter<'_>) -> bool {
        let mut reflection = Vec3A::splat(at.material.reflection);
        if at.body.is_transparent() {
            let (ratio, beyond) = self.cross(branch, at);
            match refract(branch.ray.direction, at.normal, ratio) {
                Some(direction) => {
                    let weight = branch.weight * at.material.filter;
                    if self.carries(weight) {
                        self.counts.refracted += 1;
                        // A ray that goes straight on is the same ray still, unless it stands still: between bodies
                        // thinner than rounding it could go on for ever.
                        let same = ratio == 1.0 && at.hit.t > branch.ray.slack();
                        self.pending.push(Branch {
                            ray: at.ray_on_far_side(direction),
                            weight,
                            generation: branch.generation + u32::from(!same),
                            media: beyond,
                            mark: self.arena.mark(),
                        });
                    }
                }
                // Total internal reflection: all of the light, and nothing twice.
                None => reflection = Vec3A::ONE,
            }
        }
        let weight = branch.weight * reflection;
        let carries = self.carries(weight);
        if carries {
            self.counts.reflected += 1;
            branch.ray = at.ray_on_this_side(mend_unit(reflect(branch.ray.direction, at.normal)));
            branch.weight = weight;
            branch.generation += 1;
        }
        carries
    }

    /// Whether a ray of this weight is traced.
    fn carries(&self, weight: Vec3A) -> bool {
        let strongest = weight.max_element();
        strongest > 0.0 && strongest >= self.stage.threshold
    }

    /// The ratio of indices for a ray that crosses the surface, and the media beyond it.
    fn cross(&mut self, branch: &Branch, at: &Encounter<'_>) -> (f32, Media) {
        let body = at.hit.body;
        let here = self.arena.innermost(branch.media);
        let beyond = if self.arena.contains(branch.media, body) {
            self.arena.left(branch.media, body)
        } else {
            self.arena.entered(branch.media, body)
        };
        let there = self.arena.innermost(beyond);
        let ior =
            |medium: Option<u32>| medium.map_or(1.0, |index| self.stage.material(self.stage.body(index)).ior);
        (ior(here) / ior(there), beyond)
    }
}

impl<'a> Encounter<'a> {
    fn new(stage: &'a Stage, ray: &Ray, hit: Hit) -> Self {
        let body = stage.body(hit.body);
        let material = stage.material(body);
        let point = body.surface_point(ray.origin, ray.direction, hit.t, hit.leaving);
        let color = match stage.checkers.get(body.checker as usize) {
            Some(checker) if checker.is_odd(point.in_body) => checker.color,
            _ => material.color,
        };
        Self { hit, body, material, color, position: point.in_world, normal: point.normal }
    }

    /// A ray from here to the side that the incoming ray came from.
    fn ray_on_this_side(&self, direction: Vec3A) -> Ray {
        let start = Start { body: self.hit.body, inwards: self.hit.leaving };
        Ray { origin: self.position, direction, start }
    }

    /// A ray from here to the other side of the surface.
    fn ray_on_far_side(&self, direction: Vec3A) -> Ray {
        let start = Start { body: self.hit.body, inwards: !self.hit.leaving };
        Ray { origin: self.position, direction, start }
    }
}
