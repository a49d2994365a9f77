//! Pictures refined sample by sample, cameras over a prepared scene, scenes of some bodies.

use catoptric_scene::{Camera, Projection, Scene};
use catoptric_tracer::{
    Film, Ray, RayCounts, RenderCamera, RenderControl, RenderError, RenderScene, RenderSettings, render,
    render_through,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use rayon::ThreadPoolBuilder;

use crate::proof::common::{
    ball, camera, cases, chalk, endless, glass, plane, render_scene, scene, stage_of, v,
};
use crate::proof::samples::{LARGE, crowd, gallery};

const WIDTH: u32 = 53;
const HEIGHT: u32 = 37;

fn settings(samples: u32) -> RenderSettings {
    RenderSettings { width: WIDTH, height: HEIGHT, samples }
}

#[test]
fn after_n_samples_the_film_equals_a_render_of_n_samples() {
    let render_scene = render_scene(&gallery());
    for threads in [1, 3] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut film = Film::new(WIDTH, HEIGHT).unwrap();
            let mut counts = RayCounts::default();
            for samples in 1..=5 {
                let control = RenderControl::default();
                counts += film.add_sample(&render_scene, render_scene.camera(), &control).unwrap();
                assert_eq!(control.pixels_done(), u64::from(WIDTH * HEIGHT));
                let whole = render(&render_scene, settings(samples), &RenderControl::default()).unwrap();
                assert_eq!(film.samples(), samples);
                assert!(film.picture().unwrap() == whole.picture, "{samples} samples, {threads} threads");
                assert_eq!(counts, whole.counts);
            }
        });
    }
}

#[test]
fn a_film_traced_in_slices_is_the_same_with_the_same_rays() {
    let render_scene = render_scene(&gallery());
    let pool = ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        let mut film = Film::new(LARGE.width, LARGE.height).unwrap();
        let (mut counts, mut slices) = (RayCounts::default(), 0);
        while film.samples() < 2 {
            slices += 1;
            // Each slice ends as soon as it can.
            let control = RenderControl::pausing_when(|| true);
            match film.add_sample(&render_scene, render_scene.camera(), &control) {
                Ok(rays) => counts += rays,
                Err(error) => assert!(matches!(error, RenderError::Cancelled)),
            }
            assert!(control.pixels_done() > 0 && !control.is_cancelled());
        }
        assert!(slices > 4, "{slices}");
        let settings = RenderSettings { samples: 2, ..LARGE };
        let whole = render(&render_scene, settings, &RenderControl::default()).unwrap();
        assert!(film.picture().unwrap() == whole.picture);
        assert_eq!(counts, whole.counts);
    });
}

#[test]
fn a_cancelled_pass_spoils_nothing() {
    let render_scene = render_scene(&gallery());
    let mut film = Film::new(WIDTH, HEIGHT).unwrap();
    film.add_sample(&render_scene, render_scene.camera(), &RenderControl::default()).unwrap();
    let before = film.picture().unwrap();
    let control = RenderControl::default();
    control.cancel();
    assert!(matches!(
        film.add_sample(&render_scene, render_scene.camera(), &control),
        Err(RenderError::Cancelled)
    ));
    assert!(film.samples() == 1 && film.picture().unwrap() == before);
    // Cancelled midway: some tiles are a sample ahead, and the next pass brings the others there.
    for _ in 0..20 {
        let control = RenderControl::default();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while control.pixels_done() == 0 {
                    std::hint::spin_loop();
                }
                control.cancel();
            });
            let _ = film.add_sample(&render_scene, render_scene.camera(), &control);
            control.cancel();
        });
        film.picture().unwrap();
    }
    film.add_sample(&render_scene, render_scene.camera(), &RenderControl::default()).unwrap();
    let whole = render(&render_scene, settings(film.samples()), &RenderControl::default()).unwrap();
    assert!(film.picture().unwrap() == whole.picture);
}

#[test]
fn a_pass_is_cancelled_within_a_pixel() {
    let render_scene = endless();
    let mut film = Film::new(64, 64).unwrap();
    let control = RenderControl::default();
    std::thread::scope(|scope| {
        let running = scope.spawn(|| film.add_sample(&render_scene, render_scene.camera(), &control));
        std::thread::sleep(std::time::Duration::from_millis(50));
        control.cancel();
        assert!(matches!(running.join().unwrap(), Err(RenderError::Cancelled)));
    });
    assert_eq!(film.samples(), 0);
}

#[test]
fn a_cleared_film_is_as_new() {
    let render_scene = render_scene(&gallery());
    let other = render_scene.camera_for(&camera(v(3.0, 4.0, 5.0), DVec3::ZERO, 50.0));
    let mut film = Film::new(WIDTH, HEIGHT).unwrap();
    film.add_sample(&render_scene, &other, &RenderControl::default()).unwrap();
    film.clear();
    assert!(film.picture().unwrap().pixels().iter().flatten().all(|&channel| channel == 0.0));
    let counts = film.add_sample(&render_scene, render_scene.camera(), &RenderControl::default()).unwrap();
    let whole = render(&render_scene, settings(1), &RenderControl::default()).unwrap();
    assert!(film.picture().unwrap() == whole.picture && counts == whole.counts);
}

/// Of many bodies threads take larger parts of a large picture.
#[test]
fn a_film_shows_few_bodies_and_many_by_turns() {
    let mut film = Film::new(LARGE.width, LARGE.height).unwrap();
    for scene in [gallery(), crowd(), gallery()] {
        let render_scene = render_scene(&scene);
        film.clear();
        let counts =
            film.add_sample(&render_scene, render_scene.camera(), &RenderControl::default()).unwrap();
        let whole = render(&render_scene, LARGE, &RenderControl::default()).unwrap();
        assert!(film.picture().unwrap() == whole.picture && counts == whole.counts);
    }
}

#[test]
fn films_of_impossible_sizes_are_errors() {
    for (width, height) in [(0, 5), (5, 0), (u32::MAX, u32::MAX), (100_000, 100_000)] {
        assert!(Film::new(width, height).is_err());
    }
}

#[test]
fn another_camera_gives_what_a_scene_with_that_camera_gives() {
    for projection in [Projection::Perspective { fov_degrees: 40.0 }, Projection::Parallel { height: 7.0 }] {
        let mut scene = gallery();
        let prepared = render_scene(&scene);
        scene.camera = Camera { position: v(-4.0, 3.0, 6.0), projection, ..Camera::default() };
        let through = prepared.camera_for(&scene.camera);
        let again = render_scene(&scene);
        assert_eq!(&through, again.camera());
        let one = render_through(&prepared, &through, settings(2), &RenderControl::default()).unwrap();
        let other = render(&again, settings(2), &RenderControl::default()).unwrap();
        assert!(one.picture == other.picture && one.counts == other.counts);
    }
}

/// A camera in empty space, where rays start at the eye itself.
fn free_camera(camera: Camera) -> RenderCamera {
    render_scene(&Scene { camera, ..scene(Vec::new()) }).camera().clone()
}

#[test]
fn the_target_lies_in_the_middle_and_points_behind_the_eye_nowhere() {
    let size = DVec2::new(640.0, 480.0);
    for projection in [Projection::Perspective { fov_degrees: 90.0 }, Projection::Parallel { height: 2.0 }] {
        let camera =
            free_camera(Camera { position: v(0.0, 0.0, 5.0), target: DVec3::ZERO, up: DVec3::Y, projection });
        assert_eq!(camera.axes(), [DVec3::X, DVec3::Y, DVec3::NEG_Z]);
        assert_eq!(camera.project(DVec3::ZERO, size), Some((0.5 * size, 5.0)));
        assert_eq!(camera.project(v(0.0, 0.0, 5.5), size), None);
        assert_eq!(camera.project(v(0.0, 0.0, 5.0), size), None);
        assert_eq!(camera.project(DVec3::NAN, size), None);
        // At depth 1 the window of a right angle is 2 high, like the parallel one.
        let (at, depth) = camera.project(v(1.0, 0.5, 4.0), size).unwrap();
        assert!((at - DVec2::new(560.0, 120.0)).length() < 1e-9 && (depth - 1.0).abs() < 1e-12);
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn projecting_inverts_rays(
        position in prop::array::uniform3(-5.0..5.0_f64),
        target in prop::array::uniform3(-5.0..5.0_f64),
        pixel in prop::array::uniform2(-0.2..1.2_f64),
        distance in 0.5..100.0_f64,
        parallel: bool,
        angle in 5.0..120.0_f64,
    ) {
        let (position, target) = (DVec3::from_array(position), DVec3::from_array(target));
        prop_assume!((position - target).cross(DVec3::Y).length() > 0.1);
        let projection =
            if parallel { Projection::Parallel { height: angle } } else { Projection::Perspective { fov_degrees: angle } };
        let camera = free_camera(Camera { position, target, up: DVec3::Y, projection });
        let size = DVec2::new(1280.0, 720.0);
        let at = DVec2::from_array(pixel) * size;
        let ray = camera.ray(at, size);
        let point = ray.origin.as_dvec3() + distance * ray.direction.as_dvec3();
        let (back, depth) = camera.project(point, size).unwrap();
        prop_assert!((back - at).length() < 0.01, "{at} came back as {back}");
        let forward = camera.axes()[2];
        prop_assert!((depth - (point - position).dot(forward)).abs() < 1e-9);
    }
}

#[test]
fn a_click_can_go_to_the_bodies_behind_in_order() {
    let render_scene = stage_of(vec![
        ball(1.0, v(0.0, 0.0, -20.0), chalk()),
        plane(v(0.0, -5.0, 0.0), 0.0, chalk()),
        ball(1.0, v(0.0, 0.0, 0.0), glass(1.5)),
        ball(1.0, v(5.0, 0.0, 0.0), chalk()),
        ball(0.5, v(0.0, 0.0, 0.0), chalk()),
    ]);
    let along = |from: DVec3, direction: DVec3| -> Vec<usize> {
        let ray = crate::proof::common::ray(from, direction);
        let hits = render_scene.hits_along(&ray);
        assert_eq!(hits.first().copied(), render_scene.closest_hit(&ray));
        assert!(hits.windows(2).all(|pair| pair[0].hit.t <= pair[1].hit.t));
        hits.iter().map(|hit| hit.body).collect()
    };
    assert_eq!(along(v(0.0, 0.0, 9.0), DVec3::NEG_Z), [2, 4, 0]);
    assert_eq!(along(v(0.0, 9.0, 0.0), DVec3::NEG_Y), [2, 4, 1]);
    assert_eq!(along(v(0.0, 0.0, -18.0), DVec3::Z), [2, 4]);
    // From within the glass it is met from within, after what it holds.
    assert_eq!(along(v(0.0, 0.0, 0.75), DVec3::NEG_Z), [4, 2, 0]);
    assert_eq!(along(v(0.0, 9.0, 0.0), DVec3::Y), [0; 0]);
    assert!(render_scene.hits_along(&Ray::from_point(glam::Vec3::NAN, glam::Vec3::X)).is_empty());
}

#[test]
fn hits_along_a_ray_through_a_hierarchy_are_all_there() {
    let row: Vec<_> = (0..80).map(|k| ball(0.4, v(0.0, 0.0, -f64::from(k)), chalk())).collect();
    let hits = stage_of(row).hits_along(&crate::proof::common::ray(v(0.0, 0.0, 9.0), DVec3::NEG_Z));
    assert!(hits.iter().map(|hit| hit.body).eq(0..80));
    // Bodies that touch keep to the order of the search.
    let render_scene = stage_of((0..60).map(|k| ball(0.5, v(0.0, 0.0, -f64::from(k)), glass(1.2))).collect());
    let ray = crate::proof::common::ray(v(0.1, 0.0, 9.0), DVec3::NEG_Z);
    assert_eq!(render_scene.hits_along(&ray).first().copied(), render_scene.closest_hit(&ray));
}

#[test]
fn a_stage_of_some_bodies_meets_them_alone_at_the_same_points() {
    let crowd: Vec<_> = (0..60)
        .map(|k| ball(0.7, v(f64::from(k % 8), f64::from(k / 8), 0.3 * f64::from(k % 3)), glass(1.3)))
        .collect();
    let mut all = scene(crowd);
    all.bodies.push(plane(v(0.0, -1.0, 0.0), 0.0, chalk()));
    let render_scene = render_scene(&all);
    for chosen in [vec![], vec![7], vec![60], vec![3, 60, 3, 11, 999], (0..61).rev().step_by(2).collect()] {
        let some = render_scene.only(&all, &chosen);
        let known: std::collections::BTreeSet<usize> = chosen.iter().copied().filter(|&k| k <= 60).collect();
        assert_eq!(some.body_count(), known.len());
        let mut met = 0;
        for k in 0..400 {
            let at = DVec2::new(f64::from(k % 20), f64::from(k / 20)) + 0.5;
            let camera = render_scene.camera_for(&camera(v(3.0, 3.0, 20.0), v(3.0, 3.0, 0.0), 30.0));
            let ray = camera.ray(at, DVec2::splat(20.0));
            let expected: Vec<_> =
                render_scene.hits_along(&ray).into_iter().filter(|hit| known.contains(&hit.body)).collect();
            let found = some.hits_along(&ray);
            assert_eq!(found.len(), expected.len());
            for (one, other) in found.iter().zip(&expected) {
                assert_eq!((one.body, one.hit.t, one.position), (other.body, other.hit.t, other.position));
            }
            met += found.len();
        }
        assert_eq!(met == 0, known.is_empty());
    }
}

#[test]
fn a_stage_of_some_bodies_looks_as_their_scene_does() {
    let whole = gallery();
    let chosen: Vec<usize> = (0..whole.bodies.len()).step_by(2).collect();
    let mut part = whole.clone();
    part.bodies = chosen.iter().map(|&index| whole.bodies[index].clone()).collect();
    let one =
        render(&render_scene(&whole).only(&whole, &chosen), settings(1), &RenderControl::default()).unwrap();
    let part = RenderScene::build(&part).unwrap();
    let camera = render_scene(&whole).camera().clone();
    let other = render_through(&part, &camera, settings(1), &RenderControl::default()).unwrap();
    assert!(one.picture == other.picture);
}
