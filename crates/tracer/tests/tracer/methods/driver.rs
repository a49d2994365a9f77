//! What is true of all methods: refusals, cancellation, odd scenes.

use catoptric_scene::{Example, Projection, Scene, Shape};
use catoptric_tracer::raster::{
    CubeMapSettings, Method, MethodError, MethodKind, ShadingSettings, SsrSettings, draw,
};
use catoptric_tracer::{RenderControl, RenderSettings};
use glam::DVec3;

use crate::methods::common::*;

fn refusal(method: &Method) -> String {
    let render_scene = render_scene(&Scene::default());
    match draw(&render_scene, method, size(4, 4), &RenderControl::default()) {
        Err(MethodError::Setting(error)) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn settings_out_of_range_are_refused_with_the_range() {
    let shading = |fineness| ShadingSettings { fineness, ..ShadingSettings::default() };
    for fineness in [0, 129, u32::MAX] {
        let said = refusal(&Method::Phong(shading(fineness)));
        assert_eq!(said, format!("the fineness is {fineness}; it must be from 1 to 128"));
    }
    let ssr = SsrSettings::default();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refusal(&Method::Ssr(SsrSettings { step_pixels: bad, ..ssr }));
        refusal(&Method::Ssr(SsrSettings { thickness: bad, ..ssr }));
        refusal(&Method::Ssr(SsrSettings { range: bad, ..ssr }));
    }
    refusal(&Method::Ssr(SsrSettings { refinements: 33, ..ssr }));
    refusal(&Method::CubeMap(CubeMapSettings { size: 0, parallax: false }));
    refusal(&Method::CubeMap(CubeMapSettings { size: 4097, parallax: true }));
}

#[test]
fn maps_beyond_all_memory_are_refused_before_they_are_made() {
    let scene = Example::find("sphereflake").unwrap().load().unwrap().scene;
    let method = Method::CubeMap(CubeMapSettings { size: 4096, parallax: false });
    let error = draw(&render_scene(&scene), &method, size(200, 150), &RenderControl::default()).unwrap_err();
    assert!(matches!(error, MethodError::TooManyCubeMaps { size: 4096, .. }), "{error}");
}

#[test]
fn a_cancelled_drawing_ends() {
    let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
    let render_scene = render_scene(&scene);
    for kind in MethodKind::ALL {
        let control = RenderControl::default();
        control.cancel();
        let ended = draw(&render_scene, &kind.method(), size(50, 50), &control);
        assert!(matches!(ended, Err(MethodError::Cancelled)), "{kind}: {ended:?}");
    }
}

#[test]
fn progress_reaches_what_was_announced() {
    let scene = Example::find("four-bodies").unwrap().load().unwrap().scene;
    let render_scene = render_scene(&scene);
    for kind in MethodKind::ALL {
        let control = RenderControl::default();
        let settings = RenderSettings { samples: 2, ..size(40, 30) };
        draw(&render_scene, &kind.method(), settings, &control).unwrap();
        assert_eq!(control.pixels_done(), control.pixels_expected(), "{kind}");
        assert!(control.pixels_done() >= 40 * 30, "{kind}");
    }
}

#[test]
fn odd_scenes_make_finite_pictures() {
    let odd = [
        Scene::default(),
        // The eye in a plane, on a body, in a mirror ball, and far away.
        scene(
            vec![body(Shape::Plane, DVec3::ZERO, mirror())],
            camera(v(0.0, 0.0, 1.0), DVec3::ZERO, 60.0),
            vec![],
        ),
        scene(vec![ball(1.0, DVec3::ZERO, mirror())], camera(v(0.0, 0.0, 1.0), DVec3::ZERO, 60.0), vec![]),
        scene(
            vec![ball(1.0, DVec3::ZERO, mirror())],
            camera(v(0.0, 0.1, 0.2), v(1.0, 0.0, 0.0), 170.0),
            vec![],
        ),
        scene(
            vec![ball(1.0, DVec3::ZERO, mirror()), body(Shape::Plane, v(0.0, -1.0, 0.0), mirror())],
            camera(v(0.0, 3e6, 1e7), DVec3::ZERO, 1e-5),
            vec![light(DVec3::ZERO, 1e6)],
        ),
    ];
    for (number, scene) in odd.into_iter().enumerate() {
        for projection in [scene.camera.projection, Projection::Parallel { height: 1e-3 }] {
            let mut scene = scene.clone();
            scene.camera.projection = projection;
            for kind in MethodKind::ALL {
                let picture = drawn(&render_scene(&scene), kind.method(), size(24, 16)).picture;
                let is_finite = picture.pixels().iter().flatten().all(|light| light.is_finite());
                assert!(is_finite, "{kind} of odd scene {number}");
            }
        }
    }
}
