//! A ray tracer in plain double precision that shares no code with the program, and makes mistakes on demand.
//!
//! It reads the document of a scene as data: spheres, cubes, cylinders, cones and planes of Phong's materials, with
//! transforms, checkers, shadows, reflection, refraction by nested media, and lamps that fall off. Without a mistake its
//! pictures are those of the exact tracer but for rounding at edges.

mod slips;
mod solids;
mod view;

use catoptric_scene::{Falloff, FresnelTerm, Light, Material, PatternSpace, Phong, Scene, SolidKind};
use glam::DVec3;

pub use slips::Slip;
use solids::{Solid, SolidShape};
pub use view::Encoding;

/// A scene and the mistakes with which it is traced.
pub struct IndependentTracer<'a> {
    scene: &'a Scene,
    slips: Vec<Slip>,
    solids: Vec<Solid>,
    lamps: Vec<&'a Light>,
}

/// What a ray meets.
struct Meeting {
    body: usize,
    t: f64,
    at: DVec3,
    /// Outwards; of length 1 unless that is the mistake.
    normal: DVec3,
}

/// A ray with what it brings along.
#[derive(Clone)]
struct Ray {
    origin: DVec3,
    direction: DVec3,
    generation: u32,
    /// The clear bodies around it, the innermost last.
    inside: Vec<usize>,
}

/// How far from a surface rays start, and the least distance of a hit.
const START: f64 = 1e-7;

impl<'a> IndependentTracer<'a> {
    /// A tracer of a scene with these mistakes.
    ///
    /// # Panics
    /// If the scene has bodies or materials other than those of the module's description.
    pub fn new(scene: &'a Scene, slips: &[Slip]) -> Self {
        let phong = |body| match scene.material(body) {
            Some(Material::Phong(phong)) => phong,
            _ => panic!("Phong's materials only"),
        };
        let bodies = scene.bodies.iter().filter(|body| !body.hidden);
        let solids = bodies
            .map(|body| Solid::new(body, phong(&body.material), slips))
            .filter(|solid| !solid.is_missing(slips))
            .collect();
        let mut lamps: Vec<&Light> = scene.lights.iter().filter(|light| !light.hidden).collect();
        if slips.contains(&Slip::FirstLampOnly) {
            lamps.truncate(1);
        }
        if slips.contains(&Slip::LastLampOnly) {
            lamps = lamps.pop().into_iter().collect();
        }
        Self { scene, slips: slips.to_vec(), solids, lamps }
    }

    fn has(&self, slip: Slip) -> bool {
        self.slips.contains(&slip)
    }

    fn primary(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        self.trace(&Ray { origin, direction, generation: 1, inside: Vec::new() })
    }

    fn nearest(&self, ray: &Ray) -> Option<Meeting> {
        let from = if ray.generation == 1 { 0.0 } else { START };
        let mut best: Option<Meeting> = None;
        let mut last = 0.0;
        for (body, solid) in self.solids.iter().enumerate() {
            let is_hit = |t: &f64| *t > from || self.has(Slip::HitsBehind) && ray.generation == 1;
            let crossings = solid.crossings(ray.origin, ray.direction, &self.slips);
            let Some(own) = crossings
                .into_iter()
                .filter(|crossing| is_hit(&crossing.t))
                .min_by(|one, other| one.t.total_cmp(&other.t))
            else {
                continue;
            };
            last = own.t;
            let is_better = best.as_ref().is_none_or(|best| own.t < best.t);
            if self.has(Slip::LastHit) || (is_better && !self.has(Slip::FirstHit)) || best.is_none() {
                let at = ray.origin + own.t * ray.direction;
                let normal = solid.normal(own.gradient, &self.slips);
                let normal = match solid.kind {
                    SolidShape::Ball(_) if self.has(Slip::NormalsFromOrigin) => at.normalize(),
                    _ => normal,
                };
                best = Some(Meeting { body, t: own.t, at, normal });
            }
        }
        if let Some(best) = best.as_mut().filter(|_| self.has(Slip::LastDistance)) {
            best.t = last;
            best.at = ray.origin + last * ray.direction;
        }
        best
    }

    fn trace(&self, ray: &Ray) -> DVec3 {
        let background = DVec3::from(self.scene.environment.background.to_array());
        let Some(meeting) = self.nearest(ray) else {
            let is_black = self.has(Slip::BlackBackground) && ray.generation > 1;
            return if is_black { DVec3::ZERO } else { background };
        };
        let phong = &self.solids[meeting.body].phong;
        let is_leaving = meeting.normal.dot(ray.direction) > 0.0;
        let normal = if is_leaving { -meeting.normal } else { meeting.normal };
        let shaded = match () {
            () if self.has(Slip::NormalsOutward) => meeting.normal,
            () if self.has(Slip::NormalsInward) => -meeting.normal,
            () => normal,
        };
        let color = self.color(meeting.body, meeting.at);
        let (mut light, is_shadowed) = self.local(&meeting, (shaded, normal), color, ray.direction);
        if self.has(Slip::BlendedReflection) {
            light *= 1.0 - phong.reflection().min(1.0);
        }
        if !(self.has(Slip::DullShadows) && is_shadowed) {
            light += self.sent_on(&meeting, (normal, is_leaving), color, ray);
        }
        if self.has(Slip::ClampedRays) { light.min(DVec3::ONE) } else { light }
    }

    fn color(&self, body: usize, at: DVec3) -> DVec3 {
        let solid = &self.solids[body];
        let pattern = &solid.phong.pattern;
        let mut color = DVec3::from(pattern.color.to_array());
        if let Some(checker) = pattern.solid.as_ref().filter(|_| !self.has(Slip::NoPattern)) {
            assert_eq!(checker.kind, SolidKind::Checker, "checkers only");
            let is_own = checker.space == PatternSpace::Body || self.has(Slip::CheckerOfBody);
            let mut place = if is_own { solid.unscaled.transform_point3(at) } else { at } - checker.position;
            place /= checker.size * if self.has(Slip::CheckerHalved) { 0.5 } else { 1.0 };
            if self.has(Slip::CheckerShifted) {
                place += 0.5;
            }
            let cell = if self.has(Slip::CheckerTruncated) { place.trunc() } else { (place + 1e-6).floor() };
            let cell = if self.has(Slip::CheckerFlat) { cell * DVec3::new(1.0, 0.0, 1.0) } else { cell };
            let is_second = cell.element_sum().rem_euclid(2.0) == 1.0;
            if is_second != self.has(Slip::CheckerInverted) {
                color = DVec3::from(checker.color.to_array());
            }
        }
        if self.has(Slip::IntegerColors) { color.floor() } else { color }
    }

    /// Ambient light and that of the lamps; and whether a lamp is hidden.
    fn local(
        &self,
        meeting: &Meeting,
        (normal, facing): (DVec3, DVec3),
        color: DVec3,
        direction: DVec3,
    ) -> (DVec3, bool) {
        let phong = &self.solids[meeting.body].phong;
        let mut lamps = DVec3::ZERO;
        let (mut is_shadowed, mut are_all_lit) = (false, true);
        for lamp in &self.lamps {
            let way =
                if self.has(Slip::LampsAsDirections) { lamp.position } else { lamp.position - meeting.at };
            let way = if self.has(Slip::LampsReversed) { -way } else { way };
            let toward = way.normalize();
            let cosine = normal.dot(toward);
            let dark = [Slip::CosineMagnitude, Slip::CosineNegative, Slip::HighlightOnDarkSide];
            if cosine <= 0.0 && !dark.into_iter().any(|slip| self.has(slip)) {
                continue;
            }
            // Bodies that shine on both sides do not hide themselves.
            let own = (cosine <= 0.0).then_some(meeting.body);
            let passed = self.passed(meeting.at, facing, toward, way.length(), own);
            is_shadowed |= passed == DVec3::ZERO;
            are_all_lit &= passed.max_element() > 0.0;
            let [diffuse, highlight] = self.answer(phong, (normal, way), meeting.at, direction);
            let seen = if self.has(Slip::HighlightInShadow) { DVec3::ONE } else { passed };
            let own = DVec3::from(lamp.color.to_array());
            let shine = if self.has(Slip::WhiteLamps) { DVec3::ONE } else { own };
            let glare = if self.has(Slip::WhiteHighlight) { DVec3::ONE } else { shine };
            let tint = if self.has(Slip::ColoredHighlight) { color } else { DVec3::ONE };
            lamps += self.strength(lamp, meeting.at, way)
                * (diffuse * color * shine * passed + highlight * tint * glare * seen);
        }
        if self.has(Slip::LampsAveraged) {
            lamps /= self.lamps.len() as f64;
        }
        if self.has(Slip::OneShadowForAll) && !are_all_lit {
            lamps = DVec3::ZERO;
        }
        let ambient = DVec3::from(self.scene.environment.ambient.to_array());
        let ambient = if self.has(Slip::WholeAmbient) { 1.0 } else { phong.ambient }
            * ambient
            * if self.has(Slip::UncoloredAmbient) { DVec3::ONE } else { color };
        let times = match () {
            () if self.has(Slip::NoAmbient) => 0.0,
            () if self.has(Slip::BlackShadows) && is_shadowed => 0.0,
            () if self.has(Slip::AmbientPerLamp) => self.lamps.len() as f64,
            () => 1.0,
        };
        (times * ambient + lamps, is_shadowed)
    }

    /// What a lamp of its intensity sends to a point, without its color.
    fn strength(&self, lamp: &Light, at: DVec3, way: DVec3) -> f64 {
        let intensity = if self.has(Slip::FullLamps) { 1.0 } else { lamp.intensity };
        let mut distance = way.length();
        if self.has(Slip::FalloffFromEye) {
            distance = at.distance(self.scene.camera.position);
        }
        if self.has(Slip::FalloffSquaredDistance) {
            distance *= distance;
        }
        intensity
            * match lamp.falloff {
                _ if self.has(Slip::NoFalloff) => 1.0,
                Falloff::None => 1.0,
                Falloff::Linear { constant } => 1.0 / (distance + constant),
                Falloff::InverseSquare => 1.0 / (distance * distance),
            }
    }

    /// The diffuse light and the highlight of a lamp of strength 1, without colors.
    fn answer(&self, phong: &Phong, (normal, way): (DVec3, DVec3), at: DVec3, direction: DVec3) -> [f64; 2] {
        let toward = way.normalize();
        let cosine = normal.dot(toward);
        let spread = match () {
            () if self.has(Slip::NoDiffuse) => 0.0,
            () if self.has(Slip::EvenDiffuse) => f64::from(cosine > 0.0),
            () if self.has(Slip::CosineMagnitude) => cosine.abs(),
            () if self.has(Slip::CosineNegative) => cosine,
            () if self.has(Slip::LongWay) => normal.dot(way).max(0.0),
            () => cosine.max(0.0),
        };
        let to_eye = self.scene.camera.position - at;
        let eye = match () {
            () if self.has(Slip::LongView) => to_eye,
            () if self.has(Slip::EyeInReflections) => to_eye.normalize(),
            () => -direction,
        };
        let lamp = if self.has(Slip::LongLamp) || self.has(Slip::LongWay) { way } else { toward };
        let aligned = if self.has(Slip::Halfway) {
            (lamp + eye).normalize().dot(normal)
        } else {
            (2.0 * normal.dot(lamp) * normal - lamp).dot(eye)
        };
        let factor = match () {
            () if self.has(Slip::ExponentDoubled) => 2.0,
            () if self.has(Slip::ExponentQuartered) => 0.25,
            () => 1.0,
        };
        let is_bright =
            cosine > 0.0 || self.has(Slip::CosineMagnitude) || self.has(Slip::HighlightOnDarkSide);
        let is_there = is_bright && !self.has(Slip::NoSpecular);
        let peak = if is_there { aligned.max(0.0).powf(factor * phong.shininess) } else { 0.0 };
        let whole =
            |slip, coefficient: f64| if self.has(slip) { f64::from(coefficient > 0.0) } else { coefficient };
        let highlight = whole(Slip::WholeHighlight, phong.specular) * peak;
        [
            whole(Slip::WholeDiffuse, phong.diffuse) * spread,
            if self.has(Slip::HighlightSquared) { highlight * highlight } else { highlight },
        ]
    }

    /// What passes on the way to a lamp; `own` is a body that hides nothing.
    fn passed(&self, at: DVec3, normal: DVec3, toward: DVec3, distance: f64, own: Option<usize>) -> DVec3 {
        if self.has(Slip::NoShadows) {
            return DVec3::ONE;
        }
        let is_bare = self.has(Slip::Acne);
        let origin = if is_bare { at } else { at + START * normal.normalize() };
        let least = match () {
            () if is_bare => 0.0,
            () if self.has(Slip::LargeBias) => 0.4,
            () if self.has(Slip::ShadowsFromBehind) => f64::NEG_INFINITY,
            () => 1e-9,
        };
        let most = match () {
            () if self.has(Slip::ShadowsBeyondLamp) => f64::INFINITY,
            () if self.has(Slip::ShadowsWithinOne) => 1.0,
            () if self.has(Slip::LampsAsDirections) => f64::INFINITY,
            () => distance,
        };
        let mut passed = DVec3::ONE;
        for (body, solid) in self.solids.iter().enumerate() {
            let is_cube = matches!(solid.kind, SolidShape::Block(_));
            if own == Some(body) || is_cube && self.has(Slip::CubesWithoutShadow) {
                continue;
            }
            for crossing in solid.crossings(origin, toward, &self.slips) {
                if crossing.t > least && crossing.t < most {
                    let through = solid.phong.transmission * DVec3::from(solid.phong.tint.to_array());
                    let is_clear = through.max_element() > 0.0;
                    passed *= match () {
                        () if is_clear
                            && (self.has(Slip::OpaqueShadows) || self.has(Slip::ClearBodiesOpaque)) =>
                        {
                            DVec3::ZERO
                        }
                        () if is_clear && self.has(Slip::ClearShadows) => DVec3::ONE,
                        () => through,
                    };
                }
            }
        }
        passed
    }

    /// What comes along the reflected and the refracted ray.
    fn sent_on(
        &self,
        meeting: &Meeting,
        (normal, is_leaving): (DVec3, bool),
        color: DVec3,
        ray: &Ray,
    ) -> DVec3 {
        let phong = &self.solids[meeting.body].phong;
        let most = match () {
            () if self.has(Slip::Depth1) => 1,
            () if self.has(Slip::Depth2) => 2,
            () if self.has(Slip::DepthMore) => self.scene.tracing.generations + 4,
            () => self.scene.tracing.generations,
        };
        let background = DVec3::from(self.scene.environment.background.to_array());
        let through = phong.transmission * DVec3::from(phong.tint.to_array());
        let is_clear = through.max_element() > 0.0;
        let is_weighed = phong.fresnel == FresnelTerm::Schlick && !self.has(Slip::NoSchlick);
        let is_whole = self.has(Slip::WholeReflection) && phong.reflection() > 0.0;
        let mut weights = [if is_whole { 1.0 } else { phong.reflection() }, 1.0];
        let mut refracted = None;
        if is_clear {
            match self.bent(meeting, (normal, is_leaving), ray) {
                Ok((bent, reflectance)) => {
                    let is_opaque = self.has(Slip::NoRefraction) || self.has(Slip::ClearBodiesOpaque);
                    refracted = (!is_opaque).then_some(bent);
                    if is_weighed && weights[0] > 0.0 {
                        weights = [weights[0] * reflectance, 1.0 - reflectance];
                    }
                }
                Err(()) if self.has(Slip::TotalBlack) => weights[0] = 0.0,
                Err(()) if is_weighed => {}
                Err(()) => weights[0] = 1.0,
            }
        }
        if self.has(Slip::NoReflection) || is_leaving && self.has(Slip::NoInnerReflection) {
            weights[0] = 0.0;
        }
        let follow = |next: Ray| match next.generation > most {
            true if self.has(Slip::BackgroundAtLast) => background,
            true => DVec3::ZERO,
            false => self.trace(&next),
        };
        let mut light = DVec3::ZERO;
        if weights[0] > 0.0 {
            let sign = if self.has(Slip::ReflectionBackwards) { -1.0 } else { 1.0 };
            let factor = match () {
                () if self.has(Slip::ReflectionHalf) => -1.0,
                () if self.has(Slip::ReflectionAdded) => 2.0,
                () => -2.0,
            };
            let mirrored = ray.direction + factor * normal.dot(ray.direction) * normal;
            let direction = sign * mirrored.normalize();
            let side = if direction.dot(normal) > 0.0 { normal } else { -normal };
            let tint = if self.has(Slip::TintedReflection) { color } else { DVec3::ONE };
            let origin = meeting.at + START * side.normalize();
            light += weights[0]
                * tint
                * follow(Ray {
                    origin,
                    direction,
                    generation: ray.generation + 1,
                    inside: ray.inside.clone(),
                });
        }
        if let Some(bent) = refracted {
            let through =
                if self.has(Slip::TintLeftOut) { DVec3::splat(phong.transmission) } else { through };
            light += weights[1] * through * follow(bent);
        }
        light
    }

    /// The refracted ray and Schlick's reflectance; an error at total reflection.
    fn bent(
        &self,
        meeting: &Meeting,
        (normal, is_leaving): (DVec3, bool),
        ray: &Ray,
    ) -> Result<(Ray, f64), ()> {
        let index = |inside: &[usize]| inside.last().map_or(1.0, |body| self.solids[*body].phong.ior);
        let mut inside = ray.inside.clone();
        if is_leaving {
            inside.retain(|body| *body != meeting.body);
        } else {
            inside.push(meeting.body);
        }
        let (before, after) = (index(&ray.inside), index(&inside));
        let mut ratio = before / after;
        if self.has(Slip::StraightRefraction) {
            ratio = 1.0;
        }
        if self.has(Slip::RatioTurned) || is_leaving && self.has(Slip::RatioOnLeaving) {
            ratio = 1.0 / ratio;
        }
        let normal = if is_leaving && self.has(Slip::NormalOnLeaving) { -normal } else { normal };
        let cosine = -normal.dot(ray.direction);
        let under = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if under < 0.0 {
            return Err(());
        }
        let direction = (ratio * ray.direction + (ratio * cosine - under.sqrt()) * normal).normalize();
        let side = if direction.dot(normal) > 0.0 { normal } else { -normal };
        let origin = meeting.at + START * side;
        // Only a mistake enters a body twice, or leaves it from outside.
        let is_odd = ray.inside.contains(&meeting.body) != is_leaving;
        let is_new = (ratio - 1.0).abs() > 1e-12 || meeting.t < 1e-5 || is_odd;
        let generation = ray.generation + u32::from(is_new || self.has(Slip::StraightRefraction));
        let r0 = ((1.0 - ratio) / (1.0 + ratio)).powi(2);
        let smaller = if ratio > 1.0 { under.sqrt() } else { cosine };
        let reflectance = r0 + (1.0 - r0) * (1.0 - smaller).powi(5);
        Ok((Ray { origin, direction, generation, inside }, reflectance))
    }
}

/// The share of pixels that differ by more than `most` codes.
pub fn share_of_differences(one: &[[u8; 3]], other: &[[u8; 3]], most: u8) -> f64 {
    let differs = |(one, other): &(&[u8; 3], &[u8; 3])| {
        one.iter().zip(other.iter()).any(|(one, other)| one.abs_diff(*other) > most)
    };
    one.iter().zip(other).filter(differs).count() as f64 / one.len().max(1) as f64
}
