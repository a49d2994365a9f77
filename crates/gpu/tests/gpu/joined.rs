//! Joined bodies: the reference scenes, trees of any kind, surfaces that coincide, media.

use catoptric_gpu::Gpu;
use catoptric_scene::{
    Anchor, Attenuation, Body, BodyPart, Checker, Color, Dielectric, Light, MaterialChoice, ParaboloidDepth,
    Pattern, Phong, Placement, Projection, Scene, Shape,
};
use catoptric_tracer::shaders::{SceneContents, ShaderSpecialization};
use glam::DVec3;

use crate::common::{card, joined_references, stage_of};
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
    let checker = (reflection == 0.0).then(Checker::default);
    let pattern = Pattern { checker, ..Color { r, g, b }.into() };
    let reflection = Some(reflection);
    MaterialChoice::own(Phong { pattern, reflection, transmission, ior: 1.4, ..Phong::default() })
}

fn any_material(numbers: &mut Numbers) -> MaterialChoice {
    let color = [0; 3].map(|_| numbers.between(0.2, 1.0));
    let [reflection, transmission] = [[0.0, 0.0], [0.5, 0.0], [0.1, 0.7]][numbers.below(3) as usize];
    phong(color, reflection, transmission)
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
    let is_simple = depth == 0 || numbers.below(4) == 0;
    let shape =
        if is_simple { simple[numbers.below(6) as usize] } else { compound[numbers.below(3) as usize] };
    let own = numbers.below(4) == 0;
    let material = own.then(|| any_material(numbers));
    let count = if is_simple { 0 } else { 2 + numbers.below(3) };
    let parts = (0..count).map(|_| tree(numbers, depth - 1)).collect();
    BodyPart { parts, material, ..part(shape, numbers.point(0.6)) }
}

/// Small bodies behind the eye, so that all scenes are of one kind: a software driver compiles a shader for seconds. They
/// are few, since it ends what has very many turns of loops.
fn of_one_kind(mut scene: Scene) -> Scene {
    let eye = scene.camera.position;
    let behind = eye + 0.5 * (eye - scene.camera.target).normalize();
    let small = |shape, at: usize| part(shape, 0.02 * DVec3::new(at as f64, 0.0, 0.0));
    let size = 0.005;
    let ball = Shape::Sphere { radius: size };
    let shapes = [
        Shape::Cube { size: DVec3::splat(size) },
        Shape::Cylinder { radius: size, height: size },
        Shape::Cone { radius: size, top_radius: 0.0, height: size },
        Shape::Paraboloid { radius: size, depth: ParaboloidDepth::Height(size) },
        ball,
    ];
    let mut parts: Vec<BodyPart> = shapes.into_iter().zip(0..).map(|(shape, at)| small(shape, at)).collect();
    parts[4].placement.scale = DVec3::new(1.0, 2.0, 3.0);
    parts.extend((5..40).map(|at| small(ball, at)));
    let half = vec![small(ball, 40), small(Shape::Plane, 0)];
    parts.push(BodyPart { parts: half, ..small(Shape::Intersection, 0) });
    scene.bodies.push(joined(Shape::Union, behind, parts, phong([0.5; 3], 0.0, 0.0)));
    for at in 0..3 {
        if kind_of(&scene).media < 4 {
            let at = behind + DVec3::new(0.0, 0.1, 0.02 * f64::from(at));
            let material = phong([0.9; 3], 0.1, 0.8);
            scene.bodies.push(Body {
                shape: ball,
                placement: Placement::at(at),
                material,
                ..Body::default()
            });
        }
    }
    scene.tracing.generations = scene.tracing.generations.clamp(5, 8);
    scene
}

fn kind_of(scene: &Scene) -> ShaderSpecialization {
    let render_scene = stage_of(scene);
    let contents = SceneContents::of(&render_scene);
    ShaderSpecialization::of(&contents, &render_scene, render_scene.camera()).unwrap()
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

/// A scene of trees, each within a ball.
fn trees(numbers: &mut Numbers) -> Scene {
    let mut bodies = Vec::new();
    for _ in 0..6 {
        let depth = 1 + numbers.below(5);
        let parts = vec![part(Shape::Sphere { radius: 1.2 }, DVec3::ZERO), tree(numbers, depth)];
        let shape = [Shape::Intersection, Shape::Difference][numbers.below(2) as usize];
        let rotation_degrees = numbers.point(180.0);
        let anchor = Anchor::Frame { position: numbers.point(1.6), rotation_degrees };
        let material = any_material(numbers);
        let mut body = joined(shape, DVec3::ZERO, parts, material);
        body.placement = Placement { anchor, scale: DVec3::new(1.0, numbers.between(0.6, 1.0), 1.0) };
        bodies.push(body);
    }
    lit(bodies)
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
fn joined_bodies_are_those_of_the_cpu() {
    let Some(card) = card("joined_bodies_are_those_of_the_cpu") else { return };
    let mut numbers = Numbers(0x1f12_3bb5);
    let random = (0..6).map(|number| (format!("joined trees {number}"), trees(&mut numbers)));
    let scenes = joined_references().into_iter().chain(random).chain([coincident()]);
    let faults: Vec<String> =
        scenes.flat_map(|(name, scene)| faults_of(&card, &name, &of_one_kind(scene))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Of surfaces that coincide the first in the scene counts: of parts, of bodies, and of members of groups.
fn coincident() -> (String, Scene) {
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
    ("joined surfaces that coincide".to_owned(), lit(bodies))
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
