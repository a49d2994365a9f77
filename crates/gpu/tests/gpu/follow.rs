//! A scene on the card follows edits, and sends only what they change.

use std::sync::Arc;

use catoptric_gpu::{Gpu, GpuFilm, GpuScene, render, wait};
use catoptric_scene::{Body, Light, Material, MaterialChoice, Model, Phong, Projection, Scene, Shape};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use glam::DVec3;

use crate::common::{card, stage_of};

/// A lattice of balls and cubes, some of glass.
fn lattice(count: usize) -> Scene {
    let side = (count as f64).cbrt().ceil() as usize;
    let glass = Material::Phong(Phong { transmission: 0.9, ior: 1.3, ..Phong::default() });
    let body = |index: usize| {
        let [x, y, z] = [index % side, index / side % side, index / side / side].map(|at| at as f64 - 2.0);
        let mut body = Body::default();
        if index.is_multiple_of(3) {
            body.shape = Shape::Cube { size: DVec3::splat(0.7) };
        } else {
            body.shape = Shape::Sphere { radius: 0.4 };
        }
        if index.is_multiple_of(5) {
            body.material = MaterialChoice::Inline(Box::new(glass.clone()));
        }
        body.placement = body.placement.moved_by(DVec3::new(x, y, z));
        body
    };
    let mut scene = Scene {
        bodies: (0..count).map(body).collect(),
        lights: vec![Light { position: DVec3::new(4.0, 9.0, 9.0), ..Light::default() }],
        ..Scene::default()
    };
    scene.camera.position = DVec3::new(3.0, 4.0, 12.0);
    scene
}

struct Follower {
    gpu: Arc<Gpu>,
    scene: Scene,
    render_scene: RenderScene,
    on_card: GpuScene,
}

impl Follower {
    fn new(gpu: Arc<Gpu>, scene: Scene) -> (Self, u64) {
        let render_scene = stage_of(&scene);
        let mut on_card = wait(GpuScene::new(&gpu)).unwrap();
        let sent = wait(on_card.follow(&gpu, &render_scene, render_scene.camera())).unwrap();
        (Self { gpu, scene, render_scene, on_card }, sent)
    }

    /// Edits a body and returns the bytes that were sent.
    fn edit(&mut self, index: usize, edit: impl FnOnce(&mut Body)) -> u64 {
        let mut after = self.scene.clone();
        edit(&mut after.bodies[index]);
        let planned = self.render_scene.edit(&self.scene, &after, &[index]).unwrap();
        self.render_scene.apply(planned, &after);
        self.scene = after;
        wait(self.on_card.follow(&self.gpu, &self.render_scene, self.render_scene.camera())).unwrap()
    }

    /// Whether the picture is that of a scene sent anew.
    fn check(&self) {
        let settings = RenderSettings { width: 96, height: 64, samples: 1 };
        let mut film = wait(GpuFilm::new(&self.gpu, settings.width, settings.height)).unwrap();
        let control = RenderControl::default();
        wait(film.add_samples(
            &self.gpu,
            (&self.render_scene, &self.on_card),
            self.render_scene.camera(),
            1,
            &control,
        ))
        .unwrap();
        let anew =
            wait(render(&self.gpu, &self.render_scene, self.render_scene.camera(), settings, &control))
                .unwrap();
        assert_eq!(wait(film.picture(&self.gpu)).unwrap(), anew.picture);
    }
}

#[test]
fn an_edit_sends_only_what_it_changed() {
    let Some(gpu) = card("an_edit_sends_only_what_it_changed") else { return };
    let (mut follower, all) = Follower::new(gpu, lattice(1000));
    assert!(all > 1000 * 100, "{all}");
    let again =
        wait(follower.on_card.follow(&follower.gpu, &follower.render_scene, follower.render_scene.camera()))
            .unwrap();
    assert_eq!(again, 0);
    // The body, its leaf of up to four, the nodes on the way to it.
    let moved = follower.edit(17, |body| body.placement = body.placement.moved_by(DVec3::splat(0.05)));
    assert!((104..=5 * 104 + 5 * 8 + 6 * 256).contains(&moved), "{moved}");
    follower.check();
    let reshaped = follower.edit(500, |body| body.shape = Shape::Cylinder { radius: 0.3, height: 0.6 });
    assert!(reshaped < 4096, "{reshaped}");
    follower.check();
    let recolored = follower.edit(501, |body| {
        let material = Material::Phong(Phong { reflection: Some(0.7), ..Phong::default() });
        body.material = MaterialChoice::Inline(Box::new(material));
    });
    assert!((104..4096).contains(&recolored), "{recolored}");
    follower.check();
}

#[test]
fn a_material_that_becomes_physical_changes_the_form_of_all() {
    let Some(gpu) = card("a_material_that_becomes_physical_changes_the_form_of_all") else { return };
    let (mut follower, _) = Follower::new(gpu, lattice(100));
    for model in [Model::Coated, Model::Conductor, Model::Dielectric] {
        let sent = follower.edit(7, |body| {
            let mut material = Material::from(model);
            *material.roughness_mut().unwrap() = 0.4;
            body.material = MaterialChoice::Inline(Box::new(material));
        });
        assert!(sent > 0);
        follower.check();
    }
}

#[test]
fn a_light_that_moves_sends_a_light() {
    let Some(gpu) = card("a_light_that_moves_sends_a_light") else { return };
    let (mut follower, _) = Follower::new(gpu, lattice(100));
    let mut after = follower.scene.clone();
    after.lights[0].position.x += 1.0;
    let planned = follower.render_scene.edit(&follower.scene, &after, &[]).unwrap();
    follower.render_scene.apply(planned, &after);
    let sent =
        wait(follower.on_card.follow(&follower.gpu, &follower.render_scene, follower.render_scene.camera()))
            .unwrap();
    assert_eq!(sent, 32);
    follower.check();
}

#[test]
fn bodies_around_parallel_rays_are_put_in_order() {
    let Some(gpu) = card("bodies_around_parallel_rays_are_put_in_order") else { return };
    for count in [8, 60] {
        let mut scene = lattice(count);
        scene.camera.projection = Projection::Parallel { height: 3.0 };
        // The rays start in the middle of the bodies, some in two at once.
        scene.camera.position = DVec3::new(-2.1, -1.9, -1.9);
        scene.camera.target = DVec3::new(-1.0, -1.0, -3.0);
        let mut big = scene.bodies[0].clone();
        big.shape = Shape::Sphere { radius: 1.1 };
        scene.bodies.push(big);
        let render_scene = stage_of(&scene);
        let settings = RenderSettings { width: 96, height: 64, samples: 2 };
        let on_gpu =
            wait(render(&gpu, &render_scene, render_scene.camera(), settings, &RenderControl::default()))
                .unwrap();
        let on_cpu = catoptric_tracer::render(&render_scene, settings, &RenderControl::default()).unwrap();
        let difference = catoptric_picture::Difference::between(&on_gpu.picture, &on_cpu.picture).unwrap();
        assert!(difference.share_above < 0.001, "{count}: {difference:?}");
        assert!(on_cpu.counts.refracted > 1000, "{:?}", on_cpu.counts);
    }
}
