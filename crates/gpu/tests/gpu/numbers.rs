//! Numbers that look random, and scenes made of them.

use catoptric_scene::{
    Attenuation, Body, Coated, Color, Conductor, Dielectric, Falloff, FresnelTerm, Light, Material,
    MaterialChoice, Matte, MetalOptics, Mirror, Pattern, Phong, Placement, RefractiveIndex, Scene, Shadow,
    Shape, SolidKind, SolidTexture,
};
use glam::DVec3;

/// A sequence of numbers that look random (G. Marsaglia 2003, Xorshift RNGs).
pub(crate) struct Numbers(pub(crate) u32);

impl Numbers {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    pub(crate) fn below(&mut self, end: u32) -> u32 {
        self.next() % end
    }

    /// From `low` to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.next() >> 8) / f64::from(1 << 24)
    }

    pub(crate) fn point(&mut self, reach: f64) -> DVec3 {
        DVec3::from([0; 3].map(|_| self.between(-reach, reach)))
    }

    fn color(&mut self) -> Color {
        let [r, g, b] = [0; 3].map(|_| self.between(0.2, 1.0));
        Color { r, g, b }
    }

    /// Smooth, or not.
    fn roughness(&mut self) -> f64 {
        if self.below(2) == 0 { 0.0 } else { self.between(0.05, 0.9) }
    }

    /// A checkerboard as often as any other pattern.
    fn solid(&mut self) -> SolidTexture {
        let plain = SolidTexture { size: 0.3, ..SolidTexture::new(SolidKind::Checker, self.color()) };
        if self.below(2) == 0 {
            return plain;
        }
        let kind = SolidKind::ALL[self.below(4) as usize];
        let outer = SolidTexture { kind, rotation_degrees: self.point(90.0), ..plain.clone() };
        match self.below(3) {
            0 => outer,
            1 => SolidTexture { first: Some(Box::new(plain)), ..outer },
            _ => {
                SolidTexture { second: Some(Box::new(SolidTexture { size: 0.1, ..outer.clone() })), ..outer }
            }
        }
    }

    pub(crate) fn material(&mut self) -> Material {
        let solid = (self.below(2) == 0).then(|| self.solid());
        let pattern = Pattern { color: self.color(), solid, texture: None };
        let roughness = self.roughness();
        match self.below(8) {
            0 => Conductor { roughness, ..Conductor::default() }.into(),
            1 => {
                let [n, k] = [0.2, 3.0].map(|most| DVec3::from([0; 3].map(|_| self.between(0.1, most))));
                Conductor { metal: MetalOptics::Index { n, k }, roughness }.into()
            }
            2 => Mirror { pattern, reflection: Some(0.9), roughness }.into(),
            3 => Coated { pattern, ior: self.between(1.0, 2.5), roughness, ..Coated::default() }.into(),
            4 => Matte { pattern, ..Matte::default() }.into(),
            5 => {
                let fresnel = FresnelTerm::ALL[self.below(2) as usize];
                Phong { pattern, specular: 0.4, transmission: 0.5, ior: 1.4, fresnel, ..Phong::default() }
                    .into()
            }
            _ => self.glass(roughness).into(),
        }
    }

    pub(crate) fn glass(&mut self, roughness: f64) -> Dielectric {
        // An index of 1 is no surface at all.
        let ior = [1.0, 1.2, 1.5, 2.4][self.below(4) as usize];
        let dispersion = self.below(2) == 0;
        let index = RefractiveIndex::Own { ior, abbe: self.between(5.0, 60.0) };
        let attenuation = Attenuation { color: self.color(), distance: self.between(0.2, 3.0) };
        Dielectric { index, dispersion, attenuation, roughness }
    }

    fn body(&mut self) -> Body {
        let size = self.between(0.3, 0.9);
        let shape = match self.below(3) {
            0 => Shape::Cube { size: DVec3::splat(1.6 * size) },
            1 => Shape::Cylinder { radius: size, height: 1.5 * size },
            _ => Shape::Sphere { radius: size },
        };
        Body {
            shape,
            placement: Placement::at(self.point(1.6)),
            material: MaterialChoice::Inline(Box::new(self.material())),
            shadow: [Shadow::Filtered, Shadow::Filtered, Shadow::None, Shadow::Full][self.below(4) as usize],
            ..Body::default()
        }
    }

    fn light(&mut self) -> Light {
        let falloffs = [Falloff::None, Falloff::Linear { constant: 2.0 }, Falloff::InverseSquare];
        Light {
            position: self.point(2.0) + DVec3::new(0.0, 3.0, 2.0),
            color: self.color(),
            falloff: falloffs[self.below(3) as usize],
            radius: [0.0, 0.6][self.below(2) as usize],
            ..Light::default()
        }
    }

    pub(crate) fn scene(&mut self, bodies: usize) -> Scene {
        let floor = Body {
            shape: Shape::Plane,
            placement: Placement::at(DVec3::new(0.0, -1.8, 0.0)),
            material: MaterialChoice::Inline(Box::new(self.material())),
            ..Body::default()
        };
        let mut scene = Scene {
            bodies: (0..bodies).map(|_| self.body()).chain([floor]).collect(),
            lights: (0..2).map(|_| self.light()).collect(),
            ..Scene::default()
        };
        scene.camera.position = DVec3::new(0.5, 1.0, 6.0);
        scene.camera.target = DVec3::ZERO;
        scene.environment.background = self.color();
        scene.environment.ambient = self.color();
        (scene.tracing.generations, scene.tracing.threshold) = (5, 0.01);
        scene
    }
}
