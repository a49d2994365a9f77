//! The curve ω(i, λ) of a material: how much it reflects, by angle and color.

use catoptric_optics::fresnel;
use catoptric_scene::{Material, MetalOptics};

/// A curve of reflectance.
#[derive(Clone, Debug, PartialEq)]
pub struct ReflectanceCurve {
    /// What it is of.
    pub kind: CurveKind,
    law: ReflectanceLaw,
}

/// The light that a curve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// Red light.
    Red,
    /// Green light.
    Green,
    /// Blue light.
    Blue,
    /// Light of all colors that comes to a clear surface from outside.
    FromOutside,
    /// Light of all colors that comes to a clear surface from inside.
    FromInside,
}

#[derive(Clone, Debug, PartialEq)]
enum ReflectanceLaw {
    Clear(f64),
    Sheet(f64),
    Metal([f64; 2]),
    /// Half degrees from 0 to 90.
    Measured(Vec<f64>),
}

impl CurveKind {
    /// Whether it is of light that comes from within.
    pub fn is_from_inside(self) -> bool {
        self == Self::FromInside
    }
}

impl ReflectanceCurve {
    /// The share of unpolarized light that is reflected under an angle of incidence in degrees, 0 to 90.
    pub fn at(&self, degrees: f64) -> f64 {
        let cos = degrees.clamp(0.0, 90.0).to_radians().cos();
        match &self.law {
            ReflectanceLaw::Clear(eta) => fresnel::dielectric(cos, *eta).mean(),
            ReflectanceLaw::Sheet(eta) => fresnel::sheet(cos, *eta).mean(),
            ReflectanceLaw::Metal([n, k]) => fresnel::conductor(cos, *n, *k).mean(),
            ReflectanceLaw::Measured(points) => {
                let place = degrees.clamp(0.0, 90.0) * 2.0;
                let value = |index: usize| points.get(index).copied().unwrap_or(1.0);
                let before = place.floor() as usize;
                value(before) + (place - place.floor()) * (value(before + 1) - value(before))
            }
        }
    }
}

/// A special angle of a curve, such as Brewster's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecialAngle {
    /// What happens.
    pub kind: SpecialAngleKind,
    /// The angle of incidence.
    pub degrees: f64,
    /// Whether light comes from within.
    pub is_from_inside: bool,
}

/// The kind of a special angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecialAngleKind {
    /// Light that swings in the plane of incidence is not reflected at all (D. Brewster 1815).
    Brewster,
    /// From here on everything is reflected.
    Critical,
}

/// The curves of a material; none if it reflects alike under all angles.
pub fn curves_of(material: &Material) -> Vec<ReflectanceCurve> {
    let clear = |kind, eta| ReflectanceCurve { kind, law: ReflectanceLaw::Clear(eta) };
    match material {
        Material::Phong(_) | Material::Mirror(_) | Material::Matte(_) => Vec::new(),
        Material::Dielectric(dielectric) => {
            let ior = dielectric.index.ior();
            vec![clear(CurveKind::FromOutside, ior), clear(CurveKind::FromInside, 1.0 / ior)]
        }
        Material::Coated(coated) => vec![clear(CurveKind::FromOutside, coated.ior)],
        Material::ThinDielectric(sheet) => {
            vec![ReflectanceCurve { kind: CurveKind::FromOutside, law: ReflectanceLaw::Sheet(sheet.ior) }]
        }
        Material::Conductor(conductor) => {
            let kinds = [CurveKind::Red, CurveKind::Green, CurveKind::Blue];
            let laws: [ReflectanceLaw; 3] = match conductor.metal {
                MetalOptics::Index { n, k } => {
                    [[n.x, k.x], [n.y, k.y], [n.z, k.z]].map(ReflectanceLaw::Metal)
                }
                MetalOptics::Metal(metal) => {
                    let all: Vec<[f64; 3]> = (0..=180)
                        .map(|half| metal.reflectance((0.5 * f64::from(half)).to_radians().cos(), 1.0))
                        .collect();
                    [0, 1, 2].map(|channel: usize| {
                        let channel = |rgb: &[f64; 3]| rgb.get(channel).copied().unwrap_or(1.0);
                        ReflectanceLaw::Measured(all.iter().map(channel).collect())
                    })
                }
            };
            kinds.into_iter().zip(laws).map(|(kind, law)| ReflectanceCurve { kind, law }).collect()
        }
    }
}

/// Wavelengths at which screens are red, green and blue, nanometers.
const PRIMARIES: [f64; 3] = [630.0, 532.0, 465.0];

/// The shares of red, green and blue light that a material reflects under an angle of incidence in degrees, by its
/// `curves` or, where colors are bent differently, by the index of each; `None` if it has no curve for that side.
pub fn reflected_at(
    material: &Material,
    curves: &[ReflectanceCurve],
    degrees: f64,
    is_from_inside: bool,
) -> Option<[f64; 3]> {
    if let Some(dispersion) = material.dispersion() {
        let indices = PRIMARIES.map(|nanometers| dispersion.index(nanometers));
        let law = |index: f64| ReflectanceLaw::Clear(if is_from_inside { 1.0 / index } else { index });
        let curve = |index| ReflectanceCurve { kind: CurveKind::FromOutside, law: law(index) };
        return Some(indices.map(|index| curve(index).at(degrees)));
    }
    let mut shares = None;
    for curve in curves.iter().filter(|curve| curve.kind.is_from_inside() == is_from_inside) {
        let share = curve.at(degrees);
        let [red, green, blue] = shares.get_or_insert([share; 3]);
        match curve.kind {
            CurveKind::Red => *red = share,
            CurveKind::Green => *green = share,
            CurveKind::Blue => *blue = share,
            CurveKind::FromOutside | CurveKind::FromInside => {}
        }
    }
    shares
}

/// The angles at which something happens to the curves of a material.
pub fn marks_of(material: &Material) -> Vec<SpecialAngle> {
    let sides = match material {
        Material::Dielectric(dielectric) => {
            let ior = dielectric.index.ior();
            vec![(ior, false), (1.0 / ior, true)]
        }
        Material::Coated(coated) => vec![(coated.ior, false)],
        Material::ThinDielectric(sheet) => vec![(sheet.ior, false)],
        Material::Phong(_) | Material::Conductor(_) | Material::Mirror(_) | Material::Matte(_) => Vec::new(),
    };
    let mut marks = Vec::new();
    for (eta, is_from_inside) in sides.into_iter().filter(|(eta, _)| *eta != 1.0) {
        let mark = |kind, angle: f64| SpecialAngle { kind, degrees: angle.to_degrees(), is_from_inside };
        marks.push(mark(SpecialAngleKind::Brewster, fresnel::brewster_angle(eta)));
        marks.extend(fresnel::critical_angle(eta).map(|angle| mark(SpecialAngleKind::Critical, angle)));
    }
    marks
}

#[cfg(test)]
mod tests {
    use catoptric_optics::Metal;
    use catoptric_scene::{Conductor, Dielectric, Model, RefractiveIndex};

    use super::*;

    fn clear(ior: f64) -> Material {
        Dielectric { index: ior.into(), ..Dielectric::default() }.into()
    }

    #[test]
    fn glass_has_its_curves_and_angles() {
        let glass = clear(1.5);
        let curves = curves_of(&glass);
        assert!((curves[0].at(0.0) - 0.04).abs() < 1e-12 && (curves[1].at(41.0) - 0.379_751).abs() < 1e-6);
        assert!((curves[0].at(90.0) - 1.0).abs() < 1e-12 && curves[1].at(60.0) == 1.0);
        let degrees: Vec<i64> =
            marks_of(&glass).iter().map(|mark| (mark.degrees * 1e4).round() as i64).collect();
        assert_eq!(degrees, [563_099, 336_901, 418_103]);
        let air = clear(1.0);
        assert!(marks_of(&air).is_empty() && curves_of(&air).iter().all(|curve| curve.at(50.0) == 0.0));
    }

    #[test]
    fn gold_is_red_and_white_when_it_grazes() {
        let metal = MetalOptics::Metal(Metal::named("gold").unwrap());
        let gold = Material::Conductor(Conductor { metal, ..Conductor::default() });
        let [red, _, blue] = &curves_of(&gold)[..] else { panic!() };
        assert!(red.at(0.0) > 2.0 * blue.at(0.0) && blue.at(89.9) > 0.98);
        let exact = Metal::named("gold").unwrap().reflectance(33.3_f64.to_radians().cos(), 1.0)[2];
        assert!((blue.at(33.3) - exact).abs() < 1e-4);
    }

    #[test]
    fn each_side_and_each_color_has_its_share() {
        let at = |material: &Material, degrees, is_from_inside| {
            reflected_at(material, &curves_of(material), degrees, is_from_inside)
        };
        let glass = clear(1.5);
        let outside = curves_of(&glass)[0].at(45.0);
        assert_eq!((at(&glass, 45.0, false), at(&glass, 45.0, true)), (Some([outside; 3]), Some([1.0; 3])));
        let metal = MetalOptics::Metal(Metal::named("copper").unwrap());
        let copper = Material::Conductor(Conductor { metal, ..Conductor::default() });
        let known = [0, 1, 2].map(|channel: usize| curves_of(&copper)[channel].at(20.0));
        assert_eq!((at(&copper, 20.0, false), at(&copper, 20.0, true)), (Some(known), None));
        assert_eq!(at(&Material::default(), 20.0, false), None);
        // Diamond's index is 2.412 for red and 2.441 for blue light.
        let index = RefractiveIndex::Substance(catoptric_optics::ClearSubstance::named("diamond").unwrap());
        let diamond = Dielectric { index, dispersion: true, ..Dielectric::default() }.into();
        let [red, green, blue] = at(&diamond, 0.0, false).unwrap();
        assert!((red - 0.171).abs() < 1e-3 && (blue - 0.1754).abs() < 1e-3 && red < green && green < blue);
        let [red, _, blue] = at(&diamond, 24.3, true).unwrap();
        assert!(red < 1.0 && blue == 1.0);
    }

    #[test]
    fn flat_laws_have_no_curve() {
        for model in [Model::Phong, Model::Mirror, Model::Matte] {
            assert!(curves_of(&model.into()).is_empty());
        }
    }
}
