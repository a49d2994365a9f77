//! Other methods than Whitted's, and what lies behind their pictures.

use catoptric_live::{DisplayContent, LiveError, RenderJob, Request};
use catoptric_picture::{Development, Picture};
use catoptric_tracer::raster::{
    CubeMapSettings, GBufferLayer, Method, MethodKind, ShadingSettings, draw_through,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use std::sync::Arc;

use crate::{Window, developed, four_bodies, from_side, request};

/// A drawing of the request and what is to be seen of it.
fn drawn(request: &Request, samples: u32) -> Picture {
    let render_scene = RenderScene::build(&request.scene).unwrap();
    let [width, height] = request.size;
    let settings = RenderSettings { width, height, samples };
    let camera = render_scene.camera_for(&request.camera);
    let (control, mut maps) = (RenderControl::default(), Default::default());
    let drawing =
        draw_through(&render_scene, &camera, &request.method, settings, &control, &mut maps).unwrap();
    match request.shows {
        DisplayContent::Picture => drawing.picture,
        DisplayContent::Layer(layer) => drawing.layer(&render_scene, layer).unwrap().unwrap(),
        DisplayContent::UnfoldedCube(body) => {
            let maps = drawing.maps(&render_scene);
            let found = maps.iter().find(|(other, _)| Some(*other) == body).unwrap();
            found.1.unfolded().unwrap()
        }
    }
}

#[test]
fn every_method_comes_to_its_drawing_and_tells_its_passes() {
    let window = Window::open();
    for kind in MethodKind::ALL {
        let mut asked = Request { method: kind.method(), samples: 5, ..request(1) };
        asked.camera = from_side(&asked.camera, 25.0);
        let frame = window.shown(asked.clone());
        assert_eq!(
            (frame.samples, frame.picture_size, frame.shows),
            (5, asked.size, DisplayContent::Picture),
            "{kind}"
        );
        assert!(*frame.pixels == developed(&drawn(&asked, 5), &asked.development), "{kind}");
        let status = window.live.status();
        assert_eq!(status.method, Some(kind));
        assert_eq!(status.passes.is_empty(), kind == MethodKind::Whitted, "{kind}");
        assert_eq!(status.cube_maps.is_some(), kind == MethodKind::CubeMap, "{kind}");
        assert_eq!((status.samples_done, status.progress), (5, 1.0));
    }
}

#[test]
fn cube_maps_are_kept_while_only_the_camera_moves() {
    let window = Window::open();
    let method = Method::CubeMap(CubeMapSettings { size: 16, parallax: true });
    let asked = Request { method, samples: 1, ..request(1) };
    window.shown(asked.clone());
    let built = window.live.status().cube_maps.unwrap().built;
    let asked = Request { camera: from_side(&asked.camera, 5.0), revision: 2, moving: true, ..asked };
    window.shown(asked.clone());
    let used = window.live.status().cube_maps.unwrap();
    assert_eq!((used.built, used.kept > 0), (0, true), "{built} were built before");
    // A body that moves is seen in the maps of all others, roughly at first, and then as if nothing had been before.
    let mut scene = (*asked.scene).clone();
    scene.bodies[1].placement.scale *= 1.25;
    let asked = Request { scene: Arc::new(scene), revision: 3, ..asked };
    let frame = window.shown(asked.clone());
    assert!(*frame.pixels == developed(&drawn(&asked, 1), &asked.development));
}

#[test]
fn layers_and_cubes_are_seen_without_drawing_anew() {
    let window = Window::open();
    let method = Method::CubeMap(CubeMapSettings { size: 16, parallax: false });
    let mut asked = Request { method, samples: 1, ..request(1) };
    asked.development.exposure_stops = 1.0;
    let first = window.shown(asked.clone());
    for layer in GBufferLayer::ALL {
        asked.shows = DisplayContent::Layer(layer);
        let frame = window.shown(asked.clone());
        assert_eq!(frame.shows, asked.shows);
        let is_light = matches!(layer, GBufferLayer::Lit | GBufferLayer::Reflected);
        let development = if is_light { asked.development } else { Development::default() };
        assert!(*frame.pixels == developed(&drawn(&asked, 1), &development), "{layer:?}");
        assert_eq!(frame.rays, first.rays);
    }
    asked.shows = DisplayContent::UnfoldedCube(Some(1));
    let frame = window.shown(asked.clone());
    assert_eq!((frame.picture_size, frame.shows), ([64, 48], asked.shows));
    assert!(*frame.pixels == developed(&drawn(&asked, 1), &asked.development));
    // Where there is no such thing, it is the picture.
    asked.method = Method::Flat(ShadingSettings::default());
    assert_eq!(window.shown(asked.clone()).shows, DisplayContent::Picture);
    asked.method = Method::Whitted;
    assert_eq!(window.shown(asked).shows, DisplayContent::Picture);
}

#[test]
fn what_cannot_be_drawn_is_told_and_the_next_request_is_served() {
    let window = Window::open();
    let odd = Method::Phong(ShadingSettings { fineness: 0, ..ShadingSettings::default() });
    window.live.request(Request { method: odd, ..request(1) });
    window.until(|live| matches!(live.status().error, Some(LiveError::Setting(_))));
    window.shown(Request { method: MethodKind::Phong.method(), ..request(2) });
}

#[test]
fn a_job_draws_by_a_method() {
    let settings = RenderSettings { width: 60, height: 40, samples: 2 };
    for shows in [DisplayContent::Picture, DisplayContent::Layer(GBufferLayer::Normal)] {
        let method = MethodKind::Ssr.method();
        let job = RenderJob::drawn(four_bodies(), method, shows, settings, None, 2).unwrap();
        while !job.progress().is_finished {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        let asked = Request { method, shows, ..Request::new(four_bodies(), 0, [60, 40]) };
        assert!(job.take_result().unwrap().unwrap().picture == drawn(&asked, 2));
    }
}
