//! The tree of rays: generations, thresholds, weights and sums.

use std::sync::atomic::AtomicBool;

use catoptric_picture::Picture;
use catoptric_scene::{Color, Material, Pattern, Phong, Scene, SolidTexture};
use catoptric_tracer::{RayCounts, RayKind, WhittedIntegrator};
use glam::{DVec2, DVec3, Vec3};

use crate::proof::common::{
    assert_close, assert_same_picture, ball, glass, mirror, picture, plane, ray, render_scene, tree, v,
};
use crate::proof::samples::gallery;

#[test]
fn the_contributions_of_all_rays_sum_to_the_pixel() {
    let render_scene = render_scene(&gallery());
    let cancel = AtomicBool::new(false);
    let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
    let size = DVec2::new(48.0, 27.0);
    for pixel in 0..48 * 27 {
        let at = DVec2::new(f64::from(pixel % 48) + 0.5, f64::from(pixel / 48) + 0.5);
        let light = tracer.trace(at, size);
        let rays = tracer.tree(render_scene.camera().ray(at, size), usize::MAX);
        assert_eq!(rays.iter().map(|ray| ray.light).sum::<Vec3>(), light.into(), "at {at}");
    }
}

#[test]
fn weights_are_products_of_coefficients_and_generations_count_from_the_eye() {
    let scene = gallery();
    let render_scene = render_scene(&scene);
    let mut seen = 0;
    for pixel in 0..200 {
        let at = DVec2::new(f64::from(pixel % 20) + 0.5, f64::from(pixel / 20) + 0.5);
        let rays = tree(&render_scene, render_scene.camera().ray(at, DVec2::new(20.0, 10.0)));
        assert_eq!((rays[0].kind, rays[0].generation, rays[0].weight), (RayKind::Primary, 1, Vec3::ONE));
        for ray in &rays[1..] {
            let parent = &rays[ray.parent.unwrap()];
            assert_eq!(ray.generation, parent.generation + 1);
            let hit = parent.hit.unwrap();
            let material =
                scene.material(&scene.bodies[hit.body].material).and_then(Material::as_phong).unwrap();
            let tint = Vec3::from_array(material.tint.to_array().map(|channel| channel as f32));
            let refracted = tint * material.transmission as f32;
            // The only child of a transparent surface is a total reflection, if anything is let through.
            let children = rays.iter().filter(|other| other.parent == ray.parent).count();
            let coefficient = match ray.kind {
                RayKind::Refracted => refracted,
                _ if refracted != Vec3::ZERO && children == 1 => Vec3::ONE,
                _ => Vec3::splat(material.reflection() as f32),
            };
            assert!((ray.weight - parent.weight * coefficient).length() < 1e-6);
            assert_eq!(ray.origin, hit.position);
            seen += 1;
        }
    }
    assert!(seen > 500, "only {seen} rays to judge by");
}

#[test]
fn no_ray_is_older_than_the_limit_and_the_last_shades_itself() {
    for limit in [1, 2, 3, 7] {
        let render_scene = render_scene(&gallery()).with_generations(limit);
        let rays: Vec<_> = (0..400)
            .flat_map(|pixel| {
                let at = DVec2::new(f64::from(pixel % 25) + 0.5, f64::from(pixel / 25) + 0.5);
                tree(&render_scene, render_scene.camera().ray(at, DVec2::new(25.0, 16.0)))
            })
            .collect();
        assert_eq!(rays.iter().map(|ray| ray.generation).max(), Some(limit));
        assert!(rays.iter().any(|ray| ray.generation == limit && ray.light != Vec3::ZERO));
    }
}

#[test]
fn another_generation_never_darkens() {
    let mut scene = gallery();
    scene.environment.background = Color::BLACK;
    let mut shallow: Option<Picture> = None;
    for generations in 1..=8 {
        scene.tracing.generations = generations;
        let deep = picture(&scene, 64, 48);
        if let Some(shallow) = &shallow {
            let pairs = shallow.pixels().iter().zip(deep.pixels());
            let least = pairs.flat_map(|(a, b)| [b[0] - a[0], b[1] - a[1], b[2] - a[2]]).fold(0.0, f32::min);
            // Equal sums in another order may differ by rounding.
            assert!(least > -1e-6, "generation {generations} takes away {least:e}");
            assert_ne!(shallow.pixels(), deep.pixels(), "generation {generations} adds nothing");
        }
        shallow = Some(deep);
    }
}

fn without_coefficients(scene: &Scene) -> Scene {
    let mut local = scene.clone();
    for body in &mut local.bodies {
        let mut material = scene.material(&body.material).and_then(Material::as_phong).unwrap().clone();
        (material.reflection, material.transmission) = (Some(0.0), 0.0);
        body.material = catoptric_scene::MaterialChoice::own(material);
    }
    local
}

#[test]
fn without_reflection_and_transmission_only_the_local_model_is_left() {
    let deep = without_coefficients(&gallery());
    let mut flat = deep.clone();
    flat.tracing.generations = 1;
    assert_eq!(picture(&deep, 64, 48).pixels(), picture(&flat, 64, 48).pixels());
}

#[test]
fn rays_below_the_threshold_are_not_traced() {
    let mut wall = mirror();
    wall.reflection = Some(0.5);
    let mut scene = crate::proof::common::scene(vec![
        plane(DVec3::ZERO, -90.0, wall.clone()),
        plane(DVec3::X, 90.0, wall),
    ]);
    let start = ray(v(0.5, 0.0, 0.0), DVec3::X);
    for (threshold, rays) in [(0.6, 1), (0.5, 2), (0.3, 2), (0.25, 3), (0.2, 3), (1e-3, 10), (0.0, 64)] {
        scene.tracing.threshold = threshold;
        assert_eq!(tree(&render_scene(&scene), start).len(), rays, "threshold {threshold}");
    }
}

#[test]
fn the_strongest_channel_decides_at_the_threshold() {
    let mut red = glass(1.2);
    red.tint = Color::new(0.5, 0.01, 0.0);
    let mut scene = crate::proof::common::scene(vec![ball(1.0, DVec3::ZERO, red)]);
    let start = ray(v(0.0, 0.0, 5.0), DVec3::NEG_Z);
    for (threshold, rays) in [(0.2, 3), (0.3, 2), (0.6, 1)] {
        scene.tracing.threshold = threshold;
        assert_eq!(tree(&render_scene(&scene), start).len(), rays, "threshold {threshold}");
    }
}

#[test]
fn a_tiny_threshold_changes_nothing_visible() {
    let mut scene = gallery();
    let all = picture(&scene, 96, 64);
    scene.tracing.threshold = 1e-7;
    assert_same_picture(&all, &picture(&scene, 96, 64), 0.0);
}

#[test]
fn coefficients_above_one_and_bright_lights_are_not_clamped_on_the_way() {
    let mut wall = mirror();
    (wall.pattern.color, wall.ambient, wall.reflection) = (Color::WHITE, 2.0, Some(1.5));
    let mut scene = crate::proof::common::scene(vec![
        plane(DVec3::ZERO, -90.0, wall.clone()),
        plane(DVec3::X, 90.0, wall),
    ]);
    scene.tracing.generations = 10;
    let sum: f64 = (0..10).map(|k| 2.0 * 1.5_f64.powi(k)).sum();
    let light: Vec3 =
        tree(&render_scene(&scene), ray(v(0.5, 0.0, 0.0), DVec3::X)).iter().map(|ray| ray.light).sum();
    assert_close(f64::from(light.y), sum, 1e-5 * sum);
}

#[test]
fn rays_are_counted_by_kind() {
    // A lamp of two lights over a half-mirror seen in a glass pane: every number can be told by hand.
    let mut scene = crate::proof::common::scene(vec![
        plane(DVec3::ZERO, 0.0, Material::Phong(Phong { reflection: Some(0.5), ..Phong::default() })),
        crate::proof::common::block(v(10.0, 0.1, 10.0), v(0.0, 3.0, 0.0), glass(1.5)),
    ]);
    scene.lights = [1.0, -1.0]
        .map(|x| crate::proof::common::light(v(x, 2.0, 0.0), 1.0, catoptric_scene::Falloff::None))
        .to_vec();
    let render_scene = render_scene(&scene);
    let cancel = AtomicBool::new(false);
    let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
    let start = ray(v(0.0, 5.0, 0.0), v(0.1, -1.0, 0.0));
    let rays = tracer.tree(start, 1000);
    // Into the pane, out of it, to the floor, up, into the pane, out into the sky.
    assert_eq!(rays.len(), 6);
    let counts = RayCounts { primary: 1, shadow: 2, reflected: 1, refracted: 4 };
    assert_eq!(tracer.counts(), counts);
    assert_eq!(counts.total(), 8);
    assert_eq!(tracer.counts() - counts, RayCounts::default());
}

#[test]
fn a_checker_of_two_colors_is_reflected_as_it_is() {
    let checker = Some(SolidTexture { color: Color::BLACK, size: 1.0, ..SolidTexture::default() });
    let floor = Material::Phong(Phong {
        pattern: Pattern { color: Color::WHITE, solid: checker, ..Pattern::default() },
        ambient: 1.0,
        diffuse: 0.0,
        ..Phong::default()
    });
    let render_scene = crate::proof::common::stage_of(vec![
        plane(DVec3::ZERO, 0.0, floor),
        plane(v(0.0, 4.0, 0.0), 180.0, mirror()),
    ]);
    for cell in -20..20 {
        let at = v(f64::from(cell) + 0.5, 4.0, 0.0);
        let from = v(0.0, 1.0, 0.3);
        let rays = tree(&render_scene, ray(from, at - from));
        // Unfolded: the floor's image is at y = 8.
        let x = from.x + (at.x - from.x) * 7.0 / 3.0;
        let z = from.z * (1.0 - 7.0 / 3.0);
        let even = (x.floor() + z.floor()).rem_euclid(2.0) == 0.0;
        assert_eq!(rays[1].light.x > 0.5, even, "{x} {z}");
    }
}
