//! `ssr` and `cube-map` against the traced picture.

use catoptric_picture::Picture;
use catoptric_scene::{Color, Example, Phong, Projection, Scene, Shape, SolidTexture};
use catoptric_tracer::raster::{
    CubeMap, CubeMapSettings, CubeMaps, GBufferLayer, Method, PassName, SsrFallback, SsrSettings,
    draw_through,
};
use catoptric_tracer::{RenderControl, RenderScene};
use glam::{DVec3, Vec3};

use crate::methods::common::*;

fn ssr() -> SsrSettings {
    SsrSettings::default()
}

fn cube_map(size: u32, parallax: bool) -> Method {
    Method::CubeMap(CubeMapSettings { size, parallax })
}

/// A mirror for a floor, and a wall and boxes of which only what the eye sees is reflected: the view is level, so that a
/// reflected ray stays in the column of its pixel.
fn mirror_floor(projection: Projection) -> Scene {
    let bodies = vec![
        body(Shape::Plane, DVec3::ZERO, mirror()),
        block(v(40.0, 20.0, 0.2), v(0.0, 10.0, -6.0), chalk(0.9, 0.7, 0.4)),
        block(v(1.0, 1.5, 1.0), v(-1.5, 0.75, -2.0), chalk(0.3, 0.5, 0.9)),
        block(v(0.8, 0.8, 0.8), v(1.2, 0.4, 0.0), chalk(0.5, 0.9, 0.3)),
    ];
    let mut camera = camera(v(0.0, 1.5, 6.0), v(0.0, 1.5, -6.0), 45.0);
    if matches!(projection, Projection::Parallel { .. }) {
        // Seen along the floor, the floor would be a line.
        camera.position = v(0.0, 4.5, 6.0);
    }
    camera.projection = projection;
    scene(bodies, camera, vec![light(v(1.0, 6.0, 8.0), 0.9)])
}

/// The share of the pixels that show the scene's first body and differ by more than `bound`.
fn share_off(render_scene: &RenderScene, drawn: &Picture, truth: &Picture, bound: f32) -> f64 {
    let seen = bodies_seen(render_scene, size(truth.width(), truth.height()));
    let pixels = drawn.pixels().iter().zip(truth.pixels()).zip(seen);
    let of_first: Vec<bool> =
        pixels.filter(|(_, seen)| *seen == Some(0)).map(|((a, b), _)| differs(a, b, bound)).collect();
    assert!(of_first.len() > 500, "{} pixels", of_first.len());
    of_first.iter().filter(|off| **off).count() as f64 / of_first.len() as f64
}

#[test]
fn a_plane_mirror_of_what_is_on_the_screen_is_the_traced_one() {
    let perspective = Projection::Perspective { fov_degrees: 45.0 };
    for projection in [perspective, Projection::Parallel { height: 4.0 }] {
        let render_scene = render_scene(&mirror_floor(projection));
        let truth = traced(&render_scene, size(480, 300));
        let drawing = drawn(&render_scene, Method::Ssr(ssr()), size(480, 300));
        let off = share_off(&render_scene, &drawing.picture, &truth, 2.0 / 255.0);
        assert!(off <= 0.01, "{projection:?}: {:.2} % are off", 100.0 * off);
        // What does not reflect is traced.
        let seen = bodies_seen(&render_scene, size(480, 300));
        let others = drawing.picture.pixels().iter().zip(truth.pixels()).zip(seen);
        assert!(others.filter(|(_, seen)| *seen != Some(0)).all(|((a, b), _)| !differs(a, b, 1e-4)));
    }
}

#[test]
fn coarse_steps_and_no_refinement_cost_accuracy() {
    let render_scene = render_scene(&mirror_floor(Projection::Perspective { fov_degrees: 45.0 }));
    let truth = traced(&render_scene, size(160, 100));
    let off = |settings| {
        let picture = drawn(&render_scene, Method::Ssr(settings), size(160, 100)).picture;
        share_off(&render_scene, &picture, &truth, 2.0 / 255.0)
    };
    let fine = off(ssr());
    let unrefined = off(SsrSettings { step_pixels: 8.0, refinements: 0, ..ssr() });
    let short = off(SsrSettings { range: 2.0, ..ssr() });
    assert!(unrefined > fine + 0.1, "{unrefined} and {fine}");
    assert!(short > 0.5, "{short}");
}

#[test]
fn one_generation_reflects_nothing() {
    let render_scene =
        render_scene(&mirror_floor(Projection::Perspective { fov_degrees: 45.0 })).with_generations(1);
    let truth = traced(&render_scene, size(90, 60));
    for method in [Method::Ssr(ssr()), cube_map(8, false)] {
        assert!(
            rmse(&drawn(&render_scene, method, size(90, 60)).picture, &truth) < 1e-5,
            "{}",
            method.name()
        );
    }
}

#[test]
fn a_cube_map_of_a_far_background_is_the_traced_one() {
    let far = 1e5;
    let sun = |direction: DVec3, r, g, b| ball(0.4 * far, far * direction.normalize(), glow(r, g, b));
    let eye = camera(v(0.0, 0.5, 5.0), DVec3::ZERO, 30.0);
    let alone = render_scene(&scene(vec![ball(1.0, DVec3::ZERO, mirror())], eye, vec![]));
    let picture = drawn(&alone, cube_map(16, false), size(120, 90)).picture;
    assert!(rmse(&picture, &traced(&alone, size(120, 90))) < 1e-6);
    let bodies = vec![
        ball(1.0, DVec3::ZERO, mirror()),
        sun(v(1.0, 0.2, 0.5), 1.0, 0.5, 0.2),
        sun(v(-1.0, 0.8, 0.1), 0.2, 0.9, 0.4),
        sun(v(0.1, -0.7, 1.0), 0.7, 0.2, 0.9),
        sun(v(0.0, 1.0, -0.3), 0.9, 0.9, 0.3),
    ];
    let render_scene = render_scene(&scene(bodies, eye, vec![]));
    let truth = traced(&render_scene, size(240, 180));
    let picture = drawn(&render_scene, cube_map(1024, false), size(240, 180)).picture;
    let off = share_off(&render_scene, &picture, &truth, 2.0 / 255.0);
    // The outlines of the far bodies only.
    assert!(off < 0.02, "{off}");
}

#[test]
fn a_cube_map_shows_in_each_direction_what_lies_there() {
    // Six walls of six colors around the point: on each face its own color, up to the edges.
    let walls = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let color = |wall: DVec3| (wall + DVec3::splat(1.5)) / 4.0;
    let wall = |wall: DVec3| {
        let [r, g, b] = color(wall).to_array();
        block(2.0 - wall.abs(), 1.5 * wall, glow(r, g, b))
    };
    let scene = Scene { bodies: walls.map(wall).into(), ..Scene::default() };
    let control = RenderControl::default();
    let (map, counts) = CubeMap::render(&render_scene(&scene), DVec3::ZERO, 8, &control).unwrap();
    assert_eq!(counts.primary, 6 * 10 * 10);
    // The spiral of equal areas (Vogel 1979).
    const COUNT: u32 = 4000;
    for index in 0..COUNT {
        let z = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(COUNT);
        let (sin, cos) = (f64::from(index) * 2.399_963_229_728_653).sin_cos();
        let direction = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
        let largest = direction.abs().max_element();
        let second = direction.abs().element_sum() - largest - direction.abs().min_element();
        // Up to the middle of the last pixel.
        if second < 0.87 * largest {
            let there =
                walls.into_iter().max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction))).unwrap();
            let light = map.light(direction.as_vec3()).as_dvec3();
            assert!((light - color(there)).length() < 1e-5, "{light} for {direction}");
        }
    }
}

/// A mirror ball in a room of six planes of six colors.
fn room_of_planes() -> Scene {
    let wall = |position, rotation, r, g, b| turned(Shape::Plane, position, rotation, glow(r, g, b));
    let bodies = vec![
        ball(1.0, v(0.6, -0.4, -0.5), mirror()),
        wall(v(0.0, -2.0, 0.0), DVec3::ZERO, 0.8, 0.1, 0.1),
        wall(v(0.0, 3.0, 0.0), v(180.0, 0.0, 0.0), 0.1, 0.8, 0.1),
        wall(v(-3.0, 0.0, 0.0), v(0.0, 0.0, -90.0), 0.1, 0.1, 0.8),
        wall(v(4.0, 0.0, 0.0), v(0.0, 0.0, 90.0), 0.8, 0.8, 0.1),
        wall(v(0.0, 0.0, -3.0), v(90.0, 0.0, 0.0), 0.1, 0.8, 0.8),
        wall(v(0.0, 0.0, 7.0), v(-90.0, 0.0, 0.0), 0.8, 0.1, 0.8),
    ];
    scene(bodies, camera(v(0.2, 0.5, 6.5), v(0.4, -0.2, 0.0), 30.0), vec![])
}

/// The same room as one cube with a pattern on its walls.
fn room_of_one_cube() -> Scene {
    let pattern = checkered(
        glow(0.1, 0.4, 0.8),
        SolidTexture { color: Color::new(0.9, 0.3, 0.1), size: 2.5, ..SolidTexture::default() },
    );
    let bodies =
        vec![ball(1.0, v(0.6, -0.4, -0.5), mirror()), block(v(8.0, 5.0, 10.0), v(0.5, 0.5, 1.0), pattern)];
    scene(bodies, camera(v(0.2, 0.5, 5.5), v(0.4, -0.2, 0.0), 35.0), vec![])
}

#[test]
fn a_corrected_cube_map_of_a_box_room_is_exact_for_the_room() {
    for room in [room_of_planes(), room_of_one_cube()] {
        let render_scene = render_scene(&room);
        let truth = traced(&render_scene, size(240, 180));
        let off = |parallax| {
            let picture = drawn(&render_scene, cube_map(1024, parallax), size(240, 180)).picture;
            share_off(&render_scene, &picture, &truth, 2.0 / 255.0)
        };
        let (corrected, plain) = (off(true), off(false));
        // Where two colors meet, a pixel of the map has part of both.
        assert!(corrected < 0.02 && plain > 0.05, "{corrected} and {plain}");
    }
}

#[test]
fn the_fallback_fills_what_the_screen_lacks() {
    let render_scene = render_scene(&room_of_planes());
    let truth = traced(&render_scene, size(160, 120));
    let maps = CubeMapSettings { size: 256, parallax: true };
    let off = |fallback| {
        let picture =
            drawn(&render_scene, Method::Ssr(SsrSettings { fallback, ..ssr() }), size(160, 120)).picture;
        share_off(&render_scene, &picture, &truth, 3.0 / 255.0)
    };
    let (background, mapped) = (off(SsrFallback::Background), off(SsrFallback::CubeMap(maps)));
    assert!(background > 0.3 && mapped < 0.05, "{background} and {mapped}");
}

#[test]
fn cube_maps_are_kept_while_nothing_they_show_changes() {
    let base = room_of_planes();
    let mut maps = CubeMaps::new();
    let mut draw = |scene: &Scene| {
        let render_scene = render_scene(scene);
        let method = cube_map(32, false);
        let drawing = draw_through(
            &render_scene,
            render_scene.camera(),
            &method,
            size(60, 40),
            &RenderControl::default(),
            &mut maps,
        )
        .unwrap();
        let fresh = drawn(&render_scene, method, size(60, 40));
        assert!(drawing.picture == fresh.picture);
        let used = drawing.cube_maps.unwrap();
        assert_eq!(used.bytes, CubeMap::bytes_of(32) as u64);
        assert!(used.build_time > std::time::Duration::ZERO);
        (used.built, used.kept)
    };
    assert_eq!(draw(&base), (1, 0));
    assert_eq!(draw(&base), (0, 1));
    let mut scene = base.clone();
    scene.camera.position.x += 0.3;
    assert_eq!(draw(&scene), (0, 1), "the eye moved");
    scene.bodies[0].material =
        catoptric_scene::MaterialChoice::own(Phong { reflection: Some(0.5), ..mirror() });
    assert_eq!(draw(&scene), (0, 1), "the body itself changed");
    scene.bodies[0].placement = scene.bodies[0].placement.moved_by(v(0.1, 0.0, 0.0));
    assert_eq!(draw(&scene), (1, 0), "the body moved");
    scene.bodies[1].placement = scene.bodies[1].placement.moved_by(v(0.0, -0.1, 0.0));
    assert_eq!(draw(&scene), (1, 0), "a wall moved");
    scene.lights.push(light(v(0.0, 1.0, 0.0), 1.0));
    assert_eq!(draw(&scene), (1, 0), "a light came");
    scene.environment.background = Color::BLACK;
    assert_eq!(draw(&scene), (1, 0), "the background changed");
}

#[test]
fn a_map_shows_what_surrounds_its_body_and_not_the_body() {
    let render_scene = render_scene(&room_of_planes());
    let drawing = drawn(&render_scene, cube_map(16, false), size(60, 40));
    let maps = drawing.maps(&render_scene);
    let [(0, map)] = maps[..] else { panic!("{} maps", maps.len()) };
    assert_eq!(map.center().as_vec3(), Vec3::new(0.6, -0.4, -0.5));
    assert!((map.light(Vec3::NEG_Y) - Vec3::new(0.8, 0.1, 0.1)).length() < 1e-6);
    assert!((map.light(Vec3::Z * 9.0) - Vec3::new(0.8, 0.1, 0.8)).length() < 1e-6);
    let unfolded = map.unfolded().unwrap();
    assert_eq!((unfolded.width(), unfolded.height()), (64, 48));
    let passes: Vec<PassName> = drawing.passes.iter().map(|(pass, _)| *pass).collect();
    assert_eq!(passes, [PassName::FirstHits, PassName::CubeMaps, PassName::Reflect]);
}

#[test]
fn layers_show_what_the_buffers_hold() {
    let render_scene = render_scene(&mirror_floor(Projection::Perspective { fov_degrees: 45.0 }));
    let drawing = drawn(&render_scene, Method::Ssr(ssr()), size(80, 50));
    let layer = |layer| drawing.layer(&render_scene, layer).unwrap().unwrap();
    // The floor in the middle of the lowest row.
    let at = |which, x, y| layer(which).pixel(x, y).unwrap();
    assert_eq!(at(GBufferLayer::Normal, 40, 49), [0.5, 1.0, 0.5]);
    assert_eq!(at(GBufferLayer::Coefficients, 40, 49), [0.0, 0.0, 1.0]);
    assert_eq!(at(GBufferLayer::Lit, 40, 49), [0.0; 3]);
    assert!(at(GBufferLayer::Reflected, 40, 49)[0] > 0.1);
    assert!(at(GBufferLayer::Depth, 40, 49)[0] > 0.9 && at(GBufferLayer::Depth, 40, 2)[0] < 0.4);
    assert_ne!(at(GBufferLayer::Body, 40, 49), at(GBufferLayer::Body, 40, 2));
    assert_eq!(at(GBufferLayer::Color, 40, 2).map(|part| (part * 10.0).round()), [9.0, 7.0, 4.0]);
    assert!(
        drawn(&render_scene, Method::Whitted, size(8, 5))
            .layer(&render_scene, GBufferLayer::Lit)
            .unwrap()
            .is_none()
    );
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    let fallback = SsrFallback::CubeMap(CubeMapSettings { size: 16, parallax: true });
    for example in ["four-bodies", "still-life"] {
        let render_scene = render_scene(&Example::find(example).unwrap().load().unwrap().scene);
        for method in [Method::Ssr(SsrSettings { fallback, ..ssr() }), cube_map(16, true)] {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let settings = catoptric_tracer::RenderSettings { samples: 2, ..size(97, 61) };
                pool.install(|| drawn(&render_scene, method, settings).picture)
            };
            assert!(on(1) == on(3), "{}", method.name());
        }
    }
}

/// What lies on the screen is the tracer's first generation, bit by bit: with all models of materials, lights that are
/// balls, textures and surroundings.
#[test]
fn the_lit_layer_is_the_traced_first_generation() {
    for name in
        ["four-bodies", "whitted", "soft-shadow", "metals", "roughness-row", "textures", "sky-room", "prism"]
    {
        let render_scene = RenderScene::build(&Example::find(name).unwrap().load().unwrap().scene).unwrap();
        let truth = traced(&render_scene.clone().with_generations(1), size(150, 90));
        for method in [Method::Ssr(ssr()), cube_map(8, false)] {
            let drawing = drawn(&render_scene, method, size(150, 90));
            let lit = drawing.layer(&render_scene, GBufferLayer::Lit).unwrap().unwrap();
            assert!(lit == truth, "{name}");
        }
    }
}
