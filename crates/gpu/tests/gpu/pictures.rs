//! Skies, pictures around the bodies and textures where the examples do not go: every shape, edges and poles, light of
//! any strength, and what an edit sends.

use std::sync::Arc;

use catoptric_gpu::{GpuFilm, GpuScene, render, wait};
use catoptric_picture::{Difference, Picture};
use catoptric_scene::{
    Anchor, Body, Coated, Color, Image, Light, Material, MaterialChoice, Mirror, Model, Pattern,
    PatternSpace, Phong, Placement, Projection, Scene, Shape, Sky, SolidKind, SolidTexture, Surroundings,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use glam::DVec3;

use crate::common::{card, stage_of};
use crate::parity::{compare, fault};

/// A picture of which no pixel is like its neighbors, as bright as `most`.
fn patches(name: &str, width: u32, height: u32, most: f32) -> Image {
    let part = |x: u32, y: u32, channel: u32| {
        let mixed = (x * 31 + y * 57 + channel * 101).wrapping_mul(2_654_435_761) >> 24;
        most * mixed as f32 / 255.0
    };
    let picture =
        Picture::from_fn(width, height, |x, y| [part(x, y, 0), part(x, y, 1), part(x, y, 2)]).unwrap();
    Image::with_pixels(name, Arc::new(picture))
}

/// A body that stands askew.
fn body(shape: Shape, at: DVec3, material: &Material) -> Body {
    let rotation_degrees = DVec3::new(25.0, 40.0, -15.0);
    let placement = Placement { anchor: Anchor::Frame { position: at, rotation_degrees }, scale: DVec3::ONE };
    Body { shape, placement, material: MaterialChoice::Inline(Box::new(material.clone())), ..Body::default() }
}

/// Every shape, with the material, on a floor of its own.
fn shapes(material: &Material, floor: &Material) -> Scene {
    let frustum = Shape::Cone { radius: 0.6, top_radius: 0.3, height: 1.2 };
    let mut ellipsoid = body(Shape::Sphere { radius: 0.5 }, DVec3::new(2.0, 0.1, -1.2), material);
    ellipsoid.placement.scale = DVec3::new(1.2, 0.7, 1.0);
    let mut flat = body(Shape::Plane, DVec3::ZERO, floor);
    flat.placement.anchor =
        Anchor::Frame { position: DVec3::new(0.1, -0.9, 0.2), rotation_degrees: DVec3::new(0.0, 33.0, 0.0) };
    let mut scene = Scene {
        bodies: [
            body(Shape::Sphere { radius: 0.7 }, DVec3::new(-1.6, 0.2, 0.0), material),
            body(Shape::Cube { size: DVec3::splat(0.9) }, DVec3::new(0.0, 0.0, 0.4), material),
            body(Shape::Cylinder { radius: 0.5, height: 1.0 }, DVec3::new(1.4, -0.5, 0.3), material),
            body(frustum, DVec3::new(-0.6, -0.3, -1.6), material),
            body(Shape::PARABOLOID, DVec3::new(0.7, -0.7, -1.0), material),
            ellipsoid,
            flat,
        ]
        .into(),
        lights: vec![Light { position: DVec3::new(2.0, 5.0, 5.0), ..Light::default() }],
        ..Scene::default()
    };
    scene.camera.position = DVec3::new(0.3, 1.6, 4.6);
    scene.camera.target = DVec3::new(0.0, -0.1, 0.0);
    (scene.tracing.generations, scene.tracing.threshold) = (4, 0.01);
    scene
}

#[test]
fn textures_of_all_shapes_are_those_of_the_cpu() {
    let Some(card) = card("textures_of_all_shapes_are_those_of_the_cpu") else { return };
    let solid = Some(SolidTexture { size: 0.3, ..SolidTexture::default() });
    let floor = Material::Phong(Phong {
        pattern: Pattern { texture: Some(patches("floor", 3, 2, 0.8)), ..Pattern::default() },
        ..Phong::default()
    });
    let glass = Material::Phong(Phong { transmission: 0.5, ior: 1.2, ..Phong::default() });
    let models = [
        (
            "phong",
            Material::Phong(Phong { pattern: Pattern { solid, ..Pattern::default() }, ..Phong::default() }),
        ),
        ("clear phong", glass),
        ("mirror", Material::Mirror(Mirror::default())),
        ("coated", Material::Coated(Coated { roughness: 0.3, ..Coated::default() })),
    ];
    for (name, material) in models {
        let of = |image: Image| {
            let mut material: Material = material.clone();
            material.pattern_mut().unwrap().texture = Some(image);
            let mut scene = shapes(&material, &floor);
            scene.environment.surroundings = Surroundings::Sky(Sky::default());
            stage_of(&scene)
        };
        // Neither side of the one divides a row of the card's texture.
        let compared = compare(&card, &of(patches("odd", 37, 23, 1.0)), 1);
        assert_eq!(fault(&format!("textures, {name}"), &compared), None);
        let other = compare(&card, &of(patches("other", 5, 4, 1.0)), 1);
        assert_eq!(fault(&format!("coarse textures, {name}"), &other), None);
        let difference = Difference::between(&compared.gpu.0, &other.gpu.0).unwrap();
        assert!(difference.share_above > 0.1, "{name}: another texture looks the same: {difference:?}");
    }
}

#[test]
fn patterns_are_those_of_the_cpu() {
    let Some(card) = card("patterns_are_those_of_the_cpu") else { return };
    let turned = |kind| SolidTexture {
        size: 0.3,
        rotation_degrees: DVec3::new(10.0, 20.0, 30.0),
        position: DVec3::new(0.1, 0.2, 0.3),
        ..SolidTexture::new(kind, Color::new(0.9, 0.1, 0.2))
    };
    let of_body = |kind| SolidTexture { space: PatternSpace::Body, ..turned(kind) };
    let [checker, stripes, rings, gradient] = SolidKind::ALL.map(turned);
    let nested = SolidTexture {
        first: Some(Box::new(SolidTexture { first: Some(Box::new(rings.clone())), ..stripes.clone() })),
        second: Some(Box::new(SolidTexture { size: 0.1, ..of_body(SolidKind::Gradient) })),
        ..checker
    };
    let floor = Material::Phong(Phong::default());
    let mut seen = Vec::new();
    for (name, solid) in [
        ("stripes", stripes),
        ("rings", rings),
        ("gradient", gradient),
        ("rings of the body", of_body(SolidKind::Rings)),
        ("nested", nested),
    ] {
        let pattern = Pattern { solid: Some(solid), ..Pattern::default() };
        let material = Material::Phong(Phong { pattern, ..Phong::default() });
        let compared = compare(&card, &stage_of(&shapes(&material, &floor)), 1);
        assert_eq!(fault(name, &compared), None);
        for other in &seen {
            let difference = Difference::between(&compared.gpu.0, other).unwrap();
            assert!(difference.share_above > 0.02, "{name} looks like another: {difference:?}");
        }
        seen.push(compared.gpu.0);
    }
}

/// A mirror in the middle of what is around it.
fn surrounded(
    surroundings: Surroundings,
    model: Model,
    strength: f64,
    rotation: f64,
    target: DVec3,
) -> RenderScene {
    let ball = body(Shape::Sphere { radius: 0.6 }, DVec3::new(0.0, 0.0, -3.0), &model.into());
    let mut scene = Scene { bodies: [ball].into(), lights: vec![Light::default()], ..Scene::default() };
    scene.camera.position = DVec3::ZERO;
    scene.camera.target = target;
    scene.camera.projection = Projection::Perspective { fov_degrees: 100.0 };
    scene.environment.surroundings = surroundings;
    (scene.environment.strength, scene.environment.rotation_degrees) = (strength, rotation);
    stage_of(&scene)
}

#[test]
fn surroundings_are_those_of_the_cpu_in_all_directions() {
    let Some(card) = card("surroundings_are_those_of_the_cpu_in_all_directions") else { return };
    let color = |r, g, b| Color { r, g, b };
    let sky =
        Sky { zenith: color(0.1, 0.3, 0.9), horizon: color(0.9, 0.8, 0.2), nadir: color(0.0, 0.1, 0.0) };
    // Behind is the edge of a picture, above and below are its poles.
    let targets =
        [DVec3::NEG_Z, DVec3::Z, DVec3::X, DVec3::new(0.0, 1.0, -0.001), DVec3::new(0.01, -1.0, 0.0)];
    for (number, target) in targets.into_iter().enumerate() {
        let render_scenes = [
            surrounded(Surroundings::Sky(sky), Model::Phong, 1.2, 0.0, target),
            surrounded(Surroundings::Picture(patches("around", 61, 33, 1.0)), Model::Phong, 0.8, 0.0, target),
            // As bright as pictures may be.
            surrounded(
                Surroundings::Picture(patches("bright", 16, 8, 1e6)),
                Model::Mirror,
                1e-6,
                77.0,
                target,
            ),
            // Numbers so small that cards may take them for 0.
            surrounded(
                Surroundings::Picture(patches("faint", 16, 8, 1e-30)),
                Model::Mirror,
                1e30,
                77.0,
                target,
            ),
        ];
        let pictures = render_scenes.map(|render_scene| {
            let compared = compare(&card, &render_scene, 1);
            assert_eq!(fault(&format!("surroundings {number}"), &compared), None);
            compared.gpu.0
        });
        for (one, other) in [(0, 1), (1, 2), (0, 3)] {
            let difference = Difference::between(&pictures[one], &pictures[other]).unwrap();
            assert!(difference.share_above > 0.5, "{number}: {one} looks like {other}: {difference:?}");
        }
    }
}

/// Pictures are sent when they are others, not when something else changes.
#[test]
fn an_edit_sends_pictures_that_are_new() {
    const ROW: u64 = 8192 * 16;
    let Some(card) = card("an_edit_sends_pictures_that_are_new") else { return };
    let [first, second] = ["first", "second"].map(|name| patches(name, 64, 32, 1.0));
    let textured = |image: &Image| Phong {
        pattern: Pattern { texture: Some(image.clone()), ..Pattern::default() },
        ..Phong::default()
    };
    let mut scene = shapes(&textured(&first).into(), &Material::default());
    scene.environment.surroundings = Surroundings::Picture(patches("around", 200, 100, 1.0));
    let mut on_card = wait(GpuScene::new(&card)).unwrap();
    let render_scene = stage_of(&scene);
    let all = wait(on_card.follow(&card, &render_scene, render_scene.camera())).unwrap();
    // 20,000 pixels and 2048.
    assert!((3 * ROW..4 * ROW).contains(&all), "{all}");
    let mut edit = |change: &dyn Fn(&mut Scene)| {
        change(&mut scene);
        let render_scene = stage_of(&scene);
        let sent = wait(on_card.follow(&card, &render_scene, render_scene.camera())).unwrap();
        let settings = RenderSettings { width: 96, height: 64, samples: 1 };
        let mut film = wait(GpuFilm::new(&card, settings.width, settings.height)).unwrap();
        let control = RenderControl::default();
        wait(film.add_samples(&card, (&render_scene, &on_card), render_scene.camera(), 1, &control)).unwrap();
        let anew = wait(render(&card, &render_scene, render_scene.camera(), settings, &control)).unwrap();
        assert_eq!(wait(film.picture(&card)).unwrap(), anew.picture);
        sent
    };
    let give = |material: Material| {
        move |scene: &mut Scene| {
            scene.bodies[0].material = MaterialChoice::Inline(Box::new(material.clone()));
        }
    };
    let moved = edit(&|scene| scene.camera.position.x += 0.1);
    let recolored = edit(&give(Phong { reflection: Some(0.4), ..textured(&first) }.into()));
    let turned = edit(&|scene| scene.environment.rotation_degrees = 30.0);
    assert!([moved, recolored, turned].into_iter().all(|sent| sent < 4096), "{moved} {recolored} {turned}");
    let more = edit(&give(textured(&second).into()));
    assert!((3 * ROW..4 * ROW).contains(&more), "{more}");
    let fewer = edit(&|scene| scene.environment.surroundings = Surroundings::Even);
    assert!((ROW..2 * ROW).contains(&fewer), "{fewer}");
}
