//! Physical materials where the examples do not go: all of them side by side and in one another, an eye within, waves
//! that go straight on, many samples.

use catoptric_picture::{Difference, Picture};
use catoptric_scene::{
    Attenuation, Body, Coated, Color, Conductor, Dielectric, Example, FresnelTerm, Light, Material,
    MaterialChoice, Matte, Mirror, Pattern, Phong, Placement, Projection, RefractiveIndex, Scene, Shape,
    SolidTexture,
};
use glam::DVec3;

use crate::common::{card, stage_of};
use crate::numbers::Numbers;
use crate::parity::{apart, compare, fault};

/// Bodies that overlap, of any material, seen from anywhere.
#[test]
fn any_materials_in_one_another_are_those_of_the_cpu() {
    let Some(card) = card("any_materials_in_one_another_are_those_of_the_cpu") else { return };
    let mut numbers = Numbers(0x2545_f491);
    let mut faults = Vec::new();
    for number in 0..4 {
        // Few have spheres around them, many a hierarchy of boxes.
        let mut scene = numbers.scene(if number % 3 == 0 { 20 } else { 6 });
        match number % 4 {
            1 => {
                let glass = numbers.glass(0.0);
                scene.bodies[0].material = MaterialChoice::own(glass);
                scene.bodies[0].placement = Placement::at(scene.camera.position);
            }
            3 => scene.camera.projection = Projection::Parallel { height: 4.0 },
            _ => {}
        }
        let compared = compare(&card, &stage_of(&scene), 1);
        faults.extend(fault(&format!("any materials {number}"), &compared));
        let (cpu, gpu) = (compared.cpu.1, compared.gpu.1);
        for (one, other) in
            [(cpu.shadow, gpu.shadow), (cpu.reflected, gpu.reflected), (cpu.refracted, gpu.refracted)]
        {
            if apart(one, other) > 0.002 {
                faults.push(format!("any materials {number}: {cpu:?} on the CPU, {gpu:?} on the GPU"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A ball and a cube that fill the picture, with a light before them and one behind.
fn close_by(material: Material) -> Scene {
    let body = |shape, at: DVec3, material| Body {
        shape,
        placement: Placement::at(at),
        material: MaterialChoice::Inline(Box::new(material)),
        ..Body::default()
    };
    let light = |position, radius| Light { position, radius, intensity: 1.5, ..Light::default() };
    let floor = Material::Matte(Matte::default());
    let mut scene = Scene {
        bodies: [
            body(Shape::Sphere { radius: 1.0 }, DVec3::new(-1.1, 0.0, 0.0), material.clone()),
            body(Shape::Cube { size: DVec3::splat(1.6) }, DVec3::new(1.1, -0.2, 0.0), material),
            body(Shape::Plane, DVec3::new(0.0, -1.0, 0.0), floor),
        ]
        .into(),
        lights: vec![light(DVec3::new(0.3, 1.5, -4.0), 0.0), light(DVec3::new(2.0, 5.0, 5.0), 1.0)],
        ..Scene::default()
    };
    scene.camera.position = DVec3::new(0.4, 1.0, 4.2);
    scene.camera.target = DVec3::ZERO;
    scene.environment.background = Color { r: 0.1, g: 0.15, b: 0.2 };
    (scene.tracing.generations, scene.tracing.threshold) = (5, 0.01);
    scene
}

/// What a law does shows in much of the picture, so that a card that does otherwise is noticed.
#[test]
fn materials_close_by_are_those_of_the_cpu() {
    let Some(card) = card("materials_close_by_are_those_of_the_cpu") else { return };
    let amber = Color { r: 0.9, g: 0.5, b: 0.1 };
    let checker = Some(SolidTexture { color: amber, size: 0.3, ..SolidTexture::default() });
    let attenuation = Attenuation { color: amber, distance: 0.5 };
    let tinted = |roughness| Dielectric { attenuation, roughness, ..Dielectric::default() };
    let splitting = RefractiveIndex::Own { ior: 1.5, abbe: 20.0 };
    let pattern = || Pattern { solid: checker.clone(), ..Pattern::default() };
    let coated = |roughness| Coated { pattern: pattern(), roughness, ..Coated::default() };
    let weighed =
        Phong { transmission: 0.9, reflection: Some(0.9), specular: 0.3, diffuse: 0.1, ..Phong::default() };
    let materials: [(&str, Material); 8] = [
        ("glass by Schlick", Phong { fresnel: FresnelTerm::Schlick, ..weighed }.into()),
        ("frosted glass", tinted(0.4).into()),
        ("tinted glass", tinted(0.0).into()),
        (
            "frosted glass that splits light",
            Dielectric { index: splitting, dispersion: true, ..tinted(0.2) }.into(),
        ),
        ("brushed metal", Conductor { roughness: 0.3, ..Conductor::default() }.into()),
        ("a rough mirror", Mirror { pattern: pattern(), roughness: 0.5, ..Mirror::default() }.into()),
        ("lacquer", coated(0.0).into()),
        ("rough lacquer", coated(0.6).into()),
    ];
    let mut pictures: Vec<Picture> = Vec::new();
    for (name, material) in materials {
        let compared = compare(&card, &stage_of(&close_by(material)), 1);
        assert_eq!(fault(name, &compared), None);
        for other in &pictures {
            let difference = Difference::between(other, &compared.gpu.0).unwrap();
            assert!(difference.share_above > 0.1, "{name} looks like another material: {difference:?}");
        }
        pictures.push(compared.gpu.0);
    }
}

/// Every sample has waves, facets and points of lights of its own, and a card counts samples as the processor does.
#[test]
fn several_samples_are_those_of_the_cpu() {
    let Some(card) = card("several_samples_are_those_of_the_cpu") else { return };
    for name in ["prism", "roughness-row", "soft-shadow"] {
        let scene = Example::find(name).unwrap().load().unwrap().scene;
        let compared = compare(&card, &stage_of(&scene), 3);
        assert_eq!(fault(&format!("three samples of {name}"), &compared), None);
        // One sample is another picture: the test can fail.
        let one = compare(&card, &stage_of(&scene), 1);
        let difference = Difference::between(&one.gpu.0, &compared.cpu.0).unwrap();
        assert!(difference.share_above > 0.01, "{name}: {difference:?}");
    }
}

/// Waves that go straight on stay in their generation; behind them as many rays may wait as there can be.
#[test]
fn waves_that_go_straight_on_are_those_of_the_cpu() {
    let Some(card) = card("waves_that_go_straight_on_are_those_of_the_cpu") else { return };
    let glass = |ior| {
        Material::Dielectric(Dielectric {
            index: RefractiveIndex::Own { ior, abbe: 20.0 },
            dispersion: true,
            ..Dielectric::default()
        })
    };
    // Phong's bodies reflect even where nothing is bent, so that something waits in every generation.
    let pane =
        Material::Phong(Phong { reflection: Some(0.5), transmission: 0.5, ior: 1.0, ..Phong::default() });
    let slab = |at: f64, material| Body {
        shape: Shape::Cube { size: DVec3::new(8.0, 8.0, 0.1) },
        placement: Placement::at(DVec3::new(0.0, 0.0, -at)),
        material: MaterialChoice::Inline(Box::new(material)),
        ..Body::default()
    };
    let materials = [pane.clone(), glass(1.0), glass(1.6), pane];
    let mut scene = Scene {
        bodies: (0..).zip(materials).map(|(at, material)| slab(f64::from(at), material)).collect(),
        lights: vec![Light::default()],
        ..Scene::default()
    };
    scene.camera.position = DVec3::new(1.0, 1.5, 6.0);
    scene.camera.target = DVec3::ZERO;
    scene.environment.background = Color { r: 0.9, g: 0.5, b: 0.3 };
    for generations in [2, 5] {
        (scene.tracing.generations, scene.tracing.threshold) = (generations, 0.02);
        let compared = compare(&card, &stage_of(&scene), 1);
        assert_eq!(fault(&format!("{generations} generations of waves"), &compared), None);
        assert_eq!(compared.gpu.1.refracted, compared.cpu.1.refracted);
    }
}
