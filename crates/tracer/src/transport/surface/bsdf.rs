//! What the surfaces that rays met do with light: bidirectional scattering distribution functions.
//!
//! The terms are in the units of the model: π·f·cos θ, so that a matte surface sends on k_d·C·(n̂·L̂) of a light. Smooth
//! surfaces reflect and refract along one direction each ([`BsdfDirac`]); rough ones along those of their facets, one of
//! which a [sample](Bsdf::sample_facet) chooses.

use crate::geometry::Geometry;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::sampling::Sample2D;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::surface::microfacet::{
    facet_pdf, reflected_density, sample_visible_normal, smith_g1, transmitted_density,
};
use crate::transport::surface::model::{MaterialModel, conductor};
use crate::transport::surface::{fresnel, mend_unit, phong_highlight, reflect, refract, schlick};

/// The surfaces that rays side by side met. Masks tell whose lobes count. Of rays that met nothing, the numbers mean
/// nothing.
#[derive(Clone, Copy)]
pub(crate) struct Bsdf<W: Width> {
    /// The bodies, whose materials know how much metals reflect.
    pub(crate) body: W::W,
    /// Unit normal on the viewer's side.
    pub(crate) normal: Vector<W::R>,
    /// k_a·C·I_a.
    pub(crate) ambient: Vector<W::R>,
    /// k_d·C.
    pub(crate) diffuse: Vector<W::R>,
    /// k_s.
    pub(crate) specular: W::R,
    /// Exponent n.
    pub(crate) shininess: W::R,
    /// k_r, or what is reflected under this angle; of dielectrics, only the interface tells.
    pub(crate) reflection: W::R,
    /// What surfaces that reflect in color reflect of each channel.
    pub(crate) tint: Vector<W::R>,
    /// k_t·τ.
    pub(crate) filter: Vector<W::R>,
    /// The index of air divided by that of a coat.
    pub(crate) coat_ratio: W::R,
    /// The width of the slopes of facets, α.
    pub(crate) alpha: W::R,
    /// Rays inside the bodies whose surfaces they met.
    pub(crate) inside: W::M,
    /// Surfaces that let rays through.
    pub(crate) transparent: W::M,
    /// Those that send on light of lights.
    pub(crate) scatters: W::M,
    /// Those with a highlight.
    pub(crate) glossy: W::M,
    /// Those whose coefficients depend on the angle by Schlick's formula.
    pub(crate) weighed: W::M,
    /// Boundaries of clear bodies.
    pub(crate) dielectric: W::M,
    /// Those of bodies that split light into its colors.
    pub(crate) disperses: W::M,
    /// Those of facets.
    pub(crate) rough: W::M,
    /// Those that reflect in color.
    pub(crate) tinted: W::M,
    /// Those under a coat.
    pub(crate) coated: W::M,
}

/// What surfaces send on to the viewer of light from one direction, for each unit of its power.
#[derive(Clone, Copy)]
pub(crate) struct BsdfValue<W: Width> {
    /// What the ground below scatters.
    pub(crate) diffuse: Vector<W::R>,
    /// Phong's highlight, with k_s.
    pub(crate) highlight: W::R,
    /// What facets send on.
    pub(crate) microfacets: Vector<W::R>,
    /// All of it.
    pub(crate) sum: Vector<W::R>,
}

/// What becomes of rays along single directions.
#[derive(Clone, Copy)]
pub(crate) struct BsdfDirac<W: Width> {
    /// The directions of refracted rays.
    pub(crate) refracted: Vector<W::R>,
    /// Those that are not totally reflected.
    pub(crate) passes: W::M,
    /// What is reflected.
    pub(crate) reflection: W::R,
    /// What passes, of each channel.
    pub(crate) filter: Vector<W::R>,
}

/// The surfaces that facets make up.
#[derive(Clone, Copy)]
pub(crate) struct Macrosurface<W: Width> {
    normal: Vector<W::R>,
    alpha: W::R,
    rough: W::M,
}

/// The materials of bodies by their places.
#[derive(Clone, Copy)]
pub(crate) struct BodyMaterials<'s> {
    pub(crate) geometry: &'s Geometry,
    pub(crate) materials: &'s [RenderMaterial],
}

impl<'s> BodyMaterials<'s> {
    #[inline(always)]
    fn of(self, body: u32) -> &'s RenderMaterial {
        &self.materials[self.geometry.body(body).material as usize]
    }
}

/// What a body's material finds at points of its surface.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceColors<R> {
    /// The color C.
    pub(crate) color: Vector<R>,
    /// The color that light takes on its way to and fro below a coat.
    pub(crate) ground: Vector<R>,
}

impl<W: Width> Bsdf<W> {
    /// Surfaces that send on nothing.
    #[inline(always)]
    pub(crate) fn black(w: W, body: W::W, inside: W::M) -> Self {
        let (zero, none) = (w.real(0.0), w.mask(0));
        let nothing = Vector::new(zero, zero, zero);
        Self {
            body,
            normal: nothing,
            ambient: nothing,
            diffuse: nothing,
            specular: zero,
            shininess: zero,
            reflection: zero,
            tint: nothing,
            filter: nothing,
            coat_ratio: w.real(1.0),
            alpha: zero,
            inside,
            transparent: none,
            scatters: none,
            glossy: none,
            weighed: none,
            dielectric: none,
            disperses: none,
            rough: none,
            tinted: none,
            coated: none,
        }
    }

    /// Takes up the material of a body that rays `lanes` met along `direction`, in even light of the strength `ambient`. The
    /// `FIRST` body may write the numbers of all rays; others write theirs even where they are 0.
    #[inline(always)]
    pub(crate) fn set_material<const FULL: bool, const FIRST: bool>(
        &mut self,
        w: W,
        (material, ambient): (&RenderMaterial, [f32; 3]),
        colors: SurfaceColors<W::R>,
        direction: Vector<W::R>,
        lanes: W::M,
    ) {
        let select = |own: Vector<W::R>, old| if FIRST { own } else { Vector::select(lanes, own, old) };
        let real = |own: f32, old| if FIRST { w.real(own) } else { W::R::select(lanes, w.real(own), old) };
        let has = |coefficient: f32| coefficient != 0.0;
        if has(material.ambient) || !FIRST {
            let even = ambient.map(|light| light * material.ambient);
            self.ambient = select(colors.color.times_all(even), self.ambient);
        }
        if has(material.diffuse) || !FIRST {
            self.diffuse = select(colors.color * w.real(material.diffuse), self.diffuse);
        }
        if has(material.specular) || !FIRST {
            self.specular = real(material.specular, self.specular);
            self.shininess = real(material.shininess, self.shininess);
        }
        if has(material.specular) {
            self.glossy = self.glossy | lanes;
        }
        if has(material.diffuse) || has(material.specular) {
            self.scatters = self.scatters | lanes;
        }
        self.reflection = real(material.reflection, self.reflection);
        if material.is_transparent() {
            self.transparent = self.transparent | lanes;
            self.filter = select(Vector::splat(w.real(0.0), material.filter), self.filter);
        }
        if FULL && !matches!(material.law, MaterialModel::Constant) {
            self.add_lobes(w, material, colors, ambient, direction, lanes);
        }
    }

    /// Takes up the lobes of a physical material.
    #[cold]
    #[inline(never)]
    fn add_lobes(
        &mut self,
        w: W,
        material: &RenderMaterial,
        colors: SurfaceColors<W::R>,
        ambient: [f32; 3],
        direction: Vector<W::R>,
        lanes: W::M,
    ) {
        w.run(
            #[inline(always)]
            || {
                if material.alpha > 0.0 {
                    self.rough = self.rough | lanes;
                    self.scatters = self.scatters | lanes;
                    self.alpha = W::R::select(lanes, w.real(material.alpha), self.alpha);
                }
                let cos = self.cos_to(direction);
                material.law.add_lobes(w, self, (material, colors, ambient), cos, lanes);
            },
        );
    }

    /// The cosine of the angle under which rays along `direction` meet the surfaces.
    #[inline(always)]
    fn cos_to(&self, direction: Vector<W::R>) -> W::R {
        let cos = -self.normal.dot(direction);
        cos.min(cos.like(1.0)).max(cos.like(0.0))
    }

    /// Takes up what surfaces reflect in color.
    #[inline(always)]
    pub(crate) fn set_tint(&mut self, tint: Vector<W::R>, lanes: W::M) {
        self.tinted = self.tinted | lanes;
        self.tint = Vector::select(lanes, tint, self.tint);
    }

    /// What is reflected of each channel, `reflection` of those that reflect all alike.
    #[inline(always)]
    pub(crate) fn reflectance(&self, reflection: W::R) -> Vector<W::R> {
        let mut reflected = Vector::new(reflection, reflection, reflection);
        if self.tinted.any() {
            reflected = Vector::select(self.tinted, self.tint, reflected);
        }
        reflected
    }

    /// Surfaces of facets of clear bodies: what they send on depends on the ratio of indices.
    #[inline(always)]
    pub(crate) fn rough_dielectric(&self) -> W::M {
        self.rough & self.dielectric
    }

    /// Those of them that are seen from within.
    #[inline(always)]
    pub(crate) fn rough_interior(&self) -> W::M {
        self.rough_dielectric() & self.inside
    }

    /// What surfaces send on to the viewer of light from these directions, under angles of these cosines to the normals.
    /// `ratio` is the index on the viewer's side divided by that on the other, for [`Self::rough_dielectric`].
    #[inline(always)]
    pub(crate) fn eval<const FULL: bool>(
        &self,
        w: W,
        materials: BodyMaterials<'_>,
        to_viewer: Vector<W::R>,
        (to_light, cos): (Vector<W::R>, W::R),
        ratio: W::R,
    ) -> BsdfValue<W> {
        let zero = w.real(0.0);
        let diffuse = if FULL { self.eval_diffuse(cos) } else { self.diffuse * cos };
        let nothing = Vector::new(zero, zero, zero);
        let mut value = BsdfValue { diffuse, highlight: zero, microfacets: nothing, sum: diffuse };
        if self.glossy.any() {
            value.highlight =
                self.specular * phong_highlight(to_viewer, to_light, self.normal, self.shininess);
            value.sum = value.sum.map(|diffuse| diffuse + value.highlight);
        }
        if FULL && self.rough.any() {
            value.microfacets = self.eval_microfacets(w, materials, to_viewer, to_light, ratio);
            value.sum = value.sum + value.microfacets;
        }
        value
    }

    /// What the ground scatters: k_d·C·(n̂·L̂), or what a coat leaves of it.
    #[inline(always)]
    fn eval_diffuse(&self, cos: W::R) -> Vector<W::R> {
        let all = self.diffuse * cos;
        if !self.coated.any() {
            return all;
        }
        let one = cos.like(1.0);
        let passed = one - fresnel(cos.min(one).max(cos.like(0.0)), self.coat_ratio);
        Vector::select(self.coated, all * passed, all)
    }

    /// What facets send on; nothing from smooth surfaces.
    #[inline(never)]
    fn eval_microfacets(
        &self,
        w: W,
        materials: BodyMaterials<'_>,
        to_viewer: Vector<W::R>,
        to_light: Vector<W::R>,
        ratio: W::R,
    ) -> Vector<W::R> {
        w.run(
            #[inline(always)]
            || {
                let (zero, one) = (w.real(0.0), w.real(1.0));
                let half = (to_viewer + to_light).normalize_or(self.normal);
                let facets = self.turned(w, materials, half, -to_viewer);
                let mut reflection = facets.reflection;
                let dielectric = self.rough_dielectric();
                if dielectric.any() {
                    let cos = half.dot(to_viewer).min(one).max(zero);
                    reflection = W::R::select(dielectric, fresnel(cos, ratio), reflection);
                }
                let sent = reflected_density(to_viewer, to_light, self.normal, half, self.alpha);
                let sent = W::R::select(self.rough, sent, zero);
                let mut all = facets.reflectance(reflection) * sent;
                let within = self.rough_interior();
                if within.any() {
                    let (sent, cos) =
                        transmitted_density(to_viewer, to_light, self.normal, ratio, self.alpha);
                    let sent = sent * (one - fresnel(cos, ratio));
                    all = Vector::select(within, Vector::new(sent, sent, sent), all);
                }
                // With the power of a light, their product is finite.
                all.bounded()
            },
        )
    }

    /// These surfaces in one sample, rough ones seen along `direction` as one of their facets, and what facets make up.
    #[inline(never)]
    pub(crate) fn sample_facet(
        &self,
        w: W,
        materials: BodyMaterials<'_>,
        direction: Vector<W::R>,
        sample: &Sample2D<W>,
    ) -> (Self, Macrosurface<W>) {
        w.run(
            #[inline(always)]
            || {
                let facet = sample_visible_normal(direction, self.normal, self.alpha, sample);
                let normal = Vector::select(self.rough, facet, self.normal);
                let macrosurface = Macrosurface { normal: self.normal, alpha: self.alpha, rough: self.rough };
                (self.turned(w, materials, normal, direction), macrosurface)
            },
        )
    }

    /// These surfaces with other normals, where they are rough: what they reflect of rays along `direction` is that of
    /// another angle.
    #[inline(always)]
    fn turned(
        &self,
        w: W,
        materials: BodyMaterials<'_>,
        normal: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> Self {
        let mut turned = Self { normal, ..*self };
        let cos = turned.cos_to(direction);
        let coated = self.rough & self.coated;
        if coated.any() {
            turned.reflection = W::R::select(coated, fresnel(cos, self.coat_ratio), self.reflection);
        }
        let tinted = self.rough & self.tinted;
        if tinted.any() {
            let mut bodies = [0; MOST_LANES];
            self.body.store(&mut bodies);
            let mut left = tinted.bits();
            while left != 0 {
                let index = bodies[left.trailing_zeros() as usize % MOST_LANES];
                let same = self.body.is(index) & tinted;
                left &= !same.bits();
                if let MaterialModel::Conductor(curve) = &materials.of(index).law {
                    turned.tint = Vector::select(same, conductor::reflectances(w, curve, cos), turned.tint);
                }
            }
        }
        turned
    }

    /// What becomes of rays along `direction` at the boundaries of `transparent` bodies, where the index on their side
    /// divided by that on the other is `ratio`.
    #[inline(always)]
    pub(crate) fn dirac<const FULL: bool>(
        &self,
        w: W,
        direction: Vector<W::R>,
        ratio: W::R,
        transparent: W::M,
    ) -> BsdfDirac<W> {
        let one = w.real(1.0);
        let (refracted, passes) = refract(direction, self.normal, ratio);
        let (mut reflection, mut filter) = (self.reflection, self.filter);
        let dielectric = transparent & self.dielectric;
        if FULL && dielectric.any() {
            let share = fresnel(self.cos_to(direction), ratio);
            reflection = W::R::select(dielectric, share, reflection);
            let rest = one - share;
            filter = Vector::select(dielectric, Vector::new(rest, rest, rest), filter);
        }
        // Total internal reflection: all of the light, and nothing twice.
        reflection = W::R::select(transparent & !passes, one, reflection);
        let weighed = transparent & self.weighed;
        if FULL && weighed.any() {
            let share = schlick(self.cos_to(direction), ratio);
            reflection = W::R::select(weighed, self.reflection * share, reflection);
            let both = weighed & self.reflection.gt(w.real(0.0));
            filter = Vector::select(both, filter * (one - share), filter);
        }
        BsdfDirac { refracted, passes, reflection, filter }
    }

    /// The directions of reflected rays.
    #[inline(always)]
    pub(crate) fn mirrored(&self, direction: Vector<W::R>) -> Vector<W::R> {
        mend_unit(reflect(direction, self.normal))
    }
}

impl<W: Width> Macrosurface<W> {
    /// What is left of the weight of rays that a facet sends this way, and which of them fly: none into the surface that
    /// they should leave, or out of the one that they should enter.
    #[inline(always)]
    pub(crate) fn masking(
        &self,
        direction: Vector<W::R>,
        is_beyond: bool,
        weight: Vector<W::R>,
    ) -> (Vector<W::R>, W::M) {
        let cos = self.normal.dot(direction);
        let cos = if is_beyond { -cos } else { cos };
        let flies = cos.gt(cos.like(0.0));
        let seen = W::R::select(self.rough, smith_g1(cos, self.alpha), cos.like(1.0));
        (weight * seen, flies | !self.rough)
    }

    /// The probability density, for each steradian, with which [`Bsdf::sample_facet`] sends on rays in `direction`; 0 where
    /// there is only one. `beyond` is as in [`facet_pdf`].
    #[inline(always)]
    pub(crate) fn pdf(&self, to_viewer: Vector<W::R>, direction: Vector<W::R>, beyond: Option<W::R>) -> W::R {
        let density = facet_pdf(to_viewer, direction, self.normal, self.alpha, beyond);
        W::R::select(self.rough, density, density.like(0.0))
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use catoptric_scene::Scene;

    use super::*;
    use crate::RenderScene;
    use crate::simd::scalar::ScalarWidth;

    type Direction = Vector<f32>;

    const NORMAL: Direction = Vector { x: 0.0, y: 0.0, z: 1.0 };

    fn rough(alpha: f32, inside: bool) -> Bsdf<ScalarWidth> {
        let black = Bsdf::black(ScalarWidth, 0, inside);
        Bsdf { normal: NORMAL, alpha, rough: true, scatters: true, reflection: 1.0, ..black }
    }

    fn direction(cos: f32, angle: f32) -> Direction {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        Vector::new(sin * angle.cos(), sin * angle.sin(), cos)
    }

    /// ∫ `value` dω over the half of all directions on the side of the normal, or on the other, by the midpoint rule.
    fn integral(is_beyond: bool, value: impl Fn(Direction) -> f32) -> f32 {
        const ROWS: u16 = 2000;
        const COLUMNS: u16 = 400;
        let mut sum = 0.0;
        for row in 0..ROWS {
            let cos = (f32::from(row) + 0.5) / f32::from(ROWS) * if is_beyond { -1.0 } else { 1.0 };
            let of_row: f32 = (0..COLUMNS)
                .map(|column| {
                    value(direction(cos, (f32::from(column) + 0.5) * 2.0 * PI / f32::from(COLUMNS)))
                })
                .sum();
            sum += f64::from(of_row);
        }
        (sum / f64::from(ROWS) / f64::from(COLUMNS)) as f32 * 2.0 * PI
    }

    /// The mean of `value` over samples of a facet.
    fn mean(
        bsdf: &Bsdf<ScalarWidth>,
        to_viewer: Direction,
        value: impl Fn(&Bsdf<ScalarWidth>, &Macrosurface<ScalarWidth>) -> f32,
    ) -> f32 {
        const ROWS: u16 = 500;
        const COLUMNS: u16 = 500;
        let scene = RenderScene::build(&Scene::default()).unwrap();
        let materials = scene.body_materials();
        let mut sum = 0.0;
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let angle = (f32::from(column) + 0.5) * 2.0 * PI / f32::from(COLUMNS);
                let second = (f32::from(row) + 0.5) / f32::from(ROWS);
                let sample = Sample2D { cos: angle.cos(), sin: angle.sin(), second };
                let (facet, macrosurface) = bsdf.sample_facet(ScalarWidth, materials, -to_viewer, &sample);
                sum += f64::from(value(&facet, &macrosurface));
            }
        }
        (sum / f64::from(ROWS) / f64::from(COLUMNS)) as f32
    }

    fn is_near(one: f32, other: f32) -> bool {
        (one - other).abs() < 3e-3 * one.abs().max(other.abs()).max(0.1)
    }

    /// For any function of directions, its mean over samples is its integral with their density; what facets send on is
    /// the mean of the weights of samples.
    #[test]
    fn samples_of_rough_mirrors_have_their_density_and_bring_what_eval_says() {
        let scene = RenderScene::build(&Scene::default()).unwrap();
        let materials = scene.body_materials();
        for (alpha, cos) in [(0.15, 0.9), (0.3, 0.5), (0.5, 1.0), (0.5, 0.3), (0.9, 0.7)] {
            let (bsdf, to_viewer) = (rough(alpha, false), direction(cos, 0.4));
            let surface: Macrosurface<ScalarWidth> = Macrosurface { normal: NORMAL, alpha, rough: true };
            for test in
                [|_: Direction| 1.0, |wi: Direction| wi.z * wi.z, |wi: Direction| (1.0 + wi.x) * (0.5 - wi.y)]
            {
                let sampled = mean(&bsdf, to_viewer, |facet, _| {
                    let wi = facet.mirrored(-to_viewer);
                    if wi.z > 0.0 { test(wi) } else { 0.0 }
                });
                let exact = integral(false, |wi| test(wi) * surface.pdf(to_viewer, wi, None));
                assert!(is_near(sampled, exact), "α {alpha}, cos {cos}: {sampled}, not {exact}");
            }
            let weight = mean(&bsdf, to_viewer, |facet, macrosurface| {
                let one = Vector::new(1.0, 1.0, 1.0);
                let (weight, flies) = macrosurface.masking(facet.mirrored(-to_viewer), false, one);
                if flies { weight.x } else { 0.0 }
            });
            let sent = integral(false, |wi| {
                bsdf.eval::<true>(ScalarWidth, materials, to_viewer, (wi, wi.z), 1.0).sum.x / PI
            });
            assert!(is_near(weight, sent), "α {alpha}, cos {cos}: {weight}, not {sent}");
            assert!(weight <= 1.0 + 1e-3, "no more than all is reflected");
        }
    }

    #[test]
    fn samples_through_rough_glass_have_their_density_and_bring_what_eval_says() {
        let scene = RenderScene::build(&Scene::default()).unwrap();
        let materials = scene.body_materials();
        for (alpha, cos, ratio) in
            [(0.3, 0.8, 1.0 / 1.5), (0.5, 0.5, 1.0 / 1.33), (0.4, 0.9, 1.5), (0.6, 0.6, 1.2)]
        {
            let bsdf = Bsdf { dielectric: true, transparent: true, ..rough(alpha, true) };
            let to_viewer = direction(cos, 1.1);
            let surface: Macrosurface<ScalarWidth> = Macrosurface { normal: NORMAL, alpha, rough: true };
            let passes = mean(&bsdf, to_viewer, |facet, _| {
                let dirac = facet.dirac::<true>(ScalarWidth, -to_viewer, ratio, true);
                if dirac.passes && dirac.refracted.z < 0.0 { 1.0 } else { 0.0 }
            });
            let exact = integral(true, |wi| surface.pdf(to_viewer, wi, Some(ratio)));
            assert!(is_near(passes, exact), "α {alpha}, cos {cos}, {ratio}: {passes}, not {exact}");
            let weight = mean(&bsdf, to_viewer, |facet, macrosurface| {
                let dirac = facet.dirac::<true>(ScalarWidth, -to_viewer, ratio, true);
                let (weight, flies) = macrosurface.masking(dirac.refracted, true, dirac.filter);
                if flies && dirac.passes { weight.x } else { 0.0 }
            });
            let sent = integral(true, |wi| {
                bsdf.eval::<true>(ScalarWidth, materials, to_viewer, (wi, wi.z), ratio).sum.x / PI
            });
            assert!(is_near(weight, sent), "α {alpha}, cos {cos}, {ratio}: {weight}, not {sent}");
        }
    }
}
