//! The engine as a window sees it. Nothing here measures time; waits end when what they wait for has come, or fail.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests may")]

mod card;
mod changes;
mod frames;
mod jobs;
mod methods;
mod odd;
mod slices;

use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use catoptric_live::{Frame, Live, LiveOptions, Request, Status};
use catoptric_picture::{BitDepth, Codes, Development};
use catoptric_scene::{Camera, Example, Scene};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render_through};
use glam::DVec3;

/// A live engine and its bell.
struct Window {
    live: Live,
    bell: Receiver<()>,
}

impl Window {
    fn open() -> Self {
        Self::on_threads(0)
    }

    fn on_threads(threads: usize) -> Self {
        let (ring, bell) = channel();
        let options = LiveOptions { threads, ..LiveOptions::default() };
        let wake = move || {
            let _ = ring.send(());
        };
        Self { live: Live::with_options(options, wake).unwrap(), bell }
    }

    /// Waits until the engine has come to what is wanted; it rings at every change.
    fn until(&self, wanted: impl Fn(&Live) -> bool) {
        let start = Instant::now();
        while !wanted(&self.live) {
            assert!(start.elapsed() < Duration::from_secs(60), "{:?}", self.live.status());
            let _ = self.bell.recv_timeout(Duration::from_millis(20));
        }
    }

    fn settle(&self) -> Status {
        self.until(|live| live.status().is_idle);
        self.live.status()
    }

    /// Asks and waits for the last frame of it.
    fn shown(&self, request: Request) -> Arc<Frame> {
        let revision = request.revision;
        self.live.request(request);
        assert_eq!(self.settle().error, None);
        let frame = self.live.latest().unwrap();
        assert_eq!(frame.revision, revision);
        frame
    }
}

fn four_bodies() -> Arc<Scene> {
    static SCENE: OnceLock<Arc<Scene>> = OnceLock::new();
    Arc::clone(SCENE.get_or_init(|| Arc::new(Example::find("four-bodies").unwrap().load().unwrap().scene)))
}

/// A scene of which a single pixel takes longer than anyone waits.
fn endless() -> Arc<Scene> {
    panes(64)
}

/// A scene of which a pixel takes up to 2 to the number of generations rays.
fn panes(generations: u32) -> Arc<Scene> {
    let text = r#"
        format = "catoptric/1"
        [materials.pane]
        diffuse = 0.0
        ambient = 0.0
        reflection = 0.5
        transmission = 0.5
        ior = 1.5
    "#;
    let pane = |z: u32| {
        format!(
            "[[bodies]]\nshape = \"cube\"\nsize = [1e4, 1e4, 0.1]\nposition = [0.0, 0.0, -{z}.0]\nmaterial = \"pane\"\n"
        )
    };
    let text = text.to_owned() + &format!("[tracing]\ngenerations = {generations}\n");
    let text = text + &(0..4).map(pane).collect::<String>();
    Arc::new(catoptric_scene::read(&text).into_result().unwrap().value)
}

fn request(revision: u64) -> Request {
    Request { samples: 3, ..Request::new(four_bodies(), revision, [160, 90]) }
}

fn from_side(camera: &Camera, degrees: f64) -> Camera {
    let turn = glam::DQuat::from_axis_angle(DVec3::Y, degrees.to_radians());
    Camera { position: camera.target + turn * (camera.position - camera.target), ..*camera }
}

/// What `render` and `develop` make of a request.
fn expected(request: &Request, samples: u32) -> Vec<u8> {
    let render_scene = RenderScene::build(&request.scene).unwrap();
    let [width, height] = request.size;
    let settings = RenderSettings { width, height, samples };
    let camera = render_scene.camera_for(&request.camera);
    let picture =
        render_through(&render_scene, &camera, settings, &RenderControl::default()).unwrap().picture;
    developed(&picture, &request.development)
}

fn developed(picture: &catoptric_picture::Picture, development: &Development) -> Vec<u8> {
    match development.develop(picture, BitDepth::Eight).unwrap().codes() {
        Codes::Eight(codes) => {
            codes.chunks(3).flat_map(|rgb| rgb.iter().copied().chain([255]).collect::<Vec<_>>()).collect()
        }
        Codes::Sixteen(_) => unreachable!("asked for 8 bits"),
    }
}
