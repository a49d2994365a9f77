//! The reasons of errors, in scenes made for one of them each.

use catoptric_picture::Picture;
use catoptric_scene::{Material, Phong, Scene, Shape};
use catoptric_tracer::raster::{
    CubeMapSettings, LightModel, Method, MethodError, Reason, ReasonMap, ShadingSettings, SsrSettings,
    reasons,
};
use catoptric_tracer::{RenderControl, RenderScene};
use glam::DVec3;

use crate::methods::common::*;

const WIDTH: u32 = 240;
const HEIGHT: u32 = 150;
const BOUND: f64 = 2.0 / 255.0;

struct Explained {
    render_scene: RenderScene,
    truth: Picture,
    map: ReasonMap,
}

fn explained(scene: &Scene, method: Method) -> Explained {
    let (render_scene, settings) = (render_scene(scene), size(WIDTH, HEIGHT));
    let truth = traced(&render_scene, settings);
    let drawing = drawn(&render_scene, method, settings);
    let map = reasons(&render_scene, &method, settings, &truth, &drawing, BOUND, &RenderControl::default())
        .unwrap();
    // Every pixel that differs has a reason, and no other.
    let pairs = truth.pixels().iter().zip(drawing.picture.pixels());
    for ((a, b), reason) in pairs.zip(map.reasons()) {
        assert_eq!(differs(a, b, BOUND as f32), reason.is_some());
    }
    Explained { render_scene, truth, map }
}

impl Explained {
    /// The share of `reason` among the pixels that differ and are `wanted` by their traced light.
    fn share(&self, reason: Reason, wanted: impl Fn([f32; 3]) -> bool) -> f64 {
        let pixels = self.truth.pixels().iter().zip(self.map.reasons());
        let found: Vec<Reason> =
            pixels.filter(|(light, _)| wanted(**light)).filter_map(|(_, reason)| *reason).collect();
        assert!(found.len() > 100, "{} pixels", found.len());
        found.iter().filter(|other| **other == reason).count() as f64 / found.len() as f64
    }

    /// Asserts that at least this share of all pixels that differ have the reason.
    #[track_caller]
    fn assert_mostly(&self, reason: Reason, share: f64) {
        let found = self.share(reason, |_| true);
        assert!(found >= share, "{found:.3} are {}: {:?}", reason.name(), self.map.counts());
    }
}

const RED: fn([f32; 3]) -> bool = |light| light == [1.0, 0.0, 0.0];

/// A red ball behind a screen, seen in a mirror at the side only.
fn hidden_ball(thickness_of_screen: f64) -> Scene {
    let bodies = vec![
        block(v(0.2, 8.0, 40.0), v(-3.1, 2.0, -5.0), mirror()),
        ball(0.5, v(2.0, 1.0, 0.0), glow(1.0, 0.0, 0.0)),
        block(v(2.0, 2.5, thickness_of_screen), v(1.0, 1.25, 4.0), glow(0.1, 0.6, 0.2)),
    ];
    scene(bodies, camera(v(0.0, 1.0, 8.0), v(-1.5, 1.0, 0.0), 60.0), vec![])
}

#[test]
fn what_is_hidden_from_the_eye_is_missing_on_the_screen_and_called_hidden() {
    let scene = hidden_ball(0.2);
    let explained = explained(&scene, Method::Ssr(SsrSettings::default()));
    let seen = bodies_seen(&explained.render_scene, size(WIDTH, HEIGHT));
    assert!(!seen.contains(&Some(1)), "the ball is not hidden");
    // All of the ball is missing: each of its pixels differs.
    let pixels = explained.truth.pixels().iter().zip(explained.map.reasons());
    let of_ball: Vec<_> = pixels.filter(|(light, _)| RED(**light)).collect();
    assert!(of_ball.len() > 100 && of_ball.iter().all(|(_, reason)| reason.is_some()));
    assert!(explained.share(Reason::Hidden, RED) >= 0.95, "{:?}", explained.map.counts());
}

#[test]
fn a_thickness_beyond_all_gaps_is_called_thickness() {
    let settings = SsrSettings { thickness: 100.0, ..SsrSettings::default() };
    let explained = explained(&hidden_ball(0.2), Method::Ssr(settings));
    assert!(explained.share(Reason::Thickness, RED) >= 0.95, "{:?}", explained.map.counts());
}

#[test]
fn what_is_beside_the_picture_has_left_the_screen() {
    let mut scene = hidden_ball(0.2);
    // Without the screen, and with the ball behind the eye.
    scene.bodies.remove(2);
    scene.bodies[1].placement = scene.bodies[1].placement.moved_by(v(0.0, 0.0, 9.0));
    scene.camera = camera(v(0.0, 1.0, 8.0), v(-3.0, 1.0, 8.0), 60.0);
    explained(&scene, Method::Ssr(SsrSettings::default())).assert_mostly(Reason::LeftScreen, 0.99);
}

#[test]
fn a_short_range_is_out_of_range() {
    let mut scene = hidden_ball(0.2);
    scene.bodies.remove(2);
    let settings = SsrSettings { range: 3.0, ..SsrSettings::default() };
    let explained = explained(&scene, Method::Ssr(settings));
    assert!(explained.share(Reason::OutOfRange, RED) >= 0.99, "{:?}", explained.map.counts());
}

#[test]
fn long_steps_step_over_thin_bodies() {
    let bodies = vec![
        body(Shape::Plane, DVec3::ZERO, mirror()),
        block(v(40.0, 0.03, 0.03), v(0.0, 1.0, -3.0), glow(1.0, 0.0, 0.0)),
    ];
    let scene = scene(bodies, camera(v(0.0, 1.5, 6.0), v(0.0, 0.5, -3.0), 40.0), vec![]);
    let settings = SsrSettings { step_pixels: 40.0, thickness: 0.01, ..SsrSettings::default() };
    let explained = explained(&scene, Method::Ssr(settings));
    assert!(explained.share(Reason::Step, RED) >= 0.5, "{:?}", explained.map.counts());
}

#[test]
fn mirrors_in_mirrors_lack_the_second_reflection() {
    let bodies = vec![
        body(Shape::Plane, DVec3::ZERO, Phong { reflection: Some(0.9), ..mirror() }),
        block(v(40.0, 20.0, 0.2), v(0.0, 10.0, -6.0), mirror()),
    ];
    let scene = scene(bodies, camera(v(0.0, 1.5, 6.0), v(0.0, 1.5, -6.0), 30.0), vec![]);
    // The floor sees the wall and nothing in it.
    let explained = explained(&scene, Method::Ssr(SsrSettings::default()));
    let seen = bodies_seen(&explained.render_scene, size(WIDTH, HEIGHT));
    let of_floor = explained.map.reasons().iter().zip(seen).filter(|(_, seen)| *seen == Some(0));
    let found: Vec<Reason> = of_floor.filter_map(|(reason, _)| *reason).collect();
    let second = found.iter().filter(|reason| **reason == Reason::SecondReflectionMissing).count();
    assert!(found.len() > 1000 && second * 100 >= found.len() * 95, "{second} of {}", found.len());
}

#[test]
fn glass_lacks_what_is_behind_it() {
    let glass = Material::Phong(Phong {
        transmission: 1.0,
        ior: 1.1,
        reflection: Some(0.0),
        ambient: 0.0,
        diffuse: 0.0,
        ..Phong::default()
    });
    let bodies =
        vec![ball(1.0, DVec3::ZERO, glass), block(v(9.0, 9.0, 0.1), v(0.0, 0.0, -3.0), glow(1.0, 0.0, 0.0))];
    let scene = scene(bodies, camera(v(0.0, 0.0, 6.0), DVec3::ZERO, 30.0), vec![]);
    let maps = Method::CubeMap(CubeMapSettings::default());
    for method in [maps, Method::Ssr(SsrSettings::default()), Method::Phong(ShadingSettings::default())] {
        let explained = explained(&scene, method);
        assert!(explained.share(Reason::RefractionMissing, RED) >= 0.9, "{:?}", explained.map.counts());
    }
}

#[test]
fn near_surroundings_are_parallax_and_the_body_itself_is_missing() {
    let wall = turned(Shape::Plane, v(0.0, 0.0, -2.0), v(90.0, 0.0, 0.0), chalk(0.9, 0.4, 0.2));
    let near = vec![
        ball(1.0, DVec3::ZERO, mirror()),
        block(v(2.0, 2.0, 2.0), v(2.4, 0.0, 0.5), glow(0.9, 0.2, 0.1)),
        block(v(2.0, 2.0, 2.0), v(-2.4, 0.0, 0.5), glow(0.1, 0.2, 0.9)),
    ];
    let eye = camera(v(0.0, 0.5, 8.0), DVec3::ZERO, 22.0);
    let settings = CubeMapSettings { size: 1024, parallax: false };
    explained(&scene(near, eye, vec![]), Method::CubeMap(settings)).assert_mostly(Reason::Parallax, 0.95);
    // A box that reflects the wall, on which its shadow falls; a map with parallax is exact for the wall.
    let slab = block(v(1.0, 1.0, 0.1), DVec3::ZERO, mirror());
    let mut eye = camera(v(0.0, 1.0, -1.9), v(0.0, 0.0, 0.0), 60.0);
    eye.up = DVec3::Y;
    let scene = scene(vec![slab, wall], eye, vec![light(v(0.0, 0.0, 8.0), 1.0)]);
    let settings = CubeMapSettings { size: 1024, parallax: true };
    explained(&scene, Method::CubeMap(settings)).assert_mostly(Reason::SelfMissing, 0.9);
}

#[test]
fn a_coarse_map_is_sampling() {
    let far = 1e5;
    let bodies = vec![
        ball(1.0, DVec3::ZERO, mirror()),
        ball(0.5 * far, v(far, 0.2 * far, 0.5 * far), glow(0.9, 0.2, 0.1)),
        ball(0.5 * far, v(-far, 0.2 * far, 0.5 * far), glow(0.1, 0.2, 0.9)),
    ];
    let scene = scene(bodies, camera(v(0.0, 0.5, 8.0), DVec3::ZERO, 22.0), vec![]);
    let settings = CubeMapSettings { size: 8, parallax: false };
    explained(&scene, Method::CubeMap(settings)).assert_mostly(Reason::Sampling, 0.95);
}

/// A ball that shades a floor, nothing reflecting.
fn shading_scene() -> Scene {
    let bodies =
        vec![ball(1.0, v(0.0, 1.0, 0.0), glossy()), body(Shape::Plane, DVec3::ZERO, chalk(0.8, 0.8, 0.8))];
    scene(bodies, camera(v(0.0, 2.0, 7.0), v(0.0, 0.8, 0.0), 35.0), vec![light(v(-4.0, 6.0, 4.0), 0.9)])
}

#[test]
fn shading_differs_by_faces_interpolation_shadows_and_highlights() {
    let shading = ShadingSettings { shadows: true, ..ShadingSettings::default() };
    let of = |method| explained(&shading_scene(), method);
    of(Method::Phong(shading)).assert_mostly(Reason::Facet, 0.99);
    let fine = ShadingSettings { fineness: 64, shadows: false, ..shading };
    of(Method::Phong(fine)).assert_mostly(Reason::ShadowMissing, 0.95);
    let lambert = ShadingSettings { fineness: 64, model: LightModel::Lambert, ..shading };
    of(Method::Phong(lambert)).assert_mostly(Reason::Highlight, 0.9);
    let coarse = ShadingSettings { fineness: 3, ..shading };
    of(Method::Gouraud(coarse)).assert_mostly(Reason::Shading, 0.8);
    of(Method::Flat(coarse)).assert_mostly(Reason::Facet, 0.99);
    let mut mirrored = shading_scene();
    mirrored.bodies.remove(0);
    mirrored.bodies.push(ball(1.0, v(0.0, 1.0, 0.0), mirror()));
    explained(&mirrored, Method::Phong(shading)).assert_mostly(Reason::ReflectionMissing, 0.95);
}

#[test]
fn pictures_of_other_sizes_are_refused_and_equal_ones_have_no_reasons() {
    let render_scene = render_scene(&shading_scene());
    let drawing = drawn(&render_scene, Method::Whitted, size(20, 10));
    let of = |truth: &Picture| {
        reasons(
            &render_scene,
            &Method::Whitted,
            size(20, 10),
            truth,
            &drawing,
            0.0,
            &RenderControl::default(),
        )
    };
    assert!(of(&drawing.picture).unwrap().counts().is_empty());
    let other = traced(&render_scene, size(10, 20));
    assert!(matches!(of(&other), Err(MethodError::SizeMismatch { of_picture: [10, 20], .. })));
}
