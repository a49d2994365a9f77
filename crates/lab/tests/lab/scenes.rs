//! Random scenes of everything, and short ways to build scenes.

use catoptric_optics::{CLEAR, METALS};
use catoptric_scene::{
    Anchor, Attenuation, Body, Camera, Coated, Color, Conductor, Dielectric, Falloff, Light, Material,
    MaterialChoice, Matte, MetalOptics, Mirror, Model, ParaboloidDepth, Pattern, Phong, Placement,
    Projection, RefractiveIndex, Scene, Shape, SolidTexture, ThinDielectric, Tracing,
};
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// A fixed sequence of cases. `PROPTEST_RNG_SEED` and `PROPTEST_CASES` explore others.
pub(crate) fn cases(count: u32) -> Config {
    let mut config = Config::default();
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(0x0CA7_0971C);
    }
    if std::env::var_os("PROPTEST_CASES").is_none() {
        config.cases = count;
    }
    config.failure_persistence = None;
    config
}

pub(crate) fn body(shape: Shape, position: DVec3, material: Material) -> Body {
    let material = MaterialChoice::Inline(Box::new(material));
    Body { shape, placement: Placement::at(position), material, ..Body::default() }
}

pub(crate) fn ball(radius: f64, position: DVec3, material: Material) -> Body {
    body(Shape::Sphere { radius }, position, material)
}

fn color() -> impl Strategy<Value = Color> {
    prop::array::uniform3(0.1..1.0_f64).prop_map(Color::from)
}

fn material() -> impl Strategy<Value = Material> {
    let opaque = (color(), 0.0..1.0_f64, 0.0..0.9_f64, 1.0..100.0_f64).prop_map(
        |(color, diffuse, specular, shininess)| {
            Material::Phong(Phong { pattern: color.into(), diffuse, specular, shininess, ..Phong::default() })
        },
    );
    let checkered = (color(), color(), 0.2..1.0_f64).prop_map(|(color, other, size)| {
        Material::Phong(Phong {
            pattern: Pattern {
                color,
                solid: Some(SolidTexture { color: other, size, ..SolidTexture::default() }),
                ..Pattern::default()
            },
            ..Phong::default()
        })
    });
    let clear = (color(), 0.4..1.0_f64, 0.0..0.5_f64, 0.7..2.0_f64).prop_map(
        |(tint, transmission, reflection, ior)| {
            Material::Phong(Phong {
                ambient: 0.02,
                diffuse: 0.1,
                specular: 0.4,
                tint,
                transmission,
                reflection: Some(reflection),
                ior,
                ..Phong::default()
            })
        },
    );
    prop_oneof![2 => opaque, 1 => checkered, 3 => clear]
}

fn any_body() -> impl Strategy<Value = Body> {
    let shape = prop_oneof![
        (0.2..0.9_f64).prop_map(|radius| Shape::Sphere { radius }),
        prop::array::uniform3(0.3..1.5_f64).prop_map(|size| Shape::Cube { size: size.into() }),
        (0.2..0.7_f64, 0.4..1.6_f64).prop_map(|(radius, height)| Shape::Cylinder { radius, height }),
        (0.2..0.8_f64, 0.0..0.5_f64, 0.5..1.6_f64).prop_map(|(radius, top_radius, height)| Shape::Cone {
            radius,
            top_radius,
            height
        }),
        (0.2..0.8_f64, 0.3..1.4_f64).prop_map(|(radius, height)| Shape::Paraboloid {
            radius,
            depth: ParaboloidDepth::Height(height)
        }),
    ];
    let place = (-1.5..1.5_f64, 0.1..1.8_f64, -1.5..1.5_f64).prop_map(DVec3::from);
    let turn = prop::array::uniform3(-180.0..180.0_f64).prop_map(DVec3::from);
    (shape, place, turn, material()).prop_map(|(shape, position, rotation_degrees, material)| {
        let mut body = body(shape, position, material);
        body.placement.anchor = Anchor::Frame { position, rotation_degrees };
        body
    })
}

fn lamp() -> impl Strategy<Value = Light> {
    let falloff = prop_oneof![
        Just(Falloff::None),
        (0.0..2.0_f64).prop_map(|constant| Falloff::Linear { constant }),
        Just(Falloff::InverseSquare),
    ];
    (prop::array::uniform3(-6.0..6.0_f64), 0.0..1.5_f64, falloff, any::<bool>()).prop_map(
        |([x, y, z], intensity, falloff, hidden)| Light {
            position: DVec3::new(x, y, z),
            intensity,
            falloff,
            hidden,
            ..Light::default()
        },
    )
}

/// Bodies of all kinds on a floor, in front of a camera of either kind.
pub(crate) fn any_scene() -> impl Strategy<Value = Scene> {
    let bodies = prop::collection::vec(any_body(), 1..18);
    let lights = prop::collection::vec(lamp(), 1..4);
    let eye = (-4.0..4.0_f64, 0.3..4.0_f64, 2.0..7.0_f64).prop_map(DVec3::from);
    let floor = prop::option::of(material());
    let tracing = (1..8_u32, prop_oneof![Just(0.0), 0.0..0.05_f64]);
    (bodies, floor, lights, eye, any::<bool>(), color(), tracing).prop_map(
        |(mut bodies, floor, lights, position, is_parallel, background, (generations, threshold))| {
            bodies.extend(floor.map(|material| body(Shape::Plane, DVec3::ZERO, material)));
            let target = DVec3::new(0.0, 0.9, 0.0);
            let mut scene = Scene { bodies: bodies.into_iter().collect(), lights, ..Scene::default() };
            scene.camera = Camera { position, target, ..Camera::default() };
            if is_parallel {
                scene.camera.projection = Projection::Parallel { height: 4.0 };
            }
            scene.environment.background = background;
            scene.tracing = Tracing { generations, threshold };
            scene
        },
    )
}

/// A material of any model but Phong's, smooth or rough.
fn physical() -> impl Strategy<Value = Material> {
    let roughness = prop_oneof![Just(0.0), 0.05..1.0_f64];
    let model = prop::sample::select(&Model::ALL[1..]);
    let substance = prop::option::of(prop::sample::select(CLEAR.iter().collect::<Vec<_>>()));
    let metal = prop::sample::select(METALS.iter().collect::<Vec<_>>());
    (model, color(), 0.7..2.0_f64, roughness, substance, any::<bool>(), metal).prop_map(
        |(model, color, ior, roughness, substance, dispersion, metal)| match model {
            Model::Dielectric => {
                let index = substance.map_or(ior.into(), RefractiveIndex::Substance);
                let attenuation = Attenuation { color, ..Attenuation::default() };
                Dielectric { index, dispersion, attenuation, roughness }.into()
            }
            Model::Conductor => Conductor { metal: MetalOptics::Metal(metal), roughness }.into(),
            Model::Mirror => Mirror { pattern: color.into(), roughness, ..Mirror::default() }.into(),
            Model::Coated => Coated { pattern: color.into(), ior, roughness, ..Coated::default() }.into(),
            Model::ThinDielectric => ThinDielectric { ior, tint: color }.into(),
            Model::Phong | Model::Matte => Matte { pattern: color.into(), ..Matte::default() }.into(),
        },
    )
}

/// Bodies of physical materials, under lights of which some are spherical.
pub(crate) fn any_physical_scene() -> impl Strategy<Value = Scene> {
    let materials = prop::collection::vec(physical(), 20);
    let radii = prop::collection::vec(prop_oneof![Just(0.0), 0.1..1.5_f64], 4);
    (any_scene(), materials, radii).prop_map(|(mut scene, materials, radii)| {
        for (body, material) in scene.bodies.iter_mut().zip(materials) {
            body.material = MaterialChoice::Inline(Box::new(material));
        }
        for (light, radius) in scene.lights.iter_mut().zip(radii) {
            light.radius = radius;
        }
        // Eight waves at every surface of glass that splits light grow quickly.
        scene.tracing.generations = scene.tracing.generations.min(5);
        scene
    })
}
