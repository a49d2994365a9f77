//! Cemented bodies: blocks of any material side by side, water in its glass, a floor below, few and many.

use catoptric_scene::{
    Attenuation, Body, BodyContact, BodyPart, Color, Contact, Dielectric, Light, Material, MaterialChoice,
    Matte, Phong, Placement, Scene, Shape,
};
use glam::DVec3;

use crate::common::{card, stage_of};
use crate::parity::{apart, compare, fault};

fn body(shape: Shape, at: DVec3, material: impl Into<Material>) -> Body {
    let material = MaterialChoice::own(material);
    Body { shape, placement: Placement::at(at), material, ..Body::default() }
}

fn glass(ior: f64) -> Dielectric {
    let attenuation = Attenuation { color: Color::new(0.4, 0.8, 0.7), distance: 0.8 };
    Dielectric { attenuation, ..clear(ior) }
}

fn clear(ior: f64) -> Dielectric {
    Dielectric { index: ior.into(), ..Dielectric::default() }
}

fn milk(ior: f64) -> Phong {
    let (diffuse, specular, reflection) = (0.3, 0.4, Some(0.1));
    Phong { diffuse, specular, reflection, transmission: 0.7, ior, ..Phong::default() }
}

/// Blocks side by side, `count` to a side, on a floor that they stand on.
fn blocks(count: u32, material: impl Fn(u32) -> Material) -> Scene {
    let size = 1.6 / f64::from(count);
    let block = |number: u32| {
        let place = [number % count, number / count % count, number / count / count];
        let at = DVec3::from(place.map(f64::from)) * size + DVec3::new(-0.8, 0.0, -0.8) + 0.5 * size;
        body(Shape::Cube { size: DVec3::splat(size) }, at, material(place.iter().sum()))
    };
    let floor = body(Shape::Plane, DVec3::ZERO, Matte::default());
    let mut scene =
        Scene { bodies: (0..count.pow(3)).map(block).chain([floor]).collect(), ..Scene::default() };
    scene.environment.contact = Contact::Cemented;
    scene.lights = vec![Light { position: DVec3::new(-3.0, 6.0, 2.0), ..Light::default() }];
    scene.camera.position = DVec3::new(1.9, 2.6, 4.1);
    scene.camera.target = DVec3::new(0.0, 0.6, 0.0);
    scene.tracing.generations = 5;
    scene
}

/// Many blocks, and on them a glass of water under a lid that keeps a film of air.
fn water_on_blocks() -> Scene {
    let cylinder = |radius: f64, base: f64, height: f64| BodyPart {
        shape: Shape::Cylinder { radius, height },
        placement: Placement::at(DVec3::Y * base),
        ..BodyPart::default()
    };
    let top = DVec3::Y * 1.6;
    let vessel = Body {
        parts: vec![cylinder(0.6, 0.0, 0.8), cylinder(0.5, 0.1, 1.0)],
        ..body(Shape::Difference, top, glass(1.5))
    };
    let fill = body(Shape::Cylinder { radius: 0.5, height: 0.7 }, top + DVec3::Y * 0.1, glass(1.333));
    let lid = body(Shape::Cylinder { radius: 0.6, height: 0.1 }, top + DVec3::Y * 0.8, glass(1.6));
    let mut scene = blocks(4, |sum| if sum % 3 == 0 { milk(1.5).into() } else { glass(1.5).into() });
    scene.bodies.extend([vessel, fill, Body { contact: BodyContact::Air, ..lid }]);
    scene.camera.target = DVec3::new(0.0, 1.2, 0.0);
    scene
}

#[test]
fn cemented_bodies_are_those_of_the_cpu() {
    let Some(card) = card("cemented_bodies_are_those_of_the_cpu") else { return };
    let colorful = Dielectric { dispersion: true, ..clear(1.8) };
    let kinds = |sum: u32| match sum % 3 {
        0 => Material::from(milk(1.5)),
        1 => clear(1.5).into(),
        _ => colorful.clone().into(),
    };
    let scenes = [("a few blocks", blocks(2, kinds)), ("many blocks, and water", water_on_blocks())];
    let mut faults = Vec::new();
    for (name, scene) in scenes {
        let compared = compare(&card, &stage_of(&scene), 1);
        let (cpu, gpu) = (compared.cpu.1, compared.gpu.1);
        faults.extend(fault(name, &compared));
        let rays = [(cpu.shadow, gpu.shadow), (cpu.reflected, gpu.reflected), (cpu.refracted, gpu.refracted)];
        if rays.iter().any(|&(one, other)| apart(one, other) > 0.002) {
            faults.push(format!("{name}: {cpu:?} on the CPU, {gpu:?} on the GPU"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
