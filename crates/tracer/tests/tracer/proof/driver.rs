//! The driver: threads, progress, cancellation, counts, samples.

use catoptric_scene::{Color, Dielectric, Material, Phong, Shape};
use catoptric_tracer::{
    RenderControl, RenderError, RenderOutput, RenderScene, RenderSettings, SceneBuildError, render,
    render_pixel, sample_offset,
};
use glam::{DVec2, DVec3, UVec2, Vec3A};
use rayon::ThreadPoolBuilder;

use crate::proof::common::{ball, endless, glass, placed, render_scene, scene, v};
use crate::proof::samples::{LARGE, crowd, gallery};

const SETTINGS: RenderSettings = RenderSettings { width: 101, height: 67, samples: 1 };

fn on_threads(threads: usize, render_scene: &RenderScene, settings: RenderSettings) -> RenderOutput {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| render(render_scene, settings, &RenderControl::default())).unwrap()
}

#[test]
fn the_picture_and_the_counts_do_not_depend_on_the_threads() {
    let few = SETTINGS;
    for (scene, settings) in [
        (gallery(), few),
        (gallery(), RenderSettings { samples: 3, ..few }),
        (crowd(), few),
        (crowd(), LARGE),
    ] {
        let render_scene = render_scene(&scene);
        let one = on_threads(1, &render_scene, settings);
        assert!(one.counts.reflected > 0 && one.counts.refracted > 0 && one.counts.shadow > 0);
        assert_eq!(one.counts.primary, u64::from(settings.width * settings.height * settings.samples));
        for threads in [2, 3, 7] {
            let more = on_threads(threads, &render_scene, settings);
            let bits = |rendering: &RenderOutput| -> Vec<u32> {
                rendering.picture.pixels().iter().flatten().map(|channel| channel.to_bits()).collect()
            };
            assert!(bits(&one) == bits(&more), "{threads} threads give another picture");
            assert_eq!(one.counts, more.counts, "{threads} threads");
        }
    }
}

#[test]
fn a_stage_prepared_on_any_number_of_threads_is_the_same() {
    // Enough bodies for the hierarchy to be built in parallel.
    let mut crowd = scene(
        (0..9000)
            .map(|k| {
                let (i, j) = (f64::from(k % 100), f64::from(k / 100));
                ball(0.4, v(i - 50.0, (0.7 * i).sin() + (0.9 * j).cos(), -j), Material::default())
            })
            .collect(),
    );
    crowd.lights = gallery().lights;
    let pictures = [1, 2, 7].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let render_scene = pool.install(|| render_scene(&crowd));
        on_threads(2, &render_scene, SETTINGS).picture
    });
    assert!(pictures[0] == pictures[1] && pictures[1] == pictures[2]);
}

#[test]
fn progress_counts_every_pixel_once() {
    for (width, height) in [(1, 1), (16, 16), (17, 33), (101, 67)] {
        let control = RenderControl::default();
        let settings = RenderSettings { width, height, samples: 1 };
        render(&render_scene(&gallery()), settings, &control).unwrap();
        assert_eq!(control.pixels_done(), u64::from(width) * u64::from(height));
        assert!(!control.is_cancelled());
    }
}

#[test]
fn a_render_cancelled_before_it_begins_gives_no_picture() {
    let control = RenderControl::default();
    control.cancel();
    assert!(matches!(render(&render_scene(&gallery()), SETTINGS, &control), Err(RenderError::Cancelled)));
    assert!(control.pixels_done() < u64::from(SETTINGS.width * SETTINGS.height));
}

#[test]
fn progress_counts_every_ray_once() {
    for (scene, samples) in [(gallery(), 1), (gallery(), 3), (crowd(), 1)] {
        let control = RenderControl::default();
        let rendering =
            render(&render_scene(&scene), RenderSettings { samples, ..SETTINGS }, &control).unwrap();
        assert_eq!(control.rays_done(), rendering.counts.total());
    }
}

/// Two balls in one another, each of which splits every ray in two: pixels of billions of rays.
fn nested() -> RenderScene {
    let mut nested = scene(vec![
        ball(1.0, v(0.0, 1.0, 0.0), Material::Dielectric(Dielectric::default())),
        ball(
            0.9,
            v(0.0, 1.0, 0.0),
            Material::Dielectric(Dielectric { index: 1.0.into(), ..Dielectric::default() }),
        ),
    ]);
    nested.lights = gallery().lights;
    nested.camera.position = DVec3::new(0.0, 1.0, 6.0);
    nested.tracing.generations = 30;
    render_scene(&nested)
}

#[test]
fn a_render_stops_within_a_pixel_when_it_is_cancelled() {
    const THREADS: u64 = 2;
    let pool = ThreadPoolBuilder::new().num_threads(THREADS as usize).build().unwrap();
    for render_scene in [endless(), nested()] {
        let control = RenderControl::default();
        let settings = RenderSettings { width: 160, height: 120, samples: 1 };
        let (result, before) = std::thread::scope(|scope| {
            let running = scope.spawn(|| pool.install(|| render(&render_scene, settings, &control)));
            // Rays are counted while the first trees are traced, which have no end.
            while control.rays_done() < 1_000_000 {
                assert!(!running.is_finished());
                std::thread::yield_now();
            }
            control.cancel();
            let before = control.rays_done();
            (running.join().unwrap(), before)
        });
        assert!(matches!(result, Err(RenderError::Cancelled)));
        // Packets that are under way, and rays that were not told yet: less than a hundredth of a second's.
        let after = control.rays_done() - before;
        assert!(after < 100_000 * THREADS, "{after} rays after the request");
    }
}

#[test]
fn sizes_that_cannot_be_are_errors() {
    for (width, height) in [(0, 5), (5, 0), (u32::MAX, u32::MAX)] {
        let settings = RenderSettings { width, height, samples: 1 };
        assert!(matches!(
            render(&render_scene(&gallery()), settings, &RenderControl::default()),
            Err(RenderError::Size(_))
        ));
    }
}

#[test]
fn samples_are_averaged_over_the_pixel() {
    let render_scene = render_scene(&gallery());
    let settings = RenderSettings { width: 20, height: 12, samples: 5 };
    let averaged = on_threads(2, &render_scene, settings).picture;
    let cancel = std::sync::atomic::AtomicBool::new(false);
    let mut tracer = catoptric_tracer::WhittedIntegrator::new(&render_scene, &cancel);
    for (x, y) in [(0, 0), (7, 5), (19, 11)] {
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let light: Vec3A =
            (0..5).map(|sample| tracer.trace(corner + sample_offset(sample), DVec2::new(20.0, 12.0))).sum();
        let pixel = Vec3A::from_array(averaged.pixel(x, y).unwrap());
        assert!((pixel - light / 5.0).length() < 1e-6);
    }
    // No samples are taken for one.
    let none = on_threads(1, &render_scene, RenderSettings { samples: 0, ..settings }).picture;
    let one = on_threads(1, &render_scene, RenderSettings { samples: 1, ..settings }).picture;
    assert!(none == one);
}

#[test]
fn every_pixel_by_itself_is_that_of_the_picture() {
    // The last tiles are narrower and lower than others.
    let settings = RenderSettings { width: 45, height: 41, samples: 2 };
    let render_scene = render_scene(&gallery());
    let control = RenderControl::default();
    let whole = render(&render_scene, settings, &control).unwrap().picture;
    for (y, row) in whole.pixels().chunks(45).enumerate() {
        for (x, light) in row.iter().enumerate() {
            let pixel = UVec2::new(x as u32, y as u32);
            let alone =
                render_pixel(&render_scene, render_scene.camera(), settings, pixel, &control).unwrap();
            assert_eq!(alone, Some(*light), "{pixel}");
        }
    }
    for pixel in [UVec2::new(45, 0), UVec2::new(0, 41)] {
        assert_eq!(
            render_pixel(&render_scene, render_scene.camera(), settings, pixel, &control).unwrap(),
            None
        );
    }
    // In the first, the last and a middle group of tiles, in several tiles of them.
    let render_scene = crate::proof::common::render_scene(&crowd());
    let whole = render(&render_scene, LARGE, &control).unwrap().picture;
    for (x, y) in [(0, 0), (70, 3), (1099, 600), (515, 391), (600, 400), (590, 450), (530, 510)] {
        let alone =
            render_pixel(&render_scene, render_scene.camera(), LARGE, UVec2::new(x, y), &control).unwrap();
        assert_eq!(alone, whole.pixel(x, y), "{x} {y}");
    }
}

#[test]
fn undefined_materials_are_errors_that_say_where() {
    let mut scene = scene(vec![ball(1.0, DVec3::ZERO, Material::default()); 2]);
    scene.bodies[1].material = catoptric_scene::MaterialChoice::Named("gold".into());
    let error = RenderScene::build(&scene).unwrap_err();
    let body = "number 2".to_owned();
    assert_eq!(error, SceneBuildError::UndefinedMaterial { body, material: "gold".into() });
    assert!(error.to_string().contains("gold"));
    scene.bodies[1].name = "crown".into();
    assert!(RenderScene::build(&scene).unwrap_err().to_string().contains("\"crown\""));
    let material = Material::Phong(Phong { pattern: Color::WHITE.into(), ..Phong::default() });
    scene.materials = vec![catoptric_scene::NamedMaterial { name: "gold".into(), material }];
    assert_eq!(RenderScene::build(&scene).unwrap().body_count(), 2);
}

#[test]
fn extreme_bodies_are_prepared_without_panics() {
    let mut bodies = Vec::new();
    for size in [1e-12, 1e-6, 1.0, 1e6, 1e9] {
        for far in [0.0, 1.0, 1e9] {
            for shape in
                [Shape::SPHERE, Shape::CUBE, Shape::CYLINDER, Shape::CONE, Shape::PARABOLOID, Shape::Plane]
            {
                let mut placement = catoptric_scene::Placement::at(DVec3::splat(far));
                placement.scale = DVec3::splat(size);
                bodies.push(placed(shape, placement, glass(1.5)));
            }
        }
    }
    let mut scene = scene(bodies);
    scene.tracing.generations = 4;
    let picture =
        on_threads(2, &render_scene(&scene), RenderSettings { width: 32, height: 32, samples: 1 }).picture;
    assert!(picture.pixels().iter().flatten().all(|channel| channel.is_finite()));
    // The same with the very same place many times over, which no split can part.
    let same = crate::proof::common::stage_of(vec![ball(1.0, DVec3::ZERO, Material::default()); 1000]);
    assert_eq!(same.body_count(), 1000);
    assert!(same.closest_hit(&crate::proof::common::ray(v(0.0, 0.0, 9.0), DVec3::NEG_Z)).is_some());
}
