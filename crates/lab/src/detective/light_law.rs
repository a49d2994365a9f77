//! The law of light with its faults.

use catoptric_scene::{Falloff, Light, Projection, Scene};
use catoptric_tracer::RayKind;
use glam::{DVec3, Vec3};

use super::faults::{Fault, FaultSet};
use super::light_tree::{DarkSide, LightSample, PhongPoint, TreeNode};

/// The law by which the light of rays is summed up: a list of faults, and what they need of the scene.
pub(super) struct LightLaw<'a> {
    faults: Vec<Fault>,
    generations: u32,
    exponent_factor: f32,
    lights: Vec<&'a Light>,
    background: Vec3,
    /// Where the eye looks, if its rays spread.
    ahead: Option<Vec3>,
    /// Whether no light shines but ambient light.
    is_dark: bool,
}

fn color(color: catoptric_scene::Color) -> Vec3 {
    DVec3::from(color.to_array()).as_vec3()
}

impl<'a> LightLaw<'a> {
    /// The law of a scene with these faults.
    pub(super) fn new(scene: &'a Scene, faults: &FaultSet) -> Self {
        let is_perspective = matches!(scene.camera.projection, Projection::Perspective { .. });
        let ahead = (scene.camera.target - scene.camera.position).normalize_or(DVec3::NEG_Z).as_vec3();
        Self {
            faults: faults.iter().collect(),
            generations: faults.generations(scene.tracing.generations),
            exponent_factor: faults.exponent_factor(),
            lights: scene.lights.iter().filter(|light| !light.hidden).collect(),
            background: color(scene.environment.background),
            ahead: is_perspective.then_some(ahead),
            is_dark: false,
        }
    }

    /// The law with all lights out but the ambient one: what a point has that wrongly lies in its own shadow.
    pub(super) fn darkened(self) -> Self {
        Self { is_dark: true, ..self }
    }

    fn has(&self, fault: Fault) -> bool {
        self.faults.contains(&fault)
    }

    /// The coefficient of a ray; `None` if it is left out. The sender is the point that sent it on, with its lights.
    pub(super) fn coefficient(
        &self,
        node: &TreeNode,
        sender: Option<(&PhongPoint, &[LightSample])>,
    ) -> Option<Vec3> {
        let most = self.generations.saturating_add(u32::from(self.has(Fault::BackgroundAtLast)));
        let own = if self.has(Fault::UnweighedBodies) { node.unweighed } else { node.coefficient };
        if node.generation > most {
            return None;
        }
        if self.faults.is_empty() || node.kind == RayKind::Primary {
            return Some(own);
        }
        if self.has(Fault::NoReflectionInShadow)
            && sender.is_some_and(|(_, lights)| lights.iter().any(is_hidden))
        {
            return None;
        }
        let is_refracted = node.kind == RayKind::Refracted;
        if is_refracted {
            let is_left_out = self.has(Fault::NoRefraction) || self.has(Fault::OpaqueBodies);
            let tint = sender.map_or(Vec3::ONE, |(sender, _)| sender.tint);
            let is_untinted = self.has(Fault::UntintedBodies) && tint.max_element() > 0.0;
            // The channel with the most light has lost the least of its digits.
            let whole = if is_untinted { Vec3::splat(own.max_element() / tint.max_element()) } else { own };
            return (!is_left_out).then_some(whole);
        }
        let is_left_out = self.has(Fault::NoReflection)
            || node.is_total && self.has(Fault::TotalBlack)
            || node.is_inside && self.has(Fault::NoInnerReflection);
        let own = match sender {
            Some((sender, _)) if self.has(Fault::TintedReflection) => own * self.color(sender),
            Some(_) if self.has(Fault::WholeReflection) => Vec3::ONE,
            _ => own,
        };
        (!is_left_out).then_some(own)
    }

    /// The light that a ray brings whatever it meets, if that is a fault.
    pub(super) fn instead_of(&self, node: &TreeNode) -> Option<Vec3> {
        if node.generation > self.generations {
            return Some(self.background);
        }
        let is_lost = node.body.is_none() && node.generation > 1 && self.has(Fault::BlackBackground);
        is_lost.then_some(Vec3::ZERO)
    }

    /// The light of a ray before it is weighted.
    pub(super) fn of_ray(&self, light: Vec3) -> Vec3 {
        if self.has(Fault::ClampedRays) {
            light.min(Vec3::ONE)
        } else if self.has(Fault::RoundedRays) {
            (light.min(Vec3::ONE) * 255.0).floor() / 255.0
        } else {
            light
        }
    }

    /// How long the direction of a primary ray is that goes to a window at distance 1, its direction back being this.
    pub(super) fn primary_length(&self, view: Option<Vec3>) -> f32 {
        match (view, self.ahead) {
            (Some(view), Some(ahead)) => (-view.dot(ahead)).max(1e-3).recip(),
            _ => 1.0,
        }
    }

    fn color(&self, point: &PhongPoint) -> Vec3 {
        // A channel of 255 of 255 stays.
        if self.has(Fault::IntegerColors) { (point.color + 1e-4).floor() } else { point.color }
    }

    /// The ambient light of a point, with what reaches it of the lamps.
    fn ambient(&self, point: &PhongPoint, lights: &[LightSample]) -> Vec3 {
        let own = point.ambient * point.ambient_light;
        let reaches = |sample: &LightSample| sample.is_above && !is_hidden(sample);
        let sum = |light: &Light| light.intensity as f32 * color(light.color);
        let times = match () {
            () if self.has(Fault::NoAmbient) => return Vec3::ZERO,
            () if self.has(Fault::UncoloredAmbient) => return own,
            () if self.has(Fault::WholeAmbient) => return self.color(point) * point.ambient_light,
            () if self.has(Fault::AmbientPerLamp) => Vec3::splat(self.lights.len() as f32),
            () if self.has(Fault::AmbientPerLitLamp) => {
                Vec3::splat(lights.iter().filter(|sample| reaches(sample)).count() as f32)
            }
            () if self.has(Fault::AmbientOfLamps) => self.lights.iter().map(|light| sum(light)).sum(),
            () if self.has(Fault::NoAmbientInShadow) => {
                Vec3::splat(f32::from(u8::from(!lights.iter().any(is_hidden))))
            }
            () if self.has(Fault::NoAmbientInDark) => {
                Vec3::splat(f32::from(u8::from(lights.iter().any(reaches))))
            }
            () => Vec3::ONE,
        };
        times * own * self.color(point)
    }

    /// The local light of a point; `stretch` is the length of the primary ray's direction.
    pub(super) fn local(&self, point: &PhongPoint, lights: &[LightSample], stretch: f32) -> Vec3 {
        let ambient = self.ambient(point, lights);
        let last = self.lights.len().saturating_sub(1);
        let shining = lights.iter().filter(|sample| {
            !(self.is_dark
                || self.has(Fault::FirstLightOnly) && sample.light != 0
                || self.has(Fault::LastLightOnly) && sample.light != last)
        });
        let first = lights.iter().find(|sample| sample.light == 0).map(|first| self.passed(first));
        let mut lamps: Vec3 = shining
            .map(|sample| {
                let passed = match first {
                    Some(first) if self.has(Fault::FirstShadowForAll) && sample.is_above => first,
                    _ => self.passed(sample),
                };
                self.lamp(point, sample, passed, stretch)
            })
            .sum();
        if self.has(Fault::AveragedLamps) {
            lamps /= self.lights.len().max(1) as f32;
        }
        if self.has(Fault::OneShadowForAll) && lights.iter().any(is_hidden) {
            lamps = Vec3::ZERO;
        }
        let mut light = ambient + lamps;
        if self.has(Fault::BlendedReflection) {
            light *= 1.0 - point.reflection.min(1.0);
        } else if self.has(Fault::AddedReflection) {
            light /= (1.0 - point.reflection).max(0.05);
        }
        if self.has(Fault::ClampedLocal) { light.min(Vec3::ONE) } else { light }
    }

    /// What of a lamp's light reaches a point.
    fn passed(&self, sample: &LightSample) -> Vec3 {
        let are_opaque = self.has(Fault::OpaqueShadows) || self.has(Fault::OpaqueBodies);
        match () {
            () if self.has(Fault::NoShadows) => Vec3::ONE,
            // A point on the dark side lies in its body's own shadow.
            () if !sample.is_above => Vec3::ZERO,
            () if are_opaque && sample.passed.min_element() < 1.0 - 1e-4 => Vec3::ZERO,
            () if self.has(Fault::ClearShadows) && !sample.is_blocked => Vec3::ONE,
            () => sample.passed,
        }
    }

    /// What a point sends on of a light.
    fn lamp(&self, point: &PhongPoint, sample: &LightSample, passed: Vec3, stretch: f32) -> Vec3 {
        let normal = match point.wrong_normals {
            [turned, _] if self.has(Fault::ScaledNormals) => turned,
            [_, unscaled] if self.has(Fault::UnscaledNormals) => unscaled,
            _ => point.normal,
        };
        let cosine = normal.dot(sample.direction);
        let is_lit = cosine > 0.0 || point.dark_side != DarkSide::Dark;
        let Some(light) = self.lights.get(sample.light).filter(|_| is_lit) else { return Vec3::ZERO };
        let counted = match point.dark_side {
            DarkSide::Magnitude => cosine.abs(),
            DarkSide::Negative => cosine,
            DarkSide::Dark | DarkSide::Highlight => cosine.max(0.0),
        };
        let spread = match () {
            () if self.has(Fault::NoDiffuse) => 0.0,
            () if self.has(Fault::EvenDiffuse) => point.diffuse,
            () if self.has(Fault::WholeDiffuse) => counted,
            () if self.has(Fault::LongLampVector) => point.diffuse * counted * sample.distance,
            () => point.diffuse * counted,
        };
        let has_highlight = cosine > 0.0 || point.dark_side != DarkSide::Negative;
        let highlight = if has_highlight { self.highlight(point, sample, normal, stretch) } else { 0.0 };
        let own = self.color(point);
        let tint = if self.has(Fault::ColoredHighlight) { own } else { Vec3::ONE };
        let seen = if self.has(Fault::HighlightInShadow) { Vec3::ONE } else { passed };
        let shine = if self.has(Fault::WhiteLights) { Vec3::ONE } else { color(light.color) };
        let glare = if self.has(Fault::WhiteHighlight) { Vec3::ONE } else { shine };
        let light = self.power(light, point, sample.distance)
            * (spread * own * shine * passed + highlight * tint * glare * seen);
        if self.has(Fault::ClampedLamps) { light.min(Vec3::ONE) } else { light }
    }

    fn highlight(&self, point: &PhongPoint, sample: &LightSample, normal: Vec3, stretch: f32) -> f32 {
        if point.specular <= 0.0 || self.has(Fault::NoHighlight) {
            return 0.0;
        }
        let long_lamp = self.has(Fault::LongLampInHighlight) || self.has(Fault::LongLampVector);
        let lamp = if long_lamp { sample.direction * sample.distance } else { sample.direction };
        let view = match () {
            () if self.has(Fault::LongEyeVector) => point.to_eye,
            () if self.has(Fault::EyeForAllRays) => point.to_eye.normalize_or_zero(),
            () if self.has(Fault::LongWayBack) => point.view * point.way,
            () if self.has(Fault::LongPrimaryRays) => point.view * stretch,
            () => point.view,
        };
        let cosine = if self.has(Fault::HalfwayHighlight) {
            (lamp + view).normalize_or_zero().dot(normal)
        } else {
            (2.0 * normal.dot(lamp) * normal - lamp).dot(view)
        };
        let coefficient = if self.has(Fault::WholeHighlight) { 1.0 } else { point.specular };
        let highlight = coefficient * cosine.max(0.0).powf(self.exponent_factor * point.shininess);
        // As bright as no picture can show, so that sums stay finite.
        let highlight = highlight.min(1e6);
        if self.has(Fault::SquaredHighlight) { highlight * highlight } else { highlight }
    }

    /// What a light of its intensity sends to a point at this distance, without its color.
    fn power(&self, light: &Light, point: &PhongPoint, distance: f32) -> f32 {
        let intensity = if self.has(Fault::FullLights) { 1.0 } else { light.intensity as f32 };
        let law = match () {
            () if self.has(Fault::NoFalloff) => Falloff::None,
            () if self.has(Fault::LinearFalloff) => Falloff::Linear { constant: 0.0 },
            () if self.has(Fault::SquareFalloff) => Falloff::InverseSquare,
            () => light.falloff,
        };
        let distance = match () {
            () if self.has(Fault::FalloffOfSquare) => distance * distance,
            () if self.has(Fault::FalloffFromEye) => point.to_eye.length(),
            () => distance,
        };
        let falloff = match law {
            Falloff::None => 1.0,
            Falloff::Linear { constant } => (distance + constant as f32).max(1e-6).recip(),
            Falloff::InverseSquare => (distance * distance).max(1e-12).recip(),
        };
        intensity * falloff
    }
}

/// Whether something stands between a point and a lamp above it.
fn is_hidden(sample: &LightSample) -> bool {
    sample.is_above && sample.passed == Vec3::ZERO
}
