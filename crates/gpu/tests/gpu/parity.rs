//! Every reference scene and every example: the same picture as the CPU's, and the same bodies in it.

use std::sync::Mutex;

use catoptric_gpu::{Gpu, GpuFilm, GpuScene, wait};
use catoptric_picture::{BitDepth, Development, Difference, Picture, write_png};
use catoptric_scene::Scene;
use catoptric_tracer::{NO_BODY, RayCounts, RenderControl, RenderScene, RenderSettings, render};
use glam::DVec2;

use crate::common::{all_scenes, card, cards, stage_of};

/// Width and height of the pictures: each is traced by a software driver on a few cores.
const SIZE: [u32; 2] = [256, 144];
/// The share of pixels in which another body may be seen: those at edges, which rounding gives to either side.
const OTHER_BODIES: f64 = 0.0005;
/// The share of pixels that may be off by more than 1/255.
const OFF: f64 = 0.001;

pub(crate) struct Compared {
    other_bodies: usize,
    difference: Difference,
    pub(crate) cpu: (Picture, RayCounts),
    pub(crate) gpu: (Picture, RayCounts),
}

pub(crate) fn compare(card: &Gpu, render_scene: &RenderScene, samples: u32) -> Compared {
    let [width, height] = SIZE;
    let settings = RenderSettings { width, height, samples };
    let cpu = render(render_scene, settings, &RenderControl::default()).unwrap();
    let mut film = wait(GpuFilm::new(card, width, height)).unwrap();
    let mut on_card = wait(GpuScene::new(card)).unwrap();
    wait(on_card.follow(card, render_scene, render_scene.camera())).unwrap();
    let control = RenderControl::default();
    let pass =
        wait(film.add_samples(card, (render_scene, &on_card), render_scene.camera(), samples, &control))
            .unwrap();
    let picture = wait(film.picture(card)).unwrap();
    let bodies = wait(film.bodies(card)).unwrap();
    let other_bodies = if samples == 1 { count_other_bodies(render_scene, &bodies) } else { 0 };
    let difference = Difference::between(&picture, &cpu.picture).unwrap();
    Compared { other_bodies, difference, cpu: (cpu.picture, cpu.counts), gpu: (picture, pass.counts) }
}

fn count_other_bodies(render_scene: &RenderScene, bodies: &[u32]) -> usize {
    let size = DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1]));
    let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let is_other = |&((x, y), &found): &((u32, u32), &u32)| {
        let ray = render_scene.camera().ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), size);
        render_scene.closest_hit(&ray).map_or(NO_BODY, |met| met.hit.body) != found
    };
    places.zip(bodies).filter(is_other).count()
}

/// What is wrong with a picture, if anything.
pub(crate) fn fault(name: &str, compared: &Compared) -> Option<String> {
    let pixels = f64::from(SIZE[0] * SIZE[1]);
    let others = compared.other_bodies as f64 / pixels;
    let Difference { share_above, not_a_number, max, .. } = compared.difference;
    println!(
        "{name}: {:.3} % other bodies, {:.3} % off, the worst by {max:.3}; {:?}",
        100.0 * others,
        100.0 * share_above,
        compared.gpu.1
    );
    if others <= OTHER_BODIES && share_above <= OFF && not_a_number == 0 {
        return None;
    }
    let evidence = leave_evidence(name, compared);
    Some(format!(
        "{name}: {others:.5} other bodies, {share_above:.5} off, {not_a_number} NaN; see {evidence}"
    ))
}

fn leave_evidence(name: &str, compared: &Compared) -> String {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("gpu");
    std::fs::create_dir_all(&folder).unwrap();
    for (ending, picture) in [("cpu", &compared.cpu.0), ("gpu", &compared.gpu.0)] {
        let developed = Development::default().develop(picture, BitDepth::Eight).unwrap();
        write_png(&folder.join(format!("{name} {ending}.png")), &developed).unwrap();
    }
    folder.display().to_string()
}

/// How far two counts of rays are apart, as a share.
pub(crate) fn apart(one: u64, other: u64) -> f64 {
    one.abs_diff(other) as f64 / one.max(other).max(1) as f64
}

/// One sample does for rough surfaces, soft shadows and split light as well: what looks random is chosen by hashes of
/// whole numbers, and a direction that is off by rounding passes an edge on the other side no more often than a
/// mirrored one.
#[test]
fn pictures_are_those_of_the_cpu() {
    let scenes = Mutex::new(all_scenes().into_iter());
    let faults = Mutex::new(Vec::new());
    let work = |card: &Gpu| {
        // The lock is free while a scene is drawn.
        while let Some((name, scene)) = { scenes.lock().unwrap().next() } {
            let found = faults_of(card, &name, &scene);
            faults.lock().unwrap().extend(found);
        }
    };
    std::thread::scope(|scope| {
        for card in cards("pictures_are_those_of_the_cpu") {
            scope.spawn(|| work(card));
        }
    });
    let faults = faults.into_inner().unwrap();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What is wrong with a scene's picture on a card, and with its numbers of rays.
fn faults_of(card: &Gpu, name: &str, scene: &Scene) -> Vec<String> {
    let compared = compare(card, &stage_of(scene), 1);
    let (cpu, gpu) = (compared.cpu.1, compared.gpu.1);
    assert_eq!(cpu.primary, gpu.primary);
    let rays = [(cpu.shadow, gpu.shadow), (cpu.reflected, gpu.reflected), (cpu.refracted, gpu.refracted)];
    let mut faults: Vec<String> = fault(name, &compared).into_iter().collect();
    if rays.iter().any(|&(one, other)| apart(one, other) > 0.002) {
        faults.push(format!("{name}: rays {cpu:?} on the CPU, {gpu:?} on the GPU"));
    }
    faults
}

/// The mean of many samples is gathered in single precision on a card.
#[test]
fn many_samples_have_the_mean_of_the_cpu() {
    let Some(card) = card("many_samples_have_the_mean_of_the_cpu") else { return };
    let compared = compare(&card, &stage_of(&crate::common::reference("phong-sphere")), 20);
    assert!(compared.difference.share_above <= 0.0001, "{:?}", compared.difference);
    assert_eq!(compared.gpu.1.primary, 20 * u64::from(SIZE[0] * SIZE[1]));
    assert_eq!(fault("twenty samples", &compared), None);
}

/// The test itself can fail: a picture of something else is told apart.
#[test]
fn another_picture_is_noticed() {
    let Some(card) = card("another_picture_is_noticed") else { return };
    let scene = crate::common::reference("whitted");
    let mut compared = compare(&card, &stage_of(&scene), 1);
    assert_eq!(fault("whitted", &compared), None);
    for pixel in compared.gpu.0.pixels_mut().iter_mut().take(50) {
        pixel[1] += 0.1;
    }
    compared.difference = Difference::between(&compared.gpu.0, &compared.cpu.0).unwrap();
    assert!(fault("a wrong picture", &compared).is_some());
}
