//! Random scenes of everything against the oracle.

use catoptric_picture::Picture;
use catoptric_scene::{
    Anchor, Body, Color, Falloff, FresnelTerm, Material, MaterialChoice, ParaboloidDepth, Pattern, Phong,
    Placement, Projection, Scene, Shadow, Shape, SolidKind, SolidTexture, Tracing,
};
use catoptric_tracer::{RenderControl, RenderSettings, render};
use glam::DVec3;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::{camera, cases, light, picture, placed, plane, render_scene, scene, v};

fn color() -> impl Strategy<Value = Color> {
    prop::array::uniform3(0.1..1.0_f64).prop_map(Color::from)
}

/// Checkerboards, and other patterns, also within each other.
fn solid() -> impl Strategy<Value = SolidTexture> {
    let checker = (color(), 0.2..1.0_f64)
        .prop_map(|(color, size)| SolidTexture { size, ..SolidTexture::new(SolidKind::Checker, color) });
    let three = |range: std::ops::Range<f64>| prop::array::uniform3(range).prop_map(DVec3::from);
    let kind = prop::sample::select(SolidKind::ALL.to_vec());
    let any = (kind, color(), 0.2..1.0_f64, three(-1.0..1.0), three(-180.0..180.0), three(0.5..2.0))
        .prop_map(|(kind, color, size, position, rotation_degrees, scale)| SolidTexture {
            size,
            position,
            rotation_degrees,
            scale,
            ..SolidTexture::new(kind, color)
        })
        .boxed();
    let nested = any.clone().prop_recursive(3, 6, 2, |inner| {
        let within = || prop::option::of(inner.clone().prop_map(Box::new));
        (inner.clone(), within(), within()).prop_map(|(outer, first, second)| SolidTexture {
            first,
            second,
            ..outer
        })
    });
    prop_oneof![checker, any, nested]
}

pub(crate) fn material() -> impl Strategy<Value = Material> {
    let opaque = (color(), 0.0..1.0_f64, 0.0..0.6_f64, 1.0..100.0_f64).prop_map(
        |(color, diffuse, specular, shininess)| {
            Material::Phong(Phong { pattern: color.into(), diffuse, specular, shininess, ..Phong::default() })
        },
    );
    let patterned = (color(), solid()).prop_map(|(color, solid)| {
        let pattern = Pattern { color, solid: Some(solid), ..Pattern::default() };
        Material::Phong(Phong { pattern, ..Phong::default() })
    });
    let fresnel = prop::sample::select(FresnelTerm::ALL.to_vec());
    let reflection = prop_oneof![1 => Just(0.0), 5 => 0.0..0.3_f64];
    let clear = (color(), 0.4..1.0_f64, reflection, 0.7..2.0_f64, fresnel).prop_map(
        |(tint, transmission, reflection, ior, fresnel)| {
            Material::Phong(Phong {
                ambient: 0.02,
                diffuse: 0.1,
                specular: 0.4,
                tint,
                transmission,
                reflection: Some(reflection),
                ior,
                fresnel,
                ..Phong::default()
            })
        },
    );
    prop_oneof![3 => opaque, 1 => patterned, 2 => clear]
}

/// Mostly what surfaces let through.
pub(crate) fn shadow() -> impl Strategy<Value = Shadow> {
    prop_oneof![8 => Just(Shadow::Filtered), 1 => Just(Shadow::None), 1 => Just(Shadow::Full)]
}

pub(crate) fn body() -> impl Strategy<Value = Body> {
    let shape = prop_oneof![
        (0.2..0.9_f64).prop_map(|radius| Shape::Sphere { radius }),
        prop::array::uniform3(0.3..1.5_f64).prop_map(|size| Shape::Cube { size: size.into() }),
        (0.2..0.7_f64, 0.4..1.6_f64).prop_map(|(radius, height)| Shape::Cylinder { radius, height }),
        (0.2..0.8_f64, 0.5..1.6_f64).prop_map(|(radius, height)| Shape::Cone {
            radius,
            top_radius: 0.0,
            height
        }),
        (0.2..0.8_f64, 0.1..0.8_f64, 0.5..1.6_f64).prop_map(|(radius, top_radius, height)| Shape::Cone {
            radius,
            top_radius,
            height
        }),
        (0.2..0.8_f64, 0.3..1.4_f64).prop_map(|(radius, height)| Shape::Paraboloid {
            radius,
            depth: ParaboloidDepth::Height(height)
        }),
    ];
    let place = (-2.0..2.0_f64, 0.1..2.0_f64, -2.0..2.0_f64).prop_map(DVec3::from);
    let turn = prop::array::uniform3(-180.0..180.0_f64).prop_map(DVec3::from);
    let scale = prop_oneof![Just(DVec3::ONE), prop::array::uniform3(0.4..1.6_f64).prop_map(DVec3::from)];
    (shape, place, turn, scale, material(), shadow()).prop_map(
        |(shape, position, rotation_degrees, scale, material, shadow)| {
            let anchor = Anchor::Frame { position, rotation_degrees };
            Body { shadow, ..placed(shape, Placement { anchor, scale }, material) }
        },
    )
}

fn any_scene() -> impl Strategy<Value = Scene> {
    let falloff = prop_oneof![
        Just(Falloff::None),
        (0.0..2.0_f64).prop_map(|constant| Falloff::Linear { constant }),
        Just(Falloff::InverseSquare),
    ];
    let lamp = (prop::array::uniform3(-6.0..6.0_f64), 0.3..1.5_f64, falloff)
        .prop_map(|([x, y, z], intensity, falloff)| light(v(x, 1.0 + y.abs(), z), intensity, falloff));
    let lights = prop::collection::vec(lamp, 1..4);
    let bodies = prop::collection::vec(body(), 1..24);
    let eye = (-4.0..4.0_f64, 0.3..4.0_f64, 4.0..7.0_f64).prop_map(DVec3::from);
    let floor = prop::option::of(material());
    (bodies, floor, lights, eye, any::<bool>(), color()).prop_map(
        |(mut bodies, floor, lights, eye, is_parallel, background)| {
            bodies.extend(floor.map(|material| plane(DVec3::ZERO, 0.0, material)));
            let mut scene = scene(bodies);
            scene.lights = lights;
            scene.camera = camera(eye, v(0.0, 0.9, 0.0), 35.0);
            if is_parallel {
                scene.camera.projection = Projection::Parallel { height: 5.0 };
            }
            scene.environment.background = background;
            scene.tracing = Tracing { generations: 5, threshold: 0.0 };
            scene
        },
    )
}

proptest! {
    #![proptest_config(cases(256))]

    /// Candidates on the way to lights save time, and that is all, whatever the bodies' sizes: lights may be within some.
    /// Glass is of one kind, since the order of factors that differ may change the last digit of their product.
    #[test]
    fn candidates_change_no_picture(
        mut scene in any_scene(),
        sizes in prop::collection::vec(prop_oneof![Just(1.0), 0.01..0.1_f64, 0.1..20.0], 24),
        glass in prop::collection::vec(any::<bool>(), 24),
    ) {
        for ((body, size), is_glass) in scene.bodies.iter_mut().zip(sizes).zip(glass) {
            body.placement.scale *= size;
            let transmission = if is_glass { 0.6 } else { 0.0 };
            let reflection = Some(0.2);
            let material = Phong { diffuse: 0.3, reflection, transmission, ior: 1.4, ..Phong::default() };
            body.material = MaterialChoice::own(material);
        }
        let settings = RenderSettings { width: 40, height: 24, samples: 1 };
        let drawn = |scene| render(&scene, settings, &RenderControl::default()).unwrap();
        let (few, all) = (drawn(render_scene(&scene)), drawn(render_scene(&scene).without_candidates()));
        prop_assert_eq!(few.counts, all.counts);
        let bits = |picture: Picture| picture.pixels().as_flattened().iter().map(|part| part.to_bits()).collect::<Vec<_>>();
        prop_assert_eq!(bits(few.picture), bits(all.picture));
    }
}

const SCENES: u32 = 60;

#[test]
fn random_scenes_agree_with_the_oracle() {
    let config = cases(SCENES);
    let count = config.cases;
    let mut runner = TestRunner::new(config);
    let (mut off, mut total) = (0, 0);
    for number in 0..count {
        let scene = any_scene().new_tree(&mut runner).unwrap().current();
        let (ours, truth) = (picture(&scene, 64, 48), Oracle::new(&scene, 10.0).picture(64, 48));
        let comparison = catoptric_picture::Comparison { clamp: false, ..Default::default() };
        let difference = comparison.compare(&ours, &truth).unwrap();
        assert!(
            difference.above <= 6,
            "scene {number}: {} pixels are off, the worst at {:?} by {}\n{scene:#?}",
            difference.above,
            difference.worst,
            difference.max,
        );
        off += difference.above;
        total += ours.pixels().len();
    }
    let share = off as f64 / total as f64;
    println!("{off} of {total} pixels of random scenes are off ({:.4} %)", 100.0 * share);
    assert!(share < 0.0003, "{off} of {total} pixels are off");
}
