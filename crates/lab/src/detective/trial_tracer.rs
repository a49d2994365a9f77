//! A tracer of simple scenes in double precision whose rays may be wrong.
//!
//! It makes what the exact tracer cannot be made to do: other roots, other normals, missing caps. Each fault is a switch.
//! What it finds has the form of the exact tracer's trees, so that faults of the sum of light apply to it, too.

mod body;
mod shape;
mod view;

use catoptric_scene::{FresnelTerm, Light, Projection, Scene, Shape, SolidKind};
use catoptric_tracer::RayKind;
use glam::{DVec3, Vec3};

use super::light_tree::{DarkSide, LightSample, LightTrees, PhongPoint, TreeNode};
use super::ray_fault::{LeavingRule, RayFault, RayFaults, ShadowBias};
use body::TrialBody;
use shape::{Hit, Switches};
use view::TrialView;

/// What a scene that can be traced has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TrialFacts {
    pub(super) is_lit: bool,
    pub(super) is_perspective: bool,
    pub(super) has_spheres: bool,
    pub(super) has_cylinders: bool,
    pub(super) has_cones: bool,
    pub(super) has_planes: bool,
    pub(super) is_round: bool,
    /// Whether bodies are scaled unevenly, scaled at all, turned.
    pub(super) is_scaled: bool,
    pub(super) is_stretched: bool,
    pub(super) is_turned: bool,
    pub(super) has_checkers: bool,
    pub(super) has_highlights: bool,
    pub(super) reflects: bool,
    pub(super) transmits: bool,
}

impl TrialFacts {
    /// The most bodies that are tried one by one.
    const MOST_BODIES: usize = 48;

    /// `None` if the scene has something that is not traced here.
    pub(super) fn of(scene: &Scene) -> Option<Self> {
        let tracer = TrialTracer::new(scene, &RayFaults::default())?;
        let mut facts = Self {
            is_lit: !tracer.lamps.is_empty(),
            is_perspective: matches!(scene.camera.projection, Projection::Perspective { .. }),
            ..Self::default()
        };
        for body in &tracer.bodies {
            let shape = body.document.shape;
            let placement = &body.document.placement;
            facts.has_spheres |= matches!(shape, Shape::Sphere { .. });
            facts.has_cylinders |= matches!(shape, Shape::Cylinder { .. });
            facts.has_cones |= matches!(shape, Shape::Cone { .. });
            facts.has_planes |= matches!(shape, Shape::Plane);
            facts.is_scaled |= placement.scale.abs() != DVec3::splat(placement.scale.x.abs());
            facts.is_stretched |= placement.scale != DVec3::ONE;
            facts.is_turned |= placement.rotation() != glam::DMat3::IDENTITY;
            facts.has_checkers |=
                body.phong.pattern.solid.as_ref().is_some_and(|solid| solid.kind == SolidKind::Checker);
            facts.has_highlights |= body.phong.specular > 0.0;
            facts.reflects |= body.phong.reflection() > 0.0;
            facts.transmits |= body.is_clear();
        }
        facts.is_round = facts.has_spheres || facts.has_cylinders || facts.has_cones;
        Some(facts)
    }
}

/// A scene with its faults of rays, ready to be traced.
pub(super) struct TrialTracer<'a> {
    scene: &'a Scene,
    bodies: Vec<TrialBody<'a>>,
    lamps: Vec<&'a Light>,
    view: TrialView,
    switches: Switches,
    /// How far from a surface rays start, meters.
    start: f64,
}

/// How far rays are followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrialLimits {
    pub(super) generations: u32,
    pub(super) rays: usize,
    /// Rays of less weight are left out.
    pub(super) weight: f32,
}

/// The clear bodies around a ray, the innermost last.
#[derive(Clone, Copy, Debug, Default)]
struct MediumList {
    bodies: [u8; 8],
    count: u8,
}

impl MediumList {
    fn innermost(&self) -> Option<usize> {
        let last = usize::from(self.count).checked_sub(1)?;
        self.bodies.get(last).map(|body| usize::from(*body))
    }

    fn entered(mut self, body: usize) -> Self {
        if let (Some(place), Ok(body)) = (self.bodies.get_mut(usize::from(self.count)), u8::try_from(body)) {
            *place = body;
            self.count += 1;
        }
        self
    }

    fn has(&self, body: usize) -> bool {
        self.bodies.iter().take(usize::from(self.count)).any(|own| usize::from(*own) == body)
    }

    fn left(self, body: usize) -> Self {
        let own = self.bodies.iter().take(usize::from(self.count)).map(|own| usize::from(*own));
        own.filter(|own| *own != body).fold(Self::default(), Self::entered)
    }
}

/// A ray that is to be traced.
#[derive(Clone, Copy, Debug)]
struct TrialRay {
    origin: DVec3,
    direction: DVec3,
    generation: u32,
    kind: RayKind,
    parent: u32,
    coefficient: Vec3,
    unweighed: Vec3,
    weight: f32,
    is_total: bool,
    is_inside: bool,
    media: MediumList,
}

/// A point that a ray meets.
struct TrialHit {
    body: usize,
    position: DVec3,
    t: f64,
    /// Outwards.
    normal: DVec3,
}

fn vector(color: catoptric_scene::Color) -> Vec3 {
    DVec3::from(color.to_array()).as_vec3()
}

impl<'a> TrialTracer<'a> {
    /// The tracer of a scene; `None` if the scene has too many bodies, or some of other kinds.
    pub(super) fn new(scene: &'a Scene, faults: &RayFaults) -> Option<Self> {
        let switches = Switches::new(faults);
        let visible = scene.bodies.iter().enumerate().filter(|(_, body)| !body.hidden);
        let bodies: Option<Vec<TrialBody<'a>>> =
            visible.map(|(place, body)| TrialBody::new(scene, (place, body), &switches)).collect();
        let bodies = bodies.filter(|bodies| bodies.len() <= TrialFacts::MOST_BODIES)?;
        let has_soft_lights = scene.lights.iter().any(|light| !light.hidden && light.radius > 0.0);
        let is_even = matches!(scene.environment.surroundings, catoptric_scene::Surroundings::Even);
        let eye = scene.camera.position;
        let is_in_clear = bodies.iter().any(|body| body.is_clear() && body.contains(eye));
        if has_soft_lights || !is_even || is_in_clear {
            return None;
        }
        let places = bodies.iter().map(|body| body.document.placement.origin());
        let extent = places.fold(eye.abs().max_element(), |most, at| most.max(at.abs().max_element()));
        Some(Self {
            scene,
            bodies,
            lamps: scene.lights.iter().filter(|light| !light.hidden).collect(),
            view: TrialView::new(&scene.camera, &switches),
            switches,
            // Rounding of a position is some 2⁻⁵⁰ of the scene's extent, a pixel some 2⁻¹²: far from both.
            start: 2.0_f64.powi(-30) * extent.max(1e-6),
        })
    }

    /// Adds the tree of the place `at` of a picture of `size` pixels.
    pub(super) fn trace(
        &self,
        at: glam::DVec2,
        size: glam::DVec2,
        limits: TrialLimits,
        trees: &mut LightTrees,
    ) {
        let (origin, direction) = self.view.ray(at, size);
        let mut waiting = vec![TrialRay {
            origin,
            direction,
            generation: 1,
            kind: RayKind::Primary,
            parent: u32::MAX,
            coefficient: Vec3::ONE,
            unweighed: Vec3::ONE,
            weight: 1.0,
            is_total: false,
            is_inside: false,
            media: MediumList::default(),
        }];
        let mut count = 0;
        while let Some(ray) = waiting.pop() {
            if count >= limits.rays {
                break;
            }
            let hit = self.nearest(&ray);
            let (fixed, surface) = match &hit {
                Some(hit) => (Vec3::ZERO, self.surface(&ray, hit, trees)),
                None => (vector(self.scene.environment.background), None),
            };
            trees.add_node(TreeNode {
                parent: ray.parent,
                kind: ray.kind,
                generation: ray.generation,
                coefficient: ray.coefficient,
                unweighed: ray.unweighed,
                is_total: ray.is_total,
                is_inside: ray.is_inside,
                fixed,
                surface,
                body: hit.as_ref().and_then(|hit| Some(self.bodies.get(hit.body)?.place)),
            });
            if let Some(hit) = &hit {
                let sent = self.sent_on(&ray, hit, count as u32);
                let is_followed = |next: &TrialRay| {
                    next.generation <= limits.generations && next.weight > 0.0 && next.weight >= limits.weight
                };
                waiting.extend(sent.into_iter().flatten().filter(is_followed));
            }
            count += 1;
        }
        trees.end_tree();
    }

    fn nearest(&self, ray: &TrialRay) -> Option<TrialHit> {
        let order = self.switches.order;
        let is_primary = ray.kind == RayKind::Primary;
        let behind_all = order == Some(RayFault::HitsBehind);
        let behind_eye = order == Some(RayFault::HitsBehindEye) && is_primary;
        // With a wrong normal the start may lie on the surface still.
        let least = if is_primary { 0.0 } else { self.start };
        let mut best: Option<(usize, Hit, f64)> = None;
        let mut last_distance = 0.0;
        for (index, body) in self.bodies.iter().enumerate() {
            let (hits, stretch) = body.hits(ray.origin, ray.direction, &self.switches);
            let mut own: Option<Hit> = None;
            for hit in hits.iter() {
                let is_met = hit.t > least || behind_eye || behind_all && hit.t < -1e4 * self.start;
                let rank = |t: f64| if behind_all { t.abs() } else { t };
                if is_met && own.is_none_or(|own| rank(hit.t) < rank(own.t)) {
                    own = Some(*hit);
                }
            }
            let Some(own) = own else { continue };
            last_distance = own.t;
            let rank = match self.switches.distance {
                Some(_) => own.t * stretch,
                None if behind_all => own.t.abs(),
                None => own.t,
            };
            let is_better = match order {
                Some(RayFault::LastHit) => true,
                Some(RayFault::FirstHit) => best.is_none(),
                _ => best.is_none_or(|(_, _, least)| rank < least),
            };
            if is_better {
                let t = if self.switches.distance == Some(RayFault::OwnDistance) { rank } else { own.t };
                best = Some((index, Hit { t, ..own }, rank));
            }
        }
        let (index, hit, _) = best?;
        let t = if order == Some(RayFault::LastDistance) { last_distance } else { hit.t };
        let position = ray.origin + t * ray.direction;
        let normal = self.bodies.get(index)?.normal(&hit, position, &self.switches);
        Some(TrialHit { body: index, position, t, normal })
    }

    /// The point as the law of light sees it.
    fn surface(&self, ray: &TrialRay, hit: &TrialHit, trees: &mut LightTrees) -> Option<PhongPoint> {
        let body = self.bodies.get(hit.body)?;
        let is_behind = hit.normal.dot(ray.direction) > 0.0;
        let facing = if is_behind { -hit.normal } else { hit.normal };
        let shading = match self.switches.normal_side {
            Some(RayFault::NormalsOutward) => hit.normal,
            Some(_) => -hit.normal,
            None => facing,
        };
        let phong = body.phong;
        let is_matte = phong.diffuse == 0.0 && phong.specular == 0.0;
        let shown = if is_matte { &[][..] } else { &self.lamps };
        let samples =
            shown.iter().enumerate().map(|(index, lamp)| self.sample(hit, (shading, facing), index, lamp));
        let lights = trees.add_lights(samples);
        let normal = shading.as_vec3();
        Some(PhongPoint {
            color: body.color(hit.position, &self.switches),
            ambient_light: vector(self.scene.environment.ambient),
            ambient: phong.ambient as f32,
            diffuse: phong.diffuse as f32,
            specular: phong.specular as f32,
            shininess: phong.shininess as f32,
            reflection: phong.reflection() as f32,
            tint: vector(phong.tint),
            view: -ray.direction.as_vec3(),
            way: (hit.t * ray.direction.length()) as f32,
            to_eye: (self.scene.camera.position - hit.position).as_vec3(),
            normal,
            wrong_normals: body.wrong_normals(hit.position, normal),
            dark_side: match self.switches.dark_side {
                Some(RayFault::CosineMagnitude) => DarkSide::Magnitude,
                Some(RayFault::CosineNegative) => DarkSide::Negative,
                Some(_) => DarkSide::Highlight,
                None => DarkSide::Dark,
            },
            lights,
        })
    }

    fn sample(
        &self,
        hit: &TrialHit,
        (shading, facing): (DVec3, DVec3),
        index: usize,
        lamp: &Light,
    ) -> LightSample {
        let way = match self.switches.lamp {
            Some(RayFault::LampsAsDirections) => lamp.position,
            Some(_) => hit.position - lamp.position,
            None => lamp.position - hit.position,
        };
        let distance = way.length();
        let direction = way.normalize_or(DVec3::Y);
        let is_above = shading.dot(direction) > 0.0;
        let is_shining = is_above || self.switches.dark_side.is_some();
        // A body that is lit on its dark side does not hide itself.
        let own = (!is_above).then_some(hit.body);
        let (passed, is_blocked) = if is_shining {
            self.passed(hit.position, facing, direction, distance, own)
        } else {
            (Vec3::ZERO, true)
        };
        LightSample {
            direction: direction.as_vec3(),
            distance: distance as f32,
            is_above: is_shining,
            passed,
            is_blocked,
            light: index,
        }
    }

    /// What passes on the way to a lamp, and whether an opaque body stands there; `own` is a body that hides nothing.
    fn passed(
        &self,
        position: DVec3,
        facing: DVec3,
        direction: DVec3,
        distance: f64,
        own: Option<usize>,
    ) -> (Vec3, bool) {
        let side = facing.normalize_or(DVec3::Y);
        let (above, least) = match self.switches.shadow {
            Some(RayFault::Bias(ShadowBias::Least(size))) => (self.start, f64::from(size) / 1000.0),
            Some(RayFault::Bias(ShadowBias::Above(size))) => (f64::from(size) / 1000.0, 0.0),
            Some(RayFault::ShadowsFromBehind) => (self.start, f64::NEG_INFINITY),
            // With a wrong normal the start may lie on the surface still.
            _ => (self.start, self.start),
        };
        let most = match self.switches.shadow {
            Some(RayFault::ShadowsFromBeyond) => f64::INFINITY,
            Some(RayFault::ShadowsWithinOne) => 1.0,
            _ if self.switches.lamp == Some(RayFault::LampsAsDirections) => f64::INFINITY,
            _ => distance,
        };
        let origin = position + above * side;
        let mut passed = Vec3::ONE;
        for (index, body) in self.bodies.iter().enumerate() {
            if own == Some(index) {
                continue;
            }
            let (hits, stretch) = body.hits(origin, direction, &self.switches);
            let unit = if self.switches.distance == Some(RayFault::OwnDistance) { stretch } else { 1.0 };
            for hit in hits.iter() {
                let t = hit.t * unit;
                if t > least && t < most {
                    passed *= body.shadow;
                }
            }
            if passed == Vec3::ZERO {
                return (passed, !body.is_clear());
            }
        }
        (passed, false)
    }

    /// The reflected and the refracted ray.
    fn sent_on(&self, ray: &TrialRay, hit: &TrialHit, parent: u32) -> [Option<TrialRay>; 2] {
        let Some(body) = self.bodies.get(hit.body) else { return [None, None] };
        let phong = body.phong;
        let is_leaving = hit.normal.dot(ray.direction) > 0.0;
        let facing = if is_leaving { -hit.normal } else { hit.normal };
        let mut reflection = phong.reflection() as f32;
        let through = phong.transmission as f32 * vector(phong.tint);
        let is_weighed = phong.fresnel == FresnelTerm::Schlick && body.is_clear();
        let whole = reflection;
        let mut is_total = false;
        let mut refracted = None;
        if body.is_clear() {
            match self.bent(ray, hit, (facing, is_leaving)) {
                Some((mut next, reflectance)) => {
                    let mut own = through;
                    if is_weighed && reflection > 0.0 {
                        own *= 1.0 - reflectance;
                        reflection *= reflectance;
                    }
                    next.parent = parent;
                    next.coefficient = own;
                    next.unweighed = through;
                    next.weight = ray.weight * own.max_element();
                    refracted = Some(next);
                }
                None => {
                    is_total = true;
                    if !is_weighed {
                        reflection = 1.0;
                    }
                }
            }
        }
        let along = facing.dot(ray.direction) * facing;
        let direction = match self.switches.reflection {
            Some(RayFault::ReflectionBackwards) => 2.0 * along - ray.direction,
            Some(RayFault::ReflectionHalf) => ray.direction - along,
            Some(_) => ray.direction + 2.0 * along,
            None => ray.direction - 2.0 * along,
        };
        let side = if direction.dot(facing) < 0.0 { -facing } else { facing };
        let reflected = (reflection > 0.0).then(|| TrialRay {
            origin: hit.position + self.start * side.normalize_or(DVec3::Y),
            direction: direction.normalize_or(ray.direction),
            generation: ray.generation + 1,
            kind: RayKind::Reflected,
            parent,
            coefficient: Vec3::splat(reflection),
            unweighed: Vec3::splat(if is_weighed { whole } else { reflection }),
            weight: ray.weight * reflection,
            is_total,
            is_inside: is_leaving,
            media: ray.media,
        });
        [reflected, refracted]
    }

    /// The refracted ray without its coefficient, and Schlick's reflectance (1994, eq. 15); `None` at total reflection.
    fn bent(
        &self,
        ray: &TrialRay,
        hit: &TrialHit,
        (facing, is_leaving): (DVec3, bool),
    ) -> Option<(TrialRay, f32)> {
        let index = |media: &MediumList| {
            let body = media.innermost().and_then(|body| self.bodies.get(body));
            body.map_or(1.0, |body| body.phong.ior)
        };
        let media = if is_leaving { ray.media.left(hit.body) } else { ray.media.entered(hit.body) };
        let mut ratio = index(&ray.media) / index(&media);
        if self.switches.leaving == Some(LeavingRule::Straight) {
            ratio = 1.0;
        }
        let leaving = self.switches.leaving.filter(|_| is_leaving);
        if matches!(leaving, Some(LeavingRule::Ratio | LeavingRule::Both)) {
            ratio = ratio.recip();
        }
        let is_turned = matches!(leaving, Some(LeavingRule::Normal | LeavingRule::Both));
        let normal = if is_turned { -facing } else { facing };
        let cosine = -normal.dot(ray.direction);
        let under = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if under < 0.0 {
            return None;
        }
        let direction =
            (ratio * ray.direction + (ratio * cosine - under.sqrt()) * normal).normalize_or(ray.direction);
        let side = if direction.dot(facing) < 0.0 { -facing } else { facing };
        // A body that is entered twice, or left from outside, is a fault's.
        let is_odd = ray.media.has(hit.body) != is_leaving;
        let is_straight = self.switches.leaving == Some(LeavingRule::Straight);
        let is_bent = (ratio - 1.0).abs() > 1e-9 || hit.t < 1e2 * self.start || is_odd || is_straight;
        let least = ((1.0 - ratio) / (1.0 + ratio)).powi(2);
        let smaller = if ratio > 1.0 { under.sqrt() } else { cosine };
        let reflectance = least + (1.0 - least) * (1.0 - smaller).powi(5);
        let next = TrialRay {
            origin: hit.position + self.start * side.normalize_or(DVec3::Y),
            direction,
            generation: ray.generation + u32::from(is_bent),
            kind: RayKind::Refracted,
            is_total: false,
            is_inside: !is_leaving,
            media,
            ..*ray
        };
        Some((next, reflectance as f32))
    }
}
