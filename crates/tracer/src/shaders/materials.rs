//! Physical materials, and lights that are balls, as the shaders read them.

use std::collections::HashMap;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use catoptric_optics::{Dispersion, observer};

use crate::shaders::constants::{FRAME_PLACES, ShaderConstants};
use crate::shaders::features::PhysicalFeatures;
use crate::shaders::pictures::PictureAtlas;
use crate::shaders::specialize::ShaderSpecialization;
use crate::transport::media::WAVES;
use crate::transport::scene::RenderScene;
use crate::transport::spectrum::SampledWavelengths;
use crate::transport::surface::material::RenderMaterial;
use crate::transport::surface::model::MaterialModel;
use crate::transport::surface::model::conductor::{ConductorTable, STEPS as CURVE_STEPS};
use crate::transport::surface::model::thin_dielectric::ThinDielectricMaterial;

/// The constants of shaders for such scenes.
pub(crate) fn constants(special: &ShaderSpecialization) -> ShaderConstants {
    let has = |physical| special.physical.has(physical);
    ShaderConstants {
        words: vec![
            ("WAVES", WAVES),
            ("WAVE_COUNT", SampledWavelengths::COUNT as u32),
            ("SAMPLE_WAVES", SAMPLE_WAVES as u32),
            ("SPLITS", if has(PhysicalFeatures::DISPERSES) { special.stack.max(1) } else { 1 }),
            ("INDEX_STEPS", INDEX_STEPS),
            ("CURVE_STEPS", CURVE_STEPS as u32),
            ("MATERIAL_ROWS", ROWS),
            ("NO_ROWS", NO_ROWS),
            ("LAW_MIRROR", MIRROR),
            ("LAW_DIELECTRIC", DIELECTRIC),
            ("LAW_CONDUCTOR", CONDUCTOR),
            ("LAW_COAT", COAT),
            ("LAW_THIN_DIELECTRIC", THIN_DIELECTRIC),
            ("LAW_SCHLICK", SCHLICK),
            ("LAW_NOTHING", NOTHING),
        ],
        numbers: vec![("INDEX_START", *observer::VISIBLE.start() as f32), ("INDEX_RATE", INDEX_RATE as f32)],
        flags: vec![
            ("HAS_METALS", has(PhysicalFeatures::METALS)),
            ("HAS_FACETS", has(PhysicalFeatures::FACETS)),
            ("DISPERSES", has(PhysicalFeatures::DISPERSES)),
            ("HAS_BALLS", has(PhysicalFeatures::BALLS)),
        ],
    }
}

/// Rows of a material.
const ROWS: u32 = 6;
/// Stands for "no rows" where the place of a table is kept.
const NO_ROWS: u32 = u32::MAX;

const CONSTANT: u32 = 0;
const MIRROR: u32 = 1;
const DIELECTRIC: u32 = 2;
const CONDUCTOR: u32 = 3;
const COAT: u32 = 4;
const THIN_DIELECTRIC: u32 = 5;
const SCHLICK: u32 = 6;
/// Of a cemented contact without a surface.
const NOTHING: u32 = 7;

/// Indices of refraction to a nanometer. Between them straight lines are off by less than 10⁻⁶ for glass.
const INDEX_RATE: f64 = 2.0;
/// From the first index to the last.
const INDEX_STEPS: u32 = 800;

/// Four words.
type MaterialRow = [u32; 4];

/// The materials, then the tables that they point to.
pub(crate) fn rows(render_scene: &RenderScene) -> Vec<MaterialRow> {
    let first = render_scene.materials.len() as u32 * ROWS;
    let mut tables =
        MaterialRowTables { first, pictures: PictureAtlas::of(render_scene), ..MaterialRowTables::default() };
    let mut rows: Vec<MaterialRow> = Vec::new();
    for material in render_scene.materials.iter() {
        rows.extend(rows_of(material, &mut tables));
    }
    rows.extend(tables.rows);
    rows
}

/// Tables behind the materials.
#[derive(Default)]
struct MaterialRowTables {
    /// The row where they begin.
    first: u32,
    rows: Vec<MaterialRow>,
    /// Where the curves are that stand there already.
    curves: HashMap<*const ConductorTable, u32>,
    dispersions: Vec<(Dispersion, u32)>,
    pictures: PictureAtlas,
}

impl MaterialRowTables {
    fn next(&self) -> u32 {
        self.first + self.rows.len() as u32
    }

    fn curve(&mut self, curve: &Arc<ConductorTable>) -> u32 {
        let next = self.next();
        let place = *self.curves.entry(Arc::as_ptr(curve)).or_insert(next);
        if place == next {
            self.rows.extend(curve.points().iter().map(|&[red, green, blue]| row([red, green, blue, 0.0])));
        }
        place
    }

    /// The indices of refraction at even steps through visible light.
    fn indices(&mut self, dispersion: Dispersion) -> u32 {
        if let Some((_, place)) = self.dispersions.iter().find(|known| known.0 == dispersion) {
            return *place;
        }
        let place = self.next();
        self.dispersions.push((dispersion, place));
        let index =
            |step: u32| dispersion.index(observer::VISIBLE.start() + f64::from(step) / INDEX_RATE) as f32;
        let fours = (0..=INDEX_STEPS).step_by(4);
        self.rows.extend(fours.map(|step| row([0, 1, 2, 3].map(|more| index(step + more)))));
        place
    }
}

fn row(numbers: [f32; 4]) -> MaterialRow {
    numbers.map(f32::to_bits)
}

fn rows_of(material: &RenderMaterial, tables: &mut MaterialRowTables) -> [MaterialRow; ROWS as usize] {
    // All fields by name: what the shaders do not know must not be left out unnoticed.
    let RenderMaterial {
        color,
        ref texture,
        ambient,
        diffuse,
        specular,
        shininess,
        reflection,
        filter,
        ior,
        ref law,
        dispersion,
        alpha,
        absorption,
    } = *material;
    let (law, curve, coat) = match law {
        MaterialModel::Constant => (CONSTANT, NO_ROWS, [0.0; 4]),
        MaterialModel::Schlick => (SCHLICK, NO_ROWS, [0.0; 4]),
        MaterialModel::Mirror => (MIRROR, NO_ROWS, [0.0; 4]),
        MaterialModel::Dielectric => (DIELECTRIC, NO_ROWS, [0.0; 4]),
        MaterialModel::Conductor(curve) => (CONDUCTOR, tables.curve(curve), [0.0; 4]),
        MaterialModel::Coat(coat) => (COAT, NO_ROWS, [coat.ratio, coat.spread, coat.lets_out, coat.lets_in]),
        MaterialModel::ThinDielectric(ThinDielectricMaterial { ratio, tint: [red, green, blue] }) => {
            (THIN_DIELECTRIC, NO_ROWS, [*ratio, *red, *green, *blue])
        }
    };
    let indices = dispersion.map_or(NO_ROWS, |dispersion| tables.indices(dispersion));
    let color = texture.as_ref().map_or(color, |texture| tables.pictures.in_place_of_color(texture));
    let with = |[red, green, blue]: [f32; 3], last| row([red, green, blue, last]);
    [
        with(color, ambient),
        with(filter, ior),
        row([diffuse, specular, shininess, reflection]),
        [law, alpha.to_bits(), curve, indices],
        with(absorption, 0.0),
        row(coat),
    ]
}

const SAMPLE_WAVES: usize = FRAME_PLACES * SampledWavelengths::COUNT;

/// The waves of the samples of a dispatch: for each its linear light, and nanometers in vacuum.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct WavelengthUniforms([[f32; 4]; SAMPLE_WAVES]);

impl WavelengthUniforms {
    /// Those of so many samples (at most [`FRAME_PLACES`]) of pixels that have `samples_done`.
    pub fn new(samples_done: u32, samples: u32) -> Self {
        let mut places = [[0.0; 4]; SAMPLE_WAVES];
        let all =
            (samples_done..).take(samples as usize).zip(places.chunks_exact_mut(SampledWavelengths::COUNT));
        for (sample, places) in all {
            let waves = SampledWavelengths::of_sample(sample);
            for (number, place) in places.iter_mut().enumerate() {
                let [red, green, blue] = waves.color(number);
                let nanometers = waves.nanometers(number as u32).unwrap_or_default();
                *place = [red, green, blue, nanometers as f32];
            }
        }
        Self(places)
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{
        Attenuation, Body, Conductor, Dielectric, Example, Light, Material, MaterialChoice, MetalOptics,
        Model, Scene,
    };

    use super::*;
    use crate::shaders::shader;

    fn stage_of(materials: &[Material], radius: f64) -> RenderScene {
        let body = |material: &Material| Body {
            material: MaterialChoice::Inline(Box::new(material.clone())),
            ..Body::default()
        };
        let lights = vec![Light { radius, ..Light::default() }];
        let scene = Scene { bodies: materials.iter().map(body).collect(), lights, ..Scene::default() };
        RenderScene::build(&scene).unwrap()
    }

    fn special(render_scene: &RenderScene) -> ShaderSpecialization {
        ShaderSpecialization::of(
            &crate::shaders::specialize::SceneContents::of(render_scene),
            render_scene,
            render_scene.camera(),
        )
        .unwrap()
    }

    #[test]
    fn only_what_is_there_is_asked_for() {
        let plain = [Model::Phong, Model::Matte].map(Material::from);
        assert_eq!(PhysicalFeatures::of(&stage_of(&plain, 0.0)), PhysicalFeatures::NOTHING);
        assert_eq!(PhysicalFeatures::of(&stage_of(&plain, 0.5)), PhysicalFeatures::BALLS);
        let rough = Conductor { roughness: 0.5, ..Conductor::default() }.into();
        let metal = PhysicalFeatures::LAWS | PhysicalFeatures::METALS;
        assert_eq!(PhysicalFeatures::of(&stage_of(&[rough], 0.0)), metal | PhysicalFeatures::FACETS);
        let near = Attenuation { distance: 0.1, ..Attenuation::default() };
        let glass = Dielectric { attenuation: near, ..Dielectric::default() };
        assert_eq!(PhysicalFeatures::of(&stage_of(&[glass.clone().into()], 0.0)), PhysicalFeatures::LAWS);
        let gray = Attenuation { color: catoptric_scene::Color::gray(0.5), ..near };
        let tinted = Dielectric { attenuation: gray, ..glass.clone() }.into();
        assert_eq!(
            PhysicalFeatures::of(&stage_of(&[tinted], 0.0)),
            PhysicalFeatures::LAWS | PhysicalFeatures::ABSORBS
        );
        let torn = Dielectric { dispersion: true, ..glass }.into();
        assert_eq!(
            PhysicalFeatures::of(&stage_of(&[torn], 0.0)),
            PhysicalFeatures::LAWS | PhysicalFeatures::DISPERSES
        );
    }

    /// Scenes of Phong's model pay nothing for what they do not have.
    #[test]
    fn plain_shaders_know_nothing_of_physical_materials() {
        let own = ["facet", "Sample2D", "wave", "absorption", "curve", "radius: f32,\n"];
        let source = |name: &str| {
            let scene = Example::find(name).unwrap().load().unwrap().scene;
            shader(&special(&RenderScene::build(&scene).unwrap()))
        };
        let (plain, physical) = (source("whitted"), source("prism"));
        assert_eq!(own.into_iter().find(|word| plain.contains(word)), None);
        assert!(own.iter().filter(|word| physical.contains(*word)).count() > 3);
    }

    #[test]
    fn tables_stand_where_materials_point() {
        let metal = MetalOptics::Metal(catoptric_optics::Metal::named("gold").unwrap());
        let gold = |roughness| Material::from(Conductor { metal, roughness });
        let glass = Dielectric { dispersion: true, ..Dielectric::default() }.into();
        let render_scene = stage_of(&[gold(0.0), glass, gold(0.3), Model::Mirror.into()], 0.0);
        let rows = rows(&render_scene);
        let laws: Vec<MaterialRow> = rows.chunks(ROWS as usize).take(4).map(|material| material[3]).collect();
        assert_eq!(
            laws.iter().map(|law| law[0]).collect::<Vec<_>>(),
            [CONDUCTOR, DIELECTRIC, CONDUCTOR, MIRROR]
        );
        // One curve for both.
        assert_eq!((laws[0][2], laws[3][2]), (laws[2][2], NO_ROWS));
        let MaterialModel::Conductor(curve) = &render_scene.materials[0].law else {
            panic!("gold is a conductor")
        };
        let first = laws[0][2] as usize;
        assert_eq!(rows[first + CURVE_STEPS + 1][..3], curve.at(1.0).map(f32::to_bits));
        let indices: Vec<f32> =
            rows[laws[1][3] as usize..].as_flattened().iter().map(|bits| f32::from_bits(*bits)).collect();
        let dispersion = render_scene.materials[1].dispersion.unwrap();
        for tenth in 3800_u16..7800 {
            let nanometers = f64::from(tenth) / 10.0;
            let place = (nanometers - 380.0) * INDEX_RATE;
            let (low, high) = (indices[place as usize], indices[place as usize + 1]);
            let between = f64::from(low) + f64::from(high - low) * place.fract();
            assert!((between - dispersion.index(nanometers)).abs() < 1e-6, "{nanometers}");
        }
        assert_eq!(indices.len(), 804);
    }

    #[test]
    fn samples_have_their_own_waves() {
        let WavelengthUniforms(waves) = WavelengthUniforms::new(5, 3);
        for (place, sample) in (5..8).enumerate() {
            let own = SampledWavelengths::of_sample(sample);
            for (number, wave) in
                waves[place * SampledWavelengths::COUNT..].iter().take(SampledWavelengths::COUNT).enumerate()
            {
                assert_eq!(wave[..3], own.color(number));
                assert_eq!(wave[3], own.nanometers(number as u32).unwrap() as f32);
            }
        }
        assert_eq!(waves[3 * SampledWavelengths::COUNT], [0.0; 4]);
    }
}
