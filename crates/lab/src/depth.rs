//! The depth to which a scene needs to be traced, and materials that give more light than they get.

use catoptric_optics::fresnel;
use catoptric_scene::{Body, Camera, Material, MaterialChoice, Pattern, Projection, Scene, Tracing};
use catoptric_tracer::{RenderCamera, RenderControl, RenderError, RenderScene, WhittedIntegrator};
use glam::{DVec3, UVec2};
use rayon::prelude::*;

use crate::maps::{DEEPEST, LIGHTEST};

/// Light that may be missing: 1/512 of white, half a step of a display with 8 bits where it is linear.
pub const ALLOWED_LOSS: f64 = 1.0 / 512.0;

/// The bound on the generations that a scene needs, known before it is traced.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthBound {
    /// k: of the light of a generation, what the next can have at most, in the long run.
    pub factor: f64,
    /// The bodies whose mirrors make the strongest cycle, by their place in the scene: two that face each other, or one
    /// that reflects within itself; none without mirrors.
    pub cycle: Vec<usize>,
    /// Generations that leave out less than [`ALLOWED_LOSS`] of the brightest light that a ray can bring; `None` if
    /// that is more than 64, or the series has no bound (k ≥ 1).
    pub generations: Option<u32>,
}

impl DepthBound {
    /// The bound for a scene and its scene.
    ///
    /// The weights of a generation sum to at most k times those of the one before, and the rest of the series
    /// kᴳ + kᴳ⁺¹ + … = kᴳ/(1 − k) is what G generations leave out (Whitted's tree; the series of two mirrors).
    /// Simple bodies are convex: seen from outside, no ray meets the same one twice in a row, so that two opaque mirrors
    /// bring k₁·k₂ in two generations. Within a body (the eye in a hollow mirror) it is k₁ each time. A surface of a
    /// transparent body brings k_r + k_t·τ, or 1 at total internal reflection.
    pub fn of(scene: &Scene, render_scene: &RenderScene) -> Self {
        let mut opaque: Vec<(f64, usize)> = Vec::new();
        let mut clear: Option<(f64, usize)> = None;
        for (place, body) in scene.bodies.iter().enumerate().filter(|(_, body)| !body.hidden) {
            for material in body.materials().filter_map(|choice| scene.material(choice)) {
                let (reflection, passes) = (material.reflects().most, material.lets_through().most);
                if passes > 0.0 {
                    let factor = match material {
                        // What is not reflected passes.
                        Material::Dielectric(_) => 1.0,
                        // The shares of both are those of one light.
                        Material::Phong(phong) if phong.weighs_by_angle() => reflection.max(passes),
                        _ if material.ior() == Some(1.0) => reflection + passes,
                        _ => (reflection + passes).max(1.0),
                    };
                    if clear.is_none_or(|(most, _)| factor > most) {
                        clear = Some((factor, place));
                    }
                } else if reflection > 0.0 {
                    // A ray may go from one part of a body to another.
                    let count = if body.shape.is_compound() { 2 } else { 1 };
                    opaque.extend([(reflection, place)].repeat(count));
                    opaque.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
                    opaque.truncate(2);
                }
            }
        }
        let is_within = starts_within(scene, render_scene);
        let (first, second) = (opaque.first().copied(), opaque.get(1).copied());
        let (mirrors, pair) = match (first, second) {
            (Some((k, body)), _) if is_within || clear.is_some() => ([k, k], vec![body]),
            (Some((k, body)), Some((other, beside))) if body == beside => ([k, other], vec![body]),
            (Some((k, body)), Some((other, beside))) => ([k, other], vec![body, beside]),
            (Some((k, body)), None) => ([k, 0.0], vec![body]),
            (None, _) => ([0.0, 0.0], Vec::new()),
        };
        match clear {
            Some((factor, body)) if factor >= mirrors[0] => Self::series([factor; 2], vec![body]),
            _ => Self::series(mirrors, pair),
        }
    }

    /// The bound where generations bring these factors by turns.
    fn series(factors: [f64; 2], cycle: Vec<usize>) -> Self {
        let [odd, even] = factors;
        let factor = (odd * even).sqrt();
        // What the generations behind the first bring, 1 + odd + odd·even + … being all: two series of odd·even.
        let rest = |weight: f64, next: f64| weight * (1.0 + next) / (1.0 - odd * even);
        let mut weight = 1.0;
        let mut generations = None;
        for generation in 1..=Tracing::MAX_GENERATIONS {
            let (now, next) = if generation % 2 == 1 { (odd, even) } else { (even, odd) };
            weight *= now;
            if factor < 1.0 && rest(weight, next) < ALLOWED_LOSS {
                generations = Some(generation);
                break;
            }
        }
        Self { factor, cycle, generations }
    }
}

/// Whether rays may start within a body: always assumed where they start all over a window.
fn starts_within(scene: &Scene, render_scene: &RenderScene) -> bool {
    let Camera { position, target, projection, .. } = scene.camera;
    if matches!(projection, Projection::Parallel { .. }) {
        return true;
    }
    let view = (target - position).normalize_or(DVec3::NEG_Z).as_vec3();
    // Who stands in a body sees its inside before or behind.
    [view, -view].iter().any(|&direction| {
        let hits = render_scene.hits_along(&render_scene.ray_from_point(position, direction));
        hits.iter().any(|hit| hit.from_within)
    })
}

/// The generations that a scene needs, measured by tracing.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthMeasure {
    /// The least limit at which no pixel that was tried misses more than [`ALLOWED_LOSS`] in any channel.
    pub generations: u32,
    /// The most light that any of the pixels misses, by the limit of generations: the first is for one generation.
    pub losses: Vec<f64>,
    /// How many pixels were tried.
    pub pixels: usize,
    /// Whether all their rays were followed; otherwise more generations may be needed.
    pub is_complete: bool,
}

impl DepthMeasure {
    /// Pixels that are tried at most.
    const PIXELS: u32 = 2000;
    /// Rays of a pixel that are followed at most.
    const RAYS: usize = 1 << 12;

    /// Traces pixels spread over a picture of `size` pixels with [`DEEPEST`] generations, leaving out rays that carry
    /// less than [`LIGHTEST`] or the scene's threshold, on the threads of the current rayon pool.
    ///
    /// # Errors
    /// When `control` is cancelled.
    pub fn of(
        render_scene: &RenderScene,
        camera: &RenderCamera,
        size: UVec2,
        control: &RenderControl,
    ) -> Result<Self, RenderError> {
        let threshold = render_scene.threshold().max(LIGHTEST);
        let count = f64::from(size.x) * f64::from(size.y);
        let step = (count / f64::from(Self::PIXELS)).sqrt().ceil().max(1.0) as usize;
        let rows: Vec<u32> = (0..size.y).skip(step / 2).step_by(step).collect();
        let measured = rows.par_iter().map_init(
            || WhittedIntegrator::watched(render_scene, camera, control).with_limits(DEEPEST, threshold),
            |tracer, &y| {
                let mut row = Self::nothing();
                for x in (0..size.x).skip(step / 2).step_by(step) {
                    row.add(&tracer.pixel_tally(UVec2::new(x, y), size, 0, Self::RAYS));
                }
                row
            },
        );
        let mut all = measured.reduce(Self::nothing, |all, other| all.together(&other));
        if control.is_cancelled() {
            return Err(RenderError::Cancelled);
        }
        let needed = all.losses.iter().rposition(|&loss| loss >= ALLOWED_LOSS).map_or(1, |place| place + 2);
        all.generations = needed.min(DEEPEST as usize) as u32;
        Ok(all)
    }

    fn nothing() -> Self {
        Self { generations: 1, losses: Vec::new(), pixels: 0, is_complete: true }
    }

    fn add(&mut self, tally: &catoptric_tracer::PixelStatistics) {
        let depth = tally.generations.len();
        if self.losses.len() < depth {
            self.losses.resize(depth, 0.0);
        }
        let mut behind = DVec3::ZERO;
        for (loss, light) in self.losses.iter_mut().zip(&tally.generations).rev() {
            *loss = loss.max(behind.max_element());
            behind += light;
        }
        self.pixels += 1;
        self.is_complete &= tally.is_complete;
    }

    fn together(mut self, other: &Self) -> Self {
        if self.losses.len() < other.losses.len() {
            self.losses.resize(other.losses.len(), 0.0);
        }
        self.losses.iter_mut().zip(&other.losses).for_each(|(loss, other)| *loss = loss.max(*other));
        self.pixels += other.pixels;
        self.is_complete &= other.is_complete;
        self
    }
}

/// A material that sends on more light than falls on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Excess {
    /// The material's name, or that of the body whose own it is; `None` for a body without a name.
    pub name: Option<String>,
    /// The place in the scene of the first body that is made of it, if any is.
    pub body: Option<usize>,
    /// What there is too much of.
    pub kind: ExcessKind,
    /// How much is sent on of 1.
    pub amount: f64,
}

/// The kind of excess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExcessKind {
    /// k_d·C + k_r + k_t·τ in this channel (0 red, 1 green, 2 blue): the one with the most.
    Surface {
        /// Which channel.
        channel: usize,
        /// k_d·C, the brightest color of a pattern.
        diffuse: f64,
        /// k_r.
        reflection: f64,
        /// k_t·τ.
        transmission: f64,
    },
    /// The highlight: 2·k_s/(n + 2).
    Highlight,
}

/// The materials that send on more than they get, each once, in the order of the scene.
///
/// A diffuse surface with k_d·C = 1 sends on all of the light, so light of strength 1 from straight ahead brings the
/// power π to a unit of area. Of it the highlight sends k_s·∫cosⁿθ·cosθ dω = 2π·k_s/(n + 2) over the half-space
/// (Lafortune and Willems 1994, Using the modified Phong reflectance model, eq. 7, give the factor (n + 2)/2π that
/// makes it 1), the share 2·k_s/(n + 2).
pub fn excesses(scene: &Scene) -> Vec<Excess> {
    let named = scene.materials.iter().map(|named| (&named.material, Some(named.name.clone()), None));
    let own = scene.bodies.iter().enumerate().flat_map(|(place, body)| {
        body.materials().filter_map(move |choice| match choice {
            MaterialChoice::Inline(material) => {
                Some((&**material, (!body.name.is_empty()).then(|| body.name.clone()), Some(place)))
            }
            MaterialChoice::Named(_) => None,
        })
    });
    let mut seen: Vec<&Material> = Vec::new();
    let mut found = Vec::new();
    for (material, name, body) in named.chain(own) {
        let mut excesses = excess_of(material).peekable();
        if excesses.peek().is_none() || seen.len() == MOST_EXCESSES || seen.contains(&material) {
            continue;
        }
        seen.push(material);
        let uses = |body: &Body| name.as_deref().is_some_and(|name| body.uses_material(name));
        let of_name = || scene.bodies.iter().position(uses);
        let body = body.or_else(of_name);
        found.extend(excesses.map(|(kind, amount)| Excess { name: name.clone(), body, kind, amount }));
    }
    found
}

/// The most materials that are named.
const MOST_EXCESSES: usize = 64;

/// What there is too much of in one material, beyond rounding.
pub fn excess_of(material: &Material) -> impl Iterator<Item = (ExcessKind, f64)> {
    const ALL: f64 = 1.0 + 1e-9;
    let brightest = |pattern: &Pattern| DVec3::from_array(pattern.brightest().to_array());
    let (diffuse, reflection, transmission) = match material {
        Material::Phong(phong) => {
            let diffuse = phong.diffuse * brightest(&phong.pattern);
            let reflection = DVec3::splat(phong.reflection());
            let transmission = phong.transmission * DVec3::from_array(phong.tint.to_array());
            // Of what is weighed by the angle the stronger one counts at most.
            match phong.weighs_by_angle() {
                true if reflection.x >= transmission.max_element() => (diffuse, reflection, DVec3::ZERO),
                true => (diffuse, DVec3::ZERO, transmission),
                false => (diffuse, reflection, transmission),
            }
        }
        Material::Mirror(mirror) => {
            (DVec3::ZERO, mirror.reflection() * brightest(&mirror.pattern), DVec3::ZERO)
        }
        Material::Matte(matte) => (brightest(&matte.pattern), DVec3::ZERO, DVec3::ZERO),
        // They take from one what they give to the other, and a coat knows no ground brighter than white.
        Material::Dielectric(_) | Material::Conductor(_) | Material::Coated(_) => {
            (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO)
        }
        Material::ThinDielectric(sheet) => {
            let reflected = fresnel::sheet(1.0, sheet.ior).mean();
            let passed = (1.0 - reflected) * DVec3::from_array(sheet.tint.to_array());
            (DVec3::ZERO, DVec3::splat(reflected), passed)
        }
    };
    let parts = diffuse.to_array().into_iter().zip(reflection.to_array()).zip(transmission.to_array());
    let channels = parts.enumerate().map(|(channel, ((diffuse, reflection), transmission))| {
        let kind = ExcessKind::Surface { channel, diffuse, reflection, transmission };
        (kind, diffuse + reflection + transmission)
    });
    let most = channels.reduce(|most, next| if next.1 > most.1 { next } else { most });
    let highlight = match material {
        Material::Phong(phong) => 2.0 * phong.specular / (phong.shininess + 2.0),
        Material::Dielectric(_)
        | Material::Conductor(_)
        | Material::Mirror(_)
        | Material::Matte(_)
        | Material::Coated(_)
        | Material::ThinDielectric(_) => 0.0,
    };
    most.into_iter().chain([(ExcessKind::Highlight, highlight)]).filter(|(_, amount)| *amount > ALL)
}
