//! Joined bodies where the references do not go: trees of any kind, surfaces that coincide, media.

use catoptric_gpu::Gpu;
use catoptric_scene::{
    Anchor, Attenuation, Body, BodyPart, Color, Dielectric, Light, MaterialChoice, Pattern, Phong, Placement,
    Projection, Scene, Shape, ShapeKind, SolidTexture,
};
use glam::DVec3;

use crate::common::{card, stage_of};
use crate::numbers::Numbers;
use crate::parity::{apart, compare, fault};

fn part(shape: Shape, at: DVec3) -> BodyPart {
    BodyPart { shape, placement: Placement::at(at), ..BodyPart::default() }
}

fn joined(shape: Shape, at: DVec3, parts: Vec<BodyPart>, material: MaterialChoice) -> Body {
    Body { shape, placement: Placement::at(at), parts, material, ..Body::default() }
}

fn phong(color: [f64; 3], reflection: f64, transmission: f64) -> MaterialChoice {
    let [r, g, b] = color;
    let checker = (reflection == 0.0).then(SolidTexture::default);
    let pattern = Pattern { solid: checker, ..Color { r, g, b }.into() };
    let reflection = Some(reflection);
    MaterialChoice::own(Phong { pattern, reflection, transmission, ior: 1.4, ..Phong::default() })
}

/// A tree of parts of any shapes, some of them with a material of their own.
fn tree(numbers: &mut Numbers, depth: u32) -> BodyPart {
    let size = numbers.between(0.4, 1.1);
    let simple = [
        Shape::Sphere { radius: size },
        Shape::Cube { size: DVec3::splat(1.5 * size) },
        Shape::Cylinder { radius: 0.8 * size, height: 1.5 * size },
        Shape::Cone { radius: size, top_radius: 0.3 * size, height: 1.4 * size },
        Shape::PARABOLOID,
        Shape::Plane,
    ];
    let compound = [Shape::Union, Shape::Intersection, Shape::Difference];
    let own = numbers.below(4) == 0;
    let material = own.then(|| phong([0; 3].map(|_| numbers.between(0.2, 1.0)), 0.3, 0.0));
    let shape = match depth {
        0 => simple[numbers.below(6) as usize],
        _ => compound[numbers.below(3) as usize],
    };
    let parts = (0..3 * depth.min(1)).map(|_| tree(numbers, depth - 1)).collect();
    BodyPart { parts, material, ..part(shape, numbers.point(0.6)) }
}

/// What is different in the pictures of a scene, and in the numbers of its rays.
fn faults_of(card: &Gpu, name: &str, scene: &Scene) -> Vec<String> {
    let compared = compare(card, &stage_of(scene), 1);
    let (cpu, gpu) = (compared.cpu.1, compared.gpu.1);
    let mut faults: Vec<String> = fault(name, &compared).into_iter().collect();
    let rays = [(cpu.shadow, gpu.shadow), (cpu.reflected, gpu.reflected), (cpu.refracted, gpu.refracted)];
    if rays.iter().any(|&(one, other)| apart(one, other) > 0.002) {
        faults.push(format!("{name}: {cpu:?} on the CPU, {gpu:?} on the GPU"));
    }
    faults
}

/// A scene of trees, each within a ball, of up to 10 parts. All such scenes have a shader in common, for the sake of
/// software drivers: every second body is clear. Mesa's llvmpipe has few turns of loops for a pixel.
fn trees(numbers: &mut Numbers) -> Scene {
    let mut bodies = Vec::new();
    for number in 0..4 {
        let parts = vec![part(Shape::Sphere { radius: 1.2 }, DVec3::ZERO), tree(numbers, 1 + number / 2)];
        let shape = [Shape::Intersection, Shape::Difference][numbers.below(2) as usize];
        let rotation_degrees = numbers.point(180.0);
        let anchor = Anchor::Frame { position: numbers.point(1.6), rotation_degrees };
        let color = [0; 3].map(|_| numbers.between(0.2, 1.0));
        let clear = 0.7 * f64::from(number % 2);
        let mut body = joined(shape, DVec3::ZERO, parts, phong(color, 0.1, clear));
        body.placement = Placement { anchor, scale: DVec3::new(1.0, numbers.between(0.6, 1.0), 1.0) };
        bodies.push(body);
    }
    let mut scene = lit(bodies);
    scene.tracing.generations = 3;
    scene
}

/// The bodies on a floor.
fn lit(bodies: Vec<Body>) -> Scene {
    let floor = Body {
        shape: Shape::Plane,
        placement: Placement::at(DVec3::new(0.0, -1.8, 0.0)),
        material: phong([0.6; 3], 0.0, 0.0),
        ..Body::default()
    };
    let bodies = bodies.into_iter().chain([floor]).collect();
    let mut scene = Scene { bodies, lights: Vec::new(), ..Scene::default() };
    for position in [DVec3::new(2.0, 4.0, 3.0), DVec3::new(-3.0, 3.0, 1.0)] {
        scene.lights.push(Light { position, intensity: 0.6, ..Light::default() });
    }
    scene.camera.position = DVec3::new(0.5, 1.0, 6.0);
    scene.camera.target = DVec3::ZERO;
    scene.environment.background = Color { r: 0.2, g: 0.3, b: 0.4 };
    scene
}

#[test]
fn joined_trees_are_those_of_the_cpu() {
    let Some(card) = card("joined_trees_are_those_of_the_cpu") else { return };
    let mut numbers = Numbers(0x1f12_3bb5);
    let faults: Vec<String> = (0..4)
        .flat_map(|number| faults_of(&card, &format!("joined trees {number}"), &trees(&mut numbers)))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Of surfaces that coincide the first in the scene counts: of parts, of bodies, and of members of groups.
#[test]
fn joined_surfaces_that_coincide_are_those_of_the_cpu() {
    let Some(card) = card("joined_surfaces_that_coincide_are_those_of_the_cpu") else { return };
    let cube = |x: f64, y: f64, z: f64| Shape::Cube { size: DVec3::new(x, y, z) };
    let mirror = phong([0.5; 3], 0.6, 0.0);
    let block = part(cube(1.6, 1.6, 1.6), DVec3::ZERO);
    let slot = part(cube(0.6, 0.6, 1.6), DVec3::new(0.2, 0.5, 0.0));
    let slotted = |x, material| {
        joined(Shape::Difference, DVec3::new(x, -1.0, 0.0), vec![block.clone(), slot.clone()], material)
    };
    let filled = Body {
        shape: cube(0.6, 0.6, 1.6),
        placement: Placement::at(DVec3::new(-1.0, -0.5, 0.0)),
        material: mirror.clone(),
        ..Body::default()
    };
    // A member comes before bodies that stand behind its group in the scene, though its number is larger.
    let member = BodyPart {
        material: Some(phong([0.9, 0.2, 0.1], 0.0, 0.0)),
        ..part(cube(1.0, 0.7, 1.0), DVec3::ZERO)
    };
    let group = joined(Shape::Group, DVec3::new(0.6, 0.3, 0.0), vec![member], phong([0.5; 3], 0.0, 0.0));
    let later = Body {
        shape: cube(1.0, 0.7, 0.6),
        placement: Placement::at(DVec3::new(0.9, 0.3, 0.2)),
        material: phong([0.1, 0.8, 0.3], 0.0, 0.0),
        ..Body::default()
    };
    let halves = [-0.4, 0.4].map(|x| part(cube(0.8, 0.7, 0.8), DVec3::new(x, 0.0, 0.0)));
    let seam = joined(Shape::Union, DVec3::new(-0.9, 1.1, 0.0), halves.into(), mirror);
    let bodies = vec![
        slotted(-1.2, phong([0.7, 0.5, 0.2], 0.0, 0.0)),
        filled,
        slotted(0.8, phong([0.3, 0.4, 0.8], 0.0, 0.0)),
        group,
        later,
        seam,
    ];
    let faults = faults_of(&card, "joined surfaces that coincide", &lit(bodies));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Surfaces without inside: of all shapes, cut and not, of materials that reflect, let light pass and absorb it, and members
/// of groups.
#[test]
fn surfaces_are_those_of_the_cpu() {
    let Some(card) = card("surfaces_are_those_of_the_cpu") else { return };
    let parametric = |shape: ShapeKind, at: DVec3, material: MaterialChoice| {
        let rotation_degrees = DVec3::new(25.0, 10.0, 35.0);
        let anchor = Anchor::Frame { position: at, rotation_degrees };
        let placement = Placement { anchor, scale: DVec3::splat(1.2) };
        Body { placement, material, ..Body::of_shape(shape.body_shape()) }
    };
    let attenuation = Attenuation { color: Color { r: 0.9, g: 0.5, b: 0.1 }, distance: 0.5 };
    let glass = MaterialChoice::own(Dielectric { attenuation, ..Dielectric::default() });
    let clear = || phong([0.9, 0.6, 0.3], 0.1, 0.7);
    let ball = part(Shape::Sphere { radius: 0.8 }, DVec3::ZERO);
    let slab = part(Shape::Cube { size: DVec3::new(2.0, 0.8, 2.0) }, DVec3::new(0.0, 0.1, 0.0));
    let hole = part(Shape::Cylinder { radius: 0.4, height: 4.0 }, DVec3::new(0.0, -2.0, 0.0));
    let cut = BodyPart { parts: vec![slab, hole], ..part(Shape::Difference, DVec3::ZERO) };
    let bodies = vec![
        parametric(ShapeKind::OpenCylinder, DVec3::new(-1.6, 0.2, 0.0), phong([0.6; 3], 0.5, 0.0)),
        parametric(ShapeKind::OpenCone, DVec3::new(0.0, -1.4, 0.6), clear()),
        parametric(ShapeKind::Disc, DVec3::new(-0.4, 0.9, -0.5), phong([0.3, 0.7, 0.4], 0.0, 0.0)),
        parametric(ShapeKind::Rectangle, DVec3::new(1.5, 0.6, -0.8), clear()),
        parametric(ShapeKind::Triangle, DVec3::new(-1.2, -1.2, 0.9), phong([0.8, 0.4, 0.2], 0.0, 0.0)),
        parametric(ShapeKind::OpenCylinder, DVec3::new(1.0, -0.9, 0.9), glass),
        joined(Shape::SURFACE, DVec3::new(0.6, 0.8, 0.4), vec![ball, cut], phong([0.7; 3], 0.3, 0.0)),
        joined(
            Shape::Group,
            DVec3::new(-2.2, 1.2, -0.6),
            vec![BodyPart {
                shape: Shape::SURFACE,
                parts: vec![part(Shape::PARABOLOID, DVec3::ZERO)],
                ..BodyPart::default()
            }],
            clear(),
        ),
    ];
    for (side, name) in [("both", "surfaces"), ("outer", "outer sides"), ("inner", "inner sides")] {
        let mut bodies = bodies.clone();
        bodies.iter_mut().for_each(|body| body.change_shape(|shape| shape.set_word("visible_side", side)));
        let mut scene = lit(bodies);
        scene.tracing.generations = 4;
        let faults = faults_of(&card, name, &scene);
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }
}

/// A lens is one medium, whatever it is made of, also for rays that start in it.
#[test]
fn joined_media_are_those_of_the_cpu() {
    let Some(card) = card("joined_media_are_those_of_the_cpu") else { return };
    let attenuation = Attenuation { color: Color { r: 0.9, g: 0.5, b: 0.1 }, distance: 0.5 };
    let glass = || MaterialChoice::own(Dielectric { attenuation, ..Dielectric::default() });
    let ball = |radius, x| part(Shape::Sphere { radius }, DVec3::new(x, 0.0, 0.0));
    let lens = joined(
        Shape::Intersection,
        DVec3::new(-1.2, 0.0, 0.5),
        vec![ball(1.2, -0.8), ball(1.2, 0.8)],
        glass(),
    );
    let twin =
        joined(Shape::Union, DVec3::new(1.1, 0.1, 0.0), vec![ball(0.6, -0.3), ball(0.6, 0.3)], glass());
    let shell =
        joined(Shape::Difference, DVec3::new(0.0, 0.0, -1.5), vec![ball(0.9, 0.0), ball(0.6, 0.0)], glass());
    let mut scene = lit(vec![lens, twin, shell]);
    // Each ray has to be asked where it starts.
    scene.camera.projection = Projection::Parallel { height: 4.0 };
    let mut faults = faults_of(&card, "joined media", &scene);
    scene.camera.position = DVec3::new(0.1, 0.1, 0.1);
    faults.extend(faults_of(&card, "rays that start in joined media", &scene));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
